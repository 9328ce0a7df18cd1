"""Whether the exact motion of a system keeps a smooth volume, exactly.

Fields X₁, ... span the velocities that the constraints allow, v = Σ sⱼ Xⱼ, and p = ∂L/∂s are their momenta.  In (q, p)
the divergence of the motion is Σ θⱼ sⱼ with

    θⱼ = div Xⱼ + tr(m⁻¹ Wⱼ),  m = ⟨X, M X⟩,  (Wⱼ)ₗᵢ = ⟨Xₗ, M [Xⱼ, Xᵢ]⟩,

as ṗᵢ = Xᵢ L - ⟨∂L/∂v, [Xᵢ, Xⱼ]⟩ sⱼ, where forces do not depend on velocities.  A volume with the density exp f(q) is
kept if Xⱼ f = -θⱼ for all j.  For exp f products of powers of the denominators of θⱼ and m⁻¹ are tried.  There is none
if the fields Xⱼ - θⱼ ∂/∂f, in q and f, span with their brackets more dimensions than Xⱼ with theirs: they would be
tangent to the graph of f.

Without forces, there is no smooth density exp f(q, p) either: by the terms of first order in p of the equation for f(q,
p), exp f(q, 0) is kept.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache, partial, reduce
from operator import mul

import numpy as np
import sympy as sp
from flint import arb

from chapsym.numbers.precisions import flint_bits

from .algebra import Algebra, Point, Vectors, adjugate, determinant, factors_of, size
from .brackets import along, bracket_of, flag
from .equations import OnShell
from .series import evaluated
from .system import BadSystem, System, a_system

#: The largest denominator of the powers in a density, the depth of brackets, and the bits of balls.
BELOW, MOST_LEVELS, BITS = 12, 3, 400
#: Beyond this number of different parts no further brackets are computed, and divergences are not reduced.
MOST_PARTS = 1000
#: The tolerance of a numerical rank.
NEAR = 1e-9


@dataclass(frozen=True)
class Volume:
    """Whether the exact motion keeps a smooth volume.

    Attributes
    ----------
    density : sympy.Expr or None
        A density in the coordinates and the velocities in `by` that is proved to be kept; with holonomic constraints φ
        on the coordinates, of the measure dq/dφ on them.  It is a product of powers of absolute values of functions; if
        all of these are finite and not 0 the density is smooth and positive: near almost every position of the
        component of the point.  If None, it is proved that no density that depends only on the position is kept, near
        the point and almost every position of its component.
    by : tuple of sympy.Symbol
        The velocities that determine the others.
    at_all : bool
        If density is None: whether no smooth density of position and velocity, rest included, is kept either; proved
        for systems without forces.
    point : mapping of str to str
        An exact position, with sines and cosines instead of angles.
    """

    density: sp.Expr | None = None
    by: tuple[sp.Symbol, ...] = ()
    at_all: bool = False
    point: Mapping[str, str] = field(default_factory=dict)

    @property
    def kept(self) -> bool:
        """Whether a smooth volume is kept."""
        return self.density is not None

    def __str__(self) -> str:
        if self.kept:
            return "keeps a smooth volume"
        return "keeps no smooth volume" if self.at_all else "keeps no volume whose density depends on the place alone"


def volume(system: System) -> Volume:
    """Whether the exact motion of a system, with its numbers, keeps a smooth volume, decided exactly.

    Parameters
    ----------
    system : System
        The system, with constraints that are linear in the velocities, and forces that do not depend on velocities.

    Returns
    -------
    Volume

    Raises
    ------
    BadSystem
        As `flag` does; for other constraints and forces; and if no decision is found.

    References
    ----------
    Y. Fedorov, L. García-Naranjo, J. C. Marrero, J. Nonlinear Sci. 25 (2015) 203: densities of the position suffice for
    inertial motion.

    Examples
    --------
    >>> from sympy import cos, sin, symbols
    >>> from chapsym.mechanics import System, dot, volume
    >>> x, y, a = symbols("x y a")
    >>> def sleigh(ahead):  # of which the centre of mass is ahead of the blade
    ...     centre = dot(x) - ahead * sin(a) * dot(a), dot(y) + ahead * cos(a) * dot(a)
    ...     energy = (centre[0] ** 2 + centre[1] ** 2 + dot(a) ** 2) / 2
    ...     return System("sleigh", (x, y, a), energy, [sin(a) * dot(x) - cos(a) * dot(y)])
    >>> print(volume(sleigh(1)))
    keeps no smooth volume
    >>> found = volume(sleigh(0))
    >>> print(found, found.density, found.by)
    keeps a smooth volume 1/sin(a) (y_dot, a_dot)
    """
    try:
        return _decided(a_system(system), system.digest())
    except BadSystem:
        raise
    except ValueError:  # of numbers with more digits than Python writes
        raise BadSystem(f"{system.name}: numbers are too long for a volume to be decided") from None


@lru_cache(maxsize=8)
def _decided(system: System, digest: str) -> Volume:
    """The volume of a system in its present state, shared by the verdicts on all methods."""
    q, v = system.coordinates, system.velocities
    if any(sp.expand(b) != 0 for b in system.offsets):
        raise BadSystem(f"{system.name}: volumes are for constraints that are linear in the velocities")
    if any(f.free_symbols & set(v) for f in system.forces.values()):
        raise BadSystem(f"{system.name}: volumes are for forces that do not depend on velocities")
    of = OnShell(system)
    algebra, reduced = of.algebra, of.algebra.ring.reduced
    if not set(range(len(system.constraints), len(system.rows[:, 0]))) <= set(of.kept):
        raise BadSystem(f"{system.name}: volumes are for holonomic constraints that are independent of the others")
    if not (by := tuple(x for i, x in enumerate(v) if i not in of.bound)):
        return Volume(sp.S.One)
    whole, (fields, spread, below, _) = reduced(determinant(of.square)), divergences(of)
    if below == 0:
        raise BadSystem(f"{system.name}: the mass matrix is singular, so that the motion is not determined")
    lifted = (below, 1), (whole, -len(by))  # dq dp is the product of these powers times dq dv, v in `by`
    turned = [e - sum(n * along(one, p, algebra) / p for p, n in lifted) for one, e in zip(fields, spread, strict=True)]
    candidates = {p for e in (whole, below, *spread) for p in sp.fraction(e)}
    if (density := _density(fields, turned, candidates, algebra)) is not None:
        point = next((p for p, at in _places(algebra) if _rank(at(fields)) == len(by) and _rank(at([[below]]))), None)
        if point is None:
            raise BadSystem(f"{system.name}: no exact place is found where the equations are regular")
        for letter, stands in reversed(algebra.letters.meanings.items()):
            density = density.xreplace({letter: stands})
        return Volume(density, by, point=algebra.shown(point))
    span = flag(system)
    may_differ = len(algebra.holonomic) > 1 or any(e.free_symbols - set(q) for e in algebra.holonomic)
    if span.functions and may_differ:  # by components, of which there may be several
        raise BadSystem(f"{system.name}: the span of the brackets may differ between components of the configurations")
    if not (point := _refuted(fields, spread, span.growth[-1], algebra)):
        clause = "none is found, and no proof that there is none"
        raise BadSystem(f"{system.name}: it is not decided whether a volume is kept: {clause}")
    at_rest = dict.fromkeys(v, sp.S.Zero)
    push = [algebra.into(e.xreplace(at_rest)) for e in system.push]
    drives = any(p.xreplace(at_rest) != 0 for p in system.momenta) or any(
        not algebra.is_zero(sum(map(mul, one, push), sp.S.Zero)) for one in fields
    )
    return Volume(None, by, not drives, algebra.shown(point))


def divergences(of: OnShell) -> tuple[list[list[sp.Expr]], list[sp.Expr], sp.Expr, list[sp.Expr]]:
    """The fields X, the θ of each, det m, and the θ as they are formed; no θ where det m is 0."""
    algebra, reduced, (x, _, inner, _) = of.algebra, of.algebra.ring.reduced, of.along
    inner = inner.applyfunc(reduced)
    inverse, below = adjugate(inner), reduced(determinant(inner))
    formed = list[sp.Expr]()
    for one in of.fields if below != 0 else ():
        brackets = sp.Matrix([bracket_of(one, other, algebra) for other in of.fields]).T
        pushed = (inverse * (x.T * of.mass * brackets).applyfunc(reduced)).trace() / below
        own = (algebra.letters.derivative(e, c) for e, c in zip(one, algebra.system.coordinates, strict=True))
        formed.append(sum(own, pushed))
        if size(formed) > MOST_PARTS:
            raise BadSystem(f"{algebra.system.name}: how its velocities diverge is too long to be decided")
    return [list(map(reduced, one)) for one in of.fields], list(map(reduced, formed)), below, formed


def _density(fields: Vectors, spread: Sequence[sp.Expr], parts: Iterable[sp.Expr], algebra: Algebra) -> sp.Expr | None:
    """A product of powers of some polynomials and their factors whose derivative by each field is -θ times it."""
    parts = {p for e in parts for p in (e, *factors_of(e))}
    factors = sorted((p for p in parts if p.free_symbols), key=lambda p: (p.count_ops(), str(p)))
    rates = [[along(one, p, algebra) / p for p in factors] for one in fields]
    table = [[*own, aim] for own, aim in zip(rates, spread, strict=True)]
    rows = [row for _, at in _places(algebra) for row in at(table)]
    if not (scaled := [_scaled(row) for row in rows if all(x.is_finite() for x in row)]):
        return None
    numbers = np.array(scaled)
    sizes = np.linalg.norm(numbers[:, :-1], axis=0)
    numbers[:, :-1] /= np.where(sizes > 0, sizes, 1)
    kept = list[int]()  # as cos² - 1 is -sin²
    for i in range(len(factors)):
        if np.linalg.matrix_rank(numbers[:, [*kept, i]], tol=NEAR * len(numbers)) > len(kept):
            kept.append(i)
    found = np.linalg.lstsq(numbers[:, kept], -numbers[:, -1])[0]
    if np.abs(numbers[:, kept] @ found + numbers[:, -1]).max() > NEAR * np.abs(numbers).max():
        return None
    found = found / sizes[kept]
    powers = {i: sp.Rational(Fraction(float(x)).limit_denominator(BELOW)) for i, x in zip(kept, found, strict=True)}
    for row in table:
        if not algebra.is_zero(sum((a * row[i] for i, a in powers.items()), row[-1])):
            return None
    return sp.Mul(*(factors[i] ** a for i, a in powers.items()))


def _scaled(row: Sequence[arb]) -> list[float]:
    """Numbers over the largest of them."""
    with flint_bits(BITS):
        largest = reduce(lambda x, y: x.max(y), map(abs, row))
        return [float(x / largest) if largest > 0 else 0.0 for x in row]


def _refuted(fields: Vectors, spread: Sequence[sp.Expr], dimension: int, algebra: Algebra) -> Point | None:
    """A point where brackets of the fields with -θ span more than a dimension, proved in balls, if one is found."""
    extended = [[*one, -aim] for one, aim in zip(fields, spread, strict=True)]
    span, newest = list(extended), list(extended)
    for level in range(MOST_LEVELS):
        if size(e for one in newest for e in one) > MOST_PARTS:
            return None
        pairs = [(a, b) for i, a in enumerate(extended) for j, b in enumerate(newest) if level or i < j]
        newest = [bracket_of(a, b, algebra) for a, b in pairs]
        span += newest
        for point, at in _places(algebra):
            if _rank(at(span)) > dimension:
                return point
    return None


def _places(algebra: Algebra) -> Iterator[tuple[Point, Callable[[Vectors], list[list[arb]]]]]:
    """Exact points, and what gives rows of expressions there, in balls; those that divide by 0 there are not finite."""

    def ball(above: int, below: int) -> arb:
        return arb(int(above)) / int(below)

    def at(point: Point, rows: Vectors) -> list[list[arb]]:
        with flint_bits(BITS):
            values = {x: ball(*(y**2).as_numer_denom()).sqrt() * int(sp.sign(y)) for x, y in point.items()}
            found = iter(evaluated([e for row in rows for e in row], values, ball))
            return [[next(found) for _ in row] for row in rows]

    for point in algebra.points:
        place = {x: y for x, y in point.items() if x not in algebra.system.velocities}
        yield place, partial(at, place)


def _rank(rows: list[list[arb]]) -> int:
    """At least that of matrices in balls: how many pivots exclude 0."""
    found = 0
    for column in range(len(rows[0])):
        if rest := [row for row in rows[found:] if not row[column].contains(0)]:
            pivot = max(rest, key=lambda row: float(abs(row[column]).lower()))
            others = [row for row in rows[found:] if row is not pivot]
            reduced = [[x - row[column] / pivot[column] * y for x, y in zip(row, pivot, strict=True)] for row in others]
            rows = [*rows[:found], pivot, *reduced]
            found += 1
    return found
