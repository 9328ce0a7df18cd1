"""Balls followed to a rate of error: long steps of a length that each ball chooses for itself, frames in between.

Each lane has a ball with its own step and time; one that has come to its end gives its lane to the next.  What a lane
does depends on its own ball alone, so a ball has the same bits alone and among others.  Plain scalar Python, so that
the same functions run on floats and are compiled.
"""

from math import ldexp, nan, sqrt

import numpy as np

from . import loop
from .between import PARTS, SERIES, TERMS, ball_at, joined, series, shortened
from .carried import DOUBTED, END, ERRORS, INNER, carry, spun_square, tangent, turned_square, way_square
from .lanes import CONTACT, EIGHT, FIRSTS, LANES, LENGTH, LOST, MOVED, OMEGA, RADIUS, RESTS, ROWS, TENSOR, side_by_side
from .long_run import enter, placed, resized, safely
from .long_step import ATTITUDE, DOUBT, MOVING, SPOT
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
#: Of what a column less would have turned a step otherwise this is rounding: a part that all have, and so many times
#: what a start may be off by a rounding.  No step is shortened for an error below it.
ROUNDED, ROUNDINGS = 2e-15, 10.0
#: Nor below this |ω|h: a step of order 12 has nothing but rounding left there, but for a rod.
NEAREST = 0.02
#: How many times as large as a doubt of 10⁻⁸ the error is held to be, of a ball whose condition is ten at most.
FEARED, USUAL = 12.0, 2.0**-52 * 3.16
#: What a step is doubted by at least, so that it is seen how its error grows.
LEAST_DOUBT = 1e-17
#: Frames at the ends of steps, up to this part of a step, are not interpolated.
AT_END = 1e-9
#: What is reported of a ball: the error of the attitude, in radians, of ω, relative to its largest, and of the contact
#: point, in radii; the sum of the errors of its steps; and how many steps it took.
TURNED, SPUN, ROLLED, SUMMED, STEPS = 0, 1, 2, 3, 4
REPORTED = 5
#: Numbers of a lane: the time now, its step in seconds, the unit of time of S, the steps that are left, its ball, the
#: next frame, tries of this step, the largest |ω| and error of ω so far, and the step of the series at its end, 0
#: without; the longest step that settles, as far as it is known; and |ω| now, in rad/s.
NOW, STEP, UNIT, COMING, WHICH, NEXT, TRIES, FASTEST, SPINNING, KNOWN, SETTLED, SPEED = (
    0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11,
)  # fmt: skip
LANE = 12


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
    """The power -3/32 of how large an error is: by which a step of order eleven over ten is to be longer."""
    root = sqrt(sqrt(sqrt(sqrt(min(max(ratio, 1e-12), 1e12)))))
    return 1.0 / (root * sqrt(root))


def feared(doubt, start):
    """The error that a step is held to have made, of how much a column less would have turned it otherwise.

    What the last column gains is less where the steps are long: the error of a step that is in doubt by 10⁻¹² is about
    a tenth of that, and by 10⁻⁶ twice that, on balls of all shapes; and the largest are ten times these.  Six times the
    middle is more than what a run of several steps adds up to.  Of a rod the columns converge later: the root of its
    condition, of which `start` has the root, says by how much.  doubt: without its rounding, which is no error of the
    step, and walks.
    """
    return FEARED * doubt * sqrt(sqrt(sqrt(1e8 * doubt)) * max(start / USUAL, 1.0))


def taken_in(
    S, B, b, columns, i, first, start, momenta, verticals, attitudes, traces, J0, D0, radius, end, follows, sums,
    beginning, body, state, lane, E, reported, traced,
):  # fmt: skip
    """Puts the ball i into the lane b; returns K's exponent."""
    placed(body, i, momenta, verticals, attitudes, traces, follows, traced)
    lane[:] = 0.0
    lane[WHICH], lane[NEXT], lane[SETTLED] = i, 1.0, ANYTHING
    planned(lane, end, first[i])
    exponent = enter(S, B, b, columns, J0[i], D0[i], radius[i], lane[STEP], sums, beginning, body, state)
    lane[UNIT] = 2.0 * S[LENGTH, b] / lane[STEP]
    E[:] = 0.0
    tangent(body, S[TENSOR, b], S[TENSOR + 1, b], S[TENSOR + 2, b], S[CONTACT, b], traced, E, END)
    E[INNER], E[INNER + 3], E[INNER + 5], E[DOUBTED] = start[i], start[i], start[i], start[i]
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


def judged(S, b, lost, allowed, start, sums, state, lane):
    """What to make of a long step: (status, reach, error, again, wanted).

    again: the length of step with which to take it again, or 0.  wanted: that of the next step.
    """
    step, tries = lane[STEP], lane[TRIES]
    size = lane[UNIT] * sqrt(
        S[OMEGA, b] * S[OMEGA, b] + (S[OMEGA + 1, b] * S[OMEGA + 1, b] + S[OMEGA + 2, b] * S[OMEGA + 2, b])
    )
    lane[SPEED] = size
    stopped, reached, again = 0, 1.0, 0.0
    if lost and S[LOST, b] != 0.0:
        heavy = S[FIRSTS + 3, b] < 0.0  # always takes the safe way
        if heavy or tries >= MOST_TRIES:
            stopped, reached = safely(S, b, sums, state)
        if tries < MOST_TRIES and (stopped != 0 or not heavy):
            stopped, again, lane[SETTLED] = 0, UNSETTLED * step, 0.9 * step
    rounded = ROUNDED + ROUNDINGS * start
    error = feared(max(S[MOVED + DOUBT, b] - rounded, 0.0), start)  # of this step alone
    bound = max(allowed * step, LEAST_DOUBT)
    wanted = min(max(step * lengthened(error / (WANTED * bound)), LEAST * step), MOST * step)
    if size > 0.0:
        wanted = max(min(wanted, FARTHEST / size), min(NEAREST / size, step))
    wanted = min(wanted, lane[SETTLED])
    most = TOO_MUCH if lane[NOW] > 0.0 else TOO_MUCH_FIRST
    if again == 0.0 and stopped == 0 and error > most * bound and tries < MOST_TRIES:
        again = min(wanted, UNSETTLED * step)
    return stopped, reached, error, again, wanted


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


def followed(
    S, b, i, traced, error, off, out, now, used, lane, E, reported
):  # fmt: skip
    """Carries the errors of a ball on by a step that stays, and records them; off, out: those between its ends."""
    for c in range(END):
        E[c] = E[END + c]
    tangent(now, S[TENSOR, b], S[TENSOR + 1, b], S[TENSOR + 2, b], S[CONTACT, b], traced, E, END)
    carry(E, 0, END, lane[STEP] * lane[UNIT], max(error, LEAST_DOUBT), traced, used)
    reported[i, TURNED] = max(reported[i, TURNED], sqrt(turned_square(E)) + off)
    reported[i, ROLLED] = max(reported[i, ROLLED], sqrt(way_square(E)) + out)
    reported[i, STEPS] += 1.0
    speed = lane[SPEED] / lane[UNIT]
    lane[FASTEST] = max(lane[FASTEST], speed)
    lane[SPINNING] = max(lane[SPINNING], sqrt(spun_square(E, END)) + off * speed)


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
    S, columns = np.zeros((ROWS, LANES * B)), sums.shape[1]
    states, exponents = np.zeros((B, loop.ROWS)), np.zeros(B, dtype=np.int64)
    bodies, now, found = np.zeros((B, MOVING)), np.zeros(MOVING), np.zeros(MOVING)
    lanes, errors, used = np.zeros((B, LANE)), np.zeros((B, ERRORS)), np.zeros(27)
    ends, V, curve = np.zeros((2 * B, TERMS, PARTS)), np.zeros((SERIES, TERMS)), np.zeros((2 * TERMS, PARTS))
    balls, frames = momenta.shape[0], momenta.shape[1]
    end, coming, busy = (frames - 1) * interval, min(B, balls), min(B, balls)
    for b in range(B):
        i = min(b, balls - 1)
        exponents[b] = taken_in(
            S, B, b, columns, i, first, start, momenta, verticals, attitudes, traces, J0, D0, radius, end, follows,
            sums, beginning, bodies[b], states[b], lanes[b], errors[b], reported, traced,
        )  # fmt: skip
        S[RESTS, b] = 0.0 if b < balls else 1.0
    while busy > 0:
        lost = side_by_side(S, B, columns, traced, following, beginning)
        for b in range(B):
            if S[RESTS, b] == 0.0:
                i = int(lanes[b, WHICH])
                stopped, part, error, again, wanted = judged(
                    S, b, lost, allowed[i], start[i], sums, states[b], lanes[b]
                )
                off, out, inside, done = 0.0, 0.0, False, stopped != 0
                if again == 0.0 and stopped == 0:
                    for c in range(MOVING):
                        now[c] = S[MOVED + c, b]
                    now[DOUBT], S[MOVED + DOUBT, b] = 0.0, 0.0
                    frame = int(lanes[b, NEXT])
                    inside = part_of(lanes[b], frame, frames, interval) < 1.0 - AT_END
                    if inside:
                        off, out = through(
                            S, b, bodies[b], now, traced, lanes[b], V, ends[2 * b], ends[2 * b + 1], curve
                        )
                        more = lengthened(max(off, out) / (WANTED * bearable[i]))
                        wanted = min(wanted, max(more, LEAST) * lanes[b, STEP])
                        if max(off, out) > bearable[i] and lanes[b, TRIES] < MOST_TRIES:
                            again, inside = min(wanted, UNSETTLED * lanes[b, STEP]), False
                    lanes[b, KNOWN] = lanes[b, STEP] * lanes[b, UNIT] if inside else 0.0
                if again > 0.0:
                    for c in range(MOVING):
                        S[MOVED + c, b] = bodies[b, c]
                    lanes[b, TRIES] += 1.0
                    planned(lanes[b], end, again)
                    resized(S, B, b, columns, 0.5 * lanes[b, STEP] * lanes[b, UNIT], bodies[b], states[b])
                elif stopped != 0:
                    frame = int(lanes[b, NEXT])
                    status[i], reach[i], reached[i] = stopped, part, frame - 1
                    stopped_at(i, frame, momenta, verticals, attitudes, traces, follows, traced)
                else:
                    frame = int(lanes[b, NEXT])
                    part = part_of(lanes[b], frame, frames, interval)
                    while frame < frames and part <= 1.0 + AT_END:
                        if abs(part - 1.0) <= AT_END:
                            shown(now, exponents[b], i, frame, momenta, verticals, attitudes, traces, follows, traced)
                        else:
                            ball_at(curve, part, bodies[b], traced, found)
                            shown(found, exponents[b], i, frame, momenta, verticals, attitudes, traces, follows, traced)
                        frame += 1
                        part = part_of(lanes[b], frame, frames, interval)
                    followed(S, b, i, traced, error, off, out, now, used, lanes[b], errors[b], reported)
                    lanes[b, NEXT], lanes[b, TRIES], lanes[b, NOW] = frame, 0.0, lanes[b, NOW] + lanes[b, STEP]
                    lanes[b, COMING], lanes[b, SETTLED] = lanes[b, COMING] - 1.0, HOPE * lanes[b, SETTLED]
                    for c in range(MOVING):
                        bodies[b, c] = now[c]
                    done = lanes[b, COMING] < 0.5
                    if done:
                        reached[i], status[i], reach[i] = frames - 1, 0, 1.0
                    elif not (wanted * ALIKE >= lanes[b, STEP] and wanted <= ALIKE * lanes[b, STEP]) and planned(
                        lanes[b], end, wanted
                    ):
                        resized(S, B, b, columns, 0.5 * lanes[b, STEP] * lanes[b, UNIT], now, states[b])
                if done:
                    reported[i, SPUN] = lanes[b, SPINNING] / lanes[b, FASTEST] if lanes[b, FASTEST] > 0.0 else 0.0
                    reported[i, SUMMED] = errors[b, DOUBTED]
                    if coming < balls:
                        exponents[b] = taken_in(
                            S, B, b, columns, coming, first, start, momenta, verticals, attitudes, traces, J0, D0,
                            radius, end, follows, sums, beginning, bodies[b], states[b], lanes[b], errors[b], reported,
                            traced,
                        )  # fmt: skip
                        coming += 1
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
