"""Rational points at which relations hold: a statement that is proved from them is not empty."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any

import sympy as sp

from chapsym.derive.quotient import Quotient

from . import witness
from .statements import Comparison, Equation
from .witness import Examples

Exact = dict[sp.Symbol, sp.Rational]


#: The sides of a right triangle, and the components of a unit vector: for relations of symbols in no table.
SIDES, UNIT = ("3/5",), ("2/7", "3/7", "6/7")


def candidates(
    symbols: Sequence[sp.Symbol],
    relations: Sequence[sp.Expr],
    examples: Examples,
    known: Mapping[sp.Symbol, Any] | None = None,
) -> Iterator[Exact]:
    """Points with the known values at which all relations hold, if some are found: from examples, primes, or 1.

    And from triangles and unit vectors with rational sides.
    """
    known = dict(known or {})
    primes = {symbol: sp.Integer(sp.prime(i)) for i, symbol in enumerate(symbols, 1)}
    table = {symbol: examples.numbers.get(symbol, prime) for symbol, prime in primes.items()}
    others = {symbol: examples.others[symbol] for symbol in symbols if symbol in examples.others}
    related = [symbol for symbol in symbols if any(relation.has(symbol) for relation in relations)]
    round_ = [primes | {x: sp.Rational(of[i % len(of)]) for i, x in enumerate(related)} for of in (SIDES, UNIT)]
    for start in (table, table | others, primes, dict.fromkeys(symbols, sp.S.One), *round_):
        if (point := _moved(start | known, relations, known.keys())) is not None:
            yield point


def look(
    equations: Sequence[Equation], assumed: Sequence[Comparison], examples: Examples
) -> tuple[list[dict[str, Any]], list[str]]:
    """As `witness.look`, at points that are found for the relations of each equation, where the examples have none."""
    found: dict[tuple[Any, ...], dict[str, Any]] = {}
    wrong = []
    for equation in equations:
        ring = equation.algebra
        for point in candidates(ring.symbols, ring.relations, examples) if isinstance(ring, Quotient) else ():
            if witness.allowed(point, assumed) and (truth := witness.true_at(equation, point)) is not None:
                seen = found.setdefault(tuple(point.items()), {"name": "found", "point": {}, "statements": 0})
                seen["point"] |= witness.shown(equation, point)
                seen["statements"] += 1
                wrong += [] if truth else [equation.text]
                break
    return list(found.values()), wrong


def _moved(start: Exact, relations: Sequence[sp.Expr], fixed: Collection[sp.Symbol]) -> Exact | None:
    """The point with one coordinate changed for each relation that fails there; None if no rational one is found."""
    point = dict(start)
    for i, relation in enumerate(relations):
        if relation.xreplace(point) == 0:
            continue
        free = sorted(relation.free_symbols - set(fixed), key=str)
        moves = (point | {x: root} for x in free for root in _roots(relation, x, point))
        found = next((move for move in moves if all(r.xreplace(move) == 0 for r in relations[: i + 1])), None)
        if found is None:
            return None
        point = found
    return point


def _roots(relation: sp.Expr, x: sp.Symbol, point: Exact) -> list[sp.Rational]:
    """The rational values of x at which the relation holds."""
    others = {symbol: value for symbol, value in point.items() if symbol != x}
    return sorted(sp.Poly(relation.xreplace(others), x).ground_roots())
