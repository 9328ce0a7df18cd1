"""Sweeps on a Dask scheduler: equal to the local ones, whatever happens to a worker, and a sentence for what ends them.

The workers are threads of this process, but for those that are to die.
"""

import json
import logging
import os
import signal
import subprocess
import sys
import threading
import time
from contextlib import contextmanager, suppress

import pytest
from distributed import LocalCluster
from first import BALL
from small_units import equal_to_the_bit
from waiting import GUARD

from chapsym import jobs
from chapsym.dynamics import BadInput
from chapsym.scene import SceneError
from chapsym.scene.plan import plan as plans
from chapsym.scene.plan.models import Rolling
from chapsym.scene.plan.plan import plan_from
from chapsym.scene.result import formats
from chapsym.scene.running import sweep

SCENE = f"""{BALL.replace("[3.0,", "[{ linspace = [3.0, 200.0, 17] },")}time_step = 0.01
steps = 200
every = 10
outputs = ["momentum", "contact", "energy"]
map = true
"""


def small(patched):
    """Small units, here as in the workers; a scheduler or a worker may be slow to come."""
    patched.setattr(plans, "CHUNK", 4)
    patched.setattr(Rolling, "unit_steps", 400)
    patched.setattr(jobs, "REACHED", GUARD)
    patched.setattr(jobs, "ABANDONED", GUARD)


@pytest.fixture(autouse=True)
def _small(monkeypatch):
    small(monkeypatch)


@pytest.fixture(scope="module")
def local(tmp_path_factory):
    path = tmp_path_factory.mktemp("local") / "local.zarr"
    with pytest.MonkeyPatch.context() as patched:
        small(patched)
        sweep.run_to_store(plan_from(SCENE), path)
    return formats.load(path).load()


@contextmanager
def workers(count):
    with LocalCluster(
        n_workers=count, threads_per_worker=1, processes=False, dashboard_address=":0", silence_logs=logging.CRITICAL
    ) as running:
        yield running


@pytest.fixture(scope="module")
def two():
    with workers(2) as running:
        yield running.scheduler_address


def test_two_workers_have_the_bits_of_one_machine(local, two, path):
    seen = []
    outcome = sweep.run_to_store(plan_from(SCENE), path, two, report=seen.append)
    assert outcome.complete
    equal_to_the_bit(formats.load(path).load(), local)
    assert outcome.failed == (local.status.values != 0).sum() > 0
    assert seen[-1].balls == 17
    assert seen[-1].steps == seen[-1].of
    assert [p.steps for p in seen] == sorted(p.steps for p in seen)


def test_a_run_goes_on_from_a_cluster_to_one_machine(local, two, path):

    def end(progress):
        if progress.balls >= 8:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep.run_to_store(plan_from(SCENE), path, two, report=end)
    found = formats.load(path)
    assert found.attrs["complete"] is False
    assert 8 <= (found.taken.values != -1).sum() < 17
    assert sweep.run_to_store(plan_from(SCENE), path).complete
    equal_to_the_bit(formats.load(path).load(), local)


def test_balls_without_an_answer_are_listed_and_the_others_go_on(local, two, path, monkeypatch):
    real = sweep.computed

    def computed(plan, chunk, *rest):
        if chunk == 3:
            raise RuntimeError("nobody foresaw this")
        return real(plan, chunk, *rest)

    with monkeypatch.context() as patched:
        patched.setattr(sweep, "computed", computed)
        outcome = sweep.run_to_store(plan_from(SCENE), path, two)
    assert outcome.lost == {(12, 16): "RuntimeError on a worker: nobody foresaw this"}
    assert not outcome.complete
    assert sweep.run_to_store(plan_from(SCENE), path).complete
    equal_to_the_bit(formats.load(path).load(), local)


def test_workers_with_another_chapsym_are_one_sentence(two, path, monkeypatch):
    def provenance(plan, real=sweep.provenance):
        here = threading.current_thread() is threading.main_thread()
        return real(plan) | ({} if here else {"chapsym_version": "0.0.9"})

    monkeypatch.setattr(sweep, "provenance", provenance)
    with pytest.raises(SceneError, match="is of another version of chapsym") as words:
        sweep.run_to_store(plan_from(SCENE), path, two)
    assert "\n" not in str(words.value)
    assert (formats.load(path).taken.values == -1).all()


@pytest.mark.parametrize(
    ("address", "words"),
    [("tcp://127.0.0.1:9", "no Dask scheduler answers at tcp://127.0.0.1:9"), ("nonsense://x", "is no address of a")],
)
def test_a_scheduler_that_is_not_there_is_one_sentence_and_leaves_all_as_it_was(path, monkeypatch, address, words):
    monkeypatch.setattr(jobs, "REACHED", 1.0)
    with pytest.raises(BadInput, match=words):
        sweep.run_to_store(plan_from(SCENE), path, address)
    assert not path.exists()
    sweep.run_to_store(plan_from(SCENE), path)
    with pytest.raises(BadInput, match=words):
        sweep.run_to_store(plan_from(SCENE), path, address, fresh=True)
    assert formats.load(path).attrs["complete"] is True
    assert sweep.run_to_store(plan_from(SCENE), path, address).nothing_to_do


def test_a_scheduler_without_workers_is_one_sentence(path, monkeypatch):
    monkeypatch.setattr(jobs, "ABANDONED", 1.0)
    with workers(0) as running, pytest.raises(BadInput, match="has had no workers for"):
        sweep.run_to_store(plan_from(SCENE), path, running.scheduler_address)


class Stopped:
    """A client whose scheduler neither answers nor ends."""

    def nthreads(self, callback_timeout=None):
        assert callback_timeout is not None, "this waits for ever"
        raise TimeoutError


def test_a_scheduler_that_answers_no_more_is_lost_and_is_not_asked_to_cancel():
    crew = jobs.Workers(Stopped(), "tcp://nowhere")
    crew.flying.add("a call")
    with pytest.raises(BadInput, match="the Dask scheduler at tcp://nowhere is lost; the same command goes on"):
        crew.room()
    assert not crew.flying


@contextmanager
def process(*arguments):
    """A process that is killed in the end, with all that it started."""
    running = subprocess.Popen(
        [sys.executable, "-m", *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        start_new_session=True, env=os.environ | {"DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "0"},
    )  # fmt: skip
    try:
        yield running
    finally:
        with suppress(ProcessLookupError):
            os.killpg(running.pid, signal.SIGKILL)
        running.wait()


@pytest.mark.thorough
def test_workers_that_die_and_a_scheduler_that_ends(local, tmp_path, caplog, monkeypatch, path):
    """A worker dies of one chunk each time, and of another once, and comes again; then the scheduler is killed, too."""
    for name in ("distributed", "distributed.client"):
        monkeypatch.setattr(logging.getLogger(name), "handlers", [caplog.handler])
    (tmp_path / "deadly.py").write_text(
        "import os\nfrom pathlib import Path\nfrom chapsym.scene.plan import models, plan\n"
        "from chapsym.scene.running import sweep\nplan.CHUNK, models.Rolling.unit_steps = 4, 400\n"
        "def advance(plan, chunk, *rest, real=sweep.advance):\n"
        f"    died = Path({str(tmp_path / 'died')!r})\n"
        "    if chunk.start == 12 or (chunk.start == 16 and not died.exists()):\n"
        "        died.touch() if chunk.start == 16 else None\n"
        "        os._exit(1)\n"
        "    return real(plan, chunk, *rest)\nsweep.advance = advance\n"
    )
    file = tmp_path / "scheduler.json"
    begin = ["distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard"]
    with process(*begin, "--scheduler-file", str(file)) as running:
        address = None
        while address is None:
            assert running.poll() is None
            with suppress(OSError, ValueError):  # it may be there without its text
                address = str(json.loads(file.read_text())["address"])
            time.sleep(0.05)
        worker = ["distributed.cli.dask_worker", address, "--nanny", "--nthreads", "1", "--no-dashboard"]
        preload = ["--preload", str(tmp_path / "deadly.py")]
        with process(*worker, *preload):
            outcome = sweep.run_to_store(plan_from(SCENE), path, address)
            assert outcome.lost == {(12, 16): "its worker was lost, 3 times"}
            assert (tmp_path / "died").exists()
            found = formats.load(path).load()
            assert found.attrs["complete"] is False
            assert (found.taken.values == -1).tolist() == [12 <= i < 16 for i in range(17)]

            def end(progress):
                if progress.balls >= 8:
                    threading.Thread(target=running.kill).start()

            with pytest.raises(BadInput, match="is lost; the same command goes on"):
                sweep.run_to_store(plan_from(SCENE), tmp_path / "again.zarr", address, report=end)
    assert not caplog.records
    assert (formats.load(tmp_path / "again.zarr").taken.values != -1).sum() >= 8
    for name in ("run.zarr", "again.zarr"):
        assert sweep.run_to_store(plan_from(SCENE), tmp_path / name).complete
        equal_to_the_bit(formats.load(tmp_path / name).load(), local)
