"""Angles as double-double turns: the arctangent, k times an angle, and its cosine and sine, against mpmath."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from chapsym.dynamics.closed import turns

MP = mpmath.MPContext()
MP.dps = 60


def exactly(pair):
    return MP.mpf(float(pair[0])) + MP.mpf(float(pair[1]))


def test_a_full_turn_is_two_pi_and_an_eighth_is_the_turn_of_the_largest_tangent():
    """Where the series is longest; 2⁻¹⁰² is what its operations leave there."""
    assert abs(exactly(turns.FULL_TURN) / (2 * MP.pi) - 1) < 2.0**-105
    assert abs(exactly(turns.turns_of_tangent(1.0, 0.0)) * 8 - 1) <= 2.0**-102


@given(st.floats(0.0, 1.0), st.floats(-1, 1))
def test_turns_of_a_tangent(t, part):
    """Within 2⁻⁹⁹: five halvings and eleven terms, some 30 operations of 2⁻¹⁰³ at most; an array has the same bits."""
    t_ = part * float(np.spacing(t)) / 2 if 1e-280 < t < 1.0 else 0.0
    found = turns.turns_of_tangent(t, t_)
    true = MP.atan(MP.mpf(t) + MP.mpf(t_)) / (2 * MP.pi)
    assert abs(exactly(found) - true) <= 2.0**-99 * true + 2.0**-1000
    assert [half.tolist() for half in turns.turns_of_tangent(np.array([t]), np.array([t_]))] == [[x] for x in found]


@given(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5), st.integers(0, 2**62))
def test_the_fraction_of_many_turns(high, part, k):
    """Exact but for the low half of the low half, 2⁻¹⁰⁵k of a turn, and the last rounding, 2⁻⁵⁴."""
    low = part * np.spacing(high) if abs(high) > 1e-200 else 0.0
    found = turns.fraction(np.array(high), np.array(low), np.array([k]))[0]
    with mpmath.workdps(100):
        true = k * (mpmath.mpf(high) + mpmath.mpf(low))
        miss = abs(true - mpmath.nint(true) - float(found))
        miss = min(miss, abs(miss - 1))
    assert abs(found) <= 0.5
    assert miss <= 2.0**-54 + k * 2.0**-105


@pytest.mark.parametrize("index", [np.arange(1000), 7 + 13 * np.arange(64), 10**12 + 10**9 * np.arange(777)])
def test_many_steps_at_equal_distances_are_each_what_one_is(index):
    """The product of a coarse and a fine rotation, within 3 ulps of the rotation itself; the ends are there."""
    turn = np.array([0.137, -0.42]), np.array([3e-18, 1e-17])
    together = turns.cosines_and_sines(*turn, index)
    alone = turns.cosine_and_sine(turns.fraction(turn[0][:, np.newaxis], turn[1][:, np.newaxis], index))
    for some, each in zip(together, alone, strict=True):
        assert some.shape == (2, len(index))
        assert np.abs(some - each).max() <= 4 * 2.0**-52


@pytest.mark.parametrize("centre", np.arange(-8, 9) / 16)
def test_cosine_and_sine_of_a_turn(centre):
    at = np.clip(centre + np.linspace(-1e-3, 1e-3, 21), -0.5, 0.5)
    cosine, sine = turns.cosine_and_sine(at)
    for x, c, s in zip(at, cosine, sine, strict=True):
        angle = 2 * MP.pi * MP.mpf(float(x))
        assert abs(MP.cos(angle) - float(c)) <= 2.0**-52
        assert abs(MP.sin(angle) - float(s)) <= 2.0**-52
