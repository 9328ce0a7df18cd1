"""Results in Zarr: equal to those in memory, resumable after SIGKILL, one writer, never mixed."""

import gc
import json
import os
import random
import subprocess
import sys
import threading
import time
import warnings
from contextlib import contextmanager
from dataclasses import replace
from importlib.resources import files
from itertools import product
from pathlib import Path

import numpy as np
import pytest
import xarray
import zarr
from budget import slow
from first import BALL
from small_units import BALLS, EVERY, OUTPUTS, PART, STEPS, UNITS, equal_to_the_bit, interrupted, plan
from waiting import GUARD, until

from chapsym.dynamics import BadInput, Status
from chapsym.dynamics.labelled import NOT_RUN
from chapsym.generated import TABLE
from chapsym.scene import SceneError
from chapsym.scene.plan import plan as plans
from chapsym.scene.plan.plan import plan_from
from chapsym.scene.result import dataset
from chapsym.scene.result.formats import check_ours, load
from chapsym.scene.result.summary import far
from chapsym.scene.running import store as stores
from chapsym.scene.running import sweep
from chapsym.scene.running.store import Store
from chapsym.scene.running.sweep import Stopped

CHILD = [sys.executable, str(Path(__file__).parents[1] / "small_units.py")]


def opened(path):
    with xarray.open_zarr(path) as store:
        return store.load()


def marked(path):
    """The marks of a store, and when they were written."""
    return {mark.name: mark.stat().st_mtime_ns for mark in stores.folder_of(path).glob("chunk-*.npz")}


def mended(path, whole):
    """What is said of the run that goes on, after which the store is whole and nothing is left to do."""
    outcome = sweep.run_to_store(plan(), path)
    assert outcome.complete
    assert not outcome.nothing_to_do
    equal_to_the_bit(load(path), whole)
    assert sweep.run_to_store(plan(), path).nothing_to_do
    return outcome


@contextmanager
def child(path):
    """A process that runs the plan, one unit of it, and is killed in the end."""
    with subprocess.Popen([*CHILD, str(path)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as running:
        try:
            assert running.stdout.readline() == "ready\n", running.stderr.read()
            yield running
        finally:
            running.kill()


def test_the_dataset_keeps_the_contract(everything):
    assert dict(everything.sizes) == {"ball": BALLS, "frame": 22, "axis": 3, "quaternion": 4, "plane": 2, "integral": 3}
    assert set(OUTPUTS) | {"taken", "status", "mass_tensor", "D", "radius", "axes"} == set(everything.data_vars)
    assert all(everything[name].attrs["long_name"] for name in everything.data_vars)
    assert all(everything[name].attrs["units"] for name in everything.data_vars if name != "status")
    assert everything.step.values.tolist() == list(range(0, STEPS + 1, EVERY))
    np.testing.assert_allclose(everything.time, 0.01 * everything.step, rtol=1e-15)
    assert everything["start.omega.1"].attrs["units"] == "rad s-1"
    assert everything.sel(ball="ball 2", axis="3").momentum.dims == ("frame",)
    assert everything.attrs["seed"] == 7
    assert "turn" in everything.attrs["kernels"]
    stopped = everything.status.values != Status.TAKEN
    assert 0 < stopped.sum() < BALLS
    for ball in range(BALLS):
        after = everything.step.values > everything.taken.values[ball]
        for name in OUTPUTS:
            gone = np.isnan(everything[name].values[ball]).reshape(22, -1)
            assert (gone == after[:, np.newaxis]).all(), name


def test_a_store_has_the_bits_of_the_run_in_memory_and_is_left_alone(everything, tmp_path, path, monkeypatch):
    outcome = sweep.run_to_store(plan(OUTPUTS), path)
    assert outcome.complete
    assert not outcome.nothing_to_do
    assert outcome.failed == (everything.status.values != 0).sum()
    found = opened(path)
    equal_to_the_bit(found, everything)
    assert found.attrs["complete"] is True
    assert [p.name for p in tmp_path.iterdir()] == ["run.zarr"]
    assert not stores.folder_of(path).exists()
    before = {p: p.stat().st_mtime_ns for p in path.rglob("*")}
    monkeypatch.setattr(sweep, "advance", None)
    again = sweep.run_to_store(plan(OUTPUTS), path)
    assert again.nothing_to_do
    assert again.failed == outcome.failed
    assert {p: p.stat().st_mtime_ns for p in path.rglob("*")} == before


def cut(chunk):
    chunk.write_bytes(chunk.read_bytes()[: chunk.stat().st_size // 2])


def emptied(chunk):
    """As a full disk leaves it."""
    chunk.write_bytes(b"")


def turned(chunk):
    content = bytearray(chunk.read_bytes())
    content[len(content) // 2] ^= 1
    chunk.write_bytes(content)


def another(place):
    """With the bytes of another chunk of the store."""
    return lambda chunk: chunk.write_bytes((chunk.parents[len(place.split("/")) - 1] / place).read_bytes())


DAMAGES = [
    ("gamma/c/0/0/0", cut), ("mass_tensor/c/0/0", Path.unlink), ("momentum/c/0/0/0", another("momentum/c/0/1/0")),
    ("D/c/0", another("radius/c/0")), ("taken/c/0", emptied), ("gamma/c/0/0/0", turned),
]  # fmt: skip


@pytest.mark.parametrize(("after", "place", "damage"), [
    *((UNITS, *one) for one in DAMAGES[:4]), *((PART, *one) for one in DAMAGES[4:]),
    *slow(*((after, *one) for after in (UNITS, PART) for one in DAMAGES)),
])  # fmt: skip
def test_a_chunk_that_is_lost_or_damaged_is_found_and_computed_anew(whole, path, after, place, damage):
    interrupted(path, after)
    damage(path / place)
    name = place.split("/")[0]
    if after == UNITS or damage in (cut, emptied, turned):
        with pytest.raises(SceneError, match=f"{place} is (missing|damaged): chapsym run of the same scene"):
            load(path)[name].load()
    assert list(mended(path, whole).damaged) == [place] * (name in ("gamma", "momentum", "taken"))


@pytest.mark.parametrize(("damage", "name", "after"), [
    (cut, "gamma", UNITS), (Path.unlink, "D", PART),
    *slow((emptied, "gamma", PART), (Path.unlink, "gamma", UNITS), (cut, "D", UNITS), (Path.unlink, "gamma", PART)),
])  # fmt: skip
def test_the_metadata_of_an_array_are_written_anew(whole, path, damage, after, name):
    interrupted(path, after)
    before = (path / name / "zarr.json").read_bytes()
    damage(path / name / "zarr.json")
    assert not mended(path, whole).damaged
    assert json.loads((path / name / "zarr.json").read_bytes()) == json.loads(before)
    equal_to_the_bit(xarray.open_zarr(path, consolidated=False), whole)


def of_the_group(change):
    """In what the group says of its arrays."""

    def change_root(path):
        root = path / "zarr.json"
        document = json.loads(root.read_bytes())
        change(document["consolidated_metadata"]["metadata"])
        root.write_text(json.dumps(document))

    return change_root


def exchanged(path):
    (path / "gamma").rename(path / "kept")
    (path / "momentum").rename(path / "gamma")
    (path / "kept").rename(path / "momentum")


@pytest.mark.parametrize("after", [UNITS, *slow(PART)])
@pytest.mark.parametrize(
    "damage",
    [
        of_the_group(lambda arrays: arrays.update({"..": arrays["gamma"]})),
        of_the_group(lambda arrays: arrays["gamma"].update(shape=[BALLS, 35, 3])),
        of_the_group(lambda arrays: arrays["D"]["attributes"].update(units="lb")),
        exchanged,
        *slow(of_the_group(lambda arrays: arrays.pop("gamma")), of_the_group(lambda arrays: arrays.update(gamma=5))),
    ],
)
def test_what_the_group_says_is_as_the_scene_has_it(whole, path, after, damage):
    """`run` never calls complete what `load` refuses, and writes nothing outside of the store."""
    interrupted(path, after)
    damage(path)
    if after == UNITS:
        with pytest.raises(SceneError):
            load(path).load()
    mended(path, whole)
    assert [p.name for p in path.parent.iterdir()] == ["run.zarr"]
    equal_to_the_bit(xarray.open_zarr(path, consolidated=False), whole)


@pytest.mark.parametrize("after", [UNITS, *slow(PART)])
@pytest.mark.parametrize(
    "change",
    [
        lambda one: one.update(shape=[BALLS, 35, 3]),
        lambda one: one["codecs"][0]["configuration"].update(endian="big"),
        lambda one: one["chunk_grid"]["configuration"].update(chunk_shape=[4, 9, 1]),
    ],
)
def test_an_array_of_another_form_is_refused_and_left(path, after, change):
    """Where the group and the array agree: another program wrote it, and it may be all that is left of a long run."""
    interrupted(path, after)
    of_the_group(lambda arrays: change(arrays["gamma"]))(path)
    own = path / "gamma/zarr.json"
    document = json.loads(own.read_bytes())
    change(document)
    own.write_text(json.dumps(document))
    is_refused_and_left(path)


def test_chunks_that_are_larger_than_their_array_are_refused(path):
    sweep.run_to_store(plan(), path)
    own = path / "gamma/zarr.json"
    document = json.loads(own.read_bytes())
    document["chunk_grid"]["configuration"]["chunk_shape"] = [4, 10**12, 3]
    own.write_text(json.dumps(document))
    of_the_group(lambda arrays: arrays.update(gamma=document))(path)
    with pytest.raises(SceneError, match="the chunks of gamma are larger than it is"):
        load(path)


def is_refused_and_left(path):
    before = {p: p.read_bytes() for p in path.rglob("*") if p.is_file()}
    with pytest.raises(SceneError, match="is not as chapsym wrote it, but perhaps a copy; choose another name"):
        sweep.run_to_store(plan(), path)
    assert {p: p.read_bytes() for p in path.rglob("*") if p.is_file()} == before


@pytest.mark.parametrize(("name", "content"), [
    ("gamma/c/.DS_Store", b"longer than a checksum"), ("gamma/c/0.partial/1", b""),
    *slow(("D/c/.DS_Store", b""), ("D/c/0 (1)", b"longer than a checksum"), ("gamma/c/.DS_Store", b"")),
])  # fmt: skip
def test_what_another_program_puts_into_a_store_is_left_there(whole, path, name, content):
    interrupted(path, PART)
    (path / name).parent.mkdir(exist_ok=True)
    (path / name).write_bytes(content)
    mended(path, whole)
    assert (path / name).read_bytes() == content


@pytest.mark.parametrize("name", ["zarr.json", "gamma", "D/digests.json", ".chapsym/lock", "gamma/c/0/0/0"])
def test_nothing_is_written_through_a_link(path, tmp_path_factory, name):
    interrupted(path, PART)
    other = tmp_path_factory.mktemp("other") / "kept"
    if (path / name).exists():
        (path / name).rename(other)
    else:
        other.write_text("kept")
    (path / name).symlink_to(other)
    before = {p: p.is_file() and p.read_bytes() for p in other.parent.rglob("*")}
    with pytest.raises(SceneError, match=f"{name} is a link"):
        sweep.run_to_store(plan(), path)
    assert {p: p.is_file() and p.read_bytes() for p in other.parent.rglob("*")} == before


def test_a_chunk_that_the_system_does_not_read_is_one_sentence(path):
    interrupted(path, UNITS)
    chunk = path / "gamma/c/0/0/0"
    chunk.unlink()
    chunk.symlink_to(chunk.name)
    with pytest.raises(SceneError, match="gamma/c/0/0/0 cannot be read"):
        load(path).load()


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes here")
@pytest.mark.parametrize("name", ["zarr.json", "gamma/zarr.json", "gamma/c/0/0/0", "gamma/digests.json"])
def test_a_pipe_is_not_waited_for(whole, path, name):
    interrupted(path, UNITS)
    (path / name).unlink()
    os.mkfifo(path / name)
    if name.endswith("digests.json"):
        equal_to_the_bit(load(path), whole)
        return
    with pytest.raises(SceneError):
        load(path).load()
    if name.endswith("zarr.json"):
        with pytest.raises(SceneError, match="pipe" if "gamma" in name else "no result of chapsym"):
            sweep.run_to_store(plan(), path)
    else:
        assert list(sweep.run_to_store(plan(), path).damaged) == [name]
        equal_to_the_bit(load(path), whole)


def test_a_wrong_list_of_what_does_not_come_from_the_run_is_written_anew(whole, path):
    interrupted(path, UNITS)
    (path / "D/digests.json").write_text('{"array": "D", "crc32c": {"c/0": "00000000"}}')
    with pytest.raises(SceneError, match="D/c/0 is damaged"):
        load(path).load()
    mended(path, whole)


@pytest.mark.parametrize("damage", [cut, *slow(Path.unlink)])
def test_without_the_list_of_digests_the_checksums_remain(whole, path, damage):
    interrupted(path, UNITS)
    damage(path / "gamma/digests.json")
    cut(path / "gamma/c/0/0/0")
    with pytest.raises(SceneError, match="gamma/c/0/0/0 is damaged"):
        load(path).gamma.load()
    assert list(mended(path, whole).damaged) == ["gamma/c/0/0/0"]
    assert (path / "gamma/digests.json").is_file()


def test_what_a_killed_process_wrote_after_its_mark_is_no_damage(whole, path):
    """What a ball has once changes with each segment, and is written before the mark."""
    interrupted(path, PART)
    (path / "taken/c/0").write_bytes((path / "status/c/0").read_bytes())
    assert not mended(path, whole).damaged


def test_a_complete_store_that_is_mended_may_be_interrupted(whole, path):
    interrupted(path, UNITS)
    (path / "gamma/c/2/1/0").unlink()
    interrupted(path, 0)
    assert not opened(path).attrs["complete"]
    mended(path, whole)


def test_a_copy_that_another_program_writes_is_read(whole, path, tmp_path):
    interrupted(path, UNITS)
    load(path).load().to_zarr(tmp_path / "copy.zarr")
    equal_to_the_bit(load(tmp_path / "copy.zarr"), whole)
    is_refused_and_left(tmp_path / "copy.zarr")


@pytest.mark.parametrize("seed", [1, *slow(2)])
def test_a_run_that_is_killed_goes_on_and_has_the_same_bits(whole, tmp_path, seed, thorough, path, monkeypatch):
    """Meanwhile another writer is refused; the lock of the killed one is nobody's."""
    chance, states = random.Random(seed), set()
    for attempt in range(0 if thorough else 1, 4 if thorough else 2):
        before = marked(path)
        with child(path) as running:  # some units are left after four of these
            if attempt:  # later ones after they have done something; the first while it makes the store, or soon after
                until(lambda before=before: marked(path) != before, running)
                for fresh in (False, True):
                    with pytest.raises(BadInput, match=f"is being written by process {running.pid} on "):
                        sweep.run_to_store(plan(), path, fresh=fresh)
            time.sleep(chance.uniform(0, 0.1 if attempt else 0.3))
        if path.exists():
            left = opened(path)
            states.add(left.attrs["complete"])
            waiting = left.taken.values == -1
            assert np.isnan(left.momentum.values[waiting]).all() or not left.attrs["complete"]
            assert (left.status.values[waiting] == -1).all()
    done, real = [], sweep.advance
    monkeypatch.setattr(sweep, "advance", lambda *how: done.append(how) or real(*how))
    assert sweep.run_to_store(plan(), path).failed == (whole.status.values != 0).sum()
    assert len(done) < UNITS, "nothing was kept"
    assert False in states
    equal_to_the_bit(opened(path), whole)
    assert [p.name for p in tmp_path.iterdir()] == ["run.zarr"], "a killed creation was left"
    assert not list(path.rglob("*.partial"))


def test_every_moment_of_the_creation_may_be_the_last(whole, tmp_path, monkeypatch, path):
    """Each file operation of the stores, in turn, is the last thing that the process does."""
    operations = iter(range(100))

    class Killed(BaseException):
        pass

    for name in ("_fill", "_add_arrays", "consolidate"):
        real = getattr(stores, name)

        def killed(*args, real=real):
            real(*args)
            raise Killed

        with monkeypatch.context() as patched:
            patched.setattr(stores, name, killed)
            patched.setattr(stores.shutil, "rmtree", lambda *a, **k: None)  # a killed process tidies nothing
            patched.setattr(stores.os, "getpid", lambda: 2**22 + next(operations))  # of a process that is gone
            with pytest.raises(Killed):
                sweep.run_to_store(plan(), path)
        assert not path.exists()
        assert any(tmp_path.iterdir())
    sweep.run_to_store(plan(), path)
    assert [p.name for p in tmp_path.iterdir()] == ["run.zarr"]
    equal_to_the_bit(opened(path), whole)


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"scene": 'a = 1\nb = {c = "x"}'}, "another scene (b.c differs)"),
        ({"scene": "a = 1"}, "another scene (b differs)"),
        ({"steps": STEPS + 10}, "another plan"),
        ({"outputs": ("momentum",)}, "another plan"),
    ],
)
@pytest.mark.parametrize("meanwhile", [False, *slow(True)])
def test_a_store_of_another_run_is_not_touched(path, changed, words, meanwhile, monkeypatch):
    """Nor that which another process makes while this one begins."""
    scene, before, real = 'a = 1\nb = {c = "y"}', {}, stores.created

    def made(*how):
        monkeypatch.undo()
        interrupted(path, 3, plan(scene=scene))
        before.update({p: p.read_bytes() for p in path.rglob("*") if p.is_file()})
        return how and real(*how)

    if meanwhile:
        monkeypatch.setattr(stores, "created", made)
    else:
        made()
    with pytest.raises(SceneError, match="choose another name, or replace it with --fresh") as caught:
        sweep.run_to_store(plan(**({"scene": scene} | changed)), path)
    assert words in str(caught.value)
    assert {p: p.read_bytes() for p in path.rglob("*") if p.is_file()} == before


def test_versions_kernels_and_starts_are_not_mixed(path, monkeypatch):
    interrupted(path, 3)
    other = plan()
    other.members.momentum[0, 0] = np.nextafter(other.members.momentum[0, 0], 1)
    for wanted in (other, replace(plan(), task=replace(plan().task, time_step=0.02))):
        with pytest.raises(SceneError, match="other balls or starts"):
            sweep.run_to_store(wanted, path)
    monkeypatch.setattr(dataset, "_code_hash", lambda kernel: "0")
    with pytest.raises(SceneError, match="other kernels"):
        sweep.run_to_store(plan(), path)
    monkeypatch.setattr("chapsym.__version__", "0.0.9")
    with pytest.raises(SceneError, match="another version of chapsym"):
        sweep.run_to_store(plan(), path)


@pytest.mark.parametrize(("changed", "same"), [("Certificate of", True), ("return", False)])
def test_kernels_are_known_by_their_code_and_not_by_their_certificates(path, tmp_path, monkeypatch, changed, same):
    interrupted(path, 3)
    for kernel in TABLE:
        text = (files("chapsym.generated") / f"{kernel}.py").read_text(encoding="utf-8")
        (tmp_path / f"{kernel}.py").write_text(text.replace(changed, f"{changed} another"), encoding="utf-8")
    with monkeypatch.context() as patch:
        patch.setattr(dataset, "files", lambda package: tmp_path)
        dataset._code_hash.cache_clear()
        found = stores.difference(stores.attributes(path), dataset.provenance(plan()))
    dataset._code_hash.cache_clear()
    assert found == (None if same else "is of other kernels")


def test_a_comment_or_another_output_is_no_other_scene_and_what_is_half_written_goes(path):
    interrupted(path, 3, plan(scene="[run]\na = 1\n"))
    left = path / "momentum" / "c" / "0" / "0.5a.partial"
    left.parent.mkdir(parents=True, exist_ok=True)
    left.write_bytes(b"half")
    assert sweep.run_to_store(plan(scene="# Now.\n[run]\na = 1\noutput = 'run.zarr'"), path).complete
    assert not list(path.rglob("*.partial"))


@pytest.mark.parametrize("found", [{"chapsym_version": "0"}, {"chapsym_version": 0, "scene": 5}, [1], None])
def test_attributes_that_nobody_wrote_are_one_sentence(path, found):
    path.mkdir()
    (path / "zarr.json").write_text(json.dumps({"attributes": found}))
    with pytest.raises(SceneError, match=r"holds another scene|is no result of chapsym"):
        sweep.run_to_store(plan(), path)


def test_fresh_replaces_a_result_of_chapsym_only(whole, tmp_path, path):
    interrupted(path, 3, plan(outputs=("momentum",)))
    assert sweep.run_to_store(plan(), path, fresh=True).complete
    equal_to_the_bit(opened(path), whole)
    assert [p.name for p in tmp_path.iterdir()] == ["run.zarr"]
    other = tmp_path / "photos.zarr"
    other.mkdir()
    (other / "holiday.jpg").write_bytes(b"x")
    (tmp_path / "film.zarr").write_bytes(b"x")
    for fresh, place in product((False, True), (other, tmp_path / "film.zarr")):
        with pytest.raises(SceneError, match=r"zarr is there, but it is no result of chapsym; choose another name$"):
            sweep.run_to_store(plan(), place, fresh=fresh)
    assert (other / "holiday.jpg").read_bytes() == b"x"


def holding(**changed):
    """With other numbers than a mark has."""

    def rewritten(mark):
        with np.load(mark) as data:
            found = dict(data)
        np.savez(mark, **(found | changed))

    return rewritten


@pytest.mark.parametrize(
    "damage", [cut, holding(segments_done=99), holding(gamma=np.zeros((1, 3))), *slow(turned, emptied)]
)
def test_a_damaged_mark_is_named_and_costs_its_balls_only(whole, path, damage):
    interrupted(path, PART)
    mark = min(stores.folder_of(path).glob("chunk-*.npz"))
    damage(mark)
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        with pytest.raises(SceneError, match=f"{mark.name} is damaged; delete it") as caught:
            sweep.run_to_store(plan(), path)
        said = str(caught.value)
        del caught
        gc.collect(0)
    assert "\n" not in said
    assert not [w for w in warned if mark.name in str(w.message)], "the file is left open"
    mark.unlink()
    mended(path, whole)


def test_a_mark_of_before_has_no_checksums(whole, path):
    interrupted(path, PART)
    mark = min(stores.folder_of(path).glob("chunk-*.npz"))
    with np.load(mark) as data:
        found = dict(data)
    assert found.pop("digests").size
    np.savez(mark, **found)
    assert not mended(path, whole).damaged


@pytest.mark.parametrize(("place", "name", "call"), [(sweep, "advance", 5), (zarr.Array, "__setitem__", 0)])
def test_a_store_that_is_deleted_meanwhile_leaves_no_debris(tmp_path, monkeypatch, path, place, name, call):
    """Between two units, or in one, after its check and before its write."""
    real, calls = getattr(place, name), iter(range(1000))

    def deleting(*args):
        if path.exists() and next(calls) == call:
            path.rename(tmp_path / "gone")
        return real(*args)

    monkeypatch.setattr(place, name, deleting)
    with pytest.raises(SceneError, match="was deleted or moved while it was written"):
        sweep.run_to_store(plan(), path)
    assert not path.exists()
    check_ours(tmp_path / "gone")
    assert sweep.run_to_store(plan(), path).complete


def test_units_that_run_stop_when_another_ends_the_run(path, monkeypatch):
    others, stopped = threading.Event(), []

    def advance(wanted, chunk, state, segment, progress):
        if chunk.start == 0:
            assert others.wait(GUARD)
            raise KeyboardInterrupt
        others.set()
        try:
            for _ in range(50 * GUARD):
                time.sleep(0.02)
                progress(1)
        except Stopped:
            stopped.append(chunk)
            raise

    monkeypatch.setattr(sweep, "advance", advance)
    monkeypatch.setattr(sweep, "cores", lambda: 4)
    with pytest.raises(KeyboardInterrupt):
        sweep.run_to_store(plan(), path)
    assert stopped


def test_balls_without_an_answer_are_listed_and_the_others_go_on(whole, path, monkeypatch):
    real = sweep.advance

    def advance(wanted, chunk, *rest):
        if chunk.start == 8:
            raise BadInput("no answer here")
        return real(wanted, chunk, *rest)

    with monkeypatch.context() as patched:
        patched.setattr(sweep, "advance", advance)
        outcome = sweep.run_to_store(plan(), path)
        with pytest.raises(BadInput, match="no answer here"):
            sweep.run_in_memory(plan())
    assert outcome.lost == {(8, 10): "no answer here"}
    assert not outcome.complete
    found = opened(path)
    assert found.attrs["complete"] is False
    waiting = found.taken.values == -1
    assert waiting.tolist() == [i >= 8 for i in range(BALLS)]
    assert np.isnan(found.gamma.values[waiting]).all()
    assert np.isfinite(found.gamma.values[~waiting][:, 0]).all()
    assert (found.status.values[waiting] == -1).all()
    mended(path, whole)


def test_a_worker_that_is_late_changes_nothing(whole, path):
    """It writes its region again, when a later segment of its balls is done already."""
    wanted = plan()
    state = sweep.begin(wanted, wanted.chunks[1])
    columns, _ = sweep.advance(wanted, wanted.chunks[1], state, wanted.segments[0])
    assert sweep.run_to_store(wanted, path).complete
    Store(path, wanted).write(1, 0, columns)
    equal_to_the_bit(opened(path), whole)


def test_the_motion_goes_on_too_and_has_the_same_bits(path, monkeypatch):
    monkeypatch.setattr(plans, "CHUNK", 4)
    scene = BALL.replace("[3.0, -2.0,", "[{ linspace = [3.0, 30.0, 10] }, -6.0,")
    found = plan_from(f"{scene}time_step = 0.05\nsteps = 23\nevery = 5\noutputs = ['gamma', 'contact']\n")
    assert len(found.chunks) == 3
    alone = sweep.run_in_memory(found)
    assert alone["taken"].values.tolist() == [23] * 10
    assert alone["error"].max() <= 1e-6

    def end(progress):
        if progress.balls >= 4:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep.run_to_store(found, path, report=end)
    half = opened(path)
    assert 4 <= (half["order"].values != NOT_RUN).sum() < 10
    assert 0 < far(half)["motion"]["error"] <= 1e-6
    sweep.run_to_store(found, path)
    equal_to_the_bit(opened(path), alone)
