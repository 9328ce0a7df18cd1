"""What all tests share: the examples of Hypothesis, `--thorough`, the verdicts judged once, what was not run."""

import fcntl
import gc
import json
import os
import pickle
import shutil
import sys
import tempfile
from types import SimpleNamespace

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
    "claims, more processes, scenes and states"
)
settings.register_profile("thorough", settings.get_profile("same"), max_examples=THOROUGH * EXAMPLES, derandomize=False)


def pytest_addoption(parser):
    parser.addoption("--thorough", action="store_true", help=LARGE)


def pytest_configure(config):
    settings.load_profile("thorough" if config.getoption("--thorough") else "same")
    config.addinivalue_line("markers", "thorough: slow, and quicker ones see most of it: with --thorough only")


def pytest_collection_modifyitems(config, items):
    """One test that needs all verdicts comes first and the others last, so that no process waits for them meanwhile.

    Those that wait for a browser come early, while other jobs of CI take the processor.
    """
    needing = [item for item in items if "all_judged" in item.fixturenames]

    def turn(item):
        return 3 if "all_judged" in item.fixturenames else 1 if "launch" in item.fixturenames else 2

    items.sort(key=lambda item: 0 if item in needing[:1] else turn(item))
    if not config.getoption("--thorough"):
        config.hook.pytest_deselected(items=[item for item in items if item.get_closest_marker("thorough")])
        items[:] = [item for item in items if not item.get_closest_marker("thorough")]


def pytest_collection_finish(session):
    """What is imported and collected stays: the collector of garbage need not go through it again and again."""
    gc.set_threshold(100_000, 50, 100)
    gc.freeze()


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
OWN = tempfile.mkdtemp(prefix="chapsym-tests-")
os.environ["CHAPSYM_RECORDS"] = os.path.join(OWN, "verdicts.jsonl")


def pytest_unconfigure():
    shutil.rmtree(OWN, ignore_errors=True)


def kept_for_chapsym(cached):
    """The same function, which remembers what it said of chapsym's modules only: another test has another ring.py."""
    return lambda name: (cached if name.startswith("chapsym.") else cached.__wrapped__)(name)


@pytest.fixture
def forgotten(tmp_path, monkeypatch):
    """What a test loads of a register of one's own is forgotten after it."""
    from chapsym import sources
    from chapsym.prove import claims, load, records

    load(lemmas=True)
    monkeypatch.setattr(claims, "_REGISTER", claims.register())
    monkeypatch.setattr(sys, "path", [*sys.path])
    before = set(sys.modules)
    for module, name in ((sources, "file"), (sources, "imports"), (records, "_of_module")):
        monkeypatch.setattr(module, name, kept_for_chapsym(getattr(module, name)))
    yield
    for name in set(sys.modules) - before:
        file = getattr(sys.modules[name], "__file__", None) or ""
        if name.startswith("claims_of_") or str(tmp_path.parent) in file:
            del sys.modules[name]


@pytest.fixture(scope="session")
def made_once(tmp_path_factory):
    """What `made` returns, made once for all processes of a run: the first makes it, the others wait."""
    folder = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        folder = folder.parent  # that of the whole run

    def kept(name, made):
        file = folder / f"{name}.pickle"
        with open(folder / f"{name}.lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if not file.exists():
                file.write_bytes(pickle.dumps(made()))
        return pickle.loads(file.read_bytes())

    return kept


@pytest.fixture(scope="session")
def all_judged(made_once, tmp_path_factory):
    """Every claim and every lemma, judged once in one process, where none is judged again for those that rest on it.

    records: and the texts of the certificates, by id.  rests: that the lemmas of the two questions are proved, as the
    questions rest on it.  checked: what the checker said of the certificates that the proofs put before it, by digest.
    """
    from chapsym import checker
    from chapsym.proofs.open import energy, measure
    from chapsym.prove import claims, load
    from chapsym.prove.runner import prove_one

    def made():
        folder, check = tmp_path_factory.mktemp("certificates"), checker.check
        found = SimpleNamespace(records={}, rests={}, checked={})

        def checked(data):
            verdict = check(data)
            found.checked[verdict.name] = verdict
            return verdict

        with pytest.MonkeyPatch.context() as patch, claims.once():
            patch.setattr(checker, "check", checked)
            for id in load(lemmas=True):
                record = prove_one(id, folder)
                found.records[id] = record, (folder / checker.file_name(id)).read_text("utf-8")
            found.rests = {id: claims.judged(id) for id in {**measure.LEMMAS, **energy.LEMMAS}}
        return found

    return made_once("judged", made)


@pytest.fixture(scope="session")
def judged(all_judged):
    """The record of every claim and every lemma and the text of its certificate, by id."""
    return json.loads(json.dumps(all_judged.records))


@pytest.fixture
def plain():
    """The test is in plain Python."""
    from plain import in_plain_python

    with in_plain_python():
        yield


@pytest.fixture(params=["compiled", "plain"])
def way(request):
    """The test is in C, and then in Python."""
    if request.param == "plain":
        request.getfixturevalue("plain")


@pytest.fixture
def uncertified(monkeypatch):
    """Claims are judged without the certificates, which take as long as the proofs."""
    from chapsym.prove import Judgement

    monkeypatch.setattr(Judgement, "certified", lambda self: self)


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
