"""Units of a study: kept as they are done, gone on with after a kill, the same on a cluster."""

import json
import signal
import subprocess
import sys

import distributed
import pytest
from budget import slow
from waiting import GUARD, INTERRUPTIBLE, until

from chapsym import sources
from chapsym.dynamics import BadInput
from chapsym.files import CannotWrite
from chapsym.studies import checkout
from research import chaos, energy
from research import units as units_module
from research.units import Unit, run_units


def units(count=4):
    return [Unit("builtins:dict", {"n": i}) for i in range(count)]


def test_results_are_in_the_order_of_the_units(tmp_path):
    seen = []
    found = run_units(units(), tmp_path / "u.jsonl", report=lambda done, of: seen.append((done, of)))
    assert found == [{"n": i} for i in range(4)]
    assert seen == [(i, 4) for i in range(5)]


def test_what_is_kept_is_not_computed_again_and_a_line_that_was_cut_off_is(tmp_path, monkeypatch):
    monkeypatch.setattr(units_module, "cores", lambda: 1)  # no process begins
    path = tmp_path / "u.jsonl"
    run_units(units(), path)
    text = path.read_text()
    path.write_text(text[:-9])
    assert run_units(units(), path) == [{"n": i} for i in range(4)]
    assert sorted(path.read_text().splitlines()) == sorted(text.splitlines())
    lines = path.read_text().splitlines()
    lines[1] = json.dumps(units_module._record(json.loads(lines[1])["key"], "kept"))
    path.write_text("\n".join(lines) + "\n")
    found = run_units(units(6), path)
    assert found.count("kept") == 1
    assert len(path.read_text().splitlines()) == 6


@pytest.mark.parametrize("changed", ["kept", "chapsym.numbers.pairs"])
def test_what_another_code_computed_is_computed_again(tmp_path, monkeypatch, changed):
    """The module itself, or one that is imported by what it imports inside of its function."""
    (tmp_path / "kept.py").write_text("def one():\n    from chapsym.dynamics import trajectory\n    return 1\n")
    monkeypatch.syspath_prepend(tmp_path)
    unit, path = Unit("kept:one"), tmp_path / "u.jsonl"
    assert run_units([unit], path) == run_units([unit], path) == [1]
    assert len(path.read_text().splitlines()) == 1
    real = sources.source
    with monkeypatch.context() as patched:
        patched.setattr(sources, "source", lambda name: real(name) + "# changed\n" * (name == changed))
        units_module._sources.cache_clear()
        assert run_units([unit], path) == [1]
    units_module._sources.cache_clear()
    assert len(path.read_text().splitlines()) == 2


def test_what_shows_a_result_is_no_part_of_it():
    reached = sources.closure("research.rotation.circle")
    assert {"chapsym.dynamics.levels.double", "chapsym.generated.gibbs_newton"} <= reached
    assert not {name.split(".")[1] for name in reached} & {"show", "cli", "report", "proofs", "prove"}


def test_another_process_must_have_the_same_sources(monkeypatch):
    unit = units(1)[0]
    assert units_module.compute(unit.function, unit.arguments, unit.key) == {"n": 0}
    with pytest.raises(BadInput, match="a worker has another chapsym"):
        units_module.compute(unit.function, unit.arguments, unit.key.replace("0.1.0", "0.0.9"))


def test_two_studies_do_not_write_one_file(tmp_path):
    path = tmp_path / "u.jsonl"
    with units_module._kept(path) as (_, keep):
        keep("a", 1)
        with pytest.raises(BadInput, match=r"u\.jsonl is being written by another process"):
            run_units(units(1), path)
    assert run_units(units(1), path) == [{"n": 0}]
    assert len(path.read_text().splitlines()) == 2


@pytest.mark.parametrize("line", ["first", "notes", "[" * 10**5, '{"key": "a", "result": 1}', "damaged"])
def test_a_file_of_something_else_is_refused_and_a_damaged_one(tmp_path, line):
    path = tmp_path / "u.jsonl"
    run_units(units(1), path)
    text = path.read_text().replace('"result": {"n": 0}', '"result": {"n": 1}')
    path.write_text(text if line == "damaged" else line if line == "notes" else f"{line}\n")
    before = path.read_text()
    with pytest.raises(BadInput, match=r"line 1 of .* is no result of a study, or is damaged; delete it, or name"):
        run_units(units(), path)
    assert path.read_text() == before


def test_a_device_is_no_file_of_results(tmp_path):
    (tmp_path / "u.jsonl").symlink_to("/dev/null")
    with pytest.raises(CannotWrite, match="it is a device or a pipe"):
        run_units(units(), tmp_path / "u.jsonl")


def test_a_unit_that_fails_is_named_and_the_others_are_kept(tmp_path):
    path = tmp_path / "u.jsonl"
    wrong = Unit("builtins:int", {"base": 40})
    with pytest.raises(BadInput, match=r"int\(base = 40\)"):
        run_units([*units(1), wrong], path)
    assert run_units(units(1), path) == [{"n": 0}]


@pytest.mark.parametrize("sent", [signal.SIGINT, *slow(signal.SIGKILL)])
def test_a_study_that_was_ended_goes_on_and_leaves_no_process(tmp_path, sent):
    """An interrupt does not wait for the units in flight, and of a parent that is killed no child lives on."""
    path, script = tmp_path / "u.jsonl", tmp_path / "run.py"
    script.write_text(
        INTERRUPTIBLE + "from research import units\nfrom pathlib import Path\nimport sys\n"
        "if __name__ == '__main__':\n"
        "    units.cores = lambda: 2\n"
        "    units.run_units([units.Unit('builtins:dict', {}), units.Unit('slow:wait')], Path(sys.argv[1]))\n"
    )
    (tmp_path / "slow.py").write_text(f"import time\n\ndef wait():\n    time.sleep({2 * GUARD})\n")
    process = subprocess.Popen([sys.executable, str(script), str(path)], stderr=subprocess.PIPE)
    until(lambda: path.exists() and path.read_text().endswith("\n"), process)
    process.send_signal(sent)
    process.communicate(timeout=GUARD)  # the pipe is closed when the last of them has ended
    kept = path.read_text()
    assert [json.loads(line)["result"] for line in kept.splitlines()] == [{}]
    assert run_units([Unit("builtins:dict", {})], path) == [{}]
    assert path.read_text() == kept


def test_the_same_on_a_cluster(tmp_path):
    path = tmp_path / "u.jsonl"
    small = {"n_workers": 1, "threads_per_worker": 1, "processes": False, "dashboard_address": None}
    with distributed.LocalCluster(**small) as cluster:
        found = run_units(units(), path, scheduler=cluster.scheduler_address)
    assert found == run_units(units(), path) == [{"n": i} for i in range(4)]


def test_what_is_no_address_is_said_before_a_client_is_made(monkeypatch):
    """One that cannot begin waits, and then says so, when it is collected."""
    monkeypatch.setattr(distributed, "Client", lambda *arguments, **options: pytest.fail("a client was made"))
    with pytest.raises(BadInput, match="'nonsense' is no address of a Dask scheduler"):
        run_units(units(), None, scheduler="nonsense")


@pytest.mark.thorough
@pytest.mark.parametrize(
    ("study", "less", "said"),
    [(chaos, {"orbits": 16, "steps": 2000}, "integrable: 0 of"), (energy, {"steps": 3000}, "T = 24.64334")],
)
def test_a_study_of_few_steps_has_its_sentences_and_figures(study, less, said, tmp_path, monkeypatch):
    def small(*how, all_units=study._units):
        """The units of the quick study, each with fewer orbits and steps."""
        for group, one in all_units(*how):
            yield group, Unit(one.function, one.arguments | {k: v for k, v in less.items() if k in one.arguments})

    monkeypatch.setattr(units_module, "cores", lambda: 1)
    monkeypatch.setattr(study, "_units", lambda *how: list(small(*how)))
    found = study.study(quick=True)
    json.dumps(found, allow_nan=False)
    assert said in " ".join(study.sentences(found))
    drawn = checkout.save_figures(study.__name__, study.DRAWN, found, tmp_path)
    assert drawn
    assert all(b"<svg" in one.read_bytes() for one in drawn)
