"""The float32 precision: the loops in float32, with the bounds of that type.

State, sums and rotations are float32; each register holds twice as many balls.  𝒦, γ, the attitude and the contact
point are summed with compensation, and the integrals restored, as in float64.  Two things are float64 still: the
continuation of a step that neither `small-branch` nor `straight-path` proves, rounded, and why a step has no rotation.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from ..ball import Floats, largest_moment
from ..errors import BadInput
from ..loops import gibbs
from . import double
from .frames import Balls, Frames

#: float32 has numbers from 2^-126 to 2^128; the scaled ones of a step need a little room.
RANGE = 2.0**-120, 2.0**120
#: A momentum below this, for Λmax = 1, turns the ball by less than the compensated sums of 𝒦 and γ can hold.
SLOWEST = gibbs.SINGLE["SMALLEST"]


def run(
    balls: Balls, steps: int, every: int, frames: Frames, order: int, threads: int, progress: Callable[[int], None]
) -> None:
    """`double.run` in float32, from the float64 state in `balls`: rounded, γ and the attitude divided by their length.

    The contact point is summed in units of the radius.  A ball that turns by less than 2^-36 or so a step, where its
    checks would underflow, is as right, but takes each step by the continuation.  Raises BadInput for momenta,
    moments of inertia or a path beyond the range of float32, and for a momentum so small that the ball would stand
    still.
    """
    in_single = rounded(balls)
    slow = balls.momentum.any(axis=1) & (
        np.abs(balls.momentum).max(axis=1) < SLOWEST * largest_moment(balls.mass_tensor, balls.D)
    )
    if steps > 1 and slow.any():
        first = ", ".join(f"{x:g}" for x in balls.momentum[slow][0])
        raise BadInput(
            f"the momentum ({first}) turns the ball by less than 2^-48 a step, and in float32 it "
            'would stand still; take a longer time step, or precision="double"'
        )
    frames.momentum[:, 0], frames.gamma[:, 0] = in_single.momentum, in_single.gamma
    if frames.with_body:
        frames.attitude[:, 0] = unit(frames.attitude[:, 0])
    with np.errstate(under="ignore", over="ignore"):  # what overflows is refused
        double.run(in_single, steps, every, frames, order, threads, progress, double.SINGLE)
        traces = frames.contact
        traces *= balls.radius.astype(np.float32)[:, np.newaxis, np.newaxis]
    if np.isinf(traces).any():
        raise BadInput('the contact point leaves the range of float32, 3.4e38 metres; use precision="double"')


def rounded(balls: Balls) -> Balls:
    """The balls in float32, γ divided by its length, with the radius 1; raises BadInput where they leave its range."""
    with np.errstate(over="ignore"):  # which is refused
        largest = largest_moment(balls.mass_tensor, balls.D)
    for name, size in (("momentum", np.abs(balls.momentum).max(axis=1)), ("moment of inertia", largest)):
        outside = (size > 0.0) & ~((size >= RANGE[0]) & (size <= RANGE[1]))
        if outside.any():
            raise BadInput(
                f"a {name} of {size[outside][0]:g} is beyond what float32 can step with, 1e-36 to 1e36; "
                'take other units, or precision="double"'
            )
    K, J, D = (x.astype(np.float32) for x in (balls.momentum, balls.mass_tensor, balls.D))
    parts: tuple[Any, ...] = (K, unit(balls.gamma), J, D, np.ones(len(D), np.float32))
    return Balls(*parts)


def unit(vectors: Floats) -> np.ndarray:
    """Vectors divided by their length, rounded to float32."""
    wide = vectors.astype(np.float64)
    return (wide / np.linalg.norm(wide, axis=-1, keepdims=True)).astype(np.float32)


def step_all(balls: Balls) -> tuple[np.ndarray, ...]:
    """`double.step_all` in float32, from the float64 state in `balls`; raises BadInput beyond the range of float32."""
    return double.step_all(rounded(balls), double.SINGLE)
