"""Equations of motion that somebody typed, or another program derived, decided against those of the principle."""

import random
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from chapsym.derive import Quotient
from chapsym.prove.points import drawn, small

from .algebra import Algebra
from .brackets import _kernel, _pivots
from .system import BadSystem, System, dot

#: Points at which a difference is looked at.
MOST_POINTS = 40


@dataclass(frozen=True)
class Agreement:
    """Whether accelerations are those of a system.

    Attributes
    ----------
    equal : bool
        True is proved, for all states that obey the constraints; False is shown by the point.
    what : str
        Which equation they break.
    point : mapping of str to str
        An exact state at which they do, with sines and cosines in the place of angles; empty where they break none.
    value : str
        What should be 0 there.
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
    """Whether accelerations solve the equations of a system wherever its constraints hold, decided exactly.

    They do if A a + Ȧ v + ḃ = 0, and if M a - ∂L/∂q + ... is orthogonal to all velocities that the constraints allow.

    Parameters
    ----------
    system : System
    accelerations : mapping
        {coordinate: its second derivative, in coordinates, velocities and parameters}; `in_symbols` reads what
        `sympy.physics.mechanics` gives.

    Returns
    -------
    Agreement

    Raises
    ------
    BadSystem
        If one is missing, or has a symbol or a function that the system does not have.

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
    not equal: they break the principle along 2 of 2, where -286 should be 0 at x = 2, y = 3, z = 5, y_dot = 11, ...
    """
    if missing := [x for x in system.coordinates if x not in accelerations]:
        raise BadSystem(f"{system.name}: there is no acceleration of {missing[0]}")
    algebra = Algebra(system)
    q, v = list(system.coordinates), list(system.velocities)
    typed = sp.Matrix([algebra.into(accelerations[x]) for x in q])
    matrix, right = system.equations
    count, n = system.rows.rows, len(q)
    mass, forced, turning = (algebra.into(m) for m in (matrix[:n, :n], right[:n, :], right[n:, :]))
    rows, offsets = algebra.rows, algebra.into(system.offsets)
    known = {*q, *v, *system.parameters, *algebra.letters.meanings}
    if strange := typed.free_symbols - known:
        listed = ", ".join(sorted(map(str, strange)))
        raise BadSystem(f"{system.name}: an acceleration has {listed}, which is no coordinate, velocity or parameter")
    relations = [*algebra.letters.relations, *algebra.holonomic]
    order = [*q, *v, *system.parameters, *algebra.letters.meanings]
    ring = Quotient(order, relations)
    places = list(_places(ring))
    if not places:
        raise BadSystem(f"{system.name}: no rational point is found where its relations hold")
    point = max(places, key=lambda p: rows.xreplace(p).rank()) if count else places[0]
    rows_at = rows.xreplace(point)
    kept = _pivots(rows_at.T) if count else []
    rows_, offsets_ = rows.extract(kept, list(range(n))), offsets.extract(kept, [0])
    bound = _pivots(rows_.xreplace(point)) if count else []
    square = rows_.extract(list(range(len(kept))), bound)
    free = {v[i]: sp.S.Zero for i in bound}
    solved = square.adjugate() * -(rows_ * sp.Matrix(v).xreplace(free) + offsets_) / square.det(method="berkowitz")
    allowed = {v[i]: value for i, value in zip(bound, solved, strict=True)}
    fields = _kernel(rows_, rows_.xreplace(point)) if count else [list(sp.eye(n)[i, :]) for i in range(n)]
    angles = set().union(*(x.free_symbols for x in algebra.letters.meanings.values())) & set(q)
    checks = [(f"constraint {i + 1}", e) for i, e in enumerate(rows * typed - turning)]
    work = mass * typed - forced
    checks += [
        (f"the principle along {i + 1} of {len(fields)}", sum(f * w for f, w in zip(field, work, strict=True)))
        for i, field in enumerate(fields)
    ]
    for what, left in checks:
        on_shell = sp.sympify(left).xreplace(allowed)
        if not ring.is_zero(on_shell):
            return Agreement(False, what, *_shown(on_shell, places, allowed, angles))
    return Agreement(True)


def _places(ring: Quotient) -> Iterator[dict[sp.Symbol, Any]]:
    """Exact points where the relations of a ring hold."""
    numbers = random.Random(0)
    try:
        for i in range(MOST_POINTS):
            yield drawn(ring, partial(small, numbers, 1 + i // 8)) if i else _primes(ring)
    except ArithmeticError:
        return


def _primes(ring: Quotient) -> dict[sp.Symbol, Any]:
    """A point of small primes, where no relation binds them."""
    values = iter(range(1, 1 + len(ring.symbols)))
    return drawn(ring, lambda _: Fraction(int(sp.prime(next(values)))))


def _shown(
    value: sp.Expr,
    places: list[dict[sp.Symbol, Any]],
    bound: Mapping[sp.Symbol, sp.Expr],
    angles: Collection[sp.Symbol],
) -> tuple[dict[str, str], str]:
    """A point at which an expression is not 0, with the velocities that the constraints bind there, and its value."""
    for point in places:
        found = value.xreplace(point)
        rest = {x: e.xreplace(point) for x, e in bound.items()}
        if all(x.is_Rational for x in (found, *rest.values())) and found != 0:
            state = {x: v for x, v in point.items() if x not in rest} | rest
            return {str(x): str(v) for x, v in state.items() if x not in angles}, str(found)
    return {}, str(value)


def in_symbols(expr: Any) -> Any:
    """What `sympy.physics.mechanics` gives, in symbols: x for x(t), x_dot for its derivative; also of matrices.

    Examples
    --------
    >>> from sympy.physics.mechanics import dynamicsymbols
    >>> x = dynamicsymbols("x")
    >>> in_symbols(x.diff() ** 2 - x)
    -x + x_dot**2
    """
    if isinstance(expr, sp.MatrixBase | list | tuple):
        made = [in_symbols(e) for e in expr]
        return sp.Matrix(expr.rows, expr.cols, made) if isinstance(expr, sp.MatrixBase) else type(expr)(made)
    expr = sp.sympify(expr)
    rates = {d: d for d in expr.atoms(sp.Derivative) if d.derivative_count == 1 and isinstance(d.expr, AppliedUndef)}
    expr = expr.xreplace({d: dot(sp.Symbol(d.expr.func.__name__)) for d in rates})
    return expr.xreplace({f: sp.Symbol(f.func.__name__) for f in expr.atoms(AppliedUndef)})
