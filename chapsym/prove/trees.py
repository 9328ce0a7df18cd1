"""Expressions of SymPy, and polynomials, as the trees that the checker reads."""

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import sympy as sp
from flint import Ordering, fmpq, fmpq_mpoly_ctx

from chapsym.checker.trees import Tree

from .polynomials import Ratio

Monomial = tuple[int, ...]
#: A polynomial: coefficients by the exponents.
Terms = Mapping[Monomial, int | fmpq]
#: An object of JSON: a certificate, a record, or a part of one, with trees in it.
Data = dict[str, Any]


class NotAlgebra(ValueError):
    """An expression that is no quotient of polynomials; the message names the reason."""


def tree(expr: sp.Expr) -> Tree:
    """The tree of an expression."""
    if isinstance(expr, sp.Symbol):
        return expr.name
    if isinstance(expr, sp.Rational):
        return number(expr)
    if isinstance(expr, sp.Pow) and isinstance(expr.exp, sp.Integer):
        return ["^", tree(expr.base), int(expr.exp)]
    if isinstance(expr, sp.Add | sp.Mul):
        return ["+" if isinstance(expr, sp.Add) else "*", *map(tree, expr.args)]
    raise NotAlgebra(f"{type(expr).__name__} is neither a number, a symbol, a sum, a product nor a power")


def number(x: int | fmpq | sp.Rational) -> int | str:
    """A rational number in a tree: an integer, or a quotient as a string."""
    if isinstance(x, int):
        return x
    return int(x.p) if x.q == 1 else f"{x.p}/{x.q}"


def shared(wholes: Sequence[Ratio | int]) -> tuple[list[list[Tree]], list[Tree]]:
    """The trees of functions of parameters, with definitions for subexpressions that occur more than once.

    Zeros and ones, of unit matrices, are left out.
    """
    uses: Counter[int] = Counter()
    for whole in wholes:
        _count(whole, uses)
    named: dict[int, Tree] = {}
    definitions: list[list[Tree]] = []

    def found(of: Ratio | int) -> Tree:
        if not isinstance(of, Ratio):
            return int(of)
        if isinstance(of.made, str | int):
            return of.made
        if id(of) not in named:
            if of.made is None:
                whole = lowest_terms(of)
            else:
                operation, *operands = of.made
                whole = _simple(operation, operands if operation == "^" else list(map(found, operands)), found)
            if uses[id(of)] > 1 and isinstance(whole, list):
                definitions.append([f"_{len(definitions) + 1}", whole])
                whole = definitions[-1][0]
            named[id(of)] = whole
        return named[id(of)]

    trees = [found(whole) for whole in wholes]
    return definitions, trees


def _count(of: Ratio | int, uses: "Counter[int]") -> None:
    """The number of occurrences of each part; parts of a repeated part are counted once."""
    if isinstance(of, Ratio) and not isinstance(of.made, str | int):
        uses[id(of)] += 1
        if uses[id(of)] == 1 and of.made:
            for part in of.made[1:]:
                _count(part, uses)


def lowest_terms(of: Ratio) -> Tree:
    """The tree of a rational function as a quotient of factored polynomials."""
    names = of.denominator.context().names()
    parts = _operands("*", factored(of.numerator.to_dict(), names))
    _, factors = of.denominator.factor()  # it is monic
    parts += [["^", nested(factor.to_dict(), names), -int(power)] for factor, power in sorted(factors, key=str)]
    kept = [part for part in parts if part != 1] or [1]
    return _list("*", kept)


def _simple(operation: str, parts: list[Any], found: Callable[[Ratio | int], Tree]) -> Tree:
    """A sum, a product or a power of trees, without neutral elements."""
    if operation == "^":
        base, power = found(parts[0]), parts[1]
        return base if power == 1 or base in (0, 1) else ["^", base, power]
    if operation == "*" and 0 in parts:
        return 0
    kept = [x for x in parts if x != (0 if operation == "+" else 1)]
    flat = [y for x in kept for y in _operands(operation, x)]
    return _list(operation, flat) if flat else (0 if operation == "+" else 1)


def factored(polynomial: Terms, names: Sequence[str]) -> Tree:
    """The tree of a polynomial {exponents: coefficient}, factored and nested, which is short for many terms."""
    context = fmpq_mpoly_ctx.get(tuple(names), Ordering.degrevlex)
    if not (coefficients := {m: fmpq(int(c.numerator), int(c.denominator)) for m, c in polynomial.items()}):
        return 0
    constant, factors = context.from_dict(coefficients).factor()
    parts: list[Tree] = [] if constant == 1 else [number(constant)]
    for factor, power in sorted(factors, key=str):
        parts.append(_power(nested(factor.to_dict(), names), int(power)))
    return _list("*", parts) if parts else 1


def nested(terms: Terms, names: Sequence[str]) -> Tree:
    """A sum of terms in Horner's form, by the variable that most of them contain."""
    if not terms:
        return 0
    counts = [sum(m[i] > 0 for m in terms) for i in range(len(names))]
    most = max(range(len(names)), key=counts.__getitem__)
    if counts[most] < 2:
        return _list("+", [_term(m, c, names) for m, c in sorted(terms.items())])
    least = min(m[most] for m in terms if m[most])
    divided = {(*m[:most], m[most] - least, *m[most + 1 :]): c for m, c in terms.items() if m[most]}
    rest = {m: c for m, c in terms.items() if not m[most]}
    product = ["*", _power(names[most], int(least)), *_operands("*", nested(divided, names))]
    return ["+", product, *_operands("+", nested(rest, names))] if rest else product


def _term(monomial: Monomial, coefficient: int | fmpq, names: Sequence[str]) -> Tree:
    factors = [_power(name, int(e)) for name, e in zip(names, monomial, strict=True) if e]
    return _list("*", [number(coefficient), *factors] if coefficient != 1 or not factors else factors)


def _power(base: Tree, exponent: int) -> Tree:
    return base if exponent == 1 else ["^", base, exponent]


def _list(operation: str, parts: list[Tree]) -> Tree:
    return parts[0] if len(parts) == 1 else [operation, *parts]


def _operands(operation: str, of: Tree) -> list[Tree]:
    return of[1:] if isinstance(of, list) and of[0] == operation else [of]
