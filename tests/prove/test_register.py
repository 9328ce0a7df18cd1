"""The register as a whole: that the evidence is complete.

What each claim states and its verdict are in the certificates that are committed: test_certificates.py compares them.
"""

import re
from fractions import Fraction

import pytest

import chapsym.proofs
from chapsym.prove import load


def test_the_register_is_in_the_order_of_the_paper():
    sections = [re.match(r"[2-6]|prop|remark", id).group() for id in load()]
    numbered = [s for s in sections if s.isdigit()]
    assert numbered == sorted(numbered)


@pytest.mark.parametrize("id", chapsym.proofs.CLAIMS)
def test_the_evidence_is_complete(records, id):
    record, evidence = records[id], records[id]["evidence"]
    assert set(record) == {"id", "verdict", "printed", "corrected", "evidence", "seconds"}
    assert evidence["problems"] == []
    assert evidence["title"].endswith(".")
    assert re.fullmatch("[0-9a-f]{16}", evidence["fingerprint"])
    if record["verdict"] == "open":
        assert evidence["open_in_paper"]
        assert evidence["tried"]
        return
    assert evidence["controls"], "no negative control"
    assert all(control["rejected"] for control in evidence["controls"])
    if record["verdict"] == "definition":
        assert evidence["reason"]
        return
    if record["verdict"] == "settled":
        assert evidence["answer"]
        assert evidence["certificates"]
        assert not evidence["counterexamples"]
        return
    assert any(check["statement"].startswith("printed: ") for check in evidence["checks"])
    assert evidence["witnesses"] or evidence["counterexamples"]
    assert bool(record["corrected"]) == (record["verdict"] == "corrected")
    assert bool(evidence["condition"]) == (record["verdict"] == "conditional")
    assert bool(evidence["counterexamples"]) == (record["verdict"] != "holds")


def test_counterexamples_are_exact_rationals_that_separate_the_sides(records):
    seen = 0
    for record in records.values():
        for example in record["evidence"]["counterexamples"]:
            assert example["printed"]
            assert all(sides["left"] != sides["right"] for sides in example["printed"])
            assert all(sides["left"] == sides["right"] for sides in example["corrected"])
            for sides in example["printed"] + example["corrected"]:
                for text in re.findall(r"-?\d+(?:/\d+)?", " ".join(sides["left"] + sides["right"])):
                    Fraction(text)
            seen += 1
    assert seen >= 13


def test_corrections_name_what_they_change(records):
    assert "prop-4" in records["5.4"]["evidence"]["downstream"]
    assert "4.10" in records["4.1"]["evidence"]["downstream"]
    uses = {use for record in records.values() for use in record["evidence"]["uses"]}
    assert uses <= set(load(lemmas=True)), "a claim uses one that is not proved"
