"""The form of what is in a certificate: lists, texts and names that are not too long."""

from collections.abc import Sequence
from typing import Any

from .interval import Rejected
from .trees import check_name

#: Of each list in a file, the letters of a text, and the names of an algebra.
MOST, MOST_LETTERS, MOST_NAMES = 2_000, 4_000, 200


def many(data: Any, where: str) -> list[Any]:
    """A list, not too long."""
    if not isinstance(data, list) or len(data) > MOST:
        raise Rejected(f"{where} must have a list of at most {MOST}")
    return data


def text(data: Any, where: str) -> None:
    """Raises Rejected unless this is a text of one line, not too long."""
    if not isinstance(data, str) or not 0 < len(data) <= MOST_LETTERS or not data.isprintable():
        raise Rejected(f"{where} must have a text of at most {MOST_LETTERS} letters, in one line")


def chosen(data: Any, among: Sequence[str], where: str) -> None:
    """Raises Rejected unless this is one of some words."""
    if not isinstance(data, str) or data not in among:
        raise Rejected(f"{where} must be one of: {', '.join(among)}")


def distinct(data: Any, where: str) -> set[str]:
    """The names of a list, each of which stands there once."""
    if len(many(data, where)) > MOST_NAMES:
        raise Rejected(f"{where} has more than {MOST_NAMES} names")
    for name in data:
        check_name(name, where)
    if len(set(data)) < len(data):
        raise Rejected(f"{where} has a name twice")
    return set(data)


def sized(data: Any, size: int, where: str) -> None:
    """Raises Rejected unless this is a list of that length."""
    if not isinstance(data, list) or len(data) != size:
        raise Rejected(f"{where} must have a list of {size}")
