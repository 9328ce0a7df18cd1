"""Section 2: the classical ball, n = 3: equations, integrals, the invariant measure, vertical momentum."""

from dataclasses import replace

import sympy as sp

from chapsym.derive import continuous, motion, three
from chapsym.derive.continuous import RING, inverse_inertia, rolling_factor
from chapsym.derive.derivation import coordinates, entry, written
from chapsym.derive.limits import omega
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import J1, J2, J3, D, K, gamma
from chapsym.derive.words import evaluate
from chapsym.proofs import glossary
from chapsym.proofs.glossary import Symbols
from chapsym.proofs.paper.s2_continuous import BALL, SPIN, UNIT, unit_vertical
from chapsym.prove import Comparison, Equation, Proof, claim, equations, main, rational_point

alpha = sp.Matrix(sp.symbols("a1:4"))  # dω/dt
h, l = sp.symbols("h l")
VERTICAL_RATE = gamma.cross(omega)

equation = equations(RING)


def momentum() -> sp.Matrix:
    """K(ω, γ)."""
    return sp.Matrix(continuous.momentum())


def along(expr: sp.Matrix, faster: sp.Matrix = alpha) -> sp.Matrix:
    """The derivative of functions of ω, γ along γ̇ = γ×ω and any ω̇."""
    return expr.jacobian(omega) * faster + expr.jacobian(gamma) * VERTICAL_RATE


def solved_acceleration(rotor: sp.Matrix | None = None) -> sp.Matrix:
    """ω̇ of (2.2); optionally with the momentum a of a rotor, K = Λω - D⟨ω,γ⟩γ + a (lemma `gyrostat-motion`)."""
    gyration = (three.lam() * omega + (sp.zeros(3, 1) if rotor is None else rotor)).cross(omega)
    lift = D / rolling_factor() * (inverse_inertia() * gamma).dot(gyration) * gamma
    return inverse_inertia() * (gyration + lift)


def carried_rates() -> tuple[sp.Matrix, sp.Matrix]:
    """Letters of a derivation for the vectors of -[ω, K] and -ωγ, from words at matrices."""
    words = motion.ALGEBRA
    turning = written("K_rate_words", "-[ω, K] (2.12)", -motion.commutator(motion.omega, motion.K), words)
    falling = written("gamma_rate_words", "-ωγ", -motion.omega * motion.gamma, words)
    ring, unit, text = Quotient(RING.symbols), RING, "n = 3: ω and K as vectors"
    skew = coordinates("K_rate_matrix", text, turning, {motion.omega: omega.hat(), motion.K: K.hat()}, ring)
    column = coordinates(
        "gamma_rate_column",
        "n = 3",
        falling,
        {motion.omega: omega.hat(), motion.gamma: gamma, motion.gammaT: gamma.T, motion.Gamma: gamma * gamma.T},
        unit,
    )
    entries = [entry(f"gamma_rate_{i + 1}", f"entry {i + 1}", column, i, 0) for i in range(3)]
    return sp.Matrix(three.axial_entries("K_rate", skew)), sp.Matrix(entries)


@claim("2.3", r"\dot K = K\times\omega,\ \dot\gamma = \gamma\times\omega", ["2.12"])
def vector_equations(p: Proof) -> None:
    """The conservation of the momentum about the contact point, as vectors: (2.12) for n = 3."""
    p.assume("the vector of a skew matrix A is (A₃₂, A₁₃, A₂₁), as in Section 5: ωx = ω×x")
    spin, tensor = omega.hat(), K.hat()
    ring = Quotient(RING.symbols)
    turning, falling = carried_rates()
    p.reads(
        glossary.classical(),
        ("K", K, "the vector of K (2.13), (A₃₂, A₁₃, A₂₁) of a skew A"),
        (r"\dot K", turning, "that of -[ω, K] (2.12), by the derivation"),
        (r"\dot\gamma", falling, "-ωγ, as γ is fixed in space, by the derivation"),
    )
    p.printed(
        equation("the vector of -[ω,K] is K×ω", turning, K.cross(omega), ring),
        equation("-ωγ = γ×ω", falling, gamma.cross(omega)),
    )
    words = motion.contact_momentum()
    values = {motion.omega: spin, motion.J: three.J, motion.Gamma: gamma * gamma.T, motion.D: D}
    p.lemma(
        equation(
            "K of (2.13) is Λω - D⟨ω,γ⟩γ",
            three.axial(evaluate(words, values)),
            three.lam() * omega - D * omega.dot(gamma) * gamma,
        )
    )
    p.control(
        equation("the vector of -[ω,K] is ω×K", -three.axial(spin * tensor - tensor * spin), omega.cross(K), ring)
    )


@claim(
    "2.2",
    r"\Lambda\dot\omega = \Lambda\omega\times\omega + \tfrac DF\langle\Lambda^{-1}\gamma,\Lambda\omega\times\omega\rangle\gamma",
    ["2.3", "2.2-F"],
)
def closed_system(p: Proof) -> None:
    """The equations for ω, γ follow from (2.3) and K = Λω - D⟨ω,γ⟩γ."""
    p.say("For any ω̇, K̇ - K×ω times a regular matrix is what (2.2) says to vanish, with K̇ = ∂K/∂ω ω̇ + ∂K/∂γ (γ×ω).")
    p.say("Λ has letters for its entries; F = 1 - D⟨γ,Λ⁻¹γ⟩ (2.2-F).")
    lam = sp.diag(*sp.symbols("L1:4"))
    factor, free = 1 - D * gamma.dot(lam.inv() * gamma), Quotient((*alpha, *omega, *gamma, *lam.diagonal(), D))
    p.assume("Λ is positive, D ≥ 0 and F > 0 (2.13)", *(x > 0 for x in lam.diagonal()), D >= 0, factor > 0)
    momentum, gyration = lam * omega - D * omega.dot(gamma) * gamma, (lam * omega).cross(omega)
    upright = sp.eye(3) + D / factor * gamma * gamma.T * lam.inv()
    vanishing = upright * (along(momentum) - momentum.cross(omega))
    p.reads(
        glossary.ball(),
        (r"\Lambda", lam, "Λ, diagonal (2.2)"),
        ("F", factor, "1 - D⟨γ,Λ⁻¹γ⟩ (2.2-F)"),
        (r"\dot\omega", alpha, "its rate"),
        ("0", vanishing, "(1 + (D/F)γγᵀΛ⁻¹)(K̇ - K×ω), where K = Λω - D⟨ω,γ⟩γ and K̇ = K×ω (2.3)"),
    )

    def said(text: str, size: sp.Expr) -> Equation:
        lift = size * (lam.inv() * gamma).dot(gyration) * gamma
        return equation(text, lam * alpha - gyration - lift, vanishing, free)

    p.printed(said("(2.2), left - right = (1 + (D/F)γγᵀΛ⁻¹)(K̇ - K×ω)", D / factor))
    p.lemma(equation("det(1 + (D/F)γγᵀΛ⁻¹) = 1/F", upright.det(), 1 / factor, free))
    p.control(said("the same without the last term", sp.S.Zero))


@claim(
    "2.4",
    r"\langle\gamma,\gamma\rangle = 1,\ \langle K,\gamma\rangle\equiv\langle J\omega,\gamma\rangle = h,\ "
    r"\langle K,K\rangle = n,\ \langle K,\omega\rangle = l:\ \langle\gamma,\dot\gamma\rangle = 0,\ \dot h = 0,\ \dot n = 0,\ "
    r"\dot l = 0,\ \text{and they are independent}",
    ["2.3", "2.2"],
)
def four_integrals(p: Proof) -> None:
    """The four integrals, and that they are independent."""
    p.infers(
        "Independent: the gradients have rank 4 at one point, hence on an open dense set, as minors are polynomials."
    )
    p.assume("J of Section 2 is the inertia tensor, Λ - D")
    central = three.lam() - D * sp.eye(3)
    k = momentum()
    functions = sp.Matrix([gamma.dot(gamma), k.dot(gamma), k.dot(k), k.dot(omega)])
    power = along(functions)
    acceleration = dict(zip(alpha, solved_acceleration(), strict=True))
    fixed = [K.cross(omega).dot(gamma) + K.dot(VERTICAL_RATE), 2 * K.dot(K.cross(omega))]  # with K̇ = K×ω
    rates = [sp.S.Zero, *fixed, power[3].xreplace(acceleration)]
    p.reads(
        glossary.classical(),
        ("K", k, "Λω - D⟨ω,γ⟩γ, the momentum about the point of contact (2.3)"),
        (r"\dot\gamma", VERTICAL_RATE, "γ×ω (2.3)"),
        {name: (functions[i], f"the integral {name}") for i, name in enumerate("hnl", start=1)},
        {
            rf"\dot {name}": (rates[i], "its rate, by K̇ and γ̇ (2.3), or by ω̇ (2.2)")
            for i, name in enumerate("hnl", start=1)
        },
    )
    p.printed(equation("⟨γ,γ⟩ = 1", gamma.dot(gamma), 1), equation("⟨γ,γ̇⟩ = 0", gamma.dot(VERTICAL_RATE), 0))
    p.printed(equation("⟨K,γ⟩ = ⟨Jω,γ⟩", k.dot(gamma), (central * omega).dot(gamma)))
    for name, value in zip(("⟨K,γ⟩", "⟨K,K⟩", "⟨K,ω⟩"), rates[1:], strict=True):
        p.printed(equation(f"d/dt {name} = 0", value, 0))
    p.say("Independent: their gradients have rank 4 at a rational point, hence on an open dense set.")
    gradients = functions.jacobian([*omega, *gamma])
    at = {**BALL, **UNIT, **SPIN}
    p.lemma(Comparison(f"a minor is not 0 at {BALL}, γ = (2/7,3/7,6/7), ω = (1,-1,2)",
                       [sp.Ne(gradients[:, :4].det(method="berkowitz"), 0)], at))  # fmt: skip
    p.say("It is 3 at most where K = tγ, and 2 at most at rest:")
    size = sp.Symbol("t")
    whole = sp.Matrix([K.dot(K) - 2 * size * K.dot(gamma) + size**2 * gamma.dot(gamma)])
    flat = whole.jacobian([*K, *gamma]).xreplace(three.placed((K, size * gamma)))
    p.lemma(equation("∇(⟨K,K⟩ - 2t⟨K,γ⟩ + t²⟨γ,γ⟩) = 0 in (K, γ) where K = tγ, for this t", flat.T, sp.zeros(6, 1),
                     Quotient((size, *gamma))))  # fmt: skip
    resting = gradients[2:, :].subs(dict.fromkeys(omega, 0))
    p.lemma(equation("∇⟨K,K⟩ = ∇⟨K,ω⟩ = 0 where ω = 0", resting.reshape(12, 1), sp.zeros(12, 1)))
    p.control(equation("d/dt ⟨K,ω⟩ = 0 for Λω̇ = Λω×ω", power[3].xreplace(
        dict(zip(alpha, inverse_inertia() * (three.lam() * omega).cross(omega), strict=True))), 0))  # fmt: skip
    p.control(equation("⟨K,γ⟩ = ⟨Λω,γ⟩", k.dot(gamma), (three.lam() * omega).dot(gamma)))


@claim("2.4-kinetic", r"\langle K,\omega\rangle \text{ is the kinetic energy}", ["2.4"])
def kinetic_energy(p: Proof) -> None:
    """⟨K,ω⟩ is twice the kinetic energy."""
    p.slips("typo")
    kinetic = continuous.lagrangian_energy()
    left = momentum().dot(omega)
    p.reads(
        glossary.classical(),
        ("K", momentum(), "Λω - D⟨ω,γ⟩γ, the momentum about the point of contact (2.3)"),
        ("T", kinetic, "the kinetic energy, ½m|v|² + ½⟨Iω,ω⟩ on the rolling ball"),
    )
    p.printed(equation("⟨K,ω⟩ = ½m|v|² + ½⟨Iω,ω⟩", left, kinetic))
    p.corrected(r"\langle K,\omega\rangle = 2T", equation("⟨K,ω⟩ = m|v|² + ⟨Iω,ω⟩", left, 2 * kinetic))
    p.counterexample(rational_point({**BALL, **UNIT, **SPIN}, [unit_vertical()]))
    p.control(equation("⟨K,ω⟩ = -2T", left, -2 * kinetic))


@claim(
    "2.6", r"\sqrt{\langle J\gamma,\Lambda^{-1}\gamma\rangle}\,d\omega_1\wedge\dots\wedge d\gamma_3", ["2.2", "2.2-F"]
)
def invariant_measure(p: Proof) -> None:
    """The invariant measure, by the exact divergence."""
    p.infers("Ḟ + 2F div X = 0 says that √F is the density of an invariant measure (Liouville).")
    p.assume("J_i + J_j > 0, D ≥ 0, so that Λ is regular and F > 0 (2.13)", *three.MOMENTS)
    p.assume("|γ| = 1: F is taken as ⟨Iγ, Λ⁻¹γ⟩ near the sphere, and the field is tangent to it")
    p.say("div(√F X) = 0 is, times 2√F: Ḟ + 2F div X = 0, with X = (ω̇, γ×ω) of (2.2) in R⁶.")
    factor, rate, divergence = factor_and_divergence(solved_acceleration())
    p.printed(equation("Ḟ + 2F div X = 0", rate + 2 * factor * divergence, 0))
    p.control(equation("Ḟ + F div X = 0 (density F)", rate + factor * divergence, 0))
    p.control(equation("div X = 0 (density 1)", divergence, 0))


def factor_and_divergence(acceleration: sp.Matrix) -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """F, Ḟ, and the divergence of (ω̇, γ×ω)."""
    field = zip([*acceleration, *VERTICAL_RATE], [*omega, *gamma], strict=True)
    return (
        rolling_factor(),
        along(sp.Matrix([rolling_factor()]), acceleration)[0],
        sum(sp.diff(x, at) for x, at in field),
    )


def at_vertical(expr: sp.Expr | sp.Matrix):
    """ω for K = hγ: ω = Λ⁻¹(h + D⟨ω,γ⟩)γ = sΛ⁻¹γ; the claims are judged in s and γ."""
    return expr.xreplace(dict(zip(omega, s * inverse_inertia() * gamma, strict=True)))


#: K = hγ is equivalent to Λω = sγ with s = h + D⟨ω,γ⟩.
s = sp.Symbol("s")
VERTICAL = Quotient((s, *gamma, J1, J2, J3, D), [three.UNIT_VERTICAL])


def vertical_values() -> tuple[sp.Expr, sp.Expr]:
    """h and l = h⟨ω,γ⟩ for Λω = sγ."""
    level = gamma.dot(inverse_inertia() * gamma)
    height = s * (1 - D * level)
    return height, height * s * level


def vertical_symbols() -> Symbols:
    """The symbols of the ball for K = hγ."""
    height, power = vertical_values()
    return glossary.classical() | {
        r"\omega": (at_vertical(omega), "sΛ⁻¹γ, s = h + D⟨ω,γ⟩, as K = hγ is Λω = sγ"),
        "h": (height, "s(1 - D⟨γ,Λ⁻¹γ⟩), with which K = hγ (2.7-vertical)"),
        "l": (power, "h⟨ω,γ⟩, which is ⟨K,ω⟩ (2.7-vertical)"),
    }


@claim(
    "2.7-vertical",
    r"K = h\gamma:\ \langle\omega,\gamma\rangle = \tfrac lh,\ \Lambda\omega = \tfrac{h^2+Dl}h\gamma",
    ["2.4"],
)
def vertical_momentum(p: Proof) -> None:
    """ω for K = hγ."""
    height, _ = vertical_values()
    vector = at_vertical(momentum())
    power = vector.dot(at_vertical(omega))
    p.assume("h ≠ 0", sp.Ne(height, 0))
    p.assume("l = ⟨K,ω⟩ as in (2.4)")
    p.reads(vertical_symbols() | {"K": (vector, "Λω - D⟨ω,γ⟩γ (2.3)"), "l": (power, "⟨K,ω⟩ (2.4)")})
    p.printed(
        equation("Λω = sγ makes K = hγ", vector, height * gamma, VERTICAL),
        equation("⟨ω,γ⟩ = l/h", at_vertical(omega).dot(gamma), power / height, VERTICAL),
        equation("Λω = ((h²+Dl)/h)γ", s * gamma, (height**2 + D * power) / height * gamma, VERTICAL),
    )
    p.control(equation("Λω = ((h²-Dl)/h)γ", s * gamma, (height**2 - D * power) / height * gamma, VERTICAL))


@claim("2.7", r"\Lambda\dot\omega = \Lambda\omega\times\omega", ["2.2", "2.7-vertical"])
def euler_top(p: Proof) -> None:
    """For vertical momentum the equations are those of the Euler top."""
    p.infers("K = hγ stays, as K and γ have one equation and its solutions are unique.")
    faster, gyration = (at_vertical(of) for of in (solved_acceleration(), (three.lam() * omega).cross(omega)))
    p.reads(vertical_symbols() | {r"\dot\omega": (faster, "its rate by (2.2)")})
    p.printed(equation("Λω̇ = Λω×ω for the ω̇ of (2.2)", three.lam() * faster, gyration, VERTICAL))
    p.say("K = hγ stays: K and γ have the same equation (2.3).")
    whole = three.lam() * solved_acceleration()
    p.control(equation("the same for any ω", whole, (three.lam() * omega).cross(omega)))


@claim(
    "2.7-integrals",
    r"\langle\omega,\Lambda\omega\rangle = l,\ \langle\Lambda\omega,\Lambda\omega\rangle = k^2,\ l \text{ that of (2.4)}",
    ["2.7-vertical"],
)
def top_integrals(p: Proof) -> None:
    """The two integrals of the top are constant, but the first is not the l of (2.4)."""
    p.slips("reading")
    height, power = vertical_values()
    p.assume("h ≠ 0", sp.Ne(height, 0))
    spin, body, size = at_vertical(omega), s * gamma, (height**2 + D * power) / height
    p.reads(vertical_symbols() | {"k": (size, "(h² + Dl)/h, a constant")})
    p.printed(equation("|Λω|² = ((h²+Dl)/h)²", body.dot(body), size**2, VERTICAL))
    p.printed(equation("⟨ω,Λω⟩ = l", spin.dot(body), power, VERTICAL))
    p.corrected(
        r"\langle\omega,\Lambda\omega\rangle = \frac{(h^2+Dl)\,l}{h^2}",
        equation("⟨ω,Λω⟩ = (h²+Dl)l/h²", spin.dot(body), (height**2 + D * power) * power / height**2, VERTICAL),
    )
    hypothesis = Equation("|γ| = 1", gamma.dot(gamma), 1, VERTICAL)
    point = rational_point({**BALL, **UNIT, s: 1}, [hypothesis])
    shown = {name: value for name, value in point.values.items() if name != "s"} | {"Λω": "γ"}
    p.counterexample(replace(point, values=shown))
    p.control(equation("⟨ω,Λω⟩ = (h²-Dl)l/h²", spin.dot(body), (height**2 - D * power) * power / height**2, VERTICAL))


if __name__ == "__main__":
    main(__file__)
