/* The kernels of suslov, each from a proved expression: for other languages.
 * Written by `chapsym codegen`: do not edit; change the derivation and generate again. */
#ifndef SUSLOV_H
#define SUSLOV_H

#ifdef __cplusplus
extern "C" {
#endif

/* Of a kernel with N roundings each result is off by at most N 2^-53 (1 + 2^-10) of its terms, if nothing over- or
   underflows and no divisor is below 2^-25 of its own terms (lemma `rounding` of chapsym).  Terms are a formula with
   every sum taken absolutely: |x| of an argument, terms(a) + terms(b) of a + b and a - b, terms(a) terms(b) of a b,
   terms(a) terms(b)/b^2 of a/b. */

/* The momentum with which the turn of a Gibbs vector ends, and the next one starts. result: m1, m2. Roundings: 9. */
void suslov_after(const double gibbs[2], const double mass_tensor[5], double result[2]);

/* The energy of a momentum, which the map keeps. result: e. Roundings: 4. */
void suslov_energy(const double momentum[2], const double mass_tensor[5], double result[1]);

/* What vanishes where the turn of a Gibbs vector starts with a momentum. result: r1, r2. Roundings: 7. */
void suslov_residual(const double gibbs[2], const double momentum[2], const double mass_tensor[5], double result[2]);

/* Its derivatives by the Gibbs vector, row by row. result: a11, a12, a21, a22. Roundings: 3. */
void suslov_residual_jacobian(const double gibbs[2], const double momentum[2], const double mass_tensor[5], double
    result[4]);

/* The matrix of the turn of a Gibbs vector, row by row. result: t11, t12, t13, t21, t22, t23, t31, t32, t33, 3 rows.
    Roundings: 8. */
void suslov_turn(const double gibbs[2], double result[9]);

#ifdef __cplusplus
}
#endif
#endif
