"""Kernels and claims are joined by content: the checker compares each text with what was decided."""

import dataclasses
import hashlib
import json
import re
import shutil
from functools import cache
from pathlib import Path

import pytest
from committed import register

from chapsym.checker import Rejected
from chapsym.checker import kernels as binding
from chapsym.codegen import build, left, right
from chapsym.derive.three import D, q0
from chapsym.proofs.kernels import COLLECTED, KERNELS

ROOT = Path(build.__file__).parents[2]
ROWS = json.loads((build.folder() / build.MANIFEST).read_text(encoding="utf-8"))["kernels"]
every = pytest.mark.parametrize("name", [kernel.name for kernel in KERNELS])


def text_of(name):
    return (build.folder() / f"{name}.py").read_text(encoding="utf-8")


@cache
def certificates():
    """Those of the register, by the names of their verdicts."""
    return {f"{data['claim']} {data['digest']}": data for data in register().values()}


def judge(name, text, row=None, decided=None):
    """With the hash of the text that is given: what is compared is what it computes."""
    row = {**(row or ROWS[name]), "text_sha256": hashlib.sha256(text.encode()).hexdigest()}
    return binding.check(row, text, certificates() if decided is None else decided, name)


def test_all_kernels_compute_what_the_committed_certificates_decided():
    found = binding.check_folder(build.folder(), certificates())
    assert len(found) == len(KERNELS)
    assert [one for one in found if not one["accepted"]] == []


@every
def test_a_sign_turned_in_a_text_is_refused(name, thorough):
    text = text_of(name)
    start = text.index("# intermediate" if "# intermediate" in text else "# outputs")
    signs = [start + found.start() for found in re.finditer(r"(?<= )[+-](?= )", text[start:])]
    for at in signs if thorough else signs[:: 1 + len(signs) // 3]:
        with pytest.raises(Rejected, match="computes in its result"):
            judge(name, text[:at] + {"+": "-", "-": "+"}[text[at]] + text[at + 1 :])


#: Of which one takes as long as all others: the others, of which every other one is taken, are refused alike.
LONG = ("gibbs_newton", "gibbs_newton_heavy", "gibbs_symmetric")


@pytest.mark.parametrize(
    "kernel",
    [
        pytest.param(kernel, marks=pytest.mark.thorough if i % 2 or kernel.name in LONG else (), id=kernel.name)
        for i, kernel in enumerate(KERNELS)
    ],
)
def test_a_sign_turned_in_a_derivation_is_refused(kernel):
    package = build.ours()
    first, *rest = kernel.expressions
    turned = dataclasses.replace(kernel, build=lambda: [-first, *rest], factored=None)
    with pytest.raises(Rejected, match="computes in its result 0 something else"):
        package.source(turned)


def test_a_text_that_is_not_that_of_the_manifest_is_refused():
    with pytest.raises(Rejected, match="a text with another hash"):
        binding.check(ROWS["compose"], text_of("compose") + "\n", certificates(), "compose")


@pytest.mark.parametrize(
    ("carrier", "said"),
    [
        (left("5.2", "no such statement"), "which claim 5.2 decides 0 times"),
        (left("5.1", "(5.1), nine entries"), "which claim 5.1 refutes"),
        (left("5.1", "Ω - Ωᵀ = 4q₀ q×: right-handed about q"), "one expression on both sides"),
        (left("4.9", "γᵀ Δr_k = 0"), "which is about words"),
        (left("5.2", COLLECTED).entries(0, 3), "an entry that .* does not have"),
        (left("5.2", COLLECTED).entries(0), "has 3 results, and its carriers make 1"),
        (left("5.2", "M⃗ as printed"), "which claim 5.2 decides 2 times"),
        (left("5.2", COLLECTED).at({D: 0}), "computes in its result 0 something else"),
        (left("5.2", COLLECTED).along({q0: 1}), "along rates that break a relation"),
        (left("5.2", COLLECTED).solved(left("5.1", "ΩᵀΩ = 1").entries(0, 1)), "solves a system that is not"),
    ],
)
def test_what_carries_no_kernel_is_refused(carrier, said):
    with pytest.raises(Rejected, match=said):
        judge("momentum", text_of("momentum"), {**ROWS["momentum"], "carriers": [carrier.data(digest)]})


def digest(id):
    return next(data["digest"] for data in certificates().values() if data["claim"] == id)


def test_an_open_claim_carries_nothing():
    with pytest.raises(Rejected, match=r"a certificate of claim 5\.2 that is not accepted among these files"):
        judge("momentum", text_of("momentum"), decided={})


TEXT = '"""Solved."""\n\n\ndef solved(K1, K2, g1, g2):\n    """x."""\n    det = g1 * g1 + g2 * g2\n    return {}\n'
STATEMENTS = [
    {"text": "a turn", "left": ["g1", ["*", -1, "g2"], "g2", "g1"], "right": [0, 0, 0, 0], "algebra": 0, "point": 0},
    {"text": "a vector", "left": ["K1", "K2"], "right": [0, 0], "algebra": 0, "point": 0},
]
SOLVED = {
    "x 0": {
        "algebras": [{"kind": "quotient", "variables": ["K1", "K2", "g1", "g2"], "relations": []}],
        "derivation": [],
        "points": [dict.fromkeys(("K1", "K2", "g1", "g2"), 1)],
        "statements": STATEMENTS,
    }
}


INPUTS = ["K1", "K2", "g1", "g2"]


def test_a_linear_system_is_solved():
    carrier = left("x", "a vector").solved(left("x", "a turn")).data(lambda id: "0")
    right_ = TEXT.format("(g1 * K1 + g2 * K2) / det, (g1 * K2 - g2 * K1) / det")
    row = {"inputs": INPUTS, "carriers": [carrier | {"point": dict.fromkeys(INPUTS, 1)}]}
    assert judge("solved", right_, row, SOLVED) == ["a vector: the solution of a linear system"]
    wrong = TEXT.format("(g1 * K1 - g2 * K2) / det, (g1 * K2 + g2 * K1) / det")
    with pytest.raises(Rejected, match="computes in its result 0 something else"):
        judge("solved", wrong, row, SOLVED)
    for point, said in (
        (dict.fromkeys(INPUTS, 0), "divides by 0 at its point"),
        ({"K1": 1, "K2": 1, "g1": 1}, "no value for g2"),
        (dict.fromkeys(INPUTS, 1.0), "neither an integer nor a quotient"),
        ([], "point of a carrier of solved 0 must be of the kind dict"),
    ):
        with pytest.raises(Rejected, match=said):
            judge("solved", right_, {"inputs": INPUTS, "carriers": [carrier | {"point": point}]}, SOLVED)
    with pytest.raises(Rejected, match="no point at which its relations hold"):
        judge("solved", right_, {"inputs": INPUTS, "carriers": [carrier]}, SOLVED)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("def compose(a0", "def compose(a0: print(1)", "annotations"),
        ("b3):", "b3) -> print(1):", "annotations"),
        ("def compose(a0", "def compose(a0, /", "beyond a list of names"),
        ("def compose(a0, a1", "def compose(a1, a0", "does not have the arguments"),
        ("def compose(", "def composed(", "of another name"),
        ("return o_", "return 0, o_", "has 5 results"),
        ("a1, a2", "a1, a1", "not Python"),
        ("o_c0 = ", "__debug__ = ", "not Python"),
        ("return o_c0", "return o_c0 * ((10**25 + 1) / 3 - 10**25 / 3) * 3", "neither a known name|whole numbers"),
        ("return o_c0", "return o_c0 * (7 / 3) * (3 / 7)", "whole numbers alone"),
        ("    o_c0 = ", "    t9 = 3\n    t8 = t9 / 3\n    o_c0 = t8 * ", "whole numbers alone"),
        ('"""Written', '# coding: utf-7\n"""Written', "not a docstring and one function"),
        ("Proved by: ", "Proved by: remark-1, ", "proved by what does not carry it"),
        ("sha256 ", "sha256 0", "proved by what does not carry it"),
    ],
)
def test_a_text_that_python_reads_otherwise_is_refused(old, new, said):
    text = text_of("compose")
    assert old in text
    with pytest.raises(Rejected, match=said):
        judge("compose", text.replace(old, new))


DEFINED = {
    "x 0": {
        "algebras": [{"kind": "quotient", "variables": ["w", "x", "y"], "relations": ["x"]}],
        "derivation": [],
        "points": [],
        "statements": [
            {"text": "defined", "left": [["*", "E", "x"]], "right": [0], "definitions": [["E", ["^", "y", 2]]],
             "algebra": 0, "point": 0},
            {"text": "divided", "left": [["*", "y", ["^", "w", -1]]], "right": [0], "algebra": 0, "point": 0},
        ],
    }
}  # fmt: skip


@pytest.mark.parametrize(
    ("statement", "steps", "returned", "cofactors", "said"),
    [
        ("defined", [["along", [[["E", 1]]]]], "0 * x", [], "moves 'E', which is no variable"),
        ("defined", [["along", [[["typo", 1]]]]], "0 * x", [], "moves 'typo', which is no variable"),
        ("defined", [["at", [["E", 0]]]], "y * y * x", [], "moves 'E', which is no variable"),
        ("defined", [["at", [["y", "w"]]], ["at", [["y", 0]]]], "w * w * x", [], "moves 'y', which is no variable"),
        ("divided", [["at", [["w", ["^", "x", -1]]]]], "0 * x", [[0, [["*", -1, "y"]]]], "divides by 0 at its point"),
        (
            "divided",
            [["entries", [0]], ["at", [["w", ["^", "x", -1]]]]],
            "0 * x",
            [[0, [["*", -1, "y"]]]],
            "divides by 0",
        ),
    ],
)
def test_steps_that_do_nothing_or_divide_by_0_are_refused(statement, steps, returned, cofactors, said):
    carrier = left("x", statement).data(lambda id: "0") | {"steps": steps, "cofactors": cofactors}
    row = {"inputs": ["w", "x", "y"], "carriers": [carrier | {"point": {"w": 1, "x": 0, "y": 2}}]}
    text = f'"""A."""\n\n\ndef f(w, x, y):\n    return {returned}\n'
    with pytest.raises(Rejected, match=said):
        judge("f", text, row, DEFINED)


def test_what_python_imports_in_its_place_is_refused(tmp_path):
    """A folder of the name of a kernel hides its file."""
    folder = tmp_path / "generated"
    shutil.copytree(build.folder(), folder)
    (folder / "energy").mkdir()
    (folder / "rotation.cpython-311.so").touch()
    found = [one for one in binding.check_folder(folder, certificates()) if not one["accepted"]]
    assert [one["reason"] for one in found] == [
        "rotation lies with rotation.cpython-311.so, which Python would import in its place",
        "energy lies with energy, which Python would import in its place",
    ]
    assert "energy is extra" in build.ours().check(folder)


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("import os", "not a docstring and one function"),
        ("def f(a, b=1):\n    return a", "defaults"),
        ("def f(a):\n    while a: pass\n    return a", "something else than assign"),
        ("def f(a):\n    return a.real", "neither a known name"),
        ("def f(a):\n    return a * 0.5", "neither a known name"),
        ("def f(a):\n    return (a,)", "neither a known name"),
        ("def f(a):\n    b = a", "something else than assign|returns nothing"),
        ("def f(a):\n    return a / (a - a)", "divides by 0"),
        ("def f(:", "not Python"),
    ],
)
def test_a_text_that_is_no_straight_line_is_refused(body, said):
    carrier = right("x", "a vector").data(lambda id: "0")
    with pytest.raises(Rejected, match=said):
        judge("f", f'"""A."""\n\n\n{body}\n', {"inputs": ["a"], "carriers": [carrier]}, SOLVED)
