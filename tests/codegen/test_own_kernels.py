"""Kernels of a register that is not of chapsym: a small one, made here, and that of the rolling disc."""

import importlib
import json
import math
import re
import shutil
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from commands import answer, chapsym, refused
from pendulum import CLAIMS, GROUPS, KERNELS
from scipy.integrate import solve_ivp

from chapsym import Enclosure, implicit_step
from chapsym.codegen import build

ROOT = Path(build.__file__).parents[2]
DISC = ROOT / "docs/examples/rolling_disc"
pytestmark = pytest.mark.usefixtures("forgotten")


def test_the_chain_from_a_claim_to_its_kernels(register):
    folder = register()
    written = answer("codegen", "--register", folder)["written"]
    assert {"pull.py", "pendulum.c", "pendulum.h", "manifest.json", "fingerprints.json"} <= set(written)
    assert answer("codegen", "--check", "--register", folder)["kept"] is True
    scope = {}
    exec((folder / "generated/pull.py").read_text(encoding="utf-8"), scope)
    assert scope["pull"](Fraction(3, 5), Fraction(-4, 5), 1, 2, 10) == 13
    proved = chapsym("prove", "--register", folder, "--jobs", "1", "--certificates", folder / "certificates")
    assert proved.returncode == 0, proved.stderr
    files = [folder / "generated", *(folder / "certificates").glob("*.json")]
    command = [sys.executable, "-S", "-I", ROOT / "checker", "--kernels", *files]
    assert "pull.py: accepted (kernel)" in subprocess.run(command, capture_output=True, text=True, check=True).stdout
    text = (folder / "generated/pull.py").read_text(encoding="utf-8")
    (folder / "generated/pull.py").write_text(text.replace("return o_a", "return -o_a"), encoding="utf-8")
    assert subprocess.run(command, capture_output=True, text=True, check=False).returncode == 1
    assert "pull.py computes another value" in chapsym("codegen", "--check", "--register", folder).stderr
    (folder / "generated/fingerprints.json").write_text("[", encoding="utf-8")
    assert "fingerprints.json is not what chapsym" in refused("codegen", "--register", folder, status=1)
    shutil.rmtree(folder / "generated")
    (folder / "generated").mkdir()
    (folder / "generated/notes.txt").write_text("of mine", encoding="utf-8")
    assert "has not written, such as notes.txt: move it" in refused("codegen", "--register", folder, status=1)
    assert (folder / "generated/notes.txt").exists()


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"expression": "-pull()"}, "computes in its result 0 something else than"),
        ({"carrier": "left('{id}', 'no statement')"}, "decides 0 times"),
        ({"carrier": "left('own-none', MOVING)"}, "names the claim own-none, which no proof judges"),
        ({"claims": CLAIMS.replace("return v**2", "return 2 * v**2")}, "which is not proved"),
        ({"groups": '(("place", (x, y)), ("velocity", (v, w)))'}, "have g, which is no argument"),
        ({"groups": '(("place", (x, x)), ("velocity", (v, w)), ("gravity", (g,)))'}, "two arguments have the name x"),
        ({"kernels": KERNELS.replace('Kernel("pull"', 'Kernel("lambda"')}, "'lambda' cannot be a name"),
        ({"kernels": KERNELS.replace('Kernel("pull"', 'Kernel("__init__"')}, "'__init__' cannot be a name"),
        ({"groups": GROUPS.replace("gravity", "int")}, "'int' cannot be a name"),
        ({"groups": GROUPS.replace("gravity", "g now")}, "'g now' cannot be a name"),
        ({"groups": GROUPS.replace("gravity", "place")}, "two groups of arguments have the name place"),
        ({"kernels": KERNELS.replace("({carrier},)", "{carrier}")}, "the carriers of pull must be a tuple of carriers"),
        ({"expression": "None"}, "its expression None is no expression of SymPy"),
        ({"carrier": "right('{id}', MOVING).solved(5)"}, "the matrix of a linear system is another carrier, not 5"),
        ({"carrier": "right('{id}', MOVING).at({{'a': 1}})"}, "is given as {symbol: expression}, not {'a': 1}"),
        ({"carrier": "right('{id}', MOVING).along(a)"}, "is given as {symbol: expression}, not a"),
        ({"kernels": KERNELS.replace("lambda: ", "")}, "what builds pull must be a function without arguments"),
        ({"kernels": KERNELS.replace('Kernel("pull"', "Kernel(None")}, "outputs of None must be texts"),
        ({"kernels": KERNELS.replace('Kernel("pull", "', 'Kernel("pull", "*/')}, "its summary must be one line"),
        ({"expression": "1 / 0"}, "pull: what builds it raised ZeroDivisionError: division by zero"),
        ({"expression": "exit(0)"}, "pull: what builds it raised SystemExit: 0"),
        ({"expression": "pull(), 1"}, "1 outputs and 2 expressions"),
        ({"expression": "pull() / 3 + y**2 / 3 - y**2 / 3 - pull() * 2"}, "computes in its result 0 something else"),
        ({"kernels": KERNELS.replace("KERNELS = [", "NONE = [")}, "has no kernels.py with KERNELS"),
        ({"kernels": KERNELS.replace("from .claims", "from .nothing")}, "cannot be loaded"),
    ],
)
def test_what_is_not_decided_is_refused_in_one_sentence(register, changes, said):
    folder = register(**changes)
    done = chapsym("codegen", "--register", folder)
    assert said in done.stderr
    assert done.stderr.count("\n") == 1
    assert done.returncode in (1, 2)
    assert not (folder / "generated").exists()


def test_equal_by_the_relations_alone_is_equal(register):
    """The left side has x² + y², which is 1: the kernel does not."""
    folder = register(carrier="right('{id}', 'a at which that is 0')")
    answer("codegen", "--register", folder)
    (carrier,) = json.loads((folder / "generated/manifest.json").read_text(encoding="utf-8"))["kernels"]["pull"][
        "carriers"
    ]
    assert [entry for entry, _ in carrier["cofactors"]] == [0]


def test_an_example_has_the_kernels_that_are_committed():
    """Those of the disc are checked by the page `own-claims`."""
    assert answer("codegen", "--check", "--register", DISC.parent / "suslov")["kept"] is True


@pytest.mark.skipif(shutil.which("cc") is None, reason="no compiler of C is installed")
def test_the_kernels_of_the_disc_in_c(tmp_path):
    main = '#include <math.h>\n#include <stdio.h>\n#include "rolling_disc.h"\nint main(void) { double a[3];\n'
    main += "rolling_disc_accelerations(asin(.6), (double[]){1, 2, -1}, .5, 10, a);\n"
    main += 'printf("%a %a %a", a[0], a[1], a[2]); return 0; }\n'
    (tmp_path / "main.c").write_text(main, encoding="utf-8")
    place = DISC / "generated"
    command = ["cc", "-Wall", "-Werror", "-ffp-contract=off", "-I", place, tmp_path / "main.c"]
    subprocess.run([*command, place / "rolling_disc.c", "-lm", "-o", tmp_path / "main"], check=True)
    printed = subprocess.run([tmp_path / "main"], check=True, capture_output=True, text=True).stdout
    scope = {}
    exec((place / "accelerations.py").read_text(encoding="utf-8"), scope)
    found = scope["accelerations"](math.asin(0.6), 1, 2, -1, 0.5, 10)
    assert [float.fromhex(x) for x in printed.split()] == list(found)


WHOLE = """
WHOLE = "the same with whole numbers"


@claim("{id}-whole", "1")
def whole(p: Proof) -> None:
    \"\"\"Constants and large whole numbers.\"\"\"
    p.printed(equal(WHOLE, [x - x + 1 - (1 - x**2 - y**2), 10**25 * v + w, 7 * w],
                    [1, v * 10**25 + w * (x**2 + y**2), w * 7 + x**2 + y**2 - 1]))
    p.control(equal("1 = 2", 1, 2))
"""


@pytest.mark.skipif(shutil.which("cc") is None, reason="no compiler of C is installed")
def test_c_and_python_have_the_same_constants_and_large_numbers(register, tmp_path):
    kernels = """from chapsym.codegen import Kernel, right

from .claims import WHOLE, v, w

KERNELS = [
    Kernel("one", "1", (right("{id}-whole", WHOLE).entries(0),), GROUPS, ("a",), lambda: [1]),
    Kernel("all", "More", (right("{id}-whole", WHOLE),), GROUPS, ("a", "b", "c"), lambda: [1, 10**25 * v + w, 7 * w]),
]
"""
    folder = register(claims=CLAIMS + WHOLE, kernels="")
    identity = re.search(r'@claim\("(own-[^"]*)-whole', (folder / "claims.py").read_text("utf-8"))[1]
    text = kernels.replace("{id}", identity).replace("GROUPS", '(("v", (v,)), ("w", (w,)))')
    (folder / "kernels.py").write_text(text, encoding="utf-8")
    answer("codegen", "--register", folder)
    main = '#include <stdio.h>\n#include "pendulum.h"\nint main(void) { double a[3], b[1];\n'
    main += 'pendulum_all(3, 5, a); pendulum_one(3, 5, b); printf("%a %a %a %a", a[0], a[1], a[2], b[0]); return 0; }\n'
    (tmp_path / "main.c").write_text(main, encoding="utf-8")
    place = folder / "generated"
    command = ["cc", "-Wall", "-Werror", "-I", place, tmp_path / "main.c", place / "pendulum.c"]
    subprocess.run([*command, "-o", tmp_path / "main"], check=True)
    printed = subprocess.run([tmp_path / "main"], check=True, capture_output=True, text=True).stdout
    assert [float.fromhex(x) for x in printed.split()] == [1.0, 1e25 * 3 + 5, 35.0, 1.0]


EMPTY = """
SQUARE, RELATION, FIVE = "(x + y)² = 1 + 2xy", "the relation", "five times"


@claim("{id}-empty", "1")
def empty(p: Proof) -> None:
    \"\"\"What is true where x² + y² = 1.\"\"\"
    p.printed(equal(SQUARE, a * (x + y) ** 2, a * (1 + 2 * x * y)))
    p.lemma(equal(RELATION, x**2 + y**2 - 1, 0), equal(FIVE, 5 * (x**2 + y**2 - 1), 0))
    p.control(equal("1 = 2", 1, 2))
"""


@pytest.mark.parametrize(
    ("carrier", "expression"),
    [
        ("right({id}, SQUARE).at({x: 2, y: 0})", "a**3 + 17"),  # the relation becomes 3 = 0
        ("left({id}, FIVE).solved(left({id}, RELATION))", "5 * x"),  # of the system 0 = 0
        ("right({id}, SQUARE).at({a: 7 * (x**2 + y**2 - 1) / (1 - x**2 - y**2)})", "8 * x"),  # 0/0
        ("right({id}, SQUARE).at({x: v, y: w})", "a * (2*v**2 + 2*w**2 - 2 + (v**2 + w**2 - 1)*v)/(v**2 + w**2 - 1)"),
    ],
)
def test_what_is_equal_because_nothing_obeys_the_relations_is_refused(register, carrier, expression):
    folder = register(claims=CLAIMS + EMPTY, kernels="")
    identity = re.search(r'@claim\("(own-[^"]*-empty)', (folder / "claims.py").read_text("utf-8"))[1]
    carrier = carrier.replace("{id}", f"'{identity}'")
    text = "from chapsym.codegen import Kernel, left, right\n\nfrom .claims import *\n\n"
    text += "GROUPS = (('place', (x, y)), ('velocity', (v, w)), ('pull', (a,)))\n"
    text += f"KERNELS = [Kernel('wrong', 'Wrong.', ({carrier},), GROUPS, ('e',), lambda: [{expression}])]\n"
    (folder / "kernels.py").write_text(text, encoding="utf-8")
    done = chapsym("codegen", "--register", folder)
    assert (done.returncode, done.stdout) == (1, "")
    assert re.search("wrong (has no point at which its relations hold|divides by 0 at its point)", done.stderr)
    assert not (folder / "generated").exists()


def test_the_disc_takes_steps(monkeypatch):
    """The midpoint rule of its register: of order 2, its own inverse, at rest in steady motions."""
    monkeypatch.syspath_prepend(DISC.parent)
    disc = importlib.import_module("rolling_disc.generated")
    middle = implicit_step(disc.TABLE["step_lack"], disc.TABLE["step_slope"])

    def end(start, h, **options):
        return 2 * middle(start, start, [0.5], [9.81], [h], **options) - start

    def rates(_, x):
        return np.array([x[1], *disc.spin_rates(*x, 0.5, 9.81)])

    start, off = np.array([0.3, 0.1, -2.0, 1.5]), []
    exact = solve_ivp(rates, (0, 1), start, "DOP853", rtol=1e-10, atol=1e-10).y[:, -1]
    for steps in (20, 40):
        x = start
        for _ in range(steps):
            x = end(x, 1.0 / steps)
        off.append(np.abs(x - exact).max())
    assert 3.8 < off[0] / off[1] < 4.2
    assert np.abs(end(end(start, 0.1), -0.1) - start).max() < 20 * 2.0**-53 * np.abs(start).max()
    turn, lean = 1.5, 0.3
    roll = (0.5 * turn**2 * math.tan(lean) - 4 * 9.81 * math.sin(lean)) / (6 * 0.5 * turn)
    steady = np.array([lean, 0.0, roll, turn])
    assert np.abs(end(steady, 0.5) - steady).max() < 20 * 2.0**-53 * np.abs(steady).max()
    proved = middle(start, start, [0.5], [9.81], [0.1], precision=Enclosure(100))
    near = middle(start, start, [0.5], [9.81], [0.1])
    assert all(abs(x.mid() - y) < 1e-15 for x, y in zip(proved, near, strict=True))
