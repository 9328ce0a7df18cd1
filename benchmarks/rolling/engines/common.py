"""The common parts of the adapters: the start of a case as an engine takes it, and the file that it writes."""

import argparse
from collections.abc import Callable, Iterable
from pathlib import Path

from chapsym import files
from chapsym.studies.judge import Case, read_case
from chapsym.studies.judge_tables import MORE, NEEDED

DATA = Path(__file__).parents[1] / "data"
#: Time, centre, quaternion (scalar first), velocity and ω in space.
Rows = Iterable[Iterable[float]]


def steps_between(case: Case, step: float) -> int:
    """The steps from a frame to the next; raises SystemExit where the step does not divide it."""
    count = round(case.time[1] / step)
    if abs(count * step - case.time[1]) > 1e-9:
        raise SystemExit(f"the step must divide {case.time[1]:g} s, the time between two frames")
    return count


def text(step: float, rows: Rows) -> str:
    """The file that `chapsym judge` reads."""
    lines = [f"# time_step = {step!r}", ",".join((*NEEDED, *MORE))]
    lines += [",".join(repr(float(x)) for x in row) for row in rows]
    return "\n".join(lines) + "\n"


def command(run: Callable[[Case, float, bool], Rows], about: str) -> None:
    """The command line of an adapter."""
    parser = argparse.ArgumentParser(description=about.splitlines()[0])
    parser.add_argument("case")
    parser.add_argument("step", type=float)
    parser.add_argument("output", type=Path)
    parser.add_argument("--best", action="store_true", help="the settings that we found best, instead of the defaults")
    given = parser.parse_args()
    case = read_case(DATA / f"{given.case}.json")
    if not case.radius or case.rotor.any() or case.velocity is not None:
        raise SystemExit(f"{given.case} is no ball that rolls by itself: the adapters are for those alone")
    files.write_text(given.output, text(given.step, run(case, given.step, given.best)))
