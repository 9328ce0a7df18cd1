"""The table of symbols: the paper uses many letters for several things.

Its source is the page docs/symbols.md, to which `templates/symbols.md` is a link.
"""

import re
from pathlib import Path
from typing import NamedTuple


class Symbol(NamedTuple):
    """One meaning of one symbol of the paper."""

    paper: str
    where: str
    chapsym: str
    meaning: str
    unit: str


_TEXT = (Path(__file__).parent / "templates" / "symbols.md").read_text(encoding="utf-8")
#: The text above and below the table.
_, INTRODUCTION, _TABLE, DIRECTION = _TEXT.rstrip("\n").split("\n\n")
_ROWS = (re.split(r"(?<!\\)\|", line)[1:-1] for line in _TABLE.splitlines()[2:])
SYMBOLS = tuple(Symbol(*(field.strip().replace("\\|", "|") for field in row)) for row in _ROWS)
