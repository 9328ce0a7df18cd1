"""What the tests of the generated code share."""

import shutil
from pathlib import Path
from typing import NamedTuple

import pytest

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


@pytest.fixture(autouse=True, scope="session")
def proved():
    """The kernels of the ball are generated from these, where no test proves the claims anew."""
    build.ours().__dict__.setdefault("judged", committed())


@pytest.fixture
def copy(tmp_path):
    """A copy of what is committed."""
    place = tmp_path / "generated"
    shutil.copytree(build.folder(), place, ignore=shutil.ignore_patterns("__pycache__"))
    return place
