"""Section 4: the discrete constraint, the reaction force, and the closed equation."""

import sympy as sp

from chapsym.derive import ball, limits, motion, principle, three
from chapsym.derive.derivation import replaced, written
from chapsym.derive.principle import ALGEBRA, R0, R0T, R1, R1T, RT, D, J, R, gamma, gammaT, m, rho
from chapsym.derive.words import Traces, WordAlgebra, unfolded
from chapsym.proofs.paper.s4_limits import exact_order
from chapsym.proofs.paper.s4_principle import TURN_1, TURN_2, equation, path_point, step_symbols
from chapsym.prove import Comparison, Equation, Point, Proof, claim, main

# Body rotations and the vertical tensor, as words in the attitudes.
NOW, NOW_T = RT * R1, R1T * R
BEFORE, BEFORE_T = R0T * R, RT * R0
GAMMA = RT * gamma * gammaT * R


def spatial_rotation(a: sp.Expr, b: sp.Expr) -> sp.Expr:
    """Ω̄ - Ω̄ᵀ for the step from the attitude a to the attitude b."""
    rotation = b * ALGEBRA.transpose(a)
    return rotation - ALGEBRA.transpose(rotation)


@claim(
    "4.9",
    r"\Delta r_k + \frac\rho2(\bar\Omega_k - \bar\Omega_k^T)\vec\gamma = 0,\ \langle\vec\gamma,\Delta r_k\rangle = 0,\ "
    r"\text{admits }(q,q),\ \text{and tends to (4.2)}",
)
def chosen_constraint(p: Proof) -> None:
    """The chosen discrete constraint: horizontal, consistent on the diagonal, of second order."""
    p.assume("(4.2) and (4.9) share the direction of γ; with γ upwards both need ρ → -ρ (see 2.1)")
    p.assume("Ω̄ = exp(ε ω̄) with ω̄ skew")
    rotational = unfolded(principle.turning_step())
    p.reads(step_symbols() | {r"\Delta r_k": (-principle.turning_step(), "as (4.9) says, by the derivation")})
    p.say("Δr is minus the rotational part of the constraint; its vertical component is γᵀΔr = tr(Δr γᵀ).")
    diagonal = rotational.subs({R1: R, R1T: RT})
    limit = limits.constraint()
    shown = unfolded(limit.limit), unfolded(limit.leading)
    p.show("(4.9)/ε - Δr/ε", f"{shown[0]} + ε^{limit.order}·({shown[1]}) + ...")
    continuous = principle.rolling_constraint(sp.S.Zero, limits.omega_space * R)
    both = ALGEBRA
    p.printed(
        Equation("γᵀ Δr_k = 0", principle.turning_step() * gammaT, sp.S.Zero, Traces(ALGEBRA)),
        equation("(4.9) at R_{k+1} = R_k, r_{k+1} = r_k", diagonal, sp.S.Zero),
        Equation("(4.9)/ε → the rotational part of (4.2), ρ ω̄ γ", limit.limit, continuous, both),
    )
    p.lemma(exact_order("the remainder", limit, 2))
    p.lemma(Equation("its leading term is (ρ/6) ω̄³γ", limit.leading, rho * limits.omega_space**3 * gamma / 6, both))
    p.say("For n = 3, in the frame of the body and with γ upwards, Δr = (ρ/2)(Ω - Ωᵀ)γ:")
    crossed = 2 * three.q0 * three.q.cross(three.gamma)
    p.lemma(Equation("½(Ω - Ωᵀ)γ = 2q₀ q × γ in Euler parameters", three.centre_step(), crossed, three.RING))
    naive = rho * R1 * RT * gamma
    p.control(Equation("the naive constraint is horizontal", naive * gammaT, sp.S.Zero, Traces(ALGEBRA)))
    p.control(equation("the naive constraint admits (q, q)", naive.subs({R1: R, R1T: RT}), sp.S.Zero))
    p.control(Equation("(4.9)/ε → ρ ω̄ᵀγ", limit.limit, -rho * limits.omega_space * gamma, both))


@claim(
    "4.9-naive",
    r"\Delta r_k + \rho\,\bar\Omega_k\bar\gamma = 0,\ \text{which imitates the form of (2.9) and allows } \Delta r_k"
    r"\text{ that are not horizontal}",
)
def naive_constraint(p: Proof) -> None:
    """It has the form of (2.9) and not its limit; it allows displacements that are not horizontal, even at rest."""
    p.infers(
        "That the formula imitates (2.9) is seen from the two; that it allows what is not horizontal, from one example."
    )
    p.say("Its form is that of (2.9), v + ρωγ = 0: Δr stands for v and Ω̄ = R_{k+1}R_kᵀ for ω.")
    form = written(
        "rolling_form", "v + ρωγ, which vanishes (2.9)", motion.v - motion.rolling_velocity(), WordAlgebra({})
    )
    step = {motion.v: principle.r1 - principle.r, motion.omega: R1 * RT}
    imitated = replaced("imitated", "Δr_k for v and Ω̄_k for ω", form, step, ALGEBRA)
    p.reads(
        step_symbols(),
        (r"\bar\gamma", gamma, "the vertical unit vector in space (4.2)"),
        ("0", imitated, "(2.9) with Δr_k for v and Ω̄_k for ω, by the derivation"),
    )
    p.printed(equation("Δr + ρΩ̄γ = (2.9) with Δr for v and Ω̄ for ω", step[motion.v] + rho * R1 * RT * gamma, imitated))
    p.say("Its vertical component is -ρ γᵀΩ̄γ; n = 3, Ω̄ by Euler parameters:")
    naive = -rho * R1 * RT * gamma
    shift = -rho * sp.Matrix(three.rotation()) * three.gamma
    at = three.placed(((three.q0, *three.q), ("4/5", "3/5", 0, 0)), (three.gamma, (0, 0, 1))) | {rho: 1}
    units = [sp.Eq(three.UNIT_QUATERNION, 0), sp.Eq(three.UNIT_VERTICAL, 0)]
    expected = map(sp.Rational, (0, "24/25", "-7/25"))
    p.printed(Comparison("⟨γ, Δr⟩ ≠ 0 at Ω̄ = a turn by (7/25, 24/25) about e₁, γ = e₃, ρ = 1: Δr = (0, 24/25, -7/25)",
                         [*units, sp.Ne(three.gamma.dot(shift), 0),
                          *(sp.Eq(x, value) for x, value in zip(shift, expected, strict=True))],
                         at))  # fmt: skip
    p.witness("generic", {"Ω̄": "a turn about e1 by cos θ = 7/25, sin θ = 24/25", "γ": "e3", "ρ": "1"})
    p.say("It imitates no more than the form.  At Ω̄ = 1 it asks for Δr = -ργ: it does not admit (q, q).  For Ω̄ =")
    p.say("exp(εω̄) and a path with Δr = O(ε) it does not tend to (4.2): the coefficients of 1 and of ε in -Δr/ρ are")
    p.lemma(equation("Δr at R_{k+1} = R_k is -ργ", naive.subs({R1: R, R1T: RT}), -rho * gamma))
    turn = written("turn", "Ω̄ = R_{k+1} R_kᵀ = exp(ε ω̄)", R1 * RT, ALGEBRA)
    zeroth, first, *_ = limits.coefficients(turn, limits.SPACE_STEP)
    p.lemma(
        equation("that of 1 is γ", zeroth * gamma, gamma),
        equation("that of ε is ω̄γ", first * gamma, limits.omega_space * gamma),
    )
    p.control(equation("that of 1 is 0: (4.2) is the limit", zeroth * gamma, sp.S.Zero))
    p.control(Equation("its vertical component vanishes", naive * gammaT, sp.S.Zero, Traces(ALGEBRA)))


@claim("4.9-limit", r"\bar\Omega_k \mapsto \mathbf I + \omega", uses=["4.9"])
def rotation_limit(p: Proof) -> None:
    """The continuous limit of the rotation: ε is missing."""
    p.slips("typo")
    algebra, spin = ALGEBRA, limits.omega_space
    turn = written("turn", "Ω̄ = R_{k+1} R_kᵀ = exp(ε ω̄)", R1 * RT, ALGEBRA)
    zeroth, first, *_ = limits.coefficients(turn, limits.SPACE_STEP)
    p.show("Ω̄", f"{unfolded(zeroth)} + ({unfolded(first)})·ε + ...")
    p.say("As a statement about the limit: Ω̄ = 1 + (first order) + O(ε²), where the first order is εω, not ω.")
    e = sp.Symbol("e")  # a value for ε, a parameter of the words
    p.reads(
        (r"\bar\Omega_k", zeroth + e * first, "its terms up to the order ε, by the derivation"),
        (r"\mathbf I", sp.S.One, "the unit matrix"),
        (r"\omega", spin, "the skew ω of Ω̄_k = exp(εω)"),
        (r"\varepsilon", e, "ε"),
    )
    p.printed(Equation("the part of Ω̄ up to order 1 = 1 + ω", zeroth + e * first, 1 + spin, algebra))
    p.corrected(
        r"\bar\Omega_k \mapsto \mathbf I + \varepsilon\omega",
        Equation("the part of Ω̄ up to order 1 = 1 + εω", zeroth + e * first, 1 + e * spin, algebra),
    )
    turn = sp.Matrix([[0, 0, 0], [0, 0, -1], [0, 1, 0]])
    values = {spin: turn, e: sp.Rational(1, 2)}
    shown = {"ω": str(turn.tolist()), "ε": "1/2"}
    p.counterexample(Point(shown, values))
    p.control(Equation("up to order 1 it is 1 - εω", zeroth + e * first, 1 - e * spin, algebra))


@claim(
    "4.9-f",
    r"\vec f^k = -\frac{m\rho}2(\bar\Omega_k-\bar\Omega_k^T)\vec\gamma "
    r"+ \frac{m\rho}2(\bar\Omega_{k-1}-\bar\Omega_{k-1}^T)\vec\gamma",
    uses=["4.4", "4.9"],
)
def spatial_reaction(p: Proof) -> None:
    """The reaction in space: (4.4) on the discrete constraint."""
    force = principle.rolling_reaction()
    p.show("f", force)
    after, before = (m * rho / 2 * spatial_rotation(*pair) * gamma for pair in [(R, R1), (R0, R)])
    p.reads(step_symbols() | {r"\vec f^k": (force, "m(Δr_k - Δr_(k-1)) where (4.9) holds, by the derivation")})
    p.printed(equation("f as printed = m(Δr_k - Δr_{k-1}) on (4.9)", -after + before, force))
    p.control(equation("f with its second sign flipped", -after - before, force))


@claim(
    "4.9-F",
    r"\vec F^k = -\frac{m\rho}2(\Omega_k-\Omega_k^T)\gamma_k - \frac{m\rho}2(\Omega_{k-1}-\Omega_{k-1}^T)\gamma_k",
    uses=["4.9-f"],
)
def body_reaction(p: Proof) -> None:
    """The reaction in the body: the sign of its second term is misprinted."""
    p.slips("typo")
    force = RT * principle.rolling_reaction()
    after = m * rho / 2 * (NOW - NOW_T) * RT * gamma
    before = m * rho / 2 * (BEFORE - BEFORE_T) * RT * gamma
    p.reads(step_symbols() | {r"\vec F^k": (force, "R_kᵀf^k (4.8), f^k as it is derived (4.9-f)")})
    p.printed(equation("F as printed = R_kᵀ f", -after - before, force))
    p.corrected(
        r"\vec F^k = -\frac{m\rho}2(\Omega_k-\Omega_k^T)\gamma_k + \frac{m\rho}2(\Omega_{k-1}-\Omega_{k-1}^T)\gamma_k",
        equation("F with + in its second term = R_kᵀ f", -after + before, force),
    )
    p.counterexample(
        path_point({R0: sp.eye(3), R: TURN_1, R1: TURN_2, gamma: sp.Matrix([0, 0, 1]), m: sp.S.One, rho: sp.S.One})
    )
    p.control(equation("F with both signs flipped", after - before, force))


@claim(
    "4.9-wedge",
    r"\vec F^k\wedge\gamma_k^T = -\frac{m\rho}2[\Omega_k\Gamma_k+\Gamma_k\Omega_k] "
    r"+ \frac{m\rho}2[\Omega_k^T\Gamma_k+\Gamma_k\Omega_k^T] "
    r"+ \frac{m\rho}2[\Omega_{k-1}\Gamma_k+\Gamma_k\Omega_{k-1}] "
    r"- \frac{m\rho}2[\Omega_{k-1}^T\Gamma_k+\Gamma_k\Omega_{k-1}^T]",
    uses=["4.9-F"],
)
def torque(p: Proof) -> None:
    """The torque of the reaction, from the corrected F."""
    p.assume("F with the correction of (4.9-F); its printed sign does not give the printed torque")

    def both_sides(x: sp.Expr) -> sp.Expr:
        return m * rho / 2 * (x * GAMMA + GAMMA * x)

    printed = -both_sides(NOW) + both_sides(NOW_T) + both_sides(BEFORE) - both_sides(BEFORE_T)
    force = m * rho / 2 * (BEFORE - BEFORE_T - NOW + NOW_T) * RT * gamma
    p.reads(step_symbols() | {r"\vec F^k": (force, "as corrected (4.9-F)")})
    p.printed(equation("the printed torque = Fγᵀ - γFᵀ", printed, ALGEBRA.wedge(force, RT * gamma)))
    derived = ALGEBRA.wedge(RT * principle.rolling_reaction(), RT * gamma)
    p.lemma(equation("the printed torque is that of the F that is derived", printed, derived))
    wrong = -m * rho / 2 * ((NOW - NOW_T) + (BEFORE - BEFORE_T)) * RT * gamma
    p.control(equation("the printed torque = Fγᵀ - γFᵀ with the printed F", printed, ALGEBRA.wedge(wrong, RT * gamma)))


def closed_sides(sign: int = 1) -> tuple[sp.Expr, sp.Expr]:
    """The two sides of (4.10) as printed; `sign` mutates the first D-term of the right side."""

    def both_sides(x: sp.Expr) -> sp.Expr:
        return D / 2 * (x * GAMMA + GAMMA * x)

    now, before = NOW * J - J * NOW_T, BEFORE * J - J * BEFORE_T
    left = now + both_sides(NOW) - both_sides(NOW_T)
    right = BEFORE_T * before * BEFORE + sign * both_sides(BEFORE) - both_sides(BEFORE_T)
    return left, right


@claim(
    "4.10",
    r"M_k + \frac{m\rho^2}2[\Omega_k\Gamma_k+\Gamma_k\Omega_k] - \frac{m\rho^2}2[\Omega_k^T\Gamma_k+\Gamma_k\Omega_k^T] "
    r"= \Omega_{k-1}^T M_{k-1}\Omega_{k-1} + \frac{m\rho^2}2[\Omega_{k-1}\Gamma_k+\Gamma_k\Omega_{k-1}] "
    r"- \frac{m\rho^2}2[\Omega_{k-1}^T\Gamma_k+\Gamma_k\Omega_{k-1}^T]",
    uses=["4.7", "4.9-wedge"],
)
def closed_equation(p: Proof) -> None:
    """The closed equation for (Ω, γ): the balance with the forces eliminated."""
    p.assume("𝕃 with the correction of (4.1); F with that of (4.9-F)")
    p.say("R_kᵀ S R_k with m = D/ρ² and Δr from (4.9); it vanishes along every path:")
    balance = ball.body_balance()
    p.show("R_kᵀ S R_k", balance)
    left, right = closed_sides()
    p.reads(step_symbols(), ("0", balance, "the principle in the body, on the discrete constraint, by the derivation"))
    p.printed(equation("(4.10) left - right = R_kᵀ S R_k", left - right, balance))
    left, right = closed_sides(sign=-1)
    p.control(equation("(4.10) with one sign flipped", left - right, balance))
    p.control(equation("(4.10) with D in the place of D/2", (left - right).subs(D, 2 * D), balance))


if __name__ == "__main__":
    main(__file__)
