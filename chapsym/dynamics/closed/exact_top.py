"""The discrete map through the continuous motion, without error of the step: the free top, and vertical momentum.

The discrete and the continuous free top run on the same curves of 𝒦/|𝒦|, both by constant increments (5.15-euler):
one change of |𝒦| makes the increments equal.  Both keep 𝒦 in space and commute, so that the rotations of one step
differ by a constant angle about 𝒦: a twist, put right on output.  A ball with vertical momentum is such a top,
with the mass tensor J + D/2 (lemma `vertical-top`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .. import kernels
from ..ball import Ball, Floats, in_principal_axes, numbers, unit_vertical
from ..errors import BadInput, StepNotTaken
from ..results import Trajectory
from .elliptic import Curve, across, height_of
from .vertical import step_vertical

#: How far a momentum may be from vertical, relatively, for a ball with D > 0.
VERTICAL = 1e-12
#: How far a step of the top may be from the continuous motion: more is another branch.
AGREEMENT = 1e-9
#: Nodes of Gauss' quadrature for the twist: 24 give it to the last digit for every step below the fold.
NODES = 32


@dataclass(frozen=True, eq=False)
class ExactTop:
    """A top with D = 0 whose discrete motion is the continuous motion of `origin`, sampled once a step.

    ball: the top, with the mass tensor J + D/2; momentum: its 𝒦 in kg m², (3,), along that of `origin`.
    twist: the angle about 𝒦 by which each step must still be turned, in radians.
    origin: the ball; size: its εK along 𝒦's direction, in kg m².
    """

    ball: Ball
    momentum: Floats
    twist: float
    origin: Ball
    size: float

    def restore(self, run: Trajectory) -> Trajectory:
        """The continuous motion of `origin` from a trajectory of `ball` with `momentum`: εK, γ and the attitude.

        Step k is turned by k `twist` about 𝒦, so that nothing adds up.  The contact point is left out: its discrete
        steps are chords.  The order of the result is 0: its steps are no composition of the map.
        Raises BadInput for a run of another ball, momentum or order, or from a γ that this top was not made for.
        """
        momentum = run.momentum[0] if run.momentum.ndim == 2 else None
        if run.ball is not self.ball or momentum is None or not (momentum == self.momentum).all() or run.order != 2:
            raise BadInput(
                "this is no trajectory of the exact top: run `trajectory(top.ball, top.momentum, gamma, ...)`"
            )
        size = np.sqrt((run.momentum**2).sum(axis=-1, keepdims=True))
        if float(self.origin.D) > 0.0 and np.abs(np.cross(momentum, run.gamma[0])).max() > VERTICAL * size[0, 0]:
            raise BadInput("this run does not start at the gamma along the momentum, for which the exact top was made")
        axis = np.sign(self.size) * run.momentum / size  # γ itself where D > 0, though 𝒦 may point downwards
        half = run.index * (self.twist / 2)
        turn = np.concatenate([np.cos(half)[:, np.newaxis], np.sin(half)[:, np.newaxis] * axis], axis=-1)
        attitude = None if run.attitude is None else kernels.compose(run.attitude, turn)
        gamma = kernels.transport(turn, run.gamma)
        return Trajectory(
            self.origin, run.index, self.size * axis, gamma, attitude, None, run.taken, run.status,
            run.time_step, 0,
        )  # fmt: skip


@np.errstate(all="ignore")  # what overflows is refused
def exact_top(ball: Ball, momentum: ArrayLike, gamma: ArrayLike) -> ExactTop:
    """The top whose discrete motion from γ is the continuous motion of `ball` with the momentum εK.

    momentum: εK in kg m², (3,), for one step; for D > 0 it must be along γ.  gamma: unit, (3,).
    Then `trajectory(top.ball, top.momentum, gamma, steps)` costs what the map costs, and `top.restore` of it has no
    error but roundings, for every ε up to the fold of the top's branch.
    Raises BadInput for a batch, for D > 0 with a momentum that is not vertical, and for a step beyond the fold.
    """
    K, g = numbers(momentum, "momentum", 3), unit_vertical(gamma)
    if (in_principal_axes(ball).D.shape, ball.mass_tensor.shape, K.shape, g.shape) != ((), (3,), (3,), (3,)):
        raise BadInput("an exact top is made for one ball, one momentum and one gamma")
    largest = float(np.abs(K).max())
    if largest == 0.0:
        raise BadInput("the momentum must not vanish: a ball at rest stays where it is")
    contact, unit = float(ball.D), K / largest
    size = largest * float(np.sqrt(unit @ unit))
    if contact > 0.0:
        size = float(K @ g)
        if np.abs(K - size * g).max() > VERTICAL * abs(size):
            raise BadInput("for D > 0 only a motion with vertical momentum is a top's: momentum must be along gamma")
    axis = g if contact > 0.0 else K / size
    top = Ball(ball.mass_tensor + contact / 2, 0.0)
    # In units in which the largest moment is about 1: products of three moments stay in range.
    exponent = int(np.frexp(top.inertia.max())[1])
    moments = np.ldexp(ball.inertia, -exponent)
    # 1 - Dl as a sum of positive terms.
    free = moments / (moments + np.ldexp(contact, -exponent))
    speed = float(np.ldexp(size, -exponent) / (axis * axis * free).sum())
    if not np.isfinite(speed) or speed == 0.0:
        raise BadInput("float64 cannot hold this top: its moments of inertia and its momentum are too far apart")
    unit_top = Ball(np.ldexp(top.mass_tensor, -exponent), 0.0)
    fixed = not across(unit_top.mass_tensor, unit_top.inertia, axis).any()
    tau, twist = (_fixed if fixed else _moving)(unit_top, axis, speed)
    return ExactTop(top, np.ldexp(tau, exponent) * axis, twist, ball, size)


def _fixed(top: Ball, axis: Floats, speed: float) -> tuple[float, float]:
    """A rotation about a principal axis: 𝒦 = Λ sin θ is to turn by θ = speed/Λ."""
    level = float((axis * axis / top.inertia).sum())
    if abs(speed * level) >= np.pi / 2:
        raise BadInput("a step of more than 90° about this axis is beyond the branch of the top; take a shorter one")
    return float(np.sin(speed * level) / level), 0.0


def _moving(top: Ball, axis: Floats, speed: float) -> tuple[float, float]:
    """The momentum of the top with the increment of the continuous motion, and the twist that is left."""
    curve = Curve.through(top, axis)
    advance = curve.rate * speed
    tau, slope = (float(x) for x in height_of(curve, advance / 2))
    start = float(curve.argument(axis))
    ahead = curve.point(start + advance)
    try:
        step = step_vertical(top, tau, axis)
    except StepNotTaken:
        step = None
    if step is None or not slope * curve.rate > 0.0 or not np.abs(step.gamma - ahead).max() <= AGREEMENT:
        raise BadInput("the continuous motion of this step is beyond the branch of the top; take a shorter time step")
    before, there = (across(top.mass_tensor, top.inertia, v) for v in (axis, step.gamma))
    after = kernels.rotate(step.rotation, there)
    discrete = np.arctan2(axis @ np.cross(before, after), before @ after)
    twist = _turn(curve, start, advance, speed) - float(discrete)
    return tau, float(np.remainder(twist + np.pi, 2 * np.pi) - np.pi)


def _turn(curve: Curve, start: float, advance: float, speed: float) -> float:
    """The angle about γ by which R(γ × Λ⁻¹γ) turns in one step: the integral of H⟨b,Λ⁻¹b⟩/|b|², b = γ × Λ⁻¹γ."""
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    top = curve.ball
    turned = across(top.mass_tensor, top.inertia, curve.point(start + advance * (nodes + 1) / 2))
    rates = (turned * turned / top.inertia).sum(axis=-1) / (turned * turned).sum(axis=-1)
    return speed * float(weights @ rates) / 2
