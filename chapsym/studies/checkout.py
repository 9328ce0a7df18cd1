"""The measurements of a checkout, `benchmarks` and `research`, and the machine on which they were made."""

import os
import platform
import re
import shutil
import subprocess
import sys
from collections.abc import Mapping
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from types import ModuleType

from chapsym.dynamics import BadInput
from chapsym.dynamics.levels.frames import cores
from chapsym.files import Data

#: The folder of `benchmarks` and `research`, if this is a checkout: the wheel has neither.
ROOT = Path(__file__).parents[2]
#: The packages whose versions belong to a measurement.
NAMED = ("chapsym", "numpy", "scipy", "heyoka")


def in_checkout(package: str, module: str) -> ModuleType:
    """A module of `benchmarks` or `research`; raises BadInput without these folders, and MissingExtra."""
    if not (ROOT / package / "__init__.py").is_file():
        raise BadInput(f"{package}/ is not in the wheel; run this from a checkout")
    sys.path.insert(0, str(ROOT))  # some wheels, such as that of pyarrow, have a package `benchmarks`
    try:
        return import_module(f"{package}.{module}")
    finally:
        sys.path.remove(str(ROOT))


def save_figures(package: str, drawn: Mapping[str, str], found: Data, folder: Path) -> list[Path]:
    """The figures of a study by the names of their files; raises CannotWrite if the folder cannot be written to.

    drawn: the function of each figure, "module:function", in a module of the package of the study.
    """
    from chapsym.show import figures
    from chapsym.show.drawing.style import styled

    for name, where in drawn.items():
        module, _, function = where.partition(":")
        with styled():
            figure = getattr(import_module(f"{package}.{module}"), function)(found)
        figures.save(figure, folder / name)
    return [folder / name for name in drawn]


def machine() -> Data:
    """The description of the machine for a measurement: the processor, its cores, the compiler, and the versions."""
    return {
        "cpu": _cpu(),
        "cores": cores(),
        "system": f"{platform.system()} {platform.machine()}",
        "compiler": _compiler_version(),
        "python": f"{platform.python_implementation()} {platform.python_version()}",
        "versions": {name: _version(name) for name in NAMED},
    }


def _cpu() -> str:
    try:
        text = Path("/proc/cpuinfo").read_text()
        fields = dict(re.findall(r"^(model name|cpu family|model|stepping)\s*: (.*)$", text, re.MULTILINE))
    except OSError:
        return platform.processor() or "unknown"
    family = f"family {fields['cpu family']}, model {fields['model']}" if "cpu family" in fields else ""
    return ", ".join(x for x in (fields.get("model name") or platform.processor(), family) if x) or "unknown"


def _compiler_version() -> str:
    """The version of the C compiler: that of CC, or cc, gcc, clang."""
    wanted = os.environ.get("CC")
    path = next(filter(None, map(shutil.which, [wanted] if wanted else ["cc", "gcc", "clang"])), None)
    if path is None:
        return "none"
    done = subprocess.run([path, "--version"], capture_output=True, text=True, check=False)
    return (done.stdout.splitlines() or [path])[0]


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "not installed"
