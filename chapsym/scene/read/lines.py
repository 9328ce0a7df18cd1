"""On which line of a TOML text a key stands: TOML's own parser says, given the text up to each statement."""

import re
import tomllib
from collections.abc import Sequence
from functools import lru_cache
from itertools import islice
from typing import Any

#: Longer files, and statements that could end on more lines than this, get their errors without a line.
MOST_LINES, MOST_ENDS = 5_000, 300
#: What a statement of several lines ends with.
_END = re.compile(r"[]}]|\"\"\"|'''")


def line_of(text: str, path: Sequence[str | int]) -> int | None:
    """The line, from 1 on, on which the statement that gives the key at `path` begins; None if there is none.

    Keys never vanish as more statements are read, so the first after which the key is there is found by bisection.
    """
    lines = _lines(text)
    if len(lines) > MOST_LINES or not _has(_said(text), path):
        return None
    starts = _statements(text)
    low, high = 0, len(starts)  # the key is not there after `low` statements, and is after `high`
    while high - low > 1:
        middle = (low + high) // 2
        if _has(_said("\n".join(lines[: starts[middle]])), path):
            high = middle
        else:
            low = middle
    return starts[low] + 1 if starts else None


def _lines(text: str) -> list[str]:
    return text.replace("\r\n", "\n").split("\n")


@lru_cache(maxsize=1)
def _statements(text: str) -> list[int]:
    """The index of the line on which each statement begins; none where one of them has no end that can be found."""
    lines = _lines(text)
    found: list[int] = []
    start = 0
    while start < len(lines):
        ends = (i for i in range(start, len(lines)) if i == start or _END.search(lines[i]))
        whole = (i for i in islice(ends, MOST_ENDS) if _said("\n".join(lines[start : i + 1])) is not None)
        end = next(whole, None)
        if end is None:
            return []
        found.append(start)
        start = end + 1
    return found


def _said(text: str) -> Any:
    """The text as data; None if it is not TOML, such as a statement that is cut."""
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError):
        return None


def _has(data: Any, path: Sequence[str | int]) -> bool:
    """Whether the data have something at a path of keys and, in arrays, indices."""
    for part in path:
        in_table = isinstance(data, dict) and part in data
        in_list = isinstance(data, list) and isinstance(part, int) and part < len(data)
        if not (in_table or in_list):
            return False
        data = data[part]
    return True
