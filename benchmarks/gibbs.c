/* chapsym's loop for one ball in C, to be timed beside it; kernels.h has the generated kernels, line by line.

   u = q/q0 is extrapolated by the polynomial through its last 8 values, a Newton iterate (and a second correction) is
   checked, k = K/2 and g are turned with compensated sums, and their integrals restored, as in chapsym's loop. */

#include <math.h>
#include "kernels.h"

#define POINTS 8
#define PERIOD 1024
#define MOST_ROUNDS 12

typedef struct { double I1, I2, I3, D, radius, enough; } ball;  /* enough: |d|^2 of a correction that is the last */
typedef struct { double high, low; } pair;

/* One round from the guess u: the quaternion p of the rotation, and its Gibbs vector in u.  Returns whether it settled. */
static inline int settle(double p[4], double u[3], const double k[3], const double g[3], ball b) {
    double out[13], e[3], d[3], w[3];
    if (!(u[0] * u[0] + (u[1] * u[1] + u[2] * u[2]) <= b.radius)) return 0;
    gibbs_newton(u[0], u[1], u[2], k[0], k[1], k[2], g[0], g[1], g[2], b.I1, b.I2, b.I3, b.D, out);
    double scale = 1 / out[0];
    for (int i = 0; i < 4; i++) p[i] = out[i];
    for (int i = 0; i < 3; i++) w[i] = p[i + 1] * scale, d[i] = w[i] - u[i];
    for (int i = 0; i < 3; i++) u[i] = w[i];
    double first = d[0] * d[0] + (d[1] * d[1] + d[2] * d[2]);
    if (first <= b.enough) return 1;
    gibbs_second(d[0], d[1], d[2], k[0], k[1], k[2], out[4], out[5], out[6], out[7], out[8], out[9], out[10], out[11],
                 out[12], b.I1, b.I2, b.I3, e);
    for (int i = 0; i < 3; i++) p[i + 1] -= e[i], u[i] = p[i + 1] * scale;
    double second = (e[0] * e[0] + (e[1] * e[1] + e[2] * e[2])) * (scale * scale);
    double size = u[0] * u[0] + (u[1] * u[1] + u[2] * u[2]);
    return 9 * fmax(first, second) * second <= b.enough * b.enough && size <= b.radius;
}

/* Rounds of settle from a poor guess, and from no rotation where that leads nowhere. */
static int search(double p[4], double u[3], const double k[3], const double g[3], ball b) {
    for (int guess = 0; guess < 2; guess++) {
        if (guess == 1) u[0] = u[1] = u[2] = 0;
        for (int round = 0; round < MOST_ROUNDS; round++)
            if (settle(p, u, k, g, b)) return 1;
    }
    return 0;
}

/* v += y, where c is what was rounded away before, and after. */
static inline void accumulate(double v[3], double c[3], const double y[3]) {
    for (int i = 0; i < 3; i++) {
        double z = y[i] - c[i], sum = v[i] + z;
        c[i] = (sum - v[i]) - z;
        v[i] = sum;
    }
}

/* <a, b> + start to twice the working precision. */
static pair inner(const double a[3], const double b[3], pair start) {
    pair s = start;
    for (int i = 0; i < 3; i++) {
        double product = a[i] * b[i], rest = fma(a[i], b[i], -product);
        double sum = s.high + product, part = sum - s.high;
        s.low += ((s.high - (sum - part)) + (product - part)) + rest;
        s.high = sum;
    }
    return s;
}

static double lost(const double a[3], const double b[3], pair kept) {
    double minus[3] = {-b[0], -b[1], -b[2]};
    pair s = inner(a, minus, kept);
    return s.high + s.low;
}

/* Corrects the compensations so that the vectors k - x and g - y have their integrals again. */
static void restore(const double k[3], const double g[3], double x[3], double y[3], const pair kept[3]) {
    const pair none = {0, 0};
    double unit = lost(g, g, kept[0]) + 2 * inner(g, y, none).high;
    double height = lost(k, g, kept[1]) + inner(k, y, none).high + inner(g, x, none).high;
    double squared = lost(k, k, kept[2]) + 2 * inner(k, x, none).high;
    double h = kept[1].high, n = kept[2].high, stretch = 0.5 * unit / kept[0].high;
    if (!(n > 0)) return;
    height -= stretch * h;
    double sine = kept[0].high - h * h / n, along_gamma = 0, along_k = 0.5 * squared / n;
    if (sine > 1e-6) {
        along_gamma = (height - 0.5 * squared * h / n) / sine;
        along_k = (0.5 * squared - along_gamma * h) / n;
    }
    for (int i = 0; i < 3; i++) {
        x[i] -= along_k * k[i] + along_gamma * g[i];
        y[i] -= stretch * g[i];
    }
}

/* Takes `steps` steps of (k, g) in place; returns how many were taken. */
long gibbs_march(double *k_out, double *g_out, const double *I, double D, double radius, double enough, long steps) {
    static const double weights[POINTS] = {8, -28, 56, -70, 56, -28, 8, -1};
    ball b = {I[0], I[1], I[2], D, radius, enough};
    double k[3], g[3], x[3] = {0}, y[3] = {0}, sums[POINTS + 1][3] = {{0}};
    for (int i = 0; i < 3; i++) k[i] = k_out[i], g[i] = g_out[i];
    const pair none = {0, 0}, kept[3] = {inner(g, g, none), inner(k, g, none), inner(k, k, none)};
    long n;
    for (n = 0; n < steps; n++) {
        double p[4], w[3] = {sums[0][0], sums[0][1], sums[0][2]}, v[3];
        if (!settle(p, w, k, g, b) && !search(p, w, k, g, b)) break;
        /* The extrapolation as a filter: only its first weight waits for the last value. */
        for (int j = 0; j < POINTS; j++)
            for (int i = 0; i < 3; i++) sums[j][i] = sums[j + 1][i] + weights[j] * w[i];
        turn(p[0], p[1], p[2], p[3], k[0], k[1], k[2], v);
        accumulate(k, x, v);
        turn(p[0], p[1], p[2], p[3], g[0], g[1], g[2], v);
        accumulate(g, y, v);
        if ((n + 1) % PERIOD == 0) restore(k, g, x, y, kept);
    }
    for (int i = 0; i < 3; i++) k_out[i] = k[i], g_out[i] = g[i];
    return n;
}
