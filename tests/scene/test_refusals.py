"""A full disk, a read-only folder: one sentence, exit 2, nothing lost; with room the same command goes on."""

import errno
import os
import re
import resource
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from itertools import count

import numpy as np
import pytest
from budget import slow
from commands import answer, chapsym, refused
from first import BALL, FIRST
from small_units import equal_to_the_bit, plan
from waiting import INTERRUPTIBLE
from zarr.storage import _local

from chapsym.scene import SceneError
from chapsym.scene.result import formats
from chapsym.scene.running import sweep

#: Three units of work.
RUN = "time_step = 0.01\nsteps = 120\nevery = 20\nmap = true\n"
LONG = BALL.replace("[3.0,", "[{ linspace = [3.0, 4.0, 9_000] },") + RUN


@contextmanager
def mounted(folder, *options):
    """A small disk of its own at `folder`; skips where none can be mounted."""
    folder.mkdir(exist_ok=True)
    if subprocess.run(["mount", *options, str(folder)], capture_output=True, check=False).returncode:
        pytest.skip("only root can mount a disk")
    try:
        yield
    finally:
        subprocess.run(["umount", str(folder)], check=True)


def small_disk(folder, size):
    return mounted(folder, "-t", "tmpfs", "-o", f"size={size}", "tmpfs")


def test_a_disk_that_fills_up_loses_nothing_and_the_same_run_goes_on(whole, tmp_path):
    """A disk that grows a little after each refusal; what was written is never written again."""
    disk = tmp_path / "disk"
    kept, words = [], []
    with small_disk(disk, "40k"):
        path = disk / "run.zarr"
        for size in range(100, 4000, 150):
            try:
                sweep.run_to_store(plan(), path)
                break
            except SceneError as error:
                words.append(str(error))
            kept.append(len(list(path.glob(".chapsym/chunk-*"))))
            subprocess.run(["mount", "-o", f"remount,size={size}k", str(disk)], check=True)
        equal_to_the_bit(formats.load(path).load(), whole)
        assert os.listdir(disk) == ["run.zarr"]
    assert [one for one in words if "No space left on device" not in one or "\n" in one] == []
    assert kept == sorted(kept)
    assert kept[0] == 0 < kept[-1]


@pytest.mark.parametrize("suffix", [".nc", ".csv", ".parquet"])
def test_a_full_disk_leaves_the_file_that_was_there(everything, tmp_path, suffix):
    disk = tmp_path / "disk"
    with small_disk(disk, "16k"):
        path = disk / f"run{suffix}"
        path.write_bytes(b"precious")
        with pytest.raises(SceneError, match="No space left on device"):
            formats.save(everything, path)
        assert path.read_bytes() == b"precious"
        assert os.listdir(disk) == [path.name]


@pytest.mark.parametrize(
    ("place", "name", "at"),
    [*((_local, "_put", n) for n in (0, 30)), *slow((np, "savez", 3), *((_local, "_put", n) for n in (1, 2, 40, 50)))],
)
def test_every_write_that_fails_is_one_sentence_and_is_mended_by_room(whole, path, monkeypatch, place, name, at):
    """The disk is full at the n-th write of a file of Zarr, and at that of a mark; later writes are slow."""
    writes, real = count(), getattr(place, name)

    def full(*args, **kwargs):
        n = next(writes)
        if n == at:
            raise OSError(errno.ENOSPC, "No space left on device")
        if n > at:
            time.sleep(0.2)  # still on its way when the error is seen
        return real(*args, **kwargs)

    with monkeypatch.context() as patched:
        patched.setattr(place, name, full)
        with pytest.raises(SceneError, match="No space left on device; what was written stays: make room"):
            sweep.run_to_store(plan(), path)
        time.sleep(0.3)
    assert set(os.listdir(path.parent)) <= {path.name}
    assert sweep.run_to_store(plan(), path).complete
    equal_to_the_bit(formats.load(path).load(), whole)


def test_a_read_only_disk_is_one_sentence(tmp_path):
    disk = tmp_path / "disk"
    with small_disk(disk, "8m"):
        done = disk / "done.zarr"
        sweep.run_to_store(plan(), done)
        subprocess.run(["mount", "-o", "remount,ro", str(disk)], check=True)
        for name in ("run.zarr", "run.nc", "run.parquet", "run.csv", "run.npz"):
            words = refused("run", FIRST, "-o", disk / name)
            assert re.search(rf"{name} cannot be written", words)
        assert sweep.run_to_store(plan(), done).nothing_to_do
        with pytest.raises(SceneError, match="Read-only file system"):
            sweep.run_to_store(plan(), done, fresh=True)
        assert formats.load(done).attrs["complete"] is True


@contextmanager
def file_size(most):
    """No file of this process grows beyond a number of bytes."""
    ignored, limits = signal.signal(signal.SIGXFSZ, signal.SIG_IGN), resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (most, limits[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        signal.signal(signal.SIGXFSZ, ignored)


def test_a_limit_of_the_file_size_is_one_sentence(tmp_path):
    scene = tmp_path / "first.toml"
    scene.write_text(FIRST.read_text() + "map = true\n")  # with nothing to compile, which cannot be kept either
    for suffix in (".nc", ".zarr"):  # one file, and many
        with file_size(20_000):
            words = refused("run", scene, "-o", tmp_path / f"run{suffix}")
        assert "File too large" in words
    assert chapsym("run", scene, "-o", tmp_path / "run.zarr").returncode == 0
    assert {p.name for p in tmp_path.iterdir()} == {"first.toml", "run.zarr"}


#: The command, which interrupts itself once, when the first unit of its work is kept.
INTERRUPTED = f"""{INTERRUPTIBLE}
import sys, threading
from contextlib import contextmanager
from pathlib import Path
from chapsym.cli import main, output

once = iter([signal.SIGINT])

def report(progress):
    if list(Path(sys.argv[-1]).glob(".chapsym/chunk-*")):
        for sent in once:
            signal.pthread_kill(threading.main_thread().ident, sent)

@contextmanager
def reporting():
    yield report

output.following = reporting
main()
"""


def test_an_interrupted_command_stops_and_goes_on(tmp_path, path):
    scene = tmp_path / "long.toml"
    scene.write_text(LONG)
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPTED, "run", str(scene), "-o", str(path)],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 130, done.stderr
    assert done.stderr.splitlines()[-1] == "chapsym: interrupted; the same command goes on from there"
    assert list(path.glob(".chapsym/chunk-*"))
    found = answer("run", scene, "-o", path)
    assert found.pop("discretisation")["balls"] == 8
    assert found == {
        "output": str(path), "balls": 9_000, "frames": 7, "steps": 120, "model": "reduced map",
        "failed": 0, "complete": True, "lost": [],
    }  # fmt: skip
    again = chapsym("run", scene, "-o", path)
    words = f"9000 balls, 7 frames, reduced map; {path} was complete already\ndiscretisation: about "
    assert again.stdout.startswith(words)
    scene.write_text(LONG.replace("4.0, 9_000", "5.0, 9_000"))
    assert "holds another scene (start.omega differs)" in refused("run", scene, "-o", path)


def test_the_command_refuses_what_cannot_be(tmp_path):
    scene = tmp_path / "long.toml"
    scene.write_text(LONG)
    assert "needs a .zarr" in refused("run", scene, "-o", tmp_path / "run.nc", "--scheduler", "tcp://x:1")
    scene.write_text(LONG.replace("steps = 120\nevery = 20", "steps = 2000\nevery = 1"))
    assert "a CSV of more than 10000000 is of no use" in refused("run", scene, "-o", tmp_path / "run.csv")
    assert [p.name for p in tmp_path.iterdir()] == ["long.toml"]
