"""chapsym certify periodic-orbit: an orbit of the whole map on which volumes are not preserved."""

from collections.abc import Callable
from decimal import Decimal
from typing import Annotated, Any

import typer

from chapsym.exact import rational

from .certify import Output, certify, deliver
from .options import Contact, Inertia, Json, MassTensor, ball_from
from .output import fail


@certify.command("periodic-orbit")
def periodic_orbit(
    mass_tensor: MassTensor = None,
    inertia: Inertia = None,
    contact: Contact = None,
    size: Annotated[str, typer.Option("--momentum-momentum", metavar="KK", help="Of K with itself.")] = "15/2",
    height: Annotated[
        str | None, typer.Option("--momentum-gamma", metavar="KG", help="Of K with gamma; found by default.")
    ] = None,
    steps: Annotated[int, typer.Option(metavar="Q", help="Steps after which the orbit is back.")] = 20,
    attracting: Annotated[bool, typer.Option("--attracting", help="It must attract the orbits near it.")] = False,
    digits: Annotated[int | None, typer.Option(metavar="N", help="Decimals; as many as needed by default.")] = None,
    output: Output = None,
    as_json: Json = False,
) -> None:
    """Certify a periodic orbit, K not parallel to gamma, that contracts volumes: no density near it is invariant.

    On the level of |K| and of K with gamma it is isolated and no symmetry maps it to itself.  By default for the
    ball with J = (1, 2, 4), D = 2.

    Example: chapsym certify periodic-orbit --mass-tensor 1,2,4 --D 1 --steps 26 --attracting -o attracting.json
    """
    if mass_tensor is inertia is contact is None:
        mass_tensor, contact = "1,2,4", "2"
    if contact is None:
        fail("D is missing: give --D", 2)
    J, D = ball_from(mass_tensor, inertia, contact, None, None)
    KK = rational(size, "--momentum-momentum")
    Kg = None if height is None else rational(height, "--momentum-gamma")

    def find(progress: Callable[[str], None]) -> dict[str, Any]:
        from chapsym.certificates import orbit

        return orbit.periodic_orbit(
            (J[0], J[1], J[2]), D, KK, steps, height=Kg, digits=digits, attracting=attracting, progress=progress
        )

    found = deliver(find, output, as_json)
    if not as_json:
        _describe(found)


def _describe(found: dict[str, Any]) -> None:
    ball, integrals = found["ball"], found["integrals"]
    print(f"J = ({', '.join(ball['J'])}), D = {ball['D']}, <K, K> = {integrals['momentum.momentum']}, ", end="")
    print(f"<K, gamma> = {integrals['momentum.gamma']}: back after {found['steps']} steps")
    contraction, unit = Decimal(found["determinant"]) - 1, Decimal(found["unit_eigenvalue"])
    print(f"  det DG^q - 1 = {contraction:.3e}, det(1 - DG^q) = {unit:.3e} on the level")
    if "trace" in found:
        print("  all eigenvalues are inside the unit circle: the orbit attracts")
