"""Scene files in TOML: the balls, their starts, the duration, and the outputs."""

import json
import re
import sys
import tomllib
from contextlib import suppress
from copy import deepcopy
from pathlib import Path
from typing import Annotated, Any, Self

import numpy as np
from pydantic import BeforeValidator, Field, PrivateAttr, ValidationError, model_validator

from chapsym import files
from chapsym.accuracy.motion import DEFAULT

from . import robots
from .errors import Data, Misfit, SceneError, described, place
from .tables import KEYS, BallTable, Line, RunTable, StartTable, SweepTable, Table, ranges_of
from .task import Task
from .units import TIME, number

MOST_BYTES = 10_000_000
#: The largest length of a key: the time of tomllib grows with its square.
MOST_DOTS = 2000
#: The defaults of a run of a robot file.
FRAMES_OF_ROBOT = 1000
Balls = Annotated[
    tuple[BallTable, ...],
    Field(min_length=1, description="A ball; or several, each [[ball]]."),
    BeforeValidator(
        lambda given: given if isinstance(given, list | tuple) else [given],
        json_schema_input_type=BallTable | list[BallTable],
    ),
]


class Scene(Table):
    """A whole scene, checked as written; `expand` makes its balls, `task` its requested outputs."""

    title: Line | None = Field(None, description="One line.")
    description: str | None = Field(None, description="As long as you like.")
    ball: Balls
    start: StartTable | None = Field(None, description="The start of every ball that has none of its own.")
    run: RunTable
    sweep: SweepTable = Field(SweepTable.model_validate({}), description="How ranges that are drawn make balls.")

    _name: str = PrivateAttr("")
    _toml: str | None = PrivateAttr(None)
    _data: Data = PrivateAttr(default_factory=dict)

    @property
    def name(self) -> str:
        """Its file, or an empty string."""
        return self._name

    @property
    def toml(self) -> str | None:
        """The text of its file, if it is unchanged."""
        return self._toml

    @property
    def source(self) -> str:
        """The source of the scene: the TOML text of its file, or else JSON."""
        return self._toml if self._toml is not None else json.dumps(self._data, ensure_ascii=False, default=str)

    def task(self) -> Task:
        """The task of the run, with the defaults filled in."""
        run, (steps, every) = self.run, self.run.counts()
        searched = run.accuracy is not None
        return Task(
            run.names(), steps, every, run.time_step, run.order or 2, run.precision or "double",
            None if self.maps else float(run.accuracy or DEFAULT), None if self.maps or run.time_step else run.time,
            run.accurate_of() if searched else "state", 600.0 if run.limit is None else run.limit, searched,
            run.proved and self.maps,
        )  # fmt: skip

    @property
    def maps(self) -> bool:
        """Whether the map is meant: by run.map, order or precision, an output of it, a start in 𝒦, or n > 3.

        Else it is the continuous motion of the ball.
        """
        run = self.run
        if run.accuracy is not None:
            return False
        starts = [ball.start or self.start for ball in self.ball]
        of_one_step = any(start and start.given("momentum", "vertical_momentum") for start in starts)
        n = max(len(ball.mass_tensor or ()) for ball in self.ball)
        return run.of_the_map() is not None or of_one_step or n > 3

    def with_run(self, **changed: Any) -> Self:
        """The same scene with other values under [run], checked like those of a file; None removes a value."""
        data = deepcopy(self._data)
        data["run"] = {key: value for key, value in (data["run"] | changed).items() if value is not None}
        return checked(data, self._name)  # type: ignore[return-value]

    @model_validator(mode="after")
    def _together(self) -> Self:
        names = [ball.name for ball in self.ball if ball.name is not None]
        drawn = False
        for i, ball in enumerate(self.ball):
            if ball.start is None and self.start is None:
                raise Misfit("start is missing: give [start], or each ball its own start = { ... }", "ball", i)
            if names.count(ball.name or "") > 1:
                raise Misfit(f"two balls have the name {ball.name!r}", "ball", i, "name")
            drawn |= self._check_ball(i, ball)
        if self.sweep.samples is not None and not drawn:
            clause = "needs a range that is drawn, random or normal, and there is none"
            raise Misfit(f"sweep.samples {clause}", "sweep", "samples")
        return self

    def _check_ball(self, i: int, ball: BallTable) -> bool:
        """Raises if its keys are inconsistent; returns whether any of its ranges is random."""
        start, run = ball.start or self.start, self.run
        assert start is not None
        path: tuple[str | int, ...] = ("ball", i, "start") if ball.start else ("start",)
        motion = start.given("momentum", "vertical_momentum", "omega", "velocity")[0]
        of_one_step = motion.endswith("momentum")
        if run.accuracy is not None and of_one_step:
            clause = "run.accuracy needs start.omega, in rad/s: it is a motion in time that is approximated"
            raise Misfit(clause, *path, motion)
        if run.time_step is None and run.time is None and not of_one_step:
            raise Misfit(f"start.{motion} needs run.time_step, in seconds, or run.time", *path, motion)
        if run.time_step is None and run.time is not None and self.maps:
            raise Misfit("run.time needs run.time_step: the map has steps of one length", "run", "time")
        if start.velocity is not None and ball.radius is None:
            raise Misfit("start.velocity needs ball.radius: the ball rolls without slipping", *path, "velocity")
        if "contact" in run.names() and ball.radius is None:
            raise Misfit("the contact point needs the radius: give the ball its radius", "ball", i)
        drawn = [key for key, one in ranges_of(ball, start).items() if one.drawn]
        if drawn and self.sweep.samples is None:
            raise Misfit(f"{drawn[0]} is drawn: say how often, as samples = 100 under [sweep]", "ball", i)
        return bool(drawn)


def load(path: Path, omega: list[str] | None = None, time: str | None = None) -> Scene:
    """Reads a scene file; raises SceneError with the file, the line, the key and what would be right.

    omega, time: for a robot file, the start in rad/s, with its axes along those of space, and the duration in seconds,
    as written.
    """
    if path.suffix in robots.SUFFIXES:
        ball = robots.table(path)
        if omega is None or time is None:
            made = f"chapsym scene new ball.toml --from {files.pasted(path)} makes a scene of it"
            raise SceneError(f"{path} has a ball and no start: give --omega W1,W2,W3 and --time S, or {made}")
        run = {"time": time, "frames": FRAMES_OF_ROBOT, "outputs": ["contact", "attitude", "omega"]}
        return checked({"ball": ball, "start": {"omega": omega, "rpy": [0, 0, 0]}, "run": run}, str(path))
    text = _text(path)
    if omega is not None or time is not None:
        raise SceneError(f"{path} has a start and a time of its own: --omega and --time are for a robot's file")
    return checked(_parsed(text, path), str(path), text)


def ball_table(path: Path) -> Data:
    """[ball] of a scene file, or of a robot file (URDF, SDF, MJCF), with its numbers as written.

    The scene file needs neither start nor run.
    """
    if path.suffix != ".toml":
        return robots.table(path)
    text = _text(path)
    checked({"start": {"omega": [0, 0, 1]}, "run": {"time": 1, "frames": 1}} | _parsed(text, path), str(path), text)
    data = tomllib.loads(text, parse_float=lambda text: text.replace("_", ""))["ball"]
    if isinstance(data, list) and len(data) > 1:
        raise SceneError(f"{path} has {len(data)} balls: one is needed")
    return {key: value for key, value in (data[0] if isinstance(data, list) else data).items() if key != "start"}


def ball_place(path: Path, key: str) -> str:
    """The file of a ball, and the line and the entry of this key of `ball_table`."""
    if path.suffix != ".toml":
        return robots.place(path, key)
    text = _text(path)
    keys = ("ball", 0, key) if isinstance(_parsed(text, path)["ball"], list) else ("ball", key)
    return f"{place(str(path), text, keys)}: ball.{key}"


def written(name: str, table: Data) -> str:
    """A table in TOML, of strings, integers and lists of these."""
    rows = (f"{key} = {json.dumps(value, ensure_ascii=False)}" for key, value in table.items())
    return "\n".join([f"[{name}]", *rows, ""])


def load_for(path: Path, accuracy: float, time: float | None = None) -> Scene:
    """The scene of a file, to an accuracy after `time` seconds; by default its own time, or that of its steps."""
    data = _parsed(_text(path), path)
    run = data.get("run")
    if isinstance(run, dict):
        own, steps, step = (run.pop(name, None) for name in ("time", "steps", "time_step"))
        for name in ("every", "order", "precision"):
            run.pop(name, None)
        if time is None and own is None and isinstance(steps, int):
            with suppress(ValueError):  # a scene with an invalid step is refused below
                own = steps * number(step, TIME)
        data["run"] = run | {"accuracy": accuracy} | ({"time": own if time is None else time} if time or own else {})
    return checked(data, str(path))


def checked(data: Data, name: str = "", text: str | None = None) -> Scene:
    """A scene from plain data; raises SceneError with the key and what would be right.

    NumPy's arrays and numbers are taken as lists and numbers.
    name: the file of the data; text: its text, if unchanged, for the lines of errors.
    """
    try:
        data = _plain(data)
        scene = Scene.model_validate(data)
    except ValidationError as error:
        raise SceneError(described(error.errors(include_url=False), name, text, data, KEYS)) from None
    except RecursionError:
        raise SceneError(f"{name or 'this'} is no scene: its tables are nested too deeply") from None
    scene._name, scene._toml, scene._data = name, text, data
    return scene


def from_source(text: str) -> Scene:
    """The scene of a text, `Scene.source`, TOML or JSON; raises SceneError for any other text."""
    try:
        data = json.loads(text) if text.lstrip().startswith("{") else tomllib.loads(text, parse_float=toml_float)
    except (ValueError, RecursionError):
        raise SceneError("this plan has no scene that it could be made of again") from None
    return checked(data)


def _plain(value: Any) -> Any:
    """The data without NumPy's types."""
    if isinstance(value, dict):
        return {key: _plain(part) for key, part in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(part) for part in value]
    return value.tolist() if isinstance(value, np.ndarray | np.generic) else value


def _text(path: Path) -> str:
    try:
        return files.text_of(path, MOST_BYTES)
    except files.CannotRead as error:
        raise SceneError(str(error)) from None


def _parsed(text: str, path: Path) -> Data:
    if any(key.count(".") > MOST_DOTS for key in re.findall(r"[\w.\-\"' \t]+", text)):
        raise SceneError(f"{path} is no scene: its tables are nested too deeply")
    try:
        return tomllib.loads(text, parse_float=toml_float)
    except (ValueError, RecursionError) as error:  # tomllib: wrong syntax, huge integers, deep nesting
        clause = str(error).splitlines()[0]
        if isinstance(error, RecursionError):
            clause = "its values are nested too deeply"
        elif "int_max_str_digits" in clause:
            clause = "a whole number has more digits than Python reads, 4300"
        found = re.search(r" \(at line (\d+), column (\d+)\)$", clause)
        where = f"{path}, line {found[1]}, column {found[2]}" if found else str(path)
        raise SceneError(f"{where}: this is not TOML: {clause[: found.start()] if found else clause}") from None


def toml_float(text: str) -> Any:
    """A float, or its text if float64 loses digits, which `number` then reports with the key."""
    value = float(text)
    return text.replace("_", "") if abs(value) < sys.float_info.min else value
