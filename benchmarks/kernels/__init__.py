"""The errors of every generated kernel in ulps, in sampled states of every stratum.

An ulp is 2^-52 of the largest component of the exact output; of 𝒦, or of the level, where the kernel is a residual;
and ⟨𝒦,γ⟩ is measured on the scale of 𝒦, whose own rounding moves it by as much.  The condition number κ is
Σⱼ |∂f/∂xⱼ||xⱼ| in the largest component, relative to that size: rounding every argument by half an ulp moves the output
by up to κ/2 ulps, so an error of a few κ is as good as one can ask.
"""

import json
import math
from collections.abc import Callable, Sequence
from operator import attrgetter
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from mpmath import MPContext, mpf

from chapsym import generated
from chapsym.files import Data
from chapsym.generated import TABLE

from .states import CHANGES, DRAWN, arguments

#: Digits of the reference for the errors.
CONTEXT = MPContext()
CONTEXT.dps = 90
ULP = 2.0**-52
#: The relative change of an argument from which its derivative is taken: its error is of the same order.
NUDGE = CONTEXT.mpf(10) ** -25
SEED = 20071
#: States of a stratum: quick and full.
SAMPLED = {True: 2, False: 40}
MANIFEST = Path(generated.__file__).parent / "manifest.json"

Kernel = Callable[..., Any]
KERNELS: dict[str, Kernel] = {name: getattr(generated, name) for name in TABLE}
Groups = dict[str, Sequence[mpf]]
#: One view of an output: its values, and what its error is relative to.
Seen = tuple[Sequence[mpf], mpf]


class View(NamedTuple):
    """A part of a kernel's output that has a scale of its own, from the output and the arguments by group."""

    values: Callable[[Sequence[mpf], Groups], Sequence[mpf]] = lambda output, groups: output
    size: Callable[[Sequence[mpf], Groups], mpf] | None = None  # unless it is its own largest component


def _largest(values: Sequence[mpf], groups: Groups) -> mpf:
    return max(map(abs, values))


def _vertical(output: Sequence[mpf], groups: Groups) -> Sequence[mpf]:
    return [sum((a * b for a, b in zip(output, groups["gamma"], strict=True)), CONTEXT.mpf(0))]


def _rolled(output: Sequence[mpf], groups: Groups) -> mpf:
    state = ("rotation", "gamma", "mass_tensor", "D")
    return max(map(abs, generated.momentum(*(x for name in state for x in groups[name]))))


def _solved(output: Sequence[mpf], groups: Groups) -> mpf:
    return max(map(abs, groups["half_momentum"])) * (1 + sum(x * x for x in groups["gibbs"]))


def _part(first: int, last: int) -> View:
    return View(lambda output, groups: output[first:last])


VIEWS: dict[str, dict[str, View]] = {
    "momentum": {"𝒦": View(), "⟨𝒦,γ⟩": View(_vertical, _largest)},
    "contact_momentum": {"K": View(), "⟨K,γ⟩": View(_vertical, _largest)},
    "residual": {"r": View(size=_rolled), "⟨r,γ⟩": View(_vertical, _rolled)},
    "gibbs_residual": {"r": View(size=_solved), "⟨r,γ⟩": View(_vertical, _solved)},
    "invariants": {"h": _part(0, 1), "n": _part(1, 2), "unit": _part(2, 3)},
    "gibbs_newton": {"det": _part(0, 1), "N": _part(1, 4), "C": _part(4, 13)},
    "vertical_level": {
        "f": _part(0, 1)._replace(size=lambda output, groups: abs(groups["level"][0])),
        "fv": _part(1, 2),
    },
}


class Worst(NamedTuple):
    """An error that was met: in ulps, the condition number there, the stratum, and the arguments."""

    ulps: float
    condition: float
    stratum: str
    arguments: tuple[float, ...]

    @property
    def share(self) -> float:
        """The error in units of what a rounding of the arguments by an ulp does, or of an ulp if that is more."""
        return self.ulps / max(1.0, self.condition)

    def as_json(self) -> Data:
        """All of it, and its share; an error that is not finite is None."""
        return {name: finite(x) for name, x in (self._asdict() | {"share": self.share}).items()}


def finite(x: object) -> object:
    """None for a number that JSON has not."""
    return None if isinstance(x, float) and not math.isfinite(x) else x


def grouped(kernel: str, arguments: Sequence[mpf]) -> Groups:
    """Flat arguments by group."""
    rest = iter(arguments)
    return {name: [next(rest) for _ in range(length)] for name, length in TABLE[kernel][1]}


def seen(kernel: str, function: Kernel, point: Sequence[mpf | float], at: Sequence[mpf] = ()) -> dict[str, Seen]:
    """The views of the results of a kernel's text at a point, as mpf; `at`: the point as mpf, if it is of floats."""
    result, groups = function(*point), grouped(kernel, at or point)
    output = [CONTEXT.mpf(x) for x in (result if isinstance(result, tuple) else (result,))]
    found = {}
    for name, view in VIEWS.get(kernel, {"": View()}).items():
        values = view.values(output, groups)
        found[name] = values, view.size(output, groups) if view.size else max(map(abs, values))
    return found


def errors(kernel: str, function: Kernel, stratum: str, given: Sequence[float]) -> dict[str, Worst]:
    """The errors of a text of the kernel in floats at one point, by the view, against the kernel in mpmath."""
    point = [CONTEXT.mpf(x) for x in given]
    reference = KERNELS[kernel]
    exact, found = seen(kernel, reference, point), seen(kernel, function, given, point)
    moved = [seen(kernel, reference, [*point[:j], x * (1 + NUDGE), *point[j + 1 :]]) for j, x in enumerate(point) if x]
    worst = {}
    for name, (values, size) in exact.items():
        changes = (sum(abs(other[name][0][i] - x) for other in moved) for i, x in enumerate(values))
        condition = float(max(changes) / NUDGE / size) if size else 0.0
        worst[name] = Worst(_off(found[name][0], values, size), condition, stratum, tuple(given))
    return worst


def _off(found: Sequence[mpf], values: Sequence[mpf], size: mpf) -> float:
    if not all(CONTEXT.isfinite(x) for x in found):
        return math.inf
    off = max(abs(a - b) for a, b in zip(found, values, strict=True))
    return float(off / size) / ULP if size else (0.0 if off == 0 else math.inf)


def sampled(kernel: str, function: Kernel, states: int) -> dict[str, list[Worst]]:
    """The errors of a text of the kernel at a number of seeded states of each stratum, by the view."""
    found: dict[str, list[Worst]] = {}
    for index, stratum in enumerate(CHANGES):
        rng = np.random.default_rng([SEED, index])
        for _ in range(states):
            at = arguments(kernel, stratum, list(rng.uniform(size=DRAWN)))
            for view, one in errors(kernel, function, stratum, at).items():
                found.setdefault(view, []).append(one)
    return found


class Kernels:
    """The section of the trade: every kernel, or those that are named; a row for each part of the output of each.

    kernel, output: the kernel, and the part of its output ("" for all of it) that the errors are of.
    operations: + - * / in its text.  strata: the worst error of the states of each stratum, in ulps.
    worst, hardest: the state with the largest error, and that with the largest share of its condition number.
    """

    title = "kernels: errors in ulps"

    def __init__(self, quick: bool, say: Callable[[str], None], kernels: Sequence[str] = tuple(TABLE)) -> None:
        texts = json.loads(MANIFEST.read_text(encoding="utf-8"))["kernels"]
        self.rows: list[dict[str, Any]] = []
        for name in kernels:
            say(f"kernels: {name}")
            for view, met in sampled(name, KERNELS[name], SAMPLED[quick]).items():
                strata = {stratum: max(one.ulps for one in met if one.stratum == stratum) for stratum in CHANGES}
                worst, hardest = (max(met, key=attrgetter(measure)) for measure in ("ulps", "share"))
                self.rows.append({
                    "kernel": name, "output": view, "operations": texts[name]["operations"], "strata": strata,
                    "worst": worst, "hardest": hardest,
                })  # fmt: skip

    def table(self) -> list[Data]:
        """The worst error, the condition number there, and the worst error in units of it, for each row."""
        return [
            {
                **{name: row[name] for name in ("kernel", "output", "operations")}, "worst ulps": row["worst"].ulps,
                "condition": row["worst"].condition, "where": row["worst"].stratum,
                "ulps / condition": row["hardest"].share,
            }
            for row in self.rows
        ]  # fmt: skip

    def sentences(self) -> list[str]:
        """The meaning of the columns."""
        return ["errors against 90 digits"]

    def as_json(self) -> Data:
        """All that was measured, as plain data; an error that is not finite is None."""
        return {
            "title": self.title,
            "kernels": [
                row | {
                    "without": "",  # once the codegen pass that a text went without
                    "strata": {name: finite(x) for name, x in row["strata"].items()},
                    "worst": row["worst"].as_json(), "hardest": row["hardest"].as_json(),
                }
                for row in self.rows
            ],
        }  # fmt: skip
