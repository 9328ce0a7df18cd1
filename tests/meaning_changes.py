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


def printed(old, new):
    """Another printed formula: `old` must be in it."""
    return _replaced("printed", old, new)


def corrected(old, new):
    return _replaced("corrected", old, new)


def _replaced(role, old, new):
    def change(data):
        assert old in data[role], (old, data[role])
        data[role] = data[role].replace(old, new, 1)

    return change


def without(part):
    """All that is said of one part, a list of the certificate, but for what has another text."""
    return lambda data: data.update({part: []})


def not_inferred(data):
    data["sentences"] = [one for one in data["sentences"] if one["role"] != "inference"]


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


def false_in_words(data):
    """A sentence says that what is printed is false, for which a part in words is left, and the verdict does not."""
    data["sentences"].append({"role": "printed", "text": "false: x", "words": True})
    data["printed"] += r",\ \text{x}"


def one_expression(data):
    """A statement with one expression on both sides, and an equation that is not it."""
    one = next(one for one in data["statements"] if one["role"] == "printed" and "cofactors" in one)
    twice, none = [["*", 2, "D"]], [[0] * len(one["cofactors"][0])]
    data["statements"].append(one | {"left": twice, "right": twice, "cofactors": none})
    with_part("D + D = 2D")(data)


def left_to_words(data):
    """What is printed is an identity, and all that is decided of it is left to words, of which there are none."""
    for part in ("statements", "comparisons", "counts", "zeros", "rests", "sentences"):
        for one in data[part]:
            if one["role"] == "printed":
                one["words"] = True
    data["printed"] = "D + D = 2D"


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
    "printed and corrected are exchanged": ("5.11", swapped),
    "what is printed is right": ("prop-4", lambda d: d.update(printed=d["corrected"])),
    "the verdict is holds": ("prop-4", lambda d: d.update(verdict="holds")),
    "the verdict is refuted": ("2.5", lambda d: d.update(verdict="refuted")),
    "no correction": ("2.5", lambda d: d.update(corrected=None)),
    "a correction of what holds": ("4.10", lambda d: d.update(corrected=d["printed"])),
    "a power in a long formula": ("5.16", lambda d: d.update(corrected=d["corrected"].replace("^4", "^2", 1))),
    "a transpose": ("4.7", lambda d: d.update(printed=d["printed"].replace(r"\Omega_{k-1}^T M", r"\Omega_{k-1} M"))),
    "the order of a product": ("remark-3", lambda d: d.update(printed=d["printed"].replace(r"\Omega_{k-1}(J", r"(J"))),
    "a root without its other sign": ("5.12-q0", lambda d: d.update(corrected=d["corrected"].replace(r"\pm", "+"))),
    "the value of a symbol": ("2.5", value_of(r"\omega", lambda v: [["*", -1, x] for x in v])),
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
    "one expression on both sides": ("2.2-F", one_expression),
    "all is left to words": ("2.5", left_to_words),
    "false by a sentence that a part in words says": ("2.2-F", false_in_words),
    "settled by nothing": ("2.2-F", lambda d: d.update(verdict="settled", uses=[], rests=[])),
    "a wedge with a matrix": ("2.12", with_part(r"\Gamma\wedge\omega^T = -(\Gamma\omega+\omega\Gamma)")),
    "a root of words": ("2.12", with_part(r"\sqrt{2} = 2")),
    "traces for matrices": ("2.10", traced),
    "the velocity at the contact is not 0": ("2.1", lambda d: d["counterexamples"][0]["point"].update(v1=2)),
}  # fmt: skip

FORGED |= {
    # Several parts: each is decided, each that is decided is there, none twice.
    "a part is dropped": ("2.3", printed(r",\ \dot\gamma = \gamma\times\omega", "")),
    "a part is dropped with a word left": ("2.7-integrals", printed(r"\langle\omega,\Lambda\omega\rangle = l,\ ", "")),
    "a part in place of another": ("2.3", printed(r"\dot\gamma = \gamma\times\omega", r"\dot K = K\times\omega")),
    "a part is dropped, with words": ("4.13-limit", printed(r"\mathcal K/\varepsilon \to \mathbf K,\ ", "")),
    "an equation is dropped, with words": ("2.9", printed(r"v_C + \rho\,\omega\gamma = 0,\ ", "")),
    "what is said in words, too": ("2.4", lambda d: d["statements"][0].update(words=True)),
    "more in words than there are": ("prop-4", lambda d: [one.update(words=True) for one in d["statements"]]),
    "one more part that says the same": ("2.3", with_part(r"K\times\omega = \dot K")),
    "an identity twice": ("2.12", with_part(r"\dot\Gamma + [\omega, \Gamma] = 0")),
    "a part twice": ("2.3", lambda d: d.update(printed=d["printed"] + ", " + d["printed"])),
    "a part with a factor": ("2.7-vertical", printed(r"\langle\omega,\gamma\rangle = \tfrac lh", r"2K = 2h\gamma")),
    "a number for a matrix": ("2.15", value_of("H", lambda v: v["trace"])),
    "a trace of numbers": ("5.8", value_of("l", lambda v: {"trace": v})),
    "what vanishes is a trace": ("2.11", value_of("0", lambda v: {"trace": v})),
    "a value of another form": ("2.15", value_of("H", lambda v: {"trace": v["trace"], "D": 1})),
    "a part for one of four": ("4.14", printed(r"M_k = J\Omega_{k-1}-\Omega_{k-1}^TJ", r"M_k = \Omega_kJ-J\Omega_k^T")),
    "a part that was not decided": ("4.14", with_part(r"M_k = M_{k-1}")),
    "a part that was not decided, in words only": ("prop-3", printed("= l", r"= l,\ \Lambda\gamma = 0")),
    "parts side by side": ("5.7", printed(r"= 1,\ ", r"= 1\ ")),
    "a wide space in brackets": ("2.3", printed(r"K\times\omega", r"(K\qquad\times\omega)")),
    "what is corrected lacks a part": (
        "prop-4",
        lambda d: d.update(corrected=d["corrected"].rpartition(r",\ \text")[0].rpartition(r",\ \sigma")[0]),
    ),
    # A matrix by its entries.
    "entries exchanged": ("5.1", printed("2(q_1q_2-q_3q_0) & 2(q_1q_3+q_2q_0)", "2(q_1q_3+q_2q_0) & 2(q_1q_2-q_3q_0)")),
    "a row is missing": ("5.1", printed(r"2(q_2q_3-q_0q_1)\\", "2(q_2q_3-q_0q_1) & ")),
    "a matrix without its end": ("5.1", printed(r"\end{pmatrix}", "")),
    "another entry": ("5.1", corrected("_{32}", "_{23}")),
    # Relations between numbers.
    "another bound": ("5.3-at-most-4", printed(r"\le4", r"\le3")),
    "a bound that is not reached": ("5.3-at-most-4", printed(r"\le4", "<4")),
    "a bound as an equation": ("5.3-at-least-2", printed(r"\ge2", "=2")),
    "less for different": ("5.3-energy", printed(r"\ne", "<")),
    "the same number twice": ("5.3-energy", printed("E_{k+1}", "E_k")),
    "of one point for all without a word": ("5.3-energy", not_inferred),
    "another number in the glossary": ("5.3-energy", value_of("E_k", lambda v: ["+", v, 1])),
    # What something tends to.
    "a limit of an expression": ("4.13-limit", printed(r"\mathcal K/\varepsilon \to", r"2\mathbf K \to 2")),
    "another order": ("5.2-expansion", printed(r"O(\varepsilon^3)", r"O(\varepsilon^2)")),
    "ω for εω": ("4.9-limit", corrected(r"\varepsilon\omega", r"\omega")),
    "εω as printed": ("4.9-limit", printed(r"+ \omega", r"+ \varepsilon\omega")),
    # Roots.
    "a negative root": ("5.8", printed(r"C_1 = ", r"-C_1 = ")),
    "a root of any number": (
        "5.8",
        lambda d: d.update(hypotheses=[x for x in d["hypotheses"] if "size" not in str(x)]),
    ),
    "a positive root between": ("5.8", printed(r"}},\ C_2", r"}} = -C_1,\ C_2")),
    "another letter for an amplitude": ("5.8", printed("C_2 = ", "C_1 = ")),
    "one sign of a root": ("5.14", corrected(r"\pm", "")),
    # Traces.
    "no trace": ("prop-2", printed(r"\mathrm{tr}\,\mathcal K_k^s = \mathrm{tr}\,", r"\mathcal K_k^s = ")),
    "a product of traces": ("prop-2", printed(r"(\mathcal K_k^s\Gamma_k^l)", r"\mathcal K_k^s\mathrm{tr}\Gamma_k^l")),
    "a trace of a trace": ("prop-2", printed(r"(\mathcal K_k^s\Gamma_k^l)", r"(\mathrm{tr}\mathcal K_k^s\Gamma_k^l)")),
    "a trace squared": ("2.15", printed(r"\mathcal A\omega)", r"\mathcal A\omega)^2")),
    "a symbol that is 0": ("2.15", printed("H = ", "H = 0, H = ")),
    # What vanishes, and what derivations make.
    "another factor of what vanishes": ("2.2", printed(r"\tfrac DF", r"\tfrac{2D}F")),
    "the definition of F": ("2.2", value_of("F", lambda v: ["*", 2, v])),
    "a definition without one of its symbols": ("4.8", printed(r",\ \gamma_k", r",\ \gamma_k + \gamma_k")),
    "all in words": ("prop-3", lambda d: d.update(printed=r"\text{so}")),
}
