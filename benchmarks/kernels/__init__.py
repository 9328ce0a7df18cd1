"""The errors of every generated kernel in ulps, beside its time: per kernel and per codegen pass."""

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .search import Worst

__all__ = ["Row", "as_json", "measure_kernels", "table"]


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


def table(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """The rows of a table: the worst error, the condition number there, and the worst error in units of it."""
    return [
        {
            "kernel": row.kernel,
            "output": row.output,
            "without": row.without or "-",
            "operations": row.operations,
            "ns": row.nanoseconds,
            "worst ulps": row.worst.ulps,
            "condition": row.worst.condition,
            "where": row.worst.stratum,
            "ulps / condition": row.hardest.share,
        }
        for row in rows
    ]


def as_json(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """The rows as plain data; a time that was not taken, or an error that is not finite, is None."""
    return [_plain(asdict(row) | {"worst": _worst(row.worst), "hardest": _worst(row.hardest)}) for row in rows]


def _worst(worst: "Worst") -> dict[str, Any]:
    return asdict(worst) | {"share": worst.share}


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _plain(one) for key, one in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(one) for one in value]
    finite = not isinstance(value, float) or value - value == 0.0
    return value if finite else None
