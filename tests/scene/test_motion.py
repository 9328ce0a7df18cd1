"""What a scene gives is the motion of the ball: every frame beside an integration that shares nothing with chapsym.

That a ball of a sweep is the ball alone, test_ranges.py sees.
"""

from pathlib import Path

import motion_reference
import numpy as np
import pytest
import random_scenes
from budget import slow

import chapsym

#: Those with a motion in time; four.toml and vertical.toml begin with a momentum of one step of the map, and have none.
SHIPPED = ("bowling", "robot")
#: What a scene promises without further words, of γ, ω by the largest, attitude (radians) and contact point by radius.
DEFAULT = 1e-6
#: Of less than a second of the processor together: several balls, near a separatrix.
QUICK = ("24", "31", "16")


def scene_of(name):
    """The tables of a scene: a random one, or a shipped one."""
    if name.isdigit():
        return random_scenes.scene(int(name))
    return motion_reference.load(Path(chapsym.__file__).parent / "scene" / "examples" / f"{name}.toml")


def far(name, **run):
    """The largest distance from the motion of any part at any frame of any ball; infinite where none was reached.

    Of γ, of ω by the ball's largest, of the attitude as an angle in radians, of the contact point by the radius.
    """
    scene = scene_of(name)
    if "accuracy" in run:  # which chooses the steps
        scene["run"] = {"outputs": scene["run"]["outputs"]}
    scene["run"] |= run
    result, balls = chapsym.run_scene(scene).dataset, motion_reference.balls_of(scene)
    moments = motion_reference.times(scene["run"])
    np.testing.assert_allclose(result["time"].values, moments, rtol=1e-12, atol=1e-15)
    distances = []
    for part, true in motion_reference.motion(balls, moments).items():
        if part not in result:
            continue
        off = np.linalg.norm(result[part].values - true, axis=-1)
        if part == "omega":
            off = off / np.linalg.norm(true, axis=-1).max(axis=-1, keepdims=True)
        if part == "contact":
            off = off / balls.radius[:, np.newaxis]
        if part == "attitude":  # q and -q are one attitude
            off = np.minimum(off, np.linalg.norm(result[part].values + true, axis=-1))
            off = 4 * np.arcsin(np.minimum(off / 2, 1.0))
        distances.append(off.max() if np.isfinite(off).all() else np.inf)
    assert distances
    return max(distances)


@pytest.mark.parametrize("name", ["1", "13", *slow("25", "34")])
def test_to_a_fine_accuracy_all_agree(name):
    """A wrong frame, sign or unit on either side would be seen at once."""
    moments = motion_reference.times(scene_of(name)["run"])
    assert far(name, accuracy=1e-10, time=float(moments[-1]), frames=len(moments) - 1) < 1e-8


def test_the_map_is_not_the_motion():
    assert far("34", order=2) > 0.01


@pytest.mark.parametrize(("name", "order"), [("vertical", 2), ("four", 2), ("four", 6)])
def test_a_momentum_of_one_step_stays_the_map(name, order):
    """These scenes have no time; they are the paper's, or its compositions."""
    scene = scene_of(name)
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


@pytest.mark.parametrize("name", [*QUICK, *slow(*sorted({*SHIPPED, *map(str, range(random_scenes.COUNT))} - {*QUICK}))])
def test_a_scene_gives_the_motion(name):
    assert far(name) <= DEFAULT


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
