"""The rule that turns evidence into a verdict: nothing can assert one."""

import json

import pytest
import sympy as sp

from chapsym.derive import three
from chapsym.derive.quotient import Quotient
from chapsym.proofs.examples import EXAMPLES
from chapsym.prove import (
    Comparison,
    Equation,
    Fact,
    Proof,
    Reading,
    Theorem,
    Verdict,
    claims,
    judged,
    load,
    no,
    rational_point,
    runner,
)
from chapsym.prove.claims import Claim
from chapsym.prove.runner import downstream, explain, judge, unproved

x, y = sp.symbols("x y")
CIRCLE = Quotient((x, y), [x**2 + y**2 - 1])


def equation(left, right, text="e"):
    return Equation(text, [left], [right], CIRCLE)


TRUE, FALSE = equation(x**2, 1 - y**2, "true"), equation(x**2, 1 + y**2, "false")
ON_CIRCLE = rational_point({x: "3/5", y: "4/5"}, [equation(x**2 + y**2, sp.S.One)])
OFF_CIRCLE = rational_point({x: 1, y: 1}, [equation(x**2 + y**2, sp.S.One)])
PROVED, CONTROL = ("printed", TRUE), ("control", FALSE)
WRONG = [("printed", FALSE), CONTROL]
MENDED = [*WRONG, ("corrected", "c", TRUE)]
CERTIFICATE, ANSWER = (
    ("certificate", "c.json", "x > 0", "0" * 64, True),
    ("settle", [Reading("r", "root", "no", ("part",))]),
)
LARGE, NOT_ACCEPTED = ("assume", "x is large", x > 1), ("certificate", "d.json", "x > 1", "0", False)
STATED = [("state", Theorem((), (), (no("root"),)), "part"), ("say", "So."), ("step", no("root"), "c.json")]
SETTLED = [("lemma", TRUE), CONTROL, CERTIFICATE, *STATED, ANSWER]
#: Statements that are no equations: one with a point, where it fails, and one without.
COMPARED = [("printed", Comparison("order", [x > y], {x: 1, y: 2})), ("corrected", "c", TRUE), CONTROL]
COUNTED = [("printed", Fact("at most 4", False)), ("corrected", "at most 8", Fact("at most 8", True)), CONTROL]
FREE = Equation("printed", [x**2], [1 - y**2], Quotient((x, y)))
ONE = Equation("x = 1", x, 1, Quotient((x,)))
APART = ("counterexample", rational_point({x: 1, y: 1}))
#: What a proof says, and the verdict, or why there is none.
RULES = {
    "a printed form that is proved holds": ([PROVED, CONTROL], Verdict.HOLDS),
    "every printed form must hold": ([("printed", TRUE, FALSE), CONTROL], ""),
    "without a control": ([PROVED], "the proof has no negative control"),
    "a control that passes": ([PROVED, ("control", TRUE)], "control accepted: true"),
    "a false lemma": ([PROVED, CONTROL, ("lemma", FALSE)], ""),
    "a fact that is none": ([PROVED, CONTROL, ("lemma", Fact("1 < 0", False))], ""),
    "nothing printed": ([CONTROL], "no printed form was judged"),
    "a correction without a counterexample": (MENDED, ""),
    "a correction": ([*MENDED, ("counterexample", ON_CIRCLE)], Verdict.CORRECTED),
    "a correction that is not proved": (
        [*WRONG, ("corrected", "c", equation(x, y)), ("counterexample", rational_point({x: "3/5", y: "3/5"}))],
        "",
    ),
    "an answer": (SETTLED, Verdict.SETTLED),
    "an answer without a lemma": (SETTLED[1:], "the answer has no lemma that is decided"),
    "an answer without a control": ([SETTLED[0], *SETTLED[2:]], "the proof has no negative control"),
    "an answer without its step": ([*SETTLED[:5], ANSWER], "not answered: part is not proved, or states nothing"),
    "an answer without its sentence": ([*SETTLED[:4], *SETTLED[5:]], "not answered: part is not proved"),
    "an answer with a false lemma": ([*SETTLED, ("lemma", FALSE)], ""),
    "an answer with a control that passes": ([*SETTLED, ("control", TRUE)], ""),
    "an answer that is left open": ([*SETTLED, ("leave_open", "a polynomial")], Verdict.OPEN),
    "with a certificate that is refused": ([*SETTLED, NOT_ACCEPTED], "does not accept d.json"),
    "evidence and conjectures": ([("lemma", TRUE), CONTROL, ("measure", "1"), ("conjecture", "2")], "no printed form"),
    "a counterexample off the hypotheses": ([*MENDED, ("counterexample", OFF_CIRCLE)], "violates the hypothesis"),
    "a counterexample off it": ([LARGE, *MENDED, ("counterexample", ON_CIRCLE)], "violates the hypothesis x is large"),
    "no counterexample": ([*MENDED, ("counterexample", rational_point({x: 1, y: 0}))], "does not contradict the"),
    "a false form": (WRONG, "not proved as printed: false; if it is false, give p.counterexample a point where it"),
    "a false form without a correction": ([*WRONG, ("counterexample", ON_CIRCLE)], Verdict.REFUTED),
    "a form under a condition": ([("printed", FREE), APART, ("under", "a norm", TRUE), CONTROL], Verdict.CONDITIONAL),
    "false at its witness": ([PROVED, CONTROL, ("witness", "other", {}, FALSE)], "fails at its witness (other): false"),
    "a second route": ([PROVED, CONTROL, ("route", "another", TRUE)], Verdict.HOLDS),
    "a second route that differs": ([PROVED, CONTROL, ("route", "another", FALSE)], "the second route fails: another"),
    "a second route of nothing": ([PROVED, CONTROL, ("route", "none")], ""),
    "a comparison that fails": (COMPARED, Verdict.CORRECTED),
    "a comparison off what was assumed": ([LARGE, *COMPARED], "violates the hypothesis x is large"),
    "what is false and has no point": (COUNTED, ""),
    "a counterexample that lacks a value": (
        [("assume", "x is a square", sp.Eq(x, y**2)), ("printed", ONE), ("counterexample", rational_point({x: -4}))],
        "the counterexample has no value for y, of the hypothesis x is a square",
    ),
    "an error that is none": ([("slips", "typo"), PROVED, CONTROL], "called an error, and all that is printed holds"),
    "a definition": ([("define", "it names"), CONTROL], Verdict.DEFINITION),
    "a definition without a control": ([("define", "it names")], ""),
}


@pytest.mark.parametrize("rule", RULES)
def test_what_is_said_makes_the_verdict(rule):
    said, expected = RULES[rule]
    proof = Proof()
    proof.witness("generic", {"x": "3/5", "y": "4/5"})
    for name, *arguments in said:
        getattr(proof, name)(*arguments)
    if isinstance(expected, Verdict):
        assert (proof.verdict(), proof.problems) == (expected, [])
    else:
        assert proof.verdict() is Verdict.OPEN
        assert expected in proof.problems[0]


def test_what_is_said_may_be_any_object_and_a_record_is_text():
    """Of a claim of one's own: a number or an expression where text is expected."""
    proof = Proof()
    proof.lemma(TRUE)
    proof.control(FALSE)
    for name in ("say", "measure", "conjecture", "define", "assume"):
        getattr(proof, name)(x)
    proof.witness("circle", {x: sp.Rational(3, 5)})
    claim = Claim("9.9", "x", (), lambda p: None)
    record = claims.Judgement(claim, proof.verdict(), proof, 0.0).record()
    assert json.loads(json.dumps(record))["evidence"]["measured"] == ["x"]


def test_a_settled_question_is_proved_and_explained():
    def settles(p):
        """Title."""
        for name, *arguments in SETTLED:
            getattr(p, name)(*arguments)
        p.measure("1e-28")
        p.conjecture("never")

    record = judge(Claim("9.9", "x?", (), settles)).record()
    record["evidence"]["fingerprint"] = "0"
    assert record["verdict"] == "settled"
    assert unproved([record]) == []
    assert not record["evidence"]["open_in_paper"]
    lines = explain(record).splitlines()
    assert "  ✓ certificate c.json: x > 0" in lines
    assert lines[-6:-4] == ["  ANSWER to: r", "    No. there is no root (part)."]
    assert lines[-3:-1] == ["  measured, not proved: 1e-28", "  conjecture: never"]


@pytest.mark.parametrize("said", ["text", equation(x, x, 7)])
def test_what_is_no_statement_is_told_in_one_line(said):
    for name in ("printed", "control"):
        with pytest.raises(
            TypeError, match=r"a statement has a text and is decided, such as equal\('x = y', x, y\); this is"
        ):
            getattr(Proof(), name)(said)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: Quotient((sp.Symbol("β"),)), "the symbol β must have a name in ASCII"),
        (lambda: Comparison("order", [sp.Integer(1) < 2]), "is True already; write it with symbols, and a point"),
        (lambda: Equation("e", [x, y], [x], CIRCLE), "2 and 1 entries"),
        (lambda: Equation("e", [], [], CIRCLE), "0 and 0 entries"),
        (lambda: equation(sp.sqrt(2) * x, x).at(ON_CIRCLE.evaluate), "not a rational number"),
        (lambda: Proof().corrected(equation(x, x)), "takes the corrected formula, a text"),
        (lambda: Proof().slips("big"), "a slip is one of serious, typo"),
        (lambda: Proof(uses=("2.1",)).slips("typo", "9.9"), r"9\.9 is not in uses"),
    ],
)
def test_what_cannot_be_said_is_refused(call, said):
    with pytest.raises((TypeError, ValueError, ArithmeticError), match=said):
        call()


def test_what_a_proof_rests_on_is_proved_anew(monkeypatch):
    def fails(p):
        """Title."""
        p.printed(FALSE)

    load()
    monkeypatch.setitem(claims._REGISTER, "2.1", Claim("2.1", "x", (), fails))
    assert judged("2.2").holds()
    assert not judged("2.1").holds()


def test_all_that_is_proved_together_is_proved_once(monkeypatch):
    """A lemma is not run again by the claims that rest on it, in one process, and only until that is over."""
    ran = []

    def lemma(p):
        """Title."""
        ran.append(1)
        p.printed(TRUE)
        p.control(FALSE)

    def rests(p):
        """Title."""
        p.lemma(judged("lemma"))

    claims_of = {id: Claim(id, "x", (), proof) for id, proof in (("lemma", lemma), ("a", rests), ("b", rests))}
    for id, one in claims_of.items():
        monkeypatch.setitem(claims._REGISTER, id, one)
    monkeypatch.setattr(runner.Register, "load", lambda self, lemmas=False: claims_of)
    monkeypatch.setattr(runner, "fingerprint", lambda claim: "")
    runner.prove_all(["a", "lemma", "b"], jobs=1)
    assert len(ran) == 1
    runner.prove_all(["lemma"], jobs=1)
    assert judged("lemma").holds()
    assert len(ran) == 3


def test_a_statement_needs_a_point_where_its_hypotheses_hold():
    nowhere = Quotient((x, y), [x**2 + y**2 + 1])
    proof = Proof()
    proof.printed(Equation("true", x**2, -1 - y**2, nowhere))
    proof.control(Equation("false", x**2, y**2, nowhere))
    assert proof.verdict() is Verdict.OPEN
    assert proof.problems == [
        "no witness: it is not shown that the hypotheses can hold; give p.witness a point where they do, "
        "or the algebra of words an example"
    ]


def test_a_point_is_found_for_symbols_that_are_in_no_table():
    others = sp.symbols("psi zeta")
    ring = Quotient(others, [others[0] ** 2 + others[1] ** 2 - 1])
    proof = Proof()
    proof.printed(Equation("ψ² = 1 - ζ²", others[0] ** 2, 1 - others[1] ** 2, ring))
    proof.control(Equation("ψ = 1 - ζ", others[0], 1 - others[1], ring))
    assert proof.verdict() is Verdict.HOLDS
    (seen,) = proof.witnesses
    point = {name: sp.Rational(value) for name, value in seen["point"].items()}
    assert seen["statements"] == 1
    assert point["psi"] ** 2 + point["zeta"] ** 2 == 1


def test_a_witness_is_a_point_where_what_is_assumed_holds():
    J1 = sp.Symbol("J1")
    for relations, witnesses in (((J1 > 0,), 2), ((J1 < 0,), 1), ((J1 > 0, J1 < 0), 0)):
        proof = Proof(examples=EXAMPLES)
        proof.assume("the sign of J1", *relations)
        proof.printed(Equation("shown", J1, J1, Quotient((J1,))))
        proof.control(FALSE)
        assert proof.verdict() is (Verdict.HOLDS if witnesses else Verdict.OPEN)
        assert len(proof.witnesses) == witnesses  # generic, and equal J; one that is drawn; none


def test_the_table_of_witnesses_contradicts_a_wrong_decision():
    """An algebra that accepts everything is caught where its symbols have values."""

    class Gullible(Quotient):
        def is_zero(self, expr):
            return True

    ring = Gullible(three.RING.symbols, three.RING.relations)
    proof = Proof(examples=EXAMPLES)
    proof.printed(Equation("q₀ = 0", [three.q0], [sp.S.Zero], ring))
    proof.control(FALSE)
    assert proof.verdict() is Verdict.OPEN
    assert "fails at its witness: q₀ = 0 (generic)" in proof.problems


def test_degenerate_cases_are_looked_at_where_they_are_allowed():
    proof = Proof(examples=EXAMPLES)
    proof.printed(Equation("|q|² = 1 - q₀²", [three.q.dot(three.q)], [1 - three.q0**2], three.RING))
    proof.control(FALSE)
    assert proof.verdict() is Verdict.HOLDS
    assert [seen["name"] for seen in proof.witnesses] == ["generic", "equal J", "D = 0", "q = 0"]
    proof = Proof()
    proof.printed(TRUE)
    proof.lemma(TRUE)
    assert [check["statement"] for check in proof.checks] == ["printed: true", "true"]


def test_an_open_question_of_the_paper_is_no_failed_proof():
    def question(p):
        """A question."""
        p.leave_open("this was tried")

    def failed(p):
        """A failure."""
        p.leave_open("this was tried")
        p.lemma(FALSE)

    records = [judge(Claim(id, "x", (), proof)).record() for id, proof in [("1", question), ("2", failed)]]
    assert [record["verdict"] for record in records] == ["open", "open"]
    assert unproved(records) == ["2"]
    assert "tried: this was tried" in explain(records[0])


def test_a_zero_matrix_may_be_written_as_the_number_0():
    point = rational_point({x: 1})
    for left, right in ((sp.eye(2) * x, sp.S.Zero), (sp.S.Zero, sp.eye(2) * x)):
        one, other = Equation("e", [left], [right], CIRCLE).at(lambda expr: expr.subs({x: 1}))
        assert {*one, *other} == {"[[1, 0], [0, 1]]", "[[0, 0], [0, 0]]"}
    assert point.failures() == []


def test_a_proof_that_raises_leaves_the_claim_open_with_the_place():
    def broken(p):
        """Broken."""
        raise ArithmeticError("a\nb\n  c")

    def leaves(p):
        """Leaves."""
        raise SystemExit(0)

    assert judge(Claim("0.0", "x", (), leaves)).record()["verdict"] == "open"
    record = judge(Claim("0.0", "x", (), broken)).record()
    assert record["verdict"] == "open"
    assert record["evidence"]["problems"][0].startswith("the proof raised ArithmeticError: a b c (test_claims.py:")
    assert "PROBLEM" in explain(record)


def test_downstream_follows_uses_through_others():
    claims = {
        id: Claim(id, "", uses, lambda p: None) for id, uses in [("a", ()), ("b", ("a",)), ("c", ("b",)), ("d", ())]
    }
    assert downstream("a", claims) == ["b", "c"]


def test_what_is_inferred_and_the_kind_of_an_error_are_explained(all_judged):
    record, _ = all_judged.records["5.15"]
    lines = explain(record).splitlines()
    assert "  kind of error, by our judgement: serious, follows from 5.14" in lines
    assert [line for line in lines if line.startswith("  inferred in words: T = 0 is equivalent to the map")]
