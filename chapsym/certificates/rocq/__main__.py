"""python -m chapsym.certificates.rocq CERTIFICATE... DIR: for accepted certificates, with Python alone."""

import sys
from pathlib import Path

from chapsym.checker import Rejected, Unreadable, check, read
from chapsym.files import CannotWrite

from . import KIND, Theorem, write


def main(*paths: str) -> str | None:
    """Writes the theorems of the certificates to the last folder; returns a sentence if one of them has none."""
    if len(paths) < 2:
        return "CERTIFICATE... DIR: name a certificate, and the folder for its theorem"
    *certificates, folder = map(Path, paths)
    texts = {}
    for path in certificates:
        try:
            data = read(path)
            if (kind := check(data).kind) != KIND:
                raise Rejected(f"only certificates of kind {KIND} are written for Rocq, and this is of kind {kind}")
            name = path.stem.replace("-", "_")
            texts[name] = str(Theorem(name, data))
        except (Rejected, Unreadable) as error:
            return f"{path.name}: {error}"
    try:
        write(texts, folder)
    except (OSError, CannotWrite) as error:
        return f"{folder} cannot be written: {getattr(error, 'strerror', error)}"
    return None


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
