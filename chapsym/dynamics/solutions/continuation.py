"""Branches along a path of momenta, their folds, and the distance of a state from a fold, for batches.

The balls of a batch are continued together along a segment of momenta, each to its end or to a fold.  The chart and the
step length are those of `branch`: around a root p on the segment 𝒦(t) = A + tE write q ∝ p ∘ (1, w); F(w) = 𝒦(p ∘ (1,
w), γ) - 𝒦(t)(1 + |w|²) is quadratic, and a step is as long as the Newton-Kantorovich test allows.  Near a fold the
steps shrink with the distance; then Newton's iteration on the extended system F = 0, det F' = 0 in (w, t) finds the
fold: the system is regular if the fold is simple.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import prod

import numpy as np
from numpy.typing import ArrayLike

from chapsym.generated import compose, residual, tangent_hessian, tangent_jacobian

from ..ball import UNIT_TOLERANCE, Ball, Floats, batch, callback, largest_moment, numbers, over_states, unit_vertical
from ..errors import BadInput, Status
from ..levels.frames import after
from ..loops.branch import CONTRACTION, ROUNDINGS, SETTLED, SINGULAR, SMALLEST, UNIT_ROUNDOFF
from ..shown import Brief

#: The march towards a fold ends at a step below this fraction of the way; then Newton's iteration takes over.
NEAR_FOLD = 1e-6
#: The largest distance of the fold from the end of the march, as a fraction of the way: some steps.
AHEAD = 1e-2
MOST_STEPS = 5000
#: Log₂ of a momentum beyond all rotations, for Λmax below 1.
BEYOND = 3
MOST_CORRECTIONS = 12
#: The largest number of Newton iterations on the extended system, and the correction that is the last one.
MOST_EXTENDED = 12
CLOSE = 1e-8
#: The largest accepted distance of a given rotation from a root.
AT_THE_ROOT = 1e-6
#: The indices of the second derivatives 11, 22, 33, 23, 13, 12 in a symmetric matrix.
PAIR = np.array([[0, 5, 4], [5, 1, 3], [4, 3, 2]])


@dataclass(frozen=True, eq=False, repr=False)
class Fold(Brief):
    """The fold of a branch, for one ball or a batch with the leading axes (...).

    Attributes
    ----------
    reach : numpy.ndarray
        The parameter t of the path at the fold, shape (...).
    rotation : numpy.ndarray
        The Euler parameters at the fold, q0 ≥ 0, shape (..., 4).
    settled : numpy.ndarray
        Whether Newton's iteration found a simple fold, shape (...).  Otherwise the Jacobian is singular near `reach`,
        which is a lower bound, as at a crossing of branches; or `reach` and `rotation` are NaN.

    Examples
    --------
    >>> import chapsym
    >>> found = chapsym.fold(chapsym.Ball((1, 2, 4), 3), (0.1, 0, 0), (0, 0, 1))
    >>> found.rotation.round(6).tolist(), bool(found.settled)
    ([0.707107, 0.707107, 0.0, 0.0], True)
    """

    reach: Floats
    rotation: Floats
    settled: np.ndarray


@dataclass(frozen=True, eq=False, repr=False)
class Followed(Brief):
    """A branch along a path of m momenta, for one ball or a batch with the leading axes (...).

    Attributes
    ----------
    rotation : numpy.ndarray
        The Euler parameters at each of the momenta, q0 ≥ 0, shape (..., m, 4), NaN beyond a fold.
    status : numpy.ndarray
        TAKEN if the end was reached, FOLDED if not, NOT_CONVERGED if float64 cannot decide, shape (...).
    reach : numpy.ndarray
        The end of the branch: k + s at the fraction s between the momenta k and k + 1, shape (...).
    fold : Fold
        The folds, NaN for branches without one.

    Examples
    --------
    >>> import chapsym
    >>> path = [(0, 0, 0), (5, 0, 0), (10, 0, 0)]
    >>> found = chapsym.follow(chapsym.Ball((1, 2, 4), 3), path, (0, 0, 1))
    >>> found.rotation[:, 0].round(6).tolist()
    [1.0, 0.956943, nan]
    """

    rotation: Floats
    status: np.ndarray
    reach: Floats
    fold: Fold


@np.errstate(all="ignore")  # an overflow does not converge: `status` reports it
def follow(
    ball: Ball,
    path: ArrayLike,
    gamma: ArrayLike,
    rotation: ArrayLike = (1.0, 0.0, 0.0, 0.0),
    *,
    progress: Callable[[int], None] = lambda lines_done: None,
) -> Followed:
    """Continues the rotation with the first momentum of a path along straight lines from each momentum to the next.

    A line that takes more than 5000 steps, as it may for very unlike moments, ends as NOT_CONVERGED.

    Parameters
    ----------
    ball : Ball
        One ball or a batch, (...), in principal axes.
    path : array_like
        Momenta 𝒦 in kg m², shape (..., m, 3), m ≥ 2.
    gamma : array_like
        Unit verticals upwards, shape (..., 3).
    rotation : array_like, optional
        A solution of (5.2) for the first momentum, shape (..., 4): by default the identity, which has the momentum 0.
        All broadcast with the balls.
    progress : callable, optional
        Called after each step with the lines that have ended so far, of all balls together.

    Returns
    -------
    Followed

    Raises
    ------
    BadInput
        As `step` does, and for a rotation that does not have the first momentum or is singular there.

    References
    ----------
    Equation (5.2) of Fedorov (2007).

    Examples
    --------
    >>> import chapsym
    >>> path = [(0, 0, 0), (5, 0, 0), (10, 0, 0)]
    >>> found = chapsym.follow(chapsym.Ball((1, 2, 4), 3), path, (0, 0, 1))
    >>> chapsym.Status(found.status).name, round(float(found.reach), 6)
    ('FOLDED', 1.8)
    """
    callback(progress)
    points = numbers(path, "path", 3)
    if points.ndim < 2 or points.shape[-2] < 2:
        raise BadInput(f"path must have the shape (..., m, 3) with at least 2 momenta, not {points.shape}")
    shape, (first, g, J, D) = batch(ball, points[..., 0, :], unit_vertical(gamma))
    m = points.shape[-2]
    K = np.broadcast_to(points, (*shape, m, 3)).reshape(-1, m, 3)
    marchers = Marchers.at(rotation, shape, first, g, J, D)
    n = len(D)
    rotations, reach = np.full((n, m, 4), np.nan), np.zeros(n)
    rotations[:, 0] = marchers.q
    status = np.where(marchers.regular(), Status.TAKEN, Status.NOT_CONVERGED)
    fold = Fold(np.full(n, np.nan), np.full((n, 4), np.nan), np.zeros(n, dtype=bool))
    for k in range(m - 1):
        on = np.flatnonzero(status == Status.TAKEN)
        part = marchers.only(on)
        t, status[on] = part.march(K[on, k], K[on, k + 1], after((k + 1) * n - len(on), progress))
        marchers.q[on], reach[on] = part.q, k + t
        arrived = on[status[on] == Status.TAKEN]
        rotations[arrived, k + 1] = marchers.q[arrived]
        stopped = np.flatnonzero(status[on] == Status.FOLDED)
        if len(stopped):
            ends = on[stopped]
            s, q, settled = part.only(stopped).fold(K[ends, k], K[ends, k + 1], t[stopped])
            fold.reach[ends], fold.rotation[ends], fold.settled[ends] = k + s, q, settled
            reach[ends] = k + s
    return Followed(
        _upright(rotations).reshape(*shape, m, 4), status.reshape(shape), reach.reshape(shape),
        Fold(fold.reach.reshape(shape), _upright(fold.rotation).reshape(*shape, 4), fold.settled.reshape(shape)),
    )  # fmt: skip


@np.errstate(over="ignore", under="ignore")
def fold(
    ball: Ball,
    momentum: ArrayLike,
    gamma: ArrayLike,
    rotation: ArrayLike | None = None,
    *,
    progress: Callable[[int], None] = lambda balls_done: None,
) -> Fold:
    """The fold of a branch along t𝒦: the largest t to which the branch can be continued, and the rotation there.

    There always is a fold, as |𝒦| ≤ 2Λmax for every rotation; if `follow` does not converge before it, reach is NaN.  A
    reach beyond the range of float64 is inf.

    Parameters
    ----------
    ball : Ball
        One ball or a batch, (...), in principal axes.
    momentum : array_like
        𝒦 in kg m², shape (..., 3).
    gamma : array_like
        Unit verticals upwards, shape (..., 3).
    rotation : array_like, optional
        A solution of (5.2) for 𝒦, shape (..., 4), which is continued from t = 1 upwards; by default the small rotation,
        from t = 0.
    progress : callable, optional
        Called after each step with the balls whose branch has ended so far.

    Returns
    -------
    Fold

    Raises
    ------
    BadInput
        As `follow` does, and for a momentum of 0.

    References
    ----------
    Equation (5.2) of Fedorov (2007).

    Examples
    --------
    >>> import chapsym
    >>> found = chapsym.fold(chapsym.Ball((1, 2, 4), 3), (0.1, 0, 0), (0, 0, 1))
    >>> round(float(found.reach), 6)
    90.0
    """
    K = numbers(momentum, "momentum", 3)
    shape, (flat, _, J, D) = batch(ball, K, unit_vertical(gamma))
    size = np.abs(flat).max(axis=1)
    if not (size > 0).all():
        raise BadInput("momentum must not be 0: a branch folds along t times the momentum")
    # |𝒦| ≤ 2Λmax, as is every component: at 4Λmax every branch has folded.
    start = np.full(len(D), 0.0 if rotation is None else 1.0)
    end = np.maximum(4 * largest_moment(J, D), 2 * start * size)
    if not np.isfinite(end).all():
        raise BadInput("the ball or its momentum is too near to the range of float64 for a fold; take other units")
    path = np.stack([start[:, np.newaxis] * flat, end[:, np.newaxis] * (flat / size[:, np.newaxis])], axis=1)
    turn = (1.0, 0.0, 0.0, 0.0) if rotation is None else rotation
    found = follow(ball, path.reshape(*shape, 2, 3), gamma, turn, progress=progress).fold
    reach = start + found.reach.reshape(-1) * (end / size - start)
    return Fold(reach.reshape(shape), found.rotation, found.settled)


def margin(
    ball: Ball,
    momentum: ArrayLike,
    gamma: ArrayLike,
    rotation: ArrayLike | None = None,
    *,
    progress: Callable[[int], None] = lambda balls_done: None,
) -> Floats:
    """The relative increase of the momentum at which the branch of a state folds: t - 1 for the fold at t𝒦.

    Parameters
    ----------
    ball : Ball
        One ball or a batch, (...), in principal axes.
    momentum : array_like
        𝒦 in kg m², shape (..., 3).
    gamma : array_like
        Unit verticals upwards, shape (..., 3).
    rotation : array_like, optional
        As for `fold`.
    progress : callable, optional
        As for `fold`.

    Returns
    -------
    numpy.ndarray
        Shape (...).  Negative if the small-rotation branch folds before it reaches 𝒦, NaN if float64 cannot decide.

    Raises
    ------
    BadInput
        As `fold` does.

    Examples
    --------
    >>> import chapsym
    >>> round(float(chapsym.margin(chapsym.Ball((1, 2, 4), 3), (0.1, 0, 0), (0, 0, 1))), 6)
    89.0
    """
    return fold(ball, momentum, gamma, rotation, progress=progress).reach - 1


def _upright(q: Floats) -> Floats:
    return np.where(q[..., :1] < 0, -q, q)


@dataclass
class Marchers:
    """Balls along one axis, each with its present rotation; scaled so that Λmax is about 1."""

    q: Floats
    g: Floats
    J: Floats
    D: Floats
    exponent: np.ndarray

    @classmethod
    def at(cls, rotation: ArrayLike, shape: tuple, K: Floats, g: Floats, J: Floats, D: Floats) -> Marchers:
        """Balls at a rotation with the momentum K, refined; raises BadInput if it does not have this momentum."""
        q = over_states(numbers(rotation, "rotation", 4), "rotation", shape).reshape(-1, 4).copy()
        if (np.abs((q * q).sum(axis=1) - 1) > UNIT_TOLERANCE).any():
            raise BadInput("rotation must be unit Euler parameters (scalar first); divide by the length")
        exponent = np.frexp(largest_moment(J, D))[1]
        scaled = cls(q, g, np.ldexp(J, -exponent[:, np.newaxis]), np.ldexp(D, -exponent), exponent)
        regular = scaled.regular()
        settled = scaled.correct(scaled._scaled(K))
        if (regular & ~(settled & (np.abs(scaled.q - q).max(axis=1) < AT_THE_ROOT))).any():
            raise BadInput("rotation does not have the momentum where the path begins")
        scaled.q[~regular] = q[~regular]
        return scaled

    def only(self, which: np.ndarray) -> Marchers:
        """Some of the balls."""
        return Marchers(self.q[which], self.g[which], self.J[which], self.D[which], self.exponent[which])

    def regular(self) -> np.ndarray:
        """Whether the tangent Jacobian is regular."""
        return np.abs(np.linalg.det(self.tangent())) > SINGULAR

    def march(self, A: Floats, B: Floats, progress: Callable[[int], None]) -> tuple[Floats, np.ndarray]:
        """Continues from A to B; returns the fraction t of the way and a status for each.

        progress: called after each step with the number of those that have ended.
        """
        A, E, end = self._way(A, B)
        n = len(self.D)
        t, status = np.zeros(n), np.full(n, Status.NOT_CONVERGED, dtype=np.int64)
        side = np.sign(np.linalg.det(self.tangent())) if n else t
        on = np.arange(n)
        for _ in range(MOST_STEPS):
            if not len(on):
                break
            ball, now, left = self.only(on), t[on], end[on] - t[on]
            step, det = ball._longest(A[on] + now[:, np.newaxis] * E[on], E[on])
            step = np.minimum(step, left)
            ahead = np.where(step == left, end[on], now + step)
            before = ball.q.copy()
            settled = ball.correct(A[on] + ahead[:, np.newaxis] * E[on])
            folded = (det * side[on] <= 0) | ((step < NEAR_FOLD * now) & (ahead < end[on]))
            moved = settled & ~folded & (step > 0)
            ball.q[~moved] = before[~moved]
            self.q[on], t[on] = ball.q, np.where(moved, ahead, now)
            status[on[moved & (ahead == end[on])]] = Status.TAKEN
            status[on[folded]] = Status.FOLDED
            on = on[moved & (ahead < end[on])]
            progress(n - len(on))
        return t / end, status

    def _longest(self, K: Floats, E: Floats) -> tuple[Floats, Floats]:
        """The longest step s with s|d|·|F''| ≤ CONTRACTION, d = F'⁻¹E, F'' = H - 2(𝒦 + sE)⊗1; and det T.

        The test holds in every norm: with T = U S Vᵀ this is that of z in w = V S^(-1/2) z, in which a singular
        direction does not spread its small divisor to the others.
        """
        T = self.tangent()
        U, S, V = np.linalg.svd(nonsingular(T))
        root = np.sqrt(S)[:, :, np.newaxis]
        left, right = np.swapaxes(U, 1, 2) / root, V / root  # z to T⁻¹ and w, in rows
        speed, along = length(left @ E[..., np.newaxis]), length(left @ K[..., np.newaxis])
        metric = length(right @ np.swapaxes(right, 1, 2))
        bent = (left @ self._hessian()[:, :, PAIR].reshape(-1, 3, 9)).reshape(-1, 3, 3, 3)
        bent = right[:, np.newaxis] @ bent @ np.swapaxes(right, 1, 2)[:, np.newaxis]
        slope = length(bent) + 2 * along * metric
        longest = 2 * CONTRACTION / (slope + np.sqrt(slope * slope + 8 * CONTRACTION * metric))
        with np.errstate(divide="ignore"):
            return longest / speed, np.linalg.det(T)

    def correct(self, K: Floats) -> np.ndarray:
        """Newton's iteration at the (scaled) momentum K, in place; returns which balls converged."""
        settled = np.zeros(len(self.D), dtype=bool)
        for _ in range(MOST_CORRECTIONS):
            inverse = np.linalg.inv(nonsingular(self.tangent()))
            w = -total(inverse * self.gap(K)[:, np.newaxis], 2)
            w[settled] = 0.0
            self.turn(w, ~settled)
            extent = np.abs(self.q[:, 1:]).max(axis=1)
            # Without momentum the small rotation is the identity: its rounding needs no accuracy.
            still = ~K.any(axis=1) & (extent < AT_THE_ROOT)
            self.q[still, 1:], settled[still] = 0.0, True
            # The change of the rotation by a rounding of the residual, for Λmax about 1.
            size = np.abs(K).max(axis=1) + 2 * extent
            noise = ROUNDINGS * UNIT_ROUNDOFF * np.abs(inverse).max(axis=(1, 2)) * size
            settled |= np.abs(w).max(axis=1) <= np.maximum(np.maximum(SETTLED * extent, noise), SMALLEST)
            if settled.all():
                break
        return settled

    def fold(self, A: Floats, B: Floats, t: Floats) -> tuple[Floats, Floats, np.ndarray]:
        """Newton's iteration on F = 0, det F' = 0 from near a fold: (t, q, whether it converged near its start)."""
        A, E, end = self._way(A, B)
        t = t * end
        start, first, settled = t.copy(), self.q.copy(), np.zeros(len(t), dtype=bool)
        for _ in range(MOST_EXTENDED):
            matrix, value = self._extended(A + t[:, np.newaxis] * E, E)
            move = -np.linalg.solve(nonsingular(matrix), value[..., np.newaxis])[..., 0]
            move[settled] = 0.0
            self.turn(move[:, :3], ~settled)
            t = t + move[:, 3]
            settled |= (np.abs(move[:, :3]).max(axis=1) < CLOSE) & (np.abs(move[:, 3]) <= CLOSE * np.abs(t))
            if settled.all():
                break
        settled &= (t >= start) & (t - start <= AHEAD * start)
        return np.where(settled, t, start) / end, np.where(settled[:, np.newaxis], self.q, first), settled

    def _extended(self, K: Floats, E: Floats) -> tuple[Floats, Floats]:
        """The derivative of (F, det F') in (w, t) at w = 0, (n, 4, 4), and its value, (n, 4)."""
        T = self.tangent()
        cofactors = np.cross(T[:, [1, 2, 0]], T[:, [2, 0, 1]])
        det = total(cofactors[:, 0] * T[:, 0], 1)
        # F'(w) = T + H w - 2𝒦wᵀ, and the derivative of det F' is ⟨cofactors, F''⟩.
        bent = total(total(cofactors[..., np.newaxis] * self._hessian()[:, :, PAIR], 2), 1)
        matrix = np.zeros((len(K), 4, 4))
        matrix[:, :3, :3], matrix[:, :3, 3] = T, -E
        matrix[:, 3, :3] = bent - 2 * total(cofactors * K[..., np.newaxis], 1)
        return matrix, np.concatenate([self.gap(K), det[:, np.newaxis]], axis=1)

    def _way(self, A: Floats, B: Floats) -> tuple[Floats, Floats, Floats]:
        """A and (B - A)/end, scaled; end, a power of two, shortens a way to momenta of no rotation (|𝒦| > 2Λmax)."""
        E = B - A
        beyond = np.clip(np.frexp(np.abs(E).max(axis=1))[1] - self.exponent - BEYOND, 0, 1000)
        return self._scaled(A), np.ldexp(E, -(self.exponent + beyond)[:, np.newaxis]), np.ldexp(1.0, beyond)

    def _scaled(self, K: Floats) -> Floats:
        return np.ldexp(K, -self.exponent[:, np.newaxis])

    def tangent(self) -> Floats:
        """T, (n, 3, 3)."""
        parts = tangent_jacobian(*(*self.q.T, *self.g.T, *self.J.T, self.D))
        return np.stack(np.broadcast_arrays(*parts), axis=-1).reshape(-1, 3, 3)

    def _hessian(self) -> Floats:
        """The second derivatives of each component, (n, 3, 6)."""
        parts = tangent_hessian(*(*self.q.T, *self.g.T, *self.J.T, self.D))
        return np.swapaxes(np.stack(np.broadcast_arrays(*parts), axis=-1).reshape(-1, 6, 3), 1, 2)

    def gap(self, K: Floats) -> Floats:
        """𝒦(q, γ) - 𝒦, (n, 3)."""
        return np.stack(residual(*(*self.q.T, *K.T, *self.g.T, *self.J.T, self.D)), axis=-1)

    def turn(self, w: np.ndarray, which: np.ndarray) -> None:
        """q ∘ (1, w), divided by its length, for some of the balls; a rounding may change it even for w = 0."""
        turned = np.stack(compose(*(*self.q.T, 1.0, *w.T)), axis=-1)
        self.q = np.where(which[:, np.newaxis], turned / length(turned)[:, np.newaxis], self.q)


def total(x: Floats, axis: int) -> Floats:
    """The sum along an axis, term by term: NumPy's order depends on the number of balls."""
    first, *others = np.moveaxis(x, axis, 0)
    return sum(others, start=first)


def length(x: Floats) -> Floats:
    """The length of all components of each ball, (n,)."""
    components = x.reshape(len(x), prod(x.shape[1:]))
    return np.sqrt(total(components * components, 1))


def nonsingular(matrices: Floats) -> Floats:
    """The same matrices, with the identity in place of singular ones."""
    singular = ~(np.abs(np.linalg.det(matrices)) > 0)
    return np.where(singular[:, np.newaxis, np.newaxis], np.eye(matrices.shape[-1]), matrices)
