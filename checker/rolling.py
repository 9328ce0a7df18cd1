"""The continuous ball, and a rigorous time step.

With I = diag(J2 + J3, J3 + J1, J1 + J2), Λ = I + D, B = Λ - Dγγᵀ and ω = B⁻¹K, |γ| = 1, the equations of motion are
    K′ = K × ω,  γ′ = γ × ω;  |γ|, |K|, ⟨K, γ⟩ and H = ½⟨K, ω⟩ are integrals,
as the derivative of H is ⟨ω, K′⟩ + D⟨γ, ω⟩⟨γ′, ω⟩ = 0.  With z = Λ⁻¹v, B⁻¹v = z + D⟨γ, z⟩/⟨γ, IΛ⁻¹γ⟩·Λ⁻¹γ.  This
formula also defines ω for |γ| ≠ 1: ω depends on γ only by γ/|γ|, and the integrals are integrals there, too.

A step.  p(s), 0 ≤ s ≤ 1, is a polynomial near the solutions x(t₀ + hs); any polynomial will do.  Errors are measured by
|e|² = Σ(e_i/w_i)², w the weights; so let A be f′ with the entries a_ij w_j/w_i.  Let |p′ - h f(p)| ≤ d.  In a tube
about a part of p let μ be the greatest row sum of ½(A + Aᵀ), with absolute values off the diagonal, over all means A of
such f′: f(x) - f(p) = A(x - p) for one of them, and ⟨e, Ae⟩ ≤ μ|e|² (Gershgorin).  So a solution that starts within
|e| ≤ e₀ of p(0) stays within (e₀ + d)·exp(Σ h max(μ, 0) over the parts) of p (Gronwall), if this is less than the
radius of the tube: then the solution cannot have left the tube.  Antisymmetric parts of f′ do not change μ.  So f′e
omits the terms e_K × ω and e_γ × ω, which are antisymmetric, as the weights are equal within each vector.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import ceil
from operator import mul
from typing import Any, Self

from .document import MOST_STEPS
from .interval import Interval, Rejected
from .linear import cross, dot, units
from .taylor import Model, Numbers, derivatives

#: A step is the estimated convergence radius / SHARE; it has PARTS parts with one μ each, in BITS bits; n = 2^ROOTS.
SHARE, PARTS, BITS, ROOTS = 4, 4, 64, 12
#: The most steps · order² · bits: some minutes.
MOST_WORK = 3_000_000_000
#: The radius of the tube, in units of the weights.
TUBE = Fraction(1, 2**14)


@dataclass(frozen=True)
class Rolling:
    """The continuous ball, with intervals, models, or duals of these; a state is one list of K and γ."""

    inertia: Numbers
    D: Any
    slowness: Numbers

    @classmethod
    def of(cls, inertia: Sequence[Fraction], D: Fraction, number: Any, *rest: Any) -> Self:
        """The ball with its moments and D converted from fractions by `number`."""
        return cls([number(x) for x in inertia], number(D), [number(1 / (x + D)) for x in inertia], *rest)

    def inverse(self, gamma: Numbers) -> tuple[Numbers, Any]:
        """Λ⁻¹γ and D/⟨γ, IΛ⁻¹γ⟩."""
        eased = self.eased(gamma)
        return eased, 1 / dot(self.carried(gamma), eased) * self.D

    def eased(self, v: Numbers) -> Numbers:
        """Λ⁻¹v."""
        return [x * s for x, s in zip(v, self.slowness, strict=True)]

    def spin(self, state: Numbers) -> Numbers:
        """ω."""
        return self.solved(state[:3], state[3:], *self.inverse(state[3:]))

    def solved(self, v: Numbers, gamma: Numbers, eased: Numbers, lift: Any) -> Numbers:
        """B⁻¹v."""
        near = self.eased(v)
        share = dot(gamma, near) * lift
        return [x + y * share for x, y in zip(near, eased, strict=True)]

    def turned(self, state: Numbers, w: Numbers) -> Numbers:
        """(K × w, γ × w): linear in the state, with an antisymmetric matrix."""
        return [*cross(state[:3], w), *cross(state[3:], w)]

    def field(self, state: Numbers) -> Numbers:
        """(K′, γ′)."""
        return self.turned(state, self.spin(state))

    def stretch(self, state: Numbers) -> list[Numbers]:
        """The columns of the derivative of the field without the antisymmetric terms (e_K × ω, e_γ × ω)."""
        spins = derivatives(self.spin, state, units(len(state), state[0]))
        return [self.turned(state, w) for w in zip(*(x.slopes for x in spins), strict=True)]

    def energy(self, state: Numbers) -> Any:
        """2H."""
        return dot(state[:3], self.spin(state))

    def carried(self, w: Numbers) -> Numbers:
        """Iw."""
        return [x * i for x, i in zip(w, self.inertia, strict=True)]

    def series(self, start: Sequence[int], order: int) -> list[list[int]]:
        """The start and approximate Taylor coefficients of the solution in time; no proof depends on their accuracy."""
        return self.series_with_spin(start, order)[0]

    def series_with_spin(
        self, start: Sequence[int], order: int, rotor: Sequence[int] = ()
    ) -> tuple[list[list[int]], list[list[int]]]:
        """The series of the state and of ω, optionally with a rotor."""
        state = [[x] for x in start]
        K, gamma = state[:3], state[3:]
        own = [[x[0] - y] for x, y in zip(K, rotor, strict=True)] if rotor else K
        (D,), bits, slow = self.D.terms, self.D.bits, [x.terms[0] for x in self.slowness]
        weights = [x.terms[0] for x in self.carried(self.slowness)]
        below: list[int] = []
        lift: list[int] = []
        w: list[list[int]] = [[], [], []]
        for k in range(order - 1):
            squares, products = ([newest(x, y) >> bits for x, y in zip(v, gamma, strict=True)] for v in (gamma, own))
            below.append(dot(weights, squares) >> bits)
            if not below[0]:
                raise Rejected("the ball does not resist a turn about the vertical: its rotation does not follow")
            force = D * dot(slow, products) >> bits
            lift.append((force - sum(map(mul, below[1:], reversed(lift)))) // below[0])
            for spin, s, x, y in zip(w, slow, own, gamma, strict=True):
                spin.append(s * (x[k] + (newest(y, lift) >> bits)) >> bits)
            for v in (K, gamma):
                rates = [newest(v[i - 2], w[i - 1]) - newest(v[i - 1], w[i - 2]) for i in range(3)]
                for x, rate in zip(v, rates, strict=True):
                    x.append((rate >> bits) // (k + 1))
            if rotor:
                for x, y in zip(own, K, strict=True):
                    x.append(y[-1])
        return state, w


class Flow:
    """Enclosures of solutions of the continuous ball, step by step; states and times are integers, in units of 2^-bits.

    fine, boxes: the ball with models of `bits` bits, and with intervals of BITS.  weights: equal within each vector.
    """

    def __init__(self, fine: Rolling, boxes: Rolling, weights: Sequence[Fraction], order: int):
        self.fine, self.boxes, self.bits, self.order, self.weights = fine, boxes, fine.D.bits, order, weights
        self.ratios = [[Interval.about(v / w, BITS) for v in self.weights] for w in self.weights]
        self.steps = 0

    def step(self, start: Sequence[int], error: Fraction, most: int) -> tuple[list[Model], int, Fraction]:
        """A step of length `most` at most from all states within `error` of the start: models, length, new error."""
        self.steps += 1
        if self.steps > MOST_STEPS:
            raise Rejected(f"the motion takes more than {MOST_STEPS} steps")
        if self.steps * self.order**2 * self.bits > MOST_WORK:
            raise Rejected(
                "the motion takes longer than a reader can wait for: take less time, fewer bits, a lower order"
            )
        terms = self.fine.series(start, self.order)
        length = min(self.length(terms), most)
        if length <= 0:
            raise Rejected("the motion is too fast for its units: a step has no length")
        power = 1 << self.bits
        for k in range(1, self.order):
            power = power * length >> self.bits
            for x in terms:
                x[k] = x[k] * power >> self.bits
        middle = [Model(x, 0, self.bits) for x in terms]
        error, unit = (error + self.defect(middle, length)) * self.growth(middle, length), 4**self.bits
        error = Fraction(ceil(error * unit), unit)
        if error >= TUBE:
            raise Rejected("the solutions are not enclosed: the starts are too far apart, or the time is too long")
        return [x.wider(error * w * 2**self.bits) for x, w in zip(middle, self.weights, strict=True)], length, error

    def length(self, terms: Sequence[Sequence[int]]) -> int:
        """A length, at most 1, for which the k-th terms are about SHARE^-k; no proof depends on it."""
        parts, unit = 1 << 12, 12
        for k in (self.order - 2, self.order - 1):
            for x, w in zip(terms, self.weights, strict=True):
                while abs(x[k]) * (SHARE * parts) ** k > ceil(w) << self.bits + unit * k:
                    parts = parts * 7 >> 3
        return parts << self.bits - unit

    def defect(self, middle: Sequence[Model], length: int) -> Fraction:
        """A bound for |p′ - h f(p)|."""
        h, bound = Model([length], 0, self.bits), Fraction(0)
        for p, rate, w in zip(middle, self.fine.field(middle), self.weights, strict=True):
            off = rate * h - Model([k * x for k, x in enumerate(p.terms)][1:], 0, self.bits)
            bound += off.most / w
        return bound / 2**self.bits

    def growth(self, middle: Sequence[Model], length: int) -> Fraction:
        """A bound for exp(Σ h max(μ, 0)), by exp(x) ≤ (1 - x/n)⁻ⁿ, 0 ≤ x < n."""
        total = Fraction(0)
        rough = [x.coarser(self.order, BITS) for x in middle]
        for part in range(PARTS):
            s = Interval.enclosing(Fraction(part, PARTS), Fraction(part + 1, PARTS), BITS)
            tube = [x.at(s).wider(ceil(TUBE * w * 2**BITS)) for x, w in zip(rough, self.weights, strict=True)]
            total += max(self.norm(tube), Fraction(0)) / PARTS
        root = Interval.about(1 - total * Fraction(length, 2 ** (self.bits + ROOTS)), BITS)
        if not root > 0:
            raise Rejected("a step is too long for its bound")
        for _ in range(ROOTS):
            root = root * root
        return Fraction((1 / root).hi, 2**BITS)

    def norm(self, box: Sequence[Interval]) -> Fraction:
        """μ on a box."""
        columns = self.boxes.stretch(box)
        all_ = range(len(columns))
        a = [[columns[j][i] * self.ratios[i][j] for j in all_] for i in all_]
        rows = [2 * a[i][i].hi + sum((a[i][j] + a[j][i]).most for j in all_ if j != i) for i in all_]
        return Fraction(max(rows), 2 ** (BITS + 1))


def newest(x: Sequence[int], y: Sequence[int]) -> int:
    """The last coefficient of the product of two series of equal length."""
    return sum(map(mul, x, reversed(y)))
