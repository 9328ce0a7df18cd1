/* rolling_disc.h: compile it with -ffp-contract=off.
 * Written by `chapsym codegen`: do not edit; change the derivation and generate again. */
#include <math.h>
#include <stdint.h>
#include <string.h>

typedef double real;
#define R(x) ((real)(x))
#define INLINE static inline

#include "rolling_disc.h"

typedef struct { real a0, a1; } t_r2;
typedef struct { real a0, a1, a2; } t_r3;

INLINE t_r3 kernel_accelerations(real q2, real d1, real d2, real d3, real r, real g) {
    real s2 = R(sin(q2)), c2 = R(cos(q2)), t0 = d2 * d3, t1 = c2 * r, o_a1 = -2 * t0 / c2;
    real o_a2 = (4 * g * s2 + 6 * d1 * d3 * t1 + 5 * d1 * d1 * s2 * t1) / (5 * r);
    real o_a3 = -(5 * c2 * c2 * c2 * d1 * d2 - 6 * c2 * s2 * t0) / (3 * c2 * c2); return (t_r3){o_a1, o_a2, o_a3};
}

void rolling_disc_accelerations(double lean, const double rates[3], double radius, double gravity, double result[3]) {
    t_r3 got = kernel_accelerations(lean, rates[0], rates[1], rates[2], radius, gravity);
    memcpy(result, &got, sizeof got);
}

INLINE t_r3 kernel_spin_rates(real q2, real u1, real u2, real u3, real r, real g) {
    real s2 = R(sin(q2)), c2 = R(cos(q2)), t0 = R(1) / c2, t1 = r * t0, t2 = s2 * u3, t3 = c2 * u2 - t2;
    real t4 = c2 * c2, t5 = R(1) / t4, t6 = t3 * u1, t7 = s2 * t6;
    real o_b1 = (4 * g * s2 + 5 * s2 * t1 * u3 * u3 + 6 * t1 * t3 * u3) / (5 * r);
    real o_b2 = u1 * u3 - 2 * t5 * t7 - t5 * (5 * t4 * u1 * u3 - 6 * t7) / 3, o_b3 = -2 * t0 * t6 - t0 * t2 * u1;
    return (t_r3){o_b1, o_b2, o_b3};
}

void rolling_disc_spin_rates(double lean, const double spin[3], double radius, double gravity, double result[3]) {
    t_r3 got = kernel_spin_rates(lean, spin[0], spin[1], spin[2], radius, gravity); memcpy(result, &got, sizeof got);
}

INLINE t_r2 kernel_velocity(real u1, real u2, real u3, real r) {
    real o_v1 = r * u2, o_v2 = -r * u1; return (t_r2){o_v1, o_v2};
}

void rolling_disc_velocity(const double spin[3], double radius, double result[2]) {
    t_r2 got = kernel_velocity(spin[0], spin[1], spin[2], radius); memcpy(result, &got, sizeof got);
}

