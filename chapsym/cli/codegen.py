"""chapsym codegen: generate the kernels, or check them."""

from typing import Annotated, Any

import typer

from .app import app
from .options import Json
from .output import fail, print_json
from .prove import all_claims, kept_records, records_of


@app.command()
def codegen(
    check: Annotated[bool, typer.Option("--check", help="Compare with a fresh build; write nothing.")] = False,
    trust: Annotated[
        list[str] | None,
        typer.Option(metavar="KERNEL", help="Accept the new value of a kernel (or 'all') as its fingerprint."),
    ] = None,
    as_json: Json = False,
) -> None:
    """Generate the kernels from the proved expressions, or check that they are what is derived.

    Example: chapsym codegen --check
    """
    from chapsym.codegen import build

    place = build.folder()
    if check:
        if trust:
            fail("--trust writes fingerprints, so it does not go with --check", 2)
        problems = _unproved(build.KERNELS)
        try:
            problems += build.check(place)
        except Exception as error:  # whatever a broken derivation does
            problems.append(f"the derivation fails: {type(error).__name__}: {error}")
        if as_json:
            print_json({"folder": str(place), "problems": problems, "kept": not problems})
        elif not problems:
            print(f"generated code is what is derived: {len(build.KERNELS)} kernels, bytes and values")
        if problems:
            fail("; ".join(problems) + f". To mend: {build.MEND}", 1)
        return
    if not build.is_checkout(place):
        fail("this chapsym is an installed copy: generate in a source checkout; here only --check applies", 2)
    try:
        build.check_names(trust or [])
    except ValueError as error:
        fail(str(error), 2)
    unproved = _unproved(build.KERNELS)
    if unproved:
        fail("; ".join(unproved), 1)
    try:
        written = build.generate(place, trust or [])
    except (ValueError, ArithmeticError) as error:
        fail(str(error), 1)
    except OSError as error:
        fail(f"{place} cannot be written: {error.strerror or error}", 2)
    if as_json:
        print_json({"folder": str(place), "written": written})
    else:
        print(f"wrote {len(written)} files into {place.name}/")


def _unproved(kernels: Any) -> list[str]:
    """The claims that kernels name as their proof and that are not proved, one sentence each; fresh records count."""
    named = {id: kernel.name for kernel in kernels for id in kernel.claims}
    claims = all_claims(lemmas=True)
    missing = [
        f"{kernel} names the claim {id}, which no proof judges" for id, kernel in named.items() if id not in claims
    ]
    records = records_of({id: claim for id, claim in claims.items() if id in named}, kept_records(None))
    failed = [record["id"] for record in records if record["verdict"] == "open"]
    return missing + [f"{named[id]} comes from the claim {id}, which is not proved" for id in failed]
