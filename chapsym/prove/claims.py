"""Claims: the rows of the register, each with its proof."""

import ast
import gc
import importlib
import inspect
import textwrap
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from chapsym import sources
from chapsym.checker import Rejected
from chapsym.checker.register import CLAIM

from . import argument, certificates
from .argument import Grounds
from .evidence import Proof, Verdict
from .statements import Rest
from .trees import Data
from .witness import Examples

#: The fields of a record besides the verdict, in order: the fields of a `Proof`, and those of its claim.
EVIDENCE = (
    "title", "slip", "hypotheses", "inferences", "condition", "reason", "open_in_paper", "tried", "question", "answer",
    "readings", "settled", "theorems", "certificates", "measured", "conjectures", "derivation", "checks", "controls",
    "routes", "witnesses", "counterexamples", "uses", "downstream", "problems", "carried",
)  # fmt: skip


@dataclass(frozen=True)
class Claim:
    """One row of the list of claims.

    Attributes
    ----------
    id : str
        The name of the claim.
    printed : str
        The printed formula in LaTeX.
    uses : tuple of str
        The ids of the claims on which it rests.
    prove : callable
        Its proof, a function of a `Proof`.
    files : tuple of Path
        The files that the proof reads.
    """

    id: str
    printed: str
    uses: tuple[str, ...]
    prove: Callable[[Proof], None]
    files: tuple[Path, ...] = ()

    @property
    def title(self) -> str:
        """The first line of the docstring of the proof; from the source if the interpreter drops docstrings."""
        return str(self.prove.__doc__ or _docstring(self.prove)).strip().partition("\n")[0]

    @property
    def place(self) -> str:
        """The file and the line where the proof begins."""
        code = inspect.unwrap(self.prove).__code__
        return f"{code.co_filename}, line {code.co_firstlineno}"

    @property
    def _examples_module(self) -> str | None:
        """`examples` next to the proof's script, or above it, if there is one."""
        names = self.prove.__module__.split(".")
        places = (".".join([*names[:i], "examples"]) for i in range(len(names) - 1, 0, -1))
        return next((name for name in places if sources.file(name)), None)

    @property
    def examples_file(self) -> Path | None:
        """The file of the register's examples."""
        return Path(str(sources.file(self._examples_module))) if self._examples_module else None

    @property
    def examples(self) -> Examples:
        """The EXAMPLES of `examples.py` in the register of the proof, if there are any."""
        module = importlib.import_module(self._examples_module) if self._examples_module else None
        found = getattr(module, "EXAMPLES", None)
        return found if isinstance(found, Examples) else Examples()

    def judge(self) -> "Judgement":
        """Runs the proof."""
        start, proof = time.perf_counter(), Proof(uses=self.uses, examples=self.examples)
        self.prove(proof)
        verdict = proof.verdict()
        return Judgement(self, verdict, proof, time.perf_counter() - start)


def _docstring(function: Callable[..., object]) -> str:
    (written,) = ast.parse(textwrap.dedent(inspect.getsource(function))).body
    return (isinstance(written, ast.FunctionDef) and ast.get_docstring(written)) or ""


@dataclass(frozen=True)
class Judgement:
    """A claim with its computed verdict and evidence.

    Attributes
    ----------
    claim : Claim
        The claim.
    verdict : Verdict
        The verdict.
    proof : Proof
        The evidence.
    seconds : float
        The duration of the proof.
    certificate : dict or None
        The decided statements, as data that the checker accepted.
    """

    claim: Claim
    verdict: Verdict
    proof: Proof
    seconds: float
    certificate: Data | None = None

    def certified(self) -> "Judgement":
        """The judgement with its certificate; the claim is open if the checker does not accept it."""
        try:
            of = self.claim.id, self.claim.printed, self.proof, str(self.verdict)
            return replace(self, certificate=certificates.certificate(*of))
        except Rejected as error:
            self.proof.problems.append(f"the checker does not accept its certificate: {error}")
            return replace(self, verdict=Verdict.OPEN)

    @property
    def open_in_paper(self) -> bool:
        """Whether the claim is a question of the paper that stays open here, and nothing failed."""
        return self.verdict is Verdict.OPEN and bool(self.proof.tried) and not self.proof.problems

    @property
    def grounds(self) -> Grounds:
        """The theorem of the claim and its own grounds, without those of the claims that it uses."""
        proof = self.proof
        decided = [statement for _, statement, holds in proof.decided if holds and not isinstance(statement, Rest)]
        return Grounds(proof.stated.get(""), len(decided), len(proof.certificates), argument.sentences(proof.said))

    def record(self, downstream: Sequence[str] = ()) -> Data:
        """The record of the claim, in the JSON form of the command."""
        proof = self.proof
        rests = [statement for _, statement, _ in proof.decided if isinstance(statement, Rest)]
        again = {self.claim.id: self.grounds} | {x.name: x.grounds for x in rests if x.grounds}
        known = vars(proof) | {
            "title": self.claim.title, "open_in_paper": self.open_in_paper, "derivation": self.proof.lines,
            "uses": list(self.claim.uses), "downstream": list(downstream),
            "carried": certificates.carried(self.certificate) if self.certificate else None,
            "answer": proof.answer, "theorems": [
                {"part": part, **asdict(stated), "steps": [asdict(step) for step in proof.steps[part]]}
                for part, stated in proof.stated.items()
            ],
            "settled": argument.settlement(again) if self.verdict is Verdict.SETTLED else None,
        }  # fmt: skip
        return {
            "id": self.claim.id,
            "verdict": str(self.verdict),
            "printed": self.claim.printed,
            "corrected": self.proof.corrected_text,
            "evidence": {name: known[name] for name in EVIDENCE},
            "seconds": round(self.seconds, 3),
        }


class TwoProofs(ValueError):
    """Another proof already has the id; the message has its place."""

    def __init__(self, id: str, other: str) -> None:
        super().__init__(f"two proofs judge the claim {id}")
        self.id, self.other = id, other


_REGISTER: dict[str, Claim] = {}


def claim(
    id: str, printed: str, uses: Sequence[str] = (), files: Sequence[Path] = ()
) -> Callable[[Callable[[Proof], None]], Callable]:
    """Registers a proof as the judge of the claim `id`.

    Parameters
    ----------
    id : str
        The name of the claim.
    printed : str
        The formula in LaTeX.
    uses : sequence of str, optional
        The ids of the claims on which it rests.
    files : sequence of Path, optional
        The files that the proof reads; its records depend on them.

    Returns
    -------
    callable
        A decorator of the proof, a function of a `Proof`.

    Raises
    ------
    TypeError
        For arguments of other types.
    ValueError
        For an id that no file of a certificate could have.
    TwoProofs
        On the proof, if another one has the id.

    Examples
    --------
    >>> import sympy as sp
    >>> from chapsym.derive import Quotient
    >>> from chapsym.prove import claim, equations
    >>> x, y = sp.symbols("x y")
    >>> equal = equations(Quotient((x, y)))
    >>> @claim("square", "(x + y)^2 = x^2 + 2xy + y^2")
    ... def square(p):
    ...     p.printed(equal("(x + y)² = x² + 2xy + y²", (x + y) ** 2, x**2 + 2 * x * y + y**2))
    ...     p.control(equal("without 2xy", (x + y) ** 2, x**2 + y**2))
    """
    if not isinstance(id, str) or not isinstance(printed, str) or isinstance(uses, str):
        raise TypeError("@claim takes an id and a formula, as text, and in uses a list of ids")
    if not CLAIM.fullmatch(id):
        raise ValueError(f"the id of a claim has 1 to 40 of the signs a to z, A to Z, 0 to 9, _ . and -, not {id!r}")

    def register(prove: Callable[[Proof], None]) -> Callable[[Proof], None]:
        if prove.__module__ != "__main__":  # a script that runs alone is run through its package name
            new = Claim(id, printed, tuple(uses), prove, tuple(files))
            old = _REGISTER.setdefault(id, new)
            if old.place != new.place:  # otherwise one file would have two names
                raise TwoProofs(id, old.place)
        return prove

    return register


#: The judgements of this process within `once`.
_KNOWN: dict[Claim, Judgement] | None = None


@contextmanager
def once() -> Iterator[None]:
    """A context in which each claim is judged only once, though others use it: its proof must not change meanwhile."""
    global _KNOWN
    _KNOWN, before, thresholds = {}, _KNOWN, gc.get_threshold()
    gc.set_threshold(100_000, 50, 100)  # each time all expressions are looked through, which make few cycles
    try:
        yield
    finally:
        _KNOWN = before
        gc.set_threshold(*thresholds)


def judgement_of(claim: Claim) -> Judgement:
    """The judgement of a claim, with its certificate; within `once`, the earlier judgement, if any."""
    if _KNOWN is None:
        return claim.judge().certified()
    if claim not in _KNOWN:
        _KNOWN[claim] = claim.judge().certified()
    return _KNOWN[claim]


def judged(id: str) -> Rest:
    """The statement that a claim is proved, by its own proof, run now.

    Parameters
    ----------
    id : str
        The name of the claim.

    Returns
    -------
    Rest
        A statement, for `Proof.lemma`.

    Raises
    ------
    LookupError
        If the script of the claim has not been imported.
    """
    if id not in _REGISTER:
        raise LookupError(f"no proof of {id!r} is loaded: import its script first")
    proved = (Verdict.HOLDS, Verdict.CORRECTED, Verdict.CONDITIONAL)
    found = judgement_of(_REGISTER[id])
    seal = found.certificate["digest"] if found.certificate else ""
    return Rest(f"{id} is proved", f"{id} {seal}", found.verdict in proved, "its own proof, run now", found.grounds)


def register() -> dict[str, Claim]:
    """All claims that have been registered so far, by id."""
    return dict(_REGISTER)
