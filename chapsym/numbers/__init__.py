"""The precisions: how a number is made, rooted and written on each."""

from chapsym.renamed import attributes

from .pair import Pair
from .precisions import NAMED, Digits, Double, Enclosure, Precision, Quad, Single, named

__all__ = ["NAMED", "Digits", "Double", "Enclosure", "Pair", "Precision", "Quad", "Single", "named"]

__getattr__ = attributes(__name__, {"Ball": "Enclosure", "Rung": "Precision", "rung": "named"})
