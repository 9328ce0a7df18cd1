"""The common state of all loops: compensated sums, the filter that guesses the next Gibbs vector, and the integrals.

Sums and filter are functions of single numbers, so that loops of one ball and of lanes compute the same, with the same
rounding errors.  ⟨γ,γ⟩, ⟨𝒦,γ⟩ and ⟨𝒦,𝒦⟩ are known to twice the working precision, and restored without bias.

The map turns 𝒦 and γ by the same rotation.  Each increment is added with compensation (Kahan), so that the sums have
twice the digits; the drift by rounding errors of the rotation itself is corrected every `PERIOD` steps.  The correction
is applied to the compensations, not to 𝒦 and γ: renormalised and rounded vectors would have a bias.
"""

from chapsym.generated import turn
from chapsym.numbers.pairs import split_product, two_sum

from .text import out_of_line
from .vectors import three

#: Steps between two restorations.
PERIOD = 1024
#: If sin² of the angle of 𝒦 and γ is below this, ⟨𝒦,γ⟩ is not restored: it follows from |𝒦| and |γ|.
VERTICAL = 1e-6
#: The value for float32, whose rounding errors are larger.
SINGLE = {"VERTICAL": 1e-4}


def inner(a1, a2, a3, b1, b2, b3, high, low):
    """⟨a, b⟩ + high + low as (sum, error), to about twice the working precision."""
    x, x_low = split_product(a1, b1)
    y, y_low = split_product(a2, b2)
    z, z_low = split_product(a3, b3)
    total, e = two_sum(x, y)
    total, f = two_sum(total, z)
    total, g = two_sum(total, high)
    return two_sum(total, (e + f) + (g + low) + ((x_low + y_low) + z_low))


def integrals(k, g):
    """⟨γ,γ⟩, ⟨k,γ⟩ and ⟨k,k⟩ as pairs."""
    return inner(*g, *g, 0.0, 0.0), inner(*k, *g, 0.0, 0.0), inner(*k, *k, 0.0, 0.0)


@out_of_line
def remember(state):
    """Writes the three integrals of k = state[0:3] and γ = state[3:6], as pairs, into state[12:18]."""
    one, height, squared = integrals(three(state, 0), three(state, 3))
    state[12], state[13] = one
    state[14], state[15] = height
    state[16], state[17] = squared


def shares(unit, height, squared, one, h, n):
    """The changes that increase the integrals (one, h, n) by (unit, height, squared): (stretch, along_k, along_gamma).

    γ becomes (1 + stretch)γ, and k becomes k + along_k k + along_gamma γ.
    """
    if not n > 0.0:
        return 0.0, 0.0, 0.0
    stretch = 0.5 * unit / one
    height -= stretch * h
    sine = one - h * h / n
    if sine > VERTICAL:
        along_gamma = (height - 0.5 * squared * h / n) / sine
        return stretch, (0.5 * squared - along_gamma * h) / n, along_gamma
    return stretch, 0.5 * squared / n, 0.0


def missing(state):
    """The integrals in state[12:18] minus those of k and γ with their compensations state[6:12]."""
    k1, k2, k3, g1, g2, g3 = state[0], state[1], state[2], state[3], state[4], state[5]
    x1, x2, x3, y1, y2, y3 = state[6], state[7], state[8], state[9], state[10], state[11]
    unit, _ = inner(g1, g2, g3, -g1, -g2, -g3, state[12], state[13])
    height, _ = inner(k1, k2, k3, -g1, -g2, -g3, state[14], state[15])
    squared, _ = inner(k1, k2, k3, -k1, -k2, -k3, state[16], state[17])
    # The compensated vectors are k - x and γ - y.
    unit += 2.0 * (g1 * y1 + g2 * y2 + g3 * y3)
    height += (k1 * y1 + k2 * y2 + k3 * y3) + (g1 * x1 + g2 * x2 + g3 * x3)
    squared += 2.0 * (k1 * x1 + k2 * x2 + k3 * x3)
    return unit, height, squared


def give(state, stretch, along_k, along_gamma):
    """Subtracts the changes of `shares` from the compensations."""
    for i in range(3):
        k, g = state[i], state[3 + i]
        state[6 + i] = state[6 + i] - (along_k * k + along_gamma * g)
        state[9 + i] = state[9 + i] - stretch * g


@out_of_line
def restore(state):
    """Corrects the compensations state[6:12] so that the compensated k and γ have the integrals in state[12:18].

    γ is scaled; small multiples of k and γ are added to k, or of k alone if the two are nearly parallel.
    """
    unit, height, squared = missing(state)
    stretch, along_k, along_gamma = shares(unit, height, squared, state[12], state[14], state[16])
    give(state, stretch, along_k, along_gamma)


def added(total, rest, more):
    """total + more - rest (Kahan): the sum and its new compensation; rest: the excess of total by rounding errors."""
    more = more - rest
    there = total + more
    return there, (there - total) - more


def turned(p, v, x):
    """The vector v with the compensations x, turned by the quaternion p of any length: (v, x)."""
    z = turn(*p, *v)
    v1, x1 = added(v[0], x[0], z[0])
    v2, x2 = added(v[1], x[1], z[1])
    v3, x3 = added(v[2], x[2], z[2])
    return (v1, v2, v3), (x1, x2, x3)


def filtered(b, c, d, e, f, h, o, w):
    """The extrapolation by a polynomial through the last 8 values as a filter, updated by w; the guess comes first."""
    return (
        b + 8.0 * w, c - 28.0 * w, d + 56.0 * w, e - 70.0 * w, f + 56.0 * w, h - 28.0 * w, o + 8.0 * w, -w
    )  # fmt: skip


#: The weights of the last 8 values in the guess of the next, the newest first.
WEIGHTS = filtered(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
