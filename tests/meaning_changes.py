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
