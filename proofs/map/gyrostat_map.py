"""The gyrostat's map, by the discrete principle: what it keeps, and what it does not.  Lemmas of chapsym."""

from functools import cache

import sympy as sp

from chapsym.derive import ball, continuous, gyrostat, three
from chapsym.derive.ball import D, Gamma, J, K, Omega, OmegaT
from chapsym.derive.derivation import replaced
from chapsym.derive.gyrostat import RING, STEP, A, rotor, step_A
from chapsym.derive.limits import omega
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import J1, J2, J3, placed, q, q0
from chapsym.derive.words import Traces
from chapsym.proofs.map.self_adjoint import RETURN
from chapsym.prove import Comparison, Proof, claim, equations, main

words, vectors = equations(STEP), equations(RING)

QUATERNION = sp.Matrix([q0, *q])
#: A rotation, a unit vertical and a physical ball, for exact steps.
TURN = placed((QUATERNION, ("4/5", "2/5", "1/5", "2/5")))
UNIT = placed((three.gamma, ("2/7", "3/7", "6/7")))
THREE, EQUAL, ROLLING = placed((three.MASSES, (1, 2, 4))), placed((three.MASSES, (2, 2, 2))), {three.D: 8}
ROTOR = placed((rotor, (1, "1/2", -1)))


def half_turned() -> sp.Expr:
    """½(ΩA + AΩᵀ)."""
    return (Omega * step_A + step_A * OmegaT) / 2


def momentum() -> sp.Matrix:
    """𝒦(q, γ) for n = 3."""
    return sp.Matrix(three.momentum()) + gyrostat.added_momentum()


@claim(
    "gyrostat-map",
    r"\mathcal K = \mathcal K_0(\Omega,\Gamma) + \tfrac12(\Omega A + A\Omega^T),\ \mathcal K_+ = \Omega^T\mathcal K\Omega,\ "
    r"\Gamma_+ = \Omega^T\Gamma\Omega;\quad n = 3:\ \mathcal K = \mathcal K_0(q,\gamma) + q_0^2a + q_0\,q\times a"
    r" - \langle a,q\rangle q",
    uses=["prop-1", "4.1", "4.9", "5.1", "5.2", "gyrostat-motion"],
)
def the_map(p: Proof) -> None:
    """The discrete principle with ½ tr(AᵀR_kᵀR_{k+1}) in the Lagrangian, for every n, and its continuous limit."""
    p.assume("A is that of a step, εA of the motion, as 𝒦 = εK; 𝒦₀ is (4.13) of the ball")
    p.say("½ tr(AᵀΩ) is linear in Ω and odd under Ω ↦ Ωᵀ; for n = 3 it is 2q₀⟨a,q⟩.  It adds to the balance of momenta")
    now, before = gyrostat.split_balance()
    p.show("𝒦", now)
    p.printed(
        words("𝒦 = 𝒦₀ + ½(ΩA + AΩᵀ)", now, ball.momentum() + half_turned()),
        words("the rest of the balance is -Ωᵀ𝒦Ω of the step before", before, -ball.carried(now)),
    )
    vector = gyrostat.vector_momentum()
    p.printed(vectors("n = 3: 𝒦 = 𝒦₀(q,γ) + q₀²a + q₀ q×a - ⟨a,q⟩q", momentum(), vector))
    limit = gyrostat.limit()
    p.lemma(words("𝒦 has no part without ε for Ω = exp(εω) and εA", limit.constant, 0))
    spin = ball.omega
    p.lemma(
        words(
            "𝒦/ε → Jω + ωJ + D(Γω + ωΓ) + A", limit.limit, J * spin + spin * J + D * (Gamma * spin + spin * Gamma) + A
        )
    )
    p.say(
        "That is K of gyrostat-motion.  At q = 0 𝒦 is a, and its derivative there, twice that by the Gibbs vector, is"
    )
    slope = momentum().jacobian(q).subs(placed((QUATERNION, (1, 0, 0, 0))))
    p.lemma(
        vectors(
            "2B(γ)x - a × x",
            slope * omega,
            2 * sp.Matrix(three.contact_inertia()) * omega - rotor.cross(omega),
            WITH_SPIN,
        ),
        vectors(
            "⟨x, 2Bx - a×x⟩ = 2⟨x,Bx⟩",
            omega.dot(slope * omega),
            2 * omega.dot(sp.Matrix(continuous.momentum())),
            WITH_SPIN,
        ),
    )
    p.say("which is regular, as B > 0: so 𝒦 near a, for εK and εA with a small ε, has one small rotation.")
    p.control(words("𝒦 = 𝒦₀ + ½(ΩᵀA + AΩ)", now, ball.momentum() + (OmegaT * step_A + step_A * Omega) / 2))
    p.control(words("𝒦 = 𝒦₀ + A", now, ball.momentum() + step_A))
    p.control(words("𝒦/ε → K - 2A", limit.limit, limit.limit - 2 * A))
    p.control(vectors("n = 3 with -q₀ q×a", momentum() - 2 * q0 * q.cross(rotor), vector))


WITH_SPIN = Quotient((*omega, *RING.symbols), RING.relations)


@claim(
    "gyrostat-map-integrals",
    r"\mathrm{tr}\,\mathcal K^s,\ \mathrm{tr}(\mathcal K^s\Gamma^l),\ \mathrm{tr}\,\Gamma;\quad n = 3:\ "
    r"\langle\mathcal K,\gamma\rangle,\ |\mathcal K|^2,\ |\gamma|^2 \text{ are kept, whatever the branch}",
    uses=["gyrostat-map", "5.3"],
)
def integrals(p: Proof) -> None:
    """The momentum integrals of the gyrostat's map; the branch of Ω does not matter."""
    X, Y = sp.symbols("X Y", commutative=False)
    algebra = type(STEP)({**STEP.transposes, X: X, Y: Y}, STEP.rules)
    equation = equations(algebra)
    p.say("𝒦 and Γ are carried by one rotation, and nothing else is used:")
    p.lemma(equation("ΩᵀXΩ ΩᵀYΩ = ΩᵀXYΩ", ball.carried(X) * ball.carried(Y), ball.carried(X * Y)))
    p.printed(equation("tr ΩᵀXΩ = tr X", ball.carried(X), X, Traces(algebra)))
    for s, l in [(2, 0), (2, 1), (4, 0), (4, 1)]:
        word = ball.carried(K) ** s * ball.carried(Gamma) ** l
        p.printed(equation(f"tr K^{s}Γ^{l}", word, K**s * Gamma**l, Traces(algebra)))
    turn, vector = sp.Matrix(three.rotation()), three.K
    ring = Quotient((*vector, *RING.symbols), RING.relations)
    moved, vertical = turn.T * vector, turn.T * three.gamma
    for name, before, after in (
        ("⟨𝒦,γ⟩", vector.dot(three.gamma), moved.dot(vertical)), ("|𝒦|²", vector.dot(vector), moved.dot(moved)),
        ("|γ|²", three.gamma.dot(three.gamma), vertical.dot(vertical)),
    ):  # fmt: skip
        p.printed(vectors(name, after, before, ring))
    relative = moved - rotor
    p.control(vectors("|𝒦 - a|²", relative.dot(relative), (vector - rotor).dot(vector - rotor), ring))
    p.control(vectors("⟨Ωᵀ𝒦, Ωγ⟩ = ⟨𝒦,γ⟩", moved.dot(turn * three.gamma), vector.dot(three.gamma), ring))


def momentum_back(sign: int) -> sp.Symbol:
    """𝒦 of the reversed step, with sign·A, as a step of the certificate."""
    name = "gyrostat_back" if sign < 0 else "gyrostat_back_same"
    text = "Ωᵀ for Ω, γ_+ = Ωᵀγ for γ" + (", -A for A" if sign < 0 else "")
    return replaced(name, text, gyrostat.momentum(), RETURN | {step_A: sign * step_A}, gyrostat.BOTH)


@claim(
    "gyrostat-self-adjoint",
    r"\mathcal K(\Omega^T,\Omega^T\gamma;-A) = -\Omega^T\mathcal K(\Omega,\gamma;A)\Omega;\ \Phi_{-\varepsilon}\circ\Phi_\varepsilon = 1;"
    r"\quad (\mathcal K,\gamma)\mapsto(-\mathcal K,\gamma) \text{ reverses it with } A\mapsto -A, \text{ not with } A",
    uses=["gyrostat-map", "self-adjoint"],
)
def self_adjoint(p: Proof) -> None:
    """The step with -ε undoes the step, for every n; it is reversible only if the rotor is reversed, too."""
    p.assume("the step back takes the rotation Ωᵀ, as in self-adjoint")
    p.say(
        "Φ_ε finds Ω from 𝒦(Ω, γ; εA) = εK.  The rotor's term with its ends exchanged changes its sign, as A does with ε:"
    )
    forth = gyrostat.discrete_term(gyrostat.space.R, gyrostat.space.R1)
    back = gyrostat.discrete_term(gyrostat.space.R1, gyrostat.space.R)
    p.lemma(words("½ tr(AᵀR_{k+1}ᵀR_k) = -½ tr(AᵀR_kᵀR_{k+1})", back, -forth, Traces(gyrostat.SPACE)))
    here = gyrostat.momentum()
    p.printed(words("𝒦(Ωᵀ, Γ_+; -A) = -Ωᵀ𝒦(Ω, Γ; A)Ω", momentum_back(-1), -ball.carried(here)))
    p.say(
        "So Φ_{-ε} at (K_+, γ_+) has the solution Ωᵀ, and leads to ΩK_+Ωᵀ = K and Ωγ_+ = γ: Φ_{-ε}Φ_ε = 1.  By the same"
    )
    p.say("equation (-𝒦_+, γ_+) leads back to (-𝒦, γ) with the rotor -a.  With a as it is Ωᵀ is off by AΩ + ΩᵀA:")
    off = step_A * Omega + OmegaT * step_A
    p.printed(words("𝒦(Ωᵀ, Γ_+; A) + Ωᵀ𝒦Ω = AΩ + ΩᵀA", momentum_back(1) + ball.carried(here), off))
    p.say("which for n = 3 has the vector 2(q₀²a - q₀ q×a - ⟨a,q⟩q), not 0:")
    twice = 2 * gyrostat.added_momentum().xreplace(placed((q, -q)))
    turned = sp.Matrix(three.rotation())
    ring = Quotient((q0, *q, *rotor), [three.UNIT_QUATERNION])
    found = three.axial(rotor.hat() * turned + turned.T * rotor.hat())
    p.lemma(vectors("the vector of AΩ + ΩᵀA", found, twice, ring))
    p.printed(Comparison("it is not 0 at q = (4, 2, 1, 2)/5, a = (1, ½, -1)", [sp.Ne(twice[0], 0)], TURN | ROTOR))
    p.control(words("𝒦(Ωᵀ, Γ_+; A) = -Ωᵀ𝒦(Ω, Γ; A)Ω", momentum_back(1), -ball.carried(here)))
    p.control(words("𝒦(Ωᵀ, Γ_+; -A) = +Ωᵀ𝒦Ω", momentum_back(-1), ball.carried(here)))
    p.control(Comparison("it is not 0 without a rotor", [sp.Ne(twice[0], 0)], TURN | dict.fromkeys(rotor, 0)))


@cache
def energies() -> tuple[sp.Expr, sp.Expr]:
    """H = ½⟨𝒦 - a, ω⟩ before and after a step, as functions of q, γ."""
    turn = sp.Matrix(three.rotation()).T
    places = ((momentum(), three.gamma), (turn * momentum(), turn * three.gamma))
    start, end = (gyrostat.energy().xreplace(placed((three.K, k), (three.gamma, g))) for k, g in places)
    return start, end


def changes(name: str, at: dict) -> Comparison:
    """The statement that H differs before and after an exact step."""
    units = [sp.Eq(three.UNIT_QUATERNION, 0), sp.Eq(three.UNIT_VERTICAL, 0)]
    return Comparison(name, [*units, sp.Ne(*energies())], at)


@claim(
    "gyrostat-energy",
    r"H = \tfrac12\langle\mathcal K - a,\omega\rangle \text{ is kept for } D = 0 \text{ with } I_1 = I_2,\ a \parallel e_3,"
    r"\text{ or with } I_1 = I_2 = I_3; \text{ it is not in general for } D = 0, \text{ nor for } I_1 = I_2 = I_3,"
    r"\ D \ne 0, \text{ nor for } \mathcal K = h\gamma",
    uses=["gyrostat-map", "gyrostat-integrals", "energy-without-rolling"],
)
def energy(p: Proof) -> None:
    """The gyrostat's map does not keep the energy where the ball's does, except for D = 0 and a symmetric body."""
    p.assume("H of gyrostat-integrals, in 𝒦 and a of a step; J_i + J_j > 0, D ≥ 0", *three.MOMENTS)
    start, end = (x.subs(three.D, 0) for x in energies())
    ring = Quotient((q0, *q, *three.gamma, *rotor, J1, J2, J3), [three.UNIT_QUATERNION, three.UNIT_VERTICAL])
    equal, along = {J2: J1, J3: J1}, {J2: J1, rotor[0]: 0, rotor[1]: 0}
    p.printed(
        vectors("D = 0, I₁ = I₂ = I₃: H is kept", end.subs(equal), start.subs(equal), ring),
        vectors("D = 0, I₁ = I₂, a = a₃e₃: H is kept", end.subs(along), start.subs(along), ring),
    )
    p.say("In exact steps with q = (4, 2, 1, 2)/5, γ = (2, 3, 6)/7, a = (1, ½, -1) it changes:")
    at = TURN | UNIT | ROTOR
    p.printed(
        changes("D = 0, J = (1, 2, 4)", at | THREE | {three.D: 0}),
        changes("I₁ = I₂ = I₃, J = (2, 2, 2), D = 8", at | EQUAL | ROLLING),
    )
    p.say("With vertical momentum: a such that 𝒦 = hγ with h = 5 for J = (1, 2, 4), D = 8:")
    upright, height = TURN | UNIT | THREE | ROLLING, 5
    slope, rest = gyrostat.added_momentum().jacobian(rotor), sp.Matrix(three.momentum())
    solved = slope.subs(upright).LUsolve((height * three.gamma - rest).subs(upright))
    vertical = upright | placed((rotor, solved))
    p.show("a", list(solved))
    holds = [sp.Eq(x, height * g) for x, g in zip(momentum(), three.gamma, strict=True)]
    p.lemma(Comparison("𝒦 = 5γ in this step", holds, vertical))
    p.printed(changes("𝒦 = 5γ", vertical))
    p.say("Whether another function that tends to H is kept is not decided.")
    still = dict.fromkeys(rotor, 0)
    p.control(changes("it changes for D = 0 without a rotor", at | still | THREE | {three.D: 0}))
    p.control(changes("it changes for I₁ = I₂ = I₃ without a rotor", at | still | EQUAL | ROLLING))
    p.control(vectors("D = 0, I₁ = I₂, a = a₁e₁: H is kept", *(
        x.subs({J2: J1, rotor[1]: 0, rotor[2]: 0}) for x in (end, start)), ring))  # fmt: skip


@cache
def volumes() -> tuple[sp.Expr, sp.Expr]:
    """The determinants of the derivatives of (𝒦, γ) before and after a step, in a rotation of q and in γ."""
    turn, body = sp.Matrix(three.rotation()), sp.Matrix.hstack(*three.body_directions())
    by_turn, by_vertical = (
        [(x.jacobian(y) * z) for x in (momentum(), turn.T * momentum(), turn.T * three.gamma)]
        for y, z in ((QUATERNION, body), (three.gamma, sp.eye(3)))
    )
    after = by_turn[1] - turn.T * by_vertical[0] * turn * by_turn[2]
    return three.determinant(by_turn[0].T), three.determinant(after.T)


@claim(
    "gyrostat-map-measure",
    r"D = 0:\ d\mathcal K\,d\gamma \text{ is kept for every } a;\quad I_1 = I_2 = I_3,\ D \ne 0:\ "
    r"\text{it is not, the measure of the continuous ball, which the map without a rotor keeps}",
    uses=["gyrostat-map", "gyrostat-measure"],
)
def measure(p: Proof) -> None:
    """With D = 0 the gyrostat's map keeps the volume; with equal moments, D > 0 and a rotor it does not."""
    p.assume("∂𝒦/∂q is regular: the step is a branch near (𝒦, γ)")
    p.say("In w, which turns q to q∘(1, w), and γ: (𝒦, γ) has the derivative X = (𝒦_w, 𝒦_γ; 0, 1), and (Ωᵀ𝒦, Ωᵀγ) has")
    p.say("Y = ((Ωᵀ𝒦)_w, Ωᵀ𝒦_γ; (Ωᵀγ)_w, Ωᵀ); the step has det Y/det X, det X = det 𝒦_w and, as det Ω = 1,")
    p.say("det Y = det((Ωᵀ𝒦)_w - Ωᵀ𝒦_γΩ(Ωᵀγ)_w).  As |γ|² is kept, it is that on the sphere, whatever 𝒦 is beside it.")
    p.say("For D = 0 𝒦_γ is 0, and det Y = det((Ωᵀ𝒦)_w):")
    free = {three.D: 0}
    start, turn = momentum().subs(free), sp.Matrix(three.rotation()).T
    ring = Quotient((q0, *q, *rotor, J1, J2, J3), [three.UNIT_QUATERNION])
    end = start.xreplace(placed((q, -q), (rotor, -rotor))) * -1
    p.lemma(vectors("Ωᵀ𝒦(q; a) = -𝒦(-q; -a) for D = 0", turn * start, end, ring))
    body = sp.Matrix.hstack(*three.body_directions())
    here, there = (three.determinant((x.jacobian(QUATERNION) * body).T) for x in (start, end))
    p.printed(vectors("det ∂(Ωᵀ𝒦) = det ∂𝒦 for D = 0", there, here, ring))
    p.say("For equal moments F = 1 - D/(I + D): the continuous ball has the constant density.  At q = (4, 2, 1, 2)/5:")
    at = TURN | UNIT | EQUAL | ROLLING
    before, after = volumes()
    p.printed(Comparison("J = (2, 2, 2), D = 8, a = (1, ½, -1): det Y ≠ det X", [sp.Ne(after, before)], at | ROTOR))
    still = at | dict.fromkeys(rotor, 0)
    p.lemma(Comparison("J = (2, 2, 2), D = 8 without a rotor: det Y = det X", [sp.Eq(after, before)], still))
    p.say("Whether another density is kept is not decided.")
    rolling = at | ROTOR | {three.D: 0}
    p.control(Comparison("J = (2, 2, 2), D = 0: det Y ≠ det X", [sp.Ne(after, before)], rolling))
    p.control(vectors("det ∂(Ωᵀ𝒦) = -det ∂𝒦 for D = 0", there, -here, ring))


if __name__ == "__main__":
    main(__file__)
