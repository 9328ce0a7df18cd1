"""The benchmark compares like with like, says what is missing, and can tell when it is wrong; no time is asserted."""

import itertools
import json
from functools import cache, partial

import numpy as np
import pytest
from budget import slow
from commands import answer, chapsym, refused

import benchmarks
from benchmarks import calls, command, continuous, dimensions, figure, goals, harness, memory, plans, problems, results
from benchmarks import long as long_runs
from benchmarks import trajectory as path
from benchmarks import work_precision as work
from chapsym import __version__
from chapsym.dynamics.levels import frames
from chapsym.studies import checkout

STATE = path.MOMENTUM, path.GAMMA


def without(monkeypatch, *packages):
    find = harness.find_spec
    monkeypatch.setattr(harness, "find_spec", lambda name: None if name in packages else find(name))


def result(name, **more):
    return benchmarks.Result(name, [{"name": "x", "value": 1.5}], **more)


def test_every_side_is_timed_once_a_round_and_another_begins_each():
    calls = []
    ticks = itertools.count().__next__
    sides = [harness.Contender(name, lambda name=name: calls.append(name), 10, ticks) for name in "abc"]
    timings = harness.interleaved(sides, 3)
    assert "".join(calls) == "abc" + "abc" + "bca" + "cab"
    assert {name: len(t.seconds) for name, t in timings.items()} == {"a": 3, "b": 3, "c": 3}


def test_a_time_is_that_of_the_clock_for_a_unit_of_work():
    ticks = iter([10.0, 16.0, 100.0, 100.0, 104.0])  # the second round needs two runs until the clock shows a time
    side = harness.Contender("a", lambda: None, 2, lambda: next(ticks))
    assert harness.interleaved([side], 2)["a"].seconds.tolist() == [3.0, 1.0]


def test_ratios_are_taken_round_by_round():
    """A machine that is ten times slower in one round changes no ratio."""
    a = harness.Timing("a", np.array([1.0, 10.0, 1.0, 1.0]))
    b = harness.Timing("b", np.array([2.0, 20.0, 2.0, 4.0]))
    assert b.median == 3.0
    assert b.ratio_to(a) == (2.0, 2.0, 2.5)


def test_one_core_is_one_core_and_is_given_back():
    before = frames.cores()
    with harness.cores(1):
        assert frames.cores() == 1
    assert frames.cores() == before


def test_a_ball_of_ones_own_is_measured(monkeypatch):
    seen = []
    monkeypatch.setattr(path, "measure", lambda quick, on_round, own: seen.append(own) or result("trajectory"))
    ball = "--mass-tensor", "1,2,4", "--D", "3"
    assert answer("bench", *ball, "--momentum", "1/10,-1/20,3/40")["sections"]["trajectory"]["rows"]
    J, D, K, g = seen[0]
    found = [[float(x) for x in v] for v in (J, K, g)]
    assert (found, D) == ([[1, 2, 4], [0.1, -0.05, 0.075], [2 / 7, 3 / 7, 6 / 7]], 3)
    assert refused("bench", *ball) == "--momentum K1,K2,K3 goes with a ball of your own"
    several = refused("bench", "batch", *ball, "--momentum", "1,0,0")
    assert several == "a ball of your own goes with the section trajectory alone"


@pytest.mark.parametrize(("part", "off", "by"), [(0, 2e-12, "2"), (1, 2e-12, "2"), (0, np.nan, "nan")])
def test_a_peer_that_is_a_little_wrong_or_ends_in_nan_is_seen(part, off, by):
    ends = [x.copy() for x in STATE]
    ends[part][0] += off
    sides = {path.CHAPSYM: lambda: STATE, "wrong": lambda: ends}
    with pytest.raises(benchmarks.NotComparable, match=f"wrong differs from chapsym by {by}"):
        path.agreement(sides, STATE[0], path.AGREEMENT)


@pytest.mark.parametrize("name", [path.LISTS, path.ARRAYS])
def test_a_peer_that_does_not_converge_says_so(name):
    """No rotation has such a momentum, so no iteration may settle."""
    peer, _ = path.SIDES[name]
    with pytest.raises((benchmarks.NotComparable, ValueError), match=r"converge|math domain"):
        peer(50 * path.MOMENTUM, path.GAMMA, path.MASS_TENSOR, path.D, 3)


def test_missing_packages_are_said(monkeypatch):
    without(monkeypatch, "scipy", "heyoka")
    found, missing = work.methods(quick=True)
    assert not [m.name for m in found if "SciPy" in m.name or "heyoka" in m.name]
    assert missing == {
        "SciPy DOP853, LSODA": "scipy is not installed (pip install 'chapsym[bench]')",
        "heyoka.py": "heyoka is not installed (pip install 'chapsym[bench]')",
    }


@pytest.fixture(scope="module")
def exact():
    """The continuous ball of the work-precision diagram after 2 s."""
    return continuous.reference(work.STATE, 2.0)


@pytest.mark.parametrize(
    ("peer", "control", "bound", "package"),
    [
        (continuous.dop853, 1e-10, 1e-8, "scipy"),
        (continuous.lsoda, 1e-10, 1e-8, "scipy"),
        (continuous.taylor, 1e-12, 1e-12, "heyoka"),
        (partial(continuous.taylor, kind="batch"), 1e-12, 1e-12, "heyoka"),
    ],
)
def test_the_integrators_solve_the_continuous_ball(peer, control, bound, package, exact):
    """Each within a hundred times what its control promises."""
    pytest.importorskip(package)
    assert abs(peer(work.STATE, 2.0, control) - exact).max() < bound


@pytest.mark.filterwarnings("ignore")
def test_an_integrator_that_gives_up_is_no_comparison():
    pytest.importorskip("scipy")
    with pytest.raises(benchmarks.NotComparable, match="LSODA fails at the tolerance 1e-16"):
        continuous.lsoda(work.STATE, 2.0, 1e-16)


def test_the_map_tends_to_the_continuous_ball_with_order_2(exact):
    coarse, fine = (abs(work.the_map(work.STATE, 2.0, n) - exact).max() for n in (200, 400))
    assert coarse / fine == pytest.approx(4, rel=0.02)


def test_the_reference_is_the_motion(exact):
    assert abs(work.extrapolated(work.STATE, 2.0, 20) - exact).max() < 1e-13


def test_the_time_to_an_error_is_read_off_a_straight_line():
    point = work.Point
    points = [point(n, n * 1e-6, n**-4.0, (0.0, 0.0, 0.0)) for n in (10, 100, 1000)]
    assert work.time_to(points, 1e-6) == pytest.approx(10**1.5 * 1e-6)
    assert work.time_to(points, 1.0) == points[0].seconds
    assert work.time_to(points, 1e-13) is None
    # A finer run that is faster is what one would take.
    assert work.time_to([*points[:2], point(0, 1e-6, 1e-20, (0.0, 0.0, 0.0))], 1e-3) == 1e-6


def test_steps_that_are_too_long_are_left_out():
    exact = np.zeros(6)
    method = work.Method("map", work.the_map, (3.0, 2500.0))
    (point,) = work.swept([method], exact, 1, lambda text: None)["map"]
    assert point.control == 2500.0
    assert point.error == pytest.approx(1, abs=0.1)  # the largest of K and γ themselves
    assert max(point.integrals[:2]) < 1e-15


def test_slopes_of_known_growths():
    n = np.arange(100_001)
    for power in (0.0, 0.5, 1.0):
        where, means = long_runs.octaves(1e-16 * n**power, 1)
        assert long_runs.slope(where, means) == pytest.approx(power, abs=1e-3)


def test_the_integrals_of_the_top_are_integrals():
    """⟨𝒦, J²𝒦⟩ is kept to roundings at D = 0, at a large ε too; ⟨𝒦, J𝒦⟩ is not, and it is not at D > 0."""
    K, g, J, _ = long_runs.balls(2)[1]
    momenta, verticals = long_runs.rolled(0.4 * K, g, J, 0.0, 1000, 10)
    assert abs(long_runs.integrals(momenta, verticals, J, 0.0)["energy, D = 0"]).max() < 1e-13
    assert abs(long_runs.integrals(momenta, verticals, np.sqrt(J), 0.0)["energy, D = 0"]).max() > 1e-4
    rolling = long_runs.rolled(0.4 * K, g, J, 0.5, 1000, 10)
    assert abs(long_runs.integrals(*rolling, J, 0.0)["energy, D = 0"]).max() > 1e-4


def test_steps_in_n_dimensions_that_differ_are_not_compared(monkeypatch):
    monkeypatch.setattr(dimensions, "continued", lambda n, steps, balls=1: dimensions.trajectory(n, steps + 1))
    with pytest.raises(benchmarks.NotComparable, match="n = 4: the trajectory differs"):
        dimensions.measure(True)


def test_a_trajectory_allocates_what_it_keeps():
    few = 101 * memory.BYTES_KEPT + memory.BESIDES
    assert memory.peak_of_a_trajectory(20_000, 200) <= few
    assert memory.peak_of_a_trajectory(20_000, 1) > few


def test_the_peak_of_a_batch_is_that_of_its_process():
    """A process that imports NumPy takes more than 10 MB; 10⁵ balls more cost them at least their 13 numbers each."""
    small, large = memory.peak_of_a_batch(100, 2), memory.peak_of_a_batch(100_100, 2)
    assert 10e6 < small < memory.GIGABYTE
    assert large - small > 1e5 * 13 * 8


def test_a_stepper_that_goes_elsewhere_is_seen(monkeypatch):
    run, off = calls.chapsym.trajectory, 1 + 1e-15
    monkeypatch.setattr(calls.chapsym, "trajectory", lambda ball, K, *rest, **more: run(ball, K * off, *rest, **more))
    differs = r"differs from chapsym\.trajectory after 10 steps, in the momentum"
    with pytest.raises(benchmarks.NotComparable, match=differs):
        calls.compare(10, True)


#: Processes, and seconds of references.
SLOW = {"goals", "work-precision"}


@pytest.mark.parametrize(
    "section", [pytest.param(one, marks=[pytest.mark.thorough] * (one in SLOW)) for one in benchmarks.SECTIONS]
)
def test_a_quick_look_runs_and_is_plain_data(section, monkeypatch):
    monkeypatch.setattr(long_runs, "QUICK", (2000, 2))
    monkeypatch.setattr(plans, "BATCH", 20)
    monkeypatch.setattr(results, "interleaved", lambda sides, rounds, *more: harness.interleaved(sides, 1, *more))
    said = []
    found = benchmarks.run(section, True, said.append)
    data = json.loads(json.dumps(command.plain({section: found}, True), allow_nan=False))
    assert set(data) == {"machine", "quick", "sections"}
    assert {"cpu", "cores", "compiler", "versions"} <= set(data["machine"])
    assert {"numpy", "heyoka"} <= set(data["machine"]["versions"])
    part = data["sections"][section]
    assert set(part) == {"title", "rows", "missing", "reach", "curves", "notes"}
    assert len({tuple(row) for row in part["rows"]}) == 1, "the rows of a table have the same columns"
    assert all(set(r) == {"what", "value", "wanted", "at_least", "met"} for r in part["reach"])
    assert part["reach"] or section == "goals" or "heyoka.py" in part["missing"]
    assert bool(part["curves"]) == (section in figure.AXES)
    assert said


@pytest.mark.parametrize("contact", [False, *slow(True)])
def test_every_way_of_the_goals_is_as_exact_as_it_is_asked_to_be(contact):
    problem = problems.drawn(1, 8)[0]
    truth = K, g, spots = problems.truth_of(problem)
    ends = problems.own_methods(problem, truth if contact else (K, g, None), 1e-7, contact)
    assert "extrapolate" in ends
    for name, run in ends.items():
        assert problem.error(run(), truth) <= 1e-7, name
    assert problem.error(problems.rolled(problem, 1e-7), truth) <= 1e-7
    assert problem.error((K, g, spots + 1e-3), truth) > 1e-3  # of the radius
    assert problem.error((K, np.nan * g, None), truth) == np.inf


def test_heyoka_follows_the_balls_of_the_goals(monkeypatch):
    """One and eight at once, to the truth by `extrapolate`, which is taken where heyoka.py is missing."""
    pytest.importorskip("heyoka")
    many = problems.drawn(2, 3, 5.0)
    ends = problems.taylor_batch(many, 1e-12)()
    exact = [problems.truth_of(problem) for problem in many]
    without(monkeypatch, "heyoka")
    for i, problem in enumerate(many):
        alone = problems.truth_of(problem)
        assert problem.error(exact[i], alone) < 1e-11
        assert problem.error([x[i] for x in ends], [x[-1] for x in alone]) < 1e-9
        assert problem.error(problems.loosest(problem, alone, 1e-8)(), alone) <= 1e-8


def test_a_program_that_fails_is_not_timed():
    with pytest.raises(RuntimeError, match=r"chapsym run fails: chapsym: .*absent"):
        goals.timed(("run", "absent.toml", "-o", "x.npz"))


def test_what_was_measured_before_a_section_fails_is_on_the_page(monkeypatch, tmp_path):
    def run(name, quick, on_round):
        if name == "batch":
            raise benchmarks.NotComparable("they differ")
        return result(name, reach=[benchmarks.Reached("x", 1.0, 2.0, False)])

    monkeypatch.setattr(benchmarks, "run", run)
    page = tmp_path / "bench.md"
    assert chapsym("bench", "calls", "batch", "-o", str(page)).returncode == 1
    assert "| calls | x | 1 | at most 2 | yes |" in page.read_text(encoding="utf-8")


def test_what_is_reached():
    for value, at_least, met in ((2.0, True, True), (1.9, True, False), (1.9, False, True), (2.1, False, False)):
        assert benchmarks.Reached("x", value, 2.0, at_least).met == met


def test_the_figure_has_a_panel_for_each_group_of_curves():
    pytest.importorskip("matplotlib")
    named = itertools.product("pq", ("chapsym", "other"))
    curves = [benchmarks.Curve(panel, label, [1.0, 10.0], [1e-3, 0.0]) for panel, label in named]
    drawn = figure.draw({"long": result("drifts", curves=curves), "memory": result("memory")})
    titles = [axis.get_title() for axis in drawn.get_axes() if axis.get_visible()]
    assert titles == ["p", "q"]


def test_a_wheel_has_no_benchmarks_and_no_research_and_says_so(monkeypatch, tmp_path):
    """As seen by the commands that run them; a folder beside the wheel that has the name is not taken for ours."""
    (tmp_path / "benchmarks").mkdir()
    monkeypatch.setattr(checkout, "ROOT", tmp_path)
    for folder, asked in (
        ("benchmarks", ["bench", "trajectory"]),
        ("benchmarks", ["trade", "contact", "--quick"]),
        ("research", ["extremes", "--quick"]),
        ("research", ["study", "chaos", "--quick"]),
    ):
        assert refused(*asked) == f"{folder}/ is not in the wheel; run this from a checkout"


def test_the_command_prints_json_or_a_table(monkeypatch):
    monkeypatch.setattr(benchmarks, "run", cache(benchmarks.run))  # measured once for both
    assert list(answer("bench", "trajectory", "--quick")["sections"]) == ["trajectory"]
    shown = chapsym("bench", "trajectory", "--quick").stdout
    assert path.ARRAYS in shown
    assert "wanted: at least 1e+03" in shown
    assert f"chapsym {__version__}" in shown
