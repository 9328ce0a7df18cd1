"""Claims as their certificates have them, where no test proves them anew."""

from pathlib import Path
from typing import NamedTuple

from chapsym import checker
from chapsym.codegen import build
from chapsym.prove import Verdict


class Committed(NamedTuple):
    """What a kernel needs of a claim that is proved."""

    certificate: dict
    verdict: Verdict = Verdict.HOLDS


def committed():
    """The claims by the certificates that are committed: other tests prove them, and compare these."""
    files = (Path(build.__file__).parents[2] / "proofs/certificates/register").glob("*.json")
    return {data["claim"]: Committed(data) for data in map(checker.read, files)}
