"""How far the map is from the motion of the ball, against an independent integration of that motion."""

import json
from dataclasses import asdict

import numpy as np
import pytest
from commands import chapsym as command
from scipy.integrate import solve_ivp
from vectors import cross

import chapsym
from chapsym.accuracy.discretisation import MOST, Discretisation, discretisation, read
from chapsym.dynamics import Status, kernels

BALLS = chapsym.Ball.from_inertia(((0.006, 0.007, 0.009), (0.03, 0.0312, 0.0318)), mass=(2.0, 7.0), radius=(0.1, 0.11))
OMEGA = np.array([[14.0, -6.0, 3.0], [2.0, 60.0, 5.0]])
GAMMA = np.array([[2.0, 3.0, 6.0], [-6.0, 2.0, 3.0]]) / 7
K = kernels.contact_momentum(OMEGA, GAMMA, BALLS.mass_tensor, BALLS.D)
STEP, STEPS = 0.004, 250


def one(i):
    return chapsym.Ball(BALLS.mass_tensor[[i]], BALLS.D[[i]], BALLS.radius[[i]])


def estimated(which=slice(None), finer=1, **options):
    ball = BALLS if which == slice(None) else one(which)
    some = np.atleast_2d(K[which]), np.atleast_2d(GAMMA[which])
    return discretisation(ball, some[0] * (STEP / finer), some[1], STEP / finer, STEPS * finer, **options)


def motion(i, times):
    """K, γ, the attitude (from the least rotation) and the contact point: (2.3) and the rolling, by scipy."""
    J, D, radius = BALLS.mass_tensor[i], BALLS.D[i], BALLS.radius[i]

    def rate(_, y):
        momentum, g, q = y[:3], y[3:6], y[6:10]
        w = kernels.angular_velocity(momentum, g, J, D)
        centre = radius * cross(w, g)
        turned = centre + 2 * cross(q[1:], cross(q[1:], centre) + q[0] * centre)
        spin = np.array([-(q[1:] @ w), *(q[0] * w + cross(q[1:], w))]) / 2
        return np.concatenate([cross(momentum, w), cross(g, w), spin, turned[:2]])

    run = chapsym.roll(one(i), OMEGA[[i]], STEP, STEPS, gamma=GAMMA[[i]], attitude=True, contact=True, map=True)
    start = np.concatenate([K[i], GAMMA[i], run.attitude[0, 0], [0.0, 0.0]])
    return run, solve_ivp(rate, (0.0, times[-1]), start, "DOP853", times, rtol=1e-12, atol=1e-13).y.T


@pytest.mark.parametrize("i", [0, 1])
def test_the_estimate_is_the_distance_from_the_motion(i):
    found = estimated(i)
    run, y = motion(i, STEP * np.arange(STEPS + 1))
    turned = abs((run.attitude[0] * y[:, 6:10]).sum(axis=-1)).clip(max=1.0)
    omega = [kernels.angular_velocity(*state, BALLS.mass_tensor[i], BALLS.D[i]) for state in
             ((run.angular_momentum()[0], run.gamma[0]), (y[:, :3], y[:, 3:6]))]  # fmt: skip
    true = {
        "gamma": np.linalg.norm(run.gamma[0] - y[:, 3:6], axis=-1).max(),
        "omega": np.linalg.norm(omega[0] - omega[1], axis=-1).max(),
        "attitude": np.degrees(2 * np.arccos(turned)).max(),
        "contact": np.linalg.norm(run.contact[0] - y[:, 10:], axis=-1).max(),
    }
    assert true["attitude"] > 0.1  # degrees: what is to be seen
    assert found.time == pytest.approx(STEP * STEPS)
    assert {name: getattr(found, name) for name in true} == pytest.approx(true, rel=0.03)  # the next order of the step


def test_a_half_of_the_step_has_a_quarter_of_it():
    whole, half = estimated(), estimated(finer=2)
    assert half.gamma == pytest.approx(whole.gamma / 4, rel=0.1)
    assert half.attitude == pytest.approx(whole.attitude / 4, rel=0.1)


@pytest.mark.parametrize(("order", "rel"), [(4, 0.1), (6, 0.4)])
def test_of_a_higher_order_it_is_the_distance_of_that_order(order, rel):
    finest = chapsym.roll(one(0), OMEGA[[0]], STEP / 4, 4 * STEPS, gamma=GAMMA[[0]], order=8, every=4)
    run = chapsym.roll(one(0), OMEGA[[0]], STEP, STEPS, gamma=GAMMA[[0]], order=order)
    found = estimated(0, order=order)
    true = np.linalg.norm(run.gamma - finest.gamma, axis=-1)[0, : round(found.time / STEP) + 1].max()
    assert 1e-12 < true < 1e-4
    assert found.gamma == pytest.approx(true, rel=rel)


def test_the_rounding_of_float32_is_in_it_and_double_double_tells_more_than_float64():
    single = estimated(0, order=8, precision="single")
    double_double = estimated(0, finer=8, order=8, precision="double-double")
    runs = [chapsym.roll(one(0), OMEGA[[0]], STEP, STEPS, gamma=GAMMA[[0]], order=8, precision=name)
            for name in ("single", "double")]  # fmt: skip
    true = np.linalg.norm(runs[0].gamma - runs[1].gamma, axis=-1)[0, : round(single.time / STEP) + 1].max()
    assert single.gamma == pytest.approx(true, rel=0.1)
    assert true > 2.0**-24
    assert 0.0 < double_double.gamma < 2.0**-60
    assert double_double.omega is None


def test_of_many_balls_some_are_followed_and_the_largest_distance_counts():
    both = estimated()
    assert both.balls == 2
    assert both.gamma == max(estimated(i).gamma for i in (0, 1))
    assert many(100).balls == 8
    assert many(100).contact is None
    assert many(100).sentence().endswith(f"up to {STEP * STEPS:.6g} s, the largest of 8 balls")
    assert many(1, attitude=False).attitude is None


def many(count, **options):
    """The same ball, without a radius."""
    ball = chapsym.Ball(np.tile(BALLS.mass_tensor[0], (count, 1)), np.full(count, BALLS.D[0]))
    start = np.tile(STEP * K[0], (count, 1)), np.tile(GAMMA[0], (count, 1))
    return discretisation(ball, *start, STEP, STEPS, contact=False, **options)


def estimated_of(steps):
    return discretisation(one(0), STEP * K[[0]], GAMMA[[0]], STEP, steps)


def test_of_a_long_run_its_beginning_is_followed_and_that_is_said():
    found = estimated_of(10**12)
    assert STEP * STEPS < found.time < MOST * STEP < found.end == STEP * 10**12
    assert found.sentence().endswith(f"up to {found.time:.6g} of 4e+09 s")


def test_balls_that_stop_are_left_out_and_without_one_there_is_none():
    assert estimated_of(0) is None
    momentum = STEP * np.array([K[0], 100 * K[0]])
    ball = chapsym.Ball(BALLS.mass_tensor[[0, 0]], BALLS.D[[0, 0]], BALLS.radius[[0, 0]])
    found = discretisation(ball, momentum, GAMMA[[0, 0]], STEP, STEPS)
    assert (found.balls, found.gamma) == (1, estimated(0).gamma)
    assert discretisation(one(0), momentum[[1]], GAMMA[[0]], STEP, 3) is None
    # A whole step stops where two halves do not.
    assert (chapsym.step(one(0), 24 * momentum[[0]], GAMMA[[0]]).status != Status.TAKEN).all()
    assert (chapsym.step(one(0), 12 * momentum[[0]], GAMMA[[0]]).status == Status.TAKEN).all()
    far = discretisation(ball, momentum * [[1.0], [0.24]], GAMMA[[0, 0]], STEP, 1)
    assert far.balls == 1
    assert discretisation(one(0), STEP * K[[0]], GAMMA[[0]], 1e-308, 3) is None


def test_what_is_written_is_read_and_nothing_else():
    found = estimated_of(3)
    assert read(found.write()) == found
    for other in (None, 3, "", "{}", "[1]", '{"time": 1}', found.write().replace("0.", "x", 1), "[" * 10**5):
        assert read(other) is None
    for wrong in ("much", float("nan"), float("inf"), -1.0, 10**400, [1]):
        assert read(json.dumps({**asdict(found), "gamma": wrong})) is None


SCENE = """
[ball]
inertia = [0.006, 0.007, 0.009]
mass = 2.0
radius = 0.1
[start]
omega = [14.0, -6.0, 3.0]
gamma = ["2/7", "3/7", "6/7"]
[run]
outputs = ["attitude", "contact"]
{run}
"""


@pytest.mark.parametrize(
    ("run", "options"),
    [("time_step = 0.004\nsteps = 250\nmap = true", {}), ("time_step = 0.004\nsteps = 250\norder = 4", {"order": 4}),
     ('time_step = 0.004\nsteps = 250\norder = 8\nprecision = "single"', {"order": 8, "precision": "single"}),
     ("accuracy = 1e-3\ntime = 1.0", None)],
)  # fmt: skip
def test_a_run_says_it_once_a_step_has_a_length_in_time(tmp_path, run, options):
    words = options is not None
    (tmp_path / "ball.toml").write_text(SCENE.format(run=run), encoding="utf-8")
    done = command("run", tmp_path / "ball.toml", "-o", tmp_path / "ball.npz")
    assert done.returncode == 0, done.stderr
    found = read(chapsym.open_result(tmp_path / "ball.npz").dataset.attrs.get("discretisation"))
    assert (found is not None) == words == ("discretisation: about " in done.stdout)
    if words:
        assert f"discretisation: {found.sentence()}\n" in done.stdout
        assert found.gamma == pytest.approx(estimated(0, **options).gamma, rel=1e-6)
    if options == {}:
        chapsym.open_result(tmp_path / "ball.npz").page(tmp_path / "page.html")
        assert found.sentence() in (tmp_path / "page.html").read_text(encoding="utf-8")
        rows = dict(chapsym.open_result(tmp_path / "ball.npz").rows())
        assert rows["discretisation"] == found.sentence()
        done = command("run", tmp_path / "ball.toml", "-o", tmp_path / "ball.nc", "--json")
        assert json.loads(done.stdout)["discretisation"] == asdict(found)


def test_the_sentence():
    found = Discretisation(2.4, 2.4, 0.1385, 0.6252, 8.048, None, 1)
    words = "about 0.14 in gamma, 0.63 rad/s in omega, 8 degrees off the motion of the ball, up to 2.4 s"
    assert found.sentence() == words
