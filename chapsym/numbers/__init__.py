"""The rungs of the precision ladder: how a number is made, rooted and written on each."""

from .pair import Pair
from .rungs import NAMED, Ball, Digits, Double, Quad, Rung, Single, rung

__all__ = ["NAMED", "Ball", "Digits", "Double", "Pair", "Quad", "Rung", "Single", "rung"]
