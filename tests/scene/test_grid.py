"""A sweep as a grid: each value of a range at its place, whatever the format it was read from."""

import itertools
from copy import deepcopy

import numpy as np
import pytest
from budget import slow

import chapsym
from chapsym.scene import SceneError

SCENE = {
    "ball": {"inertia": [0.006, 0.007, 0.009], "mass": {"linspace": [2.0, 3.0, 3]}, "radius": 0.1},
    "start": {"omega": [{"grid": [3.0, 4.0]}, {"normal": [-2.0, 0.1]}, 1.0]},
    "sweep": {"samples": 2},
    "run": {"time_step": 0.01, "steps": 4, "outputs": ["contact", "energy"]},
}


def scene(**changed):
    return deepcopy(SCENE) | changed


@pytest.mark.parametrize("suffix", [None, ".csv", ".zarr", *slow(".nc", ".parquet", ".npz")])
def test_every_ball_is_at_the_place_of_its_values(tmp_path, suffix):
    result = chapsym.run_scene(SCENE)
    if suffix is not None:
        result.save(tmp_path / f"a{suffix}")
        result = chapsym.open_result(tmp_path / f"a{suffix}")
    found, flat = result.grid(), result.dataset
    assert found.energy.dims == ("ball.mass", "start.omega.1", "sample", "frame")
    assert found.contact.dims[-2:] == ("frame", "plane")
    assert dict(found.sizes) == {"ball.mass": 3, "start.omega.1": 2, "sample": 2, "frame": 5, "plane": 2, "axis": 3}
    assert found["ball.mass"].values.tolist() == [2.0, 2.5, 3.0]
    assert found["ball.mass"].attrs == {"units": "kg", "long_name": "ball.mass"}
    for i, (mass, omega, sample) in enumerate(itertools.product([2.0, 2.5, 3.0], [3.0, 4.0], [0, 1])):
        one, same = found.sel({"ball.mass": mass, "start.omega.1": omega}).isel(sample=sample), flat.isel(ball=i)
        assert one.name.item() == same.ball.item()
        for name in ("energy", "contact", "taken", "mass_tensor", "D", "start.omega.1", "start.omega.2", "ball.mass"):
            assert (one[name].values == same[name].values).all(), name
            assert one[name].attrs == same[name].attrs, name
    assert found.attrs == flat.attrs
    assert found.sel(time=0.021, method="nearest").step == 2


def test_balls_with_the_same_ranges_are_a_dimension_and_what_is_not_varied_is_none():
    two = [{**SCENE["ball"]}, {**SCENE["ball"], "name": "b"}]
    found = chapsym.run_scene(scene(ball=two)).grid()
    assert found.energy.dims == ("ball", "ball.mass", "start.omega.1", "sample", "frame")
    assert found.ball.values.tolist() == ["ball 1", "b"]
    assert found.sel(ball="b").name.values.flat[0] == "b 1"
    fixed = {"ball": {**SCENE["ball"], "mass": 2.0}, "start": {"omega": [3.0, -2.0, 1.0]}, "run": SCENE["run"]}
    one = chapsym.run_scene(fixed)
    assert one.grid().energy.dims == ("frame",)
    assert np.array_equal(one.grid().energy, one.dataset.energy[0])


def test_what_makes_no_grid_is_one_sentence():
    result = chapsym.run_scene(SCENE)
    for data, words in (
        (result.dataset.isel(ball=slice(5)), "a part of the sweep"),
        (result.dataset.isel(ball=slice(None, None, -1)), "a part of the sweep"),
        (result.dataset.assign_attrs(scene=""), "does not say of which scene"),
        (result.dataset.assign_attrs(scene="{"), "no scene"),
    ):
        with pytest.raises(SceneError, match=words):
            chapsym.Result(data).grid()
    two = [{**SCENE["ball"]}, {**SCENE["ball"], "mass": 2.0}]
    with pytest.raises(SceneError, match="different ranges"):
        chapsym.run_scene(scene(ball=two)).grid()
