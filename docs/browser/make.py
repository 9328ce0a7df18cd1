"""Writes what the page in the browser loads but for Pyodide: python docs/browser/make.py FOLDER."""

import json
import shutil
import sys
import zipfile
from pathlib import Path

import chapsym
from chapsym import files
from chapsym.checker import file_name
from chapsym.prove.claims import register
from chapsym.prove.registers import PROOFS, load
from chapsym.show.rolling.page import html

HERE = Path(__file__).parent
PACKAGE = Path(chapsym.__file__).parent
#: Of the package, what needs the standard library alone.
TAKEN = (
    "__init__.py", "checker/*.py", "generated/*.py", "proofs/manifest.json", "proofs/certificates/**/*.json",
    *(f"dynamics/loops/{name}.py" for name in ("__init__", "branch", "gibbs", "text", "vectors")),
)  # fmt: skip


def write(folder: Path) -> None:
    """The files of the page: Python in a zip file, the claims, the page on which the ball rolls, scripts."""
    folder.mkdir(parents=True, exist_ok=True)
    files.write_whole(folder / "chapsym.zip", _pack)
    load(PROOFS)
    claims = {id: one.title for id, one in register().items() if _certificate(id).exists()}
    files.write_text(folder / "claims.json", json.dumps(claims))
    ball = chapsym.Ball.from_inertia((0.006, 0.007, 0.009), mass=2.0, radius=0.1)
    example = chapsym.roll(ball, (3, -2, 1), 0.1, 1, contact=True, map=True).to_xarray()
    files.write_text(folder / "rolling.html", html(example.assign_attrs(title="Your ball")))
    for name in ("page.mjs", "worker.mjs"):
        shutil.copy(HERE / name, folder)


def _certificate(id: str) -> Path:
    return PACKAGE / "proofs" / "certificates" / "register" / file_name(id)


def _pack(stream) -> None:
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as packed:
        packed.write(HERE / "in_browser.py", "in_browser.py")
        packed.writestr("chapsym/dynamics/__init__.py", "")  # that of the package imports NumPy
        for path in sorted(path for pattern in TAKEN for path in PACKAGE.glob(pattern)):
            packed.write(path, Path("chapsym") / path.relative_to(PACKAGE))


if __name__ == "__main__":
    write(Path(sys.argv[1]))
