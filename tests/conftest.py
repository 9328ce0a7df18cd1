import os

import pytest
from hypothesis import settings

settings.register_profile("ci", deadline=None, derandomize=True, max_examples=60)
settings.register_profile("dev", deadline=None, max_examples=200)
settings.load_profile("ci" if os.environ.get("CI") else "dev")


@pytest.fixture(scope="session")
def records():
    """Every claim, judged once."""
    from chapsym.prove import load, prove_all

    return {record["id"]: record for record in prove_all(list(load()))}
