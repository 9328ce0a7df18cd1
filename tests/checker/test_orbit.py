"""Certificates of kind periodic-orbit."""

import random
from fractions import Fraction
from itertools import product

import certificate_maker as maker
import mpmath as mp
import pytest
from certificate_changes import at, changed, committed, leaves, refused, replaced, resealed

from chapsym import checker
from chapsym.checker import Rejected, check, orbit
from chapsym.checker.interval import Interval
from chapsym.checker.linear import newton
from chapsym.checker.orbit import Search, attracts


@pytest.fixture(scope="module")
def right():
    """Of parameters that are numbers; `certificates`, which finds them, shares nothing with the checker."""
    data = committed("periodic-orbit-simplest")
    return resealed({name: x for name, x in data.items() if name != "radius"})


def test_an_orbit_that_no_symmetry_maps_to_itself_is_accepted(right):
    verdict = check(right)
    assert verdict.statement == right["statement"] == checker.statement(right)
    assert verdict.numbers["determinant"].startswith("0.99999999818034796611867")
    assert verdict.numbers["unit_eigenvalue"].startswith("-0.0000000000730517457208396")


def test_numbers_that_are_changed_are_refused_by_mathematics_alone(right, thorough):
    """Half a second each: some of the Gibbs vectors and, but for `make thorough`, of what stands once."""
    rng = random.Random(23)
    paths = [path for path in leaves(right) if path[0] != "orbit"]
    some = paths if thorough else rng.sample(paths, 3)
    for path in [*some, *rng.sample([p for p in leaves(right) if p[0] == "orbit"], 1)]:
        data = resealed(replaced(right, path, changed(at(right, path), rng)))
        assert refused(data), (path, at(data, path))


def test_a_trace_is_proved_and_an_orbit_with_a_multiplier_outside_does_not_attract(right):
    """The trace to all digits is what the checker itself encloses."""
    search = Search(right)
    trace = sum(search.return_map(newton(search.residual, search.jacobian, search.centre))[0][i][i] for i in range(3))
    with mp.workdps(80):
        text = maker.rounded(mp.mpf(trace.lo) / mp.mpf(2) ** trace.bits, right["digits"])
    with pytest.raises(Rejected, match="inside the unit circle"):
        check(resealed(right | {"trace": text}))
    with pytest.raises(Rejected, match="trace is not proved"):
        check(resealed(right | {"trace": text[:-1] + str((int(text[-1]) + 1) % 10)}))


def test_a_determinant_of_1_proves_nothing(right, monkeypatch):
    monkeypatch.setattr(orbit, "determinant", lambda M: 1 + 0 * M[0][0])
    one = f"1.{right['digits'] * '0'}"
    with pytest.raises(Rejected, match="the determinant is not proved to differ from 1"):
        check(resealed(right | {"determinant": one, "unit_eigenvalue": one}))


@pytest.mark.parametrize("pair", [False, True])
def test_jurys_criterion_is_that_of_the_eigenvalues(pair):
    """Three real eigenvalues n/8, or one and a pair (n ± i n')/8: next to the circle on both sides, and far from it."""
    eighths = [Fraction(n, 8) for n in (-12, -9, -8, -7, -4, 0, 4, 7, 8, 9, 12)]
    for a, b, c in product(eighths, repeat=3):
        total, both = (2 * b, b * b + c * c) if pair else (b + c, b * c)
        inside = abs(a) < 1 and (both < 1 if pair else max(abs(b), abs(c)) < 1)
        det, trace, chi = a * both, a + total, (1 - a) * (1 - total + both)
        assert attracts(*(Interval.enclosing(x, x, 40) for x in (det, chi, trace))) == inside, (a, b, c)


def test_the_derivative_is_that_of_the_equations_and_the_root_of_a_step_is_the_only_one(right):
    """Central differences of h = 2^-100: an error of h² times third derivatives, below 2^20 here."""
    search = Search(right)
    h = 1 << (search.size.bits - 100)
    exact = search.jacobian(search.centre)
    for j in range(6):
        there, back = (
            search.residual([Interval(x.lo + s * h * (i == j), x.lo + s * h * (i == j), x.bits)
                             for i, x in enumerate(search.centre)])
            for s in (1, -1)
        )  # fmt: skip
        for row, a, b in zip(exact, there, back, strict=True):
            difference = mp.mpf(a.lo - b.lo) / (2 * h)
            assert abs(difference - mp.mpf(row[j].lo) / mp.mpf(2) ** row[j].bits) < mp.mpf(2) ** -150
    # The root of a step is proved to be alone for |γ| = 1, |𝒦| = 2.78; for |γ| = 1.05 or |𝒦| = 2.82 it may not be.
    momentum, gamma = search.centre[:3], search.centre[3:]
    search.check_branch([*(x * 203 / 200 for x in momentum), *gamma])
    for longer in ([*momentum, *(x * 21 / 20 for x in gamma)], [*(x * 103 / 100 for x in momentum), *gamma]):
        with pytest.raises(Rejected, match="small branch"):
            search.after(longer, [])


def test_a_box_of_parameters_is_that_of_the_file_and_is_proved(right):
    wide = resealed(right | {"radius": "1e-90"})
    assert "every number within 1e-90," in check(wide).statement
    search = Search(wide | {"radius": "1e-9"})
    for box, x, off in zip(
        (search.size, search.height, search.ball.D, *search.ball.inertia),
        map(Fraction, (*right["integrals"].values(), "2", "6", "5", "3")), (1, 1, 1, 2, 2, 2), strict=True,
    ):  # fmt: skip
        assert not box.within(x, Fraction(999 * off, 10**12))
        assert box.within(x, Fraction(1001 * off, 10**12))
    for radius, sentence in (
        ("1e-9", "."),
        ("1e-40", "."),
        ("-1e-90", "must not be negative"),
        ("2", "."),
        (1, "quotes"),
    ):
        with pytest.raises(Rejected, match=sentence):
            check(resealed(right | {"radius": radius}))


@pytest.mark.parametrize("J", [("1", "2", "4"), ("2", "2", "4")])
def test_a_point_that_is_parallel_to_its_momentum_or_does_not_come_back_is_refused(right, J):
    ball = {"J": list(J), "D": "2"}
    assert refused(resealed(right | {"ball": ball, "start": right["start"] | {"gamma": right["start"]["momentum"]}}))
    with pytest.raises(Rejected):
        check(resealed(right | {"steps": 19, "orbit": right["orbit"][:19]}))
