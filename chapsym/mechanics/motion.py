"""A run of a method on a system: its kernels, in C if there is a compiler, else in Python; and its records."""

import ctypes
import itertools
import logging
import subprocess
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property, lru_cache
from numbers import Complex, Real
from pathlib import Path
from typing import Any

import numpy as np
import sympy as sp
from flint import arb_mat

from chapsym.codegen import Kernel, build, c_files, passes
from chapsym.dynamics.errors import BadInput
from chapsym.dynamics.implicit import Equations, Vector, solved
from chapsym.dynamics.kernels import Function, parts_of
from chapsym.numbers import Double, Enclosure, Precision, brief, named
from chapsym.numbers.precisions import is_whole

from .algebra import Letters
from .methods import Scheme, scheme_of
from .system import STEP, BadSystem, System, a_system, in_floats, rational

#: The state of a method: numbers, or in enclosures a set of them (see `Sets`).
State = Any
#: Why there is no step.
UNSOLVED = "has no solution near the last one"


class NotSolved(ArithmeticError):
    """A step that was not found; the message names it."""


class Steps:
    """A method at a precision: Newton's iteration for each step starts from the unknowns of the last step.

    Its kernels take the unknowns, with a given first guess, a state, and the constants, last the length of a step.
    """

    def __init__(
        self, scheme: Scheme, functions: Mapping[str, Function], level: Precision,
        unknowns: Sequence[float], fixed: Vector,
    ) -> None:  # fmt: skip
        self.scheme, self.functions, self.level, self.fixed = scheme, functions, level, fixed
        self.unknowns: Vector = unknowns
        self.equations = Equations(functions["residual"], functions["slope"], len(unknowns), 1.0)

    def number(self, value: sp.Rational) -> Any:
        """The number of a rational one of SymPy."""
        return self.level.number(Fraction(value.p, value.q))

    def of(self, name: str, unknowns: Vector, at: Vector) -> Vector:
        """The result of a kernel."""
        return [0 * self.fixed[-1] + x for x in parts_of(self.functions[name](*unknowns, *at, *self.fixed))]

    def root(self, at: Vector) -> Vector:
        """The unknowns at a state."""
        known = [*at, *self.fixed]
        try:
            self.unknowns = self.equations.at_level(self.unknowns, list(map(float, known)), Double())
            is_double = isinstance(self.level, Double)
            return self.unknowns if is_double else self.equations.at_level(self.unknowns, known, self.level)
        except BadInput:
            raise NotSolved(UNSOLVED) from None

    def after(self, root: Vector, at: Vector) -> Vector:
        """The next state by the unknowns of a step."""
        found = self.of("after", root, at)
        return self.scheme.step(at, found, self.fixed[-1], lambda x: self.of("after", self.root(x), x), self.number)

    def step(self, state: State) -> tuple[Vector, State]:
        """The position and velocity at the point of evaluation, and the next state."""
        root = self.root(state)
        return self.of("seen", root, state), self.after(root, state)

    def first(self, state: Vector) -> State:
        """A state as the argument of `step`."""
        return list(state)

    def numbers(self, state: State) -> Vector:
        """A state as numbers."""
        return state


class Sets(Steps):
    """The same in enclosures, in which each root is proved.

    Balls for each number of a state would grow by a factor per step, like a rotated box.  So a state is a set c + B r,
    with a point c, a nearly orthogonal matrix B and balls r, which the derivatives of a step move: R. Lohner, in
    Computational Ordinary Differential Equations (1992) 425.
    """

    level: Enclosure

    def first(self, state: Vector) -> State:
        """A state of balls."""
        size = len(state)
        unit = arb_mat(size, size, [int(i == j) for i in range(size) for j in range(size)])
        return [x.mid() for x in state], unit, arb_mat(size, 1, [x - x.mid() for x in state])

    def numbers(self, state: State) -> Vector:
        """A state as balls."""
        point, frame, box = state
        return [c + x for c, x in zip(point, (frame * box).entries(), strict=True)]

    def step(self, state: State) -> tuple[Vector, State]:
        """c moves as a point, and B r by the derivatives on the whole set."""
        point, frame, box = state
        size, at, middle = len(point), self.numbers(state), self.root(point)
        reached = self.after(middle, point)
        try:
            if any(x.rad() > 1 + abs(x.mid()) for x in at):
                raise NotSolved
            # The derivatives by the unknowns are regular on all of these, so that both roots are of one branch.
            root = [x.union(y) for x, y in zip(self.root(at), middle, strict=True)]
            rows = [np.array([x, *(int(i == j) for j in range(size))], object) for i, x in enumerate(at)]
            first, length = self._moved(root, rows), self.fixed[-1]
            moved = self.scheme.step(
                rows, first, length, lambda x: self._moved(self.root([row[0] for row in x]), x), self.number
            )
            turned = arb_mat([list(row[1:]) for row in moved]) * frame
            frame = arb_mat(_orthogonal(turned, box))
            point = [x.mid() for x in reached]
            inverse, rest = frame.inv(), arb_mat(size, 1, [x - c for x, c in zip(reached, point, strict=True)])
        except (NotSolved, ZeroDivisionError, np.linalg.LinAlgError):
            widest = max(float(x.rad()) for x in at)
            more = f"take more bits than Enclosure({self.level.bits}), or fewer steps"
            raise NotSolved(f"has an enclosure that has grown too wide, to a radius of {widest:.1g}: {more}") from None
        return self.of("seen", root, at), (point, frame, (inverse * turned) * box + inverse * rest)

    def _moved(self, root: Vector, rows: Sequence[np.ndarray]) -> list[np.ndarray]:
        """The next rows after rows of a number and its derivatives by the first state.

        For the unknowns z, F(z, y) = 0: z' = -F_z⁻¹ F_y, and so that of G(z, y) is G_y - G_z F_z⁻¹ F_y.
        """
        at = [row[0] for row in rows]
        n, size = len(root), len(root) + len(at)
        table = np.array(self.of("turning", root, at), object).reshape(-1, size)
        f_z, f_y, g_z, g_y = (arb_mat(half.tolist()) for part in np.vsplit(table, [n]) for half in np.hsplit(part, [n]))
        by_first = (g_y - g_z * f_z.solve(f_y)) * arb_mat([list(row[1:]) for row in rows])
        values = self.of("after", root, at)
        return [np.array([x, *row], object) for x, row in zip(values, by_first.tolist(), strict=True)]


def _orthogonal(matrix: arb_mat, box: arb_mat) -> list[list[float]]:
    """A nearly orthogonal matrix along the columns of another, the longest of the set first."""
    middle = np.array(matrix.mid().tolist(), float)
    longest = np.argsort(-np.linalg.norm(middle, axis=0) * np.array([float(x.rad()) for x in box.entries()]))
    return np.linalg.qr(middle[:, longest])[0].tolist()


#: Named values, in order.
Terms = dict[sp.Symbol, sp.Expr]


def shared(expressions: Sequence[sp.Expr]) -> tuple[Terms, list[sp.Expr]]:
    """The common parts of some expressions, by the names s0, s1, ..., and the expressions by these names."""
    terms, rest = sp.cse(list(expressions), symbols=sp.numbered_symbols("s"), order="none")
    return dict(terms), rest


def differentiated(
    terms: Terms, results: Sequence[sp.Expr], unknowns: Sequence[sp.Symbol], letters: Letters
) -> tuple[Terms, list[sp.Expr]]:
    """The derivatives of results that have terms in common, row by row, with d0, d1, ... for the rates of these."""
    meanings, rates, done = letters.meanings, dict[tuple[sp.Symbol, sp.Symbol], sp.Expr](), dict(terms)

    def rate(name: sp.Symbol, x: sp.Symbol) -> sp.Expr:
        if name not in terms and name not in meanings:
            return sp.S.Zero
        if (name, x) not in rates:
            of = letters.derivative(terms[name], x, rate) if name in terms else letters.rate(name, x)
            if not of.is_Atom and not (-of).is_Atom:
                symbol = sp.Symbol(f"d{len(rates)}")
                done[symbol] = of
                of = symbol
            rates[name, x] = of
        return rates[name, x]

    return done, [letters.derivative(e, x, rate) for e in results for x in unknowns]


def needed(terms: Mapping[sp.Symbol, sp.Expr], results: Sequence[sp.Expr]) -> Terms:
    """The terms that the results need, and those that these need, in order."""
    wanted = set().union(*(e.free_symbols for e in results))
    for name in reversed([*terms]):
        if name in wanted:
            wanted |= terms[name].free_symbols
    return {name: e for name, e in terms.items() if name in wanted}


#: Newton's iteration: the largest number of rounds; the last correction, relative to the unknowns, and an acceptable
#: stagnating one; and the ratio of successive corrections up to which the derivatives are kept.
MOST_ROUNDS, LAST, STAYS, SHRINKS = 50, 1e-15, 1e-9, 1e-3
#: Without the pass for common parts, as the kernels are in steps already.
PASSES = (passes.FACTORED, *passes.PASSES[2:])
#: The largest number of a float.
BEYOND = int(np.finfo(float).max)
#: The number of steps between checks for an interrupt.
PART = 50_000
ROUTINE = Path(__file__).with_name("march.c").read_text(encoding="utf-8")


@dataclass(frozen=True, eq=False)
class Motion:
    """Steps of a method, in arrays of float64, or of the numbers of another precision.

    Attributes
    ----------
    time : numpy.ndarray
        (steps,), the times of the recorded positions: at the beginning of a step, or in its middle.
    place, velocity : numpy.ndarray
        (steps, n), at the point of a step where the method is evaluated.
    energy : numpy.ndarray
        (steps,)
    constraint, places : numpy.ndarray
        (steps,), the largest |A v + b|, and the largest value of the holonomic constraints.
    integrals : dict of str to numpy.ndarray
        (steps,), the recorded quantities of the system.
    final : numpy.ndarray
        The last state.
    seconds : float
        The processor time of the steps.
    """

    time: np.ndarray
    place: np.ndarray
    velocity: np.ndarray
    energy: np.ndarray
    constraint: np.ndarray
    places: np.ndarray
    integrals: dict[str, np.ndarray]
    final: np.ndarray
    seconds: float


def whole_number(given: float, what: str) -> int:
    """A count in the range of C; raises BadSystem for anything else."""
    if not is_whole(given) or not 1 <= given < 2**62:
        clause = "to 2^62" if is_whole(given) and given > 0 else "on"
        raise BadSystem(f"{what} must be a whole number from 1 {clause}, not {brief(given)}")
    return int(given)


def check_callback(progress: object) -> None:
    """Raises BadSystem unless `progress` is callable."""
    if not callable(progress):
        raise BadSystem(f"progress must be a function, which is called with the steps taken, not {brief(progress)}")


class Runner:
    """A method prepared for a system: derived, generated, compiled.

    Parameters
    ----------
    system : System
    method : str
        One of METHODS.
    compiled : bool, optional
        Whether the steps are compiled C; by default if there is a compiler.
    precision : str or Precision, optional
        The precision of the numbers, as for `moved`.

    Examples
    --------
    >>> from sympy import symbols
    >>> from chapsym.mechanics import Runner, System, dot
    >>> x, y = symbols("x y")
    >>> sled = System("sled", (x, y), (dot(x) ** 2 + dot(y) ** 2) / 2, [dot(y) - dot(x)], start={dot(x): 1})
    >>> Runner(sled, "dla").march(10).velocity[-1].round(9).tolist()
    [1.0, 1.0]
    """

    def __init__(
        self, system: System, method: str = "dla", compiled: bool | None = None, precision: str | Precision = "double"
    ) -> None:
        self.system, self.method = a_system(system), method
        self.scheme: Scheme = scheme_of(system, method)
        try:
            self.level = named(precision)
        except ValueError as error:
            raise BadSystem(str(error)) from None
        self.in_floats = isinstance(self.level, Double)
        self.compiled = self.in_floats and compiled is not False

    @property
    def integrals(self) -> dict[str, sp.Expr]:
        """The quantities that are recorded, by name."""
        return {**self.system.integrals, **self.scheme.integrals}

    @cached_property
    def kernels(self) -> list[Kernel]:
        """The equations, their derivatives by the unknowns, the next state, and the point of evaluation."""
        residual, after, place, velocity = map(self._read, ("residual", "after", "place", "velocity"))
        terms, values = shared(residual)
        unknowns = self._groups["unknowns"]
        slope = self._kernel("slope", *differentiated(terms, values, unknowns, self._letters))
        seen = self._kernel("seen", *shared([*place, *velocity]))
        return [self._kernel("residual", terms, values), slope, self._kernel("after", *shared(after)), seen]

    @cached_property
    def more(self) -> list[Kernel]:
        """Of other numbers than float64: the first state, the constraints, and what is measured.

        For enclosures, too, the derivatives of what vanishes and of what comes after, by unknowns and state.
        """
        made = [self._kernel(name, *shared(self._read(name))) for name in ("start", "constraints", "measured")]
        if isinstance(self.level, Enclosure):
            terms, values = shared([*self._read("residual"), *self._read("after")])
            symbols = [*self._groups["unknowns"], *self._groups["state"]]
            made.append(self._kernel("turning", *differentiated(terms, values, symbols, self._letters)))
        return made

    @cached_property
    def _groups(self) -> dict[str, list[sp.Symbol]]:
        """Arguments of kernels, whose names are none of the system's: z, y, k; l are letters."""
        counts = {"unknowns": len(self.scheme.unknowns), "state": len(self.scheme.state), "fixed": len(self._known)}
        return {g: [sp.Symbol(f"{g_}{i}") for i in range(counts[g])] for g, g_ in zip(counts, "zyk", strict=True)}

    @cached_property
    def _letters(self) -> Letters:
        return Letters(plain=True)

    @property
    def _known(self) -> list[sp.Symbol]:
        return [*self.system.parameters, *self._lifted[0].values(), STEP]

    def _read(self, part: str) -> list[sp.Expr]:
        """A part of the scheme, or of the system, in the arguments of kernels and letters."""
        scheme, groups = self.scheme, self._groups
        velocities = zip(self.system.velocities, groups["state"][len(self.system.coordinates) :], strict=True)
        symbols = (*scheme.unknowns, *scheme.state, *self._known)
        put = {**dict(velocities), **dict(zip(symbols, itertools.chain(*groups.values()), strict=True))}
        try:
            return [self._letters.into(e.xreplace(put)) for e in self._lifted[1][part]]
        except BadSystem as error:
            raise BadSystem(f"{self.system.name}: {error}") from None

    def _kernel(self, name: str, terms: Terms, results: Sequence[sp.Expr]) -> Kernel:
        terms, groups = needed(terms, results), self._groups
        steps = [([x], [e]) for x, e in terms.items()]
        outputs = tuple(f"r{i}" for i in range(len(results)))
        return Kernel(
            name, f"{name}.", (), tuple((group, tuple(symbols)) for group, symbols in groups.items()), outputs,
            lambda: [0 * groups["fixed"][-1]] * len(results), lambda: (steps, results),
            letters=needed(self._letters.meanings, [*results, *terms.values()]),
        )  # fmt: skip

    @cached_property
    def _lifted(self) -> tuple[dict[sp.Expr, sp.Symbol], dict[str, list[sp.Expr]]]:
        """Symbols for numbers that are no integers, and for e, and what is computed in these: texts have integers."""
        constants, system, scheme = dict[sp.Expr, sp.Symbol](), self.system, self.scheme
        parts = {name: getattr(scheme, name) for name in ("residual", "after", "place", "velocity", "start")}
        parts["constraints"] = [*system.rows, *system.offsets]
        parts["measured"] = [system.energy, *system.constraints, *system.holonomic, *self.integrals.values()]
        if any(abs(x) > BEYOND for part in parts.values() for e in part for x in e.atoms(sp.Rational)):
            raise BadSystem(f"{system.name}: a number is beyond float64, about 1.8e308")
        return constants, {name: [_lifted(e, constants) for e in part] for name, part in parts.items()}

    @cached_property
    def fixed(self) -> np.ndarray:
        """Parameters and constants, in order."""
        if self.in_floats:
            return np.array([*self.system.numbers, *(float(e) for e in self._lifted[0])])
        parameters = (self._number(v, f"the parameter {x}") for x, v in self.system.parameters.items())
        return np.array([*parameters, *(self._number(e, "a constant") for e in self._lifted[0])], object)

    def _number(self, value: Any, what: str) -> Any:
        what = f"{self.system.name}: {what}"
        exact = rational(value, what)
        try:
            with self.level.working():
                return self.level.number(Fraction(exact.p, exact.q))
        except OverflowError:
            raise BadSystem(f"{what} is {brief(value)}, which is beyond the numbers") from None

    @cached_property
    def functions(self) -> dict[str, Function]:
        """The kernels in Python."""
        scope: dict[str, Any] = {}
        kernels = [*self.kernels, *([] if self.in_floats else self.more)]
        exec(compile(_text(kernels), "kernels", "exec"), scope)  # our own text, never a user's
        return {kernel.name: scope[kernel.name] for kernel in kernels}

    def march(
        self, steps: int, length: float | str | Fraction | None = None, every: int = 1,
        start: np.ndarray | None = None, progress: Callable[[int], None] = lambda done: None,
    ) -> Motion:  # fmt: skip
        """Takes steps from the start of the system.

        Parameters
        ----------
        steps : int
        length : number, optional
            The time of a step; by default that of the system.
        every : int
            The number of steps from one record to the next.
        start : numpy.ndarray, optional
            Another first state, such as `Motion.final`, in the numbers of the precision.
        progress : callable, optional
            Called with the number of steps taken, now and then.

        Returns
        -------
        Motion

        Raises
        ------
        NotSolved
            If the equations of a step are not solved.
        """
        h = self.system.length(length)
        steps, every = whole_number(steps, "steps"), whole_number(every, "every")
        check_callback(progress)
        q, v = self.system.beginning
        with self.level.working(), np.errstate(all="ignore"):
            if start is not None:
                q, v = self.velocities(self._given(start, 0.0))
            unknowns = self._numbers(self.scheme.guess, q, v)
            if not self.in_floats:
                h = self._number(self.system.step if length is None else length, "the length of a step")
            fixed = np.array([*self.fixed, h])
            if start is not None:
                state = self._given(start, 0 * h)
            else:
                state = self._numbers(self.scheme.start, q, v) if self.in_floats else self._beginning(fixed)
            try:
                recorded = np.empty((-(-steps // every), 2 * len(q)), fixed.dtype)
            except (MemoryError, ValueError):
                raise BadSystem(f"the places of {steps} steps do not fit into memory: record fewer by every=") from None
            take = _in_c if self.compiled and self.library else _in_numbers
            begin = time.process_time()
            done, why = take(self, steps, every, progress, state, unknowns, fixed, recorded)
            seconds = time.process_time() - begin
            if done < steps:
                which = f"{self.system.name}, {self.method}: step {done} of {steps}"
                if done == 0 and self._is_singular(q, v, fixed):
                    why = "constraints depend on each other, or the mass matrix is singular (see Quaternion.swelling)"
                    raise NotSolved(f"{which} has no solution, as its equations are singular: {why}")
                raise NotSolved(f"{which} {why}")
            if not all(map(_are_finite, (state, recorded))):
                raise NotSolved(f"{self.system.name}, {self.method}: a step of {steps} leaves the range of numbers")
            place, velocity = recorded[:, : len(q)], recorded[:, len(q) :]
            try:
                (energy,), *kept, integrals = self._measured(place, velocity, fixed)
            except Exception:  # for any functions of SymPy in the integrals
                integrals = [np.array([np.nan])]
                (energy,), kept = integrals, []
            if not all(map(_are_finite, (energy, *itertools.chain(*kept), *integrals))):
                raise NotSolved(f"{self.system.name}, {self.method}: a quantity is not defined on the motion")
            is_enclosed = isinstance(self.level, Enclosure)
            largest = np.frompyfunc(lambda a, b: a.max(b), 2, 1).reduce if is_enclosed else np.max
            constraint, places = (largest([0 * place[:, 0], *map(np.abs, values)], axis=0) for values in kept)
            if self.in_floats:
                times = h * (np.arange(0, steps, every) + float(self.scheme.when))
            else:
                times = np.array([self._number(i + self.scheme.when, "") for i in range(0, steps, every)], object) * h
        quantities = dict(zip(self.integrals, integrals, strict=True))
        return Motion(times, place, velocity, energy, constraint, places, quantities, state, seconds)

    def _given(self, start: Any, zero: Any) -> np.ndarray:
        """A given state, in the numbers of `zero`."""
        try:
            masked = np.ma.isMaskedArray(start) or any(x is np.ma.masked for x in start)
            if np.shape(start) != (len(self.scheme.state),) or masked or np.iscomplexobj(start):
                raise TypeError
            found = np.array([zero + x for x in start], float if isinstance(zero, float) else object)
            if not _are_finite(found):
                raise ValueError
            return found
        except Exception:  # of numbers of any kind
            wanted = f"{len(self.scheme.state)} numbers, as `final` has them"
            raise BadSystem(f"the start must be {wanted}, not {brief(start)}") from None

    def _measured(self, place: np.ndarray, velocity: np.ndarray, fixed: np.ndarray) -> list[list[np.ndarray]]:
        """The energy, what the constraints on velocities and on places set to 0, and the integrals."""
        if self.in_floats:
            return [[x + 0 * place[:, 0] for x in of(*place.T, *velocity.T, fixed[-1])] for of in self.measures]
        rows = (self._of("measured", *pair, fixed) for pair in zip(place, velocity, strict=True))
        columns = [np.array(column, place.dtype) for column in zip(*rows, strict=True)]
        counts = 1, len(self.system.constraints), len(self.system.holonomic), len(self.integrals)
        return [[columns.pop(0) for _ in range(count)] for count in counts]

    def _of(self, name: str, q: Vector, v: Vector, fixed: np.ndarray) -> Vector:
        """The result of a kernel at a place and velocity."""
        unknowns = [0] * len(self.scheme.unknowns)  # which it has not
        of = self.functions[name]
        try:
            return [0 * fixed[-1] + x for x in parts_of(of(*unknowns, *q, *v, *fixed))]
        except (ArithmeticError, ValueError):
            raise self._undefined() from None

    def _undefined(self) -> NotSolved:
        return NotSolved(f"{self.system.name}, {self.method}: a function of the system has no value where a step is")

    def _beginning(self, fixed: np.ndarray) -> np.ndarray:
        """The first state in other numbers than float64; velocities that are not given are the smallest possible."""
        system, zero = self.system, 0 * fixed[-1]
        given = {x: self._number(value, f"the start of {x}") for x, value in system.start.items()}
        q, v = ([given.get(x, zero) for x in symbols] for symbols in (system.coordinates, system.velocities))
        free = [i for i, x in enumerate(system.velocities) if x not in given]
        if free and system.rows.rows:
            found = np.array(self._of("constraints", q, v, fixed), object)
            if not _are_finite(found):
                raise self._undefined()
            rows, offsets = found[: -system.rows.rows].reshape(-1, len(q)), found[-system.rows.rows :]
            kept = list[int]()
            for i in range(len(rows)):  # independent rows
                rank = np.linalg.matrix_rank(rows[[*kept, i]][:, free].astype(float))
                kept += [i] if rank > len(kept) else []
            within, short = rows[kept][:, free], -(rows @ v + offsets)[kept]
            for i, more in zip(free, solved((within @ within.T).tolist(), short) @ within, strict=True):
                v[i] += more
        return np.array(self._of("start", q, v, fixed), object)

    def _is_singular(self, q: np.ndarray, v: np.ndarray, fixed: np.ndarray) -> bool:
        """Whether the derivatives of the equations of the first step are singular at its guess."""
        state, unknowns = (self._numbers(part, q, v) for part in (self.scheme.start, self.scheme.guess))
        try:
            found = self.functions["slope"](*map(float, (*unknowns, *state, *fixed)))
            slope = np.array(found).reshape(len(unknowns), -1)
        except (ArithmeticError, ValueError):  # they have no values there
            return False
        return bool(np.isfinite(slope).all() and np.linalg.matrix_rank(slope) < len(unknowns))

    @cached_property
    def measures(self) -> list[Function]:
        """The energy, what the constraints on velocities and on places set to 0, and the integrals, on arrays."""
        system = self.system
        symbols = (*system.coordinates, *system.velocities, STEP)
        numbers = dict(zip(system.parameters, map(sp.Float, system.numbers), strict=True))
        measured = ([system.energy], system.constraints, system.holonomic, list(self.integrals.values()))
        return [in_floats(symbols, [e.xreplace(numbers) for e in one], "numpy", cse=True) for one in measured]

    def velocities(self, state: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Coordinates and velocities of a state, in float64; for momenta the solution of p = ∂L/∂v with least |v|."""
        n = len(self.system.coordinates)
        q, rest = np.split(np.array(state, float), [n])
        if self.scheme.state[n] == self.system.velocities[0]:
            return q, rest
        at_rest = self._numbers(list(self.system.momenta), q, 0 * q)
        return q, np.linalg.lstsq(self._mass(q), rest - at_rest, rcond=None)[0]

    def turned(self, state: np.ndarray, length: float) -> np.ndarray:
        """The state with reversed velocities, for steps of a length."""
        q, v = self.velocities(state)
        if not self.scheme.reflects:
            return self._numbers(self.scheme.start, q, -v)
        v = self.march(1, length, start=state).velocity[0]
        return np.concatenate([q, state[len(q) :] - 2 * self._mass(q) @ v])

    def _mass(self, q: np.ndarray) -> np.ndarray:
        return self._numbers(list(self.system.mass), q, 0 * q).reshape(len(q), len(q))

    def _numbers(self, expressions: Sequence[sp.Expr], q: np.ndarray, v: np.ndarray) -> np.ndarray:
        """The values of expressions; raises NotSolved if there are none."""
        symbols = (*self.system.coordinates, *self.system.velocities, *self.system.parameters)
        try:
            return np.array(_in_floats(symbols, tuple(expressions))(*q, *v, *self.system.numbers), float)
        except (ArithmeticError, TypeError, ValueError):
            raise self._undefined() from None

    @cached_property
    def library(self) -> Any:
        """The compiled steps; None, with a warning, if they cannot be compiled."""
        scheme = self.scheme
        files = c_files.kernels_alone(_text(self.kernels), self.kernels, "system", {})
        stages = [*scheme.stages, *([[]] if not scheme.stages else [])]
        tableau = ", ".join(str(float(x)) for row in stages for x in row) or "0"
        sizes = {
            "STATE": len(scheme.state), "UNKNOWNS": len(scheme.unknowns), "SEEN": 2 * len(self.system.coordinates),
            "STAGES": len(scheme.stages), "FIXED_COUNT": len(self.fixed) + 1,
            "MOST_ROUNDS": MOST_ROUNDS, "LAST": LAST, "STAYS": STAYS, "SHRINKS": SHRINKS,
        }  # fmt: skip
        head = "".join(f"#define {name} {value}\n" for name, value in sizes.items())
        counts = {"unknowns": len(scheme.unknowns), "at": len(scheme.state), "fixed": sizes["FIXED_COUNT"]}
        given = (f"{name}[0]" if count == 1 else name for name, count in counts.items())
        head += f"#define GIVEN(at) {', '.join(given)}\n"
        head += f"static const double tableau[] = {{{tableau}}};\n"
        with tempfile.TemporaryDirectory() as folder:
            place = Path(folder)
            command = ["cc", "-O2", "-ffp-contract=off", "-shared", "-fPIC", "-I", folder, place / "march.c"]
            try:
                for name, text in {**files, "march.c": f'#include "system.c"\n{head}{ROUTINE}'}.items():
                    (place / name).write_text(text, encoding="utf-8")
                subprocess.run([*map(str, command), "-lm", "-o", place / "march.so"], check=True, capture_output=True)
                return ctypes.CDLL(str(place / "march.so"))
            except (OSError, subprocess.CalledProcessError) as error:
                _say_once(str(error) if isinstance(error, OSError) else f"cc ended with status {error.returncode}")
                return None


def _are_finite(values: np.ndarray) -> bool:
    """Whether numbers of any kind are real and finite."""
    is_real = values.dtype.kind == "f" or all(isinstance(x, Real) or not isinstance(x, Complex) for x in values.flat)
    return is_real and bool((np.abs(values) < np.inf).all())


@lru_cache(maxsize=32)
def _in_floats(symbols: tuple[sp.Symbol, ...], expressions: tuple[sp.Expr, ...]) -> Callable[..., list[float]]:
    return in_floats(symbols, expressions, "math")


@cache
def _say_once(why: str) -> None:
    text = "plain Python takes the steps, slower than C: cc is missing or failed: %s"
    logging.getLogger("chapsym").warning(text, why)


def moved(
    system: System,
    method: str = "dla",
    steps: int = 1000,
    length: float | str | Fraction | None = None,
    every: int = 1,
    precision: str | Precision = "double",
) -> Motion:
    """The motion of a system from its start, by a method.

    Parameters
    ----------
    system : System
    method : str, optional
        One of METHODS: "dla" is the discrete Lagrange-d'Alembert principle at the midpoint.
    steps : int, optional
    length : number, optional
        The time of a step; by default that of the system.
    every : int, optional
        The number of steps from one record to the next.
    precision : str or Precision, optional
        "double" is float64; "double-double", `chapsym.Digits(n)` and `chapsym.Enclosure(bits)` use exact parameters,
        start and length, with floats as written.  An enclosure contains the motion of the method; it is proved that
        each step has the followed root, which is near the last root.

    Returns
    -------
    Motion

    Raises
    ------
    BadSystem
        For an unknown method, a start that violates a constraint, or irrational expressions at another precision.
    NotSolved
        If the equations of a step are not solved, or an enclosure has grown too wide for it.

    Examples
    --------
    >>> from sympy import symbols
    >>> from chapsym.mechanics import System, dot, moved
    >>> x, y, z = symbols("x y z")
    >>> free = sum(dot(q) ** 2 for q in (x, y, z)) / 2
    >>> particle = System("particle", (x, y, z), free, [dot(z) - y * dot(x)], start={dot(x): 1, dot(y): "1/2"})
    >>> motion = moved(particle, steps=100)
    >>> motion.energy[[0, -1]].round(6).tolist(), bool(motion.constraint.max() < 1e-14)
    ([0.625312, 0.625157], True)
    >>> from chapsym import Enclosure
    >>> print(moved(particle, steps=100, precision=Enclosure(100)).energy[-1].str(25))
    [0.62515655901137717269...]
    """
    return Runner(system, method, precision=precision).march(steps, length, every)


def _lifted(expr: sp.Expr, constants: dict[sp.Expr, sp.Symbol]) -> sp.Expr:
    """An expression with symbols for its numbers that are no integers nor powers, which `constants` takes."""
    if expr.is_Integer or expr.is_Symbol or expr is sp.pi:
        return expr
    if expr.is_Rational or isinstance(expr, sp.Float | sp.NumberSymbol):
        return constants.setdefault(expr, sp.Symbol(f"constant {len(constants)}"))
    if isinstance(expr, sp.Pow) and expr.exp.is_Rational:
        return _lifted(expr.base, constants) ** expr.exp
    if isinstance(expr, sp.exp) or not expr.args:
        return expr  # which the letters refuse
    return expr.func(*(_lifted(x, constants) for x in expr.args))


def _text(kernels: Sequence[Kernel]) -> str:
    imports = "from chapsym.numbers.functions import cos, pi, sin, sqrt\n\n"
    return imports + "\n\n".join(build.code(kernel, PASSES) for kernel in kernels)


def _in_c(
    runner: Runner, steps: int, every: int, progress: Callable[[int], None], state: np.ndarray, unknowns: np.ndarray,
    *arrays: np.ndarray,
) -> tuple[int, str]:  # fmt: skip
    """Takes the steps in parts, so that they can be interrupted; returns the number taken, and why no more."""
    arrays = (state, unknowns, np.tile(unknowns, 2), *arrays)
    pointers = [array.ctypes.data_as(ctypes.POINTER(ctypes.c_double)) for array in arrays]
    run, done = runner.library.march, 0
    run.restype = ctypes.c_int64
    while done < steps:
        end = min(steps, done + PART)
        if (reached := int(run(*map(ctypes.c_int64, (done, end, every)), *pointers))) < end:
            return reached, UNSOLVED
        done = end
        progress(done)
    return steps, ""


def _in_numbers(
    runner: Runner, steps: int, every: int, progress: Callable[[int], None], state: np.ndarray, unknowns: np.ndarray,
    fixed: np.ndarray, recorded: np.ndarray,
) -> tuple[int, str]:  # fmt: skip
    """The same steps in any numbers, in Python."""
    kind = Sets if isinstance(runner.level, Enclosure) else Steps
    method = kind(runner.scheme, runner.functions, runner.level, unknowns.tolist(), fixed.tolist())
    now = method.first(state.tolist())
    for i in range(steps):
        try:
            seen, now = method.step(now)
        except NotSolved as error:
            return i, str(error)
        if i % every == 0:
            recorded[i // every] = seen
        progress(i + 1)
    state[:] = method.numbers(now)
    return steps, ""
