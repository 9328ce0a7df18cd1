"""Statements about traces as theorems about matrices of every size, over every commutative ring where 2 is a unit."""

from math import lcm

from .quotients import Data, Tree, names_in
from .words import Algebra, LeftOut, algebra_of, rules_for, rules_of, shapes_of, theorem


def statement(name: str, one: Data, data: Data, point: Data) -> str:
    """The theorem: the traces agree for all matrices for which the rules hold, with the given transposes."""
    used = names_in([None, *one["left"], *one["right"]])
    rules = rules_for(data, used)
    used = names_in([None, *used, *(part for rule in rules for part in rule)])
    partners = {b for a, b in data["transposes"] if a in used and isinstance(b, str)}
    algebra = algebra_of(data, one, rules, point, partners)
    turns = [turn for turn in (_turn(algebra, a, image) for a, image in data["transposes"]) if turn]
    if turns:  # a term with the trace of its transpose is half the sum of both
        algebra.N = lcm(2, algebra.N)
    by_text = [(a, b) for a, b, _ in turns if algebra.letters[b][2] == f"{algebra.letters[a][2]}^T"]
    assumed = [turn for turn in turns if not {turn[:2], turn[1::-1]} & {*by_text}]
    hypotheses, rules_as_data = rules_of(algebra, rules)
    sides = [(_side(algebra, a), _side(algebra, b)) for a, b in zip(one["left"], one["right"], strict=True)]
    turned = [_listed(algebra, some) for some in ([(a, b, False) for a, b in by_text], assumed)]
    known = "I"
    for _ in by_text:
        known = f"(conj erefl {known})"
    hypotheses += [f"{algebra.letters[a][2]}^T = {'- ' * minus}{algebra.letters[b][2]}" for a, b, minus in assumed]
    lemma = f"traces {shapes_of(algebra)}\n    {rules_as_data}\n    {' '.join(turned)} {algebra.N}"
    return theorem(name, algebra, hypotheses, lemma, sides, f" {known}")


def _turn(algebra: Algebra, a: str, image: Tree) -> tuple[str, str, bool] | None:
    """A letter whose transpose is a letter, or minus a letter; else None."""
    minus = isinstance(image, list) and image[:2] == ["*", -1] and len(image) == 3
    b = image[2] if minus else image
    if not isinstance(b, str) or not {a, b} <= algebra.letters.keys():
        return None
    return (a, b, minus) if algebra.letters[b][1] == algebra.letters[a][1][::-1] else None


def _listed(algebra: Algebra, turns: list[tuple[str, str, bool]]) -> str:
    parts = (f"({algebra.letters[a][0]}, {algebra.letters[b][0]}, {str(minus).lower()})%N" for a, b, minus in turns)
    return f"[:: {'; '.join(parts)}]"


def _side(algebra: Algebra, tree: Tree) -> tuple[str, str]:
    """The trace of a matrix for a reader, and as data."""
    if tree == 0:
        return "0", "None"
    shape = algebra.shape(tree)
    if shape is None or shape[0] != shape[1]:
        raise LeftOut("it is about the trace of a number, or of a matrix that is not square")
    text, data = algebra.matrix(tree)
    return f"\\tr {text if text[0] == '(' else f'({text})'}", f"Some ({str(shape[0]).lower()}, {data})"
