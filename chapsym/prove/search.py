"""Rational points where relations hold, drawn at random; and those where a statement fails, its counterexamples."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from random import Random
from typing import Any

import sympy as sp
from sympy.core.relational import Relational

from chapsym.derive.quotient import Quotient

from .points import Exact, candidates
from .statements import Equation, Point, rational_point
from .witness import Examples

Draw = Callable[[], sp.Rational]
#: Directions that may be tried on one relation.
MOST_LINES = 20


def counterexample(statement: Equation, *assumed: Relational, seed: int = 0, tries: int = 300) -> Point:
    """A rational point where the relations of a statement's ring hold and the statement fails.

    Parameters
    ----------
    statement : Equation
        In a quotient ring.
    *assumed : sympy relational
        What must hold at the point, too.
    seed : int
        Of the random numbers: the same seed finds the same point.
    tries : int
        How many points are looked at.

    Returns
    -------
    Point
        For `Proof.counterexample`; it has the relations of the ring as hypotheses.

    Raises
    ------
    ArithmeticError
        If none is found: this does not say that there is none.

    Examples
    --------
    >>> import sympy as sp
    >>> from chapsym.derive import Quotient
    >>> from chapsym.prove import counterexample, equations
    >>> x, y = sp.symbols("x y")
    >>> equal = equations(Quotient((x, y), [x**2 + y**2 - 1]))
    >>> counterexample(equal("x + y = 1", x + y, 1), x > 0).values
    {'x': '4/5', 'y': '-3/5'}
    """
    ring = statement.algebra
    if not isinstance(ring, Quotient):
        raise TypeError(f"a counterexample is looked for in a quotient ring, which «{statement.text}» is not in")
    numbers = Random(seed)
    free = Quotient(ring.symbols)
    relations = [Equation(f"{relation} = 0", relation, 0, free) for relation in ring.relations]
    for i in range(tries):
        most = 1 + i // 20  # small numbers first
        values = point(ring, partial(_drawn, numbers, most))
        if all(_true(one, values) for one in assumed) and _fails(statement, values):
            return rational_point(values, relations)
    raise ArithmeticError(f"no point where «{statement.text}» fails was found among {tries}")


def point(ring: Quotient, draw: Draw, examples: Examples | None = None) -> Exact:
    """A point where all relations hold, of numbers that are drawn; raises ArithmeticError where none is known.

    From a point that is found, one relation after the other: by the line through it in a direction that is drawn, which
    meets a quadric again at a rational point; or solved for a variable in which it is linear.
    """
    start = next(candidates(ring.symbols, ring.relations, examples or Examples()), None)
    if start is None:
        raise ArithmeticError(f"no rational point is known where {', '.join(f'{r} = 0' for r in ring.relations)}")
    related = set().union(*(relation.free_symbols for relation in ring.relations))
    found = {x: start[x] if x in related else draw() for x in ring.symbols}
    settled: set[sp.Symbol] = set()
    for relation in ring.relations:
        own = [x for x in ring.symbols if x in relation.free_symbols - settled]
        moved = _moved(relation, own, found, draw)
        found, settled = found | (moved or {}), settled | relation.free_symbols
    return found if all(relation.xreplace(found) == 0 for relation in ring.relations) else start


def _moved(relation: sp.Expr, own: Sequence[sp.Symbol], values: Exact, draw: Draw) -> Exact | None:
    """Values of its own symbols, those of no relation before, at which a relation holds; None if none are found."""
    left = relation.xreplace({x: v for x, v in values.items() if x not in own})
    for x in own:
        if sp.degree(left, x) == 1:
            chosen = {y: draw() for y in own if y != x}
            one = sp.Poly(left.xreplace(chosen), x)
            if one.degree() == 1:
                return chosen | {x: -one.nth(0) / one.nth(1)}
    t = sp.Dummy()
    for _ in range(MOST_LINES):
        along = {x: values[x] + t * draw() for x in own}
        one = sp.Poly(left.xreplace(along), t)
        if one.nth(0) == 0 and one.degree() == 2:
            return {x: sp.expand(v).subs(t, -one.nth(1) / one.nth(2)) for x, v in along.items()}
    return None


def _drawn(numbers: Random, most: int) -> sp.Rational:
    return sp.Rational(numbers.randint(-most - 1, most + 1), numbers.randint(1, most))


def _true(relation: Relational, values: Mapping[sp.Symbol, Any]) -> bool:
    return bool(relation.xreplace(dict(values)) == True)  # noqa: E712 - SymPy's true is not Python's


def _fails(statement: Equation, values: Exact) -> bool:
    """Whether both sides have values at a point, and these differ."""
    try:
        left, right = statement.at(lambda entry: sp.sympify(entry, strict=True).xreplace(values))
    except ArithmeticError:
        return False
    return left != right
