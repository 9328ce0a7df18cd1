"""The attitude at the start of a run."""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from chapsym import generated

from . import kernels
from .ball import SINGLE_TOLERANCE, UNIT_TOLERANCE, Floats, in_single, is_flag, numbers, over_states
from .errors import BadInput

#: The largest accepted |R γ - e₃| for an attitude that is given together with γ.
AGREEMENT = 1e-9
#: The same for a float32 attitude, after up to 10⁶ steps in float32.
SINGLE_AGREEMENT = 1e-4


def roll_pitch_yaw(halves: Sequence[tuple[Any, Any]]) -> tuple[Any, ...]:
    """The quaternion of Rz(yaw) Ry(pitch) Rx(roll), from the cosines and sines of half the angles."""
    roll, pitch, yaw = halves
    about_y = generated.compose(pitch[0], 0, pitch[1], 0, *roll, 0, 0)
    return generated.compose(yaw[0], 0, 0, yaw[1], *about_y)


def attitude_with(gamma: Floats) -> Floats:
    """The attitude of the least rotation for which γ is vertical, R γ = e₃, shape (..., 4)."""
    if gamma.shape == (3,):
        return np.array(_least(*gamma.tolist()))
    x, y, z = gamma[..., 0], gamma[..., 1], gamma[..., 2]
    zero = np.zeros_like(z)
    # Components whose squares underflow are negligible for a half turn.
    x, y = (np.where(np.abs(v) < 1e-150, 0.0, v) for v in (x, y))
    upper = np.stack([1 + z, y, -x, zero], axis=-1)
    # Upside down, the axis of the half turn is free: take e₁.  1 + z cancels there, so use x² + y² = (1-z)(1+z).
    rounded = np.stack([(x * x + y * y) / (1 - np.where(z < 0, z, 0)), y, -x, zero], axis=-1)
    quaternion = np.where((z < 0)[..., np.newaxis], rounded, upper)
    length = np.sqrt((quaternion * quaternion).sum(axis=-1, keepdims=True))
    down = length[..., 0] == 0
    quaternion[down], length[down] = [0.0, 1.0, 0.0, 0.0], 1.0
    return quaternion / length


def _least(x: float, y: float, z: float) -> tuple[float, ...]:
    """`attitude_with` of one γ, with the same roundings."""
    x, y = 0.0 if abs(x) < 1e-150 else x, 0.0 if abs(y) < 1e-150 else y
    a = (x * x + y * y) / (1 - z) if z < 0 else 1 + z
    length = sqrt(a * a + y * y + x * x)
    return (0.0, 1.0, 0.0, 0.0) if length == 0.0 else (a / length, y / length, -x / length, 0.0)


def initial_attitude(attitude: bool | ArrayLike, gamma: Floats) -> Floats:
    """The first attitude: the given one, checked against γ, or the least rotation."""
    if is_flag(attitude):
        return attitude_with(gamma)
    given = numbers(attitude, "attitude", 4)
    over_states(given, "attitude", gamma.shape[:-1])
    single = in_single(attitude)
    with np.errstate(over="ignore", under="ignore"):  # which is refused
        squared = (given * given).sum(axis=-1)
    if (np.abs(squared - 1) > (SINGLE_TOLERANCE if single else UNIT_TOLERANCE)).any():
        raise BadInput("attitude must be unit quaternions (scalar first); divide by the length")
    vertical = kernels.rotate(given, gamma)
    if (np.abs(vertical - [0.0, 0.0, 1.0]) > (SINGLE_AGREEMENT if single else AGREEMENT)).any():
        raise BadInput("attitude and gamma disagree: the attitude must turn gamma to (0, 0, 1)")
    return given / np.sqrt(squared)[..., np.newaxis] if single else given


def first_attitudes(attitude: bool | ArrayLike, gamma: Floats, shape: tuple[int, ...]) -> Floats:
    """`initial_attitude` of flat states with the leading axes `shape`, γ (n, 3): (n, 4)."""
    return np.broadcast_to(initial_attitude(attitude, gamma.reshape(*shape, 3)), (*shape, 4)).reshape(-1, 4)
