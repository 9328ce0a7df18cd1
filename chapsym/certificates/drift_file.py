"""The file of a certificate of energy drift."""

import math
from fractions import Fraction
from typing import Any

from chapsym.dynamics.levels.start import fraction

from .balls import decade, shortest
from .document import stated
from .drift import NAMES, SYMMETRIES, Enclosures, Orbit

KIND = "energy-drift"


def document(orbit: Orbit, found: Enclosures, bits: int, order: int) -> dict[str, Any]:
    """The certificate as it is written; numbers are strings, exact rationals or decimals."""
    return stated(
        KIND,
        ball={"J": [str(x) for x in orbit.J], "D": str(orbit.D)},
        start={"momentum": [shortest(x) for x in orbit.momentum], "gamma": [str(x) for x in orbit.gamma]},
        varied=NAMES[orbit.varied], radius=shortest(orbit.radius),
        symmetry=list(orbit.signs), periods=1 if tuple(orbit.signs) == SYMMETRIES[0] else 2,
        time=shortest(orbit.time), window=shortest(orbit.window),
        section=NAMES[orbit.section], along=NAMES[orbit.along], bits=bits, order=order,
        misses=[_outward(x) for x in found.misses],
        energy=_outward(found.energy), density=_outward(found.density),
    )  # fmt: skip


def _outward(x: Any) -> list[str]:
    """A ball [centre, radius] in decimals, which contains it; twice as wide, for what other bits and terms find."""
    middle, radius = fraction(x.mid()), 2 * fraction(x.rad())
    digits = max(2 - decade(radius), 0) if radius else 60
    centre = rounded(middle, digits)
    return [shortest(centre), shortest(Fraction(math.ceil((radius + abs(middle - centre)) * 10**digits), 10**digits))]


def rounded(x: Fraction, digits: int) -> Fraction:
    """To so many decimals."""
    return round(x * 10**digits) / Fraction(10**digits)
