"""Certificates of kind register-claim: the algebraic statements of one claim, and exact counterexamples.

A statement is a list of equations left = right between trees (trees.py), decided in an algebra:

quotient  variables, and relations: polynomials that vanish by hypothesis.  The checker computes the numerator of
          left - right; it must be Σ cofactor · relation, with the cofactors of the file.  Then left = right wherever
          the relations hold and no denominator vanishes.  A rational point of the file shows that such points exist.
          A statement may define names for frequent subexpressions, each from those before.
words     letters for matrices, parameters for numbers, and rules for the products of two letters.  left - right becomes
          0 by the rules.  Then left = right for all matrices of any size that satisfy the rules.  The file gives
          matrices that satisfy the rules and the transposes of the algebra.
traces    the same, for statements tr left = tr right.

Trees of statements in words and traces may have names of the derivation (derivation.py), which derives their values
from premises.

A comparison states relations <, ≤, = or ≠ between numbers at a point; a printed comparison may be refuted: it fails
there.  A hypothesis states such relations, too; they must hold at every point of the certificate that has values for
their names, and there must be such a point.

A count states such relations between the numbers of solutions of equations (roots.py).  They hold, or they fail if the
count is printed and false.

A zero is a solution of equations that is unique within a distance of a point (zeros.py).

A counterexample is a point, or matrices.  The relations or rules and the hypotheses hold there, the printed statements
that it refutes fail, and the corrected statements with which it agrees hold.  If it has a value for one name of a
hypothesis, it has values for all its names.

A certificate rests on others, by their digests (for a claim, id and digest), and on those of the claims that it uses:
they must be accepted, too.  The glossary (formulas.py) gives a meaning to the printed and the corrected formula: each
equation without words must be a statement of that role (meaning.py).  The verdict must follow from what is decided:
`holds`, if no printed statement fails; `corrected` or `conditional`, if one fails, and a corrected statement holds, or
one under a condition; otherwise `refuted`.  It must be `open` if all printed, or all corrected, statements have one
expression on both sides or are relations of the algebra.  The sentences, the rest of the claim, are not checked.
"""

import json
import re
from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from typing import Any

from . import derivation, meaning, roots, zeros
from .algebra import Algebra, about
from .document import Data
from .form import HEAD, MOST, NUMBER, anything, check_rows, check_shape, names, once, sized, text, within
from .formulas import ROOT
from .interval import Rejected
from .matrices import Quotients, quotients
from .polynomial import Polynomial, Ring, Work
from .trees import Tree, check_known, check_name, check_tree, names_in, rational, size, value
from .words import Matrix, same, trace

#: The id of a claim.
CLAIM = re.compile(r"[\w.-]{1,40}", re.ASCII)
_CERTIFICATE = re.compile(r"([\w.-]{1,40} )?[0-9a-f]{64}", re.ASCII)
VERDICTS = ("holds", "corrected", "conditional", "refuted", "settled", "definition", "open")
ROLES = ("printed", "corrected", "under", "lemma", "second route")
STATED = ("printed", "corrected", "under")
SENTENCES = (*ROLES, "hypothesis", "said", "inference")
#: The most letters of a certificate: five times the largest of the register.
MOST_OF_ALL = 1_000_000
Value = Fraction | Matrix
#: The relations of a comparison.
COMPARED = ("<", "<=", "=", "!=")


def statement(data: Data) -> str:
    """The numbers of checked items of each kind, and of unchecked sentences."""
    proved = [one for one in data["statements"] if "refuted" not in one]
    words = sum(data["algebras"][one["algebra"]]["kind"] != "quotient" for one in proved)
    failing = sum(map(meaning.is_false, said(data)))
    about = [[*one["left"], *one["right"]] for one in proved] + [one["equations"] for one in data["counts"]]
    names = {one["name"] for one in data["derivation"]}
    read, unread = meaning.read(data)
    parts = {
        "parts of its formulas that are read": read,
        "parts in words": unread,
        "identities of numbers": len(proved) - words,
        "identities of matrices": words,
        "of these with one expression on both sides": sum(one["left"] == one["right"] for one in proved),
        "about what derivations make": sum(not names_in([0, *trees]).isdisjoint(names) for trees in about),
        "comparisons at points": sum("refuted" not in one for one in data["comparisons"]),
        "numbers of solutions": sum(one["holds"] for one in data["counts"]),
        "solutions near points": len(data["zeros"]),
        "hypotheses true at every point": len(data["hypotheses"]),
        "printed statements that fail, each at a point": failing,
        "other claims and certificates that it rests on": len(data["uses"]) + len(data["rests"]),
        "sentences not checked": len(data["sentences"]),
        "of these from what is decided to the formula": sum(one["role"] == "inference" for one in data["sentences"]),
    }
    counted = "; ".join(f"{what}: {number}" for what, number in parts.items() if number)
    return f"Claim {data['claim']} ({data['verdict']}).  {counted or 'nothing'}."


class Undecided(Rejected):
    """The statements decide nothing: the only possible verdict is `open`."""


def said(data: Data, *without: str) -> list[Data]:
    """All decided items, except those of some parts."""
    parts = ("statements", "comparisons", "counts", "zeros")
    return [one for name in parts if name not in without for one in data[name]]


def check_verdict(data: Data) -> None:
    """Raises Rejected unless the verdict follows from the decided items and the roles of the sentences."""
    decided = [*said(data), *data["rests"], *data["sentences"]]
    roles = {one["role"] for one in decided}
    false = any(map(meaning.is_false, decided))
    kind = "conditional" if "under" in roles else "corrected" if "corrected" in roles else "refuted"
    given = kind if false else "holds" if roles & {"printed"} else "definition"
    if data["verdict"] not in ("open", given) and (false or data["verdict"] not in ("settled", "definition")):
        raise Rejected(f"the verdict is {data['verdict']!r}, and what is decided gives {given!r}")
    if data["verdict"] == "settled" and not (data["uses"] or data["rests"]):
        raise Rejected("the claims that a question uses do not settle it")
    if data["verdict"] == "open":
        return
    for role in STATED:
        stated = [one for one in decided if one["role"] == role]
        if stated and all("left" in one and one["left"] == one["right"] for one in stated):
            raise Undecided(f"what is {role} has one expression on both sides, so that nothing is decided")
    if (data["corrected"] is not None) != ("corrected" in roles):
        raise Rejected("a correction is given where none is decided, or none where one is")


def check_corrected(data: object, where: str) -> None:
    """Raises Rejected unless this is a text or None."""
    if data is not None:
        text(data, where)


def check_algebra(data: Any, where: str) -> None:
    """Raises Rejected unless this is an algebra, without unknown letters, double rules or double transposes."""
    kind = data.get("kind") if isinstance(data, dict) else None
    check_shape(kind, ("quotient", "words", "traces"), f"the kind of {where}")
    check_shape(data, QUOTIENT if kind == "quotient" else WORDS, where)
    if kind != "quotient":
        names(names_of(data), where)
        about, pairs = [letter for letter, _ in data["transposes"]], [(a, b) for a, b, _ in data["rules"]]
        check_known([*about, *(letter for pair in pairs for letter in pair)], data["letters"], where)
        once(about, where)
        once(pairs, where)


def names_of(algebra: Data) -> list[str]:
    """The names of an algebra."""
    return algebra["variables"] if algebra["kind"] == "quotient" else [*algebra["letters"], *algebra["parameters"]]


def check_point(data: Any, where: str) -> None:
    """Raises Rejected unless names have values: numbers, or matrices as lists of rows of equal length."""
    if not isinstance(data, dict) or len(data) > MOST:
        raise Rejected(f"{where} must be an object of values")
    for name, entry in data.items():
        check_name(name, where)
        if isinstance(entry, list):
            check_rows(entry, rational, where)
        else:
            rational(entry, where)


SAID = {"role": ROLES, "text": text, "words?": bool}
SIDES = {"left": [check_tree, ...], "right": [check_tree, ...]}
DEFINITIONS = [(check_name, check_tree)]
RELATIONS = [(COMPARED, check_tree, check_tree), ...]
QUOTIENT = {"kind": anything, "variables": names, "relations": [check_tree]}
WORDS = {
    "kind": anything, "letters": names, "parameters": names,
    "transposes": [(check_name, check_tree)], "rules": [(check_name, check_name, check_tree)],
}  # fmt: skip
#: The list that an index of an item refers to.
COUNTED = {"algebra": "algebras", "point": "points", "refuted": "counterexamples"}
STATEMENT = SAID | SIDES | {
    "algebra": NUMBER, "definitions?": DEFINITIONS, "refuted?": NUMBER, "point?": NUMBER, "cofactors?": [[check_tree]],
}  # fmt: skip
EQUATIONS = SAID | {"point": NUMBER, "unknowns": names, "equations": [check_tree], "nonzero": [check_tree]}
COUNT = EQUATIONS | {"algebra": NUMBER, "chart": [[rational]], "combinations": [[check_tree]], "relations": RELATIONS}
FORM = HEAD | {
    "claim": CLAIM,
    "verdict": VERDICTS,
    "printed": text,
    "corrected": check_corrected,
    "glossary": [(text, text, anything)],
    "uses": [CLAIM],
    "hypotheses": [{"text": text, "relations": RELATIONS}],
    "algebras": [check_algebra],
    "derivation": [derivation.check_definition],
    "points": [check_point],
    "statements": [STATEMENT],
    "comparisons": [SAID | {"point": NUMBER, "relations": RELATIONS, "refuted?": bool}],
    "counts": [COUNT | {"holds": bool}],
    "zeros": [EQUATIONS | {"definitions": DEFINITIONS, "radius": rational}],
    "counterexamples": [
        {"point": check_point, "hypotheses": [{"text": text} | SIDES], "refutes": [NUMBER], "agrees": [NUMBER]}
    ],
    "rests": [SAID | {"certificate": _CERTIFICATE}],
    "sentences": [{"role": SENTENCES, "text": text, "words?": bool}],
}


def check_form(data: Data) -> None:
    """Raises Rejected unless every part is present, in its form, with known names only."""
    with suppress(RecursionError):  # reported later
        if len(json.dumps(data)) > MOST_OF_ALL:
            raise Rejected(f"the certificate has more than {MOST_OF_ALL} letters")
    check_shape(data, FORM)
    if data["claim"] in data["uses"]:
        raise Rejected("uses must be ids of other claims")
    once(data["uses"], "uses")
    made = {one["name"] for one in data["derivation"]}
    points = [*data["points"], *(one["point"] for one in data["counterexamples"])]
    known = made.union(roots.NUMBERS if data["counts"] else (), *points, *map(names_of, data["algebras"]))
    meaning.check_form(data["glossary"], known)
    if twice := made & set().union(*points):
        raise Rejected(f"a point has a value for {min(twice)}, which the derivation makes")
    check_numbers(data)
    if any(meaning.is_false(one) and (one["role"] != "printed" or one.get("refuted") is False) for one in said(data)):
        raise Rejected("something is refuted that is not printed, or is said not to be refuted")
    for one in equations(data):
        sized(one["right"], len(one["left"]), "the right of what is stated")
    for i, one in enumerate(data["statements"]):
        check_statement(one, data["algebras"][one["algebra"]], made, f"statement {i}")
    for i, one in enumerate(data["counts"]):
        roots.check_form(one, data["algebras"][one["algebra"]], data["points"][one["point"]], made, f"count {i}")
    for i, one in enumerate(data["zeros"]):
        zeros.check_form(one, data["points"][one["point"]], made, f"zero {i}")
    for algebra in data["algebras"]:
        for point in points:
            check_kinds(algebra, point)


def check_numbers(data: Data) -> None:
    """Raises Rejected if an index is out of range, or a counterexample has an index twice."""
    for part in ("derivation", "statements", "comparisons", "counts", "zeros"):
        for i, one in enumerate(data[part]):
            for name, of in COUNTED.items():
                if type(one.get(name)) is int:
                    within(one[name], data[of], f"{name} of {part} {i}")
    for i, one in enumerate(data["counterexamples"]):
        for numbers in (one["refutes"], one["agrees"]):
            once(numbers, f"counterexample {i}")
            for number in numbers:
                within(number, data["statements"], f"counterexample {i}")


def check_statement(one: Data, algebra: Data, made: Collection[str], where: str) -> None:
    """Raises Rejected unless a statement has the keys that its algebra needs, and defines no name twice."""
    proved, quotient = "refuted" not in one, algebra["kind"] == "quotient"
    if ("point" in one) is not proved or ("cofactors" in one) is not (proved and quotient):
        raise Rejected(f"{where} must have a point, and cofactors in a quotient, just where it is proved")
    if "definitions" in one and not quotient:
        raise Rejected(f"{where} has definitions, and is not one of a quotient")
    own = [name for name, _ in one.get("definitions", ())]
    once([*own, *{*made, *names_of(algebra)}], f"{where}, which defines what has a meaning,")


def check_kinds(algebra: Data, point: Data) -> None:
    """Raises Rejected if a letter of an algebra is a number at a point, or another name is a matrix."""
    for name in point.keys() & names_of(algebra):
        if isinstance(point[name], list) is not (name in algebra.get("letters", ())):
            raise Rejected(f"a point has a matrix where a number must stand, or a number for a matrix: {name}")


def equations(data: Data) -> list[Data]:
    """The statements, and the hypotheses of counterexamples."""
    return [*data["statements"], *(hypothesis for one in data["counterexamples"] for hypothesis in one["hypotheses"])]


def check(data: Data) -> dict[str, str]:
    """Raises Rejected unless every statement is proved and every counterexample valid; returns the counts."""
    check_verdict(data)
    work = Work()
    work.spend(evaluations(data))
    algebras, deciding = read(data, work)
    values = derivation.valued(data["derivation"])
    formulas = meaning.check(data, deciding)
    points = [entries(one) for one in data["points"]]
    for i, one in enumerate(data["algebras"]):
        if one["kind"] != "quotient":
            check_satisfiable(one, points, f"algebra {i}")
    supposed, places = set[int](), set[tuple[int, int]]()
    for i, one in enumerate(data["statements"]):
        decided_in, (differences, _) = algebras[one["algebra"]], deciding[one["algebra"]].stated(one)
        if "refuted" in one:  # `stated` has checked its names
            continue
        algebra, point, where = data["algebras"][one["algebra"]], points[one["point"]], f"statement {i}"
        if isinstance(decided_in, Quotients):
            if check_identity(differences, one["cofactors"], decided_in, where):
                supposed.add(i)
        elif any(x.terms for x in differences):
            raise Rejected(f"{where} is not proved: left - right does not become 0 by the rules")
        if (place := (one["algebra"], one["point"])) not in places:
            check_hypotheses(algebra, point, where, whole=True)
            places.add(place)
        if not holds(one, algebra, point, values, where):
            raise Rejected(f"{where} fails at its point")
    for role in STATED if data["verdict"] != "open" else ():
        proved = {i for i, one in enumerate(data["statements"]) if one["role"] == role and "refuted" not in one}
        if proved and proved <= supposed and not any(one["role"] == role for one in said(data, "statements")):
            raise Undecided(f"all that is {role} is among the relations that it supposes")
    for i, one in enumerate(data["comparisons"]):
        if compared(one["relations"], points[one["point"]], {}, f"comparison {i}") is ("refuted" in one):
            raise Rejected(f"comparison {i} does not agree with the numbers at its point")
    for i, one in enumerate(data["counts"]):
        algebra, point, where = data["algebras"][one["algebra"]], points[one["point"]], f"count {i}"
        own = derivation.valued([step for step in data["derivation"] if step["algebra"] == one["algebra"]])
        numbers = roots.solutions(one, algebra, point, own, work, where)
        if compared(one["relations"], numbers, {}, where) is not one["holds"]:
            raise Rejected(f"{where} says something else than the numbers {', '.join(map(str, numbers.values()))}")
    for i, one in enumerate(data["zeros"]):
        zeros.check(one, points[one["point"]], work, f"zero {i}")
    contradicting = [entries(one["point"]) for one in data["counterexamples"]]
    for i, one in enumerate(data["hypotheses"]):
        check_hypothesis(one, [*points, *contradicting], contradicting, f"hypothesis {i}")
    for i, one in enumerate(data["counterexamples"]):
        check_counterexample(one, i, data, values)
    trees = [tree for one in equations(data) for tree in (*one["left"], *one["right"])]
    trees += [tree for one in data["counts"] for tree in (*one["equations"], *one["nonzero"])]
    derivation.check_use(data["derivation"], trees)
    refuted = [i for i, one in enumerate(data["statements"]) if "refuted" in one]
    for i in refuted:
        if i not in data["counterexamples"][data["statements"][i]["refuted"]]["refutes"]:
            raise Rejected(f"statement {i} is not refuted by its counterexample")
    roles = [one["role"] for one in said(data)]
    failing = sum(map(meaning.is_false, said(data)))
    counted = {role: roles.count(role) for role in ROLES} | {"refuted": failing}
    return {name: str(number) for name, number in (counted | formulas).items() if number}


def read(data: Data, work: Work) -> tuple[list[Algebra | Quotients], list[meaning.Comparer]]:
    """The algebras of a certificate, and a comparer of equations for each."""
    algebras = [
        quotients(one, Ring([*one["variables"], ROOT], work)) if one["kind"] == "quotient" else Algebra(one, work)
        for one in data["algebras"]
    ]
    return algebras, meaning.comparers(data, algebras, derivation.values(data["derivation"], algebras))


def evaluations(data: Data) -> int:
    """The number of parts of trees evaluated at points, including the trees of derived names."""
    values = {name: size(tree) for name, tree in derivation.valued(data["derivation"]).items()}

    def parts(one: Data) -> int:
        trees = [*one["left"], *one["right"], *(tree for _, tree in one.get("definitions", ()))]
        return size(trees) + sum(values[name] for name in names_in([0, *trees]) & values.keys())

    stated = list(map(parts, data["statements"]))
    assumed = sum(size(one["relations"]) for one in data["hypotheses"])
    total = sum(stated) + assumed * (len(data["points"]) + len(data["counterexamples"]))
    total += sum(size(one["relations"]) for one in data["comparisons"])
    for one in data["counterexamples"]:
        total += sum(stated[i] for i in (*one["refutes"], *one["agrees"]))
        total += sum(map(parts, one["hypotheses"]))
    return total


def check_identity(numerators: Sequence[Polynomial], cofactors: Sequence[Any], ring: Quotients, where: str) -> bool:
    """Raises Rejected unless each numerator is Σ cofactor · relation; returns whether each is merely a relation."""
    sized(cofactors, len(numerators), f"the cofactors of {where}")
    for numerator, own in zip(numerators, cofactors, strict=True):
        if not ring.vanishes(numerator, own, where):
            raise Rejected(f"{where} is not proved: its cofactors do not make left - right from the relations")
    return all(any(meaning.proportional(a, x.numerator) for x in ring.relations) for a in numerators)


def entries(data: Data) -> dict[str, Value]:
    """The values of a point, by name."""
    return {
        name: Matrix([[Fraction(x) for x in row] for row in entry]) if isinstance(entry, list) else Fraction(entry)
        for name, entry in data.items()
    }


def at(tree: Tree, point: Mapping[str, Value], values: Mapping[str, Tree], where: str) -> Value:
    """The value of a tree at a point; `values`: the trees of derived names."""
    try:
        used = names_in(tree) & values.keys() if values else ()
        made = {name: value(values[name], point, Fraction) for name in used}
        found: Value = value(tree, {**point, **made}, Fraction)
    except ZeroDivisionError:
        raise Rejected(f"{where} has a point at which a denominator vanishes") from None
    return found


def holds(one: Data, algebra: Data | None, point: Mapping[str, Value], values: Mapping[str, Tree], where: str) -> bool:
    """Whether left = right at a point, in every entry; in an algebra of traces, whether the traces are equal."""
    point = dict(point)
    for name, tree in one.get("definitions", []):
        point[name] = at(tree, point, values, where)
    equations = [("=", left, right) for left, right in zip(one["left"], one["right"], strict=True)]
    return compared(equations, point, values, where, traces=algebra is not None and algebra["kind"] == "traces")


def compared(
    relations: Sequence[Any], point: Mapping[str, Value], values: Mapping[str, Tree], where: str, traces: bool = False
) -> bool:
    """Whether all relations hold at a point; for matrices only = and != are allowed."""
    found = []
    for relation, left, right in relations:
        a, b = at(left, point, values, where), at(right, point, values, where)
        if traces:
            a, b = trace(a), trace(b)
        if relation in ("=", "!="):
            found.append(same(a, b) == (relation == "="))
        elif isinstance(a, Matrix) or isinstance(b, Matrix):
            raise Rejected(f"{where} says which of two matrices is less")
        else:
            found.append(a < b or (a == b and relation == "<="))
    return all(found)  # all were evaluated: no denominator vanishes


def check_hypothesis(
    one: Data, points: Sequence[Mapping[str, Value]], contradicting: Sequence[Mapping[str, Value]], where: str
) -> None:
    """Raises Rejected unless a hypothesis holds at every point with values for its names, and there is such a point.

    A counterexample with a value for one of the names must have values for all.
    """
    names = set().union(*(names_in(tree) for relation in one["relations"] for tree in relation[1:]))
    tested = [point for point in points if names <= point.keys()]
    for point in contradicting:
        if not names.isdisjoint(point) and (missing := names - point.keys()):
            raise Rejected(f"{where} is not tested at a counterexample, which has no value for {min(missing)}")
    if not tested:
        raise Rejected(f"{where} is tested at no point")
    if not all(compared(one["relations"], point, {}, where) for point in tested):
        raise Rejected(f"{where} is violated at a point")


def check_hypotheses(algebra: Data, point: Mapping[str, Any], where: str, whole: bool) -> None:
    """Raises Rejected unless an algebra's assumptions hold at a point; without `whole`, those among its letters."""
    if whole and not {*names_of(algebra)} <= point.keys():
        raise Rejected(f"{where} has a point without a value for every variable")
    if algebra["kind"] == "quotient":
        if any(at(relation, point, {}, where) != 0 for relation in algebra["relations"]):
            raise Rejected(f"{where} has a point at which a relation fails")
        return
    rules, transposes = about(algebra, point, where)
    if not compared([("=", ["*", a, b], image) for a, b, image in rules], point, {}, where):
        raise Rejected(f"{where} has matrices for which a rule fails")
    if not all(same(point[letter].transposed, at(image, point, {}, where)) for letter, image in transposes):
        raise Rejected(f"{where} has matrices that are not transposes as it is said")


def check_satisfiable(algebra: Data, points: Sequence[Mapping[str, Value]], where: str) -> None:
    """Raises Rejected unless the assumptions of an algebra of words hold at one of the points."""
    for point in points:
        with suppress(Rejected):
            return check_hypotheses(algebra, point, where, whole=True)
    raise Rejected(f"{where} has no point at which its rules hold")


def check_counterexample(one: Data, i: int, data: Data, values: Mapping[str, Tree]) -> None:
    """Raises Rejected unless the hypotheses hold, the refuted statements fail, and those it agrees with hold."""
    where, point = f"counterexample {i}", entries(one["point"])

    def true(number: int) -> bool:
        statement = data["statements"][number]
        return holds(statement, data["algebras"][statement["algebra"]], point, values, where)

    if not one["refutes"]:
        raise Rejected(f"{where} refutes nothing")
    for hypothesis in one["hypotheses"]:
        if not holds(hypothesis, None, point, values, where):
            raise Rejected(f"{where} violates a hypothesis")
    for number in one["refutes"]:
        refuted = data["statements"][number]
        if "refuted" not in refuted:
            raise Rejected(f"{where} refutes a statement that is said to be proved")
        check_hypotheses(data["algebras"][refuted["algebra"]], point, where, whole=False)
        if true(number):
            raise Rejected(f"{where} does not contradict statement {number}")
    for number in one["agrees"]:
        check_hypotheses(data["algebras"][data["statements"][number]["algebra"]], point, where, whole=False)
        if "refuted" in data["statements"][number] or not true(number):
            raise Rejected(f"{where} contradicts statement {number}, which it should confirm")
