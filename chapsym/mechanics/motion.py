"""A method run on a system: its kernels, in C where a compiler is there, in Python otherwise; and what it recorded."""

import ctypes
import logging
import shutil
import subprocess
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import numpy as np
import sympy as sp

from chapsym.codegen import Kernel, build, c_files, passes

from .algebra import Letters
from .methods import METHODS, Scheme
from .slope import Terms, differentiated, needed, shared
from .system import STEP, BadSystem, System, number

#: Newton's iteration: rounds at most; the last correction in units of the unknowns, and one that may stay; and how much
#: one must be smaller than the one before for the derivatives to serve another round.
MOST_ROUNDS, LAST, STAYS, SHRINKS = 50, 1e-15, 1e-9, 1e-3
#: The kernels are in steps already.
PASSES = (passes.FACTORED, *passes.PASSES[2:])
#: Steps between which an interrupt is seen.
PART = 50_000
ROUTINE = Path(__file__).with_name("march.c").read_text(encoding="utf-8")


class NotSolved(ArithmeticError):
    """A step that was not found; the message says which."""


@dataclass(frozen=True, eq=False)
class Motion:
    """Steps of a method.

    Attributes
    ----------
    time : numpy.ndarray
        (steps,), when the place is as recorded: at the beginning of a step, or in its middle.
    place, velocity : numpy.ndarray
        (steps, n), where the method looks at the step.
    energy : numpy.ndarray
        (steps,)
    constraint, places : numpy.ndarray
        (steps,), the largest |A v + b|, and the largest value of the holonomic constraints.
    integrals : dict of str to numpy.ndarray
        (steps,), the quantities that the system names.
    final : numpy.ndarray
        The last state.
    seconds : float
        Of processor time, for the steps.
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


class Runner:
    """A method made ready for a system: derived, generated, compiled.

    Parameters
    ----------
    system : System
    method : str
        One of METHODS.
    compiled : bool, optional
        Whether C takes the steps; by default where there is a compiler.
    """

    def __init__(self, system: System, method: str = "dla", compiled: bool | None = None) -> None:
        if method not in METHODS:
            raise BadSystem(f"{method!r} is no method; those are {', '.join(METHODS)}")
        self.system, self.method = system, method
        self.scheme: Scheme = METHODS[method].scheme(system)
        self.compiled = _has_compiler() if compiled is None else compiled

    @property
    def length(self) -> float:
        """The usual length of a step."""
        return number(self.system.step, f"{self.system.name}: the step")

    @cached_property
    def kernels(self) -> list[Kernel]:
        """What vanishes, its derivatives by the unknowns, what comes after, and where the step is looked at.

        Their names are none of the system's: y of the state, z of the unknowns, k of what is fixed, l of letters.
        """
        scheme, (constants, parts) = self.scheme, self._lifted
        known = (*self.system.parameters, *constants.values(), STEP)
        groups_ = (("y", scheme.state), ("z", scheme.unknowns), ("k", known))
        named = {x: sp.Symbol(f"{name}{i}") for name, group in groups_ for i, x in enumerate(group)}
        letters = Letters(plain=True)

        try:
            read = [[letters.into(e.xreplace(named)) for e in part] for part in parts]
        except BadSystem as error:
            raise BadSystem(f"{self.system.name}: {error}") from None
        residual, after, place, velocity = read
        state, unknowns, fixed = ([named[x] for x in group] for group in (scheme.state, scheme.unknowns, known))
        groups = (("state", tuple(state)), ("unknowns", tuple(unknowns)), ("fixed", tuple(fixed)))

        def kernel(name: str, terms: Terms, results: Sequence[sp.Expr]) -> Kernel:
            terms = needed(terms, results)
            steps = [([x], [e]) for x, e in terms.items()]
            outputs = tuple(f"r{i}" for i in range(len(results)))
            return Kernel(
                name, f"{name}.", (), groups, outputs, lambda: [0 * fixed[-1]] * len(results), lambda: (steps, results),
                letters=needed(letters.meanings, [*results, *terms.values()]),
            )  # fmt: skip

        terms, values = shared(residual)
        slope = kernel("slope", *differentiated(terms, values, unknowns, letters))
        seen = kernel("seen", *shared([*place, *velocity]))
        return [kernel("residual", terms, values), slope, kernel("after", *shared(after)), seen]

    @cached_property
    def _lifted(self) -> tuple[dict[sp.Expr, sp.Symbol], list[list[sp.Expr]]]:
        """Symbols for numbers that are no integers, and for e, and the scheme in these: a text has integers alone."""
        constants, scheme = dict[sp.Expr, sp.Symbol](), self.scheme
        parts = (scheme.residual, scheme.after, scheme.place, scheme.velocity)
        return constants, [[_lifted(e, constants) for e in part] for part in parts]

    @cached_property
    def fixed(self) -> np.ndarray:
        """Parameters and constants, in order."""
        return np.array([*self.system.numbers, *(float(e) for e in self._lifted[0])])

    @cached_property
    def functions(self) -> dict[str, Callable[..., Any]]:
        """The kernels in Python."""
        scope: dict[str, Any] = {}
        exec(compile(_text(self.kernels), "kernels", "exec"), scope)  # our own text, never a user's
        return {kernel.name: scope[kernel.name] for kernel in self.kernels}

    def march(self, steps: int, length: float | None = None, every: int = 1, start: np.ndarray | None = None) -> Motion:
        """Takes steps from the start of the system.

        Parameters
        ----------
        steps : int
        length : float, optional
            Of a step; that of the system by default.
        every : int
            Of which one is recorded.
        start : numpy.ndarray, optional
            Another state to start from, as `Motion.final` is one.

        Raises
        ------
        NotSolved
            If the equations of a step are not solved.
        """
        h = self.length if length is None else number(length, "the length of a step")
        for what, given in (("steps", steps), ("every", every)):
            if isinstance(given, bool) or not isinstance(given, int) or given < 1:
                raise BadSystem(f"{what} must be a whole number from 1 on, not {given!r}")
        if not h > 0:
            raise BadSystem(f"the length of a step must be positive, not {h!r}")
        fixed = np.array([*self.fixed, h])
        q, v = self.system.beginning
        if start is not None:
            q, v = self.velocities(start)
        state = self._numbers(self.scheme.start, q, v) if start is None else np.array(start, float)
        unknowns = self._numbers(self.scheme.guess, q, v)
        recorded = np.empty((-(-steps // every), 2 * len(q)))
        take = _in_c if self.compiled and self.library else _in_python
        begin = time.process_time()
        with np.errstate(all="ignore"):
            done = take(self, steps, every, state, unknowns, fixed, recorded)
        seconds = time.process_time() - begin
        if done < steps:
            which = f"{self.system.name}, {self.method}: step {done} of {steps}"
            if done == 0 and self._is_singular(q, v, fixed):
                why = "constraints depend on each other, or the mass matrix is singular (see Quaternion.swelling)"
                raise NotSolved(f"{which} has no solution, as its equations are singular: {why}")
            raise NotSolved(f"{which} has no solution near the last one")
        if not (np.isfinite(state).all() and np.isfinite(recorded).all()):
            raise NotSolved(f"{self.system.name}, {self.method}: a step of {steps} leaves the range of numbers")
        place, velocity = recorded[:, : len(q)], recorded[:, len(q) :]
        energy, *kept, integrals = ([x + 0 * place[:, 0] for x in of(*place.T, *velocity.T)] for of in self.measures)
        constraint, places = (np.max([0 * place[:, 0], *map(np.abs, values)], axis=0) for values in kept)
        times = h * (np.arange(0, steps, every) + float(self.scheme.when))
        named = dict(zip(self.system.integrals, integrals, strict=True))
        return Motion(times, place, velocity, energy[0], constraint, places, named, state, seconds)

    def _is_singular(self, q: np.ndarray, v: np.ndarray, fixed: np.ndarray) -> bool:
        """Whether the derivatives of the first step's equations are singular at its guess."""
        state, unknowns = (self._numbers(part, q, v) for part in (self.scheme.start, self.scheme.guess))
        slope = np.array(self.functions["slope"](*map(float, (*state, *unknowns, *fixed)))).reshape(len(unknowns), -1)
        return bool(np.isfinite(slope).all() and np.linalg.matrix_rank(slope) < len(unknowns))

    @cached_property
    def measures(self) -> list[Callable[..., Any]]:
        """The energy, what the constraints on velocities and on places set to 0, and the integrals, on arrays."""
        system = self.system
        symbols = (*system.coordinates, *system.velocities)
        numbers = dict(zip(system.parameters, map(sp.Float, system.numbers), strict=True))
        measured = ([system.energy], system.constraints, system.holonomic, list(system.integrals.values()))
        return [sp.lambdify(symbols, [e.xreplace(numbers) for e in one], "numpy", cse=True) for one in measured]

    def velocities(self, state: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Coordinates and velocities of a state, which may have momenta: p = ∂L/∂v is solved, with least |v|."""
        n = len(self.system.coordinates)
        q, rest = state[:n], state[n:]
        if self.scheme.state[n] == self.system.velocities[0]:
            return q, rest
        at_rest = self._numbers(list(self.system.momenta), q, 0 * q)
        return q, np.linalg.lstsq(self._mass(q), rest - at_rest, rcond=None)[0]

    def turned(self, state: np.ndarray, length: float) -> np.ndarray:
        """The state with the velocities turned round, for steps of a length."""
        q, v = self.velocities(state)
        if not self.scheme.reflects:
            return self._numbers(self.scheme.start, q, -v)
        v = self.march(1, length, start=state).velocity[0]
        return np.concatenate([q, state[len(q) :] - 2 * self._mass(q) @ v])

    def _mass(self, q: np.ndarray) -> np.ndarray:
        return self._numbers(list(self.system.mass), q, 0 * q).reshape(len(q), len(q))

    def _numbers(self, expressions: Sequence[sp.Expr], q: np.ndarray, v: np.ndarray) -> np.ndarray:
        symbols = (*self.system.coordinates, *self.system.velocities, *self.system.parameters)
        return np.array(sp.lambdify(symbols, list(expressions), "math")(*q, *v, *self.system.numbers), float)

    @cached_property
    def library(self) -> Any:
        """The compiled steps; None where they cannot be compiled, which is said."""
        scheme = self.scheme
        files = c_files.kernels_alone(_text(self.kernels), self.kernels, "system")
        stages = [*scheme.stages, *([[]] if not scheme.stages else [])]
        tableau = ", ".join(str(float(x)) for row in stages for x in row) or "0"
        sizes = {
            "STATE": len(scheme.state), "UNKNOWNS": len(scheme.unknowns), "SEEN": 2 * len(self.system.coordinates),
            "STAGES": len(scheme.stages), "FIXED_COUNT": len(self.fixed) + 1,
            "MOST_ROUNDS": MOST_ROUNDS, "LAST": LAST, "STAYS": STAYS, "SHRINKS": SHRINKS,
        }  # fmt: skip
        head = "".join(f"#define {name} {value}\n" for name, value in sizes.items())
        counts = {"unknowns": len(scheme.unknowns), "fixed": sizes["FIXED_COUNT"]}
        given = ["at", *(f"{name}[0]" if count == 1 else name for name, count in counts.items())]
        head += f"#define GIVEN(at) {', '.join(given)}\n"
        head += f"static const double tableau[] = {{{tableau}}};\n"
        with tempfile.TemporaryDirectory() as folder:
            place = Path(folder)
            for name, text in files.items():
                (place / name).write_text(text, encoding="utf-8")
            (place / "march.c").write_text(f'#include "system.c"\n{head}{ROUTINE}', encoding="utf-8")
            command = ["cc", "-O2", "-ffp-contract=off", "-shared", "-fPIC", "-I", folder, place / "march.c"]
            try:
                subprocess.run([*map(str, command), "-lm", "-o", place / "march.so"], check=True, capture_output=True)
                return ctypes.CDLL(str(place / "march.so"))
            except (OSError, subprocess.CalledProcessError) as error:
                logging.getLogger("chapsym").warning("plain Python takes the steps, as cc failed: %s", error)
                return None


@cache
def _has_compiler() -> bool:
    """Whether there is a compiler of C; says once what that costs if there is none."""
    if shutil.which("cc") is not None:
        return True
    logging.getLogger("chapsym").warning(
        "plain Python takes the steps, some hundred times slower: install a C compiler"
    )
    return False


def moved(
    system: System, method: str = "dla", steps: int = 1000, length: float | None = None, every: int = 1
) -> Motion:
    """The motion of a system from its start, by a method.

    Parameters
    ----------
    system : System
    method : str
        One of METHODS: "dla" is the discrete Lagrange-d'Alembert principle at the middle.
    steps : int
    length : float, optional
        Of a step; that of the system by default.
    every : int
        Of which one step is recorded.

    Returns
    -------
    Motion

    Raises
    ------
    BadSystem
        For a method that is none, or a start that breaks a constraint.
    NotSolved
        If the equations of a step are not solved.

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
    """
    return Runner(system, method).march(steps, length, every)


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


def _in_c(runner: Runner, steps: int, every: int, state: np.ndarray, unknowns: np.ndarray, *arrays: np.ndarray) -> int:
    """A part of the steps after the other, so that they can be interrupted; how many were taken."""
    arrays = (state, unknowns, np.tile(unknowns, 2), *arrays)
    pointers = [array.ctypes.data_as(ctypes.POINTER(ctypes.c_double)) for array in arrays]
    run, done = runner.library.march, 0
    run.restype = ctypes.c_int64
    while done < steps:
        end = min(steps, done + PART)
        if (reached := int(run(*map(ctypes.c_int64, (done, end, every)), *pointers))) < end:
            return reached
        done = end
    return steps


def _in_python(
    runner: Runner, steps: int, every: int, state: np.ndarray, unknowns: np.ndarray, fixed: np.ndarray,
    recorded: np.ndarray,
) -> int:  # fmt: skip
    """The same steps as `march.c` takes, in Python: each from the unknowns of the last, by Newton's iteration alone."""
    functions, stages, size = runner.functions, runner.scheme.stages, len(unknowns)

    def of(name: str, at: np.ndarray) -> np.ndarray:
        found = functions[name](*map(float, at), *map(float, unknowns), *map(float, fixed))
        return np.array(found if isinstance(found, tuple) else (found,))

    def solved(at: np.ndarray) -> bool:
        before = np.inf
        for _ in range(MOST_ROUNDS):
            slope = of("slope", at).reshape(size, size)
            if not np.isfinite(slope).all() or np.linalg.matrix_rank(slope) < size:
                return False
            change = np.linalg.solve(slope, of("residual", at))
            unknowns[:] -= change
            largest = float(np.max(np.abs(change) / (1 + np.abs(unknowns))))
            if not largest < np.inf:
                return False
            if stages or largest <= LAST or (largest < STAYS and largest >= before / 2):
                return True
            before = largest
        return False

    def rates(at: Any) -> np.ndarray:
        if not solved(at):
            raise NotSolved
        return of("after", at)

    for i in range(steps):
        if not solved(state):
            return i
        if i % every == 0:
            recorded[i // every] = of("seen", state)
        try:
            state[:] = runner.scheme.step(state, of("after", state), fixed[-1], rates, float)
        except NotSolved:
            return i
    return steps
