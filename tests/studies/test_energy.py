"""The energy of the map: X₃(H), the section, resonances, ranges and drift."""

import numpy as np
import pytest

import chapsym
from research import energy
from research.energy.amplitude import amplitude, drift, loop_change
from research.energy.resonance import closed_orbits, loop_drift, on_level, profile
from research.energy.section import Level, coordinates, crossings, rising, state

BALL = [[1.0, 2.0, 4.0], 1.0, 0.617126]
LEVEL = Level((1.0, 2.0, 4.0), 1.0, 0.617126)


@pytest.fixture(scope="module")
def resonance():
    """The widest resonance of the level: one return."""
    (orbit,) = [o for o in closed_orbits(LEVEL, 0.0, 1, 26.0, 48) if o[2] > 20]
    return profile(LEVEL, 0.0, *orbit)


def test_energy_rate_is_the_odd_part_of_the_change_by_a_step():
    """Against steps of the map, extrapolated in ε²; what is left is ε⁴ and a rounding of 1e-16/ε³."""
    K, g = state(LEVEL, np.array([0.3, 0.9]), np.array([0.2, 2.0]))
    odd = []
    for epsilon in (0.04, 0.02):
        ends = [chapsym.step(LEVEL.ball, s * epsilon * K, g) for s in (1, -1)]
        there, back = (LEVEL.energy(e.momentum / (s * epsilon), e.gamma) for e, s in zip(ends, (1, -1), strict=True))
        odd.append((there - back) / (2 * epsilon**3))
    assert (4 * odd[1] - odd[0]) / 3 == pytest.approx(LEVEL.energy_rate(K, g), abs=1e-10)


def test_energy_rate_is_odd_under_the_reversor_and_vanishes_without_contact():
    K, g = state(LEVEL, 0.7, 1.3)
    half_turn = np.array([-1.0, 1.0, -1.0])
    assert LEVEL.energy_rate(-half_turn * K, -half_turn * g) == pytest.approx(-LEVEL.energy_rate(K, g), rel=1e-12)
    level = Level((1.0, 2.0, 4.0), 0.0, 0.3)
    K, g = state(level, 0.7, 1.3)
    assert abs(level.energy_rate(K, g)) < 1e-16


def test_section_and_crossings():
    theta, psi = np.array([0.4, 1.1]), np.array([0.3, -2.0])
    K, g = state(LEVEL, theta, psi)
    assert np.allclose((K * g).sum(axis=-1), LEVEL.cosine * LEVEL.size, atol=1e-15)
    assert np.allclose(coordinates(K, g), (theta, psi), atol=1e-14)
    assert np.allclose(coordinates(K * [-1, 1, -1], g * [-1, 1, -1]), (theta, psi), atol=1e-14)
    assert rising(LEVEL, K, g).all()
    k, v = LEVEL.flow(K[0], g[0], 40.0, 1000)
    at, kc, gc = crossings(k, v)
    assert len(at) == 2
    assert np.abs(kc[:, 1]).max() < 1e-14
    # The interpolation by degree 7 leaves (step of 0.04)^8, the flow less.
    assert np.ptp(LEVEL.energy(kc, gc)) < 1e-10
    finer, _, _ = crossings(*LEVEL.flow(K[0], g[0], 40.0, 2000))
    assert at * 2 == pytest.approx(finer, abs=1e-8)


def test_closed_orbit_and_its_profile(resonance):
    assert resonance.period == pytest.approx(24.64334, abs=1e-5)
    K, g = resonance.start
    k, v = LEVEL.flow(K, g, resonance.start_period, 800)
    assert np.abs(k[-1] - K).max() < 1e-6
    assert np.abs(v[-1] - g).max() < 1e-6
    assert np.abs(resonance.loop).max() == pytest.approx(5.425e-4, rel=1e-3)
    assert abs(resonance.loop.mean()) < 1e-2 * np.abs(resonance.loop).max()


def test_loop_of_the_map_is_the_quadrature(resonance):
    """What is left is ∝ ε²: 0.704 ε² here, of 0.05 and of 0.0125."""
    found = loop_change(BALL, resonance.start.tolist(), resonance.start_period, [246, 493])
    exact = resonance.loop[np.argmax(np.abs(resonance.loop))]
    for one in found:
        assert one["change"] / exact == pytest.approx(1, abs=0.75 * one["epsilon"] ** 2)


def test_swing_in_the_resonance_is_of_order_epsilon(resonance):
    ranges = []
    for epsilon in (0.1, 0.05):
        steps = int(4 * resonance.libration / epsilon**2)
        found = amplitude(BALL, resonance.start.tolist(), epsilon, steps)
        ranges.append(found["range"] / epsilon)
        # A line through m swings of a sine rises by 3/(πm) of its range at most.
        assert abs(found["drift"]) < 3 / (4 * np.pi) * found["range"]
    # The fast oscillation adds a share ∝ ε.
    assert 2 * ranges[1] - ranges[0] == pytest.approx(resonance.swing, rel=0.06)


def test_symmetric_orbits_have_no_drift(resonance):
    K, g = state(LEVEL, resonance.theta, 0.0)
    here = on_level(LEVEL, resonance.energy, K[np.newaxis], g[np.newaxis])
    assert abs(loop_drift(LEVEL, here[0], here[1], np.array([resonance.period]))[0]) < 1e-12


def test_generic_range_is_of_order_epsilon_squared():
    start = energy.starts(LEVEL.size)[0].tolist()
    ranges = [amplitude(BALL, start, epsilon, 10_000)["range"] / epsilon**2 for epsilon in (0.1, 0.05)]
    assert ranges[0] == pytest.approx(ranges[1], rel=0.02)


def test_controls_keep_the_energy():
    start = energy.starts(3.0)[0]
    upright = [(3.0 * start[1]).tolist(), start[1].tolist()]
    assert amplitude([[1.0, 2.0, 4.0], 0.0, 0.0], start.tolist(), 0.5, 10_000)["range"] < 1e-13
    assert amplitude(BALL, upright, 0.5, 10_000)["range"] < 1e-13


def test_drift_finds_a_slope_and_its_error():
    noise = np.random.default_rng(1).normal(size=64_000)
    slope, error = drift(0.01 * noise)
    assert abs(slope) < 4 * error
    slope, error = drift(0.01 * noise + np.linspace(0, 1, 64_000))
    assert slope == pytest.approx(1, abs=4 * error)
    assert error < 1e-3
