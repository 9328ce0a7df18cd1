"""Whose result a store holds, and what differs from the run that is to be written."""

import json
import tomllib
from pathlib import Path
from typing import Any

from ...plan.plan import Plan
from ...read.errors import SceneError
from ...result.dataset import provenance
from ...result.group import attributes

ELSE = "choose another name, or replace it with --fresh"


def check_same(path: Path, plan: Plan) -> None:
    """Raises SceneError with what differs unless the store holds the run of this plan, of these versions."""
    found, wanted = attributes(path), provenance(plan)
    if found.get("scene") != wanted["scene"]:
        key = first_difference(_data(found.get("scene")), _data(wanted["scene"]))
        if key is not None:
            raise SceneError(f"{path} holds another scene ({key} differs); {ELSE}")
    told = difference(found, wanted)
    if told is not None:
        raise SceneError(f"{path} {told}; {ELSE}")


def difference(found: dict[str, Any], wanted: dict[str, Any]) -> str | None:
    """What differs of two runs apart from the text of the scene, as a verb and its object; None if nothing does."""
    for name, told in (
        ("chapsym_version", "is of another version of chapsym"),
        ("plan", "is of another plan"),
        ("kernels", "is of other kernels"),
        ("inputs_sha256", "is of other balls or starts"),
    ):
        if found.get(name) != wanted.get(name):
            return told
    return None


def first_difference(one: Any, other: Any, key: str = "") -> str | None:
    """The dotted key of the first difference of two nested tables; None if there is none."""
    if not (isinstance(one, dict) and isinstance(other, dict)):
        return None if one == other else key or "the text"
    for name in sorted({*one, *other}):
        inside = f"{key}.{name}" if key else str(name)
        if inside == "run.output":  # where to write is no part of what is written
            continue
        if (name in one) != (name in other):
            return inside
        found = first_difference(one[name], other[name], inside)
        if found is not None:
            return found
    return None


def _data(text: Any) -> Any:
    """What a scene says, apart from its comments; as it is, where it is neither TOML nor JSON."""
    if not isinstance(text, str):
        return text
    for read in (tomllib.loads, json.loads):
        try:
            return read(text)
        except (ValueError, TypeError, RecursionError):
            continue
    return text
