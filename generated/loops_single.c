/* The loops in float32.
 * Written by `chapsym codegen`: do not edit; change codegen/c_files.py and generate again. */
#define SINGLE
#include "loops.c"
