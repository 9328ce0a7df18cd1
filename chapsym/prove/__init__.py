"""Exact verdicts: claims, evidence, negative controls, and the runner."""

from .claims import Claim, Equation, Judgement, Point, Proof, Verdict, claim, rational_point
from .runner import BrokenScript, load, main, prove_all

__all__ = [
    "BrokenScript",
    "Claim",
    "Equation",
    "Judgement",
    "Point",
    "Proof",
    "Verdict",
    "claim",
    "load",
    "main",
    "prove_all",
    "rational_point",
]
