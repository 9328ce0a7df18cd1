"""Claims as their certificates have them, where no test proves them anew."""

from functools import cache
from pathlib import Path
from typing import NamedTuple

from chapsym import checker
from chapsym.codegen import build
from chapsym.prove import Verdict


class Committed(NamedTuple):
    """What a kernel needs of a claim that is proved."""

    certificate: dict
    verdict: Verdict = Verdict.HOLDS


@cache
def register():
    """The certificates of the register by the names of their files, read once and not to be changed."""
    files = sorted((Path(build.__file__).parents[2] / "proofs/certificates/register").glob("*.json"))
    return {file.name: checker.read(file) for file in files}


def committed():
    """The claims by the certificates that are committed: other tests prove them, and compare these."""
    return {data["claim"]: Committed(data) for data in register().values()}
