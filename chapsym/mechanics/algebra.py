"""Expressions of a system in a ring: letters for sines, cosines and roots, with their relations and derivatives."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cached_property, partial
from itertools import combinations, count
from random import Random

import sympy as sp
from sympy.matrices import dotprodsimp
from sympy.polys.matrices import DomainMatrix

from chapsym.codegen.kernels import adjoined
from chapsym.derive.quotient import Quotient, in_sympy
from chapsym.prove import Examples
from chapsym.prove.points import drawn, first, small, some

from .system import BadSystem, System, rational, without

#: Digits of the numbers of a system, as all floats have them; of more than `FACTORED` factors would take minutes.
MOST_DIGITS, FACTORED = 330, 100
MOST_POINTS = 24
#: Points at which roots may be rational: of quotients of the legs of right triangles.
MOST_LOOKED, LEGS = 200, tuple(Fraction(p, q) for p, q in ((3, 4), (4, 3), (5, 12), (12, 5), (8, 15), (15, 8), (7, 24)))

#: Exact values of symbols, and rows of expressions.
Point = dict[sp.Symbol, sp.Expr]
Vectors = Sequence[Sequence[sp.Expr]]


class Letters:
    """Letters for the sines, cosines and square roots of expressions, in the order in which one needs another.

    reserved: names that they must not have; plain: they are named l0, l1, ..., and not after their meanings.
    """

    def __init__(self, reserved: Iterable[sp.Symbol] = (), plain: bool = False) -> None:
        self._taken, self._plain = {x.name for x in reserved}, plain
        self._of: dict[sp.Expr, sp.Symbol] = {}
        self._read: dict[sp.Expr, sp.Expr] = {}

    @property
    def meanings(self) -> dict[sp.Symbol, sp.Expr]:
        """The meaning of each letter, in letters before it."""
        return {letter: stands for stands, letter in self._of.items()}

    def into(self, expr: sp.Expr) -> sp.Expr:
        """An expression with its functions replaced by letters; raises BadSystem for others than these."""
        expr = in_sympy(expr)
        if expr not in self._read:
            self._read[expr] = self._made(expr)
        return self._read[expr]

    def _made(self, expr: sp.Expr) -> sp.Expr:
        if expr.is_Symbol or expr.is_Rational:
            return expr
        if expr is sp.pi:
            return self._letter(sp.pi)
        if isinstance(expr, sp.tan):
            return self.into(sp.sin(expr.args[0]) / sp.cos(expr.args[0]))
        if isinstance(expr, sp.sin | sp.cos):
            (of,) = map(self.into, expr.args)
            for x in (sp.sin(of), sp.cos(of)):
                self._letter(x)
            return self._letter(expr.func(of))
        if isinstance(expr, sp.Pow) and isinstance(expr.exp, sp.Rational):
            if expr.exp.q > 2:
                raise BadSystem(f"{expr} is not sin, cos, a square root or a whole power")
            base = self.into(expr.base)
            return base**expr.exp if expr.exp.q == 1 else self._letter(sp.sqrt(base)) ** expr.exp.p
        if not isinstance(expr, sp.Add | sp.Mul):
            raise BadSystem(f"{expr!s:.60} is not sin, cos, a square root or + - * / of numbers and symbols")
        return expr.func(*map(self.into, expr.args))

    def _letter(self, stands: sp.Expr) -> sp.Expr:
        if (parts := adjoined(stands)) is None:
            if stands.is_Atom:
                return stands
            return -self._letter(-stands) if adjoined(-stands) else self.into(stands)  # sin(-x); √4 x² is 2 √x²
        if stands not in self._of:
            function, of = parts
            base = "l" if self._plain else function + "".join(f"_{x}" for x in sorted(map(str, of.free_symbols)))[:24]
            names = (base if i == 1 and not self._plain else f"{base}{'' if self._plain else '_'}{i}" for i in count(1))
            name = next(n for n in names if n not in self._taken and n not in ("sin", "cos", "sqrt", "pi"))
            self._taken.add(name)
            self._of[stands] = sp.Symbol(name)
        return self._of[stands]

    def derivative(self, expr: sp.Expr, x: sp.Symbol, rate: Callable[..., sp.Expr] | None = None) -> sp.Expr:
        """∂/∂x of an expression in letters, or in names whose derivatives `rate` gives."""
        names, found = expr.free_symbols, sp.S.Zero
        if x in names:
            found = sp.diff(expr, x)
        for name in sorted(names - {x}, key=str):
            if (by := (rate or self.rate)(name, x)) != 0:
                found += sp.diff(expr, name) * by
        return found

    def rate(self, letter: sp.Symbol, x: sp.Symbol) -> sp.Expr:
        """∂/∂x of a letter; 0 of another symbol."""
        function, of = adjoined(self.meanings.get(letter, sp.S.Zero)) or ("", sp.S.Zero)
        inner = self.derivative(of, x)
        if inner == 0:
            return sp.S.Zero
        if function == "sqrt":
            return inner / (2 * letter)
        return self._of[sp.cos(of)] * inner if function == "sin" else -self._of[sp.sin(of)] * inner

    def arguments(self, *functions: str) -> dict[sp.Symbol, sp.Expr]:
        """The letters of some functions, with their arguments."""
        found = {letter: adjoined(stands) or ("", sp.S.Zero) for letter, stands in self.meanings.items()}
        return {letter: of for letter, (function, of) in found.items() if function in functions}

    @property
    def circles(self) -> list[sp.Expr]:
        """sin² + cos² - 1 of each argument."""
        return [s**2 + self._of[sp.cos(of)] ** 2 - 1 for s, of in self.arguments("sin").items()]

    @property
    def roots(self) -> list[sp.Expr]:
        """√x² - x, as polynomials."""
        return [sp.fraction(sp.together(r**2 - of))[0] for r, of in self.arguments("sqrt").items()]


class Algebra:
    """The ring of a system with its numbers: coordinates, velocities and letters.

    Angles are expanded: sin(a + 2 b) is expressed in the letters of a and b.  Expressions with relations beyond those
    of the ring are refused: sines and cosines must have single coordinates, which no holonomic constraint contains
    outside of them; no product of roots may be rational.  more: expressions besides the constraints.  Raises BadSystem.
    """

    def __init__(self, system: System, *more: sp.Expr) -> None:
        self.system = system
        self.letters = Letters((*system.coordinates, *system.velocities))
        self._numbers = {x: rational(v, f"{system.name}: the parameter {x}") for x, v in system.parameters.items()}
        self.holonomic = [sp.fraction(sp.together(self.into(one)))[0] for one in system.holonomic]
        self.rows: sp.Matrix = self.into(system.rows)
        self.offsets: sp.Matrix = self.into(system.offsets)
        self.more = [self.into(one) for one in more]
        known = {*system.coordinates, *system.velocities, *self.letters.meanings}
        without(f"{system.name}: there is", set().union(*(e.free_symbols for e in self.more)) - known)
        self._check()

    def into(self, expr: sp.Expr | sp.MatrixBase) -> sp.Expr | sp.MatrixBase:
        """An expression, or a matrix of them, in letters, with the numbers of the parameters."""
        if isinstance(expr, sp.MatrixBase):
            return expr.applyfunc(self.into)
        try:
            of = in_sympy(expr).xreplace(self._numbers)
            floats = {x: rational(float(x), "a number") for x in of.atoms(sp.Float)}  # as they are written
            found = self.letters.into(sp.expand_trig(of.xreplace(floats)))
        except (TypeError, AttributeError, ZeroDivisionError):
            raise BadSystem(f"{self.system.name}: {expr!s:.60} is no expression") from None
        if found.has(sp.zoo, sp.nan, sp.oo):
            raise BadSystem(f"{self.system.name}: {expr!s:.60} divides by 0")
        if has_longer(found, MOST_DIGITS):
            raise BadSystem(f"{self.system.name}: exact verdicts are for numbers of {MOST_DIGITS} digits at most")
        return found

    def _check(self) -> None:
        name, angles = self.system.name, self.letters.arguments("sin")
        for of in angles.values():
            if of not in self.system.coordinates:
                clause = f"sin and cos of coordinates, which {of} is not: make it one"
                raise BadSystem(f"{name}: exact verdicts need {clause}")
        if self.letters.arguments("pi"):
            raise BadSystem(f"{name}: exact verdicts are not for π: take a rational number, or turn the angles")
        held = set().union(*(e.free_symbols for e in self.holonomic))
        if bound := sorted(map(str, held & set(angles.values()))):
            raise BadSystem(f"{name}: a holonomic constraint binds the angle {bound[0]} outside of sin and cos")
        bare = set().union(*(e.free_symbols for e in (*self.rows, *self.offsets, *self.more)))
        turning = {of for function in ("sin", "cos") for x, of in self.letters.arguments(function).items() if x in held}
        if both := turning & bare:
            clause = f"binds the angle {min(map(str, both))}, which is not only in sin and cos"
            raise BadSystem(f"{name}: a holonomic constraint {clause}")
        if any(sum(power for _, power in sp.factor_list(one)[1]) > 1 for one in self.holonomic):
            raise BadSystem(f"{name}: a holonomic constraint is a product: give the factor that is 0")
        roots = self.letters.arguments("sqrt")
        if any(of.free_symbols & roots.keys() for of in roots.values()):
            raise BadSystem(f"{name}: exact verdicts are not for roots in roots")
        for size in range(1, len(roots) + 1):
            for some_ in combinations(roots.values(), size):
                if not any(_no_square(sp.prod(some_).xreplace(point)) for point in self._bare):
                    listed = ", ".join(f"sqrt({of})" for of in some_)
                    raise BadSystem(f"{name}: exact verdicts need roots whose product is not rational: {listed}")
        for e in (*self.rows, *self.offsets, *self.more):
            self.is_zero(e)  # which refuses what is defined nowhere

    def _ring(self, relations: Sequence[sp.Expr], more: Iterable[sp.Expr] = ()) -> Quotient:
        relations = [*relations, *self.holonomic]
        known = set().union(*(e.free_symbols for e in (*relations, *self.rows, *self.offsets, *self.more, *more)))
        order = (*self.system.coordinates, *self.system.velocities, *self.letters.meanings)
        return Quotient([x for x in order if x in known], relations)

    @cached_property
    def ring(self) -> Quotient:
        """The ring of all expressions that were read."""
        return self._ring([*self.letters.circles, *self.letters.roots])

    @cached_property
    def _bare(self) -> list[Point]:
        """Exact points, without the roots."""
        return list(self._drawn(self._ring(self.letters.circles, self.letters.arguments("sqrt").values())))

    @cached_property
    def points(self) -> list[Point]:
        """Exact points of the ring: rational numbers and positive roots of these; raises BadSystem if there is none."""
        if not (found := list(self._rooted(self._bare))):
            raise BadSystem(f"{self.system.name}: no exact point is found where its relations hold")
        return found

    @cached_property
    def rational(self) -> list[Point]:
        """Points of rational numbers, and some where roots are rational; those with the fewest zeros first."""
        found, numbers = [p for p in self.points if all(x.is_Rational for x in p.values())], Random(0)
        if self.letters.roots:
            ring = self._ring(self.letters.circles, self.letters.arguments("sqrt").values())
            start = first(ring)
            more = (drawn(ring, lambda _: numbers.choice(LEGS), start) for _ in range(MOST_LOOKED))
            found += [p for p in self._rooted(more) if all(x.is_Rational for x in p.values())]
        return sorted(found, key=lambda point: [*point.values()].count(sp.S.Zero))

    def _rooted(self, points: Iterable[Point]) -> Iterator[Point]:
        """Points with the roots, which are positive."""
        roots = self.letters.arguments("sqrt")
        for point in points:
            values = {r: of.xreplace(point) for r, of in roots.items()}
            if all(x.is_Rational and x > 0 for x in values.values()):
                yield point | {r: sp.sqrt(x) for r, x in values.items()}

    def _drawn(self, ring: Quotient) -> Iterator[Point]:
        """Points of small primes first, then drawn ones."""
        primes = map(sp.prime, count(1))
        numbers = Random(0)
        try:
            if not ring.relations:
                yield {x: sp.Integer(next(primes)) for x in ring.symbols}
            for one, _ in zip(some(ring, Examples()), range(MOST_POINTS // 2), strict=False):
                yield one
            start = first(ring)
            for i in range(MOST_POINTS // 2):
                yield drawn(ring, partial(small, numbers, 2 + i), start)
        except (ArithmeticError, sp.PolynomialError):
            return

    def is_zero(self, expr: sp.Expr) -> bool:
        """Whether a rational function is 0 in the ring; raises BadSystem if it is defined nowhere."""
        try:
            return self.ring.is_zero(expr)
        except ZeroDivisionError:
            raise BadSystem(f"{self.system.name}: an expression divides by what is 0") from None

    def normal(self, vector: Sequence[sp.Expr]) -> list[sp.Expr]:
        """The normal forms of a vector, times roots that it divides by: the span is the same."""
        return self.cleared(vector)[0]

    def cleared(self, vector: Sequence[sp.Expr]) -> tuple[list[sp.Expr], sp.Expr]:
        """The same, and the product of these roots."""
        found, times = list(vector), sp.S.One
        for letter in self.letters.arguments("sqrt"):
            while not all(x.is_polynomial(letter) for x in found):
                found, times = [sp.expand(x * letter) for x in found], times * letter
        return [self.ring.normal(x) for x in found], times

    def shown(self, state: Mapping[sp.Symbol, sp.Expr]) -> dict[str, str]:
        """A point as text: without the angles of which only sines and cosines are there."""
        bare = set().union(*(e.free_symbols for e in (*self.rows, *self.offsets, *self.more, *self.holonomic)))
        hidden = set(self.letters.arguments("sin").values()) - bare
        return {str(x): str(v) for x, v in state.items() if x not in hidden}


def pivots(matrix: sp.Matrix) -> list[int]:
    """Columns that are independent, of a matrix of rational numbers and roots of these; exactly."""
    if not matrix.rows or not matrix.cols:
        return []
    return list(DomainMatrix.from_Matrix(matrix, extension=True).to_field().rref()[1])


def determinant(matrix: sp.Matrix) -> sp.Expr:
    """The determinant, not expanded: the ring decides its value."""
    with dotprodsimp(False):
        return matrix.det(method="laplace")


def adjugate(matrix: sp.Matrix) -> sp.Matrix:
    """The adjugate, likewise."""
    with dotprodsimp(False):
        return matrix.adjugate(method="laplace")


def rank(matrix: sp.Matrix, point: Point) -> int:
    """The rank at a point; 0 if the matrix is not defined there."""
    of = matrix.xreplace(point)
    return 0 if of.has(sp.zoo, sp.nan) or of.free_symbols else len(pivots(of))


def generic(matrix: sp.Matrix, points: Sequence[Point]) -> Point:
    """A point at which the rank is largest: the first where it is that of all rows."""
    full = (point for point in points if rank(matrix, point) == matrix.rows)
    return next(full, None) or max(points, key=lambda point: rank(matrix, point))


def has_longer(expr: sp.Expr, digits: int) -> bool:
    """Whether an expression has a number of more digits."""
    return any(max(abs(x.p), x.q) >= 10**digits for x in expr.atoms(sp.Rational))


def factors_of(expr: sp.Expr) -> list[sp.Expr]:
    """The factors of a polynomial, without their powers; the polynomial itself if its numbers are long."""
    return [expr] if has_longer(expr, FACTORED) else [of for of, _ in sp.factor_list(expr)[1]]


def size(expressions: Iterable[sp.Expr]) -> int:
    """The number of different parts of expressions."""
    seen, left = set[sp.Expr](), list(expressions)
    while left:
        if (expr := left.pop()) not in seen:
            seen.add(expr)
            left += expr.args
    return len(seen)


def _no_square(x: sp.Expr) -> bool:
    """Whether a number is defined, and no square of a rational one."""
    return bool(x.is_Rational) and not (x >= 0 and sp.sqrt(x).is_Rational)
