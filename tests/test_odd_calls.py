"""Public functions with odd arguments: no exception but those documented, no warning, no NaN in silence."""

import inspect
import itertools
from fractions import Fraction

import numpy as np
import odd_calls
import pytest
import xarray

import chapsym
from chapsym import BadInput


def test_odd_calls_end_in_a_result_or_a_sentence(request):
    seeds = range(100_000) if request.config.getoption("--thorough") else range(1_000, 3_000)
    found = {seed: said for seed in seeds if (said := odd_calls.wrong(seed))}
    assert not found


def test_what_is_wrong_with_a_call_is_seen(monkeypatch):
    """An exception of another kind, a warning, NaN, and an array that is changed."""

    def broken(ball, momentum, gamma):
        raise KeyError(gamma)

    def loud(ball, momentum, gamma):
        return np.float64(1e300) * 1e300

    def silent(ball, momentum, gamma):
        return np.array([np.nan])

    def careless(ball, momentum, gamma):
        if isinstance(momentum, np.ndarray) and momentum.dtype == float:
            momentum[...] = 7.0

    expected = {broken: "KeyError", loud: "RuntimeWarning", silent: "NaN", careless: "changes momentum"}
    for wrong, said in expected.items():
        monkeypatch.setattr(chapsym, "exact_top", wrong)
        monkeypatch.setattr(odd_calls, "NAMES", ["exact_top"])
        assert any(said in (odd_calls.wrong(seed) or "") for seed in range(30)), said


class Unheard:
    """What raises an error of its own where it is asked for an attribute, its class among them."""

    def __getattribute__(self, name):
        raise RuntimeError(name)


class Whole(int):
    """A whole number that raises an error of its own where it is to be one of Python."""

    def __int__(self):
        raise RuntimeError("no")


class Name(str):
    """A text that raises an error of its own where it is compared."""

    def __eq__(self, other):
        raise RuntimeError(other)

    __hash__ = str.__hash__


class Compared(int):
    """A whole number that does."""

    def __lt__(self, other):
        raise RuntimeError(other)

    __eq__ = __le__ = __gt__ = __ge__ = __lt__
    __hash__ = int.__hash__


class Unwilling:
    """What raises an error of its own where an array is made of it."""

    def __array__(self, dtype=None, copy=None):
        raise KeyError("unwilling")


HOSTILE = [Unheard(), Name("double"), Compared(2), [Unheard(), 0, 1]]


@pytest.mark.parametrize("name", odd_calls.NAMES)
def test_what_raises_errors_of_its_own_is_refused_in_place_of_each_argument(name):
    given = odd_calls.ordinary(name)
    for key in inspect.signature(getattr(chapsym, name)).parameters:
        for odd in HOSTILE:
            assert not odd_calls.said_of(name, given | {key: odd}), key


K, UP, BALL = (0.1, 0.2, 0.3), (0, 0, 1), chapsym.Ball((1, 2, 4), 3, 0.5)
BALL_N = chapsym.BallN((1, 2, 4), 3)
TURNED = chapsym.Ball.from_inertia([[3, 0.5, 0], [0.5, 4, 0], [0, 0, 5]], D=0.5)
UNWILLING = odd_calls.Unwilling(0.1)
LOW = np.array([0.2832664089, -0.2537948, -0.9568])
COMPLEX = np.array([1, np.complex64(2j), 3], dtype=object)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: chapsym.ExactBall(np.array(0.5), 1), "mass_tensor"),
        (lambda: chapsym.ExactBall([[1, 2], [3]], 1), "mass_tensor"),
        (lambda: chapsym.ExactBall(0.5, 1), "mass_tensor"),
        (lambda: chapsym.ExactBall("1,2,4", 1), "mass_tensor"),
        (lambda: chapsym.ExactBall(None, 1), "mass_tensor"),
        (lambda: chapsym.ExactBall((1, 2, 4), 3, -(10**400)), "radius must be positive"),
        (lambda: chapsym.Ball.from_inertia((3, 4, 5), D=1, batch=np.ones(3)), "batch must be True or False"),
        (lambda: chapsym.invariants_n(np.zeros((2, 4, 4)), np.zeros((0, 4))), "momentum and gamma do not broadcast"),
        (lambda: chapsym.invariants_n([UNWILLING], (1, 0, 0)), "momentum must be real numbers"),
        (lambda: chapsym.rotation_number(chapsym.Ball((1, 2, 4), 3, [0.1, 0.2]), 0.05, UP), "one ball and one gamma"),
        (lambda: chapsym.roll(BALL, Unwilling(), 0.1, 1), "omega must be real numbers"),
        (lambda: chapsym.roll(BALL, COMPLEX, 0.1, 1), "omega must be real numbers"),
        (lambda: chapsym.roll(BALL, K, 0.1, np.timedelta64(5, "s")), "whole number from 0 on, not np.timedelta64"),
        (lambda: chapsym.roll(BALL, K, 0.1, 5, contact=True, position=[[1, 2]]), "position"),
        (lambda: chapsym.roll(BALL, K, 0.1, np.ma.array(2.0, mask=False)), "^[^\n]*$"),
        (lambda: chapsym.trajectory(BALL, K, UP, 10, contact="no"), "contact must be True or False, not 'no'"),
        (lambda: chapsym.extrapolate(BALL, K, UP, 1.0, 10, contact="no"), "contact must be True or False, not 'no'"),
        (lambda: chapsym.Stepper(BALL, K, UP, contact="no"), "contact must be True or False, not 'no'"),
        (lambda: chapsym.steady_frames(BALL, UP, UP, [0], contact=[True, True]), "contact must be True or False"),
        (lambda: chapsym.compose_step(BALL, K, UP, np.ones(3)), "order must be one of 2, 4, 6, 8"),
        (lambda: chapsym.certified_motion(chapsym.ExactBall((1, 1, 1), 10**11179), K, UP, 1), "too far apart in size"),
        (lambda: TURNED.to_principal([[1, 2], [3]]), "vectors must be real numbers"),
        (lambda: BALL.to_principal([[1, 2], [3]]), "vectors must be real numbers"),
        (lambda: TURNED.from_principal((1, 0, 0), frames=np.ones(3)), "frames must be True or False"),
        (lambda: chapsym.steady_frames(BALL, UP, UP, Unwilling()), "index must be a list of whole numbers"),
        (lambda: chapsym.trajectory(BALL, K, UP, 1, attitude=(1e200, 0, 0, 0)), "attitude must be unit quaternions"),
        (lambda: chapsym.Stepper(BALL, K, UP, time_step=UNWILLING), "time_step must be real numbers"),
    ],
)
def test_what_is_no_argument_is_refused_by_its_name(call, said):
    with pytest.raises(BadInput, match=said):
        call()


@pytest.mark.parametrize("odd", [0.5, b"ball.npz", None, np.zeros(3)])
def test_what_is_no_scene_and_no_result_is_refused_by_its_name(odd):
    for read, said in (
        (chapsym.run_scene, "scene must be a .toml file or a dictionary, not"),
        (chapsym.open_result, "path must name a result, not"),
        (lambda given: chapsym.interpolated(given, 0.5), "run must be a result, its Dataset, or a Trajectory, not"),
    ):
        with pytest.raises(BadInput, match=said):
            read(odd)
    run = chapsym.roll(chapsym.Ball((1, 2, 4), 3), (1, 0, 0), 0.1, 3).to_xarray()
    for times in ([[0.1], [0.1, 0.2]], "soon", 0.1j):
        with pytest.raises(BadInput, match="times must be real numbers"):
            chapsym.interpolated(run, times)


UNSHOWN = {"integer": 10**6000, "fraction": Fraction(10**6000, 7), "list": [-(10**6000)], "own": odd_calls.Unshown()}


@pytest.mark.parametrize("odd", UNSHOWN.values(), ids=UNSHOWN)
def test_what_cannot_be_shown_is_refused_by_its_name(odd):
    for name, call in (
        ("steps", lambda: chapsym.trajectory(BALL, K, UP, odd)),
        ("order", lambda: chapsym.substeps(odd)),
        ("precision", lambda: chapsym.step(BALL, K, UP, precision=odd)),
        ("index", lambda: chapsym.steady_frames(BALL, UP, UP, odd)),
        ("digits", lambda: chapsym.certified_motion(BALL, K, UP, 1, odd)),
        ("of", lambda: chapsym.accurate(BALL, K, UP, 1, 1e-3, of=odd)),
        ("progress", lambda: chapsym.accurate(BALL, K, UP, 1, 1e-3, progress=odd)),
        ("progress", lambda: chapsym.roll(BALL, K, 0.1, 1, progress=odd)),
        ("progress", lambda: chapsym.extrapolate(BALL, K, UP, 0.1, 1, progress=odd)),
        ("progress", lambda: chapsym.trajectory_n(BALL_N, chapsym.skew(K), UP, 1, progress=odd)),
        ("progress", lambda: chapsym.certified_motion(BALL, K, UP, 1, 5, progress=odd)),
        ("progress", lambda: chapsym.certify(chapsym.trajectory(BALL, K, UP, 1), progress=odd)),
        ("progress", lambda: chapsym.run_scene({"ball": {}}, progress=odd)),
        ("progress", lambda: chapsym.trajectory(BALL, K, UP, 1, progress=odd)),
        ("path", lambda: chapsym.open_result(odd)),
    ):
        with pytest.raises(BadInput, match=name):
            call()
    for level in (chapsym.Digits, chapsym.Enclosure):
        with pytest.raises(ValueError, match="must be a whole number"):
            level(odd)


def test_the_time_of_a_step_of_frames_that_are_known_at_once_is_that_of_a_run():
    for odd in ("0.1", -0.1, float("nan"), [0.1], 10**400, 1e308):
        with pytest.raises(BadInput, match="time_step"):
            chapsym.steady_frames(BALL, UP, UP, [0, 10], time_step=odd)
        with pytest.raises(BadInput, match="time_step"):
            chapsym.top_frames(chapsym.Ball((1, 2, 4), 0), K, UP, [0, 10], time_step=odd)


@pytest.mark.filterwarnings("error")
def test_small_integers_number_steps_of_a_top_and_moments_that_underflow_are_no_warning():
    motion = chapsym.TopMotion.free(chapsym.Ball((1, 2, 4), 0), (0.1, 0.2, 0.3))
    assert (motion.rotations(np.array([1, 200], np.uint8)) == motion.rotations([1, 200])).all()
    assert chapsym.is_top(chapsym.Ball((2.6e164, 7.5e-224, 5.7e-172), 0), (0.06, 0.05, 0.02), (1, 0, 0))


def test_a_limit_beyond_float64_is_no_limit():
    assert chapsym.certified_motion(BALL, K, UP, 0.1, 10, limit=10**400).stopped is None


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("size", [1e-310, 1e-200, 1e200])
def test_an_exact_top_is_restored_in_any_units(size):
    """Squares of its momentum are beyond float64."""
    gamma, J = (0.6, 0, 0.8), np.array((1, 2, 4))
    found = []
    for unit in (1.0, size):
        top = chapsym.exact_top(chapsym.Ball(J * unit, 0), np.array((0.06, 0.01, 0.08)) * unit, gamma)
        assert top.size == pytest.approx(np.sqrt(0.0101) * unit)
        run = top.restore(chapsym.trajectory(top.ball, top.momentum, gamma, 5))
        found.append((run.momentum / unit, run.gamma))
    for ordinary, other in zip(*found, strict=True):
        assert np.abs(ordinary - other).max() < 1e-13
    with pytest.raises(BadInput, match="this is no trajectory of the exact top"):
        top.restore(None)


def deep(levels):
    """A number inside nested lists."""
    return [deep(levels - 1)] if levels else 1.0


def run(**options):
    return chapsym.trajectory(BALL, (0.1, 0.2, 0), UP, 2, **options)


def saved(data):
    return chapsym.Result(data.to_xarray()).save("no-such-folder/a.csv")


HUGE = chapsym.Ball((1e200, 2e200, 4e200), 0)
EQUATOR = chapsym.Curve.through(chapsym.Ball((2, 2, 1), 3), (0.6, 0.8, 1e-151))
REFUSED = {
    "K = 𝒦/ε is beyond the range of float64": lambda: run(time_step=5e-324).omega,
    "K = 𝒦/ε is beyond the range of float32": lambda: run(time_step=1e-200, precision="single").angular_momentum(),
    "energy is beyond the range of float64": lambda: run(time_step=1e-200).kinetic_energy(),
    "an invariant is beyond the range of": lambda: chapsym.trajectory(HUGE, (1e199, 2e199, 0), UP, 2).invariants(),
    "momentum has 61 axes": lambda: chapsym.step(BALL, np.ones((1,) * 60 + (3,)), (0, 0, 1)),
    "the certificate has no array": lambda: chapsym.certify(run()).digits(np.zeros(3)),
    "vector must be real numbers": lambda: chapsym.skew(deep(700)),
    "gamma is not on this curve": lambda: EQUATOR.argument((0.6, 0, 0.8)),
    "there is no figure": lambda: chapsym.Result(run().to_xarray()).figure(np.zeros(3)),
    "has no ball": lambda: chapsym.Result(run().to_xarray()).figure(ball=Unheard()),
    "residual must be a row": lambda: chapsym.implicit_step(Unheard(), Unheard()),
    "contact must be True or False": lambda: chapsym.trajectory(TURNED, K, UP, 1, contact=np.array([1, 2])),
    "proved must be True or False": lambda: chapsym.step(TURNED, K, UP, proved=np.array([1, 2])),
    "run must be a Trajectory": lambda: chapsym.reverse([1]),
    "dataset must be the dataset of a result": lambda: chapsym.Result(run()),
    "dataset must be the dataset of a result, with ball": lambda: chapsym.Result(Unheard()),
    "dataset of a result, with ball and": lambda: chapsym.Result(run().to_xarray().gamma),
    "path must name a file": lambda: chapsym.Result(run().to_xarray()).save(None),
    "a result without balls or without frames": lambda: chapsym.Result(run().to_xarray().isel(frame=[])).save("x.csv"),
    "along its last dimension: transpose axis, ball": lambda: chapsym.roll(
        BALL, xarray.DataArray(np.eye(3), dims=("axis", "ball")), 0.1, 1
    ),
    "a name must be .omega. or .energy., not": lambda: run().derived("speed"),
    "principal moment of 0, and no": lambda: chapsym.accurate(chapsym.Ball((0, 0, 1), 3), K, (0.6, 0, 0.8), 1, 1e-8),
    "a result without balls or": lambda: saved(chapsym.trajectory(BALL, np.zeros((0, 3)), UP, 2)),
    "no file has this result: momentum has no real": lambda: saved(run(precision=chapsym.Digits(20))),
    "write is of a step in three dimensions": lambda: chapsym.step_n(BALL_N, chapsym.skew(K), UP).write(),
    "balls must be True or False": lambda: run().to_pandas(balls=np.ones(3)),
    "run must be a result, its Dataset": lambda: chapsym.interpolated(run().to_pandas(), 0),
    "angular_momentum must be 3 numbers, not": lambda: chapsym.certified_motion(BALL, itertools.count(), UP, 1),
    "times must be at most 1000000 numbers, not": lambda: chapsym.certified_motion(BALL, K, UP, itertools.count()),
    "times must be a number": lambda: chapsym.certified_motion(BALL, K, UP, Unheard()),
    "ball must be a chapsym.Ball": lambda: chapsym.step(Unheard(), K, UP),
    "steps must be a whole number": lambda: chapsym.trajectory(BALL, K, UP, Whole(3)),
    "the axes of the ball and the vectors do not broadcast": lambda: TURNED.to_principal(np.ones((1,) * 40 + (3,))),
}


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("said", REFUSED)
def test_what_a_result_cannot_say_is_refused(said):
    with pytest.raises(BadInput, match=said):
        REFUSED[said]()


def test_omega_is_known_where_the_energy_is_beyond_float64():
    assert np.isfinite(run(time_step=1e-200).omega).all()


@pytest.mark.filterwarnings("error")
def test_no_balls_have_a_table():
    empty = chapsym.trajectory(BALL, np.zeros((0, 3)), (0, 0, 1), 2, time_step=0.1)
    assert len(empty.to_pandas()) == len(empty.to_pandas(balls=True)) == 0


@pytest.mark.filterwarnings("error")
def test_balls_beyond_the_fold_have_no_frames_at_once():
    far = chapsym.steady_frames(chapsym.Ball((1, 2, 4), 0), [(0, 1.4e308, 0), (0, 0.1, 0)], (0, 0, 1), [1, 2])
    assert far.status.tolist() == [chapsym.Status.UNREACHABLE, chapsym.Status.TAKEN]
    heavy = chapsym.Ball((1.4664731320977724, 1.4664731320977724, 2.6582285458260104), 1e300)
    assert not chapsym.branches(heavy, (-1.80833357, 1.66351926, -2.96723349), UP, settle=False).complete


def test_a_lack_of_memory_is_no_fault_of_an_argument():
    class Large:
        def __array__(self, dtype=None, copy=None):
            raise MemoryError

    with pytest.raises(MemoryError):
        chapsym.skew(Large())


def test_numpy_may_be_told_to_raise_where_a_number_is_too_small():
    tiny, momentum = chapsym.Ball((1, 2, 4), 3), np.array((5e-324, 1e-200, 0.1))
    with np.errstate(all="raise"):
        assert chapsym.fold(tiny, momentum, UP).settled
        assert chapsym.step(tiny, [1e3 * momentum, momentum], UP).status.tolist() == [chapsym.Status.UNREACHABLE, 0]
        assert chapsym.Ball.from_inertia(np.diag([3, 4, 5]) + 1e-200 * np.ones((3, 3)), D=1).is_one
        assert chapsym.step_n(BALL_N, chapsym.skew(momentum), UP).status == 0
        assert chapsym.step(tiny, (5e-324, 0, 1e-310), UP, precision="double-double").status == 0
        assert chapsym.trajectory(tiny, momentum, UP, 5, proved=True).proved.momentum is not None
        assert chapsym.top_frames(chapsym.Ball((1, 2, 4), 0), [5e-324] * 3, UP, [0, 3]).status == 0
        assert chapsym.trajectory(tiny, (5e-324, 0, 1e-310), UP, 5, time_step=0.1).at([0.25]).gamma.shape == (1, 3)
        assert chapsym.certified_motion(tiny, (1e-200, 1e-170, 1e-300), UP, [0, 1]).stopped is None
        assert chapsym.roll(tiny, (1e-170, 1e-150, 1e-320), 0.1, 5).error < 1e-6
        chapsym.StepperN(
            chapsym.BallN((3e-4, 4e-5, 2e-4), 0), 1e-300 * chapsym.skew((2, -2.5, -1.3)), (0, 0.6, 0.8)
        ).step(3)
        top, up = chapsym.Ball((2.2, 2.2, 2.9), 4.4, 0.1), (0, 0.6, 0.8)
        assert len(chapsym.accurate(top, (-8.1, -4.8, -3.5e-214), up, 0.1, 1e-20, frames=3).trajectory.index) == 4
        heavy = chapsym.Ball((2.4599347177743027, 0.7256149778934402, 2.529456553471182), 126.00907071213696)
        assert np.isfinite(chapsym.Curve.through(heavy, LOW / np.linalg.norm(LOW)).point(1e-300)).all()
        assert chapsym.roll(tiny, (1, 0, 0), 0.1, 2, attitude=(1, 1e-170, 0, 0)).error < 1e-6
        single = {"precision": "single", "attitude": (1, 1e-60, 0, 0)}
        assert chapsym.trajectory(tiny, (0.1, 0.05, 0.2), UP, 2, **single).status == 0
        assert chapsym.trajectory_vertical(chapsym.Ball((1, 2, 4), 0), 0.1, (1e-200, 0, 1), 3).level().shape == (4,)
        assert chapsym.rotation_number(chapsym.Ball((7.9e-5, 0.36, 4.5e6), 0), 1e-270, (0, 1, 1e-113)) < 1


def test_a_momentum_that_underflows_in_the_unit_of_the_stages_is_a_sentence():
    ball = chapsym.Ball((1e150, 2e150, 0.5e150), 0)
    with pytest.raises(chapsym.StepNotTaken, match="step 0"):
        chapsym.trajectory(ball, (5e-324, 0, -5e-324), (0.6, 0, 0.8), 3, order=4)
