"""The motion to an accuracy: it is met, the estimate is above the error, sweeps cost little more than their runs."""

import json
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
import unstable_starts
from commands import chapsym as command
from sympy import Rational

import chapsym
from chapsym.accuracy import motion
from chapsym.accuracy.motion import EXTRAPOLATED, Problem, apart, doubled, moved, omega_of
from chapsym.dynamics import BadInput, Ball, Status, StepNotTaken, kernels
from chapsym.dynamics.attitudes import attitude_with
from chapsym.dynamics.levels.start import fraction
from chapsym.scene import checked
from chapsym.scene.plan.models import accurate_parts
from chapsym.scene.plan.plan import plan_of
from chapsym.scene.result.summary import far, sentence
from chapsym.scene.running.sweep import run_in_memory

INERTIA = np.array([0.006, 0.0071, 0.0089])
GAMMA = np.array([2.0, 3.0, 6.0]) / 7


def problem(omega, frames=20, interval=0.1, accuracy=1e-6, inertia=INERTIA, gamma=GAMMA):
    """Balls of 2 kg and 0.1 m, with everything followed."""
    omega = np.atleast_2d(np.asarray(omega, dtype=float))
    n = len(omega)
    ball = Ball.from_inertia(np.broadcast_to(inertia, (n, 3)), mass=np.full(n, 2.0), radius=np.full(n, 0.1), batch=True)
    g = np.tile(gamma, (n, 1))
    K = kernels.contact_momentum(omega, g, ball.mass_tensor, ball.D)
    return Problem(ball, K, g, interval, frames, accuracy, attitude_with(g), True)


def of(moments, D, gamma, omega, frames, end, accuracy):
    """The problem of one ball of radius 1, its moments of mass and D, turned by half a radian about the vertical."""
    ball, g = Ball(np.array([moments]), np.array([D]), np.ones(1)), np.array([gamma]) / np.linalg.norm(gamma)
    K = kernels.contact_momentum(np.array([omega]), g, ball.mass_tensor, ball.D)
    attitude = kernels.compose(np.array([np.cos(0.25), 0.0, 0.0, np.sin(0.25)]), attitude_with(g))
    return Problem(ball, K, g, end / frames, frames, accuracy, attitude, True)


def by_doubled(asked):
    """In double-double whatever double precision would do: from long steps without an estimate."""
    return doubled(asked, replace(moved(asked), error=np.full(len(asked), np.inf)), np.zeros(len(asked)))


def true(asked, found, turn=1 / 16):
    """Errors by order 8 in double-double, in steps of 1/16 rad: 1e-15 a radian, of heavy balls 1e-11; (n,)."""
    fastest = np.linalg.norm(omega_of(asked, found.angular_momentum, found.gamma), axis=-1).max()
    fine = int(np.ceil(fastest * asked.interval / turn))
    step = asked.interval / fine
    run = chapsym.trajectory(
        asked.ball, step * asked.K, asked.gamma, fine * asked.frames, order=8, every=fine, attitude=asked.attitude,
        contact=True, time_step=step, precision="double-double",
    )  # fmt: skip
    states = {"angular_momentum": run.angular_momentum(), "attitude": run.attitude, "contact": run.contact}
    fine_run = replace(found, gamma=run.gamma, **states)
    return apart(asked, found, fine_run).max(axis=-1)


@pytest.mark.parametrize("accuracy", [1e-3, 1e-6, 1e-9])
@pytest.mark.parametrize(("frames", "interval"), [(1, 2.0), (7, 0.3), (300, 0.01)])
def test_an_accuracy_is_met_and_the_estimate_is_above_the_error(accuracy, frames, interval):
    asked = problem([14.0, -6.0, 3.0], frames, interval, accuracy)
    found = moved(asked)
    assert true(asked, found) < found.error <= accuracy
    assert found.order[0] == EXTRAPOLATED


@pytest.mark.parametrize(("by", "turn"), [(moved, 1 / 16), (by_doubled, 1 / 32)])
def test_estimates_are_above_the_errors_of_balls_of_all_shapes(by, turn, thorough):
    """With steps so few that errors do not yet fall as they should, and an odd number of frames, too."""
    orders = set()
    for seed in range(11, 18) if thorough else (11,):
        rng = np.random.default_rng(seed)
        for i in range(2000 if thorough else 100):
            moments = 10 ** rng.uniform(-2, 0, 3) if i % 2 else rng.uniform(0.2, 1, 3)
            gamma, omega = rng.standard_normal((2, 3))
            omega[rng.permutation(3)[: 2 * (i % 5 == 0)]] *= 1e-4  # near an axis
            D, frames = 10 ** rng.uniform(-2, 1.5), int(rng.choice([1, 5, 30, 100, 400]))
            accuracy = 10 ** rng.uniform(-8, -2)
            asked = of(moments, D, gamma, omega, frames, 10 ** rng.uniform(0, 1.5), accuracy)
            found = by(asked)
            assert true(asked, found, turn) < found.error <= accuracy, (seed, i)
            assert found.reached == frames
            orders.add(int(found.order[0]))
    # Of 14 000 balls few need double-double.
    assert EXTRAPOLATED in orders if by is moved else min(orders) > EXTRAPOLATED


@pytest.mark.parametrize(
    ("moments", "D", "gamma", "omega", "frames", "end", "accuracy"),
    [
        # Of long steps: the error of the last frame is two hundred times that of the one before.
        ((0.0364, 0.6201, 0.0882), 16.62, (0.7425, 0.6276, -0.2342), (-1.667, 0.8536, 0.6104), 5, 1.49, 6.8e-6),
        # Errors of such long steps do not fall with the order.
        ((0.01533, 0.09111, 0.0142), 1.591, (0.2245, 0.9635, 0.1455),
         (-0.4298, -0.0811, 1.2322), 1, 20.274, 9.12e-7),
        # The same of a composition with one step a frame.
        ((0.00039280574548650193, 0.002866901162860147, 0.9971330988371399), 6.64457272659854,
         (-2.115850966039516, -0.1854802418178685, 1.8411950757940991),
         (-0.6415419435171049, 0.39950227351020584, 1.735584096848553), 7, 2.5966881431560753, 8.08e-4),
        # Near a separatrix what rounding leaves of each long step counts, too.
        ((0.22233812307755152, 0.4096158179023046, 0.3350805792390571), 0.01623970186351525,
         (-0.3561967792308936, 1.348303207315149, 0.6813655592484297),
         (-0.0004410765395628049, 0.0017582295367953458, 1.0012233659051262), 30, 299.4012089701442, 1.44e-8),
        # The columns of many steps fall slowly: the error was 1.09 times its estimate.
        ((0.044127770891064864, 0.015283910607754561, 0.9527264620327442), 1.3662764225464645,
         (-0.46714777490497966, 0.18629215029957288, 0.8643310657023082),
         (1.304176196079477, 1.3491758744234288, -0.569839917731936), 5, 13.682515416621397, 8.64e-6),
        # The last coefficient between the ends of a step is small by chance: the error was .9 of its estimate.
        ((0.0365, 0.5132, 0.0703), 9.58, (-0.9614, 0.1313, -0.2418),
         (-0.3345, 0.1576, -0.5534), 100, 1.0313, 1.44e-5),
        # The motion is sensitive: roundings of the long steps grow.
        ((0.6266, 0.0496, 0.0289), 0.018, (0.8889, -0.2653, -0.3735),
         (0.2689, -1.3234, -0.4694), 100, 23.88, 1e-7),
    ],
)  # fmt: skip
def test_estimates_that_were_too_small_are_above_the_errors(moments, D, gamma, omega, frames, end, accuracy):
    asked = of(moments, D, gamma, omega, frames, end, accuracy)
    found = moved(asked)
    assert true(asked, found) < 0.8 * found.error
    assert found.error <= accuracy


@pytest.mark.parametrize(
    ("J", "D", "omega", "gamma", "turned", "accuracy"),
    [
        # Near a separatrix two runs end at the same pole, after other ways: .009 was stated where γ was off by 1.76.
        ((0.8672887038992961, 0.05457279087640947, 0.19573360961298567), 0.0014818438757009426,
         (1.0655657650249886e-10, -1.5557995984490644e-11, -1.0), (-0.22052748251581725, 0.9753807612697905, 0.0),
         109.89151821715267, 0.053),
        # Nearly steady: the roundings of long steps are nearly equal, and add up; 2e-11 was stated for 1e-10.
        ((0.9553543219954377, 0.36242107888941816, 0.07616532083482949), 12.69055710403009,
         (3.760030277440417, -8.064667812756105e-05, -0.0005419181071037346),
         (0.6464068096931247, -0.7578144667787223, 0.08874384667816299), 1619.1, 1.63e-10),
        # Long: the heading of the contact point drifts by the roundings of compositions; 2.1e-9 was stated for 5.6e-9.
        ((0.5654924055873893, 0.7928926739705814, 0.09561087529104993), 0.02822246515951232,
         (-0.8725441085776514, 1.0396468774161032, 0.6230832581877342),
         (0.5982301700636152, -0.2590301448382307, 0.7583034008170763), 6000.0, 3e-9),
    ],
)  # fmt: skip
def test_an_error_that_was_above_its_estimate_is_below(J, D, omega, gamma, turned, accuracy):
    asked = unstable_starts.Start(chapsym.Ball(J, D, 1.0), omega, np.array(gamma), accuracy, 0.0)
    end, options = turned / np.linalg.norm(omega), {"gamma": gamma, "accuracy": accuracy}
    run = chapsym.roll(asked.ball, omega, end, 1, attitude=True, contact=True, **options)
    assert unstable_starts.distance(asked, run, unstable_starts.by_extrapolation(asked, run)) < run.error


def test_through_passages_of_an_unstable_axis_an_accuracy_that_is_met_is_met(thorough):
    """Of 2000 seeds 34 were met by the estimate alone, which was up to 390 times too small.

    Of seed 1964 the errors of long steps and of a run of order 10 are nearly the same.
    """
    seeds = range(2000) if thorough else (*range(60), 154, 1964)
    parts = list(map(unstable_starts.passing, seeds))
    assert max(parts) < 1
    assert sum(part > 0 for part in parts) >= 0.94 * len(parts)


def test_two_runs_of_a_rod_that_are_both_far_from_the_motion_are_not_believed():
    """They may agree: the error was 8.4e-6 where 6e-7 was stated."""
    moments = (8.80132004985517e-07, 3.081331958276438e-06, 0.009123467668846379)
    ball = Ball(np.array([moments]), np.array([0.06965243255884473]), np.array([0.22547416163395653]))
    g = np.array([[-0.06751717998175098, -0.8502741083762929, -0.521991734639747]])
    omega = np.array([[0.21689754518586207, -0.07508112356970341, 1.3126684271098905]])
    K = kernels.contact_momentum(omega, g, ball.mass_tensor, ball.D)
    asked = Problem(ball, K, g, 140.41395925013188, 1, 1e-6, attitude_with(g), True)
    found, closer = moved(asked), moved(replace(asked, accuracy=1e-7))
    assert found.error <= 1e-6
    assert apart(asked, found, closer).max() < found.error


def test_a_momentum_that_loses_digits_is_refused_though_its_product_with_the_step_does_not():
    ball = chapsym.Ball((1e-283, 2e-283, 1.5e-283), 1e-283, 1e-100)
    with pytest.raises(chapsym.BadInput, match="K = Λω - D⟨ω,γ⟩γ is below the range of float64"):
        chapsym.roll(ball, (4.3e-39, -4.1e-39, -1.3e-39), 1e37, 10)


@pytest.mark.parametrize("frames", [10, 400])
def test_in_double_double_a_ball_has_the_same_bits_alone_and_in_a_batch(frames):
    asked = problem(np.random.default_rng(5).standard_normal((12, 3)) * 5, frames, 50 / frames, 1e-6)
    together = by_doubled(asked)
    assert len({*zip(together.total, together.order, strict=True)}) > 2  # ways that some of the balls share
    for i in range(12):
        alone = by_doubled(asked.of(np.array([i])))
        assert alone.total == together.total[i]
        assert alone.error == together.error[i]
        assert (alone.angular_momentum == together.angular_momentum[i]).all()
        assert (alone.contact == together.contact[i]).all()


def test_the_part_of_the_steps_in_double_double_is_progress():
    asked, seen = problem([14.0, -6.0, 3.0], 40, 1.25, 1e-9), []
    long = replace(moved(asked), error=np.full(1, np.inf))
    doubled(asked, long, np.zeros(1), seen.append)
    parts = [part for part in seen if 0 < part < 1]
    assert parts[:3] == sorted(parts[:3])
    assert 0 < parts[0] < 0.5 < max(parts) < 1 == seen[-1]


def test_one_run_in_double_double_confirms_a_motion_of_a_larger_estimate(monkeypatch):
    """Its roundings might be larger than the accuracy; they are not."""
    rng, counts = np.random.default_rng(3), []
    take = motion._long_steps
    monkeypatch.setattr(motion, "_long_steps", lambda *given: counts.append(given[1]) or take(*given))
    for _ in range(20):
        asked = of(rng.uniform(0.2, 1, 3), 1.0, rng.standard_normal(3), 3 * rng.standard_normal(3), 40, 100.0, 1e-9)
        long = moved(replace(asked, accuracy=1e-7))
        if 1e-9 < long.error[0] < 1e-7:
            counts.clear()
            found = doubled(asked, long, np.zeros(1))
            assert true(asked, found, 1 / 32) < found.error <= 1e-9
            if len(counts) == 1:
                break
    assert len(counts) == 1
    long.gamma[:, -1] += 1e-8
    counts.clear()
    assert doubled(asked, long, np.zeros(1)).error <= 1e-9
    assert len(counts) >= 2  # by a second run


@pytest.mark.parametrize("reached", [2, 6])
def test_of_two_runs_that_stopped_the_later_one_is_kept(monkeypatch, reached):
    run, other = motion._run, problem([14.0, -6.0, 3.0]).nothing()
    other.status[:], other.reached[:], other.error[:] = Status.FOLDED, reached, np.nan

    def stopped(part, first, allowed, found, *more):
        worst = run(part, first, allowed, found, *more)
        found.status[:], found.reached[:], found.error[:] = Status.FOLDED, 5, np.inf
        return np.inf, *worst[1:]

    monkeypatch.setattr(motion, "_run", stopped)
    monkeypatch.setattr(motion, "doubled", lambda *given: other)
    assert moved(problem([14.0, -6.0, 3.0])).reached == max(reached, 5)


def test_a_ball_with_more_than_its_share_of_an_accuracy_is_given_up_and_followed_again(monkeypatch):
    runs = []

    def seen(part, first, allowed, found, *more, of=motion._run):
        result = of(part, first, allowed, found, *more)
        runs.append((allowed.copy(), found.reached.copy(), found.status.copy()))
        return result

    monkeypatch.setattr(motion, "_run", seen)
    # About the middle axis: what is left of the first steps grows with each turn.
    asked = problem([[0.0, 14.0, 1e-5], [3.0, 1.0, 14.0]], 60, 0.3, 1e-7)
    found = moved(asked)
    (_, reached, status), (allowed, again, _) = runs[:2]
    assert reached[0] < reached[1] == 60
    assert not status.any()
    assert len(again) == 1
    assert allowed < runs[0][0][0]
    assert np.isfinite(found.gamma).all()
    assert (true(asked, found) < found.error).all()
    assert (found.error <= 1e-7).all()


@pytest.mark.parametrize("frames", [1, 10, 100])
def test_what_frames_inside_of_steps_miss_counts_for_omega_as_much_as_it_changes_it(frames):
    # A moment that is far larger than another: a small error of the attitude is a large one of ω.
    ball, g = (
        Ball(np.array([[30.0, 0.0025, 0.0012]]), np.array([0.0013]), np.ones(1)),
        np.array([[0.7352, -0.3572, 0.5761]]),
    )
    g /= np.linalg.norm(g)
    K = kernels.contact_momentum(np.array([[-0.2, 0.75, -0.35]]), g, ball.mass_tensor, ball.D)
    asked = Problem(ball, K, g, 3.8 / frames, frames, 1e-6, attitude_with(g), True)
    found, fine = moved(asked), moved(replace(asked, accuracy=1e-9))
    off = np.linalg.norm(omega_of(asked, found.angular_momentum, found.gamma)
        - omega_of(asked, fine.angular_momentum, fine.gamma), axis=-1).max()  # fmt: skip
    assert off / np.linalg.norm(omega_of(asked, K, g)) < found.error <= 1e-6


def test_a_frame_after_a_thousand_turns_has_as_many_steps_as_it_takes():
    asked = problem([14.0, -6.0, 3.0], frames=1, interval=400.0, accuracy=1e-4)
    found = moved(asked)
    assert true(asked, found) < found.error <= 1e-4


def test_a_steady_rotation_is_had_at_once_after_any_time():
    asked = problem([[3.0, -2.0, 1.0], [0.0, 0.0, 0.0]], frames=3, interval=1e7 / 3, inertia=[0.01] * 3)
    found = moved(asked)
    assert (found.order == 0).all()
    assert found.error[0] <= 1e-6
    speed = 0.1 * kernels.rotate(asked.attitude, np.cross([[3.0, -2.0, 1.0], [0.0] * 3], GAMMA))[:, :2]
    assert np.allclose(found.contact[:, -1], 1e7 * speed, rtol=1e-12)
    short = problem([3.0, -2.0, 1.0], inertia=[0.01] * 3)
    assert true(short, moved(short)) < 1e-12


def test_what_cannot_be_had_is_said_and_a_ball_that_rounding_leaves_keeps_its_error():
    with pytest.raises(BadInput, match=r"an accuracy of 1e-12 after 2000 s cannot be had in double precision"):
        moved(problem([14.0, -6.0, 3.0], frames=2, interval=1000.0, accuracy=1e-12))
    # Beside the unstable axis rounding grows, exponentially: no number of steps helps.  One start in 256 has a second
    # try that is so much better, by the luck of rounding, that there is a third: from 1e-9 it was so.
    asked = problem([2e-9, 60.0, 1e-9], frames=8, interval=8.0, gamma=(0.0, 1.0, 0.0))
    found = moved(asked)
    assert found.status[0] == Status.TAKEN
    assert found.error[0] > 1e-6
    assert found.steps[0] < 11000  # the first choice, and one try more
    assert by_doubled(replace(asked, interval=1.5, accuracy=1e-9)).error[0] > 1e-7  # the rounding of the start


def test_roll_gives_the_motion_and_with_order_precision_or_map_the_map():
    ball = Ball.from_inertia(INERTIA, mass=2.0, radius=0.1)
    run = chapsym.roll(ball, (14.0, -6.0, 3.0), 0.005, 200, gamma=GAMMA, every=20, contact=True, attitude=True)
    assert run.order == 0
    assert run.error <= 1e-6
    assert run.index.tolist() == list(range(0, 201, 20))
    fine = chapsym.roll(ball, (14.0, -6.0, 3.0), 0.0005, 2000, gamma=GAMMA, every=200, contact=True, order=8)
    assert np.abs(run.contact - fine.contact).max() < 1e-7
    assert np.abs(run.omega - fine.omega).max() < 1e-5
    assert np.allclose(run.energy, run.energy[0], rtol=1e-7)
    for option in ({"order": 2}, {"precision": "double"}, {"map": True}):
        run = chapsym.roll(ball, (14.0, -6.0, 3.0), 0.005, 200, gamma=GAMMA, **option)
        paper = chapsym.trajectory(ball, run.momentum[0], GAMMA, 200)
        assert (run.momentum == paper.momentum).all()
        assert run.error is None
        with pytest.raises(BadInput, match="leave out order, precision and map"):
            chapsym.roll(ball, (14.0, -6.0, 3.0), 0.005, 200, accuracy=1e-6, **option)


def test_roll_starts_in_space_with_an_attitude_and_a_position():
    ball = Ball.from_inertia(INERTIA, mass=2.0, radius=0.1)
    attitude, spatial = np.array([0.8, 0.0, 0.6, 0.0]), np.array([1.0, 20.0, -3.0])
    run = chapsym.roll(ball, spatial, 0.01, 50, attitude=attitude, axes="space", position=(1.0, 2.0), contact=True)
    assert np.allclose(kernels.rotate(attitude, run.omega[0]), spatial)
    assert np.allclose(kernels.rotate(attitude, run.gamma[0]), [0, 0, 1])
    assert run.contact[0].tolist() == [1.0, 2.0]
    speed = (run.contact[1] - run.contact[0]) / 0.01  # v = ρ ω × e₃
    assert np.allclose(speed, 0.1 * np.cross(spatial, [0, 0, 1])[:2], atol=0.1)
    body = chapsym.roll(ball, run.omega[0], 0.01, 50, gamma=run.gamma[0], attitude=attitude, contact=True)
    assert np.allclose(body.contact, run.contact - [1.0, 2.0], atol=1e-12)
    for wrong, words in [({"axes": "plane"}, 'axes must be "body" or "space"'), ({"accuracy": 0.0}, "accuracy must be"),
                        ({"attitude": [0.0] * 4}, "attitude must be unit quaternions")]:  # fmt: skip
        with pytest.raises(BadInput, match=words):
            chapsym.roll(ball, spatial, 0.01, 5, **wrong)


def test_the_proof_of_a_motion_shows_progress_and_may_be_ended():
    seen = []

    def progress(done):
        seen.append(done)
        if len(seen) == 5:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        chapsym.roll(Ball((1, 2, 4), 3, 0.1), (3, 2, 1), 1.0, 50, proved=True, progress=progress)
    assert seen[-4:] == [50] * 4


def test_a_ball_that_stops_keeps_its_position():
    with pytest.raises(StepNotTaken) as stopped:
        chapsym.roll(Ball((1, 2, 4), 3, 1.0), (0.66, -0.4, 0.94), 1.0, 9, gamma=GAMMA, map=True, contact=True,
                     position=(5.0, 6.0))  # fmt: skip
    assert stopped.value.trajectory.contact[0].tolist() == [5.0, 6.0]


@pytest.mark.parametrize(
    ("inertia", "D", "omega", "end", "accuracy", "true"),
    [((1, 2, 2.5), 1.0, (0, 2, 0), 41.0, None, 2e-6), ((1, 2, 2.5), 1.0, (1e-12, 2, 0), 60.0, None, 7e-5),
     ((1, 1.3, 1.6), 1e6, (0.67, 0.09, -0.73), 20.0, 3e-9, 3e-10)],
)  # fmt: skip
def test_what_rounding_of_the_start_does_is_in_the_estimate(inertia, D, omega, end, accuracy, true):
    """Beside the unstable axis, and where ω along γ has few digits: `true` is by 80 bits, from the floats given."""
    ball = Ball.from_inertia(inertia, D=D, radius=1.0)
    run = chapsym.roll(ball, omega, end / 40, 40, gamma=GAMMA, attitude=True, contact=True, accuracy=accuracy)
    assert run.error > true


def test_near_unstable_rotations_the_estimate_is_above_the_error(thorough):
    """Of 402 the error is .35 of the estimate, so that a third of it would be seen.

    The steps of 798 are alike: the error is .19 of the estimate, and would be .48 if their roundings did not add up.
    The heavy 962 starts where a rounding of K moves ω the least: with that of all steps it was 1.6 times its estimate.
    All but 402 are judged in double-double alone, which the certified motion confirms in `thorough`: it takes a hundred
    times as long.
    """
    light, heavy = (range(3000), range(300)) if thorough else ((0, 402), (20, 44, 962))
    parts = [unstable_starts.part(seed, certify=thorough or seed == 402) for seed in light]
    parts += [unstable_starts.part(seed, heavy=True, certify=thorough) for seed in heavy]
    assert 1 / 3 < max(parts) < 1
    assert unstable_starts.part(798, certify=thorough) < 1 / 3


@pytest.mark.parametrize("wrong", [np.array([1, 0]), "no", None])
@pytest.mark.parametrize("name", ["contact", "map", "axes", "threads"])
def test_roll_refuses_what_is_no_answer_to_an_option(name, wrong):
    with pytest.raises(BadInput, match=name):
        chapsym.roll(Ball((1, 2, 3), 1.0, radius=1.0), (1.0, 2.0, 3.0), 0.1, 10, **{name: wrong})


def test_a_batch_without_balls_has_no_motion():
    ball = Ball(np.ones((0, 3)), np.ones(0), radius=np.ones(0))
    assert chapsym.roll(ball, (1.0, 2.0, 3.0), 0.1, 10, contact=True).contact.shape == (0, 11, 2)


def test_roll_refuses_in_one_sentence_what_no_run_can_have():
    heavy = Ball.from_inertia((1, 1.3, 1.6), D=1e6)
    needle, line = (Ball.from_inertia(moments, D=0.02) for moments in ((0.004, 0.004, 0.0), (0.0, 0.004, 0.004)))
    for ball, omega, step, steps, options, words in (
        (None, (1, 2, 3), 0.1, 3, {}, r"must be a chapsym\.Ball, not NoneType"),
        (needle, (3, -2, 1), 0.01, 100, {}, "a principal moment of 0"),
        (line, (3, -2, 1), 0.01, 100, {}, "a principal moment of 0"),
        (heavy, (1, 2, 0), 1e-9, 10**13, {}, "10000000000001 states of 1 balls do not fit into memory"),
        (heavy, (1e300, 1e300, 0), 0.1, 10, {}, "the ball turns too far for float64"),
        (heavy, np.ones((3, 3)), 0.1, 9, {"gamma": np.eye(3)[:2]}, "of ball .* and of the vectors do not broadcast"),
        (heavy, (1, 2, 0), 0.1, 10, {"order": 0}, "order must be one of 2, 4, 6, 8, not 0"),
        (heavy, (0.67, 0.09, -0.73), 2.0, 10, {"gamma": GAMMA, "accuracy": 1e-10}, "an accuracy of 1e-10 after 20 s"),
    ):
        with pytest.raises(BadInput, match=words):
            chapsym.roll(ball, omega, step, steps, **options)


SCENE = {
    "ball": {"inertia": [0.006, 0.0071, 0.0089], "mass": 2.0, "radius": 0.1},
    "start": {"omega": [14.0, -6.0, 3.0], "position": [5.0, 1.0]},
}


def test_energy_alone_is_verified_by_the_state_and_metres_by_the_contact_point():
    """A difference of energies is 0 by chance where a run is not right."""
    assert accurate_parts(("energy",)) == accurate_parts(("integrals", "gamma")) == {"momentum", "gamma"}
    assert accurate_parts(("contact", "attitude")) == {"contact", "attitude"}
    asked = {"time_step": 0.01, "steps": 50, "accuracy": "1 um", "of": "contact", "outputs": ["gamma"]}
    plan = plan_of(checked(SCENE | {"run": asked}))
    kept = plan_of(checked(SCENE | {"run": asked | {"outputs": ["gamma", "contact"]}}))
    found, beside = (run_in_memory(one) for one in (plan, kept))
    assert "contact" not in found
    assert found["error"].values == beside["error"].values


def test_in_metres_the_attitude_counts_by_how_far_it_moves_the_surface():
    asked = replace(problem([14.0, -6.0, 3.0]), metres=True)
    found = moved(asked)
    turned = replace(found, attitude=kernels.compose(found.attitude, np.array([np.cos(5e-4), np.sin(5e-4), 0.0, 0.0])))
    off = apart(asked, turned, moved(replace(asked, accuracy=1e-9))).max()
    assert off == pytest.approx(1e-4, rel=1e-2)  # 1e-3 rad of a ball of 0.1 m
    assert found.error[0] <= 1e-6


def test_an_error_that_is_not_known_is_told_as_none_that_is_met():
    asked = checked(SCENE | {"run": {"time_step": 0.01, "steps": 50}})
    data = run_in_memory(plan_of(asked))
    assert far(data)["motion"]["worse"] == 0
    data["error"][:] = np.inf
    assert far(data)["motion"] | {"error": None, "worse": 1} == far(data)["motion"]
    key, words = sentence(data)
    assert key == "motion"
    assert "an error that is not known (not the 1e-06 asked for)" in words


def test_a_searched_run_ends_where_its_start_stood(tmp_path):
    scene = tmp_path / "ball.toml"
    scene.write_text("[ball]\ninertia = [0.01, 0.01, 0.01]\nmass = 2.0\nradius = 0.1\n[start]\nvelocity = [1.0, 0.0]\n"
                     "position = [5.0, 1.0]\n[run]\ntime = 3.0\ncontact = true\naccuracy = 1e-6\n")  # fmt: skip
    found = json.loads(command("run", scene, "-o", tmp_path / "ball.npz", "--json").stdout)
    assert np.allclose(found["final"]["contact"], [8.0, 1.0], atol=1e-6)


class Ended(Exception):
    """What a caller of `progress` raises."""


@pytest.mark.parametrize("balls", [1, 9])
def test_a_long_run_shows_progress_and_ends_where_it_is_interrupted(balls):
    def progress(steps):
        if 0 < steps < 1000 * balls:
            raise Ended

    ball = Ball.from_inertia(INERTIA, mass=2.0, radius=np.full(balls, 0.1) if balls > 1 else 0.1, batch=balls > 1)
    with pytest.raises(Ended):
        chapsym.roll(ball, (3, -2, 1), 100.0, 1000, accuracy=1e-4, progress=progress)


@pytest.mark.parametrize("kind", [lambda x: x, lambda x: Rational(x.numerator, x.denominator)])
def test_numbers_that_are_given_exactly_are_not_rounded_on_the_way_to_more_digits(kind):
    """In enclosures the truth is in frame 0, for γ of another length, too; floats are the binary numbers they are."""
    J, D, epsilon = (Fraction(1, 3), Fraction(2, 3), Fraction(4, 3)), Fraction(10, 7), Fraction(1, 10)
    omega, gamma = (Fraction(1, 3), Fraction(-1, 7), Fraction(1, 11)), (Fraction(2, 7), Fraction(3, 7), Fraction(6, 7))
    along = sum(a * b for a, b in zip(omega, gamma, strict=True))
    K = [epsilon * ((sum(J) - j) * w + D * (w - along * g)) for j, w, g in zip(J, omega, gamma, strict=True)]
    J, omega, gamma = ([kind(x) for x in numbers] for numbers in (J, omega, gamma))
    ball = chapsym.Ball(J, kind(D))
    run = chapsym.roll(ball, omega, kind(epsilon), 1, gamma=gamma, precision=chapsym.Enclosure(120))
    for x, truth in zip(run.momentum[0], K, strict=True):
        assert abs(fraction(x) - truth) <= fraction(x.rad()) < 1e-30
    run = chapsym.roll(ball, omega, kind(epsilon), 1, gamma=gamma, precision=chapsym.Digits(40))
    assert abs(fraction(run.momentum[0][0]) - K[0]) < 1e-40
    floats = chapsym.roll(ball, [float(x) for x in omega], 0.1, 1, gamma=gamma, precision=chapsym.Enclosure(120))
    assert abs(fraction(floats.momentum[0][0]) - K[0]) > 1e-20
