"""Claims from cases: a statement, its proof, and a false variant, judged by the checker immediately."""

import re
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from typing import Any

import sympy as sp

from chapsym.derive import Quotient
from chapsym.prove import Claim, Comparison, Equation, Examples, Identity, Proof, Verdict
from chapsym.prove.statements import Statement
from chapsym.prove.trees import Data
from chapsym.prove.witness import true_at

from .algebra import Point
from .system import BadSystem, System

#: The length of the name of a system in the id of a claim.
LETTERS = 22
#: Why a property that is an equation of the method has no certificate.
SAID = "it is one of the equations, so that nothing is to be decided"
#: Of an equation in words.
MOST_LETTERS = 3000


@dataclass(frozen=True)
class Certified:
    """An exact verdict, with its certificate or the reason why it has none.

    Attributes
    ----------
    verdict : str
        The name of the verdict: "motion", "energy", "dla: order".
    certificate : dict or None
        The certificate of `chapsym.prove`, accepted by the checker.
    why : str
        Why there is no certificate.
    """

    verdict: str
    certificate: Data | None = None
    why: str = ""


@dataclass(frozen=True)
class Case:
    """A claim with its statement, its proof, and a false variant of it; premises are in words.

    Where the certificate is too large there may be another `instead`, and `derived`, that some expressions are
    derivatives, is said in words.
    """

    said: str
    printed: Sequence[Statement]
    control: Statement
    lemmas: Sequence[Statement] = ()
    derived: Sequence[Statement | str] = ()
    premises: Sequence[str] = ()
    uses: Sequence[str] = ()
    inferred: str = ""
    instead: "Callable[[], Case] | None" = None

    def judged(self, verdict: str, id: str, points: Sequence[Point] = ()) -> Certified:
        """The verdict by its own proof, run now, and by the checker, at one of some points where it has a value."""
        found = self._judged(verdict, id, points)
        if found.certificate:
            return found
        if self.instead:
            return self.instead().judged(verdict, id, points)
        texts = [one if isinstance(one, str) else one.text for one in self.derived]
        return found if texts == self.derived else replace(self, derived=texts).judged(verdict, id, points)

    def _judged(self, verdict: str, id: str, points: Sequence[Point]) -> Certified:
        texts = [one for one in self.derived if isinstance(one, str)]
        statements = [*(one for one in self.derived if not isinstance(one, str)), *self.lemmas, *self.printed]
        related = [one for one in statements if isinstance(one, Equation) and isinstance(one.algebra, Quotient)]

        def prove(p: Proof) -> None:
            letters = [set().union(*(e.free_symbols for e in (*one.left, *one.right))) for one in related]
            own = [*zip(related, letters, strict=True)]  # other symbols are free
            at = (x for x in points if all(true_at(one, x) for one, symbols in own if symbols <= x.keys()))
            p.examples = Examples(numbers=next(at, {}))
            for text in (*self.premises, *(f"{text}: as chapsym forms them" for text in texts)):
                p.assume(text)
            if self.inferred:
                p.infers(self.inferred)
            p.lemma(*statements[: -len(self.printed)])
            p.printed(*self.printed)
            p.control(self.control)
            for one in statements:
                if isinstance(one, Comparison | Identity):
                    point = getattr(one, "point", {})
                    p.witness("point", {x.name: str(v) for x, v in point.items()}, one)

        found = Claim(id, self.said, tuple(self.uses), prove).judge().certified()
        data, problems = found.certificate, found.proof.problems
        left = [one["text"] for one in data["sentences"] if one["role"] in ("printed", "lemma")] if data else []
        if data is None or data["verdict"] != Verdict.HOLDS or left:
            return Certified(verdict, None, next(iter([*problems, *left]), SAID))
        return Certified(verdict, data)


#: With points at which it may have a value.
Made = tuple[Case, Sequence[Point]]


def made(system: System, verdict: str, id: str, known: set[str], case_of: Callable[..., Made], *of: Any) -> Certified:
    """A verdict by its case, if it rests on known claims, to which it is then added."""
    try:
        case, points = case_of(*of)
        if lacking := [one for one in case.uses if one not in known]:
            raise BadSystem(f"it rests on {lacking[0]}, which has none")
        found = case.judged(verdict, id, points)
    except (ArithmeticError, ValueError, sp.PolynomialError) as error:
        return Certified(verdict, None, str(error).removeprefix(f"{system.name}: "))
    known |= {id} if found.certificate else set()
    return found


def name_of(system: System) -> str:
    """The beginning of the ids of its claims."""
    plain = re.sub(r"[^A-Za-z0-9]+", "-", system.name).strip("-")[:LETTERS].strip("-").lower()
    return plain or "system"


def fresh(name: str, taken: Collection[sp.Symbol]) -> sp.Symbol:
    """A symbol that differs from some others."""
    while sp.Symbol(name) in taken:
        name += "_"
    return sp.Symbol(name)
