"""python -m rocq CERTIFICATES DIR, next to this folder: with Python alone, from the certificates in a folder."""

import json
import sys
from pathlib import Path

from . import write


def main(certificates: str, folder: str) -> None:
    """Writes the files of all certificates of claims, ID.json, in a folder."""
    files = sorted(Path(certificates).glob("*.json"))
    write((json.loads(file.read_text(encoding="utf-8")) for file in files), Path(folder))


if __name__ == "__main__":
    main(*sys.argv[1:])
