"""The types of the keys of a scene: numbers with a dimension, and lists of them."""

from typing import Annotated, Any

from pydantic import BeforeValidator, Discriminator, Field, GetJsonSchemaHandler, Tag
from pydantic_core import core_schema

from .ranges import Value, value
from .units import ANGLE, LENGTH, MASS, MOMENT, PURE, RATE, SPEED, TIME, TURNING, Dimension, has_unit, number


class Quantity:
    """A key that measures something; `swept` says whether a range may stand there.

    In the JSON Schema of pydantic it is told by name, `{"quantity": ..., ...}`; `schema.py` spells that out, once each.
    """

    def __init__(self, dimension: Dimension, *, swept: bool = True, positive: bool = False) -> None:
        self.dimension, self.swept, self.positive = dimension, swept, positive

    def read(self, given: Any) -> Value:
        """The value in SI; raises ValueError with what would be right."""
        found = value(given, self.dimension) if self.swept else number(given, self.dimension)
        if self.positive and isinstance(found, float) and not found > 0:
            raise ValueError("it must be greater than 0")
        return found

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> core_schema.CoreSchema:
        return core_schema.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(
        self, schema: core_schema.CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        return {"quantity": self.dimension.units, "swept": self.swept, "positive": self.positive}


class Metres(float):
    """A number that was given with a unit of length."""


class Accuracy(Quantity):
    """A positive number, or a length: then it is `Metres`."""

    def __init__(self) -> None:
        super().__init__(LENGTH, swept=False, positive=True)

    def read(self, given: Any) -> Value:
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

#: The tags of lists and matrices are no keys: errors leave them out.
LIST, MATRIX = "(list)", "(matrix)"


def _shape(given: Any) -> str:
    return MATRIX if isinstance(given, list | tuple) and given and isinstance(given[0], list | tuple) else LIST


def _listed(given: Any) -> Any:
    """A list as it is; a range in the place of a whole list is a frequent slip."""
    if isinstance(given, dict):
        raise ValueError("a range stands in the place of one number, not of a list: [{ linspace = [a, b, n] }, 0, 0]")
    return given


Vector = BeforeValidator(_listed)
Moments3 = Annotated[tuple[Moment, Moment, Moment], Vector]
MomentsN = Annotated[tuple[Moment, ...], Field(min_length=3), Vector]
PureN = Annotated[tuple[Pure, ...], Field(min_length=3), Vector]
Inertia = Annotated[
    Annotated[Moments3, Tag(LIST)] | Annotated[tuple[Moments3, Moments3, Moments3], Tag(MATRIX)], Discriminator(_shape)
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
