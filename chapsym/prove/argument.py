"""The conclusions of a proof, as data: hypotheses and conclusions, the steps between them, and readings of a question.

The texts are names: two are the same statement if they are equal, letter for letter.  It is decided that the steps
connect and that none is missing; the contents of the sentences are not checked.
"""

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass

#: The answers to a reading of a question: the thing does not exist, exists, or exists for a trivial reason.
NO, YES, TRIVIALLY, OPEN = ANSWERS = ("no", "yes", "trivially yes", "open")

#: The words for a settled question.
MACHINE_CHECKED, BY_HAND = "machine-checked", "by hand"


@dataclass(frozen=True)
class Theorem:
    """If the letters are as quantified and the hypotheses hold, the conclusions hold; other letters are arbitrary.

    Parameters
    ----------
    quantifiers, hypotheses, conclusions : tuple of str
        Texts: two are the same statement if they are equal, letter for letter.

    Examples
    --------
    >>> from chapsym.prove import Theorem
    >>> Theorem(("x is real",), ("x > 0",), ("x is a square",)).given
    ('x is real', 'x > 0')
    """

    quantifiers: tuple[str, ...]
    hypotheses: tuple[str, ...]
    conclusions: tuple[str, ...]

    @property
    def given(self) -> tuple[str, ...]:
        """The statements that the proof may use."""
        return (*self.quantifiers, *self.hypotheses)


@dataclass(frozen=True)
class Step:
    """An inference of `gives` from `needs`: the number of its sentences, and the decided statements that it uses."""

    gives: str
    needs: tuple[str, ...]
    sentences: int
    checks: tuple[str, ...]


@dataclass(frozen=True)
class Reading:
    """One reading of a question: whether there is a thing, and the proofs that answer it, in the order of use.

    Parameters
    ----------
    asked : str
        The reading in words.
    thing : str
        The thing in question, to follow "there is a".
    answer : str
        "no", "yes", "trivially yes" or "open".
    by : tuple of str, optional
        Lemmas, and parts of the proof of the question; none if it is open.

    Raises
    ------
    ValueError
        For another answer, for an open reading with `by`, and for an answered one without.

    Examples
    --------
    >>> from chapsym.prove import Reading
    >>> Reading("a real number whose square is -1", "real root", "no", ("positive",)).goal
    'there is no real root'
    """

    asked: str
    thing: str
    answer: str
    by: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if self.answer not in ANSWERS or (self.answer == OPEN) == bool(self.by):
            raise ValueError(f"a reading is open, or answered by what proves it; this is not: {self.asked}")

    @property
    def goal(self) -> str:
        """The required conclusions."""
        return no(self.thing) if self.answer == NO else there_is(self.thing)


class Gap(Exception):
    """A statement does not follow; the message names it."""


def there_is(thing: str) -> str:
    """The conclusion that a thing exists.

    Parameters
    ----------
    thing : str
        The thing, to follow "there is a".

    Returns
    -------
    str

    Examples
    --------
    >>> from chapsym.prove import there_is
    >>> there_is("real root")
    'there is a real root'
    """
    return f"there is a {thing}"


def no(thing: str) -> str:
    """The conclusion that a thing does not exist.

    Parameters
    ----------
    thing : str
        The thing, to follow "there is no".

    Returns
    -------
    str

    Examples
    --------
    >>> from chapsym.prove import no
    >>> no("real root")
    'there is no real root'
    """
    return f"there is no {thing}"


def sentences(texts: Iterable[str]) -> int:
    """The number of sentences of a text, which end in full stops or colons; numbers of paragraphs do not count."""
    whole = re.sub(r"(^|\n)\s*\d+\.\s", r"\1", "\n".join(texts))
    return sum(any(map(str.isalpha, part)) for part in re.split(r"[.:](?:\s|$)", whole))


def gaps(theorem: Theorem, steps: Sequence[Step], known: Collection[str]) -> list[str]:
    """The reasons why steps do not prove a theorem from known statements; empty if they do and none is unused."""
    found, have, used = [], {*known, *theorem.given}, set(theorem.conclusions)
    for step in steps:
        found += [f"«{step.gives}» needs «{need}», which nothing gives" for need in step.needs if need not in have]
        if not step.sentences:
            found.append(f"no sentence carries «{step.gives}»")
        have.add(step.gives)
        used.update(step.needs)
    shown = {*known, *(step.gives for step in steps)}
    found += [f"«{one}» is concluded by no step" for one in theorem.conclusions if one not in shown]
    idle = [*theorem.given, *(step.gives for step in steps)]
    return found + [f"«{one}» is used by no step" for one in idle if one not in used]


def assembled(reading: Reading, theorems: Mapping[str, Theorem]) -> Theorem:
    """The theorem that answers a reading, with the hypotheses that no lemma gives; raises Gap if there is none."""
    quantifiers: dict[str, None] = {}
    hypotheses: dict[str, None] = {}
    given: dict[str, str] = {}
    idle = dict.fromkeys(reading.by[:-1])
    for name in reading.by:
        if name not in theorems:
            raise Gap(f"{name} is not proved, or states nothing")
        theorem = theorems[name]
        for one in theorem.hypotheses:
            if one in given:
                idle.pop(given[one], None)
            else:
                hypotheses[one] = None
        quantifiers |= dict.fromkeys(theorem.quantifiers)
        given |= dict.fromkeys(theorem.conclusions, name)
    if not reading.by or reading.goal not in theorems[reading.by[-1]].conclusions:
        raise Gap(f"{', '.join(reading.by) or 'nothing'} does not conclude that {reading.goal}")
    if idle:
        raise Gap(f"{next(iter(idle))} gives nothing that is needed: {reading.asked}")
    return Theorem(tuple(quantifiers), tuple(hypotheses), (reading.goal,))


def row(reading: Reading, theorem: Theorem | None) -> dict[str, object]:
    """A reading with the theorem that answers it, as in a record."""
    made = asdict(theorem) if theorem else None
    text = cited_text(reading, theorem) if theorem else None
    return {"asked": reading.asked, "answer": reading.answer, "by": list(reading.by), "theorem": made, "text": text}


def cited_text(reading: Reading, theorem: Theorem) -> str:
    """An answered reading as a sentence."""
    where = f"Where {'; '.join(theorem.given)}: " if theorem.given else ""
    return f"{reading.answer.capitalize()}. {where}{'; '.join(theorem.conclusions)} ({', '.join(reading.by)})."


@dataclass(frozen=True)
class Grounds:
    """The theorem of a proof, and its grounds: decided statements, accepted certificates, sentences."""

    theorem: Theorem | None
    statements: int
    certificates: int
    sentences: int


def settlement(of: Mapping[str, Grounds]) -> dict[str, object]:
    """The grounds of several proofs: the word for them, the number of each, and both as text."""
    names = "statements", "certificates", "sentences"
    total = {name: sum(getattr(one, name) for one in of.values()) for name in names}
    word = BY_HAND if total["sentences"] else MACHINE_CHECKED
    machine = f"{total['statements']} decided statements and {total['certificates']} accepted certificates"
    hand = f"; {total['sentences']} sentences are by hand" if total["sentences"] else ""
    text = f"{word}: {machine} are machine-checked{hand}; in the proofs of {', '.join(of)}"
    return {"word": word, **total, "proofs": list(of), "text": text}
