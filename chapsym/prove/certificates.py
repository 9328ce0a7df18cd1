"""The statements that a proof decided, as data for the checker: a certificate of kind register-claim.

Statements that are no equations of an algebra, or cannot be exported, are listed as sentences, which are counted.
"""

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import sympy as sp

from chapsym import checker, files
from chapsym.checker import derivation, formulas, meaning, register, shown
from chapsym.checker.algebra import Algebra
from chapsym.checker.matrices import Quotients, quotients
from chapsym.checker.polynomial import Ring, Work
from chapsym.checker.trees import names_in
from chapsym.derive.derivation import STEPS, Step, needed
from chapsym.derive.quotient import Quotient as QuotientRing
from chapsym.derive.words import Traces, WordAlgebra, evaluate, unfolded

from . import witness
from .cofactors import Ideal, ideal, trees
from .evidence import Proof
from .points import allowed, candidates
from .polynomials import Identity
from .statements import Comparison, Count, Equation, Point, Rest, Side, Statement, Value, Values, Zero, contradicts
from .trees import Data, NotAlgebra, Tree, nested, number, shared, tree

#: A symbol whose value is the trace of words.
TRACE = sp.Function("tr")
#: Letters of a judged formula in a record.
LONGEST = 400
#: The lists of decided statements in a certificate.
PARTS = (
    "algebras", "derivation", "points", "statements", "comparisons", "counts", "zeros", "counterexamples", "rests",
    "sentences",
)  # fmt: skip


def certificate(id: str, printed: str, proof: Proof, verdict: str = "open") -> Data:
    """The certificate of a claim whose proof has run; raises checker.Rejected if the checker does not accept it."""
    made = _Maker(proof)
    for point in proof.points:
        made.counterexample(point)
    for role, statement, holds in proof.decided:
        made.add(role, statement, holds)
    made.finish()
    hypotheses = [{"text": h.text, "relations": _relations(h)} for h in proof.assumed]
    decidable = {h.text for h in proof.assumed}
    undecided = [text for text in proof.hypotheses if text not in decidable]
    for role, texts in (("hypothesis", undecided), ("said", proof.said), ("inference", proof.inferences)):
        made.parts["sentences"] += [{"role": role, "text": text} for text in texts]
    made.parts["rests"] += [
        {"role": "lemma", "text": f"{c['file']}: {c['statement']}", "certificate": c["digest"]}
        for c in proof.certificates
        if c["accepted"]
    ]
    data = {
        "format": checker.FORMAT, "kind": "register-claim", "claim": id, "verdict": verdict, "printed": printed,
        "corrected": proof.corrected_text, "glossary": _glossary(printed, proof), "uses": sorted(set(proof.uses)),
        "hypotheses": hypotheses, **made.parts,
    }  # fmt: skip
    try:
        return _accepted(data)
    except checker.Rejected:  # perhaps only because what the formulas say in words is not marked
        for role in ("printed", "corrected") if data["glossary"] else ():
            decided, found, _ = meaning.said(role, data, register.read(data, Work())[1])
            for i, one in enumerate(decided):
                one |= {} if i in found else {"words": True}
        return _accepted(data)


def _accepted(data: Data) -> Data:
    """The object with its statement and digest, open if it decides nothing; raises checker.Rejected."""
    sealed = data | {"statement": checker.statement(data)}
    sealed |= {"digest": checker.digest(sealed)}
    try:
        checker.check(sealed)
    except register.Undecided:  # decided by SymPy, without data that show how
        return _accepted(data | {"verdict": "open"})
    return sealed


def _glossary(printed: str, proof: Proof) -> list[list[Any]]:
    """The glossary as data: the symbols of the formulas, and the vanishing expressions."""
    whole = []
    for symbol, (value, what) in proof.glossary.items():
        try:
            whole.append([symbol, what, _value(value)])
        except NotAlgebra as error:
            raise checker.Rejected(f"the value of {symbol} cannot be given to the checker: {error}") from None
    names = names_in([0, *(tree for _, _, v in whole for tree in formulas.entries((formulas.rank_of(v), v)))])
    turned = {name: f"{name}^T" for name in names}  # only the symbols that are read matter
    transposes, used = turned | {image: name for name, image in turned.items()}, set()
    for part in formulas.parts(f"{printed}, {proof.corrected_text or ''}"):
        for numbers in (None, names):  # traces or not
            reader = formulas.Reader(whole, transposes, numbers)
            with suppress(formulas.NotRead):
                formulas.relations(part, reader)
            used |= reader.used
    return [one for one in whole if one[0] == "0" or tuple(formulas.tokens(one[0])) in used]


def _value(of: Side) -> Any:
    """A number, a column, a matrix, or the trace of a word, as trees."""
    if isinstance(of, TRACE):
        return {"trace": tree(of.args[0])}
    if not isinstance(of, sp.MatrixBase):
        return tree(of)
    return [tree(x) for x in of] if of.cols == 1 else [[tree(x) for x in row] for row in of.tolist()]


#: The lists, besides statements, that a record counts, and their names.
COUNTED = {
    "derivation": "steps from the premises", "comparisons": "comparisons", "counts": "counts of solutions",
    "hypotheses": "hypotheses", "zeros": "solutions near points", "rests": "rests on other certificates",
}  # fmt: skip


def carried(data: Data) -> Data:
    """The checked parts of an accepted certificate, counted and as text, and the sentences, which are not checked."""
    sizes = {name: len(part) for name, part in data.items() if isinstance(part, list)}
    identical = sum(one["left"] == one["right"] for one in data["statements"])
    failing = sum("refuted" in one for one in data["comparisons"])
    same = f" ({identical} of one expression on both sides)" if identical else ""
    fail = {"comparisons": f" ({failing} fail as printed)"} if failing else {}
    more = "".join(f"; {what}: {sizes[name]}{fail.get(name, '')}" for name, what in COUNTED.items() if sizes[name])
    sentences = Counter(sentence["role"] for sentence in data["sentences"])
    listed = ", ".join(f"{n} {role}" for role, n in sentences.items()) or "none"
    nothing = "; they decide nothing: a derivation is missing" if data["verdict"] == "open" else ""
    return {
        "statements": sizes["statements"],
        "identical": identical,
        "steps": sizes["derivation"],
        **{name: sizes[name] for name in ("comparisons", "counts", "hypotheses", "zeros", "counterexamples", "rests")},
        "sentences": dict(sentences),
        "text": f"statements that the checker accepted: {sizes['statements']}{same}{more}; "
        f"counterexamples: {sizes['counterexamples']}; sentences: {listed}{nothing}",
        "judged": [
            line if len(line) <= LONGEST else f"{line[:LONGEST]}... ({len(line)} letters)"
            for line in shown.lines(data, parts=False)  # `checker --show` has all of them
        ],
    }


def write(data: Data, folder: Path) -> None:
    """Writes the certificate to the file of its claim, one line per part; raises CannotWrite if this fails."""
    lines = []
    for name, part in data.items():
        if isinstance(part, list) and part:
            rows = ",\n".join(json.dumps(one, ensure_ascii=False, separators=(",", ":")) for one in part)
            lines.append(f"{json.dumps(name)}: [\n{rows}\n]")
        else:
            lines.append(f"{json.dumps(name)}: {json.dumps(part, ensure_ascii=False)}")
    files.write_text(folder / checker.file_name(data["claim"]), "{\n" + ",\n".join(lines) + "\n}\n")


class _Maker:
    """Collects the parts of a certificate, each algebra and each point once."""

    def __init__(self, proof: Proof) -> None:
        self.proof = proof
        self.parts: dict[str, list[Data]] = {name: [] for name in PARTS}
        self.algebras, self.derivation, self.statements, self.counterexamples = (
            self.parts[name] for name in ("algebras", "derivation", "statements", "counterexamples")
        )
        #: For each algebra: the algebra itself, or that of its traces, and its symbols.
        self._sources: dict[int, tuple[Any, list[sp.Symbol]]] = {}
        self._ideals: dict[int, Ideal] = {}
        stated = [statement for _, statement, _ in proof.decided if isinstance(statement, Equation)]
        stated += [hypothesis for point in proof.points for hypothesis in point.hypotheses]
        expressions = [side for one in stated for sides in one.written for side in sides]
        for _, one, _ in proof.decided:
            expressions += [*one.equations, *one.nonzero] if isinstance(one, Count) else []
        self._steps = list(needed(expressions))
        self._defined: dict[str, derivation.Defined] = {}
        self.derivation += map(self._definition, self._steps)
        self._defined = derivation.values(self.derivation, [self._arithmetic(one) for one in self.algebras])

    def _arithmetic(self, algebra: Data) -> Algebra | Quotients:
        if algebra["kind"] == "quotient":
            return quotients(algebra, Ring(algebra["variables"], Work()))
        return Algebra(algebra, Work())

    def counterexample(self, point: Point) -> None:
        """A point, with its hypotheses; the refuted statements are added with the statements."""
        exact = {symbol.name: _entry(entry) for symbol, entry in self._completed(point).items()}
        hypotheses = [{"text": h.text, **_sides(h)} for h in point.hypotheses]
        self.counterexamples.append({"point": exact, "hypotheses": hypotheses, "refutes": [], "agrees": []})

    def _completed(self, point: Point) -> Values:
        """The point, with values of the variables that are only in the relations."""
        exact = point.exact
        for _, statement, holds in self.proof.decided:
            if isinstance(statement, Equation) and not holds:
                algebra = _letters_of(statement.algebra)
                if isinstance(algebra, QuotientRing):
                    exact = next(candidates(algebra.symbols, algebra.relations, self.proof.examples, exact), exact)
                else:
                    exact = witness.closed(dict(exact), algebra)
        return exact

    def add(self, role: str, statement: Statement, holds: bool) -> None:
        """Adds a decided statement, with its proof or refutation, or a sentence."""
        try:
            part, data = self._exported(statement, holds, holds or (role == "printed" and contradicts(statement)))
            why = statement.method
        except (NotAlgebra, NotFound) as error:
            part, data, why = "sentences", {}, f"not exported: {error}"
        one = {"role": role, "text": statement.text} | data
        if isinstance(statement, Equation) and data:
            for example in self.counterexamples:
                self._compare(example, one, len(self.statements))
            if not holds and one["refuted"] is None:
                part, why = "sentences", "its counterexample is another's"
        if part == "sentences":
            one = {"role": role, "text": f"{'' if holds else 'false: '}{statement.text} ({why})"}
        self.parts[part].append(one)

    def _exported(self, statement: Statement, holds: bool, judged: bool) -> tuple[str, Data]:
        """The list of a statement, and its proof; one that is neither an equation nor `judged` is a sentence."""
        match statement:
            case Equation():
                one = {"algebra": self._algebra(statement.algebra), **_sides(statement)}
                return "statements", one | (self._proof(statement, one) if holds else {"refuted": None})
            case Comparison() if judged:
                one = {"point": self._point(statement.point), "relations": _relations(statement)}
                return "comparisons", one | ({} if holds else {"refuted": True})
            case Count() if judged:
                return "counts", self._count(statement, holds)
            case Zero() if holds:
                return "zeros", self._zero(statement)
            case Rest() if holds:
                return "rests", {"certificate": statement.certificate}
            case Identity() if holds:
                return "statements", self._identity(statement)
        return "sentences", {}

    def _identity(self, identity: Identity) -> Data:
        """An identity in free parameters: a statement without relations."""
        names = identity.parameters
        definitions, trees = shared([*identity.left, *identity.right])
        half = len(identity.left)
        algebra = _place(self.algebras, {"kind": "quotient", "variables": names, "relations": []})
        one = {"algebra": algebra, "left": trees[:half], "right": trees[half:]}
        one |= {"definitions": definitions} if definitions else {}
        return one | {"point": self._good_point(one, sp.symbols(names), ()), "cofactors": [[]] * half}

    def _count(self, count: Count, holds: bool) -> Data:
        """A count, with the proof of the numbers of solutions."""
        found = count.elimination()
        names = [f"y{i}" for i in range(len(count.unknowns))]
        return {
            "algebra": self._algebra(count.algebra), "point": self._point(count.point),
            "unknowns": [x.name for x in count.unknowns], "equations": [tree(e) for e in count.equations],
            "nonzero": [tree(e) for e in count.nonzero], "chart": found.chart,
            "combinations": [[nested(factor, names) for factor in c] for c in found.combinations],
            "relations": _relations(count), "holds": holds,
        }  # fmt: skip

    def _zero(self, zero: Zero) -> Data:
        """A solution near a point."""
        return {
            "point": self._point(zero.point), "unknowns": [x.name for x in zero.unknowns],
            "definitions": [[name.name, tree(expr)] for name, expr in zero.definitions],
            "equations": [tree(e) for e in zero.equations], "nonzero": [tree(e) for e in zero.nonzero],
            "radius": number(zero.radius),
        }  # fmt: skip

    def _compare(self, example: Data, one: Data, i: int) -> None:
        """Records that a point refutes a printed statement, or that a corrected one holds there."""
        point, refutes = register.entries(example["point"]), "refuted" in one
        if not refutes and one["role"] not in ("corrected", "under"):
            return
        try:
            if not refutes:
                register.check_hypotheses(self.algebras[one["algebra"]], point, "", whole=False)
            agrees = register.holds(one, self.algebras[one["algebra"]], point, derivation.valued(self.derivation), "")
        except checker.Rejected:  # the point has no value for some variable
            return
        if refutes and not agrees:
            example["refutes"].append(i)
            one["refuted"] = self.counterexamples.index(example) if one["refuted"] is None else one["refuted"]
        elif agrees and not refutes:
            example["agrees"].append(i)

    def finish(self) -> None:
        """Omits unused parts, and gives each algebra of words a point."""
        stated = [*self.statements, *(h for one in self.counterexamples if one["refutes"] for h in one["hypotheses"])]
        trees = [tree for one in stated for tree in (*one["left"], *one["right"])]
        trees += [tree for one in self.parts["counts"] for tree in (*one["equations"], *one["nonzero"])]
        used = derivation.used(self.derivation, trees)
        self.derivation[:] = [one for one in self.derivation if one["name"] in used]
        self._leave_out_algebras()
        for i, algebra in enumerate(self.algebras):
            if algebra["kind"] != "quotient":
                words, symbols = self._sources[i]
                if (exact := witness.matrices(set(symbols), words, self.proof.examples)) is not None:
                    self._point(exact)
        kept = [example for example in self.counterexamples if example["refutes"]]
        for one in self.statements:
            if "refuted" in one:
                one["refuted"] = kept.index(self.counterexamples[one["refuted"]])
        self.counterexamples[:] = kept

    def _leave_out_algebras(self) -> None:
        """Omits algebras without statements."""
        using = [*self.statements, *self.parts["counts"], *self.derivation]
        kept = sorted({one["algebra"] for one in using})
        for one in using:
            one["algebra"] = kept.index(one["algebra"])
        self.algebras[:] = [self.algebras[i] for i in kept]
        self._sources = {new: self._sources[old] for new, old in enumerate(kept) if old in self._sources}

    def _definition(self, letter: sp.Symbol) -> Data:
        """A step of the derivation."""
        step = STEPS[letter]
        by = step.by
        if step.operation == "matrix":
            by = self._places(step)
        elif step.operation == "entry":
            by = list(by)
        elif isinstance(by, Mapping):
            by = [[x.name, tree(image)] for x, image in by.items()]
        elif by is not None:
            by = by.name if isinstance(by, sp.Symbol) else [x.name for x in by]
        value = {} if step.operation == "matrix" else {"value": tree(unfolded(letter))}
        return {
            "name": letter.name, "text": step.text, "algebra": self._algebra(step.algebra),
            "operation": step.operation, "of": tree(step.of), "by": by or [], **value,
        }  # fmt: skip

    def _places(self, step: Step) -> list[Any]:
        """The matrices of a step, and the cofactors that prove the rules for them."""

        def rows(of: Value) -> Tree | list[Tree]:
            return [[tree(x) for x in row] for row in of.tolist()] if isinstance(of, sp.MatrixBase) else tree(of)

        places, cofactors, one = step.by, [], {"algebra": self._algebra(step.algebra)}
        for (a, b), image in STEPS[step.of].algebra.rules.items():
            if a in places:
                product = places[a] * places[b]
                claimed = evaluate(image, places) if image.free_symbols else image * sp.eye(product.rows)
                sides = {"left": [tree(x) for x in product], "right": [tree(x) for x in claimed]}
                cofactors.append(self._cofactors(one | sides))
        return [[[x.name, rows(of)] for x, of in places.items()], cofactors]

    def _algebra(self, algebra: object) -> int:
        of = _letters_of(algebra)
        if isinstance(of, QuotientRing):
            symbols = list(of.symbols)
            relations = [tree(relation) for relation in of.relations]
            data = {"kind": "quotient", "variables": [x.name for x in symbols], "relations": relations}
        elif isinstance(of, WordAlgebra):
            data, symbols = self._words(of)
            data["kind"] = "words" if of is algebra else "traces"
        else:
            raise NotAlgebra(f"{type(algebra).__name__} is neither a quotient ring nor an algebra of words")
        i = _place(self.algebras, data)
        self._sources[i] = of, symbols
        return i

    def _words(self, algebra: WordAlgebra) -> tuple[Data, list[sp.Symbol]]:
        """The algebra, with the letters and parameters of all statements of the claim in it, and of its derivation."""
        expressions = [*algebra.transposes, *algebra.transposes.values(), *algebra.rules.values()]
        expressions += [letter for pair in algebra.rules for letter in pair]
        for _, statement, _ in self.proof.decided:
            if isinstance(statement, Equation) and _alike(statement.algebra, algebra):
                expressions += [*statement.left, *statement.right]
        for letter in self._steps:
            if _alike((step := STEPS[letter]).algebra, algebra):
                by = step.by.values() if isinstance(step.by, Mapping) else ()
                expressions += map(unfolded, (letter, step.of, *by))
        symbols = sorted(set().union(*(e.free_symbols for e in expressions)), key=lambda x: str(x.name))
        return {
            "kind": "words",
            "letters": [x.name for x in symbols if not x.is_commutative],
            "parameters": [x.name for x in symbols if x.is_commutative],
            "transposes": [[x.name, tree(image)] for x, image in algebra.transposes.items()],
            "rules": [[a.name, b.name, tree(image)] for (a, b), image in algebra.rules.items()],
        }, symbols

    def _proof(self, equation: Equation, one: Data) -> Data:
        """The point, and the cofactors of an equation in a quotient ring."""
        algebra, symbols = self._sources[one["algebra"]]
        if isinstance(algebra, WordAlgebra):
            if (exact := witness.matrices(set(symbols), algebra, self.proof.examples)) is None:
                raise NotFound("no matrices are known for which its rules hold")
            return {"point": self._point(exact)}
        return {"cofactors": self._cofactors(one), "point": self._good_point(one, symbols, algebra.relations)}

    def _good_point(self, one: Data, symbols: Sequence[sp.Symbol], relations: Sequence[sp.Expr]) -> int:
        """A point where the hypotheses and the relations hold, and no denominator vanishes."""
        for exact in allowed(symbols, relations, self.proof.assumed, self.proof.examples):
            entries = {x.name: _entry(v) for x, v in exact.items()}
            try:
                if register.holds(one, None, register.entries(entries), derivation.valued(self.derivation), ""):
                    return self._point(exact)
            except checker.Rejected:  # a denominator vanishes there
                continue
        raise NotFound("no rational point was found where its relations hold")

    def _point(self, exact: Values) -> int:
        return _place(self.parts["points"], dict(sorted((x.name, _entry(v)) for x, v in exact.items())))

    def _cofactors(self, one: Data) -> list[list[Tree]]:
        """The cofactors of each entry of left - right, for the numerator that the checker forms."""
        if not self.algebras[one["algebra"]]["relations"]:
            return [[] for _ in one["left"]]  # the numerators are 0, which the checker sees
        ring = quotients(self.algebras[one["algebra"]], Ring(self.algebras[one["algebra"]]["variables"], Work()))
        more = derivation.entries([*one["left"], *one["right"]], self._defined)
        if one["algebra"] not in self._ideals:
            self._ideals[one["algebra"]] = ideal(ring)
        found = []
        for left, right in zip(one["left"], one["right"], strict=True):
            cofactors = trees(self._ideals[one["algebra"]], ring.read(left, more) - ring.read(right, more))
            if cofactors is None:
                raise NotFound("no cofactors were found")
            found.append(cofactors)
        return found


class NotFound(Exception):
    """A part that a certificate needs besides the statement was not found; the message names it."""


def _sides(equation: Equation) -> Data:
    left, right = equation.written
    return {"left": [tree(x) for x in left], "right": [tree(x) for x in right]}


def _letters_of(algebra: object) -> Any:
    """The algebra of letters: the algebra itself, or the algebra of its traces."""
    return algebra.algebra if isinstance(algebra, Traces) else algebra


def _alike(one: object, other: WordAlgebra) -> bool:
    """Whether two algebras are equal, or one is that of the traces of the other."""
    one = _letters_of(one)
    return isinstance(one, WordAlgebra) and bool((one.transposes, one.rules) == (other.transposes, other.rules))


def _relations(comparison: Comparison | Count) -> list[list[Tree]]:
    """The relations as the checker reads them, with > and ≥ reversed."""
    relations = (r if r.rel_op in _OPERATIONS else r.reversed for r in comparison.relations)
    return [[_OPERATIONS[r.rel_op], tree(r.lhs), tree(r.rhs)] for r in relations]


_OPERATIONS = {"<": "<", "<=": "<=", "==": "=", "!=": "!="}


def _entry(x: Value) -> Tree:
    """A number or a matrix of a point, as data."""
    return [[number(entry) for entry in row] for row in x.tolist()] if isinstance(x, sp.MatrixBase) else number(x)


def _place(among: list[Data], data: Data) -> int:
    """The index of data in a list, to which they are added if they are new."""
    text = json.dumps(data)
    i = next((i for i, other in enumerate(among) if json.dumps(other) == text), len(among))
    among += [data][: i == len(among)]
    return i
