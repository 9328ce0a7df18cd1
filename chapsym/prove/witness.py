"""Exact witnesses: points at which the hypotheses of a statement hold, and the value of the statement there.

A proved statement is evaluated at an exact point: this shows that its hypotheses can hold, and checks the decision by
independent arithmetic.  The point is the example of its algebra, or one in `examples.py` of its register, or found by
search (`points`): no letter has a meaning here.  The examples of a register may have degenerate cases, which are
evaluated, too.
"""

import random
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product
from typing import TypeAlias

import sympy as sp
from sympy.matrices.exceptions import ShapeError

from chapsym.derive.quotient import Quotient
from chapsym.derive.words import Traces, WordAlgebra, evaluate

from .statements import Comparison, Equation, Value, Values
from .trees import Data

Exact: TypeAlias = dict[sp.Symbol, Value]


@dataclass(frozen=True)
class Examples:
    """Values of the symbols of a register.

    Parameters
    ----------
    numbers : mapping, optional
        {symbol: rational number}.
    matrices : mapping, optional
        {letter: matrix}.
    cases : mapping, optional
        {name of a degenerate case: its changed values}.
    others : mapping, optional
        {symbol: rational number}, alternative values for relations that the others do not satisfy.

    Examples
    --------
    >>> import sympy as sp
    >>> from chapsym.prove import Examples
    >>> x, y = sp.symbols("x y")
    >>> Examples({x: sp.Rational(3, 5), y: sp.Rational(4, 5)}).of([x])
    {x: 3/5}
    """

    numbers: Mapping[sp.Symbol, sp.Rational] = field(default_factory=dict)
    matrices: Mapping[sp.Symbol, sp.Matrix] = field(default_factory=dict)
    cases: Mapping[str, Exact] = field(default_factory=dict)
    #: Alternative values for relations that the others do not satisfy.
    others: Mapping[sp.Symbol, sp.Rational] = field(default_factory=dict)

    def of(self, symbols: Collection[sp.Symbol]) -> Exact:
        """The values of some symbols; KeyError for a symbol without a value."""
        return {x: self.numbers[x] if x.is_commutative else self.matrices[x] for x in symbols}


GENERIC = "generic"
#: The witnesses that are found, and the statements that fail there.
Looked = tuple[list[Data], list[str]]


def look(equations: Sequence[Equation], assumed: Sequence[Comparison], examples: Examples) -> Looked:
    """Evaluates the equations in every case; returns the witnesses found and the statements that fail there.

    A statement is skipped in cases with a zero denominator or a violated hypothesis.
    """
    found: dict[str, Data] = {}
    wrong = []
    for equation in equations:
        for case in (GENERIC, *examples.cases):
            point = _point(equation, case, examples)
            if point is None or not allowed(point, assumed) or (truth := true_at(equation, point)) is None:
                continue
            if not truth:
                wrong.append(f"{equation.text} ({case})")
            seen = found.setdefault(case, {"name": case, "point": {}, "statements": 0})
            seen["point"] |= shown(equation, point)
            seen["statements"] += 1
    return list(found.values()), wrong


def allowed(point: Values, assumed: Sequence[Comparison]) -> bool:
    """Whether all hypotheses hold whose symbols have values."""
    return all(h.true_at(point) for h in assumed if h.symbols <= point.keys())


def _point(equation: Equation, case: str, examples: Examples) -> Exact | None:
    """The values of the symbols of the algebra of an equation in a case; None if the case does not apply."""
    if isinstance(algebra := equation.algebra, Quotient):
        return _rational(algebra.symbols, algebra.relations, case, examples)
    if isinstance(algebra, Traces):
        algebra = algebra.algebra
    if isinstance(algebra, WordAlgebra):
        symbols = {x for side in (*equation.left, *equation.right) for x in side.free_symbols}
        return matrices(symbols, algebra, examples, case)
    return None


def _rational(
    symbols: Sequence[sp.Symbol], relations: Sequence[sp.Expr], case: str, examples: Examples
) -> Exact | None:
    changed = examples.cases.get(case, {})
    if not set(symbols) <= examples.numbers.keys() or (changed and changed.keys().isdisjoint(symbols)):
        return None
    point = {symbol: changed.get(symbol, examples.numbers[symbol]) for symbol in symbols}
    return point if all(relation.xreplace(point) == 0 for relation in relations) else None


def matrices(symbols: set[sp.Symbol], algebra: WordAlgebra, examples: Examples, case: str = GENERIC) -> Exact | None:
    """Matrices for the letters and numbers for the parameters that satisfy the rules and transposes."""
    changed = examples.cases.get(case, {})
    symbols = symbols | set(algebra.transposes) | {x for pair in algebra.rules for x in pair}
    known: Exact = {**examples.numbers, **examples.matrices, **algebra.example, **changed}
    if case != GENERIC and changed.keys().isdisjoint(symbols):
        return None
    if symbols <= known.keys() and _sound(point := {x: known[x] for x in symbols}, algebra):
        return point
    return None if case != GENERIC else next(searched(symbols, algebra), None)


def searched(symbols: set[sp.Symbol], algebra: WordAlgebra) -> Iterator[Exact]:
    """Points for an algebra whose symbols have no values, from its transposes and rules.

    A letter is an orthogonal, symmetric, skew or general matrix, or a product by a rule; if this is not enough, the
    letters of the failing rules are 1, 0 or a projection.
    """
    given = algebra.example
    rows = {x.rows for x in given.values() if isinstance(x, sp.MatrixBase)}
    letters = sorted((x for x in symbols if not x.is_commutative), key=str)
    numbers = {x: sp.Integer(i + 2) for i, x in enumerate(sorted(symbols - set(letters), key=str))}
    for n in sorted(rows, reverse=True) or (3, 2, 1):
        if _sound(point := numbers | dict(given) | _by_kind(letters, algebra, n), algebra):
            yield point
            continue
        failing = sorted({x for pair in algebra.rules for x in pair if x not in given}, key=str)
        one = sp.eye(n)
        for values in product((one, sp.zeros(n, n), sp.diag(1, *[0] * (n - 1))), repeat=min(len(failing), 4)):
            if _sound(tried := point | closed(dict(zip(failing, values, strict=False)), algebra), algebra):
                yield tried


def _by_kind(letters: Sequence[sp.Symbol], algebra: WordAlgebra, n: int) -> Exact:
    """Seeded random n × n matrices for letters without an example: by their transposes, then by the rules."""
    seed, found = random.Random(n), dict(algebra.example)
    for x in letters:
        if x in found:
            continue
        image = algebra.transposes.get(x)
        a = sp.Matrix(n, n, lambda i, j: seed.randint(-3, 3) + 2 * int(i == j))
        if image == x:
            found[x] = a + a.T
        elif image == -x:
            found[x] = a - a.T
        elif image is not None and 1 in (algebra.rules.get((x, image)), algebra.rules.get((image, x))):
            skew = a - a.T
            found[x] = (sp.eye(n) - skew / 4).inv() * (sp.eye(n) + skew / 4)
        else:
            found[x] = a
        found = closed(found, algebra)
    return found


def closed(found: Exact, algebra: WordAlgebra) -> Exact:
    """The matrices with their transposes, and the letters that are products of two by a rule."""
    for x in list(found):
        image = algebra.transposes.get(x)
        if image is not None and image.is_Symbol and image != x:
            found[image] = found[x].T
    for (a, b), image in algebra.rules.items():
        if a in found and b in found and image.is_Symbol and not image.is_commutative:
            found[image] = found[a] * found[b]
    return found


def _sound(point: Exact, algebra: WordAlgebra) -> bool:
    """Whether matrices satisfy the rules and the transposes."""
    try:
        return all(_same(evaluate(image, point), point[x].T) for x, image in algebra.transposes.items()) and all(
            _same(point[a] * point[b], v if v.is_number else evaluate(v, point)) for (a, b), v in algebra.rules.items()
        )
    except ShapeError:
        return False


def true_at(equation: Equation, point: Exact) -> bool | None:
    """Whether both sides agree at a point; None if a denominator vanishes."""
    if isinstance(equation.algebra, Quotient):
        left, right = ([e.xreplace(point) for e in side] for side in (equation.left, equation.right))
        if any(value.has(sp.nan, sp.zoo, sp.oo) for value in (*left, *right)):
            return None
        return all(a == b for a, b in zip(left, right, strict=True))
    if isinstance(equation.algebra, Traces):
        left, right = equation.at(lambda e: evaluate(e, point))
        return left == right
    pairs = zip(equation.left, equation.right, strict=True)
    return all(_same(evaluate(a, point), evaluate(b, point)) for a, b in pairs)


def _same(a: Value, b: Value) -> bool:
    """Equality of matrices; a number is its multiple of the identity (0 for any zero matrix)."""
    if isinstance(a, sp.MatrixBase) and isinstance(b, sp.MatrixBase):
        vanish = 1 in a.shape and 1 in b.shape and a.is_zero_matrix and b.is_zero_matrix
        return bool(a.shape == b.shape and a == b) or vanish
    if isinstance(b, sp.MatrixBase):
        a, b = b, a
    if isinstance(a, sp.MatrixBase):
        return bool(a.is_zero_matrix if b == 0 else a.is_square and a == b * sp.eye(a.rows))
    return bool(a == b)


def shown(equation: Equation, point: Exact) -> dict[str, str]:
    """The values of the symbols that occur in the equation, by name."""
    used = set().union(*(e.free_symbols for e in (*equation.left, *equation.right)))
    values = {str(symbol): value for symbol, value in point.items() if symbol in used}
    plain = {x: value.tolist() if isinstance(value, sp.MatrixBase) else value for x, value in values.items()}
    return {name: str(value) for name, value in sorted(plain.items())}
