"""Manifests: a manifest lists the certificates that a folder must have, so that a missing one is found.

{"format": ..., "kind": "manifest", "files": {"register/2.5.json": "2.5 <digest>", ...}, "digest": ...}; the paths are
relative to the folder of the manifest.  It lists all JSON files there except itself.
"""

from pathlib import Path

from .document import FORMAT, Data, check_names, digest, file_name
from .interval import Rejected

KIND = "manifest"


def made(names: dict[str, str]) -> Data:
    """The manifest of certificates; `names`: their names, by path."""
    data = {"format": FORMAT, "kind": KIND, "files": dict(sorted(names.items()))}
    return data | {"digest": digest(data)}


def listed(data: Data, folder: Path) -> dict[Path, str]:
    """The files of a manifest and their certificates' names; raises Rejected if the folder has other files."""
    check_names(data, ("format", "kind", "files", "digest"), "the manifest")
    names = data["files"]
    if data["format"] != FORMAT or data["kind"] != KIND or not isinstance(names, dict) or not names:
        raise Rejected(f"not a manifest of format {FORMAT}")
    if not all(isinstance(name, str) for name in names.values()) or data["digest"] != digest(data):
        raise Rejected("the digest is not that of the manifest: something in it was changed")
    if len({path.casefold() for path in names}) < len(names):
        raise Rejected("two files of the manifest have names that differ in case alone")
    there = {path.relative_to(folder).as_posix() for path in folder.rglob("*.json")} - {f"{KIND}.json"}
    if missing := sorted(names.keys() - there):
        raise Rejected(f"{missing[0]} is missing, which the manifest lists")
    if more := sorted(there - names.keys()):
        raise Rejected(f"{more[0]} is there, and the manifest does not list it")
    for path, name in names.items():
        if " " in name and Path(path).name != file_name(name.partition(" ")[0]):
            raise Rejected(f"{path} has not the name of its claim, {name.partition(' ')[0]}")
    return {folder / path: name for path, name in names.items()}
