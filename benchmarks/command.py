"""What `chapsym bench` does: it measures, draws and prints the sections that are asked for."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

import benchmarks
from chapsym.cli import measured
from chapsym.cli.output import check_figure, check_known, console_for, fail, print_json, quiet, say

ABOUT = (
    "The map beside other ways, all in one process and interleaved. Ratios are of medians; times depend on the machine "
    "and on what else it does."
)


def measure(sections: Sequence[str], quick: bool, output: Path | None, as_json: bool, own: Any = None) -> None:
    """Measures the sections, or all of them, or that of one's own ball; fails with a sentence as every command does."""
    wanted = list(dict.fromkeys(sections or (benchmarks.SECTIONS if own is None else [benchmarks.OWN])))
    if own is not None and wanted != [benchmarks.OWN]:
        fail(f"a ball of your own goes with the section {benchmarks.OWN} alone", 2)
    check_known("section", wanted, benchmarks.SECTIONS)
    page = measured.is_page(output)
    if output is not None and not page:
        from . import figure

        check_figure(output, wanted, figure.AXES)
    results = {}
    for name in wanted:
        try:
            results[name] = benchmarks.run(name, quick, say, **_floats(own))
        except benchmarks.NotComparable as error:
            quiet()
            fail(f"bench {name}: {error}", 1)
        if output is not None and page:  # after each section: what is measured is kept, whatever comes then
            _write(benchmarks.as_json(results, quick), output)
    if output is not None and not page:
        from chapsym.studies.figures import save_figure

        save_figure(figure.draw, results, output)
    quiet()
    found = benchmarks.as_json(results, quick)
    if as_json:
        print_json(found)
    else:
        _print_all(found)


def _write(found: dict[str, Any], output: Path) -> None:
    """The page of what was measured so far; the goals come first."""
    goals = [_goal(name, goal) for name, one in found["sections"].items() for goal in one["reach"]]
    tables = [measured.Table("What was set out to be reached", goals)]
    tables += [measured.Table(one["title"], one["rows"], _remarks(one)) for one in found["sections"].values()]
    measured.write(output, "Speed beside other methods", ABOUT, tables, _shown)


def _floats(own: Any) -> dict[str, Any]:
    """One's own ball, (J, D, 𝒦, γ) in exact numbers, as the section takes it."""
    if own is None:
        return {}
    J, D, K, g = own
    return {"own": (np.array(J, dtype=float), float(D), np.array(K, dtype=float), np.array(g, dtype=float))}


def _sentences(section: dict[str, Any]) -> list[str]:
    """What is said under the table of a section: the figures to reach, the peers that are missing, the notes."""
    said = [
        f"{one['what']}: {one['value']:.3g} (wanted: {_wanted(one)}): {'reached' if one['met'] else 'NOT reached'}"
        for one in section["reach"]
    ]
    return [*said, *_remarks(section)]


def _wanted(goal: dict[str, Any]) -> str:
    return f"{'at least' if goal['at_least'] else 'at most'} {goal['wanted']:.3g}"


def _remarks(section: dict[str, Any]) -> list[str]:
    """The peers that are missing, and the notes."""
    return [*(f"{name}: {reason}" for name, reason in section["missing"].items()), *section["notes"]]


def _goal(section: str, goal: dict[str, Any]) -> dict[str, Any]:
    """A row of the table of what is to be reached."""
    found = {"section": section, "figure": goal["what"], "measured": goal["value"]}
    return {**found, "wanted": _wanted(goal), "reached": goal["met"]}


def _print_all(found: dict[str, Any]) -> None:
    console = console_for(140)
    tables = [measured.Table(one["title"], one["rows"], _sentences(one)) for one in found["sections"].values()]
    measured.show(console, tables, _shown)
    machine = found["machine"]
    versions = ", ".join(f"{name} {version}" for name, version in machine["versions"].items())
    console.print(f"{machine['cpu']}; {machine['cores']} cores; {machine['system']}; C: {machine['compiler']}")
    console.print(f"{machine['python']}; {versions}" + ("; quick" if found["quick"] else ""))


def _shown(value: Any) -> str:
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, list):
        return " to ".join(map(_shown, value))
    return f"{value:.3g}" if isinstance(value, float) else str(value)
