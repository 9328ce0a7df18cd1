"""Long work in units that can be gone on with: sweeps of scenes and studies, on all cores or on a Dask cluster.

Chains of calls: each yields a call, is sent its result, and yields the next; a crew makes them.
"""

import json
import logging
import os
import socket
import time
from collections.abc import Callable, Collection, Generator, Iterable, Iterator
from concurrent.futures import CancelledError, Executor, Future, ThreadPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, Protocol

from chapsym import extras
from chapsym.dynamics import BadInput
from chapsym.workers import Processes

try:
    import fcntl
except ImportError:  # Windows: a second writer is not noticed there
    fcntl = None  # type: ignore[assignment]

#: How often a call is tried whose worker was lost.
TRIES = 3
#: Seconds to wait for a scheduler, for its answers, and for a worker where none is left.
REACHED, ANSWERED, ABANDONED = 10.0, 60.0, 60.0


@dataclass(frozen=True)
class Call:
    """A function and its arguments, which another process may have to be sent."""

    function: Callable[..., object]
    arguments: tuple[object, ...] = ()


Chain = Generator[Call, Any, None]


def duration(seconds: float) -> str:
    """A time for a reader."""
    units = (("h", 3600.0), ("min", 60.0), ("s", 1.0), ("ms", 1e-3), ("µs", 1e-6))
    unit, length = next(((unit, length) for unit, length in units if seconds >= length), units[-1])
    return f"{float(f'{seconds / length:.2g}'):g} {unit}"


class Lost(Exception):
    """A call without a result: its worker was lost at each attempt."""


class Crew(Protocol):
    """The makers of the calls.  `lost` are the errors of a worker's end, after which a call is made again."""

    lost: tuple[type[BaseException], ...]

    def room(self) -> int:
        """The number of calls that it should have in hand; raises BadInput if it is gone."""

    def submit(self, call: Call) -> Any:
        """Begins a call; a future."""

    def landed(self, futures: Collection[Any]) -> Iterable[Any]:
        """The calls that are done, of some; it may wait, and return none."""


def run(chains: Iterable[Chain], crew: Crew) -> None:
    """Every chain to its end, as many abreast as the crew has room for.

    An error of a call is raised inside its chain, as `Lost` if it was tried TRIES times in vain, the last time when no
    other call was made: a worker that ends takes with it what waits there.  What a chain lets through ends the run.
    """
    waiting = iter(chains)
    suspects: list[tuple[Chain, Call]] = []
    flying: dict[Any, tuple[Chain, Call, int]] = {}

    def go_on(chain: Chain, step: Callable[[Any], Call], sent: Any) -> None:
        try:
            call = step(sent)
        except StopIteration:
            return
        flying[crew.submit(call)] = chain, call, 1

    while True:
        while len(flying) < max(crew.room(), 1) and (chain := next(waiting, None)) is not None:
            go_on(chain, chain.send, None)
        if not flying and suspects:
            chain, call = suspects.pop()
            flying[crew.submit(call)] = chain, call, TRIES
        if not flying:
            return
        for future in list(crew.landed(flying)):
            chain, call, tried = flying.pop(future)
            try:
                result = future.result()
            except crew.lost:
                if tried < TRIES - 1:
                    flying[crew.submit(call)] = chain, call, tried + 1
                elif tried < TRIES:
                    suspects.append((chain, call))
                else:
                    go_on(chain, chain.throw, Lost(f"its worker was lost, {tried} times"))
            except Exception as error:
                go_on(chain, chain.throw, error)
            else:
                go_on(chain, chain.send, result)


# Crews of this machine: this thread, some threads, or a process for each core.


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
    """An executor with a number of workers, each of which finds a next call when it has made one."""

    lost: tuple[type[BaseException], ...] = ()

    def __init__(self, executor: Executor, workers: int) -> None:
        self.executor, self.workers = executor, workers

    def room(self) -> int:
        """Two calls for each; of this thread, one after the other."""
        return 1 if isinstance(self.executor, Here) else 2 * self.workers

    def submit(self, call: Call) -> Future[object]:
        """A future of the executor."""
        return self.executor.submit(call.function, *call.arguments)

    def landed(self, futures: Collection[Future[object]]) -> Collection[Future[object]]:
        """Waits for one of them."""
        return wait(futures, return_when="FIRST_COMPLETED").done


@contextmanager
def threads(count: int) -> Iterator[Pool]:
    """Threads; at the end, or after an error, those that run are waited for."""
    with ThreadPoolExecutor(count) if count > 1 else Here() as executor:
        try:
            yield Pool(executor, count)
        finally:
            executor.shutdown(wait=True, cancel_futures=True)


@contextmanager
def processes(count: int) -> Iterator[Pool]:
    """Processes; at the end, or after an error, those that run are ended.

    Raises BadInput if one was ended from outside and the chain of its call did not take that.
    """
    if count <= 1:
        yield Pool(Here(), 1)
        return
    # A child is not forked: threads and Arb's precision are of a process.
    try:
        with Processes(count) as executor:
            yield Pool(executor, count)
    except BrokenProcessPool:  # unless its chain lets others go on
        raise BadInput("a process of this run was ended, perhaps for lack of memory; begin again") from None


# The crew of a Dask cluster: the workers of a scheduler, which are to see the same disk and have the same chapsym.


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
            clause = "is lost; the same command goes on from what is written"
            raise BadInput(f"the Dask scheduler at {self.address} {clause}") from None
        now = time.monotonic()
        self.alone_since = None if threads else self.alone_since or now
        if self.alone_since is not None and now - self.alone_since > ABANDONED:
            clause = f"has had no workers for {ABANDONED:.0f} s; the same command goes on from what is written"
            raise BadInput(f"the Dask scheduler at {self.address} {clause}")
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
        logger.setLevel(logging.CRITICAL)  # what went wrong is said once, in a sentence
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


# One writer: a lock that the system lets go when its process ends, however it ends.


@contextmanager
def held(path: Path, what: str) -> Iterator[None]:
    """Holds the lock file `path` of `what`; raises BadInput with the process that holds it, if another does."""
    try:
        stream = open(path, "a+", encoding="utf-8")  # noqa: SIM115
    except OSError as error:
        raise BadInput(f"{what} cannot be written: {error.strerror or error}") from None
    with stream:
        claim(stream, what, path)
        try:
            stream.truncate(0)
            stream.write(json.dumps({"pid": os.getpid(), "host": socket.gethostname()}))
            stream.flush()
        except OSError:  # a full disk: the lock holds all the same, but names nobody
            stream.truncate(0)
        yield


def claim(stream: IO[str], what: str, named: Path | None = None) -> None:
    """Locks an open file until it is closed; raises BadInput if another process has, which the file `named` names."""
    try:
        if fcntl is not None:
            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        holder = "another process" if named is None else _holder(named)
        raise BadInput(f"{what} is being written by {holder}; wait for it, or choose another name") from None
    except OSError as error:
        raise BadInput(f"{what} cannot be locked: {error.strerror or error}") from None


def _holder(path: Path) -> str:
    """The process that wrote its name into a lock file."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        return f"process {found['pid']} on {found['host']}"
    except (OSError, ValueError, KeyError, TypeError):
        return "another process"
