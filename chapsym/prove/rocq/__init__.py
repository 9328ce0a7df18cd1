"""Certificates of claims as files of Rocq (Coq 8.16), a second judge of the same data.

A statement is a theorem about every field of characteristic 0, or about matrices of every size over every commutative
ring in which the denominators of the statement are units.  That its hypotheses can be true, and that a printed
statement is false, are theorems that give a point.  Nothing here has to be trusted: Rocq judges what is written.
"""

from .files import Written, write

__all__ = ["Written", "write"]
