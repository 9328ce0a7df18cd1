"""The forms of the parts of a certificate, described by shapes, which `check_shape` reads.

{"name": shape, "name?": shape}   an object with exactly these names; names with ? are optional
[shape], [shape, ...]             a list, not too long; a non-empty list
(shape, ...)                      a list of this length, item by item
("word", ...)                     one of these words
range(...)                        an integer in the range
a pattern                         a text that matches it
a type                            a value of this type
a function of data and a place    raises Rejected itself
"""

import re
from collections.abc import Collection, Sequence
from typing import Any

from .document import check_names, count, sized
from .interval import Rejected
from .trees import check_name

#: The most items of a list, letters of a text, names of an algebra, and rows or columns of a matrix.
MOST, MOST_LETTERS, MOST_NAMES, MOST_ROWS = 2_000, 4_000, 200, 5
#: The form of an index into a list.
NUMBER = range(MOST)


def check_shape(data: Any, shape: Any, where: str = "") -> None:
    """Raises Rejected unless the data have the shape; `where` is their place, for the message."""
    if isinstance(shape, dict):
        there = data if isinstance(data, dict) else {}
        wanted = {name.rstrip("?"): of for name, of in shape.items() if name[-1:] != "?" or name[:-1] in there}
        check_names(data, wanted, where if where else "the certificate")
        for name, of in wanted.items():
            check_shape(data[name], of, f"{name} of {where}" if where else name)
    elif isinstance(shape, list):
        for i, one in enumerate(many(data, where)):
            check_shape(one, shape[0], f"{where} {i}")
        if not data and shape[1:]:
            raise Rejected(f"{where} must not be empty")
    elif isinstance(shape, tuple) and all(isinstance(one, str) for one in shape[:1] or [0]):
        chosen(data, shape, where)
    elif isinstance(shape, tuple):
        sized(data, len(shape), where)
        for one, of in zip(data, shape, strict=True):
            check_shape(one, of, where)
    elif isinstance(shape, range):
        count(data, shape[0], shape[-1], where)
    elif isinstance(shape, re.Pattern):
        if not isinstance(data, str) or not shape.fullmatch(data):
            raise Rejected(f"{where} must be a text such as {shape.pattern}")
    elif isinstance(shape, type):
        if type(data) is not shape:
            raise Rejected(f"{where} must be of the kind {shape.__name__}")
    else:
        shape(data, where)


def anything(data: object, where: str) -> None:
    """The shape of data that are checked elsewhere."""


#: The names that every certificate has.
HEAD = dict.fromkeys(("format", "kind", "statement", "digest"), anything)


def many(data: object, where: str) -> list[Any]:
    """The data; raises Rejected unless this is a list, not too long."""
    if not isinstance(data, list) or len(data) > MOST:
        raise Rejected(f"{where} must be a list of at most {MOST}")
    return data


def text(data: object, where: str) -> None:
    """Raises Rejected unless this is a non-empty text of one line, not too long."""
    if not isinstance(data, str) or not 0 < len(data) <= MOST_LETTERS or not data.isprintable():
        raise Rejected(f"{where} must be a text of at most {MOST_LETTERS} letters, in one line")


def chosen(data: object, among: Sequence[str], where: str) -> None:
    """Raises Rejected unless this is one of some words."""
    if not isinstance(data, str) or data not in among:
        raise Rejected(f"{where} must be one of: {', '.join(among)}")


def names(data: Any, where: str) -> None:
    """Raises Rejected unless this is a list of different names, not too many."""
    if len(many(data, where)) > MOST_NAMES:
        raise Rejected(f"{where} has more than {MOST_NAMES} names")
    for name in data:
        check_name(name, where)
    once(data, where)


def once(data: Collection[object], where: str) -> None:
    """Raises Rejected if an item occurs twice."""
    if len(set(data)) < len(data):
        raise Rejected(f"{where} has a name twice")


def within(number: int, of: Sequence[Any], where: str) -> Any:
    """The item of a list with this index."""
    return of[count(number, 0, len(of) - 1, where)]


def check_rows(data: Any, of: Any, where: str) -> None:
    """Raises Rejected unless these are rows of equal length, not too many, of entries with a shape."""
    check_shape(data, [[of, ...], ...], where)
    if len(set(map(len, data))) > 1 or max(len(data), len(data[0])) > MOST_ROWS:
        raise Rejected(f"{where} has a matrix whose rows are not of one length, or more than {MOST_ROWS}")
