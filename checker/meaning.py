"""The comparison of the formulas of a claim, read by its glossary, with what the certificate decides."""

from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from functools import cache
from heapq import heapify, heappop, heappush
from typing import Any

from . import derivation
from .algebra import Algebra
from .derivation import Defined
from .document import Data
from .form import check_rows, check_shape
from .formulas import (
    ROOT,
    WORDS,
    NotRead,
    Reader,
    Tree,
    Value,
    entries,
    is_symbol,
    parts,
    plus,
    rank_of,
    relations,
    times,
    tokens,
    transposed,
)
from .interval import Rejected
from .matrices import Quotients
from .polynomial import FIELD, Polynomial, Quotient
from .trees import check_known, check_tree, names_in, value

#: The most symbols of a glossary, and letters of a symbol.
MOST_SYMBOLS, MOST_LETTERS = 100, 80


def check_form(data: Any, names: Collection[str]) -> None:
    """Raises Rejected unless the symbols of the glossary are valid and different, with values in these names."""
    seen = set()
    for one in data:
        if len(one[0]) > MOST_LETTERS or not is_symbol(one[0]):
            raise Rejected(f"the glossary has {one[0]!a:.60}, which is no symbol")
        seen.add(tuple(tokens(one[0])))
        of, rank = one[2], rank_of(one[2])
        if isinstance(of, dict) and one[0] != "0":
            check_shape(of, {"trace": check_tree}, f"the glossary, in {one[0]},")
            of = of["trace"]
        rows = of if rank == 2 else [of] if rank == 1 else [[of]]
        check_rows(rows, check_tree, f"the glossary, in {one[0]},")
        check_known([tree for row in rows for tree in row], names, f"the glossary, in {one[0]},")
    plain = {tuple(token for token in symbol if token not in ("{", "}")) for symbol in seen}
    if len(plain) < len(data) or () in plain or len(data) > MOST_SYMBOLS:
        raise Rejected(f"the glossary has a symbol twice, or more than {MOST_SYMBOLS}")
    powers = [symbol for symbol in seen if symbol[-2:-1] == ("^",) and symbol[:-2] in seen]
    if powers:
        raise Rejected(f"the glossary has {''.join(min(powers))}, the power of another symbol")


def read(data: Data) -> tuple[int, int]:
    """The number of parts of the formulas of a claim without words, and the number with words."""
    formulas = [data["printed"], data["corrected"] or ""] if data["glossary"] else []
    counts = [WORDS in part for formula in formulas for part in parts(formula)]
    return counts.count(False), counts.count(True)


def check(data: Data, among: "Sequence[Comparer]") -> dict[str, int]:
    """Raises Rejected unless the formulas of a claim, where they are read, agree with what is decided.

    Each part without words is a decided item of its role, or an identity by the glossary alone; no two parts are the
    same item.  Items that no part states are marked as said in words; there are no more of them than parts in words.
    If items are refuted, a part states one of them.  Returns the number of parts that are identities, and the number
    of items left to words.
    """
    alone = left = read = 0
    for role in ("printed", "corrected") if data["glossary"] else ():
        all_parts = parts(data[role] or "")
        plain = [part for part in all_parts if WORDS not in part]
        decided, found, identities = said(role, data, among)
        unsaid = {i for i in range(len(decided)) if i not in found}
        if wrong := unsaid ^ {i for i, one in enumerate(decided) if one.get("words")}:
            does = "says in words" if unsaid < unsaid | wrong else "does not say"
            raise Rejected(
                f"the {role} formula is not one that {does} what is decided: {decided[min(wrong)]['text']:.100}"
            )
        false = {i for i, one in enumerate(decided) if is_false(one)}
        if plain and decided and not (found & false if false else found):
            raise Rejected(f"no part of the {role} formula is what is {'refuted' if false else 'decided'}")
        if plain and len(unsaid) > len(all_parts) - len(plain):
            raise Rejected(f"the {role} formula has fewer parts in words than statements left to them")
        alone, left, read = alone + identities, left + len(unsaid), read + len(found)
    if data["glossary"] and not read and data["verdict"] != "definition":
        raise Rejected("no part of a formula is what is decided")
    return {"true by the glossary alone": alone, "said by words of a formula": left}


def said(role: str, data: Data, among: "Sequence[Comparer]") -> tuple[list[Any], set[int], int]:
    """The decided items of a role, the indices of those that its formula states, and the number of identities."""
    decided = [one for name in DECIDED for one in data[name] if one["role"] == role]
    found, alone, before = set[int](), 0, list[Sequence[str]]()
    if data[role] is not None and not parts(data[role]):
        raise Rejected(f"the {role} formula has no part")
    for part in parts(data[role] or ""):
        if WORDS in part:
            if any(token in part for token in ("=", "\\equiv", "\\to")):
                raise Rejected(f"the {role} formula has an equation and words in one part")
            continue
        read = _part(part, role, decided, data, among)
        if part in before or read & found:
            raise Rejected(f"a part of the {role} formula, {''.join(part):.80}, says what another part says")
        before.append(part)
        found |= read
        alone += not read
    return decided, found, alone


#: The lists of a certificate with items that a formula may state.
DECIDED = ("statements", "comparisons", "counts", "zeros", "rests", "sentences")


def is_false(one: Data) -> bool:
    """Whether an item, or a sentence, says that the printed formula is false."""
    sentence = (
        one.keys() <= {"role", "text", "words"} and one["role"] == "printed" and one["text"].startswith("false: ")
    )
    return "refuted" in one or one.get("holds") is False or sentence


def _part(part: Sequence[str], role: str, decided: Sequence[Data], data: Data, among: "Sequence[Comparer]") -> set[int]:
    """The indices of the decided items that a part states, in a single algebra or in none; else raises Rejected."""
    why = ""
    stated = {i: one for i, one in enumerate(decided) if "left" in one}
    inferred = any(one["role"] == "inference" for one in data["sentences"])  # from a point to the general case
    compared = {i: one for i, one in enumerate(decided) if "relations" in one and (inferred or is_false(one))}
    for kind in (*(dict.fromkeys(one["algebra"] for one in stated.values()) or range(len(among))), None):
        own = {i: one for i, one in stated.items() if one["algebra"] == kind}
        try:
            return _compared(part, compared, data) if kind is None else _read(part, own, data, kind, among[kind])
        except NotRead as error:
            why = why or str(error)
        except RecursionError:
            why = "it is too deep"
    raise Rejected(f"the {role} formula {''.join(part):.80} is not read: {why}")


def _compared(part: Sequence[str], among: Mapping[int, Data], data: Data) -> set[int]:
    """The comparisons and counts that are the relations of a part, with the same trees."""
    said = [[kind, left, right] for kind, (_, left), (_, right) in relations(part, Reader(data["glossary"]))]
    found = {i for i, one in among.items() if one["relations"] == said}
    if not found:
        raise NotRead("it is not what was decided")
    return found


def _read(part: Sequence[str], among: Mapping[int, Data], data: Data, kind: int, of: "Comparer") -> set[int]:
    """The statements that the equations of a part state, in one algebra; raises NotRead if one states none."""
    algebra = data["algebras"][kind]
    reader = Reader(
        data["glossary"], _transposes(algebra), algebra["parameters"] if algebra["kind"] == "traces" else None
    )
    found: set[int] = set()
    for relation, left, right in relations(part, reader):
        if relation != "=":
            raise NotRead("it is not what was decided")
        of.root = reader.root
        try:
            found |= _statements((left, right), among, of, reader, data)
        finally:
            of.root = None
    return found


def _transposes(algebra: Data) -> dict[str, Tree] | None:
    """The transpose of each name of an algebra of words; parameters are numbers."""
    if algebra["kind"] == "quotient":
        return None
    return {name: name for name in algebra["parameters"]} | dict(algebra["transposes"])


def _statements(
    pair: tuple[Value, Value], among: Mapping[int, Data], of: "Comparer", reader: Reader, data: Data
) -> set[int]:
    """The statements that an equation states, entry by entry; raises NotRead if none and it is no identity.

    In a quotient ring the numerators of the differences, each without the divisors of its own equation, must be
    multiples of each other by numbers: then both are equivalent where no denominator vanishes.  An identity states only
    identities that share a side with it.  If the symbol 0 is used, its value must be a side of the statement.
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
    names = names_in([0, *lefts, *rights, *zeros])
    if not names <= of.names:
        raise NotRead("the glossary gives a symbol a value of another algebra")
    if reader.root is not None:
        positive = [of[2:] for one in data["hypotheses"] for of in one["relations"] if of[:2] == ["<", 0]]
        if not (reader.both or (lefts == [ROOT] and rights in positive) or (rights == [ROOT] and lefts in positive)):
            among = {i: one for i, one in among.items() if "refuted" in one}  # a = -b implies a² = b², too
    among = {i: one for i, one in among.items() if len(one["left"]) == most and one["left"] != one["right"]}
    among = {i: one for i, one in among.items() if _is_nothing(zeros, one, data["counterexamples"])}
    sides = list(zip(lefts, rights, strict=True))
    said, found = of.differences(sides), _saying(sides, among, of)
    if reader.root is None and not any(x.terms for x in said[0]):
        if any(x.terms for x in of.differences(sides, folded=True)[0]):
            return found
        left = of.differences([(a, 0) for a in lefts])
        if any(x.terms for x in left[0]):
            return {i for i in found if of.is_side(left, among[i])}
        # 0 = 0 would match many statements
        return {i for i in found if (lefts, rights) == (among[i]["left"], among[i]["right"])}
    for more in _vanishing(zeros, reader):
        nothing = of.differences([(z, 0) for z in more])
        for sign in (1, -1):
            with_it = [(plus(a, times(sign, z)), b) for (a, b), z in zip(sides, more, strict=True)]
            found |= {i for i in _saying(with_it, among, of) if of.is_side(nothing, among[i])}
    if not found:
        raise NotRead("it is not what was decided")
    return found


def _saying(sides: Sequence[tuple[Tree, Tree]], among: Mapping[int, Data], of: "Comparer") -> set[int]:
    """The statements with the same differences; if these are 0, also before the derived names are expanded."""
    said, made = of.differences(sides), of.differences(sides, folded=True)
    found = {i for i, one in among.items() if of.is_said(said, one)}
    if any(x.terms for x in said[0]):
        return found
    if any(x.terms for x in made[0]):
        return {i for i in found if of.is_said(made, among[i], folded=True)}
    return {i for i in found if not any(x.terms for x in of.stated(among[i], folded=True)[0])}


def _vanishing(zeros: list[Tree], reader: Reader) -> list[list[Tree]]:
    """The values of the symbol 0: the entries, and their transposes."""
    found = [zeros] if any(zeros) else []
    with suppress(NotRead):
        found += [[transposed(z, reader.transposes) for z in one] for one in found if reader.transposes]
    return found


def _is_nothing(zeros: list[Tree], one: Data, examples: Sequence[Data]) -> bool:
    """Whether the value of the symbol 0 vanishes at the counterexample of a statement, if it has only numbers."""
    if "refuted" not in one:
        return True
    point = {name: x for name, x in examples[one["refuted"]]["point"].items() if not isinstance(x, list)}
    numbers = {name: Fraction(x) for name, x in point.items()}
    if not names_in([0, *zeros]) <= numbers.keys():
        return True
    try:
        return all(value(tree, numbers, Fraction) == 0 for tree in zeros)
    except ZeroDivisionError:
        return False


#: Differences of the sides of equations, and their divisors.
Differences = tuple[list[Any], list[Polynomial]]


class Comparer:
    """A comparison of equations between words, or between their traces: their differences, reduced by the rules."""

    root: Tree | None = None  # the radicand in the formula that is read
    folds = True  # whether derived names may be letters

    def __init__(self, algebra: Algebra, made: Mapping[str, Defined], traces: bool):
        self.algebra, self.made, self._settled = algebra, made, algebra.traced if traces else lambda x: x
        self.names = {*algebra.names, *made}  # the names that an equation may have
        self._known: dict[str, Differences] = {}

    def differences(
        self, sides: Sequence[tuple[Tree, Tree]], local: Sequence[Any] = (), folded: bool = False
    ) -> Differences:
        """Left - right; `local`: names for parts, with their trees; `folded`: derived names are letters."""
        if (text := repr((sides, local, folded and self.folds, self.root))) not in self._known:
            self._known[text] = self._differences(sides, local, folded)
        return self._known[text]

    def _differences(self, sides: Sequence[tuple[Tree, Tree]], local: Sequence[Any], folded: bool) -> Differences:
        if self.root is not None:
            raise NotRead("a root is of no words")
        algebra = self.algebra
        of = dict(algebra.names) | {name: algebra.word(name) for name in self.made}
        if not folded:
            of = derivation.named([tree for pair in sides for tree in pair], algebra, self.made, "what is said")
        found = [algebra.total([algebra.read(a, of) - algebra.read(b, of)]) for a, b in sides]
        return [self._settled(x) for x in found], []

    def stated(self, one: Data, side: str = "", folded: bool = False) -> Differences:
        """The differences of a statement, or of one of its sides and 0."""
        sides = [(x, 0) for x in one[side]] if side else list(zip(one["left"], one["right"], strict=True))
        return self.differences(sides, one.get("definitions", ()), folded)

    def is_said(self, said: Differences, one: Data, folded: bool = False) -> bool:
        """Whether differences are equivalent to those of a statement."""
        return self.alike(said, self.stated(one, folded=folded))

    def is_side(self, said: Differences, one: Data) -> bool:
        """Whether differences are equivalent to a side of a statement."""
        return any(self.alike(said, self.stated(one, side)) for side in ("left", "right"))

    def alike(self, said: Differences, decided: Differences) -> bool:
        """Whether two lists of differences are equal, or negatives of each other."""
        pairs = list(zip(said[0], decided[0], strict=True))
        return all(x.terms == y.terms for x, y in pairs) or all(not (x + y).terms for x, y in pairs)


class _InRing(Comparer):
    """A comparison of equations in a quotient ring: the numerators of differences; with a root, after squaring.

    Each numerator may omit the divisors of its own equation; that of a statement, also those of the formula, which is
    meant where they are not 0.
    """

    def __init__(self, ring: Quotients, made: Mapping[str, Defined]):
        self.ring, self.made, self.folds = ring, made, False
        self.names, self._known, self._without = {*ring.names, *made}, {}, cache(_without)

    def _differences(self, sides: Sequence[tuple[Tree, Tree]], local: Sequence[Any], folded: bool) -> Differences:
        trees = [*(tree for pair in sides for tree in pair), *(tree for _, tree in local)]
        ring = self.ring.ring
        ring.used.clear()
        names = dict(derivation.entries(trees, self.made))
        for name, tree in local:
            names[name] = self.ring.read(tree, names)
        found = [self.ring.read(a, names) - self.ring.read(b, names) for a, b in sides]
        numerators = [_squared(x, self.ring, self.root) for x in found]
        return numerators, [ring.factors[i] for i in sorted(ring.used)]

    def alike(self, said: Differences, decided: Differences) -> bool:
        """Whether the numerators are pairwise multiples of each other by numbers."""
        if all(map(proportional, said[0], decided[0])):
            return True
        pairs = zip(said[0], decided[0], strict=True)
        less = self._without
        return all(proportional(less(a, *said[1]), less(b, *decided[1], *said[1])) for a, b in pairs)


def comparers(data: Data, algebras: Sequence[Algebra | Quotients], made: Mapping[str, Defined]) -> list[Comparer]:
    """A comparer of equations for each algebra."""
    own = [{one["name"] for one in data["derivation"] if one["algebra"] == i} for i in range(len(algebras))]
    return [
        Comparer(algebra, made, data["algebras"][i]["kind"] == "traces")
        if isinstance(algebra, Algebra)
        else _InRing(algebra, {name: made[name] for name in own[i] if isinstance(made[name].value, Quotient)})
        for i, algebra in enumerate(algebras)
    ]


def _squared(of: Quotient, ring: Quotients, under: Tree | None) -> Polynomial:
    """The numerator; if it is P + Q·root, the numerator of P² - Q²·radicand."""
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


def _without(of: Polynomial, *divisors: Polynomial) -> Polynomial:
    """The polynomial divided by all powers of the divisors that it has; equivalent where these are not 0."""
    for divisor in divisors:
        while of.terms and (smaller := _divided(of, divisor)) is not None:
            of = smaller
    return of


def _divided(a: Polynomial, b: Polynomial) -> Polynomial | None:
    """a/b, or None if b does not divide a; the coefficients of b must have no common divisor."""
    borrows = sum(1 << FIELD * i + FIELD - 1 for i in range(len(a.ring.variables)))  # a bit that no exponent uses
    lead, rest, quotient = max(b.terms), dict(a.terms), dict[int, int]()
    order = [-monomial for monomial in rest]
    heapify(order)
    while rest:
        first = -heappop(order)
        if first not in rest:
            continue
        over, more = divmod(rest[first], b.terms[lead])
        if more or ((first | borrows) - lead) & borrows != borrows:
            return None
        a.ring.work.spend(len(b.terms))
        quotient[first - lead] = over
        for monomial, c in b.terms.items():
            at = monomial + first - lead
            if at not in rest:
                heappush(order, -at)
            rest[at] = rest.get(at, 0) - over * c
            if not rest[at]:
                del rest[at]
    return Polynomial(a.ring, quotient, a.degree, max(map(int.bit_length, quotient.values())))


def proportional(a: Polynomial, b: Polynomial) -> bool:
    """Whether two polynomials are multiples of each other by non-zero numbers."""
    if a.terms.keys() != b.terms.keys():
        return False
    first = next(iter(a.terms), None)
    return first is None or a.times(b.terms[first]).terms == b.times(a.terms[first]).terms
