"""The loops as C, compiled from generated/loops.c when chapsym is built; without it, as plain Python.

Both take the same steps, to the bit.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from chapsym.generated.loops_text import TEXT

from ..loops.twins import single


@cache
def loop(function: Callable[..., Any], dtype: Any = np.float64) -> Callable[..., Any]:
    """An exported function of the loops, for float64 or float32: compiled, or in Python without NumPy's warnings."""
    name = f"{function.__module__.rpartition('.')[2]}_{function.__name__}"
    if (table := _tables().get(np.dtype(dtype).name)) is not None:
        return table[name]
    _say_once()
    return np.errstate(all="ignore")(function if dtype is np.float64 else single(function))


def is_compiled() -> bool:
    """Whether the loops are compiled."""
    return bool(_tables())


@cache
def _tables() -> dict[str, dict[str, Callable[..., Any]]]:
    """The compiled loops by number type; empty if there are none, or if they were compiled from another text."""
    try:
        from . import compiled  # type: ignore[attr-defined]
    except ImportError:
        return {}
    if compiled.text != TEXT:
        _log.warning("the compiled loops are not those of generated/loops.c: install chapsym again to compile them")
        return {}
    return {"float64": compiled.double, "float32": compiled.single}


_log = logging.getLogger("chapsym")


@cache
def _say_once() -> None:
    _log.warning(
        "plain Python takes the steps, hundreds of times slower than C: install a C compiler, then chapsym again"
    )
