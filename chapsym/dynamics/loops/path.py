"""Beyond the bound of lemma `small-branch`: each step's root is proved to be that of the small-rotation branch.

Lemma `straight-path` connects the root u to the identity by the path su, t(s) = s + cs(1 - s), 0 ≤ s ≤ 1.  On it
G = s(1 - s)R(s), and the Jacobian A has ⟨d, Ad⟩ ≥ m(s)|d|².  With σ = ½(I_max - I_min) + |𝒦|, the root is on the branch
if 4σs(1 - s)|R(s)| < m(s)² for all s.  This is tested on a few intervals.  m(1) also bounds the error after a
correction.  Near a fold m(1) tends to 0, and the test fails: such a step is left to the continuation.
"""

from math import sqrt

from chapsym.generated import gibbs_symmetric

from .gibbs import LEFT, newton_round, second_round
from .vectors import square

#: The usable fraction of the inequality: its rounding errors are far below the margin.
INSIDE = 0.98
#: c minimises |R(s)| at this s.
LEVEL = 0.75
#: The most rounds before the continuation, from the guess by earlier steps.
MOST_ROUNDS = 6
#: The preliminary value of m(1), as a fraction of I_max + D, which is an upper bound for it.
NEAR = 0.0625
#: A correction whose square is below this, relative to |u|², has found a root: another round would not improve it.
FOUND = 1e-26


def search_on_path(u, k, g, I, D):
    """(settled, p, u): a Newton iterate, and corrections until the root is proved to be on the branch."""
    r = newton_round(u, k, g, I, D)
    u = r.w
    for _ in range(MOST_ROUNDS):
        p, u, left, near, found = improved(u, k, g, I, D)
        if (near or found) and proved(u, left, k, g, I, D):
            return True, p, u
        if found:
            break
    return False, (1.0, 0.0, 0.0, 0.0), u


def improved(u, k, g, I, D):
    """Two corrections, d and e, of a guess of the Gibbs vector: (p, u, left, near, found).

    Their residual is at most 3κ max(|d|,|e|)|e|, κ = ½(I_max - I_min) + |k| (`gibbs-newton`); left: the square
    of twice that.  near: `proved` probably accepts this; found: another round would not reduce it.
    """
    r = newton_round(u, k, g, I, D)
    p, w, second = second_round(r, k, I)
    size = square(w)
    curved = 6.0 * (0.5 * (max(*I) - min(*I)) + sqrt(square(k)))
    left = curved * curved * (max(r.first, second) * second)
    allowed = LEFT * (NEAR * (max(*I) + D))
    return p, w, left, left <= allowed * allowed * size, second <= FOUND * size


def proved(u, left, k, g, I, D):
    """Whether u is proved to be the root of the branch up to rounding: the error is at most √left/m(1)."""
    half, spread, size = sqrt(square(k)), 0.5 * (max(*I) - min(*I)), square(u)
    reached, least = joined(u, size, k, half, g, I, D, spread)
    allowed = LEFT * least
    return (reached if left <= allowed * allowed * size else 0.0) > 0.0


def joined(u, size, k, half, g, I, D, spread):
    """1 if a root u of G is proved to be connected to the identity by the straight path, else 0; and m(1).

    size: |u|²; half: |k|; spread: ½(I_max - I_min).
    """
    none = 0.0 * u[0]
    first = lowest(*gibbs_symmetric(none, none, none, *k, *g, *I, D))
    last = lowest(*gibbs_symmetric(*u, *k, *g, *I, D))
    u1, u2, u3 = u
    I1, I2, I3 = I
    x = (I3 * u2 * u3 - I2 * u2 * u3, I1 * u1 * u3 - I3 * u1 * u3, I2 * u1 * u2 - I1 * u1 * u2)  # u × Iu
    along = (x[0] * k[0] + (x[1] * k[1] + x[2] * k[2])) / (half * half)
    across = max(square(x) - along * along * (half * half), 0.0)
    c = max(0.0, min(1.0, (size * (1.0 + LEVEL) - along) / (1.0 + LEVEL * LEVEL * size)))
    sag = half * sqrt(size) - (k[0] * u1 + (k[1] * u2 + k[2] * u3))
    slope = spread + 2.0 * half
    # Numbers from single comparisons, as compilers do not vectorise combined conditions.
    proved = 1.0 if first > 0.0 else 0.0
    proved = proved if last > 0.0 else 0.0
    path = size, c, along, across, half, slope, sag, first, last
    for a, b, most in ((0.0, 0.4, 0.24), (0.4, 0.65, 0.25), (0.65, 0.85, 0.2275), (0.85, 1.0, 0.1275)):
        proved = proved * small_between(a, b, most, path)
    return proved, last


def small_between(a, b, most, path):
    """1 if 4σs(1 - s)|R(s)| < m(s)² for a ≤ s ≤ b, where s(1 - s) ≤ most, else 0.

    R(s) has the component |k|r(s) along k, r = |u|²(1 + s) - c(1 + s²|u|²) - `along`, which is concave, and the
    square `across` across it; m(s) = (1 - s)·first + s·last - s(1 - s)·sag at least.
    """
    size, c, along, across, half, slope, sag, first, last = path
    start = size * (1.0 + a) - c * (1.0 + a * a * size) - along
    end = size * (1.0 + b) - c * (1.0 + b * b * size) - along
    r = max(abs(start), abs(end)) + 0.25 * (b - a) * (b - a) * c * size
    m = min((1.0 - a) * first + a * last, (1.0 - b) * first + b * last) - most * sag
    left = 4.0 * slope * most
    small = 1.0 if left * left * (half * half * (r * r) + across) < INSIDE * (m * m) * (m * m) else 0.0
    return small if m > 0.0 else 0.0


def lowest(trace, minors, det):
    """A lower bound, nearly equal, for the least eigenvalue of a symmetric 3×3 matrix with these invariants; else -1.

    -1 is returned unless the eigenvalue is positive.  By Newton's iteration on the characteristic polynomial from 0:
    below its roots the polynomial is concave and increasing, so no iterate passes the first root.
    """
    x = det / minors if minors > 0.0 else -1.0
    for _ in range(2):
        value, slope = ((x - trace) * x + minors) * x - det, (3.0 * x - 2.0 * trace) * x + minors
        x = x - value / slope if slope > 0.0 else x
    x = x if trace > 0.0 else -1.0
    x = x if minors > 0.0 else -1.0
    return x if det > 0.0 else -1.0
