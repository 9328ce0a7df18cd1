"""The expected errors and first steps of a run of long steps, and the final evaluation of its estimated errors."""

from math import frexp, inf, ldexp, sqrt

from chapsym.generated import angular_velocity

from .branch import moments
from .following import ACROSS, CAUTIOUS, FARTHEST, ROLLED, ROUNDINGS, SPUN, STEPS, TURNED, UNTIL, WALKED
from .text import Integers, Matrix, Vector
from .vectors import largest, length, shifted, three

#: The estimates for a ball: |ω| at the start in rad/s; a bound for the condition of Λ - Dγγᵀ; whether it may rotate
#: steadily; the error floor by rounding, and that for steady rotation; the first step in seconds, the permitted error
#: per second, and that at the end; and the rounding error of the start.
RATE, CONDITION, SINGLE, FLOOR, STILL, FIRST, ALLOWED, MOST, START = 0, 1, 2, 3, 4, 5, 6, 7, 8
FOUND = 9
#: The unit roundoff.
UNIT = 2.0**-53
#: The growth of the errors of steps in a run, for most balls.
GROWTH = 30.0
#: The error of a step of |ω|h = 1 radian, for most balls; and the fraction of an accuracy at which a run aims: with
#: the whole of it some balls fail and start again, which costs more than shorter steps.
UNIT_ERROR, AIM = 3e-9, 0.5
#: Systematic rounding errors of steps turn a ball as those of its parameters do, this many times as far.
TURNING = 3.0
#: The largest condition for which the rounding errors of long steps are known.
CONDITIONED = 1e4
#: The value for an error without a bound.
ENDLESS = 2.0**1000


def surveyed(
    momenta: Matrix, verticals: Matrix, J0: Matrix, D0: Vector, unit: Vector, end: float, accuracy: float, found: Matrix
):
    """Writes estimates for each ball at the start, (FOUND, balls); unit: the size of a relative error 1, (balls,).

    The effect of rounding J, D and K grows with the angle; rounding errors of the forty stages per radian accumulate
    as a random walk; ω along γ has errors ∝ the condition.  Returns the maximum of FLOOR and of SINGLE.
    """
    floor, single = 0.0, 0.0
    for i in range(momenta.shape[0]):
        # K and the moments are scaled exactly, by powers of two, to about 1.
        _, size = frexp(largest(three(momenta[i], 0)))
        _, weight = frexp(max(J0[i, 0], J0[i, 1], J0[i, 2], D0[i]))
        k, J, D = shifted(three(momenta[i], 0), -size), shifted(three(J0[i], 0), -weight), ldexp(D0[i], -weight)
        w = angular_velocity(*k, *three(verticals[i], 0), *J, D)
        rate = ldexp(length(w), size - weight)
        inertia = moments(J)
        least = min(*inertia)
        condition = (max(*inertia) + D) / least if least > 0.0 else ENDLESS
        zeros = (1 if k[0] == 0.0 else 0) + (1 if k[1] == 0.0 else 0) + (1 if k[2] == 0.0 else 0)
        turned, root = rate * end, sqrt(condition)
        walked = sqrt(1.0 + 40.0 * turned)
        found[RATE, i], found[CONDITION, i] = rate, condition
        found[SINGLE, i] = 1.0 if zeros > 1 or (J[0] == J[1] and J[1] == J[2]) else 0.0
        found[FLOOR, i] = UNIT * ((1.0 + turned) * (2.0 * root + walked) + 8.0 * condition) * unit[i]
        found[STILL, i] = UNIT * ((1.0 + turned) * (2.0 * root + 1.0) + 8.0 * condition) * unit[i]
        allowed = AIM * accuracy / unit[i] / (CAUTIOUS * GROWTH) / end if end > 0.0 else 1.0
        # The power 3/32: nearly the root that the error law requires.
        part = sqrt(sqrt(sqrt(sqrt(min(allowed / (UNIT_ERROR * rate), 1.0))))) if rate > 0.0 else 1.0
        part = FARTHEST * part * sqrt(part)
        found[FIRST, i] = min(part / rate, end) if rate * end > part else end
        found[ALLOWED, i], found[MOST, i] = allowed, accuracy / unit[i]
        # The effect of rounding each component of K, amplified in ω up to the condition if K is orthogonal to γ.
        a = angular_velocity(k[0], 0.0, 0.0, *three(verticals[i], 0), *J, D)
        b = angular_velocity(0.0, k[1], 0.0, *three(verticals[i], 0), *J, D)
        c = angular_velocity(0.0, 0.0, k[2], *three(verticals[i], 0), *J, D)
        moved = abs(a[0]) + abs(b[0]) + abs(c[0]), abs(a[1]) + abs(b[1]) + abs(c[1]), abs(a[2]) + abs(b[2]) + abs(c[2])
        across = length(moved) / length(w) if length(w) > 0.0 else 0.0
        found[START, i] = 2.0 * UNIT * max(root, ACROSS * across)
        known = found[FLOOR, i] <= ENDLESS  # not where it is NaN
        floor, single = max(floor, found[FLOOR, i] if known else inf), max(single, found[SINGLE, i])
    return floor, single


def estimated(
    found: Matrix, reported: Matrix, unit: Vector, turned: bool, spun: bool, rolled: bool, error: Vector, noise: Vector,
    started: Vector, total: Integers,
):  # fmt: skip
    """Writes the estimated errors, the parts due to rounding of the steps and of the start, and the numbers of steps.

    For a stopped ball they are NaN.  Rounding errors accumulate as a random walk, and are amplified as the errors are.
    turned, spun, rolled: which errors count.  Returns the largest error.
    """
    worst = 0.0
    for i in range(error.shape[0]):
        most = reported[i, TURNED] if turned else 0.0
        most = max(most, reported[i, SPUN]) if spun else most
        most = unit[i] * (max(most, reported[i, ROLLED]) if rolled else most)
        walked = unit[i] * reported[i, WALKED]
        started[i] = walked / sqrt(1.0 + ROUNDINGS * ROUNDINGS * reported[i, STEPS])
        noise[i] = walked + TURNING * found[STILL, i]
        error[i] = most + TURNING * found[STILL, i]
        if reported[i, UNTIL] < 1.0:  # the error expected at the end
            error[i] = max(error[i] / reported[i, UNTIL], 2.0 * unit[i] * found[MOST, i])
        if found[CONDITION, i] > CONDITIONED:
            noise[i] = ENDLESS
        total[i] = int(reported[i, STEPS])
        worst = error[i] if not error[i] <= worst else worst
    return worst
