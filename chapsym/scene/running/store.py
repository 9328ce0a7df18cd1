"""A result in Zarr, written unit by unit: created whole, resumable, never mixed with another run.

Next to the arrays, the folder `.chapsym` has the lock and the marks: one file for each chunk, with the number of
written segments and the state for the next.
"""

import errno
import json
import os
import shutil
import sys
import tomllib
import warnings
import zipfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, nullcontext, suppress
from functools import cached_property
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from chapsym import files, jobs

from ..plan.models import State
from ..plan.plan import Plan
from ..read.errors import Data, SceneError
from ..read.task import Columns
from ..result import formats
from ..result.dataset import OF_BALLS, arrays, layout, provenance
from ..result.digests import checksums, digest, is_sound, read_object, said, write_digests
from ..result.formats import DAMAGED, attributes, check_ours, plain

if TYPE_CHECKING:
    from xarray import Dataset
    from zarr import Array
    from zarr.core.buffer import Buffer
    from zarr.storage import MemoryStore

    from chapsym.dynamics.labelled import Arrays

ELSE = "choose another name, or replace it with --fresh"
#: The keys of a mark: the number of finished segments, and the checksums of their chunks; the rest is the state.
DONE, DIGESTS = "segments_done", "digests"
#: The seconds that Zarr may take, after an error, for its concurrent writes.
LONGEST_WRITE = 10.0


class Store:
    """A Zarr group with the Dataset of a plan, and the marks of its units in a folder inside.

    `Store.of` makes or resumes it; `start` gives the state of a chunk, `write` writes a unit, `mark` records it,
    `finish` records completion.  Every error of the disk is a SceneError, and loses nothing that was written.
    """

    def __init__(self, path: Path, plan: Plan) -> None:
        self.path, self.plan = path, plan
        #: The first missing or damaged Zarr chunk of each chunk of balls that is computed again.
        self.damaged: list[str] = []
        #: The checksums of Zarr chunks, by their keys.
        self._digests: dict[str, str] = {}

    @classmethod
    @contextmanager
    def of(cls, path: Path, plan: Plan, fresh: bool = False) -> Iterator[Self]:
        """The store of a plan, new or resumed, locked unless it is complete; `fresh` discards an existing one.

        Raises BadInput if `path` is something else, or if another process is writing it.
        """
        path = Path(os.path.realpath(path))
        _check_place(path)
        store = cls(path, plan)
        if path.exists() and not fresh:
            check_same(path, plan)
            store._check_form()
            if store.complete:
                yield store
                return
        elif path.exists():
            with _locked(path):
                _discard(path)
        is_new = not path.exists() and created(path, lambda place: _fill(place, plan))
        with _locked(path):
            check_same(path, plan)  # another process may have made it, since it was not there
            if not is_new or store._says_complete:
                store._mend()
            yield store

    @property
    def _says_complete(self) -> bool:
        return bool(attributes(self.path).get("complete"))

    @cached_property
    def complete(self) -> bool:
        """Whether, when the store was opened, every unit was there as it was written."""
        if not self._says_complete or not self._described():
            return False
        self._digests = checksums(self.path)
        every = range(len(self.plan.segments))
        if any(self._damage(chunk, every) for chunk in range(len(self.plan.chunks))):
            return False
        return all(self._has(name, values) for name, values in self._coordinates().items())

    def start(self, chunk: int) -> tuple[int, State | None]:
        """The number of finished segments of a chunk, and the state after them; 0 and None if there are none."""
        path, balls = mark_of(self.path, chunk), self.plan.chunks[chunk].stop - self.plan.chunks[chunk].start
        try:
            with path.open("rb") as file, np.load(file, allow_pickle=False) as data:  # NumPy leaves a damaged one open
                state = {name: data[name] for name in data.files}
            done, checksums = int(state.pop(DONE)), state.pop(DIGESTS, None)  # older marks have none
            if not 0 < done <= len(self.plan.segments) or any(array.shape[:1] != (balls,) for array in state.values()):
                raise ValueError
            keys = self._keys(chunk, range(done))
            if checksums is not None:
                self._digests |= zip(keys, checksums.tolist(), strict=True)
        except FileNotFoundError:
            return 0, None
        # Of NumPy and of zip, by what is cut.
        except (OSError, ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile):
            mended = "delete it, and the same command computes its balls anew and keeps the others"
            raise SceneError(f"{path} is damaged; {mended}") from None
        if found := self._damage(chunk, range(done)):
            self.damaged.append(found)
            for key in keys:
                self._digests.pop(key, None)
            return 0, None
        # A process that was killed may have written these after the mark.
        self.write(chunk, done - 1, {name: state[name] for name in OF_BALLS if name in state})
        return done, state

    def _keys(self, chunk: int, segments: range, framed: bool = True) -> list[str]:
        """The keys of the Zarr chunks of some segments of a chunk of balls, or of those without frames."""
        return [
            "/".join([name, "c", *(str({"ball": chunk, "frame": segment}.get(dim, 0)) for dim in one.dims)])
            for segment in (segments if framed else segments[:1])
            for name, one in layout(self.plan).items()
            if ("frame" in one.dims) == framed
        ]

    def _damage(self, chunk: int, segments: range) -> str | None:
        """A missing or damaged Zarr chunk of some segments of a chunk of balls, if any."""
        keys = self._keys(chunk, segments, framed=False) + self._keys(chunk, segments)
        return next((key for key in keys if not is_sound(self.path / key, self._digests.get(key))), None)

    def _coordinates(self) -> dict[str, np.ndarray]:
        """The variables that do not come from the run."""
        whole = _unwritten(self.plan).variables
        return {str(name): one.values for name, one in whole.items() if name not in layout(self.plan)}

    def _has(self, name: str, values: np.ndarray) -> bool:
        """Whether an array of a complete store can be read, and has these values."""
        import zarr

        from ..result.chunks import CheckedStore

        try:
            array: Any = zarr.open_array(CheckedStore(self.path, read_only=True), path=name, mode="r")
            return np.array_equal(np.asarray(array[...], values.dtype), values, equal_nan=values.dtype.kind == "f")
        except ValueError:  # a SceneError, too
            return False

    @cached_property
    def _document(self) -> Data:
        """The metadata of the group and of its arrays when it is made."""
        import zarr

        kept: dict[str, Buffer] = {}
        _fill(zarr.storage.MemoryStore(kept), self.plan)
        return dict(json.loads(kept["zarr.json"].to_bytes()))

    @property
    def _about(self) -> Data:
        """The attributes of the group, except those that may differ from this plan."""
        return {key: value for key, value in self._document["attributes"].items() if key not in ("complete", "scene")}

    @property
    def _arrays(self) -> Data:
        return self._document["consolidated_metadata"]["metadata"]

    def _check_form(self) -> None:
        """Raises SceneError for an array of another form, which another program wrote."""
        listed = said(self.path) or {}
        for name, one in self._arrays.items():
            known = [_read(of) for of in (read_object(self.path / name / "zarr.json"), listed.get(name))]
            if any(known) and _read(one) not in known:
                raise SceneError(f"{self.path / name} is not as chapsym wrote it, but perhaps a copy; {ELSE}")

    def _described(self) -> bool:
        """Whether the metadata of the group and of each array are unchanged."""
        found, listed = read_object(self.path / "zarr.json"), said(self.path)
        return (
            listed is not None
            and all(found.get(key) == self._document[key] for key in ("zarr_format", "node_type"))
            and self._about.items() <= attributes(self.path).items()
            and set(listed) == set(self._arrays)
            and all(read_object(self.path / name / "zarr.json") == one for name, one in listed.items())
            and all(_read(listed[name]) == _read(one) for name, one in self._arrays.items())
        )

    def _describe(self) -> None:
        """Rewrites the metadata of the group and its arrays."""
        for name, one in self._arrays.items():
            (self.path / name).mkdir(exist_ok=True)
            files.write_text(self.path / name / "zarr.json", json.dumps(one, indent=2))
        about = {"attributes": attributes(self.path) | self._about}
        files.write_text(self.path / "zarr.json", json.dumps(self._document | about, indent=2))

    def _mend(self) -> None:
        """Rewrites the variables that do not come from the run; an incomplete store is no longer marked as complete."""
        import zarr

        with _refusals(self.path):
            for left in self.path.rglob("*.partial"):  # half-written chunks of a killed process
                if left.is_file():
                    left.unlink(missing_ok=True)
            if not self._described():
                self._describe()
            group: Any = zarr.open_group(self.path, mode="r+", use_consolidated=False)
            for name, values in self._coordinates().items():
                group[name].with_config({"write_empty_chunks": True})[...] = values
            if not self._says_complete:
                return
            self._digests = checksums(self.path)
            every = range(len(self.plan.segments))
            for chunk, balls in enumerate(self.plan.chunks):
                if found := self._damage(chunk, every):
                    self.damaged.append(found)
                    continue
                state = {name: group[name][balls] for name in OF_BALLS if name in group}
                self._put_mark(chunk, every, state)
            self._say(complete=False)
            self._digests = {}

    def write(self, chunk: int, segment: int, values: Columns) -> None:
        """Writes variables of one unit, which share no Zarr chunk with those of another; raises SceneError."""
        variables = {name: one for name, one in layout(self.plan).items() if name in values}
        where = {"ball": self.plan.chunks[chunk], "frame": self.plan.segments[segment]}
        with _refusals(self.path, variables):
            (self.path / "zarr.json").stat()
            try:
                opened = self._opened
            except (KeyError, ValueError, TypeError):
                (self.path / "zarr.json").stat()
                raise SceneError(f"{self.path} is damaged, or is being deleted; replace it with --fresh") from None
            for name, one in variables.items():
                region = tuple(where.get(dim, slice(None)) for dim in one.dims)
                opened[name][region] = np.asarray(values[name], one.dtype)
            (self.path / "zarr.json").stat()  # Zarr makes these folders again for a store that was deleted meanwhile

    @cached_property
    def _opened(self) -> "dict[str, Array]":
        """The arrays of the variables, open for all units."""
        import zarr

        group: Any = zarr.open_group(self.path, mode="r+", use_consolidated=False)
        return {name: group[name].with_config({"write_empty_chunks": True}) for name in layout(self.plan)}

    def mark(self, chunk: int, segment: int, state: State) -> None:
        """Writes the mark of a written unit, after the outcome of its balls.

        That changes from segment to segment, so only the process that holds the lock writes it: a worker may be late.
        """
        self.write(chunk, segment, {name: state[name] for name in OF_BALLS if name in state})
        with _refusals(self.path, layout(self.plan)):
            self._put_mark(chunk, range(segment + 1), state)

    def _put_mark(self, chunk: int, done: range, state: State) -> None:
        keys = self._keys(chunk, done)
        self._digests |= {key: digest(self.path / key) for key in keys if key not in self._digests}
        checksums = np.array([self._digests[key] for key in keys])
        data: dict[str, Any] = {DONE: np.array(len(done)), DIGESTS: checksums, **state}
        files.write_whole(mark_of(self.path, chunk), lambda stream: np.savez(stream, **data))

    def finish(self) -> None:
        """Records completion, and lists the checksums; the marks are removed."""
        with _refusals(self.path):
            write_digests(self.path)
            self._say(complete=True)
            shutil.rmtree(folder_of(self.path), ignore_errors=True)

    def _say(self, complete: bool) -> None:
        document = json.loads((self.path / "zarr.json").read_text(encoding="utf-8"))
        document["attributes"]["complete"] = complete
        files.write_text(self.path / "zarr.json", json.dumps(document, indent=2))


def _read(description: Any) -> Data | None:
    """The description of an array as read by Zarr; None if it is invalid."""
    from zarr.core.metadata import ArrayV3Metadata

    try:
        return dict(ArrayV3Metadata.from_dict(description).to_dict())
    except DAMAGED:
        return None


def folder_of(store: Path) -> Path:
    """The folder of the marks and the lock, inside the store."""
    return store / ".chapsym"


def mark_of(store: Path, chunk: int) -> Path:
    """The mark of a chunk."""
    return folder_of(store) / f"chunk-{chunk:06d}.npz"


# The plan of a store.


def check_same(path: Path, plan: Plan) -> None:
    """Raises SceneError, with the difference, unless the result is of this plan and these versions."""
    found, wanted = attributes(path), provenance(plan)
    if (key := _first_difference(_data(found.get("scene")), _data(wanted["scene"]))) is not None:
        raise SceneError(f"{path} holds another scene ({key} differs); {ELSE}")
    if (clause := difference(found, wanted)) is not None:
        raise SceneError(f"{path} {clause}; {ELSE}")


def save(data: "Dataset | Arrays", path: Path, plan: Plan, fresh: bool) -> None:
    """Writes a result; if another process has put one of another scene there meanwhile, under a free name.

    Raises SceneError with that name.
    """
    with nullcontext() if path == formats.STDOUT else files.alone(path.parent):
        try:
            if path.is_file() and not fresh:
                check_same(path, plan)
        except SceneError as error:
            free = next(one for n in count(2) if not (one := path.with_stem(f"{path.stem}-{n}")).exists())
            formats.save(data, free)
            raise SceneError(f"{error}; it was written while this one ran, whose result is in {free}") from None
        formats.save(data, path)


def difference(found: Data, wanted: Data) -> str | None:
    """The difference of two runs besides the text of the scene, as a verb and its object; None if there is none."""
    for name, clause in (
        ("chapsym_version", "is of another version of chapsym"),
        ("plan", "is of another plan"),
        ("kernels", "is of other kernels"),
        ("inputs_sha256", "is of other balls or starts"),
    ):
        if found.get(name) != wanted.get(name):
            return clause
    return None


def _first_difference(one: object, other: object, key: str = "") -> str | None:
    """The dotted key of the first difference of two nested tables; None if there is none."""
    if not (isinstance(one, dict) and isinstance(other, dict)):
        return None if one == other else key or "the text"
    for name in sorted({*one, *other}):
        inside = f"{key}.{name}" if key else str(name)
        if inside == "run.output":  # the destination is no part of the result
            continue
        if (name in one) != (name in other):
            return inside
        if found := _first_difference(one[name], other[name], inside):
            return found
    return None


def _data(text: Any) -> object:
    """The data of a scene without its comments; the text itself if it is neither TOML nor JSON."""
    for read in (tomllib.loads, json.loads):
        with suppress(ValueError, TypeError, AttributeError, RecursionError):
            return read(text)
    return text


# A new store is made next to its path with all its metadata, then renamed, so that it is whole or absent.


def _check_place(path: Path) -> None:
    """Raises SceneError, before anything is computed, if `path` cannot be a store."""
    if not path.parent.is_dir():
        raise SceneError(f"{path}: the folder {path.parent} does not exist")
    if path.exists():
        check_ours(path)
    elif os.path.lexists(path) or not os.access(path.parent, os.W_OK):
        raise SceneError(f"{path} cannot be written: choose a name in a folder that is writable")


def created(path: Path, fill: Callable[[Path], object]) -> bool:
    """Puts what `fill` writes at `path`, unless another process has, and returns whether it did.

    Raises SceneError if the disk refuses.
    """
    for left in path.parent.glob(f".{path.name}.new-*"):  # of killed creations
        pid = left.name.rpartition("-")[2]
        if pid.isdigit() and not _alive(int(pid)):
            shutil.rmtree(left, ignore_errors=True)
    beside = _beside(path)
    try:
        with _refusals(path, creating=True):
            beside.mkdir()
            fill(beside / path.name)
            try:
                os.rename(beside / path.name, path)
            except OSError:
                if not path.exists():
                    raise
                return False
            return True
    finally:
        _wait_for_zarr()  # otherwise its pending writes would make the folder again
        shutil.rmtree(beside, ignore_errors=True)


def _discard(path: Path) -> None:
    """Removes a store, after renaming, so that no part of it stays under its name."""
    beside = _beside(path)
    with _refusals(path):
        beside.mkdir()
        os.rename(path, beside / path.name)
        shutil.rmtree(beside, ignore_errors=True)


def _beside(path: Path) -> Path:
    """A folder of this process, on the same disk."""
    return path.with_name(f".{path.name}.new-{os.getpid()}")


def _alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):  # of another user
        return True
    return True


def _fill(place: "Path | MemoryStore", plan: Plan) -> None:
    """The group with all metadata and coordinates, and without values."""
    write(_unwritten(plan).drop_vars(layout(plan)), place)
    _add_arrays(place, plan)
    consolidate(place)


def _unwritten(plan: Plan) -> "Dataset":
    """The result without a value that is computed."""
    none = {name: one.values for name, one in layout(plan).items()}
    return arrays(plan, none, none).assign_attrs({"complete": False}).dataset()


def write(data: "Dataset", path: "Path | MemoryStore") -> None:
    """Writes a new group, its chunks with their checksums."""
    from ..result.chunks import COMPRESSORS

    encoding = {name: {"compressors": COMPRESSORS} for name in data.variables}
    data.to_zarr(path, zarr_format=3, consolidated=False, encoding=encoding, write_empty_chunks=True)


def _add_arrays(path: "Path | MemoryStore", plan: Plan) -> None:
    """The variables, without values, each unit a chunk; Zarr's chunks are regular, and only the last is shorter."""
    import zarr

    from ..result.chunks import COMPRESSORS

    units = {"ball": plan.chunks[0].stop, "frame": plan.segments[0].stop}
    group = zarr.open_group(path, mode="r+", use_consolidated=False)
    for name, one in layout(plan).items():
        shape = one.values.shape
        chunks = tuple(units.get(dim, length) for dim, length in zip(one.dims, shape, strict=True))
        group.create_array(
            name, shape=shape, chunks=chunks, dtype=one.dtype, fill_value=one.values.flat[0], dimension_names=one.dims,
            attributes=plain(one.attrs), compressors=COMPRESSORS,
        )  # fmt: skip


def consolidate(path: "Path | MemoryStore") -> None:
    """One file of all metadata."""
    import zarr

    with warnings.catch_warnings():
        # Zarr says that other readers may not know it; they read those of each array.
        warnings.filterwarnings("ignore", message="Consolidated metadata")
        zarr.consolidate_metadata(path, zarr_format=3)


@contextmanager
def _locked(path: Path) -> Iterator[None]:
    """Raises SceneError if another process writes the store, or if it would be written outside of its folder."""
    if link := next((one for one in path.rglob("*") if one.is_symlink()), None):
        raise SceneError(f"{link} is a link, and its target may not be chapsym's to write: replace the link by files")
    with _refusals(path):
        folder_of(path).mkdir(exist_ok=True)
    with jobs.held(folder_of(path) / "lock", str(path)):
        yield


def _wait_for_zarr() -> None:
    """Returns when Zarr has ended its writes: the first that fails is raised while others are on their way."""
    if "zarr" not in sys.modules:
        return
    import asyncio

    from zarr.core.sync import sync

    async def ended() -> None:
        own = "wait for zarr"
        task = asyncio.current_task()
        assert task is not None
        task.set_name(own)  # two that wait do not wait for each other
        if others := [one for one in asyncio.all_tasks() if one.get_name() != own]:
            await asyncio.wait(others)

    with suppress(TimeoutError):
        sync(ended(), timeout=LONGEST_WRITE)


@contextmanager
def _refusals(path: Path, names: Iterable[str] = (), creating: bool = False) -> Iterator[None]:
    """Turns what the disk refuses inside into a SceneError of one sentence.

    names: of the arrays that are being written: where the store was deleted meanwhile, Zarr makes their folders anew,
    and they are removed again.  creating: it is not expected to be there yet.
    """
    try:
        yield
    except (OSError, files.CannotWrite) as error:
        _wait_for_zarr()
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        causes = (error, error.__cause__, error.__context__)  # of a CannotWrite the error inside says it
        full = any(isinstance(e, OSError) and e.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG) for e in causes)
        if not creating and not (path / "zarr.json").exists():
            for name in names:
                shutil.rmtree(path / name, ignore_errors=True)
            with suppress(OSError):  # not empty, or not there: not ours
                path.rmdir()
            clause = f"{path} was deleted or moved while it was written; the same command begins anew"
        elif full:
            clause = f"{path}: {reason}; what was written stays: make room, and the same command goes on from there"
        else:
            clause = f"{path} cannot be written: {reason}; what was written stays"
        raise SceneError(clause) from None
