"""The exact verdicts on methods as claims: combinations of the equations of a step, and series of two steps."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import sympy as sp
from flint import fmpq, fmpq_poly, fmpq_series

from chapsym.derive import Quotient
from chapsym.numbers.precisions import flint_terms
from chapsym.prove import Comparison, Equation, Identity
from chapsym.prove.polynomials import Ratio, parameters
from chapsym.prove.statements import Statement

from .cases import MOST_LETTERS, SAID, Case, Certified, Made, fresh, made
from .judged import BEYOND, VOLUMES, Combination, Decided, Judged, decided, quantities_of, tableau_conditions
from .lab import keeps
from .methods import Scheme, scheme_of
from .series import Series, State, _at, evaluated, replaced
from .system import STEP, BadSystem, System

#: Cells of a method in the ids of its claims.
CELLS = {"order": "order", "self-adjoint": "adjoint", "reversible": "returns"} | {
    f"keeps {name}": "volume" for name in VOLUMES
}
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
    of += [
        (f"after a step {x.xreplace(names)} is", str(e.xreplace(names)))
        for x, e in zip(scheme.state, scheme.after, strict=True)
    ]
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
                rates_of = zip(*made, strict=True)
                sums = [sum(map(sp.Mul, scheme.stages[i], of), sp.S.Zero) for of in rates_of]
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
