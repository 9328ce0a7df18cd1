"""Numbers of a scene: SI, or a string with a unit, read by pint and checked against the dimension of the key."""

import re
import sys
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING

from chapsym.rationals import NotANumber, rational

if TYPE_CHECKING:
    from pint import Unit, UnitRegistry


@dataclass(frozen=True)
class Dimension:
    """The dimension of a key.

    name: as a sentence calls it.  units: SI, as written to files.  words: of the unit.  pint: the unit, as pint reads
    it.  example: a number, and a text with another unit.
    """

    name: str
    units: str
    words: str
    pint: str
    example: tuple[str, str]


LENGTH = Dimension("a length", "m", "metres", "m", ("0.1085", "108.5 mm"))
MASS = Dimension("a mass", "kg", "kilograms", "kg", ("7.26", "16 lb"))
TIME = Dimension("a time", "s", "seconds", "s", ("0.01", "10 ms"))
MOMENT = Dimension("a moment of inertia", "kg m2", "kg m²", "kg*m**2", ("0.032", "320 kg cm^2"))
TURNING = Dimension("an angular momentum", "kg m2 s-1", "kg m²/s", "kg*m**2/s", ("0.02", "200 kg cm^2/s"))
RATE = Dimension("an angular velocity", "rad s-1", "radians per second", "rad/s", ("3.14", "30 rpm"))
ANGLE = Dimension("an angle", "rad", "radians", "rad", ("0.5", "30 deg"))
SPEED = Dimension("a velocity", "m s-1", "metres per second", "m/s", ("8.0", "29 km/h"))
PURE = Dimension("a number without a unit", "1", "a number", "", ("0.5", "2/7"))
KNOWN = (LENGTH, MASS, TIME, MOMENT, TURNING, RATE, ANGLE, SPEED)
#: Dimensions that need an explicit unit of angle: in pint an angle is a number, and 1 Hz would be 1 rad/s.
ANGULAR = {RATE: "'30 rpm' or '3 rad/s'", ANGLE: "'30 deg' or '0.5 rad'"}

_FORM = re.compile(r"\s*([+-]?[0-9./]+(?:[eE][+-]?[0-9]+)?)\s*(.*?)\s*", re.ASCII | re.DOTALL)
#: Prefixes used as units, which pint would read with seconds, such as kilos.
_SHORT = re.compile(r"\b(?:kilo|mega|giga|milli|micro|nano|centi|deci|hecto)s?\b")
#: No parentheses, and no numbers but one-digit exponents, so that nothing is costly to evaluate.
_UNIT = re.compile(r"(?:1\s*/)?(?:[^\W\d]|[\s°²³·*/^-]|[1-9](?!\d))+")
#: Letters of a number with a unit.
LONGEST = 200


def number(value: object, dimension: Dimension = PURE) -> float:
    """A number in SI, or a text such as "2/7" or "30 rpm", as a float; raises ValueError with what would be right."""
    if isinstance(value, str):
        amount, factor = _amount(value, dimension)
        return _float(amount * factor)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError('it must be a number, or a text such as "2/7"' + ("" if dimension is PURE else _or(dimension)))
    if isinstance(value, int) and abs(value) > 10**300:
        raise ValueError("it is beyond the range of float64")
    if value - value != 0:
        raise ValueError(f"it must be finite, not {value}")
    return float(value)


def exact_number(value: object, dimension: Dimension = PURE) -> tuple[Fraction, Fraction]:
    """(a, b) of the number a + bπ that a text, with or without a unit, or a whole number means in SI.

    A turn, a degree and units derived from them are multiples of π.  Raises ValueError as `number` does.
    """
    amount, factor = _amount(str(value), dimension)
    if dimension not in (*ANGULAR, TURNING) or not has_unit(value):
        return amount * factor, Fraction(0)
    pi = Fraction(_registry().Quantity(Fraction(1), "pi").to_base_units().magnitude)
    # pint has π as a fraction of 49 digits: a unit that holds it as a factor has it in no denominator.
    part = factor / pi
    return (Fraction(0), amount * part) if part.denominator % pi.numerator else (amount * factor, Fraction(0))


def has_unit(value: object) -> bool:
    """Whether a value is a string of a number and something else."""
    parts = _FORM.fullmatch(value) if isinstance(value, str) and len(value) <= LONGEST else None
    return parts is not None and bool(parts[2])


def _or(dimension: Dimension) -> str:
    return f' or "{dimension.example[1]}"'


def _float(exact: Fraction) -> float:
    """The nearest float; raises ValueError if it would lose digits."""
    try:
        found = float(exact)
    except OverflowError:
        raise ValueError("it is beyond the range of float64") from None
    if abs(found) < sys.float_info.min and Fraction(found) != exact:
        raise ValueError("it is below 2.2e-308, where float64 loses its digits; take other units")
    return found


def _amount(text: str, dimension: Dimension) -> tuple[Fraction, Fraction]:
    """The number in a text, and its unit in SI."""
    parts = _FORM.fullmatch(text) if len(text) <= LONGEST else None
    unit = parts[2] if parts else ""
    try:
        amount = rational(parts[1] if parts and unit else text, "value")
    except NotANumber as error:
        clause = str(error).removeprefix("value: ")
        raise ValueError(clause + ("" if unit or dimension is PURE else _or(dimension))) from None
    return amount, _factor(unit, text.strip(), dimension) if unit else Fraction(1)


@cache
def _registry() -> "UnitRegistry[Fraction]":
    """pint's units with exact factors; loaded when a scene first has a unit, raises ValueError if it cannot be."""
    try:
        import pint
    except ImportError as error:
        raise ValueError(f"it has a unit, and pint, which reads units, cannot be loaded: {error}") from None
    units: UnitRegistry[Fraction] = pint.UnitRegistry(non_int_type=Fraction)
    units.define("@alias revolution = rev")
    return units


def _factor(unit: str, text: str, dimension: Dimension) -> Fraction:
    """The unit in SI; raises ValueError for what is no unit, or one of another dimension."""
    shown = text if len(text) <= 40 else text[:37] + "..."
    write = f"write {dimension.words}, such as {dimension.example[0]}, or '{dimension.example[1]}'"
    if len(unit) > 40 or not _UNIT.fullmatch(unit):
        raise ValueError(f"it is {dimension.name}, but {shown!r} is not a number with a unit; {write}")
    spelled = re.sub(r"([^\W\d])(-?[1-9])", r"\1^\2", unit)  # "kg m2" means kg m²
    if dimension is PURE:
        raise ValueError(f"it has no unit, but {shown!r} has one; {write}")
    registry = _registry()
    try:
        found = registry.parse_units(spelled)
        same = found.dimensionality == registry.parse_units(dimension.pint).dimensionality
    except Exception:  # pint passes on any error of its tokenizer; each means that this is no unit
        raise ValueError(f"it is {dimension.name}, but {unit!r} in {shown!r} is not a known unit; {write}") from None
    if not same:
        if _SHORT.search(spelled):
            raise ValueError(f"it is {dimension.name}, but {shown!r} says no unit, only how many; {write}")
        names = [known.name for known in KNOWN if _is(known, found)]
        clause = f"is {names[0]}" if names else "measures something else"
        raise ValueError(f"it is {dimension.name}, but {shown!r} {clause}; {write}")
    if not _is(dimension, found):
        clause = f"does not say which angle; write {ANGULAR[dimension]}"
        raise ValueError(f"it is {dimension.name}, but {shown!r} {clause}")
    return Fraction(registry.Quantity(Fraction(1), found).to_base_units().magnitude)


def _is(dimension: Dimension, unit: "Unit") -> bool:
    """Whether a unit has this dimension; an angle, or its rate, in turns, degrees or radians to the power of one."""
    wanted = _registry().parse_units(dimension.pint)
    if dimension in ANGULAR:
        return bool(_registry().get_base_units(unit)[1] == wanted)
    return bool(unit.dimensionality == wanted.dimensionality)
