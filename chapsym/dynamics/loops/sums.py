"""What every loop carries on from step to step: compensated sums, and the filter that guesses the next Gibbs vector.

Written for one number, so that loops of one ball, of lanes and of columns do the same to each, with the same roundings.
"""

from chapsym.generated import turn


def added(total, rest, more):
    """total + more, where `rest` is what the roundings have added too much (Kahan): the sum, and its rest."""
    more = more - rest
    there = total + more
    return there, (there - total) - more


def turned(p, v, x):
    """The vector v, with the rests x of its sums, turned by the quaternion p, of any length: (v, x)."""
    z = turn(*p, *v)
    v1, x1 = added(v[0], x[0], z[0])
    v2, x2 = added(v[1], x[1], z[1])
    v3, x3 = added(v[2], x[2], z[2])
    return (v1, v2, v3), (x1, x2, x3)


def filtered(b, c, d, e, f, h, o, w):
    """The polynomial through the last 8 values as a filter: takes the newest, w, into the sums under way.

    The first of those that it returns, after (a, b, c, d, e, f, h, o), is the guess of the next value.
    """
    return (
        b + 8.0 * w, c - 28.0 * w, d + 56.0 * w, e - 70.0 * w, f + 56.0 * w, h - 28.0 * w, o + 8.0 * w, -w
    )  # fmt: skip


#: What each of the last 8 values adds to the next, the newest first.
WEIGHTS = filtered(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
