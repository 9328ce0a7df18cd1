"""Whether the formulas of a claim, read by its glossary, are what was decided."""

from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from typing import Any

from . import derivation
from .algebra import Algebra
from .derivation import Made
from .form import check_shape
from .formulas import (
    ROOT,
    WORDS,
    NotRead,
    Reader,
    Tree,
    Value,
    entries,
    equations,
    is_symbol,
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
from .trees import check_known, check_tree, names_in, value
from .words import Words

#: Symbols of a glossary, and letters of each.
MOST_SYMBOLS, MOST_LETTERS = 100, 80


def check_form(data: Any, names: Collection[str]) -> None:
    """Raises Rejected unless the glossary has each symbol once, with a meaning, and a value in these names."""
    seen = set()
    for one in data:
        if len(one[0]) > MOST_LETTERS or not is_symbol(one[0]):
            raise Rejected(f"the glossary has {one[0]!a:.60}, which is no symbol")
        seen.add(tuple(tokens(one[0])))
        rows = one[2] if rank_of(one[2]) == 2 else [one[2]] if rank_of(one[2]) == 1 else [[one[2]]]
        check_shape(rows, [[check_tree]], f"the glossary, in {one[0]},")
        if not 1 <= min(map(len, rows)) == max(map(len, rows)):
            raise Rejected(f"the glossary has for {one[0]} rows of different lengths")
        check_known([tree for row in rows for tree in row], names, f"the glossary, in {one[0]},")
    plain = {tuple(token for token in symbol if token not in ("{", "}")) for symbol in seen}
    if len(plain) < len(data) or () in plain or len(data) > MOST_SYMBOLS:
        raise Rejected(f"the glossary has a symbol twice, or more than {MOST_SYMBOLS}")
    powers = [symbol for symbol in seen if symbol[-2:-1] == ("^",) and symbol[:-2] in seen]
    if powers:
        raise Rejected(f"the glossary has {''.join(min(powers))}, the power of another symbol")


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

    Where no part is in words, what is printed is false only by statements that it has, and each of these that is
    refuted is one of its equations.  Of each role one statement at least is an equation of its formula.  Returns how
    many parts hold by the glossary alone.
    """
    alone = 0
    found: dict[str, set[int]] = {"printed": set(), "corrected": set()}
    all_parts = printed_parts(data)
    for role, part in all_parts:
        if WORDS in part:
            if "=" in part or "\\equiv" in part:
                raise Rejected(f"the {role} formula has an equation and words in one part")
            continue
        why, read = "nothing of that role is decided", None
        stated = {i: one for i, one in enumerate(data["statements"]) if one["role"] == role}
        for kind in dict.fromkeys(one["algebra"] for one in stated.values()):
            among = {i: one for i, one in stated.items() if one["algebra"] == kind}
            try:
                each = _read(part, among, data, kind, algebras[kind], defined)
                read = set().union(*each)
                break
            except (NotRead, RecursionError) as error:
                why = "it is too deep" if isinstance(error, RecursionError) else str(error)
        if read is None:
            raise Rejected(f"the {role} formula {''.join(part):.80} is not read: {why}")
        alone += not read
        found[role] |= read
    if not data["glossary"]:
        return alone
    words = any(WORDS in part for role, part in all_parts if role == "printed")
    refuted = {i for i, one in enumerate(data["statements"]) if "refuted" in one}
    others = [one for one in (*data["comparisons"], *data["counts"]) if "refuted" in one or one.get("holds") is False]
    others += [one for one in data["sentences"] if one["role"] == "printed" and one["text"].startswith("false: ")]
    if not words and (others or not refuted <= found["printed"]):
        raise Rejected("something printed is false that the printed formula does not have")
    for role, formula in (("printed", data["printed"]), ("corrected", data["corrected"])):
        if formula is not None and not any(one == role for one, _ in all_parts):
            raise Rejected(f"the {role} formula has no part")
        if not found[role] and any(one == role and WORDS not in part for one, part in all_parts):
            raise Rejected(f"no part of the {role} formula is a statement that is decided")
    if (
        refuted
        and not refuted & found["printed"]
        and any(WORDS not in part for role, part in all_parts if role == "printed")
    ):
        raise Rejected("no part of the printed formula is a statement that is refuted")
    return alone


def _read(
    part: Sequence[str],
    among: Mapping[int, Any],
    data: Mapping[str, Any],
    kind: int,
    algebra: Algebra | Quotients,
    made: Mapping[str, Made],
) -> list[set[int]]:
    """The statements that the equations of a part are, in one algebra; raises NotRead if one is none of them."""
    if data["algebras"][kind]["kind"] == "traces":
        raise NotRead("it is decided of traces")
    if isinstance(algebra, Quotients):  # only entries of this ring
        own = {one["name"] for one in data["derivation"] if one["algebra"] == kind and one["operation"] == "entry"}
        made = {name: of for name, of in made.items() if name in own}
    reader = Reader(data["glossary"], _transposes(data["algebras"][kind]))
    sides = equations(part, reader)
    return [_statements(pair, among, algebra, made, reader, data["counterexamples"]) for pair in sides]


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
    examples: Sequence[Mapping[str, Any]],
) -> set[int]:
    """Which statements an equation is, entry by entry; raises NotRead if it is none, and no identity.

    In a quotient the numerators of the differences, each without what its own equation divides by, must be multiples of
    each other by numbers: then both say the same where no denominator vanishes.  An identity is a statement that is one
    and has a side of it.  Where what vanishes is used, it must be a side of the statement.
    """
    lefts, rights = map(entries, pair)
    if pair[0][0] != pair[1][0] and (0, 0) not in pair:
        raise NotRead("a number is equal to a vector")
    most = max(len(lefts), len(rights))
    lefts, rights = (side * most if side == [0] else side for side in (lefts, rights))
    zeros = entries((rank_of(reader.zero), reader.zero))
    zeros = zeros if len(zeros) == most else [0] * most
    if len(lefts) != len(rights):
        raise NotRead("its sides have different sizes")
    if lefts == rights:
        return set()
    names = names_in([0, *lefts, *rights, *zeros, reader.root or 0])
    if names - algebra.names.keys() - made.keys() or (reader.root is not None and names & made.keys()):
        raise NotRead("the glossary gives a symbol a value of another algebra")
    if isinstance(algebra, Algebra) and reader.root is not None:
        raise NotRead("a root is of no words")
    of: Any = _InWords(algebra, made) if isinstance(algebra, Algebra) else _InRing(algebra, made, reader)
    among = {i: one for i, one in among.items() if len(one["left"]) == most and one["left"] != one["right"]}
    if reader.root is not None:  # whose ring has no entries of derivations
        among = {
            i: one for i, one in among.items() if made.keys().isdisjoint(names_in([0, *one["left"], *one["right"]]))
        }
    among = {i: one for i, one in among.items() if _is_nothing(zeros, one, examples)}
    sides = list(zip(lefts, rights, strict=True))
    said = of.differences(sides)
    if reader.root is None and not any(x.terms for x in said):
        left = of.differences([(a, 0) for a in lefts])
        return {i for i, one in among.items() if of.is_said(said, one) and of.is_side(left, one)}
    found = {i for i, one in among.items() if of.is_said(said, one)}
    for more in _vanishing(zeros, reader):
        nothing = of.differences([(z, 0) for z in more])
        for sign in (1, -1):
            said = of.differences([(plus(a, times(sign, z)), b) for (a, b), z in zip(sides, more, strict=True)])
            found |= {i for i, one in among.items() if of.is_said(said, one) and of.is_side(nothing, one)}
    if not found:
        raise NotRead("it is not what was decided")
    return found


def _vanishing(zeros: list[Tree], reader: Reader) -> list[list[Tree]]:
    """What vanishes, and its transpose."""
    found = [zeros] if any(zeros) else []
    with suppress(NotRead):
        found += [[transposed(z, reader.transposes) for z in one] for one in found if reader.transposes]
    return found


def _is_nothing(zeros: list[Tree], one: Mapping[str, Any], examples: Sequence[Mapping[str, Any]]) -> bool:
    """Whether what vanishes does so at the counterexample of a statement, where numbers stand for all of it."""
    if "refuted" not in one:
        return True
    point = {name: x for name, x in examples[one["refuted"]]["point"].items() if not isinstance(x, list)}
    trees = [z for z in zeros if z != 0]
    if not names_in([0, *trees]) <= point.keys():
        return True
    numbers = {name: Fraction(x) for name, x in point.items()}
    try:
        return all(value(tree, numbers, Fraction) == 0 for tree in trees)
    except ZeroDivisionError:
        return False


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
        return _alike(said, self.differences(list(zip(one["left"], one["right"], strict=True))))

    def is_side(self, said: list[Words], one: Mapping[str, Any]) -> bool:
        """Whether this is a side of a statement, or its negative."""
        return any(_alike(said, self.differences([(x, 0) for x in one[side]])) for side in ("left", "right"))


def _alike(said: list[Words], decided: list[Words]) -> bool:
    pairs = list(zip(said, decided, strict=True))
    return all(x.terms == y.terms for x, y in pairs) or all(not (x + y).terms for x, y in pairs)


class _InRing:
    """Compares numerators of differences; those of equations with a root after squaring.

    Of each numerator what its own equation divides by may be left out, and of a statement what the formula divides by:
    the formula is said where that is not 0.
    """

    def __init__(self, ring: Quotients, made: Mapping[str, Made], reader: Reader):
        self.ring = ring if reader.root is None else _with_root(ring)
        self.made, self.reader = made, reader
        self.divisors: list[Polynomial] = []  # by which what was read last divides

    def differences(self, sides: Sequence[tuple[Tree, Tree]], local: Sequence[Any] = ()) -> list[Polynomial]:
        """The numerators of left - right; `local`: names for parts, with their trees."""
        trees = [*(tree for pair in sides for tree in pair), *(tree for _, tree in local)]
        ring = self.ring.ring
        ring.used.clear()
        names = dict(derivation.entries(trees, self.made))
        for name, tree in local:
            names[name] = self.ring.read(tree, names)
        found = [self.ring.read(a, names) - self.ring.read(b, names) for a, b in sides]
        numerators = [_squared(x, self.ring, self.reader.root) for x in found]
        self.divisors = [ring.factors[i] for i in sorted(ring.used)]
        return numerators

    def is_said(self, said: list[Polynomial], one: Mapping[str, Any]) -> bool:
        """Whether numerators are multiples of those of a statement."""
        if self.reader.root is not None and not self.reader.both and "refuted" not in one:
            return False  # the square of an equation is true where its negative is
        return self._alike(said, list(zip(one["left"], one["right"], strict=True)), one)

    def is_side(self, said: list[Polynomial], one: Mapping[str, Any]) -> bool:
        """Whether this is a side of a statement, or a multiple of it."""
        return any(self._alike(said, [(x, 0) for x in one[side]], one) for side in ("left", "right"))

    def _alike(self, said: list[Polynomial], sides: Sequence[tuple[Tree, Tree]], one: Mapping[str, Any]) -> bool:
        divisors = self.divisors
        decided = self.differences(sides, one.get("definitions", []))
        more, self.divisors = [*self.divisors, *divisors], divisors
        if all(map(proportional, said, decided)):
            return True
        mine, theirs = _parts(divisors), _parts(more)
        return all(proportional(_without(a, mine), _without(b, theirs)) for a, b in zip(said, decided, strict=True))


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
    degree, bits = of.numerator.degree, of.numerator.bits
    p, q = (Quotient(Polynomial(ring.ring, half, degree, bits), 1, {}) for half in halves)
    return (p * p - q * q * ring.read(under)).numerator


def _without(of: Polynomial, divisors: Sequence[Polynomial]) -> Polynomial:
    """Without what the equation divides by: it says the same where that is not 0."""
    for divisor in divisors:
        while of.terms and (smaller := _divided(of, divisor)) is not None:
            of = smaller
    return of


def _parts(factors: Sequence[Polynomial]) -> list[Polynomial]:
    """Each factor without those before it that divide it, the shortest first."""
    found: list[Polynomial] = []
    for factor in sorted(factors, key=lambda p: len(p.terms)):
        for known in found:
            while (smaller := _divided(factor, known)) is not None:
                factor = smaller
        if factor.terms.keys() != {0}:
            found.append(factor)
    return found


def _divided(a: Polynomial, b: Polynomial) -> Polynomial | None:
    """a/b, where b has no common divisor of its coefficients; None where b does not divide a."""
    borrows = sum(1 << FIELD * i + FIELD - 1 for i in range(len(a.ring.variables)))  # no exponent has this bit
    lead, rest, quotient = max(b.terms), dict(a.terms), a.ring.constant(0)
    while rest:
        first = max(rest)
        over, more = divmod(rest[first], b.terms[lead])
        if more or ((first | borrows) - lead) & borrows != borrows:
            return None
        a.ring.work.spend(len(b.terms))
        quotient = quotient + Polynomial(a.ring, {first - lead: over}, a.degree, over.bit_length())
        for monomial, c in b.terms.items():
            at = monomial + first - lead
            rest[at] = rest.get(at, 0) - over * c
            if not rest[at]:
                del rest[at]
    return quotient


def proportional(a: Polynomial, b: Polynomial) -> bool:
    """Whether two polynomials are multiples of each other by numbers other than 0."""
    if a.terms.keys() != b.terms.keys():
        return False
    first = next(iter(a.terms), None)
    return first is None or a.times(b.terms[first]).terms == b.times(a.terms[first]).terms
