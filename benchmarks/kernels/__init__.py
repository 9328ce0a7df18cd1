"""The errors of every generated kernel in ulps, beside its time: per kernel and per codegen pass."""

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .search import Worst

__all__ = ["Kernels", "Row", "measure_kernels"]


@dataclass(frozen=True)
class Row:
    """One output of one text of a kernel.

    kernel, output: the kernel, and the part of its output ("" for all of it) that the errors are of.
    without: the codegen pass that the text goes without; "" for the text that is committed.
    operations, nanoseconds: + - * / in the text, and the median time of a call in a compiled loop.
    strata: the worst error of the sampled states of each stratum, in ulps.
    worst, hardest: the state with the largest error, and that with the largest share of its condition number, with
    what Hypothesis' search found.
    """

    kernel: str
    output: str
    without: str
    operations: int
    nanoseconds: float
    strata: dict[str, float]
    worst: "Worst"
    hardest: "Worst"


def measure_kernels(
    quick: bool, progress: Callable[[str], None] = lambda text: None, kernels: Sequence[str] | None = None
) -> list[Row]:
    """Measures every kernel (or those named) with all passes, and without each pass that changes its text.

    quick: few states and a short search, and the time of the committed text only.  Raises KeyError for a name that is
    no kernel's, and ModuleNotFoundError where Hypothesis (the test extra) is not installed.
    """
    from chapsym.generated import TABLE

    rows: list[Row] = []
    for name in TABLE if kernels is None else kernels:
        progress(name)
        rows += _measured(name, quick)
    return rows


def _measured(kernel: str, quick: bool) -> list[Row]:
    from . import search, timing
    from .texts import texts

    found = texts(kernel)
    timed = found[:1] if quick else found
    times = timing.nanoseconds(timed, 5 if quick else 31, 20 if quick else 100)
    times += [float("nan")] * (len(found) - len(timed))
    reference = found[0].function
    points = search.sampled(kernel, reference, 2 if quick else 40)
    rows = []
    for text, nanoseconds in zip(found, times, strict=True):
        sampled = search.met(kernel, text.function, points)
        climbed = search.searched(kernel, text.function, reference, 20 if quick else 300)
        for view, met in sampled.items():
            strata = {s: max(w.ulps for w in met if w.stratum == s) for s in dict.fromkeys(w.stratum for w in met)}
            every = [*met, *climbed[view]]
            largest, hardest = (search.worst(every, key) for key in (lambda w: w.ulps, lambda w: w.share))
            rows.append(Row(kernel, view, text.without, text.operations, nanoseconds, strata, largest, hardest))
    return rows


@dataclass(frozen=True)
class Kernels:
    """The rows, as a section of the trade."""

    rows: list[Row]
    title: str = "kernels: errors in ulps, and times"

    def table(self) -> list[dict[str, Any]]:
        """The worst error, the condition number there, and the worst error in units of it, for each row."""
        return [
            {
                "kernel": row.kernel, "output": row.output, "without": row.without or "-",
                "operations": row.operations, "ns": row.nanoseconds, "worst ulps": row.worst.ulps,
                "condition": row.worst.condition, "where": row.worst.stratum, "ulps / condition": row.hardest.share,
            }
            for row in self.rows
        ]  # fmt: skip

    def sentences(self) -> list[str]:
        """What the columns are."""
        return [
            "errors against 60 digits; `without`: the codegen pass that the text goes without; times in a compiled loop"
        ]

    def as_json(self) -> dict[str, Any]:
        """All that was measured, as plain data; a time that was not taken, or an error that is not finite, is None."""
        return {"title": self.title, "kernels": [_plain(asdict(row) | _worst(row)) for row in self.rows]}


def _worst(row: Row) -> dict[str, Any]:
    """The two states of a row, with their shares."""
    return {name: asdict(one) | {"share": one.share} for name, one in vars(row).items() if name in ("worst", "hardest")}


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _plain(one) for key, one in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(one) for one in value]
    finite = not isinstance(value, float) or value - value == 0.0
    return value if finite else None
