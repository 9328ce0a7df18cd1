"""Generated code: deterministic, checked byte for byte and value for value, and the same on every number type."""

import ast
import json
import os
import re
import subprocess
import sys
from fractions import Fraction
from pathlib import Path
from threading import Thread

import flint
import mpmath
import numpy as np
import pytest
import sympy as sp
from commands import answer

from chapsym import generated
from chapsym.codegen import build, printer
from chapsym.proofs.kernels import KERNELS

x, y = sp.symbols("x y")


def test_what_is_committed_is_what_is_derived():
    """By the certificates that are committed, which a test of them compares with what is proved now."""
    assert answer("codegen", "--check")["problems"] == []


def test_the_operations_that_a_kernel_states_are_those_of_its_text():
    for name, row in json.loads((build.folder() / "manifest.json").read_text("utf-8"))["kernels"].items():
        (function,) = ast.parse((build.folder() / f"{name}.py").read_text("utf-8")).body[-1:]
        assert row["operations"] == sum(isinstance(x, ast.BinOp | ast.UnaryOp | ast.Call) for x in ast.walk(function))


def test_a_checkout_is_told_from_a_copy(copy):
    root = Path(build.__file__).parents[2]
    assert build.is_checkout(build.folder()) == (root / "pyproject.toml").is_file()
    assert not build.is_checkout(copy)


@pytest.mark.thorough
def test_the_bytes_do_not_depend_on_the_hash_seed():
    """One seed; another, drawn by Python for each run, is that of this process, by the test above."""
    program = (
        "import json, sys; from committed import build, committed; build.ours().__dict__['judged'] = committed()\n"
    )
    program += "json.dump(build.ours().files, sys.stdout)"
    here = {"PYTHONHASHSEED": "0", "PYTHONPATH": str(Path(__file__).parents[1])}
    done = subprocess.run([sys.executable, "-c", program], env=os.environ | here, capture_output=True, check=True)
    place = build.folder()
    for name, text in json.loads(done.stdout).items():
        assert (place / name).read_bytes() == text.encode(), name


def signs(text):
    """The places of binary and unary signs in the statements of a kernel."""
    start = text.index("# outputs") if "# intermediate" not in text else text.index("# intermediate")
    return [start + m.start() for m in re.finditer(r"(?<= )[+-](?= )|(?<== )-", text[start:])]


@pytest.mark.parametrize("kernel", KERNELS, ids=lambda k: k.name)
def test_any_flipped_sign_changes_the_value(kernel, thorough):
    """Some signs of every kernel, in a thorough run all, flipped in turn, are caught by the fingerprint."""
    text = (build.folder() / f"{kernel.name}.py").read_text(encoding="utf-8")
    trusted = build.stored_fingerprints(build.folder())[kernel.name]
    places = signs(text)
    assert places
    for at in places if thorough else places[:: 1 + len(places) // 3]:
        flipped = text[:at] + {"+": "-", "-": "+"}[text[at]] + text[at + 1 :]
        assert build.text_fingerprint(kernel, flipped) != trusted, flipped[at - 30 : at + 30]


def test_a_reordered_text_is_changed_and_a_wrong_value_is_told_apart(copy):
    path = copy / "compose.py"
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace("# outputs", "# results"), encoding="utf-8")
    assert build.ours().check(copy) == ["compose.py is changed"]
    at = signs(text)[0]
    path.write_text(text[:at] + {"+": "-", "-": "+"}[text[at]] + text[at + 1 :], encoding="utf-8")
    said = ["compose.py is changed", "compose.py computes another value than the derivation"]
    assert build.ours().check(copy) == said


def test_missing_and_extra_files_are_named(copy):
    (copy / "rotate.py").unlink()
    (copy / "stray.py").write_text("", encoding="utf-8")
    assert build.ours().check(copy) == ["rotate.py is missing", "stray.py is extra"]
    with pytest.raises(ValueError, match=r"has not written, such as stray\.py: move it"):
        build.ours().generate(copy)
    assert not (copy / "rotate.py").exists()
    (copy / "stray.py").rename(copy / ".energy.py.half")  # as a command that is killed leaves
    (copy / "former.py").write_bytes((copy / "energy.py").read_bytes())
    build.ours().generate(copy)
    assert build.ours().check(copy) == []


def test_of_two_that_generate_at_once_none_takes_the_files_of_the_other_away(copy, monkeypatch):
    write, other = build.write, Thread(target=build.ours().generate, args=(copy,))

    def first(place, texts):
        if not other.ident:
            (place / ".energy.py.making").touch()
            other.start()
            other.join(1.0)  # it waits for the end of the first
            assert (place / ".energy.py.making").exists()
        write(place, texts)

    monkeypatch.setattr(build, "write", first)
    build.ours().generate(copy)
    other.join()


def test_a_missing_fingerprint_is_not_created_and_a_changed_value_is_not_written_without_trust(copy):
    path = copy / build.FINGERPRINTS
    values = json.loads(path.read_text())
    del values["energy"]
    path.write_text(json.dumps(values))
    expected = "energy has no trusted fingerprint; after review: chapsym codegen --trust energy"
    assert build.ours().check(copy) == [expected]
    with pytest.raises(ValueError, match="energy has no trusted fingerprint"):
        build.ours().generate(copy)
    assert "energy" not in json.loads(path.read_text())
    build.ours().generate(copy, ["energy"])
    assert build.ours().check(copy) == []
    values = json.loads(path.read_text())
    values["momentum"][0] = "1.0"
    path.write_text(json.dumps(values))
    before = {p.name: p.read_bytes() for p in copy.iterdir()}
    with pytest.raises(ValueError, match="momentum changed its value"):
        build.ours().generate(copy)
    assert {p.name: p.read_bytes() for p in copy.iterdir()} == before


@pytest.mark.parametrize(
    ("expr", "text"),
    [
        (x**3, "x * x * x"),
        (x / 3, "x / 3"),
        (sp.Rational(2, 3) * x * y, "2 * x * y / 3"),
        (1 / x, "1 / x"),
        (-x / y**2, "-x / (y * y)"),
        (x - y, "x - y"),
        ((x + y) * x, "x * (x + y)"),
        (sp.Integer(1) / (2 * x), "1 / (2 * x)"),
    ],
)
def test_the_printer_writes_products_and_quotients(expr, text):
    assert printer.text(expr) == text


@pytest.mark.parametrize("expr", [x + sp.Rational(1, 2), sp.sqrt(x), sp.Float("0.5") * x, sp.sin(x), sp.Rational(1, 3)])
def test_the_printer_refuses_what_would_round(expr):
    with pytest.raises(printer.NotStraightLine):
        printer.text(expr)


@pytest.mark.parametrize("kernel", KERNELS, ids=lambda k: k.name)
def test_one_source_runs_on_every_number(kernel):
    function = getattr(generated, kernel.name)
    arguments = [build.at(symbol.name) for symbol in kernel.inputs]

    def values(result):
        return result if isinstance(result, tuple) else (result,)

    exact = values(function(*arguments))
    assert all(isinstance(v, Fraction) for v in exact)
    context = mpmath.MPContext()
    context.dps = 50
    with_mpf = values(function(*(context.mpf(a.numerator) / a.denominator for a in arguments)))
    for found, truth in zip(with_mpf, exact, strict=True):
        assert abs(found - context.mpf(truth.numerator) / truth.denominator) < context.mpf(10) ** -48
    with flint.ctx.workprec(200):
        with_arb = values(function(*(flint.arb(flint.fmpq(a.numerator, a.denominator)) for a in arguments)))
        for found, truth in zip(with_arb, exact, strict=True):
            assert found.contains(flint.fmpq(truth.numerator, truth.denominator))
            assert found.rad() < max(flint.arb(1), abs(found)) * flint.arb(2) ** -190  # 200 bits, a few roundings
    for dtype, digits in [(np.float64, 2e-15), (np.float32, 2e-6)]:
        columns = [np.full((2, 3), float(a), dtype=dtype) for a in arguments]
        for found, truth in zip(values(function(*columns)), exact, strict=True):
            assert found.shape == (2, 3)
            assert found.dtype == dtype
            scale = max(1.0, *(abs(float(v)) for v in exact))
            assert np.abs(found - float(truth)).max() <= 20 * digits * scale
