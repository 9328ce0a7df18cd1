"""Certificates of kind energy-drift: a closed orbit of the continuous ball on which the energy of the map drifts.

For the continuous ball, its integrals and a rigorous time step, see rolling.py.

The drift.  A step of the map, of size ε, is that of the continuous ball with ω + ε²ω₃ for ω, up to ε⁴ (proved by
chapsym's claim modified-field; here it is the definition of X₃), where
    12ω₃ = 2|ω|²ω + ω″ - ω × ω′ - 3B⁻¹f,  f = D(⟨γ, ω′⟩γ′ + ⟨γ′, ω′⟩γ),  Bω′ = Iω × ω,  Bω″ = Iω′ × ω + Iω × ω′ + f.
X₃ is the field (K × ω₃, γ × ω₃).  So X₃(H) = ⟨ω₃, ω × (K + D⟨γ, ω⟩γ)⟩ = ⟨ω₃, ω × Iω⟩.  The continuous ball preserves
the density ⟨γ, IΛ⁻¹γ⟩^(-1/2) = (1 - D⟨γ, Λ⁻¹γ⟩)^(-1/2).  As the fields (K × e, γ × e) have divergence 0, the divergence
of X₃ with respect to this density is
    Σ_j the derivative of the j-th component of ω₃ along (K × e_j, γ × e_j), + D⟨Λ⁻¹γ, γ × ω₃⟩/⟨γ, IΛ⁻¹γ⟩.

The orbit is closed.  Let S = diag(symmetry), a rotation by π or 1, which takes solutions to solutions.
1. On the section, one component has its value at the start.  From every start of the file, S·(solution) returns to it
   exactly once in a window of times (Newton's test), with non-zero speed: so the return is continuous in the start.
2. At the return the component `along` is below its value at the start for one end of the starts, and above it for the
   other: for some start between, both components return to their values.
3. The four integrals have the same values after the return.  With the two components they are injective on a box that
   contains the start and the return, as the 6 × 6 matrix of their derivatives is regular there: so S·(the solution at
   T) is this start, and the orbit is closed after T, or after 2T if S is not 1.
4. The integrals over [0, T] of X₃(H) and of the divergence of X₃ are enclosed for all starts.
"""

from collections.abc import Sequence
from fractions import Fraction
from functools import partial
from math import ceil
from typing import Any

from .document import Data, exact
from .form import HEAD, anything, check_shape
from .interval import Interval, Rejected
from .linear import Vector, cross, dot, plus, solve, units
from .rolling import BITS, Flow, Rolling
from .step import Ball
from .taylor import Model, Numbers, derivatives

STATE = ("K1", "K2", "K3", "gamma1", "gamma2", "gamma3")
SYMMETRIES = ([1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1])
NUMBERS, PAIR = (exact,) * 3, (exact, exact)
FORM = HEAD | {
    "ball": {"J": NUMBERS, "D": exact}, "start": {"momentum": NUMBERS, "gamma": NUMBERS}, "varied": STATE[:3],
    "radius": exact, "symmetry": anything, "periods": range(1, 3), "time": exact, "window": exact, "section": STATE,
    "along": STATE, "bits": range(BITS, 4097), "order": range(8, 1025), "misses": (PAIR, PAIR), "energy": PAIR,
    "density": PAIR,
}  # fmt: skip
INTEGRALS = {"energy": "the integral of X3(H)", "density": "the integral of the divergence of X3"}


def statement(data: Data) -> str:
    """The theorem, with the numbers of the file."""
    ball, start = data["ball"], data["start"]
    return (
        f"The continuous ball with J = ({', '.join(ball['J'])}), D = {ball['D']} has a closed orbit through gamma = "
        f"({', '.join(start['gamma'])}), K = ({', '.join(start['momentum'])}), {data['varied']} up to "
        f"{data['radius']}, of the period {'T' if data['periods'] == 1 else '2T'}; "
        "the integrals over [0, T] of X3(H) and of the divergence of X3 are not 0."
    )


def check_form(data: Data) -> None:
    """Raises Rejected unless the file has all its numbers, in their form."""
    check_shape(data, FORM)
    for name in ("radius", "time", "window"):
        if exact(data[name], name) <= 0:
            raise Rejected(f"{name} must be positive")
    if data["symmetry"] not in SYMMETRIES or not all(type(x) is int for x in data["symmetry"]):
        raise Rejected("symmetry must be the signs of a rotation by half a turn about an axis, or of none")
    if data["periods"] != 1 + (data["symmetry"] != [1, 1, 1]):
        raise Rejected("periods must be 1 where the symmetry is none, otherwise 2")


class Modified(Rolling):
    """The continuous ball, and the leading correction X₃ of the map."""

    def turning(self, state: Numbers) -> Numbers:
        """12ω₃."""
        gamma = state[3:]
        eased, lift = self.inverse(gamma)

        def solved(v: Numbers) -> Numbers:
            return self.solved(v, gamma, eased, lift)

        w = solved(state[:3])
        Iw = self.carried(w)
        a, turn = solved(cross(Iw, w)), cross(gamma, w)
        by_gamma, by_turn = dot(gamma, a) * self.D, dot(turn, a) * self.D
        force = [x * by_gamma + y * by_turn for x, y in zip(turn, gamma, strict=True)]
        second = solved(plus(plus(cross(self.carried(a), w), cross(Iw, a)), force))
        square, aside, pull = dot(w, w) * 2, cross(w, a), solved(force)
        return [x * square + y - z - 3 * f for x, y, z, f in zip(w, second, aside, pull, strict=True)]

    def densities(self, state: Numbers) -> Numbers:
        """12X₃(H) and 12 times the divergence of X₃."""
        K, gamma = state[:3], state[3:]
        along = [[x for v in (K, gamma) for x in _crossed(v, j)] for j in range(3)]
        w, duals = self.spin(state), derivatives(self.turning, state, along)
        turns = [x.value for x in duals]
        eased, lift = self.inverse(gamma)
        spread = dot(eased, cross(gamma, turns)) * lift
        for j in range(3):
            spread = spread + duals[j].slopes[j]
        return dot(turns, cross(w, self.carried(w))), spread


def _crossed(v: Numbers, j: int) -> Numbers:
    """v × e_j."""
    found: list[Any] = [0] * 3
    found[j - 2], found[j - 1] = v[j - 1], -v[j - 2]
    return found


class Orbit:
    """The starts of a certificate, and their returns to the section."""

    def __init__(self, data: Data):
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
        weights = [max(map(abs, momentum))] * 3 + [Fraction(1)] * 3
        fine, self.coarse = (Modified.of(*ball, partial(Model.constant, bits=n)) for n in (self.bits, self.bits // 2))
        boxes, self.ball = (Rolling.of(*ball, partial(Interval.about, bits=n)) for n in (BITS, self.bits))
        self.flow = Flow(fine, boxes, weights, data["order"])

    def returned(self, low: int, high: int, integrals: bool) -> tuple[Vector, Vector, Vector]:
        """The starts from `low` to `high` radii, S·(solution) at the return and, if `integrals`, the two integrals."""
        ends = [[x + self.radius * at * (i == self.varied) for i, x in enumerate(self.start)] for at in (low, high)]
        start = [Interval.enclosing(x, y, self.bits) for x, y in zip(*ends, strict=True)]
        off = [Fraction(x.width + 1, 2 ** (self.bits + 1)) for x in start]  # distance from the middle
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
        """12 times the two integrals over a step, from 0 to s = `end`, computed with half the bits and terms."""
        h, s = (x.rescaled(self.bits // 2) for x in (Interval(length, length, self.bits), end))
        rough = [x.coarser(self.flow.order // 2, self.bits // 2) for x in models]
        return [x.integral().at(s) * h for x in self.coarse.densities(rough)]

    def crossing(self, models: Sequence[Model], length: int, wanted: Interval) -> Interval:
        """The s in the step of the unique return to the section, proved by Newton's test and then refined."""
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

        def told(x: Numbers) -> Numbers:
            K, gamma = x[:3], x[3:]
            return [dot(gamma, gamma), dot(K, K), dot(K, gamma), self.ball.energy(x), x[self.section], x[self.along]]

        try:
            solve([x.slopes for x in derivatives(told, box, units(6, box[0]))], [[x] for x in box])
        except Rejected:
            raise Rejected("the integrals and the two components are not proved to tell states apart") from None


def check(data: Data) -> dict[str, str]:
    """Raises Rejected unless the orbit is closed and its integrals are as stated; returns the proved numbers."""
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
        if not abs(Fraction(data[name][0])) > Fraction(data[name][1]):
            raise Rejected(f"{text} may be 0")
    return {text: f"{data[name][0]} up to {data[name][1]}" for name, text in INTEGRALS.items()}


def check_stated(x: Interval, stated: Sequence[str], where: str) -> None:
    """Raises Rejected unless the interval lies within the stated centre and radius."""
    if not x.within(*map(Fraction, stated)):
        raise Rejected(f"{where} is not proved to be {' up to '.join(stated)}")
