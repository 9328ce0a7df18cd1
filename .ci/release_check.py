"""Whether this checkout can be released; `make release-check` stops at the first thing that is missing."""

import os
import re
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).parents[1]


class NotReady(Exception):
    """What is missing, and what would be right."""


def clean(root: Path) -> str:
    """Nothing is changed, and nothing is there that git does not know."""
    status = subprocess.run(["git", "status", "--porcelain"], cwd=root, capture_output=True, text=True, check=False)
    if status.returncode != 0:
        raise NotReady(f"{root} is no git repository")
    if status.stdout:
        raise NotReady(f"{status.stdout.splitlines()[0][3:]} is not committed; commit it or take it away")
    return "the tree is clean"


def versions(root: Path) -> str:
    """One version everywhere, and one date."""
    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
    found = {
        "chapsym/__init__.py": _first(root / "chapsym" / "__init__.py", r'^__version__ = "(.*)"$'),
        "CITATION.cff": _first(root / "CITATION.cff", r"^version: (.*)$"),
        "CHANGELOG.md": _first(root / "CHANGELOG.md", r"^## \[(\d.*?)\]"),
    }
    for name, version in found.items():
        if version != project:
            raise NotReady(f"{name} has the version {version}, pyproject.toml has {project}; make them one")
    date = _first(root / "CHANGELOG.md", rf"^## \[{re.escape(project)}\] - (\d{{4}}-\d\d-\d\d)$")
    if date is None:
        raise NotReady(f"CHANGELOG.md has no date for {project}; write ## [{project}] - YEAR-MONTH-DAY")
    if _first(root / "CITATION.cff", r"^date-released: (.*)$") != date:
        raise NotReady(f"CITATION.cff has not the date of CHANGELOG.md; write date-released: {date}")
    return f"version {project} of {date}, in all four files"


def _first(path: Path, pattern: str) -> str | None:
    found = re.search(pattern, path.read_text(encoding="utf-8"), re.MULTILINE)
    return found.group(1) if found else None


def errata(root: Path) -> str:
    """The lists of errata are what the proofs give now."""
    with tempfile.TemporaryDirectory() as folder:
        for suffix in (".md", ".tex", ".json"):
            kept = (root / "docs" / "errata").with_suffix(suffix)
            new = Path(folder) / kept.name
            new.write_bytes(kept.read_bytes())  # the states of earlier releases are in the file
            _run("the errata", root, sys.executable, "-m", "chapsym", "report", "-o", str(new))
            if new.read_bytes() != kept.read_bytes():
                raise NotReady(f"docs/{kept.name} is not what the proofs give; run chapsym report -o docs/{kept.name}")
    return "the errata are fresh"


def packages(root: Path) -> str:
    """What is built is well described, and the wheel works in an environment of its own."""
    with tempfile.TemporaryDirectory() as folder:
        _run("the build", root, sys.executable, "-m", "build", "--outdir", folder, str(root))
        built = sorted(str(path) for path in Path(folder).iterdir())
        _run("twine check", root, sys.executable, "-m", "twine", "check", "--strict", *built)
        wheel = next(name for name in built if name.endswith(".whl"))
        _run("a new environment", root, sys.executable, "-m", "venv", f"{folder}/elsewhere")
        python = f"{folder}/elsewhere/bin/python"
        constraints = str(root / "constraints.txt")
        _run("the installed wheel", root, python, "-m", "pip", "install", "--quiet", "-c", constraints, wheel)
        for command in ("codegen --check", "prove prop-4"):
            _run("the installed wheel", Path(folder), python, "-m", "chapsym", *command.split())
    return f"built, checked and installed: {', '.join(Path(name).name for name in built)}"


def _run(what: str, folder: Path, *command: str) -> None:
    """Runs a command; what it says last goes into the sentence if it fails."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        said = (done.stderr.strip() or done.stdout.strip() or "it says nothing").splitlines()[-1]
        raise NotReady(f"{what} failed: {said}")


CHECKS: tuple[Callable[[Path], str], ...] = (clean, versions, errata, packages)


def main(root: Path = ROOT) -> int:
    """Every check in turn; 1 with a sentence at the first that fails."""
    for check in CHECKS:
        try:
            print(f"✓ {check(root)}", flush=True)
        except NotReady as reason:
            print(f"not ready: {reason}", file=sys.stderr)
            return 1
    print("ready to be released")
    return 0


if __name__ == "__main__":
    sys.exit(main())
