"""Derivations: expressions that are made, step by step, from premises; the statements of a certificate may name them.

A definition has a name, a text, the number of its algebra, an operation, and what that is applied to:

written   a tree, in the letters of the algebra and in names defined before; without such names it is a premise
rate      of a name X, by [letter, tree]...: the derivative of X by Leibniz' rule, where the letters have those rates
replaced  of X, by [letter or parameter, tree]...: X with those in their places, in the algebra of the definition
gradient  of X, by a letter Y: the G with tr X = tr(Gᵀ Y) + (what has neither Y nor its transpose)
dual      of X, by a letter ξ with ξᵀ = -ξ: the S = -Sᵀ with tr X = ½ tr(ξ S), so that tr X = 0 for all ξ if S = 0
having, lacking   of X, by letters: its terms that have one of them, or none; together they are X
matrix, entry     X in coordinates (matrices.py)

It may have its value, as a tree in the names of its algebra, so that a reader need not take the steps.

All this is done here, each step in its own algebra: what was made without a rule need not obey it.  Rates and
replacements must respect the rules and the transposes of the algebra of X; a name is used in another algebra only if
that has the letters and, for them, the rules.  What the texts say is not judged.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from .algebra import Algebra, having
from .form import NUMBER, anything, check_shape, chosen, names, once, text, within
from .interval import Rejected
from .matrices import MOST_ROWS, Entry, Quotients, Rows, check_places, entry, placed, words_at
from .polynomial import Quotient
from .rational import number_at
from .trees import check_known, check_name, check_tree, names_in
from .words import Matrix, Words

#: Of a derivation.
MOST_DEFINITIONS = 100
PAIRS, LETTER, LETTERS = ("rate", "replaced"), ("gradient", "dual"), ("having", "lacking")


class Defined(NamedTuple):
    """What a name stands for."""

    words: Words
    algebra: Algebra


Made = Defined | Rows | Entry


def check_definition(data: Any, where: str) -> None:
    """Raises Rejected unless this is a step of a derivation."""
    check_shape(data, DEFINITION, where)
    check_shape(data["by"], BY[data["operation"]], f"by of {where}")


PAIRS_OF_NAMES = [(check_name, check_tree)]
#: What an operation is done by.
BY = {
    "written": (),
    "rate": PAIRS_OF_NAMES,
    "replaced": PAIRS_OF_NAMES,
    "gradient": check_name,
    "dual": check_name,
    "having": names,
    "lacking": names,
    "matrix": ([(check_name, anything)], [[[check_tree]]]),
    "entry": (range(MOST_ROWS + 1), range(MOST_ROWS + 1)),
}
DEFINITION = {
    "name": check_name, "text": text, "algebra": NUMBER, "operation": tuple(BY), "of": check_tree, "by": anything,
    "value?": check_tree,
}  # fmt: skip


def check_form(
    data: Any, algebras: Sequence[Mapping[str, Any]], known: Sequence[Collection[str]]
) -> list[Collection[str]]:
    """Raises Rejected unless each step is made of what there is, in algebras with these names.

    Returns for each algebra the names that are defined and can be used there.
    """
    if len(data) > MOST_DEFINITIONS:
        raise Rejected(f"the derivation has more than {MOST_DEFINITIONS} definitions")
    once([one["name"] for one in data], "the derivation")
    taken = set().union(*known)
    made: dict[str, dict[str, int]] = {"words": {}, "matrix": {}, "entry": {}}
    for i, one in enumerate(data):
        where, here, operation = f"definition {i}", one["algebra"], one["operation"]
        algebra = within(here, algebras, where)
        if one["name"] in taken:
            raise Rejected(f"{where} has a name that is taken")
        check_known([one.get("value", 0)], known[here], where)
        kind = operation if operation in made else "words"
        if (algebra["kind"] == "quotient") is (kind == "words"):
            raise Rejected(f"{where} is in an algebra of another kind than its operation")
        trees = [one["of"]]
        if operation != "written":
            chosen(one["of"], list(made["matrix" if kind == "entry" else "words"]), f"what {where} is made from")
            trees = []
        if kind == "matrix":
            check_places(one["by"], algebras[made["words"][one["of"]]], algebra, where)
        elif kind == "entry":
            if made["matrix"][one["of"]] != here:
                raise Rejected(f"{where} is in another algebra than its matrix")
        elif operation != "written":
            trees = _check_by(one, algebras[made["words"][one["of"]]], where)
        check_known(trees, {*known[here], *made["words"]}, where)
        made[kind][one["name"]] = here
    return [
        {name for name, there in made["entry"].items() if there == here} if one["kind"] == "quotient" else made["words"]
        for here, one in enumerate(algebras)
    ]


def _check_by(one: dict[str, Any], source: Mapping[str, Any], where: str) -> list[Any]:
    """That the other operand is of letters of the algebra of the first, each once; returns the trees in it."""
    about = [*source["letters"], *(source["parameters"] if one["operation"] == "replaced" else [])]
    if one["operation"] in LETTER:
        chosen(one["by"], about, f"the letter of {where}")
        return []
    letters = [pair[0] for pair in one["by"]] if one["operation"] in PAIRS else one["by"]
    names(letters, where)
    check_known(letters, about, where)
    if not letters:
        raise Rejected(f"{where} must be by names of the algebra that it is made from")
    return [pair[1] for pair in one["by"]] if one["operation"] in PAIRS else []


def values(data: Sequence[dict[str, Any]], algebras: Sequence[Algebra | Quotients]) -> dict[str, Made]:
    """What each name of a derivation, whose form was checked, stands for."""
    found: dict[str, Made] = {}
    for one in data:
        algebra, where = algebras[one["algebra"]], f"the definition of {one['name']}"
        of = found.get(one["of"]) if one["operation"] != "written" else None
        if isinstance(algebra, Algebra):
            words = _made(one, algebra, found, where)
            if "value" in one and algebra.total([words - algebra.read(one["value"], algebra.names)]).terms:
                raise Rejected(f"{where} has another value than it says")
            found[one["name"]] = Defined(words, algebra)
        elif isinstance(of, Defined):
            found[one["name"]] = placed(of.words, of.algebra, algebra, one["by"], where)
        elif isinstance(of, list):
            made = entry(of, one["by"], where)
            if "value" in one and (made.value - algebra.read(one["value"])).numerator.terms:
                raise Rejected(f"{where} has another value than it says")
            found[one["name"]] = made
    return found


def valued(data: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """The trees of the names that have a value."""
    return {one["name"]: one["value"] for one in data if "value" in one}


def check_use(data: Sequence[dict[str, Any]], trees: Sequence[Any]) -> None:
    """Raises Rejected where a definition is used neither in these trees nor by one that is."""
    known = used(data, trees)
    for one in data:
        if one["name"] not in known:
            raise Rejected(f"the definition of {one['name']} is not used")


def used(data: Sequence[dict[str, Any]], trees: Sequence[Any]) -> set[str]:
    """The names in trees, and in the definitions of these."""
    found = names_in([0, *trees])
    for one in reversed(data):
        if one["name"] in found:
            found |= names_in([0, one["of"]])
            if one["operation"] in PAIRS:
                found |= names_in([0, *(tree for _, tree in one["by"])])
    return found


def named(trees: Sequence[Any], algebra: Algebra, defined: Mapping[str, Made], where: str) -> dict[str, Words]:
    """The names of an algebra, and what the defined names in some trees stand for in it."""
    used = ((name, defined[name]) for name in sorted(set().union(*map(names_in, trees)) & defined.keys()))
    return {**algebra.names, **{name: _brought(of, algebra, where) for name, of in used if isinstance(of, Defined)}}


def entries(trees: Sequence[Any], defined: Mapping[str, Made]) -> dict[str, Quotient]:
    """What the defined names in some trees stand for in a quotient ring."""
    used = ((name, defined[name]) for name in set().union(*map(names_in, trees)) & defined.keys())
    return {name: of.value for name, of in used if isinstance(of, Entry)}


def at(of: Made, point: Mapping[str, Fraction | Matrix], where: str) -> Fraction | Matrix:
    """The value at a point."""
    if isinstance(of, Defined):
        return words_at(of.words, of.algebra, point, where)
    if isinstance(of, Entry):
        return number_at(of.value, point, where)
    raise Rejected(f"{where} has a matrix where an entry must stand")


def _brought(of: Defined, algebra: Algebra, where: str) -> Words:
    """In another algebra, which has its letters and parameters and, for its own letters, the rules."""
    if of.algebra is algebra:
        return of.words
    if of.algebra not in algebra.respected:
        shared = of.algebra.names.keys() & algebra.names.keys()
        for name in shared:
            if (name in of.algebra.letters) is not (name in algebra.letters):
                raise Rejected(f"{where} has {name} as a number in one algebra and as a matrix in another")
        _respects(of.algebra, shared, algebra, algebra.names, where)
        algebra.respected.append(of.algebra)
    return _image(of, algebra, algebra.names, where)


def _made(one: dict[str, Any], algebra: Algebra, found: Mapping[str, Made], where: str) -> Words:
    """What a definition makes."""
    operation, by = one["operation"], one["by"]
    if operation == "written":
        return algebra.total([algebra.read(one["of"], named([one["of"]], algebra, found, where))])
    of = found[one["of"]]
    assert isinstance(of, Defined)  # by its form
    if operation == "replaced":
        images = _places(by, algebra, found, where)
        if nothing := sorted(name for name in images.keys() & of.algebra.divisors if not images[name].terms):
            raise Rejected(f"{where} puts 0 in the place of {nothing[0]}, by which something is divided")
        kept = {name: word for name, word in algebra.names.items() if name in of.algebra.names}
        _respects(of.algebra, of.algebra.names.keys(), algebra, kept | images, where)
        return _image(of, algebra, kept | images, where)
    if of.algebra is not algebra:
        raise Rejected(f"{where} is in another algebra than what it is made from")
    if operation == "rate":
        rates = _places(by, algebra, found, where)
        _respects_as_rates(algebra, rates, where)
        return algebra.rate(of.words, rates)
    if operation in LETTERS:
        return having(of.words, by, without=operation == "lacking")
    return algebra.gradient(of.words, by) if operation == "gradient" else algebra.dual(of.words, by)


def _places(by: Sequence[tuple[str, Any]], algebra: Algebra, found: Mapping[str, Made], where: str) -> dict[str, Words]:
    names = named([tree for _, tree in by], algebra, found, where)
    return {name: algebra.read(tree, names) for name, tree in by}


def _image(of: Defined, algebra: Algebra, images: Mapping[str, Words], where: str) -> Words:
    """With other words in the place of its letters and parameters."""

    def place(name: str) -> Words:
        if name not in images:
            raise Rejected(f"{where} says nothing of {name}")
        return images[name]

    def scalar(exponents: tuple[int, ...]) -> Words:
        powers = [(place(name), e) for name, e in zip(of.algebra.parameters, exponents, strict=True) if e]
        if any(word for image, _ in powers for _, word in image.terms):
            raise Rejected(f"{where} has a matrix in the place of a number")
        return algebra.product(image**e for image, e in powers)

    algebra.divisors |= algebra.among(images[name] for name in of.algebra.divisors & images.keys())
    return algebra.image(of.words, place, scalar)


def _respects(
    source: Algebra, names: Collection[str], algebra: Algebra, images: Mapping[str, Words], where: str
) -> None:
    """Raises Rejected unless the rules and transposes among some names of an algebra hold of their images."""

    def image(words: Words) -> Words:
        return _image(Defined(words, source), algebra, images, where)

    rules, transposes = source.about(names, where)
    _check_equal(
        [(RULE.format(a, b), image(source.names[a]) * image(source.names[b]), image(c)) for a, b, c in rules]
        + [(TURNED.format(x), image(t), algebra.transposed(image(source.names[x]))) for x, t in transposes],
        algebra, where,
    )  # fmt: skip


def _respects_as_rates(algebra: Algebra, rates: Mapping[str, Words], where: str) -> None:
    """Raises Rejected unless Leibniz' rule respects the rules and transposes among the letters that have rates."""
    rules, transposes = algebra.about(rates.keys(), where)
    products = [rates[a] * algebra.word(b) + algebra.word(a) * rates[b] for a, b, _ in rules]
    _check_equal(
        [(RULE.format(a, b), made, algebra.rate(c, rates)) for (a, b, c), made in zip(rules, products, strict=True)]
        + [(TURNED.format(x), algebra.transposed(rates[x]), algebra.rate(t, rates)) for x, t in transposes],
        algebra, where,
    )  # fmt: skip


RULE, TURNED = "respect the rule for {} {}", "do to the transpose of {0} what it does to {0}"


def _check_equal(pairs: Sequence[tuple[str, Words, Words]], algebra: Algebra, where: str) -> None:
    """Raises Rejected unless what is made is what is claimed."""
    for what, made, claimed in pairs:
        if algebra.total([made - claimed]).terms:
            raise Rejected(f"{where} does not {what}")
