"""Chains of calls: each yields a call, is sent its result, and yields the next; a crew makes them."""

from collections.abc import Callable, Collection, Generator, Iterable
from dataclasses import dataclass
from typing import Any, Protocol

#: How often a call is tried whose worker was lost.
TRIES = 3


@dataclass(frozen=True)
class Call:
    """A function and its arguments, which another process may have to be sent."""

    function: Callable[..., Any]
    arguments: tuple[Any, ...] = ()


Chain = Generator[Call, Any, None]


class Lost(Exception):
    """A call that has no result: whoever made it was lost, each time."""


class Crew(Protocol):
    """Who makes the calls.  `lost` are the errors of a worker's end, after which a call is made again."""

    lost: tuple[type[BaseException], ...]

    def room(self) -> int:
        """How many calls it is to have in hand; raises BadInput if it is gone."""

    def submit(self, call: Call) -> Any:
        """Begins a call; a future."""

    def landed(self, futures: Collection[Any]) -> Iterable[Any]:
        """Those that are done, of some; it may wait, and return none."""


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
