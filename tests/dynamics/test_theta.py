"""The motion in theta functions: what they are, their bounds, and that they contain the motion found by other ways."""

import json
import random
import re
from fractions import Fraction as F
from itertools import product
from pathlib import Path

import pytest
from commands import chapsym as command
from contained import ORDINARY, random_case, started, worst
from first import FIRST
from flint import acb, acb_mat, arb, arb_mat, ctx

import chapsym
from chapsym import BadInput, ExactBall, certified_motion
from chapsym.derive import chaplygin
from chapsym.dynamics.enclosed_motion import PARTS, follow
from chapsym.dynamics.levels.proved_root import TooWide
from research.theta import curve, reduction
from research.theta.functions import Characteristic, Thetas
from research.theta.motion import General
from research.theta.top import Top

Y = ((1.3, 0.4), (0.4, 0.9))
EVERY = [Characteristic(a, b) for a in product((0, 1), repeat=2) for b in product((0, 1), repeat=2)]


@pytest.fixture(autouse=True)
def bits():
    with ctx.workprec(128):
        yield


def overlap(one, other):
    """Which parts of two certified motions do not."""
    pairs = {name: zip(getattr(one, name).flat, getattr(other, name).flat, strict=True) for name in PARTS}
    return [name for name, both in pairs.items() if not all(x.overlaps(y) for x, y in both)]


def matrix(rows):
    return arb_mat([[arb(x) for x in row] for row in rows])


def functions(left=None):
    """All sixteen functions of genus two along a line, and Arb's at a point of it; left: in the place of the bound."""
    start, direction = (arb("0.3"), arb("0.1")), (arb("0.7"), arb("-0.2"))
    thetas = Thetas(matrix(Y), start, direction, EVERY)
    thetas.left = thetas.left if left is None else arb(left)
    tau = acb_mat([[acb(0, x) for x in row] for row in Y])
    return thetas, lambda s: tau.theta(acb_mat([[x + acb(s) * u] for x, u in zip(start, direction, strict=True)]))


def test_the_functions_are_those_of_arb():
    thetas, true = functions()
    for s in (arb(0), arb("1.75"), arb("-31.4"), acb("0.2", "0.3"), acb("-7.3", "-0.9")):
        for c, x, y in zip(EVERY, thetas.at(s), true(s).entries(), strict=True):
            assert x.overlaps(y), (s, c)
            assert x.rad() < 1e-30


def test_the_functions_of_a_ball_contain_those_of_its_points():
    thetas, true = functions()
    found = thetas.at(acb(arb("0.1", "0.05"), arb("0.2", "0.05")))
    for k in range(12):
        point = acb("0.1", "0.2") + (acb(k) / 6).exp_pi_i() * acb("0.05")
        assert all(x.contains(y.mid()) for x, y in zip(found, true(point).entries(), strict=True))
    assert all(abs(x).abs_upper() < 4 for x in found)


def test_beyond_the_reach_there_is_no_value():
    thetas, _ = functions()
    assert not any(x.is_finite() for x in thetas.at(acb(arb(0), thetas.reach + arb("0.01"))))
    assert not any(x.is_finite() for x in thetas.at(acb(arb(0), arb(0, thetas.reach + arb("0.01")))))


def test_the_rates_of_change_are_those_of_the_values():
    thetas, true = functions()
    h = acb("1e-12")
    for c, x, y, z in zip(EVERY, thetas.change(0), true(h).entries(), true(-h).entries(), strict=True):
        assert abs(x - (y - z) / (2 * h)) < 1e-20, c


def test_what_the_sums_leave_out_is_bounded_and_kept():
    """On a lattice of few terms, at a low precision, the values contain those of a high one."""
    with ctx.workprec(20):
        thetas, _ = functions()
    _, true = functions()
    assert 1e-30 < thetas.left < 1e-4
    for s in (acb(0), acb(arb("0.3"), thetas.reach * arb("0.99"))):
        assert all(x.contains(y.mid()) for x, y in zip(thetas.at(s), true(s).entries(), strict=True))
    thetas, _ = functions(left="1e-3")
    assert all(x.real.rad() >= arb("0.9e-3") and x.imag.rad() >= arb("0.9e-3") for x in thetas.at(arb("0.4")))
    assert all(x.real.rad() >= arb("0.9e-3") / thetas.reach for x in thetas.change(0))


def test_a_period_matrix_that_is_not_positive_has_no_functions():
    with pytest.raises(TooWide):
        Thetas(matrix(((1, 2), (2, 1))), [arb(0)] * 2, [arb(1), arb(0)], EVERY[:1])


def test_the_characteristic_of_riemann_is_the_only_one():
    """It makes the half periods of infinity and of all branch points odd."""
    zero = Characteristic((0, 0), (0, 0))
    halves = [*product((0, 1), repeat=2)]

    def odd(c):
        return sum(x * y for x, y in zip(c.a, c.b, strict=True)) % 2 == 1

    every = (Characteristic(*pair) for pair in product(halves, repeat=2))
    found = [c for c in every if all(odd(c.plus(branch)) for branch in (zero, *curve.BRANCHES))]
    assert found == [curve.RIEMANN]
    assert zero.plus(*curve.BRANCHES) == zero


def test_the_roots_and_the_curve_are_those_of_the_lemma():
    """N(μ) = 0 in the form of `derive`, w² = φ(μ), and a symmetric positive period matrix."""
    J, D, K, gamma = (arb(1), arb(2), arb(4)), arb(3), (arb(1), arb(-2), arb(3)), (arb(2) / 7, arb(3) / 7, arb(6) / 7)
    found = reduction.reduced(J, D, K, gamma)
    symbols = [*chaplygin.p, chaplygin.L1, chaplygin.L2, chaplygin.L3, chaplygin.d, chaplygin.mu]
    from sympy import lambdify

    N, phi = (lambdify(symbols, x) for x in (chaplygin.quadratic(), chaplygin.product()))
    for mu, w in curve._roots(found):
        given = *found.p, *found.inertia, found.d, mu
        assert N(*given).contains(0)
        assert (phi(*given) * (mu - 1 / found.c) * (1 - found.d * mu) - w * w).contains(0)
    on = curve.curve(found)
    assert (on.Y[0, 1] - on.Y[1, 0]).contains(0)
    assert on.Y.det() > 0
    assert on.Y[0, 0] > 0
    assert 0 < found.d < D < found.c


def test_random_motions_are_contained(thorough):
    """Of three different moments; the other way is that of `motion_truth`."""
    rng, count = random.Random(31), 0
    while count < (300 if thorough else 4):
        case, times = random_case(rng), [F(rng.randint(1, 9), 7), F(2)]
        if len(set(case[0])) < 3 or not case[1] or not any(case[2]):
            continue
        found = follow(started(*case), times, 15, by="theta")
        assert found.stopped is None
        assert worst(found, case, times) < 1, case
        assert all(x.rad() <= arb("1e-15") for x in found.gamma.flat)
        count += 1


@pytest.mark.parametrize("kind", ["no contact term", "vertical, up", "vertical, down"])
def test_the_top_is_contained(kind, thorough):
    rng = random.Random(kind)
    for _ in range(60 if thorough else 2):
        (J, D, w, q), times = random_case(rng), [F(rng.randint(1, 9), 7), F(2)]
        if len(set(J)) < 3 or not any(w):
            continue
        rows = chapsym.generated.rotation(*(F(x) for x in q))
        up = [x / sum(y * y for y in map(F, q)) for x in rows[6:]]
        if kind == "no contact term":
            D = F(0)
        else:
            # Λω ∥ γ.
            size = F(rng.randint(1, 40), 20) * (1 if kind.endswith("up") else -1)
            w = [size * x * (sum(J) + D) / (sum(J) - j + D) for x, j in zip(up, J, strict=True)]
        K = [(sum(J) - j + D) * x for x, j in zip(w, J, strict=True)]
        lift = D * sum(x * y for x, y in zip(w, up, strict=True))
        K = [x - lift * y for x, y in zip(K, up, strict=True)]
        found = certified_motion(ExactBall(J, D, 1), K, up, times, 15, attitude=q, by="theta")
        assert worst(found, (J, D, w, q), times) < 1
        assert not overlap(found, certified_motion(ExactBall(J, D, 1), K, up, times, 15, attitude=q))


@pytest.mark.parametrize(
    ("J", "D", "K", "gamma", "time"),
    [
        pytest.param((1, 2, 4), 3, (0, 2, 1), (0, 0, 1), 3, id="p1 and q1 begin at 0"),
        pytest.param((4, 2, 1), 3, (1, 0, 2), (0, 0, 1), 3, id="p2 and q2 begin at 0", marks=pytest.mark.thorough),
        pytest.param((4, 2, 1), 3, (1, 2, 0), (0, 0, 1), 3, id="K normal to the vertical"),
        pytest.param(("1/50", "3/100", "9/200"), "1/100", (1, 2, 0), ("0.6", "0.8", 0), "0.1", id="at a right end"),
        pytest.param(("1/50", "3/100", "9/200"), "1/100", (4, 1, -3), ("0.6", 0, "0.8"), "0.1", id="at another"),
        pytest.param((1, 2, 4), 3, ("1e-9", "1e-9", 1), (0, 1, 0), 3, id="near an axis"),
        pytest.param((1, 2, 4), 0, ("1e-50", "2e-50", "3e-50"), (0, 1, 0), "1e50", id="a slow top"),
        pytest.param((1, 2, 4), 3, (1, "1e-6", 2), (0, 0, 1), 20, id="near a plane"),
        pytest.param((1, 2, 4), "1e-6", (1, 1, 2), (0, 0, 1), 20, id="small D"),
        pytest.param((1, 2, 4), "1e6", ("1e6", "1e6", 2), (0, 0, 1), "0.5", id="large D", marks=pytest.mark.thorough),
        pytest.param(("1e-9", 2, 4), 3, (1, 2, 3), (0, 0, 1), 3, id="a flat body"),
        pytest.param((1, 2, 4), 3, ("1e-9", 1, "-2e-9"), (0, "0.6", "0.8"), 20, id="near the separatrix"),
        pytest.param((1, 2, 4), 3, ("1e-9", "0.6", "0.8"), (0, "0.6", "0.8"), 5, id="K nearly vertical"),
    ],
)  # fmt: skip
def test_at_the_edges_the_two_ways_agree(J, D, K, gamma, time):
    both = [
        certified_motion(ExactBall(J, D, "1/10"), K, gamma, [F(time) / 3, time], by=by) for by in ("taylor", "theta")
    ]
    assert both[1].stopped is None
    assert not overlap(*both)


@pytest.mark.parametrize(
    ("J", "D", "K", "gamma"),
    [
        pytest.param((2, 2, 4), 3, (1, 2, 3), (0, 0, 1), id="two equal moments"),
        pytest.param((1, 2, 4), 3, (0, 0, 1), (0, 0, 1), id="steady"),
        pytest.param((1, 2, 4), 3, (0, 2, 0), (0, 0, 1), id="rolling about an axis"),
        pytest.param((1, 2, 4), 3, (0, 0, 0), (0, 0, 1), id="at rest"),
        pytest.param((1, 2, 4), 0, (0, 0, 2), (0, 1, 0), id="a steady top"),
    ],
)
def test_what_has_no_such_solution_is_refused(J, D, K, gamma):
    with pytest.raises(BadInput, match="three different moments"):
        certified_motion(ExactBall(J, D), K, gamma, [1], by="theta")


def test_routes_and_rotors_that_are_not_there_are_refused():
    ball = ExactBall((1, 2, 4), 3)
    with pytest.raises(BadInput, match='by must be "taylor" or "theta", not \'euler\''):
        certified_motion(ball, (1, 2, 3), (0, 0, 1), [1], by="euler")
    with pytest.raises(BadInput, match="without a rotor"):
        certified_motion(ball, (1, 2, 3), (0, 0, 1), [1], rotor=(0, 0, 1), by="theta")


def test_without_a_checkout_they_are_refused_in_one_sentence(monkeypatch):
    monkeypatch.setattr("chapsym.dynamics.enclosed_motion.RESEARCH", Path("nowhere"))
    with pytest.raises(BadInput, match="research/, which is not in the wheel"):
        certified_motion(ExactBall((1, 2, 4), 3), (1, 2, 3), (0, 0, 1), [1], by="theta")


def test_many_turns_and_many_digits():
    """The radii do not grow with a power of the motion's instability: 40 digits after 20 s, beside Taylor's steps."""
    start = started(*ORDINARY)
    both = [follow(start, [F(1, 3), F(20)], 40, by=by) for by in ("taylor", "theta")]
    assert not overlap(*both)
    assert both[1].gamma[1, 0].rad() < arb("1e-40")


def test_the_command_writes_it(tmp_path):
    scene = tmp_path / "scene.toml"
    first = Path(FIRST).read_text(encoding="utf-8")
    scene.write_text(re.sub(r"steps = \d+", "steps = 50\nframes = 2", first), encoding="utf-8")
    made = command("certify", "motion", scene, "--digits", "12", "--by", "theta", "--json")
    taylor = command("certify", "motion", scene, "--digits", "12", "--json")
    last, other = (json.loads(run.stdout)["frames"][-1] for run in (made, taylor))
    for name in PARTS:
        for (x, r), (y, s) in zip(last.get(name, ()), other.get(name, ()), strict=True):
            assert abs(F(x) - F(y)) <= F(r) + F(s)


def test_a_scene_says_whether_its_momentum_is_vertical(tmp_path):
    from chapsym.scene import load
    from chapsym.scene.members.exactly import exact_motion

    def is_vertical(start):
        scene = tmp_path / "scene.toml"
        scene.write_text(
            "[ball]\nmass = 1\nradius = 0.1\ninertia = [0.003, 0.004, 0.005]\n[start]\n" + start
            + "\n[run]\ntime = 1\ntime_step = 0.01\n"
        )  # fmt: skip
        return exact_motion(load(scene))[0].vertical

    assert is_vertical("omega = [0, 0, 2]")
    assert is_vertical('gamma = [0, 1, 0]\nomega = ["0 rad/s", "3 rpm", "0 rad/s"]')
    assert is_vertical("attitude = [0.8, 0.6, 0, 0]\nomega = [0, 0.0134400, 0.0042]") is False
    assert not is_vertical("omega = [0, 1, 2]")
    assert not is_vertical('omega = [0, 0, 2]\naxes = "space"')


def test_the_angle_of_a_top_is_the_integral_of_its_rate():
    """The lemma's quadrature, beside the closed form, for both axes and both ways round."""
    moments = (arb(1), arb(2), arb(4))
    for K in ((1, 2, 9), (1, 2, -9), (9, 2, 1), (-9, 2, -1)):
        found = Top(128, moments, arb(0), tuple(map(arb, K)), (arb(1), arb(0), arb(0), arb(0)), arb(1))
        m, s, _ = found.axes

        def rate(x, analytic, found=found, m=m, s=s):
            q, square, _ = found._functions(x)
            return (found.A[m] * q[m] * q[m] + found.A[s] * q[s] * q[s]) / square

        for end in (arb("0.7"), arb(9)):
            _, square, nu = found._functions(end)
            angle = acb.integral(rate, 0, acb(end)).real
            assert abs(nu - square.sqrt() * acb(0, angle).exp()) < 1e-25


def test_a_motion_of_lost_numbers_raises():
    """An integral that is not finite, as of numbers that are lost, is no piece."""
    for solved, K in ((General, (1, 2, 3)), (Top, (0, 2, 1))):
        found = solved(
            128, (arb(1), arb(2), arb(4)), arb(3 if solved is General else 0), tuple(map(arb, K)),
            (arb(1), arb(0), arb(0), arb(0)), arb(1),
        )  # fmt: skip
        found.rolling = lambda s: acb("nan")
        with pytest.raises(TooWide):
            found.advance(F(1))


def test_a_limit_ends_an_integral():
    """Within a piece, too: what was reached is kept."""
    found = certified_motion(ExactBall((1, 2, 4), 3, 1), (1, 2, 3), (0, 0, 1), [0, 400], 60, by="theta", limit=0.5)
    assert found.times == (0,)
    assert found.stopped.startswith("0.5 s were not enough")
