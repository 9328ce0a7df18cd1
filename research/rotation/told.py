"""Numbers and names of the study as its figures and sentences tell them."""

from decimal import Decimal
from fractions import Fraction
from typing import Any


def log10(text: str) -> float:
    """The decimal logarithm of |x|, which may be below the range of float64; -inf for 0."""
    x = abs(Decimal(text))
    return float(x.log10()) if x else float("-inf")


def scaled(texts: list[str], power: int) -> list[float]:
    """Decimal numbers in units of 10^power."""
    return [float(Decimal(x).scaleb(-power)) for x in texts]


def named(case: dict[str, Any], *names: str) -> str:
    """ "J = (1, 2, 4), D = 7, h = 12/5"."""
    told = {"J": "(" + ", ".join(map(str, case["tensor"])) + ")", "D": case["D"], "h": case["height"]}
    return ", ".join(f"{name} = {told[name]}" for name in names or ("J", "D", "h"))


def decimal(text: str) -> str:
    """ "9/20" as "0.45"."""
    return f"{float(Fraction(text)):g}"
