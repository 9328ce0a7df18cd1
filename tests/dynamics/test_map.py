"""One step: against the oracle, at its limits, and what it refuses."""

import warnings

import numpy as np
import pytest
from budget import examples
from hypothesis import find, given

import chapsym
from chapsym import BadInput, Ball, Status, StepNotTaken, testing
from chapsym.dynamics import kernels
from chapsym.dynamics.errors import largest_momentum
from chapsym.dynamics.loops.branch import small_rotation, tangent
from chapsym.studies.check import State, compare

BALL = Ball((1, 2, 4), 3)
GAMMA = np.array([2, 3, 6]) / 7
K = np.array([1, -0.5, 0.75])


@given(testing.states())
@examples(15, 25)
def test_a_step_agrees_with_the_matrix_equation(state):
    """Within the budget that `chapsym check` states."""
    ball, momentum, gamma = state
    if np.abs(momentum).max() < 1e-290:
        return  # there 𝒦 and q are no longer normal numbers, and an ulp is not relative
    errors, promised, *_ = compare(State(ball.mass_tensor, float(ball.D), momentum, gamma), digits=30)
    assert (errors <= promised).all(), (errors, promised)


@pytest.mark.parametrize("scale", [1e-300, 1e-3, 1.0, 1e300])
def test_a_ball_at_rest_stays_at_rest(scale):
    step = chapsym.step(Ball(BALL.mass_tensor * scale, BALL.D * scale), (0, 0, 0), GAMMA)
    assert step.rotation.tolist() == [1, 0, 0, 0]
    assert step.momentum.tolist() == [0, 0, 0]
    assert (step.gamma == GAMMA).all()


def test_a_homogeneous_top_folds_at_ninety_degrees():
    """|𝒦| = Λ sin θ on the branch: it ends at θ = 90°, where |𝒦| = Λ is the most that any rotation has."""
    top = Ball((1, 1, 1), 0)
    step = chapsym.step(top, (0, 0, 2 * np.sin(1.5)), (0, 0, 1))
    assert np.isclose(2 * np.arctan2(step.rotation[3], step.rotation[0]), 1.5, atol=1e-13)
    _, reach, *_ = small_rotation(0, 0, 4, 0, 0, 1, 1, 1, 1, 0)
    assert reach == pytest.approx(0.5, abs=1e-12)
    with pytest.raises(StepNotTaken) as caught:
        chapsym.step(top, (0, 0, 2.0001), (0, 0, 1))
    assert caught.value.status is Status.UNREACHABLE


def test_the_branch_ends_before_all_rotations_do():
    """A momentum past the fold that other rotations still have is FOLDED; past every rotation, UNREACHABLE."""
    _, reach, *_ = small_rotation(*(100 * K), *GAMMA, *BALL.mass_tensor, 3)
    fold = 100 * reach * np.linalg.norm(K)
    most = largest_momentum(K, GAMMA, BALL.mass_tensor, 3)
    assert fold < most
    unit = K / np.linalg.norm(K)
    for size, status in [((fold + most) / 2, Status.FOLDED), (1.001 * most, Status.UNREACHABLE)]:
        with pytest.raises(StepNotTaken) as caught:
            chapsym.step(BALL, size * unit, GAMMA)
        assert caught.value.status is status
        assert caught.value.reach == pytest.approx(fold / size, rel=1e-9)


@given(testing.rotations(), testing.balls(), testing.unit_vectors())
def test_no_rotation_exceeds_the_largest_momentum(q, ball, gamma):
    momentum = kernels.momentum(q, gamma, ball.mass_tensor, ball.D)
    if np.abs(momentum).max() > 1e-9:
        most = largest_momentum(momentum, gamma, ball.mass_tensor, float(ball.D))
        assert np.linalg.norm(momentum) <= most * (1 + 1e-12)


@pytest.mark.parametrize(
    ("kwargs", "sentence"),
    [
        ({"momentum": (1, 2)}, "momentum must have 3 components"),
        ({"momentum": (1, np.nan, 0)}, r"momentum must be finite, but it is nan at index \(1,\)"),
        ({"momentum": (True, False, None)}, "momentum must be real numbers"),
        ({"ball": (1, 2, 4)}, "ball must be a chapsym.Ball, not tuple"),
        ({"gamma": (0, 0, 0)}, "gamma must be a unit vector, but its length is 0; it is the vertical"),
        ({"momentum": np.zeros((2, 3)), "gamma": np.tile(GAMMA, (3, 1))}, "do not broadcast"),
    ],
)
def test_a_state_without_an_answer_is_refused(kwargs, sentence):
    with pytest.raises(BadInput, match=sentence):
        chapsym.step(**{"ball": BALL, "momentum": K, "gamma": GAMMA, **kwargs})


def test_balls_broadcast_with_states():
    balls = Ball(np.array([[1, 2, 4], [1, 1, 1]]), np.array([3, 0.5]))
    both = chapsym.step(balls, np.broadcast_to(K / 4, (5, 2, 3)), GAMMA)
    assert both.momentum.shape == (5, 2, 3)
    one = chapsym.step(Ball((1, 1, 1), 0.5), K / 4, GAMMA)
    assert (both.momentum[3, 1] == one.momentum).all()


@pytest.mark.parametrize("exponent", [-1000, -300, 300, 1000])
def test_the_step_does_not_know_units(exponent):
    """J, D and 𝒦 times a power of two: the same rotation, to the bit."""
    scale = 2.0**exponent
    scaled = chapsym.step(Ball(np.array([1, 2, 4]) * scale, 3 * scale), K * scale, GAMMA)
    step = chapsym.step(BALL, K, GAMMA)
    assert (scaled.rotation == step.rotation).all()
    assert (scaled.momentum == step.momentum * scale).all()


@pytest.mark.parametrize("D", [1e6, 1e9, 1e12, 1e14])
def test_a_heavy_contact_term_costs_no_digits_across_the_vertical(D):
    """γ = e₃, 𝒦 = (D/2, 0, 0): the rotation is about e₁, by sin θ = D/(2(D + 6)).

    4 ulps, the promise of `chapsym check` for its κ = 1.1: Dq₁ and 6q₁ are rounded apart.
    """
    step = chapsym.step(Ball((1, 2, 4), D), (D / 2, 0, 0), (0, 0, 1))
    angle = np.arcsin(D / 2 / (D + 6))
    assert step.rotation == pytest.approx([np.cos(angle / 2), np.sin(angle / 2), 0, 0], rel=4 * 2.0**-52, abs=1e-300)


def test_a_thin_body_keeps_its_digits():
    step = chapsym.step(Ball((1e-15, 1e-15, 1), 0), (0, 0, 1e-15), (0, 0, 1))
    assert step.rotation[3] == pytest.approx(np.sin(np.pi / 12), rel=4e-16)


STIFF = Ball((3.7743108014335556e-06, 4.346928542885402e-06, 7.887792778909276e-06), 1.0)
STIFF_GAMMA = np.array([0.9812528033905563, -0.1725015164186118, -0.08594278719853957])
STIFF_K = np.array([33.74114732815733, -23.273797435753504, 91.21329579561905])


@pytest.mark.parametrize("factor", [1e-6, 1e-5, 2e-3, 1.0, 1e200])
def test_the_fold_is_the_same_from_however_far_it_is_asked_for(factor):
    _, reach, *_ = small_rotation(*(factor * STIFF_K), *STIFF_GAMMA, *STIFF.mass_tensor, 1.0)
    assert reach * factor == pytest.approx(4.16172919670e-07, rel=1e-10)


@pytest.mark.parametrize(
    ("ball", "size"),
    [(BALL, size) for size in (1e3, 1e160, 1e200, 1e300)]
    + [(Ball((1e-300,) * 3, 0), 1e20), (Ball((5e-324,) * 3, 0), 1e308), (Ball((1, 2, 2), 1e3), 1e6)],
)
def test_a_momentum_beyond_the_range_of_its_ball_is_unreachable(ball, size):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(StepNotTaken) as caught:
            chapsym.step(ball, (-size / 2, -size, -size / 2), GAMMA)
    assert caught.value.status is Status.UNREACHABLE


def test_a_rod_on_its_end_has_no_inertia():
    with pytest.raises(StepNotTaken, match="no inertia about the vertical"):
        chapsym.step(Ball((1, 0, 0), 1), (0, 0, 1), (1, 0, 0))


@given(testing.rotations(), testing.balls(["generic"]), testing.unit_vectors())
def test_the_direction_of_the_branch_and_its_bend(q, ball, gamma):
    """d = T⁻¹𝒦 and |T⁻¹𝒦''| in the Frobenius norm, against linear algebra."""
    T = kernels.tangent_jacobian(q, gamma, ball.mass_tensor, ball.D)
    if abs(np.linalg.det(T)) < 1e-3:
        return
    _, speed, bend, direction = tangent(q, K, gamma, ball.mass_tensor, float(ball.D))
    expected = np.linalg.solve(T, K)
    assert np.allclose(direction, expected, rtol=1e-9, atol=1e-12)
    assert speed == pytest.approx(np.linalg.norm(expected))
    rows = np.linalg.solve(T, kernels.tangent_hessian(q, gamma, ball.mass_tensor, ball.D).T)
    weights = np.array([1, 1, 1, 2, 2, 2])
    assert bend == pytest.approx(np.sqrt((rows**2 * weights).sum()), rel=1e-8)


@pytest.mark.parametrize(
    ("reach", "said"), [(0.25, "it attains 0.25 of it"), (1 - 1e-9, "attains all but 1e-09"), (1.0, "all but 1e-16")]
)
def test_a_fold_that_is_near_says_how_near(reach, said):
    assert said in str(chapsym.StepNotTaken(chapsym.Status.FOLDED, reach))


def test_a_size_or_a_stratum_that_there_is_not_is_refused():
    for size in ("x", 0, -1, 2.5, None):
        with pytest.raises(BadInput, match="size must be a whole number from 1 on, not "):
            find(testing.unit_vectors(size), lambda drawn: True)
    for strategy, strata in (
        (testing.rotations, ("generic", "x")), (testing.balls, []), (testing.mass_tensors, 3),
        (testing.balls, "generic"),
    ):  # fmt: skip
        with pytest.raises(BadInput, match="strata must be some of generic, "):
            find(strategy(strata), lambda drawn: True)
