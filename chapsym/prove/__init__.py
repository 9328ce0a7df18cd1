"""Exact verdicts: claims, evidence, negative controls, and the runner."""

from .claims import Claim, Equation, Judgement, Point, Proof, Verdict, claim, rational_point
from .runner import load, main, prove_all

__all__ = [
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
