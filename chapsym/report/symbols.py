"""The table of symbols: the paper uses many letters for several things.

This is the only place where it is written.  docs/symbols.md is what `markdown` gives; a test compares them.
"""

from typing import NamedTuple


class Symbol(NamedTuple):
    """One meaning of one symbol of the paper."""

    paper: str
    where: str
    chapsym: str
    meaning: str
    unit: str


TITLE = "One table for the symbols"
INTRODUCTION = (
    "The paper uses some letters for several things, and Section 2 and Section 5 give J two meanings. Here is "
    "every meaning of each, and what it is called in chapsym. A number in parentheses is an equation of the paper."
)
DIRECTION = (
    "The direction of γ: with γ upwards, from the plane to the centre, rolling means v = ρ ω×γ. The paper's "
    "(2.1), (2.9), (4.2) and (4.9) have the other sign, which is right for γ downwards. Only the trace of the "
    "contact point sees the difference; chapsym's γ points up, and its balls roll where balls roll "
    "(`chapsym prove 2.1 --explain`)."
)
HEADER = Symbol("paper", "where", "chapsym", "meaning", "unit")

SYMBOLS = tuple(
    Symbol(*row)
    for row in (
        ("J", "(2.10), Sections 4, 5", "`mass_tensor`", "∫ xᵢ² dm about the centre, diagonal (J1, J2, J3)", "kg m²"),
        ("J", "Section 2, n = 3", "`inertia` (I)", "the inertia tensor, I1 = J2 + J3, ...", "kg m²"),
        ("Ĵ", "(5.4), (5.6)", "", "J + D/2, with the mass tensor J", "kg m²"),
        ("I, 𝐈, 𝕀", "everywhere", "", "the identity; in chapsym I is the inertia tensor", ""),
        ("D", "everywhere", "`D`", "m ρ²", "kg m²"),
        ("D1, D2", "Section 3", "", "derivatives in the first and in the second argument", ""),
        ("𝒟, 𝒟_d", "Section 3", "", "the constraint distribution; the discrete constraint manifold", ""),
        ("𝒟", "(5.13) on", "", "1 - k² sn²ū sn²δu, not D", ""),
        ("d", "(5.14), (5.15)", "", "undefined in the paper; it can only be D, at h = 1", "kg m²"),
        ("Λ", "Sections 2, 5", "", "I + D = diag(J2 + J3 + D, ...), with the mass tensor J", "kg m²"),
        ("Λ1, Λ2, Λ3", "(5.7) on", "", "the diagonal of Λ", "kg m²"),
        ("Λ_k", "Section 4", "", "the symmetric multiplier of R Rᵀ = 1", "kg m²"),
        ("λ_j", "Section 3", "", "the multipliers of the constraints", ""),
        ("ρ", "everywhere", "`radius`", "the radius", "m"),
        ("ε", "limits", "`time_step`", "the length of a step", "s"),
        ("ε_ijk", "after (2.15)", "", "the sign of the permutation", ""),
        ("K", "Section 2, n = 3", "`angular_momentum()`", "continuous momentum about the contact point", "kg m²/s"),
        ("𝐊", "(2.12), (2.13)", "", "the same as a skew matrix, for every n; so*(m) there is so*(n)", "kg m²/s"),
        ("𝒦", "(4.12) on", "`momentum`", "discrete momentum about the contact point; 𝒦 → ε K", "kg m²"),
        ("M", "(2.10)", "", "continuous momentum about the centre, in the body", "kg m²/s"),
        ("M_k", "Sections 4, 5", "", "discrete momentum about the centre, in the body", "kg m²"),
        ("m_k", "before (4.6)", "", "discrete momentum about the centre, in space", "kg m²"),
        ("m", "everywhere", "`mass`", "the mass", "kg"),
        ("γ, γ_k", "everywhere", "`gamma`", "the vertical in the body, unit; in chapsym **upwards**, see below", ""),
        ("γ⃗, γ̄", "Section 4", "", "the vertical in space, (0, ..., 0, 1); both marks mean the same", ""),
        ("γ̃", "after (5.9)", "", "the next γ, γ_(k+1)", ""),
        ("Γ, Γ_k", "Sections 2, 4", "", "γγᵀ; it does not see the direction of γ", ""),
        (
            "ω",
            "everywhere",
            "`omega`",
            "angular velocity in the body: a vector, and a skew matrix for every n",
            "rad/s",
        ),
        (
            "ω_ij",
            "after (2.15)",
            "",
            "ε_ijk ω_k there; the opposite sign, ω1 = ω_32, in Section 5 and in chapsym",
            "rad/s",
        ),
        ("Ω, Ω_k", "Sections 4, 5", "`rotation`", "the rotation of one step in the body, R_kᵀR_(k+1)", ""),
        ("Ω̄_k", "Section 4", "", "the rotation of one step in space, R_(k+1)R_kᵀ", ""),
        ("q0, q", "Section 5", "`rotation`", "Euler parameters (q0, q1, q2, q3), q0 ≥ 0", ""),
        ("q, q_k, q^i", "Section 3", "", "coordinates of the configuration", ""),
        ("q", "after (5.16)", "", "Weierstrass' ℘′(δu)", ""),
        ("p", "after (5.16)", "", "Weierstrass' ℘(δu)", ""),
        ("e1, e2, e3", "after (5.16)", "", "the roots of Weierstrass' cubic, e1 - e3 = 1", ""),
        ("θ", "Section 5", "", "the angle of the rotation of one step, q0 = cos(θ/2)", "rad"),
        ("R", "everywhere", "`attitude`", "body to space; in chapsym a unit quaternion, scalar first", ""),
        (
            "r, r_k",
            "Sections 2, 4",
            "`contact`",
            "the centre in space; in chapsym its trace on the plane, from (0, 0)",
            "m",
        ),
        ("v, v_C", "Section 2", "", "the velocity of the centre, in the body", "m/s"),
        ("V", "(5.14) on", "", "the constant with V² = (Λ2 - Λ3)(Λ1 l - 1)/(Λ1Λ2Λ3)", "1/(kg m²)"),
        ("F", "(2.2) to (2.5)", "", "1 - D⟨γ, Λ⁻¹γ⟩", ""),
        ("F", "(2.11)", "", "the reaction at the contact point, in the body", "N"),
        (
            "F^k, f^k",
            "Section 4",
            "",
            "the discrete reaction in the body and in space; the multiplier of rolling",
            "kg m",
        ),
        ("ℱ_j", "Section 3", "", "the discrete constraint functions", ""),
        ("f", "after (5.9)", "", "the change of parameter u = f(s, l)", ""),
        ("h", "(2.4)", "", "⟨K, γ⟩", "kg m²/s"),
        ("h", "Section 5", "", "⟨𝒦, γ⟩; set to 1 after Proposition 4", "kg m²"),
        ("H", "Section 2", "", "the plane; in (2.15) the energy", ""),
        ("n", "(2.4), (5.3)", "", "⟨K, K⟩ and ⟨𝒦, 𝒦⟩", ""),
        ("n", "everywhere else", "", "the dimension: of the ball, in Section 3 of the configurations", ""),
        ("l", "(2.4)", "", "⟨K, ω⟩, twice the kinetic energy", "kg m²/s²"),
        ("l", "after (2.7)", "", "printed for ⟨ω, Λω⟩, which is (h² + Dl) l/h² with the l of (2.4)", "kg m²/s²"),
        ("l", "(2.14)", "", "the power of Γ", ""),
        ("l", "(5.5) on", "", "⟨γ, Λ⁻¹γ⟩", "1/(kg m²)"),
        ("k", "Sections 3 to 5", "", "the time index", ""),
        ("k", "Section 3", "", "the dimension of the constraint distribution", ""),
        ("k", "after (2.7)", "", "|Λω|", "kg m²/s"),
        ("k", "(5.7) on", "", "the modulus of the elliptic functions", ""),
        ("s", "(2.14)", "", "the power of K", ""),
        ("s", "Section 3", "", "the number of constraints", ""),
        ("s", "after (5.9)", "", "the parameter in which the increment would be constant; in proofs s is γ + γ̃", ""),
        ("u, ū, δu", "(5.7) on", "", "the argument on the curve, (u + ũ)/2 and (ũ - u)/2", ""),
        ("Δu", "(5.9)", "", "the increment ũ - u, which is 2δu", ""),
        ("w", "after (5.5)", "", "a coordinate on the planar curve ℰ0, with z", ""),
        ("w(δu)", "(5.15), (5.16)", "", "sn δu cn δu dn δu", ""),
        ("W(u)", "(5.16)", "", "sn u cn u dn u; in proofs W is V cn δu dn δu/sn δu", ""),
        ("μ", "after (2.15)", "", "the density √det 𝒜 of the invariant measure", ""),
        ("μ(u)", "after (5.9)", "", "the density of an invariant measure of the increment", ""),
        ("μ", "(5.14), (5.15)", "", "(1 - Λ3 l)/(Λ2 - Λ3)", "1/(kg m²)"),
        ("σ, σ_k", "(5.6) on", "", "the factor with 2(q0Λq + q×Λq) = σγ: h + 2Dq0⟨γ, q⟩", "kg m²"),
        ("ϰ", "(5.10)", "", "the factor of the symmetric form, σ/q0²", "kg m²"),
        ("C", "Section 2", "", "the centre of the ball", ""),
        ("C1, C2, C3", "(5.7), (5.8)", "", "the amplitudes of γ in Jacobi's functions", ""),
        ("𝒞", "Section 4", "`trajectory`", "the map (Ω_(k-1), γ_(k-1)) ↦ (Ω_k, γ_k)", ""),
        ("𝒢_h", "(5.4) on", "", "the map of the vertical, γ_(k-1) ↦ γ_k, at 𝒦 = hγ", ""),
        ("G", "(5.14), (5.15)", "", "a polynomial in sn²δu", "1/(kg m²)²"),
        ("ℰ, ℰ0", "Section 5", "", "the spatial and the planar elliptic curve; E(n) is the Euclidean group", ""),
        ("P", "Section 2", "", "the contact point; P^(j) in Section 5 is a point of the curve", ""),
        ("L, 𝕃", "Sections 3, 4", "", "the Lagrangian, the discrete one; L_d in Remark 2 is 𝕃", ""),
    )
)


def markdown() -> str:
    """The table as docs/symbols.md has it."""
    rule = "|".join(["", *("---" for _ in HEADER), ""])
    rows = [_line(HEADER), rule, *map(_line, SYMBOLS)]
    return "\n".join([f"# {TITLE}", "", INTRODUCTION, "", *rows, "", DIRECTION, ""])


def _line(symbol: Symbol) -> str:
    fields = [field.replace("|", "\\|") for field in symbol]
    return " ".join(["|", *(f"{field} |" if field else "|" for field in fields)])
