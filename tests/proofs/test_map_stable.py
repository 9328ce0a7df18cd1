"""chapsym's own lemmas on the forms that keep their digits: their verdicts, and what a wrong step in them does."""

import pytest
import sympy as sp

from chapsym.derive import continuous, gibbs, three
from chapsym.prove import load
from chapsym.prove.runner import judge

LEMMAS = ["stable-momentum", "stable-determinant", "stable-inverse"]


@pytest.mark.parametrize("id", LEMMAS)
def test_the_lemma_holds_with_its_evidence(lemmas, id):
    record = lemmas[id]
    evidence = record["evidence"]
    assert record["verdict"] == "holds", evidence["problems"]
    assert evidence["witnesses"]
    assert len(evidence["controls"]) >= 2
    assert all(control["rejected"] for control in evidence["controls"])


def verdict(id):
    return judge(load(lemmas=True)[id]).verdict.value


def test_a_wrong_vector_product_is_seen(monkeypatch):
    steps, value = three.carried_steps(three.q)
    monkeypatch.setattr(three, "carried_steps", lambda x: (steps, value + three.DRAG))
    assert verdict("stable-momentum") != "holds"


def test_a_wrong_determinant_is_seen(monkeypatch):
    steps, (det, *rest) = gibbs.newton_heavy_steps()
    right = [(names, gibbs.M * three.gamma if names is gibbs.Y else values) for names, values in steps]
    monkeypatch.setattr(gibbs, "newton_heavy_steps", lambda: (right, [det, *rest]))
    assert verdict("stable-determinant") != "holds"


def test_a_wrong_factor_is_seen(monkeypatch):
    wrong = sp.Matrix(continuous.angular_velocity()).subs(three.D, 2 * three.D)
    monkeypatch.setattr(continuous, "angular_velocity", lambda: wrong)
    assert verdict("stable-inverse") != "holds"
