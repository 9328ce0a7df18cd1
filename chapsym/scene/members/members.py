"""The balls of a scene with their starts, as arrays."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Self

import numpy as np

from chapsym.dynamics import Ball, BallN
from chapsym.dynamics.ball import Floats


@dataclass(frozen=True, eq=False)
class Parameter:
    """What a sweep varies: one value a ball, (n,), and its unit."""

    values: Floats
    units: str


@dataclass(frozen=True, eq=False)
class Members:
    """n balls and their starts, in the principal axes of each.

    names: of the balls, n different ones.
    ball: a batch of n, or of n balls in d > 3 dimensions.
    momentum: 𝒦 = εK of one step in kg m², (n, 3), or (n, d, d); K in kg m²/s where the steps are to be chosen.
    gamma: the unit vertical, upwards, (n, 3) or (n, d).
    axes: unit quaternions, (n, 4), that turn principal axes to those the user gave; None where they are the same.
    attitude: unit quaternions from the principal axes to space, (n, 4); None for the least rotation with R γ = e₃.
    place: the contact point at the start in m, (n, 2); None for the origin.
    parameters: what was varied, by dotted key.
    """

    names: tuple[str, ...]
    ball: Ball | BallN
    momentum: Floats
    gamma: Floats
    axes: Floats | None = None
    attitude: Floats | None = None
    place: Floats | None = None
    parameters: Mapping[str, Parameter] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.names)

    @property
    def dimension(self) -> int:
        """The dimension of the space in which the balls roll."""
        return self.gamma.shape[-1]

    def of(self, chosen: slice | np.ndarray) -> Self:
        """Some of the balls: a slice, or their indices."""
        names = self.names[chosen] if isinstance(chosen, slice) else tuple(self.names[i] for i in chosen)
        whole: dict[str, Any] = {
            name: getattr(self, name) for name in ("momentum", "gamma", "axes", "attitude", "place")
        }
        arrays: dict[str, Any] = {name: None if array is None else array[chosen] for name, array in whole.items()}
        some = {name: Parameter(one.values[chosen], one.units) for name, one in self.parameters.items()}
        return replace(self, names=names, ball=_some(self.ball, chosen), parameters=some, **arrays)


def one_ball(members: Members, i: int) -> Ball:
    """One ball of a batch in three dimensions, by itself."""
    ball = _some(members.ball, i)
    assert isinstance(ball, Ball)
    return ball


def _some(ball: Ball | BallN, chosen: int | slice | np.ndarray) -> Ball | BallN:
    """Some balls of a batch, or one."""
    return type(ball)(ball.mass_tensor[chosen], ball.D[chosen], None if ball.radius is None else ball.radius[chosen])
