"""Scene files: what goes with what under [run], [ball] and [start], and the sentence for what does not."""

import os
import re
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from first import BALL

from chapsym import scene
from chapsym.dynamics.certified import exactly
from chapsym.scene import SceneError, checked
from chapsym.scene.members.members import expand
from chapsym.scene.plan.plan import plan_of
from chapsym.scene.result import formats
from chapsym.scene.running import sweep

DATA = {
    "ball": {"inertia": [0.006, 0.007, 0.009], "mass": 2.0, "radius": 0.1},
    "start": {"omega": [3, -2, 1]},
    "run": {"time_step": 0.01, "steps": 1000},
}


def given(table):
    """Without the keys that are None."""
    return {key: value for key, value in table.items() if value is not None} if isinstance(table, dict) else table


def with_run(**run):
    return checked(DATA | {"run": given({"time_step": 0.01} | run)})


def refused(sentence):
    return pytest.raises(SceneError, match=re.escape(sentence))


@pytest.fixture
def write(tmp_path):
    def written(text):
        path = tmp_path / "scene.toml"
        path.write_text(text, encoding="utf-8")
        return path

    return written


#: The accuracy after a time, which chooses the steps.
ACCURATE = {"time_step": None, "accuracy": 1e-7, "time": 4.0}


@pytest.mark.parametrize(
    ("run", "steps", "every"),
    [
        ({"steps": 1000}, 1000, 1),
        ({"time": 10.0}, 1000, 1),
        ({"time": "1 min"}, 6000, 1),
        ({"time": 0.3, "time_step": 0.1}, 3, 1),  # 0.3 / 0.1 is 2.9999999999999996
        ({"time": 1000.1, "time_step": 1e-4}, 10_001_000, 1),
        ({"time": 1, "time_step": "1/3"}, 3, 1),
        ({"steps": 1000, "frames": 50}, 1000, 20),
        ({"time": 10, "frames": 1000}, 1000, 1),
        ({"steps": 7, "every": 3}, 7, 3),
        ({"steps": 0}, 0, 1),
        ({"steps": 0, "frames": 3}, 0, 1),
    ],
)
def test_steps_and_frames(run, steps, every):
    task = with_run(**run).task()
    assert (task.steps, task.every) == (steps, every)


@pytest.mark.parametrize(
    ("run", "sentence"),
    [
        ({"time": 0.015}, "is 1.5 time steps, which is no whole number: take time = 0.02 or time_step = 0.0075"),
        ({"time": 1 + 1e-12}, "which is no whole number"),
        ({"time": 0.001}, "run.time is 0.1 time steps, which is no whole number: take time = 0.01"),
        ({"time": 1e300}, "more than anybody waits for"),
        ({"steps": 10**400}, "run.steps is 1e+300, more than anybody waits for"),
        ({"steps": 2**53}, "more than anybody waits for"),
        ({"steps": 10**9}, "run keeps 1000000000 frames of a ball, and 100000000 are the most: give every or frames"),
        ({"time": 1, "steps": 100}, "run: give either steps or time"),
        ({"steps": 1000, "frames": 3}, "run.frames: 1000 steps do not divide into 3 equal parts; 2 do"),
        ({"steps": 10, "frames": 11}, "run.frames: 10 steps do not divide into 11 equal parts; 10 do"),
        ({"steps": 10, "frames": 5, "every": 2}, "run: give either every or frames"),
        ({"steps": 10, "outputs": "gamma"}, "run.outputs must be a list of names in brackets"),
        ({"steps": 10, "outputs": []}, "run.outputs is empty: choose of momentum, gamma, omega"),
        ({"steps": 10, "outputs": ["omega", "omega"]}, "run.outputs names an output twice"),
        ({"steps": 10, "outputs": ["spin"]}, "run.outputs.1 must be 'momentum', 'gamma', 'omega'"),
        ({"steps": 10, "order": 3}, "run.order must be 2, 4, 6 or 8"),
        ({"steps": 10, "precision": "half"}, "run.precision must be 'single', 'double' or 'double-double'"),
        ({"steps": 10, "limit": 3}, "run.limit goes with run.accuracy"),
        ({"steps": 10, "time_step": -1}, "run.time_step must be greater than 0"),
        ({"steps": 10, "time_step": {"grid": [1]}}, "run.time_step must be a number"),
        ({"accuracy": 1e-3, "steps": 3, "order": 4}, "run.accuracy is of the motion, and run.order of the map"),
        ({"accuracy": 1e-13, "steps": 3}, "run.accuracy below 1e-12 takes more digits than float64 has: give run.time"),
        ({"accuracy": 1e-3, "steps": 3, "map": True}, "run.accuracy is of the motion, and run.map of the map"),
        ({"accuracy": 1e-3, "steps": 3, "outputs": ["phase"]}, "run.accuracy is of the motion, and run.outputs of the"),
        ({"steps": True}, "run.steps must be a whole number"),
        ({"steps": 10, "atitude": True}, "run.atitude is not a key of [run]; did you mean attitude?"),
        ({"steps": 10, "radius": 3}, "run.radius is not a key of [run]; it stands under [ball]"),
        ({"steps": 10, "zzz": 3}, "run.zzz is not a key of [run]; there are steps, time, time_step"),
        ({"steps": 10, "ball": 3}, "run.ball is not a key of [run]; it stands at the top of the file"),
        ({}, "run.steps is missing"),
        ({"steps": -1}, "run.steps must be at least 0"),
        ({"time": 1e308, "time_step": None, "frames": 9}, "run.time is 1e+308 s, more than anybody waits for"),
        ({"steps": 5, "time_step": 1e308}, "run.steps times run.time_step is beyond the range of float64"),
        ({"steps": 10, "time_step": None}, "start.omega needs run.time_step, in seconds"),
        ({"time": 4, "time_step": None, "map": True}, "run.time needs run.time_step: the map has steps of one length"),
        (ACCURATE | {"accuracy": 0}, "run.accuracy must be greater than 0"),
        (ACCURATE | {"accuracy": "0 mm"}, "run.accuracy must be greater than 0"),
        (ACCURATE | {"accuracy": "1 kg"}, "run.accuracy is a length, but '1 kg' is a mass"),
        (ACCURATE | {"accuracy": "1 um", "of": "state"}, "has a unit, but of the state it is relative"),
        (ACCURATE | {"time": None}, "run.accuracy needs run.time, in seconds"),
        (ACCURATE | {"steps": 3}, "run: give either steps or time"),
        (ACCURATE | {"every": 1}, "run.every needs run.time_step: without, give run.frames"),
        (ACCURATE | {"of": "energy"}, "run.of must be 'state' or 'contact'"),
    ],
)
def test_a_wrong_run_is_refused(run, sentence):
    with refused(sentence):
        with_run(**run)


def test_a_title_is_one_line_and_a_seed_has_64_bits():
    with refused("title must be one line of text"):
        checked(DATA | {"title": "a\0b"})
    with refused("seed must be at most 9223372036854775807"):
        checked(DATA | {"sweep": {"seed": 2**63}})


@pytest.mark.filterwarnings("error")
def test_a_range_beyond_float64_is_refused_without_a_warning():
    omega = [{"linspace": [-1e308, 1e308, 3]}, 0, 0]
    with pytest.raises(SceneError, match="omega must be finite"):
        expand(checked(DATA | {"start": {"omega": omega}}))
    with pytest.raises(SceneError, match="gamma must not be 0"):
        expand(checked(DATA | {"start": {"omega": [1, 0, 0], "gamma": [{"grid": [0, 1]}, 0, 0]}}))


def test_outputs_and_their_short_forms():
    assert with_run(steps=1).task().outputs == ("momentum", "gamma")
    assert with_run(steps=1, contact=True).task().outputs == ("momentum", "gamma", "contact")
    assert with_run(steps=1, outputs=["energy"], attitude=True).task().outputs == ("attitude", "energy")
    task = with_run(steps=1, order=4, precision="double-double").task()
    assert (task.order, task.precision, task.time_step) == (4, "double-double", 0.01)


def test_an_accuracy_is_a_task_of_frames():
    task = checked(DATA | {"run": {"accuracy": 1e-3, "time": "2 min", "frames": 4, "contact": True}}).task()
    assert (task.steps, task.every, task.frames, task.time, task.of, task.limit) == (4, 1, 5, 120.0, "contact", 600.0)
    assert checked(DATA | {"run": {"accuracy": 1e-3, "time": 1}}).task().of == "state"
    with refused("run.accuracy needs start.omega"):
        checked(DATA | {"start": {"momentum": [1, 2, 3]}, "run": {"accuracy": 1e-3, "time": 1}})


@pytest.mark.parametrize(
    ("ball", "sentence"),
    [
        ({"raduis": 1}, "ball.raduis is not a key of [ball]; did you mean radius?"),
        ({"steps": 1}, "ball.steps is not a key of [ball]; it stands under [run]"),
        ({"D": 1}, "ball: give either D or mass and radius, not both D and mass"),
        ({"mass": None}, "ball.mass is missing: give it, or D"),
        ({"radius": None}, "ball.radius is missing: give it, or D"),
        ({"mass": None, "radius": None}, "ball.mass is missing: give mass and radius, or D"),
        ({"inertia": None}, "ball: give either mass_tensor or inertia (or a preset)"),
        ({"preset": "shell"}, "ball: give either mass_tensor or inertia (or a preset), not inertia and preset"),
        ({"thickness": 1}, "ball.thickness goes with ball.preset"),
        ({"inertia": None, "preset": "shell", "block_mass": 1}, "ball.block_mass does not go with the preset shell"),
        ({"inertia": None, "preset": "dumbbell", "point_mass": 1}, "ball.separation is missing: the preset dumbbell"),
        ({"inertia": None, "preset": "egg"}, "ball.preset must be 'homogeneous', 'shell', 'dumbbell' or 'bowling'"),
        ({"radius": "3 kg"}, "ball.radius is a length, but '3 kg' is a mass; write metres, such as 0.1085"),
        ({"inertia": [1, 2]}, "ball.inertia.3 is missing"),
        ({"inertia": [[1, 2, 3], [1, 2], [1, 2, 3]]}, "ball.inertia.2.3 is missing"),
        ({"inertia": [1, 2, 3, 4]}, "ball.inertia must have 3 numbers"),
        ({"inertia": "1"}, "ball.inertia must be a list of numbers in brackets"),
        ({"name": ""}, "ball.name must not be empty"),
        ({"name": "a\x00b"}, "ball.name must be one line of text, without control characters"),
        ({"name": "a\nb"}, "ball.name must be one line of text, without control characters"),
        ({"name": "a\u202eb"}, "ball.name must be one line of text, without control characters"),
        ({"name": "x" * 81}, "ball.name must have at most 80 characters"),
        (3, "ball must be a table: [ball]"),
        ([], "ball must not be []"),
        ([DATA["ball"] | {"name": "a"}] * 2, "two balls have the name 'a'"),
        ([DATA["ball"], DATA["ball"] | {"mas": 1}], "ball.2.mas is not a key of [ball.2]; did you mean mass?"),
        ([{"mass_tensor": [1.0] * 33, "D": 1}], "mass_tensor has 33 numbers, and 32 dimensions are the most"),
        # As other formats write a tensor:
        ({"inertia": {"ixx": 1, "iyy": 1, "izz": 1}}, "ball.inertia: write the tensor as rows: [[ixx, ixy, ixz], [ixy"),
        ({"inertia": [1, 0, 0, 1, 0, 1]}, "must have 3 numbers, or 3 rows of 3: six have two orders (URDF and"),
        ({"inertia": "0.006 0.007 0.009"}, "ball.inertia must be a list of numbers in brackets: [0.006, 0.007, 0.009]"),
        ({"inertia": {"linspace": [1, 2, 3]}}, "ball.inertia: a range replaces one number"),
    ],
)
def test_a_wrong_ball_is_refused(ball, sentence):
    with refused(sentence):
        checked(DATA | {"ball": given(DATA["ball"] | ball) if isinstance(ball, dict) else ball})


@pytest.mark.parametrize(
    ("start", "sentence"),
    [
        ({}, "start: give either momentum, omega or velocity (or vertical_momentum)"),
        ({"omega": [1, 2, 3], "momentum": [1, 2, 3]}, "not momentum and omega"),
        ({"omega": [1, 2, 3], "spin": 1}, "start.spin goes with start.velocity"),
        ({"velocity": [1, 2], "axes": "space"}, "start.axes goes with start.omega or start.momentum"),
        ({"omega": [1, 2, 3], "gamma": [0, 0, 1], "attitude": [1, 0, 0, 0]}, "start: give either gamma or attitude"),
        ({"omega": [1, 2, 3], "rpy": [0, 0, 1], "quaternion_xyzw": [0, 0, 0, 1]}, "not quaternion_xyzw and rpy"),
        ({"omega": [1, 2, 3], "rpy": ["30 sr", 0, 0]}, "start.rpy.1 is an angle, but '30 sr' does not say which angle"),
        ({"omega": [1, 2, 3], "rpy": ["3 m", 0, 0]}, "start.rpy.1 is an angle, but '3 m' is a length"),
        ({"omega": [1, 2, 3], "attitude": [1, 0, 0]}, "start.attitude.4 is missing"),
        ({"velocity": "8 m/s"}, "start.velocity must be a list of numbers in brackets"),
        ({"velocity": ["8 m", 0]}, "start.velocity.1 is a velocity, but '8 m' is a length"),
        ({"omega": [1, 2, 3], "axes": "world"}, "start.axes must be 'body' or 'space'"),
        (None, "start is missing: give [start], or each ball its own start = { ... }"),
    ],
)
def test_a_wrong_start_is_refused(start, sentence):
    with refused(sentence):
        checked(given(DATA | {"start": start}))


def test_many_problems_are_told_with_their_lines_and_not_without_end(write):
    path = write('[ball]\nmas = 1\n[start]\nomga = 3\n[run]\nsteps = "x"\n' + "".join(f"k{i} = 1\n" for i in range(9)))
    with pytest.raises(SceneError) as caught:
        scene.load(path)
    words = str(caught.value)
    assert words.startswith(f"{path}, line 2: ball.mas is not a key of [ball]; did you mean mass?; line 4: start.omga")
    assert words.endswith("; and 7 more")
    assert "line 6: run.steps must be a whole number" in words


def test_a_refusal_of_a_ball_tells_its_line(write):
    path = write(
        "[[ball]]\npreset = 'shell'\nmass = 1\nradius = 1\n\n[[ball]]\npreset = 'shell'\nmass = 1\nradius = -1\n"
        "[start]\nomega = [1, 2, 3]\n[run]\ntime_step = 1\nsteps = 1\n"
    )
    with refused(f"{path}, line 9: ball.radius of ball 2: mass and radius must be positive"):
        expand(scene.load(path))


def test_a_scene_knows_its_source_and_a_changed_one_is_checked(tmp_path):
    path = tmp_path / "s.toml"
    text = "# why\n[ball]\nmass_tensor = [1, 2, 4]\nD = '3 kg m2'\n[start]\nmomentum = [1, 0, 0]\n[run]\nsteps = 9\n"
    text = text.replace("\n", "\r\n")
    path.write_bytes(text.encode())
    first = scene.load(path)
    assert first.source == text
    changed = first.with_run(steps=None, time_step=0.5, time=2)
    assert changed.task().steps == 4
    assert '"time": 2' in changed.source
    assert first.task().steps == 9
    with pytest.raises(SceneError, match=r"run\.stps is not a key of \[run\]; did you mean steps\?"):
        first.with_run(stps=3)


def test_a_file_that_is_no_scene_is_one_sentence(write, tmp_path):
    path = write("[ball]\nmass = \n")
    with refused(f"{path}, line 2, column 8: this is not TOML: Invalid value"):
        scene.load(path)
    for wrong, sentence in [(tmp_path, "Is a directory"), (tmp_path / "no", "No such file"), (tmp_path / "\0", "null")]:
        with pytest.raises(SceneError, match=sentence):
            scene.load(wrong)
    path.write_bytes(b"a = '\xff'")
    with pytest.raises(SceneError, match="is not UTF-8 text"):
        scene.load(path)


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


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("steps = 10", "steps = 10\nstep = 1", "line 10: run.step is not a key of [run]; did you mean steps?"),
        ('"2/7"', '"2/0"', "line 7: start.gamma.1: '2/0' divides by zero"),
        ("0.1", "nan", "line 6: start.momentum.1 must be finite"),
        ("[ball]", "[ball", "is not TOML"),
        ("[ball]", "a = " + "[" * 20000 + "\n[ball]", "this is not TOML: its values are nested too deeply"),
        ("[ball]", "a = " + "9" * 20000 + "\n[ball]", "not TOML: a whole number has more digits than Python reads"),
        ("[ball]", ".".join("a" * 50_000) + " = 1\n[ball]", "is no scene: its tables are nested too deeply"),
        ("steps = 10", "steps." + ".".join("a" * 1500) + " = 10", "is no scene: its tables are nested too deeply"),
        ("D = 3", "D = 1" + "0" * 400, "line 4: ball.D is beyond the range of float64"),
        ("0.1", "1e-400", "start.momentum.1 is below 2.2e-308, where float64 loses its digits"),
        ("0.1", "1.234_567e-315", "start.momentum.1 is below 2.2e-308"),
        ("0.1", '"1e-315"', "start.momentum.1"),
    ],
)
def test_a_wrong_scene_names_the_key_and_what_would_be_right(write, old, new, sentence):
    with pytest.raises(SceneError, match=re.escape(sentence)) as caught:
        scene.load(write(GOOD.replace(old, new, 1)))
    assert "\n" not in str(caught.value)


def test_a_pipe_is_no_scene_and_is_not_waited_for_but_standard_input_may_be_one(tmp_path):
    os.mkfifo(tmp_path / "scene.toml")
    with pytest.raises(SceneError, match=r"^\S+scene\.toml is a pipe, not a file$"):
        scene.load(tmp_path / "scene.toml")
    read, write = os.pipe()
    os.write(write, GOOD.encode())
    os.close(write)
    assert scene.load(Path(f"/dev/fd/{read}")).run.steps == 10
    os.close(read)


#: A text that asks for an accuracy.
ASKED = f"{BALL}accuracy = 1e-7\ntime = 4.0\nframes = 2\ncontact = true\n"


def test_a_scene_may_ask_for_an_accuracy(write, tmp_path):
    wanted = scene.load(write(ASKED))
    plan, answers = sweep.answering(plan_of(wanted), lambda text: None)
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
    wanted = scene.load(write(ASKED.replace("accuracy = 1e-7", f"accuracy = '{given}'"))).task()
    assert wanted.accuracy == 1e-6
    assert type(wanted.accuracy) is float


def test_more_digits_than_float64_has_are_written(write, tmp_path):
    text = ASKED.replace("1e-7", "1e-19").replace("[run]", "position = [0.1, 0.2]\n[run]")
    plan, answers = sweep.answering(plan_of(scene.load(write(text))), lambda text: None)
    formats.save(sweep.run_in_memory(plan), tmp_path / "run.npz")
    data, exact = np.load(tmp_path / "run.npz"), exactly(answers[0].trajectory, "contact")
    assert abs(data["contact_low"][-1]).max() > 0
    for place, axis in ((Fraction(0.1), 0), (Fraction(0.2), 1)):
        high, low = (Fraction(float(data[name][-1, axis])) for name in ("contact", "contact_low"))
        assert abs(high + low - place - exact[-1, axis]) < 1e-32
        assert float(high + low) == high
    assert abs(data["momentum_low"][-1]).max() > 0


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("inertia=[0,0,0]\nmass=0.1\nradius=0.03", "line 2: ball.inertia of ball: its moments of inertia are 0"),
        ("mass=0.37\nradius=0.1\ninertia=[0.064,0.064,0.064]", "line 4: ball.inertia of ball: some of its mass is out"),
        (
            "mass=0.3\nradius=0.05\ninertia=[[1.15e-4,5.2e-5,2.5e-5],[5.2e-5,1.53e-4,3.4e-5],[2.5e-5,3.4e-5,1.9e-4]]",
            "line 4: ball.inertia of ball: no body has the inertia (7.8627e-05, 0.000147497, 0.000231876)",
        ),
        (
            "mass=1\nradius=0.1\ninertia=[1e-6,1e-6,1e-6]",
            "line 4: ball.inertia of ball: its moments of inertia are 1/4000 of the 0.004 kg m² of a homogeneous ball: "
            "its radius of gyration is 1 mm, and its radius is 100 mm; did you mean other units?",
        ),
        ("mass=6\nradius=0.1\ninertia=[1.17e-5,1.9e-5,1.9e-5]", "line 4: ball.inertia of ball: its moments of"),
        ("preset='shell'\nradius=0.1\nmass=-1", "line 4: ball.mass of ball: mass and radius must be positive"),
        ("inertia=[1,1,1]\nradius=0.1\nD=-1", "line 4: ball.D of ball: D = m ρ² must not be negative"),
        (
            "inertia=[0.03,0.03,0.03]\nmass=7\nradius=0.1\ncenter_of_mass=[0,'1 mm',0]",
            "line 5: ball.center_of_mass is 1 mm off the centre of the ball, and the ball of chapsym is balanced: with "
            "such an offset the weight speeds the ball up and slows it down, by up to g offset/radius = 0.098 m/s²",
        ),
    ],
)
def test_what_no_ball_has_is_refused_at_the_key_that_says_it(write, body, said):
    path = write(f"[ball]\n{body}\n[start]\nomega=[3,-2,1]\n[run]\ntime=1.0\ntime_step=0.1\n")
    with refused(f"{path}, {said}"):
        expand(scene.load(path))


def test_a_centre_of_mass_in_the_middle_and_a_gyration_of_a_thirtieth_are_taken():
    ball = {"inertia": [5e-6] * 3, "mass": 1, "radius": 0.1, "center_of_mass": [0, 0, 0.0]}
    assert len(expand(checked({"ball": ball, "start": {"omega": [1, 2, 3]}, "run": {"time": 1.0}}))) == 1
