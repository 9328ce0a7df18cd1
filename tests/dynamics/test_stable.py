"""What float64 keeps for D ≫ J: errors in ulps against mpmath, each beside the form that it replaced."""

import mpmath
import numpy as np
import pytest

from chapsym import BadInput, Ball, Curve, extrapolate, increment, roll, step, step_vertical
from chapsym.dynamics import kernels
from chapsym.dynamics.closed import elliptic
from chapsym.dynamics.closed.elliptic import height_of
from chapsym.dynamics.loops import branch, gibbs, loop
from chapsym.dynamics.oracle import Oracle
from chapsym.generated import tangent_jacobian

ULP = 2.0**-52
MP = mpmath.MPContext()
MP.dps = 60
HEAVY = (1e2, 1e6, 1e9, 1e14)


def exact(values):
    return [MP.mpf(float(x)) for x in values]


def unit(rng):
    v = rng.normal(size=3)
    v /= np.sqrt(v @ v)
    return v / np.sqrt(v @ v)


def states(D, count=6):
    """Balls with momenta of the size of J in any direction: well conditioned, however large D is."""
    rng = np.random.default_rng([5, int(np.log10(D))])
    return [(rng.uniform(0.3, 2.0, 3), unit(rng) * rng.uniform(0.02, 0.2), unit(rng)) for _ in range(count)]


def root(K, g, J, D):
    """The Gibbs vector to 50 digits."""
    found = Oracle(exact(J), MP.mpf(D), exact(g), 50).step(exact(K))
    return [x / found.q0 for x in found.q]


def off(found, true):
    """The largest error in ulps of the largest component."""
    return float(max(abs(MP.mpf(float(a)) - b) for a, b in zip(found, true, strict=True)) / max(map(abs, true))) / ULP


def condition(K, g, J, D, u):
    """Σⱼ |∂u/∂Kⱼ||Kⱼ| in its largest component, relative to u: what K alone asks for."""
    q = np.array([1.0, *u]) / np.sqrt(1 + u @ u)
    T = MP.matrix(np.reshape([float(x) for x in tangent_jacobian(*q, *g, *J, D)], (3, 3)).tolist())
    inverse = np.abs(np.array((T**-1).tolist(), dtype=float))
    return (inverse @ np.abs(K)).max() / np.abs(u).max()


@pytest.mark.parametrize("D", HEAVY)
def test_the_step_of_a_heavy_ball_has_its_digits(D):
    """𝒦 of the size of J: q is as well conditioned as for D = 1, and 4(1 + κ) ulps are kept by the step and the run."""
    for J, K, g in states(D):
        q = step(Ball(J, D), K, g).rotation
        u = root(K, g, J, D)
        budget = 4 * (1 + condition(K, g, J, D, np.array([float(x) for x in u])))
        assert budget < 1000
        assert off(q[1:] / q[0], u) <= budget
        state = np.zeros(loop.ROWS)
        loop.entered(K, g, J, D, state)
        assert (state[loop.RADIUS] == -1.0) == gibbs.is_heavy(J.sum() - J, D)
        status, _, *found = loop.safe_rotation(q[1:] / q[0] / 2, state)
        assert status == 0
        assert off(found[1], u) <= budget


@pytest.mark.parametrize("D", HEAVY)
def test_long_steps_of_a_heavy_ball_have_their_digits(D):
    """Eight ulps after four of them; by the determinant along a row they would lose up to D/I."""
    for J, K, g in states(D, 6):
        run, true = (
            extrapolate(Ball(J, D), K, g, 0.5, 4, attitude=True, precision=p) for p in ("double", "double-double")
        )
        for name in ("gamma", "attitude"):
            assert abs(getattr(run, name) - getattr(true, name)).max() <= 8 * ULP


@pytest.mark.parametrize("D", HEAVY)
def test_the_determinant_of_the_tangent_jacobian(D):
    for J, _, g in states(D):
        q = np.array([1.0, *(0.05 * unit(np.random.default_rng(3)))])
        q /= np.sqrt(q @ q)
        nine = tangent_jacobian(*exact(q), *exact(g), *exact(J), MP.mpf(D))
        found, true = branch.inverse(q, g, J, D)[0], MP.det(MP.matrix([nine[i : i + 3] for i in (0, 3, 6)]))
        assert abs(float(MP.mpf(float(found)) / true - 1)) <= 64 * ULP / np.abs(g).max() ** 2


def test_the_light_balls_are_not_touched():
    """Up to D = 32 I_min the certificate is the lemma's, and the fast kernel serves."""
    k, inertia = (0.01, 0.02, -0.01), (1.0, 1.5, 2.0)
    assert not gibbs.is_heavy(inertia, 32.0)
    assert gibbs.certificate(k, inertia, 32.0) == gibbs.bound(k, inertia, 32.0)
    assert gibbs.certificate(k, inertia, 32.1) == (-1.0, 0.0)
    assert gibbs.bound(k, inertia, 32.1)[0] > 0


def test_rolling_starts_from_the_spin_that_was_asked_for():
    ball, g = Ball((1.0, 1.1, 1.2), 1e9), np.array((2, 3, 6)) / 7
    run = roll(ball, 3.0 * g, 1e-3, 0, gamma=g)
    spin = float(kernels.angular_velocity(run.momentum[0] / 1e-3, g, ball.mass_tensor, ball.D) @ g)
    assert abs(spin - 3.0) <= 8 * ULP * 3


@pytest.mark.parametrize("D", [0.0, 1.0, 1e6, 1e12])
def test_the_curve_has_its_modulus_at_every_D(D):
    """k, k', V by mpmath from the same floats: 8 ulps."""
    rng = np.random.default_rng(4)
    for kind in range(24):
        J, g = np.sort(rng.uniform(0.1, 2.0, 3)), rng.normal(size=3)
        if kind % 2:
            g = np.eye(3)[kind // 2 % 3] + 10 ** rng.uniform(-12, -3) * g
        g = g / np.sqrt(g @ g)
        g = g / np.sqrt(g @ g)
        curve = Curve.through(Ball(J, D), g)
        true = invariants_of(curve, exact(J), MP.mpf(D), exact(g))
        for found, value in zip((curve.modulus, curve.complement, abs(curve.rate), curve.slack), true, strict=True):
            assert abs(float(MP.mpf(found) / value - 1)) <= 8 * ULP


def level_of(J, D, g):
    """Λ and l, on the direction of g."""
    L, norm = [sum(J) - x + D for x in J], sum(x * x for x in g)
    return L, sum(x * x / m for x, m in zip(g, L, strict=True)) / norm


def invariants_of(curve, J, D, g):
    """k, k', |V| and 1 - Dl from their definitions (5.7), (5.13-V), on the direction of g."""
    L, level = level_of(J, D, g)
    a, b, c = curve.axes
    MP.dps = 90
    lower, upper = abs(L[a] * level - 1), abs(1 - L[c] * level)
    k2 = abs(L[a] - L[b]) * upper / (abs(L[b] - L[c]) * lower)
    rest = abs(L[a] - L[c]) * abs(L[b] * level - 1) / (abs(L[b] - L[c]) * lower)
    MP.dps = 60
    V = MP.sqrt(abs(L[b] - L[c]) * lower / (L[0] * L[1] * L[2]))
    return MP.sqrt(k2), MP.sqrt(rest), V, 1 - D * level


#: Bodies and γ (of any length) for which a difference of moments, or the distance from an end, is easily lost.
HARD = {
    "moments 1e-9 apart": ((1.0, 1.0 + 1e-9, 4.0), (2, 3, 6)),
    "moments 1e-15 apart": ((1.0, 1.0 + 1e-15, 1.0 + 3e-15), (2, 3, 6)),
    "equal moments": ((1.0, 1.0, 4.0), (2, 3, 6)),
    "a flat body": ((0.0, 1.0, 2.0), (2, 3, 6)),
    "near its upper end": ((1.0, 2.0, 4.0), (1e-8, 2e-8, 1.0)),
    "near its lower end": ((1.0, 2.0, 4.0), (1.0, 2e-8, 1e-8)),
    "at its upper end": ((1.0, 2.0, 4.0), (1e-150, 2e-150, 1.0)),
    "at its lower end": ((1.0, 2.0, 4.0), (1.0, 2e-150, 1e-150)),
    "near the middle axis": ((1.0, 2.0, 4.0), (1e-8, 1.0, 2e-8)),
}


@pytest.mark.parametrize("D", [0.0, 3.0, 1e6])
@pytest.mark.parametrize("name", HARD)
def test_the_curve_and_its_increment_at_the_extremes(name, D):
    """The amplitudes (5.8) within 16 ulps of their own size, γ by its u, and a step of it beside that of the map."""
    J, g = (np.array(x, dtype=float) for x in HARD[name])
    g /= np.sqrt(g @ g)
    g /= np.sqrt(g @ g)
    ball = Ball(J, D)
    curve = Curve.through(ball, g)
    with MP.workdps(700):
        true = amplitudes_of(curve, exact(J), MP.mpf(D), exact(g))
        off = [abs(float(abs(MP.mpf(float(c))) / t - 1)) for c, t in zip(curve.amplitudes, true, strict=True)]
    assert max(off) <= 16 * ULP
    u = float(curve.argument(g))
    assert np.abs(curve.point(u) - g).max() <= 8 * ULP
    after = step_vertical(ball, 0.3, g).gamma
    assert np.abs(curve.point(u + increment(curve, 0.3, u)) - after).max() <= 16 * (1 + abs(u)) * ULP


def amplitudes_of(curve, J, D, g):
    """|C_a|, |C_b|, |C_c| from their definition (5.8), on the direction of g."""
    L, level = level_of(J, D, g)
    a, b, c = curve.axes
    lower, upper = abs(L[a] * level - 1), abs(1 - L[c] * level)
    gaps = L[a] - L[c], L[b] - L[c], L[a] - L[c]
    sizes = L[a] * upper, L[b] * upper, L[c] * lower
    return [MP.sqrt(size / abs(gap)) for size, gap in zip(sizes, gaps, strict=True)]


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("D", [0.0, 3.0, 1e15])
def test_no_curve_goes_through_a_principal_axis(axis, D):
    """The middle one too, which gave a curve with k = 1 of its own."""
    with pytest.raises(BadInput, match="the map fixes this gamma"):
        Curve.through(Ball((1, 2, 4), D), np.eye(3)[axis])
    assert Curve.through(Ball((1, 2, 4), D), (0.6, 0.0, 0.8)).modulus <= 1.0


@pytest.mark.parametrize("D", [1e3, 1e6, 1e9, 1e12])
def test_the_height_of_an_increment_at_large_D(D):
    """(5.15) as corrected in mpmath: with 1 - Dl, or 1 - Dλ/𝒟, the height had roundings of D."""
    J, g = np.array((1.0, 2.0, 4.0)), np.array((2, 3, 6)) / 7
    curve = Curve.through(Ball(J, D), g)
    for half, mean in ((1e-3, 0.3), (0.05, -1.0), (0.3, 0.7)):
        true = height_in_mpmath(curve, exact(J), MP.mpf(D), exact(g), MP.mpf(half), MP.mpf(mean))
        found = float(height_of(curve, half, mean)[0])
        assert abs(float(MP.mpf(found) / true - 1)) <= 32 * ULP


def height_in_mpmath(curve, J, D, g, half, mean):
    """2w(𝒟 - Dλ)/(V𝒟 G/V²), every quantity from its definition (5.13-V), (5.14)."""
    L, level = level_of(J, D, g)
    a, b, c = curve.axes
    k, _, V, _ = invariants_of(curve, J, D, g)
    sn, cn, dn = (MP.ellipfun(f, half, m=k * k) for f in ("sn", "cn", "dn"))
    s, y = MP.ellipfun("sn", mean, m=k * k), sn * sn
    lower, upper = L[a] * level - 1, 1 - L[c] * level
    alpha = (2 * L[a] * L[c] * level - (L[a] + L[c] - L[b])) / ((L[b] - L[c]) * lower)
    beta = L[c] * (L[a] * upper / (L[a] - L[c])) * (L[a] - L[c]) / ((L[b] - L[c]) ** 2 * lower)
    scale = 1 - k * k * s * s * y
    lam = level - upper / (L[b] - L[c]) * y
    rolled = (scale - D * lam) / scale
    return 2 * sn * cn * dn * rolled / (MP.sign(curve.rate) * V * (1 + alpha * y - beta * y * y))


def test_one_height_beyond_the_fold_does_not_spoil_a_batch():
    curve = Curve.through(Ball((1, 2, 4), 3), np.array((2, 3, 6)) / 7)
    several = increment(curve, [0.5, 50.0, 1.0, 1.7e308], 0.3)
    assert np.isnan(several).tolist() == [False, True, False, True]
    assert several[[0, 2]].tolist() == [increment(curve, 0.5, 0.3), increment(curve, 1.0, 0.3)]


@pytest.mark.parametrize("complement", [1e-100, 1e-160, 1e-250, 1e-300])
def test_jacobis_functions_do_not_overflow_near_the_separatrix(complement):
    """u up to 2K ~ 1400: sinh 2u and cosh 4K are beyond float64, and their quotient is small."""
    quarter = elliptic.quarter_period(complement)
    u = np.array([-2.0, -1.2, -1.0, -0.3, 1e-3, 0.3, 1.0, 1.2, 2.0]) * quarter
    with np.errstate(all="raise", under="ignore"):
        sn, cn, dn = elliptic.jacobi(u, 1.0, complement)
    assert np.isfinite([sn, cn, dn]).all()
    assert np.abs(sn * sn + cn * cn - 1).max() <= 8 * ULP
    assert np.abs(dn).min() >= complement * (1 - 1e-12)
    near = np.abs(u) <= 0.4 * quarter
    assert np.abs(sn[near] - np.tanh(u[near])).max() <= 4 * ULP


@pytest.mark.parametrize("D", HEAVY)
def test_the_angular_velocity_and_the_energy_are_as_good_as_k(D):
    """By F = Σ γᵢ²Iᵢ/Λᵢ; with 1 - D⟨γ,Λ⁻¹γ⟩ both had roundings of D/I.  K along γ: nothing else is ill conditioned."""
    for J, _, g in states(D):
        K, inertia = 0.7 * g, J.sum() - J
        unit = MP.matrix(exact(g)) / MP.norm(MP.matrix(exact(g)))
        B = MP.diag(exact(inertia)) + MP.mpf(D) * (MP.eye(3) - unit * unit.T)
        true = MP.lu_solve(B, MP.matrix(exact(K)))
        assert off(kernels.angular_velocity(K, g, J, D), true) <= 8
        energy = sum(a * b for a, b in zip(true, exact(K), strict=True)) / 2
        assert abs(float(MP.mpf(float(kernels.energy(K, g, J, D))) / energy - 1)) <= 8 * ULP
