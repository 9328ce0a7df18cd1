"""Scene files: what is read, and what is refused with its key."""

import os
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from chapsym import scene
from chapsym.dynamics.certified import exactly
from chapsym.scene import SceneError
from chapsym.scene.result import formats
from chapsym.scene.running import sweep
from chapsym.scene.running.source import plan_of

GOOD = """
[ball]
mass_tensor = [1, 2, "4"]
D = 3
[start]
momentum = [0.1, "-1/20", 0.075]
gamma = ["2/7", "3/7", "6/7"]
[run]
steps = 10
"""


@pytest.fixture
def write(tmp_path):
    def written(text):
        path = tmp_path / "scene.toml"
        path.write_text(text, encoding="utf-8")
        return path

    return written


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("steps = 10", "steps = 10\nstep = 1", "line 10: run.step is not a key of [run]; did you mean steps?"),
        ('"2/7"', '"2/0"', "line 7: start.gamma.1: '2/0' divides by zero"),
        ("0.1", "nan", "line 6: start.momentum.1 must be finite"),
        ("[ball]", "[ball", "is not TOML"),
        ("[ball]", "a = " + "[" * 20000 + "\n[ball]", "is not TOML"),
        ("[ball]", "a = " + "9" * 20000 + "\n[ball]", "is not TOML"),
        ("[ball]", ".".join("a" * 50_000) + " = 1\n[ball]", "is no scene: its tables are nested too deeply"),
        ("steps = 10", "steps." + ".".join("a" * 1500) + " = 10", "is no scene: its tables are nested too deeply"),
        ("D = 3", "D = 1" + "0" * 400, "line 4: ball.D is beyond the range of float64"),
        ("0.1", "1e-400", "start.momentum.1 is below 2.2e-308, where float64 loses its digits"),
        ("0.1", "1.234_567e-315", "start.momentum.1 is below 2.2e-308"),
        ("0.1", '"1e-315"', "start.momentum.1"),
    ],
)
def test_a_wrong_scene_names_the_key_and_what_would_be_right(write, old, new, sentence):
    with pytest.raises(SceneError) as caught:
        scene.load(write(GOOD.replace(old, new, 1)))
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_pipe_is_no_scene_and_is_not_waited_for_but_standard_input_may_be_one(tmp_path):
    os.mkfifo(tmp_path / "scene.toml")
    with pytest.raises(SceneError, match=r"scene\.toml is a pipe, not a file with a scene"):
        scene.load(tmp_path / "scene.toml")
    read, write = os.pipe()
    os.write(write, GOOD.encode())
    os.close(write)
    assert scene.load(Path(f"/dev/fd/{read}")).run.steps == 10
    os.close(read)


ACCURATE = (
    GOOD.replace('momentum = [0.1, "-1/20", 0.075]', "omega = [3, -2, 1]")
    .replace("D = 3", "mass = 2.0\nradius = 0.1")
    .replace('[1, 2, "4"]', "[0.005, 0.004, 0.002]")
    .replace("steps = 10", "accuracy = 1e-7\ntime = 4.0\nframes = 2\ncontact = true")
)


def test_a_scene_may_ask_for_an_accuracy(write, tmp_path):
    wanted = scene.load(write(ACCURATE))
    plan, answers = sweep.telling(plan_of(wanted), lambda text: None)
    data = sweep.run_in_memory(plan)
    (answer,) = answers
    assert answer.request.of == "contact"
    assert data.error.values[0] == answer.estimate <= 1e-7
    assert data.time.values.tolist() == [0.0, 2.0, 4.0]
    fine = sweep.run_in_memory(plan_of(wanted.with_run(accuracy=1e-12)))
    np.testing.assert_allclose(data.contact, fine.contact, atol=1.1e-7)
    formats.save(data, tmp_path / "run.npz")
    assert np.load(tmp_path / "run.npz")["time"].tolist() == [0.0, 2.0, 4.0]


@pytest.mark.parametrize("given", ["1 um", "1e-6", "1/1000000"])
def test_an_accuracy_of_the_contact_point_may_have_a_unit(write, given):
    wanted = scene.load(write(ACCURATE.replace("accuracy = 1e-7", f"accuracy = '{given}'"))).task()
    assert wanted.accuracy == 1e-6
    assert type(wanted.accuracy) is float


def test_more_digits_than_float64_has_are_written(write, tmp_path):
    text = ACCURATE.replace("1e-7", "1e-19").replace("[run]", "position = [0.1, 0.2]\n[run]")
    plan, answers = sweep.telling(plan_of(scene.load(write(text))), lambda text: None)
    formats.save(sweep.run_in_memory(plan), tmp_path / "run.npz")
    data, exact = np.load(tmp_path / "run.npz"), exactly(answers[0].trajectory, "contact")
    assert abs(data["contact_low"][-1]).max() > 0
    for place, axis in ((Fraction(0.1), 0), (Fraction(0.2), 1)):
        high, low = (Fraction(float(data[name][-1, axis])) for name in ("contact", "contact_low"))
        assert abs(high + low - place - exact[-1, axis]) < 1e-32
        assert float(high + low) == high
    assert abs(data["momentum_low"][-1]).max() > 0
