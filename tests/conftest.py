"""What all tests share: the examples of Hypothesis, `--thorough`, the verdicts judged once, what was not run."""

import fcntl
import json
import os
import tempfile
from dataclasses import asdict

import chromium
import pytest
from budget import EXAMPLES, THOROUGH
from hypothesis import HealthCheck, settings

#: The same examples everywhere; all that depends on CI or on the clock in Hypothesis's own profiles is set.
settings.register_profile(
    "same", max_examples=EXAMPLES, derandomize=True, database=None, deadline=None, print_blob=True,
    suppress_health_check=[HealthCheck.too_slow],
)  # fmt: skip
LARGE = (
    f"random seeds, {THOROUGH} times the examples of each property, slow cells of the extremes, slips judged by more "
    "claims, more processes, more scenes"
)
settings.register_profile("thorough", settings.get_profile("same"), max_examples=THOROUGH * EXAMPLES, derandomize=False)


def pytest_addoption(parser):
    parser.addoption("--thorough", action="store_true", help=LARGE)


def pytest_configure(config):
    settings.load_profile("thorough" if config.getoption("--thorough") else "same")
    config.addinivalue_line("markers", "thorough: slow, and quicker ones see most of it: with --thorough only")


def pytest_collection_modifyitems(config, items):
    if not config.getoption("--thorough"):
        config.hook.pytest_deselected(items=[item for item in items if item.get_closest_marker("thorough")])
        items[:] = [item for item in items if not item.get_closest_marker("thorough")]


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


def once(name, made, tmp_path_factory):
    """What `made` returns, as plain data, made once for all processes of a run: the first makes it, the others wait."""
    folder = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        folder = folder.parent  # that of the whole run
    kept = folder / f"{name}.json"
    with open(folder / f"{name}.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not kept.exists():
            kept.write_text(json.dumps(made()), encoding="utf-8")
    return json.loads(kept.read_text(encoding="utf-8"))


@pytest.fixture(scope="session")
def judged(tmp_path_factory):
    """Every claim and every lemma, judged once: the records and the texts of the certificates, by id."""
    from chapsym.prove import load, prove_all

    def made():
        folder = tmp_path_factory.mktemp("certificates")
        records = prove_all(list(load(lemmas=True)), folder=folder)
        return [[record, (folder / f"{record['id']}.json").read_text("utf-8")] for record in records]

    return {record["id"]: (record, text) for record, text in once("judged", made, tmp_path_factory)}


@pytest.fixture
def uncertified(monkeypatch):
    """Claims are judged without the certificates, which take as long as the proofs."""
    from chapsym.prove import Judgement

    monkeypatch.setattr(Judgement, "certified", lambda self: self)


@pytest.fixture(scope="session")
def checked(tmp_path_factory):
    """What the checker says of each certificate beside the register, by its digest; all are accepted."""
    from chapsym import checker
    from chapsym.proofs.open import certified

    def made():
        return [asdict(checker.check(checker.read(file))) for file in sorted(certified.FOLDER.glob("*.json"))]

    return {one["name"]: checker.Verdict(**one) for one in once("checked", made, tmp_path_factory)}


@pytest.fixture(scope="session")
def verdicts(judged):
    """The verdicts on every claim and every lemma, by id."""
    return {id: record for id, (record, _) in judged.items()}


@pytest.fixture(scope="session")
def records(verdicts):
    """The verdicts on the claims of the paper."""
    import chapsym.proofs

    return {id: verdicts[id] for id in chapsym.proofs.CLAIMS}


@pytest.fixture(scope="session")
def lemmas(verdicts):
    """The verdicts on chapsym's own lemmas."""
    import chapsym.proofs

    return {id: verdicts[id] for id in chapsym.proofs.LEMMAS}
