"""Twice the working precision, and the integrals that are restored without touching 𝒦 and γ."""

from fractions import Fraction

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from chapsym import testing
from chapsym.dynamics.loops import integrals, loop


def exact(state):
    """The three integrals of k - x and γ - y, exactly."""
    k, g = ([Fraction(float(state[at + c])) - Fraction(float(state[at + 6 + c])) for c in range(3)] for at in (0, 3))
    return [sum(a * b for a, b in zip(x, y, strict=True)) for x, y in ((g, g), (k, g), (k, k))]


def kept(state):
    return [Fraction(float(state[12 + 2 * i])) + Fraction(float(state[13 + 2 * i])) for i in range(3)]


@given(testing.states(fraction=(0.01, 0.9)), st.lists(st.integers(-99, 99), min_size=6, max_size=6))
def test_the_integrals_come_back(state, off):
    """The state has moved by up to 99 units of 2^-53; the integrals come back, but for the square of that."""
    ball, momentum, gamma = state
    array = np.zeros(loop.ROWS)
    loop.entered(momentum, gamma, ball.mass_tensor, float(ball.D), array)
    integrals.remember(array)
    size = np.sqrt(array[0:3] @ array[0:3])
    scales = [1.0, size, size * size]
    for found, wanted, scale in zip(exact(array), kept(array), scales, strict=True):
        assert abs(float(found - wanted)) <= 2.0**-100 * scale
    vectors = array[:6].copy()
    array[6:9] = np.array(off[:3]) * size * 2.0**-53
    array[9:12] = np.array(off[3:]) * 2.0**-53
    integrals.restore(array)
    assert (array[:6] == vectors).all()
    # Where 𝒦 and γ are nearly parallel their angle is left, which 99 units in each component turn by 4·99 at most.
    sine = np.linalg.norm(np.cross(array[0:3], array[3:6])) / size if size else 0.0
    left = 4 * 99 * 2.0**-53 * sine if sine * sine <= 1.01 * integrals.VERTICAL else 0.0
    for found, wanted, scale, more in zip(exact(array), kept(array), scales, [0.0, left, 0.0], strict=True):
        # The corrections are rounded to 53 bits of 1e2 units, and divided by sin² of the angle of 𝒦 and γ.
        assert abs(float(found - wanted)) <= (1e-24 / integrals.VERTICAL + more) * scale
