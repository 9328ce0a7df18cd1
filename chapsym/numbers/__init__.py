"""The precisions: making and writing the numbers of each."""

from .pair import Pair
from .precisions import (
    NAMED,
    Digits,
    Double,
    DoubleDouble,
    Enclosure,
    Precision,
    Single,
    brief,
    in_words,
    is_a,
    is_whole,
    named,
    own_name,
    plain_text,
)

__all__ = [
    "NAMED", "Digits", "Double", "DoubleDouble", "Enclosure", "Pair", "Precision", "Single",
    "brief", "in_words", "is_a", "is_whole", "named", "own_name", "plain_text",
]  # fmt: skip
