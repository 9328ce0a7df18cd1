"""A motion by theta functions, piece by piece: on each, all is a series, and what has no closed form is integrated."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
from flint import arb

from chapsym import generated

from ..levels.balls import unit
from ..levels.proved_root import TooWide
from ..levels.start import fraction
from ..principal_axes import quaternions
from .analytic import Analytic, Disc, size
from .functions import Thetas
from .reduction import Vector

#: Series are bounded on discs in which the divisor changes by this part of itself, and better on this part of them;
#: a piece is a part of that.
CHANGE, SMALLER, PART = 0.8, 0.75, 0.5
#: Bits that a term gains.
BITS_OF_TERM = 1.0


class Piece(NamedTuple):
    """The motion from one value of the parameter on.

    functions: what a frame is made from.  rates: of what is integrated, and their values at the start, in balls.
    length: of the piece.
    """

    functions: Sequence[Analytic]
    rates: Sequence[Analytic]
    values: Vector
    length: Any

    def integral(self, i: int, s: Any) -> Any:
        """The i-th of what is integrated, at s."""
        return self.values[i] + self.rates[i].integral(s)

    def end(self) -> Vector:
        """All of them at the end."""
        return tuple(self.integral(i, self.length) for i in range(len(self.rates)))


class Pieces(ABC):
    """A motion in balls of `precision` bits, as `flow.path.Path` is one; every method is to be called with that set.

    J, D, K in principal axes, attitude: a unit quaternion, radius: or None.  thetas: the functions, of the parameter.
    """

    thetas: Thetas
    piece: Piece

    def __init__(self, precision: int, J: Sequence[Any], D: Any, attitude: Sequence[Any], radius: Any) -> None:
        self.precision, self.steps, self.radius = precision, 0, radius
        self.terms = int(precision / BITS_OF_TERM) + 8
        self.tick: Callable[[], None] = lambda: None
        self.given: Callable[[dict[str, Vector]], dict[str, Vector]] = lambda frame: frame
        self.contact: Vector = (arb(0), arb(0))
        self.scale = J[0] + J[1] + J[2] + D
        self.J, self.D = tuple(x / self.scale for x in J), D / self.scale
        self.gamma: Vector = generated.rotation(*attitude)[6:]
        self.parameter = arb(0)

    def _after(self) -> Any:
        """What is integrated, at the end of the piece."""
        return self.piece.integral(0, self.piece.length)

    @property
    def time(self) -> Fraction:
        """Until when the motion is known."""
        return fraction(self._after().lower())

    @property
    def width(self) -> float:
        """The logarithm to base 2 of how far what is integrated may be off."""
        off = float(self.piece.values[0].rad())
        return float(np.log2(off)) if off else -float(self.precision)

    def advance(self, end: Fraction) -> None:
        """Goes on by a piece."""
        self.tick()
        values = self.piece.end()
        self.parameter += self.piece.length
        self.piece = self._piece(values)
        self.steps += 1

    @abstractmethod
    def _piece(self, values: Vector) -> Piece:
        """The piece from the parameter on, with these values of what is integrated."""

    @abstractmethod
    def frame(self, time: Fraction) -> dict[str, Vector]:
        """The motion at a time in the last piece."""

    def _quotients(self, divisor: Any, constants: dict[Any, Any]) -> dict[Any, Analytic]:
        """Constants times the functions over the divisor, from the parameter on; raises TooWide without a disc."""
        polynomials = self.thetas.series(self.parameter)
        below = polynomials[divisor]
        least = abs(below[0]).abs_lower()
        radius = radius_of(below, CHANGE * least, self.thetas.radius)
        if not radius > 0:
            raise TooWide
        functions, beyond = self.thetas.on(Disc(radius, self.terms), polynomials)
        least = (least - size(below - below[0], radius) - beyond).abs_lower()
        if not least > 0:
            raise TooWide
        by = functions[divisor].inverse(least)
        smaller = Disc((SMALLER * radius).mid(), self.terms)
        return {name: (f * by * constants[name]).on(smaller) for name, f in functions.items() if name != divisor}

    def _frame(self, turn: tuple[Any, Any], gamma: Vector, K: Vector) -> dict[str, Vector]:
        """A frame from three vectors in space and the same in the body, in rows, from γ and from K in units of it."""
        space, body = (np.array(rows, dtype=object) for rows in turn)
        attitude = unit(quaternions(space.T @ body))
        omega = generated.angular_velocity(*(*K, *gamma, *self.J, self.D))
        momentum = tuple(x * self.scale for x in K)
        return {"gamma": gamma, "angular_momentum": momentum, "omega": omega, "attitude": attitude}

    def _told(self, frame: dict[str, Vector]) -> dict[str, Vector]:
        if not all(x.is_finite() for vector in frame.values() for x in vector):
            raise TooWide
        return self.given(frame)


def constants(series: dict[Any, Any], divisor: Any, told: dict[Any, tuple[Any, Any]]) -> dict[Any, Any]:
    """What to multiply quotients with, from their values at the start, or from their rates, whichever tells more."""
    below, found = series[divisor], {}
    for name, (value, rate) in told.items():
        quotient = series[name][0] / below[0]
        risen = (series[name][1] - quotient * below[1]) / below[0]
        both = [x / y for x, y in ((value, quotient), (rate, risen)) if not y.contains(0)]
        if not both:
            raise TooWide
        found[name] = min(both, key=lambda x: float(x.rad()))
    return found


def radius_of(poly: Any, most: Any, largest: Any) -> Any:
    """About the R with Σ|cₖ|Rᵏ = most, k from 1, but no more than the largest: a short number."""
    whole = float(largest)
    if not 0.0 < whole < np.inf:
        raise TooWide
    sizes = np.array([float(abs(x).mid()) for x in poly.coeffs()[1:]])
    powers, low, high = np.arange(1, len(sizes) + 1), 0.0, 1.0
    sizes = np.exp(np.minimum(np.log(np.maximum(sizes, 1e-300)) + powers * np.log(whole), 600.0))
    for _ in range(16):
        middle = (low + high) / 2
        low, high = (middle, high) if (sizes * middle**powers).sum() < float(most) else (low, middle)
    return arb(low * whole)
