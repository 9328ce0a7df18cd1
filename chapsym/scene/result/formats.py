"""Results in files: NetCDF, and for the small CSV, Parquet and NumPy, each written whole; how all are read back."""

import json
import warnings
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import numpy as np

from chapsym import files

from ..plan.plan import Plan
from ..read.errors import SceneError
from . import old
from .arrays import Arrays
from .dataset import with_clock
from .flat import arrays_of, assembled, batches, from_arrays, plain, structure
from .group import check_ours

if TYPE_CHECKING:
    from xarray import Dataset

#: What readers raise of a file that is damaged, or made by somebody else.
DAMAGED = (
    ValueError, KeyError, TypeError, EOFError, AttributeError, IndexError, RecursionError, NotImplementedError,
    zipfile.BadZipFile, zlib.error,
)  # fmt: skip
#: More rows make a CSV that nothing opens.
MOST_ROWS = 10**7
#: The share of this machine's memory that a result may take before it goes to Zarr.
SHARE = 0.25
#: What may follow the dot of a result.
SUFFIXES = (".zarr", ".nc", ".csv", ".parquet", ".npz")


def check_destination(path: Path) -> None:
    """Raises SceneError, before anything is computed, if a result cannot be written as `path` is named."""
    if path.suffix not in SUFFIXES:
        raise SceneError(f"{str(path)!r}: the output must end in {', '.join(SUFFIXES[:-1])} or {SUFFIXES[-1]}")
    if path.suffix != ".zarr":
        try:
            files.check_destination(path)
        except files.CannotWrite as error:
            raise SceneError(str(error)) from None


def check_size(plan: Plan, path: Path) -> None:
    """Raises SceneError, before anything is computed, if the result is too large for a file of this kind."""
    rows = len(plan.members) * plan.frames
    if path.suffix == ".csv" and rows > MOST_ROWS:
        told = f"{rows} rows, and a CSV of more than {MOST_ROWS} is of no use; write to .parquet or .zarr"
        raise SceneError(f"{path}: the result has {told}, or keep fewer frames with run.every")
    if path.suffix != ".zarr" and plan.bytes > SHARE * _memory():
        told = "which is too much to be written at once on this machine; write to .zarr"
        raise SceneError(f"{path}: the result has {plan.bytes / 1e9:.3g} GB, {told}")


def save(data: "Dataset | Arrays", path: Path) -> None:
    """Writes a result to .nc, .csv, .parquet or .npz, whole or not at all; raises SceneError if the disk refuses.

    Of a CSV or Parquet file each row is a ball and a frame; what is not in the rows stands in `# ` lines, or in the
    metadata.  A .npz has an array for each variable, of one ball without its axis, and the rest as JSON in "chapsym".
    `pandas.read_csv(path, comment="#")` has the same bits (older pandas with float_precision="round_trip").
    """
    write = _WRITERS.get(path.suffix)
    if write is None:
        raise SceneError(f"{str(path)!r}: a result is written to {', '.join(_WRITERS)}")
    if path.suffix == ".csv" and data.sizes["ball"] * data.sizes["frame"] > MOST_ROWS:
        raise SceneError(f"{path}: a CSV of more than {MOST_ROWS} rows is of no use; write to .parquet or .nc")
    try:
        files.write_whole(path, lambda stream: write(stream, data))
    except files.CannotWrite as error:
        raise SceneError(str(error)) from None
    except MemoryError:
        raise SceneError(f"{path}: the result does not fit into memory a second time; write to .zarr") from None


def load(path: Path) -> "Dataset":
    """A result as `chapsym run` wrote it, whatever its format, its frames found by `time`, as those of a run in memory.

    From Zarr its values are read when they are needed.
    Raises SceneError if there is no such result.
    """
    read = _READERS.get(path.suffix)
    if read is None:
        raise SceneError(f"{str(path)!r} is no result: one ends in {', '.join(_READERS)}")
    if path.is_fifo():
        raise SceneError(f"{path} is a pipe, not a file with a result")
    try:
        path.stat()
        data = with_clock(read(path))
    except SceneError:
        raise
    except OSError as error:
        reason = error.strerror or str(error).splitlines()[0]
        raise SceneError(f"{path} cannot be read: {reason}") from None
    except DAMAGED as error:
        told = (str(error).splitlines() or [type(error).__name__])[0]
        raise SceneError(f"{path} is damaged, or no result of chapsym: {told}") from None
    for one in data.variables.values():
        one.attrs = plain(one.attrs)
    return data.assign_attrs(plain(data.attrs))


def _memory() -> float:
    """Bytes of memory that this machine has."""
    import os

    try:
        return float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    except (AttributeError, ValueError, OSError):
        return 8e9


def _write_netcdf(stream: IO[bytes], data: "Dataset | Arrays") -> None:
    data = with_clock(data.dataset()) if isinstance(data, Arrays) else data
    # In memory first: HDF5 ends the process when the disk under it is full.
    whole = data.assign_attrs({key: int(v) if isinstance(v, bool) else v for key, v in data.attrs.items()})
    stream.write(whole.to_netcdf(engine="h5netcdf"))


def _write_rows(data: "Dataset | Arrays", told: dict[str, Any], begin: Callable[[Any], Any], about: Any = None) -> None:
    """Writes the table with the writer that `begin` makes for its schema, some balls after the others."""
    import pyarrow

    writer = None
    for columns in batches(data, told):
        texts = {name: values.tolist() for name, values in columns.items() if values.dtype.kind in "OUT"}
        table = pyarrow.table({**columns, **texts}).replace_schema_metadata(about)
        writer = writer or begin(table.schema)
        writer.write_table(table)
    if writer is not None:
        writer.close()


def _write_parquet(stream: IO[bytes], data: "Dataset | Arrays") -> None:
    from pyarrow import parquet

    told = structure(data)
    about = {"chapsym": json.dumps({"structure": told, "attrs": plain(data.attrs)}, ensure_ascii=False)}
    _write_rows(data, told, lambda schema: parquet.ParquetWriter(stream, schema, compression="zstd"), about)


def _write_csv(stream: IO[bytes], data: "Dataset | Arrays") -> None:
    from pyarrow import csv

    told = structure(data)
    for key, value in (plain(data.attrs) | {"structure": told}).items():
        stream.write(f"# {key}: {json.dumps(value, ensure_ascii=False)}\n".encode())
    options = csv.WriteOptions(quoting_style="needed")
    _write_rows(data, told, lambda schema: csv.CSVWriter(stream, schema, write_options=options))


def _read_zarr(path: Path) -> "Dataset":
    import xarray

    check_ours(path)
    with warnings.catch_warnings():  # of a group that lacks what it should have, which is told in a sentence
        warnings.filterwarnings("ignore", message="Failed to open Zarr store with consolidated metadata")
        data = xarray.open_zarr(path)
    for one in data.variables.values():
        # Older versions of Zarr and xarray would write texts to other formats in NumPy's own type, which none takes.
        if getattr(one.encoding.get("dtype"), "kind", "") == "T":
            del one.encoding["dtype"]
    return data


def _read_netcdf(path: Path) -> "Dataset":
    import xarray

    with path.open("rb"):  # so that a missing file has the system's sentence
        return xarray.load_dataset(path, engine="h5netcdf")


def _read_parquet(path: Path) -> "Dataset":
    from pyarrow import parquet

    table = parquet.ParquetFile(path).read()
    about = json.loads((table.schema.metadata or {})[b"chapsym"])
    return assembled(_columns(table), about["structure"], about["attrs"])


def _read_csv(path: Path) -> "Dataset":
    import pyarrow
    from pyarrow import csv

    attrs: dict[str, Any] = {}
    lines = 0
    with path.open(encoding="utf-8", newline="") as stream:
        if not stream.readline().startswith("# "):
            return old.dataset(old.joined(_columns(csv.read_csv(path))))
        stream.seek(0)
        while (line := stream.readline()).startswith("# "):
            key, _, value = line[2:].partition(": ")
            attrs[key], lines = json.loads(value), lines + 1
    told = attrs.pop("structure")
    types = {
        column: pyarrow.type_for_alias(one["type"]) for one in told["variables"].values() for column in one["columns"]
    }
    table = csv.read_csv(
        path, csv.ReadOptions(skip_rows=lines), csv.ParseOptions(newlines_in_values=True),
        csv.ConvertOptions(column_types=types),
    )  # fmt: skip
    return assembled(_columns(table), told, attrs)


def _write_npz(stream: IO[bytes], data: "Dataset | Arrays") -> None:
    told = structure(data)
    about = json.dumps({"structure": told, "attrs": plain(data.attrs)}, ensure_ascii=False)
    np.savez(stream, **{"chapsym": np.array(about)} | arrays_of(data, told))  # type: ignore[arg-type]


def _read_npz(path: Path) -> "Dataset":
    with np.load(path, allow_pickle=False) as data:
        arrays = {name: data[name] for name in data.files}
    if "chapsym" not in arrays:
        return old.dataset(arrays)
    about = json.loads(str(arrays["chapsym"]))
    return from_arrays(arrays, about["structure"], about["attrs"])


def _columns(table: Any) -> dict[str, np.ndarray]:
    return {name: table[name].to_numpy() for name in table.column_names}


_WRITERS: dict[str, Callable[[IO[bytes], Any], None]] = {
    ".nc": _write_netcdf, ".csv": _write_csv, ".parquet": _write_parquet, ".npz": _write_npz,
}  # fmt: skip
_READERS: dict[str, Callable[[Path], Any]] = {
    ".zarr": _read_zarr, ".nc": _read_netcdf, ".csv": _read_csv, ".parquet": _read_parquet,
    ".npz": _read_npz,
}  # fmt: skip
