"""The balls of a scene: what a start means, in which axes, and refusals that name the ball."""

import json

import numpy as np
import pytest

from chapsym import Ball, axial, roll, skew, trajectory
from chapsym.dynamics import kernels
from chapsym.dynamics.attitudes import attitude_with
from chapsym.scene import SceneError, checked
from chapsym.scene.members.members import expand
from chapsym.scene.read.tables import units_of

EPS = np.finfo(np.float64).eps
BALL = {"inertia": [0.006, 0.007, 0.009], "mass": 2.0, "radius": 0.1}
GAMMA = [2 / 7, 3 / 7, 6 / 7]
TURN = np.array([0.8, 0.2, -0.4, 0.4])
RUN = {"time_step": 0.001, "steps": 2000}


def members(start, ball=BALL, run=RUN, **more):
    return expand(checked({"ball": ball, "start": start, "run": run, **more}))


def rolled(found, steps=2000, **options):
    """The trajectory of the first ball, with its contact point, from its own place."""
    ball = Ball(found.ball.mass_tensor[0], found.ball.D[0], found.ball.radius[0])
    attitude = True if found.attitude is None else found.attitude[0]
    start = ball, found.momentum[0], found.gamma[0]
    return trajectory(*start, steps, attitude=attitude, contact=True, time_step=0.001, **options)


def matrix(q):
    return np.stack([kernels.rotate(q, e) for e in np.eye(3)], axis=-1)


def test_angles_in_degrees_are_not_taken_for_radians():
    with pytest.raises(SceneError, match=r'start\.rpy is in radians, and 90 is more than a turn; .* "90 deg"'):
        members({"omega": [1, 2, 3], "rpy": [90.0, 0, 45.0]})


def test_a_start_by_omega_is_that_of_roll_and_one_by_momentum_is_kept_to_the_bit():
    found = members({"omega": [3, -2, 1], "gamma": GAMMA})
    run = roll(Ball.from_inertia(BALL["inertia"], mass=2.0, radius=0.1), (3, -2, 1), 0.001, 10, gamma=GAMMA)
    assert found.momentum[0].tolist() == run.momentum[0].tolist()
    assert found.gamma[0].tolist() == GAMMA
    assert (found.axes, found.attitude, found.place, found.parameters) == (None, None, None, {})
    assert found.names == ("ball",)
    found = members({"momentum": ["1/10", -0.05, 0.075], "gamma": ["2/7", "3/7", "6/7"]}, run={"steps": 3})
    assert found.momentum[0].tolist() == [0.1, -0.05, 0.075]
    vertical = members({"vertical_momentum": 0.3, "gamma": GAMMA}, run={"steps": 3})
    assert vertical.momentum[0].tolist() == (0.3 * np.array(GAMMA)).tolist()


def test_numpy_arrays_are_lists_and_the_source_is_json():
    ball = {"mass_tensor": np.array([1, 2, 4]), "D": np.float64(3), "radius": np.float32(0.5)}
    made = checked({"ball": ball, "start": {"momentum": (np.int64(1), 0, 0)}, "run": {"steps": np.int64(3)}})
    assert expand(made).ball.mass_tensor.tolist() == [[1.0, 2.0, 4.0]]
    again = checked(json.loads(made.source))
    assert (again, again.source) == (made, made.source)


@pytest.mark.parametrize("start", [{"gamma": GAMMA}, {"attitude": TURN.tolist()}, {}])
@pytest.mark.parametrize("velocity", [[1.5, 0], [0, 1.5], [-0.7, 2.1]])
def test_a_velocity_is_that_of_the_contact_point(start, velocity):
    """Of a homogeneous ball, which rolls straight on: the trace is velocity times time, whatever the attitude."""
    found = members(
        {"velocity": velocity, "spin": 3.0, **start}, {"preset": "homogeneous", "mass": 2, "radius": 0.1},
    )  # fmt: skip
    run = rolled(found, order=8)
    np.testing.assert_allclose(run.contact[-1], 2 * np.array(velocity), atol=1e-9)


def test_velocity_and_spin_start_any_ball_as_told():
    """Its first steps, extrapolated: (x(ε) - x(-ε))/2ε is the velocity up to ε²."""
    found = members({"velocity": [1.5, -0.4], "spin": "40 rpm", "attitude": TURN.tolist()})
    there = rolled(found, 1).contact[1]
    found.momentum[0] *= -1
    back = rolled(found, 1).contact[1]
    np.testing.assert_allclose((there - back) / 0.002, [1.5, -0.4], atol=2e-4)  # |ω|²ε² of 1.5 m/s
    omega = kernels.angular_velocity(-found.momentum / 0.001, found.gamma, found.ball.mass_tensor, found.ball.D)
    np.testing.assert_allclose(kernels.rotate(found.attitude, omega)[0], [4, 15, 40 * 2 * np.pi / 60], rtol=64 * EPS)


def test_omega_in_space_axes_is_turned_to_the_body():
    R = matrix(TURN)
    body = members({"omega": (R.T @ [1, 2, 3]).tolist(), "attitude": TURN.tolist()})
    space = members({"omega": [1, 2, 3], "axes": "space", "attitude": TURN.tolist()})
    np.testing.assert_allclose(space.momentum, body.momentum, rtol=32 * EPS)
    np.testing.assert_allclose(space.gamma[0], R.T @ [0, 0, 1], atol=4 * EPS)
    np.testing.assert_allclose(space.attitude[0], TURN, atol=2 * EPS)
    least = members({"omega": [1, 2, 3], "axes": "space", "gamma": GAMMA})
    R = matrix(attitude_with(np.array(GAMMA)))
    body = members({"omega": (R.T @ [1, 2, 3]).tolist(), "gamma": GAMMA})
    np.testing.assert_allclose(least.momentum, body.momentum, rtol=32 * EPS)


@pytest.mark.parametrize(
    "start",
    [
        {"omega": [3, -2, 1], "gamma": GAMMA},
        {"omega": [3, -2, 1], "attitude": TURN.tolist()},
        {"omega": [3, -2, 1], "axes": "space", "attitude": TURN.tolist()},
        {"velocity": [0.5, 1], "attitude": TURN.tolist(), "position": ["1 cm", -2]},
        {"momentum": [1e-4, -2e-4, 3e-4], "gamma": GAMMA},
    ],
)
def test_a_body_given_in_other_axes_rolls_the_same_way(start):
    """The same body, words in axes that are turned by Q: its start words in the same axes gives the same trace."""
    turn = np.array([0.9, 0.1, 0.3, -0.3])
    turn /= np.linalg.norm(turn)
    Q = matrix(turn)
    tensor = Q @ np.diag(BALL["inertia"]) @ Q.T
    turned = dict(start)
    for key in ("gamma", "momentum") + (("omega",) if start.get("axes") != "space" else ()):
        if key in start:
            turned[key] = (Q @ start[key]).tolist()
    if "attitude" in start:
        turned["attitude"] = kernels.compose(TURN, turn * [1, -1, -1, -1]).tolist()
    plain = members(start)
    other = members(turned, BALL | {"inertia": ((tensor + tensor.T) / 2).tolist()})
    assert other.axes is not None
    one, same = rolled(plain).contact, rolled(other).contact
    if "attitude" not in start:  # the least rotation is another one: the traces are turned about the vertical
        one, same = np.linalg.norm(one, axis=1), np.linalg.norm(same, axis=1)
    np.testing.assert_allclose(same, one, atol=1e-9)
    if plain.place is not None:
        assert other.place[0].tolist() == plain.place[0].tolist() == [0.01, -2.0]


def test_the_attitude_is_of_the_given_axes_whatever_the_principal_are():
    tensor = [[0.02, 0.001, 0], [0.001, 0.021, 0.002], [0, 0.002, 0.025]]
    ball = {"inertia": tensor, "mass": 3, "radius": 0.15}
    found = members({"omega": [1, 2, 3], "attitude": TURN.tolist()}, ball)
    back = kernels.compose(found.attitude, found.axes * [1, -1, -1, -1])  # principal to space, after given to principal
    np.testing.assert_allclose(back[0], TURN, atol=4 * EPS)
    J = np.trace(tensor) / 2 * np.eye(3) - np.array(tensor)
    Q = matrix(found.axes[0])
    np.testing.assert_allclose((Q * found.ball.mass_tensor[0]) @ Q.T, J, atol=4 * EPS)
    least = members({"omega": [1, 2, 3], "gamma": GAMMA}, ball)
    given = kernels.compose(least.attitude, least.axes * [1, -1, -1, -1])
    np.testing.assert_allclose(given[0], attitude_with(np.array(GAMMA)), atol=4 * EPS)


def test_a_quaternion_may_have_its_scalar_last_and_roll_pitch_and_yaw_are_about_the_fixed_axes_in_this_order():
    """Checked by what it does to vectors, each rotation typed as a matrix."""
    last = members({"omega": [1, 2, 3], "quaternion_xyzw": np.roll(TURN, -1).tolist()})
    first = members({"omega": [1, 2, 3], "attitude": TURN.tolist()})
    assert (last.attitude == first.attitude).all()
    assert (last.momentum == first.momentum).all()
    roll_, pitch, yaw = 0.3, -0.5, 2.0
    c, s = np.cos, np.sin
    about_x = np.array([[1, 0, 0], [0, c(roll_), -s(roll_)], [0, s(roll_), c(roll_)]])
    about_y = np.array([[c(pitch), 0, s(pitch)], [0, 1, 0], [-s(pitch), 0, c(pitch)]])
    about_z = np.array([[c(yaw), -s(yaw), 0], [s(yaw), c(yaw), 0], [0, 0, 1]])
    found = members({"omega": [1, 2, 3], "axes": "space", "rpy": [f"{float(np.rad2deg(roll_))} deg", pitch, yaw]})
    R = about_z @ about_y @ about_x
    np.testing.assert_allclose(matrix(found.attitude[0]), R, atol=4 * EPS)
    np.testing.assert_allclose(found.gamma[0], R.T @ [0, 0, 1], atol=4 * EPS)


def test_an_angle_may_be_swept_and_what_is_no_unit_quaternion_is_told_as_it_is_written():
    found = members({"omega": [1, 2, 3], "rpy": [0, {"linspace": [0, "90 deg", 3]}, 0]})
    assert units_of("start.rpy.2") == "rad"
    assert found.parameters["start.rpy.2"].tolist() == pytest.approx([0, np.pi / 4, np.pi / 2])
    assert found.gamma[2] == pytest.approx([-1, 0, 0], abs=2 * EPS)
    drawn = members({"omega": [1, 2, 3], "quaternion_xyzw": [0, {"random": [0, 1]}, 0, 1]}, sweep={"samples": 3})
    assert np.linalg.norm(drawn.attitude, axis=-1) == pytest.approx(1)
    with pytest.raises(SceneError, match=r"quaternion_xyzw must be a unit quaternion \(scalar last\)"):
        members({"omega": [1, 2, 3], "quaternion_xyzw": [1, 1, 0, 0]})
    four = {"mass_tensor": [1, 2, 0.5, 3], "D": 7}
    with pytest.raises(SceneError, match=r"start\.rpy is for three dimensions"):
        members({"momentum": (0 * np.eye(4)).tolist(), "rpy": [0, 0, 1]}, four, {"steps": 1})


def test_several_balls_have_their_own_starts_or_the_common_one():
    balls = [
        BALL | {"name": "first"},
        {"preset": "shell", "mass": 1, "radius": 0.2, "start": {"momentum": [0.1, 0, 0]}},
        {"inertia": [[2, 0.1, 0], [0.1, 2.1, 0], [0, 0, 2.2]], "D": {"grid": [3, 4]}, "radius": 1, "name": "third"},
    ]
    found = members({"omega": [1, 2, 3], "position": [1, 2]}, balls)
    assert found.names == ("first", "ball 2", "third 1", "third 2")
    assert found.ball.radius.tolist() == [0.1, 0.2, 1.0, 1.0]
    assert found.place.tolist() == [[1, 2], [0, 0], [1, 2], [1, 2]]
    assert found.momentum[1].tolist() == [0.1, 0, 0]
    assert found.axes[:2].tolist() == [[1, 0, 0, 0]] * 2
    np.testing.assert_array_equal(found.parameters["ball.D"], [np.nan, np.nan, 3, 4])
    for i, ball in enumerate(balls[:2]):
        alone = members({"omega": [1, 2, 3], "position": [1, 2]}, ball)
        assert alone.momentum[0].tolist() == found.momentum[i].tolist()


def test_a_ball_in_n_dimensions_is_that_of_three():
    three = members({"omega": [1, 2, 3], "gamma": GAMMA}, {"mass_tensor": [1, 2, 4], "D": 3})
    wide = np.zeros((4, 4))
    wide[:3, :3] = skew((1, 2, 3))
    gamma = [*GAMMA, 0.0]
    four = members({"omega": wide.tolist(), "gamma": gamma}, {"mass_tensor": [1, 2, 4, 0.5], "D": 3})
    assert four.dimension == 4
    np.testing.assert_allclose(axial(four.momentum[0, :3, :3]), three.momentum[0], rtol=8 * EPS)
    again = members({"momentum": four.momentum[0].tolist(), "gamma": gamma}, {"mass_tensor": [1, 2, 4, 0.5], "D": 3})
    assert again.momentum.tolist() == four.momentum.tolist()


def test_unit_vectors_typed_with_few_digits_are_divided_and_those_that_vary_too():
    near = members({"omega": [1, 2, 3], "attitude": [0.9238795, 0.3826834, 0, 0]})
    assert abs(np.linalg.norm(near.attitude[0]) - 1) < 2 * EPS
    vary = members({"omega": [1, 2, 3], "gamma": [{"linspace": [0, 1, 3]}, 0, 1]})
    np.testing.assert_allclose(vary.gamma[2], [0.5**0.5, 0, 0.5**0.5], atol=EPS)
    assert vary.parameters["start.gamma.1"].tolist() == [0, 0.5, 1]


@pytest.mark.parametrize(
    ("ball", "start", "sentence"),
    [
        ({"inertia": [1, 2, 4]}, {}, "ball: no body has the inertia (1, 2, 4)"),
        ({"inertia": [[1, 0, 0.1], [0, 1, 0], [0.1, 0, 4]]}, {}, "ball: no body has the inertia ("),
        ({"inertia": [[1, 0.2, 0], [0.1, 1, 0], [0, 0, 1]]}, {}, "ball: inertia must be symmetric, but"),
        ({"inertia": [60, 70, 90]}, {}, "ball: some of its mass is outside of the ball: J1 + J2 + J3 = 110 kg m²"),
        ({"radius": {"linspace": [0.2, 0.01, 20]}}, {}, "ball 14 (ball.radius = 0.07): some of its mass is outside"),
        ({"name": "x", "mass": {"grid": [1.5, 2, 0]}}, {}, "x 3 (ball.mass = 0): mass and radius must be positive"),
        ({}, {"gamma": [0, 0, 2]}, "ball: gamma must be a unit vector, but its length is 2"),
        ({}, {"gamma": [0, 0, 0, 1]}, "ball: gamma must have 3 components"),
        ({}, {"gamma": [0, 0, {"grid": [1, 0]}]}, "ball 2 (start.gamma.3 = 0): start.gamma must not be 0"),
        ({}, {"attitude": [1, 1, 0, 0]}, "ball: attitude must be a unit quaternion (scalar first), but its length is"),
        ({}, {"position": [0, 0, 0]}, "ball: start.position must have 2 numbers"),
        ({}, {"omega": [1e-310, 0, 0.0]}, "ball: K = Λω - D⟨ω,γ⟩γ is below the range of float64"),
        ({"mass_tensor": [1e5] * 3}, {"omega": [0, 1e308, 0]}, "ball: K = Λω - D⟨ω,γ⟩γ is beyond the range of float64"),
        ({}, {"omega": [[0, 1, 0, 0]] * 4}, "ball: start.omega must be three numbers"),
        ({"mass_tensor": [1, 2, 3, 4]}, {}, "ball: start.omega must be skew matrices of the shape (..., 4, 4)"),
        ({"mass_tensor": [0, 0, 0]}, {}, "ball: mass_tensor must not be (0, 0, 0)"),
    ],
)
def test_what_cannot_be_is_refused_with_the_name_of_the_ball(ball, start, sentence):
    other = {"mass_tensor", "preset"} & set(ball)
    table = {key: value for key, value in BALL.items() if not other or key != "inertia"} | ball
    if "D" in ball or "mass_tensor" in ball:
        table = {key: value for key, value in table.items() if key != "mass"} | {"D": ball.get("D", 3)}
    with pytest.raises(SceneError) as caught:
        members({"omega": [1, 2, 3]} | start, table)
    assert str(caught.value).startswith(sentence)


def test_balls_of_one_name_by_a_sweep_or_of_different_dimensions_and_radii_are_refused():
    swept = BALL | {"name": "a", "mass": {"grid": [2, 3]}}
    with pytest.raises(SceneError, match="two balls have the name 'a 2'"):
        members({"omega": [1, 2, 3]}, [swept, BALL | {"name": "a 2"}])
    four = {"mass_tensor": [1, 2, 3, 4], "D": 3, "start": {"momentum": np.zeros((4, 4)).tolist()}}
    with pytest.raises(SceneError, match="the balls of a scene roll in one space"):
        members({"omega": [1, 2, 3]}, [BALL, four])
    with pytest.raises(SceneError, match="some balls have a radius and others have none"):
        members({"omega": [1, 2, 3]}, [BALL, {"inertia": [1, 1, 1], "D": 3}])
