"""The translator: numbers, comparisons and loops mean in C what they mean in Python; what is not translated says so.

The loops of the package use all else of it: `test_native` compares their bits, and `test_build` their text.
"""

import importlib
import importlib.machinery
import importlib.util
import shutil
import subprocess
import sys
import sysconfig
from itertools import product
from pathlib import Path

import numpy as np
import pytest

import chapsym
from chapsym.codegen import build, c_files
from chapsym.codegen.c import NotTranslatable
from chapsym.codegen.source import Program
from chapsym.dynamics.loops import twins

ROOT = Path(chapsym.__file__).parent
COMPILER, INCLUDE = shutil.which("cc"), Path(sysconfig.get_paths()["include"])
HEAD = """
from math import frexp, inf, ldexp, nan, sqrt
from typing import NamedTuple
import numpy as np
from chapsym.dynamics.loops.text import Four, Integers, Matrix, Vector, lanes
from chapsym.numbers.loose import Loose, Normal, square_root
from . import other
from .other import LIMIT, twice
"""
OTHER = """
LIMIT = 0.5
SINGLE = {"LIMIT": 0.25}

def twice(x):
    return 2 * x, LIMIT * x
"""
SAMPLE = f"""{HEAD}
FACTOR, COUNT = 0.1, 3

def precedence(a: float, b: float, c: float, d: float):
    return (a - (b - c), a - b - c, a + (b + c), a / (b / c), a / b / c, a / (b * c), a * (b / c), a * (b * c),
            -(a - b) * c, (a + b) * (c - d), a - -b, -a - (-b - c), a * b + c * d, a * (b + c) * d, (a - b) / (c - d),
            -(-a), a - (b if c > d else d), (a if c > d else b) * d, -(a / b))

def extremes(a: float, b: float, c: float):
    return max(a, b), min(a, b), max(b, a), min(b, a), max(a, b, c), min(c, a, b), abs(a), abs(-b), max(0.0, c)

def whole(n: int, m: int, x: float):
    k = n
    k //= m
    k %= 5
    return (n // m, n % m, n / m, 1.0 / n, (n + 1.0) / (m * 1.0), -n // m, n // m % COUNT, n * m // COUNT, n - n % m,
            (1.0 if x > 0.0 else 3.0) / (2.0 if x > 1.0 else 4.0), x * n / m, k, abs(n), abs(n - m), max(n, m),
            sqrt(abs(n)), int(x), n * 0.5, 7 / n, (n - m) * x)

def compared(a: float, b: float, c: float, n: int):
    return (a < b < c, a <= b != c, not a < b, (a < b) & (b < c) | (a > c), a < b and b < c or not c > 0.0,
            a < b and (b < c or c > 0.0), (a < b) == (b < c), n if a < b else -n, not (a < b and b < c),
            1 if a == b else 2 if a < b else 3, 0.0 < a < 1.0 < b)

def constants(a: float):
    zero = -0.0
    return zero, a * -0.0, a + 0.1, FACTOR * a, 16777217.0, 1e-30, inf, -inf, nan, a / 3, 1 / 3, LIMIT * a, 2**60,\
        other.LIMIT

def swapped(a: float, b: float, c: float, v: Vector):
    a, b = b, a
    a, b, c = c, a, b
    v[0], v[1] = v[1], v[0]
    i, v[2] = 3, a + v[2]
    i, v[i] = 4, a
    a, v[4] = v[4], a
    b, c = b + 1.0, b
    return a, b, c, i

def looped(n: int, v: Vector):
    total, last = 0.0, 0
    for i in range(n):
        for j in range(i, n, 2):
            total = total * 0.75 + v[j] * (i + 1)
    for i in range(n - 1, -1, -1):
        total -= v[i] / (i + 1)
    for i in range(6, 0, -2):
        total += v[i] * i
    k = 0
    while k < n and v[k] < 0.5:
        k += 1
        if k == 3:
            continue
        if total > 100.0:
            break
        last = k
    for a, b in ((0, 1.5), (2, -0.5)):
        part = a * b
        total += part * v[a]
    for i in lanes(n):
        x, y = v[i], 2.0 * v[i]
        if x > 0.0:
            x = y
        v[i] = x
    m = n
    for _ in range(m):
        m += 1
    return total, k, last, m

class Kept(NamedTuple):
    size: float
    v: Vector
    at: Integers

def recorded(n: int, kept: Kept, more: Vector):
    kept.at[1] = n
    kept.v[0] = kept.size * n + more[0]
    return kept.v[0], kept.v[1] - more[1]
"""


def load_from(folder):
    def load(path):
        place = ROOT.joinpath(*path.split(".")[1:]) if path.startswith("chapsym.") else folder / path.replace(".", "/")
        return place.with_suffix(".py").read_text(encoding="utf-8")

    return load


def written(folder, text):
    """The package `box` in a folder, as the translator reads it."""
    (folder / "box").mkdir()
    for name, body in (("__init__", ""), ("other", OTHER), ("sample", text)):
        (folder / "box" / f"{name}.py").write_text(body, encoding="utf-8")
    return Program(load_from(folder))


def roots(program):
    return [f for f in program.module("box.sample").functions.values() if f.is_exported]


@pytest.fixture(scope="module")
def both(tmp_path_factory):
    """The sample as a module of Python, and compiled."""
    if COMPILER is None or not (INCLUDE / "Python.h").is_file():
        pytest.skip("no compiler of C is installed, or not the headers of Python")
    place = tmp_path_factory.mktemp("sample")
    program = written(place, SAMPLE)
    texts = c_files.Texts(program, roots(program), roots(program))
    body = texts.text() + texts.exports()
    (place / "loops.h").write_text("#pragma once\n" + c_files.INTERFACE)
    (place / "loops.c").write_text(body)
    (place / "loops_text.c").write_text('const char loops_text[] = "";\n#include "loops.c"\n')
    for part in ("single", "long"):
        (place / f"loops_{part}.c").write_text(f'#define {part.upper()}\n#include "loops.c"\n')
    module = ROOT / "dynamics" / "native" / "module.c"
    flags = ["-std=gnu11", "-O2", "-ffp-contract=off", "-fPIC", "-shared", "-DPy_LIMITED_API=0x030B0000"]
    texts = (place / f"loops_{part}.c" for part in ("text", "single", "long"))
    files = ["-DWIDEST_OFF", *texts, module, "-lm", "-o", place / "compiled.so"]
    subprocess.run([COMPILER, *flags, "-I", place, "-I", INCLUDE, *files], check=True)
    loader = importlib.machinery.ExtensionFileLoader("compiled", str(place / "compiled.so"))
    compiled = importlib.util.module_from_spec(importlib.util.spec_from_loader("compiled", loader))
    sys.path.insert(0, str(place))
    other, sample = importlib.import_module("box.other"), importlib.import_module("box.sample")
    yield sample, other, compiled
    sys.path.remove(str(place))
    for name in ("box", "box.other", "box.sample"):
        del sys.modules[name]


RNG = np.random.default_rng(2)
ODD = (0.0, -0.0, 1.0, -1.0, np.nan, np.inf, -np.inf)
FLOATS = [tuple(map(float, row)) for row in RNG.normal(size=(12, 4)) * 10.0 ** RNG.integers(-3, 4, (12, 4))]
WHOLE = [n for n in range(-7, 8) if n]
V = RNG.normal(size=7)
CALLS = {
    "precedence": FLOATS,
    "extremes": [*product(ODD, repeat=3), *(row[:3] for row in FLOATS)],
    "whole": [(n, m, x) for n in WHOLE for m in WHOLE for x in (-2.75, 0.5, 3.25)],
    "compared": [(*row, n) for row in product((-1.0, 0.0, 0.5, 2.0, np.nan), repeat=3) for n in (-2, 3)],
    "constants": [(1.0,), (-0.3,)],
    "swapped": [(*row[:3], V) for row in FLOATS],
    "looped": [(n, k * V) for n in range(7) for k in (1.0, 0.25, 100.0, -1.0)],
}


def flat(result, dtype):
    return np.array(result if isinstance(result, tuple) else [0.0 if result is None else result], dtype=dtype)


def same(a, b):
    return np.array_equal(a, b, equal_nan=True) and np.array_equal(np.signbit(a)[a == a], np.signbit(b)[b == b])


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("name", CALLS)
def test_a_loop_has_the_same_bits_in_c_and_in_python(both, name, dtype):
    sample, other, compiled = both
    number = float if dtype is np.float64 else dtype
    names, table = vars(sample), compiled.double
    if dtype is np.float32:
        elsewhere = twins.twin(other, dtype, LIMIT=dtype(0.25))
        module = type(sample)("other")
        vars(module).update(elsewhere)
        more = {"other": module, "LIMIT": dtype(0.25), "twice": elsewhere["twice"], "sqrt": twins._root}
        names, table = twins.twin(sample, dtype, ldexp=twins._scaled, **more), compiled.single
    for call in CALLS[name]:
        given = [[x.astype(dtype if x.dtype == float else x.dtype) if isinstance(x, np.ndarray)
                  else number(x) if isinstance(x, float) else x for x in call] for _ in range(2)]  # fmt: skip
        with np.errstate(all="ignore"):
            wanted = flat(names[name](*given[0]), dtype)
        found = flat(table[f"sample_{name}"](*given[1]), dtype)
        assert same(found, wanted), (call, np.flatnonzero(~((found == wanted) | (found != found))))
        for mine, its in zip(*given, strict=True):
            assert not isinstance(mine, np.ndarray) or same(mine, its), call


def test_a_record_is_passed_as_its_fields(both):
    sample, _, compiled = both
    given = [(3, sample.Kept(0.1, V[:2].copy(), np.arange(2)), V[2:4]) for _ in range(2)]
    run = compiled.double["sample_recorded"]
    assert same(run(*given[1]), sample.recorded(*given[0]))
    for _, kept, _ in given:
        assert [*kept.v, *kept.at] == [0.1 * 3 + V[2], V[1], 0, 3]
    with pytest.raises(TypeError):
        run(*given[1], (1.0,) * 99)


def test_every_function_of_the_sample_is_called(both):
    assert {f"sample_{name}" for name in (*CALLS, "recorded")} == set(both[2].double) == set(both[2].single)


USED = """
class Pose(NamedTuple):
    q: Four
    size: float

def filled(v):
    v[0] = 1.0
    return v[0], v[1]

def fresh(a):
    x = np.zeros(2)
    x[0] = a
    return x

"""


def translated(tmp_path, text):
    program = written(tmp_path, HEAD + USED + text)
    texts = c_files.Texts(program, roots(program), roots(program))
    return texts.text() + texts.exports()


@pytest.mark.parametrize(
    "body",
    [
        "return a ** n", "return +a", "return ~n", "return a % 2.0", "return a // 2.0", "return a @ a", "return n << 2",
        "return a in (1.0, 2.0)", "return a is None", "return [a]", "return {a: n}", "return lambda: a",
        "return 'text'", "return f'{a}'", "return a[0]", "return unknown(a)", "return np.sin(a)", "return math.sin(a)",
        "return twice(x=a)",
        "return twice(a, a)", "return [x for x in v]", "return (x := a)", "return v.sum()", "return (a, n)[n]",
        "x = v\n    x = n\n    return x", "x = 1.0 if n else v\n    return x", "return unknown_name",
        "while sqrt(*twice(a)) > 1.0:\n        a = a - 1.0\n    return a",
        "return max(*twice(a)) if n > 0 else a", "x = a > 0.0 and max(*twice(a)) > 1.0\n    return x",
        "for i in range(n):\n        i += 1\n    return a", "for i in range(n):\n        a += 1.0\n    return i",
        "i = 2\n    for i in range(n):\n        a += 1.0\n    return i",
        "for i in range(n):\n        a += 1.0\n    else:\n        a = 0.0\n    return a",
        "while a > 1.0:\n        a -= 1.0\n    else:\n        a = 0.0\n    return a",
        "for x in v:\n        a += x\n    return a",
        "for x, y in ((a, 1.0), (2.0, a)):\n        break\n    return x",
        "with a:\n        pass\n    return a", "del a", "global a",
        "try:\n        a = 1.0\n    except ValueError:\n        a = 2.0\n    return a", "raise ValueError",
        "assert a > 0.0",
        "return a and 1.0", "for n in range(n):\n        a += 1.0\n    return a",
        "for x, y in ((a, 1.0), (2.0, a)):\n        a = x + y\n    return a",
        "t = a, 1.0, a\n    return t[0:3:2]", "t = a, 1.0, a\n    return t[n:3]",
        "t = a, 1.0\n    if n > 1:\n        t = 1.0, a\n    return t[n]", "t = a, n\n    return t[n]",
        "t = filled(v) if n > 1 else (a, a)\n    return t", "return a, (a, a)", "return Loose(a)", "return v",
        "x = Loose(a) * n\n    return x.high", "x = Loose(a, 0.0) / n\n    return x.high", "return Loose(a).low",
        "x = Normal(a)\n    return x.high", "return Loose(a) == Loose(a)", "return 1.0 if Loose(a) else 2.0",
        "return max(Loose(a), 1.0).high", "return sqrt(Loose(a))", "return Pose((a, a, a, a)).size",
        "return Pose(a, a).size", "if (a, a) > (1.0, a):\n        a = 1.0\n    return a",
        "import math\n    return a", "def inner():\n        return a\n    return a", "yield a",
        "a: float = 1.0\n    return a", "a = x = 1.0\n    return a",
        "x = v.copy()\n    return x[0]", "x = v[::2]\n    return x[0]", "x, y = a\n    return x",
        "*x, y = twice(a)\n    return y", "return v[-1]", "return len(v[:-1])",
    ],
)  # fmt: skip
def test_what_is_not_translated_names_its_function(body, tmp_path):
    with pytest.raises(NotTranslatable, match="sample_odd"):
        translated(tmp_path, f"def odd(a: float, n: int, v: Vector):\n    {body}\n")


@pytest.mark.parametrize(
    ("body", "takes"),
    [
        ("x = pose.v", "r1 r r1"), ("x = pose.v\n    x[0] = 1.0", "r1* r* r1"),
        ("x = pose\n    x.v[0] = 1.0", "r1* r* r1"), ("x = pose.v\n    y = x\n    y[0] = 1.0", "r1* r* r1"),
        ("x = w\n    w = x\n    x[0] = 1.0", "r1 r r1*"), ("put(Pair(w, 1.0))", "r1 r r1*"),
    ],
)  # fmt: skip
def test_what_is_written_under_another_name_is_written(body, takes, tmp_path):
    """Arrays that are written must not be read-only: the table says which."""
    text = "class Pair(NamedTuple):\n    v: Vector\n    size: float\n\ndef put(pair):\n    pair.v[0] = pair.size\n\n"
    found = translated(tmp_path, f"{text}def moved(pose: Pair, w: Vector):\n    {body}\n    return pose.size\n")
    assert f'{{"sample_moved", "{takes}", ' in found


def test_an_array_of_a_function_is_not_returned(tmp_path):
    """In C it would be gone."""
    with pytest.raises(NotTranslatable, match="sample_fresh"):
        translated(tmp_path, "def odd(a: float):\n    x = fresh(a)\n    return x[0]\n")


def refused(name, texts, said):
    """Of modules of a package `box`, by name: that the functions of one cannot be printed."""
    program = Program({f"box.{module}": text for module, text in texts.items()}.__getitem__)
    functions = [*program.module(f"box.{name}").functions.values()]
    with pytest.raises(NotTranslatable, match=said):
        c_files.Texts(program, functions, functions)


def test_a_field_of_float32_holds_no_float64():
    text = "from typing import NamedTuple\n\nclass One(NamedTuple):\n    size: float\n\n"
    text += "def odd(v: Doubles):\n    x = One(v[0])\n    return x.size\n"
    refused("sample", {"sample": text}, "the field size is of another kind")


@pytest.mark.parametrize(
    ("far", "near"), [("(v):\n    return v[0], v[1]", "far((a, a))[0]"), ("(x):\n    return 2.0 * x", "far(a)")]
)
def test_float32_takes_no_vector_and_no_single_result_from_float64(far, near):
    texts = {
        "branch": f"def far{far}\n",
        "single_loop": f"from .branch import far\n\ndef near(a: float):\n    return {near}\n",
    }
    refused("single_loop", texts, "single_loop_near")


def test_a_flipped_sign_in_a_loop_changes_the_text_and_is_told_by_the_check(copy):
    path = copy / "loops.c"
    text = path.read_text(encoding="utf-8")
    at = text.index(" - ", text.index("INLINE t_r2 pairs_two_sum"))
    path.write_text(text[:at] + " + " + text[at + 3 :], encoding="utf-8")
    assert build.ours().check(copy) == ["loops.c is changed"]


def test_what_gains_from_wide_registers_has_its_clones():
    lines = [line for line in build.ours().files["loops.c"].splitlines() if "void in_" in line]
    clones = {line.split("(")[0].split("in_")[1]: line.split()[0] for line in lines}
    for word, names in (("WIDEST", c_files.WIDEST), ("WIDER", c_files.WIDER)):
        assert {name for name, first in clones.items() if first == word} == set(names)
