/* The loops of long steps, which are compiled apart.
 * Written by `chapsym codegen`: do not edit; change codegen/c_files.py and generate again. */
#define LONG
#include "loops.c"
