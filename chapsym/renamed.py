"""Old names, which work for one more release: each warns, and names the new one.

The command prints the warning as one line on standard error.
"""

import sys
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from types import FrameType
from typing import Any


class Renamed(DeprecationWarning):
    """An old name was used."""


#: What may stand between the code that uses an old name and `renamed`; it is not told of: Python shows a
#: DeprecationWarning to who runs a script only where it is of a line of the script.
BETWEEN = ("chapsym", "importlib", "pydantic")


def renamed(old: str, new: str) -> None:
    """Warns of an old name, on behalf of whatever called chapsym."""
    frame, level = sys._getframe(1), 2
    while frame.f_back is not None and _top(frame) in BETWEEN:
        frame = frame.f_back
        level += _top(frame) != "importlib"  # whose frames `warnings` does not count
    warnings.warn(f"{old} is now {new}; the old name works until the next release", Renamed, stacklevel=level)


def _top(frame: FrameType) -> str:
    return str(frame.f_globals.get("__name__", "")).partition(".")[0]


def attributes(module: str, names: Mapping[str, str]) -> Callable[[str], Any]:
    """A `__getattr__` for a module whose old names are the keys of `names`; raises AttributeError for all others."""

    def get(name: str) -> Any:
        if name not in names:
            raise AttributeError(f"module {module!r} has no attribute {name!r}")
        renamed(f"{module}.{name}", f"{module}.{names[name]}")
        return getattr(sys.modules[module], names[name])

    return get


@contextmanager
def told_on_standard_error() -> Iterator[None]:
    """Within it each old name is told once, in one line, as the command does; other warnings are as before."""
    lines: set[str] = set()

    def told(message: Any, category: type[Warning], *where: Any) -> None:
        if not issubclass(category, Renamed):
            show(message, category, *where)
        elif str(message) not in lines:
            lines.add(str(message))
            print(f"chapsym: {message}", file=sys.stderr)

    with warnings.catch_warnings():
        show = warnings.showwarning
        warnings.showwarning = told  # type: ignore[assignment]
        warnings.simplefilter("always", Renamed)
        yield


def in_words(identifier: str) -> str:
    """What a reader sees where JSON keeps the old name of a precision: "quad" is double-double, "Ball" an enclosure."""
    return identifier.replace("quad", "double-double").replace("Ball(", "Enclosure(")
