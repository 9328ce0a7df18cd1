"""Section 4: from the discrete Lagrange-d'Alembert principle to the discrete Euler-Poincaré form."""

import sympy as sp

from chapsym.derive import principle
from chapsym.derive.derivation import replaced
from chapsym.derive.principle import ALGEBRA, R0, R0T, R1, R1T, RT, J, Lam, R, f, fT, gamma, gammaT, m, rho
from chapsym.derive.words import Traces, WordAlgebra, matrix_symbols
from chapsym.proofs.glossary import Symbols
from chapsym.prove import Equation, Point, Proof, claim, equations, main

CORRECTED = principle.kinetic_factor()
PRINTED = sp.Rational(1, 2)


equation = equations(ALGEBRA)


def _rotation(a: sp.Expr, b: sp.Expr) -> sp.Expr:
    """The rotation from an attitude to the next, in the body frame."""
    return principle.ALGEBRA.transpose(a) * b


def _in_body(a: sp.Expr, b: sp.Expr) -> sp.Expr:
    """The momentum about the centre, in the body frame."""
    return principle.ALGEBRA.transpose(a) * principle.spatial_momentum(a, b) * a


def carried_momenta() -> tuple[sp.Expr, sp.Expr]:
    """M_k, and Ω_{k-1}ᵀ M_{k-1} Ω_{k-1}."""
    return _in_body(R, R1), RT * R0 * _in_body(R0, R) * R0T * R


def step_symbols() -> Symbols:
    """The symbols of the discrete ball for every n: attitudes and centres (Section 4)."""
    return {
        "J": (principle.J, "the mass tensor, diagonal (4.1)"),
        "m": (principle.m, "the mass (4.1)"),
        r"\rho": (principle.rho, "the radius (4.2)"),
        r"m\rho^2": (principle.D, "D (4.13)"),
        "D": (principle.D, "mρ² (4.13)"),
        "R_k": (principle.R, "the attitude at the time k (4.1)"),
        "R_{k+1}": (principle.R1, "that at the time k+1"),
        "R_{k-1}": (principle.R0, "that at the time k-1"),
        "r_k": (principle.r, "the centre at the time k (4.1)"),
        "r_{k+1}": (principle.r1, "that at the time k+1"),
        "r_{k-1}": (principle.r0, "that at the time k-1"),
        r"\Delta r_k": (principle.r1 - principle.r, "r_(k+1) - r_k"),
        r"\Delta r_{k-1}": (principle.r - principle.r0, "r_k - r_(k-1)"),
        r"\vec\gamma": (principle.gamma, "the vertical unit vector in space (4.2)"),
        r"\gamma_k": (principle.RT * principle.gamma, "that in the body at the time k (4.8)"),
        r"\gamma_{k-1}": (principle.R0T * principle.gamma, "that at the time k-1"),
        r"\Gamma_k": (principle.RT * principle.gamma * principle.gammaT * principle.R, "γ_kγ_kᵀ (4.9)"),
        r"\Gamma_{k-1}": (principle.R0T * principle.gamma * principle.gammaT * principle.R0, "γ_(k-1)γ_(k-1)ᵀ"),
        r"\Lambda_k": (principle.Lam, "the symmetric multiplier of R Rᵀ = 1 (4.3)"),
        r"\bar\Omega_k": (principle.R1 * principle.RT, "R_(k+1)R_kᵀ, in space (4.9)"),
        r"\bar\Omega_{k-1}": (principle.R * principle.R0T, "R_kR_(k-1)ᵀ, in space (4.9)"),
        r"\Omega_k": (_rotation(principle.R, principle.R1), "R_kᵀR_(k+1), in the body (4.6)"),
        r"\Omega_{k-1}": (_rotation(principle.R0, principle.R), "R_(k-1)ᵀR_k, in the body"),
        "m_k": (principle.spatial_momentum(principle.R, principle.R1), "R_(k+1)JR_kᵀ - R_kJR_(k+1)ᵀ (4.6)"),
        "m_{k-1}": (principle.spatial_momentum(principle.R0, principle.R), "that a step before"),
        "M_k": (_in_body(principle.R, principle.R1), "R_kᵀm_kR_k (4.6 as corrected)"),
        "M_{k-1}": (_in_body(principle.R0, principle.R), "that a step before"),
    }


#: Rotations about the axes by the angle with cosine 3/5.
TURN_1 = sp.Matrix([[1, 0, 0], [0, "3/5", "-4/5"], [0, "4/5", "3/5"]])
TURN_2 = sp.Matrix([["3/5", 0, "4/5"], [0, 1, 0], ["-4/5", 0, "3/5"]])
TURN_3 = sp.Matrix([["3/5", "-4/5", 0], ["4/5", "3/5", 0], [0, 0, 1]])


def path_point(values: dict, *hypotheses: Equation) -> Point:
    """Explicit rational attitudes, centres and parameters, with the transposes."""
    for attitude in (R0, R, R1):
        if attitude in values and values[attitude].det() != 1:
            raise ValueError(f"{attitude} is no rotation: its determinant is {values[attitude].det()}")
    orthogonal = [equation(f"{a}·{a}ᵀ = 1", a * ALGEBRA.transposes[a], 1) for a in (R0, R, R1) if a in values]
    shown = {str(k): str(v.tolist() if isinstance(v, sp.MatrixBase) else v) for k, v in values.items()}
    return Point(shown, {**values, **ALGEBRA.with_transposes(values)}, (*orthogonal, *hypotheses))


def skew_part_of_4_3() -> sp.Expr:
    """(4.3)·R_kᵀ minus its transpose, with (4.4): a symmetric Λ exists exactly when this vanishes."""
    half = ((R1 + R0) * J - rho * principle.reaction() * gammaT * R) * RT
    return ALGEBRA.normal(half - ALGEBRA.transpose(half))


@claim(
    "4.1",
    r"\mathbb L = \frac12 \mathrm{Tr}(R_k J R_{k+1}^T) + \frac m2 \langle\Delta r_k, \Delta r_k\rangle,\ "
    r"\text{the source of (4.3) and (4.4)}",
)
def discrete_lagrangian(p: Proof) -> None:
    """The printed discrete Lagrangian does not produce the printed equations: sign and factor."""
    p.slips("serious")
    p.say("The principle: δ(𝕃(k-1,k) + 𝕃(k,k+1)) = 0 for dR = ξR_k and dr = -ρ ξ γ, every skew ξ.")
    p.say("With 𝕃 = c·Tr(R_k J R_{k+1}ᵀ) + (m/2)|Δr_k|² it says that the skew matrix S(c) vanishes:")
    p.show("S(c)", principle.momentum_balance(principle.c))
    p.say("(4.3) with (4.4) says that a symmetric Λ_k exists, that is, that this vanishes:")
    p.show("skew part of (4.3)", skew_part_of_4_3())
    printed = equation(
        "with ½: (4.3)R_kᵀ less its transpose, by (4.4), is the variation of 𝕃",
        skew_part_of_4_3(),
        principle.momentum_balance(PRINTED),
    )
    p.printed(printed)
    p.say("The translational parts agree, so c is read off the rotational part: it must be -1.")
    p.say("That is also what ½ Tr(ΔR J ΔRᵀ) = Tr J - Tr(R_k J R_{k+1}ᵀ), the kinetic energy, asks for.")
    step = R1 - R
    p.lemma(
        Equation(
            "½ Tr(ΔR J ΔRᵀ) = Tr(R_k J R_kᵀ) + c Tr(R_k J R_{k+1}ᵀ) with c = -1, both attitudes with the same Tr(R J Rᵀ)",
            step * J * ALGEBRA.transpose(step) / 2,
            (R * J * RT + R1 * J * R1T) / 2 + CORRECTED * principle.rotational_term(R, R1),
            Traces(ALGEBRA),
        )
    )
    p.corrected(
        r"\mathbb L = -\mathrm{Tr}(R_k J R_{k+1}^T) + \frac m2 \langle\Delta r_k, \Delta r_k\rangle",
        equation(
            f"with {CORRECTED}: (4.3)R_kᵀ less its transpose, by (4.4), is the variation of 𝕃",
            skew_part_of_4_3(),
            principle.momentum_balance(CORRECTED),
        ),
    )
    p.counterexample(
        path_point(
            {
                R0: sp.eye(3),
                R: sp.eye(3),
                R1: TURN_1,
                principle.r0: sp.zeros(3, 1),
                principle.r: sp.zeros(3, 1),
                principle.r1: sp.Matrix([0, "4/5", 0]),
                J: sp.diag(1, 2, 3),
                gamma: sp.Matrix([0, 0, 1]),
                m: sp.Rational(5, 2),
                rho: sp.S.One,
            },
            equation("the printed principle, S(1/2) = 0", principle.momentum_balance(PRINTED), 0),
            equation("(4.9)", principle.discrete_constraint(R, R1, principle.r, principle.r1), 0),
        )
    )
    for factor, why in [(sp.S.One, "the sign alone"), (-PRINTED, "the factor alone")]:
        mutated = principle.momentum_balance(factor)
        p.control(equation(f"c = {factor} ({why}): the principle is (4.3) with (4.4)", skew_part_of_4_3(), mutated))


@claim("4.3", r"R_{k+1} J + R_{k-1} J = \Lambda_k R_k + \rho \vec f^k \vec\gamma^T R_k", uses=["4.1"])
def rotation_equation(p: Proof) -> None:
    """The equation for R_k follows from the principle, with one multiplier f for (4.3) and (4.4)."""
    p.assume("𝕃 with the correction of (4.1); with the printed 𝕃 the equation is false (see 4.1)")
    p.say("D₁𝕃 + D₂𝕃 in R_k, less the multiplier terms: symmetric Λ for RRᵀ = 1, f for the rolling constraint.")
    in_R, _ = principle.multiplier_equations(CORRECTED)
    p.show("0", in_R)
    p.say("Λ is any symmetric matrix, so -Λ may be called Λ; the sign of the whole is free.")
    derived = -replaced("equation_R_other", "with -Λ for Λ", in_R, {Lam: -Lam}, ALGEBRA)
    p.reads(
        step_symbols(),
        (r"\vec f^k", f, "the multiplier of the rolling constraint (4.3)"),
        ("0", derived, "the equation of the principle in R_k, by the derivation"),
    )
    printed = (R1 + R0) * J - Lam * R - rho * f * gammaT * R
    p.printed(equation("(4.3) left - right = minus the equation of the principle with -Λ for Λ", printed, derived))
    p.control(equation("(4.3) with -ρ f γᵀR", (R1 + R0) * J - Lam * R + rho * f * gammaT * R, derived))
    p.control(equation("(4.3) with J on the left", J * (R1 + R0) - Lam * R - rho * f * gammaT * R, derived))


@claim("4.4", r"m (r_{k+1}-r_k) - m (r_k-r_{k-1}) = \vec f^k", uses=["4.1"])
def centre_equation(p: Proof) -> None:
    """The equation for r_k, with the same multiplier as in (4.3)."""
    p.say("The multiplier of the rolling constraint is named so that (4.4) holds; (4.3) then has it as printed.")
    _, in_r = principle.multiplier_equations(CORRECTED)
    p.show("0", in_r)
    p.reads(
        step_symbols(),
        (r"\vec f^k", f, "the multiplier of the rolling constraint (4.3)"),
        ("0", in_r, "the equation of the principle in r_k, by the derivation"),
    )
    printed = principle.reaction() - f
    p.printed(equation("(4.4) left - right = - the equation of the principle", printed, -in_r))
    p.control(equation("(4.4) with -f", principle.reaction() + f, -in_r))


@claim(
    "4.5",
    r"R_{k+1} J R_k^T + R_{k-1} J R_k^T = \Lambda_k + \rho \vec f^k \vec\gamma^T, \quad "
    r"R_k J R_{k+1}^T + R_k J R_{k-1}^T = \Lambda_k^T + \rho \vec\gamma \vec f^T_k",
    uses=["4.3"],
)
def transposed_forms(p: Proof) -> None:
    """(4.3) times R_kᵀ, and its transpose."""
    at_4_3 = (R1 + R0) * J - Lam * R - rho * f * gammaT * R
    first = R1 * J * RT + R0 * J * RT - Lam - rho * f * gammaT
    second = R * J * R1T + R * J * R0T - ALGEBRA.transpose(Lam) - rho * gamma * fT
    p.reads(
        step_symbols(),
        (r"\vec f^k", f, "the multiplier of the rolling constraint (4.3)"),
        (r"\vec f^T_k", fT, "its transpose"),
        ("0", at_4_3 * RT, "(4.3) times R_kᵀ, which vanishes"),
    )
    p.printed(
        equation("first form = (4.3)·R_kᵀ", first, at_4_3 * RT),
        equation("second form = its transpose", second, ALGEBRA.transpose(at_4_3 * RT)),
    )
    p.control(equation("second form with f γᵀ", second + rho * (gamma * fT - f * gammaT), ALGEBRA.transpose(first)))


@claim(
    "4.6",
    r"m_k = m_{k-1} + \rho(\vec f^k\vec\gamma^T - \vec\gamma \vec{f^k}^T), \quad "
    r"m(\Delta r_k - \Delta r_{k-1}) = \vec f^k, \quad m_k = R_{k+1} J R_k^T - R_k J R_{k+1}^T",
    uses=["4.3", "4.4"],
)
def spatial_balance(p: Proof) -> None:
    """The spatial momentum balance is what the principle says after the multiplier Λ is eliminated."""
    p.assume("𝕃 with the correction of (4.1)")
    p.say("The virtual displacements of the principle leave no Λ: S = 0, with f = m(Δr_k - Δr_{k-1}),")
    balance = principle.momentum_balance(CORRECTED)
    p.show("S", balance)
    now, before = principle.spatial_momentum(R, R1), principle.spatial_momentum(R0, R)
    force = ALGEBRA.wedge(principle.reaction(), gamma)
    p.reads(
        step_symbols(),
        (r"\vec f^k", principle.reaction(), "m(Δr_k - Δr_(k-1)) (4.4)"),
        (r"\vec{f^k}^T", ALGEBRA.transpose(principle.reaction()), "its transpose"),
        ("0", balance, "the principle, the multipliers eliminated, by the derivation"),
    )
    p.printed(equation("m_k - m_{k-1} - ρ(fγᵀ - γfᵀ) = S", now - before - rho * force, balance))
    first = R1 * J * RT + R0 * J * RT - Lam - rho * f * gammaT
    p.lemma(
        equation(
            "the same by (4.5): first form minus second form, Λ = Λᵀ",
            first - ALGEBRA.transpose(first),
            now - before - rho * ALGEBRA.wedge(f, gamma),
        )
    )
    p.control(equation("the balance with -ρ(fγᵀ - γfᵀ)", now - before + rho * force, balance))
    p.control(equation("the balance with m_k and m_{k-1} exchanged", before - now - rho * force, balance))


@claim(
    "4.7",
    r"M_k = \Omega_{k-1}^T M_{k-1}\Omega_{k-1} + \rho \vec F^k\wedge\gamma_k^T, \quad "
    r"m(\Delta r_k-\Delta r_{k-1}) = \vec f^k",
    uses=["4.6"],
)
def euler_poincare(p: Proof) -> None:
    """The balance in the body frame."""
    p.assume("F ∧ γᵀ stands for Fγᵀ - γFᵀ, as in (4.6)")
    p.say(
        "Ω_k = R_kᵀR_{k+1}, M_k = R_kᵀ m_k R_k = Ω_k J - JΩ_kᵀ, F = R_kᵀf, γ_k = R_kᵀγ; R_kᵀ S R_k = 0 is the balance."
    )
    now, moved = carried_momenta()
    p.lemma(equation("M_k = Ω_k J - J Ω_kᵀ", now, RT * R1 * J - J * ALGEBRA.transpose(RT * R1)))
    force = ALGEBRA.wedge(RT * principle.reaction(), RT * gamma)
    balance = RT * principle.momentum_balance(CORRECTED) * R
    p.reads(
        step_symbols(),
        (r"\vec F^k", RT * principle.reaction(), "R_kᵀf^k (4.8)"),
        (r"\vec f^k", principle.reaction(), "m(Δr_k - Δr_(k-1)) (4.4)"),
        ("0", balance, "the principle in the body, by the derivation"),
    )
    p.printed(equation("M_k - Ωᵀ M_{k-1} Ω - ρ F∧γ = R_kᵀ S R_k", now - moved - rho * force, balance))
    turned = R0T * R * _in_body(R0, R) * RT * R0
    p.control(equation("the same with Ω M_{k-1} Ωᵀ", now - turned - rho * force, balance))
    p.control(equation("the same with γ∧F", now - moved + rho * force, balance))


@claim("4.8", r"\vec F^k = R_k^T\vec f^k,\ \gamma_k = R_k^T\vec\gamma", uses=["4.7"])
def body_vectors(p: Proof) -> None:
    """The names of the reaction and the vertical in the frame of the body."""
    p.reads(step_symbols() | {r"\vec f^k": (f, "the reaction (4.3)"), r"\vec F^k": (RT * f, "R_kᵀf^k, a name")})
    p.define("F^k and γ_k are names for f^k and γ⃗ seen from the body; that (4.7) uses them so is part of its proof")
    carried = RT * ALGEBRA.wedge(f, gamma) * R
    p.lemma(equation("R_kᵀ(f∧γ⃗)R_k = F∧γ_k: the torque of (4.6), carried", carried, ALGEBRA.wedge(RT * f, RT * gamma)))
    p.control(equation("the same for γ_k = R_kγ⃗", carried, ALGEBRA.wedge(RT * f, R * gamma)))


@claim("4.2", r"\dot r + \rho\,\dot R R^T\vec\gamma = 0", uses=["2.9"])
def rolling_in_space(p: Proof) -> None:
    """The rolling condition in the fixed frame is (2.9), carried there."""
    p.assume("γ is directed downwards, as (2.9) needs (corrected there)")
    p.say("With Ṙ = Rω, ṙ = Rv and γ⃗ = Rγ: the column of (4.2) is R times that of (2.9).")
    spin, velocity, vertical = matrix_symbols("omega v gamma_k")
    algebra = WordAlgebra({**ALGEBRA.transposes, spin: -spin}, ALGEBRA.rules)
    fixed = principle.rolling_constraint(R * velocity, R * spin).subs(gamma, R * vertical)
    body = velocity + rho * spin * vertical
    p.reads(
        step_symbols(),
        (r"\dot r", R * velocity, "Rv, the velocity of the centre"),
        (r"\dot R R^T", R * spin * RT, "RωRᵀ, the angular velocity in space"),
        (r"\vec\gamma", R * vertical, "Rγ, the vertical in space"),
        ("0", R * body, "R(v + ρωγ), which vanishes (2.9)"),
    )
    p.printed(Equation("ṙ + ρṘRᵀγ⃗ = R(v + ρωγ)", fixed, R * body, algebra))
    wrong = velocity - rho * spin * vertical
    p.control(Equation("ṙ + ρṘRᵀγ⃗ = R(v - ρωγ)", fixed, R * wrong, algebra))


@claim(
    "4.6-body", r"M_k = \mathrm{Ad}_{R_k} m_k \equiv \Omega_k J - J\Omega_k^T,\ \Omega_k = R_k^T R_{k+1}", uses=["4.6"]
)
def body_momentum(p: Proof) -> None:
    """The momentum in the body: the right side is right, but it is Ad of the inverse."""
    p.slips("convention")
    p.assume("Ad_R X = R X R⁻¹, the adjoint action")
    spatial = principle.spatial_momentum(R, R1)
    body = RT * R1 * J - J * R1T * R
    p.reads(
        step_symbols(),
        (r"\mathrm{Ad}_{R_k} m_k", R * spatial * RT, "R_km_kR_kᵀ"),
        (r"\mathrm{Ad}_{R_k^{-1}} m_k", RT * spatial * R, "R_k⁻¹m_kR_k"),
        ("M_k", body, "Ω_kJ - JΩ_kᵀ, as (4.7) needs it"),
    )
    p.printed(equation("R_k m_k R_kᵀ = Ω_k J - J Ω_kᵀ", R * spatial * RT, body))
    p.corrected(
        r"M_k = \mathrm{Ad}_{R_k^{-1}} m_k = R_k^T m_k R_k",
        equation("R_kᵀ m_k R_k = Ω_k J - J Ω_kᵀ", RT * spatial * R, body),
    )
    p.counterexample(path_point({R: TURN_1, R1: TURN_3, J: sp.diag(1, 2, 3)}))
    p.control(equation("R_kᵀ m_k R_k = J Ω_k - Ω_kᵀ J", RT * spatial * R, J * RT * R1 - R1T * R * J))


@claim(
    "4.6-frame",
    r"M_k = \Omega_{k-1}^T M_{k-1}\Omega_{k-1} + \rho(R_k^T\vec f^k\gamma^T R_k - R_k^T\gamma_k\vec f^T R_k)",
    uses=["4.6", "4.6-body"],
)
def balance_in_body(p: Proof) -> None:
    """The balance carried to the body: γ_k stands where the spatial γ must."""
    p.slips("typo")
    p.assume("γ without an index is the vertical in space; γ_k = R_kᵀγ is the one in the body (4.8)")
    now, moved = carried_momenta()
    force = principle.reaction()
    balance = RT * principle.momentum_balance(CORRECTED) * R
    p.reads(
        step_symbols(),
        (r"\vec f^k", force, "m(Δr_k - Δr_(k-1)) (4.4)"),
        (r"\vec f^T", ALGEBRA.transpose(force), "its transpose"),
        (r"\gamma^T", gammaT, "that of the vertical in space"),
        ("0", balance, "the principle in the body, by the derivation"),
    )

    def carried(text: str, vertical: sp.Expr) -> Equation:
        torque = RT * force * gammaT * R - RT * vertical * ALGEBRA.transpose(force) * R
        return equation(text, now - moved - rho * torque, balance)

    p.printed(carried("with R_kᵀγ_k fᵀR_k", RT * gamma))
    p.corrected(
        r"M_k = \Omega_{k-1}^T M_{k-1}\Omega_{k-1} + \rho(R_k^T\vec f^k\vec\gamma^T R_k - R_k^T\vec\gamma\vec f^T R_k)",
        carried("with R_kᵀγ fᵀR_k", gamma),
    )
    values = {R0: TURN_1, R: TURN_1, R1: TURN_1 * TURN_1, J: sp.diag(1, 2, 3), gamma: sp.Matrix([0, 0, 1])}
    values |= {principle.r0: sp.zeros(3, 1), principle.r: sp.zeros(3, 1), principle.r1: sp.Matrix([0, -4, 0])}
    solved = equation("(4.6)", principle.momentum_balance(CORRECTED), 0)
    p.counterexample(path_point({**values, m: sp.S.One, rho: sp.S.One}, solved))
    p.control(carried("with -R_kᵀγ fᵀR_k", -gamma))


@claim("4.11", r"\gamma_k = \Omega_{k-1}^T \gamma_{k-1}")
def vertical_transport(p: Proof) -> None:
    """The vertical, fixed in space, seen from the body."""
    p.reads(step_symbols())
    p.printed(equation("R_kᵀγ = Ω_{k-1}ᵀ R_{k-1}ᵀγ", RT * gamma, RT * R0 * R0T * gamma))
    p.control(equation("R_kᵀγ = Ω_{k-1} R_{k-1}ᵀγ", RT * gamma, R0T * R * R0T * gamma))


if __name__ == "__main__":
    main(__file__)
