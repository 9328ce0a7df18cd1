"""The motion of the continuous ball by another way: extrapolated midpoint steps of ω and R, with far more digits.

It shares nothing with what it judges: B(γ)ω' = (Iω + a) × ω with B(γ) = I + D(|γ|² - γγᵀ) solved by elimination,
R' = Rω̂ for the rows of R, the last of which is γ, and r' = ρω × e₃ in space.  Gragg's midpoint rule has an error in
even powers of its step, and Aitken-Neville takes these away.  The numbers are the middles of balls of 480 bits.
"""

from fractions import Fraction

from flint import arb, arb_mat, ctx, fmpq

BITS, COLUMNS = 480, 20
#: Radians of the first step; a step is halved while the last two columns differ by more than SMALL.
TURN, SMALL = Fraction(1, 3), 1e-33


def number(x):
    x = Fraction(x)
    return arb(fmpq(x.numerator, x.denominator))


def cross(x, y):
    return [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]]


def matrix_of(quaternion):
    """The rows of the rotation of a quaternion of any length, as x ↦ qxq⁻¹."""
    a, b, c, d = quaternion
    n = a * a + b * b + c * c + d * d
    return [
        [(a * a + b * b - c * c - d * d) / n, 2 * (b * c - a * d) / n, 2 * (b * d + a * c) / n],
        [2 * (b * c + a * d) / n, (a * a - b * b + c * c - d * d) / n, 2 * (c * d - a * b) / n],
        [2 * (b * d - a * c) / n, 2 * (c * d + a * b) / n, (a * a - b * b - c * c + d * d) / n],
    ]


class Truth:
    """The motion from ω and a quaternion, in the axes of the body; call `at` with later and later times."""

    def __init__(self, mass_tensor, D, omega, quaternion, radius=1, rotor=(0, 0, 0)):
        with ctx.workprec(BITS):
            J1, J2, J3 = map(number, mass_tensor)
            self.inertia, self.D, self.radius = (J2 + J3, J1 + J3, J1 + J2), number(D), number(radius)
            self.rotor = list(map(number, rotor))
            rows = matrix_of([number(x) for x in quaternion])
            self.y = [*map(number, omega), *(x for row in rows for x in row), arb(0), arb(0)]
            self.time = Fraction(0)
            rate = max(0.01, *(abs(float(x)) for x in self.y[:3]))
            self.length = TURN / Fraction(rate).limit_denominator(1000)

    def at(self, time):
        """K, γ, ω, the rows of R and the contact point: lists of numbers."""
        with ctx.workprec(BITS):
            while self.time < time:
                step = min(self.length, Fraction(time) - self.time)
                try:
                    found, error = self.step(number(step))
                except ZeroDivisionError:  # of a fast rotor: so long a step goes anywhere
                    error = arb("inf")
                if not error < SMALL:
                    self.length = step / 2
                    continue
                self.y, self.time = found, self.time + step
                self.length = max(self.length, step) * Fraction(9, 8)
            w, rows = self.y[:3], [self.y[3:6], self.y[6:9], self.y[9:12]]
            own = (self.carried(rows[2]) * arb_mat(3, 1, w)).entries()
            K = [x + y for x, y in zip(own, self.rotor, strict=True)]
            return {"angular_momentum": K, "gamma": rows[2], "omega": w, "rows": rows, "contact": self.y[12:]}

    def carried(self, g):
        """B(γ), with |γ|² in the place of 1: the midpoints are not on the sphere."""
        one = sum(x * x for x in g)
        entries = [
            self.inertia[i] * (i == j) + self.D * (one * (i == j) - g[i] * g[j]) for i in range(3) for j in range(3)
        ]
        return arb_mat(3, 3, entries)

    def field(self, y):
        w, rows = y[:3], [y[3:6], y[6:9], y[9:12]]
        torque = cross([a * b + c for a, b, c in zip(self.inertia, w, self.rotor, strict=True)], w)
        rate = self.carried(rows[2]).solve(arb_mat(3, 1, torque)).entries()
        space = [sum(a * b for a, b in zip(row, w, strict=True)) for row in rows[:2]]
        return [*rate, *(x for row in rows for x in cross(row, w)), self.radius * space[1], -self.radius * space[0]]

    def step(self, length):
        table = before_last = []
        for j in range(1, COLUMNS + 1):
            row = [self.midpoints(length, 2 * j)]
            for i, before in enumerate(table):
                ratio = arb(j * j) / ((j - 1 - i) ** 2)
                row.append([(x * ratio - y) / (ratio - 1) for x, y in zip(row[i], before, strict=True)])
            before_last, table = table, row
        error = max(abs(x - y) for x, y in zip(table[-1], before_last[-1], strict=True))
        return [x.mid() for x in table[-1]], error

    def midpoints(self, length, count):
        h = length / count
        before, now = self.y, [(x + h * d).mid() for x, d in zip(self.y, self.field(self.y), strict=True)]
        for _ in range(count - 1):
            before, now = now, [(x + 2 * h * d).mid() for x, d in zip(before, self.field(now), strict=True)]
        ends = self.field(now)
        return [((x + y + h * d) / 2).mid() for x, y, d in zip(now, before, ends, strict=True)]
