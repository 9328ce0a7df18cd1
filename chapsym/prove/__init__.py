"""Exact verdicts: claims, evidence, negative controls, and the runner."""

from .argument import Reading, Theorem, no, there_is
from .claims import Claim, Judgement, claim, judged
from .evidence import Proof, Verdict
from .limits import tends
from .mutation import mutations
from .polynomials import Identity
from .registers import PROOFS, BrokenScript, NoRegister, Register, load
from .runner import main, prove_all, unproved
from .search import counterexample
from .statements import (
    COMPLEX,
    COMPLEX_MULTIPLE,
    REAL,
    REAL_MULTIPLE,
    Comparison,
    Count,
    Equation,
    Fact,
    Point,
    Zero,
    equations,
    in_field,
    rational_point,
)
from .witness import Examples

__all__ = [
    "COMPLEX",
    "COMPLEX_MULTIPLE",
    "PROOFS",
    "REAL",
    "REAL_MULTIPLE",
    "BrokenScript",
    "Claim",
    "Comparison",
    "Count",
    "Equation",
    "Examples",
    "Fact",
    "Identity",
    "Judgement",
    "NoRegister",
    "Point",
    "Proof",
    "Reading",
    "Register",
    "Theorem",
    "Verdict",
    "Zero",
    "claim",
    "counterexample",
    "equations",
    "in_field",
    "judged",
    "load",
    "main",
    "mutations",
    "no",
    "prove_all",
    "rational_point",
    "tends",
    "there_is",
    "unproved",
]
