"""What a Zarr group says of itself: whether it is a result of chapsym."""

import json
from pathlib import Path
from typing import Any

from ..read.errors import SceneError


def attributes(path: Path) -> dict[str, Any]:
    """The attributes of a Zarr group; raises SceneError if there are none to be read."""
    try:
        found = json.loads((path / "zarr.json").read_text(encoding="utf-8"))["attributes"]
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        raise SceneError(f"{path} is there, but it is no result of chapsym; choose another name") from None
    return found if isinstance(found, dict) else {}


def is_store(path: Path) -> bool:
    """Whether `path` holds a result of chapsym in Zarr."""
    try:
        return "chapsym_version" in attributes(path)
    except SceneError:
        return False


def check_ours(path: Path) -> None:
    """Raises SceneError if `path` is anything but a result of chapsym, which nobody may overwrite."""
    if not is_store(path):
        raise SceneError(f"{path} is there, but it is no result of chapsym; choose another name")
