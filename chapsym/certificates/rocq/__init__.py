"""Certificates of kind no-invariant-measure as theorems of Rocq on real numbers, which coq-interval proves.

A theorem states what `checker/measure.py` proves with its own intervals, for every ball, momentum and level within the
radius: they define a circle and a small branch; and every orbit of the step from each of the two starts has the Gibbs
vectors and γ of the file, correctly rounded, turns in one direction, and has the displacement of the file.  It states
neither the existence of the steps nor the consequences of the displacements.  Nothing here has to be trusted: Rocq
judges it.
"""

from .theorem import Theorem, write

#: The only kind of certificate that this package writes for Rocq.
KIND = "no-invariant-measure"

__all__ = ["KIND", "Theorem", "write"]
