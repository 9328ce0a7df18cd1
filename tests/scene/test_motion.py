"""What a scene gives is the motion of the ball: every frame beside an integration that shares nothing with chapsym."""

import math

import motion_judge
import motion_reference
import numpy as np
import pytest
import random_scenes
from motion_judge import judge
from motion_reference import Balls, matrix, motion

import chapsym

#: What a scene promises without further words, of γ, ω by the largest, attitude (radians) and contact point by radius.
DEFAULT = 1e-6
#: Of a second of the processor or two together: one ball with a full tensor, a sweep, several balls, near a separatrix.
QUICK = ("bowling", "13", "24", "27", "31", "35")


def one_ball(inertia, D, omega, attitude=(0.5, 0.1, -0.7, 0.5)):
    q = np.array(attitude) / np.linalg.norm(attitude)
    arrays = (np.diag(inertia), D, 0.2, q, omega, (0.0, 0.0))
    return Balls(*(np.array([x], dtype=float) for x in arrays))


def turned(v):
    """The rotation matrix of a rotation vector."""
    angle = np.linalg.norm(v)
    return matrix(np.array([math.cos(angle / 2), *(math.sin(angle / 2) * np.array(v) / angle)]))


def test_the_reference_obeys_newtons_laws():
    balls = one_ball((0.005, 0.007, 0.009), 0.02, (20.0, -3.0, 5.0))
    gamma, omega, rotation, contact = motion_reference.newton(balls, 0.03)
    found = {name: part[0, -1] for name, part in motion(balls, np.array([0.0, 0.03])).items()}
    np.testing.assert_allclose(found["gamma"], gamma, atol=1e-12)
    np.testing.assert_allclose(found["omega"], omega, atol=1e-11)
    np.testing.assert_allclose(matrix(found["attitude"]), rotation, atol=1e-12)
    np.testing.assert_allclose(found["contact"], contact, atol=1e-13)


def test_the_reference_rolls_a_homogeneous_ball_straight():
    balls = one_ball((0.01, 0.01, 0.01), 0.03, (3.0, -2.0, 4.0))
    R = matrix(balls.attitude[0])
    in_space = R @ balls.omega[0]
    found = motion(balls, np.array([0.0, 1.5]))
    np.testing.assert_allclose(matrix(found["attitude"][0, -1]), turned(1.5 * in_space) @ R, atol=1e-11)
    np.testing.assert_allclose(found["contact"][0, -1], 1.5 * 0.2 * np.array([in_space[1], -in_space[0]]), atol=1e-12)


def test_the_reference_spins_a_free_symmetric_top_in_closed_form():
    balls = one_ball((0.01, 0.01, 0.004), 0.0, (3.0, -2.0, 7.0))
    R = matrix(balls.attitude[0])
    precession = R @ (np.array([0.01, 0.01, 0.004]) * balls.omega[0]) / 0.01
    spin = np.array([0.0, 0.0, (1 - 0.004 / 0.01) * 7.0])
    found = motion(balls, np.array([0.0, 1.5]))
    np.testing.assert_allclose(
        matrix(found["attitude"][0, -1]), turned(1.5 * precession) @ R @ turned(1.5 * spin), atol=1e-11
    )


def test_the_random_scenes_say_everything_that_a_start_can():
    text = "".join(random_scenes.toml(random_scenes.scene(n)) for n in range(random_scenes.COUNT))
    said = [
        "inertia = [[",
        "mass_tensor",
        "preset",
        "lb",
        "rpm",
        "kg cm^2",
        'axes = "space"',
        "gamma",
        "attitude",
        "spin",
    ]
    said += ["velocity", "position", "linspace", "grid", "random", "normal", "[[ball]]", "start = {", "every", "frames"]
    assert [one for one in said if one not in text] == []


@pytest.mark.parametrize("name", ["1", "13", "25", "34"])
def test_to_a_fine_accuracy_all_agree(name):
    """A wrong frame, sign or unit on either side would be seen at once."""
    row = judge(name, accuracy=1e-10)
    assert row.worst < 1e-8, row.line()


def test_the_map_is_not_the_motion():
    assert judge("34", order=2).worst > 0.01


@pytest.mark.parametrize(("name", "order"), [("vertical", 2), ("four", 2), ("four", 6)])
def test_a_momentum_of_one_step_stays_the_map(name, order):
    """These scenes have no time; they are the paper's, or its compositions."""
    scene = motion_judge.scene_of(name)
    scene["run"] |= {"steps": 40, "order": order}
    result = chapsym.run_scene(scene).dataset.isel(ball=0)
    assert "time" not in result.coords
    ball = motion_reference.si(scene["ball"]["mass_tensor"]), scene["ball"]["D"]
    gamma = motion_reference.unit(motion_reference.si(scene["start"]["gamma"]))
    start = motion_reference.si(scene["start"]["momentum"]), gamma, scene["run"]["steps"]
    of, run = (chapsym.Ball, chapsym.trajectory) if name == "vertical" else (chapsym.BallN, chapsym.trajectory_n)
    found = run(of(*ball), *start, order=order, every=scene["run"].get("every", 1))
    np.testing.assert_allclose(result["momentum"], found.momentum, atol=1e-11)
    np.testing.assert_allclose(result["gamma"], found.gamma, atol=1e-11)


@pytest.mark.parametrize("name", QUICK)
def test_a_scene_gives_the_motion(name):
    row = judge(name)
    assert row.worst <= DEFAULT, f"\n{motion_judge.HEAD}\n{row.line()}"


def test_every_scene_gives_the_motion(thorough):
    if not thorough:
        pytest.skip("some do; make thorough takes all")
    off = [row.line() for row in map(judge, motion_judge.names()) if not row.worst <= DEFAULT]
    assert off == [], "\n".join(["", motion_judge.HEAD, *off])


@pytest.mark.parametrize("outputs", [["momentum", "gamma", "omega"], ["vertical_momentum", "momentum_squared"]])
def test_a_state_has_one_momentum_however_often_it_is_written_down(outputs):
    scene = {
        "ball": {"inertia": [0.006, 0.007, 0.009], "mass": 2.0, "radius": 0.1},
        "start": {"omega": [3, -2, 1], "gamma": ["2/7", "3/7", "6/7"]},
    }
    found = [
        chapsym.run_scene(scene | {"run": {"time": 1.0, "outputs": outputs, **run}}).dataset.isel(frame=-1)
        for run in ({"time_step": 0.1}, {"time_step": 0.01}, {"frames": 4})
    ]
    for name in outputs:
        assert len({one[name].attrs["units"] for one in found}) == 1
        for one in found[1:]:
            np.testing.assert_allclose(one[name], found[0][name], rtol=1e-6)
    if "momentum" in outputs:
        assert found[0]["momentum"].attrs["units"] == "kg m2 s-1"
        np.testing.assert_allclose(found[0]["momentum"].values[0], [0.08638, -0.00467, 0.04276], atol=5e-6)
