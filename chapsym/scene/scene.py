"""Scene files in TOML: parameters, the initial state, the number of steps, the output."""

import sys
import tomllib
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, model_validator

from chapsym.dynamics import BadInput, Ball, Trajectory, roll, trajectory
from chapsym.exact import NotANumber, rational


class SceneError(BadInput):
    """The scene cannot be run as it is written."""


def _number(value: Any) -> Any:
    """A TOML number, or a string such as "2/7", as a float."""
    if isinstance(value, str):
        try:
            exact: Fraction = rational(value, "value")
            found = float(exact)
            if abs(found) < sys.float_info.min and Fraction(found) != exact:
                raise ValueError("it is below 2.2e-308, where float64 loses its digits; take other units")
            return found
        except OverflowError:
            raise ValueError("it is beyond the range of float64") from None
        except NotANumber as error:
            raise ValueError(str(error)) from None
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError('it must be a number, or a string such as "2/7"')
    if isinstance(value, int) and abs(value) > 10**300:
        raise ValueError("it is beyond the range of float64")
    return value


def _toml_float(text: str) -> Any:
    """A float, or its text where float64 has not all digits: then `_number` says so, with the key."""
    value = float(text)
    return text.replace("_", "") if abs(value) < sys.float_info.min else value


Number = Annotated[float, BeforeValidator(_number), Field(allow_inf_nan=False)]
Vector = tuple[Number, Number, Number]
Count = Annotated[int, Field(strict=True, ge=0)]


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class BallTable(_Table):
    """[ball]: mass_tensor or inertia; D, or mass and radius."""

    mass_tensor: Vector | None = None
    inertia: Vector | None = None
    D: Number | None = None
    mass: Number | None = None
    radius: Number | None = None

    @model_validator(mode="after")
    def _one_tensor(self) -> Self:
        if (self.mass_tensor is None) == (self.inertia is None):
            raise ValueError("give either mass_tensor or inertia")
        return self

    def ball(self) -> Ball:
        """The ball."""
        given = {"mass": self.mass, "radius": self.radius, "D": self.D}
        if self.inertia is not None:
            return Ball.from_inertia(self.inertia, **given)
        return Ball.from_mass_tensor(self.mass_tensor, **given)  # type: ignore[arg-type]


class StartTable(_Table):
    """[start]: 𝒦 as `momentum` (kg m²), or `omega` (rad/s, body axes) with run.time_step; and γ."""

    momentum: Vector | None = None
    omega: Vector | None = None
    gamma: Vector = (0.0, 0.0, 1.0)

    @model_validator(mode="after")
    def _one_motion(self) -> Self:
        if (self.momentum is None) == (self.omega is None):
            raise ValueError("give either momentum or omega")
        return self


class RunTable(_Table):
    """[run]: how many steps, which to keep, what to follow, where to write.

    Or, instead of steps: `accuracy` of the contact point (m) or of the state after `time` seconds, as `of` says, at
    `frames` equal times, within `limit` seconds of the processor.
    """

    steps: Count | None = None
    every: Annotated[int, Field(strict=True, ge=1)] = 1
    time_step: Annotated[Number, Field(gt=0)] | None = None
    attitude: Annotated[bool, Field(strict=True)] = False
    contact: Annotated[bool, Field(strict=True)] = False
    output: str | None = None
    accuracy: Annotated[Number, Field(gt=0)] | None = None
    time: Annotated[Number, Field(gt=0)] | None = None
    of: Literal["state", "contact"] | None = None
    frames: Annotated[int, Field(strict=True, ge=1)] | None = None
    limit: Annotated[Number, Field(gt=0)] | None = None


class Scene(_Table):
    """A whole scene."""

    ball: BallTable
    start: StartTable
    run: RunTable

    def with_run(self, **changed: Any) -> Self:
        """The same scene with other values under [run]."""
        return self.model_copy(update={"run": self.run.model_copy(update=changed)})

    @model_validator(mode="after")
    def _steps_or_accuracy(self) -> Self:
        run = self.run
        told = {name for name in ("time", "of", "frames", "limit") if getattr(run, name) is not None}
        if run.accuracy is None:
            if told:
                raise ValueError(f"run.{min(told)} goes with run.accuracy; without it give run.steps")
            if run.steps is None:
                raise ValueError("run.steps is missing (or give run.accuracy and run.time)")
            return self
        chosen = [name for name in ("steps", "every", "time_step") if name in run.model_fields_set]
        if chosen:
            raise ValueError(f"run.accuracy chooses the steps: leave out run.{chosen[0]}")
        if run.time is None:
            raise ValueError("run.accuracy needs run.time, in seconds")
        if self.start.omega is None:
            raise ValueError("run.accuracy needs start.omega, in rad/s: it is a motion in time that is approximated")
        return self

    @model_validator(mode="after")
    def _omega_needs_time(self) -> Self:
        if self.run.accuracy is None and self.start.omega is not None and self.run.time_step is None:
            raise ValueError("start.omega needs run.time_step, in seconds")
        return self


def load(path: Path) -> Scene:
    """Reads a scene file; raises SceneError with the file, the key and what would be right."""
    return checked(_read(path), f"{path}: ")


def load_for(path: Path, accuracy: float, time: float | None = None) -> Scene:
    """The scene of a file, but to an accuracy after `time` seconds; without, its own time, or its steps' time."""
    data = _read(path)
    run = data.get("run")
    if isinstance(run, dict):
        own, steps, step = (run.pop(name, None) for name in ("time", "steps", "time_step"))
        run.pop("every", None)
        if time is None and own is None and isinstance(steps, int) and isinstance(step, int | float):
            own = steps * step
        data["run"] = run | {"accuracy": accuracy} | ({"time": own if time is None else time} if time or own else {})
    return checked(data, f"{path}: ")


def checked(data: dict[str, Any], where: str = "") -> Scene:
    """A scene from plain data; raises SceneError with the key and what would be right."""
    try:
        return Scene.model_validate(data)
    except ValidationError as error:
        raise SceneError(where + "; ".join(_sentence(e) for e in error.errors())) from None


def _read(path: Path) -> dict[str, Any]:
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise SceneError(f"{path} cannot be read: {error.strerror or error}") from None
    except UnicodeDecodeError:
        raise SceneError(f"{path} is not UTF-8 text") from None
    try:
        return tomllib.loads(text, parse_float=_toml_float)
    except (ValueError, RecursionError) as error:  # tomllib: wrong syntax, huge integers, deep nesting
        raise SceneError(f"{path} is not TOML: {str(error).splitlines()[0]}") from None


def _sentence(error: Any) -> str:
    """One problem of a scene: its key and what would be right."""
    key = ".".join(str(part) for part in error["loc"]) or "the scene"
    limits = error.get("ctx", {})
    kinds: dict[str, str] = {
        "missing": "is missing",
        "extra_forbidden": "is not a key of a scene",
        "int_type": "must be a whole number",
        "int_from_float": "must be a whole number",
        "bool_type": "must be true or false",
        "string_type": "must be a text in quotes",
        "tuple_type": "must be a list of numbers in brackets",
        "finite_number": "must be finite",
        "literal_error": f"must be {limits.get('expected')}",
        "too_long": f"must have {limits.get('max_length')} numbers",
        "greater_than": f"must be greater than {limits.get('gt')}",
        "greater_than_equal": f"must be at least {limits.get('ge')}",
    }
    told = kinds.get(error["type"])
    return f"{key} {told}" if told else f"{key}: {error['msg'].removeprefix('Value error, ')}"


def run(scene: Scene, progress: Callable[[int], None] = lambda steps_done: None) -> Trajectory:
    """Runs a scene; raises BadInput, and StepNotTaken with the trajectory so far."""
    if scene.run.accuracy is not None or scene.run.steps is None:
        from .accurate import run_accurately

        return run_accurately(scene).trajectory
    options: dict[str, Any] = {
        "every": scene.run.every,
        "attitude": scene.run.attitude,
        "contact": scene.run.contact,
        "progress": progress,
    }
    ball, start = scene.ball.ball(), scene.start
    if start.omega is not None and scene.run.time_step is not None:
        return roll(ball, start.omega, scene.run.time_step, scene.run.steps, gamma=start.gamma, **options)
    momentum: Any = start.momentum
    return trajectory(ball, momentum, start.gamma, scene.run.steps, time_step=scene.run.time_step, **options)
