"""Certificates of kind energy-drift: a closed orbit of the continuous ball on which the energy of the map drifts.

The continuous ball.  With I = diag(J2 + J3, J3 + J1, J1 + J2), Λ = I + D, B = Λ - Dγγᵀ and ω = B⁻¹K, |γ| = 1, it is
    K′ = K × ω,  γ′ = γ × ω;  |γ|, |K|, ⟨K, γ⟩ and H = ½⟨K, ω⟩ are integrals,
for the derivative of H is ⟨ω, K′⟩ + D⟨γ, ω⟩⟨γ′, ω⟩ = 0.  With z = Λ⁻¹v, B⁻¹v = z + D⟨γ, z⟩/⟨γ, IΛ⁻¹γ⟩·Λ⁻¹γ; so ω is
also evaluated where |γ| is not 1: it depends on γ/|γ| alone, and the integrals are integrals there, too.

What drifts.  A step of the map, of the size ε, is that of the continuous ball with ω + ε²ω₃ for ω, up to ε⁴ (proved by
chapsym's claim modified-field; here it is the definition of X₃), where
    12ω₃ = 2|ω|²ω + ω″ - ω × ω′ - 3B⁻¹f,  f = D(⟨γ, ω′⟩γ′ + ⟨γ′, ω′⟩γ),  Bω′ = Iω × ω,  Bω″ = Iω′ × ω + Iω × ω′ + f.
X₃ is the field (K × ω₃, γ × ω₃).  So X₃(H) = ⟨ω₃, ω × (K + D⟨γ, ω⟩γ)⟩ = ⟨ω₃, ω × Iω⟩.  The continuous ball keeps the
density ⟨γ, IΛ⁻¹γ⟩^(-1/2) = (1 - D⟨γ, Λ⁻¹γ⟩)^(-1/2).  As the fields (K × e, γ × e) have the divergence 0, that of X₃
with this density is
    Σ_j the derivative of the j-th component of ω₃ along (K × e_j, γ × e_j), + D⟨Λ⁻¹γ, γ × ω₃⟩/⟨γ, IΛ⁻¹γ⟩.

A step.  p(s), 0 ≤ s ≤ 1, is a polynomial near the solutions x(t₀ + hs); any polynomial will do.  Errors are measured by
|e|² = Σ(e_i/w_i)², w the weights; so let A be f′ with the entries a_ij w_j/w_i.  Let |p′ - h f(p)| ≤ d.  In a tube
about a part of p let μ be the greatest sum in a row of ½(A + Aᵀ), with absolute values beside the diagonal, for all
means A of such f′: f(x) - f(p) = A(x - p) for one of them, and ⟨e, Ae⟩ ≤ μ|e|² (Gershgorin).  So a solution that starts
within e of p(0) stays within (e + d)·exp(Σ h max(μ, 0) over the parts) of p (Gronwall), if this is less than the radius
of the tube, which the solution then cannot have left.

Why the orbit is closed.  With S = diag(symmetry), a rotation by π or 1, which takes solutions to solutions:
1. From every start of the file, S·(solution) is back once within a window of times on the section, where one component
   has its value at the start (Newton's test), with a speed that is not 0: so the return is continuous in the start.
2. From the two ends of the starts the component `along` is back below and above its value at the start: for some start
   between, both components are back.
3. The four integrals have the same values after the return.  With the two components they tell any two states of a box
   apart, which contains the start and the return, as the 6 × 6 matrix of their derivatives is regular there: so S·(the
   solution at T) is this start, and the orbit is closed after T, or 2T where S is not 1.
4. The integrals over [0, T] of X₃(H) and of the divergence of X₃ are enclosed for all starts.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import ceil
from operator import mul
from typing import Any

from .document import MOST_STEPS, check_names, count, exact, listed
from .interval import Interval, Rejected
from .linear import Vector, cross, dot, plus, solve
from .step import Ball
from .taylor import Model, derivative

NAMES = (
    "format kind statement ball start varied radius symmetry periods time window section along bits order misses "
    "energy density digest"
)
STATE = ("K1", "K2", "K3", "gamma1", "gamma2", "gamma3")
SYMMETRIES = ([1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1])
INTEGRALS = {"energy": "the integral of X3(H)", "density": "the integral of the divergence of X3"}
#: A step is this part of where the series seems to end; its parts with one μ each, with so many bits; n = 2^ROOTS.
SHARE, PARTS, BITS, ROOTS = 4, 4, 64, 12
#: The radius of the tube, beside the weights.
TUBE = Fraction(1, 2**14)


def statement(data: dict[str, Any]) -> str:
    """What is proved, with the numbers of the file."""
    ball, start = data["ball"], data["start"]
    return (
        f"The continuous ball with J = ({', '.join(ball['J'])}), D = {ball['D']} has a closed orbit through gamma = "
        f"({', '.join(start['gamma'])}), K = ({', '.join(start['momentum'])}), {data['varied']} up to "
        f"{data['radius']}, of the period {'T' if data['periods'] == 1 else '2T'}; "
        "the integrals over [0, T] of X3(H) and of the divergence of X3 are not 0."
    )


def check_form(data: dict[str, Any]) -> None:
    """Raises Rejected unless all numbers are there, in their form."""
    check_names(data, NAMES, "the certificate")
    check_names(data["ball"], "J D", "ball")
    check_names(data["start"], "momentum gamma", "start")
    triples = data["ball"]["J"], data["start"]["momentum"], data["start"]["gamma"]
    for x in [y for triple in triples for y in listed(triple, 3, "J, momentum or gamma")]:
        exact(x, "a number of ball or start")
    for name in ("radius", "time", "window"):
        if exact(data[name], name) <= 0:
            raise Rejected(f"{name} must be positive")
    exact(data["ball"]["D"], "D")
    for pair in [*listed(data["misses"], 2, "misses"), data["energy"], data["density"]]:
        for x in listed(pair, 2, "an enclosure: a centre and a radius"):
            exact(x, "a number of an enclosure")
    if data["symmetry"] not in SYMMETRIES or not all(type(x) is int for x in data["symmetry"]):
        raise Rejected("symmetry must be the signs of a rotation by half a turn about an axis, or of none")
    if data["periods"] != 1 + (data["symmetry"] != [1, 1, 1]):
        raise Rejected("periods must be 1 where the symmetry is none, otherwise 2")
    if data["varied"] not in STATE[:3] or data["section"] not in STATE or data["along"] not in STATE:
        raise Rejected(f"varied must be one of {', '.join(STATE[:3])}, section and along of {', '.join(STATE)}")
    count(data["bits"], BITS, 4096, "bits")
    count(data["order"], 8, 1024, "order")


@dataclass(frozen=True)
class Rolling:
    """The continuous ball, in intervals or models; states are K and γ in one list, of such, or of duals over them."""

    inertia: Sequence[Any]
    D: Any
    slowness: Sequence[Any]

    @classmethod
    def of(cls, inertia: Sequence[Fraction], D: Fraction, number: Any) -> "Rolling":
        """With the numbers that `number` makes of fractions."""
        return cls([number(x) for x in inertia], number(D), [number(1 / (x + D)) for x in inertia])

    def inverse(self, gamma: Sequence[Any]) -> tuple[list[Any], Any]:
        """Λ⁻¹γ and D/⟨γ, IΛ⁻¹γ⟩."""
        eased = self.eased(gamma)
        return eased, 1 / dot(self.carried(gamma), eased) * self.D

    def eased(self, v: Sequence[Any]) -> list[Any]:
        """Λ⁻¹v."""
        return [x * s for x, s in zip(v, self.slowness, strict=True)]

    def spin(self, state: Sequence[Any]) -> list[Any]:
        """ω."""
        return self.solved(state[:3], state[3:], *self.inverse(state[3:]))

    def solved(self, v: Sequence[Any], gamma: Sequence[Any], eased: Sequence[Any], lift: Any) -> list[Any]:
        """B⁻¹v."""
        near = self.eased(v)
        share = dot(gamma, near) * lift
        return [x + y * share for x, y in zip(near, eased, strict=True)]

    def field(self, state: Sequence[Any]) -> list[Any]:
        """(K′, γ′)."""
        w = self.spin(state)
        return [*cross(state[:3], w), *cross(state[3:], w)]

    def energy(self, state: Sequence[Any]) -> Any:
        """2H."""
        return dot(state[:3], self.spin(state))

    def turning(self, state: Sequence[Any]) -> list[Any]:
        """12ω₃."""
        gamma = state[3:]
        eased, lift = self.inverse(gamma)

        def solved(v: Sequence[Any]) -> list[Any]:
            return self.solved(v, gamma, eased, lift)

        w = solved(state[:3])
        Iw = self.carried(w)
        a, turn = solved(cross(Iw, w)), cross(gamma, w)
        by_gamma, by_turn = dot(gamma, a) * self.D, dot(turn, a) * self.D
        force = [x * by_gamma + y * by_turn for x, y in zip(turn, gamma, strict=True)]
        second = solved(plus(plus(cross(self.carried(a), w), cross(Iw, a)), force))
        square, aside, pull = dot(w, w) * 2, cross(w, a), solved(force)
        return [x * square + y - z - 3 * f for x, y, z, f in zip(w, second, aside, pull, strict=True)]

    def carried(self, w: Sequence[Any]) -> list[Any]:
        """Iw."""
        return [x * i for x, i in zip(w, self.inertia, strict=True)]

    def densities(self, state: Sequence[Any]) -> tuple[Any, Any]:
        """12X₃(H), and 12 times the divergence of X₃."""
        K, gamma = state[:3], state[3:]
        w, turns = self.spin(state), self.turning(state)
        eased, lift = self.inverse(gamma)
        spread = dot(eased, cross(gamma, turns)) * lift
        for j in range(3):
            along = [x for v in (K, gamma) for x in _crossed(v, j)]
            spread = spread + derivative(self.turning, state, along)[j]
        return dot(turns, cross(w, self.carried(w))), spread


def _crossed(v: Sequence[Any], j: int) -> list[Any]:
    """v × e_j."""
    found = [0 * v[0]] * 3
    found[j - 2], found[j - 1] = v[j - 1], -v[j - 2]
    return found


class Flow:
    """Solutions of the continuous ball, step by step; states and times are integers, in units of 2^-bits."""

    def __init__(self, ball: tuple[list[Fraction], Fraction], size: Fraction, bits: int, order: int):
        self.bits, self.order, self.weights = bits, order, [size] * 3 + [Fraction(1)] * 3
        self.fine = Rolling.of(*ball, lambda x: Model.constant(x, bits))
        self.coarse = Rolling.of(*ball, lambda x: Model.constant(x, bits // 2))
        self.boxes = Rolling.of(*ball, lambda x: number(x, BITS))
        self.ratios = [[number(v / w, BITS) for v in self.weights] for w in self.weights]
        self.steps = 0

    def step(self, start: Sequence[int], error: Fraction, most: int) -> tuple[list[Model], int, Fraction]:
        """A step of at most this length from all states within `error` of the start: models, its length, the error."""
        self.steps += 1
        if self.steps > MOST_STEPS:
            raise Rejected(f"the orbit takes more than {MOST_STEPS} steps")
        terms = self.polynomials(start)
        length = min(self.length(terms), most)
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

    def polynomials(self, start: Sequence[int]) -> list[list[int]]:
        """The start, and coefficients near those of the solution in the time: nothing rests on them."""
        state = [[x] for x in start]
        (D,), slow = self.fine.D.terms, [x.terms[0] for x in self.fine.slowness]
        weights = [x.terms[0] for x in self.fine.carried(self.fine.slowness)]
        K, gamma = state[:3], state[3:]
        below: list[int] = []
        lift: list[int] = []
        w: list[list[int]] = [[], [], []]

        def product(x: Sequence[int], y: Sequence[int]) -> int:
            """The newest coefficient of x·y."""
            return sum(map(mul, x, reversed(y))) >> self.bits

        for k in range(self.order - 1):
            squares, products = ([product(x, y) for x, y in zip(v, gamma, strict=True)] for v in (gamma, K))
            below.append(dot(weights, squares) >> self.bits)
            force = D * dot(slow, products) >> self.bits
            lift.append((force - sum(map(mul, below[1:], reversed(lift)))) // below[0])
            for spin, s, x, y in zip(w, slow, K, gamma, strict=True):
                spin.append(s * (x[k] + product(y, lift)) >> self.bits)
            for v in (K, gamma):
                rates = [product(v[i - 2], w[i - 1]) - product(v[i - 1], w[i - 2]) for i in range(3)]
                for x, rate in zip(v, rates, strict=True):
                    x.append(rate // (k + 1))
        return state

    def length(self, terms: Sequence[Sequence[int]]) -> int:
        """A length of at most 1, at which the k-th terms are SHARE^-k, about; nothing rests on it."""
        parts, unit = 1 << 12, 12
        for k in (self.order - 2, self.order - 1):
            for x, w in zip(terms, self.weights, strict=True):
                while abs(x[k]) * (SHARE * parts) ** k > ceil(w) << self.bits + unit * k:
                    parts = parts * 7 >> 3
        return parts << self.bits - unit

    def defect(self, middle: Sequence[Model], length: int) -> Fraction:
        """A bound of |p′ - h f(p)|."""
        h, bound = Model([length], 0, self.bits), Fraction(0)
        for p, rate, w in zip(middle, self.fine.field(middle), self.weights, strict=True):
            off = rate * h - Model([k * x for k, x in enumerate(p.terms)][1:], 0, self.bits)
            bound += off.most / w
        return bound / 2**self.bits

    def growth(self, middle: Sequence[Model], length: int) -> Fraction:
        """A bound of exp(Σ h max(μ, 0)): by exp(x) ≤ (1 - x/n)⁻ⁿ, 0 ≤ x < n."""
        total = Fraction(0)
        rough = [x.coarser(self.order, BITS) for x in middle]
        for part in range(PARTS):
            s = Interval.enclosing(Fraction(part, PARTS), Fraction(part + 1, PARTS), BITS)
            tube = [x.at(s).wider(ceil(TUBE * w * 2**BITS)) for x, w in zip(rough, self.weights, strict=True)]
            total += max(self.norm(tube), Fraction(0)) / PARTS
        root = number(1 - total * Fraction(length, 2 ** (self.bits + ROOTS)), BITS)
        if not root > 0:
            raise Rejected("a step is too long for its bound")
        for _ in range(ROOTS):
            root = root * root
        return Fraction((1 / root).hi, 2**BITS)

    def norm(self, box: Sequence[Interval]) -> Fraction:
        """μ on a box."""
        one, zero, six = box[0]._of(1), box[0]._of(0), range(6)
        columns = [derivative(self.boxes.field, box, [one if i == j else zero for i in six]) for j in six]
        a = [[columns[j][i] * self.ratios[i][j] for j in six] for i in six]
        rows = [2 * a[i][i].hi + sum((a[i][j] + a[j][i]).most for j in six if j != i) for i in six]
        return Fraction(max(rows), 2 ** (BITS + 1))

    def densities(self, models: Sequence[Model]) -> tuple[Model, Model]:
        """12X₃(H), and 12 times the divergence of X₃, along a step: with half the bits and terms."""
        return self.coarse.densities([x.coarser(self.order // 2, self.bits // 2) for x in models])


class Orbit:
    """The starts of a certificate, and how they return."""

    def __init__(self, data: dict[str, Any]):
        J, D, self.bits = [Fraction(x) for x in data["ball"]["J"]], Fraction(data["ball"]["D"]), data["bits"]
        Ball.within(J, D, Fraction(0), self.bits)
        momentum, gamma = ([Fraction(x) for x in data["start"][name]] for name in ("momentum", "gamma"))
        if sum(x * x for x in gamma) != 1:
            raise Rejected("gamma must be a unit vector")
        self.start, self.radius = [*momentum, *gamma], Fraction(data["radius"])
        self.varied, self.section, self.along = (STATE.index(data[name]) for name in ("varied", "section", "along"))
        self.signs = data["symmetry"] * 2
        time, window = Fraction(data["time"]), Fraction(data["window"])
        if window >= time:
            raise Rejected("the window must be shorter than the time")
        self.early, self.window = int((time - window) * 2**self.bits), ceil(2 * window * 2**self.bits)
        ball = [sum(J) - x for x in J], D
        self.flow = Flow(ball, max(map(abs, momentum)), self.bits, data["order"])
        self.ball = Rolling.of(*ball, lambda x: number(x, self.bits))

    def returned(self, low: int, high: int, integrals: bool) -> tuple[Vector, Vector, Vector]:
        """The starts from low to high radii, S·(solution) back on the section, and, if wanted, the two integrals."""
        ends = [[x + self.radius * at * (i == self.varied) for i, x in enumerate(self.start)] for at in (low, high)]
        start = [Interval.enclosing(x, y, self.bits) for x, y in zip(*ends, strict=True)]
        off = [Fraction(x.width + 1, 2 ** (self.bits + 1)) for x in start]  # from the middle
        error = sum((x / w for x, w in zip(off, self.flow.weights, strict=True)), Fraction(0))
        totals: Vector = [Interval(0, 0, self.bits // 2)] * 2
        now, state = 0, [x.point().lo for x in start]
        while now < self.early:
            models, length, error = self.flow.step(state, error, self.early - now)
            state, now = [sum(x.terms) for x in models], now + length
            if integrals:
                totals = plus(totals, self.integrals(models, length, Interval(1, 1, 0)))
        models, length, _ = self.flow.step(state, error, self.window)
        back = self.crossing(models, length, start[self.section])
        if integrals:
            totals = plus(totals, self.integrals(models, length, back))
        found = [x.at(back) * s for x, s in zip(models, self.signs, strict=True)]
        return start, found, [x / 12 for x in totals]

    def integrals(self, models: Sequence[Model], length: int, end: Interval) -> Vector:
        """12 times the two integrals over a step, from 0 to s = `end`."""
        h, s = (x.rescaled(self.bits // 2) for x in (Interval(length, length, self.bits), end))
        return [x.integral().at(s) * h for x in self.flow.densities(models)]

    def crossing(self, models: Sequence[Model], length: int, wanted: Interval) -> Interval:
        """Where in the step the component of the section is back, once: by Newton's test, and then closer."""
        h, sign = Interval(length, length, self.bits), self.signs[self.section]
        within, proved = Interval(0, 1 << self.bits, self.bits), False
        while True:
            middle = within.point()
            speed = self.ball.field([x.at(within) for x in models])[self.section] * h * sign
            if not speed.sign:
                raise Rejected("the return is not proved to cross the section")
            closer = middle - (models[self.section].at(middle) * sign - wanted) / speed
            if not closer.inside(within):
                break
            within, proved = closer, True
        if not proved:
            raise Rejected("the return to the section is not proved to be in the window")
        return within

    def check_told_apart(self, box: Vector) -> None:
        """Raises Rejected unless the integrals and the two components are injective on a box."""
        one, zero = box[0]._of(1), box[0]._of(0)

        def told(x: Sequence[Any]) -> list[Any]:
            K, gamma = x[:3], x[3:]
            return [dot(gamma, gamma), dot(K, K), dot(K, gamma), self.ball.energy(x), x[self.section], x[self.along]]

        try:
            columns = [derivative(told, box, [one if i == j else zero for i in range(6)]) for j in range(6)]
            solve(columns, [[x] for x in box])
        except Rejected:
            raise Rejected("the integrals and the two components are not proved to tell states apart") from None


def check(data: dict[str, Any]) -> dict[str, str]:
    """Raises Rejected unless the orbit is closed and its integrals as stated; returns the numbers that were proved."""
    orbit, misses = Orbit(data), []
    for end, stated in zip((-1, 1), data["misses"], strict=True):
        start, found, _ = orbit.returned(end, end, integrals=False)
        misses.append(found[orbit.along] - start[orbit.along])
        check_stated(misses[-1], stated, "a miss")
    if misses[0].sign * misses[1].sign != -1:
        raise Rejected("the return is not proved to cross the start between the two ends")
    start, found, integrals = orbit.returned(-1, 1, integrals=True)
    orbit.check_told_apart([x.hull(y) for x, y in zip(start, found, strict=True)])
    for x, (name, text) in zip(integrals, INTEGRALS.items(), strict=True):
        check_stated(x, data[name], text)
        if not x.sign:
            raise Rejected(f"{text} may be 0")
    return {text: f"{data[name][0]} up to {data[name][1]}" for name, text in INTEGRALS.items()}


def check_stated(x: Interval, stated: Sequence[str], where: str) -> None:
    """Raises Rejected unless all numbers here are within what is stated, a centre and a radius."""
    if not x.within(*map(Fraction, stated)):
        raise Rejected(f"{where} is not proved to be {' up to '.join(stated)}")


def number(x: Fraction, bits: int) -> Interval:
    """One number."""
    return Interval.enclosing(x, x, bits)
