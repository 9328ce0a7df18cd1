"""The balls of one table and their starts, for given values of its ranges, in principal axes."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from chapsym.dynamics import BadInput, Ball, BallN, kernels
from chapsym.dynamics.attitudes import attitude_with
from chapsym.dynamics.ball import SMALLEST, UNIT_TOLERANCE, Floats, contact_term, mass_tensor_of, numbers, unit_vertical
from chapsym.dynamics.n import so_n
from chapsym.dynamics.n.ball_n import skew_matrices
from chapsym.dynamics.principal_axes import (
    attitude_to_principal,
    from_inertia_tensor,
    inverse,
    principal,
    to_principal,
)

from ..read.bodies import PRESETS, check_inside
from ..read.ranges import Range, ranges_in
from ..read.tables import ATTITUDES, BallTable, StartTable
from .members import Members

#: What is this near to a unit vector was meant to be one, and is divided by its length.
ROUNDED = 1e-6


@dataclass(frozen=True, eq=False)
class Given:
    """The values of the ranges for `count` balls, and all keys as arrays of that many."""

    values: Mapping[str, Floats]
    count: int

    def array(self, value: Any, key: str) -> Floats:
        """A number, (count,), a vector (count, n), or a matrix (count, n, m)."""
        if isinstance(value, Range):
            return self.values[key]
        if isinstance(value, tuple):
            parts = [self.array(part, f"{key}.{i}") for i, part in enumerate(value, start=1)]
            if len({part.shape for part in parts}) > 1:
                raise BadInput(f"the rows of {key} must have as many numbers each")
            return np.stack(parts, axis=1)
        return np.full(self.count, value)

    def unit(self, value: Any, key: str) -> Floats:
        """Unit vectors: one that varies, or that is typed with few digits, is divided by its length."""
        array = self.array(value, key)
        length = np.sqrt((array * array).sum(axis=-1, keepdims=True))
        varies = bool(ranges_in(value, key))
        if varies and not (length > 0).all():
            raise BadInput(f"{key} must not be 0: it has a direction")
        near = np.abs(length - 1)
        return np.where((near > UNIT_TOLERANCE / 2) & (varies | (near < ROUNDED)), array / length, array)


def members_of(ball: BallTable, start: StartTable, given: Given, scale: float, names: tuple[str, ...]) -> Members:
    """The members of one table; raises BadInput for what cannot be."""
    with np.errstate(over="ignore", invalid="ignore", under="ignore"):
        if ball.mass_tensor is not None and len(ball.mass_tensor) > 3:
            return _members_n(ball, start, given, scale, names)
        body, axes = _ball(ball, given)
        gamma, attitude, motion, of_momentum = _start(start, given, body)
        if axes is not None:
            attitude = attitude_to_principal(axes, attitude_with(gamma) if attitude is None else attitude)
            gamma, motion = (to_principal(axes, vector) for vector in (gamma, motion))
        gamma = unit_vertical(gamma)
        momentum = motion if of_momentum else _momentum_of(motion, gamma, body, scale)
        if start.vertical_momentum is not None:
            momentum = given.array(start.vertical_momentum, "start.vertical_momentum")[:, np.newaxis] * gamma
        if not np.isfinite(momentum).all():
            raise BadInput("K = Λω - D⟨ω,γ⟩γ is beyond the range of float64, about 1.8e308; take other units")
        return Members(
            names, body, momentum, gamma, axes, attitude, _position(start, given, 2)
        )  # fmt: skip


def _ball(table: BallTable, given: Given) -> tuple[Ball, Floats | None]:
    """The balls, and what turns their principal axes to those of the table, if these are others."""
    told, contact = _sizes(table, given)
    axes = None
    if table.mass_tensor is not None:
        tensor = given.array(table.mass_tensor, "ball.mass_tensor")
    elif table.preset is not None:
        tensor = PRESETS[table.preset].tensor(told)
    else:
        inertia = given.array(table.inertia, "ball.inertia")
        tensor = mass_tensor_of(inertia) if inertia.ndim == 2 else from_inertia_tensor(inertia)
    if tensor.ndim == 3:
        tensor, axes = principal(numbers(tensor, "inertia"))
    if "mass" in told:
        check_inside(tensor, told["mass"], told["radius"])
    return Ball(tensor, contact, told.get("radius")), axes


def _sizes(table: BallTable, given: Given) -> tuple[dict[str, Floats], Floats]:
    """The masses and lengths of a table that are given, as arrays, and D."""
    keys = ("mass", "radius", "D", *(key for preset in PRESETS.values() for key in preset.keys))
    told = {key: given.array(value, f"ball.{key}") for key in keys if (value := getattr(table, key)) is not None}
    return told, np.asarray(contact_term(told.get("mass"), told.get("radius"), told.get("D")))


def _start(start: StartTable, given: Given, ball: Ball) -> tuple[Floats, Floats | None, Floats, bool]:
    """γ, the attitude if it is given, 𝒦 (or its direction) or ω, in the axes of the table, and whether it is 𝒦."""
    attitude = _attitude(start, given)
    if attitude is not None:
        gamma = kernels.rotate(inverse(attitude), np.array([0.0, 0.0, 1.0]))
    else:
        gamma = given.unit(start.gamma or (0.0, 0.0, 1.0), "start.gamma")
    body_to_space = attitude if attitude is not None else attitude_with(unit_vertical(gamma))
    if start.vertical_momentum is not None:
        return gamma, attitude, gamma, True
    if start.velocity is not None:
        motion = kernels.rotate(inverse(body_to_space), _rolling(start, given, ball))
        return gamma, attitude, motion, False
    key = "omega" if start.momentum is None else "momentum"
    motion = given.array(getattr(start, key), f"start.{key}")
    if motion.shape[-1] != 3 or motion.ndim != 2:
        raise BadInput(f"start.{key} must be three numbers for a ball in three dimensions")
    if start.axes == "space":
        motion = kernels.rotate(inverse(body_to_space), motion)
    return gamma, attitude, motion, key == "momentum"


def _attitude(start: StartTable, given: Given) -> Floats | None:
    """The unit quaternions from the body to space, (count, 4), scalar first; None where the start does not say them."""
    if start.rpy is not None:
        roll, pitch, yaw = given.array(start.rpy, "start.rpy").T
        return kernels.compose(_turn(yaw, 2), kernels.compose(_turn(pitch, 1), _turn(roll, 0)))
    key, scalar = ("attitude", "first") if start.quaternion_xyzw is None else ("quaternion_xyzw", "last")
    if getattr(start, key) is None:
        return None
    attitude = given.unit(getattr(start, key), f"start.{key}")
    length = np.sqrt((attitude * attitude).sum(axis=-1, keepdims=True))
    if (np.abs(length - 1) > UNIT_TOLERANCE).any():
        raise BadInput(f"{key} must be a unit quaternion (scalar {scalar}), but its length is {length.max():.9g}")
    return (attitude if scalar == "first" else np.roll(attitude, 1, axis=-1)) / length


def _turn(angle: Floats, axis: int) -> Floats:
    """The unit quaternions (count, 4) of rotations by angles (count,) in radians about one axis."""
    found = np.zeros((len(angle), 4))
    found[:, 0], found[:, 1 + axis] = np.cos(angle / 2), np.sin(angle / 2)
    return found


def _rolling(start: StartTable, given: Given, ball: Ball) -> Floats:
    """ω in space axes of a ball that rolls with a velocity (v₁, v₂) of its centre, and a spin.

    The point of contact, at -ρe₃ from the centre, is at rest: v = ρ ω × e₃ = ρ(ω₂, -ω₁, 0).
    """
    if ball.radius is None:
        raise BadInput("start.velocity needs ball.radius")
    velocity = given.array(start.velocity, "start.velocity")
    spin = given.array(0.0 if start.spin is None else start.spin, "start.spin")
    return np.stack([-velocity[..., 1] / ball.radius, velocity[..., 0] / ball.radius, spin], axis=-1)


def _momentum_of(omega: Floats, gamma: Floats, ball: Ball, scale: float) -> Floats:
    """𝒦 = εK with K = Λω - D⟨ω,γ⟩γ; raises BadInput where float64 loses its digits."""
    momentum = scale * kernels.contact_momentum(omega, gamma, ball.mass_tensor, ball.D)
    lost = (np.abs(momentum).max(axis=-1) < SMALLEST) & omega.any(axis=-1) & (ball.inertia > 0).all(axis=-1)
    if lost.any():
        raise BadInput("𝒦 = εK is below the range of float64, about 2.2e-308; take a longer time step or other units")
    return momentum


def _members_n(ball: BallTable, start: StartTable, given: Given, scale: float, names: tuple[str, ...]) -> Members:
    """The members of a ball in more than three dimensions; 𝒦 of ω is that of E = εω in (4.13), as it is linear."""
    n = len(ball.mass_tensor or ())
    for key in ("velocity", "vertical_momentum", *ATTITUDES):
        if getattr(start, key) is not None:
            raise BadInput(f"start.{key} is for three dimensions; give omega or momentum, a skew matrix, and gamma")
    if start.axes == "space":
        raise BadInput('axes = "space" is for three dimensions')
    tensor, (told, contact) = given.array(ball.mass_tensor, "ball.mass_tensor"), _sizes(ball, given)
    if "mass" in told:
        check_inside(tensor, told["mass"], told["radius"])
    body = BallN(tensor, contact, told.get("radius"))
    gamma = unit_vertical(given.unit(start.gamma or (*[0.0] * (n - 1), 1.0), "start.gamma"), n)
    key = "omega" if start.momentum is None else "momentum"
    motion = skew_matrices(given.array(getattr(start, key), f"start.{key}"), n, f"start.{key}")
    if key == "omega":
        motion = so_n.momentum(scale * motion, gamma, body.mass_tensor, body.D)
    return Members(names, body, numbers(motion, "momentum"), gamma, place=_position(start, given, n - 1))


def _position(start: StartTable, given: Given, count: int) -> Floats | None:
    if start.position is None:
        return None
    if len(start.position) != count:
        raise BadInput(f"start.position must have {count} numbers")
    return given.array(start.position, "start.position")
