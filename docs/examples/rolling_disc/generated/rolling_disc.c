/* rolling_disc.h: compile it with -ffp-contract=off.
 * Written by `chapsym codegen`: do not edit; change the derivation and generate again. */
#include <math.h>
#include <stdint.h>
#include <string.h>

typedef double real;
#define R(x) ((real)(x))
#define INLINE static inline

#include "rolling_disc.h"

typedef struct { int64_t a0; real a1; int64_t a2, a3; real a4; int64_t a5; real a6, a7; int64_t a8; real a9; int64_t
    a10; real a11, a12, a13, a14, a15; } t_iri2rir2irir5;
typedef struct { real a0, a1; } t_r2;
typedef struct { real a0, a1, a2; } t_r3;
typedef struct { real a0, a1, a2, a3; } t_r4;

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

INLINE t_r4 kernel_step_lack(real q2, real u1, real u2, real u3, real x1, real x2, real x3, real x4, real r, real g,
    real h) {
    real s2 = R(sin(q2)), c2 = R(cos(q2)), t0 = h * u1, t1 = t0 / 2, t2 = R(1) / c2, o_f1 = q2 - t1 - x1;
    real o_f2 = u1 - x2 - h * (4 * g * s2 + 6 * r * u2 * u3 - r * s2 * t2 * u3 * u3) / (10 * r);
    real o_f3 = u2 + t0 * u3 / 3 - x3, o_f4 = u3 - x4 - t1 * (s2 * t2 * u3 - 2 * u2);
    return (t_r4){o_f1, o_f2, o_f3, o_f4};
}

void rolling_disc_step_lack(const double middle[4], const double start[4], double radius, double gravity, double step,
    double result[4]) {
    t_r4 got = kernel_step_lack(middle[0], middle[1], middle[2], middle[3], start[0], start[1], start[2], start[3],
        radius, gravity, step);
    memcpy(result, &got, sizeof got);
}

INLINE t_iri2rir2irir5 kernel_step_slope(real q2, real u1, real u2, real u3, real x1, real x2, real x3, real x4, real
    r, real g, real h) {
    real s2 = R(sin(q2)), c2 = R(cos(q2)), t0 = h / 2, t1 = R(1) / (c2 * c2), t2 = s2 * s2, t3 = u3 * u3;
    real t4 = R(1) / c2, t5 = r * t4, t6 = h / (10 * r), t7 = h * u3, t8 = h * u1, t9 = t0 * u1, t10 = t9 * u3;
    int64_t o_j11 = 1; real o_j12 = -t0; int64_t o_j13 = 0, o_j14 = 0;
    real o_j21 = h * t1 * t2 * t3 / 10 - c2 * t6 * (4 * g - t3 * t5); int64_t o_j22 = 1;
    real o_j23 = -3 * t7 / 5, o_j24 = -t6 * (6 * r * u2 - 2 * s2 * t5 * u3); int64_t o_j31 = 0; real o_j32 = t7 / 3;
    int64_t o_j33 = 1;
    real o_j34 = t8 / 3, o_j41 = -t10 - t1 * t10 * t2, o_j42 = -t0 * (s2 * t4 * u3 - 2 * u2), o_j43 = t8;
    real o_j44 = 1 - s2 * t4 * t9;
    return (t_iri2rir2irir5){o_j11, o_j12, o_j13, o_j14, o_j21, o_j22, o_j23, o_j24, o_j31, o_j32, o_j33, o_j34,
        o_j41, o_j42, o_j43, o_j44};
}

void rolling_disc_step_slope(const double middle[4], const double start[4], double radius, double gravity, double
    step, double result[16]) {
    t_iri2rir2irir5 got = kernel_step_slope(middle[0], middle[1], middle[2], middle[3], start[0], start[1], start[2],
        start[3], radius, gravity, step);
    result[0] = got.a0; result[1] = got.a1; result[2] = got.a2; result[3] = got.a3; result[4] = got.a4;
    result[5] = got.a5; result[6] = got.a6; result[7] = got.a7; result[8] = got.a8; result[9] = got.a9;
    result[10] = got.a10; result[11] = got.a11; result[12] = got.a12; result[13] = got.a13; result[14] = got.a14;
    result[15] = got.a15;
}

INLINE t_r2 kernel_velocity(real u1, real u2, real u3, real r) {
    real o_v1 = r * u2, o_v2 = -r * u1; return (t_r2){o_v1, o_v2};
}

void rolling_disc_velocity(const double spin[3], double radius, double result[2]) {
    t_r2 got = kernel_velocity(spin[0], spin[1], spin[2], radius); memcpy(result, &got, sizeof got);
}

