/* The kernels of rolling_disc, each from a proved expression: for other languages.
 * Written by `chapsym codegen`: do not edit; change the derivation and generate again. */
#ifndef ROLLING_DISC_H
#define ROLLING_DISC_H

#ifdef __cplusplus
extern "C" {
#endif

/* Of a kernel with N roundings each result is off by at most N 2^-53 (1 + 2^-10) of its terms, if nothing over- or
   underflows and no divisor is below 2^-25 of its own terms (lemma `rounding` of chapsym).  Terms are a formula with
   every sum taken absolutely: |x| of an argument, terms(a) + terms(b) of a + b and a - b, terms(a) terms(b) of a b,
   terms(a) terms(b)/b^2 of a/b. */

/* The second derivatives of heading, lean and turn, in the rates of the angles. result: a1, a2, a3. */
void rolling_disc_accelerations(double lean, const double rates[3], double radius, double gravity, double result[3]);

/* The derivatives of the angular velocity along L.x, L.y, L.z. result: b1, b2, b3. */
void rolling_disc_spin_rates(double lean, const double spin[3], double radius, double gravity, double result[3]);

/* What vanishes where the middle is that of a step of the midpoint rule. result: f1, f2, f3, f4. */
void rolling_disc_step_lack(const double middle[4], const double start[4], double radius, double gravity, double step,
    double result[4]);

/* Its derivatives by the middle, row by row. result: j11, j12, j13, j14, j21, j22, j23, j24, j31, j32, j33, j34, j41,
    j42, j43, j44. */
void rolling_disc_step_slope(const double middle[4], const double start[4], double radius, double gravity, double
    step, double result[16]);

/* The velocity of the centre along L.x and L.y, for which the disc does not slip. result: v1, v2. Roundings: 1. */
void rolling_disc_velocity(const double spin[3], double radius, double result[2]);

#ifdef __cplusplus
}
#endif
#endif
