/* Steps of a method: the unknowns by Newton's iteration, then the next state. The sizes and `tableau` stand before. */
#include <stdint.h>

static _Thread_local double matrix[UNKNOWNS][UNKNOWNS], right[UNKNOWNS];
static _Thread_local int order[UNKNOWNS];

/* Factors the matrix, by elimination with the largest pivots; 0 where one is 0. */
static int factored(void) {
    for (int i = 0; i < UNKNOWNS; i++) {
        int best = i;
        for (int n = i + 1; n < UNKNOWNS; n++)
            if (fabs(matrix[n][i]) > fabs(matrix[best][i])) best = n;
        if (!(fabs(matrix[best][i]) > 0 && fabs(matrix[best][i]) < INFINITY)) return 0;
        order[i] = best;
        for (int j = 0; j < UNKNOWNS && best != i; j++) {
            double kept = matrix[i][j];
            matrix[i][j] = matrix[best][j], matrix[best][j] = kept;
        }
        for (int n = i + 1; n < UNKNOWNS; n++) {
            double factor = matrix[n][i] /= matrix[i][i];
            for (int j = i + 1; j < UNKNOWNS && factor != 0; j++) matrix[n][j] -= factor * matrix[i][j];
        }
    }
    return 1;
}

/* Solves matrix · x = right in place, where the matrix is factored. */
static void substituted(void) {
    for (int i = 0; i < UNKNOWNS; i++) {
        double kept = right[order[i]];
        right[order[i]] = right[i], right[i] = kept;
    }
    for (int i = 1; i < UNKNOWNS; i++)
        for (int j = 0; j < i; j++) right[i] -= matrix[i][j] * right[j];
    for (int i = UNKNOWNS - 1; i >= 0; i--) {
        for (int j = i + 1; j < UNKNOWNS; j++) right[i] -= matrix[i][j] * right[j];
        right[i] /= matrix[i][i];
    }
}

/* Solves the equations of a step from a guess; 0 where that does not settle. Linear ones take one round. */
static int solved(const double *state, double *unknowns, const double *fixed) {
    double before = INFINITY;
    for (int round = 0, is_factored = 0; round < MOST_ROUNDS; round++) {
        if (!is_factored) {
            system_slope(GIVEN(state), matrix[0]);
            if (!(is_factored = factored())) return 0;
        }
        system_residual(GIVEN(state), right);
        substituted();
        double largest = 0;
        for (int i = 0; i < UNKNOWNS; i++) {
            unknowns[i] -= right[i];
            double change = fabs(right[i]) / (1 + fabs(unknowns[i]));
            if (!(change <= largest)) largest = change;
        }
        if (!(largest < INFINITY)) return 0;
        double next = largest / before * largest; /* what the next correction will be about */
        if (STAGES || largest <= LAST || (round && next <= LAST) || (largest < STAYS && largest >= before / 2)) return 1;
        is_factored = largest <= SHRINKS * before && round > 0;
        before = largest;
    }
    return 0;
}

/* One step of an explicit method, whose first stage has its unknowns; 0 where an acceleration is not found. */
static int stepped(double *state, double *unknowns, const double *fixed, double step) {
    double rates[STAGES + 1][STATE];
    const double *row = tableau;
    system_after(GIVEN(state), rates[0]);
    for (int stage = 1; stage <= STAGES; row += stage, stage++) {
        double at[STATE];
        for (int i = 0; i < STATE; i++) {
            double sum = 0;
            for (int k = 0; k < stage; k++) sum += row[k] * rates[k][i];
            at[i] = state[i] + step * sum;
        }
        if (stage == STAGES) {
            for (int i = 0; i < STATE; i++) state[i] = at[i];
        } else {
            if (!solved(at, unknowns, fixed)) return 0;
            system_after(GIVEN(at), rates[stage]);
        }
    }
    return 1;
}

/* Takes steps from one number to another, and records every `every`th; the number of the last one that was not found, or
   the end. `last` has the unknowns of the two steps before. */
int64_t march(int64_t first, int64_t end, int64_t every, double *state, double *unknowns, double *last,
              const double *fixed, double *recorded) {
    double next[STATE];
    for (int64_t n = first; n < end; n++) {
        for (int i = 0; i < UNKNOWNS && !STAGES && n > 0; i++) { /* the parabola through the last three */
            double now = unknowns[i];
            if (n > 2) unknowns[i] = 3 * (now - last[i]) + last[UNKNOWNS + i];
            last[UNKNOWNS + i] = last[i], last[i] = now;
        }
        if (!solved(state, unknowns, fixed)) return n;
        if (n % every == 0) system_seen(GIVEN(state), recorded + SEEN * (n / every));
        if (STAGES) {
            if (!stepped(state, unknowns, fixed, fixed[FIXED_COUNT - 1])) return n;
        } else {
            system_after(GIVEN(state), next);
            for (int i = 0; i < STATE; i++) state[i] = next[i];
        }
    }
    return end;
}
