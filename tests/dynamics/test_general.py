"""One step in n dimensions: it solves (4.13) on the right branch, equals three dimensions at n = 3, and refuses."""

import warnings
from fractions import Fraction

import numpy as np
import pytest
from balls_n import SIZES, UNIT_ROUNDOFF, condition, offset, states
from budget import examples, slow
from hypothesis import given

import chapsym
from chapsym import BadInput, Ball, BallN, Status, StepNotTaken, axial, step_n
from chapsym.dynamics import kernels
from chapsym.dynamics.n import so_n

J4, G4 = (1.0, 2.0, 0.5, 3.0), np.array([1, 2, 4, 10]) / 11
K4 = so_n.from_coordinates(np.array([0.3, -0.2, 0.5, 0.1, 0.4, -0.6]), 4)


@pytest.mark.parametrize("n", [4, 5, *slow(3, 8)])
def test_a_step_solves_the_equation(n):
    """Evaluated exactly at the Ω - 1 that was found: only roundings of the residual are left, and Ω is a rotation."""

    @given(states(n))
    @examples(5, 25)
    def solves(state):
        K, _, J, D = state
        E, (X, k, g, j, d) = offset(state), (np.vectorize(Fraction)(x) for x in (offset(state), *state))
        residual = np.abs((so_n.momentum(X, g, j, d) - k).astype(float)).max()
        size = np.abs(K).max() + 2 * (J.sum() + D) * np.abs(E).max()
        assert residual <= 8 * n * UNIT_ROUNDOFF * size
        assert np.abs((X + X.T + X.T @ X).astype(float)).max() <= 4 * n * UNIT_ROUNDOFF * np.abs(E).max()

    solves()


@given(states(3))
@examples(8, 40)
def test_in_three_dimensions_it_is_the_same_map(state):
    K, gamma, J, D = state
    general, special = step_n(BallN(J, D), K, gamma), chapsym.step(Ball(J, D), axial(K), gamma)
    kappa = condition(offset(state), state)
    tolerance = 16 * UNIT_ROUNDOFF * (1 + np.abs(special.rotation[1:]).max() * kappa)
    assert np.abs(general.rotation - kernels.rotation(special.rotation)).max() <= tolerance
    assert np.abs(axial(general.momentum) - special.momentum).max() <= tolerance * np.abs(K).max()
    assert np.abs(general.gamma - special.gamma).max() <= tolerance


@pytest.mark.parametrize("n", SIZES)
def test_equal_moments_and_no_contact_give_sines(n):
    """For J = 1, D = 0 a rotation by θ in a plane has the momentum 2 sin θ: the branch folds at 90°."""
    plane = so_n.from_coordinates(np.eye(n * (n - 1) // 2)[1], n)
    ball, gamma = BallN(np.ones(n), 0), np.eye(n)[0]
    step = step_n(ball, 2 * np.sin(1.5) * plane, gamma)
    rows, columns = so_n.places(n)
    assert np.isclose(np.arcsin(step.rotation[rows[1], columns[1]]), 1.5, atol=1e-13)
    with pytest.raises(StepNotTaken, match=r"attains 0\.5 ") as caught:
        step_n(ball, 4 * plane, gamma)
    assert caught.value.status is Status.FOLDED


@pytest.mark.parametrize("size", [1e-300, 1e-150, 1e-12])
@pytest.mark.parametrize("scale", [1e-100, 1.0, 1e100])
def test_a_tiny_momentum_keeps_its_digits(size, scale):
    """Ω - 1 tends to ω with Jω + ωJ + D(Γω + ωΓ) = 𝒦 (2.13), relative to its own size."""
    J, D, K = np.array(J4) * scale, np.float64(3 * scale), K4 * size * scale
    if np.abs(K).max() < 1e-290:
        return
    E = offset((K, G4, J, D))
    omega = (E - E.T) / 2
    Gamma = np.outer(G4, G4)
    back = np.diag(J) @ omega + omega @ np.diag(J) + D * (Gamma @ omega + omega @ Gamma)
    assert np.abs(back - K).max() <= max(64 * UNIT_ROUNDOFF, 10 * size) * np.abs(K).max()


@pytest.mark.parametrize("size", [5e-324, 1e-315, 1e-308])
def test_a_momentum_that_is_no_normal_number_is_one(size):
    """Newton's corrections there vanish on the grid of the smallest numbers."""
    rng = np.random.default_rng(1)
    K = size * so_n.from_coordinates(rng.integers(-9, 9, (200, 6)).astype(float), 4)
    step = step_n(BallN(J4, 3), K, G4)
    assert (step.status == Status.TAKEN).all()
    assert np.abs(step.momentum - K).max() <= 2**-1070


def test_a_huge_momentum_folds_without_a_warning():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for size in (1e3, 1e300):
            with pytest.raises(StepNotTaken) as caught:
                step_n(BallN(J4, 3), K4 * size, G4)
            assert caught.value.status is Status.FOLDED


def test_a_ball_with_no_inertia_in_a_plane_is_told():
    """Two moments vanish and γ has no part in their plane: a turn there needs no momentum."""
    ball = BallN((0, 0, 1, 2), 3)
    with pytest.raises(StepNotTaken) as caught:
        step_n(ball, 0.01 * K4, (0, 0, 0.6, 0.8))
    assert caught.value.status is Status.NO_INERTIA
    assert step_n(ball, 0.01 * K4, (0.6, 0, 0, 0.8)).status == Status.TAKEN
    with pytest.raises(StepNotTaken, match="rounding hides the rotation: the moments and D are too far apart"):
        step_n(BallN((1, 1, 1e17, 1), 1), 0.01 * K4, (0, 0, 0, 1))  # there is inertia, below the rounding of 1e17


def test_a_batch_goes_on_for_the_others():
    K = np.stack([0.1 * K4, 100 * K4, 0.2 * K4])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        step = step_n(BallN(J4, [[3], [1]]), K, G4)
    assert step.status.tolist() == [[Status.TAKEN, Status.FOLDED, Status.TAKEN]] * 2
    for i in (0, 1):
        for j in (0, 2):
            one = step_n(BallN(J4, (3, 1)[i]), K[j], G4)
            assert np.abs(step.momentum[i, j] - one.momentum).max() <= 4 * UNIT_ROUNDOFF
            assert step.reach[i, j] == 1
        assert np.isnan(step.momentum[i, 1]).all()
        assert 0 < step.reach[i, 1] < 1
    K = K4 * np.linspace(0.0, 0.3, 2000)[:, None, None]  # longer than a block, and the first is at rest
    step = step_n(BallN(J4, 3), K, G4)
    for i in (0, 777, 1999):
        assert np.abs(step.momentum[i] - step_n(BallN(J4, 3), K[i], G4).momentum).max() <= 4 * UNIT_ROUNDOFF
    assert (step.rotation[0] == np.eye(4)).all()
    assert (step.gamma[0] == G4).all()


def test_layout_and_emptiness_do_not_matter():
    K = np.stack([0.1 * K4, 0.2 * K4, 0.3 * K4])
    K.flags.writeable = False  # what was given is not changed
    views = np.asfortranarray(K), np.repeat(K, 2, axis=0)[::2], np.flip(np.flip(K, 0).copy(), 0)
    expected = step_n(BallN(J4, 3), K, G4).momentum
    for view in views:
        assert (step_n(BallN(J4, 3), view, G4[::-1].copy()[::-1]).momentum == expected).all()
    empty = step_n(BallN(J4, 3), np.zeros((2, 0, 4, 4)), G4)
    assert (empty.momentum.shape, empty.gamma.shape, empty.status.shape) == ((2, 0, 4, 4), (2, 0, 4), (2, 0))


def test_a_momentum_that_is_skew_up_to_rounding_is_made_so():
    rounded = 0.1 * K4 + 1e-15 * np.arange(16.0).reshape(4, 4)
    step = step_n(BallN(J4, 3), rounded, G4)
    assert (step.momentum == -step.momentum.T).all()
    assert np.abs(step.momentum - step_n(BallN(J4, 3), 0.1 * K4, G4).momentum).max() < 1e-13


@pytest.mark.parametrize(
    ("kwargs", "sentence"),
    [
        ({"mass_tensor": 1.0}, r"mass_tensor must have n >= 3 moments along its last axis, not the shape \(\)"),
        ({"mass_tensor": (1, 2)}, "mass_tensor must have n >= 3 moments"),
        ({"mass_tensor": (1, 2, -1, 1)}, "mass_tensor must not be negative, but it is -1"),
        ({"mass_tensor": (1e308, 1e308, 1, 1)}, "beyond the range of float64"),
        ({"mass_tensor": (0, 0, 1, 2), "D": 0}, "no inertia about some plane"),
        ({"D": -1}, "D must not be negative, but it is -1"),
        ({"D": (1, 2), "mass_tensor": np.ones((3, 4))}, "leading axes of mass_tensor, D and radius do not broadcast"),
        ({"radius": 0}, "radius must be positive, but it is 0"),
    ],
)
def test_a_body_that_cannot_be_is_refused(kwargs, sentence):
    with pytest.raises(BadInput, match=sentence):
        BallN(**{"mass_tensor": J4, "D": 3, **kwargs})


@pytest.mark.parametrize(
    ("kwargs", "sentence"),
    [
        ({"momentum": 1.0}, r"momentum must be skew matrices of the shape \(..., 4, 4\), not \(\)"),
        ({"momentum": np.eye(4)}, "momentum must be skew, but it differs from minus its transpose by 2"),
        ({"gamma": G4[:3]}, "gamma must have 4 components"),
        ({"gamma": 1.01 * G4}, "gamma must be a unit vector, but its length is 1.01"),
        ({"gamma": np.tile(G4, (3, 1)), "momentum": np.zeros((2, 4, 4))}, "momentum and gamma do not broadcast"),
        ({"ball": Ball((1, 2, 4), 3)}, "ball must be a chapsym.BallN, not Ball"),
    ],
)
def test_input_without_an_answer_is_refused(kwargs, sentence):
    with pytest.raises(BadInput, match=sentence):
        step_n(**{"ball": BallN(J4, 3), "momentum": K4, "gamma": G4, **kwargs})
