"""Sweeps on a real Dask scheduler with worker processes: equal to the local ones, whatever happens to a worker."""

import json
import logging
import os
import random
import signal
import subprocess
import sys
import threading
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest
from small_units import equal_to_the_bit
from waiting import GUARD, until

from chapsym.scene import SceneError
from chapsym.scene.plan import plan as plans
from chapsym.scene.plan.models import Rolling
from chapsym.scene.result import formats
from chapsym.scene.running import cluster, sweep
from chapsym.scene.running.source import plan_from

PRELOAD = str(Path(__file__).parents[1] / "slow_small_units.py")
SCENE = """
[ball]
inertia = [0.006, 0.007, 0.009]
mass = 2.0
radius = 0.1
[start]
omega = [{ linspace = [3.0, 200.0, 41] }, -2.0, 1.0]
gamma = ["2/7", "3/7", "6/7"]
[run]
time_step = 0.01
steps = 300
every = 10
outputs = ["momentum", "contact", "energy"]
"""


@pytest.fixture(autouse=True)
def _small(monkeypatch):
    """Here as in the workers; a scheduler or a worker may be slow to come."""
    monkeypatch.setattr(plans, "CHUNK", 4)
    monkeypatch.setattr(Rolling, "unit_steps", 400)
    monkeypatch.setattr(cluster, "REACHED", GUARD)
    monkeypatch.setattr(cluster, "ABANDONED", GUARD)


@pytest.fixture
def local(tmp_path):
    sweep.run_to_store(plan_from(SCENE), tmp_path / "local.zarr")
    return formats.load(tmp_path / "local.zarr").load()


@contextmanager
def process(*arguments, **environment):
    """A process that is killed in the end, with all that it started."""
    running = subprocess.Popen(
        [sys.executable, "-m", *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        start_new_session=True, env=os.environ | {"DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "1"} | environment,
    )  # fmt: skip
    try:
        yield running
    finally:
        with suppress(ProcessLookupError):
            os.killpg(running.pid, signal.SIGKILL)
        running.wait()


@contextmanager
def scheduling(file):
    """A scheduler that writes this file, and its address."""
    arguments = ["distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard"]
    with process(*arguments, "--scheduler-file", str(file)) as running:

        def address():
            with suppress(FileNotFoundError, ValueError):  # it is there before it is whole
                return json.loads(file.read_text())["address"]

        yield running, until(address, running)


@pytest.fixture
def scheduler(tmp_path):
    with scheduling(tmp_path / "scheduler.json") as (_, address):
        yield address


def worker(address, sleep="0.05", **environment):
    """One worker of one thread, without a nanny that would start it again."""
    arguments = ["distributed.cli.dask_worker", address, "--no-nanny", "--nthreads", "1", "--no-dashboard"]
    return process(*arguments, "--preload", PRELOAD, CHAPSYM_TEST_SLEEP=sleep, **environment)


def test_two_workers_have_the_bits_of_one_machine(local, scheduler, tmp_path):
    seen = []
    with worker(scheduler), worker(scheduler):
        outcome = sweep.run_to_store(plan_from(SCENE), tmp_path / "run.zarr", scheduler, report=seen.append)
    assert outcome.complete
    equal_to_the_bit(formats.load(tmp_path / "run.zarr").load(), local)
    assert outcome.failed == (local.status.values != 0).sum() > 0
    assert seen[-1].balls == 41
    assert seen[-1].steps == seen[-1].of
    assert [p.steps for p in seen] == sorted(p.steps for p in seen)


def test_a_worker_that_is_killed_in_the_middle_changes_nothing(local, scheduler, tmp_path):
    with worker(scheduler, "0.2") as victim, worker(scheduler, "0.2"):
        kills = iter([lambda: os.killpg(victim.pid, signal.SIGKILL)])

        def kill(progress):
            if progress.balls >= 8:
                next(kills, lambda: None)()

        outcome = sweep.run_to_store(plan_from(SCENE), tmp_path / "run.zarr", scheduler, report=kill)
        assert victim.wait() == -signal.SIGKILL
    assert outcome.complete
    equal_to_the_bit(formats.load(tmp_path / "run.zarr").load(), local)


def test_a_run_goes_on_from_a_cluster_to_one_machine(local, scheduler, tmp_path):
    """The client is killed when it has told some units and waits: in the middle, however fast the workers are."""
    path = tmp_path / "run.zarr"
    lines = [
        "import sys, time", f"sys.path.insert(0, {str(Path(PRELOAD).parent)!r})", "import slow_small_units",
        "from pathlib import Path", "from chapsym.scene.running import cluster, sweep",
        "from chapsym.scene.running.source import plan_from",
        f"cluster.REACHED = cluster.ABANDONED = {GUARD}",
        f"told = iter(range({random.Random(5).randrange(4, 12)}))",
        f"report = lambda at: next(told, None) is None and (print(flush=True), time.sleep({GUARD}))",
        f"sweep.run_to_store(plan_from({SCENE!r}), Path({str(path)!r}), {scheduler!r}, report=report)",
    ]  # fmt: skip
    with worker(scheduler, "0.1"), worker(scheduler, "0.1"):
        client = subprocess.Popen([sys.executable, "-c", "\n".join(lines)], stdout=subprocess.PIPE, text=True)
        assert client.stdout.readline()
        client.kill()
        client.communicate()
        assert formats.load(path).attrs["complete"] is False
        assert sweep.run_to_store(plan_from(SCENE), path).complete
    equal_to_the_bit(formats.load(path).load(), local)


def test_units_that_kill_their_workers_are_listed_and_the_others_go_on(local, scheduler, tmp_path):
    """The workers die of one chunk, here by a preload that ends the process when it sees its balls."""
    deadly = tmp_path / "deadly.py"
    deadly.write_text(
        "import os, runpy\nfrom chapsym.scene import segments\n"
        f"runpy.run_path({PRELOAD!r})\n"
        "def advance(plan, chunk, *rest, real=segments.advance):\n    if chunk.start == 12:\n        os._exit(1)\n"
        "    return real(plan, chunk, *rest)\nsegments.advance = advance\n"
    )
    arguments = ["distributed.cli.dask_worker", scheduler, "--nanny", "--nthreads", "1", "--no-dashboard"]
    with process(*arguments, "--preload", str(deadly)), process(*arguments, "--preload", str(deadly)):
        outcome = sweep.run_to_store(plan_from(SCENE), tmp_path / "run.zarr", scheduler)
    assert list(outcome.lost) == [(12, 16)], outcome.lost
    assert "its worker was lost" in outcome.lost[12, 16]
    assert not outcome.complete
    found = formats.load(tmp_path / "run.zarr").load()
    assert found.attrs["complete"] is False
    assert (found.taken.values == -1).tolist() == [12 <= i < 16 for i in range(41)]
    assert sweep.run_to_store(plan_from(SCENE), tmp_path / "run.zarr").complete
    equal_to_the_bit(formats.load(tmp_path / "run.zarr").load(), local)


def test_workers_with_another_chapsym_are_one_sentence(scheduler, tmp_path):
    with (
        worker(scheduler, CHAPSYM_TEST_VERSION="0.0.9"),
        pytest.raises(SceneError, match=r"chapsym 0\.0\.9, and") as told,
    ):
        sweep.run_to_store(plan_from(SCENE), tmp_path / "run.zarr", scheduler)
    assert "another version of chapsym" in str(told.value)
    assert "\n" not in str(told.value)
    assert (formats.load(tmp_path / "run.zarr").taken.values == -1).all()


@pytest.mark.parametrize(
    ("address", "told"),
    [
        ("tcp://127.0.0.1:9", r"no Dask scheduler answers at tcp://127\.0\.0\.1:9 \(waited 1 s\)"),
        ("nonsense://x", "is no address of a Dask"),
    ],
)
def test_a_scheduler_that_is_not_there_is_one_sentence(tmp_path, monkeypatch, address, told):
    monkeypatch.setattr(cluster, "REACHED", 1.0)
    with pytest.raises(SceneError, match=told):
        sweep.run_to_store(plan_from(SCENE), tmp_path / "run.zarr", address)


def test_a_scheduler_without_workers_is_one_sentence(scheduler, tmp_path, monkeypatch):
    monkeypatch.setattr(cluster, "ABANDONED", 1.0)
    with pytest.raises(SceneError, match="has had no workers for"):
        sweep.run_to_store(plan_from(SCENE), tmp_path / "run.zarr", scheduler)


def test_a_scheduler_that_ends_is_one_sentence_and_loses_nothing(local, tmp_path, caplog, monkeypatch):
    import distributed  # noqa: F401 -- sets its loggers up

    for name in ("distributed", "distributed.client"):
        monkeypatch.setattr(logging.getLogger(name), "handlers", [caplog.handler])
    with scheduling(tmp_path / "scheduler.json") as (running, address):

        def end(progress):
            if progress.balls >= 8:
                threading.Thread(target=running.kill).start()

        with worker(address, "0.2"), pytest.raises(SceneError, match="is lost; the same command goes on"):
            sweep.run_to_store(plan_from(SCENE), tmp_path / "run.zarr", address, report=end)
    assert not caplog.records
    before = formats.load(tmp_path / "run.zarr").taken.values
    assert (before != -1).sum() >= 8
    assert sweep.run_to_store(plan_from(SCENE), tmp_path / "run.zarr").complete
    equal_to_the_bit(formats.load(tmp_path / "run.zarr").load(), local)
