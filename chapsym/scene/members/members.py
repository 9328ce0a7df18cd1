"""The balls of a scene with their starts, as checked arrays in principal axes, with all ranges expanded."""

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from operator import attrgetter
from pathlib import Path
from typing import Any, Self

import numpy as np

from chapsym.dynamics import BadInput, Ball, BallN, kernels
from chapsym.dynamics import ball as balls
from chapsym.dynamics.attitudes import attitude_with, roll_pitch_yaw
from chapsym.dynamics.ball import UNIT_TOLERANCE, Floats, contact_term, mass_tensor_of, numbers, unit_vertical
from chapsym.dynamics.n import so_n
from chapsym.dynamics.n.ball_n import skew_matrices
from chapsym.dynamics.principal_axes import attitude_to_principal, from_inertia_tensor, inverse, principal, to_principal

from ..read.bodies import KEYS, PRESETS, check_inside, size_rounded_by
from ..read.errors import Data, Misfit, SceneError, place, said_by
from ..read.ranges import MOST_BALLS, Range, Sweep, ranges_in
from ..read.scene import Scene, ball_place, ball_table, checked, written
from ..read.tables import ATTITUDES, SCALAR_FIRST, BallTable, StartTable, ranges_of

#: The tolerance for a unit vector, which is then divided by its length.
ROUNDED = 1e-6


@dataclass(frozen=True, eq=False)
class Members:
    """n balls and their starts, in the principal axes of each.

    names: n different names of the balls.
    ball: a batch of n, or of n balls in d > 3 dimensions.
    momentum: 𝒦 = εK of one step in kg m², (n, 3), or (n, d, d); K in kg m²/s if the steps are chosen automatically.
    gamma: the unit vertical, upwards, (n, 3) or (n, d).
    axes: unit quaternions, (n, 4), from principal axes to the axes of the user; None if they are the same.
    attitude: unit quaternions from the principal axes to space, (n, 4); None for the least rotation with R γ = e₃.
    place: the contact point at the start in m, (n, 2); None for the origin.
    parameters: the swept keys, dotted, with one value per ball in the unit of the key (`units_of`), (n,).
    """

    names: tuple[str, ...]
    ball: Ball | BallN
    momentum: Floats
    gamma: Floats
    axes: Floats | None = None
    attitude: Floats | None = None
    place: Floats | None = None
    parameters: Mapping[str, Floats] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.names)

    @property
    def dimension(self) -> int:
        """The dimension of the space in which the balls roll."""
        return self.gamma.shape[-1]

    def of(self, chosen: slice | np.ndarray) -> Self:
        """Some of the balls: a slice, or their indices."""
        names = self.names[chosen] if isinstance(chosen, slice) else tuple(self.names[i] for i in chosen)
        given = {name: getattr(self, name) for name in ("momentum", "gamma", "axes", "attitude", "place")}
        arrays: dict[str, Any] = {name: None if array is None else array[chosen] for name, array in given.items()}
        some = {name: values[chosen] for name, values in self.parameters.items()}
        return replace(self, names=names, ball=_some(self.ball, chosen), parameters=some, **arrays)


def one_ball(members: Members, i: int) -> Ball:
    """One ball of a batch in three dimensions, by itself."""
    ball = _some(members.ball, i)
    assert isinstance(ball, Ball)
    return ball


def _some(ball: Ball | BallN, chosen: int | slice | np.ndarray) -> Ball | BallN:
    """Some balls of a batch, or one."""
    return type(ball)(ball.mass_tensor[chosen], ball.D[chosen], None if ball.radius is None else ball.radius[chosen])


# From a scene to its balls.


def ball_of(file: Path) -> tuple[Data, Members]:
    """[ball] of a scene or of a robot file, as by `ball_table`, and the ball.

    Raises SceneError, with the key or the element of the file and its line, for values that no body can have.
    """
    table = ball_table(file)
    ball = written("ball", {key: value for key, value in table.items() if key != "name"})
    start = written("start", {"omega": [0, 0, 1]}) + written("run", {"time": 1, "frames": 1})
    try:
        return table, expand(checked(tomllib.loads(ball + start), str(file)))
    except SceneError as error:
        if error.misfit is None or error.misfit.path[0] != "ball":
            raise
        raise SceneError(f"{ball_place(file, str(error.misfit.path[1]))}: {error.misfit}") from None


def expand(scene: Scene) -> Members:
    """The balls of a scene with their starts, the product of all ranges, checked.

    A range of [start] applies to each ball without its own start, with separate random samples.
    Raises SceneError, with the name of the ball, for values that no body can have and for invalid starts.
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
    """The tables of a scene, in its order, each with its start and its ranges; raises SceneError for too many balls."""
    return [Body.of(scene, i) for i in range(len(scene.ball))]


@dataclass(frozen=True, eq=False)
class Body:
    """One [ball] of a scene, and its start; name: its own, or the default; sweep: its ranges."""

    scene: Scene
    index: int
    start: StartTable
    name: str
    sweep: Sweep

    @classmethod
    def of(cls, scene: Scene, index: int) -> Self:
        """The body with its own start, or the common one; and its ranges, those of the ball first."""
        ball, sweep = scene.ball[index], scene.sweep
        start = ball.start or scene.start
        assert start is not None
        try:
            ranges = Sweep(ranges_of(ball, start), sweep.samples or 1, sweep.seed, str(index))
        except ValueError as error:
            raise SceneError(f"{_place(scene, index)}{error}") from None
        name = ball.name or ("ball" if len(scene.ball) == 1 else f"ball {index + 1}")
        return cls(scene, index, start, name, ranges)

    @property
    def names(self) -> tuple[str, ...]:
        """The names of its balls: those of a sweep are numbered."""
        return tuple(f"{self.name} {i}" for i in range(1, len(self) + 1)) if self.sweep.ranges else (self.name,)

    def __len__(self) -> int:
        return len(self.sweep)

    def members(self) -> Members:
        """Its members; raises SceneError with the name of the first invalid one."""
        ball, scale = self.scene.ball[self.index], self.scene.task().scale
        at = partial(_place, self.scene, self.index)
        if ball.rotor is not None:
            clause = "ball.rotor goes with chapsym certify motion alone: no run, map or reduction has a rotor inside"
            raise SceneError(f"{at()}{clause}")
        values, count, names = self.sweep.values(), len(self), self.names

        def made(chosen: slice) -> Members:
            given = Given({key: array[chosen] for key, array in values.items()}, len(range(count)[chosen]))
            return members_of(ball, self.start, given, scale, names[chosen])

        try:
            return replace(made(slice(0, count)), parameters=values)
        except BadInput as error:
            first, why = _first_refused(made, 0, count) or (0, error)
            clause = ", ".join(f"{key} = {array[first]:.6g}" for key, array in list(values.items())[:4])
            of = f"{names[first]}{f' ({clause})' if clause else ''}: {why}"
            if not isinstance(why, Misfit):
                raise SceneError(f"{at()}{of}") from None
            key, where = ".".join(map(str, why.path)), at(*why.path)
            refused = SceneError(f"{where}{key} of {of}" if where else f"{of} ({key})")
            refused.misfit = why
            raise refused from None


def _place(scene: Scene, index: int, table: str | int = "ball", *key: str | int) -> str:
    """The file, and the line of a key of a ball or of its start."""
    own = ("ball", index) if isinstance(scene._data.get("ball"), list) else ("ball",)
    path = (*own, *key) if table == "ball" else (*own, table, *key) if scene.ball[index].start else (table, *key)
    where = place(scene.name, scene.toml, path)
    return f"{where}: " if where else ""


def _first_refused(made: Callable[[slice], object], low: int, high: int) -> tuple[int, BadInput] | None:
    """The first refused ball of a batch, and the reason, by bisection; or None."""
    try:
        made(slice(low, high))
        return None
    except BadInput as error:
        if high - low == 1:
            return low, error
    middle = (low + high) // 2
    return _first_refused(made, low, middle) or _first_refused(made, middle, high)


def _joined(parts: list[Members]) -> Members:
    """The balls of several tables in sequence; arrays that one of them lacks have defaults."""
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
        {key: np.concatenate([part.parameters.get(key, np.full(len(part), np.nan)) for part in parts]) for key in keys},
    )  # fmt: skip


def _whole(parts: list[Members], name: str, default: Callable[[Members], Any] = lambda part: None) -> Any:
    """The concatenated arrays of a name, if any is given; else None."""
    arrays = [attrgetter(name)(part) for part in parts]
    if all(array is None for array in arrays):
        return None
    return np.concatenate([default(part) if a is None else a for part, a in zip(parts, arrays, strict=True)])


# The balls of one table, for given values of its ranges.


@dataclass(frozen=True, eq=False)
class Given:
    """The values of the ranges for `count` balls, and all keys as arrays of that many."""

    values: Mapping[str, Floats]
    count: int

    def array(self, value: object, key: str) -> Floats:
        """A number, (count,), a vector (count, n), or a matrix (count, n, m)."""
        if isinstance(value, Range):
            return self.values[key]
        if isinstance(value, tuple):
            parts = [self.array(part, f"{key}.{i}") for i, part in enumerate(value, start=1)]
            if len({part.shape for part in parts}) > 1:
                raise BadInput(f"the rows of {key} must have as many numbers each")
            return np.stack(parts, axis=1)
        return np.full(self.count, value)

    def unit(self, value: object, key: str) -> Floats:
        """Unit vectors: a swept one, or one with few digits, is divided by its length."""
        array = self.array(value, key)
        length = np.sqrt((array * array).sum(axis=-1, keepdims=True))
        varies = bool(ranges_in(value, key))
        if varies and not (length > 0).all():
            raise BadInput(f"{key} must not be 0: it has a direction")
        near = np.abs(length - 1)
        return np.where((near > UNIT_TOLERANCE / 2) & (varies | (near < ROUNDED)), array / length, array)


def members_of(ball: BallTable, start: StartTable, given: Given, scale: float, names: tuple[str, ...]) -> Members:
    """The members of one table; raises BadInput for invalid ones."""
    with np.errstate(all="ignore"):  # a number beyond float64, and a direction that is 0, are refused by their names
        if ball.mass_tensor is not None and len(ball.mass_tensor) > 3:
            return _members_n(ball, start, given, scale, names)
        body, axes = _ball(ball, given)
        gamma, attitude, motion, of_momentum = _start(start, given, body)
        if axes is not None:
            attitude = attitude_to_principal(axes, attitude_with(gamma) if attitude is None else attitude)
            gamma, motion = (to_principal(axes, vector) for vector in (gamma, motion))
        gamma = unit_vertical(gamma)
        momentum = motion if of_momentum else scale * kernels.momentum_in_range(body, motion, gamma, scale)
        if start.vertical_momentum is not None:
            momentum = given.array(start.vertical_momentum, "start.vertical_momentum")[:, np.newaxis] * gamma
        if not np.isfinite(momentum).all():
            raise BadInput("𝒦 is beyond the range of float64, about 1.8e308; take other units")
        return Members(names, body, momentum, gamma, axes, attitude, _position(start, given, 2))


def _ball(table: BallTable, given: Given) -> tuple[Ball, Floats | None]:
    """The balls, and the rotations from their principal axes to the axes of the table, if they differ."""
    sizes, contact = _sizes(table, given)
    axes, least, rounded = None, 0.0, 0.0
    (shape,) = table.given("mass_tensor", "inertia", "preset")
    with said_by("ball", shape):
        if table.mass_tensor is not None:
            tensor = given.array(table.mass_tensor, "ball.mass_tensor")
        elif table.preset is not None:
            tensor = PRESETS[table.preset](**sizes)
        else:
            inertia = given.array(table.inertia, "ball.inertia")
            least = balls.rounded_by(table.inertia)
            rounded = least + size_rounded_by(table.mass, table.radius) * float(np.max(contact))
            tensor = mass_tensor_of(inertia, least) if inertia.ndim == 2 else from_inertia_tensor(inertia)
        if tensor.ndim == 3:
            tensor, axes = principal(numbers(tensor, "inertia"), least)
        if "mass" in sizes:
            check_inside(tensor, sizes["mass"], sizes["radius"], rounded)
    with said_by("ball", _no_size(sizes) or shape):
        return Ball(tensor, contact, sizes.get("radius")), axes


def _sizes(table: BallTable, given: Given) -> tuple[dict[str, Floats], Floats]:
    """The given masses and lengths of a table, as arrays, and D."""
    sizes = {key: given.array(getattr(table, key), f"ball.{key}") for key in table.given("mass", "radius", "D", *KEYS)}
    with said_by("ball", _no_size(sizes) or ("D" if "D" in sizes else "mass")):
        return sizes, np.asarray(contact_term(sizes.get("mass"), sizes.get("radius"), sizes.get("D")))


def _no_size(sizes: Mapping[str, Floats]) -> str | None:
    """The key of a size that no ball has, if there is one."""
    bad = {"mass": np.less_equal, "radius": np.less_equal, "D": np.less}
    return next((key for key, fails in bad.items() if key in sizes and fails(sizes[key], 0).any()), None)


def _start(start: StartTable, given: Given, ball: Ball) -> tuple[Floats, Floats | None, Floats, bool]:
    """γ, the attitude if it is given, 𝒦 (or its direction) or ω, in the axes of the table, and whether it is 𝒦."""
    turned = start.given("gamma", *ATTITUDES)
    with said_by("start", turned[0] if turned else "gamma"):
        attitude = _attitude(start, given)
    if attitude is not None:
        gamma = kernels.rotate(inverse(attitude), np.array([0.0, 0.0, 1.0]))
    else:
        with said_by("start", "gamma"):
            gamma = given.unit(start.gamma or (0.0, 0.0, 1.0), "start.gamma")
            unit_vertical(gamma)
    body_to_space = attitude if attitude is not None else attitude_with(unit_vertical(gamma))
    if start.vertical_momentum is not None:
        return gamma, attitude, gamma, True
    if start.velocity is not None:
        motion = kernels.rotate(inverse(body_to_space), _rolling(start, given, ball))
        return gamma, attitude, motion, False
    key = "omega" if start.momentum is None else "momentum"
    motion = given.array(getattr(start, key), f"start.{key}")
    if motion.shape[-1] != 3 or motion.ndim != 2:
        raise Misfit(f"start.{key} must be three numbers for a ball in three dimensions", "start", key)
    if start.axes == "space":
        motion = kernels.rotate(inverse(body_to_space), motion)
    return gamma, attitude, motion, key == "momentum"


def _attitude(start: StartTable, given: Given) -> Floats | None:
    """The unit quaternions from the body to space, (count, 4), scalar first; None if the start does not have them."""
    if start.rpy is not None:
        angles = given.array(start.rpy, "start.rpy").T
        if (np.abs(angles) > 2 * np.pi).any():
            far = angles.flat[int(np.abs(angles).argmax())]
            raise BadInput(f'start.rpy is in radians, and {far:g} is more than a turn; of degrees write "{far:g} deg"')
        return np.stack(roll_pitch_yaw(list(zip(np.cos(angles / 2), np.sin(angles / 2), strict=True))), axis=-1)
    if (key := next(iter(start.given(*SCALAR_FIRST)), None)) is None:
        return None
    attitude = given.unit(getattr(start, key), f"start.{key}")
    length = np.sqrt((attitude * attitude).sum(axis=-1, keepdims=True))
    if (np.abs(length - 1) > UNIT_TOLERANCE).any():
        scalar = "first" if key == "attitude" else "last"
        raise BadInput(f"{key} must be a unit quaternion (scalar {scalar}), but its length is {length.max():.9g}")
    return (attitude / length)[:, SCALAR_FIRST[key]]


def _rolling(start: StartTable, given: Given, ball: Ball) -> Floats:
    """ω in space axes of a ball that rolls with a velocity (v₁, v₂) of its centre, and a spin.

    The point of contact, at -ρe₃ from the centre, is at rest: v = ρ ω × e₃ = ρ(ω₂, -ω₁, 0).
    """
    if ball.radius is None:
        raise BadInput("start.velocity needs ball.radius")
    velocity = given.array(start.velocity, "start.velocity")
    spin = given.array(0.0 if start.spin is None else start.spin, "start.spin")
    return np.stack([-velocity[..., 1] / ball.radius, velocity[..., 0] / ball.radius, spin], axis=-1)


def _members_n(ball: BallTable, start: StartTable, given: Given, scale: float, names: tuple[str, ...]) -> Members:
    """The members of a ball in more than three dimensions; 𝒦 of ω is that of E = εω in (4.13), as it is linear."""
    n = len(ball.mass_tensor or ())
    for key in ("velocity", "vertical_momentum", *ATTITUDES):
        if getattr(start, key) is not None:
            raise BadInput(f"start.{key} is for three dimensions; give omega or momentum, a skew matrix, and gamma")
    if start.axes == "space":
        raise BadInput('axes = "space" is for three dimensions')
    tensor, (sizes, contact) = given.array(ball.mass_tensor, "ball.mass_tensor"), _sizes(ball, given)
    if "mass" in sizes:
        check_inside(tensor, sizes["mass"], sizes["radius"])
    body = BallN(tensor, contact, sizes.get("radius"))
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
