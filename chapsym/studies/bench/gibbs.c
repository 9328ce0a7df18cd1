/* The loop of chapsym in C, to be timed beside it: one ball, the small-rotation branch.

   u = q/q0 solves B u + u x Lu = k (1 + |u|^2) with k = K/2, L = diag(J2 + J3 + D, ...), B = L - D g g^T.
   It is extrapolated from six steps and corrected; the residual after a Newton step d is exactly
   d x Ld - k |d|^2.  K and g are carried by compensated sums. */

#include <math.h>

#define PAST 6
#define MOST 30

typedef struct { double x, y, z; } vec;

static inline vec add(vec a, vec b) { return (vec){a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline vec scaled(double s, vec a) { return (vec){s * a.x, s * a.y, s * a.z}; }
static inline double dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline vec cross(vec a, vec b) {
    return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/* a x La: only differences of the moments enter. */
static inline vec twist(vec a, vec E) { return (vec){E.x * a.y * a.z, E.y * a.z * a.x, E.z * a.x * a.y}; }

typedef struct { double b11, b22, b33, b12, b13, b23; } sym;
typedef struct { vec r1, r2, r3; } mat;  /* rows */

static inline vec times(mat m, vec a) { return (vec){dot(m.r1, a), dot(m.r2, a), dot(m.r3, a)}; }

/* The inverse of the derivative of the equation at u. */
static inline mat inverse(vec u, vec k, sym b, vec E) {
    double a11 = b.b11 - 2 * k.x * u.x, a12 = b.b12 + E.x * u.z - 2 * k.x * u.y, a13 = b.b13 + E.x * u.y - 2 * k.x * u.z;
    double a21 = b.b12 + E.y * u.z - 2 * k.y * u.x, a22 = b.b22 - 2 * k.y * u.y, a23 = b.b23 + E.y * u.x - 2 * k.y * u.z;
    double a31 = b.b13 + E.z * u.y - 2 * k.z * u.x, a32 = b.b23 + E.z * u.x - 2 * k.z * u.y, a33 = b.b33 - 2 * k.z * u.z;
    double c11 = a22 * a33 - a23 * a32, c12 = a23 * a31 - a21 * a33, c13 = a21 * a32 - a22 * a31;
    double s = 1 / (a11 * c11 + a12 * c12 + a13 * c13);
    return (mat){{s * c11, s * (a13 * a32 - a12 * a33), s * (a12 * a23 - a13 * a22)},
                 {s * c12, s * (a11 * a33 - a13 * a31), s * (a13 * a21 - a11 * a23)},
                 {s * c13, s * (a12 * a31 - a11 * a32), s * (a11 * a22 - a12 * a21)}};
}

/* Newton's iteration from *u; each step is followed by one with the same inverse.  Returns whether it settled. */
static inline int solve(vec *u, vec k, sym b, vec E) {
    for (int i = 0; i < MOST; i++) {
        vec v = *u;
        double w = 1 + dot(v, v);
        vec t = twist(v, E);
        vec r = {b.b11 * v.x + b.b12 * v.y + b.b13 * v.z + t.x - w * k.x,
                 b.b12 * v.x + b.b22 * v.y + b.b23 * v.z + t.y - w * k.y,
                 b.b13 * v.x + b.b23 * v.y + b.b33 * v.z + t.z - w * k.z};
        mat inv = inverse(v, k, b, E);
        vec d = scaled(-1, times(inv, r));
        double dd = dot(d, d), size = dot(v, v);
        *u = add(v, d);
        if (dd * dd <= 1e-34 * size) return 1;
        vec e = scaled(-1, times(inv, add(twist(d, E), scaled(-dd, k))));
        *u = add(*u, e);
        if (dd * dot(e, e) <= 1e-34 * size) return 1;
    }
    return 0;
}

/* s += y, with what was rounded away kept in c. */
static inline void accumulate(double *s, double *c, double y) {
    double z = y - *c, t = *s + z;
    *c = (t - *s) - z;
    *s = t;
}

static inline void turn(vec *v, vec *c, vec u, double f) {
    vec a = cross(u, *v), b = cross(u, a);
    accumulate(&v->x, &c->x, f * (b.x - a.x));
    accumulate(&v->y, &c->y, f * (b.y - a.y));
    accumulate(&v->z, &c->z, f * (b.z - a.z));
}

/* Takes `steps` steps in place; returns how many were taken. */
long gibbs_march(double *momentum, double *gamma, const double *J, double D, long steps) {
    vec K = {momentum[0], momentum[1], momentum[2]}, g = {gamma[0], gamma[1], gamma[2]};
    vec E = {J[1] - J[2], J[2] - J[0], J[0] - J[1]};
    double S1 = J[1] + J[2], S2 = J[0] + J[2], S3 = J[0] + J[1];
    vec cK = {0, 0, 0}, cg = {0, 0, 0}, past[PAST] = {{0}};
    long n;
    for (n = 0; n < steps; n++) {
        vec k = scaled(0.5, K);
        double g1 = D * g.x * g.x, g2 = D * g.y * g.y, g3 = D * g.z * g.z;
        sym b = {S1 + (g2 + g3), S2 + (g1 + g3), S3 + (g1 + g2), -D * g.x * g.y, -D * g.x * g.z, -D * g.y * g.z};
        vec u;
        if (n >= PAST) {
            vec *p = past;
            u.x = 6 * (p[0].x + p[4].x) - 15 * (p[1].x + p[3].x) + (20 * p[2].x - p[5].x);
            u.y = 6 * (p[0].y + p[4].y) - 15 * (p[1].y + p[3].y) + (20 * p[2].y - p[5].y);
            u.z = 6 * (p[0].z + p[4].z) - 15 * (p[1].z + p[3].z) + (20 * p[2].z - p[5].z);
        } else {
            u = n ? past[0] : (vec){0, 0, 0};
        }
        if (!solve(&u, k, b, E)) break;
        for (int i = PAST - 1; i > 0; i--) past[i] = past[i - 1];
        past[0] = u;
        double f = 2 / (1 + dot(u, u));
        turn(&K, &cK, u, f);
        turn(&g, &cg, u, f);
    }
    momentum[0] = K.x, momentum[1] = K.y, momentum[2] = K.z;
    gamma[0] = g.x, gamma[1] = g.y, gamma[2] = g.z;
    return n;
}
