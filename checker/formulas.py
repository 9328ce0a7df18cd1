r"""Formulas in TeX, read by a glossary: so that what is printed is what was decided.

A glossary is a list of [symbol, meaning, value].  A symbol is any piece of TeX, such as K, \tilde\gamma or R_{k+1}; the
longest that fits is taken.  A value is a tree, or a list of trees (a vector), or of such lists (a matrix), in the names
of an algebra.  A formula is parts between commas, semicolons and colons; a part is expressions with = or \equiv between
them.  A part with words, or with a symbol that the glossary does not have, is not read.  An expression has

    a + b   a - b   \pm a   a b   \frac ab   a^n   a^T   ( )   [a, b] = ab - ba   \langle a, b \rangle
    a \times b   a \wedge b = a b^T - b a^T   \sqrt a   \mathrm{diag}(a, b, c)   (a, b, c)^T

An equation with a root is squared: so it may be refuted, and is proved only where \pm stands before the root.  In an
algebra of words a^T is made by the transposes of the letters; b of a \wedge b may be printed as its transpose.
"""

import re
from collections.abc import Collection, Mapping, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any

from . import derivation
from .algebra import Algebra
from .derivation import Made
from .form import many, sized, text
from .interval import Rejected
from .matrices import Quotients, quotients
from .polynomial import FIELD, Polynomial, Quotient, Ring
from .trees import check_tree, names_in
from .words import Words

Tree = Any
#: A tree, a vector or a matrix of trees, and which of these it is: 0, 1 or 2.
Value = tuple[int, Any]
#: The name of a root.
ROOT = "_root"
_TOKEN = re.compile(r"\\[A-Za-z]+|\\.|\d|[^\s\d\\]")
#: What says nothing: spaces, and sizes of brackets.
_SILENT = {"\\,", "\\;", "\\!", "\\ ", "\\quad", "\\qquad", "\\bigl", "\\bigr", "\\left", "\\right", "~"}
_CLOSES = {"(": ")", "[": "]", "{": "}", "\\langle": "\\rangle"}


class NotRead(Exception):
    """A part of a formula that is in words, or has a symbol without a value; the message says which."""


def tokens(formula: str) -> list[str]:
    """The commands, letters, digits and signs of a formula; words in one."""
    formula = re.sub(r"\\text\{[^{}]*\}", lambda found: r"\words ", formula)
    return [token for token in _TOKEN.findall(formula) if token not in _SILENT]


def parts(formula: str) -> list[list[str]]:
    """The parts between commas, semicolons and colons that stand in no bracket; without a full stop."""
    found: list[list[str]] = [[]]
    inside: list[str] = []
    for token in tokens(formula):
        if token in _CLOSES:
            inside.append(_CLOSES[token])
        elif inside and token == inside[-1]:
            inside.pop()
        if token in (",", ";", ":") and not inside:
            found.append([])
        else:
            found[-1].append(token)
    return [part for part in found if part]


def equations(part: Sequence[str], reader: "Reader") -> list[tuple[Value, Value]]:
    """The equations of a part, a = b = c as two; raises NotRead."""
    if "=" not in part and "\\equiv" not in part:
        raise NotRead("it has no equation")
    sides: list[list[str]] = [[]]
    for token in part:
        if token in ("=", "\\equiv"):
            sides.append([])
        else:
            sides[-1].append(token)
    values = [reader.read(side) for side in sides]
    return list(pairwise(values))


class Reader:
    """Reads expressions in the values of a glossary."""

    def __init__(self, glossary: Sequence[Sequence[Any]], transposes: Mapping[str, Tree] | None = None):
        values = {tuple(tokens(symbol)): (_rank(value), value) for symbol, _, value in glossary}
        self.values = dict(sorted(values.items(), key=lambda item: -len(item[0])))
        self.transposes = transposes
        self.root: Tree | None = None  # what stands under the root
        self.both = False  # whether it has both signs
        self._left: list[str] = []

    def read(self, side: Sequence[str]) -> Value:
        """The value of an expression; raises NotRead."""
        self._left = [*side]
        found = self._sum()
        if self._left:
            raise NotRead(f"{self._left[0]} is not read")
        return found

    def _next(self) -> str:
        return self._left[0] if self._left else ""

    def _take(self, token: str) -> None:
        if self._next() != token:
            raise NotRead(f"{token} is missing")
        self._left.pop(0)

    def _sum(self) -> Value:
        total: Value | None = None
        while total is None or self._next() in ("+", "-", "\\pm"):
            sign = self._left.pop(0) if self._next() in ("+", "-", "\\pm") else "+"
            term = self._product()
            if sign == "-":
                term = _each(term, lambda tree: times(-1, tree))
            self.both |= sign == "\\pm"
            total = term if total is None else _sum(total, term)
        return total

    def _product(self) -> Value:
        """Factors side by side, and products of vectors, which bind less."""
        found = self._juxtaposed()
        while self._next() in ("\\times", "\\wedge"):
            sign = self._left.pop(0)
            other = self._juxtaposed()
            found = _cross(found, other) if sign == "\\times" else self._wedge(found, other)
        return found

    def _juxtaposed(self) -> Value:
        found = self._power()
        while self._next() not in ("", "+", "-", "\\pm", "\\times", "\\wedge", ",", *_CLOSES.values()):
            found = self._times(found, self._power())
        return found

    def _power(self) -> Value:
        found = self._atom()
        while self._next() == "^":
            self._left.pop(0)
            exponent = "".join(self._argument())
            if exponent == "T":
                found = self._transposed(found)
            elif re.fullmatch(r"-?[1-9]", exponent):
                found = _power(found, int(exponent))
            else:
                raise NotRead(f"the power {exponent} is not read")
        return found

    def _argument(self) -> list[str]:
        """What stands in braces, or one token with what it is applied to."""
        if self._next() != "{":
            if not self._left:
                raise NotRead("something is missing at the end")
            for symbol in self.values:
                if symbol[0].startswith("\\") and tuple(self._left[: len(symbol)]) == symbol:
                    taken, self._left = self._left[: len(symbol)], self._left[len(symbol) :]
                    return taken
            return [self._left.pop(0)]
        depth, taken = 0, []
        while self._left:
            token = self._left.pop(0)
            depth += {"{": 1, "}": -1}.get(token, 0)
            taken.append(token)
            if not depth:
                return taken[1:-1]
        raise NotRead("a brace is not closed")

    def _inside(self, argument: list[str]) -> Value:
        outside, self._left = self._left, argument
        found = self._sum()
        if self._left:
            raise NotRead(f"{self._left[0]} is not read")
        self._left = outside
        return found

    def _atom(self) -> Value:
        for symbol in self.values:
            if tuple(self._left[: len(symbol)]) == symbol:
                self._left = self._left[len(symbol) :]
                return self.values[symbol]
        token = self._left.pop(0) if self._left else ""
        if token.isdigit():
            while self._next().isdigit():
                token += self._left.pop(0)
            return 0, int(token)
        if token in ("\\frac", "\\tfrac"):
            above = self._inside(self._argument())
            return self._times(above, _power(self._inside(self._argument()), -1))
        if token == "\\sqrt":
            _, under = _number(self._inside(self._argument()))
            if self.root not in (None, under):
                raise NotRead("it has two roots")
            self.root = under
            return 0, ROOT
        if token == "\\mathrm" and self._left[:6] == [*"{diag}"]:
            self._left = self._left[6:]
            entries = [_number(entry)[1] for entry in self._list("(")]
            return 2, [[x if i == j else 0 for j in range(len(entries))] for i, x in enumerate(entries)]
        if token in _CLOSES:
            self._left.insert(0, token)
            return self._bracket(token)
        raise NotRead(f"{token or 'an end'} has no value")

    def _bracket(self, token: str) -> Value:
        inside = self._list(token)
        if token == "\\langle":
            if len(inside) != 2 or {rank for rank, _ in inside} != {1}:
                raise NotRead("a product of vectors has not two vectors")
            return 0, plus(*(times(x, y) for x, y in zip(inside[0][1], inside[1][1], strict=True)))
        if token == "[" and len(inside) == 2:
            a, b = inside
            return _sum(self._times(a, b), _each(self._times(b, a), lambda tree: times(-1, tree)))
        if token == "(" and len(inside) > 1:
            return 1, [_number(entry)[1] for entry in inside]
        if len(inside) != 1:
            raise NotRead("a list is not read")
        return inside[0]

    def _list(self, token: str) -> list[Value]:
        self._take(token)
        found = [self._sum()]
        while self._next() == ",":
            self._left.pop(0)
            found.append(self._sum())
        self._take(_CLOSES[token])
        return found

    def _times(self, a: Value, b: Value) -> Value:
        (rank, left), (other, right) = a, b
        if not rank:
            return _each(b, lambda tree: times(left, tree))
        if not other:
            return _each(a, lambda tree: times(tree, right))
        if rank == 2 and other == 1:
            return 1, [_dot(row, right) for row in left]
        if rank == other == 2:
            columns = list(zip(*right, strict=True))
            return 2, [[_dot(row, column) for column in columns] for row in left]
        raise NotRead("two vectors stand side by side")

    def _transposed(self, a: Value) -> Value:
        if a[0] == 1:
            return a  # a column that is printed as a row
        if a[0] == 2:
            return 2, [list(row) for row in zip(*a[1], strict=True)]
        if self.transposes is None:
            raise NotRead("a number is transposed")
        return 0, _transposed(a[1], self.transposes)

    def _wedge(self, a: Value, b: Value) -> Value:
        row = self._transposed(b)
        if b[0] or a[0] or not isinstance(row[1], str):
            raise NotRead("a wedge is of words, the second of them a letter")
        if b[1].endswith("^T"):
            row, b = b, row
        other = times(b[1], self._transposed(a)[1])
        return 0, plus(times(a[1], row[1]), times(-1, other))


def plus(*trees: Tree) -> Tree:
    """A sum."""
    kept = [tree for tree in trees if tree != 0]
    return ["+", *kept] if len(kept) > 1 else kept[0] if kept else 0


def times(*trees: Tree) -> Tree:
    """A product."""
    kept = [tree for tree in trees if tree != 1]
    if 0 in kept:
        return 0
    return ["*", *kept] if len(kept) > 1 else kept[0] if kept else 1


def _rank(value: Any) -> int:
    """0 of a tree, 1 of a vector, 2 of a matrix."""
    if not isinstance(value, list) or value[:1] in (["+"], ["*"], ["^"]):
        return 0
    return 1 + max(map(_rank, value), default=0)


def _number(a: Value) -> Value:
    if a[0]:
        raise NotRead("a vector stands where a number must")
    return a


def _each(a: Value, of: Any) -> Value:
    rank, value = a
    return rank, of(value) if not rank else [_each((rank - 1, x), of)[1] for x in value]


def _sum(a: Value, b: Value) -> Value:
    if a == (0, 0) or b == (0, 0):
        return b if a == (0, 0) else a
    if a[0] != b[0]:
        raise NotRead("a number is added to a vector")
    if not a[0]:
        return 0, plus(a[1], b[1])
    return a[0], [_sum((a[0] - 1, x), (a[0] - 1, y))[1] for x, y in zip(a[1], b[1], strict=True)]


def _dot(row: Sequence[Tree], column: Sequence[Tree]) -> Tree:
    return plus(*(times(x, y) for x, y in zip(row, column, strict=True)))


def _cross(a: Value, b: Value) -> Value:
    if a[0] != 1 or b[0] != 1 or len(a[1]) != 3 or len(b[1]) != 3:
        raise NotRead("a cross product is not of two vectors")
    (x, y, z), (u, v, w) = a[1], b[1]
    minus = [(y, w, z, v), (z, u, x, w), (x, v, y, u)]
    return 1, [plus(times(p, q), times(-1, r, s)) for p, q, r, s in minus]


def _power(a: Value, power: int) -> Value:
    rank, value = a
    if not rank:
        return (0, 1) if value == 1 else (0, ["^", value, power])
    if rank == 2 and all(x == 0 for i, row in enumerate(value) for j, x in enumerate(row) if i != j):
        return 2, [
            [_power((0, x), power)[1] if i == j else 0 for j, x in enumerate(row)] for i, row in enumerate(value)
        ]
    raise NotRead("a power of what is neither a number nor a diagonal matrix")


def _transposed(tree: Tree, transposes: Mapping[str, Tree]) -> Tree:
    """Of a word: each product turned round, each letter by its transpose; parameters stay."""
    if isinstance(tree, list):
        if tree[0] == "^":
            return ["^", _transposed(tree[1], transposes), tree[2]]
        found = [_transposed(part, transposes) for part in tree[1:]]
        return [tree[0], *(found[::-1] if tree[0] == "*" else found)]
    return transposes.get(tree, tree) if isinstance(tree, str) else tree


def check_form(data: Any, names: Collection[str]) -> None:
    """Raises Rejected unless each symbol stands in the glossary once, with a meaning, and a value in these names."""
    seen = set()
    for one in many(data, "the glossary"):
        sized(one, 3, "the glossary")
        for said in one[:2]:
            text(said, "the glossary")
        seen.add(tuple(tokens(one[0])))
        value = one[2]
        trees = [value] if not _rank(value) else value if _rank(value) == 1 else [x for row in value for x in row]
        for tree in trees:
            check_tree(tree, names, f"the glossary, in {one[0]},")
    if len(seen) < len(data) or () in seen:
        raise Rejected("the glossary has a symbol twice")


def read(data: Mapping[str, Any]) -> tuple[int, int]:
    """How many parts of the formulas of a claim the glossary reads, and how many are in words."""
    counts = [bool(part.count("\\words")) for _, part in printed_parts(data)]
    return counts.count(False), counts.count(True)


def printed_parts(data: Mapping[str, Any]) -> list[tuple[str, list[str]]]:
    """The parts of what is printed and of what is corrected, each with its role; none where there is no glossary."""
    if not data["glossary"]:
        return []
    formulas = {"printed": data["printed"], "corrected": data["corrected"] or ""}
    return [(role, part) for role, formula in formulas.items() for part in parts(formula)]


def check(data: Mapping[str, Any], algebras: Sequence[Algebra | Quotients], defined: Mapping[str, Made]) -> None:
    """Raises Rejected unless each equation of a part that is not in words is a statement of that role."""
    for role, part in printed_parts(data):
        if "\\words" in part:
            continue
        stated = [one for one in data["statements"] if one["role"] == role]
        why, found = "nothing of that role is decided", False
        for kind in dict.fromkeys(one["algebra"] for one in stated):
            algebra = data["algebras"][kind]
            reader = Reader(data["glossary"], dict(algebra["transposes"]) if "transposes" in algebra else None)
            among = [one for one in stated if one["algebra"] == kind]
            try:
                sides = equations(part, reader)
                found |= all(any(_is(pair, one, algebras[kind], defined, reader) for one in among) for pair in sides)
                why = "it is not what was decided"
            except NotRead as error:
                why = str(error)
        if not found:
            raise Rejected(f"the {role} formula {''.join(part):.80} is not read: {why}")


def _is(
    pair: tuple[Value, Value],
    one: Mapping[str, Any],
    algebra: Algebra | Quotients,
    made: Mapping[str, Made],
    reader: Reader,
) -> bool:
    """Whether an equation, entry by entry, is that of a statement, and has two different sides.

    In a quotient the numerators of the differences must be multiples of each other by numbers: then both equations say
    the same where no denominator vanishes.
    """
    lefts, rights = map(_entries, pair)
    most = max(len(lefts), len(rights))
    lefts, rights = (side * most if side == [0] else side for side in (lefts, rights))
    if not len(lefts) == len(rights) == len(one["left"]) or lefts == rights or one["left"] == one["right"]:
        return False
    local = one.get("definitions", [])
    trees = [*lefts, *rights, *one["left"], *one["right"], *(tree for _, tree in local)]
    if names_in([0, *trees]) - algebra.names.keys() - made.keys() - {name for name, _ in local} - {ROOT}:
        return False
    if isinstance(algebra, Algebra):
        return _same_words(lefts, rights, one, algebra, derivation.named(trees, algebra, made, "a formula"))
    if reader.root is not None:
        if not reader.both and "refuted" not in one:
            return False  # the square of an equation is true where its negative is
        algebra = _with_root(algebra)
        trees.append(reader.root)
    names = dict(derivation.entries(trees, made)) if reader.root is None else {}
    for name, tree in local:
        names[name] = algebra.read(tree, names)
    said = [_squared(algebra.read(a, names) - algebra.read(b, names), algebra, names, reader.root)
            for a, b in zip(lefts, rights, strict=True)]  # fmt: skip
    decided = [(algebra.read(a, names) - algebra.read(b, names)).numerator
               for a, b in zip(one["left"], one["right"], strict=True)]  # fmt: skip
    return all(_proportional(_rest(a), _rest(b)) for a, b in zip(said, decided, strict=True))


def _same_words(
    lefts: list[Tree], rights: list[Tree], one: Mapping[str, Any], algebra: Algebra, names: Mapping[str, Words]
) -> bool:
    """Whether the differences of both are equal by the rules, or of opposite signs."""

    def less(a: Tree, b: Tree) -> Words:
        return algebra.read(a, names) - algebra.read(b, names)

    said, decided = (list(map(less, *sides)) for sides in ((lefts, rights), (one["left"], one["right"])))
    return any(
        not any(
            algebra.total([x, algebra.scalar(algebra.none, sign) * y]).terms for x, y in zip(said, decided, strict=True)
        )
        for sign in (Fraction(1), Fraction(-1))
    )


def _with_root(ring: Quotients) -> Quotients:
    """The ring with a variable for a root, without its relations."""
    return quotients({"relations": []}, Ring([*ring.ring.variables, ROOT], ring.ring.work))


def _squared(of: Quotient, ring: Quotients, names: Mapping[str, Quotient], under: Tree | None) -> Polynomial:
    """The numerator; where it is P + Q·root, that of P² - Q²·(what is under the root)."""
    if under is None:
        return of.numerator
    shift = FIELD * (len(ring.ring.variables) - 1)
    halves: list[dict[int, int]] = [{}, {}]
    for monomial, c in of.numerator.terms.items():
        if monomial >> shift > 1:
            raise NotRead("it is not linear in its root")
        halves[monomial >> shift][monomial & (1 << shift) - 1] = c
    p, q = (Quotient(Polynomial(ring.ring, half, of.numerator.degree, of.numerator.bits), 1, {}) for half in halves)
    return (p * p - q * q * ring.read(under, names)).numerator


def _rest(of: Polynomial) -> Polynomial:
    """Without the factors by which something is divided."""
    for factor in of.ring.factors:
        while of.terms and (smaller := _divided(of, factor)) is not None:
            of = smaller
    return of


def _divided(a: Polynomial, b: Polynomial) -> Polynomial | None:
    """a/b, where b has no common divisor of its coefficients; None where b does not divide a."""
    fields = range(0, FIELD * len(a.ring.variables), FIELD)
    lead, rest, quotient = max(b.terms), a, a.ring.constant(0)
    while rest.terms:
        first = max(rest.terms)
        over, more = divmod(rest.terms[first], b.terms[lead])
        if more or any((first >> i & 0xFFFF) < (lead >> i & 0xFFFF) for i in fields):
            return None
        term = Polynomial(a.ring, {first - lead: over}, a.degree, over.bit_length())
        quotient, rest = quotient + term, rest + (term * b).times(-1)
    return quotient


def _proportional(a: Polynomial, b: Polynomial) -> bool:
    """Whether two polynomials are multiples of each other by numbers other than 0."""
    if a.terms.keys() != b.terms.keys():
        return False
    first = next(iter(a.terms), None)
    return first is None or a.times(b.terms[first]).terms == b.times(a.terms[first]).terms


def _entries(side: Value) -> list[Tree]:
    rank, value = side
    return [value] if not rank else list(value) if rank == 1 else [x for row in value for x in row]
