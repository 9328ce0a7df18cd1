"""The chunks of a result in Zarr: each ends in its checksum, and one that is missing or damaged is said, not read.

A chunk of missing values is written too, so that in a complete result each one that is not there is lost.
"""

import json
from contextlib import suppress
from functools import cached_property
from pathlib import Path
from typing import Any

from google_crc32c import value as crc32c
from zarr.codecs import Crc32cCodec, ZstdCodec
from zarr.storage import LocalStore

from ..read.errors import SceneError

#: Codecs of bytes: the last adds the checksum.
COMPRESSORS = (ZstdCodec(), Crc32cCodec())
#: Of the checksum, at the end.
BYTES = 4


def sound(content: bytes) -> bool:
    """Whether a chunk ends in the checksum of the rest; one that is cut to nothing has none, and would be 0."""
    return len(content) > BYTES and int.from_bytes(content[-BYTES:], "little") == crc32c(content[:-BYTES])


def is_sound(chunk: Path) -> bool:
    """Whether the file of a chunk is there, can be read, and is as it was written."""
    try:
        return sound(chunk.read_bytes())
    except OSError:
        return False


class CheckedStore(LocalStore):
    """A folder of Zarr of which nothing damaged is read: what would be is a SceneError that names the chunk."""

    @cached_property
    def _checked(self) -> frozenset[str]:
        """The arrays that have checksums."""
        return frozenset(file.parent.name for file in self.root.glob("*/zarr.json") if b'"crc32c"' in file.read_bytes())

    @cached_property
    def _complete(self) -> bool:
        """Whether no chunk may be missing."""
        with suppress(OSError, ValueError, KeyError, TypeError):
            return bool(json.loads((self.root / "zarr.json").read_bytes())["attributes"]["complete"])
        return False

    async def get(self, key: str, *args: Any, **options: Any) -> Any:
        """The contents of a file, or None; raises SceneError for a chunk that is missing or damaged."""
        found = await super().get(key, *args, **options)
        name, _, chunk = key.partition("/")
        if chunk.split("/")[0] == "c" and name in self._checked:
            if found is None and self._complete:
                raise SceneError(f"{self.root / key} is missing: {self._mended}")
            if found is not None and not sound(found.to_bytes()):
                raise SceneError(f"{self.root / key} is damaged: {self._mended}")
        return found

    @property
    def _mended(self) -> str:
        return f"chapsym run of the same scene with -o {self.root} computes these balls anew and keeps the others"
