"""Certificates of claims as files of Rocq (Coq 8.16), a second judge of the same data.

A statement is a theorem about every field of characteristic 0, or about matrices of every size over every commutative
ring in which the denominators of the statement are units.  Theorems with a point show that its hypotheses can be true,
and that a printed statement is false.  Nothing here has to be trusted: Rocq judges the text.
"""

from .files import Written, former, write

__all__ = ["Written", "former", "write"]
