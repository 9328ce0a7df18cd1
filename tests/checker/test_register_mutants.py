"""The checker of the register with one comparison, sign or `and` turned round: its tests see it, one at a time."""

import ast
import json
import random
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from count_changes import counts
from derivation_changes import derivations
from meaning_changes import FORGED
from meaning_changes import changed as forged
from register_changes import CHANGES, SAMPLES, changed, slip, small

import chapsym.proofs
from chapsym import checker

FOLDER = Path(chapsym.proofs.__file__).parent / "certificates" / "register"
CHECKER = Path(checker.__file__).parent
ARITHMETIC = str(Path(__file__).parents[1] / "register_arithmetic.py")
FILES = (
    "algebra.py",
    "derivation.py",
    "form.py",
    "formulas.py",
    "matrices.py",
    "meaning.py",
    "polynomial.py",
    "register.py",
    "roots.py",
    "trees.py",
    "words.py",
    "zeros.py",
)
TURNED = {
    ast.Lt: ast.GtE, ast.GtE: ast.Lt, ast.LtE: ast.Gt, ast.Gt: ast.LtE, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
    ast.In: ast.NotIn, ast.NotIn: ast.In, ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.Add: ast.Sub, ast.Sub: ast.Add,
    ast.And: ast.Or, ast.Or: ast.And,
}  # fmt: skip
#: Judges a battery with the checker of a folder, in 30 s of processor: exit status 0 if all is judged as it should be.
JUDGE = """
import json, resource, runpy, sys
resource.setrlimit(resource.RLIMIT_CPU, (30, 30))
resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))
sys.path.insert(0, sys.argv[1])
from checker import Rejected, check
def judged(data):
    try:
        return check(data).numbers
    except Rejected as error:
        if "\\n" in str(error):
            raise
        return None
runpy.run_path(sys.argv[3])["arithmetic"]("checker")
right, wrong = json.load(open(sys.argv[2]))
sys.exit(not (all(judged(data) == numbers for data, numbers in right) and not any(map(judged, wrong))))
"""


def places(tree):
    """Every node whose operator can be turned round, with the operators of a chain one by one."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Compare):
            yield from ((node, i) for i, op in enumerate(node.ops) if type(op) in TURNED)
        elif type(getattr(node, "op", None)) in {*TURNED, ast.USub, ast.Not}:
            yield node, None


def turned(source, number):
    """The source with one operator turned round, and what the line was."""
    tree = ast.parse(source)
    node, i = list(places(tree))[number]
    line = source.splitlines()[node.lineno - 1].strip()
    if isinstance(node, ast.Compare):
        node.ops[i] = TURNED[type(node.ops[i])]()
    elif isinstance(node, ast.UnaryOp):
        node.op = ast.UAdd() if isinstance(node.op, ast.USub) else ast.Invert()
        if isinstance(node.op, ast.Invert):  # not x: bool(x)
            node.op, node.operand = ast.Not(), ast.UnaryOp(ast.Not(), node.operand)
    else:
        node.op = TURNED[type(node.op)]()
    return ast.unparse(tree), line


MUTANTS = [(name, i) for name in FILES for i, _ in enumerate(places(ast.parse((CHECKER / name).read_text("utf-8"))))]


@pytest.fixture(scope="module")
def battery(made_once, tmp_path_factory, thorough):
    """Certificates that are right, and others, as a file: small ones first, which see most mutants.

    Those whose formulas have another meaning are in a thorough run: test_meaning.py judges them in this process.
    """

    def made():
        samples = {
            id: checker.read(FOLDER / checker.file_name(id))
            for id in (*SAMPLES, "2.1", "2.15", "4.8", "4.10", "remark-3", "5.11")
        }
        rng = random.Random(7)
        wrong = [changed(samples[id], change) for id, change in CHANGES.values()]
        wrong += [forged(id, change) for id, change in FORGED.values() if thorough]
        wrong += [slip(samples[rng.choice(SAMPLES)], rng)[0] for _ in range(40)]
        right, more = (a | b | c for a, b, c in zip(small(), derivations(), counts(), strict=True))
        right = [[data, checker.check(data).numbers] for data in (*samples.values(), *right.values())]
        parts = [sorted(part, key=lambda one: len(json.dumps(one))) for part in (right, [*wrong, *more.values()])]
        file = tmp_path_factory.mktemp("battery") / "battery.json"
        file.write_text(json.dumps(parts))
        return file

    return made_once("battery", made)


def survives(folder, file, number, battery):
    """Whether the tests do not see a mutant; and its line."""
    copied = folder / "checker"
    shutil.copytree(CHECKER, copied, dirs_exist_ok=True, ignore=shutil.ignore_patterns("__pycache__"))
    source, line = turned((CHECKER / file).read_text("utf-8"), number)
    (copied / file).write_text(source, "utf-8")
    return not run(folder, battery).returncode, line


def run(folder, battery):
    """The battery, judged by the checker of a folder, with nothing installed."""
    command = [sys.executable, "-S", "-I", "-B", "-c", JUDGE, str(folder), str(battery), ARITHMETIC]
    return subprocess.run(command, capture_output=True, text=True)


def test_the_checker_as_it_is_judges_the_battery(tmp_path, battery, thorough):
    """All of it in a thorough run: in this process other tests judge the same certificates."""
    shutil.copytree(CHECKER, tmp_path / "checker")
    if not thorough:
        some = [part[::48] for part in json.loads(battery.read_text())]
        battery = tmp_path / "some.json"
        battery.write_text(json.dumps(some))
    done = run(tmp_path, battery)
    assert done.returncode == 0, done.stderr


def test_a_checker_with_one_thing_turned_round_is_seen(tmp_path, battery, thorough):
    chosen = MUTANTS if thorough else random.Random(18).sample(MUTANTS, 4)
    for file, number in chosen:
        alive, line = survives(tmp_path, file, number, battery)
        assert not alive or line in HARMLESS, (file, line)
        (tmp_path / "checker" / file).unlink()


#: What is turned round without harm, and why.
HARMLESS = {
    "settled[exponents, word] = settled.get((exponents, word), 0) + c": "all words that are left have the other sign",
    'depth += {"{": 1, "}": -1}.get(token, 0)': "a depth is compared with 0 alone",
    "raise NotRead(f\"{token or 'an end'} has no value\")": "it is a message",
    "less = len(self.terms) <= len(other.terms)": "a product is the same the other way round",
    "if a[0] or b[0]:": "of a vector and words one has no transpose, which is refused next",
    'does = "says in words" if unsaid < unsaid | wrong else "does not say"': "it is a message",
    "alone, left, read = alone + identities, left + len(unsaid), read + len(found)": "read is compared with 0 alone",
}
