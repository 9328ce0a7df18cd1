/* suslov.h: compile it with -ffp-contract=off.
 * Written by `chapsym codegen`: do not edit; change the derivation and generate again. */
#include <math.h>
#include <stdint.h>
#include <string.h>

typedef double real;
#define R(x) ((real)(x))
#define INLINE static inline

#include "suslov.h"

typedef struct { real a0, a1; } t_r2;
typedef struct { real a0, a1, a2, a3; } t_r4;
typedef struct { real a0, a1, a2, a3, a4, a5, a6, a7, a8; } t_r9;

INLINE t_r2 kernel_after(real u1, real u2, real J1, real J2, real J3, real J13, real J23) {
    real t0 = R(1) / (1 + u1 * u1 + u2 * u2), t1 = 2 * u1, t2 = J13 * u1 + J23 * u2;
    real o_m1 = t0 * (t1 * (J2 + J3) + 2 * t2 * u2), o_m2 = t0 * (2 * u2 * (J1 + J3) - t1 * t2);
    return (t_r2){o_m1, o_m2};
}

void suslov_after(const double gibbs[2], const double mass_tensor[5], double result[2]) {
    t_r2 got = kernel_after(gibbs[0], gibbs[1], mass_tensor[0], mass_tensor[1], mass_tensor[2], mass_tensor[3],
        mass_tensor[4]);
    memcpy(result, &got, sizeof got);
}

INLINE real kernel_energy(real M1, real M2, real J1, real J2, real J3, real J13, real J23) {
    real o_e = M1 * M1 / (J2 + J3) + M2 * M2 / (J1 + J3); return o_e;
}

void suslov_energy(const double momentum[2], const double mass_tensor[5], double result[1]) {
    real got = kernel_energy(momentum[0], momentum[1], mass_tensor[0], mass_tensor[1], mass_tensor[2], mass_tensor[3],
        mass_tensor[4]);
    memcpy(result, &got, sizeof got);
}

INLINE t_r2 kernel_residual(real u1, real u2, real M1, real M2, real J1, real J2, real J3, real J13, real J23) {
    real t0 = 2 * u1, t1 = t0 * u2, t2 = u2 * u2, t3 = u1 * u1, t4 = 1 + t2 + t3, t5 = 2 * u2;
    real o_r1 = J13 * t1 + 2 * J23 * t2 + M1 * t4 - (J2 * t0 + J3 * t0);
    real o_r2 = M2 * t4 - J1 * t5 - 2 * J13 * t3 - (J23 * t1 + J3 * t5); return (t_r2){o_r1, o_r2};
}

void suslov_residual(const double gibbs[2], const double momentum[2], const double mass_tensor[5], double result[2]) {
    t_r2 got = kernel_residual(gibbs[0], gibbs[1], momentum[0], momentum[1], mass_tensor[0], mass_tensor[1],
        mass_tensor[2], mass_tensor[3], mass_tensor[4]);
    memcpy(result, &got, sizeof got);
}

INLINE t_r4 kernel_residual_jacobian(real u1, real u2, real M1, real M2, real J1, real J2, real J3, real J13, real
    J23) {
    real t0 = 2 * J3, t1 = 2 * J13, t2 = 2 * M1, t3 = J23 * u2, o_a11 = t1 * u2 + t2 * u1 - (2 * J2 + t0);
    real o_a12 = 4 * t3 + t1 * u1 + t2 * u2, o_a21 = 2 * M2 * u1 - 2 * t3 - 4 * J13 * u1;
    real o_a22 = 2 * M2 * u2 - 2 * J1 - (t0 + 2 * J23 * u1); return (t_r4){o_a11, o_a12, o_a21, o_a22};
}

void suslov_residual_jacobian(const double gibbs[2], const double momentum[2], const double mass_tensor[5], double
    result[4]) {
    t_r4 got = kernel_residual_jacobian(gibbs[0], gibbs[1], momentum[0], momentum[1], mass_tensor[0], mass_tensor[1],
        mass_tensor[2], mass_tensor[3], mass_tensor[4]);
    memcpy(result, &got, sizeof got);
}

INLINE t_r9 kernel_turn(real u1, real u2) {
    real t0 = u2 * u2, t1 = u1 * u1, t2 = 1 + t1, t3 = R(1) / (t0 + t2), t4 = 2 * t3, t5 = t4 * u2, t6 = t5 * u1;
    real t7 = t4 * u1, o_t11 = t3 * (t2 - t0), o_t12 = t6, o_t13 = t5, o_t21 = t6, o_t22 = t3 * (1 + t0 - t1);
    real o_t23 = -t7, o_t31 = -t5, o_t32 = t7, o_t33 = t3 * (1 - t0 - t1);
    return (t_r9){o_t11, o_t12, o_t13, o_t21, o_t22, o_t23, o_t31, o_t32, o_t33};
}

void suslov_turn(const double gibbs[2], double result[9]) {
    t_r9 got = kernel_turn(gibbs[0], gibbs[1]); memcpy(result, &got, sizeof got);
}

