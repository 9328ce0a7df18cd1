"""chapsym's own lemmas on the step back: their verdicts, and the same from the paper's formulas in `fractions`."""

from fractions import Fraction as F

import pytest
from budget import examples
from hypothesis import given
from reference import added, axial, diagonal, matmul, momentum, outer, rotation, times, transposed

from chapsym import testing
from chapsym.derive import ball
from chapsym.prove import load
from chapsym.prove.runner import judge

LEMMAS = ["self-adjoint", "reversible", "momentum-integrals-composed"]


@pytest.mark.parametrize("id", LEMMAS)
def test_the_lemma_holds_with_its_evidence(lemmas, id):
    record = lemmas[id]
    evidence = record["evidence"]
    assert record["verdict"] == "holds", evidence["problems"]
    assert evidence["witnesses"]
    assert len(evidence["controls"]) >= 2
    assert all(control["rejected"] for control in evidence["controls"])


def test_lemmas_are_no_claims_of_the_paper():
    assert set(LEMMAS) <= set(load(lemmas=True))
    assert not set(LEMMAS) & set(load())


@pytest.mark.parametrize("id", LEMMAS[:2])
def test_a_wrong_momentum_is_not_self_adjoint(id, monkeypatch):
    honest = ball.momentum()
    monkeypatch.setattr(
        ball, "momentum", lambda: honest + ball.D * (ball.Omega * ball.Gamma - ball.Gamma * ball.OmegaT)
    )
    assert judge(load(lemmas=True)[id]).verdict.value != "holds"


def carried(turn, matrix):
    """Ωᵀ matrix Ω."""
    return matmul(transposed(turn), matmul(matrix, turn))


@given(testing.rational_rotations(), testing.rational_unit_vectors(), testing.rational_balls())
@examples(40)
def test_the_step_back_with_fractions_alone(q, gamma, ball):
    J, D = ball
    turn = rotation(*q)
    there = momentum(turn, gamma, J, D)
    arrived, vertical = carried(turn, there), times(transposed(turn), gamma)
    back = momentum(transposed(turn), vertical, J, D)
    assert back == added((-1, arrived))
    assert axial(back) == [-x for x in times(transposed(turn), axial(there))]
    assert carried(transposed(turn), arrived) == there
    assert times(turn, vertical) == list(gamma)


def test_the_mean_of_both_ends_is_what_makes_it_so():
    """With Γ at the start alone the contact term has no such symmetry: an exact counterexample."""
    turn, gamma = rotation(F(4, 5), F(2, 5), F(1, 5), F(2, 5)), (F(2, 7), F(3, 7), F(6, 7))

    def lopsided(turn, gamma):
        J, G = diagonal((1, 2, 4)), outer(gamma)
        spin = added((1, matmul(turn, J)), (-1, matmul(J, transposed(turn))))
        return added((1, spin), (3, matmul(turn, G)), (-3, matmul(G, transposed(turn))))

    back = lopsided(transposed(turn), times(transposed(turn), gamma))
    assert back != added((-1, carried(turn, lopsided(turn, gamma))))
