"""The texts of a kernel: with every codegen pass, and without one of them.  The only module here that loads SymPy."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

from chapsym.codegen import build, passes
from chapsym.proofs.kernels import KERNELS

_KERNELS = {kernel.name: kernel for kernel in KERNELS}

#: What the passes are called that can be left out.
PASSES = passes.PASSES


@dataclass(frozen=True)
class Text:
    """One text of a kernel: the pass it goes without ("" for none), the function, and its + - * /."""

    kernel: str
    without: str
    source: str
    function: Callable[..., Any]
    operations: int


@cache
def text(kernel: str, without: str = "") -> Text:
    """The text of a kernel without a pass."""
    chosen = tuple(p for p in PASSES if p != without)
    source = build.code(_KERNELS[kernel], chosen)
    scope: dict[str, Any] = {}
    exec(compile(source, f"{kernel}.py", "exec"), scope)  # our own text, never a user's
    return Text(kernel, without, source, scope[kernel], passes.operations(_KERNELS[kernel], chosen))


def texts(kernel: str) -> list[Text]:
    """The text with all passes, and those without one that differ from it."""
    whole = text(kernel)
    others = [text(kernel, name) for name in PASSES]
    return [whole, *(t for t in others if t.source != whole.source)]


def outputs(kernel: str) -> int:
    """How many numbers a kernel returns."""
    return math.prod(_KERNELS[kernel].shape)
