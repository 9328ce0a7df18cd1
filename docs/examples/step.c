/* Rolls the ball with J = (1, 2, 4), D = 3 for ten steps of the map, from C.
   cc -O2 -ffp-contract=off -I generated docs/examples/step.c generated/chapsym.c -lm -o step && ./step */
#include <stdio.h>

#include "chapsym.h"

int main(void) {
    double J[3] = {1, 2, 4}, D = 3, K[3] = {1, -0.5, 0.75}, gamma[3] = {2.0 / 7, 3.0 / 7, 6.0 / 7}, q[4], reach;
    for (int step = 1; step <= 10; step++) {
        double before = K[0], up[3] = {gamma[0], gamma[1], gamma[2]}, found[3];
        int status = chapsym_step(J, D, K, gamma, q, &reach);
        if (status != 0) {
            fprintf(stderr, "step %d: the branch ends at %g of the momentum\n", step, reach);
            return 1;
        }
        chapsym_momentum(q, up, J, D, found); /* a kernel: the rotation has the momentum from before the step */
        printf("%2d  %.17g %.17g %.17g  off by %.1e\n", step, K[0], K[1], K[2], found[0] - before);
    }
    return 0;
}
