"""What is generated: every kernel with its inputs, its expressions and the claims that prove them."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from chapsym.derive import continuous, elliptic, gibbs, modified, steady, three, vertical
from chapsym.derive.limits import omega
from chapsym.derive.three import J1, J2, J3, D, K, gamma, q, q0

Group = tuple[str, tuple[sp.Symbol, ...]]
Steps = Sequence[tuple[Sequence[sp.Symbol], Sequence[sp.Expr]]]

QUATERNION: Group = ("rotation", (q0, *q))
GAMMA: Group = ("gamma", tuple(gamma))
MOMENTUM: Group = ("momentum", tuple(K))
OMEGA: Group = ("omega", tuple(omega))
RATE: Group = ("rate", tuple(modified.rate))
SHARE: Group = ("share", tuple(modified.share))
MASS_TENSOR: Group = ("mass_tensor", (J1, J2, J3))
CONTACT: Group = ("D", (D,))
FIRST: Group = ("first", sp.symbols("a0:4"))
SECOND: Group = ("second", sp.symbols("b0:4"))
VECTOR: Group = ("vector", sp.symbols("v1:4"))
GIBBS: Group = ("gibbs", tuple(gibbs.u))
HALF: Group = ("half_momentum", tuple(gibbs.k))
CORRECTION: Group = ("correction", tuple(gibbs.d))
NEXT: Group = ("next_correction", tuple(gibbs.e))
COFACTORS: Group = ("cofactors", tuple(gibbs.C))
ANY_QUATERNION: Group = ("quaternion", (gibbs.p0, *gibbs.p))
INERTIA: Group = ("inertia", tuple(gibbs.INERTIA.diagonal()))
ORDERED: Group = ("ordered", elliptic.LAMBDA)
SQUARE: Group = ("inverse_square", (elliptic.l,))
MOMENT: Group = ("moment", (steady.moment,))
LAMBDA: Group = ("Lambda", vertical.INERTIA)
BODY: tuple[Group, ...] = (GAMMA, MASS_TENSOR, CONTACT)


@dataclass(frozen=True)
class Kernel:
    """A function to be generated: flat inputs in groups, flat outputs, which are a vector or a matrix, row by row."""

    name: str
    summary: str
    claims: tuple[str, ...]
    groups: tuple[Group, ...]
    outputs: tuple[str, ...]
    build: Callable[[], Sequence[sp.Expr]]
    #: The same value in steps: named intermediate expressions, and the outputs by those names.
    factored: Callable[[], tuple[Steps, Sequence[sp.Expr]]] | None = None
    rows_of_three: bool = False

    @property
    def shape(self) -> tuple[int, ...]:
        """Of the result; one output is a number."""
        if self.rows_of_three:
            return len(self.outputs) // 3, 3
        return (len(self.outputs),) if len(self.outputs) > 1 else ()

    @cached_property
    def expressions(self) -> tuple[sp.Expr, ...]:
        """What is computed, derived once."""
        return tuple(sp.sympify(e) for e in self.build())

    @cached_property
    def steps(self) -> tuple[Steps, Sequence[sp.Expr]]:
        """The same value in the derivation's own steps, if it has some; derived once."""
        return self.factored() if self.factored else ([], self.expressions)

    @property
    def inputs(self) -> tuple[sp.Symbol, ...]:
        """The flat arguments."""
        return tuple(symbol for _, symbols in self.groups for symbol in symbols)


def _matrix(prefix: str) -> tuple[str, ...]:
    return tuple(f"{prefix}{row}{column}" for row in (1, 2, 3) for column in (1, 2, 3))


def _vector(prefix: str) -> tuple[str, ...]:
    return tuple(f"{prefix}{row}" for row in (1, 2, 3))


def _column(symbols: Sequence[sp.Symbol]) -> sp.Matrix:
    return sp.Matrix(list(symbols))


KERNELS: tuple[Kernel, ...] = (
    Kernel(
        "momentum",
        "The discrete momentum 𝒦(q, γ) about the contact point (5.2); homogeneous of degree 2 in (q0, q).",
        ("prop-1", "5.2", "stable-momentum"),
        (QUATERNION, *BODY),
        _vector("K"),
        three.momentum,
        three.momentum_steps,
    ),
    Kernel(
        "momentum_jacobian",
        "∂𝒦/∂q in the chart q0 = sqrt(1 - |q|²), row by row; it divides by q0.",
        ("5.2",),
        (QUATERNION, *BODY),
        _matrix("dK"),
        three.momentum_jacobian,
        rows_of_three=True,
    ),
    Kernel(
        "tangent_jacobian",
        "The derivative of 𝒦 along q ∘ (0, w), w ∈ R³, row by row; regular at every rotation.",
        ("5.2",),
        (QUATERNION, *BODY),
        _matrix("dK"),
        three.tangent_jacobian,
        rows_of_three=True,
    ),
    Kernel(
        "tangent_hessian",
        "The constant second derivative of 𝒦(q ∘ (1, w)) in w: the vectors for 11, 22, 33, 23, 13, 12.",
        ("5.2",),
        (QUATERNION, *BODY),
        tuple(f"ddK{pair}_{row}" for pair in ("11", "22", "33", "23", "13", "12") for row in (1, 2, 3)),
        three.tangent_hessian,
        rows_of_three=True,
    ),
    Kernel(
        "residual",
        "𝒦(q, γ) - 𝒦, which the rotation of the next step makes zero (5.2).",
        ("5.2", "stable-momentum"),
        (QUATERNION, MOMENTUM, *BODY),
        _vector("r"),
        lambda: sp.Matrix(three.momentum()) - K,
        three.residual_steps,
    ),
    Kernel(
        "rotation",
        "The matrix Ω of unit Euler parameters, row by row (5.1 as corrected).",
        ("5.1",),
        (QUATERNION,),
        _matrix("R"),
        three.rotation,
        rows_of_three=True,
    ),
    Kernel(
        "rotate",
        "Ωv for unit Euler parameters: from the frame of the body after the rotation to the one before.",
        ("5.1",),
        (QUATERNION, VECTOR),
        _vector("x"),
        lambda: three.rotated(_column(VECTOR[1])),
    ),
    Kernel(
        "transport",
        "Ωᵀv for unit Euler parameters: what a vector fixed in space becomes in the body (5.3).",
        ("5.3",),
        (QUATERNION, VECTOR),
        _vector("x"),
        lambda: three.transported(_column(VECTOR[1])),
    ),
    Kernel(
        "compose",
        "Hamilton's product of two quaternions, scalar first: R_{k+1} = R_k Ω_k for attitudes.",
        ("5.1",),
        (FIRST, SECOND),
        ("c0", "c1", "c2", "c3"),
        lambda: three.quaternion_product(_column(FIRST[1]), _column(SECOND[1])),
    ),
    Kernel(
        "centre_step",
        "Δr/ρ of one step in the body frame before it, γ upwards (4.9 with 2.1 as corrected).",
        ("2.1", "4.9"),
        (QUATERNION, GAMMA),
        _vector("s"),
        three.centre_step,
    ),
    Kernel(
        "invariants",
        "⟨𝒦,γ⟩ (the paper's h), ⟨𝒦,𝒦⟩ (its n) and ⟨γ,γ⟩, which every branch of the map preserves.",
        ("prop-2", "5.3"),
        (MOMENTUM, GAMMA),
        ("h", "n", "unit"),
        lambda: [K.dot(gamma), K.dot(K), gamma.dot(gamma)],
    ),
    Kernel(
        "energy",
        "The kinetic energy ½⟨K, ω⟩ of the continuous ball with the momentum K (2.5 as corrected).",
        ("2.5", "stable-inverse"),
        (MOMENTUM, *BODY),
        ("T",),
        lambda: [continuous.energy()],
    ),
    Kernel(
        "contact_momentum",
        "K = Λω - D⟨ω,γ⟩γ, the momentum of the continuous ball about the contact point.",
        ("4.13-limit", "5.2-limit", "stable-momentum"),
        (OMEGA, *BODY),
        _vector("K"),
        continuous.momentum,
        continuous.momentum_steps,
    ),
    Kernel(
        "angular_velocity",
        "ω(K, γ) of the continuous ball (the unnumbered inverse before 2.5, as corrected).",
        ("2.5-inverse", "stable-inverse"),
        (MOMENTUM, *BODY),
        _vector("w"),
        continuous.angular_velocity,
    ),
    Kernel(
        "gibbs_newton",
        "The next Newton iterate of the Gibbs vector, N/det, as a quaternion (det, N); and the cofactors of ∂G/∂u.",
        ("gibbs", "gibbs-newton"),
        (GIBBS, HALF, GAMMA, INERTIA, CONTACT),
        ("det", *_vector("N"), *_matrix("C")),
        gibbs.newton,
        gibbs.newton_steps,
    ),
    Kernel(
        "gibbs_newton_heavy",
        "What `gibbs_newton` computes, with a determinant in which nothing cancels for D ≫ I.",
        ("gibbs", "gibbs-newton", "stable-determinant"),
        (GIBBS, HALF, GAMMA, INERTIA, CONTACT),
        ("det", *_vector("N"), *_matrix("C")),
        gibbs.newton,
        gibbs.newton_heavy_steps,
    ),
    Kernel(
        "gibbs_second",
        "What N loses by a second correction after a Newton correction d, with the same cofactors.",
        ("gibbs-newton",),
        (CORRECTION, HALF, COFACTORS, INERTIA),
        _vector("e"),
        gibbs.second,
        gibbs.second_steps,
    ),
    Kernel(
        "gibbs_mixed",
        "What N loses when a correction e follows a correction d with the cofactors from before d.",
        ("gibbs-newton",),
        (CORRECTION, NEXT, HALF, COFACTORS, INERTIA),
        _vector("x"),
        gibbs.mixed,
        gibbs.mixed_steps,
    ),
    Kernel(
        "gibbs_symmetric",
        "The trace, the sum of the principal minors of size 2 and the determinant of the symmetric part of ∂G/∂u.",
        ("gibbs", "straight-path"),
        (GIBBS, HALF, GAMMA, INERTIA, CONTACT),
        ("trace", "minors", "det"),
        gibbs.symmetric,
        gibbs.symmetric_steps,
    ),
    Kernel(
        "gibbs_residual",
        "G(u) = B(γ)u + u × Iu - (1 + |u|²)k, which the Gibbs vector of the next step makes zero.",
        ("gibbs",),
        (GIBBS, HALF, GAMMA, INERTIA, CONTACT),
        _vector("r"),
        gibbs.residual,
        gibbs.residual_steps,
    ),
    Kernel(
        "turn",
        "Ωᵀv - v for the rotation of a quaternion that need not be unit (5.3).",
        ("gibbs-rotation",),
        (ANY_QUATERNION, VECTOR),
        _vector("x"),
        gibbs.turn,
        gibbs.turn_steps,
    ),
    Kernel(
        "vertical_square",
        "⟨γ, adj(Λ)γ⟩ = det(Λ)⟨γ, Λ⁻¹γ⟩, the integral of the reduced map G_h without its denominators.",
        ("prop-3",),
        (GAMMA, LAMBDA),
        ("level",),
        lambda: [vertical.weighted_square()],
    ),
    Kernel(
        "vertical_level",
        "The scalar equation of the level, zero for the step 𝒦 = hγ, and its derivative in v.",
        ("vertical-level",),
        (("scalars", (vertical.t, vertical.v)), ("level", (vertical.level,)), LAMBDA),
        ("f", "fv"),
        vertical.level_newton,
        vertical.level_steps,
    ),
    Kernel(
        "vertical_rotation",
        "The rotation of the step 𝒦 = hγ up to a factor, (q0, q) ∝ (det M, t adj(M)γ), M = Λ - e - t γ×.",
        ("vertical-rotation",),
        (("sigma", (vertical.t, vertical.e)), GAMMA, LAMBDA),
        ("p0", "p1", "p2", "p3"),
        vertical.closed_rotation,
    ),
    Kernel(
        "isotropic_spin",
        "w = B(γ/|γ|)⁻¹k for three equal moments: 2w is sin θ times the axis of the steady rotation.",
        ("isotropic-spin", "steady", "steady-branch", "steady-axis", "steady-roll"),
        (HALF, GAMMA, MOMENT, CONTACT),
        _vector("w"),
        steady.spin,
        steady.spin_steps,
    ),
    Kernel(
        "curve_increment",
        "k², G = G0 + G1 sn² + G2 sn⁴ and μ of a curve: hG𝒟 = 2Vw(𝒟 - D(l - μ sn²)), V² = G0, at the half increment.",
        ("5.8", "5.8-modulus", "5.14-G", "5.15"),
        (ORDERED, SQUARE),
        ("k2", "G0", "G1", "G2", "mu"),
        elliptic.increment_parts,
    ),
    Kernel(
        "precession_parts",
        "|b|² = P0 + P1 sn² and ⟨b,Λ⁻¹b⟩ = N0 + N1 sn² on a curve, b = γ × Λ⁻¹γ: Rb turns about γ by their quotient.",
        ("5.8", "5.8-modulus", "top-precession"),
        (ORDERED, SQUARE),
        ("P0", "P1", "N0", "N1"),
        elliptic.precession_parts,
    ),
    Kernel(
        "torque",
        "B(γ)ω' = Iω × ω, ω' the rate of ω of the continuous ball.",
        ("modified-field",),
        (OMEGA, MASS_TENSOR),
        _vector("x"),
        modified.torque,
    ),
    Kernel(
        "modified_load",
        "The load of the modified equations: 12ω₃ = 2|ω|²ω - ω × ω' - B(γ)⁻¹load, ω' the rate.",
        ("modified-field",),
        (OMEGA, RATE, *BODY),
        _vector("x"),
        modified.load,
    ),
    Kernel(
        "modified_rotation",
        "12ω₃: the step of size ε is that of the continuous ball with ω + ε²ω₃, up to ε⁴; share = B(γ)⁻¹load.",
        ("modified-field",),
        (OMEGA, RATE, SHARE),
        _vector("x"),
        modified.correction,
    ),
    Kernel(
        "energy_rate",
        "4X₃(H) = D⟨γ,ω'⟩⟨γ × ω,ω'⟩: in a step of size ε the energy changes by ε³X₃(H), up to ε⁴.",
        ("modified-energy",),
        (OMEGA, RATE, GAMMA, CONTACT),
        ("rate",),
        lambda: [4 * modified.energy_rate()],
    ),
)
