"""The precisions: how a number is made and written on each."""

from chapsym.renamed import attributes

from .pair import Pair
from .precisions import NAMED, Digits, Double, DoubleDouble, Enclosure, Precision, Single, named, new_name

__all__ = ["NAMED", "Digits", "Double", "DoubleDouble", "Enclosure", "Pair", "Precision", "Single", "named", "new_name"]

__getattr__ = attributes(__name__, {"Ball": "Enclosure", "Quad": "DoubleDouble", "Rung": "Precision", "rung": "named"})
