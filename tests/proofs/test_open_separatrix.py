"""The level l = 1/Λ₂ in numbers: the map by (4.13), what orbits gain between their ends, and levels near it.

Those of thorough runs are of the formulas alone, and of nothing that chapsym computes.
"""

import pytest
from mpmath import mp, mpf

from chapsym.dynamics.oracle import Oracle


class Arc:
    """The map u ↦ ũ of separatrix-map for the moments I, D and h."""

    def __init__(self, moments, contact, height):
        self.I, self.D, self.h = [mpf(x) for x in moments], mpf(contact), mpf(height)
        a, b, c = self.Lambda = [x + self.D for x in self.I]
        self.kappa = mp.sqrt((a - b) * (b - c) / (a * c))
        self.c = 2 * mp.acoth(self.root(0))

    def root(self, Y):
        """The larger X with h(ϰX² + 1/ϰ) - 2I₂X = Y."""
        b, scale = self.I[1], self.h * self.kappa
        return (b + mp.sqrt(b**2 - self.h**2 + scale * Y)) / scale

    def after(self, u):
        """ũ, by iteration: X from Y, Y from X."""
        X, last = self.root(0), mpf(0)
        while abs(X - last) > mp.eps * X * 100:
            X, last = self.root(self.D * (mp.tanh(u + 2 * mp.acoth(X)) - mp.tanh(u))), X
        return u + 2 * mp.acoth(X)

    def end(self, u):
        """h₊(u), to all digits: increments differ from c by e^{-2u}."""
        steps = 0
        while 2 * u < mp.dps * mp.log(10):
            u, steps = self.after(u), steps + 1
        return u - steps * self.c

    def misfit(self, u):
        """Δ(u)."""
        return self.end(u) + self.end(-u)

    def swing(self):
        """Δ(0) - Δ(c/2)."""
        return self.misfit(mpf(0)) - self.misfit(self.c / 2)

    def second_order(self):
        """What it is to second order in D, but with the c and A'' of this D."""
        X, slope, bend = self.root(0), 2 * mp.sqrt(self.I[1] ** 2 - self.h**2), 2 * self.h * self.kappa
        second = 2 * X / ((X**2 - 1) * slope) ** 2 + bend / ((X**2 - 1) * slope**3)
        harmonics = mp.fsum(m / mp.sinh(m * mp.pi**2 / self.c) for m in (1, 3, 5, 7))
        return -16 * mp.pi**2 * second * self.D**2 / self.c**2 * harmonics

    def vertical(self, u, k2=1):
        """γ(u) on the level of the modulus k², a circle for k² < 1, with C1 < 0."""
        a, b, c = self.Lambda
        level = self.level(k2)
        squares = [a * (1 - c * level) / (a - c), b * (1 - c * level) / (b - c), c * (a * level - 1) / (a - c)]
        functions = [mp.ellipfun(name, u, m=k2) for name in ("cn", "sn", "dn")]
        return [s * mp.sqrt(x) * f for s, x, f in zip((-1, 1, 1), squares, functions, strict=True)]

    def level(self, k2):
        """l by its modulus: k² = (Λ₁ - Λ₂)(1 - Λ₃l)/((Λ₂ - Λ₃)(Λ₁l - 1))."""
        a, b, c = self.Lambda
        return (k2 * (b - c) + a - b) / (c * (a - b) + k2 * a * (b - c))


def stepped(ball, gamma):
    """γ after a step with 𝒦 = hγ, by (4.13) in matrices."""
    J = [(sum(ball.I) - 2 * x) / 2 for x in ball.I]
    turn = Oracle(J, ball.D, gamma, mp.dps - 6).step([ball.h * x for x in gamma]).rotation
    return list(mp.matrix(turn).T * mp.matrix(gamma))


def hat(v):
    return mp.matrix([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def iterated(ball, gamma, steps):
    """γ after some steps, by Newton's method for the Gibbs vector."""
    gamma, inertia = mp.matrix(gamma), mp.diag(ball.I)
    u = gamma * ball.h / ball.I[0] / 2
    for _ in range(steps):
        B, k, change = inertia + ball.D * (mp.eye(3) - gamma * gamma.T), ball.h * gamma / 2, mp.inf
        while change > mp.sqrt(mp.eps) / 1000:
            left = B * u + hat(u) * inertia * u - (1 + (u.T * u)[0]) * k
            step = mp.lu_solve(B + hat(u) * inertia - hat(inertia * u) - 2 * k * u.T, left)
            u, change = u - step, mp.norm(step)
        once = hat(u) * gamma
        gamma += 2 / (1 + (u.T * u)[0]) * (hat(u) * once - once)
    return gamma


def displacement(ball, k2, u, steps):
    """u after some steps, less u and half a turn, 2K."""
    scale, ends = ball.vertical(0, k2)[0], ball.vertical(mp.ellipk(k2), k2)[1]
    end = iterated(ball, ball.vertical(u, k2), steps)
    return mp.ellipf(mp.atan2(-end[1] / ends, -end[0] / scale), k2) - u


@pytest.mark.parametrize("u", [mpf(-2), mpf(0), mpf(3) / 4])
def test_the_map_of_the_arc_is_a_step(u):
    with mp.workdps(40):
        ball = Arc((5, 4, 2), 1, mpf(20) / 13)
        wanted = ball.vertical(ball.after(u))
        assert max(abs(x - y) for x, y in zip(stepped(ball, ball.vertical(u)), wanted, strict=True)) < mpf(10) ** -30
        assert abs(ball.c - mp.log(mpf(8) / 7)) < mpf(10) ** -38


def test_the_second_order_is_that_of_the_map():
    with mp.workdps(60):
        ratios = [ball.swing() / ball.second_order() for ball in (Arc((9, 6, 5), D, "4.5") for D in ("0.01", "0.0001"))]
        assert abs(ratios[1] - 1) < abs(ratios[0] - 1) / 90
        assert abs(ratios[1] - 1) < 5e-4


@pytest.mark.thorough
def test_where_the_difference_vanishes_the_misfit_is_not_constant():
    with mp.workdps(80):
        ball = Arc((9, 6, 5), "2.395317441298880761091913125132232844408", "4.5")
        assert abs(ball.swing()) < mpf(10) ** -60
        assert mp.almosteq(ball.misfit(ball.c / 4) - ball.misfit(mpf(0)), mpf("4.06745e-54"), 1e-5)


@pytest.mark.thorough
@pytest.mark.parametrize("before", ["2.3953174412", "4.6932514664", "8.0197522858"])
def test_the_difference_changes_its_sign_three_times(before):
    with mp.workdps(80):
        here, there = (Arc((9, 6, 5), D, "4.5").swing() for D in (mpf(before), mpf(before) + mpf(10) ** -10))
        assert here * there < 0


@pytest.mark.thorough
def test_beside_the_arc_many_steps_displace_by_the_misfit():
    """On the level with 2K - 300c = Δ(0), u = 0 is displaced by half a turn; c/2 by more, as Δ(c/2) is more."""
    with mp.workdps(75):  # k'² is 1e-29
        ball, steps = Arc((9, 6, 5), "0.1", "4.5"), 300
        k2 = 1 - 16 * mp.exp(-steps * ball.c - ball.misfit(mpf(0)))  # K is log(4/k')
        first, second = (displacement(ball, k2, u, steps) for u in (mpf(0), ball.c / 2))
        assert abs(first) < mpf(10) ** -25
        slope = mp.diff(lambda u: -ball.end(-u), ball.c / 2)
        assert mp.almosteq(second * slope, -ball.swing(), 1e-4)
        assert second > mpf(10) ** -21
