"""On which line of a TOML text a key stands: TOML's own parser says, given the first lines of it."""

import re
import tomllib
from bisect import bisect_left
from collections.abc import Sequence
from itertools import islice
from typing import Any

#: Longer files, and statements that could end on more lines than this, get their errors without a line.
MOST_LINES, MOST_ENDS = 5_000, 300
#: What the last line of a statement has; or it is blank, or a comment.
_END = re.compile(r"[]}=]|\"\"\"|'''|^\s*(#|$)")


def line_of(text: str, path: Sequence[str | int]) -> int | None:
    """The line, from 1 on, on which the statement that gives the key at `path` begins; None if there is none.

    A statement is TOML by itself, and keys never vanish as more statements are read.
    """
    lines = text.replace("\r\n", "\n").split("\n")
    ends = [0]
    while len(lines) <= MOST_LINES and ends[-1] < len(lines):
        first = ends[-1]
        may_end = (n for n in range(first + 1, len(lines) + 1) if _END.search(lines[n - 1]))
        end = next((n for n in islice(may_end, MOST_ENDS) if _said(lines[first:n]) is not None), None)
        if end is None:
            return None
        ends.append(end)
    found = bisect_left(ends, True, key=lambda end: _has(_said(lines[:end]), path))
    return ends[found - 1] + 1 if found < len(ends) else None


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
