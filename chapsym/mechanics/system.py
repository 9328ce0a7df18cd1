"""A system: coordinates, a Lagrangian, constraints on the velocities, forces; and the equations of its motion."""

import hashlib
import importlib.util
import math
import os
from collections.abc import Callable, Iterable, Mapping, Sequence, Set
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import sympy as sp

from chapsym import rationals
from chapsym.derive.quotient import in_sympy
from chapsym.numbers import brief, is_a
from chapsym.prove.registers import raised

#: The length of a step.
STEP = sp.Symbol("step_length")
#: The largest accepted error of the constraints at the start, in their own units.
NEAR = 1e-9
#: The most factors of a product, with powers as products: they nest in the text of a kernel.
MOST_FACTORS = 500


class BadSystem(ValueError):
    """An invalid system; the message says what is wrong and what would be right."""


def without(where: str, strange: Set[sp.Basic], what: str = "no coordinate, velocity or parameter") -> None:
    """Raises BadSystem if there are symbols that are not allowed there."""
    if strange:
        raise BadSystem(f"{where} {', '.join(sorted(map(str, strange)))}, which is {what}")


def a_symbol(x: object) -> sp.Symbol:
    """The symbol; raises BadSystem for anything else."""
    if not is_a(x, sp.Symbol):
        raise BadSystem(f"a coordinate must be a symbol, such as symbols('x'), not {brief(x)}")
    return x


def a_system(given: object) -> "System":
    """The system; raises BadSystem for anything else."""
    if not is_a(given, System):
        raise BadSystem(f"system must be a System, not {brief(given)}")
    return given


def dot(x: sp.Symbol) -> sp.Symbol:
    """The velocity of a coordinate: the symbol `x_dot` for x.

    Parameters
    ----------
    x : sympy.Symbol
        The coordinate.

    Returns
    -------
    sympy.Symbol

    Examples
    --------
    >>> from sympy import Symbol
    >>> from chapsym.mechanics import dot
    >>> dot(Symbol("x"))
    x_dot
    """
    return sp.Symbol(f"{a_symbol(x).name}_dot")


def rate(expr: sp.Expr | sp.MatrixBase, coordinates: Sequence[sp.Symbol]) -> sp.Expr | sp.MatrixBase:
    """d/dt of an expression, or of a matrix of them, in coordinates and constants.

    Parameters
    ----------
    expr : sympy.Expr or sympy.Matrix
        In coordinates and constants.
    coordinates : sequence of sympy.Symbol
        The symbols that change; the others are constants.

    Returns
    -------
    sympy.Expr or sympy.Matrix
        In the coordinates and their velocities `dot(x)`.

    Raises
    ------
    BadSystem
        For anything but real expressions of SymPy, and coordinates that are no symbols.

    Examples
    --------
    >>> from sympy import symbols
    >>> from chapsym.mechanics import rate
    >>> x, c = symbols("x c")
    >>> rate(c * x**2, [x])
    2*c*x*x_dot
    """
    if not is_a(expr, sp.MatrixBase):
        expr = expression(expr, "what changes")
    moving = map(a_symbol, several(coordinates, "coordinates"))
    return sum((sp.diff(expr, x) * dot(x) for x in moving), 0 * expr)


def after(x: sp.Symbol) -> sp.Symbol:
    """A coordinate after a step: the symbol `x_after` for x.

    Parameters
    ----------
    x : sympy.Symbol
        The coordinate.

    Returns
    -------
    sympy.Symbol

    Examples
    --------
    >>> from sympy import Symbol
    >>> from chapsym.mechanics import after
    >>> after(Symbol("x"))
    x_after
    """
    return sp.Symbol(f"{a_symbol(x).name}_after")


@dataclass(frozen=True, eq=False)
class Discrete:
    """A discretization of your own, for the discrete Lagrange-d'Alembert principle.

    Parameters
    ----------
    lagrangian : sympy.Expr
        An approximate action, in the coordinates x before and `after(x)` a step, the parameters and the step `STEP`.
    constraints : sequence of sympy.Expr
        Expressions that vanish at a step, one for each constraint of the system on velocities.
    integrals : mapping, optional
        {name: quantity of a step} to record, in the same symbols.

    Examples
    --------
    >>> from sympy import symbols
    >>> from chapsym.mechanics import STEP, Discrete, System, after, dot, moved
    >>> x, y = symbols("x y")
    >>> own = Discrete(((after(x) - x) ** 2 + (after(y) - y) ** 2) / (2 * STEP), [after(y) - y - (after(x) - x)])
    >>> energy = (dot(x) ** 2 + dot(y) ** 2) / 2
    >>> sled = System("sled", (x, y), energy, [dot(y) - dot(x)], start={dot(x): 1}, discrete=own)
    >>> moved(sled, "own", steps=10).velocity[-1].round(9).tolist()
    [1.0, 1.0]
    """

    lagrangian: sp.Expr
    constraints: Sequence[sp.Expr] = ()
    integrals: Mapping[str, sp.Expr] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class System:
    """A mechanical system with constraints on its velocities.

    Parameters
    ----------
    name : str
        Its name.
    coordinates : sequence of sympy.Symbol
        Numbers or angles, with sines and cosines.  A unit vector or a quaternion is given by its components, with its
        norm in `holonomic`.
    lagrangian : sympy.Expr
        In the coordinates, their velocities `dot(x)` and parameters; of degree two in the velocities.
    constraints : sequence of sympy.Expr, optional
        Expressions that vanish, affine in the velocities.
    holonomic : sequence of sympy.Expr, optional
        Expressions that vanish, only in the coordinates.
    forces : mapping, optional
        {coordinate: generalized force along it}, in coordinates and velocities, for forces that are not in the
        Lagrangian.
    parameters : mapping, optional
        {symbol: number}, each an int, a fraction, a float or a string such as "3/2".
    start : mapping, optional
        {coordinate or velocity: number}, likewise; the default is 0 for coordinates, and for velocities the smallest
        that the constraints allow.
    step : number, optional
        The default length of a step.
    source : str, optional
        Its source in the literature.
    discrete : Discrete, optional
        A discretization of your own: the method "own".
    integrals : mapping, optional
        {name: quantity in coordinates, velocities and parameters} to record, besides the energy.

    Raises
    ------
    BadSystem
        For an invalid system, with one sentence.

    Examples
    --------
    >>> from sympy import symbols
    >>> x, y, z = symbols("x y z")
    >>> particle = System("particle", (x, y, z), sum(dot(q) ** 2 for q in (x, y, z)) / 2, [dot(z) - y * dot(x)])
    >>> particle.rows, particle.energy
    (Matrix([[-y, 0, 1]]), x_dot**2/2 + y_dot**2/2 + z_dot**2/2)
    """

    name: str
    coordinates: Sequence[sp.Symbol]
    lagrangian: sp.Expr
    constraints: Sequence[sp.Expr] = ()
    holonomic: Sequence[sp.Expr] = ()
    forces: Mapping[sp.Symbol, sp.Expr] = field(default_factory=dict)
    parameters: Mapping[sp.Symbol, object] = field(default_factory=dict)
    start: Mapping[sp.Symbol, object] = field(default_factory=dict)
    step: object = "1/10"
    source: str = ""
    discrete: Discrete | None = None
    integrals: Mapping[str, sp.Expr] = field(default_factory=dict)

    def __post_init__(self) -> None:
        def put(name: str, value: object) -> None:
            object.__setattr__(self, name, value)

        if not is_a(self.name, str):
            raise BadSystem(f"name must be a text, not {brief(self.name)}")
        for name in ("coordinates", "constraints", "holonomic"):
            put(name, several(getattr(self, name), f"{self.name}: {name}"))
        put("lagrangian", expression(self.lagrangian, f"{self.name}: the Lagrangian"))
        for name in ("constraints", "holonomic"):
            put(name, tuple(expression(one, f"{self.name}: one of {name}") for one in getattr(self, name)))
        keys = {"forces": sp.Symbol, "parameters": sp.Symbol, "start": sp.Symbol, "integrals": str}
        for name, key in keys.items():
            given = getattr(self, name)
            if not is_a(given, Mapping) or not all(is_a(x, key) for x in given):
                form = "{symbol: value}" if key is sp.Symbol else "{name: quantity}"
                raise BadSystem(f"{self.name}: {name} must be given as {form}")
        for name, what in (("forces", "the force along"), ("integrals", "the integral")):
            given = getattr(self, name).items()
            put(name, {x: expression(e, f"{self.name}: {what} {x}") for x, e in given})
        if not self.coordinates or not all(is_a(x, sp.Symbol) for x in self.coordinates):
            raise BadSystem(f"{self.name}: coordinates must be symbols, such as symbols('x y'), and there must be some")
        named = *self.coordinates, *self.parameters
        if odd := [x for x in named if not x.is_commutative or x.is_real is False or x.is_zero or type(x) is sp.Wild]:
            raise BadSystem(f"{self.name}: {odd[0]} must be a symbol of real numbers, of 0 and of others")
        symbols = (*self.coordinates, *self.velocities, *self.parameters, STEP)
        names = [x.name for x in symbols]
        if len(set(names)) < len(names):
            twice = next(x for x in names if names.count(x) > 1)
            raise BadSystem(f"{self.name}: {twice} is two of coordinate, velocity, parameter and length of a step")
        if strange := [x for x in symbols if not (x.name.isidentifier() and x.name.isascii())]:
            raise BadSystem(f"{self.name}: {strange[0].name!r} cannot be a name: take letters, digits and _")
        known = {*self.coordinates, *self.velocities, *self.parameters}
        places = {*self.coordinates, *self.parameters}
        for what, expressions, allowed in (
            ("the Lagrangian", [self.lagrangian], known),
            ("a constraint", self.constraints, known),
            ("a holonomic constraint", self.holonomic, places),
            ("a force", self.forces.values(), known),
            ("an integral", self.integrals.values(), known),
        ):
            for one in expressions:
                without(f"{self.name}: {what} has", one.free_symbols - allowed)
                if what != "an integral":
                    _smooth(one, f"{self.name}: {what}")
        if self.discrete is not None:
            put("discrete", self._discretized(self.discrete, places | {after(x) for x in self.coordinates} | {STEP}))
        if fixed := [one for one in self.holonomic if not one.free_symbols & set(self.coordinates)]:
            raise BadSystem(f"{self.name}: the holonomic constraint {fixed[0]!s:.40} has no coordinate")
        without(f"{self.name}: a force is along", set(self.forces) - set(self.coordinates), "no coordinate")
        moving = {*self.coordinates, *self.velocities}
        without(f"{self.name}: the start has", set(self.start) - moving, "no coordinate or velocity")
        if self.mass.free_symbols & set(self.velocities):
            raise BadSystem(f"{self.name}: the Lagrangian is not of degree two in the velocities")
        if self.rows.free_symbols & set(self.velocities):
            raise BadSystem(f"{self.name}: a constraint is not affine in the velocities")

    def _discretized(self, discrete: Discrete, allowed: set[sp.Symbol]) -> Discrete:
        if not is_a(discrete, Discrete):
            raise BadSystem(f"{self.name}: discrete must be Discrete(lagrangian, constraints)")
        given = discrete.lagrangian, *several(discrete.constraints, f"{self.name}: the constraints of discrete")
        if not is_a(discrete.integrals, Mapping) or not all(is_a(x, str) for x in discrete.integrals):
            raise BadSystem(f"{self.name}: integrals of discrete must be given as {{name: quantity}}")
        names = [*discrete.integrals]
        if both := {"the energy", *self.integrals}.intersection(names):
            raise BadSystem(f"{self.name}: {min(both)} is a quantity of the system: give the discrete one another name")
        given = *given, *discrete.integrals.values()
        action, *rules = (expression(e, f"{self.name}: the discretization") for e in given)
        if twice := {after(x) for x in self.coordinates} & {*self.coordinates, *self.parameters}:
            raise BadSystem(f"{self.name}: {min(map(str, twice))} has the name of a coordinate after a step")
        for one in (action, *rules):
            without(f"{self.name}: the discretization has", one.free_symbols - allowed, "nothing at a step's two ends")
            _smooth(one, f"{self.name}: the discretization")
        rules, quantities = rules[: len(rules) - len(names)], rules[len(rules) - len(names) :]
        if len(rules) != len(self.constraints):
            counts = f"{len(rules)} constraints, and the system {len(self.constraints)}"
            raise BadSystem(f"{self.name}: the discretization has {counts}")
        if self.forces:
            raise BadSystem(f"{self.name}: a discretization of one's own has no forces")
        return Discrete(action, tuple(rules), dict(zip(names, quantities, strict=True)))

    def digest(self, *more: object) -> str:
        """A hash of all inputs of a run; raises BadSystem if they cannot be written."""
        parts = (self.coordinates, self.lagrangian, self.constraints, self.holonomic, self.forces, self.parameters)
        own = vars(self.discrete) if self.discrete else None, self.integrals
        try:  # a symbol may be called pi, as a number is
            text = repr((self.name, *map(sp.srepr, (*parts, own, self.start, self.step)), more))
        except ValueError:
            raise BadSystem(f"{self.name}: a number has more digits than Python writes") from None
        return hashlib.sha256(text.encode()).hexdigest()

    @property
    def velocities(self) -> tuple[sp.Symbol, ...]:
        """The velocities of the coordinates."""
        return tuple(dot(x) for x in self.coordinates)

    @cached_property
    def mass(self) -> sp.Matrix:
        """The mass matrix ∂²L/∂v²."""
        return sp.hessian(self.lagrangian, self.velocities)

    @cached_property
    def momenta(self) -> sp.Matrix:
        """∂L/∂v."""
        return sp.Matrix([sp.diff(self.lagrangian, v) for v in self.velocities])

    @cached_property
    def push(self) -> sp.Matrix:
        """∂L/∂q and the forces."""
        return sp.Matrix([sp.diff(self.lagrangian, x) + self.forces.get(x, 0) for x in self.coordinates])

    @cached_property
    def energy(self) -> sp.Expr:
        """The energy ⟨v, ∂L/∂v⟩ - L = ⟨v, M v⟩/2 - L(q, 0)."""
        v = sp.Matrix(self.velocities)
        at_rest = self.lagrangian.xreplace(dict.fromkeys(self.velocities, sp.S.Zero))
        return (v.T * self.mass * v)[0] / 2 - at_rest

    @cached_property
    def power(self) -> sp.Expr:
        """dE/dt without the power of the reactions of affine constraints: the power of the forces ⟨F, v⟩."""
        return sp.expand(sum((f * dot(x) for x, f in self.forces.items()), sp.S.Zero))

    @property
    def keeps_energy(self) -> bool:
        """Whether the motion keeps its energy: the forces do no work, and the constraints are linear in the velocities.

        Then dE/dt = ⟨v, Aᵀλ⟩ + ⟨F, v⟩ = -⟨λ, b⟩ + ⟨F, v⟩ = 0.
        """
        return self.power == 0 and all(sp.expand(b) == 0 for b in self.offsets)

    @cached_property
    def rows(self) -> sp.Matrix:
        """The A of A(q) v + b(q) = 0: a row for each constraint, and for the rate of each holonomic one."""
        made = [[sp.diff(c, v) for v in self.velocities] for c in self.constraints]
        made += [[sp.diff(c, x) for x in self.coordinates] for c in self.holonomic]
        return sp.Matrix(len(made), len(self.coordinates), lambda i, j: sp.expand(made[i][j]))

    @cached_property
    def offsets(self) -> sp.Matrix:
        """The b of A(q) v + b(q) = 0."""
        rest = [c.xreplace(dict.fromkeys(self.velocities, sp.S.Zero)) for c in self.constraints]
        return sp.Matrix(self.rows.rows, 1, [*rest, *([0] * len(self.holonomic))])

    @cached_property
    def equations(self) -> tuple[sp.Matrix, sp.Matrix]:
        """The matrix and the right side of linear equations for the accelerations and the multipliers λ.

        M a - Aᵀλ = ∂L/∂q + F - (∂²L/∂v∂q) v,  A a = -Ȧ v - ḃ (the Lagrange-d'Alembert principle).
        """
        count = len(self.rows[:, 0])
        v = sp.Matrix(self.velocities)
        inertial = self.momenta.jacobian(self.coordinates) * v
        matrix = sp.Matrix(sp.BlockMatrix([[self.mass, -self.rows.T], [self.rows, sp.zeros(count, count)]]))
        turning = rate(self.rows, self.coordinates) * v + rate(self.offsets, self.coordinates)
        return matrix, sp.Matrix([*(self.push - inertial), *(-turning)])

    def value(self, symbol: sp.Symbol) -> float:
        """The number of a parameter."""
        return number(self.parameters[symbol], f"{self.name}: the parameter {symbol}")

    def length(self, given: object = None) -> float:
        """The length of a step, by default the usual one; raises BadSystem if it is not a positive number."""
        found = number(self.step if given is None else given, f"{self.name}: the length of a step")
        if not found > 0:
            raise BadSystem(f"{self.name}: the length of a step must be positive, not {found!r}")
        return found

    @cached_property
    def numbers(self) -> np.ndarray:
        """The numbers of all parameters, in order."""
        return np.array([self.value(x) for x in self.parameters])

    @cached_property
    @np.errstate(all="ignore")  # numbers that are not finite are refused
    def beginning(self) -> tuple[np.ndarray, np.ndarray]:
        """Coordinates and velocities of the start; raises BadSystem if they break a constraint."""
        given = {x: number(v, f"{self.name}: the start of {x}") for x, v in self.start.items()}
        q, v = (np.array([given.get(x, 0.0) for x in symbols]) for symbols in (self.coordinates, self.velocities))
        numbers = self.numbers
        of = in_floats((*self.coordinates, *self.parameters), [self.rows, self.offsets, *self.holonomic], "numpy")
        try:
            found = of(*q, *numbers)
            rows, offsets, *kept = (np.asarray(x, complex if np.iscomplexobj(x) else float) for x in found)
            if not all(np.isrealobj(x) and np.isfinite(x).all() for x in (rows, offsets, *kept)):
                raise ArithmeticError
        except (ArithmeticError, TypeError):  # also for integers beyond floats
            raise BadSystem(f"{self.name}: a constraint is not defined at the start") from None
        if not all(abs(x) <= NEAR for x in kept):
            raise BadSystem(f"{self.name}: the start is {max(map(abs, kept)):.3g} off the holonomic constraints")
        rows, offsets = rows.reshape(len(self.rows[:, 0]), len(q)), offsets.ravel()
        free = [i for i, x in enumerate(self.velocities) if x not in given]
        if len(rows) and free:
            v[free] += np.linalg.lstsq(rows[:, free], -(rows @ v + offsets), rcond=None)[0]
        if len(rows) and not (worst := np.abs(rows @ v + offsets).max()) <= NEAR:
            mended = "leave out those that the constraints determine"
            raise BadSystem(f"{self.name}: the velocities of the start are {worst:.3g} off the constraints; {mended}")
        return q, v


def loaded(path: str | Path) -> System:
    """The system of a file, its SYSTEM; the first line of the docstring of the file is the title.

    The file is code that is run, as is the script of a register.

    Parameters
    ----------
    path : str or Path
        A Python file.

    Returns
    -------
    System

    Raises
    ------
    BadSystem
        If the file has no system.

    Examples
    --------
    >>> from chapsym.mechanics import loaded
    >>> loaded("no-such-file.py")
    Traceback (most recent call last):
    chapsym.mechanics.system.BadSystem: no-such-file.py is no file of a system: a Python file with SYSTEM = System(...)
    """
    if not is_a(path, str, os.PathLike):
        raise BadSystem(f"path must name a Python file, not {brief(path)}")
    path = Path(path)
    spec = importlib.util.spec_from_file_location(f"system_{path.stem}", path) if path.suffix == ".py" else None
    if spec is None or spec.loader is None or not path.is_file():
        raise BadSystem(f"{path} is no file of a system: a Python file with SYSTEM = System(...)")
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except (BadSystem, KeyboardInterrupt):
        raise
    except BaseException as error:
        raise BadSystem(f"{path} cannot be run: {raised(error)}") from error
    found = getattr(module, "SYSTEM", None)
    if not isinstance(found, System):
        raise BadSystem(f"{path} has no SYSTEM = System(...)")
    return found


def _read(value: Any) -> Any:
    """A number, of a text or a Decimal its fraction; raises TypeError for an object that is no single real number."""
    if is_a(value, np.ma.MaskedArray, np.timedelta64) or np.iscomplexobj(value) or np.ndim(value):
        raise TypeError
    if is_a(value, str):
        return rationals.rational(value, "a number")
    return rationals.exact_fraction(value) if is_a(value, Decimal) else value


def rational(value: Any, what: str) -> sp.Rational:
    """An exact number of a system; raises BadSystem, with the value, if it is no number."""
    try:
        is_long = is_a(value, sp.Float) and value._prec > sp.Float(0.5)._prec
        is_float = is_a(value, float, sp.Float)
        found = Fraction(_read(str(value)) if is_long else repr(float(value)) if is_float else _read(value))
    except Exception:  # also what an object raises
        raise BadSystem(f"{what} is {brief(value)}, which is no rational number") from None
    return sp.Rational(found.numerator, found.denominator)


def number(value: Any, what: str) -> float:
    """The same as a finite float."""
    try:
        found = float(_read(value))
    except Exception:  # also what an object raises
        raise BadSystem(f"{what} is {brief(value)}, which is no number") from None
    if not math.isfinite(found):
        raise BadSystem(f"{what} is not finite")
    return found


def in_floats(
    symbols: Sequence[sp.Symbol], expressions: Sequence[sp.Expr | sp.MatrixBase], module: str, cse: bool = False
) -> Callable[..., Any]:
    """Expressions, or matrices of them, as a function of floats by NumPy or `math`, of arrays by NumPy."""
    if any(hasattr(np, x.name) for x in symbols):  # such as pi, which would be the pi of the module
        put = {x: sp.Symbol(f"s{i}") for i, x in enumerate(symbols)}
        symbols, expressions = list(put.values()), [e.xreplace(put) for e in expressions]
    return sp.lambdify(symbols, expressions, module, cse=cse)


def several(value: object, what: str) -> tuple[Any, ...]:
    """A sequence as a tuple; raises BadSystem for anything else."""
    try:
        if is_a(value, Iterable) and not is_a(value, str, sp.Basic):
            return tuple(value)
    except Exception:  # of an array of no axes, and whatever an object raises
        pass
    raise BadSystem(f"{what} must be a sequence, such as a list, not {brief(value)}")


def _smooth(expr: sp.Expr, what: str) -> None:
    """Raises BadSystem for functions that kernels do not have."""
    known = sp.Add, sp.Mul, sp.Pow, sp.Number, sp.NumberSymbol, sp.Symbol, sp.sin, sp.cos, sp.tan
    powers = lambda e: (x.exp for x in sp.Mul.make_args(e) if x.is_Pow and x.exp.is_Integer)  # noqa: E731
    long = [e for e in expr.atoms(sp.Mul, sp.Pow) if sum(map(abs, powers(e))) > MOST_FACTORS]
    if strange := [*(e for e in sp.preorder_traversal(expr) if not isinstance(e, known)), *long]:
        clause = f"is not sin, cos, a square root or a whole power, or has more than {MOST_FACTORS} factors"
        raise BadSystem(f"{what} has {strange[0]}, which {clause}")


def expression(value: object, what: str) -> sp.Expr:
    """An expression of numbers and symbols, with floats as written."""
    try:
        found = in_sympy(value)
    except Exception:  # also what a number of another kind raises
        found = None
    if not isinstance(found, sp.Expr) or found.is_Matrix or found.has(sp.nan, sp.zoo, sp.oo, sp.I):
        raise BadSystem(f"{what} is {brief(value)}, which is no real expression of SymPy")
    return found.xreplace({x: rational(x, what) for x in found.atoms(sp.Float)})
