"""Formulas in TeX are read as they are meant, and what is printed must be what was decided."""

import copy
from fractions import Fraction

import pytest
from certificate_changes import resealed

import chapsym.proofs
from chapsym.checker import Rejected, check, file_name, read
from chapsym.checker.formulas import NotRead, Reader, equations, parts
from chapsym.checker.trees import value

FOLDER = chapsym.proofs.__path__[0] + "/certificates/register/"
NUMBERS = {"a": 2, "b": 3, "c": 5, "x1": 1, "x2": -2, "x3": 4, "y1": 3, "y2": 1, "y3": -1, "s": 7}
GLOSSARY = [
    *([name, name, name] for name in "abcs"),
    ["x", "a vector", ["x1", "x2", "x3"]],
    [r"\tilde x", "another", ["y1", "y2", "y3"]],
    [r"\Lambda", "diagonal", [["a", 0, 0], [0, "b", 0], [0, 0, "c"]]],
    ["A", "a matrix", [["a", "b", 1], [0, "c", 2], [1, 1, "s"]]],
    [r"f(\delta u)", "a function", "s"],
    ["a_{k+1}", "the next a", ["*", 10, "a"]],
]


def numbers(of):
    rank, tree = of
    if rank:
        return [numbers((rank - 1, part)) for part in tree]
    return value(tree, {name: Fraction(x) for name, x in NUMBERS.items()}, Fraction)


READ = {
    "1 + 2a - bc": 1 + 4 - 15,
    r"\frac ab": Fraction(2, 3),
    r"\tfrac12 a": 1,
    r"\frac{a+b}2c": Fraction(25, 2),
    "-a^2": -4,
    "a^{-1}b^2": Fraction(9, 2),
    "12a": 24,
    "a_{k+1} - a": 18,
    r"f(\delta u)\,a": 14,
    r"\langle x, \tilde x\rangle": 3 - 2 - 4,
    r"x\times\tilde x": [-2, 13, 7],
    r"a\,x\times\tilde x": [-4, 26, 14],
    r"\Lambda x": [2, -6, 20],
    r"\Lambda^{-2}x": [Fraction(1, 4), Fraction(-2, 9), Fraction(4, 25)],
    r"\Lambda x\times x": [-6 * 4 + 2 * 20, 20 - 8, -4 + 6],
    r"\langle x,\Lambda^{-1}\tilde x\rangle": Fraction(3, 2) - Fraction(2, 3) - Fraction(4, 5),
    "A x": [2 - 6 + 4, -10 + 8, 1 - 2 + 28],
    r"A^T x": [2 + 4, 3 - 10 + 4, 1 - 4 + 28],
    r"[A, \Lambda]": [[0, 3 * 3 - 2 * 3, 5 - 2], [0, 0, 4], [2 - 5, 3 - 5, 0]],
    r"\mathrm{diag}(a, b, c)x": [2, -6, 20],
    "2(a + b, bc, -s)^T": [10, 30, -14],
    r"[a + b]\,\bigl(a - b\bigr)": -5,
    r"\langle x,\tilde x\rangle^2 x": [9, -18, 36],
}  # fmt: skip


@pytest.mark.parametrize("formula", READ)
def test_a_formula_is_read_as_it_is_meant(formula):
    [(left, right)] = equations(parts(f"{formula} = s")[0], Reader(GLOSSARY))
    assert (numbers(left), numbers(right)) == (READ[formula], 7)


def test_words_are_transposed_by_their_letters():
    glossary = [["A", "", "A"], ["B", "", ["*", "A", "B"]], ["v", "", "v"], ["w", "", "w"], ["m", "", "m"]]
    transposes = {"A": "A^T", "A^T": "A", "B": ["*", -1, "B"], "v": "v^T", "v^T": "v", "w": "w^T", "w^T": "w", "m": "m"}
    for formula, tree in {
        "B^T": ["*", ["*", -1, "B"], "A^T"],
        "(mA)^T": ["*", "A^T", "m"],
        r"v\wedge w": ["+", ["*", "v", "w^T"], ["*", -1, ["*", "w", "v^T"]]],
        r"v\wedge w^T": ["+", ["*", "v", "w^T"], ["*", -1, ["*", "w", "v^T"]]],
    }.items():
        [(left, _)] = equations(parts(f"{formula} = A")[0], Reader(glossary, transposes))
        assert left == (0, tree)
    with pytest.raises(NotRead, match="the transpose of F is not known"):
        equations(parts("F^T = A")[0], Reader([["F", "", "F"], ["A", "", "A"]], {"A": "A"}))


def test_parts_and_chains():
    formula = r"a = b \equiv c,\ \langle x, x\rangle = s;\quad \text{for all } a: a = b"
    assert len(parts(formula)) == 4
    assert len(equations(parts(formula)[0], Reader(GLOSSARY))) == 2


@pytest.mark.parametrize(
    "formula",
    ["z = a", "a", r"\frac a = b", "(a = b", r"\langle a, b\rangle = c", "x x = a", "x + a = b", "a^b = c",
     "A^{-1} = A", r"\sqrt a + \sqrt b = c", r"a \times b = c", "{a = b", r"\langle x, x, x\rangle = a", "= a", "a = ",
     r"\oint a = b", r"(a, x, b)^T = x"],
)  # fmt: skip
def test_what_is_not_read_is_said(formula):
    [part] = parts(formula)
    with pytest.raises(NotRead) as caught:
        equations(part, Reader(GLOSSARY))
    assert 5 < len(str(caught.value)) < 100


def certificate(id):
    return read(FOLDER + file_name(id))


def changed(id, change):
    data = copy.deepcopy(certificate(id))
    change(data)
    return resealed(data)


def value_of(symbol, made):
    def change(data):
        one = next(one for one in data["glossary"] if one[0] == symbol)
        one[2] = made(one[2])

    return change


def renamed(tree, names):
    if isinstance(tree, dict):
        return {names.get(name, name): renamed(part, names) for name, part in tree.items()}
    return [renamed(part, names) for part in tree] if isinstance(tree, list) else names.get(tree, tree)


def exchanged(data):
    """The statements in other letters than the glossary."""
    names = {"g1": "g2", "g2": "g1"}
    for part in ("algebras", "points", "statements", "counterexamples", "hypotheses"):
        data[part] = renamed(data[part], names)


def swapped(data):
    data["printed"], data["corrected"] = data["corrected"], data["printed"]


def supposed(data):
    """The conclusion as a relation: the statement follows from itself."""
    one = next(one for one in data["statements"] if one["role"] == "printed")
    data["statements"] = [one]
    one["left"], one["right"], one["cofactors"] = one["left"][:1], one["right"][:1], [[1]]
    data["algebras"][one["algebra"]]["relations"] = [["+", one["left"][0], ["*", -1, one["right"][0]]]]
    data["glossary"], data["points"] = [], [dict.fromkeys(data["algebras"][one["algebra"]]["variables"], 0)]
    one["point"] = 0


FORGED = {
    "the printed sign is turned": ("2.5", lambda d: d.update(printed=d["printed"].replace("- ", "+ "))),
    "the corrected sign is turned": ("2.5-inverse", lambda d: d.update(corrected=d["corrected"].replace("+ ", "- "))),
    "printed and corrected are exchanged": ("5.11", swapped),
    "what is printed is right": ("prop-4", lambda d: d.update(printed=d["corrected"])),
    "the verdict is holds": ("prop-4", lambda d: d.update(verdict="holds")),
    "the verdict is refuted": ("2.5", lambda d: d.update(verdict="refuted")),
    "the verdict of what holds is corrected": ("4.10", lambda d: d.update(verdict="corrected")),
    "no correction": ("2.5", lambda d: d.update(corrected=None)),
    "a correction of what holds": ("4.10", lambda d: d.update(corrected=d["printed"])),
    "a factor in a long formula": ("5.16", lambda d: d.update(printed=d["printed"].replace("(2-", "(3-"))),
    "a power in a long formula": ("5.16", lambda d: d.update(corrected=d["corrected"].replace("^4", "^2", 1))),
    "an index": ("4.10", lambda d: d.update(printed=d["printed"].replace(r"\Omega_{k-1}^T]", r"\Omega_k^T]"))),
    "a transpose": ("4.7", lambda d: d.update(printed=d["printed"].replace(r"\Omega_{k-1}^T M", r"\Omega_{k-1} M"))),
    "another constraint": ("4.9-F", lambda d: d.update(corrected=d["corrected"].replace("2(", "3(", 1))),
    "the order of a product": ("remark-3", lambda d: d.update(printed=d["printed"].replace(r"\Omega_{k-1}(J", r"(J"))),
    "a root without its other sign": ("5.12-q0", lambda d: d.update(corrected=d["corrected"].replace(r"\pm", "+"))),
    "more under a root": ("5.12-q0", lambda d: d.update(printed=d["printed"].replace(r"\tfrac14", r"\tfrac13"))),
    "the value of a symbol": ("2.5", value_of(r"\omega", lambda v: [["*", -1, x] for x in v])),
    "the value of a matrix": ("5.11", value_of(r"\Lambda", lambda v: v[::-1])),
    "the value of what vanishes": ("4.10", value_of("0", lambda v: ["*", 2, v])),
    "the statements in other letters": ("2.5", exchanged),
    "the conclusion among the relations": ("2.2-F", supposed),
    "a symbol twice": ("2.5", lambda d: d["glossary"].append(d["glossary"][0])),
    "a symbol without a meaning": ("2.5", lambda d: d["glossary"][0].__setitem__(1, "")),
    "a value that is none": ("2.5", lambda d: d["glossary"][0].__setitem__(2, {"a": 1})),
    "a value in no letters": ("2.5", lambda d: d["glossary"][0].__setitem__(2, "z9")),
    "a row too long": ("2.5", lambda d: d["glossary"][0].__setitem__(2, [["D"], ["D", "D"]])),
    "the claim uses itself": ("2.5", lambda d: d.update(uses=["2.5"])),
}  # fmt: skip


@pytest.mark.parametrize("name", FORGED)
def test_a_certificate_with_another_meaning_is_refused(name):
    id, change = FORGED[name]
    check(certificate(id))
    with pytest.raises(Rejected) as caught:
        check(changed(id, change))
    assert 10 < len(str(caught.value)) < 300


def test_the_formulas_of_most_equations_are_read():
    """A change here is progress, or a loss, and must be looked at."""
    from pathlib import Path

    files = [read(path) for path in Path(FOLDER).iterdir()]
    assert sum(bool(data["glossary"]) for data in files) == 44
    assert [data["claim"] for data in files if data["verdict"] == "open"] == []
