"""Balls followed to a rate of error: long steps of a length that each ball chooses for itself, frames in between.

Each lane has a ball with its own step and time; one that has come to its end gives its lane to the next.  What a lane
does depends on its own ball alone, so a ball has the same bits alone and among others.  Plain scalar Python, so that
the same functions run on floats and are compiled.
"""

from math import ldexp, nan, sqrt

import numpy as np

from . import loop
from .between import PARTS, SERIES, TERMS, ball_at, joined, series, shortened
from .carried import END as LAST_END
from .carried import FOUND, PART, ROUNDED, WHOLE, begun, carry, tangent
from .carried import ROWS as ERRORS
from .lanes import CONTACT, EIGHT, FIRSTS, LANES, LENGTH, LOST, MOVED, OMEGA, RADIUS, RESTS, ROWS, TENSOR, side_by_side
from .long_run import enter, placed, resized, safely
from .long_step import ATTITUDE, DOUBT, MOVING, ROUGH, SPOT
from .text import Cube, Doubles, Integers, Matrix, Vector

#: The largest |ω|h of a step, in radians: at 1.57 its steps of the map fold.
FARTHEST = 1.3
#: A step is taken again if its error is so many times what is allowed, the first already if it is less; and how often.
TOO_MUCH, TOO_MUCH_FIRST, MOST_TRIES = 10.0, 2.0, 40
#: What is no bound of a step; and by what part the bound grows with each step.
ANYTHING, HOPE = 1e300, 1.05
#: By how much a step that is not settled is shortened, and the next step at least and at most.
UNSETTLED, LEAST, MOST = 0.6, 0.3, 2.0
#: A next step that would be longer or shorter by less than this is as long as the last.
ALIKE = 1.15
#: A next step is to have this part of what is allowed.
WANTED = 0.5
#: No step is shortened below this |ω|h for its error: one of order 12 has nothing but rounding left there, but for a
#: rod.
NEAREST = 0.02
#: How the last column gains on the one before as that on the one before it, in the middle of balls of all shapes.
GAIN = 2.0
#: How many times as large as they leave it the error of steps is held to be, of many and of few.
CAUTIOUS, CAUTIOUS_FEW = 4.0, 32.0
#: The rounding of a step, in roundings of a start: the sum of its |weights|, 54.2, over 2.
ROUNDINGS = 27.1
#: Frames at the ends of steps, up to this part of a step, are not interpolated.
AT_END = 1e-9
#: What is reported of a ball: the error of the attitude, in radians, of ω, relative to its largest, and of the contact
#: point, in radii; what roundings of its steps may have made of the attitude; and how many steps it took.
TURNED, SPUN, ROLLED, WALKED, STEPS = 0, 1, 2, 3, 4
REPORTED = 5
#: Numbers of a lane: the time now, its step in seconds, the unit of time of S, the steps that are left, its ball, the
#: next frame, tries of this step, the largest |ω| and error of ω so far, and the step of the series at its end, 0
#: without; the longest step that settles, as far as it is known; and |ω| now, in rad/s.
NOW, STEP, UNIT, COMING, WHICH, NEXT, TRIES, FASTEST, SPINNING, KNOWN, SETTLED, SPEED = (
    0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11,
)  # fmt: skip
#: And of its last step: what becomes of it, the step to be taken next, the errors of its frames in between, and the
#: status and reach of a ball that stops.
FATE, WISH, OFF, OUT, STATUS, REACH = 12, 13, 14, 15, 16, 17
LANE = 18
#: A lane rests; its step is taken again, stops the ball, or stays.
RESTING, AGAIN, STOPS, STAYS = 0.0, 1.0, 2.0, 3.0


def planned(lane, end, step):
    """Divides the time that is left into steps of at most about this length; returns whether the step changes."""
    left = end - lane[NOW]
    count = int(left / step)
    if count * step < left * (1.0 - 1e-9):
        count += 1
    before = lane[STEP]
    lane[COMING] = max(count, 1)
    lane[STEP] = left / lane[COMING]
    return lane[STEP] != before


def lengthened(ratio):
    """The power -3/32 of how large an error is: by which a step of order eleven or twelve is to be longer."""
    root = sqrt(sqrt(sqrt(sqrt(min(max(ratio, 1e-12), 1e12)))))
    return 1.0 / (root * sqrt(root))


def left(doubt, rough):
    """What part of `TWIST` the error of a step is: the last column gains as the one before, up to `GAIN`."""
    return GAIN * min(doubt / rough, 1.0) if rough > 0.0 else 0.0


def taken_in(
    S, E, B, b, columns, i, first, start, momenta, verticals, attitudes, traces, J0, D0, radius, end, follows, sums,
    beginning, body, state, lane, reported, traced,
):  # fmt: skip
    """Puts the ball i into the lane b; returns K's exponent."""
    placed(body, i, momenta, verticals, attitudes, traces, follows, traced)
    lane[:] = 0.0
    lane[WHICH], lane[NEXT], lane[SETTLED] = i, 1.0, ANYTHING
    planned(lane, end, first[i])
    exponent = enter(S, B, b, columns, J0[i], D0[i], radius[i], lane[STEP], sums, beginning, body, state)
    lane[UNIT] = 2.0 * S[LENGTH, b] / lane[STEP]
    begun(E, B, b, S[TENSOR, b], S[TENSOR + 1, b], S[TENSOR + 2, b], start[i])
    for c in range(REPORTED):
        reported[i, c] = 0.0
    return exponent


def shown(body, exponent, i, frame, momenta, verticals, attitudes, traces, follows, traced):
    """Writes a ball into one of its frames."""
    for c in range(3):
        momenta[i, frame, c], verticals[i, frame, c] = ldexp(body[c], int(exponent)), body[3 + c]
    if follows:
        for c in range(4):
            attitudes[i, frame, c] = body[ATTITUDE + c]
    if traced:
        traces[i, frame, 0], traces[i, frame, 1] = body[SPOT], body[SPOT + 1]


def stopped_at(i, frame, momenta, verticals, attitudes, traces, follows, traced):
    """Writes NaN into the frames of a ball from one on."""
    momenta[i, frame:] = nan
    verticals[i, frame:] = nan
    if follows:
        attitudes[i, frame:] = nan
    if traced:
        traces[i, frame:] = nan


def judged(S, b, lost, allowed, sums, state, lane):
    """Decides the fate of a long step, and the length of the next; returns what part its error is of `TWIST`."""
    step, tries = lane[STEP], lane[TRIES]
    size = lane[UNIT] * sqrt(
        S[OMEGA, b] * S[OMEGA, b] + (S[OMEGA + 1, b] * S[OMEGA + 1, b] + S[OMEGA + 2, b] * S[OMEGA + 2, b])
    )
    lane[SPEED], lane[FATE], lane[OFF], lane[OUT] = size, STAYS, 0.0, 0.0
    if lost and S[LOST, b] != 0.0:
        heavy = S[FIRSTS + 3, b] < 0.0  # always takes the safe way
        stopped = 0
        if heavy or tries >= MOST_TRIES:
            stopped, reached = safely(S, b, sums, state)
            lane[STATUS], lane[REACH] = stopped, reached
            lane[FATE] = STAYS if stopped == 0 else STOPS
        if tries < MOST_TRIES and (stopped != 0 or not heavy):
            lane[FATE], lane[SETTLED] = AGAIN, 0.9 * step
    part = left(S[MOVED + DOUBT, b], S[MOVED + ROUGH, b])
    error, bound = part * S[MOVED + DOUBT, b], allowed * step
    wanted = min(max(step * lengthened(error / (WANTED * bound)), LEAST * step), MOST * step) if bound > 0.0 else step
    if size > 0.0:
        wanted = max(min(wanted, FARTHEST / size), min(NEAREST / size, step))
    lane[WISH] = min(wanted, lane[SETTLED])
    most = TOO_MUCH if lane[NOW] > 0.0 else TOO_MUCH_FIRST
    if lane[FATE] == AGAIN:
        lane[WISH] = UNSETTLED * step
    elif lane[FATE] == STAYS and error > most * bound and tries < MOST_TRIES:
        lane[FATE], lane[WISH] = AGAIN, min(lane[WISH], UNSETTLED * step)
    return part


def part_of(lane, frame, frames, interval):
    """Where a frame is, in parts of this step from its beginning."""
    if frame == frames - 1 and lane[COMING] <= 1.0:
        return 1.0
    return (frame * interval - lane[NOW]) / lane[STEP]


def through(S, b, body, now, traced, lane, V, first, last, curve):
    """The polynomials of a step from `body` to `now`; returns what may be wrong of them (`between.joined`)."""
    whole = lane[STEP] * lane[UNIT]
    J1, J2, J3, contact, radius = S[TENSOR, b], S[TENSOR + 1, b], S[TENSOR + 2, b], S[CONTACT, b], S[RADIUS, b]
    if lane[KNOWN] > 0.0:
        for n in range(TERMS):
            for c in range(PARTS):
                first[n, c] = last[n, c]
        if lane[KNOWN] != whole:
            shortened(first, whole / lane[KNOWN])
    else:
        series(body, J1, J2, J3, contact, radius, whole, traced, V, first)
    series(now, J1, J2, J3, contact, radius, whole, traced, V, last)
    return joined(first, last, radius, traced, curve)


def recorded(E, b, i, lane, reported):
    """Reports the errors of a ball after a step that stays: what its steps have left, and their roundings."""
    reported[i, STEPS] += 1.0
    cautious = CAUTIOUS + CAUTIOUS_FEW / reported[i, STEPS]
    off, out, speed = lane[OFF], lane[OUT], lane[SPEED] / lane[UNIT]
    reported[i, WALKED] = max(reported[i, WALKED], E[FOUND + 3, b])
    reported[i, TURNED] = max(reported[i, TURNED], cautious * E[FOUND, b] + E[FOUND + 3, b] + off)
    reported[i, ROLLED] = max(reported[i, ROLLED], cautious * E[FOUND + 2, b] + E[FOUND + 5, b] + out)
    lane[FASTEST] = max(lane[FASTEST], speed)
    lane[SPINNING] = max(lane[SPINNING], cautious * E[FOUND + 1, b] + E[FOUND + 4, b] + off * speed)


def looked_at(
    S, E, B, b, lost, frames, interval, allowed, start, bearable, traced, sums, body, state, lane, V, first, last,
    curve, now,
):  # fmt: skip
    """Decides the fate of the step of a lane, and makes the polynomials of one that has frames in between."""
    E[WHOLE, b], E[PART, b], E[ROUNDED, b] = 0.0, 0.0, 0.0
    if S[RESTS, b] != 0.0:
        lane[FATE] = RESTING
        return
    part = judged(S, b, lost, allowed, sums, state, lane)
    if lane[FATE] == STAYS:
        inside = part_of(lane, int(lane[NEXT]), frames, interval) < 1.0 - AT_END
        if inside:
            for c in range(MOVING):
                now[c] = S[MOVED + c, b]
            off, out = through(S, b, body, now, traced, lane, V, first, last, curve)
            more = lengthened(max(off, out) / (WANTED * bearable))
            lane[WISH], lane[OFF], lane[OUT] = min(lane[WISH], max(more, LEAST) * lane[STEP]), off, out
            if max(off, out) > bearable and lane[TRIES] < MOST_TRIES:
                lane[FATE], lane[WISH], inside = AGAIN, min(lane[WISH], UNSETTLED * lane[STEP]), False
        lane[KNOWN] = lane[STEP] * lane[UNIT] if inside else 0.0
    if lane[FATE] == STAYS:
        rounding = ROUNDINGS * start
        E[WHOLE, b], E[PART, b], E[ROUNDED, b] = lane[STEP] * lane[UNIT], part, rounding * rounding
        S[MOVED + DOUBT, b] = 0.0
    elif lane[FATE] == AGAIN:
        for c in range(MOVING):
            S[MOVED + c, b] = body[c]


def follow_lanes(
    B, momenta, verticals, attitudes, traces, J0, D0, radius, interval, first, allowed, start, bearable, follows,
    traced, sums, following, beginning, reported, reached, status, reach,
):  # fmt: skip
    """Balls from their frames 0, (balls, frames, ...), to all other frames, `interval` seconds apart.

    first: the length of the first step of each ball, in seconds; allowed: the error that it may make in a second;
    start: how far its start may be off by a rounding; bearable: how far frames may be off by their interpolation.
    follows, traced, sums, following, beginning: as of `long_run.march_lanes`.
    reported (balls, REPORTED), the last frame that was reached, status, reach: of each ball.
    """
    S, E, columns = np.zeros((ROWS, LANES * B)), np.zeros((ERRORS, LANES * B)), sums.shape[1]
    states, exponents = np.zeros((B, loop.ROWS)), np.zeros(B, dtype=np.int64)
    bodies, now, found, lanes = np.zeros((B, MOVING)), np.zeros(MOVING), np.zeros(MOVING), np.zeros((B, LANE))
    ends, V, curves = np.zeros((2 * B, TERMS, PARTS)), np.zeros((SERIES, TERMS)), np.zeros((B, 2 * TERMS, PARTS))
    balls, frames = momenta.shape[0], momenta.shape[1]
    end, coming, busy, fresh = (frames - 1) * interval, min(B, balls), min(B, balls), True
    for b in range(B):
        i = min(b, balls - 1)
        exponents[b] = taken_in(
            S, E, B, b, columns, i, first, start, momenta, verticals, attitudes, traces, J0, D0, radius, end, follows,
            sums, beginning, bodies[b], states[b], lanes[b], reported, traced,
        )  # fmt: skip
        S[RESTS, b] = 0.0 if b < balls else 1.0
    while busy > 0:
        if fresh:
            tangent(S, E, B, 0, traced)
            fresh = False
        lost = side_by_side(S, B, columns, traced, following, beginning)
        for b in range(B):
            i = int(lanes[b, WHICH])
            looked_at(
                S, E, B, b, lost, frames, interval, allowed[i], start[i], bearable[i], traced, sums, bodies[b],
                states[b], lanes[b], V, ends[2 * b], ends[2 * b + 1], curves[b], now,
            )  # fmt: skip
        tangent(S, E, B, LAST_END, traced)
        carry(S, E, B, traced)
        for b in range(B):
            i, frame, fate, done = int(lanes[b, WHICH]), int(lanes[b, NEXT]), lanes[b, FATE], False
            if fate == AGAIN:
                lanes[b, TRIES] += 1.0
                planned(lanes[b], end, lanes[b, WISH])
                resized(S, B, b, columns, 0.5 * lanes[b, STEP] * lanes[b, UNIT], bodies[b], states[b])
            elif fate == STOPS:
                status[i], reach[i], reached[i], done = int(lanes[b, STATUS]), lanes[b, REACH], frame - 1, True
                stopped_at(i, frame, momenta, verticals, attitudes, traces, follows, traced)
            elif fate == STAYS:
                for c in range(MOVING):
                    now[c] = S[MOVED + c, b]
                part = part_of(lanes[b], frame, frames, interval)
                while frame < frames and part <= 1.0 + AT_END:
                    if abs(part - 1.0) <= AT_END:
                        shown(now, exponents[b], i, frame, momenta, verticals, attitudes, traces, follows, traced)
                    else:
                        ball_at(curves[b], part, bodies[b], traced, found)
                        shown(found, exponents[b], i, frame, momenta, verticals, attitudes, traces, follows, traced)
                    frame += 1
                    part = part_of(lanes[b], frame, frames, interval)
                recorded(E, b, i, lanes[b], reported)
                lanes[b, NEXT], lanes[b, TRIES], lanes[b, NOW] = frame, 0.0, lanes[b, NOW] + lanes[b, STEP]
                lanes[b, COMING], lanes[b, SETTLED] = lanes[b, COMING] - 1.0, min(HOPE * lanes[b, SETTLED], ANYTHING)
                for c in range(MOVING):
                    bodies[b, c] = now[c]
                done, wish = lanes[b, COMING] < 0.5, lanes[b, WISH]
                if done:
                    reached[i], status[i], reach[i] = frames - 1, 0, 1.0
                elif not (wish * ALIKE >= lanes[b, STEP] and wish <= ALIKE * lanes[b, STEP]) and planned(
                    lanes[b], end, wish
                ):
                    resized(S, B, b, columns, 0.5 * lanes[b, STEP] * lanes[b, UNIT], now, states[b])
            if done:
                reported[i, SPUN] = lanes[b, SPINNING] / lanes[b, FASTEST] if lanes[b, FASTEST] > 0.0 else 0.0
                if coming < balls:
                    exponents[b] = taken_in(
                        S, E, B, b, columns, coming, first, start, momenta, verticals, attitudes, traces, J0, D0,
                        radius, end, follows, sums, beginning, bodies[b], states[b], lanes[b], reported, traced,
                    )  # fmt: skip
                    coming, fresh = coming + 1, True
                else:
                    S[RESTS, b] = 1.0
                    busy -= 1


def follow_one(
    momenta: Cube, verticals: Cube, attitudes: Cube, traces: Cube, J0: Matrix, D0: Vector, radius: Vector, interval:
    float, first: Vector, allowed: Vector, start: Vector, bearable: Vector, follows: bool, traced: bool, sums:
    Matrix, following: Cube, beginning: Matrix, reported: Matrix, reached: Integers, status: Integers, reach: Doubles,
):  # fmt: skip
    """`follow_lanes` in one lane."""
    follow_lanes(
        1, momenta, verticals, attitudes, traces, J0, D0, radius, interval, first, allowed, start, bearable,
        follows, traced, sums, following, beginning, reported, reached, status, reach,
    )  # fmt: skip


def follow_eight(
    momenta: Cube, verticals: Cube, attitudes: Cube, traces: Cube, J0: Matrix, D0: Vector, radius: Vector, interval:
    float, first: Vector, allowed: Vector, start: Vector, bearable: Vector, follows: bool, traced: bool, sums:
    Matrix, following: Cube, beginning: Matrix, reported: Matrix, reached: Integers, status: Integers, reach: Doubles,
):  # fmt: skip
    """`follow_lanes` in eight lanes."""
    follow_lanes(
        EIGHT, momenta, verticals, attitudes, traces, J0, D0, radius, interval, first, allowed, start, bearable,
        follows, traced, sums, following, beginning, reported, reached, status, reach,
    )  # fmt: skip
