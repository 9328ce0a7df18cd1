"""chapsym check: float64 against the oracle."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from . import measured
from .app import app
from .options import Json, takes, writes
from .output import console_for, fail, print_json, print_table, progress_bar

if TYPE_CHECKING:
    from chapsym.studies.check import Drift, Row

TITLE = "float64 against mpmath: worst error in ulps"
ABOUT = (
    "Single steps in float64 compared with an independent solution of the matrix equation (4.13) in mpmath. The "
    "promise is relative to the condition number κ of the state, and measured: the rotation q within 4κ ulps, 𝒦 and γ "
    "within 4(1 + |q|κ). The bounds of `proved=True` are proved, of each state; the last column has the worst error in "
    "parts of its bound."
)


@app.command()
def check(
    states: Annotated[int, takes("N", "States of each stratum.", min=1, max=100_000)] = 20,
    steps: Annotated[int, takes("N", "Steps of the trajectory.", min=1000, max=1_000_000_000)] = 100_000,
    seed: Annotated[int, takes("N", "Seed of the states.", min=0)] = 20071,
    output: Annotated[Path | None, writes("PAGE", "A page, .md, of the table.")] = None,
    as_json: Json = False,
) -> None:
    """Check the float64 map against an independent mpmath solution of the matrix equation (4.13).

    Example: chapsym check --states 100
    """
    from chapsym.studies import check as study

    if output is not None and not measured.is_page(output):
        fail(f"{str(output)!r}: the page must end in .md", 2)
    with progress_bar("checking", len(study.STRATA) * states) as shown:
        rows = study.check(states, seed, shown)
    with progress_bar("rolling", steps) as shown:
        moved = study.drift(steps, shown)
    result = study.as_json(rows, moved)
    table, sentences = _table(rows, moved, study.BUDGET)
    if output is not None:
        measured.write(output, "float64 against mpmath", ABOUT, [measured.Table(TITLE, table, sentences)], _shown)
    if as_json:
        print_json(result)
    else:
        print_table(console_for(160), TITLE, table, _shown)
        print("\n".join(sentences))
    if not result["kept"]:
        fail("the float64 map is outside its budget", 1)


def _table(rows: "list[Row]", moved: "Drift", budget: float) -> tuple[list[dict[str, object]], list[str]]:
    """The rows of the table, and the sentences under it."""
    table = [
        {
            "stratum": row.stratum, "states": row.states, "q": row.rotation_ulps, "K": row.momentum_ulps,
            "gamma": row.gamma_ulps, "condition": row.condition, f"share of {budget:g}·condition": row.of_budget,
            "proved": row.proved, "share of the proved bound": row.of_proved,
        }
        for row in rows
    ]  # fmt: skip
    worst = max(rows, key=lambda row: row.of_budget)
    return table, [
        f"over {moved.steps} steps <K,gamma>, <K,K>, <gamma,gamma> moved by "
        f"{moved.height:.1e}, {moved.squared:.1e}, {moved.unit:.1e}, budget {moved.budget:.1e}",
        f"{sum(row.proved for row in rows)} of {sum(row.states for row in rows)} states have proved bounds; "
        f"no error is above {max(row.of_proved for row in rows):.0%} of its own",
        f"single steps use at most {worst.of_budget:.0%} of their budget against mpmath ({worst.stratum})",
    ]


def _shown(value: object) -> str:
    return f"{value:.3g}" if isinstance(value, float) else str(value)
