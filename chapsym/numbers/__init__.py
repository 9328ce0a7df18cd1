"""The rungs of the precision ladder: how a number is made, rooted and written on each."""

from .rungs import NAMED, Ball, Digits, Double, Rung, Single, rung

__all__ = ["NAMED", "Ball", "Digits", "Double", "Rung", "Single", "rung"]
