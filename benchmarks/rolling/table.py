"""Measures engines on five cases, for docs/reference/measured/engines.md: python -m benchmarks.rolling.table, minutes.

An engine whose package is not installed is left out, and named.
"""

import importlib
import sys
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryDirectory

from chapsym.studies.judge import Case, convergence, departure, read_case
from chapsym.studies.judge_tables import read_trajectory

from .engines.common import DATA, start_of, text

OUTPUT = Path(__file__).parents[2] / "docs" / "reference" / "measured" / "engines.md"
CASES = ("bowling", "random-3", "robot", "heavy-axis", "separatrix")
STEPS = (0.002, 0.001, 0.0005)
#: The module of an engine, its package, its name, its steps in s, and whether it has settings that are better.
ENGINES = (
    ("mujoco_ball", "mujoco", "MuJoCo", STEPS, True),
    ("pybullet_ball", "pybullet", "PyBullet", STEPS, True),
    ("drake_ball", "drake", "Drake", STEPS, True),
    ("penalty", "chapsym", "penalty contact", (0.0005, 0.00025, 0.000125), False),
)
HEAD = """# Engines, measured

How far the balls of engines are from certified motions ([how to judge one](../../how-to/judge-an-engine.md)): the
greatest at the frames of a case. `momentum` is that about the point of contact, as a vector in space. Order and floor
are those of the path, estimated from the three steps: the floor is how far the runs are from the truth in the limit of
small steps. Where the differences between steps do not fall, there is no order. `defaults` are the settings that the
engine comes with, `best` those that we found best; both are in `benchmarks/rolling/engines`. The penalty contact is a
control of our own.

Written by `python -m benchmarks.rolling.table`, with {versions}.
"""
COLUMNS = "| engine | settings | step, ms | path, m | attitude, degrees | energy, % | momentum, % | order | floor, m |"


def rows(case: Case, module: str, steps: tuple[float, ...], best: bool) -> Iterator[str]:
    """A row of the table for each step; the last one has the order and the floor."""
    run = importlib.import_module(f".engines.{module}", __package__).run
    body, start = DATA / f"{case.name}.urdf", start_of(case)
    runs, found = [], []
    with TemporaryDirectory() as folder:
        for step in steps:
            file = Path(folder, f"{step!r}.csv")
            file.write_text(text(step, run(body, start, step, best)), encoding="utf-8")
            runs.append(read_trajectory(file, case.time))
            found.append(departure(case, runs[-1]))
    known = convergence(case, runs)
    for step, one in zip(steps, found, strict=True):
        numbers = [f"{abs(one[name]).max():.2g}" for name in ("path", "attitude", "energy", "momentum")]
        last = ["", ""]
        if step == steps[-1]:
            last = ["none", ""] if known.order is None else [f"{known.order:.2f}", f"{known.floor:.2g}"]
        yield " | ".join([f"{1000 * step:g}", *map(plain, numbers), *map(plain, last)])


def plain(number: str) -> str:
    """As decimals where they are short."""
    return f"{float(number):g}" if "e+" in number else number


def main() -> None:
    there, versions, missing = [], [], []
    for engine in ENGINES:
        try:
            importlib.import_module(f".engines.{engine[0]}", __package__)
        except ImportError:
            missing.append(engine[2])
        else:
            there.append(engine)
            versions.append(f"{engine[2]} {version(engine[1])}" if engine[4] else f"chapsym {version(engine[1])}")
    lines = [HEAD.format(versions=", ".join(versions))]
    if missing:
        lines.append(f"Not installed here: {', '.join(missing)}.\n")
    for name in CASES:
        case = read_case(DATA / f"{name}.json")
        lines += [f"## {name}\n\n{case.time[-1]:g} s.\n", COLUMNS, "|---" * 9 + "|"]
        for module, _, title, steps, two in there:
            for best in (False, True) if two else (False,):
                print(name, title, "best" if best else "", file=sys.stderr)
                settings = ("best" if best else "defaults") if two else ""
                lines += [f"| {title} | {settings} | {row} |" for row in rows(case, module, steps, best)]
        lines.append("")
    OUTPUT.write_text("\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    main()
