"""Measures, draws and prints the sections of `chapsym bench`, the package `benchmarks`, and of `chapsym trade`.

What a section finds has a `title`, the rows of a `table()`, `sentences()` under it, and `as_json()`.
"""

from collections.abc import Iterable, Sequence
from pathlib import Path
from types import ModuleType

import benchmarks
from chapsym.cli import measured
from chapsym.cli.output import SELDOM, check_known, console_for, fail, print_json, telling
from chapsym.files import Data
from chapsym.numbers import in_words
from chapsym.studies.checkout import machine, save_figures

from .harness import NotComparable
from .results import Result

#: The file types of figures.
FIGURES = (".svg", ".png", ".pdf")


def measure(
    sections: Sequence[str], quick: bool, output: Path | None, as_json: bool, study: ModuleType = benchmarks,
    hint: str = "", **own: object,
) -> Data:  # fmt: skip
    """Measures the sections of a study, or the default; fails with a sentence as every command does.

    hint: what is said of a section that is not there.  own: one's own ball, of `benchmarks`.
    """
    wanted = list(dict.fromkeys(sections or study.DEFAULT))
    check_known("section", wanted, study.SECTIONS, hint)
    page = measured.is_page(output)
    if output is not None and not page:
        _check_figure(output, wanted, study.DRAWN)
    results: Data = {}
    for name in wanted:
        try:
            with telling(SELDOM) as tell:
                results[name] = study.run(name, quick, tell, **own)
        except NotComparable as error:
            fail(f"{study.NAME} {name}: {error}", 1)
        if output is not None and page:  # after each section: what is measured is kept, whatever comes then
            measured.write(output, study.TITLE, study.ABOUT, [*_goals(results), *_tables(results)], _shown)
    if output is not None and not page:
        drawn = {name: results[name] for name in study.DRAWN if name in results}
        save_figures(study.__name__, {output.name: "figure:draw"}, drawn, output.parent)
    found = plain(results, quick)
    if as_json:
        print_json(found)
        return results
    console, here = console_for(140), found["machine"]
    measured.show(console, _tables(results), _shown)
    versions = ", ".join(f"{name} {version}" for name, version in here["versions"].items())
    console.print(f"{here['cpu']}; {here['cores']} cores; {here['system']}; C: {here['compiler']}")
    console.print(f"{here['python']}; {versions}" + ("; quick" if quick else ""))
    return results


def _check_figure(output: Path, sections: Iterable[str], drawn: Iterable[str]) -> None:
    """Fails, before anything is measured, where a figure of these sections cannot be drawn or written."""
    from chapsym import extras, files

    extras.need("figures")
    if output.suffix not in FIGURES:
        fail(f"{str(output)!r}: a figure must end in {', '.join(FIGURES)}", 2)
    if not set(sections) & set(drawn):
        *some, last = drawn
        fail(f"only {', '.join(some)} and {last} have a figure", 2)
    files.check_destination(output)


def plain(results: Data, quick: bool) -> Data:
    """The machine and all that was measured, as plain data."""
    sections = {name: one.as_json() for name, one in results.items()}
    return {"machine": machine(), "quick": quick, "sections": sections}


def _tables(results: Data) -> list[measured.Table]:
    return [measured.Table(one.title, one.table(), [*map(in_words, one.sentences())]) for one in results.values()]


def _goals(results: Data) -> list[measured.Table]:
    """The table of what was to be reached, if anything was."""
    rows = [
        {"section": name, "figure": one.what, "measured": one.value, "wanted": one.bound, "reached": one.met}
        for name, found in results.items()
        if isinstance(found, Result)
        for one in found.reach
    ]
    return [measured.Table("What was set out to be reached", rows)] if rows else []


def _shown(value: object) -> str:
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, list):
        return " to ".join(map(_shown, value))
    return f"{value:.3g}" if isinstance(value, float) else in_words(str(value))
