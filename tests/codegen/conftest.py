"""What the tests of the generated code share."""

import shutil

import pytest
from committed import committed
from pendulum import CLAIMS, GROUPS, KERNELS, SOLVED

from chapsym.codegen import build


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
