"""Balls followed to a rate of error: long steps of a length that each ball chooses for itself, frames in between.

Each lane has a ball with its own step and time; one that has come to its end gives its lane to the next.  What a lane
does depends on its own ball alone, so a ball has the same bits alone and among others.  Plain scalar Python, so that
the same functions run on floats and are compiled.

Within a step the ball is on Hermite's polynomials of degree 11 through its two ends, of order 12 in the step.  The
attitude and the contact point have at each end the value and five derivatives that (2.3) gives.  K and γ stay in space,
so the attitude alone turns them: |K|², ⟨K,γ⟩ and |γ|² are kept to rounding.  At the part s of the step a polynomial is
off by the twelfth derivative over 12! times (s(1 - s))⁶ ≤ 2⁻¹².  The last two coefficients are the eleventh over 11!
and the tenth over 10!: the twelfth is taken to follow as they do, and eight times that is stated as what may be wrong.
"""

from math import sqrt
from typing import NamedTuple

import numpy as np

from chapsym.generated import angular_velocity, compose, rotate

from . import lanes as at
from . import loop
from .carried import END as LAST_END
from .carried import FOUND, GRADIENT, PART, SWAY, UNIT_ROUNDING, WHOLE, begun, carry, changes, tangent
from .carried import ROUNDED as ROUNDING
from .carried import ROWS as ERRORS
from .carried import SPUN as BY_ATTITUDE
from .lanes import Balls, Frames, Weights, enter, placed, put_back, resized, safely, shown, stopped_at, taken_out
from .text import Cube, Doubles, Integers, Matrix, Vector
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

#: Values and derivatives at an end, and of what: the attitude (4), the contact point (2).
TERMS, PARTS = 6, 6
#: Rows of the series of vectors that a run of `series` needs: ω, K, γ, and the horizontals x and y seen from the body.
SPIN, SPACE, UP, EAST, NORTH, ALONG = 0, 3, 6, 9, 12, 15
SERIES = 16
#: (s(1 - s))⁶ at the middle.
MIDDLE = 2.0**-12
#: How many times as large as the one before a coefficient is taken to be.
MOST_GROWN = 8.0


def crossed(V, at, n, i):
    """The coefficient n of the cross product of the series of a vector, in the rows from `at` on, with ω; i: which."""
    j = i + 1 if i < 2 else 0
    k = j + 1 if j < 2 else 0
    found = 0.0
    for m in range(n + 1):
        found += V[at + j, m] * V[SPIN + k, n - m] - V[at + k, m] * V[SPIN + j, n - m]
    return found


def series(body, J, contact, radius, whole, traced, V, end):
    """Taylor's coefficients of the attitude and the contact point at `body`, in parts of a step, into `end` (6, 6).

    body: `lanes.MOVING`.  whole: the step, in the unit of time of K and J.  V (SERIES, TERMS) is used.
    traced: whether the contact point is wanted.
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
        # Λω - D⟨γ,ω⟩γ = K, of which all but the terms of ω itself is known.
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
    """The same coefficients for a step this many times as long."""
    factor = 1.0
    for n in range(1, TERMS):
        factor *= ratio
        for i in range(PARTS):
            end[n, i] *= factor


def joined(first, end, radius, traced, curve):
    """The polynomial through two ends, into `curve` (12, 6): powers of s, and s⁶ times powers of s - 1.

    Returns what may be wrong in between, in radians, and of the contact point in radii.
    """
    for i in range(PARTS if traced else 4):
        for n in range(TERMS):
            curve[n, i] = first[n, i]
        a0, a1, a2, a3, a4, a5 = first[0, i], first[1, i], first[2, i], first[3, i], first[4, i], first[5, i]
        # What the first polynomial lacks at s = 1, over s⁶ = (1 + (s - 1))⁶.
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
    """Eight times the coefficient that comes next, by the squares of the last three.

    Where the last is less than half of what the two before let expect, that half is taken.
    """
    if not (a > 0.0 and b > 0.0):
        return 8.0 * sqrt(c)
    c = max(c, 0.25 * b * min(b / a, 1.0))
    return 8.0 * sqrt(c) * min(sqrt(c / b), MOST_GROWN)


def at_part(curve, i, s):
    """One of the numbers at the part s of the step."""
    r, power = s - 1.0, s * s
    low = ((curve[5, i] * s + curve[4, i]) * s + curve[3, i]) * s + curve[2, i]
    high = ((curve[11, i] * r + curve[10, i]) * r + curve[9, i]) * r + curve[8, i]
    low, high = (low * s + curve[1, i]) * s + curve[0, i], (high * r + curve[7, i]) * r + curve[6, i]
    return low + power * power * power * high


def ball_at(curve, s, body, traced, found):
    """The ball at the part s of the step that began at `body`, into `found`; both `lanes.MOVING`."""
    q = at_part(curve, 0, s), at_part(curve, 1, s), at_part(curve, 2, s), at_part(curve, 3, s)
    q = scaled_four(1.0 / sqrt(square_of_four(q)), q)
    p = compose(*conjugate(q), *four(body, at.ATTITUDE))  # from the axes at the beginning to those of now
    put(found, 0, rotate(*p, *three(body, 0)))
    put(found, 3, rotate(*p, *three(body, 3)))
    put_four(found, at.ATTITUDE, q)
    if traced:
        found[at.SPOT], found[at.SPOT + 1] = at_part(curve, 4, s), at_part(curve, 5, s)


#: The largest |ω|h of a step, in radians: longer ones have errors beyond 10⁻⁴, or do not settle.
FARTHEST = 1.7
#: A step is taken again if its error is this many times what is allowed, the first if it is less; and how often.
TOO_MUCH, TOO_MUCH_FIRST, MOST_TRIES = 15.0, 3.0, 40
#: What is no bound of a step; and by what part the bound grows with each step.
ANYTHING, HOPE = 1e300, 1.05
#: By how much a step that is not settled is shortened, and the next step at least and at most.
UNSETTLED, LEAST, MOST = 0.6, 0.3, 2.0
#: A next step that would be longer or shorter by less than this is as long as the last.
ALIKE = 1.15
#: A next step is to have this part of what is allowed.
WANTED = 0.4
#: No step is shortened below this |ω|h for its error: one of order 12 has nothing but rounding left there, but for a
#: rod.
NEAREST = 0.02
#: How the last column gains on the one before as that on the one before it, in the middle of balls of all shapes; and
#: at most, where the changes fall so slowly that their sum is many times the last.
GAIN, MOST_GAIN = 2.0, 8.0
#: Of the changes that a column makes this is rounding: a part that all have, and this many times that of a start.
ROUNDED, ROUNDED_START = 2e-15, 10.0
#: How many times as large as they leave it the error of steps is held to be, of many and of few.
CAUTIOUS, CAUTIOUS_FEW = 20.0, 32.0
#: What part of an accuracy the error may have after t of T seconds is EARLY + (1 - EARLY) t / T; a step may make so
#: many times less, or more, than was allowed at first, where there is more, or less.
EARLY, TIGHTER, LOOSER = 0.1, 0.02, 2.0
#: How many times the root of their mean square roundings are held to be.
SIGMAS = 2.0
#: The rounding of a step, in roundings of a start: the sum of its |weights|, 54.2, over 2.
ROUNDINGS = 27.1
#: What part of how far a rounding of K moves ω a long step is held to be rounded by, if that is more than the root of
#: the condition: of 2000 starts of heavy balls the largest error was then .51 of its estimate.
ACROSS = 0.25
#: The rounding of a step, over `SIGMAS`, in a rotation that is steady to `carried.STEADY`: its steps are alike, and so
#: are their roundings, which add up.  The largest of 300 steps of |ω|h = 1.7 was 293 times 2⁻⁵³.
ROUNDED_ALIKE = 150.0 * 2.0**-53
#: What part of an accuracy the interpolation of the frames may take.
BEARABLE = 0.4
#: Steps end at a frame if they are at least this part of what they could be: a frame in between costs as much.
TO_A_FRAME = 0.7
#: Frames at the ends of steps, up to this part of a step, are not interpolated.
AT_END = 1e-9
#: What is reported of a ball: the error of the attitude, in radians, of ω, relative to its largest, and of the contact
#: point, in radii; what roundings of its steps may have made of them; how many steps it took; and at which part
#: of the time it was given up, 1 if it was not.
TURNED, SPUN, ROLLED, WALKED, STEPS, UNTIL = 0, 1, 2, 3, 4, 5
REPORTED = 6
#: Numbers of a lane: the time now, its step in seconds, the unit of time of S, the steps that are left, its ball, the
#: next frame, tries of this step, the largest |ω| and error of ω so far, and the step of the series at its end, 0
#: without; the longest step that settles, as far as it is known; and |ω| now, in rad/s.
NOW, STEP, UNIT, COMING, WHICH, NEXT, TRIES, FASTEST, SPINNING, KNOWN, SETTLED, SPEED = (
    0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11,
)  # fmt: skip
#: The error that a step may make in a second as it turns out; the frame at which the steps that are left end; and the
#: longest step that frames in between allow, as far as it is known.
ALLOWED, GOAL, SMOOTH = 18, 19, 20
#: And of its last step: what becomes of it, the step to be taken next, the errors of its frames in between, and the
#: status and reach of a ball that stops.
FATE, WISH, OFF, OUT, STATUS, REACH = 12, 13, 14, 15, 16, 17
#: How many steps in a row were alike.
ALIKE_STEPS = 21
LANE = 22
#: A lane rests; its step is taken again, stops the ball, or stays.
RESTING, AGAIN, STOPS, STAYS = 0.0, 1.0, 2.0, 3.0


class Asked(NamedTuple):
    """The request of each ball, (balls,): the length of its first step, in seconds, and its permitted error a second.

    most: what all of them may have made at the end.  start: how far its start may be off by a rounding.
    """

    first: Vector
    allowed: Vector
    most: Vector
    start: Vector


def steps_in(time, step):
    """The fewest steps of at most about this length that a time is."""
    count = int(time / step)
    return max(count if count * step >= time * (1.0 - 1e-9) else count + 1, 1)


def aimed(lane, frames, interval):
    """Divides the time left, or until the next frame if steps are long enough for it; whether the step changes."""
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
    """The power -3/32 of how large an error is: by which a step of order eleven or twelve is to be longer."""
    root = sqrt(sqrt(sqrt(sqrt(min(max(ratio, 1e-12), 1e12)))))
    return 1.0 / (root * sqrt(root))


def left(S, b, start):
    """The size of the error of a step, and those of its last three changes: (size, x, y, z).

    The last column gains on the one before as that on its own, times `GAIN`.  Where the last change is rounding, or
    smaller than the two before let expect, these say how large it would be.
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


def taken_in(S, E, B, b, i, frames, balls, interval, weights, asked, body, state, lane, reported):
    """Puts the ball i into the lane b; returns K's exponent."""
    placed(body, i, frames)
    lane[:] = 0.0
    lane[WHICH], lane[NEXT], lane[ALLOWED], lane[WISH] = i, 1.0, asked.allowed[i], asked.first[i]
    lane[SETTLED], lane[SMOOTH] = ANYTHING, ANYTHING
    aimed(lane, frames.momenta.shape[1], interval)
    exponent = enter(S, B, b, i, balls, lane[STEP], weights, body, state)
    lane[UNIT] = 2.0 * S[at.LENGTH, b] / lane[STEP]
    begun(E, B, b, three_in(S, at.TENSOR, b), asked.start[i])
    for c in range(REPORTED):
        reported[i, c] = 1.0 if c == UNTIL else 0.0
    return exponent


def judged(S, E, b, lost, start, sums, state, lane):
    """Decides the fate of a long step, and the length of the next."""
    step, tries = lane[STEP], lane[TRIES]
    size = lane[UNIT] * sqrt(square(three_in(S, at.OMEGA, b)))
    lane[SPEED], lane[FATE], lane[OFF], lane[OUT] = size, STAYS, 0.0, 0.0
    if lost and S[at.LOST, b] != 0.0:
        always = S[at.FIRSTS + 3, b] < 0.0  # products of its numbers would underflow
        stopped = 0
        if always or tries >= MOST_TRIES:
            stopped, reached = safely(S, b, sums, state)
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
    """Where a frame is, in parts of this step from its beginning."""
    if frame == lane[GOAL] and lane[COMING] <= 1.0:
        return 1.0
    return (frame * interval - lane[NOW]) / lane[STEP]


def through(S, b, body, now, traced, lane, V, first, last, curve):
    """The polynomials of a step from `body` to `now`; returns what may be wrong of them (`between.joined`)."""
    whole = lane[STEP] * lane[UNIT]
    J, contact, radius = three_in(S, at.TENSOR, b), S[at.CONTACT, b], S[at.RADIUS, b]
    if lane[KNOWN] > 0.0:
        for n in range(TERMS):
            for c in range(PARTS):
                first[n, c] = last[n, c]
        if lane[KNOWN] != whole:
            shortened(first, whole / lane[KNOWN])
    else:
        series(body, J, contact, radius, whole, traced, V, first)
    series(now, J, contact, radius, whole, traced, V, last)
    return joined(first, last, radius, traced, curve)


def spinning(E, B, b):
    """A bound of the change of ω by an error of the attitude: the root of the sum of the squares of its derivative."""
    found = 0.0
    for lane in range(3):
        for c in range(3):
            found += E[BY_ATTITUDE + c, lane * B + b] * E[BY_ATTITUDE + c, lane * B + b]
    return sqrt(found)


def recorded(E, B, b, i, end, allowed, most, patient, lane, reported):
    """Reports the errors of a ball after a step that stays, and says what the next ones may make.

    The errors are what its steps have left, and their roundings.  A ball is given up, so that it is followed again from
    its start with shorter steps, where it has more than its share of an accuracy; not where that is rounding, or where
    one is `patient`.
    """
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
    if left > share * most and reported[i, WALKED] < 0.25 * left and not patient:
        reported[i, UNTIL] = min(until, 1.0 - AT_END)
    lane[ALLOWED] = allowed * min(max(WANTED * most * share / left, TIGHTER), LOOSER) if left > 0.0 else allowed
    lane[SPINNING] = max(lane[SPINNING], cautious * E[FOUND + 1, b] + spun + off * max(speed, spinning(E, B, b)))


def looked_at(
    S, E, B, b, lost, interval, start, bearable, traced, sums, body, state, lane, V, first, last,
    curve, now,
):  # fmt: skip
    """Decides the fate of the step of a lane, and makes the polynomials of one that has frames in between."""
    E[WHOLE, b], E[ROUNDING, b] = 0.0, 0.0
    if S[at.RESTS, b] != 0.0:
        lane[FATE] = RESTING
        return
    judged(S, E, b, lost, start, sums, state, lane)
    if lane[FATE] == STAYS:
        inside = part_of(lane, int(lane[NEXT]), interval) < 1.0 - AT_END
        if inside:
            taken_out(S, b, now)
            off, out = through(S, b, body, now, traced, lane, V, first, last, curve)
            speed = lane[SPEED] / lane[UNIT]
            worst = max(off * max(spinning(E, B, b) / speed, 1.0), out) if speed > 0.0 else max(off, out)
            more = max(lengthened(worst / (WANTED * bearable)), LEAST) * lane[STEP]
            lane[SMOOTH], lane[OFF], lane[OUT] = more, off, out
            if worst > bearable and lane[TRIES] < MOST_TRIES:
                lane[FATE], lane[SMOOTH], inside = AGAIN, min(more, UNSETTLED * lane[STEP]), False
        lane[KNOWN] = lane[STEP] * lane[UNIT] if inside else 0.0
    if lane[FATE] == STAYS:
        lane[SMOOTH], lane[SETTLED] = min(HOPE * lane[SMOOTH], ANYTHING), min(HOPE * lane[SETTLED], ANYTHING)
        # A rounding of K moves ω by more or less as the body turns.
        rounding = ROUNDINGS * max(start, 2.0 * UNIT_ROUNDING * ACROSS * E[SWAY, b])
        if E[GRADIENT, b] == 0.0 and E[GRADIENT + 1, b] == 0.0 and E[GRADIENT + 2, b] == 0.0:
            # The mean squares of n roundings that are one and the same are n² times its square: here the n-th is added.
            lane[ALIKE_STEPS] += 1.0
            rounding = max(rounding, ROUNDED_ALIKE) * sqrt(2.0 * lane[ALIKE_STEPS] - 1.0)
        else:
            lane[ALIKE_STEPS] = 0.0
        E[WHOLE, b], E[ROUNDING, b] = lane[STEP] * lane[UNIT], rounding * rounding
        S[at.MOVED + at.DOUBT, b] = 0.0
    else:
        E[PART, b], E[PART + 1, b], E[PART + 2, b] = 0.0, 0.0, 0.0
    if lane[FATE] == AGAIN:
        put_back(S, b, body)


def follow_lanes(B, frames, balls, interval, asked, patient, weights, reported, reached, status, reach):
    """Balls from their frames 0 to all other frames, `interval` seconds apart.

    patient: whether no ball is given up.  reported (balls, REPORTED), the last frame that was reached, status, reach:
    of each ball.
    """
    S, E, columns = np.zeros((at.ROWS, at.LANES * B)), np.zeros((ERRORS, at.LANES * B)), weights.sums.shape[1]
    states, exponents = np.zeros((B, loop.ROWS)), np.zeros(B, dtype=np.int64)
    bodies, now, found, lanes = np.zeros((B, at.MOVING)), np.zeros(at.MOVING), np.zeros(at.MOVING), np.zeros((B, LANE))
    ends, V, curves = np.zeros((2 * B, TERMS, PARTS)), np.zeros((SERIES, TERMS)), np.zeros((B, 2 * TERMS, PARTS))
    count, kept, traced = frames.momenta.shape[0], frames.momenta.shape[1], frames.traced
    end, coming, busy, fresh = (kept - 1) * interval, min(B, count), min(B, count), True
    for b in range(B):
        exponents[b] = taken_in(
            S, E, B, b, min(b, count - 1), frames, balls, interval, weights, asked, bodies[b], states[b], lanes[b],
            reported,
        )  # fmt: skip
        S[at.RESTS, b] = 0.0 if b < count else 1.0
    while busy > 0:
        if fresh:
            tangent(S, E, B, 0, traced)
            fresh = False
        lost = at.side_by_side(S, B, traced, weights)
        changes(S, E, B)
        for b in range(B):
            i = int(lanes[b, WHICH])
            looked_at(
                S, E, B, b, lost, interval, asked.start[i], BEARABLE * asked.most[i], traced, weights.sums, bodies[b],
                states[b], lanes[b], V, ends[2 * b], ends[2 * b + 1], curves[b], now,
            )  # fmt: skip
        tangent(S, E, B, LAST_END, traced)
        carry(S, E, B, traced)
        for b in range(B):
            i, frame, fate, done = int(lanes[b, WHICH]), int(lanes[b, NEXT]), lanes[b, FATE], False
            if fate == AGAIN:
                lanes[b, TRIES] += 1.0
                aimed(lanes[b], kept, interval)
                resized(S, B, b, columns, 0.5 * lanes[b, STEP] * lanes[b, UNIT], bodies[b], states[b])
            elif fate == STOPS:
                status[i], reach[i], reached[i], done = int(lanes[b, STATUS]), lanes[b, REACH], frame - 1, True
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
                recorded(E, B, b, i, end, asked.allowed[i], asked.most[i], patient, lanes[b], reported)
                lanes[b, NEXT], lanes[b, TRIES], lanes[b, NOW] = frame, 0.0, lanes[b, NOW] + lanes[b, STEP]
                lanes[b, COMING] = lanes[b, COMING] - 1.0
                taken_out(S, b, bodies[b])
                there, wish = lanes[b, COMING] < 0.5, min(lanes[b, WISH], lanes[b, SMOOTH])
                alike = wish * ALIKE >= lanes[b, STEP] and wish <= ALIKE * lanes[b, STEP]
                if there:
                    lanes[b, NOW] = lanes[b, GOAL] * interval
                done = there and lanes[b, GOAL] == kept - 1
                if reported[i, UNTIL] < 1.0:
                    reached[i], status[i], reach[i], done = frame - 1, 0, 1.0, True
                elif done:
                    reached[i], status[i], reach[i] = kept - 1, 0, 1.0
                elif (there or not alike) and aimed(lanes[b], kept, interval):
                    resized(S, B, b, columns, 0.5 * lanes[b, STEP] * lanes[b, UNIT], now, states[b])
            if done:
                reported[i, SPUN] = lanes[b, SPINNING] / lanes[b, FASTEST] if lanes[b, FASTEST] > 0.0 else 0.0
                if coming < count:
                    exponents[b] = taken_in(
                        S, E, B, b, coming, frames, balls, interval, weights, asked, bodies[b], states[b], lanes[b],
                        reported,
                    )  # fmt: skip
                    coming, fresh = coming + 1, True
                else:
                    S[at.RESTS, b] = 1.0
                    busy -= 1


def follow(
    momenta: Cube, verticals: Cube, attitudes: Cube, traces: Cube, J0: Matrix, D0: Vector, radius: Vector,
    interval: float, first: Vector, allowed: Vector, most: Vector, start: Vector, patient: bool, follows: bool,
    traced: bool, sums: Matrix, following: Cube, beginning: Matrix, reported: Matrix, reached: Integers,
    status: Integers, reach: Doubles,
):  # fmt: skip
    """`follow_lanes` in eight lanes."""
    frames, balls = Frames(momenta, verticals, attitudes, traces, follows, traced), Balls(J0, D0, radius)
    asked, weights = Asked(first, allowed, most, start), Weights(sums, following, beginning)
    follow_lanes(at.EIGHT, frames, balls, interval, asked, patient, weights, reported, reached, status, reach)


def follow_alone(
    momenta: Cube, verticals: Cube, attitudes: Cube, traces: Cube, J0: Matrix, D0: Vector, radius: Vector,
    interval: float, first: Vector, allowed: Vector, most: Vector, start: Vector, patient: bool, follows: bool,
    traced: bool, sums: Matrix, following: Cube, beginning: Matrix, reported: Matrix, reached: Integers,
    status: Integers, reach: Doubles,
):  # fmt: skip
    """`follow_lanes` in one lane, of one ball."""
    frames, balls = Frames(momenta, verticals, attitudes, traces, follows, traced), Balls(J0, D0, radius)
    asked, weights = Asked(first, allowed, most, start), Weights(sums, following, beginning)
    follow_lanes(1, frames, balls, interval, asked, patient, weights, reported, reached, status, reach)
