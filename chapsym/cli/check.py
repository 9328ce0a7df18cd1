"""chapsym check: float64 against the oracle."""

import sys
from typing import Annotated, Any

import typer

from .app import app
from .options import Json
from .output import fail, print_json, progress_bar


@app.command()
def check(
    states: Annotated[int, typer.Option(metavar="N", min=1, help="States of each stratum.")] = 20,
    steps: Annotated[int, typer.Option(metavar="N", min=1000, help="Steps of the trajectory.")] = 100_000,
    seed: Annotated[int, typer.Option(metavar="N", min=0, help="Seed of the states.")] = 20071,
    as_json: Json = False,
) -> None:
    """Check the float64 map against an independent mpmath solution of the matrix equation (4.13).

    Example: chapsym check --states 100
    """
    from chapsym.studies import check as study

    done: list[Any] = []
    with progress_bar("checking", len(study.STRATA)) as shown:

        def arrived(row: Any) -> None:
            done.append(row)
            shown(len(done))

        rows = study.check(states, seed, on_row=arrived)
    moved = study.drift(steps)
    result = study.as_json(rows, moved)
    if as_json:
        print_json(result)
    else:
        _print_check(rows, moved, study.BUDGET)
    if not result["kept"]:
        fail("the float64 map is outside its budget", 1)


def _print_check(rows: list[Any], moved: Any, budget: float) -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table(title="float64 against mpmath: worst error in ulps")
    for name in ("stratum", "states", "q", "K", "gamma", "condition", f"share of {budget:g}·condition"):
        table.add_column(name, justify="left" if name == "stratum" else "right")
    for row in rows:
        errors = (row.rotation_ulps, row.momentum_ulps, row.gamma_ulps, row.condition)
        table.add_row(row.stratum, str(row.states), *(f"{x:.3g}" for x in errors), f"{row.of_budget:.2f}")
    console = Console(width=None if sys.stdout.isatty() else 120)
    console.print(table)
    print(
        f"over {moved.steps} steps <K,gamma>, <K,K>, <gamma,gamma> moved by "
        f"{moved.height:.1e}, {moved.squared:.1e}, {moved.unit:.1e}, budget {moved.budget:.1e}"
    )
    worst = max(rows, key=lambda row: row.of_budget)
    print(f"single steps use at most {worst.of_budget:.0%} of their budget against mpmath ({worst.stratum})")
