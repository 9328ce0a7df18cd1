"""Worker processes: how they begin, and that they end with the process that started them, or with its `with`."""

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from typing import Any

#: Ignores the warning of Python's tracker, which removes the semaphores of a killed process; an option -W.
TRACKER = "ignore:resource_tracker:UserWarning"
#: Why a pool is broken if a worker, or Python's tracker, has closed its pipe; standard output is not closed.
CANNOT_BEGIN = "a worker process cannot begin"
#: Seconds to wait for workers that were ended; in a compiled loop they may be longer.
LONG = 2.0


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
            # The pool starts this thread later, and would wait for ever for its calls if the system refuses it.
            if start := getattr(self._call_queue, "_start_thread", None):  # type: ignore[attr-defined]
                start()
        except BrokenPipeError:
            raise BrokenProcessPool(CANNOT_BEGIN) from None
        finally:
            sys.warnoptions.remove(TRACKER)

    def submit(self, *call: Any, **named: Any) -> Future[Any]:
        """A call; the first one starts the processes."""
        with _deaf():
            try:
                return super().submit(_called, *call, **named)
            except (RuntimeError, OSError) as error:
                # Too few threads or processes: those that begin would find nothing.
                for process in (self._processes or {}).values():
                    process.kill()
                if isinstance(error, BrokenPipeError):
                    raise BrokenProcessPool(CANNOT_BEGIN) from None
                raise

    def __exit__(self, *error: object) -> None:
        # The pool forgets both at its shutdown.
        children, manager = list((self._processes or {}).values()), getattr(self, "_executor_manager_thread", None)
        self.shutdown(wait=False, cancel_futures=True)
        for process in children:
            process.terminate()
        if manager is not None and manager.is_alive():
            manager.join(LONG)  # else it may close its pipe when Python, at its end, writes to it


@contextmanager
def _deaf() -> Iterator[None]:
    """A process that begins in it, a worker or Python's tracker, sees no interrupt of a terminal, nor its end.

    A worker gets SIGTERM after `begin`, which unblocks it.
    """
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGHUP, signal.SIGQUIT, signal.SIGTERM})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


#: Seconds after which a worker that was asked to end is killed: it may be at a long call of C, or at a broken pipe.
GRACE = 3


def begin() -> None:
    """In a worker: an interrupt is for the parent; and when that is gone, however it was ended, the worker ends.

    What a user's script prints goes to standard error: the parent's standard output may be one JSON object.
    """
    sys.stdout = sys.stderr
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, _end)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGTERM})
    sys.unraisablehook = lambda what: None if _state["ended"] else sys.__unraisablehook__(what)
    with suppress(RuntimeError):  # without a thread the worker ends only with the `with` of its parent
        threading.Thread(target=_outlived, daemon=True).start()


#: Of a worker: whether it is at a call, and whether it was asked to end.
_state = {"calls": False, "ended": False}


def _end(*_: object) -> None:
    """Ends the call; between two of them a message may be half read or half sent, and the pool ends the worker."""
    again, _state["ended"] = _state["ended"], True
    if not again:
        signal.alarm(GRACE)  # of which a process dies
        if _state["calls"]:
            raise SystemExit(1)


def _called(call: Callable[..., Any], *arguments: Any, **named: Any) -> Any:
    """The result of a call, in a worker; raises BrokenProcessPool if the worker was asked to end before."""
    found = None
    try:
        _state["calls"] = True
        found = None if _state["ended"] else call(*arguments, **named)
    except SystemExit:
        if not _state["ended"]:
            raise
    finally:
        _state["calls"] = False
    if _state["ended"]:
        raise BrokenProcessPool("a worker process was asked to end")
    return found


def _outlived() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
