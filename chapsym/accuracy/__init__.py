"""A ball rolled to an accuracy by long steps, in double precision or double-double, with an estimate of the error."""

from .answer import Accurate, Attempt, Choice, Method, Request, accurate, distance, foreseen, methods, take
from .motion import roll

__all__ = [
    "Accurate", "Attempt", "Choice", "Method", "Request", "accurate", "distance", "foreseen", "methods", "roll", "take",
]  # fmt: skip
