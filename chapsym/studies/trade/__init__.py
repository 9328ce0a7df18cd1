"""`chapsym trade`: what speed costs in accuracy, measured, and whether the chooser meets what is asked of it."""

from collections.abc import Callable
from importlib import import_module
from typing import Any, Protocol

from ..harness import NotComparable, in_checkout, machine
from .frontier import Frontier, Point

__all__ = ["DRAWN", "SECTIONS", "Frontier", "NotComparable", "Point", "Section", "as_json", "measure", "missed"]

#: The sections, with the module that measures each, and those that have a frontier.
SECTIONS = {
    "rounding": "rounding", "contact": "balls", "state": "balls", "batch": "batch", "n4": "four", "n4-batch": "four",
    "requests": "requests", "kernels": "kernels",
}  # fmt: skip
DRAWN = ("rounding", "contact", "state", "batch", "n4", "n4-batch")


class Section(Protocol):
    """What a section found."""

    @property
    def title(self) -> str:
        """The title of its table."""

    def table(self) -> list[dict[str, Any]]:
        """The rows of its table."""

    def sentences(self) -> list[str]:
        """What is to be said under it."""

    def as_json(self) -> dict[str, Any]:
        """All that was measured, as plain data."""


def measure(section: str, quick: bool, say: Callable[[str], None] = lambda text: None) -> Section:
    """Measures a section; raises NotComparable where a reference is not confirmed.

    The kernels are measured by the benchmarks: BadInput where these are not.
    """
    name = SECTIONS[section]
    module = in_checkout("benchmarks", "kernels.section") if name == "kernels" else import_module(f".{name}", __name__)
    more: dict[str, Any] = {"of": section} if name == "balls" else {}
    if section == "n4-batch":
        more = {"balls": module.BATCH}
    found: Section = module.measure(quick, say, **more)
    return found


def missed(found: dict[str, Section]) -> str | None:
    """The sentence of what is not as it should be: a request that was not met."""
    from .requests import Outcomes

    for one in found.values():
        if isinstance(one, Outcomes) and one.hits < len(one.outcomes):
            return f"{len(one.outcomes) - one.hits} of {len(one.outcomes)} requests were not met"
    return None


def as_json(found: dict[str, Section], quick: bool) -> dict[str, Any]:
    """The machine and all that was measured, as plain data."""
    return {"machine": machine(), "quick": quick, "sections": {name: one.as_json() for name, one in found.items()}}
