"""Certificates of the register with another meaning."""

import copy

from certificate_changes import resealed

import chapsym.proofs
from chapsym.checker import file_name, read

FOLDER = chapsym.proofs.__path__[0] + "/certificates/register/"


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


def traced(data):
    """A statement about traces as one about matrices."""
    kind = next(i for i, one in enumerate(data["algebras"]) if one["kind"] == "traces")
    one = next(one for one in data["statements"] if one["algebra"] == kind)
    data["statements"] = [one | {"role": "printed", "left": [["*", "J", "omega"]], "right": [["*", "omega", "J"]]}]
    data["printed"] = r"J\omega = \omega J"


def with_part(formula):
    """One more part of what is printed."""
    return lambda data: data.update(printed=f"{data['printed']},\\ {formula}")


def with_symbol(symbol, value):
    return lambda data: data["glossary"].append([symbol, "x", value])


def vanishing(data):
    """The formula itself vanishes by the glossary."""
    with_symbol("0", ["+", ["*", 7, "D"], -1])(data)
    data["printed"] = "7D = 1"


def false_sentence(data):
    data["sentences"].append({"role": "printed", "text": "false: x"})
    data["verdict"] = "refuted"


#: What is false, or no formula, and may not be printed with what is right.
PARTS = [
    r"\sqrt{D^2} = -D", "D² = D", "D^2^2 = D^4", r"\frac12 = \frac1\Lambda", r"(D, D)^T + \gamma = 0",
    r"\Lambda(D, D)^T = 0", "1 = \\", r"\gamma^T = \gamma", r"\text{} D = 1", r"\words D = 1",
    "(" * 200 + "D" + ")" * 200 + " = D", "{" * 3000, "+".join("D" * 1500) + " = 1500D + 1",
    r"\gamma" + r"\times\gamma" * 60 + " = 0", "[" * 60 + "D" + ",J]" * 60 + " = 0",
]  # fmt: skip
SYMBOLS = ["2", "=", "+", "(", r"\neg D", "D^2", "К", "{F}", r"D \not", "D,", "", "x" * 100]

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
    **{f"the part {formula:.60}": ("2.2-F", with_part(formula)) for formula in PARTS},
    **{f"the symbol {symbol:.20}": ("2.2-F", with_symbol(symbol, 1)) for symbol in SYMBOLS},
    "± before no root": ("2.5", lambda d: d.update(corrected=d["corrected"].replace("+", r"\pm"))),
    "± before 0": ("5.12-q0", lambda d: d.update(corrected=d["corrected"].replace("= 1\\pm", "\\pm 0 = 1+"))),
    "a root with the other sign": ("prop-4", lambda d: d.update(corrected=d["corrected"].replace(r"1\pm", "1-"))),
    "nothing is printed": ("2.2-F", lambda d: d.update(printed=",")),
    "nothing is corrected": ("2.5", lambda d: d.update(corrected="\\")),
    "K = K is corrected": ("2.5", lambda d: d.update(corrected="K = K")),
    "F = F is printed": ("2.2-F", lambda d: d.update(printed=r"F = F \equiv F")),
    "an equation in words": ("2.5", lambda d: d.update(corrected=d["corrected"] + r",\ K = 3\omega\text{ then}")),
    "what is printed is right, with a word": ("2.5", lambda d: d.update(printed=d["corrected"] + r",\ \text{so}")),
    "what vanishes is the formula": ("2.2-F", vanishing),
    "false by a sentence": ("2.2-F", false_sentence),
    "settled by nothing": ("2.2-F", lambda d: d.update(verdict="settled", uses=[], rests=[])),
    "a wedge with a matrix": ("2.12", with_part(r"\Gamma\wedge\omega^T = -(\Gamma\omega+\omega\Gamma)")),
    "a root of words": ("2.12", with_part(r"\sqrt{2} = 2")),
    "traces for matrices": ("2.10", traced),
    "the velocity at the contact is not 0": ("2.1", lambda d: d["counterexamples"][0]["point"].update(v1=2)),
}  # fmt: skip
