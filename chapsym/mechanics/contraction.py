"""The effect of a step of a method on the volume that the exact motion keeps, by series from an exact state.

The steps are those of places and velocities that obey the constraints.  By the determinant of its derivatives, and by
the density at both ends, the logarithm of what a step multiplies a volume by is a series in its length.

What moves by inertia rests where the velocities are 0.  There a step of length h takes a place q and velocities s, by
fields X, to q + h X s and s + h b(s, s) up to h² s² and h² s³, with the b of the motion, as s counts times h.  To the
first order in s a density that it keeps is one that the motion keeps: if that keeps none, no step keeps a smooth one.
"""

from collections.abc import Callable, Sequence

import sympy as sp
from flint import fmpq, fmpq_mat, fmpq_series

from chapsym.numbers.precisions import flint_terms

from .methods import Scheme
from .series import Exact, Series, State, Undecided, _at, inverse, series
from .system import System

#: Why there is nothing to decide.
LEAVES = "its steps leave the constraints, on which the volume is"
REACTS = "its momenta have a reaction, too, of which the volume has none"


def has_volume(system: System, scheme: Scheme, kept: int) -> None:
    """Raises Undecided where steps are none of places and velocities that obey the constraints.

    Of these, `kept` are proved to hold after a step.  Momenta must count up to Aᵀc: the equations are the same with
    that and as much less of the multipliers.
    """
    n, multipliers = len(system.coordinates), [x for x in scheme.unknowns if x.name.startswith("lam ")]
    has_momenta = scheme.state[n] not in system.velocities
    if kept < len(system.holonomic) + (0 if has_momenta else system.rows.rows):
        raise Undecided(LEAVES)
    for e in (*scheme.residual, *scheme.after) if has_momenta else ():
        by_momenta = [sp.diff(e, p) for p in scheme.state[n:]]
        for row, x in zip(system.rows.tolist(), multipliers, strict=True):
            if sp.expand(sp.diff(e, x) - sum(map(sp.Mul, row, by_momenta), sp.S.Zero)) != 0:
                raise Undecided(REACTS)


def logarithm(
    exact: Exact, density: sp.Expr, by: Sequence[sp.Symbol], step: Callable[[State], tuple[State, object]], count: int
) -> Series:
    """`count` terms of the logarithm of the factor of a volume in a step, which is taken in twice as many terms.

    A step from a state that differs by the power `count` of its length has the derivatives in the terms beyond.
    """
    system, n, small = exact.system, exact.n, series(fmpq_series([0, 1]) ** count)
    final, _ = step(list(exact.state))
    values = [_at(x, 0) for x in exact.at(list(system.rows), exact.state)]
    rows = [values[n * i : n * (i + 1)] for i in range(exact.m)]
    of_places = rows[exact.m - len(system.holonomic) :]
    bound = _pivots(of_places)
    free, moving = [i for i in range(n) if i not in bound], [system.velocities.index(x) for x in by]
    near, q, v = list[State](), exact.state[:n], exact.state[n:]
    for one in _kernel(of_places, free):
        place = [x + small * d for x, d in zip(q, one, strict=True)]
        near.append(exact.velocities([*place, *exact.at(system.momenta, [*place, *v])])[0])
    near += [[*q, *(x + small * d for x, d in zip(v, one, strict=True))] for one in _kernel(rows, moving)]
    changes = [[x - y for x, y in zip(step(one)[0], final, strict=True)] for one in near]
    slopes = sp.Matrix([[sp.diff(c, system.coordinates[i]) for i in bound] for c in system.holonomic])
    with flint_terms(count):
        at, kept = range(count, 2 * count), (*free, *(n + j for j in moving))
        table = [[fmpq_series([_at(change[i], k) for k in at]) for change in changes] for i in kept]
        found = _log_determinant(table)
        for factor, power in {**density.as_powers_dict(), slopes.det(): -sp.S.One}.items():
            start, end = (series(exact.at([factor], at)[0]) for at in (exact.state, final))
            if start[0] == 0:
                raise Undecided("the density is not regular at the exact state")
            found += (end / start).log() * fmpq(power.p, power.q)
    return found


def _pivots(rows: Sequence[Sequence[fmpq]]) -> list[int]:
    """Columns that are independent."""
    if not rows:
        return []
    reduced, rank = fmpq_mat([list(row) for row in rows]).rref()
    return [next(j for j in range(len(rows[0])) if reduced[i, j] != 0) for i in range(rank)]


def _kernel(rows: Sequence[Sequence[fmpq]], free: Sequence[int]) -> list[list[fmpq]]:
    """Vectors x with A x = 0, each with 1 in the place of a free entry and 0 in those of the others."""
    bound = [i for i in range(len(rows) + len(free)) if i not in free]
    left = inverse(fmpq_mat([[row[i] for i in bound] for row in rows])) if rows else fmpq_mat(0, 0)
    found = []
    for j in free:
        one = [fmpq(int(i == j)) for i in range(len(bound) + len(free))]
        for i, k in enumerate(bound):
            one[k] = -sum((left[i, r] * row[j] for r, row in enumerate(rows)), fmpq(0))
        found.append(one)
    return found


def _log_determinant(rows: list[list[Series]]) -> Series:
    """The logarithm of a determinant; the matrix begins with 1 on its diagonal, and above it with 0."""
    found = fmpq_series([0])
    while rows:
        top, *below = rows
        found += top[0].log()
        rows = [[x - row[0] / top[0] * y for x, y in zip(row[1:], top[1:], strict=True)] for row in below]
    return found
