"""What all tests share: the examples of Hypothesis, `--thorough`, the verdicts judged once, what was not run."""

import fcntl
import json
import os
import tempfile

import chromium
import pytest
from budget import EXAMPLES, THOROUGH
from hypothesis import HealthCheck, settings

#: The same examples everywhere; all that depends on CI or on the clock in Hypothesis's own profiles is set.
settings.register_profile(
    "same", max_examples=EXAMPLES, derandomize=True, database=None, deadline=None, print_blob=True,
    suppress_health_check=[HealthCheck.too_slow],
)  # fmt: skip
LARGE = f"random seeds, {THOROUGH} times the examples of each property, every slow cell of the extremes"
settings.register_profile("thorough", settings.get_profile("same"), max_examples=THOROUGH * EXAMPLES, derandomize=False)


def pytest_addoption(parser):
    parser.addoption("--thorough", action="store_true", help=LARGE)


def pytest_configure(config):
    settings.load_profile("thorough" if config.getoption("--thorough") else "same")


def pytest_terminal_summary(terminalreporter, config):
    if config.getoption("--thorough"):
        terminalreporter.write_line(f"thorough: {LARGE}")
    if left_out := chromium.left_out(terminalreporter.stats.get("skipped", [])):
        terminalreporter.write_line(left_out)


@pytest.fixture(scope="session")
def thorough(pytestconfig):
    """Whether the slow cells are wanted, too."""
    return pytestconfig.getoption("--thorough")


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
