"""The exact verdicts on a system as claims, whose certificates the independent checker judges without chapsym.

The statements are equations between rational functions of coordinates, velocities and letters, with the numbers of the
parameters: those of sines, cosines and roots, whose relations are hypotheses.  Velocities that the constraints bind are
written by the others.  That something is the derivative of something is said as a limit, which is such an equation; that
a rank is reached, by a minor that is not 0 at a rational point.
"""

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import sympy as sp

from chapsym.derive import Quotient
from chapsym.prove import Claim, Comparison, Equation, Examples, Proof, Verdict, tends
from chapsym.prove.statements import Statement
from chapsym.prove.witness import true_at

from .algebra import Algebra, Point, adjugate, determinant, pivots
from .brackets import bracket_of, flag, spanned
from .density import MOST_LEVELS, Volume, volume
from .equations import OnShell
from .system import BadSystem, System

#: Letters of the name of a system in the id of a claim.
LETTERS = 22


@dataclass(frozen=True)
class Certified:
    """An exact verdict, with its certificate or why it has none.

    Attributes
    ----------
    verdict : str
        Of what it is: "motion", "energy", "dla: order".
    certificate : dict or None
        As `chapsym.prove` writes it, accepted by the checker.
    why : str
        Why there is none.
    """

    verdict: str
    certificate: Mapping[str, Any] | None = None
    why: str = ""


@dataclass(frozen=True)
class Case:
    """What a claim says, what proves it, and a false variant of that; premises are in words."""

    said: str
    printed: Sequence[Statement]
    control: Sequence[Statement]
    lemmas: Sequence[Statement] = ()
    premises: Sequence[str] = ()
    uses: Sequence[str] = ()

    def judged(self, verdict: str, id: str, points: Iterable[Point] = ()) -> Certified:
        """By its own proof, run now, and by the checker; at the first of some points where all of it has a value."""
        statements = [*self.printed, *self.lemmas]
        related = [one for one in statements if isinstance(one, Equation) and one.algebra.relations]

        def prove(p: Proof) -> None:
            places = sorted(points, key=lambda point: [*point.values()].count(sp.S.Zero))  # the poor ones last
            at = (x for x in places if _is_rational(x) and all(true_at(one, x) for one in related if _covers(x, one)))
            p.examples = Examples(numbers=next(at, {}))
            for text in self.premises:
                p.assume(text)
            p.lemma(*self.lemmas)
            p.printed(*self.printed)
            p.control(*self.control)
            for one in statements:
                if isinstance(one, Comparison):
                    p.witness("point", {x.name: str(v) for x, v in one.point.items()}, one)

        found = Claim(id, self.said, tuple(self.uses), prove).judge().certified()
        data, problems = found.certificate, found.proof.problems
        left = [one["text"] for one in data["sentences"] if one["role"] in ("printed", "lemma")] if data else []
        if data is None or data["verdict"] != Verdict.HOLDS or left:
            return Certified(verdict, None, next(iter([*problems, *left]), "it says nothing that is to be decided"))
        return Certified(verdict, data)


def _is_rational(point: Point) -> bool:
    return all(x.is_Rational for x in point.values())


def _covers(point: Point, one: Equation) -> bool:
    """Whether it has a value for each letter; other symbols are free."""
    return set().union(*(e.free_symbols for e in (*one.left, *one.right))) <= point.keys()


def name_of(system: System) -> str:
    """The beginning of the ids of its claims."""
    plain = re.sub(r"[^A-Za-z0-9]+", "-", system.name).strip("-")[:LETTERS].strip("-").lower()
    return plain or "system"


def rate_along(algebra: Algebra, of: sp.Expr, directions: Sequence[sp.Expr]) -> sp.Expr:
    """The derivative of an expression in letters along a change of coordinates, and of velocities."""
    pairs = zip((*algebra.system.coordinates, *algebra.system.velocities), directions, strict=False)
    return sum((algebra.letters.derivative(of, x) * d for x, d in pairs if d != 0), sp.S.Zero)


def slopes(
    algebra: Algebra, text: str, of: Sequence[tuple[sp.Expr, Sequence[sp.Expr]]], are: Sequence[sp.Expr]
) -> Equation:
    """That these are the derivatives of expressions, each along a direction, as a limit."""
    symbols = set().union(*(e.free_symbols for one, along in of for e in (one, *along)), *(e.free_symbols for e in are))
    taken = symbols | {*algebra.letters.meanings}
    small, changes = fresh("e", taken), []
    for one, along in of:
        by = {x: rate_along(algebra, x, along) for x in one.free_symbols}
        changes.append(one.xreplace({x: x + small * e for x, e in by.items() if e != 0}) - one)
    symbols = set().union({small}, *(e.free_symbols for e in (*changes, *are)))
    return tends(text, changes, small, 1, list(are), Quotient(sorted(symbols, key=str)))


def fresh(name: str, taken: Collection[sp.Symbol]) -> sp.Symbol:
    """A symbol that is none of some others."""
    while sp.Symbol(name) in taken:
        name += "_"
    return sp.Symbol(name)


class Moving(OnShell):
    """A system's equations with the Lagrangian, forces and further quantities in letters, solved for accelerations."""

    def __init__(self, system: System, *quantities: sp.Expr) -> None:
        forces = [system.forces.get(x, sp.S.Zero) for x in system.coordinates]
        super().__init__(system, system.lagrangian, system.energy, *forces, *quantities)
        self.system, n = system, len(system.coordinates)
        self.lagrangian, self.energy, *rest = self.more
        self.forces, self.quantities = rest[:n], rest[n:]
        self.q, self.v = system.coordinates, system.velocities
        self.momenta = [sp.diff(self.lagrangian, v) for v in self.v]
        self.bindings = list(self.algebra.rows * sp.Matrix(self.v) + self.algebra.offsets)  # A v + b
        taken = {*self.q, *self.v, *self.algebra.letters.meanings}
        self.change = [fresh(f"{x}_change", taken) for x in (*self.q, *self.v)]
        self.acceleration = [fresh(f"{x}_rate", taken) for x in self.v]
        self._rings: dict[tuple[sp.Symbol, ...], Quotient] = {}

    def ring(self, *expressions: sp.Expr) -> Quotient:
        """That of the system with further symbols of some expressions."""
        own = self.algebra.ring
        more = tuple(sorted(set().union(*(e.free_symbols for e in expressions)) - set(own.symbols), key=str))
        return self._rings.setdefault(more, Quotient((*own.symbols, *more), own.relations))

    def equal(self, text: str, left: Sequence[Any], right: Sequence[Any]) -> Equation:
        """Where the constraints hold."""
        sides = [[sp.sympify(e).xreplace(self.allowed) for e in side] for side in (left, right)]
        return Equation(text, *sides, self.ring(*sides[0], *sides[1]))

    def rate(self, of: sp.Expr, directions: Sequence[sp.Expr]) -> sp.Expr:
        """The derivative of an expression along a change of coordinates and velocities."""
        return rate_along(self.algebra, of, directions)

    @property
    def now(self) -> list[sp.Expr]:
        """The rates of coordinates and velocities, any acceleration."""
        return [*self.v, *self.acceleration]

    @cached_property
    def solved(self) -> tuple[list[sp.Expr], list[sp.Expr]]:
        """The accelerations, and the multipliers, of which those of dependent constraints are 0."""
        n, algebra = len(self.q), self.algebra
        x = sp.Matrix(self.fields).T if self.fields else sp.zeros(n, 0)
        below, inverse = determinant(self.square), adjugate(self.square)
        found = sp.zeros(n, 1)
        for i, value in zip(self.bound, inverse * self.turning.extract(self.kept, [0]), strict=True):
            found[i] = value / below
        if self.fields:
            inner, pushed = x.T * self.mass * x, x.T * (self.forced - self.mass * found)
            whole = determinant(inner)
            if algebra.is_zero(whole):
                raise BadSystem(
                    f"{self.system.name}: the mass matrix is singular, so that the motion is not determined"
                )
            found += x * (adjugate(inner) * pushed) / whole
        a = [algebra.ring.reduced(e.xreplace(self.allowed)) for e in found]
        lack = (self.mass * sp.Matrix(a) - self.forced).extract(self.bound, [0])
        held, multipliers = inverse.T * lack / below, [sp.S.Zero] * algebra.rows.rows
        for i, value in zip(self.kept, held, strict=True):
            multipliers[i] = algebra.ring.reduced(value.xreplace(self.allowed))
        return a, multipliers

    def in_motion(self, of: sp.Expr) -> sp.Expr:
        """The rate of an expression in the motion."""
        return self.rate(of, [*self.v, *self.solved[0]])

    @cached_property
    def premises(self) -> list[str]:
        """What the letters are."""
        meanings, bound = self.algebra.letters.meanings, ", ".join(map(str, self.allowed))
        return [
            *(f"{x} is {value}" for x, value in self.system.parameters.items()),
            *(f"{letter} is {stands}, and changes as that does" for letter, stands in meanings.items()),
            *([f"the constraints bind {bound}, which are written by the other velocities"] if bound else []),
        ]


def certified(system: System) -> Iterator[Certified]:
    """The exact verdicts on a system, each with its certificate or with why it has none.

    Parameters
    ----------
    system : System

    Yields
    ------
    Certified

    Examples
    --------
    >>> from sympy import symbols
    >>> from chapsym.mechanics import System, certified, dot
    >>> x, y, z = symbols("x y z")
    >>> particle = System("particle", (x, y, z), sum(dot(q) ** 2 for q in (x, y, z)) / 2, [dot(z) - y * dot(x)])
    >>> [(one.verdict, one.certificate["verdict"]) for one in certified(particle)]
    [('motion', 'holds'), ('energy', 'holds'), ('flag', 'holds'), ('volume', 'holds')]
    """
    name = name_of(system)
    makers: dict[str, Callable[[System, str], tuple[Case, Algebra]]] = {
        "motion": _motion, "energy": _energy, "flag": _flag, "volume": _volume
    }  # fmt: skip
    for verdict, made in makers.items():
        try:
            case, algebra = made(system, name)
        except (BadSystem, ArithmeticError, ValueError) as error:
            yield Certified(verdict, None, str(error).removeprefix(f"{system.name}: "))
        else:
            yield case.judged(verdict, f"{name}-{verdict}", algebra.points)


def _motion(system: System, _: str) -> tuple[Case, Algebra]:
    of = Moving(system)
    units = [[int(i == j) for j in range(2 * len(of.q))] for i in range(2 * len(of.q))]
    gradient = [of.rate(of.lagrangian, unit) for unit in units]
    rates = [of.rate(e, of.now) for e in (*of.momenta, *of.bindings)]
    accelerations, multipliers = of.solved
    held = list(of.algebra.rows.T * sp.Matrix(multipliers)) if multipliers else [sp.S.Zero] * len(of.q)

    def principle(text: str, by: Sequence[sp.Expr]) -> Equation:
        moved = [e.xreplace(dict(zip(of.acceleration, by, strict=True))) for e in rates]
        left = [p - f for p, f in zip(moved[: len(of.q)], gradient[: len(of.q)], strict=True)]
        right = [f + r for f, r in zip(of.forces, held, strict=True)]
        return of.equal(text, [*left, *moved[len(of.q) :]], [*right, *([sp.S.Zero] * len(of.bindings))])

    lemmas = [
        slopes(
            of.algebra, "the derivatives of L", [(of.lagrangian, of.change)], [sum(map(sp.Mul, gradient, of.change))]
        ),
        slopes(of.algebra, "d/dt of ∂L/∂v and of A v + b", [(e, of.now) for e in (*of.momenta, *of.bindings)], rates),
        *([of.equal("A v + b = 0", of.bindings, [sp.S.Zero] * len(of.bindings))] if of.bindings else []),
    ]
    said = r"\frac{d}{dt}\frac{\partial L}{\partial v} - \frac{\partial L}{\partial q} = A^T\lambda + F, A v + b = 0"
    wrong = principle(
        "the same with a first acceleration that is larger by 1", [accelerations[0] + 1, *accelerations[1:]]
    )
    return Case(said, [principle("the accelerations and the multipliers solve the equations", accelerations)], [wrong],
                lemmas, of.premises), of.algebra  # fmt: skip


def _kept(of: Moving, what: str, quantity: sp.Expr, rate: sp.Expr, name: str) -> Case:
    """What the rate of a quantity is in the motion."""
    lemma = slopes(of.algebra, f"d/dt of {what}", [(quantity, of.now)], [of.rate(quantity, of.now)])
    found = of.in_motion(quantity)
    text = f"the rate of {what} in the motion"
    return Case(text, [of.equal(text, [found], [rate])], [of.equal(f"{text}, larger by 1", [found], [rate + 1])],
                [lemma], of.premises, [f"{name}-motion"])  # fmt: skip


def _energy(system: System, name: str) -> tuple[Case, Algebra]:
    of = Moving(system)
    power = sum(map(sp.Mul, of.forces, of.v)) - sum(map(sp.Mul, of.algebra.offsets, of.solved[1]))
    return _kept(of, "the energy", of.energy, power, name), of.algebra


def _minor(vectors: Sequence[Sequence[sp.Expr]], points: Iterable[Point]) -> tuple[sp.Expr, Point, list[int]]:
    """A minor of all vectors, a rational point where it is not 0, and its columns."""
    matrix = sp.Matrix([list(one) for one in vectors])
    for point in filter(_is_rational, points):
        there = matrix.xreplace(point)
        if not there.has(sp.zoo, sp.nan) and not there.free_symbols and len(columns := pivots(there)) == matrix.rows:
            return determinant(matrix.extract(list(range(matrix.rows)), columns)), point, columns
    raise BadSystem("no rational point is found where the rank is what it is almost everywhere")


def _not_0(text: str, minor: sp.Expr, point: Point) -> Comparison:
    return Comparison(text, [sp.Ne(minor, 0, evaluate=False)], {x: point[x] for x in minor.free_symbols})


def _bordering(
    algebra: Algebra, text: str, vectors: Sequence[Any], columns: Sequence[int], more: Sequence[Any]
) -> Equation | None:
    """That the minors that border one are 0."""
    matrix = sp.Matrix([*map(list, vectors), list(more)])
    others = [j for j in range(matrix.cols) if j not in columns]
    minors = [determinant(matrix.extract(list(range(matrix.rows)), [*columns, j])) for j in others]
    minors = [e for e in minors if e != 0]
    return Equation(text, minors, [sp.S.Zero] * len(minors), algebra.ring) if minors else None


def _flag(system: System, _: str) -> tuple[Case, Algebra]:
    found = spanned(system)
    algebra, growth, vectors = found.algebra, found.flag.growth, found.vectors
    if not vectors:
        raise BadSystem("there is no velocity that the constraints allow")
    names = [f"X{i + 1}" for i in range(len(vectors))]
    lemmas, printed = list[Statement](), list[Statement]()
    if found.kept:
        rows = found.rows.extract(list(found.kept), list(range(found.rows.cols))).tolist()
        minor, point, columns = _minor(rows, algebra.points)
        lemmas.append(_not_0("constraints are independent: a minor of theirs is not 0 at a point", minor, point))
        more = (i for i in range(found.rows.rows) if i not in found.kept)
        made = (
            _bordering(algebra, f"constraint {i + 1} depends on the others", rows, columns, found.rows[i, :])
            for i in more
        )
        lemmas += [one for one in made if one]
        products = list(found.rows * sp.Matrix([list(x) for x in vectors[: growth[0]]]).T)
        lemmas.append(
            Equation(f"{', '.join(names[: growth[0]])} obey them", products, [sp.S.Zero] * len(products), algebra.ring)
        )
    lemmas += _brackets(algebra, dict(zip(names, vectors, strict=True)), [
        *((name, x, made) for name, x, made in zip(names, vectors, found.made, strict=True) if made),
        *((f"B{k + 1}", x, made) for k, (x, made) in enumerate(found.inside)),
    ])  # fmt: skip
    for size in growth:
        minor, point, columns = _minor(vectors[:size], algebra.points)
        printed.append(_not_0(f"{', '.join(names[:size])} span {size} dimensions at a point", minor, point))
    inside = (
        _bordering(algebra, f"B{k + 1} is in the span of {', '.join(names)}", vectors, columns, x)
        for k, (x, _) in enumerate(found.inside)
    )
    printed += [one for one in inside if one]
    wrong = Equation(f"{', '.join(names)} are dependent", [minor], [sp.S.Zero], algebra.ring)
    premises = [
        f"{letter} is {stands}, and changes as that does" for letter, stands in algebra.letters.meanings.items()
    ]
    return Case(f"{found.flag}", printed, [wrong], lemmas, premises), algebra


def _brackets(
    algebra: Algebra,
    known: Mapping[str, Sequence[sp.Expr]],
    made: Iterable[tuple[str, Sequence[sp.Expr], tuple[int, int, sp.Expr]]],
) -> Iterator[Statement]:
    """That vectors are brackets of known ones, but for those that are 0."""
    for name, bracket, (i, j, times) in made:
        if any(bracket):
            (one, x), (other, y) = ([*known.items()][k] for k in (i, j))
            along = [(e, x) for e in y], [(e, y) for e in x]
            parts = [[rate_along(algebra, *e) for e in part] for part in along]
            of = [*along[0], *along[1]]
            yield slopes(
                algebra,
                f"the derivatives of {other} along {one}, and of {one} along {other}",
                of,
                [*parts[0], *parts[1]],
            )
            by = f"{times} " if times != 1 else ""
            sides = [times * (a - b) for a, b in zip(*parts, strict=True)], list(bracket)
            yield Equation(f"{name} = {by}[{one}, {other}]", *sides, algebra.ring)


def _volume(system: System, name: str) -> tuple[Case, Algebra]:
    kept = volume(system)
    if not kept.by:
        raise BadSystem("nothing moves")
    factors = list(kept.density.as_powers_dict().items()) if kept.kept else []
    of = Moving(system, *(factor for factor, _ in factors))
    variables, units = (*of.q, *of.v), sp.eye(2 * len(of.q)).tolist()
    field = [v.xreplace(of.allowed) for v in of.v] + of.solved[0]
    own = [(e, unit) for x, e, unit in zip(variables, field, units, strict=True) if x in {*of.q, *kept.by}]
    spread = [of.rate(*one) for one in own]
    text = f"the divergence of the motion in {', '.join(map(str, (*of.q, *kept.by)))}"
    lemmas = [
        slopes(of.algebra, "the derivatives of each component of the motion by what it is the rate of", own, spread)
    ]
    uses = [f"{name}-motion"]
    if not kept.kept:
        printed, control, more = _no_volume(of, kept, sum(spread))
        return Case(f"{kept}", printed, [control], [*lemmas, *more], of.premises, [*uses, f"{name}-flag"]), of.algebra
    rate = sum((power * of.in_motion(e) / e for e, (_, power) in zip(of.quantities, factors, strict=True)), sp.S.Zero)
    text += f" is less the rate of the logarithm of {kept.density}"
    printed = [of.equal(text, [sum(spread)], [-rate])]
    if not any(spread) and rate == 0:  # which is seen
        change = [c if x in {*of.q, *kept.by} else sp.S.Zero for x, c in zip(variables, of.change, strict=True)]
        along = [(e, change) for e, _ in own]
        printed.append(slopes(of.algebra, "all derivatives", along, [of.rate(*one) for one in along]))
    wrong = of.equal("the same with a rate that is larger by 1", [sum(spread)], [-1 - rate])
    return Case(text, printed, [wrong], lemmas if any(spread) else [], of.premises, uses), of.algebra


def _no_volume(of: Moving, kept: Volume, spread: sp.Expr) -> tuple[list[Statement], Statement, list[Statement]]:
    """Brackets of the fields with their divergences span more than those of the fields."""
    reduced, most = of.algebra.ring.reduced, flag(of.system).growth[-1]
    velocities = [v.xreplace(of.allowed) for v in of.v]
    fields = {
        f"X{i + 1}": [*(reduced(sp.diff(e, v)) for e in velocities), -reduced(sp.diff(spread, v))]
        for i, v in enumerate(kept.by)
    }
    whole = sp.Matrix(list(fields.values())).T * sp.Matrix(kept.by)
    lemmas = [of.equal("velocities and divergence, by the fields and less theirs", [*velocities, -spread], list(whole))]
    made, names = list[Any](), [*fields]
    for level in range(MOST_LEVELS):
        newest = names[:] if level == 0 else newer
        newer = []
        for a, b in (
            (a, b) for i, a in enumerate([*fields][: len(kept.by)]) for j, b in enumerate(newest) if level or i < j
        ):
            bracket = list(map(reduced, bracket_of(fields[a], fields[b], of.algebra)))
            if any(bracket):
                newer.append(f"[{a}, {b}]")
                made.append((newer[-1], bracket, (names.index(a), names.index(b), sp.S.One)))
                names.append(newer[-1])
                fields[newer[-1]] = bracket
        for point in filter(_is_rational, of.algebra.points):
            there = sp.Matrix(list(fields.values())).xreplace(point)
            if there.has(sp.zoo, sp.nan) or there.free_symbols or len(rows := pivots(there.T)) <= most:
                continue
            rows = rows[: most + 1]
            minor, point, _ = _minor([fields[names[i]] for i in rows], [point])
            lemmas += _brackets(of.algebra, fields, made)
            text = f"{', '.join(names[i] for i in rows)} span {most + 1} dimensions at a point"
            return [_not_0(text, minor, point)], Equation("they do not", [minor], [sp.S.Zero], of.algebra.ring), lemmas
    raise BadSystem("no rational point is found where the brackets span more")
