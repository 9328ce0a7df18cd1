"""The kernels' errors beside their times, as a section of the trade."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from benchmarks import kernels


@dataclass(frozen=True)
class Kernels:
    """The rows of `benchmarks.kernels`."""

    rows: list[kernels.Row]
    title: str = "kernels: errors in ulps, and times"

    def table(self) -> list[dict[str, Any]]:
        """A row for each output of each text of a kernel."""
        return kernels.table(self.rows)

    def sentences(self) -> list[str]:
        """What the columns are."""
        return [
            "errors against 60 digits; `without`: the codegen pass that the text goes without; times in a compiled loop"
        ]

    def as_json(self) -> dict[str, Any]:
        """All that was measured, as plain data."""
        return {"title": self.title, "kernels": kernels.as_json(self.rows)}


def measure(quick: bool, say: Callable[[str], None]) -> Kernels:
    """Measures every kernel."""
    return Kernels(kernels.measure_kernels(quick, lambda name: say(f"kernels: {name}")))
