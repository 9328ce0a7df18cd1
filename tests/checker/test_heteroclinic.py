"""Certificates of kind heteroclinic: a right one is accepted, a changed or a false one is not."""

import math
import random
from fractions import Fraction

import certificate_maker as maker
import mpmath as mp
import pytest
from certificate_changes import at, changed, committed, leaves, refused, replaced, resealed

from chapsym import checker
from chapsym.checker import Rejected, check
from chapsym.checker.heteroclinic import Separatrix
from chapsym.checker.interval import Interval


@pytest.fixture(scope="module")
def right():
    return committed("heteroclinic-light")


@pytest.fixture(scope="module")
def separatrix(right):
    return Separatrix.of(right)


def test_a_right_certificate_is_accepted_and_says_what_it_proves(right):
    verdict = check(right)
    assert verdict.statement == right["statement"] == checker.statement(right)
    assert verdict.numbers == {"exp Δ": " and ".join(one["end"] for one in right["orbits"])}


def by_steps_of_the_ball(x, n):
    """u_n - u_0 - nc by steps on the sphere from the arc between ±e2, in mpmath; c from the increments at its end."""
    J, D, h = [mp.mpf(v) for v in (1, 4, 8)], mp.mpf(1) / 2, mp.mpf(22) / 5
    inverse = [1 / (sum(J) - v + D) for v in J]
    share = (inverse[1] - inverse[2]) / (inverse[0] - inverse[2])  # C1²
    g = (x - 1) / (x + 1)
    gamma = mp.matrix([mp.sqrt(share * (1 - g**2)), g, -mp.sqrt((1 - share) * (1 - g**2))])
    ups = [mp.atanh(g)]
    for _ in range(n):
        gamma = maker.turned(maker.gibbs(J, D, h * gamma, gamma), gamma)
        ups.append(mp.atanh(gamma[1]))
    return ups


def test_the_ends_are_those_of_the_steps_of_the_ball(separatrix, thorough):
    """The relation is that of the three-dimensional map: both half orbits from two points, after 45 steps."""
    with mp.workdps(120):
        c = by_steps_of_the_ball(mp.mpf(10) ** 30, 1)
        c = c[1] - c[0]
        for x in (mp.mpf(1), mp.mpf(3) / 2) if thorough else (mp.mpf(3) / 2,):
            ends = [by_steps_of_the_ball(v, 45) for v in (x, 1 / x)]
            found = mp.exp(sum(ups[-1] - ups[0] - 45 * c for ups in ends))
            product = 1 + 0 * separatrix.D
            for v in (x, 1 / x):
                exact = Fraction(3, 2) if v > 1 else Fraction(1) if v == 1 else Fraction(2, 3)
                product = product * separatrix.half_orbit(Interval.enclosing(exact, exact, product.bits), 45)
            assert 1e-12 < float(Fraction(product.width, 2**product.bits)) < 1e-10  # what is left after 45 steps
            assert product.lo <= found * 2**product.bits <= product.hi


def test_the_bound_of_the_rest_is_above_it_and_near(separatrix):
    """From 10 steps on the whole bound is no more than five times what is cut off."""
    one = Interval.enclosing(Fraction(1), Fraction(1), separatrix.D.bits)
    long = separatrix.half_orbit(one, 140)
    for steps in (0, 1, 10, 20, 60):
        short = separatrix.half_orbit(one, steps)
        assert short.lo <= long.lo
        assert long.hi <= short.hi
        assert 5 * (short.hi - long.hi) > short.hi - short.lo or steps < 10


def test_the_bound_of_the_rest_is_that_of_the_proof(separatrix):
    """Its effect has room, so no orbit shows a bound that is half of it: the formula once more, in floats."""
    D, h, I2, kappa = 0.5, 4.4, 9.0, math.sqrt(3 * 4 / (12.5 * 5.5))
    last = (I2 + math.sqrt(I2**2 - h**2)) / (h * kappa)
    slope = 2 * h * kappa * last - 2 * I2
    for x in (1.0, 8.0, 64.0):
        farthest = last + 2 * D / (slope * x)
        shrinks = ((farthest - 1) / (farthest + 1)) ** 2
        expected = 4 * D / (slope * (last**2 - 1) * x * (1 - shrinks))
        found = separatrix.rest(Interval.enclosing(Fraction(x), Fraction(x), separatrix.D.bits))
        assert found.hi / 2**found.bits == pytest.approx(expected, rel=1e-12)


def test_each_number_that_is_changed_is_refused_by_mathematics_alone(right, thorough):
    """All but the steps, more of which prove the same, and a smaller radius."""
    rng = random.Random(9)
    for path in [path for path in leaves(right) if path[-1] not in ("steps", "radius")]:
        for _ in range(3 if thorough else 1):
            assert refused(resealed(replaced(right, path, changed(at(right, path), rng)))), path


@pytest.mark.parametrize(
    ("path", "value", "sentence"),
    [
        (("ball", "J"), ["4", "1", "8"], "I1 > I2 > I3"),
        (("ball", "J"), ["1", "8", "4"], "I1 > I2 > I3"),
        (("ball", "height"), "-22/5", "must be positive"),
        (("ball", "height"), "49/10", "beyond the bound"),
        (("ball", "D"), "0", "D and the moments"),
        (("radius",), "1e-20", "beyond X₀"),
        (("radius",), "-1e-40", "must not be negative"),
        (("radius",), "2", "mass tensor"),
        (("orbits", 0, "steps"), 60, "end is not proved"),
        (("orbits", 0, "steps"), 10_001, "from 1 to 10000"),
        (("orbits", 0, "start"), "-1", "must be positive"),
        (("orbits", 0, "start"), "0", "must be positive"),
        (("orbits", 1, "end"), "0.998468790274232262099160", "end is not proved"),
        (("orbits",), [], "list of 2"),
        (("ball", "D"), "1e-900", "more work than a reader"),
        (("ball", "D"), "-0/5", "must be a number in quotes"),
    ],
)  # fmt: skip
def test_each_hypothesis_is_proved_from_the_numbers(right, path, value, sentence):
    with pytest.raises(Rejected, match=sentence):
        check(resealed(replaced(right, path, value)))


def test_one_orbit_twice_and_mirrored_orbits_are_refused(right):
    first, other = right["orbits"]
    mirrored = other | {"start": "200/249"}
    for pair in ([first, first], [other, mirrored]):
        with pytest.raises(Rejected, match="not proved to be different"):
            check(resealed(right | {"orbits": pair}))
