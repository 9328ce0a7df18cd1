"""The file of a certificate of energy drift: written, read, and proved anew."""

import math
from fractions import Fraction
from typing import Any

from flint import ctx

from chapsym.dynamics import BadInput
from chapsym.dynamics.precise_start import fraction

from .balls import decade, shortest
from .document import digest, sealed
from .drift import NAMES, SYMMETRIES, Enclosures, Orbit, enclose, listed
from .taylor import NotEnclosed, exact

KIND = "energy-drift"


def document(orbit: Orbit, found: Enclosures, bits: int, order: int) -> dict[str, Any]:
    """The certificate as it is written; numbers are strings, exact rationals or decimals."""
    return sealed(
        KIND, statement(orbit),
        ball={"J": [str(x) for x in orbit.J], "D": str(orbit.D)},
        start={"momentum": [shortest(x) for x in orbit.momentum], "gamma": [str(x) for x in orbit.gamma]},
        varied=NAMES[orbit.varied], radius=shortest(orbit.radius),
        symmetry=list(orbit.signs), periods=_periods(orbit), time=shortest(orbit.time), window=shortest(orbit.window),
        section=NAMES[orbit.section], along=NAMES[orbit.along], bits=bits, order=order,
        misses=[_outward(x) for x in found.misses],
        energy=_outward(found.energy), density=_outward(found.density),
    )  # fmt: skip


def statement(orbit: Orbit) -> str:
    """What a certificate of the orbit proves, in words."""
    momentum = ", ".join(map(shortest, orbit.momentum))
    return (
        f"The continuous ball with J = {listed(orbit.J)}, D = {orbit.D} has a closed orbit through "
        f"gamma = {listed(orbit.gamma)}, K = ({momentum}), K{orbit.varied + 1} up to {shortest(orbit.radius)}, of the "
        f"period {'T' if _periods(orbit) == 1 else '2T'}; the integrals over [0, T] of X3(H) and of the divergence of "
        "X3 are not 0."
    )


def _periods(orbit: Orbit) -> int:
    return 1 if orbit.signs == SYMMETRIES[0] else 2


def read(data: dict[str, Any]) -> Orbit:
    """The orbit of a certificate; raises BadInput where it is none of this kind."""
    try:
        if data["kind"] != KIND or digest(data) != data["digest"]:
            raise BadInput(f"this is no certificate of the kind {KIND}, or its digest is not that of its text")
        ball, start = data["ball"], data["start"]
        orbit = Orbit(
            tuple(map(Fraction, ball["J"])), Fraction(ball["D"]),
            tuple(map(Fraction, start["momentum"])), tuple(map(Fraction, start["gamma"])),
            NAMES.index(data["varied"]), Fraction(data["radius"]), tuple(data["symmetry"]), Fraction(data["time"]),
            Fraction(data["window"]), NAMES.index(data["section"]), NAMES.index(data["along"]),
        )  # fmt: skip
    except (KeyError, TypeError, ValueError, AttributeError, ZeroDivisionError) as error:
        raise BadInput(f"the certificate lacks a field, or has another form: {error!r}") from None
    if data.get("statement") != statement(orbit) or data.get("periods") != _periods(orbit):
        raise BadInput("the statement of the certificate is not that of its numbers")
    return orbit


def verify(data: dict[str, Any], bits: int | None = None, order: int | None = None) -> Enclosures:
    """Proves a certificate again, with 64 bits and 8 terms more unless they are given, and compares the enclosures.

    Raises BadInput for what is no certificate, NotEnclosed where what is stated does not contain what is found.
    """
    orbit = read(data)
    found = enclose(orbit, bits or data["bits"] + 64, order or data["order"] + 8)
    stated = [*data["misses"], data["energy"], data["density"]]
    for ours, (centre, radius) in zip((*found.misses, found.energy, found.density), stated, strict=True):
        with ctx.workprec(2 * data["bits"]):
            if not abs(ours - exact(Fraction(centre))) <= exact(Fraction(radius)):
                raise NotEnclosed(f"{centre} ± {radius} is stated, and {ours} is found")
    return found


def _outward(x: Any) -> list[str]:
    """A ball [centre, radius] in decimals, which contains it; twice as wide, for what other bits and terms find."""
    middle, radius = fraction(x.mid()), 2 * fraction(x.rad())
    digits = max(2 - decade(radius), 0) if radius else 60
    centre = rounded(middle, digits)
    return [shortest(centre), shortest(Fraction(math.ceil((radius + abs(middle - centre)) * 10**digits), 10**digits))]


def rounded(x: Fraction, digits: int) -> Fraction:
    """To so many decimals."""
    return round(x * 10**digits) / Fraction(10**digits)
