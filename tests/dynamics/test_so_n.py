"""so(n) on arrays: the numeric 𝒦 is the derived one, exactly; rotations stay rotations."""

from fractions import Fraction

import numpy as np
import pytest
import sympy as sp
from balls_n import SIZES, UNIT_ROUNDOFF
from budget import examples
from hypothesis import given
from hypothesis import strategies as st

from chapsym.derive import ball as derived
from chapsym.derive.words import evaluate
from chapsym.dynamics.n import so_n


@st.composite
def integers(draw, n):
    """(X, γ, J, D) of small whole numbers, as float64: what 𝒦 makes of them is exact.  X is any matrix."""
    small = st.integers(-9, 9)
    rows = draw(st.lists(st.lists(small, min_size=n, max_size=n), min_size=n + 2, max_size=n + 2))
    X, gamma, J = np.array(rows[:n], float), np.array(rows[n], float), np.abs(np.array(rows[n + 1], float))
    return X, gamma, J, np.float64(draw(st.integers(0, 9)))


def rationals(array):
    """An exact SymPy matrix (or column) of the same numbers."""
    array = np.asarray(array)
    exact = [Fraction(x) for x in array.flat]
    return sp.Matrix(*(*array.shape, 1)[:2], [sp.Rational(x.numerator, x.denominator) for x in exact])


def words(X, gamma, J, D):
    """𝒦 of chapsym.derive at explicit matrices, as exact fractions."""
    om, g = rationals(X), rationals(gamma)
    values = {derived.Omega: om, derived.OmegaT: om.T, derived.J: sp.diag(*rationals(J)), derived.Gamma: g * g.T}
    found = evaluate(derived.momentum(), {**values, derived.D: rationals([D])[0]})
    return np.array([Fraction(int(x.p), int(x.q)) for x in found], dtype=object).reshape(np.shape(X))


@pytest.mark.parametrize("n", SIZES)
def test_the_momentum_is_the_derived_one(n):
    @given(integers(n))
    @examples(15)
    def exactly(values):
        assert (so_n.momentum(*values) == words(*values)).all()

    exactly()


@pytest.mark.parametrize("n", SIZES)
def test_the_jacobian_is_the_derived_momentum_along_every_plane(n):
    """𝒦 is linear in Ω, so its derivative along Ω(1 + ξ) is 𝒦(Ωξ); Ω stands for any matrix here."""

    @given(integers(n))
    @examples(3)
    def exactly(values):
        X, gamma, J, D = values
        slope = so_n.jacobian(X - np.eye(n), gamma, J, D)
        for p, xi in enumerate(so_n.from_coordinates(np.eye(n * (n - 1) // 2), n)):
            assert (so_n.coordinates(words(X @ xi, gamma, J, D)) == slope[:, p]).all()

    exactly()


@pytest.mark.parametrize("n", SIZES)
@pytest.mark.parametrize("size", [1e-300, 1e-8, 0.1, 3.0])
def test_a_turn_is_a_rotation_relative_to_its_own_size(n, size):
    rng = np.random.default_rng(n)
    E = np.zeros((n, n))
    for _ in range(3):
        E = so_n.turned(E, so_n.from_coordinates(size * rng.normal(size=n * (n - 1) // 2), n))
    assert np.abs(E).max() > size / 10 or size == 3
    E = so_n.orthogonal(E)
    exact = np.vectorize(Fraction)(E)
    defect = np.abs((exact + exact.T + exact.T @ exact).astype(float)).max()
    assert defect <= 4 * n * UNIT_ROUNDOFF * np.abs(E).max()
    assert np.isclose(np.linalg.det(np.eye(n) + E), 1)


def test_newton_and_schulz_square_a_defect():
    E = so_n.turned(np.zeros((5, 5)), so_n.from_coordinates(np.linspace(0.1, 1, 10), 5))
    bent = E + 1e-5 * np.cos(np.arange(25.0).reshape(5, 5))
    for repaired in (so_n.orthogonal(bent), so_n.polar(bent + np.eye(5)) - np.eye(5)):
        defect = repaired + repaired.T + repaired.T @ repaired
        assert 1e-11 < np.abs(defect).max() < 1e-9


@pytest.mark.parametrize("n", SIZES)
def test_what_is_carried_turns_with_the_body(n):
    rng = np.random.default_rng(n)
    A, E = (so_n.from_coordinates(rng.normal(size=n * (n - 1) // 2), n) for _ in "AE")
    E = so_n.turned(np.zeros((n, n)), E)
    moved, rotation = so_n.carried(A, E), np.eye(n) + E
    assert (moved == -moved.T).all()
    assert np.abs(moved - rotation.T @ A @ rotation).max() < 1e-14
    assert np.abs(so_n.transported(A[0], E) - rotation.T @ A[0]).max() < 1e-14
