"""Certificates of kind no-invariant-measure as theorems of Rocq over the real numbers, which coq-interval proves.

A theorem says what `checker/measure.py` finds out with its own intervals, of every ball, momentum and level within the
radius: they make a circle and a small branch; and every orbit of the step from each of the two starts has the Gibbs
vectors and γ of the file, correctly rounded, turns in one direction, and has the displacement of the file.  It does not
say that the steps exist, nor what follows from the displacements.  Nothing here has to be trusted: Rocq judges it.
"""

from .theorem import Theorem, write

#: The one kind of certificate that is written for Rocq here.
KIND = "no-invariant-measure"

__all__ = ["KIND", "Theorem", "write"]
