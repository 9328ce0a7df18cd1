"""A ball rolled to an accuracy: a law chooses precision, order and steps, and the run estimates its error."""

from .answer import Accurate, Attempt, Choice, Method, Request, accurate, distance, foreseen, methods, take
from .motion import roll

__all__ = [
    "Accurate", "Attempt", "Choice", "Method", "Request", "accurate", "distance", "foreseen", "methods", "roll", "take",
]  # fmt: skip
