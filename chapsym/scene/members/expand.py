"""From a scene to its balls: every range spelled out, in principal axes, checked."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from operator import attrgetter
from typing import Any

import numpy as np

from chapsym.dynamics import BadInput
from chapsym.dynamics.attitudes import attitude_with
from chapsym.dynamics.ball import Floats

from ..read.errors import SceneError, place
from ..read.ranges import MOST_BALLS, Range, Sweep, ranges_in
from ..read.scene import Scene
from ..read.tables import BallTable, StartTable, units_of
from .members import Members, Parameter
from .starts import Given, members_of


def expand(scene: Scene) -> Members:
    """The balls of a scene with their starts, the product of all ranges, checked.

    A range of [start] goes for each ball that has no start of its own, and is drawn afresh for each.
    Raises SceneError, which names the ball, for what no body can have and for starts that are none.
    """
    tables = bodies(scene)
    total = sum(len(body) for body in tables)
    if total > MOST_BALLS:
        raise SceneError(f"the scene has {total} balls; a sweep has {MOST_BALLS} at most")
    parts = [body.members() for body in tables]
    if len({part.dimension for part in parts}) > 1:
        raise SceneError("the balls of a scene roll in one space: all mass_tensors need as many numbers")
    if len(parts) == 1:
        return parts[0]
    names = [name for part in parts for name in part.names]
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise SceneError(f"two balls have the name {twice!r}: balls of a sweep are numbered")
    return _joined(parts)


def bodies(scene: Scene) -> list["Body"]:
    """The tables of a scene, in its order, each with its start and its ranges."""
    return [Body(scene, i) for i in range(len(scene.ball))]


@dataclass(frozen=True, eq=False)
class Body:
    """One [ball] of a scene, and its start."""

    scene: Scene
    index: int

    @property
    def ball(self) -> BallTable:
        """Its table."""
        return self.scene.ball[self.index]

    @property
    def start(self) -> StartTable:
        """Its own start, or that of all."""
        start = self.ball.start or self.scene.start
        assert start is not None
        return start

    @property
    def name(self) -> str:
        """Its own name, or what it is called without."""
        if self.ball.name is not None:
            return self.ball.name
        return "ball" if len(self.scene.ball) == 1 else f"ball {self.index + 1}"

    @property
    def names(self) -> tuple[str, ...]:
        """What each of its balls is called: those of a sweep are numbered."""
        sweep = self.sweep()
        return tuple(f"{self.name} {i}" for i in range(1, len(sweep) + 1)) if sweep.ranges else (self.name,)

    def sweep(self) -> Sweep:
        """Its ranges, those of the ball first."""
        found: dict[str, Range] = {}
        for table, keys in (("ball", self.ball), ("start", self.start)):
            for key in type(keys).model_fields:
                found |= ranges_in(getattr(keys, key), f"{table}.{key}")
        sweep = self.scene.sweep
        try:
            return Sweep(found, sweep.samples or 1, sweep.seed, str(self.index))
        except ValueError as error:
            raise SceneError(f"{self._place()}{error}") from None

    def __len__(self) -> int:
        return len(self.sweep())

    def members(self) -> Members:
        """Its members; raises SceneError with the name of the first that cannot be."""
        if self.ball.rotor is not None:
            told = "ball.rotor goes with chapsym certify motion alone: no run, map or reduction has a rotor inside"
            raise SceneError(f"{self._place()}{told}")
        sweep = self.sweep()
        values, count, names = sweep.values(), len(sweep), self.names
        parameters = {key: Parameter(array, units_of(key)) for key, array in values.items()}

        def made(chosen: slice) -> Members:
            given = Given({key: array[chosen] for key, array in values.items()}, len(range(count)[chosen]))
            return members_of(self.ball, self.start, given, self.scene.scale, names[chosen])

        try:
            return replace(made(slice(0, count)), parameters=parameters)
        except BadInput as error:
            first, why = _first_refused(made, 0, count) or (0, error)
            told = ", ".join(f"{key} = {array[first]:.6g}" for key, array in list(values.items())[:4])
            raise SceneError(f"{self._place()}{names[first]}{f' ({told})' if told else ''}: {why}") from None

    def _place(self) -> str:
        where = place(self.scene.name, self.scene.toml, ("ball", self.index))
        return f"{where}: " if where else ""


def _first_refused(made: Callable[[slice], Any], low: int, high: int) -> tuple[int, BadInput] | None:
    """The first ball of a batch that is refused, and why, if one is: a batch that is refused is halved."""
    try:
        made(slice(low, high))
        return None
    except BadInput as error:
        if high - low == 1:
            return low, error
    middle = (low + high) // 2
    return _first_refused(made, low, middle) or _first_refused(made, middle, high)


def _joined(parts: list[Members]) -> Members:
    """The balls of several tables one after the other; what one of them does not have is as if it were not given."""
    if len({part.ball.radius is None for part in parts}) > 1:
        raise SceneError("some balls have a radius and others have none: give it to all")
    ball, whole = type(parts[0].ball), partial(_whole, parts)
    sizes = whole("ball.mass_tensor"), whole("ball.D"), whole("ball.radius")
    keys = dict.fromkeys(key for part in parts for key in part.parameters)
    return Members(
        tuple(name for part in parts for name in part.names), ball(*sizes), whole("momentum"), whole("gamma"),
        whole("axes", lambda part: np.tile([1.0, 0.0, 0.0, 0.0], (len(part), 1))),
        whole("attitude", lambda part: attitude_with(part.gamma)),
        whole("place", lambda part: np.zeros((len(part), part.dimension - 1))),
        {key: Parameter(np.concatenate([_values(part, key) for part in parts]), units_of(key)) for key in keys},
    )  # fmt: skip


def _values(part: Members, key: str) -> Floats:
    """The values of a parameter; NaN for balls of which it is not varied."""
    return part.parameters[key].values if key in part.parameters else np.full(len(part), np.nan)


def _whole(parts: list[Members], name: str, default: Callable[[Members], Any] = lambda part: None) -> Any:
    """The arrays of that name one after the other, where any is given; else None."""
    arrays = [attrgetter(name)(part) for part in parts]
    if all(array is None for array in arrays):
        return None
    return np.concatenate([default(part) if a is None else a for part, a in zip(parts, arrays, strict=True)])
