"""The plan: what it follows, its units of work, and that a cut run is the whole one."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from rolled import rolled

import chapsym
from chapsym.dynamics import Status, kernels
from chapsym.dynamics.outputs import OUTPUTS, K, Output, columns_for, timed
from chapsym.generated import TABLE
from chapsym.scene.members.members import Members
from chapsym.scene.plan import plan as plans
from chapsym.scene.plan.models import MODELS, Chosen
from chapsym.scene.plan.plan import full, planned, predicted
from chapsym.scene.read.task import Task
from chapsym.scene.running import sweep

STATE = ("momentum", "gamma", "attitude", "contact", "omega", "energy", "integrals")
#: e1 -> e2 -> e3 -> e1, of three balls.
TURN = np.full((3, 4), 0.5)


def test_a_cut_run_is_the_whole_one_up_to_roundings(members):
    plan = planned(members(), Task(STATE, 1000, 10, 0.01))
    whole, end = rolled(plan, [slice(0, 101)])
    parts, also = rolled(plan, [slice(0, 1), slice(1, 40), slice(40, 100), slice(100, 101)])
    assert (end["taken"] == 1000).all()
    assert (also["taken"] == 1000).all()
    for name in STATE:  # a thousand steps of some roundings each, at random
        assert whole[name].shape == parts[name].shape
        assert np.abs(whole[name] - parts[name]).max() <= 100 * 2**-53 * max(np.abs(whole[name]).max(), 1)


def test_the_map_is_that_of_trajectory_to_the_bit_and_omega_and_the_energy_are_those_of_K(members):
    some = members()
    columns, _ = rolled(planned(some, Task(STATE, 100, 3, 0.01)))
    run = chapsym.trajectory(some.ball, some.momentum, some.gamma, 100, every=3, contact=True, time_step=0.01)
    for name in ("momentum", "gamma", "attitude", "contact"):
        assert (columns[name] == getattr(run, name)).all()
    assert (columns["energy"] == run.kinetic_energy()).all()
    omega, gamma, D = columns["omega"], columns["gamma"], some.ball.D[:, np.newaxis, np.newaxis]
    K = some.ball.inertia[:, np.newaxis] * omega + D * np.cross(gamma, np.cross(omega, gamma))
    assert np.abs(0.01 * K / columns["momentum"] - 1).max() < 1e-12
    assert np.abs((K * omega).sum(-1) / 2 / columns["energy"] - 1).max() < 1e-13


def test_what_float64_cannot_tell_is_refused():
    """A rod along the vertical, whose spin has no inertia."""
    rod = Members(np.array(["rod"]), chapsym.Ball([(0, 0, 1)], [1e17]), np.array([[0.1, 0.2, 0.3]]), np.eye(3)[2:])
    with pytest.raises(chapsym.BadInput, match="omega is beyond the range of float64"):
        rolled(planned(rod, Task(("omega",), 0, 1, 0.01)))


def test_only_what_is_asked_for_is_followed_and_kept(members):
    plan = planned(members(), Task(("energy",), 100, 1, 0.01))
    assert plan.needed == {"momentum", "gamma"}
    assert plan.numbers == 1
    assert set(rolled(plan)[0]) == {"energy"}
    state = sweep.begin(plan, slice(0, 3))
    assert not {"attitude", "contact"} & set(state)
    assert columns_for(("omega",), top=True) == {"momentum"}
    assert columns_for(("omega", "integrals"), top=True) == {"momentum", "gamma"}


@pytest.mark.parametrize("axes", [None, TURN], ids=["principal", "given"])
def test_a_ball_that_stops_is_NaN_from_there_on_and_says_why(members, axes):
    some = members(axes=axes)
    some.momentum[0] *= 26.25  # it folds at its 35th step
    plan = planned(some, Task(STATE, 50, 5, 0.01))
    columns, state = rolled(plan, [slice(0, 4), slice(4, 11)])
    assert state["status"].tolist() == [Status.FOLDED, Status.TAKEN, Status.TAKEN]
    assert state["taken"].tolist() == [35, 50, 50]
    for name in STATE:
        assert np.isnan(columns[name][0, 8:]).all()
        assert not np.isnan(columns[name][1:]).any()
        assert not np.isnan(columns[name][0, :8]).any()


def test_outputs_are_in_the_axes_that_were_given(members):
    some = members()
    plain, _ = rolled(planned(some, Task(STATE, 20, 1, 0.01)))
    turned, _ = rolled(planned(replace(some, axes=TURN), Task(STATE, 20, 1, 0.01)))
    for name in ("momentum", "gamma", "omega"):
        assert np.abs(turned[name] - plain[name][..., [2, 0, 1]]).max() <= 4 * 2**-53 * np.abs(plain[name]).max()
    for name in ("contact", "energy", "integrals"):
        assert (turned[name] == plain[name]).all()
    vertical = kernels.rotate(turned["attitude"], turned["gamma"])
    assert np.abs(vertical - [0, 0, 1]).max() < 1e-14
    in_space = kernels.rotate(turned["attitude"], turned["omega"])
    assert np.abs(in_space - kernels.rotate(plain["attitude"], plain["omega"])).max() < 1e-14


ONE_EACH = ("vertical_momentum", "momentum_squared", "gamma_squared")


def test_each_integral_is_a_variable_with_a_unit_of_its_own(members):
    """Of 𝒦 where the map is stepped, of K where the steps are chosen."""
    plan = planned(members(), Task((*ONE_EACH, "integrals"), 20, 1, 0.01))
    columns, _ = rolled(plan)
    assert plan.numbers == 6
    for i, name in enumerate(ONE_EACH):
        assert (columns[name] == columns["integrals"][..., i]).all()
    assert [OUTPUTS[name].attrs(3, False)["units"] for name in ONE_EACH] == ["kg m2", "kg2 m4", "1"]
    assert [OUTPUTS[name].attrs(3, True)["units"] for name in ONE_EACH] == ["kg m2 s-1", "kg2 m4 s-2", "1"]
    assert OUTPUTS["integrals"].attrs(3, True)["units"] == "kg m2 s-1, kg2 m4 s-2, 1"


def test_the_units_of_work_hold_each_ball_and_frame_once(members, monkeypatch):
    monkeypatch.setattr(plans, "CHUNK", 4)
    monkeypatch.setattr(plans, "UNIT_NUMBERS", 4 * 7 * 10)
    plan = planned(members(10), Task(("momentum", "attitude"), 95, 1))
    balls = np.concatenate([np.arange(10)[chunk] for chunk in plan.chunks])
    frames = np.concatenate([np.arange(96)[segment] for segment in plan.segments])
    assert balls.tolist() == list(range(10))
    assert frames.tolist() == list(range(96))
    assert max(s.stop - s.start for s in plan.segments) == 10


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.name)
def test_models_name_kernels_that_there_are_and_columns_that_are_outputs(model):
    assert {kernel for of in model.kernels.values() for kernel in of} <= set(TABLE)
    assert set(model.kernels) <= model.columns
    assert model.columns <= {name for name, output in OUTPUTS.items() if output.derive is None}


@pytest.mark.parametrize("name", OUTPUTS)
def test_what_an_output_is_made_of_is_there(name):
    one = OUTPUTS[name]
    assert set(one.kernels) <= set(TABLE)
    assert one.needs <= {*OUTPUTS, K}
    assert one.with_D <= one.needs
    assert bool(one.needs) == (one.derive is not None)
    units = one.attrs(3, motion=False)["units"]
    assert timed(name) == any(part.startswith(("s", "J", "W")) for part in units.split())


@pytest.mark.parametrize("name", [name for name, one in OUTPUTS.items() if one.derive])
def test_a_derived_output_is_that_of_another_formula(name):
    """One that has no row here has no value that was compared with anything."""
    J, D, momentum, g = np.array([1.0, 2.0, 4.0]), 3.0, np.array([0.5, -0.25, 0.75]), np.array([2.0, 3.0, 6.0]) / 7
    angular = np.array([3.0, 1.0, -2.0])
    omega = np.linalg.solve(np.diag(J.sum() - J) + D * (np.eye(3) - np.outer(g, g)), angular)
    vertical, squared = momentum @ g, momentum @ momentum
    meant = {
        "omega": omega, "energy": omega @ angular / 2, "angular_momentum": angular, "discrete_momentum": momentum,
        "integrals": [vertical, squared, 1], "vertical_momentum": vertical, "momentum_squared": squared,
        "gamma_squared": 1,
    }  # fmt: skip
    found = OUTPUTS[name].derive(J, np.array(D), {K: angular, "momentum": momentum, "gamma": g, "omega": omega})
    np.testing.assert_allclose(found, meant[name], rtol=1e-14)


def test_an_output_is_added_by_one_record(members, monkeypatch):
    """⟨ω,γ⟩, which models are not known to: its unit, its columns, and that it needs times, are of its record."""
    spin = Output(
        "spin ⟨ω,γ⟩", "rad s-1", needs=frozenset({"omega", "gamma"}),
        derive=lambda J, D, given: (given["omega"] * given["gamma"]).sum(axis=-1),
    )  # fmt: skip
    monkeypatch.setitem(OUTPUTS, "spin", spin)
    with pytest.raises(chapsym.BadInput, match=r"spin needs run\.time_step, in seconds"):
        planned(members(), Task(("spin",), 5))
    plan = planned(members(), Task(("spin", "omega", "gamma"), 20, 1, 0.01))
    assert plan.needed == {"momentum", "gamma"}
    assert "angular_velocity" in plan.kernels()
    data = sweep.run_in_memory(plan)
    assert data.spin.dims == ("ball", "frame")
    assert data.spin.attrs == {"units": "rad s-1", "long_name": "spin ⟨ω,γ⟩"}
    assert (data.spin.values == (data.omega.values * data.gamma.values).sum(axis=-1)).all()
    assert "spin" in full(plan).task.outputs
    turned = members(axes=TURN)
    also = sweep.run_in_memory(planned(turned, Task(("spin",), 20, 1, 0.01)))
    assert (also.spin.values == data.spin.values).all()
    faster = members()
    faster.momentum[0] *= 26.25
    stopped = sweep.run_in_memory(planned(faster, Task(("spin",), 50, 5, 0.01))).spin.values
    assert np.isnan(stopped[0, 8:]).all()
    assert not np.isnan(stopped[1:]).any()


def test_the_pages_list_each_output():
    pages = Path(__file__).parents[2] / "docs" / "reference"
    (row,) = re.findall(r"^\| `outputs` \| \| a list of: (.*); default", (pages / "scenes.md").read_text("utf-8"), re.M)
    assert sorted(re.sub(r" \(.*?\)", "", row).split(", ")) == sorted(OUTPUTS)
    assert {*OUTPUTS} <= {*re.findall(r"^\| `(\w+)` \|", (pages / "results.md").read_text("utf-8"), re.M)}


def test_an_output_of_three_dimensions_is_refused_in_four(monkeypatch):
    ball = chapsym.BallN(np.array([[1.0, 2.0, 3.0, 4.0]]), np.array([3.0]))
    four = Members(("1",), ball, np.zeros((1, 4, 4)), np.array([[0.0, 0.0, 0.0, 1.0]]))
    with pytest.raises(chapsym.BadInput, match="energy is known in three dimensions only"):
        planned(four, Task(("energy",), 5, 1, 0.01))


@pytest.mark.parametrize(
    ("outputs", "sentence"),
    [
        (("speed",), "'speed' is no output; choose of momentum, gamma"),
        (("omega",), r"omega needs run\.time_step"),
        (("contact",), "needs the radius"),
    ],
)
def test_what_cannot_be_had_is_told(members, outputs, sentence):
    with pytest.raises(chapsym.BadInput, match=sentence):
        planned(members(radius=False), Task(outputs, 5))


def test_what_is_chosen_for_each_ball_has_an_error_and_its_place(members):
    """That the error is one, test_motion.py sees."""
    some = members(2)
    some = replace(some, momentum=some.momentum / 0.01, place=np.array([[1.0, 0.0]] * 2))
    task = Task(("contact", "momentum"), 4, accuracy=1e-7, time=2.0, of="contact", searched=True)
    assert planned(some, task).model.name == "motion of the ball"
    assert planned(some, replace(task, accuracy=1e-14)).chunks == [slice(0, 1), slice(1, 2)]
    plan = replace(planned(some, task), model=Chosen())
    for chunk in plan.chunks:
        (segment,) = plan.segments
        columns, state = sweep.advance(plan, chunk, sweep.begin(plan, chunk), segment)
        assert columns["contact"].shape == (1, 5, 2)
        assert state["error"][0] <= 1e-7
        assert (columns["contact"][0, 0] == [1, 0]).all()


def test_a_cost_is_nominal_and_grows_with_steps_digits_and_dimensions(members):
    def seconds(some, *task, **also):
        return predicted(planned(some, Task(("momentum",), *task, **also)))

    few, many = (seconds(members(1), steps) for steps in (10**5, 10**7))
    assert 0.1 < many < 1.0
    assert 90 < many / few < 100
    assert seconds(members(1), 10**5, precision="double-double") > 3 * few
    assert seconds(members(1), 10**5, order=4) > 2.5 * few
    for n, step in ((4, 2.6e-6), (8, 1e-5)):  # as measured, of one ball
        ball = chapsym.BallN(np.arange(1.0, n + 1)[np.newaxis], np.array([3.0]))
        high = Members(("1",), ball, np.zeros((1, n, n)), np.eye(n)[-1:])
        assert seconds(high, 10) / 10 == pytest.approx(step, rel=0.5)


def test_31_digits_are_refused_in_other_axes(members):
    turned = members(axes=TURN)
    with pytest.raises(chapsym.BadInput, match="31 digits are kept in principal axes only"):
        planned(turned, Task(("momentum",), 5, precision="double-double"))
    assert planned(members(), Task(("momentum",), 5, precision="double-double")).model.name == "reduced map"
