"""Steps of a method, and the exact motion, as power series in the length of a step from an exact state.

All coefficients are rational numbers.  A state has its angles at 0, or where their sines and cosines are rational.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property, lru_cache, partial, reduce
from operator import add, is_not, mul
from typing import Any, TypeVar

import sympy as sp
from flint import ctx, fmpq, fmpq_mat, fmpq_series
from flint.utils.flint_exceptions import DomainError

from chapsym.derive.quotient import in_sympy
from chapsym.prove import Examples
from chapsym.prove.points import candidates

from .methods import Scheme
from .system import STEP, System, rational

#: Trial numbers for coordinates with holonomic constraints, first for a quaternion.
UNIT = ("1/5", "2/5", "4/5", "2/5")
#: Cosines and sines of angles, used in turn.
TURNS = ((3, 4, 5), (12, 5, 13), (8, 15, 17))
#: An angle is turned where it is taken no more times than this.
MOST_TURNS = 100

#: A number or a series in the length of a step: fmpq or fmpq_series.
Series = Any
State = list[Series]
T = TypeVar("T")
Of = Callable[[sp.Expr], T]
Made = Callable[[sp.Expr, Of[T]], T]


class Undecided(ArithmeticError):
    """Exact series do not decide the question; the message has the reason."""


def by_parts(expressions: Iterable[sp.Expr], known: Mapping[sp.Expr, T], made: Made[T]) -> list[T]:
    """The results of `made` for expressions, by its results for their parts, which `of` gives; of shared parts once."""
    found = dict(known)

    def of(expr: sp.Expr) -> T:
        if expr not in found:
            found[expr] = made(expr, of)
        return found[expr]

    return [of(in_sympy(e)) for e in expressions]


#: One step of an evaluation: a leaf, or what is done with the results of earlier steps at some places.
Operation = tuple[Any, tuple[int, ...]]


def evaluated(expressions: Iterable[sp.Expr], values: Mapping[sp.Symbol, Any], number: Any = fmpq) -> list[Any]:
    """The values of expressions in any numbers: fractions, series, a finite field."""
    operations, ends = _operations(tuple(expressions))
    found: list[Any] = []
    try:
        for of, parts in operations:
            if parts:
                found.append(of(*(found[i] for i in parts)))
            else:
                found.append(number(of.p, 1) / number(of.q, 1) if of.is_Rational else values[of])
    except KeyError as missing:
        raise Undecided(f"{missing.args[0]!s:.60} has no exact series") from None
    except ZeroDivisionError:
        raise Undecided("an expression divides by 0 at the exact state") from None
    except (ValueError, DomainError):
        raise Undecided("an expression has no rational series at the exact state") from None
    return [found[i] for i in ends]


@lru_cache(256)  # the same equations are evaluated at many states
def _operations(expressions: tuple[sp.Expr, ...]) -> tuple[list[Operation], list[int]]:
    """What is done for expressions, shared parts once, and the places of the results."""
    operations = list[Operation]()

    def made(expr: sp.Expr, of: Callable[[sp.Expr], int]) -> int:
        done, args = (expr, ()) if expr.is_Rational or expr.is_Symbol else _operation(expr)
        operations.append((done, tuple(map(of, args))))
        return len(operations) - 1

    return operations, by_parts(expressions, {}, made)


def _operation(expr: sp.Expr) -> tuple[Callable[..., Series], Sequence[sp.Expr]]:
    """What an expression does with its parts."""
    if isinstance(expr, sp.Add | sp.Mul):
        one = add if isinstance(expr, sp.Add) else mul
        return lambda *parts: reduce(one, parts), expr.args
    if isinstance(expr, sp.Pow) and expr.exp.is_Rational and expr.exp.q <= 2:
        return partial(_power, expr.exp.p, expr.exp.q), expr.args[:1]
    if isinstance(expr, sp.sin | sp.cos | sp.tan):
        name = expr.func.__name__
        return lambda angle: getattr(series(angle), name)(), expr.args
    raise Undecided(f"{expr!s:.60} has no exact series")


def _power(p: int, q: int, base: Series) -> Series:
    """base^(p/q), q 1 or 2."""
    root = base if q == 1 else (series(base) / series(base)[0]).sqrt() * series(base)[0].sqrt()
    whole = root ** abs(p)
    return 1 / whole if p < 0 else whole


def series(x: Series) -> Series:
    """A number as a series."""
    return x if isinstance(x, fmpq_series) else fmpq_series([x])


def replaced(
    expressions: Iterable[sp.Expr], put: Mapping[sp.Symbol, sp.Expr], turned: Of[sp.Expr] = lambda wave: wave
) -> list[sp.Expr]:
    """Expressions with symbols replaced by others, and sines and cosines of expanded sums; shared parts once."""

    def made(expr: sp.Expr, of: Callable[[sp.Expr], sp.Expr]) -> sp.Expr:
        parts = [of(x) for x in expr.args]
        is_wave = isinstance(expr, sp.sin | sp.cos | sp.tan)
        is_new = is_wave or any(map(is_not, parts, expr.args))
        new = expr.func(*map(sp.expand, parts) if is_wave else parts) if is_new else expr
        if isinstance(new, sp.Expr) and isinstance(-new, sp.sin | sp.cos | sp.tan):  # not limits of an integral
            return -turned(-new)  # sin(-x)
        return turned(new) if isinstance(new, sp.sin | sp.cos | sp.tan) else new

    return by_parts(expressions, put, made)


class Exact:
    """A system with its numbers, and its motion as series."""

    def __init__(self, system: System) -> None:
        self.system, self.n, self.m = system, len(system.coordinates), system.rows.rows
        self.numbers = {x: rational(v, f"{system.name}: the parameter {x}") for x, v in system.parameters.items()}
        self._moved: dict[int, State] = {}
        self.turns = {x: TURNS[i % len(TURNS)] for i, x in enumerate(self._turning())}
        matrix, right = system.equations
        self._linear, self._right = self.read(matrix), self.read(right)
        self.symbols = (*system.coordinates, *system.velocities)

    def read(self, expressions: Iterable[sp.Expr]) -> list[sp.Expr]:
        """Expressions with the numbers of the parameters."""
        return replaced(expressions, self.numbers, self._turned)

    def _turning(self) -> list[sp.Symbol]:
        """Angles that are turned: those of which there are sines and cosines alone, not in roots, and linearly."""
        system = self.system
        own = [e for d in [system.discrete] if d for e in (d.lagrangian, *d.constraints, *d.integrals.values())]
        parts = (*system.constraints, *system.holonomic, *system.forces.values(), *system.integrals.values(), *own)
        everything = sp.Tuple(system.lagrangian, *parts)
        waves = everything.atoms(sp.sin, sp.cos, sp.tan)
        bare = everything.xreplace(dict.fromkeys(waves, sp.S.One)).free_symbols
        rooted = (e for e in everything.atoms(sp.Pow) if not e.exp.is_Integer)
        self.angles = set().union(*(e.free_symbols for e in waves)) & set(system.coordinates)
        fixed = bare.union(*(e.free_symbols for e in rooted))
        for of in (sp.expand(wave.args[0].xreplace(self.numbers)) for wave in waves):
            for x in of.free_symbols & self.angles:
                count = of.coeff(x)
                linear = count.is_Integer and abs(count) <= MOST_TURNS and not (of - count * x).has(x)
                fixed |= set() if linear or (count.is_Rational and not count.is_Integer) else {x}
        return sorted(self.angles - fixed, key=str)

    def _turned(self, wave: sp.Expr) -> sp.Expr:
        """A sine or cosine of turned angles, by those of the angles from there."""
        (of,) = wave.args
        turn = sp.expand(sp.prod(((a + b * sp.I) / c) ** of.coeff(x) for x, (a, b, c) in self.turns.items()))
        if turn == 1:
            return wave
        c, s = turn.as_real_imag()
        if not c.is_Rational:
            raise Undecided("an angle that is a part of a coordinate has no exact series")
        sine, cosine = sp.sin(of) * c + sp.cos(of) * s, sp.cos(of) * c - sp.sin(of) * s
        return {sp.sin: sine, sp.cos: cosine, sp.tan: sine / cosine}[wave.func]

    @property
    def shown(self) -> dict[str, str]:
        """The exact state as text, with sines and cosines of turned angles."""
        found = {str(x): str(v) for x, v in zip(self.symbols, self.state, strict=True) if x not in self.turns}
        for x, (a, b, c) in self.turns.items():
            found |= {f"sin({x})": f"{b}/{c}", f"cos({x})": f"{a}/{c}"}
        return found

    def at(self, expressions: Iterable[sp.Expr], state: Sequence[Series]) -> list[Series]:
        """Expressions of coordinates, and of velocities, at a state (of coordinates alone, too)."""
        return self._at(self.read(expressions), state)

    def _at(self, expressions: Sequence[sp.Expr], state: Sequence[Series]) -> list[Series]:
        return evaluated(expressions, dict(zip(self.symbols, state, strict=False)))

    @cached_property
    def state(self) -> State:
        """Exact coordinates and velocities that satisfy the constraints; turned angles start at 0."""
        system, angles = self.system, self.angles
        kept = [e.xreplace(dict.fromkeys(angles, sp.S.Zero)) for e in self.read(system.holonomic)]
        table = {x: sp.Rational(i + 4, i + 3) for i, x in enumerate(system.coordinates)}
        related = [x for x in system.coordinates if any(e.has(x) for e in kept)]
        table |= {x: sp.Rational(UNIT[i % 4]) for i, x in enumerate(related)}
        try:
            free = [x for x in system.coordinates if x not in angles]
            found = candidates(free, kept, Examples(numbers=table))
            place = next(at for at in found if all(x.is_Rational for x in at.values()))
        except (StopIteration, ArithmeticError, sp.PolynomialError):
            raise Undecided("no exact state is found") from None
        q = [fmpq(place[x].p, place[x].q) if x in place else fmpq(0) for x in system.coordinates]
        v = [fmpq(2 * i + 3, i + 2) for i in range(self.n)]
        return [_at(x, 0) for x in self.velocities([*q, *self.at(system.momenta, [*q, *v])])[0]]

    def solved(self, place: State, right: Sequence[Series]) -> list[Series]:
        """The solution of [M, -Aᵀ; A, 0] x = right at a position."""
        size = self.n + self.m
        entries = self._at(self._linear, place)
        rows = [entries[size * i : size * (i + 1)] for i in range(size)]
        slope = inverse(fmpq_mat([[_at(x, 0) for x in row] for row in rows]))
        found: list[Series] = [fmpq_series([0])] * size
        for _ in range(ctx.cap):
            off = [sum((a * x for a, x in zip(of, found, strict=True)), -r) for of, r in zip(rows, right, strict=True)]
            found = _less(found, slope, off)
        return found

    @property
    def moved(self) -> State:
        """The exact motion from the state over the time of a step."""
        if ctx.cap not in self._moved:
            now = [series(x) for x in self.state]
            for _ in range(ctx.cap):
                rates = self.solved(now[: self.n], self._at(self._right, now))
                v = [x + rate.integral() for x, rate in zip(self.state[self.n :], rates, strict=False)]
                now = [*(x + u.integral() for x, u in zip(self.state, v, strict=False)), *v]
            self._moved[ctx.cap] = now
        return self._moved[ctx.cap]

    def velocities(self, state: Sequence[Series], has_momenta: bool = True) -> tuple[State, list[Series]]:
        """Position and velocity v from a position and momenta p, and c, with p = ∂L/∂v + Aᵀc and A v + b = 0."""
        place, momenta = list(state[: self.n]), state[self.n :]
        if not has_momenta:
            return list(state), []
        at_rest = self.at(self.system.momenta, [*place, *([fmpq(0)] * self.n)])
        right = [p - b for p, b in zip(momenta, at_rest, strict=True)]
        found = self.solved(place, [*right, *(-b for b in self.at(self.system.offsets, place))])
        return [*place, *found[: self.n]], [-x for x in found[self.n :]]


class Stepped:
    """The steps of a method as series."""

    def __init__(self, exact: Exact, scheme: Scheme) -> None:
        self.exact, self.scheme = exact, scheme
        self.residual, self.after = exact.read(scheme.residual), exact.read(scheme.after)
        self.seen = exact.read((*scheme.place, *scheme.velocity))
        self.has_momenta = scheme.state[exact.n] not in exact.system.velocities

    def first(self, state: State) -> tuple[State, State]:
        """The state of the method, and a first guess of the unknowns."""
        start, guess = (self.exact.at(part, state) for part in (self.scheme.start, self.scheme.guess))
        return list(map(series, start)), list(map(series, guess))

    def of(self, expressions: Sequence[sp.Expr], state: State, unknowns: State, length: Series) -> list[Series]:
        """Expressions of the method."""
        symbols = (*self.scheme.state, *self.scheme.unknowns, STEP)
        return evaluated(expressions, dict(zip(symbols, (*state, *unknowns, length), strict=True)))

    def solved(self, state: State, unknowns: State, length: Series) -> State:
        """The unknowns of a step near a guess.

        `shift` says which equations a step multiplies: of these the next coefficients count.
        """
        size, small, columns = len(unknowns), fmpq_series([0, 0, 1]), []
        first = self.of(self.residual, state, unknowns, length)
        for j in range(size):
            other = [x + small if i == j else x for i, x in enumerate(unknowns)]
            columns.append([a - b for a, b in zip(self.of(self.residual, state, other, length), first, strict=True)])
        self.shift = [0 if any(_at(column[i], 2) != 0 for column in columns) else 1 for i in range(size)]
        slope = inverse(fmpq_mat([[_at(column[i], 2 + s) for column in columns] for i, s in enumerate(self.shift)]))
        for _ in range(ctx.cap + 1):
            left = zip(self.of(self.residual, state, unknowns, length), self.shift, strict=True)
            short = [fmpq_series([_at(x, k + s) for k in range(ctx.cap - s)]) for x, s in left]
            unknowns = _less(unknowns, slope, short)
        if any(_at(x, k) != 0 for x in self.of(self.residual, state, unknowns, length) for k in range(ctx.cap - 1)):
            raise Undecided("the equations of a step are not solved near the exact state")
        return unknowns

    def step(self, state: State, unknowns: State, length: Series) -> tuple[State, State]:
        """The state after a step, and its unknowns."""
        unknowns = self.solved(state, unknowns, length)

        def rates(at: State) -> State:
            return self.of(self.after, at, self.solved(at, unknowns, length), length)

        first = self.of(self.after, state, unknowns, length)
        return self.scheme.step(state, first, length, rates, lambda a: fmpq(a.p, a.q)), unknowns


def _at(x: Series, k: int) -> fmpq:
    """The coefficient of the power k."""
    if isinstance(x, fmpq_series):
        return x[k]
    return x if k == 0 else fmpq(0)


def inverse(matrix: fmpq_mat) -> fmpq_mat:
    """The inverse; raises Undecided if there is none."""
    try:
        return matrix.inv()
    except ZeroDivisionError:
        raise Undecided("the equations are singular at the exact state") from None


def _less(found: State, inverse: fmpq_mat, short: Sequence[Series]) -> State:
    """x - J⁻¹ r."""
    return [x - sum(map(mul, row, short), fmpq_series([0])) for x, row in zip(found, inverse.table(), strict=True)]
