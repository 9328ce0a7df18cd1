"""The map in float64: step, trajectory, compositions of higher order, the way back; in three dimensions and in n."""

from .ball import Ball
from .ball_n import BallN, axial, skew

__all__ = [
    "Ball", "BallN", "axial", "skew",
]  # fmt: skip
