"""Certificates of runs in float64: the checker follows the orbit in integers, and refuses what is outside."""

import json
import random

import numpy as np
import pytest
from certificate_changes import at, changed, leaves, refused, replaced, resealed
from commands import chapsym as command
from commands import refused as refused_command
from first import BALL

import chapsym
from chapsym import checker
from chapsym.certificates import run as certificates
from chapsym.dynamics import BadInput
from chapsym.dynamics.errors import LimitReached

BODY, START = chapsym.Ball((0.1, 0.5, 1.6), 0.7), ((0.03, -0.02, 0.035), (2 / 7, 3 / 7, 6 / 7))


def made(steps, every, **options):
    return chapsym.trajectory(BODY, *START, steps, every=every, proved=True, **options)


@pytest.fixture(scope="module")
def found():
    return certificates.map_run(made(20, 10))


def test_a_run_is_judged(found):
    verdict = checker.check(found)
    assert verdict.kind == "map-run"
    assert [frame["step"] for frame in found["frames"]] == [10, 20]
    assert float(verdict.numbers["gamma after step 20, off by at most"]) < 1e-15
    assert "at 2 steps of the map up to step 20" in verdict.statement


def test_the_process_of_the_checker_ends_at_the_limit():
    said = []
    with pytest.raises(LimitReached, match="had not ended at the limit, with 236 bits; raise it, or take fewer steps"):
        certificates.map_run(made(20, 10), said.append, limit=1e-9)
    assert said == ["the checker tries 236 bits"]


@pytest.mark.parametrize("part", ["momentum", "gamma"])
def test_a_bound_that_is_too_small_is_refused(found, part):
    run = made(20, 10)
    exact = chapsym.trajectory(BODY, *START, 20, every=20, precision="double-double")
    off = getattr(run, part)[-1] - getattr(exact, part)[-1] - getattr(exact.low, part)[-1]
    place = ("frames", 1, "bounds", part)
    less, more = (f"{np.linalg.norm(off) * share:.20f}" for share in (0.999, 1.001))
    assert refused(resealed(replaced(found, place, less)))
    assert refused(resealed(replaced(found, place, "-1")))
    assert checker.check(resealed(replaced(found, place, more)))


def test_numbers_that_are_changed_are_refused(found):
    """Of those of a ball, a start, a frame: what a bound of 1e-16 sees."""
    rng, seen = random.Random(3), 0
    for place in leaves(found):
        if place[0] in ("ball", "start") or {"momentum", "gamma"} & set(place[2:-1]):
            text = at(found, place)
            digits = [i for i, c in enumerate(text[:12]) if c.isdigit() and c != "0"]
            one = text[: digits[0]] + str(9 - int(text[digits[0]])) + text[digits[0] + 1 :]
            assert refused(resealed(replaced(found, place, one))), place
            seen += 1
    assert seen == 3 + 1 + 6 + 12
    for place in (("frames", 0, "step"), ("bits",)):
        assert refused(resealed(replaced(found, place, changed(at(found, place), rng) % 60 + 1)))


@pytest.mark.parametrize(("place", "value", "said"), [
    (("frames",), [], "frames must not be empty"), (("start", "gamma"), ["0", "0", "0"], "has no direction"),
    (("start", "momentum"), ["3", "0", "0"], "small branch is not proved"), (("frames", 0, "step"), 20, "later step"),
    (("bits",), 64, "is not proved to be within its bound"), (("bits",), 10**9, "must be an integer from 64"),
])  # fmt: skip
def test_what_is_refused_is_said(found, place, value, said):
    with pytest.raises(checker.Rejected, match=said):
        checker.check(resealed(replaced(found, place, value)))


@pytest.mark.parametrize(("run", "said"), [
    (lambda: chapsym.trajectory(BODY, *START, 4), "of one ball, of the map itself, in double precision"),
    (lambda: made(4, 1, order=4), "of the map itself"), (lambda: made(4, 1, precision="double-double"), "in double"),
    (lambda: made(1001, 1001), "the checker follows 1 to 1000 steps"),
    (lambda: made(4, 5), "the last frame of the run is at 0"),
    (lambda: chapsym.trajectory(BODY, (0.6, 0.1, 0), (0, 0, 1), 4, proved=True), "small branch is not proved"),
])  # fmt: skip
def test_runs_of_which_there_is_none(run, said):
    with pytest.raises(BadInput, match=said):
        certificates.map_run(run())


@pytest.mark.parametrize(
    ("size", "turning", "D"), [(1e-45, 1.0, 0.7), (1e150, 1.0, 0.7), (1.0, 0.0, 0.7), (1.0, 1.0, 1e6)]
)
def test_runs_in_other_units_at_rest_and_of_heavy_balls_are_judged(size, turning, D):
    ball, (momentum, gamma) = chapsym.Ball(BODY.mass_tensor * size, D * size), START
    run = chapsym.trajectory(ball, np.array(momentum) * size * turning, gamma, 20, every=20, proved=True)
    bounds = certificates.map_run(run)["frames"][0]["bounds"]
    assert run.proved.momentum[1] <= float(bounds["momentum"]) <= 1.01 * run.proved.momentum[1] + 5e-324
    assert run.proved.gamma[1] <= float(bounds["gamma"]) <= 1.01 * run.proved.gamma[1]


def test_the_command_makes_one_of_a_scene(tmp_path):
    path, file = tmp_path / "map.toml", tmp_path / "run.json"
    path.write_text(f"{BALL}time_step = 0.01\nsteps = 30\nevery = 15\nmap = true\n")
    done = command("certify", "run", path, "-o", file)
    assert "Proved: The ball with J" in done.stdout
    assert checker.check(json.loads(file.read_text())).kind == "map-run"
    path.write_text(f"{BALL}time_step = 0.01\nsteps = 1_000_000_000_000\nevery = 1_000_000_000_000\nmap = true\n")
    assert "the checker follows 1 to 1000 steps" in refused_command("certify", "run", path)
    path.write_text(f"{BALL}time_step = 0.01\nsteps = 30\n")
    assert "name a FILE, or a --manifest" in refused_command("certify", "check")
    assert "is of the motion of the ball: add map = true" in refused_command("certify", "run", path)
    assert "is named twice: choose another name" in refused_command("certify", "run", path, "-o", path)
    for link, target in (("a", "b"), ("b", "a")):  # a circle, which is no file that is read
        (tmp_path / link).symlink_to(tmp_path / target)
    assert "is of the motion of the ball" in refused_command("certify", "run", path, "-o", tmp_path / "a")


def test_a_top_is_followed_too():
    """D = 0, where the map is the discrete Euler top."""
    run = chapsym.trajectory(chapsym.Ball((1, 2, 4), 0), (0.3, -0.5, 0.2), START[1], 10, every=5, proved=True)
    found = certificates.map_run(run)
    assert found["ball"]["D"] == "0"
    assert refused(resealed(replaced(found, ("frames", 1, "momentum", 0), "0.3")))
