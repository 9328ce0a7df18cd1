"""The theorems of one claim, from its certificate."""

from collections import Counter
from collections.abc import Mapping

from . import matrices, quotients, traces, words
from .names import apart, comment
from .quotients import Data, Fact, Tree

#: Why a statement has no theorem.
SAME, COUNT = "it has one expression on both sides", "it is a number of solutions"


class Claim:
    """The text and the theorems of a certificate, by the library that they need; counts by sort; omitted statements."""

    def __init__(self, data: Data):
        self.data, self.name = data, f"claim_{apart(data['claim'])}"
        self.parts: dict[str, list[str]] = {}
        self.names: dict[str, list[str]] = {}
        self.theorems: Counter[str] = Counter()
        self.left_out: Counter[str] = Counter()
        self._points: set[str] = set()
        self._values = {one["name"]: one["value"] for one in data["derivation"] if "value" in one}
        for i, one in enumerate(data["statements"]):
            if "refuted" not in one:
                self._statement(f"{self.name}_statement_{i}", self._unfolded(one))
        for one in data["counts"]:
            self._leave_out("Points", COUNT, one["text"])
        for i, example in enumerate(data["counterexamples"]):
            self._counterexample(f"{self.name}_counterexample_{i}", example)

    def _unfolded(self, one: Data) -> Data:
        """A statement with the names that the derivation defines replaced by their values."""
        sides = {side: [_placed(tree, self._values) for tree in one[side]] for side in ("left", "right")}
        names = [[name, _placed(tree, self._values)] for name, tree in one.get("definitions", [])]
        return one | sides | ({"definitions": names} if names else {})

    def _at_a_point(self, one: Data) -> Data:
        """A statement with the names of its parts replaced by trees, and with computed traces of matrices."""
        one, values = self._unfolded(one), dict[str, Tree]()
        for name, tree in one.get("definitions", []):
            values[name] = _placed(tree, values)
        sides = {side: [_placed(tree, values) for tree in one[side]] for side in ("left", "right")}
        if self.data["algebras"][one["algebra"]]["kind"] == "traces":
            sides = {side: [tree if tree == 0 else ["tr", tree] for tree in trees] for side, trees in sides.items()}
        return one | sides

    def _leave_out(self, library: str, reason: str, text: str) -> None:
        self.left_out[reason] += 1
        self.parts.setdefault(library, []).append(comment(f"Left out, because {reason}: {text}"))

    def _put(self, library: str, sort: str, text: str, name: str, theorem: str) -> None:
        self.parts.setdefault(library, []).append(f"{comment(text)}\n{theorem}")
        self.names.setdefault(library, []).append(name)
        self.theorems[sort] += 1

    def _statement(self, name: str, one: Data) -> None:
        """A statement that is proved, and a point at which its hypotheses are true."""
        algebra, point = self.data["algebras"][one["algebra"]], self.data["points"][one["point"]]
        is_quotient = algebra["kind"] == "quotient"
        is_traced = algebra["kind"] == "traces"
        library = "Points" if is_quotient else "Traces"
        try:
            if one["left"] == one["right"]:
                raise words.LeftOut(SAME)
            if is_quotient:
                theorem = quotients.statement(name, one, algebra)
            else:
                theorem = (traces if is_traced else words).statement(name, one, algebra, point)
        except words.LeftOut as error:
            self._leave_out(library, str(error), one["text"])
            return
        self._put(library, "statements", f"{one['role']}: {one['text']}", name, theorem)
        assumed = _hypotheses(algebra, point)
        if is_quotient:
            assumed += [("=", [pair]) for pair in one.get("definitions", [])] + _nonzero(quotients.trees_of(one))
        key = repr((one["algebra"], one["point"], assumed))
        is_assumed = assumed or (is_traced and algebra["transposes"])
        if is_assumed and key not in self._points:
            self._points.add(key)
            names = [*algebra["variables"]] if is_quotient else [*algebra["parameters"], *algebra["letters"]]
            values = {name: point[name] for name in names}
            for defined, tree in one.get("definitions", []):
                values[defined] = str(quotients.value(tree, values))
            self._point("points", "These hypotheses can be true.", f"{name}_point", values, assumed, [algebra])

    def _counterexample(self, name: str, example: Data) -> None:
        """A point at which printed statements fail, and the corrected ones hold."""
        statements = self.data["statements"]
        refuted, agreeing = ([self._at_a_point(statements[n]) for n in example[part]] for part in ("refutes", "agrees"))
        algebras = [self.data["algebras"][n] for n in dict.fromkeys(one["algebra"] for one in refuted)]
        facts = [("=", _sides(self._unfolded(hypothesis))) for hypothesis in example["hypotheses"]]
        facts += [fact for algebra in algebras for fact in _hypotheses(algebra, example["point"])]
        facts += _nonzero([tree for one in (*agreeing, *refuted) for tree in (*one["left"], *one["right"])])
        facts += [("=", _sides(one)) for one in agreeing] + [("<>", _sides(one)) for one in refuted]
        text = "False as printed: " + "; ".join(one["text"] for one in refuted)
        self._point("counterexamples", text, name, example["point"], facts, algebras)

    def _point(
        self, sort: str, text: str, name: str, values: Mapping[str, Tree], facts: list[Fact], algebras: list[Data]
    ) -> None:
        """Numbers of every field, or matrices of rational numbers, for which the facts are true."""
        if not any(isinstance(value, list) for value in values.values()):
            self._put("Points", sort, text, name, quotients.at_point(name, values, facts))
            return
        pairs = [pair for algebra in algebras for pair in algebra.get("transposes", [])]
        known = [pair for pair in pairs if quotients.names_in(["+", *pair]) <= values.keys()]
        self._put("Matrices", sort, text, name, matrices.at_point(name, values, facts, known))


def _placed(tree: Tree, values: Mapping[str, Tree]) -> Tree:
    """A tree with some names replaced by other trees."""
    if isinstance(tree, list):
        return [tree[0], _placed(tree[1], values), tree[2]] if tree[0] == "^" else [
            tree[0], *(_placed(part, values) for part in tree[1:])
        ]  # fmt: skip
    return values.get(tree, tree) if isinstance(tree, str) else tree


def _sides(one: Data) -> list[tuple[Tree, Tree]]:
    return list(zip(one["left"], one["right"], strict=True))


def _nonzero(trees: list[Tree]) -> list[Fact]:
    """No denominator of these expressions is 0."""
    return [("<>", [(tree, 0)]) for tree in quotients.denominators(trees)]


def _hypotheses(algebra: Data, point: Mapping[str, Tree]) -> list[Fact]:
    """The hypotheses of an algebra, of the names that a point gives."""
    if algebra["kind"] == "quotient":
        return [("=", [(relation, 0)]) for relation in algebra["relations"]]
    rules = [rule for rule in algebra["rules"] if quotients.names_in(["+", *rule]) <= point.keys()]
    return [("=", [(["*", a, b], image)]) for a, b, image in rules]
