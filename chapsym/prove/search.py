"""Random rational points where a statement fails: its counterexamples."""

from functools import partial
from random import Random

import sympy as sp
from sympy.core.relational import Relational

from chapsym.derive.quotient import Quotient, in_sympy

from .points import Exact, drawn, first, small
from .statements import Comparison, Equation, Point, Values, rational_point


def counterexample(statement: Equation, *assumed: Relational, seed: int = 0, tries: int = 300) -> Point:
    """A rational point at which the relations of the ring of a statement hold and the statement fails.

    Parameters
    ----------
    statement : Equation
        An equation in a quotient ring.
    *assumed : sympy relational
        Further relations that must hold at the point.
    seed : int, optional
        The seed of the random numbers: the same seed finds the same point.
    tries : int, optional
        The number of trial points.

    Returns
    -------
    Point
        For `Proof.counterexample`; it has the relations of the ring as hypotheses.

    Raises
    ------
    ArithmeticError
        If no point is found, which does not prove that none exists.

    Examples
    --------
    >>> import sympy as sp
    >>> from chapsym.derive import Quotient, in_sympy
    >>> from chapsym.prove import counterexample, equations
    >>> x, y = sp.symbols("x y")
    >>> equal = equations(Quotient((x, y), [x**2 + y**2 - 1]))
    >>> counterexample(equal("x + y = 1", x + y, 1), x > 0).values
    {'x': '4/5', 'y': '-3/5'}
    """
    if not isinstance(ring := statement.algebra, Quotient):
        raise TypeError(f"a counterexample is looked for in a quotient ring, which «{statement.text}» is not in")
    if statement.holds():
        raise ArithmeticError(f"«{statement.text}» holds in its ring, so there is no counterexample")
    numbers, seen = Random(seed), 0
    free = Quotient(ring.symbols)
    relations = [Equation(f"{relation} = 0", relation, 0, free) for relation in ring.relations]
    start = first(ring)
    for i in range(tries):
        values = drawn(ring, partial(small, numbers, 1 + i // 20), start)  # small numbers first
        if all(true(one, values) for one in assumed):
            seen += 1
            if _fails(statement, values):
                return rational_point(values, relations)
    if not seen:
        raise ArithmeticError(f"no point was found among {tries} where all that is assumed holds")
    raise ArithmeticError(f"no point where «{statement.text}» fails was found among {seen}")


def true(relation: Relational, values: Values) -> bool:
    """Whether both sides are numbers at a point, and the relation holds there."""
    if relation.has(sp.Float):
        raise ValueError(f"{relation} has a float: write exact numbers, such as sp.Rational(1, 2)")
    try:
        return Comparison("", [relation]).true_at(values)
    except ArithmeticError:  # a side is not defined there
        return False
    except KeyError as missing:
        raise ValueError(f"{relation} has {missing.args[0]}, which is no symbol of the ring") from None


def _fails(statement: Equation, values: Exact) -> bool:
    """Whether both sides have values at a point, and the values differ."""
    try:
        left, right = statement.at(lambda entry: in_sympy(entry).xreplace(values))
    except ArithmeticError:
        return False
    return left != right
