"""float32 and float64, double-double, mpmath at N digits, and Arb balls at N bits: their numbers and output.

A kernel is `+ - * /` on numbers of any type.  A precision makes these numbers from exact fractions, and writes results.
"""

import copyreg
import math
import os
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property
from threading import RLock
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

import numpy as np

from .pair import Pair

if TYPE_CHECKING:
    from flint import arb
    from mpmath import MPContext, mpf
    from typing_extensions import TypeIs

T = TypeVar("T")

#: Significant digits of a double-double number in text: 2^-106 is 1.2e-32.
WRITTEN = 32


#: flint has one precision for all threads, so only one thread computes with it at a time.
FLINT = RLock()
# A process that is forked while another thread computes has a lock that nothing would release.
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=FLINT._at_fork_reinit)  # type: ignore[attr-defined]


#: The settings of the `with` blocks that have not ended, the innermost last.
_OPEN: dict[str, list[object]] = {"prec": [], "cap": []}


def flint_bits(bits: int) -> AbstractContextManager[None]:
    """Sets the bits of flint's numbers within a `with` block; other threads that call this function wait."""
    return _flint("prec", bits)


def flint_terms(count: int) -> AbstractContextManager[None]:
    """Sets the number of terms of flint's series within a `with` block, like `flint_bits`."""
    return _flint("cap", count)


def _parts(ball: "arb") -> "tuple[Callable[..., arb], tuple[object, ...]]":
    """The parts from which a ball of flint is rebuilt exactly."""
    if not ball.is_finite():
        return type(ball), (ball.str(),)
    return _ball, tuple((int(man), int(exp)) for man, exp in (ball.mid().man_exp(), ball.rad().man_exp()))


def _ball(middle: tuple[int, int], radius: tuple[int, int]) -> "arb":
    from flint import arb

    man, exp = radius
    more = 31 - man.bit_length()  # of the 30 bits of a radius; flint rounds a smaller part up
    return arb(arb(middle), arb(((man << more) - 1, exp - more))) if man else arb(middle)


def _context(count: int, guard: int) -> "MPContext":
    """A context of mpmath, whose numbers can be copied and sent to other processes."""
    import mpmath  # takes 40 ms with flint; float64 does not need it

    context = mpmath.MPContext()
    context.dps = count + guard
    context.mpf.__reduce__ = lambda x: (_number, (count, guard, tuple(map(int, x._mpf_))))
    return context


def _number(count: int, guard: int, parts: tuple[int, ...]) -> "mpf":
    from mpmath.libmp import MPZ

    return _common(count, guard).make_mpf((parts[0], MPZ(parts[1]), *parts[2:]))


#: Contexts of unpickled numbers.
_common = cache(_context)


@contextmanager
def _flint(name: str, value: int) -> Iterator[None]:
    from flint import arb, ctx

    copyreg.pickle(arb, _parts)  # for copies of results, and other processes
    with FLINT:
        before, mine, blocks = getattr(ctx, name), object(), _OPEN[name]
        try:
            blocks.append(mine)
            setattr(ctx, name, value)
            yield
        finally:  # an interrupt may delay this until the outer blocks have ended and have restored their settings
            if mine in blocks:
                setattr(ctx, name, before)
                del blocks[blocks.index(mine) :]


#: The limits beyond which a run exhausts memory, an error that cannot be caught.
MOST_DIGITS, MOST_BITS = 1_000_000, 10_000_000


def brief(value: object) -> str:
    """A short text of a refused value, for a sentence."""
    try:
        text = " ".join(repr(value).split())  # an array is one line, too
    except Exception:  # integers with more digits than Python prints, and whatever an object raises
        text = f"an object of the type {type(value).__name__} that has no short text"
    return text if len(text) <= 60 else text[:57] + "..."


def is_a(value: object, *kinds: type[T]) -> "TypeIs[T]":
    """Whether a value is of one of these types: `isinstance` asks the object, too, which may raise anything."""
    return issubclass(type(value), kinds)


def plain_text(value: object) -> str | None:
    """The characters of a text, whose class may have an equality of its own; None of anything else."""
    return str.__str__(value) if is_a(value, str) else None


def is_whole(value: object) -> bool:
    """Whether a value is a whole number of Python or NumPy."""
    own = is_a(value, int) and type(value).__int__ is not int.__int__  # which may raise anything
    return is_a(value, int, np.integer) and not is_a(value, bool, np.timedelta64) and not own


def _whole(precision: object, name: str, least: int, most: int) -> None:
    """Converts the count of a precision, and its guard, to integers of Python; raises ValueError for others."""
    kind = type(precision).__name__
    for field, lowest in ((name, least), ("guard", 0)):
        given = getattr(precision, field)
        if not is_whole(given) or not lowest <= int(given) <= most:
            raise ValueError(f"{field} of {kind} must be a whole number from {lowest} to {most}, not {brief(given)}")
        object.__setattr__(precision, field, int(given))


class Precision(ABC):
    """One kind of number."""

    #: The type of arrays of such numbers, or of the high halves of pairs.
    dtype: ClassVar[np.dtype] = np.dtype(object)

    @abstractmethod
    def number(self, value: Fraction) -> Any:
        """The number nearest to an exact fraction, or enclosing it."""

    @abstractmethod
    def write(self, value: Any) -> Any:
        """The number for JSON: a float, or a decimal string with more digits."""

    @property
    @abstractmethod
    def digits(self) -> int:
        """Significant decimal digits of the input that matter."""

    @contextmanager
    def working(self) -> Iterator[None]:
        """A context in which the arithmetic has this precision."""
        yield


@dataclass(frozen=True)
class Single(Precision):
    """IEEE float32."""

    dtype, digits = np.dtype(np.float32), 5

    def number(self, value: Fraction) -> np.float32:
        return np.float32(float(value))

    def write(self, value: np.float32) -> float:
        """The shortest decimal number that rounds to this float32: as a float64 it would have meaningless digits."""
        return float(str(np.float32(value)))


@dataclass(frozen=True)
class Double(Precision):
    """IEEE float64."""

    dtype, digits = np.dtype(np.float64), 12

    def number(self, value: Fraction) -> float:
        return float(value)

    def write(self, value: float) -> float:
        return float(value)


@dataclass(frozen=True)
class DoubleDouble(Precision):
    """Double-double numbers: pairs of float64, about 31 digits."""

    dtype, digits = np.dtype(np.float64), 28

    def number(self, value: Fraction) -> Pair:
        return Pair.of(value)

    def write(self, value: Pair) -> str:
        return Digits(WRITTEN).write(Digits(WRITTEN).number(value.exactly()))


@dataclass(frozen=True)
class Digits(Precision):
    """mpmath numbers, correct to `count` significant digits; each has its own context, without global state.

    Parameters
    ----------
    count : int
        Significant digits, from 1 to 1 000 000.
    guard : int, optional
        How many more the arithmetic carries, from 0 on.

    Raises
    ------
    ValueError
        For a count or a guard that is not such a number.

    Examples
    --------
    >>> import chapsym
    >>> ball = chapsym.Ball((1, 2, 4), 3)
    >>> after = chapsym.step(ball, (0.25, 0.5, 0.75), (0, 0, 1), precision=chapsym.Digits(30))
    >>> after.write()["momentum"][0]
    '0.324168252003759331987446324081'
    """

    count: int
    guard: int = 15

    def __post_init__(self) -> None:
        _whole(self, "count", 1, MOST_DIGITS)

    @cached_property
    def context(self) -> "MPContext":
        """The mpmath context of the numbers."""
        return _context(self.count, self.guard)

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self.count, self.guard)

    def number(self, value: Fraction) -> Any:
        return self.context.mpf(value.numerator) / value.denominator

    def write(self, value: Any) -> str:
        text = self.context.nstr(value, self.count, strip_zeros=False, min_fixed=-5, max_fixed=self.count)
        return str(text).removesuffix(".")

    @property
    def digits(self) -> int:
        return self.count


@dataclass(frozen=True)
class Enclosure(Precision):
    """Arb balls: rigorous enclosures, with about `bits` correct bits.

    Parameters
    ----------
    bits : int
        About how many bits are correct, from 2 to 10 000 000.
    guard : int, optional
        How many more the arithmetic carries, from 0 on.

    Raises
    ------
    ValueError
        For bits or a guard that are not such a number.

    Examples
    --------
    >>> import chapsym
    >>> ball = chapsym.Ball((1, 2, 4), 3)
    >>> after = chapsym.step(ball, (0.25, 0.5, 0.75), (0, 0, 1), precision=chapsym.Enclosure(60))
    >>> after.write()["momentum"][0]
    '[0.324168252003759332 +/- 5.62e-19]'
    """

    bits: int
    guard: int = 40

    def __post_init__(self) -> None:
        _whole(self, "bits", 2, MOST_BITS)

    def number(self, value: Fraction) -> Any:
        from flint import arb, fmpq

        return arb(fmpq(value.numerator, value.denominator))

    def write(self, value: Any) -> str:
        if not (text := value.str(self.digits + 2, radius=True)).startswith("["):
            return f"[{text} +/- 0]"
        return text.replace("[+/-", "[0 +/-")

    @property
    def digits(self) -> int:
        return int(self.bits * math.log10(2))

    @contextmanager
    def working(self) -> Iterator[None]:
        with flint_bits(self.bits + self.guard):
            yield


#: The precisions without a parameter, by the names that users give.
NAMED: dict[str, Precision] = {"single": Single(), "double": Double(), "double-double": DoubleDouble()}
#: Other names of these: NumPy's, and an old one.
OTHERS = {"float32": "single", "float64": "double", "quad": "double-double"}


def own_name(name: object) -> Any:
    """The name of a precision for another name of it, or NumPy's type; anything else unchanged."""
    if is_a(name, type, np.dtype) and name in (np.float32, np.float64):
        name = np.dtype(name).name
    text = plain_text(name)
    return name if text is None else OTHERS.get(text, text)


def in_words(identifier: str) -> str:
    """The readable name of a precision in JSON, where "quad" is double-double, and "Ball" an enclosure."""
    return identifier.replace("quad", "double-double").replace("Ball(", "Enclosure(")


def named(precision: "str | Precision") -> Precision:
    """The precision with this name; raises ValueError, one sentence, for anything else."""
    if is_a(precision, Precision):
        return precision
    precision = own_name(precision)
    if type(precision) is str and precision in NAMED:
        return NAMED[precision]
    clause = '"single", "double", "double-double", chapsym.Digits(n) or chapsym.Enclosure(bits)'
    raise ValueError(f"precision must be {clause}, not {brief(precision)}")
