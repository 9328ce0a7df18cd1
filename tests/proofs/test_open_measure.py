"""The open question of Section 5: what settles it."""

import json

import pytest

from chapsym import checker
from chapsym.proofs.open import certified, measure
from chapsym.prove import Fact, Verdict, load
from chapsym.prove.records import fingerprint
from chapsym.prove.runner import judge


def test_without_certificates_with_a_rejected_one_or_a_lemma_that_fails_it_is_open(tmp_path, monkeypatch):
    claim = load()["5.9-open"]
    lemmas, files = measure.LEMMAS, measure.FILES
    monkeypatch.setattr(measure, "LEMMAS", {})
    monkeypatch.setattr(measure, "FILES", ())
    monkeypatch.setattr(measure, "ENDS", ())
    assert judge(claim).verdict is Verdict.OPEN
    file = certified.FOLDER / "measure-simplest.json"
    data = json.loads(file.read_text(encoding="utf-8"))
    data["half_turns"] += 1
    (tmp_path / file.name).write_text(json.dumps(data), encoding="utf-8")
    for path in (tmp_path / file.name, tmp_path / "missing.json"):
        monkeypatch.setattr(measure, "FILES", (path,))
        judgement = judge(claim)
        assert judgement.verdict is Verdict.OPEN
        assert judgement.proof.problems[0] == f"the checker does not accept {path.name}"
    monkeypatch.setattr(measure, "LEMMAS", lemmas)
    monkeypatch.setattr(measure, "FILES", tuple(one for one in files if one.name == "measure-simplest.json"))
    monkeypatch.setattr(measure, "judged", lambda id: Fact(f"{id} is proved", id != "resonance"))
    judgement = judge(load()["5.9-open"])
    assert judgement.verdict is Verdict.OPEN
    assert judgement.proof.problems[0] == "lemma fails: resonance is proved"


def test_a_changed_certificate_is_sealed_so_that_arithmetic_judges_it():
    """A smaller box is proved as well as the box: it is accepted, and so no seal is what rejects the others."""
    data = checker.read(certified.FOLDER / "measure-simplest.json")
    assert certified.changed("a smaller box", data, ("radius",), "1e-300").holds()
    assert not certified.changed("one half turn more", data, ("half_turns",), data["half_turns"] + 1).holds()
    with pytest.raises(ValueError, match="nothing is changed"):
        certified.changed("the same", data, ("radius",), data["radius"])


def test_the_record_depends_on_the_certificates(tmp_path):
    claim = load()["5.9-open"]
    assert claim.files == (*measure.FILES, *measure.ENDS)
    copy = tmp_path / claim.files[0].name
    copy.write_bytes(claim.files[0].read_bytes() + b"\n")
    changed = type(claim)(claim.id, claim.printed, claim.uses, claim.prove, (copy, *claim.files[1:]))
    gone = type(claim)(claim.id, claim.printed, claim.uses, claim.prove, (tmp_path / "gone", *claim.files[1:]))
    assert len({fingerprint(c) for c in (claim, changed, gone)}) == 3
