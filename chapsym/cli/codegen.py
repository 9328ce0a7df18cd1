"""chapsym codegen: generate the kernels of a register, or check them."""

from pathlib import Path
from typing import Annotated

import typer

from .app import app
from .options import Json, Own, takes
from .output import fail, print_json, put
from .prove import reading, register_from


@app.command()
def codegen(
    check: Annotated[bool, typer.Option("--check", help="Compare with a fresh build; write nothing.")] = False,
    trust: Annotated[
        list[str] | None, takes("KERNEL", "Accept the new value of a kernel (or 'all') as its fingerprint.")
    ] = None,
    own: Own = None,
    as_json: Json = False,
) -> None:
    """Generate the kernels from the proved expressions, or check that they are what is derived.

    A kernel is refused unless its text computes what the statements that carry it say, in claims that are proved anew.
    Those of a register of your own are listed in FOLDER/kernels.py, and written into FOLDER/generated.

    Example: chapsym codegen --check
    """
    from chapsym.codegen import build

    with reading():
        package = build.Package(register_from(own)) if own else build.ours()
    place = package.place
    if check:
        if trust:
            fail("--trust writes fingerprints, so it does not go with --check", 2)
        problems = package.unproved()
        try:
            problems += package.check(place) if not problems else []
        except Exception as error:  # whatever a broken derivation does
            problems.append(f"the derivation fails: {type(error).__name__}: {error}")
        if as_json:
            print_json({"folder": str(place), "problems": problems, "kept": not problems})
        elif not problems:
            print(f"generated code is what is derived: {len(package.kernels)} kernels, bytes and values; ", end="")
            print(f"{len(package.kernels)} of {len(package.kernels)} compute what their claims decided")
        if problems:
            fail("; ".join(problems) + f". To mend: {package.mend}", 1)
        return
    if package.is_ours and not build.is_checkout(place):
        fail("this chapsym is an installed copy: generate in a source checkout; here only --check applies", 2)
    if package.is_ours and not Path.cwd().is_relative_to(place.parent):
        fail(f"the kernels of {place.parent} would be written anew: run it from there; here only --check applies", 2)
    try:
        package.check_names(trust or [])
    except ValueError as error:
        fail(str(error), 2)
    if unproved := package.unproved():
        fail("; ".join(unproved), 1)
    try:
        written = package.generate(place, trust or [])
    except (ValueError, ArithmeticError) as error:
        fail(str(error), 1)
    if as_json:
        print_json({"folder": str(place), "written": written})
    else:
        seen = place.relative_to(Path.cwd()) if place.is_relative_to(Path.cwd()) else place
        put(f"wrote {len(written)} files into {seen}/")
