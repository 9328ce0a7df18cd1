"""Presets against numerical integration of their mass, and principal axes against the tensor that they came from."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from chapsym import BadInput
from chapsym.dynamics import kernels
from chapsym.dynamics.principal_axes import principal
from chapsym.scene import checked
from chapsym.scene.members.members import expand
from chapsym.scene.read.bodies import PRESETS, check_inside

EPS = np.finfo(np.float64).eps


def even_shell(mass, inner, outer):
    """Points and weights of a shell of even material: Gauss rules for r and cos θ, even angles for φ, exact for xxᵀ."""
    x, w = np.polynomial.legendre.leggauss(6)
    r, wr = (inner + outer) / 2 + (outer - inner) / 2 * x, (outer - inner) / 2 * w
    phi = np.arange(8) * np.pi / 4
    r, c, f = np.meshgrid(r, x, phi, indexing="ij")
    s = np.sqrt(1 - c * c)
    points = np.stack([r * s * np.cos(f), r * s * np.sin(f), r * c], axis=-1).reshape(-1, 3)
    weights = (wr[:, None, None] * r**2 * w[None, :, None] * np.ones(8)).reshape(-1)
    return points, mass * weights / weights.sum()


def even_block(mass, size, offset):
    x, w = np.polynomial.legendre.leggauss(3)
    grid = np.stack(np.meshgrid(x, x, x, indexing="ij"), axis=-1).reshape(-1, 3)
    weights = (w[:, None, None] * w[None, :, None] * w).reshape(-1)
    return np.array(offset) + grid * np.array(size) / 2, mass * weights / weights.sum()


def joined(*parts):
    points, weights = zip(*parts, strict=True)
    return np.concatenate(points), np.concatenate(weights)


MASS, RADIUS = 7.0, 0.1085
SIZE, OFFSET, BLOCK = (0.05, 0.08, 0.06), (0.02, -0.01, 0.015), 0.8
AWAY = np.linalg.norm(OFFSET)
COUNTER = BLOCK * AWAY / RADIUS


@pytest.mark.parametrize(
    ("preset", "keys", "points"),
    [
        ("homogeneous", {}, even_shell(MASS, 0, RADIUS)),
        ("shell", {"thickness": 0.02}, even_shell(MASS, RADIUS - 0.02, RADIUS)),
        ("shell", {"thickness": RADIUS}, even_shell(MASS, 0, RADIUS)),
        ("shell", {}, even_shell(MASS, RADIUS * (1 - 1e-13), RADIUS)),
        (
            "dumbbell",
            {"point_mass": 1.2, "separation": 0.1, "thickness": 0.01},
            joined(
                even_shell(MASS - 2.4, RADIUS - 0.01, RADIUS),
                (np.array([[0, 0, 0.05], [0, 0, -0.05]]), np.array([1.2, 1.2])),
            ),
        ),
        (
            "bowling",
            {"block_mass": BLOCK, "block_size": SIZE, "block_offset": OFFSET},
            joined(
                even_shell(MASS - BLOCK - COUNTER, 0, RADIUS),
                even_block(BLOCK, SIZE, OFFSET),
                (-np.array([OFFSET]) / AWAY * RADIUS, np.array([COUNTER])),
            ),
        ),
    ],
)
def test_the_moments_of_a_preset_are_those_of_its_mass(preset, keys, points):
    where, mass = points
    given = {name: np.array([value]) for name, value in {"mass": MASS, "radius": RADIUS, **keys}.items()}
    tensor = PRESETS[preset](**given)[0]
    tensor = np.diag(tensor) if tensor.ndim == 1 else tensor
    assert abs(mass.sum() / MASS - 1) < 16 * EPS
    np.testing.assert_allclose(mass @ where, 0, atol=64 * EPS * MASS * RADIUS)  # the centre of mass is the centre
    integrated = np.einsum("p,pi,pj", mass, where, where)
    np.testing.assert_allclose(tensor, integrated, rtol=0, atol=3e-13 * MASS * RADIUS**2)  # thickness 1e-13: as much


def test_a_batch_of_bowling_balls_may_have_one_whose_block_is_at_the_centre():
    offset = np.array([[0.0, 0.0, 0.0], OFFSET])
    given = {"mass": np.full(2, MASS), "radius": np.full(2, RADIUS), "block_mass": np.full(2, BLOCK)}
    tensor = PRESETS["bowling"](**given, block_size=np.array([SIZE, SIZE]), block_offset=offset)
    even = (MASS - BLOCK) * RADIUS**2 / 5 + BLOCK * np.array(SIZE) ** 2 / 12
    np.testing.assert_allclose(tensor[0], np.diag(even), rtol=4 * EPS)


@pytest.mark.parametrize(
    ("preset", "keys", "sentence"),
    [
        ("shell", {"thickness": 0.2}, "thickness must be from 0 to the radius"),
        ("shell", {"thickness": -0.01}, "thickness must be from 0 to the radius"),
        ("dumbbell", {"point_mass": 3.6, "separation": 0.1}, "the two point masses are more than the mass"),
        ("dumbbell", {"point_mass": -1, "separation": 0.1}, "point_mass must not be negative"),
        ("dumbbell", {"point_mass": 1, "separation": 0.22}, "separation must be from 0 to the inside"),
        ("dumbbell", {"point_mass": 1, "separation": 0.2, "thickness": 0.01}, "separation must be from 0 to the"),
        ("bowling", {"block_mass": 6.9, "block_size": SIZE, "block_offset": OFFSET}, "are more than the mass"),
        ("bowling", {"block_mass": -1, "block_size": SIZE, "block_offset": OFFSET}, "block_mass must not be negative"),
        ("bowling", {"block_mass": 1, "block_size": (0.05, -0.1, 0), "block_offset": OFFSET}, "block_size must not"),
        ("bowling", {"block_mass": 1, "block_size": SIZE, "block_offset": (0.08, 0, 0)}, "beyond the radius"),
    ],
)
def test_a_body_that_cannot_be_is_refused(preset, keys, sentence):
    given = {name: np.array([value]) for name, value in {"mass": MASS, "radius": RADIUS, **keys}.items()}
    with pytest.raises(BadInput, match=sentence):
        PRESETS[preset](**given)


def test_mass_outside_of_the_ball_is_refused_and_a_shell_is_not():
    thin = PRESETS["shell"](np.array([MASS]), np.array([RADIUS]))
    check_inside(thin, np.array([MASS]), np.array([RADIUS]))
    with pytest.raises(BadInput, match="some of its mass is outside of the ball"):
        check_inside(thin * (1 + 1e-11), np.array([MASS]), np.array([RADIUS]))


moments = st.tuples(*[st.floats(0.01, 10)] * 3)
turns = st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda q: np.linalg.norm(q) > 0.1)


@given(moments, turns)
def test_principal_axes_give_the_tensor_back(J, turn):
    q = np.array(turn) / np.linalg.norm(turn)
    basis = np.stack([kernels.rotate(q, e) for e in np.eye(3)], axis=-1)
    tensor = (basis * J) @ basis.T
    tensor = (tensor + tensor.T) / 2
    found, axes = principal(tensor[None])
    if axes is None:
        assert found[0].tolist() == np.diagonal(tensor).tolist()
        return
    columns = np.stack([kernels.rotate(axes[0], e) for e in np.eye(3)], axis=-1)
    np.testing.assert_allclose((columns * found[0]) @ columns.T, tensor, atol=64 * EPS * max(J))
    assert abs(np.linalg.norm(axes[0]) - 1) < 4 * EPS
    np.testing.assert_allclose(np.linalg.det(columns), 1, atol=16 * EPS)
    np.testing.assert_allclose(np.sort(found[0]), np.sort(J), atol=64 * EPS * max(J))


def test_a_small_turn_of_the_body_is_a_small_turn_of_the_axes_and_a_diagonal_tensor_keeps_them():
    """In the given order, with the given signs: not that in which the moments grow."""
    J = np.array([3.0, 1.0, 2.0])
    q = np.array([1, 0.01, -0.02, 0.015])
    q = q / np.linalg.norm(q)
    basis = np.stack([kernels.rotate(q, e) for e in np.eye(3)], axis=-1)
    found, axes = principal(((basis * J) @ basis.T)[None])
    np.testing.assert_allclose(found[0], J, atol=16 * EPS)
    np.testing.assert_allclose(axes[0], q, atol=16 * EPS)
    turned = np.array([[2.0, 0.1, 0], [0.1, 1, 0], [0, 0, 3]])
    found, axes = principal(np.stack([np.diag([3.0, 1.0, 2.0]), turned]))
    assert found[0].tolist() == [3.0, 1.0, 2.0]
    assert axes[0].tolist() == [1.0, 0.0, 0.0, 0.0]
    assert axes[1, 3] != 0


@pytest.mark.parametrize(
    ("inertia", "taken"),
    [
        ([0.00123, 0.00134, 0.00258], True),  # a thin disc, whose third moment is the sum of the others, rounded
        ([0.00123, 0.00134, 0.00262], False),
        ([0.001230000001, 0.001340000001, 0.00258], False),  # its digits say more
        ([[0.00123, 0.0, 0.0], [0.0, 0.00134, 1e-5], [0.0, 1e-5, 0.00258]], True),
        ([0.1, 0.2, 0.4], False),  # a digit is no excuse for an eighth
        ([1.0, 2.0, 4.0], False),
    ],
)
def test_the_digits_of_an_inertia_say_what_rounding_may_have_done(inertia, taken):
    ball = {"inertia": inertia, "D": 1}
    scene = checked({"ball": ball, "start": {"omega": [1, 2, 3]}, "run": {"time": 1.0}})
    if taken:
        assert expand(scene).ball.mass_tensor.min() == 0.0
    else:
        with pytest.raises(BadInput, match="no body has the inertia"):
            expand(scene)
