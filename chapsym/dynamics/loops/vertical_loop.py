"""The inner loop of the reduced map G_h of a free top: D = 0, 𝒦 = hγ.

Lemmas `vertical-rotation` and `vertical-level` give the step in closed form: with t = h/2 the rotation is rational in
γ and in one number v, the root of an equation that knows γ through ⟨γ,Λ⁻¹γ⟩ only.  As that is an integral, v serves a
whole orbit, and one Newton correction a step keeps it true to the rounding of γ.
"""

from chapsym.generated import vertical_level, vertical_rotation, vertical_square

from .sums import turned
from .text import Matrix, Vector

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


def march(g: Vector, I: Vector, k: float, count: int, every: int, verticals: Matrix, q: Vector):
    """Takes `count` steps from g (3) on, with k = h/2; keeps every `every`-th γ in the frames, the last rotation in q.

    Returns whether every step settled, on a rotation by less than a right angle; else the frames are of no use.
    """
    I1, I2, I3 = I[0], I[1], I[2]
    g1, g2, g3 = g[0], g[1], g[2]
    y1, y2, y3 = 0.0, 0.0, 0.0
    level = vertical_square(g1, g2, g3, I1, I2, I3)
    settled, v = level_root(level, k, level / (I1 * I2 * I3), I1, I2, I3)
    if not settled:
        return False
    p0, p1, p2, p3 = 1.0, 0.0, 0.0, 0.0
    for step in range(1, count + 1):
        p0, p1, p2, p3 = vertical_rotation(k, v * k * k, g1, g2, g3, I1, I2, I3)
        # The next v from the γ of now, so that nothing waits for it: the level is an integral.
        f, slope = vertical_level(k, v, vertical_square(g1, g2, g3, I1, I2, I3), I1, I2, I3)
        correction = f / slope
        if not (p1 * p1 + p2 * p2 + p3 * p3 < p0 * p0 and abs(correction) <= ROUNDING * v):
            return False
        v -= correction
        g1, g2, g3, y1, y2, y3 = turned(p0, p1, p2, p3, g1, g2, g3, y1, y2, y3)
        if step % every == 0:
            frame = step // every
            verticals[frame, 0], verticals[frame, 1], verticals[frame, 2] = g1, g2, g3
    q[0], q[1], q[2], q[3] = p0, p1, p2, p3
    return True
