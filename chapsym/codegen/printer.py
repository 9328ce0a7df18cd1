"""Expressions to straight-line Python: `+ - * /`, integers and names, and nothing else.

The text must compute the same on float, arrays, mpf, arb and Fraction.  So integer powers are products, a rational
coefficient p/q multiplies by p and divides by q, and no other number than an integer is printed.
"""

from collections.abc import Collection, Sequence

import sympy as sp
from sympy.core.sorting import default_sort_key

from chapsym.derive.quotient import in_sympy


class NotStraightLine(ValueError):
    """The expression needs more than + - * / and integers."""


#: The module with sin, cos, sqrt and pi for numbers of every type.
FUNCTIONS = "chapsym.numbers.functions"
#: Print an integer power as a product with a named base.
POWERS = "powers"
#: Print a sum as a balanced tree, with fewer dependent operations.
BALANCED = "balanced"


def text(expr: sp.Expr, passes: Collection[str] = (POWERS, BALANCED)) -> str:
    """The Python text of an expression; passes are omitted only to compare speeds."""
    return _sum(in_sympy(expr), passes)


def _sum(expr: sp.Expr, passes: Collection[str]) -> str:
    positive_first = lambda term: (bool(term.could_extract_minus_sign()), default_sort_key(term))  # noqa: E731
    pieces = [_product(term, passes) for term in sorted(sp.Add.make_args(expr), key=positive_first)]
    return _tree(pieces) if BALANCED in passes else _added(pieces)


def _added(pieces: Sequence[str]) -> str:
    return pieces[0] + "".join(f" - {p[1:]}" if p.startswith("-") else f" + {p}" for p in pieces[1:])


def _tree(pieces: Sequence[str]) -> str:
    """The sum as a balanced tree, of logarithmic depth."""
    if len(pieces) <= 3:
        return _added(pieces)
    half = (len(pieces) + 1) // 2
    first, rest = _tree(pieces[:half]), pieces[half:]
    if all(p.startswith("-") for p in rest):
        return f"{_grouped(first, half)} - {_grouped(_tree([p[1:] for p in rest]), len(rest))}"
    return f"{_grouped(first, half)} + {_grouped(_tree(rest), len(rest))}"


def _grouped(text: str, terms: int) -> str:
    return f"({text})" if terms > 1 else text


def _product(expr: sp.Expr, passes: Collection[str]) -> str:
    coefficient, factors = expr.as_coeff_mul()
    if not coefficient.is_Rational:
        raise NotStraightLine(f"{expr} has the coefficient {coefficient}, which is not rational")
    above: list[str] = []
    below: list[str] = []
    for factor in sorted(factors, key=default_sort_key):
        base, power = factor.as_base_exp()
        if not power.is_Integer:
            raise NotStraightLine(f"{factor} is not an integer power; give the root as an input")
        text, times = _factor(base, passes), abs(int(power))
        copies = [text] * times if POWERS in passes or times == 1 else [f"{text}**{times}"]
        (above if power > 0 else below).extend(copies)
    if not factors and coefficient.q != 1:
        raise NotStraightLine(f"the number {coefficient} would be rounded; multiply something by it instead")
    numerator = abs(coefficient.p)
    if numerator != 1 or not above:
        above.insert(0, str(numerator))
    if coefficient.q != 1:
        below.insert(0, str(coefficient.q))
    sign = "-" if coefficient < 0 else ""
    product = sign + " * ".join(above)
    if not below:
        return product
    return f"{product} / {below[0]}" if len(below) == 1 else f"{product} / ({' * '.join(below)})"


def _factor(expr: sp.Expr, passes: Collection[str]) -> str:
    if expr.is_Symbol or (expr.is_Integer and expr >= 0):
        return str(expr)
    if expr.is_Add or expr.is_Mul or expr.is_Pow:
        return f"({_sum(expr, passes)})"
    raise NotStraightLine(f"{expr} is not a sum, a product or a name")
