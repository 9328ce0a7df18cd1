"""chapsym lab: what methods make of mechanical systems, as a table, JSON or a page."""

import json
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, redirect_stdout
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer

from .app import app
from .options import Json, argument, takes
from .output import Data, fail, note, print_json, progress_bar, put

if TYPE_CHECKING:
    from chapsym.mechanics import Cell, System

#: Takes a call and its arguments, and gives a function that returns its result.
Later = Callable[..., Callable[[], Any]]


class Begun(NamedTuple):
    """A system, its key, its sentences, its cells, and its certificates, each by the call that gives it."""

    system: "System"
    key: str
    said: Callable[[], str]
    cells: list[Callable[[], "Cell | Data"]]
    certified: Callable[[], Data] | None


@app.command()
def lab(
    files: Annotated[list[Path], argument("FILE...", "Files of systems, SYSTEM = System(...), or folders of them.")],
    method: Annotated[list[str] | None, takes("NAME", "A method; may be given more than once; all by default.")] = None,
    steps: Annotated[int, takes("N", "Steps of each run.", min=1, max=100_000_000)] = 100_000,
    length: Annotated[float | None, takes("TIME", "The time of a step; by default each system's own.", min=0)] = None,
    flags: Annotated[bool, typer.Option(help="Also decide exactly constraints, integrals, methods.")] = True,
    halve: Annotated[bool, typer.Option(help="Also run with half the step: is a drift of the method?")] = False,
    jobs: Annotated[int, takes("N", "Processes.", min=1, max=1000)] = 1,
    output: Annotated[
        Path | None, takes("FILE", "A .json, which is gone on with if it is there; or an .html.", "--output", "-o")
    ] = None,
    certificates: Annotated[Path | None, takes("FOLDER", "Write each exact verdict as a certificate.")] = None,
    as_json: Json = False,
) -> None:
    """Measure methods on mechanical systems: energy, constraints, order, cost.

    A file of a system is Python, and is run. Example: chapsym lab docs/examples/systems -o systems.html
    """
    import chapsym
    from chapsym import sources
    from chapsym.files import CannotWrite, alone, check_destination, made, write_text
    from chapsym.mechanics import METHODS, BadSystem, loaded
    from chapsym.mechanics.claims import name_of
    from chapsym.show.lab import COLUMNS

    if output is not None and output.suffix not in (".json", ".html"):
        fail(f"{output} must end in .json or .html", 2)
    if output is not None:
        check_destination(output)
    methods = method or list(METHODS)
    if strange := [name for name in methods if name not in METHODS]:
        fail(f"{strange[0]!r} is no method; those are {', '.join(METHODS)}", 2)
    done, keys = _there(output), set[str]()
    constraints: dict[str, str] = {}
    certified: Data = {}
    wrong: list[str] = []
    systems = list[tuple[Path, "System"]]()
    for path in _files(files):
        try:
            with redirect_stdout(sys.stderr):  # what the file prints
                system = loaded(path)
            if system.name in [one.name for _, one in systems]:
                raise BadSystem(f"two systems are called {system.name}: give each a name of its own")
            if certificates and name_of(system) in [name_of(one) for _, one in systems]:
                raise BadSystem(f"{system.name} and another system would have certificates of one name: rename one")
            system.beginning, system.length(length)
            systems.append((path, system))
        except BadSystem as error:
            wrong.append(str(error))
    if certificates and systems:
        made(certificates)

    code = sources.whole(Path(chapsym.__path__[0]))  # a cell that other code measured is measured again

    def started(path: Path, system: "System", later: Later) -> Begun:
        key, cells = system.digest(length, halve, code), list[Callable[[], "Cell | Data"]]()
        of, own = path if jobs > 1 else system, methods
        if not method and not system.discrete:
            own = [one for one in methods if one != "own"]
        for name in own:
            same = (c for c in done if (c["key"], c["method"], c["steps"]) == (key, name, steps))
            there = next((c for c in same if c["verdicts"] or not flags), None)
            more = name, steps, length, halve, flags
            cells.append(partial(dict, there) if there else later(_cell, of, *more))
        written = later(_certify, of, own, certificates) if certificates else None
        return Begun(system, key, later(_said, of, flags), cells, written)

    with _crew(jobs) as later:
        begun = [started(path, system, later) for path, system in systems]
        for system, key, said, cells, written in begun:
            constraints[system.name] = said()
            keys.add(key)
            if not as_json:
                put(f"{system.name}: {constraints[system.name]}")
                print("".join(f"  {name:>{width}}" for name, width in COLUMNS.items()))
            for measured in cells:
                try:
                    cell = measured()
                except BadSystem as error:
                    wrong.append(str(error))
                    continue
                if not isinstance(cell, dict):
                    cell = {"key": key, **cell.data()}
                    done = _joined(done, cell)
                    if output is not None and output.suffix == ".json":
                        with alone(output.parent):  # of two commands both keep what they have
                            write_text(output, json.dumps({"cells": _joined(_there(output), cell)}, allow_nan=False))
                if not as_json:
                    put(_row(cell))
            if written:
                try:
                    certified[system.name] = found = written()
                except (BadSystem, CannotWrite) as error:
                    wrong.append(str(error))
                    continue
                if not as_json:
                    put(_of_certificates(found, certificates))
    shown = [cell for cell in done if cell["key"] in keys and cell["method"] in methods and cell["steps"] == steps]
    if output is not None and output.suffix == ".html" and shown:
        from chapsym.show.lab import page

        write_text(output, page(shown, {name: m.title for name, m in METHODS.items()}, constraints))
    if as_json and shown:
        print_json({"constraints": constraints, "cells": shown} | ({"certificates": certified} if certified else {}))
    elif output is not None and shown:
        note(f"wrote {output}")
    for sentence in wrong[:-1]:
        note(sentence)
    if wrong:
        fail(wrong[-1], 2)


def _joined(cells: list[Data], new: Data) -> list[Data]:
    """The cells with a new one, which replaces its older."""
    return [c for c in cells if any(c[part] != new[part] for part in ("key", "method", "steps"))] + [new]


def _row(cell: Data) -> str:
    from chapsym.show.lab import COLUMNS, decided, figures

    if cell["failed"]:
        return "; ".join([f"  {cell['method']:>9}  {cell['failed']}", *decided(cell)])
    *shown, rest = figures(cell)
    row = "".join(f"  {one:>{width}}" for one, width in zip((cell["method"], *shown), COLUMNS.values(), strict=True))
    return row + (f"  {rest}" if rest else "")


@contextmanager
def _crew(jobs: int) -> Iterator[Later]:
    """A crew that makes each call when its result is needed, or begins it in one of some processes."""
    if jobs == 1:
        yield partial
        return
    from concurrent.futures.process import BrokenProcessPool

    from chapsym import workers

    try:
        with workers.Processes(jobs) as pool:
            yield lambda call, *arguments: pool.submit(call, *arguments).result
    except BrokenProcessPool:
        fail("a process that measured a system ended, perhaps for lack of memory: try --jobs 1", 1)


def _cell(of: "Path | System", method: str, steps: int, *how: Any) -> "Cell":
    """A cell, of a system or of the file of one, which another process reads: only one process shows its steps."""
    from chapsym.mechanics import loaded, measured

    if isinstance(of, Path):
        return measured(loaded(of), method, steps, *how)
    with progress_bar(f"steps by {method}", steps) as shown:
        return measured(of, method, steps, *(*how, shown))


def _said(given: "Path | System", decide: bool) -> str:
    """The sentences on a system, or on that of a file: whether its motion keeps its energy.

    With `decide` also what is exact, or why it is not.
    """
    from chapsym.mechanics import BadSystem, conserved, flag, loaded, volume

    system = loaded(given) if isinstance(given, Path) else given

    def of(decide: Callable[[], object], what: str, form: str) -> str:
        try:
            return form.format(decide())
        except BadSystem as error:
            return f"{what} is not decided ({str(error).removeprefix(f'{system.name}: ')})"

    energy = f"the exact motion {'keeps' if system.keeps_energy else 'need not keep'} its energy"
    if not decide:
        return energy
    found = [of(lambda: flag(system), "integrability", "{}"), energy]
    found.append(of(lambda: volume(system), "whether it keeps a volume", "it {}"))
    for name, quantity in system.integrals.items():
        kept = partial(conserved, system, quantity)
        found.append(of(kept, name, f"{name} is {{}}").partition(": its rate")[0])
    return "; ".join(found)


def _certify(of: "Path | System", methods: list[str], folder: Path) -> Data:
    """Writes the certificates of a system, or of the file of one: their claims, and why other verdicts have none."""
    from chapsym.mechanics import certified, loaded
    from chapsym.prove.certificates import write

    claims, none = list[str](), dict[str, list[str]]()
    for one in certified(loaded(of) if isinstance(of, Path) else of, methods):
        if one.certificate is None:
            none.setdefault(one.why, []).append(one.verdict)
            continue
        write(dict(one.certificate), folder)
        claims.append(one.certificate["claim"])
    return {"claims": claims, "none": none}


def _of_certificates(found: Data, folder: Path | None) -> str:
    """The line of a table on them."""
    written, without = len(found["claims"]), sum(map(len, found["none"].values()))
    line = f"  certificates in {folder}: {written}, of {written + without} exact verdicts"
    return "; ".join([line, *(f"none for {', '.join(of)}: {why}" for why, of in found["none"].items())])


def _there(output: Path | None) -> list[Data]:
    if output is None or output.suffix != ".json" or not output.exists():
        return []
    from pydantic import TypeAdapter

    from chapsym.files import CannotRead, text_of
    from chapsym.mechanics import Cell

    kind = TypeAdapter(dict[str, Cell])
    try:
        cells = json.loads(text_of(output))["cells"]
        found = [kind.validate_python({cell.pop("key"): asdict(Cell.of(cell))}) for cell in cells]
        return [{"key": key, **cell.data()} for one in found for key, cell in one.items()]
    except (CannotRead, ValueError, KeyError, TypeError, AttributeError, OverflowError, RecursionError):
        fail(f"{output} is not what chapsym lab has written: name another file", 2)


def _files(places: list[Path]) -> list[Path]:
    found = []
    for place in places:
        found += sorted(p for p in place.glob("*.py") if not p.name.startswith("_")) if place.is_dir() else [place]
    if not found:
        fail(f"{places[0]} has no file of a system", 2)
    return found
