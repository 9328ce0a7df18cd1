/* The loops of chapsym/dynamics/loops, with the kernels that they call; with SINGLE defined in float32.
 * Written by `chapsym codegen`: do not edit; change the loops or the derivation and generate again. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "loops.h"

#ifdef SINGLE
typedef float real;
#define LOOPS(rest) loops_single##rest
#else
typedef double real;
#define LOOPS(rest) loops_double##rest
#endif
#define R(x) ((real)(x))
/* On x86 a loop is compiled for wide registers, too, and takes them where the processor has them: to the same bits. */
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) && !defined(WIDEST_OFF)
#define WIDEST __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define WIDEST
#endif
#define INLINE static inline __attribute__((always_inline, unused))
#define OUT_OF_LINE static __attribute__((noinline, unused))
#define ALIGNED __attribute__((aligned(64)))
#if defined(__clang__)
#define INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define INDEPENDENT _Pragma("GCC ivdep")
#endif

INLINE real max_r(real a, real b) { return b > a ? b : a; }
INLINE real min_r(real a, real b) { return b < a ? b : a; }
INLINE int64_t max_i(int64_t a, int64_t b) { return b > a ? b : a; }
INLINE int64_t min_i(int64_t a, int64_t b) { return b < a ? b : a; }
INLINE int64_t div_i(int64_t a, int64_t b) { return a / b - ((a % b != 0) & ((a < 0) != (b < 0))); }
INLINE int64_t mod_i(int64_t a, int64_t b) { return a - b * div_i(a, b); }

/* Arrays: their elements, lengths and strides; an element, a row, and the rows from `low` to `high`. */
typedef struct { double *p; int64_t n0; } d1;
typedef struct { int32_t *p; int64_t n0; } w1;
typedef struct { int64_t *p; int64_t n0; } i1;
typedef struct { real *p; int64_t n0; } r1;
typedef struct { real *p; int64_t n0, n1, s0; } r2;
typedef struct { real *p; int64_t n0, n1, n2, s0, s1; } r3;
typedef struct { real *p; int64_t n0, n1, n2, n3, s0, s1, s2; } r4;
#define AT2(a, i, j) a.p[(i) * a.s0 + (j)]
#define AT3(a, i, j, k) a.p[(i) * a.s0 + (j) * a.s1 + (k)]
#define AT4(a, i, j, k, l) a.p[(i) * a.s0 + (j) * a.s1 + (k) * a.s2 + (l)]
INLINE r1 r2_row(r2 a, int64_t i) { return (r1){a.p + i * a.s0, a.n1}; }
INLINE r2 r3_row(r3 a, int64_t i) { return (r2){a.p + i * a.s0, a.n1, a.n2, a.s1}; }
INLINE r3 r4_row(r4 a, int64_t i) { return (r3){a.p + i * a.s0, a.n1, a.n2, a.n3, a.s1, a.s2}; }
INLINE d1 d1_part(d1 a, int64_t low, int64_t high) { return (d1){a.p + low, high - low}; }
INLINE i1 i1_part(i1 a, int64_t low, int64_t high) { return (i1){a.p + low, high - low}; }
INLINE r1 r1_part(r1 a, int64_t low, int64_t high) { return (r1){a.p + low, high - low}; }
INLINE r2 r2_part(r2 a, int64_t low, int64_t high) { return (r2){a.p + low * a.s0, high - low, a.n1, a.s0}; }
INLINE r3 r3_part(r3 a, int64_t low, int64_t high) {
    return (r3){a.p + low * a.s0, high - low, a.n1, a.n2, a.s0, a.s1};
}
INLINE void r1_fill(r1 a, real x) { for (int64_t i = 0; i < a.n0; i++) a.p[i] = x; }
INLINE void r2_fill(r2 a, real x) { for (int64_t i = 0; i < a.n0; i++) r1_fill(r2_row(a, i), x); }

/* The arguments of a loop, by their types. */
#define b_(i) (int)a[i].integer
#define i_(i) a[i].integer
#define r_(i) (real)a[i].number
#define d1_(i) (d1){a[i].p, a[i].n[0]}
#define i1_(i) (i1){a[i].p, a[i].n[0]}
#define r1_(i) (r1){a[i].p, a[i].n[0]}
#define r2_(i) (r2){a[i].p, a[i].n[0], a[i].n[1], a[i].s[0]}
#define r3_(i) (r3){a[i].p, a[i].n[0], a[i].n[1], a[i].n[2], a[i].s[0], a[i].s[1]}
#define r4_(i) (r4){a[i].p, a[i].n[0], a[i].n[1], a[i].n[2], a[i].n[3], a[i].s[0], a[i].s[1], a[i].s[2]}

typedef struct { real a0; int64_t a1; } t_ri;
INLINE t_ri real_frexp(real x) { int e; real m = (real)frexp(x, &e); return (t_ri){m, e}; }

typedef struct { real p0, p1, p2, p3, w1, w2, w3, first, d1, d2, d3, c11, c12, c13, c21, c22, c23, c31, c32, c33; }
    Round;
typedef struct { int a0; real a1; } t_br;
typedef struct { int64_t a0, a1; } t_i2;
typedef struct { int64_t a0; real a1; } t_ir;
typedef struct { real a0, a1; } t_r2;
typedef struct { int64_t a0, a1; real a2; } t_i2r;
typedef struct { real a0, a1, a2; } t_r3;
typedef struct { int64_t a0, a1; real a2, a3; } t_i2r2;
typedef struct { real a0, a1, a2, a3; } t_r4;
typedef struct { int a0; real a1, a2, a3, a4; } t_br4;
typedef struct { real a0, a1, a2, a3, a4; } t_r5;
typedef struct { int64_t a0; double a1, a2, a3, a4, a5; } t_id5;
typedef struct { int64_t a0; real a1, a2, a3, a4, a5; } t_ir5;
typedef struct { real a0, a1, a2, a3, a4, a5; } t_r6;
typedef struct { int a0; real a1, a2, a3, a4, a5, a6; } t_br6;
typedef struct { real a0, a1, a2, a3, a4, a5, a6; } t_r7;
typedef struct { int a0; real a1, a2, a3, a4, a5, a6, a7; } t_br7;
typedef struct { int64_t a0; real a1, a2, a3, a4, a5, a6, a7; } t_ir7;
typedef struct { real a0, a1, a2, a3, a4, a5, a6, a7; } t_r8;
typedef struct { int64_t a0; real a1, a2, a3, a4, a5, a6, a7, a8; } t_ir8;
typedef struct { real a0, a1, a2, a3, a4, a5, a6, a7, a8; } t_r9;
typedef struct { real a0, a1, a2, a3, a4, a5, a6, a7; int a8, a9; } t_r8b2;
typedef struct { real a0, a1, a2, a3, a4, a5, a6, a7, a8, a9; } t_r10;
typedef struct { real a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11; } t_r12;
typedef struct { real a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12; } t_r13;
typedef struct { real a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, a15, a16, a17; } t_r18;

#ifdef SINGLE
#define gibbs_LEFT R(5.960464477539063e-08)
#define gibbs_SMALLEST R(3.552713678800501e-15)
#define gibbs_LIGHTEST R(3.552713678800501e-15)
#define gibbs_LEAST_ENOUGH R(2.168404344971009e-19)
#define pairs_SPLITTER R(4097.0)
#define integrals_VERTICAL R(0.0001)
#define loop_small_rotation single_loop_widened
#define loop_follow_body single_loop_follow_body
#define block_LANES 80
#define block_REGISTER 16
t_id5 branch_small_rotation_double(double, double, double, double, double, double, double, double, double, double);
#else
#define gibbs_LEFT R(1.1102230246251565e-16)
#define gibbs_SMALLEST R(7.52316384526264e-37)
#define gibbs_LIGHTEST R(4.909093465297727e-91)
#define gibbs_LEAST_ENOUGH R(0.0)
#define pairs_SPLITTER R(134217729.0)
#define integrals_VERTICAL R(1e-06)
#define loop_small_rotation branch_small_rotation
#define block_LANES 40
#define block_REGISTER 8
#endif

INLINE real loop_power_of_two(int64_t exponent) {
    return (-126 <= exponent && exponent <= 127) ? R(ldexp(R(1.0), (int)exponent)) : R(0.0);
}

INLINE real loop_times(real x, real power, int64_t exponent) {
    return power != R(0.0) ? x * power : R(ldexp(x, (int)exponent));
}

INLINE t_r3 loop_three(r1 array, int64_t at) { return (t_r3){array.p[at], array.p[at + 1], array.p[at + 2]}; }
INLINE int gibbs_is_heavy(real I1, real I2, real I3, real D) { return R(32.0) * min_r(min_r(I1, I2), I3) < D; }
INLINE t_r2 gibbs_bound(real k1, real k2, real k3, real I1, real I2, real I3, real D) {
    int moving;
    real half = R(sqrt(k1 * k1 + k2 * k2 + k3 * k3)), size = R(2.0) * half, least = min_r(min_r(I1, I2), I3);
    real most = max_r(max_r(I1, I2), I3), spread = R(0.5) * (most - least);
    if (!(size < least)) { return (t_r2){R(-2.0), R(0.0)}; }
    real inner = size / (least + R(sqrt((least - size) * (least + size)))), slope = spread + size;
    if (!(inner * slope < R(0.95) * least)) { return (t_r2){R(-2.0), R(0.0)}; }
    real limit = slope > R(0.0) ? min_r(R(1.0), least / slope) : R(1.0);
    real radius = min_r(R(1.25) * inner, R(0.5) * (inner + limit));
    if (half == R(0.0)) {
        moving = k1 != R(0.0) || k2 != R(0.0) || k3 != R(0.0);
        if (moving && gibbs_LEAST_ENOUGH > R(0.0)) { return (t_r2){R(-1.0), R(0.0)}; }
        else { return (t_r2){R(0.0), R(0.0)}; }
    }
    real contraction = (spread + half) / (least - radius * slope);
    real enough = gibbs_LEFT * half / ((most + D + spread) * contraction);
    if (enough < gibbs_LEAST_ENOUGH) { return (t_r2){R(-1.0), R(0.0)}; }
    else { return (t_r2){radius * radius, enough}; }
}

INLINE t_r2 gibbs_certificate(real k1, real k2, real k3, real I1, real I2, real I3, real D) {
    if (gibbs_is_heavy(I1, I2, I3, D)) { return (t_r2){R(-1.0), R(0.0)}; }
    return gibbs_bound(k1, k2, k3, I1, I2, I3, D);
}

OUT_OF_LINE real loop_scaled(r1 momentum, r1 g, r1 tensor, real contact, r1 state) {
    t_ri t_1 = real_frexp(max_r(max_r(tensor.p[1] + tensor.p[2], tensor.p[0] + tensor.p[2]), tensor.p[0] +
        tensor.p[1]) + contact);
    int64_t exponent = t_1.a1;
    real largest = max_r(max_r(R(fabs(momentum.p[0])), R(fabs(momentum.p[1]))), R(fabs(momentum.p[2])));
    t_ri size = real_frexp(largest); exponent = max_i(min_i(exponent, 1021), size.a1 - 1021);
    int tiny = R(0.0) < largest && largest < R(ldexp(gibbs_SMALLEST, (int)exponent));
    if (tiny) { exponent = max_i(-1, exponent - 1021 + 1); }
    r1_fill(state, R(0.0)); real power = loop_power_of_two(-exponent), half = loop_power_of_two(-exponent - 1);
    for (int64_t c = 0; c < 3; c++) {
        state.p[0 + c] = loop_times(momentum.p[c], half, -exponent - 1); state.p[3 + c] = g.p[c];
        state.p[18 + c] = loop_times(tensor.p[c], power, -exponent);
    }
    real t_2 = state.p[19] + state.p[20], t_3 = state.p[18] + state.p[20], t_4 = state.p[18] + state.p[19];
    state.p[21] = t_2; state.p[22] = t_3; state.p[23] = t_4; state.p[24] = loop_times(contact, power, -exponent);
    t_r3 k1 = loop_three(state, 0), I1 = loop_three(state, 21);
    t_r2 t_5 = gibbs_certificate(k1.a0, k1.a1, k1.a2, I1.a0, I1.a1, I1.a2, state.p[24]); state.p[25] = t_5.a0;
    state.p[26] = t_5.a1;
    if (tiny || min_r(min_r(I1.a0, I1.a1), I1.a2) < gibbs_SMALLEST) { state.p[25] = R(-1.0); }
    return R(ldexp(R(1.0), (int)(exponent + 1)));
}

INLINE t_r2 pairs_split_product(real a, real b) {
    real product = a * b, t = pairs_SPLITTER * a, a_high = t - (t - a), a_low = a - a_high; t = pairs_SPLITTER * b;
    real b_high = t - (t - b), b_low = b - b_high;
    return (t_r2){product, a_high * b_high - product + a_high * b_low + a_low * b_high + a_low * b_low};
}

INLINE t_r2 pairs_two_sum(real a, real b) {
    real total = a + b, part = total - a; return (t_r2){total, a - (total - part) + (b - part)};
}

INLINE t_r2 integrals_inner(real a1, real a2, real a3, real b1, real b2, real b3, real high, real low) {
    t_r2 x = pairs_split_product(a1, b1), y = pairs_split_product(a2, b2), z = pairs_split_product(a3, b3);
    t_r2 t_1 = pairs_two_sum(x.a0, y.a0); real total = t_1.a0, e = t_1.a1; t_r2 t_2 = pairs_two_sum(total, z.a0);
    total = t_2.a0; real f = t_2.a1; t_r2 t_3 = pairs_two_sum(total, high); total = t_3.a0; real g = t_3.a1;
    return pairs_two_sum(total, e + f + (g + low) + (x.a1 + y.a1 + z.a1));
}

OUT_OF_LINE void integrals_remember(r1 state) {
    real k1 = state.p[0], k2 = state.p[1], k3 = state.p[2], g1 = state.p[3], g2 = state.p[4], g3 = state.p[5];
    t_r2 t_1 = integrals_inner(g1, g2, g3, g1, g2, g3, R(0.0), R(0.0)); state.p[12] = t_1.a0; state.p[13] = t_1.a1;
    t_r2 t_2 = integrals_inner(k1, k2, k3, g1, g2, g3, R(0.0), R(0.0)); state.p[14] = t_2.a0; state.p[15] = t_2.a1;
    t_r2 t_3 = integrals_inner(k1, k2, k3, k1, k2, k3, R(0.0), R(0.0)); state.p[16] = t_3.a0; state.p[17] = t_3.a1;
}

OUT_OF_LINE real loop_prepare(r1 momentum, r1 g, r1 tensor, real contact, r1 c, r1 state, r1 radius, r1 enough) {
    ALIGNED real part_[3]; r1 part = {part_, 3};
    for (int64_t i = 0, end_i = c.n0; i < end_i; i++) {
        if (c.p[i] != R(1.0)) {
            for (int64_t j = 0; j < 3; j++) { part.p[j] = c.p[i] * momentum.p[j]; }
            loop_scaled(part, g, tensor, contact, state); radius.p[i] = state.p[25]; enough.p[i] = state.p[26];
        }
    }
    real scale = loop_scaled(momentum, g, tensor, contact, state); integrals_remember(state);
    for (int64_t i = 0, end_i = c.n0; i < end_i; i++) {
        if (c.p[i] == R(1.0)) { radius.p[i] = state.p[25]; enough.p[i] = state.p[26]; }
    }
    return scale;
}

INLINE t_r3 loop_guessed(r2 past, int64_t at, r1 weights) {
    real u1 = R(0.0), u2 = R(0.0), u3 = R(0.0);
    for (int64_t j = 0, end_j = weights.n0; j < end_j; j++) {
        u1 = u1 + weights.p[j] * AT2(past, at + j, 0); u2 = u2 + weights.p[j] * AT2(past, at + j, 1);
        u3 = u3 + weights.p[j] * AT2(past, at + j, 2);
    }
    return (t_r3){u1, u2, u3};
}

INLINE t_r13 kernel_gibbs_newton_heavy(real u1, real u2, real u3, real k1, real k2, real k3, real g1, real g2, real
    g3, real I1, real I2, real I3, real D) {
    real w1 = D * g1, w2 = D * g2, w3 = D * g3, e11 = g1 * w1, e12 = g1 * w2, e13 = g1 * w3, e22 = g2 * w2;
    real e23 = g2 * w3, e33 = g3 * w3, t0 = u2 * u3, t1 = 1 - u1 * u1 - (u2 * u2 + u3 * u3), t2 = u1 * u3;
    real t3 = u1 * u2, r1 = I3 * t0 + k1 * t1 - I2 * t0, r2 = I1 * t2 + k2 * t1 - I3 * t2;
    real r3 = I2 * t3 + k3 * t1 - I1 * t3, t4 = 2 * k1, t5 = I3 * u3, t6 = I2 * u2, t7 = 2 * k2, t8 = I1 * u1;
    real t9 = 2 * k3, m11 = I1 - t4 * u1, m12 = t5 - I2 * u3 - t4 * u2, m13 = I3 * u2 - t6 - t4 * u3;
    real m21 = I1 * u3 - t5 - t7 * u1, m22 = I2 - t7 * u2, m23 = t8 - I3 * u1 - t7 * u3;
    real m31 = t6 - I1 * u2 - t9 * u1, m32 = I2 * u1 - t8 - t9 * u2, m33 = I3 - t9 * u3, a11 = e22 + e33 + m11;
    real a12 = m12 - e12, a13 = m13 - e13, a21 = m21 - e12, a22 = e11 + e33 + m22, a23 = m23 - e23, a31 = m31 - e13;
    real a32 = m32 - e23, a33 = e11 + e22 + m33, c11 = a22 * a33 - a23 * a32, c12 = a23 * a31 - a21 * a33;
    real c13 = a21 * a32 - a22 * a31, c21 = a13 * a32 - a12 * a33, c22 = a11 * a33 - a13 * a31;
    real c23 = a12 * a31 - a11 * a32, c31 = a12 * a23 - a13 * a22, c32 = a13 * a21 - a11 * a23;
    real c33 = a11 * a22 - a12 * a21, y1 = g1 * m11 + g2 * m21 + g3 * m31, y2 = g1 * m12 + g2 * m22 + g3 * m32;
    real y3 = g1 * m13 + g2 * m23 + g3 * m33, z1 = c11 * g1 + c21 * g2 + c31 * g3;
    real z2 = c12 * g1 + c22 * g2 + c32 * g3, z3 = c13 * g1 + c23 * g2 + c33 * g3;
    real o_det = (y1 * z1 + y2 * z2 + y3 * z3) / (g1 * g1 + g2 * g2 + g3 * g3);
    real o_N1 = c11 * r1 + c21 * r2 + c31 * r3, o_N2 = c12 * r1 + c22 * r2 + c32 * r3;
    real o_N3 = c13 * r1 + c23 * r2 + c33 * r3, o_C11 = c11, o_C12 = c12, o_C13 = c13, o_C21 = c21, o_C22 = c22;
    real o_C23 = c23, o_C31 = c31, o_C32 = c32, o_C33 = c33;
    return (t_r13){o_det, o_N1, o_N2, o_N3, o_C11, o_C12, o_C13, o_C21, o_C22, o_C23, o_C31, o_C32, o_C33};
}

INLINE t_r13 kernel_gibbs_newton(real u1, real u2, real u3, real k1, real k2, real k3, real g1, real g2, real g3, real
    I1, real I2, real I3, real D) {
    real w1 = D * g1, w2 = D * g2, w3 = D * g3, e11 = g1 * w1, e12 = g1 * w2, e13 = g1 * w3, e22 = g2 * w2;
    real e23 = g2 * w3, e33 = g3 * w3, t0 = u2 * u3, t1 = 1 - u1 * u1 - (u2 * u2 + u3 * u3), t2 = u1 * u3;
    real t3 = u1 * u2, r1 = I3 * t0 + k1 * t1 - I2 * t0, r2 = I1 * t2 + k2 * t1 - I3 * t2;
    real r3 = I2 * t3 + k3 * t1 - I1 * t3, t4 = 2 * k1, t5 = I3 * u3, t6 = I2 * u2, t7 = 2 * k2, t8 = I1 * u1;
    real t9 = 2 * k3, m11 = I1 - t4 * u1, m12 = t5 - I2 * u3 - t4 * u2, m13 = I3 * u2 - t6 - t4 * u3;
    real m21 = I1 * u3 - t5 - t7 * u1, m22 = I2 - t7 * u2, m23 = t8 - I3 * u1 - t7 * u3;
    real m31 = t6 - I1 * u2 - t9 * u1, m32 = I2 * u1 - t8 - t9 * u2, m33 = I3 - t9 * u3, a11 = e22 + e33 + m11;
    real a12 = m12 - e12, a13 = m13 - e13, a21 = m21 - e12, a22 = e11 + e33 + m22, a23 = m23 - e23, a31 = m31 - e13;
    real a32 = m32 - e23, a33 = e11 + e22 + m33, c11 = a22 * a33 - a23 * a32, c12 = a23 * a31 - a21 * a33;
    real c13 = a21 * a32 - a22 * a31, c21 = a13 * a32 - a12 * a33, c22 = a11 * a33 - a13 * a31;
    real c23 = a12 * a31 - a11 * a32, c31 = a12 * a23 - a13 * a22, c32 = a13 * a21 - a11 * a23;
    real c33 = a11 * a22 - a12 * a21, o_det = a11 * c11 + a12 * c12 + a13 * c13;
    real o_N1 = c11 * r1 + c21 * r2 + c31 * r3, o_N2 = c12 * r1 + c22 * r2 + c32 * r3;
    real o_N3 = c13 * r1 + c23 * r2 + c33 * r3, o_C11 = c11, o_C12 = c12, o_C13 = c13, o_C21 = c21, o_C22 = c22;
    real o_C23 = c23, o_C31 = c31, o_C32 = c32, o_C33 = c33;
    return (t_r13){o_det, o_N1, o_N2, o_N3, o_C11, o_C12, o_C13, o_C21, o_C22, o_C23, o_C31, o_C32, o_C33};
}

INLINE Round gibbs_newton_round(real u1, real u2, real u3, real k1, real k2, real k3, real g1, real g2, real g3, real
    I1, real I2, real I3, real D, int heavy) {
    real p0, p1, p2, p3, c11, c12, c13, c21, c22, c23, c31, c32, c33;
    if (heavy) {
        t_r13 t_1 = kernel_gibbs_newton_heavy(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D); p0 = t_1.a0;
        p1 = t_1.a1; p2 = t_1.a2; p3 = t_1.a3; c11 = t_1.a4; c12 = t_1.a5; c13 = t_1.a6; c21 = t_1.a7; c22 = t_1.a8;
        c23 = t_1.a9; c31 = t_1.a10; c32 = t_1.a11; c33 = t_1.a12;
    }
    else {
        t_r13 t_2 = kernel_gibbs_newton(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D); p0 = t_2.a0; p1 = t_2.a1;
        p2 = t_2.a2; p3 = t_2.a3; c11 = t_2.a4; c12 = t_2.a5; c13 = t_2.a6; c21 = t_2.a7; c22 = t_2.a8; c23 = t_2.a9;
        c31 = t_2.a10; c32 = t_2.a11; c33 = t_2.a12;
    }
    real scale = R(1.0) / p0, w1 = p1 * scale, w2 = p2 * scale, w3 = p3 * scale, d1 = w1 - u1, d2 = w2 - u2;
    real d3 = w3 - u3, first = d1 * d1 + (d2 * d2 + d3 * d3);
    return (Round){p0, p1, p2, p3, w1, w2, w3, first, d1, d2, d3, c11, c12, c13, c21, c22, c23, c31, c32, c33};
}

INLINE t_r3 kernel_gibbs_second(real d1, real d2, real d3, real k1, real k2, real k3, real c11, real c12, real c13,
    real c21, real c22, real c23, real c31, real c32, real c33, real I1, real I2, real I3) {
    real t0 = d1 * d1 + d2 * d2 + d3 * d3, r1 = I3 * d2 * d3 - k1 * t0 - I2 * d2 * d3;
    real r2 = I1 * d1 * d3 - k2 * t0 - I3 * d1 * d3, r3 = I2 * d1 * d2 - k3 * t0 - I1 * d1 * d2;
    real o_e1 = c11 * r1 + c21 * r2 + c31 * r3, o_e2 = c12 * r1 + c22 * r2 + c32 * r3;
    real o_e3 = c13 * r1 + c23 * r2 + c33 * r3; return (t_r3){o_e1, o_e2, o_e3};
}

INLINE t_r7 gibbs_second_round(Round r, real k1, real k2, real k3, real I1, real I2, real I3) {
    t_r3 e1 = kernel_gibbs_second(r.d1, r.d2, r.d3, k1, k2, k3, r.c11, r.c12, r.c13, r.c21, r.c22, r.c23, r.c31,
        r.c32, r.c33, I1, I2, I3);
    real scale = R(1.0) / r.p0, p1 = r.p1 - e1.a0, p2 = r.p2 - e1.a1, p3 = r.p3 - e1.a2;
    real second = (e1.a0 * e1.a0 + (e1.a1 * e1.a1 + e1.a2 * e1.a2)) * (scale * scale);
    return (t_r7){p1, p2, p3, p1 * scale, p2 * scale, p3 * scale, second};
}

INLINE t_br7 gibbs_settle(real u1, real u2, real u3, real k1, real k2, real k3, real g1, real g2, real g3, real I1,
    real I2, real I3, real D, real radius, real enough, int heavy) {
    if (!(u1 * u1 + (u2 * u2 + u3 * u3) <= radius)) { return (t_br7){0, R(1.0), R(0.0), R(0.0), R(0.0), u1, u2, u3}; }
    Round r = gibbs_newton_round(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D, heavy);
    if (r.first <= enough) { return (t_br7){1, r.p0, r.p1, r.p2, r.p3, r.w1, r.w2, r.w3}; }
    t_r7 p1 = gibbs_second_round(r, k1, k2, k3, I1, I2, I3);
    int settled = R(9.0) * max_r(r.first, p1.a6) * p1.a6 <= enough * enough && p1.a3 * p1.a3 + (p1.a4 * p1.a4 + p1.a5
        * p1.a5) <= radius;
    return (t_br7){settled, r.p0, p1.a0, p1.a1, p1.a2, p1.a3, p1.a4, p1.a5};
}

INLINE void loop_put(r1 array, int64_t at, real x, real y, real z) {
    array.p[at] = x; array.p[at + 1] = y; array.p[at + 2] = z;
}

INLINE t_r8b2 path_improved(real u1, real u2, real u3, real k1, real k2, real k3, real g1, real g2, real g3, real I1,
    real I2, real I3, real D) {
    Round r = gibbs_newton_round(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D, 0);
    t_r7 p1 = gibbs_second_round(r, k1, k2, k3, I1, I2, I3);
    real square = p1.a3 * p1.a3 + (p1.a4 * p1.a4 + p1.a5 * p1.a5);
    real curved = R(6.0) * (R(0.5) * (max_r(max_r(I1, I2), I3) - min_r(min_r(I1, I2), I3)) + R(sqrt(k1 * k1 + (k2 * k2
        + k3 * k3))));
    real left = curved * curved * (max_r(r.first, p1.a6) * p1.a6);
    real allowed = gibbs_LEFT * (R(0.0625) * (max_r(max_r(I1, I2), I3) + D));
    return (t_r8b2){r.p0, p1.a0, p1.a1, p1.a2, p1.a3, p1.a4, p1.a5, left, left <= allowed * allowed * square, p1.a6 <=
        R(1e-26) * square};
}

INLINE t_r3 kernel_gibbs_symmetric(real u1, real u2, real u3, real k1, real k2, real k3, real g1, real g2, real g3,
    real I1, real I2, real I3, real D) {
    real t0 = D * g2 * g2, t1 = D * g3 * g3, t2 = D * g1, t3 = D * g1 * g1, e11 = I1 + t0 + (t1 - 2 * k1 * u1);
    real e12 = I1 * u3 / 2 - I2 * u3 / 2 - g2 * t2 - (k1 * u2 + k2 * u1);
    real e13 = I3 * u2 / 2 - I1 * u2 / 2 - g3 * t2 - (k1 * u3 + k3 * u1), e22 = I2 + t1 + (t3 - 2 * k2 * u2);
    real e23 = I2 * u1 / 2 - I3 * u1 / 2 - k2 * u3 - (k3 * u2 + D * g2 * g3), e33 = I3 + t0 + (t3 - 2 * k3 * u3);
    real t4 = e22 * e33 - e23 * e23, o_trace = e11 + e22 + e33;
    real o_minors = t4 + e11 * e22 + e11 * e33 - (e12 * e12 + e13 * e13);
    real o_det = e11 * t4 + e12 * (e13 * e23 - e12 * e33) + e13 * (e12 * e23 - e13 * e22);
    return (t_r3){o_trace, o_minors, o_det};
}

INLINE real path_lowest(real trace, real minors, real det) {
    real value, slope; int positive = ((trace > R(0.0)) & (minors > R(0.0))) & (det > R(0.0));
    real x = positive ? det / minors : R(-1.0);
    for (int64_t i_0 = 0; i_0 < 2; i_0++) {
        value = ((x - trace) * x + minors) * x - det; slope = (R(3.0) * x - R(2.0) * trace) * x + minors;
        x = (positive & (slope > R(0.0))) ? x - value / slope : x;
    }
    return x;
}

INLINE int path_small_between(real a, real b, real most, real square, real c, real along, real across, real half, real
    slope, real sag, real first, real last) {
    real start = square * (R(1.0) + a) - c * (R(1.0) + a * a * square) - along;
    real end = square * (R(1.0) + b) - c * (R(1.0) + b * b * square) - along;
    real r = max_r(R(fabs(start)), R(fabs(end))) + R(0.25) * (b - a) * (b - a) * c * square;
    real m = min_r((R(1.0) - a) * first + a * last, (R(1.0) - b) * first + b * last) - most * sag;
    real left = R(4.0) * slope * most;
    return (m > R(0.0)) & (left * left * (half * half * (r * r) + across) < R(0.98) * (m * m) * (m * m));
}

INLINE t_br path_joined(real u1, real u2, real u3, real square, real k1, real k2, real k3, real half, real g1, real
    g2, real g3, real I1, real I2, real I3, real D, real spread) {
    real none = R(0.0) * u1;
    t_r3 t_1 = kernel_gibbs_symmetric(none, none, none, k1, k2, k3, g1, g2, g3, I1, I2, I3, D);
    real first = path_lowest(t_1.a0, t_1.a1, t_1.a2);
    t_r3 t_2 = kernel_gibbs_symmetric(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D);
    real last = path_lowest(t_2.a0, t_2.a1, t_2.a2), x1 = I3 * u2 * u3 - I2 * u2 * u3;
    real x2 = I1 * u1 * u3 - I3 * u1 * u3, x3 = I2 * u1 * u2 - I1 * u1 * u2;
    real along = (x1 * k1 + (x2 * k2 + x3 * k3)) / (half * half);
    real across = max_r(x1 * x1 + (x2 * x2 + x3 * x3) - along * along * (half * half), R(0.0));
    real c = max_r(R(0.0), min_r(R(1.0), (square * R(1.75) - along) / (R(1.0) + R(0.5625) * square)));
    real sag = half * R(sqrt(square)) - (k1 * u1 + (k2 * u2 + k3 * u3)), slope = spread + R(2.0) * half;
    int proved = (first > R(0.0)) & (last > R(0.0));
    proved = proved & path_small_between(R(0.0), R(0.4), R(0.24), square, c, along, across, half, slope, sag, first,
        last);
    proved = proved & path_small_between(R(0.4), R(0.65), R(0.25), square, c, along, across, half, slope, sag, first,
        last);
    proved = proved & path_small_between(R(0.65), R(0.85), R(0.2275), square, c, along, across, half, slope, sag,
        first, last);
    proved = proved & path_small_between(R(0.85), R(1.0), R(0.1275), square, c, along, across, half, slope, sag,
        first, last);
    return (t_br){proved, last};
}

INLINE int path_proved(real u1, real u2, real u3, real left, real k1, real k2, real k3, real g1, real g2, real g3,
    real I1, real I2, real I3, real D) {
    real half = R(sqrt(k1 * k1 + (k2 * k2 + k3 * k3)));
    real spread = R(0.5) * (max_r(max_r(I1, I2), I3) - min_r(min_r(I1, I2), I3));
    real square = u1 * u1 + (u2 * u2 + u3 * u3);
    t_br reached = path_joined(u1, u2, u3, square, k1, k2, k3, half, g1, g2, g3, I1, I2, I3, D, spread);
    real allowed = gibbs_LEFT * reached.a1; return reached.a0 & (left <= allowed * allowed * square);
}

INLINE t_br7 path_search_on_path(real u1, real u2, real u3, real k1, real k2, real k3, real g1, real g2, real g3, real
    I1, real I2, real I3, real D) {
    real p0, p1, p2, p3, left; int near, found;
    Round r = gibbs_newton_round(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D, 0); u1 = r.w1; u2 = r.w2;
    u3 = r.w3;
    for (int64_t i_0 = 0; i_0 < 6; i_0++) {
        t_r8b2 t_1 = path_improved(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D); p0 = t_1.a0; p1 = t_1.a1;
        p2 = t_1.a2; p3 = t_1.a3; u1 = t_1.a4; u2 = t_1.a5; u3 = t_1.a6; left = t_1.a7; near = t_1.a8; found = t_1.a9;
        if ((near || found) && path_proved(u1, u2, u3, left, k1, k2, k3, g1, g2, g3, I1, I2, I3, D)) {
            return (t_br7){1, p0, p1, p2, p3, u1, u2, u3};
        }
        if (found) { break; }
    }
    return (t_br7){0, R(1.0), R(0.0), R(0.0), R(0.0), u1, u2, u3};
}

INLINE t_br7 gibbs_search(real u1, real u2, real u3, real k1, real k2, real k3, real g1, real g2, real g3, real I1,
    real I2, real I3, real D, real radius, real enough, int heavy) {
    int settled; real p0, p1, p2, p3;
    for (int64_t guess = 0; guess < 2; guess++) {
        if (guess == 1) { u1 = R(0.0); u2 = R(0.0); u3 = R(0.0); }
        for (int64_t i_1 = 0; i_1 < 12; i_1++) {
            t_br7 t_1 = gibbs_settle(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D, radius, enough, heavy);
            settled = t_1.a0; p0 = t_1.a1; p1 = t_1.a2; p2 = t_1.a3; p3 = t_1.a4; u1 = t_1.a5; u2 = t_1.a6;
            u3 = t_1.a7;
            if (settled) { return (t_br7){1, p0, p1, p2, p3, u1, u2, u3}; }
        }
    }
    return (t_br7){0, R(1.0), R(0.0), R(0.0), R(0.0), u1, u2, u3};
}

INLINE t_br7 gibbs_search_safely(real u1, real u2, real u3, real k1, real k2, real k3, real g1, real g2, real g3, real
    I1, real I2, real I3, real D, real radius, real enough) {
    t_ri size; int heavy = gibbs_is_heavy(I1, I2, I3, D);
    if (heavy && max_r(max_r(R(fabs(k1)), R(fabs(k2))), R(fabs(k3))) < min_r(min_r(I1, I2), I3)) {
        size = real_frexp(max_r(max_r(I1, I2), I3) + D); I1 = R(ldexp(I1, (int)-size.a1));
        I2 = R(ldexp(I2, (int)-size.a1)); I3 = R(ldexp(I3, (int)-size.a1)); D = R(ldexp(D, (int)-size.a1));
        k1 = R(ldexp(k1, (int)-size.a1)); k2 = R(ldexp(k2, (int)-size.a1)); k3 = R(ldexp(k3, (int)-size.a1));
        if (min_r(min_r(I1, I2), I3) >= gibbs_LIGHTEST && max_r(max_r(R(fabs(k1)), R(fabs(k2))), R(fabs(k3))) >=
            gibbs_LIGHTEST) {
            t_r2 t_1 = gibbs_bound(k1, k2, k3, I1, I2, I3, D); radius = t_1.a0; enough = t_1.a1;
        }
    }
    if (!(radius >= R(0.0))) { return (t_br7){0, R(1.0), R(0.0), R(0.0), R(0.0), u1, u2, u3}; }
    return gibbs_search(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D, radius, enough, heavy);
}

#ifndef SINGLE
INLINE t_r9 kernel_tangent_jacobian(real q0, real q1, real q2, real q3, real g1, real g2, real g3, real J1, real J2,
    real J3, real D) {
    real t0 = q0 * q0, t1 = g2 * g2, t2 = g3 * g3, t3 = J2 + J3 + D * (t1 + t2), t4 = 2 * t3, t5 = 2 * D * g1;
    real t6 = g2 * t5, t7 = q0 * t6, t8 = -J3, t9 = J2 + t8, t10 = 2 * q3 * t9 - t7, t11 = g3 * t5, t12 = q0 * t11;
    real t13 = 2 * q2 * t9 - t12, t14 = 2 * q1 * t3 - q2 * t6 - q3 * t11, t15 = q0 * t4, t16 = g1 * g1;
    real t17 = J1 + J3 + D * (t16 + t2), t18 = 2 * t17, t19 = q0 * t18, t20 = 2 * J1 + 2 * t8, t21 = -t7 - q3 * t20;
    real t22 = 2 * D * g2 * g3, t23 = q0 * t22, t24 = -t23 - q1 * t20, t25 = 2 * q2 * t17 - q1 * t6 - q3 * t22;
    real t26 = J1 + J2 + D * (t1 + t16), t27 = 2 * t26, t28 = q0 * t27, t29 = J1 - J2, t30 = 2 * q2 * t29 - t12;
    real t31 = 2 * q1 * t29 - t23, t32 = 2 * q3 * t26 - q1 * t11 - q2 * t22;
    real o_dK11 = q3 * t10 + t0 * t4 - (q1 * t14 + q2 * t13), o_dK12 = q0 * t10 + q1 * t13 - (q2 * t14 + q3 * t15);
    real o_dK13 = q0 * t13 + q2 * t15 - (q1 * t10 + q3 * t14), o_dK21 = q0 * t21 + q3 * t19 - (q1 * t25 + q2 * t24);
    real o_dK22 = q1 * t24 + t0 * t18 - (q2 * t25 + q3 * t21), o_dK23 = q0 * t24 + q2 * t21 - (q1 * t19 + q3 * t25);
    real o_dK31 = q0 * t30 + q3 * t31 - (q1 * t32 + q2 * t28), o_dK32 = q0 * t31 + q1 * t28 - (q2 * t32 + q3 * t30);
    real o_dK33 = q2 * t30 + t0 * t27 - (q1 * t31 + q3 * t32);
    return (t_r9){o_dK11, o_dK12, o_dK13, o_dK21, o_dK22, o_dK23, o_dK31, o_dK32, o_dK33};
}

INLINE t_r10 branch_inverse_of(real a11, real a12, real a13, real a21, real a22, real a23, real a31, real a32, real
    a33) {
    real c11 = a22 * a33 - a23 * a32, c12 = a23 * a31 - a21 * a33, c13 = a21 * a32 - a22 * a31;
    real c21 = a13 * a32 - a12 * a33, c22 = a11 * a33 - a13 * a31, c23 = a12 * a31 - a11 * a32;
    real c31 = a12 * a23 - a13 * a22, c32 = a13 * a21 - a11 * a23, c33 = a11 * a22 - a12 * a21;
    real det = a11 * c11 + a12 * c12 + a13 * c13;
    if (det == R(0.0)) {
        return (t_r10){R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0)};
    }
    real s = R(1.0) / det;
    return (t_r10){det, c11 * s, c21 * s, c31 * s, c12 * s, c22 * s, c32 * s, c13 * s, c23 * s, c33 * s};
}

INLINE t_r10 branch_inverse(real q0, real q1, real q2, real q3, real g1, real g2, real g3, real J1, real J2, real J3,
    real D) {
    t_r9 t_1 = kernel_tangent_jacobian(q0, q1, q2, q3, g1, g2, g3, J1, J2, J3, D);
    real a11 = t_1.a0, a12 = t_1.a1, a13 = t_1.a2, a21 = t_1.a3, a22 = t_1.a4, a23 = t_1.a5, a31 = t_1.a6;
    real a32 = t_1.a7, a33 = t_1.a8; t_r10 det = branch_inverse_of(a11, a12, a13, a21, a22, a23, a31, a32, a33);
    if (det.a0 == R(0.0) || !gibbs_is_heavy(J2 + J3, J1 + J3, J1 + J2, D)) {
        return (t_r10){det.a0, det.a1, det.a2, det.a3, det.a4, det.a5, det.a6, det.a7, det.a8, det.a9};
    }
    t_r9 t_2 = kernel_tangent_jacobian(q0, q1, q2, q3, g1, g2, g3, J1, J2, J3, R(0.0) * D); a11 = t_2.a0;
    a12 = t_2.a1; a13 = t_2.a2; a21 = t_2.a3; a22 = t_2.a4; a23 = t_2.a5; a31 = t_2.a6; a32 = t_2.a7; a33 = t_2.a8;
    real y1 = g1 * a11 + g2 * a21 + g3 * a31, y2 = g1 * a12 + g2 * a22 + g3 * a32;
    real y3 = g1 * a13 + g2 * a23 + g3 * a33, z1 = det.a1 * g1 + det.a2 * g2 + det.a3 * g3;
    real z2 = det.a4 * g1 + det.a5 * g2 + det.a6 * g3, z3 = det.a7 * g1 + det.a8 * g2 + det.a9 * g3;
    real true = (y1 * z1 + y2 * z2 + y3 * z3) / (g1 * g1 + g2 * g2 + g3 * g3);
    if (true == R(0.0)) {
        return (t_r10){R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0)};
    }
    real s = R(1.0) / true;
    return (t_r10){det.a0 * true, s * det.a1, s * det.a2, s * det.a3, s * det.a4, s * det.a5, s * det.a6, s * det.a7,
        s * det.a8, s * det.a9};
}

INLINE t_r18 kernel_tangent_hessian(real q0, real q1, real q2, real q3, real g1, real g2, real g3, real J1, real J2,
    real J3, real D) {
    real t0 = q0 * q1, t1 = J3 * t0, t2 = q2 * q3, t3 = J3 * t2, t4 = J2 * t0 + J2 * t2, t5 = g3 * q2, t6 = g1 * t5;
    real t7 = g2 * g2, t8 = q0 * t7, t9 = g3 * g3, t10 = q0 * t9, t11 = g1 * g2, t12 = q3 * t11, t13 = 4 * D;
    real t14 = q1 * t13, t15 = q1 * q3, t16 = J1 * t15, t17 = q0 * q2, t18 = J3 * t15 + J3 * t17;
    real t19 = 4 * J1 * q0 * q2 - 4 * t16 - 4 * t18, t20 = g1 * g1, t21 = q3 * t20, t22 = q3 * t9, t23 = q1 * q2;
    real t24 = J2 * t23, t25 = q0 * q3, t26 = J2 * t25, t27 = J1 * t23 + J1 * t25, t28 = 4 * t24 + 4 * t27 - 4 * t26;
    real t29 = g1 * g3, t30 = g2 * g3, t31 = q2 * t20, t32 = q2 * t7, t33 = 4 * t3 + 4 * t4 - 4 * t1, t34 = q3 * t7;
    real t35 = q2 * t13, t36 = q0 * t20, t37 = q1 * t30, t38 = q1 * t20, t39 = q2 * t9, t40 = q3 * t13;
    real t41 = q0 * q0, t42 = J2 * t41, t43 = q1 * q1, t44 = J3 * t43, t45 = q2 * q2, t46 = J2 * t45, t47 = J3 * t45;
    real t48 = q3 * q3, t49 = J3 * t48 - J3 * t41, t50 = J2 * t48 - J2 * t43, t51 = t11 * t25, t52 = t17 * t29;
    real t53 = t15 * t29, t54 = t11 * t23, t55 = t48 * t9, t56 = t45 * t7, t57 = 2 * D, t58 = 4 * J3, t59 = q3 * t10;
    real t60 = q1 * t39 - t11 * t48, t61 = 4 * J2, t62 = q2 * t8, t63 = q1 * t34 - t29 * t45, t64 = J1 * t48;
    real t65 = J1 * t45, t66 = J1 * t41 - J1 * t43, t67 = t0 * t30, t68 = t2 * t30, t69 = t20 * t43, t70 = 4 * J1;
    real t71 = q2 * t21 - t30 * t43, o_ddK11_1 = 4 * t3 - 4 * t1 - (4 * t4 + t14 * (t10 + t6 + (t8 - t12)));
    real o_ddK11_2 = t19 + t14 * (g1 * g2 * q0 - t21 - (t22 + g2 * t5));
    real o_ddK11_3 = t28 + t14 * (t31 + t32 + (q0 * t29 + q3 * t30));
    real o_ddK22_1 = t33 + t35 * (t22 + t34 + (q0 * t11 + q1 * t29));
    real o_ddK22_2 = 4 * t16 - 4 * t18 - (4 * J1 * t17 + t35 * (t10 + t12 + (t36 - t37)));
    real o_ddK22_3 = t35 * (g2 * g3 * q0 - t38 - (q1 * t7 + q3 * t29)) - t28;
    real o_ddK33_1 = t40 * (g1 * g3 * q0 - t32 - (t39 + q1 * t11)) - t33;
    real o_ddK33_2 = t40 * (t38 + q0 * t30 + (q1 * t9 + q2 * t11)) - t19;
    real o_ddK33_3 = 4 * t24 - 4 * t26 - (4 * t27 + t40 * (t36 + t37 + (t8 - t6)));
    real o_ddK23_1 = 2 * t42 + 2 * t44 + (2 * t49 + 2 * t50) + (t57 * (t51 + t52 + (t53 + t55) + (t48 * t7 - t54 -
        (t56 + t45 * t9))) - 2 * t46 - 2 * t47);
    real o_ddK23_2 = t57 * (t60 + q1 * t31 + (t11 * t45 + t15 * t30) + (t17 * t30 - t59 - q0 * t21)) - t58 * (t25 -
        t23);
    real o_ddK23_3 = -t57 * (t62 + t63 + (q0 * t31 + q1 * t21) + (t23 * t30 + t29 * t48 - t25 * t30)) - t61 * (t15 +
        t17);
    real o_ddK13_1 = t57 * (g1 * g3 * q0 * q1 - t59 - (t60 + q1 * t32) - (q3 * t8 + t11 * t43 + t2 * t29)) - t58 *
        (t23 + t25);
    real o_ddK13_2 = 2 * t44 + 2 * t65 + (t57 * (t51 + t54 + (t67 + t69) + (t43 * t9 - t55 - (t68 + t20 * t48))) - 2 *
        t47) - (2 * t49 + 2 * t64 + 2 * t66);
    real o_ddK13_3 = -t57 * (q0 * q1 * t20 + q0 * q1 * t7 - (t71 + q3 * t32) - (t23 * t29 + t25 * t29 + t30 * t48)) -
        t70 * (t0 - t2);
    real o_ddK12_1 = t57 * (t63 + q1 * t22 + (t0 * t11 + t11 * t2) + (t29 * t43 - t62 - q2 * t10)) - t61 * (t17 -
        t15);
    real o_ddK12_2 = -t57 * (t71 + q1 * t10 + (q1 * t36 + q2 * t22) + (t11 * t15 + t30 * t45 - t11 * t17)) - t70 * (t0
        + t2);
    real o_ddK12_3 = 2 * t46 + 2 * t50 + (2 * t65 + 2 * t66) + (t57 * (t52 + t56 + (t67 + t68) + (t20 * t45 - t53 -
        (t69 + t43 * t7))) - 2 * t42 - 2 * t64);
    return (t_r18){o_ddK11_1, o_ddK11_2, o_ddK11_3, o_ddK22_1, o_ddK22_2, o_ddK22_3, o_ddK33_1, o_ddK33_2, o_ddK33_3,
        o_ddK23_1, o_ddK23_2, o_ddK23_3, o_ddK13_1, o_ddK13_2, o_ddK13_3, o_ddK12_1, o_ddK12_2, o_ddK12_3};
}

INLINE t_r6 branch_tangent(real q0, real q1, real q2, real q3, real K1, real K2, real K3, real g1, real g2, real g3,
    real J1, real J2, real J3, real D) {
    real x, y, z, a, b, c, weight; t_r10 det = branch_inverse(q0, q1, q2, q3, g1, g2, g3, J1, J2, J3, D);
    t_r18 t_1 = kernel_tangent_hessian(q0, q1, q2, q3, g1, g2, g3, J1, J2, J3, D);
    real h_[] = {t_1.a0, t_1.a1, t_1.a2, t_1.a3, t_1.a4, t_1.a5, t_1.a6, t_1.a7, t_1.a8, t_1.a9, t_1.a10, t_1.a11,
        t_1.a12, t_1.a13, t_1.a14, t_1.a15, t_1.a16, t_1.a17};
    r1 h = {h_, 18}; real bend = R(0.0);
    for (int64_t pair = 0; pair < 6; pair++) {
        x = h.p[3 * pair]; y = h.p[3 * pair + 1]; z = h.p[3 * pair + 2]; a = det.a1 * x + det.a2 * y + det.a3 * z;
        b = det.a4 * x + det.a5 * y + det.a6 * z; c = det.a7 * x + det.a8 * y + det.a9 * z;
        weight = pair < 3 ? R(1.0) : R(2.0); bend = bend + weight * (a * a + b * b + c * c);
    }
    real d1 = det.a1 * K1 + det.a2 * K2 + det.a3 * K3, d2 = det.a4 * K1 + det.a5 * K2 + det.a6 * K3;
    real d3 = det.a7 * K1 + det.a8 * K2 + det.a9 * K3;
    return (t_r6){det.a0, R(sqrt(d1 * d1 + d2 * d2 + d3 * d3)), R(sqrt(bend)), d1, d2, d3};
}

#endif
INLINE t_r4 kernel_compose(real a0, real a1, real a2, real a3, real b0, real b1, real b2, real b3) {
    real o_c0 = a0 * b0 - a1 * b1 - (a2 * b2 + a3 * b3), o_c1 = a0 * b1 + a1 * b0 + (a2 * b3 - a3 * b2);
    real o_c2 = a0 * b2 + a2 * b0 + (a3 * b1 - a1 * b3), o_c3 = a0 * b3 + a1 * b2 + (a3 * b0 - a2 * b1);
    return (t_r4){o_c0, o_c1, o_c2, o_c3};
}

#ifndef SINGLE
INLINE t_r4 branch_turned(real q0, real q1, real q2, real q3, real w1, real w2, real w3) {
    t_r4 p0 = kernel_compose(q0, q1, q2, q3, R(1.0), w1, w2, w3);
    real length = R(sqrt(p0.a0 * p0.a0 + p0.a1 * p0.a1 + p0.a2 * p0.a2 + p0.a3 * p0.a3));
    return (t_r4){p0.a0 / length, p0.a1 / length, p0.a2 / length, p0.a3 / length};
}

INLINE t_r3 kernel_residual(real q0, real q1, real q2, real q3, real K1, real K2, real K3, real g1, real g2, real g3,
    real J1, real J2, real J3, real D) {
    real c1 = g3 * q2 - g2 * q3, c2 = g1 * q3 - g3 * q1, c3 = g2 * q1 - g1 * q2, f1 = D * c1, f2 = D * c2;
    real f3 = D * c3, t0 = -J3, t1 = 2 * q3, t2 = 2 * q0;
    real o_r1 = t2 * (f3 * g2 + q1 * (J2 + J3) - f2 * g3) + q2 * t1 * (J2 + t0) - K1;
    real o_r2 = 2 * q0 * (f1 * g3 + q2 * (J1 + J3) - f3 * g1) - K2 - q1 * t1 * (J1 + t0);
    real o_r3 = t2 * (f2 * g1 + q3 * (J1 + J2) - f1 * g2) + 2 * q1 * q2 * (J1 - J2) - K3;
    return (t_r3){o_r1, o_r2, o_r3};
}

INLINE t_br4 branch_corrected(real q0, real q1, real q2, real q3, real K1, real K2, real K3, real g1, real g2, real
    g3, real J1, real J2, real J3, real D) {
    t_r3 r1; t_r10 det; real w1, w2, w3, change, extent, largest, noise;
    real size = max_r(max_r(R(fabs(K1)), R(fabs(K2))), R(fabs(K3)));
    real top = max_r(max_r(J2 + J3, J1 + J3), J1 + J2) + D, before = R(2.0);
    for (int64_t i_0 = 0; i_0 < 20; i_0++) {
        r1 = kernel_residual(q0, q1, q2, q3, K1, K2, K3, g1, g2, g3, J1, J2, J3, D);
        det = branch_inverse(q0, q1, q2, q3, g1, g2, g3, J1, J2, J3, D);
        if (det.a0 == R(0.0)) { return (t_br4){0, q0, q1, q2, q3}; }
        w1 = -(det.a1 * r1.a0 + det.a2 * r1.a1 + det.a3 * r1.a2);
        w2 = -(det.a4 * r1.a0 + det.a5 * r1.a1 + det.a6 * r1.a2);
        w3 = -(det.a7 * r1.a0 + det.a8 * r1.a1 + det.a9 * r1.a2);
        t_r4 t_1 = branch_turned(q0, q1, q2, q3, w1, w2, w3); q0 = t_1.a0; q1 = t_1.a1; q2 = t_1.a2; q3 = t_1.a3;
        change = max_r(max_r(R(fabs(w1)), R(fabs(w2))), R(fabs(w3)));
        extent = max_r(max_r(R(fabs(q1)), R(fabs(q2))), R(fabs(q3)));
        largest = max_r(max_r(max_r(max_r(max_r(max_r(max_r(max_r(R(fabs(det.a1)), R(fabs(det.a2))), R(fabs(det.a3))),
            R(fabs(det.a4))), R(fabs(det.a5))), R(fabs(det.a6))), R(fabs(det.a7))), R(fabs(det.a8))),
            R(fabs(det.a9)));
        noise = R(1.7763568394002505e-15) * largest * (size + R(2.0) * top * extent);
        if (change <= max_r(R(1e-09) * extent, R(8e-323))) { return (t_br4){1, q0, q1, q2, q3}; }
        if (change <= noise && change >= R(0.25) * before) { return (t_br4){1, q0, q1, q2, q3}; }
        before = change;
    }
    return (t_br4){0, q0, q1, q2, q3};
}

INLINE t_ir5 branch_continued(real K1, real K2, real K3, real g1, real g2, real g3, real J1, real J2, real J3, real D,
    real shortest) {
    t_r6 det; real slope, length, remaining, step, ahead, p0, p1, p2, p3; int settled;
    if (K1 != K1 || K2 != K2 || K3 != K3) { return (t_ir5){2, R(0.0), R(1.0), R(0.0), R(0.0), R(0.0)}; }
    t_ri exponent = real_frexp(max_r(max_r(J2 + J3, J1 + J3), J1 + J2) + D); J1 = R(ldexp(J1, (int)-exponent.a1));
    J2 = R(ldexp(J2, (int)-exponent.a1)); J3 = R(ldexp(J3, (int)-exponent.a1)); D = R(ldexp(D, (int)-exponent.a1));
    real largest = max_r(max_r(R(fabs(K1)), R(fabs(K2))), R(fabs(K3))); t_ri size = real_frexp(largest);
    int64_t shift = largest > R(0.0) ? min_i(-exponent.a1, 3 - size.a1) : -exponent.a1;
    int64_t beyond = largest > R(0.0) ? max_i(0, -200 - (size.a1 + shift)) : 0;
    K1 = R(ldexp(K1, (int)(shift + beyond))); K2 = R(ldexp(K2, (int)(shift + beyond)));
    K3 = R(ldexp(K3, (int)(shift + beyond)));
    real end = R(ldexp(R(1.0), (int)(shift + exponent.a1))), t = R(0.0), q0 = R(1.0), q1 = R(0.0), q2 = R(0.0);
    real q3 = R(0.0);
    for (int64_t i_0 = 0; i_0 < 20000; i_0++) {
        det = branch_tangent(q0, q1, q2, q3, K1, K2, K3, g1, g2, g3, J1, J2, J3, D);
        if (t == R(0.0) && !(det.a0 > R(8.881784197001252e-16))) { return (t_ir5){4, R(0.0), q0, q1, q2, q3}; }
        if (!(det.a0 > R(0.0))) { return (t_ir5){1, t * end, q0, q1, q2, q3}; }
        slope = det.a2 + R(2.0) * t * det.a1; length = R(0.5) / (slope + R(sqrt(slope * slope + R(2.0))));
        remaining = R(1.0) - t; step = det.a1 * remaining <= length ? remaining : length / det.a1;
        if (step < remaining && step < max_r(shortest * t, R(1e-19) * min_r(t, remaining))) {
            return (t_ir5){1, t * end, q0, q1, q2, q3};
        }
        ahead = step == remaining ? R(1.0) : t + step;
        t_r4 t_1 = branch_turned(q0, q1, q2, q3, step * det.a3, step * det.a4, step * det.a5); p0 = t_1.a0;
        p1 = t_1.a1; p2 = t_1.a2; p3 = t_1.a3;
        t_br4 t_2 = branch_corrected(p0, p1, p2, p3, ahead * K1, ahead * K2, ahead * K3, g1, g2, g3, J1, J2, J3, D);
        settled = t_2.a0; p0 = t_2.a1; p1 = t_2.a2; p2 = t_2.a3; p3 = t_2.a4;
        if (!settled) { return (t_ir5){2, t * end, q0, q1, q2, q3}; }
        t = ahead; q0 = p0; q1 = p1; q2 = p2; q3 = p3;
        if (t == R(1.0) && end < R(1.0)) { return (t_ir5){2, end, q0, q1, q2, q3}; }
        if (t == R(1.0)) {
            if (q0 < R(0.0)) { q0 = -q0; q1 = -q1; q2 = -q2; q3 = -q3; }
            return (t_ir5){0, R(1.0), q0, R(ldexp(q1, (int)-beyond)), R(ldexp(q2, (int)-beyond)), R(ldexp(q3,
                (int)-beyond))};
        }
    }
    return (t_ir5){2, t * end, q0, q1, q2, q3};
}

INLINE t_ir5 branch_small_rotation(real K1, real K2, real K3, real g1, real g2, real g3, real J1, real J2, real J3,
    real D) {
    return branch_continued(K1, K2, K3, g1, g2, g3, J1, J2, J3, D, R(4e-16));
}

t_ir5 branch_small_rotation_double(real K1, real K2, real K3, real g1, real g2, real g3, real J1, real J2, real J3,
    real D) {
    return branch_small_rotation(K1, K2, K3, g1, g2, g3, J1, J2, J3, D);
}

#endif
#ifdef SINGLE
INLINE t_ir5 single_loop_widened(real K1, real K2, real K3, real g1, real g2, real g3, real J1, real J2, real J3, real
    D) {
    double x = (double)g1, y = (double)g2, z = (double)g3, length = sqrt(x * x + (y * y + z * z));
    t_id5 status = branch_small_rotation_double((double)K1, (double)K2, (double)K3, x / length, y / length, z /
        length, (double)J1, (double)J2, (double)J3, (double)D);
    return (t_ir5){status.a0, (real)status.a1, (real)status.a2, (real)status.a3, (real)status.a4, (real)status.a5};
}

#endif
OUT_OF_LINE t_ir8 loop_safe_rotation(real u1, real u2, real u3, r1 state) {
    int settled; real p0, p1, p2, p3, w1, w2, w3;
    t_r3 k1 = loop_three(state, 0), g1 = loop_three(state, 3), I1 = loop_three(state, 21);
    if (state.p[25] == R(-2.0)) {
        t_br7 t_1 = path_search_on_path(u1, u2, u3, k1.a0, k1.a1, k1.a2, g1.a0, g1.a1, g1.a2, I1.a0, I1.a1, I1.a2,
            state.p[24]);
        settled = t_1.a0; p0 = t_1.a1; p1 = t_1.a2; p2 = t_1.a3; p3 = t_1.a4; w1 = t_1.a5; w2 = t_1.a6; w3 = t_1.a7;
    }
    else {
        t_br7 t_2 = gibbs_search_safely(u1, u2, u3, k1.a0, k1.a1, k1.a2, g1.a0, g1.a1, g1.a2, I1.a0, I1.a1, I1.a2,
            state.p[24], state.p[25], state.p[26]);
        settled = t_2.a0; p0 = t_2.a1; p1 = t_2.a2; p2 = t_2.a3; p3 = t_2.a4; w1 = t_2.a5; w2 = t_2.a6; w3 = t_2.a7;
    }
    if (settled) { return (t_ir8){0, R(1.0), p0, p1, p2, p3, w1, w2, w3}; }
    t_ir5 t_3 = loop_small_rotation(R(2.0) * k1.a0, R(2.0) * k1.a1, R(2.0) * k1.a2, g1.a0, g1.a1, g1.a2, state.p[18],
        state.p[19], state.p[20], state.p[24]);
    int64_t status = t_3.a0; real reach = t_3.a1; p0 = t_3.a2; p1 = t_3.a3; p2 = t_3.a4; p3 = t_3.a5;
    if (p0 == R(0.0)) { return (t_ir8){status, reach, p0, p1, p2, p3, R(0.0), R(0.0), R(0.0)}; }
    return (t_ir8){status, reach, p0, p1, p2, p3, p1 / p0, p2 / p0, p3 / p0};
}

INLINE t_r3 kernel_centre_step(real q0, real q1, real q2, real q3, real g1, real g2, real g3) {
    real t0 = 2 * q0, o_s1 = t0 * (g3 * q2 - g2 * q3), o_s2 = -t0 * (g3 * q1 - g1 * q3);
    real o_s3 = t0 * (g2 * q1 - g1 * q2); return (t_r3){o_s1, o_s2, o_s3};
}

INLINE t_r3 kernel_rotate(real q0, real q1, real q2, real q3, real v1, real v2, real v3) {
    real t0 = q2 * q2, t1 = q3 * q3, t2 = 2 * v1, t3 = q0 * q2, t4 = q1 * q3, t5 = q0 * q3, t6 = q1 * q2;
    real t7 = 2 * v2, t8 = q1 * q1, t9 = q0 * q1, t10 = q2 * q3, t11 = 2 * v3;
    real o_x1 = v1 + 2 * v3 * (t3 + t4) - (t2 * (t0 + t1) + t7 * (t5 - t6));
    real o_x2 = v2 + t2 * (t5 + t6) - (t11 * (t9 - t10) + t7 * (t1 + t8));
    real o_x3 = v3 + 2 * v2 * (t10 + t9) - (t11 * (t0 + t8) + t2 * (t3 - t4)); return (t_r3){o_x1, o_x2, o_x3};
}

INLINE t_r6 loop_followed(real p0, real p1, real p2, real p3, real g1, real g2, real g3, real a0, real a1, real a2,
    real a3, real x, real y, real radius) {
    real length = R(sqrt(p0 * p0 + p1 * p1 + (p2 * p2 + p3 * p3))), q0 = p0 / length, q1 = p1 / length;
    real q2 = p2 / length, q3 = p3 / length; t_r3 s1 = kernel_centre_step(q0, q1, q2, q3, g1, g2, g3);
    t_r3 d1 = kernel_rotate(a0, a1, a2, a3, s1.a0, s1.a1, s1.a2);
    t_r4 t_1 = kernel_compose(a0, a1, a2, a3, q0, q1, q2, q3); a0 = t_1.a0; a1 = t_1.a1; a2 = t_1.a2; a3 = t_1.a3;
    real scale = R(1.5) - R(0.5) * (a0 * a0 + a1 * a1 + a2 * a2 + a3 * a3);
    return (t_r6){a0 * scale, a1 * scale, a2 * scale, a3 * scale, x + radius * d1.a0, y + radius * d1.a1};
}

#ifndef SINGLE
INLINE void loop_follow_body(real p0, real p1, real p2, real p3, real g1, real g2, real g3, r1 attitude, r1 contact,
    real radius) {
    real a0 = attitude.p[0], a1 = attitude.p[1], a2 = attitude.p[2], a3 = attitude.p[3];
    t_r6 t_1 = loop_followed(p0, p1, p2, p3, g1, g2, g3, a0, a1, a2, a3, contact.p[0], contact.p[1], radius);
    attitude.p[0] = t_1.a0; attitude.p[1] = t_1.a1; attitude.p[2] = t_1.a2; attitude.p[3] = t_1.a3;
    contact.p[0] = t_1.a4; contact.p[1] = t_1.a5;
}

#endif
INLINE t_r3 kernel_turn(real p0, real p1, real p2, real p3, real v1, real v2, real v3) {
    real s = R(2) / (p0 * p0 + p1 * p1 + (p2 * p2 + p3 * p3)), x1 = p2 * v3 - p3 * v2, x2 = p3 * v1 - p1 * v3;
    real x3 = p1 * v2 - p2 * v1, o_x1 = s * (p2 * x3 - p0 * x1 - p3 * x2), o_x2 = s * (p3 * x1 - p0 * x2 - p1 * x3);
    real o_x3 = s * (p1 * x2 - p0 * x3 - p2 * x1); return (t_r3){o_x1, o_x2, o_x3};
}

INLINE t_r2 sums_added(real total, real rest, real more) {
    more = more - rest; real there = total + more; return (t_r2){there, there - total - more};
}

INLINE t_r6 sums_turned(real p0, real p1, real p2, real p3, real v1, real v2, real v3, real x1, real x2, real x3) {
    t_r3 z1 = kernel_turn(p0, p1, p2, p3, v1, v2, v3); t_r2 t_1 = sums_added(v1, x1, z1.a0); v1 = t_1.a0; x1 = t_1.a1;
    t_r2 t_2 = sums_added(v2, x2, z1.a1); v2 = t_2.a0; x2 = t_2.a1; t_r2 t_3 = sums_added(v3, x3, z1.a2); v3 = t_3.a0;
    x3 = t_3.a1; return (t_r6){v1, v2, v3, x1, x2, x3};
}

INLINE t_r3 integrals_missing(r1 state) {
    real k1 = state.p[0], k2 = state.p[1], k3 = state.p[2], g1 = state.p[3], g2 = state.p[4], g3 = state.p[5];
    real x1 = state.p[6], x2 = state.p[7], x3 = state.p[8], y1 = state.p[9], y2 = state.p[10], y3 = state.p[11];
    t_r2 t_1 = integrals_inner(g1, g2, g3, -g1, -g2, -g3, state.p[12], state.p[13]); real unit = t_1.a0;
    t_r2 t_2 = integrals_inner(k1, k2, k3, -g1, -g2, -g3, state.p[14], state.p[15]); real height = t_2.a0;
    t_r2 t_3 = integrals_inner(k1, k2, k3, -k1, -k2, -k3, state.p[16], state.p[17]); real squared = t_3.a0;
    unit = unit + R(2.0) * (g1 * y1 + g2 * y2 + g3 * y3);
    height = height + (k1 * y1 + k2 * y2 + k3 * y3 + (g1 * x1 + g2 * x2 + g3 * x3));
    squared = squared + R(2.0) * (k1 * x1 + k2 * x2 + k3 * x3); return (t_r3){unit, height, squared};
}

INLINE t_r3 integrals_shares(real unit, real height, real squared, real one, real h, real n) {
    real along_gamma;
    if (!(n > R(0.0))) { return (t_r3){R(0.0), R(0.0), R(0.0)}; }
    real stretch = R(0.5) * unit / one; height = height - stretch * h; real sine = one - h * h / n;
    if (sine > integrals_VERTICAL) {
        along_gamma = (height - R(0.5) * squared * h / n) / sine;
        return (t_r3){stretch, (R(0.5) * squared - along_gamma * h) / n, along_gamma};
    }
    return (t_r3){stretch, R(0.5) * squared / n, R(0.0)};
}

INLINE void integrals_give(r1 state, real stretch, real along_k, real along_gamma) {
    real k, g;
    for (int64_t i = 0; i < 3; i++) {
        k = state.p[i]; g = state.p[3 + i]; state.p[6 + i] = state.p[6 + i] - (along_k * k + along_gamma * g);
        state.p[9 + i] = state.p[9 + i] - stretch * g;
    }
}

OUT_OF_LINE void integrals_restore(r1 state) {
    t_r3 unit = integrals_missing(state);
    t_r3 stretch = integrals_shares(unit.a0, unit.a1, unit.a2, state.p[12], state.p[14], state.p[16]);
    integrals_give(state, stretch.a0, stretch.a1, stretch.a2);
}

#ifdef SINGLE
INLINE void single_loop_add(r1 array, int64_t at, int64_t rest, real z) {
    t_r2 t_1 = sums_added(array.p[at], array.p[rest], z); array.p[at] = t_1.a0; array.p[rest] = t_1.a1;
}

INLINE void single_loop_follow_body(real p0, real p1, real p2, real p3, real g1, real g2, real g3, r1 attitude, r1
    contact, real radius) {
    real squared = p1 * p1 + (p2 * p2 + p3 * p3), length = R(sqrt(p0 * p0 + squared)), q0 = p0 / length;
    real q1 = p1 / length, q2 = p2 / length, q3 = p3 / length;
    t_r3 s1 = kernel_centre_step(q0, q1, q2, q3, g1, g2, g3);
    real a0 = attitude.p[0], a1 = attitude.p[1], a2 = attitude.p[2], a3 = attitude.p[3];
    t_r3 x = kernel_rotate(a0, a1, a2, a3, s1.a0, s1.a1, s1.a2); single_loop_add(contact, 0, 2, radius * x.a0);
    single_loop_add(contact, 1, 3, radius * x.a1);
    t_r4 z0 = kernel_compose(a0, a1, a2, a3, -squared / (length * (length + p0)), q1, q2, q3);
    real stretch = R(0.5) - R(0.5) * (a0 * a0 + a1 * a1 + (a2 * a2 + a3 * a3));
    single_loop_add(attitude, 0, 4, z0.a0 + stretch * a0); single_loop_add(attitude, 1, 5, z0.a1 + stretch * a1);
    single_loop_add(attitude, 2, 6, z0.a2 + stretch * a2); single_loop_add(attitude, 3, 7, z0.a3 + stretch * a3);
}

#endif
INLINE t_i2r loop_march(r1 state, r1 c, r3 weights, r1 radius, r1 enough, r2 past, int64_t begun, int64_t first,
    int64_t count, int64_t every, real scale, r2 momenta, r2 verticals, int with_body, r1 attitude, r1 contact, real
    rho, r2 attitudes, r2 traces) {
    int64_t stop, at, later, frame; real m1, m2, m3, p0, p1, p2, p3, w1, w2, w3; t_r3 u1; int settled;
    t_r3 t_1 = loop_three(state, 0); real k1 = t_1.a0, k2 = t_1.a1, k3 = t_1.a2; t_r3 t_2 = loop_three(state, 3);
    real g1 = t_2.a0, g2 = t_2.a1, g3 = t_2.a2; t_r3 t_3 = loop_three(state, 6);
    real x1 = t_3.a0, x2 = t_3.a1, x3 = t_3.a2; t_r3 t_4 = loop_three(state, 9);
    real y1 = t_4.a0, y2 = t_4.a1, y3 = t_4.a2; t_r3 I1 = loop_three(state, 21);
    int64_t stages = c.n0, places = weights.n1, period = max_i(1, div_i(1024, stages)), step = first, status = 0;
    real reach = R(1.0); int64_t last = first + count;
    while (step < last && status == 0) {
        stop = min_i(min_i(last, step + every - mod_i(step, every)), step + period - mod_i(begun + step, period));
        while (step < stop) {
            at = mod_i((begun + step) * stages, places); later = (begun + step) * stages >= places ? 1 : 0;
            for (int64_t i = 0, end_i = stages; i < end_i; i++) {
                m1 = c.p[i] * k1; m2 = c.p[i] * k2; m3 = c.p[i] * k3;
                u1 = loop_guessed(past, at + i, r2_row(r3_row(weights, later), at + i));
                t_br7 t_5 = gibbs_settle(u1.a0, u1.a1, u1.a2, m1, m2, m3, g1, g2, g3, I1.a0, I1.a1, I1.a2,
                    state.p[24], radius.p[i], enough.p[i], 0);
                settled = t_5.a0; p0 = t_5.a1; p1 = t_5.a2; p2 = t_5.a3; p3 = t_5.a4; w1 = t_5.a5; w2 = t_5.a6;
                w3 = t_5.a7;
                if (!settled) {
                    loop_put(state, 0, m1, m2, m3); loop_put(state, 3, g1, g2, g3); state.p[25] = radius.p[i];
                    state.p[26] = enough.p[i]; t_ir8 t_6 = loop_safe_rotation(w1, w2, w3, state); status = t_6.a0;
                    reach = t_6.a1; p0 = t_6.a2; p1 = t_6.a3; p2 = t_6.a4; p3 = t_6.a5; w1 = t_6.a6; w2 = t_6.a7;
                    w3 = t_6.a8;
                    if (status != 0) { break; }
                }
                loop_put(r2_row(past, at + i), 0, w1, w2, w3); loop_put(r2_row(past, places + at + i), 0, w1, w2, w3);
                if (with_body) { loop_follow_body(p0, p1, p2, p3, g1, g2, g3, attitude, contact, rho); }
                t_r6 t_7 = sums_turned(p0, p1, p2, p3, k1, k2, k3, x1, x2, x3); k1 = t_7.a0; k2 = t_7.a1; k3 = t_7.a2;
                x1 = t_7.a3; x2 = t_7.a4; x3 = t_7.a5; t_r6 t_8 = sums_turned(p0, p1, p2, p3, g1, g2, g3, y1, y2, y3);
                g1 = t_8.a0; g2 = t_8.a1; g3 = t_8.a2; y1 = t_8.a3; y2 = t_8.a4; y3 = t_8.a5;
            }
            if (status != 0) { break; }
            step = step + 1;
        }
        if (status == 0) { loop_put(state, 0, k1, k2, k3); loop_put(state, 3, g1, g2, g3); }
        loop_put(state, 6, x1, x2, x3); loop_put(state, 9, y1, y2, y3);
        if (status == 0 && mod_i(begun + step, period) == 0) {
            integrals_restore(state); t_r3 t_9 = loop_three(state, 6); x1 = t_9.a0; x2 = t_9.a1; x3 = t_9.a2;
            t_r3 t_10 = loop_three(state, 9); y1 = t_10.a0; y2 = t_10.a1; y3 = t_10.a2;
        }
        if (status == 0 && mod_i(step, every) == 0) {
            frame = div_i(step, every); loop_put(r2_row(momenta, frame), 0, scale * k1, scale * k2, scale * k3);
            loop_put(r2_row(verticals, frame), 0, g1, g2, g3);
            if (with_body) {
                for (int64_t i = 0; i < 4; i++) { AT2(attitudes, frame, i) = attitude.p[i]; }
                AT2(traces, frame, 0) = contact.p[0]; AT2(traces, frame, 1) = contact.p[1];
            }
        }
    }
    return (t_i2r){step - first, status, reach};
}

INLINE void block_prepare_block(r2 momentum, r2 g, r2 tensor, r1 contact, r1 c, r2 state, r2 radius, r2 enough, r2
    past, r1 scale) {
    int64_t i; ALIGNED real one_[27]; r1 one = {one_, 27}; int64_t last = contact.n0 - 1;
    ALIGNED real bounds_[2 * c.n0]; r2 bounds = {bounds_, 2, c.n0, c.n0};
    for (int64_t lane = 0, end_lane = state.n1; lane < end_lane; lane++) {
        i = min_i(lane, last);
        scale.p[i] = loop_prepare(r2_row(momentum, i), r2_row(g, i), r2_row(tensor, i), contact.p[i], c, one,
            r2_row(bounds, 0), r2_row(bounds, 1));
        for (int64_t row = 0; row < 27; row++) { AT2(state, row, lane) = one.p[row]; }
        for (int64_t stage = 0, end_stage = c.n0; stage < end_stage; stage++) {
            AT2(radius, stage, lane) = AT2(bounds, 0, stage); AT2(enough, stage, lane) = AT2(bounds, 1, stage);
        }
    }
    for (int64_t row = 0, end_row = past.n0; row < end_row; row++) {
        for (int64_t lane = 0, end_lane = state.n1; lane < end_lane; lane++) { AT2(past, row, lane) = R(0.0); }
    }
}

INLINE void block_carry(r2 numbers, r2 to, int64_t width) {
    for (int64_t row = 0, end_row = to.n0; row < end_row; row++) {
        for (int64_t i = 0, end_i = width; i < end_i; i++) { AT2(to, row, i) = AT2(numbers, row, i); }
    }
}

INLINE t_i2 block_uncertified(r1 radius, w1 ok) {
    int64_t count = 0, beyond = 0;
    for (int64_t i = 0, end_i = ok.n0; i < end_i; i++) {
        count = count + (radius.p[i] >= R(0.0) ? 0 : 1); beyond = beyond + (radius.p[i] == R(-2.0) ? 1 : 0);
    }
    return (t_i2){count, beyond};
}

INLINE int64_t block_whole(w1 ok) { return div_i(ok.n0, block_REGISTER) * block_REGISTER; }
INLINE void block_begin_stage(r2 S, r2 T, real s, r1 radius, r1 enough, w1 ok) {
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        AT2(T, 0, i) = s * AT2(S, 0, i); AT2(T, 1, i) = s * AT2(S, 1, i); AT2(T, 2, i) = s * AT2(S, 2, i);
        AT2(T, 3, i) = AT2(S, 3, i); AT2(T, 4, i) = AT2(S, 4, i); AT2(T, 5, i) = AT2(S, 5, i);
        AT2(T, 25, i) = radius.p[i]; AT2(T, 26, i) = enough.p[i];
    }
}

INLINE void block_guessed(r2 P, r2 past, int64_t at, int64_t places, r1 weights, w1 ok) {
    real a, b, c, d, u1, u2, u3; int64_t w, x, y, z;
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        AT2(P, 9, i) = R(0.0); AT2(P, 10, i) = R(0.0); AT2(P, 11, i) = R(0.0);
    }
    for (int64_t j = 0, end_j = weights.n0; j < end_j; j += 4) {
        a = weights.p[j]; b = weights.p[j + 1]; c = weights.p[j + 2]; d = weights.p[j + 3];
        w = 3 * mod_i(at + j, places); x = 3 * mod_i(at + j + 1, places); y = 3 * mod_i(at + j + 2, places);
        z = 3 * mod_i(at + j + 3, places);
        INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
            u1 = AT2(P, 9, i) + a * AT2(past, w, i); u2 = AT2(P, 10, i) + a * AT2(past, w + 1, i);
            u3 = AT2(P, 11, i) + a * AT2(past, w + 2, i); u1 = u1 + b * AT2(past, x, i);
            u2 = u2 + b * AT2(past, x + 1, i); u3 = u3 + b * AT2(past, x + 2, i); u1 = u1 + c * AT2(past, y, i);
            u2 = u2 + c * AT2(past, y + 1, i); u3 = u3 + c * AT2(past, y + 2, i); u1 = u1 + d * AT2(past, z, i);
            u2 = u2 + d * AT2(past, z + 1, i); u3 = u3 + d * AT2(past, z + 2, i); AT2(P, 9, i) = u1;
            AT2(P, 10, i) = u2; AT2(P, 11, i) = u3;
        }
    }
}

INLINE int64_t block_unsettled(w1 ok) {
    int64_t bad = 0;
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) { bad = bad + (1 - ok.p[i]); }
    return bad;
}

INLINE int64_t block_predicted(r2 S, r2 P, w1 ok) {
    real u1, u2, u3; Round r; int settled;
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        u1 = AT2(P, 9, i); u2 = AT2(P, 10, i); u3 = AT2(P, 11, i);
        r = gibbs_newton_round(u1, u2, u3, AT2(S, 0, i), AT2(S, 1, i), AT2(S, 2, i), AT2(S, 3, i), AT2(S, 4, i),
            AT2(S, 5, i), AT2(S, 21, i), AT2(S, 22, i), AT2(S, 23, i), AT2(S, 24, i), 0);
        AT2(P, 0, i) = r.p0; AT2(P, 1, i) = r.p1; AT2(P, 2, i) = r.p2; AT2(P, 3, i) = r.p3; AT2(P, 4, i) = r.w1;
        AT2(P, 5, i) = r.w2; AT2(P, 6, i) = r.w3;
        settled = (u1 * u1 + (u2 * u2 + u3 * u3) <= AT2(S, 25, i)) & (r.first <= AT2(S, 26, i));
        ok.p[i] = settled ? 1 : 0;
    }
    return block_unsettled(ok);
}

INLINE int64_t block_corrected(r2 S, r2 P, w1 ok, int again) {
    real radius, enough, u1, u2, u3, k1, k2, k3, I1, I2, I3, p0, first, p1, p2, p3, w1, w2, w3;
    int near, once, twice, done; Round r; t_r7 r1;
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        radius = AT2(S, 25, i); enough = AT2(S, 26, i);
        if (again) { u1 = AT2(P, 4, i); u2 = AT2(P, 5, i); u3 = AT2(P, 6, i); }
        else { u1 = AT2(P, 9, i); u2 = AT2(P, 10, i); u3 = AT2(P, 11, i); }
        near = u1 * u1 + (u2 * u2 + u3 * u3) <= radius;
        if (again) {
            u1 = near ? u1 : R(0.0); u2 = near ? u2 : R(0.0); u3 = near ? u3 : R(0.0); near = radius >= R(0.0);
        }
        k1 = AT2(S, 0, i); k2 = AT2(S, 1, i); k3 = AT2(S, 2, i); I1 = AT2(S, 21, i); I2 = AT2(S, 22, i);
        I3 = AT2(S, 23, i);
        r = gibbs_newton_round(u1, u2, u3, k1, k2, k3, AT2(S, 3, i), AT2(S, 4, i), AT2(S, 5, i), I1, I2, I3, AT2(S,
            24, i), 0);
        r1 = gibbs_second_round(r, k1, k2, k3, I1, I2, I3); p0 = r.p0; first = r.first;
        once = near & (first <= enough); twice = near & (r1.a3 * r1.a3 + (r1.a4 * r1.a4 + r1.a5 * r1.a5) <= radius);
        twice = twice & (R(9.0) * max_r(first, r1.a6) * r1.a6 <= enough * enough); done = again & (ok.p[i] == 1);
        p1 = once ? r.p1 : r1.a0; p2 = once ? r.p2 : r1.a1; p3 = once ? r.p3 : r1.a2; w1 = once ? r.w1 : r1.a3;
        w2 = once ? r.w2 : r1.a4; w3 = once ? r.w3 : r1.a5; w1 = near ? w1 : u1; w2 = near ? w2 : u2;
        w3 = near ? w3 : u3; real t_1 = done ? AT2(P, 0, i) : p0, t_2 = done ? AT2(P, 1, i) : p1; AT2(P, 0, i) = t_1;
        AT2(P, 1, i) = t_2; real t_3 = done ? AT2(P, 2, i) : p2, t_4 = done ? AT2(P, 3, i) : p3; AT2(P, 2, i) = t_3;
        AT2(P, 3, i) = t_4;
        real t_5 = done ? AT2(P, 4, i) : w1, t_6 = done ? AT2(P, 5, i) : w2, t_7 = done ? AT2(P, 6, i) : w3;
        AT2(P, 4, i) = t_5; AT2(P, 5, i) = t_6; AT2(P, 6, i) = t_7; ok.p[i] = ((done | once) | twice) ? 1 : 0;
    }
    return block_unsettled(ok);
}

INLINE void block_approached(r2 S, r2 P, w1 ok) {
    int beyond; Round r;
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        beyond = AT2(S, 25, i) == R(-2.0);
        r = gibbs_newton_round(AT2(P, 9, i), AT2(P, 10, i), AT2(P, 11, i), AT2(S, 0, i), AT2(S, 1, i), AT2(S, 2, i),
            AT2(S, 3, i), AT2(S, 4, i), AT2(S, 5, i), AT2(S, 21, i), AT2(S, 22, i), AT2(S, 23, i), AT2(S, 24, i), 0);
        real t_1 = beyond ? r.w1 : AT2(P, 4, i), t_2 = beyond ? r.w2 : AT2(P, 5, i); AT2(P, 4, i) = t_1;
        AT2(P, 5, i) = t_2; AT2(P, 6, i) = beyond ? r.w3 : AT2(P, 6, i); AT2(P, 7, i) = beyond ? R(1.0) : R(0.0);
        ok.p[i] = beyond ? 0 : ok.p[i];
    }
}

INLINE real block_nearer(r2 S, r2 P, w1 ok) {
    int going, near, found; real p0, p1, p2, p3, w1, w2, w3, left;
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        going = AT2(P, 7, i) == R(1.0);
        t_r8b2 t_1 = path_improved(AT2(P, 4, i), AT2(P, 5, i), AT2(P, 6, i), AT2(S, 0, i), AT2(S, 1, i), AT2(S, 2, i),
            AT2(S, 3, i), AT2(S, 4, i), AT2(S, 5, i), AT2(S, 21, i), AT2(S, 22, i), AT2(S, 23, i), AT2(S, 24, i));
        p0 = t_1.a0; p1 = t_1.a1; p2 = t_1.a2; p3 = t_1.a3; w1 = t_1.a4; w2 = t_1.a5; w3 = t_1.a6; left = t_1.a7;
        near = t_1.a8; found = t_1.a9; real t_2 = going ? p0 : AT2(P, 0, i), t_3 = going ? p1 : AT2(P, 1, i);
        AT2(P, 0, i) = t_2; AT2(P, 1, i) = t_3; real t_4 = going ? p2 : AT2(P, 2, i), t_5 = going ? p3 : AT2(P, 3, i);
        AT2(P, 2, i) = t_4; AT2(P, 3, i) = t_5;
        real t_6 = going ? w1 : AT2(P, 4, i), t_7 = going ? w2 : AT2(P, 5, i), t_8 = going ? w3 : AT2(P, 6, i);
        AT2(P, 4, i) = t_6; AT2(P, 5, i) = t_7; AT2(P, 6, i) = t_8;
        real t_9 = (near | found) ? R(0.0) : AT2(P, 7, i), t_10 = going ? left : AT2(P, 8, i); AT2(P, 7, i) = t_9;
        AT2(P, 8, i) = t_10;
    }
    left = R(0.0);
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) { left = left + AT2(P, 7, i); }
    return left;
}

INLINE int64_t block_on_path(r2 S, r2 P, w1 ok) {
    int settled;
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        settled = (AT2(S, 25, i) == R(-2.0)) & path_proved(AT2(P, 4, i), AT2(P, 5, i), AT2(P, 6, i), AT2(P, 8, i),
            AT2(S, 0, i), AT2(S, 1, i), AT2(S, 2, i), AT2(S, 3, i), AT2(S, 4, i), AT2(S, 5, i), AT2(S, 21, i), AT2(S,
            22, i), AT2(S, 23, i), AT2(S, 24, i));
        ok.p[i] = settled ? 1 : ok.p[i];
    }
    return block_unsettled(ok);
}

INLINE t_i2 block_solved(r2 S, r2 P, w1 ok, int64_t hopeless, int64_t beyond, int64_t patience) {
    int64_t rounds; real left; int64_t bad = beyond < ok.n0 ? hopeless + 1 : hopeless;
    if (patience == 0 && beyond < ok.n0) { bad = block_predicted(S, P, ok); }
    if (bad > hopeless) {
        patience = patience == 0 ? 64 : patience - 1; bad = block_corrected(S, P, ok, 0); rounds = 1;
        while (bad > hopeless + 2 && rounds < 4) { bad = block_corrected(S, P, ok, 1); rounds = rounds + 1; }
    }
    if (beyond != 0) {
        block_approached(S, P, ok); left = block_nearer(S, P, ok); rounds = 1;
        while (left > 0 && rounds < 6) { left = block_nearer(S, P, ok); rounds = rounds + 1; }
        bad = block_on_path(S, P, ok);
    }
    return (t_i2){patience, bad};
}

OUT_OF_LINE void block_mend(r2 S, r2 P, w1 ok, int64_t step, i1 taken, i1 status, d1 reach, int64_t balls) {
    t_br7 u1; real p0, p1, p2, p3, w1, w2, w3;
    for (int64_t i = 0, end_i = ok.n0; i < end_i; i++) {
        if (ok.p[i] == 1) { continue; }
        if (i < balls && status.p[i] == 0) {
            real one_[S.n0]; r1 one = {one_, S.n0};
            for (int64_t i_ = 0; i_ < S.n0; i_++) { one_[i_] = AT2(S, i_, i); }
            t_r3 t_1 = loop_three(one, 0), t_2 = loop_three(one, 3), t_3 = loop_three(one, 21);
            u1 = gibbs_settle(AT2(P, 9, i), AT2(P, 10, i), AT2(P, 11, i), t_1.a0, t_1.a1, t_1.a2, t_2.a0, t_2.a1,
                t_2.a2, t_3.a0, t_3.a1, t_3.a2, one.p[24], one.p[25], one.p[26], 0);
            t_ir8 t_4 = loop_safe_rotation(u1.a5, u1.a6, u1.a7, one); status.p[i] = t_4.a0; reach.p[i] = t_4.a1;
            p0 = t_4.a2; p1 = t_4.a3; p2 = t_4.a4; p3 = t_4.a5; w1 = t_4.a6; w2 = t_4.a7; w3 = t_4.a8;
            if (status.p[i] == 0) {
                AT2(P, 0, i) = p0; AT2(P, 1, i) = p1; AT2(P, 2, i) = p2; AT2(P, 3, i) = p3; AT2(P, 4, i) = w1;
                AT2(P, 5, i) = w2; AT2(P, 6, i) = w3; continue;
            }
            taken.p[i] = step;
        }
        AT2(S, 25, i) = R(-1.0); AT2(P, 0, i) = R(1.0); AT2(P, 1, i) = R(0.0); AT2(P, 2, i) = R(0.0);
        AT2(P, 3, i) = R(0.0); AT2(P, 4, i) = R(0.0); AT2(P, 5, i) = R(0.0); AT2(P, 6, i) = R(0.0);
    }
}

INLINE void block_stop(r2 S, r2 T, r2 radius, i1 status, w1 ok) {
    for (int64_t i = 0, end_i = ok.n0; i < end_i; i++) {
        if ((i >= status.n0 || status.p[i] != 0) && ok.p[i] == 0 && AT2(radius, 0, i) != R(-3.0)) {
            for (int64_t stage = 0, end_stage = radius.n0; stage < end_stage; stage++) {
                AT2(radius, stage, i) = R(-3.0);
            }
            for (int64_t row = 0; row < 3; row++) { AT2(S, row, i) = AT2(T, row, i); }
        }
    }
}

INLINE void block_rolled(r2 S, r2 P, r2 B, w1 ok) {
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        t_r6 t_1 = loop_followed(AT2(P, 0, i), AT2(P, 1, i), AT2(P, 2, i), AT2(P, 3, i), AT2(S, 3, i), AT2(S, 4, i),
            AT2(S, 5, i), AT2(B, 0, i), AT2(B, 1, i), AT2(B, 2, i), AT2(B, 3, i), AT2(B, 4, i), AT2(B, 5, i), AT2(B,
            6, i));
        AT2(B, 0, i) = t_1.a0; AT2(B, 1, i) = t_1.a1; AT2(B, 2, i) = t_1.a2; AT2(B, 3, i) = t_1.a3;
        AT2(B, 4, i) = t_1.a4; AT2(B, 5, i) = t_1.a5;
    }
}

INLINE void block_turn_at(real p0, real p1, real p2, real p3, r2 S, int64_t at, int64_t rest, int64_t i) {
    t_r6 v1 = sums_turned(p0, p1, p2, p3, AT2(S, at, i), AT2(S, at + 1, i), AT2(S, at + 2, i), AT2(S, rest, i), AT2(S,
        rest + 1, i), AT2(S, rest + 2, i));
    AT2(S, at, i) = v1.a0; AT2(S, at + 1, i) = v1.a1; AT2(S, at + 2, i) = v1.a2; AT2(S, rest, i) = v1.a3;
    AT2(S, rest + 1, i) = v1.a4; AT2(S, rest + 2, i) = v1.a5;
}

INLINE void block_end_stage(r2 S, r2 P, r2 past, int64_t row, w1 ok) {
    real p0, p1, p2, p3;
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        p0 = AT2(P, 0, i); p1 = AT2(P, 1, i); p2 = AT2(P, 2, i); p3 = AT2(P, 3, i);
        block_turn_at(p0, p1, p2, p3, S, 0, 6, i); block_turn_at(p0, p1, p2, p3, S, 3, 9, i);
        AT2(past, row, i) = AT2(P, 4, i); AT2(past, row + 1, i) = AT2(P, 5, i); AT2(past, row + 2, i) = AT2(P, 6, i);
    }
}

OUT_OF_LINE void block_restored(r2 S, i1 status) {
    for (int64_t i = 0, end_i = status.n0; i < end_i; i++) {
        if (status.p[i] == 0) {
            real one_[S.n0]; r1 one = {one_, S.n0};
            for (int64_t i_ = 0; i_ < S.n0; i_++) { one_[i_] = AT2(S, i_, i); }
            integrals_restore(one);
            for (int64_t row = 6; row < 12; row++) { AT2(S, row, i) = one.p[row]; }
        }
    }
}

INLINE void block_keep(r2 S, r2 B, int64_t frame, r1 scale, r3 momenta, r3 verticals, i1 status, int with_body, r3
    attitudes, r3 traces) {
    for (int64_t i = 0, end_i = status.n0; i < end_i; i++) {
        if (status.p[i] == 0) {
            for (int64_t c = 0; c < 3; c++) {
                AT3(momenta, i, frame, c) = scale.p[i] * AT2(S, 0 + c, i);
                AT3(verticals, i, frame, c) = AT2(S, 3 + c, i);
            }
            if (with_body) {
                for (int64_t c = 0; c < 4; c++) { AT3(attitudes, i, frame, c) = AT2(B, c, i); }
                AT3(traces, i, frame, 0) = AT2(B, 4, i); AT3(traces, i, frame, 1) = AT2(B, 5, i);
            }
        }
    }
}

INLINE void block_march_block(r2 state, r1 c, r3 weights, r2 radius, r2 enough, r2 past, int64_t first, int64_t count,
    int64_t every, r1 scale, r3 momenta, r3 verticals, i1 taken, i1 status, d1 reach, int with_body, r2 body, r3
    attitudes, r3 traces) {
    int64_t at, later, bad; ALIGNED real S_[27 * block_LANES]; r2 S = {S_, 27, block_LANES, block_LANES};
    ALIGNED real W_[27 * block_LANES]; r2 W = {W_, 27, block_LANES, block_LANES}; ALIGNED real P_[12 * block_LANES];
    r2 P = {P_, 12, block_LANES, block_LANES}; ALIGNED real B_[7 * block_LANES];
    r2 B = {B_, 7, block_LANES, block_LANES}; ALIGNED real H_[past.n0 * block_LANES];
    r2 H = {H_, past.n0, block_LANES, block_LANES};
    int64_t width = state.n1, stages = c.n0, places = weights.n1, balls = status.n0; ALIGNED int32_t ok_[width];
    w1 ok = {ok_, width}; int64_t period = max_i(1, div_i(1024, stages)); ALIGNED int64_t hopeless_[stages];
    i1 hopeless = {hopeless_, stages}; ALIGNED int64_t beyond_[stages]; i1 beyond = {beyond_, stages};
    block_carry(state, S, width); block_carry(state, W, width); block_carry(body, B, width);
    block_carry(past, H, width); r2 T = stages == 1 ? S : W; int64_t last = first + count, patience = 0;
    for (int64_t s = 0, end_s = stages; s < end_s; s++) {
        t_i2 t_1 = block_uncertified(r2_row(radius, s), ok); hopeless.p[s] = t_1.a0; beyond.p[s] = t_1.a1;
    }
    for (int64_t step = first, end_step = last; step < end_step; step++) {
        at = mod_i(step * stages, places); later = step * stages >= places ? 1 : 0;
        for (int64_t s = 0, end_s = stages; s < end_s; s++) {
            if (stages > 1) { block_begin_stage(S, T, c.p[s], r2_row(radius, s), r2_row(enough, s), ok); }
            block_guessed(P, H, at + s, places, r2_row(r3_row(weights, later), at + s), ok);
            t_i2 t_2 = block_solved(T, P, ok, hopeless.p[s], beyond.p[s], patience); patience = t_2.a0; bad = t_2.a1;
            if (bad != 0) {
                block_mend(T, P, ok, step, taken, status, reach, balls); block_stop(S, T, radius, status, ok);
                for (int64_t other = 0, end_other = stages; other < end_other; other++) {
                    t_i2 t_3 = block_uncertified(r2_row(radius, other), ok); hopeless.p[other] = t_3.a0;
                    beyond.p[other] = t_3.a1;
                }
            }
            if (with_body) { block_rolled(T, P, B, ok); }
            block_end_stage(S, P, H, 3 * (at + s), ok);
        }
        if (mod_i(step + 1, period) == 0) { block_restored(S, status); }
        if (mod_i(step + 1, every) == 0) {
            block_keep(S, B, div_i(step + 1, every), scale, momenta, verticals, status, with_body, attitudes, traces);
        }
    }
    for (int64_t i = 0, end_i = balls; i < end_i; i++) {
        if (status.p[i] == 0) { taken.p[i] = last; }
    }
    block_carry(S, state, width); block_carry(B, body, width); block_carry(H, past, width);
}

INLINE void block_march_blocks(r2 state, r1 c, r3 weights, r2 radius, r2 enough, r2 past, int64_t first, int64_t
    count, int64_t every, r2 momentum, r2 gamma, r2 tensor, r1 contact, r1 rho, r1 scale, r2 ended, r3 momenta, r3
    verticals, i1 taken, i1 status, d1 reach, int with_body, r2 body, r3 attitudes, r3 traces) {
    int64_t high, i; int64_t width = state.n1, n = contact.n0;
    for (int64_t low = 0, end_low = n; low < end_low; low += width) {
        high = min_i(low + width, n);
        if (first == 0) {
            block_prepare_block(r2_part(momentum, low, high), r2_part(gamma, low, high), r2_part(tensor, low, high),
                r1_part(contact, low, high), c, state, radius, enough, past, r1_part(scale, low, high));
            if (with_body) {
                for (int64_t lane = 0, end_lane = width; lane < end_lane; lane++) {
                    i = min_i(low + lane, n - 1);
                    for (int64_t row = 0; row < 4; row++) { AT2(body, row, lane) = AT3(attitudes, i, 0, row); }
                    AT2(body, 4, lane) = R(0.0); AT2(body, 5, lane) = R(0.0); AT2(body, 6, lane) = rho.p[i];
                }
            }
        }
        block_march_block(state, c, weights, radius, enough, past, first, count, every, r1_part(scale, low, high),
            r3_part(momenta, low, high), r3_part(verticals, low, high), i1_part(taken, low, high), i1_part(status,
            low, high), d1_part(reach, low, high), with_body, body, r3_part(attitudes, low, high), r3_part(traces,
            low, high));
        for (int64_t i = low, end_i = high; i < end_i; i++) {
            if (status.p[i] != 0) {
                for (int64_t row = 0; row < 3; row++) {
                    AT2(ended, i, row) = scale.p[i] * AT2(state, 0 + row, i - low);
                    AT2(ended, i, 3 + row) = AT2(state, 3 + row, i - low);
                }
            }
        }
    }
}

INLINE t_ir single_step_advance(r1 momentum, r1 g, r1 tensor, real contact, r1 state, r1 q) {
    int64_t status; real scale = loop_scaled(momentum, g, tensor, contact, state);
    t_r3 k1 = loop_three(state, 0), g1 = loop_three(state, 3), I1 = loop_three(state, 21); real reach = R(1.0);
    t_br7 t_1 = gibbs_settle(R(0.0), R(0.0), R(0.0), k1.a0, k1.a1, k1.a2, g1.a0, g1.a1, g1.a2, I1.a0, I1.a1, I1.a2,
        state.p[24], state.p[25], state.p[26], 0);
    int settled = t_1.a0;
    real p0 = t_1.a1, p1 = t_1.a2, p2 = t_1.a3, p3 = t_1.a4, w1 = t_1.a5, w2 = t_1.a6, w3 = t_1.a7;
    if (!settled) {
        t_ir8 t_2 = loop_safe_rotation(w1, w2, w3, state); status = t_2.a0; reach = t_2.a1; p0 = t_2.a2; p1 = t_2.a3;
        p2 = t_2.a4; p3 = t_2.a5; w1 = t_2.a6; w2 = t_2.a7; w3 = t_2.a8;
        if (status != 0) { return (t_ir){status, reach}; }
    }
    real length = R(sqrt(p0 * p0 + p1 * p1 + (p2 * p2 + p3 * p3))); q.p[0] = p0 / length; q.p[1] = p1 / length;
    q.p[2] = p2 / length; q.p[3] = p3 / length; t_r3 t_3 = kernel_turn(p0, p1, p2, p3, k1.a0, k1.a1, k1.a2);
    real z1 = t_3.a0, z2 = t_3.a1, z3 = t_3.a2;
    loop_put(momentum, 0, scale * (k1.a0 + z1), scale * (k1.a1 + z2), scale * (k1.a2 + z3));
    t_r3 t_4 = kernel_turn(p0, p1, p2, p3, g1.a0, g1.a1, g1.a2); z1 = t_4.a0; z2 = t_4.a1; z3 = t_4.a2;
    loop_put(g, 0, g1.a0 + z1, g1.a1 + z2, g1.a2 + z3); return (t_ir){0, reach};
}

INLINE void single_step_advance_all(r2 momenta, r2 verticals, r2 tensors, r1 contacts, r2 q, i1 status, d1 reach) {
    ALIGNED real state_[27]; memset(state_, 0, sizeof state_); r1 state = {state_, 27};
    for (int64_t i = 0, end_i = momenta.n0; i < end_i; i++) {
        t_ir t_1 = single_step_advance(r2_row(momenta, i), r2_row(verticals, i), r2_row(tensors, i), contacts.p[i],
            state, r2_row(q, i));
        status.p[i] = t_1.a0; reach.p[i] = t_1.a1;
    }
}

#ifndef SINGLE
INLINE void long_run_placed(r1 body, int64_t i, r3 momenta, r3 verticals, r3 attitudes, r3 traces, int follows, int
    traced) {
    r1_fill(body, R(0.0));
    for (int64_t c = 0; c < 3; c++) { body.p[c] = AT3(momenta, i, 0, c); body.p[3 + c] = AT3(verticals, i, 0, c); }
    body.p[6] = R(1.0);
    if (follows) {
        for (int64_t c = 0; c < 4; c++) { body.p[6 + c] = AT3(attitudes, i, 0, c); }
    }
    if (traced) { body.p[10] = AT3(traces, i, 0, 0); body.p[11] = AT3(traces, i, 0, 1); }
}

INLINE t_ri long_step_begun(r1 body, r1 J0, real D0, real h, r1 state) {
    ALIGNED real none_[3]; memset(none_, 0, sizeof none_); r1 none = {none_, 3};
    t_ri size = real_frexp(loop_scaled(none, none, J0, D0, state));
    t_ri exponent = real_frexp(max_r(max_r(R(fabs(body.p[0])), R(fabs(body.p[1]))), R(fabs(body.p[2]))));
    for (int64_t c = 0; c < 3; c++) { body.p[c] = R(ldexp(body.p[c], (int)-exponent.a1)); }
    t_ri mantissa = real_frexp(R(0.5) * h);
    return (t_ri){R(ldexp(mantissa.a0, (int)min_i(mantissa.a1 + exponent.a1 - (size.a1 - 2), 100))), exponent.a1};
}

INLINE void long_run_entered(r2 S, int64_t at, int64_t i, r1 body, real half, int64_t n, r1 state) {
    real part = half / n; t_r3 I1 = loop_three(state, 21);
    real spread = R(0.5) * (max_r(max_r(I1.a0, I1.a1), I1.a2) - min_r(min_r(I1.a0, I1.a1), I1.a2));
    real k1 = part * body.p[0], k2 = part * body.p[1], k3 = part * body.p[2];
    real size = R(sqrt(k1 * k1 + k2 * k2 + k3 * k3));
    t_r2 within = gibbs_certificate(k1, k2, k3, I1.a0, I1.a1, I1.a2, state.p[24]);
    real least = gibbs_LEFT * size / (max_r(max_r(I1.a0, I1.a1), I1.a2) + state.p[24] + spread);
    real anywhere = gibbs_is_heavy(I1.a0, I1.a1, I1.a2, state.p[24]) ? R(-1.0) : R(1.0715086071862673e+301);
    AT2(S, at, i) = part; AT2(S, at + 1, i) = part != R(0.0) ? R(1.0) / part : R(0.0); AT2(S, at + 2, i) = size;
    AT2(S, 82, i) = spread; AT2(S, at + 3, i) = within.a0 >= R(0.0) ? within.a0 : anywhere;
    AT2(S, at + 4, i) = least * least / R(18.2); AT2(S, at + 5, i) = R(1.0) / (n * n);
}

INLINE void long_run_resized(r2 S, int64_t B, int64_t b, int64_t columns, real half, r1 body, r1 state) {
    AT2(S, 129, b) = half; int64_t least = 8 - columns;
    for (int64_t lane = 0; lane < 4; lane++) {
        long_run_entered(S, 59, lane * B + b, body, half, max_i(7 - lane, least), state);
        long_run_entered(S, 65, lane * B + b, body, half, max_i(lane, least), state);
    }
}

OUT_OF_LINE int64_t long_run_enter(r2 S, int64_t B, int64_t b, int64_t columns, r1 J0, real D0, real radius, real h,
    r2 sums, r2 beginning, r1 body, r1 state) {
    int64_t i, first; int one, two; t_ri half = long_step_begun(body, J0, D0, h, state);
    for (int64_t c = 0; c < 24; c++) { AT2(S, 105 + c, b) = body.p[c]; }
    AT2(S, 129, b) = half.a0; AT2(S, 130, b) = radius; AT2(S, 134, b) = state.p[24]; AT2(S, 135, b) = R(0.0);
    for (int64_t c = 0; c < 3; c++) { AT2(S, 131 + c, b) = state.p[18 + c]; }
    int64_t least = 8 - columns;
    for (int64_t lane = 0; lane < 4; lane++) {
        i = lane * B + b; first = max_i(7 - lane, least);
        for (int64_t c = 0; c < 3; c++) { AT2(S, 27 + c, i) = state.p[21 + c]; }
        AT2(S, 30, i) = state.p[24]; one = 7 - lane >= least; two = lane >= least;
        for (int64_t c = 0; c < 3; c++) { AT2(S, 79 + c, i) = AT2(beginning, first, c); }
        for (int64_t c = 0; c < 4; c++) {
            AT2(S, 71 + 2 * c, i) = one ? AT2(sums, c, first - least) : R(0.0);
            AT2(S, 71 + 2 * c + 1, i) = two ? AT2(sums, c, lane - least) : R(0.0);
        }
    }
    long_run_resized(S, B, b, columns, half.a0, body, state); return half.a1;
}

INLINE t_r3 kernel_angular_velocity(real K1, real K2, real K3, real g1, real g2, real g3, real J1, real J2, real J3,
    real D) {
    real t0 = J2 + J3, t1 = R(1) / (D + t0), t2 = J1 + J3, t3 = R(1) / (D + t2), t4 = J1 + J2, t5 = R(1) / (D + t4);
    real t6 = D * (K1 * g1 * t1 + K2 * g2 * t3 + K3 * g3 * t5) / (g1 * g1 * t0 * t1 + g2 * g2 * t2 * t3 + g3 * g3 * t4
        * t5);
    real o_w1 = t1 * (K1 + g1 * t6), o_w2 = t3 * (K2 + g2 * t6), o_w3 = t5 * (K3 + g3 * t6);
    return (t_r3){o_w1, o_w2, o_w3};
}

INLINE real fitted_turn_square(real h, int64_t first, real w1, real w2, real w3) {
    real square = h * h * (w1 * w1 + (w2 * w2 + w3 * w3));
    return square <= R(2.25) * (first * first) ? square : R(0.0);
}

INLINE void lanes_rates(r2 S, int64_t B, int64_t first) {
    real K1, K2, K3, g1, g2, g3, J1, J2, J3, contact, height, m1, m2, m3, x1, x2, x3, d1, d2, d3, along, across, n1,
        n2, n3, whole, square, one;
    t_r3 w1, a1;
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        K1 = AT2(S, 105, b); K2 = AT2(S, 106, b); K3 = AT2(S, 107, b); g1 = AT2(S, 108, b); g2 = AT2(S, 109, b);
        g3 = AT2(S, 110, b); J1 = AT2(S, 131, b); J2 = AT2(S, 132, b); J3 = AT2(S, 133, b); contact = AT2(S, 134, b);
        w1 = kernel_angular_velocity(K1, K2, K3, g1, g2, g3, J1, J2, J3, contact);
        height = contact * (g1 * w1.a0 + g2 * w1.a1 + g3 * w1.a2); m1 = K1 + height * g1; m2 = K2 + height * g2;
        m3 = K3 + height * g3; x1 = m2 * w1.a2 - m3 * w1.a1; x2 = m3 * w1.a0 - m1 * w1.a2;
        x3 = m1 * w1.a1 - m2 * w1.a0; a1 = kernel_angular_velocity(x1, x2, x3, g1, g2, g3, J1, J2, J3, contact);
        d1 = g2 * w1.a2 - g3 * w1.a1; d2 = g3 * w1.a0 - g1 * w1.a2; d3 = g1 * w1.a1 - g2 * w1.a0;
        along = contact * (d1 * a1.a0 + d2 * a1.a1 + d3 * a1.a2);
        across = contact * (g1 * a1.a0 + g2 * a1.a1 + g3 * a1.a2); n1 = (AT2(S, 27, b) + contact) * a1.a0;
        n2 = (AT2(S, 28, b) + contact) * a1.a1; n3 = (AT2(S, 29, b) + contact) * a1.a2;
        x1 = n2 * w1.a2 - n3 * w1.a1 + (m2 * a1.a2 - m3 * a1.a1) + (along * g1 + across * d1);
        x2 = n3 * w1.a0 - n1 * w1.a2 + (m3 * a1.a0 - m1 * a1.a2) + (along * g2 + across * d2);
        x3 = n1 * w1.a1 - n2 * w1.a0 + (m1 * a1.a1 - m2 * a1.a0) + (along * g3 + across * d3);
        t_r3 t_1 = kernel_angular_velocity(x1, x2, x3, g1, g2, g3, J1, J2, J3, contact); x1 = t_1.a0; x2 = t_1.a1;
        x3 = t_1.a2; whole = R(2.0) * AT2(S, 129, b); square = whole * whole; AT2(S, 31, b) = K1; AT2(S, 32, b) = K2;
        AT2(S, 33, b) = K3; AT2(S, 34, b) = g1; AT2(S, 35, b) = g2; AT2(S, 36, b) = g3; AT2(S, 37, b) = w1.a0;
        AT2(S, 38, b) = w1.a1; AT2(S, 39, b) = w1.a2; AT2(S, 40, b) = whole * a1.a0; AT2(S, 41, b) = whole * a1.a1;
        AT2(S, 42, b) = whole * a1.a2; AT2(S, 43, b) = square * x1; AT2(S, 44, b) = square * x2;
        AT2(S, 45, b) = square * x3; AT2(S, 46, b) = fitted_turn_square(whole, first, w1.a0, w1.a1, w1.a2);
        real t_2 = R(0.0), t_3 = R(0.0), t_4 = R(0.0), t_5 = AT2(S, 135, b); AT2(S, 136, b) = t_2;
        AT2(S, 137, b) = t_3; AT2(S, 138, b) = t_4; AT2(S, 58, b) = t_5;
    }
    for (int64_t row = 31; row < 47; row++) {
        INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
            one = AT2(S, row, b); AT2(S, row, B + b) = one; AT2(S, row, 2 * B + b) = one;
            AT2(S, row, 3 * B + b) = one;
        }
    }
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        one = AT2(S, 58, b); AT2(S, 58, B + b) = one; AT2(S, 58, 2 * B + b) = one; AT2(S, 58, 3 * B + b) = one;
    }
}

INLINE real fitted_fitted(real square) {
    real fourth = square * square;
    real last = R(2.7557319223985893e-06) - square * R(2.505210838544172e-08) + fourth * R(1.6059043836821613e-10);
    return R(1.0) - square * R(0.16666666666666666) + fourth * (R(0.008333333333333333) - square *
        R(0.0001984126984126984)) + fourth * fourth * last;
}

INLINE real fitted_half_angle(real square) {
    real fourth = square * square;
    return R(1.0) - square * R(0.25) + fourth * (R(0.020833333333333332) - square * R(0.0006944444444444445) + fourth
        * R(1.240079365079365e-05));
}

INLINE void lanes_start(r2 S, int64_t i, int64_t at) {
    real scale = fitted_fitted(AT2(S, 46, i) * AT2(S, at + 5, i)), half = AT2(S, at, i) * scale;
    real slope = AT2(S, 82, i) + AT2(S, at + 2, i) * scale;
    real bend = fitted_half_angle(AT2(S, 46, i) * AT2(S, at + 5, i)); AT2(S, 83, i) = half / bend;
    real t_1 = half, t_2 = AT2(S, at + 1, i) * bend / scale, t_3 = slope * slope; AT2(S, 22, i) = t_1;
    AT2(S, 23, i) = t_2; AT2(S, 24, i) = t_3; real t_4 = AT2(S, at + 3, i), t_5 = AT2(S, at + 4, i) * (scale * scale);
    AT2(S, 25, i) = t_4; AT2(S, 26, i) = t_5;
    real t_6 = half * AT2(S, 31, i), t_7 = half * AT2(S, 32, i), t_8 = half * AT2(S, 33, i); AT2(S, 0, i) = t_6;
    AT2(S, 1, i) = t_7; AT2(S, 2, i) = t_8; real t_9 = AT2(S, 34, i), t_10 = AT2(S, 35, i), t_11 = AT2(S, 36, i);
    AT2(S, 3, i) = t_9; AT2(S, 4, i) = t_10; AT2(S, 5, i) = t_11; AT2(S, 9, i) = R(0.0); AT2(S, 10, i) = R(0.0);
    AT2(S, 11, i) = R(0.0); AT2(S, 12, i) = R(0.0); AT2(S, 13, i) = R(0.0); AT2(S, 14, i) = R(0.0);
    AT2(S, 15, i) = R(1.0); AT2(S, 16, i) = R(0.0); AT2(S, 17, i) = R(0.0); AT2(S, 18, i) = R(0.0);
    AT2(S, 19, i) = R(0.0); AT2(S, 20, i) = R(0.0); AT2(S, 21, i) = R(0.0);
}

INLINE void lanes_begin(r2 S, int64_t B) {
    real tangent, a, b, c;
    INDEPENDENT for (int64_t i = 0, end_i = 4 * B; i < end_i; i++) {
        lanes_start(S, i, 59); tangent = AT2(S, 83, i); a = AT2(S, 79, i); b = AT2(S, 80, i); c = AT2(S, 81, i);
        AT2(S, 6, i) = tangent * (a * AT2(S, 37, i) + b * AT2(S, 40, i) + c * AT2(S, 43, i));
        AT2(S, 7, i) = tangent * (a * AT2(S, 38, i) + b * AT2(S, 41, i) + c * AT2(S, 44, i));
        AT2(S, 8, i) = tangent * (a * AT2(S, 39, i) + b * AT2(S, 42, i) + c * AT2(S, 45, i));
    }
}

INLINE void lanes_finish(r2 S, int64_t i) {
    real t_1 = AT2(S, 15, i), t_2 = AT2(S, 16, i), t_3 = AT2(S, 17, i), t_4 = AT2(S, 18, i); AT2(S, 87, i) = t_1;
    AT2(S, 88, i) = t_2; AT2(S, 89, i) = t_3; AT2(S, 90, i) = t_4;
    real t_5 = AT2(S, 19, i), t_6 = AT2(S, 20, i), t_7 = AT2(S, 21, i); AT2(S, 91, i) = t_5; AT2(S, 92, i) = t_6;
    AT2(S, 93, i) = t_7;
}

INLINE void lanes_begin_second(r2 S, int64_t B, int64_t lane, r2 weights) {
    int64_t i, j, k, m; real tangent, x1, x2, x3;
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) { lanes_start(S, lane * B + b, 65); }
    real w0 = AT2(weights, lane, 0), w1 = AT2(weights, lane, 1), w2 = AT2(weights, lane, 2);
    real w3 = AT2(weights, lane, 3), w4 = AT2(weights, lane, 4), w5 = AT2(weights, lane, 5);
    real w6 = AT2(weights, lane, 6), w7 = AT2(weights, lane, 7);
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        i = b; j = B + b; k = 2 * B + b; m = 3 * B + b; tangent = AT2(S, 83, lane * B + b);
        x1 = w0 * AT2(S, 37, i) + w1 * AT2(S, 40, i) + (w2 * AT2(S, 43, i) + w3 * AT2(S, 84, i));
        x2 = w0 * AT2(S, 38, i) + w1 * AT2(S, 41, i) + (w2 * AT2(S, 44, i) + w3 * AT2(S, 85, i));
        x3 = w0 * AT2(S, 39, i) + w1 * AT2(S, 42, i) + (w2 * AT2(S, 45, i) + w3 * AT2(S, 86, i));
        x1 = x1 + (w4 * AT2(S, 84, j) + w5 * AT2(S, 84, k) + (w6 * AT2(S, 84, m) + w7 * AT2(S, 136, i)));
        x2 = x2 + (w4 * AT2(S, 85, j) + w5 * AT2(S, 85, k) + (w6 * AT2(S, 85, m) + w7 * AT2(S, 137, i)));
        x3 = x3 + (w4 * AT2(S, 86, j) + w5 * AT2(S, 86, k) + (w6 * AT2(S, 86, m) + w7 * AT2(S, 138, i)));
        AT2(S, 6, lane * B + b) = tangent * x1; AT2(S, 7, lane * B + b) = tangent * x2;
        AT2(S, 8, lane * B + b) = tangent * x3;
    }
}

INLINE int64_t lanes_checked(r2 S, int64_t B, int again) {
    real k1, k2, k3, g1, g2, g3, u1, u2, u3, I1, I2, I3, contact, squares, p0, first, bent; Round r; t_r7 p1;
    int settled, closed;
    INDEPENDENT for (int64_t i = 0, end_i = 4 * B; i < end_i; i++) {
        k1 = AT2(S, 0, i); k2 = AT2(S, 1, i); k3 = AT2(S, 2, i); g1 = AT2(S, 3, i); g2 = AT2(S, 4, i);
        g3 = AT2(S, 5, i); u1 = AT2(S, 6, i); u2 = AT2(S, 7, i); u3 = AT2(S, 8, i); I1 = AT2(S, 27, i);
        I2 = AT2(S, 28, i); I3 = AT2(S, 29, i); contact = AT2(S, 30, i);
        if (!again) {
            r = gibbs_newton_round(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, contact, 0); u1 = r.w1; u2 = r.w2;
            u3 = r.w3;
        }
        r = gibbs_newton_round(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, contact, 0);
        p1 = gibbs_second_round(r, k1, k2, k3, I1, I2, I3);
        squares = r.c11 * r.c11 + r.c12 * r.c12 + r.c13 * r.c13 + (r.c21 * r.c21 + r.c22 * r.c22 + r.c23 * r.c23);
        p0 = r.p0; first = r.first;
        bent = AT2(S, 24, i) * (squares + (r.c31 * r.c31 + r.c32 * r.c32 + r.c33 * r.c33));
        settled = (p0 > R(0.0)) & (p1.a3 * p1.a3 + (p1.a4 * p1.a4 + p1.a5 * p1.a5) <= AT2(S, 25, i));
        settled = settled & (bent * first <= R(0.015625) * (p0 * p0));
        settled = settled & (bent * (max_r(first, p1.a6) * p1.a6) <= AT2(S, 26, i) * (p0 * p0));
        closed = again & (AT2(S, 57, i) == R(0.0));
        real t_1 = closed ? AT2(S, 53, i) : p0, t_2 = closed ? AT2(S, 54, i) : p1.a0; AT2(S, 53, i) = t_1;
        AT2(S, 54, i) = t_2; real t_3 = closed ? AT2(S, 55, i) : p1.a1, t_4 = closed ? AT2(S, 56, i) : p1.a2;
        AT2(S, 55, i) = t_3; AT2(S, 56, i) = t_4;
        real t_5 = closed ? AT2(S, 6, i) : p1.a3, t_6 = closed ? AT2(S, 7, i) : p1.a4; AT2(S, 6, i) = t_5;
        AT2(S, 7, i) = t_6; AT2(S, 8, i) = closed ? AT2(S, 8, i) : p1.a5;
        AT2(S, 57, i) = ((closed | settled) | (AT2(S, 58, i) != R(0.0))) ? R(0.0) : R(1.0);
    }
    int64_t left = 0;
    INDEPENDENT for (int64_t i = 0, end_i = 4 * B; i < end_i; i++) {
        left = left + (AT2(S, 57, i) != R(0.0) ? 1 : 0);
    }
    return left;
}

INLINE void lanes_lose(r2 S, int64_t B) {
    int is_open;
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        is_open = AT2(S, 57, b) + AT2(S, 57, B + b) + (AT2(S, 57, 2 * B + b) + AT2(S, 57, 3 * B + b)) != R(0.0);
        for (int64_t lane = 0; lane < 4; lane++) {
            AT2(S, 58, lane * B + b) = is_open ? R(1.0) : AT2(S, 58, lane * B + b);
        }
    }
}

INLINE void lanes_moved(r2 S, int64_t B, int traced) {
    real p0, p1, p2, p3, w1, w2, w3, scale, s1, s2, s3, x1, x2, x3, v1, v2, v3, d, e, f, a, b, c, tangent, y1, y2, y3;
    INDEPENDENT for (int64_t i = 0, end_i = 4 * B; i < end_i; i++) {
        p0 = AT2(S, 53, i); p1 = AT2(S, 54, i); p2 = AT2(S, 55, i); p3 = AT2(S, 56, i); w1 = AT2(S, 6, i);
        w2 = AT2(S, 7, i); w3 = AT2(S, 8, i);
        if (traced) {
            scale = R(1.0) / (R(1.0) + (w1 * w1 + (w2 * w2 + w3 * w3)));
            t_r3 t_1 = kernel_centre_step(R(1.0), w1, w2, w3, AT2(S, 3, i), AT2(S, 4, i), AT2(S, 5, i)); s1 = t_1.a0;
            s2 = t_1.a1; s3 = t_1.a2; s1 = scale * s1; s2 = scale * s2; s3 = scale * s3;
            t_r3 t_2 = kernel_turn(AT2(S, 15, i), -AT2(S, 16, i), -AT2(S, 17, i), -AT2(S, 18, i), s1, s2, s3);
            x1 = t_2.a0; x2 = t_2.a1; x3 = t_2.a2; AT2(S, 19, i) = AT2(S, 19, i) + (s1 + x1);
            AT2(S, 20, i) = AT2(S, 20, i) + (s2 + x2); AT2(S, 21, i) = AT2(S, 21, i) + (s3 + x3);
        }
        t_r3 t_3 = kernel_turn(p0, p1, p2, p3, AT2(S, 0, i), AT2(S, 1, i), AT2(S, 2, i)); x1 = t_3.a0; x2 = t_3.a1;
        x3 = t_3.a2; AT2(S, 0, i) = AT2(S, 0, i) + x1; AT2(S, 1, i) = AT2(S, 1, i) + x2;
        AT2(S, 2, i) = AT2(S, 2, i) + x3;
        t_r3 t_4 = kernel_turn(p0, p1, p2, p3, AT2(S, 3, i), AT2(S, 4, i), AT2(S, 5, i)); x1 = t_4.a0; x2 = t_4.a1;
        x3 = t_4.a2; AT2(S, 3, i) = AT2(S, 3, i) + x1; AT2(S, 4, i) = AT2(S, 4, i) + x2;
        AT2(S, 5, i) = AT2(S, 5, i) + x3;
        t_r4 t_5 = kernel_compose(AT2(S, 15, i), AT2(S, 16, i), AT2(S, 17, i), AT2(S, 18, i), R(1.0), w1, w2, w3);
        AT2(S, 15, i) = t_5.a0; AT2(S, 16, i) = t_5.a1; AT2(S, 17, i) = t_5.a2; AT2(S, 18, i) = t_5.a3;
        v1 = AT2(S, 9, i); v2 = AT2(S, 10, i); v3 = AT2(S, 11, i); x1 = AT2(S, 12, i); x2 = AT2(S, 13, i);
        x3 = AT2(S, 14, i); AT2(S, 9, i) = w1; AT2(S, 10, i) = w2; AT2(S, 11, i) = w3; AT2(S, 12, i) = v1;
        AT2(S, 13, i) = v2; AT2(S, 14, i) = v3; d = AT2(S, 47, i); e = AT2(S, 48, i); f = AT2(S, 49, i);
        a = AT2(S, 50, i); b = AT2(S, 51, i); c = AT2(S, 52, i); tangent = AT2(S, 83, i);
        y1 = d * AT2(S, 37, i) + e * AT2(S, 40, i) + f * AT2(S, 43, i);
        y2 = d * AT2(S, 38, i) + e * AT2(S, 41, i) + f * AT2(S, 44, i);
        y3 = d * AT2(S, 39, i) + e * AT2(S, 42, i) + f * AT2(S, 45, i);
        AT2(S, 6, i) = a * w1 + b * v1 + (c * x1 + tangent * y1);
        AT2(S, 7, i) = a * w2 + b * v2 + (c * x2 + tangent * y2);
        AT2(S, 8, i) = a * w3 + b * v3 + (c * x3 + tangent * y3);
    }
}

INLINE t_r12 long_step_moved_body(real k1, real k2, real k3, real g1, real g2, real g3, real a0, real a1, real a2,
    real a3, real x, real y, real q0, real q1, real q2, real q3, real y1, real y2, real y3, real radius) {
    t_r3 t_1 = kernel_turn(q0, q1, q2, q3, k1, k2, k3); real d1 = t_1.a0, d2 = t_1.a1, d3 = t_1.a2; k1 = k1 + d1;
    k2 = k2 + d2; k3 = k3 + d3; t_r3 t_2 = kernel_turn(q0, q1, q2, q3, g1, g2, g3); d1 = t_2.a0; d2 = t_2.a1;
    d3 = t_2.a2; g1 = g1 + d1; g2 = g2 + d2; g3 = g3 + d3; t_r3 t_3 = kernel_rotate(a0, a1, a2, a3, y1, y2, y3);
    d1 = t_3.a0; d2 = t_3.a1; x = x + radius * d1; y = y + radius * d2;
    t_r4 t_4 = kernel_compose(a0, a1, a2, a3, q0, q1, q2, q3); a0 = t_4.a0; a1 = t_4.a1; a2 = t_4.a2; a3 = t_4.a3;
    real scale = R(1.0) / R(sqrt(a0 * a0 + a1 * a1 + (a2 * a2 + a3 * a3)));
    return (t_r12){k1, k2, k3, g1, g2, g3, a0 * scale, a1 * scale, a2 * scale, a3 * scale, x, y};
}

INLINE void lanes_gather(r2 S, int64_t B) {
    real a0, a1, a2, a3, b0, b1, b2, b3, one, two, w, v, k1, k2, k3, g1, g2, g3, x, y, d0, d1, d2, d3, more, l1, l2,
        l3, h1, h2, h3;
    int rests;
    INDEPENDENT for (int64_t i = 0, end_i = 4 * B; i < end_i; i++) {
        a0 = AT2(S, 87, i); a1 = AT2(S, 88, i); a2 = AT2(S, 89, i); a3 = AT2(S, 90, i); b0 = AT2(S, 15, i);
        b1 = AT2(S, 16, i); b2 = AT2(S, 17, i); b3 = AT2(S, 18, i);
        one = R(1.0) / R(sqrt(a0 * a0 + a1 * a1 + (a2 * a2 + a3 * a3)));
        two = R(1.0) / R(sqrt(b0 * b0 + b1 * b1 + (b2 * b2 + b3 * b3))); w = AT2(S, 71, i) * one;
        v = AT2(S, 72, i) * two; AT2(S, 94, i) = w * a0 + v * b0; AT2(S, 95, i) = w * a1 + v * b1;
        AT2(S, 96, i) = w * a2 + v * b2; AT2(S, 97, i) = w * a3 + v * b3; w = AT2(S, 73, i) * one;
        v = AT2(S, 74, i) * two; AT2(S, 98, i) = w * a0 + v * b0; AT2(S, 99, i) = w * a1 + v * b1;
        AT2(S, 100, i) = w * a2 + v * b2; AT2(S, 101, i) = w * a3 + v * b3; w = AT2(S, 71, i); v = AT2(S, 72, i);
        AT2(S, 102, i) = w * AT2(S, 91, i) + v * AT2(S, 19, i);
        AT2(S, 103, i) = w * AT2(S, 92, i) + v * AT2(S, 20, i);
        AT2(S, 104, i) = w * AT2(S, 93, i) + v * AT2(S, 21, i);
    }
    for (int64_t c = 0; c < 11; c++) {
        INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
            AT2(S, 94 + c, b) = AT2(S, 94 + c, b) + AT2(S, 94 + c, B + b) + (AT2(S, 94 + c, 2 * B + b) + AT2(S, 94 +
                c, 3 * B + b));
        }
    }
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        rests = AT2(S, 58, b) != R(0.0); k1 = AT2(S, 105, b); k2 = AT2(S, 106, b); k3 = AT2(S, 107, b);
        g1 = AT2(S, 108, b); g2 = AT2(S, 109, b); g3 = AT2(S, 110, b); a0 = AT2(S, 111, b); a1 = AT2(S, 112, b);
        a2 = AT2(S, 113, b); a3 = AT2(S, 114, b); x = AT2(S, 115, b); y = AT2(S, 116, b); d0 = AT2(S, 98, b);
        d1 = AT2(S, 99, b); d2 = AT2(S, 100, b); d3 = AT2(S, 101, b);
        more = R(2.0) * R(sqrt(d0 * d0 + d1 * d1 + (d2 * d2 + d3 * d3)));
        t_r12 t_1 = long_step_moved_body(k1, k2, k3, g1, g2, g3, a0, a1, a2, a3, x, y, AT2(S, 94, b), AT2(S, 95, b),
            AT2(S, 96, b), AT2(S, 97, b), AT2(S, 102, b), AT2(S, 103, b), AT2(S, 104, b), AT2(S, 130, b));
        l1 = t_1.a0; l2 = t_1.a1; l3 = t_1.a2; h1 = t_1.a3; h2 = t_1.a4; h3 = t_1.a5; b0 = t_1.a6; b1 = t_1.a7;
        b2 = t_1.a8; b3 = t_1.a9; v = t_1.a10; w = t_1.a11; AT2(S, 105, b) = rests ? k1 : l1;
        AT2(S, 106, b) = rests ? k2 : l2; AT2(S, 107, b) = rests ? k3 : l3; AT2(S, 108, b) = rests ? g1 : h1;
        AT2(S, 109, b) = rests ? g2 : h2; AT2(S, 110, b) = rests ? g3 : h3; AT2(S, 111, b) = rests ? a0 : b0;
        AT2(S, 112, b) = rests ? a1 : b1; AT2(S, 113, b) = rests ? a2 : b2; AT2(S, 114, b) = rests ? a3 : b3;
        AT2(S, 115, b) = rests ? x : v; AT2(S, 116, b) = rests ? y : w;
        AT2(S, 117, b) = AT2(S, 117, b) + (rests ? R(0.0) : more);
    }
}

INLINE int lanes_side_by_side(r2 S, int64_t B, int64_t columns, int traced, r3 following, r2 beginning) {
    int64_t lane, left, rounds, i; real weight; int64_t first = 8 - columns, second = 3; lanes_rates(S, B, first);
    lanes_begin(S, B); int lost = 0;
    for (int64_t slot = 0; slot < 7; slot++) {
        lane = 7 - slot;
        if (lane < 4) {
            INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) { lanes_finish(S, lane * B + b); }
        }
        if (lane == 3 && first <= 3) { lanes_begin_second(S, B, 3, beginning); }
        else {
            if (lane == 2 && first <= 2) { lanes_begin_second(S, B, 2, beginning); }
        }
        for (int64_t j = 0; j < 6; j++) {
            for (int64_t c = 0; c < 4; c++) {
                weight = AT3(following, slot, j, c);
                INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) { AT2(S, 47 + j, c * B + b) = weight; }
            }
        }
        left = lanes_checked(S, B, 0); rounds = 0;
        while (left > 0 && rounds < 6) { left = lanes_checked(S, B, 1); rounds = rounds + 1; }
        if (left > 0) {
            lost = 1; lanes_lose(S, B);
            if (B == 1) { return 1; }
        }
        if (traced) { lanes_moved(S, B, 1); }
        else { lanes_moved(S, B, 0); }
        if (slot == 0) {
            INDEPENDENT for (int64_t i = 0, end_i = 4 * B; i < end_i; i++) {
                real t_1 = AT2(S, 9, i) * AT2(S, 23, i), t_2 = AT2(S, 10, i) * AT2(S, 23, i); AT2(S, 84, i) = t_1;
                AT2(S, 85, i) = t_2; AT2(S, 86, i) = AT2(S, 11, i) * AT2(S, 23, i);
            }
        }
        else {
            if (lane == second && lane < 4) {
                INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
                    i = lane * B + b; real t_3 = AT2(S, 9, i) * AT2(S, 23, i), t_4 = AT2(S, 10, i) * AT2(S, 23, i);
                    AT2(S, 136, b) = t_3; AT2(S, 137, b) = t_4; AT2(S, 138, b) = AT2(S, 11, i) * AT2(S, 23, i);
                }
            }
        }
    }
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) { lanes_finish(S, b); }
    lanes_gather(S, B); return lost;
}

INLINE t_ir8 long_step_column(r1 body, real half, int64_t n, real square, r1 state) {
    int settled; real p0, p1, p2, p3, w1, w2, w3, reach, scale, s1, s2, s3, d1, d2, d3; int64_t status;
    real part = half / n * fitted_fitted(square * (R(1.0) / (n * n))), k1 = part * body.p[0], k2 = part * body.p[1];
    real k3 = part * body.p[2]; t_r3 t_1 = loop_three(body, 3); real g1 = t_1.a0, g2 = t_1.a1, g3 = t_1.a2;
    t_r3 I1 = loop_three(state, 21); t_r2 t_2 = gibbs_certificate(k1, k2, k3, I1.a0, I1.a1, I1.a2, state.p[24]);
    state.p[25] = t_2.a0; state.p[26] = t_2.a1;
    t_r3 t_3 = kernel_angular_velocity(k1, k2, k3, g1, g2, g3, state.p[18], state.p[19], state.p[20], state.p[24]);
    real u1 = t_3.a0, u2 = t_3.a1, u3 = t_3.a2, v1 = u1, v2 = u2, v3 = u3, q0 = R(1.0), q1 = R(0.0), q2 = R(0.0);
    real q3 = R(0.0), y1 = R(0.0), y2 = R(0.0), y3 = R(0.0);
    for (int64_t i_0 = 0, end_i_0 = n; i_0 < end_i_0; i_0++) {
        t_br7 t_4 = gibbs_settle(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1.a0, I1.a1, I1.a2, state.p[24], state.p[25],
            state.p[26], 0);
        settled = t_4.a0; p0 = t_4.a1; p1 = t_4.a2; p2 = t_4.a3; p3 = t_4.a4; w1 = t_4.a5; w2 = t_4.a6; w3 = t_4.a7;
        if (!settled) {
            loop_put(state, 0, k1, k2, k3); loop_put(state, 3, g1, g2, g3);
            t_ir8 t_5 = loop_safe_rotation(w1, w2, w3, state); status = t_5.a0; reach = t_5.a1; p0 = t_5.a2;
            p1 = t_5.a3; p2 = t_5.a4; p3 = t_5.a5; w1 = t_5.a6; w2 = t_5.a7; w3 = t_5.a8;
            if (status != 0) { return (t_ir8){status, reach, q0, q1, q2, q3, y1, y2, y3}; }
        }
        square = p0 * p0 + p1 * p1 + (p2 * p2 + p3 * p3);
        if (!(square > R(0.0))) { return (t_ir8){2, R(0.0), q0, q1, q2, q3, y1, y2, y3}; }
        scale = R(1.0) / R(sqrt(square));
        t_r3 t_6 = kernel_centre_step(p0 * scale, p1 * scale, p2 * scale, p3 * scale, g1, g2, g3); s1 = t_6.a0;
        s2 = t_6.a1; s3 = t_6.a2; t_r3 t_7 = kernel_rotate(q0, q1, q2, q3, s1, s2, s3); s1 = t_7.a0; s2 = t_7.a1;
        s3 = t_7.a2; y1 = y1 + s1; y2 = y2 + s2; y3 = y3 + s3; t_r3 t_8 = kernel_turn(p0, p1, p2, p3, k1, k2, k3);
        d1 = t_8.a0; d2 = t_8.a1; d3 = t_8.a2; k1 = k1 + d1; k2 = k2 + d2; k3 = k3 + d3;
        t_r3 t_9 = kernel_turn(p0, p1, p2, p3, g1, g2, g3); d1 = t_9.a0; d2 = t_9.a1; d3 = t_9.a2; g1 = g1 + d1;
        g2 = g2 + d2; g3 = g3 + d3;
        t_r4 t_10 = kernel_compose(q0, q1, q2, q3, p0 * scale, p1 * scale, p2 * scale, p3 * scale); q0 = t_10.a0;
        q1 = t_10.a1; q2 = t_10.a2; q3 = t_10.a3; u1 = R(2.0) * w1 - v1; u2 = R(2.0) * w2 - v2; u3 = R(2.0) * w3 - v3;
        v1 = w1; v2 = w2; v3 = w3;
    }
    return (t_ir8){0, R(1.0), q0, q1, q2, q3, y1, y2, y3};
}

INLINE t_r3 long_step_twist(real q0, real q1, real q2, real q3, real d0, real d1, real d2, real d3) {
    t_r4 x = kernel_compose(q0, -q1, -q2, -q3, d0, d1, d2, d3);
    return (t_r3){R(2.0) * x.a1, R(2.0) * x.a2, R(2.0) * x.a3};
}

INLINE t_ir long_step_long_step(r1 body, real half, real radius, r2 sums, r1 state) {
    t_ir8 status; real w, v, d0, d1, d2, d3; int64_t at; real q0 = R(0.0), q1 = R(0.0), q2 = R(0.0), q3 = R(0.0);
    ALIGNED real changes_[3 * 4]; memset(changes_, 0, sizeof changes_); r2 changes = {changes_, 3, 4, 4};
    real y1 = R(0.0), y2 = R(0.0), y3 = R(0.0), z1 = R(0.0), z2 = R(0.0), z3 = R(0.0);
    t_r3 w1 = kernel_angular_velocity(body.p[0], body.p[1], body.p[2], body.p[3], body.p[4], body.p[5], state.p[18],
        state.p[19], state.p[20], state.p[24]);
    int64_t first = 8 - sums.n1; real square = fitted_turn_square(R(2.0) * half, first, w1.a0, w1.a1, w1.a2);
    for (int64_t i = 0, end_i = sums.n1; i < end_i; i++) {
        status = long_step_column(body, half, first + i, square, state);
        if (status.a0 != 0) { return (t_ir){status.a0, status.a1}; }
        w = AT2(sums, 0, i); v = AT2(sums, 1, i); q0 = q0 + w * status.a2; q1 = q1 + w * status.a3;
        q2 = q2 + w * status.a4; q3 = q3 + w * status.a5; y1 = y1 + w * status.a6; y2 = y2 + w * status.a7;
        y3 = y3 + w * status.a8; z1 = z1 + v * status.a6; z2 = z2 + v * status.a7; z3 = z3 + v * status.a8;
        for (int64_t c = 0; c < 3; c++) {
            w = AT2(sums, 1 + c, i);
            real t_1 = AT2(changes, c, 0) + w * status.a2, t_2 = AT2(changes, c, 1) + w * status.a3;
            AT2(changes, c, 0) = t_1; AT2(changes, c, 1) = t_2;
            real t_3 = AT2(changes, c, 2) + w * status.a4, t_4 = AT2(changes, c, 3) + w * status.a5;
            AT2(changes, c, 2) = t_3; AT2(changes, c, 3) = t_4;
        }
    }
    t_r3 t_5 = kernel_rotate(body.p[6], body.p[7], body.p[8], body.p[9], z1, z2, z3); body.p[22] = t_5.a0;
    body.p[23] = t_5.a1;
    t_r12 t_6 = long_step_moved_body(body.p[0], body.p[1], body.p[2], body.p[3], body.p[4], body.p[5], body.p[6],
        body.p[7], body.p[8], body.p[9], body.p[10], body.p[11], q0, q1, q2, q3, y1, y2, y3, radius);
    body.p[0] = t_6.a0; body.p[1] = t_6.a1; body.p[2] = t_6.a2; body.p[3] = t_6.a3; body.p[4] = t_6.a4;
    body.p[5] = t_6.a5; body.p[6] = t_6.a6; body.p[7] = t_6.a7; body.p[8] = t_6.a8; body.p[9] = t_6.a9;
    body.p[10] = t_6.a10; body.p[11] = t_6.a11;
    for (int64_t c = 0; c < 3; c++) {
        d0 = AT2(changes, c, 0); d1 = AT2(changes, c, 1); d2 = AT2(changes, c, 2); d3 = AT2(changes, c, 3);
        if (c == 0) { body.p[12] = body.p[12] + R(2.0) * R(sqrt(d0 * d0 + d1 * d1 + (d2 * d2 + d3 * d3))); }
        at = 13 + 3 * c; t_r3 t_7 = long_step_twist(q0, q1, q2, q3, d0, d1, d2, d3); body.p[at] = t_7.a0;
        body.p[at + 1] = t_7.a1; body.p[at + 2] = t_7.a2;
    }
    return (t_ir){0, R(1.0)};
}

OUT_OF_LINE t_ir long_run_safely(r2 S, int64_t b, r2 sums, r1 state) {
    ALIGNED real body_[24]; r1 body = {body_, 24};
    for (int64_t c = 0; c < 24; c++) { body.p[c] = AT2(S, 105 + c, b); }
    t_ir status = long_step_long_step(body, AT2(S, 129, b), AT2(S, 130, b), sums, state);
    for (int64_t c = 0; c < 24; c++) { AT2(S, 105 + c, b) = body.p[c]; }
    return (t_ir){status.a0, status.a1};
}

INLINE void long_run_show(r2 S, int64_t b, int64_t exponent, int64_t frame, r3 momenta, r3 verticals, r3 attitudes, r3
    traces, int follows, int going) {
    for (int64_t c = 0; c < 3; c++) {
        AT3(momenta, b, frame, c) = going ? R(ldexp(AT2(S, 105 + c, b), (int)(int64_t)exponent)) : R(NAN);
        AT3(verticals, b, frame, c) = going ? AT2(S, 108 + c, b) : R(NAN);
    }
    if (follows) {
        for (int64_t c = 0; c < 4; c++) { AT3(attitudes, b, frame, c) = going ? AT2(S, 111 + c, b) : R(NAN); }
        for (int64_t c = 0; c < 2; c++) { AT3(traces, b, frame, c) = going ? AT2(S, 115 + c, b) : R(NAN); }
    }
}

INLINE void long_run_march_lanes(int64_t B, r3 momenta, r3 verticals, r3 attitudes, r3 traces, r2 J0, r1 D0, r1
    radius, real h, int64_t steps, int64_t every, int follows, int traced, r2 sums, r3 following, r2 beginning, r1
    doubt, i1 taken, i1 status, d1 reach) {
    int64_t i; t_ir stopped; ALIGNED real S_[139 * (4 * B)]; memset(S_, 0, sizeof S_);
    r2 S = {S_, 139, (4 * B), (4 * B)}; int64_t columns = sums.n1; ALIGNED real states_[B * 27];
    memset(states_, 0, sizeof states_); r2 states = {states_, B, 27, 27}; ALIGNED int64_t exponents_[B];
    memset(exponents_, 0, sizeof exponents_); i1 exponents = {exponents_, B}; ALIGNED real body_[24];
    memset(body_, 0, sizeof body_); r1 body = {body_, 24}; int64_t balls = status.n0;
    for (int64_t b = 0, end_b = B; b < end_b; b++) {
        i = min_i(b, balls - 1); long_run_placed(body, i, momenta, verticals, attitudes, traces, follows, traced);
        exponents.p[b] = long_run_enter(S, B, b, columns, r2_row(J0, i), D0.p[i], radius.p[i], h, sums, beginning,
            body, r2_row(states, b));
    }
    for (int64_t step = 0, end_step = steps; step < end_step; step++) {
        if (lanes_side_by_side(S, B, columns, traced, following, beginning)) {
            for (int64_t b = 0, end_b = B; b < end_b; b++) {
                if (AT2(S, 58, b) != R(0.0) && AT2(S, 135, b) == R(0.0)) {
                    stopped = long_run_safely(S, b, sums, r2_row(states, b));
                    if (stopped.a0 != 0) {
                        AT2(S, 135, b) = R(1.0);
                        if (b < balls) { status.p[b] = stopped.a0; reach.p[b] = stopped.a1; taken.p[b] = step; }
                    }
                }
            }
        }
        if (mod_i(step + 1, every) == 0) {
            for (int64_t b = 0, end_b = balls; b < end_b; b++) {
                long_run_show(S, b, exponents.p[b], div_i(step + 1, every), momenta, verticals, attitudes, traces,
                    follows, status.p[b] == 0);
            }
        }
    }
    for (int64_t b = 0, end_b = balls; b < end_b; b++) {
        doubt.p[b] = status.p[b] == 0 ? AT2(S, 117, b) : R(NAN);
        if (status.p[b] == 0) { taken.p[b] = steps; reach.p[b] = R(1.0); }
    }
}

INLINE void long_run_march_one(r3 momenta, r3 verticals, r3 attitudes, r3 traces, r2 J0, r1 D0, r1 radius, real h,
    int64_t steps, int64_t every, int follows, int traced, r2 sums, r3 following, r2 beginning, r1 doubt, i1 taken, i1
    status, d1 reach) {
    long_run_march_lanes(1, momenta, verticals, attitudes, traces, J0, D0, radius, h, steps, every, follows, traced,
        sums, following, beginning, doubt, taken, status, reach);
}

INLINE void long_run_march_eight(r3 momenta, r3 verticals, r3 attitudes, r3 traces, r2 J0, r1 D0, r1 radius, real h,
    int64_t steps, int64_t every, int follows, int traced, r2 sums, r3 following, r2 beginning, r1 doubt, i1 taken, i1
    status, d1 reach) {
    long_run_march_lanes(8, momenta, verticals, attitudes, traces, J0, D0, radius, h, steps, every, follows, traced,
        sums, following, beginning, doubt, taken, status, reach);
}

INLINE void rotation_n_guess(r3 past, r1 use, r2 E) {
    real z; int64_t n = E.n0;
    for (int64_t i = 0, end_i = n; i < end_i; i++) {
        for (int64_t j = 0, end_j = n; j < end_j; j++) {
            z = use.p[7] * AT3(past, 7, i, j);
            for (int64_t m = 6, end_m = -1; m > end_m; m--) { z = z + use.p[m] * AT3(past, m, i, j); }
            AT2(E, i, j) = z;
        }
    }
}

INLINE real rotation_n_polish(r2 E, r2 W, r1 v) {
    real z; int64_t n = E.n0; real far = R(0.0);
    for (int64_t i = 0, end_i = n; i < end_i; i++) {
        for (int64_t j = 0, end_j = i + 1; j < end_j; j++) {
            z = AT2(E, i, j) + AT2(E, j, i);
            for (int64_t m = 0, end_m = n; m < end_m; m++) { z = z + AT2(E, m, i) * AT2(E, m, j); }
            AT2(W, i, j) = z; AT2(W, j, i) = z; far = far + z * z;
        }
    }
    for (int64_t i = 0, end_i = n; i < end_i; i++) {
        for (int64_t j = 0, end_j = n; j < end_j; j++) {
            z = AT2(W, i, j);
            for (int64_t m = 0, end_m = n; m < end_m; m++) { z = z + AT2(E, i, m) * AT2(W, m, j); }
            v.p[j] = z;
        }
        for (int64_t j = 0, end_j = n; j < end_j; j++) { AT2(E, i, j) = AT2(E, i, j) - R(0.5) * v.p[j]; }
    }
    return far;
}

INLINE void rotation_n_gap(r2 E, r2 k, r1 g, r1 J, real D, r1 c, r1 r) {
    real z; int64_t n = E.n0;
    for (int64_t i = 0, end_i = n; i < end_i; i++) {
        z = (AT2(E, i, 0) - AT2(E, 0, i)) * g.p[0];
        for (int64_t j = 1, end_j = n; j < end_j; j++) { z = z + (AT2(E, i, j) - AT2(E, j, i)) * g.p[j]; }
        c.p[i] = R(0.5) * D * z;
    }
    int64_t p = 0;
    for (int64_t i = 1, end_i = n; i < end_i; i++) {
        for (int64_t j = 0, end_j = i; j < end_j; j++) {
            r.p[p] = AT2(k, i, j) - (AT2(E, i, j) * J.p[j] + c.p[i] * g.p[j] - (AT2(E, j, i) * J.p[i] + c.p[j] *
                g.p[i]));
            p = p + 1;
        }
    }
}

INLINE void rotation_n_slope(r2 E, r1 g, r1 J, real D, r2 O, r1 h, r1 c, r2 T) {
    real z, dq, dp; int64_t row; int64_t n = E.n0;
    for (int64_t i = 0, end_i = n; i < end_i; i++) {
        for (int64_t j = 0, end_j = n; j < end_j; j++) { AT2(O, i, j) = AT2(E, i, j) + (i == j ? R(1.0) : R(0.0)); }
    }
    for (int64_t i = 0, end_i = n; i < end_i; i++) {
        z = AT2(O, 0, i) * g.p[0];
        for (int64_t m = 1, end_m = n; m < end_m; m++) { z = z + AT2(O, m, i) * g.p[m]; }
        h.p[i] = R(0.5) * D * z;
    }
    int64_t at = 0;
    for (int64_t p = 1, end_p = n; p < end_p; p++) {
        for (int64_t q = 0, end_q = p; q < end_q; q++) {
            dq = R(0.5) * D * g.p[q]; dp = R(0.5) * D * g.p[p];
            for (int64_t i = 0, end_i = n; i < end_i; i++) { c.p[i] = AT2(O, i, p) * dq - AT2(O, i, q) * dp; }
            c.p[q] = c.p[q] - h.p[p]; c.p[p] = c.p[p] + h.p[q]; row = 0;
            for (int64_t i = 1, end_i = n; i < end_i; i++) {
                for (int64_t j = 0, end_j = i; j < end_j; j++) {
                    AT2(T, at, row) = c.p[i] * g.p[j] - c.p[j] * g.p[i]; row = row + 1;
                }
            }
            for (int64_t i = 0, end_i = n; i < end_i; i++) {
                if (i != q) {
                    row = i > q ? div_i(i * (i - 1), 2) + q : div_i(q * (q - 1), 2) + i; z = AT2(O, i, p) * J.p[q];
                    AT2(T, at, row) = AT2(T, at, row) + (i > q ? z : -z);
                }
                if (i != p) {
                    row = i > p ? div_i(i * (i - 1), 2) + p : div_i(p * (p - 1), 2) + i; z = AT2(O, i, q) * J.p[p];
                    AT2(T, at, row) = AT2(T, at, row) - (i > p ? z : -z);
                }
            }
            at = at + 1;
        }
    }
}

INLINE void rotation_n_solve(r2 T, r1 r) {
    real inverse, f, z; int64_t size = r.n0;
    for (int64_t k = 0, end_k = size; k < end_k; k++) {
        inverse = R(1.0) / AT2(T, k, k);
        for (int64_t i = k + 1, end_i = size; i < end_i; i++) {
            f = AT2(T, i, k) * inverse; AT2(T, i, k) = f;
            for (int64_t j = k + 1, end_j = size; j < end_j; j++) { AT2(T, i, j) = AT2(T, i, j) - f * AT2(T, k, j); }
        }
        z = r.p[k] * inverse; r.p[k] = z;
        for (int64_t j = k + 1, end_j = size; j < end_j; j++) { r.p[j] = r.p[j] - z * AT2(T, k, j); }
    }
    for (int64_t i = size - 1; i > 0; i--) {
        for (int64_t j = 0, end_j = i; j < end_j; j++) { r.p[j] = r.p[j] - r.p[i] * AT2(T, i, j); }
    }
}

INLINE t_r2 rotation_n_turn(r2 E, r1 r, r2 O, r2 W, r1 v) {
    real z; int64_t n = E.n0, p = 0; real change = R(0.0), size = R(0.0);
    for (int64_t i = 0, end_i = n; i < end_i; i++) {
        AT2(O, i, i) = R(0.0);
        for (int64_t j = 0, end_j = i; j < end_j; j++) {
            AT2(O, i, j) = r.p[p]; AT2(O, j, i) = -r.p[p]; change = change + r.p[p] * r.p[p]; p = p + 1;
        }
    }
    for (int64_t i = 0, end_i = n; i < end_i; i++) {
        for (int64_t j = 0, end_j = n; j < end_j; j++) {
            z = AT2(O, i, 0) * AT2(O, 0, j);
            for (int64_t m = 1, end_m = n; m < end_m; m++) { z = z + AT2(O, i, m) * AT2(O, m, j); }
            AT2(W, i, j) = AT2(O, i, j) + R(0.5) * z;
        }
    }
    for (int64_t i = 0, end_i = n; i < end_i; i++) {
        for (int64_t j = 0, end_j = n; j < end_j; j++) {
            z = AT2(W, i, j);
            for (int64_t m = 0, end_m = n; m < end_m; m++) { z = z + AT2(E, i, m) * AT2(W, m, j); }
            v.p[j] = z;
        }
        for (int64_t j = 0, end_j = n; j < end_j; j++) {
            AT2(E, i, j) = AT2(E, i, j) + v.p[j]; size = size + AT2(E, i, j) * AT2(E, i, j);
        }
    }
    return (t_r2){change, size};
}

INLINE int loop_n_settle(r2 k, r1 g, r1 J, real D, real near, real enough, r2 E, r2 O, r2 W, r2 T, r1 r, r1 h, r1 c) {
    real far, off; t_r2 change;
    for (int64_t i_0 = 0; i_0 < 12; i_0++) {
        far = rotation_n_polish(E, W, c); rotation_n_gap(E, k, g, J, D, c, r);
        rotation_n_slope(E, g, J, D, O, h, c, T); rotation_n_solve(T, r); change = rotation_n_turn(E, r, O, W, c);
        off = change.a0 + far;
        if (off * off <= enough * enough * change.a1) { return change.a1 <= near; }
    }
    return 0;
}

INLINE void rotation_n_remember(r2 E, r3 past, r1 use) {
    real z, before; int64_t n = E.n0;
    for (int64_t i = 0, end_i = n; i < end_i; i++) {
        for (int64_t j = 0, end_j = n; j < end_j; j++) {
            z = AT2(E, i, j);
            for (int64_t m = 0; m < 8; m++) { before = AT3(past, m, i, j); AT3(past, m, i, j) = z; z = z - before; }
        }
    }
    for (int64_t m = 7; m > 0; m--) { use.p[m] = use.p[m - 1]; }
    use.p[0] = R(1.0);
}

INLINE void rotation_n_roll(r2 E, r1 g, r2 R, r1 spot, real rho, r1 c, r2 W) {
    real z; int64_t n = E.n0;
    for (int64_t i = 0, end_i = n; i < end_i; i++) {
        z = (AT2(E, i, 0) - AT2(E, 0, i)) * g.p[0];
        for (int64_t j = 1, end_j = n; j < end_j; j++) { z = z + (AT2(E, i, j) - AT2(E, j, i)) * g.p[j]; }
        c.p[i] = z;
    }
    for (int64_t i = 0, end_i = n - 1; i < end_i; i++) {
        z = AT2(R, i, 0) * c.p[0];
        for (int64_t j = 1, end_j = n; j < end_j; j++) { z = z + AT2(R, i, j) * c.p[j]; }
        spot.p[i] = spot.p[i] + R(0.5) * rho * z;
    }
    for (int64_t i = 0, end_i = n; i < end_i; i++) {
        for (int64_t j = 0, end_j = n; j < end_j; j++) {
            z = AT2(R, i, j);
            for (int64_t m = 0, end_m = n; m < end_m; m++) { z = z + AT2(R, i, m) * AT2(E, m, j); }
            c.p[j] = z;
        }
        for (int64_t j = 0, end_j = n; j < end_j; j++) { AT2(R, i, j) = c.p[j]; }
    }
    for (int64_t i = 0, end_i = n; i < end_i; i++) {
        for (int64_t j = 0, end_j = i + 1; j < end_j; j++) {
            z = AT2(R, 0, i) * AT2(R, 0, j);
            for (int64_t m = 1, end_m = n; m < end_m; m++) { z = z + AT2(R, m, i) * AT2(R, m, j); }
            AT2(W, i, j) = z - (i == j ? R(1.0) : R(0.0)); AT2(W, j, i) = AT2(W, i, j);
        }
    }
    for (int64_t i = 0, end_i = n; i < end_i; i++) {
        for (int64_t j = 0, end_j = n; j < end_j; j++) {
            z = AT2(R, i, 0) * AT2(W, 0, j);
            for (int64_t m = 1, end_m = n; m < end_m; m++) { z = z + AT2(R, i, m) * AT2(W, m, j); }
            c.p[j] = z;
        }
        for (int64_t j = 0, end_j = n; j < end_j; j++) { AT2(R, i, j) = AT2(R, i, j) - R(0.5) * c.p[j]; }
    }
}

INLINE void rotation_n_move(r2 E, r2 k, r1 g, r2 W, r1 c) {
    real z, y; int64_t n = E.n0;
    for (int64_t i = 0, end_i = n; i < end_i; i++) {
        z = AT2(E, 0, i) * g.p[0];
        for (int64_t m = 1, end_m = n; m < end_m; m++) { z = z + AT2(E, m, i) * g.p[m]; }
        c.p[i] = z;
    }
    for (int64_t i = 0, end_i = n; i < end_i; i++) { g.p[i] = g.p[i] + c.p[i]; }
    for (int64_t i = 0, end_i = n; i < end_i; i++) {
        for (int64_t j = 0, end_j = n; j < end_j; j++) {
            z = AT2(k, i, 0) * AT2(E, 0, j);
            for (int64_t m = 1, end_m = n; m < end_m; m++) { z = z + AT2(k, i, m) * AT2(E, m, j); }
            AT2(W, i, j) = z;
        }
    }
    for (int64_t i = 1, end_i = n; i < end_i; i++) {
        for (int64_t j = 0, end_j = i; j < end_j; j++) {
            z = AT2(E, 0, i) * AT2(W, 0, j); y = AT2(E, 0, j) * AT2(W, 0, i);
            for (int64_t m = 1, end_m = n; m < end_m; m++) {
                z = z + AT2(E, m, i) * AT2(W, m, j); y = y + AT2(E, m, j) * AT2(W, m, i);
            }
            z = AT2(k, i, j) + (AT2(W, i, j) + R(0.5) * z - (AT2(W, j, i) + R(0.5) * y)); AT2(k, i, j) = z;
            AT2(k, j, i) = -z;
        }
    }
}

INLINE int64_t loop_n_march(r2 k, r1 g, r1 J, real D, r1 c, r1 near, r1 enough, r4 past, r2 use, int64_t first,
    int64_t count, int64_t every, real scale, r3 momenta, r2 verticals, int with_body, r2 R, r1 spot, real rho, r3
    attitudes, r2 traces, r2 T) {
    int64_t s, frame; int64_t n = k.n0, stages = c.n0; ALIGNED real E_[n * n]; r2 E = {E_, n, n, n};
    ALIGNED real O_[n * n]; r2 O = {O_, n, n, n}; ALIGNED real W_[n * n]; r2 W = {W_, n, n, n}; ALIGNED real r_[T.n0];
    r1 r = {r_, T.n0}; ALIGNED real h_[n]; r1 h = {h_, n}; ALIGNED real v_[n]; r1 v = {v_, n};
    ALIGNED real part_[n * n]; r2 part = {part_, n, n, n};
    for (int64_t stage = first, end_stage = first + count; stage < end_stage; stage++) {
        s = mod_i(stage, stages);
        for (int64_t i = 0, end_i = n; i < end_i; i++) {
            for (int64_t j = 0, end_j = n; j < end_j; j++) { AT2(part, i, j) = c.p[s] * AT2(k, i, j); }
        }
        rotation_n_guess(r4_row(past, s), r2_row(use, s), E);
        if (!loop_n_settle(part, g, J, D, near.p[s], enough.p[s], E, O, W, T, r, h, v)) { return stage - first; }
        rotation_n_remember(E, r4_row(past, s), r2_row(use, s));
        if (with_body) { rotation_n_roll(E, g, R, spot, rho, v, W); }
        rotation_n_move(E, k, g, W, v);
        if (mod_i(stage + 1, stages * every) == 0) {
            frame = div_i(stage + 1, stages * every);
            for (int64_t i = 0, end_i = n; i < end_i; i++) {
                AT2(verticals, frame, i) = g.p[i];
                for (int64_t j = 0, end_j = n; j < end_j; j++) { AT3(momenta, frame, i, j) = scale * AT2(k, i, j); }
            }
            if (with_body) {
                for (int64_t i = 0, end_i = n; i < end_i; i++) {
                    for (int64_t j = 0, end_j = n; j < end_j; j++) { AT3(attitudes, frame, i, j) = AT2(R, i, j); }
                }
                for (int64_t i = 0, end_i = n - 1; i < end_i; i++) { AT2(traces, frame, i) = spot.p[i]; }
            }
        }
    }
    return count;
}

INLINE real kernel_vertical_square(real g1, real g2, real g3, real L1, real L2, real L3) {
    real o_level = L1 * L2 * g3 * g3 + L1 * L3 * g2 * g2 + L2 * L3 * g1 * g1; return o_level;
}

INLINE t_r2 kernel_vertical_level(real t, real v, real level, real L1, real L2, real L3) {
    real s = t * t, m = s * v, t0 = -m, p1 = L1 + t0, p2 = L2 + t0, p3 = L3 + t0, c = p1 * p2;
    real a = L1 + L2 + (L3 - 2 * m), b = c + 2 * s + p3 * (p1 + p2), t1 = a * s + c * p3, o_f = t1 * v - level - s;
    real o_fv = t1 - b * m; return (t_r2){o_f, o_fv};
}

INLINE t_br vertical_loop_level_root(real level, real t, real v, real I1, real I2, real I3) {
    t_r2 f; real correction;
    for (int64_t i_0 = 0; i_0 < 30; i_0++) {
        f = kernel_vertical_level(t, v, level, I1, I2, I3); correction = f.a0 / f.a1; v = v - correction;
        if (R(fabs(correction)) <= R(1.7763568394002505e-15) * v) { return (t_br){1, v}; }
    }
    return (t_br){0, v};
}

INLINE t_r4 kernel_vertical_rotation(real t, real e, real g1, real g2, real g3, real L1, real L2, real L3) {
    real t0 = -e, t1 = L1 + t0, t2 = L2 + t0, t3 = L3 + t0, t4 = t2 * t3, t5 = t * t, t6 = -L3, t7 = g3 * t;
    real o_p0 = t1 * t4 + t5 * (g1 * g1 * t1 + g2 * g2 * t2 + g3 * g3 * t3);
    real o_p1 = t * (g1 * (t4 + t5) + g2 * t7 * (L2 + t6)), o_p2 = t * (g2 * (t5 + t1 * t3) + g1 * t7 * (-L1 - t6));
    real o_p3 = t * (g3 * (t5 + t1 * t2) + g1 * g2 * t * (L1 - L2)); return (t_r4){o_p0, o_p1, o_p2, o_p3};
}

INLINE int vertical_loop_march(r1 g, r1 I, real k, int64_t count, int64_t every, r2 verticals, r1 q) {
    t_r2 f; real correction; int64_t frame;
    real I1 = I.p[0], I2 = I.p[1], I3 = I.p[2], g1 = g.p[0], g2 = g.p[1], g3 = g.p[2], y1 = R(0.0), y2 = R(0.0);
    real y3 = R(0.0), level = kernel_vertical_square(g1, g2, g3, I1, I2, I3);
    t_br t_1 = vertical_loop_level_root(level, k, level / (I1 * I2 * I3), I1, I2, I3); int settled = t_1.a0;
    real v = t_1.a1;
    if (!settled) { return 0; }
    real p0 = R(1.0), p1 = R(0.0), p2 = R(0.0), p3 = R(0.0);
    for (int64_t step = 1, end_step = count + 1; step < end_step; step++) {
        t_r4 t_2 = kernel_vertical_rotation(k, v * k * k, g1, g2, g3, I1, I2, I3); p0 = t_2.a0; p1 = t_2.a1;
        p2 = t_2.a2; p3 = t_2.a3;
        f = kernel_vertical_level(k, v, kernel_vertical_square(g1, g2, g3, I1, I2, I3), I1, I2, I3);
        correction = f.a0 / f.a1;
        if (!(p1 * p1 + p2 * p2 + p3 * p3 < p0 * p0 && R(fabs(correction)) <= R(1.7763568394002505e-15) * v)) {
            return 0;
        }
        v = v - correction; t_r6 t_3 = sums_turned(p0, p1, p2, p3, g1, g2, g3, y1, y2, y3); g1 = t_3.a0; g2 = t_3.a1;
        g3 = t_3.a2; y1 = t_3.a3; y2 = t_3.a4; y3 = t_3.a5;
        if (mod_i(step, every) == 0) {
            frame = div_i(step, every); AT2(verticals, frame, 0) = g1; AT2(verticals, frame, 1) = g2;
            AT2(verticals, frame, 2) = g3;
        }
    }
    q.p[0] = p0; q.p[1] = p1; q.p[2] = p2; q.p[3] = p3; return 1;
}

INLINE t_i2 double_double_step_scales(r1 momentum, r1 tensor, real contact) {
    t_ri t_1 = real_frexp(max_r(max_r(tensor.p[1] + tensor.p[2], tensor.p[0] + tensor.p[2]), tensor.p[0] +
        tensor.p[1]) + contact);
    int64_t exponent = t_1.a1;
    real largest = max_r(max_r(R(fabs(momentum.p[0])), R(fabs(momentum.p[1]))), R(fabs(momentum.p[2])));
    t_ri size = real_frexp(largest); exponent = max_i(exponent, size.a1 - 1021);
    int64_t beyond = largest > R(0.0) ? max_i(0, -200 - (size.a1 - exponent)) : 0;
    return (t_i2){beyond - exponent - 1, beyond};
}

INLINE t_r2 pairs_two_product(real a, real b) { real p = a * b; return (t_r2){p, fma(a, b, -p)}; }
INLINE t_r2 pairs_loose_add(real a, real a_, real b, real b_) {
    t_r2 s = pairs_two_sum(a, b); return (t_r2){s.a0, s.a1 + (a_ + b_)};
}

INLINE t_r2 pairs_quick_two_sum(real a, real b) { real total = a + b; return (t_r2){total, b - (total - a)}; }
INLINE t_r2 pairs_root(real a, real a_) {
    if (a == R(0.0)) { return (t_r2){R(0.0), R(0.0)}; }
    real high = R(sqrt(a)); t_r2 p = pairs_two_product(high, high);
    return pairs_quick_two_sum(high, (a_ + (a - p.a0 - p.a1)) / (R(2.0) * high));
}

INLINE t_r2 pairs_multiply_float(real a, real a_, real b) {
    t_r2 p = pairs_two_product(a, b), s = pairs_quick_two_sum(p.a0, a_ * b);
    return pairs_quick_two_sum(s.a0, s.a1 + p.a1);
}

INLINE t_r2 pairs_divide(real a, real a_, real b, real b_) {
    real high = a / b; t_r2 r = pairs_multiply_float(b, b_, high);
    return pairs_quick_two_sum(high, (a - r.a0 + (a_ - r.a1)) / b);
}

INLINE t_r6 double_double_step_unit(real a, real b, real c) {
    t_r2 t_1 = pairs_two_product(a, a), t_2 = pairs_two_product(b, b);
    t_r2 t_3 = pairs_loose_add(t_1.a0, t_1.a1, t_2.a0, t_2.a1); real n = t_3.a0, n_ = t_3.a1;
    t_r2 t_4 = pairs_two_product(c, c), t_5 = pairs_loose_add(n, n_, t_4.a0, t_4.a1); n = t_5.a0; n_ = t_5.a1;
    t_r2 t_6 = pairs_two_sum(n, n_), t_7 = pairs_root(t_6.a0, t_6.a1); n = t_7.a0; n_ = t_7.a1;
    t_r2 x = pairs_divide(a, R(0.0), n, n_), y = pairs_divide(b, R(0.0), n, n_), z = pairs_divide(c, R(0.0), n, n_);
    return (t_r6){x.a0, x.a1, y.a0, y.a1, z.a0, z.a1};
}

INLINE t_r2 pairs_loose_multiply(real a, real a_, real b, real b_) {
    t_r2 p = pairs_two_product(a, b); return (t_r2){p.a0, p.a1 + (a * b_ + a_ * b)};
}

INLINE t_r2 double_double_loop_inner(r1 a, r1 b) {
    t_r2 t_1 = pairs_loose_multiply(a.p[0], a.p[1], b.p[0], b.p[1]); real x = t_1.a0, x_ = t_1.a1;
    t_r2 y = pairs_loose_multiply(a.p[2], a.p[3], b.p[2], b.p[3]);
    t_r2 z = pairs_loose_multiply(a.p[4], a.p[5], b.p[4], b.p[5]), t_2 = pairs_loose_add(x, x_, y.a0, y.a1);
    x = t_2.a0; x_ = t_2.a1; t_r2 t_3 = pairs_loose_add(x, x_, z.a0, z.a1); x = t_3.a0; x_ = t_3.a1;
    return pairs_two_sum(x, x_);
}

INLINE void double_double_loop_remember_pairs(r1 state) {
    r1 k = r1_part(state, 0, 6), g = r1_part(state, 6, 12); t_r2 t_1 = double_double_loop_inner(g, g);
    state.p[22] = t_1.a0; state.p[23] = t_1.a1; t_r2 t_2 = double_double_loop_inner(k, g); state.p[24] = t_2.a0;
    state.p[25] = t_2.a1; t_r2 t_3 = double_double_loop_inner(k, k); state.p[26] = t_3.a0; state.p[27] = t_3.a1;
}

INLINE t_r2 double_double_step_bounds(real k1, real k2, real k3, real I1, real I2, real I3, real D) {
    if (min_r(min_r(I1, I2), I3) < R(7.52316384526264e-37)) { return (t_r2){R(-1.0), R(0.0)}; }
    return gibbs_certificate(k1, k2, k3, I1, I2, I3, D);
}

OUT_OF_LINE t_i2 double_double_loop_prepare_pairs(r1 momentum, r1 g, r1 tensor, real contact, r2 c, r1 state, r1
    radius, r1 enough) {
    real s; t_i2 shift = double_double_step_scales(momentum, tensor, contact); int64_t size = shift.a1 - shift.a0 - 1;
    for (int64_t i = 0; i < 3; i++) {
        state.p[0 + 2 * i] = R(ldexp(momentum.p[i], (int)shift.a0)); state.p[0 + 2 * i + 1] = R(0.0);
        state.p[18 + i] = R(ldexp(tensor.p[i], (int)-size));
    }
    state.p[21] = R(ldexp(contact, (int)-size)); t_r6 t_1 = double_double_step_unit(g.p[0], g.p[1], g.p[2]);
    state.p[6] = t_1.a0; state.p[7] = t_1.a1; state.p[8] = t_1.a2; state.p[9] = t_1.a3; state.p[10] = t_1.a4;
    state.p[11] = t_1.a5; t_r2 t_2 = pairs_two_sum(state.p[19], state.p[20]); state.p[12] = t_2.a0;
    state.p[13] = t_2.a1; t_r2 t_3 = pairs_two_sum(state.p[18], state.p[20]); state.p[14] = t_3.a0;
    state.p[15] = t_3.a1; t_r2 t_4 = pairs_two_sum(state.p[18], state.p[19]); state.p[16] = t_4.a0;
    state.p[17] = t_4.a1; double_double_loop_remember_pairs(state);
    for (int64_t i = 0, end_i = c.n0; i < end_i; i++) {
        s = AT2(c, i, 0);
        t_r2 t_5 = double_double_step_bounds(s * state.p[0], s * state.p[2], s * state.p[4], state.p[12], state.p[14],
            state.p[16], state.p[21]);
        radius.p[i] = t_5.a0; enough.p[i] = t_5.a1;
    }
    return (t_i2){shift.a0, shift.a1};
}

INLINE t_r2 pairs_multiply(real a, real a_, real b, real b_) {
    t_r2 p = pairs_two_product(a, b); return pairs_quick_two_sum(p.a0, p.a1 + (a * b_ + a_ * b));
}

INLINE Round double_double_step_approach(real u1, real u2, real u3, real k1, real k2, real k3, real g1, real g2, real
    g3, real I1, real I2, real I3, real D, real radius, real enough) {
    real w1, w2, w3; Round r = gibbs_newton_round(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D, 0);
    for (int64_t i_0 = 0; i_0 < 11; i_0++) {
        if (r.first <= enough || radius < R(0.0)) { break; }
        w1 = r.w1; w2 = r.w2; w3 = r.w3;
        if (!(w1 * w1 + (w2 * w2 + w3 * w3) <= radius)) { w1 = R(0.0); w2 = R(0.0); w3 = R(0.0); }
        r = gibbs_newton_round(w1, w2, w3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D, 0);
    }
    return r;
}

INLINE t_r2 pairs_loose_multiply_float(real a, real a_, real b) {
    t_r2 p = pairs_two_product(a, b); return (t_r2){p.a0, p.a1 + a_ * b};
}

INLINE t_r2 pairs_loose_subtract(real a, real a_, real b, real b_) {
    t_r2 s = pairs_two_sum(a, -b); return (t_r2){s.a0, s.a1 + (a_ - b_)};
}

INLINE t_r2 pairs_loose_add_float(real a, real a_, real b) {
    t_r2 s = pairs_two_sum(a, b); return (t_r2){s.a0, s.a1 + a_};
}

INLINE t_r6 double_double_gibbs_residual_pairs(real u1, real u2, real u3, real k1, real k1_, real k2, real k2_, real
    k3, real k3_, real g1, real g1_, real g2, real g2_, real g3, real g3_, real I1, real I1_, real I2, real I2_, real
    I3, real I3_, real D) {
    t_r2 t0 = pairs_loose_multiply_float(g3, g3_, u2), t1 = pairs_loose_multiply_float(g2, g2_, u3);
    t_r2 t2 = pairs_loose_subtract(t0.a0, t0.a1, t1.a0, t1.a1), t3 = pairs_loose_multiply_float(g1, g1_, u3);
    t_r2 t4 = pairs_loose_multiply_float(g3, g3_, u1), t5 = pairs_loose_subtract(t3.a0, t3.a1, t4.a0, t4.a1);
    t_r2 t6 = pairs_loose_multiply_float(g2, g2_, u1), t7 = pairs_loose_multiply_float(g1, g1_, u2);
    t_r2 t8 = pairs_loose_subtract(t6.a0, t6.a1, t7.a0, t7.a1), t9 = pairs_loose_multiply_float(I1, I1_, u1);
    t_r2 t10 = pairs_loose_multiply_float(I2, I2_, u2), t11 = pairs_loose_multiply_float(I3, I3_, u3);
    t_r2 t12 = pairs_two_product(u1, u1), t13 = pairs_loose_add_float(t12.a0, t12.a1, 1);
    t_r2 t14 = pairs_two_product(u2, u2), t15 = pairs_two_product(u3, u3);
    t_r2 t16 = pairs_loose_add(t14.a0, t14.a1, t15.a0, t15.a1);
    t_r2 t17 = pairs_loose_add(t13.a0, t13.a1, t16.a0, t16.a1), t18 = pairs_loose_multiply(g2, g2_, t8.a0, t8.a1);
    t_r2 t19 = pairs_loose_multiply(g3, g3_, t5.a0, t5.a1);
    t_r2 t20 = pairs_loose_subtract(t18.a0, t18.a1, t19.a0, t19.a1);
    t_r2 t21 = pairs_loose_multiply_float(t20.a0, t20.a1, D), t22 = pairs_loose_add(t9.a0, t9.a1, t21.a0, t21.a1);
    t_r2 t23 = pairs_loose_multiply_float(t11.a0, t11.a1, u2), t24 = pairs_loose_add(t22.a0, t22.a1, t23.a0, t23.a1);
    t_r2 t25 = pairs_loose_multiply(k1, k1_, t17.a0, t17.a1), t26 = pairs_loose_multiply_float(t10.a0, t10.a1, u3);
    t_r2 t27 = pairs_loose_add(t25.a0, t25.a1, t26.a0, t26.a1);
    t_r2 t28 = pairs_loose_subtract(t24.a0, t24.a1, t27.a0, t27.a1);
    t_r2 t29 = pairs_loose_multiply(g3, g3_, t2.a0, t2.a1), t30 = pairs_loose_multiply(g1, g1_, t8.a0, t8.a1);
    t_r2 t31 = pairs_loose_subtract(t29.a0, t29.a1, t30.a0, t30.a1);
    t_r2 t32 = pairs_loose_multiply_float(t31.a0, t31.a1, D), t33 = pairs_loose_add(t10.a0, t10.a1, t32.a0, t32.a1);
    t_r2 t34 = pairs_loose_multiply_float(t9.a0, t9.a1, u3), t35 = pairs_loose_add(t33.a0, t33.a1, t34.a0, t34.a1);
    t_r2 t36 = pairs_loose_multiply(k2, k2_, t17.a0, t17.a1), t37 = pairs_loose_multiply_float(t11.a0, t11.a1, u1);
    t_r2 t38 = pairs_loose_add(t36.a0, t36.a1, t37.a0, t37.a1);
    t_r2 t39 = pairs_loose_subtract(t35.a0, t35.a1, t38.a0, t38.a1);
    t_r2 t40 = pairs_loose_multiply(g1, g1_, t5.a0, t5.a1), t41 = pairs_loose_multiply(g2, g2_, t2.a0, t2.a1);
    t_r2 t42 = pairs_loose_subtract(t40.a0, t40.a1, t41.a0, t41.a1);
    t_r2 t43 = pairs_loose_multiply_float(t42.a0, t42.a1, D), t44 = pairs_loose_add(t11.a0, t11.a1, t43.a0, t43.a1);
    t_r2 t45 = pairs_loose_multiply_float(t10.a0, t10.a1, u1), t46 = pairs_loose_add(t44.a0, t44.a1, t45.a0, t45.a1);
    t_r2 t47 = pairs_loose_multiply(k3, k3_, t17.a0, t17.a1), t48 = pairs_loose_multiply_float(t9.a0, t9.a1, u2);
    t_r2 t49 = pairs_loose_add(t47.a0, t47.a1, t48.a0, t48.a1);
    t_r2 t50 = pairs_loose_subtract(t46.a0, t46.a1, t49.a0, t49.a1), o_r1 = pairs_two_sum(t28.a0, t28.a1);
    t_r2 o_r2 = pairs_two_sum(t39.a0, t39.a1), o_r3 = pairs_two_sum(t50.a0, t50.a1);
    return (t_r6){o_r1.a0, o_r1.a1, o_r2.a0, o_r2.a1, o_r3.a0, o_r3.a1};
}

INLINE t_r3 kernel_gibbs_mixed(real d1, real d2, real d3, real e1, real e2, real e3, real k1, real k2, real k3, real
    c11, real c12, real c13, real c21, real c22, real c23, real c31, real c32, real c33, real I1, real I2, real I3) {
    real t0 = 2 * d1 * e1 + 2 * d2 * e2 + 2 * d3 * e3;
    real r1 = I3 * d2 * e3 + I3 * d3 * e2 - k1 * t0 - (I2 * d2 * e3 + I2 * d3 * e2);
    real r2 = I1 * d1 * e3 + I1 * d3 * e1 - k2 * t0 - (I3 * d1 * e3 + I3 * d3 * e1);
    real r3 = I2 * d1 * e2 + I2 * d2 * e1 - k3 * t0 - (I1 * d1 * e2 + I1 * d2 * e1);
    real o_x1 = c11 * r1 + c21 * r2 + c31 * r3, o_x2 = c12 * r1 + c22 * r2 + c32 * r3;
    real o_x3 = c13 * r1 + c23 * r2 + c33 * r3; return (t_r3){o_x1, o_x2, o_x3};
}

INLINE t_r3 double_double_step_correction(Round r, real r1, real r2, real r3, real k1, real k2, real k3, real I1, real
    I2, real I3) {
    real s = R(-1.0) / r.p0, e1 = s * (r.c11 * r1 + r.c21 * r2 + r.c31 * r3);
    real e2 = s * (r.c12 * r1 + r.c22 * r2 + r.c32 * r3), e3 = s * (r.c13 * r1 + r.c23 * r2 + r.c33 * r3);
    t_r3 x1 = kernel_gibbs_mixed(r.d1 + R(0.5) * e1, r.d2 + R(0.5) * e2, r.d3 + R(0.5) * e3, e1, e2, e3, k1, k2, k3,
        r.c11, r.c12, r.c13, r.c21, r.c22, r.c23, r.c31, r.c32, r.c33, I1, I2, I3);
    return (t_r3){e1 + s * x1.a0, e2 + s * x1.a1, e3 + s * x1.a2};
}

INLINE int double_double_step_small(real w1, real w2, real w3, real e1, real e2, real e3) {
    return e1 * e1 + (e2 * e2 + e3 * e3) <= R(7.888609052210118e-31) * (w1 * w1 + (w2 * w2 + w3 * w3));
}

INLINE t_r6 double_double_residual_pairs(real q0, real q0_, real q1, real q1_, real q2, real q2_, real q3, real q3_,
    real K1, real K1_, real K2, real K2_, real K3, real K3_, real g1, real g1_, real g2, real g2_, real g3, real g3_,
    real J1, real J2, real J3, real D) {
    t_r2 t0 = pairs_loose_multiply(q2, q2_, g3, g3_), t1 = pairs_loose_multiply(q3, q3_, g2, g2_);
    t_r2 t_1 = pairs_loose_subtract(t0.a0, t0.a1, t1.a0, t1.a1); real t2 = t_1.a0, t2_ = t_1.a1;
    t_r2 t_2 = pairs_two_sum(t2, t2_); t2 = t_2.a0; t2_ = t_2.a1;
    t_r2 t3 = pairs_loose_multiply(q3, q3_, g1, g1_), t4 = pairs_loose_multiply(q1, q1_, g3, g3_);
    t_r2 t_3 = pairs_loose_subtract(t3.a0, t3.a1, t4.a0, t4.a1); real t5 = t_3.a0, t5_ = t_3.a1;
    t_r2 t_4 = pairs_two_sum(t5, t5_); t5 = t_4.a0; t5_ = t_4.a1;
    t_r2 t6 = pairs_loose_multiply(q1, q1_, g2, g2_), t7 = pairs_loose_multiply(q2, q2_, g1, g1_);
    t_r2 t_5 = pairs_loose_subtract(t6.a0, t6.a1, t7.a0, t7.a1); real t8 = t_5.a0, t8_ = t_5.a1;
    t_r2 t_6 = pairs_two_sum(t8, t8_); t8 = t_6.a0; t8_ = t_6.a1;
    t_r2 t9 = pairs_loose_multiply_float(t2, t2_, D), t10 = pairs_loose_multiply_float(t5, t5_, D);
    t_r2 t11 = pairs_loose_multiply_float(t8, t8_, D);
    real t12 = -J3, t13 = 2 * q3, t13_ = 2 * q3_, t14 = 2 * q0, t14_ = 2 * q0_;
    t_r2 t15 = pairs_loose_multiply(g2, g2_, t11.a0, t11.a1), t16 = pairs_two_sum(J2, J3);
    t_r2 t17 = pairs_loose_multiply(q1, q1_, t16.a0, t16.a1), t_7 = pairs_loose_add(t15.a0, t15.a1, t17.a0, t17.a1);
    real t18 = t_7.a0, t18_ = t_7.a1; t_r2 t_8 = pairs_two_sum(t18, t18_); t18 = t_8.a0; t18_ = t_8.a1;
    t_r2 t19 = pairs_loose_multiply(g3, g3_, t10.a0, t10.a1), t_9 = pairs_loose_subtract(t18, t18_, t19.a0, t19.a1);
    real t20 = t_9.a0, t20_ = t_9.a1; t_r2 t_10 = pairs_two_sum(t20, t20_); t20 = t_10.a0; t20_ = t_10.a1;
    t_r2 t21 = pairs_loose_multiply(t14, t14_, t20, t20_), t22 = pairs_loose_multiply(q2, q2_, t13, t13_);
    t_r2 t23 = pairs_two_sum(J2, t12), t24 = pairs_loose_multiply(t22.a0, t22.a1, t23.a0, t23.a1);
    t_r2 t_11 = pairs_loose_add(t21.a0, t21.a1, t24.a0, t24.a1); real t25 = t_11.a0, t25_ = t_11.a1;
    t_r2 t_12 = pairs_two_sum(t25, t25_); t25 = t_12.a0; t25_ = t_12.a1;
    t_r2 t_13 = pairs_loose_subtract(t25, t25_, K1, K1_); real t26 = t_13.a0, t26_ = t_13.a1;
    t_r2 t_14 = pairs_two_sum(t26, t26_); t26 = t_14.a0; t26_ = t_14.a1;
    t_r2 t27 = pairs_loose_multiply(g3, g3_, t9.a0, t9.a1), t28 = pairs_two_sum(J1, J3);
    t_r2 t29 = pairs_loose_multiply(q2, q2_, t28.a0, t28.a1), t_15 = pairs_loose_add(t27.a0, t27.a1, t29.a0, t29.a1);
    real t30 = t_15.a0, t30_ = t_15.a1; t_r2 t_16 = pairs_two_sum(t30, t30_); t30 = t_16.a0; t30_ = t_16.a1;
    t_r2 t31 = pairs_loose_multiply(g1, g1_, t11.a0, t11.a1), t_17 = pairs_loose_subtract(t30, t30_, t31.a0, t31.a1);
    real t32 = t_17.a0, t32_ = t_17.a1; t_r2 t_18 = pairs_two_sum(t32, t32_); t32 = t_18.a0; t32_ = t_18.a1;
    t_r2 t33 = pairs_loose_multiply(t14, t14_, t32, t32_), t_19 = pairs_loose_subtract(t33.a0, t33.a1, K2, K2_);
    real t34 = t_19.a0, t34_ = t_19.a1; t_r2 t_20 = pairs_two_sum(t34, t34_); t34 = t_20.a0; t34_ = t_20.a1;
    t_r2 t35 = pairs_loose_multiply(q1, q1_, t13, t13_), t36 = pairs_two_sum(J1, t12);
    t_r2 t37 = pairs_loose_multiply(t35.a0, t35.a1, t36.a0, t36.a1);
    t_r2 t_21 = pairs_loose_subtract(t34, t34_, t37.a0, t37.a1); real t38 = t_21.a0, t38_ = t_21.a1;
    t_r2 t_22 = pairs_two_sum(t38, t38_); t38 = t_22.a0; t38_ = t_22.a1;
    t_r2 t39 = pairs_loose_multiply(g1, g1_, t10.a0, t10.a1), t40 = pairs_two_sum(J1, J2);
    t_r2 t41 = pairs_loose_multiply(q3, q3_, t40.a0, t40.a1), t_23 = pairs_loose_add(t39.a0, t39.a1, t41.a0, t41.a1);
    real t42 = t_23.a0, t42_ = t_23.a1; t_r2 t_24 = pairs_two_sum(t42, t42_); t42 = t_24.a0; t42_ = t_24.a1;
    t_r2 t43 = pairs_loose_multiply(g2, g2_, t9.a0, t9.a1), t_25 = pairs_loose_subtract(t42, t42_, t43.a0, t43.a1);
    real t44 = t_25.a0, t44_ = t_25.a1; t_r2 t_26 = pairs_two_sum(t44, t44_); t44 = t_26.a0; t44_ = t_26.a1;
    t_r2 t45 = pairs_loose_multiply(t14, t14_, t44, t44_); real t46 = 2 * q1, t46_ = 2 * q1_;
    t_r2 t47 = pairs_loose_multiply(q2, q2_, t46, t46_), t48 = pairs_two_sum(J1, -J2);
    t_r2 t49 = pairs_loose_multiply(t47.a0, t47.a1, t48.a0, t48.a1);
    t_r2 t_27 = pairs_loose_add(t45.a0, t45.a1, t49.a0, t49.a1); real t50 = t_27.a0, t50_ = t_27.a1;
    t_r2 t_28 = pairs_two_sum(t50, t50_); t50 = t_28.a0; t50_ = t_28.a1;
    t_r2 t_29 = pairs_loose_subtract(t50, t50_, K3, K3_); real t51 = t_29.a0, t51_ = t_29.a1;
    t_r2 t_30 = pairs_two_sum(t51, t51_); t51 = t_30.a0; t51_ = t_30.a1;
    t_r2 o_r1 = pairs_two_sum(t26, t26_), o_r2 = pairs_two_sum(t38, t38_), o_r3 = pairs_two_sum(t51, t51_);
    return (t_r6){o_r1.a0, o_r1.a1, o_r2.a0, o_r2.a1, o_r3.a0, o_r3.a1};
}

INLINE t_r8 double_double_moved_pairs(real q0, real q0_, real q1, real q1_, real q2, real q2_, real q3, real q3_, real
    w1, real w2, real w3) {
    t_r2 t0 = pairs_loose_multiply_float(q1, q1_, w1), t1 = pairs_loose_subtract(q0, q0_, t0.a0, t0.a1);
    t_r2 t2 = pairs_loose_multiply_float(q2, q2_, w2), t3 = pairs_loose_multiply_float(q3, q3_, w3);
    t_r2 t4 = pairs_loose_add(t2.a0, t2.a1, t3.a0, t3.a1), t5 = pairs_loose_subtract(t1.a0, t1.a1, t4.a0, t4.a1);
    t_r2 t6 = pairs_loose_multiply_float(q0, q0_, w1), t7 = pairs_loose_add(q1, q1_, t6.a0, t6.a1);
    t_r2 t8 = pairs_loose_multiply_float(q2, q2_, w3), t9 = pairs_loose_multiply_float(q3, q3_, w2);
    t_r2 t10 = pairs_loose_subtract(t8.a0, t8.a1, t9.a0, t9.a1), t11 = pairs_loose_add(t7.a0, t7.a1, t10.a0, t10.a1);
    t_r2 t12 = pairs_loose_multiply_float(q0, q0_, w2), t13 = pairs_loose_add(q2, q2_, t12.a0, t12.a1);
    t_r2 t14 = pairs_loose_multiply_float(q3, q3_, w1), t15 = pairs_loose_multiply_float(q1, q1_, w3);
    t_r2 t16 = pairs_loose_subtract(t14.a0, t14.a1, t15.a0, t15.a1);
    t_r2 t17 = pairs_loose_add(t13.a0, t13.a1, t16.a0, t16.a1), t18 = pairs_loose_multiply_float(q0, q0_, w3);
    t_r2 t19 = pairs_loose_multiply_float(q1, q1_, w2), t20 = pairs_loose_add(t18.a0, t18.a1, t19.a0, t19.a1);
    t_r2 t21 = pairs_loose_multiply_float(q2, q2_, w1), t22 = pairs_loose_subtract(q3, q3_, t21.a0, t21.a1);
    t_r2 t23 = pairs_loose_add(t20.a0, t20.a1, t22.a0, t22.a1);
    t_r2 t24 = pairs_loose_multiply(t5.a0, t5.a1, t5.a0, t5.a1);
    t_r2 t25 = pairs_loose_multiply(t11.a0, t11.a1, t11.a0, t11.a1);
    t_r2 t26 = pairs_loose_add(t24.a0, t24.a1, t25.a0, t25.a1);
    t_r2 t27 = pairs_loose_multiply(t17.a0, t17.a1, t17.a0, t17.a1);
    t_r2 t28 = pairs_loose_multiply(t23.a0, t23.a1, t23.a0, t23.a1);
    t_r2 t29 = pairs_loose_add(t27.a0, t27.a1, t28.a0, t28.a1);
    t_r2 t30 = pairs_loose_add(t26.a0, t26.a1, t29.a0, t29.a1), t31 = pairs_loose_add_float(-t30.a0, -t30.a1, 3);
    real t32 = t31.a0 / 2, t32_ = t31.a1 / 2;
    t_r2 t33 = pairs_loose_multiply(t5.a0, t5.a1, t32, t32_), t34 = pairs_loose_multiply(t11.a0, t11.a1, t32, t32_);
    t_r2 t35 = pairs_loose_multiply(t17.a0, t17.a1, t32, t32_);
    t_r2 t36 = pairs_loose_multiply(t23.a0, t23.a1, t32, t32_), o_b0 = pairs_two_sum(t33.a0, t33.a1);
    t_r2 o_b1 = pairs_two_sum(t34.a0, t34.a1), o_b2 = pairs_two_sum(t35.a0, t35.a1);
    t_r2 o_b3 = pairs_two_sum(t36.a0, t36.a1);
    return (t_r8){o_b0.a0, o_b0.a1, o_b1.a0, o_b1.a1, o_b2.a0, o_b2.a1, o_b3.a0, o_b3.a1};
}

INLINE t_br6 double_double_step_polished(real q0, real q1, real q2, real q3, real k1, real k1_, real k2, real k2_,
    real k3, real k3_, real g1, real g1_, real g2, real g2_, real g3, real g3_, real J1, real J2, real J3, real D,
    real near) {
    t_r6 r1; t_r10 det; real w1, w2, w3, change, extent;
    real q0_ = R(0.0), q1_ = R(0.0), q2_ = R(0.0), q3_ = R(0.0), before = near; int settled = 0;
    for (int64_t i_0 = 0; i_0 < 60; i_0++) {
        r1 = double_double_residual_pairs(q0, q0_, q1, q1_, q2, q2_, q3, q3_, R(2.0) * k1, R(2.0) * k1_, R(2.0) * k2,
            R(2.0) * k2_, R(2.0) * k3, R(2.0) * k3_, g1, g1_, g2, g2_, g3, g3_, J1, J2, J3, D);
        det = branch_inverse(q0, q1, q2, q3, g1, g2, g3, J1, J2, J3, D);
        if (!(det.a0 > R(0.0))) { break; }
        w1 = -(det.a1 * r1.a0 + det.a2 * r1.a2 + det.a3 * r1.a4);
        w2 = -(det.a4 * r1.a0 + det.a5 * r1.a2 + det.a6 * r1.a4);
        w3 = -(det.a7 * r1.a0 + det.a8 * r1.a2 + det.a9 * r1.a4);
        t_r8 t_1 = double_double_moved_pairs(q0, q0_, q1, q1_, q2, q2_, q3, q3_, w1, w2, w3); q0 = t_1.a0;
        q0_ = t_1.a1; q1 = t_1.a2; q1_ = t_1.a3; q2 = t_1.a4; q2_ = t_1.a5; q3 = t_1.a6; q3_ = t_1.a7;
        change = max_r(max_r(R(fabs(w1)), R(fabs(w2))), R(fabs(w3)));
        extent = max_r(max_r(R(fabs(q1)), R(fabs(q2))), R(fabs(q3)));
        if (change > near) { break; }
        settled = change <= R(4.930380657631324e-32) * extent || (change <= R(8.673617379884035e-19) * extent &&
            change >= R(0.25) * before);
        if (settled) { break; }
        before = change;
    }
    if (q0 == R(0.0)) { q0 = R(7.703719777548943e-34); }
    t_r2 t_2 = pairs_divide(q1, q1_, q0, q0_), t_3 = pairs_divide(q2, q2_, q0, q0_);
    t_r2 t_4 = pairs_divide(q3, q3_, q0, q0_);
    return (t_br6){settled, t_2.a0, t_2.a1, t_3.a0, t_3.a1, t_4.a0, t_4.a1};
}

INLINE t_ir7 double_double_step_solved(real u1, real u2, real u3, real k1, real k1_, real k2, real k2_, real k3, real
    k3_, real g1, real g1_, real g2, real g2_, real g3, real g3_, real I1, real I1_, real I2, real I2_, real I3, real
    I3_, real J1, real J2, real J3, real D, real radius, real enough) {
    t_r6 r1; t_r3 e1; real p0, p1, p2, p3; int near = u1 * u1 + (u2 * u2 + u3 * u3) <= radius;
    Round r = double_double_step_approach(near ? u1 : R(0.0), near ? u2 : R(0.0), near ? u3 : R(0.0), k1, k2, k3, g1,
        g2, g3, I1, I2, I3, D, radius, enough);
    int settled = radius >= R(0.0) && r.first <= enough; real w1 = r.w1, w2 = r.w2, w3 = r.w3; int64_t status = 0;
    real reach = R(1.0);
    if (settled) {
        r1 = double_double_gibbs_residual_pairs(w1, w2, w3, k1, k1_, k2, k2_, k3, k3_, g1, g1_, g2, g2_, g3, g3_, I1,
            I1_, I2, I2_, I3, I3_, D);
        e1 = double_double_step_correction(r, r1.a0, r1.a2, r1.a4, k1, k2, k3, I1, I2, I3);
        if (double_double_step_small(w1, w2, w3, e1.a0, e1.a1, e1.a2)) {
            t_r2 t_1 = pairs_two_sum(w1, e1.a0), t_2 = pairs_two_sum(w2, e1.a1), t_3 = pairs_two_sum(w3, e1.a2);
            return (t_ir7){0, R(1.0), t_1.a0, t_1.a1, t_2.a0, t_2.a1, t_3.a0, t_3.a1};
        }
        w1 = w1 + e1.a0; w2 = w2 + e1.a1; w3 = w3 + e1.a2;
        p0 = R(1.0) / R(sqrt(R(1.0) + (w1 * w1 + (w2 * w2 + w3 * w3)))); p1 = p0 * w1; p2 = p0 * w2; p3 = p0 * w3;
    }
    else {
        if (radius == R(-2.0)) {
            t_br7 t_4 = path_search_on_path(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D); settled = t_4.a0;
            p0 = t_4.a1; p1 = t_4.a2; p2 = t_4.a3; p3 = t_4.a4; w1 = t_4.a5; w2 = t_4.a6; w3 = t_4.a7;
        }
        if (settled) {
            p0 = R(1.0) / R(sqrt(R(1.0) + (w1 * w1 + (w2 * w2 + w3 * w3)))); p1 = p0 * w1; p2 = p0 * w2; p3 = p0 * w3;
        }
        else {
            t_ir5 t_5 = branch_small_rotation(R(2.0) * k1, R(2.0) * k2, R(2.0) * k3, g1, g2, g3, J1, J2, J3, D);
            status = t_5.a0; reach = t_5.a1; p0 = t_5.a2; p1 = t_5.a3; p2 = t_5.a4; p3 = t_5.a5;
        }
        if (status != 0 && !(status == 1 && reach > R(0.9999999999999716))) {
            return (t_ir7){status, reach, R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0)};
        }
    }
    t_br6 t_6 = double_double_step_polished(p0, p1, p2, p3, k1, k1_, k2, k2_, k3, k3_, g1, g1_, g2, g2_, g3, g3_, J1,
        J2, J3, D, status == 1 ? R(1e-06) : R(0.1));
    settled = t_6.a0; u1 = t_6.a1; real u1_ = t_6.a2; u2 = t_6.a3; real u2_ = t_6.a4; u3 = t_6.a5; real u3_ = t_6.a6;
    if (settled) { return (t_ir7){0, R(1.0), u1, u1_, u2, u2_, u3, u3_}; }
    return (t_ir7){status == 1 ? 1 : 2, reach, R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0)};
}

INLINE t_r8 sums_filtered(real b, real c, real d, real e, real f, real h, real o, real w) {
    return (t_r8){b + R(8.0) * w, c - R(28.0) * w, d + R(56.0) * w, e - R(70.0) * w, f + R(56.0) * w, h - R(28.0) * w,
        o + R(8.0) * w, -w};
}

INLINE void double_double_loop_extrapolated(r2 past, real w1, real w2, real w3) {
    int64_t c = 0; real w = w1;
    t_r8 t_1 = sums_filtered(AT2(past, 1, c), AT2(past, 2, c), AT2(past, 3, c), AT2(past, 4, c), AT2(past, 5, c),
        AT2(past, 6, c), AT2(past, 7, c), w);
    AT2(past, 0, c) = t_1.a0; AT2(past, 1, c) = t_1.a1; AT2(past, 2, c) = t_1.a2; AT2(past, 3, c) = t_1.a3;
    AT2(past, 4, c) = t_1.a4; AT2(past, 5, c) = t_1.a5; AT2(past, 6, c) = t_1.a6; AT2(past, 7, c) = t_1.a7; c = 1;
    w = w2;
    t_r8 t_2 = sums_filtered(AT2(past, 1, c), AT2(past, 2, c), AT2(past, 3, c), AT2(past, 4, c), AT2(past, 5, c),
        AT2(past, 6, c), AT2(past, 7, c), w);
    AT2(past, 0, c) = t_2.a0; AT2(past, 1, c) = t_2.a1; AT2(past, 2, c) = t_2.a2; AT2(past, 3, c) = t_2.a3;
    AT2(past, 4, c) = t_2.a4; AT2(past, 5, c) = t_2.a5; AT2(past, 6, c) = t_2.a6; AT2(past, 7, c) = t_2.a7; c = 2;
    w = w3;
    t_r8 t_3 = sums_filtered(AT2(past, 1, c), AT2(past, 2, c), AT2(past, 3, c), AT2(past, 4, c), AT2(past, 5, c),
        AT2(past, 6, c), AT2(past, 7, c), w);
    AT2(past, 0, c) = t_3.a0; AT2(past, 1, c) = t_3.a1; AT2(past, 2, c) = t_3.a2; AT2(past, 3, c) = t_3.a3;
    AT2(past, 4, c) = t_3.a4; AT2(past, 5, c) = t_3.a5; AT2(past, 6, c) = t_3.a6; AT2(past, 7, c) = t_3.a7;
}

INLINE t_ir7 double_double_loop_stage(r1 state, real c, real c_, real radius, real enough, r2 past) {
    t_r2 k1 = pairs_multiply(state.p[0], state.p[1], c, c_), k2 = pairs_multiply(state.p[2], state.p[3], c, c_);
    t_r2 k3 = pairs_multiply(state.p[4], state.p[5], c, c_);
    t_ir7 status = double_double_step_solved(AT2(past, 0, 0), AT2(past, 0, 1), AT2(past, 0, 2), k1.a0, k1.a1, k2.a0,
        k2.a1, k3.a0, k3.a1, state.p[6], state.p[7], state.p[8], state.p[9], state.p[10], state.p[11], state.p[12],
        state.p[13], state.p[14], state.p[15], state.p[16], state.p[17], state.p[18], state.p[19], state.p[20],
        state.p[21], radius, enough);
    if (status.a0 == 0) { double_double_loop_extrapolated(past, status.a2, status.a4, status.a6); }
    return (t_ir7){status.a0, status.a1, status.a2, status.a3, status.a4, status.a5, status.a6, status.a7};
}

INLINE t_r12 double_double_roll_pairs(real q0, real q0_, real u1, real u1_, real u2, real u2_, real u3, real u3_, real
    g1, real g1_, real g2, real g2_, real g3, real g3_, real a0, real a0_, real a1, real a1_, real a2, real a2_, real
    a3, real a3_, real z1, real z1_, real z2, real z2_, real rho) {
    t_r2 t0 = pairs_loose_multiply(q0, q0_, u1, u1_), t1 = pairs_loose_multiply(q0, q0_, u2, u2_);
    t_r2 t2 = pairs_loose_multiply(q0, q0_, u3, u3_); real t3 = 2 * q0, t3_ = 2 * q0_;
    t_r2 t4 = pairs_loose_multiply(g3, g3_, t1.a0, t1.a1), t5 = pairs_loose_multiply(g2, g2_, t2.a0, t2.a1);
    t_r2 t6 = pairs_loose_subtract(t4.a0, t4.a1, t5.a0, t5.a1), t7 = pairs_loose_multiply(t3, t3_, t6.a0, t6.a1);
    real t8 = -t3, t8_ = -t3_;
    t_r2 t9 = pairs_loose_multiply(g3, g3_, t0.a0, t0.a1), t10 = pairs_loose_multiply(g1, g1_, t2.a0, t2.a1);
    t_r2 t11 = pairs_loose_subtract(t9.a0, t9.a1, t10.a0, t10.a1);
    t_r2 t12 = pairs_loose_multiply(t8, t8_, t11.a0, t11.a1), t13 = pairs_loose_multiply(g2, g2_, t0.a0, t0.a1);
    t_r2 t14 = pairs_loose_multiply(g1, g1_, t1.a0, t1.a1);
    t_r2 t15 = pairs_loose_subtract(t13.a0, t13.a1, t14.a0, t14.a1);
    t_r2 t16 = pairs_loose_multiply(t3, t3_, t15.a0, t15.a1), t17 = pairs_loose_multiply(a2, a2_, a2, a2_);
    t_r2 t18 = pairs_loose_multiply(a3, a3_, a3, a3_); real t19 = 2 * t7.a0, t19_ = 2 * t7.a1;
    t_r2 t20 = pairs_loose_multiply(a0, a0_, a2, a2_), t21 = pairs_loose_multiply(a1, a1_, a3, a3_);
    t_r2 t22 = pairs_loose_multiply(a0, a0_, a3, a3_), t23 = pairs_loose_multiply(a1, a1_, a2, a2_);
    real t24 = 2 * t12.a0, t24_ = 2 * t12.a1;
    t_r2 t25 = pairs_loose_multiply(a1, a1_, a1, a1_), t26 = pairs_loose_multiply(a0, a0_, a1, a1_);
    t_r2 t27 = pairs_loose_multiply(a2, a2_, a3, a3_); real t28 = 2 * t16.a0, t28_ = 2 * t16.a1;
    t_r2 t29 = pairs_loose_add(t20.a0, t20.a1, t21.a0, t21.a1);
    t_r2 t30 = pairs_loose_multiply(t28, t28_, t29.a0, t29.a1), t31 = pairs_loose_add(t7.a0, t7.a1, t30.a0, t30.a1);
    t_r2 t32 = pairs_loose_add(t17.a0, t17.a1, t18.a0, t18.a1);
    t_r2 t33 = pairs_loose_multiply(t19, t19_, t32.a0, t32.a1);
    t_r2 t34 = pairs_loose_subtract(t22.a0, t22.a1, t23.a0, t23.a1);
    t_r2 t35 = pairs_loose_multiply(t24, t24_, t34.a0, t34.a1);
    t_r2 t36 = pairs_loose_add(t33.a0, t33.a1, t35.a0, t35.a1);
    t_r2 t37 = pairs_loose_subtract(t31.a0, t31.a1, t36.a0, t36.a1);
    t_r2 t38 = pairs_loose_add(t22.a0, t22.a1, t23.a0, t23.a1);
    t_r2 t39 = pairs_loose_multiply(t19, t19_, t38.a0, t38.a1);
    t_r2 t40 = pairs_loose_add(t12.a0, t12.a1, t39.a0, t39.a1);
    t_r2 t41 = pairs_loose_subtract(t26.a0, t26.a1, t27.a0, t27.a1);
    t_r2 t42 = pairs_loose_multiply(t28, t28_, t41.a0, t41.a1);
    t_r2 t43 = pairs_loose_add(t18.a0, t18.a1, t25.a0, t25.a1);
    t_r2 t44 = pairs_loose_multiply(t24, t24_, t43.a0, t43.a1);
    t_r2 t45 = pairs_loose_add(t42.a0, t42.a1, t44.a0, t44.a1);
    t_r2 t46 = pairs_loose_subtract(t40.a0, t40.a1, t45.a0, t45.a1);
    t_r2 t47 = pairs_loose_multiply_float(t37.a0, t37.a1, rho), t48 = pairs_loose_add(z1, z1_, t47.a0, t47.a1);
    t_r2 t49 = pairs_loose_multiply_float(t46.a0, t46.a1, rho), t50 = pairs_loose_add(z2, z2_, t49.a0, t49.a1);
    t_r2 t51 = pairs_loose_multiply(q0, q0_, a0, a0_), t52 = pairs_loose_multiply(a1, a1_, t0.a0, t0.a1);
    t_r2 t53 = pairs_loose_subtract(t51.a0, t51.a1, t52.a0, t52.a1);
    t_r2 t54 = pairs_loose_multiply(a2, a2_, t1.a0, t1.a1), t55 = pairs_loose_multiply(a3, a3_, t2.a0, t2.a1);
    t_r2 t56 = pairs_loose_add(t54.a0, t54.a1, t55.a0, t55.a1);
    t_r2 t57 = pairs_loose_subtract(t53.a0, t53.a1, t56.a0, t56.a1);
    t_r2 t58 = pairs_loose_multiply(a0, a0_, t0.a0, t0.a1), t59 = pairs_loose_multiply(q0, q0_, a1, a1_);
    t_r2 t60 = pairs_loose_add(t58.a0, t58.a1, t59.a0, t59.a1), t61 = pairs_loose_multiply(a2, a2_, t2.a0, t2.a1);
    t_r2 t62 = pairs_loose_multiply(a3, a3_, t1.a0, t1.a1);
    t_r2 t63 = pairs_loose_subtract(t61.a0, t61.a1, t62.a0, t62.a1);
    t_r2 t64 = pairs_loose_add(t60.a0, t60.a1, t63.a0, t63.a1), t65 = pairs_loose_multiply(a0, a0_, t1.a0, t1.a1);
    t_r2 t66 = pairs_loose_multiply(q0, q0_, a2, a2_), t67 = pairs_loose_add(t65.a0, t65.a1, t66.a0, t66.a1);
    t_r2 t68 = pairs_loose_multiply(a3, a3_, t0.a0, t0.a1), t69 = pairs_loose_multiply(a1, a1_, t2.a0, t2.a1);
    t_r2 t70 = pairs_loose_subtract(t68.a0, t68.a1, t69.a0, t69.a1);
    t_r2 t71 = pairs_loose_add(t67.a0, t67.a1, t70.a0, t70.a1), t72 = pairs_loose_multiply(a0, a0_, t2.a0, t2.a1);
    t_r2 t73 = pairs_loose_multiply(a1, a1_, t1.a0, t1.a1), t74 = pairs_loose_add(t72.a0, t72.a1, t73.a0, t73.a1);
    t_r2 t75 = pairs_loose_multiply(q0, q0_, a3, a3_), t76 = pairs_loose_multiply(a2, a2_, t0.a0, t0.a1);
    t_r2 t77 = pairs_loose_subtract(t75.a0, t75.a1, t76.a0, t76.a1);
    t_r2 t78 = pairs_loose_add(t74.a0, t74.a1, t77.a0, t77.a1);
    t_r2 t79 = pairs_loose_multiply(t57.a0, t57.a1, t57.a0, t57.a1);
    t_r2 t80 = pairs_loose_multiply(t64.a0, t64.a1, t64.a0, t64.a1);
    t_r2 t81 = pairs_loose_add(t79.a0, t79.a1, t80.a0, t80.a1);
    t_r2 t82 = pairs_loose_multiply(t71.a0, t71.a1, t71.a0, t71.a1);
    t_r2 t83 = pairs_loose_multiply(t78.a0, t78.a1, t78.a0, t78.a1);
    t_r2 t84 = pairs_loose_add(t82.a0, t82.a1, t83.a0, t83.a1);
    t_r2 t85 = pairs_loose_add(t81.a0, t81.a1, t84.a0, t84.a1), t86 = pairs_loose_add_float(-t85.a0, -t85.a1, 3);
    real t87 = t86.a0 / 2, t87_ = t86.a1 / 2; t_r2 t88 = pairs_loose_multiply(t57.a0, t57.a1, t87, t87_);
    t_r2 t89 = pairs_loose_multiply(t64.a0, t64.a1, t87, t87_);
    t_r2 t90 = pairs_loose_multiply(t71.a0, t71.a1, t87, t87_);
    t_r2 t91 = pairs_loose_multiply(t78.a0, t78.a1, t87, t87_), o_b0 = pairs_two_sum(t88.a0, t88.a1);
    t_r2 o_b1 = pairs_two_sum(t89.a0, t89.a1), o_b2 = pairs_two_sum(t90.a0, t90.a1);
    t_r2 o_b3 = pairs_two_sum(t91.a0, t91.a1), o_n1 = pairs_two_sum(t48.a0, t48.a1);
    t_r2 o_n2 = pairs_two_sum(t50.a0, t50.a1);
    return (t_r12){o_b0.a0, o_b0.a1, o_b1.a0, o_b1.a1, o_b2.a0, o_b2.a1, o_b3.a0, o_b3.a1, o_n1.a0, o_n1.a1, o_n2.a0,
        o_n2.a1};
}

INLINE void double_double_loop_follow_body(real u1, real u1_, real u2, real u2_, real u3, real u3_, r1 state, r1
    attitude, r1 contact, real rho) {
    t_r2 t_1 = pairs_loose_multiply(u1, u1_, u1, u1_), t_2 = pairs_loose_multiply(u2, u2_, u2, u2_);
    t_r2 t_3 = pairs_loose_add(t_1.a0, t_1.a1, t_2.a0, t_2.a1); real n = t_3.a0, n_ = t_3.a1;
    t_r2 t_4 = pairs_loose_multiply(u3, u3_, u3, u3_), t_5 = pairs_loose_add(n, n_, t_4.a0, t_4.a1); n = t_5.a0;
    n_ = t_5.a1; t_r2 t_6 = pairs_loose_add_float(n, n_, R(1.0)), t_7 = pairs_two_sum(t_6.a0, t_6.a1);
    t_r2 t_8 = pairs_root(t_7.a0, t_7.a1); n = t_8.a0; n_ = t_8.a1; t_r2 q0 = pairs_divide(R(1.0), R(0.0), n, n_);
    t_r12 t_9 = double_double_roll_pairs(q0.a0, q0.a1, u1, u1_, u2, u2_, u3, u3_, state.p[6], state.p[7], state.p[8],
        state.p[9], state.p[10], state.p[11], attitude.p[0], attitude.p[1], attitude.p[2], attitude.p[3],
        attitude.p[4], attitude.p[5], attitude.p[6], attitude.p[7], contact.p[0], contact.p[1], contact.p[2],
        contact.p[3], rho);
    attitude.p[0] = t_9.a0; attitude.p[1] = t_9.a1; attitude.p[2] = t_9.a2; attitude.p[3] = t_9.a3;
    attitude.p[4] = t_9.a4; attitude.p[5] = t_9.a5; attitude.p[6] = t_9.a6; attitude.p[7] = t_9.a7;
    contact.p[0] = t_9.a8; contact.p[1] = t_9.a9; contact.p[2] = t_9.a10; contact.p[3] = t_9.a11;
}

INLINE t_r12 double_double_turn_pairs(real u1, real u1_, real u2, real u2_, real u3, real u3_, real k1, real k1_, real
    k2, real k2_, real k3, real k3_, real g1, real g1_, real g2, real g2_, real g3, real g3_) {
    t_r2 t0 = pairs_loose_multiply(u1, u1_, u1, u1_), t1 = pairs_loose_add_float(t0.a0, t0.a1, 1);
    t_r2 t2 = pairs_loose_multiply(u2, u2_, u2, u2_), t3 = pairs_loose_multiply(u3, u3_, u3, u3_);
    t_r2 t4 = pairs_loose_add(t2.a0, t2.a1, t3.a0, t3.a1), t5 = pairs_loose_add(t1.a0, t1.a1, t4.a0, t4.a1);
    t_r2 t6d = pairs_two_sum(t5.a0, t5.a1), t6 = pairs_divide(2, 0, t6d.a0, t6d.a1);
    t_r2 t7 = pairs_loose_multiply(u2, u2_, k3, k3_), t8 = pairs_loose_multiply(u3, u3_, k2, k2_);
    t_r2 t9 = pairs_loose_subtract(t7.a0, t7.a1, t8.a0, t8.a1), t10 = pairs_loose_multiply(u3, u3_, k1, k1_);
    t_r2 t11 = pairs_loose_multiply(u1, u1_, k3, k3_), t12 = pairs_loose_subtract(t10.a0, t10.a1, t11.a0, t11.a1);
    t_r2 t13 = pairs_loose_multiply(u1, u1_, k2, k2_), t14 = pairs_loose_multiply(u2, u2_, k1, k1_);
    t_r2 t15 = pairs_loose_subtract(t13.a0, t13.a1, t14.a0, t14.a1);
    t_r2 t16 = pairs_loose_multiply(u2, u2_, t15.a0, t15.a1);
    t_r2 t17 = pairs_loose_subtract(t16.a0, t16.a1, t9.a0, t9.a1);
    t_r2 t18 = pairs_loose_multiply(u3, u3_, t12.a0, t12.a1);
    t_r2 t19 = pairs_loose_subtract(t17.a0, t17.a1, t18.a0, t18.a1);
    t_r2 t20 = pairs_loose_multiply(t6.a0, t6.a1, t19.a0, t19.a1), t21 = pairs_loose_multiply(u3, u3_, t9.a0, t9.a1);
    t_r2 t22 = pairs_loose_subtract(t21.a0, t21.a1, t12.a0, t12.a1);
    t_r2 t23 = pairs_loose_multiply(u1, u1_, t15.a0, t15.a1);
    t_r2 t24 = pairs_loose_subtract(t22.a0, t22.a1, t23.a0, t23.a1);
    t_r2 t25 = pairs_loose_multiply(t6.a0, t6.a1, t24.a0, t24.a1);
    t_r2 t26 = pairs_loose_multiply(u1, u1_, t12.a0, t12.a1);
    t_r2 t27 = pairs_loose_subtract(t26.a0, t26.a1, t15.a0, t15.a1);
    t_r2 t28 = pairs_loose_multiply(u2, u2_, t9.a0, t9.a1);
    t_r2 t29 = pairs_loose_subtract(t27.a0, t27.a1, t28.a0, t28.a1);
    t_r2 t30 = pairs_loose_multiply(t6.a0, t6.a1, t29.a0, t29.a1), t31 = pairs_loose_multiply(u2, u2_, g3, g3_);
    t_r2 t32 = pairs_loose_multiply(u3, u3_, g2, g2_), t33 = pairs_loose_subtract(t31.a0, t31.a1, t32.a0, t32.a1);
    t_r2 t34 = pairs_loose_multiply(u3, u3_, g1, g1_), t35 = pairs_loose_multiply(u1, u1_, g3, g3_);
    t_r2 t36 = pairs_loose_subtract(t34.a0, t34.a1, t35.a0, t35.a1), t37 = pairs_loose_multiply(u1, u1_, g2, g2_);
    t_r2 t38 = pairs_loose_multiply(u2, u2_, g1, g1_), t39 = pairs_loose_subtract(t37.a0, t37.a1, t38.a0, t38.a1);
    t_r2 t40 = pairs_loose_multiply(u2, u2_, t39.a0, t39.a1);
    t_r2 t41 = pairs_loose_subtract(t40.a0, t40.a1, t33.a0, t33.a1);
    t_r2 t42 = pairs_loose_multiply(u3, u3_, t36.a0, t36.a1);
    t_r2 t43 = pairs_loose_subtract(t41.a0, t41.a1, t42.a0, t42.a1);
    t_r2 t44 = pairs_loose_multiply(t6.a0, t6.a1, t43.a0, t43.a1);
    t_r2 t45 = pairs_loose_multiply(u3, u3_, t33.a0, t33.a1);
    t_r2 t46 = pairs_loose_subtract(t45.a0, t45.a1, t36.a0, t36.a1);
    t_r2 t47 = pairs_loose_multiply(u1, u1_, t39.a0, t39.a1);
    t_r2 t48 = pairs_loose_subtract(t46.a0, t46.a1, t47.a0, t47.a1);
    t_r2 t49 = pairs_loose_multiply(t6.a0, t6.a1, t48.a0, t48.a1);
    t_r2 t50 = pairs_loose_multiply(u1, u1_, t36.a0, t36.a1);
    t_r2 t51 = pairs_loose_subtract(t50.a0, t50.a1, t39.a0, t39.a1);
    t_r2 t52 = pairs_loose_multiply(u2, u2_, t33.a0, t33.a1);
    t_r2 t53 = pairs_loose_subtract(t51.a0, t51.a1, t52.a0, t52.a1);
    t_r2 t54 = pairs_loose_multiply(t6.a0, t6.a1, t53.a0, t53.a1), t55 = pairs_loose_add(k1, k1_, t20.a0, t20.a1);
    t_r2 t56 = pairs_loose_add(k2, k2_, t25.a0, t25.a1), t57 = pairs_loose_add(k3, k3_, t30.a0, t30.a1);
    t_r2 t58 = pairs_loose_add(g1, g1_, t44.a0, t44.a1), t59 = pairs_loose_add(g2, g2_, t49.a0, t49.a1);
    t_r2 t60 = pairs_loose_add(g3, g3_, t54.a0, t54.a1), o_l1 = pairs_two_sum(t55.a0, t55.a1);
    t_r2 o_l2 = pairs_two_sum(t56.a0, t56.a1), o_l3 = pairs_two_sum(t57.a0, t57.a1);
    t_r2 o_h1 = pairs_two_sum(t58.a0, t58.a1), o_h2 = pairs_two_sum(t59.a0, t59.a1);
    t_r2 o_h3 = pairs_two_sum(t60.a0, t60.a1);
    return (t_r12){o_l1.a0, o_l1.a1, o_l2.a0, o_l2.a1, o_l3.a0, o_l3.a1, o_h1.a0, o_h1.a1, o_h2.a0, o_h2.a1, o_h3.a0,
        o_h3.a1};
}

INLINE void double_double_loop_turn_both(real u1, real u1_, real u2, real u2_, real u3, real u3_, r1 state) {
    t_r12 t_1 = double_double_turn_pairs(u1, u1_, u2, u2_, u3, u3_, state.p[0], state.p[1], state.p[2], state.p[3],
        state.p[4], state.p[5], state.p[6], state.p[7], state.p[8], state.p[9], state.p[10], state.p[11]);
    state.p[0] = t_1.a0; state.p[1] = t_1.a1; state.p[2] = t_1.a2; state.p[3] = t_1.a3; state.p[4] = t_1.a4;
    state.p[5] = t_1.a5; state.p[6] = t_1.a6; state.p[7] = t_1.a7; state.p[8] = t_1.a8; state.p[9] = t_1.a9;
    state.p[10] = t_1.a10; state.p[11] = t_1.a11;
}

INLINE t_r2 pairs_add(real a, real a_, real b, real b_) {
    t_r2 t_1 = pairs_two_sum(a, b); real s = t_1.a0, s_ = t_1.a1;
    t_r2 t = pairs_two_sum(a_, b_), t_2 = pairs_quick_two_sum(s, s_ + t.a0); s = t_2.a0; s_ = t_2.a1;
    return pairs_quick_two_sum(s, t.a1 + s_);
}

INLINE t_r2 pairs_subtract(real a, real a_, real b, real b_) { return pairs_add(a, a_, -b, -b_); }
OUT_OF_LINE void double_double_loop_restore_pairs(r1 state) {
    r1 k = r1_part(state, 0, 6), g = r1_part(state, 6, 12), h = r1_part(state, 22, 28);
    t_r2 t_1 = double_double_loop_inner(g, g), unit = pairs_subtract(h.p[0], h.p[1], t_1.a0, t_1.a1);
    t_r2 t_2 = double_double_loop_inner(k, g), height = pairs_subtract(h.p[2], h.p[3], t_2.a0, t_2.a1);
    t_r2 t_3 = double_double_loop_inner(k, k), squared = pairs_subtract(h.p[4], h.p[5], t_3.a0, t_3.a1);
    t_r3 stretch = integrals_shares(unit.a0, height.a0, squared.a0, h.p[0], h.p[2], h.p[4]);
    for (int64_t i = 0; i < 6; i += 2) {
        t_r2 t_4 = pairs_two_sum(k.p[i], k.p[i + 1] + (stretch.a1 * k.p[i] + stretch.a2 * g.p[i])); k.p[i] = t_4.a0;
        k.p[i + 1] = t_4.a1; t_r2 t_5 = pairs_two_sum(g.p[i], g.p[i + 1] + stretch.a0 * g.p[i]); g.p[i] = t_5.a0;
        g.p[i + 1] = t_5.a1;
    }
}

INLINE void double_double_loop_write(r1 frame, r1 frame_, r1 pairs, int64_t at, int64_t exponent) {
    for (int64_t i = 0, end_i = frame.n0; i < end_i; i++) {
        frame.p[i] = R(ldexp(pairs.p[at + 2 * i], (int)exponent));
        frame_.p[i] = R(ldexp(pairs.p[at + 2 * i + 1], (int)exponent));
    }
}

INLINE t_i2r double_double_loop_march_pairs(r1 state, r2 c, r1 radius, r1 enough, r3 past, int64_t first, int64_t
    count, int64_t every, int64_t shift, int64_t beyond, r2 momenta, r2 momenta_, r2 verticals, r2 verticals_, int
    with_body, r1 attitude, r1 contact, real rho, r2 attitudes, r2 attitudes_, r2 traces, r2 traces_) {
    t_ir7 status; int64_t frame; int64_t period = max_i(1, div_i(1024, c.n0));
    for (int64_t step = first + 1, end_step = first + count + 1; step < end_step; step++) {
        for (int64_t i = 0, end_i = c.n0; i < end_i; i++) {
            status = double_double_loop_stage(state, AT2(c, i, 0), AT2(c, i, 1), radius.p[i], enough.p[i],
                r3_row(past, i));
            if (status.a0 != 0) { return (t_i2r){step - 1 - first, status.a0, status.a1}; }
            if (with_body) {
                double_double_loop_follow_body(status.a2, status.a3, status.a4, status.a5, status.a6, status.a7,
                    state, attitude, contact, rho);
            }
            double_double_loop_turn_both(status.a2, status.a3, status.a4, status.a5, status.a6, status.a7, state);
        }
        if (mod_i(step, period) == 0) { double_double_loop_restore_pairs(state); }
        if (mod_i(step, every) == 0) {
            frame = div_i(step, every);
            double_double_loop_write(r2_row(momenta, frame), r2_row(momenta_, frame), state, 0, -shift);
            double_double_loop_write(r2_row(verticals, frame), r2_row(verticals_, frame), state, 6, 0);
            if (with_body) {
                double_double_loop_write(r2_row(attitudes, frame), r2_row(attitudes_, frame), attitude, 0, 0);
                double_double_loop_write(r2_row(traces, frame), r2_row(traces_, frame), contact, 0, -beyond);
            }
        }
    }
    return (t_i2r){count, 0, R(1.0)};
}

INLINE void double_double_block_prepare_pairs_block(r2 momentum, r2 g, r2 tensor, r1 contact, r2 c, r2 state, i1
    shift, i1 beyond) {
    int64_t i; ALIGNED real one_[28]; r1 one = {one_, 28}; ALIGNED real radius_[1]; r1 radius = {radius_, 1};
    ALIGNED real enough_[1]; r1 enough = {enough_, 1}; int64_t last = contact.n0 - 1;
    for (int64_t lane = 0, end_lane = state.n1; lane < end_lane; lane++) {
        i = min_i(lane, last);
        t_i2 t_1 = double_double_loop_prepare_pairs(r2_row(momentum, i), r2_row(g, i), r2_row(tensor, i),
            contact.p[i], c, one, radius, enough);
        shift.p[i] = t_1.a0; beyond.p[i] = t_1.a1;
        for (int64_t row = 0; row < 52; row++) { AT2(state, row, lane) = row < 28 ? one.p[row] : R(0.0); }
        AT2(state, 52, lane) = radius.p[0]; AT2(state, 53, lane) = enough.p[0];
    }
}

INLINE int64_t double_double_block_approached(r2 S, r2 P, i1 ok, int again) {
    real radius, u1, u2, u3, x; int near, done; Round r; int64_t row; int64_t bad = 0;
    INDEPENDENT for (int64_t i = 0; i < 16; i++) {
        radius = AT2(S, 52, i);
        if (again) { u1 = AT2(P, 0, i); u2 = AT2(P, 1, i); u3 = AT2(P, 2, i); }
        else { u1 = AT2(S, 28, i); u2 = AT2(S, 29, i); u3 = AT2(S, 30, i); }
        near = u1 * u1 + (u2 * u2 + u3 * u3) <= radius; u1 = near ? u1 : R(0.0); u2 = near ? u2 : R(0.0);
        u3 = near ? u3 : R(0.0);
        r = gibbs_newton_round(u1, u2, u3, AT2(S, 0, i), AT2(S, 2, i), AT2(S, 4, i), AT2(S, 6, i), AT2(S, 8, i),
            AT2(S, 10, i), AT2(S, 12, i), AT2(S, 14, i), AT2(S, 16, i), AT2(S, 21, i), 0);
        done = again & (ok.p[i] == 1); row = 0; x = r.w1; AT2(P, row, i) = done ? AT2(P, row, i) : x; row = 1;
        x = r.w2; AT2(P, row, i) = done ? AT2(P, row, i) : x; row = 2; x = r.w3;
        AT2(P, row, i) = done ? AT2(P, row, i) : x; row = 3; x = r.d1; AT2(P, row, i) = done ? AT2(P, row, i) : x;
        row = 4; x = r.d2; AT2(P, row, i) = done ? AT2(P, row, i) : x; row = 5; x = r.d3;
        AT2(P, row, i) = done ? AT2(P, row, i) : x; row = 6; x = r.p0; AT2(P, row, i) = done ? AT2(P, row, i) : x;
        row = 7; x = r.c11; AT2(P, row, i) = done ? AT2(P, row, i) : x; row = 8; x = r.c12;
        AT2(P, row, i) = done ? AT2(P, row, i) : x; row = 9; x = r.c13; AT2(P, row, i) = done ? AT2(P, row, i) : x;
        row = 10; x = r.c21; AT2(P, row, i) = done ? AT2(P, row, i) : x; row = 11; x = r.c22;
        AT2(P, row, i) = done ? AT2(P, row, i) : x; row = 12; x = r.c23; AT2(P, row, i) = done ? AT2(P, row, i) : x;
        row = 13; x = r.c31; AT2(P, row, i) = done ? AT2(P, row, i) : x; row = 14; x = r.c32;
        AT2(P, row, i) = done ? AT2(P, row, i) : x; row = 15; x = r.c33; AT2(P, row, i) = done ? AT2(P, row, i) : x;
        ok.p[i] = (done | ((radius >= R(0.0)) & (r.first <= AT2(S, 53, i)))) ? 1 : 0;
        bad = bad + (radius >= R(0.0) ? 1 - ok.p[i] : 0);
    }
    return bad;
}

INLINE void double_double_block_residuals(r2 S, r2 P) {
    INDEPENDENT for (int64_t i = 0; i < 16; i++) {
        t_r6 t_1 = double_double_gibbs_residual_pairs(AT2(P, 0, i), AT2(P, 1, i), AT2(P, 2, i), AT2(S, 0, i), AT2(S,
            1, i), AT2(S, 2, i), AT2(S, 3, i), AT2(S, 4, i), AT2(S, 5, i), AT2(S, 6, i), AT2(S, 7, i), AT2(S, 8, i),
            AT2(S, 9, i), AT2(S, 10, i), AT2(S, 11, i), AT2(S, 12, i), AT2(S, 13, i), AT2(S, 14, i), AT2(S, 15, i),
            AT2(S, 16, i), AT2(S, 17, i), AT2(S, 21, i));
        AT2(P, 16, i) = t_1.a0; AT2(P, 17, i) = t_1.a2; AT2(P, 18, i) = t_1.a4;
    }
}

INLINE int64_t double_double_block_corrected(r2 S, r2 P, i1 ok) {
    real w1, w2, w3; Round r; t_r3 e1; int64_t bad = 0;
    INDEPENDENT for (int64_t i = 0; i < 16; i++) {
        w1 = AT2(P, 0, i); w2 = AT2(P, 1, i); w3 = AT2(P, 2, i);
        r = (Round){AT2(P, 6, i), R(0.0), R(0.0), R(0.0), w1, w2, w3, R(0.0), AT2(P, 3, i), AT2(P, 4, i), AT2(P, 5,
            i), AT2(P, 7, i), AT2(P, 8, i), AT2(P, 9, i), AT2(P, 10, i), AT2(P, 11, i), AT2(P, 12, i), AT2(P, 13, i),
            AT2(P, 14, i), AT2(P, 15, i)};
        e1 = double_double_step_correction(r, AT2(P, 16, i), AT2(P, 17, i), AT2(P, 18, i), AT2(S, 0, i), AT2(S, 2, i),
            AT2(S, 4, i), AT2(S, 12, i), AT2(S, 14, i), AT2(S, 16, i));
        AT2(P, 19, i) = e1.a0; AT2(P, 20, i) = e1.a1; AT2(P, 21, i) = e1.a2;
        ok.p[i] = ((ok.p[i] == 1) & double_double_step_small(w1, w2, w3, e1.a0, e1.a1, e1.a2)) ? 1 : 0;
        bad = bad + (1 - ok.p[i]);
    }
    return bad;
}

OUT_OF_LINE void double_double_block_mend(r2 S, r2 P, i1 ok, int64_t step, i1 taken, i1 status, d1 reach) {
    real u1, u1_, u2, u2_, u3, u3_;
    for (int64_t i = 0; i < 16; i++) {
        if (ok.p[i] == 1) { continue; }
        AT2(P, 0, i) = R(0.0); AT2(P, 1, i) = R(0.0); AT2(P, 2, i) = R(0.0); AT2(P, 19, i) = R(0.0);
        AT2(P, 20, i) = R(0.0); AT2(P, 21, i) = R(0.0);
        if (i < status.n0 && status.p[i] == 0) {
            real s_[S.n0]; r1 s = {s_, S.n0};
            for (int64_t i_ = 0; i_ < S.n0; i_++) { s_[i_] = AT2(S, i_, i); }
            t_ir7 t_1 = double_double_loop_stage(s, R(1.0), R(0.0), s.p[52], s.p[53], (r2){r1_part(s, 28, 52).p, 8, 3,
                3});
            status.p[i] = t_1.a0; reach.p[i] = t_1.a1; u1 = t_1.a2; u1_ = t_1.a3; u2 = t_1.a4; u2_ = t_1.a5;
            u3 = t_1.a6; u3_ = t_1.a7;
            if (status.p[i] == 0) {
                AT2(P, 0, i) = u1; AT2(P, 1, i) = u2; AT2(P, 2, i) = u3; AT2(P, 19, i) = u1_; AT2(P, 20, i) = u2_;
                AT2(P, 21, i) = u3_; continue;
            }
            taken.p[i] = step;
        }
        AT2(S, 52, i) = R(-1.0);
    }
}

INLINE void double_double_block_extrapolated(r2 S, int64_t row, int64_t i, real w) {
    t_r8 t_1 = sums_filtered(AT2(S, row + 3, i), AT2(S, row + 6, i), AT2(S, row + 9, i), AT2(S, row + 12, i), AT2(S,
        row + 15, i), AT2(S, row + 18, i), AT2(S, row + 21, i), w);
    AT2(S, row, i) = t_1.a0; AT2(S, row + 3, i) = t_1.a1; AT2(S, row + 6, i) = t_1.a2; AT2(S, row + 9, i) = t_1.a3;
    AT2(S, row + 12, i) = t_1.a4; AT2(S, row + 15, i) = t_1.a5; AT2(S, row + 18, i) = t_1.a6;
    AT2(S, row + 21, i) = t_1.a7;
}

INLINE void double_double_block_turned(r2 S, r2 P) {
    INDEPENDENT for (int64_t i = 0; i < 16; i++) {
        t_r2 t_1 = pairs_two_sum(AT2(P, 0, i), AT2(P, 19, i)), t_2 = pairs_two_sum(AT2(P, 1, i), AT2(P, 20, i));
        t_r2 t_3 = pairs_two_sum(AT2(P, 2, i), AT2(P, 21, i));
        t_r12 t_4 = double_double_turn_pairs(t_1.a0, t_1.a1, t_2.a0, t_2.a1, t_3.a0, t_3.a1, AT2(S, 0, i), AT2(S, 1,
            i), AT2(S, 2, i), AT2(S, 3, i), AT2(S, 4, i), AT2(S, 5, i), AT2(S, 6, i), AT2(S, 7, i), AT2(S, 8, i),
            AT2(S, 9, i), AT2(S, 10, i), AT2(S, 11, i));
        AT2(S, 0, i) = t_4.a0; AT2(S, 1, i) = t_4.a1; AT2(S, 2, i) = t_4.a2; AT2(S, 3, i) = t_4.a3;
        AT2(S, 4, i) = t_4.a4; AT2(S, 5, i) = t_4.a5; AT2(S, 6, i) = t_4.a6; AT2(S, 7, i) = t_4.a7;
        AT2(S, 8, i) = t_4.a8; AT2(S, 9, i) = t_4.a9; AT2(S, 10, i) = t_4.a10; AT2(S, 11, i) = t_4.a11;
        double_double_block_extrapolated(S, 28, i, AT2(P, 0, i) + AT2(P, 19, i));
        double_double_block_extrapolated(S, 29, i, AT2(P, 1, i) + AT2(P, 20, i));
        double_double_block_extrapolated(S, 30, i, AT2(P, 2, i) + AT2(P, 21, i));
    }
}

INLINE void double_double_block_march_pairs_block(r2 state, int64_t first, int64_t count, int64_t every, i1 shift, r3
    momenta, r3 momenta_, r3 verticals, r3 verticals_, i1 taken, i1 status, d1 reach) {
    int64_t bad, rounds, frame; ALIGNED real S_[54 * 16]; r2 S = {S_, 54, 16, 16}; ALIGNED real P_[22 * 16];
    r2 P = {P_, 22, 16, 16}; ALIGNED int64_t ok_[16]; i1 ok = {ok_, 16}; block_carry(state, S, 16);
    for (int64_t step = first, end_step = first + count; step < end_step; step++) {
        bad = double_double_block_approached(S, P, ok, 0); rounds = 1;
        while (bad != 0 && rounds < 4) { bad = double_double_block_approached(S, P, ok, 1); rounds = rounds + 1; }
        double_double_block_residuals(S, P);
        if (double_double_block_corrected(S, P, ok) != 0) {
            double_double_block_mend(S, P, ok, step, taken, status, reach);
        }
        double_double_block_turned(S, P);
        if (mod_i(step + 1, 1024) == 0) {
            for (int64_t i = 0; i < 16; i++) {
                real one_[28]; r1 one = {one_, 28};
                for (int64_t i_ = 0; i_ < 28; i_++) { one_[i_] = AT2(S, i_, i); }
                double_double_loop_restore_pairs(one);
                for (int64_t row = 0; row < 28; row++) { AT2(S, row, i) = one.p[row]; }
            }
        }
        if (mod_i(step + 1, every) == 0) {
            frame = div_i(step + 1, every);
            for (int64_t i = 0, end_i = status.n0; i < end_i; i++) {
                if (status.p[i] == 0) {
                    real one_[S.n0]; r1 one = {one_, S.n0};
                    for (int64_t i_ = 0; i_ < S.n0; i_++) { one_[i_] = AT2(S, i_, i); }
                    double_double_loop_write(r2_row(r3_row(momenta, i), frame), r2_row(r3_row(momenta_, i), frame),
                        one, 0, -(int64_t)shift.p[i]);
                    double_double_loop_write(r2_row(r3_row(verticals, i), frame), r2_row(r3_row(verticals_, i),
                        frame), one, 6, 0);
                }
            }
        }
    }
    for (int64_t i = 0, end_i = status.n0; i < end_i; i++) {
        if (status.p[i] == 0) { taken.p[i] = first + count; }
    }
    block_carry(S, state, 16);
}

INLINE t_r12 double_double_rotate_pairs(real a0, real a0_, real a1, real a1_, real a2, real a2_, real a3, real a3_,
    real k1, real k1_, real k2, real k2_, real k3, real k3_, real g1, real g1_, real g2, real g2_, real g3, real g3_)
    {
    t_r2 t0 = pairs_loose_multiply(a2, a2_, a2, a2_), t1 = pairs_loose_multiply(a3, a3_, a3, a3_);
    real t2 = 2 * k1, t2_ = 2 * k1_;
    t_r2 t3 = pairs_loose_multiply(a0, a0_, a2, a2_), t4 = pairs_loose_multiply(a1, a1_, a3, a3_);
    t_r2 t5 = pairs_loose_multiply(a0, a0_, a3, a3_), t6 = pairs_loose_multiply(a1, a1_, a2, a2_);
    real t7 = 2 * k2, t7_ = 2 * k2_;
    t_r2 t8 = pairs_loose_multiply(a1, a1_, a1, a1_), t9 = pairs_loose_multiply(a0, a0_, a1, a1_);
    t_r2 t10 = pairs_loose_multiply(a2, a2_, a3, a3_); real t11 = 2 * k3, t11_ = 2 * k3_;
    t_r2 t12 = pairs_loose_add(t3.a0, t3.a1, t4.a0, t4.a1), t13 = pairs_loose_multiply(t11, t11_, t12.a0, t12.a1);
    t_r2 t14 = pairs_loose_add(k1, k1_, t13.a0, t13.a1), t15 = pairs_loose_add(t0.a0, t0.a1, t1.a0, t1.a1);
    t_r2 t16 = pairs_loose_multiply(t2, t2_, t15.a0, t15.a1), t17 = pairs_loose_subtract(t5.a0, t5.a1, t6.a0, t6.a1);
    t_r2 t18 = pairs_loose_multiply(t7, t7_, t17.a0, t17.a1), t19 = pairs_loose_add(t16.a0, t16.a1, t18.a0, t18.a1);
    t_r2 t20 = pairs_loose_subtract(t14.a0, t14.a1, t19.a0, t19.a1);
    t_r2 t21 = pairs_loose_add(t5.a0, t5.a1, t6.a0, t6.a1), t22 = pairs_loose_multiply(t2, t2_, t21.a0, t21.a1);
    t_r2 t23 = pairs_loose_add(k2, k2_, t22.a0, t22.a1), t24 = pairs_loose_subtract(t9.a0, t9.a1, t10.a0, t10.a1);
    t_r2 t25 = pairs_loose_multiply(t11, t11_, t24.a0, t24.a1), t26 = pairs_loose_add(t1.a0, t1.a1, t8.a0, t8.a1);
    t_r2 t27 = pairs_loose_multiply(t7, t7_, t26.a0, t26.a1), t28 = pairs_loose_add(t25.a0, t25.a1, t27.a0, t27.a1);
    t_r2 t29 = pairs_loose_subtract(t23.a0, t23.a1, t28.a0, t28.a1);
    t_r2 t30 = pairs_loose_add(t9.a0, t9.a1, t10.a0, t10.a1), t31 = pairs_loose_multiply(t7, t7_, t30.a0, t30.a1);
    t_r2 t32 = pairs_loose_add(k3, k3_, t31.a0, t31.a1), t33 = pairs_loose_add(t0.a0, t0.a1, t8.a0, t8.a1);
    t_r2 t34 = pairs_loose_multiply(t11, t11_, t33.a0, t33.a1);
    t_r2 t35 = pairs_loose_subtract(t3.a0, t3.a1, t4.a0, t4.a1), t36 = pairs_loose_multiply(t2, t2_, t35.a0, t35.a1);
    t_r2 t37 = pairs_loose_add(t34.a0, t34.a1, t36.a0, t36.a1);
    t_r2 t38 = pairs_loose_subtract(t32.a0, t32.a1, t37.a0, t37.a1);
    real t39 = 2 * g1, t39_ = 2 * g1_, t40 = 2 * g2, t40_ = 2 * g2_, t41 = 2 * g3, t41_ = 2 * g3_;
    t_r2 t42 = pairs_loose_multiply(t12.a0, t12.a1, t41, t41_), t43 = pairs_loose_add(g1, g1_, t42.a0, t42.a1);
    t_r2 t44 = pairs_loose_multiply(t15.a0, t15.a1, t39, t39_);
    t_r2 t45 = pairs_loose_multiply(t17.a0, t17.a1, t40, t40_);
    t_r2 t46 = pairs_loose_add(t44.a0, t44.a1, t45.a0, t45.a1);
    t_r2 t47 = pairs_loose_subtract(t43.a0, t43.a1, t46.a0, t46.a1);
    t_r2 t48 = pairs_loose_multiply(t21.a0, t21.a1, t39, t39_), t49 = pairs_loose_add(g2, g2_, t48.a0, t48.a1);
    t_r2 t50 = pairs_loose_multiply(t24.a0, t24.a1, t41, t41_);
    t_r2 t51 = pairs_loose_multiply(t26.a0, t26.a1, t40, t40_);
    t_r2 t52 = pairs_loose_add(t50.a0, t50.a1, t51.a0, t51.a1);
    t_r2 t53 = pairs_loose_subtract(t49.a0, t49.a1, t52.a0, t52.a1);
    t_r2 t54 = pairs_loose_multiply(t30.a0, t30.a1, t40, t40_), t55 = pairs_loose_add(g3, g3_, t54.a0, t54.a1);
    t_r2 t56 = pairs_loose_multiply(t33.a0, t33.a1, t41, t41_);
    t_r2 t57 = pairs_loose_multiply(t35.a0, t35.a1, t39, t39_);
    t_r2 t58 = pairs_loose_add(t56.a0, t56.a1, t57.a0, t57.a1);
    t_r2 t59 = pairs_loose_subtract(t55.a0, t55.a1, t58.a0, t58.a1), o_l1 = pairs_two_sum(t20.a0, t20.a1);
    t_r2 o_l2 = pairs_two_sum(t29.a0, t29.a1), o_l3 = pairs_two_sum(t38.a0, t38.a1);
    t_r2 o_h1 = pairs_two_sum(t47.a0, t47.a1), o_h2 = pairs_two_sum(t53.a0, t53.a1);
    t_r2 o_h3 = pairs_two_sum(t59.a0, t59.a1);
    return (t_r12){o_l1.a0, o_l1.a1, o_l2.a0, o_l2.a1, o_l3.a0, o_l3.a1, o_h1.a0, o_h1.a1, o_h2.a0, o_h2.a1, o_h3.a0,
        o_h3.a1};
}

INLINE void double_double_long_turned_into(r1 vectors, r1 attitude, real way, r1 to) {
    t_r12 t_1 = double_double_rotate_pairs(attitude.p[0], attitude.p[1], way * attitude.p[2], way * attitude.p[3], way
        * attitude.p[4], way * attitude.p[5], way * attitude.p[6], way * attitude.p[7], vectors.p[0], vectors.p[1],
        vectors.p[2], vectors.p[3], vectors.p[4], vectors.p[5], vectors.p[6], vectors.p[7], vectors.p[8],
        vectors.p[9], vectors.p[10], vectors.p[11]);
    to.p[0] = t_1.a0; to.p[1] = t_1.a1; to.p[2] = t_1.a2; to.p[3] = t_1.a3; to.p[4] = t_1.a4; to.p[5] = t_1.a5;
    to.p[6] = t_1.a6; to.p[7] = t_1.a7; to.p[8] = t_1.a8; to.p[9] = t_1.a9; to.p[10] = t_1.a10; to.p[11] = t_1.a11;
}

INLINE t_ir double_double_long_column(r1 state, int64_t n, real radius, real enough, real rho, r1 body) {
    t_ir7 status; r1 attitude = r1_part(body, 0, 8), contact = r1_part(body, 8, 12);
    t_r3 t_1 = kernel_angular_velocity(state.p[0], state.p[2], state.p[4], state.p[6], state.p[8], state.p[10],
        state.p[18], state.p[19], state.p[20], state.p[21]);
    real u1 = t_1.a0, u2 = t_1.a1, u3 = t_1.a2, v1 = u1, v2 = u2, v3 = u3;
    for (int64_t i_0 = 0, end_i_0 = n; i_0 < end_i_0; i_0++) {
        status = double_double_step_solved(u1, u2, u3, state.p[0], state.p[1], state.p[2], state.p[3], state.p[4],
            state.p[5], state.p[6], state.p[7], state.p[8], state.p[9], state.p[10], state.p[11], state.p[12],
            state.p[13], state.p[14], state.p[15], state.p[16], state.p[17], state.p[18], state.p[19], state.p[20],
            state.p[21], radius, enough);
        if (status.a0 != 0) { return (t_ir){status.a0, status.a1}; }
        double_double_loop_follow_body(status.a2, status.a3, status.a4, status.a5, status.a6, status.a7, state,
            attitude, contact, rho);
        double_double_loop_turn_both(status.a2, status.a3, status.a4, status.a5, status.a6, status.a7, state);
        u1 = R(2.0) * status.a2 - v1; u2 = R(2.0) * status.a4 - v2; u3 = R(2.0) * status.a6 - v3; v1 = status.a2;
        v2 = status.a4; v3 = status.a6;
    }
    return (t_ir){0, R(1.0)};
}

INLINE void double_double_long_add_share(r1 sums, real w, real w_, r1 numbers, int64_t count) {
    real x, x_;
    for (int64_t i = 0, end_i = 2 * count; i < end_i; i += 2) {
        t_r2 t_1 = pairs_multiply(w, w_, numbers.p[i], numbers.p[i + 1]); x = t_1.a0; x_ = t_1.a1;
        t_r2 t_2 = pairs_loose_add(sums.p[i], sums.p[i + 1], x, x_); x = t_2.a0; x_ = t_2.a1;
        t_r2 t_3 = pairs_two_sum(x, x_); sums.p[i] = t_3.a0; sums.p[i + 1] = t_3.a1;
    }
}

INLINE void double_double_long_to_length_one(r1 q) {
    real x, x_; t_r2 t_1 = pairs_loose_multiply(q.p[0], q.p[1], q.p[0], q.p[1]); real n = t_1.a0, n_ = t_1.a1;
    for (int64_t i = 2; i < 8; i += 2) {
        t_r2 t_2 = pairs_loose_multiply(q.p[i], q.p[i + 1], q.p[i], q.p[i + 1]); x = t_2.a0; x_ = t_2.a1;
        t_r2 t_3 = pairs_loose_add(n, n_, x, x_); n = t_3.a0; n_ = t_3.a1;
    }
    t_r2 t_4 = pairs_two_sum(n, n_); x = t_4.a0; x_ = t_4.a1; t_r2 t_5 = pairs_root(x, x_); n = t_5.a0; n_ = t_5.a1;
    for (int64_t i = 0; i < 8; i += 2) {
        t_r2 t_6 = pairs_divide(q.p[i], q.p[i + 1], n, n_); q.p[i] = t_6.a0; q.p[i + 1] = t_6.a1;
    }
}

INLINE t_i2r2 double_double_long_march_long_pairs(r1 momentum, r1 g, r1 tensor, real contact, real h, real h_, int64_t
    first, int64_t count, int64_t every, r2 weights, real rho, int follows, r1 attitude, r1 body, r2 momenta, r2
    momenta_, r2 verticals, r2 verticals_, r2 attitudes, r2 attitudes_, r2 traces, r2 traces_) {
    real s, a, b, c_, d; int64_t n, frame; t_r2 f, x; t_ir status; int64_t columns = weights.n0; real doubt = R(0.0);
    ALIGNED real state_[28]; memset(state_, 0, sizeof state_); r1 state = {state_, 28}; ALIGNED real one_[1 * 2];
    memset(one_, 0, sizeof one_); r2 one = {one_, 1, 2, 2}; ALIGNED real limits_[2 * columns];
    memset(limits_, 0, sizeof limits_); r2 limits = {limits_, 2, columns, columns}; ALIGNED real space_[12];
    memset(space_, 0, sizeof space_); r1 space = {space_, 12}; ALIGNED real moved_[12];
    memset(moved_, 0, sizeof moved_); r1 moved = {moved_, 12}; ALIGNED real sums_[12]; memset(sums_, 0, sizeof sums_);
    r1 sums = {sums_, 12}; ALIGNED real changes_[8]; memset(changes_, 0, sizeof changes_); r1 changes = {changes_, 8};
    AT2(one, 0, 0) = R(1.0);
    t_ri size = real_frexp(max_r(max_r(R(fabs(momentum.p[0])), R(fabs(momentum.p[1]))), R(fabs(momentum.p[2]))));
    t_ri mantissa = real_frexp(h); ALIGNED real part_[3]; memset(part_, 0, sizeof part_); r1 part = {part_, 3};
    for (int64_t c = 0; c < 3; c++) {
        part.p[c] = R(ldexp(R(ldexp(momentum.p[c], (int)-size.a1)), (int)min_i(size.a1 + mantissa.a1, 1000)));
    }
    t_i2 shift = double_double_loop_prepare_pairs(part, g, tensor, contact, one, state, r2_row(limits, 0),
        r2_row(limits, 1));
    real half = R(ldexp(mantissa.a0, (int)min_i(size.a1 + mantissa.a1 + shift.a0, 100)));
    real half_ = R(ldexp(R(ldexp(h_, (int)-mantissa.a1)), (int)min_i(size.a1 + mantissa.a1 + shift.a0, 100)));
    for (int64_t c = 0; c < 3; c++) { moved.p[2 * c] = R(ldexp(momentum.p[c], (int)-size.a1)); }
    for (int64_t c = 0; c < 6; c++) { moved.p[6 + c] = state.p[6 + c]; }
    for (int64_t j = 0, end_j = columns; j < end_j; j++) {
        s = half / (3 + j);
        t_r2 t_1 = double_double_step_bounds(s * moved.p[0], s * moved.p[2], s * moved.p[4], state.p[12], state.p[14],
            state.p[16], state.p[21]);
        AT2(limits, 0, j) = t_1.a0; AT2(limits, 1, j) = t_1.a1;
    }
    double_double_long_turned_into(moved, attitude, R(1.0), space);
    for (int64_t step = first, end_step = first + count; step < end_step; step++) {
        r1_fill(sums, R(0.0)); r1_fill(changes, R(0.0));
        for (int64_t j = 0, end_j = columns; j < end_j; j++) {
            n = 3 + j; double_double_long_turned_into(space, body, R(-1.0), state);
            f = pairs_divide(half, half_, n * R(1.0), R(0.0));
            for (int64_t c = 0; c < 6; c += 2) {
                t_r2 t_2 = pairs_multiply(state.p[0 + c], state.p[0 + c + 1], f.a0, f.a1); state.p[0 + c] = t_2.a0;
                state.p[0 + c + 1] = t_2.a1;
            }
            for (int64_t c = 0; c < 8; c++) { moved.p[c] = body.p[c]; moved.p[8 + div_i(c, 2)] = R(0.0); }
            status = double_double_long_column(state, n, AT2(limits, 0, j), AT2(limits, 1, j), rho, moved);
            if (status.a0 != 0) { return (t_i2r2){step - first, status.a0, status.a1, doubt}; }
            double_double_long_add_share(sums, AT2(weights, j, 0), AT2(weights, j, 1), moved, 6);
            double_double_long_add_share(changes, AT2(weights, j, 2), AT2(weights, j, 3), moved, 4);
        }
        for (int64_t c = 0; c < 8; c++) { body.p[c] = sums.p[c]; }
        double_double_long_to_length_one(body);
        for (int64_t c = 8; c < 12; c += 2) {
            x = pairs_loose_add(body.p[c], body.p[c + 1], sums.p[c], sums.p[c + 1]);
            t_r2 t_3 = pairs_two_sum(x.a0, x.a1); body.p[c] = t_3.a0; body.p[c + 1] = t_3.a1;
        }
        a = changes.p[0]; b = changes.p[2]; c_ = changes.p[4]; d = changes.p[6];
        doubt = doubt + R(2.0) * R(sqrt(a * a + b * b + (c_ * c_ + d * d)));
        if (mod_i(step + 1, every) == 0) {
            frame = div_i(step + 1, every); double_double_long_turned_into(space, body, R(-1.0), state);
            double_double_loop_write(r2_row(momenta, frame), r2_row(momenta_, frame), state, 0, size.a1);
            double_double_loop_write(r2_row(verticals, frame), r2_row(verticals_, frame), state, 6, 0);
            if (follows) {
                double_double_loop_write(r2_row(attitudes, frame), r2_row(attitudes_, frame), body, 0, 0);
                double_double_loop_write(r2_row(traces, frame), r2_row(traces_, frame), body, 8, -shift.a1);
            }
        }
    }
    return (t_i2r2){count, 0, R(1.0), doubt};
}

INLINE t_r3 tangent_cross(real a1, real a2, real a3, real b1, real b2, real b3) {
    return (t_r3){a2 * b3 - a3 * b2, a3 * b1 - a1 * b3, a1 * b2 - a2 * b1};
}

INLINE t_r3 tangent_column(real x1, real x2, real x3, real u1, real u2, real u3, r1 state, real det, r1 c) {
    t_r3 g1 = loop_three(state, 3), a1 = tangent_cross(state.p[0], state.p[1], state.p[2], x1, x2, x3);
    t_r3 b1 = tangent_cross(g1.a0, g1.a1, g1.a2, x1, x2, x3); real length = R(1.0) + (u1 * u1 + u2 * u2 + u3 * u3);
    real along = state.p[24] * (g1.a0 * u1 + g1.a1 * u2 + g1.a2 * u3);
    real across = state.p[24] * (b1.a0 * u1 + b1.a1 * u2 + b1.a2 * u3);
    real r1 = along * b1.a0 + across * g1.a0 + length * a1.a0, r2 = along * b1.a1 + across * g1.a1 + length * a1.a1;
    real r3 = along * b1.a2 + across * g1.a2 + length * a1.a2, d1 = (c.p[0] * r1 + c.p[3] * r2 + c.p[6] * r3) / det;
    real d2 = (c.p[1] * r1 + c.p[4] * r2 + c.p[7] * r3) / det, d3 = (c.p[2] * r1 + c.p[5] * r2 + c.p[8] * r3) / det;
    t_r3 v1 = tangent_cross(u1, u2, u3, d1, d2, d3), t1 = kernel_turn(R(1.0), u1, u2, u3, x1, x2, x3);
    real f = R(2.0) / length;
    return (t_r3){x1 + t1.a0 + f * (d1 - v1.a0), x2 + t1.a1 + f * (d2 - v1.a1), x3 + t1.a2 + f * (d3 - v1.a2)};
}

INLINE void tangent_derivative(real u1, real u2, real u3, r1 state, r2 T) {
    real x, y, z; t_r3 t_1 = loop_three(state, 0), t_2 = loop_three(state, 3), t_3 = loop_three(state, 21);
    t_r13 t_4 = kernel_gibbs_newton(u1, u2, u3, t_1.a0, t_1.a1, t_1.a2, t_2.a0, t_2.a1, t_2.a2, t_3.a0, t_3.a1,
        t_3.a2, state.p[24]);
    real found_[] = {t_4.a0, t_4.a1, t_4.a2, t_4.a3, t_4.a4, t_4.a5, t_4.a6, t_4.a7, t_4.a8, t_4.a9, t_4.a10, t_4.a11,
        t_4.a12};
    r1 found = {found_, 13};
    for (int64_t i = 0; i < 3; i++) {
        x = i == 0 ? R(1.0) : R(0.0); y = i == 1 ? R(1.0) : R(0.0); z = i == 2 ? R(1.0) : R(0.0);
        t_r3 t_5 = tangent_column(x, y, z, u1, u2, u3, state, found.p[0], r1_part(found, 4, 13));
        AT2(T, i, 0) = t_5.a0; AT2(T, i, 1) = t_5.a1; AT2(T, i, 2) = t_5.a2;
    }
}

INLINE void tangent_moved(r2 T, r2 frame, r1 growth) {
    real a, b, c, along, length;
    for (int64_t j = 0; j < 3; j++) {
        a = AT2(frame, j, 0); b = AT2(frame, j, 1); c = AT2(frame, j, 2);
        for (int64_t i = 0; i < 3; i++) { AT2(frame, j, i) = AT2(T, 0, i) * a + AT2(T, 1, i) * b + AT2(T, 2, i) * c; }
        for (int64_t before = 0, end_before = j; before < end_before; before++) {
            along = R(0.0);
            for (int64_t i = 0; i < 3; i++) { along = along + AT2(frame, before, i) * AT2(frame, j, i); }
            for (int64_t i = 0; i < 3; i++) { AT2(frame, j, i) = AT2(frame, j, i) - along * AT2(frame, before, i); }
        }
        length = R(sqrt(AT2(frame, j, 0) * AT2(frame, j, 0) + AT2(frame, j, 1) * AT2(frame, j, 1) + AT2(frame, j, 2) *
            AT2(frame, j, 2)));
        for (int64_t i = 0; i < 3; i++) { AT2(frame, j, i) = AT2(frame, j, i) / length; }
        growth.p[j] = growth.p[j] + R(log(length));
    }
}

INLINE real tangent_determinant(r2 T) {
    t_r3 n1 = tangent_cross(AT2(T, 1, 0), AT2(T, 1, 1), AT2(T, 1, 2), AT2(T, 2, 0), AT2(T, 2, 1), AT2(T, 2, 2));
    return AT2(T, 0, 0) * n1.a0 + AT2(T, 0, 1) * n1.a1 + AT2(T, 0, 2) * n1.a2;
}

INLINE real kernel_energy(real K1, real K2, real K3, real g1, real g2, real g3, real J1, real J2, real J3, real D) {
    real t0 = J2 + J3, t1 = R(1) / (D + t0), t2 = J1 + J3, t3 = R(1) / (D + t2), t4 = J1 + J2, t5 = R(1) / (D + t4);
    real t6 = K1 * g1 * t1 + K2 * g2 * t3 + K3 * g3 * t5;
    real o_T = K1 * K1 * t1 / 2 + K2 * K2 * t3 / 2 + (K3 * K3 * t5 / 2 + D * t6 * t6 / (2 * (g1 * g1 * t0 * t1 + g2 *
        g2 * t2 * t3 + g3 * g3 * t4 * t5)));
    return o_T;
}

INLINE real tangent_weight(int64_t n, int64_t count) {
    real t = (n + R(1.0)) / (count + R(1.0)); return R(exp(R(-1.0) / (t * (R(1.0) - t))));
}

INLINE void tangent_follow(r1 momentum, r1 gamma, r1 tensor, real contact, int64_t steps, r1 row) {
    int64_t status, second; real p0, p1, p2, p3, volume, E, share, z1, z2, z3; t_r3 k1, g1; ALIGNED real state_[27];
    r1 state = {state_, 27}; ALIGNED real frame_[3 * 3]; memset(frame_, 0, sizeof frame_);
    r2 frame = {frame_, 3, 3, 3};
    for (int64_t i_ = 0; i_ < 3; i_++) { frame_[i_ * (3 + 1)] = 1; }
    ALIGNED real growth_[3]; memset(growth_, 0, sizeof growth_); r1 growth = {growth_, 3}; ALIGNED real T_[3 * 3];
    r2 T = {T_, 3, 3, 3};
    real scale = loop_scaled(momentum, gamma, tensor, contact, state), u1 = R(0.0), u2 = R(0.0), u3 = R(0.0);
    int64_t half = div_i(steps, 2); real total = R(0.0); r1_fill(row, R(0.0)); row.p[8] = R(INFINITY);
    row.p[9] = R(-INFINITY);
    for (int64_t n = 0, end_n = 2 * half; n < end_n; n++) {
        t_ir8 t_1 = loop_safe_rotation(u1, u2, u3, state); status = t_1.a0; p0 = t_1.a2; p1 = t_1.a3; p2 = t_1.a4;
        p3 = t_1.a5; u1 = t_1.a6; u2 = t_1.a7; u3 = t_1.a8;
        if (status != 0 || p0 == R(0.0)) { return; }
        tangent_derivative(u1, u2, u3, state, T); tangent_moved(T, frame, growth);
        volume = R(log(R(fabs(tangent_determinant(T))))); k1 = loop_three(state, 0); g1 = loop_three(state, 3);
        E = kernel_energy(scale * k1.a0, scale * k1.a1, scale * k1.a2, g1.a0, g1.a1, g1.a2, tensor.p[0], tensor.p[1],
            tensor.p[2], contact);
        second = n >= half ? 1 : 0; share = tangent_weight(n - second * half, half);
        total = total + (second == 1 ? R(0.0) : share); row.p[4 + second] = row.p[4 + second] + share * volume;
        row.p[6 + second] = row.p[6 + second] + share * E; real t_2 = min_r(row.p[8], E), t_3 = max_r(row.p[9], E);
        row.p[8] = t_2; row.p[9] = t_3; t_r3 t_4 = kernel_turn(p0, p1, p2, p3, k1.a0, k1.a1, k1.a2); z1 = t_4.a0;
        z2 = t_4.a1; z3 = t_4.a2; loop_put(state, 0, k1.a0 + z1, k1.a1 + z2, k1.a2 + z3);
        t_r3 t_5 = kernel_turn(p0, p1, p2, p3, g1.a0, g1.a1, g1.a2); z1 = t_5.a0; z2 = t_5.a1; z3 = t_5.a2;
        loop_put(state, 3, g1.a0 + z1, g1.a1 + z2, g1.a2 + z3); row.p[0] = n + R(1.0);
    }
    for (int64_t c = 0; c < 3; c++) { row.p[1 + c] = growth.p[c]; }
    for (int64_t c = 4; c < 8; c++) { row.p[c] = row.p[c] / total; }
}

INLINE void tangent_follow_all(r2 momenta, r2 gammas, r1 tensor, real contact, int64_t steps, r2 rows) {
    for (int64_t i = 0, end_i = momenta.n0; i < end_i; i++) {
        tangent_follow(r2_row(momenta, i), r2_row(gammas, i), tensor, contact, steps, r2_row(rows, i));
    }
}

INLINE int64_t following_steps_in(real time, real step) {
    int64_t count = (int64_t)(time / step);
    return max_i(count * step >= time * R(0.999999999) ? count : count + 1, 1);
}

INLINE int following_aimed(r1 lane, int64_t frames, real interval) {
    int64_t goal = frames - 1; real step = min_r(lane.p[13], lane.p[20]), time = lane.p[5] * interval - lane.p[0];
    int64_t count = following_steps_in(time, lane.p[13]);
    if (time >= R(0.7) * step * count) { goal = (int64_t)lane.p[5]; }
    else { time = goal * interval - lane.p[0]; count = following_steps_in(time, step); }
    real before = lane.p[1]; lane.p[19] = goal; lane.p[3] = count; lane.p[1] = time / count;
    if (R(fabs(lane.p[1] - before)) <= R(1e-09) * before) { lane.p[1] = before; return 0; }
    return 1;
}

INLINE void carried_begun(r2 E, int64_t B, int64_t b, real J1, real J2, real J3, real start) {
    int64_t i;
    for (int64_t lane = 0; lane < 4; lane++) {
        i = lane * B + b;
        for (int64_t c = 0; c < 3; c++) { AT2(E, 38 + c, i) = c == lane ? R(1.0) : R(0.0); }
        AT2(E, 51, i) = J1; AT2(E, 52, i) = J2; AT2(E, 53, i) = J3;
        for (int64_t row = 59; row < 115; row++) { AT2(E, row, i) = R(0.0); }
    }
    AT2(E, 64, b) = start * start; AT2(E, 67, b) = start * start; AT2(E, 69, b) = start * start;
}

INLINE int64_t following_taken_in(r2 S, r2 E, int64_t B, int64_t b, int64_t columns, int64_t i, real first, real
    allowed, real start, r3 momenta, r3 verticals, r3 attitudes, r3 traces, r2 J0, r1 D0, r1 radius, int64_t frames,
    real interval, int follows, r2 sums, r2 beginning, r1 body, r1 state, r1 lane, r2 reported, int traced) {
    long_run_placed(body, i, momenta, verticals, attitudes, traces, follows, traced); r1_fill(lane, R(0.0));
    lane.p[4] = i; lane.p[5] = R(1.0); lane.p[18] = allowed; lane.p[13] = first; lane.p[10] = R(1e+300);
    lane.p[20] = R(1e+300); following_aimed(lane, frames, interval);
    int64_t exponent = long_run_enter(S, B, b, columns, r2_row(J0, i), D0.p[i], radius.p[i], lane.p[1], sums,
        beginning, body, state);
    lane.p[2] = R(2.0) * AT2(S, 129, b) / lane.p[1];
    carried_begun(E, B, b, AT2(S, 131, b), AT2(S, 132, b), AT2(S, 133, b), start);
    for (int64_t c = 0; c < 6; c++) { AT2(reported, i, c) = c == 5 ? R(1.0) : R(0.0); }
    return exponent;
}

INLINE void carried_tangent(r2 S, r2 E, int64_t B, int64_t at, int traced) {
    real one, g1, g2, g3, J1, J2, J3, contact, I1, I2, I3, m1, m2, m3, s1, s2, s3, n1, n2, n3, least, v1, v2, v3, u1,
        u2, u3, e1, e2, e3, v, u, f1, f2, f3, up, over, p1, p2, p3, z1, z2, z3, b1, b2, b3, q0, q1, q2, q3;
    t_r3 w1, a1, t1;
    for (int64_t row = 0; row < 10; row++) {
        INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
            one = AT2(S, 105 + row, b); AT2(E, 41 + row, b) = one; AT2(E, 41 + row, B + b) = one;
            AT2(E, 41 + row, 2 * B + b) = one; AT2(E, 41 + row, 3 * B + b) = one;
        }
    }
    INDEPENDENT for (int64_t i = 0, end_i = 4 * B; i < end_i; i++) {
        g1 = AT2(E, 44, i); g2 = AT2(E, 45, i); g3 = AT2(E, 46, i); J1 = AT2(E, 51, i); J2 = AT2(E, 52, i);
        J3 = AT2(E, 53, i); contact = AT2(S, 30, i); I1 = AT2(S, 27, i) + contact; I2 = AT2(S, 28, i) + contact;
        I3 = AT2(S, 29, i) + contact;
        w1 = kernel_angular_velocity(AT2(E, 41, i), AT2(E, 42, i), AT2(E, 43, i), g1, g2, g3, J1, J2, J3, contact);
        m1 = I1 * w1.a0; m2 = I2 * w1.a1; m3 = I3 * w1.a2; s1 = w1.a1 * m3 - w1.a2 * m2; s2 = w1.a2 * m1 - w1.a0 * m3;
        s3 = w1.a0 * m2 - w1.a1 * m1; a1 = kernel_angular_velocity(-s1, -s2, -s3, g1, g2, g3, J1, J2, J3, contact);
        n1 = I1 * a1.a0; n2 = I2 * a1.a1; n3 = I3 * a1.a2; AT2(E, at + 13, i) = w1.a0; AT2(E, at + 13 + 1, i) = w1.a1;
        AT2(E, at + 13 + 2, i) = w1.a2;
        least = R(9.999999999999998e-15) * ((m1 * m1 + m2 * m2 + m3 * m3) * (w1.a0 * w1.a0 + w1.a1 * w1.a1 + w1.a2 *
            w1.a2));
        one = s1 * s1 + s2 * s2 + s3 * s3 > least ? R(1.0) : R(0.0); AT2(E, at + 16, i) = one * s1;
        AT2(E, at + 16 + 1, i) = one * s2; AT2(E, at + 16 + 2, i) = one * s3; v1 = w1.a1 * g3 - w1.a2 * g2;
        v2 = w1.a2 * g1 - w1.a0 * g3; v3 = w1.a0 * g2 - w1.a1 * g1;
        u1 = a1.a1 * g3 - a1.a2 * g2 - (w1.a1 * v3 - w1.a2 * v2);
        u2 = a1.a2 * g1 - a1.a0 * g3 - (w1.a2 * v1 - w1.a0 * v3);
        u3 = a1.a0 * g2 - a1.a1 * g1 - (w1.a0 * v2 - w1.a1 * v1); e1 = AT2(E, 38, i); e2 = AT2(E, 39, i);
        e3 = AT2(E, 40, i); v = contact * (v1 * e1 + v2 * e2 + v3 * e3); u = contact * (u1 * e1 + u2 * e2 + u3 * e3);
        t_r3 t_1 = kernel_angular_velocity(m2 * e3 - m3 * e2 + v * g1, m3 * e1 - m1 * e3 + v * g2, m1 * e2 - m2 * e1 +
            v * g3, g1, g2, g3, J1, J2, J3, contact);
        s1 = t_1.a0; s2 = t_1.a1; s3 = t_1.a2; f1 = s1 + (e2 * w1.a2 - e3 * w1.a1);
        f2 = s2 + (e3 * w1.a0 - e1 * w1.a2); f3 = s3 + (e1 * w1.a1 - e2 * w1.a0);
        up = u + contact * (v1 * f1 + v2 * f2 + v3 * f3 - (v1 * s1 + v2 * s2 + v3 * s3));
        over = v + contact * (g1 * s1 + g2 * s2 + g3 * s3);
        t1 = kernel_angular_velocity(n2 * e3 - n3 * e2 + (m2 * f3 - m3 * f2) + (up * g1 - over * v1), n3 * e1 - n1 *
            e3 + (m3 * f1 - m1 * f3) + (up * g2 - over * v2), n1 * e2 - n2 * e1 + (m1 * f2 - m2 * f1) + (up * g3 -
            over * v3), g1, g2, g3, J1, J2, J3, contact);
        p1 = t1.a0 + (f2 * w1.a2 - f3 * w1.a1) + (e2 * a1.a2 - e3 * a1.a1);
        p2 = t1.a1 + (f3 * w1.a0 - f1 * w1.a2) + (e3 * a1.a0 - e1 * a1.a2);
        p3 = t1.a2 + (f1 * w1.a1 - f2 * w1.a0) + (e1 * a1.a1 - e2 * a1.a0); AT2(E, at + 0, i) = s1;
        AT2(E, at + 0 + 1, i) = s2; AT2(E, at + 0 + 2, i) = s3; AT2(E, at + 3, i) = f1; AT2(E, at + 3 + 1, i) = f2;
        AT2(E, at + 3 + 2, i) = f3; AT2(E, at + 6, i) = p1; AT2(E, at + 6 + 1, i) = p2; AT2(E, at + 6 + 2, i) = p3;
        if (traced) {
            z1 = f2 * g3 - f3 * g2; z2 = f3 * g1 - f1 * g3; z3 = f1 * g2 - f2 * g1;
            b1 = w1.a1 * z3 - w1.a2 * z2 + (p2 * g3 - p3 * g2) - (f2 * v3 - f3 * v2);
            b2 = w1.a2 * z1 - w1.a0 * z3 + (p3 * g1 - p1 * g3) - (f3 * v1 - f1 * v3);
            b3 = w1.a0 * z2 - w1.a1 * z1 + (p1 * g2 - p2 * g1) - (f1 * v2 - f2 * v1); q0 = AT2(E, 47, i);
            q1 = AT2(E, 48, i); q2 = AT2(E, 49, i); q3 = AT2(E, 50, i);
            t_r3 t_2 = kernel_rotate(q0, q1, q2, q3, z1, z2, z3); AT2(E, at + 9, i) = t_2.a0;
            AT2(E, at + 9 + 1, i) = t_2.a1; t_r3 t_3 = kernel_rotate(q0, q1, q2, q3, b1, b2, b3);
            AT2(E, at + 11, i) = t_3.a0; AT2(E, at + 11 + 1, i) = t_3.a1;
        }
    }
}

INLINE void carried_changes(r2 S, r2 E, int64_t B) {
    real a0, a1, a2, a3, b0, b1, b2, b3, one, two, w, v; int64_t at, row;
    INDEPENDENT for (int64_t i = 0, end_i = 4 * B; i < end_i; i++) {
        a0 = AT2(S, 87, i); a1 = AT2(S, 88, i); a2 = AT2(S, 89, i); a3 = AT2(S, 90, i); b0 = AT2(S, 15, i);
        b1 = AT2(S, 16, i); b2 = AT2(S, 17, i); b3 = AT2(S, 18, i);
        one = R(1.0) / R(sqrt(a0 * a0 + a1 * a1 + (a2 * a2 + a3 * a3)));
        two = R(1.0) / R(sqrt(b0 * b0 + b1 * b1 + (b2 * b2 + b3 * b3)));
        for (int64_t c = 0; c < 3; c++) {
            w = AT2(S, 73 + 2 * c, i) * one; v = AT2(S, 73 + 2 * c + 1, i) * two;
            AT2(E, 100 + 4 * c, i) = w * a0 + v * b0; AT2(E, 100 + 4 * c + 1, i) = w * a1 + v * b1;
            AT2(E, 100 + 4 * c + 2, i) = w * a2 + v * b2; AT2(E, 100 + 4 * c + 3, i) = w * a3 + v * b3;
        }
        for (int64_t c = 0; c < 3; c++) {
            at = 112 + c; AT2(E, at, i) = AT2(S, 73, i) * AT2(S, 91 + c, i) + AT2(S, 74, i) * AT2(S, 19 + c, i);
        }
    }
    for (int64_t row = 100; row < 115; row++) {
        INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
            AT2(E, row, b) = AT2(E, row, b) + AT2(E, row, B + b) + (AT2(E, row, 2 * B + b) + AT2(E, row, 3 * B + b));
        }
    }
    for (int64_t c = 0; c < 3; c++) {
        INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
            at = 118 + 3 * c; row = 100 + 4 * c;
            t_r3 t_1 = long_step_twist(AT2(S, 94, b), AT2(S, 95, b), AT2(S, 96, b), AT2(S, 97, b), AT2(E, row, b),
                AT2(E, row + 1, b), AT2(E, row + 2, b), AT2(E, row + 3, b));
            AT2(S, at, b) = t_1.a0; AT2(S, at + 1, b) = t_1.a1; AT2(S, at + 2, b) = t_1.a2;
        }
    }
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        at = 47; row = 112;
        t_r3 t_2 = kernel_rotate(AT2(E, at, b), AT2(E, at + 1, b), AT2(E, at + 2, b), AT2(E, at + 3, b), AT2(E, row,
            b), AT2(E, row + 1, b), AT2(E, row + 2, b));
        AT2(S, 127, b) = t_2.a0; AT2(S, 128, b) = t_2.a1;
    }
}

INLINE t_r4 following_left(r2 S, int64_t b, real start) {
    int64_t at = 118;
    real x = R(sqrt(AT2(S, at, b) * AT2(S, at, b) + AT2(S, at + 1, b) * AT2(S, at + 1, b) + AT2(S, at + 2, b) * AT2(S,
        at + 2, b)));
    real y = R(sqrt(AT2(S, at + 3, b) * AT2(S, at + 3, b) + AT2(S, at + 4, b) * AT2(S, at + 4, b) + AT2(S, at + 5, b)
        * AT2(S, at + 5, b)));
    real z = R(sqrt(AT2(S, at + 6, b) * AT2(S, at + 6, b) + AT2(S, at + 7, b) * AT2(S, at + 7, b) + AT2(S, at + 8, b)
        * AT2(S, at + 8, b)));
    real rounded = R(2e-15) + R(10.0) * start, last = max_r(x - rounded, R(0.0));
    real middle = max_r(y - rounded, R(0.0));
    if (!(middle > R(0.0) && z > R(0.0))) { return (t_r4){R(0.0), x, y, z}; }
    last = max_r(last, middle * min_r(middle / z, R(1.0)));
    return (t_r4){R(2.0) * last * min_r(last / middle, R(1.0)), x, y, z};
}

INLINE real following_lengthened(real ratio) {
    real root = R(sqrt(R(sqrt(R(sqrt(R(sqrt(min_r(max_r(ratio, R(1e-12)), R(1000000000000.0))))))))));
    return R(1.0) / (root * R(sqrt(root)));
}

INLINE void following_judged(r2 S, r2 E, int64_t b, int lost, real start, r2 sums, r1 state, r1 lane) {
    int heavy; int64_t stopped; real reached; real step = lane.p[1], tries = lane.p[6];
    real size = lane.p[2] * R(sqrt(AT2(S, 37, b) * AT2(S, 37, b) + (AT2(S, 38, b) * AT2(S, 38, b) + AT2(S, 39, b) *
        AT2(S, 39, b))));
    lane.p[11] = size; lane.p[12] = R(3.0); lane.p[14] = R(0.0); lane.p[15] = R(0.0);
    if (lost && AT2(S, 58, b) != R(0.0)) {
        heavy = AT2(S, 62, b) < R(0.0); stopped = 0;
        if (heavy || tries >= 40) {
            t_ir t_1 = long_run_safely(S, b, sums, state); stopped = t_1.a0; reached = t_1.a1; lane.p[16] = stopped;
            lane.p[17] = reached; lane.p[12] = stopped == 0 ? R(3.0) : R(2.0);
        }
        if (tries < 40 && (stopped != 0 || !heavy)) { lane.p[12] = R(1.0); lane.p[10] = R(0.9) * step; }
    }
    t_r4 error = following_left(S, b, start); AT2(E, 79, b) = error.a1 > R(0.0) ? error.a0 / error.a1 : R(0.0);
    AT2(E, 80, b) = error.a2 > R(0.0) ? error.a0 / error.a2 : R(0.0);
    AT2(E, 81, b) = error.a3 > R(0.0) ? error.a0 / error.a3 : R(0.0); real bound = lane.p[18] * step;
    real wanted = bound > R(0.0) ? min_r(max_r(step * following_lengthened(error.a0 / (R(0.4) * bound)), R(0.3) *
        step), R(2.0) * step) : step;
    if (size > R(0.0)) { wanted = max_r(min_r(wanted, R(1.7) / size), min_r(R(0.02) / size, step)); }
    lane.p[13] = min_r(wanted, lane.p[10]); real most = lane.p[0] > R(0.0) ? R(15.0) : R(3.0);
    if (lane.p[12] == R(1.0)) { lane.p[13] = R(0.6) * step; }
    else {
        if (lane.p[12] == R(3.0) && error.a0 > most * bound && tries < 40) {
            real t_2 = R(1.0), t_3 = min_r(lane.p[13], R(0.6) * step); lane.p[12] = t_2; lane.p[13] = t_3;
        }
    }
}

INLINE real following_part_of(r1 lane, int64_t frame, real interval) {
    if (frame == lane.p[19] && lane.p[3] <= R(1.0)) { return R(1.0); }
    return (frame * interval - lane.p[0]) / lane.p[1];
}

INLINE void between_shortened(r2 end, real ratio) {
    real factor = R(1.0);
    for (int64_t n = 1; n < 6; n++) {
        factor = factor * ratio;
        for (int64_t i = 0; i < 6; i++) { AT2(end, n, i) = AT2(end, n, i) * factor; }
    }
}

INLINE real between_crossed(r2 V, int64_t at, int64_t n, int64_t i) {
    int64_t j = i < 2 ? i + 1 : 0, k = j < 2 ? j + 1 : 0; real found = R(0.0);
    for (int64_t m = 0, end_m = n + 1; m < end_m; m++) {
        found = found + (AT2(V, at + j, m) * AT2(V, 0 + k, n - m) - AT2(V, at + k, m) * AT2(V, 0 + j, n - m));
    }
    return found;
}

INLINE void between_series(r1 body, real J1, real J2, real J3, real contact, real radius, real whole, int traced, r2
    V, r2 end) {
    real x1, x2, x3, along, here, part, x, y, b0, b1, b2, b3, half; t_r3 w1; t_r4 c0;
    real g1 = body.p[3], g2 = body.p[4], g3 = body.p[5], a0 = body.p[6], a1 = body.p[7], a2 = body.p[8];
    real a3 = body.p[9];
    for (int64_t i = 0; i < 3; i++) { AT2(V, 3 + i, 0) = body.p[i]; AT2(V, 6 + i, 0) = body.p[3 + i]; }
    if (traced) {
        t_r3 t_1 = kernel_rotate(a0, -a1, -a2, -a3, R(1.0), R(0.0), R(0.0)); AT2(V, 9, 0) = t_1.a0;
        AT2(V, 10, 0) = t_1.a1; AT2(V, 11, 0) = t_1.a2;
        t_r3 t_2 = kernel_rotate(a0, -a1, -a2, -a3, R(0.0), R(1.0), R(0.0)); AT2(V, 12, 0) = t_2.a0;
        AT2(V, 13, 0) = t_2.a1; AT2(V, 14, 0) = t_2.a2;
    }
    AT2(end, 0, 0) = a0; AT2(end, 0, 1) = a1; AT2(end, 0, 2) = a2; AT2(end, 0, 3) = a3; AT2(end, 0, 4) = body.p[10];
    AT2(end, 0, 5) = body.p[11];
    for (int64_t n = 0; n < 5; n++) {
        x1 = whole * AT2(V, 3, n); x2 = whole * AT2(V, 4, n); x3 = whole * AT2(V, 5, n); along = R(0.0);
        for (int64_t m = 1, end_m = n + 1; m < end_m; m++) {
            here = contact * AT2(V, 15, n - m);
            along = along + (AT2(V, 6, m) * AT2(V, 0, n - m) + AT2(V, 7, m) * AT2(V, 1, n - m) + AT2(V, 8, m) * AT2(V,
                2, n - m));
            x1 = x1 + here * AT2(V, 6, m); x2 = x2 + here * AT2(V, 7, m); x3 = x3 + here * AT2(V, 8, m);
        }
        here = contact * along;
        w1 = kernel_angular_velocity(x1 + here * g1, x2 + here * g2, x3 + here * g3, g1, g2, g3, J1, J2, J3, contact);
        AT2(V, 0, n) = w1.a0; AT2(V, 1, n) = w1.a1; AT2(V, 2, n) = w1.a2;
        AT2(V, 15, n) = along + (g1 * w1.a0 + g2 * w1.a1 + g3 * w1.a2); part = R(1.0) / (n + 1);
        for (int64_t i = 0; i < 3; i++) {
            real t_3 = part * between_crossed(V, 3, n, i), t_4 = part * between_crossed(V, 6, n, i);
            AT2(V, 3 + i, n + 1) = t_3; AT2(V, 6 + i, n + 1) = t_4;
        }
        if (traced) {
            for (int64_t i = 0; i < 3; i++) {
                real t_5 = part * between_crossed(V, 9, n, i), t_6 = part * between_crossed(V, 12, n, i);
                AT2(V, 9 + i, n + 1) = t_5; AT2(V, 12 + i, n + 1) = t_6;
            }
            x = R(0.0); y = R(0.0);
            for (int64_t m = 0, end_m = n + 1; m < end_m; m++) {
                for (int64_t i = 0; i < 3; i++) {
                    x = x + AT2(V, 0 + i, m) * AT2(V, 12 + i, n - m); y = y - AT2(V, 0 + i, m) * AT2(V, 9 + i, n - m);
                }
            }
            AT2(end, n + 1, 4) = radius * part * x; AT2(end, n + 1, 5) = radius * part * y;
        }
        b0 = R(0.0); b1 = R(0.0); b2 = R(0.0); b3 = R(0.0);
        for (int64_t m = 0, end_m = n + 1; m < end_m; m++) {
            c0 = kernel_compose(AT2(end, m, 0), AT2(end, m, 1), AT2(end, m, 2), AT2(end, m, 3), R(0.0), AT2(V, 0, n -
                m), AT2(V, 1, n - m), AT2(V, 2, n - m));
            b0 = b0 + c0.a0; b1 = b1 + c0.a1; b2 = b2 + c0.a2; b3 = b3 + c0.a3;
        }
        half = R(0.5) * part; AT2(end, n + 1, 0) = half * b0; AT2(end, n + 1, 1) = half * b1;
        AT2(end, n + 1, 2) = half * b2; AT2(end, n + 1, 3) = half * b3;
    }
}

INLINE real between_followed(real last, real before) {
    return before > R(0.0) ? R(8.0) * R(sqrt(last)) * min_r(R(sqrt(last / before)), R(8.0)) : R(8.0) * R(sqrt(last));
}

INLINE t_r2 between_joined(r2 first, r2 end, real radius, int traced, r2 curve) {
    real a0, a1, a2, a3, a4, a5, d0, d1, d2, d3, d4, d5;
    for (int64_t i = 0, end_i = traced ? 6 : 4; i < end_i; i++) {
        for (int64_t n = 0; n < 6; n++) { AT2(curve, n, i) = AT2(first, n, i); }
        a0 = AT2(first, 0, i); a1 = AT2(first, 1, i); a2 = AT2(first, 2, i); a3 = AT2(first, 3, i);
        a4 = AT2(first, 4, i); a5 = AT2(first, 5, i); d0 = AT2(end, 0, i) - (a5 + a4 + a3 + (a2 + a1) + a0);
        d1 = AT2(end, 1, i) - (R(5.0) * a5 + R(4.0) * a4 + (R(3.0) * a3 + R(2.0) * a2) + a1);
        d2 = AT2(end, 2, i) - (R(10.0) * a5 + R(6.0) * a4 + (R(3.0) * a3 + a2));
        d3 = AT2(end, 3, i) - (R(10.0) * a5 + R(4.0) * a4 + a3); d4 = AT2(end, 4, i) - (R(5.0) * a5 + a4);
        d5 = AT2(end, 5, i) - a5; AT2(curve, 6, i) = d0; AT2(curve, 7, i) = d1 - R(6.0) * d0;
        AT2(curve, 8, i) = d2 - R(6.0) * d1 + R(21.0) * d0;
        AT2(curve, 9, i) = d3 - R(6.0) * d2 + (R(21.0) * d1 - R(56.0) * d0);
        AT2(curve, 10, i) = d4 - R(6.0) * d3 + (R(21.0) * d2 - R(56.0) * d1) + R(126.0) * d0;
        AT2(curve, 11, i) = d5 - R(6.0) * d4 + (R(21.0) * d3 - R(56.0) * d2) + (R(126.0) * d1 - R(252.0) * d0);
    }
    real last = R(0.0), turned = R(0.0), way = R(0.0);
    for (int64_t i = 0; i < 4; i++) {
        turned = turned + AT2(curve, 11, i) * AT2(curve, 11, i); last = last + AT2(curve, 10, i) * AT2(curve, 10, i);
    }
    turned = R(0.00048828125) * between_followed(turned, last);
    if (traced) {
        way = AT2(curve, 11, 4) * AT2(curve, 11, 4) + AT2(curve, 11, 5) * AT2(curve, 11, 5);
        way = R(0.000244140625) / radius * between_followed(way, AT2(curve, 10, 4) * AT2(curve, 10, 4) + AT2(curve,
            10, 5) * AT2(curve, 10, 5));
    }
    return (t_r2){turned, way};
}

INLINE t_r2 following_through(r2 S, int64_t b, r1 body, r1 now, int traced, r1 lane, r2 V, r2 first, r2 last, r2
    curve) {
    real whole = lane.p[1] * lane.p[2], J1 = AT2(S, 131, b), J2 = AT2(S, 132, b), J3 = AT2(S, 133, b);
    real contact = AT2(S, 134, b), radius = AT2(S, 130, b);
    if (lane.p[9] > R(0.0)) {
        for (int64_t n = 0; n < 6; n++) {
            for (int64_t c = 0; c < 6; c++) { AT2(first, n, c) = AT2(last, n, c); }
        }
        if (lane.p[9] != whole) { between_shortened(first, whole / lane.p[9]); }
    }
    else { between_series(body, J1, J2, J3, contact, radius, whole, traced, V, first); }
    between_series(now, J1, J2, J3, contact, radius, whole, traced, V, last);
    return between_joined(first, last, radius, traced, curve);
}

INLINE real following_spinning(r2 E, int64_t B, int64_t b) {
    real found = R(0.0);
    for (int64_t lane = 0; lane < 3; lane++) {
        for (int64_t c = 0; c < 3; c++) { found = found + AT2(E, 0 + c, lane * B + b) * AT2(E, 0 + c, lane * B + b); }
    }
    return R(sqrt(found));
}

INLINE void following_looked_at(r2 S, r2 E, int64_t B, int64_t b, int lost, real interval, real start, real bearable,
    int traced, r2 sums, r1 body, r1 state, r1 lane, r2 V, r2 first, r2 last, r2 curve, r1 now) {
    int inside; t_r2 off; real speed, worst, more, rounding; AT2(E, 78, b) = R(0.0); AT2(E, 82, b) = R(0.0);
    if (AT2(S, 135, b) != R(0.0)) { lane.p[12] = R(0.0); return; }
    following_judged(S, E, b, lost, start, sums, state, lane);
    if (lane.p[12] == R(3.0)) {
        inside = following_part_of(lane, (int64_t)lane.p[5], interval) < R(0.999999999);
        if (inside) {
            for (int64_t c = 0; c < 24; c++) { now.p[c] = AT2(S, 105 + c, b); }
            off = following_through(S, b, body, now, traced, lane, V, first, last, curve);
            speed = lane.p[11] / lane.p[2];
            worst = speed > R(0.0) ? max_r(off.a0 * max_r(following_spinning(E, B, b) / speed, R(1.0)), off.a1) :
                max_r(off.a0, off.a1);
            more = max_r(following_lengthened(worst / (R(0.4) * bearable)), R(0.3)) * lane.p[1]; lane.p[20] = more;
            lane.p[14] = off.a0; lane.p[15] = off.a1;
            if (worst > bearable && lane.p[6] < 40) {
                real t_1 = R(1.0), t_2 = min_r(more, R(0.6) * lane.p[1]); int t_3 = 0; lane.p[12] = t_1;
                lane.p[20] = t_2; inside = t_3;
            }
        }
        lane.p[9] = inside ? lane.p[1] * lane.p[2] : R(0.0);
    }
    if (lane.p[12] == R(3.0)) {
        real t_4 = min_r(R(1.05) * lane.p[20], R(1e+300)), t_5 = min_r(R(1.05) * lane.p[10], R(1e+300));
        lane.p[20] = t_4; lane.p[10] = t_5; rounding = R(27.1) * start; AT2(E, 78, b) = lane.p[1] * lane.p[2];
        AT2(E, 82, b) = rounding * rounding; AT2(S, 117, b) = R(0.0);
    }
    else { AT2(E, 79, b) = R(0.0); AT2(E, 80, b) = R(0.0); AT2(E, 81, b) = R(0.0); }
    if (lane.p[12] == R(1.0)) {
        for (int64_t c = 0; c < 24; c++) { AT2(S, 105 + c, b) = body.p[c]; }
    }
}

INLINE void carried_kept(r2 E, int64_t B) {
    int64_t i, j, k; real w1, w2, w3, square, part, x, y, z, a1, a2, a3, b1, b2, b3, c1, c2, c3, n1, n2, n3;
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        i = b; j = B + b; k = 2 * B + b; w1 = AT2(E, 13, b); w2 = AT2(E, 14, b); w3 = AT2(E, 15, b);
        square = w1 * w1 + w2 * w2 + w3 * w3; part = square > R(0.0) ? R(1.0) / square : R(0.0);
        x = part * (AT2(E, 32, b) - (AT2(E, 54, i) * w1 + AT2(E, 54, j) * w2 + AT2(E, 54, k) * w3));
        y = part * (AT2(E, 33, b) - (AT2(E, 55, i) * w1 + AT2(E, 55, j) * w2 + AT2(E, 55, k) * w3));
        z = part * (AT2(E, 34, b) - (AT2(E, 56, i) * w1 + AT2(E, 56, j) * w2 + AT2(E, 56, k) * w3));
        a1 = AT2(E, 54, i) + x * w1; a2 = AT2(E, 55, i) + y * w1; a3 = AT2(E, 56, i) + z * w1;
        b1 = AT2(E, 54, j) + x * w2; b2 = AT2(E, 55, j) + y * w2; b3 = AT2(E, 56, j) + z * w2;
        c1 = AT2(E, 54, k) + x * w3; c2 = AT2(E, 55, k) + y * w3; c3 = AT2(E, 56, k) + z * w3; n1 = AT2(E, 35, b);
        n2 = AT2(E, 36, b); n3 = AT2(E, 37, b); x = AT2(E, 16, b); y = AT2(E, 17, b); z = AT2(E, 18, b);
        square = n1 * n1 + n2 * n2 + n3 * n3;
        part = (square > R(0.0) && x * x + y * y + z * z > R(0.0)) ? R(1.0) / square : R(0.0);
        x = part * (x - (n1 * a1 + n2 * a2 + n3 * a3)); y = part * (y - (n1 * b1 + n2 * b2 + n3 * b3));
        z = part * (z - (n1 * c1 + n2 * c2 + n3 * c3)); AT2(E, 54, i) = a1 + x * n1; AT2(E, 55, i) = a2 + x * n2;
        AT2(E, 56, i) = a3 + x * n3; AT2(E, 54, j) = b1 + y * n1; AT2(E, 55, j) = b2 + y * n2;
        AT2(E, 56, j) = b3 + y * n3; AT2(E, 54, k) = c1 + z * n1; AT2(E, 55, k) = c2 + z * n2;
        AT2(E, 56, k) = c3 + z * n3;
    }
}

INLINE void carried_flown(r2 E, int64_t B, int traced) {
    real half, twelfth, a1, a2, a3, b1, b2, b3, c1, c2, c3, r1, r2, r3, over, x, y, z, off; int64_t i, j, k, lane;
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        half = R(0.5) * AT2(E, 78, b); twelfth = AT2(E, 78, b) * AT2(E, 78, b) * R(0.08333333333333333); i = b;
        j = B + b; k = 2 * B + b; a1 = R(1.0) - half * AT2(E, 22, i) + twelfth * AT2(E, 25, i);
        a2 = twelfth * AT2(E, 26, i) - half * AT2(E, 23, i); a3 = twelfth * AT2(E, 27, i) - half * AT2(E, 24, i);
        b1 = twelfth * AT2(E, 25, j) - half * AT2(E, 22, j);
        b2 = R(1.0) - half * AT2(E, 23, j) + twelfth * AT2(E, 26, j);
        b3 = twelfth * AT2(E, 27, j) - half * AT2(E, 24, j); c1 = twelfth * AT2(E, 25, k) - half * AT2(E, 22, k);
        c2 = twelfth * AT2(E, 26, k) - half * AT2(E, 23, k);
        c3 = R(1.0) - half * AT2(E, 24, k) + twelfth * AT2(E, 27, k); r1 = b2 * c3 - b3 * c2; r2 = b3 * c1 - b1 * c3;
        r3 = b1 * c2 - b2 * c1; over = R(1.0) / (a1 * r1 + a2 * r2 + a3 * r3); AT2(E, 89, b) = over * r1;
        AT2(E, 90, b) = over * r2; AT2(E, 91, b) = over * r3; AT2(E, 92, b) = over * (c2 * a3 - c3 * a2);
        AT2(E, 93, b) = over * (c3 * a1 - c1 * a3); AT2(E, 94, b) = over * (c1 * a2 - c2 * a1);
        AT2(E, 95, b) = over * (a2 * b3 - a3 * b2); AT2(E, 96, b) = over * (a3 * b1 - a1 * b3);
        AT2(E, 97, b) = over * (a1 * b2 - a2 * b1); AT2(E, 98, b) = half; AT2(E, 99, b) = twelfth;
    }
    for (int64_t column = 0; column < 3; column++) {
        INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
            i = column * B + b; half = AT2(E, 98, b); twelfth = AT2(E, 99, b);
            x = AT2(E, 38, i) + half * AT2(E, 3, i) + twelfth * AT2(E, 6, i);
            y = AT2(E, 39, i) + half * AT2(E, 4, i) + twelfth * AT2(E, 7, i);
            z = AT2(E, 40, i) + half * AT2(E, 5, i) + twelfth * AT2(E, 8, i);
            AT2(E, 54, i) = AT2(E, 89, b) * x + AT2(E, 90, b) * y + AT2(E, 91, b) * z;
            AT2(E, 55, i) = AT2(E, 92, b) * x + AT2(E, 93, b) * y + AT2(E, 94, b) * z;
            AT2(E, 56, i) = AT2(E, 95, b) * x + AT2(E, 96, b) * y + AT2(E, 97, b) * z;
        }
    }
    carried_kept(E, B);
    if (traced) {
        for (int64_t column = 0; column < 3; column++) {
            INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
                i = column * B + b; half = AT2(E, 98, b); twelfth = AT2(E, 99, b);
                x = half * AT2(E, 9, i) + twelfth * AT2(E, 11, i); y = half * AT2(E, 10, i) + twelfth * AT2(E, 12, i);
                for (int64_t c = 0; c < 3; c++) {
                    lane = c * B + b; off = AT2(E, 54 + c, i);
                    x = x + (half * AT2(E, 28, lane) - twelfth * AT2(E, 30, lane)) * off;
                    y = y + (half * AT2(E, 29, lane) - twelfth * AT2(E, 31, lane)) * off;
                }
                AT2(E, 57, i) = x; AT2(E, 58, i) = y;
            }
        }
    }
}

INLINE void carried_leave(r2 S, r2 E, int64_t B, int traced) {
    int64_t i, j, k, lane, at; real part, v1, v2, v3, l1, l2, l3, x, y, z;
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        AT2(E, 83, b) = R(0.0); AT2(E, 84, b) = R(0.0); AT2(E, 85, b) = R(0.0);
    }
    for (int64_t c = 0; c < 3; c++) {
        INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
            i = b; j = B + b; k = 2 * B + b; lane = c * B + b; part = AT2(E, 79 + c, b); v1 = AT2(E, 59, lane);
            v2 = AT2(E, 60, lane); v3 = AT2(E, 61, lane); at = 118 + 3 * c;
            l1 = AT2(E, 54, i) * v1 + AT2(E, 54, j) * v2 + AT2(E, 54, k) * v3 + part * AT2(S, at, b);
            l2 = AT2(E, 55, i) * v1 + AT2(E, 55, j) * v2 + AT2(E, 55, k) * v3 + part * AT2(S, at + 1, b);
            l3 = AT2(E, 56, i) * v1 + AT2(E, 56, j) * v2 + AT2(E, 56, k) * v3 + part * AT2(S, at + 2, b);
            AT2(E, 59, lane) = l1; AT2(E, 60, lane) = l2; AT2(E, 61, lane) = l3; at = 19;
            x = AT2(E, at, i) * l1 + AT2(E, at, j) * l2 + AT2(E, at, k) * l3;
            y = AT2(E, at + 1, i) * l1 + AT2(E, at + 1, j) * l2 + AT2(E, at + 1, k) * l3;
            z = AT2(E, at + 2, i) * l1 + AT2(E, at + 2, j) * l2 + AT2(E, at + 2, k) * l3;
            AT2(E, 83, b) = AT2(E, 83, b) + (l1 * l1 + l2 * l2 + l3 * l3);
            AT2(E, 84, b) = AT2(E, 84, b) + (x * x + y * y + z * z);
            if (traced) {
                at = 57; part = AT2(E, 79, b);
                x = AT2(E, at, i) * v1 + AT2(E, at, j) * v2 + AT2(E, at, k) * v3 + part * AT2(S, 127, b);
                y = AT2(E, at + 1, i) * v1 + AT2(E, at + 1, j) * v2 + AT2(E, at + 1, k) * v3 + part * AT2(S, 128, b);
                x = AT2(E, 62, lane) + x; y = AT2(E, 63, lane) + y; AT2(E, 62, lane) = x; AT2(E, 63, lane) = y;
                AT2(E, 85, b) = AT2(E, 85, b) + (x * x + y * y);
            }
        }
    }
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        real t_1 = R(sqrt(AT2(E, 83, b))), t_2 = R(sqrt(AT2(E, 84, b))), t_3 = R(sqrt(AT2(E, 85, b)));
        AT2(E, 83, b) = t_1; AT2(E, 84, b) = t_2; AT2(E, 85, b) = t_3;
    }
}

INLINE void carried_carry(r2 S, r2 E, int64_t B, int traced) {
    int64_t i, j, k;
    real a1, a2, a3, b1, b2, b3, c1, c2, c3, error, s11, s12, s13, s22, s23, s33, p11, p12, p13, p21, p22, p23, p31,
        p32, p33, e11, e12, e13, e22, e23, e33, rounded, x, y, z, x1, x2, x3, y1, y2, y3, m1, m2, m3, n1, n2, n3, u1,
        u2, u3, v1, v2, v3, one;
    carried_flown(E, B, traced); carried_leave(S, E, B, traced);
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        i = b; j = B + b; k = 2 * B + b; a1 = AT2(E, 54, i); a2 = AT2(E, 55, i); a3 = AT2(E, 56, i);
        b1 = AT2(E, 54, j); b2 = AT2(E, 55, j); b3 = AT2(E, 56, j); c1 = AT2(E, 54, k); c2 = AT2(E, 55, k);
        c3 = AT2(E, 56, k); error = AT2(E, 82, b); s11 = AT2(E, 64, b); s12 = AT2(E, 65, b); s13 = AT2(E, 66, b);
        s22 = AT2(E, 67, b); s23 = AT2(E, 68, b); s33 = AT2(E, 69, b); p11 = a1 * s11 + b1 * s12 + c1 * s13;
        p12 = a1 * s12 + b1 * s22 + c1 * s23; p13 = a1 * s13 + b1 * s23 + c1 * s33;
        p21 = a2 * s11 + b2 * s12 + c2 * s13; p22 = a2 * s12 + b2 * s22 + c2 * s23;
        p23 = a2 * s13 + b2 * s23 + c2 * s33; p31 = a3 * s11 + b3 * s12 + c3 * s13;
        p32 = a3 * s12 + b3 * s22 + c3 * s23; p33 = a3 * s13 + b3 * s23 + c3 * s33;
        e11 = p11 * a1 + p12 * b1 + p13 * c1; e12 = p11 * a2 + p12 * b2 + p13 * c2;
        e13 = p11 * a3 + p12 * b3 + p13 * c3; e22 = p21 * a2 + p22 * b2 + p23 * c2;
        e23 = p21 * a3 + p22 * b3 + p23 * c3; e33 = p31 * a3 + p32 * b3 + p33 * c3; e11 = e11 + error;
        e22 = e22 + error; e33 = e33 + error; AT2(E, 64, b) = e11; AT2(E, 65, b) = e12; AT2(E, 66, b) = e13;
        AT2(E, 67, b) = e22; AT2(E, 68, b) = e23; AT2(E, 69, b) = e33; rounded = R(0.0);
        for (int64_t c = 0; c < 3; c++) {
            x = AT2(E, 19 + c, i); y = AT2(E, 19 + c, j); z = AT2(E, 19 + c, k);
            rounded = rounded + (x * (x * e11 + R(2.0) * (y * e12 + z * e13)) + y * (y * e22 + R(2.0) * z * e23) + z *
                z * e33);
        }
        AT2(E, 86, b) = R(sqrt(e11 + e22 + e33)); AT2(E, 87, b) = R(sqrt(max_r(rounded, R(0.0))));
        if (traced) {
            x1 = AT2(E, 57, i); x2 = AT2(E, 57, j); x3 = AT2(E, 57, k); y1 = AT2(E, 58, i); y2 = AT2(E, 58, j);
            y3 = AT2(E, 58, k); m1 = AT2(E, 70, b); m2 = AT2(E, 71, b); m3 = AT2(E, 72, b); n1 = AT2(E, 73, b);
            n2 = AT2(E, 74, b); n3 = AT2(E, 75, b); u1 = x1 * s11 + x2 * s12 + x3 * s13 + m1;
            u2 = x1 * s12 + x2 * s22 + x3 * s23 + m2; u3 = x1 * s13 + x2 * s23 + x3 * s33 + m3;
            v1 = y1 * s11 + y2 * s12 + y3 * s13 + n1; v2 = y1 * s12 + y2 * s22 + y3 * s23 + n2;
            v3 = y1 * s13 + y2 * s23 + y3 * s33 + n3; x = AT2(S, 115, b); y = AT2(S, 116, b);
            one = R(1.1102230246251565e-16) / AT2(S, 130, b);
            error = error + (error > R(0.0) ? one * one * (x * x + y * y) : R(0.0));
            x = AT2(E, 76, b) + (u1 * x1 + u2 * x2 + u3 * x3 + (m1 * x1 + m2 * x2 + m3 * x3) + error);
            y = AT2(E, 77, b) + (v1 * y1 + v2 * y2 + v3 * y3 + (n1 * y1 + n2 * y2 + n3 * y3) + error);
            AT2(E, 76, b) = x; AT2(E, 77, b) = y; AT2(E, 88, b) = R(sqrt(max_r(x + y, R(0.0))));
            AT2(E, 70, b) = u1 * a1 + u2 * b1 + u3 * c1; AT2(E, 71, b) = u1 * a2 + u2 * b2 + u3 * c2;
            AT2(E, 72, b) = u1 * a3 + u2 * b3 + u3 * c3; AT2(E, 73, b) = v1 * a1 + v2 * b1 + v3 * c1;
            AT2(E, 74, b) = v1 * a2 + v2 * b2 + v3 * c2; AT2(E, 75, b) = v1 * a3 + v2 * b3 + v3 * c3;
        }
    }
    for (int64_t row = 0; row < 19; row++) {
        INDEPENDENT for (int64_t i = 0, end_i = 4 * B; i < end_i; i++) { AT2(E, row, i) = AT2(E, 19 + row, i); }
    }
}

INLINE void following_stopped_at(int64_t i, int64_t frame, r3 momenta, r3 verticals, r3 attitudes, r3 traces, int
    follows, int traced) {
    r2_fill(r2_part(r3_row(momenta, i), frame, r3_row(momenta, i).n0), R(NAN));
    r2_fill(r2_part(r3_row(verticals, i), frame, r3_row(verticals, i).n0), R(NAN));
    if (follows) { r2_fill(r2_part(r3_row(attitudes, i), frame, r3_row(attitudes, i).n0), R(NAN)); }
    if (traced) { r2_fill(r2_part(r3_row(traces, i), frame, r3_row(traces, i).n0), R(NAN)); }
}

INLINE void following_shown(r1 body, int64_t exponent, int64_t i, int64_t frame, r3 momenta, r3 verticals, r3
    attitudes, r3 traces, int follows, int traced) {
    for (int64_t c = 0; c < 3; c++) {
        AT3(momenta, i, frame, c) = R(ldexp(body.p[c], (int)(int64_t)exponent));
        AT3(verticals, i, frame, c) = body.p[3 + c];
    }
    if (follows) {
        for (int64_t c = 0; c < 4; c++) { AT3(attitudes, i, frame, c) = body.p[6 + c]; }
    }
    if (traced) { AT3(traces, i, frame, 0) = body.p[10]; AT3(traces, i, frame, 1) = body.p[11]; }
}

INLINE real between_at_part(r2 curve, int64_t i, real s) {
    real r = s - R(1.0), square = s * s;
    real low = ((AT2(curve, 5, i) * s + AT2(curve, 4, i)) * s + AT2(curve, 3, i)) * s + AT2(curve, 2, i);
    real high = ((AT2(curve, 11, i) * r + AT2(curve, 10, i)) * r + AT2(curve, 9, i)) * r + AT2(curve, 8, i);
    low = (low * s + AT2(curve, 1, i)) * s + AT2(curve, 0, i);
    high = (high * r + AT2(curve, 7, i)) * r + AT2(curve, 6, i); return low + square * square * square * high;
}

INLINE void between_ball_at(r2 curve, real s, r1 body, int traced, r1 found) {
    real q0 = between_at_part(curve, 0, s), q1 = between_at_part(curve, 1, s), q2 = between_at_part(curve, 2, s);
    real q3 = between_at_part(curve, 3, s), scale = R(1.0) / R(sqrt(q0 * q0 + q1 * q1 + (q2 * q2 + q3 * q3)));
    q0 = scale * q0; q1 = scale * q1; q2 = scale * q2; q3 = scale * q3;
    real a0 = body.p[6], a1 = body.p[7], a2 = body.p[8], a3 = body.p[9];
    t_r4 p0 = kernel_compose(q0, -q1, -q2, -q3, a0, a1, a2, a3);
    t_r3 t_1 = kernel_rotate(p0.a0, p0.a1, p0.a2, p0.a3, body.p[0], body.p[1], body.p[2]); found.p[0] = t_1.a0;
    found.p[1] = t_1.a1; found.p[2] = t_1.a2;
    t_r3 t_2 = kernel_rotate(p0.a0, p0.a1, p0.a2, p0.a3, body.p[3], body.p[4], body.p[5]); found.p[3] = t_2.a0;
    found.p[4] = t_2.a1; found.p[5] = t_2.a2; found.p[6] = q0; found.p[7] = q1; found.p[8] = q2; found.p[9] = q3;
    if (traced) { found.p[10] = between_at_part(curve, 4, s); found.p[11] = between_at_part(curve, 5, s); }
}

INLINE void following_recorded(r2 E, int64_t B, int64_t b, int64_t i, real end, real allowed, real most, int patient,
    r1 lane, r2 reported) {
    AT2(reported, i, 4) = AT2(reported, i, 4) + R(1.0);
    real cautious = R(20.0) + R(32.0) / AT2(reported, i, 4), off = lane.p[14], out = lane.p[15];
    real speed = lane.p[11] / lane.p[2], turned = R(2.0) * AT2(E, 86, b), spun = R(2.0) * AT2(E, 87, b);
    real rolled = R(2.0) * AT2(E, 88, b); AT2(reported, i, 3) = max_r(max_r(AT2(reported, i, 3), turned), rolled);
    turned = cautious * AT2(E, 83, b) + turned; rolled = cautious * AT2(E, 85, b) + rolled;
    AT2(reported, i, 0) = max_r(AT2(reported, i, 0), turned + off);
    AT2(reported, i, 2) = max_r(AT2(reported, i, 2), rolled + out); lane.p[7] = max_r(lane.p[7], speed);
    real left = max_r(turned, rolled), until = min_r((lane.p[0] + lane.p[1]) / end, R(1.0));
    real share = R(0.1) + R(0.9) * until;
    if (left > share * most && AT2(reported, i, 3) < R(0.25) * left && !patient) {
        AT2(reported, i, 5) = min_r(until, R(0.999999999));
    }
    lane.p[18] = left > R(0.0) ? allowed * min_r(max_r(R(0.4) * most * share / left, R(0.02)), R(2.0)) : allowed;
    lane.p[8] = max_r(lane.p[8], cautious * AT2(E, 84, b) + spun + off * max_r(speed, following_spinning(E, B, b)));
}

INLINE void following_follow_lanes(int64_t B, r3 momenta, r3 verticals, r3 attitudes, r3 traces, r2 J0, r1 D0, r1
    radius, real interval, r1 first, r1 allowed, r1 most, r1 start, int patient, int follows, int traced, r2 sums, r3
    following, r2 beginning, r2 reported, i1 reached, i1 status, d1 reach) {
    int64_t i, frame; int lost, done, there, alike; real fate, part, wish; ALIGNED real S_[139 * (4 * B)];
    memset(S_, 0, sizeof S_); r2 S = {S_, 139, (4 * B), (4 * B)}; ALIGNED real E_[115 * (4 * B)];
    memset(E_, 0, sizeof E_); r2 E = {E_, 115, (4 * B), (4 * B)}; int64_t columns = sums.n1;
    ALIGNED real states_[B * 27]; memset(states_, 0, sizeof states_); r2 states = {states_, B, 27, 27};
    ALIGNED int64_t exponents_[B]; memset(exponents_, 0, sizeof exponents_); i1 exponents = {exponents_, B};
    ALIGNED real bodies_[B * 24]; memset(bodies_, 0, sizeof bodies_); r2 bodies = {bodies_, B, 24, 24};
    ALIGNED real now_[24]; memset(now_, 0, sizeof now_); r1 now = {now_, 24}; ALIGNED real found_[24];
    memset(found_, 0, sizeof found_); r1 found = {found_, 24}; ALIGNED real lanes_[B * 21];
    memset(lanes_, 0, sizeof lanes_); r2 lanes = {lanes_, B, 21, 21}; ALIGNED real ends_[(2 * B) * 6 * 6];
    memset(ends_, 0, sizeof ends_); r3 ends = {ends_, (2 * B), 6, 6, 6 * 6, 6}; ALIGNED real V_[16 * 6];
    memset(V_, 0, sizeof V_); r2 V = {V_, 16, 6, 6}; ALIGNED real curves_[B * 12 * 6];
    memset(curves_, 0, sizeof curves_); r3 curves = {curves_, B, 12, 6, 12 * 6, 6};
    int64_t balls = momenta.n0, frames = momenta.n1; real end = (frames - 1) * interval;
    int64_t coming = min_i(B, balls), busy = min_i(B, balls); int fresh = 1;
    for (int64_t b = 0, end_b = B; b < end_b; b++) {
        i = min_i(b, balls - 1);
        exponents.p[b] = following_taken_in(S, E, B, b, columns, i, first.p[i], allowed.p[i], start.p[i], momenta,
            verticals, attitudes, traces, J0, D0, radius, frames, interval, follows, sums, beginning, r2_row(bodies,
            b), r2_row(states, b), r2_row(lanes, b), reported, traced);
        AT2(S, 135, b) = b < balls ? R(0.0) : R(1.0);
    }
    while (busy > 0) {
        if (fresh) { carried_tangent(S, E, B, 0, traced); fresh = 0; }
        lost = lanes_side_by_side(S, B, columns, traced, following, beginning); carried_changes(S, E, B);
        for (int64_t b = 0, end_b = B; b < end_b; b++) {
            i = (int64_t)AT2(lanes, b, 4);
            following_looked_at(S, E, B, b, lost, interval, start.p[i], R(0.4) * most.p[i], traced, sums,
                r2_row(bodies, b), r2_row(states, b), r2_row(lanes, b), V, r3_row(ends, 2 * b), r3_row(ends, 2 * b +
                1), r3_row(curves, b), now);
        }
        carried_tangent(S, E, B, 19, traced); carried_carry(S, E, B, traced);
        for (int64_t b = 0, end_b = B; b < end_b; b++) {
            i = (int64_t)AT2(lanes, b, 4); frame = (int64_t)AT2(lanes, b, 5); fate = AT2(lanes, b, 12); done = 0;
            if (fate == R(1.0)) {
                AT2(lanes, b, 6) = AT2(lanes, b, 6) + R(1.0); following_aimed(r2_row(lanes, b), frames, interval);
                long_run_resized(S, B, b, columns, R(0.5) * AT2(lanes, b, 1) * AT2(lanes, b, 2), r2_row(bodies, b),
                    r2_row(states, b));
            }
            else {
                if (fate == R(2.0)) {
                    status.p[i] = (int64_t)AT2(lanes, b, 16); reach.p[i] = AT2(lanes, b, 17);
                    reached.p[i] = frame - 1; done = 1;
                    following_stopped_at(i, frame, momenta, verticals, attitudes, traces, follows, traced);
                }
                else {
                    if (fate == R(3.0)) {
                        for (int64_t c = 0; c < 24; c++) { now.p[c] = AT2(S, 105 + c, b); }
                        part = following_part_of(r2_row(lanes, b), frame, interval);
                        while (frame < frames && part <= R(1.000000001)) {
                            if (R(fabs(part - R(1.0))) <= R(1e-09)) {
                                following_shown(now, exponents.p[b], i, frame, momenta, verticals, attitudes, traces,
                                    follows, traced);
                            }
                            else {
                                between_ball_at(r3_row(curves, b), part, r2_row(bodies, b), traced, found);
                                following_shown(found, exponents.p[b], i, frame, momenta, verticals, attitudes,
                                    traces, follows, traced);
                            }
                            frame = frame + 1; part = following_part_of(r2_row(lanes, b), frame, interval);
                        }
                        following_recorded(E, B, b, i, end, allowed.p[i], most.p[i], patient, r2_row(lanes, b),
                            reported);
                        int64_t t_1 = frame; real t_2 = R(0.0), t_3 = AT2(lanes, b, 0) + AT2(lanes, b, 1);
                        AT2(lanes, b, 5) = t_1; AT2(lanes, b, 6) = t_2; AT2(lanes, b, 0) = t_3;
                        AT2(lanes, b, 3) = AT2(lanes, b, 3) - R(1.0);
                        for (int64_t c = 0; c < 24; c++) { AT2(bodies, b, c) = now.p[c]; }
                        there = AT2(lanes, b, 3) < R(0.5); wish = min_r(AT2(lanes, b, 13), AT2(lanes, b, 20));
                        alike = wish * R(1.15) >= AT2(lanes, b, 1) && wish <= R(1.15) * AT2(lanes, b, 1);
                        if (there) { AT2(lanes, b, 0) = AT2(lanes, b, 19) * interval; }
                        done = there && AT2(lanes, b, 19) == frames - 1;
                        if (AT2(reported, i, 5) < R(1.0)) {
                            reached.p[i] = frame - 1; status.p[i] = 0; reach.p[i] = R(1.0); done = 1;
                        }
                        else {
                            if (done) { reached.p[i] = frames - 1; status.p[i] = 0; reach.p[i] = R(1.0); }
                            else {
                                if ((there || !alike) && following_aimed(r2_row(lanes, b), frames, interval)) {
                                    long_run_resized(S, B, b, columns, R(0.5) * AT2(lanes, b, 1) * AT2(lanes, b, 2),
                                        now, r2_row(states, b));
                                }
                            }
                        }
                    }
                }
            }
            if (done) {
                AT2(reported, i, 1) = AT2(lanes, b, 7) > R(0.0) ? AT2(lanes, b, 8) / AT2(lanes, b, 7) : R(0.0);
                if (coming < balls) {
                    exponents.p[b] = following_taken_in(S, E, B, b, columns, coming, first.p[coming],
                        allowed.p[coming], start.p[coming], momenta, verticals, attitudes, traces, J0, D0, radius,
                        frames, interval, follows, sums, beginning, r2_row(bodies, b), r2_row(states, b),
                        r2_row(lanes, b), reported, traced);
                    coming = coming + 1; fresh = 1;
                }
                else { AT2(S, 135, b) = R(1.0); busy = busy - 1; }
            }
        }
    }
}

INLINE void following_follow_one(r3 momenta, r3 verticals, r3 attitudes, r3 traces, r2 J0, r1 D0, r1 radius, real
    interval, r1 first, r1 allowed, r1 most, r1 start, int patient, int follows, int traced, r2 sums, r3 following, r2
    beginning, r2 reported, i1 reached, i1 status, d1 reach) {
    following_follow_lanes(1, momenta, verticals, attitudes, traces, J0, D0, radius, interval, first, allowed, most,
        start, patient, follows, traced, sums, following, beginning, reported, reached, status, reach);
}

INLINE void following_follow_eight(r3 momenta, r3 verticals, r3 attitudes, r3 traces, r2 J0, r1 D0, r1 radius, real
    interval, r1 first, r1 allowed, r1 most, r1 start, int patient, int follows, int traced, r2 sums, r3 following, r2
    beginning, r2 reported, i1 reached, i1 status, d1 reach) {
    following_follow_lanes(8, momenta, verticals, attitudes, traces, J0, D0, radius, interval, first, allowed, most,
        start, patient, follows, traced, sums, following, beginning, reported, reached, status, reach);
}

INLINE t_r2 expected_surveyed(r2 momenta, r2 verticals, r2 J0, r1 D0, r1 unit, real end, real accuracy, r2 found) {
    t_ri size, weight; real k1, k2, k3, j1, j2, j3, D, rate, least, condition, turned, root, walked, allowed, part;
    t_r3 w1; int64_t zeros; int known; real floor = R(0.0), single = R(0.0);
    for (int64_t i = 0, end_i = momenta.n0; i < end_i; i++) {
        size = real_frexp(max_r(max_r(R(fabs(AT2(momenta, i, 0))), R(fabs(AT2(momenta, i, 1)))), R(fabs(AT2(momenta,
            i, 2)))));
        weight = real_frexp(max_r(max_r(max_r(AT2(J0, i, 0), AT2(J0, i, 1)), AT2(J0, i, 2)), D0.p[i]));
        k1 = R(ldexp(AT2(momenta, i, 0), (int)-size.a1)); k2 = R(ldexp(AT2(momenta, i, 1), (int)-size.a1));
        k3 = R(ldexp(AT2(momenta, i, 2), (int)-size.a1)); j1 = R(ldexp(AT2(J0, i, 0), (int)-weight.a1));
        j2 = R(ldexp(AT2(J0, i, 1), (int)-weight.a1)); j3 = R(ldexp(AT2(J0, i, 2), (int)-weight.a1));
        D = R(ldexp(D0.p[i], (int)-weight.a1));
        w1 = kernel_angular_velocity(k1, k2, k3, AT2(verticals, i, 0), AT2(verticals, i, 1), AT2(verticals, i, 2), j1,
            j2, j3, D);
        rate = R(ldexp(R(sqrt(w1.a0 * w1.a0 + w1.a1 * w1.a1 + w1.a2 * w1.a2)), (int)(size.a1 - weight.a1)));
        least = min_r(min_r(j2 + j3, j1 + j3), j1 + j2);
        condition = least > R(0.0) ? (max_r(max_r(j2 + j3, j1 + j3), j1 + j2) + D) / least :
            R(1.0715086071862673e+301);
        zeros = (k1 == R(0.0) ? 1 : 0) + (k2 == R(0.0) ? 1 : 0) + (k3 == R(0.0) ? 1 : 0); turned = rate * end;
        root = R(sqrt(condition)); walked = R(sqrt(R(1.0) + R(40.0) * turned)); AT2(found, 0, i) = rate;
        AT2(found, 1, i) = condition; AT2(found, 2, i) = (zeros > 1 || (j1 == j2 && j2 == j3)) ? R(1.0) : R(0.0);
        AT2(found, 3, i) = R(1.1102230246251565e-16) * ((R(1.0) + turned) * (R(2.0) * root + walked) + R(8.0) *
            condition) * unit.p[i];
        AT2(found, 4, i) = R(1.1102230246251565e-16) * ((R(1.0) + turned) * (R(2.0) * root + R(1.0)) + R(8.0) *
            condition) * unit.p[i];
        allowed = end > R(0.0) ? R(1.0) * accuracy / unit.p[i] / R(600.0) / end : R(1.0);
        part = rate > R(0.0) ? R(sqrt(R(sqrt(R(sqrt(R(sqrt(min_r(allowed / (R(3e-09) * rate), R(1.0)))))))))) :
            R(1.0);
        part = R(1.7) * part * R(sqrt(part)); AT2(found, 5, i) = rate * end > part ? min_r(part / rate, end) : end;
        AT2(found, 6, i) = allowed; AT2(found, 7, i) = accuracy / unit.p[i];
        AT2(found, 8, i) = R(2.220446049250313e-16) * root; known = AT2(found, 3, i) <= R(1.0715086071862673e+301);
        floor = max_r(floor, known ? AT2(found, 3, i) : R(INFINITY)); single = max_r(single, AT2(found, 2, i));
    }
    return (t_r2){floor, single};
}

INLINE real expected_estimated(r2 found, r2 reported, r1 unit, int turned, int spun, int rolled, r1 error, r1 noise,
    r1 started) {
    real most, walked; real worst = R(0.0);
    for (int64_t i = 0, end_i = error.n0; i < end_i; i++) {
        most = turned ? AT2(reported, i, 0) : R(0.0); most = spun ? max_r(most, AT2(reported, i, 1)) : most;
        most = unit.p[i] * (rolled ? max_r(most, AT2(reported, i, 2)) : most);
        walked = unit.p[i] * AT2(reported, i, 3);
        started.p[i] = walked / R(sqrt(R(1.0) + R(734.4100000000001) * AT2(reported, i, 4)));
        noise.p[i] = walked + R(3.0) * AT2(found, 4, i); error.p[i] = most + R(3.0) * AT2(found, 4, i);
        if (AT2(reported, i, 5) < R(1.0)) {
            error.p[i] = max_r(error.p[i] / AT2(reported, i, 5), R(2.0) * unit.p[i] * AT2(found, 7, i));
        }
        if (AT2(found, 1, i) > R(10000.0)) { noise.p[i] = R(1.0715086071862673e+301); }
        worst = !(error.p[i] <= worst) ? error.p[i] : worst;
    }
    return worst;
}

#endif
static void in_loop_prepare(const argument *a, argument *got) {
    real out = loop_prepare(r1_(0), r1_(1), r1_(2), r_(3), r1_(4), r1_(5), r1_(6), r1_(7)); got[0].number = out;
}

WIDEST static void in_loop_march(const argument *a, argument *got) {
    t_i2r out = loop_march(r1_(0), r1_(1), r3_(2), r1_(3), r1_(4), r2_(5), i_(6), i_(7), i_(8), i_(9), r_(10),
        r2_(11), r2_(12), b_(13), r1_(14), r1_(15), r_(16), r2_(17), r2_(18));
    got[0].integer = out.a0; got[1].integer = out.a1; got[2].number = out.a2;
}

WIDEST static void in_block_march_blocks(const argument *a, argument *got) {
    block_march_blocks(r2_(0), r1_(1), r3_(2), r2_(3), r2_(4), r2_(5), i_(6), i_(7), i_(8), r2_(9), r2_(10), r2_(11),
        r1_(12), r1_(13), r1_(14), r2_(15), r3_(16), r3_(17), i1_(18), i1_(19), d1_(20), b_(21), r2_(22), r3_(23),
        r3_(24));
    (void)got;
}

static void in_single_step_advance_all(const argument *a, argument *got) {
    single_step_advance_all(r2_(0), r2_(1), r2_(2), r1_(3), r2_(4), i1_(5), d1_(6)); (void)got;
}

#ifndef SINGLE
WIDEST static void in_long_run_march_one(const argument *a, argument *got) {
    long_run_march_one(r3_(0), r3_(1), r3_(2), r3_(3), r2_(4), r1_(5), r1_(6), r_(7), i_(8), i_(9), b_(10), b_(11),
        r2_(12), r3_(13), r2_(14), r1_(15), i1_(16), i1_(17), d1_(18));
    (void)got;
}

WIDEST static void in_long_run_march_eight(const argument *a, argument *got) {
    long_run_march_eight(r3_(0), r3_(1), r3_(2), r3_(3), r2_(4), r1_(5), r1_(6), r_(7), i_(8), i_(9), b_(10), b_(11),
        r2_(12), r3_(13), r2_(14), r1_(15), i1_(16), i1_(17), d1_(18));
    (void)got;
}

WIDEST static void in_loop_n_march(const argument *a, argument *got) {
    int64_t out = loop_n_march(r2_(0), r1_(1), r1_(2), r_(3), r1_(4), r1_(5), r1_(6), r4_(7), r2_(8), i_(9), i_(10),
        i_(11), r_(12), r3_(13), r2_(14), b_(15), r2_(16), r1_(17), r_(18), r3_(19), r2_(20), r2_(21));
    got[0].integer = out;
}

WIDEST static void in_vertical_loop_march(const argument *a, argument *got) {
    int out = vertical_loop_march(r1_(0), r1_(1), r_(2), i_(3), i_(4), r2_(5), r1_(6)); got[0].integer = out;
}

static void in_double_double_loop_prepare_pairs(const argument *a, argument *got) {
    t_i2 out = double_double_loop_prepare_pairs(r1_(0), r1_(1), r1_(2), r_(3), r2_(4), r1_(5), r1_(6), r1_(7));
    got[0].integer = out.a0; got[1].integer = out.a1;
}

WIDEST static void in_double_double_loop_march_pairs(const argument *a, argument *got) {
    t_i2r out = double_double_loop_march_pairs(r1_(0), r2_(1), r1_(2), r1_(3), r3_(4), i_(5), i_(6), i_(7), i_(8),
        i_(9), r2_(10), r2_(11), r2_(12), r2_(13), b_(14), r1_(15), r1_(16), r_(17), r2_(18), r2_(19), r2_(20),
        r2_(21));
    got[0].integer = out.a0; got[1].integer = out.a1; got[2].number = out.a2;
}

static void in_double_double_block_prepare_pairs_block(const argument *a, argument *got) {
    double_double_block_prepare_pairs_block(r2_(0), r2_(1), r2_(2), r1_(3), r2_(4), r2_(5), i1_(6), i1_(7));
    (void)got;
}

WIDEST static void in_double_double_block_march_pairs_block(const argument *a, argument *got) {
    double_double_block_march_pairs_block(r2_(0), i_(1), i_(2), i_(3), i1_(4), r3_(5), r3_(6), r3_(7), r3_(8), i1_(9),
        i1_(10), d1_(11));
    (void)got;
}

WIDEST static void in_double_double_long_march_long_pairs(const argument *a, argument *got) {
    t_i2r2 out = double_double_long_march_long_pairs(r1_(0), r1_(1), r1_(2), r_(3), r_(4), r_(5), i_(6), i_(7), i_(8),
        r2_(9), r_(10), b_(11), r1_(12), r1_(13), r2_(14), r2_(15), r2_(16), r2_(17), r2_(18), r2_(19), r2_(20),
        r2_(21));
    got[0].integer = out.a0; got[1].integer = out.a1; got[2].number = out.a2; got[3].number = out.a3;
}

WIDEST static void in_tangent_follow_all(const argument *a, argument *got) {
    tangent_follow_all(r2_(0), r2_(1), r1_(2), r_(3), i_(4), r2_(5)); (void)got;
}

WIDEST static void in_following_follow_one(const argument *a, argument *got) {
    following_follow_one(r3_(0), r3_(1), r3_(2), r3_(3), r2_(4), r1_(5), r1_(6), r_(7), r1_(8), r1_(9), r1_(10),
        r1_(11), b_(12), b_(13), b_(14), r2_(15), r3_(16), r2_(17), r2_(18), i1_(19), i1_(20), d1_(21));
    (void)got;
}

WIDEST static void in_following_follow_eight(const argument *a, argument *got) {
    following_follow_eight(r3_(0), r3_(1), r3_(2), r3_(3), r2_(4), r1_(5), r1_(6), r_(7), r1_(8), r1_(9), r1_(10),
        r1_(11), b_(12), b_(13), b_(14), r2_(15), r3_(16), r2_(17), r2_(18), i1_(19), i1_(20), d1_(21));
    (void)got;
}

static void in_expected_surveyed(const argument *a, argument *got) {
    t_r2 out = expected_surveyed(r2_(0), r2_(1), r2_(2), r1_(3), r1_(4), r_(5), r_(6), r2_(7));
    got[0].number = out.a0; got[1].number = out.a1;
}

static void in_expected_estimated(const argument *a, argument *got) {
    real out = expected_estimated(r2_(0), r2_(1), r1_(2), b_(3), b_(4), b_(5), r1_(6), r1_(7), r1_(8));
    got[0].number = out;
}

#endif

const loop_export LOOPS()[] = {
    {"loop_prepare", "r1 r1 r1 r r1 r1* r1* r1*", "r", in_loop_prepare},
    {"loop_march", "r1* r1 r3 r1 r1 r2* i i i i r r2* r2* b r1* r1* r r2* r2*", "iir", in_loop_march},
    {"block_march_blocks", "r2* r1 r3 r2* r2* r2* i i i r2 r2 r2 r1 r1 r1* r2* r3* r3* i1* i1* d1* b r2* r3* r3*", "", in_block_march_blocks},
    {"single_step_advance_all", "r2* r2* r2 r1 r2* i1* d1*", "", in_single_step_advance_all},
#ifndef SINGLE
    {"long_run_march_one", "r3* r3* r3* r3* r2 r1 r1 r i i b b r2 r3 r2 r1* i1* i1* d1*", "", in_long_run_march_one},
    {"long_run_march_eight", "r3* r3* r3* r3* r2 r1 r1 r i i b b r2 r3 r2 r1* i1* i1* d1*", "", in_long_run_march_eight},
    {"loop_n_march", "r2* r1* r1 r r1 r1 r1 r4* r2* i i i r r3* r2* b r2* r1* r r3* r2* r2*", "i", in_loop_n_march},
    {"vertical_loop_march", "r1 r1 r i i r2* r1*", "b", in_vertical_loop_march},
    {"double_double_loop_prepare_pairs", "r1 r1 r1 r r2 r1* r1* r1*", "ii", in_double_double_loop_prepare_pairs},
    {"double_double_loop_march_pairs", "r1* r2 r1 r1 r3* i i i i i r2* r2* r2* r2* b r1* r1* r r2* r2* r2* r2*", "iir", in_double_double_loop_march_pairs},
    {"double_double_block_prepare_pairs_block", "r2 r2 r2 r1 r2 r2* i1* i1*", "", in_double_double_block_prepare_pairs_block},
    {"double_double_block_march_pairs_block", "r2* i i i i1 r3* r3* r3* r3* i1* i1* d1*", "", in_double_double_block_march_pairs_block},
    {"double_double_long_march_long_pairs", "r1 r1 r1 r r r i i i r2 r b r1 r1* r2* r2* r2* r2* r2* r2* r2* r2*", "iirr", in_double_double_long_march_long_pairs},
    {"tangent_follow_all", "r2 r2 r1 r i r2*", "", in_tangent_follow_all},
    {"following_follow_one", "r3* r3* r3* r3* r2 r1 r1 r r1 r1 r1 r1 b b b r2 r3 r2 r2* i1* i1* d1*", "", in_following_follow_one},
    {"following_follow_eight", "r3* r3* r3* r3* r2 r1 r1 r r1 r1 r1 r1 b b b r2 r3 r2 r2* i1* i1* d1*", "", in_following_follow_eight},
    {"expected_surveyed", "r2 r2 r2 r1 r1 r r r2*", "rr", in_expected_surveyed},
    {"expected_estimated", "r2 r2 r1 b b b r1* r1* r1*", "r", in_expected_estimated},
#endif
};
const int LOOPS(_count) = sizeof LOOPS() / sizeof *LOOPS();
#ifndef SINGLE
const char loops_text[] = "78c73e63be779e905a50fe30c41fd96b9835e046ad3a25a6e18692d78dc643f4";
#endif
