"""The inner loop of the reduced map G_h: 𝒦 = hγ, and the state is γ.  Plain scalar Python that numba compiles.

For D = 0 lemmas `vertical-rotation` and `vertical-level` give the step in closed form: with t = h/2 the rotation
is rational in γ and in one number v, the root of an equation that knows γ through ⟨γ,Λ⁻¹γ⟩ only.  As that is an
integral, v serves a whole orbit, and one Newton correction a step keeps it true to the rounding of γ.
For D > 0 the Gibbs vector is extrapolated and corrected, as in `gibbs`, but 𝒦 need not be carried.
Lemma `small-branch`: where `radius` > 0 a root with |q| < q₀ is that of the small-rotation branch.
"""

from chapsym.generated import vertical_level, vertical_rotation, vertical_square

from .branch import small_rotation
from .gibbs import search_safely, settle
from .sums import filtered, turned

#: A moment or h below this, for Λmax about 1, takes the safe way: products of three or four would underflow.
SMALLEST = 2.0**-120

#: Newton corrections of v below this, relative to v, are rounding.
ROUNDING = 2.0**-49
MOST_CORRECTIONS = 30


def level_root(level, t, v, I1, I2, I3):
    """v by Newton's iteration; returns (settled, v)."""
    for _ in range(MOST_CORRECTIONS):
        f, slope = vertical_level(t, v, level, I1, I2, I3)
        correction = f / slope
        v -= correction
        if abs(correction) <= ROUNDING * v:
            return True, v
    return False, v


def safe_rotation(u1, u2, u3, g1, g2, g3, J, I, D, h, radius, enough):
    """The rotation of a step that is not settled: from the guess u, or by the continuation.

    Returns (status, reach, p0, p1, p2, p3, u1, u2, u3).
    """
    k = 0.5 * h
    settled, p0, p1, p2, p3, w1, w2, w3 = search_safely(
        u1, u2, u3, k * g1, k * g2, k * g3, g1, g2, g3, I[0], I[1], I[2], D, radius, enough
    )  # fmt: skip
    if settled:
        return 0, 1.0, p0, p1, p2, p3, w1, w2, w3
    status, reach, p0, p1, p2, p3 = small_rotation(h * g1, h * g2, h * g3, g1, g2, g3, J[0], J[1], J[2], D)
    if p0 == 0.0:
        return status, reach, p0, p1, p2, p3, 0.0, 0.0, 0.0  # a rotation by π has no Gibbs vector
    return status, reach, p0, p1, p2, p3, p1 / p0, p2 / p0, p3 / p0


def march(g, J, I, D, h, radius, enough, first, count, every, verticals, q):
    """Takes `count` steps from the step `first` on; keeps every `every`-th γ in the frame array.

    radius, enough: of `gibbs.certificate`.  g holds the present γ and moves; q receives the last rotation,
    of any length.  Returns (taken, status, reach).
    """
    I1, I2, I3 = I[0], I[1], I[2]
    k = 0.5 * h
    g1, g2, g3 = g[0], g[1], g[2]
    y1, y2, y3 = 0.0, 0.0, 0.0  # what γ is short of (Kahan)
    level, v = vertical_square(g1, g2, g3, I1, I2, I3), 0.0
    closed = D == 0.0 and radius >= 0.0
    if closed:
        closed, v = level_root(level, k, level / (I1 * I2 * I3), I1, I2, I3)
    a1 = a2 = a3 = b1 = b2 = b3 = c1 = c2 = c3 = d1 = d2 = d3 = 0.0
    e1 = e2 = e3 = f1 = f2 = f3 = h1 = h2 = h3 = o1 = o2 = o3 = 0.0
    p0, p1, p2, p3 = 1.0, 0.0, 0.0, 0.0
    w1, w2, w3 = 0.0, 0.0, 0.0
    status, reach = 0, 1.0
    for step in range(first, first + count):
        if closed:
            p0, p1, p2, p3 = vertical_rotation(k, v * k * k, g1, g2, g3, I1, I2, I3)
            # The next v from the γ of now, so that nothing waits for it: the level is an integral.
            f, slope = vertical_level(k, v, vertical_square(g1, g2, g3, I1, I2, I3), I1, I2, I3)
            correction = f / slope
            settled = p1 * p1 + p2 * p2 + p3 * p3 < p0 * p0 and abs(correction) <= ROUNDING * v
            v -= correction
        else:
            settled, p0, p1, p2, p3, w1, w2, w3 = settle(
                a1, a2, a3, k * g1, k * g2, k * g3, g1, g2, g3, I1, I2, I3, D, radius, enough
            )  # fmt: skip
        if not settled:
            status, reach, p0, p1, p2, p3, w1, w2, w3 = safe_rotation(
                w1, w2, w3, g1, g2, g3, J, I, D, h, radius, enough
            )  # fmt: skip
            if status != 0:
                return step - first, status, reach
        if not closed:
            a1, b1, c1, d1, e1, f1, h1, o1 = filtered(b1, c1, d1, e1, f1, h1, o1, w1)
            a2, b2, c2, d2, e2, f2, h2, o2 = filtered(b2, c2, d2, e2, f2, h2, o2, w2)
            a3, b3, c3, d3, e3, f3, h3, o3 = filtered(b3, c3, d3, e3, f3, h3, o3, w3)
        g1, g2, g3, y1, y2, y3 = turned(p0, p1, p2, p3, g1, g2, g3, y1, y2, y3)
        if (step + 1) % every == 0:
            frame = (step + 1) // every
            verticals[frame, 0], verticals[frame, 1], verticals[frame, 2] = g1, g2, g3
    g[0], g[1], g[2] = g1, g2, g3
    q[0], q[1], q[2], q[3] = p0, p1, p2, p3
    return count, 0, 1.0
