"""Expressions to straight-line Python: `+ - * /`, integers and names, and nothing else.

The text must mean the same on float, arrays, mpf, arb and Fraction.  So integer powers are products,
a rational coefficient p/q multiplies by p and divides by q, and a number that is not an integer
is never printed on its own.
"""

from collections.abc import Iterator, Sequence

import sympy as sp
from sympy.core.sorting import default_sort_key


class NotStraightLine(ValueError):
    """The expression needs more than + - * / and integers."""


def eliminate(expressions: Sequence[sp.Expr], taken: Sequence[sp.Symbol]) -> tuple[list, list[sp.Expr]]:
    """Common subexpressions as (symbol, expression) pairs t0, t1, ..., and what is left."""
    names = {symbol.name for symbol in taken}
    symbols = (s for s in sp.numbered_symbols("t") if s.name not in names)
    terms, rest = sp.cse(list(expressions), symbols=symbols, order="canonical")
    return _name_bases(terms, rest, symbols)


def _name_bases(terms: list, rest: list, symbols: Iterator[sp.Symbol]) -> tuple[list, list[sp.Expr]]:
    """Gives every base of a power that is not a name one: the product of its copies repeats it."""
    named: list = []
    bases: dict[sp.Expr, sp.Symbol] = {}

    def name(expr: sp.Expr) -> sp.Expr:
        powers = [p for p in expr.atoms(sp.Pow) if not p.base.is_Symbol and abs(p.exp) > 1]
        for power in sorted(powers, key=default_sort_key):
            if power.base not in bases:
                bases[power.base] = next(symbols)
                named.append((bases[power.base], power.base))
            expr = expr.xreplace({power: bases[power.base] ** power.exp})
        return expr

    for symbol, term in terms:
        named.append((symbol, name(term)))
    return named, [name(expr) for expr in rest]


def text(expr: sp.Expr) -> str:
    """The Python text of an expression."""
    return _sum(sp.sympify(expr))


def _sum(expr: sp.Expr) -> str:
    terms = sorted(sp.Add.make_args(expr), key=_positive_first)
    pieces = [_product(term) for term in terms]
    joined = pieces[0] + "".join(f" - {p[1:]}" if p.startswith("-") else f" + {p}" for p in pieces[1:])
    return joined


def _positive_first(term: sp.Expr) -> tuple:
    return bool(term.could_extract_minus_sign()), default_sort_key(term)


def _product(expr: sp.Expr) -> str:
    coefficient, factors = expr.as_coeff_mul()
    if not coefficient.is_Rational:
        raise NotStraightLine(f"{expr} has the coefficient {coefficient}, which is not rational")
    above: list[str] = []
    below: list[str] = []
    for factor in sorted(factors, key=default_sort_key):
        base, power = factor.as_base_exp()
        if not power.is_Integer:
            raise NotStraightLine(f"{factor} is not an integer power; give the root as an input")
        (above if power > 0 else below).extend([_factor(base)] * abs(int(power)))
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


def _factor(expr: sp.Expr) -> str:
    if expr.is_Symbol or (expr.is_Integer and expr >= 0):
        return str(expr)
    if expr.is_Add or expr.is_Mul or expr.is_Pow:
        return f"({_sum(expr)})"
    raise NotStraightLine(f"{expr} is not a sum, a product or a name")
