"""python -m chapsym.certificates.rocq CERTIFICATE... DIR: with Python alone, of what the checker accepts."""

import sys
from pathlib import Path

from chapsym.checker import Rejected, Unreadable, check, read

from . import KIND, write


def main(*paths: str) -> str | None:
    """Writes the theorems of the certificates to the last folder; returns a sentence if one of them has none."""
    *certificates, folder = map(Path, paths)
    accepted = {}
    for path in certificates:
        try:
            data = read(path)
            kind = check(data).kind
        except (Rejected, Unreadable) as error:
            return f"{path.name}: {error}"
        if kind != KIND:
            return f"{path.name}: only certificates of kind {KIND} are written for Rocq, and this is of kind {kind}"
        accepted[path.stem.replace("-", "_")] = data
    write(accepted, folder)
    return None


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
