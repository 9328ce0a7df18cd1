"""Statements about words as theorems about matrices of every size, over every commutative ring."""

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from math import lcm

from .names import identifier
from .quotients import Data, Tree, joined, names_in

#: Rows and columns of a letter; True is n, False is 1.
Shape = tuple[bool, bool]
#: The left and the right sides of equations, each for a reader and as data.
Sides = list[tuple[tuple[str, str], tuple[str, str]]]
TYPES = {(True, True): ("'M[R]_n", "square"), (True, False): ("'cV[R]_n", "column"), (False, True): ("'rV[R]_n", "row")}


class LeftOut(Exception):
    """A statement that is not translated; the message says why."""


@dataclass
class Algebra:
    """The letters with their shapes and their Rocq names; N is a multiple of all denominators."""

    letters: dict[str, tuple[int, Shape, str]]
    parameters: dict[str, tuple[int, str]]
    N: int

    def is_number(self, tree: Tree) -> bool:
        """Whether no letter is in a tree."""
        return not any(name in self.letters for name in names_in(tree))

    def shape(self, tree: Tree) -> Shape | None:
        """Rows and columns; None for a number, which is any multiple of a unit matrix."""
        if self.is_number(tree):
            return None
        if isinstance(tree, str):
            return self.letters[tree][1]
        if tree[0] == "+":
            return next(self.shape(part) for part in tree[1:] if not self.is_number(part))
        factors = tree[1:2] if tree[0] == "^" else tree[1:]
        shapes = [shape for shape in map(self.shape, factors) if shape]
        return shapes[0][0], shapes[-1][1]

    def number(self, tree: Tree) -> tuple[str, str]:
        """A number for a reader, and as data."""
        if isinstance(tree, str) and tree in self.parameters:
            i, name = self.parameters[tree]
            return name, f"(Param {i})"
        if not isinstance(tree, list):
            x = Fraction(tree)
            whole = x.numerator if x.denominator == 1 else int(x * self.N)
            text = f"{whole}%:R" if whole >= 0 else f"(- {-whole}%:R)"
            number = f"(Number ({f'Posz {whole}' if whole >= 0 else f'Negz {-whole - 1}'}))"
            if x.denominator == 1:
                return text, number
            if whole == 1:
                return f"{self.N}%:R^-1", "(Param 0)"
            return f"({text} / {self.N}%:R)", f"(SProd {number} (Param 0))"
        if tree[0] == "^":
            if tree[2] < 0:
                raise LeftOut("it divides by a parameter")
            return self.number(["*", *[tree[1]] * tree[2]] if tree[2] > 1 else tree[1])
        return joined(*{"+": ("+", "SSum"), "*": ("*", "SProd")}[tree[0]], map(self.number, tree[1:]))

    def matrix(self, tree: Tree) -> tuple[str, str]:
        """A matrix for a reader, and as data."""
        if self.is_number(tree):
            if tree == 1:
                return "1%:M", "Unit"
            text, number = self.number(tree)
            return f"({text} *: 1%:M)", f"(Scaled {number} Unit)"
        if isinstance(tree, str):
            return self.letters[tree][2], f"(Letter {self.letters[tree][0]})"
        if tree[0] == "^":
            if tree[2] < 0:
                raise LeftOut("it has the inverse of a matrix")
            return self.matrix(["*", *[tree[1]] * tree[2]] if tree[2] > 1 else tree[1])
        if tree[0] == "+":
            return joined("+", "Sum", map(self.matrix, tree[1:]))
        text, product = joined("*m", "Prod", (self.matrix(part) for part in tree[1:] if not self.is_number(part)))
        if not (numbers := [self.number(part) for part in tree[1:] if self.is_number(part)]):
            return text, product
        factor, number = joined("*", "SProd", numbers)
        return f"({factor} *: {text})", f"(Scaled {number} {product})"


def _denominators(tree: Tree) -> set[int]:
    if isinstance(tree, list):
        return set().union(*(_denominators(part) for part in tree[1:]))
    return set() if names_in(tree) else {Fraction(tree).denominator}


def statement(name: str, one: Data, data: Data, point: Data) -> str:
    """The theorem: the equations of a statement hold for all matrices for which the rules hold."""
    rules = rules_for(data, names_in([None, *one["left"], *one["right"]]))
    algebra = algebra_of(data, one, rules, point)
    shapes = {shape for shape in map(algebra.shape, (*one["left"], *one["right"])) if shape}
    if len(shapes) != 1:
        raise LeftOut("its sides are matrices of no size, or of several")
    [(s, t)] = shapes
    if s != t and any(map(algebra.is_number, (*one["left"], *one["right"]))):
        raise LeftOut("a side is a number, and the other is no square matrix")
    sides = [(algebra.matrix(a), algebra.matrix(b)) for a, b in zip(one["left"], one["right"], strict=True)]
    hypotheses, rules_as_data = rules_of(algebra, rules)
    lemma = f"words {shapes_of(algebra)}\n    {rules_as_data} {algebra.N} {_bool(s)} {_bool(t)}"
    return theorem(name, algebra, hypotheses, lemma, sides)


def rules_of(algebra: Algebra, rules: list[list[Tree]]) -> tuple[list[str], str]:
    """The rules as hypotheses, and as data."""
    hypotheses, parts = [], []
    for a, b, image in rules:
        (product, _), (text, tree) = algebra.matrix(["*", a, b]), algebra.matrix(image)
        hypotheses.append(f"{product[1:-1]} = {text}")
        parts.append(f"({algebra.letters[a][0]}, {algebra.letters[b][0]}, {tree})%N")
    return hypotheses, f"[:: {'; '.join(parts)}]"


def shapes_of(algebra: Algebra) -> str:
    """Rows and columns of the letters, as data."""
    return f"[:: {'; '.join(f'({_bool(s)}, {_bool(t)})' for _, (s, t), _ in algebra.letters.values())}]"


def theorem(name: str, algebra: Algebra, hypotheses: list[str], lemma: str, sides: Sides, known: str = "") -> str:
    """The theorem that a lemma proves with its data, from the computed sides, and from `known` facts."""
    binders, variables = _binders(algebra)
    unit, inverse = f"{algebra.N}%:R \\is a @GRing.unit R ->", f"{algebra.N}%:R^-1"
    letters = [f"{TYPES[of][1]} {f'({text})' if '^' in text else text}" for _, of, text in algebra.letters.values()]
    parameters = [inverse if algebra.N > 1 else "1", *(text for _, text in algebra.parameters.values())]
    whole = " /\\\n  ".join(f"{a} = {b}" for (a, _), (b, _) in sides)
    data = ";\n    ".join(f"({a}, {b})" for (_, a), (_, b) in sides)
    return "\n".join([
        f"Theorem {name} : forall (R : comUnitRingType) (n : nat){binders},",
        *([f"  {unit}"] if algebra.N > 1 else []),
        *(f"  {hypothesis} ->" for hypothesis in hypotheses),
        f"  {whole}.",
        f"Proof.\n  intros R n{variables}{' unit_N' if algebra.N > 1 else ''}.",
        f"  exact (@{lemma}",
        f"    [:: {data}]",
        "    ltac:(vm_cast_no_check (erefl true)) R n",
        f"    [:: {'; '.join(parameters)}]",
        f"    [:: {'; '.join(letters)}]",
        f"    ({'mulrV unit_N' if algebra.N > 1 else 'mulr1 _'}){known}).\nQed.",
    ])  # fmt: skip


def rules_for(data: Data, used: set[str]) -> list[list[Tree]]:
    """The rules on the letters of a statement, and on the letters of these rules."""
    while True:
        rules = [rule for rule in data["rules"] if {*rule[:2]} <= used]
        if (more := used.union(*(names_in(rule[2]) for rule in rules))) == used:
            return rules
        used = more


def algebra_of(data: Data, one: Data, rules: list[list[Tree]], point: Data, more: Iterable[str] = ()) -> Algebra:
    """The letters and parameters of a statement, of its rules, and `more` letters."""
    used = names_in([None, *one["left"], *one["right"], *(part for rule in rules for part in rule), *more])
    sizes = {size for name in data["letters"] for size in (len(point[name]), len(point[name][0]))} - {1}
    if len(sizes) != 1:
        raise LeftOut("its matrices are of several sizes")
    transposes = {a: b for a, b in data["transposes"] if isinstance(b, str) and b != a}
    letters = {}
    for i, name in enumerate(sorted(used & set(data["letters"]))):
        if (shape := (len(point[name]) > 1, len(point[name][0]) > 1)) not in TYPES:
            raise LeftOut(f"{name} is a matrix of one entry")
        other = transposes.get(name)
        is_transpose = other is not None and transposes.get(other) == name and (len(other), other) < (len(name), name)
        letters[name] = i, shape, f"{identifier(str(other))}^T" if is_transpose else identifier(name)
    parameters = {name: (i, identifier(name)) for i, name in enumerate(sorted(used & set(data["parameters"])), 1)}
    N = lcm(1, *_denominators(["+", *one["left"], *one["right"], *(rule[2] for rule in rules)]))
    return Algebra(letters, parameters, N)


def _binders(algebra: Algebra) -> tuple[str, str]:
    """The variables with their types; a transpose is the transpose of another variable."""
    types: dict[str, list[str]] = {"R": [text for _, text in algebra.parameters.values()]}
    for _, shape, text in algebra.letters.values():
        plain, transposed = text.removesuffix("^T"), text.endswith("^T")
        mine = types.setdefault(TYPES[shape[::-1] if transposed else shape][0], [])
        mine += [plain][: plain not in mine]
    groups = {type: " ".join(names) for type, names in types.items() if names}
    binders = "".join(f" ({names} : {type})" for type, names in groups.items())
    return binders, "".join(f" {names}" for names in groups.values())


def _bool(x: bool) -> str:
    return str(x).lower()
