"""Statements that exact arithmetic decides, and exact points at which they are evaluated."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol, TypeAlias, TypeGuard

import sympy as sp
from flint import fmpq
from sympy.core.relational import Relational

from chapsym.derive import words
from chapsym.derive.quotient import Quotient

from .argument import Grounds
from .elimination import Elimination, Form, eliminate
from .polynomials import Identity

#: Exact values of symbols: rational numbers, and matrices of them.
Value: TypeAlias = sp.Rational | sp.MatrixBase
Values: TypeAlias = Mapping[sp.Symbol, Value]
#: A side of an equation: an expression, a matrix or a list of entries.
Side: TypeAlias = sp.Expr | sp.MatrixBase | Sequence[sp.Expr]


class Algebra(Protocol):
    """The algebra in which an equation is decided: words for every n, or a quotient ring for n = 3."""

    def is_zero(self, expr: sp.Expr) -> bool:
        """Whether the expression is zero, exactly."""


@dataclass(frozen=True)
class Equation:
    """left = right, entry by entry, exactly, in an algebra.

    Parameters
    ----------
    text : str
        The statement in words or signs.
    left, right : sympy.Expr, sympy.Matrix or list
        The sides: an expression, a matrix or a list of entries.
    algebra : Algebra
        The algebra in which it is decided: words for every n, or a quotient ring.

    Attributes
    ----------
    written : tuple of list
        The sides with the letters of the derivation.

    Raises
    ------
    ValueError
        If the sides do not have the same number of entries, or have none.

    Examples
    --------
    >>> import sympy as sp
    >>> from chapsym.derive import Quotient
    >>> from chapsym.prove import Equation
    >>> x, y = sp.symbols("x y")
    >>> circle = Quotient((x, y), [x**2 + y**2 - 1])
    >>> Equation("x² = 1 - y²", x**2, 1 - y**2, circle).holds(), Equation("x² = 1", x**2, 1, circle).holds()
    (True, False)
    """

    text: str
    left: Side
    right: Side
    algebra: Algebra
    written: tuple[list[sp.Expr], list[sp.Expr]] = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "written", (_entries(self.left), _entries(self.right)))
        for name, side in zip(("left", "right"), self.written, strict=True):
            object.__setattr__(self, name, [words.unfolded(entry) for entry in side])
        if len(self.left) != len(self.right) or not self.left:
            raise ValueError(f"the two sides of «{self.text}» have {len(self.left)} and {len(self.right)} entries")

    @property
    def method(self) -> str:
        """How the statement is decided."""
        return _METHODS.get(type(self.algebra).__name__, type(self.algebra).__name__)

    def holds(self) -> bool:
        """True exactly when every entry of left - right is zero in the algebra."""
        return all(self.algebra.is_zero(a - b) for a, b in zip(self.left, self.right, strict=True))

    def at(self, evaluate: Callable[[sp.Expr], Value]) -> tuple[list[str], list[str]]:
        """Both sides at a point, as exact rationals; raises if a value is not rational."""
        pairs = [_same_shape(evaluate(a), evaluate(b)) for a, b in zip(self.left, self.right, strict=True)]
        if isinstance(self.algebra, words.Traces):
            pairs = [(a.trace(), b.trace()) for a, b in pairs]
        return [_exact(a) for a, _ in pairs], [_exact(b) for _, b in pairs]


def equations(usual: Algebra) -> Callable[..., Equation]:
    """Makes equations in one algebra, unless another is given.

    Parameters
    ----------
    usual : Algebra
        The algebra.

    Returns
    -------
    callable
        `equation(text, left, right, algebra=usual)`, which returns an `Equation`.

    Examples
    --------
    >>> import sympy as sp
    >>> from chapsym.derive import Quotient
    >>> from chapsym.prove import equations
    >>> x, y = sp.symbols("x y")
    >>> equal = equations(Quotient((x, y), [x**2 + y**2 - 1]))
    >>> equal("x² = 1 - y²", x**2, 1 - y**2).holds()
    True
    """

    def equation(text: str, left: Side, right: Side, algebra: Algebra = usual) -> Equation:
        return Equation(text, left, right, algebra)

    return equation


def in_field(text: str, left: Sequence[sp.Expr], right: Sequence[sp.Expr], relation: sp.Expr) -> Equation:
    """left = right at a root of a polynomial in one symbol, which may have no rational root.

    It is decided as an identity for all values of the symbol: left = right + (a multiple of the polynomial).

    Parameters
    ----------
    text : str
        The statement in words or signs.
    left, right : sequence of sympy.Expr
        The entries of the sides, in the symbol.
    relation : sympy.Expr
        The polynomial.

    Returns
    -------
    Equation

    Examples
    --------
    >>> import sympy as sp
    >>> from chapsym.prove import in_field
    >>> x = sp.Symbol("x")
    >>> in_field("(1 + √2)(√2 - 1) = 1", [(1 + x) * (x - 1)], [1], x**2 - 2).holds()
    True
    """
    (x,) = relation.free_symbols
    moved = []
    for a, b in zip(left, right, strict=True):
        above, below = sp.fraction(sp.together(a - b))
        multiple = sp.div(sp.expand(above), relation, x)[0] / below
        moved.append(sp.Add(b, sp.Mul(relation, multiple, evaluate=False), evaluate=False))
    return Equation(text, left, moved, Quotient((x,)))


def _entries(side: Side) -> list[sp.Expr]:
    """A side as the list of its entries."""
    entries = side if isinstance(side, sp.MatrixBase | Iterable) else [side]
    return [sp.Integer(entry) if isinstance(entry, int) else entry for entry in entries]


@dataclass(frozen=True)
class Fact:
    """A decided statement other than an equation: a count, an order, a strict inequality of rational numbers.

    Parameters
    ----------
    text : str
        The statement in words or signs.
    truth : bool
        Whether it is true.
    method : str, optional
        How it was decided.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from chapsym.prove import Fact
    >>> Fact("1/3 < 2/5", Fraction(1, 3) < Fraction(2, 5)).holds()
    True
    """

    text: str
    truth: bool
    method: str = "exact arithmetic"

    def holds(self) -> bool:
        """Whether the statement holds; an undecided relation raises TypeError."""
        return bool(self.truth)


@dataclass(frozen=True)
class Rest:
    """The statement that another certificate is accepted, named by its digest; for a claim, by id and digest."""

    text: str
    certificate: str
    truth: bool
    method: str
    #: The grounds of the claim, for a claim.
    grounds: Grounds | None = None

    @property
    def name(self) -> str:
        """The id of the claim."""
        return self.certificate.split()[0]

    def holds(self) -> bool:
        """Whether it is accepted."""
        return self.truth


@dataclass(frozen=True)
class Zero:
    """The statement that equations have exactly one solution within `radius`, and that `nonzero` is not 0 there.

    Parameters
    ----------
    text : str
        The statement in words or signs.
    unknowns : sequence of sympy.Symbol
        The unknowns.
    definitions : sequence of (sympy.Symbol, sympy.Expr)
        Names for expressions, defined in order.
    equations : sequence of sympy.Expr
        Expressions that vanish, in the unknowns, the other symbols of the point and the names.
    nonzero : sequence of sympy.Expr
        Expressions that are not 0.
    point : mapping
        {symbol: rational number}: the centre for the unknowns, and the values of the other symbols.
    radius : sympy.Rational
        The largest distance of the solution from the point, in each unknown.
    truth : bool
        The decision.
    method : str
        How it was decided.
    """

    text: str
    unknowns: Sequence[sp.Symbol]
    definitions: Sequence[tuple[sp.Symbol, sp.Expr]]
    equations: Sequence[sp.Expr]
    nonzero: Sequence[sp.Expr]
    point: Mapping[sp.Symbol, sp.Rational]
    radius: sp.Rational
    truth: bool
    method: str

    def holds(self) -> bool:
        """The decision."""
        return self.truth


@dataclass(frozen=True)
class Comparison:
    """Relations <, ≤, = and ≠ at an exact point, in SymPy: `x < y`, `sp.Eq(x, y)`, `sp.Ne(x, y)`.

    A hypothesis has no point: it must hold wherever a claim is evaluated.

    Parameters
    ----------
    text : str
        The statement in words or signs.
    relations : sequence of sympy relational
        Relations with symbols.
    point : mapping, optional
        {symbol: rational number or matrix}.
    method : str, optional
        How it is decided.

    Raises
    ------
    TypeError
        If SymPy has decided one of the relations already.

    Examples
    --------
    >>> import sympy as sp
    >>> from chapsym.prove import Comparison
    >>> x, y = sp.symbols("x y")
    >>> Comparison("x < y < 1", [x < y, y < 1], {x: "1/3", y: "2/5"}).holds()
    True
    """

    text: str
    relations: Sequence[Relational]
    point: Values = field(default_factory=dict)
    method: str = "rational numbers at a point"

    def __post_init__(self) -> None:
        if decided := [r for r in self.relations if not isinstance(r, Relational)]:
            raise TypeError(f"a relation of «{self.text}» is {decided[0]} already; write it with symbols, and a point")
        exact = {x: v if isinstance(v, sp.MatrixBase) else sp.Rational(v) for x, v in self.point.items()}
        object.__setattr__(self, "point", exact)

    @property
    def symbols(self) -> set[sp.Symbol]:
        """The symbols that must have a value."""
        return set().union(*(relation.free_symbols for relation in self.relations))

    def holds(self) -> bool:
        """Whether all relations hold at its point."""
        return self.true_at(self.point)

    def sides(self) -> tuple[list[str], list[str]]:
        """The sides of the relations, at its point."""
        values = [_values(relation, self.point) for relation in self.relations]
        return [_exact(left) for left, _ in values], [_exact(right) for _, right in values]

    def true_at(self, exact: Values) -> bool:
        """Whether all relations hold at a point; raises if a side is not rational there."""
        return all(_compared(relation, exact) for relation in self.relations)


def _values(relation: Relational, exact: Values) -> tuple[Value, Value]:
    """Both sides at a point."""
    used = {symbol: exact[symbol] for symbol in relation.free_symbols}
    left, right = (_evaluated(side, used) for side in (relation.lhs, relation.rhs))
    return left, right


def _compared(relation: Relational, exact: Values) -> bool:
    left, right = _same_shape(*_values(relation, exact))
    texts = _exact(left), _exact(right)  # of rational numbers
    if relation.rel_op in ("==", "!="):
        return (texts[0] == texts[1]) == (relation.rel_op == "==")
    return bool(relation.func(left, right))


#: The numbers of different solutions, and of solutions counted with multiplicity.
REAL, COMPLEX, REAL_MULTIPLE, COMPLEX_MULTIPLE = NUMBERS = sp.symbols(
    "real complex real_with_multiplicity complex_with_multiplicity"
)


@dataclass(frozen=True)
class Count:
    """A count: the number of solutions, in projective space, of equations that are homogeneous in some unknowns.

    Deciding raises NotCounted if there are infinitely many solutions or none, including complex ones, or if a multiple
    solution has no unique tangent line.

    Parameters
    ----------
    text : str
        The statement in words or signs.
    equations : sequence of sympy.Expr
        Expressions that vanish, possibly with letters of a derivation.
    unknowns : sequence of sympy.Symbol
        The unknowns, in which the equations are homogeneous.
    point : mapping
        {symbol: rational number} for all other symbols, those of the algebra among them.
    relations : sequence of sympy relational
        Between REAL, COMPLEX, REAL_MULTIPLE, COMPLEX_MULTIPLE and integers.
    algebra : Quotient
        The ring of the other symbols.
    nonzero : sequence of sympy.Expr, optional
        Homogeneous expressions that vanish at no solution.
    method : str, optional
        How it is decided.

    Examples
    --------
    >>> import sympy as sp
    >>> from chapsym.derive import Quotient
    >>> from chapsym.prove import REAL, Count
    >>> x, y, z = sp.symbols("x y z")
    >>> conic, line = x**2 + y**2 - 2 * z**2, x - y
    >>> Count("they meet twice", [conic, line], [x, y, z], {}, [sp.Eq(REAL, 2)], Quotient(())).holds()
    True
    """

    text: str
    equations: Sequence[sp.Expr]
    unknowns: Sequence[sp.Symbol]
    point: Values
    relations: Sequence[Relational]
    algebra: Quotient
    nonzero: Sequence[sp.Expr] = ()
    method: str = "elimination over Q, and Sturm's theorem"

    def __post_init__(self) -> None:
        object.__setattr__(self, "point", {symbol: sp.Rational(x) for symbol, x in self.point.items()})

    def holds(self) -> bool:
        """Whether the relations hold, and `nonzero` does not vanish."""
        if not all(map(self.elimination().vanishes_at_none, self._forms(self.nonzero))):
            return False
        return Comparison(self.text, self.relations).true_at(self.numbers())

    def sides(self) -> tuple[list[str], list[str]]:
        """The sides of the relations."""
        return Comparison(self.text, self.relations, self.numbers()).sides()

    def numbers(self) -> dict[sp.Symbol, sp.Integer]:
        """The numbers of solutions."""
        found = self.elimination().eliminant
        eliminant = sp.Poly([sp.Rational(int(c.p), int(c.q)) for c in found][::-1], sp.Symbol("t"))
        parts = [(part.count_roots(), part.degree(), power) for part, power in eliminant.sqf_list()[1]]
        counts = [(real, degree, real * power, degree * power) for real, degree, power in parts]
        return {name: sp.Integer(sum(n)) for name, n in zip(NUMBERS, zip((0,) * 4, *counts, strict=True), strict=True)}

    def elimination(self) -> Elimination:
        """The elimination that proves the numbers."""
        return eliminate(tuple(tuple(form.items()) for form in self._forms(self.equations)), len(self.unknowns))

    def _forms(self, expressions: Sequence[sp.Expr]) -> list[Form]:
        """Expressions at the point, by their terms in the unknowns."""
        forms = [sp.Poly(words.unfolded(e).xreplace(self.point), *self.unknowns, domain="QQ") for e in expressions]
        return [{m: fmpq(int(c.p), int(c.q)) for m, c in form.terms()} for form in forms]


Statement = Equation | Fact | Identity | Comparison | Count | Rest | Zero


def contradicts(statement: Statement) -> TypeGuard[Comparison | Count]:
    """Whether a false statement is its own counterexample: unless it states that something is not 0."""
    return isinstance(statement, Comparison) or (isinstance(statement, Count) and not statement.nonzero)


def _evaluated(expr: sp.Expr, exact: Values) -> Value:
    """An expression at rational values of its symbols; words at matrices."""
    if any(isinstance(value, sp.MatrixBase) for value in exact.values()):
        return words.evaluate(expr, exact)
    return expr.xreplace(dict(exact))


@dataclass(frozen=True)
class Point:
    """An exact rational point.

    Parameters
    ----------
    values : dict of str to str
        The values as text.
    exact : mapping
        {symbol: rational number or matrix}.
    hypotheses : sequence of Equation, optional
        What must hold there.

    Examples
    --------
    >>> import sympy as sp
    >>> from chapsym.prove import Point
    >>> x = sp.Symbol("x")
    >>> Point({"x": "3/5"}, {x: sp.Rational(3, 5)}).evaluate(x + 1)
    8/5
    """

    values: dict[str, str]
    exact: Values
    hypotheses: Sequence[Equation] = ()

    def evaluate(self, expr: sp.Expr) -> Value:
        """An expression at the point; words at its matrices."""
        return _evaluated(expr, self.exact)

    def failures(self) -> list[str]:
        """The hypotheses that fail at the point."""
        return [h.text for h in self.hypotheses if len(set(map(tuple, h.at(self.evaluate)))) != 1]


def rational_point(values: dict[sp.Symbol, str | sp.Rational], hypotheses: Sequence[Equation] = ()) -> Point:
    """A point given by rational numbers for commuting symbols.

    Parameters
    ----------
    values : dict
        {symbol: number}, with numbers that `sympy.Rational` accepts, such as "3/5".
    hypotheses : sequence of Equation, optional
        What must hold there.

    Returns
    -------
    Point

    Examples
    --------
    >>> import sympy as sp
    >>> from chapsym.prove import rational_point
    >>> x, y = sp.symbols("x y")
    >>> point = rational_point({x: "3/5", y: "4/5"})
    >>> point.values, point.evaluate(x + y)
    ({'x': '3/5', 'y': '4/5'}, 7/5)
    """
    exact = {symbol: sp.Rational(value) for symbol, value in values.items()}
    return Point({str(k): str(v) for k, v in exact.items()}, exact, hypotheses)


def _same_shape(a: Value, b: Value) -> tuple[Value, Value]:
    """Replaces the number 0 by the zero matrix if the other side is a matrix."""
    if isinstance(a, sp.MatrixBase) and b == 0:
        return a, sp.zeros(*a.shape)
    if isinstance(b, sp.MatrixBase) and a == 0:
        return sp.zeros(*b.shape), b
    return a, b


def _exact(value: Value) -> str:
    if isinstance(value, sp.MatrixBase):
        return str([[_exact(x) for x in row] for row in value.tolist()]).replace("'", "")
    if not value.is_Rational:
        raise ArithmeticError(f"{value} is not a rational number")
    return str(value)


_METHODS = {
    "WordAlgebra": "words in noncommuting symbols, every n",
    "Traces": "traces of words in noncommuting symbols, every n",
    "Quotient": "quotient ring over Q, Gröbner division",
}
