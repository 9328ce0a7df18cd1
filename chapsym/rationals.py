"""Rational numbers typed by a user: parsed exactly, never evaluated as code."""

import re
from collections.abc import Sequence
from decimal import MAX_EMAX, MIN_EMIN, ROUND_DOWN, Context, Decimal
from fractions import Fraction
from numbers import Integral, Rational
from typing import Any

_FORM = re.compile(r"[+-]?(\d+/\d+|(\d+(\.\d*)?|\.\d+)([eE][+-]?\d{1,4})?)", re.ASCII)
#: The largest exponent of 10 or 2.
LARGEST = 100_000


class NotANumber(ValueError):
    """The text is not a rational number."""


def rational(text: str, name: str) -> Fraction:
    """`1/3`, `-2`, `0.25` or `1e-12`, exactly; raises NotANumber with the place."""
    stripped = text.strip()
    if len(stripped) > 4_000 or not _FORM.fullmatch(stripped):
        raise NotANumber(f"{name}: {_short(stripped)!r} is not a number; write it as 1/3, -2, 0.25 or 1e-12")
    try:
        return Fraction(stripped)
    except ZeroDivisionError:
        raise NotANumber(f"{name}: {stripped!r} divides by zero") from None


def rationals(text: str, name: str, count: int) -> tuple[Fraction, ...]:
    """`count` numbers, separated by commas."""
    parts = text.split(",")
    if len(parts) != count:
        raise NotANumber(
            f"{name} takes {count} numbers separated by commas, such as 1,-1/2,3/4; {_short(text)!r} has {len(parts)}"
        )
    return tuple(rational(part, name) for part in parts)


def _short(text: str) -> str:
    return text if len(text) <= 40 else text[:37] + "..."


def mass_tensor_from(inertia: Sequence[Fraction]) -> tuple[Fraction, ...]:
    """J1, J2, J3 from the principal moments I1 = J2 + J3, ..., exactly."""
    half = sum(inertia, Fraction(0)) / 2
    return tuple(half - moment for moment in inertia)


def decimals(digits: int) -> Context:
    """Arithmetic of decimal numbers, rounded to 0, of any exponent and silent, whatever the user's own is."""
    return Context(prec=digits, rounding=ROUND_DOWN, Emin=MIN_EMIN, Emax=MAX_EMAX, traps=[])


def exact_fraction(x: Any) -> Fraction:
    """A number as it is: a Fraction, a Decimal, a float of any length, one of SymPy's rationals or of mpmath's floats.

    Of any other number it is the float64.

    Raises ValueError or OverflowError for one that is not finite, and OverflowError for an exponent beyond `LARGEST`.
    """
    if isinstance(x, Integral):  # those of NumPy would stay inside
        return Fraction(int(x))
    if isinstance(x, Rational):
        return Fraction(x)
    if isinstance(x, Decimal):
        if x.is_finite() and abs(x.adjusted()) > LARGEST:
            raise OverflowError(f"an exponent is {LARGEST} at most")
        return Fraction(x)
    if hasattr(x, "_mpf_"):
        sign, mantissa, exponent, _ = x._mpf_
        if not mantissa and exponent:  # mpmath's infinities, and what is no number
            raise ValueError("not finite")
        if abs(exponent) > LARGEST:
            raise OverflowError(f"an exponent is {LARGEST} at most")
        return (-1) ** sign * Fraction(int(mantissa)) * Fraction(2) ** exponent
    if hasattr(x, "as_integer_ratio"):  # NumPy's long doubles, too
        return Fraction(*x.as_integer_ratio())
    return Fraction(float(x))
