"""Independent units of a study: on all cores or on a Dask cluster, each kept when it is done, so that a study goes on.

A unit is a function of a module and its arguments, as plain data; its result is plain data, too.  The results are lines
of a JSON Lines file, so that a killed study loses only the units that were in flight.
"""

import hashlib
import json
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any, TextIO

import chapsym
from chapsym import jobs, sources
from chapsym.dynamics import BadInput
from chapsym.dynamics.levels.frames import cores
from chapsym.files import Data, check_destination

#: The beginning of each line of the file.
BEGINNING = '{"key": '
#: Called with the units that are done and how many there are.
Report = Callable[[int, int], None]
#: The results of units, in their order: `run_units`.
Run = Callable[["Sequence[Unit]"], list[Any]]


@dataclass(frozen=True)
class Unit:
    """One call: "package.module:function" and its keyword arguments, which JSON can hold as they are."""

    function: str
    arguments: Data = field(default_factory=dict)

    @property
    def key(self) -> str:
        """A key of all that its result depends on: the call, the version of chapsym, and the sources of both."""
        made_by = [chapsym.__version__, _sources(self.function.partition(":")[0]), self.function]
        return json.dumps([*made_by, self.arguments], sort_keys=True, ensure_ascii=False)


_sources = cache(sources.fingerprint)


def compute(function: str, arguments: Data, key: str) -> Any:
    """The result of a unit, of which `key` identifies the sources: in another process these must be the same."""
    if Unit(function, arguments).key != key:
        raise BadInput(f"a worker has another chapsym ({chapsym.__version__}): give all the same")
    module, name = function.split(":")
    return getattr(import_module(module), name)(**arguments)


def run_units(
    units: Sequence[Unit], path: Path | None = None, scheduler: str | None = None, report: Report = lambda *_: None
) -> list[Any]:
    """The results of all units, in their order; those that the file at `path` has are not computed again.

    path: a JSON Lines file that is made or gone on with; None keeps nothing.  The address of a Dask scheduler takes
    them to its workers, else all cores of this machine work.  report: called with the number of those done, and of all.
    Raises BadInput if the file is not one of results, or if another process writes it; if a unit fails, and if the
    cluster is lost; what was done by then is kept.
    """
    with _kept(path) as (done, keep):
        keys = [unit.key for unit in units]
        missing = {key: unit for key, unit in zip(keys, units, strict=True) if key not in done}

        def tell() -> None:
            report(sum(key in done for key in keys), len(units))

        def chain(key: str, unit: Unit) -> jobs.Chain:
            try:
                done[key] = yield jobs.Call(compute, (unit.function, unit.arguments, key))
            except (BrokenProcessPool, jobs.Lost):
                raise BadInput(f"a process that computed {_name(unit)} was killed; the same command goes on") from None
            except Exception as error:
                raise BadInput(f"{_name(unit)}: {error}") from error
            keep(key, done[key])
            tell()

        tell()
        if missing:
            abreast = min(cores(), len(missing))
            with jobs.processes(abreast) if scheduler is None else jobs.workers(scheduler) as crew:
                jobs.run((chain(key, unit) for key, unit in missing.items()), crew)
        return [done[key] for key in keys]


@contextmanager
def _kept(path: Path | None) -> Iterator[tuple[Data, Callable[[str, object], None]]]:
    """The results that a file has, and what appends one to it, flushed; it is locked meanwhile."""
    if path is None:
        yield {}, lambda key, result: None
        return
    check_destination(path)
    with _written(lambda: path.open("a+", encoding="utf-8", newline="")) as stream:
        jobs.claim(stream, str(path))
        done = _read(stream, path)

        def keep(key: str, result: object) -> None:
            line = json.dumps(_record(key, result), ensure_ascii=False, allow_nan=False) + "\n"
            _written(lambda: (stream.write(line), stream.flush()))

        yield done, keep


def _damaged(n: int, path: Path) -> BadInput:
    return BadInput(f"line {n} of {path} is no result of a study, or is damaged; delete it, or name another folder")


def _read(stream: TextIO, path: Path) -> Data:
    """The results in an open file.  A last line without its end was cut off when its writer was killed, and goes."""
    try:
        stream.seek(0)
        text = stream.read()
    except (OSError, UnicodeDecodeError) as error:
        raise BadInput(f"{path} cannot be read as results of a study: {error}") from None
    whole = text[: text.rfind("\n") + 1]
    rest, found = text[len(whole) :], {}
    for number, line in enumerate(whole.splitlines(), start=1):
        try:
            record = json.loads(line)
            if record != _record(record["key"], record["result"]):
                raise ValueError("damaged")
            found[record["key"]] = record["result"]
        except (ValueError, TypeError, KeyError, RecursionError):
            raise _damaged(number, path) from None
    if rest:
        if rest[: len(BEGINNING)] != BEGINNING[: len(rest)]:
            raise _damaged(whole.count("\n") + 1, path)
        _written(lambda: stream.truncate(len(whole.encode())))
    return found


def _record(key: str, result: object) -> Data:
    """A line of the file, with a checksum."""
    return {"key": key, "result": result, "sha256": hashlib.sha256(json.dumps([key, result]).encode()).hexdigest()}


def _written(write: Callable[[], Any]) -> Any:
    try:
        return write()
    except OSError as error:
        raise BadInput(f"{error.filename or 'the results'} cannot be written: {error.strerror or error}") from None


def _name(unit: Unit) -> str:
    arguments_shown = ", ".join(f"{name} = {value}" for name, value in unit.arguments.items())
    return f"{unit.function.rpartition(':')[2]}({arguments_shown})"
