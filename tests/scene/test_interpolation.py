"""A result between its frames: as that of its trajectory, in the axes, units and names of the result."""

import numpy as np
import pytest
import results

import chapsym
from chapsym.dynamics import kernels
from chapsym.scene.result.interpolation import turning

AXES = np.array([0.8, 0.36, -0.48, 0.0])
TIMES = np.linspace(0.0, 1.0, 7)


def run():
    gamma = 2 / 7, 3 / 7, 6 / 7
    return chapsym.roll(results.UNEVEN, (3.0, -2.0, 1.0), 0.01, 100, every=10, gamma=gamma, contact=True)


def test_a_result_between_its_frames_is_its_trajectory_between_them():
    trajectory = run()
    dataset = results.of(trajectory, results.ALL)
    found, true = chapsym.interpolated(dataset, TIMES), chapsym.interpolated(trajectory, TIMES)
    for name in ("momentum", "gamma", "omega", "attitude", "contact"):
        assert found[name].values[0] == pytest.approx(getattr(true, name), abs=1e-15), name
        assert found[name].attrs == dataset[name].attrs
        assert found[name].dims == dataset[name].dims
    assert (found["time"].values == TIMES).all()
    assert found["step"].values == pytest.approx(100 * TIMES)
    assert "energy" not in found
    assert float(found["D"].values[0]) == results.UNEVEN.D
    assert chapsym.Result(dataset).at(0.5).sizes["frame"] == 1
    errors = {"accuracy": 1e-12, "accuracy_of": "contact", "discretisation": "{}", "proved": "{}"}
    found = chapsym.interpolated(dataset.assign(error=("ball", [1e-13])).assign_attrs(errors), TIMES)
    assert "error" not in found
    assert not errors.keys() & found.attrs.keys()


@pytest.mark.parametrize(
    "names",
    [("omega", "gamma"), ("omega", "attitude"), ("momentum", "gamma", "contact"), ("omega", "gamma", "contact")],
)
def test_some_of_the_outputs_are_enough(names):
    whole = results.of(run(), results.ALL)
    found = chapsym.interpolated(results.of(run(), names), TIMES)
    true = chapsym.interpolated(whole, TIMES)
    for name in names:
        # Of a contact point without attitude, one angle on the plane is fitted to what the frames say.
        assert found[name].values == pytest.approx(true[name].values, abs=1e-8 if name == "contact" else 1e-14), name


def test_given_axes_stay_those_of_the_result():
    plain = results.of(run(), results.ALL)
    turned = plain.copy(deep=True)
    for name in ("momentum", "gamma", "omega"):
        turned[name] = plain[name].dims, kernels.rotate(AXES, plain[name].values)
    back = AXES * [1.0, -1.0, -1.0, -1.0]
    attitude = kernels.compose(plain["attitude"].values, np.broadcast_to(back, (11, 4)))
    turned["attitude"] = plain["attitude"].dims, attitude
    turned["axes"] = ("ball", "quaternion"), AXES[np.newaxis]
    found, true = chapsym.interpolated(turned, TIMES), chapsym.interpolated(plain, TIMES)
    assert found["omega"].values == pytest.approx(kernels.rotate(AXES, true["omega"].values), abs=1e-14)
    assert found["contact"].values == pytest.approx(true["contact"].values, abs=1e-15)
    assert found["attitude"].values == pytest.approx(
        kernels.compose(true["attitude"].values, np.broadcast_to(back, (7, 4))), abs=1e-15
    )


def test_what_does_not_tell_its_motion_says_what_to_add():
    with pytest.raises(chapsym.BadInput, match='nothing between the frames: no γ: add "gamma"'):
        chapsym.interpolated(results.of(run(), ("contact",)), 0.5)
    with pytest.raises(chapsym.BadInput, match='no 𝒦 and no ω: add "momentum"'):
        chapsym.interpolated(results.of(run(), ("gamma",)), 0.5)
    with pytest.raises(chapsym.BadInput, match="three dimensions only"):
        chapsym.interpolated(results.four(4), 2)
    vertical = results.vertical(40)
    vertical["contact"] = ("ball", "frame", "plane"), np.zeros((1, 41, 2))
    vertical["radius"] = "ball", [0.1]
    assert "contact" not in chapsym.interpolated(vertical, 0.5)


def test_the_turning_between_frames_is_told_and_behind_a_stop_there_is_none():
    assert turning(results.bowling(100, every=10)) == pytest.approx(0.3, rel=0.05)
    dataset = results.folded()
    alone = turning(dataset.isel(ball=[1]))
    dataset["momentum"][1, int(dataset["taken"][1]) + 1 :] = 1e9
    assert turning(dataset.isel(ball=[1])) == alone
    assert turning(results.sweep(5)) is None
    assert np.isnan(chapsym.interpolated(dataset, 290.5)["gamma"].values[1]).all()
