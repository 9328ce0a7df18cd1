"""Errors of a kernel in ulps against 60 digits, and what a rounding of its arguments alone would do.

An ulp is 2^-52 of the largest component of the exact output; of 𝒦, or of the level, where the kernel is a residual;
and ⟨𝒦,γ⟩ is measured on the scale of 𝒦, whose own rounding moves it by as much.  The condition number κ is
Σⱼ |∂f/∂xⱼ||xⱼ| in the largest component, relative to that size: rounding every argument by half an ulp moves the output
by up to κ/2 ulps, so an error of a few κ is as good as one can ask.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import mpmath

from chapsym.generated import TABLE, momentum

DIGITS = 60
ULP = 2.0**-52
#: The relative change of an argument from which its derivative is taken: its error is of the same order.
NUDGE = 25

CONTEXT = mpmath.MPContext()
CONTEXT.dps = DIGITS + 30

Kernel = Callable[..., Any]
View = Callable[[Sequence[Any], dict[str, Sequence[Any]]], Sequence[Any]]


def _all(values: Sequence[Any], groups: dict[str, Sequence[Any]]) -> Sequence[Any]:
    return values


def _part(first: int, last: int) -> View:
    return lambda values, groups: values[first:last]


def _vertical(values: Sequence[Any], groups: dict[str, Sequence[Any]]) -> Sequence[Any]:
    return [sum((a * b for a, b in zip(values, groups["gamma"], strict=True)), CONTEXT.mpf(0))]


#: What is looked at of a kernel's output: all of it at one scale, unless its parts have scales of their own.
VIEWS: dict[str, dict[str, View]] = {
    "momentum": {"𝒦": _all, "⟨𝒦,γ⟩": _vertical},
    "contact_momentum": {"K": _all, "⟨K,γ⟩": _vertical},
    "residual": {"r": _all, "⟨r,γ⟩": _vertical},
    "gibbs_residual": {"r": _all, "⟨r,γ⟩": _vertical},
    "invariants": {"h": _part(0, 1), "n": _part(1, 2), "unit": _part(2, 3)},
    "gibbs_newton": {"det": _part(0, 1), "N": _part(1, 4), "C": _part(4, 13)},
    "vertical_level": {"f": _part(0, 1), "fv": _part(1, 2)},
}


def views(kernel: str) -> dict[str, View]:
    """The parts of a kernel's output, by name."""
    return VIEWS.get(kernel, {"": _all})


def _size(kernel: str, view: str, groups: dict[str, Sequence[Any]], output: Sequence[Any], value: Sequence[Any]) -> Any:
    """What an error is relative to."""
    if kernel == "residual":
        rolled = momentum(*groups["rotation"], *groups["gamma"], *groups["mass_tensor"], *groups["D"])
        return max(map(abs, rolled))
    if kernel == "gibbs_residual":
        return max(map(abs, groups["half_momentum"])) * (1 + sum(x * x for x in groups["gibbs"]))
    if VIEWS.get(kernel, {}).get(view) is _vertical:
        return max(map(abs, output))
    if view == "f":
        return abs(groups["level"][0])
    return max(map(abs, value))


@dataclass(frozen=True)
class Exact:
    """The values of a kernel's views at one point, what an error is relative to, and the condition numbers."""

    values: dict[str, list[Any]]
    sizes: dict[str, Any]
    conditions: dict[str, float]


def grouped(kernel: str, arguments: Sequence[Any]) -> dict[str, Sequence[Any]]:
    """Flat arguments by group."""
    found, at = {}, 0
    for name, length in TABLE[kernel][1]:
        found[name], at = arguments[at : at + length], at + length
    return found


def _run(function: Kernel, arguments: Sequence[Any]) -> Sequence[Any]:
    result = function(*arguments)
    return result if isinstance(result, tuple) else (result,)


def _seen(kernel: str, output: Sequence[Any], arguments: Sequence[Any]) -> dict[str, list[Any]]:
    groups = grouped(kernel, arguments)
    return {name: list(view(output, groups)) for name, view in views(kernel).items()}


def exact(kernel: str, function: Kernel, arguments: Sequence[float]) -> Exact:
    """The kernel in mpmath at the very floats that are given."""
    point = [CONTEXT.mpf(x) for x in arguments]
    output, groups = _run(function, point), grouped(kernel, point)
    values = _seen(kernel, output, point)
    sizes = {name: _size(kernel, name, groups, output, value) for name, value in values.items()}
    moved = {name: [CONTEXT.mpf(0)] * len(value) for name, value in values.items()}
    nudge = CONTEXT.mpf(10) ** -NUDGE
    for j, x in enumerate(point):
        if x == 0:
            continue
        moved_to = [*point[:j], x * (1 + nudge), *point[j + 1 :]]
        beside = _seen(kernel, _run(function, moved_to), moved_to)
        for name, value in values.items():
            moved[name] = [m + abs(b - a) / nudge for m, a, b in zip(moved[name], value, beside[name], strict=True)]
    conditions = {name: float(max(m) / sizes[name]) if sizes[name] else 0.0 for name, m in moved.items()}
    return Exact(values, sizes, conditions)


def ulps(kernel: str, function: Kernel, arguments: Sequence[float], truth: Exact) -> dict[str, float]:
    """The errors of the views in ulps, for a kernel run on floats."""
    output = [CONTEXT.mpf(x) for x in _run(function, arguments)]
    found = _seen(kernel, output, [CONTEXT.mpf(x) for x in arguments])
    return {name: _off(found[name], truth.values[name], truth.sizes[name]) for name in found}


def _off(found: Sequence[Any], value: Sequence[Any], size: Any) -> float:
    if not all(CONTEXT.isfinite(x) for x in found):
        return float("inf")
    off = max(abs(a - b) for a, b in zip(found, value, strict=True))
    return float(off / size) / ULP if size else (0.0 if off == 0 else float("inf"))
