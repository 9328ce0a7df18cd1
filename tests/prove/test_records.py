"""Verdict records: fresh while nothing they depend on has changed, written whole, never silently lost."""

import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from threading import Thread

import pytest
from commands import TWO, answer, changed, chapsym, child, refused

from chapsym import files, prove, sources
from chapsym.cli import prove as command
from chapsym.prove import PROOFS, load, records


@pytest.fixture
def fresh_cache(monkeypatch):
    yield
    monkeypatch.undo()
    for cached in (records._of_module, sources.imports, sources.file):
        cached.cache_clear()


@pytest.fixture
def path(tmp_path):
    return tmp_path / "verdicts.jsonl"


def made(id, **changes):
    evidence = {"title": "T.", "open_in_paper": False, "fingerprint": records.fingerprint(load()[id])}
    record = {"id": id, "verdict": "holds", "printed": "x", "corrected": None, "seconds": 0.1, "evidence": evidence}
    return record | changes


def written(path):
    """The records of a file, line by line."""
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]


def test_records_survive_a_round_trip_in_the_order_of_the_paper(tmp_path):
    path, claims = tmp_path / "new" / "verdicts.jsonl", load()
    records.update(path, [made("prop-4"), made("2.1")], claims)
    records.update(path, [made("4.1", verdict="corrected"), made("2.1")], claims)
    assert list(records.read(path)) == ["2.1", "4.1", "prop-4"]
    assert [kept["id"] for kept in written(path)] == ["2.1", "4.1", "prop-4"]
    assert [file.name for file in path.parent.iterdir()] == ["verdicts.jsonl"]


def test_a_changed_derivation_makes_stale_what_imports_it_and_another_library_every_record(monkeypatch, fresh_cache):
    kept = {id: made(id) for id in ("2.1", "5.16", "prop-2")}
    claims = load()
    assert records.stale(kept, claims) == []
    honest = sources.source

    def changed(module):
        return honest(module) + ("# changed" if module == "chapsym.derive.elliptic" else "")

    monkeypatch.setattr(sources, "source", changed)
    records._of_module.cache_clear()
    assert records.stale(kept, claims) == ["5.16"]
    monkeypatch.setattr("importlib.metadata.version", lambda name: "0.0")
    records._of_module.cache_clear()
    assert records.stale(kept, claims) == ["2.1", "5.16", "prop-2"]


def test_the_closure_of_a_script_is_what_it_can_reach():
    reached = sources.closure("chapsym.proofs.paper.s5_increment")
    assert {"chapsym.proofs.paper.s5_elliptic", "chapsym.derive.elliptic", "chapsym.prove.evidence"} <= reached
    assert not {name for name in reached if name.startswith(("chapsym.dynamics", "chapsym.cli"))}


def test_a_broken_file_is_named_with_its_line(path):
    first = json.dumps(made("2.1"))
    for second in ('{"id"', "[]", "7", '{"id": "4.1"}', json.dumps(made("4.1", evidence=[]))):
        path.write_text(f"{first}\n{second}\n", encoding="utf-8")
        with pytest.raises(records.BrokenRecords, match="line 2 of"):
            records.read(path)
    assert "line 2 of" in refused("prove", "prop-2", "--records", path)
    assert path.read_text(encoding="utf-8").startswith(first)


def test_a_binary_file_or_a_pipe_is_no_file_of_records(path, tmp_path):
    path.write_bytes(b"\xc1\xff\n")
    with pytest.raises(records.BrokenRecords, match=r"verdicts\.jsonl is not a file of verdict records"):
        records.read(path)
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(records.BrokenRecords, match="a device or a pipe"):
        records.read(tmp_path / "pipe")


PLACES = """
import chapsym.rationals
class A:
    def f(self):
        if 1:
            from chapsym import files
        else:
            from chapsym.checker import branch
        for x in ():
            try:
                with open(x):
                    import chapsym.workers
            except ValueError:
                import chapsym.extras
            finally:
                import chapsym.jobs
        match x:
            case 1:
                import chapsym.sources
"""


def test_an_import_counts_wherever_it_stands(monkeypatch):
    monkeypatch.setattr(sources, "source", lambda module: PLACES)
    words = "rationals", "files", "checker", "checker.branch", "workers", "extras", "jobs", "sources"
    assert set(sources.imports.__wrapped__("chapsym.prove")) == {f"chapsym.{name}" for name in words}


def test_an_interrupt_keeps_what_was_finished(path, monkeypatch):
    def stopped(ids, jobs, arrived, honest=prove.prove_all, **_):
        honest(ids[:1], 1, arrived)
        raise KeyboardInterrupt

    monkeypatch.setattr(prove, "prove_all", stopped)
    assert chapsym("prove", "prop-2", "4.3", "--records", path).returncode == 130
    assert list(records.read(path)) == ["prop-2"]


def lost(how, id="4.3"):
    """A process that ends so, when it is to judge a claim."""
    return (
        "import os, chapsym.prove.runner as runner\nhonest = runner.judge\n"
        f"runner.judge = lambda claim: {how} if claim.id == '{id}' else honest(claim)"
    )


def test_what_was_judged_is_kept_when_the_command_is_killed(tmp_path, path):
    env = changed(tmp_path, lost("os.kill(os.getpid(), 9)"))
    records.update(path, [made("2.1")], load())
    with path.open("a") as stream:
        stream.write('{"id": "4.1", "verd')  # as another kill might have left it
    assert child("prove", "prop-2", "4.3", "--jobs", "1", "--records", path, env=env).returncode == -9
    assert list(records.read(path)) == ["2.1", "prop-2"]


def test_workers_end_with_the_process_that_started_them(tmp_path):
    """They hold the pipe open as long as they are there."""
    env = changed(
        tmp_path, "import os, time, chapsym.prove.runner as runner",
        "runner.judge = lambda claim: os.write(1, b'.') and time.sleep(3600)",
    )  # fmt: skip
    command = [sys.executable, "-m", "chapsym", "prove", *TWO, "--jobs", "2"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, env=env) as process:
        assert process.stdout.read(2) == b".."
        process.kill()
        with ThreadPoolExecutor() as pool:
            assert pool.submit(process.stdout.read).result(timeout=600) == b""


def test_of_two_that_write_at_once_both_keep_what_they_have(path, monkeypatch):
    whole, other = files.write_whole, Thread(target=records.update, args=(path, [made("4.3")], load()))

    def write(*arguments):
        if not other.ident:
            other.start()
            other.join(1.0)  # it waits for the end of the first
        whole(*arguments)

    monkeypatch.setattr(files, "write_whole", write)
    records.update(path, [made("2.1")], load())
    other.join()
    assert list(records.read(path)) == ["2.1", "4.3"]


def test_some_records_that_are_asked_for_leave_those_of_other_claims(path, monkeypatch):
    records.update(path, [made("2.1"), made("prop-4")], load())
    monkeypatch.setattr(
        "chapsym.prove.prove_all", lambda ids, jobs, arrived, **_: [arrived(x) or x for x in map(made, ids)]
    )
    asked = {id: load()[id] for id in ("4.3", "prop-4")}
    judged = command.records_of(asked, records.read(path), path, PROOFS)
    assert [record["id"] for record in judged] == ["4.3", "prop-4"]
    assert list(records.read(path)) == ["2.1", "4.3", "prop-4"]


def test_of_two_records_of_a_claim_the_last_one_counts(path):
    records.update(path, [made("2.1"), made("prop-4")], load())
    records.append(path, made("2.1", verdict="refuted"), load())
    assert records.read(path)["2.1"]["verdict"] == "refuted"
    records.update(path, [], load())
    assert [kept["verdict"] for kept in written(path)] == ["refuted", "holds"]


def test_an_interpreter_that_drops_docstrings_keeps_the_titles(monkeypatch):
    """As with PYTHONOPTIMIZE=2, for which SymPy would be compiled anew here."""
    claims = [load()[id] for id in ("2.1", "4.1")]
    titles = [claim.title for claim in claims]
    for claim in claims:
        monkeypatch.setattr(claim.prove, "__doc__", None)
    assert [claim.title for claim in claims] == titles


def test_a_lost_process_leaves_its_claims_open(tmp_path, monkeypatch, forgotten):
    for name, value in changed(tmp_path, lost("os._exit(9)", "s-2")).items():
        monkeypatch.setenv(name, value)
    done = chapsym("prove", *TWO, "--jobs", "2")
    assert done.returncode == 1
    assert "not judged: a process that ran proofs ended" in done.stdout
    assert "Traceback" not in done.stderr


def test_prove_keeps_the_verdict_and_says_when_it_changes(path):
    assert chapsym("prove", "prop-2", "--records", path).returncode == 0
    [line] = path.read_text(encoding="utf-8").splitlines()
    assert json.loads(line)["verdict"] == "holds"
    path.write_text(line.replace('"verdict": "holds"', '"verdict": "refuted"') + "\n", encoding="utf-8")
    done = chapsym("prove", "prop-2", "--records", path)
    assert "prop-2 was refuted, and is holds now" in done.stderr


def test_the_list_shows_what_is_on_record(path):
    old = made("4.1", evidence={"title": "T.", "open_in_paper": False, "fingerprint": "old"})
    records.update(path, [made("2.1"), old], load())
    rows = {row["id"]: row for row in answer("prove", "--list", "--records", path)["claims"]}
    assert (rows["2.1"]["verdict"], rows["2.1"]["stale"]) == ("holds", False)
    assert rows["4.1"]["stale"]
    assert rows["prop-4"]["verdict"] is None
    text = chapsym("prove", "--list", "--records", path).stdout
    assert "1 records are stale" in text or "1 record is stale" in text


def test_what_another_register_has_begun_meanwhile_is_kept_and_not_mixed(path):
    records.append(path, made("4.1"), load())
    before, mine = path.read_bytes(), {"2.1": load()["2.1"]}
    records.append(path, made("2.1"), mine)
    with pytest.raises(records.BrokenRecords, match=r"holds verdicts on other claims, such as 4\.1; give --records"):
        records.update(path, [made("2.1")], mine)
    assert path.read_bytes() == before


def test_of_a_record_for_which_there_is_no_room_nothing_is_kept(path):
    """A limit of the size of files, as a full disk: what is written is less than what is given."""
    resource = pytest.importorskip("resource")
    records.append(path, made("4.1"), load())
    before, limits = path.read_bytes(), resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (len(before) + 100, limits[1]))
    try:
        records.append(path, made("4.2", printed="x" * 200), load())
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert path.read_bytes() == before


def test_a_folder_that_cannot_be_written_costs_only_the_records(tmp_path):
    blocked = tmp_path / "file"
    blocked.write_text("", encoding="utf-8")
    done = chapsym("prove", "prop-2", "--records", blocked / "verdicts.jsonl")
    assert "Traceback" not in done.stderr
    assert done.returncode in (0, 2)
    assert "records" in done.stderr or "not kept" in done.stderr
