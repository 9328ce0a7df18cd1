"""The files in C: the loops for two types of numbers, and a library of the kernels and a step for other languages."""

import hashlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import count, groupby
from typing import Any

from .c import NotTranslatable, Printer, Text, block, broken, c_type, is_external, number, printed, widened
from .kernels import Kernel
from .source import Function, Program, Record

#: The modules with functions that are exported, and those that float32 has, too.
PACKAGE = "chapsym.dynamics.loops"
SINGLE = ("loop", "block")
LOOPS = *SINGLE, "lanes", "loop_n", "vertical_loop", "double_double", "proved", "tangent", "following", "expected"
#: Modules that are compiled separately, in parallel with the others: they take half of the compile time.
LONG = "lanes", "following"

#: Loops that gain from 512-bit registers (lanes of balls), and from 256-bit registers; others gain from neither.
WIDEST = (
    "block_march_blocks", "block_advance_blocks", "lanes_march", "double_double_march_pairs_block", "following_follow",
)  # fmt: skip
WIDER = (
    "lanes_march_alone", "following_follow_alone", "double_double_march_pairs", "double_double_march_long_pairs",
    "proved_bound_steps", "tangent_follow_all",
)  # fmt: skip

#: The first lines of a file, with its contents and its sources.
HEAD = "/* {}\n * Written by `chapsym codegen`: do not edit; change {} and generate again. */\n"
PRELUDE = """#include <math.h>
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

"""
#: The number of roundings of each kernel; None if it is unknown, or too large for the lemma.
Roundings = Mapping[str, int | None]
#: The interface of the loops.
INTERFACE = """#ifndef LOOPS_H
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
"""


class Texts:
    """The functions of a program in C, with the types that they need; `kernels` are typed, but not in the text."""

    def __init__(
        self, program: Program, roots: Sequence[Function], single: Sequence[Function], kernels: Sequence[Function] = ()
    ) -> None:
        self.program, self.roots, self.single = program, roots, single
        self.of = printed(program, roots, kernels)
        double, single_, every = (self.reached(*x) for x in ((roots, "double"), (single, "single"), (roots, "")))
        #: Each function, after those that it calls, with the guard of its number type.
        self.groups = {
            f: "" if f in double and f in single_ else "#ifndef SINGLE" if f in double else "#ifdef SINGLE"
            for f in every
        }

    def reached(
        self, functions: Iterable[Function], numbers: str, done: dict[Function, None] | None = None
    ) -> dict[Function, None]:
        """Some functions and all that they call, for a number type, each after those that it calls."""
        done = {} if done is None else done
        for function in functions:
            if function not in done:
                calls = self.of[function].calls.items()
                double = [f for f, _ in calls if numbers != "single"]
                single = [f for called, f in calls if numbers != "double" and not is_external(function, called)]
                self.reached([*double, *single], numbers, done)
                done[function] = None
        return done

    def text(self) -> str:
        """The whole text."""
        parts = [PRELUDE, self.typedefs(), self.varying()]
        for guard, functions in groupby(self.groups, key=self.groups.__getitem__):
            parts.append(guarded(guard, "".join(map(self.written, functions))))
        return "".join(parts)

    def typedefs(self) -> str:
        """The records and the tuples that functions return."""
        used = {of.returned for of in self.of.values()} | {widened(of.returned) for _, of in self.external()}
        used = used.union(*(of.tuples for of in self.of.values()))
        found = dict.fromkeys(kind for one in sorted(used, key=c_type) for kind in self.inside(one))
        rows = []
        for kind in found:
            fields = kind.fields if isinstance(kind, Record) else [(f"a{i}", one) for i, one in enumerate(kind)]
            runs = groupby(fields, key=lambda field: c_type(field[1]))
            members = (f"{of} {', '.join(name for name, _ in run)};" for of, run in runs)
            rows.append(f"typedef struct {{ {' '.join(members)} }} {c_type(kind)};")
        return "\n".join([*(part for row in rows for part in broken(row)), "\n"])

    def inside(self, kind: Any) -> Iterator[Any]:
        """The structures that a kind needs, ending with its own."""
        if isinstance(kind, tuple | Record):
            for one in kind if isinstance(kind, tuple) else (of for _, of in kind.fields):
                yield from self.inside(one)
            if kind != ("r", "i"):  # defined in the first lines
                yield kind
        elif kind in ("p", "q"):
            yield ("r", "r")

    def external(self) -> list[tuple[Function, Printer]]:
        """The functions in float64 that float32 calls."""
        found = {f for g in self.groups for f in self.of[g].calls if is_external(g, f)}
        return [(f, self.of[f]) for f in self.groups if f in found]

    def varying(self) -> str:
        """The names with another value, or another function, in float32."""

        def definition(name: str, value: Any) -> str:
            text = value.name if isinstance(value, Function) else number(value).text
            return f"#define {name} {text}" if text != name else ""

        narrow = [definition(x.name, x.single) for x in self.program.varying]
        wide = [definition(x.name, x.double) for x in self.program.varying]
        outside = [
            f"{c_type(widened(of.returned))} {f.name}_double({', '.join(['double'] * len(f.parameters))});"
            for f, of in self.external()
        ]
        return "\n".join(["#ifdef SINGLE", *narrow, *outside, "#else", *filter(None, wide), "#endif", "\n"])

    def written(self, function: Function) -> str:
        """The text of one function."""
        of = self.of[function]
        text = of.text()
        if (function, of) in self.external():
            parameters = ", ".join(f"real {x}" for x in function.parameters)
            call = f"return {function.name}({', '.join(function.parameters)})"
            outside = block(f"{c_type(of.returned)} {function.name}_double({parameters})", call)
            text += guarded("#ifndef LONG", outside)
        return text

    def exports(self) -> str:
        """The table of the exported functions, each with a wrapper that takes its arguments from a list."""
        apart = [f for f in self.roots if f.name.startswith(tuple(f"{name}_" for name in LONG))]
        double = [f for f in self.roots if f not in self.single and f not in apart]

        def parts(made: Callable[[Function], str]) -> str:
            single, others, long = ("".join(map(made, some)) for some in (self.single, double, apart))
            return guarded("#ifdef LONG", f"{long}#else\n{single}{guarded('#ifndef SINGLE', others)}")

        ways, rows = map(parts, (self.way_in, self.row))
        length = "const int LOOPS(_count) = sizeof LOOPS() / sizeof *LOOPS();\n"
        return f"{ways}\nconst loop_export LOOPS()[] = {{\n{rows}}};\n{length}"

    def way_in(self, function: Function) -> str:
        """A wrapper, of a common form, of an exported function."""
        of, at = self.of[function], count()

        def argument(kind: Any) -> str:
            """An argument from the list; a record from several."""
            if isinstance(kind, Record):
                return f"({kind.name}){{{', '.join(argument(one) for _, one in kind.fields)}}}"
            return f"{kind}_({next(at)})"

        given = ", ".join(argument(of.names[x]) for x in function.parameters)
        wide = "WIDEST " if function.name in WIDEST else "WIDER " if function.name in WIDER else ""
        head = f"{wide}static void in_{function.name}(const argument *a, argument *got)"
        call, out = f"{function.name}({given})", Text("out", of.returned)
        if of.returned is None:
            return block(head, call, "(void)got")
        parts = out.parts if isinstance(of.returned, tuple) else [out]
        members = [f"got[{i}].{'number' if x.kind == 'r' else 'integer'} = {x.text}" for i, x in enumerate(parts)]
        return block(head, f"{c_type(of.returned)} out = {call}", *members)

    def row(self, function: Function) -> str:
        """A row of the table: the name, the arguments, with * for those that are written, and the results."""
        of = self.of[function]
        returned = of.returned if isinstance(of.returned, tuple) else (of.returned,)
        if of.returned is not None and not set(returned) <= {"b", "i", "r", "d"}:
            raise NotTranslatable(f"{function.name}: what is exported returns numbers, not {c_type(of.returned)}")
        kinds = ((x, of.names[x]) for x in function.parameters)
        parts = ((x, kind.fields if isinstance(kind, Record) else [(x, kind)]) for x, kind in kinds)
        takes = " ".join(f"{kind}{'*' if x in of.written else ''}" for x, fields in parts for _, kind in fields)
        return f'    {{"{function.name}", "{takes}", "{"".join(of.returned or "")}", in_{function.name}}},\n'


def guarded(guard: str, text: str) -> str:
    """Text for one number type, or for both without a guard."""
    return f"{guard}\n{text}#endif\n" if guard and text else text


def build(load: Callable[[str], str], kernels: Sequence[Kernel], roundings: Roundings) -> dict[str, str]:
    """The files by name; `load` gives the text of a module of the loops, of the kernels, or of their imports."""
    program = Program(load)
    loops = {name: program.module(f"{PACKAGE}.{name}").functions.values() for name in LOOPS}
    exported = {name: [f for f in functions if f.is_exported] for name, functions in loops.items()}
    functions = program.module("chapsym.generated").functions
    texts = Texts(
        program, [f for name in LOOPS for f in exported[name]], [f for name in SINGLE for f in exported[name]],
        [functions[kernel.name] for kernel in kernels],
    )  # fmt: skip
    body, exports = texts.text(), texts.exports()
    digest = hashlib.sha256((INTERFACE + body + exports).encode()).hexdigest()
    about = "The loops of chapsym/dynamics/loops and their kernels: with SINGLE in float32, with LONG of long steps."
    mine = "codegen/c_files.py"
    parts = {"single": "The loops in float32.", "long": "The loops of long steps, which are compiled apart."}
    exports += guarded("#if !defined(SINGLE) && !defined(LONG)", f'const char loops_text[] = "{digest}";\n')
    body += guarded("#ifndef LIBRARY", exports)
    python = '"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""'
    return {
        "loops.c": HEAD.format(about, "the loops or the derivation") + body,
        **{
            f"loops_{name}.c": HEAD.format(what, mine) + f'#define {name.upper()}\n#include "loops.c"\n'
            for name, what in parts.items()
        },
        "loops.h": HEAD.format("What the loops and what calls them agree on.", mine) + INTERFACE,
        "loops_text.py": f'{python}\n\nTEXT = "{digest}"\n',
        **library(texts, kernels, roundings),
    }


#: A header, with a name in capitals and its declarations, and its end.
HEADER = """#ifndef {0}_H
#define {0}_H

#ifdef __cplusplus
extern "C" {{
#endif
{1}
#ifdef __cplusplus
}}
#endif
#endif
"""
#: The text before the declarations of kernels.
ABOUT_ROUNDINGS = """
/* Of a kernel with N roundings each result is off by at most N 2^-53 (1 + 2^-10) of its terms, if nothing over- or
   underflows and no divisor is below 2^-25 of its own terms (lemma `rounding` of chapsym).  Terms are a formula with
   every sum taken absolutely: |x| of an argument, terms(a) + terms(b) of a + b and a - b, terms(a) terms(b) of a b,
   terms(a) terms(b)/b^2 of a/b. */
"""
#: The text before the step in the library of chapsym.
ABOUT_STEP = """
/* One step of the map (5.3) on the small-rotation branch, in place.

   mass_tensor: J, the second moments of mass; D: mass times radius squared.  momentum: the discrete momentum,
   epsilon K, in the units of J; gamma: the unit vertical, upwards.  rotation: receives the unit quaternion of the step,
   scalar first.  reach: receives the fraction of the momentum that the branch attains, 1 for a step that is taken.
   The numbers are not checked: mass_tensor and D must be at least 0, gamma of length 1, all of them finite.
   Returns 0 if the step was taken; 1 at a fold, 2 where the continuation did not converge, 4 for a ball without
   inertia: then momentum, gamma and rotation are as before. */
"""
STEP = (
    "int chapsym_step(const double mass_tensor[3], double D, double momentum[3], double gamma[3], "
    "double rotation[4], double *reach)"
)
#: The headers of a register without loops.
ALONE = "#include <math.h>\n#include <stdint.h>\n#include <string.h>\n\n"
ALONE += "typedef double real;\n#define R(x) ((real)(x))\n#define INLINE static inline\n\n"


def library(texts: Texts, kernels: Sequence[Kernel], roundings: Roundings) -> dict[str, str]:
    """chapsym.h and chapsym.c: every kernel as a function of arrays, and a step."""
    declared, defined = interface(texts, kernels, "chapsym", roundings)
    rows = texts.program.module(f"{PACKAGE}.loop").names["ROWS"]
    arrays = "(r1){momentum, 3}, (r1){gamma, 3}, (r1){tensor, 3}, D, (r1){state, @}, (r1){rotation, 4}"
    body = [
        "double tensor[3] = {mass_tensor[0], mass_tensor[1], mass_tensor[2]}, state[@] = {0}",
        f"t_ir got = loop_advance({arrays})",
        "*reach = got.a1",
        "return (int)got.a0",
    ]
    step = block(STEP, *(line.replace("@", str(rows)) for line in body))
    about = "The kernels of chapsym, each from a proved expression, and one step of the map: for other languages."
    head = HEAD.format("chapsym.h: compile it with -ffp-contract=off.", "the derivation")
    with_step = ABOUT_STEP + "\n".join(broken(STEP + ";")) + "\n" + declared
    return {
        "chapsym.h": HEAD.format(about, "the derivation") + HEADER.format("CHAPSYM", with_step),
        "chapsym.c": f'{head}#include "chapsym.h"\n\n#define LIBRARY\n#include "loops.c"\n\n{defined}{step}',
    }


def kernels_alone(text: str, kernels: Sequence[Kernel], prefix: str, roundings: Roundings) -> dict[str, str]:
    """The same for the kernels of another register, given as a text: PREFIX.h and PREFIX.c."""
    program = Program(lambda path: text)
    functions = program.module("chapsym.generated").functions
    texts = Texts(program, [], [], [functions[kernel.name] for kernel in kernels])
    declared, defined = interface(texts, kernels, prefix, roundings)
    about = f"The kernels of {prefix}, each from a proved expression: for other languages."
    head = HEAD.format(f"{prefix}.h: compile it with -ffp-contract=off.", "the derivation")
    return {
        f"{prefix}.h": HEAD.format(about, "the derivation") + HEADER.format(prefix.upper(), declared),
        f"{prefix}.c": head + ALONE + f'#include "{prefix}.h"\n\n' + texts.typedefs() + defined,
    }


def interface(texts: Texts, kernels: Sequence[Kernel], prefix: str, roundings: Roundings) -> tuple[str, str]:
    """The declaration and the definition of every kernel as a function of arrays, PREFIX_kernel."""
    functions = texts.program.module("chapsym.generated").functions
    declared, defined = list[str](), list[str]()
    for kernel in sorted(kernels, key=lambda k: k.name):
        if (function := functions[kernel.name]) not in texts.groups:
            defined.append(texts.written(function))
        parameters, given = [], []
        for name, symbols in kernel.groups:
            parameters.append(f"double {name}" if len(symbols) == 1 else f"const double {name}[{len(symbols)}]")
            given += [name] if len(symbols) == 1 else [f"{name}[{i}]" for i in range(len(symbols))]
        head = f"void {prefix}_{kernel.name}({', '.join(parameters)}, double result[{len(kernel.outputs)}])"
        rows = f", {kernel.shape[0]} rows" if len(kernel.shape) > 1 else ""
        count = roundings.get(kernel.name)
        rounded = "" if count is None else f" Roundings: {count}."
        comment = f"/* {kernel.summary} result: {', '.join(kernel.outputs)}{rows}.{rounded} */"
        declared.append("\n".join(["", *broken(comment), *broken(head + ";"), ""]))
        returned = texts.of[function].returned
        call = f"{c_type(returned)} got = {function.name}({', '.join(given)})"
        if set(returned) == {"r"}:
            copied = ["memcpy(result, &got, sizeof got)"]
        else:  # an integer result, such as 1, becomes a real number
            got = Text("got", returned)
            parts = got.parts if isinstance(returned, tuple) else [got]
            copied = [f"result[{i}] = {x.text}" for i, x in enumerate(parts)]
        defined.append(block(head, call, *copied))
    return ABOUT_ROUNDINGS + "".join(declared), "".join(defined)
