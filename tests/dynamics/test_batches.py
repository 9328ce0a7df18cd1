"""Batches: blocks and threads take the same steps as one ball alone, to the bit; so does the compiled code."""

import numpy as np
import pytest

import chapsym
from chapsym import BadInput, Ball, Status, StepNotTaken
from chapsym.dynamics import columns, kernels
from chapsym.dynamics.attitudes import attitude_with
from chapsym.dynamics.levels import double, single
from chapsym.dynamics.loops import block, gibbs, loop

PRECISIONS = ["single", "double", "double-double"]
RNG = np.random.default_rng(4)


def balls(n, tiny=1e-310, heavy=1e14):
    """Balls at random, some of each kind: D = 0, at rest, beyond the certificate, folding, tiny, heavy."""
    J, D = RNG.uniform(0.1, 2.0, (n, 3)), RNG.uniform(0.0, 2.0, n)
    K, g = RNG.normal(size=(n, 3)), RNG.normal(size=(n, 3))
    K *= 0.3 * J.min(axis=1, keepdims=True) * RNG.uniform(0, 1, (n, 1)) / np.linalg.norm(K, axis=1, keepdims=True)
    for _ in range(2):
        g /= np.linalg.norm(g, axis=1, keepdims=True)
    D[0], K[1] = 0.0, 0.0
    J[2], D[2], K[2], g[2] = (1, 2, 4), 3.0, (4.32, -2.16, 3.24), np.array([2, 3, 6]) / 7  # folds at its fourth step
    J[3], D[3], K[3] = (1, 2, 4), 3.0, (3.1, 0.2, 0.1)  # beyond the certificate
    K[4] = (tiny, 20 * tiny, 0)
    D[5:8], K[8] = (1e2, 1e6, heavy), 1e4 * K[8]  # and more than any rotation has
    J[9], D[9], K[9], g[9] = (1, 0, 0), 1.0, (0, 0, 1), (1, 0, 0)  # no inertia about its vertical
    K[10] = 0.3 * J[10].min() * g[10]  # vertical
    return Ball(J, D), K, g


def long_steps(n):
    """n balls whose steps need more than one round, up to a little below the bound of the certificate."""
    random = np.random.default_rng(9)
    K, g = random.normal(size=(n, 3)), random.normal(size=(n, 3))
    K *= random.choice([0.25, 0.3, 0.4, 0.45], (n, 1)) / np.linalg.norm(K, axis=1, keepdims=True)
    if n > block.LANES:
        K[3] *= 0.7 / np.linalg.norm(K[3])
    return Ball((0.1, 0.5, 1.6), 0.7), K, g / np.linalg.norm(g, axis=1, keepdims=True)


def beyond(n):
    """n balls beyond the bound of the certificate: most are proved on the path, some in a second round, some fold."""
    random = np.random.default_rng(9)
    K, g = random.normal(size=(n, 3)), random.normal(size=(n, 3))
    K *= random.choice([0.5, 0.6, 0.8, 1.0], (n, 1)) / np.linalg.norm(K, axis=1, keepdims=True)
    return Ball((0.1, 0.5, 1.6), 0.7), K, g / np.linalg.norm(g, axis=1, keepdims=True)


def floats_of(run):
    """All arrays of a run; of pairs both halves."""
    halves = [run] if run.low is None else [run, run.low]
    found = (getattr(half, name) for half in halves for name in ("momentum", "gamma", "attitude", "contact"))
    return [array for array in found if array is not None]


def alone(*arguments, **options):
    """A run of one ball up to its end, why it ended there and after how many steps."""
    try:
        run = chapsym.trajectory(*arguments, **options)
    except StepNotTaken as stopped:
        return stopped.trajectory, stopped.status, stopped.index
    return run, Status.TAKEN, run.taken


@pytest.mark.parametrize(
    ("precision", "made", "n", "numba", "order"),
    [(p, balls, n, True, 2) for p in PRECISIONS for n in (12, block.LANES, 150)]
    + [("single", balls, n, False, 2) for n in (12, 150)]
    + [("double", balls, 40, False, 2)]
    + [(p, long_steps, 2 * block.LANES + 5, True, 2) for p in PRECISIONS]
    + [(p, beyond, block.LANES + 9, True, 2) for p in PRECISIONS]
    + [(p, balls, block.LANES + 5, True, order) for p in ("double", "single") for order in (4, 6, 8)]
    + [("double", made, block.LANES + 5, True, order) for made in (long_steps, beyond) for order in (4, 8)],
)
def test_a_batch_is_its_balls_to_the_bit(precision, made, n, numba, order, monkeypatch):
    """One of the long steps cannot be certified: it neither stops the rounds of the others nor is settled by them."""
    ball, K, g = made(n, 1e-12, 1e8) if precision == "single" and made is balls else made(n)
    options = {"every": 7, "precision": precision, "order": order}
    with monkeypatch.context() as patch:
        patch.setattr(double, "BLOCKS", 0)
        if not numba:
            patch.setattr(double, "has_numba", lambda: False)
            patch.setattr(columns, "LANES", 15)  # and one to spare
        run = chapsym.trajectory(ball, K, g, 2100, **options)
    J, D = np.broadcast_to(ball.mass_tensor, (n, 3)), np.broadcast_to(ball.D, n)
    for i in [*range(12), *range(12, n, 31), n - 1]:
        one, *end = alone(Ball(J[i], D[i]), K[i], g[i], 2100, **options)
        assert [run.status[i], run.taken[i]] == end
        for all_, few in zip(floats_of(run), floats_of(one), strict=True):
            assert np.array_equal(all_[i, : len(few)], few)
            assert np.isnan(all_[i, len(few) :]).all()
    assert made is not balls or run.status[[8, 9]].tolist() == [Status.UNREACHABLE, Status.NO_INERTIA]
    assert made is not balls or order != 2 or run.status[2] == Status.FOLDED


@pytest.mark.parametrize(("n", "widths"), [(2, [8]), (9, [16]), (41, [40, 8]), (63, [40, 24])])
def test_a_block_is_as_wide_as_its_balls_need(n, widths, monkeypatch):
    if not double.has_numba():
        pytest.skip("numba is not installed")
    used, (march, prepare) = [], double.load((block.march_block, block.prepare_block))
    spied = [lambda state, *rest: used.append(state.shape[1]) or march(state, *rest), prepare]
    ball, K, g = long_steps(n)
    with monkeypatch.context() as patch:
        patch.setattr(double, "load", lambda functions: spied)
        run = chapsym.trajectory(ball, K, g, 1100, every=100, threads=1)
    assert used == widths
    for i in {0, 1, n - 1}:
        one = chapsym.trajectory(ball, K[i], g[i], 1100, every=100)
        assert all(np.array_equal(all_[i], few) for all_, few in zip(floats_of(run), floats_of(one), strict=True))


@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize(("made", "order"), [(balls, 2), (long_steps, 2), (balls, 6), (long_steps, 8)])
def test_bodies_roll_in_a_block_as_alone(made, order, precision, monkeypatch):
    """In double precision in a block, in single one by one; also those that stop, and from attitudes that are given."""
    monkeypatch.setattr(double, "BLOCKS", 0)
    n = block.LANES + 5
    ball, K, g = made(n, 1e-12, 1e8) if precision == "single" and made is balls else made(n)
    J, D, radius = np.broadcast_to(ball.mass_tensor, (n, 3)), np.broadcast_to(ball.D, n), np.linspace(0.1, 2, n)
    turned = kernels.compose(np.array([0.8, 0, 0, 0.6]), attitude_with(g))  # about the vertical
    options = {"every": 7, "contact": True, "precision": precision, "order": order}
    run = chapsym.trajectory(Ball(J, D, radius), K, g, 1100, attitude=turned, **options)
    for i in [*range(12), n - 2, n - 1]:
        one, *end = alone(Ball(J[i], D[i], radius[i]), K[i], g[i], 1100, attitude=turned[i], **options)
        assert [run.status[i], run.taken[i]] == end
        for all_, few in zip(floats_of(run), floats_of(one), strict=True):
            assert np.array_equal(all_[i, : len(few)], few)
            assert np.isnan(all_[i, len(few) :]).all()


@pytest.mark.parametrize("loops", [double.DOUBLE, single.loops()], ids=["double", "single"])
def test_the_rows_of_a_block_begin_on_lines_of_the_cache(loops):
    rows = loops.block.rows(7, loops.dtype)
    assert rows.shape == (7, loops.block.LANES)
    assert {row.ctypes.data % 64 for row in rows} == {0}


@pytest.mark.parametrize("numba", [True, False])
def test_steps_beyond_the_bound_are_proved_in_their_lanes(numba, monkeypatch):
    """To the bit those of one ball in plain Python; and what takes the continuation is a few of a hundred steps."""
    ball, K, g = beyond(24)
    K *= 0.7
    if not numba:
        monkeypatch.setattr(double, "has_numba", lambda: False)
    run = chapsym.trajectory(ball, K, g, 40)
    continued = []
    monkeypatch.setattr(double, "has_numba", lambda: False)
    small_rotation = loop.small_rotation
    monkeypatch.setattr(loop, "small_rotation", lambda *args: continued.append(args) or small_rotation(*args))
    for i in range(24):
        one = chapsym.trajectory(ball, K[i], g[i], 40)
        assert all(np.array_equal(all_[i], few) for all_, few in zip(floats_of(run), floats_of(one), strict=True))
    assert 0 < len(continued) < 0.1 * 24 * 40


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("options", [{}, {"order": 4}, {"contact": True}, {"order": 8, "contact": True}])
def test_plain_is_compiled_to_the_bit(precision, options, monkeypatch):
    ball, state = Ball((0.1, 0.5, 1.6), 0.7, radius=0.1), ((0.03, -0.02, 0.035), np.array([2, 3, 6]) / 7)
    with monkeypatch.context() as patch:
        patch.setattr(double, "has_numba", lambda: False)
        steps = 120 if precision == "double-double" and options else 1100
        plain = chapsym.trajectory(ball, *state, steps, precision=precision, **options)
    run = chapsym.trajectory(ball, *state, 2200, precision=precision, **options)
    for few, many in zip(floats_of(plain), floats_of(run), strict=True):
        assert np.array_equal(few, many[: len(few)])


@pytest.mark.parametrize("precision", PRECISIONS)
def test_no_balls_and_no_axes(precision):
    none = chapsym.trajectory(Ball((1, 2, 4), 3), np.zeros((0, 3)), np.zeros((0, 3)), 5, precision=precision)
    assert {x.shape for x in floats_of(none)} == {(0, 6, 3)}
    ball, K = Ball((1, 2, 4), np.array(3.0)), (0.03, -0.02, 0.035)
    run = chapsym.trajectory(ball, K, np.float32((0, 0, 1)), np.int64(5), precision=precision)
    assert run.momentum.shape == (6, 3)
    assert chapsym.trajectory(ball, K, (0, 0, 1), 0, attitude=True, precision=precision).momentum.shape == (1, 3)
    assert (chapsym.trajectory(ball, (0, 0, 0), (0, 0, 1), 5, precision=precision).momentum == 0).all()
    with pytest.raises(BadInput, match="3 components"):
        chapsym.trajectory(ball, np.float32(1.0), (0, 0, 1), 5, precision=precision)


def no_bodies(n):
    return False, np.zeros((7, block.LANES)), np.zeros((n, 0, 4)), np.zeros((n, 0, 2))


def block_of(n):
    """A block of long steps after 20 of them, and the arrays that a step fills; in plain Python."""
    ball, K, g = long_steps(n)
    state, scale = np.zeros((loop.ROWS, block.LANES)), np.zeros(n)
    block.prepare_block(K, g, np.tile(ball.mass_tensor, (n, 1)), np.full(n, ball.D), state, scale)
    march = double.chosen((block.march_block,), double.SHORT_RUN)[0] if double.has_numba() else block.march_block
    frames, ends = np.zeros((n, 1, 3)), (np.zeros(n, np.int64), np.zeros(n, np.int64), np.ones(n))
    march(state, 0, 20, 100, scale, frames, frames.copy(), *ends, *no_bodies(n))
    assert not ends[1].any()
    return state, np.zeros((7, block.LANES)), np.zeros(block.LANES, np.int32)


def test_further_rounds_are_those_of_the_search():
    """Lane by lane and to the bit, also for a guess outside the ball of the lemma and for one that is far off."""
    S, P, ok = block_of(block.LANES)
    S[loop.A : loop.A + 3, 0] = 3.0  # outside: from no rotation
    S[loop.A : loop.A + 3, 1] *= -0.9
    S[loop.RADIUS, 2], S[loop.ENOUGH, 2] = -1.0, 1.0  # a ball so slow that its squares underflow: never
    settled, rounds = [], 0
    while len(settled) < block.LANES - 1:
        block.corrected(S, P, ok, rounds > 0)
        rounds += 1
        now = np.flatnonzero(ok)
        assert set(settled) <= set(now)
        settled = now.tolist()
        assert rounds <= gibbs.MOST_ROUNDS
    assert rounds >= 3
    assert 2 not in settled
    for i in settled:
        s = S[:, i].tolist()
        found = gibbs.search(*s[loop.A : loop.A + 3], *s[:6], *s[loop.I : loop.ENOUGH + 1])
        assert found == (True, *P[:, i])


def test_a_lane_that_has_settled_stays():
    """Whatever a round from there would say, as where the root of one correction is a little outside."""
    S, P, ok = block_of(block.LANES)
    for again in (False, True, True, True):
        block.corrected(S, P, ok, again)
    assert ok.all()
    kept = P.copy()
    S[loop.RADIUS] = -1.0
    assert block.corrected(S, P, ok, True) == 0
    assert (kept == P).all()


def test_a_block_of_long_steps_mends_no_lane(monkeypatch):
    """The rounds that all lanes take together settle them; were they wrong, mending would still find the rotation."""
    S, _, _ = block_of(block.LANES)
    n, few = block.LANES, []
    monkeypatch.setattr(block, "FEW", 0)
    monkeypatch.setattr(block, "mend", lambda S, P, ok, *rest: few.append(int((ok == 0).sum())))
    frames, ends = np.zeros((n, 1, 3)), (np.zeros(n, np.int64), np.zeros(n, np.int64), np.ones(n))
    block.march_block(S, 20, 5, 100, np.ones(n), frames, frames.copy(), *ends, *no_bodies(n))
    assert few == []


@pytest.mark.parametrize("precision", ["double", "double-double"])
@pytest.mark.parametrize("options", [{}, {"attitude": True}])
def test_threads_change_nothing(precision, options):
    ball, K, g = balls(300)
    one, two = (chapsym.trajectory(ball, K, g, 20, threads=n, precision=precision, **options) for n in (1, 2))
    for a, b in zip([*floats_of(one), one.taken, one.status], [*floats_of(two), two.taken, two.status], strict=True):
        assert np.array_equal(a, b, equal_nan=True)


@pytest.mark.parametrize(("numba", "options"), [(True, {}), (True, {"attitude": True}), (False, {})])
def test_chunks_change_nothing(numba, options, monkeypatch):
    """Also where a ball rests, for a later chunk, and where a frame falls between two."""
    ball, K, g = balls(70)
    whole = chapsym.trajectory(ball, K, g, 1300, every=13, **options)
    if not numba:
        monkeypatch.setattr(double, "has_numba", lambda: False)
    monkeypatch.setattr(double, "CHUNK", 97 * (block.LANES if numba else 70))
    parts = chapsym.trajectory(ball, K, g, 1300, every=13, **options)
    for a, b in zip([*floats_of(whole), whole.taken], [*floats_of(parts), parts.taken], strict=True):
        assert np.array_equal(a, b, equal_nan=True)


def test_progress_counts_the_steps_of_all_balls():
    ball, K, g = balls(130)
    seen = []
    chapsym.trajectory(ball, K, g, 50, progress=seen.append)
    assert seen[-1] == 130 * 50
    assert seen == sorted(seen)


@pytest.mark.parametrize("threads", [1, 2])
def test_an_interrupt_ends_the_run(threads):
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


def test_the_energy_of_the_top_stays():
    """At D = 0 the map keeps the energy; its rounding errors add up like √n: 2e-14 in 10⁸ steps, so 2e-15 in 10⁶."""
    run = chapsym.trajectory(
        Ball((0.1, 0.5, 1.6), 0.0), (0.03, -0.02, 0.035), np.array([2, 3, 6]) / 7, 10**6, every=1000
    )
    u = discrete_energy(run)
    assert np.abs(u / u[0] - 1).max() <= 4e-15


def discrete_energy(run):
    """½⟨K, J⁻¹... ⟩ of the discrete top: the quadratic form of prop-3 for 𝒦 along its own vertical, ⟨𝒦, Λ⁻¹𝒦⟩."""
    return (run.momentum**2 / run.ball.inertia).sum(axis=-1)
