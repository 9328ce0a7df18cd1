"""The register as a whole: what is judged, and that the evidence is complete."""

import json
import re
from fractions import Fraction
from pathlib import Path

import pytest

from chapsym.prove import load

#: What the derivations give.  A change here is a discovery or a mistake, and must be looked at.
VERDICTS = {
    "2.1": "corrected", "2.2-F": "holds", "2.5-inverse": "corrected", "2.5": "corrected", "2.9": "corrected",
    "2.10": "holds", "2.11": "holds", "2.11-force": "corrected", "2.11-eliminated": "corrected", "2.12": "holds",
    "2.14": "holds", "2.15": "holds", "2.3": "holds", "2.2": "holds", "2.4": "holds", "2.4-kinetic": "corrected",
    "2.6": "holds", "2.7-vertical": "holds", "2.7": "holds", "2.7-integrals": "corrected", "2.13": "conditional",
    "2.15-measure": "holds", "2.15-so3": "corrected", "3.3-energy": "holds", "3.4-principle": "corrected",
    "3.5": "holds", "remark-1": "corrected", "remark-2": "conditional", "4.1": "corrected", "4.3": "holds",
    "4.4": "holds", "4.5": "holds", "4.6": "holds", "4.7": "holds", "4.8": "definition", "4.2": "holds",
    "4.6-body": "corrected", "4.6-frame": "corrected", "4.11": "holds", "4.9": "holds", "4.9-naive": "holds",
    "4.9-limit": "corrected", "4.9-f": "holds", "4.9-F": "corrected", "4.9-wedge": "holds", "4.10": "holds",
    "prop-1": "holds", "prop-1-proof": "holds", "4.14": "holds", "4.13-multivalued": "holds", "prop-2": "holds",
    "remark-3": "holds", "4.6-limit": "holds", "4.13-limit": "holds", "5.1": "corrected", "5.1-angle": "conditional",
    "5.2": "holds", "5.2-expansion": "holds", "5.2-limit": "holds", "5.3": "holds", "5.3-integrals": "holds",
    "5.3-energy": "holds", "5.3-at-most-4": "corrected", "5.3-at-least-2": "conditional", "5.3-small": "holds",
    "5.4": "corrected", "5.6-sigma": "corrected", "5.6": "corrected", "prop-3": "holds", "5.12": "holds",
    "5.12-kappa": "holds", "5.12-q0": "corrected", "5.12-sigma": "corrected", "5.11": "corrected",
    "prop-4": "corrected", "5.12-scaling": "holds", "5.8": "corrected", "5.8-modulus": "holds", "5.7": "holds",
    "5.13": "corrected", "5.13-V": "holds", "5.14-Pi1": "holds", "5.14-Pi2": "holds", "5.14-G": "corrected",
    "5.14-alpha": "corrected", "5.14-beta": "holds", "5.14": "corrected", "5.15": "corrected",
    "5.15-euler": "holds", "5.16": "corrected", "5.16-weierstrass-e": "holds", "5.16-weierstrass-w": "corrected",
    "5.16-integral": "conditional", "5.6-curve": "holds", "5.9": "holds", "remark-4": "holds", "5.9-liouville": "holds",
    "5.9-circle": "conditional", "5.9-open": "settled", "6-vertical-energy": "holds", "6-LR": "holds",
    "6-open": "settled",
}  # fmt: skip


def test_every_claim_has_the_verdict_its_proof_computes(records):
    assert {id: record["verdict"] for id, record in records.items()} == VERDICTS


def test_the_register_is_in_the_order_of_the_paper():
    sections = [re.match(r"[2-6]|prop|remark", id).group() for id in load()]
    numbered = [s for s in sections if s.isdigit()]
    assert numbered == sorted(numbered)


@pytest.mark.parametrize("id", list(VERDICTS))
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


STATEMENTS = Path(__file__).with_name("statements.json")


def test_the_published_statements_are_those_that_were_read_against_the_paper(records):
    """The LaTeX of a claim is for readers; no machine reads it, so a slip in it must not pass unseen.

    After reading a changed statement against the paper, write it into statements.json.
    """
    published = {id: [record["printed"], record["corrected"]] for id, record in records.items()}
    assert published == json.loads(STATEMENTS.read_text(encoding="utf-8"))
