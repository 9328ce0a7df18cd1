"""The inner loop of the reduced map G_h of a free top: D = 0, 𝒦 = hγ.

Lemmas `vertical-rotation` and `vertical-level` give the step in closed form: with t = h/2 the rotation is rational in
γ and in one number v, the root of an equation that depends on γ only by ⟨γ,Λ⁻¹γ⟩.  As this is an integral, v is
constant on an orbit, and one Newton correction per step adapts it to the rounding errors of γ.
"""

from chapsym.generated import vertical_level, vertical_rotation, vertical_square

from .integrals import turned
from .records import Steps
from .text import Matrix, Vector
from .vectors import dot, put, put_four, three

#: Newton corrections of v below this, relative to v, are rounding errors.
ROUNDING = 2.0**-49
MOST_CORRECTIONS = 30


def level_root(level, t, v, inertia):
    """The root v by Newton's iteration: (settled, v)."""
    for _ in range(MOST_CORRECTIONS):
        f, slope = vertical_level(t, v, level, *inertia)
        correction = f / slope
        v -= correction
        if abs(correction) <= ROUNDING * v:
            return True, v
    return False, v


def march(state: Vector, I: Vector, k: float, steps: Steps, verticals: Matrix, q: Vector):
    """Takes steps, k = h/2; stores every `every`-th γ, and the last rotation in q.

    state (7): γ, its compensations, and v, which is computed before step 0.  Returns whether all steps converged.
    """
    inertia, v, y, root = three(I, 0), three(state, 0), three(state, 3), state[6]
    if steps.first == 0:
        level = vertical_square(*v, *inertia)
        settled, root = level_root(level, k, level / (I[0] * I[1] * I[2]), inertia)
        if not settled:
            return False
    p = 1.0, 0.0, 0.0, 0.0
    for step in range(steps.first + 1, steps.last + 1):
        p = vertical_rotation(k, root * k * k, *v, *inertia)
        # The next root from the present γ, to shorten the chain of dependent operations: the level is an integral.
        f, slope = vertical_level(k, root, vertical_square(*v, *inertia), *inertia)
        correction = f / slope
        if not (dot(p[1:4], p[1:4]) < p[0] * p[0] and abs(correction) <= ROUNDING * root):
            return False
        root -= correction
        v, y = turned(p, v, y)
        if step % steps.every == 0:
            put(verticals[step // steps.every], 0, v)
    put(state, 0, v)
    put(state, 3, y)
    state[6] = root
    put_four(q, 0, p)
    return True
