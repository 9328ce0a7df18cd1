"""Worker processes: how they begin, and that they end with the process that started them."""

import multiprocessing
import os
import signal
import threading


def begin() -> None:
    """In a worker: an interrupt is for the parent; and when that is gone, however it was ended, the worker ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_outlived, daemon=True).start()


def _outlived() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
