"""The error of a run, proved by the motion with certified digits."""

import json
import tomllib

import numpy as np
import pytest
from commands import answer, chapsym, refused
from first import BALL

import chapsym as library
from chapsym.cli.certify import within
from chapsym.dynamics.enclosed_motion import follow
from chapsym.scene import SceneError, load
from chapsym.scene.members.exactly import exact_motion
from chapsym.scene.plan.plan import plan_of
from chapsym.scene.result import formats
from chapsym.scene.result.dataset import layout
from chapsym.scene.result.proved import check_scene, proved_errors

RUN = 'time = 1.0\nframes = 8\noutputs = ["gamma", "omega", "attitude", "contact"]\n'


@pytest.fixture(scope="module")
def scene(tmp_path_factory):
    """A scene and its result."""
    path = tmp_path_factory.mktemp("proved") / "one.toml"
    path.write_text(f"{BALL}{RUN}")
    chapsym("run", path, "-o", path.with_suffix(".npz"))
    return path


@pytest.fixture(scope="module")
def both(scene):
    """The result, and the motion."""
    return formats.load(scene.with_suffix(".npz")).load(), follow(*exact_motion(load(scene)), 20)


def test_the_bound_is_that_of_the_greatest_difference_and_of_an_attitude_up_to_its_sign(both):
    dataset, found = both
    errors = proved_errors(dataset, found)
    other = dataset.copy(deep=True)
    other["attitude"].values[0, 3] *= -1
    assert proved_errors(other, found) == errors
    assert list(errors) == ["gamma", "omega", "attitude", "contact"]
    for name, error in errors.items():
        middles = np.array([[float(x.mid()) for x in row] for row in getattr(found, name)])
        away = np.abs(dataset[name].values[0] - middles).max(axis=-1)
        if name == "attitude":
            away = np.minimum(away, np.abs(dataset[name].values[0] + middles).max(axis=-1))
        away = away.max()
        assert away * (1 - 1e-12) - 1e-15 <= error <= away * (1 + 1e-12) + 1e-15
        assert error < 1e-6  # what is asked for by default


@pytest.mark.parametrize("name", ["gamma", "omega", "attitude", "contact"])
def test_one_number_that_is_off_is_seen(both, name):
    dataset, found = both
    other = dataset.copy(deep=True)
    other[name].values[0, -1, -1] += 1e-3
    assert proved_errors(other, found)[name] == pytest.approx(1e-3, rel=1e-2)
    other[name].values[0, -1, -1] = np.nan
    assert proved_errors(other, found)[name] == np.inf


def test_the_command_has_the_bound_and_takes_no_other_scene(scene, tmp_path):
    result = scene.with_suffix(".npz")
    assert max(answer("certify", "motion", scene, "--against", result)["errors"].values()) < 1e-6
    other = tmp_path / "other.toml"
    other.write_text(f"{BALL}{RUN}".replace("frames = 8", "frames = 4"))
    assert "is of another scene" in refused("certify", "motion", other, "--against", result)
    for option in ("-o", "--certificate"):
        assert "is named twice" in refused("certify", "motion", scene, option, scene)
    both = tmp_path / "both.json"
    assert "is named twice" in refused("certify", "motion", scene, "-o", both, "--certificate", both)
    assert "gone.npz" in refused("certify", "motion", scene, "--against", tmp_path / "gone.npz")


def test_a_scene_may_ask_for_the_proof_and_its_bounds_are_in_the_result(scene, both, tmp_path, monkeypatch):
    path, result = tmp_path / "proved.toml", tmp_path / "proved.nc"
    path.write_text(f"{BALL}{RUN}proved = true\n")
    words = answer("run", path, "-o", result)["proved"]
    assert words == json.loads(formats.load(result).attrs["proved"])
    assert words == pytest.approx(proved_errors(*both))  # of 18 digits and of 20
    assert json.loads(library.run_scene(path).dataset.attrs["proved"]) == words
    monkeypatch.setattr("chapsym.show.result.LIMIT", 1e-9)
    with pytest.raises(SceneError, match="the frames after 1 are not proved: "):
        library.run_scene(path)
    whole = tomllib.loads(path.read_text())
    with pytest.raises(SceneError, match="need the numbers as a scene file writes them"):
        library.run_scene(whole)


@pytest.mark.parametrize(("more", "output", "said"), [
    ("proved = true", "x.zarr", "run.proved writes its bounds into one file"),
    ("proved = true\nmap = true\ntime_step = 0.125\noutputs = [\"energy\"]", "x.npz", "ask for one in run.outputs"),
    ("proved = true\nprecision = \"single\"\ntime_step = 0.125", "x.npz", "bounds are proved in double and"),
    ("proved = true\noutputs = [\"energy\"]", "x.npz", "ask for one in its outputs"),
    ("proved = true\n# several", "x.npz", "certified digits are of one ball; this scene has several, or a range"),
])  # fmt: skip
def test_what_cannot_be_proved_is_refused_before_the_run(tmp_path, more, output, said):
    path = tmp_path / "asks.toml"
    ball = BALL.replace("[3.0,", "[{ linspace = [3, 4, 2] },") if "several" in more else BALL
    path.write_text(f"{ball}time = 1.0\nframes = 8\n{more}\n")
    assert said in refused("run", path, "-o", tmp_path / output)
    assert not (tmp_path / output).exists()
    if output != "x.zarr":  # of which `scene check` does not know
        assert said in refused("scene", "check", path)


@pytest.mark.parametrize(("error", "said"), [
    (4.51e-8, "is within 4.6e-08 m at these frames: proved"), (0.0, "is within 0 m at these frames: proved"),
    (float("inf"), "has no number or no bound at some of these frames"),
])  # fmt: skip
def test_what_is_printed_is_a_bound_too(error, said):
    assert within(error, " m") == said


MAP = "time = 1.0\ntime_step = 0.125\nmap = true\nproved = true\noutputs = ['momentum', 'gamma', 'contact', 'energy']\n"


@pytest.mark.parametrize("more", ["", "precision = 'double-double'\n", "order = 4\n"])
def test_a_scene_of_the_map_has_the_bounds_of_each_frame(tmp_path, more):
    path, result = tmp_path / "map.toml", tmp_path / "map.csv"
    path.write_text(f"{BALL}{MAP}{more}")
    words = answer("run", path, "-o", result)
    found = formats.load(result)
    plan = plan_of(load(path))
    assert words["model"] == "reduced map"
    assert set(plan.refused.values()) == {"it proves no bounds of its error"}
    one, task = plan.members, plan.task
    ball = library.Ball(one.ball.mass_tensor[0], one.ball.D[0], one.ball.radius[0])
    run = library.trajectory(
        ball, one.momentum[0], one.gamma[0], 8, attitude=True, contact=True,
        order=task.order, precision=task.precision, proved=True,
    )  # fmt: skip
    for name in ("momentum", "gamma", "contact"):
        assert found[f"{name}_bound"].dims == ("ball", "frame")
        bounds = getattr(run.proved, name)
        assert np.array_equal(found[f"{name}_bound"].values[0], bounds)
        assert words["proved"][name] == bounds.max() < 1e-14
    assert "energy_bound" not in found
    assert plan.bytes == sum(x.values.nbytes for name, x in layout(plan).items() if name.split("_")[0] in task.outputs)
    assert found.momentum_bound.units == "kg m2"


@pytest.mark.parametrize(("more", "least", "most"), [
    ("", 2.0**-53 * 1000, 1e-12), ("precision = 'double-double'\n", 2.0**-106 * 1000, 1e-26),
])  # fmt: skip
def test_what_a_start_elsewhere_rounds_is_in_the_bound(tmp_path, more, least, most):
    starts = {"here": "", "there": "position = [1000.0, 0.0]\n"}
    bounds = {}
    for name, place in starts.items():
        path = tmp_path / f"{name}.toml"
        path.write_text(f"{BALL.replace('[run]', place + '[run]')}{MAP}{more}")
        answer("run", path, "-o", path.with_suffix(".npz"))
        bounds[name] = formats.load(path.with_suffix(".npz")).contact_bound.values[0, -1]
    assert bounds["here"] + least < bounds["there"] < most


def test_units_of_many_balls_with_bounds_fit_into_memory(tmp_path):
    """All frames of a ball are proved in one piece."""
    path = tmp_path / "many.toml"
    many = BALL.replace("omega = [3.0,", "omega = [{linspace = [3.0, 4.0, 5000]},")
    path.write_text(f"{many}time_step = 0.01\nsteps = 20_000\nmap = true\nproved = true\n")
    plan = plan_of(load(path))
    assert len(plan.segments) == 1
    assert max(chunk.stop - chunk.start for chunk in plan.chunks) * plan.frames * plan.numbers <= 2**24


def test_a_frame_without_a_number_has_no_bound(scene, both, tmp_path):
    other = both[0].copy(deep=True)
    other["contact"].values[0, -1] = np.nan
    formats.save(other, tmp_path / "other.npz")
    assert answer("certify", "motion", scene, "--against", tmp_path / "other.npz")["errors"]["contact"] is None


def test_a_scene_is_known_by_its_text(both):
    dataset, _ = both
    check_scene(dataset, dataset.attrs["scene"])
    with pytest.raises(SceneError, match="the result has none of gamma, omega, attitude, contact"):
        check_scene(dataset[["error"]].assign_attrs(dataset.attrs), dataset.attrs["scene"])
