"""The kernels and the step as a library of C: what the example prints is what chapsym computes."""

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import chapsym
from chapsym import generated
from chapsym.codegen import build

ROOT = Path(chapsym.__file__).parents[1]
EXAMPLE = ROOT / "docs/examples/step.c"
COMPILER = shutil.which("cc")

pytestmark = pytest.mark.skipif(COMPILER is None, reason="no compiler of C is installed")


STRICT = [COMPILER, "-std=gnu11", "-Wall", "-Wextra", "-Werror", "-ffp-contract=off"]


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    """The library, compiled once."""
    place = tmp_path_factory.mktemp("library") / "chapsym.o"
    subprocess.run([*STRICT, "-c", build.folder() / "chapsym.c", "-o", place], check=True)
    return place


def printed(library, text):
    """What a program prints."""
    source, program = library.with_name("program.c"), library.with_name("program")
    source.write_text(text, encoding="utf-8")
    subprocess.run([*STRICT, "-I", build.folder(), source, library, "-lm", "-o", program], check=True)
    return subprocess.run([program], check=True, capture_output=True, text=True).stdout


def test_the_example_takes_the_steps_of_chapsym(library):
    rows = [line.split() for line in printed(library, EXAMPLE.read_text(encoding="utf-8")).splitlines()]
    momentum, gamma = np.array([1, -0.5, 0.75]), np.array([2.0, 3.0, 6.0]) / 7
    for row in rows:
        step = chapsym.step(chapsym.Ball((1, 2, 4), 3), momentum, gamma)
        momentum, gamma = step.momentum, step.gamma
        assert [float(x) for x in row[1:4]] == momentum.tolist()
        assert abs(float(row[-1])) < 1e-14
    assert len(rows) == 10
    assert b"chapsym_step" in library.read_bytes()
    assert b"loops_double" not in library.read_bytes(), "the loops of the package are left out: a second, not fifteen"


def test_every_kernel_of_the_library_has_the_bits_of_its_text(library):
    rng, lines, expected = np.random.default_rng(34), [], []
    for name, (function, groups, _) in generated.TABLE.items():
        numbers = rng.uniform(0.2, 0.9, sum(length for _, length in groups)).tolist()
        found = function(*numbers)
        expected += list(found) if isinstance(found, tuple) else [found]
        arguments, left = [], list(numbers)
        for _, length in groups:
            values, left = [x.hex() for x in left[:length]], left[length:]
            arguments.append(values[0] if length == 1 else f"(double[]){{{', '.join(values)}}}")
        count = len(found) if isinstance(found, tuple) else 1
        lines.append(f"chapsym_{name}({', '.join(arguments)}, out);")
        lines.append(f'for (int i = 0; i < {count}; i++) printf("%a\\n", out[i]);')
    text = '#include <stdio.h>\n#include "chapsym.h"\nint main(void) {{ double out[40];\n{}\nreturn 0; }}'
    found = printed(library, text.format("\n".join(lines))).split()
    assert [float.fromhex(x) for x in found] == expected


def test_the_header_is_cpp_too(tmp_path):
    source = tmp_path / "header.cpp"
    source.write_text('#include "chapsym.h"\nint main() { return 0; }', encoding="utf-8")
    subprocess.run([COMPILER, "-Wall", "-Werror", "-fsyntax-only", "-I", build.folder(), source], check=True)
