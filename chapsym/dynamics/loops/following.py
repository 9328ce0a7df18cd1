"""Adaptive long steps: each ball chooses its steps for a given rate of error; frames are interpolated.

Each lane has a ball with its own step and time; when a ball is finished, the next one gets its lane.  The computation
in a lane depends on its ball alone, so a ball has the same bits alone and among others.  Plain scalar Python: the same
functions run on floats and are compiled.

Within a step the ball is on Hermite polynomials of degree 11 through its two ends, of order 12 in the step.  At each
end the attitude and the contact point have their values and five derivatives from (2.3).  K and γ are fixed in space,
and turned by the attitude alone: |K|², ⟨K,γ⟩ and |γ|² are conserved to rounding.  At the fraction s of the step a
polynomial has the error f⁽¹²⁾/12! · (s(1 - s))⁶, where (s(1 - s))⁶ ≤ 2⁻¹².  The last coefficients approximate f⁽¹⁰⁾/10!
and f⁽¹¹⁾/11!; the next is extrapolated from these, and eight times its value is reported as the error estimate.
"""

from math import sqrt
from typing import NamedTuple

import numpy as np

from chapsym.generated import angular_velocity, compose, rotate

from . import lanes as at
from . import loop
from .carried import END as LAST_END
from .carried import FLOW, FOUND, GRADIENT, PART, SWAY, UNIT_ROUNDING, WHOLE, begun, carry, changes, tangent
from .carried import ROUNDED as ROUNDING
from .carried import ROWS as ERRORS
from .carried import SPUN as BY_ATTITUDE
from .lanes import Weights, enter, placed, put_back, resized, safely, shown, stopped_at, taken_out
from .records import Balls, Ends, Frames
from .text import Cube, Matrix, Vector
from .vectors import (
    conjugate,
    dot,
    four,
    length,
    plus,
    plus_four,
    put,
    put_four,
    put_in,
    scaled,
    scaled_four,
    square,
    square_of_four,
    three,
    three_in,
)

#: The number of values and derivatives at an end, and of components: the attitude (4), the contact point (2).
TERMS, PARTS = 6, 6
#: Rows of the series of vectors in `series`: ω, K, γ, the horizontal axes x and y in body axes, and ⟨γ,ω⟩.
SPIN, SPACE, UP, EAST, NORTH, ALONG = 0, 3, 6, 9, 12, 15
SERIES = 16
#: (s(1 - s))⁶ at s = ½.
MIDDLE = 2.0**-12
#: The largest ratio of successive coefficients that the extrapolation assumes.
MOST_GROWN = 8.0


def crossed(V, at, n, i):
    """The coefficient n of the component i of v × ω; the series of v is in the rows from `at` on."""
    j = i + 1 if i < 2 else 0
    k = j + 1 if j < 2 else 0
    found = 0.0
    for m in range(n + 1):
        found += V[at + j, m] * V[SPIN + k, n - m] - V[at + k, m] * V[SPIN + j, n - m]
    return found


def series(body, J, contact, radius, whole, traced, V, end):
    """Writes the Taylor coefficients of attitude and contact point at `body`, in units of a step, into `end` (6, 6).

    body: `lanes.MOVING`.  whole: the step, in the unit of time of K and J.  V (SERIES, TERMS): workspace.
    traced: whether the contact point is needed.
    """
    g, a = three(body, 3), four(body, at.ATTITUDE)
    put_in(V, SPACE, 0, three(body, 0))
    put_in(V, UP, 0, g)
    if traced:
        put_in(V, EAST, 0, rotate(*conjugate(a), 1.0, 0.0, 0.0))
        put_in(V, NORTH, 0, rotate(*conjugate(a), 0.0, 1.0, 0.0))
    put_four(end[0], 0, a)
    end[0, 4], end[0, 5] = body[at.SPOT], body[at.SPOT + 1]
    for n in range(TERMS - 1):
        # Λω - D⟨γ,ω⟩γ = K, solved for the new coefficient of ω.
        x, along = scaled(whole, three_in(V, SPACE, n)), 0.0
        for m in range(1, n + 1):
            along += dot(three_in(V, UP, m), three_in(V, SPIN, n - m))
            x = plus(x, scaled(contact * V[ALONG, n - m], three_in(V, UP, m)))
        w = angular_velocity(*plus(x, scaled(contact * along, g)), *g, *J, contact)
        put_in(V, SPIN, n, w)
        V[ALONG, n] = along + dot(g, w)
        part = 1.0 / (n + 1)
        for i in range(3):
            V[SPACE + i, n + 1], V[UP + i, n + 1] = part * crossed(V, SPACE, n, i), part * crossed(V, UP, n, i)
        if traced:
            for i in range(3):
                V[EAST + i, n + 1], V[NORTH + i, n + 1] = part * crossed(V, EAST, n, i), part * crossed(V, NORTH, n, i)
            x1, x2 = 0.0, 0.0
            for m in range(n + 1):
                for i in range(3):
                    x1 += V[SPIN + i, m] * V[NORTH + i, n - m]
                    x2 -= V[SPIN + i, m] * V[EAST + i, n - m]
            end[n + 1, 4], end[n + 1, 5] = radius * part * x1, radius * part * x2
        b = 0.0, 0.0, 0.0, 0.0
        for m in range(n + 1):
            b = plus_four(b, compose(*four(end[m], 0), 0.0, *three_in(V, SPIN, n - m)))
        put_four(end[n + 1], 0, scaled_four(0.5 * part, b))


def shortened(end, ratio):
    """Rescales Taylor coefficients in place, for a step multiplied by `ratio`."""
    factor = 1.0
    for n in range(1, TERMS):
        factor *= ratio
        for i in range(PARTS):
            end[n, i] *= factor


def joined(first, end, radius, traced, curve):
    """Writes the polynomial through two ends into `curve` (12, 6): powers of s, and s⁶ times powers of s - 1.

    Returns the estimated interpolation errors of the attitude in radians and of the contact point in radii.
    """
    for i in range(PARTS if traced else 4):
        for n in range(TERMS):
            curve[n, i] = first[n, i]
        a0, a1, a2, a3, a4, a5 = first[0, i], first[1, i], first[2, i], first[3, i], first[4, i], first[5, i]
        # The defect of the first polynomial at s = 1, divided by s⁶ = (1 + (s - 1))⁶.
        d0 = end[0, i] - (((a5 + a4) + a3) + (a2 + a1) + a0)
        d1 = end[1, i] - ((5.0 * a5 + 4.0 * a4) + (3.0 * a3 + 2.0 * a2) + a1)
        d2 = end[2, i] - ((10.0 * a5 + 6.0 * a4) + (3.0 * a3 + a2))
        d3 = end[3, i] - ((10.0 * a5 + 4.0 * a4) + a3)
        d4 = end[4, i] - (5.0 * a5 + a4)
        d5 = end[5, i] - a5
        curve[6, i] = d0
        curve[7, i] = d1 - 6.0 * d0
        curve[8, i] = (d2 - 6.0 * d1) + 21.0 * d0
        curve[9, i] = (d3 - 6.0 * d2) + (21.0 * d1 - 56.0 * d0)
        curve[10, i] = (d4 - 6.0 * d3) + (21.0 * d2 - 56.0 * d1) + 126.0 * d0
        curve[11, i] = (d5 - 6.0 * d4) + (21.0 * d3 - 56.0 * d2) + (126.0 * d1 - 252.0 * d0)
    a, b, c, way = 0.0, 0.0, 0.0, 0.0
    for i in range(4):
        a, b, c = a + curve[9, i] * curve[9, i], b + curve[10, i] * curve[10, i], c + curve[11, i] * curve[11, i]
    turned = 2.0 * MIDDLE * followed(a, b, c)
    if traced:
        a = curve[9, 4] * curve[9, 4] + curve[9, 5] * curve[9, 5]
        b = curve[10, 4] * curve[10, 4] + curve[10, 5] * curve[10, 5]
        c = curve[11, 4] * curve[11, 4] + curve[11, 5] * curve[11, 5]
        way = MIDDLE / radius * followed(a, b, c)
    return turned, way


def followed(a, b, c):
    """Eight times the next coefficient, extrapolated from the squares a, b, c of the last three.

    The last one is taken to be at least half of its extrapolation from the two before.
    """
    if not (a > 0.0 and b > 0.0):
        return 8.0 * sqrt(c)
    c = max(c, 0.25 * b * min(b / a, 1.0))
    return 8.0 * sqrt(c) * min(sqrt(c / b), MOST_GROWN)


def at_part(curve, i, s):
    """The component i at the fraction s of the step."""
    r, power = s - 1.0, s * s
    low = ((curve[5, i] * s + curve[4, i]) * s + curve[3, i]) * s + curve[2, i]
    high = ((curve[11, i] * r + curve[10, i]) * r + curve[9, i]) * r + curve[8, i]
    low, high = (low * s + curve[1, i]) * s + curve[0, i], (high * r + curve[7, i]) * r + curve[6, i]
    return low + power * power * power * high


def ball_at(curve, s, body, traced, found):
    """Writes the ball at the fraction s of the step from `body` into `found`; both are `lanes.MOVING`."""
    q = at_part(curve, 0, s), at_part(curve, 1, s), at_part(curve, 2, s), at_part(curve, 3, s)
    q = scaled_four(1.0 / sqrt(square_of_four(q)), q)
    p = compose(*conjugate(q), *four(body, at.ATTITUDE))  # from the axes at the start of the step to the present axes
    put(found, 0, rotate(*p, *three(body, 0)))
    put(found, 3, rotate(*p, *three(body, 3)))
    put_four(found, at.ATTITUDE, q)
    if traced:
        found[at.SPOT], found[at.SPOT + 1] = at_part(curve, 4, s), at_part(curve, 5, s)


#: The largest |ω|h of a step, in radians: longer steps have errors above 10⁻⁴, or do not converge.
FARTHEST = 1.7
#: A step is repeated if its error exceeds the permitted one by TOO_MUCH, the first step already by TOO_MUCH_FIRST; at
#: most MOST_TRIES times.
TOO_MUCH, TOO_MUCH_FIRST, MOST_TRIES = 15.0, 3.0, 40
#: The value for no bound of a step; and the factor by which a bound grows with each step.
ANYTHING, HOPE = 1e300, 1.05
#: The factor by which a step that does not converge is shortened; the least and the largest factor of the next step.
UNSETTLED, LEAST, MOST = 0.6, 0.3, 2.0
#: A step is kept unless it would change by more than this factor.
ALIKE = 1.15
#: The next step aims at this fraction of the permitted error.
WANTED = 0.4
#: No step is shortened below this |ω|h for its error: there, at order 12, only rounding errors remain, except for rods.
NEAREST = 0.02
#: The ratio between the gain of the last column over the one before and the previous such gain: the median for balls of
#: all shapes; and the largest, for changes that decrease so slowly that their sum is many times the last.
GAIN, MOST_GAIN = 2.0, 8.0
#: The rounding error in the changes by a column: a constant, and a multiple of that of the start.
ROUNDED, ROUNDED_START = 2e-15, 10.0
#: Safety factors for the error of steps: for many steps, and the addition for few.
CAUTIOUS, CAUTIOUS_FEW = 20.0, 32.0
#: The error after t of T seconds may be EARLY + (1 - EARLY) t / T of the accuracy; the permitted error of a step
#: changes with the error so far, between TIGHTER and LOOSER times its first value.
EARLY, TIGHTER, LOOSER = 0.1, 0.02, 2.0
#: The factor between the stated rounding error and the root mean square.
SIGMAS = 2.0
#: The rounding error of a step, in units of that of a start: half the sum of its |weights|, 54.2.
ROUNDINGS = 27.1
#: The rounding error of a long step as a fraction of the effect on ω of rounding K, if that exceeds the root of the
#: condition: the largest error for 2000 starts of heavy balls was then 0.51 of its estimate.
ACROSS = 0.25
#: The rounding error of a step, over `SIGMAS`, in a rotation that is steady to `EVEN`, the sine of the angle from ω to
#: Λω: equal steps have equal rounding errors, which add up.  The largest of 300 steps of |ω|h = 1.7 was 293 times 2⁻⁵³.
ROUNDED_ALIKE, EVEN = 150.0 * 2.0**-53, 1e-2
#: The fraction of an accuracy that the interpolation of frames may use.
BEARABLE = 0.4
#: Steps end at a frame if this leaves them at least this fraction of their length: interpolation costs as much.
TO_A_FRAME = 0.7
#: Frames at the ends of steps, up to this fraction of a step, are not interpolated.
AT_END = 1e-9
#: The report of a ball: the error of the attitude in radians, of ω relative to its largest, and of the contact point in
#: radii; the part due to rounding of steps; the number of steps; and the fraction of the time at which the ball was
#: abandoned, 1 if it was not.
TURNED, SPUN, ROLLED, WALKED, STEPS, UNTIL = 0, 1, 2, 3, 4, 5
REPORTED = 6
#: The numbers of a lane: the present time, its step in seconds, the unit of time of S, the steps left, its ball, the
#: next frame, the tries of this step, the largest |ω| and error of ω so far; the step for which `last` has the series,
#: or 0; the longest step known to converge; and the present |ω| in rad/s.
NOW, STEP, UNIT, COMING, WHICH, NEXT, TRIES, FASTEST, SPINNING, KNOWN, SETTLED, SPEED = (
    0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11,
)  # fmt: skip
#: The present permitted error per second; the frame at which the remaining steps end; and the longest step known to
#: permit interpolation.
ALLOWED, GOAL, SMOOTH = 18, 19, 20
#: For the last step: its fate, the proposed next step, the interpolation errors, and the status and reach of a ball
#: that stops.
FATE, WISH, OFF, OUT, STATUS, REACH = 12, 13, 14, 15, 16, 17
#: The number of consecutive equal steps.
ALIKE_STEPS = 21
LANE = 22
#: The fates of a step: the lane rests; the step is repeated, stops the ball, or is accepted.
RESTING, AGAIN, STOPS, STAYS = 0.0, 1.0, 2.0, 3.0


class Asked(NamedTuple):
    """The request for each ball, (balls,): the length of its first step in seconds, and its permitted error per second.

    most: the permitted error at the end.  start: the rounding error of the start.  Frames are `interval` seconds apart;
    patient: no ball is abandoned.
    """

    first: Vector
    allowed: Vector
    most: Vector
    start: Vector
    interval: float
    patient: bool


class Crew(NamedTuple):
    """The balls that are followed together: S of `lanes`, E of `carried`; of each lane the body, state and numbers.

    ends: the series at the ends of its last step, (2 lanes, TERMS, PARTS); curves: its polynomials.  V, now: workspace.
    """

    S: Matrix
    E: Matrix
    bodies: Matrix
    states: Matrix
    lanes: Matrix
    ends: Cube
    curves: Cube
    V: Matrix
    now: Vector


def steps_in(time, step):
    """The least number of equal steps of about this length, at most, that fill a time."""
    count = int(time / step)
    return max(count if count * step >= time * (1.0 - 1e-9) else count + 1, 1)


def aimed(lane, frames, interval):
    """Divides the time left, or to the next frame if that is long enough, into steps; whether the step changes."""
    goal, step = frames - 1, min(lane[WISH], lane[SMOOTH])
    time = lane[NEXT] * interval - lane[NOW]
    count = steps_in(time, lane[WISH])
    if time >= TO_A_FRAME * step * count:
        goal = int(lane[NEXT])
    else:
        time = goal * interval - lane[NOW]
        count = steps_in(time, step)
    before = lane[STEP]
    lane[GOAL], lane[COMING], lane[STEP] = goal, count, time / count
    if abs(lane[STEP] - before) <= AT_END * before:
        lane[STEP] = before
        return False
    return True


def lengthened(ratio):
    """ratio^(-3/32), ratio the relative size of an error: the factor for the next step at order eleven or twelve."""
    root = sqrt(sqrt(sqrt(sqrt(min(max(ratio, 1e-12), 1e12)))))
    return 1.0 / (root * sqrt(root))


def left(S, b, start):
    """The estimated error of a step, and the sizes of its last three changes: (size, x, y, z).

    The ratio of the error to the last change is assumed to be `GAIN` times the ratio of the last two changes.  A last
    change that is rounding, or smaller than extrapolated from the two before, is replaced by that extrapolation.
    """
    row = at.MOVED + at.TWIST
    x, y, z = length(three_in(S, row, b)), length(three_in(S, row + 3, b)), length(three_in(S, row + 6, b))
    rounded = ROUNDED + ROUNDED_START * start
    last, middle = max(x - rounded, 0.0), max(y - rounded, 0.0)
    if not (middle > 0.0 and z > 0.0):
        return 0.0, x, y, z
    last = max(last, middle * min(middle / z, 1.0))
    ratio = min(last / middle, 1.0)
    return max(GAIN, 1.0 / max(1.0 - ratio, 1.0 / MOST_GAIN)) * last * ratio, x, y, z


def taken_in(crew, B, b, i, frames, balls, weights, asked):
    """Puts the ball i into the lane b; returns the exponent of K."""
    S, body, lane = crew.S, crew.bodies[b], crew.lanes[b]
    placed(body, i, frames)
    lane[:] = 0.0
    lane[WHICH], lane[NEXT], lane[ALLOWED], lane[WISH] = i, 1.0, asked.allowed[i], asked.first[i]
    lane[SETTLED], lane[SMOOTH] = ANYTHING, ANYTHING
    aimed(lane, frames.momenta.shape[1], asked.interval)
    half, exponent = at.begun(body, balls.tensor[i], balls.contact[i], lane[STEP], crew.states[b])
    enter(S, B, b, half, balls.radius[i], weights, body, crew.states[b])
    lane[UNIT] = 2.0 * S[at.LENGTH, b] / lane[STEP]
    begun(crew.E, B, b, three_in(S, at.TENSOR, b), asked.start[i])
    return exponent


def judged(crew, b, lost, start, sums):
    """Decides the fate of a long step, and proposes the next length."""
    S, E, lane = crew.S, crew.E, crew.lanes[b]
    step, tries = lane[STEP], lane[TRIES]
    size = lane[UNIT] * sqrt(square(three_in(S, at.OMEGA, b)))
    lane[SPEED], lane[FATE], lane[OFF], lane[OUT] = size, STAYS, 0.0, 0.0
    if lost and S[at.LOST, b] != 0.0:
        always = S[at.FIRSTS + 3, b] < 0.0  # its products would underflow
        stopped = 0
        if always or tries >= MOST_TRIES:
            stopped, reached = safely(S, b, sums, crew.states[b])
            lane[STATUS], lane[REACH] = stopped, reached
            lane[FATE] = STAYS if stopped == 0 else STOPS
        if tries < MOST_TRIES and (stopped != 0 or not always):
            lane[FATE], lane[SETTLED] = AGAIN, 0.9 * step
    error, x, y, z = left(S, b, start)
    E[PART, b], E[PART + 1, b] = error / x if x > 0.0 else 0.0, error / y if y > 0.0 else 0.0
    E[PART + 2, b], bound = error / z if z > 0.0 else 0.0, lane[ALLOWED] * step
    wanted = min(max(step * lengthened(error / (WANTED * bound)), LEAST * step), MOST * step) if bound > 0.0 else step
    if size > 0.0:
        wanted = max(min(wanted, FARTHEST / size), min(NEAREST / size, step))
    lane[WISH] = min(wanted, lane[SETTLED])
    most = TOO_MUCH if lane[NOW] > 0.0 else TOO_MUCH_FIRST
    if lane[FATE] == AGAIN:
        lane[WISH] = UNSETTLED * step
    elif lane[FATE] == STAYS and error > most * bound and tries < MOST_TRIES:
        lane[FATE], lane[WISH] = AGAIN, min(lane[WISH], UNSETTLED * step)


def part_of(lane, frame, interval):
    """The position of a frame, as a fraction of this step."""
    if frame == lane[GOAL] and lane[COMING] <= 1.0:
        return 1.0
    return (frame * interval - lane[NOW]) / lane[STEP]


def through(crew, b, traced):
    """Writes the polynomials of a step from the body to `now`; returns their estimated errors (`joined`)."""
    S, lane, first, last = crew.S, crew.lanes[b], crew.ends[2 * b], crew.ends[2 * b + 1]
    whole = lane[STEP] * lane[UNIT]
    J, contact, radius = three_in(S, at.TENSOR, b), S[at.CONTACT, b], S[at.RADIUS, b]
    if lane[KNOWN] > 0.0:
        for n in range(TERMS):
            for c in range(PARTS):
                first[n, c] = last[n, c]
        if lane[KNOWN] != whole:
            shortened(first, whole / lane[KNOWN])
    else:
        series(crew.bodies[b], J, contact, radius, whole, traced, crew.V, first)
    series(crew.now, J, contact, radius, whole, traced, crew.V, last)
    return joined(first, last, radius, traced, crew.curves[b])


def spinning(E, B, b):
    """A bound for the change of ω by an error of the attitude: the Frobenius norm of the derivative."""
    found = 0.0
    for lane in range(3):
        for c in range(3):
            found += E[BY_ATTITUDE + c, lane * B + b] * E[BY_ATTITUDE + c, lane * B + b]
    return sqrt(found)


def recorded(crew, B, b, i, end, asked, reported):
    """Reports the errors of a ball after an accepted step, and sets the permitted error of the next steps.

    The errors are the propagated truncation errors and rounding errors.  A ball whose error exceeds its share of the
    accuracy is abandoned, to be followed again from its start with shorter steps, unless rounding dominates or
    `patient`.
    """
    E, lane, allowed, most = crew.E, crew.lanes[b], asked.allowed[i], asked.most[i]
    reported[i, STEPS] += 1.0
    cautious = CAUTIOUS + CAUTIOUS_FEW / reported[i, STEPS]
    off, out, speed = lane[OFF], lane[OUT], lane[SPEED] / lane[UNIT]
    turned, spun, rolled = SIGMAS * E[FOUND + 3, b], SIGMAS * E[FOUND + 4, b], SIGMAS * E[FOUND + 5, b]
    reported[i, WALKED] = max(reported[i, WALKED], turned, rolled)
    turned, rolled = cautious * E[FOUND, b] + turned, cautious * E[FOUND + 2, b] + rolled
    reported[i, TURNED] = max(reported[i, TURNED], turned + off)
    reported[i, ROLLED] = max(reported[i, ROLLED], rolled + out)
    lane[FASTEST] = max(lane[FASTEST], speed)
    left = max(turned, rolled)
    until = min((lane[NOW] + lane[STEP]) / end, 1.0)
    share = EARLY + (1.0 - EARLY) * until
    if left > share * most and reported[i, WALKED] < 0.25 * left and not asked.patient:
        reported[i, UNTIL] = min(until, 1.0 - AT_END)
    lane[ALLOWED] = allowed * min(max(WANTED * most * share / left, TIGHTER), LOOSER) if left > 0.0 else allowed
    lane[SPINNING] = max(lane[SPINNING], cautious * E[FOUND + 1, b] + spun + off * max(speed, spinning(E, B, b)))


def looked_at(crew, B, b, lost, traced, sums, asked):
    """Decides the fate of the step of a lane, and computes its polynomials if it has frames inside."""
    S, E, lane, i = crew.S, crew.E, crew.lanes[b], int(crew.lanes[b, WHICH])
    start, bearable = asked.start[i], BEARABLE * asked.most[i]
    E[WHOLE, b], E[ROUNDING, b] = 0.0, 0.0
    if S[at.RESTS, b] != 0.0:
        lane[FATE] = RESTING
        return
    judged(crew, b, lost, start, sums)
    if lane[FATE] == STAYS:
        inside = part_of(lane, int(lane[NEXT]), asked.interval) < 1.0 - AT_END
        if inside:
            taken_out(S, b, crew.now)
            off, out = through(crew, b, traced)
            speed = lane[SPEED] / lane[UNIT]
            worst = max(off * max(spinning(E, B, b) / speed, 1.0), out) if speed > 0.0 else max(off, out)
            more = max(lengthened(worst / (WANTED * bearable)), LEAST) * lane[STEP]
            lane[SMOOTH], lane[OFF], lane[OUT] = more, off, out
            if worst > bearable and lane[TRIES] < MOST_TRIES:
                lane[FATE], lane[SMOOTH], inside = AGAIN, min(more, UNSETTLED * lane[STEP]), False
        lane[KNOWN] = lane[STEP] * lane[UNIT] if inside else 0.0
    if lane[FATE] == STAYS:
        lane[SMOOTH], lane[SETTLED] = min(HOPE * lane[SMOOTH], ANYTHING), min(HOPE * lane[SETTLED], ANYTHING)
        # The effect on ω of rounding K changes as the body turns.
        rounding = ROUNDINGS * max(start, 2.0 * UNIT_ROUNDING * ACROSS * E[SWAY, b])
        w, s, heavy = three_in(E, FLOW, b), three_in(E, GRADIENT, b), S[at.BALL + 3, b]
        m = w[0] * (S[at.BALL, b] + heavy), w[1] * (S[at.BALL + 1, b] + heavy), w[2] * (S[at.BALL + 2, b] + heavy)
        if dot(s, s) <= EVEN * EVEN * (dot(m, m) * dot(w, w)):
            # The square of a sum of n equal rounding errors is n² times the square of one: the n-th adds 2n - 1 times.
            lane[ALIKE_STEPS] += 1.0
            rounding = max(rounding, ROUNDED_ALIKE) * sqrt(2.0 * lane[ALIKE_STEPS] - 1.0)
        else:
            lane[ALIKE_STEPS] = 0.0
        E[WHOLE, b], E[ROUNDING, b] = lane[STEP] * lane[UNIT], rounding * rounding
        S[at.MOVED + at.DOUBT, b] = 0.0
    else:
        E[PART, b], E[PART + 1, b], E[PART + 2, b] = 0.0, 0.0, 0.0
    if lane[FATE] == AGAIN:
        put_back(S, b, crew.bodies[b])


def follow_lanes(B, frames, balls, asked, weights, outcome, reported):
    """Follows balls from their frames 0 to all other frames.

    outcome: (balls,), with the last frames that are reached.  reported: (balls, REPORTED), 0 with 1 for UNTIL at first.
    """
    S, E, columns = np.zeros((at.ROWS, at.LANES * B)), np.zeros((ERRORS, at.LANES * B)), weights.sums.shape[1]
    states, exponents = np.zeros((B, loop.ROWS)), np.zeros(B, dtype=np.int64)
    bodies, now, found, lanes = np.zeros((B, at.MOVING)), np.zeros(at.MOVING), np.zeros(at.MOVING), np.zeros((B, LANE))
    ends, V, curves = np.zeros((2 * B, TERMS, PARTS)), np.zeros((SERIES, TERMS)), np.zeros((B, 2 * TERMS, PARTS))
    crew = Crew(S, E, bodies, states, lanes, ends, curves, V, now)
    count, kept, traced, interval = frames.momenta.shape[0], frames.momenta.shape[1], frames.traced, asked.interval
    end, coming, busy, fresh = (kept - 1) * interval, min(B, count), min(B, count), True
    for b in range(B):
        exponents[b] = taken_in(crew, B, b, min(b, count - 1), frames, balls, weights, asked)
        S[at.RESTS, b] = 0.0 if b < count else 1.0
    while busy > 0:
        if fresh:
            tangent(S, E, B, 0, traced)
            fresh = False
        lost = at.side_by_side(S, B, traced, weights)
        changes(S, E, B)
        for b in range(B):
            looked_at(crew, B, b, lost, traced, weights.sums, asked)
        tangent(S, E, B, LAST_END, traced)
        carry(S, E, B, traced)
        for b in range(B):
            i, frame, fate, done = int(lanes[b, WHICH]), int(lanes[b, NEXT]), lanes[b, FATE], False
            if fate == AGAIN:
                lanes[b, TRIES] += 1.0
                aimed(lanes[b], kept, interval)
                resized(S, B, b, columns, 0.5 * lanes[b, STEP] * lanes[b, UNIT], bodies[b], states[b])
            elif fate == STOPS:
                outcome.status[i], outcome.reach[i] = int(lanes[b, STATUS]), lanes[b, REACH]
                outcome.taken[i], done = frame - 1, True
                stopped_at(i, frame, frames)
            elif fate == STAYS:
                taken_out(S, b, now)
                part = part_of(lanes[b], frame, interval)
                while frame < kept and part <= 1.0 + AT_END:
                    if abs(part - 1.0) <= AT_END:
                        shown(now, exponents[b], i, frame, frames)
                    else:
                        ball_at(curves[b], part, bodies[b], traced, found)
                        shown(found, exponents[b], i, frame, frames)
                    frame += 1
                    part = part_of(lanes[b], frame, interval)
                recorded(crew, B, b, i, end, asked, reported)
                lanes[b, NEXT], lanes[b, TRIES], lanes[b, NOW] = frame, 0.0, lanes[b, NOW] + lanes[b, STEP]
                lanes[b, COMING] = lanes[b, COMING] - 1.0
                taken_out(S, b, bodies[b])
                there, wish = lanes[b, COMING] < 0.5, min(lanes[b, WISH], lanes[b, SMOOTH])
                alike = wish * ALIKE >= lanes[b, STEP] and wish <= ALIKE * lanes[b, STEP]
                if there:
                    lanes[b, NOW] = lanes[b, GOAL] * interval
                done = there and lanes[b, GOAL] == kept - 1
                if reported[i, UNTIL] < 1.0:
                    outcome.taken[i], outcome.status[i], outcome.reach[i], done = frame - 1, 0, 1.0, True
                elif done:
                    outcome.taken[i], outcome.status[i], outcome.reach[i] = kept - 1, 0, 1.0
                elif (there or not alike) and aimed(lanes[b], kept, interval):
                    resized(S, B, b, columns, 0.5 * lanes[b, STEP] * lanes[b, UNIT], now, states[b])
            if done:
                reported[i, SPUN] = lanes[b, SPINNING] / lanes[b, FASTEST] if lanes[b, FASTEST] > 0.0 else 0.0
                if coming < count:
                    exponents[b] = taken_in(crew, B, b, coming, frames, balls, weights, asked)
                    coming, fresh = coming + 1, True
                else:
                    S[at.RESTS, b] = 1.0
                    busy -= 1


def follow(frames: Frames, balls: Balls, asked: Asked, weights: Weights, ends: Ends, reported: Matrix):
    """`follow_lanes` with eight balls at a time."""
    follow_lanes(at.EIGHT, frames, balls, asked, weights, ends, reported)


def follow_alone(frames: Frames, balls: Balls, asked: Asked, weights: Weights, ends: Ends, reported: Matrix):
    """`follow_lanes` with one ball at a time."""
    follow_lanes(1, frames, balls, asked, weights, ends, reported)
