"""chapsym scene new, check and schema, from outside."""

import json
import re
import subprocess
import sys

import numpy as np
import pytest
from commands import answer, chapsym, refused
from first import FIRST

from chapsym.scene.read.schema import names
from chapsym.scene.result import formats
from chapsym.scene.running import sweep
from chapsym.scene.running.store import ELSE


def done(*arguments):
    found = chapsym(*arguments)
    assert found.returncode == 0, found.stderr
    return found.stdout


def test_a_new_scene_has_comments_and_the_schema_for_editors_and_can_be_checked(tmp_path):
    path = tmp_path / "ball.toml"
    assert "and" in done("scene", "new", path, "--example", "robot")
    text = path.read_text(encoding="utf-8")
    assert text.startswith("#:schema ./chapsym-scene.schema.json\n# Numbers are SI;")
    assert json.loads((tmp_path / "chapsym-scene.schema.json").read_text(encoding="utf-8"))["title"] == "chapsym scene"
    shown = done("scene", "check", path)
    for row in ("title  ", "ball  ", "start  ", "run  ", "model  ", "cost  "):
        assert f"\n{row}" in f"\n{shown}"
    assert "J = (0.0019, 0.0019, 0.0002)" in shown


def test_new_replaces_nothing_without_force_and_refuses_what_it_cannot_write(tmp_path):
    path = tmp_path / "ball.toml"
    path.write_text("mine")
    assert refused("scene", "new", path) == f"{path} is there already: choose another name, or --force to replace it"
    assert path.read_text() == "mine"
    assert [one.name for one in tmp_path.iterdir()] == ["ball.toml"]
    done("scene", "new", path, "--force", "--no-schema")
    assert path.read_text(encoding="utf-8").startswith("# Numbers are SI;")
    assert refused("scene", "new", tmp_path / "a.toml", "--example", "bowlin").endswith("did you mean bowling?")
    assert refused("scene", "new", tmp_path / "a.json").endswith("a scene must end in .toml")
    assert "does not exist" in refused("scene", "new", tmp_path / "no" / "a.toml")
    assert [one.name for one in tmp_path.iterdir()] == ["ball.toml"]


def test_the_help_names_the_examples_and_the_schema_is_json(tmp_path):
    listed = re.search(r"Which: (.*?)\.", " ".join(done("scene", "new", "--help").split()))[1]
    assert sorted(listed.replace(" or ", ", ").split(", ")) == names()
    for command in ("new", "check", "schema"):
        assert command in done("scene")
    printed = done("scene", "schema")
    done("scene", "schema", "-o", tmp_path / "s.json")
    assert (tmp_path / "s.json").read_text(encoding="utf-8") == printed
    assert json.loads(printed)["properties"]["ball"]


SCENE = """[ball]
mass_tensor = [1, 2, 4]
D = 3
[start]
momentum = [{ grid = [0.1, 50] }, -0.05, 0.075]
[run]
steps = 10
"""


def test_check_tells_ranges_the_plan_and_balls_that_cannot_start(tmp_path):
    path = tmp_path / "s.toml"
    path.write_text(SCENE)
    shown = done("scene", "check", path)
    assert re.search(r"^start\.momentum\.1 +2 values: 0\.1, 50 kg m2$", shown, re.MULTILINE)
    assert "ball 1 (of 2): J = (1, 2, 4)" in shown
    assert "ball 2 cannot take the first step: no rotation of this ball has this momentum" in shown
    found = answer("scene", "check", path)
    assert (found["balls"], found["steps"], found["outputs"]) == (2, 10, ["momentum", "gamma"])
    assert len(found["warnings"]) == 1
    path.write_text(SCENE.replace("[1, 2, 4]", "[1e200, 2e200, 4e200]").replace("0.1, 50", "1e200"))
    assert re.search(r"\|𝒦\| = 1e\+200 kg m²", done("scene", "check", path))


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("[1, 2, 4]", "[1, 2, -4]", "line 2: ball.mass_tensor of ball 1 (start.momentum.1 = 0.1): mass_tensor has"),
        ("steps = 10", "steps = 10\noutputs = ['omega']", "s.toml: omega needs run.time_step"),
    ],
)
def test_check_refuses_in_a_sentence(tmp_path, old, new, sentence):
    path = tmp_path / "s.toml"
    path.write_text(SCENE.replace(old, new))
    assert sentence in refused("scene", "check", path)


UNREACHABLE = """
[[ball]]
name = "slow"
mass_tensor = [0.1, 0.5, 1.6]
D = 0.7
start = { momentum = [0.01, 0.0, 0.02] }
[[ball]]
name = "fast"
mass_tensor = [0.1, 0.5, 1.6]
D = 0.7
start = { momentum = [10.0, 0.0, 20.0] }
[run]
steps = 5
"""


def test_a_ball_that_stops_early_is_told_with_its_reason_and_a_run_of_such_balls_fails(tmp_path):
    (tmp_path / "scene.toml").write_text(UNREACHABLE, encoding="utf-8")
    found = chapsym("run", "scene.toml", "-o", "out.nc", cwd=tmp_path)
    assert found.returncode == 0
    assert "1 stopped early" in found.stdout
    assert found.stderr == (
        "chapsym: stopped early: fast at step 0: no rotation of this ball has this momentum at this gamma; "
        "take a shorter time step\n"
    )
    text = UNREACHABLE.replace("[0.01, 0.0, 0.02]", "[10.0, 0.0, 20.0]")
    (tmp_path / "scene.toml").write_text(text, encoding="utf-8")
    for name in ("again.nc", "again.zarr"):
        found = chapsym("run", "scene.toml", "-o", name, cwd=tmp_path)
        assert found.returncode == 2
        assert "no ball got to the end: 2 balls, the first slow at step 0: no rotation" in found.stderr
        assert (tmp_path / name).exists()


def test_what_a_scene_names_as_its_output_stays_in_its_folder_or_this(tmp_path):
    here, theirs, out = tmp_path / "here", tmp_path / "theirs", tmp_path / "out"
    for folder in (here, theirs, out):
        folder.mkdir()
    (here / "link").symlink_to(out)
    for name, allowed in (("run.npz", True), ("../theirs/run.npz", True), ("../out/run.npz", False),
                          (out / "run.npz", False), ("link/run.npz", False)):  # fmt: skip
        path = theirs / "scene.toml"
        path.write_text(SCENE.replace("{ grid = [0.1, 50] }", "0.1") + f'output = "{name}"\n', encoding="utf-8")
        found = chapsym("run", path, cwd=here)
        assert (found.returncode == 0) == allowed, found.stderr
        if not allowed:
            assert found.stderr == (
                f"chapsym: {path}: run.output = {str(name)!r} leaves this folder and that of the scene; "
                f"if you mean it, say -o {name}\n"
            )
            assert chapsym("run", path, "-o", name, cwd=here).returncode == 0


def test_one_ball_is_run_and_told_the_same_whatever_the_suffix(tmp_path):
    """The steady ball takes no step: .npz and .csv once went another way."""
    path = tmp_path / "s.toml"
    path.write_text(
        "[ball]\ninertia = [0.01, 0.01, 0.01]\nmass = 2\nradius = 0.1\n[start]\nomega = [1, 2, 3]\n"
        "[run]\ntime_step = 0.01\nsteps = 1000000000\nevery = 500000000\ncontact = true\nmap = true\n"
    )
    words = set()
    for suffix in (".npz", ".csv", ".zarr"):
        found = answer("run", path, "-o", tmp_path / f"run{suffix}")
        assert found.pop("output") == str(tmp_path / f"run{suffix}")
        assert found["model"] == "steady rotation"
        assert (found["steps"], found["frames"], found["complete"]) == (10**9, 3, True)
        assert set(found["final"]) == {"momentum", "gamma", "contact"}
        assert len(found["drift"]) == 3
        words.add(json.dumps(found))
    assert len(words) == 1
    with np.load(tmp_path / "run.npz") as data:
        assert data["radius"] == 0.1
        assert [name for name in data.files if name.startswith("momentum")] == ["momentum"]
    assert done("run", path, "-o", tmp_path / "run.zarr").startswith(
        f"1000000000 steps, 3 frames; {tmp_path / 'run.zarr'} was complete already\nrelative drift of "
    )


ACCURATE = "[ball]\ninertia = [0.006, 0.0071, 0.0089]\nD = 0.02\n[start]\nomega = [1, 2, 3]\n[run]\ntime = 1\n"


def test_an_accuracy_that_cannot_be_had_or_needs_the_radius_is_one_sentence_before_anything_runs(tmp_path):
    (tmp_path / "ball.toml").write_text(f"{ACCURATE}accuracy = 1e-30\n")
    assert "an accuracy of 1e-30 after 1 s cannot be had" in refused("scene", "check", tmp_path / "ball.toml")
    fast = ACCURATE.replace("D = 0.02", "mass = 2\nradius = 0.1").replace("1, 2, 3", "1e3, -2e3, 1e3")
    (tmp_path / "ball.toml").write_text(f'{fast}accuracy = 1e-11\ncontact = true\nof = "state"\n')
    words = refused("run", tmp_path / "ball.toml", "-o", tmp_path / "out.npz")
    assert words.endswith('or for less time; or have more digits by of = "contact"')
    (tmp_path / "ball.toml").write_text(f'{ACCURATE}accuracy = 1e-8\nof = "contact"\n')
    words = refused("run", tmp_path / "ball.toml", "-o", tmp_path / "out.zarr")
    assert words == "the contact point needs the radius: give the ball its mass and radius"
    assert not (tmp_path / "out.zarr").exists()


def test_a_result_of_another_scene_and_what_is_no_result_are_replaced_only_where_asked_for(tmp_path, monkeypatch):
    scene, other = tmp_path / "scene.toml", tmp_path / "other.toml"
    text = re.sub(r"steps = \d+", "steps = 20", FIRST.read_text(encoding="utf-8"))
    scene.write_text(text, encoding="utf-8")
    other.write_text(text.replace("3.0", "2.5"), encoding="utf-8")
    for suffix in (".npz", ".nc"):
        output = tmp_path / f"run{suffix}"
        assert chapsym("run", scene, "-o", output).returncode == 0
        before = output.read_bytes()
        assert chapsym("run", scene, "-o", output).returncode == 0  # the same scene has the same result
        said = refused("run", other, "-o", output)
        assert said.endswith(f"{output.name} holds another scene (start.omega differs); {ELSE}")
        assert output.read_bytes() == before or suffix == ".nc"  # HDF5 writes times, too
        assert chapsym("run", other, "-o", output, "--fresh").returncode == 0
        assert output.read_bytes() != before
        output.write_text("a,b\n1,2\n", encoding="utf-8")
        assert refused("run", other, "-o", output).endswith(f"is there, but it is no result of chapsym; {ELSE}")
        assert output.read_text(encoding="utf-8") == "a,b\n1,2\n"
        assert chapsym("run", other, "-o", output, "--force").returncode == 0
    real, output = sweep.run, tmp_path / "two.npz"

    def run(*how):
        monkeypatch.undo()
        assert chapsym("run", scene, "-o", output).returncode == 0
        return real(*how)

    for other_command in (["run", other], ["trade", "--accuracy", "1e-6", "--time", "1"]):  # at the same time
        monkeypatch.setattr(sweep, "run", run)
        free = output.with_stem(f"two-{2 + output.with_stem('two-2').exists()}")
        said = refused(*other_command, "-o", output)
        assert said.endswith(f" differs); {ELSE}; it was written while this one ran, whose result is in {free}")
        assert formats.load(free).attrs["scene"] != formats.load(output).attrs["scene"]
        output.unlink()


def test_a_csv_goes_to_standard_output_and_nothing_else_does(tmp_path):
    """And what is said goes to standard error."""
    scene, output = tmp_path / "scene.toml", tmp_path / "run.csv"
    scene.write_text(re.sub(r"steps = \d+", "steps = 20", FIRST.read_text(encoding="utf-8")), encoding="utf-8")
    assert chapsym("run", scene, "-o", output).returncode == 0
    done = chapsym("run", scene, "-o", "-")
    assert (done.returncode, done.stdout) == (0, output.read_text(encoding="utf-8"))
    assert "21 frames in standard output" in done.stderr
    closed = ["bash", "-c", f"{sys.executable} -m chapsym run {scene} -o - >&-"]
    done = subprocess.run(closed, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (2, "chapsym: -: standard output is closed; name a file\n")
    assert "choose one" in refused("run", scene, "-o", "-", "--json")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["run.csv", "scene.toml"]
