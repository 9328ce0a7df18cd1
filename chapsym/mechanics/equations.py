"""Equations of motion from other sources, compared exactly with those of the principle."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import sympy as sp
from sympy.core.function import AppliedUndef

from chapsym.numbers import brief, is_a

from .algebra import Algebra, adjugate, determinant, generic, pivots
from .brackets import kernel
from .series import replaced
from .system import BadSystem, System, a_system, dot, expression, rate, several, without

if TYPE_CHECKING:
    from sympy.physics.mechanics import KanesMethod


@dataclass(frozen=True)
class Agreement:
    """Whether accelerations are those of a system.

    Attributes
    ----------
    equal : bool
        True is proved, for all states that obey the constraints; False is shown by the point.
    what : str
        The violated equation.
    point : mapping of str to str
        An exact state at which it is violated, with sines and cosines instead of angles (an angle that also occurs
        outside of them is independent of them there); empty if none is violated.
    value : str
        The value that should be 0 there.
    """

    equal: bool
    what: str = ""
    point: Mapping[str, str] = field(default_factory=dict)
    value: str = "0"

    def __str__(self) -> str:
        if self.equal:
            return "equal: these accelerations are those of the principle, wherever the constraints hold"
        at = ", ".join(f"{name} = {value}" for name, value in self.point.items())
        return f"not equal: they break {self.what}, where {self.value} should be 0 at {at}"


def agree(system: System, accelerations: Mapping[sp.Symbol, sp.Expr]) -> Agreement:
    """Whether accelerations solve the equations of a system, with its numbers, if its constraints hold, decided
    exactly.

    They do if A a + Ȧ v + ḃ = 0, and if M a - ∂L/∂q + ... is orthogonal to all velocities that the constraints allow.

    Parameters
    ----------
    system : System
    accelerations : mapping
        {coordinate: its second derivative, in coordinates, velocities and parameters}; `in_symbols` converts results of
        `sympy.physics.mechanics`.

    Returns
    -------
    Agreement

    Raises
    ------
    BadSystem
        If one is missing, or has a symbol that the system does not have, if the ring cannot represent it (`Algebra`),
        or if no decision is found.

    Examples
    --------
    >>> from sympy import symbols
    >>> from chapsym.mechanics import System, agree, dot
    >>> x, y, z = symbols("x y z")
    >>> particle = System("particle", (x, y, z), sum(dot(q) ** 2 for q in (x, y, z)) / 2, [dot(z) - y * dot(x)])
    >>> right = -y * dot(x) * dot(y) / (1 + y**2)
    >>> agree(particle, {x: right, y: 0, z: y * right + dot(x) * dot(y)}).equal
    True
    >>> print(agree(particle, {x: -right, y: 0, z: -y * right + dot(x) * dot(y)}))
    not equal: they break the principle along 2 of 2, where -70 should be 0 at y = 2, y_dot = 5, z_dot = 7, x_dot = 7/2
    """
    if not is_a(accelerations, Mapping):
        raise BadSystem(f"accelerations must be given as {{coordinate: expression}}, not {brief(accelerations)}")
    if missing := [x for x in a_system(system).coordinates if x not in accelerations]:
        raise BadSystem(f"{system.name}: there is no acceleration of {missing[0]}")
    given = (expression(accelerations[x], f"{system.name}: the acceleration of {x}") for x in system.coordinates)
    of = OnShell(system, *given)
    made = sp.Matrix(of.more)
    checks = [(f"constraint {i + 1}", e) for i, e in enumerate(of.algebra.rows * made - of.turning)]
    work = of.mass * made - of.forced
    along = [(sp.Matrix([field]) * work)[0] for field in of.fields]
    checks += [(f"the principle along {i + 1} of {len(along)}", e) for i, e in enumerate(along)]
    for (what, _), on_shell in zip(checks, replaced((left for _, left in checks), of.allowed), strict=True):
        if not of.algebra.is_zero(on_shell):
            return Agreement(False, what, *_shown(on_shell, of.algebra, of.allowed))
    return Agreement(True)


@dataclass(frozen=True)
class Conservation:
    """Whether the exact motion keeps a quantity.

    Attributes
    ----------
    kept : bool
        True is proved, for all states that obey the constraints; False is shown by the point.
    point : mapping of str to str
        An exact state at which it changes, as in `Agreement`.
    rate : str
        Its rate of change there.
    """

    kept: bool
    point: Mapping[str, str] = field(default_factory=dict)
    rate: str = "0"

    def __str__(self) -> str:
        at = ", ".join(f"{name} = {value}" for name, value in self.point.items())
        return "kept by the exact motion" if self.kept else f"not kept: its rate is {self.rate} at {at}"


def conserved(system: System, quantity: sp.Expr) -> Conservation:
    """Whether the exact motion of a system, with its numbers, keeps a quantity, decided exactly.

    Parameters
    ----------
    system : System
    quantity : sympy.Expr
        In coordinates, velocities and parameters.

    Returns
    -------
    Conservation

    Raises
    ------
    BadSystem
        As `agree` does.

    Examples
    --------
    >>> from sympy import symbols
    >>> from chapsym.mechanics import System, conserved, dot
    >>> x, y, z = symbols("x y z")
    >>> particle = System("particle", (x, y, z), sum(dot(q) ** 2 for q in (x, y, z)) / 2, [dot(z) - y * dot(x)])
    >>> print(conserved(particle, (1 + y**2) * dot(x) ** 2))
    kept by the exact motion
    >>> print(conserved(particle, dot(x)))
    not kept: its rate is -7 at y = 2, y_dot = 5, z_dot = 7, x_dot = 7/2
    """
    quantity = expression(quantity, f"{a_system(system).name}: the quantity")
    known = {*system.coordinates, *system.velocities, *system.parameters}
    without(f"{system.name}: there is", quantity.free_symbols - known)
    slope = [sp.diff(quantity, v) for v in system.velocities]
    of = OnShell(system, rate(quantity, system.coordinates), *slope)
    alone, slope = of.more[0], sp.Matrix([of.more[1:]])
    x, first, inner, pushed = of.along
    whole = (alone + (slope * first)[0]) * sp.eye(1)
    bordered = sp.Matrix(sp.BlockMatrix([[inner, pushed], [slope * x, -whole]])) if of.fields else -whole
    below, above = (determinant(m.xreplace(of.allowed)) for m in (inner, bordered))
    if of.algebra.is_zero(below):
        raise BadSystem(f"{system.name}: the mass matrix is singular, so that the motion is not determined")
    if of.algebra.is_zero(above):
        return Conservation(True)
    return Conservation(False, *_shown(-above / below, of.algebra, of.allowed))


class OnShell:
    """The equations of a system in letters, with the velocities that its constraints determine, and further
    expressions.

    (A a = turning, and M a - forced orthogonal to the fields that span the allowed velocities.)
    """

    def __init__(self, system: System, *more: sp.Expr) -> None:
        v, n = list(system.velocities), len(system.coordinates)
        matrix, right = system.equations
        self.algebra = algebra = Algebra(system, *more, *matrix[:n, :n], *right, *v)
        self.more = algebra.more[: len(more)]
        rest = algebra.more[len(more) : -n]
        self.mass, forces = sp.Matrix(n, n, rest[: n * n]), sp.Matrix(rest[n * n :])
        self.forced, self.turning = forces[:n, :], forces[n:, :]
        if any(of.free_symbols & set(v) for of in algebra.letters.arguments("sin", "sqrt").values()):
            raise BadSystem(f"{system.name}: exact verdicts are not for functions of velocities")
        point = generic(algebra.rows, algebra.points)
        self.kept = pivots(algebra.rows.xreplace(point).T) if algebra.rows.rows else []
        rows, offsets = algebra.rows.extract(self.kept, list(range(n))), algebra.offsets.extract(self.kept, [0])
        self.bound = pivots(rows.xreplace(point))
        self.square = rows.extract(list(range(len(self.kept))), self.bound)
        free = {v[i]: sp.S.Zero for i in self.bound}
        solved = adjugate(self.square) * -(rows * sp.Matrix(v).xreplace(free) + offsets)
        below = determinant(self.square)
        self.allowed = {v[i]: value / below for i, value in zip(self.bound, solved, strict=True)}
        kept = (algebra.rows * sp.Matrix(v) + algebra.offsets).xreplace(self.allowed)
        if not all(map(algebra.is_zero, kept)):
            raise BadSystem(f"{system.name}: the constraints contradict each other, or depend on each other in places")
        self.fields = kernel(rows, rows.xreplace(point))

    @cached_property
    def along(self) -> tuple[sp.Matrix, sp.Matrix, sp.Matrix, sp.Matrix]:
        """The fields X; an acceleration a that satisfies the constraints; ⟨X, M X⟩, and Xᵀ(forced - M a)."""
        x, first = sp.Matrix(self.fields).T.reshape(self.mass.rows, len(self.fields)), sp.zeros(self.mass.rows, 1)
        for i, value in zip(self.bound, adjugate(self.square) * self.turning.extract(self.kept, [0]), strict=True):
            first[i] = value / determinant(self.square)
        return x, first, x.T * self.mass * x, x.T * (self.forced - self.mass * first)


def _shown(value: sp.Expr, algebra: Algebra, bound: Mapping[sp.Symbol, sp.Expr]) -> tuple[dict[str, str], str]:
    """A point at which an expression is not 0, with the dependent velocities there, and its value."""
    for point in algebra.points:
        found = value.xreplace(point)
        rest = {x: e.xreplace(point) for x, e in bound.items()}
        numbers = found, *rest.values()
        if not any(x.has(sp.zoo, sp.nan) or x.free_symbols for x in numbers) and pivots(sp.Matrix([found])):
            state = {x: v for x, v in point.items() if x not in rest} | rest
            return algebra.shown({x: sp.radsimp(v) for x, v in state.items()}), str(sp.radsimp(found))
    raise BadSystem(f"{algebra.system.name}: equality is not proved, and no exact state is found that refutes it")


def in_symbols(expr: Any) -> Any:
    """Expressions of `sympy.physics.mechanics` in symbols: x for x(t), x_dot for its derivative.

    Parameters
    ----------
    expr : sympy.Expr, sympy.Matrix, list or tuple
        An expression, or several.

    Returns
    -------
    sympy.Expr, sympy.Matrix, list or tuple
        The same in symbols.

    Raises
    ------
    BadSystem
        For anything but a real expression of SymPy, and for a second derivative, which has no symbol.

    Examples
    --------
    >>> from sympy.physics.mechanics import dynamicsymbols
    >>> from chapsym.mechanics import in_symbols
    >>> x = dynamicsymbols("x")
    >>> in_symbols(x.diff() ** 2 - x)
    -x + x_dot**2
    """
    if is_a(expr, sp.MatrixBase, list, tuple):
        made = [in_symbols(e) for e in several(expr, "what is to be in symbols")]
        return sp.Matrix(expr.rows, expr.cols, made) if isinstance(expr, sp.MatrixBase) else type(expr)(made)
    expr = expression(expr, "what is to be in symbols")
    if any(d.derivative_count > 1 for d in expr.atoms(sp.Derivative)):
        raise BadSystem(f"{expr!s:.60} has a second derivative, which has no symbol: replace it by its value")
    rates = [d for d in expr.atoms(sp.Derivative) if isinstance(d.expr, AppliedUndef)]
    expr = expr.xreplace({d: dot(sp.Symbol(d.expr.func.__name__)) for d in rates})
    return expr.xreplace({f: sp.Symbol(f.func.__name__) for f in expr.atoms(AppliedUndef)})


def of_kane(method: "KanesMethod") -> dict[sp.Symbol, sp.Expr]:
    """The accelerations of the coordinates by Kane's method, for `agree`.

    Parameters
    ----------
    method : sympy.physics.mechanics.KanesMethod
        The method, after `kanes_equations`.  Its speeds, linear in the rates of the coordinates, are replaced by these
        rates.

    Returns
    -------
    dict
        {coordinate: its second derivative}, in symbols.

    Raises
    ------
    BadSystem
        If the method has no equations yet, or its speeds do not follow from the rates of the coordinates.
    """
    from sympy.physics.vector import dynamicsymbols  # takes 90 ms, with the units of physics

    try:
        q, u, rates = list(method.q), list(method.u), dict(method.kindiffdict())
        forced = method.mass_matrix_full.LUsolve(method.forcing_full)
    except Exception:  # whatever another object raises
        raise BadSystem("this is no KanesMethod whose kanes_equations have been formed") from None
    pushed = dict(zip([x.diff() for x in u], forced[len(q) :], strict=True))
    speeds: dict[sp.Expr, sp.Expr] = next(iter(sp.solve([x.diff() - rates[x.diff()] for x in q], u, dict=True)), {})
    if not set(u) <= speeds.keys():
        raise BadSystem("the speeds of this KanesMethod do not follow from the rates of its coordinates")
    found = {}
    for x in q:
        second = rates[x.diff()].diff(dynamicsymbols._t).xreplace(pushed)
        found[in_symbols(x)] = in_symbols(second.subs(speeds))
    return found
