"""Writes the package's source into a folder, from the data and from what `chapsym judge` computes with."""

import shutil
import sys
import tomllib
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parents[2]
#: The files that are copied, and what they import instead of chapsym.
COPIED = ("chapsym/studies/judge.py", "chapsym/studies/judge_tables.py", "chapsym/files.py", "generated/rotation.py")
OWN = {
    "from chapsym.dynamics.errors import BadInput": "from .errors import BadInput",
    "from chapsym import generated": "from . import rotation as generated",
    "from chapsym import files": "from . import files",
}
ERRORS = '''"""What is wrong with a file, in one sentence."""


class BadInput(ValueError):
    """A file that cannot be judged."""
'''
PROJECT = """[build-system]
requires = ["setuptools>=77"]
build-backend = "setuptools.build_meta"

[project]
name = "chapsym-rolling"
version = "{version}"
description = "35 motions of rigid balls with 30 proved digits, to judge a physics engine by."
readme = "README.md"
license = "CC0-1.0 AND MIT"
requires-python = ">=3.11"
dependencies = ["numpy>=2.0"]

[project.entry-points.pytest11]
rolling = "chapsym_rolling.fixture"

[tool.setuptools.packages.find]
include = ["chapsym_rolling*"]

[tool.setuptools.package-data]
chapsym_rolling = ["data/*", "py.typed"]
"""


def write(folder: Path) -> None:
    """The source of the package, which `python -m build` makes a wheel of."""
    package = folder / "chapsym_rolling"
    shutil.copytree(HERE.parent / "data", package / "data", ignore=shutil.ignore_patterns("*.csv"))
    for name in ("package.py", "fixture.py"):
        shutil.copy(HERE / name, package / name.replace("package", "__init__"))
    for name in COPIED:
        text = (ROOT / name).read_text(encoding="utf-8")
        for theirs, own in OWN.items():
            text = text.replace(theirs, own)
        (package / Path(name).name).write_text(text, encoding="utf-8")
    (package / "errors.py").write_text(ERRORS, encoding="utf-8")
    (package / "py.typed").touch()
    version = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
    (folder / "pyproject.toml").write_text(PROJECT.format(version=version), encoding="utf-8")
    shutil.copy(HERE / "README.md", folder / "README.md")


if __name__ == "__main__":
    if len(sys.argv) != 2 or Path(sys.argv[1]).exists():
        sys.exit("python -m benchmarks.rolling.wheel FOLDER: writes the source of the package into a new folder")
    write(Path(sys.argv[1]))
