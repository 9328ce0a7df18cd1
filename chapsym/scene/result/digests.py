"""The checksums of the chunks of a result in Zarr, which reveal missing or damaged chunks.

Each chunk ends in its checksum.  Chunks of missing values are written too, so that in a complete result an absent chunk
is a lost one.  Next to the chunks of each array of a complete result, `DIGESTS` lists their checksums, which also
reveals an intact chunk of another place, array or run.
"""

import json
import os
from contextlib import suppress
from pathlib import Path

from chapsym import files

from ..read.errors import Data

#: The length of the checksum, at the end.
BYTES = 4
#: The file in the folder of an array with its name, and the checksum of each chunk.
DIGESTS = "digests.json"


def sound(content: bytes, digest: str | None = None) -> bool:
    """Whether a chunk ends in the checksum of the rest, which is `digest` if that is known.

    An empty chunk has none; its checksum would be 0.
    """
    from google_crc32c import value as crc32c

    whole = len(content) > BYTES and int.from_bytes(content[-BYTES:], "little") == crc32c(content[:-BYTES])
    return whole and digest in (None, content[-BYTES:].hex())


def is_sound(chunk: Path, digest: str | None = None) -> bool:
    """Whether the file of a chunk exists, can be read, and is unchanged."""
    try:
        return chunk.is_file() and sound(chunk.read_bytes(), digest)
    except OSError:
        return False


def digest(chunk: Path) -> str:
    """The checksum at the end of the file of a chunk, in hexadecimal digits; raises OSError."""
    with chunk.open("rb") as file:  # a file of another program may be shorter
        file.seek(max(file.seek(0, os.SEEK_END) - BYTES, 0))
        return file.read().hex()


def written(array: Path) -> dict[str, Path]:
    """The existing files of the chunks of an array, by their keys inside its folder."""
    found = {file.relative_to(array).as_posix(): file for file in array.rglob("*") if file.is_file()}
    return {key: file for key, file in sorted(found.items()) if key.split("/")[0] == "c"}


def write_digests(path: Path) -> None:
    """Lists the checksums of the chunks of each array of a group; raises CannotWrite or OSError."""
    for array in folders(path):
        found = {key: digest(file) for key, file in written(array).items()}
        files.write_text(array / DIGESTS, json.dumps({"array": array.name, "crc32c": found}, indent=1))


def checksums(path: Path) -> dict[str, str]:
    """The checksums that `write_digests` lists, by the keys of the chunks in the group; "" if of another array."""
    found = dict[str, str]()
    for array in folders(path):
        own = read_object(array / DIGESTS)
        sums = own["crc32c"] if isinstance(own.get("crc32c"), dict) else {}
        found |= {f"{array.name}/{key}": sums[key] if own.get("array") == array.name else "" for key in sums}
    return found


def folders(path: Path) -> list[Path]:
    """The folders of the arrays of a group, inside of its own."""
    return [path / name for name in sorted(metadata(path)) if Path(name).name == name and name not in ("", "..")]


def metadata(path: Path) -> Data:
    """The metadata of the arrays, by name: in the group, or otherwise those of each array."""
    found = said(path)
    return {file.parent.name: read_object(file) for file in path.glob("*/zarr.json")} if found is None else found


def said(path: Path) -> Data | None:
    """The metadata of the arrays in the group, by name, if any."""
    with suppress(KeyError, TypeError):
        found = read_object(path / "zarr.json")["consolidated_metadata"]["metadata"]
        return found if isinstance(found, dict) else None
    return None


def disputed(path: Path) -> list[str]:
    """The arrays whose own metadata differ from those in the group."""
    own = [file for file in path.glob(f"*/{DIGESTS}") if read_object(file).get("array") == file.parent.name]
    listed, found = {file.parent.name for file in own}, metadata(path)
    return sorted(name for name in listed | set(found) if read_object(path / name / "zarr.json") != found.get(name))


def read_object(path: Path) -> Data:
    """An object of JSON; an empty one if there is none."""
    found = None
    with suppress(OSError, ValueError, RecursionError):
        found = json.loads(path.read_bytes()) if path.is_file() else None  # a pipe would block
    return found if isinstance(found, dict) else {}
