"""The exact verdicts on a system and on methods as claims, whose certificates the checker judges without chapsym.

The statements are equations between rational functions of coordinates, velocities and letters, with the numbers of the
parameters: those of sines, cosines and roots, whose relations are hypotheses.  Dependent velocities are expressed by
the others.  A derivative is stated as a limit, which is such an equation; a rank by a minor that is not 0 at a rational
point.
"""

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any

import sympy as sp
from flint import fmpq, fmpq_poly, fmpq_series

from chapsym.derive.quotient import Quotient, in_sympy
from chapsym.numbers.precisions import flint_terms
from chapsym.prove import Claim, Comparison, Equation, Examples, Identity, Proof, Verdict, tends
from chapsym.prove.polynomials import Ratio, parameters
from chapsym.prove.statements import Statement
from chapsym.prove.trees import Data
from chapsym.prove.witness import true_at

from .algebra import Algebra, Point, Vectors, adjugate, determinant, pivots
from .brackets import Bracketed, bracket_of, flag, spanned
from .density import MOST_LEVELS, Volume, divergences, volume
from .equations import OnShell, conserved
from .judged import BEYOND, VOLUMES, Combination, Decided, Judged, decided, quantities_of, tableau_conditions
from .lab import keeps
from .methods import Scheme, scheme_of
from .series import Series, State, _at, evaluated, replaced
from .system import STEP, BadSystem, System, a_system, several

#: The length of the name of a system in the id of a claim.
LETTERS = 22
#: Why a property that is an equation of the method has no certificate.
SAID = "it is one of the equations, so that nothing is to be decided"
#: Of an equation in words.
MOST_LETTERS = 3000


@dataclass(frozen=True)
class Certified:
    """An exact verdict, with its certificate or the reason why it has none.

    Attributes
    ----------
    verdict : str
        The name of the verdict: "motion", "energy", "dla: order".
    certificate : dict or None
        The certificate of `chapsym.prove`, accepted by the checker.
    why : str
        Why there is no certificate.
    """

    verdict: str
    certificate: Data | None = None
    why: str = ""


@dataclass(frozen=True)
class Case:
    """A claim with its statement, its proof, and a false variant of it; premises are in words.

    Where the certificate is too large there may be another `instead`, and `derived`, that some expressions are
    derivatives, is said in words.
    """

    said: str
    printed: Sequence[Statement]
    control: Statement
    lemmas: Sequence[Statement] = ()
    derived: Sequence[Statement | str] = ()
    premises: Sequence[str] = ()
    uses: Sequence[str] = ()
    inferred: str = ""
    instead: "Callable[[], Case] | None" = None

    def judged(self, verdict: str, id: str, points: Sequence[Point] = ()) -> Certified:
        """The verdict by its own proof, run now, and by the checker, at one of some points where it has a value."""
        found = self._judged(verdict, id, points)
        if found.certificate:
            return found
        if self.instead:
            return self.instead().judged(verdict, id, points)
        texts = [one if isinstance(one, str) else one.text for one in self.derived]
        return found if texts == self.derived else replace(self, derived=texts).judged(verdict, id, points)

    def _judged(self, verdict: str, id: str, points: Sequence[Point]) -> Certified:
        texts = [one for one in self.derived if isinstance(one, str)]
        statements = [*(one for one in self.derived if not isinstance(one, str)), *self.lemmas, *self.printed]
        related = [one for one in statements if isinstance(one, Equation) and isinstance(one.algebra, Quotient)]

        def prove(p: Proof) -> None:
            letters = [set().union(*(e.free_symbols for e in (*one.left, *one.right))) for one in related]
            own = [*zip(related, letters, strict=True)]  # other symbols are free
            at = (x for x in points if all(true_at(one, x) for one, symbols in own if symbols <= x.keys()))
            p.examples = Examples(numbers=next(at, {}))
            for text in (*self.premises, *(f"{text}: as chapsym forms them" for text in texts)):
                p.assume(text)
            if self.inferred:
                p.infers(self.inferred)
            p.lemma(*statements[: -len(self.printed)])
            p.printed(*self.printed)
            p.control(self.control)
            for one in statements:
                if isinstance(one, Comparison | Identity):
                    point = getattr(one, "point", {})
                    p.witness("point", {x.name: str(v) for x, v in point.items()}, one)

        found = Claim(id, self.said, tuple(self.uses), prove).judge().certified()
        data, problems = found.certificate, found.proof.problems
        left = [one["text"] for one in data["sentences"] if one["role"] in ("printed", "lemma")] if data else []
        if data is None or data["verdict"] != Verdict.HOLDS or left:
            return Certified(verdict, None, next(iter([*problems, *left]), SAID))
        return Certified(verdict, data)


#: With points at which it may have a value.
Made = tuple[Case, Sequence[Point]]


def made(system: System, verdict: str, id: str, known: set[str], case_of: Callable[..., Made], *of: Any) -> Certified:
    """A verdict by its case, if it rests on known claims, to which it is then added."""
    try:
        case, points = case_of(*of)
        if lacking := [one for one in case.uses if one not in known]:
            raise BadSystem(f"it rests on {lacking[0]}, which has none")
        found = case.judged(verdict, id, points)
    except (ArithmeticError, ValueError, sp.PolynomialError) as error:
        return Certified(verdict, None, str(error).removeprefix(f"{system.name}: "))
    known |= {id} if found.certificate else set()
    return found


def name_of(system: System) -> str:
    """The beginning of the ids of its claims."""
    plain = re.sub(r"[^A-Za-z0-9]+", "-", system.name).strip("-")[:LETTERS].strip("-").lower()
    return plain or "system"


def fresh(name: str, taken: Collection[sp.Symbol]) -> sp.Symbol:
    """A symbol that differs from some others."""
    while sp.Symbol(name) in taken:
        name += "_"
    return sp.Symbol(name)


#: Cells of a method in the ids of its claims.
CELLS = {"order": "order", "self-adjoint": "adjoint", "reversible": "returns"}
CELLS |= {f"keeps {name}": "volume" for name in VOLUMES}
#: What has more parts is shown by what comes out of it.
MOST_SHOWN = 4000


def of_method(system: System, method: str, name: str) -> Iterator[Certified]:
    """The exact verdicts on a method, as `certified` has them."""
    scheme, known = scheme_of(system, method), set[str]()
    quantities, verdicts = quantities_of(system, scheme.integrals), decided(system, scheme)
    ids = CELLS | {f"keeps {what}": f"keeps-{i + 1}" for i, what in enumerate(quantities)}
    for what in sorted(verdicts, key=lambda what: what != "self-adjoint"):  # on which the order rests
        if (found := verdicts[what]).verdict.verdict != "measured":
            more = system, scheme, what, found, quantities.get(what.removeprefix("keeps ")), f"{name}-adjoint"
            yield made(system, f"{method}: {what}", f"{name}-{ids[what]}", known, _case, *more)
    if keeps(system, scheme):
        yield Certified(f"{method}: keeps the constraints", None, SAID)


def _case(system: System, scheme: Scheme, what: str, found: Decided, quantity: sp.Expr | None, adjoint: str) -> Made:
    if found.verdict.verdict == "proved":
        uses = [adjoint] if what == "order" and not scheme.stages and found.verdict.said > "1" else []
        shown, plain = (partial(_combined, system, scheme, what, found, plainly, uses) for plainly in (False, True))
        return replace(shown(), instead=plain), ()
    return _refuted(system, quantity, what, found), ()


def _steps_in_words(scheme: Scheme, names: Mapping[sp.Symbol, sp.Symbol]) -> list[str]:
    """The equations of a step."""
    of = [(f"equation {i + 1} of a step", f"{e.xreplace(names)} = 0") for i, e in enumerate(scheme.residual)]
    ends = zip(scheme.state, scheme.after, strict=True)
    of += [(f"after a step {x.xreplace(names)} is", str(e.xreplace(names))) for x, e in ends]
    return [f"{what}: {text}" for what, text in of if len(text) < MOST_LETTERS]


def _named(symbols: Iterable[sp.Symbol]) -> dict[sp.Symbol, sp.Symbol]:
    """Names that a certificate may have, for symbols such as `u 0`."""
    found, taken = dict[sp.Symbol, sp.Symbol](), set(symbols)
    for x in sorted((x for x in taken if " " in x.name), key=str):
        found[x] = fresh(x.name.replace(" ", "_"), taken)
        taken.add(found[x])
    return found


def _combined(system: System, scheme: Scheme, what: str, found: Decided, plainly: bool, uses: Sequence[str]) -> Case:
    """The case that a method's change is a combination of what its equations, constraints and the motion set to 0."""
    proofs = [one for of in found.proofs for one in of(plainly) if any(one.left)]
    if not plainly and sum(1 for one in proofs for _ in sp.preorder_traversal(one.left) if one.relations) > MOST_SHOWN:
        return _combined(system, scheme, what, found, True, uses)
    of = (e for one in proofs for e in (*one.left, *one.relations, *one.ends, *one.ends.values()))
    known = (x for one in proofs for row in one.right for pair in row for x in pair)
    names = _named(set().union(scheme.state, scheme.unknowns, *(e.free_symbols for e in (*of, *known))))
    if not proofs:
        raise BadSystem(SAID)
    stated, wrong = [_stated(one, names, 0) for one in proofs], _stated(proofs[-1], names, 1)
    meanings = {x: e for one in proofs for x, e in one.meanings.items()}
    premises = [*_steps_in_words(scheme, names), *(f"{x} is {e.xreplace(names)}" for x, e in meanings.items())]
    if what == "order":
        what += f" is at least {found.verdict.said}"
    if plainly:
        premises.append("steps back, and the coefficients of h, are as chapsym forms them")
    if scheme.stages and what.startswith("order"):
        stated.append(tableau := _tableau(scheme.stages, int(found.verdict.said)))
        premises.append("the stages are by the weights a, the end by b, for rates that the equations give")
        wrong = Comparison(f"{tableau.text}, with 2", [sp.Eq(e.lhs, 2) for e in tableau.relations], tableau.point)
    return Case(f"{system.name}: {what}", stated, wrong, premises=premises, uses=uses)


def _tableau(stages: Sequence[Sequence[sp.Rational]], order: int) -> Comparison:
    """The conditions of rooted trees, of the weights as symbols."""
    names = [f"a{i + 2}" for i in range(len(stages) - 1)] + ["b"]
    symbols = [[sp.Symbol(f"{name}_{j + 1}") for j in range(len(row))] for name, row in zip(names, stages, strict=True)]
    relations = [sp.Eq(e, 1, evaluate=False) for row in tableau_conditions(symbols)[:order] for e in row]
    point = {x: v for row, values in zip(symbols, stages, strict=True) for x, v in zip(row, values, strict=True)}
    return Comparison(f"the conditions of rooted trees up to order {order}", relations, point)


def _stated(one: Combination, names: Mapping[sp.Symbol, sp.Symbol], more: int) -> Statement:
    """A combination as a statement, with operations as they are written where it has no relations."""
    text = "what should be 0 is a combination of what the equations set to 0" + f", with {more} more" * (more > 0)
    left, relations, ends = ([e.xreplace(names) for e in part] for part in (one.left, one.relations, one.ends.values()))
    rows = [[(c.xreplace(names), e.xreplace(names)) for c, e in row] for row in one.right]
    right, at = [sp.Add(*(c * e for c, e in row)) for row in rows], [x.xreplace(names) for x in one.ends]
    known = (x for row in rows for pair in row for x in pair)
    symbols = sorted(set().union(*(e.free_symbols for e in (*left, *known, *relations, *ends))) - {*at}, key=str)
    if relations:
        return Equation(text, [left[0] + more, *left[1:]], right, Quotient(symbols, relations))
    values = dict(zip(symbols, parameters(" ".join(map(str, symbols))), strict=True))
    unit = values[symbols[0]] ** 0

    def read(expressions: Iterable[sp.Expr]) -> list[Ratio]:
        return [unit * 0 + e for e in evaluated(expressions, values, lambda p, q: unit * int(p) / (unit * int(q)))]

    values |= dict(zip(at, read(ends), strict=True))
    first, *rest = read(left)
    sums = [sum((c * e for c, e in zip(*map(read, zip(*row, strict=True)), strict=True)), unit * 0) for row in rows]
    return Identity(text, [first + more, *rest], sums)


def _rational(c: fmpq) -> sp.Rational:
    return sp.Rational(int(c.p), int(c.q))


class _Steps:
    """Steps from the exact state as polynomials in h, up to a power, with the statements that they are steps."""

    def __init__(self, judged: Judged, most: int) -> None:
        self.judged, self.scheme, self.stepped, self.most = judged, judged.scheme, judged.stepped, most
        self.exact, self.below, self.lemmas = judged.exact, f"below h^{most}", list[Equation]()
        self.ring = Quotient([STEP], [STEP**most])
        self.symbols = (*self.scheme.state, *self.scheme.unknowns)

    def polynomial(self, x: Series) -> sp.Expr:
        """A series, cut off."""
        return sum((_rational(_at(x, k)) * STEP**k for k in range(self.most)), sp.S.Zero)

    def put(self, expressions: Iterable[sp.Expr], symbols: Iterable[sp.Symbol], values: Iterable[Any]) -> list[sp.Expr]:
        """Expressions with symbols replaced by polynomials, and sines and cosines of these cut off."""

        def wave(of: sp.Expr) -> sp.Expr:
            coefficients = map(sp.Poly(of.args[0], STEP).nth, range(self.most))
            value = fmpq_series([fmpq(int(c.p), int(c.q)) for c in coefficients])
            return self.polynomial(evaluated([of.func(STEP)], {STEP: value})[0])

        known = {x: v if isinstance(v, sp.Expr) else self.polynomial(v) for x, v in zip(symbols, values, strict=True)}
        return replaced(self.exact.read(expressions), known, wave)

    def equal(self, text: str, left: Sequence[sp.Expr], right: Sequence[sp.Expr | Series]) -> Equation:
        """With all that is beyond, which is shorter so than as a cofactor."""
        h, sides = fmpq_poly([0, 1]), [e if isinstance(e, sp.Expr) else self.polynomial(e) for e in right]
        try:
            found = evaluated(left, {STEP: h}, lambda p, q: fmpq_poly([fmpq(p, q)]))
        except TypeError:
            raise BadSystem("the equations of a step divide by series") from None
        beyond = [[(k, c) for k, c in enumerate(list(e)) if k >= self.most] for e in found]
        later = [sum((_rational(c) * STEP**k for k, c in row), sp.S.Zero) for row in beyond]
        return Equation(f"{text}, {self.below}", left, [a + b for a, b in zip(sides, later, strict=True)], self.ring)

    def step(self, what: str, state: State, guess: State, back: int = 1) -> tuple[State, State]:
        """The state after a step of length h, or -h, and its unknowns."""
        scheme, length, stages = self.scheme, back * self.judged.h, list[tuple[State, State]]()

        def rates(at: State) -> State:
            stages.append((at, self.stepped.solved(at, guess, length)))
            return self.stepped.of(self.stepped.after, *stages[-1], length)

        end = scheme.step(state, rates(state), length, rates, lambda a: fmpq(a.p, a.q))
        made = list[list[sp.Expr]]()
        for i, (at, z) in enumerate(stages):
            values = [*at, *z, back * STEP]
            left = self.put(scheme.residual, (*self.symbols, STEP), values)
            self.lemmas.append(self.equal(f"equations of {what}", left, [sp.S.Zero] * len(left)))
            made.append(self.put(scheme.after, (*self.symbols, STEP), values))
            ends = made[0]
            if scheme.stages:
                sums = [sum(map(sp.Mul, scheme.stages[i], of), sp.S.Zero) for of in zip(*made, strict=True)]
                ends = [self.polynomial(x) + back * STEP * e for x, e in zip(state, sums, strict=True)]
            there = end if at is stages[-1][0] else stages[i + 1][0]
            self.lemmas.append(self.equal(f"what comes after {what}", ends, there))
        return end, stages[0][1]

    def forth(self) -> tuple[State, State, State, State]:
        """The step forth of the judged method."""
        first, guess = self.stepped.first(self.judged.state)
        there, z = self.step("a step", first, guess)
        return first, there, z, self.step("the next step", there, z)[1]


def _refuted(system: System, quantity: sp.Expr | None, what: str, found: Decided) -> Case:
    """That a quantity changes, or a step back misses, by the series of steps from the exact state."""
    assert found.judged
    if what == "order":
        raise BadSystem("the series of the exact motion is not written down")
    if what.removeprefix("keeps ") in VOLUMES:
        raise BadSystem("the derivatives of a step are not written down")
    with flint_terms(found.by + 2 + BEYOND):
        of = _Steps(found.judged, found.by + 2)
        if quantity is not None:
            said = f"{what.removeprefix('keeps ')} changes in a step"
            printed, wrong = _change(of, quantity, said)
        else:
            said = f"a step forth and one back{', turned,' * (what == 'reversible')} end elsewhere"
            printed, wrong = _missed(of, 1 if what == "reversible" else -1, said)
    premises = [f"at the exact state {x} is {v}" for x, v in found.verdict.point.items()]
    premises += ["h is step_length; of sines and cosines it is the series, of angles from the exact state"]
    premises += _steps_in_words(of.scheme, _named(of.symbols))
    return Case(f"{system.name}: {said}, {of.below}", printed, wrong, of.lemmas, premises=premises)


def _change(of: _Steps, quantity: sp.Expr, said: str) -> tuple[list[Equation], Equation]:
    """The change of a quantity, and that it is not 0."""
    first, there, z, then = of.forth()
    places, values = (*of.scheme.place, *of.scheme.velocity), list[sp.Expr]()
    for state in ((*first, *z), (*there, *then)):
        values += of.put([quantity], of.exact.symbols, map(sp.expand, of.put(places, of.symbols, state)))
    before, later = evaluated(values, {STEP: of.judged.h})
    left = [values[1] - values[0]]
    return [of.equal(said, left, [later - before])], of.equal(f"{said}: by 0", left, [sp.S.Zero])


def _missed(of: _Steps, back: int, said: str) -> tuple[list[Equation], Equation]:
    """The place and velocity after a step forth and one back, and that they are not those of the exact state."""
    judged, stepped, n = of.judged, of.stepped, of.judged.n
    _, there, z, then = of.forth()
    part = judged.kicked if of.scheme.reflects and judged.reacting else of.scheme.state
    turned = judged.turned if back > 0 else of.scheme.state
    end = stepped.of(of.exact.read(part), there, then, judged.h)
    start = stepped.of(of.exact.read(turned), end, z, judged.h)
    seen = map(sp.expand, of.put(part, of.symbols, (*there, *then)))
    of.lemmas.append(of.equal("where it turns", of.put(turned, of.scheme.state, seen), start))
    around = [*judged.state[:n], *(-back * x for x in judged.state[n:])]
    end, _ = of.step("the step back", start, stepped.first(around)[1], back)
    after_it = of.lemmas.pop()
    if not stepped.has_momenta:
        left, lost = after_it.left, [_at(x, 0) for x in end]
        return [of.equal(said, left, end)], of.equal(f"{said}: by 0", left, lost)
    final, system = stepped.of(of.exact.read(turned), end, z, judged.h), judged.system
    of.lemmas.append(of.equal("turned again", of.put(turned, of.scheme.state, end), final))
    reached, reaction = of.exact.velocities(final)
    names = sp.Matrix([sp.Symbol(f"reaction {i}") for i in range(len(reaction))])
    held = system.rows.T * names if reaction else sp.zeros(n, 1)
    rows = [*system.coordinates, *(system.momenta + held)]
    rows += [*(system.rows * sp.Matrix(system.velocities) + system.offsets)]
    right = [*final, *([sp.S.Zero] * len(reaction))]
    left, lost = (of.put(rows, (*of.exact.symbols, *names), (*x, *reaction)) for x in (reached, judged.state))
    said = f"{said}, with velocities of these momenta"
    printed = [after_it, of.equal(said, left, right)]
    return printed, of.equal(f"{said}: those of the exact state", lost, right)


#: Of what has more parts, derivatives are not given to the checker; those of what divides count more.
MOST_PARTS, FRACTIONS = 1500, 5
#: The largest number of parts of a conserved quantity; the combination for a larger one is too much work.
MOST_OF_A_QUANTITY = 100
#: Why there is no volume.
INFERRED = (
    "a density exp f of the place is kept only if X f = -θ for each field X with its divergence θ; then multiples Y of "
    "(X, -θ), and their brackets, are tangent to the graph of f, so that brackets span at most {} dimensions"
)


def rate_along(algebra: Algebra, of: sp.Expr, directions: Sequence[sp.Expr]) -> sp.Expr:
    """The derivative of an expression in letters along a change of coordinates, and of velocities."""
    pairs = zip((*algebra.system.coordinates, *algebra.system.velocities), directions, strict=False)
    return sum((algebra.letters.derivative(of, x) * d for x, d in pairs if d != 0), sp.S.Zero)


def slopes(
    algebra: Algebra, text: str, of: Sequence[tuple[sp.Expr, Sequence[sp.Expr]]], are: Sequence[sp.Expr]
) -> Equation | str:
    """That these are the derivatives of expressions, each along a direction, as a limit; of large ones the text."""
    parts = [part for pair in of for part in sp.preorder_traversal(pair)]
    is_divided = any(isinstance(part, sp.Pow) and part.exp.is_negative for part in parts)
    if len(parts) * (FRACTIONS if is_divided else 1) > MOST_PARTS:
        return text
    symbols = set().union(*(e.free_symbols for one, along in of for e in (one, *along)), *(e.free_symbols for e in are))
    small, changes = fresh("e", symbols | {*algebra.letters.meanings}), []
    for one, along in of:
        by = {x: rate_along(algebra, x, along) for x in one.free_symbols}
        changes.append(one.xreplace({x: x + small * e for x, e in by.items() if e != 0}) - one)
    symbols = set().union({small}, *(e.free_symbols for e in (*changes, *are)))
    return tends(text, changes, small, 1, list(are), Quotient(sorted(symbols, key=str)))


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
        self.multipliers = [fresh(f"multiplier_{i + 1}", taken) for i in range(len(self.bindings))]
        self._rings: dict[tuple[sp.Symbol, ...], Quotient] = {}

    def ring(self, *expressions: sp.Expr) -> Quotient:
        """The ring of the system with further symbols of some expressions."""
        own = self.algebra.ring
        more = tuple(sorted(set().union(*(e.free_symbols for e in expressions)) - set(own.symbols), key=str))
        return self._rings.setdefault(more, Quotient((*own.symbols, *more), own.relations))

    def equal(self, text: str, left: Sequence[sp.Expr], right: Sequence[sp.Expr]) -> Equation:
        """In the ring of the system."""
        left, right = ([in_sympy(e) for e in side] for side in (left, right))
        return Equation(text, left, right, self.ring(*left, *right))

    @cached_property
    def principle(self) -> list[sp.Expr]:
        """d/dt ∂L/∂v - ∂L/∂q - F - Aᵀλ, of any acceleration and multipliers."""
        held = self.algebra.rows.T * sp.Matrix(self.multipliers) if self.multipliers else sp.zeros(len(self.q), 1)
        units, rate = sp.eye(len(self.q)).tolist(), self.rate
        leaning = [rate(p, self.now) - rate(self.lagrangian, e) for p, e in zip(self.momenta, units, strict=True)]
        return [e - f - r for e, f, r in zip(leaning, self.forces, held, strict=True)]

    def rate(self, of: sp.Expr, directions: Sequence[sp.Expr]) -> sp.Expr:
        """The derivative of an expression along a change of coordinates and velocities."""
        return rate_along(self.algebra, of, directions)

    @property
    def now(self) -> list[sp.Expr]:
        """The rates of coordinates and velocities, any acceleration."""
        return [*self.v, *self.acceleration]

    @cached_property
    def solved(self) -> list[sp.Expr]:
        """The accelerations."""
        x, first, inner, pushed = self.along
        found = first + x * (adjugate(inner) * pushed) / determinant(inner)
        return [self.algebra.ring.reduced(e.xreplace(self.allowed)) for e in found]

    @cached_property
    def equations(self) -> tuple[sp.Matrix, sp.Matrix]:
        """Matrix and right side of the equations for accelerations and multipliers, of independent constraints."""
        rows = self.algebra.rows.extract(self.kept, list(range(len(self.q))))
        matrix = self.mass.row_join(-rows.T).col_join(rows.row_join(sp.zeros(len(self.kept))))
        return matrix, self.forced.col_join(self.turning.extract(self.kept, [0]))

    def in_motion(self, of: sp.Expr) -> sp.Expr:
        """The rate of an expression in the motion."""
        return self.rate(of, [*self.v, *self.solved])

    @cached_property
    def premises(self) -> list[str]:
        """The meanings of the letters, and the system."""
        meanings, bound = self.algebra.letters.meanings, ", ".join(map(str, self.allowed))
        return [
            *(f"{x} is {value}" for x, value in self.system.parameters.items()),
            *(f"{letter} is {stands}, and changes as that does" for letter, stands in meanings.items()),
            *([f"the constraints bind {bound}, which the other velocities determine"] if bound else []),
            *(text for text in (f"L is {self.lagrangian}", f"A v + b is {self.bindings}") if len(text) < MOST_LETTERS),
        ]


def certified(system: System, methods: Sequence[str] = ()) -> Iterator[Certified]:
    """The exact verdicts on a system and on methods, each with its certificate or the reason why it has none.

    Parameters
    ----------
    system : System
    methods : sequence of str, optional
        Names of METHODS.

    Yields
    ------
    Certified
        A property that `verdicts` leaves `measured` is not among them.

    Examples
    --------
    >>> from sympy import symbols
    >>> from chapsym.mechanics import System, certified, dot
    >>> x, y, z = symbols("x y z")
    >>> particle = System("particle", (x, y, z), sum(dot(q) ** 2 for q in (x, y, z)) / 2, [dot(z) - y * dot(x)])
    >>> [one.verdict for one in certified(particle) if one.certificate]
    ['motion', 'energy', 'flag', 'volume']
    """
    name, known = name_of(a_system(system)), set[str]()
    own = {"motion": _motion, "energy": _energy, "flag": _flag, "volume": _volume}
    for verdict, case_of in own.items():
        yield made(system, verdict, f"{name}-{verdict}", known, case_of, system, name)
    for i, (what, quantity) in enumerate(system.integrals.items()):
        yield made(system, what, f"{name}-integral-{i + 1}", known, _integral, system, name, what, quantity)
    for method in several(methods, "methods"):
        yield from of_method(system, method, f"{name}-{method}")


def _motion(system: System, _: str) -> Made:
    of = Moving(system)
    n, slope = len(of.q), [of.rate(of.lagrangian, unit) for unit in sp.eye(2 * len(of.q)).tolist()]
    rates = [of.rate(e, of.now) for e in (*of.momenta, *of.bindings)]
    matrix = of.mass.row_join(-of.algebra.rows.T).col_join(of.algebra.rows.row_join(sp.zeros(len(of.bindings))))
    right = list(matrix * sp.Matrix([*of.acceleration, *of.multipliers]) - sp.Matrix([*of.forced, *of.turning]))
    left, text = [*of.principle, *rates[n:]], "the equations are linear in the accelerations and multipliers"
    printed: list[Statement] = [of.equal(text, left, right), _regular(of.equations[0], of.algebra)]
    along = [(e, of.now) for e in (*of.momenta, *of.bindings)]
    derived: list[Statement | str] = [
        slopes(of.algebra, "the derivatives of L", [(of.lagrangian, of.change)], [sum(map(sp.Mul, slope, of.change))]),
        slopes(of.algebra, "d/dt of ∂L/∂v and of A v + b", along, rates),
    ]
    said = r"\frac{d}{dt}\frac{\partial L}{\partial v} - \frac{\partial L}{\partial q} = A^T\lambda + F, A v + b = 0"
    wrong = of.equal(f"{text}, with 1 more in the first", left, [right[0] + 1, *right[1:]])
    return Case(said, printed, wrong, [], derived, of.premises), of.algebra.rational


def _full(matrix: sp.Matrix, points: Iterable[Point]) -> Iterator[tuple[Point, sp.Matrix, list[int]]]:
    """Points at which the rows of a matrix are independent, the matrix there, and columns that are."""
    for point in points:
        there = matrix.xreplace(point)
        if not there.has(sp.zoo, sp.nan) and not there.free_symbols and len(columns := pivots(there)) == matrix.rows:
            yield point, there, columns


def _regular(matrix: sp.Matrix, algebra: Algebra) -> Comparison:
    """That a matrix has an inverse at a point."""
    for point, there, _ in _full(matrix, algebra.rational):
        products = zip(matrix * there.inv(), sp.eye(matrix.rows), strict=True)
        relations, at = [sp.Eq(a, b, evaluate=False) for a, b in products], {x: point[x] for x in matrix.free_symbols}
        return Comparison("they determine these at a point, where their matrix has an inverse", relations, at)
    raise BadSystem("no rational point is found where the equations of motion are regular")


def _kept(
    of: Moving, what: str, quantity: sp.Expr, balance: sp.Expr, name: str, at: Mapping[sp.Symbol, sp.Expr] | None = None
) -> Case:
    """The case on the rate of a quantity: a combination of expressions that the equations set to 0, and more."""
    rate = of.rate(quantity, of.now)
    text = f"the rate of {what} is {'what the equations set to 0' if at else '⟨F, v⟩ - ⟨b, λ⟩, and what they set to 0'}"
    derived = [slopes(of.algebra, f"the rate of {what}", [(quantity, of.now)], [rate])]
    left, right = (e.xreplace(at or {}) for e in (rate, balance))
    printed, wrong = of.equal(text, [left], [right]), of.equal(f"{text}, larger by 1", [left], [right + 1])
    return Case(text, [printed], wrong, [], derived, of.premises, [f"{name}-motion"])


def _energy(system: System, name: str) -> Made:
    of = Moving(system)
    power = sum(map(sp.Mul, of.forces, of.v)) - sum(map(sp.Mul, of.algebra.offsets, of.multipliers))
    along = sum(map(sp.Mul, of.v, of.principle)) + sum(map(sp.Mul, of.multipliers, of.bindings))
    return _kept(of, "the energy", of.energy, power + along, name), of.algebra.rational


def _integral(system: System, name: str, what: str, quantity: sp.Expr) -> Made:
    of, is_kept = Moving(system, quantity), conserved(system, quantity).kept
    (quantity,), points = of.quantities, of.algebra.rational
    if not is_kept:
        return _lost(of, what, quantity, name), points
    if sum(1 for _ in sp.preorder_traversal(quantity)) > MOST_OF_A_QUANTITY:
        raise BadSystem("it has more parts than a quantity whose factors are looked for")
    reduced, (x, _, inner, _) = of.algebra.ring.reduced, of.along
    slope = sp.Matrix([reduced(sp.diff(quantity, v).xreplace(of.allowed)) for v in of.v])
    inner, whole = inner.applyfunc(reduced), reduced(determinant(of.square))
    pushed = (adjugate(inner) * (x.T * slope).applyfunc(reduced)).applyfunc(reduced)
    along = (x * pushed / reduced(determinant(inner))).applyfunc(reduced)
    rest = (slope - of.mass * along).extract(of.bound, [0]).applyfunc(reduced)
    across = (adjugate(of.square).T * rest / whole).applyfunc(reduced)
    turning, factors = [of.rate(of.bindings[i], of.now) for i in of.kept], [*along, *across]
    balance = sum((f * e for f, e in zip(factors, (*of.principle, *turning), strict=True)), sp.S.Zero)
    return _kept(of, what, quantity, balance, name, of.allowed), points


def _lost(of: Moving, what: str, quantity: sp.Expr, name: str) -> Case:
    """An exact state of the motion where a quantity changes."""
    rate = of.rate(quantity, of.now)
    zeros = [*of.principle, *of.bindings, *(of.rate(e, of.now) for e in of.bindings)]
    matrix, right = of.equations
    bound = sp.Matrix(list(of.allowed.values()))
    for point, there, _ in _full(matrix, of.algebra.rational):
        if (values := bound.xreplace(point)).has(sp.zoo, sp.nan):
            continue
        at = point | dict(zip(of.allowed, values, strict=True)) | dict.fromkeys(of.multipliers, sp.S.Zero)
        free = [*of.acceleration, *(of.multipliers[i] for i in of.kept)]
        at |= dict(zip(free, there.LUsolve(right.xreplace(at)), strict=True))
        if rate.xreplace(at) != 0:
            state = [sp.Eq(e, 0, evaluate=False) for e in zeros]
            at = {x: v for x, v in at.items() if x in set().union(rate.free_symbols, *(e.free_symbols for e in zeros))}
            text = f"the rate of {what} is not 0 at a state of the motion"
            ends = (kind(rate, 0, evaluate=False) for kind in (sp.Eq, sp.Ne))
            wrong, said = (Comparison(text, [*state, e], at) for e in ends)
            return Case(text, [said], wrong, [], [], of.premises, [f"{name}-motion"])
    raise BadSystem("no rational state is found where it changes")


def _minor(vectors: Vectors, points: Iterable[Point]) -> tuple[sp.Expr, Point, list[int]]:
    """A minor of all vectors, a rational point where it is not 0, and its columns."""
    matrix = sp.Matrix([list(one) for one in vectors])
    for point, _, columns in _full(matrix, points):
        return determinant(matrix.extract(list(range(matrix.rows)), columns)), point, columns
    raise BadSystem("no rational point is found where the rank is the generic one")


def _not_0(text: str, minor: sp.Expr, point: Point) -> Comparison:
    return Comparison(text, [sp.Ne(minor, 0, evaluate=False)], {x: point[x] for x in minor.free_symbols})


def _bordering(
    algebra: Algebra, text: str, vectors: Vectors, columns: Sequence[int], more: Sequence[sp.Expr]
) -> list[Statement]:
    """That a vector is in a span, where one minor is not 0: those that border it are 0; nothing if that is seen."""
    matrix = sp.Matrix([*map(list, vectors), list(more)])
    others = [j for j in range(matrix.cols) if j not in columns]
    minors = [determinant(matrix.extract(list(range(matrix.rows)), [*columns, j])) for j in others]
    return [_vanish(text, minors, algebra)] if any(minors) else []


def _flag(system: System, _: str) -> Made:
    found = spanned(system)
    algebra, growth, vectors = found.algebra, found.flag.growth, found.vectors
    if not vectors:
        raise BadSystem("there is no velocity that the constraints allow")
    lemmas, rows = list[Statement](), found.rows.extract(list(found.kept), list(range(found.rows.cols))).tolist()
    if rows:
        minor, point, columns = _minor(rows, algebra.rational)
        lemmas.append(_not_0("a minor of the constraints is not 0 at a point", minor, point))
        for i in (i for i in range(found.rows.rows) if i not in found.kept):
            lemmas += _bordering(algebra, f"constraint {i + 1} depends on others", rows, columns, found.rows[i, :])
        products = list(found.rows * sp.Matrix(list(map(list, vectors[: growth[0]]))).T)
        lemmas.append(_vanish("the fields obey the constraints", products, algebra))
    names = [f"X{i + 1}" for i in range(len(vectors))]
    inside = [(f"B{i + 1}", x, of) for i, (x, of) in enumerate(found.inside)]
    brackets = [(name, x, of) for name, x, of in zip(names, vectors, found.made, strict=True) if of]
    more, derived = _brackets(algebra, names, vectors, [*brackets, *inside])
    lemmas += more
    printed = list[Statement]()
    for size in growth:
        minor, point, columns = _minor(vectors[:size], algebra.rational)
        printed.append(_not_0(f"{', '.join(names[:size])} span {size} dimensions at a point", minor, point))
    for name, x, *_parts in inside:
        printed += _bordering(algebra, f"{name} is in the span of {', '.join(names)}", vectors, columns, x)
    wrong = _vanish(f"{', '.join(names)} are dependent", [minor], algebra)
    premises = [f"{x} is {stands}, and changes as that does" for x, stands in algebra.letters.meanings.items()]
    return Case(str(found.flag), printed, wrong, lemmas, derived, premises), algebra.rational


def _vanish(text: str, what: Sequence[sp.Expr], algebra: Algebra) -> Equation:
    return Equation(text, list(what), [sp.S.Zero] * len(what), algebra.ring)


def _brackets(
    algebra: Algebra, names: Sequence[str], vectors: Vectors, made: Iterable[tuple[str, Sequence[sp.Expr], Bracketed]]
) -> tuple[list[Statement], list[Statement | str]]:
    """That vectors are brackets, but for those that are 0, and that what these are made of are derivatives."""
    lemmas, derived = list[Statement](), list[Statement | str]()
    for name, bracket, (i, j, times) in made:
        if any(bracket):
            along = [(e, vectors[i]) for e in vectors[j]], [(e, vectors[j]) for e in vectors[i]]
            parts = [[rate_along(algebra, *one) for one in half] for half in along]
            text = f"the derivatives of {names[i]} and {names[j]} along each other"
            derived.append(slopes(algebra, text, [*along[0], *along[1]], [*parts[0], *parts[1]]))
            by, sides = f"{times} " if times != 1 else "", [times * (a - b) for a, b in zip(*parts, strict=True)]
            lemmas.append(Equation(f"{name} = {by}[{names[i]}, {names[j]}]", sides, list(bracket), algebra.ring))
    return lemmas, derived


def _volume(system: System, name: str) -> Made:
    kept = volume(system)
    if not kept.by:
        raise BadSystem("nothing moves")
    if kept.density is None:
        return _no_volume(system, kept, name)
    factors = kept.density.as_powers_dict().items()
    of = Moving(system, *(factor for factor, _ in factors))
    variables, units = (*of.q, *of.v), sp.eye(2 * len(of.q)).tolist()
    field = [v.xreplace(of.allowed) for v in of.v] + of.solved
    own = [(e, unit) for x, e, unit in zip(variables, field, units, strict=True) if x in {*of.q, *kept.by}]
    spread = [of.rate(*one) for one in own]
    rates = (power * of.in_motion(e) / e for e, (_, power) in zip(of.quantities, factors, strict=True))
    rate = sum(rates, sp.S.Zero).xreplace(of.allowed)
    text = f"the divergence in {', '.join(map(str, (*of.q, *kept.by)))} is less the rate of log({kept.density})"
    if not any(spread):  # then all derivatives say more
        change = [c if x in {*of.q, *kept.by} else sp.S.Zero for x, c in zip(variables, of.change, strict=True)]
        own = [(e, change) for e, _ in own]
    derivatives = slopes(of.algebra, "the derivatives of the motion", own, [of.rate(*one) for one in own])
    printed = [of.equal(text, [sum(spread)], [-rate]), *([] if isinstance(derivatives, str) else [derivatives])]
    wrong = of.equal(f"{text}, larger by 1", [sum(spread)], [1 - rate])
    return Case(text, printed, wrong, [], [], of.premises, [f"{name}-motion"]), of.algebra.rational


def _no_volume(system: System, kept: Volume, name: str) -> Made:
    """Brackets of fields with their divergences span more than those of the fields."""
    of = Moving(system)
    algebra, most = of.algebra, flag(system).growth[-1]
    fields, spread, _, formed = divergences(of)
    vectors = []
    for field, one in zip(fields, spread, strict=True):
        above, below = sp.fraction(one)
        vectors.append(algebra.normal([*(below * e for e in field), -above]))
    names, made = [f"Y{i + 1}" for i in range(len(vectors))], list[Any]()
    newest = range(len(vectors))
    for level in range(MOST_LEVELS):
        pairs = [(i, j) for i in range(len(fields)) for j in newest if level or i < j]
        newest = range(len(vectors), len(vectors) + len(pairs))
        for i, j in pairs:
            bracket, times = algebra.cleared(bracket_of(vectors[i], vectors[j], algebra))
            made.append((f"[{names[i]}, {names[j]}]", bracket, (i, j, times)))
            names.append(made[-1][0])
            vectors.append(bracket)
        for point in algebra.rational:
            if len(rows := pivots(sp.Matrix(vectors).xreplace(point).T)) > most:
                rows = rows[: most + 1]
                minor, point, _ = _minor([vectors[i] for i in rows], [point])
                needed = set(rows)
                for k, (_, _, (i, j, _)) in reversed([*enumerate(made, len(fields))]):
                    needed |= {i, j} if k in needed else set()
                made = [one for k, one in enumerate(made, len(fields)) if k in needed]
                lemmas, derived = _brackets(algebra, names, vectors, made)
                text = f"{', '.join(names[i] for i in rows)} span {most + 1} dimensions at a point"
                lemmas.append(Equation("the divergence of each field", formed, spread, algebra.ring))
                printed, wrong = [_not_0(text, minor, point)], _vanish("they do not", [minor], algebra)
                uses = [f"{name}-motion", f"{name}-flag"]
                case = Case(str(kept), printed, wrong, lemmas, derived, of.premises, uses, INFERRED.format(most))
                return case, algebra.rational
    raise BadSystem("no rational point is found where the brackets span more")
