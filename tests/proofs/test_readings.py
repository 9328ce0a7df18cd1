"""What answers the two questions: each link of the arguments is needed, and the table is the one that is proved."""

from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path

import pytest

from chapsym import checker
from chapsym.proofs.map import symmetries
from chapsym.proofs.open import certified, energy, locking, measure, readings
from chapsym.prove import Proof, Verdict, load, no, there_is
from chapsym.prove.argument import gaps
from chapsym.prove.runner import judge

#: The lemmas whose statements are data, beside the parts of the questions.
STATED = (
    "small-branch", "self-adjoint", "reversible", "symmetries", "modified-field", "modified-energy",
    "energy-without-rolling", "modified-measure", "map-symmetries", "chord", "resonance", "plateaus", "almost-every",
    "locked-circle",
)  # fmt: skip
QUESTIONS = {"5.9-open": measure, "6-open": energy}


@cache
def exchanged():
    """A fact that holds."""
    return symmetries.renamed(symmetries.SWAP, -1)[0]


@pytest.fixture
def once(all_judged, uncertified, monkeypatch):
    """The questions rest on the lemmas and certificates as this run has judged them, without judging them again."""
    load(lemmas=True)
    for module in QUESTIONS.values():
        monkeypatch.setattr(module, "judged", all_judged.rests.__getitem__)
    monkeypatch.setattr(checker, "check", lambda data: all_judged.checked[data["digest"]])
    monkeypatch.setattr(certified, "changed", lambda *_: exchanged())


def proof_of(id):
    claim = load(lemmas=True)[id]
    proof = Proof(uses=claim.uses)
    claim.prove(proof)
    return proof


@pytest.mark.parametrize("id", QUESTIONS)
def test_every_reading_that_is_not_open_is_proved(id, records):
    evidence = records[id]["evidence"]
    assert records[id]["verdict"] == Verdict.SETTLED, evidence["problems"]
    assert [row["asked"] for row in evidence["readings"]] == [one.asked for one in readings.READINGS[id]]
    for row, one in zip(evidence["readings"], readings.READINGS[id], strict=True):
        assert (row["theorem"] is None) == (one.answer == "open")
        assert "of the orbit" not in (row["text"] or ""), "which orbit?"
        assert all(name in load(lemmas=True) or name.startswith(f"{id}: ") for name in one.by)
    assert evidence["settled"]["word"] == "by hand"
    assert set(evidence["settled"]["proofs"]) == {id, *QUESTIONS[id].LEMMAS}
    assert min(evidence["settled"][name] for name in ("statements", "certificates", "sentences")) > 0


ANSWERED = [(id, i) for id, rows in readings.READINGS.items() for i, one in enumerate(rows) if one.by]


@pytest.mark.usefixtures("once")
@pytest.mark.parametrize(("id", "row"), ANSWERED)
def test_a_negated_answer_and_a_swapped_lemma_do_not_follow(id, row, monkeypatch):
    rows = readings.READINGS[id]
    other = "yes" if rows[row].answer == "no" else "no"
    swapped = (*rows[row].by[:-1], "chord" if id == "5.9-open" else "modified-field")
    for changed in (replace(rows[row], answer=other), replace(rows[row], by=swapped)):
        monkeypatch.setitem(readings.READINGS, id, (*rows[:row], changed, *rows[row + 1 :]))
        judgement = judge(load()[id])
        assert judgement.verdict is Verdict.OPEN
        assert judgement.proof.problems[0].startswith("not answered: ")


@pytest.mark.usefixtures("once")
@pytest.mark.parametrize("id", QUESTIONS)
def test_without_its_prose_no_question_is_settled(id, monkeypatch):
    monkeypatch.setattr(Proof, "say", lambda *_: None)
    assert judge(load()[id]).verdict is Verdict.OPEN


@pytest.mark.parametrize("id", [*STATED, *QUESTIONS])
@pytest.mark.usefixtures("once")
def test_each_hypothesis_and_each_step_by_hand_is_needed(id):
    proof = proof_of(id)
    files = {one["file"] for one in proof.certificates}
    known = {*proof.uses, *files, *(statement.text for _, statement, _ in proof.decided)}
    assert proof.stated
    for part, theorem in proof.stated.items():
        steps = proof.steps[part]
        assert gaps(theorem, steps, known) == []
        for name in ("quantifiers", "hypotheses"):
            given = getattr(theorem, name)
            for i in range(len(given)):
                assert gaps(replace(theorem, **{name: given[:i] + given[i + 1 :]}), steps, known)
        for i, one in enumerate(steps):
            assert gaps(theorem, steps[:i] + steps[i + 1 :], known), one.gives
            for need in set(one.needs) & {*proof.uses, *files}:
                swapped = replace(one, needs=tuple("5.1" if n == need else n for n in one.needs))
                assert gaps(theorem, [*steps[:i], swapped, *steps[i + 1 :]], known), need
        for conclusion in theorem.conclusions:
            if conclusion.startswith(no("")):
                negated = there_is(conclusion.removeprefix(no("")))
                assert gaps(replace(theorem, conclusions=(negated,)), steps, known)


@pytest.mark.parametrize(
    "change",
    {
        "negated": lambda t: replace(t, conclusions=tuple(c.replace("is no", "is a") for c in t.conclusions)),
        "a hypothesis less": lambda t: replace(t, hypotheses=t.hypotheses[1:]),
        "a hypothesis more": lambda t: replace(t, hypotheses=(*t.hypotheses, "l = 1")),
    }.values(),
)
def test_a_lemma_that_states_something_else_does_not_hold(change, monkeypatch):
    monkeypatch.setattr(locking, "STATED", change(locking.STATED))
    assert judge(load(lemmas=True)["locked-circle"]).verdict is Verdict.OPEN


@pytest.mark.usefixtures("once")
def test_a_lemma_that_needs_more_makes_the_theorem_need_more(all_judged, monkeypatch):
    """Nobody types the hypotheses of an answer: they are those of its lemmas."""
    sentence = all_judged.rests["plateaus"]
    theorem = replace(sentence.grounds.theorem, hypotheses=(*sentence.grounds.theorem.hypotheses, "l = 1"))
    narrower = all_judged.rests | {"plateaus": replace(sentence, grounds=replace(sentence.grounds, theorem=theorem))}
    monkeypatch.setattr(measure, "judged", narrower.__getitem__)
    first = judge(load()["5.9-open"]).proof.readings[0]
    assert "l = 1" in first["theorem"]["hypotheses"]


@pytest.mark.parametrize("id", QUESTIONS)
def test_the_page_has_the_words_and_the_table(id):
    page = Path(__file__).parents[2].joinpath("docs/explanation/open.md").read_text(encoding="utf-8")
    words, place = readings.QUESTIONS[id]
    assert f"> {words} ({place})\n\n{readings.table(id)}\n" in page
    assert readings.table(id).count("\n") == 2 + len(readings.READINGS[id])


def test_the_balls_that_are_said_to_have_their_mass_inside_do():
    for name, inside in {"measure-real-ball": True, "energy-drift-real-ball": True, "measure-simplest": False}.items():
        ball = checker.read(certified.FOLDER / f"{name}.json")["ball"]
        J = [Fraction(value) for value in ball["J"]]
        assert (min(J) >= 0 and sum(J) <= Fraction(ball["D"])) is inside
    sentence = " ".join(one.asked for rows in readings.READINGS.values() for one in rows)
    assert "measure-real-ball: tr J ≤ D" in sentence
    assert "energy-drift-real-ball: tr J ≤ D" in sentence
