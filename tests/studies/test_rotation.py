"""The study of the rotation number: two routes, the closed forms, the plateaus and their law, and the controls."""

import json
from fractions import Fraction
from inspect import signature
from math import gcd
from pkgutil import resolve_name

import numpy as np
import pytest
from flint import arb, ctx

import chapsym
from chapsym.dynamics import BadInput
from chapsym.dynamics.closed.elliptic import Curve, increment
from chapsym.dynamics.closed.vertical import step_vertical
from chapsym.studies import checkout
from research import rotation
from research.rotation import measured, staircase
from research.rotation.circle import Level, Relation, number
from research.rotation.plan import fractions, units

BALL = ((1, 2, 4), 1, "12/5")
LAMINA = ((0, 1, 3), "1/2", "7/10")
#: Around either axis, any order of the moments, in and beyond small-branch's bound, light and heavy.
LEVELS = [
    (*BALL, "243/1000"), (*BALL, "3/20"), ((4, 1, 2), 1, "12/5", "4/25"), ((2, 4, 1), 7, "12/5", "48/500"),
    ((0, 1, 10), "1/2", "3/2", "1/5"), ((1, 2, 4), 0, "12/5", "27/100"), ((3, 1, 2), 50, "3", "187/10000"),
]  # fmt: skip


#: The study in the documentation.
PUBLISHED = json.loads((checkout.ROOT / "docs/open/rotation.json").read_text("utf-8"))


@pytest.fixture
def sixty():
    with ctx.workdps(60):
        yield 10.0**-57  # a thousand roundings of numbers of order 1


@pytest.mark.parametrize("case", LEVELS)
def test_the_sphere_and_the_relation_are_displaced_alike_and_the_chord_form_holds(case, sixty):
    level = Level(*case)
    for phase in ("0", "2/3", "-7/5", "5"):
        moved = level.displacement(phase, 5, 0)
        assert moved > 0
        assert abs(moved - Relation(level).displacement(phase, 5, 0)) < sixty
    relation, phase = Relation(level), number("3/7")
    u, after = level.argument(phase), level.argument(level.lift(phase, 1))
    assert abs(relation.chord(u, after)) < sixty * abs(relation.momentum((after - u) / 3))
    assert abs(relation.chord(u, after + arb("1e-20"))) > arb("1e-25")  # and for another step it does not hold


@pytest.mark.parametrize("case", LEVELS)
def test_the_step_is_that_of_the_package(case):
    with ctx.workdps(30):
        level = Level(*case)
        gamma = level.point(number("4/5"))
        after = [float(x) for x in level.step(gamma)]
        ball = chapsym.Ball([float(x) for x in case[0]], float(Fraction(case[1])))
        g = [float(x) for x in gamma]
        expected = step_vertical(ball, float(level.h), g)
        np.testing.assert_allclose(after, expected.gamma if hasattr(expected, "gamma") else expected, atol=4e-15)
        curve = Curve.through(ball, g)
        assert float(level.m) == pytest.approx(curve.modulus**2, rel=1e-13)
        size = abs(float(increment(curve, float(level.h), float(curve.argument(g)))))
        moved = level.argument(level.lift(number("4/5"), 1)) - level.argument(number("4/5"))
        assert float(moved) == pytest.approx(size, rel=1e-12)


def test_phases_and_arguments_are_inverse_from_turn_to_turn(sixty):
    level = Level(*BALL, "243/1000")
    for phase in (-9, -1, 0, 1, 2, 8):
        assert abs(level.amplitude(level.argument(number(phase))) - phase) < sixty
    assert abs(level.argument(arb.pi() * 3) - 3 * level.half) < sixty * 10
    assert abs(level.jacobi(level.K)[0] - 1) < sixty
    for off in ("0", "1e-59", "-1e-59", "1e-20", "1/3"):  # Arb's F is a NaN at some of these
        phase = 25 * arb.pi() / 2 + number(off)
        assert abs(level.argument(phase) - 25 * level.K) < abs(number(off)) * arb("1.02") + 100 * sixty


def test_averages_converge_to_the_exact_increment_of_the_top():
    found = measured.convergence([1, 2, 4], "0", "12/5", "6/25", [128, 512, 1024], 30)
    errors = [float(x) for x in found["errors"]]
    assert found["exact"]
    assert errors[0] > 1e3 * errors[1] > 1e6 * errors[2]
    assert errors[2] < 1e-15


def test_averages_agree_with_those_of_the_package_s_increments():
    steps = 400
    with ctx.workdps(20):
        level = Level(*BALL, "6/25")
        here = float(measured.mean(measured.angles(level, steps), steps))
        curve = Curve.through(chapsym.Ball((1, 2, 4), 1), [float(x) for x in level.point(arb(0))])
    t = np.arange(1, steps + 1) / (steps + 1)
    weights, u, moved = np.exp(-1 / (t * (1 - t))), 0.0, []
    for _ in range(steps):
        moved.append(float(increment(curve, 2.4, u)))
        u += moved[-1]
    assert here == pytest.approx(abs(weights @ moved) / weights.sum() / (curve.period / 2), abs=1e-9)


def test_a_row_says_where_the_branch_ends():
    found = measured.row([0, 1, 3], "1/2", "6/4", 3, 40, 20)
    assert found["height"] == "3/2"
    assert found["row"][-1] is None
    assert 0.05 < float(found["row"][0]) < 0.4


@pytest.mark.parametrize("steps", [8, 9])
def test_the_edges_of_a_plateau_are_those_of_every_orbit(steps):
    """Just beyond an edge all orbits go on one way; just inside they do not: the symmetric ones are the extremes."""
    found = measured.plateau(*LAMINA, steps, 1)
    with ctx.workdps(found["digits"]):
        for side in (-1, 1):
            for factor, ways in (("0.505", 1), ("0.495", 2)):
                l = number(found["level"]) + side * number(factor) * number(found["width"])
                level = Level(*LAMINA, l)
                moved = [level.displacement(arb.pi() * i / (8 * steps), steps, 1) for i in range(9)]
                assert len({x > 0 for x in moved}) == ways


def test_the_law_is_met_as_D_goes_to_0():
    off = []
    for power in (8, 10, 12):
        found = measured.plateau((0, 1, 3), Fraction(1, 2**power), "7/10", 8, 1)
        off.append(1 - found["ratio"])
    assert off[2] == pytest.approx(0.0013, abs=2e-4)
    assert off[0] / off[1] == pytest.approx(4, rel=0.03)
    assert off[1] / off[2] == pytest.approx(4, rel=0.01)


@pytest.mark.parametrize("D", ["0", "1/2", "2"])
def test_for_small_heights_the_increment_is_that_of_the_flow_of_lemma_almost_every(D, sixty):
    """hV/(1 - Dl) at first order, and A'' is h³l²V³/8; of Λ = (6, 5, 3)."""
    level = Level([x - Fraction(D) / 2 for x in (1, 2, 4)], D, "1e-9", "1/4")
    relation = Relation(level)
    rate = relation.V * level.h / (1 - level.D * level.l)
    for phase in map(number, ("0", "1", "5/2")):
        assert abs((level.argument(level.lift(phase, 1)) - level.argument(phase)) / rate - 1) < 1e-15
    a, e = relation.V * level.h / 2, arb("1e-17")  # where M is 0
    before, at, after = (relation.momentum(a + x) for x in (-e, arb(0), e))
    bend = -((after - 2 * at + before) / e**2) / ((after - before) / (2 * e)) ** 3
    assert abs(bend / (level.h**3 * level.l**2 * relation.V**3 / 8) - 1) < 1e-9


def test_the_width_in_the_height_is_that_in_the_level_by_the_slopes():
    before = ctx.prec
    found = measured.plateau(*LAMINA, 9, 1, in_height=True)
    assert ctx.prec == before
    with ctx.workdps(50):
        here = number(found["level"])
        e = arb("1e-12")
        of_l = Level(*LAMINA, here + e).displacement(0, 9, 1) / e
        of_h = Level(LAMINA[0], LAMINA[1], number("7/10") + e, here).displacement(0, 9, 1) / e
        ratio = number(found["width_in_height"]) / number(found["width"]) * of_h / of_l
    assert float(ratio) == pytest.approx(1, abs=1e-9)


def test_the_known_plateau_of_9_and_a_resonance_that_is_not_there():
    found = measured.measured(*BALL, 9, 1)
    assert found["level"].startswith("0.243000952906382635505326")
    assert [round(float(x) * 1e28, 3) for x in found["displacement"]] == [-1.403, 1.403]
    assert found["needed"] in (28, 29)
    assert not measured.seen(found, 16)
    with pytest.raises(BadInput, match="no level has the rotation number 1/3 half turns"):
        measured.plateau(*BALL, 3, 1)


def test_the_top_is_not_displaced_and_a_kicked_one_is():
    ball = measured.displacement(*BALL, 9, 1, 60, 32)
    top = measured.displacement((1, 2, 4), "0", "12/5", 9, 1, 60, 32)
    kicked = measured.displacement((1, 2, 4), "0", "12/5", 9, 1, 60, 32, kick="1/100")

    def largest(case):
        return max(abs(float(x)) for x in case["values"])

    assert largest(top) < 1e-58
    assert largest(ball) == pytest.approx(1.4035e-28, rel=1e-3)
    assert largest(kicked) > 1e-18
    assert abs(float(ball["cosines"][9])) == pytest.approx(1.403e-28, rel=1e-3)
    assert max(abs(float(x)) for x in ball["sines"]) < 1e-50  # even, but for the square of the displacement
    assert float(ball["routes"]) < 1e-57
    assert float(ball["chord"]) < 1e-55
    assert "routes" not in kicked


def test_a_spectrum_has_its_coefficients(sixty):
    n = 12
    values = [3 + 2 * (arb.pi() * 2 * i / n).cos() - (arb.pi() * 8 * i / n).sin() for i in range(n)]
    found = measured.spectrum(values)
    expected = {0: (3, 0), 1: (2, 0), 4: (0, -1)}
    for j, (c, s) in enumerate(found):
        assert abs(c - expected.get(j, (0, 0))[0]) < sixty
        assert abs(s - expected.get(j, (0, 0))[1]) < sixty


def test_float64_follows_arb_and_its_kick():
    with ctx.workdps(30):
        for kick in ("0", "9/20"):
            level = Level((0, 1, 3), 0, "19/20", "3/4", kick)
            here = staircase.Levels((0, 1, 3), 0, 0.95, 0.75, float(Fraction(kick))).angles(0.3, 8)[:, 0]
            gamma, there = level.point(number("3/10")), []
            for _ in range(8):
                after = level.step(gamma)
                there.append(float(level.turned(gamma, after)))
                gamma = after
            np.testing.assert_allclose(here, there, atol=2e-13)


def test_the_staircase_of_the_kicked_top_is_seen_and_that_of_the_top_is_not():
    args = [0, 1, 3], "0", "19/20"
    seen = staircase.plateaus(*args, "9/20", [0.02, 0.98], [[1, 5]])
    low, high = seen[0]["edges"]
    assert 0.01 < high - low < 0.02
    held = staircase.Levels([0, 1, 3], 0.0, 0.95, (low + high) / 2, 0.45).angles(0.3, 1205)[-5:]
    assert float(held.sum()) == pytest.approx(np.pi, abs=1e-14)  # the orbit is on the attracting one
    low, high = staircase.plateaus(*args, "0", [0.02, 0.98], [[1, 5]])[0]["edges"]
    assert high - low < 1e-12


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((*BALL, "1/2"), "is no circle"),
        (((1, 2, 4), 3, 1, "1/8"), "is the separatrix"),
        (((2, 2, 4), 1, 1, "3/20"), "two moments are equal"),
        (((1, 2, 4), 1, 6, "6/25"), "branch ends"),
    ],
)
def test_what_is_no_level_or_step_is_said(arguments, sentence):
    with ctx.workdps(30), pytest.raises(BadInput, match=sentence):
        Level(*arguments).displacement(0, 3, 0)


def exactly(x):
    return [Fraction(one) for one in x] if isinstance(x, list) else Fraction(x)


def test_every_unit_is_plain_data_and_those_of_the_full_study_are_published():
    quick, full = units(True), units(False)
    for name, section in full.items():
        assert 0 < len(quick[name]) <= len(section)
        for unit in section:
            assert json.loads(json.dumps(unit.arguments)) == unit.arguments
            signature(resolve_name(unit.function)).bind(**unit.arguments)
    for name in full.keys() - {"staircase", "times"}:
        for unit, made in zip(full[name], PUBLISHED[name], strict=True):
            for key in unit.arguments.keys() & made.keys() & {"tensor", "D", "height", "steps"}:
                assert exactly(unit.arguments[key]) == exactly(made[key])
    unmade = rotation.study(True, lambda planned: [unit.arguments for unit in planned])
    assert set(unmade) == set(PUBLISHED)
    assert set(unmade["staircase"]["top"]) >= {"plateaus"}


def test_the_published_staircase_has_the_ends_of_a_short_one():
    planned, published = units(False)["staircase"][0].arguments, PUBLISHED["staircase"]["ball"]
    found = staircase.curve(**planned | {"points": 2, "steps": 600})
    for name in ("levels", "rotation_numbers"):
        np.testing.assert_allclose(found[name], np.array(published[name])[[0, -1]], atol=1e-6)
    assert fractions(7, 0.2, 0.4) == [(1, 3), (1, 4), (2, 7)]


@pytest.mark.thorough  # of every figure of results it is seen in tests/report/test_figures.py
def test_the_figures_are_drawn_the_same_twice(tmp_path):
    for folder in (tmp_path / "one", tmp_path / "two"):
        folder.mkdir()
        checkout.save_figures("research.rotation", rotation.DRAWN, PUBLISHED, folder)
    assert {one.name for one in (tmp_path / "one").iterdir()} == set(rotation.CAPTIONS)
    for one in (tmp_path / "one").iterdir():
        assert one.read_bytes() == (tmp_path / "two" / one.name).read_bytes()


def test_the_sentences_say_what_locks():
    words = rotation.sentences(PUBLISHED)
    assert any("zero but for rounding" in x for x in words)
    assert any("D = 1, h = 12/5, 1/9 half turns, 60 digits: the displacement reaches 1.4e-28" in x for x in words)
    assert any("kicked by 1/100 sin 2φ: the displacement reaches 1.4e-17: it locks" in x for x in words)
    assert any("(resonance tongues at fixed h) measured: 247, each of positive width" in x for x in words)


@pytest.mark.parametrize("quick", [True, False])
def test_the_fractions_next_to_a_fifth_are_in_lowest_terms(quick):
    """Half turns in so many steps: each as near to 1/5 as any other fraction with its denominator."""
    planned = [(unit.arguments["turns"], unit.arguments["steps"]) for unit in units(quick)["fifth"]]
    assert {(1, 5), (1, 6), (2, 9), (3, 14)} <= set(planned)
    assert all(gcd(p, q) == 1 and abs(5 * p - q) <= 1 for p, q in planned)
