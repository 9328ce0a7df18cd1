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
from flint import acb, acb_mat, arb, arb_mat, arb_poly, ctx

import chapsym
from chapsym import BadInput, ExactBall, certified_motion
from chapsym.derive import chaplygin
from chapsym.dynamics.enclosed_motion import PARTS, follow
from chapsym.dynamics.levels.proved_root import TooWide
from chapsym.dynamics.theta import curve, general, jacobi, pieces, reduction
from chapsym.dynamics.theta.analytic import Analytic, Disc
from chapsym.dynamics.theta.functions import Characteristic, Thetas

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


def functions(terms=60):
    """All sixteen functions of genus two along a line."""
    line = [arb("0.3"), arb("0.1")], [arb("0.7"), arb("-0.2")]
    return line, Thetas(matrix(Y), *line, {(c.a, c.b): c for c in EVERY}, terms)


def test_the_functions_are_those_of_arb():
    (start, direction), thetas = functions()
    tau = acb_mat([[acb(0, x) for x in row] for row in Y])
    for s in (arb(0), arb("1.75"), arb("-31.4")):
        z = acb_mat([[acb(x + s * u)] for x, u in zip(start, direction, strict=True)])
        values = tau.theta(z)
        found = thetas.series(s)
        for i, c in enumerate(EVERY):
            assert (found[c.a, c.b][0] - values[0, i].real).contains(0), c
            assert found[c.a, c.b][0].rad() < 1e-30


def test_the_series_and_their_bounds_hold_off_the_real_line():
    """Arb's functions at complex points of the disc are within the bounds, and the series tell the values."""
    (start, direction), thetas = functions(24)
    tau = acb_mat([[acb(0, x) for x in row] for row in Y])
    disc = Disc(thetas.radius, 24)
    with_bounds, _ = thetas.on(disc, thetas.series(arb(0)))
    for k in range(12):
        s = (acb(k) / 6).exp_pi_i() * acb(thetas.radius)
        values = tau.theta(acb_mat([[acb(x) + s * u] for x, u in zip(start, direction, strict=True)]))
        for i, c in enumerate(EVERY):
            assert abs(values[0, i]) <= with_bounds[c.a, c.b].bound
    s = thetas.radius / 3
    values = tau.theta(acb_mat([[acb(x + s * u)] for x, u in zip(start, direction, strict=True)]))
    for i, c in enumerate(EVERY):
        told = with_bounds[c.a, c.b].at(s)
        assert told.contains(values[0, i].real.mid())
        assert told.rad() < 1e-6


def test_products_inverses_and_integrals_are_within_their_bounds():
    """exp on a disc: its square, its inverse and its integral, with few terms."""
    disc = Disc(arb(1), 16)
    one = Analytic(arb_poly([1 / arb(k + 1).gamma() for k in range(16)]), arb(1).exp(), disc)
    s = arb("0.5")
    for found, true in (
        (one * one, (2 * s).exp()), (one.inverse((-arb(1)).exp()), (-s).exp()),
        (one.on(Disc(arb("0.75"), 16)), s.exp()), (one - one * arb(2), -s.exp()),
    ):  # fmt: skip
        assert found.at(s).contains(true.mid())
        assert 0 < found.at(s).rad() < 0.02
    assert one.integral(s).contains((s.exp() - 1).mid())
    with pytest.raises(TooWide):
        one.at(arb(1))


def test_of_bounds_too_small_for_floats_the_largest_is_taken():
    with ctx.workprec(1200):
        _, thetas = functions(8)
        bounds = [lattice.left for lattice in thetas.lattices.values()]
        disc = Disc(thetas.radius, 8)
        found, _ = thetas.on(disc, dict.fromkeys(thetas.named, arb_poly([0])))
        assert all(float(x) == 0.0 for x in bounds)
        assert all(f.series[0].rad() >= x for f in found.values() for x in bounds)


def test_the_series_at_the_start_have_what_the_sums_leave_out():
    """So do the constants that are made of them."""
    _, thetas = functions(8)
    left = arb("1e-3")
    thetas.lattices = {a: lattice._replace(left=left) for a, lattice in thetas.lattices.items()}
    assert all(f[0].rad() >= left for f in thetas.start_series().values())


def test_a_period_matrix_that_is_not_positive_has_no_functions():
    with pytest.raises(TooWide):
        Thetas(matrix(((1, 2), (2, 1))), [arb(0)] * 2, [arb(1), arb(0)], {0: EVERY[0]}, 10)


def test_the_characteristic_of_riemann_is_the_only_one():
    found = curve.riemann()
    assert all(found.plus(branch).odd for branch in (curve.ZERO, *curve.BRANCHES))
    assert curve.ZERO.plus(*curve.BRANCHES) == curve.ZERO


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
        pytest.param((4, 2, 1), 3, (1, 0, 2), (0, 0, 1), 3, id="p2 and q2 begin at 0"),
        pytest.param((4, 2, 1), 3, (1, 2, 0), (0, 0, 1), 3, id="K normal to the vertical"),
        pytest.param(("1/50", "3/100", "9/200"), "1/100", (1, 2, 0), ("0.6", "0.8", 0), "0.1", id="at a right end"),
        pytest.param(("1/50", "3/100", "9/200"), "1/100", (4, 1, -3), ("0.6", 0, "0.8"), "0.1", id="at another"),
        pytest.param((1, 2, 4), 3, ("1e-9", "1e-9", 1), (0, 1, 0), 3, id="near an axis"),
        pytest.param((1, 2, 4), 0, ("1e-50", "2e-50", "3e-50"), (0, 1, 0), "1e50", id="a slow top"),
        pytest.param((1, 2, 4), 3, (1, "1e-6", 2), (0, 0, 1), 20, id="near a plane"),
        pytest.param((1, 2, 4), "1e-6", (1, 1, 2), (0, 0, 1), 20, id="small D"),
        pytest.param((1, 2, 4), "1e6", ("1e6", "1e6", 2), (0, 0, 1), "0.5", id="large D"),
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


def test_pieces_that_could_not_end_raise(monkeypatch):
    """A disc of radius 0, as of numbers that are lost, is no piece."""
    monkeypatch.setattr(pieces, "radius_of", lambda *_: arb(0))
    for solved, K in ((general.General, (1, 2, 3)), (jacobi.Top, (0, 2, 1))):
        with pytest.raises(TooWide):
            solved(128, (arb(1), arb(2), arb(4)), arb(3), tuple(map(arb, K)), (arb(1), arb(0), arb(0), arb(0)), None)
