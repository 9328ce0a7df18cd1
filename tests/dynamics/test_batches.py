"""Batches: blocks and threads take the same steps as one ball alone, to the bit; so does the compiled code."""

from functools import partial

import numpy as np
import pytest
from crowds import alone, balls, beyond, floats_of, long_steps, seeded
from plain import in_plain_python

import chapsym
from chapsym import BadInput, Ball, Status
from chapsym.dynamics import kernels, native
from chapsym.dynamics.attitudes import attitude_with
from chapsym.dynamics.levels import double, double_double
from chapsym.dynamics.loops import block, loop, records
from chapsym.dynamics.loops.guess import stage_weights

PRECISIONS = ["single", "double", "double-double"]


ROLLING = ((balls, 2), (long_steps, 2), (balls, 6), (long_steps, 8))


@pytest.mark.parametrize(
    ("precision", "made", "n", "order", "rolls"),
    [(p, balls, n, 2, False) for p in PRECISIONS for n in (12, block.LANES, 150)]
    + [(p, long_steps, 2 * block.LANES + 5, 2, False) for p in PRECISIONS]
    + [(p, beyond, block.LANES + 9, 2, False) for p in PRECISIONS]
    + [("double-double", balls, 12, 4, False)]  # of which blocks have no stages
    + [(p, balls, block.LANES + 5, order, False) for p in ("double", "single") for order in (4, 6, 8)]
    + [("double", made, block.LANES + 5, order, False) for made in (long_steps, beyond) for order in (4, 8)]
    + [(p, made, block.LANES + 5, order, True) for p in ("double", "single") for made, order in ROLLING],
)
def test_a_batch_is_its_balls_to_the_bit(precision, made, n, order, rolls):
    """One of the long steps cannot be certified: it neither stops the rounds of the others nor is settled by them.

    Bodies roll from attitudes that are given: in double precision in a block, in single one by one.
    """
    ball, K, g = made(n, 1e-12, 1e8) if precision == "single" and made is balls else made(n)
    J, D, radius = np.broadcast_to(ball.mass_tensor, (n, 3)), np.broadcast_to(ball.D, n), np.linspace(0.1, 2, n)
    options = {"every": 7, "precision": precision, "order": order, "contact": rolls}
    turned = kernels.compose(np.array([0.8, 0, 0, 0.6]), attitude_with(g)) if rolls else [False] * n
    steps = 1100 if order == 2 or precision != "double-double" else 70
    run = chapsym.trajectory(Ball(J, D, radius), K, g, steps, attitude=turned if rolls else False, **options)
    for i in [*range(12), *range(12, n, 31), n - 1]:
        one, *end = alone(Ball(J[i], D[i], radius[i]), K[i], g[i], steps, attitude=turned[i], **options)
        assert [run.status[i], run.taken[i]] == end
        for all_, few in zip(floats_of(run), floats_of(one), strict=True):
            assert np.array_equal(all_[i, : len(few)], few)
            assert np.isnan(all_[i, len(few) :]).all()
    assert made is not balls or run.status[[8, 9]].tolist() == [Status.UNREACHABLE, Status.NO_INERTIA]
    assert made is not balls or order != 2 or run.status[2] == Status.FOLDED


@pytest.mark.parametrize(("n", "widths"), [(2, [8]), (9, [16]), (41, [40, 8]), (63, [40, 24])])
def test_a_block_is_as_wide_as_its_balls_need(n, widths, monkeypatch):
    ball, K, g = long_steps(n)
    run, one_step, used = chapsym.trajectory(ball, K, g, 12), chapsym.step(ball, K, g), []
    enter = block.enter  # once for every block
    monkeypatch.setattr(block, "enter", lambda *of: used.append(len(of[-1])) or enter(*of))
    monkeypatch.setattr(native, "loop", lambda function, dtype=None: function)
    plain = chapsym.trajectory(ball, K, g, 12)
    assert used == widths
    assert chapsym.step(ball, K, g).gamma.tolist() == one_step.gamma.tolist()
    assert used == 2 * widths
    for i, (all_, few) in enumerate(zip(floats_of(run), floats_of(plain), strict=True)):
        assert np.array_equal(all_, few), i


def test_steps_beyond_the_bound_are_proved_in_their_lanes(monkeypatch):
    """To the bit those of one ball in plain Python; and what takes the continuation is a few of a hundred steps."""
    ball, K, g = beyond(24)
    K *= 0.7
    run = chapsym.trajectory(ball, K, g, 40)
    continued, small_rotation = [], loop.small_rotation
    monkeypatch.setattr(loop, "small_rotation", lambda *args: continued.append(args) or small_rotation(*args))
    with in_plain_python():
        plain = chapsym.trajectory(ball, K, g, 40)
    assert all(np.array_equal(a, b) for a, b in zip(floats_of(run), floats_of(plain), strict=True))
    assert 0 < len(continued) < 0.1 * 24 * 40


def test_a_root_that_no_round_found_is_proved_neither_alone_nor_in_a_lane():
    """After all rounds near a fold, what they leave is larger than what lets them end, and yet small enough."""
    ball = Ball((1.656467140327614, 0.9266926432754555, 1.087228376397973), 1)
    K = np.array([0.3161231358500695, 3.5007520500634444, -0.06744224905921718])
    gamma = (0.1821688695395831, 0.09061920965167572, 0.9790825612851941)
    one, two = chapsym.trajectory(ball, K, gamma, 7), chapsym.trajectory(ball, np.tile(K, (2, 1)), gamma, 7)
    assert (two.momentum == one.momentum).all()


@pytest.mark.parametrize("precision", [*PRECISIONS, chapsym.Digits(30), chapsym.Enclosure(100)])
def test_the_steps_of_a_batch_are_not_written_as_one(precision):
    ball, K, g = long_steps(2)
    with pytest.raises(BadInput, match=r"write is of the step of one ball, and this is of a batch of shape \(2,\)"):
        chapsym.step(ball, K, g, precision=precision).write()


def block_of(n):
    """A block of long steps after 20 of them: what `march_blocks` takes before the steps, and after them."""
    ball, K, g = long_steps(n)
    stages = records.Stages(np.ones(1), stage_weights((1.0,)))
    rows = (np.zeros((rows, block.LANES)) for rows in (loop.ROWS, 1, 1, 3 * stages.weights.shape[1], 7))
    start = records.Start(K, g, np.tile(ball.mass_tensor, (n, 1)), np.full(n, ball.D))
    frames = records.Frames(*(np.zeros((n, *shape)) for shape in ((1, 3), (1, 3), (0, 4), (0, 2))), False, False)
    ends = records.Ends(np.zeros(n, np.int64), np.zeros(n, np.int64), np.ones(n))
    of, rest = (block.Block(*rows, np.zeros(n)), stages), (start, np.ones(n), frames, ends, np.zeros((n, 6)))
    native.loop(block.march_blocks)(*of, records.Steps(0, 20, 100), *rest)
    assert not ends.status.any()
    return of, rest


def test_a_block_of_long_steps_mends_no_lane(monkeypatch):
    """The rounds that all lanes take together settle them; were they wrong, mending would still find the rotation."""
    (of, rest), few = block_of(block.LANES), []
    monkeypatch.setattr(block, "FEW", 0)
    monkeypatch.setattr(block, "mend", lambda S, P, ok, *rest: few.append(int((ok == 0).sum())))
    block.march_blocks(*of, records.Steps(20, 25, 100), *rest)
    assert few == []


@pytest.mark.parametrize("precision", ["double", "double-double"])
@pytest.mark.parametrize("options", [{}, {"attitude": True}])
def test_threads_and_chunks_change_nothing(precision, options, monkeypatch):
    """Also where a ball rests, for a later chunk, and where a frame falls between two."""
    n, steps, every = (130, 1300, 13) if precision == "double" else (130, 20, 1)
    ball, K, g = balls(n)
    options = options | {"every": every, "precision": precision}
    whole = chapsym.trajectory(ball, K, g, steps, threads=1, **options)
    monkeypatch.setattr(double, "CHUNK", 97 * block.LANES)
    monkeypatch.setattr(double, "SHORT_RUN", 1)
    monkeypatch.setattr(double_double, "SHORT_RUN", 1)
    parts = chapsym.trajectory(ball, K, g, steps, threads=2, **options)
    for a, b in zip([*floats_of(whole), whole.taken, whole.status], [*floats_of(parts), parts.taken, parts.status],
                    strict=True):  # fmt: skip
        assert np.array_equal(a, b, equal_nan=True)


BALLS, STATES, VERTICALS = seeded(130, 3.0)
#: Functions that may be long, and all that they have to do: steps, lines or balls.
LONG = {
    "trajectory": (partial(chapsym.trajectory, BALLS, STATES, VERTICALS, 4000), 130 * 4000),
    "reverse": (partial(chapsym.reverse, chapsym.trajectory(BALLS, 0.01 * STATES, VERTICALS, 4000)), 130 * 4000),
    "trajectory_vertical": (
        partial(chapsym.trajectory_vertical, Ball([(1, 2, 4)] * 3, [0, 1, 0]), 1e-3, (0.6, 0.8, 0), 300_000), 900_000,
    ),
    "follow": (partial(chapsym.follow, BALLS, np.stack([0 * STATES, STATES, 9 * STATES], 1), VERTICALS), 260),
    "fold": (partial(chapsym.fold, BALLS, STATES, VERTICALS), 130),
    "margin": (partial(chapsym.margin, BALLS, STATES, VERTICALS), 130),
    "branches": (partial(chapsym.branches, Ball((1, 2, 4), 3), [(9, 0, 0), *[(1, 0, 0)] * 1199], (0, 0, 1)), 1200),
}  # fmt: skip


@pytest.mark.parametrize("name", LONG)
def test_progress_ascends_to_all_that_there_is_to_do_and_may_end_it(name):
    run, all_of_it = LONG[name]
    seen = []
    run(progress=seen.append)
    assert len(seen) > 1
    assert seen == sorted(seen)
    assert seen[-1] == all_of_it
    with pytest.raises(BadInput, match="progress must be a function"):
        run(progress=1)

    def interrupt(done):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(progress=interrupt)


@pytest.mark.parametrize("precision", PRECISIONS)
def test_a_batch_in_which_no_ball_goes_on_ends(precision):
    seen = []
    run = chapsym.trajectory(
        Ball((1, 2, 4), 3), [(100, 0, 0)] * 8, (0, 0, 1), 10**6, every=10**6, precision=precision, threads=1,
        progress=seen.append,
    )  # fmt: skip
    assert (run.status == Status.UNREACHABLE).all()
    assert len(seen) == 1


@pytest.mark.parametrize("threads", [1, 2])
def test_an_interrupt_ends_the_run(threads, monkeypatch):
    monkeypatch.setattr(double, "SHORT_RUN", 1)
    ball, K, g = balls(200)

    def interrupt(done):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        chapsym.trajectory(ball, K, g, 100, threads=threads, progress=interrupt)


def test_the_integrals_stay_to_the_last_digit():
    """A million steps: compensated and restored, ⟨𝒦,γ⟩, |𝒦|² and |γ|² move by a few roundings, and do not grow."""
    run = chapsym.trajectory(
        Ball((0.1, 0.5, 1.6), 0.7), (0.03, -0.02, 0.035), np.array([2, 3, 6]) / 7, 10**6, every=1000
    )
    values = run.invariants()
    assert (np.abs(values / values[0] - 1).max(axis=0) <= 8 * 2.0**-53).all()
