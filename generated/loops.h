/* What the loops and what calls them agree on.
 * Written by `chapsym codegen`: do not edit; change codegen/c_files.py and generate again. */
#ifndef LOOPS_H
#define LOOPS_H

#include <stdint.h>

/* A number, an integer or an array, with its lengths and, but for the last, its strides in elements. */
typedef struct { void *p; int64_t n[4], s[3]; double number; int64_t integer; } argument;

/* A loop: `takes` has a word for each argument (b, i, r for a truth, an integer, a number; the letter of the elements
   and the number of axes for an array; * if it is written; a record is its fields), and `gives` a letter a result. */
typedef struct { const char *name, *takes, *gives; void (*run)(const argument *, argument *); } loop_export;

extern const loop_export loops_double[], loops_long[], loops_single[];
extern const int loops_double_count, loops_long_count, loops_single_count;

/* The hash of the text that the loops were compiled from. */
extern const char loops_text[];

#endif
