"""chapsym certify energy-drift: what a closed orbit of the continuous ball proves of the energy."""

from collections.abc import Callable
from typing import Annotated, Any

import typer

from chapsym.exact import rational, rationals

from .certify import Output, certify, deliver
from .options import Contact, Inertia, Json, MassTensor, ball_from
from .output import fail


@certify.command("energy-drift")
def energy_drift(
    mass_tensor: MassTensor = None,
    inertia: Inertia = None,
    contact: Contact = None,
    momentum: Annotated[str, typer.Option(metavar="K1,K2,K3", help="The start, near a closed orbit.")] = "1,2,3.42454",
    gamma: Annotated[str, typer.Option(metavar="G1,G2,G3", help="The unit vertical, rational.")] = "3/7,6/7,2/7",
    symmetry: Annotated[str, typer.Option(metavar="S1,S2,S3", help="Signs: how the orbit is back.")] = "-1,-1,1",
    time: Annotated[str, typer.Option(metavar="T", help="When it is back.")] = "8.5478",
    vary: Annotated[int, typer.Option(min=1, max=3, help="The component of the momentum that is adjusted.")] = 3,
    digits: Annotated[int, typer.Option(min=12, max=200, help="Its decimals.")] = 20,
    output: Output = None,
    as_json: Json = False,
) -> None:
    """Certify a closed orbit of the continuous ball on which the energy of the map drifts.

    By default for the ball with J = (1, 2, 4), D = 1.  It takes about a minute.

    Example: chapsym certify energy-drift -o drift.json
    """
    if mass_tensor is inertia is contact is None:
        mass_tensor, contact = "1,2,4", "1"
    if contact is None:
        fail("D is missing: give --D", 2)
    J, D = ball_from(mass_tensor, inertia, contact, None, None)
    K, g = rationals(momentum, "--momentum", 3), rationals(gamma, "--gamma", 3)
    signs, end = rationals(symmetry, "--symmetry", 3), rational(time, "--time")
    from chapsym.certificates.drift_search import energy_drift as search

    def find(progress: Callable[[str], None]) -> dict[str, Any]:
        return search(J, D, K, g, tuple(map(int, signs)), end, vary - 1, digits=digits, progress=progress)

    found = deliver(find, output, as_json)
    if not as_json:
        _describe(found)


def _describe(found: dict[str, Any]) -> None:
    print(found["statement"])
    for name, what in (("energy", "X3(H)"), ("density", "div X3")):
        print(f"  integral of {what:7} {float(found[name][0]):.9e}, up to {float(found[name][1]):.0e}")
