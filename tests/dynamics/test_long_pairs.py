"""Long steps in double-double: their order, what they keep, that they go on to the bit, and what they refuse."""

from fractions import Fraction
from functools import cache

import numpy as np
import pytest
from plain import in_plain_python

import chapsym
from chapsym.dynamics.extrapolation import weights, weights_of_pairs
from chapsym.dynamics.levels import double_double
from chapsym.numbers import Pair

BALL = chapsym.Ball((0.1, 0.5, 1.6), 0.7, radius=0.5)
K = np.array([1, -0.5, 0.75]) / np.sqrt(1 + 0.25 + 0.5625)
GAMMA = np.array([2, 3, 6]) / 7
#: The relative error of a product of pairs, about.
ROUNDOFF = 2.0**-104


def after(step, steps, momentum=K, gamma=GAMMA, ball=BALL, **options):
    return chapsym.extrapolate(ball, momentum, gamma, step, steps, precision="double-double", **options)


def exactly(found, name):
    """The numbers of a result as Fractions."""
    high, low = getattr(found, name), getattr(found.low, name)
    return np.vectorize(lambda a, b: Fraction(float(a)) + Fraction(float(b)), otypes=[object])(high, low)


@cache
def composed(time, order=8, steps=1600):
    """A trajectory in double-double, which shares no loop with long steps but the root of a step."""
    momentum = [Fraction(float(x)) * time / steps for x in K]
    return chapsym.trajectory(
        BALL, momentum, GAMMA, steps, order=order, every=steps, contact=True, precision="double-double"
    )


def off(found, time):
    """How far the attitude and the contact point are from those of a composition."""
    run = composed(time)
    ends = {name: exactly(run, name)[-1] for name in ("attitude", "contact", "gamma")}
    return max(float(abs(exactly(found, name) - end).max()) for name, end in ends.items())


def test_the_end_is_that_of_a_composition_to_its_last_digits():
    # 1600 steps of order 8 leave 1.5e-5 (2/1600)^8 of two radians, and long steps about as little.
    assert off(after(Fraction(1, 4), 8, contact=True), Fraction(2)) < 1e-26


@pytest.mark.parametrize(("columns", "coarse"), [(2, 8), (4, 4), (6, 4), (8, 4)])
def test_the_order_is_twice_the_columns(columns, coarse):
    errors = [off(after(Fraction(2, n), n, columns=columns, contact=True), Fraction(2)) for n in (coarse, 2 * coarse)]
    assert errors[1] > 1e-27  # above the rounding, so that the ratio means something
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2 * columns, abs=1.5)


def test_the_doubt_is_the_error_of_a_column_less():
    fewer = off(after(0.5, 4, columns=7, contact=True), Fraction(2))
    assert fewer / 10 < after(0.5, 4, columns=8).doubt < 10 * fewer


def test_the_weights_are_those_of_the_columns_to_the_last_bit():
    whole, less = weights(12, 3), (*weights(11, 3), Fraction(0))
    for row, w, v in zip(weights_of_pairs(12), whole, less, strict=True):
        assert Pair(*row[:2]) == Pair.of(w)
        assert Pair(*row[2:]) == Pair.of(w - v)
    assert sum(whole) == 1
    assert all(sum(w / Fraction(n) ** (2 * j) for n, w in enumerate(whole, 3)) == 0 for j in range(1, 12))


def test_the_integrals_do_not_walk():
    before, end = after(0.5, 0), after(0.5, 400, columns=2)
    kept = [
        [sum(a * b), sum(a * a), sum(b * b)]
        for a, b in ((exactly(run, "angular_momentum"), exactly(run, "gamma")) for run in (before, end))
    ]
    # Two rotations of some dozen roundings each, at the beginning and at the end, and no more for 400 steps.
    assert max(abs(float(a - b)) for a, b in zip(*kept, strict=True)) < 64 * ROUNDOFF
    assert float(abs(exactly(end, "gamma") - exactly(after(0.5, 400), "gamma")).max()) > 1e-6  # although it is off


def test_a_ball_has_the_same_bits_alone_in_a_batch_in_parts_and_in_plain_python(monkeypatch):
    momenta = np.array([K, 0.3 * K, -K])
    batch = after(0.4, 5, momenta, contact=True, threads=2)
    monkeypatch.setattr(double_double, "CHUNK", 300)  # two long steps
    for i in range(3):
        alone = after(0.4, 5, momenta[i], contact=True)
        for name in ("angular_momentum", "gamma", "attitude", "contact"):
            assert (exactly(alone, name) == exactly(batch, name)[i]).all()
    monkeypatch.undo()
    with in_plain_python():
        plain = after(0.4, 2, contact=True)
    assert (exactly(plain, "contact") == exactly(after(0.4, 2, contact=True), "contact")).all()
    assert plain.doubt == after(0.4, 2).doubt


@pytest.mark.usefixtures("way")
@pytest.mark.parametrize(("size", "step"), [(1e200, 1e300), (1e300, 1e-200), (1e-300, 1e-5)])
def test_what_is_beyond_the_range_is_a_fold_or_stays(size, step):
    """A momentum times a time may be beyond float64, where `ldexp` of plain Python raises OverflowError."""
    if size > 1:
        with pytest.raises(chapsym.StepNotTaken):
            after(step, 1, size * K, columns=2)
    else:
        assert after(step, 1, size * K, columns=2).status == chapsym.Status.TAKEN


def test_a_step_may_be_longer_than_one_of_the_map():
    """Columns from n = 1 on would have no rotation where those from 3 on have."""
    assert after(2.0, 1).status == chapsym.Status.TAKEN
    with pytest.raises(chapsym.StepNotTaken):
        chapsym.trajectory(BALL, 2.0 * K, GAMMA, 1, precision="double-double")
