"""Certificates of the register that are changed: the cases of the checker's tests, and of its mutants."""

import copy
from functools import cache, partial

from certificate_changes import at, resealed

#: A quotient ring with relations, with and without a counterexample; words, with matrices in the counterexample; both;
#: a number of solutions.
SAMPLES = ("2.5-inverse", "5.4", "prop-4", "4.9-F", "2.11-eliminated", "5.16", "prop-2", "2.7-vertical", "5.9-circle")


def leaves(data, path=()):
    """The places of everything in lists and objects that is neither."""
    if isinstance(data, dict | list):
        for name, part in data.items() if isinstance(data, dict) else enumerate(data):
            yield from leaves(part, (*path, name))
    else:
        yield path


def mathematics(data):
    """The places of the numbers, operations and names of what is proved, and of what proves it."""
    for i, one in enumerate(data["statements"]):
        if "refuted" not in one:
            for part in {"left", "right", "cofactors"} & one.keys():
                yield from leaves(one[part], ("statements", i, part))
    for i, one in enumerate(data["counts"]):
        yield from leaves(one["equations"], ("counts", i, "equations"))
        yield from leaves(one["chart"], ("counts", i, "chart"))
        for k in range(len(one["unknowns"]) - 1):  # the others show that something is not 0, as many do
            yield from leaves(one["combinations"][k], ("counts", i, "combinations", k))


def slipped(value, rng):
    """A number, an operation or a name that is changed."""
    if isinstance(value, int):
        return value + rng.choice((-3, -2, -1, 1, 2, 3)) if rng.random() < 0.6 else -value or 1
    if value in ("+", "*"):
        return "+" if value == "*" else "*"
    if "/" in value:
        return value[1:] if value.startswith("-") else f"-{value}"
    return f"{value}x"


def slip(data, rng):
    """A certificate with one thing changed in what is proved or in its proof; and where."""
    data = copy.deepcopy(data)
    *folder, name = path = rng.choice(list(mathematics(data)))
    place = at(data, folder)
    place[name] = slipped(place[name], rng)
    return resealed(data), path


def changed(data, change):
    """A certificate after one of the CHANGES."""
    data = copy.deepcopy(data)
    change(data)
    return resealed(data)


def deep(depth):
    tree = 1
    for _ in range(depth):
        tree = ["+", tree, 1]
    return tree


def put(*path, value):
    def change(data):
        at(data, path[:-1])[path[-1]] = value

    return change


def first(data, kind="quotient", needs="cofactors"):
    """The first statement that has such a proof."""
    return next(one for one in data["statements"] if needs in one and data["algebras"][one["algebra"]]["kind"] == kind)


CHANGES = {
    "all cofactors are 0": (
        "5.4",
        lambda d: [one.update(cofactors=[[0] * len(c) for c in one["cofactors"]])
                   for one in d["statements"] if "cofactors" in one],
    ),
    "a relation is dropped": ("5.4", lambda d: d["algebras"][0]["relations"].pop()),
    "a cofactor is dropped": ("5.4", lambda d: first(d)["cofactors"][0].pop()),
    "a cofactor with a pole": ("5.4", lambda d: first(d)["cofactors"][0].__setitem__(0, ["^", "q0", -1])),
    "a relation with a pole": ("5.4", lambda d: d["algebras"][0]["relations"].__setitem__(0, ["^", "q0", -1])),
    "a point on a pole": ("prop-4", lambda d: [p.update(sigma=0) for p in d["points"]]),
    "a point off the relations": ("5.4", lambda d: [p.update(q0=2) for p in d["points"]]),
    "a point without a value": ("5.4", lambda d: [p.pop("q0") for p in d["points"]]),
    "a matrix for a number": ("5.4", lambda d: [p.update(q0=[[1]]) for p in d["points"]]),
    "a number for a matrix": ("4.9-F", lambda d: [p.update({"R": 1}) for p in d["points"]]),
    "a matrix that is no rotation": ("4.9-F", lambda d: d["points"][0]["R"][0].__setitem__(0, 9)),
    "rows of two lengths": ("4.9-F", lambda d: d["points"][0]["R"][0].append(0)),
    "a rule is dropped": ("prop-2", lambda d: d["algebras"][0]["rules"].clear()),
    "two rules for one product": ("prop-2", lambda d: d["algebras"][0]["rules"].append(d["algebras"][0]["rules"][0])),
    "a rule without end": (
        "prop-2", lambda d: [x.__setitem__(2, ["*", 2, *x[:2]]) for x in d["algebras"][0]["rules"]]
    ),
    "a huge exponent": ("5.4", lambda d: first(d)["left"].__setitem__(0, ["^", "q0", 10**9])),
    "high exponents": (
        "5.4", lambda d: first(d)["left"].__setitem__(0, ["^", ["^", ["^", ["+", "q0", 1], 60], 60], 60])
    ),
    "0 times a huge pole": (
        "5.4",
        lambda d: first(d)["left"].__setitem__(0, ["+", ["*", 0, ["^", ["^", ["^", "q0", -60], 60], 60]], 1]),
    ),
    "a huge number at a point": (
        "5.4", lambda d: d["counterexamples"][0]["hypotheses"][0].update(left=[["^", ["^", ["^", 10, 60], 60], 60]])
    ),
    "a product with too many terms": (
        "5.4",
        lambda d: first(d)["left"].__setitem__(0, ["^", ["+", 1, "q0", "q1", "q2", "q3", "J1", "J2", "J3"], 40]),
    ),
    "a deep tree": ("5.4", lambda d: first(d)["left"].__setitem__(0, deep(300))),
    "a name twice": ("5.4", lambda d: d["algebras"][0]["variables"].append("q0")),
    "a letter that is a parameter": ("prop-2", lambda d: d["algebras"][0]["parameters"].append("Omega")),
    "a number not in lowest terms": ("5.4", lambda d: d["points"][0].update(q0="8/10")),
    "an integer as a quotient": ("5.4", lambda d: d["points"][0].update(J1="1/1")),
    "a power that is 0": ("5.4", lambda d: first(d)["left"].__setitem__(0, ["^", "q0", 0])),
    "a sum of one": ("5.4", lambda d: first(d)["left"].__setitem__(0, ["+", "q0"])),
    "another operation": ("5.4", lambda d: first(d)["left"].__setitem__(0, ["-", "q0", "q1"])),
    "fewer entries on the right": ("5.4", lambda d: first(d)["right"].pop()),
    "no entries": ("5.4", lambda d: first(d).update(left=[], right=[], cofactors=[])),
    "a statement that is refuted is said to be proved": (
        "5.4",
        lambda d: [one.update(point=0, cofactors=first(d)["cofactors"], role="lemma") or one.pop("refuted")
                   for one in d["statements"] if "refuted" in one],
    ),
    "a statement that is proved is said to be refuted": (
        "5.4", lambda d: d["statements"].append({k: v for k, v in first(d).items() if k not in ("point", "cofactors")}
                                                | {"role": "printed", "refuted": 0})
    ),
    "a counterexample to nothing": ("5.4", lambda d: d["counterexamples"][0].update(refutes=[])),
    "a counterexample that refutes what is right": (
        "5.4", lambda d: d["counterexamples"][0].update(refutes=d["counterexamples"][0]["agrees"], agrees=[])
    ),
    "a counterexample that confirms what is wrong": (
        "5.4", lambda d: d["counterexamples"][0].update(agrees=d["counterexamples"][0]["refutes"])
    ),
    "a counterexample off a hypothesis": ("5.4", lambda d: d["counterexamples"][0]["point"].update(h=1)),
    "a counterexample off the relations": ("2.5-inverse", lambda d: d["counterexamples"][0].update(
        hypotheses=[], point=d["counterexamples"][0]["point"] | {"g1": 5})),
    "no claim": ("5.4", lambda d: d.update(claim="a\nb")),
    "a sentence of no role": ("5.4", lambda d: d["sentences"].append({"role": "whim", "text": "x"})),
    "a long list": ("5.4", put("sentences", value=[{"role": "said", "text": "x"}] * 3000)),
    "a million letters": ("5.4", lambda d: d["sentences"].extend([{"role": "said", "text": "x" * 3000}] * 340)),
    "a point of many values": ("5.4", lambda d: d["points"].append({f"x{i}": 1 for i in range(2001)})),
    "a long name": ("5.4", lambda d: d["counterexamples"][0]["point"].update({"x" * 41: 1})),
    "six rows": ("5.4", lambda d: d["counterexamples"][0]["point"].update(x=[[1]] * 6)),
    "six columns": ("5.4", lambda d: d["counterexamples"][0]["point"].update(x=[[1] * 6])),
    "a transpose of a product": ("4.9-F", lambda d: d["algebras"][0]["transposes"].append([["*", "R", "R"], "R"])),
    "a transpose of a parameter": ("4.9-F", lambda d: d["algebras"][0]["transposes"].append(["rho", "rho"])),
    "a rule for unknown letters": ("4.9-F", lambda d: d["algebras"][0]["rules"].append(["Q1", "Q2", 0])),
    "no such algebra": ("5.4", lambda d: d["statements"][0].update(algebra=len(d["algebras"]))),
    "no such point": ("5.4", lambda d: first(d).update(point=len(d["points"]))),
    "no such counterexample": ("5.4", lambda d: first(d, needs="refuted").update(refuted=len(d["counterexamples"]))),
    "no such statement": ("5.4", lambda d: d["counterexamples"][0]["refutes"].append(len(d["statements"]))),
}  # fmt: skip


def resting(*names, claim="0", role="lemma", more=False):
    """A certificate that rests on others; `more`: it says one thing more."""
    rests = [{"role": role, "text": "x", "certificate": name} for name in names]
    compares = [compared(["<", 0, 1])] if more else []
    return resealed(by_hand([], [{"x": 1}], [], [], [], compares) | {"claim": claim, "rests": rests})


def near(equations, unknowns=("x",), radius="1/100", nonzero=(), definitions=(), **point):
    """A solution near a point: of y² = 2 near 7/5, in most."""
    one = {"role": "lemma", "text": "x", "point": 0, "unknowns": [*unknowns], "definitions": [*definitions]}
    one |= {"equations": [*equations], "nonzero": [*nonzero], "radius": radius}
    return resealed(by_hand([], [{"x": "17/12", "a": 2} | point]) | {"zeros": [one]})


ROOT = ["+", ["^", "x", 2], ["*", -1, "a"]]
CIRCLE = [["+", ["^", "x", 2], ["^", "y", 2], -1], ["+", "x", ["*", -1, "y"]]]


def zeros():
    """Solutions that are near a point, and what is none."""
    both, eight = {"unknowns": ("x", "y"), "x": "5/7", "y": "5/7"}, [f"x{i}" for i in range(7)]
    return {
        "x² = 2 near 17/12": near([ROOT]),
        "x² = 2 near 17/12, x ≠ 1": near([ROOT], nonzero=[["+", "x", -1], ["+", "x", "-7/5"]]),
        "-x² = -2": near([["*", -1, ROOT]]),
        "x⁻² = 1/2": near([["+", ["^", "x", -2], "-1/2"]]),
        "x² = 2 by names": near(["z"], definitions=[["y", ["*", "x", "x"]], ["z", ["+", "y", ["*", -1, "a"]]]]),
        "x² + y² = 1, x = y": near(CIRCLE, **both),
        "x = 1/3": near([["+", "x", "-1/3"]], x="1/3", radius="1/1000"),
        "x = 17/12 to the edge": near([["+", "x", "-7/5"]], radius="1/59"),
    }, {
        "x² = 3": near([ROOT], a=3),
        "x² = 2 within 2": near([ROOT], radius=2),
        "x² = 2 within too little": near([ROOT], radius="1/500"),
        "x = 17/12 beyond the edge": near([["+", "x", "-7/5"]], radius="1/60"),
        "x = 17/12 beyond the other edge": near([["+", "x", "-43/30"]], radius="1/60"),
        "x² = 0, twice": near([["^", "x", 2]], x="1/1000"),
        "x² = 2 where x² - 2 is not 0": near([ROOT], nonzero=[["+", "x", -1], ROOT]),
        "x + y = 1 twice": near([CIRCLE[1]] * 2, **both),
        "one equation of two": near(CIRCLE[:1], **both),
        "two equations of one": near(CIRCLE, y="5/7"),
        "no unknown": near([], ()),
        "21 unknowns": near([f"x{i}" for i in range(21)], [f"x{i}" for i in range(21)],
                            **{f"x{i}": 0 for i in range(21)}),
        "an unknown without a value": near([ROOT], ("z",)),
        "an unknown twice": near([ROOT] * 2, ("x", "x")),
        "a matrix at the point": near([ROOT], b=[[1]]),
        "a radius of 0": near([ROOT], radius=0),
        "a radius below 0": near([ROOT], radius="-1/100"),
        "a name that is defined later": near(["z"], definitions=[["z", "y"], ["y", ROOT]]),
        "a variable that is defined": near(["a"], definitions=[["a", ROOT]]),
        "a definition of three": near(["z"], definitions=[["z", ROOT, 1]]),
        "a definition of no name": near(["z"], definitions=[["z", ROOT], [7, 1]]),
        "a pole": near([["+", ROOT, ["*", 0, ["^", ["+", "x", "-17/12"], -1]]]]),
        "a power of powers": near([["+", ROOT, ["*", 0, ["^", ["^", ["^", "x", 60], 60], 60]]]]),
        "powers that are much work": near(
            ["z"], definitions=[["z", ["+", "x", "-17/12", *[["*", 0, ["^", "x", 60]]] * 1000]]], radius=f"1/{2**999}"
        ),
        "too much work": near([["+", "x", "-17/12", *[["*", 0, "x"]] * 19_000]], radius=f"1/{2**999}"),
        "too much work for eight": near([["+", "x", "-17/12", *[0] * 19_000], *eight], ["x", *eight], f"1/{2**999}",
                                        **dict.fromkeys(eight, 0)),
        "no such point": resealed(near([ROOT]) | {"points": []}),
    }  # fmt: skip


def by_hand(statements, points=(), algebras=(), counterexamples=(), hypotheses=(), comparisons=(), counts=()):
    """A certificate with few parts."""
    return resealed({
        "format": "chapsym-certificate/1", "kind": "register-claim", "claim": "0", "verdict": "open",
        "printed": "x", "corrected": None, "glossary": [], "uses": [], "hypotheses": [*hypotheses],
        "algebras": [*algebras], "derivation": [], "points": [*points], "statements": [*statements],
        "comparisons": [*comparisons], "counts": [*counts], "zeros": [],
        "counterexamples": [*counterexamples], "rests": [], "sentences": [], "statement": "",
    })  # fmt: skip


def said(left, right, algebra=0, **more):
    """A printed statement of one entry."""
    return {"role": "printed", "text": "x", "algebra": algebra, "left": [left], "right": [right]} | more


def contradicted(i, point, agrees=(), left=1):
    """A counterexample, with a hypothesis."""
    return {
        "point": point,
        "refutes": [i],
        "agrees": [*agrees],
        "hypotheses": [{"text": "x", "left": [left], "right": [1]}],
    }


FREE = {"kind": "quotient", "variables": ["x"], "relations": []}
ONE = {"kind": "quotient", "variables": ["x"], "relations": [["+", "x", -1]]}
LETTERS = {
    "kind": "words",
    "letters": ["A", "B"],
    "parameters": ["m"],
    "transposes": [["A", "B"]],
    "rules": [["A", "B", 1]],
}
TURN = {"m": 1, "A": [[0, 1], [-1, 0]], "B": [[0, -1], [1, 0]]}


def of_words(left, right, **changes):
    """A statement about two letters, transposes and inverses of one another, and a parameter that is 1 at the point."""
    return by_hand([said(left, right, point=0)], [TURN | changes], [LETTERS])


def compared(*relations, point=0, **more):
    """A comparison at a point."""
    return {"role": "lemma", "text": "x", "point": point, "relations": [*relations]} | more


def assumed(*relations):
    """A hypothesis."""
    return {"text": "x", "relations": [*relations]}


def defined(left, right, *definitions):
    """A statement about x that defines names."""
    return by_hand([said(left, right, point=0, cofactors=[[]], definitions=[*definitions])], [{"x": 1}], [FREE])


SQUARED = [["y", ["+", "x", 1]], ["z", ["*", "y", "y"]]]
#: A statement that holds where x = 2, too, which is not in ONE; and its cofactor.
BY_TWO = ["+", "x", -2]
AWAY = ["*", ["+", "x", -1], BY_TWO], 0
BY_X = ["+", ["^", "x", 2], ["*", 2, "x"], 1]


@cache
def small():
    """Certificates by hand: those that are right, and those that are not, by name."""
    identity, point = said("x", 1, point=0, cofactors=[[1]]), {"x": 1}
    fails, refuted = [["<", "x", 0]], {"role": "printed", "refuted": True}
    wrong = said("x", 2, 1, refuted=0)
    right = {
        "x = 1 where x - 1 = 0": by_hand([identity], [point], [ONE]),
        "(x - 1)(x - 2) = 0 where x - 1 = 0": by_hand([said(*AWAY, cofactors=[[BY_TWO]], point=0)], [point], [ONE]),
        "a question that a claim settles": resealed(by_hand([]) | {"verdict": "settled", "uses": ["1"]}),
        "x = 2 fails at 1": by_hand([identity, wrong], [point], [ONE, FREE], [contradicted(1, point, [0])]),
        "AB = 1": of_words(["*", "A", "B"], 1),
        "mAB/m = AB": of_words(["*", "m", "A", "B", ["^", "m", -1]], ["*", "A", "B"]),
        "(x + 1)² by names": defined("z", BY_X, *SQUARED),
        "0 < x ≤ 1, x = 1, x ≠ 2": by_hand(
            [], [point], [], [], [assumed(["<", 0, "x"])],
            [compared(["<", 0, "x"], ["<=", "x", 1], ["<=", "x", 2], ["=", "x", 1], ["!=", "x", 2])],
        ),
        "it rests on others": resting(f"prop-1 {'0' * 64}", "0" * 64),
        "x < 0 < 1 is printed, and fails": by_hand([], [point], [], [], [], [compared(["<", 0, 1], *fails, **refuted)]),
        "A ≠ B, A = A": by_hand([], [TURN], [], [], [], [compared(["!=", "A", "B"], ["=", "A", "A"])]),
        "x > 0 wherever x is": by_hand([], [point, {"y": 0}], [], [], [assumed(["<", 0, "x"])]),
        "1/(x - 2) = -1/(2 - x)": by_hand(
            [said(["^", ["+", "x", -2], -1], ["*", -1, ["^", ["+", 2, ["*", -1, "x"]], -1]], point=0, cofactors=[[]])],
            [point], [FREE],
        ),
    }  # fmt: skip
    other = partial(said, *AWAY, cofactors=[[BY_TWO]])
    two = [contradicted(0, {"x": 3}), contradicted(1, {"x": 2}, [0])]
    found, lost = zeros()
    holding = by_hand([said(*AWAY, cofactors=[[BY_TWO]], point=0)], [point], [ONE])
    lemma = said(*AWAY, cofactors=[[BY_TWO]], point=0, role="lemma")
    return right | found, lost | {
        "it confirms what is refuted": by_hand(
            [said("x", 2, refuted=0), said("x", 5, refuted=1)], [], [FREE], two
        ),
        "a verdict that is not given": resealed(holding | {"verdict": "refuted"}),
        "a correction that nothing decides": resealed(holding | {"verdict": "holds", "corrected": "x"}),
        "it is what it supposes": resealed(by_hand([identity], [point], [ONE]) | {"verdict": "holds"}),
        "it is what it supposes, with a comparison": resealed(
            by_hand([identity], [point], [ONE], comparisons=[compared(["<", 0, "x"])]) | {"verdict": "holds"}),
        "it is what it supposes, with a lemma": resealed(
            by_hand([identity, lemma], [point], [ONE]) | {"verdict": "holds"}),
        "one expression on both sides, with a lemma": resealed(
            by_hand([said("x", "x", point=0, cofactors=[[0]]), lemma], [point], [ONE]) | {"verdict": "holds"}),
        "a refuted statement at a point": by_hand(
            [identity, wrong | {"point": 0}], [point], [ONE, FREE], [contradicted(1, point, [0])]
        ),
        "it contradicts itself": by_hand(
            [identity, wrong], [point], [ONE, FREE], [contradicted(1, {"x": 3}, [0])]
        ),
        **{f"1 {sign} {x}": by_hand([], [point], [], [], [], [compared(["<=", 0, "x"], [sign, "x", x])])
           for sign, x in (("<", 1), ("<", 0), ("<=", 0), ("=", 2), ("!=", 1))},
        **{f"it rests on {name!r}": resting(name)
           for name in ("a b", "prop-1", "0" * 63, "g" * 64, f"a  {'0' * 64}")},
        "it confirms a statement twice": by_hand([identity, wrong], [point], [ONE, FREE], [
            contradicted(1, {"x": 1}, [0, 0])]),
        "a hypothesis that its counterexample does not have": by_hand(
            [wrong], [{"x": 2, "y": 3}], [FREE, FREE], [contradicted(0, {"x": 3})], [assumed(["<", "x", "y"])]),
        "0 < x is printed, and fails": by_hand([], [point], [], [], [], [compared(["<", 0, "x"], **refuted)]),
        "a lemma that fails": by_hand([], [point], [], [], [], [compared(*fails, refuted=True)]),
        "a comparison that fails": by_hand([], [point], [], [], [], [compared(*fails, role="printed")]),
        **{f"it fails: {x}": by_hand([], [point], [], [], [], [compared(*fails, role="printed", refuted=x)])
           for x in (1, False)},
        "(x + 1)² is not what is named": defined("z", ["+", BY_X, "x"], *SQUARED),
        "a name that is defined later": defined("z", BY_X, *SQUARED[::-1]),
        "a name that is defined twice": defined("z", BY_X, *SQUARED, ["z", BY_X]),
        "a variable that is defined": defined("x", 1, ["x", 1]),
        "a definition of no name": defined("z", BY_X, *SQUARED, [7, "x"]),
        "a definition with a pole": defined("z", BY_X, *SQUARED, ["w", ["^", ["+", "x", -1], -1]]),
        "a name that is not defined": defined("z", BY_X),
        "a name about words": by_hand(
            [said("C", 1, point=0, definitions=[["C", ["*", "A", "B"]]])], [TURN], [LETTERS]
        ),
        "whether a matrix is less than a number": by_hand([], [TURN], [], [], [], [compared(["<=", "A", 1])]),
        "whether a number is less than a matrix": by_hand([], [TURN], [], [], [], [compared(["<=", 1, "A"])]),
        "a comparison on a pole": by_hand([], [point], [], [], [], [compared(["<", ["^", ["+", "x", -1], -1], 9])]),
        "a comparison of nothing": by_hand([], [point], [], [], [], [compared()]),
        "a comparison of three": by_hand([], [point], [], [], [], [compared(["<", 0, 1, 2])]),
        "a comparison with an unknown name": by_hand([], [point], [], [], [], [compared(["=", "y", "y"])]),
        "a comparison at no point": by_hand([], [point], [], [], [], [compared(["<", 0, 1], point=1)]),
        "a hypothesis that is violated": by_hand([], [point, {"x": -1}], [], [], [assumed(["<", 0, "x"])]),
        "a hypothesis that a counterexample violates": by_hand(
            [said("x", 2, refuted=0)], [], [FREE], [contradicted(0, point)], [assumed(["<", "x", 1])]
        ),
        "a hypothesis without test": by_hand(
            [], [{"x": 1}, {"y": 1}], [], [], [assumed(["<", 0, ["+", "x", "y"]])]
        ),
        "a rule that fails": of_words("A", "A", A=[[2]], B=[[2]]),
        "a relation that fails at the second point": by_hand([identity, other(point=1)], [point, {"x": 2}], [ONE]),
        "a relation that fails in the second algebra": by_hand(
            [said("x", "x", point=0, cofactors=[[]]), other(1, point=0)], [{"x": 2}], [FREE, ONE]),
        "no transposes": of_words("A", "A", A=[[1, 1], [0, 1]], B=[[1, -1], [0, 1]]),
        "m = 1": of_words("m", 1),
        "AB = BA": of_words(["*", "A", "B"], ["*", "B", "A"]),
        "a power of four": by_hand(
            [identity, wrong], [point], [ONE, FREE], [contradicted(1, point, [0], ["^", "x", 2, 2])]
        ),
        "a deep truth": by_hand([said(deep(100), deep(100), point=0, cofactors=[[]])], [point], [FREE]),
    }  # fmt: skip
