"""The rungs of the precision ladder: how a number is made, rooted and written on each."""

from .rungs import Ball, Digits, Double, Rung

__all__ = ["Ball", "Digits", "Double", "Rung"]
