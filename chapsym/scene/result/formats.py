"""Results in files: NetCDF, and for small ones CSV, Parquet and NumPy, each written whole; and their readers.

CSV and Parquet are one table, a row for each ball and frame; `structure` has the data that are in no row.
"""

import codecs
import csv
import json
import math
import mmap
import os
import re
import sys
import warnings
import zipfile
import zlib
from collections.abc import Callable, Iterator, Mapping
from itertools import takewhile
from pathlib import Path
from struct import unpack_from
from tokenize import TokenError
from typing import IO, TYPE_CHECKING, Any

import numpy as np

from chapsym import extras, files
from chapsym.dynamics.labelled import NOTES, Arrays, batches, in_rows, is_ours, plain, structure, with_clock
from chapsym.dynamics.outputs import OUTPUTS, labels, whose

from ..plan.plan import Plan
from ..read.errors import Data, SceneError
from .digests import disputed, read_object

if TYPE_CHECKING:
    from pyarrow import Table
    from xarray import Dataset

    from chapsym.dynamics.labelled import Column, Structure

#: The errors of readers for a file that is damaged, or made by another program.
READERS = ValueError, KeyError, EOFError, csv.Error, zipfile.BadZipFile, zlib.error, TokenError
DAMAGED = (*READERS, TypeError, AttributeError, ArithmeticError, IndexError, RecursionError, NotImplementedError)
#: The numeric variables of a result besides its outputs.
NUMBERS = ("taken", "status", "error", "order", "substeps", "mass_tensor", "D", "radius", "time", "step")
#: The signature of a global heap of HDF5: its name and version.
HEAP = b"GCOL\x01\x00\x00\x00"
#: The size of a block of a CSV in bytes, and the largest size of the notes in its first row.
BLOCK = 2**24
#: The destination of a CSV without a file.
STDOUT = Path("-")
MOST_ROWS = 10**7
#: The files that need no extras.
ALONE = (".csv", ".npz")
#: The largest fraction of the memory of this machine for a result outside of Zarr.
SHARE = 0.25


class NotOurs(SceneError):
    """A table that chapsym did not write, such as that of another program."""


def check_destination(path: Path) -> None:
    """Raises SceneError, before anything is computed, if a result cannot be written to `path`."""
    *some, last = _READERS
    if path == STDOUT:
        if sys.stdout is None or getattr(sys.stdout, "name", "") == os.devnull:  # the command puts it in its place
            raise SceneError("-: standard output is closed; name a file")
        return
    if path.suffix not in _READERS:
        raise SceneError(f"{str(path)!r}: the output must end in {', '.join(some)} or {last}, or be - for a CSV")
    if path.suffix not in ALONE:
        extras.need("scenes")
    if path.suffix != ".zarr":
        try:
            files.check_destination(path)
        except files.CannotWrite as error:
            raise SceneError(str(error)) from None


def check_size(plan: Plan, path: Path) -> None:
    """Raises SceneError, before anything is computed, if the result is too large for a file of this kind."""
    _check_rows(path, len(plan.members) * plan.frames)
    if path.suffix != ".zarr" and plan.bytes > SHARE * _memory():
        layout = "which is too much to be written at once on this machine; write to .zarr"
        raise SceneError(f"{path}: the result has {plan.bytes / 1e9:.3g} GB, {layout}")


def _check_rows(path: Path, rows: int) -> None:
    if (path == STDOUT or path.suffix == ".csv") and rows > MOST_ROWS:
        layout = f"{rows} rows, and a CSV of more than {MOST_ROWS} is of no use; write to .parquet or .zarr"
        raise SceneError(f"{path}: the result has {layout}, or keep fewer frames with run.every")


def save(data: "Dataset | Arrays", path: Path) -> None:
    """Writes a result to .nc, .csv, .parquet or .npz, whole or not at all; raises SceneError if that fails.

    A CSV goes to standard output, too, as `STDOUT`.

    Each row of a CSV or Parquet file is one ball at one frame; other data are in the column "chapsym", or in the
    metadata.  A .npz has an array for each variable, for one ball without the axis of balls, and the rest as JSON in
    "chapsym".  `pandas.read_csv(path)` has the same bits (older pandas with float_precision="round_trip").
    """
    write = _write_csv if path == STDOUT else _WRITERS.get(path.suffix)
    if write is None:
        raise SceneError(f"{str(path)!r}: a result is written to {', '.join(_WRITERS)}")
    _check_rows(path, data.sizes["ball"] * data.sizes["frame"])
    if path == STDOUT:
        write(sys.stdout.buffer, data)
        return
    try:
        files.write_whole(path, lambda stream: write(stream, data))
    except files.CannotWrite as error:
        raise SceneError(str(error)) from None
    except MemoryError:
        raise SceneError(f"{path}: the result does not fit into memory a second time; write to .zarr") from None


def load(path: Path) -> "Dataset":
    """A result of `chapsym run` in any format, with its frames indexed by `time`, as for a run in memory.

    Values in Zarr are read on first use.
    Raises SceneError if there is no such result.
    """
    read = _READERS.get(path.suffix)
    if read is None:
        raise SceneError(f"{str(path)!r} is no result: one ends in {', '.join(_READERS)}")
    extras.need("scenes")
    try:
        files.check_source(path)
        path.stat()
        data = with_clock(read(path))
        check_parts(data)
    except SceneError:
        raise
    except files.CannotRead as error:
        raise SceneError(str(error)) from None
    except OSError as error:
        reason = error.strerror or str(error).splitlines()[0]
        raise SceneError(f"{path} cannot be read: {reason}") from None
    except MemoryError:
        raise SceneError(f"{path} does not fit into memory, if it is not damaged") from None
    except DAMAGED as error:
        layout = "its parts are not those of a result"  # the message of a reader does not help a user
        if isinstance(error, READERS):
            layout = (str(error).splitlines() or [type(error).__name__])[0][:200]
        raise SceneError(f"{path} is damaged, or no result of chapsym: {layout}") from None
    for one in data.variables.values():
        one.attrs = plain(one.attrs)
    return data.assign_attrs(plain(data.attrs))


def check_parts(data: "Dataset") -> None:
    """Raises ValueError for a variable without numbers, or with wrong dimensions."""
    if not isinstance(data.attrs.get("accuracy", 0.0), float | int | np.number):
        raise ValueError("its accuracy is no number")
    for name, one in data.variables.items():
        output = OUTPUTS.get(whose(str(name)))
        if (output or name in NUMBERS) and one.dtype.kind not in "iuf":
            raise ValueError(f"{name} has no real numbers")
        over = {"ball"} if output and output.per_ball else {"ball", "frame"} if output else set()
        over = {"frame"} if name in ("time", "step") else over
        if lacking := over & set(data.dims) - set(one.dims):
            raise ValueError(f"{name} lacks the dimension {min(map(str, lacking))}")


def attributes(path: Path) -> Data:
    """The attributes of an existing result; raises SceneError if they cannot be read."""
    try:
        if path.suffix == ".npz" and path.is_file():  # without xarray, whose import takes longer than a run
            with np.load(path) as data:
                return dict(json.loads(str(data[NOTES]))["attrs"])
        if path.suffix == ".csv" and path.is_file() and (about := _about_csv(path)):
            return dict(about["attrs"])
        if path.is_file():
            return load(path).attrs
        found = read_object(path / "zarr.json")["attributes"]
    except (SceneError, OSError, *DAMAGED):
        replaced = path.is_file() and path.suffix != ".zarr"
        layout = "choose another name" + (", or replace it with --fresh" if replaced else "")
        raise SceneError(f"{path} is there, but it is no result of chapsym; {layout}") from None
    return found if isinstance(found, dict) else {}


def check_ours(path: Path) -> None:
    """Raises SceneError if `path` is anything but a result of chapsym, which must not be overwritten."""
    if "chapsym_version" not in attributes(path):
        raise SceneError(f"{path} is there, but it is no result of chapsym; choose another name")


def _memory() -> float:
    """The memory of this machine in bytes."""
    import os

    try:
        return float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    except (AttributeError, ValueError, OSError):
        return 8e9


def _write_netcdf(stream: IO[bytes], data: "Dataset | Arrays") -> None:
    data = data.dataset() if isinstance(data, Arrays) else data
    # In memory first: HDF5 ends the process when the disk under it is full.
    whole = data.assign_attrs({key: int(v) if isinstance(v, bool) else v for key, v in data.attrs.items()})
    stream.write(whole.to_netcdf(engine="h5netcdf"))


def _about(data: "Dataset | Arrays", layout: "Structure") -> Data:
    return {"structure": layout, "attrs": plain(data.attrs)}


def _write_parquet(stream: IO[bytes], data: "Dataset | Arrays") -> None:
    import pyarrow
    from pyarrow import parquet

    layout, writer = structure(data), None
    about = {NOTES: json.dumps(_about(data, layout), ensure_ascii=False)}
    for columns in batches(data, layout["variables"]):
        texts = {name: values.tolist() for name, values in columns.items() if values.dtype.kind in "OUT"}
        table = pyarrow.table({**columns, **texts}).replace_schema_metadata(about)
        writer = writer or parquet.ParquetWriter(stream, table.schema, compression="zstd")
        writer.write_table(table)
    if writer is not None:
        writer.close()


def _write_csv(stream: IO[bytes], data: "Dataset | Arrays") -> None:
    """Writes numbers as Python does, which every reader with correct rounding restores to the bit."""
    writer, begun = csv.writer(codecs.getwriter("utf-8")(stream), lineterminator="\n"), False
    for columns in _with_notes(data):
        if not begun:
            writer.writerow(columns)
        begun = True
        writer.writerows(zip(*(values.tolist() for values in columns.values()), strict=True))


def _with_notes(data: "Dataset | Arrays") -> Iterator[dict[str, np.ndarray]]:
    """The columns of a CSV: after those that differ from row to row, `NOTES`, JSON in the first row of each ball.

    It has what the ball has once, and in that of the first ball all that no row has.  The other rows have a sign, as
    pandas takes a column that is empty from some row on for two kinds of data.
    """
    layout, ball = structure(data), 0
    once = {name: data[name].values for name, one in layout["variables"].items() if not in_rows(one)}
    rows = {name: one for name, one in layout["variables"].items() if name not in once}
    for columns in batches(data, rows):
        notes = np.full(len(next(iter(columns.values()))), "-", dtype=object)
        for row in range(0, len(notes), layout["frames"]):
            note = {name: _written(values[ball].tolist()) for name, values in once.items()}
            note |= {} if ball else _about(data, layout)
            notes[row], ball = json.dumps(note, ensure_ascii=False), ball + 1
        yield columns | {NOTES: notes}


def _written(value: Any) -> Any:
    """A number or several for JSON: those that are not finite as strings that `float` reads."""
    if isinstance(value, list):
        return [_written(one) for one in value]
    return value if not isinstance(value, float) or math.isfinite(value) else str(value)


def _read_zarr(path: Path) -> "Dataset":
    import xarray

    from .chunks import CheckedStore, mended

    check_ours(path)
    if found := disputed(path):
        raise SceneError(f"{path / 'zarr.json'} and the zarr.json of {found[0]!r} in it differ: {mended(path)}")
    with warnings.catch_warnings(action="ignore"):  # a sentence reports what is wrong
        data = xarray.open_zarr(CheckedStore(path, read_only=True))
    for name, one in data.variables.items():
        chunks = one.encoding.get("chunks") or ()
        if any(length > max(size, 1) for length, size in zip(chunks, one.shape, strict=False)):
            raise ValueError(f"the chunks of {name} are larger than it is")
        # Older versions of Zarr and xarray would write strings to other formats in NumPy's own type, which none
        # accepts.
        if getattr(one.encoding.get("dtype"), "kind", "") == "T":
            del one.encoding["dtype"]
        one.encoding.pop("compressors", None)  # a copy by xarray omits chunks of missing values
    return data


def _read_netcdf(path: Path) -> "Dataset":
    import xarray

    _check_heaps(path)
    import h5py

    try:
        with h5py.File(path) as file:
            file.visititems(lambda name, item: None)  # h5netcdf prints a traceback if it cannot open a whole file
            return xarray.load_dataset(path, engine="h5netcdf")
    except (OSError, RuntimeError) as error:
        raise ValueError(str(error)) from None


def _check_heaps(path: Path) -> None:
    """Raises ValueError for a heap in which HDF5 goes round for ever, deaf to an interrupt: by an object of no size.

    Free space has the number 0 and its size with the head; others have the size of what follows, in eights.
    """
    with path.open("rb") as file:
        if not path.stat().st_size:
            raise ValueError("it is empty")
        with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
            heap = data.find(HEAP)
            while heap >= 0:
                _, size = unpack_from("<QQ", data[heap : heap + 16].ljust(16, b"\0"))
                at, end = heap + 16, min(heap + size, len(data))
                while at + 16 <= end:
                    number, length = unpack_from("<H6xQ", data, at)
                    if not number and not length:
                        raise ValueError("a heap of HDF5 has an object of no size")
                    at += 16 + -(-length // 8) * 8 if number else length
                heap = data.find(HEAP, heap + 1)


def _read_parquet(path: Path) -> "Dataset":
    from pyarrow import parquet

    table = parquet.ParquetFile(path).read()
    about = json.loads((table.schema.metadata or {})[NOTES.encode()])
    return _assembled(_columns(table), about["structure"], about["attrs"])


def _read_csv(path: Path) -> "Dataset":
    with path.open(encoding="utf-8", newline="") as stream:
        first = stream.readline(files.MOST_LINE)
    if first.strip() and not is_ours(first):
        layout = f"it has no column {NOTES}; chapsym show and chapsym judge read the trajectory of another program"
        raise NotOurs(f"{path} was not written by chapsym: {layout}")
    if first.startswith("# "):
        return _with_lines(path)
    about = _about_csv(path)
    if not about:
        return _old(_rows(path, {}))
    layout = about["structure"]
    rows = {name: one for name, one in layout["variables"].items() if in_rows(one)}
    columns = _rows(path, rows)
    notes = [json.loads(text) for text in columns[NOTES][:: layout["frames"]]]
    for name, one in layout["variables"].items():
        if name not in rows:
            kind = {"double": np.float64, "int64": np.int64}.get(one["type"], object)
            values = np.array([note[name] for note in notes], dtype=kind).reshape(len(notes), -1)
            values = np.repeat(values, layout["frames"], axis=0)
            columns |= {column: values[:, i] for i, column in enumerate(one["columns"])}
    return _assembled(columns, layout, about["attrs"])


def _about_csv(path: Path) -> Data:
    """The notes in the first row of a CSV; empty without the column `NOTES`."""
    limit = csv.field_size_limit(BLOCK)
    try:
        with path.open(encoding="utf-8", newline="") as stream:
            rows = csv.DictReader(iter(lambda: stream.readline(files.MOST_LINE), ""))
            return dict(json.loads(next(rows, {})[NOTES])) if NOTES in (rows.fieldnames or ()) else {}
    finally:
        csv.field_size_limit(limit)  # a setting of the whole process


def _rows(path: Path, variables: "Mapping[str, Column]", lines: int = 0) -> dict[str, np.ndarray]:
    """The columns of a CSV below some lines: notes as text, variables in their types, the others as they look."""
    import pyarrow
    from pyarrow.csv import ConvertOptions, ParseOptions, ReadOptions, read_csv

    types = {column: pyarrow.type_for_alias(one["type"]) for one in variables.values() for column in one["columns"]}
    reading, parsing = ReadOptions(block_size=BLOCK, skip_rows=lines), ParseOptions(newlines_in_values=True)
    kinds = ConvertOptions(column_types=types | {NOTES: pyarrow.string()})
    return _columns(read_csv(path, reading, parsing, kinds))


def _with_lines(path: Path) -> "Dataset":
    """A file of before: what no row has is in `# ` lines, and what a ball has once in each of its rows."""
    with path.open(encoding="utf-8", newline="") as stream:
        notes = [line[2:].partition(": ") for line in takewhile(lambda line: line.startswith("# "), stream)]
    attrs: Data = {key: json.loads(value) for key, _, value in notes}
    layout = attrs.pop("structure")
    return _assembled(_rows(path, layout["variables"], len(notes)), layout, attrs)


def _write_npz(stream: IO[bytes], data: "Dataset | Arrays") -> None:
    """Writes the arrays of all variables, for one ball without the axis of balls."""
    layout = structure(data)
    whole = data.isel(ball=0) if layout["balls"] == 1 else data
    arrays: dict[str, Any] = {name: whole[name].values for name in layout["variables"]}
    arrays = {name: np.array(a.tolist(), dtype=str) if a.dtype.kind in "OT" else a for name, a in arrays.items()}
    about = json.dumps(_about(data, layout), ensure_ascii=False)
    np.savez(stream, chapsym=np.array(about), **arrays)


def _read_npz(path: Path) -> "Dataset":
    with path.open("rb") as file, np.load(file, allow_pickle=False) as data:
        arrays = {name: data[name] for name in data.files}
    if NOTES not in arrays:
        return _old(arrays)
    about = json.loads(str(arrays[NOTES]))
    layout = about["structure"]
    for name, one in layout["variables"].items():
        values = arrays[name].astype(object) if arrays[name].dtype.kind == "U" else arrays[name]
        arrays[name] = np.expand_dims(values, 0) if layout["balls"] == 1 and "ball" in one["dims"] else values
    return _dataset(arrays, layout, about["attrs"])


def _columns(table: "Table") -> dict[str, np.ndarray]:
    return {name: table[name].to_numpy() for name in table.column_names}


def _assembled(columns: Mapping[str, np.ndarray], layout: "Structure", attrs: Data) -> "Dataset":
    """The Dataset of a table; raises KeyError, ValueError or TypeError if the table is not whole."""
    arrays = {}
    for name, one in layout["variables"].items():
        inner = [len(layout["labels"][dim]) for dim in one["dims"] if dim in layout["labels"]]
        values = np.stack([columns[column] for column in one["columns"]], axis=-1)
        values = values.reshape(layout["balls"], layout["frames"], *inner)
        arrays[name] = values[:, 0] if "frame" not in one["dims"] else values if "ball" in one["dims"] else values[0]
    return _dataset(arrays, layout, attrs)


def _dataset(arrays: Mapping[str, np.ndarray], layout: "Structure", attrs: Data) -> "Dataset":
    """The Dataset of these arrays of a `structure`."""
    import xarray

    coords: dict[str, object] = {dim: np.array(names, dtype=object) for dim, names in layout["labels"].items()}
    variables: dict[str, object] = {}
    for name, one in layout["variables"].items():
        if np.ndim(arrays[name]) != len(one["dims"]):
            raise ValueError(f"{name} has {np.ndim(arrays[name])} axes, not {', '.join(one['dims'])}")
        (coords if one["coordinate"] else variables)[name] = (one["dims"], arrays[name], one["attrs"])
    return xarray.Dataset(variables, coords, dict(attrs))


#: The present names of those in old files.
_OLD = {"contact_m": "contact", "time_s": "time"}


def _old(columns: Mapping[str, np.ndarray]) -> "Dataset":
    """A file of one ball as chapsym 0.1.0 first wrote it: a .npz without the key "chapsym", a .csv without `# ` lines.

    In the CSV vectors count from 0, `momentum_0`.  Raises KeyError or ValueError for columns of no result.
    """
    import xarray

    parts: dict[str, list[np.ndarray]] = {}
    for column, values in columns.items():
        name = re.sub(r"_\d$", "", column)
        for was, now in _OLD.items():
            name = name.replace(was, now)
        parts.setdefault(name, []).append(values)
    found = {name: some[0] if len(some) == 1 else np.stack(some, axis=-1) for name, some in parts.items()}
    step = found["step"]
    coords: dict[str, object] = {"ball": np.array(["1"], dtype=object), "step": ("frame", step, {"units": "1"})}
    if "time" in found:
        coords["time"] = ("frame", found["time"], {"units": "s"})
    variables: dict[str, object] = {}
    for name, values in found.items():
        of = OUTPUTS.get(whose(name))
        if of is not None:
            (dim,) = of.dims
            coords[dim] = np.array(labels(3)[dim], dtype=object)
            floats = values if values.dtype.kind in "OUS" else values.astype(np.float64)
            variables[name] = (("ball", "frame", dim), floats[np.newaxis], of.attrs(3, motion=False))
    variables["taken"] = ("ball", step[-1:], {"units": "1", "long_name": "steps taken"})
    variables["status"] = ("ball", np.zeros(1, dtype=np.int64), {"long_name": "why the ball stopped (not known)"})
    return xarray.Dataset(variables, coords, {"title": "A ball, from a file that does not say where it comes from"})


_WRITERS: dict[str, Callable[[IO[bytes], "Dataset | Arrays"], None]] = {
    ".nc": _write_netcdf, ".csv": _write_csv, ".parquet": _write_parquet, ".npz": _write_npz,
}  # fmt: skip
_READERS: dict[str, Callable[[Path], "Dataset"]] = {
    ".zarr": _read_zarr, ".nc": _read_netcdf, ".csv": _read_csv, ".parquet": _read_parquet,
    ".npz": _read_npz,
}  # fmt: skip
READABLE = tuple(_READERS)
