"""Worker processes: how they begin, and that they end with the process that started them."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable
from concurrent.futures import Future, ProcessPoolExecutor
from typing import Any


class Processes(ProcessPoolExecutor):
    """Worker processes, of which none sees an interrupt, not even while it begins: that is for this process."""

    def __init__(self, count: int, first: Callable[[], None] | None = None) -> None:
        super().__init__(count, multiprocessing.get_context("spawn"), initializer=first or begin)

    def submit(self, *call: Any, **named: Any) -> Future[Any]:
        """A call; the first one starts the processes."""
        if not hasattr(signal, "pthread_sigmask"):  # Windows
            return super().submit(*call, **named)
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            return super().submit(*call, **named)
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)


def begin() -> None:
    """In a worker: an interrupt is for the parent; and when that is gone, however it was ended, the worker ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_outlived, daemon=True).start()


def _outlived() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
