"""Chains of calls: in order, abreast, tried again where a worker is lost, and ended by what they let through."""

import errno
import os
from concurrent.futures import Future, ProcessPoolExecutor

import pytest

from chapsym import jobs
from chapsym.dynamics import BadInput
from chapsym.jobs import Here, Pool


class Gone(Exception):
    """A worker's end."""


class Paper:
    """A crew that lands the call that was submitted last, and loses those it is words to."""

    lost = (Gone,)

    def __init__(self, room=2, lose=()):
        self.most, self.size, self.lose, self.seen, self.submitted = 0, room, list(lose), [], []

    def room(self):
        return self.size

    def submit(self, call):
        future = Future()
        if call.arguments in self.lose:
            self.lose.remove(call.arguments)
            future.set_exception(Gone())
        else:
            future = Here().submit(call.function, *call.arguments)
        self.submitted.append(call.arguments)
        return future

    def landed(self, futures):
        self.most = max(self.most, len(futures))
        return [list(futures)[-1]]


def chain(name, kept, length=3):
    total = 0
    for i in range(length):
        try:
            total = yield jobs.Call(lambda name, i, total: total + 10**i, (name, i, total))
        except jobs.Lost as error:
            kept[name] = str(error)
            return
    kept[name] = total


AGAIN = ("a", 1, 1)


@pytest.mark.parametrize(
    ("crew", "lengths", "kept", "most"),
    [
        (Paper(room=2), dict.fromkeys("abcde", 3), dict.fromkeys("abcde", 111), 2),
        (Paper(room=1), {"a": 0, "b": 0, "c": 3}, {"a": 0, "b": 0, "c": 111}, 1),
        (Paper(room=0), {"a": 3, "b": 3}, {"a": 111, "b": 111}, 1),
        (Paper(lose=[AGAIN] * (jobs.TRIES - 1)), {"a": 3, "b": 3}, {"a": 111, "b": 111}, 2),
        (Paper(lose=[AGAIN] * jobs.TRIES), {"a": 3, "b": 3}, {"a": "its worker was lost, 3 times", "b": 111}, 2),
    ],
    ids=["abreast", "without calls", "without room", "lost and made again", "lost each time"],
)
def test_each_call_gets_what_the_one_before_gave_and_so_many_are_abreast(crew, lengths, kept, most):
    """A chain without calls leaves its room, a crew without room gets one call, a chain ends that is lost each time."""
    found, lost = {}, len(crew.lose)
    jobs.run((chain(name, found, length) for name, length in lengths.items()), crew)
    assert found == kept
    assert crew.most == most
    assert not lost or crew.submitted.count(AGAIN) == min(lost + 1, jobs.TRIES)


class Shared(Paper):
    """One worker for all that is in hand: it ends with a call of the chain "deadly", and takes the others with it."""

    def submit(self, call):
        self.submitted.append(call.arguments)
        future = Future()
        future.call = call
        return future

    def landed(self, futures):
        deadly = any(future.call.arguments[0] == "deadly" for future in futures)
        for future in futures:
            if deadly:
                future.set_exception(Gone())
            else:
                future.set_result(future.call.function(*future.call.arguments))
        return list(futures)


def test_a_call_that_ends_its_worker_is_told_alone():
    """Those that waited at the same worker have their results in the end."""
    found = {}
    jobs.run((chain(name, found) for name in ("a", "deadly", "b")), Shared(room=3))
    assert found == {"a": 111, "deadly": "its worker was lost, 3 times", "b": 111}


def test_an_error_of_a_call_is_raised_in_its_chain_which_may_go_on():
    found = []

    def careful():
        try:
            yield jobs.Call(int, ("x",))
        except ValueError:
            found.append((yield jobs.Call(int, ("7",))))

    jobs.run([careful()], Paper())
    assert found == [7]


@pytest.mark.parametrize("crew", [Paper(), Pool(Here(), 1)])
def test_an_error_that_a_chain_lets_through_ends_the_run(crew):
    kept = {}

    def careless():
        yield jobs.Call(int, ("x",))

    with pytest.raises(ValueError, match="invalid literal"):
        jobs.run([careless(), chain("b", kept)], crew)


def test_threads_work_abreast_and_one_is_this_one():
    kept = {}
    for count in (1, 2):
        with jobs.threads(count) as crew:
            assert isinstance(crew.executor, Here) == (count == 1)
            jobs.run((chain(f"{name}{count}", kept) for name in "abc"), crew)
    assert set(kept.values()) == {111}
    assert len(kept) == 6


def test_a_process_that_is_killed_ends_the_run_in_a_sentence():
    def one():
        yield jobs.Call(os._exit, (1,))

    with pytest.raises(BadInput, match="a process of this run was ended"), jobs.processes(2) as crew:
        jobs.run([one()], crew)


@pytest.mark.parametrize("method", ["__init__", "submit"])
def test_processes_that_cannot_begin_are_no_closed_output(monkeypatch, method):
    """Python writes to a process that ends at once, as where a user may not read the interpreter of the environment."""

    def refused(*arguments, **named):
        raise BrokenPipeError(errno.EPIPE, "Broken pipe")

    monkeypatch.setattr(ProcessPoolExecutor, method, refused)
    with pytest.raises(BadInput, match="a process of this run was ended"), jobs.processes(2) as crew:
        jobs.run([chain("a", {})], crew)


def test_a_time_is_read_in_the_largest_unit_of_which_there_is_one():
    assert [jobs.duration(x) for x in (3600, 60, 59.9, 1, 0.5, 0)] == ["1 h", "1 min", "60 s", "1 s", "500 ms", "0 µs"]
