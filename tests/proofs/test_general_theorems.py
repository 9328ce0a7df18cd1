"""What README and open.md say of the three general theorems: no certificate in intervals enters their proofs."""

import pytest

from chapsym.prove import load


@pytest.fixture(scope="module")
def claims():
    return load(lemmas=True)


def behind(id, claims):
    """The claim and all that it uses, directly or through others."""
    reached = [id]
    for one in reached:  # grows while it is read
        reached += [used for used in claims[one].uses if used not in reached]
    return reached


@pytest.mark.parametrize("lemma", ["measure-iff", "separatrix", "energy-orbits"])
def test_no_certificate_enters_a_general_theorem(lemma, claims, all_judged):
    reached = behind(lemma, claims)
    assert len(reached) > 20
    assert [id for id in reached if claims[id].files] == []
    assert [id for id in reached if all_judged.records[id][0]["evidence"]["certificates"]] == []


def test_nor_what_makes_of_orbits_that_there_are_no_integrals(claims, all_judged):
    """And the questions themselves have certificates, so that this can be seen."""
    evidence = all_judged.records["6-open"][0]["evidence"]
    assert len(evidence["certificates"]) > 0
    [part] = [one for one in evidence["theorems"] if one["part"] == "6-open: integrals"]
    assert part["steps"]
    assert [need for step in part["steps"] for need in step["needs"] if need.endswith(".json")] == []
