"""The kernels of the ball: inputs, expressions, and the decided statements that carry each kernel."""

import sympy as sp

from chapsym.codegen import Group, Kernel, left, right
from chapsym.derive import continuous, elliptic, gibbs, modified, steady, three, vertical
from chapsym.derive.limits import omega
from chapsym.derive.three import J1, J2, J3, D, K, gamma, q, q0

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


def _matrix(prefix: str) -> tuple[str, ...]:
    return tuple(f"{prefix}{row}{column}" for row in (1, 2, 3) for column in (1, 2, 3))


def _vector(prefix: str) -> tuple[str, ...]:
    return tuple(f"{prefix}{row}" for row in (1, 2, 3))


#: The moments of inertia in terms of the mass tensor.
BY_MASS = {gibbs.I1: J2 + J3, gibbs.I2: J1 + J3, gibbs.I3: J1 + J2}
#: The directions of unit changes of the vector part, in the chart of q; and those of rotations of the body.
CHART = tuple({x: 1, q0: -x / q0} for x in q)
TURNS = tuple(three.placed(((q0, *q), direction)) for direction in three.body_directions())
COLLECTED = "the collected form, which the kernels use"
NEWTON = "det ∂G, adj(∂G) times the right side, and the cofactors, by vector products of the columns"
LEVEL = "that factor, with a letter for det(Λ)l"

KERNELS: tuple[Kernel, ...] = (
    Kernel(
        "momentum",
        "The discrete momentum 𝒦(q, γ) about the contact point (5.2); homogeneous of degree 2 in (q0, q).",
        (left("5.2", COLLECTED),),
        (QUATERNION, *BODY),
        _vector("K"),
        three.momentum,
        three.momentum_steps,
    ),
    Kernel(
        "momentum_jacobian",
        "∂𝒦/∂q in the chart q0 = sqrt(1 - |q|²), row by row; it divides by q0.",
        (left("5.2", COLLECTED).along(*CHART),),
        (QUATERNION, *BODY),
        _matrix("dK"),
        three.momentum_jacobian,
        rows_of_three=True,
    ),
    Kernel(
        "tangent_jacobian",
        "The derivative of 𝒦 along q ∘ (0, w), w ∈ R³, row by row; regular at every rotation.",
        (left("5.2", COLLECTED).along(*TURNS),),
        (QUATERNION, *BODY),
        _matrix("dK"),
        three.tangent_jacobian,
        rows_of_three=True,
    ),
    Kernel(
        "tangent_hessian",
        "The constant second derivative of 𝒦(q ∘ (1, w)) in w: the vectors for 11, 22, 33, 23, 13, 12.",
        (left("5.2", "the second derivatives of 𝒦⃗(q(1, w)) in w, by 𝒦⃗ at q(0, w)"),),
        (QUATERNION, *BODY),
        tuple(f"ddK{pair}_{row}" for pair in ("11", "22", "33", "23", "13", "12") for row in (1, 2, 3)),
        three.tangent_hessian,
        rows_of_three=True,
    ),
    Kernel(
        "residual",
        "𝒦(q, γ) - 𝒦, which the rotation of the next step makes zero (5.2).",
        (left("stable-momentum", "those of `residual` 𝒦(q, γ) - 𝒦").at(BY_MASS),),
        (QUATERNION, MOMENTUM, *BODY),
        _vector("r"),
        lambda: sp.Matrix(three.momentum()) - K,
        three.residual_steps,
    ),
    Kernel(
        "rotation",
        "The matrix Ω of unit Euler parameters, row by row (5.1 as corrected).",
        (right("5.1", "Ωx = x + (Ω - (q₀² + |q|²))x").along(*({x: 1} for x in VECTOR[1])),),
        (QUATERNION,),
        _matrix("R"),
        three.rotation,
        rows_of_three=True,
    ),
    Kernel(
        "rotate",
        "Ωv for unit Euler parameters: from the frame of the body after the rotation to the one before.",
        (left("5.1", "Ωx = x + (Ω - (q₀² + |q|²))x"),),
        (QUATERNION, VECTOR),
        _vector("x"),
        lambda: three.rotated(sp.Matrix(VECTOR[1])),
    ),
    Kernel(
        "transport",
        "Ωᵀv for unit Euler parameters: what a vector fixed in space becomes in the body (5.3).",
        (left("5.3", "Ωᵀx = x + (Ω - (q₀² + |q|²))ᵀx, here of 𝒦⃗").at(three.placed((K, VECTOR[1]))),),
        (QUATERNION, VECTOR),
        _vector("x"),
        lambda: three.transported(sp.Matrix(VECTOR[1])),
    ),
    Kernel(
        "compose",
        "Hamilton's product of two quaternions, scalar first: R_{k+1} = R_k Ω_k for attitudes.",
        (left("5.1", "⟨ab, p⟩ = ⟨a, p b̄⟩").along(*({x: 1} for x in sp.symbols("p0:4"))),),
        (FIRST, SECOND),
        ("c0", "c1", "c2", "c3"),
        lambda: three.quaternion_product(sp.Matrix(FIRST[1]), sp.Matrix(SECOND[1])),
    ),
    Kernel(
        "centre_step",
        "Δr/ρ of one step in the body frame before it, γ upwards (4.9 with 2.1 as corrected).",
        (left("4.9", "½(Ω - Ωᵀ)γ = 2q₀ q × γ in Euler parameters"),),
        (QUATERNION, GAMMA),
        _vector("s"),
        three.centre_step,
    ),
    Kernel(
        "invariants",
        "⟨𝒦,γ⟩ (the paper's h), ⟨𝒦,𝒦⟩ (its n) and ⟨γ,γ⟩, which every branch of the map preserves.",
        (
            right("5.3-integrals", "⟨Ωᵀ𝒦, Ωᵀγ⟩ = ⟨𝒦, γ⟩"),
            right("5.3-integrals", "⟨Ωᵀ𝒦, Ωᵀ𝒦⟩ = ⟨𝒦, 𝒦⟩"),
            right("5.3-integrals", "|Ωᵀγ| = |γ|"),
        ),
        (MOMENTUM, GAMMA),
        ("h", "n", "unit"),
        lambda: [K.dot(gamma), K.dot(K), gamma.dot(gamma)],
    ),
    Kernel(
        "energy",
        "The kinetic energy ½⟨K, ω⟩ of the continuous ball with the momentum K (2.5 as corrected).",
        (left("stable-inverse", "its energy").at(BY_MASS),),
        (MOMENTUM, *BODY),
        ("T",),
        lambda: [continuous.energy()],
    ),
    Kernel(
        "contact_momentum",
        "K = Λω - D⟨ω,γ⟩γ, the momentum of the continuous ball about the contact point.",
        (left("5.2-limit", "𝒦⃗/ε → Λω - D⟨γ,ω⟩γ"),),
        (OMEGA, *BODY),
        _vector("K"),
        continuous.momentum,
        continuous.momentum_steps,
    ),
    Kernel(
        "angular_velocity",
        "ω(K, γ) of the continuous ball (the unnumbered inverse before 2.5, as corrected).",
        (left("stable-inverse", "ω of the kernel").at(BY_MASS),),
        (MOMENTUM, *BODY),
        _vector("w"),
        continuous.angular_velocity,
    ),
    Kernel(
        "gibbs_newton",
        "The next Newton iterate of the Gibbs vector, N/det, as a quaternion (det, N); and the cofactors of ∂G/∂u.",
        (left("gibbs-newton", NEWTON),),
        (GIBBS, HALF, GAMMA, INERTIA, CONTACT),
        ("det", *_vector("N"), *_matrix("C")),
        gibbs.newton,
        gibbs.newton_steps,
    ),
    Kernel(
        "gibbs_newton_heavy",
        "What `gibbs_newton` computes, with a determinant in which nothing cancels for D ≫ I.",
        (left("gibbs-newton", NEWTON),),
        (GIBBS, HALF, GAMMA, INERTIA, CONTACT),
        ("det", *_vector("N"), *_matrix("C")),
        gibbs.newton,
        gibbs.newton_heavy_steps,
    ),
    Kernel(
        "gibbs_second",
        "What N loses by a second correction after a Newton correction d, with the same cofactors.",
        (left("gibbs-newton", "Cᵀ(d × Id - |d|²k) = Cᵀ(G(u + d) - G(u) - ∂G(u)d)"),),
        (CORRECTION, HALF, COFACTORS, INERTIA),
        _vector("e"),
        gibbs.second,
        gibbs.second_steps,
    ),
    Kernel(
        "gibbs_mixed",
        "What N loses when a correction e follows a correction d with the cofactors from before d.",
        (left("gibbs-newton", "what is bilinear in d and e of that, for d + e"),),
        (CORRECTION, NEXT, HALF, COFACTORS, INERTIA),
        _vector("x"),
        gibbs.mixed,
        gibbs.mixed_steps,
    ),
    Kernel(
        "gibbs_symmetric",
        "The trace, the sum of the principal minors of size 2 and the determinant of the symmetric part of ∂G/∂u.",
        (left("straight-path", "tr S, the minors by the length of S, det S by its columns"),),
        (GIBBS, HALF, GAMMA, INERTIA, CONTACT),
        ("trace", "minors", "det"),
        gibbs.symmetric,
        gibbs.symmetric_steps,
    ),
    Kernel(
        "gibbs_residual",
        "G(u) = B(γ)u + u × Iu - (1 + |u|²)k, which the Gibbs vector of the next step makes zero.",
        (left("gibbs", "G(u) = B(γ)u + u × Iu - (1 + |u|²)k"),),
        (GIBBS, HALF, GAMMA, INERTIA, CONTACT),
        _vector("r"),
        gibbs.residual,
        gibbs.residual_steps,
    ),
    Kernel(
        "turn",
        "Ωᵀv - v for the rotation of a quaternion that need not be unit (5.3).",
        (left("gibbs-rotation", "the steps of the kernel compute Ωᵀv - v"),),
        (ANY_QUATERNION, VECTOR),
        _vector("x"),
        gibbs.turn,
        gibbs.turn_steps,
    ),
    Kernel(
        "vertical_square",
        "⟨γ, adj(Λ)γ⟩ = det(Λ)⟨γ, Λ⁻¹γ⟩, the integral of the reduced map G_h without its denominators.",
        (left("prop-3", "⟨γ, adj(Λ)γ⟩ = det(Λ)⟨γ, Λ⁻¹γ⟩"),),
        (GAMMA, LAMBDA),
        ("level",),
        lambda: [vertical.weighted_square()],
    ),
    Kernel(
        "vertical_level",
        "The scalar equation of the level, zero for the step 𝒦 = hγ, and its derivative in v.",
        (left("vertical-level", LEVEL), left("vertical-level", LEVEL).along({vertical.v: 1})),
        (("scalars", (vertical.t, vertical.v)), ("level", (vertical.level,)), LAMBDA),
        ("f", "fv"),
        vertical.level_newton,
        vertical.level_steps,
    ),
    Kernel(
        "vertical_rotation",
        "The rotation of the step 𝒦 = hγ up to a factor, (q0, q) ∝ (det M, t adj(M)γ), M = Λ - e - t γ×.",
        (left("vertical-rotation", "(det M, t adj(M)γ), shorter for |γ| = 1"),),
        (("sigma", (vertical.t, vertical.e)), GAMMA, LAMBDA),
        ("p0", "p1", "p2", "p3"),
        vertical.closed_rotation,
    ),
    Kernel(
        "isotropic_spin",
        "w = B(γ/|γ|)⁻¹k for three equal moments: 2w is sin θ times the axis of the steady rotation.",
        (left("isotropic-spin", "the steps of the kernel compute w"),),
        (HALF, GAMMA, MOMENT, CONTACT),
        _vector("w"),
        steady.spin,
        steady.spin_steps,
    ),
    Kernel(
        "curve_increment",
        "k², G = G0 + G1 sn² + G2 sn⁴ and μ of a curve: hG𝒟 = 2Vw(𝒟 - D(l - μ sn²)), V² = G0, at the half increment.",
        (
            left("5.8-modulus", "k² as printed"),
            left("5.14-G", "G₀, G₁, G₂ by Λ and l: from G at sn²δu = 0, 1, -1"),
            left("5.14-Pi1", "μ by Λ and l"),
        ),
        (ORDERED, SQUARE),
        ("k2", "G0", "G1", "G2", "mu"),
        elliptic.increment_parts,
    ),
    Kernel(
        "precession_parts",
        "|b|² = P0 + P1 sn² and ⟨b,Λ⁻¹b⟩ = N0 + N1 sn² on a curve, b = γ × Λ⁻¹γ: Rb turns about γ by their quotient.",
        (
            left(
                "top-precession",
                "|b|² and ⟨b,Λ⁻¹b⟩ on the curve: their values at y = 0, and the differences to those at y = 1",
            ),
        ),
        (ORDERED, SQUARE),
        ("P0", "P1", "N0", "N1"),
        elliptic.precession_parts,
    ),
    Kernel(
        "torque",
        "B(γ)ω' = Iω × ω, ω' the rate of ω of the continuous ball.",
        (left("modified-field", "Iω × ω = K × ω + D⟨γ,ω⟩γ × ω"),),
        (OMEGA, MASS_TENSOR),
        _vector("x"),
        modified.torque,
    ),
    Kernel(
        "modified_load",
        "The load of the modified equations: 12ω₃ = 2|ω|²ω - ω × ω' - B(γ)⁻¹load, ω' the rate.",
        (left("modified-field", "the load is what is bilinear in x × Ix and 2D⟨x,ω'⟩x, of ω and ω', and of γ and γ̇"),),
        (OMEGA, RATE, *BODY),
        _vector("x"),
        modified.load,
    ),
    Kernel(
        "modified_rotation",
        "12ω₃: the step of size ε is that of the continuous ball with ω + ε²ω₃, up to ε⁴; share = B(γ)⁻¹load.",
        (left("modified-field", "12ω₃ from what the step leaves in ε³"),),
        (OMEGA, RATE, SHARE),
        _vector("x"),
        modified.correction,
    ),
    Kernel(
        "energy_rate",
        "4X₃(H) = D⟨γ,ω'⟩⟨γ × ω,ω'⟩: in a step of size ε the energy changes by ε³X₃(H), up to ε⁴.",
        (right("modified-energy", "-4⟨ω₃,Bω'⟩ = D⟨γ,ω'⟩⟨γ̇,ω'⟩"),),
        (OMEGA, RATE, GAMMA, CONTACT),
        ("rate",),
        lambda: [4 * modified.energy_rate()],
    ),
)
