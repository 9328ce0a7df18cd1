"""Certificates of motions: the files that are shipped, the start that is written, and the command that makes one."""

import json
import re
import subprocess
import sys
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace

import pytest
from commands import chapsym as command
from flint import ctx

import chapsym.proofs
from chapsym import checker
from chapsym.certificates import motion
from chapsym.cli import certify, report
from chapsym.dynamics import BadInput, enclosed_motion
from chapsym.dynamics.enclosed_motion import follow
from chapsym.dynamics.flow.start import Principal, Start, balls, fixed
from chapsym.dynamics.levels.balls import unit
from chapsym.dynamics.levels.start import fraction
from chapsym.scene import load
from chapsym.scene.members.exactly import exact_motion

ROOT = Path(__file__).parents[2]
FILES = sorted((Path(chapsym.proofs.__file__).parent / "certificates").glob("motion-*.json"))
SCENE = """
[ball]
inertia = [0.006, 0.007, 0.009]
mass = 2
radius = 0.1

[start]
omega = {omega}
{turned}

[run]
time_step = 0.25
steps = 2
"""


def scene(folder, omega='[3, -2, "1.1"]', turned='gamma = ["2/7", "3/7", "6/7"]'):
    (folder / "scene.toml").write_text(SCENE.format(omega=omega, turned=turned))
    return folder / "scene.toml"


def read(path):
    return json.loads(path.read_text(encoding="utf-8"))


def check_status(path):
    return command("certify", "check", path).returncode


@pytest.mark.parametrize(
    "path", [pytest.param(p, marks=pytest.mark.thorough if "giant" in p.stem else (), id=p.stem) for p in FILES]
)
def test_the_shipped_files_are_accepted_with_the_standard_library_alone(path):
    done = subprocess.run(
        [sys.executable, "-S", "-I", "checker", str(path)], cwd=ROOT, capture_output=True, timeout=200, check=False
    )
    assert done.returncode == 0, done.stderr
    assert path.stat().st_size < 100_000


@pytest.mark.parametrize("path", FILES, ids=lambda p: p.stem)
def test_the_shipped_files_are_of_the_cases_and_have_their_digits(path):
    """Those of the data set have 30 digits."""
    data, name = read(path), path.stem.removeprefix("motion-")
    start, times = exact_motion(load(ROOT / f"benchmarks/rolling/cases/{name}.toml"))
    assert [Fraction(x) for x in data["ball"]["J"]] == list(start.mass_tensor)
    assert [Fraction(x["time"]) for x in data["frames"]] == list(times)
    found = read(ROOT / f"benchmarks/rolling/data/{name}.json")
    for ours, theirs in zip(data["frames"], found["frames"], strict=True):
        for part in checker.motion.PARTS:
            for (x, radius), (y, _) in zip(ours[part], theirs[part], strict=True):
                assert abs(Fraction(x) - Fraction(y)) <= Fraction(radius)


def test_no_proof_rests_on_them(monkeypatch):
    """They are not on the page of the open questions."""
    monkeypatch.setattr(checker, "check", lambda data: checker.Verdict(data["kind"], "", {}, ""))
    names = {one.name for one in report._certificates()}
    assert names
    assert not names & {path.name for path in FILES}


def test_a_start_is_written_as_it_is_given_or_up_to_a_radius(tmp_path):
    start, times = exact_motion(load(scene(tmp_path)))
    data = motion.motion(start, follow(start, times, 10))
    assert data["start"]["attitude"] == [["1", "0"], ["3/13", "0"], ["-2/13", "0"], ["0", "0"]]
    assert [x[1] for x in data["start"]["momentum"]] == ["0"] * 3
    rough = exact_motion(load(scene(tmp_path, omega='["7 rpm", 1, 2]', turned='rpy = ["50 deg", "10 deg", 1]')))[0]
    found = motion.document(rough, follow(rough, times, 10), 100)["start"]
    with ctx.workprec(400):
        a = rough.attitude()
        wanted = {
            "attitude": [x / max(a) for x in a],
            "momentum": rough.momentum(unit(a), Principal(balls(rough.mass_tensor))),
        }
    for name, numbers in wanted.items():
        for x, (middle, radius) in zip(numbers, found[name], strict=True):
            assert abs(fraction(x) - Fraction(middle)) <= Fraction(radius)
    assert Fraction(found["momentum"][0][1]) > 0


def test_the_first_number_of_an_attitude_that_is_not_0_is_positive():
    """Half a turn: the first number is 0 at the start, up to its radius, and goes through it."""
    q, K = [Fraction(0), Fraction(-1), Fraction(0), Fraction(0)], [Fraction(1), Fraction(2), Fraction(1, 3)]
    start = Start([Fraction(1), Fraction(2), Fraction(4)], Fraction(0), lambda: balls(q), fixed(K))
    data = motion.motion(start, follow(start, [Fraction(0), Fraction(1)], 6))
    assert data["frames"][0]["attitude"][:2] == [["0", "1e-6"], ["1", "1e-6"]]
    assert Fraction(data["frames"][1]["attitude"][0][0]) > 0
    assert "contact" not in data["frames"][0]


def test_the_command_writes_what_the_checker_accepts(tmp_path):
    path = tmp_path / "certificate.json"
    done = command("certify", "motion", scene(tmp_path), "--digits", "12", "--certificate", path)
    assert f"wrote {path}; check it by chapsym certify check {path}" in done.stdout
    assert check_status(path) == 0
    data = read(path)
    data["frames"][1]["gamma"][0][0] = "0.5"
    path.write_text(json.dumps(data))
    assert check_status(path) == 1


def test_what_the_checker_cannot_follow_is_refused_in_a_sentence(tmp_path, monkeypatch):
    start, times = exact_motion(load(scene(tmp_path)))
    found = follow(start, times, 10)
    monkeypatch.setattr(motion, "MOST", motion.GUARD)
    monkeypatch.setattr(checker.rolling, "MOST_STEPS", 1)
    with pytest.raises(BadInput, match="ask for less time or fewer digits: the motion takes more than 1 steps"):
        motion.motion(start, found)
    monkeypatch.setattr(checker.form, "MOST", 2)
    with pytest.raises(BadInput, match="at most 2 frames, not 3"):
        motion.motion(start, found)


def test_more_frames_than_a_certificate_has_are_refused_before_the_motion_is_followed(tmp_path, monkeypatch):
    monkeypatch.setattr(checker.form, "MOST", 2)
    monkeypatch.setattr(enclosed_motion, "follow", None)
    with pytest.raises(BadInput, match="at most 2 frames, not 3"):
        certify.motion(scene(tmp_path), certificate=tmp_path / "certificate.json")


def test_what_is_proved_is_written_where_the_checker_reaches_the_limit(tmp_path, monkeypatch, capsys):
    output = tmp_path / "motion.json"
    # The motion has all of the limit, and the checker what is left: no time, so that its process is ended at once.
    monkeypatch.setattr(certify, "time", SimpleNamespace(monotonic=iter((0, 1e9)).__next__))
    with pytest.raises(BadInput, match="the checker had not ended at the limit, with 82 bits; raise it, or ask"):
        certify.motion(scene(tmp_path), 10, certificate=tmp_path / "certificate.json", output=output)
    assert capsys.readouterr().err.count("the checker tries") == 1
    assert len(read(output)["frames"]) == 3


@pytest.mark.parametrize("search", ["no-invariant-measure", "heteroclinic", "periodic-orbit", "energy-drift"])
def test_a_search_ends_at_its_limit_with_what_was_reached(search):
    done = command("certify", search, "--limit", "1e-9")
    assert done.returncode == 1
    assert re.fullmatch(
        r"chapsym: stopped at the limit of 1e-09 s: .+; ask for less, or raise the limit\n", done.stderr
    )
