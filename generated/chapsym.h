/* The kernels of chapsym, each from a proved expression, and one step of the map: for other languages.
 * Written by `chapsym codegen`: do not edit; change the derivation and generate again. */
#ifndef CHAPSYM_H
#define CHAPSYM_H

#ifdef __cplusplus
extern "C" {
#endif

/* One step of the map (5.3) on the small-rotation branch, in place.

   mass_tensor: J, the second moments of mass; D: mass times radius squared.  momentum: the discrete momentum,
   epsilon K, in the units of J; gamma: the unit vertical, upwards.  rotation: receives the unit quaternion of the step,
   scalar first.  reach: receives the fraction of the momentum that the branch attains, 1 for a step that is taken.
   The numbers are not checked: mass_tensor and D must be at least 0, gamma of length 1, all of them finite.
   Returns 0 if the step was taken; 1 at a fold, 2 where the continuation did not converge, 4 for a ball without
   inertia: then momentum, gamma and rotation are as before. */
int chapsym_step(const double mass_tensor[3], double D, double momentum[3], double gamma[3], double rotation[4],
    double *reach);

/* Of a kernel with N roundings each result is off by at most N 2^-53 (1 + 2^-10) of its terms, if nothing over- or
   underflows and no divisor is below 2^-25 of its own terms (lemma `rounding` of chapsym).  Terms are a formula with
   every sum taken absolutely: |x| of an argument, terms(a) + terms(b) of a + b and a - b, terms(a) terms(b) of a b,
   terms(a) terms(b)/b^2 of a/b. */

/* ω(K, γ) of the continuous ball (the unnumbered inverse before 2.5, as corrected). result: w1, w2, w3. Roundings:
    24. */
void chapsym_angular_velocity(const double momentum[3], const double gamma[3], const double mass_tensor[3], double D,
    double result[3]);

/* Δr/ρ of one step in the body frame before it, γ upwards (4.9 with 2.1 as corrected). result: s1, s2, s3. Roundings:
    3. */
void chapsym_centre_step(const double rotation[4], const double gamma[3], double result[3]);

/* Hamilton's product of two quaternions, scalar first: R_{k+1} = R_k Ω_k for attitudes. result: c0, c1, c2, c3.
    Roundings: 3. */
void chapsym_compose(const double first[4], const double second[4], double result[4]);

/* K = Λω - D⟨ω,γ⟩γ, the momentum of the continuous ball about the contact point. result: K1, K2, K3. Roundings: 6. */
void chapsym_contact_momentum(const double omega[3], const double gamma[3], const double mass_tensor[3], double D,
    double result[3]);

/* k², G = G0 + G1 sn² + G2 sn⁴ and μ of a curve: hG𝒟 = 2Vw(𝒟 - D(l - μ sn²)), V² = G0, at the half increment. result:
    k2, G0, G1, G2, mu. Roundings: 9. */
void chapsym_curve_increment(const double ordered[3], double inverse_square, double result[5]);

/* The kinetic energy ½⟨K, ω⟩ of the continuous ball with the momentum K (2.5 as corrected). result: T. Roundings: 28.
    */
void chapsym_energy(const double momentum[3], const double gamma[3], const double mass_tensor[3], double D, double
    result[1]);

/* 4X₃(H) = D⟨γ,ω'⟩⟨γ × ω,ω'⟩: in a step of size ε the energy changes by ε³X₃(H), up to ε⁴. result: rate. Roundings:
    10. */
void chapsym_energy_rate(const double omega[3], const double rate[3], const double gamma[3], double D, double
    result[1]);

/* What N loses when a correction e follows a correction d with the cofactors from before d. result: x1, x2, x3.
    Roundings: 9. */
void chapsym_gibbs_mixed(const double correction[3], const double next_correction[3], const double half_momentum[3],
    const double cofactors[9], const double inertia[3], double result[3]);

/* The next Newton iterate of the Gibbs vector, N/det, as a quaternion (det, N); and the cofactors of ∂G/∂u. result:
    det, N1, N2, N3, C11, C12, C13, C21, C22, C23, C31, C32, C33. Roundings: 19. */
void chapsym_gibbs_newton(const double gibbs[3], const double half_momentum[3], const double gamma[3], const double
    inertia[3], double D, double result[13]);

/* What `gibbs_newton` computes, with a determinant in which nothing cancels for D ≫ I. result: det, N1, N2, N3, C11,
    C12, C13, C21, C22, C23, C31, C32, C33. Roundings: 26. */
void chapsym_gibbs_newton_heavy(const double gibbs[3], const double half_momentum[3], const double gamma[3], const
    double inertia[3], double D, double result[13]);

/* G(u) = B(γ)u + u × Iu - (1 + |u|²)k, which the Gibbs vector of the next step makes zero. result: r1, r2, r3.
    Roundings: 8. */
void chapsym_gibbs_residual(const double gibbs[3], const double half_momentum[3], const double gamma[3], const double
    inertia[3], double D, double result[3]);

/* What N loses by a second correction after a Newton correction d, with the same cofactors. result: e1, e2, e3.
    Roundings: 9. */
void chapsym_gibbs_second(const double correction[3], const double half_momentum[3], const double cofactors[9], const
    double inertia[3], double result[3]);

/* The trace, the sum of the principal minors of size 2 and the determinant of the symmetric part of ∂G/∂u. result:
    trace, minors, det. Roundings: 17. */
void chapsym_gibbs_symmetric(const double gibbs[3], const double half_momentum[3], const double gamma[3], const double
    inertia[3], double D, double result[3]);

/* ⟨𝒦,γ⟩ (the paper's h), ⟨𝒦,𝒦⟩ (its n) and ⟨γ,γ⟩, which every branch of the map preserves. result: h, n, unit.
    Roundings: 3. */
void chapsym_invariants(const double momentum[3], const double gamma[3], double result[3]);

/* w = B(γ/|γ|)⁻¹k for three equal moments: 2w is sin θ times the axis of the steady rotation. result: w1, w2, w3.
    Roundings: 14. */
void chapsym_isotropic_spin(const double half_momentum[3], const double gamma[3], double moment, double D, double
    result[3]);

/* The load of the modified equations: 12ω₃ = 2|ω|²ω - ω × ω' - B(γ)⁻¹load, ω' the rate. result: x1, x2, x3.
    Roundings: 10. */
void chapsym_modified_load(const double omega[3], const double rate[3], const double gamma[3], const double
    mass_tensor[3], double D, double result[3]);

/* 12ω₃: the step of size ε is that of the continuous ball with ω + ε²ω₃, up to ε⁴; share = B(γ)⁻¹load. result: x1,
    x2, x3. Roundings: 6. */
void chapsym_modified_rotation(const double omega[3], const double rate[3], const double share[3], double result[3]);

/* The discrete momentum 𝒦(q, γ) about the contact point (5.2); homogeneous of degree 2 in (q0, q). result: K1, K2,
    K3. Roundings: 8. */
void chapsym_momentum(const double rotation[4], const double gamma[3], const double mass_tensor[3], double D, double
    result[3]);

/* ∂𝒦/∂q in the chart q0 = sqrt(1 - |q|²), row by row; it divides by q0. result: dK11, dK12, dK13, dK21, dK22, dK23,
    dK31, dK32, dK33, 3 rows. Roundings: 12. */
void chapsym_momentum_jacobian(const double rotation[4], const double gamma[3], const double mass_tensor[3], double D,
    double result[9]);

/* |b|² = P0 + P1 sn² and ⟨b,Λ⁻¹b⟩ = N0 + N1 sn² on a curve, b = γ × Λ⁻¹γ: Rb turns about γ by their quotient. result:
    P0, P1, N0, N1. Roundings: 9. */
void chapsym_precession_parts(const double ordered[3], double inverse_square, double result[4]);

/* 𝒦(q, γ) - 𝒦, which the rotation of the next step makes zero (5.2). result: r1, r2, r3. Roundings: 9. */
void chapsym_residual(const double rotation[4], const double momentum[3], const double gamma[3], const double
    mass_tensor[3], double D, double result[3]);

/* Ωv for unit Euler parameters: from the frame of the body after the rotation to the one before. result: x1, x2, x3.
    Roundings: 5. */
void chapsym_rotate(const double rotation[4], const double vector[3], double result[3]);

/* The matrix Ω of unit Euler parameters, row by row (5.1 as corrected). result: R11, R12, R13, R21, R22, R23, R31,
    R32, R33, 3 rows. Roundings: 3. */
void chapsym_rotation(const double rotation[4], double result[9]);

/* The constant second derivative of 𝒦(q ∘ (1, w)) in w: the vectors for 11, 22, 33, 23, 13, 12. result: ddK11_1,
    ddK11_2, ddK11_3, ddK22_1, ddK22_2, ddK22_3, ddK33_1, ddK33_2, ddK33_3, ddK23_1, ddK23_2, ddK23_3, ddK13_1,
    ddK13_2, ddK13_3, ddK12_1, ddK12_2, ddK12_3, 6 rows. Roundings: 10. */
void chapsym_tangent_hessian(const double rotation[4], const double gamma[3], const double mass_tensor[3], double D,
    double result[18]);

/* The derivative of 𝒦 along q ∘ (0, w), w ∈ R³, row by row; regular at every rotation. result: dK11, dK12, dK13,
    dK21, dK22, dK23, dK31, dK32, dK33, 3 rows. Roundings: 10. */
void chapsym_tangent_jacobian(const double rotation[4], const double gamma[3], const double mass_tensor[3], double D,
    double result[9]);

/* B(γ)ω' = Iω × ω, ω' the rate of ω of the continuous ball. result: x1, x2, x3. Roundings: 4. */
void chapsym_torque(const double omega[3], const double mass_tensor[3], double result[3]);

/* Ωᵀv for unit Euler parameters: what a vector fixed in space becomes in the body (5.3). result: x1, x2, x3.
    Roundings: 5. */
void chapsym_transport(const double rotation[4], const double vector[3], double result[3]);

/* Ωᵀv - v for the rotation of a quaternion that need not be unit (5.3). result: x1, x2, x3. Roundings: 10. */
void chapsym_turn(const double quaternion[4], const double vector[3], double result[3]);

/* The scalar equation of the level, zero for the step 𝒦 = hγ, and its derivative in v. result: f, fv. Roundings: 15.
    */
void chapsym_vertical_level(const double scalars[2], double level, const double Lambda[3], double result[2]);

/* The rotation of the step 𝒦 = hγ up to a factor, (q0, q) ∝ (det M, t adj(M)γ), M = Λ - e - t γ×. result: p0, p1, p2,
    p3. Roundings: 8. */
void chapsym_vertical_rotation(const double sigma[2], const double gamma[3], const double Lambda[3], double
    result[4]);

/* ⟨γ, adj(Λ)γ⟩ = det(Λ)⟨γ, Λ⁻¹γ⟩, the integral of the reduced map G_h without its denominators. result: level.
    Roundings: 5. */
void chapsym_vertical_square(const double gamma[3], const double Lambda[3], double result[1]);

#ifdef __cplusplus
}
#endif
#endif
