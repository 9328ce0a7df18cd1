"""Motions in other numbers than float64: exact inputs, the reference in mpmath, and enclosures of each step."""

from decimal import Decimal
from fractions import Fraction

import mpmath
import numpy as np
import pytest
import sympy as sp
from budget import slow
from flint import arb, ctx, fmpq
from systems import ANYWHERE, FREE, a, example, k, runner, va, vx, vy, vz, x, y, z

from chapsym import Digits, Enclosure
from chapsym.mechanics import BadSystem, NotSolved, Runner, System, moved
from chapsym.mechanics.motion import Sets

#: Of 1 + |x|, as large as the last bit of float64 counts: what 40 steps in float64 were measured to be off, doubled.
ULPS = 13


def particle(**changes):
    """Of which nothing is a float64 number."""
    settings = {"constraints": [vz - y * vx], "start": {y: "3/10", vx: "1/3", vy: "1/7"}}
    return System("particle", (x, y, z), FREE - k * y, **{"parameters": {k: "1/10"}} | settings | changes)


def contains(ball, exact):
    """Whether a fraction is in a ball; at flint's usual 53 bits the fraction would be a ball of its own."""
    with ctx.workprec(400):
        return ball.contains(fmpq(Fraction(exact).numerator, Fraction(exact).denominator))


def outside(enclosed, digits):
    """The names of quantities of which a ball does not contain the numbers of 30 digits, but for their rounding."""
    names = ("time", "place", "velocity", "energy", "constraint", "places", "final")
    pairs = [(name, getattr(enclosed, name), getattr(digits, name)) for name in names]
    pairs += [(name, enclosed.integrals[name], digits.integrals[name]) for name in enclosed.integrals]
    with ctx.workprec(200):
        return {
            name
            for name, balls, numbers in pairs
            for ball, number in zip(balls.flat, numbers.flat, strict=True)
            if not ball.overlaps(arb(number, 1e-38 * (1 + abs(float(number)))))
        }


@pytest.mark.parametrize(
    ("name", "method"),
    [
        *(("contact", method) for method in ("dla", "rk4")),
        *slow(*((name, method) for name in ("contact", "sleigh", "particle") for method in ANYWHERE)),
    ],
)
def test_many_digits_are_near_those_of_float64_and_inside_of_enclosures(name, method):
    """Of float64 in C and in Python."""
    counts = []
    digits = runner(name, method, Digits(30)).march(40, every=3, progress=counts.append)
    assert counts == [*range(1, 41)]
    in_python = Runner(example(name), method, False)
    for ready in (runner(name, method), in_python):
        found = ready.march(40, every=3)
        for part in ("time", "place", "final"):
            exact = getattr(digits, part)
            assert np.max(np.abs(getattr(found, part) - exact) / (1 + np.abs(exact))) < ULPS * 2.0**-52
    enclosed = runner(name, method, Enclosure(60)).march(40, every=3)
    assert outside(enclosed, digits) == set()
    assert max(float(ball.rad()) for ball in enclosed.final) < 1e-22
    assert len(enclosed.energy) == 14


def test_integrals_are_enclosed_too():
    system = particle(integrals={"forward": (1 + y**2) * vx**2})
    enclosed, digits = (moved(system, "spark", 10, precision=level) for level in (Enclosure(60), Digits(30)))
    assert outside(enclosed, digits) == set()
    assert contains(enclosed.integrals["forward"][0], Fraction(109, 900))


def by_hand(steps, h=Fraction(1, 10)):
    """The velocities of the free particle by the discrete principle, solved in fractions."""
    height, forward, up = Fraction(3, 10), Fraction(1, 3), Fraction(1, 7)
    middle = height + h * up / 2
    forward -= height * (middle - height) * forward / (1 + height * middle)  # from p = ∂L/∂v at the start
    for _ in range(steps):
        yield forward, up, middle * forward
        height += h * up
        middle, slope = height + h * up / 2, h * height * up / 2
        forward *= (1 + height**2 - slope) / (1 + height**2 + slope)


def test_the_exact_steps_are_inside():
    free = particle(parameters={k: 0})
    motion = moved(free, "dla", 30, precision=Enclosure(100))
    for balls, exact in zip(motion.velocity, by_hand(30), strict=True):
        assert all(contains(ball, e) for ball, e in zip(balls, exact, strict=True))
    assert all(float(ball.rad()) < 1e-35 for ball in motion.velocity.flat)


@pytest.mark.parametrize("method", ["dla", "rk4", *slow("gni", "midpoint", "spark")])
def test_a_set_of_starts_is_inside_and_a_wrong_derivative_is_seen(method, monkeypatch):
    """Corners of a box of velocities, in 30 digits, against the set; with halves of the derivatives they leave it."""
    near = runner("contact", method).march(1).final
    sets, points = (runner("contact", method, level) for level in (Enclosure(60), Digits(30)))

    def leaves():
        ends = sets.march(40, start=[*near[:3], *(arb(value, 1e-6) for value in near[3:])]).final
        corners = (points.march(40, start=near + 1e-6 * np.array([0, 0, 0, *signs])).final for signs in SIGNS)
        return max(float(ball.rad()) for ball in ends), any(
            not ball.contains(arb(number)) for corner in corners for ball, number in zip(ends, corner, strict=True)
        )

    radius, left = leaves()
    assert not left
    assert radius < 1e-3
    right = Sets._moved

    def wrong(self, root, rows):
        return [np.array([row[0], *(row[1:] * arb(0.5))], object) for row in right(self, root, rows)]

    monkeypatch.setattr(Sets, "_moved", wrong)
    assert leaves()[1]


SIGNS = [(1, 1, 1), (1, -1, 1), (-1, 1, -1), (-1, -1, 1)]


def test_what_is_rational_is_not_rounded():
    """x = 1/3 + t/7 in steps of 1/30, to 50 digits; 0.1 is read as it is written."""
    line = System("line", (x,), k * vx**2 / 2, parameters={k: 0.1}, start={x: "1/3", vx: Fraction(1, 7)})
    for method in ANYWHERE:
        motion = moved(line, method, 3, "1/30", precision=Digits(50))
        end = Fraction(1, 3) + Fraction(3, 30 * 7)
        assert Digits(50).write(motion.final[0]) == Digits(50).write(Digits(50).number(end))
        ball = moved(line, method, 3, "1/30", precision=Enclosure(160)).final[0]
        assert contains(ball, end)
        assert not contains(ball, float(end))
        energy = moved(line, method, 1, "1/30", precision=Enclosure(160)).energy[0]
        assert contains(energy, Fraction(1, 980))
    long = System("long", (x,), vx**2 / 2 - sp.Float("0.12345678901234567890123456789", 30) * x)
    force = moved(long, "midpoint", 1, 1, precision=Digits(29)).final[1]
    assert Digits(29).write(force) == "-0.12345678901234567890123456789"


def test_velocities_that_the_start_has_not_are_exact_too():
    """The smallest with z' - y x' = 1: (-y, 0, 1)/(1 + y²); a constraint that is there twice changes nothing."""
    affine = vz - y * vx - 1
    for constraints in ([affine], [affine, affine]):
        system = particle(constraints=constraints, start={y: "1/3"})
        with Enclosure(100).working():
            ready = Runner(system, "rk4", precision=Enclosure(100))
            _, v = np.split(ready._beginning(np.array([*ready.fixed, arb(1)])), 2)
        for ball, exact in zip(v, (Fraction(-3, 10), 0, Fraction(9, 10)), strict=True):
            assert contains(ball, exact)
            assert float(ball.rad()) < 1e-40


def test_double_double_has_its_digits():
    system = example("sleigh")
    pairs, digits = (moved(system, "dla", 20, precision=level).final for level in ("double-double", Digits(40)))
    assert all(abs(float(mpmath.mpf(0) + p.high - d + p.low)) < 1e-28 for p, d in zip(pairs, digits, strict=True))


def test_what_is_measured_in_float32_is_an_array_of_it():
    motion = moved(example("sleigh"), "dla", 2, precision="single")
    assert {x.dtype for x in (motion.energy, motion.constraint, *motion.integrals.values())} == {np.dtype(np.float32)}


def test_a_motion_goes_on_from_where_it_ended():
    ready = runner("particle", "gni", Digits(30))
    assert max(abs(ready.march(6, start=ready.march(6).final).final - ready.march(12).final)) < 1e-40


def test_an_enclosure_that_is_too_wide_says_at_which_step():
    kicked = System("kicked", (a,), va**2 / 2 - 5 * sp.cos(a), start={a: "1/10"})  # the standard map
    with pytest.raises(NotSolved, match=r"step \d+ of 99 has an enclosure .* a radius of .* than Enclosure\(10\)"):
        moved(kicked, "dla-left", 99, 1, precision=Enclosure(10))
    assert moved(kicked, "dla-left", 99, 1, precision=Enclosure(300)).energy[-1].rad() < 1e-40


@pytest.mark.parametrize(
    ("changes", "options", "said"),
    [
        ({}, {"precision": "exact"}, "precision must be .*chapsym.Digits"),
        ({"parameters": {k: sp.sqrt(2)}}, {}, "the parameter k is sqrt.2., which is no rational number"),
        ({"parameters": {k: Decimal("1e999999999")}}, {}, "the parameter k is .*, which is no number"),
        ({"step": sp.pi}, {}, "the length of a step is pi, which is no rational number"),
        ({"start": {y: sp.sqrt(2)}}, {}, "the start of y is sqrt.2., which is no rational number"),
        ({"integrals": {"one": sp.exp(x)}}, {}, r"exp.* is not sin, cos, a square root"),
        ({"constraints": [vz - sp.E * y * vx]}, {}, "a constant is E, which is no rational number"),
        ({}, {"length": -1}, "must be positive"),
    ],
)
def test_what_has_no_exact_numbers_is_one_sentence(changes, options, said):
    with pytest.raises(BadSystem, match=said):
        moved(particle(**changes), "dla", 2, **{"precision": Enclosure(60)} | options)


def test_roots_below_0_and_equations_without_a_solution_are_one_sentence():
    falling = System("falling", (x,), vx**2 / 2 - sp.sqrt(x), start={x: "1/100"})
    for precision in ("double", "double-double", Digits(30), Enclosure(60)):
        with pytest.raises(NotSolved, match=r"falling, rk4: step \d+ of 100 "):
            Runner(falling, "rk4", False, precision).march(100)


def test_a_start_of_another_size_or_beyond_the_numbers_is_one_sentence():
    ready = Runner(particle(), "dla", precision=Enclosure(60))
    with pytest.raises(BadSystem, match=r"the start must be 6 numbers, as `final` has them, not \[1\.0, 2\.0\]"):
        ready.march(1, start=[1.0, 2.0])
    fast = System("fast", (x,), vx**2 / 2 + x**4, start={x: 1000})
    for precision in (Digits(30), Enclosure(60), "double-double"):
        with pytest.raises(NotSolved, match=r"fast, rk4: (a )?step .* of 20 "):
            moved(fast, "rk4", 20, 1000, precision=precision)
