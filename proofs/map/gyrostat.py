"""The gyrostat, a ball with a rotor inside, in continuous time: lemmas of chapsym, which the paper does not state."""

import sympy as sp

from chapsym.derive import continuous, gyrostat, motion, three
from chapsym.derive.gyrostat import ALGEBRA, RATES, A, rotor
from chapsym.derive.limits import omega
from chapsym.derive.motion import D, Gamma, J, commutator
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import J1, J2, J3, gamma
from chapsym.derive.words import Traces, evaluate
from chapsym.proofs.paper.s2_classical import along, factor_and_divergence, solved_acceleration
from chapsym.proofs.paper.s2_every_n import moving
from chapsym.prove import Proof, claim, equations, main

RING = Quotient((*omega, *gamma, *rotor, J1, J2, J3, three.D), [three.UNIT_VERTICAL])

words, vectors = equations(ALGEBRA), equations(RING)

#: A rotor: its axis, its axial and transverse moments, and its angular velocity relative to the ball.
axis = sp.Matrix(sp.symbols("n1:4"))
moment, across, speed = sp.symbols("moment across speed")
ROTOR = Quotient((*axis, moment, across, speed, *omega, J1, J2, J3), [axis.dot(axis) - 1])


def kinetic(tensor: sp.Matrix, spin: sp.Matrix) -> sp.Expr:
    """The kinetic energy ½⟨ω, tensor ω⟩."""
    return spin.dot(tensor * spin) / 2


@claim(
    "gyrostat-rotor",
    r"T = \tfrac12\langle I\omega,\omega\rangle + i\dot\varphi\langle n,\omega\rangle + \tfrac12 i\dot\varphi^2;\quad "
    r"T - p\dot\varphi = \tfrac12\langle(I - i\,nn^T)\omega,\omega\rangle + p\langle n,\omega\rangle - \tfrac{p^2}{2i}"
    r"\ \text{ for } p = i(\dot\varphi + \langle n,\omega\rangle)",
)
def which_rotor(p: Proof) -> None:
    """A rotor that is driven at a constant speed, and one that turns freely, both add ⟨a,ω⟩ with a constant a."""
    p.assume("the rotor has its axis n fixed in the ball, is symmetric about it, and its centre is at that of the ball")
    p.say(
        "φ̇ is its angular velocity relative to the ball, i its moment about n, I the tensor of ball and rotor at rest"
    )
    p.say("in it.  (A rotor elsewhere moves as a point mass besides: that part is in I, if C stays the mass centre.)")
    body = sp.diag(J2 + J3, J1 + J3, J1 + J2)
    own = across * (sp.eye(3) - axis * axis.T) + moment * axis * axis.T
    whole = kinetic(body, omega) + kinetic(own, omega + speed * axis)
    locked, along = body + own, axis.dot(omega)
    equation = equations(ROTOR)
    driven = kinetic(locked, omega) + moment * speed * along + moment * speed**2 / 2
    p.printed(equation("T = ½⟨Iω,ω⟩ + iφ̇⟨n,ω⟩ + ½iφ̇²", whole, driven))
    p.say("Driven at a constant φ̇: a = iφ̇n, the angular momentum of the rotor relative to the ball, and I is that with")
    p.say("the rotor.  Free: φ does not occur in L nor in the rolling condition, so p = ∂T/∂φ̇ is constant:")
    impulse = moment * (speed + along)
    p.lemma(equation("∂T/∂φ̇ = i(φ̇ + ⟨n,ω⟩)", sp.diff(whole, speed), impulse))
    lighter = locked - moment * axis * axis.T
    routh = kinetic(lighter, omega) + impulse * along - impulse**2 / (2 * moment)
    p.printed(equation("Routh's T - pφ̇", whole - impulse * speed, routh))
    p.say(
        "so a = pn, the rotor's whole angular momentum along n, and I is that without the rotor's moment about n: that of"
    )
    p.say("a rod in its place, so that J ≥ 0 as before.  In both I is diagonal by a choice of the axes of the body.")
    p.lemma(
        equation("I - innᵀ has across(1 - nnᵀ) for the rotor", lighter, body + across * (sp.eye(3) - axis * axis.T))
    )
    p.control(equation("T without the term ⟨a,ω⟩", whole, driven - moment * speed * along))
    p.control(equation("Routh's with I", whole - impulse * speed, routh + kinetic(locked - lighter, omega)))


@claim(
    "gyrostat-motion",
    r"\dot{\mathbf K} + [\omega,\mathbf K] = 0,\ \mathbf K = J\omega + \omega J + D(\Gamma\omega + \omega\Gamma) + A;\quad "
    r"n = 3:\ K = B(\gamma)\omega + a,\ \dot K = K\times\omega,\ \dot\gamma = \gamma\times\omega",
    uses=["gyrostat-rotor", "2.11", "2.12", "2.13"],
)
def equations_of_motion(p: Proof) -> None:
    """The ball with a rotor, from d'Alembert's principle with ½ tr(AᵀRᵀṘ) added to the Lagrangian, for every n."""
    p.assume("γ is directed from the centre to the plane (2.9 as corrected); A is skew and constant in the body")
    p.say(
        "The rotor turns about the centre, and its term depends on R alone: its work for δR = Rη, up to a derivative,"
    )
    added, whole = gyrostat.added_torque(), gyrostat.eliminated()
    p.lemma(words("is ½ tr(η[ω,A])", added, commutator(motion.omega, A)))
    p.show("0", whole)
    momentum = gyrostat.contact_momentum()
    p.show("K", momentum)
    spin = motion.omega
    printed = J * spin + spin * J + D * (Gamma * spin + spin * Gamma) + A
    p.printed(
        words("K = Jω + ωJ + D(Γω + ωΓ) + A", printed, momentum),
        words(
            "K̇ + [ω,K] is the principle",
            moving("K_rotor", momentum, RATES, ALGEBRA) + commutator(spin, momentum),
            whole,
        ),
        words(
            "Γ̇ + [ω,Γ] = 0",
            moving("vertical_rotor", motion.gamma * motion.gammaT, RATES, ALGEBRA) + commutator(spin, Gamma),
            0,
        ),
    )
    p.say("For n = 3, A = a× and (A₃₂, A₁₃, A₂₁) of K:")
    values = {spin: omega.hat(), J: three.J, Gamma: gamma * gamma.T, A: rotor.hat(), D: three.D}
    found = three.axial(evaluate(momentum, values))
    p.printed(vectors("K = B(γ)ω + a", found, sp.Matrix(continuous.momentum()) + rotor))
    wrong = printed - 2 * A
    p.control(words("the same with -A in K", ALGEBRA.rate(wrong, RATES) + commutator(spin, wrong), whole))
    p.control(words("without the rotor in K", ALGEBRA.rate(printed - A, RATES) + commutator(spin, printed - A), whole))
    p.control(vectors("K = B(γ)ω - a", found, sp.Matrix(continuous.momentum()) - rotor))


def momentum() -> sp.Matrix:
    """K(ω, γ) = B(γ)ω + a."""
    return sp.Matrix(continuous.momentum()) + rotor


@claim(
    "gyrostat-integrals",
    r"\langle K,\gamma\rangle,\ \langle K,K\rangle,\ \langle\gamma,\gamma\rangle,\ H = \tfrac12\langle\omega,B(\gamma)\omega\rangle"
    r" = \tfrac12\langle K - a,\omega\rangle \text{ are integrals of the gyrostat}",
    uses=["gyrostat-motion", "2.5", "2.2-F"],
)
def integrals(p: Proof) -> None:
    """The four integrals of the ball with a rotor; for every n tr K², tr K²Γ and the energy."""
    p.assume("J_i + J_j > 0, D ≥ 0, so that Λ is regular and F > 0 (2.13)", *three.MOMENTS)
    faster, K = solved_acceleration(rotor), momentum()
    p.say("ω̇ of K̇ = K × ω with K = B(γ)ω + a, unique as B(γ) is regular:")
    p.lemma(vectors("K̇ = K × ω for Λω̇ = g + (D/F)⟨Λ⁻¹γ,g⟩γ, g = (Λω + a) × ω", along(K, faster), K.cross(omega)))
    energy = omega.dot(sp.Matrix(continuous.momentum())) / 2
    for name, value in (("⟨K,γ⟩", K.dot(gamma)), ("⟨K,K⟩", K.dot(K)), ("⟨γ,γ⟩", gamma.dot(gamma)), ("H", energy)):
        p.printed(vectors(f"d/dt {name} = 0", along(sp.Matrix([value]), faster), sp.zeros(1, 1)))
    p.lemma(vectors("H as a function of K, γ", gyrostat.energy().xreplace(three.placed((three.K, K))), energy))
    p.say("H is the kinetic energy of the ball; ⟨K,ω⟩ is not kept.  For every n, -½ tr(ω·(principle)) is dH/dt:")
    spin = motion.omega
    power = -spin * gyrostat.eliminated() / 2
    ball = -spin * (gyrostat.contact_momentum() - A) / 4
    p.lemma(
        words(
            "dH/dt, H = -¼ tr(ω(K - A)), is that", moving("energy_rotor", ball, RATES, ALGEBRA), power, Traces(ALGEBRA)
        )
    )
    p.control(vectors("d/dt ½⟨K,ω⟩ = 0", along(sp.Matrix([K.dot(omega) / 2]), faster), sp.zeros(1, 1)))
    plain = sp.Matrix(continuous.momentum())
    p.control(vectors("d/dt ⟨B(γ)ω,γ⟩ = 0", along(sp.Matrix([plain.dot(gamma)]), faster), sp.zeros(1, 1)))
    p.control(vectors("K̇ = K × ω with -a in ω̇", along(K, solved_acceleration(-rotor)), K.cross(omega)))


@claim(
    "gyrostat-measure",
    r"\sqrt F\,d\omega\,d\gamma \text{ is invariant for every } a,\ F = 1 - D\langle\gamma,\Lambda^{-1}\gamma\rangle",
    uses=["gyrostat-integrals", "2.6"],
)
def measure(p: Proof) -> None:
    """The rotor does not change the invariant measure."""
    p.assume("J_i + J_j > 0, D ≥ 0, so that Λ is regular and F > 0 (2.13)", *three.MOMENTS)
    p.assume("|γ| = 1: F is taken as ⟨Iγ, Λ⁻¹γ⟩ near the sphere, and the field is tangent to it")
    p.say("As in 2.6, div(√F X) = 0 is, times 2√F: Ḟ + 2F div X = 0, X = (ω̇, γ × ω).")
    factor, change, divergence = factor_and_divergence(solved_acceleration(rotor))
    p.printed(vectors("Ḟ + 2F div X = 0", change + 2 * factor * divergence, 0))
    p.say("a is not in it: what it adds to ω̇ is B(γ)⁻¹(a × ω), whose divergence is that of a symmetric matrix with a×.")
    extra = solved_acceleration(rotor) - solved_acceleration()
    p.lemma(vectors("∂/∂ω of what a adds to ω̇ has the trace 0", extra.jacobian(omega).trace(), 0))
    p.control(vectors("Ḟ + F div X = 0 (density F)", change + factor * divergence, 0))
    p.control(vectors("div X = 0 (density 1)", divergence, 0))


if __name__ == "__main__":
    main(__file__)
