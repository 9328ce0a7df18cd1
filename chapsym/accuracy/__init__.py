"""A ball rolled to an accuracy: precision, order and step from measured prices, the result verified on itself."""

from .answer import Accurate, accurate, foreseen
from .choice import Choice, choices
from .methods import Method, methods, take
from .prices import Prices, load_prices
from .request import Request, distance
from .rolled import roll
from .search import Attempt

__all__ = [
    "Accurate", "Attempt", "Choice", "Method", "Prices", "Request", "accurate", "choices", "distance", "foreseen",
    "load_prices", "methods", "roll", "take",
]  # fmt: skip
