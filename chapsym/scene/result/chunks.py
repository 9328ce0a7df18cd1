"""Reading of a result in Zarr: a missing or damaged chunk is refused by name."""

import json
from functools import cached_property
from pathlib import Path
from typing import Any

from zarr.codecs import Crc32cCodec, ZstdCodec
from zarr.storage import LocalStore

from chapsym import files

from ..read.errors import SceneError
from .digests import checksums, metadata, read_object, sound

#: The codecs of bytes; the last one adds the checksum.
COMPRESSORS = (ZstdCodec(), Crc32cCodec())


class CheckedStore(LocalStore):
    """A folder of Zarr without access to damaged data: a SceneError names the chunk instead."""

    @cached_property
    def _checked(self) -> frozenset[str]:
        """The arrays that have checksums."""
        return frozenset(name for name, one in metadata(self.root).items() if "crc32c" in json.dumps(one))

    @cached_property
    def _digests(self) -> dict[str, str]:
        """The checksums of the chunks of a complete result."""
        return checksums(self.root) if self._complete else {}

    @cached_property
    def _complete(self) -> bool:
        """Whether no chunk may be missing."""
        about = read_object(self.root / "zarr.json").get("attributes")
        return isinstance(about, dict) and bool(about.get("complete"))

    async def get(self, key: str, *args: Any, **options: Any) -> Any:
        """The contents of a file, or None; raises SceneError for a chunk that is missing or damaged."""
        if (self.root / key).is_fifo():
            raise SceneError(f"{self.root / key} is a pipe, not a file")
        try:
            found = await super().get(key, *args, **options)
        except OSError as error:
            raise SceneError(f"{self.root / key} cannot be read: {error.strerror or error}") from None
        name, _, chunk = key.partition("/")
        if chunk.split("/")[0] == "c" and name in self._checked:
            if found is None and self._complete:
                raise SceneError(f"{self.root / key} is missing: {mended(self.root)}")
            if found is not None and not sound(found.to_bytes(), self._digests.get(key)):
                raise SceneError(f"{self.root / key} is damaged: {mended(self.root)}")
        return found


def mended(path: Path) -> str:
    """The way to repair a damaged result, as a clause."""
    return f"chapsym run of the same scene with -o {files.pasted(path)} computes these balls anew and keeps the others"
