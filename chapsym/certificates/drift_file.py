"""The file of a certificate of energy drift: written, read, and proved anew."""

import math
from fractions import Fraction
from typing import Any

from flint import ctx

from chapsym.dynamics import BadInput
from chapsym.dynamics.levels.start import fraction

from .balls import decade, shortest
from .document import FORMAT, digest, sealed
from .drift import NAMES, SYMMETRIES, Enclosures, Orbit, enclose, listed
from .taylor import NotEnclosed, exact

KIND = "energy-drift"
#: What a reader can wait for.
LIMITS = {"bits": (64, 4096), "order": (8, 1024)}


def document(orbit: Orbit, found: Enclosures, bits: int, order: int) -> dict[str, Any]:
    """The certificate as it is written; numbers are strings, exact rationals or decimals."""
    return sealed(
        KIND, statement(orbit),
        ball={"J": [str(x) for x in orbit.J], "D": str(orbit.D)},
        start={"momentum": [shortest(x) for x in orbit.momentum], "gamma": [str(x) for x in orbit.gamma]},
        varied=NAMES[orbit.varied], radius=shortest(orbit.radius),
        symmetry=list(orbit.signs), periods=periods(orbit), time=shortest(orbit.time), window=shortest(orbit.window),
        section=NAMES[orbit.section], along=NAMES[orbit.along], bits=bits, order=order,
        misses=[_outward(x) for x in found.misses],
        energy=_outward(found.energy), density=_outward(found.density),
    )  # fmt: skip


def periods(orbit: Orbit) -> int:
    """After how many T the orbit is closed."""
    return 1 if tuple(orbit.signs) == SYMMETRIES[0] else 2


def statement(orbit: Orbit) -> str:
    """What is proved, with the numbers of the orbit."""
    J, momentum = listed(orbit.J), ", ".join(map(shortest, orbit.momentum))
    return (
        f"The continuous ball with J = {J}, D = {orbit.D} has a closed orbit through gamma = {listed(orbit.gamma)}, "
        f"K = ({momentum}), K{orbit.varied + 1} up to {shortest(orbit.radius)}, of the period "
        f"{'T' if periods(orbit) == 1 else '2T'}; "
        "the integrals over [0, T] of X3(H) and of the divergence of X3 are not 0."
    )


def read(data: dict[str, Any]) -> Orbit:
    """The orbit of a certificate; raises BadInput where it is none of this kind, or says what its numbers do not."""
    try:
        if (data["format"], data["kind"]) != (FORMAT, KIND) or digest(data) != data["digest"]:
            raise BadInput(f"this is no certificate of the kind {KIND}, or its digest is not that of its text")
        orbit = _orbit(data)
        if (data["statement"], data["periods"]) != (statement(orbit), periods(orbit)):
            raise BadInput("the statement, or the number of periods, is not the one that the numbers make")
        for name, (least, most) in LIMITS.items():
            if type(data[name]) is not int or not least <= data[name] <= most:
                raise BadInput(f"{name} must be an integer from {least} to {most}")
        _stated(data)
        return orbit
    except BadInput:
        raise
    except (KeyError, TypeError, ValueError, AttributeError, ZeroDivisionError, RecursionError) as error:
        raise BadInput(f"the certificate lacks a field, or has another form: {error!r}") from None


def _orbit(data: dict[str, Any]) -> Orbit:
    ball, start = data["ball"], data["start"]
    return Orbit(
        tuple(map(Fraction, ball["J"])), Fraction(ball["D"]),
        tuple(map(Fraction, start["momentum"])), tuple(map(Fraction, start["gamma"])),
        NAMES.index(data["varied"]), Fraction(data["radius"]), tuple(data["symmetry"]), Fraction(data["time"]),
        Fraction(data["window"]), NAMES.index(data["section"]), NAMES.index(data["along"]),
    )  # fmt: skip


def _stated(data: dict[str, Any]) -> list[tuple[Fraction, Fraction]]:
    """The two misses and the two integrals, as (centre, radius)."""
    below, above = data["misses"]
    return [(Fraction(centre), Fraction(radius)) for centre, radius in (below, above, data["energy"], data["density"])]


def verify(data: dict[str, Any], bits: int | None = None, order: int | None = None) -> Enclosures:
    """Proves a certificate again, with 64 bits and 8 terms more unless they are given, and compares the enclosures.

    Raises BadInput for what is no certificate, NotEnclosed where what is stated does not contain what is found.
    """
    orbit = read(data)
    found = enclose(orbit, bits or data["bits"] + 64, order or data["order"] + 8)
    for ours, (centre, radius) in zip((*found.misses, found.energy, found.density), _stated(data), strict=True):
        with ctx.workprec(2 * data["bits"]):
            if not abs(ours - exact(centre)) <= exact(radius):
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
