"""The checksums of the chunks of a result in Zarr, by which one that is missing or damaged is found.

Each chunk ends in its checksum.  One of missing values is written too, so that in a complete result each one that is
not there is lost.  Next to the chunks of each array of a complete result, `DIGESTS` lists their checksums, so that a
whole chunk of another place, array or run is found, too.
"""

import json
import os
from contextlib import suppress
from pathlib import Path

from chapsym import files

from ..read.errors import Data

#: Of the checksum, at the end.
BYTES = 4
#: In the folder of an array: its name, and the checksum of each chunk.
DIGESTS = "digests.json"


def sound(content: bytes, digest: str | None = None) -> bool:
    """Whether a chunk ends in the checksum of the rest, and, where it is known, in its own.

    One that is cut to nothing has none, and would be 0.
    """
    from google_crc32c import value as crc32c

    whole = len(content) > BYTES and int.from_bytes(content[-BYTES:], "little") == crc32c(content[:-BYTES])
    return whole and digest in (None, content[-BYTES:].hex())


def is_sound(chunk: Path, digest: str | None = None) -> bool:
    """Whether the file of a chunk is there, can be read, and is as it was written."""
    try:
        return chunk.is_file() and sound(chunk.read_bytes(), digest)
    except OSError:
        return False


def digest(chunk: Path) -> str:
    """The checksum that the file of a chunk ends in, in hexadecimal digits; raises OSError."""
    with chunk.open("rb") as file:  # which may be shorter, where another program has put it
        file.seek(max(file.seek(0, os.SEEK_END) - BYTES, 0))
        return file.read().hex()


def written(array: Path) -> dict[str, Path]:
    """The files of the chunks of an array that are there, by their keys inside its folder."""
    found = {file.relative_to(array).as_posix(): file for file in array.rglob("*") if file.is_file()}
    return {key: file for key, file in sorted(found.items()) if key.split("/")[0] == "c"}


def digests(array: Path) -> dict[str, str]:
    """The checksums of the chunks of an array by their keys, as `write_digests` left them; none if there is no list.

    Where the list is that of another array no chunk has the right one.
    """
    found = read_object(array / DIGESTS)
    listed = found["crc32c"] if isinstance(found.get("crc32c"), dict) else {}
    return listed if found.get("array") == array.name else dict.fromkeys(listed, "")


def write_digests(path: Path) -> None:
    """Lists the checksums of the chunks of each array of a group; raises CannotWrite or OSError."""
    for array in folders(path):
        found = {key: digest(file) for key, file in written(array).items()}
        files.write_text(array / DIGESTS, json.dumps({"array": array.name, "crc32c": found}, indent=1))


def folders(path: Path) -> list[Path]:
    """The folders of the arrays of a group, inside of its own."""
    return [path / name for name in sorted(metadata(path)) if Path(name).name == name and name not in ("", "..")]


def metadata(path: Path) -> Data:
    """What the group says of its arrays, by their names; where it says nothing, what each says of itself."""
    found = said(path)
    return {file.parent.name: read_object(file) for file in path.glob("*/zarr.json")} if found is None else found


def said(path: Path) -> Data | None:
    """What the group says of its arrays, by their names, if it says anything."""
    with suppress(KeyError, TypeError):
        found = read_object(path / "zarr.json")["consolidated_metadata"]["metadata"]
        return found if isinstance(found, dict) else None
    return None


def disputed(path: Path) -> list[str]:
    """The arrays that say of themselves what the group does not say of them."""
    own = [file for file in path.glob(f"*/{DIGESTS}") if read_object(file).get("array") == file.parent.name]
    listed, found = {file.parent.name for file in own}, metadata(path)
    return sorted(name for name in listed | set(found) if read_object(path / name / "zarr.json") != found.get(name))


def read_object(path: Path) -> Data:
    """An object of JSON; an empty one where there is none to be read."""
    found = None
    with suppress(OSError, ValueError, RecursionError):
        found = json.loads(path.read_bytes()) if path.is_file() else None  # a pipe would be waited for
    return found if isinstance(found, dict) else {}
