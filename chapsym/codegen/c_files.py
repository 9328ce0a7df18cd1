"""The files in C: the loops for two types of numbers, and a library of the kernels and a step for other languages."""

import hashlib
from collections.abc import Callable, Collection, Sequence
from typing import Any

from .c import SCALARS, Printer, broken, c_type, lines
from .infer import NARROW, Array, Types, is_external
from .kernels import Kernel
from .source import Function, Program, Record

#: The modules with functions that are exported, and those that float32 has, too.
PACKAGE = "chapsym.dynamics.loops"
SINGLE = ("loop", "block", "single_step")
LOOPS = (
    *SINGLE,
    "long_run",
    "loop_n",
    "vertical_loop",
    "double_double_loop",
    "double_double_block",
    "tangent",
    "following",
    "expected",
)

HEAD = "/* {about}\n * Written by `chapsym codegen`: do not edit; change {what} and generate again. */\n"
PRELUDE = """
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "loops.h"

#ifdef SINGLE
typedef float real;
#else
typedef double real;
#endif
#define R(x) ((real)(x))
/* On x86 a loop is compiled for wide registers, too, and takes them where the processor has them: to the same bits. */
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) && !defined(WIDEST_OFF)
#define WIDEST __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define WIDEST
#endif
#define INLINE static inline __attribute__((always_inline, unused))
#define OUT_OF_LINE static __attribute__((noinline, unused))
#define ALIGNED __attribute__((aligned(64)))
#if defined(__clang__)
#define INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define INDEPENDENT _Pragma("GCC ivdep")
#endif

INLINE real real_sqrt(real x) { return (real)sqrt(x); }
INLINE real real_abs(real x) { return (real)fabs(x); }
INLINE real max_r(real a, real b) { return b > a ? b : a; }
INLINE real min_r(real a, real b) { return b < a ? b : a; }
INLINE int64_t max_i(int64_t a, int64_t b) { return b > a ? b : a; }
INLINE int64_t min_i(int64_t a, int64_t b) { return b < a ? b : a; }
INLINE int64_t div_i(int64_t a, int64_t b) { return a / b - ((a % b != 0) & ((a < 0) != (b < 0))); }
INLINE int64_t mod_i(int64_t a, int64_t b) { return a - b * div_i(a, b); }

#define ARRAY1(type, a) (type){a.p, a.n[0]}
#define ARRAY2(type, a) (type){a.p, a.n[0], a.n[1], a.s[0]}
#define ARRAY3(type, a) (type){a.p, a.n[0], a.n[1], a.n[2], a.s[0], a.s[1]}
#define ARRAY4(type, a) (type){a.p, a.n[0], a.n[1], a.n[2], a.n[3], a.s[0], a.s[1], a.s[2]}
"""
#: What the loops and what calls them agree on.
INTERFACE = """
#include <stdint.h>

/* A number, an integer or an array, with its lengths and, but for the last, its strides in elements. */
typedef struct { void *p; int64_t n[4], s[3]; double number; int64_t integer; } argument;

/* A loop: what it takes, one word for each argument (b, i, r for a truth, an integer, a number; the letter of the
   elements and the number of axes for an array; * if it is written), and what it gives, one letter each. */
typedef struct { const char *name, *takes, *gives; void (*run)(const argument *, argument *); } loop_export;

extern const loop_export loops_double[], loops_single[];
extern const int loops_double_count, loops_single_count;

/* The hash of the text that the loops were compiled from. */
extern const char loops_text[];
"""
GUARDS = {"double": ("#ifndef SINGLE\n", "#endif\n"), "single": ("#ifdef SINGLE\n", "#endif\n")}
#: What C does by an instruction of its own: the exact product is a fused multiply-add there.
BY_HAND = {"pairs_two_product": "const real p = a * b;\n    return (t_r2){p, fma(a, b, -p)};"}


class Texts:
    """The functions of a program in C, with the types that they need."""

    def __init__(self, program: Program, roots: Sequence[Function], single: Sequence[Function]) -> None:
        self.types, self.roots = Types(program, roots), roots
        wide, narrow = self.reached(roots, False), self.reached(single, True)
        #: Each function, after those that it calls, with the types of numbers that it is for.
        self.groups = {
            f: "both" if f in narrow and f in wide else "single" if f in narrow else "double" for f in wide | narrow
        }

    def reached(self, roots: Sequence[Function], single: bool) -> dict[Function, None]:
        """The functions that some functions call, directly or not, with themselves, each after those that it calls."""
        found: dict[Function, None] = {}

        def visit(function: Function) -> None:
            if function in found or any(function is f for f in path):
                return
            path.append(function)
            for callee, other in self.types.of[function].calls.items():
                if not single:
                    visit(callee)
                elif not is_external(function, callee):
                    visit(other)
            path.pop()
            found[function] = None

        path: list[Function] = []
        for function in roots:
            visit(function)
        return found

    def text(self) -> str:
        """All of it."""
        parts = [PRELUDE.lstrip(), self.typedefs(), self.constants()]
        left, group = list(self.ordered()), ""
        for function in left:
            if self.groups[function] != group:
                parts.append(GUARDS.get(group, ("", "#endif\n"))[1] if group in GUARDS else "")
                group = self.groups[function]
                parts.append(GUARDS[group][0] if group in GUARDS else "")
            parts.append(self.written(function))
        parts.append(GUARDS[group][1] if group in GUARDS else "")
        return "\n".join(filter(None, parts))

    def ordered(self) -> list[Function]:
        """The functions, each after those that it calls, those of one group together where that is possible."""
        left, done, group = list(self.groups), list[Function](), "both"

        def ready(function: Function) -> bool:
            calls = self.types.of[function].calls
            needed = {f for pair in calls.items() for f in pair}
            return all(f is function or f in done or f not in self.groups for f in needed)

        while left:
            able = [f for f in left if ready(f)]
            same = [f for f in able if self.groups[f] == group] or able
            group = self.groups[same[0]]
            done.append(same[0])
            left.remove(same[0])
        return done

    def typedefs(self) -> str:
        """The arrays and the tuples."""
        arrays, tuples = set[Array](), set[tuple[Any, ...]]({("r", "i")})
        for typed in self.types.of.values():
            arrays |= {x for x in typed.names.values() if isinstance(x, Array)}
            tuples |= {typed.returned} if isinstance(typed.returned, tuple) else set()
            if typed.function.module.name == NARROW:
                tuples |= {
                    tuple("d" if x == "r" else x for x in self.types.of[f].returned)
                    for f in typed.calls if is_external(typed.function, f)
                }  # fmt: skip
        rows = []
        for record in sorted({t.returned for t in self.types.of.values() if isinstance(t.returned, Record)}, key=str):
            rows += broken(f"typedef struct {{ real {', '.join(record.fields)}; }} {record.name};")
        for array in sorted(arrays | {Array(a.element, r) for a in arrays for r in range(1, a.rank)}, key=str):
            sizes = ", ".join([f"n{i}" for i in range(array.rank)] + [f"s{i}" for i in range(array.rank - 1)])
            rows.append(f"typedef struct {{ {SCALARS[array.element]} *p; int64_t {sizes}; }} {array};")
        for kinds in sorted(tuples, key=lambda t: (len(t), t)):
            rows.append(f"typedef struct {{ {fields(kinds)} }} {c_type(kinds)};")
        frexp = "INLINE t_ri real_frexp(real x) { int e; real m = (real)frexp(x, &e); return (t_ri){m, e}; }"
        return "\n".join([*rows, frexp, ""])

    def constants(self) -> str:
        """What has another value, or is another function, in float32."""
        wide, narrow = list[str](), list[str]()
        for module in self.types.program.modules.values():
            for name, other in module.single.items():
                mine = module.names[name]
                if isinstance(other, Function):
                    narrow.append(f"#define {module.name}_{name} {other.name}")
                    wide += (
                        [f"#define {module.name}_{name} {mine.name}"] if mine.name != f"{module.name}_{name}" else []
                    )
                else:
                    wide.append(f"#define {module.name}_{name} {number(mine)}")
                    narrow.append(f"#define {module.name}_{name} {number(other)}")
        outside = []
        for function in self.groups:
            for callee in self.types.of[function].calls:
                if is_external(function, callee):
                    result = tuple("d" if x == "r" else x for x in self.types.of[callee].returned)
                    parameters = ", ".join(["double"] * len(callee.parameters))
                    outside.append(f"{c_type(result)} {callee.name}_double({parameters});")
        return "\n".join(["#ifdef SINGLE", *narrow, *outside, "#else", *wide, "#endif", ""])

    def written(self, function: Function, types: Types | None = None) -> str:
        """The text of one function."""
        types = types or self.types
        printer = Printer(types, function)
        body = [f"    {BY_HAND[function.name]}"] if function.name in BY_HAND else lines(printer.body())
        text = "\n".join([*broken(self.head(function, types) + " {"), *body, "}", ""])
        if any(is_external(f, function) for f in self.groups if function in self.types.of[f].calls):
            parameters = ", ".join(f"real {name}" for name in function.parameters)
            result = c_type(self.types.of[function].returned)
            text += "\n".join(
                broken(f"{result} {function.name}_double({parameters}) {{")
                + broken(f"    return {function.name}({', '.join(function.parameters)});") + ["}", ""]
            )  # fmt: skip
        return text

    def exports(self, single: Collection[Function]) -> str:
        """The table of the functions that are exported, each with a way in that takes its arguments from a list."""
        parts = []
        for function in self.roots:
            way = "\n".join(self.way_in(function))
            parts.append(way if function in single else f"#ifndef SINGLE\n{way}\n#endif")
        for name, guard, some in (
            ("loops_double", "#ifndef SINGLE", self.roots),
            ("loops_single", "#else", [f for f in self.roots if f in single]),
        ):
            rows = [self.row(function) for function in some]
            parts.append("\n".join([guard, f"const loop_export {name}[] = {{", *rows, "};"]))
            parts.append(f"const int {name}_count = {len(some)};")
        return "\n".join([*parts, "#endif", ""])

    def way_in(self, function: Function) -> list[str]:
        """A function of one form that calls one that is exported."""
        typed = self.types.of[function]
        given = []
        for i, name in enumerate(function.parameters):
            kind = typed.names[name]
            number = "number" if kind == "r" else "integer"
            given.append(f"ARRAY{kind.rank}({kind}, a[{i}])" if isinstance(kind, Array) else f"a[{i}].{number}")
        call, kinds = f"{function.name}({', '.join(given)});", gives(typed.returned)
        body = [f"    {c_type(typed.returned)} out = {call}" if kinds else f"    {call}"]
        for i, kind in enumerate(kinds):
            one = f"out.a{i}" if isinstance(typed.returned, tuple) else "out"
            body.append(f"    got[{i}].{'number' if kind == 'r' else 'integer'} = {one};")
        body += [] if kinds else ["    (void)got;"]
        widest = "WIDEST " if "march" in function.name or "follow" in function.name else ""
        signature = f"{widest}static void in_{function.name}(const argument *a, argument *got) {{"
        return [signature, *(x for line in body for x in broken(line)), "}", ""]

    def row(self, function: Function) -> str:
        """A row of the table: the name, what it takes, * for what it writes, and what it gives."""
        typed = self.types.of[function]
        takes = " ".join(f"{typed.names[x]}{'*' if x in typed.written else ''}" for x in function.parameters)
        return f'    {{"{function.name}", "{takes}", "{gives(typed.returned)}", in_{function.name}}},'

    def head(self, function: Function, types: Types) -> str:
        """The declaration of a function."""
        typed = types.of[function]
        result = "void" if typed.returned is None else c_type(typed.returned)
        parameters = ", ".join(f"{c_type(typed.names[name])} {name}" for name in function.parameters)
        return f"{'OUT_OF_LINE' if function.is_out_of_line else 'INLINE'} {result} {function.name}({parameters})"


def build(load: Callable[[str], str], kernels: Sequence[Kernel]) -> dict[str, str]:
    """The files by name; `load` gives the text of a module of the loops, of the kernels or of what these import."""
    program = Program(load)

    def exported(names: Sequence[str]) -> list[Function]:
        modules = [program.module(f"{PACKAGE}.{name}") for name in names]
        return [f for module in modules for f in module.functions.values() if f.is_exported]

    single = exported(SINGLE)
    texts = Texts(program, exported(LOOPS), single)
    body = texts.text() + "\n" + texts.exports(single)
    digest = hashlib.sha256((INTERFACE + body).encode()).hexdigest()
    about = "The loops of chapsym/dynamics/loops, with the kernels that they call; with SINGLE defined in float32."
    loops = HEAD.format(about=about, what="the loops or the derivation") + body
    loops += f'\n#ifndef SINGLE\nconst char loops_text[] = "{digest}";\n#endif\n'
    python = (
        '"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""\n\n'
        f'TEXT = "{digest}"\n'
    )
    interface = HEAD.format(about="What the loops and what calls them agree on.", what="codegen/c_files.py")
    return {
        "loops.c": loops,
        "loops_single.c": HEAD.format(about="The loops in float32.", what="codegen/c_files.py")
        + '#define SINGLE\n#include "loops.c"\n',
        "loops.h": interface + f"#ifndef LOOPS_H\n#define LOOPS_H\n{INTERFACE}\n#endif\n",
        "loops_text.py": python,
        **library(texts, program, kernels),
    }


LIBRARY_HEAD = """#ifndef CHAPSYM_H
#define CHAPSYM_H

#ifdef __cplusplus
extern "C" {
#endif

/* One step of the map (5.3) on the small-rotation branch, in place.

   mass_tensor: J, the second moments of mass; D: mass times radius squared.  momentum: the discrete momentum,
   epsilon K, in the units of J; gamma: the unit vertical, upwards.  rotation: receives the unit quaternion of the step,
   scalar first.  reach: receives the fraction of the momentum that the branch attains, 1 for a step that is taken.
   Returns 0 if the step was taken; 1 at a fold, 2 where the continuation did not converge, 4 for a ball without
   inertia: then momentum, gamma and rotation are as before. */
int chapsym_step(const double mass_tensor[3], double D, double momentum[3], double gamma[3], double rotation[4],
    double *reach);
"""
LIBRARY_END = """
#ifdef __cplusplus
}
#endif
#endif
"""
STEP = """
int chapsym_step(const double mass_tensor[3], double D, double momentum[3], double gamma[3], double rotation[4],
    double *reach) {
    double tensor[3] = {mass_tensor[0], mass_tensor[1], mass_tensor[2]}, state[@ROWS@] = {0};
    t_ir got = single_step_advance((r1){momentum, 3}, (r1){gamma, 3}, (r1){tensor, 3}, D, (r1){state, @ROWS@},
        (r1){rotation, 4});
    *reach = got.a1;
    return (int)got.a0;
}
"""


def library(texts: Texts, program: Program, kernels: Sequence[Kernel]) -> dict[str, str]:
    """chapsym.h and chapsym.c: every kernel as a function of arrays, and a step."""
    functions = program.module("chapsym.generated").functions
    own = Types(program, [functions[k.name] for k in kernels], "r")
    declared, defined = [LIBRARY_HEAD], []
    for kernel in sorted(kernels, key=lambda k: k.name):
        function = functions[kernel.name]
        if function not in texts.groups:
            defined.append(texts.written(function, own))
        parameters, given = [], []
        for name, symbols in kernel.groups:
            parameters.append(f"double {name}" if len(symbols) == 1 else f"const double {name}[{len(symbols)}]")
            given += [name] if len(symbols) == 1 else [f"{name}[{i}]" for i in range(len(symbols))]
        count = len(kernel.outputs)
        signature = f"void chapsym_{kernel.name}({', '.join(parameters)}, double result[{count}])"
        listed = f"result: {', '.join(kernel.outputs)}" + (f", {kernel.shape[0]} rows" if len(kernel.shape) > 1 else "")
        declared.append("\n".join([*_comment(kernel.summary, f"{listed}."), *broken(signature + ";"), ""]))
        returned = own.of[function].returned
        call = f"{c_type(returned)} got = {function.name}({', '.join(given)});"
        copies = [f"result[{i}] = got{f'.a{i}' if isinstance(returned, tuple) else ''};" for i in range(count)]
        body = [x for line in (f"    {call}", f"    {' '.join(copies)}") for x in broken(line)]
        defined.append("\n".join([*broken(signature + " {"), *body, "}", ""]))
    about = "The kernels of chapsym, each from a proved expression, and one step of the map: for other languages."
    includes = '#include "chapsym.h"\n\n#include "loops.c"\n\n'
    rows = str(program.module(f"{PACKAGE}.loop").names["ROWS"])
    known = {c_type(t.returned) for t in texts.types.of.values() if t.returned is not None}
    more = sorted({t.returned for t in own.of.values() if c_type(t.returned) not in known}, key=len)
    typedefs = "".join(f"typedef struct {{ {fields(kinds)} }} {c_type(kinds)};\n" for kinds in more)
    return {
        "chapsym.h": HEAD.format(about=about, what="the derivation") + "\n".join(declared) + LIBRARY_END,
        "chapsym.c": HEAD.format(about="chapsym.h: compile it with -ffp-contract=off.", what="the derivation")
        + includes + typedefs + "\n" + "\n".join(defined) + STEP.replace("@ROWS@", rows),
    }  # fmt: skip


def _comment(*sentences: str) -> list[str]:
    return broken(f"/* {' '.join(sentences)} */")


def gives(returned: Any) -> str:
    """The types that a function returns, one letter each."""
    return "".join(returned) if isinstance(returned, tuple) else returned or ""


def fields(kinds: tuple[Any, ...]) -> str:
    """The fields of a tuple, a0, a1, ..."""
    runs: list[tuple[str, list[str]]] = []
    for i, kind in enumerate(kinds):
        if not runs or runs[-1][0] != kind:
            runs.append((kind, []))
        runs[-1][1].append(f"a{i}")
    return " ".join(f"{SCALARS[kind]} {', '.join(names)};" for kind, names in runs)


def number(value: float) -> str:
    """A constant of the type of the loops."""
    return str(value) if isinstance(value, int) else f"R({value.hex()})"
