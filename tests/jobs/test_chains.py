"""Chains of calls: in order, abreast, tried again where a worker is lost, and ended by what they let through."""

from concurrent.futures import Future

import pytest

from chapsym import jobs
from chapsym.jobs import chains
from chapsym.jobs.crews import Here, Pool


class Gone(Exception):
    """A worker's end."""


class Paper:
    """A crew that lands the call that was submitted last, and loses those it is told to."""

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


def test_each_call_gets_what_the_one_before_gave_and_so_many_are_abreast():
    kept, crew = {}, Paper(room=2)
    jobs.run((chain(name, kept) for name in "abcde"), crew)
    assert kept == dict.fromkeys("abcde", 111)
    assert crew.most == 2


def test_a_chain_without_calls_leaves_its_room_to_others():
    kept, crew = {}, Paper(room=1)
    jobs.run([chain("a", kept, 0), chain("b", kept, 0), chain("c", kept)], crew)
    assert kept == {"a": 0, "b": 0, "c": 111}


def test_a_crew_without_room_is_given_one_call_and_asked_again():
    kept, crew = {}, Paper(room=0)
    jobs.run([chain("a", kept), chain("b", kept)], crew)
    assert kept == {"a": 111, "b": 111}
    assert crew.most == 1


def test_a_call_whose_worker_is_lost_is_made_again():
    kept, crew = {}, Paper(lose=[("a", 1, 1)] * (chains.TRIES - 1))
    jobs.run([chain("a", kept), chain("b", kept)], crew)
    assert kept == {"a": 111, "b": 111}
    assert crew.submitted.count(("a", 1, 1)) == chains.TRIES


def test_a_call_that_is_lost_each_time_ends_its_chain_only():
    kept, crew = {}, Paper(lose=[("a", 1, 1)] * chains.TRIES)
    jobs.run([chain("a", kept), chain("b", kept)], crew)
    assert kept == {"a": "its worker was lost, 3 times", "b": 111}


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
