"""The expected cost of long steps of a ball, and the evaluation of the errors they estimate.  Plain code, compiled."""

from math import frexp, inf, ldexp, sqrt

from chapsym.generated import angular_velocity

from .branch import moments
from .following import ACROSS, CAUTIOUS, FARTHEST, ROLLED, ROUNDINGS, SPUN, STEPS, TURNED, UNTIL, WALKED
from .text import Matrix, Vector
from .vectors import largest, length, shifted, three

#: What is found of a ball: |ω| at the start in rad/s; the condition of Λ - Dγγᵀ, at most; whether it may rotate
#: steadily; what rounding may leave of it, and if it does; the first step in seconds, the error of a second, and that
#: at the end; and how far its start may be off by a rounding.
RATE, CONDITION, SINGLE, FLOOR, STILL, FIRST, ALLOWED, MOST, START = 0, 1, 2, 3, 4, 5, 6, 7, 8
FOUND = 9
#: A rounding.
UNIT = 2.0**-53
#: By how much the errors of steps grow in a run, of most balls.
GROWTH = 30.0
#: The error of a step of |ω|h = 1 radian, of most balls; and what part of an accuracy a run aims at: with all of it
#: some balls miss, and start anew, which costs more than shorter steps.
UNIT_ERROR, AIM = 3e-9, 0.5
#: The roundings of steps that go one way turn a ball as those of its parameters do, and this many times as far.
TURNING = 3.0
#: Of a ball of a larger condition the roundings of long steps are not known.
CONDITIONED = 1e4
#: What has no bound.
ENDLESS = 2.0**1000


def surveyed(
    momenta: Matrix, verticals: Matrix, J0: Matrix, D0: Vector, unit: Vector, end: float, accuracy: float, found: Matrix
):
    """Estimates for each ball at the start, (FOUND, balls); unit: the size of a relative error 1, (balls,).

    Rounding of J, D and K turns with the ball; that of the forty stages in a radian walks; ω along γ loses the digits
    of the condition.  Returns the largest of FLOOR and of SINGLE.
    """
    floor, single = 0.0, 0.0
    for i in range(momenta.shape[0]):
        # By powers of two, exactly, K and the moments are about 1.
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
        # The power 3/32, which is the root that the law asks for, but a little.
        part = sqrt(sqrt(sqrt(sqrt(min(allowed / (UNIT_ERROR * rate), 1.0))))) if rate > 0.0 else 1.0
        part = FARTHEST * part * sqrt(part)
        found[FIRST, i] = min(part / rate, end) if rate * end > part else end
        found[ALLOWED, i], found[MOST, i] = allowed, accuracy / unit[i]
        # By a rounding of each component of K, which counts up to the condition times in ω where K is across γ.
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
    started: Vector,
):  # fmt: skip
    """The errors that the loop estimated, and what of them the roundings of the steps, and of the start, may have made.

    Those of a ball that stopped are NaN.  Roundings walk, and what is left of them grows as the errors do.  turned,
    spun, rolled: which errors count.  Returns the largest error.
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
        if reported[i, UNTIL] < 1.0:  # what is to be feared at the end
            error[i] = max(error[i] / reported[i, UNTIL], 2.0 * unit[i] * found[MOST, i])
        if found[CONDITION, i] > CONDITIONED:
            noise[i] = ENDLESS
        worst = error[i] if not error[i] <= worst else worst
    return worst
