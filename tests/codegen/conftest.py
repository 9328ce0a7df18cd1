"""What the tests of the generated code share."""

import shutil

import pytest

from chapsym.codegen import build


@pytest.fixture
def copy(tmp_path):
    """A copy of what is committed."""
    place = tmp_path / "generated"
    shutil.copytree(build.folder(), place, ignore=shutil.ignore_patterns("__pycache__"))
    return place
