"""The units of a run on a Dask cluster: workers compute and write them, this process keeps the marks.

A worker is sent the text of the scene and the numbers of a unit, and makes the plan of it again.
"""

import logging
import time
from collections.abc import Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from typing import Any

import chapsym

from ..plan.models import State
from ..plan.plan import Plan
from ..read.scene import SceneError
from ..result.dataset import provenance
from . import segments
from .source import plan_from
from .store import Store, check_same, difference, write_region
from .sweep import NoAnswer, computed
from .tally import Tally

#: Seconds to wait for a scheduler, and for a worker where none is left.
REACHED, ABANDONED = 10.0, 60.0
#: Chunks of balls in flight for each thread of the workers, and how often one is tried whose worker was lost.
AHEAD, TRIES = 2, 3


def unit(
    text: str, about: dict[str, Any], path: str, chunk: int, segment: int, state: State | None
) -> tuple[str, State | str]:
    """Computes and writes one unit, on a worker: ("done", the state after it), or why not, as plain data.

    text, about: the scene and the provenance of its plan, which the worker's must equal.
    ("no answer", why) is of these balls only; ("refused", why) is of the disk, the store or the worker.
    """
    try:
        return "done", _unit(text, about, Path(path), chunk, segment, state)
    except NoAnswer as error:
        return "no answer", str(error)
    except SceneError as error:
        return "refused", str(error)
    except Exception as error:  # of any kind: not all can be sent
        return "no answer", f"{type(error).__name__} on a worker: {error}"


def _unit(text: str, about: dict[str, Any], path: Path, chunk: int, segment: int, state: State | None) -> State:
    plan = _plan(text)
    told = difference(provenance(plan), about)
    if told is not None:
        version = f"chapsym {chapsym.__version__}, and {about['chapsym_version']} here"
        raise SceneError(f"what a worker of the cluster would compute {told} ({version}): give all the same chapsym")
    if state is None:
        state = segments.begin(plan, plan.chunks[chunk])
    columns, after = computed(plan, chunk, segment, state)
    check_same(path, plan)  # this worker may be late, and the store by now another's
    write_region(path, plan, chunk, segment, columns)
    return after


@lru_cache(maxsize=4)
def _plan(text: str) -> Plan:
    return plan_from(text)


def on_cluster(plan: Plan, store: Store, tally: Tally, address: str) -> dict[int, str]:
    """Runs what is missing on the workers of a scheduler; returns why chunks could not be run.

    A unit whose worker is lost is tried again.  Raises SceneError if the scheduler cannot be reached or is lost, if no
    workers are left, if one has another chapsym, or if the disk refuses.
    """
    plan_from(plan.scene)  # raises SceneError for a plan that has no scene
    with connected(address) as client:
        return _Flight(plan, store, tally, client, address).run()


@contextmanager
def connected(address: str) -> Iterator[Any]:
    """A client of the Dask scheduler at an address; raises SceneError if none answers there."""
    from distributed import Client
    from distributed.comm import parse_address, parse_host_port

    try:  # a client that could not parse it would wait, and then tell so, when it is collected
        scheme, place = parse_address(address)
        if scheme != "inproc":
            parse_host_port(place)
    except ValueError as error:
        raise SceneError(f"{address!r} is no address of a Dask scheduler, such as tcp://host:8786: {error}") from None
    levels = {logger: logger.level for logger in map(logging.getLogger, ("distributed", "distributed.client"))}
    for logger in levels:
        logger.setLevel(logging.CRITICAL)  # what went wrong is told once, in a sentence
    try:
        client = Client(address, timeout=REACHED, set_as_default=False)
    except (OSError, TimeoutError):
        raise SceneError(f"no Dask scheduler answers at {address} (waited {REACHED:.0f} s)") from None
    except (ValueError, TypeError, ImportError) as error:
        raise SceneError(f"{address!r} is no address of a Dask scheduler, such as tcp://host:8786: {error}") from None
    try:
        with client.as_current():
            yield client
    finally:
        client.close(timeout=2)
        for logger, level in levels.items():
            logger.setLevel(level)


class _Flight:
    """The chunks that are in flight, one unit of each."""

    def __init__(self, plan: Plan, store: Store, tally: Tally, client: Any, address: str) -> None:
        self.plan, self.store, self.tally, self.client, self.address = plan, store, tally, client, address
        self.about = provenance(plan)
        self.flying: dict[Any, tuple[int, int, State | None, int]] = {}
        self.lost: dict[int, str] = {}
        self.alone_since: float | None = None

    def run(self) -> dict[int, str]:
        """Until every chunk is done or lost."""
        from distributed import wait

        waiting = iter(range(len(self.plan.chunks)))
        try:
            while True:
                self._fill(waiting)
                if not self.flying:
                    return dict(sorted(self.lost.items()))
                try:
                    done = wait(list(self.flying), timeout=1, return_when="FIRST_COMPLETED").done
                except TimeoutError:
                    done = set()
                except CancelledError:
                    done = {future for future in self.flying if future.status in ("cancelled", "lost")}
                for future in done:
                    self._landed(future)
        finally:
            self.client.cancel(list(self.flying), force=True)

    def _fill(self, waiting: Iterator[int]) -> None:
        """Sends chunks off, as many as the workers are to have."""
        room = AHEAD * self._threads()
        while len(self.flying) < max(room, 1):
            chunk = next(waiting, None)
            if chunk is None:
                return
            done, state = self.store.start(chunk)
            if state is not None:
                self.tally.kept(chunk, done, state)
            if done < len(self.plan.segments):
                self._send(chunk, done, state)

    def _threads(self) -> int:
        """Threads of all workers; raises SceneError if there have been none for long, or no scheduler."""
        try:
            threads = sum(self.client.nthreads().values())
        except (OSError, TimeoutError, ValueError, RuntimeError):
            raise SceneError(
                f"the Dask scheduler at {self.address} is lost; the same command goes on from what is written"
            ) from None
        now = time.monotonic()
        self.alone_since = None if threads else self.alone_since or now
        if self.alone_since is not None and now - self.alone_since > ABANDONED:
            told = f"has had no workers for {ABANDONED:.0f} s; the same command goes on from what is written"
            raise SceneError(f"the Dask scheduler at {self.address} {told}")
        return threads

    def _send(self, chunk: int, segment: int, state: State | None, tried: int = 1) -> None:
        job = self.client.submit(
            unit, self.plan.scene, self.about, str(self.store.path), chunk, segment, state, pure=False
        )
        self.flying[job] = chunk, segment, state, tried

    def _landed(self, future: Any) -> None:
        """Marks the unit and sends the next of its chunk, or the same again."""
        from distributed import KilledWorker

        chunk, segment, state, tried = self.flying.pop(future)
        try:
            outcome, found = future.result()
        except (KilledWorker, CancelledError, OSError):
            if tried < TRIES:
                self._send(chunk, segment, state, tried + 1)
            else:
                self.lost[chunk] = f"its worker was lost, {tried} times"
        except Exception as error:
            raise SceneError(f"a worker of the cluster has not this chapsym: {type(error).__name__}: {error}") from None
        else:
            if outcome == "refused":
                raise SceneError(found)
            if outcome == "no answer":
                self.lost[chunk] = found
                return
            self.store.mark(chunk, segment, found)
            self.tally.kept(chunk, segment + 1, found)
            if segment + 1 < len(self.plan.segments):
                self._send(chunk, segment + 1, found)
