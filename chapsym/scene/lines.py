"""On which line of a TOML text a key stands: TOML's own parser says, given the text up to each line."""

import tomllib
from collections.abc import Sequence
from typing import Any

#: Longer files get their errors without a line: each look reads the text again.
MOST_LINES = 5_000


def line_of(text: str, path: Sequence[str | int]) -> int | None:
    """The line, from 1 on, on which the statement that gives the key at `path` begins; None if there is none.

    A text up to the end of a line either is TOML, and then says which keys stand so far, or ends within a statement of
    several lines.  Keys never vanish as more is read, so the line is found by bisection.
    """
    lines = text.replace("\r\n", "\n").split("\n")
    if len(lines) > MOST_LINES:
        return None
    ends = _Ends(lines)
    low, high = 0, len(lines)  # the key is not there after `low` lines, and is after `high`
    if not _has(ends.parsed(high)[1], path):
        return None
    while high - low > 1:
        middle = (low + high) // 2
        if _has(ends.parsed(middle)[1], path):
            high = middle
        else:
            low = middle
    return ends.beginning(high)


class _Ends:
    """What the text says up to each line."""

    def __init__(self, lines: list[str]) -> None:
        self.lines = lines
        self.known: dict[int, Any] = {0: {}}

    def read(self, count: int) -> Any:
        """The first `count` lines as data, or None where they end within a statement."""
        if count not in self.known:
            try:
                self.known[count] = tomllib.loads("\n".join(self.lines[:count]))
            except (ValueError, RecursionError):
                self.known[count] = None
        return self.known[count]

    def parsed(self, count: int) -> tuple[int, Any]:
        """At least `count` lines, up to the end of a statement, and their data."""
        while count < len(self.lines) and self.read(count) is None:
            count += 1
        return count, self.read(count)

    def beginning(self, end: int) -> int:
        """The line on which the statement begins that stands on line `end`."""
        before = end - 1
        while self.read(before) is None:
            before -= 1
        return before + 1


def _has(data: Any, path: Sequence[str | int]) -> bool:
    """Whether the data have something at a path of keys and, in arrays, indices."""
    for part in path:
        in_table = isinstance(data, dict) and part in data
        in_list = isinstance(data, list) and isinstance(part, int) and part < len(data)
        if not (in_table or in_list):
            return False
        data = data[part]
    return True
