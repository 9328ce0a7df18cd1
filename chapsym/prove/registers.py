"""Registers: places of claims, such as that of chapsym, or a folder of the user.

A register is a folder of scripts, one script, or an importable package.  Its scripts are code, and finding its claims
runs them, as finding tests runs a folder of tests.
"""

import contextlib
import hashlib
import importlib
import importlib.util
import re
import sys
import traceback
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import partial, wraps
from graphlib import CycleError, TopologicalSorter
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType
from typing import Any, Concatenate, ParamSpec, TypeVar

from chapsym import sources

from .claims import Claim, TwoProofs
from .claims import register as registered

#: The file of a register with the list of generated kernels, without claims.
KERNELS = "kernels"

Given = ParamSpec("Given")
Found = TypeVar("Found")


class BrokenScript(ImportError):
    """A script cannot be loaded, or its claims contradict others; the message names the file."""


class NoRegister(ValueError):
    """A place without claims; the message gives the remedy."""


def _reading(
    method: "Callable[Concatenate[Register, Given], Found]",
) -> "Callable[Concatenate[Register, Given], Found]":
    """Turns the errors of the modules of a register into sentences."""

    @wraps(method)
    def read(self: "Register", *given: Given.args, **options: Given.kwargs) -> Found:
        try:
            return method(self, *given, **options)
        except (BrokenScript, NoRegister, KeyboardInterrupt):
            raise
        except BaseException as error:
            raise BrokenScript(f"{self.place} cannot be read as a register: {raised(error)}") from error

    return read


@dataclass(frozen=True)
class Register:
    """Claims in one place.

    The `__init__.py` of a package or a folder may define `SCRIPTS`, the names of the scripts in order (by default all
    files that end in .py and do not begin with _, except kernels.py); `CLAIMS`, the ids in order; `LEMMAS`, ids that
    are judged only when named; `PAPER`, the title of the paper; and `NOTE`, how to read its formulas.

    Parameters
    ----------
    place : str
        A folder with Python scripts, the path of one script, or the name of a package.
    package : bool, optional
        Whether `place` is a name of a package, even if a file or a folder has this name.

    Examples
    --------
    >>> from chapsym.prove import Register
    >>> Register("no-such-folder").load()
    Traceback (most recent call last):
    chapsym.prove.registers.NoRegister: there is no folder no-such-folder, and no package of that name; a register ...
    """

    place: str
    package: bool = False  # a name, even if a file or a folder has it

    @_reading
    def load(self, lemmas: bool = False) -> dict[str, Claim]:
        """Imports every script and returns the claims by id, in order.

        Parameters
        ----------
        lemmas : bool, optional
            Whether the lemmas follow.

        Returns
        -------
        dict of str to Claim

        Raises
        ------
        NoRegister
            If there is no such place, or it has no claims.
        BrokenScript
            If a script raises on import, or if an id is taken, or listed without a proof, or used and not judged.
        """
        head = self._head()
        for name in self._scripts(head):
            if sources.file(name) is None:
                missing = name.removeprefix(f"{head.__name__}.")
                raise BrokenScript(
                    f"{self.place} has no script file {missing!r}; SCRIPTS, where it is given, names them without .py"
                )
            _import(name)
        files = {sources.file(one) for name in self._scripts(head) for one in sources.closure(name, own=True)}
        found = {id: claim for id, claim in registered().items() if sources.file(claim.prove.__module__) in files}
        if not found:
            raise NoRegister(f"{self.place} has no claim: write @claim(id, formula) before a function of a Proof")
        others = _listed(head, "LEMMAS") or []
        listed = _listed(head, "CLAIMS")
        listed = [id for id in found if id not in others] if listed is None else listed
        if apart := sorted(found.keys() ^ {*listed, *others}):
            raise BrokenScript(f"{self.place}: the proofs and the list of claims and lemmas differ: {', '.join(apart)}")
        self._check(found)
        return {id: found[id] for id in (*listed, *(others if lemmas else ()))}

    @_reading
    def sections(self, claims: Iterable[Claim]) -> dict[str, tuple[int, str]]:
        """The script of each claim: its number, from 1, and the first line of its docstring."""
        files = [sources.file(name) for name in self._scripts(self._head())]
        found = {}
        for claim in claims:
            module = sys.modules[claim.prove.__module__]
            title = str(module.__doc__ or Path(str(module.__file__)).stem).strip().partition("\n")[0].rstrip(".")
            found[claim.id] = files.index(module.__file__) + 1 if module.__file__ in files else len(files) + 1, title
        return found

    @_reading
    def setting(self, name: str, default: str) -> str:
        """The value of a name in `__init__.py`: PAPER or NOTE."""
        return str(getattr(self._head(), name, default))

    @_reading
    def kernels(self) -> Any:
        """KERNELS of the module `kernels` next to the scripts, or None; raises BrokenScript as `load` does."""
        full = f"{self._head().__name__}.{KERNELS}"
        if sources.file(full) is None:
            return None
        _import(full)
        return getattr(sys.modules[full], "KERNELS", None)

    @property
    def folder(self) -> Path:
        """The folder of the scripts."""
        path = self._path()
        return (path if path.is_dir() else path.parent) if path else Path(next(iter(self._head().__path__)))

    def script(self, path: Path) -> str | None:
        """The module of a file, if it is one of the scripts."""
        names = self._scripts(self._head()) if path.exists() else []
        return next((name for name in names if (file := sources.file(name)) and path.samefile(file)), None)

    @property
    def key(self) -> str:
        """A short name that distinguishes this place from others."""
        path = self._path()
        digest = hashlib.sha256(str(path or self.place).encode()).hexdigest()[:8]
        return re.sub(r"\W", "_", path.stem if path else self.place) + f"_{digest}"

    def _path(self) -> Path | None:
        """The folder or the script; None for a package."""
        if self.package:
            return None
        try:
            path = Path(self.place).resolve()
            return path if path.exists() else None
        except (OSError, ValueError, RuntimeError):  # a name that no file can have, or circular links
            return None

    def _head(self) -> ModuleType:
        """The package of the scripts: that of this name, or a new one for the folder."""
        if (path := self._path()) is None:
            return self._package()
        if path.is_file() and path.suffix != ".py":
            raise NoRegister(f"{self.place} is no Python script; a register is a folder of scripts, or one")
        if (name := f"claims_of_{self.key}") not in sys.modules:
            folder, init = path if path.is_dir() else path.parent, path / "__init__.py"
            spec: ModuleSpec | None = ModuleSpec(name, None, is_package=True)
            if init.is_file():
                spec = importlib.util.spec_from_file_location(name, init)
            assert spec is not None
            spec.submodule_search_locations = [str(folder)]
            sys.modules[name] = module = importlib.util.module_from_spec(spec)
            if str(folder) not in sys.path:  # scripts may import from their folder, as when they run alone
                sys.path.append(str(folder))
            if spec.loader:
                _guarded(name, partial(spec.loader.exec_module, module))
        return sys.modules[name]

    def _package(self) -> ModuleType:
        names = self.place.split(".")
        spec = None
        if all(map(str.isidentifier, names)):
            with contextlib.suppress(ModuleNotFoundError, ValueError):  # for a module without a spec
                spec = importlib.util.find_spec(self.place)
        if spec is None or spec.submodule_search_locations is None:
            raise NoRegister(
                f"there is no folder {self.place}, and no package of that name; "
                "a register is a folder of Python scripts with claims"
            )
        _import(self.place)
        return sys.modules[self.place]

    def _scripts(self, head: ModuleType) -> list[str]:
        """The full names of the scripts."""
        path = self._path()
        if path is not None and path.is_file():
            return [f"{head.__name__}.{path.stem}"]
        if (names := _listed(head, "SCRIPTS")) is None:
            found = sorted(one for folder in head.__path__ for one in Path(folder).glob("[!_]*.py"))
            names = [one.stem for one in found if one.stem != KERNELS]
        return [f"{head.__name__}.{name}" for name in names]

    def _check(self, claims: dict[str, Claim]) -> None:
        """Raises BrokenScript if an id is one of chapsym's, or if a claim uses an id that nothing judges."""
        package = importlib.import_module(PROOFS.place)
        ours = {*package.CLAIMS, *package.LEMMAS}
        for id, claim in claims.items():
            if self != PROOFS and id in ours:
                raise _taken(claim.prove.__module__, id, "chapsym")
            if missing := [used for used in claim.uses if used not in claims and used not in ours]:
                path = self._path()
                alone = f"; the register {path.parent} would have its other scripts" if path and path.is_file() else ""
                said = f"{id} uses {missing[0]!r}, which no proof judges{alone}"
                raise BrokenScript(f"{_shown(claim.prove.__module__)}: {said}")
        try:
            TopologicalSorter({id: claim.uses for id, claim in claims.items()}).prepare()
        except CycleError as error:
            said = f"{min(error.args[1])} uses itself, directly or through others: uses goes in no circle"
            raise BrokenScript(f"{self.place}: {said}") from None


#: The claims of Fedorov's paper, and the lemmas of chapsym.
PROOFS = Register("chapsym.proofs", package=True)


def register_of(script: str) -> Register:
    """The register of a script: that of chapsym for its own scripts, and the script itself for any other."""
    return PROOFS if PROOFS.script(Path(script)) else Register(script)


def reached(id: str, claims: Mapping[str, Claim]) -> set[str]:
    """All claims that a claim uses, directly or through others."""
    found: set[str] = set()
    new = {id}
    while new := {used for one in new & claims.keys() for used in claims[one].uses} - found:
        found |= new
    return found


def load(lemmas: bool = False, register: Register = PROOFS) -> dict[str, Claim]:
    """The claims of a register by id, in order; by default of that of chapsym.

    Parameters
    ----------
    lemmas : bool, optional
        Whether the lemmas follow.
    register : Register, optional
        The register.

    Returns
    -------
    dict of str to Claim

    Raises
    ------
    NoRegister, BrokenScript
        As `Register.load` does.
    """
    return register.load(lemmas)


def _import(name: str) -> None:
    _guarded(name, partial(importlib.import_module, name))


def _guarded(name: str, run: Callable[[], object]) -> None:
    """Runs the import of a module, its output on standard error; an error becomes a sentence with the file."""
    try:
        with contextlib.redirect_stdout(sys.stderr):
            run()
    except TwoProofs as error:
        raise _taken(name, error.id, error.other) from error
    except (BrokenScript, KeyboardInterrupt):
        raise
    except BaseException as error:
        said = f"the proof script {_shown(name)} cannot be loaded: {_said(name, error)}"
        sys.modules.pop(name, None)  # half a module would be taken for the whole
        raise BrokenScript(said) from error


def _taken(name: str, id: str, other: str) -> BrokenScript:
    whose = "or install this checkout first (pip install -e .) if it is a script of chapsym; "
    return BrokenScript(
        f"{_shown(name)}: two proofs judge the claim {id}; give yours an id of its own, "
        f"{whose if 'chapsym' in other else ''}the other proof is in {other}"
    )


def raised(error: BaseException) -> str:
    """An error of foreign code, as one line."""
    try:
        words = " ".join(str(error).split())
    except Exception:  # which the error of an error may be
        words = "an error without words"
    return f"{type(error).__name__}: {words}"


def _said(name: str, error: BaseException) -> str:
    """The error, with the line of the script, or of a file next to it."""
    if isinstance(error, SystemExit):
        return "it leaves Python; what ends it, such as main(__file__), stands under if __name__ == '__main__'"
    said = raised(error)
    folder = Path(sources.file(name) or "").parent
    frames = [frame for frame in traceback.extract_tb(error.__traceback__) if Path(frame.filename).parent == folder]
    return f"{said} ({Path(frames[-1].filename).name}, line {frames[-1].lineno})" if frames else said


def _shown(name: str) -> str:
    """A script for a reader: its file, or its name if it is one of chapsym."""
    if name.startswith(f"{PROOFS.place}."):
        return name.removeprefix(f"{PROOFS.place}.")
    file = Path(sources.file(name) or name)
    return str(file.relative_to(Path.cwd()) if file.is_relative_to(Path.cwd()) else file)


def _listed(head: ModuleType, name: str) -> list[str] | None:
    """The list of scripts or claims in the package; None if it has none."""
    given = getattr(head, name, None)
    if given is not None and (not isinstance(given, list | tuple) or not all(isinstance(one, str) for one in given)):
        raise BrokenScript(f"{head.__file__}: {name} must be a list of texts")
    return None if given is None else [*given]
