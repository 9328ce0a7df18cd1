"""Zeros: systems with exactly one solution within a distance of a point, by Newton's test in intervals.

A zero has unknowns, equally many equations (trees that vanish), a point with values for the unknowns and for all other
names, and a radius.  Names may be defined for frequent subexpressions.  Trees in `nonzero` do not vanish there.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from fractions import Fraction
from functools import partial
from typing import Any

from .document import Data
from .form import once, sized
from .interval import Interval, Rejected
from .linear import Matrix, Vector, isolated, units
from .polynomial import Work
from .taylor import Dual, Numbers, derivatives
from .trees import size, value

#: The most unknowns.
MOST_UNKNOWNS = 20
#: The assumed number of bits before the point of a value, for the estimate of the work.
LARGE = 2000


def check_form(one: Data, point: Data, made: Collection[str], where: str) -> None:
    """Raises Rejected unless each name of a zero has one value, and there are as many equations as unknowns."""
    if not set(one["unknowns"]) <= point.keys() or not 1 <= len(one["unknowns"]) <= MOST_UNKNOWNS:
        raise Rejected(f"{where} must have from 1 to {MOST_UNKNOWNS} unknowns, with values at its point")
    if any(isinstance(entry, list) for entry in point.values()):
        raise Rejected(f"{where} has a matrix where a number must stand")
    once([*(name for name, _ in one["definitions"]), *point, *made], where)
    sized(one["equations"], len(one["unknowns"]), where)
    if Fraction(one["radius"]) <= 0:
        raise Rejected(f"{where} must have a radius above 0")


def check(one: Data, point: Mapping[str, Any], work: Work, where: str) -> None:
    """Raises Rejected unless there is exactly one solution within the radius in each unknown (linear.py)."""
    radius = Fraction(one["radius"])
    bits = 64 + 2 * max(radius.denominator.bit_length(), *(x.denominator.bit_length() for x in point.values()))
    unknowns, parts = one["unknowns"], size([one["definitions"], one["equations"], one["nonzero"]])
    work.spend((len(unknowns) + 3) * parts * (1 + (bits + LARGE) // 64))
    numbers = {name: Dual(Interval.about(x, bits)) for name, x in point.items()}
    box = [Interval.about(point[name], bits, radius) for name in unknowns]

    def of(part: str, values: Numbers) -> Numbers:
        known = {**numbers, **dict(zip(unknowns, values, strict=True))}

        def number(x: Fraction) -> Dual:
            return Dual(Interval.about(x, bits))

        for name, tree in one["definitions"]:
            known[name] = value(tree, known, number)
        return [value(tree, known, number) for tree in one[part]]

    def residual(at: Vector) -> Vector:
        return [x.value for x in of("equations", list(map(Dual, at)))]

    def jacobian(over: Vector) -> Matrix:
        return [x.slopes for x in derivatives(partial(of, "equations"), over, units(len(over), over[0]))]

    try:
        near = isolated(residual, jacobian, box)
    except Rejected:
        raise Rejected(f"{where} is not proved to have one solution within its radius") from None
    if not all(x.value.sign for x in of("nonzero", list(map(Dual, near)))):
        raise Rejected(f"{where} has something that is not proved to differ from 0 at the solution")
