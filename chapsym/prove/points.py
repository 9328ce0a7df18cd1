"""Rational points at which relations hold, which show that a statement proved from them is not vacuous."""

from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from functools import partial
from math import prod
from random import Random

import sympy as sp
from flint import fmpq, fmpq_poly

from chapsym.derive.quotient import Quotient

from . import witness
from .statements import Comparison, Equation, Values
from .trees import Data
from .witness import Examples

Exact = dict[sp.Symbol, sp.Rational]
#: A number for a symbol.
Draw = Callable[[sp.Symbol], Fraction]
#: The number of trial directions for a relation, and of drawn points if hypotheses must hold.
MOST_LINES, MOST_DRAWN = 20, 200

#: The sides of a right triangle, and the components of a unit vector: for relations of symbols in no table.
SIDES, UNIT = ("3/5",), ("2/7", "3/7", "6/7")


def candidates(
    symbols: Sequence[sp.Symbol], relations: Sequence[sp.Expr], examples: Examples, known: Values | None = None
) -> Iterator[Exact]:
    """Points with the known values at which all relations hold, if found: from examples, primes, or 1.

    Also from triangles and unit vectors with rational sides.
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


def allowed(
    symbols: Sequence[sp.Symbol], relations: Sequence[sp.Expr], assumed: Sequence[Comparison], examples: Examples
) -> Iterator[Exact]:
    """Points where the relations and all assumptions hold; equations among the assumptions are relations, too."""
    yield from (x for x in candidates(symbols, relations, examples) if witness.allowed(x, assumed))
    equations = [r for h in assumed for r in h.relations if isinstance(r, sp.Eq) and r.free_symbols <= set(symbols)]
    more = [*relations, *(sp.fraction(sp.together(r.lhs - r.rhs))[0] for r in equations)]
    if assumed:
        yield from (x for x in some(Quotient(symbols, more), examples) if witness.allowed(x, assumed))


def some(ring: Quotient, examples: Examples) -> Iterator[Exact]:
    """Points where the relations of a ring hold: found from examples, then drawn at random."""
    yield from candidates(ring.symbols, ring.relations, examples)
    numbers = Random(0)
    with suppress(ArithmeticError):  # where no point is known
        start = first(ring, examples)
        for i in range(MOST_DRAWN):
            yield drawn(ring, partial(small, numbers, 1 + i // 20), start)


def look(equations: Sequence[Equation], assumed: Sequence[Comparison], examples: Examples) -> witness.Looked:
    """As `witness.look`, at points found for the relations of each equation, if the examples have none."""
    found: dict[tuple[object, ...], Data] = {}
    wrong = []
    for equation in equations:
        ring = equation.algebra
        for point in allowed(ring.symbols, ring.relations, assumed, examples) if isinstance(ring, Quotient) else ():
            if (truth := witness.true_at(equation, point)) is not None:
                seen = found.setdefault(tuple(point.items()), {"name": "found", "point": {}, "statements": 0})
                seen["point"] |= witness.shown(equation, point)
                seen["statements"] += 1
                wrong += [] if truth else [equation.text]
                break
    return list(found.values()), wrong


def _moved(start: Exact, relations: Sequence[sp.Expr], fixed: Collection[sp.Symbol]) -> Exact | None:
    """The point, with one coordinate changed for each failing relation; None if no rational point is found."""
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


def small(numbers: Random, most: int, symbol: sp.Symbol) -> Fraction:
    """A fraction of small numbers, for any symbol."""
    return Fraction(numbers.randint(-most - 1, most + 1), numbers.randint(1, most))


def _number(x: Fraction | fmpq) -> sp.Rational:
    return sp.Rational(int(x.numerator), int(x.denominator))


def _fraction(x: sp.Rational) -> fmpq:
    return fmpq(x.p, x.q)


def first(ring: Quotient, examples: Examples | None = None) -> Exact:
    """A point where all relations hold; raises ArithmeticError if none is known."""
    if (point := next(candidates(ring.symbols, ring.relations, examples or Examples()), None)) is not None:
        return point
    raise ArithmeticError(f"no rational point is known where {', '.join(f'{r} = 0' for r in ring.relations)}")


def drawn(ring: Quotient, draw: Draw, start: Exact) -> Exact:
    """A random point where all relations hold, from a known one.

    Each relation in turn is solved by a line through the point in a random direction, which meets a quadric again at a
    rational point, or for a variable in which the relation is linear.
    """
    related = set().union(*(relation.free_symbols for relation in ring.relations))
    found = {x: start[x] if x in related else _number(draw(x)) for x in ring.symbols}
    settled: set[sp.Symbol] = set()
    for relation in ring.relations:
        own = [x for x in ring.symbols if x in relation.free_symbols - settled]
        moved = _on_line(relation, own, found, draw)
        found, settled = found | (moved or {}), settled | relation.free_symbols
    return found if all(relation.xreplace(found) == 0 for relation in ring.relations) else start


def _on_line(relation: sp.Expr, own: Sequence[sp.Symbol], values: Exact, draw: Draw) -> Exact | None:
    """Values of the symbols that no earlier relation has, at which a relation holds; None if none are found."""
    if not own:
        return None
    left = relation.xreplace({x: v for x, v in values.items() if x not in own})
    whole = sp.Poly(left, *own)
    for x in own:
        if whole.degree(x) == 1:
            chosen = {y: _number(draw(y)) for y in own if y != x}
            if (one := sp.Poly(left.xreplace(chosen), x)).degree() == 1:
                return chosen | {x: -one.nth(0) / one.nth(1)}
    terms = [(powers, _fraction(c)) for powers, c in whole.terms()]
    for _ in range(MOST_LINES):
        directions = {x: _number(draw(x)) for x in own}
        line = [fmpq_poly([_fraction(values[x]), _fraction(directions[x])]) for x in own]
        one = sum((prod(map(pow, line, powers), start=c * fmpq_poly([1])) for powers, c in terms), fmpq_poly())
        if one[0] == 0 and one.degree() == 2:
            t = _number(-one[1] / one[2])
            return {x: values[x] + t * directions[x] for x in own}
    return None
