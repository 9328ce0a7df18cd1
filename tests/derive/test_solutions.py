"""The equations (5.2) for q, one step of a rational state."""

import sympy as sp
from budget import examples
from hypothesis import given
from hypothesis import strategies as st

from chapsym.derive import solutions
from chapsym.derive.three import MASSES, D, K, gamma, placed, q, q0
from chapsym.derive.words import unfolded

GAMMA = ("2/7", "3/7", "6/7")


def test_the_equations_of_the_derivation_are_the_quadrics():
    for derived, written in zip(solutions.equations(), solutions.quadrics(), strict=True):
        assert sp.expand(unfolded(derived) - 2 * written) == 0


@examples(8, 20)
@given(st.lists(st.integers(-3, 3), min_size=3, max_size=3), st.integers(0, 20))
def test_the_momentum_of_a_rotation_has_that_rotation(u, contact):
    """A rational Ω ~ (4, u) is one of the solutions for its own momentum."""
    turn = (4, *u)
    momentum, vertical = solutions.after((1, 2, 4), contact, GAMMA, turn)
    # after() moves the state by its own rotation; Ωγ and Ω𝒦 are the state before, seen from there
    length = sp.Integer(sum(c * c for c in turn))
    rotation = sp.Matrix(solutions.three.rotation()).subs(dict(zip((q0, *q), turn, strict=True))) / length
    before = [list(rotation * sp.Matrix(x)) for x in (momentum, vertical)]
    state = placed((MASSES, (1, 2, 4)), ([D], [contact]), (gamma, before[1]), (K, before[0]), ((q0, *q), turn))
    assert all(sp.expand(e.xreplace(state)) == 0 for e in solutions.quadrics())
