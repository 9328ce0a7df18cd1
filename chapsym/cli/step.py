"""chapsym step and chapsym branches: one step of the map, and every rotation with a given momentum."""

from typing import Annotated

import typer

from chapsym.rationals import rationals

from .app import app
from .options import BALL, Json, ball_from, contact_from, precision_from, takes, tensor_from, with_options
from .output import print_json

Momentum = Annotated[str, takes("K1,K2,K3", "The discrete momentum.")]
Gamma = Annotated[str, takes("G1,G2,G3", "The unit vertical, upwards, in the body.")]
Bits = Annotated[int | None, takes("BITS", "Bits of an Arb enclosure.", min=2, max=1_000_000)]


@app.command()
@with_options(BALL)
def step(
    momentum: Momentum,
    gamma: Gamma,
    digits: Annotated[int | None, takes("N", "Significant digits, by mpmath.", min=1, max=100_000)] = None,
    precision: Annotated[
        str | None, takes("NAME", "single, double (default), double-double: 7, 16, 31 digits.", "--precision", "--rung")
    ] = None,
    ball: Bits = None,
    proved: Annotated[
        bool, typer.Option("--proved", help="Prove a bound of the error of each, for the numbers as float64 has them.")
    ] = False,
    as_json: Json = False,
    **body: str | None,
) -> None:
    """Take one step of the map, on the small-rotation branch.

    Momentum and gamma are in the axes of the inertia tensor, where one is given.

    Example: chapsym step --mass-tensor 1,2,4 --D 3 --momentum 1,-1/2,3/4 --gamma 2/7,3/7,6/7 --digits 50 --json
    """
    K, g = rationals(momentum, "--momentum", 3), rationals(gamma, "--gamma", 3)
    chosen, tensor = precision_from(digits, precision, ball), tensor_from(body)
    import numpy as np

    from chapsym import dynamics
    from chapsym.dynamics.map import exact_step

    if tensor is None:
        taken = exact_step(*ball_from(body), K, g, chosen, proved)
    else:
        turned = dynamics.Ball.from_inertia(np.array(tensor), D=np.array(contact_from(body)))
        taken = dynamics.step(turned, np.array(K), np.array(g), precision=chosen, proved=proved)
    result = taken.write()
    if as_json:
        print_json(result)
        return
    print(f"q0        {result['q0']}")
    for name in ("q", "momentum", "gamma"):
        print(f"{name:9} " + "  ".join(str(x) for x in result[name]))
    if proved:
        bounds = "  ".join(f"{name} {bound:.2g}" for name, bound in result["proved"].items() if bound is not None)
        print(f"off by at most, proved: {bounds or 'nothing, as near a fold'}")


@app.command()
@with_options(BALL)
def branches(
    momentum: Momentum,
    gamma: Gamma,
    digits: Annotated[int | None, takes("N", "Significant digits.", min=1, max=100_000)] = None,
    precision: Annotated[
        str | None, takes("NAME", "double: IEEE float64, the default.", "--precision", "--rung")
    ] = None,
    ball: Bits = None,
    as_json: Json = False,
    **body: str | None,
) -> None:
    """Find every rotation with the given momentum: all branches of the map, by angle, counted exactly.

    Example: chapsym branches --mass-tensor 1,2,4 --D 1000 --momentum=-1/4,-3/2,1/2 --gamma 6/7,2/7,3/7
    """
    J, D = ball_from(body)
    K, g = rationals(momentum, "--momentum", 3), rationals(gamma, "--gamma", 3)
    chosen = precision_from(digits, precision, ball, ("double",))
    from chapsym.dynamics.solutions.enclosed import precise_branches

    found = precise_branches(J, D, K, g, chosen).write()
    if as_json:
        print_json(found)
        return
    _print_table(found)


def _print_table(found: dict) -> None:
    plural = "rotation" if found["count"] == 1 else "rotations"
    print(f"{found['count']} {plural}, {'complete' if found['complete'] else 'not complete: ' + found['reason']}")
    rows: list[tuple[str, ...]] = [("angle", "q0", "q1", "q2", "q3", "multiplicity")]
    for s in found["solutions"]:
        small = ", the small rotation" if s["small_rotation"] else ""
        rows.append((*(str(x) for x in (s["angle"], s["q0"], *s["q"])), f"{s['multiplicity']}{small}"))
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    for row in rows if found["solutions"] else ():
        print("  ".join(f"{text:{width}}" for text, width in zip(row, widths, strict=True)).rstrip())
