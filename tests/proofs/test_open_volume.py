"""The determinant of several steps, by differences of the map itself, beside what `measure-iff` says of it."""

import numpy as np
import pytest
from budget import slow
from mpmath import mp, mpf

from chapsym.dynamics.oracle import Oracle
from chapsym.proofs.open.orbits import I1, I2, I3, SWING, D, c, steady_level, t

DIGITS, SIZE = 26, mpf(10) ** -9


def after(J, contact, state, steps):
    """(𝒦, γ) after some steps, by (4.13) in matrices."""
    for _ in range(steps):
        turn = Oracle([mpf(x) for x in J], mpf(contact), list(state[3:]), DIGITS).step(list(state[:3])).rotation
        back = np.array(mp.matrix(turn).T.tolist(), dtype=object).reshape(3, 3)
        state = np.concatenate([back @ state[:3], back @ state[3:]])
    return state


def across(gamma):
    """Two vectors that make an orthonormal basis with γ."""
    first = np.cross(gamma, [0, 0, 1])
    first = first / mp.sqrt(first.dot(first))
    return first, np.cross(gamma, first)


def volume(J, contact, state, steps):
    """det of the derivative on R³ × S², by central differences."""
    ends, basis = [], across(after(J, contact, state, steps)[3:])
    for sign in (1, -1):
        turned = [mp.cos(SIZE) * state[3:] + sign * mp.sin(SIZE) * way for way in across(state[3:])]
        starts = [np.concatenate([state[:3] + sign * SIZE * way, state[3:]]) for way in np.eye(3, dtype=int)]
        starts += [np.concatenate([state[:3], gamma]) for gamma in turned]
        ends.append([after(J, contact, start, steps) for start in starts])
    columns = [(there - here) / (2 * SIZE) for there, here in zip(*ends, strict=True)]
    return mp.det(mp.matrix([[*change[:3], *(way.dot(change[3:]) for way in basis)] for change in columns]))


def steady_state(J, contact, axis, half_turn, height):
    """𝒦 and γ of a steady rotation by π/half_turn about an axis, and the tangent of half the angle."""
    tangent, moments = mp.tan(mp.pi / (2 * half_turn)), [sum(J) - x for x in J]
    gamma = np.roll([mp.sqrt(1 - height**2) * mp.cos(1), mp.sqrt(1 - height**2) * mp.sin(1), height], axis - 2)
    along = np.roll([mpf(0), mpf(0), mpf(1)], axis - 2)
    momentum = (moments[axis] + contact) * along - contact * gamma[axis] * gamma
    return np.concatenate([2 * tangent / (1 + tangent**2) * momentum, gamma]), tangent


def closed_form(J, contact, axis, state, tangent, steps):
    """Π f(φ - (j + ½)θ)/f(φ - jθ) of steady-circles, the axes renamed."""
    moments = np.roll([sum(J) - x for x in J], 2 - axis)
    x, y, z = np.roll(state[3:], 2 - axis)
    values = {I1: moments[0], I2: moments[1], I3: moments[2], D: contact, c: z, t: tangent}
    P, Q = (mpf(str(e.evalf(30, subs=values))) for e in (steady_level(t), SWING))
    places = [mp.mpc(x, y) ** 2 * mp.expj(-2 * j * mp.atan(tangent)) for j in range(2 * steps)]
    f = [P + Q * (mp.mpc(1, -tangent) * place).real for place in places]
    return mp.fprod(f[1::2]) / mp.fprod(f[::2])


@pytest.mark.parametrize(("J", "axis"), [*slow(((1, 2, 2), 1)), ((1, 2, 4), 0)])
def test_a_steady_circle_does_not_keep_the_volume(J, axis):
    contact = 3
    with mp.workdps(30):
        state, tangent = steady_state(J, contact, axis, 4, mpf(1) / 2)
        found, wanted = volume(J, contact, state, 2), closed_form(J, contact, axis, state, tangent, 2)
        assert abs(found - wanted) < mpf(10) ** -14
        assert abs(wanted - 1) > mpf(10) ** -7


@pytest.mark.thorough  # of the formulas alone
def test_three_equal_moments_keep_it_and_so_does_the_third_axis_of_two():
    with mp.workdps(30):
        anywhere = np.array([mpf(1), mpf(2), mpf(-1) / 2, mpf(2) / 7, mpf(3) / 7, mpf(6) / 7])
        assert abs(volume((2, 2, 2), 3, anywhere, 1) - 1) < mpf(10) ** -14
        state, _ = steady_state((1, 2, 2), 3, 0, 4, mpf(1) / 2)
        assert abs(volume((1, 2, 2), 3, state, 1) - 1) < mpf(10) ** -14
