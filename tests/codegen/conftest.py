"""What the tests of the generated code share."""

import shutil
from pathlib import Path
from typing import NamedTuple

import pytest
from pendulum import CLAIMS, GROUPS, KERNELS, SOLVED

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


@pytest.fixture
def register(tmp_path, request):
    """Writes the register of the pendulum; each test has ids of its own, as one process knows an id once."""
    identity = "own-" + "".join(filter(str.isalnum, request.node.name))[-24:]

    def write(carrier=SOLVED, groups=GROUPS, expression="pull()", claims=CLAIMS, kernels=KERNELS):
        folder = tmp_path / "pendulum"
        folder.mkdir(exist_ok=True)
        (folder / "claims.py").write_text(claims.replace("{id}", identity), encoding="utf-8")
        carrier = carrier.format(id=identity)
        (folder / "kernels.py").write_text(
            kernels.format(carrier=carrier, groups=groups, expression=expression), encoding="utf-8"
        )
        return folder

    return write
