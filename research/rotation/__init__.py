"""`chapsym study rotation`: what the reduced map with vertical momentum does where its rotation number is rational.

All in half turns of a circle (π in the amplitude, 2K in u), with which the map commutes.
"""

from chapsym.files import Data
from chapsym.studies.checkout import machine

from ..units import Run, run_units
from .plan import units
from .words import sentences

__all__ = ["CAPTIONS", "DRAWN", "TITLE", "sentences", "study"]

TITLE = "The rotation number of the reduced map, and its mode locking"
#: The captions of the figures, in their order.
CAPTIONS = {
    "rotation-staircase.svg": "The rotation number against the level l: a devil's staircase. Left the ball: its steps "
    "are 1e-22 wide and less (inset: the one at 1/8). Right a top that is kicked on purpose: its steps show.",
    "rotation-displacement.svg": "How far nine steps miss one half turn, along the circle where they make it in the "
    "mean. For D = 1 the displacement takes both signs, so the map locks; for D = 0 it is zero to all 60 digits.",
    "rotation-widths.svg": "Widths of the locked intervals (resonance tongues at fixed h): exponentially small in q "
    "near a given rotation number, and proportional to D² as D tends to 0 (lines: the law, no fitted constant).",
    "rotation-digits.svg": "The digits with which each locked interval is seen first, and what a step costs then.",
    "rotation-numbers.svg": "Digits of the weighted Birkhoff average against steps, and the rotation number over "
    "levels and heights.",
}
DRAWN = {
    "rotation-staircase.svg": "figure:staircase", "rotation-displacement.svg": "figure:displacement",
    "rotation-widths.svg": "figure:widths", "rotation-digits.svg": "figure:digits",
    "rotation-numbers.svg": "figure:numbers",
}  # fmt: skip


def study(quick: bool = False, run: Run = run_units) -> Data:
    """All that is measured, as plain data; quick takes less than a minute."""
    planned = units(quick)
    results = iter(run([unit for section in planned.values() for unit in section]))
    found: Data = {name: [next(results) for _ in section] for name, section in planned.items()}
    return assembled(found, quick)


def assembled(found: Data, quick: bool) -> Data:
    """The results of the units of each section as the data of the study."""
    host = machine()
    ball, top, plateaus = found["staircase"]
    return {
        "study": "rotation", "quick": quick,
        "machine": {name: host[name] for name in ("cpu", "cores", "system", "python")}, **found,
        "times": found["times"][0], "staircase": {"ball": ball, "top": {**top, "plateaus": plateaus}},
    }  # fmt: skip
