"""The evidence for a verdict, and the rule that computes the verdict from it.

A proof is a function that receives a `Proof`, states the printed formulas, lemmas, controls and, if the printed form
fails, its correction and an exact counterexample.  The verdict is computed from the results of these checks; no proof
can assert one.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from itertools import chain

import sympy as sp
from sympy.core.relational import Relational

from chapsym.derive.words import unfolded

from . import argument, points, witness
from .argument import Reading, Step, Theorem
from .limits import Limit
from .statements import Comparison, Count, Equation, Point, Rest, Side, Statement, Values, contradicts
from .trees import Data
from .witness import Examples

#: A rational number, as text.
NUMBER = re.compile(r"-?\d+(/\d+)?")
#: The wording of the relations of a count or of a comparison with a number.
SAID = {"==": "", "!=": "not ", "<": "less than ", "<=": "at most ", ">": "more than ", ">=": "at least "}


#: The kinds of errors of statements that are not true as printed, by their effect on a reader.
SLIPS = ("serious", "typo", "convention", "reading")


class Verdict(StrEnum):
    """The verdict on a printed claim.

    Examples
    --------
    >>> from chapsym.prove import Verdict
    >>> [str(one) for one in Verdict]
    ['holds', 'corrected', 'conditional', 'refuted', 'settled', 'definition', 'open']
    """

    HOLDS = "holds"
    CORRECTED = "corrected"
    CONDITIONAL = "conditional"
    REFUTED = "refuted"
    SETTLED = "settled"
    DEFINITION = "definition"
    OPEN = "open"


@dataclass
class Proof:
    """Collects the derivation and the decided statements of one claim.

    A proof is a function that receives a `Proof` and calls its methods.

    Attributes
    ----------
    lines : list of str
        The derivation.
    checks : list of dict
        The decided statements: `statement`, `holds` and `method` of each.
    controls : list of dict
        The mutated statements: `statement` and `rejected` of each.
    problems : list of str
        Why the verdict is `open`, if something failed or is missing.

    Examples
    --------
    >>> import sympy as sp
    >>> from chapsym.derive import Quotient
    >>> from chapsym.prove import Proof, equations
    >>> x, y = sp.symbols("x y")
    >>> p, equal = Proof(), equations(Quotient((x, y)))
    >>> p.printed(equal("(x + y)² = x² + 2xy + y²", (x + y) ** 2, x**2 + 2 * x * y + y**2))
    >>> p.control(equal("without 2xy", (x + y) ** 2, x**2 + y**2))
    >>> str(p.verdict()), p.problems
    ('holds', [])
    """

    lines: list[str] = field(default_factory=list)
    checks: list[Data] = field(default_factory=list)
    controls: list[Data] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)
    hypotheses: list[str] = field(default_factory=list)
    assumed: list[Comparison] = field(default_factory=list)
    counterexamples: list[Data] = field(default_factory=list)
    routes: list[Data] = field(default_factory=list)
    witnesses: list[Data] = field(default_factory=list)
    tried: list[str] = field(default_factory=list)
    certificates: list[Data] = field(default_factory=list)
    measured: list[str] = field(default_factory=list)
    conjectures: list[str] = field(default_factory=list)
    uses: tuple[str, ...] = ()
    examples: Examples = field(default_factory=Examples)
    stated: dict[str, Theorem] = field(default_factory=dict)
    steps: dict[str, list[Step]] = field(default_factory=dict)
    question: dict[str, str] | None = None
    readings: list[Data] = field(default_factory=list)
    reason: str | None = None
    corrected_text: str | None = None
    condition: str | None = None
    slip: Data | None = None
    glossary: dict[str, tuple[Side, str]] = field(default_factory=dict)
    said: list[str] = field(default_factory=list)
    inferences: list[str] = field(default_factory=list)
    decided: list[tuple[str, Statement, bool]] = field(default_factory=list)
    points: list[Point] = field(default_factory=list)
    _printed: list[tuple[Statement, bool]] = field(default_factory=list)
    _corrected: list[tuple[Statement, bool]] = field(default_factory=list)
    _since: tuple[int, int] = (0, 0)

    def say(self, *texts: str) -> None:
        """Adds lines to the derivation."""
        self.said += map(str, texts)
        self.lines += map(str, texts)

    def infers(self, *texts: str) -> None:
        """Adds the argument in words from decided statements to the printed or corrected formula, by hand."""
        self.inferences += map(str, texts)

    def show(self, name: str, value: object) -> None:
        """Adds a line with a derived expression to the derivation."""
        if isinstance(value, sp.MatrixBase):
            value = "[" + ",  ".join(str(unfolded(entry)) for entry in value) + "]"
        elif isinstance(value, sp.Expr):
            value = unfolded(value)
        self.lines.append(f"    {name} = {value}")

    def assume(self, text: str, *relations: Relational) -> None:
        """Adds a hypothesis under which the claim is judged.

        The relations must hold at every witness with values for their symbols, and at least at one.  A counterexample
        with a value for one of the symbols must have values for all, and the relations must hold there.

        Parameters
        ----------
        text : str
            The hypothesis in words or signs.
        *relations : sympy relational
            The same as relations: `0 < x`, `sp.Ne(x, 0)`.
        """
        self.hypotheses.append(str(text))
        if relations:
            self.assumed.append(Comparison(text, relations))

    def reads(self, *given: Mapping[str, tuple[Side, str]] | tuple[str, Side, str]) -> None:
        """Sets the meanings of symbols, so that the checker reads the formulas and compares them with the statements.

        Parameters
        ----------
        *given : tuple or mapping
            (TeX, value, meaning), with an expression, a column or a matrix in the letters of the statements as the
            value, or tables {TeX: (value, meaning)}.

        Raises
        ------
        TypeError
            For a value that is no expression or matrix of SymPy, and without a meaning.
        """
        tables = ({one[0]: one[1:]} if isinstance(one, tuple) else one for one in given)
        for symbol, one in chain.from_iterable(table.items() for table in tables):
            value, meaning = one if isinstance(one, tuple) and len(one) == 2 else (None, None)
            value = sp.Integer(value) if type(value) is int else value
            if not isinstance(value, sp.Expr | sp.MatrixBase) or not isinstance(meaning, str):
                raise TypeError(
                    f"p.reads takes for {symbol} its value, an expression or a matrix of SymPy, and its meaning"
                )
            self.glossary[str(symbol)] = value, meaning

    def lemma(self, *statements: Statement) -> None:
        """Decides statements that must hold for the proof to stand."""
        self.problems += [f"lemma fails: {s.text}" for s in statements if not self._decide(s)]

    def route(self, name: str, *statements: Statement) -> None:
        """Adds a second, independent proof of the statements; it must agree."""
        self.lines.append(f"  second route: {name}")
        decided = [self._decide(s, "second route") for s in statements]
        holds = bool(decided) and all(decided)
        self.routes.append({"name": name, "statements": [s.text for s in statements], "holds": holds})
        if not holds:
            self.problems.append(f"the second route fails: {name}")

    def printed(self, *statements: Statement) -> None:
        """Decides statements of the paper as printed.

        A false count or comparison is its own counterexample, except for a count that also states where something does
        not vanish.

        Parameters
        ----------
        *statements : Statement
            For example an `Equation`, a `Comparison` or a `Count`.
        """
        decided = [(s, self._decide(s, "printed")) for s in statements]
        self._printed += decided
        for statement, holds in decided:
            if not holds and contradicts(statement):
                self._contradict(statement)

    def corrected(self, text: str, *statements: Statement) -> None:
        """Adds the smallest correction of the printed statement, its formula, and the statements that prove it."""
        if not isinstance(text, str):
            raise TypeError("p.corrected takes the corrected formula, a text, and then the statements that prove it")
        self.corrected_text = text
        self._corrected += [(s, self._decide(s, "corrected")) for s in statements]

    def under(self, condition: str, *statements: Statement) -> None:
        """Decides the printed statements under a hypothesis that the paper omits."""
        self.condition = str(condition)
        self._corrected += [(s, self._decide(s, "under", f"under {condition}: ")) for s in statements]

    def slips(self, kind: str, *follows: str) -> None:
        """Sets the kind of the error, which is our judgement.

        The proof, not this, decides whether it is an error.

        Parameters
        ----------
        kind : str
            `serious`, computations with it go wrong; `typo`, a misprint that the context corrects; `convention`, a sign
            or an order that differs from the rest of the paper; `reading`, true or false depending on the reading, or
            on an omitted hypothesis.
        *follows : str
            The claims that it uses, from whose errors it follows.

        Raises
        ------
        ValueError
            For another kind, and for a claim that is not used.
        """
        if kind not in SLIPS:
            raise ValueError(f"a slip is one of {', '.join(SLIPS)}, not {kind!r}")
        if strange := [id for id in follows if id not in self.uses]:
            raise ValueError(f"an error follows from one of a claim that is used; {strange[0]} is not in uses=[...]")
        self.slip = {"kind": kind, "follows": list(follows)}

    def counterexample(self, point: Point) -> None:
        """Evaluates all printed and corrected formulas so far at an exact point.

        There the hypotheses and every corrected formula must hold, and some printed formula must fail.

        Parameters
        ----------
        point : Point
            The point.
        """
        self.points.append(point)
        self.problems += [f"the counterexample violates the hypothesis {failure}" for failure in point.failures()]
        self._look_at_hypotheses(point.exact)
        printed, corrected = _equations(self._printed), _equations(self._corrected)
        wrong = [sides for e in printed if (sides := _sides(e, point))["left"] != sides["right"]]
        right = [_sides(e, point) for e in corrected]
        if not wrong:
            self.problems.append("the counterexample does not contradict the printed form")
        if any(sides["left"] != sides["right"] for sides in right):
            self.problems.append("the correction fails at the counterexample")
        self.counterexamples.append({"point": point.values, "printed": wrong, "corrected": right})

    def _contradict(self, of: Count | Comparison) -> None:
        self._look_at_hypotheses(of.point)
        left, right = of.sides()
        right = [f"{SAID[relation.rel_op]}{x}" for relation, x in zip(of.relations, right, strict=True)]
        values = {str(x): str(v.tolist() if isinstance(v, sp.MatrixBase) else v) for x, v in of.point.items()}
        sides = {"statement": of.text, "left": left, "right": right}
        self.counterexamples.append({"point": values, "printed": [sides], "corrected": []})

    def _look_at_hypotheses(self, exact: Values) -> None:
        self.problems += [
            f"the counterexample has no value for {min(map(str, h.symbols - exact.keys()))}, of the hypothesis {h.text}"
            for h in self.assumed
            if not h.symbols <= exact.keys() and not h.symbols.isdisjoint(exact)
        ]
        violated = [h.text for h in self.assumed if h.symbols <= exact.keys() and not h.true_at(exact)]
        self.problems += [f"the counterexample violates the hypothesis {text}" for text in violated]

    def control(self, *statements: Statement) -> None:
        """Adds mutated statements, which the same algorithms must reject."""
        for statement in statements:
            _check(statement)
            rejected = not statement.holds()
            self.controls.append({"statement": statement.text, "rejected": rejected})
            self.lines.append(f"  control: {statement.text}: {'rejected, as it must be' if rejected else 'ACCEPTED'}")
            if not rejected:
                self.problems.append(f"control accepted: {statement.text}")

    def witness(self, name: str, values: Mapping[str, str], *statements: Statement) -> None:
        """Adds an exact point at which the hypotheses hold and the evaluated statements are true."""
        wrong = [s.text for s in statements if not s.holds()]
        self.problems += [f"fails at its witness ({name}): {text}" for text in wrong]
        numbers = {x: sp.Rational(v) for x, v in values.items() if NUMBER.fullmatch(str(v))}
        for h in self.assumed:
            there = {x: numbers[x.name] for x in h.symbols if x.name in numbers}
            if there.keys() >= h.symbols and not h.true_at(there):
                self.problems.append(f"the witness {name} violates the hypothesis {h.text}")
        point = {str(x): str(v) for x, v in values.items()}
        self.witnesses.append({"name": name, "point": point, "statements": len(statements)})

    def define(self, reason: str) -> None:
        """States that the claim is a definition, with the reason: there is nothing to decide."""
        self.reason = str(reason)

    def leave_open(self, *tried: str) -> None:
        """States that a question of the paper is not settled here, with the attempts."""
        self.tried += map(str, tried)

    def certificate(self, file: str, statement: str, digest: str, accepted: bool) -> None:
        """Adds a file that the independent checker has judged, with the sentence that it proves."""
        self.certificates.append({"file": file, "statement": statement, "digest": digest, "accepted": accepted})
        self.lines.append(f"  {'✓' if accepted else '✗'} certificate {file}: {statement}")
        if not accepted:
            self.problems.append(f"the checker does not accept {file}")

    def state(self, theorem: Theorem, part: str = "") -> None:
        """Sets the theorem of the lemma, or a part of the proof under its name, as data; its steps follow."""
        self.stated[part], self.steps[part] = theorem, []
        self._since = len(self.said), len(self.decided)

    def step(self, gives: str, *needs: str) -> None:
        """Adds a conclusion from the statements that it needs, by the sentences since the last step.

        Parameters
        ----------
        gives : str
            The conclusion.
        *needs : str
            Hypotheses of the theorem, conclusions of earlier steps, ids that the claim uses, files of accepted
            certificates, and texts of decided statements.
        """
        said, decided = self._since
        checks = tuple(statement.text for _, statement, _ in self.decided[decided:])
        made = Step(gives, needs, argument.sentences(self.said[said:]), checks)
        self.steps[list(self.stated)[-1]].append(made)
        self.lines.append(f"  ⊢ {gives}")
        self._since = len(self.said), len(self.decided)

    def ask(self, words: str, where: str) -> None:
        """Adds a question of the paper, literally, and its place."""
        self.question = {"words": words, "where": where}

    def settle(self, readings: Sequence[Reading]) -> None:
        """Adds readings of an open question of the paper, each with the theorem from the lemmas, or open."""
        known = {part: theorem for part, theorem in self.stated.items() if not self.gaps(part)}
        for _, rest, holds in self.decided:
            if isinstance(rest, Rest) and holds and rest.grounds and rest.grounds.theorem:
                known[rest.name] = rest.grounds.theorem
        for one in readings:
            made = None
            try:
                made = argument.assembled(one, known) if one.by else None
            except argument.Gap as gap:
                self.problems.append(f"not answered: {gap}")
            self.readings.append(argument.row(one, made))

    def gaps(self, part: str) -> list[str]:
        """The reasons why the steps do not prove the theorem of a part; empty if they do."""
        decided = {statement.text for _, statement, holds in self.decided if holds}
        files = {one["file"] for one in self.certificates if one["accepted"]}
        return argument.gaps(self.stated[part], self.steps[part], {*self.uses, *decided, *files})

    @property
    def answer(self) -> str | None:
        """Sets the answer to a question: the theorems from the statements of the lemmas."""
        return "  ".join(one["text"] for one in self.readings if one["theorem"]) or None

    def measure(self, *findings: str) -> None:
        """Adds numerical evidence, with its digits; no verdict depends on it."""
        self.measured += map(str, findings)

    def conjecture(self, *texts: str) -> None:
        """Adds a statement that is conjectured and not proved; no verdict depends on it."""
        self.conjectures += map(str, texts)

    def verdict(self) -> Verdict:
        """The verdict from the evidence; `open` if anything is missing or failed."""
        if self.tried:
            return Verdict.OPEN
        self._look_at_witnesses()
        if not self.controls:
            self.problems.append("the proof has no negative control: give p.control a false variant, to be rejected")
        if not self._printed and not self.reason and not self.answer:
            self.problems.append("no printed form was judged")
        self.problems += [gap for part in self.stated for gap in self.gaps(part)]
        limits = [statement for _, statement, _ in self.decided if isinstance(statement, Limit)]
        self.problems += [
            f"{of.along} cannot tend to 0 in «{of.text}»: the hypothesis {text} has it"
            for of in limits
            for text in of.bound_by(self.assumed)
        ]
        if self.answer and not any(check["holds"] for check in self.checks):
            self.problems.append("the answer has no lemma that is decided")
        if self.problems:
            return Verdict.OPEN
        if self.answer:
            return Verdict.SETTLED
        if self.reason:
            return Verdict.DEFINITION
        if all(holds for _, holds in self._printed):
            if self.slip:
                self.problems.append("it is called an error, and all that is printed holds")
                return Verdict.OPEN
            return Verdict.HOLDS
        if not self._corrected:
            return Verdict.REFUTED
        if not all(holds for _, holds in self._corrected):
            self.problems.append("the correction is not proved")
            return Verdict.OPEN
        return Verdict.CONDITIONAL if self.condition else Verdict.CORRECTED

    def _look_at_witnesses(self) -> None:
        """Records a problem if a true statement fails at an exact point, or a witness or counterexample is missing."""
        true = _equations([pair for pair in [*self._printed, *self._corrected] if pair[1]])
        found, wrong = witness.look(true, self.assumed, self.examples)
        if not found and not self.witnesses:
            found, wrong = points.look(true, self.assumed, self.examples)
        self.witnesses += found
        self.problems += [f"fails at its witness: {text}" for text in wrong]
        if self.counterexamples or self.certificates or self.reason:
            return
        if not self.answer and (unproved := [s.text for s, holds in self._printed if not holds]):
            self.problems.append(
                f"not proved as printed: {unproved[0]}; if it is false, give p.counterexample a point where it fails"
            )
        elif not self.witnesses:
            self.problems.append(
                "no witness: it is not shown that the hypotheses can hold; give p.witness a point where they do, "
                "or the algebra of words an example"
            )

    def _decide(self, statement: Statement, role: str = "lemma", prefix: str | None = None) -> bool:
        _check(statement)
        holds = statement.holds()
        prefix = prefix or ("" if role == "lemma" else f"{role}: ")
        self.decided.append((role, statement, holds))
        self.checks.append({"statement": prefix + statement.text, "holds": holds, "method": statement.method})
        self.lines.append(f"  {'✓' if holds else '✗'} {prefix}{statement.text}")
        return holds


def _check(statement: Statement) -> None:
    if not hasattr(statement, "holds") or not isinstance(statement.text, str):
        raise TypeError(
            f"a statement has a text and is decided, such as equal('x = y', x, y); this is {statement!r:.60}"
        )


def _equations(judged: Sequence[tuple[Statement, bool]]) -> list[Equation]:
    return [statement for statement, _ in judged if isinstance(statement, Equation)]


def _sides(equation: Equation, point: Point) -> Data:
    left, right = equation.at(point.evaluate)
    return {"statement": equation.text, "left": left, "right": right}
