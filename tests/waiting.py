"""Waiting for what must come, as long as it takes: no test passes or fails by the clock."""

import time

#: Seconds after which nothing comes any more: against hanging only, far beyond what any machine takes.
GUARD = 1800
#: For a child that is sent SIGINT: one that was started in the background inherits it as ignored.
INTERRUPTIBLE = "import signal\nsignal.signal(signal.SIGINT, signal.default_int_handler)\n"


def until(happened, running=None):
    """Waits until a function says so, and returns what it said; fails where the process that is waited for has ended.

    What it says counts once more after the end: the last thing that a process does may be this.
    """
    for _ in range(50 * GUARD):
        ended = running is not None and running.poll() is not None
        if found := happened():
            return found
        assert not ended, f"it has ended with {running.returncode}"
        time.sleep(0.02)
    raise AssertionError("it did not happen")
