"""Worker processes: how they begin, and that they end with the process that started them, or with its `with`."""

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from contextlib import contextmanager
from typing import Any

#: Ignores the warning of Python's tracker, which removes the semaphores of a killed process; an option -W.
TRACKER = "ignore:resource_tracker:UserWarning"


class Processes(ProcessPoolExecutor):
    """Worker processes, of which none sees an interrupt, not even while it begins: that is for this process.

    The end of their `with` waits for no call: it raises SystemExit in those that are at one, which take away what they
    have begun to write.
    """

    def __init__(self, count: int, first: Callable[[], None] | None = None) -> None:
        sys.warnoptions.append(TRACKER)  # for the tracker, which begins here: other children have what they had
        try:
            with _deaf():
                super().__init__(count, multiprocessing.get_context("spawn"), initializer=first or begin)
        finally:
            sys.warnoptions.remove(TRACKER)

    def submit(self, *call: Any, **named: Any) -> Future[Any]:
        """A call; the first one starts the processes."""
        with _deaf():
            return super().submit(_called, *call, **named)

    def __exit__(self, *error: object) -> None:
        children = list((self._processes or {}).values())  # the pool forgets them at its shutdown
        self.shutdown(wait=False, cancel_futures=True)
        for process in children:
            process.terminate()


@contextmanager
def _deaf() -> Iterator[None]:
    """A process that begins in it, a worker or Python's tracker, sees no interrupt of a terminal, nor its end."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGHUP, signal.SIGQUIT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def begin() -> None:
    """In a worker: an interrupt is for the parent; and when that is gone, however it was ended, the worker ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, _end)
    threading.Thread(target=_outlived, daemon=True).start()


_ended = threading.Event()


def _end(*signal: object) -> None:
    _ended.set()
    raise SystemExit(1)


def _called(call: Callable[..., Any], *arguments: Any, **named: Any) -> Any:
    """The result of a call, in a worker; a worker that was ended during the call begins no other."""
    try:
        return call(*arguments, **named)
    finally:
        if _ended.is_set():
            os._exit(1)


def _outlived() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
