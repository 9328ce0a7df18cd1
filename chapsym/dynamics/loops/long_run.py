"""Many long steps of one ball or of eight: the frames in and out, and the safe way where the lanes do not settle."""

from math import ldexp, nan

import numpy as np

from . import loop
from .gibbs import LEFT, certificate, is_heavy
from .lanes import (
    BALL,
    CONTACT,
    DERIVATIVES,
    EIGHT,
    FIRSTS,
    FULL,
    GUESS,
    LANES,
    LENGTH,
    LOST,
    MOVED,
    RADIUS,
    RESTS,
    ROWS,
    SECONDS,
    SPREAD,
    TENSOR,
    side_by_side,
)
from .long_step import ATTITUDE, CHANGES, DOUBT, LAST, MOVING, SPOT, begun, long_step
from .loop import D, I, J
from .text import Cube, Doubles, Integers, Matrix, Vector, out_of_line
from .vectors import four, length, put, put_four, put_in, scaled, three

#: Where the lemma has no radius, none is asked for.
ANYWHERE = 2.0**1000
#: (1.42 · 3)².
BEHIND = 18.2


def placed(body, i, momenta, verticals, attitudes, traces, follows, traced):
    """The ball i as it is at frame 0."""
    body[:] = 0.0
    put(body, 0, three(momenta[i, 0], 0))
    put(body, 3, three(verticals[i, 0], 0))
    body[ATTITUDE] = 1.0
    if follows:
        put_four(body, ATTITUDE, four(attitudes[i, 0], 0))
    if traced:
        body[SPOT], body[SPOT + 1] = traces[i, 0, 0], traces[i, 0, 1]


@out_of_line
def enter(S, B, b, columns, J0, D0, radius, h, sums, beginning, body, state):
    """Puts a ball, of which `body` has all but the scale, into its column of S; returns K's exponent (`begun`)."""
    half, exponent = begun(body, J0, D0, h, state)
    for c in range(MOVING):
        S[MOVED + c, b] = body[c]
    S[LENGTH, b], S[RADIUS, b], S[CONTACT, b], S[RESTS, b] = half, radius, state[D], 0.0
    put_in(S, TENSOR, b, three(state, J))
    least = LAST + 1 - columns
    for lane in range(LANES):
        i, first = lane * B + b, max(LAST - lane, least)
        put_in(S, BALL, i, three(state, I))
        S[BALL + 3, i] = state[D]
        one, two = LAST - lane >= least, lane >= least
        for c in range(DERIVATIVES):
            S[GUESS + c, i] = beginning[first, c]
        for c in range(1 + CHANGES):
            S[FULL + 2 * c, i] = sums[c, first - least] if one else 0.0
            S[FULL + 2 * c + 1, i] = sums[c, lane - least] if two else 0.0
    resized(S, B, b, columns, half, body, state)
    return exponent


def resized(S, B, b, columns, half, body, state):
    """Gives a ball a long step of another length, of which `half` is the half in the unit of S."""
    S[LENGTH, b], least = half, LAST + 1 - columns
    for lane in range(LANES):
        entered(S, FIRSTS, lane * B + b, body, half, max(LAST - lane, least), state)
        entered(S, SECONDS, lane * B + b, body, half, max(lane, least), state)


def entered(S, at, i, body, half, n, state):
    """Half a step of a lane and what goes with it (`FIRSTS`).

    The lemma's radius for the step that is not fitted serves the fitted one, too, as that is shorter: its root is
    nearer to 0, and what is monotone stays so.
    """
    part = half / n
    inertia, contact = three(state, I), state[D]
    spread = 0.5 * (max(*inertia) - min(*inertia))
    k = scaled(part, three(body, 0))
    size = length(k)
    within, _ = certificate(k, inertia, contact)
    least = LEFT * size / (max(*inertia) + contact + spread)
    anywhere = -1.0 if is_heavy(inertia, contact) else ANYWHERE  # a heavy ball takes the safe way
    S[at, i], S[at + 1, i], S[at + 2, i], S[SPREAD, i] = part, 1.0 / part if part != 0.0 else 0.0, size, spread
    S[at + 3, i], S[at + 4, i] = within if within >= 0.0 else anywhere, least * least / BEHIND
    S[at + 5, i] = 1.0 / (n * n)


@out_of_line
def safely(S, b, sums, state):
    """The safe way of a long step for one ball; returns (status, reach)."""
    body = np.empty(MOVING)
    for c in range(MOVING):
        body[c] = S[MOVED + c, b]
    status, reach = long_step(body, S[LENGTH, b], S[RADIUS, b], sums, state)
    for c in range(MOVING):
        S[MOVED + c, b] = body[c]
    return status, reach


def show(S, b, exponent, frame, momenta, verticals, attitudes, traces, follows, going):
    """Writes the state of a ball into one of its frames, or NaN where it is not going any more."""
    for c in range(3):
        momenta[b, frame, c] = ldexp(S[MOVED + c, b], int(exponent)) if going else nan
        verticals[b, frame, c] = S[MOVED + 3 + c, b] if going else nan
    if follows:
        for c in range(4):
            attitudes[b, frame, c] = S[MOVED + ATTITUDE + c, b] if going else nan
        for c in range(2):
            traces[b, frame, c] = S[MOVED + SPOT + c, b] if going else nan


def march_lanes(
    B, momenta, verticals, attitudes, traces, J0, D0, radius, h, steps, every, follows, traced,
    sums, following, beginning, doubt, taken, status, reach,
):  # fmt: skip
    """`steps` long steps of at most B balls from their frames 0, (balls, frames, ...); keeps every `every`-th state.

    follows, traced: whether there are attitudes and traces, and whether the latter are wanted.
    sums: the weights of the columns, and of the differences that the last three make, (1 + CHANGES, columns);
    following, beginning: those of the guesses (`guess`).  doubt, taken, status, reach: of each ball, (balls,).
    """
    S, columns = np.zeros((ROWS, LANES * B)), sums.shape[1]
    states, exponents, body = np.zeros((B, loop.ROWS)), np.zeros(B, dtype=np.int64), np.zeros(MOVING)
    balls = len(status)
    for b in range(B):
        i = min(b, balls - 1)  # lanes beyond the balls repeat the last
        placed(body, i, momenta, verticals, attitudes, traces, follows, traced)
        exponents[b] = enter(S, B, b, columns, J0[i], D0[i], radius[i], h, sums, beginning, body, states[b])
    for step in range(steps):
        if side_by_side(S, B, columns, traced, following, beginning):
            for b in range(B):
                if S[LOST, b] != 0.0 and S[RESTS, b] == 0.0:
                    stopped, reached = safely(S, b, sums, states[b])
                    if stopped != 0:
                        S[RESTS, b] = 1.0
                        if b < balls:
                            status[b], reach[b], taken[b] = stopped, reached, step
        if (step + 1) % every == 0:
            for b in range(balls):
                show(
                    S, b, exponents[b], (step + 1) // every, momenta, verticals, attitudes, traces, follows,
                    status[b] == 0,
                )  # fmt: skip
    for b in range(balls):
        doubt[b] = S[MOVED + DOUBT, b] if status[b] == 0 else nan
        if status[b] == 0:
            taken[b], reach[b] = steps, 1.0


def march_one(
    momenta: Cube, verticals: Cube, attitudes: Cube, traces: Cube, J0: Matrix, D0: Vector, radius: Vector, h: float,
    steps: int, every: int, follows: bool, traced: bool, sums: Matrix, following: Cube, beginning: Matrix,
    doubt: Vector, taken: Integers, status: Integers, reach: Doubles,
):  # fmt: skip
    """`march_lanes` for one ball."""
    march_lanes(
        1, momenta, verticals, attitudes, traces, J0, D0, radius, h, steps, every, follows, traced,
        sums, following, beginning, doubt, taken, status, reach,
    )  # fmt: skip


def march_eight(
    momenta: Cube, verticals: Cube, attitudes: Cube, traces: Cube, J0: Matrix, D0: Vector, radius: Vector, h: float,
    steps: int, every: int, follows: bool, traced: bool, sums: Matrix, following: Cube, beginning: Matrix,
    doubt: Vector, taken: Integers, status: Integers, reach: Doubles,
):  # fmt: skip
    """`march_lanes` for eight balls, or fewer."""
    march_lanes(
        EIGHT, momenta, verticals, attitudes, traces, J0, D0, radius, h, steps, every, follows, traced,
        sums, following, beginning, doubt, taken, status, reach,
    )  # fmt: skip
