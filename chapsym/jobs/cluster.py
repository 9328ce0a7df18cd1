"""The crew of a Dask cluster: the workers of a scheduler, which are to see the same disk and have the same chapsym."""

import logging
import time
from collections.abc import Collection, Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager
from typing import Any

from chapsym import extras
from chapsym.dynamics import BadInput

from .chains import Call

#: Seconds to wait for a scheduler, for its answers, and for a worker where none is left.
REACHED, ANSWERED, ABANDONED = 10.0, 60.0, 60.0


@contextmanager
def workers(address: str) -> Iterator["Workers"]:
    """The workers of the scheduler at an address; at the end, or after an error, their calls are cancelled.

    Raises BadInput if none answers there.
    """
    with _client(address) as client:
        crew = Workers(client, address)
        try:
            yield crew
        finally:
            if crew.flying:
                client.cancel(list(crew.flying), force=True)


class Workers:
    """Raises BadInput where the scheduler is lost, where there have been no workers for long, and where one errs."""

    def __init__(self, client: Any, address: str) -> None:
        from distributed import KilledWorker

        self.client, self.address = client, address
        self.lost: tuple[type[BaseException], ...] = (KilledWorker, CancelledError, OSError)
        self.flying: set[Any] = set()
        self.alone_since: float | None = None

    def room(self) -> int:
        """Two calls for each thread of the workers."""
        try:
            threads = sum(self.client.nthreads(callback_timeout=ANSWERED).values())
        except (OSError, TimeoutError, ValueError, RuntimeError):
            self.flying.clear()  # there is nobody who could cancel them
            told = "is lost; the same command goes on from what is written"
            raise BadInput(f"the Dask scheduler at {self.address} {told}") from None
        now = time.monotonic()
        self.alone_since = None if threads else self.alone_since or now
        if self.alone_since is not None and now - self.alone_since > ABANDONED:
            told = f"has had no workers for {ABANDONED:.0f} s; the same command goes on from what is written"
            raise BadInput(f"the Dask scheduler at {self.address} {told}")
        return 2 * threads

    def submit(self, call: Call) -> Any:
        """A future of Dask, never one of an earlier call."""
        future = self.client.submit(call.function, *call.arguments, pure=False)
        self.flying.add(future)
        return future

    def landed(self, futures: Collection[Any]) -> Collection[Any]:
        """Waits a second for one of them."""
        from distributed import wait

        try:
            done = set(wait(list(futures), timeout=1, return_when="FIRST_COMPLETED").done)
        except TimeoutError:
            done = set()
        except CancelledError:
            done = {future for future in futures if future.status in ("cancelled", "lost")}
        self.flying -= done
        return done


@contextmanager
def _client(address: str) -> Iterator[Any]:
    extras.need("cluster")
    from distributed import Client
    from distributed.comm import parse_address, parse_host_port

    wrong = f"{address!r} is no address of a Dask scheduler, such as tcp://host:8786"
    try:  # a client that could not parse it would wait, and then tell so, when it is collected
        scheme, place = parse_address(address)
        if scheme != "inproc":
            parse_host_port(place)
    except ValueError as error:
        raise BadInput(f"{wrong}: {error}") from None
    levels = {logger: logger.level for logger in map(logging.getLogger, ("distributed", "distributed.client"))}
    for logger in levels:
        logger.setLevel(logging.CRITICAL)  # what went wrong is told once, in a sentence
    try:
        client = Client(address, timeout=REACHED, set_as_default=False)
    except (OSError, TimeoutError):
        raise BadInput(f"no Dask scheduler answers at {address} (waited {REACHED:.0f} s)") from None
    except (ValueError, TypeError) as error:
        raise BadInput(f"{wrong}: {error}") from None
    except ImportError as error:
        raise BadInput(f"what speaks to {address} cannot be imported: {error}") from None
    try:
        with client.as_current():
            yield client
    finally:
        client.close(timeout=2)
        for logger, level in levels.items():
            logger.setLevel(level)
