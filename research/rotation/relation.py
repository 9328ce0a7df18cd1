"""The same step in Jacobi's functions: (5.15) as corrected, its chord form, and the law of the plateaus for small D."""

from flint import acb, arb, ctx

from .circle import Given, Level, middle, number, real, solved


class Relation:
    """(5.15) as corrected on one level: hG𝒟 = 2Vw(𝒟 - D(l - μ sn²δu)), 𝒟 = 1 - k² sn²ū sn²δu, w = sn cn dn of δu."""

    def __init__(self, level: Level) -> None:
        self.level = level
        La, Lb, Lc = level.moments
        Ca, Cb, Cc = level.amplitudes
        lower = Cc * Cc * (La - Lc) / Lc  # Λ_a l - 1
        self.mu = middle(Cb * Cb / Lb)
        self.V = middle((abs(Lb - Lc) * abs(lower) / (La * Lb * Lc)).sqrt())
        self.alpha = middle((2 * La * Lc * level.l - (La + Lc - Lb)) / ((Lb - Lc) * lower))
        self.beta = middle(Lc * Ca * Ca * (La - Lc) / ((Lb - Lc) ** 2 * lower))

    def height(self, half: arb, mean: arb) -> arb:
        """The h whose step leads from ū - δu to ū + δu."""
        w, y, shape, weight = self._parts(half)
        s = self.level.jacobi(mean)[0]
        scale = 1 - self.level.m * s * s * y
        return middle(2 * w * (1 - self.level.D * weight / scale) / (self.V * shape))

    def _parts(self, half: arb) -> tuple[arb, arb, arb, arb]:
        """w, y = sn², G/V² = 1 + αy - βy², λ = l - μy of the half increment."""
        sn, cn, dn = self.level.jacobi(half)
        y = sn * sn
        return sn * cn * dn, y, 1 + self.alpha * y - self.beta * y * y, self.level.l - self.mu * y

    def increment(self, u: arb) -> arb:
        """2δu of the step from u on the branch that starts at δu = 0, by the secant method."""
        slack = 1 - self.level.D * self.level.l
        b = middle(self.V * self.level.h / (2 * slack))
        return 2 * solved(lambda half: self.height(half, u + half) - self.level.h, b * arb("0.99"), b)

    def displacement(self, phase: Given, steps: int, half_turns: int) -> arb:
        """As `Level.displacement`, without the sphere."""
        start = self.level.argument(number(phase))
        u = start
        for _ in range(steps):
            u = middle(u + self.increment(u))
        return middle((u - start) / self.level.half - half_turns)

    def momentum(self, half: arb) -> arb:
        """M(a) = (2w/y)N(a), N = (1 - hG/(2Vw))/λ; 0 where the top, D = 0 with these Λ, has this increment."""
        w, y, shape, weight = self._parts(half)
        return middle(2 * (w - self.level.h * self.V * shape / 2) / (y * weight))

    def zeta(self, u: arb) -> arb:
        """Jacobi's Z(u) = E(am u) - (E/K)u."""
        level = self.level
        turns = round(float(u / level.half))
        rest = u - turns * level.half
        whole = real(acb(level.m).elliptic_e()) / level.K
        part = real(acb.elliptic_e_inc(acb(level.amplitude(rest)), acb(level.m)))
        return middle(part - whole * rest)

    def chord(self, u: arb, after: arb) -> arb:
        """M(a) - D(2w/y + 2Z(a) - (Z(u~) - Z(u))), a = (u~ - u)/2: (5.15) in chord form, 0 along an orbit."""
        half = middle((after - u) / 2)
        w, y, _, _ = self._parts(half)
        free = 2 * w / y + 2 * self.zeta(half)
        return middle(self.momentum(half) - self.level.D * (free - self.zeta(after) + self.zeta(u)))

    def law(self, steps: int, half_turns: int) -> arb:
        """The amplitude of the displacement at p/q to lowest order in D, in half turns: D²|A''|π²q²/(K³ sinh(qη)).

        A inverts M, at a = Kp/q; η = πK'/K.  To second order in D the map is u ↦ u + const + a coboundary + A''(ΔZ)²D²
        and the orbit's sum of (ΔZ)² has the q-th Fourier coefficient (2π²/K²) q²/sinh(qη).
        """
        level = self.level
        a = middle(level.K * half_turns / steps)
        e = arb(10) ** -(ctx.dps // 5)
        before, at, after = (self.momentum(a + x) for x in (-e, arb(0), e))
        slope, bend = (after - before) / (2 * e), (after - 2 * at + before) / (e * e)
        eta = arb.pi() * level.complement / level.K
        size = level.D**2 * abs(bend / slope**3) * (arb.pi() * steps) ** 2
        return middle(size / (level.K**3 * (steps * eta).sinh()))
