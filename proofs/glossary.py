r"""What the symbols of the paper's formulas stand for: with it the checker reads what is printed.

Each table gives symbols their values, in the letters of the statements, and their meanings, with their place in the
paper.  A claim reads with a table and with what it defines itself.
"""

from typing import Any

import sympy as sp

from chapsym.derive import ball, continuous, elliptic, motion, three, vertical
from chapsym.derive import principle as space
from chapsym.derive.elliptic import HALF, L1, L2, L3, MEAN, Jacobi, U, k2
from chapsym.derive.limits import omega

Symbols = dict[str, tuple[Any, str]]

#: n = 3 (Sections 2 and 5): the ball and its state.
BALL: Symbols = {
    r"\Lambda": (three.lam(), "diag(J2 + J3 + D, J1 + J3 + D, J1 + J2 + D), J the mass tensor (2.2, 5.2)"),
    "D": (three.D, "mρ² (2.2)"),
    r"\gamma": (three.gamma, "the vertical unit vector in the body (2.1)"),
    r"\omega": (omega, "the angular velocity in the body (2.1)"),
    r"\mathbf q": (three.q, "the vector part of the Euler parameters (5.1)"),
    "q_0": (three.q0, "their scalar part (5.1)"),
}

#: The tensor of inertia and F of Section 2.
CLASSICAL: Symbols = BALL | {
    "J": (three.lam() - three.D * sp.eye(3), "the tensor of inertia, Λ - D, in Section 2 (2.1)"),
    "F": (continuous.rolling_factor(), "⟨Jγ, Λ⁻¹γ⟩ (2.2)"),
}

#: Vertical momentum (Section 5): γ and γ~ in q and σ.
VERTICAL: Symbols = {
    **{name: BALL[name] for name in (r"\Lambda", "D", r"\mathbf q", "q_0")},
    r"\sigma": (vertical.sigma, "h + 2D⟨γ, q₀q⟩ (5.6 as corrected)"),
    r"\gamma": (sp.Matrix(vertical.gamma_now()), "(2/σ)(q₀Λq + q×Λq), the vertical in the body (5.6)"),
    r"\tilde\gamma": (sp.Matrix(vertical.gamma_next()), "(2/σ)(q₀Λq - q×Λq), the next vertical (5.6)"),
    "h": (vertical.height(), "of 𝒦 = hγ: here σ - 2D⟨γ, q₀q⟩ (5.4)"),
}


def functions(values: Jacobi, argument: str) -> Symbols:
    """Jacobi's functions of an argument, and their powers as they are printed."""
    found: Symbols = {}
    for name, value in values._asdict().items():
        for power in (1, 2, 4):
            exponent = "" if power == 1 else f"^{power}"
            found[rf"\mathrm{{{name}}}{exponent}{argument}"] = value**power, f"{name}{exponent} of the argument (5.7)"
    return found


#: The curve (Section 5): Λ, its modulus and level, and Jacobi's functions of u, ū and δu.
CURVE: Symbols = {
    r"\Lambda_1": (L1, "the first entry of Λ (5.2)"),
    r"\Lambda_2": (L2, "the second entry of Λ (5.2)"),
    r"\Lambda_3": (L3, "the third entry of Λ (5.2)"),
    "k^2": (k2, "the square of the modulus (5.8)"),
    **functions(HALF, r"\delta u"),
    **functions(MEAN, r"\bar u"),
    **functions(U, "u"),
    r"w(\delta u)": (HALF.sn * HALF.cn * HALF.dn, "sn cn dn of δu (5.15)"),
    "W(u)": (U.sn * U.cn * U.dn, "sn cn dn of u (5.16)"),
    r"\mathcal D": (elliptic.denominator(), "1 - k² sn²ū sn²δu (5.13)"),
}

#: The same with the level l as what k² and Λ make of it.
LEVEL: Symbols = CURVE | {
    "l": (elliptic.level(), "the level ⟨γ, Λ⁻¹γ⟩, by k² and Λ (5.8)"),
    **{f"C_{i + 1}^2": (c.subs(elliptic.l, elliptic.level()), f"the square of C_{i + 1} (5.8 as corrected)")
       for i, c in enumerate(elliptic.squared_amplitudes())},
}  # fmt: skip

#: The continuous ball, for every n (Section 2).
MOTION: Symbols = {
    "J": (motion.J, "the mass tensor, symmetric (2.10)"),
    "D": (motion.D, "mρ² (2.11)"),
    "m": (motion.m, "the mass (2.11)"),
    r"\rho": (motion.rho, "the radius (2.9)"),
    r"\omega": (motion.omega, "the angular velocity in the body, skew (2.8)"),
    r"\dot\omega": (motion.alpha, "its rate"),
    r"\gamma": (motion.gamma, "the unit vector from the centre to the plane (2.9 as corrected)"),
    r"\dot\gamma": (motion.rate(motion.gamma), "its rate, as it is fixed in space"),
    r"\Gamma": (motion.Gamma, "γγᵀ (2.12)"),
    r"\dot\Gamma": (motion.rate(motion.Gamma), "its rate, as γ is fixed in space"),
    "v_C": (motion.v, "the velocity of the centre, in the body (2.8)"),
    r"\dot v_C": (motion.a, "its rate"),
    "M": (motion.J * motion.omega + motion.omega * motion.J, "Jω + ωJ (2.10)"),
    r"\dot M": (motion.rate(motion.J * motion.omega + motion.omega * motion.J), "its rate"),
}


def _rotation(a: Any, b: Any) -> Any:
    """The rotation from an attitude to the next, in the body."""
    return space.ALGEBRA.transpose(a) * b


def _in_body(a: Any, b: Any) -> Any:
    """The momentum about the centre, in the body."""
    return space.ALGEBRA.transpose(a) * space.spatial_momentum(a, b) * a


#: The discrete ball, for every n, in its attitudes and centres (Section 4).
STEPS: Symbols = {
    "J": (space.J, "the mass tensor, diagonal (4.1)"),
    "m": (space.m, "the mass (4.1)"),
    r"\rho": (space.rho, "the radius (4.2)"),
    r"m\rho^2": (space.D, "D (4.13)"),
    "D": (space.D, "mρ² (4.13)"),
    "R_k": (space.R, "the attitude at the time k (4.1)"),
    "R_{k+1}": (space.R1, "that at the time k+1"),
    "R_{k-1}": (space.R0, "that at the time k-1"),
    "r_k": (space.r, "the centre at the time k (4.1)"),
    "r_{k+1}": (space.r1, "that at the time k+1"),
    "r_{k-1}": (space.r0, "that at the time k-1"),
    r"\Delta r_k": (space.r1 - space.r, "r_(k+1) - r_k"),
    r"\Delta r_{k-1}": (space.r - space.r0, "r_k - r_(k-1)"),
    r"\vec\gamma": (space.gamma, "the vertical unit vector in space (4.2)"),
    r"\gamma_k": (space.RT * space.gamma, "that in the body at the time k (4.8)"),
    r"\gamma_{k-1}": (space.R0T * space.gamma, "that at the time k-1"),
    r"\Gamma_k": (space.RT * space.gamma * space.gammaT * space.R, "γ_kγ_kᵀ (4.9)"),
    r"\Gamma_{k-1}": (space.R0T * space.gamma * space.gammaT * space.R0, "γ_(k-1)γ_(k-1)ᵀ"),
    r"\Lambda_k": (space.Lam, "the symmetric multiplier of R Rᵀ = 1 (4.3)"),
    r"\bar\Omega_k": (space.R1 * space.RT, "R_(k+1)R_kᵀ, in space (4.9)"),
    r"\bar\Omega_{k-1}": (space.R * space.R0T, "R_kR_(k-1)ᵀ, in space (4.9)"),
    r"\Omega_k": (_rotation(space.R, space.R1), "R_kᵀR_(k+1), in the body (4.6)"),
    r"\Omega_{k-1}": (_rotation(space.R0, space.R), "R_(k-1)ᵀR_k, in the body"),
    "m_k": (space.spatial_momentum(space.R, space.R1), "R_(k+1)JR_kᵀ - R_kJR_(k+1)ᵀ (4.6)"),
    "m_{k-1}": (space.spatial_momentum(space.R0, space.R), "that a step before"),
    "M_k": (_in_body(space.R, space.R1), "R_kᵀm_kR_k (4.6 as corrected)"),
    "M_{k-1}": (_in_body(space.R0, space.R), "that a step before"),
}

#: One step of it, in its rotation and its vertical (Remark 3).
STEP: Symbols = {
    "J": (ball.J, "the mass tensor, diagonal (4.1)"),
    "D": (ball.D, "mρ² (4.13)"),
    r"\Omega_{k-1}": (ball.Omega, "the rotation of the step, in the body (4.6)"),
    r"\Gamma_{k-1}": (ball.Gamma, "γγᵀ before the step (4.9)"),
    r"\Gamma_k": (ball.carried(ball.Gamma), "ΩᵀΓΩ: γγᵀ after the step (4.11)"),
}
