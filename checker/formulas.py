r"""A reader of TeX formulas, by a glossary, to compare printed formulas with decided statements.

A glossary is a list of [symbol, meaning, value].  A symbol is any piece of TeX, such as K, \tilde\gamma or R_{k+1}; the
longest match is taken.  A value is a tree, or a list of trees (a vector), or of such lists (a matrix), in the names of
an algebra.  Commas, semicolons, colons and wide spaces separate the parts of a formula.  A part is expressions joined
by = or \equiv, or two joined by \ne, <, >, \le or \ge.  On the left of \to and \mapsto there is one symbol; its value
is the limit or image.  A part with words is not read; a symbol without a value raises NotRead.  Expressions are made of

    a + b   a - b   \pm a   a b   \frac ab   a^n   a^T   ( )   [a, b] = ab - ba   \langle a, b \rangle
    a \times b   a \wedge b = a b^T - b a^T   \sqrt a   \mathrm{diag}(a, b, c)   (a, b, c)^T   a matrix as pmatrix
    \mathrm{tr} a and \langle a, b \rangle = \mathrm{tr} b a^T in an algebra of traces

The value of the symbol 0 is an expression z that vanishes by a premise: then a = b may say that a - b = z or -z.  An
equation with a root is squared: then it may be refuted; it is proved only if \pm precedes the root, or if the root is
one whole side and the other side is positive by a hypothesis.  In an algebra of words a^T uses the transposes of the
letters, and in a \wedge b the transpose of b may be printed for b.  In an algebra of traces each term of both sides has
one trace; its other factors are numbers and parameters.  A symbol may have the value {"trace": tree}.
"""

import re
from collections.abc import Collection, Mapping, Sequence
from itertools import pairwise
from typing import Any

from .trees import Tree, names_in

#: The rank, 0, 1 or 2, and a tree, a vector or a matrix of trees.
Value = tuple[int, Any]
#: The names of a root and a trace, and the token for words; no certificate can contain them.
ROOT, TRACE, WORDS = "\x00root", " trace ", "\x00"
_TOKEN = re.compile(r"\\[A-Za-z]+|\\.|[^\s\\]|\\$", re.ASCII)
#: The form of a symbol: it begins with a letter or a command, or is a bracket with \dots.
_SYMBOL = re.compile(r"\\?[A-Za-z][^=,;:]*|\([^=,;:]*\\dots[^=,;:]*\).*|0|\\dots", re.ASCII)
#: Commands with an argument, which belongs to the same symbol.
_ACCENTS = {"\\mathcal", "\\mathbf", "\\mathrm", "\\mathbb", "\\vec", "\\tilde", "\\bar", "\\dot", "\\widehat"}
#: The most parts of the trees of one equation, and the deepest nesting of brackets.
MOST_PARTS, MOST_BRACKETS = 200_000, 30
#: Tokens without meaning: spaces, and sizes of brackets.
_SILENT = {"\\,", "\\;", "\\!", "\\ ", "\\bigl", "\\bigr", "\\left", "\\right", "~"}
#: Separators of parts; next, the relations between the sides of a part.
_BETWEEN = {",", ";", ":", "\\quad", "\\qquad"}
LIMITS = ("\\to", "\\mapsto")
RELATIONS = dict.fromkeys(("=", "\\equiv", *LIMITS), "=") | {
    "\\ne": "!=", "<": "<", "\\le": "<=", ">": ">", "\\ge": ">=",
}  # fmt: skip
_SIGNS = ("+", "-", "\\pm")
_CLOSES = {"(": ")", "[": "]", "{": "}", "\\langle": "\\rangle"}


class NotRead(Exception):
    """A formula, or a part of it, cannot be read; the message gives the reason."""


def tokens(formula: str) -> list[str]:
    """The commands, letters, digits and signs of a formula; \\text with words becomes one token."""
    formula = re.sub(r"\\text\{[^{}]*[^\W\d_][^{}]*\}", lambda found: f"{WORDS} ", formula)
    return [token for token in _TOKEN.findall(formula) if token not in _SILENT]


def parts(formula: str) -> list[list[str]]:
    """The parts of a formula, separated by commas, semicolons, colons and wide spaces outside brackets."""
    found: list[list[str]] = [[]]
    inside: list[str] = []
    for token in tokens(formula):
        if token in _CLOSES:
            inside.append(_CLOSES[token])
        elif inside and token == inside[-1]:
            inside.pop()
        if token in _BETWEEN and not inside:
            found.append([])
        else:
            found[-1].append(token)
    return [part for part in found if part]


def relations(part: Sequence[str], reader: "Reader") -> list[tuple[str, Value, Value]]:
    """The relations of a part: a = b = c gives two, and > and >= become < and <=; raises NotRead."""
    between = [token for token in part if token in RELATIONS]
    kinds = [RELATIONS[token] for token in between]
    if not kinds or (len(kinds) > 1 and {*kinds} != {"="}):
        raise NotRead("it is neither an equation nor one relation")
    sides = _split(part, RELATIONS)
    values = [reader.read(side) for side in sides]
    if any(token in LIMITS and tuple(side) not in reader.values for token, side in zip(between, sides, strict=False)):
        raise NotRead("a limit is taken of something that is no symbol")
    pairs = zip(kinds, pairwise(values), strict=True)
    return [(kind.replace(">", "<"), *(pair[::-1] if ">" in kind else pair)) for kind, pair in pairs]


def _split(tokens: Sequence[str], between: Collection[str]) -> list[list[str]]:
    """The lists of tokens between separators."""
    found: list[list[str]] = [[]]
    for token in tokens:
        if token in between:
            found.append([])
        else:
            found[-1].append(token)
    return found


def is_symbol(symbol: str) -> bool:
    """Whether a glossary may have this symbol: a letter with accents or indices, without joining signs."""
    plain = re.sub(r"\{[^{}]*\}|\([^()]*\\dots[^()]*\)", "", symbol)
    level, least = 0, 0
    for c in symbol:
        level += {"{": 1, "}": -1}.get(c, 0)
        least = min(least, level)
    return bool(_SYMBOL.fullmatch(symbol)) and not level and not least and not re.search(r"[+\-]|\\n", plain)


class Reader:
    """A reader of expressions, whose symbols have the values of a glossary."""

    def __init__(
        self,
        glossary: Sequence[Sequence[Any]],
        transposes: Mapping[str, Tree] | None = None,
        numbers: Collection[str] | None = None,
    ):
        self.traces: list[Tree] = []  # the arguments of the traces
        self.numbers = numbers  # the parameters, in an algebra of traces
        values = {tuple(tokens(symbol)): (rank_of(value), value) for symbol, _, value in glossary}
        for symbol in [symbol for symbol, (_, value) in values.items() if isinstance(value, dict)]:
            _, value = values.pop(symbol)  # a number, in an algebra of traces only
            values |= {symbol: self._trace((0, value["trace"]))} if numbers is not None else {}
        _, self.zero = values.pop(("0",), (0, 0))  # an expression that vanishes by a premise
        self.values = dict(sorted(values.items(), key=lambda item: -len(item[0])))
        self._symbols: dict[str, list[tuple[str, ...]]] = {}
        for symbol in self.values:
            self._symbols.setdefault(symbol[0], []).append(symbol)
        self.transposes = transposes
        self.root: Tree | None = None  # the radicand
        self.used: set[tuple[str, ...]] = set()
        self.both = False  # whether \pm precedes the root
        self._left: list[str] = []
        self._spent, self._depth = 0, 0

    def read(self, side: Sequence[str]) -> Value:
        """The value of an expression; raises NotRead."""
        self._left = [*side]
        found = self._whole()
        if self.numbers is not None:
            return 0, self._traced(_number(found)[1])
        return found

    def _trace(self, of: Value) -> Value:
        """A new name for the trace of a value."""
        if TRACE in str(of) or self.numbers is None:
            raise NotRead("a trace stands where none can be")
        self.traces.append(_number(of)[1])
        return 0, f"{TRACE}{len(self.traces) - 1}"

    def _traced(self, tree: Tree) -> Tree:
        """The tree whose trace is a sum of traces."""
        if tree == 0:
            return 0
        if isinstance(tree, str) and tree.startswith(TRACE):
            return self.traces[int(tree[len(TRACE) :])]
        if isinstance(tree, list) and tree[0] == "+":
            return plus(*map(self._traced, tree[1:]))
        factors = tree[1:] if isinstance(tree, list) and tree[0] == "*" else []
        inside = [factor for factor in factors if TRACE in str(factor)]
        others = [factor for factor in factors if TRACE not in str(factor)]
        if len(inside) != 1 or not names_in([0, *others]) <= set(self.numbers or ()):
            raise NotRead("a term is no trace")
        return times(*others, self._traced(inside[0]))

    def _next(self) -> str:
        return self._left[0] if self._left else ""

    def _take(self, token: str) -> None:
        if self._next() != token:
            raise NotRead(f"{token} is missing")
        self._left.pop(0)

    def _whole(self) -> Value:
        """The value of all remaining tokens."""
        found = self._sum()
        if self._left:
            raise NotRead(f"{self._left[0]} is not read")
        return found

    def _sum(self) -> Value:
        self._depth += 1
        if self._depth > MOST_BRACKETS:
            raise NotRead("it has too many brackets in brackets")
        total: Value | None = None
        while total is None or self._next() in _SIGNS:
            sign = self._left.pop(0) if self._next() in _SIGNS else "+"
            before = self.root
            term = self._product()
            if sign == "-":
                term = _each(term, lambda tree: times(-1, tree))
            if sign == "\\pm":
                if self.root is before:
                    raise NotRead("± stands before no root")
                self.both = True
            total = term if total is None else _sum(total, term)
        self._depth -= 1
        return self._counted(total)

    def _counted(self, of: Value) -> Value:
        """The value itself; raises NotRead if the values read so far have too many parts."""
        pending = [of[1]]
        while pending:
            tree = pending.pop()
            self._spent += 1
            if self._spent > MOST_PARTS:
                raise NotRead("it is too long")
            if isinstance(tree, list):
                pending += tree
        return of

    def _product(self) -> Value:
        """A product by juxtaposition, or of vectors, which binds less."""
        found = self._juxtaposed()
        while self._next() in ("\\times", "\\wedge"):
            sign = self._left.pop(0)
            left = self._left
            other = self._power() if sign == "\\wedge" else self._juxtaposed()
            turned = left[: len(left) - len(self._left)][-2:] == ["^", "T"]  # a column that is printed as a row
            found = self._counted(_cross(found, other) if sign == "\\times" else self._wedge(found, other, turned))
        return found

    def _juxtaposed(self) -> Value:
        found = self._power()
        while self._next() not in ("", *_SIGNS, "\\times", "\\wedge", ",", *_CLOSES.values()):
            found = self._counted(self._times(found, self._power()))
        return found

    def _power(self) -> Value:
        found = self._atom()
        if self._next() == "^":
            self._left = self._left[1:]
            exponent = "".join(self._argument())
            if exponent == "T":
                found = self._transposed(found)
            elif re.fullmatch(r"-?[1-9]", exponent):
                found = _power(found, int(exponent))
            else:
                raise NotRead(f"the power {exponent} is not read")
            if self._next() == "^":
                raise NotRead("two exponents stand at one place")
        return found

    def _argument(self) -> list[str]:
        """The inside of braces, or one token with its argument."""
        if self._next() != "{":
            if not self._left:
                raise NotRead("something is missing at the end")
            token, self._left = self._left[0], self._left[1:]
            if token not in _ACCENTS:
                return [token]
            braced = self._next() == "{"
            inside = self._argument()
            return [token, "{", *inside, "}"] if braced else [token, *inside]
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
        found = self._whole()
        self._left = outside
        return found

    def _atom(self) -> Value:
        for symbol in self._symbols.get(self._next(), []):
            if tuple(self._left[: len(symbol)]) == symbol:
                self._left = self._left[len(symbol) :]
                self.used.add(symbol)
                return self.values[symbol]
        token = self._left.pop(0) if self._left else ""
        if re.fullmatch("[0-9]", token):
            while re.fullmatch("[0-9]", self._next()):
                token += self._left.pop(0)
            return 0, int(token)
        if token in ("\\frac", "\\tfrac"):
            above = self._inside(self._argument())
            return self._times(above, _power(self._inside(self._argument()), -1))
        if token == "\\sqrt":
            _, under = _number(self._inside(self._argument()))
            if self.root is not None:
                raise NotRead("it has two roots")
            self.root = under if isinstance(under, list) else ["+", under, 0]
            return 0, ROOT
        if token == "\\mathrm" and self._left[:6] == [*"{diag}"]:
            self._left = self._left[6:]
            entries = [_number(entry)[1] for entry in self._list("(")]
            return 2, [[x if i == j else 0 for j in range(len(entries))] for i, x in enumerate(entries)]
        if token == "\\mathrm" and self._left[:4] == [*"{tr}"]:
            self._left = self._left[4:]
            return self._trace(self._power())
        if token == "\\begin" and self._left[:9] == [*"{pmatrix}"]:
            return self._matrix()
        if token in _CLOSES:
            self._left.insert(0, token)
            return self._bracket(token)
        raise NotRead(f"{token or 'an end'} has no value")

    def _matrix(self) -> Value:
        """A matrix with rows separated by \\\\ and entries by &."""
        end = self._left.index("\\end") if "\\end" in self._left else len(self._left)
        cells, self._left = self._left[9:end], self._left[end:]
        for token in ("\\end", *"{pmatrix}"):
            self._take(token)
        rows = [_split(row, "&") for row in _split(cells, ("\\\\",))]
        if len({*map(len, rows)}) > 1:
            raise NotRead("a matrix has rows of different lengths")
        return 2, [[_number(self._inside(cell))[1] for cell in row] for row in rows]

    def _bracket(self, token: str) -> Value:
        inside = self._list(token)
        if token == "\\langle" and self.numbers is not None and len(inside) == 2:
            return self._trace(self._times(inside[1], self._transposed(inside[0])))
        if token == "\\langle":
            if [rank for rank, _ in inside] != [1, 1] or len(inside[0][1]) != len(inside[1][1]):
                raise NotRead("a product of vectors has not two vectors of one length")
            return 0, plus(*(times(x, y) for x, y in zip(inside[0][1], inside[1][1], strict=True)))
        if token == "[" and len(inside) == 2:
            a, b = inside
            return _sum(self._times(a, b), _each(self._times(b, a), lambda tree: times(-1, tree)))
        if token == "(" and len(inside) > 1:
            if self._left[:2] == ["^", "T"]:
                self._left = self._left[2:]
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
            raise NotRead("a vector is transposed")
        if a[0] == 2:
            return 2, [list(row) for row in zip(*a[1], strict=True)]
        if self.transposes is None:
            raise NotRead("a number is transposed")
        return self._counted((0, transposed(a[1], self.transposes)))

    def _wedge(self, a: Value, b: Value, turned: bool) -> Value:
        if a[0] or b[0]:
            raise NotRead("a wedge is of words")
        other = self._transposed(b)
        if turned:
            b, other = other, b
            if names_in(b[1]) & names_in(other[1]):  # a symmetric or skew letter is its own transpose
                raise NotRead("a wedge is with what is no row")
        minus = self._times(b, self._transposed(a))
        return _sum(self._times(a, other), _each(minus, lambda tree: times(-1, tree)))


def plus(*trees: Tree) -> Tree:
    """The sum of trees."""
    kept = [tree for tree in trees if tree != 0]
    return ["+", *kept] if len(kept) > 1 else kept[0] if kept else 0


def times(*trees: Tree) -> Tree:
    """The product of trees."""
    kept = [tree for tree in trees if tree != 1]
    if 0 in kept:
        return 0
    return ["*", *kept] if len(kept) > 1 else kept[0] if kept else 1


def rank_of(value: Any) -> int:
    """The rank of a value: 0 for a tree, 1 for a vector, 2 for a matrix."""
    if not isinstance(value, list) or value[:1] in (["+"], ["*"], ["^"]):
        return 0
    return 2 if any(isinstance(x, list) and x[:1] not in (["+"], ["*"], ["^"]) for x in value) else 1


def _number(a: Value) -> Value:
    if a[0]:
        raise NotRead("a vector stands where a number must")
    return a


def _each(a: Value, of: Any) -> Value:
    rank, value = a
    return rank, of(value) if not rank else [_each((rank - 1, x), of)[1] for x in value]


def _sum(a: Value, b: Value) -> Value:
    if a[0] != b[0]:
        raise NotRead("a number is added to a vector")
    if not a[0]:
        return 0, plus(a[1], b[1])
    if len(a[1]) != len(b[1]):
        raise NotRead("vectors of different lengths are added")
    return a[0], [_sum((a[0] - 1, x), (a[0] - 1, y))[1] for x, y in zip(a[1], b[1], strict=True)]


def _dot(row: Sequence[Tree], column: Sequence[Tree]) -> Tree:
    if len(row) != len(column):
        raise NotRead("a matrix and a vector have different sizes")
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


def transposed(tree: Tree, transposes: Mapping[str, Tree]) -> Tree:
    """The transpose of a word: each product reversed, each name replaced by its transpose."""
    if isinstance(tree, list):
        if tree[0] == "^":
            return ["^", transposed(tree[1], transposes), tree[2]]
        found = [transposed(part, transposes) for part in tree[1:]]
        return [tree[0], *(found[::-1] if tree[0] == "*" else found)]
    if isinstance(tree, str) and not tree.lstrip("-")[:1].isdigit():
        if tree not in transposes:
            raise NotRead(f"the transpose of {tree} is not known")
        return transposes[tree]
    return tree


def entries(side: Value) -> list[Tree]:
    """The trees of a value, row by row."""
    rank, value = side
    return [value] if not rank else list(value) if rank == 1 else [x for row in value for x in row]
