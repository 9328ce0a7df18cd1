"""Results in Python and in notebooks, and `chapsym show`."""

import re
from pathlib import Path

import numpy as np
import pytest
import results
import small_units
from budget import slow
from commands import answer, refused
from commands import chapsym as command
from first import BALL, FIRST

import chapsym
from chapsym.scene import SceneError
from chapsym.show.result import Result

SCENE = {
    "title": "A ball of <2> kg & more",
    "ball": {"inertia": [0.006, 0.007, 0.009], "mass": 2.0, "radius": 0.1},
    "start": {"omega": [3.0, -2.0, 1.0], "gamma": ["2/7", "3/7", "6/7"]},
    "run": {"time_step": 0.01, "steps": 60, "outputs": ["contact", "attitude", "energy", "integrals"]},
}
TOML = f'title = "From a file"\n{BALL}time_step = 0.01\nsteps = 60\noutputs = ["contact", "energy"]\n'


def test_a_scene_runs_from_a_dictionary_shows_itself_and_what_cannot_be_saved_is_one_sentence(tmp_path):
    result = chapsym.run_scene(SCENE)
    run = chapsym.roll(results.UNEVEN, (3.0, -2.0, 1.0), 0.01, 60, gamma=(2 / 7, 3 / 7, 6 / 7), contact=True)
    assert result.dataset["contact"].values[0] == pytest.approx(run.contact, abs=1e-15)
    text = repr(result)
    assert text.startswith("A ball of <2> kg & more\n")
    assert "A ball of &lt;2&gt; kg &amp; more" in result._repr_html_()
    assert re.search(r"frames +61, 60 steps, 0.6 s", text)
    assert re.search(r"stored +attitude, contact, energy, integrals|stored +contact, attitude, energy, integrals", text)
    assert re.search(r"drift +\d\.\de-1[56] at most", text)
    result.save(tmp_path / "a.zarr")
    with pytest.raises(SceneError, match="is there already"):
        result.save(tmp_path / "a.zarr")
    with pytest.raises(SceneError, match="cannot be written"):
        result.save(tmp_path / "no" / "a.zarr")
    with pytest.raises(SceneError, match=r"nothing\.nc cannot be read"):
        chapsym.open_result(tmp_path / "nothing.nc")
    with pytest.raises(SceneError, match="inertia"):
        chapsym.run_scene(SCENE | {"ball": {"inertia": [1, 1, 9], "mass": 1, "radius": 1}})


def test_figures_and_the_table_tell_what_there_is_sweeps_and_balls_that_stopped():
    result = Result(results.folded())
    assert result.figures()["omega"] == 'no ω: add "omega" to run.outputs (and give run.time_step)'
    assert len(result.figure("contact", ball="slow").axes[0].lines) == 3
    words = dict(Result(results.folded()).rows())
    assert words["balls"] == "2, 1 of them stopped early"
    assert dict(Result(results.folded().isel(ball=[1])).rows())["stopped"].startswith("after ")
    assert re.match(r"\d\.\de-1", dict(Result(results.folded().drop_vars("integrals")).rows())["drift"])
    words = dict(Result(results.sweep(7)).rows())
    assert words["varied"] == "start.momentum from 0.05 to 0.5 kg m²"


def test_the_drift_is_what_the_integrals_say():
    dataset = results.uneven(50)
    dataset["integrals"] = dataset["integrals"] * (1 + 1e-6 * np.arange(51)[:, np.newaxis])
    assert dict(Result(dataset).rows())["drift"].startswith("5.0e-05")
    run = chapsym.trajectory(results.VERTICAL, (0.1, 0.2, 0.1), (2 / 7, 3 / 7, 6 / 7), 50)
    from_state = results.of(run, ("momentum", "gamma"))
    assert re.match(r"[1-9]\.\de-16", dict(Result(from_state).rows())["drift"])


@pytest.mark.parametrize("suffix", [".zarr", *slow(".nc")])
def test_a_result_that_is_saved_opens_as_it_was(tmp_path, suffix):
    result, path = chapsym.run_scene(SCENE), tmp_path / f"a{suffix}"
    result.save(path)
    again = chapsym.open_result(str(path))
    for name in ("contact", "energy", "taken"):
        assert (again.dataset[name].values == result.dataset[name].values).all(), name
    assert again.dataset.attrs["title"] == SCENE["title"]
    assert sorted(p.name for p in tmp_path.iterdir()) == [path.name]
    assert again.figures() == result.figures()
    made = Result(chapsym.roll(results.UNEVEN, (3.0, -2.0, 1.0), 0.01, 9).to_xarray())
    made.save(path.with_stem("made"))
    assert (chapsym.open_result(path.with_stem("made")).dataset.gamma.values == made.dataset.gamma.values).all()


def test_show_without_a_notebook_opens_a_folder_and_the_page_is_written(monkeypatch, capsys, tmp_path):
    opened = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    Result(results.sweep(5)).show()
    folder = Path(opened[0].removeprefix("file://"))
    assert [path.name for path in folder.iterdir()] == ["rotation.svg"]
    assert str(folder) in capsys.readouterr().out
    chapsym.run_scene(SCENE).page(tmp_path / "page.html")
    assert "<html" in (tmp_path / "page.html").read_text(encoding="utf-8")


def test_the_command_runs_a_scene_and_draws_it(tmp_path):
    scene = tmp_path / "ball.toml"
    scene.write_text(TOML)
    done = command("show", scene, "--format", "both")
    assert done.returncode == 0, done.stderr
    folder = tmp_path / "ball-figures"
    assert {path.name for path in folder.iterdir()} == {"contact.svg", "contact.png", "energy.svg", "energy.png"}
    assert 'no attitude: add "attitude" to run.outputs' in done.stdout
    assert "From a file" not in done.stderr


def test_the_command_draws_a_result_with_its_page(tmp_path):
    chapsym.run_scene(SCENE).save(tmp_path / "a.nc")
    words = answer("show", tmp_path / "a.nc", "-o", tmp_path / "pictures")
    names = ["contact.svg", "attitude.svg", "energy.svg", "integrals.svg", "page.html"]
    assert [Path(name).name for name in words["files"]] == names
    assert set(words["missing"]) == {"spheres", "spread", "rotation", "phase", "omega"}
    assert all(Path(name).stat().st_size > 1000 for name in words["files"])


def test_half_a_run_is_drawn_and_says_how_much_there_is(tmp_path):
    """Balls that have not begun are not counted as stopped; what is saved of it stays half a run."""
    plan = small_units.plan((*small_units.SOME, "attitude", "contact"))
    small_units.interrupted(tmp_path / "half.zarr", small_units.PART, plan)
    done = command("show", tmp_path / "half.zarr", "-o", tmp_path / "p", "--figures", "contact", "--page")
    assert done.returncode == 0, done.stderr
    words = re.search(r"half\.zarr is unfinished: (\d+ % of the run, \d+ of 10 balls to their ends)\n", done.stdout)[1]
    assert f"the run is not finished: {words} can be shown" in (tmp_path / "p" / "page.html").read_text(
        encoding="utf-8"
    )
    half = chapsym.open_result(tmp_path / "half.zarr")
    assert dict(half.rows())["unfinished"] == words
    assert half.figure("contact").get_suptitle().startswith(words)
    # What counts is there; of a ball that stopped nothing more is to come.
    counted = half.dataset.step.values <= half.dataset.taken.values[:, np.newaxis]
    assert np.isfinite(half.dataset.gamma.values[counted]).all()
    assert int(words.split()[0]) == int(100 * (counted | (half.dataset.status.values > 0)[:, np.newaxis]).mean()) > 0
    stopped = int((half.dataset.status.values > 0).sum())
    assert dict(half.rows())["balls"] == "10" + (f", {stopped} of them stopped early" if stopped else "")
    for suffix in (".zarr", ".npz"):
        half.save(tmp_path / f"saved{suffix}")
        assert dict(chapsym.open_result(tmp_path / f"saved{suffix}").rows())["unfinished"] == words


def test_a_run_of_which_no_ball_has_begun_is_shown_as_a_table_only(tmp_path):
    small_units.interrupted(tmp_path / "none.zarr", 0, small_units.plan(small_units.OUTPUTS))
    assert "no ball of this result has run yet" in refused("show", tmp_path / "none.zarr", "-o", tmp_path / "p")
    assert "<svg" not in chapsym.open_result(tmp_path / "none.zarr")._repr_html_()


def test_each_result_has_a_folder_of_its_own_and_the_first_scene_its_page(tmp_path):
    for suffix in ("npz", "csv"):
        assert command("run", FIRST, "-o", tmp_path / f"first.{suffix}").returncode == 0
    shown = (answer("show", tmp_path / f"first.{end}", "--figures", "contact", "--page") for end in ("npz", "csv"))
    folders = [Path(one["folder"]) for one in shown]
    assert len(set(folders)) == 2
    assert all((folder / "page.html").exists() for folder in folders)


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    """The folder of a result."""
    folder = tmp_path_factory.mktemp("stored")
    results.folded().assign_attrs(chapsym_version="0").to_netcdf(folder / "a.nc", engine="h5netcdf")
    return folder


def test_the_command_draws_what_is_named(stored, tmp_path):
    done = command("show", stored / "a.nc", "-o", tmp_path / "p", "--figures", "integrals,contact", "--ball", "fast")
    assert done.returncode == 0, done.stderr
    assert sorted(path.name for path in (tmp_path / "p").iterdir()) == ["contact.svg", "integrals.svg"]


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["a.nc", "--figures", "trace"], "--figures trace: choose of contact, spheres"),
        (["a.nc", "--figures", "energy"], 'energy: no energy: add "energy"'),
        (["a.nc", "--format", "tiff"], "--format tiff: give svg, png, pdf, both, gif or mp4"),
        (["a.nc", "--ball", "third"], "no ball 'third'; its balls: slow, fast"),
        (["a.nc", "--page"], "attitude"),
        (["b.nc"], "b.nc"),
        (["a.txt"], "a.txt"),
        (["a.nc", "-o", "a.nc"], "is named twice"),
        (["no.toml"], "no.toml cannot be read"),
    ],
)
def test_mistakes_are_one_sentence(stored, tmp_path, arguments, sentence):
    paths = [str(stored / a) if a.endswith((".nc", ".txt", ".toml")) else a for a in arguments]
    assert sentence in refused("show", *paths, *([] if "-o" in paths else ["-o", tmp_path / "p"]))
    assert not (tmp_path / "p").exists()
