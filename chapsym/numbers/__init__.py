"""The rungs of the precision ladder: how a number is made, rooted and written on each."""

from chapsym.renamed import attributes

from .pair import Pair
from .rungs import NAMED, Digits, Double, Enclosure, Quad, Rung, Single, rung

__all__ = ["NAMED", "Digits", "Double", "Enclosure", "Pair", "Quad", "Rung", "Single", "rung"]

__getattr__ = attributes(__name__, {"Ball": "Enclosure"})
