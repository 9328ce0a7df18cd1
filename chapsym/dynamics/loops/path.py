"""Beyond the bound of lemma `small-branch`: each step's root is proved to be that of the small-rotation branch.

Lemma `straight-path` joins the root u at hand to no rotation by the path su, t(s) = s + cs(1 - s), 0 ≤ s ≤ 1.  There
G = s(1 - s)R(s), and the Jacobian stretches by m(s) at least; with σ = ½(I_max - I_min) + |𝒦| the root is that of the
branch if 4σs(1 - s)|R(s)| < m(s)² for all s.  That is tested on a few intervals.  m(1) also bounds what a
correction leaves.  Near a fold m(1) goes to 0, and the check fails: such a step is left to the continuation.
"""

from math import sqrt

from chapsym.generated import gibbs_symmetric

from .gibbs import LEFT, newton_round, second_round
from .vectors import square

#: How much of the inequality may be used: its roundings are far below the rest.
INSIDE = 0.98
#: c makes R(s) as small as it can be at this s.
LEVEL = 0.75
#: Rounds that are tried before the continuation: the guess comes from the steps before.
MOST_ROUNDS = 6
#: Before the least stretch is known it is taken to be this times I_max + D, which no stretch exceeds.
NEAR = 0.0625
#: A correction whose square is below this, relative to |u|², has found a root: another round would not prove more.
FOUND = 1e-26


def search_on_path(u, k, g, I, D):
    """(settled, p, u): a Newton iterate, and corrections until the root is proved to be that of the branch."""
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

    They leave a residual of at most 3κ max(|d|,|e|)|e|, κ = ½(I_max - I_min) + |k| (`gibbs-newton`); left: the square
    of twice that.  near: `proved` may well allow so much; found: another round would not leave less.
    """
    r = newton_round(u, k, g, I, D)
    p, w, second = second_round(r, k, I)
    size = square(w)
    curved = 6.0 * (0.5 * (max(*I) - min(*I)) + sqrt(square(k)))
    left = curved * curved * (max(r.first, second) * second)
    allowed = LEFT * (NEAR * (max(*I) + D))
    return p, w, left, left <= allowed * allowed * size, second <= FOUND * size


def proved(u, left, k, g, I, D):
    """Whether u is proved to be the branch's root up to a rounding: half the least stretch divides what is left."""
    half, spread, size = sqrt(square(k)), 0.5 * (max(*I) - min(*I)), square(u)
    reached, least = joined(u, size, k, half, g, I, D, spread)
    allowed = LEFT * least
    return (reached if left <= allowed * allowed * size else 0.0) > 0.0


def joined(u, size, k, half, g, I, D, spread):
    """1 if the straight path joins a root u of G to no rotation, else 0, and the least stretch m(1) at u.

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
    # Numbers, each of one comparison, as compilers make no vectors of truths that are joined.
    proved = 1.0 if first > 0.0 else 0.0
    proved = proved if last > 0.0 else 0.0
    proved = proved * small_between(0.0, 0.4, 0.24, size, c, along, across, half, slope, sag, first, last)
    proved = proved * small_between(0.4, 0.65, 0.25, size, c, along, across, half, slope, sag, first, last)
    proved = proved * small_between(0.65, 0.85, 0.2275, size, c, along, across, half, slope, sag, first, last)
    proved = proved * small_between(0.85, 1.0, 0.1275, size, c, along, across, half, slope, sag, first, last)
    return proved, last


def small_between(a, b, most, size, c, along, across, half, slope, sag, first, last):
    """1 if 4σs(1 - s)|R(s)| < m(s)² for a ≤ s ≤ b, where s(1 - s) ≤ most, else 0.

    R(s) has the component |k|r(s) along k, r = |u|²(1 + s) - c(1 + s²|u|²) - `along`, which is concave, and the
    square `across` across it; m(s) = (1 - s)·first + s·last - s(1 - s)·sag at least.
    """
    start = size * (1.0 + a) - c * (1.0 + a * a * size) - along
    end = size * (1.0 + b) - c * (1.0 + b * b * size) - along
    r = max(abs(start), abs(end)) + 0.25 * (b - a) * (b - a) * c * size
    m = min((1.0 - a) * first + a * last, (1.0 - b) * first + b * last) - most * sag
    left = 4.0 * slope * most
    small = 1.0 if left * left * (half * half * (r * r) + across) < INSIDE * (m * m) * (m * m) else 0.0
    return small if m > 0.0 else 0.0


def lowest(trace, minors, det):
    """A little less than the smallest eigenvalue of a symmetric 3×3 matrix with these invariants; -1 unless it is > 0.

    Newton's iteration on the characteristic polynomial from 0: left of its roots it is concave and grows, so no
    iterate passes the first.
    """
    x = det / minors if minors > 0.0 else -1.0
    for _ in range(2):
        value, slope = ((x - trace) * x + minors) * x - det, (3.0 * x - 2.0 * trace) * x + minors
        x = x - value / slope if slope > 0.0 else x
    x = x if trace > 0.0 else -1.0
    x = x if minors > 0.0 else -1.0
    return x if det > 0.0 else -1.0
