/* The loops of chapsym/dynamics/loops and their kernels: with SINGLE in float32, with LONG of long steps.
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
#ifdef LONG
#define LOOPS(rest) loops_long##rest
#else
#define LOOPS(rest) loops_double##rest
#endif
#endif
#define R(x) ((real)(x))
/* On x86 a loop that gains from wide registers is compiled for them, too, and takes them where the processor has them:
 * to the same bits.  The widest make long steps of one ball slower. */
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) && !defined(WIDEST_OFF)
#define WIDEST __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#define WIDER __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define WIDEST
#define WIDER
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
INLINE w1 w1_part(w1 a, int64_t low, int64_t high) { return (w1){a.p + low, high - low}; }
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

typedef struct { r1 first, allowed, most, start; real interval; int patient; } Asked;
typedef struct { r2 tensor; r1 contact, radius; } Balls;
typedef struct { r2 state, radius, enough, past, body; r1 scale; } Block;
typedef struct { r2 S, E, bodies, states, lanes; r3 ends, curves; r2 V; r1 now; } Crew;
typedef struct { i1 taken, status; d1 reach; } Ends;
typedef struct { r3 momenta, verticals, attitudes, traces; int follows, traced; } Frames;
typedef struct { r1 state; r2 limits, past; r1 attitude, contact; real radius; } Moving;
typedef struct { r2 slopes; r1 box; r2 spread; } Proof;
typedef struct { real w, m, rest, shift, curved; } Root;
typedef struct { real a0, a1, a2, a3; } t_r4;
typedef struct { real a0, a1, a2; } t_r3;
typedef struct { real a0, a1, a2, a3, a4, a5, a6, a7, a8; } t_r9;
typedef struct { t_r4 p; t_r3 w; real first; t_r3 d; t_r9 cofactors; } Round;
typedef struct { r1 c; r3 weights; } Stages;
typedef struct { r2 momentum, gamma, tensor; r1 contact; } Start;
typedef struct { int64_t first, last, every; } Steps;
typedef struct { r1 momentum, gamma, attitude, tensor; real contact, radius; } Still;
typedef struct { r2 momenta, verticals, attitudes, traces; int follows; } Track;
typedef struct { r2 k; r1 g, J; real D; r1 c, near, enough; r4 past; r2 use; real scale; r2 R; r1 spot; real rho; }
    Under;
typedef struct { r2 sums; r3 following; r2 beginning; } Weights;
typedef struct { real a0, a1; } t_r2;
typedef struct { t_r2 a0, a1, a2, a3; } t_p4;
typedef struct { t_p4 a0; t_r2 a1, a2; } t__p4_p2;
typedef struct { t_r2 a0, a1, a2; } t__r2_3;
typedef struct { t_r3 a0, a1; } t__r3_2;
typedef struct { t_r3 a0, a1; t_r4 a2; real a3, a4; } t__r3_2_r4_r2;
typedef struct { t_r3 a0, a1, a2; } t__r3_3;
typedef struct { t_r3 a0, a1, a2; real a3; } t__r3_3r;
typedef struct { t_r4 a0; t_r3 a1; real a2; } t__r4__r3_r;
typedef struct { t_r4 a0; t_r3 a1; real a2; int a3, a4; } t__r4__r3_rb2;
typedef struct { t_r4 a0; real a1, a2; } t__r4_r2;
typedef struct { t_r2 a0, a1, a2; } t_p3;
typedef struct { int a0; t_p3 a1; } t_b_p3_;
typedef struct { int a0; t_r4 a1; } t_b_r4_;
typedef struct { int a0; t_r4 a1; t_r3 a2; } t_b_r4__r3_;
typedef struct { int a0; real a1; } t_br;
typedef struct { real a0, a1, a2; } t_e3;
typedef struct { int64_t a0, a1; } t_i2;
typedef struct { int64_t a0, a1; real a2; } t_i2r;
typedef struct { int64_t a0, a1; real a2, a3; } t_i2r2;
typedef struct { int64_t a0; int a1; } t_ib;
typedef struct { int64_t a0; double a1, a2, a3, a4, a5; } t_id5;
typedef struct { int64_t a0; real a1; } t_ir;
typedef struct { int64_t a0; real a1, a2, a3, a4, a5; } t_ir5;
typedef struct { int64_t a0; real a1; t_p3 a2; } t_ir_p3_;
typedef struct { int64_t a0; real a1; t_p4 a2; t_r2 a3, a4; } t_ir_p4_p2;
typedef struct { int64_t a0; real a1; t_r4 a2; } t_ir_r4_;
typedef struct { int64_t a0; real a1; t_r4 a2; t_r3 a3; } t_ir_r4__r3_;
typedef struct { t_r2 a0, a1, a2; } t_q3;
typedef struct { real a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11; } t_r12;
typedef struct { real a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12; } t_r13;
typedef struct { real a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, a15, a16, a17; } t_r18;
typedef struct { real a0, a1, a2; t_r3 a3; } t_r3_r3_;
typedef struct { real a0, a1, a2, a3, a4; } t_r5;
typedef struct { real a0, a1, a2, a3, a4, a5, a6, a7; } t_r8;
typedef struct { real a0; t_r9 a1; } t_r_r9_;

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

INLINE t_r3 vectors_three(r1 array, int64_t at) { return (t_r3){array.p[at], array.p[at + 1], array.p[at + 2]}; }
INLINE t_r3 vectors_scaled(real s, t_r3 v) { return (t_r3){s * v.a0, s * v.a1, s * v.a2}; }
INLINE void vectors_put(r1 array, int64_t at, t_r3 v) {
    array.p[at] = v.a0; array.p[at + 1] = v.a1; array.p[at + 2] = v.a2;
}

INLINE t_r3 branch_moments(t_r3 J) { return (t_r3){J.a1 + J.a2, J.a0 + J.a2, J.a0 + J.a1}; }
INLINE real vectors_largest(t_r3 v) { return max_r(max_r(R(fabs(v.a0)), R(fabs(v.a1))), R(fabs(v.a2))); }
INLINE t_ib loop_scaling(t_r3 momentum, t_r3 tensor, real contact) {
    t_r3 t_1 = branch_moments(tensor); t_ri t_2 = real_frexp(max_r(max_r(t_1.a0, t_1.a1), t_1.a2) + contact);
    int64_t exponent = t_2.a1; real most = vectors_largest(momentum); t_ri size = real_frexp(most);
    exponent = max_i(min_i(exponent, 1021), size.a1 - 1021);
    int tiny = R(0.0) < most && most < R(ldexp(gibbs_SMALLEST, (int)exponent));
    if (tiny) { exponent = max_i(-1, exponent - 1021 + 1); }
    return (t_ib){exponent, tiny};
}

INLINE t_r3 vectors_shifted(t_r3 v, int64_t exponent) {
    return (t_r3){R(ldexp(v.a0, (int)exponent)), R(ldexp(v.a1, (int)exponent)), R(ldexp(v.a2, (int)exponent))};
}

INLINE t_r3 loop_times(t_r3 v, int64_t exponent) {
    if (-126 <= exponent && exponent <= 127) { return vectors_scaled(R(ldexp(R(1.0), (int)exponent)), v); }
    return vectors_shifted(v, exponent);
}

INLINE int gibbs_is_heavy(t_r3 I, real D) { return R(32.0) * min_r(min_r(I.a0, I.a1), I.a2) < D; }
INLINE real vectors_dot(t_r3 a, t_r3 b) { return a.a0 * b.a0 + a.a1 * b.a1 + a.a2 * b.a2; }
INLINE real vectors_length(t_r3 v) { return R(sqrt(vectors_dot(v, v))); }
INLINE t_r2 gibbs_bound(t_r3 k, t_r3 I, real D) {
    real half = vectors_length(k), size = R(2.0) * half, least = min_r(min_r(I.a0, I.a1), I.a2);
    real most = max_r(max_r(I.a0, I.a1), I.a2), spread = R(0.5) * (most - least);
    real inner = size < least ? size / (least + R(sqrt((least - size) * (least + size)))) : R(1.0);
    real slope = spread + size; int inside = inner * slope < R(0.95) * least;
    real limit = slope > R(0.0) ? min_r(R(1.0), least / slope) : R(1.0);
    real radius = min_r(R(1.25) * inner, R(0.5) * (inner + limit));
    real contraction = inside ? (spread + half) / (least - radius * slope) : R(1.0);
    real enough = half > R(0.0) ? gibbs_LEFT * half / ((most + D + spread) * contraction) : R(0.0);
    int slow = enough < (vectors_largest(k) > R(0.0) ? gibbs_LEAST_ENOUGH : R(0.0));
    radius = slow ? R(-1.0) : radius * radius; enough = slow ? R(0.0) : enough;
    return (t_r2){inside ? radius : R(-2.0), inside ? enough : R(0.0)};
}

INLINE t_r2 gibbs_certificate(t_r3 k, t_r3 I, real D) {
    int heavy = gibbs_is_heavy(I, D); t_r2 radius = gibbs_bound(k, I, D);
    return (t_r2){heavy ? R(-1.0) : radius.a0, heavy ? R(0.0) : radius.a1};
}

INLINE t_r2 loop_limits(t_r3 k, t_r3 inertia, real contact, int tiny) {
    t_r2 radius = gibbs_certificate(k, inertia, contact);
    return (t_r2){tiny ? R(-1.0) : (min_r(min_r(inertia.a0, inertia.a1), inertia.a2) < gibbs_SMALLEST ? R(-1.0) :
        radius.a0), radius.a1};
}

OUT_OF_LINE real loop_entered(r1 momentum, r1 g, r1 tensor, real contact, r1 state) {
    t_ib exponent = loop_scaling(vectors_three(momentum, 0), vectors_three(tensor, 0), contact);
    r1_fill(state, R(0.0)); vectors_put(state, 0, loop_times(vectors_three(momentum, 0), -exponent.a0 - 1));
    vectors_put(state, 3, vectors_three(g, 0));
    vectors_put(state, 18, loop_times(vectors_three(tensor, 0), -exponent.a0));
    vectors_put(state, 21, branch_moments(vectors_three(state, 18)));
    t_r3 t_1 = loop_times((t_r3){contact, R(0.0), R(0.0)}, -exponent.a0); state.p[24] = t_1.a0;
    t_r2 t_2 = loop_limits(vectors_three(state, 0), vectors_three(state, 21), state.p[24], exponent.a1);
    state.p[25] = t_2.a0; state.p[26] = t_2.a1; return R(ldexp(R(1.0), (int)(exponent.a0 + 1)));
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

INLINE t__r2_3 integrals_integrals(t_r3 k, t_r3 g) {
    return (t__r2_3){integrals_inner(g.a0, g.a1, g.a2, g.a0, g.a1, g.a2, R(0.0), R(0.0)), integrals_inner(k.a0, k.a1,
        k.a2, g.a0, g.a1, g.a2, R(0.0), R(0.0)), integrals_inner(k.a0, k.a1, k.a2, k.a0, k.a1, k.a2, R(0.0), R(0.0))};
}

OUT_OF_LINE void integrals_remember(r1 state) {
    t__r2_3 one = integrals_integrals(vectors_three(state, 0), vectors_three(state, 3)); t_r2 t_1 = one.a0;
    state.p[12] = t_1.a0; state.p[13] = t_1.a1; t_r2 t_2 = one.a1; state.p[14] = t_2.a0; state.p[15] = t_2.a1;
    t_r2 t_3 = one.a2; state.p[16] = t_3.a0; state.p[17] = t_3.a1;
}

OUT_OF_LINE real loop_prepare(r1 momentum, r1 g, r1 tensor, real contact, r1 c, r1 state, r2 limits) {
    ALIGNED real part_[3]; r1 part = {part_, 3}; real scale = R(1.0);
    for (int64_t i = 0, end_i = c.n0; i < end_i; i++) {
        vectors_put(part, 0, vectors_scaled(c.p[i], vectors_three(momentum, 0)));
        scale = loop_entered(part, g, tensor, contact, state); AT2(limits, 0, i) = state.p[25];
        AT2(limits, 1, i) = state.p[26];
    }
    if (c.n0 > 1) { scale = loop_entered(momentum, g, tensor, contact, state); }
    integrals_remember(state); return scale;
}

INLINE t_r3 vectors_plus(t_r3 a, t_r3 b) { return (t_r3){a.a0 + b.a0, a.a1 + b.a1, a.a2 + b.a2}; }
INLINE t_r3 loop_guessed(r2 past, int64_t at, r1 weights) {
    t_r3 u = (t_r3){R(0.0), R(0.0), R(0.0)};
    for (int64_t j = 0, end_j = weights.n0; j < end_j; j++) {
        u = vectors_plus(u, vectors_scaled(weights.p[j], vectors_three(r2_row(past, at + j), 0)));
    }
    return u;
}

INLINE real vectors_square(t_r3 v) { return v.a0 * v.a0 + (v.a1 * v.a1 + v.a2 * v.a2); }
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

INLINE t_r3 vectors_minus(t_r3 a, t_r3 b) { return (t_r3){a.a0 - b.a0, a.a1 - b.a1, a.a2 - b.a2}; }
INLINE Round gibbs_round_from(t_r3 u, t_r13 found) {
    t_r3 w = vectors_scaled(R(1.0) / found.a0, (t_r3){found.a1, found.a2, found.a3}), d = vectors_minus(w, u);
    return (Round){(t_r4){found.a0, found.a1, found.a2, found.a3}, w, vectors_square(d), d, (t_r9){found.a4, found.a5,
        found.a6, found.a7, found.a8, found.a9, found.a10, found.a11, found.a12}};
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

INLINE Round gibbs_newton_round(t_r3 u, t_r3 k, t_r3 g, t_r3 I, real D, int heavy) {
    if (heavy) {
        return gibbs_round_from(u, kernel_gibbs_newton_heavy(u.a0, u.a1, u.a2, k.a0, k.a1, k.a2, g.a0, g.a1, g.a2,
            I.a0, I.a1, I.a2, D));
    }
    return gibbs_round_from(u, kernel_gibbs_newton(u.a0, u.a1, u.a2, k.a0, k.a1, k.a2, g.a0, g.a1, g.a2, I.a0, I.a1,
        I.a2, D));
}

INLINE t_r3 kernel_gibbs_second(real d1, real d2, real d3, real k1, real k2, real k3, real c11, real c12, real c13,
    real c21, real c22, real c23, real c31, real c32, real c33, real I1, real I2, real I3) {
    real t0 = d1 * d1 + d2 * d2 + d3 * d3, r1 = I3 * d2 * d3 - k1 * t0 - I2 * d2 * d3;
    real r2 = I1 * d1 * d3 - k2 * t0 - I3 * d1 * d3, r3 = I2 * d1 * d2 - k3 * t0 - I1 * d1 * d2;
    real o_e1 = c11 * r1 + c21 * r2 + c31 * r3, o_e2 = c12 * r1 + c22 * r2 + c32 * r3;
    real o_e3 = c13 * r1 + c23 * r2 + c33 * r3; return (t_r3){o_e1, o_e2, o_e3};
}

INLINE t__r4__r3_r gibbs_second_round(Round r, t_r3 k, t_r3 I) {
    t_r3 e = kernel_gibbs_second(r.d.a0, r.d.a1, r.d.a2, k.a0, k.a1, k.a2, r.cofactors.a0, r.cofactors.a1,
        r.cofactors.a2, r.cofactors.a3, r.cofactors.a4, r.cofactors.a5, r.cofactors.a6, r.cofactors.a7,
        r.cofactors.a8, I.a0, I.a1, I.a2);
    real scale = R(1.0) / r.p.a0; t_r3 v = vectors_minus((t_r3){r.p.a1, r.p.a2, r.p.a3}, e);
    return (t__r4__r3_r){(t_r4){r.p.a0, v.a0, v.a1, v.a2}, vectors_scaled(scale, v), vectors_square(e) * (scale *
        scale)};
}

INLINE t_b_r4__r3_ gibbs_settle(t_r3 u, t_r3 k, t_r3 g, t_r3 I, real D, real radius, real enough, int heavy) {
    if (!(vectors_square(u) <= radius)) { return (t_b_r4__r3_){0, (t_r4){R(1.0), R(0.0), R(0.0), R(0.0)}, u}; }
    Round r = gibbs_newton_round(u, k, g, I, D, heavy);
    if (r.first <= enough) { return (t_b_r4__r3_){1, r.p, r.w}; }
    t__r4__r3_r p = gibbs_second_round(r, k, I);
    return (t_b_r4__r3_){R(9.0) * max_r(r.first, p.a2) * p.a2 <= enough * enough && vectors_square(p.a1) <= radius,
        p.a0, p.a1};
}

INLINE t__r4__r3_rb2 path_improved(t_r3 u, t_r3 k, t_r3 g, t_r3 I, real D) {
    Round r = gibbs_newton_round(u, k, g, I, D, 0); t__r4__r3_r p = gibbs_second_round(r, k, I);
    real size = vectors_square(p.a1);
    real curved = R(6.0) * (R(0.5) * (max_r(max_r(I.a0, I.a1), I.a2) - min_r(min_r(I.a0, I.a1), I.a2)) +
        R(sqrt(vectors_square(k))));
    real left = curved * curved * (max_r(r.first, p.a2) * p.a2);
    real allowed = gibbs_LEFT * (R(0.0625) * (max_r(max_r(I.a0, I.a1), I.a2) + D));
    return (t__r4__r3_rb2){p.a0, p.a1, left, left <= allowed * allowed * size, p.a2 <= R(1e-26) * size};
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
    real value, slope; real x = minors > R(0.0) ? det / minors : R(-1.0);
    for (int64_t i_0 = 0; i_0 < 2; i_0++) {
        value = ((x - trace) * x + minors) * x - det; slope = (R(3.0) * x - R(2.0) * trace) * x + minors;
        x = slope > R(0.0) ? x - value / slope : x;
    }
    x = trace > R(0.0) ? x : R(-1.0); x = minors > R(0.0) ? x : R(-1.0); return det > R(0.0) ? x : R(-1.0);
}

INLINE real path_small_between(real a, real b, real most, t_r9 path) {
    t_r9 size = path; real start = size.a0 * (R(1.0) + a) - size.a1 * (R(1.0) + a * a * size.a0) - size.a2;
    real end = size.a0 * (R(1.0) + b) - size.a1 * (R(1.0) + b * b * size.a0) - size.a2;
    real r = max_r(R(fabs(start)), R(fabs(end))) + R(0.25) * (b - a) * (b - a) * size.a1 * size.a0;
    real m = min_r((R(1.0) - a) * size.a7 + a * size.a8, (R(1.0) - b) * size.a7 + b * size.a8) - most * size.a6;
    real left = R(4.0) * size.a5 * most;
    real small = left * left * (size.a4 * size.a4 * (r * r) + size.a3) < R(0.98) * (m * m) * (m * m) ? R(1.0) :
        R(0.0);
    return m > R(0.0) ? small : R(0.0);
}

INLINE t_r2 path_joined(t_r3 u, real size, t_r3 k, real half, t_r3 g, t_r3 I, real D, real spread) {
    real none = R(0.0) * u.a0;
    t_r3 t_1 = kernel_gibbs_symmetric(none, none, none, k.a0, k.a1, k.a2, g.a0, g.a1, g.a2, I.a0, I.a1, I.a2, D);
    real first = path_lowest(t_1.a0, t_1.a1, t_1.a2);
    t_r3 t_2 = kernel_gibbs_symmetric(u.a0, u.a1, u.a2, k.a0, k.a1, k.a2, g.a0, g.a1, g.a2, I.a0, I.a1, I.a2, D);
    real last = path_lowest(t_2.a0, t_2.a1, t_2.a2); t_r3 u1 = u, I1 = I;
    t_r3 x = (t_r3){I1.a2 * u1.a1 * u1.a2 - I1.a1 * u1.a1 * u1.a2, I1.a0 * u1.a0 * u1.a2 - I1.a2 * u1.a0 * u1.a2,
        I1.a1 * u1.a0 * u1.a1 - I1.a0 * u1.a0 * u1.a1};
    real along = (x.a0 * k.a0 + (x.a1 * k.a1 + x.a2 * k.a2)) / (half * half);
    real across = max_r(vectors_square(x) - along * along * (half * half), R(0.0));
    real c = max_r(R(0.0), min_r(R(1.0), (size * R(1.75) - along) / (R(1.0) + R(0.5625) * size)));
    real sag = half * R(sqrt(size)) - (k.a0 * u1.a0 + (k.a1 * u1.a1 + k.a2 * u1.a2)), slope = spread + R(2.0) * half;
    real proved = first > R(0.0) ? R(1.0) : R(0.0); proved = last > R(0.0) ? proved : R(0.0);
    t_r9 path = (t_r9){size, c, along, across, half, slope, sag, first, last};
    real a = R(0.0), b = R(0.4), most = R(0.24); proved = proved * path_small_between(a, b, most, path); a = R(0.4);
    b = R(0.65); most = R(0.25); proved = proved * path_small_between(a, b, most, path); a = R(0.65); b = R(0.85);
    most = R(0.2275); proved = proved * path_small_between(a, b, most, path); a = R(0.85); b = R(1.0);
    most = R(0.1275); proved = proved * path_small_between(a, b, most, path); return (t_r2){proved, last};
}

INLINE int path_proved(t_r3 u, real left, t_r3 k, t_r3 g, t_r3 I, real D) {
    real half = R(sqrt(vectors_square(k)));
    real spread = R(0.5) * (max_r(max_r(I.a0, I.a1), I.a2) - min_r(min_r(I.a0, I.a1), I.a2));
    real size = vectors_square(u); t_r2 reached = path_joined(u, size, k, half, g, I, D, spread);
    real allowed = gibbs_LEFT * reached.a1; return (left <= allowed * allowed * size ? reached.a0 : R(0.0)) > R(0.0);
}

INLINE t_b_r4__r3_ path_search_on_path(t_r3 u, t_r3 k, t_r3 g, t_r3 I, real D) {
    t_r4 p; real left; int near, found; Round r = gibbs_newton_round(u, k, g, I, D, 0); u = r.w;
    for (int64_t i_0 = 0; i_0 < 6; i_0++) {
        t__r4__r3_rb2 t_1 = path_improved(u, k, g, I, D); p = t_1.a0; u = t_1.a1; left = t_1.a2; near = t_1.a3;
        found = t_1.a4;
        if ((near || found) && path_proved(u, left, k, g, I, D)) { return (t_b_r4__r3_){1, p, u}; }
        if (found) { break; }
    }
    return (t_b_r4__r3_){0, (t_r4){R(1.0), R(0.0), R(0.0), R(0.0)}, u};
}

INLINE t_b_r4__r3_ gibbs_search(t_r3 u, t_r3 k, t_r3 g, t_r3 I, real D, real radius, real enough, int heavy) {
    int settled; t_r4 p;
    for (int64_t guess = 0; guess < 2; guess++) {
        if (guess == 1) { u = (t_r3){R(0.0), R(0.0), R(0.0)}; }
        for (int64_t i_1 = 0; i_1 < 12; i_1++) {
            t_b_r4__r3_ t_1 = gibbs_settle(u, k, g, I, D, radius, enough, heavy); settled = t_1.a0; p = t_1.a1;
            u = t_1.a2;
            if (settled) { return (t_b_r4__r3_){1, p, u}; }
        }
    }
    return (t_b_r4__r3_){0, (t_r4){R(1.0), R(0.0), R(0.0), R(0.0)}, u};
}

INLINE t_b_r4__r3_ gibbs_search_safely(t_r3 u, t_r3 k, t_r3 g, t_r3 I, real D, real radius, real enough) {
    t_ri size; int heavy = gibbs_is_heavy(I, D);
    if (heavy && vectors_largest(k) < min_r(min_r(I.a0, I.a1), I.a2)) {
        size = real_frexp(max_r(max_r(I.a0, I.a1), I.a2) + D); I = vectors_shifted(I, -size.a1);
        D = R(ldexp(D, (int)-size.a1)); k = vectors_shifted(k, -size.a1);
        if (min_r(min_r(I.a0, I.a1), I.a2) >= gibbs_LIGHTEST && vectors_largest(k) >= gibbs_LIGHTEST) {
            t_r2 t_1 = gibbs_bound(k, I, D); radius = t_1.a0; enough = t_1.a1;
        }
    }
    if (!(radius >= R(0.0))) { return (t_b_r4__r3_){0, (t_r4){R(1.0), R(0.0), R(0.0), R(0.0)}, u}; }
    return gibbs_search(u, k, g, I, D, radius, enough, heavy);
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

INLINE t_r_r9_ branch_inverse_of(t_r9 a) {
    t_r9 a11 = a; real c11 = a11.a4 * a11.a8 - a11.a5 * a11.a7, c12 = a11.a5 * a11.a6 - a11.a3 * a11.a8;
    real c13 = a11.a3 * a11.a7 - a11.a4 * a11.a6, c21 = a11.a2 * a11.a7 - a11.a1 * a11.a8;
    real c22 = a11.a0 * a11.a8 - a11.a2 * a11.a6, c23 = a11.a1 * a11.a6 - a11.a0 * a11.a7;
    real c31 = a11.a1 * a11.a5 - a11.a2 * a11.a4, c32 = a11.a2 * a11.a3 - a11.a0 * a11.a5;
    real c33 = a11.a0 * a11.a4 - a11.a1 * a11.a3, det = a11.a0 * c11 + a11.a1 * c12 + a11.a2 * c13;
    if (det == R(0.0)) {
        return (t_r_r9_){R(0.0), (t_r9){R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0)}};
    }
    real s = R(1.0) / det;
    return (t_r_r9_){det, (t_r9){c11 * s, c21 * s, c31 * s, c12 * s, c22 * s, c32 * s, c13 * s, c23 * s, c33 * s}};
}

INLINE t_r3 branch_product(t_r9 n, t_r3 v) {
    return (t_r3){vectors_dot((t_r3){n.a0, n.a1, n.a2}, v), vectors_dot((t_r3){n.a3, n.a4, n.a5}, v),
        vectors_dot((t_r3){n.a6, n.a7, n.a8}, v)};
}

INLINE t_r_r9_ branch_inverse(t_r4 q, t_r3 g, t_r3 J, real D) {
    t_r_r9_ det = branch_inverse_of(kernel_tangent_jacobian(q.a0, q.a1, q.a2, q.a3, g.a0, g.a1, g.a2, J.a0, J.a1,
        J.a2, D));
    if (det.a0 == R(0.0) || !gibbs_is_heavy(branch_moments(J), D)) { return (t_r_r9_){det.a0, det.a1}; }
    t_r9 a = kernel_tangent_jacobian(q.a0, q.a1, q.a2, q.a3, g.a0, g.a1, g.a2, J.a0, J.a1, J.a2, R(0.0) * D);
    t_r3 y = (t_r3){vectors_dot(g, (t_r3){a.a0, a.a3, a.a6}), vectors_dot(g, (t_r3){a.a1, a.a4, a.a7}), vectors_dot(g,
        (t_r3){a.a2, a.a5, a.a8})};
    real true = vectors_dot(y, branch_product(det.a1, g)) / vectors_dot(g, g);
    if (true == R(0.0)) {
        return (t_r_r9_){R(0.0), (t_r9){R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0), R(0.0)}};
    }
    real s = R(1.0) / true; t_r3 t_1 = vectors_scaled(s, (t_r3){det.a1.a0, det.a1.a1, det.a1.a2});
    t_r3 t_2 = vectors_scaled(s, (t_r3){det.a1.a3, det.a1.a4, det.a1.a5});
    t_r3 t_3 = vectors_scaled(s, (t_r3){det.a1.a6, det.a1.a7, det.a1.a8});
    return (t_r_r9_){det.a0 * true, (t_r9){t_1.a0, t_1.a1, t_1.a2, t_2.a0, t_2.a1, t_2.a2, t_3.a0, t_3.a1, t_3.a2}};
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

INLINE t_r3_r3_ branch_tangent(t_r4 q, t_r3 K, t_r3 g, t_r3 J, real D) {
    t_r3 w; real weight; t_r_r9_ det = branch_inverse(q, g, J, D);
    t_r18 t_1 = kernel_tangent_hessian(q.a0, q.a1, q.a2, q.a3, g.a0, g.a1, g.a2, J.a0, J.a1, J.a2, D);
    real h_[] = {t_1.a0, t_1.a1, t_1.a2, t_1.a3, t_1.a4, t_1.a5, t_1.a6, t_1.a7, t_1.a8, t_1.a9, t_1.a10, t_1.a11,
        t_1.a12, t_1.a13, t_1.a14, t_1.a15, t_1.a16, t_1.a17};
    r1 h = {h_, 18}; real bend = R(0.0);
    for (int64_t pair = 0; pair < 6; pair++) {
        w = branch_product(det.a1, (t_r3){h.p[3 * pair], h.p[3 * pair + 1], h.p[3 * pair + 2]});
        weight = pair < 3 ? R(1.0) : R(2.0); bend = bend + weight * vectors_dot(w, w);
    }
    t_r3 d = branch_product(det.a1, K); return (t_r3_r3_){det.a0, R(sqrt(vectors_dot(d, d))), R(sqrt(bend)), d};
}

#endif
INLINE t_r4 kernel_compose(real a0, real a1, real a2, real a3, real b0, real b1, real b2, real b3) {
    real o_c0 = a0 * b0 - a1 * b1 - (a2 * b2 + a3 * b3), o_c1 = a0 * b1 + a1 * b0 + (a2 * b3 - a3 * b2);
    real o_c2 = a0 * b2 + a2 * b0 + (a3 * b1 - a1 * b3), o_c3 = a0 * b3 + a1 * b2 + (a3 * b0 - a2 * b1);
    return (t_r4){o_c0, o_c1, o_c2, o_c3};
}

#ifndef SINGLE
INLINE t_r4 branch_turned(t_r4 q, t_r3 w) {
    t_r4 p = kernel_compose(q.a0, q.a1, q.a2, q.a3, R(1.0), w.a0, w.a1, w.a2);
    real length = R(sqrt(p.a0 * p.a0 + p.a1 * p.a1 + p.a2 * p.a2 + p.a3 * p.a3));
    return (t_r4){p.a0 / length, p.a1 / length, p.a2 / length, p.a3 / length};
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

INLINE t_b_r4_ branch_corrected(t_r4 q, t_r3 K, t_r3 g, t_r3 J, real D) {
    t_r3 r, w; t_r_r9_ det; real change, extent, most, noise; real size = vectors_largest(K);
    t_r3 t_1 = branch_moments(J); real top = max_r(max_r(t_1.a0, t_1.a1), t_1.a2) + D, before = R(2.0);
    for (int64_t i_0 = 0; i_0 < 20; i_0++) {
        r = kernel_residual(q.a0, q.a1, q.a2, q.a3, K.a0, K.a1, K.a2, g.a0, g.a1, g.a2, J.a0, J.a1, J.a2, D);
        det = branch_inverse(q, g, J, D);
        if (det.a0 == R(0.0)) { return (t_b_r4_){0, q}; }
        w = branch_product(det.a1, r); q = branch_turned(q, (t_r3){-w.a0, -w.a1, -w.a2}); change = vectors_largest(w);
        extent = vectors_largest((t_r3){q.a1, q.a2, q.a3});
        most = max_r(max_r(vectors_largest((t_r3){det.a1.a0, det.a1.a1, det.a1.a2}), vectors_largest((t_r3){det.a1.a3,
            det.a1.a4, det.a1.a5})), vectors_largest((t_r3){det.a1.a6, det.a1.a7, det.a1.a8}));
        noise = R(1.7763568394002505e-15) * most * (size + R(2.0) * top * extent);
        if (change <= max_r(R(1e-09) * extent, R(8e-323))) { return (t_b_r4_){1, q}; }
        if (change <= noise && change >= R(0.25) * before) { return (t_b_r4_){1, q}; }
        before = change;
    }
    return (t_b_r4_){0, q};
}

INLINE t_ir_r4_ branch_continued(t_r3 K, t_r3 g, t_r3 J, real D, real shortest) {
    t_r3_r3_ det; real slope, length, remaining, step, ahead; t_b_r4_ settled;
    t_r4 q = (t_r4){R(1.0), R(0.0), R(0.0), R(0.0)};
    if (K.a0 != K.a0 || K.a1 != K.a1 || K.a2 != K.a2) { return (t_ir_r4_){2, R(0.0), q}; }
    t_r3 t_1 = branch_moments(J); t_ri exponent = real_frexp(max_r(max_r(t_1.a0, t_1.a1), t_1.a2) + D);
    J = vectors_shifted(J, -exponent.a1); D = R(ldexp(D, (int)-exponent.a1)); real most = vectors_largest(K);
    t_ri size = real_frexp(most); int64_t shift = most > R(0.0) ? min_i(-exponent.a1, 3 - size.a1) : -exponent.a1;
    int64_t beyond = most > R(0.0) ? max_i(0, -200 - (size.a1 + shift)) : 0; K = vectors_shifted(K, shift + beyond);
    real end = R(ldexp(R(1.0), (int)(shift + exponent.a1))), t = R(0.0);
    for (int64_t i_0 = 0; i_0 < 20000; i_0++) {
        det = branch_tangent(q, K, g, J, D);
        if (t == R(0.0) && !(det.a0 > R(8.881784197001252e-16))) { return (t_ir_r4_){4, R(0.0), q}; }
        if (!(det.a0 > R(0.0))) { return (t_ir_r4_){1, t * end, q}; }
        slope = det.a2 + R(2.0) * t * det.a1; length = R(0.5) / (slope + R(sqrt(slope * slope + R(2.0))));
        remaining = R(1.0) - t; step = det.a1 * remaining <= length ? remaining : length / det.a1;
        if (step < remaining && step < max_r(shortest * t, R(1e-19) * min_r(t, remaining))) {
            return (t_ir_r4_){1, t * end, q};
        }
        ahead = step == remaining ? R(1.0) : t + step;
        settled = branch_corrected(branch_turned(q, vectors_scaled(step, det.a3)), vectors_scaled(ahead, K), g, J, D);
        if (!settled.a0) { return (t_ir_r4_){2, t * end, q}; }
        t = ahead; q = settled.a1;
        if (t == R(1.0) && end < R(1.0)) { return (t_ir_r4_){2, end, q}; }
        if (t == R(1.0)) {
            if (q.a0 < R(0.0)) { q = (t_r4){-q.a0, -q.a1, -q.a2, -q.a3}; }
            t_r3 t_2 = vectors_shifted((t_r3){q.a1, q.a2, q.a3}, -beyond);
            return (t_ir_r4_){0, R(1.0), (t_r4){q.a0, t_2.a0, t_2.a1, t_2.a2}};
        }
    }
    return (t_ir_r4_){2, t * end, q};
}

INLINE t_ir5 branch_small_rotation(real K1, real K2, real K3, real g1, real g2, real g3, real J1, real J2, real J3,
    real D) {
    t_ir_r4_ status = branch_continued((t_r3){K1, K2, K3}, (t_r3){g1, g2, g3}, (t_r3){J1, J2, J3}, D, R(4e-16));
    return (t_ir5){status.a0, status.a1, status.a2.a0, status.a2.a1, status.a2.a2, status.a2.a3};
}

#ifndef LONG
t_ir5 branch_small_rotation_double(real K1, real K2, real K3, real g1, real g2, real g3, real J1, real J2, real J3,
    real D) {
    return branch_small_rotation(K1, K2, K3, g1, g2, g3, J1, J2, J3, D);
}

#endif
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
OUT_OF_LINE t_ir_r4__r3_ loop_safe_rotation(t_r3 u, r1 state) {
    int settled; t_r4 p; t_r3 w;
    t_r3 k = vectors_three(state, 0), g = vectors_three(state, 3), inertia = vectors_three(state, 21);
    real contact = state.p[24];
    if (state.p[25] == R(-2.0)) {
        t_b_r4__r3_ t_1 = path_search_on_path(u, k, g, inertia, contact); settled = t_1.a0; p = t_1.a1; w = t_1.a2;
    }
    else {
        t_b_r4__r3_ t_2 = gibbs_search_safely(u, k, g, inertia, contact, state.p[25], state.p[26]); settled = t_2.a0;
        p = t_2.a1; w = t_2.a2;
    }
    if (settled) { return (t_ir_r4__r3_){0, R(1.0), p, w}; }
    t_r3 t_3 = vectors_scaled(R(2.0), k), t_4 = vectors_three(state, 18);
    t_ir5 status = loop_small_rotation(t_3.a0, t_3.a1, t_3.a2, g.a0, g.a1, g.a2, t_4.a0, t_4.a1, t_4.a2, contact);
    if (status.a2 == R(0.0)) {
        return (t_ir_r4__r3_){status.a0, status.a1, (t_r4){status.a2, status.a3, status.a4, status.a5}, (t_r3){R(0.0),
            R(0.0), R(0.0)}};
    }
    return (t_ir_r4__r3_){status.a0, status.a1, (t_r4){status.a2, status.a3, status.a4, status.a5}, (t_r3){status.a3 /
        status.a2, status.a4 / status.a2, status.a5 / status.a2}};
}

INLINE t_r4 vectors_four(r1 array, int64_t at) {
    return (t_r4){array.p[at], array.p[at + 1], array.p[at + 2], array.p[at + 3]};
}

INLINE real vectors_square_of_four(t_r4 q) { return q.a0 * q.a0 + q.a1 * q.a1 + (q.a2 * q.a2 + q.a3 * q.a3); }
INLINE t_r4 vectors_unit(t_r4 q) {
    real size = R(sqrt(vectors_square_of_four(q))); return (t_r4){q.a0 / size, q.a1 / size, q.a2 / size, q.a3 / size};
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

INLINE t_r4 vectors_scaled_four(real s, t_r4 q) { return (t_r4){s * q.a0, s * q.a1, s * q.a2, s * q.a3}; }
INLINE t__r4_r2 loop_followed(t_r4 p, t_r3 g, t_r4 a, real x, real y, real radius) {
    t_r4 q = vectors_unit(p); t_r3 t_1 = kernel_centre_step(q.a0, q.a1, q.a2, q.a3, g.a0, g.a1, g.a2);
    t_r3 d1 = kernel_rotate(a.a0, a.a1, a.a2, a.a3, t_1.a0, t_1.a1, t_1.a2);
    t_r4 b = kernel_compose(a.a0, a.a1, a.a2, a.a3, q.a0, q.a1, q.a2, q.a3);
    real scale = R(1.5) - R(0.5) * (b.a0 * b.a0 + b.a1 * b.a1 + b.a2 * b.a2 + b.a3 * b.a3);
    return (t__r4_r2){vectors_scaled_four(scale, b), x + radius * d1.a0, y + radius * d1.a1};
}

INLINE void vectors_put_four(r1 array, int64_t at, t_r4 q) {
    array.p[at] = q.a0; array.p[at + 1] = q.a1; array.p[at + 2] = q.a2; array.p[at + 3] = q.a3;
}

#ifndef SINGLE
INLINE void loop_follow_body(t_r4 p, t_r3 g, r1 attitude, r1 contact, real radius) {
    t__r4_r2 t_1 = loop_followed(p, g, vectors_four(attitude, 0), contact.p[0], contact.p[1], radius);
    t_r4 a = t_1.a0; contact.p[0] = t_1.a1; contact.p[1] = t_1.a2; vectors_put_four(attitude, 0, a);
}

#endif
INLINE t_r3 kernel_turn(real p0, real p1, real p2, real p3, real v1, real v2, real v3) {
    real s = R(2) / (p0 * p0 + p1 * p1 + (p2 * p2 + p3 * p3)), x1 = p2 * v3 - p3 * v2, x2 = p3 * v1 - p1 * v3;
    real x3 = p1 * v2 - p2 * v1, o_x1 = s * (p2 * x3 - p0 * x1 - p3 * x2), o_x2 = s * (p3 * x1 - p0 * x2 - p1 * x3);
    real o_x3 = s * (p1 * x2 - p0 * x3 - p2 * x1); return (t_r3){o_x1, o_x2, o_x3};
}

INLINE t_r2 integrals_added(real total, real rest, real more) {
    more = more - rest; real there = total + more; return (t_r2){there, there - total - more};
}

INLINE t__r3_2 integrals_turned(t_r4 p, t_r3 v, t_r3 x) {
    t_r3 z = kernel_turn(p.a0, p.a1, p.a2, p.a3, v.a0, v.a1, v.a2);
    t_r2 v1 = integrals_added(v.a0, x.a0, z.a0), v2 = integrals_added(v.a1, x.a1, z.a1);
    t_r2 v3 = integrals_added(v.a2, x.a2, z.a2);
    return (t__r3_2){(t_r3){v1.a0, v2.a0, v3.a0}, (t_r3){v1.a1, v2.a1, v3.a1}};
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
    t_r2 t_1 = integrals_added(array.p[at], array.p[rest], z); array.p[at] = t_1.a0; array.p[rest] = t_1.a1;
}

INLINE void single_loop_follow_body(t_r4 p, t_r3 g, r1 attitude, r1 contact, real radius) {
    real squared = vectors_square((t_r3){p.a1, p.a2, p.a3}), length = R(sqrt(p.a0 * p.a0 + squared));
    t_r4 q = (t_r4){p.a0 / length, p.a1 / length, p.a2 / length, p.a3 / length};
    t_r4 a = (t_r4){attitude.p[0], attitude.p[1], attitude.p[2], attitude.p[3]};
    t_r3 t_1 = kernel_centre_step(q.a0, q.a1, q.a2, q.a3, g.a0, g.a1, g.a2);
    t_r3 x = kernel_rotate(a.a0, a.a1, a.a2, a.a3, t_1.a0, t_1.a1, t_1.a2);
    single_loop_add(contact, 0, 2, radius * x.a0); single_loop_add(contact, 1, 3, radius * x.a1);
    t_r3 t_2 = (t_r3){q.a1, q.a2, q.a3};
    t_r4 z = kernel_compose(a.a0, a.a1, a.a2, a.a3, -squared / (length * (length + p.a0)), t_2.a0, t_2.a1, t_2.a2);
    real stretch = R(0.5) - R(0.5) * vectors_square_of_four(a);
    single_loop_add(attitude, 0, 4, z.a0 + stretch * a.a0); single_loop_add(attitude, 1, 5, z.a1 + stretch * a.a1);
    single_loop_add(attitude, 2, 6, z.a2 + stretch * a.a2); single_loop_add(attitude, 3, 7, z.a3 + stretch * a.a3);
}

#endif
INLINE t_i2r loop_march(Moving ball, Stages stages, Steps steps, int64_t begun, real scale, Track track) {
    int64_t stop, at, later, frame; t_r3 m, u; int settled; t_r4 p; r1 state = ball.state; r2 past = ball.past;
    r1 c = stages.c; r3 weights = stages.weights;
    t_r3 k = vectors_three(state, 0), g = vectors_three(state, 3), x = vectors_three(state, 6);
    t_r3 y = vectors_three(state, 9), inertia = vectors_three(state, 21);
    int64_t count = c.n0, places = weights.n1, period = max_i(1, div_i(1024, count)), step = steps.first, status = 0;
    real reach = R(1.0);
    while (step < steps.last && status == 0) {
        stop = min_i(min_i(steps.last, step + steps.every - mod_i(step, steps.every)), step + period - mod_i(begun +
            step, period));
        while (step < stop) {
            at = mod_i((begun + step) * count, places); later = (begun + step) * count >= places ? 1 : 0;
            for (int64_t i = 0, end_i = count; i < end_i; i++) {
                m = vectors_scaled(c.p[i], k); u = loop_guessed(past, at + i, r2_row(r3_row(weights, later), at + i));
                t_b_r4__r3_ t_1 = gibbs_settle(u, m, g, inertia, state.p[24], AT2(ball.limits, 0, i), AT2(ball.limits,
                    1, i), 0);
                settled = t_1.a0; p = t_1.a1; u = t_1.a2;
                if (!settled) {
                    vectors_put(state, 0, m); vectors_put(state, 3, g); state.p[25] = AT2(ball.limits, 0, i);
                    state.p[26] = AT2(ball.limits, 1, i); t_ir_r4__r3_ t_2 = loop_safe_rotation(u, state);
                    status = t_2.a0; reach = t_2.a1; p = t_2.a2; u = t_2.a3;
                    if (status != 0) { break; }
                }
                vectors_put(r2_row(past, at + i), 0, u); vectors_put(r2_row(past, places + at + i), 0, u);
                if (track.follows) { loop_follow_body(p, g, ball.attitude, ball.contact, ball.radius); }
                t__r3_2 t_3 = integrals_turned(p, k, x); k = t_3.a0; x = t_3.a1;
                t__r3_2 t_4 = integrals_turned(p, g, y); g = t_4.a0; y = t_4.a1;
            }
            if (status != 0) { break; }
            step = step + 1;
        }
        if (status == 0) { vectors_put(state, 0, k); vectors_put(state, 3, g); }
        vectors_put(state, 6, x); vectors_put(state, 9, y);
        if (status == 0 && mod_i(begun + step, period) == 0) {
            integrals_restore(state); x = vectors_three(state, 6); y = vectors_three(state, 9);
        }
        if (status == 0 && mod_i(step, steps.every) == 0) {
            frame = div_i(step, steps.every); vectors_put(r2_row(track.momenta, frame), 0, vectors_scaled(scale, k));
            vectors_put(r2_row(track.verticals, frame), 0, g);
            if (track.follows) {
                vectors_put_four(r2_row(track.attitudes, frame), 0, vectors_four(ball.attitude, 0));
                AT2(track.traces, frame, 0) = ball.contact.p[0]; AT2(track.traces, frame, 1) = ball.contact.p[1];
            }
        }
    }
    return (t_i2r){step - steps.first, status, reach};
}

INLINE t_ir loop_advance(r1 momentum, r1 g, r1 tensor, real contact, r1 state, r1 q) {
    int64_t status; real scale = loop_entered(momentum, g, tensor, contact, state);
    t_r3 k = vectors_three(state, 0), v = vectors_three(state, 3); real reach = R(1.0);
    t_b_r4__r3_ t_1 = gibbs_settle((t_r3){R(0.0), R(0.0), R(0.0)}, k, v, vectors_three(state, 21), state.p[24],
        state.p[25], state.p[26], 0);
    int settled = t_1.a0; t_r4 p = t_1.a1; t_r3 u = t_1.a2;
    if (!settled) {
        t_ir_r4__r3_ t_2 = loop_safe_rotation(u, state); status = t_2.a0; reach = t_2.a1; p = t_2.a2; u = t_2.a3;
        if (status != 0) { return (t_ir){status, reach}; }
    }
    vectors_put_four(q, 0, vectors_unit(p));
    vectors_put(momentum, 0, vectors_scaled(scale, vectors_plus(k, kernel_turn(p.a0, p.a1, p.a2, p.a3, k.a0, k.a1,
        k.a2))));
    vectors_put(g, 0, vectors_plus(v, kernel_turn(p.a0, p.a1, p.a2, p.a3, v.a0, v.a1, v.a2)));
    return (t_ir){0, reach};
}

INLINE void loop_advance_all(r2 momenta, r2 verticals, r2 tensors, r1 contacts, r2 q, i1 status, d1 reach) {
    ALIGNED real state_[27]; memset(state_, 0, sizeof state_); r1 state = {state_, 27};
    for (int64_t i = 0, end_i = momenta.n0; i < end_i; i++) {
        t_ir t_1 = loop_advance(r2_row(momenta, i), r2_row(verticals, i), r2_row(tensors, i), contacts.p[i], state,
            r2_row(q, i));
        status.p[i] = t_1.a0; reach.p[i] = t_1.a1;
    }
}

INLINE int64_t block_registers(int64_t balls) {
    return div_i(balls + block_REGISTER - 1, block_REGISTER) * block_REGISTER;
}

INLINE void vectors_put_in(r2 S, int64_t at, int64_t i, t_r3 v) {
    AT2(S, at, i) = v.a0; AT2(S, at + 1, i) = v.a1; AT2(S, at + 2, i) = v.a2;
}

OUT_OF_LINE void block_enter(Start start, int64_t low, real factor, r2 S, r1 scale, w1 ok) {
    int64_t i; t_r3 m, tensor; t_ib exponent;
    for (int64_t lane = 0, end_lane = ok.n0; lane < end_lane; lane++) {
        i = low + min_i(lane, scale.n0 - 1); m = vectors_scaled(factor, vectors_three(r2_row(start.momentum, i), 0));
        tensor = vectors_three(r2_row(start.tensor, i), 0); exponent = loop_scaling(m, tensor, start.contact.p[i]);
        vectors_put_in(S, 0, lane, loop_times(m, -exponent.a0 - 1));
        vectors_put_in(S, 3, lane, vectors_three(r2_row(start.gamma, i), 0));
        vectors_put_in(S, 18, lane, loop_times(tensor, -exponent.a0));
        t_r3 t_1 = loop_times((t_r3){start.contact.p[i], R(0.0), R(0.0)}, -exponent.a0); AT2(S, 24, lane) = t_1.a0;
        AT2(S, 25, lane) = exponent.a1 ? R(1.0) : R(0.0); scale.p[i - low] = R(ldexp(R(1.0), (int)(exponent.a0 + 1)));
    }
}

INLINE int64_t block_whole(w1 ok) { return div_i(ok.n0, block_REGISTER) * block_REGISTER; }
INLINE t_r3 vectors_three_in(r2 S, int64_t at, int64_t i) {
    return (t_r3){AT2(S, at, i), AT2(S, at + 1, i), AT2(S, at + 2, i)};
}

INLINE void block_limited(r2 S, r1 radius, r1 enough, w1 ok) {
    t_r3 inertia;
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        inertia = branch_moments(vectors_three_in(S, 18, i)); vectors_put_in(S, 21, i, inertia);
        t_r2 t_1 = loop_limits(vectors_three_in(S, 0, i), inertia, AT2(S, 24, i), AT2(S, 25, i) != R(0.0));
        radius.p[i] = t_1.a0; enough.p[i] = t_1.a1;
    }
}

INLINE void vectors_put_four_in(r2 S, int64_t at, int64_t i, t_r4 q) {
    AT2(S, at, i) = q.a0; AT2(S, at + 1, i) = q.a1; AT2(S, at + 2, i) = q.a2; AT2(S, at + 3, i) = q.a3;
}

INLINE void block_remembered(r2 S, w1 ok) {
    t__r2_3 one;
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        vectors_put_in(S, 6, i, (t_r3){R(0.0), R(0.0), R(0.0)});
        vectors_put_in(S, 9, i, (t_r3){R(0.0), R(0.0), R(0.0)});
        one = integrals_integrals(vectors_three_in(S, 0, i), vectors_three_in(S, 3, i));
        vectors_put_four_in(S, 12, i, (t_r4){one.a0.a0, one.a0.a1, one.a1.a0, one.a1.a1}); t_r2 t_1 = one.a2;
        AT2(S, 16, i) = t_1.a0; AT2(S, 17, i) = t_1.a1;
    }
}

INLINE void block_prepare_block(Start start, int64_t low, r1 c, Block block, w1 ok) {
    r2 S = block.state;
    for (int64_t s = 0, end_s = c.n0; s < end_s; s++) {
        block_enter(start, low, c.p[s], S, block.scale, ok);
        block_limited(S, r2_row(block.radius, s), r2_row(block.enough, s), ok);
    }
    if (c.n0 > 1) { block_enter(start, low, R(1.0), S, block.scale, ok); }
    block_limited(S, r2_row(S, 25), r2_row(S, 26), ok); block_remembered(S, ok); r2_fill(block.past, R(0.0));
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

INLINE void block_begin_stage(r2 S, r2 T, real s, r1 radius, r1 enough, w1 ok) {
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        vectors_put_in(T, 0, i, vectors_scaled(s, vectors_three_in(S, 0, i)));
        vectors_put_in(T, 3, i, vectors_three_in(S, 3, i)); AT2(T, 25, i) = radius.p[i]; AT2(T, 26, i) = enough.p[i];
    }
}

INLINE void block_guessed(r2 P, r2 past, int64_t at, int64_t places, r1 weights, w1 ok) {
    real a, b, c, d; int64_t w, x, y, z; t_r3 u;
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        vectors_put_in(P, 9, i, (t_r3){R(0.0), R(0.0), R(0.0)});
    }
    for (int64_t j = 0, end_j = weights.n0; j < end_j; j += 4) {
        a = weights.p[j]; b = weights.p[j + 1]; c = weights.p[j + 2]; d = weights.p[j + 3];
        w = 3 * mod_i(at + j, places); x = 3 * mod_i(at + j + 1, places); y = 3 * mod_i(at + j + 2, places);
        z = 3 * mod_i(at + j + 3, places);
        INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
            u = vectors_plus(vectors_three_in(P, 9, i), vectors_scaled(a, vectors_three_in(past, w, i)));
            u = vectors_plus(u, vectors_scaled(b, vectors_three_in(past, x, i)));
            u = vectors_plus(u, vectors_scaled(c, vectors_three_in(past, y, i)));
            vectors_put_in(P, 9, i, vectors_plus(u, vectors_scaled(d, vectors_three_in(past, z, i))));
        }
    }
}

INLINE t__r3_3r block_body_in(r2 S, int64_t i) {
    return (t__r3_3r){vectors_three_in(S, 0, i), vectors_three_in(S, 3, i), vectors_three_in(S, 21, i), AT2(S, 24,
        i)};
}

INLINE int64_t block_unsettled(w1 ok) {
    int64_t bad = 0;
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) { bad = bad + (1 - ok.p[i]); }
    return bad;
}

INLINE int64_t block_predicted(r2 S, r2 P, w1 ok) {
    t_r3 u; Round r;
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        u = vectors_three_in(P, 9, i); t__r3_3r t_1 = block_body_in(S, i);
        r = gibbs_newton_round(u, t_1.a0, t_1.a1, t_1.a2, t_1.a3, 0); vectors_put_four_in(P, 0, i, r.p);
        vectors_put_in(P, 4, i, r.w);
        ok.p[i] = ((vectors_square(u) <= AT2(S, 25, i)) & (r.first <= AT2(S, 26, i))) ? 1 : 0;
    }
    return block_unsettled(ok);
}

INLINE t_r4 vectors_four_in(r2 S, int64_t at, int64_t i) {
    return (t_r4){AT2(S, at, i), AT2(S, at + 1, i), AT2(S, at + 2, i), AT2(S, at + 3, i)};
}

INLINE int64_t block_corrected(r2 S, r2 P, w1 ok, int again) {
    real radius, enough, second; t_r3 u, v, w; int near, once, twice, done; t__r3_3r k; Round r; t_r4 p;
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        radius = AT2(S, 25, i); enough = AT2(S, 26, i);
        t_r3 t_1 = vectors_three_in(P, 4, i), t_2 = vectors_three_in(P, 9, i);
        u = (t_r3){again ? t_1.a0 : t_2.a0, again ? t_1.a1 : t_2.a1, again ? t_1.a2 : t_2.a2};
        near = vectors_square(u) <= radius;
        if (again) {
            t_r3 t_3 = (t_r3){R(0.0), R(0.0), R(0.0)};
            u = (t_r3){near ? u.a0 : t_3.a0, near ? u.a1 : t_3.a1, near ? u.a2 : t_3.a2}; near = radius >= R(0.0);
        }
        k = block_body_in(S, i); r = gibbs_newton_round(u, k.a0, k.a1, k.a2, k.a3, 0);
        t__r4__r3_r t_4 = gibbs_second_round(r, k.a0, k.a2); p = t_4.a0; v = t_4.a1; second = t_4.a2;
        once = near & (r.first <= enough); twice = near & (vectors_square(v) <= radius);
        twice = twice & (R(9.0) * max_r(r.first, second) * second <= enough * enough); done = again & (ok.p[i] == 1);
        p = (t_r4){once ? r.p.a0 : p.a0, once ? r.p.a1 : p.a1, once ? r.p.a2 : p.a2, once ? r.p.a3 : p.a3};
        w = (t_r3){once ? r.w.a0 : v.a0, once ? r.w.a1 : v.a1, once ? r.w.a2 : v.a2};
        w = (t_r3){near ? w.a0 : u.a0, near ? w.a1 : u.a1, near ? w.a2 : u.a2}; t_r4 t_5 = vectors_four_in(P, 0, i);
        vectors_put_four_in(P, 0, i, (t_r4){done ? t_5.a0 : p.a0, done ? t_5.a1 : p.a1, done ? t_5.a2 : p.a2, done ?
            t_5.a3 : p.a3});
        t_r3 t_6 = vectors_three_in(P, 4, i);
        vectors_put_in(P, 4, i, (t_r3){done ? t_6.a0 : w.a0, done ? t_6.a1 : w.a1, done ? t_6.a2 : w.a2});
        ok.p[i] = ((done | once) | twice) ? 1 : 0;
    }
    return block_unsettled(ok);
}

INLINE void block_approached(r2 S, r2 P, w1 ok) {
    int beyond; Round r;
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        beyond = AT2(S, 25, i) == R(-2.0); t__r3_3r t_1 = block_body_in(S, i);
        r = gibbs_newton_round(vectors_three_in(P, 9, i), t_1.a0, t_1.a1, t_1.a2, t_1.a3, 0);
        t_r3 t_2 = vectors_three_in(P, 4, i);
        vectors_put_in(P, 4, i, (t_r3){beyond ? r.w.a0 : t_2.a0, beyond ? r.w.a1 : t_2.a1, beyond ? r.w.a2 : t_2.a2});
        AT2(P, 7, i) = beyond ? R(1.0) : R(0.0); ok.p[i] = beyond ? 0 : ok.p[i];
    }
}

INLINE real block_nearer(r2 S, r2 P, w1 ok) {
    int going, near, found; t_r4 p; t_r3 w; real left;
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        going = AT2(P, 7, i) == R(1.0); t__r3_3r t_1 = block_body_in(S, i);
        t__r4__r3_rb2 t_2 = path_improved(vectors_three_in(P, 4, i), t_1.a0, t_1.a1, t_1.a2, t_1.a3); p = t_2.a0;
        w = t_2.a1; left = t_2.a2; near = t_2.a3; found = t_2.a4; t_r4 t_3 = vectors_four_in(P, 0, i);
        vectors_put_four_in(P, 0, i, (t_r4){going ? p.a0 : t_3.a0, going ? p.a1 : t_3.a1, going ? p.a2 : t_3.a2, going
            ? p.a3 : t_3.a3});
        t_r3 t_4 = vectors_three_in(P, 4, i);
        vectors_put_in(P, 4, i, (t_r3){going ? w.a0 : t_4.a0, going ? w.a1 : t_4.a1, going ? w.a2 : t_4.a2});
        real t_5 = (near | found) ? R(0.0) : AT2(P, 7, i), t_6 = going ? left : AT2(P, 8, i); AT2(P, 7, i) = t_5;
        AT2(P, 8, i) = t_6;
    }
    left = R(0.0);
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) { left = left + AT2(P, 7, i); }
    return left;
}

INLINE int64_t block_on_path(r2 S, r2 P, w1 ok) {
    int settled;
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        t__r3_3r t_1 = block_body_in(S, i);
        settled = path_proved(vectors_three_in(P, 4, i), AT2(P, 8, i), t_1.a0, t_1.a1, t_1.a2, t_1.a3);
        ok.p[i] = (((AT2(S, 25, i) == R(-2.0)) & (AT2(P, 7, i) == R(0.0))) & settled) ? 1 : ok.p[i];
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

OUT_OF_LINE void block_mend(r2 S, r2 P, w1 ok, int64_t step, Ends ends) {
    t_r3 k, g, inertia, w; t_b_r4__r3_ u; t_r4 p;
    for (int64_t i = 0, end_i = ok.n0; i < end_i; i++) {
        if (ok.p[i] == 1) { continue; }
        if (i < ends.status.n0 && ends.status.p[i] == 0) {
            real one_[S.n0]; r1 one = {one_, S.n0};
            for (int64_t i_ = 0; i_ < S.n0; i_++) { one_[i_] = AT2(S, i_, i); }
            k = vectors_three(one, 0); g = vectors_three(one, 3); inertia = vectors_three(one, 21);
            u = gibbs_settle(vectors_three_in(P, 9, i), k, g, inertia, one.p[24], one.p[25], one.p[26], 0);
            t_ir_r4__r3_ t_1 = loop_safe_rotation(u.a2, one); ends.status.p[i] = t_1.a0; ends.reach.p[i] = t_1.a1;
            p = t_1.a2; w = t_1.a3;
            if (ends.status.p[i] == 0) { vectors_put_four_in(P, 0, i, p); vectors_put_in(P, 4, i, w); continue; }
            ends.taken.p[i] = step;
        }
        AT2(S, 25, i) = R(-1.0); vectors_put_four_in(P, 0, i, (t_r4){R(1.0), R(0.0), R(0.0), R(0.0)});
        vectors_put_in(P, 4, i, (t_r3){R(0.0), R(0.0), R(0.0)});
    }
}

INLINE void block_stop(r2 S, r2 T, r2 radius, i1 status, w1 ok) {
    for (int64_t i = 0, end_i = ok.n0; i < end_i; i++) {
        if ((i >= status.n0 || status.p[i] != 0) && ok.p[i] == 0 && AT2(radius, 0, i) != R(-3.0)) {
            for (int64_t stage = 0, end_stage = radius.n0; stage < end_stage; stage++) {
                AT2(radius, stage, i) = R(-3.0);
            }
            vectors_put_in(S, 0, i, vectors_three_in(T, 0, i));
        }
    }
}

INLINE void block_rolled(r2 S, r2 P, r2 B, w1 ok) {
    t__r4_r2 a;
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        a = loop_followed(vectors_four_in(P, 0, i), vectors_three_in(S, 3, i), vectors_four_in(B, 0, i), AT2(B, 4, i),
            AT2(B, 5, i), AT2(B, 6, i));
        vectors_put_four_in(B, 0, i, a.a0); AT2(B, 4, i) = a.a1; AT2(B, 5, i) = a.a2;
    }
}

INLINE void block_turn_in(t_r4 p, r2 S, int64_t at, int64_t rest, int64_t i) {
    t__r3_2 v = integrals_turned(p, vectors_three_in(S, at, i), vectors_three_in(S, rest, i));
    vectors_put_in(S, at, i, v.a0); vectors_put_in(S, rest, i, v.a1);
}

INLINE void block_end_stage(r2 S, r2 P, r2 past, int64_t row, w1 ok) {
    t_r4 p;
    INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
        p = vectors_four_in(P, 0, i); block_turn_in(p, S, 0, 6, i); block_turn_in(p, S, 3, 9, i);
        vectors_put_in(past, row, i, vectors_three_in(P, 4, i));
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

INLINE void block_keep(Block block, int64_t low, int64_t frame, Frames frames, i1 status) {
    r2 S = block.state, B = block.body;
    for (int64_t i = 0, end_i = status.n0; i < end_i; i++) {
        if (status.p[i] == 0) {
            vectors_put(r2_row(r3_row(frames.momenta, low + i), frame), 0, vectors_scaled(block.scale.p[i],
                vectors_three_in(S, 0, i)));
            vectors_put(r2_row(r3_row(frames.verticals, low + i), frame), 0, vectors_three_in(S, 3, i));
            if (frames.follows) {
                vectors_put_four(r2_row(r3_row(frames.attitudes, low + i), frame), 0, vectors_four_in(B, 0, i));
                AT3(frames.traces, low + i, frame, 0) = AT2(B, 4, i);
                AT3(frames.traces, low + i, frame, 1) = AT2(B, 5, i);
            }
        }
    }
}

INLINE void block_march_block(Block block, int64_t low, Stages stages, Steps steps, Frames frames, Ends ends, w1 ok) {
    int64_t at, later, bad; r2 S = block.state, H = block.past, radius = block.radius, enough = block.enough;
    ALIGNED real other_[27 * block_LANES]; r2 other = {other_, 27, block_LANES, block_LANES};
    ALIGNED real P_[12 * block_LANES]; r2 P = {P_, 12, block_LANES, block_LANES}; r1 c = stages.c;
    r3 weights = stages.weights; i1 status = ends.status;
    int64_t count = c.n0, places = weights.n1, period = max_i(1, div_i(1024, count));
    ALIGNED int64_t hopeless_[count]; i1 hopeless = {hopeless_, count}; ALIGNED int64_t beyond_[count];
    i1 beyond = {beyond_, count};
    if (count > 1) { block_carry(S, other, ok.n0); }
    r2 T = count == 1 ? S : other; int64_t patience = 0;
    for (int64_t s = 0, end_s = count; s < end_s; s++) {
        t_i2 t_1 = block_uncertified(r2_row(radius, s), ok); hopeless.p[s] = t_1.a0; beyond.p[s] = t_1.a1;
    }
    for (int64_t step = steps.first, end_step = steps.last; step < end_step; step++) {
        at = mod_i(step * count, places); later = step * count >= places ? 1 : 0;
        for (int64_t s = 0, end_s = count; s < end_s; s++) {
            if (count > 1) { block_begin_stage(S, T, c.p[s], r2_row(radius, s), r2_row(enough, s), ok); }
            block_guessed(P, H, at + s, places, r2_row(r3_row(weights, later), at + s), ok);
            t_i2 t_2 = block_solved(T, P, ok, hopeless.p[s], beyond.p[s], patience); patience = t_2.a0; bad = t_2.a1;
            if (bad != 0) {
                block_mend(T, P, ok, step, ends); block_stop(S, T, radius, status, ok);
                for (int64_t n = 0, end_n = count; n < end_n; n++) {
                    t_i2 t_3 = block_uncertified(r2_row(radius, n), ok); hopeless.p[n] = t_3.a0; beyond.p[n] = t_3.a1;
                }
            }
            if (frames.follows) { block_rolled(T, P, block.body, ok); }
            block_end_stage(S, P, H, 3 * (at + s), ok);
        }
        if (mod_i(step + 1, period) == 0) { block_restored(S, status); }
        if (mod_i(step + 1, steps.every) == 0) {
            block_keep(block, low, div_i(step + 1, steps.every), frames, status);
        }
    }
    for (int64_t i = 0, end_i = status.n0; i < end_i; i++) {
        if (status.p[i] == 0) { ends.taken.p[i] = steps.last; }
    }
}

INLINE void block_march_blocks(Block kept, Stages stages, Steps steps, Start start, r1 rho, Frames frames, Ends ends,
    r2 ended) {
    int64_t high, i; w1 ok; Block block; Ends outcome; ALIGNED real S_[27 * block_LANES];
    r2 S = {S_, 27, block_LANES, block_LANES}; ALIGNED real B_[7 * block_LANES];
    r2 B = {B_, 7, block_LANES, block_LANES}; ALIGNED real H_[kept.past.n0 * block_LANES];
    r2 H = {H_, kept.past.n0, block_LANES, block_LANES}; int64_t width = kept.state.n1, n = rho.n0;
    ALIGNED int32_t all_lanes_[width]; w1 all_lanes = {all_lanes_, width};
    for (int64_t low = 0, end_low = n; low < end_low; low += width) {
        high = min_i(low + width, n); ok = w1_part(all_lanes, 0, block_registers(high - low));
        block = (Block){S, kept.radius, kept.enough, H, B, r1_part(kept.scale, low, high)};
        outcome = (Ends){i1_part(ends.taken, low, high), i1_part(ends.status, low, high), d1_part(ends.reach, low,
            high)};
        if (steps.first == 0) {
            block_prepare_block(start, low, stages.c, block, ok);
            if (frames.follows) {
                for (int64_t lane = 0, end_lane = ok.n0; lane < end_lane; lane++) {
                    i = min_i(low + lane, n - 1);
                    vectors_put_four_in(B, 0, lane, vectors_four(r2_row(r3_row(frames.attitudes, i), 0), 0));
                    AT2(B, 4, lane) = R(0.0); AT2(B, 5, lane) = R(0.0); AT2(B, 6, lane) = rho.p[i];
                }
            }
        }
        else {
            block_carry(kept.state, S, width); block_carry(kept.body, B, width); block_carry(kept.past, H, width);
        }
        block_march_block(block, low, stages, steps, frames, outcome, ok);
        for (int64_t i = 0, end_i = high - low; i < end_i; i++) {
            if (outcome.status.p[i] != 0) {
                vectors_put(r2_row(ended, low + i), 0, vectors_scaled(block.scale.p[i], vectors_three_in(S, 0, i)));
                vectors_put(r2_row(ended, low + i), 3, vectors_three_in(S, 3, i));
            }
        }
    }
    if (n <= width) {
        block_carry(S, kept.state, width); block_carry(H, kept.past, width);
        if (frames.follows) { block_carry(B, kept.body, width); }
    }
}

INLINE void block_advance_blocks(r2 momenta, r2 verticals, r2 tensors, r1 contacts, r2 q, i1 status, d1 reach) {
    int64_t high; w1 ok; t_i2 hopeless, bad; Ends ends; t_r4 p; t_r3 k, g; ALIGNED real S_[27 * block_LANES];
    r2 S = {S_, 27, block_LANES, block_LANES}; ALIGNED real P_[12 * block_LANES];
    r2 P = {P_, 12, block_LANES, block_LANES}; ALIGNED real scale_[block_LANES]; r1 scale = {scale_, block_LANES};
    ALIGNED int32_t all_lanes_[block_LANES]; w1 all_lanes = {all_lanes_, block_LANES};
    ALIGNED int64_t taken_[block_LANES]; memset(taken_, 0, sizeof taken_); i1 taken = {taken_, block_LANES};
    int64_t n = contacts.n0; Start start = (Start){momenta, verticals, tensors, contacts};
    for (int64_t low = 0, end_low = n; low < end_low; low += block_LANES) {
        high = min_i(low + block_LANES, n); ok = w1_part(all_lanes, 0, block_registers(high - low));
        block_enter(start, low, R(1.0), S, r1_part(scale, 0, high - low), ok);
        block_limited(S, r2_row(S, 25), r2_row(S, 26), ok);
        INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
            vectors_put_in(P, 9, i, (t_r3){R(0.0), R(0.0), R(0.0)});
        }
        hopeless = block_uncertified(r2_row(S, 25), ok); bad = block_solved(S, P, ok, hopeless.a0, hopeless.a1, 64);
        if (bad.a1 != 0) {
            ends = (Ends){taken, i1_part(status, low, high), d1_part(reach, low, high)};
            block_mend(S, P, ok, 0, ends);
        }
        INDEPENDENT for (int64_t i = 0, end_i = block_whole(ok); i < end_i; i++) {
            p = vectors_four_in(P, 0, i); k = vectors_three_in(S, 0, i); g = vectors_three_in(S, 3, i);
            vectors_put_in(S, 0, i, vectors_plus(k, kernel_turn(p.a0, p.a1, p.a2, p.a3, k.a0, k.a1, k.a2)));
            vectors_put_in(S, 3, i, vectors_plus(g, kernel_turn(p.a0, p.a1, p.a2, p.a3, g.a0, g.a1, g.a2)));
            vectors_put_four_in(P, 0, i, vectors_unit(p));
        }
        for (int64_t i = low, end_i = high; i < end_i; i++) {
            if (status.p[i] == 0) {
                vectors_put(r2_row(momenta, i), 0, vectors_scaled(scale.p[i - low], vectors_three_in(S, 0, i - low)));
                vectors_put(r2_row(verticals, i), 0, vectors_three_in(S, 3, i - low));
                vectors_put_four(r2_row(q, i), 0, vectors_four_in(P, 0, i - low));
            }
        }
    }
}

#ifndef SINGLE
INLINE void lanes_placed(r1 body, int64_t i, Frames frames) {
    r1_fill(body, R(0.0)); vectors_put(body, 0, vectors_three(r2_row(r3_row(frames.momenta, i), 0), 0));
    vectors_put(body, 3, vectors_three(r2_row(r3_row(frames.verticals, i), 0), 0)); body.p[6] = R(1.0);
    if (frames.follows) { vectors_put_four(body, 6, vectors_four(r2_row(r3_row(frames.attitudes, i), 0), 0)); }
    if (frames.traced) { body.p[10] = AT3(frames.traces, i, 0, 0); body.p[11] = AT3(frames.traces, i, 0, 1); }
}

INLINE t_ri lanes_begun(r1 body, r1 J0, real D0, real h, r1 state) {
    ALIGNED real none_[3]; memset(none_, 0, sizeof none_); r1 none = {none_, 3};
    t_ri size = real_frexp(loop_entered(none, none, J0, D0, state));
    t_ri exponent = real_frexp(vectors_largest(vectors_three(body, 0)));
    vectors_put(body, 0, vectors_shifted(vectors_three(body, 0), -exponent.a1));
    t_ri mantissa = real_frexp(R(0.5) * h);
    return (t_ri){R(ldexp(mantissa.a0, (int)min_i(mantissa.a1 + exponent.a1 - (size.a1 - 2), 100))), exponent.a1};
}

INLINE void lanes_put_back(r2 S, int64_t b, r1 body) {
    for (int64_t c = 0; c < 24; c++) { AT2(S, 105 + c, b) = body.p[c]; }
}

INLINE void lanes_entered(r2 S, int64_t at, int64_t i, r1 body, real half, int64_t n, r1 state) {
    real part = half / n; t_r3 inertia = vectors_three(state, 21); real contact = state.p[24];
    real spread = R(0.5) * (max_r(max_r(inertia.a0, inertia.a1), inertia.a2) - min_r(min_r(inertia.a0, inertia.a1),
        inertia.a2));
    t_r3 k = vectors_scaled(part, vectors_three(body, 0)); real size = vectors_length(k);
    t_r2 within = gibbs_bound(k, inertia, contact);
    real least = gibbs_LEFT * size / (max_r(max_r(inertia.a0, inertia.a1), inertia.a2) + contact + spread);
    int light = gibbs_is_heavy(inertia, contact) && !(min_r(min_r(inertia.a0, inertia.a1), inertia.a2) >=
        gibbs_LIGHTEST && size >= gibbs_LIGHTEST);
    AT2(S, at, i) = part; AT2(S, at + 1, i) = part != R(0.0) ? R(1.0) / part : R(0.0); AT2(S, at + 2, i) = size;
    AT2(S, 82, i) = spread;
    AT2(S, at + 3, i) = light ? R(-1.0) : (within.a0 >= R(0.0) ? within.a0 : R(1.0715086071862673e+301));
    AT2(S, at + 4, i) = least * least / R(18.2); AT2(S, at + 5, i) = R(1.0) / (n * n);
}

INLINE void lanes_resized(r2 S, int64_t B, int64_t b, int64_t columns, real half, r1 body, r1 state) {
    AT2(S, 129, b) = half; int64_t least = 8 - columns;
    for (int64_t lane = 0; lane < 4; lane++) {
        lanes_entered(S, 59, lane * B + b, body, half, max_i(7 - lane, least), state);
        lanes_entered(S, 65, lane * B + b, body, half, max_i(lane, least), state);
    }
}

OUT_OF_LINE void lanes_enter(r2 S, int64_t B, int64_t b, real half, real radius, Weights weights, r1 body, r1 state) {
    int64_t j, first; int one, two; lanes_put_back(S, b, body); AT2(S, 129, b) = half; AT2(S, 130, b) = radius;
    AT2(S, 134, b) = state.p[24]; AT2(S, 135, b) = R(0.0); vectors_put_in(S, 131, b, vectors_three(state, 18));
    int64_t columns = weights.sums.n1, least = 8 - columns;
    for (int64_t lane = 0; lane < 4; lane++) {
        j = lane * B + b; first = max_i(7 - lane, least); vectors_put_in(S, 27, j, vectors_three(state, 21));
        AT2(S, 30, j) = state.p[24];
        AT2(S, 139, j) = gibbs_is_heavy(vectors_three(state, 21), state.p[24]) ? R(1.0) : R(0.0);
        one = 7 - lane >= least; two = lane >= least;
        for (int64_t c = 0; c < 3; c++) { AT2(S, 79 + c, j) = AT2(weights.beginning, first, c); }
        for (int64_t c = 0; c < 4; c++) {
            AT2(S, 71 + 2 * c, j) = one ? AT2(weights.sums, c, first - least) : R(0.0);
            AT2(S, 71 + 2 * c + 1, j) = two ? AT2(weights.sums, c, lane - least) : R(0.0);
        }
    }
    lanes_resized(S, B, b, columns, half, body, state);
}

INLINE t_r3 kernel_angular_velocity(real K1, real K2, real K3, real g1, real g2, real g3, real J1, real J2, real J3,
    real D) {
    real t0 = J2 + J3, t1 = R(1) / (D + t0), t2 = J1 + J3, t3 = R(1) / (D + t2), t4 = J1 + J2, t5 = R(1) / (D + t4);
    real t6 = D * (K1 * g1 * t1 + K2 * g2 * t3 + K3 * g3 * t5) / (g1 * g1 * t0 * t1 + g2 * g2 * t2 * t3 + g3 * g3 * t4
        * t5);
    real o_w1 = t1 * (K1 + g1 * t6), o_w2 = t3 * (K2 + g2 * t6), o_w3 = t5 * (K3 + g3 * t6);
    return (t_r3){o_w1, o_w2, o_w3};
}

INLINE t_r3 vectors_cross(t_r3 a, t_r3 b) {
    return (t_r3){a.a1 * b.a2 - a.a2 * b.a1, a.a2 * b.a0 - a.a0 * b.a2, a.a0 * b.a1 - a.a1 * b.a0};
}

INLINE real lanes_turn_square(real h, int64_t first, t_r3 w) {
    real turned = h * h * vectors_square(w); return turned <= R(2.25) * (first * first) ? turned : R(0.0);
}

INLINE void lanes_rates(r2 S, int64_t B, int64_t first) {
    t_r3 K, g, J, w, m, a, d, n, x; real contact, whole, one;
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        K = vectors_three_in(S, 105, b); g = vectors_three_in(S, 108, b); J = vectors_three_in(S, 131, b);
        contact = AT2(S, 134, b);
        w = kernel_angular_velocity(K.a0, K.a1, K.a2, g.a0, g.a1, g.a2, J.a0, J.a1, J.a2, contact);
        m = vectors_plus(K, vectors_scaled(contact * vectors_dot(g, w), g)); t_r3 t_1 = vectors_cross(m, w);
        a = kernel_angular_velocity(t_1.a0, t_1.a1, t_1.a2, g.a0, g.a1, g.a2, J.a0, J.a1, J.a2, contact);
        d = vectors_cross(g, w);
        n = (t_r3){(AT2(S, 27, b) + contact) * a.a0, (AT2(S, 28, b) + contact) * a.a1, (AT2(S, 29, b) + contact) *
            a.a2};
        x = vectors_plus(vectors_scaled(contact * vectors_dot(d, a), g), vectors_scaled(contact * vectors_dot(g, a),
            d));
        t_r3 t_2 = vectors_plus(vectors_plus(vectors_cross(n, w), vectors_cross(m, a)), x);
        x = kernel_angular_velocity(t_2.a0, t_2.a1, t_2.a2, g.a0, g.a1, g.a2, J.a0, J.a1, J.a2, contact);
        whole = R(2.0) * AT2(S, 129, b); vectors_put_in(S, 31, b, K); vectors_put_in(S, 34, b, g);
        vectors_put_in(S, 37, b, w); vectors_put_in(S, 40, b, vectors_scaled(whole, a));
        vectors_put_in(S, 43, b, vectors_scaled(whole * whole, x));
        AT2(S, 46, b) = lanes_turn_square(whole, first, w); vectors_put_in(S, 136, b, (t_r3){R(0.0), R(0.0), R(0.0)});
        AT2(S, 58, b) = AT2(S, 135, b);
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

INLINE real lanes_fitted(real square) {
    real fourth = square * square;
    real last = R(2.7557319223985893e-06) - square * R(2.505210838544172e-08) + fourth * R(1.6059043836821613e-10);
    return R(1.0) - square * R(0.16666666666666666) + fourth * (R(0.008333333333333333) - square *
        R(0.0001984126984126984)) + fourth * fourth * last;
}

INLINE real lanes_half_angle(real square) {
    real fourth = square * square;
    return R(1.0) - square * R(0.25) + fourth * (R(0.020833333333333332) - square * R(0.0006944444444444445) + fourth
        * R(1.240079365079365e-05));
}

INLINE void lanes_start(r2 S, int64_t i, int64_t at) {
    real scale = lanes_fitted(AT2(S, 46, i) * AT2(S, at + 5, i)), half = AT2(S, at, i) * scale;
    real slope = AT2(S, 82, i) + AT2(S, at + 2, i) * scale;
    real bend = lanes_half_angle(AT2(S, 46, i) * AT2(S, at + 5, i)); AT2(S, 83, i) = half / bend;
    real t_1 = half, t_2 = AT2(S, at + 1, i) * bend / scale, t_3 = slope * slope; AT2(S, 22, i) = t_1;
    AT2(S, 23, i) = t_2; AT2(S, 24, i) = t_3; real t_4 = AT2(S, at + 3, i), t_5 = AT2(S, at + 4, i) * (scale * scale);
    AT2(S, 25, i) = t_4; AT2(S, 26, i) = t_5;
    vectors_put_in(S, 0, i, vectors_scaled(half, vectors_three_in(S, 31, i)));
    vectors_put_in(S, 3, i, vectors_three_in(S, 34, i)); vectors_put_in(S, 9, i, (t_r3){R(0.0), R(0.0), R(0.0)});
    vectors_put_in(S, 12, i, (t_r3){R(0.0), R(0.0), R(0.0)});
    vectors_put_four_in(S, 15, i, (t_r4){R(1.0), R(0.0), R(0.0), R(0.0)});
    vectors_put_in(S, 19, i, (t_r3){R(0.0), R(0.0), R(0.0)});
}

INLINE t_r3 lanes_expanded(r2 S, int64_t i, real a, real b, real c) {
    return vectors_plus(vectors_plus(vectors_scaled(a, vectors_three_in(S, 37, i)), vectors_scaled(b,
        vectors_three_in(S, 40, i))), vectors_scaled(c, vectors_three_in(S, 43, i)));
}

INLINE void lanes_begin(r2 S, int64_t B) {
    INDEPENDENT for (int64_t i = 0, end_i = 4 * B; i < end_i; i++) {
        lanes_start(S, i, 59); t_r3 t_1 = vectors_three_in(S, 79, i);
        vectors_put_in(S, 6, i, vectors_scaled(AT2(S, 83, i), lanes_expanded(S, i, t_1.a0, t_1.a1, t_1.a2)));
    }
}

INLINE void lanes_finish(r2 S, int64_t i) {
    vectors_put_four_in(S, 87, i, vectors_four_in(S, 15, i)); vectors_put_in(S, 91, i, vectors_three_in(S, 19, i));
}

INLINE void lanes_begin_second(r2 S, int64_t B, int64_t lane, r2 weights) {
    t_r3 omega, rate, curve, first, second, later, third, fourth, x, y;
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) { lanes_start(S, lane * B + b, 65); }
    t_r4 w0 = vectors_four(r2_row(weights, lane), 0), w4 = vectors_four(r2_row(weights, lane), 4);
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        omega = vectors_three_in(S, 37, b); rate = vectors_three_in(S, 40, b); curve = vectors_three_in(S, 43, b);
        first = vectors_three_in(S, 84, b); second = vectors_three_in(S, 84, B + b);
        later = vectors_three_in(S, 136, b); third = vectors_three_in(S, 84, 2 * B + b);
        fourth = vectors_three_in(S, 84, 3 * B + b);
        x = vectors_plus(vectors_plus(vectors_scaled(w0.a0, omega), vectors_scaled(w0.a1, rate)),
            vectors_plus(vectors_scaled(w0.a2, curve), vectors_scaled(w0.a3, first)));
        y = vectors_plus(vectors_plus(vectors_scaled(w4.a0, second), vectors_scaled(w4.a1, third)),
            vectors_plus(vectors_scaled(w4.a2, fourth), vectors_scaled(w4.a3, later)));
        vectors_put_in(S, 6, lane * B + b, vectors_scaled(AT2(S, 83, lane * B + b), vectors_plus(x, y)));
    }
}

INLINE Round lanes_iterate(t_r3 u, t_r3 k, t_r3 g, t_r3 I, real D, int heavy, int one_is_heavy) {
    t_r13 stable;
    t_r13 found = kernel_gibbs_newton(u.a0, u.a1, u.a2, k.a0, k.a1, k.a2, g.a0, g.a1, g.a2, I.a0, I.a1, I.a2, D);
    real det = found.a0;
    if (one_is_heavy) {
        stable = kernel_gibbs_newton_heavy(u.a0, u.a1, u.a2, k.a0, k.a1, k.a2, g.a0, g.a1, g.a2, I.a0, I.a1, I.a2, D);
        det = heavy ? stable.a0 : det;
    }
    t_r12 t_1 = (t_r12){found.a1, found.a2, found.a3, found.a4, found.a5, found.a6, found.a7, found.a8, found.a9,
        found.a10, found.a11, found.a12};
    return gibbs_round_from(u, (t_r13){det, t_1.a0, t_1.a1, t_1.a2, t_1.a3, t_1.a4, t_1.a5, t_1.a6, t_1.a7, t_1.a8,
        t_1.a9, t_1.a10, t_1.a11});
}

INLINE int64_t lanes_checked(r2 S, int64_t B, int again, int one_is_heavy) {
    t_r3 u, k, g, inertia; real contact, squares, p0, first, bent; int heavy, settled, closed; Round r; t__r4__r3_r p;
    t_r9 c;
    INDEPENDENT for (int64_t i = 0, end_i = 4 * B; i < end_i; i++) {
        u = vectors_three_in(S, 6, i); k = vectors_three_in(S, 0, i); g = vectors_three_in(S, 3, i);
        inertia = vectors_three_in(S, 27, i); contact = AT2(S, 30, i); heavy = AT2(S, 139, i) != R(0.0);
        if (!again) { r = lanes_iterate(u, k, g, inertia, contact, heavy, one_is_heavy); u = r.w; }
        r = lanes_iterate(u, k, g, inertia, contact, heavy, one_is_heavy); p = gibbs_second_round(r, k, inertia);
        c = r.cofactors;
        squares = vectors_dot((t_r3){c.a0, c.a1, c.a2}, (t_r3){c.a0, c.a1, c.a2}) + vectors_dot((t_r3){c.a3, c.a4,
            c.a5}, (t_r3){c.a3, c.a4, c.a5});
        p0 = p.a0.a0; first = r.first;
        bent = AT2(S, 24, i) * (squares + vectors_dot((t_r3){c.a6, c.a7, c.a8}, (t_r3){c.a6, c.a7, c.a8}));
        settled = (p0 > R(0.0)) & (vectors_square(p.a1) <= AT2(S, 25, i));
        settled = settled & (bent * first <= R(0.015625) * (p0 * p0));
        settled = settled & (bent * (max_r(first, p.a2) * p.a2) <= AT2(S, 26, i) * (p0 * p0));
        closed = again & (AT2(S, 57, i) == R(0.0)); t_r4 t_1 = vectors_four_in(S, 53, i);
        vectors_put_four_in(S, 53, i, (t_r4){closed ? t_1.a0 : p.a0.a0, closed ? t_1.a1 : p.a0.a1, closed ? t_1.a2 :
            p.a0.a2, closed ? t_1.a3 : p.a0.a3});
        t_r3 t_2 = vectors_three_in(S, 6, i);
        vectors_put_in(S, 6, i, (t_r3){closed ? t_2.a0 : p.a1.a0, closed ? t_2.a1 : p.a1.a1, closed ? t_2.a2 :
            p.a1.a2});
        AT2(S, 57, i) = ((closed | settled) | (AT2(S, 58, i) != R(0.0))) ? R(0.0) : R(1.0);
    }
    int64_t left = 0;
    INDEPENDENT for (int64_t i = 0, end_i = 4 * B; i < end_i; i++) {
        left = left + (AT2(S, 57, i) != R(0.0) ? 1 : 0);
    }
    return left;
}

INLINE int64_t lanes_looked_for(r2 S, int64_t B, int again, int one_is_heavy) {
    if (one_is_heavy) { return lanes_checked(S, B, again, 1); }
    return lanes_checked(S, B, again, 0);
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

INLINE t_r4 vectors_conjugate(t_r4 q) { return (t_r4){q.a0, -q.a1, -q.a2, -q.a3}; }
INLINE void lanes_moved(r2 S, int64_t B, int traced) {
    t_r4 p, q; t_r3 w, k, g, s, v, x, d, a, y;
    INDEPENDENT for (int64_t i = 0, end_i = 4 * B; i < end_i; i++) {
        p = vectors_four_in(S, 53, i); q = vectors_four_in(S, 15, i); w = vectors_three_in(S, 6, i);
        k = vectors_three_in(S, 0, i); g = vectors_three_in(S, 3, i);
        if (traced) {
            s = vectors_scaled(R(1.0) / (R(1.0) + vectors_square(w)), kernel_centre_step(R(1.0), w.a0, w.a1, w.a2,
                g.a0, g.a1, g.a2));
            t_r4 t_1 = vectors_conjugate(q);
            vectors_put_in(S, 19, i, vectors_plus(vectors_three_in(S, 19, i), vectors_plus(s, kernel_turn(t_1.a0,
                t_1.a1, t_1.a2, t_1.a3, s.a0, s.a1, s.a2))));
        }
        vectors_put_in(S, 0, i, vectors_plus(k, kernel_turn(p.a0, p.a1, p.a2, p.a3, k.a0, k.a1, k.a2)));
        vectors_put_in(S, 3, i, vectors_plus(g, kernel_turn(p.a0, p.a1, p.a2, p.a3, g.a0, g.a1, g.a2)));
        vectors_put_four_in(S, 15, i, kernel_compose(q.a0, q.a1, q.a2, q.a3, R(1.0), w.a0, w.a1, w.a2));
        v = vectors_three_in(S, 9, i); x = vectors_three_in(S, 12, i); vectors_put_in(S, 9, i, w);
        vectors_put_in(S, 12, i, v); d = vectors_three_in(S, 47, i); a = vectors_three_in(S, 50, i);
        y = vectors_scaled(AT2(S, 83, i), lanes_expanded(S, i, d.a0, d.a1, d.a2));
        vectors_put_in(S, 6, i, vectors_plus(vectors_plus(vectors_scaled(a.a0, w), vectors_scaled(a.a1, v)),
            vectors_plus(vectors_scaled(a.a2, x), y)));
    }
}

INLINE t_r4 vectors_plus_four(t_r4 a, t_r4 b) { return (t_r4){a.a0 + b.a0, a.a1 + b.a1, a.a2 + b.a2, a.a3 + b.a3}; }
INLINE t_r4 vectors_mixed(real w, t_r4 a, real v, t_r4 b) {
    return vectors_plus_four(vectors_scaled_four(w, a), vectors_scaled_four(v, b));
}

INLINE t__r3_2_r4_r2 lanes_moved_body(t_r3 k, t_r3 g, t_r4 a, real x, real y, t_r4 q, t_r3 s, real radius) {
    t_r3 d1 = kernel_rotate(a.a0, a.a1, a.a2, a.a3, s.a0, s.a1, s.a2);
    t_r4 b = kernel_compose(a.a0, a.a1, a.a2, a.a3, q.a0, q.a1, q.a2, q.a3);
    b = vectors_scaled_four(R(1.0) / R(sqrt(vectors_square_of_four(b))), b);
    return (t__r3_2_r4_r2){vectors_plus(k, kernel_turn(q.a0, q.a1, q.a2, q.a3, k.a0, k.a1, k.a2)), vectors_plus(g,
        kernel_turn(q.a0, q.a1, q.a2, q.a3, g.a0, g.a1, g.a2)), b, x + radius * d1.a0, y + radius * d1.a1};
}

INLINE void lanes_gather(r2 S, int64_t B) {
    t_r4 a, b, c; real one, two, w, v, x, y, more; int rests; t_r3 k, g, l, h;
    INDEPENDENT for (int64_t i = 0, end_i = 4 * B; i < end_i; i++) {
        a = vectors_four_in(S, 87, i); b = vectors_four_in(S, 15, i);
        one = R(1.0) / R(sqrt(vectors_square_of_four(a))); two = R(1.0) / R(sqrt(vectors_square_of_four(b)));
        w = AT2(S, 71, i); v = AT2(S, 72, i); vectors_put_four_in(S, 94, i, vectors_mixed(w * one, a, v * two, b));
        vectors_put_four_in(S, 98, i, vectors_mixed(AT2(S, 73, i) * one, a, AT2(S, 74, i) * two, b));
        vectors_put_in(S, 102, i, vectors_plus(vectors_scaled(w, vectors_three_in(S, 91, i)), vectors_scaled(v,
            vectors_three_in(S, 19, i))));
    }
    for (int64_t c = 0; c < 11; c++) {
        INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
            AT2(S, 94 + c, b) = AT2(S, 94 + c, b) + AT2(S, 94 + c, B + b) + (AT2(S, 94 + c, 2 * B + b) + AT2(S, 94 +
                c, 3 * B + b));
        }
    }
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        rests = AT2(S, 58, b) != R(0.0); k = vectors_three_in(S, 105, b); g = vectors_three_in(S, 108, b);
        a = vectors_four_in(S, 111, b); x = AT2(S, 115, b); y = AT2(S, 116, b);
        more = R(2.0) * R(sqrt(vectors_square_of_four(vectors_four_in(S, 98, b))));
        t__r3_2_r4_r2 t_1 = lanes_moved_body(k, g, a, x, y, vectors_four_in(S, 94, b), vectors_three_in(S, 102, b),
            AT2(S, 130, b));
        l = t_1.a0; h = t_1.a1; c = t_1.a2; v = t_1.a3; w = t_1.a4;
        vectors_put_in(S, 105, b, (t_r3){rests ? k.a0 : l.a0, rests ? k.a1 : l.a1, rests ? k.a2 : l.a2});
        vectors_put_in(S, 108, b, (t_r3){rests ? g.a0 : h.a0, rests ? g.a1 : h.a1, rests ? g.a2 : h.a2});
        vectors_put_four_in(S, 111, b, (t_r4){rests ? a.a0 : c.a0, rests ? a.a1 : c.a1, rests ? a.a2 : c.a2, rests ?
            a.a3 : c.a3});
        AT2(S, 115, b) = rests ? x : v; AT2(S, 116, b) = rests ? y : w;
        AT2(S, 117, b) = AT2(S, 117, b) + (rests ? R(0.0) : more);
    }
}

INLINE int lanes_side_by_side(r2 S, int64_t B, int traced, Weights weights) {
    int64_t lane, left, rounds, i; real weight; int64_t columns = weights.sums.n1, first = 8 - columns, second = 3;
    lanes_rates(S, B, first); lanes_begin(S, B); int lost = 0, one_is_heavy = 0;
    for (int64_t b = 0, end_b = B; b < end_b; b++) { one_is_heavy = one_is_heavy || AT2(S, 139, b) != R(0.0); }
    for (int64_t slot = 0; slot < 7; slot++) {
        lane = 7 - slot;
        if (lane < 4) {
            INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) { lanes_finish(S, lane * B + b); }
        }
        if (lane == 3 && first <= 3) { lanes_begin_second(S, B, 3, weights.beginning); }
        else {
            if (lane == 2 && first <= 2) { lanes_begin_second(S, B, 2, weights.beginning); }
        }
        for (int64_t j = 0; j < 6; j++) {
            for (int64_t c = 0; c < 4; c++) {
                weight = AT3(weights.following, slot, j, c);
                INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) { AT2(S, 47 + j, c * B + b) = weight; }
            }
        }
        left = lanes_looked_for(S, B, 0, one_is_heavy); rounds = 0;
        while (left > 0 && rounds < 6) { left = lanes_looked_for(S, B, 1, one_is_heavy); rounds = rounds + 1; }
        if (left > 0) {
            lost = 1; lanes_lose(S, B);
            if (B == 1) { return 1; }
        }
        if (traced) { lanes_moved(S, B, 1); }
        else { lanes_moved(S, B, 0); }
        if (slot == 0) {
            INDEPENDENT for (int64_t i = 0, end_i = 4 * B; i < end_i; i++) {
                vectors_put_in(S, 84, i, vectors_scaled(AT2(S, 23, i), vectors_three_in(S, 9, i)));
            }
        }
        else {
            if (lane == second && lane < 4) {
                INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
                    i = lane * B + b;
                    vectors_put_in(S, 136, b, vectors_scaled(AT2(S, 23, i), vectors_three_in(S, 9, i)));
                }
            }
        }
    }
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) { lanes_finish(S, b); }
    lanes_gather(S, B); return lost;
}

INLINE void lanes_taken_out(r2 S, int64_t b, r1 body) {
    for (int64_t c = 0; c < 24; c++) { body.p[c] = AT2(S, 105 + c, b); }
}

INLINE t_ir_r4__r3_ lanes_column(r1 body, real half, int64_t n, real square, r1 state) {
    int settled; t_r4 p, unit; t_r3 w; int64_t status; real reach, size;
    t_r3 k = vectors_scaled(half / n * lanes_fitted(square * (R(1.0) / (n * n))), vectors_three(body, 0));
    t_r3 g = vectors_three(body, 3), inertia = vectors_three(state, 21); real contact = state.p[24];
    t_r2 t_1 = gibbs_certificate(k, inertia, contact); state.p[25] = t_1.a0; state.p[26] = t_1.a1;
    t_r3 t_2 = vectors_three(state, 18);
    t_r3 u = kernel_angular_velocity(k.a0, k.a1, k.a2, g.a0, g.a1, g.a2, t_2.a0, t_2.a1, t_2.a2, contact), v = u;
    t_r4 q = (t_r4){R(1.0), R(0.0), R(0.0), R(0.0)}; t_r3 y = (t_r3){R(0.0), R(0.0), R(0.0)};
    for (int64_t i_0 = 0, end_i_0 = n; i_0 < end_i_0; i_0++) {
        t_b_r4__r3_ t_3 = gibbs_settle(u, k, g, inertia, contact, state.p[25], state.p[26], 0); settled = t_3.a0;
        p = t_3.a1; w = t_3.a2;
        if (!settled) {
            vectors_put(state, 0, k); vectors_put(state, 3, g); t_ir_r4__r3_ t_4 = loop_safe_rotation(w, state);
            status = t_4.a0; reach = t_4.a1; p = t_4.a2; w = t_4.a3;
            if (status != 0) { return (t_ir_r4__r3_){status, reach, q, y}; }
        }
        size = vectors_square_of_four(p);
        if (!(size > R(0.0))) { return (t_ir_r4__r3_){2, R(0.0), q, y}; }
        unit = vectors_scaled_four(R(1.0) / R(sqrt(size)), p);
        t_r3 t_5 = kernel_centre_step(unit.a0, unit.a1, unit.a2, unit.a3, g.a0, g.a1, g.a2);
        y = vectors_plus(y, kernel_rotate(q.a0, q.a1, q.a2, q.a3, t_5.a0, t_5.a1, t_5.a2));
        k = vectors_plus(k, kernel_turn(p.a0, p.a1, p.a2, p.a3, k.a0, k.a1, k.a2));
        g = vectors_plus(g, kernel_turn(p.a0, p.a1, p.a2, p.a3, g.a0, g.a1, g.a2));
        q = kernel_compose(q.a0, q.a1, q.a2, q.a3, unit.a0, unit.a1, unit.a2, unit.a3);
        u = vectors_minus(vectors_scaled(R(2.0), w), v); v = w;
    }
    return (t_ir_r4__r3_){0, R(1.0), q, y};
}

INLINE t_r3 lanes_twist(t_r4 q, t_r4 d) {
    t_r4 t_1 = vectors_conjugate(q), t_2 = kernel_compose(t_1.a0, t_1.a1, t_1.a2, t_1.a3, d.a0, d.a1, d.a2, d.a3);
    return vectors_scaled(R(2.0), (t_r3){t_2.a1, t_2.a2, t_2.a3});
}

INLINE t_ir lanes_long_step(r1 body, real half, real radius, r2 sums, r1 state) {
    t_ir_r4__r3_ status; t_r4 d; t_r4 q = (t_r4){R(0.0), R(0.0), R(0.0), R(0.0)};
    t_r3 y = (t_r3){R(0.0), R(0.0), R(0.0)}, z = (t_r3){R(0.0), R(0.0), R(0.0)}; ALIGNED real changes_[3 * 4];
    memset(changes_, 0, sizeof changes_); r2 changes = {changes_, 3, 4, 4};
    t_r3 t_1 = vectors_three(body, 0), t_2 = vectors_three(body, 3), t_3 = vectors_three(state, 18);
    t_r3 w = kernel_angular_velocity(t_1.a0, t_1.a1, t_1.a2, t_2.a0, t_2.a1, t_2.a2, t_3.a0, t_3.a1, t_3.a2,
        state.p[24]);
    int64_t first = 8 - sums.n1; real square = lanes_turn_square(R(2.0) * half, first, w);
    for (int64_t i = 0, end_i = sums.n1; i < end_i; i++) {
        status = lanes_column(body, half, first + i, square, state);
        if (status.a0 != 0) { return (t_ir){status.a0, status.a1}; }
        q = vectors_plus_four(q, vectors_scaled_four(AT2(sums, 0, i), status.a2));
        y = vectors_plus(y, vectors_scaled(AT2(sums, 0, i), status.a3));
        z = vectors_plus(z, vectors_scaled(AT2(sums, 1, i), status.a3));
        for (int64_t c = 0; c < 3; c++) {
            vectors_put_four(r2_row(changes, c), 0, vectors_plus_four(vectors_four(r2_row(changes, c), 0),
                vectors_scaled_four(AT2(sums, 1 + c, i), status.a2)));
        }
    }
    t_r4 t_4 = vectors_four(body, 6); t_r3 t_5 = kernel_rotate(t_4.a0, t_4.a1, t_4.a2, t_4.a3, z.a0, z.a1, z.a2);
    body.p[22] = t_5.a0; body.p[23] = t_5.a1;
    t__r3_2_r4_r2 t_6 = lanes_moved_body(vectors_three(body, 0), vectors_three(body, 3), vectors_four(body, 6),
        body.p[10], body.p[11], q, y, radius);
    t_r3 k = t_6.a0, g = t_6.a1; t_r4 a = t_6.a2; body.p[10] = t_6.a3; body.p[11] = t_6.a4; vectors_put(body, 0, k);
    vectors_put(body, 3, g); vectors_put_four(body, 6, a);
    for (int64_t c = 0; c < 3; c++) {
        d = vectors_four(r2_row(changes, c), 0);
        if (c == 0) { body.p[12] = body.p[12] + R(2.0) * R(sqrt(vectors_square_of_four(d))); }
        vectors_put(body, 13 + 3 * c, lanes_twist(q, d));
    }
    return (t_ir){0, R(1.0)};
}

OUT_OF_LINE t_ir lanes_safely(r2 S, int64_t b, r2 sums, r1 state) {
    ALIGNED real body_[24]; r1 body = {body_, 24}; lanes_taken_out(S, b, body);
    t_ir status = lanes_long_step(body, AT2(S, 129, b), AT2(S, 130, b), sums, state); lanes_put_back(S, b, body);
    return (t_ir){status.a0, status.a1};
}

INLINE void lanes_stopped_at(int64_t i, int64_t frame, Frames frames) {
    r2_fill(r2_part(r3_row(frames.momenta, i), frame, r3_row(frames.momenta, i).n0), R(NAN));
    r2_fill(r2_part(r3_row(frames.verticals, i), frame, r3_row(frames.verticals, i).n0), R(NAN));
    if (frames.follows) {
        r2_fill(r2_part(r3_row(frames.attitudes, i), frame, r3_row(frames.attitudes, i).n0), R(NAN));
    }
    if (frames.traced) { r2_fill(r2_part(r3_row(frames.traces, i), frame, r3_row(frames.traces, i).n0), R(NAN)); }
}

INLINE void lanes_shown(r1 body, int64_t exponent, int64_t i, int64_t frame, Frames frames) {
    vectors_put(r2_row(r3_row(frames.momenta, i), frame), 0, vectors_shifted(vectors_three(body, 0),
        (int64_t)exponent));
    vectors_put(r2_row(r3_row(frames.verticals, i), frame), 0, vectors_three(body, 3));
    if (frames.follows) { vectors_put_four(r2_row(r3_row(frames.attitudes, i), frame), 0, vectors_four(body, 6)); }
    if (frames.traced) { AT3(frames.traces, i, frame, 0) = body.p[10]; AT3(frames.traces, i, frame, 1) = body.p[11]; }
}

INLINE void lanes_march_lanes(int64_t B, Frames frames, Balls balls, Ends ends, real h, Steps steps, Weights weights,
    r2 kept) {
    int64_t i; real half; t_ir stopped; ALIGNED real S_[140 * (4 * B)]; memset(S_, 0, sizeof S_);
    r2 S = {S_, 140, (4 * B), (4 * B)}; int64_t count = ends.status.n0; ALIGNED real states_[B * 27];
    memset(states_, 0, sizeof states_); r2 states = {states_, B, 27, 27}; ALIGNED int64_t exponents_[B];
    memset(exponents_, 0, sizeof exponents_); i1 exponents = {exponents_, B}; ALIGNED real body_[24];
    memset(body_, 0, sizeof body_); r1 body = {body_, 24};
    for (int64_t b = 0, end_b = B; b < end_b; b++) {
        i = min_i(b, count - 1); lanes_placed(body, i, frames);
        t_ri t_1 = lanes_begun(body, r2_row(balls.tensor, i), balls.contact.p[i], h, r2_row(states, b));
        half = t_1.a0; exponents.p[b] = t_1.a1;
        lanes_enter(S, B, b, half, balls.radius.p[i], weights, body, r2_row(states, b));
    }
    if (steps.first > 0) {
        block_carry(kept, S, 4 * B);
        for (int64_t b = 0, end_b = B; b < end_b; b++) {
            for (int64_t row = 0; row < 27; row++) { AT2(states, b, row) = AT2(kept, 140 + row, b); }
        }
    }
    for (int64_t step = steps.first, end_step = steps.last; step < end_step; step++) {
        if (lanes_side_by_side(S, B, frames.traced, weights)) {
            for (int64_t b = 0, end_b = B; b < end_b; b++) {
                if (AT2(S, 58, b) != R(0.0) && AT2(S, 135, b) == R(0.0)) {
                    stopped = lanes_safely(S, b, weights.sums, r2_row(states, b));
                    if (stopped.a0 != 0) {
                        AT2(S, 135, b) = R(1.0);
                        if (b < count) {
                            ends.status.p[b] = stopped.a0; ends.reach.p[b] = stopped.a1; ends.taken.p[b] = step;
                            lanes_stopped_at(b, div_i(step, steps.every) + 1, frames);
                        }
                    }
                }
            }
        }
        if (mod_i(step + 1, steps.every) == 0) {
            for (int64_t b = 0, end_b = count; b < end_b; b++) {
                if (ends.status.p[b] == 0) {
                    lanes_taken_out(S, b, body);
                    lanes_shown(body, exponents.p[b], b, div_i(step + 1, steps.every), frames);
                }
            }
        }
    }
    block_carry(S, r2_part(kept, 0, 140), 4 * B);
    for (int64_t b = 0, end_b = B; b < end_b; b++) {
        for (int64_t row = 0; row < 27; row++) { AT2(kept, 140 + row, b) = AT2(states, b, row); }
    }
    for (int64_t b = 0, end_b = count; b < end_b; b++) {
        if (ends.status.p[b] == 0) { ends.taken.p[b] = steps.last; ends.reach.p[b] = R(1.0); }
    }
}

INLINE void lanes_march(Frames frames, Balls balls, Ends ends, real h, Steps steps, Weights weights, r2 kept) {
    lanes_march_lanes(8, frames, balls, ends, h, steps, weights, kept);
}

INLINE void lanes_march_alone(Frames frames, Balls balls, Ends ends, real h, Steps steps, Weights weights, r2 kept) {
    lanes_march_lanes(1, frames, balls, ends, h, steps, weights, kept);
}

INLINE void loop_n_guess(r3 past, r1 use, r2 E) {
    real z; int64_t n = E.n0;
    for (int64_t i = 0, end_i = n; i < end_i; i++) {
        for (int64_t j = 0, end_j = n; j < end_j; j++) {
            z = use.p[7] * AT3(past, 7, i, j);
            for (int64_t m = 6, end_m = -1; m > end_m; m--) { z = z + use.p[m] * AT3(past, m, i, j); }
            AT2(E, i, j) = z;
        }
    }
}

INLINE real loop_n_polish(r2 E, r2 W, r1 v) {
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

INLINE void loop_n_gap(r2 E, r2 k, r1 g, r1 J, real D, r1 c, r1 r) {
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

INLINE void loop_n_slope(r2 E, r1 g, r1 J, real D, r2 O, r1 h, r1 c, r2 T) {
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

INLINE void loop_n_solve(r2 T, r1 r) {
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

INLINE t_r2 loop_n_turn(r2 E, r1 r, r2 O, r2 W, r1 v) {
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

INLINE int loop_n_settle(Under ball, r2 k, int64_t s, r2 E, r2 T) {
    real far, off; t_r2 change; int64_t n = k.n0; r1 g = ball.g, J = ball.J;
    real D = ball.D, enough = ball.enough.p[s]; ALIGNED real O_[n * n]; r2 O = {O_, n, n, n}; ALIGNED real W_[n * n];
    r2 W = {W_, n, n, n}; ALIGNED real r_[T.n0]; r1 r = {r_, T.n0}; ALIGNED real h_[n]; r1 h = {h_, n};
    ALIGNED real c_[n]; r1 c = {c_, n};
    for (int64_t i_0 = 0; i_0 < 12; i_0++) {
        far = loop_n_polish(E, W, c); loop_n_gap(E, k, g, J, D, c, r); loop_n_slope(E, g, J, D, O, h, c, T);
        loop_n_solve(T, r); change = loop_n_turn(E, r, O, W, c); off = change.a0 + far;
        if (off * off <= enough * enough * change.a1) { return change.a1 <= ball.near.p[s]; }
    }
    return 0;
}

INLINE void loop_n_remember(r2 E, r3 past, r1 use) {
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

INLINE void loop_n_roll(r2 E, r1 g, r2 R, r1 spot, real rho, r1 c, r2 W) {
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

INLINE void loop_n_move(r2 E, r2 k, r1 g, r2 W, r1 c) {
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

INLINE int64_t loop_n_march(Under ball, Steps stages, Track track, r2 T) {
    int64_t s, frame; r2 t_1 = ball.k; r1 t_2 = ball.g; int64_t t_3 = ball.k.n0, t_4 = ball.c.n0; r2 k = t_1;
    r1 g = t_2; int64_t n = t_3, count = t_4; ALIGNED real E_[n * n]; r2 E = {E_, n, n, n}; ALIGNED real W_[n * n];
    r2 W = {W_, n, n, n}; ALIGNED real part_[n * n]; r2 part = {part_, n, n, n}; ALIGNED real v_[n]; r1 v = {v_, n};
    for (int64_t stage = stages.first, end_stage = stages.last; stage < end_stage; stage++) {
        s = mod_i(stage, count);
        for (int64_t i = 0, end_i = n; i < end_i; i++) {
            for (int64_t j = 0, end_j = n; j < end_j; j++) { AT2(part, i, j) = ball.c.p[s] * AT2(k, i, j); }
        }
        loop_n_guess(r4_row(ball.past, s), r2_row(ball.use, s), E);
        if (!loop_n_settle(ball, part, s, E, T)) { return stage; }
        loop_n_remember(E, r4_row(ball.past, s), r2_row(ball.use, s));
        if (track.follows) { loop_n_roll(E, g, ball.R, ball.spot, ball.rho, v, W); }
        loop_n_move(E, k, g, W, v);
        if (mod_i(stage + 1, count * stages.every) == 0) {
            frame = div_i(stage + 1, count * stages.every);
            for (int64_t i = 0, end_i = n; i < end_i; i++) {
                AT2(track.verticals, frame, i) = g.p[i];
                for (int64_t j = 0, end_j = n; j < end_j; j++) {
                    AT2(track.momenta, frame, n * i + j) = ball.scale * AT2(k, i, j);
                    if (track.follows) { AT2(track.attitudes, frame, n * i + j) = AT2(ball.R, i, j); }
                }
            }
            if (track.follows) {
                for (int64_t i = 0, end_i = n - 1; i < end_i; i++) { AT2(track.traces, frame, i) = ball.spot.p[i]; }
            }
        }
    }
    return stages.last;
}

INLINE real kernel_vertical_square(real g1, real g2, real g3, real L1, real L2, real L3) {
    real o_level = L1 * L2 * g3 * g3 + L1 * L3 * g2 * g2 + L2 * L3 * g1 * g1; return o_level;
}

INLINE t_r2 kernel_vertical_level(real t, real v, real level, real L1, real L2, real L3) {
    real s = t * t, m = s * v, t0 = -m, p1 = L1 + t0, p2 = L2 + t0, p3 = L3 + t0, c = p1 * p2;
    real a = L1 + L2 + (L3 - 2 * m), b = c + 2 * s + p3 * (p1 + p2), t1 = a * s + c * p3, o_f = t1 * v - level - s;
    real o_fv = t1 - b * m; return (t_r2){o_f, o_fv};
}

INLINE t_br vertical_loop_level_root(real level, real t, real v, t_r3 inertia) {
    t_r2 f; real correction;
    for (int64_t i_0 = 0; i_0 < 30; i_0++) {
        f = kernel_vertical_level(t, v, level, inertia.a0, inertia.a1, inertia.a2); correction = f.a0 / f.a1;
        v = v - correction;
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

INLINE int vertical_loop_march(r1 state, r1 I, real k, Steps steps, r2 verticals, r1 q) {
    real level, correction; int settled; t_r2 f;
    t_r3 inertia = vectors_three(I, 0), v = vectors_three(state, 0), y = vectors_three(state, 3);
    real root = state.p[6];
    if (steps.first == 0) {
        level = kernel_vertical_square(v.a0, v.a1, v.a2, inertia.a0, inertia.a1, inertia.a2);
        t_br t_1 = vertical_loop_level_root(level, k, level / (I.p[0] * I.p[1] * I.p[2]), inertia); settled = t_1.a0;
        root = t_1.a1;
        if (!settled) { return 0; }
    }
    t_r4 p = (t_r4){R(1.0), R(0.0), R(0.0), R(0.0)};
    for (int64_t step = steps.first + 1, end_step = steps.last + 1; step < end_step; step++) {
        p = kernel_vertical_rotation(k, root * k * k, v.a0, v.a1, v.a2, inertia.a0, inertia.a1, inertia.a2);
        f = kernel_vertical_level(k, root, kernel_vertical_square(v.a0, v.a1, v.a2, inertia.a0, inertia.a1,
            inertia.a2), inertia.a0, inertia.a1, inertia.a2);
        correction = f.a0 / f.a1;
        if (!(vectors_dot((t_r3){p.a1, p.a2, p.a3}, (t_r3){p.a1, p.a2, p.a3}) < p.a0 * p.a0 && R(fabs(correction)) <=
            R(1.7763568394002505e-15) * root)) {
            return 0;
        }
        root = root - correction; t__r3_2 t_2 = integrals_turned(p, v, y); v = t_2.a0; y = t_2.a1;
        if (mod_i(step, steps.every) == 0) { vectors_put(r2_row(verticals, div_i(step, steps.every)), 0, v); }
    }
    vectors_put(state, 0, v); vectors_put(state, 3, y); state.p[6] = root; vectors_put_four(q, 0, p); return 1;
}

INLINE t_i2 double_double_scales(r1 momentum, r1 tensor, real contact) {
    t_r3 t_1 = branch_moments(vectors_three(tensor, 0));
    t_ri t_2 = real_frexp(max_r(max_r(t_1.a0, t_1.a1), t_1.a2) + contact); int64_t exponent = t_2.a1;
    real most = vectors_largest(vectors_three(momentum, 0)); t_ri size = real_frexp(most);
    exponent = max_i(exponent, size.a1 - 1021);
    int64_t beyond = most > R(0.0) ? max_i(0, -200 - (size.a1 - exponent)) : 0;
    return (t_i2){beyond - exponent - 1, beyond};
}

INLINE t_e3 proved_exact(t_r3 v) { return (t_e3){v.a0, v.a1, v.a2}; }
INLINE t_r2 pairs_two_product(real a, real b) { real p = a * b; return (t_r2){p, fma(a, b, -p)}; }
INLINE t_r2 pairs_loose_add(t_r2 a, t_r2 b) {
    t_r2 s = pairs_two_sum(a.a0, b.a0); return (t_r2){s.a0, s.a1 + (a.a1 + b.a1)};
}

INLINE t_r2 vectors_dot__e3_2(t_e3 a, t_e3 b) {
    return pairs_loose_add(pairs_loose_add(pairs_two_product(a.a0, b.a0), pairs_two_product(a.a1, b.a1)),
        pairs_two_product(a.a2, b.a2));
}

INLINE t_r2 pairs_quick_two_sum(real a, real b) { real total = a + b; return (t_r2){total, b - (total - a)}; }
INLINE t_r2 pairs_root(t_r2 a) {
    if (a.a0 == R(0.0)) { return (t_r2){R(0.0), R(0.0)}; }
    real high = R(sqrt(a.a0)); t_r2 p = pairs_two_product(high, high);
    return pairs_quick_two_sum(high, (a.a1 + (a.a0 - p.a0 - p.a1)) / (R(2.0) * high));
}

INLINE t_r2 pairs_multiply_float(t_r2 a, real b) {
    t_r2 p = pairs_two_product(a.a0, b), s = pairs_quick_two_sum(p.a0, a.a1 * b);
    return pairs_quick_two_sum(s.a0, s.a1 + p.a1);
}

INLINE t_r2 pairs_divide(t_r2 a, t_r2 b) {
    real high = a.a0 / b.a0; t_r2 r = pairs_multiply_float(b, high);
    return pairs_quick_two_sum(high, (a.a0 - r.a0 + (a.a1 - r.a1)) / b.a0);
}

INLINE t_p3 proved_unit_pairs(t_r3 v) {
    t_e3 x = proved_exact(v); t_r2 t_1 = vectors_dot__e3_2(x, x), size = pairs_root(pairs_two_sum(t_1.a0, t_1.a1));
    return (t_p3){pairs_divide((t_r2){x.a0, 0}, pairs_two_sum(size.a0, size.a1)), pairs_divide((t_r2){x.a1, 0},
        pairs_two_sum(size.a0, size.a1)), pairs_divide((t_r2){x.a2, 0}, pairs_two_sum(size.a0, size.a1))};
}

INLINE void double_double_put_pair_r1ip(r1 array, int64_t at, t_r2 x) { array.p[at] = x.a0; array.p[at + 1] = x.a1; }
INLINE void double_double_put_pairs_r1i_p3_(r1 array, int64_t at, t_p3 v) {
    double_double_put_pair_r1ip(array, at, v.a0); double_double_put_pair_r1ip(array, at + 2, v.a1);
    double_double_put_pair_r1ip(array, at + 4, v.a2);
}

INLINE t_r2 double_double_pair(r1 array, int64_t at) { return (t_r2){array.p[at], array.p[at + 1]}; }
INLINE t_p3 double_double_three_pairs(r1 array, int64_t at) {
    return (t_p3){double_double_pair(array, at), double_double_pair(array, at + 2), double_double_pair(array, at +
        4)};
}

INLINE t_r2 pairs_loose_multiply(t_r2 a, t_r2 b) {
    t_r2 p = pairs_two_product(a.a0, b.a0); return (t_r2){p.a0, p.a1 + (a.a0 * b.a1 + a.a1 * b.a0)};
}

INLINE t_r2 vectors_dot__p3_2(t_p3 a, t_p3 b) {
    return pairs_loose_add(pairs_loose_add(pairs_loose_multiply(a.a0, b.a0), pairs_loose_multiply(a.a1, b.a1)),
        pairs_loose_multiply(a.a2, b.a2));
}

INLINE t_p3 double_double_normalised__p3_(t_p3 v) {
    return (t_p3){pairs_two_sum(v.a0.a0, v.a0.a1), pairs_two_sum(v.a1.a0, v.a1.a1), pairs_two_sum(v.a2.a0, v.a2.a1)};
}

INLINE void double_double_remember_pairs(r1 state) {
    t_p3 k = double_double_three_pairs(state, 0), g = double_double_three_pairs(state, 6);
    double_double_put_pairs_r1i_p3_(state, 22, double_double_normalised__p3_((t_p3){vectors_dot__p3_2(g, g),
        vectors_dot__p3_2(k, g), vectors_dot__p3_2(k, k)}));
}

INLINE t_r3 double_double_highs__p3_(t_p3 v) { return (t_r3){v.a0.a0, v.a1.a0, v.a2.a0}; }
INLINE t_r2 double_double_bounds(t_r3 k, t_r3 I, real D) {
    if (min_r(min_r(I.a0, I.a1), I.a2) < R(7.52316384526264e-37)) { return (t_r2){R(-1.0), R(0.0)}; }
    return gibbs_certificate(k, I, D);
}

OUT_OF_LINE t_i2 double_double_prepare_pairs(r1 momentum, r1 g, r1 tensor, real contact, r2 c, r1 state, r2 limits) {
    t_r3 k, inertia; t_i2 shift = double_double_scales(momentum, tensor, contact);
    int64_t size = shift.a1 - shift.a0 - 1;
    for (int64_t i = 0; i < 3; i++) {
        state.p[0 + 2 * i] = R(ldexp(momentum.p[i], (int)shift.a0)); state.p[0 + 2 * i + 1] = R(0.0);
        state.p[18 + i] = R(ldexp(tensor.p[i], (int)-size));
    }
    state.p[21] = R(ldexp(contact, (int)-size));
    double_double_put_pairs_r1i_p3_(state, 6, proved_unit_pairs(vectors_three(g, 0)));
    t_r2 t_1 = pairs_two_sum(state.p[19], state.p[20]); state.p[12] = t_1.a0; state.p[13] = t_1.a1;
    t_r2 t_2 = pairs_two_sum(state.p[18], state.p[20]); state.p[14] = t_2.a0; state.p[15] = t_2.a1;
    t_r2 t_3 = pairs_two_sum(state.p[18], state.p[19]); state.p[16] = t_3.a0; state.p[17] = t_3.a1;
    double_double_remember_pairs(state);
    for (int64_t i = 0, end_i = c.n0; i < end_i; i++) {
        k = vectors_scaled(AT2(c, i, 0), double_double_highs__p3_(double_double_three_pairs(state, 0)));
        inertia = double_double_highs__p3_(double_double_three_pairs(state, 12));
        t_r2 t_4 = double_double_bounds(k, inertia, state.p[21]); AT2(limits, 0, i) = t_4.a0;
        AT2(limits, 1, i) = t_4.a1;
    }
    return (t_i2){shift.a0, shift.a1};
}

INLINE t_p3 vectors_scaled_p_p3_(t_r2 s, t_p3 v) {
    return (t_p3){pairs_loose_multiply(s, v.a0), pairs_loose_multiply(s, v.a1), pairs_loose_multiply(s, v.a2)};
}

INLINE Round double_double_approach(t_r3 u, t_r3 k, t_r3 g, t_r3 I, real D, real radius, real enough) {
    Round r = gibbs_newton_round(u, k, g, I, D, 0);
    for (int64_t i_0 = 0; i_0 < 11; i_0++) {
        if (r.first <= enough || radius < R(0.0)) { break; }
        int t_1 = vectors_square(r.w) <= radius; t_r3 t_2 = (t_r3){R(0.0), R(0.0), R(0.0)};
        r = gibbs_newton_round((t_r3){t_1 ? r.w.a0 : t_2.a0, t_1 ? r.w.a1 : t_2.a1, t_1 ? r.w.a2 : t_2.a2}, k, g, I,
            D, 0);
    }
    return r;
}

INLINE t_r2 pairs_loose_multiply_float(t_r2 a, real b) {
    t_r2 p = pairs_two_product(a.a0, b); return (t_r2){p.a0, p.a1 + a.a1 * b};
}

INLINE t_r2 pairs_loose_subtract(t_r2 a, t_r2 b) {
    t_r2 s = pairs_two_sum(a.a0, -b.a0); return (t_r2){s.a0, s.a1 + (a.a1 - b.a1)};
}

INLINE t_r2 pairs_loose_add_float(t_r2 a, real b) {
    t_r2 s = pairs_two_sum(a.a0, b); return (t_r2){s.a0, s.a1 + a.a1};
}

INLINE t_p3 kernel_gibbs_residual_e3p9e(real u1, real u2, real u3, t_r2 k1, t_r2 k2, t_r2 k3, t_r2 g1, t_r2 g2, t_r2
    g3, t_r2 I1, t_r2 I2, t_r2 I3, real D) {
    t_r2 x1 = pairs_loose_subtract(pairs_loose_multiply_float(g3, u2), pairs_loose_multiply_float(g2, u3));
    t_r2 x2 = pairs_loose_subtract(pairs_loose_multiply_float(g1, u3), pairs_loose_multiply_float(g3, u1));
    t_r2 x3 = pairs_loose_subtract(pairs_loose_multiply_float(g2, u1), pairs_loose_multiply_float(g1, u2));
    t_r2 y1 = pairs_loose_multiply_float(I1, u1), y2 = pairs_loose_multiply_float(I2, u2);
    t_r2 y3 = pairs_loose_multiply_float(I3, u3);
    t_r2 s = pairs_loose_add(pairs_loose_add_float(pairs_two_product(u1, u1), 1),
        pairs_loose_add(pairs_two_product(u2, u2), pairs_two_product(u3, u3)));
    t_r2 o_r1 = pairs_loose_subtract(pairs_loose_add(pairs_loose_add(y1,
        pairs_loose_multiply_float(pairs_loose_subtract(pairs_loose_multiply(g2, x3), pairs_loose_multiply(g3, x2)),
        D)), pairs_loose_multiply_float(y3, u2)), pairs_loose_add(pairs_loose_multiply(k1, s),
        pairs_loose_multiply_float(y2, u3)));
    t_r2 o_r2 = pairs_loose_subtract(pairs_loose_add(pairs_loose_add(y2,
        pairs_loose_multiply_float(pairs_loose_subtract(pairs_loose_multiply(g3, x1), pairs_loose_multiply(g1, x3)),
        D)), pairs_loose_multiply_float(y1, u3)), pairs_loose_add(pairs_loose_multiply(k2, s),
        pairs_loose_multiply_float(y3, u1)));
    t_r2 o_r3 = pairs_loose_subtract(pairs_loose_add(pairs_loose_add(y3,
        pairs_loose_multiply_float(pairs_loose_subtract(pairs_loose_multiply(g1, x2), pairs_loose_multiply(g2, x1)),
        D)), pairs_loose_multiply_float(y2, u1)), pairs_loose_add(pairs_loose_multiply(k3, s),
        pairs_loose_multiply_float(y1, u2)));
    return (t_p3){o_r1, o_r2, o_r3};
}

INLINE t_r3 vectors_adjoint(t_r9 c, t_r3 r) {
    return (t_r3){c.a0 * r.a0 + c.a3 * r.a1 + c.a6 * r.a2, c.a1 * r.a0 + c.a4 * r.a1 + c.a7 * r.a2, c.a2 * r.a0 + c.a5
        * r.a1 + c.a8 * r.a2};
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

INLINE t_r3 gibbs_correction(real det, t_r3 d, t_r9 cofactors, t_r3 r, t_r3 k, t_r3 I) {
    real s = R(-1.0) / det;
    t_r3 e = vectors_scaled(s, vectors_adjoint(cofactors, r)), t_1 = vectors_plus(d, vectors_scaled(R(0.5), e));
    return vectors_plus(e, vectors_scaled(s, kernel_gibbs_mixed(t_1.a0, t_1.a1, t_1.a2, e.a0, e.a1, e.a2, k.a0, k.a1,
        k.a2, cofactors.a0, cofactors.a1, cofactors.a2, cofactors.a3, cofactors.a4, cofactors.a5, cofactors.a6,
        cofactors.a7, cofactors.a8, I.a0, I.a1, I.a2)));
}

INLINE int double_double_small(t_r3 w, t_r3 e) {
    return vectors_square(e) <= R(7.888609052210118e-31) * vectors_square(w);
}

INLINE t_p3 double_double_summed(t_r3 v, t_r3 w) {
    t_r2 t_1 = pairs_two_sum(v.a0, w.a0), t_2 = pairs_two_sum(v.a1, w.a1), t_3 = pairs_two_sum(v.a2, w.a2);
    return (t_p3){(t_r2){t_1.a0, t_1.a1}, (t_r2){t_2.a0, t_2.a1}, (t_r2){t_3.a0, t_3.a1}};
}

INLINE t_r4 double_double_rotation_of(t_r3 w) {
    real p0 = R(1.0) / R(sqrt(R(1.0) + vectors_square(w))); return (t_r4){p0, p0 * w.a0, p0 * w.a1, p0 * w.a2};
}

INLINE t_p3 vectors_plus__p3_2(t_p3 a, t_p3 b) {
    return (t_p3){pairs_loose_add(a.a0, b.a0), pairs_loose_add(a.a1, b.a1), pairs_loose_add(a.a2, b.a2)};
}

INLINE t_q3 double_double_sums_normal__p3_(t_p3 v) {
    return (t_q3){(t_r2){v.a0.a0, v.a0.a1}, (t_r2){v.a1.a0, v.a1.a1}, (t_r2){v.a2.a0, v.a2.a1}};
}

INLINE t_q3 kernel_residual_q10e4(t_r2 q0, t_r2 q1, t_r2 q2, t_r2 q3, t_r2 K1, t_r2 K2, t_r2 K3, t_r2 g1, t_r2 g2,
    t_r2 g3, real J1, real J2, real J3, real D) {
    t_r2 t_1 = pairs_loose_subtract(pairs_loose_multiply(g3, q2), pairs_loose_multiply(g2, q3));
    t_r2 c1 = pairs_two_sum(t_1.a0, t_1.a1);
    t_r2 t_2 = pairs_loose_subtract(pairs_loose_multiply(g1, q3), pairs_loose_multiply(g3, q1));
    t_r2 c2 = pairs_two_sum(t_2.a0, t_2.a1);
    t_r2 t_3 = pairs_loose_subtract(pairs_loose_multiply(g2, q1), pairs_loose_multiply(g1, q2));
    t_r2 c3 = pairs_two_sum(t_3.a0, t_3.a1), f1 = pairs_loose_multiply_float(c1, D);
    t_r2 f2 = pairs_loose_multiply_float(c2, D), f3 = pairs_loose_multiply_float(c3, D); real t0 = -J3;
    t_r2 t1 = (t_r2){2 * q3.a0, 2 * q3.a1}, t2 = (t_r2){2 * q0.a0, 2 * q0.a1};
    t_r2 t_4 = pairs_loose_add(pairs_loose_multiply(f3, g2), pairs_loose_multiply(q1, pairs_two_sum(J2, J3)));
    t_r2 t_5 = pairs_loose_subtract(pairs_two_sum(t_4.a0, t_4.a1), pairs_loose_multiply(f2, g3));
    t_r2 t_6 = pairs_loose_add(pairs_loose_multiply(t2, pairs_two_sum(t_5.a0, t_5.a1)),
        pairs_loose_multiply(pairs_loose_multiply(q2, t1), pairs_two_sum(J2, t0)));
    t_r2 t_7 = pairs_loose_subtract(pairs_two_sum(t_6.a0, t_6.a1), K1), o_r1 = pairs_two_sum(t_7.a0, t_7.a1);
    t_r2 t_8 = pairs_loose_add(pairs_loose_multiply(f1, g3), pairs_loose_multiply(q2, pairs_two_sum(J1, J3)));
    t_r2 t_9 = pairs_loose_subtract(pairs_two_sum(t_8.a0, t_8.a1), pairs_loose_multiply(f3, g1));
    t_r2 t_10 = pairs_loose_subtract(pairs_loose_multiply((t_r2){2 * q0.a0, 2 * q0.a1}, pairs_two_sum(t_9.a0,
        t_9.a1)), K2);
    t_r2 t_11 = pairs_loose_subtract(pairs_two_sum(t_10.a0, t_10.a1), pairs_loose_multiply(pairs_loose_multiply(q1,
        t1), pairs_two_sum(J1, t0)));
    t_r2 o_r2 = pairs_two_sum(t_11.a0, t_11.a1);
    t_r2 t_12 = pairs_loose_add(pairs_loose_multiply(f2, g1), pairs_loose_multiply(q3, pairs_two_sum(J1, J2)));
    t_r2 t_13 = pairs_loose_subtract(pairs_two_sum(t_12.a0, t_12.a1), pairs_loose_multiply(f1, g2));
    t_r2 t_14 = pairs_loose_add(pairs_loose_multiply(t2, pairs_two_sum(t_13.a0, t_13.a1)),
        pairs_loose_multiply(pairs_loose_multiply((t_r2){2 * q1.a0, 2 * q1.a1}, q2), pairs_two_sum(J1, -J2)));
    t_r2 t_15 = pairs_loose_subtract(pairs_two_sum(t_14.a0, t_14.a1), K3), o_r3 = pairs_two_sum(t_15.a0, t_15.a1);
    return (t_q3){o_r1, o_r2, o_r3};
}

INLINE t_p4 kernel_compose_p41e3(t_r2 a0, t_r2 a1, t_r2 a2, t_r2 a3, real b1, real b2, real b3) {
    t_r2 o_c0 = pairs_loose_subtract(pairs_loose_subtract(a0, pairs_loose_multiply_float(a1, b1)),
        pairs_loose_add(pairs_loose_multiply_float(a2, b2), pairs_loose_multiply_float(a3, b3)));
    t_r2 o_c1 = pairs_loose_add(pairs_loose_add(pairs_loose_multiply_float(a0, b1), a1),
        pairs_loose_subtract(pairs_loose_multiply_float(a2, b3), pairs_loose_multiply_float(a3, b2)));
    t_r2 o_c2 = pairs_loose_add(pairs_loose_add(pairs_loose_multiply_float(a0, b2), a2),
        pairs_loose_subtract(pairs_loose_multiply_float(a3, b1), pairs_loose_multiply_float(a1, b3)));
    t_r2 o_c3 = pairs_loose_add(pairs_loose_add(pairs_loose_multiply_float(a0, b3), pairs_loose_multiply_float(a1,
        b2)), pairs_loose_subtract(a3, pairs_loose_multiply_float(a2, b1)));
    return (t_p4){o_c0, o_c1, o_c2, o_c3};
}

INLINE t_r2 vectors_square_of_four__p4_(t_p4 q) {
    return pairs_loose_add(pairs_loose_add(pairs_loose_multiply(q.a0, q.a0), pairs_loose_multiply(q.a1, q.a1)),
        pairs_loose_add(pairs_loose_multiply(q.a2, q.a2), pairs_loose_multiply(q.a3, q.a3)));
}

INLINE t_p4 double_double_of_length_one__p4_(t_p4 q) {
    t_r2 t_1 = vectors_square_of_four__p4_(q), t_2 = pairs_loose_add_float((t_r2){-t_1.a0, -t_1.a1}, 3);
    t_r2 t = (t_r2){t_2.a0 / 2, t_2.a1 / 2};
    return (t_p4){pairs_loose_multiply(t, q.a0), pairs_loose_multiply(t, q.a1), pairs_loose_multiply(t, q.a2),
        pairs_loose_multiply(t, q.a3)};
}

INLINE t_p4 double_double_normalised_four__p4_(t_p4 q) {
    return (t_p4){pairs_two_sum(q.a0.a0, q.a0.a1), pairs_two_sum(q.a1.a0, q.a1.a1), pairs_two_sum(q.a2.a0, q.a2.a1),
        pairs_two_sum(q.a3.a0, q.a3.a1)};
}

INLINE t_b_p3_ double_double_polished__r4__p3_2_r3_r2(t_r4 p, t_p3 k, t_p3 g, t_r3 J, real D, real near) {
    t_q3 r; t_r_r9_ det; t_r3 w; real change, extent;
    t_q3 K = double_double_sums_normal__p3_(vectors_plus__p3_2(k, k)), v = double_double_sums_normal__p3_(g);
    t_r3 floats = double_double_highs__p3_(g);
    t_p4 q = (t_p4){(t_r2){p.a0, R(0.0)}, (t_r2){p.a1, R(0.0)}, (t_r2){p.a2, R(0.0)}, (t_r2){p.a3, R(0.0)}};
    real before = near; int settled = 0;
    for (int64_t i_0 = 0; i_0 < 60; i_0++) {
        t_q3 t_1 = double_double_sums_normal__p3_((t_p3){q.a1, q.a2, q.a3}); t_e3 t_2 = proved_exact(J);
        r = kernel_residual_q10e4((t_r2){q.a0.a0, q.a0.a1}, t_1.a0, t_1.a1, t_1.a2, K.a0, K.a1, K.a2, v.a0, v.a1,
            v.a2, t_2.a0, t_2.a1, t_2.a2, D);
        t_r3 t_3 = double_double_highs__p3_((t_p3){q.a1, q.a2, q.a3});
        det = branch_inverse((t_r4){q.a0.a0, t_3.a0, t_3.a1, t_3.a2}, floats, J, D);
        if (!(det.a0 > R(0.0))) { break; }
        t_r2 t_4 = pairs_two_sum(r.a0.a0, r.a0.a1), t_5 = pairs_two_sum(r.a1.a0, r.a1.a1);
        t_r2 t_6 = pairs_two_sum(r.a2.a0, r.a2.a1); w = branch_product(det.a1, (t_r3){t_4.a0, t_5.a0, t_6.a0});
        q = double_double_normalised_four__p4_(double_double_of_length_one__p4_(kernel_compose_p41e3(q.a0, q.a1, q.a2,
            q.a3, -w.a0, -w.a1, -w.a2)));
        change = vectors_largest(w); extent = vectors_largest(double_double_highs__p3_((t_p3){q.a1, q.a2, q.a3}));
        if (change > near) { break; }
        settled = change <= R(4.930380657631324e-32) * extent || (change <= R(8.673617379884035e-19) * extent &&
            change >= R(0.25) * before);
        if (settled) { break; }
        before = change;
    }
    t_r2 cosine = q.a0;
    if (cosine.a0 == R(0.0)) { cosine = (t_r2){R(7.703719777548943e-34), q.a0.a1}; }
    return (t_b_p3_){settled, (t_p3){pairs_divide(q.a1, pairs_two_sum(cosine.a0, cosine.a1)), pairs_divide(q.a2,
        pairs_two_sum(cosine.a0, cosine.a1)), pairs_divide(q.a3, pairs_two_sum(cosine.a0, cosine.a1))}};
}

INLINE t_ir_p3_ double_double_solved__r3__p3_3_r3_r3(t_r3 u, t_p3 k, t_p3 g, t_p3 I, t_r3 J, real D, real radius, real
    enough) {
    t_p3 G; t_r3 left, e; t_r4 p; real p0, p1, p2, p3;
    t_r3 floats = double_double_highs__p3_(k), vertical = double_double_highs__p3_(g);
    t_r3 inertia = double_double_highs__p3_(I); t_r2 zero = (t_r2){R(0.0), R(0.0)};
    int t_1 = vectors_square(u) <= radius; t_r3 t_2 = (t_r3){R(0.0), R(0.0), R(0.0)};
    Round r = double_double_approach((t_r3){t_1 ? u.a0 : t_2.a0, t_1 ? u.a1 : t_2.a1, t_1 ? u.a2 : t_2.a2}, floats,
        vertical, inertia, D, radius, enough);
    int settled = radius >= R(0.0) && r.first <= enough; t_r3 w = r.w; int64_t status = 0; real reach = R(1.0);
    if (settled) {
        t_e3 t_3 = proved_exact(w);
        G = kernel_gibbs_residual_e3p9e(t_3.a0, t_3.a1, t_3.a2, k.a0, k.a1, k.a2, g.a0, g.a1, g.a2, I.a0, I.a1, I.a2,
            D);
        t_r2 t_4 = pairs_two_sum(G.a0.a0, G.a0.a1), t_5 = pairs_two_sum(G.a1.a0, G.a1.a1);
        t_r2 t_6 = pairs_two_sum(G.a2.a0, G.a2.a1); left = (t_r3){t_4.a0, t_5.a0, t_6.a0};
        e = gibbs_correction(r.p.a0, r.d, r.cofactors, left, floats, inertia);
        if (double_double_small(w, e)) { return (t_ir_p3_){0, R(1.0), double_double_summed(w, e)}; }
        p = double_double_rotation_of(vectors_plus(w, e));
    }
    else {
        if (radius == R(-2.0)) {
            t_b_r4__r3_ t_7 = path_search_on_path(u, floats, vertical, inertia, D); settled = t_7.a0; p = t_7.a1;
            w = t_7.a2;
        }
        if (settled) { p = double_double_rotation_of(w); }
        else {
            t_r3 t_8 = vectors_scaled(R(2.0), floats);
            t_ir5 t_9 = branch_small_rotation(t_8.a0, t_8.a1, t_8.a2, vertical.a0, vertical.a1, vertical.a2, J.a0,
                J.a1, J.a2, D);
            status = t_9.a0; reach = t_9.a1; p0 = t_9.a2; p1 = t_9.a3; p2 = t_9.a4; p3 = t_9.a5;
            p = (t_r4){p0, p1, p2, p3};
        }
        if (status != 0 && !(status == 1 && reach > R(0.9999999999999716))) {
            return (t_ir_p3_){status, reach, (t_p3){zero, zero, zero}};
        }
    }
    t_b_p3_ t_10 = double_double_polished__r4__p3_2_r3_r2(p, k, g, J, D, status == 1 ? R(1e-06) : R(0.1));
    settled = t_10.a0; t_p3 found = t_10.a1;
    if (settled) { return (t_ir_p3_){0, R(1.0), found}; }
    return (t_ir_p3_){status == 1 ? 1 : 2, reach, (t_p3){zero, zero, zero}};
}

INLINE t_r8 integrals_filtered(real b, real c, real d, real e, real f, real h, real o, real w) {
    return (t_r8){b + R(8.0) * w, c - R(28.0) * w, d + R(56.0) * w, e - R(70.0) * w, f + R(56.0) * w, h - R(28.0) * w,
        o + R(8.0) * w, -w};
}

INLINE void double_double_extrapolated(r2 past, t_r3 w) {
    int64_t c = 0; real x = w.a0;
    t_r8 t_1 = integrals_filtered(AT2(past, 1, c), AT2(past, 2, c), AT2(past, 3, c), AT2(past, 4, c), AT2(past, 5, c),
        AT2(past, 6, c), AT2(past, 7, c), x);
    AT2(past, 0, c) = t_1.a0; AT2(past, 1, c) = t_1.a1; AT2(past, 2, c) = t_1.a2; AT2(past, 3, c) = t_1.a3;
    AT2(past, 4, c) = t_1.a4; AT2(past, 5, c) = t_1.a5; AT2(past, 6, c) = t_1.a6; AT2(past, 7, c) = t_1.a7; c = 1;
    x = w.a1;
    t_r8 t_2 = integrals_filtered(AT2(past, 1, c), AT2(past, 2, c), AT2(past, 3, c), AT2(past, 4, c), AT2(past, 5, c),
        AT2(past, 6, c), AT2(past, 7, c), x);
    AT2(past, 0, c) = t_2.a0; AT2(past, 1, c) = t_2.a1; AT2(past, 2, c) = t_2.a2; AT2(past, 3, c) = t_2.a3;
    AT2(past, 4, c) = t_2.a4; AT2(past, 5, c) = t_2.a5; AT2(past, 6, c) = t_2.a6; AT2(past, 7, c) = t_2.a7; c = 2;
    x = w.a2;
    t_r8 t_3 = integrals_filtered(AT2(past, 1, c), AT2(past, 2, c), AT2(past, 3, c), AT2(past, 4, c), AT2(past, 5, c),
        AT2(past, 6, c), AT2(past, 7, c), x);
    AT2(past, 0, c) = t_3.a0; AT2(past, 1, c) = t_3.a1; AT2(past, 2, c) = t_3.a2; AT2(past, 3, c) = t_3.a3;
    AT2(past, 4, c) = t_3.a4; AT2(past, 5, c) = t_3.a5; AT2(past, 6, c) = t_3.a6; AT2(past, 7, c) = t_3.a7;
}

INLINE t_ir_p3_ double_double_stage_r1pr2r2(r1 state, t_r2 c, real radius, real enough, r2 past) {
    t_p3 k = double_double_normalised__p3_(vectors_scaled_p_p3_(c, double_double_three_pairs(state, 0)));
    t_p3 g = double_double_three_pairs(state, 6), inertia = double_double_three_pairs(state, 12);
    t_ir_p3_ status = double_double_solved__r3__p3_3_r3_r3(vectors_three(r2_row(past, 0), 0), k, g, inertia,
        vectors_three(state, 18), state.p[21], radius, enough);
    if (status.a0 == 0) { double_double_extrapolated(past, double_double_highs__p3_(status.a2)); }
    return (t_ir_p3_){status.a0, status.a1, status.a2};
}

INLINE t_r3 proved_floats__p3_(t_p3 v) {
    t_r2 t_1 = pairs_two_sum(v.a0.a0, v.a0.a1), t_2 = pairs_two_sum(v.a1.a0, v.a1.a1);
    t_r2 t_3 = pairs_two_sum(v.a2.a0, v.a2.a1); return (t_r3){t_1.a0, t_2.a0, t_3.a0};
}

INLINE real proved_extent(r1 box) {
    real total = box.p[12];
    for (int64_t j = 0; j < 3; j++) { total = total + box.p[9 + j] * vectors_length(vectors_three(box, 0 + 3 * j)); }
    return R(1.0000000000009095) * total;
}

INLINE real proved_long(t_r3 v) {
    real most = vectors_largest(v); return most > R(3.054936363499605e-151) ? vectors_length(v) : R(2.0) * most;
}

INLINE real proved_slope_at(t_r3 u, t_r3 k, t_r3 g, t_r3 I, real D) {
    real half = R(sqrt(vectors_square(k)));
    t_r2 reached = path_joined(u, vectors_square(u), k, half, g, I, D, R(0.5) * (max_r(max_r(I.a0, I.a1), I.a2) -
        min_r(min_r(I.a0, I.a1), I.a2)));
    real flattest = min_r(reached.a1, min_r(min_r(I.a0, I.a1), I.a2)) - R(0.25) * (half * vectors_length(u) -
        vectors_dot(k, u));
    return (reached.a0 > R(0.0) && flattest > R(0.00390625) * (max_r(max_r(I.a0, I.a1), I.a2) + D)) ? R(0.49) *
        reached.a1 : R(0.0);
}

INLINE t_p3 kernel_gibbs_residual_p12e(t_r2 u1, t_r2 u2, t_r2 u3, t_r2 k1, t_r2 k2, t_r2 k3, t_r2 g1, t_r2 g2, t_r2
    g3, t_r2 I1, t_r2 I2, t_r2 I3, real D) {
    t_r2 x1 = pairs_loose_subtract(pairs_loose_multiply(g3, u2), pairs_loose_multiply(g2, u3));
    t_r2 x2 = pairs_loose_subtract(pairs_loose_multiply(g1, u3), pairs_loose_multiply(g3, u1));
    t_r2 x3 = pairs_loose_subtract(pairs_loose_multiply(g2, u1), pairs_loose_multiply(g1, u2));
    t_r2 y1 = pairs_loose_multiply(I1, u1), y2 = pairs_loose_multiply(I2, u2), y3 = pairs_loose_multiply(I3, u3);
    t_r2 s = pairs_loose_add(pairs_loose_add_float(pairs_loose_multiply(u1, u1), 1),
        pairs_loose_add(pairs_loose_multiply(u2, u2), pairs_loose_multiply(u3, u3)));
    t_r2 o_r1 = pairs_loose_subtract(pairs_loose_add(pairs_loose_add(y1,
        pairs_loose_multiply_float(pairs_loose_subtract(pairs_loose_multiply(g2, x3), pairs_loose_multiply(g3, x2)),
        D)), pairs_loose_multiply(u2, y3)), pairs_loose_add(pairs_loose_multiply(k1, s), pairs_loose_multiply(u3,
        y2)));
    t_r2 o_r2 = pairs_loose_subtract(pairs_loose_add(pairs_loose_add(y2,
        pairs_loose_multiply_float(pairs_loose_subtract(pairs_loose_multiply(g3, x1), pairs_loose_multiply(g1, x3)),
        D)), pairs_loose_multiply(u3, y1)), pairs_loose_add(pairs_loose_multiply(k2, s), pairs_loose_multiply(u1,
        y3)));
    t_r2 o_r3 = pairs_loose_subtract(pairs_loose_add(pairs_loose_add(y3,
        pairs_loose_multiply_float(pairs_loose_subtract(pairs_loose_multiply(g1, x2), pairs_loose_multiply(g2, x1)),
        D)), pairs_loose_multiply(u1, y2)), pairs_loose_add(pairs_loose_multiply(k3, s), pairs_loose_multiply(u2,
        y1)));
    return (t_p3){o_r1, o_r2, o_r3};
}

INLINE Root proved_root_near__p3_4r6(t_p3 u, t_p3 k, t_p3 g, t_p3 I, real D, real slope, real radius, real xi, real
    k_off, real g_off) {
    t_r3 v = proved_floats__p3_(u), kf = proved_floats__p3_(k), gf = proved_floats__p3_(g);
    t_r3 If = proved_floats__p3_(I);
    real spread = R(0.5) * (max_r(max_r(If.a0, If.a1), If.a2) - min_r(min_r(If.a0, If.a1), If.a2));
    real half = proved_long(kf) * R(1.0000000000009095), size = proved_long(v);
    real most = max_r(max_r(If.a0, If.a1), If.a2) + D;
    real m = (radius == R(-2.0) ? proved_slope_at(v, kf, gf, If, D) : slope) / R(1.0000000000009095);
    real whole = R(1.0) + size * size;
    real at_root = proved_long(proved_floats__p3_(kernel_gibbs_residual_p12e(u.a0, u.a1, u.a2, k.a0, k.a1, k.a2, g.a0,
        g.a1, g.a2, I.a0, I.a1, I.a2, D)));
    real rest = at_root + R(2.524354896707238e-29) * (R(1.0) + size) * (most * size + half) +
        R(9.332636185032189e-302);
    rest = rest + (R(2.0) * D * size * g_off + whole * half * k_off);
    real shift = R(4.0) * D * size + R(2.0) * whole * half;
    real curved = (R(11.0) * D * size + R(3.0) * whole * half) * xi * xi;
    real w = m > R(0.0) ? R(1.0000000000009095) * ((rest + shift * xi + curved) / m) : R(INFINITY);
    int inside = w <= R(9.5367431640625e-07) && xi <= R(9.5367431640625e-07);
    if (radius == R(-2.0)) {
        inside = w <= R(1.4551915228366852e-11) && xi <= R(1.4551915228366852e-11) && R(2.0) * (spread + R(2.0) *
            half) * w <= m;
    }
    else { inside = inside && size * size <= radius; }
    return (Root){inside ? w : R(INFINITY), m, rest, shift, curved};
}

INLINE t__r3_3 tangent_column(t_r3 x, t_r3 u, t_r3 k, t_r3 g, real D, real det, t_r9 c) {
    t_r3 a = vectors_cross(k, x), b = vectors_cross(g, x); real length = R(1.0) + vectors_dot(u, u);
    t_r3 r = vectors_plus(vectors_plus(vectors_scaled(D * vectors_dot(g, u), b), vectors_scaled(D * vectors_dot(b, u),
        g)), vectors_scaled(length, a));
    t_r3 x1 = vectors_adjoint(c, r), d = (t_r3){x1.a0 / det, x1.a1 / det, x1.a2 / det};
    return (t__r3_3){vectors_plus(vectors_plus(x, kernel_turn(R(1.0), u.a0, u.a1, u.a2, x.a0, x.a1, x.a2)),
        vectors_scaled(R(2.0) / length, vectors_minus(d, vectors_cross(u, d)))), d, r};
}

INLINE real proved_left(t_r3 d, t_r3 r, t_r3 u, t_r3 k, t_r3 g, t_r3 I, real D) {
    t_r3 x = vectors_cross(d, (t_r3){I.a0 * u.a0, I.a1 * u.a1, I.a2 * u.a2});
    t_r3 y = vectors_cross(u, (t_r3){I.a0 * d.a0, I.a1 * d.a1, I.a2 * d.a2});
    t__r3_2 B = (t__r3_2){(t_r3){I.a0 * d.a0, I.a1 * d.a1, I.a2 * d.a2}, vectors_scaled(D, vectors_minus(d,
        vectors_scaled(vectors_dot(g, d), g)))};
    t_r3 Ad = vectors_minus(vectors_plus(vectors_plus(B.a0, B.a1), vectors_plus(x, y)), vectors_scaled(R(2.0) *
        vectors_dot(u, d), k));
    return vectors_length(vectors_minus(Ad, r));
}

INLINE t_r3 proved_unit(t_r3 v, t_r3 instead) {
    real size = vectors_length(v); int whole = size > R(0.0); real scale = whole ? R(1.0) / size : R(1.0);
    t_r3 u = vectors_scaled(scale, v);
    return (t_r3){whole ? u.a0 : instead.a0, whole ? u.a1 : instead.a1, whole ? u.a2 : instead.a2};
}

INLINE t_r3 proved_across(t_r3 v, t_r3 x) {
    t_r3 y = vectors_minus(v, vectors_scaled(vectors_dot(v, x), x));
    int far = vectors_square(y) > R(8.673617379884035e-19) * vectors_square(v), flat = R(fabs(x.a0)) < R(0.7);
    t_r3 t_1 = (t_r3){R(1.0), R(0.0), R(0.0)}, t_2 = (t_r3){R(0.0), R(1.0), R(0.0)};
    t_r3 other = (t_r3){flat ? t_1.a0 : t_2.a0, flat ? t_1.a1 : t_2.a1, flat ? t_1.a2 : t_2.a2};
    t_r3 z = vectors_minus(other, vectors_scaled(vectors_dot(other, x), x));
    return proved_unit((t_r3){far ? y.a0 : z.a0, far ? y.a1 : z.a1, far ? y.a2 : z.a2}, other);
}

OUT_OF_LINE void proved_squared(r1 box) {
    for (int64_t j = 0; j < 3; j++) {
        vectors_put(box, 0 + 3 * j, vectors_scaled(box.p[9 + j], vectors_three(box, 0 + 3 * j)));
    }
    int64_t i = 0, j = 1; t_r3 a = vectors_three(box, 0 + 3 * i), b = vectors_three(box, 0 + 3 * j);
    int swap = vectors_square(a) < vectors_square(b);
    vectors_put(box, 0 + 3 * i, (t_r3){swap ? b.a0 : a.a0, swap ? b.a1 : a.a1, swap ? b.a2 : a.a2});
    vectors_put(box, 0 + 3 * j, (t_r3){swap ? a.a0 : b.a0, swap ? a.a1 : b.a1, swap ? a.a2 : b.a2}); i = 0; j = 2;
    a = vectors_three(box, 0 + 3 * i); b = vectors_three(box, 0 + 3 * j);
    swap = vectors_square(a) < vectors_square(b);
    vectors_put(box, 0 + 3 * i, (t_r3){swap ? b.a0 : a.a0, swap ? b.a1 : a.a1, swap ? b.a2 : a.a2});
    vectors_put(box, 0 + 3 * j, (t_r3){swap ? a.a0 : b.a0, swap ? a.a1 : b.a1, swap ? a.a2 : b.a2}); i = 1; j = 2;
    a = vectors_three(box, 0 + 3 * i); b = vectors_three(box, 0 + 3 * j);
    swap = vectors_square(a) < vectors_square(b);
    vectors_put(box, 0 + 3 * i, (t_r3){swap ? b.a0 : a.a0, swap ? b.a1 : a.a1, swap ? b.a2 : a.a2});
    vectors_put(box, 0 + 3 * j, (t_r3){swap ? a.a0 : b.a0, swap ? a.a1 : b.a1, swap ? a.a2 : b.a2});
    t_r3 first = vectors_three(box, 0), second = vectors_three(box, 3), third = vectors_three(box, 6);
    t_r3 x = proved_unit(first, (t_r3){R(1.0), R(0.0), R(0.0)}), y = proved_across(second, x);
    y = proved_across(y, x); t_r3 z = vectors_cross(x, y);
    real off = R(fabs(vectors_dot(x, y))) + R(fabs(vectors_dot(x, z))) + R(fabs(vectors_dot(y, z))) +
        R(fabs(vectors_square(x) - R(1.0))) + R(fabs(vectors_square(y) - R(1.0)));
    int good = off + R(fabs(vectors_square(z) - R(1.0))) <= R(1.4210854715202004e-14);
    t_r3 t_1 = (t_r3){R(1.0), R(0.0), R(0.0)};
    x = (t_r3){good ? x.a0 : t_1.a0, good ? x.a1 : t_1.a1, good ? x.a2 : t_1.a2};
    t_r3 t_2 = (t_r3){R(0.0), R(1.0), R(0.0)};
    y = (t_r3){good ? y.a0 : t_2.a0, good ? y.a1 : t_2.a1, good ? y.a2 : t_2.a2};
    t_r3 t_3 = (t_r3){R(0.0), R(0.0), R(1.0)};
    z = (t_r3){good ? z.a0 : t_3.a0, good ? z.a1 : t_3.a1, good ? z.a2 : t_3.a2};
    real rest = box.p[12] + R(5.684341886080802e-14) * (vectors_length(first) + vectors_length(second) +
        vectors_length(third));
    j = 0; t_r3 q = x; vectors_put(box, 0 + 3 * j, q);
    box.p[9 + j] = R(1.0000000000009095) * (R(fabs(vectors_dot(q, first))) + R(fabs(vectors_dot(q, second))) +
        R(fabs(vectors_dot(q, third))) + rest);
    j = 1; q = y; vectors_put(box, 0 + 3 * j, q);
    box.p[9 + j] = R(1.0000000000009095) * (R(fabs(vectors_dot(q, first))) + R(fabs(vectors_dot(q, second))) +
        R(fabs(vectors_dot(q, third))) + rest);
    j = 2; q = z; vectors_put(box, 0 + 3 * j, q);
    box.p[9 + j] = R(1.0000000000009095) * (R(fabs(vectors_dot(q, first))) + R(fabs(vectors_dot(q, second))) +
        R(fabs(vectors_dot(q, third))) + rest);
    box.p[12] = R(0.0);
}

INLINE void proved_carried_r1_p3_4r3(r1 box, t_p3 u, t_p3 k, t_p3 g, t_p3 I, real D, real slope, real radius) {
    t_r3 c; real b, rounded, solved; t__r3_3 y;
    t_r3 v = proved_floats__p3_(u), kf = proved_floats__p3_(k), gf = proved_floats__p3_(g);
    t_r3 If = proved_floats__p3_(I); real xi = proved_extent(box);
    Root root = proved_root_near__p3_4r6(u, k, g, I, D, slope, radius, xi, box.p[13] + R(3.1554436208840472e-30),
        box.p[14]);
    real w = root.w, m = root.m, shift = root.shift;
    real spread = R(0.5) * (max_r(max_r(If.a0, If.a1), If.a2) - min_r(min_r(If.a0, If.a1), If.a2));
    real half = vectors_length(kf), size = vectors_length(v), most = max_r(max_r(If.a0, If.a1), If.a2) + D;
    real off = R(2.0) * (D * box.p[14] + half * size * box.p[13]);
    real steeper = (spread + half) * w + R(5.0) * (half * size + D) * xi + R(1.4210854715202004e-14) * (most + half) *
        (R(1.0) + size) + off;
    if (w == R(INFINITY) || !(steeper < R(0.5) * m)) { box.p[12] = R(INFINITY); return; }
    t_r13 found = kernel_gibbs_newton(v.a0, v.a1, v.a2, kf.a0, kf.a1, kf.a2, gf.a0, gf.a1, gf.a2, If.a0, If.a1, If.a2,
        D);
    real moved = R(0.0), lost = R(0.0);
    for (int64_t j = 0; j < 3; j++) {
        c = vectors_three(box, 0 + 3 * j); b = box.p[9 + j];
        y = tangent_column(c, v, kf, gf, D, found.a0, (t_r9){found.a4, found.a5, found.a6, found.a7, found.a8,
            found.a9, found.a10, found.a11, found.a12});
        vectors_put(box, 0 + 3 * j, y.a0);
        rounded = R(1.4210854715202004e-14) * (R(1.0) + size) * ((most + half) * vectors_length(y.a1) + shift *
            vectors_length(c));
        solved = R(2.0) * (proved_left(y.a1, y.a2, v, kf, gf, If, D) + rounded) / m;
        moved = moved + b * (R(2.0) * vectors_length(y.a1) + solved);
        lost = lost + b * (solved + R(1.4210854715202004e-14) * (vectors_length(c) + vectors_length(y.a1)));
    }
    w = min_r(w, R(1.0000000000009095) * (((root.rest + root.curved + shift * box.p[12]) / m + moved) / (R(1.0) -
        steeper / m)));
    real more = (root.rest + root.curved + steeper * w) / m + R(8.0) * w * (xi + w) + R(1.4210854715202004e-14) *
        (R(1.0) + size) * (xi + w);
    box.p[12] = R(1.0000000000009095) * ((R(1.0) + shift / m) * box.p[12] + (more + lost));
    box.p[13] = R(1.0000000000009095) * (box.p[13] + R(2.524354896707238e-29) * size + R(3.1554436208840472e-30));
    box.p[14] = R(1.0000000000009095) * (box.p[14] + R(2.524354896707238e-29) * size + R(3.1554436208840472e-30));
    box.p[15] = R(1.0000000000009095) * (box.p[15] + R(2.524354896707238e-29));
    box.p[16] = R(1.0000000000009095) * (box.p[16] + R(3.0) * w + size * (R(10.0) * xi + R(8.0) * (box.p[15] +
        box.p[14] + R(2.524354896707238e-29))));
    box.p[17] = box.p[17] + R(1.0);
    if (mod_i((int64_t)box.p[17], 8) == 0 || shift > R(0.5) * m) { proved_squared(box); }
}

INLINE t_p3 kernel_centre_step_p7(t_r2 q0, t_r2 q1, t_r2 q2, t_r2 q3, t_r2 g1, t_r2 g2, t_r2 g3) {
    t_r2 t0 = (t_r2){2 * q0.a0, 2 * q0.a1};
    t_r2 o_s1 = pairs_loose_multiply(t0, pairs_loose_subtract(pairs_loose_multiply(g3, q2), pairs_loose_multiply(g2,
        q3)));
    t_r2 o_s2 = pairs_loose_multiply((t_r2){-t0.a0, -t0.a1}, pairs_loose_subtract(pairs_loose_multiply(g3, q1),
        pairs_loose_multiply(g1, q3)));
    t_r2 o_s3 = pairs_loose_multiply(t0, pairs_loose_subtract(pairs_loose_multiply(g2, q1), pairs_loose_multiply(g1,
        q2)));
    return (t_p3){o_s1, o_s2, o_s3};
}

INLINE t_p3 kernel_rotate_p7(t_r2 q0, t_r2 q1, t_r2 q2, t_r2 q3, t_r2 v1, t_r2 v2, t_r2 v3) {
    t_r2 t0 = pairs_loose_multiply(q2, q2), t1 = pairs_loose_multiply(q3, q3), t2 = (t_r2){2 * v1.a0, 2 * v1.a1};
    t_r2 t3 = pairs_loose_multiply(q0, q2), t4 = pairs_loose_multiply(q1, q3), t5 = pairs_loose_multiply(q0, q3);
    t_r2 t6 = pairs_loose_multiply(q1, q2), t7 = (t_r2){2 * v2.a0, 2 * v2.a1}, t8 = pairs_loose_multiply(q1, q1);
    t_r2 t9 = pairs_loose_multiply(q0, q1), t10 = pairs_loose_multiply(q2, q3), t11 = (t_r2){2 * v3.a0, 2 * v3.a1};
    t_r2 o_x1 = pairs_loose_subtract(pairs_loose_add(v1, pairs_loose_multiply((t_r2){2 * v3.a0, 2 * v3.a1},
        pairs_loose_add(t3, t4))), pairs_loose_add(pairs_loose_multiply(t2, pairs_loose_add(t0, t1)),
        pairs_loose_multiply(t7, pairs_loose_subtract(t5, t6))));
    t_r2 o_x2 = pairs_loose_subtract(pairs_loose_add(v2, pairs_loose_multiply(t2, pairs_loose_add(t5, t6))),
        pairs_loose_add(pairs_loose_multiply(t11, pairs_loose_subtract(t9, t10)), pairs_loose_multiply(t7,
        pairs_loose_add(t1, t8))));
    t_r2 o_x3 = pairs_loose_subtract(pairs_loose_add(v3, pairs_loose_multiply((t_r2){2 * v2.a0, 2 * v2.a1},
        pairs_loose_add(t10, t9))), pairs_loose_add(pairs_loose_multiply(t11, pairs_loose_add(t0, t8)),
        pairs_loose_multiply(t2, pairs_loose_subtract(t3, t4))));
    return (t_p3){o_x1, o_x2, o_x3};
}

INLINE t_p4 kernel_compose_p8(t_r2 a0, t_r2 a1, t_r2 a2, t_r2 a3, t_r2 b0, t_r2 b1, t_r2 b2, t_r2 b3) {
    t_r2 o_c0 = pairs_loose_subtract(pairs_loose_subtract(pairs_loose_multiply(a0, b0), pairs_loose_multiply(a1, b1)),
        pairs_loose_add(pairs_loose_multiply(a2, b2), pairs_loose_multiply(a3, b3)));
    t_r2 o_c1 = pairs_loose_add(pairs_loose_add(pairs_loose_multiply(a0, b1), pairs_loose_multiply(a1, b0)),
        pairs_loose_subtract(pairs_loose_multiply(a2, b3), pairs_loose_multiply(a3, b2)));
    t_r2 o_c2 = pairs_loose_add(pairs_loose_add(pairs_loose_multiply(a0, b2), pairs_loose_multiply(a2, b0)),
        pairs_loose_subtract(pairs_loose_multiply(a3, b1), pairs_loose_multiply(a1, b3)));
    t_r2 o_c3 = pairs_loose_add(pairs_loose_add(pairs_loose_multiply(a0, b3), pairs_loose_multiply(a1, b2)),
        pairs_loose_subtract(pairs_loose_multiply(a3, b0), pairs_loose_multiply(a2, b1)));
    return (t_p4){o_c0, o_c1, o_c2, o_c3};
}

INLINE t__p4_p2 double_double_rolled__p3_2_p4_p2r(t_p3 u, t_p3 g, t_p4 a, t_r2 x, t_r2 y, real rho) {
    t_r2 t_1 = pairs_loose_add_float(vectors_dot__p3_2(u, u), R(1.0));
    t_r2 t_2 = pairs_root(pairs_two_sum(t_1.a0, t_1.a1));
    t_r2 q0 = pairs_divide((t_r2){R(1.0), 0}, pairs_two_sum(t_2.a0, t_2.a1));
    t_p3 q = vectors_scaled_p_p3_(q0, u), t_3 = kernel_centre_step_p7(q0, q.a0, q.a1, q.a2, g.a0, g.a1, g.a2);
    t_p3 d1 = kernel_rotate_p7(a.a0, a.a1, a.a2, a.a3, t_3.a0, t_3.a1, t_3.a2);
    t_p4 turned = double_double_normalised_four__p4_(double_double_of_length_one__p4_(kernel_compose_p8(a.a0, a.a1,
        a.a2, a.a3, q0, q.a0, q.a1, q.a2)));
    t_r2 t_4 = pairs_loose_add(x, pairs_loose_multiply_float(d1.a0, rho));
    t_r2 t_5 = pairs_loose_add(y, pairs_loose_multiply_float(d1.a1, rho));
    return (t__p4_p2){turned, pairs_two_sum(t_4.a0, t_4.a1), pairs_two_sum(t_5.a0, t_5.a1)};
}

INLINE void double_double_follow_body__p3_r13r(t_p3 u, r1 state, r1 attitude, r1 contact, real rho) {
    t_p4 a = (t_p4){double_double_pair(attitude, 0), double_double_pair(attitude, 2), double_double_pair(attitude, 4),
        double_double_pair(attitude, 6)};
    t__p4_p2 b = double_double_rolled__p3_2_p4_p2r(u, double_double_three_pairs(state, 6), a,
        double_double_pair(contact, 0), double_double_pair(contact, 2), rho);
    double_double_put_pair_r1ip(attitude, 0, b.a0.a0);
    double_double_put_pairs_r1i_p3_(attitude, 2, (t_p3){b.a0.a1, b.a0.a2, b.a0.a3});
    double_double_put_pair_r1ip(contact, 0, b.a1); double_double_put_pair_r1ip(contact, 2, b.a2);
}

INLINE t_p3 kernel_turn_1p6(t_r2 p1, t_r2 p2, t_r2 p3, t_r2 v1, t_r2 v2, t_r2 v3) {
    t_r2 t_1 = pairs_loose_add(pairs_loose_add_float(pairs_loose_multiply(p1, p1), 1),
        pairs_loose_add(pairs_loose_multiply(p2, p2), pairs_loose_multiply(p3, p3)));
    t_r2 s = pairs_divide((t_r2){2, 0}, pairs_two_sum(t_1.a0, t_1.a1));
    t_r2 x1 = pairs_loose_subtract(pairs_loose_multiply(p2, v3), pairs_loose_multiply(p3, v2));
    t_r2 x2 = pairs_loose_subtract(pairs_loose_multiply(p3, v1), pairs_loose_multiply(p1, v3));
    t_r2 x3 = pairs_loose_subtract(pairs_loose_multiply(p1, v2), pairs_loose_multiply(p2, v1));
    t_r2 o_x1 = pairs_loose_multiply(s, pairs_loose_subtract(pairs_loose_subtract(pairs_loose_multiply(p2, x3), x1),
        pairs_loose_multiply(p3, x2)));
    t_r2 o_x2 = pairs_loose_multiply(s, pairs_loose_subtract(pairs_loose_subtract(pairs_loose_multiply(p3, x1), x2),
        pairs_loose_multiply(p1, x3)));
    t_r2 o_x3 = pairs_loose_multiply(s, pairs_loose_subtract(pairs_loose_subtract(pairs_loose_multiply(p1, x2), x3),
        pairs_loose_multiply(p2, x1)));
    return (t_p3){o_x1, o_x2, o_x3};
}

INLINE t_p3 double_double_turned__p3_2(t_p3 u, t_p3 v) {
    return double_double_normalised__p3_(vectors_plus__p3_2(v, kernel_turn_1p6(u.a0, u.a1, u.a2, v.a0, v.a1, v.a2)));
}

INLINE t_r2 pairs_add(t_r2 a, t_r2 b) {
    t_r2 t_1 = pairs_two_sum(a.a0, b.a0); real s = t_1.a0, s_ = t_1.a1;
    t_r2 t = pairs_two_sum(a.a1, b.a1), t_2 = pairs_quick_two_sum(s, s_ + t.a0); s = t_2.a0; s_ = t_2.a1;
    return pairs_quick_two_sum(s, t.a1 + s_);
}

INLINE t_r2 pairs_subtract(t_r2 a, t_r2 b) { return pairs_add(a, (t_r2){-b.a0, -b.a1}); }
OUT_OF_LINE t_r2 double_double_restore_pairs(r1 state) {
    t_r2 x, y; t_p3 k = double_double_three_pairs(state, 0), g = double_double_three_pairs(state, 6);
    t_p3 h = double_double_three_pairs(state, 22);
    t_p3 now = double_double_normalised__p3_((t_p3){vectors_dot__p3_2(g, g), vectors_dot__p3_2(k, g),
        vectors_dot__p3_2(k, k)});
    t_r2 unit = pairs_subtract(h.a0, now.a0), height = pairs_subtract(h.a1, now.a1);
    t_r2 squared = pairs_subtract(h.a2, now.a2);
    t_r3 stretch = integrals_shares(unit.a0, height.a0, squared.a0, h.a0.a0, h.a1.a0, h.a2.a0);
    for (int64_t i = 0; i < 6; i += 2) {
        x = double_double_pair(state, 0 + i); y = double_double_pair(state, 6 + i);
        t_r2 t_1 = pairs_two_sum(x.a0, x.a1 + (stretch.a1 * x.a0 + stretch.a2 * y.a0));
        double_double_put_pair_r1ip(state, 0 + i, (t_r2){t_1.a0, t_1.a1});
        t_r2 t_2 = pairs_two_sum(y.a0, y.a1 + stretch.a0 * y.a0);
        double_double_put_pair_r1ip(state, 6 + i, (t_r2){t_2.a0, t_2.a1});
    }
    return (t_r2){R(fabs(stretch.a0)), R(fabs(stretch.a1)) + R(fabs(stretch.a2)) /
        max_r(vectors_length(double_double_highs__p3_(k)), R(1e-300))};
}

INLINE void proved_write_spread(r1 row, r1 box) {
    real xi = proved_extent(box); row.p[0] = R(1.0000000000009095) * (R(2.0) * xi + R(3.0) * xi * xi + box.p[13]);
    row.p[1] = R(1.0000000000009095) * (R(2.0) * xi + R(3.0) * xi * xi + box.p[14]);
    row.p[2] = R(1.0000000000009095) * (xi + box.p[15]); row.p[3] = xi < R(INFINITY) ? box.p[16] : R(INFINITY);
}

INLINE void double_double_write(r1 frame, r1 frame_, r1 pairs, int64_t at, int64_t exponent) {
    for (int64_t i = 0, end_i = frame.n0; i < end_i; i++) {
        frame.p[i] = R(ldexp(pairs.p[at + 2 * i], (int)exponent));
        frame_.p[i] = R(ldexp(pairs.p[at + 2 * i + 1], (int)exponent));
    }
}

INLINE t_i2r double_double_march_pairs(Moving ball, r2 c, Steps steps, int64_t shift, int64_t beyond, Track track,
    Track low, Proof proof) {
    r2 past; t_ir_p3_ status; t_p3 k, g, inertia, part; t_r2 stretched; int64_t frame; r1 state = ball.state;
    r2 slopes = proof.slopes; r1 box = proof.box; int proves = proof.spread.n0 > 0;
    int64_t period = max_i(1, div_i(1024, c.n0));
    for (int64_t step = steps.first + 1, end_step = steps.last + 1; step < end_step; step++) {
        for (int64_t i = 0, end_i = c.n0; i < end_i; i++) {
            past = r2_part(ball.past, 8 * i, 8 * i + 8);
            status = double_double_stage_r1pr2r2(state, (t_r2){AT2(c, i, 0), AT2(c, i, 1)}, AT2(ball.limits, 0, i),
                AT2(ball.limits, 1, i), past);
            if (status.a0 != 0) { return (t_i2r){step - 1 - steps.first, status.a0, status.a1}; }
            if (proves) {
                k = double_double_three_pairs(state, 0); g = double_double_three_pairs(state, 6);
                inertia = double_double_three_pairs(state, 12);
                part = double_double_normalised__p3_(vectors_scaled_p_p3_((t_r2){AT2(c, i, 0), AT2(c, i, 1)}, k));
                proved_carried_r1_p3_4r3(box, status.a2, part, g, inertia, state.p[21], AT2(slopes, i, 0), AT2(slopes,
                    i, 1));
            }
            if (track.follows) {
                double_double_follow_body__p3_r13r(status.a2, state, ball.attitude, ball.contact, ball.radius);
            }
            double_double_put_pairs_r1i_p3_(state, 0, double_double_turned__p3_2(status.a2,
                double_double_three_pairs(state, 0)));
            double_double_put_pairs_r1i_p3_(state, 6, double_double_turned__p3_2(status.a2,
                double_double_three_pairs(state, 6)));
        }
        if (mod_i(step, period) == 0) {
            stretched = double_double_restore_pairs(state);
            if (proves) {
                real t_1 = box.p[13] + R(2.0) * stretched.a1, t_2 = box.p[14] + R(2.0) * stretched.a0;
                box.p[13] = t_1; box.p[14] = t_2;
            }
        }
        if (mod_i(step, steps.every) == 0) {
            frame = div_i(step, steps.every);
            if (proves) { proved_write_spread(r2_row(proof.spread, frame), box); }
            double_double_write(r2_row(track.momenta, frame), r2_row(low.momenta, frame), state, 0, -shift);
            double_double_write(r2_row(track.verticals, frame), r2_row(low.verticals, frame), state, 6, 0);
            if (track.follows) {
                double_double_write(r2_row(track.attitudes, frame), r2_row(low.attitudes, frame), ball.attitude, 0,
                    0);
                double_double_write(r2_row(track.traces, frame), r2_row(low.traces, frame), ball.contact, 0, -beyond);
            }
        }
    }
    return (t_i2r){steps.last - steps.first, 0, R(1.0)};
}

INLINE void double_double_prepare_pairs_block(Start start, r2 c, r2 state, i1 shift, i1 beyond) {
    int64_t i; ALIGNED real one_[28]; r1 one = {one_, 28}; ALIGNED real limits_[2 * 1];
    r2 limits = {limits_, 2, 1, 1}; int64_t last = start.contact.n0 - 1;
    for (int64_t lane = 0, end_lane = state.n1; lane < end_lane; lane++) {
        i = min_i(lane, last);
        t_i2 t_1 = double_double_prepare_pairs(r2_row(start.momentum, i), r2_row(start.gamma, i), r2_row(start.tensor,
            i), start.contact.p[i], c, one, limits);
        shift.p[i] = t_1.a0; beyond.p[i] = t_1.a1;
        for (int64_t row = 0; row < 52; row++) { AT2(state, row, lane) = row < 28 ? one.p[row] : R(0.0); }
        AT2(state, 52, lane) = AT2(limits, 0, 0); AT2(state, 53, lane) = AT2(limits, 1, 0);
    }
}

INLINE t_p3 double_double_pairs_in(r2 S, int64_t at, int64_t i) {
    return (t_p3){(t_r2){AT2(S, at, i), AT2(S, at + 1, i)}, (t_r2){AT2(S, at + 2, i), AT2(S, at + 3, i)},
        (t_r2){AT2(S, at + 4, i), AT2(S, at + 5, i)}};
}

INLINE int64_t double_double_approached(r2 S, r2 P, i1 ok, int again) {
    real radius; t_r3 u, k, g, inertia; Round r; int done; t_r9 c; int64_t bad = 0;
    INDEPENDENT for (int64_t i = 0; i < 16; i++) {
        radius = AT2(S, 52, i); t_r3 t_1 = vectors_three_in(P, 0, i), t_2 = vectors_three_in(S, 28, i);
        u = (t_r3){again ? t_1.a0 : t_2.a0, again ? t_1.a1 : t_2.a1, again ? t_1.a2 : t_2.a2};
        int t_3 = vectors_square(u) <= radius; t_r3 t_4 = (t_r3){R(0.0), R(0.0), R(0.0)};
        u = (t_r3){t_3 ? u.a0 : t_4.a0, t_3 ? u.a1 : t_4.a1, t_3 ? u.a2 : t_4.a2};
        k = double_double_highs__p3_(double_double_pairs_in(S, 0, i));
        g = double_double_highs__p3_(double_double_pairs_in(S, 6, i));
        inertia = double_double_highs__p3_(double_double_pairs_in(S, 12, i));
        r = gibbs_newton_round(u, k, g, inertia, AT2(S, 21, i), 0); done = again & (ok.p[i] == 1); c = r.cofactors;
        t_r3 t_5 = vectors_three_in(P, 0, i);
        vectors_put_in(P, 0, i, (t_r3){done ? t_5.a0 : r.w.a0, done ? t_5.a1 : r.w.a1, done ? t_5.a2 : r.w.a2});
        t_r3 t_6 = vectors_three_in(P, 3, i);
        vectors_put_in(P, 3, i, (t_r3){done ? t_6.a0 : r.d.a0, done ? t_6.a1 : r.d.a1, done ? t_6.a2 : r.d.a2});
        t_r3 t_7 = vectors_three_in(P, 7, i), t_8 = (t_r3){c.a0, c.a1, c.a2};
        vectors_put_in(P, 7, i, (t_r3){done ? t_7.a0 : t_8.a0, done ? t_7.a1 : t_8.a1, done ? t_7.a2 : t_8.a2});
        t_r3 t_9 = vectors_three_in(P, 10, i), t_10 = (t_r3){c.a3, c.a4, c.a5};
        vectors_put_in(P, 10, i, (t_r3){done ? t_9.a0 : t_10.a0, done ? t_9.a1 : t_10.a1, done ? t_9.a2 : t_10.a2});
        t_r3 t_11 = vectors_three_in(P, 13, i), t_12 = (t_r3){c.a6, c.a7, c.a8};
        vectors_put_in(P, 13, i, (t_r3){done ? t_11.a0 : t_12.a0, done ? t_11.a1 : t_12.a1, done ? t_11.a2 :
            t_12.a2});
        AT2(P, 6, i) = done ? AT2(P, 6, i) : r.p.a0;
        ok.p[i] = (done | ((radius >= R(0.0)) & (r.first <= AT2(S, 53, i)))) ? 1 : 0;
        bad = bad + (radius >= R(0.0) ? 1 - ok.p[i] : 0);
    }
    return bad;
}

INLINE void double_double_residuals(r2 S, r2 P) {
    t_e3 w; real contact; t_p3 k, g, inertia;
    INDEPENDENT for (int64_t i = 0; i < 16; i++) {
        w = proved_exact(vectors_three_in(P, 0, i)); contact = AT2(S, 21, i); k = double_double_pairs_in(S, 0, i);
        g = double_double_pairs_in(S, 6, i); inertia = double_double_pairs_in(S, 12, i);
        vectors_put_in(P, 16, i,
            double_double_highs__p3_(double_double_normalised__p3_(kernel_gibbs_residual_e3p9e(w.a0, w.a1, w.a2, k.a0,
            k.a1, k.a2, g.a0, g.a1, g.a2, inertia.a0, inertia.a1, inertia.a2, contact))));
    }
}

INLINE int64_t double_double_corrected(r2 S, r2 P, i1 ok) {
    t_r9 c; t_r3 k, inertia, e; int64_t bad = 0;
    INDEPENDENT for (int64_t i = 0; i < 16; i++) {
        t_r3 t_1 = vectors_three_in(P, 7, i), t_2 = vectors_three_in(P, 10, i), t_3 = vectors_three_in(P, 13, i);
        c = (t_r9){t_1.a0, t_1.a1, t_1.a2, t_2.a0, t_2.a1, t_2.a2, t_3.a0, t_3.a1, t_3.a2};
        k = double_double_highs__p3_(double_double_pairs_in(S, 0, i));
        inertia = double_double_highs__p3_(double_double_pairs_in(S, 12, i));
        e = gibbs_correction(AT2(P, 6, i), vectors_three_in(P, 3, i), c, vectors_three_in(P, 16, i), k, inertia);
        vectors_put_in(P, 19, i, e);
        ok.p[i] = ((ok.p[i] == 1) & double_double_small(vectors_three_in(P, 0, i), e)) ? 1 : 0;
        bad = bad + (1 - ok.p[i]);
    }
    return bad;
}

INLINE t_r3 double_double_lows__p3_(t_p3 v) { return (t_r3){v.a0.a1, v.a1.a1, v.a2.a1}; }
OUT_OF_LINE void double_double_mend(r2 S, r2 P, i1 ok, int64_t step, Ends ends) {
    t_r2 one; t_p3 u;
    for (int64_t i = 0; i < 16; i++) {
        if (ok.p[i] == 1) { continue; }
        vectors_put_in(P, 0, i, (t_r3){R(0.0), R(0.0), R(0.0)});
        vectors_put_in(P, 19, i, (t_r3){R(0.0), R(0.0), R(0.0)});
        if (i < ends.status.n0 && ends.status.p[i] == 0) {
            real s_[S.n0]; r1 s = {s_, S.n0};
            for (int64_t i_ = 0; i_ < S.n0; i_++) { s_[i_] = AT2(S, i_, i); }
            one = (t_r2){R(1.0), R(0.0)};
            t_ir_p3_ t_1 = double_double_stage_r1pr2r2(s, one, s.p[52], s.p[53], (r2){r1_part(s, 28, 52).p, 8, 3, 3});
            ends.status.p[i] = t_1.a0; ends.reach.p[i] = t_1.a1; u = t_1.a2;
            if (ends.status.p[i] == 0) {
                vectors_put_in(P, 0, i, double_double_highs__p3_(u));
                vectors_put_in(P, 19, i, double_double_lows__p3_(u)); continue;
            }
            ends.taken.p[i] = step;
        }
        AT2(S, 52, i) = R(-1.0);
    }
}

INLINE void double_double_put_pairs_in_r2i2_p3_(r2 S, int64_t at, int64_t i, t_p3 v) {
    vectors_put_in(S, at, i, (t_r3){v.a0.a0, v.a0.a1, v.a1.a0});
    vectors_put_in(S, at + 3, i, (t_r3){v.a1.a1, v.a2.a0, v.a2.a1});
}

INLINE void double_double_extrapolated_in(r2 S, int64_t row, int64_t i, real w) {
    t_r8 t_1 = integrals_filtered(AT2(S, row + 3, i), AT2(S, row + 6, i), AT2(S, row + 9, i), AT2(S, row + 12, i),
        AT2(S, row + 15, i), AT2(S, row + 18, i), AT2(S, row + 21, i), w);
    AT2(S, row, i) = t_1.a0; AT2(S, row + 3, i) = t_1.a1; AT2(S, row + 6, i) = t_1.a2; AT2(S, row + 9, i) = t_1.a3;
    AT2(S, row + 12, i) = t_1.a4; AT2(S, row + 15, i) = t_1.a5; AT2(S, row + 18, i) = t_1.a6;
    AT2(S, row + 21, i) = t_1.a7;
}

INLINE void double_double_all_turned(r2 S, r2 P) {
    t_r3 w, e; t_p3 u;
    INDEPENDENT for (int64_t i = 0; i < 16; i++) {
        w = vectors_three_in(P, 0, i); e = vectors_three_in(P, 19, i); u = double_double_summed(w, e);
        double_double_put_pairs_in_r2i2_p3_(S, 0, i, double_double_turned__p3_2(u, double_double_pairs_in(S, 0, i)));
        double_double_put_pairs_in_r2i2_p3_(S, 6, i, double_double_turned__p3_2(u, double_double_pairs_in(S, 6, i)));
        double_double_extrapolated_in(S, 28, i, w.a0 + e.a0); double_double_extrapolated_in(S, 29, i, w.a1 + e.a1);
        double_double_extrapolated_in(S, 30, i, w.a2 + e.a2);
    }
}

INLINE void double_double_march_pairs_block(r2 state, Steps steps, i1 shift, Frames frames, Frames low, Ends ends) {
    int64_t bad, rounds, frame; i1 status = ends.status; ALIGNED real S_[54 * 16]; r2 S = {S_, 54, 16, 16};
    ALIGNED real P_[22 * 16]; r2 P = {P_, 22, 16, 16}; ALIGNED int64_t ok_[16]; i1 ok = {ok_, 16};
    block_carry(state, S, 16);
    for (int64_t step = steps.first, end_step = steps.last; step < end_step; step++) {
        bad = double_double_approached(S, P, ok, 0); rounds = 1;
        while (bad != 0 && rounds < 4) { bad = double_double_approached(S, P, ok, 1); rounds = rounds + 1; }
        double_double_residuals(S, P);
        if (double_double_corrected(S, P, ok) != 0) { double_double_mend(S, P, ok, step, ends); }
        double_double_all_turned(S, P);
        if (mod_i(step + 1, 1024) == 0) {
            for (int64_t i = 0; i < 16; i++) {
                real one_[28]; r1 one = {one_, 28};
                for (int64_t i_ = 0; i_ < 28; i_++) { one_[i_] = AT2(S, i_, i); }
                double_double_restore_pairs(one);
                for (int64_t row = 0; row < 28; row++) { AT2(S, row, i) = one.p[row]; }
            }
        }
        if (mod_i(step + 1, steps.every) == 0) {
            frame = div_i(step + 1, steps.every);
            for (int64_t i = 0, end_i = status.n0; i < end_i; i++) {
                if (status.p[i] == 0) {
                    real one_[S.n0]; r1 one = {one_, S.n0};
                    for (int64_t i_ = 0; i_ < S.n0; i_++) { one_[i_] = AT2(S, i_, i); }
                    double_double_write(r2_row(r3_row(frames.momenta, i), frame), r2_row(r3_row(low.momenta, i),
                        frame), one, 0, -(int64_t)shift.p[i]);
                    double_double_write(r2_row(r3_row(frames.verticals, i), frame), r2_row(r3_row(low.verticals, i),
                        frame), one, 6, 0);
                }
            }
        }
    }
    for (int64_t i = 0, end_i = status.n0; i < end_i; i++) {
        if (status.p[i] == 0) { ends.taken.p[i] = steps.last; }
    }
    block_carry(S, state, 16);
}

INLINE t_p3 double_double_rotated__p4__p3_(t_p4 a, t_p3 v) {
    return double_double_normalised__p3_(kernel_rotate_p7(a.a0, a.a1, a.a2, a.a3, v.a0, v.a1, v.a2));
}

INLINE t_p4 vectors_conjugate__p4_(t_p4 q) {
    return (t_p4){q.a0, (t_r2){-q.a1.a0, -q.a1.a1}, (t_r2){-q.a2.a0, -q.a2.a1}, (t_r2){-q.a3.a0, -q.a3.a1}};
}

INLINE t_ir_p4_p2 double_double_column__p3_2_p4_ir1r3(t_p3 k, t_p3 g, t_p4 a, int64_t n, r1 state, real radius, real
    enough, real rho) {
    t_p3 w; t_p3 inertia = double_double_three_pairs(state, 12); t_r3 tensor = vectors_three(state, 18);
    real contact = state.p[21]; t_r2 x = (t_r2){R(0.0), R(0.0)}, y = (t_r2){R(0.0), R(0.0)};
    t_r3 t_1 = double_double_highs__p3_(k), t_2 = double_double_highs__p3_(g);
    t_r3 u = kernel_angular_velocity(t_1.a0, t_1.a1, t_1.a2, t_2.a0, t_2.a1, t_2.a2, tensor.a0, tensor.a1, tensor.a2,
        contact);
    t_r3 v = u; int64_t status = 0; real reach = R(1.0);
    for (int64_t i_0 = 0, end_i_0 = n; i_0 < end_i_0; i_0++) {
        t_ir_p3_ t_3 = double_double_solved__r3__p3_3_r3_r3(u, k, g, inertia, tensor, contact, radius, enough);
        status = t_3.a0; reach = t_3.a1; w = t_3.a2;
        if (status != 0) { break; }
        t__p4_p2 t_4 = double_double_rolled__p3_2_p4_p2r(w, g, a, x, y, rho); a = t_4.a0; x = t_4.a1; y = t_4.a2;
        k = double_double_turned__p3_2(w, k); g = double_double_turned__p3_2(w, g);
        u = vectors_minus(vectors_scaled(R(2.0), double_double_highs__p3_(w)), v); v = double_double_highs__p3_(w);
    }
    return (t_ir_p4_p2){status, reach, a, x, y};
}

INLINE t_r2 double_double_with_share_p3(t_r2 total, t_r2 weight, t_r2 x) {
    t_r2 t_1 = pairs_loose_multiply(weight, x), t_2 = pairs_loose_add(total, pairs_two_sum(t_1.a0, t_1.a1));
    return pairs_two_sum(t_2.a0, t_2.a1);
}

INLINE t_p4 double_double_with_shares__p4_p_p4_(t_p4 total, t_r2 weight, t_p4 q) {
    return (t_p4){double_double_with_share_p3(total.a0, weight, q.a0), double_double_with_share_p3(total.a1, weight,
        q.a1), double_double_with_share_p3(total.a2, weight, q.a2), double_double_with_share_p3(total.a3, weight,
        q.a3)};
}

INLINE t_r2 vectors_dot_four__p4_2(t_p4 a, t_p4 b) {
    return pairs_loose_add(pairs_loose_add(pairs_loose_add(pairs_loose_multiply(a.a0, b.a0),
        pairs_loose_multiply(a.a1, b.a1)), pairs_loose_multiply(a.a2, b.a2)), pairs_loose_multiply(a.a3, b.a3));
}

INLINE t_i2r2 double_double_march_long_pairs(Still ball, real h, real h_, r2 weights, Steps steps, r1 body, Track
    track, Track low) {
    t_p4 sums, changes; t_r2 x_, y_, f, weight, change, length; t_p3 k_body, g_body; int64_t n, frame;
    t_ir_p4_p2 status; int64_t columns = weights.n0; real doubt = R(0.0); t_r2 zero = (t_r2){R(0.0), R(0.0)};
    ALIGNED real state_[28]; memset(state_, 0, sizeof state_); r1 state = {state_, 28}; ALIGNED real one_[1 * 2];
    memset(one_, 0, sizeof one_); r2 one = {one_, 1, 2, 2}; ALIGNED real limits_[2 * columns];
    memset(limits_, 0, sizeof limits_); r2 limits = {limits_, 2, columns, columns}; AT2(one, 0, 0) = R(1.0);
    t_ri size = real_frexp(vectors_largest(vectors_three(ball.momentum, 0))), mantissa = real_frexp(h);
    t_r3 k = vectors_shifted(vectors_three(ball.momentum, 0), -size.a1); ALIGNED real part_[3];
    memset(part_, 0, sizeof part_); r1 part = {part_, 3};
    vectors_put(part, 0, vectors_shifted(k, min_i(size.a1 + mantissa.a1, 1000)));
    t_i2 shift = double_double_prepare_pairs(part, ball.gamma, ball.tensor, ball.contact, one, state, limits);
    real half = R(ldexp(mantissa.a0, (int)min_i(size.a1 + mantissa.a1 + shift.a0, 100)));
    real half_ = R(ldexp(R(ldexp(h_, (int)-mantissa.a1)), (int)min_i(size.a1 + mantissa.a1 + shift.a0, 100)));
    for (int64_t j = 0, end_j = columns; j < end_j; j++) {
        t_r2 t_1 = double_double_bounds(vectors_scaled(half / (3 + j), k),
            double_double_highs__p3_(double_double_three_pairs(state, 12)), state.p[21]);
        AT2(limits, 0, j) = t_1.a0; AT2(limits, 1, j) = t_1.a1;
    }
    t_p4 a = (t_p4){double_double_pair(ball.attitude, 0), double_double_pair(ball.attitude, 2),
        double_double_pair(ball.attitude, 4), double_double_pair(ball.attitude, 6)};
    t_p3 K_ = double_double_rotated__p4__p3_(a, (t_p3){(t_r2){k.a0, R(0.0)}, (t_r2){k.a1, R(0.0)}, (t_r2){k.a2,
        R(0.0)}});
    t_p3 g_ = double_double_rotated__p4__p3_(a, double_double_three_pairs(state, 6));
    a = (t_p4){double_double_pair(body, 0), double_double_pair(body, 2), double_double_pair(body, 4),
        double_double_pair(body, 6)};
    t_r2 x = double_double_pair(body, 8), y = double_double_pair(body, 10);
    for (int64_t step = steps.first, end_step = steps.last; step < end_step; step++) {
        sums = (t_p4){zero, zero, zero, zero}; changes = (t_p4){zero, zero, zero, zero}; x_ = zero; y_ = zero;
        k_body = double_double_rotated__p4__p3_(vectors_conjugate__p4_(a), K_);
        g_body = double_double_rotated__p4__p3_(vectors_conjugate__p4_(a), g_);
        for (int64_t j = 0, end_j = columns; j < end_j; j++) {
            n = 3 + j; f = pairs_divide((t_r2){half, half_}, (t_r2){n * R(1.0), 0});
            status = double_double_column__p3_2_p4_ir1r3(double_double_normalised__p3_(vectors_scaled_p_p3_(f,
                k_body)), g_body, a, n, state, AT2(limits, 0, j), AT2(limits, 1, j), ball.radius);
            if (status.a0 != 0) { return (t_i2r2){step - steps.first, status.a0, status.a1, doubt}; }
            weight = (t_r2){AT2(weights, j, 0), AT2(weights, j, 1)};
            change = (t_r2){AT2(weights, j, 2), AT2(weights, j, 3)};
            sums = double_double_with_shares__p4_p_p4_(sums, weight, status.a2);
            x_ = double_double_with_share_p3(x_, weight, status.a3);
            y_ = double_double_with_share_p3(y_, weight, status.a4);
            changes = double_double_with_shares__p4_p_p4_(changes, change, status.a2);
        }
        t_r2 t_2 = vectors_dot_four__p4_2(sums, sums); length = pairs_root(pairs_two_sum(t_2.a0, t_2.a1));
        a = (t_p4){pairs_divide(sums.a0, pairs_two_sum(length.a0, length.a1)), pairs_divide(sums.a1,
            pairs_two_sum(length.a0, length.a1)), pairs_divide(sums.a2, pairs_two_sum(length.a0, length.a1)),
            pairs_divide(sums.a3, pairs_two_sum(length.a0, length.a1))};
        t_r2 t_3 = pairs_loose_add(x, x_), t_4 = pairs_loose_add(y, y_); x = pairs_two_sum(t_3.a0, t_3.a1);
        y = pairs_two_sum(t_4.a0, t_4.a1); double_double_put_pair_r1ip(body, 0, a.a0);
        double_double_put_pairs_r1i_p3_(body, 2, (t_p3){a.a1, a.a2, a.a3}); double_double_put_pair_r1ip(body, 8, x);
        double_double_put_pair_r1ip(body, 10, y);
        t_r3 t_5 = double_double_highs__p3_((t_p3){changes.a1, changes.a2, changes.a3});
        doubt = doubt + R(2.0) * R(sqrt(vectors_square_of_four((t_r4){changes.a0.a0, t_5.a0, t_5.a1, t_5.a2})));
        if (mod_i(step + 1, steps.every) == 0) {
            frame = div_i(step + 1, steps.every);
            double_double_put_pairs_r1i_p3_(state, 0, double_double_rotated__p4__p3_(vectors_conjugate__p4_(a), K_));
            double_double_put_pairs_r1i_p3_(state, 6, double_double_rotated__p4__p3_(vectors_conjugate__p4_(a), g_));
            double_double_write(r2_row(track.momenta, frame), r2_row(low.momenta, frame), state, 0, size.a1);
            double_double_write(r2_row(track.verticals, frame), r2_row(low.verticals, frame), state, 6, 0);
            if (track.follows) {
                double_double_write(r2_row(track.attitudes, frame), r2_row(low.attitudes, frame), body, 0, 0);
                double_double_write(r2_row(track.traces, frame), r2_row(low.traces, frame), body, 8, -shift.a1);
            }
        }
    }
    return (t_i2r2){steps.last - steps.first, 0, R(1.0), doubt};
}

INLINE t_r2 proved_slope_of(t_r3 k, t_r3 I, real D) {
    t_r2 radius = gibbs_bound(k, I, D);
    real least = min_r(min_r(I.a0, I.a1), I.a2), most = max_r(max_r(I.a0, I.a1), I.a2);
    real slope = least - R(sqrt(max_r(radius.a0, R(0.0)))) * (R(0.5) * (most - least) + R(2.0) * vectors_length(k)) *
        R(1.0000000000009095);
    return (t_r2){radius.a0 < R(0.0) ? R(0.0) : slope, radius.a0};
}

INLINE t_r3 proved_floats__e3_(t_e3 v) { return (t_r3){v.a0, v.a1, v.a2}; }
INLINE t_p3 kernel_gibbs_residual_e9p3e(real u1, real u2, real u3, real k1, real k2, real k3, real g1, real g2, real
    g3, t_r2 I1, t_r2 I2, t_r2 I3, real D) {
    t_r2 x1 = pairs_loose_subtract(pairs_two_product(g3, u2), pairs_two_product(g2, u3));
    t_r2 x2 = pairs_loose_subtract(pairs_two_product(g1, u3), pairs_two_product(g3, u1));
    t_r2 x3 = pairs_loose_subtract(pairs_two_product(g2, u1), pairs_two_product(g1, u2));
    t_r2 y1 = pairs_loose_multiply_float(I1, u1), y2 = pairs_loose_multiply_float(I2, u2);
    t_r2 y3 = pairs_loose_multiply_float(I3, u3);
    t_r2 s = pairs_loose_add(pairs_loose_add_float(pairs_two_product(u1, u1), 1),
        pairs_loose_add(pairs_two_product(u2, u2), pairs_two_product(u3, u3)));
    t_r2 o_r1 = pairs_loose_subtract(pairs_loose_add(pairs_loose_add(y1,
        pairs_loose_multiply_float(pairs_loose_subtract(pairs_loose_multiply_float(x3, g2),
        pairs_loose_multiply_float(x2, g3)), D)), pairs_loose_multiply_float(y3, u2)),
        pairs_loose_add(pairs_loose_multiply_float(s, k1), pairs_loose_multiply_float(y2, u3)));
    t_r2 o_r2 = pairs_loose_subtract(pairs_loose_add(pairs_loose_add(y2,
        pairs_loose_multiply_float(pairs_loose_subtract(pairs_loose_multiply_float(x1, g3),
        pairs_loose_multiply_float(x3, g1)), D)), pairs_loose_multiply_float(y1, u3)),
        pairs_loose_add(pairs_loose_multiply_float(s, k2), pairs_loose_multiply_float(y3, u1)));
    t_r2 o_r3 = pairs_loose_subtract(pairs_loose_add(pairs_loose_add(y3,
        pairs_loose_multiply_float(pairs_loose_subtract(pairs_loose_multiply_float(x2, g1),
        pairs_loose_multiply_float(x1, g2)), D)), pairs_loose_multiply_float(y2, u1)),
        pairs_loose_add(pairs_loose_multiply_float(s, k3), pairs_loose_multiply_float(y1, u2)));
    return (t_p3){o_r1, o_r2, o_r3};
}

INLINE Root proved_root_near__e3_3_p3_r6(t_e3 u, t_e3 k, t_e3 g, t_p3 I, real D, real slope, real radius, real xi,
    real k_off, real g_off) {
    t_r3 v = proved_floats__e3_(u), kf = proved_floats__e3_(k), gf = proved_floats__e3_(g);
    t_r3 If = proved_floats__p3_(I);
    real spread = R(0.5) * (max_r(max_r(If.a0, If.a1), If.a2) - min_r(min_r(If.a0, If.a1), If.a2));
    real half = proved_long(kf) * R(1.0000000000009095), size = proved_long(v);
    real most = max_r(max_r(If.a0, If.a1), If.a2) + D;
    real m = (radius == R(-2.0) ? proved_slope_at(v, kf, gf, If, D) : slope) / R(1.0000000000009095);
    real whole = R(1.0) + size * size;
    real at_root = proved_long(proved_floats__p3_(kernel_gibbs_residual_e9p3e(u.a0, u.a1, u.a2, k.a0, k.a1, k.a2,
        g.a0, g.a1, g.a2, I.a0, I.a1, I.a2, D)));
    real rest = at_root + R(2.524354896707238e-29) * (R(1.0) + size) * (most * size + half) +
        R(9.332636185032189e-302);
    rest = rest + (R(2.0) * D * size * g_off + whole * half * k_off);
    real shift = R(4.0) * D * size + R(2.0) * whole * half;
    real curved = (R(11.0) * D * size + R(3.0) * whole * half) * xi * xi;
    real w = m > R(0.0) ? R(1.0000000000009095) * ((rest + shift * xi + curved) / m) : R(INFINITY);
    int inside = w <= R(9.5367431640625e-07) && xi <= R(9.5367431640625e-07);
    if (radius == R(-2.0)) {
        inside = w <= R(1.4551915228366852e-11) && xi <= R(1.4551915228366852e-11) && R(2.0) * (spread + R(2.0) *
            half) * w <= m;
    }
    else { inside = inside && size * size <= radius; }
    return (Root){inside ? w : R(INFINITY), m, rest, shift, curved};
}

INLINE t_p3 kernel_gibbs_residual_e6p6e(real u1, real u2, real u3, real k1, real k2, real k3, t_r2 g1, t_r2 g2, t_r2
    g3, t_r2 I1, t_r2 I2, t_r2 I3, real D) {
    t_r2 x1 = pairs_loose_subtract(pairs_loose_multiply_float(g3, u2), pairs_loose_multiply_float(g2, u3));
    t_r2 x2 = pairs_loose_subtract(pairs_loose_multiply_float(g1, u3), pairs_loose_multiply_float(g3, u1));
    t_r2 x3 = pairs_loose_subtract(pairs_loose_multiply_float(g2, u1), pairs_loose_multiply_float(g1, u2));
    t_r2 y1 = pairs_loose_multiply_float(I1, u1), y2 = pairs_loose_multiply_float(I2, u2);
    t_r2 y3 = pairs_loose_multiply_float(I3, u3);
    t_r2 s = pairs_loose_add(pairs_loose_add_float(pairs_two_product(u1, u1), 1),
        pairs_loose_add(pairs_two_product(u2, u2), pairs_two_product(u3, u3)));
    t_r2 o_r1 = pairs_loose_subtract(pairs_loose_add(pairs_loose_add(y1,
        pairs_loose_multiply_float(pairs_loose_subtract(pairs_loose_multiply(g2, x3), pairs_loose_multiply(g3, x2)),
        D)), pairs_loose_multiply_float(y3, u2)), pairs_loose_add(pairs_loose_multiply_float(s, k1),
        pairs_loose_multiply_float(y2, u3)));
    t_r2 o_r2 = pairs_loose_subtract(pairs_loose_add(pairs_loose_add(y2,
        pairs_loose_multiply_float(pairs_loose_subtract(pairs_loose_multiply(g3, x1), pairs_loose_multiply(g1, x3)),
        D)), pairs_loose_multiply_float(y1, u3)), pairs_loose_add(pairs_loose_multiply_float(s, k2),
        pairs_loose_multiply_float(y3, u1)));
    t_r2 o_r3 = pairs_loose_subtract(pairs_loose_add(pairs_loose_add(y3,
        pairs_loose_multiply_float(pairs_loose_subtract(pairs_loose_multiply(g1, x2), pairs_loose_multiply(g2, x1)),
        D)), pairs_loose_multiply_float(y2, u1)), pairs_loose_add(pairs_loose_multiply_float(s, k3),
        pairs_loose_multiply_float(y1, u2)));
    return (t_p3){o_r1, o_r2, o_r3};
}

INLINE Root proved_root_near__e3_2_p3_2r6(t_e3 u, t_e3 k, t_p3 g, t_p3 I, real D, real slope, real radius, real xi,
    real k_off, real g_off) {
    t_r3 v = proved_floats__e3_(u), kf = proved_floats__e3_(k), gf = proved_floats__p3_(g);
    t_r3 If = proved_floats__p3_(I);
    real spread = R(0.5) * (max_r(max_r(If.a0, If.a1), If.a2) - min_r(min_r(If.a0, If.a1), If.a2));
    real half = proved_long(kf) * R(1.0000000000009095), size = proved_long(v);
    real most = max_r(max_r(If.a0, If.a1), If.a2) + D;
    real m = (radius == R(-2.0) ? proved_slope_at(v, kf, gf, If, D) : slope) / R(1.0000000000009095);
    real whole = R(1.0) + size * size;
    real at_root = proved_long(proved_floats__p3_(kernel_gibbs_residual_e6p6e(u.a0, u.a1, u.a2, k.a0, k.a1, k.a2,
        g.a0, g.a1, g.a2, I.a0, I.a1, I.a2, D)));
    real rest = at_root + R(2.524354896707238e-29) * (R(1.0) + size) * (most * size + half) +
        R(9.332636185032189e-302);
    rest = rest + (R(2.0) * D * size * g_off + whole * half * k_off);
    real shift = R(4.0) * D * size + R(2.0) * whole * half;
    real curved = (R(11.0) * D * size + R(3.0) * whole * half) * xi * xi;
    real w = m > R(0.0) ? R(1.0000000000009095) * ((rest + shift * xi + curved) / m) : R(INFINITY);
    int inside = w <= R(9.5367431640625e-07) && xi <= R(9.5367431640625e-07);
    if (radius == R(-2.0)) {
        inside = w <= R(1.4551915228366852e-11) && xi <= R(1.4551915228366852e-11) && R(2.0) * (spread + R(2.0) *
            half) * w <= m;
    }
    else { inside = inside && size * size <= radius; }
    return (Root){inside ? w : R(INFINITY), m, rest, shift, curved};
}

OUT_OF_LINE real proved_nearer__r3_3_p3_r3(t_r3 u, t_r3 k, t_r3 g, t_p3 I, real D, real slope, real radius) {
    t_p3 v = proved_unit_pairs(g);
    Root root = proved_root_near__e3_2_p3_2r6(proved_exact(u), proved_exact(k), v, I, D, slope, radius, R(0.0),
        R(0.0), R(3.1554436208840472e-30));
    if (root.w == R(INFINITY)) { return R(INFINITY); }
    t_r3 If = proved_floats__p3_(I), gf = proved_floats__p3_(v);
    t_r13 found = kernel_gibbs_newton(u.a0, u.a1, u.a2, k.a0, k.a1, k.a2, gf.a0, gf.a1, gf.a2, If.a0, If.a1, If.a2,
        D);
    t_e3 t_1 = proved_exact(u), t_2 = proved_exact(k);
    t_r3 r = proved_floats__p3_(kernel_gibbs_residual_e6p6e(t_1.a0, t_1.a1, t_1.a2, t_2.a0, t_2.a1, t_2.a2, v.a0,
        v.a1, v.a2, I.a0, I.a1, I.a2, D));
    t_r3 d = vectors_scaled(R(1.0) / found.a0, vectors_adjoint((t_r9){found.a4, found.a5, found.a6, found.a7,
        found.a8, found.a9, found.a10, found.a11, found.a12}, r));
    real half = vectors_length(k), size = vectors_length(u), most = max_r(max_r(If.a0, If.a1), If.a2) + D;
    real lost = proved_left(d, r, u, k, gf, If, D) + R(1.4210854715202004e-14) * (R(1.0) + size) * (most + half) *
        vectors_length(d);
    real curved = (R(0.5) * (max_r(max_r(If.a0, If.a1), If.a2) - min_r(min_r(If.a0, If.a1), If.a2)) + half) * root.w *
        root.w;
    return R(1.0000000000009095) * (proved_long(d) + (lost + curved + max_r(root.rest - vectors_length(r), R(0.0)) +
        R(1.4210854715202004e-14) * root.rest) / root.m);
}

INLINE t_p3 kernel_turn_1e6(real p1, real p2, real p3, real v1, real v2, real v3) {
    t_r2 t_1 = pairs_loose_add(pairs_loose_add_float(pairs_two_product(p1, p1), 1),
        pairs_loose_add(pairs_two_product(p2, p2), pairs_two_product(p3, p3)));
    t_r2 s = pairs_divide((t_r2){2, 0}, pairs_two_sum(t_1.a0, t_1.a1));
    t_r2 x1 = pairs_loose_subtract(pairs_two_product(p2, v3), pairs_two_product(p3, v2));
    t_r2 x2 = pairs_loose_subtract(pairs_two_product(p3, v1), pairs_two_product(p1, v3));
    t_r2 x3 = pairs_loose_subtract(pairs_two_product(p1, v2), pairs_two_product(p2, v1));
    t_r2 o_x1 = pairs_loose_multiply(s, pairs_loose_subtract(pairs_loose_subtract(pairs_loose_multiply_float(x3, p2),
        x1), pairs_loose_multiply_float(x2, p3)));
    t_r2 o_x2 = pairs_loose_multiply(s, pairs_loose_subtract(pairs_loose_subtract(pairs_loose_multiply_float(x1, p3),
        x2), pairs_loose_multiply_float(x3, p1)));
    t_r2 o_x3 = pairs_loose_multiply(s, pairs_loose_subtract(pairs_loose_subtract(pairs_loose_multiply_float(x2, p1),
        x3), pairs_loose_multiply_float(x1, p2)));
    return (t_p3){o_x1, o_x2, o_x3};
}

INLINE t_r3 proved_turned_off(t_r3 u, t_r3 v, t_r3 after) {
    t_e3 t_1 = proved_exact(u), t_2 = proved_exact(v);
    t_p3 y = kernel_turn_1e6(t_1.a0, t_1.a1, t_1.a2, t_2.a0, t_2.a1, t_2.a2);
    return proved_floats__p3_(vectors_plus__p3_2(y, (t_p3){pairs_two_sum(v.a0, -after.a0), pairs_two_sum(v.a1,
        -after.a1), pairs_two_sum(v.a2, -after.a2)}));
}

INLINE void proved_bound_step(r1 momentum, r1 vertical, r1 tensor, real contact, r1 q, r1 momentum_after, r1
    vertical_after, r1 row) {
    t_r3 t_1 = branch_moments(vectors_three(tensor, 0));
    t_ri size = real_frexp(max_r(max_r(t_1.a0, t_1.a1), t_1.a2) + contact);
    t_r3 k = vectors_shifted(vectors_three(momentum, 0), -size.a1 - 1), g = vectors_three(vertical, 0);
    t_r3 J = vectors_shifted(vectors_three(tensor, 0), -size.a1); real D = R(ldexp(contact, (int)-size.a1));
    t_r3 u = (t_r3){q.p[1] / q.p[0], q.p[2] / q.p[0], q.p[3] / q.p[0]};
    t_r2 t_2 = pairs_two_sum(J.a1, J.a2), t_3 = pairs_two_sum(J.a0, J.a2), t_4 = pairs_two_sum(J.a0, J.a1);
    t_p3 I = (t_p3){(t_r2){t_2.a0, t_2.a1}, (t_r2){t_3.a0, t_3.a1}, (t_r2){t_4.a0, t_4.a1}};
    t_r2 slope = proved_slope_of(k, proved_floats__p3_(I), D);
    real off = R(0.51) * R(fabs(vectors_dot(g, g) - R(1.0))) + R(2.220446049250313e-16);
    Root root = proved_root_near__e3_3_p3_r6(proved_exact(u), proved_exact(k), proved_exact(g), I, D, slope.a0,
        slope.a1, R(0.0), R(0.0), off);
    t_r3 t_5 = proved_floats__p3_(I); real near = root.w, heaviest = max_r(max_r(t_5.a0, t_5.a1), t_5.a2) + D;
    if (near < R(INFINITY) && root.m < R(0.125) * heaviest) {
        near = min_r(near, proved_nearer__r3_3_p3_r3(u, k, g, I, D, slope.a0, slope.a1));
    }
    real unit_off = R(0.51) * R(fabs(vectors_square_of_four(vectors_four(q, 0)) - R(1.0))) + R(2.220446049250313e-16);
    int kept = R(ldexp(vectors_largest(k), (int)(size.a1 + 1))) == vectors_largest(vectors_three(momentum, 0)) &&
        q.p[0] > R(9.5367431640625e-07);
    real w = kept ? R(1.0000000000009095) * near : R(INFINITY);
    real part = R(1.0000000000009095) * (R(2.0) * w + R(2.0) * w * w) + (R(2.524354896707238e-29) * proved_long(u) +
        R(3.1554436208840472e-30));
    t_r3 after = vectors_shifted(vectors_three(momentum_after, 0), -size.a1 - 1);
    row.p[0] = R(ldexp(R(1.0000000000009095) * (proved_long(proved_turned_off(u, k, after)) + R(2.0) *
        vectors_largest(k) * part + R(9.332636185032189e-302)), (int)(size.a1 + 1))) + R(1e-323);
    row.p[1] = R(1.0000000000009095) * (proved_long(proved_turned_off(u, g, vectors_three(vertical_after, 0))) +
        R(1.01) * part + off);
    row.p[2] = R(1.0000000000009095) * (w + proved_long(u) * R(2.220446049250313e-16) + unit_off);
}

INLINE void proved_bound_steps(r2 momenta, r2 verticals, r2 tensors, r1 contacts, r2 q, r2 momenta_after, r2
    verticals_after, r2 errors) {
    for (int64_t i = 0, end_i = momenta.n0; i < end_i; i++) {
        proved_bound_step(r2_row(momenta, i), r2_row(verticals, i), r2_row(tensors, i), contacts.p[i], r2_row(q, i),
            r2_row(momenta_after, i), r2_row(verticals_after, i), r2_row(errors, i));
    }
}

INLINE void tangent_derivative(t_r3 u, r1 state, r2 T) {
    t_r3 x; t__r3_3 y; t_r3 k = vectors_three(state, 0), g = vectors_three(state, 3), t_1 = vectors_three(state, 21);
    t_r13 n = kernel_gibbs_newton(u.a0, u.a1, u.a2, k.a0, k.a1, k.a2, g.a0, g.a1, g.a2, t_1.a0, t_1.a1, t_1.a2,
        state.p[24]);
    for (int64_t i = 0; i < 3; i++) {
        x = (t_r3){i == 0 ? R(1.0) : R(0.0), i == 1 ? R(1.0) : R(0.0), i == 2 ? R(1.0) : R(0.0)};
        y = tangent_column(x, u, k, g, state.p[24], n.a0, (t_r9){n.a4, n.a5, n.a6, n.a7, n.a8, n.a9, n.a10, n.a11,
            n.a12});
        vectors_put(r2_row(T, i), 0, y.a0);
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
    return vectors_dot(vectors_three(r2_row(T, 0), 0), vectors_cross(vectors_three(r2_row(T, 1), 0),
        vectors_three(r2_row(T, 2), 0)));
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
    int64_t status, second; t_r4 p; real volume, E, share; t_r3 k, g; ALIGNED real state_[27];
    r1 state = {state_, 27}; ALIGNED real frame_[3 * 3]; memset(frame_, 0, sizeof frame_);
    r2 frame = {frame_, 3, 3, 3};
    for (int64_t i_ = 0; i_ < 3; i_++) { frame_[i_ * (3 + 1)] = 1; }
    ALIGNED real growth_[3]; memset(growth_, 0, sizeof growth_); r1 growth = {growth_, 3}; ALIGNED real T_[3 * 3];
    r2 T = {T_, 3, 3, 3}; real scale = loop_entered(momentum, gamma, tensor, contact, state);
    t_r3 u = (t_r3){R(0.0), R(0.0), R(0.0)}; int64_t half = div_i(steps, 2); real total = R(0.0);
    r1_fill(row, R(0.0)); row.p[8] = R(INFINITY); row.p[9] = R(-INFINITY);
    for (int64_t n = 0, end_n = 2 * half; n < end_n; n++) {
        t_ir_r4__r3_ t_1 = loop_safe_rotation(u, state); status = t_1.a0; p = t_1.a2; u = t_1.a3;
        if (status != 0 || p.a0 == R(0.0)) { return; }
        tangent_derivative(u, state, T); tangent_moved(T, frame, growth);
        volume = R(log(R(fabs(tangent_determinant(T))))); k = vectors_three(state, 0); g = vectors_three(state, 3);
        t_r3 t_2 = vectors_scaled(scale, k), t_3 = vectors_three(tensor, 0);
        E = kernel_energy(t_2.a0, t_2.a1, t_2.a2, g.a0, g.a1, g.a2, t_3.a0, t_3.a1, t_3.a2, contact);
        second = n >= half ? 1 : 0; share = tangent_weight(n - second * half, half);
        total = total + (second == 1 ? R(0.0) : share); row.p[4 + second] = row.p[4 + second] + share * volume;
        row.p[6 + second] = row.p[6 + second] + share * E; real t_4 = min_r(row.p[8], E), t_5 = max_r(row.p[9], E);
        row.p[8] = t_4; row.p[9] = t_5;
        vectors_put(state, 0, vectors_plus(k, kernel_turn(p.a0, p.a1, p.a2, p.a3, k.a0, k.a1, k.a2)));
        vectors_put(state, 3, vectors_plus(g, kernel_turn(p.a0, p.a1, p.a2, p.a3, g.a0, g.a1, g.a2)));
        row.p[0] = n + R(1.0);
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

INLINE void carried_begun(r2 E, int64_t B, int64_t b, t_r3 J, real start) {
    int64_t i;
    for (int64_t lane = 0; lane < 4; lane++) {
        i = lane * B + b;
        for (int64_t c = 0; c < 3; c++) { AT2(E, 38 + c, i) = c == lane ? R(1.0) : R(0.0); }
        vectors_put_in(E, 51, i, J);
        for (int64_t row = 59; row < 119; row++) { AT2(E, row, i) = R(0.0); }
    }
    AT2(E, 64, b) = start; AT2(E, 67, b) = start; AT2(E, 69, b) = start;
}

INLINE int64_t following_taken_in(Crew crew, int64_t B, int64_t b, int64_t i, Frames frames, Balls balls, Weights
    weights, Asked asked) {
    r2 S = crew.S; r1 body = r2_row(crew.bodies, b), lane = r2_row(crew.lanes, b); lanes_placed(body, i, frames);
    r1_fill(lane, R(0.0)); lane.p[4] = i; lane.p[5] = R(1.0); lane.p[18] = asked.allowed.p[i];
    lane.p[13] = asked.first.p[i]; lane.p[10] = R(1e+300); lane.p[20] = R(1e+300);
    following_aimed(lane, frames.momenta.n1, asked.interval);
    t_ri half = lanes_begun(body, r2_row(balls.tensor, i), balls.contact.p[i], lane.p[1], r2_row(crew.states, b));
    lanes_enter(S, B, b, half.a0, balls.radius.p[i], weights, body, r2_row(crew.states, b));
    lane.p[2] = R(2.0) * AT2(S, 129, b) / lane.p[1];
    carried_begun(crew.E, B, b, vectors_three_in(S, 131, b), asked.start.p[i]); return half.a1;
}

INLINE t_r3 carried_by(t_r3 a, t_r3 b) { return (t_r3){a.a0 * b.a0, a.a1 * b.a1, a.a2 * b.a2}; }
INLINE void carried_tangent(r2 S, r2 E, int64_t B, int64_t at, int traced) {
    real one, contact, least, along, across, up, over, found, moved, size;
    t_r3 K, g, J, body, w, m, s, a, n, v, u, e, f, turned, t, p, z, b; t_r4 q; int64_t i, j, k;
    for (int64_t row = 0; row < 10; row++) {
        INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
            one = AT2(S, 105 + row, b); AT2(E, 41 + row, b) = one; AT2(E, 41 + row, B + b) = one;
            AT2(E, 41 + row, 2 * B + b) = one; AT2(E, 41 + row, 3 * B + b) = one;
        }
    }
    INDEPENDENT for (int64_t i = 0, end_i = 4 * B; i < end_i; i++) {
        K = vectors_three_in(E, 41, i); g = vectors_three_in(E, 44, i); J = vectors_three_in(E, 51, i);
        contact = AT2(S, 30, i);
        body = (t_r3){AT2(S, 27, i) + contact, AT2(S, 28, i) + contact, AT2(S, 29, i) + contact};
        w = kernel_angular_velocity(K.a0, K.a1, K.a2, g.a0, g.a1, g.a2, J.a0, J.a1, J.a2, contact);
        m = carried_by(body, w); s = vectors_cross(w, m);
        a = kernel_angular_velocity(-s.a0, -s.a1, -s.a2, g.a0, g.a1, g.a2, J.a0, J.a1, J.a2, contact);
        n = carried_by(body, a); vectors_put_in(E, at + 13, i, w);
        least = R(9.999999999999998e-15) * (vectors_dot(m, m) * vectors_dot(w, w));
        vectors_put_in(E, at + 16, i, vectors_scaled(vectors_dot(s, s) > least ? R(1.0) : R(0.0), s));
        v = vectors_cross(w, g); u = vectors_minus(vectors_cross(a, g), vectors_cross(w, v));
        e = vectors_three_in(E, 38, i); t_r3 t_1 = carried_by(e, K);
        vectors_put_in(E, 100, i, kernel_angular_velocity(t_1.a0, t_1.a1, t_1.a2, g.a0, g.a1, g.a2, J.a0, J.a1, J.a2,
            contact));
        along = contact * vectors_dot(v, e); across = contact * vectors_dot(u, e);
        t_r3 t_2 = vectors_plus(vectors_cross(m, e), vectors_scaled(along, g));
        s = kernel_angular_velocity(t_2.a0, t_2.a1, t_2.a2, g.a0, g.a1, g.a2, J.a0, J.a1, J.a2, contact);
        f = vectors_plus(s, vectors_cross(e, w)); up = across + contact * (vectors_dot(v, f) - vectors_dot(v, s));
        over = along + contact * vectors_dot(g, s);
        turned = vectors_minus(vectors_scaled(up, g), vectors_scaled(over, v));
        t_r3 t_3 = vectors_plus(vectors_plus(vectors_cross(n, e), vectors_cross(m, f)), turned);
        t = kernel_angular_velocity(t_3.a0, t_3.a1, t_3.a2, g.a0, g.a1, g.a2, J.a0, J.a1, J.a2, contact);
        p = vectors_plus(vectors_plus(t, vectors_cross(f, w)), vectors_cross(e, a)); vectors_put_in(E, at + 0, i, s);
        vectors_put_in(E, at + 3, i, f); vectors_put_in(E, at + 6, i, p);
        if (traced) {
            q = vectors_four_in(E, 47, i); z = vectors_cross(f, g);
            b = vectors_minus(vectors_plus(vectors_cross(w, z), vectors_cross(p, g)), vectors_cross(f, v));
            t_r3 t_4 = kernel_rotate(q.a0, q.a1, q.a2, q.a3, z.a0, z.a1, z.a2); AT2(E, at + 9, i) = t_4.a0;
            AT2(E, at + 9 + 1, i) = t_4.a1; t_r3 t_5 = kernel_rotate(q.a0, q.a1, q.a2, q.a3, b.a0, b.a1, b.a2);
            AT2(E, at + 11, i) = t_5.a0; AT2(E, at + 11 + 1, i) = t_5.a1;
        }
    }
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        i = b; j = B + b; k = 2 * B + b; w = vectors_three_in(E, at + 13, b); found = R(0.0);
        for (int64_t c = 0; c < 3; c++) {
            moved = R(fabs(AT2(E, 100 + c, i))) + R(fabs(AT2(E, 100 + c, j))) + R(fabs(AT2(E, 100 + c, k)));
            found = found + moved * moved;
        }
        size = vectors_dot(w, w); AT2(E, 103, b) = size > R(0.0) ? R(sqrt(found / size)) : R(0.0);
    }
}

INLINE void carried_changes(r2 S, r2 E, int64_t B) {
    t_r4 a, b; real one, two, w, v; t_r3 way;
    INDEPENDENT for (int64_t i = 0, end_i = 4 * B; i < end_i; i++) {
        a = vectors_four_in(S, 87, i); b = vectors_four_in(S, 15, i);
        one = R(1.0) / R(sqrt(vectors_square_of_four(a))); two = R(1.0) / R(sqrt(vectors_square_of_four(b)));
        for (int64_t c = 0; c < 3; c++) {
            w = AT2(S, 73 + 2 * c, i) * one; v = AT2(S, 73 + 2 * c + 1, i) * two;
            vectors_put_four_in(E, 104 + 4 * c, i, vectors_mixed(w, a, v, b));
        }
        way = vectors_plus(vectors_scaled(AT2(S, 73, i), vectors_three_in(S, 91, i)), vectors_scaled(AT2(S, 74, i),
            vectors_three_in(S, 19, i)));
        vectors_put_in(E, 116, i, way);
    }
    for (int64_t row = 104; row < 119; row++) {
        INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
            AT2(E, row, b) = AT2(E, row, b) + AT2(E, row, B + b) + (AT2(E, row, 2 * B + b) + AT2(E, row, 3 * B + b));
        }
    }
    for (int64_t c = 0; c < 3; c++) {
        INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
            vectors_put_in(S, 118 + 3 * c, b, lanes_twist(vectors_four_in(S, 94, b), vectors_four_in(E, 104 + 4 * c,
                b)));
        }
    }
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        t_r4 t_1 = vectors_four_in(E, 47, b); t_r3 t_2 = vectors_three_in(E, 116, b);
        t_r3 t_3 = kernel_rotate(t_1.a0, t_1.a1, t_1.a2, t_1.a3, t_2.a0, t_2.a1, t_2.a2); AT2(S, 127, b) = t_3.a0;
        AT2(S, 128, b) = t_3.a1;
    }
}

INLINE t_r4 following_left(r2 S, int64_t b, real start) {
    int64_t row = 118;
    real x = vectors_length(vectors_three_in(S, row, b)), y = vectors_length(vectors_three_in(S, row + 3, b));
    real z = vectors_length(vectors_three_in(S, row + 6, b)), rounded = R(2e-15) + R(10.0) * start;
    real last = max_r(x - rounded, R(0.0)), middle = max_r(y - rounded, R(0.0));
    if (!(middle > R(0.0) && z > R(0.0))) { return (t_r4){R(0.0), x, y, z}; }
    last = max_r(last, middle * min_r(middle / z, R(1.0))); real ratio = min_r(last / middle, R(1.0));
    return (t_r4){max_r(R(2.0), R(1.0) / max_r(R(1.0) - ratio, R(0.125))) * last * ratio, x, y, z};
}

INLINE real following_lengthened(real ratio) {
    real root = R(sqrt(R(sqrt(R(sqrt(R(sqrt(min_r(max_r(ratio, R(1e-12)), R(1000000000000.0))))))))));
    return R(1.0) / (root * R(sqrt(root)));
}

INLINE void following_judged(Crew crew, int64_t b, int lost, real start, r2 sums) {
    int always; int64_t stopped; real reached; r2 S = crew.S, E = crew.E; r1 lane = r2_row(crew.lanes, b);
    real step = lane.p[1], tries = lane.p[6], size = lane.p[2] * R(sqrt(vectors_square(vectors_three_in(S, 37, b))));
    lane.p[11] = size; lane.p[12] = R(3.0); lane.p[14] = R(0.0); lane.p[15] = R(0.0);
    if (lost && AT2(S, 58, b) != R(0.0)) {
        always = AT2(S, 62, b) < R(0.0); stopped = 0;
        if (always || tries >= 40) {
            t_ir t_1 = lanes_safely(S, b, sums, r2_row(crew.states, b)); stopped = t_1.a0; reached = t_1.a1;
            lane.p[16] = stopped; lane.p[17] = reached; lane.p[12] = stopped == 0 ? R(3.0) : R(2.0);
        }
        if (tries < 40 && (stopped != 0 || !always)) { lane.p[12] = R(1.0); lane.p[10] = R(0.9) * step; }
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

INLINE void following_shortened(r2 end, real ratio) {
    real factor = R(1.0);
    for (int64_t n = 1; n < 6; n++) {
        factor = factor * ratio;
        for (int64_t i = 0; i < 6; i++) { AT2(end, n, i) = AT2(end, n, i) * factor; }
    }
}

INLINE real following_crossed(r2 V, int64_t at, int64_t n, int64_t i) {
    int64_t j = i < 2 ? i + 1 : 0, k = j < 2 ? j + 1 : 0; real found = R(0.0);
    for (int64_t m = 0, end_m = n + 1; m < end_m; m++) {
        found = found + (AT2(V, at + j, m) * AT2(V, 0 + k, n - m) - AT2(V, at + k, m) * AT2(V, 0 + j, n - m));
    }
    return found;
}

INLINE void following_series(r1 body, t_r3 J, real contact, real radius, real whole, int traced, r2 V, r2 end) {
    t_r3 x, w; real along, part, x1, x2; t_r4 b; t_r3 g = vectors_three(body, 3); t_r4 a = vectors_four(body, 6);
    vectors_put_in(V, 3, 0, vectors_three(body, 0)); vectors_put_in(V, 6, 0, g);
    if (traced) {
        t_r4 t_1 = vectors_conjugate(a);
        vectors_put_in(V, 9, 0, kernel_rotate(t_1.a0, t_1.a1, t_1.a2, t_1.a3, R(1.0), R(0.0), R(0.0)));
        t_r4 t_2 = vectors_conjugate(a);
        vectors_put_in(V, 12, 0, kernel_rotate(t_2.a0, t_2.a1, t_2.a2, t_2.a3, R(0.0), R(1.0), R(0.0)));
    }
    vectors_put_four(r2_row(end, 0), 0, a); AT2(end, 0, 4) = body.p[10]; AT2(end, 0, 5) = body.p[11];
    for (int64_t n = 0; n < 5; n++) {
        x = vectors_scaled(whole, vectors_three_in(V, 3, n)); along = R(0.0);
        for (int64_t m = 1, end_m = n + 1; m < end_m; m++) {
            along = along + vectors_dot(vectors_three_in(V, 6, m), vectors_three_in(V, 0, n - m));
            x = vectors_plus(x, vectors_scaled(contact * AT2(V, 15, n - m), vectors_three_in(V, 6, m)));
        }
        t_r3 t_3 = vectors_plus(x, vectors_scaled(contact * along, g));
        w = kernel_angular_velocity(t_3.a0, t_3.a1, t_3.a2, g.a0, g.a1, g.a2, J.a0, J.a1, J.a2, contact);
        vectors_put_in(V, 0, n, w); AT2(V, 15, n) = along + vectors_dot(g, w); part = R(1.0) / (n + 1);
        for (int64_t i = 0; i < 3; i++) {
            real t_4 = part * following_crossed(V, 3, n, i), t_5 = part * following_crossed(V, 6, n, i);
            AT2(V, 3 + i, n + 1) = t_4; AT2(V, 6 + i, n + 1) = t_5;
        }
        if (traced) {
            for (int64_t i = 0; i < 3; i++) {
                real t_6 = part * following_crossed(V, 9, n, i), t_7 = part * following_crossed(V, 12, n, i);
                AT2(V, 9 + i, n + 1) = t_6; AT2(V, 12 + i, n + 1) = t_7;
            }
            x1 = R(0.0); x2 = R(0.0);
            for (int64_t m = 0, end_m = n + 1; m < end_m; m++) {
                for (int64_t i = 0; i < 3; i++) {
                    x1 = x1 + AT2(V, 0 + i, m) * AT2(V, 12 + i, n - m);
                    x2 = x2 - AT2(V, 0 + i, m) * AT2(V, 9 + i, n - m);
                }
            }
            AT2(end, n + 1, 4) = radius * part * x1; AT2(end, n + 1, 5) = radius * part * x2;
        }
        b = (t_r4){R(0.0), R(0.0), R(0.0), R(0.0)};
        for (int64_t m = 0, end_m = n + 1; m < end_m; m++) {
            t_r4 t_8 = vectors_four(r2_row(end, m), 0); t_r3 t_9 = vectors_three_in(V, 0, n - m);
            b = vectors_plus_four(b, kernel_compose(t_8.a0, t_8.a1, t_8.a2, t_8.a3, R(0.0), t_9.a0, t_9.a1, t_9.a2));
        }
        vectors_put_four(r2_row(end, n + 1), 0, vectors_scaled_four(R(0.5) * part, b));
    }
}

INLINE real following_followed(real a, real b, real c) {
    if (!(a > R(0.0) && b > R(0.0))) { return R(8.0) * R(sqrt(c)); }
    c = max_r(c, R(0.25) * b * min_r(b / a, R(1.0))); return R(8.0) * R(sqrt(c)) * min_r(R(sqrt(c / b)), R(8.0));
}

INLINE t_r2 following_joined(r2 first, r2 end, real radius, int traced, r2 curve) {
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
    real a = R(0.0), b = R(0.0), c = R(0.0), way = R(0.0);
    for (int64_t i = 0; i < 4; i++) {
        a = a + AT2(curve, 9, i) * AT2(curve, 9, i); b = b + AT2(curve, 10, i) * AT2(curve, 10, i);
        c = c + AT2(curve, 11, i) * AT2(curve, 11, i);
    }
    real turned = R(0.00048828125) * following_followed(a, b, c);
    if (traced) {
        a = AT2(curve, 9, 4) * AT2(curve, 9, 4) + AT2(curve, 9, 5) * AT2(curve, 9, 5);
        b = AT2(curve, 10, 4) * AT2(curve, 10, 4) + AT2(curve, 10, 5) * AT2(curve, 10, 5);
        c = AT2(curve, 11, 4) * AT2(curve, 11, 4) + AT2(curve, 11, 5) * AT2(curve, 11, 5);
        way = R(0.000244140625) / radius * following_followed(a, b, c);
    }
    return (t_r2){turned, way};
}

INLINE t_r2 following_through(Crew crew, int64_t b, int traced) {
    r2 S = crew.S; r1 lane = r2_row(crew.lanes, b);
    r2 first = r3_row(crew.ends, 2 * b), last = r3_row(crew.ends, 2 * b + 1); real whole = lane.p[1] * lane.p[2];
    t_r3 J = vectors_three_in(S, 131, b); real contact = AT2(S, 134, b), radius = AT2(S, 130, b);
    if (lane.p[9] > R(0.0)) {
        for (int64_t n = 0; n < 6; n++) {
            for (int64_t c = 0; c < 6; c++) { AT2(first, n, c) = AT2(last, n, c); }
        }
        if (lane.p[9] != whole) { following_shortened(first, whole / lane.p[9]); }
    }
    else { following_series(r2_row(crew.bodies, b), J, contact, radius, whole, traced, crew.V, first); }
    following_series(crew.now, J, contact, radius, whole, traced, crew.V, last);
    return following_joined(first, last, radius, traced, r3_row(crew.curves, b));
}

INLINE real following_spinning(r2 E, int64_t B, int64_t b) {
    real found = R(0.0);
    for (int64_t lane = 0; lane < 3; lane++) {
        for (int64_t c = 0; c < 3; c++) { found = found + AT2(E, 0 + c, lane * B + b) * AT2(E, 0 + c, lane * B + b); }
    }
    return R(sqrt(found));
}

INLINE void following_looked_at(Crew crew, int64_t B, int64_t b, int lost, int traced, r2 sums, Asked asked) {
    int inside; t_r2 off; real speed, worst, more, rounding, heavy; t_r3 w, s, m; r2 S = crew.S, E = crew.E;
    r1 lane = r2_row(crew.lanes, b); int64_t i = (int64_t)AT2(crew.lanes, b, 4);
    real start = asked.start.p[i], bearable = R(0.4) * asked.most.p[i]; AT2(E, 78, b) = R(0.0);
    AT2(E, 82, b) = R(0.0);
    if (AT2(S, 135, b) != R(0.0)) { lane.p[12] = R(0.0); return; }
    following_judged(crew, b, lost, start, sums);
    if (lane.p[12] == R(3.0)) {
        inside = following_part_of(lane, (int64_t)lane.p[5], asked.interval) < R(0.999999999);
        if (inside) {
            lanes_taken_out(S, b, crew.now); off = following_through(crew, b, traced); speed = lane.p[11] / lane.p[2];
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
        lane.p[20] = t_4; lane.p[10] = t_5;
        rounding = R(27.1) * max_r(start, R(5.551115123125783e-17) * AT2(E, 103, b)); w = vectors_three_in(E, 13, b);
        s = vectors_three_in(E, 16, b); heavy = AT2(S, 30, b);
        m = (t_r3){w.a0 * (AT2(S, 27, b) + heavy), w.a1 * (AT2(S, 28, b) + heavy), w.a2 * (AT2(S, 29, b) + heavy)};
        if (vectors_dot(s, s) <= R(0.0001) * (vectors_dot(m, m) * vectors_dot(w, w))) {
            lane.p[21] = lane.p[21] + R(1.0);
            rounding = max_r(rounding, R(1.6653345369377348e-14)) * R(sqrt(R(2.0) * lane.p[21] - R(1.0)));
        }
        else { lane.p[21] = R(0.0); }
        AT2(E, 78, b) = lane.p[1] * lane.p[2]; AT2(E, 82, b) = rounding * rounding; AT2(S, 117, b) = R(0.0);
    }
    else { AT2(E, 79, b) = R(0.0); AT2(E, 80, b) = R(0.0); AT2(E, 81, b) = R(0.0); }
    if (lane.p[12] == R(1.0)) { lanes_put_back(S, b, r2_row(crew.bodies, b)); }
}

INLINE t_r3 carried_ended(r2 E, int64_t i, real half, real twelfth) {
    return vectors_minus(vectors_scaled(twelfth, vectors_three_in(E, 25, i)), vectors_scaled(half, vectors_three_in(E,
        22, i)));
}

INLINE t_r3 carried_applied(t__r3_3 columns, t_r3 v) {
    return vectors_plus(vectors_plus(vectors_scaled(v.a0, columns.a0), vectors_scaled(v.a1, columns.a1)),
        vectors_scaled(v.a2, columns.a2));
}

INLINE void carried_kept(r2 E, int64_t B) {
    int64_t i, j, k; t_r3 w, x, c1, c2, c3, n, m; t__r3_3 columns; real size, part;
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        i = b; j = B + b; k = 2 * B + b; w = vectors_three_in(E, 13, b);
        columns = (t__r3_3){vectors_three_in(E, 54, i), vectors_three_in(E, 54, j), vectors_three_in(E, 54, k)};
        size = vectors_dot(w, w); part = size > R(0.0) ? R(1.0) / size : R(0.0);
        x = vectors_scaled(part, vectors_minus(vectors_three_in(E, 32, b), carried_applied(columns, w)));
        c1 = vectors_plus(columns.a0, vectors_scaled(w.a0, x));
        c2 = vectors_plus(columns.a1, vectors_scaled(w.a1, x));
        c3 = vectors_plus(columns.a2, vectors_scaled(w.a2, x)); n = vectors_three_in(E, 35, b);
        m = vectors_three_in(E, 16, b); size = vectors_dot(n, n);
        part = (size > R(0.0) && vectors_dot(m, m) > R(0.0)) ? R(1.0) / size : R(0.0);
        vectors_put_in(E, 54, i, vectors_plus(c1, vectors_scaled(part * (m.a0 - vectors_dot(n, c1)), n)));
        vectors_put_in(E, 54, j, vectors_plus(c2, vectors_scaled(part * (m.a1 - vectors_dot(n, c2)), n)));
        vectors_put_in(E, 54, k, vectors_plus(c3, vectors_scaled(part * (m.a2 - vectors_dot(n, c3)), n)));
    }
}

INLINE void carried_flown(r2 E, int64_t B, int traced) {
    real half, twelfth, over, x, y, off; int64_t i, j, k, lane; t_r3 u, v, w, a, d, e, row;
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        half = R(0.5) * AT2(E, 78, b); twelfth = AT2(E, 78, b) * AT2(E, 78, b) * R(0.08333333333333333); i = b;
        j = B + b; k = 2 * B + b; u = carried_ended(E, i, half, twelfth); v = carried_ended(E, j, half, twelfth);
        w = carried_ended(E, k, half, twelfth);
        a = (t_r3){R(1.0) - half * AT2(E, 22, i) + twelfth * AT2(E, 25, i), u.a1, u.a2};
        d = (t_r3){v.a0, R(1.0) - half * AT2(E, 23, j) + twelfth * AT2(E, 26, j), v.a2};
        e = (t_r3){w.a0, w.a1, R(1.0) - half * AT2(E, 24, k) + twelfth * AT2(E, 27, k)}; row = vectors_cross(d, e);
        over = R(1.0) / vectors_dot(a, row); vectors_put_in(E, 89, b, vectors_scaled(over, row));
        vectors_put_in(E, 92, b, vectors_scaled(over, vectors_cross(e, a)));
        vectors_put_in(E, 95, b, vectors_scaled(over, vectors_cross(a, d))); AT2(E, 98, b) = half;
        AT2(E, 99, b) = twelfth;
    }
    for (int64_t column = 0; column < 3; column++) {
        INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
            i = column * B + b; half = AT2(E, 98, b); twelfth = AT2(E, 99, b);
            v = vectors_plus(vectors_three_in(E, 38, i), vectors_scaled(half, vectors_three_in(E, 3, i)));
            v = vectors_plus(v, vectors_scaled(twelfth, vectors_three_in(E, 6, i)));
            AT2(E, 54, i) = vectors_dot(vectors_three_in(E, 89, b), v);
            real t_1 = vectors_dot(vectors_three_in(E, 92, b), v), t_2 = vectors_dot(vectors_three_in(E, 95, b), v);
            AT2(E, 55, i) = t_1; AT2(E, 56, i) = t_2;
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

INLINE t_r3 carried_row_of(r2 E, int64_t at, int64_t i, int64_t j, int64_t k) {
    return (t_r3){AT2(E, at, i), AT2(E, at, j), AT2(E, at, k)};
}

INLINE void carried_leave(r2 S, r2 E, int64_t B, int traced) {
    int64_t i, j, k, lane; real part, y1, y2; t_r3 v, l, x, east, north; t__r3_3 columns;
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        AT2(E, 83, b) = R(0.0); AT2(E, 84, b) = R(0.0); AT2(E, 85, b) = R(0.0);
    }
    for (int64_t c = 0; c < 3; c++) {
        INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
            i = b; j = B + b; k = 2 * B + b; lane = c * B + b; part = AT2(E, 79 + c, b);
            v = vectors_three_in(E, 59, lane);
            columns = (t__r3_3){vectors_three_in(E, 54, i), vectors_three_in(E, 54, j), vectors_three_in(E, 54, k)};
            l = vectors_plus(carried_applied(columns, v), vectors_scaled(part, vectors_three_in(S, 118 + 3 * c, b)));
            vectors_put_in(E, 59, lane, l);
            columns = (t__r3_3){vectors_three_in(E, 19, i), vectors_three_in(E, 19, j), vectors_three_in(E, 19, k)};
            x = carried_applied(columns, l); AT2(E, 83, b) = AT2(E, 83, b) + vectors_dot(l, l);
            AT2(E, 84, b) = AT2(E, 84, b) + vectors_dot(x, x);
            if (traced) {
                east = carried_row_of(E, 57, i, j, k); north = carried_row_of(E, 58, i, j, k);
                y1 = AT2(E, 62, lane) + (vectors_dot(east, v) + AT2(E, 79, b) * AT2(S, 127, b));
                y2 = AT2(E, 63, lane) + (vectors_dot(north, v) + AT2(E, 79, b) * AT2(S, 128, b));
                AT2(E, 62, lane) = y1; AT2(E, 63, lane) = y2; AT2(E, 85, b) = AT2(E, 85, b) + (y1 * y1 + y2 * y2);
            }
        }
    }
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        real t_1 = R(sqrt(AT2(E, 83, b))), t_2 = R(sqrt(AT2(E, 84, b))), t_3 = R(sqrt(AT2(E, 85, b)));
        AT2(E, 83, b) = t_1; AT2(E, 84, b) = t_2; AT2(E, 85, b) = t_3;
    }
}

INLINE t_r3 carried_through(r2 E, int64_t at, t__r3_3 l, int64_t i, int64_t j, int64_t k) {
    t_r3 row = carried_row_of(E, at, i, j, k);
    return (t_r3){vectors_dot(row, l.a0), vectors_dot(row, l.a1), vectors_dot(row, l.a2)};
}

INLINE t_r5 carried_reflection(t_r4 u) {
    real size = R(sqrt(vectors_square_of_four(u))), first = u.a0 + (u.a0 >= R(0.0) ? size : -size);
    return (t_r5){first, u.a1, u.a2, u.a3, size > R(0.0) ? R(1.0) / (size * R(fabs(first))) : R(0.0)};
}

INLINE t_r4 carried_reflected(t_r5 v, t_r4 row) {
    real along = v.a4 * (v.a0 * row.a0 + v.a1 * row.a1 + v.a2 * row.a2 + v.a3 * row.a3);
    return (t_r4){row.a0 - along * v.a0, row.a1 - along * v.a1, row.a2 - along * v.a2, row.a3 - along * v.a3};
}

INLINE void carried_carry(r2 S, r2 E, int64_t B, int traced) {
    int64_t i, j, k;
    real error, r, s1, s2, s3, s4, x1, x2, x3, x4, y1, y2, y3, y4, s5, x5, y5, x6, y6, east, north, own, out;
    t__r3_3 l, columns; t_r3 p, q, s, x, y, p1, one, two, last, a, d, c; t_r5 v; t_r4 q1; carried_flown(E, B, traced);
    carried_leave(S, E, B, traced);
    INDEPENDENT for (int64_t b = 0, end_b = B; b < end_b; b++) {
        i = b; j = B + b; k = 2 * B + b; error = AT2(E, 82, b); r = R(sqrt(AT2(E, 82, b)));
        l = (t__r3_3){vectors_three_in(E, 64, b), (t_r3){R(0.0), AT2(E, 67, b), AT2(E, 68, b)}, (t_r3){R(0.0), R(0.0),
            AT2(E, 69, b)}};
        p = carried_through(E, 54, l, i, j, k); q = carried_through(E, 55, l, i, j, k);
        s = carried_through(E, 56, l, i, j, k);
        x = vectors_plus(carried_through(E, 57, l, i, j, k), vectors_three_in(E, 70, b));
        y = vectors_plus(carried_through(E, 58, l, i, j, k), vectors_three_in(E, 73, b)); p1 = p;
        v = carried_reflection((t_r4){p1.a0, p1.a1, p1.a2, r});
        q1 = carried_reflected(v, (t_r4){q.a0, q.a1, q.a2, R(0.0)});
        t_r4 t_1 = carried_reflected(v, (t_r4){s.a0, s.a1, s.a2, R(0.0)}); s1 = t_1.a0; s2 = t_1.a1; s3 = t_1.a2;
        s4 = t_1.a3; t_r4 t_2 = carried_reflected(v, (t_r4){x.a0, x.a1, x.a2, R(0.0)}); x1 = t_2.a0; x2 = t_2.a1;
        x3 = t_2.a2; x4 = t_2.a3; t_r4 t_3 = carried_reflected(v, (t_r4){y.a0, y.a1, y.a2, R(0.0)}); y1 = t_3.a0;
        y2 = t_3.a1; y3 = t_3.a2; y4 = t_3.a3; one = (t_r3){p1.a0 - v.a0, q1.a0, s1};
        v = carried_reflection((t_r4){q1.a1, q1.a2, q1.a3, r});
        t_r4 t_4 = carried_reflected(v, (t_r4){s2, s3, s4, R(0.0)}); s2 = t_4.a0; s3 = t_4.a1; s4 = t_4.a2;
        s5 = t_4.a3; t_r4 t_5 = carried_reflected(v, (t_r4){x2, x3, x4, R(0.0)}); x2 = t_5.a0; x3 = t_5.a1;
        x4 = t_5.a2; x5 = t_5.a3; t_r4 t_6 = carried_reflected(v, (t_r4){y2, y3, y4, R(0.0)}); y2 = t_6.a0;
        y3 = t_6.a1; y4 = t_6.a2; y5 = t_6.a3; two = (t_r3){R(0.0), q1.a1 - v.a0, s2};
        v = carried_reflection((t_r4){s3, s4, s5, r}); t_r4 t_7 = carried_reflected(v, (t_r4){x3, x4, x5, R(0.0)});
        x3 = t_7.a0; x4 = t_7.a1; x5 = t_7.a2; x6 = t_7.a3;
        t_r4 t_8 = carried_reflected(v, (t_r4){y3, y4, y5, R(0.0)}); y3 = t_8.a0; y4 = t_8.a1; y5 = t_8.a2;
        y6 = t_8.a3; last = (t_r3){R(0.0), R(0.0), s3 - v.a0}; vectors_put_in(E, 64, b, one); AT2(E, 67, b) = two.a1;
        AT2(E, 68, b) = two.a2; AT2(E, 69, b) = last.a2; vectors_put_in(E, 70, b, (t_r3){x1, x2, x3});
        vectors_put_in(E, 73, b, (t_r3){y1, y2, y3});
        columns = (t__r3_3){vectors_three_in(E, 19, i), vectors_three_in(E, 19, j), vectors_three_in(E, 19, k)};
        a = carried_applied(columns, one); d = carried_applied(columns, two); c = carried_applied(columns, last);
        AT2(E, 86, b) = R(sqrt(vectors_dot(one, one) + vectors_dot(two, two) + vectors_dot(last, last)));
        AT2(E, 87, b) = R(sqrt(vectors_dot(a, a) + vectors_dot(d, d) + vectors_dot(c, c)));
        if (traced) {
            east = AT2(S, 115, b); north = AT2(S, 116, b); own = R(1.1102230246251565e-16) / AT2(S, 130, b);
            error = error + (error > R(0.0) ? own * own * (east * east + north * north) : R(0.0));
            AT2(E, 76, b) = AT2(E, 76, b) + (x4 * x4 + x5 * x5 + x6 * x6 + error);
            AT2(E, 77, b) = AT2(E, 77, b) + (y4 * y4 + y5 * y5 + y6 * y6 + error);
            out = x1 * x1 + x2 * x2 + x3 * x3 + (y1 * y1 + y2 * y2 + y3 * y3);
            AT2(E, 88, b) = R(sqrt(out + AT2(E, 76, b) + AT2(E, 77, b)));
        }
    }
    for (int64_t row = 0; row < 19; row++) {
        INDEPENDENT for (int64_t i = 0, end_i = 4 * B; i < end_i; i++) { AT2(E, row, i) = AT2(E, 19 + row, i); }
    }
}

INLINE real following_at_part(r2 curve, int64_t i, real s) {
    real r = s - R(1.0), power = s * s;
    real low = ((AT2(curve, 5, i) * s + AT2(curve, 4, i)) * s + AT2(curve, 3, i)) * s + AT2(curve, 2, i);
    real high = ((AT2(curve, 11, i) * r + AT2(curve, 10, i)) * r + AT2(curve, 9, i)) * r + AT2(curve, 8, i);
    low = (low * s + AT2(curve, 1, i)) * s + AT2(curve, 0, i);
    high = (high * r + AT2(curve, 7, i)) * r + AT2(curve, 6, i); return low + power * power * power * high;
}

INLINE void following_ball_at(r2 curve, real s, r1 body, int traced, r1 found) {
    t_r4 q = (t_r4){following_at_part(curve, 0, s), following_at_part(curve, 1, s), following_at_part(curve, 2, s),
        following_at_part(curve, 3, s)};
    q = vectors_scaled_four(R(1.0) / R(sqrt(vectors_square_of_four(q))), q);
    t_r4 t_1 = vectors_conjugate(q), t_2 = vectors_four(body, 6);
    t_r4 p = kernel_compose(t_1.a0, t_1.a1, t_1.a2, t_1.a3, t_2.a0, t_2.a1, t_2.a2, t_2.a3);
    t_r3 t_3 = vectors_three(body, 0);
    vectors_put(found, 0, kernel_rotate(p.a0, p.a1, p.a2, p.a3, t_3.a0, t_3.a1, t_3.a2));
    t_r3 t_4 = vectors_three(body, 3);
    vectors_put(found, 3, kernel_rotate(p.a0, p.a1, p.a2, p.a3, t_4.a0, t_4.a1, t_4.a2));
    vectors_put_four(found, 6, q);
    if (traced) { found.p[10] = following_at_part(curve, 4, s); found.p[11] = following_at_part(curve, 5, s); }
}

INLINE void following_recorded(Crew crew, int64_t B, int64_t b, int64_t i, real end, Asked asked, r2 reported) {
    r2 E = crew.E; r1 lane = r2_row(crew.lanes, b); real allowed = asked.allowed.p[i], most = asked.most.p[i];
    AT2(reported, i, 4) = AT2(reported, i, 4) + R(1.0);
    real cautious = R(20.0) + R(32.0) / AT2(reported, i, 4), off = lane.p[14], out = lane.p[15];
    real speed = lane.p[11] / lane.p[2], turned = R(2.0) * AT2(E, 86, b), spun = R(2.0) * AT2(E, 87, b);
    real rolled = R(2.0) * AT2(E, 88, b); AT2(reported, i, 3) = max_r(max_r(AT2(reported, i, 3), turned), rolled);
    turned = cautious * AT2(E, 83, b) + turned; rolled = cautious * AT2(E, 85, b) + rolled;
    AT2(reported, i, 0) = max_r(AT2(reported, i, 0), turned + off);
    AT2(reported, i, 2) = max_r(AT2(reported, i, 2), rolled + out); lane.p[7] = max_r(lane.p[7], speed);
    real left = max_r(turned, rolled), until = min_r((lane.p[0] + lane.p[1]) / end, R(1.0));
    real share = R(0.1) + R(0.9) * until;
    if (left > share * most && AT2(reported, i, 3) < R(0.25) * left && !asked.patient) {
        AT2(reported, i, 5) = min_r(until, R(0.999999999));
    }
    lane.p[18] = left > R(0.0) ? allowed * min_r(max_r(R(0.4) * most * share / left, R(0.02)), R(2.0)) : allowed;
    lane.p[8] = max_r(lane.p[8], cautious * AT2(E, 84, b) + spun + off * max_r(speed, following_spinning(E, B, b)));
}

INLINE void following_follow_lanes(int64_t B, Frames frames, Balls balls, Asked asked, Weights weights, Ends outcome,
    r2 reported) {
    int lost, done, there, alike; int64_t i, frame; real fate, part, wish; ALIGNED real S_[140 * (4 * B)];
    memset(S_, 0, sizeof S_); r2 S = {S_, 140, (4 * B), (4 * B)}; ALIGNED real E_[119 * (4 * B)];
    memset(E_, 0, sizeof E_); r2 E = {E_, 119, (4 * B), (4 * B)}; int64_t columns = weights.sums.n1;
    ALIGNED real states_[B * 27]; memset(states_, 0, sizeof states_); r2 states = {states_, B, 27, 27};
    ALIGNED int64_t exponents_[B]; memset(exponents_, 0, sizeof exponents_); i1 exponents = {exponents_, B};
    ALIGNED real bodies_[B * 24]; memset(bodies_, 0, sizeof bodies_); r2 bodies = {bodies_, B, 24, 24};
    ALIGNED real now_[24]; memset(now_, 0, sizeof now_); r1 now = {now_, 24}; ALIGNED real found_[24];
    memset(found_, 0, sizeof found_); r1 found = {found_, 24}; ALIGNED real lanes_[B * 22];
    memset(lanes_, 0, sizeof lanes_); r2 lanes = {lanes_, B, 22, 22}; ALIGNED real ends_[(2 * B) * 6 * 6];
    memset(ends_, 0, sizeof ends_); r3 ends = {ends_, (2 * B), 6, 6, 6 * 6, 6}; ALIGNED real V_[16 * 6];
    memset(V_, 0, sizeof V_); r2 V = {V_, 16, 6, 6}; ALIGNED real curves_[B * 12 * 6];
    memset(curves_, 0, sizeof curves_); r3 curves = {curves_, B, 12, 6, 12 * 6, 6};
    Crew crew = (Crew){S, E, bodies, states, lanes, ends, curves, V, now};
    int64_t count = frames.momenta.n0, kept = frames.momenta.n1; int traced = frames.traced;
    real interval = asked.interval, end = (kept - 1) * interval;
    int64_t coming = min_i(B, count), busy = min_i(B, count); int fresh = 1;
    for (int64_t b = 0, end_b = B; b < end_b; b++) {
        exponents.p[b] = following_taken_in(crew, B, b, min_i(b, count - 1), frames, balls, weights, asked);
        AT2(S, 135, b) = b < count ? R(0.0) : R(1.0);
    }
    while (busy > 0) {
        if (fresh) { carried_tangent(S, E, B, 0, traced); fresh = 0; }
        lost = lanes_side_by_side(S, B, traced, weights); carried_changes(S, E, B);
        for (int64_t b = 0, end_b = B; b < end_b; b++) {
            following_looked_at(crew, B, b, lost, traced, weights.sums, asked);
        }
        carried_tangent(S, E, B, 19, traced); carried_carry(S, E, B, traced);
        for (int64_t b = 0, end_b = B; b < end_b; b++) {
            i = (int64_t)AT2(lanes, b, 4); frame = (int64_t)AT2(lanes, b, 5); fate = AT2(lanes, b, 12); done = 0;
            if (fate == R(1.0)) {
                AT2(lanes, b, 6) = AT2(lanes, b, 6) + R(1.0); following_aimed(r2_row(lanes, b), kept, interval);
                lanes_resized(S, B, b, columns, R(0.5) * AT2(lanes, b, 1) * AT2(lanes, b, 2), r2_row(bodies, b),
                    r2_row(states, b));
            }
            else {
                if (fate == R(2.0)) {
                    outcome.status.p[i] = (int64_t)AT2(lanes, b, 16); outcome.reach.p[i] = AT2(lanes, b, 17);
                    outcome.taken.p[i] = frame - 1; done = 1; lanes_stopped_at(i, frame, frames);
                }
                else {
                    if (fate == R(3.0)) {
                        lanes_taken_out(S, b, now); part = following_part_of(r2_row(lanes, b), frame, interval);
                        while (frame < kept && part <= R(1.000000001)) {
                            if (R(fabs(part - R(1.0))) <= R(1e-09)) {
                                lanes_shown(now, exponents.p[b], i, frame, frames);
                            }
                            else {
                                following_ball_at(r3_row(curves, b), part, r2_row(bodies, b), traced, found);
                                lanes_shown(found, exponents.p[b], i, frame, frames);
                            }
                            frame = frame + 1; part = following_part_of(r2_row(lanes, b), frame, interval);
                        }
                        following_recorded(crew, B, b, i, end, asked, reported); int64_t t_1 = frame;
                        real t_2 = R(0.0), t_3 = AT2(lanes, b, 0) + AT2(lanes, b, 1); AT2(lanes, b, 5) = t_1;
                        AT2(lanes, b, 6) = t_2; AT2(lanes, b, 0) = t_3; AT2(lanes, b, 3) = AT2(lanes, b, 3) - R(1.0);
                        lanes_taken_out(S, b, r2_row(bodies, b)); there = AT2(lanes, b, 3) < R(0.5);
                        wish = min_r(AT2(lanes, b, 13), AT2(lanes, b, 20));
                        alike = wish * R(1.15) >= AT2(lanes, b, 1) && wish <= R(1.15) * AT2(lanes, b, 1);
                        if (there) { AT2(lanes, b, 0) = AT2(lanes, b, 19) * interval; }
                        done = there && AT2(lanes, b, 19) == kept - 1;
                        if (AT2(reported, i, 5) < R(1.0)) {
                            outcome.taken.p[i] = frame - 1; outcome.status.p[i] = 0; outcome.reach.p[i] = R(1.0);
                            done = 1;
                        }
                        else {
                            if (done) {
                                outcome.taken.p[i] = kept - 1; outcome.status.p[i] = 0; outcome.reach.p[i] = R(1.0);
                            }
                            else {
                                if ((there || !alike) && following_aimed(r2_row(lanes, b), kept, interval)) {
                                    lanes_resized(S, B, b, columns, R(0.5) * AT2(lanes, b, 1) * AT2(lanes, b, 2), now,
                                        r2_row(states, b));
                                }
                            }
                        }
                    }
                }
            }
            if (done) {
                AT2(reported, i, 1) = AT2(lanes, b, 7) > R(0.0) ? AT2(lanes, b, 8) / AT2(lanes, b, 7) : R(0.0);
                if (coming < count) {
                    exponents.p[b] = following_taken_in(crew, B, b, coming, frames, balls, weights, asked);
                    coming = coming + 1; fresh = 1;
                }
                else { AT2(S, 135, b) = R(1.0); busy = busy - 1; }
            }
        }
    }
}

INLINE void following_follow(Frames frames, Balls balls, Asked asked, Weights weights, Ends ends, r2 reported) {
    following_follow_lanes(8, frames, balls, asked, weights, ends, reported);
}

INLINE void following_follow_alone(Frames frames, Balls balls, Asked asked, Weights weights, Ends ends, r2 reported) {
    following_follow_lanes(1, frames, balls, asked, weights, ends, reported);
}

INLINE t_r2 expected_surveyed(r2 momenta, r2 verticals, r2 J0, r1 D0, r1 unit, real end, real accuracy, r2 found) {
    t_ri size, weight; t_r3 k, J, w, inertia, a, b, c, moved;
    real D, rate, least, condition, turned, root, walked, allowed, part, across; int64_t zeros; int known;
    real floor = R(0.0), single = R(0.0);
    for (int64_t i = 0, end_i = momenta.n0; i < end_i; i++) {
        size = real_frexp(vectors_largest(vectors_three(r2_row(momenta, i), 0)));
        weight = real_frexp(max_r(max_r(max_r(AT2(J0, i, 0), AT2(J0, i, 1)), AT2(J0, i, 2)), D0.p[i]));
        k = vectors_shifted(vectors_three(r2_row(momenta, i), 0), -size.a1);
        J = vectors_shifted(vectors_three(r2_row(J0, i), 0), -weight.a1); D = R(ldexp(D0.p[i], (int)-weight.a1));
        t_r3 t_1 = vectors_three(r2_row(verticals, i), 0);
        w = kernel_angular_velocity(k.a0, k.a1, k.a2, t_1.a0, t_1.a1, t_1.a2, J.a0, J.a1, J.a2, D);
        rate = R(ldexp(vectors_length(w), (int)(size.a1 - weight.a1))); inertia = branch_moments(J);
        least = min_r(min_r(inertia.a0, inertia.a1), inertia.a2);
        condition = least > R(0.0) ? (max_r(max_r(inertia.a0, inertia.a1), inertia.a2) + D) / least :
            R(1.0715086071862673e+301);
        zeros = (k.a0 == R(0.0) ? 1 : 0) + (k.a1 == R(0.0) ? 1 : 0) + (k.a2 == R(0.0) ? 1 : 0); turned = rate * end;
        root = R(sqrt(condition)); walked = R(sqrt(R(1.0) + R(40.0) * turned)); AT2(found, 0, i) = rate;
        AT2(found, 1, i) = condition;
        AT2(found, 2, i) = (zeros > 1 || (J.a0 == J.a1 && J.a1 == J.a2)) ? R(1.0) : R(0.0);
        AT2(found, 3, i) = R(1.1102230246251565e-16) * ((R(1.0) + turned) * (R(2.0) * root + walked) + R(8.0) *
            condition) * unit.p[i];
        AT2(found, 4, i) = R(1.1102230246251565e-16) * ((R(1.0) + turned) * (R(2.0) * root + R(1.0)) + R(8.0) *
            condition) * unit.p[i];
        allowed = end > R(0.0) ? R(0.5) * accuracy / unit.p[i] / R(600.0) / end : R(1.0);
        part = rate > R(0.0) ? R(sqrt(R(sqrt(R(sqrt(R(sqrt(min_r(allowed / (R(3e-09) * rate), R(1.0)))))))))) :
            R(1.0);
        part = R(1.7) * part * R(sqrt(part)); AT2(found, 5, i) = rate * end > part ? min_r(part / rate, end) : end;
        AT2(found, 6, i) = allowed; AT2(found, 7, i) = accuracy / unit.p[i];
        t_r3 t_2 = vectors_three(r2_row(verticals, i), 0);
        a = kernel_angular_velocity(k.a0, R(0.0), R(0.0), t_2.a0, t_2.a1, t_2.a2, J.a0, J.a1, J.a2, D);
        t_r3 t_3 = vectors_three(r2_row(verticals, i), 0);
        b = kernel_angular_velocity(R(0.0), k.a1, R(0.0), t_3.a0, t_3.a1, t_3.a2, J.a0, J.a1, J.a2, D);
        t_r3 t_4 = vectors_three(r2_row(verticals, i), 0);
        c = kernel_angular_velocity(R(0.0), R(0.0), k.a2, t_4.a0, t_4.a1, t_4.a2, J.a0, J.a1, J.a2, D);
        moved = (t_r3){R(fabs(a.a0)) + R(fabs(b.a0)) + R(fabs(c.a0)), R(fabs(a.a1)) + R(fabs(b.a1)) + R(fabs(c.a1)),
            R(fabs(a.a2)) + R(fabs(b.a2)) + R(fabs(c.a2))};
        across = vectors_length(w) > R(0.0) ? vectors_length(moved) / vectors_length(w) : R(0.0);
        AT2(found, 8, i) = R(2.220446049250313e-16) * max_r(root, R(0.25) * across);
        known = AT2(found, 3, i) <= R(1.0715086071862673e+301);
        floor = max_r(floor, known ? AT2(found, 3, i) : R(INFINITY)); single = max_r(single, AT2(found, 2, i));
    }
    return (t_r2){floor, single};
}

INLINE real expected_estimated(r2 found, r2 reported, r1 unit, int turned, int spun, int rolled, r1 error, r1 noise,
    r1 started, i1 total) {
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
        total.p[i] = (int64_t)AT2(reported, i, 4); worst = !(error.p[i] <= worst) ? error.p[i] : worst;
    }
    return worst;
}

#endif
#ifndef LIBRARY
#ifdef LONG
WIDEST static void in_lanes_march(const argument *a, argument *got) {
    lanes_march((Frames){r3_(0), r3_(1), r3_(2), r3_(3), b_(4), b_(5)}, (Balls){r2_(6), r1_(7), r1_(8)},
        (Ends){i1_(9), i1_(10), d1_(11)}, r_(12), (Steps){i_(13), i_(14), i_(15)}, (Weights){r2_(16), r3_(17),
        r2_(18)}, r2_(19));
    (void)got;
}

WIDER static void in_lanes_march_alone(const argument *a, argument *got) {
    lanes_march_alone((Frames){r3_(0), r3_(1), r3_(2), r3_(3), b_(4), b_(5)}, (Balls){r2_(6), r1_(7), r1_(8)},
        (Ends){i1_(9), i1_(10), d1_(11)}, r_(12), (Steps){i_(13), i_(14), i_(15)}, (Weights){r2_(16), r3_(17),
        r2_(18)}, r2_(19));
    (void)got;
}

WIDEST static void in_following_follow(const argument *a, argument *got) {
    following_follow((Frames){r3_(0), r3_(1), r3_(2), r3_(3), b_(4), b_(5)}, (Balls){r2_(6), r1_(7), r1_(8)},
        (Asked){r1_(9), r1_(10), r1_(11), r1_(12), r_(13), b_(14)}, (Weights){r2_(15), r3_(16), r2_(17)},
        (Ends){i1_(18), i1_(19), d1_(20)}, r2_(21));
    (void)got;
}

WIDER static void in_following_follow_alone(const argument *a, argument *got) {
    following_follow_alone((Frames){r3_(0), r3_(1), r3_(2), r3_(3), b_(4), b_(5)}, (Balls){r2_(6), r1_(7), r1_(8)},
        (Asked){r1_(9), r1_(10), r1_(11), r1_(12), r_(13), b_(14)}, (Weights){r2_(15), r3_(16), r2_(17)},
        (Ends){i1_(18), i1_(19), d1_(20)}, r2_(21));
    (void)got;
}

#else
static void in_loop_prepare(const argument *a, argument *got) {
    real out = loop_prepare(r1_(0), r1_(1), r1_(2), r_(3), r1_(4), r1_(5), r2_(6)); got[0].number = out;
}

static void in_loop_march(const argument *a, argument *got) {
    t_i2r out = loop_march((Moving){r1_(0), r2_(1), r2_(2), r1_(3), r1_(4), r_(5)}, (Stages){r1_(6), r3_(7)},
        (Steps){i_(8), i_(9), i_(10)}, i_(11), r_(12), (Track){r2_(13), r2_(14), r2_(15), r2_(16), b_(17)});
    got[0].integer = out.a0; got[1].integer = out.a1; got[2].number = out.a2;
}

static void in_loop_advance_all(const argument *a, argument *got) {
    loop_advance_all(r2_(0), r2_(1), r2_(2), r1_(3), r2_(4), i1_(5), d1_(6)); (void)got;
}

WIDEST static void in_block_march_blocks(const argument *a, argument *got) {
    block_march_blocks((Block){r2_(0), r2_(1), r2_(2), r2_(3), r2_(4), r1_(5)}, (Stages){r1_(6), r3_(7)},
        (Steps){i_(8), i_(9), i_(10)}, (Start){r2_(11), r2_(12), r2_(13), r1_(14)}, r1_(15), (Frames){r3_(16),
        r3_(17), r3_(18), r3_(19), b_(20), b_(21)}, (Ends){i1_(22), i1_(23), d1_(24)}, r2_(25));
    (void)got;
}

WIDEST static void in_block_advance_blocks(const argument *a, argument *got) {
    block_advance_blocks(r2_(0), r2_(1), r2_(2), r1_(3), r2_(4), i1_(5), d1_(6)); (void)got;
}

#ifndef SINGLE
static void in_loop_n_march(const argument *a, argument *got) {
    int64_t out = loop_n_march((Under){r2_(0), r1_(1), r1_(2), r_(3), r1_(4), r1_(5), r1_(6), r4_(7), r2_(8), r_(9),
        r2_(10), r1_(11), r_(12)}, (Steps){i_(13), i_(14), i_(15)}, (Track){r2_(16), r2_(17), r2_(18), r2_(19),
        b_(20)}, r2_(21));
    got[0].integer = out;
}

static void in_vertical_loop_march(const argument *a, argument *got) {
    int out = vertical_loop_march(r1_(0), r1_(1), r_(2), (Steps){i_(3), i_(4), i_(5)}, r2_(6), r1_(7));
    got[0].integer = out;
}

static void in_double_double_prepare_pairs(const argument *a, argument *got) {
    t_i2 out = double_double_prepare_pairs(r1_(0), r1_(1), r1_(2), r_(3), r2_(4), r1_(5), r2_(6));
    got[0].integer = out.a0; got[1].integer = out.a1;
}

WIDER static void in_double_double_march_pairs(const argument *a, argument *got) {
    t_i2r out = double_double_march_pairs((Moving){r1_(0), r2_(1), r2_(2), r1_(3), r1_(4), r_(5)}, r2_(6),
        (Steps){i_(7), i_(8), i_(9)}, i_(10), i_(11), (Track){r2_(12), r2_(13), r2_(14), r2_(15), b_(16)},
        (Track){r2_(17), r2_(18), r2_(19), r2_(20), b_(21)}, (Proof){r2_(22), r1_(23), r2_(24)});
    got[0].integer = out.a0; got[1].integer = out.a1; got[2].number = out.a2;
}

static void in_double_double_prepare_pairs_block(const argument *a, argument *got) {
    double_double_prepare_pairs_block((Start){r2_(0), r2_(1), r2_(2), r1_(3)}, r2_(4), r2_(5), i1_(6), i1_(7));
    (void)got;
}

WIDEST static void in_double_double_march_pairs_block(const argument *a, argument *got) {
    double_double_march_pairs_block(r2_(0), (Steps){i_(1), i_(2), i_(3)}, i1_(4), (Frames){r3_(5), r3_(6), r3_(7),
        r3_(8), b_(9), b_(10)}, (Frames){r3_(11), r3_(12), r3_(13), r3_(14), b_(15), b_(16)}, (Ends){i1_(17), i1_(18),
        d1_(19)});
    (void)got;
}

WIDER static void in_double_double_march_long_pairs(const argument *a, argument *got) {
    t_i2r2 out = double_double_march_long_pairs((Still){r1_(0), r1_(1), r1_(2), r1_(3), r_(4), r_(5)}, r_(6), r_(7),
        r2_(8), (Steps){i_(9), i_(10), i_(11)}, r1_(12), (Track){r2_(13), r2_(14), r2_(15), r2_(16), b_(17)},
        (Track){r2_(18), r2_(19), r2_(20), r2_(21), b_(22)});
    got[0].integer = out.a0; got[1].integer = out.a1; got[2].number = out.a2; got[3].number = out.a3;
}

WIDER static void in_proved_bound_steps(const argument *a, argument *got) {
    proved_bound_steps(r2_(0), r2_(1), r2_(2), r1_(3), r2_(4), r2_(5), r2_(6), r2_(7)); (void)got;
}

WIDER static void in_tangent_follow_all(const argument *a, argument *got) {
    tangent_follow_all(r2_(0), r2_(1), r1_(2), r_(3), i_(4), r2_(5)); (void)got;
}

static void in_expected_surveyed(const argument *a, argument *got) {
    t_r2 out = expected_surveyed(r2_(0), r2_(1), r2_(2), r1_(3), r1_(4), r_(5), r_(6), r2_(7));
    got[0].number = out.a0; got[1].number = out.a1;
}

static void in_expected_estimated(const argument *a, argument *got) {
    real out = expected_estimated(r2_(0), r2_(1), r1_(2), b_(3), b_(4), b_(5), r1_(6), r1_(7), r1_(8), i1_(9));
    got[0].number = out;
}

#endif
#endif

const loop_export LOOPS()[] = {
#ifdef LONG
    {"lanes_march", "r3* r3* r3* r3* b* b* r2 r1 r1 i1* i1* d1* r i i i r2 r3 r2 r2*", "", in_lanes_march},
    {"lanes_march_alone", "r3* r3* r3* r3* b* b* r2 r1 r1 i1* i1* d1* r i i i r2 r3 r2 r2*", "", in_lanes_march_alone},
    {"following_follow", "r3* r3* r3* r3* b* b* r2 r1 r1 r1 r1 r1 r1 r b r2 r3 r2 i1* i1* d1* r2*", "", in_following_follow},
    {"following_follow_alone", "r3* r3* r3* r3* b* b* r2 r1 r1 r1 r1 r1 r1 r b r2 r3 r2 i1* i1* d1* r2*", "", in_following_follow_alone},
#else
    {"loop_prepare", "r1 r1 r1 r r1 r1* r2*", "r", in_loop_prepare},
    {"loop_march", "r1* r2* r2* r1* r1* r* r1 r3 i i i i r r2* r2* r2* r2* b*", "iir", in_loop_march},
    {"loop_advance_all", "r2* r2* r2 r1 r2* i1* d1*", "", in_loop_advance_all},
    {"block_march_blocks", "r2* r2* r2* r2* r2* r1* r1 r3 i i i r2 r2 r2 r1 r1 r3* r3* r3* r3* b* b* i1* i1* d1* r2*", "", in_block_march_blocks},
    {"block_advance_blocks", "r2* r2* r2 r1 r2* i1* d1*", "", in_block_advance_blocks},
#ifndef SINGLE
    {"loop_n_march", "r2* r1* r1* r* r1* r1* r1* r4* r2* r* r2* r1* r* i i i r2* r2* r2* r2* b* r2*", "i", in_loop_n_march},
    {"vertical_loop_march", "r1* r1 r i i i r2* r1*", "b", in_vertical_loop_march},
    {"double_double_prepare_pairs", "r1 r1 r1 r r2 r1* r2*", "ii", in_double_double_prepare_pairs},
    {"double_double_march_pairs", "r1* r2* r2* r1* r1* r* r2 i i i i i r2* r2* r2* r2* b* r2* r2* r2* r2* b* r2* r1* r2*", "iir", in_double_double_march_pairs},
    {"double_double_prepare_pairs_block", "r2 r2 r2 r1 r2 r2* i1* i1*", "", in_double_double_prepare_pairs_block},
    {"double_double_march_pairs_block", "r2* i i i i1 r3* r3* r3* r3* b* b* r3* r3* r3* r3* b* b* i1* i1* d1*", "", in_double_double_march_pairs_block},
    {"double_double_march_long_pairs", "r1 r1 r1 r1 r r r r r2 i i i r1* r2* r2* r2* r2* b* r2* r2* r2* r2* b*", "iirr", in_double_double_march_long_pairs},
    {"proved_bound_steps", "r2 r2 r2 r1 r2 r2 r2 r2*", "", in_proved_bound_steps},
    {"tangent_follow_all", "r2 r2 r1 r i r2*", "", in_tangent_follow_all},
    {"expected_surveyed", "r2 r2 r2 r1 r1 r r r2*", "rr", in_expected_surveyed},
    {"expected_estimated", "r2 r2 r1 b b b r1* r1* r1* i1*", "r", in_expected_estimated},
#endif
#endif
};
const int LOOPS(_count) = sizeof LOOPS() / sizeof *LOOPS();
#if !defined(SINGLE) && !defined(LONG)
const char loops_text[] = "bd35df7e1c1a32abc8d563f8f25b689bf62a23155defcacd6bcbbc3dfa1b676d";
#endif
#endif
