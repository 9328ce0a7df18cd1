"""The map: one step, and the unreachable momenta."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from chapsym.generated import momentum as momentum_kernel
from chapsym.numbers import NAMED, Double, Rung

from .ball import Ball, Floats, numbers
from .errors import BadInput, Status, StepNotTaken
from .loops import loop

#: How far |γ|² may be from 1: more than the rounding of 10⁶ steps, so that a run may go on from its end.
UNIT_TOLERANCE = 1e-12
#: The same for what is given in float32: it is divided by its length.
SINGLE_TOLERANCE = 1e-6
#: Batches up to this size step in plain Python: compiling would take longer.
SMALL_BATCH = 64


@dataclass(frozen=True, eq=False)
class Step:
    """The outcome of one step, for one ball or a batch with the leading axes (...).

    rotation: the Euler parameters (q0, q1, q2, q3) of the step in the body, q0 ≥ 0, shape (..., 4).
    momentum, gamma: 𝒦 and γ after the step, shape (..., 3).
    status: a `Status` for each ball, shape (...); where it is not TAKEN the numbers above are NaN.
    reach: the fraction of the momentum that the small-rotation branch attains, shape (...).
    precision: the rung of the numbers.  The arrays are float32 for Single, objects (mpf, arb) for Digits and Ball.
    low: for Quad, what the numbers have beyond float64, as of `Trajectory`; else None.
    """

    rotation: Floats
    momentum: Floats
    gamma: Floats
    status: np.ndarray
    reach: Floats
    precision: Rung = NAMED["double"]
    low: LowStep | Any = None


@dataclass(frozen=True, eq=False)
class LowStep:
    """The second halves of the double-double numbers of a step, each at most half an ulp of the first."""

    rotation: Floats
    momentum: Floats
    gamma: Floats


def in_single(value: ArrayLike) -> bool:
    """Whether an array is of float32, in any byte order."""
    return np.asarray(value).dtype.newbyteorder("=") == np.float32


def unit_vertical(gamma: ArrayLike, tolerance: float = UNIT_TOLERANCE) -> Floats:
    """γ as checked unit vectors, shape (..., 3); a float32 array, which cannot be so near to unit, as divided."""
    array = numbers(gamma, "gamma", 3)
    squared = (array * array).sum(axis=-1)
    if in_single(gamma) and (np.abs(squared - 1) <= SINGLE_TOLERANCE).all():
        return array / np.sqrt(squared)[..., np.newaxis]
    off = np.abs(squared - 1)
    if array.size and (off > tolerance).any():
        worst = np.sqrt(squared.flat[int(off.argmax())])
        right = "divide it by its length" if worst else "it is the vertical, upwards, in the axes of the body"
        raise BadInput(f"gamma must be a unit vector, but its length is {worst:.17g}; {right}")
    return array


def batch(ball: Ball, *vectors: Floats) -> tuple[tuple[int, ...], list[Floats]]:
    """The common leading shape of balls and vectors, and all of them as fresh flat arrays.

    Returns (shape, [vector (n, 3) ..., mass_tensor (n, 3), D (n,)]).
    """
    if not isinstance(ball, Ball):
        raise BadInput(f"ball must be a chapsym.Ball, not {type(ball).__name__}")
    radius = () if ball.radius is None else ball.radius.shape
    try:
        shape = np.broadcast_shapes(ball.D.shape, ball.mass_tensor.shape[:-1], radius, *(v.shape[:-1] for v in vectors))
    except ValueError:
        shapes = ", ".join(str(s) for s in [ball.mass_tensor.shape, ball.D.shape, *(v.shape for v in vectors)])
        raise BadInput(f"the leading axes of ball (mass_tensor, D) and vectors do not broadcast: {shapes}") from None
    flat = [np.broadcast_to(v, (*shape, 3)).reshape(-1, 3).copy() for v in (*vectors, ball.mass_tensor)]
    return shape, [*flat, np.broadcast_to(ball.D, shape).reshape(-1).copy()]


def step(ball: Ball, momentum: ArrayLike, gamma: ArrayLike, *, precision: str | Rung = "double") -> Step:
    """One step of the map (5.3) on the small-rotation branch.

    Solves 𝒦(q, γ) = 𝒦 for the rotation Ω (5.2) that is continued from the identity, and carries
    𝒦 and γ to Ωᵀ𝒦 and Ωᵀγ.

    momentum: 𝒦 = ε K of the paper, in kg m², shape (..., 3); gamma: unit verticals upwards, (..., 3).
    Both broadcast with each other and with the balls.
    precision: "single", "double", "quad" (31 digits), `Digits(n)` (mpmath) or `Ball(bits)` (Arb, rigorous).  The floats
    that are given are taken as exact on every rung, but γ is divided by its length there.

    One ball (no leading axis) raises StepNotTaken if it has no step; a batch reports `status` instead.
    Raises BadInput for shapes, NaN, infinities, and a gamma that is not unit.
    """
    shape, (K, g, J, D) = batch(ball, numbers(momentum, "momentum", 3), unit_vertical(gamma))
    if precision != "double":
        from .levels import ladder

        rung = ladder.rung_of(precision)
        if not isinstance(rung, Double):
            return ladder.step(rung, shape, K, g, J, D)
    q = np.full((len(D), 4), np.nan)
    status, reach = np.zeros(len(D), dtype=np.int64), np.ones(len(D))
    advance_all(K, g, J, D, q, status, reach)
    failed = status != Status.TAKEN
    if failed.any():
        for i in np.flatnonzero(failed):
            status[i] = explain(status[i], K[i], g[i], J[i], D[i])
        if not shape:
            raise StepNotTaken(Status(int(status[0])), float(reach[0]))
        K[failed], g[failed] = np.nan, np.nan
    return Step(
        q.reshape(*shape, 4), K.reshape(*shape, 3), g.reshape(*shape, 3), status.reshape(shape), reach.reshape(shape)
    )


def advance_all(K: Floats, g: Floats, J: Floats, D: Floats, q: Floats, status: np.ndarray, reach: Floats) -> None:
    """One step of every ball, in plain Python for a few and compiled for many."""
    if len(D) <= SMALL_BATCH:
        loop.advance_all(K, g, J, D, q, status, reach)
        return
    from .levels.compiled import compiled

    compiled(loop.advance_all)(K, g, J, D, q, status, reach)


def explain(status: int, K: Floats, g: Floats, J: Floats, D: float) -> Status:
    """Why a step was not taken: UNREACHABLE if no rotation at all has this momentum."""
    if status == Status.NO_INERTIA and (g * g * (J.sum() - J)).sum() > 0.0:
        return Status.NOT_CONVERGED  # it has some, but beside D it is rounding
    if status in (Status.FOLDED, Status.NOT_CONVERGED):
        # Scaled so that Λmax is below 1: then no rotation has a component above 2, and nothing overflows.
        shift = -int(np.frexp(J.sum() + D)[1])
        with np.errstate(over="ignore"):
            k = np.clip(np.ldexp(K, shift), -4.0, 4.0)
        most = largest_momentum(k, g, np.ldexp(J, shift), float(np.ldexp(D, shift)))
        if np.abs(k).max() == 4.0 or np.linalg.norm(k) > most * (1 + 1e-12):
            return Status.UNREACHABLE
    return Status(int(status))


def largest_momentum(direction: Floats, g: Floats, J: Floats, D: float) -> float:
    """The largest component of 𝒦(q, γ) along `direction` over all rotations.

    ⟨n, 𝒦(q, γ)⟩ is a quadratic form in the four Euler parameters: its largest eigenvalue.
    """
    n = direction / np.abs(direction).max()
    n /= np.sqrt(n @ n)

    def form(p: Floats) -> float:
        return float(n @ np.array(momentum_kernel(*(*p, *g, *J, D))))

    basis = np.eye(4)
    matrix = np.array([[(form(a + b) - form(a - b)) / 4 for b in basis] for a in basis])
    return float(np.linalg.eigvalsh(matrix)[-1])
