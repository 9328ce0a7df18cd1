"""The errors of a scene as sentences: the file, the line, the key, and what would be right."""

import re
import tomllib
from bisect import bisect_left
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from difflib import get_close_matches
from itertools import islice
from typing import TYPE_CHECKING, Any

from chapsym.dynamics import BadInput
from chapsym.files import Data

if TYPE_CHECKING:
    from pydantic_core import ErrorDetails

#: The keys of each table.
Keys = Mapping[str, Iterable[str]]

#: The tags of lists and matrices are no keys: errors leave them out.
LIST, MATRIX = "(list)", "(matrix)"
#: The largest number of listed problems of one file.
MOST_PROBLEMS = 5

#: The largest length of a file, and of candidate last lines of a statement, for errors with a line.
MOST_LINES, MOST_ENDS = 5_000, 300
#: A line that may end a statement; other such lines are blank, or comments.
_END = re.compile(r"[]}=]|\"\"\"|'''|^\s*(#|$)")

Path = tuple[str | int, ...]


class SceneError(BadInput):
    """The scene cannot be run as written; misfit: what does not fit, for a single key of a single ball."""

    misfit: "Misfit | None" = None


class Misfit(BadInput):
    """An error as a whole sentence, and the keys to its place in the checked table, or in the scene.

    For an impossible ball these are its table, "ball" or "start", and the name of the key.
    """

    def __init__(self, sentence: str, *path: str | int) -> None:
        super().__init__(sentence)
        self.path = path


@contextmanager
def said_by(table: str, key: str) -> Iterator[None]:
    """A context that assigns its errors to this key."""
    try:
        yield
    except Misfit:
        raise
    except BadInput as error:
        raise Misfit(str(error), table, key) from None


def place(name: str, text: str | None, path: Path) -> str:
    """The file, and the line on which the key stands if there is one: "ball.toml, line 3"."""
    for end in range(len(path), 0, -1):
        line = line_of(text, path[:end]) if text is not None else None
        if line is not None:
            return f"{name}, line {line}" if name else f"line {line}"
    return name


def described(errors: Sequence["ErrorDetails"], name: str, text: str | None, data: Data, keys: Keys) -> str:
    """All problems that pydantic found in `data`, one sentence each; `keys` has those of each table."""
    one_ball = not isinstance(data.get("ball"), list)
    errors = [error for error in errors if error["type"] != "too_short" or not _inside(error, errors)]
    words: list[str] = []
    for error in errors[:MOST_PROBLEMS]:
        path = _path(error)
        path = (path[0], *path[2:]) if one_ball and path[:2] == ("ball", 0) else path  # [ball] is a table, and no list
        where = place(name if not words else "", text, path)
        words.append(f"{where}: {_sentence(error, keys)}" if where else _sentence(error, keys))
    if len(errors) > MOST_PROBLEMS:
        words.append(f"and {len(errors) - MOST_PROBLEMS} more")
    return "; ".join(words)


def _inside(whole: "ErrorDetails", errors: Sequence["ErrorDetails"]) -> bool:
    """Whether parts of a list are wrong: pydantic drops them, and then finds the list too short."""
    length = len(whole["loc"])
    return any(len(error["loc"]) > length and error["loc"][:length] == whole["loc"] for error in errors)


def _path(error: "ErrorDetails") -> Path:
    """The keys and indices of an error; the tags of unions are none."""
    own = getattr(error.get("ctx", {}).get("error"), "path", ())
    return (*(part for part in error["loc"] if part not in (LIST, MATRIX)), *own)


def _key(path: Path) -> str:
    """The dotted name of a key; numbers of lists count from 1 on, and the first ball is "ball"."""
    parts = [str(part + 1) if isinstance(part, int) else part for part in path]
    if path[:2] == ("ball", 0):
        del parts[1]
    return ".".join(parts)


def _sentence(error: "ErrorDetails", keys: Keys) -> str:
    """One problem: its key and what would be right."""
    path, limits = _path(error), error.get("ctx", {})
    if isinstance(limits.get("error"), Misfit):
        return str(limits["error"])
    key = _key(path) or "the scene"
    if error["type"] == "extra_forbidden":
        return _unknown(path, keys)
    kinds: dict[str, str] = {
        "missing": "is missing",
        "int_type": "must be a whole number",
        "int_from_float": "must be a whole number",
        "int_parsing_size": "is beyond the range of whole numbers",
        "bool_type": "must be true or false",
        "string_type": "must be a text in quotes",
        "tuple_type": f"must be a list of {'names' if key == 'run.outputs' else 'numbers'} in brackets",
        "model_type": f"must be a table: [{key}]",
        "literal_error": f"must be {limits.get('expected')}",
        "too_long": f"must have {limits.get('max_length')} numbers",
        "too_short": f"must have at least {limits.get('min_length')} numbers"
        if path != ("ball",)
        else "must not be []",
        "greater_than_equal": f"must be at least {limits.get('ge')}",
        "less_than_equal": f"must be at most {limits.get('le')}",
        "string_pattern_mismatch": "must be one line of text, without control characters",
        "string_too_short": "must not be empty",
        "string_too_long": f"must have at most {limits.get('max_length')} characters",
    }
    words = kinds.get(error["type"], ": " + error["msg"].removeprefix("Value error, "))
    words = words.removeprefix(": it ")
    return f"{key}{words}" if words.startswith(":") else f"{key} {words}"


def _unknown(path: Path, keys: Keys) -> str:
    """The hint for an unknown key: a similar key, or the table that has this key."""
    wrong, table = str(path[-1]), _key(path[:-1])
    kind = next((str(part) for part in reversed(path[:-1]) if isinstance(part, str)), "")
    near = get_close_matches(wrong, list(keys[kind]), 1, 0.6)
    others = [name for name, own in keys.items() if wrong in own and name != kind]
    if near:
        meant = f"; did you mean {near[0]}?"
    elif others:
        meant = f"; it stands under [{others[0]}]" if others[0] else "; it stands at the top of the file"
    else:
        meant = f"; there are {', '.join(keys[kind])}"
    return f"{_key(path)} is not a key of {f'[{table}]' if table else 'a scene'}{meant}"


# The line of a key, found by parsing the first lines of a text.


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


def _said(lines: Sequence[str]) -> Data | None:
    """The text as data; None if it is not TOML, such as an incomplete statement."""
    try:
        return tomllib.loads("\n".join(lines))
    except (ValueError, RecursionError):
        return None


def _has(data: Any, path: Sequence[str | int]) -> bool:
    """Whether the data have an entry at a path of keys and, in arrays, indices."""
    for part in path:
        in_table = isinstance(data, dict) and part in data
        in_list = isinstance(data, list) and isinstance(part, int) and part < len(data)
        if not (in_table or in_list):
            return False
        data = data[part]
    return True
