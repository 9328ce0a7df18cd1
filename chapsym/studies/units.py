"""Independent units of a study: on all cores or on a Dask cluster, each kept when it is done, so that a study goes on.

A unit is a function of a module and its arguments, as plain data; its result is plain data, too.  The results are lines
of a JSON Lines file, so that a killed study loses only the units that were in flight.
"""

import hashlib
import json
import multiprocessing
import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache, partial
from importlib import import_module
from pathlib import Path
from typing import Any

import chapsym
from chapsym import files, workers
from chapsym.dynamics import BadInput
from chapsym.dynamics.levels.double import cores

#: Called with the units that are done and how many there are.
Report = Callable[[int, int], None]


@dataclass(frozen=True)
class Unit:
    """One call: "package.module:function" and its keyword arguments, which JSON can hold as they are."""

    function: str
    arguments: dict[str, Any] = field(default_factory=dict)

    @property
    def key(self) -> str:
        """What its result depends on: the call, the version of chapsym, and the sources beside the function."""
        made_by = [chapsym.__version__, _sources(self.function.partition(":")[0]), self.function]
        return json.dumps([*made_by, self.arguments], sort_keys=True, ensure_ascii=False)


@cache
def _sources(module: str) -> str:
    """A hash of the folder that a module is in; empty for one that is in no file."""
    file = getattr(import_module(module), "__file__", None)
    if file is None:
        return ""
    digest = hashlib.sha256()
    for path in sorted(Path(file).parent.glob("*.py")):
        digest.update(path.name.encode() + b"\n" + path.read_bytes())
    return digest.hexdigest()[:16]


def compute(function: str, arguments: dict[str, Any]) -> Any:
    """The result of a unit."""
    module, name = function.split(":")
    return getattr(import_module(module), name)(**arguments)


def run_units(
    units: Sequence[Unit],
    path: Path | None = None,
    scheduler: str | None = None,
    report: Report = lambda done, of: None,
) -> list[Any]:
    """The results of all units, in their order; those that the file at `path` has are not computed again.

    path: a JSON Lines file that is made or gone on with; None keeps nothing.  The address of a Dask scheduler takes
    them to its workers, else all cores of this machine work.  report: called with the number of those done, and of all.
    Raises BadInput if the file is not one of results, if a unit fails, and if the cluster is lost; what was done by
    then is kept.
    """
    done = _kept(path)
    missing = {unit.key: unit for unit in units if unit.key not in done}
    finished = sum(unit.key in done for unit in units)
    report(finished, len(units))
    arrivals = _local(list(missing.values())) if scheduler is None else _remote(list(missing.values()), scheduler)
    with _lines(path) as keep:
        for unit, result in arrivals:
            done[unit.key] = result
            keep({"key": unit.key, "result": result})
            finished += 1
            report(finished, len(units))
    return [done[unit.key] for unit in units]


def _kept(path: Path | None) -> dict[str, Any]:
    """The results that a file has.  A last line without its end was cut off when its writer was killed."""
    if path is None or not path.exists():
        return {}
    text = _text(path)
    whole = text[: text.rfind("\n") + 1]
    found = {}
    for number, line in enumerate(whole.splitlines(), start=1):
        try:
            record = json.loads(line)
            found[record["key"]] = record["result"]
        except (ValueError, TypeError, KeyError):
            raise BadInput(
                f"line {number} of {path} is no result of a study; name another folder, or delete the file"
            ) from None
    if whole != text:
        _written(lambda: files.write_whole(path, lambda stream: stream.write(whole.encode())))
    return found


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise BadInput(f"{path} cannot be read as results of a study: {error}") from None


def _written(write: Callable[[], Any]) -> Any:
    try:
        return write()
    except files.CannotWrite as error:
        raise BadInput(str(error)) from None
    except OSError as error:
        raise BadInput(f"{error.filename or 'the results'} cannot be written: {error.strerror or error}") from None


@contextmanager
def _lines(path: Path | None) -> Iterator[Callable[[dict[str, Any]], None]]:
    """Yields what appends a record to a file, flushed; to nothing without one."""
    if path is None:
        yield lambda record: None
        return
    stream = _written(lambda: path.open("a", encoding="utf-8"))

    def keep(record: dict[str, Any]) -> None:
        line = json.dumps(record, ensure_ascii=False, allow_nan=False) + "\n"
        _written(lambda: (stream.write(line), stream.flush()))

    with stream:
        yield keep


def _local(units: list[Unit]) -> Iterator[tuple[Unit, Any]]:
    """Results as they come, from one process for each core; in this one where there is one unit or one core."""
    abreast = min(cores(), len(units))
    if abreast <= 1:
        for unit in units:
            yield unit, _checked(unit, partial(compute, unit.function, unit.arguments))
        return
    # A child is not forked: numba's threads and Arb's precision are of a process.
    context = multiprocessing.get_context("spawn")
    pool = ProcessPoolExecutor(abreast, context, initializer=workers.begin)
    try:
        flying = {pool.submit(compute, unit.function, unit.arguments): unit for unit in units}
        for future in as_completed(flying):
            yield flying[future], _checked(flying[future], future.result)
    finally:
        children = list((pool._processes or {}).values())  # the pool forgets them at its shutdown
        pool.shutdown(wait=False, cancel_futures=True)
        for process in children:
            if process.is_alive():
                process.terminate()


def _checked(unit: Unit, result: Callable[[], Any]) -> Any:
    """The result, or a sentence about the unit that has none."""
    try:
        return result()
    except BrokenProcessPool:
        raise BadInput(f"a process that computed {_name(unit)} was killed; the same command goes on") from None
    except Exception as error:
        raise BadInput(f"{_name(unit)}: {error}") from error


def _name(unit: Unit) -> str:
    told = ", ".join(f"{name} = {value}" for name, value in unit.arguments.items())
    return f"{unit.function.rpartition(':')[2]}({told})"


def _remote(units: list[Unit], address: str) -> Iterator[tuple[Unit, Any]]:
    """Results as they come, from the workers of a Dask scheduler."""
    from distributed import as_completed as arriving

    from chapsym.scene.running.cluster import connected

    if not units:
        return
    with connected(address) as client:
        if not client.nthreads():
            raise BadInput(f"the Dask scheduler at {address} has no workers")
        here = chapsym.__version__
        for worker, there in client.run(_version).items():
            if there != here:
                raise BadInput(f"the worker {worker} has chapsym {there}, and {here} is here: give all the same")
        flying = {client.submit(compute, unit.function, unit.arguments, pure=False): unit for unit in units}
        try:
            for future in arriving(flying):
                yield flying[future], _checked(flying[future], future.result)
        finally:
            client.cancel(list(flying), force=True)


def _version() -> str:
    return str(chapsym.__version__)


def folder(path: Path) -> Path:
    """A folder for the results, made if it is not there; raises BadInput if it cannot be written to."""
    if path.exists() and not path.is_dir():
        raise BadInput(f"{path} is a file; name a folder for the results of the study")
    _written(lambda: path.mkdir(parents=True, exist_ok=True))
    if not os.access(path, os.W_OK):
        raise BadInput(f"{path} cannot be written to; name another folder")
    return path
