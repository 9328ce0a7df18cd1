"""The rule that turns evidence into a verdict: nothing can assert one."""

import pytest
import sympy as sp

from chapsym.derive import three
from chapsym.derive.quotient import Quotient
from chapsym.prove import Equation, Fact, Proof, Verdict, claim, claims, judged, load, rational_point
from chapsym.prove.claims import Claim
from chapsym.prove.runner import downstream, explain, judge, unproved

x, y = sp.symbols("x y")
CIRCLE = Quotient((x, y), [x**2 + y**2 - 1])


def equation(left, right, text="e"):
    return Equation(text, [left], [right], CIRCLE)


TRUE, FALSE = equation(x**2, 1 - y**2, "true"), equation(x**2, 1 + y**2, "false")
ON_CIRCLE = rational_point({x: "3/5", y: "4/5"}, [equation(x**2 + y**2, sp.S.One)])
OFF_CIRCLE = rational_point({x: 1, y: 1}, [equation(x**2 + y**2, sp.S.One)])


def verdict(*actions):
    proof = Proof()
    proof.witness("generic", {"x": "3/5", "y": "4/5"})
    for name, *arguments in actions:
        getattr(proof, name)(*arguments)
    return proof.verdict(), proof.problems


def test_a_printed_form_that_is_proved_holds():
    assert verdict(("printed", TRUE), ("control", FALSE)) == (Verdict.HOLDS, [])


def test_every_printed_form_must_hold():
    assert verdict(("printed", TRUE, FALSE), ("control", FALSE))[0] is Verdict.OPEN


def test_without_a_control_nothing_is_proved():
    assert verdict(("printed", TRUE)) == (Verdict.OPEN, ["the proof has no negative control"])


def test_a_control_that_passes_breaks_the_proof():
    result, problems = verdict(("printed", TRUE), ("control", TRUE))
    assert result is Verdict.OPEN
    assert problems == ["control accepted: true"]


def test_a_false_lemma_breaks_the_proof():
    assert verdict(("printed", TRUE), ("control", FALSE), ("lemma", FALSE))[0] is Verdict.OPEN
    assert verdict(("printed", TRUE), ("control", FALSE), ("lemma", Fact("1 < 0", False)))[0] is Verdict.OPEN


def test_nothing_printed_is_nothing_judged():
    assert verdict(("control", FALSE))[1] == ["no printed form was judged"]


def test_a_correction_needs_a_counterexample():
    steps = [("printed", FALSE), ("corrected", "c", TRUE), ("control", FALSE)]
    assert verdict(*steps)[0] is Verdict.OPEN
    assert verdict(*steps, ("counterexample", ON_CIRCLE))[0] is Verdict.CORRECTED


def test_a_correction_must_be_proved():
    steps = [("printed", FALSE), ("corrected", "c", equation(x, y)), ("control", FALSE)]
    assert verdict(*steps, ("counterexample", rational_point({x: "3/5", y: "3/5"})))[0] is Verdict.OPEN


def test_a_question_is_settled_by_an_answer_and_what_proves_it():
    steps = [("lemma", TRUE), ("control", FALSE), ("certificate", "c.json", "x > 0", "0", True), ("settle", "No.")]
    assert verdict(*steps) == (Verdict.SETTLED, [])
    assert verdict(*steps[1:]) == (Verdict.OPEN, ["the answer has no lemma that is decided"])
    assert verdict(steps[0], *steps[2:]) == (Verdict.OPEN, ["the proof has no negative control"])
    assert verdict(*steps, ("lemma", FALSE))[0] is Verdict.OPEN
    assert verdict(*steps, ("control", TRUE))[0] is Verdict.OPEN
    assert verdict(*steps, ("leave_open", "a polynomial"))[0] is Verdict.OPEN
    rejected = ("certificate", "d.json", "x > 1", "0", False)
    assert verdict(*steps, rejected) == (Verdict.OPEN, ["the checker does not accept d.json"])


def test_evidence_and_conjectures_settle_nothing():
    steps = [("lemma", TRUE), ("control", FALSE), ("measure", "1e-28"), ("conjecture", "never")]
    assert verdict(*steps) == (Verdict.OPEN, ["no printed form was judged"])


def test_a_settled_question_is_proved_and_explained(monkeypatch):
    def settles(p):
        """Title."""
        p.lemma(TRUE)
        p.control(FALSE)
        p.certificate("c.json", "x > 0", "0", True)
        p.settle("No.")
        p.measure("1e-28")
        p.conjecture("never")

    record = judge(Claim("9.9", "x?", (), settles)).record()
    record["evidence"]["fingerprint"] = "0"
    assert record["verdict"] == "settled"
    assert unproved([record]) == []
    assert not record["evidence"]["open_in_paper"]
    lines = explain(record).splitlines()
    assert "  ✓ certificate c.json: x > 0" in lines
    assert lines[-4:-1] == ["  ANSWER: No.", "  measured, not proved: 1e-28", "  conjecture: never"]


def test_what_a_proof_rests_on_is_proved_anew(monkeypatch):
    def fails(p):
        """Title."""
        p.printed(FALSE)

    load()
    monkeypatch.setitem(claims._REGISTER, "2.1", Claim("2.1", "x", (), fails))
    assert judged("2.2").holds()
    assert not judged("2.1").holds()


def test_a_counterexample_must_satisfy_the_hypotheses():
    steps = [("printed", FALSE), ("corrected", "c", TRUE), ("control", FALSE), ("counterexample", OFF_CIRCLE)]
    result, problems = verdict(*steps)
    assert result is Verdict.OPEN
    assert "violates the hypothesis" in problems[0]


def test_a_counterexample_must_contradict_the_printed_form():
    where = rational_point({x: 1, y: 0})
    result, problems = verdict(
        ("printed", FALSE), ("corrected", "c", TRUE), ("control", FALSE), ("counterexample", where)
    )
    assert result is Verdict.OPEN
    assert problems == ["the counterexample does not contradict the printed form"]


def test_a_false_form_without_a_correction_is_refuted():
    assert verdict(("printed", FALSE), ("control", FALSE), ("counterexample", ON_CIRCLE))[0] is Verdict.REFUTED


def test_a_form_that_needs_a_hypothesis_is_conditional():
    free = Quotient((x, y))
    printed = Equation("printed", [x**2], [1 - y**2], free)
    point = rational_point({x: 1, y: 1})
    proof = Proof()
    proof.printed(printed)
    proof.counterexample(point)
    proof.under("|x|² + |y|² = 1", TRUE)
    proof.control(FALSE)
    assert proof.verdict() is Verdict.CONDITIONAL


def test_a_statement_needs_a_point_where_its_hypotheses_hold():
    proof = Proof()
    proof.printed(TRUE)
    proof.control(FALSE)
    assert proof.verdict() is Verdict.OPEN
    assert proof.problems == ["no witness: it is not shown that the hypotheses can hold"]


def test_a_statement_that_is_false_at_its_witness_breaks_the_proof():
    result, problems = verdict(("printed", TRUE), ("control", FALSE), ("witness", "other", {}, FALSE))
    assert result is Verdict.OPEN
    assert problems == ["fails at its witness (other): false"]


def test_the_table_of_witnesses_contradicts_a_wrong_decision():
    """An algebra that accepts everything is caught where its symbols have values."""

    class Gullible(Quotient):
        def is_zero(self, expr):
            return True

    ring = Gullible(three.RING.symbols, three.RING.relations)
    proof = Proof()
    proof.printed(Equation("q₀ = 0", [three.q0], [sp.S.Zero], ring))
    proof.control(FALSE)
    assert proof.verdict() is Verdict.OPEN
    assert "fails at its witness: q₀ = 0 (generic)" in proof.problems


def test_degenerate_cases_are_looked_at_where_they_are_allowed():
    proof = Proof()
    proof.printed(Equation("|q|² = 1 - q₀²", [three.q.dot(three.q)], [1 - three.q0**2], three.RING))
    proof.control(FALSE)
    assert proof.verdict() is Verdict.HOLDS
    assert [seen["name"] for seen in proof.witnesses] == ["generic", "equal J", "D = 0", "q = 0"]


def test_a_second_route_must_agree():
    steps = [("printed", TRUE), ("control", FALSE)]
    assert verdict(*steps, ("route", "another", TRUE))[0] is Verdict.HOLDS
    assert verdict(*steps, ("route", "another", FALSE)) == (Verdict.OPEN, ["the second route fails: another"])
    assert verdict(*steps, ("route", "none"))[0] is Verdict.OPEN


def test_a_printed_statement_that_is_no_equation():
    claimed, found = Fact("at most 4", False), Fact("at most 8", True)
    steps = [("printed", claimed), ("corrected", "at most 8", found), ("control", FALSE)]
    assert verdict(*steps, ("refute", {"J": "1"}, "count", 6, "at most 4", False))[0] is Verdict.CORRECTED
    assert verdict(*steps)[0] is Verdict.OPEN
    assert verdict(*steps, ("refute", {"J": "1"}, "count", 4, "at most 4", True))[0] is Verdict.OPEN


def test_the_checks_say_what_was_decided():
    proof = Proof()
    proof.printed(TRUE)
    proof.lemma(TRUE)
    assert [check["statement"] for check in proof.checks] == ["printed: true", "true"]


def test_a_definition_says_why_nothing_is_decided_and_has_a_control():
    assert verdict(("define", "it names"), ("control", FALSE))[0] is Verdict.DEFINITION
    assert verdict(("define", "it names"))[0] is Verdict.OPEN


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


def test_irrational_counterexamples_are_refused():
    with pytest.raises(ArithmeticError, match="not a rational number"):
        equation(sp.sqrt(2) * x, x).at(ON_CIRCLE.evaluate)


def test_sides_of_different_length_are_refused():
    with pytest.raises(ValueError, match="2 and 1 entries"):
        Equation("e", [x, y], [x], CIRCLE)
    with pytest.raises(ValueError, match="0 and 0 entries"):
        Equation("e", [], [], CIRCLE)


def test_a_zero_matrix_may_be_written_as_the_number_0():
    point = rational_point({x: 1})
    for left, right in ((sp.eye(2) * x, sp.S.Zero), (sp.S.Zero, sp.eye(2) * x)):
        one, other = Equation("e", [left], [right], CIRCLE).at(lambda expr: expr.subs({x: 1}))
        assert {*one, *other} == {"[[1, 0], [0, 1]]", "[[0, 0], [0, 0]]"}
    assert point.failures() == []


def test_a_proof_that_raises_leaves_the_claim_open_with_the_place():
    def broken(p):
        """Broken."""
        raise ArithmeticError("no")

    def leaves(p):
        """Leaves."""
        raise SystemExit(0)

    assert judge(Claim("0.0", "x", (), leaves)).record()["verdict"] == "open"
    record = judge(Claim("0.0", "x", (), broken)).record()
    assert record["verdict"] == "open"
    assert "ArithmeticError: no (test_claims.py:" in record["evidence"]["problems"][0]
    assert "PROBLEM" in explain(record)


def test_two_proofs_of_one_claim_are_refused(monkeypatch):
    monkeypatch.setattr("chapsym.prove.claims._REGISTER", {})
    claim("prop-4", "x")(lambda p: None)
    with pytest.raises(ValueError, match="two proofs"):
        claim("prop-4", "x")(lambda p: None)


def test_downstream_follows_uses_through_others():
    claims = {
        id: Claim(id, "", uses, lambda p: None) for id, uses in [("a", ()), ("b", ("a",)), ("c", ("b",)), ("d", ())]
    }
    assert downstream("a", claims) == ["b", "c"]


def test_the_quotient_knows_its_hypotheses():
    assert CIRCLE.is_zero(x**2 + y**2 - 1)
    assert not CIRCLE.is_zero(x**2 + y**2 + 1)
    assert CIRCLE.is_zero((1 - y**2) / x - x)
    assert Quotient((x, y), [*CIRCLE.relations, x - y]).is_zero(2 * x**2 - 1)
    with pytest.raises(ZeroDivisionError, match="zero under the hypotheses"):
        CIRCLE.is_zero(1 / (x**2 + y**2 - 1))
