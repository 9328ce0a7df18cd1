"""Results in NetCDF, CSV and Parquet: the same bits when they are read back, whole files, one sentence of refusal."""

import gc
import json
import os
import re
import warnings
import zipfile
from pathlib import Path

import numpy as np
import pandas
import pytest
import xarray
from budget import slow
from first import BALL, FIRST
from small_units import BALLS, OUTPUTS, equal_to_the_bit, plan

from chapsym.dynamics import BadInput
from chapsym.scene import SceneError, load
from chapsym.scene.plan.plan import plan_from, plan_of
from chapsym.scene.result import formats, summary
from chapsym.scene.running import sweep
from chapsym.show.drawing import reading
from chapsym.show.result import Result

FILES = [".nc", ".csv", ".parquet", ".npz"]


@pytest.fixture(scope="module")
def result():
    """Balls with failures, every output, other axes; names and numbers that a format may spoil."""
    data = sweep.run_in_memory(plan(OUTPUTS, scene='# Two\n# lines, "quoted"\na = 1\n'))
    names = data.ball.values.copy()
    names[:6] = ["nan", 'a,"b"', " blank ", "# hash", "two\nlines", "1e5"]
    data["momentum"][0, 1] = [-0.0, 5e-324, 1.7976931348623157e308]
    data["energy"][1] = 3.0  # a column that looks like integers
    data["D"].values = np.where(np.arange(BALLS) < 3, np.inf, np.nan)  # what JSON has no numbers for
    return data.assign_coords(ball=names)


def check_formats(data, folder, suffixes=FILES):
    """Each file has the same bits."""
    for suffix in suffixes:
        formats.save(data, folder / f"run{suffix}")
        equal_to_the_bit(formats.load(folder / f"run{suffix}"), data.load())


@pytest.mark.parametrize("suffix", FILES)
def test_a_result_comes_back_to_the_bit(result, tmp_path, suffix):
    path = tmp_path / f"run{suffix}"
    formats.save(result, path)
    found = formats.load(path)
    equal_to_the_bit(found, result)
    assert found.attrs == result.attrs
    assert {n: v.dims for n, v in found.variables.items()} == {n: v.dims for n, v in result.variables.items()}
    assert set(found.coords) == set(result.coords)
    assert [p.name for p in tmp_path.iterdir()] == [path.name]
    first = path.read_bytes()
    formats.save(found, path)
    assert path.read_bytes() == first


@pytest.mark.parametrize("balls", [1, BALLS])
def test_a_run_is_written_alike_with_and_without_xarray(tmp_path, balls):
    """And its summary is the same; the balls are in other axes than the principal ones, and some stop."""
    wanted = plan(OUTPUTS, n=balls)
    alone, labelled = sweep.run(wanted), sweep.run_in_memory(wanted)
    for suffix in FILES:
        for name, data in (("alone", alone), ("labelled", labelled)):
            formats.save(data, tmp_path / f"{name}{suffix}")
        if suffix != ".nc":  # HDF5 writes times, too
            assert (tmp_path / f"alone{suffix}").read_bytes() == (tmp_path / f"labelled{suffix}").read_bytes()
        equal_to_the_bit(formats.load(tmp_path / f"alone{suffix}"), labelled)
    assert summary.stopped(alone) == summary.stopped(labelled)
    assert summary.last_state(alone) == summary.last_state(labelled)
    more = alone.assign_attrs({"proved": "{}"})
    assert (more.attrs, list(alone)) == (labelled.attrs | {"proved": "{}"}, list(labelled))


def test_plain_readers_have_the_same_numbers(result, tmp_path):
    for suffix in FILES:
        formats.save(result.isel(ball=slice(6, None)), tmp_path / f"run{suffix}")
    exactly = {} if int(pandas.__version__.split(".")[0]) >= 3 else {"float_precision": "round_trip"}
    table = pandas.read_csv(tmp_path / "run.csv", **exactly)
    assert list(table.columns[:4]) == ["ball", "step", "time", "start.omega.1"]
    wanted = result.isel(ball=slice(6, None))
    for frame in (table, pandas.read_parquet(tmp_path / "run.parquet")):
        np.testing.assert_array_equal(frame["momentum_2"].to_numpy().reshape(4, 22), wanted.momentum.sel(axis="2"))
        np.testing.assert_array_equal(frame["attitude_w"].to_numpy().reshape(4, 22), wanted.attitude[..., 0])
        assert frame["ball"].iloc[-1] == "ball 9"
    notes = json.loads(table["chapsym"][22 * 3])
    assert notes["taken"] == wanted.taken[3]
    assert notes["mass_tensor"] == wanted.mass_tensor[3].values.tolist()
    assert set(table["chapsym"][22 * 3 + 1 : 22 * 4]) == {"-"}
    with xarray.open_dataset(tmp_path / "run.nc", engine="h5netcdf") as found:
        xarray.testing.assert_equal(found.load(), wanted)


def test_what_is_too_large_is_told_before_it_is_run(tmp_path, monkeypatch):
    wanted = plan(("momentum",))
    monkeypatch.setattr(formats, "MOST_ROWS", BALLS * 22 - 1)
    with pytest.raises(SceneError, match=r"220 rows.*\.parquet or \.zarr"):
        formats.check_size(wanted, tmp_path / "run.csv")
    formats.check_size(wanted, tmp_path / "run.parquet")
    monkeypatch.setattr(formats, "_memory", lambda: 4.0 * wanted.bytes - 1)
    for suffix in (".nc", ".parquet"):
        with pytest.raises(SceneError, match=r"GB, which is too much .* write to \.zarr"):
            formats.check_size(wanted, tmp_path / f"run{suffix}")
    formats.check_size(wanted, tmp_path / "run.zarr")
    monkeypatch.setattr(formats, "MOST_ROWS", 100)
    with pytest.raises(SceneError, match="220 rows, and a CSV of more than 100"):
        formats.save(sweep.run_in_memory(wanted), tmp_path / "run.csv")


@pytest.mark.parametrize("suffix", FILES)
def test_a_damaged_file_is_one_sentence(result, tmp_path, suffix):
    path = tmp_path / f"run{suffix}"
    formats.save(result, path)
    content = path.read_bytes()
    for damaged in (content[: len(content) // 2], b"", b"\x00\xff" * 500):
        path.write_bytes(damaged)
        with pytest.raises(SceneError, match=rf"run\{suffix} (is damaged|cannot be read)") as caught:
            formats.load(path)
        assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("name", "change", "said"),
    [
        ("momentum", lambda one: one.astype(complex), "momentum has no real numbers"),
        ("gamma", lambda one: one.astype(str), "gamma has no real numbers"),
        ("D", lambda one: one.astype(bool), "D has no real numbers"),
        ("energy", lambda one: one.isel(ball=0, drop=True), "energy lacks the dimension ball"),
        ("time", lambda one: one[0].drop_vars("time"), "[a-z]* lacks the dimension frame"),
    ],
)
def test_parts_that_have_no_numbers_or_other_dimensions_are_refused(tmp_path, monkeypatch, name, change, said):
    scene = f"{BALL}time_step = 0.01\nsteps = 2\noutputs = ['energy', 'momentum', 'gamma']\n"
    data = sweep.run(plan_from(scene)).dataset()
    (tmp_path / "run.nc").touch()
    monkeypatch.setitem(formats._READERS, ".nc", lambda path: data.assign({name: change(data[name])}))
    with pytest.raises(SceneError, match=f"is damaged, or no result of chapsym: {said}"):
        formats.load(tmp_path / "run.nc")


def test_a_heap_of_hdf5_that_has_no_end_is_refused(result, tmp_path):
    """HDF5 goes round in it for ever, deaf to an interrupt."""
    path = tmp_path / "run.nc"
    formats.save(result, path)
    data = bytearray(path.read_bytes())
    first = data.index(formats.HEAP) + 16
    data[first : first + 600] = bytes(600)
    path.write_bytes(data)
    with pytest.raises(SceneError, match="or no result of chapsym: a heap of HDF5 has an object of no size"):
        formats.load(path)


@pytest.mark.parametrize(
    ("shape", "said"),
    [("(2, (2,    ", "is damaged, or no result"), ("(10000000000000,)", "does not fit into memory|is damaged")],
)
def test_a_header_of_numpy_that_is_damaged_is_refused(tmp_path, shape, said):
    path = tmp_path / "run.npz"
    formats.save(sweep.run(plan_from(f"{BALL}time_step = 0.01\nsteps = 2\n")), path)
    with zipfile.ZipFile(path) as old:
        parts = {name: old.read(name) for name in old.namelist()}
    header = b"{'descr': '<f8', 'fortran_order': False, 'shape': " + shape.encode() + b"}\n"
    parts["D.npy"] = b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header
    with zipfile.ZipFile(path, "w") as new:
        for name, content in parts.items():
            new.writestr(name, content)
    with pytest.raises(SceneError, match=said):
        formats.load(path)


@pytest.fixture
def parts(result, tmp_path):
    """An .npz, its arrays, and what one of them says of the others."""
    path = tmp_path / "run.npz"
    formats.save(result, path)
    with np.load(path) as data:
        arrays = dict(data)
    return path, arrays, json.loads(str(arrays["chapsym"]))


def test_what_a_file_says_of_its_arrays_must_fit_and_what_a_reader_trips_over_is_not_repeated(parts):
    path, arrays, about = parts
    rank, accuracy, structure = (json.loads(json.dumps(about)) for _ in range(3))
    accuracy["attrs"]["accuracy"], structure["structure"]["variables"] = [1e-6], None
    for said, words, changed in (
        (accuracy, "its accuracy is no number", {}),
        (rank, "taken has 2 axes, not ball", {"taken": arrays["taken"][..., np.newaxis]}),
        (structure, r"or no result of chapsym: its parts are not those of a result$", {}),
    ):
        np.savez(path, **(arrays | changed | {"chapsym": np.array(json.dumps(said))}))
        with pytest.raises(SceneError, match=words):
            formats.load(path)


def test_what_is_no_result_is_not_read(tmp_path, result):
    """A pipe is not waited for."""
    for suffix in (*FILES, ".zarr"):
        with pytest.raises(SceneError, match=r"run\.\w+ cannot be read: No such file"):
            formats.load(tmp_path / f"run{suffix}")
    os.mkfifo(tmp_path / "run.nc")
    with pytest.raises(SceneError, match="is a pipe, not a file"):
        formats.load(tmp_path / "run.nc")
    with pytest.raises(SceneError, match="is no result: one ends in"):
        formats.load(tmp_path / "run.txt")
    with pytest.raises(SceneError, match="a result is written to"):
        formats.save(result, tmp_path / "run.xlsx")


@pytest.mark.filterwarnings("error")
def test_a_group_that_lacks_all_is_told_without_a_warning(tmp_path):
    (tmp_path / "run.zarr").mkdir()
    about = {"attributes": {"chapsym_version": "0"}, "zarr_format": 3, "node_type": "group"}
    (tmp_path / "run.zarr" / "zarr.json").write_text(json.dumps(about))
    with pytest.raises(BadInput, match='no dimension "frame"'):
        reading.with_balls(formats.load(tmp_path / "run.zarr"))


OLD = Path(__file__).parent / "old"


def test_pandas_reads_a_long_table_as_numbers_without_a_warning(tmp_path):
    """What a ball has once is not repeated, and no column changes its kind on the way."""
    scene = load(OLD / "scene.toml").with_run(steps=9_000, every=1, outputs=["momentum", "gamma"])
    formats.save(sweep.run_in_memory(plan_of(scene)), tmp_path / "run.csv")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        table = pandas.read_csv(tmp_path / "run.csv")
    assert len(table) == 9_001
    assert {name for name in table if table[name].dtype.kind not in "fi"} == {"ball", "chapsym"}
    assert not {"D", "mass_tensor_1", "radius", "taken"} & set(table)


@pytest.mark.parametrize("name", ["run.npz", "run.csv", "lines.csv"])
def test_the_old_files_of_one_ball_are_still_read(name):
    """Written by chapsym 0.1.0 before it had one form for all: vectors from 0, no word of where they come from.

    And a CSV with `# ` lines, as it was written later.
    """
    found, whole = formats.load(OLD / name), sweep.run_in_memory(plan_of(load(OLD / "scene.toml")))
    for name in ("momentum", "gamma", "contact"):
        assert found[name].dims == whole[name].dims
        for dim in {"axis", "plane"} & set(whole[name].coords):
            assert (found[dim] == whole[dim]).all()
        np.testing.assert_allclose(found[name], whole[name], rtol=1e-13)  # the last bits are of the processor
    assert found.momentum.values[0, 0].tolist() == [0.5, -0.25, 0.125]
    assert (found.time.values == whole.time.values).all()
    assert found.taken.values == whole.taken.values
    if name == "lines.csv":
        assert set(found.variables) == set(whole.variables)
        assert found.attrs["scene"] == whole.attrs["scene"]


@pytest.mark.parametrize("suffix", [".csv", ".zarr", *slow(None, ".nc", ".parquet", ".npz")])
def test_a_frame_is_found_by_its_time_in_memory_and_from_every_format(tmp_path, suffix):
    """And what was chosen by time can be saved."""
    wanted = plan(("momentum",), n=4)
    if suffix is None:
        found = sweep.run_in_memory(wanted)
    elif suffix == ".zarr":
        sweep.run_to_store(wanted, tmp_path / "run.zarr")
        found = formats.load(tmp_path / "run.zarr")
    else:
        formats.save(sweep.run_in_memory(wanted), tmp_path / f"run{suffix}")
        found = formats.load(tmp_path / f"run{suffix}")
    assert "time" in found.xindexes  # newer xarrays find it without
    assert found.sel(time=1.04, method="nearest").step == 100
    part = found.sel(time=slice(0.95, 1.95))
    assert part.step.values.tolist() == list(range(100, 200, 10))
    Result(part).save(tmp_path / f"part{suffix or '.nc'}")
    equal_to_the_bit(formats.load(tmp_path / f"part{suffix or '.nc'}").load(), part.load())


def test_without_times_a_frame_is_found_by_its_step():
    data = sweep.run_in_memory(plan_of(load(OLD / "scene.toml").with_run(time_step=None)))
    assert "step" in data.xindexes
    assert data.sel(step=5, method="nearest").step in (4, 6)
    assert "time" not in data.coords


KINDS = {
    "double-double": 'time_step = 0.01\nsteps = 20\noutputs = ["momentum", "attitude", "contact"]'
    '\nprecision = "double-double"',
    "single": 'time_step = 0.01\nsteps = 20\noutputs = ["gamma", "energy"]\nprecision = "single"',
    "accuracy": 'time = 1.0\naccuracy = 1e-7\nframes = 4\noutputs = ["momentum", "contact"]',
    "start": "time_step = 0.01\nsteps = 0",
    "every": "time_step = 0.01\nsteps = 7\nevery = 5",
    **{name: (FIRST.parent / "scenes" / f"{name}.toml").read_text(encoding="utf-8") for name in ("vertical", "four")},
}


@pytest.mark.parametrize("kind", ["double-double", "single", "accuracy", "four", *slow("start", "every", "vertical")])
def test_every_kind_of_run_comes_back_from_every_format(tmp_path, kind):
    wanted = plan_from(KINDS[kind] if "[ball]" in KINDS[kind] else BALL + KINDS[kind])
    data = sweep.run_in_memory(wanted)
    sweep.run_to_store(wanted, tmp_path / "run.zarr")
    stored = formats.load(tmp_path / "run.zarr")
    check_formats(stored, tmp_path)
    equal_to_the_bit(stored.load(), data)
    if kind == "four":
        assert data.momentum.dims == ("ball", "frame", "row", "column")
        assert data.integral.values.tolist() == ["tr K^2", "tr K^4", "gamma.K^2.gamma", "gamma.gamma"]
    if kind == "double-double":
        assert (data.contact_low.values[0, 1:] != 0).all()
        assert (abs(data.contact_low.values) <= 2.0**-53 * abs(data.contact.values)).all()
    if kind == "accuracy":
        assert data.momentum.attrs["units"] == "kg m2 s-1"
        assert data.time.values.tolist() == [0, 0.25, 0.5, 0.75, 1.0]
        assert 0 < data.error.values[0] <= 1e-7
        assert "step" not in data.coords
    if kind == "vertical":
        assert data.rotation_number.dims == ("ball",)
        assert np.isfinite(data.phase.values).all()


def test_numbers_that_look_like_others_keep_their_type_in_batches_too(result, tmp_path, monkeypatch):
    """Names that are numbers, floats that are whole, and a column of -0.0, which as integers would lose its sign."""
    data = result.copy(deep=True).assign_coords(ball=np.array([f"0{i}" for i in range(BALLS)], dtype=object))
    data["energy"][:] = -0.0
    data["omega"][:] = 7.0
    check_formats(data, tmp_path)
    monkeypatch.setattr("chapsym.dynamics.labelled.ROWS", 100)
    check_formats(data, tmp_path, (".csv", ".parquet"))


@pytest.mark.parametrize(
    "text",
    [
        "RAI,RAI,RAI,0,1\n1,2,3,4,5\n",
        "mass_A\nt;x;y\n0;1;2\n",
        "0.0 0.0 -0.0 0.06\n",
        "# time_step = 0.001\ntime,x,y\n0,0,0\n",
        "# made by: an engine\nstep,x\n0,0\n",
    ],
)
def test_a_table_of_another_program_is_answered_by_the_command_that_reads_it(tmp_path, text):
    path = tmp_path / "other.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(SceneError, match="it has no column chapsym; chapsym show and chapsym judge"):
        formats.load(path)


def test_a_file_that_is_no_netcdf_is_refused_without_a_traceback(tmp_path, capfd):
    """h5netcdf prints one of its own where HDF5 does not open the file."""
    path = tmp_path / "one.nc"
    path.write_bytes(b"CDF\x01 and no more")
    with pytest.raises(SceneError, match="is damaged, or no result of chapsym"):
        formats.load(path)
    gc.collect(0)
    assert capfd.readouterr() == ("", "")


def test_a_sentence_is_not_as_long_as_what_is_wrong_in_a_file(tmp_path):
    path = tmp_path / "one.csv"
    formats.save(sweep.run(plan_from(f"{BALL}time_step = 0.01\nsteps = 2\n")), path)
    path.write_text(re.sub(r"(?m)^ball,2,", f"ball,{'9' * 5000},", path.read_text()))
    with pytest.raises(SceneError) as refused:
        formats.load(path)
    assert len(str(refused.value)) < 500
