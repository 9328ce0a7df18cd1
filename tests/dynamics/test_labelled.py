"""A trajectory as a Dataset and as a table: the names, units and numbers of a result; what it shows of itself."""

import doctest
import sys
from fractions import Fraction

import numpy as np
import pytest

import chapsym
from chapsym.dynamics import results
from chapsym.extras import MissingExtra
from chapsym.scene import SceneError

TENSOR = [[0.006, 0.001, 0], [0.001, 0.007, 0], [0, 0, 0.009]]
BALL = chapsym.Ball.from_inertia(TENSOR, mass=2, radius=0.1)
START = {"omega": [3.0, -2.0, 1.0], "gamma": ["2/7", "3/7", "6/7"]}
OUTPUTS = ["momentum", "angular_momentum", "gamma", "attitude", "contact", "omega", "energy"]


def of_scene(**run):
    ball = {"inertia": TENSOR, "mass": 2.0, "radius": 0.1}
    given = {"time_step": 0.01, "steps": 20, "outputs": OUTPUTS, **run}
    return chapsym.run_scene({"ball": ball, "start": START, "run": given})


def rolled(**options):
    gamma = np.array([2, 3, 6]) / 7
    return chapsym.roll(BALL, START["omega"], 0.01, 20, gamma=gamma, attitude=True, contact=True, **options)


@pytest.mark.parametrize(
    ("run", "options"), [({}, {}), ({"map": True}, {"map": True}), ({"order": 4}, {"order": 4})], ids=str
)
def test_a_trajectory_is_labelled_as_the_result_of_a_scene(run, options):
    """Of the motion, of the map and of a composition, in axes that are not the principal ones."""
    wanted, result = of_scene(**run), rolled(**options)
    found = result.to_xarray()
    several = {"order", "substeps"}  # of a motion, which a scene alone says
    assert set(found.variables) == set(wanted.dataset.variables) - several
    for name in found.variables:
        ours, theirs = found[name], wanted.dataset[name]
        assert (ours.dims, ours.attrs.get("units")) == (theirs.dims, theirs.attrs.get("units")), name
        if ours.dtype.kind == "f" and name != "error":
            np.testing.assert_allclose(ours, theirs, rtol=1e-12, atol=1e-14, err_msg=name)
    assert found.momentum.attrs["units"] == ("kg m2" if run else "kg m2 s-1")
    table, other = result.to_pandas(), wanted.to_pandas()
    assert list(table) == list(other)
    assert table.attrs == other.attrs
    assert table.attrs["units"]["omega_3"] == "rad s-1"
    assert set(result.to_pandas(balls=True)) == set(wanted.to_pandas(balls=True)) - several
    np.testing.assert_array_equal(table["gamma_2"], result.gamma[:, 1])


def test_a_batch_is_one_axis_of_balls_and_where_one_stops_is_nan():
    ball, gamma = chapsym.Ball((0.1, 0.5, 1.6), 0.7, 0.1), (2 / 7, 3 / 7, 6 / 7)
    momentum = np.array([[(0.5, 0.3, 0.2), (1.44, 0.96, 0.3)]])
    run = chapsym.trajectory(ball, momentum, gamma, 60, time_step=0.1)
    data = run.to_xarray()
    assert data.ball.values.tolist() == ["ball 1", "ball 2"]
    assert data.taken.values.tolist() == run.taken.ravel().tolist()
    missing = data.step > data.taken
    assert missing.any()
    for name in ("momentum", "omega", "energy"):
        values = data[name] if "axis" not in data[name].dims else data[name].isel(axis=0)
        assert (np.isnan(values) == missing).all(), name
    table, balls = run.to_pandas(), run.to_pandas(balls=True)
    assert len(table) == 2 * 61
    assert balls["D"].tolist() == [0.7, 0.7]
    with pytest.raises(chapsym.BadInput, match="stopped early"):
        _ = run.omega


def test_digits_beyond_float64_are_kept():
    ball = chapsym.Ball((1, 2, 4), 3)
    start = (1, -0.5, 0.75), (2 / 7, 3 / 7, 6 / 7), 3
    pairs = chapsym.trajectory(ball, *start, precision="double-double", time_step=0.1)
    data = pairs.to_xarray()
    np.testing.assert_array_equal(data.momentum_low[0], pairs.low.momentum)
    assert "omega_low" not in data
    digits = chapsym.trajectory(ball, *start, precision=chapsym.Digits(40))
    assert digits.to_pandas()["momentum_1"].iloc[-1] == digits.momentum[-1, 0]
    single = chapsym.trajectory(ball, *start, precision="single")
    assert single.to_xarray().gamma.dtype == np.float64


def test_bounds_that_are_proved_are_kept():
    ball = chapsym.Ball((1, 2, 4), 3, 1.0)
    run = chapsym.trajectory(ball, (0.1, 0.05, 0), (0, 0, 1), 20, every=10, contact=True, time_step=0.1, proved=True)
    data = run.to_xarray()
    for name in ("momentum", "gamma", "attitude", "contact"):
        assert data[f"{name}_bound"].dims == ("ball", "frame")
        assert np.array_equal(data[f"{name}_bound"].values[0], getattr(run.proved, name))
    assert data.contact_bound.units == "m"
    assert data.contact_bound.long_name == (
        "contact point: a proved bound of the length of its error (of the sum with what it has beyond float64, if that"
        " is here)"
    )


def test_the_bound_of_a_rolled_ball_is_of_its_angular_momentum():
    ball = chapsym.Ball.from_inertia((0.006, 0.007, 0.009), mass=2.0, radius=0.1)
    run = chapsym.roll(ball, (3, -2, 1), 0.01, 20, proved=True)
    data, K = run.to_xarray(), run.angular_momentum()
    assert np.array_equal(data.momentum.values[0], K)
    rounded = np.vectorize(lambda k, x: float(Fraction(k) - Fraction(x) / Fraction(0.01)))(K, run.momentum)
    assert (data.momentum_bound.values[0] >= run.proved.momentum / 0.01 + np.linalg.norm(rounded, axis=1)).all()
    assert (data.momentum_bound.values[0] <= run.proved.momentum / 0.01 + 1e-15).all()


def test_in_n_dimensions_momentum_and_attitude_are_matrices():
    momentum = np.zeros((4, 4))
    momentum[0, 1], momentum[1, 3] = 0.3, 0.1
    run = chapsym.trajectory_n(chapsym.BallN((1, 2, 0.5, 3), 3), momentum - momentum.T, (0.1, 0.1, 0.7, 0.7), 4)
    assert run.to_xarray().momentum.dims == ("ball", "frame", "row", "column")
    assert {"momentum_1_2", "gamma_4"} <= set(run.to_pandas())
    run = chapsym.trajectory_n(chapsym.BallN((1, 2, 4), 3), chapsym.skew((0.1, 0.2, 0.3)), (0, 0, 1), 4, attitude=True)
    assert run.to_xarray().attitude.dims == run.to_xarray().momentum.dims == ("ball", "frame", "row", "column")
    assert {"attitude_3_3", "gamma_3"} <= set(run.to_pandas())


@pytest.mark.parametrize(("package", "method"), [("xarray", "to_xarray"), ("pandas", "to_pandas")])
def test_without_the_package_one_sentence_names_the_extra(monkeypatch, package, method):
    run = rolled()
    monkeypatch.setitem(sys.modules, package, None)
    words = (
        rf"^labelled results, and files .*, need {package}, which is not installed: pip install 'chapsym\[scenes\]'$"
    )
    with pytest.raises(MissingExtra, match=words):
        getattr(run, method)()


def test_what_is_returned_shows_itself_in_a_line():
    momentum, gamma = (1, -0.5, 0.75), (2 / 7, 3 / 7, 6 / 7)
    ball = chapsym.Ball((1, 2, 4), 3)
    assert repr(ball) == "Ball(mass_tensor=(1.0, 2.0, 4.0), D=3.0)"
    many = chapsym.Ball(np.ones((50, 3)), np.ones(50))
    branches, moments = chapsym.branches(ball, momentum, gamma), rolled().at(np.linspace(0, 0.2, 50))
    certified = chapsym.certify(chapsym.trajectory(ball, momentum, gamma, 50), bits=100)
    for one in (many, chapsym.step(many, momentum, gamma), branches, moments, certified):
        assert "\n" not in repr(one)
        assert len(repr(one)) < 400, repr(one)
    assert "mass_tensor=<50 × 3>" in repr(many)


def test_a_notebook_sees_the_trace_of_one_ball():
    text = rolled()._repr_html_()
    assert text.count("<polyline") == 1
    assert "<th>contact</th><td>0, 0</td>" in text
    assert "<polyline" not in chapsym.roll(BALL, [START["omega"]] * 2, 0.01, 5, contact=True)._repr_html_()
    assert "nan" not in chapsym.roll(BALL, (0, 0, 1), 0.01, 2, contact=True)._repr_html_()


def test_the_examples_of_its_docstrings_are_what_is_printed():
    found = doctest.testmod(results)
    assert found.failed == 0
    assert found.attempted > 5


def test_the_momentum_of_the_ball_and_that_of_the_map_have_names_of_their_own():
    """One state of one motion has one angular momentum, however often it is written down; 𝒦 is of the step."""
    names = ["angular_momentum", "momentum"]
    motion = [of_scene(time_step=step, steps=round(0.4 / step), outputs=names).dataset for step in (0.1, 0.05)]
    for data in motion:
        assert data["angular_momentum"].attrs["units"] == "kg m2 s-1"
        np.testing.assert_array_equal(data["angular_momentum"], data["momentum"])
        np.testing.assert_allclose(data["angular_momentum"][0, -1], motion[0]["angular_momentum"][0, -1], rtol=1e-5)
    for step in (0.1, 0.05):
        wanted = [*names, "discrete_momentum"]
        data = of_scene(time_step=step, steps=round(0.4 / step), outputs=wanted).dataset  # which asks for the map
        assert data["discrete_momentum"].attrs["units"] == "kg m2"
        np.testing.assert_array_equal(data["discrete_momentum"], data["momentum"])
        np.testing.assert_allclose(data["angular_momentum"] * step, data["momentum"], rtol=1e-15)
        np.testing.assert_allclose(data["angular_momentum"][0, 0], motion[0]["angular_momentum"][0, 0], rtol=1e-14)
    run = rolled(map=True)
    assert run.discrete_momentum is run.momentum
    with pytest.raises(SceneError, match=r"run\.accuracy is of the motion, and run\.outputs of the map"):
        of_scene(accuracy=1e-7, outputs=["discrete_momentum"])
