"""The trade of speed against accuracy: frontiers, references, the command."""

import json
from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from commands import answer, refused
from commands import chapsym as command
from first import BALL, FIRST

from benchmarks import trade
from benchmarks.trade import frontiers
from benchmarks.trade.figure import draw
from benchmarks.trade.frontiers import Frontier, Point, digits_of, name_of, sample, true_error, truth
from benchmarks.trade.requests import Outcomes, measure
from chapsym.accuracy import Method, methods, take
from chapsym.cli.trade import print_answer
from chapsym.numbers import NAMED

#: An accuracy and a time; of an option that is given twice the last counts.
ASKED = ["--accuracy", "1e-6", "--time", "3"]
POINTS = [
    Point("a, order 2", 0.1, 1.0, 10.0, 3.0),
    Point("a, order 2", 0.05, 1.0, 20.0, 4.0),
    Point("b, order 4", 0.1, 1.0, 15.0, 8.0),
    Point("c, order 6", 0.1, 1.0, 16.0, 7.0),
]


def test_the_frontier_and_what_is_dominated_and_equal_points_are_not():
    found = Frontier("t", "q", POINTS, [])
    assert [(p.name, p.digits) for p in found.best] == [("a, order 2", 3.0), ("b, order 4", 8.0)]
    assert found.dominated == {"c, order 6": "b, order 4"}
    assert found.cheapest(3.5) == POINTS[2]
    assert found.cheapest(9) is None
    assert [row["digits"] for row in found.table()] == [3, 6]
    plain = found.as_json()
    assert [p["frontier"] for p in plain["points"]] == [True, False, True, False]
    json.dumps(plain, allow_nan=False)
    twins = [Point("a, order 2", 0.1, 1.0, 1.0, 3.0), Point("b, order 4", 0.1, 1.0, 1.0, 3.0)]
    assert Frontier("t", "q", twins, []).dominated == {}
    assert [digits_of(x, 30) for x in (1e-5, 0.0, 2.0)] == pytest.approx([5, 30, 0])


def test_the_reference_agrees_with_a_run_in_double_double_and_says_where_it_has_not_its_digits(monkeypatch):
    """A Taylor series, and a composition of the map, which has nothing of it."""
    request = sample("contact", 2.0)
    run = take(request, Method(NAMED["double-double"], 8), 1600, 16)
    assert true_error(request, run, truth(request, 25)) < 1e-21
    monkeypatch.setattr(frontiers, "PATIENCE", 1e-9)
    with pytest.raises(trade.NotComparable, match="not enough for 34 digits"):
        truth(request, 34)


def test_random_requests_are_met_and_one_that_is_not_is_told():
    found = measure(quick=True, say=lambda text: None)
    assert found.hits == len(found.outcomes) == 5
    for one in found.outcomes:
        assert one.error <= one.answer.estimate <= one.request.accuracy
    plain = found.as_json()
    assert plain["hits"] == 5
    json.dumps(plain, allow_nan=False)
    assert trade.missed({"requests": found}) is None
    found = Outcomes([one, replace(one, error=2 * one.request.accuracy)])
    assert trade.missed({"requests": found}) == "1 of 2 requests were not met"


@pytest.mark.thorough
def test_a_section_is_measured():
    found = trade.run("contact", quick=True)
    assert all(p.per_time > 0 and 0 <= p.digits <= 34 for p in found.points)
    assert found.best
    for name in {p.name for p in found.points}:  # shorter steps are more exact, up to the rounding of the precision
        digits = [p.digits for p in sorted(found.points, key=lambda p: -p.step) if p.name == name]
        most = 6 if name.startswith("single") else 12.5
        assert all(b > a or min(a, b) > most for a, b in pairwise(digits)), name


def test_a_figure_is_drawn(tmp_path):
    drawn = draw({"contact": Frontier("t", "q of 𝒦", POINTS, []), "batch": Frontier("u", "q", POINTS[:2], [])})
    drawn.savefig(tmp_path / "figure.svg")
    text = (tmp_path / "figure.svg").read_text()
    assert text.startswith("<?xml")
    assert len(drawn.axes) == 2
    assert all(axis.get_yscale() == "log" for axis in drawn.axes)


def test_every_way_that_is_measured_has_a_colour():
    ways = [name_of(method) for precision in NAMED.values() for method in methods(precision)]
    draw({"contact": Frontier("t", "q", [Point(way, 0.1, 1.0, 10.0, 3.0) for way in ways], [])})
    assert any("order 24" in way for way in ways)


def test_the_command_chooses_runs_and_verifies(tmp_path):
    found = answer("trade", "--accuracy", "1e-8", "--time", "5", FIRST, "-o", tmp_path / "run.npz")
    assert found["estimate"] <= found["accuracy"] == 1e-8
    assert found["of"] == "contact"
    assert set(found["choice"]) == {"precision", "order", "steps", "time_step"}
    assert np.load(tmp_path / "run.npz")["contact"][-1].tolist() == found["final"]["contact"]
    same = answer("trade", "--accuracy", "1e-8", "--time", "5")
    np.testing.assert_allclose(same["final"]["contact"], found["final"]["contact"], atol=2e-8)


def test_a_run_that_is_there_is_answered_again_and_another_is_not_replaced(tmp_path):
    stored, other = ["-o", tmp_path / "run.zarr"], ["--time", "1"]
    found = answer("trade", *ASKED, *stored)
    assert answer("trade", *ASKED, *stored)["final"] == found["final"]
    assert "holds another scene (--time differs)" in refused("trade", *ASKED, *other, *stored)
    assert answer("trade", *ASKED, *other, *stored, "--fresh")["time"] == 1
    tiny = ["--time", "5e-324", "-o", tmp_path / "tiny.zarr"]
    assert "where float64 loses digits" in refused("trade", *ASKED, *tiny)


def test_the_end_is_told_in_the_axes_of_an_inertia_tensor(tmp_path):
    tensor = ["--inertia", "0.0301,0.001,-0.0004;0.001,0.0312,0.0007;-0.0004,0.0007,0.0318", "--mass", "7"]
    asked = ["--accuracy", "1e-8", "--time", "1", *tensor, "--radius", "0.1", "-o", tmp_path / "a.npz", "--json"]
    found, data = json.loads(command("trade", *asked).stdout), np.load(tmp_path / "a.npz")
    np.testing.assert_allclose(found["final"]["angular_momentum"], data["momentum"][-1], rtol=1e-14)
    np.testing.assert_allclose(found["final"]["gamma"], data["gamma"][-1], rtol=1e-14)
    body = "[ball]\ninertia = [[2, 0.1, 0], [0.1, 3, 0], [0, 0, 4]]\nD = 1\n[start]\nomega = [1, 2, 3]\n"
    (tmp_path / "b.toml").write_text(f"{body}[run]\naccuracy = 1e-6\ntime = 1\n", encoding="utf-8")
    words = command("run", tmp_path / "b.toml", "-o", tmp_path / "b.npz", "--json").stdout
    found, data = json.loads(words), np.load(tmp_path / "b.npz")
    np.testing.assert_allclose(found["final"]["gamma"], data["gamma"][-1], rtol=1e-14)


def test_digits_that_no_float_holds_are_strings():
    found = answer("trade", "--accuracy", "1e-18", "--time", "2", "--of", "state")
    assert found["choice"]["precision"] == "quad"
    assert all(isinstance(x, str) and len(x) > 20 for x in found["final"]["gamma"])


def test_run_prints_the_choice_of_a_scene(tmp_path):
    scene = f"{BALL}accuracy = 1e-6\ntime = 3.0\ncontact = true\n"
    (tmp_path / "scene.toml").write_text(scene, encoding="utf-8")
    done = command("run", tmp_path / "scene.toml", "-o", tmp_path / "run.csv")
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith(f"2 frames in {tmp_path / 'run.csv'}\nchosen    double, ")
    assert "compared  the contact is off by " in done.stdout


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["nothing"], "there is no section 'nothing'"),
        (["--time", "3"], "--time goes with --accuracy"),
        (["--omega", "1,2,3"], "--omega goes with --accuracy"),
        (["--accuracy", "1e-6"], "--accuracy needs --time, in seconds"),
        ([*ASKED, "--accuracy", "-1"], "--accuracy must be a positive number, not -1"),
        ([*ASKED, "--accuracy", "nan"], "--accuracy must be a positive number, not nan"),
        ([*ASKED, "--accuracy", "1e-50"], "accuracy must be at least 1e-30"),
        ([*ASKED, "--time", "1e12", "--limit", "1"], "but the limit is 1 s"),
        ([*ASKED, FIRST, FIRST], "one scene at most"),
        ([*ASKED, FIRST, "--D", "3"], "leave out --D"),
        ([*ASKED, "--of", "all"], "--of must be 'state' or 'contact'"),
        ([*ASKED, "--omega", "1,2"], "--omega"),
        ([*ASKED, "-o", "run.txt"], "the output must end in"),
        ([*ASKED, "missing.toml"], "cannot be read"),
        ([*ASKED, "--time", "0"], "--time must be a positive number, not 0"),
        ([*ASKED, "--limit", "0"], "--limit must be a positive number, not 0"),
        ([*ASKED, "--omega", "1e400,1,1"], "--omega is beyond the range of float64"),
        ([*ASKED, "--omega", "1e-400,1,1"], "--omega is below 2.2e-308"),
        ([*ASKED, "--inertia", "1e308,1e308,1e308", "--D", "1", "--of", "state"], "beyond"),
        ([*ASKED, "--omega", "1e-5000,1,1"], "--omega is below 2.2e-308"),
        ([*ASKED, "--inertia", "1,1,1", "--D", "1e-5000"], "--D is below 2.2e-308"),
        ([*ASKED, "--json", "-o", "-"], "--json prints on standard output, where -o - writes the result: choose one"),
        ([*ASKED, "--omega", "1e160,1,1"], "it takes too many steps"),
        (["contact", "-o", "figure.txt"], "a figure must end in"),
        (["requests", "-o", "figure.svg"], "have a figure"),
        (["contact", "-o", "/nowhere/figure.svg"], "does not exist"),
    ],
)
def test_bad_input_gets_one_sentence(arguments, sentence):
    words = refused("trade", *arguments)
    assert sentence in words
    assert "run." not in words


def test_an_estimate_is_told_as_one_with_the_digits_it_is_about(capsys):
    final = {"angular_momentum": [0.06395078874125487, 20.0], "contact": ["-249.56257074582925", 0.1]}
    answer = SimpleNamespace(
        request=SimpleNamespace(of="contact", accuracy=1e-8), choice=SimpleNamespace(sentence=str, seconds=1.0),
        estimate=4.0e-9, attempts=[SimpleNamespace(seconds=1.0)], seconds=1.0, final=lambda: final,
    )  # fmt: skip
    print_answer(answer, SimpleNamespace(axes=None, place=None))
    words = capsys.readouterr().out
    assert "at most" not in words
    assert "off by 4.0e-09 (m), estimated" in words
    assert words.endswith("angular_momentum 0.0639508  20  (not compared)\ncontact   -249.562570746  0.100000000\n")
