"""The modified equations of the map and what they do to the energy: lemmas of chapsym, which the paper does not state."""

from functools import cache

import numpy as np
import sympy as sp

from chapsym.derive import continuous, gibbs, modified, three
from chapsym.derive.limits import omega
from chapsym.derive.modified import INERTIA, carried, rate, second, share
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import J1, J2, J3, D, K, gamma, placed
from chapsym.proofs.map.symmetries import HALF_TURNS, MIRRORS, turned
from chapsym.proofs.second_routes import Array, Identity, array, identity, inverse, mutated, parameters, unit
from chapsym.prove import Equation, Fact, Proof, Theorem, claim, equations, main

X = sp.Matrix(sp.symbols("v1:4"))
MOVING = gamma.cross(omega)
#: The ring of free symbols: no relations; |γ| is any constant.
FREE = Quotient((*omega, *rate, *second, *share, *X, *gamma, J1, J2, J3, D), [])


@cache
def on_rate() -> Quotient:
    """The ring in which ω' is that of the continuous ball; built on demand, as its Gröbner basis takes time."""
    relations = [sp.expand(x) for x in carried(rate) - modified.torque()]
    return Quotient((*rate, *gamma, *omega, J1, J2, J3, D), relations)


equal = equations(FREE)


def inertia_along(direction: sp.Matrix, x: sp.Matrix) -> sp.Matrix:
    """The derivative of B(γ)x in γ along `direction`."""
    return sp.Matrix(modified.along(carried(x), direction))


def second_torque() -> sp.Matrix:
    """B(γ)ω'' along the continuous ball, a polynomial in ω, ω', γ."""
    return (INERTIA * rate).cross(omega) + (INERTIA * omega).cross(rate) - inertia_along(MOVING, rate)


COMPACT = "K = 𝒦/ε and γ are in a compact set, and ε is so small that small-branch holds"
FIELD = "Φ_ε = exp(εX₁ + ε³X₃) + O(ε⁴), with ω + ε²ω₃ in the place of ω, uniformly"
TURNS = "u = εω/2 + ε²ω'/4 + ε³u₃ turns every vector as the flow of ω + ε²ω₃ does, up to O(ε⁴)"
ENERGY = "H∘Φ_ε = H + ε³X₃(H) + O(ε⁴), X₃(H) = (D/4)⟨γ,ω'⟩⟨γ',ω'⟩"
KEPT = "div_μ X₁ = 0: μ is the invariant density of the continuous ball"
COMMUTES = "Φ commutes with γ ↦ -γ and with (𝒦, γ) ↦ (S𝒦, Sγ)"
CANCELS = "∮X₃(H)dt = 0 over a closed orbit that a reversal takes to itself"


@claim(
    "modified-field",
    r"\Phi_\varepsilon = \exp(\varepsilon X_1 + \varepsilon^3X_3) + O(\varepsilon^4):\ \dot\gamma = \gamma\times\tilde\Omega,\ "
    r"\dot K = K\times\tilde\Omega,\ \tilde\Omega = \omega + \varepsilon^2\omega_3",
    uses=["gibbs", "gibbs-rotation", "small-branch", "self-adjoint", "2.5-inverse"],
)
def modified_field(p: Proof) -> None:
    """The step of size ε is the time-ε flow of the continuous ball with ω + ε²ω₃ in the place of ω, up to O(ε⁴)."""
    p.assume(
        "K = 𝒦/ε and γ in a compact set, ε so small that small-branch holds: u is analytic in ε, K, γ, and 0 at ε = 0"
    )
    p.state(Theorem((), (COMPACT,), (FIELD,)))
    p.say("ω' and ω'' are the derivatives of ω along the continuous ball γ̇ = γ × ω, K̇ = K × ω; from K = B(γ)ω:")
    p.lemma(equal("d/dt(Bω - K) = Bω' - Iω × ω", inertia_along(MOVING, omega) + carried(rate) - carried(omega).cross(omega),
                  carried(rate) - modified.torque()))  # fmt: skip
    momentum, both, tip = carried(omega), omega + rate, gamma + MOVING
    p.lemma(
        equal("Iω × ω = K × ω + D⟨γ,ω⟩γ × ω", modified.torque(), (momentum + D * gamma.dot(omega) * gamma).cross(omega))
    )
    p.show("B ω'", modified.torque())
    p.show("load", modified.load())
    contact = gamma.dot(rate) * MOVING + MOVING.dot(rate) * gamma
    swing = omega.cross(INERTIA * rate) + rate.cross(INERTIA * omega)
    p.lemma(equal("Bω'' = D(⟨γ,ω'⟩γ̇ + ⟨γ̇,ω'⟩γ) - (ω × Iω' + ω' × Iω)", second_torque(), D * contact - swing))
    p.lemma(equal("the load is what is bilinear in x × Ix and 2D⟨x,ω'⟩x, of ω and ω', and of γ and γ̇", modified.load(),
                  both.cross(INERTIA * both) - omega.cross(INERTIA * omega) - rate.cross(INERTIA * rate)
                  + 2 * D * (tip.dot(rate) * tip - gamma.dot(rate) * gamma - MOVING.dot(rate) * MOVING)))  # fmt: skip
    p.say("12ω₃ = 2|ω|²ω - ω × ω' - B⁻¹ load (B⁻¹ load = `share`), and u = εω/2 + ε²ω'/4 + ε³u₃ with")
    p.show("u₃", modified.gibbs_jet()[2])
    p.say("First, this u turns every vector as the flow does: for any x,")
    for power, (step, flow) in enumerate(zip(modified.step_jet(X), modified.flow_jet(X), strict=True)):
        p.printed(equal(f"Ωᵀx and the flow of ẋ = x × Ω̃ agree in ε^{power}", step, flow))
    p.say("So with c = -½ Σ eᵢ × (eᵢ × c) ω₃ is what the step turns the basis by beyond the flow of ω:")
    beyond = [e.cross(modified.step_jet(e)[3] - modified.ball_jet(e)[3]) for e in sp.eye(3).columnspace()]
    p.lemma(
        equal("12ω₃ from what the step leaves in ε³", modified.correction(), -6 * (beyond[0] + beyond[1] + beyond[2]))
    )
    p.step(TURNS, COMPACT, "gibbs-rotation", "2.5-inverse")
    p.say("Second, it solves the equation of the step: the coefficients of Bu + u × Iu - (1 + |u|²)εK/2 are")
    one, two, three_ = modified.equation_jet()
    p.printed(
        equal("ε: 0", one, sp.zeros(3, 1)),
        equal("ε²: (Bω' - Iω × ω)/4", 4 * two, carried(rate) - modified.torque()),
        equal("ε³: ((Bω'' as above) - (B share - load)/2)/12", 24 * three_,
              2 * (carried(second) - second_torque()) - (carried(share) - modified.load())),
    )  # fmt: skip
    p.say("so 0 up to ε³; B > 0 is the derivative in u at 0, so that u is the root of the small branch up to O(ε⁴).")
    p.step(FIELD, TURNS, COMPACT, "gibbs", "small-branch")
    p.say("X₂ = 0, as Ω̃ has no term in ε: so it must be, for the step with -ε undoes the step (self-adjoint).")
    p.say("|γ|, |K|, ⟨K,γ⟩ are integrals of every such field, as they are of the map.")
    _controls(p, two, three_)
    point, values = _witness()
    left = [x for part in modified.equation_jet() for x in part.xreplace(point)]
    p.witness("under way", values, Fact("the coefficients of the equation are 0", not any(left)))


def _controls(p: Proof, two: sp.Matrix, third: sp.Matrix) -> None:
    wrong = modified.flow_jet(X)[3] + X.cross(omega.cross(rate)) / 12
    p.control(equal("ε³ of the step, with 12ω₃ = 2|ω|²ω - B⁻¹ load", modified.step_jet(X)[3], wrong))
    p.control(equal("ε² of the step without ω'", modified.step_jet(X)[2], X.cross(omega).cross(omega) / 2))
    p.control(equal("ε²: (Bω' + Iω × ω)/4", 4 * two, carried(rate) + modified.torque()))
    lighter = carried(share) - modified.load() + D * (gamma.dot(rate) * MOVING + MOVING.dot(rate) * gamma)
    p.control(equal("ε³ with D in the place of 2D in the load", 24 * third,
                    2 * (carried(second) - second_torque()) - lighter))  # fmt: skip


def in_free_parameters(numerator: int = 1) -> list[Identity]:
    """H after the step, in powers of ε, by a new solution for u and ω: the ball, ω and γ, of any length, are free.

    `numerator`: the numerator of the factor of D⟨γ,ω'⟩⟨γ̇,ω'⟩/4.
    """
    w1, w2, w3, g1, g2, g3, *moments, contact = parameters("w1 w2 w3 g1 g2 g3 I1 I2 I3 D")
    spin, vertical, inertia = array([w1, w2, w3]), array([g1, g2, g3]), array(moments)
    square, cross = vertical @ vertical, np.cross

    def rolled(now: Array, then: Array, x: Array) -> Array:
        """Dγγᵀx, bilinear in γ."""
        return contact * (then @ x) * now

    solve = inverse(np.diag(inertia) + contact * (square * unit(3) - np.outer(vertical, vertical)))
    momentum = inertia * spin + contact * square * spin - rolled(vertical, vertical, spin)
    u = [0 * spin, spin / 2]
    u.append(-solve @ cross(u[1], inertia * u[1]))
    u.append(solve @ ((u[1] @ u[1]) * momentum / 2 - cross(u[1], inertia * u[2]) - cross(u[2], inertia * u[1])))

    def stepped(x: Array) -> list[Array]:
        """The coefficients of Ωᵀx up to ε³."""
        once = [-cross(v, x) + sum(cross(u[j], cross(u[i - j], x)) for j in range(i + 1)) for i, v in enumerate(u)]
        return [x, 2 * once[1], 2 * once[2], 2 * (once[3] - (u[1] @ u[1]) * once[1])]

    K, g = stepped(momentum), stepped(vertical)
    y = [spin]
    for n in (1, 2, 3):  # B(γ)y = K; |γ| is conserved
        known = sum(
            (rolled(g[i], g[j], y[n - i - j]) for i in range(n + 1) for j in range(n + 1 - i) if i + j), 0 * spin
        )
        y.append(solve @ (K[n] + known))
    energy = [sum(K[j] @ y[n - j] for j in range(n + 1)) / 2 for n in range(4)]
    speed = solve @ cross(inertia * spin, spin)
    found = contact * (vertical @ speed) * (cross(vertical, spin) @ speed) * numerator / 4
    return [identity("H after the step is H + ε³(D/4)⟨γ,ω'⟩⟨γ̇,ω'⟩ + O(ε⁴)", energy[1:], [0, 0, found])]


def _witness() -> tuple[dict[sp.Symbol, sp.Rational], dict[str, str]]:
    """A state of a ball with D = 3, with ω', ω'' and `share` solved for, in exact rational numbers."""
    names = placed((omega, (1, -1, 2)), (gamma, (2, 3, 6)), ((J1, J2, J3, D), (1, 2, 4, 3)))
    point = {k: sp.Rational(v, 7 if k in list(gamma) else 1) for k, v in names.items()}
    B = sp.Matrix(three.contact_inertia()).xreplace(point)
    for symbols, right in ((rate, modified.torque()), (second, second_torque()), (share, modified.load())):
        point |= placed((symbols, B.LUsolve(right.xreplace(point))))
    return point, {str(k): str(v) for k, v in point.items()}


@claim(
    "modified-energy",
    r"X_3(H) = \tfrac D4\langle\gamma,\dot\omega\rangle\langle\dot\gamma,\dot\omega\rangle,\quad "
    r"H(\Phi_\varepsilon x) = H(x) + \varepsilon^3X_3(H)(x) + O(\varepsilon^4)",
    uses=["modified-field", "2.5", "energy-without-rolling", "6-vertical-energy"],
)
def modified_energy(p: Proof) -> None:
    """In a step the energy changes by ε³(D/4)⟨γ,ω'⟩⟨γ̇,ω'⟩, with γ̇ and ω' of the continuous ball."""
    p.assume("as in modified-field")
    w = X
    p.state(Theorem((), (COMPACT,), (ENERGY,)))
    p.say("H = ½⟨ω,Bω⟩ with K = Bω.  Along γ̇ = γ × w, K̇ = K × w, for any w, Ḣ = ⟨ω,K̇⟩ - ½⟨ω,Ḃω⟩:")
    on_momentum = continuous.energy().xreplace(placed((K, carried(omega))))
    ring = Quotient((*omega, *three.RING.symbols), three.RING.relations)
    p.lemma(Equation("(2.5) at K = Bω is ½⟨ω,Bω⟩", on_momentum, omega.dot(carried(omega)) / 2, ring))
    slope = omega.dot(carried(omega).cross(w)) - omega.dot(inertia_along(gamma.cross(w), omega)) / 2
    p.printed(equal("Ḣ = ⟨w, ω × Iω⟩ = -⟨w,Bω'⟩ for the field of w", slope, w.dot(omega.cross(INERTIA * omega))))
    p.say("For w = ω this is 0.  For w = ω₃, as ⟨ω,Bω'⟩ = 0 and ⟨B⁻¹load,Bω'⟩ = ⟨load,ω'⟩:")
    known = 2 * omega.dot(omega) * omega - omega.cross(rate)
    twelvefold = -known.dot(carried(rate)) + modified.load().dot(rate)
    found = modified.energy_rate()
    p.show("X₃(H)", found)
    p.printed(Equation("-4⟨ω₃,Bω'⟩ = D⟨γ,ω'⟩⟨γ̇,ω'⟩", twelvefold / 3, 4 * found, on_rate()))
    p.step(ENERGY, COMPACT, "modified-field", "2.5")
    p.say(
        "It is 0 for D = 0, where the map keeps H (energy-without-rolling), and for vertical momentum, where ⟨γ,ω⟩ is a"
    )
    p.say("function of integrals (6-vertical-energy) and ⟨γ,ω'⟩ = d/dt⟨γ,ω⟩, as ⟨γ̇,ω⟩ = 0.")
    p.control(Equation("X₃(H) = (D/4)⟨γ,ω⟩⟨γ̇,ω'⟩", twelvefold, 3 * D * gamma.dot(omega) * MOVING.dot(rate), on_rate()))
    p.control(Equation("X₃(H) with D/3", twelvefold, 16 * found, on_rate()))
    p.control(Equation("X₃(H) with -D/4", twelvefold, -12 * found, on_rate()))
    p.route("u and ω after the step solved for in powers of ε, in free parameters", *in_free_parameters())
    p.control(*(mutated("with D/2", x) for x in in_free_parameters(2)))
    point, values = _witness()
    p.witness(
        "under way", values, Fact("X₃(H) is not 0", twelvefold.xreplace(point) == 12 * found.xreplace(point) != 0)
    )


@claim("energy-without-rolling", r"D = 0:\quad H(\Phi_\varepsilon x) = H(x)", uses=["gibbs", "gibbs-rotation"])
def without_rolling(p: Proof) -> None:
    """For D = 0, the discrete Euler top, the energy ½⟨K, I⁻¹K⟩ is an integral of the map itself, on every branch."""
    flat = "D = 0; q₀ ≠ 0"
    p.assume(flat)
    p.state(Theorem((), (flat,), ("H∘Φ = H, on every branch",)))
    u = gibbs.u
    norm = 1 + u.dot(u)
    start, moved = INERTIA * u + u.cross(INERTIA * u), INERTIA * u - u.cross(INERTIA * u)
    ring = Quotient((*u, J1, J2, J3), [])
    p.say("The step has ½(1 + |u|²)𝒦 = Iu + u × Iu, and carries it by Ωᵀx = x + 2(u × (u × x) - u × x)/(1 + |u|²):")
    p.printed(equal("½(1 + |u|²)Ωᵀ𝒦 = Iu - u × Iu", turned(start), norm * moved, ring))
    energies = [(INERTIA.inv() * x).dot(x) for x in (start, moved)]
    p.printed(Equation("⟨Ωᵀ𝒦, I⁻¹Ωᵀ𝒦⟩ = ⟨𝒦, I⁻¹𝒦⟩", energies[1], energies[0], ring))
    p.say("The difference is 4⟨Iu, I⁻¹(u × Iu)⟩ = 4⟨u, u × Iu⟩ = 0.")
    p.step("H∘Φ = H, on every branch", flat, "gibbs", "gibbs-rotation")
    p.control(Equation("⟨Ωᵀ𝒦, I⁻²Ωᵀ𝒦⟩ = ⟨𝒦, I⁻²𝒦⟩", [(INERTIA.inv() * moved).dot(INERTIA.inv() * moved)],
                       [(INERTIA.inv() * start).dot(INERTIA.inv() * start)], ring))  # fmt: skip
    heavy = INERTIA + D * sp.eye(3)
    p.control(Equation("the same with (I + D)⁻¹", [(heavy.inv() * moved).dot(moved)], [(heavy.inv() * start).dot(start)],
                       Quotient((*u, J1, J2, J3, D), [])))  # fmt: skip


@claim(
    "modified-measure",
    r"\mathrm{div}\,X_w = \sum_j L_j(w_j),\quad \mathrm{div}_\mu X_w = \sum_j L_j(w_j) + "
    r"\tfrac{D}{\tau}\langle\Lambda^{-1}\gamma,\gamma\times w\rangle,\quad "
    r"\mu = \tau^{-1/2},\ \tau = 1 - D\langle\gamma,\Lambda^{-1}\gamma\rangle",
    uses=["modified-field"],
)
def modified_measure(p: Proof) -> None:
    """The divergence of the field of w against the density of the continuous ball; 0 for w = ω."""
    p.assume("|γ| = 1; L_j is the field K̇ = K × e_j, γ̇ = γ × e_j, so that the field of w is Σ w_j L_j")
    p.state(Theorem((), (), (KEPT,)))
    fields = [(K.cross(e), gamma.cross(e)) for e in sp.eye(3).columnspace()]
    ring = Quotient((*K, *gamma, J1, J2, J3, D), [three.UNIT_VERTICAL])
    p.lemma(Equation("div L_j = 0", [sum(f[0].diff(K[i])[i] + f[1].diff(gamma[i])[i] for i in range(3)) for f in fields],
                     [sp.S.Zero] * 3, Quotient((*K, *gamma), [])))  # fmt: skip
    weight = 1 - D * gamma.dot(continuous.inverse_inertia() * gamma)
    spin = continuous.angular_velocity()
    divergence = sum(_along(spin[j], fields[j]) for j in range(3))
    w = omega
    change = sum(w[j] * _along(weight, fields[j]) for j in range(3))
    lift = D * (continuous.inverse_inertia() * gamma).dot(gamma.cross(w))
    free = Quotient((*w, *ring.symbols), ring.relations)
    p.printed(Equation("-½X_w(τ) = D⟨Λ⁻¹γ, γ × w⟩", -change / 2, lift, free))
    lifted = lift.xreplace(placed((w, spin)))
    p.printed(Equation(KEPT, divergence, -lifted / weight, ring))
    p.control(Equation("the density 1 is invariant", divergence, 0, ring))
    p.control(Equation("the density 1/τ is invariant", divergence, -2 * lifted / weight, ring))


def _along(expr: sp.Expr, field: tuple[sp.Matrix, sp.Matrix]) -> sp.Expr:
    """The derivative of a function of K, γ along a field."""
    return sum(expr.diff(K[i]) * field[0][i] + expr.diff(gamma[i]) * field[1][i] for i in range(3))


@claim(
    "map-symmetries",
    r"\Phi\text{ commutes with } (\mathcal K,\gamma)\mapsto(\mathcal K,-\gamma),\ (S\mathcal K,S\gamma);\quad "
    r"(\mathcal K,\gamma)\mapsto(-\mathcal K,\gamma)\text{ reverses it; } X_3(H)\text{ is even and odd under them}",
    uses=["gibbs", "gibbs-rotation", "reversible", "modified-energy"],
)
def symmetries(p: Proof) -> None:
    """The map commutes with γ ↦ -γ and with rotations by π about the principal axes; with -𝒦 they are its reversals."""
    turns = "S = diag(±1, ±1, ±1), det S = 1; the branch is the small one, or any that is carried along"
    p.assume(turns)
    p.state(Theorem((), (turns,), (COMMUTES, CANCELS)))
    u, k = gibbs.u, gibbs.k
    residual = sp.Matrix(gibbs.residual())
    ring = Quotient((*u, *k, *gibbs.v, *gamma, *gibbs.INERTIA.diagonal(), D), [])
    p.say(
        "G(u; 𝒦, γ) = Bu + u × Iu - (1 + |u|²)𝒦/2, and u carries a vector v by v + 2(u × (u × v) - u × v)/(1 + |u|²)."
    )
    p.printed(equal("G(u; 𝒦, -γ) = G(u; 𝒦, γ)", residual.xreplace(placed((gamma, -gamma))), residual, ring))
    for S in HALF_TURNS.values():
        there = placed((u, S * u), (k, S * k), (gamma, S * gamma))
        name = f"S = diag({', '.join(map(str, S.diagonal()))})"
        p.printed(equal(f"{name}: G(Su; S𝒦, Sγ) = SG(u; 𝒦, γ)", residual.xreplace(there), S * residual, ring))
        text = f"{name}: Su carries Sv to where S takes what u makes of v"
        p.printed(equal(text, turned(S * gibbs.v, S * u), S * turned(gibbs.v), ring))
    p.step(COMMUTES, turns, "gibbs", "gibbs-rotation")
    p.say("(𝒦, γ) ↦ (-𝒦, γ) reverses the map by the lemma reversible; so do its products with these.")
    p.say(
        "For X₃(H): under γ ↦ -γ both ω and ω' are as before; under S they are Sω, Sω'; under K ↦ -K they are -ω, ω':"
    )
    rate_, odd = modified.energy_rate(), placed((omega, -omega))
    p.printed(equal("X₃(H) at (K, -γ)", rate_.xreplace(placed((gamma, -gamma))), rate_))
    for S in HALF_TURNS.values():
        there = placed((omega, S * omega), (rate, S * rate), (gamma, S * gamma))
        p.printed(equal("X₃(H) at (SK, Sγ)", rate_.xreplace(there), rate_))
    p.printed(equal("X₃(H) at (-K, γ) is -X₃(H)", rate_.xreplace(odd), -rate_))
    p.say(
        "So its integral over a closed orbit that a reversal takes to itself is 0: an orbit that proves anything is asymmetric."
    )
    p.step(CANCELS, turns, COMMUTES, "reversible", "modified-energy")
    mirror = MIRRORS["σ1"]
    there = placed((u, mirror * u), (k, mirror * k), (gamma, mirror * gamma))
    p.control(equal("a reflection is a symmetry", residual.xreplace(there), mirror * residual, ring))
    p.control(equal("𝒦 ↦ -𝒦, u ↦ -u is a symmetry", residual.xreplace(placed((u, -u), (k, -k))), -residual, ring))
    p.control(equal("X₃(H) at (-K, γ) is X₃(H)", rate_.xreplace(odd), rate_))


if __name__ == "__main__":
    main(__file__)
