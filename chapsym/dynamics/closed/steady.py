"""Steady rotation: every step is the same rotation about a fixed axis, so that each state has a closed form.

Lemma `steady`: with w = B(γ)⁻¹𝒦/2 the Gibbs vector of a step is nw if w × Iw = 0, and the next w is the same.  This
holds for every state of a ball with three equal moments, and for a rotation about a principal axis if D = 0, if the
vertical is along the axis, or if it is normal to the axis (rolling straight).  It also holds at rest.  In space the
contact point moves along a straight line (lemma `straight`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from chapsym.generated import isotropic_spin
from chapsym.numbers import pairs
from chapsym.numbers.loose import Loose

from .. import kernels
from ..attitudes import first_attitudes
from ..ball import Ball, Floats, batch, flag, is_followed, numbers, unit_vertical
from ..errors import BadInput, Status, explain
from ..loops.vectors import dot
from ..map import rolling_radius, step_numbers, step_of_run
from ..results import Trajectory, finished, of_balls
from . import turns

#: Steps of more than a quarter turn are beyond the fold (lemmas `steady-branch`, `steady-axis`, `steady-roll`).
QUARTER = 1.0
#: Frames of balls in one block of angles, and in one block of vectors, so that a block stays in the caches.
CHUNK, BLOCK = 2**16, 2**13


def is_steady(ball: Ball, momentum: ArrayLike, gamma: ArrayLike) -> np.ndarray:
    """Which states rotate steadily, so that `steady_frames` applies.

    These are the states with J₁ = J₂ = J₃, with 𝒦 = 0, and those whose 𝒦 has a single component and D = 0, or γ along
    𝒦, or γ normal to 𝒦 if 2(J₂ - J₃)² ≤ (2J₁ + J₂ + J₃)²: then no fold comes before a quarter turn (lemma
    `steady-roll`).  There is no tolerance: moments or components that differ by an ulp turn the axis by about an ulp
    per step, which accumulates.  Near the middle principal axis roundings grow exponentially in a run of the map, but
    not here.

    Parameters
    ----------
    ball : Ball
        One ball or a batch.
    momentum, gamma : array_like
        𝒦 (kg m²) and γ, (..., 3); they broadcast with the balls.

    Returns
    -------
    numpy.ndarray
        Booleans, (...).

    Raises
    ------
    BadInput
        As `step` does.

    Examples
    --------
    >>> import chapsym
    >>> chapsym.is_steady(chapsym.Ball((1, 2, 4), 3), [(0, 0, 0.1), (0.1, 0.2, 0)], (0, 0, 1)).tolist()
    [True, False]
    """
    shape, (K, g, J, D) = batch(ball, numbers(momentum, "momentum", 3), unit_vertical(gamma))
    return _equivalent(K, g, J, D)[0].reshape(shape)


def _equivalent(K: Floats, g: Floats, J: Floats, D: Floats) -> tuple[np.ndarray, turns.Pair]:
    """Which balls rotate steadily, and the I, as a pair, of the ball with equal moments that has the same steps."""
    axis = np.abs(K).argmax(axis=-1)
    rows = np.arange(len(D))
    along, second, third = (J[rows, (axis + i) % 3] for i in range(3))
    single = (K != 0).sum(axis=-1) <= 1
    upright = (g != 0).sum(axis=-1) == 1
    with np.errstate(over="ignore", under="ignore"):
        tame = np.sqrt(2.0) * np.abs(second - third) <= 2.0 * along + second + third
    kept = (upright & (g[rows, axis] != 0)) | (tame & (g[rows, axis] == 0))
    principal = single & ((D == 0) | ~K.any(axis=-1) | kept)
    equal = (J[:, 0] == J[:, 1]) & (J[:, 1] == J[:, 2])
    return equal | principal, pairs.two_sum(second, third)


def steady_frames(
    ball: Ball, momentum: ArrayLike, gamma: ArrayLike, index: ArrayLike, *, attitude: bool | ArrayLike = False,
    contact: bool = False, time_step: float | None = None,
) -> Trajectory:  # fmt: skip
    """The states of `trajectory` at the step numbers `index`, in closed form, for states with `is_steady`.

    𝒦ₖ = Ω⁻ᵏ𝒦, γₖ = Ω⁻ᵏγ, Rₖ = R₀Ωᵏ for one rotation Ω about w = B(γ)⁻¹𝒦/2 by the angle θ, sin θ = 2|w|, and the contact
    point moves by the same vector at each step.  Cost and error do not depend on the step numbers: the error is a few
    ulps of |𝒦|, of 1, and of the length of the path, for k below 10¹⁴.  γ is divided by its length, as at the higher
    precisions.

    Parameters
    ----------
    ball : Ball
        One ball or a batch.
    momentum, gamma : array_like
        𝒦 (kg m²) and γ, (..., 3), as for `trajectory`.
    index : array_like
        Ascending whole numbers from 0 on, (frames,).
    attitude, contact, time_step
        As for `trajectory`.

    Returns
    -------
    Trajectory
        As of `trajectory`; in a batch `status` shows which balls are beyond the fold.

    Raises
    ------
    BadInput
        As `trajectory` does, and for a ball that does not rotate steadily.
    StepNotTaken
        For one ball beyond the fold.

    Examples
    --------
    >>> import chapsym
    >>> run = chapsym.steady_frames(chapsym.Ball((1, 2, 4), 3), (0.1, 0, 0), (0, 0, 1), [0, 10**9])
    >>> run.gamma[1].round(6).tolist()
    [0.0, -0.790878, -0.611974]
    """
    numbered, contact = step_numbers(index), flag(contact, "contact")
    time_step = step_of_run(time_step, int(numbered[-1]))
    shape, (K, g, J, D) = batch(ball, numbers(momentum, "momentum", 3), unit_vertical(gamma))
    steady, moment = _equivalent(K, g, J, D)
    if not steady.all():
        raise BadInput(
            "this ball does not rotate steadily: its three J must be equal, or momentum along a principal axis "
            "that is vertical or level (or D = 0), as `is_steady` says; run `trajectory`"
        )
    axis, half, sine = _rotation(K, g, moment, D)
    taken = sine < QUARTER
    balls, frames = len(D), len(numbered)
    momenta, verticals = np.empty((2, balls, frames, 3))
    attitudes = traces = first = later = None
    if contact or is_followed(attitude):
        first = first_attitudes(attitude, g, shape)
        later = kernels.compose(first, np.concatenate([np.zeros((len(axis), 1)), axis], axis=-1))
        attitudes = np.empty((balls, frames, 4))
        if contact:
            traces = _straight(ball, shape, first, g, axis, half, numbered)
    size = max(1, CHUNK // frames)
    for part in (slice(i, i + size) for i in range(0, balls, size)):
        cosine, along = turns.cosines_and_sines(half[0][part], half[1][part], numbered)
        for v, found in ((K, momenta), (g, verticals)):
            _turn(v[part], axis[part], cosine, along, found[part])
        if attitudes is not None and first is not None and later is not None:
            for i in range(4):
                here = part, i, np.newaxis
                np.add(cosine * first[here], along * later[here], out=attitudes[part, :, i])
    for kept in (momenta, verticals, attitudes, traces):
        if kept is not None:
            kept[~taken[:, np.newaxis] & (numbered > 0)] = np.nan
    status = np.where(taken, Status.TAKEN, Status.FOLDED).astype(np.int64)
    for i in map(int, np.flatnonzero(~taken)):
        status[i] = Status.NO_INERTIA if moment[0][i] == 0.0 else explain(status[i], K[i], g[i], J[i], D[i])

    arrays = momenta, verticals, attitudes, traces, np.where(taken, numbered[-1], 0), status
    run = of_balls(shape, ball, numbered, *arrays, time_step=time_step)
    return finished(run, 1.0 / np.where(taken, 1.0, sine))


def _rotation(K: Floats, g: Floats, moment: turns.Pair, D: Floats) -> tuple[Floats, turns.Pair, Floats]:
    """The axis of the rotation, (n, 3), half its angle in turns as a pair, and sin θ = |2w|, inf for I = 0."""
    up, down = np.frexp(np.abs(K).max(axis=-1))[1], np.frexp(moment[0] + D)[1]
    still, hollow = ~K.any(axis=-1), np.ldexp(moment[0], -down) == 0.0  # D may be larger by the same factor
    with np.errstate(all="ignore"):
        k = np.ldexp(K, -up[:, np.newaxis])
        I, I_ = (np.where(hollow, one, np.ldexp(x, -down)) for x, one in zip(moment, (1.0, 0.0), strict=True))
        w1, w2, w3, square, square_ = turns.each(_spin, *k.T, *g.T, I, I_, np.ldexp(D, -down))
        square, square_ = np.where(still, 1.0, square), np.where(still, 0.0, square_)
        size, size_ = (np.ldexp(x, up - down) for x in turns.each(turns.root, square, square_))
        size, size_ = np.where(still, 0.0, np.where(hollow, np.inf, size)), np.where(still | hollow, 0.0, size_)
        taken = size < QUARTER
        half = turns.each(_half_angle, *(np.where(taken, x, 0.0) for x in (size, size_)))
        axis = np.stack([w1, w2, w3], axis=-1) / np.sqrt(square)[:, np.newaxis]
    axis[still | ~taken] = 0.0
    return axis, (half[0], half[1]), size


def _spin(*state: Floats) -> tuple[Floats, ...]:
    """w = B(γ)⁻¹k and |w|² as a pair, from k, γ, the moment as a pair, and D."""
    k1, k2, k3, g1, g2, g3 = map(Loose, state[:6])
    w = isotropic_spin(k1, k2, k3, g1, g2, g3, Loose(state[6], state[7]), Loose(state[8]))
    square = dot(w, w).normalised()
    return *(x.normalised().high for x in w), square.high, square.low


def _half_angle(sine: Floats, sine_: Floats) -> turns.Pair:
    """θ/2 in turns by tan(θ/2) = sin θ/(1 + cos θ), for pairs 0 ≤ sin θ < 1."""
    cosine = turns.root(*pairs.subtract(1.0, 0.0, *pairs.multiply(sine, sine_, sine, sine_)))
    return turns.turns_of_tangent(*pairs.divide(sine, sine_, *pairs.add(1.0, 0.0, *cosine)))


@np.errstate(all="ignore")  # an overflow is beyond the fold
def _turn(v: Floats, axis: Floats, cosine: Floats, along: Floats, found: Floats) -> None:
    """Writes Ω⁻ᵏv into `found`, (n, frames, 3): `turn` is quadratic in cos and sin of half the angle."""
    moves = axis.any(axis=-1, keepdims=True)
    axis = np.where(moves, axis, [1.0, 0.0, 0.0])
    pure, both = (kernels.turn(np.concatenate([np.full((len(v), 1), c), axis], axis=-1), v) for c in (0.0, 1.0))
    # At (0, a) the value is 2a×(a×v), at (1, a) half of that less a×v.
    square, mixed = np.where(moves, pure, 0.0), np.where(moves, 2.0 * both - pure, 0.0)
    frames = max(1, BLOCK // max(len(v), 1))
    for at in range(0, cosine.shape[1], frames):
        part = slice(at, at + frames)
        across, beside = along[:, part] * along[:, part], along[:, part] * cosine[:, part]
        for i in range(3):
            moved = across * square[:, i, np.newaxis]
            moved += beside * mixed[:, i, np.newaxis]
            np.add(moved, v[:, i, np.newaxis], out=found[:, part, i])


def _straight(
    ball: Ball, shape: tuple[int, ...], attitude: Floats, g: Floats, axis: Floats, half: turns.Pair, index: np.ndarray
) -> Floats:
    """The contact points k ρ Δ, (n, frames, 2), for the vector Δ of the first step."""
    cosine, sine = turns.cosine_and_sine(half[0])
    q = np.concatenate([cosine[:, np.newaxis], sine[:, np.newaxis] * axis], axis=-1)
    step = kernels.rotate(attitude, kernels.centre_step(q, g))[:, np.newaxis, :2]
    radius = np.broadcast_to(rolling_radius(ball), shape).reshape(-1, 1, 1)
    return np.asarray(index[:, np.newaxis] * (radius * step))
