/* chapsym.h: compile it with -ffp-contract=off.
 * Written by `chapsym codegen`: do not edit; change the derivation and generate again. */
#include "chapsym.h"

#define LIBRARY
#include "loops.c"

void chapsym_angular_velocity(const double momentum[3], const double gamma[3], const double mass_tensor[3], double D,
    double result[3]) {
    t_r3 got = kernel_angular_velocity(momentum[0], momentum[1], momentum[2], gamma[0], gamma[1], gamma[2],
        mass_tensor[0], mass_tensor[1], mass_tensor[2], D);
    memcpy(result, &got, sizeof got);
}

void chapsym_centre_step(const double rotation[4], const double gamma[3], double result[3]) {
    t_r3 got = kernel_centre_step(rotation[0], rotation[1], rotation[2], rotation[3], gamma[0], gamma[1], gamma[2]);
    memcpy(result, &got, sizeof got);
}

void chapsym_compose(const double first[4], const double second[4], double result[4]) {
    t_r4 got = kernel_compose(first[0], first[1], first[2], first[3], second[0], second[1], second[2], second[3]);
    memcpy(result, &got, sizeof got);
}

INLINE t_r3 kernel_contact_momentum(real w1, real w2, real w3, real g1, real g2, real g3, real J1, real J2, real J3,
    real D) {
    real c1 = g3 * w2 - g2 * w3, c2 = g1 * w3 - g3 * w1, c3 = g2 * w1 - g1 * w2, f1 = D * c1, f2 = D * c2;
    real f3 = D * c3, o_K1 = f3 * g2 + w1 * (J2 + J3) - f2 * g3, o_K2 = f1 * g3 + w2 * (J1 + J3) - f3 * g1;
    real o_K3 = f2 * g1 + w3 * (J1 + J2) - f1 * g2; return (t_r3){o_K1, o_K2, o_K3};
}

void chapsym_contact_momentum(const double omega[3], const double gamma[3], const double mass_tensor[3], double D,
    double result[3]) {
    t_r3 got = kernel_contact_momentum(omega[0], omega[1], omega[2], gamma[0], gamma[1], gamma[2], mass_tensor[0],
        mass_tensor[1], mass_tensor[2], D);
    memcpy(result, &got, sizeof got);
}

INLINE t_r5 kernel_curve_increment(real L1, real L2, real L3, real l) {
    real t0 = L1 * l, t1 = t0 - 1, t2 = L2 - L3, t3 = (L3 * l - 1) / t2, t4 = R(1) / L2, t5 = t4 / (L1 * L3);
    real o_k2 = -t3 * (L1 - L2) / t1, o_G0 = t1 * t2 * t5, o_G1 = t5 * (t2 + 2 * L3 * t0 - L1), o_G2 = t3 * t4;
    real o_mu = -t3; return (t_r5){o_k2, o_G0, o_G1, o_G2, o_mu};
}

void chapsym_curve_increment(const double ordered[3], double inverse_square, double result[5]) {
    t_r5 got = kernel_curve_increment(ordered[0], ordered[1], ordered[2], inverse_square);
    memcpy(result, &got, sizeof got);
}

void chapsym_energy(const double momentum[3], const double gamma[3], const double mass_tensor[3], double D, double
    result[1]) {
    real got = kernel_energy(momentum[0], momentum[1], momentum[2], gamma[0], gamma[1], gamma[2], mass_tensor[0],
        mass_tensor[1], mass_tensor[2], D);
    memcpy(result, &got, sizeof got);
}

INLINE real kernel_energy_rate(real w1, real w2, real w3, real a1, real a2, real a3, real g1, real g2, real g3, real
    D) {
    real o_rate = D * (a1 * g1 + a2 * g2 + a3 * g3) * (a1 * (g2 * w3 - g3 * w2) + a2 * (g3 * w1 - g1 * w3) + a3 * (g1
        * w2 - g2 * w1));
    return o_rate;
}

void chapsym_energy_rate(const double omega[3], const double rate[3], const double gamma[3], double D, double
    result[1]) {
    real got = kernel_energy_rate(omega[0], omega[1], omega[2], rate[0], rate[1], rate[2], gamma[0], gamma[1],
        gamma[2], D);
    memcpy(result, &got, sizeof got);
}

void chapsym_gibbs_mixed(const double correction[3], const double next_correction[3], const double half_momentum[3],
    const double cofactors[9], const double inertia[3], double result[3]) {
    t_r3 got = kernel_gibbs_mixed(correction[0], correction[1], correction[2], next_correction[0], next_correction[1],
        next_correction[2], half_momentum[0], half_momentum[1], half_momentum[2], cofactors[0], cofactors[1],
        cofactors[2], cofactors[3], cofactors[4], cofactors[5], cofactors[6], cofactors[7], cofactors[8], inertia[0],
        inertia[1], inertia[2]);
    memcpy(result, &got, sizeof got);
}

void chapsym_gibbs_newton(const double gibbs[3], const double half_momentum[3], const double gamma[3], const double
    inertia[3], double D, double result[13]) {
    t_r13 got = kernel_gibbs_newton(gibbs[0], gibbs[1], gibbs[2], half_momentum[0], half_momentum[1],
        half_momentum[2], gamma[0], gamma[1], gamma[2], inertia[0], inertia[1], inertia[2], D);
    memcpy(result, &got, sizeof got);
}

void chapsym_gibbs_newton_heavy(const double gibbs[3], const double half_momentum[3], const double gamma[3], const
    double inertia[3], double D, double result[13]) {
    t_r13 got = kernel_gibbs_newton_heavy(gibbs[0], gibbs[1], gibbs[2], half_momentum[0], half_momentum[1],
        half_momentum[2], gamma[0], gamma[1], gamma[2], inertia[0], inertia[1], inertia[2], D);
    memcpy(result, &got, sizeof got);
}

INLINE t_r3 kernel_gibbs_residual(real u1, real u2, real u3, real k1, real k2, real k3, real g1, real g2, real g3,
    real I1, real I2, real I3, real D) {
    real x1 = g3 * u2 - g2 * u3, x2 = g1 * u3 - g3 * u1, x3 = g2 * u1 - g1 * u2, y1 = I1 * u1, y2 = I2 * u2;
    real y3 = I3 * u3, s = 1 + u1 * u1 + (u2 * u2 + u3 * u3);
    real o_r1 = y1 + D * (g2 * x3 - g3 * x2) + u2 * y3 - (k1 * s + u3 * y2);
    real o_r2 = y2 + D * (g3 * x1 - g1 * x3) + u3 * y1 - (k2 * s + u1 * y3);
    real o_r3 = y3 + D * (g1 * x2 - g2 * x1) + u1 * y2 - (k3 * s + u2 * y1); return (t_r3){o_r1, o_r2, o_r3};
}

void chapsym_gibbs_residual(const double gibbs[3], const double half_momentum[3], const double gamma[3], const double
    inertia[3], double D, double result[3]) {
    t_r3 got = kernel_gibbs_residual(gibbs[0], gibbs[1], gibbs[2], half_momentum[0], half_momentum[1],
        half_momentum[2], gamma[0], gamma[1], gamma[2], inertia[0], inertia[1], inertia[2], D);
    memcpy(result, &got, sizeof got);
}

void chapsym_gibbs_second(const double correction[3], const double half_momentum[3], const double cofactors[9], const
    double inertia[3], double result[3]) {
    t_r3 got = kernel_gibbs_second(correction[0], correction[1], correction[2], half_momentum[0], half_momentum[1],
        half_momentum[2], cofactors[0], cofactors[1], cofactors[2], cofactors[3], cofactors[4], cofactors[5],
        cofactors[6], cofactors[7], cofactors[8], inertia[0], inertia[1], inertia[2]);
    memcpy(result, &got, sizeof got);
}

void chapsym_gibbs_symmetric(const double gibbs[3], const double half_momentum[3], const double gamma[3], const double
    inertia[3], double D, double result[3]) {
    t_r3 got = kernel_gibbs_symmetric(gibbs[0], gibbs[1], gibbs[2], half_momentum[0], half_momentum[1],
        half_momentum[2], gamma[0], gamma[1], gamma[2], inertia[0], inertia[1], inertia[2], D);
    memcpy(result, &got, sizeof got);
}

INLINE t_r3 kernel_invariants(real K1, real K2, real K3, real g1, real g2, real g3) {
    real o_h = K1 * g1 + K2 * g2 + K3 * g3, o_n = K1 * K1 + K2 * K2 + K3 * K3, o_unit = g1 * g1 + g2 * g2 + g3 * g3;
    return (t_r3){o_h, o_n, o_unit};
}

void chapsym_invariants(const double momentum[3], const double gamma[3], double result[3]) {
    t_r3 got = kernel_invariants(momentum[0], momentum[1], momentum[2], gamma[0], gamma[1], gamma[2]);
    memcpy(result, &got, sizeof got);
}

INLINE t_r3 kernel_isotropic_spin(real k1, real k2, real k3, real g1, real g2, real g3, real moment, real D) {
    real share = D * (g1 * k1 + g2 * k2 + g3 * k3) / (moment * (g1 * g1 + g2 * g2 + g3 * g3)), whole = D + moment;
    real t0 = R(1) / whole, o_w1 = t0 * (k1 + g1 * share), o_w2 = t0 * (k2 + g2 * share);
    real o_w3 = t0 * (k3 + g3 * share); return (t_r3){o_w1, o_w2, o_w3};
}

void chapsym_isotropic_spin(const double half_momentum[3], const double gamma[3], double moment, double D, double
    result[3]) {
    t_r3 got = kernel_isotropic_spin(half_momentum[0], half_momentum[1], half_momentum[2], gamma[0], gamma[1],
        gamma[2], moment, D);
    memcpy(result, &got, sizeof got);
}

INLINE t_r3 kernel_modified_load(real w1, real w2, real w3, real a1, real a2, real a3, real g1, real g2, real g3, real
    J1, real J2, real J3, real D) {
    real t0 = J1 + J2, t1 = a2 * w3, t2 = a3 * w2, t3 = J1 + J3, t4 = g2 * w3 - g3 * w2;
    real t5 = a1 * g1 + a2 * g2 + a3 * g3, t6 = g3 * w1 - g1 * w3, t7 = g1 * w2 - g2 * w1;
    real t8 = a1 * t4 + a2 * t6 + a3 * t7, t9 = 2 * D, t10 = J2 + J3, t11 = a1 * w3, t12 = a3 * w1, t13 = a1 * w2;
    real t14 = a2 * w1, o_x1 = t0 * t1 + t0 * t2 + t9 * (g1 * t8 + t4 * t5) - (t1 * t3 + t2 * t3);
    real o_x2 = t10 * t11 + t10 * t12 + t9 * (g2 * t8 + t5 * t6) - (t0 * t11 + t0 * t12);
    real o_x3 = t13 * t3 + t14 * t3 + t9 * (g3 * t8 + t5 * t7) - (t10 * t13 + t10 * t14);
    return (t_r3){o_x1, o_x2, o_x3};
}

void chapsym_modified_load(const double omega[3], const double rate[3], const double gamma[3], const double
    mass_tensor[3], double D, double result[3]) {
    t_r3 got = kernel_modified_load(omega[0], omega[1], omega[2], rate[0], rate[1], rate[2], gamma[0], gamma[1],
        gamma[2], mass_tensor[0], mass_tensor[1], mass_tensor[2], D);
    memcpy(result, &got, sizeof got);
}

INLINE t_r3 kernel_modified_rotation(real w1, real w2, real w3, real a1, real a2, real a3, real e1, real e2, real e3)
    {
    real t0 = 2 * w1 * w1 + 2 * w2 * w2 + 2 * w3 * w3, o_x1 = a2 * w3 + t0 * w1 - (e1 + a3 * w2);
    real o_x2 = a3 * w1 + t0 * w2 - (e2 + a1 * w3), o_x3 = a1 * w2 + t0 * w3 - (e3 + a2 * w1);
    return (t_r3){o_x1, o_x2, o_x3};
}

void chapsym_modified_rotation(const double omega[3], const double rate[3], const double share[3], double result[3]) {
    t_r3 got = kernel_modified_rotation(omega[0], omega[1], omega[2], rate[0], rate[1], rate[2], share[0], share[1],
        share[2]);
    memcpy(result, &got, sizeof got);
}

INLINE t_r3 kernel_momentum(real q0, real q1, real q2, real q3, real g1, real g2, real g3, real J1, real J2, real J3,
    real D) {
    real c1 = g3 * q2 - g2 * q3, c2 = g1 * q3 - g3 * q1, c3 = g2 * q1 - g1 * q2, f1 = D * c1, f2 = D * c2;
    real f3 = D * c3, t0 = -J3, t1 = 2 * q3, t2 = 2 * q0;
    real o_K1 = t2 * (f3 * g2 + q1 * (J2 + J3) - f2 * g3) + q2 * t1 * (J2 + t0);
    real o_K2 = t2 * (f1 * g3 + q2 * (J1 + J3) - f3 * g1) - q1 * t1 * (J1 + t0);
    real o_K3 = t2 * (f2 * g1 + q3 * (J1 + J2) - f1 * g2) + 2 * q1 * q2 * (J1 - J2); return (t_r3){o_K1, o_K2, o_K3};
}

void chapsym_momentum(const double rotation[4], const double gamma[3], const double mass_tensor[3], double D, double
    result[3]) {
    t_r3 got = kernel_momentum(rotation[0], rotation[1], rotation[2], rotation[3], gamma[0], gamma[1], gamma[2],
        mass_tensor[0], mass_tensor[1], mass_tensor[2], D);
    memcpy(result, &got, sizeof got);
}

INLINE t_r9 kernel_momentum_jacobian(real q0, real q1, real q2, real q3, real g1, real g2, real g3, real J1, real J2,
    real J3, real D) {
    real t0 = g2 * g2, t1 = g3 * g3, t2 = J2 + J3 + D * (t0 + t1), t3 = R(1) / q0, t4 = 2 * D * g1, t5 = g2 * t4;
    real t6 = g3 * t4, t7 = t3 * (2 * q1 * t2 - q2 * t5 - q3 * t6), t8 = q0 * t5, t9 = -J3, t10 = J2 + t9;
    real t11 = q0 * t6, t12 = 2 * J1 + 2 * t9, t13 = 2 * D * g2 * g3, t14 = g1 * g1, t15 = J1 + J3 + D * (t1 + t14);
    real t16 = t3 * (2 * q2 * t15 - q1 * t5 - q3 * t13), t17 = q0 * t13, t18 = J1 - J2;
    real t19 = J1 + J2 + D * (t0 + t14), t20 = t3 * (2 * q3 * t19 - q1 * t6 - q2 * t13);
    real o_dK11 = 2 * q0 * t2 - q1 * t7, o_dK12 = 2 * q3 * t10 - t8 - q2 * t7, o_dK13 = 2 * q2 * t10 - t11 - q3 * t7;
    real o_dK21 = -t8 - q1 * t16 - q3 * t12, o_dK22 = 2 * q0 * t15 - q2 * t16, o_dK23 = -t17 - q1 * t12 - q3 * t16;
    real o_dK31 = 2 * q2 * t18 - t11 - q1 * t20, o_dK32 = 2 * q1 * t18 - t17 - q2 * t20;
    real o_dK33 = 2 * q0 * t19 - q3 * t20;
    return (t_r9){o_dK11, o_dK12, o_dK13, o_dK21, o_dK22, o_dK23, o_dK31, o_dK32, o_dK33};
}

void chapsym_momentum_jacobian(const double rotation[4], const double gamma[3], const double mass_tensor[3], double D,
    double result[9]) {
    t_r9 got = kernel_momentum_jacobian(rotation[0], rotation[1], rotation[2], rotation[3], gamma[0], gamma[1],
        gamma[2], mass_tensor[0], mass_tensor[1], mass_tensor[2], D);
    memcpy(result, &got, sizeof got);
}

INLINE t_r4 kernel_precession_parts(real L1, real L2, real L3, real l) {
    real t0 = (L3 * l - 1) / (L1 * L3), t1 = t0 * (L1 * l - 1), t2 = R(1) / L2, t3 = t0 * t2 * (L1 - L2), o_P0 = -t1;
    real o_P1 = t3, o_N0 = -t1 * t2, o_N1 = l * t3; return (t_r4){o_P0, o_P1, o_N0, o_N1};
}

void chapsym_precession_parts(const double ordered[3], double inverse_square, double result[4]) {
    t_r4 got = kernel_precession_parts(ordered[0], ordered[1], ordered[2], inverse_square);
    memcpy(result, &got, sizeof got);
}

void chapsym_residual(const double rotation[4], const double momentum[3], const double gamma[3], const double
    mass_tensor[3], double D, double result[3]) {
    t_r3 got = kernel_residual(rotation[0], rotation[1], rotation[2], rotation[3], momentum[0], momentum[1],
        momentum[2], gamma[0], gamma[1], gamma[2], mass_tensor[0], mass_tensor[1], mass_tensor[2], D);
    memcpy(result, &got, sizeof got);
}

void chapsym_rotate(const double rotation[4], const double vector[3], double result[3]) {
    t_r3 got = kernel_rotate(rotation[0], rotation[1], rotation[2], rotation[3], vector[0], vector[1], vector[2]);
    memcpy(result, &got, sizeof got);
}

INLINE t_r9 kernel_rotation(real q0, real q1, real q2, real q3) {
    real t0 = q1 * q1, t1 = q2 * q2, t2 = -t1, t3 = q0 * q0, t4 = q3 * q3, t5 = t3 - t4, t6 = 2 * q0, t7 = q3 * t6;
    real t8 = q2 * t6, t9 = 2 * q1, t10 = -t0, t11 = q1 * t6, o_R11 = t0 + t2 + t5, o_R12 = 2 * q1 * q2 - t7;
    real o_R13 = t8 + q3 * t9, o_R21 = t7 + q2 * t9, o_R22 = t1 + t10 + t5, o_R23 = 2 * q2 * q3 - t11;
    real o_R31 = 2 * q1 * q3 - t8, o_R32 = t11 + 2 * q2 * q3, o_R33 = t10 + t2 + (t3 + t4);
    return (t_r9){o_R11, o_R12, o_R13, o_R21, o_R22, o_R23, o_R31, o_R32, o_R33};
}

void chapsym_rotation(const double rotation[4], double result[9]) {
    t_r9 got = kernel_rotation(rotation[0], rotation[1], rotation[2], rotation[3]); memcpy(result, &got, sizeof got);
}

void chapsym_tangent_hessian(const double rotation[4], const double gamma[3], const double mass_tensor[3], double D,
    double result[18]) {
    t_r18 got = kernel_tangent_hessian(rotation[0], rotation[1], rotation[2], rotation[3], gamma[0], gamma[1],
        gamma[2], mass_tensor[0], mass_tensor[1], mass_tensor[2], D);
    memcpy(result, &got, sizeof got);
}

void chapsym_tangent_jacobian(const double rotation[4], const double gamma[3], const double mass_tensor[3], double D,
    double result[9]) {
    t_r9 got = kernel_tangent_jacobian(rotation[0], rotation[1], rotation[2], rotation[3], gamma[0], gamma[1],
        gamma[2], mass_tensor[0], mass_tensor[1], mass_tensor[2], D);
    memcpy(result, &got, sizeof got);
}

INLINE t_r3 kernel_torque(real w1, real w2, real w3, real J1, real J2, real J3) {
    real t0 = J1 + J2, t1 = J1 + J3, t2 = w1 * w3, t3 = J2 + J3, o_x1 = t1 * w2 * w3 - t0 * w2 * w3;
    real o_x2 = t0 * t2 - t2 * t3, o_x3 = t3 * w1 * w2 - t1 * w1 * w2; return (t_r3){o_x1, o_x2, o_x3};
}

void chapsym_torque(const double omega[3], const double mass_tensor[3], double result[3]) {
    t_r3 got = kernel_torque(omega[0], omega[1], omega[2], mass_tensor[0], mass_tensor[1], mass_tensor[2]);
    memcpy(result, &got, sizeof got);
}

INLINE t_r3 kernel_transport(real q0, real q1, real q2, real q3, real v1, real v2, real v3) {
    real t0 = q2 * q2, t1 = q3 * q3, t2 = 2 * v1, t3 = q0 * q3, t4 = q1 * q2, t5 = q0 * q2, t6 = q1 * q3;
    real t7 = 2 * v3, t8 = q1 * q1, t9 = 2 * v2, t10 = q0 * q1, t11 = q2 * q3;
    real o_x1 = v1 + 2 * v2 * (t3 + t4) - (t2 * (t0 + t1) + t7 * (t5 - t6));
    real o_x2 = v2 + 2 * v3 * (t10 + t11) - (t2 * (t3 - t4) + t9 * (t1 + t8));
    real o_x3 = v3 + t2 * (t5 + t6) - (t7 * (t0 + t8) + t9 * (t10 - t11)); return (t_r3){o_x1, o_x2, o_x3};
}

void chapsym_transport(const double rotation[4], const double vector[3], double result[3]) {
    t_r3 got = kernel_transport(rotation[0], rotation[1], rotation[2], rotation[3], vector[0], vector[1], vector[2]);
    memcpy(result, &got, sizeof got);
}

void chapsym_turn(const double quaternion[4], const double vector[3], double result[3]) {
    t_r3 got = kernel_turn(quaternion[0], quaternion[1], quaternion[2], quaternion[3], vector[0], vector[1],
        vector[2]);
    memcpy(result, &got, sizeof got);
}

void chapsym_vertical_level(const double scalars[2], double level, const double Lambda[3], double result[2]) {
    t_r2 got = kernel_vertical_level(scalars[0], scalars[1], level, Lambda[0], Lambda[1], Lambda[2]);
    memcpy(result, &got, sizeof got);
}

void chapsym_vertical_rotation(const double sigma[2], const double gamma[3], const double Lambda[3], double result[4])
    {
    t_r4 got = kernel_vertical_rotation(sigma[0], sigma[1], gamma[0], gamma[1], gamma[2], Lambda[0], Lambda[1],
        Lambda[2]);
    memcpy(result, &got, sizeof got);
}

void chapsym_vertical_square(const double gamma[3], const double Lambda[3], double result[1]) {
    real got = kernel_vertical_square(gamma[0], gamma[1], gamma[2], Lambda[0], Lambda[1], Lambda[2]);
    memcpy(result, &got, sizeof got);
}

int chapsym_step(const double mass_tensor[3], double D, double momentum[3], double gamma[3], double rotation[4],
    double *reach) {
    double tensor[3] = {mass_tensor[0], mass_tensor[1], mass_tensor[2]}, state[27] = {0};
    t_ir got = loop_advance((r1){momentum, 3}, (r1){gamma, 3}, (r1){tensor, 3}, D, (r1){state, 27}, (r1){rotation,
        4});
    *reach = got.a1; return (int)got.a0;
}

