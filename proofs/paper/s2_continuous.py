"""Section 2: what the map's units, energy and contact trace rest on."""

import sympy as sp

from chapsym.derive import continuous, three
from chapsym.derive.continuous import RING, inverse_inertia
from chapsym.derive.limits import omega
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import J1, J2, J3, D, K, gamma
from chapsym.proofs import glossary
from chapsym.prove import Equation, Proof, claim, equations, main, rational_point

equation = equations(RING)

#: A ball, a unit vertical and an angular velocity, for counterexamples.
BALL = {J1: 1, J2: 2, J3: 4, D: 8}
UNIT = dict(zip(gamma, map(sp.Rational, ("2/7", "3/7", "6/7")), strict=True))
SPIN = dict(zip(omega, (1, -1, 2), strict=True))


def unit_vertical() -> Equation:
    """|γ|² = 1."""
    return equation("|γ|² = 1", gamma.dot(gamma), 1)


#: The velocity of the centre, the radius, and the velocity of the ball's point at P = C - ργ.
VELOCITY, RADIUS = sp.Matrix(sp.symbols("v1:4")), sp.Symbol("rho")
SLIP = VELOCITY + omega.cross(-RADIUS * gamma)


@claim("2.1", r"v + \rho\,\omega\times\gamma = 0,\ \gamma \text{ the vertical unit vector}")
def rolling_condition(p: Proof) -> None:
    """The sign is wrong if γ is directed upwards, as it is before (2.9); at (2.1) no direction is printed."""
    p.slips("convention")
    p.reads(
        glossary.ball(),
        ("v", VELOCITY, "the velocity of the centre (2.1)"),
        (r"\rho", RADIUS, "the radius (2.1)"),
        ("0", SLIP, "the velocity of the point of the ball at P = C - ργ, which vanishes"),
    )
    v, rho = VELOCITY, RADIUS
    ring = Quotient((*v, rho, *omega, *gamma))
    p.assume("γ is directed upwards, from the plane to the centre C (Section 2, before 2.9): P = C - ργ")
    p.say("The velocity of the material point at P is v + ω × (P - C), and rolling says that it vanishes.")
    slip = SLIP
    p.show("velocity of P", slip.T.tolist()[0])
    p.printed(Equation("v + ρ ω×γ = the velocity of P", v + rho * omega.cross(gamma), slip, ring))
    p.corrected(
        r"v - \rho\,\omega\times\gamma = 0,\ \text{(or } \gamma \text{ directed downwards, from } C \text{ to } P)",
        Equation("v - ρ ω×γ = the velocity of P", v - rho * omega.cross(gamma), slip, ring),
    )
    down = v + rho * omega.cross(gamma) - (v + omega.cross(rho * gamma))
    p.lemma(Equation("with γ downwards, P = C + ργ, the printed form is right", down, [0, 0, 0], ring))
    p.say("Example: γ = e₃ up, ω = e₂: the ball moves along +e₁ with speed ρ, as anyone can see on a table.")
    point = {**dict(zip(v, (1, 0, 0), strict=True)), rho: 1}
    point |= {**dict(zip(omega, (0, 1, 0), strict=True)), **dict(zip(gamma, (0, 0, 1), strict=True))}
    p.counterexample(rational_point(point))
    p.control(Equation("v - ρ γ×ω = the velocity of P", v - rho * gamma.cross(omega), slip, ring))


@claim("2.2-F", r"F = \langle J\gamma,\Lambda^{-1}\gamma\rangle \equiv 1 - D\langle\gamma,\Lambda^{-1}\gamma\rangle")
def rolling_factor(p: Proof) -> None:
    """The two forms of F agree on the unit sphere; J is here the inertia tensor, Λ - D."""
    p.reads(glossary.classical())
    p.assume("J of Section 2 is the inertia tensor I = diag(J₂+J₃, ...), not the mass tensor of Section 5")
    inverse = inverse_inertia()
    printed = (three.lam() - D * sp.eye(3)) * gamma
    second = 1 - D * gamma.dot(inverse * gamma)
    p.printed(equation("⟨Iγ, Λ⁻¹γ⟩ = 1 - D⟨γ, Λ⁻¹γ⟩", printed.dot(inverse * gamma), second))
    free = Quotient(RING.symbols)
    p.control(Equation("the same without |γ| = 1", printed.dot(inverse * gamma), second, free))
    p.control(equation("F = 1 + D⟨γ, Λ⁻¹γ⟩", printed.dot(inverse * gamma), 2 - second))
    p.control(equation("J the mass tensor: ⟨Jγ, Λ⁻¹γ⟩ = F", (three.J * gamma).dot(inverse * gamma), second))


def on_motion(expr: sp.Expr) -> sp.Expr:
    """An expression with K replaced by K(ω, γ)."""
    return expr.xreplace(dict(zip(K, continuous.momentum(), strict=True)))


@claim("2.5-inverse", r"\Lambda\omega = K - \frac DF\langle\gamma,\Lambda^{-1}K\rangle\gamma", uses=["2.2-F"])
def inverse_momentum(p: Proof) -> None:
    """The inverse of K(ω, γ): the sign is misprinted."""
    p.slips("serious")
    p.reads(
        glossary.classical()
        | {"K": (sp.Matrix(continuous.momentum()), "Λω - D⟨ω,γ⟩γ, the momentum about the point of contact (2.3)")}
    )
    p.assume("J_i + J_j > 0, D ≥ 0, so that Λ is regular and F > 0 (2.13)", *three.MOMENTS)
    p.show("K(ω, γ)", sp.Matrix(continuous.momentum()))
    lift = D / continuous.rolling_factor() * gamma.dot(inverse_inertia() * K) * gamma
    left = list(three.lam() * omega)

    def inverse(text: str, sign: int) -> Equation:
        return equation(text, left, (K + sign * lift).applyfunc(on_motion))

    p.printed(inverse("Λω = K - (D/F)⟨γ, Λ⁻¹K⟩γ", -1))
    p.corrected(
        r"\Lambda\omega = K + \frac DF\langle\gamma,\Lambda^{-1}K\rangle\gamma", inverse("Λω = K + (D/F)⟨γ, Λ⁻¹K⟩γ", +1)
    )
    p.lemma(
        Equation(
            "ω(K(ω, γ), γ) = ω for the derived inverse",
            list(sp.Matrix(continuous.angular_velocity()).applyfunc(on_motion)), list(omega), RING,
        )
    )  # fmt: skip
    p.counterexample(rational_point({**BALL, **UNIT, **SPIN}, [unit_vertical()]))
    p.control(inverse("Λω = K + 2(D/F)⟨γ, Λ⁻¹K⟩γ", 2))


@claim(
    "2.5",
    r"\langle K,\omega\rangle = \langle K,\Lambda^{-1}K\rangle - \frac DF\langle\gamma,\Lambda^{-1}K\rangle^2",
    uses=["2.5-inverse"],
)
def energy_integral(p: Proof) -> None:
    """The energy integral as a function of K, γ: the sign is misprinted with that of the inverse."""
    p.slips("serious", "2.5-inverse")
    p.reads(
        glossary.classical(),
        ("K", K, "the momentum about the point of contact (2.3)"),
        (r"\omega", sp.Matrix(continuous.angular_velocity()), "Λ⁻¹(K + (D/F)⟨γ,Λ⁻¹K⟩γ) (2.5-inverse as corrected)"),
    )
    p.assume("J_i + J_j > 0, D ≥ 0, so that F > 0 (2.13)", *three.MOMENTS)
    p.say("ω(K, γ) is the inverse of K(ω, γ) that 2.5-inverse proves.")
    quadratic = K.dot(inverse_inertia() * K)
    lifted = D / continuous.rolling_factor() * gamma.dot(inverse_inertia() * K) ** 2
    left = [K.dot(sp.Matrix(continuous.angular_velocity()))]
    p.printed(equation("⟨K,ω⟩ = ⟨K,Λ⁻¹K⟩ - (D/F)⟨γ,Λ⁻¹K⟩²", left, quadratic - lifted))
    p.corrected(
        r"\langle K,\omega\rangle = \langle K,\Lambda^{-1}K\rangle + \frac DF\langle\gamma,\Lambda^{-1}K\rangle^2",
        equation("⟨K,ω⟩ = ⟨K,Λ⁻¹K⟩ + (D/F)⟨γ,Λ⁻¹K⟩²", left, quadratic + lifted),
    )
    momentum = dict(zip(K, (1, "-1/2", "3/4"), strict=True))
    p.counterexample(rational_point({**BALL, **UNIT, **momentum}, [unit_vertical()]))
    p.lemma(equation("the derived energy is ½⟨K,ω⟩", 2 * continuous.energy(), left))
    p.say("The kinetic energy is half of ⟨K,ω⟩: ½m|v|² + ½⟨Iω,ω⟩ with |v| = ρ|ω×γ|.")
    in_motion = sp.Matrix(continuous.momentum()).dot(omega)
    p.lemma(equation("½⟨K,ω⟩ = ½m|v|² + ½⟨Iω,ω⟩", in_motion / 2, continuous.lagrangian_energy()))
    p.control(equation("⟨K,ω⟩ = ½m|v|² + ½⟨Iω,ω⟩", in_motion, continuous.lagrangian_energy()))
    p.control(equation("⟨K,ω⟩ with F = 1", left, quadratic + lifted * continuous.rolling_factor()))


if __name__ == "__main__":
    main(__file__)
