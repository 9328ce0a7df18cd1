"""On which line of a TOML text a key stands: TOML's own parser says, given the first lines of it."""

import re
import tomllib
from collections.abc import Sequence
from typing import Any

#: Longer files, and statements that could end on more lines than this, get their errors without a line.
MOST_LINES, MOST_ENDS = 5_000, 300
#: What the last line of a statement has; or it is blank, or a comment.
_END = re.compile(r"[]}=]|\"\"\"|'''|^\s*(#|$)")


def line_of(text: str, path: Sequence[str | int]) -> int | None:
    """The line, from 1 on, on which the statement that gives the key at `path` begins; None if there is none.

    Keys never vanish as more statements are read, so the first after which the key is there is found by bisection.
    """
    lines = text.replace("\r\n", "\n").split("\n")
    if len(lines) > MOST_LINES or not _has(_said(lines), path):
        return None
    low, high = 0, len(lines)  # of whole statements: the key is not there after `low` lines, and is after `high`
    while high - low > 1:
        middle = (low + high) // 2
        ends = [n for n in (*range(middle, high), *range(middle - 1, low, -1)) if _END.search(lines[n - 1])]
        end = next((n for n in ends[:MOST_ENDS] if _said(lines[:n]) is not None), None)
        if end is None:
            return low + 1 if len(ends) <= MOST_ENDS else None
        if _has(_said(lines[:end]), path):
            high = end
        else:
            low = end
    return low + 1


def _said(lines: Sequence[str]) -> Any:
    """The text as data; None if it is not TOML, such as a statement that is cut."""
    try:
        return tomllib.loads("\n".join(lines))
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
