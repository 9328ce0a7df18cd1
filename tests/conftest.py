import os
import tempfile

import pytest
from hypothesis import settings

settings.register_profile("ci", deadline=None, derandomize=True, max_examples=60)
settings.register_profile("dev", deadline=None, max_examples=200)
settings.load_profile("ci" if os.environ.get("CI") else "dev")

# The verdicts that the tests provoke are not the user's.
os.environ["CHAPSYM_RECORDS"] = os.path.join(tempfile.mkdtemp(prefix="chapsym-tests-"), "verdicts.jsonl")


@pytest.fixture(scope="session")
def records():
    """Every claim, judged once."""
    from chapsym.prove import load, prove_all

    return {record["id"]: record for record in prove_all(list(load()))}


@pytest.fixture(scope="session")
def lemmas():
    """Every lemma of chapsym's own, judged once."""
    import chapsym.proofs

    from chapsym.prove import prove_all

    return {record["id"]: record for record in prove_all(list(chapsym.proofs.LEMMAS))}
