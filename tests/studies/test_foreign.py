"""Trajectories of other programs that are shown, and results of chapsym that are judged."""

import numpy as np
import pytest
from commands import answer, refused
from commands import chapsym as command
from first import FIRST

import chapsym
from chapsym.dynamics import BadInput
from chapsym.show.result import Result, run_scene
from chapsym.studies.foreign import result_of, table_of

HEAD = "time,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz"


OUTPUTS = ["attitude", "contact", "omega"]


def scene():
    ball = {"inertia": [0.006, 0.007, 0.009], "mass": 2.0, "radius": 0.1}
    start = {"omega": [3.0, -2.0, 1.0], "gamma": ["2/7", "3/7", "6/7"]}
    return {"ball": ball, "start": start, "run": {"time_step": 0.01, "steps": 50, "outputs": OUTPUTS}}


@pytest.fixture(scope="module")
def result(tmp_path_factory):
    """A result with ω, in a CSV and in an .npz."""
    folder = tmp_path_factory.mktemp("result")
    found = run_scene(scene())
    for suffix in (".csv", ".npz"):
        found.save(folder / f"run{suffix}")
    return found, folder


@pytest.mark.parametrize("suffix", [".csv", ".npz"])
def test_a_result_of_chapsym_is_judged(result, tmp_path, suffix):
    text = FIRST.read_text(encoding="utf-8").replace("steps = 1000", "steps = 50")
    (tmp_path / "first.toml").write_text(text, encoding="utf-8")
    found = answer("judge", result[1] / f"run{suffix}", "--against", tmp_path / "first.toml")["results"][0]["departure"]
    assert found["path"]["greatest"] < 1e-7
    assert found["attitude"]["greatest"] < 1e-4
    assert found["slip"]["greatest"] < 1e-12
    assert found["momentum"]["greatest"] < 1e-4


def test_a_table_of_another_program_is_the_result_it_was_made_of(result, tmp_path):
    """Contact point, attitude, ω in the body and γ; it slips where its velocity is another than ω × r."""
    data, folder = result[0].dataset, result[1]
    table = table_of(folder / "run.csv")
    table.columns["vx"][-1] += 0.02
    rows = zip(*(table.columns[name] for name in HEAD.split(",")), strict=True)
    path = tmp_path / "engine.csv"
    lines = [",".join(map(repr, map(float, row))) for row in rows]
    path.write_text("\n".join(["# time_step = 0.001", HEAD, *lines]), encoding="utf-8")
    found = result_of(path)
    for name in OUTPUTS:
        assert found[name].attrs == data[name].attrs
        np.testing.assert_allclose(found[name], data[name], atol=1e-12)
    turned = run_scene({**scene(), "run": {**scene()["run"], "outputs": ["gamma"]}}).dataset
    np.testing.assert_allclose(found["gamma"], turned["gamma"], atol=1e-6)
    assert found["radius"].values == 0.1
    np.testing.assert_allclose(found["slip"][0], np.array([0.0] * 50 + [0.02]), atol=1e-12)
    assert Result(found).figures()["slip"] is None
    assert "slip" not in result[0].figures()
    done = command("show", path, "-o", tmp_path / "pictures")
    assert (done.returncode, done.stderr, "not drawn" in done.stdout) == (0, "", False)
    names = {one.name for one in (tmp_path / "pictures").iterdir()}
    assert {"contact.svg", "slip.svg", "omega.svg", "attitude.svg", "page.html"} <= names


@pytest.mark.parametrize(
    ("name", "text", "drawn", "lacking"),
    [
        ("srr.csv", "7.5 0 0 0 -.6 -.8 0 0\n7.6 .1 .1 0 -.6 -.8 0 0\n", ["contact", "attitude"], ["omega", "page"]),
        ("tracker.csv", "mass_A\nt;x;y\n0;1;2\n.1;1.1;2.2\n", ["contact"], ["omega", "attitude", "page"]),
        ("tum.txt", "0 0 0 .1 0 0 0 1\n1 .1 .1 .1 0 0 0 1\n", ["contact", "attitude", "page"], ["omega"]),
    ],
)
def test_what_a_tracker_writes_is_shown_as_far_as_it_has_it(tmp_path, name, text, drawn, lacking):
    (tmp_path / name).write_text(text, encoding="utf-8")
    done = command("show", tmp_path / name, "-o", tmp_path / "pictures")
    assert (done.returncode, done.stderr) == (0, "")
    there = {path.stem for path in (tmp_path / "pictures").iterdir()}
    assert set(drawn) <= there
    for one in lacking:
        assert f"not drawn: {one} (the table has no columns for it)" in done.stdout


def test_what_is_no_trajectory_is_one_sentence(tmp_path, result):
    path = tmp_path / "simb.csv"
    path.write_text("RAI,RAI,RAI,0,1,0.001\n", encoding="utf-8")
    assert "has no column time: its first row must name" in refused("show", path)
    assert "is no result: one ends in" in refused("show", tmp_path)
    path.write_text("t,x,y,z,qw,qx,qy,qz\n0,0,0,.1,2,0,0,0\n1,0,0,.1,2,0,0,0\n", encoding="utf-8")
    assert "the quaternion at 0 s has the length 2, not 1" in refused("show", path)
    result[0].dataset[["contact", "radius"]].pipe(Result).save(tmp_path / "part.csv")
    with pytest.raises(BadInput, match="has no attitude: a trajectory needs outputs"):
        table_of(tmp_path / "part.csv")


def test_a_file_is_read_before_a_motion_is_certified(tmp_path, monkeypatch):
    monkeypatch.setattr("chapsym.studies.comparable.case_of_scene", lambda *_: pytest.fail("a motion is certified"))
    assert "cannot be read: No such file" in refused("judge", tmp_path / "none.csv", "--against", FIRST)


def test_a_result_is_a_trajectory_up_to_where_its_one_ball_stopped(tmp_path):
    ball, momenta = chapsym.Ball((0.1, 0.5, 1.6), 0.7, 0.1), [(0.5, 0.3, 0.2), (1.44, 0.96, 0.3)]
    run = chapsym.trajectory(ball, momenta, (2 / 7, 3 / 7, 6 / 7), 60, contact=True, time_step=0.1)
    assert run.taken[1] < 60
    Result(run.to_xarray()).save(tmp_path / "two.csv")
    with pytest.raises(BadInput, match="has 2 balls: a trajectory is of one"):
        table_of(tmp_path / "two.csv")
    Result(run.to_xarray().isel(ball=[1])).save(tmp_path / "one.csv")
    assert len(table_of(tmp_path / "one.csv").times) == run.taken[1] + 1
