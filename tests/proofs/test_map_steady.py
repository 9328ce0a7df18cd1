"""chapsym's own lemmas on steady rotation: their verdicts, and what a wrong step in them does."""

import pytest
import sympy as sp

from chapsym.derive import continuous, gibbs, steady, three
from chapsym.prove import load
from chapsym.prove.runner import judge

LEMMAS = ["steady", "steady-branch", "steady-axis", "steady-roll", "isotropic-spin", "straight"]


@pytest.mark.parametrize("id", LEMMAS)
def test_the_lemma_holds_with_its_evidence(lemmas, id):
    record = lemmas[id]
    evidence = record["evidence"]
    assert record["verdict"] == "holds", evidence["problems"]
    assert evidence["witnesses"]
    assert evidence["controls"]
    assert all(control["rejected"] for control in evidence["controls"])


def verdict(id):
    return judge(load(lemmas=True)[id]).verdict.value


@pytest.mark.parametrize("id", ["steady", "steady-branch", "steady-axis", "steady-roll"])
def test_a_wrong_momentum_is_seen(monkeypatch, id):
    wrong = sp.ImmutableMatrix(sp.Matrix(gibbs.residual()).subs(gibbs.u[0], -gibbs.u[0]))
    bent = gibbs.jacobian().subs(gibbs.u[0], -gibbs.u[0])
    monkeypatch.setattr(gibbs, "residual", lambda: wrong)
    monkeypatch.setattr(gibbs, "jacobian", lambda: bent)
    assert verdict(id) != "holds"


def test_a_wrong_spin_is_seen(monkeypatch):
    wrong = sp.Matrix(continuous.angular_velocity()).subs(three.D, 2 * three.D)
    monkeypatch.setattr(continuous, "angular_velocity", lambda: wrong)
    steady.spin.cache_clear()
    assert verdict("isotropic-spin") != "holds"
    steady.spin.cache_clear()


def test_a_wrong_factor_in_the_kernel_is_seen(monkeypatch):
    steps, value = steady.spin_steps()
    monkeypatch.setattr(steady, "spin_steps", lambda: (steps, 2 * value))
    assert verdict("isotropic-spin") != "holds"


def test_a_wrong_step_of_the_contact_point_is_seen(monkeypatch):
    right = three.centre_step()
    monkeypatch.setattr(three, "centre_step", lambda: sp.Matrix([right[0], right[1], -right[2]]))
    assert verdict("straight") != "holds"
