"""Crews of this machine: this thread, some threads, or a process for each core."""

import multiprocessing
from collections.abc import Callable, Collection, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from typing import Any

from chapsym.dynamics import BadInput
from chapsym.workers import begin

from .chains import Call


class Here(Executor):
    """This thread: each call is made when it is submitted."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Makes the call."""
        future: Future[Any] = Future()
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as error:
            future.set_exception(error)
        return future


class Pool:
    """An executor with so many workers; each finds a next call when it has made one."""

    lost: tuple[type[BaseException], ...] = ()

    def __init__(self, executor: Executor, workers: int) -> None:
        self.executor, self.workers = executor, workers

    def room(self) -> int:
        """Two calls for each; of this thread, one after the other."""
        return 1 if isinstance(self.executor, Here) else 2 * self.workers

    def submit(self, call: Call) -> Future[Any]:
        """A future of the executor."""
        return self.executor.submit(call.function, *call.arguments)

    def landed(self, futures: Collection[Future[Any]]) -> Collection[Future[Any]]:
        """Waits for one of them."""
        return wait(futures, return_when=FIRST_COMPLETED).done


@contextmanager
def threads(count: int) -> Iterator[Pool]:
    """So many threads; at the end, or after an error, those that run are waited for."""
    with ThreadPoolExecutor(count) if count > 1 else Here() as executor:
        try:
            yield Pool(executor, count)
        finally:
            executor.shutdown(wait=True, cancel_futures=True)


@contextmanager
def processes(count: int) -> Iterator[Pool]:
    """So many processes; at the end, or after an error, those that run are ended.

    Raises BadInput if one was ended from outside and the chain of its call did not take that.
    """
    if count <= 1:
        yield Pool(Here(), 1)
        return
    # A child is not forked: threads and Arb's precision are of a process.
    executor = ProcessPoolExecutor(count, multiprocessing.get_context("spawn"), initializer=begin)
    try:
        yield Pool(executor, count)
    except BrokenProcessPool:  # unless its chain lets others go on
        raise BadInput("a process of this run was ended, perhaps for lack of memory; begin again") from None
    finally:
        children = list((executor._processes or {}).values())  # the pool forgets them at its shutdown
        executor.shutdown(wait=False, cancel_futures=True)
        for process in children:
            if process.is_alive():
                process.terminate()
