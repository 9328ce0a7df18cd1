"""Command line: python -m chapsym.checker FILE..., or python checker FILE... without installation; exit 0, 1 or 2."""

import argparse
import json
import os
import runpy
import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any, TextIO


def main(arguments: list[str] | None = None) -> int:
    """Checks files; returns 0 if all are accepted, 1 if one is rejected, 2 if one cannot be read."""
    from . import Rejected, Unreadable, claimed_twice, id_of, kernels, lacks, manifest, read, shown, standing

    parser = argparse.ArgumentParser(prog="checker", description="Checks certificates, with the standard library only.")
    parser.add_argument("files", nargs="*", metavar="FILE")
    parser.add_argument(
        "--manifest", metavar="FILE", help="all certificates that a manifest lists; none may be missing"
    )
    parser.add_argument("--show", action="store_true", help="the formulas that were judged, of a claim of the register")
    parser.add_argument(
        "--kernels", metavar="FOLDER", action="append", default=[],
        help="generated kernels, too: whether each text computes what the statements of FILEs that carry it say",
    )  # fmt: skip
    parser.add_argument("--json", action="store_true", help="one JSON object on standard output")
    options = parser.parse_args(arguments)
    expected: dict[str, str] = {}
    if options.manifest:
        try:
            data = read(options.manifest)
            listed = manifest.listed(data, Path(options.manifest).parent)
            if not options.json:
                _say(f"{options.manifest}: {len(listed)} certificates, digest {data['digest']}")
        except (Rejected, Unreadable) as error:
            return _refused(options.manifest, error)
        expected = {str(path): name for path, name in listed.items()}
    files = [*options.files, *expected]
    if not files:
        parser.error("name a FILE, or a --manifest")
    judged, whole = _judged(files)
    right = [verdict for verdict in judged.values() if not isinstance(verdict, Exception)]
    stand, twice = standing(right), claimed_twice(right)
    refuted = {verdict.name for verdict in right if verdict.refuted}
    found, worst = [], 0
    for file in files:
        verdict: Any = judged[file]
        if not isinstance(verdict, Exception) and verdict.name in twice:
            claim = id_of(verdict.name)
            verdict = Rejected(f"another of these files is of claim {claim}, too, and says something else")
        if not isinstance(verdict, Exception) and verdict.name != expected.get(file, verdict.name):
            verdict = Rejected("it is another certificate than the one that the manifest lists")
        if not isinstance(verdict, Exception) and (missing := lacks(verdict, stand, refuted)):
            verdict = Rejected(f"it rests on {missing[0]}, which is not accepted among these files")
        if isinstance(verdict, Exception):
            worst = max(worst, _refused(file, verdict))
            found.append({"file": file, "accepted": False, "reason": str(verdict)})
            continue
        found.append({"file": file, "accepted": True, **vars(verdict)})
        if not options.json:
            _say(f"{file}: accepted ({verdict.kind})", f"  Proved: {verdict.statement}")
            _say(*(f"  {name}: {value}" for name, value in verdict.numbers.items()))
            if options.show and verdict.kind == "register-claim":
                _say(*(f"  {line}" for line in shown.lines(whole[verdict.name])))
    accepted = {name: data for name, data in whole.items() if name in stand}
    bound = [one for folder in options.kernels for one in kernels.check_folder(Path(folder), accepted)]
    for one in bound:
        worst = worst if one["accepted"] else max(worst, 1)
        if not one["accepted"]:
            _say(f"{one['file']}: rejected: {one['reason']}", to=sys.stderr)
        elif not options.json:
            _say(f"{one['file']}: accepted (kernel)", f"  Takes: {', '.join(one['inputs'])}")
            _say(f"  Computes: {' / '.join(one['statements'])}")
    if options.json:
        utf = (sys.stdout.encoding or "").lower().startswith("utf")  # otherwise with escapes
        result = {"certificates": found} | ({"kernels": bound} if options.kernels else {})
        print(json.dumps(result, ensure_ascii=not utf, indent=1))
    return worst


def _refused(file: str, why: Exception) -> int:
    """Says why a file is not accepted; the exit status."""
    from . import Unreadable

    status, word = (2, "unreadable") if isinstance(why, Unreadable) else (1, "rejected")
    _say(f"{file}: {word}: {why}", to=sys.stderr)
    return status


def _say(*lines: str, to: TextIO | None = None) -> None:
    """Prints lines, with escapes for unprintable characters: a file's name can neither add a line nor hide one."""
    text = "\n".join("".join(x if x.isprintable() else repr(x)[1:-1] for x in line) for line in lines)
    try:
        print(text, file=to)
    except OSError:
        if to is None:
            raise
        _close(to)  # the status says it, too


def _close(stream: TextIO | None) -> None:
    """Lets nothing more be written to an output that refuses it."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), (stream or sys.stdout).fileno())


def _judged(files: list[str]) -> tuple[dict[str, Any], dict[str, Any]]:
    """The verdict, or the exception, for each file, and the accepted certificates by name.

    Certificates of used claims are looked up in the folders of the files, and checked, too.
    """
    from . import Rejected, Unreadable, check, file_name, read

    judged: dict[str, Any] = {}
    whole: dict[str, Any] = {}
    pending = list(files)
    for file in pending:  # the loop appends to the list
        if file in judged:
            continue
        try:
            data = read(file)
            judged[file] = verdict = check(data)
        except (Rejected, Unreadable) as error:
            judged[file] = error
            continue
        whole[verdict.name] = data
        known = {Path(one).name for one in pending}
        used = [Path(file).with_name(file_name(one)) for one in verdict.uses]
        pending += [str(path) for path in used if path.name not in known and path.is_file()]
    return judged, whole


if __name__ == "__main__":
    if not __package__:  # run as a folder: start again as a package, so that relative imports work
        folder = Path(__file__).resolve().parent  # by its path: no file next to the folder must shadow a module
        found = spec_from_file_location("checker", folder / "__init__.py", submodule_search_locations=[str(folder)])
        sys.modules["checker"] = package = module_from_spec(found)  # type: ignore[arg-type]
        found.loader.exec_module(package)  # type: ignore[union-attr]
        runpy.run_module("checker", run_name="__main__", alter_sys=True)
    else:
        for name in ("stdout", "stderr"):
            if getattr(sys, name) is None:  # closed by the caller
                setattr(sys, name, open(os.devnull, "w"))  # noqa: SIM115
            getattr(sys, name).reconfigure(errors="backslashreplace")  # for a terminal without Greek
        try:
            status = main()
            sys.stdout.flush()
        except BrokenPipeError:  # the reader of the output has gone
            _close(sys.stdout)
            status = 141
        except OSError as error:
            _say(f"standard output cannot be written: {error.strerror}", to=sys.stderr)
            _close(sys.stdout)
            status = 2
        except KeyboardInterrupt:
            status = 130
        sys.exit(status)
