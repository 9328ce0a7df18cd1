"""From a scene to its balls: every range spelled out, in principal axes, checked."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from chapsym.dynamics import BadInput, Ball, BallN, front, so_n
from chapsym.dynamics.ball import SMALLEST, Floats, contact_term, mass_tensor_of, numbers
from chapsym.dynamics.ball_n import skew_matrices, unit_verticals
from chapsym.dynamics.map import UNIT_TOLERANCE, unit_vertical
from chapsym.dynamics.trajectories import attitude_with

from .bodies import PRESETS, check_inside, from_inertia_tensor, principal
from .errors import SceneError, place
from .members import Members, Parameter
from .ranges import MOST_BALLS, Range, Sweep, ranges_in
from .tables import BallTable, StartTable, units_of

if TYPE_CHECKING:
    from .scene import Scene

#: What is this near to a unit vector was meant to be one, and is divided by its length.
ROUNDED = 1e-6


def expand(scene: "Scene") -> Members:
    """The balls of a scene with their starts, the product of all ranges, checked.

    A range of [start] goes for each ball that has no start of its own, and is drawn afresh for each.
    Raises SceneError, which names the ball, for what no body can have and for starts that are none.
    """
    bodies = [_Body(scene, i) for i in range(len(scene.ball))]
    total = sum(len(body) for body in bodies)
    if total > MOST_BALLS:
        raise SceneError(f"the scene has {total} balls; a sweep has {MOST_BALLS} at most")
    parts = [body.members() for body in bodies]
    if len({part.dimension for part in parts}) > 1:
        raise SceneError("the balls of a scene roll in one space: all mass_tensors need as many numbers")
    return parts[0] if len(parts) == 1 else _joined(parts)


@dataclass(frozen=True, eq=False)
class _Body:
    """One [ball] of a scene, and its start."""

    scene: "Scene"
    index: int

    @property
    def ball(self) -> BallTable:
        return self.scene.ball[self.index]

    @property
    def start(self) -> StartTable:
        start = self.ball.start or self.scene.start
        assert start is not None
        return start

    @property
    def name(self) -> str:
        if self.ball.name is not None:
            return self.ball.name
        return "ball" if len(self.scene.ball) == 1 else f"ball {self.index + 1}"

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
        sweep = self.sweep()
        values, count = sweep.values(), len(sweep)
        names = (self.name,) if not values else tuple(f"{self.name} {i}" for i in range(1, count + 1))
        parameters = {key: Parameter(array, units_of(key)) for key, array in values.items()}

        def made(chosen: slice) -> Members:
            given = _Given({key: array[chosen] for key, array in values.items()}, len(range(count)[chosen]))
            return _members(self.ball, self.start, given, self.scene.scale, names[chosen])

        try:
            found = made(slice(0, count))
        except BadInput:
            first, error = _first_refused(made, count)
            told = ", ".join(f"{key} = {array[first]:.6g}" for key, array in list(values.items())[:4])
            raise SceneError(f"{self._place()}{names[first]}{f' ({told})' if told else ''}: {error}") from None
        return Members(**{**vars(found), "parameters": parameters})

    def _place(self) -> str:
        where = place(self.scene.name, self.scene.toml, ("ball", self.index))
        return f"{where}: " if where else ""


def _first_refused(made: Callable[[slice], Any], count: int) -> tuple[int, BadInput]:
    """The first ball that is refused, and why: a batch that is refused is halved."""
    low, high = 0, count
    while high - low > 1:
        middle = (low + high) // 2
        if _refusal(made, slice(low, middle)) is None:
            low = middle
        else:
            high = middle
    error = _refusal(made, slice(low, high))
    assert error is not None
    return low, error


def _refusal(made: Callable[[slice], Any], chosen: slice) -> BadInput | None:
    try:
        made(chosen)
    except BadInput as error:
        return error
    return None


@dataclass(frozen=True, eq=False)
class _Given:
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


def _members(ball: BallTable, start: StartTable, given: _Given, scale: float, names: tuple[str, ...]) -> Members:
    """The members of one table; raises BadInput for what cannot be."""
    with np.errstate(over="ignore", invalid="ignore", under="ignore"):
        if ball.mass_tensor is not None and len(ball.mass_tensor) > 3:
            return _members_n(ball, start, given, scale, names)
        body, axes = _ball(ball, given)
        gamma, attitude, motion, of_momentum = _start(start, given, body)
        if axes is not None:
            attitude = front.compose(attitude_with(gamma) if attitude is None else attitude, axes)
            gamma, motion = (front.rotate(_inverse(axes), vector) for vector in (gamma, motion))
        gamma = unit_vertical(gamma)
        momentum = motion if of_momentum else _momentum_of(motion, gamma, body, scale)
        return Members(
            names, body, numbers(momentum, "momentum"), gamma, axes, attitude, _position(start, given, 2)
        )  # fmt: skip


def _ball(table: BallTable, given: _Given) -> tuple[Ball, Floats | None]:
    """The balls, and what turns their principal axes to those of the table, if these are others."""
    keys = ("mass", "radius", "D", *(key for preset in PRESETS.values() for key in preset.keys))
    told = {key: given.array(value, f"ball.{key}") for key in keys if (value := getattr(table, key)) is not None}
    contact = np.asarray(contact_term(told.get("mass"), told.get("radius"), told.get("D")))
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
        if (tensor < 0).any():
            mass_tensor_of(tensor.sum(axis=-1, keepdims=True) - tensor)  # says that no body has it
    if "mass" in told:
        check_inside(tensor, told["mass"], told["radius"])
    return Ball(tensor, contact, told.get("radius")), axes


def _start(start: StartTable, given: _Given, ball: Ball) -> tuple[Floats, Floats | None, Floats, bool]:
    """γ, the attitude if it is given, 𝒦 or ω, all in the axes of the table, and whether it is 𝒦."""
    attitude = None
    if start.attitude is not None:
        attitude = given.unit(start.attitude, "start.attitude")
        length = np.sqrt((attitude * attitude).sum(axis=-1, keepdims=True))
        if (np.abs(length - 1) > UNIT_TOLERANCE).any():
            raise BadInput(f"attitude must be a unit quaternion (scalar first), but its length is {length.max():.9g}")
        attitude = attitude / length
        gamma = front.rotate(_inverse(attitude), np.array([0.0, 0.0, 1.0]))
    else:
        gamma = given.unit(start.gamma or (0.0, 0.0, 1.0), "start.gamma")
    body_to_space = attitude if attitude is not None else attitude_with(unit_vertical(gamma))
    if start.velocity is not None:
        motion = front.rotate(_inverse(body_to_space), _rolling(start, given, ball))
        return gamma, attitude, motion, False
    key = "omega" if start.momentum is None else "momentum"
    motion = given.array(getattr(start, key), f"start.{key}")
    if motion.shape[-1] != 3 or motion.ndim != 2:
        raise BadInput(f"start.{key} must be three numbers for a ball in three dimensions")
    if start.axes == "space":
        motion = front.rotate(_inverse(body_to_space), motion)
    return gamma, attitude, motion, key == "momentum"


def _rolling(start: StartTable, given: _Given, ball: Ball) -> Floats:
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
    momentum = scale * front.contact_momentum(omega, gamma, ball.mass_tensor, ball.D)
    lost = (np.abs(momentum).max(axis=-1) < SMALLEST) & omega.any(axis=-1) & (ball.inertia > 0).all(axis=-1)
    if lost.any():
        raise BadInput("𝒦 = εK is below the range of float64, about 2.2e-308; take a longer time step or other units")
    return momentum


def _members_n(ball: BallTable, start: StartTable, given: _Given, scale: float, names: tuple[str, ...]) -> Members:
    """The members of a ball in more than three dimensions; 𝒦 of ω is that of E = εω in (4.13), as it is linear."""
    n = len(ball.mass_tensor or ())
    for key in ("velocity", "attitude"):
        if getattr(start, key) is not None:
            raise BadInput(f"start.{key} is for three dimensions; give omega or momentum, a skew matrix, and gamma")
    if start.axes == "space":
        raise BadInput('axes = "space" is for three dimensions')
    told = {
        key: given.array(x, f"ball.{key}") for key in ("mass", "radius", "D") if (x := getattr(ball, key)) is not None
    }
    tensor, radius = given.array(ball.mass_tensor, "ball.mass_tensor"), told.get("radius")
    if "mass" in told:
        check_inside(tensor, told["mass"], told["radius"])
    body = BallN(tensor, np.asarray(contact_term(told.get("mass"), radius, told.get("D"))), radius)
    gamma = unit_verticals(given.unit(start.gamma or (*[0.0] * (n - 1), 1.0), "start.gamma"), n)
    key = "omega" if start.momentum is None else "momentum"
    motion = skew_matrices(given.array(getattr(start, key), f"start.{key}"), n, f"start.{key}")
    if key == "omega":
        motion = so_n.momentum(scale * motion, gamma, body.mass_tensor, body.D)
    return Members(names, body, numbers(motion, "momentum"), gamma, place=_position(start, given, n - 1))


def _position(start: StartTable, given: _Given, count: int) -> Floats | None:
    if start.position is None:
        return None
    if len(start.position) != count:
        raise BadInput(f"start.position must have {count} numbers")
    return given.array(start.position, "start.position")


def _inverse(quaternion: Floats) -> Floats:
    return quaternion * [1.0, -1.0, -1.0, -1.0]


def _joined(parts: list[Members]) -> Members:
    """The balls of several tables one after the other; what one of them does not have is as if it were not given."""
    sizes = [len(part) for part in parts]
    radii = [part.ball.radius for part in parts]
    known = [radius for radius in radii if radius is not None]
    if known and len(known) < len(radii):
        raise SceneError("some balls have a radius and others have none: give it to all")
    ball = type(parts[0].ball)(
        np.concatenate([part.ball.mass_tensor for part in parts]), np.concatenate([part.ball.D for part in parts]),
        np.concatenate(known) if known else None,
    )  # fmt: skip
    keys = dict.fromkeys(key for part in parts for key in part.parameters)
    parameters = {
        key: Parameter(
            np.concatenate([_values(part, key, size) for part, size in zip(parts, sizes, strict=True)]), units_of(key)
        )
        for key in keys
    }
    return Members(
        tuple(name for part in parts for name in part.names), ball,
        np.concatenate([part.momentum for part in parts]), np.concatenate([part.gamma for part in parts]),
        _filled([part.axes for part in parts], lambda i: np.tile([1.0, 0.0, 0.0, 0.0], (sizes[i], 1))),
        _filled([part.attitude for part in parts], lambda i: attitude_with(parts[i].gamma)),
        _filled([part.place for part in parts], lambda i: np.zeros((sizes[i], parts[i].dimension - 1))), parameters,
    )  # fmt: skip


def _values(part: Members, key: str, size: int) -> Floats:
    """The values of a parameter; NaN for balls of which it is not varied."""
    return part.parameters[key].values if key in part.parameters else np.full(size, np.nan)


def _filled(arrays: list[Floats | None], default: Callable[[int], Floats]) -> Floats | None:
    """The arrays one after the other, where any is given; else None."""
    if all(array is None for array in arrays):
        return None
    return np.concatenate([default(i) if array is None else array for i, array in enumerate(arrays)])
