"""Old names, which work for one more release: each warns, and names the new one."""

import sys
import warnings
from collections.abc import Callable, Mapping
from types import FrameType
from typing import Any

#: What may stand between the line that uses an old name and `renamed`.
BETWEEN = ("chapsym", "importlib", "pydantic")


class Renamed(FutureWarning):
    """An old name was used; Python shows it where that was, and the command prints it as one line."""


def renamed(old: str, new: str) -> None:
    """Warns of an old name, at the line that called chapsym."""
    frame, level = sys._getframe(1), 2
    while frame.f_back is not None and _room(frame) in BETWEEN:
        frame = frame.f_back
        level += _room(frame) != "importlib"  # whose frames `warnings` does not count
    warnings.warn(f"{old} is now {new}; the old name works until the next release", Renamed, stacklevel=level)


def _room(frame: FrameType) -> str:
    return str(frame.f_globals.get("__name__", "")).partition(".")[0]


def attributes(module: str, names: Mapping[str, str]) -> Callable[[str], Any]:
    """A `__getattr__` for a module whose old names are the keys of `names`; raises AttributeError for all others."""

    def get(name: str) -> Any:
        if name not in names:
            raise AttributeError(f"module {module!r} has no attribute {name!r}")
        renamed(f"{module}.{name}", f"{module}.{names[name]}")
        return getattr(sys.modules[module], names[name])

    return get


def in_words(identifier: str) -> str:
    """What a reader sees where JSON keeps the old name of a precision: "quad" is double-double, "Ball" an enclosure."""
    return identifier.replace("quad", "double-double").replace("Ball(", "Enclosure(")
