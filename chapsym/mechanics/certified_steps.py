"""The exact verdicts on methods as claims: combinations of the equations of a step, and series of two steps."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import sympy as sp
from flint import fmpq, fmpq_poly, fmpq_series

from chapsym.derive import Quotient
from chapsym.prove import Comparison, Equation, Identity
from chapsym.prove.polynomials import parameters
from chapsym.prove.statements import Statement

from .cases import MOST_LETTERS, SAID, Case, Certified, Made, fresh, made
from .judged import Combination, Decided, decided, quantities_of, tableau_conditions
from .lab import keeps
from .methods import METHODS, Scheme
from .series import Exact, _at, evaluated, replaced, terms
from .system import STEP, BadSystem, System

#: Cells of a method in the ids of its claims.
CELLS = {"order": "order", "self-adjoint": "adjoint", "reversible": "returns"}
#: What has more parts is shown by what comes out of it.
MOST_SHOWN = 4000


def of_method(system: System, method: str, name: str) -> Iterator[Certified]:
    """The exact verdicts on a method, as `certified` has them."""
    scheme, known = METHODS[method].scheme(system), set[str]()
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
    if quantity is None:
        raise BadSystem("the series of the exact motion and of a step back are not written down")
    return _changed(system, scheme, quantity, what, found), ()


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
    """What a method does is a combination of what its equations, constraints and the motion set to 0."""
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

    def read(expressions: Iterable[sp.Expr]) -> list[Any]:
        return [unit * 0 + e for e in evaluated(expressions, values, lambda p, q: unit * int(p) / (unit * int(q)))]

    values |= dict(zip(at, read(ends), strict=True))
    first, *rest = read(left)
    sums = [sum((c * e for c, e in zip(*map(read, zip(*row, strict=True)), strict=True)), unit * 0) for row in rows]
    return Identity(text, [first + more, *rest], sums)


def _rational(c: fmpq) -> sp.Rational:
    return sp.Rational(int(c.p), int(c.q))


def _changed(system: System, scheme: Scheme, quantity: sp.Expr, what: str, found: Decided) -> Case:
    """That a quantity changes, by the series of two steps from the exact state: polynomials in h, up to a power."""
    if scheme.stages:
        raise BadSystem("the series of the stages are not written down")
    exact, most, text = Exact(system), found.by + 2, f"below h^{found.by + 2}"
    ring, symbols = Quotient([STEP], [STEP**most]), (*scheme.state, *scheme.unknowns)

    def polynomial(x: Any) -> sp.Expr:
        return sum((_rational(_at(x, k)) * STEP**k for k in range(most)), sp.S.Zero)

    def wave(of: sp.Expr) -> sp.Expr:
        coefficients = [sp.Poly(of.args[0], STEP).nth(k) for k in range(most)]
        value = fmpq_series([fmpq(int(c.p), int(c.q)) for c in coefficients])
        return polynomial(evaluated([of.func(STEP)], {STEP: value})[0])

    def equal(text: str, left: Sequence[sp.Expr], right: Sequence[sp.Expr]) -> Equation:
        """With all that is beyond, which is shorter so than as a cofactor."""
        beyond = [evaluated([e], {STEP: fmpq_poly([0, 1])}, lambda p, q: fmpq_poly([fmpq(p, q)]))[0] for e in left]
        later = [sum((_rational(c) * STEP**k for k, c in enumerate(list(e)) if k >= most), sp.S.Zero) for e in beyond]
        return Equation(text, left, [a + b for a, b in zip(right, later, strict=True)], ring)

    with terms(most):
        read = [exact.read(e) for e in (scheme.residual, scheme.after, (*scheme.place, *scheme.velocity), [quantity])]
        first, there, *unknowns = ([polynomial(x) for x in one] for one in found.steps)
        states = [dict(zip(symbols, (*x, *z), strict=True)) for x, z in zip((first, there), unknowns, strict=True)]
        steps = [replaced(read[0], state, wave) for state in states]
        seen = [map(sp.expand, replaced(read[2], state, wave)) for state in states]
        values = [replaced(read[3], dict(zip(exact.symbols, at, strict=True)), wave)[0] for at in seen]
        before, later = (evaluated([e], {STEP: fmpq_series([0, 1])})[0] for e in values)
        change = polynomial(later - before)
        ends = replaced(read[1], states[0], wave)
    lemmas = [
        equal(f"the equations of a step, {text}", steps[0], [sp.S.Zero] * len(steps[0])),
        equal(f"what comes after it, {text}", ends, there),
        equal(f"the equations of the next step, {text}", steps[1], [sp.S.Zero] * len(steps[1])),
    ]
    said = f"{what.removeprefix('keeps ')} changes in a step, {text}"
    names = _named(symbols)
    premises = [f"at the exact state {x} is {v}" for x, v in found.verdict.point.items()]
    premises += ["h is step_length; of sines and cosines it is the series, of angles from the exact state"]
    premises += _steps_in_words(scheme, names)
    printed, wrong = (
        equal(f"{said}{more}", [values[1] - values[0]], [e]) for more, e in (("", change), (" by 0", 0 * STEP))
    )
    return Case(f"{system.name}: {said}", [printed], wrong, lemmas, premises=premises)
