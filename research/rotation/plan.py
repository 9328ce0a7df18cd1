"""The measurements, quick and full, as independent units of work."""

from math import gcd

from chapsym.files import Data

from ..units import Unit

HERE = "research.rotation"

#: The ball whose small branch is certified at this height (lemma `small-branch`), the same with a contact as heavy as a
#: solid ball's, and one whose steps are long enough for q = 3, beyond the lemma's bound.
LAMINA = {"tensor": [0, 1, 3], "D": "1/2", "height": "7/10"}
BALL = {"tensor": [1, 2, 4], "D": "1", "height": "12/5"}
SOLID = {"tensor": [1, 2, 4], "D": "7", "height": "12/5"}
LONG = {"tensor": [0, 1, 10], "D": "1/2", "height": "3/2"}

#: τ of the perturbed top next to the ball, and of the one whose staircase the eye sees.
WEAK, STRONG = "1/100", "9/20"
#: The top whose perturbation float64 sees: steps as long as its own small branch has them.
TOP = {"tensor": [0, 1, 3], "D": "0", "height": "19/20"}
#: The part of the range of levels in which staircases are drawn.
INSIDE = 0.02, 0.98
#: Plateaus of the staircases: q to this.
LARGEST = 24
#: The runs of displacements over a circle; four of them in the quick mode.
DISPLACED: tuple[Data, ...] = (
    {**BALL, "steps": 9, "digits": 60},
    {**BALL, "D": "0", "steps": 9, "digits": 60},
    {**BALL, "D": "0", "kick": WEAK, "steps": 9, "digits": 60},
    {**LAMINA, "steps": 8, "digits": 60},
    {**LAMINA, "steps": 7, "digits": 50},
    {**LAMINA, "steps": 11, "digits": 100},
    {**SOLID, "steps": 21, "digits": 120},
    {**SOLID, "D": "0", "steps": 21, "digits": 120},
    {**LONG, "steps": 3, "digits": 200},
    {**LONG, "D": "0", "steps": 3, "digits": 200},
    {**BALL, "steps": 12, "digits": 200},
    {**LONG, "steps": 6, "digits": 100},
)


def units(quick: bool) -> dict[str, list[Unit]]:
    """The units of each section."""
    counts, many = ([2**i for i in range(5, 12)], 40) if quick else ([2**i for i in range(5, 18)], 150)
    averaged = [{**BALL, "D": "0", "level": "6/25"}, {**BALL, "level": "6/25"}, {**SOLID, "level": "12/125"}]
    rows, points, steps = (4, 6, 200) if quick else (18, 24, 1000)
    grid = {"tensor": LAMINA["tensor"], "points": points, "steps": steps, "digits": 40}
    last, step = (13, 3) if quick else (31, 1)
    least = ((LONG, 3), (LAMINA, 7), (BALL, 9), (SOLID, 17))
    end = 17 if quick else 42
    near = {(p, q) for q in range(5, end) for p in ((q + 1) // 5, q // 5) if abs(5 * p - q) <= 1 and gcd(p, q) == 1}
    powers, small = (range(2, 11, 4), (8, 9)) if quick else (range(-1, 17), (8, 9, 12, 15))
    inside = {"inside": list(INSIDE)}
    drawn = {**inside, "points": 60 if quick else 600, "steps": 400 if quick else 3000}
    kicked = {**TOP, "kick": STRONG}
    listed = [list(x) for x in fractions(8 if quick else LARGEST, 0.0, 0.3)]
    costs = [15, 30, 60, 120, 240] if quick else [15, 20, 30, 40, 60, 90, 120, 180, 240, 400, 700, 1000]
    return {
        # Averages over more and more steps: D = 0, 1, 7.
        "convergence": [
            Unit(f"{HERE}.measured:convergence", {**case, "counts": counts, "digits": many}) for case in averaged
        ],
        # ρ on a grid of levels and heights, for three D.
        "overview": [
            Unit(f"{HERE}.measured:row", {**grid, "D": D, "height": f"{3 * i}/{2 * rows}"})
            for D in ("0", "1/2", "2")
            for i in range(1, rows + 1)
        ],
        # The displacement over the circle, each with D = 0 and the same q; and the perturbed top.
        "displacement": [
            Unit(f"{HERE}.measured:displacement", {**case, "turns": 1, "samples": 64 if case["steps"] < 16 else 96})
            for case in DISPLACED[: 4 if quick else None]
        ],
        # One half turn in q steps, in l and in h: four balls.
        "turns": [
            _plateau(case, q, 1, True) for case, first in least for q in range(first, max(last, first + 2), step)
        ],
        # Rotation numbers next to 1/5, nearer and nearer, so that the curve is about the same: q to 41, three D.
        "fifth": [
            _plateau({**LONG, "D": D}, q, p)
            for D in (("1/64", "1/2") if quick else ("1/64", "1/8", "1/2", "2"))
            for p, q in sorted(near)
        ],
        # One plateau for smaller and smaller D.
        "small_D": [
            _plateau({**LAMINA, "D": f"1/{2**k}" if k >= 0 else str(2**-k)}, q, 1)
            for q in small
            for k in powers
            if q > 9 or k >= 0
        ],
        # Every plateau of the lamina up to some q, for the staircase.
        "farey": [_plateau(LAMINA, q, p) for p, q in fractions(12 if quick else LARGEST, 0.03, 0.15)],
        # ρ(l) of the ball and of the perturbed top, in float64, and the plateaus of the latter.
        "staircase": [
            Unit(f"{HERE}.staircase:curve", {**LAMINA, "kick": "0", **drawn}),
            Unit(f"{HERE}.staircase:curve", {**kicked, **drawn}),
            Unit(f"{HERE}.staircase:plateaus", {**kicked, **inside, "fractions": listed}),
        ],
        # The cost of a step.
        "times": [Unit(f"{HERE}.measured:times", {**BALL, "level": "243/1000", "digits": costs})],
    }


def _plateau(case: Data, steps: int, turns: int, in_height: bool = False) -> Unit:
    return Unit(f"{HERE}.measured:measured", {**case, "steps": steps, "turns": turns, "in_height": in_height})


def fractions(largest: int, low: float, high: float) -> list[tuple[int, int]]:
    """Reduced p/q between two numbers."""
    return [(p, q) for q in range(3, largest + 1) for p in range(1, q) if gcd(p, q) == 1 and low < p / q < high]
