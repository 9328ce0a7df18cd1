"""The displacement by the relation (5.15) on the elliptic curve, to any number of bits: a second route."""

from flint import acb, arb, ctx

from chapsym.certificates.balls import ball
from chapsym.dynamics.levels.start import fraction
from chapsym.generated import curve_increment


class Relation:
    """Increments of u on a curve γ = (C_a cn u, C_b sn u, C_c dn u), by h G𝒟 = 2Vw(𝒟 - D(l - μ sn²δu))."""

    def __init__(self, top, level, axes):
        La, Lb, Lc = (ball(top.moments[i]) for i in axes)
        self.L, self.l, self.D, self.h = (La, Lb, Lc), ball(level), ball(top.D), abs(ball(top.height))
        self.k2, self.G0, self.G1, self.G2, self.mu = curve_increment(La, Lb, Lc, self.l)
        self.V = self.G0.sqrt()
        self.K, self.Kc = (acb(x).elliptic_k().real for x in (self.k2, 1 - self.k2))
        self.tau = acb(0, 1) * self.Kc / self.K

    def jacobi(self, u):
        """sn, cn, dn of u, by theta functions of u/2K."""
        z = acb(u) / (2 * self.K)
        t1, t2, t3, t4 = (x.real for x in z.modular_theta(self.tau))
        _, z2, z3, z4 = (x.real for x in acb(0).modular_theta(self.tau))
        return z3 / z2 * (t1 / t4), z4 / z2 * (t2 / t4), z4 / z3 * (t3 / t4)

    def off(self, half, mean):
        """What (5.15) leaves at a half increment and a mean."""
        sn, cn, dn = self.jacobi(half)
        y, scale = sn * sn, 1 - self.k2 * sn * sn * self.jacobi(mean)[0] ** 2
        G = self.G0 + y * (self.G1 + y * self.G2)
        return self.h * G * scale - 2 * self.V * sn * cn * dn * (scale - self.D * (self.l - self.mu * y))

    def step(self, u):
        """u after the step: 2δu by Newton's iteration from the rate of the continuous ball; to rounding."""
        half = (self.V * self.h / (2 * (1 - self.D * self.l))).mid()
        gap = arb(2) ** -(ctx.prec // 3)
        for _ in range(60):
            slope = (self.off(half + gap, u + half + gap) - self.off(half - gap, u + half - gap)) / (2 * gap)
            before, half = half, (half - self.off(half, u + half) / slope).mid()
            if abs(half - before) < arb(2) ** -(ctx.prec - 40):
                break
        return (u + 2 * half).mid()


def displacement(top, level, axes, zero, steps, half_turns):
    """δ of the certificate: s(-1)^p(γ_a⁰γ_b^q - γ_b⁰γ_a^q) with γ by Jacobi's functions."""
    relation = Relation(top, level, axes)
    start = u = relation.K.mid() if zero == "a" else arb(0)
    for _ in range(steps):
        u = relation.step(u)
    La, Lb, Lc = relation.L
    sizes = [(L * (Lc * relation.l - 1) / (Lc - L)).sqrt() for L in (La, Lb)]
    (sn0, cn0, _), (sn, cn, _) = relation.jacobi(start), relation.jacobi(u)
    return fraction((-1) ** half_turns * sizes[0] * sizes[1] * (cn0 * sn - sn0 * cn))
