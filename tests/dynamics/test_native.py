"""The compiled loops: the bits of the same loops in Python, and sentences for arguments that they do not take."""

import logging
import os
from copy import deepcopy

import numpy as np
import pytest
from balls_n import batch
from crowds import alone, balls, beyond, long_steps
from plain import in_plain_python

import chapsym
from chapsym import Ball
from chapsym.dynamics import native
from chapsym.dynamics.loops import block, loop, twins
from research.chaos.orbits import follow_orbits

#: Only where no C was asked for: a compilation that failed is a failure of the tests, not a reason to skip them.
needs_compiled = pytest.mark.skipif("CHAPSYM_WITHOUT_C" in os.environ, reason="CHAPSYM_WITHOUT_C is set")
BODY = {"contact": True}


def same(a, b):
    """Whether two numbers or arrays are the same to the bit, but for which NaN it is."""
    return np.array_equal(a, b, equal_nan=True) and np.array_equal(np.signbit(a)[a == a], np.signbit(b)[b == b])


def flat(arguments):
    """Arguments with the fields of records in their places."""
    return [one for x in arguments for one in (flat(x) if isinstance(x, tuple) else [x])]


@pytest.fixture
def called(monkeypatch):
    """Every loop is called in C and in Python, on copies of the same arguments; the names of those that were."""
    names, compiled = set(), native.loop

    def both(function, dtype=np.float64):
        fast = compiled(function, dtype)
        # Blocks of float32 have no twin: `test_batches` and `any_magnitudes` compare their balls.
        if function in (block.march_blocks, block.advance_blocks) and dtype == np.float32:
            return fast
        slow = np.errstate(all="ignore")(function if dtype is np.float64 else twins.single(function))

        def call(*arguments):
            copies = deepcopy(arguments)
            wanted, found = slow(*copies), fast(*arguments)
            assert same(np.array(found, dtype=float), np.array(wanted, dtype=float))
            for i, (x, y) in enumerate(zip(flat(arguments), flat(copies), strict=True)):
                assert not isinstance(x, np.ndarray) or same(x, y), f"{function.__name__}, the argument {i}"
            names.add(f"{function.__module__.rpartition('.')[2]}_{function.__name__}")
            return found

        return call

    monkeypatch.setattr(native, "loop", both)
    return names


def each(made, steps, **options):
    """Balls of a kind, one by one, up to where they stop."""
    ball, K, g = made(12, 1e-12, 1e8) if made is balls and options.get("precision") == "single" else made(12)
    J, D = np.broadcast_to(ball.mass_tensor, (12, 3)), np.broadcast_to(ball.D, 12)
    for i in range(12):
        alone(Ball(J[i], D[i], radius=0.3), K[i], g[i], steps, every=3, **options)


def together(made, n, steps, **options):
    ball, K, g = made(n)
    ball = Ball(np.broadcast_to(ball.mass_tensor, (n, 3)), np.broadcast_to(ball.D, n), np.linspace(0.1, 2.0, n))
    return chapsym.trajectory(ball, K, g, steps, every=7, **options)


def restored(steps, balls_=1, **options):
    """Past a restoration of the integrals."""
    K = np.array([0.03, -0.02, 0.035]) * np.linspace(1.0, 1.5, balls_)[:, None]
    ball, gamma = Ball((0.1, 0.5, 1.6), 0.7, radius=0.1), np.array([2, 3, 6]) / 7
    chapsym.trajectory(ball, K if balls_ > 1 else K[0], gamma, steps, every=steps, **options)


def any_magnitudes(precision, **options):
    """Steps of balls and momenta that are as large or as small as numbers are, together and alone to the same bits."""
    rng, n = np.random.default_rng(16), 100
    low, high = (-30, 30) if precision == "single" else (-300, 300)
    scale = 10.0 ** rng.uniform(low, high, (n, 1))
    J, D = scale * 10.0 ** rng.uniform(-3, 3, (n, 3)), scale[:, 0] * 10.0 ** rng.uniform(-5, 5, n)
    K, g = scale * rng.normal(size=(n, 3)) * 10.0 ** rng.uniform(-6, 2, (n, 1)), rng.normal(size=(n, 3))
    g /= np.linalg.norm(g, axis=1, keepdims=True)
    step = chapsym.step(Ball(J, D), K, g, precision=precision, **options)
    assert len(set(step.status.tolist())) > 1
    for i in range(n):
        if step.status[i]:
            with pytest.raises(chapsym.StepNotTaken) as caught:
                chapsym.step(Ball(J[i], D[i]), K[i], g[i], precision=precision)
            assert (caught.value.status, caught.value.reach) == (step.status[i], step.reach[i])
        else:
            one = chapsym.step(Ball(J[i], D[i]), K[i], g[i], precision=precision)
            assert all(same(getattr(step, name)[i], getattr(one, name)) for name in ("rotation", "momentum", "gamma"))


def long(n, **options):
    ball, K, g = beyond(n)
    chapsym.extrapolate(Ball(ball.mass_tensor, ball.D, radius=0.4), 2 * K, g, steps=3, every=2, threads=1, **options)


def in_four():
    ball, K, g = batch(4, 3, 0.1)
    for options in (BODY, {"order": 4}):
        chapsym.trajectory_n(ball, K, g, 12, every=5, **options)


def rolled(n, steps=40, time_step=0.11, **options):
    """Motions to an accuracy: a ball beside an unstable rotation is among them."""
    omega = np.random.default_rng(5).normal(size=(n, 3))
    omega[0] = 1e-4, 2.0, 1e-5
    ball = Ball.from_mass_tensor((0.003, 0.005, 0.009), mass=2.0, radius=0.1)
    chapsym.roll(ball, omega if n > 1 else omega[0], time_step, steps, **options)


def chaotic():
    K = np.random.default_rng(3).normal(size=(3, 3)) * 0.4
    follow_orbits(Ball((1, 2, 4), 3), K, np.tile(np.array([2, 3, 6]) / 7, (3, 1)), 21)


ALONE = {"loop_prepare", "loop_march"}
PAIRS = {"double_double_prepare_pairs", "double_double_march_pairs"}
PAIRS_BLOCK = {"double_double_prepare_pairs_block", "double_double_march_pairs_block"}
CASES = [
    *((lambda m=m, o=o: each(m, 24, **o), ALONE) for m in (balls, long_steps, beyond)
      for o in (BODY, BODY | {"precision": "single"})),
    *((lambda o=o: each(balls, 24, **o), ALONE) for o in ({}, {"precision": "single"})),
    *((lambda p=p, o=o: each(balls, 4, order=o, precision=p, **BODY), ALONE)
      for p in ("double", "single") for o in (4, 6, 8)),
    (lambda: each(balls, 4, precision="double-double"), PAIRS),
    (lambda: each(balls, 1, precision="double-double", order=4, **BODY), PAIRS),
    *((lambda m=m, o=o: together(m, 12, 21, **o), {"block_march_blocks"}) for m in (balls, long_steps, beyond)
      for o in ({}, BODY)),
    *((lambda o=o: together(balls, 12, 7, order=o), {"block_march_blocks"}) for o in (4, 6, 8)),
    *((lambda m=m, o=o: each(m, 9, proved=True, **o), PAIRS | ALONE)
      for m in (balls, beyond) for o in (BODY, {"order": 4})),
    (lambda: together(balls, 12, 7, precision="double-double"), PAIRS_BLOCK),
    (lambda: restored(1100, **BODY), ALONE),
    (lambda: restored(1100, precision="single", **BODY), ALONE),
    (lambda: restored(63, order=8), ALONE),
    (lambda: restored(63, 2, order=8), {"block_march_blocks"}),
    (lambda: any_magnitudes("double"), {"loop_advance_all", "block_advance_blocks"}),
    (lambda: any_magnitudes("double", proved=True), {"proved_bound_steps"}),
    (lambda: any_magnitudes("single"), {"loop_advance_all"}),
    *((lambda n=n, o=o: long(n, **o), loops) for o in ({"time_step": 0.3, "contact": True}, {"time_step": 1.0},
      {"time_step": 0.7, "columns": 2, "attitude": True})
      for n, loops in ((1, {"lanes_march_alone"}), (9, {"lanes_march", "lanes_march_alone"}))),
    (lambda: long(2, time_step=0.3, contact=True, precision="double-double"), {"double_double_march_long_pairs"}),
    (in_four, {"loop_n_march"}),
    (lambda: chapsym.trajectory_vertical(Ball((1, 2, 4), 0), [0.3, 1.0, 0.0], (0.6, 0.0, 0.8), 300),
     {"vertical_loop_march"}),
    (chaotic, {"tangent_follow_all"}),
    *((lambda n=n, o=o: rolled(n, **o), {"expected_surveyed", "expected_estimated", loop})
      for o in ({"contact": True}, {"steps": 7, "accuracy": 1e-10}, {"time_step": 0.01, "attitude": True})
      for n, loop in ((1, "following_follow_alone"), (9, "following_follow"))),
]  # fmt: skip


@needs_compiled
def test_the_loops_are_compiled():
    assert native.is_compiled(), (
        "the installation of chapsym did not compile generated/loops.c, or compiled another text"
    )


@needs_compiled
@pytest.mark.parametrize("case", range(len(CASES)))
def test_a_loop_has_the_same_bits_in_c_and_in_python(case, called):
    run, loops = CASES[case]
    run()
    assert called >= loops


@needs_compiled
def test_every_loop_is_among_the_cases():
    exported = set().union(*(loops for _, loops in CASES))
    assert exported == set(native._tables()["float64"])
    assert set(native._tables()["float32"]) == {
        *ALONE,
        "block_march_blocks",
        "block_advance_blocks",
        "loop_advance_all",
    }


@needs_compiled
def test_compiled_loops_of_another_text_are_not_taken(monkeypatch, caplog):
    monkeypatch.setattr(native, "TEXT", "another")
    for cached in (native._tables, native.loop, native._say_once):
        monkeypatch.setattr(native, cached.__name__, cached.__wrapped__)
    with caplog.at_level(logging.WARNING, "chapsym"):
        assert not native.is_compiled()
        run = chapsym.trajectory(Ball((1, 2, 4), 3), (0.3, 0.2, 0.1), (0, 0, 1), 3)
    assert run.taken == 3
    assert "install chapsym again" in caplog.text
    assert "plain Python takes the steps" in caplog.text


def arguments():
    n = 2
    return [np.ones((n, 3)), np.tile([0, 0, 1.0], (n, 1)), np.ones((n, 3)), np.ones(n), np.zeros((n, 4)),
            np.zeros(n, np.int64), np.ones(n)]  # fmt: skip


def read_only(array):
    array.flags.writeable = False
    return array


@needs_compiled
@pytest.mark.parametrize(
    ("at", "change", "sentence"),
    [
        (0, lambda x: x[:, ::2], "an array of float64 is wanted, of 2 axes, the last contiguous"),
        (2, np.asfortranarray, "the last contiguous"),
        (3, lambda x: x.astype(np.int64), "float64 is wanted, of 1 axes"),
        (5, lambda x: x.astype(np.int32), "int64 is wanted, of 1 axes"),
        (0, lambda x: x[0], "of 2 axes"),
        (2, lambda x: x.astype(">f8"), "float64 is wanted"),
        (3, lambda x: 1.0, "a bytes-like object is required"),
    ],
)
def test_an_array_of_another_form_is_refused_with_a_sentence(at, change, sentence):
    given = arguments()
    given[at] = change(given[at])
    with pytest.raises(TypeError, match=sentence):
        native.loop(loop.advance_all)(*given)


@needs_compiled
def test_an_array_that_is_written_may_not_be_read_only():
    advance = native.loop(loop.advance_all)
    for at, is_written in enumerate([True, True, False, False, True, True, True]):
        given = arguments()
        read_only(given[at])
        if is_written:
            with pytest.raises((TypeError, ValueError, BufferError), match=r"read-only|writable"):
                advance(*given)
        else:
            advance(*given)


@needs_compiled
def test_another_number_of_arguments_and_a_number_of_another_type_are_refused():
    for given in ([], arguments()[:-1], [*arguments(), 1.0], [1.0] * 40):
        with pytest.raises(TypeError, match=r"takes another number of arguments than|bytes-like object is required"):
            native.loop(loop.advance_all)(*given)
    with pytest.raises(TypeError, match="takes no keyword arguments"):
        native.loop(loop.prepare)(momentum=np.ones(3))
    given = [np.ones(3), np.ones(3), np.ones(3), "1", np.ones(1), np.zeros(loop.ROWS), np.ones((2, 1))]
    with pytest.raises(TypeError, match="must be real number, not str"):
        native.loop(loop.prepare)(*given)


def test_a_loop_that_is_not_compiled_says_so_once(caplog, monkeypatch):
    native._say_once.cache_clear()
    say = native._say_once
    with in_plain_python(), caplog.at_level(logging.WARNING, "chapsym"):
        monkeypatch.setattr(native, "_say_once", say)
        for function in (loop.march, loop.prepare):
            native.loop(function)
    assert caplog.text.count("install a C compiler") == 1
