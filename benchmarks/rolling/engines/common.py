"""What the adapters share: the start of a case as an engine takes it, and the file that it writes."""

from collections.abc import Iterable
from pathlib import Path

import numpy as np

from chapsym import files
from chapsym.studies.judge import Case, read_case
from chapsym.studies.judge.trajectory import MORE, NEEDED

DATA = Path(__file__).parents[1] / "data"


def case_of(name: str) -> Case:
    return read_case(DATA / f"{name}.json")


def velocity_of(case: Case) -> np.ndarray:
    """Of the centre at the start: ω × ρe₃."""
    w = case.omega[0]
    return case.radius * np.array([w[1], -w[0], 0.0])


def steps_between(case: Case, step: float) -> int:
    """The steps from a frame to the next; raises SystemExit where the step does not divide it."""
    count = round(case.time[1] / step)
    if abs(count * step - case.time[1]) > 1e-9:
        raise SystemExit(f"the step must divide {case.time[1]:g} s, the time between two frames")
    return count


def write(path: Path, step: float, rows: Iterable[Iterable[float]]) -> None:
    """time, centre, quaternion (scalar first), velocity, ω in space."""

    def text(stream):
        lines = [f"# time_step = {step!r}", ",".join((*NEEDED, *MORE))]
        lines += [",".join(repr(float(x)) for x in row) for row in rows]
        stream.write(("\n".join(lines) + "\n").encode())

    files.write_whole(path, text)
