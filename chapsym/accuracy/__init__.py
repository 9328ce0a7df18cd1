"""A ball rolled to an accuracy: precision, order and steps by a law, the error estimated by the run itself."""

from .answer import Accurate, Attempt, Choice, Method, Request, accurate, distance, foreseen, methods, take
from .motion import roll

__all__ = [
    "Accurate", "Attempt", "Choice", "Method", "Request", "accurate", "distance", "foreseen", "methods", "roll", "take",
]  # fmt: skip
