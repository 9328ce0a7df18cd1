"""Expressions to straight-line Python: `+ - * /`, integers and names, and nothing else.

The text must mean the same on float, arrays, mpf, arb and Fraction.  So integer powers are products,
a rational coefficient p/q multiplies by p and divides by q, and a number that is not an integer
is never printed on its own.
"""

import sympy as sp
from sympy.core.sorting import default_sort_key


class NotStraightLine(ValueError):
    """The expression needs more than + - * / and integers."""


def text(expr: sp.Expr, as_products: bool = True) -> str:
    """The Python text of an expression; its powers as products, or as powers for a comparison of speed."""
    return _sum(sp.sympify(expr), as_products)


def _sum(expr: sp.Expr, as_products: bool) -> str:
    terms = sorted(sp.Add.make_args(expr), key=_positive_first)
    pieces = [_product(term, as_products) for term in terms]
    joined = pieces[0] + "".join(f" - {p[1:]}" if p.startswith("-") else f" + {p}" for p in pieces[1:])
    return joined


def _positive_first(term: sp.Expr) -> tuple:
    return bool(term.could_extract_minus_sign()), default_sort_key(term)


def _product(expr: sp.Expr, as_products: bool) -> str:
    coefficient, factors = expr.as_coeff_mul()
    if not coefficient.is_Rational:
        raise NotStraightLine(f"{expr} has the coefficient {coefficient}, which is not rational")
    above: list[str] = []
    below: list[str] = []
    for factor in sorted(factors, key=default_sort_key):
        base, power = factor.as_base_exp()
        if not power.is_Integer:
            raise NotStraightLine(f"{factor} is not an integer power; give the root as an input")
        (above if power > 0 else below).extend(_copies(_factor(base, as_products), abs(int(power)), as_products))
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


def _copies(factor: str, power: int, as_products: bool) -> list[str]:
    return [factor] * power if as_products or power == 1 else [f"{factor}**{power}"]


def _factor(expr: sp.Expr, as_products: bool) -> str:
    if expr.is_Symbol or (expr.is_Integer and expr >= 0):
        return str(expr)
    if expr.is_Add or expr.is_Mul or expr.is_Pow:
        return f"({_sum(expr, as_products)})"
    raise NotStraightLine(f"{expr} is not a sum, a product or a name")
