"""Certificates of kind energy-drift: the formulas, the enclosures, what is accepted and what is refused."""

from fractions import Fraction

import certificate_maker as maker
import numpy as np
import pytest
from certificate_changes import replaced, resealed
from modified_floats import Modified

from chapsym.checker import Rejected, check, drift, rolling, statement
from chapsym.checker.interval import Interval
from chapsym.checker.taylor import Model, derivatives

BITS = 128
J, D = [Fraction(1), Fraction(2), Fraction(4)], Fraction(1)
INERTIA = [sum(J) - x for x in J]
START = [Fraction(x) for x in ("1", "2", "17/5", "3/7", "6/7", "2/7")]
MODIFIED = Modified(J, D)


@pytest.fixture(scope="module")
def right():
    """What `chapsym certify energy-drift --digits 12` finds, to be checked with fewer bits and terms."""
    return maker.sealed({
        "format": "chapsym-certificate/1", "kind": "energy-drift",
        "statement": "The continuous ball with J = (1, 2, 4), D = 1 has a closed orbit through gamma = (3/7, 6/7, "
        "2/7), K = (1, 2, 3.424540368064), K3 up to 0.000000000003, of the period 2T; the integrals over [0, T] of "
        "X3(H) and of the divergence of X3 are not 0.",
        "ball": {"J": ["1", "2", "4"], "D": "1"},
        "start": {"momentum": ["1", "2", "3.424540368064"], "gamma": ["3/7", "6/7", "2/7"]},
        "varied": "K3", "radius": "0.000000000003", "symmetry": [-1, -1, 1], "periods": 2, "time": "8.547834755768",
        "window": "1e-4", "section": "gamma1", "along": "K1", "bits": 128, "order": 48,
        "misses": [["-0.000000000001156808313", "0.000000000000000000529"],
                   ["0.000000000001441897561", "0.00000000000000000053"]],
        "energy": ["0.0008902", "0.0000463"], "density": ["0.00144", "0.0014"],
    })  # fmt: skip


@pytest.fixture(scope="module")
def ball():
    return drift.Modified.of(INERTIA, D, lambda x: Interval.about(x, BITS))


@pytest.fixture
def flow():
    """Of so many terms."""
    fine = rolling.Rolling.of(INERTIA, D, lambda x: Model.constant(x, BITS))
    boxes = rolling.Rolling.of(INERTIA, D, lambda x: Interval.about(x, rolling.BITS))
    return lambda order: rolling.Flow(fine, boxes, [Fraction(3)] * 3 + [Fraction(1)] * 3, order)


def enclosed(state):
    return [Interval.about(x, BITS) for x in state]


def middle(x):
    return (x.lo + x.hi) / 2 ** (x.bits + 1)


def test_the_formulas_are_those_of_the_definitions(ball):
    K, g = np.array(START[:3], float), np.array(START[3:], float)
    w, turns = MODIFIED.solved(K, g), 12 * MODIFIED.correction(K, g)  # 12ω₃ of the certificate's definition
    np.testing.assert_allclose([middle(x) for x in ball.spin(enclosed(START))], w, rtol=1e-13)
    np.testing.assert_allclose([middle(x) for x in ball.turning(enclosed(START))], turns, rtol=1e-12)
    assert middle(ball.energy(enclosed(START))) == pytest.approx(w @ K, rel=1e-13)
    energy, density = (middle(x) / 12 for x in ball.densities(enclosed(START)))
    assert energy == pytest.approx(MODIFIED.densities(K, g)[0], rel=1e-12)
    assert density == pytest.approx(MODIFIED.densities(K, g)[1], rel=1e-6)  # the second order, the corner of |γ|


def test_the_integrals_are_kept_for_every_length_of_gamma(ball):
    """The derivative of 2H along the flow is 0, also off the sphere."""
    for scale in (1, Fraction(3, 2)):
        state = enclosed([*START[:3], *(scale * x for x in START[3:])])
        (found,) = derivatives(lambda x: [ball.energy(x)], state, [ball.field(state)])
        (rate,) = found.slopes
        assert rate.lo <= 0 <= rate.hi
        assert rate.width < 2 ** (BITS - 100)


def run(flow, start, error, end):
    """The state at a time, in intervals; from all starts within the error."""
    now, end = 0, int(end * 2**BITS)
    start = [int(x * 2**BITS) for x in start]
    while now < end:
        models, length, error = flow.step(start, error, end - now)
        start, now = [sum(x.terms) for x in models], now + length
    return [x.at(Interval(1 << BITS, 1 << BITS, BITS)) for x in models]


def test_what_the_series_leaves_out_is_enclosed(flow, monkeypatch):
    """Few terms against many; and with the bound of the defect taken away they are not the same."""
    exact, end = Fraction(1, 2**BITS), Fraction(2)
    truth = run(flow(48), START, exact, end)
    coarse = run(flow(14), START, exact, end)
    assert all(x.lo <= y.lo and y.hi <= x.hi for x, y in zip(coarse, truth, strict=True))
    assert max(x.width for x in truth) < 2 ** (BITS - 70)
    monkeypatch.setattr(rolling.Flow, "defect", lambda self, *rest: Fraction(0))
    assert not all(x.lo <= y.hi and y.lo <= x.hi for x, y in zip(run(flow(14), START, exact, end), truth, strict=True))


def test_all_starts_that_are_near_enough_are_enclosed(flow):
    """As far off as they may be, in each component: the flow takes some further off than they were."""
    radius, end = Fraction(1, 10**9), Fraction(2)
    weights, truth = flow(8).weights, run(flow(24), START, Fraction(0), end)
    whole, grown = run(flow(24), START, radius, end), 0.0
    for j, weight in enumerate(weights):
        moved = [x + radius * weight * (i == j) for i, x in enumerate(START)]
        point = run(flow(24), moved, Fraction(0), end)
        assert all(x.lo < y.lo and y.hi < x.hi for x, y in zip(whole, point, strict=True))
        off = [(y.lo - x.lo) / 2**BITS / float(w * radius) for x, y, w in zip(truth, point, weights, strict=True)]
        grown = max(grown, *map(abs, off))
    assert grown > 1


def test_the_norm_bounds_the_growth_of_what_is_near(flow):
    """Against the eigenvalues of the symmetric part of the derivative, by differences in floats."""
    one, h = flow(8), 1e-6
    box = [Interval.about(x, rolling.BITS) for x in START]
    weights = np.array(one.weights, float)

    def field(x):
        w = MODIFIED.solved(x[:3], x[3:] / np.linalg.norm(x[3:]))
        return np.array([*np.cross(x[:3], w), *np.cross(x[3:], w)])

    start = np.array(START, float)
    slope = np.array([(field(start + h * e) - field(start - h * e)) / (2 * h) for e in np.eye(6)]).T
    slope = slope * weights / weights[:, None]
    symmetric = (slope + slope.T) / 2
    rows = np.abs(symmetric).sum(axis=1) - np.abs(np.diag(symmetric)) + np.diag(symmetric)
    assert float(one.norm(box)) == pytest.approx(rows.max(), rel=1e-7)
    assert np.linalg.eigvalsh(symmetric).max() <= rows.max() + 1e-9


def test_starts_too_far_apart_and_more_steps_than_a_reader_can_wait_for_are_refused(flow, right, monkeypatch):
    with pytest.raises(Rejected, match="too far apart"):
        run(flow(16), START, Fraction(1, 1000), Fraction(1))
    with monkeypatch.context() as less:
        less.setattr(rolling, "MOST_WORK", 10**6)
        with pytest.raises(Rejected, match="longer than a reader can wait for"):
            check(right)
    monkeypatch.setattr(rolling, "MOST_STEPS", 3)
    with pytest.raises(Rejected, match="more than 3 steps"):
        check(right)


@pytest.mark.parametrize(
    ("path", "value", "words"),
    [(("ball", "D"), "1.1", "window"),
     (("ball", "J", 1), "-2", "negative"), (("ball", "D"), "0", "positive"),
     (("start", "gamma", 0), "3/8", "unit vector"),
     (("start", "momentum", 2), "3.424540368074", "a miss"), (("symmetry",), [1, -1, -1], "section|window"),
     (("time",), "8.5", "window"), (("window",), "9", "shorter than the time"), (("window",), "1e-20", "window"),
     (("radius",), "0.000000000004", "a miss"), (("along",), "gamma1", "a miss"), (("section",), "K2", "a miss|window"),
     (("order",), 8, "too far apart")],
)  # fmt: skip
def test_what_is_changed_and_sealed_anew_is_refused_by_mathematics(right, path, value, words):
    with pytest.raises(Rejected, match=words):
        check(resealed(replaced(right, path, value)))


@pytest.fixture(scope="module")
def returns(right):
    """Those of the certificate."""
    orbit = drift.Orbit(right)
    return {ends: orbit.returned(*ends, integrals=ends[0] < ends[1]) for ends in ((-1, -1), (1, 1), (-1, 1))}


@pytest.fixture
def known(returns, monkeypatch):
    """The returns in the place of what is to be found, to be changed."""
    known = dict(returns)
    monkeypatch.setattr(drift.Orbit, "returned", lambda self, low, high, integrals: known[low, high])
    return known


def test_a_certificate_is_accepted_with_what_it_proves(right, known):
    verdict = check(right)
    assert verdict.statement == right["statement"] == statement(right)
    assert verdict.numbers["the integral of X3(H)"] == "0.0008902 up to 0.0000463"


def test_what_is_stated_must_contain_what_is_found(right, known):
    for path, value, words in (
        (("misses", 1, 0), "0.000000000001441898561", "a miss"), (("misses", 0, 1), "1e-30", "a miss"),
        (("energy", 0), "-0.0008902", r"X3\(H\) is not proved"), (("energy", 1), "1e-12", r"X3\(H\) is not proved"),
        (("density", 0), "0.00294", "divergence of X3 is not proved"), (("along",), "gamma1", "a miss"),
    ):  # fmt: skip
        with pytest.raises(Rejected, match=words):
            check(resealed(replaced(right, path, value)))


def test_what_is_found_must_prove_the_statement(right, known):
    """All that is stated is as wide as can be: then only what is found can refuse."""
    wide = resealed(right | {"misses": [["0", "9"]] * 2, "energy": ["1", "0.9999"], "density": ["1", "0.9999"]})
    assert check(wide)
    for name in ("energy", "density"):
        with pytest.raises(Rejected, match="may be 0"):
            check(resealed(wide | {name: ["0", "9"]}))
    start, found, (energy, density) = known[-1, 1]
    for integrals in ([energy.hull(0 * energy), density], [energy, density.hull(0 * density)]):
        known[-1, 1] = start, found, integrals
        with pytest.raises(Rejected, match=r"is not proved to be 1 up to 0\.9999"):
            check(wide)
    known[-1, 1] = start, [x.wider(1 << x.bits) for x in found], [energy, density]
    with pytest.raises(Rejected, match="tell states apart"):
        check(wide)
    known[1, 1] = known[-1, -1]
    with pytest.raises(Rejected, match="between the two ends"):
        check(wide)
