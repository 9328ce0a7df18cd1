"""Has the separate checker judge the data set: python -m benchmarks.rolling.checked, minutes.

Of each case the first frames, a few radians of the motion, with the numbers of data/NAME.json rounded to DIGITS digits,
become a certificate, and the checker proves them from the scene's start in Python's integers.  The table goes to
docs/reference/measured/checked.md.
"""

import json
import sys
from fractions import Fraction
from time import process_time
from types import SimpleNamespace
from typing import Any

import numpy as np
from flint import arb, ctx

from chapsym import checker, files
from chapsym.certificates import motion
from chapsym.dynamics import BadInput
from chapsym.dynamics.enclosed_motion import PARTS
from chapsym.scene import load
from chapsym.scene.members.exactly import exact_motion

from .make import CASES, DATA, HERE

OUTPUT = HERE.parents[1] / "docs" / "reference" / "measured" / "checked.md"
DIGITS, RADIANS = 12, 8.0
HEAD = """# The data set, judged by the separate checker

Measured by `python -m benchmarks.rolling.checked`. Of each case of `benchmarks/rolling/data` the first frames, about
{radians:g} radians of the motion but at least two frames, are rounded to {digits} digits. The checker, which shares no
code with chapsym, proves them from the scene's start or says why it cannot.
Beyond them the data rest on Arb and chapsym; of the ball that slides they are a closed form, which a test
decides, and of that with its centre of mass off the centre a lemma by hand has its part.

| case | frames | until, s | the checker | seconds |
|---|---|---|---|---|
"""


def first(case: files.Data) -> Any:
    """The first frames of a case, as `certified_motion` gives them."""
    omega = [abs(float(middle)) for middle, _ in case["frames"][0]["omega"]]
    most = RADIANS / max(*omega, 1e-9)
    frames = [frame for i, frame in enumerate(case["frames"]) if i < 2 or Fraction(frame["time"]) <= most]
    arrays: files.Data = dict.fromkeys(PARTS)
    for name in frames[0].keys() & arrays.keys():
        arrays[name] = np.array([[arb(*pair) for pair in f[name]] for f in frames], dtype=object)
    return SimpleNamespace(times=[Fraction(f["time"]) for f in frames], digits=DIGITS, **arrays)


def judged(name: str) -> str:
    """The row of a case."""
    with ctx.workdps(40):
        found = first(json.loads((DATA / f"{name}.json").read_text(encoding="utf-8")))
        start, _ = exact_motion(load(CASES / f"{name}.toml"))
        verdict, seconds = "accepted", ""
        try:
            data = motion.motion(start, found)
        except BadInput as error:
            verdict = str(error)
        else:
            began = process_time()
            checker.check(data)
            seconds = f"{process_time() - began:.1f}"
    return f"| {name} | {len(found.times)} | {float(found.times[-1]):g} | {verdict} | {seconds} |\n"


def main(names: list[str]) -> None:
    rows = []
    for scene in sorted(CASES.glob("*.toml")):
        if not names or scene.stem in names:
            rows.append(judged(scene.stem))
            print(rows[-1], end="", file=sys.stderr)
    if not names:
        files.write_text(OUTPUT, HEAD.format(radians=RADIANS, digits=DIGITS) + "".join(rows))


if __name__ == "__main__":
    main(sys.argv[1:])
