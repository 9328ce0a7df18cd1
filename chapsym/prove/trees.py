"""Expressions of SymPy, and polynomials, as the trees that the checker reads."""

from collections.abc import Mapping, Sequence
from typing import Any

import sympy as sp
from flint import Ordering, fmpq, fmpq_mpoly_ctx

Monomial = tuple[int, ...]


class NotAlgebra(ValueError):
    """An expression that is no quotient of polynomials; the message says what it has in it."""


def tree(expr: Any) -> Any:
    """The tree of an expression: a name, a number, or ["+" | "*" | "^", operands...]."""
    if isinstance(expr, sp.Symbol):
        return expr.name
    if isinstance(expr, sp.Rational):
        return number(expr)
    if isinstance(expr, sp.Pow) and isinstance(expr.exp, sp.Integer):
        return ["^", tree(expr.base), int(expr.exp)]
    if isinstance(expr, sp.Add | sp.Mul):
        return ["+" if isinstance(expr, sp.Add) else "*", *map(tree, expr.args)]
    raise NotAlgebra(f"{type(expr).__name__} is neither a number, a symbol, a sum, a product nor a power")


def number(x: Any) -> int | str:
    """A rational number as it stands in a tree: an integer, or a quotient in quotes."""
    return int(x.p) if x.q == 1 else f"{x.p}/{x.q}"


def factored(polynomial: Mapping[Monomial, Any], names: Sequence[str]) -> Any:
    """The tree of a polynomial {exponents: coefficient}, in factors and nested: short where it has many terms."""
    context = fmpq_mpoly_ctx.get(tuple(names), Ordering.degrevlex)
    coefficients = {m: fmpq(int(c.numerator), int(c.denominator)) for m, c in polynomial.items()}
    if not coefficients:
        return 0
    constant, factors = context.from_dict(coefficients).factor()
    parts = [] if constant == 1 else [number(constant)]
    for factor, power in sorted(factors, key=str):
        parts.append(_power(_nested(factor.to_dict(), names), int(power)))
    return _list("*", parts) if parts else 1


def _nested(terms: Mapping[Monomial, Any], names: Sequence[str]) -> Any:
    """A sum of terms, with the variable that most of them have in front of these: Horner's form."""
    counts = [sum(m[i] > 0 for m in terms) for i in range(len(names))]
    most = max(range(len(names)), key=counts.__getitem__)
    if counts[most] < 2:
        return _list("+", [_term(m, c, names) for m, c in sorted(terms.items())])
    least = min(m[most] for m in terms if m[most])
    divided = {(*m[:most], m[most] - least, *m[most + 1 :]): c for m, c in terms.items() if m[most]}
    rest = {m: c for m, c in terms.items() if not m[most]}
    product = ["*", _power(names[most], int(least)), *_operands("*", _nested(divided, names))]
    return ["+", product, *_operands("+", _nested(rest, names))] if rest else product


def _term(monomial: Monomial, coefficient: Any, names: Sequence[str]) -> Any:
    factors = [_power(name, int(e)) for name, e in zip(names, monomial, strict=True) if e]
    return _list("*", [number(coefficient), *factors] if coefficient != 1 or not factors else factors)


def _power(base: Any, exponent: int) -> Any:
    return base if exponent == 1 else ["^", base, exponent]


def _list(operation: str, parts: list[Any]) -> Any:
    return parts[0] if len(parts) == 1 else [operation, *parts]


def _operands(operation: str, of: Any) -> list[Any]:
    return of[1:] if isinstance(of, list) and of[0] == operation else [of]
