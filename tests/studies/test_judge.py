"""How far an engine is from a certified motion: `chapsym judge`, and the data of benchmarks/rolling."""

import csv
import hashlib
import json
import os
import re
import warnings
from decimal import Decimal
from pathlib import Path

import numpy as np
import pytest
from budget import slow
from commands import answer, chapsym, refused
from motion_reference import matrix

from benchmarks.rolling import make
from chapsym.studies.judge import Case, angle, carried, convergence, departure, read_case, sentence, summary
from chapsym.studies.judge_tables import MORE, NEEDED, Trajectory, in_space, read_trajectory

DATA = make.DATA
FILE = DATA / "random-3.json"
#: Of float64, some operations after one another.
ROUNDING = 50 * 2.0**-53


@pytest.fixture(scope="module")
def case():
    return read_case(FILE)


@pytest.fixture(scope="module")
def table():
    """The case as an engine without an error would write it: a row for each frame, by column."""
    lines = [line for line in FILE.with_suffix(".csv").read_text("utf-8").splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def text(table, step=None):
    head = [] if step is None else [f"# time_step = {step}"]
    rows = [",".join(map(repr, map(float, row))) for row in zip(*table.values(), strict=True)]
    return "\n".join([*head, ",".join(table), *rows]) + "\n"


def judged(case, table, folder):
    file = folder / "run.csv"
    file.write_text(text(table), encoding="utf-8")
    return departure(case, read_trajectory(file, case.time))


@pytest.mark.parametrize("file", sorted(DATA.glob("*.json")), ids=lambda file: file.stem)
def test_a_cases_own_table_departs_by_rounding_only(file):
    case = read_case(file)
    found = departure(case, read_trajectory(file.with_suffix(".csv"), case.time))
    long = max(1.0, abs(case.path).max())
    assert found["path"].max() <= ROUNDING * long
    assert np.radians(found["attitude"]).max() <= ROUNDING
    assert max(abs(found[name]).max() for name in ("energy", "momentum")) / 100 <= 4 * ROUNDING
    if case.radius:
        assert abs(found["height"]).max() == 0.0
        assert found["slip"].max() <= ROUNDING * case.radius * abs(case.omega).max()
    # a balanced ball keeps the momentum, and rolling the energy: what is left is rounding, of terms that may be larger
    energy, momentum = carried(case, case.attitude, case.moving, case.omega)
    frames = json.loads(file.read_text("utf-8"))["frames"]
    own = np.array([[float(middle) for middle, _ in frame["angular_momentum"]] for frame in frames])
    known = in_space(case.attitude, own) if case.offset.any() else momentum[0]
    assert np.linalg.norm(momentum - known, axis=-1).max() <= 4 * ROUNDING * np.linalg.norm(momentum[0])
    if case.velocity is None:
        assert abs(energy - energy[0]).max() <= 4 * ROUNDING * energy[0]


def test_a_shift_a_turn_and_a_lift_are_told(case, table, tmp_path):
    cos, sin = np.cos(np.radians(1)), np.sin(np.radians(1))  # a turn by 2 degrees about the vertical
    q = [table[name] for name in NEEDED[4:]]
    turned = [cos * q[0] - sin * q[3], cos * q[1] - sin * q[2], cos * q[2] + sin * q[1], cos * q[3] + sin * q[0]]
    moved = {"x": table["x"] + 1.2e-3, "y": table["y"] - 1.6e-3, "z": table["z"] + 3e-4}
    found = judged(case, table | moved | dict(zip(NEEDED[4:], turned, strict=True)), tmp_path)
    np.testing.assert_allclose(found["path"], 2e-3, rtol=1e-11)  # differences of metres
    np.testing.assert_allclose(found["attitude"], 2.0, rtol=1e-12)
    np.testing.assert_allclose(found["height"], 3e-4, rtol=1e-11)
    known = summary(found, case.time)
    assert (known["path"]["departs"], known["attitude"]["departs"]) == (0.0, 0.0)
    assert known["height"] | {"limit": 1e-3, "departs": None} == known["height"]


def test_a_speed_that_is_one_per_cent_higher_is_told_in_energy_momentum_and_slip(case, table, tmp_path):
    faster = {name: 1.01 * table[name] for name in MORE}
    found = judged(case, table | faster, tmp_path)
    np.testing.assert_allclose(found["energy"], 2.01, rtol=1e-11)  # 1.01² = 1.0201
    np.testing.assert_allclose(found["momentum"], 1.0, rtol=1e-11)
    assert found["slip"].max() <= ROUNDING * case.radius * abs(case.omega).max()  # it rolls
    found = judged(case, table | {name: 1.01 * table[name] for name in MORE[:3]}, tmp_path)
    speed = case.radius * np.linalg.norm(case.omega[:, :2], axis=-1)
    np.testing.assert_allclose(found["slip"], speed / 100, rtol=1e-11)
    # mv²/2 grows by 2.01 %, of an energy of which it is a part; mρ|v| by 1 % of a momentum that has the spin, too
    rows = matrix(case.attitude)
    spin = np.einsum("fij,j,fkj,fk->fi", rows, case.inertia, rows, case.omega)
    carried = spin + case.mass * case.radius**2 * case.omega * [1, 1, 0]
    energy = (case.omega * carried).sum(axis=-1)[0] / 2
    np.testing.assert_allclose(found["energy"], 2.01 * case.mass * speed**2 / 2 / energy, rtol=1e-9)
    whole = np.linalg.norm(carried[0])
    np.testing.assert_allclose(found["momentum"], case.mass * case.radius * speed / whole, rtol=1e-9)


def test_an_attitude_and_its_negative_are_one_and_velocities_may_be_left_out(case, table, tmp_path):
    other = table | {name: -table[name] for name in NEEDED[4:]}
    assert np.radians(judged(case, other, tmp_path)["attitude"]).max() <= ROUNDING
    found = judged(case, {name: table[name] for name in NEEDED}, tmp_path)
    assert list(found) == ["path", "attitude", "height"]
    q = np.array([1.0, 0.0, 0.0, 0.0])
    for small in (1e-9, 1.0, 179.0, 180.0):
        half = np.radians(small) / 2
        assert angle(q, np.array([np.cos(half), 0, np.sin(half), 0])) == pytest.approx(small, rel=1e-14)


def still(of):
    """The truth of a ball at rest, at the frames of a run."""
    frames = len(of.centre)
    attitude = np.tile([1.0, 0, 0, 0], (frames, 1))
    path, omega = (np.zeros((frames, n)) for n in (2, 3))
    return Case("still", 1.0, 1.0, np.ones(3), np.arange(frames), path, attitude, omega)


def run(step, order, floor, by=1.0, frames=5):
    """Off by step^order along x, times `by`, and by the floor beyond that: a soft contact, say."""
    away = np.linspace(0, 1, frames)
    centre = np.stack([away * (by * step**order + floor), 0 * away, 0 * away], axis=-1)
    return Trajectory("made up", centre, np.tile([1.0, 0, 0, 0], (frames, 1)), None, None, step)


@pytest.mark.parametrize(("order", "floor"), [(1, 0.0), (2, 0.003), (4, 1e-4)])
def test_the_order_and_the_floor_of_known_runs_are_found(order, floor):
    runs = [run(step, order, floor) for step in (0.1, 0.4, 0.2)]  # in any order
    found = convergence(still(runs[0]), runs)
    assert found.order == pytest.approx(order, rel=1e-11)
    assert found.of_the_step == pytest.approx(0.1**order, rel=1e-10)
    assert found.floor == pytest.approx(floor, rel=1e-8, abs=1e-12)
    assert sentence(found, "m").startswith(f"order {order:.2f}; ")


def test_an_error_of_the_step_that_hides_the_floor_is_seen():
    """1 mm and -0.9 (h/1 ms)² mm: the finest run is 0.1 mm off, its limit 1 mm."""
    runs = [run(step, 2, 1e-3, -0.9e-3 / 0.1**2) for step in (0.4, 0.2, 0.1)]
    found = convergence(still(runs[0]), runs)
    assert found.of_the_step == pytest.approx(0.9e-3, rel=1e-9)
    assert found.floor == pytest.approx(1e-3, rel=1e-9)


def test_the_order_of_the_attitude_does_not_see_the_sign_of_a_quaternion(case):
    runs = []
    for i, step in enumerate((0.4, 0.2, 0.1)):
        half = np.radians(5 * step**2 + 2) / 2
        turned = np.tile([np.cos(half), 0, 0, np.sin(half)], (3, 1)) * (-1) ** i
        runs.append(Trajectory(f"{step}", np.zeros((3, 3)), turned, None, None, step))
    found = convergence(still(runs[0]), runs, "attitude")
    assert found.order == pytest.approx(2, rel=1e-4)
    assert found.of_the_step == pytest.approx(0.05, rel=1e-4)
    assert found.floor == pytest.approx(2, rel=1e-4)


def test_steps_that_do_not_matter_have_no_order():
    runs = [run(step, 2, 0.0) for step in (0.1, 0.1, 0.1)]
    for one, step in zip(runs, (0.4, 0.2, 0.1), strict=True):
        object.__setattr__(one, "step", step)
    found = convergence(still(runs[0]), runs)
    assert (found.order, found.of_the_step, found.floor) == (None, None, None)
    assert sentence(found, "m") == "the differences between steps do not fall: no order"


def first(table, name, value):
    return table | {name: np.array([value, *table[name][1:]])}


REFUSED = {
    "has no column qw": lambda t: text({name: column for name, column in t.items() if name != "qw"}),
    "has no row at 10 s: it must have one at each time": lambda t: text({k: v[:-1] for k, v in t.items()}),
    "has no row at 0.25 s": lambda t: text(t | {"time": t["time"] + 1e-3 * (t["time"] == 0.25)}),
    "the quaternion at 0 s has the length": lambda t: text(first(t, "qw", 3.0)),
    "row 1: vx must be a number below 1e+100, not 'nan'": lambda t: text(first(t, "vx", np.nan)),
    "row 2 has 3 cells, and the row of names 14": lambda t: "\n".join([*text(t).splitlines()[:2], "0.25,1,2"]),
    "row 1: time must be a number": lambda t: text(t).replace("\n0.0,", "\nzero,"),
    "row 1: vx must be a number below 1e+100, not '1e+308'": lambda t: text(first(t, "vx", 1e308)),
    "has the column x twice": lambda t: text(t).replace("vx,vy", "x,vy"),
    "has two rows at 10 s": lambda t: text(t) + "10.0" + ",1" * 13 + "\n",
    "has no rows": lambda t: text(t).splitlines()[0],
    "has no column time": lambda t: "",
    "time_step must be a positive number of seconds, not -1": lambda t: text(t, -1),
    "time_step must be a positive number of seconds, not soon": lambda t: text(t, "soon"),
}


@pytest.mark.parametrize(
    ("suffix", "kind", "made"),
    [("", "pipe", os.mkfifo), (".csv", "pipe", os.mkfifo), ("", "device", lambda path: path.symlink_to(os.devnull))],
)
def test_a_pipe_is_not_waited_for_and_a_device_may_have_no_end(suffix, kind, made, table, tmp_path):
    pipe, file = tmp_path / f"pipe{suffix}", tmp_path / "table.csv"
    made(pipe)
    file.write_text(text(table), encoding="utf-8")
    assert f"is a {kind}, not a file" in refused("judge", pipe, "--against", FILE)
    assert f"is a {kind}, not a file" in refused("judge", file, "--against", pipe)


@pytest.mark.parametrize("sentence", REFUSED)
def test_a_table_that_cannot_be_judged_is_refused_in_one_sentence(sentence, table, tmp_path):
    file = tmp_path / "bad.csv"
    file.write_text(REFUSED[sentence](table), encoding="utf-8")
    assert sentence in refused("judge", file, "--against", FILE)


def test_files_that_are_none_are_refused_in_one_sentence(table, tmp_path):
    own = FILE.with_suffix(".csv")
    assert "two do not tell an order" in refused("judge", own, own, "--against", FILE)
    assert "has no line '# time_step = SECONDS'" in refused("judge", own, own, own, "--against", FILE)
    steps = []
    for step in (0.004, 0.002, 0.0005):
        steps.append(tmp_path / f"{step}.csv")
        steps[-1].write_text(text(table, step), encoding="utf-8")
    assert "the same number each time, but they are 0.004, 0.002, 0.0005" in refused("judge", *steps, "--against", FILE)
    assert "the same number" in refused("judge", steps[0], steps[0], steps[0], "--against", FILE)
    assert "is no case" in refused("judge", own, "--against", own)
    other = tmp_path / "other.json"
    sliding = json.loads((DATA / "sliding.json").read_text("utf-8"))
    del sliding["frames"][7]["velocity"]
    texts = ["{}", "[]", '{"case": "a", "ball": {"mass": "1/0"}}', "[" * 100000]
    for content in (*texts, json.dumps(sliding), json.dumps(sliding | {"frames": ["contact"]})):
        other.write_text(content, encoding="utf-8")
        assert "is no case" in refused("judge", own, "--against", other)
    assert "cannot be read: No such file" in refused("judge", own, "--against", tmp_path / "none.json")
    assert "cannot be read: No such file" in refused("judge", tmp_path / "none.csv", "--against", FILE)
    assert "cannot be read" in refused("judge", tmp_path, "--against", FILE)
    (tmp_path / "bytes.csv").write_bytes(b"\xff\xfe\x00")
    assert "is not UTF-8 text" in refused("judge", tmp_path / "bytes.csv", "--against", FILE)
    assert "must end in .svg" in refused("judge", tmp_path / "none.csv", "--against", FILE, "-o", tmp_path / "x.txt")


@pytest.fixture(scope="module")
def three(table, tmp_path_factory):
    """Three runs of an engine of order 2 that is 2 mm off whatever its step."""
    folder = tmp_path_factory.mktemp("three")
    for step in (0.04, 0.02, 0.01):
        file = folder / f"{step}.csv"
        file.write_text(text(table | {"x": table["x"] + (step**2 + 0.002) * table["time"] / 10}, step), "utf-8")
    return sorted(folder.iterdir())


def test_the_command_tells_the_departure_and_the_order(three):
    found = answer("judge", *three, "--against", FILE)
    assert list(found) == ["case", "results", "convergence"]
    assert found["case"] == "random-3"
    assert [row["time_step"] for row in found["results"]] == [0.01, 0.02, 0.04]
    path = found["results"][0]["departure"]["path"]
    assert list(path) == ["greatest", "end", "unit", "limit", "departs"]
    assert path["greatest"] == pytest.approx(0.0021, rel=1e-9)
    assert (path["unit"], path["limit"], path["departs"]) == ("m", 1e-3, 5.0)  # 2.1 mm · t/10 s: from 4.76 s on
    assert found["convergence"]["path"]["order"] == pytest.approx(2, rel=1e-6)
    assert found["convergence"]["path"]["floor"] == pytest.approx(0.002, rel=1e-6)
    assert found["convergence"]["attitude"] == {"order": None, "of_the_step": None, "floor": None}
    said = chapsym("judge", three[0], "--against", FILE).stdout.splitlines()
    assert said[0] == f"{three[0]}, step 0.01 s, against random-3:"
    assert said[1].split() == ["path", "at", "most", "0.0021", "m", "beyond", "0.001", "m", "from", "5", "s", "on"]
    assert [line.split()[0] for line in said[1:]] == ["path", "attitude", "energy", "momentum", "height", "slip"]
    assert "within 1 degree" in said[2]


def test_the_page_has_one_table_and_the_curves_and_the_figure_is_written(three, tmp_path):
    pytest.importorskip("matplotlib")
    page = tmp_path / "page.html"
    assert f"wrote {page}" in chapsym("judge", *three, "--against", FILE, "-o", page).stdout
    written = page.read_text("utf-8")
    assert written.count("<table>") == written.count("<svg") == 1
    assert written.count("<tr>") == 4
    assert "<th>0.01.csv</th><td>0.01</td><td>0.0021<br><small>from 5 s on</small></td>" in written
    assert "path: order 2.00" in written
    assert "prefers-color-scheme: dark" in written
    assert not re.search(r"(src|href)=.http|url\(http|<script", written)
    done = chapsym("judge", FILE.with_suffix(".csv"), "--against", FILE, "-o", tmp_path / "one.svg")
    assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / "one.svg").read_text("utf-8").startswith("<?xml")


def test_what_is_off_by_nothing_is_drawn_without_a_warning(case, tmp_path):
    """Of zeros there is no logarithm."""
    pytest.importorskip("matplotlib")
    from chapsym.studies.judge_drawing import save

    centre = np.column_stack([case.path, np.full(len(case.path), case.radius)])
    own = Trajectory("own.csv", centre, case.attitude, case.moving, case.omega, None)
    found = departure(case, own)
    assert not any(part.any() for part in found.values())
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        save(tmp_path / "own.svg", case, [own], [found], {})


def test_the_data_are_those_that_their_hashes_name():
    lines = (DATA / "SHA256SUMS").read_text("utf-8").splitlines()
    named = dict(reversed(line.split("  ")) for line in lines)
    cases = {*make.OWN, *(scene.stem for scene in make.CASES.glob("*.toml"))}
    alone = cases - {"free-top", "rotor", "sliding"}
    balls = {f"{name}.{form}" for name in alone for form in make.BODIES}
    assert set(named) == {f"{name}.{kind}" for name in cases for kind in ("json", "csv")} | balls
    for name, digest in named.items():
        assert hashlib.sha256((DATA / name).read_bytes()).hexdigest() == digest, name


@pytest.mark.parametrize("name", ["homogeneous", *slow("robot-slow")])
def test_data_that_are_made_anew_say_the_same(name):
    """The balls have a point in common; the table has the same bytes; the steps may differ with the machine."""
    pytest.importorskip("pydantic")
    case, kept = make.made(make.CASES / f"{name}.toml"), json.loads(Path(DATA, f"{name}.json").read_text("utf-8"))
    assert case["ball"] == kept["ball"]
    for new, old in zip(case["frames"], kept["frames"], strict=True):
        assert new["time"] == old["time"]
        for part in ("gamma", "angular_momentum", "omega", "attitude", "contact"):
            for (x, more), (y, less) in zip(new[part], old[part], strict=True):
                assert abs(Decimal(x) - Decimal(y)) <= Decimal(more) + Decimal(less)
    assert make.table(case) == Path(DATA, f"{name}.csv").read_text("utf-8")
    assert json.loads(make.text(case)) == case


@pytest.mark.skipif(os.name == "nt", reason="no such names")
def test_the_name_of_a_file_is_shown_without_what_a_terminal_obeys(case, table, tmp_path):
    file = tmp_path / "a\x1b]0;b\x07\u202e.csv"
    file.write_text(text(table), encoding="utf-8")
    assert read_trajectory(file, case.time).file.endswith(r"a\x1b]0;b\x07\u202e.csv")
