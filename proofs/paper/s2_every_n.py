"""Section 2: the continuous ball for every n, from d'Alembert's principle, with words in noncommuting symbols."""

from collections.abc import Mapping

import sympy as sp

from chapsym.derive import derivation, motion
from chapsym.derive.motion import ALGEBRA, D, Gamma, J, K, alpha, commutator, gamma, m, omega, rate, rho
from chapsym.derive.words import Traces, WordAlgebra
from chapsym.proofs.glossary import Symbols
from chapsym.prove import Equation, Point, Proof, claim, equations, main

DOWNWARDS = "γ is directed from the centre to the plane (2.9 as corrected)"


equation = equations(ALGEBRA)
VANISHES = "d'Alembert's principle, which vanishes in a motion"
TRACES = Traces(ALGEBRA)


def motion_symbols() -> Symbols:
    """The symbols of the continuous ball for every n (Section 2)."""
    return {
        "J": (motion.J, "the mass tensor, symmetric (2.10)"),
        "D": (motion.D, "mρ² (2.11)"),
        "m": (motion.m, "the mass (2.11)"),
        r"\rho": (motion.rho, "the radius (2.9)"),
        r"\omega": (motion.omega, "the angular velocity in the body, skew (2.8)"),
        r"\dot\omega": (motion.alpha, "its rate"),
        r"\gamma": (motion.gamma, "the unit vector from the centre to the plane (2.9 as corrected)"),
        r"\dot\gamma": (motion.rate(motion.gamma), "its rate, as it is fixed in space"),
        r"\Gamma": (motion.Gamma, "γγᵀ (2.12)"),
        r"\dot\Gamma": (moving("vertical", motion.gamma * motion.gammaT), "its rate, as γ is fixed in space"),
        "v_C": (motion.v, "the velocity of the centre, in the body (2.8)"),
        r"\dot v_C": (motion.a, "its rate"),
        "M": (motion.J * motion.omega + motion.omega * motion.J, "Jω + ωJ (2.10)"),
        r"\dot M": (motion.rate(motion.J * motion.omega + motion.omega * motion.J), "its rate"),
    }


def moving(
    name: str, expr: sp.Expr, rates: Mapping[sp.Symbol, sp.Expr] = motion.RATES, algebra: WordAlgebra = ALGEBRA
) -> sp.Symbol:
    """The rate of an expression, as a step of the certificate."""
    return derivation.rate(f"{name}_rate", "d/dt", derivation.written(name, "as in the claim", expr, algebra), rates)


def still_vertical() -> Equation:
    """The statement that Γ = γγᵀ is fixed in space, from the rate of γ."""
    rate_of_vertical = moving("vertical", motion.gamma * motion.gammaT)
    return equation("Γ̇ + [ω,Γ] = 0", rate_of_vertical + commutator(omega, Gamma), 0)


def motion_point() -> Point:
    """A point for n = 3: γ = e₃, ω = (1, 1, 1), ω̇ from the principle, m = 10, ρ = 1."""
    spin, gain = sp.Matrix([1, 1, 1]).hat(), sp.Matrix(["1/8", "-1/5", "1/3"]).hat()
    down = sp.Matrix([0, 0, 1])
    values = {alpha: gain, omega: spin, J: sp.diag(1, 2, 4), gamma: down, motion.gammaT: down.T}
    values |= {Gamma: down * down.T, m: sp.Integer(10), rho: sp.S.One, D: sp.Integer(10)}
    shown = {"ω": "(1, 1, 1)", "ω̇": "(1/8, -1/5, 1/3)", "J": "diag(1, 2, 4)", "γ": "e3", "m": "10", "ρ": "1", "D": "10"}
    return Point(shown, values, [equation("the principle", motion.eliminated(), 0)])


def touching(name: str, where: sp.Expr) -> sp.Symbol:
    """The velocity v + ω(P - C) of the ball's point P = C + `where`: a step of the certificate."""
    of = derivation.written("point_velocity", "v + ω(P - C), P - C as r", motion.v + omega * LEVER, FREE)
    return derivation.replaced(name, "at the point of contact", of, {LEVER: where}, FREE)


#: A point of the ball, relative to its centre.
LEVER = sp.Symbol("lever", commutative=False)
FREE = WordAlgebra({omega: -omega})


@claim("2.9", r"v_C + \rho\,\omega\gamma = 0,\ \gamma \text{ directed upwards, from } H \text{ to } C", ["2.1"])
def rolling_condition(p: Proof) -> None:
    """With γ upwards the n-dimensional rolling condition has the wrong sign, as (2.1) has."""
    p.slips("convention", "2.1")
    p.say("The point of contact is P = C - ργ, and the material point there has the velocity v + ω(P - C).")
    slip, below = (touching(name, where) for name, where in (("slip", -rho * gamma), ("slip_below", rho * gamma)))
    p.reads(motion_symbols() | {"0": (slip, "the velocity of the point of the ball at P = C - ργ, by the derivation")})
    p.printed(equation("v + ρωγ = the velocity of P", motion.v + rho * omega * gamma, slip))
    p.corrected(
        r"v_C - \rho\,\omega\gamma = 0,\ \text{or as printed with } \gamma \text{ directed downwards, from } C \text{ to } H",
        equation("v - ρωγ = the velocity of P", motion.v - rho * omega * gamma, slip),
        equation("v + ρωγ = v + ω(P - C) for P = C + ργ", motion.v + rho * omega * gamma, below),
    )
    p.say("Everything after (2.9) uses the sign as printed, hence γ downwards; D and Γ do not see the difference.")
    up, turn = sp.Matrix([0, 0, 1]), sp.Matrix([[0, 0, 1], [0, 0, 0], [-1, 0, 0]])
    values = {omega: turn, gamma: up, motion.v: sp.Matrix([1, 0, 0]), rho: sp.S.One}
    shown = {"ω": str(turn.tolist()), "γ": "e3", "v": "e1", "ρ": "1"}
    p.counterexample(Point(shown, values))
    p.control(equation("v + ργω = the velocity of P", motion.v + rho * gamma * omega, slip))


@claim("2.10", r"M = J\omega + \omega J")
def centre_momentum(p: Proof) -> None:
    """The angular momentum about the centre, from the kinetic energy ½ tr(Ṙ J Ṙᵀ)."""
    p.reads(motion_symbols(), ("M", motion.centre_momentum(), "from the kinetic energy ½ tr(ṘJṘᵀ), by the derivation"))
    derived = motion.centre_momentum()
    p.show("M", derived)
    p.printed(equation("M = Jω + ωJ", J * omega + omega * J, derived))
    kinetic = omega * J * ALGEBRA.transpose(omega) / 2
    p.lemma(equation("-¼ tr(ωM) = ½ tr(Ṙ J Ṙᵀ)", -omega * derived / 4, kinetic, TRACES))
    p.control(equation("M = ½(Jω + ωJ)", (J * omega + omega * J) / 2, derived))


@claim(
    "2.11",
    r"\dot M + [\omega, M] = \rho F\wedge\gamma,\ m(\dot v_C + \omega v_C) = F,\ \dot\gamma + \omega\gamma = 0",
    ["2.9", "2.10"],
)
def equations_of_motion(p: Proof) -> None:
    """The equations of motion are d'Alembert's principle in the frame of the body."""
    p.reads(
        motion_symbols(),
        ("F", motion.m * (motion.a + omega * motion.v), "m(v̇ + ωv), the force of inertia"),
        ("0", motion.dalembert(), VANISHES),
    )
    p.assume(DOWNWARDS)
    p.say("tr(R̈ J δRᵀ) + ⟨m r̈, δr⟩ = 0 for δR = Rη, δr = -ρRηγ, every skew η; R̈ = R(ω̇+ω²), r̈ = R(v̇+ωv).")
    principle = motion.dalembert()
    p.show("0", principle)
    momentum = J * omega + omega * J
    balance = rate(momentum) + commutator(omega, momentum)
    moment = rho * ALGEBRA.wedge(motion.m * (motion.a + omega * motion.v), gamma)
    p.printed(equation("Ṁ + [ω,M] - ρF∧γ, F = m(v̇ + ωv), is the principle", balance - moment, principle))
    p.lemma(equation("γ̇ + ωγ = 0 for γ = R⁻¹γ⃗", rate(gamma) + omega * gamma, 0))
    p.control(equation("with +ρF∧γ on the left", balance + moment, principle))
    p.control(equation("with [M,ω]", rate(momentum) - commutator(omega, momentum) - moment, principle))


@claim("2.11-force", r"F = m\rho\,\dot\omega\gamma", ["2.11"])
def reaction_force(p: Proof) -> None:
    """The reaction force: its sign is misprinted."""
    p.slips("serious")
    force = motion.on_rolling("force_rolling", motion.inertial_force())
    p.reads(motion_symbols(), ("F", force, "m(v̇ + ωv) where v = -ρωγ, by the derivation"))
    p.assume(f"{DOWNWARDS}; with the other direction F is right as printed, and the sign of ρF∧γ in (2.11) is not")
    p.say("v = -ρωγ and γ̇ = -ωγ give v̇ + ωv = -ρω̇γ.")
    p.show("F", force)
    p.printed(equation("F = mρω̇γ", m * rho * alpha * gamma, force))
    p.corrected(r"F = -m\rho\,\dot\omega\gamma", equation("F = -mρω̇γ", -m * rho * alpha * gamma, force))
    p.counterexample(motion_point())
    p.control(equation("F = -mρ(ω̇ + ω²)γ", -m * rho * (alpha + omega * omega) * gamma, force))


@claim(
    "2.11-eliminated",
    r"\dot M + [\omega, M] = D(\dot\omega\Gamma + \Gamma\dot\omega),\ \dot\Gamma + [\omega,\Gamma] = 0",
    ["2.11-force"],
)
def eliminated_force(p: Proof) -> None:
    """After F is eliminated the right side has the sign of F, which is misprinted."""
    p.slips("serious", "2.11-force")
    p.reads(motion_symbols() | {"0": (motion.eliminated(), VANISHES)})
    p.assume(DOWNWARDS)
    momentum = J * omega + omega * J
    balance = rate(momentum) + commutator(omega, momentum)
    lifted = D * (alpha * Gamma + Gamma * alpha)
    p.printed(still_vertical())
    p.printed(equation("Ṁ + [ω,M] - D(ω̇Γ + Γω̇) is what vanishes in a motion", balance - lifted, motion.eliminated()))
    p.corrected(
        r"\dot M + [\omega, M] = -D(\dot\omega\Gamma + \Gamma\dot\omega)",
        equation("Ṁ + [ω,M] + D(ω̇Γ + Γω̇) is what vanishes in a motion", balance + lifted, motion.eliminated()),
    )
    p.counterexample(motion_point())
    p.control(equation("Ṁ + [ω,M] + 2D(ω̇Γ + Γω̇) is the principle", balance + 2 * lifted, motion.eliminated()))


@claim("2.12", r"\dot{\mathbf K} + [\omega, \mathbf K] = 0,\ \dot\Gamma + [\omega, \Gamma] = 0", ["2.11-eliminated"])
def conservation(p: Proof) -> None:
    """The momentum about the contact point is fixed in space, for every n."""
    p.reads(
        motion_symbols(),
        (r"\mathbf K", motion.contact_momentum(), "Jω + ωJ + D(Γω + ωΓ) (2.13)"),
        (r"\dot{\mathbf K}", moving("K_here", motion.contact_momentum()), "its rate"),
        ("0", motion.eliminated(), VANISHES),
    )
    momentum = motion.contact_momentum()
    p.show("K", momentum)
    p.printed(
        equation(
            "K̇ + [ω,K] is the principle", moving("K_here", momentum) + commutator(omega, momentum), motion.eliminated()
        )
    )
    p.printed(still_vertical())
    p.control(equation("K̇ - [ω,K] is the principle", rate(momentum) - commutator(omega, momentum), motion.eliminated()))
    wrong = J * omega + omega * J - D * (Gamma * omega + omega * Gamma)
    p.control(equation("the same with -D in K", rate(wrong) + commutator(omega, wrong), motion.eliminated()))


@claim(
    "2.14",
    r"\mathrm{tr}\,\tfrac d{dt}\mathbf K^s = 0,\ \mathrm{tr}\,\tfrac d{dt}(\mathbf K^s\Gamma^l) = 0,\ "
    r"\mathrm{tr}\,\Gamma \text{ stays 1, for all even } s \text{ and natural } l",
    ["2.12"],
)
def trace_integrals(p: Proof) -> None:
    """The trace integrals of the continuous ball, for every n, s and l."""
    p.infers("The derivation rule, which is decided for any two matrices, gives every s and l, by induction.")
    X, Y = sp.symbols("X Y", commutative=False)
    algebra = type(ALGEBRA)({**ALGEBRA.transposes, X: X, Y: Y}, ALGEBRA.rules)
    p.say("By (2.12) the rate of K and of Γ is -[ω, ·], and the commutator is a derivation:")
    by_parts = commutator(omega, X) * Y + X * commutator(omega, Y)
    p.lemma(Equation("[ω,X]Y + X[ω,Y] = [ω,XY]", by_parts, commutator(omega, X * Y), algebra))
    p.lemma(Equation("tr [ω,X] = 0", commutator(omega, X), 0, Traces(algebra)))
    p.say("so that the rate of K^s is -[ω, K^s], that of Γ^l is -[ω, Γ^l], and d/dt tr(K^sΓ^l) = 0, by Leibniz' rule:")
    rates = {**motion.RATES, **{x: -commutator(omega, x) for x in (K, X, Y)}}
    traces = Traces(algebra)
    power, product = (moving(name, of, rates, algebra) for name, of in (("power", X), ("product", X * Y)))
    p.reads(
        (r"\tfrac d{dt}\mathbf K^s", power, "that of any X with the rate -[ω, X], by the derivation"),
        (r"\tfrac d{dt}(\mathbf K^s\Gamma^l)", product, "that of any XY with such rates, by the derivation"),
    )
    p.printed(
        equation("d/dt tr X = 0", power, 0, traces),
        equation("d/dt tr XY = 0", product, 0, traces),
        equation("d/dt tr Γ = 0", moving("Gamma_alone", Gamma, rates, algebra), 0, traces),
    )
    p.control(equation("d/dt tr K²J = 0", rate(K * K * J, rates), 0, traces))
    opposite = {**rates, K: commutator(omega, K)}
    p.control(equation("d/dt tr K²Γ = 0 with K̇ = +[ω,K]", rate(K * K * Gamma, opposite), 0, traces))


@claim("2.15", r"H = -\tfrac14\mathrm{tr}(\omega\,\mathcal A\omega),\ \text{an integral}", ["2.12"])
def energy_integral(p: Proof) -> None:
    """The energy integral is the kinetic energy, for every n."""
    momentum = motion.contact_momentum()
    energy = -omega * momentum / 4
    velocity = motion.rolling_velocity()
    kinetic = omega * J * ALGEBRA.transpose(omega) / 2 + D / rho**2 * velocity * ALGEBRA.transpose(velocity) / 2
    p.reads(
        motion_symbols(),
        ("H", sp.Function("tr")(kinetic), "the kinetic energy, ½ tr(Ṙ J Ṙᵀ) + ½ m|v|² on v = -ρωγ"),
        (r"\mathcal A\omega", momentum, "K (2.13)"),
    )
    p.printed(equation("H = ½ tr(Ṙ J Ṙᵀ) + ½ m|v|² on v = -ρωγ", energy, kinetic, TRACES))
    p.say("dH/dt = -½ tr(ω(K̇ + [ω,K])): the principle times the velocity, so it vanishes along every motion.")
    power = -omega * motion.eliminated() / 2
    p.printed(equation("dH/dt = -½ tr(ω·(principle))", moving("energy", energy), power, TRACES))
    p.control(equation("the same for -½ tr(ωAω)", rate(-omega * momentum / 2), power, TRACES))
    centre = -omega * motion.centre_momentum() / 4
    p.control(equation("the same for the energy about the centre", rate(centre), power, TRACES))


if __name__ == "__main__":
    main(__file__)
