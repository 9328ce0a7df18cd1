"""The derivative of the step, exponents, the verdict chaotic, and the pictures."""

import numpy as np
import pytest

import chapsym
from chapsym.dynamics.loops import loop, tangent
from research import chaos
from research.chaos.orbits import LIMIT, follow_orbits, sample, slab, starts
from research.energy.section import Level, state

BALL = chapsym.Ball((1, 2, 4), 1.0)


def turned(v, x):
    """v turned to first order by v × x, exactly of its length."""
    angle = np.linalg.norm(x)
    n = -x / angle
    return v * np.cos(angle) + np.cross(n, v) * np.sin(angle) + n * (n @ v) * (1 - np.cos(angle))


def matrix(K, g, ball=BALL):
    """The derivative of the step from 𝒦 and γ, its columns as rows."""
    u, state, found = chapsym.step(ball, K, g).rotation, np.zeros(loop.ROWS), np.empty((3, 3))
    loop.entered(K, g, ball.mass_tensor, float(ball.D), state)
    tangent.derivative(u[1:] / u[0], state, found)
    return found


@pytest.mark.parametrize("D", [0.0, 1.0, 7.0])
def test_derivative_against_differences(D):
    """Central differences: h² of truncation and 1e-16/h of rounding, with h = 1e-5."""
    ball, h = chapsym.Ball((1, 2, 4), D), 1e-5
    K, g = (v[0] for v in (2.5 * starts(1, False, 3)[0], starts(1, False, 3)[1]))
    after = chapsym.step(ball, K, g)
    found = matrix(K, g, ball).T
    for i, e in enumerate(np.eye(3)):
        ends = [chapsym.step(ball, turned(K, s * h * e), turned(g, s * h * e)) for s in (1, -1)]
        dK, dg = (ends[0].momentum - ends[1].momentum) / (2 * h), (ends[0].gamma - ends[1].gamma) / (2 * h)
        assert np.cross(after.momentum, found[:, i]) == pytest.approx(dK, abs=1e-8)
        assert np.cross(after.gamma, found[:, i]) == pytest.approx(dg, abs=1e-8)


def test_volume_is_kept_without_contact_and_not_with_it_and_given_back_by_the_reversed_step():
    K, g = (v[0] for v in starts(1, False, 5))
    assert tangent.determinant(matrix(K, g, chapsym.Ball((1, 2, 4), 0.0))) == pytest.approx(1, abs=1e-14)
    assert abs(tangent.determinant(matrix(K, g)) - 1) > 1e-4
    after = chapsym.step(BALL, K, g)
    product = tangent.determinant(matrix(K, g)) * tangent.determinant(matrix(-after.momentum, after.gamma))
    assert product == pytest.approx(1, abs=1e-14)


def test_growths_add_up_to_the_volume():
    K, g = starts(2, False, 1)
    found = follow_orbits(BALL, 2.0 * K, g, 100)
    total = found["growth1"] + found["growth2"] + found["growth3"]
    volume = []
    for k, v in zip(2.0 * K, g, strict=True):
        run = chapsym.trajectory(BALL, k, v, 99)
        volume.append(sum(np.log(tangent.determinant(matrix(*s))) for s in zip(run.momentum, run.gamma, strict=True)))
    assert total == pytest.approx(np.array(volume), abs=1e-10)


def test_compiled_orbit_is_that_of_the_map():
    K, g = starts(4, False, 2)
    run = chapsym.trajectory(BALL, 2.0 * K, g, 400)
    found = follow_orbits(BALL, 2.0 * K, g, 400)
    energies = np.array([Level((1, 2, 4), 1.0, 0.0).energy(k, v) for k, v in zip(run.momentum, run.gamma, strict=True)])
    assert found["energy_low"] == pytest.approx(energies[:, :-1].min(axis=1), rel=1e-12)
    assert found["energy_high"] == pytest.approx(energies[:, :-1].max(axis=1), rel=1e-12)


def test_regular_orbits_keep_the_volume_on_average():
    """The smooth weights converge faster than any power."""
    found = sample([1, 2, 4], 1.0, 0.6, False, 32, 20_000, 1)
    assert found["chaotic"] == 0
    assert found["regular"]["median_volume"] < 1e-12


def test_chaos_is_found_and_none_without_contact():
    wild = sample([0, 1, 3], 1.0, 2.0, True, 48, 4_000, 7)
    assert wild["chaotic"] > 12
    assert wild["wild"]["exponent"][0] > 0.01
    calm = sample([0, 1, 3], 0.0, 2.0, True, 48, 4_000, 7)
    assert calm["chaotic"] == 0
    assert calm["regular"]["growth"][2] < LIMIT


def test_a_fold_is_counted_and_not_told_regular_and_heavy_balls_are_refused():
    found = sample([0, 1, 3], 1.0, 3.0, False, 32, 500, 7)
    assert found["folded"] > 0
    assert found["counted"] + found["folded"] == 32
    with pytest.raises(ValueError, match="32 I_min"):
        follow_orbits(chapsym.Ball((1, 2, 4), 100.0), *starts(1, False, 1), 10)


def test_slab_is_on_the_section_of_the_orbit():
    """Points of the flow, moved along the field by at most SLAB: off by its square."""
    level = Level((0, 1, 3), 1.0, 0.5)
    K, g = state(level, 0.9, 0.3)
    theta, psi = slab(level, *level.flow(K, g, 400.0, 40_000))
    assert len(theta) > 20
    assert np.ptp(level.energy(*state(level, theta, psi))) < 1e-4 * level.energy(K, g)


def test_share_has_wilson_s_interval():
    """Of 0 in 10: 0 to z²/(10 + z²)."""
    p, low, high = chaos.share(10, 0)
    assert (p, low) == (0, 0)
    assert high == pytest.approx(1.96**2 / (10 + 1.96**2))
    assert chaos.share(0, 0)[1:] == (0.0, 1.0)
