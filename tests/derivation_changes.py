"""Small certificates with a derivation: each operation at work, and each thing that it must refuse."""

from fractions import Fraction
from functools import cache

from certificate_changes import resealed

from chapsym.checker import Rejected, derivation
from chapsym.checker.algebra import Algebra
from chapsym.checker.matrices import quotients
from chapsym.checker.polynomial import FIELD, Quotient, Ring, Work

#: A and B are transposes and inverses of one another, S is skew, C symmetric, X and N any matrices, P a projection.
LETTERS = {
    "kind": "words",
    "letters": ["A", "B", "S", "C", "X", "Y", "P", "N"],
    "parameters": ["m"],
    "transposes": [["A", "B"], ["B", "A"], ["S", ["*", -1, "S"]], ["C", "C"], ["X", "Y"], ["Y", "X"]],
    "rules": [["A", "B", 1], ["B", "A", 1], ["P", "P", "P"]],
}
POINT = {
    "m": 2, "A": [[0, 1], [-1, 0]], "B": [[0, -1], [1, 0]], "S": [[0, 3], [-3, 0]], "C": [[1, 0], [0, 2]],
    "X": [[1, 2], [3, 4]], "Y": [[1, 3], [2, 4]], "P": [[1, 0], [0, 0]],
    "N": [[1, 5], [0, 0]],
}  # fmt: skip
#: With fewer letters and no rules; and with another rule.
FREE = LETTERS | {"letters": ["A", "B", "S"], "transposes": LETTERS["transposes"][:3], "rules": []}
OTHER = LETTERS | {"rules": [["A", "B", 1], ["B", "A", 1], ["P", "P", 0]]}
CIRCLE = {"kind": "quotient", "variables": ["c", "s"], "relations": [["+", ["^", "c", 2], ["^", "s", 2], -1]]}
UNIT = {"c": "3/5", "s": "4/5"}
TURN = [["c", ["*", -1, "s"]], ["s", "c"]]
BACK = [["c", "s"], [["*", -1, "s"], "c"]]
ON_CIRCLE = [[[1], [0], [0], [1]]] * 2
KEPT = {"A": ["*", "A", "S"], "B": ["*", -1, "S", "B"], "S": 0}


def step(name, operation, of, by=(), algebra=0):
    return {"name": name, "text": "x", "algebra": algebra, "operation": operation, "of": of, "by": by or []}


def valued(steps, algebras):
    """The steps with their values, where they can be taken; else with 0."""
    found = []
    for one in steps:
        if one["operation"] != "matrix" and "value" not in one:
            one = one | {"value": _value([*found, one], algebras)}
        found.append(one)
    return found


def _value(steps, algebras):
    try:
        arithmetics = [
            quotients(one, Ring(one["variables"], Work())) if one["kind"] == "quotient" else Algebra(one, Work())
            for one in algebras
        ]
        of = derivation.values(steps, arithmetics)[steps[-1]["name"]]
    except (Rejected, LookupError, TypeError, ValueError):
        return 0
    if isinstance(of.value, Quotient):
        assert not of.value.factors
        scale = Fraction(1, of.value.scale)
        terms = [
            ([m >> FIELD * i & 0xFFFF for i in range(99)], (), c * scale) for m, c in of.value.numerator.terms.items()
        ]
        names = of.algebra.ring.variables
    else:
        terms, names = [(*term, Fraction(c)) for term, c in of.value.terms.items()], of.algebra.parameters
    parts = []
    for exponents, word, c in terms:
        number = c.numerator if c.denominator == 1 else str(c)
        powers = [["^", x, e] for x, e in zip(names, exponents, strict=False) if e]
        parts.append(_joined("*", [number, *powers, *word]))
    return _joined("+", parts) if parts else 0


def _joined(operation, parts):
    return [operation, *parts] if len(parts) > 1 else parts[0]


def made(steps, left, right, kind="words", at=0, more=(), **changes):
    """That left = right, about what some steps define; the algebras are LETTERS, its traces, and `more`."""
    one = {"role": "lemma", "text": "x", "algebra": {"words": 0, "traces": 1}.get(kind, kind)}
    one |= {"left": [left], "right": [right], "point": at} | changes
    algebras = [LETTERS, LETTERS | {"kind": "traces"}, *more]
    return resealed({
        "format": "chapsym-certificate/1", "kind": "register-claim", "claim": "0", "verdict": "open",
        "printed": "x", "corrected": None, "glossary": [], "uses": [],
        "hypotheses": [], "comparisons": [], "counts": [], "derivation": valued(steps, algebras),
        "algebras": algebras,
        "points": [POINT, UNIT, {"m": 1, "U": [[0, 1], [-1, 0]]}, POINT | {"P": [[0, 0], [0, 0]]}],
        "statements": [one], "counterexamples": [], "zeros": [], "rests": [],
        "sentences": [], "statement": "",
    })  # fmt: skip


def pairs(**by):
    return [list(pair) for pair in by.items()]


def in_coordinates(places, cofactors=ON_CIRCLE, of="A", row=1, column=0, value="s"):
    """An entry of a word at matrices on the circle."""
    steps = [
        step("Z", "written", of),
        step("Q", "matrix", "Z", [pairs(**places), cofactors], 2),
        step("q", "entry", "Q", [row, column], 2),
    ]
    return made(steps, "q", value, 2, 1, [CIRCLE], cofactors=[[0]])


@cache
def derivations():
    """Certificates by hand: those that are right, and those that are not, by name."""
    product = [step("Z", "written", ["*", "A", "X"])]
    turned = [step("Z", "written", ["*", "A", "A"]), step("V", "rate", "Z", pairs(**KEPT))]
    rate = ["+", ["*", "A", "S", "A"], ["*", "A", "A", "S"]]
    form = step("Z", "written", ["*", "S", "C", "X"])
    dual = ["+", ["*", "C", "X"], ["*", -1, "Y", "C"]]
    varied = step("Z", "written", ["+", ["*", "C", "X", "A"], ["*", 3, "Y", "C"], "S"])
    slope = ["+", ["*", "C", "B"], ["*", 3, "C"]]
    moved = pairs(X=["*", "X", "P"], Y=["*", "Q", "Y"])
    two = step("Z", "written", ["+", ["*", "m", "X", "C"], "A"])
    fewer = [step("Z", "written", ["*", "S", "A"], algebra=2), step("V", "replaced", "Z", pairs(S=["*", 2, "S"]), 0)]

    def replacing(of, right, **by):
        return made([step("Z", "written", of), step("V", "replaced", "Z", pairs(**by))], "V", right)

    right = {
        "what is written": made(product, ["*", "B", "Z"], "X"),
        "a premise by the rules": made([step("Z", "written", ["*", "A", "B", "X"])], "Z", "X"),
        "its value": made([product[0] | {"value": ["*", "A", "X"]}], "Z", ["*", "A", "X"]),
        "the value of an entry": made(
            [step("Z", "written", "A"), step("Q", "matrix", "Z", [pairs(A=TURN, B=BACK), ON_CIRCLE], 2),
             step("q", "entry", "Q", [1, 0], 2) | {"value": "s"}], "q", "s", 2, 1, [CIRCLE], cofactors=[[0]]),
        "a matrix divided by a number": made(
            [step("Z", "written", ["*", ["^", "m", -1], "A"]),
             step("Q", "matrix", "Z", [pairs(A=TURN, B=BACK, m=2), ON_CIRCLE], 2), step("q", "entry", "Q", [1, 0], 2)],
            "q", ["*", "1/2", "s"], 2, 1, [CIRCLE], cofactors=[[0]]),
        "a name in another": made([*product, step("V", "written", ["*", "B", "Z"])], "V", "X"),
        "a rate": made(turned, "V", rate),
        "a rate of a power": made(
            [step("Z", "written", ["*", "m", "A", "A", "A"]), step("V", "rate", "Z", pairs(**KEPT))], ["*", "V", "B"],
            ["*", "m", ["+", ["*", "A", "S", "A"], ["*", "A", "A", "S"], ["*", "A", "A", "A", "S", "B"]]]),
        "a dual": made([form, step("V", "dual", "Z", "S")], "V", dual),
        "a dual of what is inside": made([step("Z", "written", ["*", "X", "S", "C"]), step("V", "dual", "Z", "S")],
                                         "V", ["+", ["*", "C", "X"], ["*", -1, "Y", "C"]]),
        "a gradient": made([varied, step("V", "gradient", "Z", "X")], "V", slope),
        "what a gradient leaves": made([step("Z", "written", "S"), step("V", "gradient", "Z", "X")], "V", 0),
        "having": made([two, step("V", "having", "Z", ["X", "P"])], "V", ["*", "m", "X", "C"]),
        "lacking": made([two, step("V", "lacking", "Z", ["X", "P"])], "V", "A"),
        "replaced": replacing(["*", "A", "X", "A"], ["*", "m", "X", ["*", "C", "A"]],
                              A="A", X=["*", "m", "B", "X", "C"], Y=["*", "m", "C", "Y", "A"]),
        "a parameter replaced": replacing(["*", ["^", "m", -2], "X"], ["*", "1/9", ["^", "m", 2], "X"],
                                          m=["*", 3, ["^", "m", -1]]),
        "a letter by 1": replacing(["*", "A", "X", "B"], "X", A=1, B=1),
        "from fewer letters": made(fewer, "V", ["*", 2, "S", "A"], more=[FREE]),
        "in the algebra of more rules": made([step("Z", "written", ["*", "A", "B"], algebra=2)], "Z", 1, more=[FREE]),
        "Z = X is refuted": contradicting(product, POINT),
        "0 for a number": replacing(["+", "A", ["*", "m", "X"]], "A", m=0),
        "a power": made([], ["^", "X", 3], ["*", "X", "X", "X"]),
        "tr AX = tr XA": made([], ["*", "A", "X"], ["*", "X", "A"], "traces"),
        "tr AXB = tr X": made([], ["*", "A", "X", "B"], "X", "traces"),
        "tr AXPB = tr XP, twice round": made([], ["*", "P", "A", "X", "B", "P"], ["*", "A", "X", "B", "P"], "traces"),
        "tr XC = tr CY": made([], ["*", "X", "C"], ["*", "C", "Y"], "traces"),
        "tr S = 0": made([], "S", 0, "traces"),
        "tr mSC = 0": made([], ["*", "m", "S", "C"], 0, "traces"),
        "tr 3SX = -3 tr SY": made([], ["*", 3, "S", "X"], ["*", -3, "S", "Y"], "traces"),
        "the trace of what is defined": made(product, "Z", ["*", "X", "A"], "traces"),
        "an entry": in_coordinates({"A": TURN, "B": BACK}),
        "an entry of a sum": in_coordinates(
            {"A": TURN, "B": BACK, "m": "s"}, of=["+", ["*", "m", "A", "A"], ["*", 3, "B"]], row=0,
            value=["+", ["*", "s", ["+", ["^", "c", 2], ["*", -1, ["^", "s", 2]]]], ["*", 3, "c"]],
        ),
        "an entry with a number": in_coordinates({"A": TURN, "B": BACK}, of=["+", "A", 5], row=1, column=1,
                                                 value=["+", "c", 5]),
        "an entry of what is not square": in_coordinates({"X": [["c", "s"]], "Y": [["c"], ["s"]]}, [], of="X", row=0,
                                                         column=1),
        "a symmetric matrix": in_coordinates({"C": [["c", "s"], ["s", 1]]}, [], of="C"),
        "five rows": in_coordinates({"C": [[int(i == j) for j in range(5)] for i in range(5)]}, [], of="C", row=4,
                                    column=4, value=1),
    }  # fmt: skip
    return right, {
        "what is not written": made(product, "Z", ["*", "X", "A"]),
        "written and made by something": made([step("Z", "written", "A", ["A"])], "Z", "A"),
        "a name that is taken": made([step("A", "written", "B")], "A", "A"),
        "a name that is taken twice": made([*product, *product], "Z", "Z"),
        "a name before it is defined": made([step("V", "written", "Z"), *product], "V", "V"),
        "an algebra that is not there": made([step("Z", "written", "A", algebra=2)], "A", "A"),
        "an operation on what is not defined": made([step("Z", "dual", "S", "S")], "A", "A"),
        "too many definitions": made([step(f"Z{i}", "written", "A") for i in range(101)], "A", "A"),
        "a rate of half of the letters": made([*turned[:1], step("V", "rate", "Z", pairs(A=KEPT["A"]))], "V", rate),
        "a rate without one that is needed": made([*product, step("V", "rate", "Z", pairs(**KEPT))], "V", "V"),
        "a rate that breaks a rule": made([*turned[:1], step("V", "rate", "Z", pairs(A="A", B="B"))],
                                          "V", ["*", 2, "A", "A"]),
        "a rate that breaks a transpose": made(
            [step("Z", "written", "X"), step("V", "rate", "Z", pairs(X="C", Y="P"))], "V", "C"),
        "a rate of a projection": made([step("Z", "written", "P"), step("V", "rate", "Z", pairs(P="C"))], "V", "C"),
        "a rate in another algebra": made([*turned[:1], step("V", "rate", "Z", pairs(**KEPT), 2)], "V", rate,
                                          more=[LETTERS]),
        "a rate of another sign": made(turned, "V", ["+", rate[1], ["*", -1, *rate[2][1:]]]),
        "a rate of nothing": made([*turned[:1], step("V", "rate", "Z")], "V", 0),
        "a rate of a number, which is not one of a letter": made(
            [step("Z", "written", ["*", "m", "S"]), step("V", "rate", "Z", pairs(m=1, S=0))], "V", 0),
        "having a number": made([two, step("V", "having", "Z", ["m"])], "V", 0),
        "a number that is a matrix elsewhere": made(
            [step("Z", "written", ["+", ["*", "S", "X"], ["*", -1, "X", "S"]], algebra=2)], "Z", 0,
            more=[LETTERS | {"letters": ["X"], "parameters": ["S"], "transposes": [], "rules": []}]),
        "rules that no matrix has": made(
            [step("Z", "written", ["*", "X", "U"], algebra=2)], 1, 1,
            more=[LETTERS | {"letters": ["X", "U"], "transposes": [], "rules": [["U", "U", 0], ["U", "U1", 1]]}]),
        "an algebra without a point": made(
            [step("Z", "written", ["*", "X", "W"], algebra=2), step("V", "replaced", "Z", pairs(W=1), 0)], "V", "X",
            more=[LETTERS | {"letters": ["X", "W"], "transposes": [], "rules": [["W", "W", 0]]}]),
        "a definition that is not used": made(product, "A", "A"),
        "another value": made([product[0] | {"value": ["*", "X", "A"]}], "Z", ["*", "A", "X"]),
        "a value by a name": made([*product, step("V", "written", "Z") | {"value": "Z"}], "V", "Z"),
        "another value of an entry": made(
            [step("Z", "written", "A"), step("Q", "matrix", "Z", [pairs(A=TURN, B=BACK), ON_CIRCLE], 2),
             step("q", "entry", "Q", [1, 0], 2) | {"value": "c"}], "q", "s", 2, 1, [CIRCLE], cofactors=[[0]]),
        "a name that looks like a power": made(
            [step("A^2", "written", "A")], "A^2", "A"),
        "a rate of a parameter": made([*turned[:1], step("V", "rate", "Z", pairs(**KEPT, Q=1))], "V", rate),
        "a rate twice": made([*turned[:1], step("V", "rate", "Z", [*pairs(**KEPT), ["A", KEPT["A"]]])], "V", rate),
        "a rate of three": made([*turned[:1], step("V", "rate", "Z", [["A", "A", "A"]])], "V", rate),
        "a dual by what is not skew": made([step("Z", "written", ["*", "C", "X"]), step("V", "dual", "Z", "C")],
                                           "V", ["+", "X", ["*", -1, "Y"]]),
        "a dual by what is not there": made([form, step("V", "dual", "Z", "Q")], "A", "A"),
        "a dual of what has it twice": made([step("Z", "written", ["*", "S", "S"]), step("V", "dual", "Z", "S")], 0, 0),
        "a dual of what has it not": made([step("Z", "written", "C"), step("V", "dual", "Z", "S")], "V", 0),
        "a dual turned round": made([form, step("V", "dual", "Z", "S")], "V",
                                    ["+", ["*", "X", "C"], ["*", -1, "C", "Y"]]),
        "a dual without transposes": made([step("Z", "written", ["*", "S", "P"]), step("V", "dual", "Z", "S")],
                                          "V", "V"),
        "a gradient of both": made([step("Z", "written", ["*", "X", "Y"]), step("V", "gradient", "Z", "X")], "V", "V"),
        "a gradient by a skew letter": made([form, step("V", "gradient", "Z", "S")], "V", "V"),
        "a gradient turned round": made([varied, step("V", "gradient", "Z", "X")], "V",
                                        ["+", ["*", "B", "C"], slope[2]]),
        "having nothing": made([two, step("V", "having", "Z", [])], "V", 0),
        "lacking in another algebra": made([two, step("V", "lacking", "Z", ["X"], 2)], "V", "A", more=[LETTERS]),
        "replaced against a rule": replacing("A", "X", A="X", B="Y"),
        "replaced against a transpose": replacing("X", "C", X="C", Y="P"),
        "half replaced": replacing("X", "C", X="C"),
        "replaced by a name that is none": replacing("X", "X", X="Q", Y="Q"),
        "a matrix for a number": replacing(["*", "m", "X"], ["*", "C", "X"], m="C"),
        "replaced what is not there": replacing("X", "X", Q="X"),
        "a letter that is not there": made(
            [step("Z", "written", "X"), step("V", "replaced", "Z", pairs(A="A", B="B"), 2)], "S", "S", more=[FREE]),
        "a rule that is lost": made(
            [step("Z", "written", ["*", "A", "B", "S"]), step("V", "replaced", "Z", pairs(S="S"), 2)], "V", "S", 2,
            more=[FREE]),
        "used where a rule is another": made([step("Z", "written", ["*", "P", "P"], algebra=2)], "Z", 0, more=[OTHER]),
        "used where a rule is another, which the point obeys": made(
            [step("Z", "written", ["*", "P", "P"], algebra=2)], "Z", 0, at=3, more=[OTHER]),
        "replaced against a projection": replacing("P", "C", P="C"),
        "moved by what is not there": made([step("Z", "written", "X"), step("V", "replaced", "Z", moved)], "V", "V"),
        "tr AB = 1": made([], ["*", "A", "B"], 1, "traces"),
        "tr ACX = tr CAX": made([], ["*", "A", "C", "X"], ["*", "C", "A", "X"], "traces"),
        "tr ACX = tr AYC": made([], ["*", "A", "C", "X"], ["*", "A", "Y", "C"], "traces"),
        "tr P = tr of its transpose, which is not given": made([], "P", ["*", -1, "P"], "traces"),
        "tr P = tr N, which is so at the point": made([], "P", "N", "traces"),
        "tr U = 0 for a U that is skew at the point": made(
            [], "U", 0, 2, more=[LETTERS | {"kind": "traces", "letters": ["U"], "rules": [],
                                            "transposes": [["U", ["*", -1, "m", "U"]]]}], at=2),
        "a gradient by a letter whose transpose is 0": made(
            [step("Z", "written", "U", algebra=2), step("V", "gradient", "Z", "U", 2)], "V", 1, 2, 2,
            [LETTERS | {"letters": ["U"], "rules": [], "transposes": [["U", 0]]}]),
        "tr SX = tr SY": made([], ["*", "S", "X"], ["*", "S", "Y"], "traces"),
        "AX = XA": made([], ["*", "A", "X"], ["*", "X", "A"]),
        "an entry of another value": in_coordinates({"A": TURN, "B": BACK}, value="c"),
        "an entry that is not there": in_coordinates({"A": TURN, "B": BACK}, row=2),
        "a column that is not there": in_coordinates({"A": TURN, "B": BACK}, row=0, column=2),
        "a transpose that is none": in_coordinates({"A": TURN, "B": TURN}),
        "half of the matrices": in_coordinates({"A": TURN}),
        "no matrix for the word": in_coordinates({"A": TURN, "B": BACK}, of="X"),
        "no number for the parameter": in_coordinates({"A": TURN, "B": BACK}, of=["*", "m", "A"]),
        "cofactors that prove nothing": in_coordinates({"A": TURN, "B": BACK}, [[[[0]]] * 4] * 2),
        "no cofactors": in_coordinates({"A": TURN, "B": BACK}, []),
        "cofactors of three entries": in_coordinates({"A": TURN, "B": BACK}, [rule[:3] for rule in ON_CIRCLE]),
        "cofactors of two relations": in_coordinates({"A": TURN, "B": BACK}, [[[1, 1]] * 4] * 2),
        "cofactors with a pole": in_coordinates({"A": TURN, "B": BACK}, [[[["^", "c", -1]]] * 4] * 2),
        "a matrix of no turn": in_coordinates({"A": [[1, "s"], [0, 1]], "B": [[1, 0], ["s", 1]]}, row=0, column=1),
        "a matrix with a name that is none": in_coordinates({"A": [["z"]], "B": [["z"]]}),
        "rows of two lengths": in_coordinates({"C": [["c", "s"], ["s"]]}, [], of="C"),
        "a number for a matrix": in_coordinates({"A": "c", "B": "c"}),
        "a matrix for the parameter": in_coordinates({"A": TURN, "B": BACK, "m": [["c"]]}),
        "a place of what is not there": in_coordinates({"A": TURN, "B": BACK, "Q": TURN}),
        "a matrix that is not symmetric": in_coordinates({"C": TURN}, [], of="C"),
        "sizes that do not fit": in_coordinates({"X": [["c", "s"]], "Y": [["c"], ["s"]]}, [], of=["*", "X", "X"],
                                                row=0),
        "a sum of two sizes": in_coordinates({"X": [["c", "s"]], "Y": [["c"], ["s"]], "C": [["s"]]}, [],
                                             of=["+", "X", "C"], row=0, column=1),
        "no word": in_coordinates({"A": TURN, "B": BACK}, of=0),
        "an entry of words": made([*product, step("q", "entry", "Z", [0, 0], 2)], "A", "A", more=[CIRCLE]),
        "an entry in another ring": made(
            [step("Z", "written", "A"), step("Q", "matrix", "Z", [pairs(A=TURN, B=BACK), ON_CIRCLE], 2),
             step("q", "entry", "Q", [1, 0], 3)], "q", "s", 3, 1, [CIRCLE, CIRCLE], cofactors=[[0]]),
        "an entry used in another ring": made(
            [step("Z", "written", "A"), step("Q", "matrix", "Z", [pairs(A=TURN, B=BACK), ON_CIRCLE], 2),
             step("q", "entry", "Q", [1, 0], 2)], "q", "s", 3, 1, [CIRCLE, CIRCLE], cofactors=[[0]]),
        "an entry of three numbers": made(
            [step("Z", "written", "A"), step("Q", "matrix", "Z", [pairs(A=TURN, B=BACK), ON_CIRCLE], 2),
             step("q", "entry", "Q", [1, 0, 0], 2)], "q", "s", 2, 1, [CIRCLE], cofactors=[[0]]),
        "a name of words in a quotient ring": made(product, "Z", "Z", 2, 1, [CIRCLE], cofactors=[[0]]),
        "a local name that the derivation has": made(
            product, "Z", "c", 2, 1, [CIRCLE], cofactors=[[0]], definitions=[["Z", "c"]]),
        "a value for what the derivation makes": hidden(made(product, "Z", ["*", "A", "X"]), "Z"),
        "a value at a counterexample for what the derivation makes": contradicting(product, POINT | {"Z": [[0]]}),
        "a matrix in a hypothesis": contradicting(
            [*product, step("Q", "matrix", "Z", [pairs(A=TURN, B=BACK, X=TURN, Y=BACK), ON_CIRCLE], 2)], POINT, "Q"),
        "an unknown that the derivation makes": hiding_unknown(),
        "a local name of a zero that the derivation makes": hiding_local_name(made(product, "Z", ["*", "A", "X"])),
        "0 for a number that was divided by": replacing(["*", "m", ["^", "m", -1], "A"], "A", m=0),
        "0 for one that was divided by in the place of another": made(
            [step("Z", "written", ["*", "m", ["^", "m", -1], "A"]), step("V", "replaced", "Z", pairs(m=["^", "m", 2])),
             step("T", "replaced", "V", pairs(m=0))], "T", "A"),
        "0 for one that was divided by in another algebra": made(
            [step("Z", "written", ["*", "m", ["^", "m", -1], "A"], algebra=2), step("V", "written", "Z"),
             step("T", "replaced", "V", pairs(m=0))], "T", "A", more=[FREE | {"parameters": ["m"]}]),
        "a coordinate 0 for what was divided by": in_coordinates(
            {"A": TURN, "B": BACK, "m": 0}, of=["*", "m", ["^", "m", -1], "A"]),
        "a power of a power of a number": made(
            [step("Z", "written", ["*", ["^", "m", 60], "A"]), step("V", "replaced", "Z", pairs(m=["^", "m", 60]))],
            "V", "V"),
    }  # fmt: skip


def contradicting(steps, point, zero=0):
    """Z = X is refuted at a point, where something is 0."""
    one = {"role": "printed", "text": "x", "algebra": 0, "left": ["Z"], "right": ["X"], "refuted": 0}
    hypothesis = {"text": "x", "left": [zero], "right": [0]}
    example = {"point": point, "hypotheses": [hypothesis], "refutes": [0], "agrees": []}
    return resealed(made(steps, "Z", "X", more=[CIRCLE]) | {"statements": [one], "counterexamples": [example]})


def hidden(data, name):
    """With a value for a name at its first point."""
    return resealed(data | {"points": [data["points"][0] | {name: [[0]]}, *data["points"][1:]]})


def hiding_unknown():
    """xw = 0 has two solutions; but 1, if x stands for 3w."""
    words = {"kind": "words", "letters": ["A"], "parameters": ["w"], "transposes": [], "rules": []}
    none = {"kind": "quotient", "variables": [], "relations": []}
    step = {"name": "x", "text": "x", "algebra": 1, "operation": "written", "of": ["*", 3, "w"], "by": []}
    one = {
        "role": "lemma", "text": "x", "algebra": 0, "point": 1, "unknowns": ["x", "w"], "equations": [["*", "x", "w"]],
        "nonzero": [], "chart": [[1, 0], [0, 1]], "combinations": [[1]], "relations": [["=", "complex", 1]],
        "holds": True,
    }  # fmt: skip
    data = made([], "A", "A") | {"algebras": [none, words], "derivation": [step | {"value": step["of"]}]}
    return resealed(data | {"points": [{"A": [[1]], "w": 1}, {}], "statements": [], "counts": [one]})


def hiding_local_name(data):
    """A zero of z = x - 1, where Z is z, too."""
    one = {
        "role": "lemma", "text": "x", "point": 4, "unknowns": ["x"], "definitions": [["Z", ["+", "x", -1]]],
        "equations": ["Z"], "nonzero": [], "radius": "1/100",
    }  # fmt: skip
    return resealed(data | {"points": [*data["points"], {"x": 1}], "zeros": [one]})
