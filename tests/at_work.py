"""What worker processes of the tests are at when they are asked to end; a module that loads little in each of them."""

import os
import signal
import threading
import time
from contextlib import suppress
from unittest import mock

from waiting import GUARD

from chapsym.files import write_whole
from chapsym.workers import begin


def no_thread():
    """No thread begins in this `with`, as if the system refused it."""
    return mock.patch.object(threading.Thread, "start", side_effect=RuntimeError("can't start new thread"))


def crowded():
    with no_thread():
        begin()


def written(path):
    def write(stream):
        (path.parent / "begun").touch()
        time.sleep(GUARD)

    with suppress(SystemExit):
        write_whole(path, write)


def goes_on(folder):
    while True:
        with suppress(SystemExit):
            (folder / "begun").touch()
            time.sleep(GUARD)


def asked_to_end(caught):
    with suppress(caught):
        os.kill(os.getpid(), signal.SIGTERM)
        time.sleep(GUARD)
    return "made after all"


class Late:
    """What is pickled when its worker is asked to end."""

    def __reduce__(self):
        os.kill(os.getpid(), signal.SIGTERM)
        return str, ("whole",)
