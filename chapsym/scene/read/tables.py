"""The keys and tables of a scene file, as pydantic checks them; what they mean together is checked in `scene.py`."""

import math
import re
from typing import Annotated, Literal, Self, get_args

from pydantic import BaseModel, BeforeValidator, ConfigDict, Discriminator, Field, Tag, field_validator, model_validator
from pydantic_core import core_schema

from chapsym.accuracy.motion import FINEST
from chapsym.dynamics.outputs import OUTPUTS
from chapsym.numbers import own_name

from . import bodies
from .errors import LIST, MATRIX, Misfit
from .ranges import Range, Value, ranges_in, value
from .units import ANGLE, LENGTH, MASS, MOMENT, PURE, RATE, SPEED, TIME, TURNING, Dimension, has_unit, number

# The types of the keys: numbers with a dimension, and lists of them.


class Quantity:
    """A key that measures something; `swept` says whether a range may stand there.

    In the JSON Schema of pydantic it has a name, `{"quantity": ..., ...}`; `schema.py` spells that out, once each.
    """

    def __init__(self, dimension: Dimension, *, swept: bool = True, positive: bool = False) -> None:
        self.dimension, self.swept, self.positive = dimension, swept, positive

    def read(self, given: object) -> Value:
        """The value in SI; raises ValueError with what would be right."""
        found = value(given, self.dimension) if self.swept else number(given, self.dimension)
        if self.positive and isinstance(found, float) and not found > 0:
            raise ValueError("it must be greater than 0")
        return found

    def __get_pydantic_core_schema__(self, source: object, handler: object) -> core_schema.CoreSchema:
        return core_schema.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, schema: core_schema.CoreSchema, handler: object) -> dict[str, object]:
        return {"quantity": self.dimension.units, "swept": self.swept, "positive": self.positive}


class Metres(float):
    """A number that was given with a unit of length."""


class Accuracy(Quantity):
    """A positive number, or a length: then it is `Metres`."""

    def __init__(self) -> None:
        super().__init__(LENGTH, swept=False, positive=True)

    def read(self, given: object) -> Value:
        """The number; raises ValueError with what would be right."""
        if has_unit(given):
            return Metres(super().read(given))  # type: ignore[arg-type]
        return Quantity(PURE, swept=False, positive=True).read(given)


Length = Annotated[Value, Quantity(LENGTH)]
Mass = Annotated[Value, Quantity(MASS)]
Moment = Annotated[Value, Quantity(MOMENT)]
Rate = Annotated[Value, Quantity(RATE)]
Angle = Annotated[Value, Quantity(ANGLE)]
Speed = Annotated[Value, Quantity(SPEED)]
Pure = Annotated[Value, Quantity(PURE)]
Turning = Annotated[float, Quantity(TURNING, swept=False)]
Seconds = Annotated[float, Quantity(TIME, swept=False, positive=True)]


def _shape(given: object) -> str:
    return MATRIX if isinstance(given, list | tuple) and given and isinstance(given[0], list | tuple) else LIST


#: How the six numbers of a tensor are called.
_OF_A_TENSOR = re.compile("i?(xx|yy|zz|xy|xz|yz)", re.IGNORECASE)
ROWS = "write the tensor as rows: [[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]]"


def _listed(given: object) -> object:
    """A list as it is; a range instead of a whole list is a frequent slip."""
    if isinstance(given, dict):
        if any(_OF_A_TENSOR.fullmatch(str(key)) for key in given):
            raise ValueError(ROWS)
        raise ValueError("a range replaces one number, not a list: [{ linspace = [a, b, n] }, 0, 0]")
    return given


Vector = BeforeValidator(_listed)
Moments3 = Annotated[tuple[Moment, Moment, Moment], Vector]
MomentsN = Annotated[tuple[Moment, ...], Field(min_length=3), Vector]
PureN = Annotated[tuple[Pure, ...], Field(min_length=3), Vector]


def _of_three(given: object) -> object:
    """Three numbers or rows; six have several orders, and numbers in a text are those of a file of a robot."""
    if isinstance(given, list | tuple) and len(given) == 6:
        raise ValueError(
            "it must have 3 numbers, or 3 rows of 3: six have two orders (URDF and SDF: ixx ixy ixz iyy iyz izz; MJCF: "
            f"xx yy zz xy xz yz); {ROWS}"
        )
    if isinstance(given, str) and len(given.split()) > 1:
        numbers = ", ".join(given.replace(",", " ").split())
        raise ValueError(f"it must be a list of numbers in brackets: [{numbers[:60]}]")
    return given


Inertia = Annotated[
    Annotated[Moments3, Tag(LIST)] | Annotated[tuple[Moments3, Moments3, Moments3], Tag(MATRIX)],
    Discriminator(_shape),
    BeforeValidator(_of_three),
]
Momentum = Annotated[
    Annotated[Moments3, Tag(LIST)] | Annotated[tuple[MomentsN, ...], Field(min_length=4), Tag(MATRIX)],
    Discriminator(_shape),
]
RatesN = Annotated[tuple[Rate, ...], Field(min_length=3), Vector]
Omega = Annotated[
    Annotated[tuple[Rate, Rate, Rate], Vector, Tag(LIST)]
    | Annotated[tuple[RatesN, ...], Field(min_length=4), Tag(MATRIX)],
    Discriminator(_shape),
]
Turnings3 = Annotated[tuple[Turning, Turning, Turning], Vector]
Lengths3 = Annotated[tuple[Length, Length, Length], Vector]
Lengths2 = Annotated[tuple[Length, ...], Field(min_length=2), Vector]
Speeds2 = Annotated[tuple[Speed, Speed], Vector]
Angles3 = Annotated[tuple[Angle, Angle, Angle], Vector]
Quaternion = Annotated[tuple[Pure, Pure, Pure, Pure], Vector]

# The tables.

Count = Annotated[int, Field(strict=True, ge=0)]
Whole = Annotated[int, Field(strict=True, ge=1)]
Switch = Annotated[bool, Field(strict=True)]
#: Files and pictures have no place for control characters, those of lines and of the direction of writing among them.
Line = Annotated[str, Field(pattern=r"^[^\x00-\x1f\x7f-\x9f\u200e\u200f\u2028-\u202e\u2066-\u2069]*$")]
#: Of one ball: nobody waits for more steps, and the coordinates of more frames take gigabytes.
MOST_STEPS, MOST_FRAMES = 2**53, 10**8
#: A step in n dimensions solves n(n-1)/2 equations.
MOST_DIMENSIONS = 32
Accurate = Annotated[float, Accuracy()]
#: What the map has and the continuous motion has not.
OF_THE_MAP = frozenset({"discrete_momentum", "phase", "rotation_number"})
Output = Literal[*OUTPUTS]  # type: ignore[valid-type]
#: The keys of [start] that are quaternions, and where in them the scalar and the vector stand.
SCALAR_FIRST = {"attitude": (0, 1, 2, 3), "quaternion_xyzw": (3, 0, 1, 2)}
#: Those that say how the body is turned.
ATTITUDES = (*SCALAR_FIRST, "rpy")


class Table(BaseModel):
    """A table: keys that are not in it are refused."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    def given(self, *names: str) -> list[str]:
        """The keys, of these, that are given."""
        return [name for name in names if getattr(self, name) is not None]


def _one_of(given: list[str], table: str, names: str) -> None:
    if len(given) != 1:
        raise Misfit(f"{table}: give either {names}" + (f", not {' and '.join(given)}" if given else ""), *given[1:2])


class StartTable(Table):
    """The motion (momentum, omega, or velocity and spin) and the orientation: gamma, or one of `ATTITUDES`."""

    momentum: Momentum | None = Field(None, description="𝒦 = εK of one step; in n > 3 dimensions a skew matrix.")
    omega: Omega | None = Field(None, description="Angular velocity; in n > 3 dimensions a skew matrix.")
    axes: Literal["body", "space"] = Field("body", description="In which axes momentum or omega is given.")
    vertical_momentum: Moment | None = Field(None, description="h, for the momentum 𝒦 = hγ of one step.")
    velocity: Speeds2 | None = Field(None, description="Of the centre along x and y of the plane; the ball rolls.")
    spin: Rate | None = Field(None, description="About the vertical, upwards, with velocity; default 0.")
    gamma: PureN | None = Field(
        None, description="The vertical, upwards, in body axes, a unit vector; 0, 0, 1 without."
    )
    attitude: Quaternion | None = Field(None, description="Unit quaternion, scalar first, from body to space axes.")
    quaternion_xyzw: Quaternion | None = Field(None, description="The same with the scalar last, as in ROS and SciPy.")
    rpy: Angles3 | None = Field(
        None,
        description="Roll, pitch, yaw, instead of attitude: the body is turned about the fixed x, then y, then z "
        "axes of space (extrinsic xyz; the same as about its own z, y', x'', intrinsic), so that the rotation from "
        "body to space is Rz(yaw) Ry(pitch) Rx(roll), as in URDF.",
    )
    position: Lengths2 | None = Field(None, description="The contact point at the start; default 0, 0.")

    @model_validator(mode="after")
    def _one_motion(self) -> Self:
        motions = ("momentum", "vertical_momentum", "omega", "velocity")
        _one_of(self.given(*motions), "start", "momentum, omega or velocity (or vertical_momentum)")
        if self.spin is not None and self.velocity is None:
            raise Misfit("start.spin goes with start.velocity; omega holds the spin, too", "spin")
        if self.momentum is None and self.omega is None and "axes" in self.model_fields_set:
            raise Misfit("start.axes goes with start.omega or start.momentum", "axes")
        if len(keys := self.given("gamma", *ATTITUDES)) > 1:
            names = "gamma or attitude, which turns gamma to (0, 0, 1) (or quaternion_xyzw, or rpy)"
            raise Misfit(f"start: give either {names}, not {' and '.join(keys)}", keys[1])
        return self


class BallTable(Table):
    """A ball: mass_tensor, inertia or a preset; and mass and radius, or D."""

    name: Line | None = Field(None, min_length=1, max_length=80, description="Of the ball, in results and errors.")
    mass_tensor: MomentsN | None = Field(None, description="J = ∫x²dm, ∫y²dm, ∫z²dm; n numbers in n dimensions.")
    inertia: Inertia | None = Field(
        None,
        description="Principal moments of inertia about the centre, or the symmetric 3×3 tensor: off its diagonal "
        "stand -∫xy dm, ..., as ixy, ... of URDF, SDF and MJCF.",
    )
    preset: Literal[*bodies.PRESETS] | None = Field(None, description="A body whose moments are known.")  # type: ignore[valid-type]
    mass: Mass | None = Field(None, description="Of the whole ball.")
    radius: Length | None = Field(None, description="Of the ball.")
    center_of_mass: Lengths3 | None = Field(
        None, description="From the centre of the ball, which it must be: the ball is balanced."
    )
    D: Moment | None = Field(None, description="m ρ², instead of mass; 0 for a top.")
    thickness: Length | None = Field(None, description="Of the shell; thin by default. Presets shell and dumbbell.")
    point_mass: Mass | None = Field(None, description="Each of the two masses of a dumbbell.")
    separation: Length | None = Field(None, description="Of the two masses of a dumbbell.")
    block_mass: Mass | None = Field(None, description="Of a bowling ball's block, beyond the core that it displaces.")
    block_size: Lengths3 | None = Field(None, description="Edges of a bowling ball's block along the axes.")
    block_offset: Lengths3 | None = Field(None, description="Middle of a bowling ball's block, from the centre.")
    rotor: Turnings3 | None = Field(
        None, description="Angular momentum of a rotor inside, in the body's axes. For certify motion and judge alone."
    )
    start: StartTable | None = Field(None, description="Its own start, instead of [start].")

    @model_validator(mode="after")
    def _balanced(self) -> Self:
        if self.center_of_mass is not None and any(self.center_of_mass):
            known = [x for x in self.center_of_mass if not isinstance(x, Range)]
            offset = math.hypot(*known) if len(known) == 3 else None
            radius = self.radius if isinstance(self.radius, float) else None
            raise Misfit(bodies.unbalanced("ball.center_of_mass", offset, radius), "center_of_mass")
        return self

    @model_validator(mode="after")
    def _one_body(self) -> Self:
        _one_of(self.given("mass_tensor", "inertia", "preset"), "ball", "mass_tensor or inertia (or a preset)")
        keys = self.given(*sorted(set(bodies.KEYS)))
        if self.mass_tensor is not None and (n := len(self.mass_tensor)) > MOST_DIMENSIONS:
            clause = f"ball.mass_tensor has {n} numbers, and {MOST_DIMENSIONS} dimensions are the most"
            raise Misfit(f"{clause}: a step of more takes a second and longer", "mass_tensor")
        if self.preset is None:
            if keys:
                raise Misfit(f"ball.{keys[0]} goes with ball.preset", keys[0])
            return self._with_contact()
        if wrong := [key for key in keys if key not in bodies.keys_of(self.preset)]:
            raise Misfit(f"ball.{wrong[0]} does not go with the preset {self.preset}", wrong[0])
        needed = "mass", "radius", *bodies.keys_of(self.preset, required=True)
        if missing := [key for key in needed if getattr(self, key) is None]:
            raise Misfit(f"ball.{missing[0]} is missing: the preset {self.preset} needs it", "preset")
        return self._with_contact()

    def _with_contact(self) -> Self:
        if self.D is not None and self.mass is not None:
            raise Misfit("ball: give either D or mass and radius, not both D and mass", "D")
        if self.D is None and (self.mass is None or self.radius is None):
            missing = "mass" if self.mass is None else "radius"
            other = "radius" if missing == "mass" else "mass"
            has_other = getattr(self, other) is not None
            raise Misfit(f"ball.{missing} is missing: give {'it' if has_other else 'mass and radius'}, or D")
        return self


def ranges_of(ball: BallTable, start: StartTable) -> dict[str, Range]:
    """The ranges of a ball and of its start, by dotted key, those of the ball first."""
    found: dict[str, Range] = {}
    for name, table in (("ball", ball), ("start", start)):
        for key in type(table).model_fields:
            found |= ranges_in(getattr(table, key), f"{name}.{key}")
    return found


class RunTable(Table):
    """How long, what to keep, and where to write it; or, instead of steps, an accuracy."""

    steps: Count | None = Field(None, description="How many steps; or give time.")
    time: Seconds | None = Field(None, description="How long, instead of steps: a whole number of time steps.")
    time_step: Seconds | None = Field(
        None, description="ε; without it momentum is 𝒦 of one step, and there is no time."
    )
    every: Whole | None = Field(None, description="Keep every n-th state; default 1.")
    frames: Whole | None = Field(None, description="Keep this many states besides the start, instead of every.")
    outputs: tuple[Output, ...] | None = Field(None, description="What to keep; default momentum and gamma.")
    attitude: Switch = Field(False, description='Short for "attitude" in outputs.')
    contact: Switch = Field(False, description='Short for "contact" in outputs.')
    output: str | None = Field(None, description="Where the result is written.")
    order: Literal[2, 4, 6, 8] | None = Field(
        None, description="Of the composition in the time step; default 2, the map itself."
    )
    precision: Literal["single", "double", "double-double"] | None = Field(
        None, description="Of the numbers: 7, 16 or 31 digits; default double."
    )
    map: Switch = Field(False, description="Whether the map is meant where a motion in time is given; else the ball.")
    accuracy: Accurate | None = Field(
        None, description="Of the motion: in metres where the contact point is kept, else relative."
    )
    of: Literal["state", "contact"] | None = Field(None, description="What the accuracy is of.")
    limit: Seconds | None = Field(None, description="Of the processor, for a run to an accuracy; default 600 s.")
    proved: Switch = Field(
        False,
        description="Whether bounds of the error are proved: of the map in each frame, of the motion of one ball.",
    )

    @field_validator("precision", mode="before")
    @classmethod
    def _own_name(cls, value: object) -> object:
        return own_name(value)

    @model_validator(mode="after")
    def _steps_or_accuracy(self) -> Self:
        if self.outputs is not None and len(set(self.outputs)) < len(self.outputs):
            raise Misfit("run.outputs names an output twice", "outputs")
        if self.outputs == ():
            raise Misfit(f"run.outputs is empty: choose of {', '.join(OUTPUTS)}", "outputs")
        if self.accuracy is not None:
            self._check_accuracy()
        elif keys := self.given("limit", "of"):
            raise Misfit(f"run.{keys[0]} goes with run.accuracy", keys[0])
        if self.every is not None and self.frames is not None:
            raise Misfit("run: give either every or frames", "frames")
        if self.steps is None and self.time is None:
            raise Misfit("run.steps is missing (or give run.time)")
        if self.steps is not None and self.time is not None:
            raise Misfit("run: give either steps or time", "time")
        if self.time_step is None and self.time is not None:
            if self.every is not None:
                raise Misfit("run.every needs run.time_step: without, give run.frames", "every")
            if self.frames is not None and self.frames > MOST_FRAMES:
                raise Misfit(f"run.frames is more than {MOST_FRAMES}", "frames")
            if not self.time * (self.frames or 1) < math.inf:
                raise Misfit(f"run.time is {self.time:.3g} s, more than anybody waits for", "time")
        self.counts()
        return self

    def of_the_map(self) -> str | None:
        """The key by which the map is meant, if there is one."""
        if self.map:
            return "map"
        keys = self.given("order", "precision")
        return keys[0] if keys else "outputs" if set(self.names()) & OF_THE_MAP else None

    def _check_accuracy(self) -> None:
        if (key := self.of_the_map()) is not None:
            raise Misfit(f"run.accuracy is of the motion, and run.{key} of the map: leave out one of them", key)
        if self.time is None and self.time_step is None:
            raise Misfit("run.accuracy needs run.time, in seconds", "accuracy")
        if self.time_step is not None and self.accuracy is not None and self.accuracy < FINEST:
            clause = f"run.accuracy below {FINEST:g} takes more digits than float64 has: give run.time and run.frames"
            raise Misfit(f"{clause} without run.time_step", "accuracy")
        if isinstance(self.accuracy, Metres) and self.accurate_of() == "state":
            clause = 'of the state it is relative; a length goes with of = "contact"'
            raise Misfit(f"run.accuracy has a unit, but {clause}", "accuracy")

    def _counted(self) -> tuple[int, int]:
        """The steps, and how many between two frames; raises where they are not whole."""
        steps, time, step = self.steps, self.time, self.time_step
        if steps is None:
            assert time is not None
            assert step is not None
            ratio = time / step
            if not ratio < MOST_STEPS:
                raise Misfit(f"run.time is {ratio:.3g} time steps, more than anybody waits for", "time")
            steps = round(ratio)
            if abs(ratio - steps) > 4 * 2.0**-52 * ratio:  # time, time_step and their ratio are rounded
                whole = max(steps, 1)
                raise Misfit(
                    f"run.time is {ratio:.9g} time steps, which is no whole number: take time = {whole * step:.9g} or "
                    f"time_step = {time / whole!r}",
                    "time",
                )
        if not steps < MOST_STEPS:
            raise Misfit(f"run.steps is {float(min(steps, 10**300)):.3g}, more than anybody waits for", "steps")
        if step is not None and not steps * step < math.inf:
            raise Misfit("run.steps times run.time_step is beyond the range of float64, about 1.8e308 s", "steps")
        frames = self.frames if self.frames is not None else steps // (self.every or 1)
        if frames > MOST_FRAMES:
            raise Misfit(f"run keeps {frames} frames of a ball, and {MOST_FRAMES} are the most: give every or frames")
        if self.frames is None:
            return steps, self.every or 1
        if steps % self.frames:
            near = [n for n in range(self.frames, 0, -1) if steps % n == 0][:1] if self.frames < 10**6 else []
            clause = f"; {near[0]} do" if near else ""
            raise Misfit(f"run.frames: {steps} steps do not divide into {self.frames} equal parts{clause}", "frames")
        return steps, max(steps // self.frames, 1)

    def counts(self) -> tuple[int, int]:
        """(steps, every); of a time without time_step (frames, 1)."""
        return (self.frames or 1, 1) if self.time_step is None and self.time is not None else self._counted()

    def accurate_of(self) -> str:
        """What the accuracy is of: the contact point where it is kept and nothing else is said."""
        return self.of or ("contact" if "contact" in self.names() else "state")

    def names(self) -> tuple[str, ...]:
        """The outputs, each once, in the order of `OUTPUTS`."""
        wanted = {"momentum", "gamma"} if self.outputs is None else set(self.outputs)
        wanted |= {name for name in ("attitude", "contact") if getattr(self, name)}
        return tuple(name for name in OUTPUTS if name in wanted)


class SweepTable(Table):
    """How ranges that are drawn make balls."""

    samples: Whole | None = Field(None, description="Draws at each point of the other ranges.")
    seed: Annotated[Count, Field(le=2**63 - 1)] = Field(
        0, description="Of the draws: the same seed gives the same balls on every machine."
    )


#: The keys of each table, for suggestions where a key is unknown.
KEYS: dict[str, tuple[str, ...]] = {
    "": ("title", "description", "ball", "start", "run", "sweep"),
    "ball": tuple(BallTable.model_fields),
    "start": tuple(StartTable.model_fields),
    "run": tuple(RunTable.model_fields),
    "sweep": tuple(SweepTable.model_fields),
}


def _dimension(annotation: object) -> Dimension | None:
    """The dimension of the first quantity in a type."""
    own = (part.dimension for part in getattr(annotation, "__metadata__", ()) if isinstance(part, Quantity))
    return next(own, None) or next(filter(None, map(_dimension, get_args(annotation))), None)


#: What each key of a ball, a start and a run measures.
DIMENSIONS: dict[str, Dimension] = {
    name: measured
    for table in (BallTable, StartTable, RunTable)
    for name, field in table.model_fields.items()
    if (measured := _dimension(field.annotation)) is not None
}


def units_of(key: str) -> str:
    """The SI unit of a dotted key such as "start.omega.1"."""
    return DIMENSIONS[key.split(".")[1]].units
