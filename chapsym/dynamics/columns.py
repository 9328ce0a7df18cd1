"""Many balls without numba: a step is some hundred NumPy calls on columns, into rows that stay in the cache.

It does to each ball what `loop.march` does, with the same roundings: the rounds are generated from the same text.
The lanes that a round does not settle take the safe way one by one, in plain Python.
"""

from typing import Any

import numpy as np
from numpy.typing import DTypeLike

from chapsym.generated.columns import (
    POOL,
    added_columns,
    filtered_columns,
    newton_columns,
    second_columns,
    turn_columns,
)

from .ball import Floats
from .loops.block import PATIENCE
from .loops.gibbs import MOST_ROUNDS, certificate, newton_round, second_round
from .loops.integrals import PERIOD, give, missing, remember, shares
from .loops.loop import ENOUGH, HIGHEST, INTEGRALS, RADIUS, ROWS, SMALLEST, A, D, G, I, J, K, X, safe_rotation

#: Balls in a chunk, at most: its rows, about a hundred, stay in the second-level cache.  Longer dot products than
#: that of three such rows would be shared out to other cores by the BLAS, and wait for them.
LANES = 2560
#: Fewer lanes than this are mended one by one.
FEW = 4
#: Doubles in a line of the cache: rows that begin on one are added and multiplied faster.
LINE = 8
NINE = np.array(9.0)


def march_columns(
    state: Floats, first: int, count: int, every: int, scale: Floats, momenta: Floats, verticals: Floats,
    taken: np.ndarray, status: np.ndarray, reach: Floats,
) -> None:  # fmt: skip
    """`count` steps of a batch from the step `first` on, without numba: what `block.march_block` does, for a chunk.

    state: (ROWS, balls), the rows of `loop`; it moves.
    scale, taken, status, reach: one for each ball, (balls,), with 𝒦 = scale·k; a ball whose status is not 0 rests.
    momenta, verticals: (balls, frames, 3); the frame i gets the state after i·every steps.
    """
    with np.errstate(all="ignore"):  # what a lane without a certificate computes is thrown away
        chunk = Chunk(state, taken, status, reach)
        chunk.march(first, count, every, scale, momenta, verticals)
        state[:] = chunk.states()


def rows(count: int, width: int, dtype: DTypeLike = np.float64) -> Floats:
    """`count` rows of `width` numbers, a multiple of LINE, each on a line of the cache."""
    whole = np.zeros(count * width + LINE, dtype)
    begin = -(whole.ctypes.data // whole.itemsize) % LINE
    return whole[begin : begin + count * width].reshape(count, width)


class Chunk:
    """Some balls, one in each lane: their state S by the rows of `loop`, and the rows that a step writes."""

    def __init__(self, state: Floats, taken: np.ndarray, status: np.ndarray, reach: Floats) -> None:
        self.balls, self.taken, self.status, self.reach = state.shape[1], taken, status, reach
        width = -(-self.balls // LINE) * LINE
        self.S, self.P, self.Z, self.after = (rows(n, width, state.dtype) for n in (ROWS, 7, 6, 6))
        self.checks, self.d, self.pool = (rows(n, width, state.dtype) for n in (4, 3, max(POOL, 18)))
        self.settled, self.near = np.ones(width, dtype=bool), np.ones(width, dtype=bool)
        self.S[:, : self.balls] = state
        #: A lane as numbers of its own type: a float is float64's, and as fast as they come.
        self.numbers = np.ndarray.tolist if state.dtype == np.float64 else list
        self.S[:, self.balls :] = state[:, :1]
        #: The states of the balls that rest: their lanes get a ball that stands still, and so do those to spare.
        self.resting: dict[int, Floats] = {}
        for lane in (*np.flatnonzero(status), *range(self.balls, width)):
            self.rest(int(lane))
        S, P = self.S, self.P
        self.certified = S[RADIUS] >= 0.0
        still = ~(S[K : K + 3].any(axis=0) | S[A : A + 24].any(axis=0))  # they are predicted exactly: d = 0
        self.enough = float(np.where(still, np.inf, S[ENOUGH]).min())
        self.patience = 0
        # Views, made once: the arguments of the rounds, and rows that follow each other as one.
        arguments = [*S[A : A + 3], *S[K : K + 6], *S[I : I + 3], S[D]]
        near, first, second, longer = self.checks
        self.newton = [*arguments, *P, near, *self.d]
        self.second = [*arguments, P[0], *self.after, near, first, *P[1:], second, longer]
        self.turn = [*P[:4], *S[K : K + 6], *self.Z]
        self.flat = [x.reshape(-1) for x in (S[K : K + 6], S[X : X + 6], self.Z, self.pool[12:18])]
        self.filter = [S[A + i : A + i + 3].reshape(-1) for i in range(0, 24, 3)]
        self.sixes = [self.pool[i : i + 6].reshape(-1) for i in (0, 6)]
        self.threes = [self.pool[i : i + 3].reshape(-1) for i in range(0, 12, 3)]
        self.gibbs, self.change = P[4:].reshape(-1), self.d.reshape(-1)

    def states(self) -> Floats:
        """The rows of `loop` for every ball."""
        state = self.S[:, : self.balls].copy()
        for lane, column in self.resting.items():
            if lane < self.balls:
                state[:, lane] = column
        return state

    def rest(self, lane: int) -> None:
        """Keeps the state of a ball that cannot go on, and puts a round one without momentum into its lane."""
        self.resting[lane] = self.S[:, lane].copy()
        self.S[K : K + 3, lane], self.S[X:, lane] = 0.0, 0.0
        self.S[I : I + 3, lane] = 1.0

    def march(self, first: int, count: int, every: int, scale: Floats, momenta: Floats, verticals: Floats) -> None:
        """`march_columns` for these balls."""
        step, last = first, first + count
        while step < last:
            stop = min(last, step + every - step % every, step + PERIOD - step % PERIOD)
            for now in range(step, stop):
                self.step(now)
            step = stop
            if step % PERIOD == 0:
                restore(self.S)
            if step % every == 0:
                going = self.status == 0
                k, g = self.S[K : K + 3, : self.balls], self.S[G : G + 3, : self.balls]
                momenta[going, step // every] = (scale * k).T[going]
                verticals[going, step // every] = g.T[going]
        self.taken[self.status == 0] = last

    def step(self, now: int) -> None:
        """One step of every ball."""
        settled = self.patience == 0 and self.predicted()
        if not settled:
            # A lane without a certificate never settles: no correction helps it.
            if self.patience or (self.certified & ~self.settled).any():
                self.patience = (self.patience or PATIENCE + 1) - 1
                settled = self.corrected()
            if not settled:
                self.mend(now)
        self.turned()

    def predicted(self) -> bool:
        """Every lane's rotation, by a Newton iterate from the extrapolation; whether all settled."""
        newton_columns(*(*self.newton, self.pool))
        np.less_equal(self.checks[0], self.S[RADIUS], self.near)
        # The sum over the chunk first: where it is below the least bound of a lane, no lane need be looked at.
        if self.change.dot(self.change) <= self.enough and self.near.all():
            return True
        x, y, z = np.multiply(self.d, self.d, self.pool[:3])
        self.compare(x + (y + z))
        return bool(self.settled.all())

    def compare(self, first: Floats) -> None:
        """Which lanes are settled by a Newton correction with |d|² = first from where they are near."""
        np.less_equal(first, self.S[ENOUGH], self.settled)
        np.logical_and(self.near, self.settled, self.settled)

    def corrected(self) -> bool:
        """The same with the second correction where it is needed."""
        second_columns(*(*self.second, self.pool))
        near, first, second, longer = self.checks
        np.less_equal(near, self.S[RADIUS], self.near)
        self.compare(first)
        if self.settled.any():
            np.copyto(self.P[1:], self.after, where=self.settled)
        left, right = self.pool[:2]
        np.maximum(first, second, out=left)
        np.multiply(NINE, left, left)
        np.multiply(left, second, left)
        np.multiply(self.S[ENOUGH], self.S[ENOUGH], right)
        self.settled |= self.near & (left <= right) & (longer <= self.S[RADIUS])
        return bool(self.settled.all())

    def mend(self, now: int) -> None:
        """The safe way for the lanes that did not settle; a ball that cannot go on rests from then on."""
        S, P = self.S, self.P
        lanes = np.flatnonzero(~self.settled & self.certified)
        if len(lanes) > FEW:
            guess = np.where(self.near, P[4:], S[A : A + 3])[:, lanes]
            found, P[:, lanes] = search(guess, S[:, lanes], P[:, lanes])
            self.settled[lanes[found]] = True
        for lane in np.flatnonzero(~self.settled).tolist():
            ball = self.numbers(S[:, lane])
            u1, u2, u3 = self.numbers(P[4:, lane]) if self.near[lane] else ball[A : A + 3]
            status, reach, *rotation = safe_rotation(u1, u2, u3, ball)
            self.reach[lane] = reach
            if status == 0:
                P[:, lane] = rotation
            else:
                P[:, lane] = 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
                self.taken[lane], self.status[lane] = now, status
                self.rest(lane)
                self.certified[lane] = True

    def turned(self) -> None:
        """Turns k and γ of every lane, with compensation, and carries the extrapolation on."""
        turn_columns(*(*self.turn, self.pool))
        vectors, rest, change, there = self.flat
        added_columns(vectors, rest, change, there, rest, self.sixes)
        np.copyto(vectors, there)
        filtered_columns(*(*self.filter[1:], self.gibbs, *self.filter, self.threes))


def search(guess: Floats, S: Floats, rotations: Floats) -> tuple[np.ndarray, Floats]:
    """`gibbs.search` from a guess for some lanes at once: which settled, and the rotations (7, n) with theirs."""
    done, rotations = np.zeros(S.shape[1], dtype=bool), rotations.copy()
    for start in (guess, np.zeros_like(guess)):
        u, going = start.copy(), np.flatnonzero(~done)
        for _ in range(MOST_ROUNDS):
            going = going[_squared(u[:, going]) <= S[RADIUS, going]]
            if not len(going):
                break
            settled, found = _settle(u[:, going], S[:, going])
            rotations[:, going[settled]] = found[:, settled]
            done[going[settled]] = True
            u[:, going] = found[4:]
            going = going[~settled]
    return done, rotations


def _settle(u: Floats, S: Floats) -> tuple[np.ndarray, Floats]:
    """`gibbs.settle` for some lanes at once, from inside the ball: which settled, and p and w of all, (7, n)."""
    k, body, enough = S[K : K + 3], (*S[I : I + 3], S[D]), S[ENOUGH]
    p0, *once, first, d1, d2, d3, c11, c12, c13, c21, c22, c23, c31, c32, c33 = newton_round(
        *u, *k, *S[G : G + 3], *body
    )
    *twice, second = second_round(  # type: ignore[call-arg]
        p0, *once[:3], *k, d1, d2, d3, c11, c12, c13, c21, c22, c23, c31, c32, c33, *body[:3]
    )  # fmt: skip
    enough_once = first <= enough
    enough_twice = (9.0 * np.maximum(first, second) * second <= enough * enough) & (_squared(twice[3:]) <= S[RADIUS])
    return enough_once | enough_twice, np.array([p0, *np.where(enough_once, once, twice)])


def _squared(u: Any) -> Floats:
    return u[0] * u[0] + (u[1] * u[1] + u[2] * u[2])


def prepare_columns(momentum: Floats, g: Floats, tensor: Floats, contact: Floats, state: Floats, scale: Floats) -> None:
    """`loop.prepare` of every ball of a chunk: (n, 3), (n, 3), (n, 3), (n,) into state (ROWS, n) and scale (n,).

    Written once more, for rows: ball by ball it would take twice as long, as much as 40 steps.
    """
    pairs = tensor[:, [1, 0, 0]] + tensor[:, [2, 2, 1]]
    exponent = np.frexp(pairs.max(axis=1) + contact)[1]
    largest = np.abs(momentum).max(axis=1)
    exponent = np.maximum(np.minimum(exponent, HIGHEST), np.frexp(largest)[1] - HIGHEST)
    tiny = (largest > 0.0) & (largest < np.ldexp(SMALLEST, exponent))
    exponent = np.where(tiny, np.maximum(-1, exponent - HIGHEST + 1), exponent)
    state[:] = 0.0
    state[K : K + 3], state[G : G + 3] = np.ldexp(momentum.T, -exponent - 1), g.T
    state[J : J + 3], state[D] = np.ldexp(tensor.T, -exponent), np.ldexp(contact, -exponent)
    state[I : I + 3] = state[[J + 1, J, J]] + state[[J + 2, J + 2, J + 1]]
    for lane, numbers in enumerate(state[[K, K + 1, K + 2, I, I + 1, I + 2, D]].T.tolist()):
        state[[RADIUS, ENOUGH], lane] = certificate(*numbers)
    state[RADIUS, tiny | (state[I : I + 3].min(axis=0) < SMALLEST)] = -1.0
    remember(state)
    scale[:] = np.ldexp(1.0, exponent + 1)


def restore(S: Floats) -> None:
    """`integrals.restore` on every lane."""
    lanes = zip(*missing(S), S[INTEGRALS], S[INTEGRALS + 2], S[INTEGRALS + 4], strict=True)
    give(S, *np.array([shares(*lane) for lane in lanes]).T)
