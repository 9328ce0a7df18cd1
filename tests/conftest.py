import fcntl
import json
import os
import tempfile

import pytest
from hypothesis import settings

settings.register_profile("ci", deadline=None, derandomize=True, max_examples=60)
settings.register_profile("dev", deadline=None, max_examples=200)
settings.load_profile("ci" if os.environ.get("CI") else "dev")

# The verdicts that the tests provoke are not the user's.
os.environ["CHAPSYM_RECORDS"] = os.path.join(tempfile.mkdtemp(prefix="chapsym-tests-"), "verdicts.jsonl")


def judged(ids, name, tmp_path_factory):
    """The records of claims by id, judged once for all processes of a test run: the first does, the others wait."""
    from chapsym.prove import prove_all

    folder = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        folder = folder.parent  # that of the whole run
    kept = folder / f"{name}.json"
    with open(folder / f"{name}.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not kept.exists():
            kept.write_text(json.dumps(prove_all(list(ids))), encoding="utf-8")
    return {record["id"]: record for record in json.loads(kept.read_text(encoding="utf-8"))}


@pytest.fixture(scope="session")
def records(tmp_path_factory):
    """Every claim, judged once."""
    from chapsym.prove import load

    return judged(load(), "records", tmp_path_factory)


@pytest.fixture(scope="session")
def lemmas(tmp_path_factory):
    """Every lemma of chapsym's own, judged once."""
    import chapsym.proofs

    return judged(chapsym.proofs.LEMMAS, "lemmas", tmp_path_factory)
