"""Claims, the evidence for their verdicts, and the rule that turns evidence into a verdict.

A proof is a function that receives a `Proof`, states the printed equations, lemmas, controls and,
where the printed form fails, its correction and an exact counterexample.  The verdict is computed
from what those checks gave; no proof can assert one.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, Protocol

import sympy as sp


class Verdict(StrEnum):
    """What is said of a printed claim."""

    HOLDS = "holds"
    CORRECTED = "corrected"
    CONDITIONAL = "conditional"
    REFUTED = "refuted"
    SETTLED = "settled"
    DEFINITION = "definition"
    CITED = "cited"
    OPEN = "open"


class Algebra(Protocol):
    """Where an equation is decided: words for every n, or a quotient ring for n = 3."""

    def is_zero(self, expr: Any) -> bool:
        """Whether the expression is zero, exactly."""


@dataclass(frozen=True)
class Equation:
    """left = right, entry by entry, in an algebra that decides it exactly."""

    text: str
    left: Sequence[Any]
    right: Sequence[Any]
    algebra: Algebra

    def __post_init__(self) -> None:
        if len(self.left) != len(self.right) or not self.left:
            raise ValueError(f"the two sides of «{self.text}» have {len(self.left)} and {len(self.right)} entries")

    def holds(self) -> bool:
        """True exactly when every entry of left - right is zero in the algebra."""
        return all(self.algebra.is_zero(a - b) for a, b in zip(self.left, self.right, strict=True))

    def at(self, evaluate: "Callable[[Any], Any]") -> tuple[list[str], list[str]]:
        """Both sides at a point, as exact rationals; raises if a value is not rational."""
        pairs = [_same_shape(evaluate(a), evaluate(b)) for a, b in zip(self.left, self.right, strict=True)]
        return [_exact(a) for a, _ in pairs], [_exact(b) for _, b in pairs]


@dataclass(frozen=True)
class Point:
    """An exact rational point: what its symbols are, how to evaluate, and what must hold there."""

    values: dict[str, str]
    evaluate: Callable[[Any], Any]
    hypotheses: Sequence[Equation] = ()

    def failures(self) -> list[str]:
        """The hypotheses that fail at the point."""
        return [h.text for h in self.hypotheses if len(set(map(tuple, h.at(self.evaluate)))) != 1]


def rational_point(values: dict[sp.Symbol, Any], hypotheses: Sequence[Equation] = ()) -> Point:
    """A point given by rational numbers for commuting symbols."""
    exact = {symbol: sp.Rational(value) for symbol, value in values.items()}

    def evaluate(expr: Any) -> Any:
        return sp.sympify(expr).subs(exact, simultaneous=True)

    return Point({str(k): str(v) for k, v in exact.items()}, evaluate, hypotheses)


def _same_shape(a: Any, b: Any) -> tuple[Any, Any]:
    """Writes the number 0 as the zero matrix where the other side is a matrix."""
    if isinstance(a, sp.MatrixBase) and b == 0:
        return a, sp.zeros(*a.shape)
    if isinstance(b, sp.MatrixBase) and a == 0:
        return sp.zeros(*b.shape), b
    return a, b


def _exact(value: Any) -> str:
    if isinstance(value, sp.MatrixBase):
        return str([[_exact(x) for x in row] for row in value.tolist()]).replace("'", "")
    if not value.is_Rational:
        raise ArithmeticError(f"{value} is not a rational number")
    return str(value)


@dataclass
class Proof:
    """Collects the derivation and the decided statements of one claim."""

    lines: list[str] = field(default_factory=list)
    checks: list[dict[str, Any]] = field(default_factory=list)
    controls: list[dict[str, Any]] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)
    hypotheses: list[str] = field(default_factory=list)
    counterexamples: list[dict[str, Any]] = field(default_factory=list)
    corrected_text: str | None = None
    condition: str | None = None
    _facts: list[str] = field(default_factory=list)
    _printed: list[tuple[Equation, bool]] = field(default_factory=list)
    _corrected: list[tuple[Equation, bool]] = field(default_factory=list)

    def say(self, text: str) -> None:
        """A line of the derivation."""
        self.lines.append(text)

    def show(self, name: str, value: Any) -> None:
        """A line of the derivation that shows an expression that was just derived."""
        if isinstance(value, sp.MatrixBase):
            value = "[" + ",  ".join(str(entry) for entry in value) + "]"
        self.lines.append(f"    {name} = {value}")

    def assume(self, text: str) -> None:
        """A hypothesis under which the claim is judged."""
        self.hypotheses.append(text)

    def lemma(self, equation: Equation) -> None:
        """A statement that must hold for the proof to stand."""
        holds = self._decide(equation)
        if not holds:
            self.problems.append(f"lemma fails: {equation.text}")

    def fact(self, text: str, truth: bool) -> None:
        """A decided statement that is not an equation (an order, a sign, a strict inequality of rationals)."""
        self._record(text, truth)
        if not truth:
            self.problems.append(f"fact fails: {text}")

    def printed(self, *equations: Equation) -> None:
        """The formulas of the paper; each is decided as printed."""
        self._printed += [(e, self._decide(e, "printed: ")) for e in equations]

    def printed_fact(self, text: str, truth: bool) -> None:
        """A printed statement that is no equation: that something exists, or differs, shown by exact numbers."""
        self._record(f"printed: {text}", truth)
        if not truth:
            self.problems.append(f"printed fact fails: {text}")
        self._facts.append(text)

    def corrected(self, text: str, *equations: Equation) -> None:
        """The smallest correction of the printed formulas, and the equations that prove it."""
        self.corrected_text = text
        self._corrected += [(e, self._decide(e, "corrected: ")) for e in equations]

    def under(self, condition: str, *equations: Equation) -> None:
        """The printed formulas under a hypothesis that the paper leaves out."""
        self.condition = condition
        self._corrected += [(e, self._decide(e, f"under {condition}: ")) for e in equations]

    def counterexample(self, point: Point) -> None:
        """Evaluates every printed and corrected formula that was stated so far at an exact point.

        The hypotheses must hold there, some printed formula must fail, every corrected one must hold.
        """
        for failure in point.failures():
            self.problems.append(f"the counterexample violates the hypothesis {failure}")
        wrong = [sides for e, _ in self._printed if (sides := _sides(e, point))["left"] != sides["right"]]
        right = [_sides(e, point) for e, _ in self._corrected]
        if not wrong:
            self.problems.append("the counterexample does not contradict the printed form")
        if any(sides["left"] != sides["right"] for sides in right):
            self.problems.append("the correction fails at the counterexample")
        self.counterexamples.append({"point": point.values, "printed": wrong, "corrected": right})

    def control(self, equation: Equation) -> None:
        """A mutated statement, which the same machinery must reject."""
        rejected = not equation.holds()
        self.controls.append({"statement": equation.text, "rejected": rejected})
        self.lines.append(f"  control: {equation.text}: {'rejected, as it must be' if rejected else 'ACCEPTED'}")
        if not rejected:
            self.problems.append(f"control accepted: {equation.text}")

    def verdict(self) -> Verdict:
        """The verdict that the evidence supports; `open` when anything is missing or failed."""
        if not self.controls:
            self.problems.append("the proof has no negative control")
        if not self._printed and not self._facts:
            self.problems.append("no printed form was judged")
        if self.problems:
            return Verdict.OPEN
        if all(holds for _, holds in self._printed):
            return Verdict.HOLDS
        if not self.counterexamples:
            self.problems.append("the printed form is not proved, and there is no counterexample to it")
            return Verdict.OPEN
        if not self._corrected:
            return Verdict.REFUTED
        if not all(holds for _, holds in self._corrected):
            self.problems.append("the correction is not proved")
            return Verdict.OPEN
        return Verdict.CONDITIONAL if self.condition else Verdict.CORRECTED

    def _decide(self, equation: Equation, prefix: str = "") -> bool:
        holds = equation.holds()
        self._record(prefix + equation.text, holds, type(equation.algebra).__name__)
        return holds

    def _record(self, text: str, holds: bool, method: str = "exact arithmetic") -> None:
        self.checks.append({"statement": text, "holds": holds, "method": _METHODS.get(method, method)})
        self.lines.append(f"  {'✓' if holds else '✗'} {text}")


_METHODS = {
    "WordAlgebra": "words in noncommuting symbols, every n",
    "Quotient": "quotient ring over Q, Gröbner division",
}


def _sides(equation: Equation, point: Point) -> dict[str, Any]:
    left, right = equation.at(point.evaluate)
    return {"statement": equation.text, "left": left, "right": right}


@dataclass(frozen=True)
class Claim:
    """One row of the list of claims: how it is printed, what it uses, and its proof."""

    id: str
    printed: str
    uses: tuple[str, ...]
    prove: Callable[[Proof], None]

    @property
    def title(self) -> str:
        """The first line of the proof's docstring."""
        return (self.prove.__doc__ or "").strip().splitlines()[0]

    def judge(self) -> "Judgement":
        """Runs the proof."""
        start, proof = time.perf_counter(), Proof()
        self.prove(proof)
        verdict = proof.verdict()
        return Judgement(self, verdict, proof, time.perf_counter() - start)


@dataclass(frozen=True)
class Judgement:
    """A claim with its computed verdict and evidence."""

    claim: Claim
    verdict: Verdict
    proof: Proof
    seconds: float

    @property
    def proved(self) -> bool:
        """Whether the claim is decided."""
        return self.verdict is not Verdict.OPEN

    def record(self, downstream: Sequence[str] = ()) -> dict[str, Any]:
        """The claim's row of the register, as the command's contract has it."""
        return {
            "id": self.claim.id,
            "verdict": str(self.verdict),
            "printed": self.claim.printed,
            "corrected": self.proof.corrected_text,
            "evidence": {
                "title": self.claim.title,
                "hypotheses": self.proof.hypotheses,
                "condition": self.proof.condition,
                "derivation": self.proof.lines,
                "checks": self.proof.checks,
                "controls": self.proof.controls,
                "counterexamples": self.proof.counterexamples,
                "uses": list(self.claim.uses),
                "downstream": list(downstream),
                "problems": self.proof.problems,
            },
            "seconds": round(self.seconds, 3),
        }


_REGISTER: dict[str, Claim] = {}


def claim(id: str, printed: str, uses: Sequence[str] = ()) -> Callable[[Callable[[Proof], None]], Callable]:
    """Registers a proof as the judge of the claim `id`."""

    def register(prove: Callable[[Proof], None]) -> Callable[[Proof], None]:
        if prove.__module__ != "__main__":  # a script that runs alone is run through its package name
            if id in _REGISTER:
                raise ValueError(f"two proofs judge the claim {id}")
            _REGISTER[id] = Claim(id, printed, tuple(uses), prove)
        return prove

    return register


def register() -> dict[str, Claim]:
    """All claims that have been registered so far, by id."""
    return dict(_REGISTER)
