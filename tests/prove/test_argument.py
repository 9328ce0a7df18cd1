"""Statements as data: the steps between hypotheses and conclusions, and the answers that lemmas make together."""

from dataclasses import replace

import pytest
import sympy as sp

from chapsym.derive.quotient import Quotient
from chapsym.prove import Equation, Proof, Reading, Theorem, no, there_is
from chapsym.prove.argument import (
    BY_HAND,
    MACHINE_CHECKED,
    NO,
    OPEN,
    YES,
    Gap,
    Grounds,
    Step,
    assembled,
    gaps,
    sentences,
    settlement,
)
from chapsym.prove.claims import Claim, Judgement
from chapsym.prove.runner import explain

x = sp.Symbol("x")
TRUE = Equation("x = x", x, x, Quotient((x,)))
FALSE = Equation("x = 2x", x, 2 * x, Quotient((x,)))

STATED = Theorem(("for all x",), ("x > 0",), (no("root"),))
STEPS = [Step("x² > 0", ("x > 0", "lemma"), 1, ()), Step(no("root"), ("x² > 0", "for all x"), 2, ("a check",))]
READING = Reading("real x", "root", NO, ("first", "second"))
LEMMAS = {
    "first": Theorem(("for all x",), ("x > 0", "x < 9"), ("x² > 0",)),
    "second": Theorem((), ("x > 0", "x² > 0", "y = 0"), (no("root"), "more")),
}


@pytest.mark.parametrize(
    ("texts", "number"),
    [
        ([], 0), (["  "], 0), (["One."], 1), (["One, which goes", "on. Two:"], 2), (["2. Two. By 3.5 of (4.1)"], 2),
        (["1. The circle.  It is round"], 2), (["no stop"], 1),
    ],
)  # fmt: skip
def test_sentences_are_counted_by_their_ends(texts, number):
    assert sentences(texts) == number


@pytest.mark.parametrize(
    ("theorem", "steps", "known", "said"),
    {
        "no lemma": (STATED, STEPS, (), "«x² > 0» needs «lemma», which nothing gives"),
        "the other lemma": (STATED, STEPS, ("other",), "«x² > 0» needs «lemma»"),
        "no hypothesis": (replace(STATED, hypotheses=()), STEPS, ("lemma",), "needs «x > 0», which nothing gives"),
        "no quantifier": (replace(STATED, quantifiers=()), STEPS, ("lemma",), "needs «for all x», which nothing"),
        "an idle hypothesis": (replace(STATED, hypotheses=("x > 0", "y")), STEPS, ("lemma",), "«y» is used by no step"),
        "negated": (replace(STATED, conclusions=(there_is("root"),)), STEPS, ("lemma",), "is concluded by no step"),
        "assumed": (replace(STATED, conclusions=("x > 0",)), STEPS, ("lemma",), "«x > 0» is concluded by no step"),
        "first step": (STATED, STEPS[1:], ("lemma",), "needs «x² > 0», which nothing gives"),
        "last step": (STATED, STEPS[:1], ("lemma",), "«there is no root» is concluded by no step"),
        "another order": (STATED, STEPS[::-1], ("lemma",), "needs «x² > 0», which nothing gives"),
        "no sentence": (STATED, [STEPS[0], replace(STEPS[1], sentences=0)], ("lemma",), "no sentence carries «there"),
    }.values(),
)  # fmt: skip
def test_what_does_not_join_is_a_gap(theorem, steps, known, said):
    assert said in "\n".join(gaps(theorem, steps, known))


def test_steps_that_join_have_no_gap_and_an_answer_has_the_hypotheses_that_no_lemma_before_gives():
    assert gaps(STATED, STEPS, {"lemma"}) == []
    found = assembled(READING, LEMMAS)
    assert found == Theorem(("for all x",), ("x > 0", "x < 9", "y = 0"), (no("root"),))


@pytest.mark.parametrize(
    ("reading", "lemmas", "said"),
    [
        (replace(READING, answer=YES), LEMMAS, "first, second does not conclude that there is a root"),
        (replace(READING, thing="pole"), LEMMAS, "does not conclude that there is no pole"),
        (replace(READING, by=("second", "first")), LEMMAS, "does not conclude"),
        (replace(READING, by=("third", "second")), LEMMAS, "third is not proved, or states nothing"),
        (READING, LEMMAS | {"first": replace(LEMMAS["first"], conclusions=("x³ > 0",))}, "first gives nothing that"),
        (READING, LEMMAS | {"second": replace(LEMMAS["second"], conclusions=(there_is("root"),))}, "does not conclude"),
    ],
)
def test_an_answer_that_does_not_follow_is_refused(reading, lemmas, said):
    with pytest.raises(Gap, match=said):
        assembled(reading, lemmas)


def test_a_reading_is_open_or_has_what_proves_it():
    Reading("r", "root", OPEN)
    for answer, by in ((OPEN, ("first",)), (NO, ()), ("maybe", ("first",))):
        with pytest.raises(ValueError, match="a reading is open, or answered by what proves it"):
            Reading("r", "root", answer, by)


def settles(p, *, prose=True):
    """Title."""
    p.ask("“Is there a root?”", "Section 1")
    p.state(Theorem(("for all x",), (), (no("root"),)), "here")
    p.lemma(TRUE)
    if prose:
        p.say("It follows.")
    p.step(no("root"), "for all x", TRUE.text)
    p.control(FALSE)
    p.witness("one", {"x": "1"})
    p.settle([Reading("real x", "root", NO, ("here",)), Reading("complex x", "root", OPEN)])


def record_of(prove):
    proof = Proof()
    prove(proof)
    claim = Claim("9.9", "x?", (), prove)
    record = Judgement(claim, proof.verdict(), proof, 0.0).record()
    record["evidence"]["fingerprint"] = "0"
    return record


def test_an_answer_is_made_from_what_is_stated_and_says_what_carries_it():
    record = record_of(settles)
    evidence = record["evidence"]
    assert (record["verdict"], evidence["problems"]) == ("settled", [])
    assert evidence["answer"] == "No. Where for all x: there is no root (here)."
    assert [row["answer"] for row in evidence["readings"]] == ["no", "open"]
    assert evidence["theorems"][0]["steps"][0]["checks"] == ("x = x",)
    words = evidence["settled"]
    assert (words["word"], words["statements"], words["certificates"], words["sentences"]) == (BY_HAND, 1, 0, 1)
    assert words["proofs"] == ["9.9"]
    lines = explain(record).splitlines()
    assert "  asked, Section 1: “Is there a root?”" in lines
    assert "  ⊢ there is no root" in lines
    assert lines[lines.index("  ANSWER to: real x") + 1] == "    " + evidence["answer"]
    assert "  OPEN: complex x" in lines
    assert f"  settled {words['text']}" in lines


def test_what_no_sentence_carries_is_machine_checked():
    def decides(p):
        """Title."""
        p.state(Theorem((), (), (there_is("number x with x = x"),)), "here")
        p.lemma(Equation(there_is("number x with x = x"), x, x, Quotient((x,))))
        p.control(FALSE)
        p.witness("one", {"x": "1"})
        p.settle([Reading("any x", "number x with x = x", YES, ("here",))])

    record = record_of(decides)
    assert (record["verdict"], record["evidence"]["settled"]["word"]) == ("settled", MACHINE_CHECKED)
    assert "by hand" not in record["evidence"]["settled"]["text"]


def test_what_carries_proofs_together_is_counted():
    assert settlement({"a": Grounds(None, 2, 1, 0), "b": Grounds(None, 3, 0, 4)}) == {
        "word": BY_HAND, "statements": 5, "certificates": 1, "sentences": 4, "proofs": ["a", "b"],
        "text": "by hand: 5 decided statements and 1 accepted certificates are machine-checked; "
        "4 sentences are by hand; in the proofs of a, b",
    }  # fmt: skip
