"""Whether the formulas of a claim, read by its glossary, are what was decided."""

from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from typing import Any

from . import derivation
from .algebra import Algebra
from .derivation import Made
from .form import many, sized, text
from .formulas import (
    ROOT,
    WORDS,
    NotRead,
    Reader,
    Tree,
    Value,
    entries,
    equations,
    parts,
    plus,
    rank_of,
    times,
    tokens,
    transposed,
)
from .interval import Rejected
from .matrices import Quotients, quotients
from .polynomial import FIELD, Polynomial, Quotient, Ring
from .trees import check_tree, names_in
from .words import Words


def check_form(data: Any, names: Collection[str]) -> None:
    """Raises Rejected unless each symbol stands in the glossary once, with a meaning, and a value in these names."""
    seen = set()
    for one in many(data, "the glossary"):
        sized(one, 3, "the glossary")
        for said in one[:2]:
            text(said, "the glossary")
        seen.add(tuple(tokens(one[0])))
        value = one[2]
        trees = [value] if not rank_of(value) else value if rank_of(value) == 1 else [x for row in value for x in row]
        for tree in trees:
            check_tree(tree, names, f"the glossary, in {one[0]},")
    if len(seen) < len(data) or () in seen:
        raise Rejected("the glossary has a symbol twice")


def read(data: Mapping[str, Any]) -> tuple[int, int]:
    """How many parts of the formulas of a claim the glossary reads, and how many are in words."""
    counts = [WORDS in part for _, part in printed_parts(data)]
    return counts.count(False), counts.count(True)


def printed_parts(data: Mapping[str, Any]) -> list[tuple[str, list[str]]]:
    """The parts of what is printed and of what is corrected, each with its role; none where there is no glossary."""
    if not data["glossary"]:
        return []
    formulas = {"printed": data["printed"], "corrected": data["corrected"] or ""}
    return [(role, part) for role, formula in formulas.items() for part in parts(formula)]


def check(data: Mapping[str, Any], algebras: Sequence[Algebra | Quotients], defined: Mapping[str, Made]) -> int:
    """Raises Rejected unless each equation of a part that is not in words is a statement of that role, or an identity.

    Where no part is in words, each printed statement that is refuted must be one of these equations.  Returns how many
    parts hold by the glossary alone.
    """
    alone = 0
    found: set[int] = set()
    wordless = {"printed", "corrected"}
    for role, part in printed_parts(data):
        if WORDS in part:
            wordless.discard(role)
            continue
        why, read, matched = "nothing of that role is decided", False, False
        stated = {i: one for i, one in enumerate(data["statements"]) if one["role"] == role}
        for kind in dict.fromkeys(one["algebra"] for one in stated.values()):
            algebra, among = data["algebras"][kind], {i: one for i, one in stated.items() if one["algebra"] == kind}
            reader = Reader(data["glossary"], _transposes(algebra))
            try:
                sides = equations(part, reader)
                each = [_statements(pair, among, algebras[kind], defined, reader) for pair in sides]
            except NotRead as error:
                why = str(error)
                continue
            why = "it is not what was decided"
            if None not in each:
                read, found, matched = True, found.union(*filter(None, each)), matched or any(each)
        alone += not matched
        if not read:
            raise Rejected(f"the {role} formula {''.join(part):.80} is not read: {why}")
    refuted = {i for i, one in enumerate(data["statements"]) if "refuted" in one}
    if data["glossary"] and "printed" in wordless and not refuted <= found:
        raise Rejected("a printed statement is refuted that the printed formula does not have")
    return alone


def _transposes(algebra: Mapping[str, Any]) -> dict[str, Tree] | None:
    """What each name of an algebra of words is, transposed; parameters are numbers."""
    if algebra["kind"] == "quotient":
        return None
    return {name: name for name in algebra["parameters"]} | dict(algebra["transposes"])


def _statements(
    pair: tuple[Value, Value],
    among: Mapping[int, Any],
    algebra: Algebra | Quotients,
    made: Mapping[str, Made],
    reader: Reader,
) -> set[int] | None:
    """Which statements an equation is, entry by entry; none if it is an identity; None if it is neither.

    In a quotient the numerators of the differences must be multiples of each other by numbers, but for factors by which
    something is divided: then both equations say the same where no denominator vanishes.
    """
    lefts, rights = map(entries, pair)
    most = max(len(lefts), len(rights))
    lefts, rights = (side * most if side == [0] else side for side in (lefts, rights))
    zeros = entries((rank_of(reader.zero), reader.zero))
    zeros = zeros if len(zeros) == most else [0] * most
    if len(lefts) != len(rights):
        return None
    if names_in([0, *lefts, *rights, *zeros]) - algebra.names.keys() - made.keys() - {ROOT}:
        raise NotRead("the glossary gives a symbol a value of another algebra")
    vanishing = [zeros] if any(zeros) else []
    with suppress(NotRead):
        vanishing += [[transposed(z, reader.transposes) for z in one] for one in vanishing if reader.transposes]
    readings = [list(zip(lefts, rights, strict=True))]
    for more in vanishing:
        readings += [
            [(plus(a, times(sign, z)), b) for a, b, z in zip(lefts, rights, more, strict=True)] for sign in (1, -1)
        ]
    of: Any = _InWords(algebra, made) if isinstance(algebra, Algebra) else _InRing(algebra, made, reader)
    found: set[int] = set()
    identity = False
    for sides in readings:
        said = of.differences(sides)
        identity |= not any(x.terms for x in said)
        found |= {
            i
            for i, one in among.items()
            if len(one["left"]) == most and one["left"] != one["right"] and of.is_said(said, one)
        }
    return found if identity or found else None


class _InWords:
    """Compares differences of words, by the rules."""

    def __init__(self, algebra: Algebra, made: Mapping[str, Made]):
        self.algebra, self.made = algebra, made

    def differences(self, sides: Sequence[tuple[Tree, Tree]]) -> list[Words]:
        """Left - right, by the rules."""
        of = derivation.named([tree for pair in sides for tree in pair], self.algebra, self.made, "a formula")
        return [self.algebra.total([self.algebra.read(a, of) - self.algebra.read(b, of)]) for a, b in sides]

    def is_said(self, said: list[Words], one: Mapping[str, Any]) -> bool:
        """Whether differences are those of a statement, or their negatives."""
        decided = self.differences(list(zip(one["left"], one["right"], strict=True)))
        pairs = list(zip(said, decided, strict=True))
        return all(x.terms == y.terms for x, y in pairs) or all(not (x + y).terms for x, y in pairs)


class _InRing:
    """Compares numerators of differences; those of equations with a root after squaring."""

    def __init__(self, ring: Quotients, made: Mapping[str, Made], reader: Reader):
        self.ring = ring if reader.root is None else _with_root(ring)
        self.made, self.reader = made, reader

    def differences(self, sides: Sequence[tuple[Tree, Tree]], local: Sequence[Any] = ()) -> list[Polynomial]:
        """The numerators of left - right; `local`: names for parts, with their trees."""
        trees = [*(tree for pair in sides for tree in pair), *(tree for _, tree in local)]
        names = dict(derivation.entries(trees, self.made))
        for name, tree in local:
            names[name] = self.ring.read(tree, names)
        return [
            _squared(self.ring.read(a, names) - self.ring.read(b, names), self.ring, self.reader.root) for a, b in sides
        ]

    def is_said(self, said: list[Polynomial], one: Mapping[str, Any]) -> bool:
        """Whether numerators are multiples of those of a statement."""
        if self.reader.root is not None and not self.reader.both and "refuted" not in one:
            return False  # the square of an equation is true where its negative is
        decided = self.differences(list(zip(one["left"], one["right"], strict=True)), one.get("definitions", []))
        return all(proportional(_rest(a), _rest(b)) for a, b in zip(said, decided, strict=True))


def _with_root(ring: Quotients) -> Quotients:
    """The ring with a variable for a root, without its relations."""
    return quotients({"relations": []}, Ring([*ring.ring.variables, ROOT], ring.ring.work))


def _squared(of: Quotient, ring: Quotients, under: Tree | None) -> Polynomial:
    """The numerator; where it is P + Q·root, that of P² - Q²·(what is under the root)."""
    if under is None:
        return of.numerator
    shift = FIELD * (len(ring.ring.variables) - 1)
    halves: list[dict[int, int]] = [{}, {}]
    for monomial, c in of.numerator.terms.items():
        if monomial >> shift > 1:
            raise NotRead("it is not linear in its root")
        halves[monomial >> shift][monomial & (1 << shift) - 1] = c
    if not halves[1]:
        return of.numerator
    p, q = (Quotient(Polynomial(ring.ring, half, of.numerator.degree, of.numerator.bits), 1, {}) for half in halves)
    return (p * p - q * q * ring.read(under)).numerator


def _rest(of: Polynomial) -> Polynomial:
    """Without the factors by which something is divided."""
    for factor in _parts(of.ring):
        while of.terms and (smaller := _divided(of, factor)) is not None:
            of = smaller
    return of


def _parts(ring: Ring) -> list[Polynomial]:
    """The factors of all denominators, each without those before it that divide it, the shortest first."""
    found: list[Polynomial] = []
    for factor in sorted(ring.factors, key=lambda p: len(p.terms)):
        for known in found:
            while (smaller := _divided(factor, known)) is not None:
                factor = smaller
        if factor.terms.keys() != {0}:
            found.append(factor)
    return found


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


def proportional(a: Polynomial, b: Polynomial) -> bool:
    """Whether two polynomials are multiples of each other by numbers other than 0."""
    if a.terms.keys() != b.terms.keys():
        return False
    first = next(iter(a.terms), None)
    return first is None or a.times(b.terms[first]).terms == b.times(a.terms[first]).terms
