"""python -m chapsym.certificates.rocq CERTIFICATE... DIR: with Python alone."""

import sys
from pathlib import Path

from . import write

if __name__ == "__main__":
    *certificates, folder = map(Path, sys.argv[1:])
    write(certificates, folder)
