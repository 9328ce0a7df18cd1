"""The properties of a method on a system, proved or refuted: its order, its symmetries, its conserved quantities.

The series of a step in its length h from an exact state (`series`) refutes a statement: if a coefficient is not 0
there, the statement is wrong for all small h.  Equations prove it: the expression that should vanish is a combination,
with rational numbers and possibly unknowns as factors, of expressions that the method, the constraints and the motion
set to 0.  A statement that is neither proved nor refuted stays measured.

Momenta of a method are defined up to the reactions Aᵀc: the velocity v of a state (q, p) satisfies p = ∂L/∂v + Aᵀc and
A v + b = 0.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property, lru_cache, partial
from itertools import islice, product
from operator import mul
from typing import Literal, TypeVar

import sympy as sp
from flint import fmpq, fmpq_mat, fmpq_series, nmod, nmod_mat

from chapsym.derive import Quotient
from chapsym.numbers import brief, is_a
from chapsym.numbers.precisions import flint_terms

from .algebra import Letters, size
from .contraction import has_volume, logarithm
from .density import Volume, volume
from .methods import Scheme
from .series import Exact, Series, State, Stepped, Undecided, _at, by_parts, evaluated, inverse, replaced
from .system import STEP, BadSystem, System, a_system, rate

#: The prime for the search of combinations, and the largest denominator and numerator of their factors.
PRIME, BELOW, ABOVE = 2**61 - 1, 24, 10_000
#: The largest number of operations in the expressions of a proof, and of combined equations; beyond, it stays measured.
MOST_OPERATIONS, MOST_KNOWN = 100_000, 400
MOST_CHOICES = 64
#: The number of computed coefficients of a series, for methods with equations of a step and for explicit ones, whose
#: order is higher; and further terms, as the last terms are not those of a step.
LOOKED, LOOKED_FURTHER, BEYOND = 6, 7, 2
#: The same for a volume, at first, and if these show nothing.
LOOKED_AT_VOLUMES = 4, 7
VOLUMES = "the volume", "a smooth volume"
Named = tuple[sp.Matrix, list[fmpq]]


@dataclass(frozen=True)
class Verdict:
    """The verdict on a property of a method for a system.

    Attributes
    ----------
    verdict : str
        "proved", "false", or "measured" if neither is decided: then there is only the measurement of the lab.
    said : str
        The proved order, the error and its place, or the undecided statement.
    point : mapping of str to str
        The exact coordinates and velocities at which it is false.
    """

    verdict: Literal["proved", "false", "measured"]
    said: str = ""
    point: Mapping[str, str] = field(default_factory=dict)


def verdicts(system: System, scheme: Scheme) -> dict[str, Verdict]:
    """The verdicts on a method for a system, with its numbers.

    Parameters
    ----------
    system : System
    scheme : Scheme
        For example `METHODS[name].scheme(system)`.

    Returns
    -------
    dict
        {name: Verdict}, with the names "order", "self-adjoint", "reversible", and "keeps " followed by the name of a
        quantity that the exact motion keeps; for volumes "keeps the volume" of the motion, or "keeps a smooth volume"
        if the motion keeps none.

    Examples
    --------
    >>> from sympy import symbols
    >>> from chapsym.mechanics import METHODS, System, dot, verdicts
    >>> x, y, z = symbols("x y z")
    >>> particle = System("particle", (x, y, z), sum(dot(q) ** 2 for q in (x, y, z)) / 2, [dot(z) - y * dot(x)])
    >>> found = verdicts(particle, METHODS["dla"].scheme(particle))
    >>> found["order"].said, found["self-adjoint"].verdict, found["keeps the energy"].verdict
    ('2', 'proved', 'false')
    """
    if not is_a(scheme, Scheme):
        raise BadSystem(f"scheme must be the scheme of a method, METHODS[name].scheme(system), not {brief(scheme)}")
    if tuple(scheme.state[: len(a_system(system).coordinates)]) != tuple(system.coordinates):
        raise BadSystem(f"scheme has other coordinates than {system.name}: take METHODS[name].scheme(system)")
    return {name: one.verdict for name, one in decided(a_system(system), scheme).items()}


@dataclass(frozen=True)
class Combination:
    """Expressions as combinations of expressions that equations set to 0: an identity under the relations.

    `right` has the factors with their expressions; `meanings` those of letters, and `ends` those of symbols for the end
    of a step.
    """

    left: list[sp.Expr]
    right: list[list[tuple[sp.Expr, sp.Expr]]]
    relations: Sequence[sp.Expr]
    meanings: Mapping[sp.Symbol, sp.Expr]
    ends: Mapping[sp.Symbol, sp.Expr] = field(default_factory=dict)


#: Combinations, of what is done or plainly of what comes out of it.
Proof = Callable[[bool], list[Combination]]
#: The coefficients of 1, h and h² of an expression in the length of a step.
Powers = tuple[sp.Expr, sp.Expr, sp.Expr]
T = TypeVar("T")
#: Expressions, with how many of their first coefficients in the length of a step are combined; and symbols for ends.
Shown = tuple[Sequence[tuple[sp.Expr, int]], Mapping[sp.Symbol, sp.Expr]]
Show = Callable[[Callable[..., sp.Expr]], Shown]


@dataclass(frozen=True)
class Decided:
    """A verdict with the combinations that prove it, or the series that refute it, by a power of h.

    Combinations are of what is done, or plainly of what comes out of it.
    """

    verdict: Verdict
    proofs: Sequence[Proof] = ()
    judged: "Judged | None" = None
    by: int = 0


def decided(system: System, scheme: Scheme) -> dict[str, Decided]:
    """The verdicts of `verdicts`, with their proofs."""
    quantities = quantities_of(system, scheme.integrals)
    names = ["order", "self-adjoint", "reversible", *(f"keeps {name}" for name in quantities)]
    kept = _volume(system, system.digest())
    names += [f"keeps {VOLUMES[not kept.kept]}"] if kept else []
    looked = LOOKED_FURTHER if scheme.stages else LOOKED
    with flint_terms(looked + BEYOND):
        try:
            judged = Judged(_exact(system, system.digest()), scheme, looked)
        except (Undecided, BadSystem) as error:
            return dict.fromkeys(names, Decided(Verdict("measured", str(error))))
        adjoint = judged.decided(judged.returns, -1)
        found = [judged.decided(judged.order, adjoint.verdict.verdict == "proved"), adjoint]
        found += [judged.decided(judged.returns, 1)]
        found += [judged.decided(judged.keeps, quantity) for quantity in quantities.values()]
        is_consistent = found[0].verdict.verdict == "proved" or "at least" in found[0].verdict.said
        found += [judged.decided(judged.keeps_volume, (kept, is_consistent))] if kept else []
    return dict(zip(names, found, strict=True))


@lru_cache(maxsize=8)
def _exact(system: System, digest: str) -> Exact:
    """A system in its present state, whose motion all methods share."""
    return Exact(system)


@lru_cache(maxsize=8)
def _volume(system: System, digest: str) -> Volume | None:
    """The volume that its exact motion keeps, or that it keeps none; None where that is not decided."""
    with suppress(BadSystem):
        found = volume(system)
        return found if found.by else None
    return None


def quantities_of(system: System, of_method: Mapping[str, sp.Expr]) -> dict[str, sp.Expr]:
    """Candidates for conserved quantities: energy, momenta without a force, those of the system and of the method."""
    found = {"the energy": system.energy} if system.keeps_energy else {}
    for i, (x, p) in enumerate(zip(system.coordinates, system.momenta, strict=True)):
        if system.push[i] == 0 and not any(system.rows[:, i]):
            found[f"the momentum of {x}"] = p
    named = {**system.integrals, **of_method}
    if taken := {*found, *VOLUMES} & named.keys():
        raise BadSystem(f"{system.name}: {min(taken)} is a quantity of every system: give the integral another name")
    return found | named


class Judged:
    """A method for a system, with a step in symbols and as series from an exact state."""

    def __init__(self, exact: Exact, scheme: Scheme, looked: int) -> None:
        self.system, self.scheme, self.exact, self.looked = exact.system, scheme, exact, looked
        self.n, self.state = exact.n, exact.state
        self.h: Series = fmpq_series([0, 1])
        self.proofs, self.proofs_of_always, self.power = list[Proof](), list[Proof](), 0
        if size(scheme.residual) * len(scheme.unknowns) > MOST_OPERATIONS:
            raise Undecided("a step has more operations than its series may have")
        self.stepped = Stepped(exact, scheme)
        self.blocks: dict[str, list[int]] = {}
        for i, x in enumerate(scheme.unknowns):
            self.blocks.setdefault(x.name.rsplit(" ", 1)[0], []).append(i)
        self.reacting = [scheme.unknowns[i] for i in self.blocks.get("lam", [])]
        rows = self.system.rows.T * sp.Matrix(self.reacting) if self.reacting else sp.zeros(self.n, 1)
        #: Momenta after the reaction at the place, by the state and the first multipliers.
        self.kicked = [*scheme.state[: self.n], *(p + x for p, x in zip(scheme.state[self.n :], rows, strict=True))]

    def decided(self, judge: Callable[[T], Verdict], of: T) -> Decided:
        """The verdict of one of the judges below, with its findings."""
        self.proofs, self.power = list[Proof](), 0
        try:
            verdict = judge(of)
        except (Undecided, BadSystem, sp.PolynomialError) as error:
            return Decided(Verdict("measured", str(error)))
        return Decided(verdict, [*self.proofs_of_always, *self.proofs], self, self.power)

    @cached_property
    def forth(self) -> tuple[State, State, State, State]:
        """A state of the method and the next one, their unknowns."""
        first, guess = self.stepped.first(self.state)
        there, z = self.stepped.step(first, guess, self.h)
        return first, there, z, self.stepped.solved(there, z, self.h)

    def wrong(self, what: str, *pairs: tuple[str, Series, Series]) -> Verdict | None:
        """The first power at which some series differ, if any."""
        for k in range(self.looked):
            for name, one, other in pairs:
                if (by := _at(one, k) - _at(other, k)) != 0:
                    self.power = k
                    return Verdict("false", f"{what} {name} by {by} h^{k}", self.exact.shown)
        return None

    def order(self, adjoint: bool) -> Verdict:
        """The order of the local error in position and velocity, less one; false if a step departs from the motion."""
        final = self.after(self.state, self.reactions)[0]
        pairs = list(zip(map(str, self.exact.symbols), final, self.exact.moved, strict=True))
        looked = 4 if self.reactions else self.looked  # c₃ is unknown
        most = next((k - 1 for k in range(looked) if any(_at(x, k) != _at(y, k) for _, x, y in pairs)), self.looked)
        if most < 1 and (wrong := self.wrong("a step of the exact motion differs in", *pairs)):
            return wrong
        least = 0
        if self.is_consistent():  # of an explicit method the tableau says more, of another the symmetry
            least = _of_tableau(self.scheme.stages) if self.scheme.stages else 1 + adjoint
        if least == most:
            return Verdict("proved", str(least))
        bounds = [f"at least {least}"] * (least > 0) + [f"at most {most}"] * (most < self.looked)
        return Verdict("measured", ", ".join(bounds))

    def reacted(self, state: State, reaction: Sequence[Series]) -> State:
        """The state of the method at a position and velocity, with Aᵀc added to the momenta."""
        start, _ = self.stepped.first(state)
        of = dict(zip((*self.scheme.state, *self.reacting), (*start, *reaction), strict=False))
        return evaluated(self.exact.read(self.kicked), of) if reaction else start

    def after(self, state: State, reaction: Sequence[Series]) -> tuple[State, list[Series]]:
        """Position and velocity after a step from this state, and the c of the next state."""
        final, _ = self.stepped.step(self.reacted(state, reaction), self.stepped.first(self.state)[1], self.h)
        return self.exact.velocities(final, self.stepped.has_momenta)

    @cached_property
    def reactions(self) -> list[Series]:
        """The c = h c₁ + h² c₂ of momenta that move on smoothly, without oscillations from step to step.

        If momenta have Aᵀc more, the next have Aᵀκc more; where κ is not 1, c(x(h)) = κ c(x) + ... determines c.
        """
        m = self.exact.m
        if not self.stepped.has_momenta or not m:
            return []
        if not self.reacting:
            raise Undecided("no multipliers of the reaction are found")
        units = [[fmpq(i == j) for i in range(m)] for j in range(m)]
        none, small = [fmpq(0)] * m, self.h**3
        bare = self.after(self.state, none)[1]
        kept = [[_at(x, 0) for x in self.after(self.state, one)[1]] for one in units]
        left = inverse(fmpq_mat([[(i == j) - kept[j][i] for j in range(m)] for i in range(m)]))
        rates = [x.derivative()[0] for x in self.exact.moved]
        later = self.after([x + small * r for x, r in zip(self.state, rates, strict=True)], none)[1]

        def settled(of: Sequence[fmpq]) -> list[fmpq]:
            return [sum((left[i, j] * x for j, x in enumerate(of)), fmpq(0)) for i in range(m)]

        first = settled([_at(x, 1) for x in bare])
        turning = settled([_at(x, 4) - _at(y, 4) for x, y in zip(later, bare, strict=True)])  # the rate of c₁
        normal = self.after(self.state, [self.h * x for x in first])[1]
        second = settled([_at(x, 2) - r for x, r in zip(normal, turning, strict=True)])
        return [self.h * x + self.h**2 * y for x, y in zip(first, second, strict=True)]

    def is_consistent(self) -> bool:
        """Whether the equations are those of the motion in their first powers of h, at any state.

        Unknowns begin as velocities, accelerations or reactions.  What they change by is guessed at the exact state: a
        sum of halves of the vectors that `vectors` lists; and so are the momenta that move on smoothly.
        """
        scheme, n, system = self.scheme, self.n, self.system
        start = self.reacted(self.state, self.reactions)
        unknowns = self.stepped.solved(start, self.stepped.first(self.state)[1], self.h)
        shift, (known, changes, forces) = self.stepped.shift, self.vectors
        v, put, is_moving = sp.Matrix(system.velocities), dict[sp.Symbol, sp.Expr](), False
        for name, block in self.blocks.items():
            begin, then = ([_at(unknowns[i], k) for i in block] for k in (0, 1))
            found, change = v, sp.zeros(len(block), 1)
            if name in ("lam", "mu"):
                found = _guessed(begin, forces[:2])
                change = change if found is None or any(found) else _guessed(then, forces)
            elif begin == self.state[n:]:
                is_moving, change = True, _guessed(then, changes)
            else:
                found = _guessed(begin, changes[:1])
            if found is None or change is None:
                return False
            put |= {scheme.unknowns[i]: x + STEP * y for i, x, y in zip(block, found, change, strict=True)}
        p, goal = v, changes[0][0]
        if self.stepped.has_momenta:
            held = sp.zeros(n, 1)
            if self.reactions:
                if (smooth := _guessed([_at(x, 1) for x in self.reactions], forces)) is None:
                    return False
                held = system.rows.T * smooth
            p = sp.Matrix(system.momenta) + STEP * held
            goal = rate(sp.Matrix(system.momenta), system.coordinates) + system.mass * goal + held
            put |= dict(zip(scheme.state[n:], p, strict=True))
        residual, after = replaced(scheme.residual, put), replaced(scheme.after, put)
        if scheme.stages:
            return after == [*v, *goal] and self.spanned(residual, known)
        counts = [late + (2 if is_moving else 1) for late in shift]
        if not is_moving and any(e.subs(STEP, 0).has(*scheme.unknowns) for e in scheme.after):
            return False  # what these change by, which is not verified, would count
        first_ones = (*system.coordinates, *replaced(p, {STEP: sp.S.Zero}))
        wholes = list(zip(residual, counts, strict=True))
        wholes += [(e - x - STEP * y, 2) for e, x, y in zip(after, first_ones, (*v, *goal), strict=True)]
        found_ones = coefficients(e for e, _ in wholes)
        aims = [x for found, (_, count) in zip(found_ones, wholes, strict=True) for x in found[:count]]
        return self.spanned(aims, known, True, lambda into: ([(into(e, _bent), count) for e, count in wholes], {}))

    @cached_property
    def vectors(self) -> tuple[list[sp.Expr], list[Named], list[Named]]:
        """The expressions that are 0; possible changes of velocities and momenta, as symbols and at the exact state.

        Those are accelerations a; the rest r of the rate of ∂L/∂v without mass, M r = d/dt ∂L/∂v - M a; accelerations e
        of fixed mass and constraints, M e - Aᵀκ = ∂L/∂q + F, A e = 0; and the reactions λ and κ.
        """
        exact, n, m, system = self.exact, self.n, self.exact.m, self.system

        def named(name: str, size: int) -> sp.Matrix:
            return sp.Matrix(size, 1, [sp.Symbol(f"{name} {i}") for i in range(size)])  # which no coordinate is called

        a, rest, e = (named(x, n) for x in ("acceleration", "rest", "easy"))
        lam, kappa = (named(x, m) for x in ("reaction", "kappa"))
        (matrix, right), leaning = system.equations, rate(sp.Matrix(system.momenta), system.coordinates)
        easy = [*system.push, *[sp.S.Zero] * m]
        known = [*(matrix * sp.Matrix([*a, *lam]) - right), *(matrix * sp.Matrix([*e, *kappa]) - sp.Matrix(easy))]
        known += [*(system.mass * rest - leaning), *self.always]
        if self.stepped.has_momenta:
            known += system.rows * sp.Matrix(system.velocities) + system.offsets
        state = self.state
        mass = fmpq_mat(n, n, [_at(x, 0) for x in exact.at(system.mass, state)])
        lean = inverse(mass) * fmpq_mat(n, 1, [_at(x, 0) for x in exact.at(leaning, state)])
        true, light = ([_at(x, 0) for x in exact.solved(state[:n], exact.at(of, state))] for of in (right, easy))
        changes = [(a, true[:n]), (rest, lean.entries()), (e, light[:n])]
        parts = []
        for symbols, numbers in ((lam, true[n:]), (kappa, light[n:])):
            for is_placed in (False, True):
                on = [int((i >= m - len(system.holonomic)) is is_placed) for i in range(m)]
                parts.append((sp.Matrix(m, 1, list(map(mul, on, symbols))), list(map(mul, on, numbers))))
        return known, changes, parts

    def returns(self, back: int) -> Verdict:
        """Whether a step forth and one back return: with the velocities turned, or, where `back` is -1, of length -h.

        Momenta are those before the reaction, or those after it.
        """
        stepped, scheme, n, h = self.stepped, self.scheme, self.n, self.h
        first, there, z, then = self.forth
        turned = self.exact.read(self.turned if back > 0 else scheme.state)
        _, around = stepped.first([*self.state[:n], *(-back * x for x in self.state[n:])])
        wrong = None
        for part in (scheme.state, self.kicked) if stepped.has_momenta and self.reacting else (scheme.state,):
            begin, end = (stepped.of(self.exact.read(part), at, of, h) for at, of in ((first, z), (there, then)))
            final, other = stepped.step(stepped.of(turned, end, z, h), around, h * back)
            final = stepped.of(turned, final, z, h)
            if not any(_at(x, k) != _at(y, k) for x, y in zip(final, begin, strict=True) for k in range(self.looked)):
                return self._proved(self.is_returning(back, part, turned, other))
            if (part is self.kicked) is (scheme.reflects and bool(self.reacting)):
                reached, _ = self.exact.velocities(final, stepped.has_momenta)
                named = zip(map(str, self.exact.symbols), reached, self.state, strict=True)
                wrong = self.wrong("a step forth and back misses", *named)
        return wrong or self._proved(False)

    @property
    def turned(self) -> list[sp.Expr]:
        """The state with reversed velocities."""
        rest = [-x for x in self.scheme.state[self.n :]]
        if self.stepped.has_momenta:  # of -v
            at_rest = self.system.momenta.xreplace(dict.fromkeys(self.system.velocities, sp.S.Zero))
            rest = [2 * b + p for b, p in zip(at_rest, rest, strict=True)]
        return [*self.scheme.state[: self.n], *rest]

    @staticmethod
    def _proved(is_proved: bool) -> Verdict:
        return Verdict("proved") if is_proved else Verdict("measured", "no difference is found")

    def is_returning(self, back: int, part: Sequence[sp.Expr], turned: Sequence[sp.Expr], other: State) -> bool:
        """Whether that is proved: the step back has the unknowns of the step forth, in another order and with signs."""
        scheme, (_, _, z, then) = self.scheme, self.forth
        symbols, (there, next_, links) = list(scheme.unknowns), self.next_state
        known, sources = [*scheme.residual, *links, *self.always], [(z, symbols)]
        if part is self.kicked or not self.reacting:
            known += self._with(scheme.residual, there, next_)
            sources.append((then, next_))
        could = [([of[i] for i in one], [by[i] for i in one]) for of, by in sources for one in self.blocks.values()]
        if not self.stepped.has_momenta:
            could.append((list(self.state[self.n :]), list(self.system.velocities)))

        def same(block: Sequence[int], of: Sequence[Series], sign: int) -> bool:
            pairs = [(other[i], x) for i, x in zip(block, of, strict=True)]
            return all(_at(x, k) == sign * _at(y, k) for x, y in pairs for k in range(self.looked - 1))

        choices = [
            [[sign * x for x in by] for of, by in could for sign in (1, -1) if len(of) == len(b) and same(b, of, sign)]
            for b in self.blocks.values()
        ]
        begin, end = self._with(part, scheme.state, symbols), self._with(part, there, next_)
        around = self._with(turned, end, symbols)
        ends = [sp.Symbol(f"end {i}") for i in range(len(end))]
        there_again = dict(zip(ends, end, strict=True))

        def missed(around: Sequence[sp.Expr], unknowns: Sequence[sp.Expr]) -> list[sp.Expr]:
            """The expressions that should be 0 in the step back from a state, with unknowns."""
            final = self._with(turned, self._with(scheme.after, around, unknowns, back), unknowns)
            off = [x - y for x, y in zip(final, begin, strict=True)]
            return [*self._with(scheme.residual, around, unknowns, back), *off]

        def replaced_ends(wave: sp.Expr) -> sp.Expr:
            return wave.func(*(sp.expand(x.xreplace(there_again)) for x in wave.args))

        for choice in islice(product(*choices), MOST_CHOICES):
            unknowns = [x for block in choice for x in block]

            def shown(into: Callable[..., sp.Expr], unknowns: Sequence[sp.Expr] = unknowns) -> Shown:
                of = missed(self._with(turned, ends, symbols), unknowns)
                return [(into(e, replaced_ends), 0) for e in of], {x: into(e) for x, e in there_again.items()}

            if self.spanned(missed(around, unknowns), known, False, shown):
                return True
        return False

    def _with(
        self, expressions: Sequence[sp.Expr], state: Sequence[sp.Expr], unknowns: Sequence[sp.Expr], back: int = 1
    ) -> list[sp.Expr]:
        symbols = (*self.scheme.state, *self.scheme.unknowns, STEP)
        return replaced(expressions, dict(zip(symbols, (*state, *unknowns, STEP * back), strict=True)))

    def keeps(self, quantity: sp.Expr) -> Verdict:
        """Whether a quantity of place and velocity is the same where the method looks at a step and at the next."""
        stepped, (first, there, z, then) = self.stepped, self.forth
        seen = [stepped.of(stepped.seen, at, of, self.h) for at, of in ((first, z), (there, then))]
        read, symbols = self.exact.read([quantity]), (*self.exact.symbols, STEP)
        values = (dict(zip(symbols, (*x, self.h), strict=True)) for x in (*seen, self.exact.moved))
        before, after, moved = (evaluated(read, one)[0] for one in values)
        if not quantity.has(STEP) and self.wrong("", ("", moved, _at(moved, 0))):
            return Verdict("measured", "the exact motion does not keep it")
        wrong = self.wrong("it changes", ("in a step", after, before))
        return wrong or self._proved(self.is_kept(quantity))

    def keeps_volume(self, of: tuple[Volume, bool]) -> Verdict:
        """Whether a volume is kept: that of the exact motion, or any, for a method of order 1."""
        kept, is_consistent = of
        has_volume(self.system, self.scheme, len(self.always))
        if kept.density is None:
            if kept.at_all and is_consistent:
                return Verdict("false", "by the first order in velocities, as the motion keeps none", kept.point)
            return Verdict("measured", f"the exact motion {kept}")
        for count in LOOKED_AT_VOLUMES:
            with flint_terms(2 * count + BEYOND):
                again = Judged(self.exact, self.scheme, self.looked)  # with an h of that many terms
                change = logarithm(self.exact, kept.density, kept.by, partial(again.after, reaction=[]), count)
            if wrong := self.wrong("its logarithm changes", ("in a step", change, 0)):
                return wrong
        return self._proved(False)

    def is_kept(self, quantity: sp.Expr) -> bool:
        """Whether that is proved: by the equations of two steps, also times an unknown or a momentum."""
        scheme, symbols = self.scheme, self.exact.symbols
        if scheme.stages:  # what is linear is kept by such a method if its rate is 0
            slope = [sp.diff(quantity, x) for x in symbols]
            flow = sum((e * x for e, x in zip(slope, scheme.after, strict=True)), sp.S.Zero)
            return not any(e.free_symbols & set(symbols) for e in slope) and self.spanned([flow], scheme.residual)
        there, next_, links = self.next_state
        known = [*scheme.residual, *links, *self._with(scheme.residual, there, next_), *self.always]
        first = replaced([quantity], dict(zip(symbols, (*scheme.place, *scheme.velocity), strict=True)))
        aim = [self._with(first, there, next_)[0] - first[0]]
        known += [STEP * e for e in known]
        if self.spanned(aim, known):
            return True
        factors = [sp.S.One, *scheme.unknowns, *next_, *scheme.state[self.n :], *there[self.n :]]
        few = len(factors) * len(known) <= MOST_KNOWN
        return few and self.spanned(aim, [f * e for f in factors for e in known])

    @cached_property
    def next_state(self) -> tuple[list[sp.Expr], list[sp.Symbol], list[sp.Expr]]:
        """The state after a step, the unknowns of the next, and what symbols for its momenta set to 0."""
        scheme, n = self.scheme, self.n
        place, rest, links = list(scheme.after[:n]), list(scheme.after[n:]), []
        if self.stepped.has_momenta:
            names = [sp.Symbol(f"{x.name} next") for x in scheme.state[n:]]
            links, rest = [x - e for x, e in zip(names, rest, strict=True)], names
        return [*place, *rest], [sp.Symbol(f"{x.name} next") for x in scheme.unknowns], links

    @cached_property
    def always(self) -> list[sp.Expr]:
        """The constraints on positions, and on velocities of a state, that the equations set to 0 at the end."""
        system, (there, _, links) = self.system, self.next_state
        found = list(system.holonomic)
        if not self.stepped.has_momenta:
            found += system.rows * sp.Matrix(system.velocities) + system.offsets
        after = dict(zip(self.scheme.state, there, strict=True))
        known, before = [*self.scheme.residual, *links], self.proofs
        self.proofs = self.proofs_of_always
        kept = [] if self.scheme.stages else [e for e in found if self.spanned(replaced([e], after), known)]
        self.proofs = before
        return kept

    def spanned(
        self, aims: Iterable[sp.Expr], known: Iterable[sp.Expr], on: bool = False, shown: Show | None = None
    ) -> bool:
        """Whether each of some expressions is a combination of known ones, with rational numbers.

        With `on` that is so where holonomic constraints hold, their rates and the rates of these.  `shown` gives what
        is shown of it, by what puts letters into expressions.
        """
        relations = list(self.bound) if on else []
        parts = [replaced(part, self.exact.numbers) for part in (aims, known, relations)]
        letters = Letters(set().union(*(e.free_symbols for part in parts for e in part)), plain=True)
        one, other, zero = (list(map(letters.into, part)) for part in parts)
        plain = other
        if zero:
            ring = Quotient(sorted(set().union(*(e.free_symbols for e in (*one, *other, *zero))), key=str), zero)
            one, other = ([ring.reduced(e) for e in part] for part in (one, other))
        if (factors := _spanned(one, other)) is None:
            return False

        def into(expr: sp.Expr, turned: Callable[[sp.Expr], sp.Expr] = lambda wave: wave) -> sp.Expr:
            return letters.into(replaced([expr], self.exact.numbers, turned)[0])

        def combinations(plainly: bool) -> list[Combination]:
            sums = iter([[(c, plain[j]) for j, c in row.items()] for row in factors])
            wholes, ends = shown(into) if shown and not plainly else ([(e, 0) for e in parts[0]], {})
            found = dict[int, Combination]()
            for whole, count in wholes:
                relations = [*zero, *([STEP**count] if count else [])]
                of = found.setdefault(count, Combination([], [], relations, letters.meanings, ends))
                of.left.append(letters.into(whole))
                of.right.append([(STEP**k * c, e) for k in range(max(count, 1)) for c, e in next(sums)])
            return list(found.values())

        self.proofs.append(combinations)
        return True

    @cached_property
    def bound(self) -> list[sp.Expr]:
        """Holonomic constraints, their rates, and the rates of these, by the accelerations of `vectors`."""
        (known, _, _), m = self.vectors, self.exact.m
        found, count = list(self.system.holonomic), len(self.system.holonomic)
        rates = list(self.system.rows * sp.Matrix(self.system.velocities))[m - count :] if count else []
        return [*found, *rates, *known[self.n + m - count : self.n + m]]


def _spanned(aims: Sequence[sp.Expr], known: Sequence[sp.Expr]) -> list[dict[int, sp.Rational]] | None:
    """The factors of combinations, found at random points in a finite field and proved as identities in all symbols."""
    if not any(aims):
        return [{} for _ in aims]
    symbols = sorted(set().union(*(e.free_symbols for e in (*aims, *known))), key=str)
    if len(known) > MOST_KNOWN or size([*aims, *known]) > MOST_OPERATIONS:
        raise Undecided("it has more operations than a proof may have")
    ring = Quotient(symbols, [])
    table = []
    for i in range(len(known) + 4):
        point = {x: nmod(pow(7 + 2 * j, 3 * i + 5, PRIME) * (i + j + 1), PRIME) for j, x in enumerate(symbols)}
        table.append(evaluated([*known, *aims], point, lambda p, q: nmod(int(p), PRIME) / nmod(int(q), PRIME)))
    count = len(known)
    reduced, rank = nmod_mat([[int(x) for x in row] for row in table], PRIME).rref()
    bound = [next(j for j in range(count + len(aims)) if int(reduced[i, j])) for i in range(rank)]
    if any(j >= count for j in bound):
        return None
    found = []
    for k, aim in enumerate(aims):
        factors = [_small(int(reduced[i, count + k])) for i in range(rank)]
        if None in factors:
            return None
        found.append({j: f for f, j in zip(factors, bound, strict=True) if f})
        try:
            if not ring.is_zero(aim - sum((f * known[j] for j, f in found[-1].items()), sp.S.Zero)):
                return None
        except ZeroDivisionError:
            raise Undecided("an equation divides by 0") from None
    return found


def _small(x: int) -> sp.Rational | None:
    """The fraction of small numbers that equals x in the finite field."""
    for below in range(1, BELOW + 1):
        above = x * below % PRIME
        above = above - PRIME if above > PRIME // 2 else above
        if abs(above) <= ABOVE:
            return sp.Rational(above, below)
    return None


def coefficients(expressions: Iterable[sp.Expr]) -> list[Powers]:
    """The coefficients of 1, h and h² of expressions in the length of a step; shared parts are computed once."""

    def made(expr: sp.Expr, of: Callable[[sp.Expr], Powers]) -> Powers:
        if not expr.args:
            return expr, sp.S.Zero, sp.S.Zero
        parts = [of(x) for x in expr.args]
        a, b, c = parts[0]
        if isinstance(expr, sp.Add):
            a, b, c = (sp.Add(*some) for some in zip(*parts, strict=True))
        elif isinstance(expr, sp.Mul):
            for d, e, f in parts[1:]:
                pairs = (((a, d),), ((a, e), (b, d)), ((a, f), (b, e), (c, d)))
                a, b, c = (sp.Add(*(x * y for x, y in some if 0 not in (x, y))) for some in pairs)  # 0 x asks much of x
        elif not isinstance(expr, sp.Pow | sp.sin | sp.cos | sp.tan):
            raise Undecided(f"{expr!s:.60} has no exact series")
        else:
            outer = expr.func(_ANY, *expr.args[1:])
            first, second = (outer.diff(_ANY, k).xreplace({_ANY: a}) for k in (1, 2))
            a, b, c = outer.xreplace({_ANY: a}), first * b, first * c + (second * b**2 / 2 if b != 0 else 0)
        return a, b, c

    return by_parts(expressions, {STEP: (sp.S.Zero, sp.S.One, sp.S.Zero)}, made)


_ANY = sp.Symbol("any")


def _bent(wave: sp.Expr) -> sp.Expr:
    """A sine or cosine up to h², by those at h = 0."""
    (of,) = wave.args
    start = of.xreplace({STEP: sp.S.Zero})
    turn, s, c = sp.expand(of - start), sp.sin(start), sp.cos(start)
    s, c = s * (1 - turn**2 / 2) + c * turn, c * (1 - turn**2 / 2) - s * turn
    return {sp.sin: s, sp.cos: c, sp.tan: s / c}[wave.func]


def _guessed(x: Sequence[fmpq], of: Sequence[Named]) -> sp.Matrix | None:
    """The sum of halves of vectors of symbols that has some numbers where these have theirs; None if there is none."""
    for backwards in product((0, 1, -1, 2, -2), repeat=len(of)):
        halves = backwards[::-1]  # of the first first
        if all(2 * y == sum(k * v[i] for k, (_, v) in zip(halves, of, strict=True)) for i, y in enumerate(x)):
            return sum((k * symbols / 2 for k, (symbols, _) in zip(halves, of, strict=True)), sp.zeros(len(x), 1))
    return None


def _of_tableau(stages: Sequence[Sequence[sp.Rational]]) -> int:
    """The order of an explicit Runge-Kutta method, by the conditions of rooted trees, up to 4."""
    holds = [all(sum_ == 1 for sum_ in row) for row in tableau_conditions(stages)]
    return next((i for i, good in enumerate(holds) if not good), len(holds))


def tableau_conditions(stages: Sequence[Sequence[sp.Expr]]) -> list[list[sp.Expr]]:
    """The expressions that are 1 for the orders 1 to 4."""
    size = len(stages)
    A = sp.Matrix(size, size, lambda i, j: stages[i - 1][j] if i > 0 and j < i else sp.S.Zero)
    b, one = sp.Matrix([list(stages[-1])]), sp.ones(size, 1)
    c = A * one
    squared, cubed = c.applyfunc(lambda x: x**2), c.applyfunc(lambda x: x**3)
    mixed = (A * c).multiply_elementwise(c)
    conditions = [
        [(one, 1)], [(c, 2)], [(squared, 3), (A * c, 6)], [(cubed, 4), (mixed, 8), (A * squared, 12), (A * A * c, 24)]
    ]  # fmt: skip
    return [[(b * weight)[0] * count for weight, count in row] for row in conditions]
