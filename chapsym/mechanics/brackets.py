"""The integrability of constraints: the flag of brackets of the fields that they allow, with its exact ranks.

The fields X with A X = 0 span D₁, and D_{k+1} also has the brackets [X, Y] of X in D₁ and Y in D_k.  By Frobenius'
theorem, if D₁ = D₂ has the dimension r, the constraints mean that n - r functions of the coordinates are constant; by
Chow's theorem every position is reached from every other if the flag ends with all n dimensions.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import product

import sympy as sp

from .algebra import Algebra, Point, Vectors, adjugate, determinant, generic, pivots, rank, size
from .system import BadSystem, System, a_system

#: The largest number of different parts of the fields and brackets: 2000 take some seconds, and the time grows faster.
MOST_PARTS = 3000


@dataclass(frozen=True)
class Flag:
    """The span of the brackets of the constraints of a system, with the numbers of its parameters.

    Attributes
    ----------
    growth : tuple of int
        The dimensions of D₁, D₂, ..., until they are constant, near `point` and at almost all positions of its
        component: proved by a minor that is not 0 there, and by minors that vanish in the ring of the system.
    fields : tuple of tuple of sympy.Expr
        Fields that span D₁, in letters; with a last component for the time if `with_time`.
    condition : sympy.Expr
        If it is not 0 at a position, the dimensions there are at least these; if it is 0, they may be.
    point : mapping
        The exact point, with sines and cosines instead of angles.
    dimension : int
        The dimension of the positions under the holonomic constraints, and of time.
    with_time : bool
        Whether constraints have a part without velocities; the time is then a coordinate of the flag.
    """

    growth: tuple[int, ...]
    fields: tuple[tuple[sp.Expr, ...], ...]
    condition: sp.Expr
    point: dict[str, str]
    dimension: int
    with_time: bool = False

    @property
    def integrable(self) -> bool:
        """Whether the constraints are integrable, that is, holonomic."""
        return len(self.growth) == 1

    @property
    def functions(self) -> int:
        """The number of functions of the coordinates, and of time, that are constant in every motion."""
        return self.dimension - self.growth[-1]

    def __str__(self) -> str:
        dimensions = ", ".join(map(str, self.growth))
        if self.integrable:
            what = "integrable" if self.functions else "no constraint"
        else:
            what = "completely nonholonomic" if not self.functions else "nonholonomic"
        some, stay = ("1 function", "stays") if self.functions == 1 else (f"{self.functions} functions", "stay")
        of = "coordinates and time" if self.with_time else "coordinates"
        kept = f"; {some} of the {of} {stay} constant" if self.functions else ""
        with_time = " with time" if self.with_time else ""
        return f"{what}: the flag has the dimensions {dimensions} of {self.dimension}{with_time}{kept}"


def flag(system: System) -> Flag:
    """The flag of brackets of the velocities that the constraints of a system allow.

    Parameters
    ----------
    system : System
        The system, with sines, cosines and square roots of its coordinates.

    Returns
    -------
    Flag
        The flag, with proved dimensions.

    Raises
    ------
    BadSystem
        If the ring cannot hold the constraints (`Algebra`), if no rational point of it is found, or if the constraints
        contradict each other.

    Examples
    --------
    >>> from sympy import cos, sin, symbols
    >>> from chapsym.mechanics import System, dot
    >>> x, y, a = symbols("x y a")
    >>> edge = System("edge", (x, y, a), dot(x)**2 + dot(y)**2 + dot(a)**2, [cos(a) * dot(y) - sin(a) * dot(x)])
    >>> print(flag(edge))
    completely nonholonomic: the flag has the dimensions 2, 3 of 3
    >>> print(flag(System("pulled", (x, y), dot(x)**2 + dot(y)**2, [x * dot(x) + y * dot(y)])))
    integrable: the flag has the dimensions 1 of 2; 1 function of the coordinates stays constant
    """
    return spanned(a_system(system)).flag


#: The indices of two vectors, and the roots by which their bracket is multiplied.
Bracketed = tuple[int, int, sp.Expr]


@dataclass(frozen=True)
class Span:
    """The proof of a flag: rows A, of which those in `kept` are independent, and fields and brackets that span.

    `made` has the two vectors of each bracket; `inside` has brackets in the span of the others.
    """

    flag: Flag
    algebra: Algebra
    rows: sp.Matrix
    kept: Sequence[int]
    vectors: Vectors
    made: Sequence[Bracketed | None]
    inside: Sequence[tuple[Sequence[sp.Expr], Bracketed]]


@lru_cache(maxsize=8)
def spanned(system: System) -> Span:
    """A flag with its proof; as `flag`."""
    algebra = Algebra(system)
    with_time = any(not algebra.is_zero(b) for b in algebra.offsets)
    whole = algebra.rows.row_join(algebra.offsets) if with_time else algebra.rows
    rows, places = _whole(whole), whole[whole.rows - len(algebra.holonomic) :, :]  # these have no offsets
    bound = max(rank(places, point) for point in algebra.points)
    point = generic(rows, [point for point in algebra.points if rank(places, point) == bound])
    dimension = rows.cols - bound
    kept = pivots(rows.xreplace(point).T)
    for i in set(range(rows.rows)) - set(kept):
        if not _inside(rows.extract(kept, list(range(rows.cols))).tolist(), list(rows[i, :]), point, algebra):
            raise BadSystem(f"{system.name}: it is not decided whether constraint {i + 1} depends on the others")
    whole, rows = rows, rows.extract(kept, list(range(rows.cols)))
    fields = [algebra.normal(field) for field in kernel(rows, rows.xreplace(point))]
    if with_time and all(algebra.is_zero(field[-1]) for field in fields):
        raise BadSystem(f"{system.name}: the constraints contradict each other: no motion obeys them")
    span, newest, growth = list(fields), list(range(len(fields))), [len(fields)]
    made: list[Bracketed | None] = [None] * len(fields)
    inside = []
    while newest and len(span) < dimension:
        before, newest = newest, []
        for i, j in product(range(len(fields)), before):
            if size(e for vector in span for e in vector) > MOST_PARTS:
                raise BadSystem(f"{system.name}: the brackets of the velocities are too long to be decided")
            bracket, times = algebra.cleared(bracket_of(fields[i], span[j], algebra))
            larger = [*span, bracket]
            if rank(_matrix(larger), point) < len(larger):
                if _inside(span, bracket, point, algebra):
                    inside.append((bracket, (i, j, times)))
                    continue
                point = next((p for p in algebra.points if rank(_matrix(larger), p) == len(larger)), {})
                if not point:
                    raise BadSystem(f"{system.name}: it is not decided whether a bracket is in the span of others")
            newest = [*newest, len(span)]
            span, made = larger, [*made, (i, j, times)]
        growth += [len(span)] if newest else []
    minor = _matrix(span).extract(list(range(len(span))), pivots(_matrix(span).xreplace(point))) if span else sp.eye(0)
    condition = sp.factor(algebra.normal([determinant(minor)])[0])
    found = Flag(tuple(growth), tuple(map(tuple, fields)), condition, algebra.shown(point), dimension, with_time)
    return Span(found, algebra, whole, kept, span, made, inside)


def _whole(rows: sp.Matrix) -> sp.Matrix:
    """Rows times their denominators."""
    made = []
    for i in range(rows.rows):
        below = sp.lcm_list([sp.fraction(sp.together(e))[1] for e in rows[i, :]] or [sp.S.One])
        made.append([sp.cancel(sp.together(e) * below) for e in rows[i, :]])
    return sp.Matrix(rows.rows, rows.cols, [e for row in made for e in row])


def kernel(rows: sp.Matrix, at_point: sp.Matrix) -> list[list[sp.Expr]]:
    """Fields that span the velocities v with A v = 0, for independent rows A, by Cramer's rule."""
    columns = pivots(at_point)
    square = rows.extract(list(range(rows.rows)), columns)
    whole, inverse = determinant(square), adjugate(square)
    fields = []
    for j in (j for j in range(rows.cols) if j not in columns):
        field = [sp.S.Zero] * rows.cols
        field[j] = whole
        for i, value in zip(columns, -inverse * rows[:, j], strict=True):
            field[i] = value
        fields.append(field)
    return fields


def _matrix(vectors: Vectors) -> sp.Matrix:
    return sp.Matrix([list(v) for v in vectors])


def along(field: Sequence[sp.Expr], of: sp.Expr, algebra: Algebra) -> sp.Expr:
    """The derivative along a field; components beyond the coordinates are ignored."""
    q = algebra.system.coordinates
    return sum((f * algebra.letters.derivative(of, c) for f, c in zip(field, q, strict=False) if f != 0), sp.S.Zero)


def bracket_of(x: Sequence[sp.Expr], y: Sequence[sp.Expr], algebra: Algebra) -> list[sp.Expr]:
    """[X, Y] = (∂Y) X - (∂X) Y."""
    return [along(x, b, algebra) - along(y, a, algebra) for a, b in zip(x, y, strict=True)]


def _inside(span: Vectors, vector: Sequence[sp.Expr], point: Point, algebra: Algebra) -> bool:
    """Whether a vector is in a span wherever the minor that is not 0 at the point is not: by Kronecker's theorem, all
    minors that border it are 0."""
    columns, larger = pivots(_matrix(span).xreplace(point)), _matrix([*span, vector])
    for j in (j for j in range(larger.cols) if j not in columns):
        if not algebra.is_zero(determinant(larger.extract(list(range(larger.rows)), [*columns, j]))):
            return False
    return True
