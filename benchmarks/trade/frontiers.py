"""The sections that have a frontier: points of time against digits, and those that no other one beats in both.

They measure rounding alone, what is proved of it, one ball and a batch against the continuous ball.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial

import numpy as np

from chapsym.accuracy import Method, Request, methods, take
from chapsym.accuracy.answer import CHECKS, exact_values, label_of
from chapsym.accuracy.motion import EXTRAPOLATED, lengths
from chapsym.dynamics import BadInput, Ball, StepNotTaken, Trajectory, certified_motion, kernels, trajectory
from chapsym.dynamics.ball import Floats
from chapsym.dynamics.certified import exactly
from chapsym.dynamics.extrapolation import extrapolate
from chapsym.dynamics.levels.start import fraction
from chapsym.files import Data
from chapsym.numbers import NAMED, Digits, Enclosure, Precision

from ..harness import NotComparable, Run, Say
from ..results import timed

#: The digits of the table's rows.
EVERY = (3, 6, 9, 12, 15, 18, 21, 24, 27, 30, 50, 100)
#: The measurement of rounding alone: |ω|ε in radians, the reference, and the precisions; those with a proof.
STEP, FINEST = 0.1, Digits(120)
PRECISIONS: tuple[Precision, ...] = (
    *NAMED.values(), Digits(30), Digits(50), Digits(100), Enclosure(100), Enclosure(300),
)  # fmt: skip
PROVED = (NAMED["double"], NAMED["double-double"], Enclosure(100), Enclosure(300))
#: How many steps of the cheap precisions make up a run that is timed: enough for a millisecond.
TIMED = {NAMED["single"]: 20_000, NAMED["double"]: 20_000, NAMED["double-double"]: 4_000}
#: Seconds of simulated time of one ball, and of a batch.
END = 10.0
#: Lengths of steps, |ω|ε in radians: quick and full.
LENGTHS = {True: (0.4, 0.1, 0.03), False: (1.0, 0.7, 0.5, 0.35, 0.25, 0.18, 0.125, 0.09, 0.06, 0.04, 0.02, 0.01, 0.003)}
#: The most seconds that a run of a precision may be expected to take, by these seconds a stage.
STAGE = {"single": 5e-8, "double": 5e-8, "quad": 3e-7, "digits30": 3e-4, "digits50": 3e-4}
LONGEST = {True: 0.02, False: 1.0}
#: The digits of the reference of one ball, and of a batch, as K and γ of its balls are floats.
DIGITS, OF_BATCH = 34, 19
#: Balls of a batch, and those of them whose error is taken.
BATCH, SHOWN = 256, 4
#: Seconds after which there is no reference, and its digits beyond the accuracy and those that the flow may cost.
PATIENCE, BEYOND = 3600.0, 3


@dataclass(frozen=True, eq=False)
class Choice:
    """A choice to measure: its name (precision and order), how its error is found, and a run of a number of steps.

    step: |ω|ε in radians; time: of the run, in seconds of the ball.
    """

    name: str
    step: float
    steps: int
    time: float
    error: Callable[[], float]
    run: Run


@dataclass(frozen=True)
class Point:
    """One choice: its name, its step, what it costs and how many digits it gives.

    per_step, per_time: seconds a step, and a unit of simulated time, of one ball.  digits: -log₁₀ of the error.
    """

    name: str
    step: float
    per_step: float
    per_time: float
    digits: float


@dataclass(frozen=True)
class Frontier:
    """The results of a section: all points, and the notes on them.

    question: what the digits are of.  notes: the reference and how it was confirmed.
    """

    title: str
    question: str
    points: list[Point]
    notes: list[str]

    @property
    def best(self) -> list[Point]:
        """The points that no other one beats in both, from the cheapest."""
        return [p for p in self._sorted() if not any(dominates(q, p) for q in self.points)]

    @property
    def dominated(self) -> dict[str, str]:
        """Every choice that has no point on the frontier, and one that takes no longer for as many digits."""
        best, found = self.best, {}
        for name in dict.fromkeys(p.name for p in self.points if p.name not in {q.name for q in best}):
            finest = max((p for p in self.points if p.name == name), key=lambda p: p.digits)
            found[name] = next(p.name for p in best if dominates(p, finest))
        return found

    def _sorted(self) -> list[Point]:
        return sorted(self.points, key=lambda p: (p.per_time, -p.digits))

    def cheapest(self, digits: float) -> Point | None:
        """The cheapest point with at least this many digits, or None."""
        return next((p for p in self._sorted() if p.digits >= digits), None)

    def table(self) -> list[Data]:
        """The cheapest choice for each number of digits that some choice gives."""
        return [
            {
                "digits": digits, "cheapest": p.name, "|ω|ε": p.step, "µs a step": p.per_step * 1e6,
                "µs a unit of time": p.per_time * 1e6, "has": p.digits,
            }
            for digits in EVERY
            if (p := self.cheapest(digits)) is not None
        ]  # fmt: skip

    def sentences(self) -> list[str]:
        """The sentences on dominated points, and the notes."""
        named = [f"dominated: {name} (by {better})" for name, better in self.dominated.items()]
        return [self.question, *named, *self.notes]

    def as_json(self) -> Data:
        """The section as plain data; the points carry whether they are on the frontier."""
        points = [vars(p) | {"frontier": p in self.best} for p in self.points]
        clause = {"title": self.title, "question": self.question, "points": points}
        return clause | {"dominated": self.dominated, "notes": self.notes}


def dominates(p: Point, q: Point) -> bool:
    """Whether p gives as many digits in as little time, and more of one or less of the other."""
    no_worse = p.per_time <= q.per_time and p.digits >= q.digits
    return no_worse and (p.per_time < q.per_time or p.digits > q.digits)


def digits_of(error: float, most: float) -> float:
    """-log₁₀ of an error, between 0 and what the reference can tell."""
    return float(min(most, max(0.0, -math.log10(error)))) if error > 0 else most


def frontier(
    title: str, question: str, notes: list[str], choices: Iterable[Choice], most: float, rounds: int, say: Say,
    balls: int = 1,
) -> Frontier:  # fmt: skip
    """Measures choices, on one core, each for a number of balls; those whose steps are not taken are left out.

    most: the digits that the reference can tell.
    """
    digits, notes = {}, [*notes]
    for one in choices:
        say(f"{title}: {one.name}, {one.steps} steps")
        try:
            digits[one] = digits_of(one.error(), most)
        except StepNotTaken:
            continue
        except BadInput as error:
            notes.append(f"{one.name}: {error}")
    runs = {f"{one.name} at {one.steps}": (one.run, balls) for one in digits}
    points = []
    for one, timing in zip(digits, timed(runs, rounds, say, title).values(), strict=True):
        points.append(Point(one.name, one.step, timing.median / one.steps, timing.median / one.time, digits[one]))
    return Frontier(title, question, points, notes)


# The continuous ball (2.3) with its contact point, to proved digits: it shares no formula of motion with the map.


def sample(of: str, time: float) -> Request:
    """The ball of docs/first.toml, on which methods are compared."""
    ball = Ball.from_inertia((0.006, 0.007, 0.009), mass=2.0, radius=0.1)
    K, g = np.array([0.0446, -0.0346, 0.0313]), np.array([2.0, 3.0, 6.0]) / 7
    return Request(ball, K, g, time, 1e-6, of)


def continuous(
    ball: Ball, angular_momentum: Floats, gamma: Floats, attitude: Floats | None, times: Sequence[Fraction], digits: int
) -> np.ndarray:
    """K (kg m²/s), γ and the contact point (m) at ascending times (s): Fractions, (times, 8).

    attitude: a quaternion, body to space; None for the least rotation that turns γ up.  All floats are taken as exact.
    digits: of the state, at every time, as `certified_motion` proves them.  Raises NotComparable without them.
    """
    found = certified_motion(ball, angular_momentum, gamma, times, digits, attitude=attitude, limit=PATIENCE)
    if found.stopped is not None:
        raise NotComparable(found.stopped)
    contact = found.contact if found.contact is not None else np.zeros((len(times), 2), int)
    rows = np.hstack([found.angular_momentum, found.gamma, contact])
    return np.vectorize(lambda x: fraction(x) if x else Fraction(0), otypes=[object])(rows)


def truth(request: Request, digits: int = 0) -> np.ndarray:
    """K, γ and the contact point at the times of comparison, (checks + 1, 8) Fractions."""
    wanted = digits or math.ceil(-math.log10(request.accuracy) + math.log10(1 + request.angle)) + BEYOND
    times = [Fraction(request.time) * k / CHECKS for k in range(CHECKS + 1)]
    attitude = None if isinstance(request.attitude, bool | np.bool_) else request.attitude
    return continuous(request.ball, request.angular_momentum, request.gamma, attitude, times, wanted)


def true_error(request: Request, run: Trajectory, exact: np.ndarray) -> float:
    """The error of a run in the request's norm, at the worst time of comparison that is a frame of the run."""
    exact = exact[:: CHECKS // (len(run.index) - 1)]
    if request.of == "contact":
        return float(lengths(exact_values(request, run, "contact") - exact[:, 6:]).max())
    size = float(lengths(request.angular_momentum))
    momentum = lengths(exact_values(request, run, "momentum") - exact[:, :3]) / size
    return float(max(momentum.max(), lengths(exact_values(request, run, "gamma") - exact[:, 3:6]).max()))


# The sections.


def of_map(proves: bool, quick: bool, say: Say) -> Frontier:
    """The digits of 𝒦 and γ that are left after some steps of the map at each precision, and the time of a step.

    proves: those that are proved, and the time of a step with its proof.
    """
    request, steps = sample("state", 1.0), 50 if quick else 400
    epsilon, notes = STEP / request.rate, f"{steps} steps of |ω|ε = {STEP:g}"
    momentum = epsilon * request.angular_momentum
    size = float(np.linalg.norm(momentum))

    def run(steps: int, precision: Precision) -> Trajectory:
        proved = proves and not isinstance(precision, Enclosure)
        start = request.ball, momentum, request.gamma
        return trajectory(*start, steps, every=steps, precision=precision, proved=proved)

    if not proves:
        say(f"rounding: the reference at {FINEST.count} digits")
        exact = ends(run(steps, FINEST))
        size = float(sum(x * x for x in exact[:3])) ** 0.5
        notes += f"; reference: the same steps at {FINEST.count} digits"

    def error(precision: Precision) -> float:
        found = run(steps, precision)
        if not proves:
            apart = abs(ends(found) - exact).astype(float)
            return float(max(apart[:3].max() / size, apart[3:].max()))
        if (bounds := found.proved) is None:
            radii = [[float(x.rad()) for x in v[-1]] for v in (found.momentum, found.gamma)]
            return max(max(radii[0]) / size, *radii[1])
        return float(max(bounds.momentum[-1] / size, bounds.gamma[-1]))

    def choice(precision: Precision) -> Choice:
        name = f"ball{precision.bits}" if isinstance(precision, Enclosure) else label_of(precision)
        count = TIMED.get(precision, steps)
        count = min(count, TIMED[NAMED["double-double"]]) if proves else count
        clause = "proved" if proves else "order 2"
        times = count, count * epsilon
        return Choice(f"{name}, {clause}", STEP, *times, partial(error, precision), partial(run, count, precision))

    kind, title = ("proved", "proved") if proves else ("correct", "rounding alone")
    question = f"{kind} digits of 𝒦/|𝒦| and γ of the map after {steps} steps"
    choices = map(choice, PROVED if proves else PRECISIONS)
    return frontier(title, question, [notes], choices, FINEST.count, 1 if quick else 5, say)


def ends(run: Trajectory) -> np.ndarray:
    """𝒦 and γ of the last frame, six Fractions (the middles of balls)."""
    return np.concatenate([exactly(run, name)[-1] for name in ("momentum", "gamma")])


def one_ball(of: str, quick: bool, say: Say) -> Frontier:
    """One ball: digits of the contact point, or of the state, after END seconds, and the time of a simulated second."""
    request = replace(sample(of, END), accuracy=1e-30, frames=1)
    say(f"{of}: the reference")
    exact = truth(request, DIGITS)
    choices = (
        _choice(
            request, method, steps,
            lambda method=method, steps=steps: true_error(request, take(request, method, steps, CHECKS), exact),  # type: ignore[misc]
            partial(take, request, method, steps, 1),
        )
        for method, steps in ways(request, quick)
    )  # fmt: skip
    what = "the contact point (m)" if of == "contact" else "K/|K| and γ"
    question = f"correct digits of {what} at the worst of {CHECKS} times in {END:g} s"
    notes = [f"reference: the motion with {DIGITS} proved digits"]
    return frontier(f"one ball, {of}", question, notes, choices, DIGITS, 1 if quick else 5, say)


def _choice(request: Request, method: Method, steps: int, error: Callable[[], float], run: Run) -> Choice:
    return Choice(name_of(method), request.rate * END / steps, steps, END, error, run)


def name_of(method: Method) -> str:
    """The precision and the order."""
    return f"{method.label}, order {method.order}"


def ways(request: Request, quick: bool, balls: int = 1) -> Iterator[tuple[Method, int]]:
    """Every method and number of steps whose run is not too long; of a batch a quarter of that, and no Digits."""
    digits: list[Precision] = [] if quick or balls > 1 else [Digits(30), Digits(50)]
    longest = LONGEST[quick] / (4 * balls if balls > 1 else 1)
    for precision in (*NAMED.values(), *digits):
        for method in methods(precision):
            for length in LENGTHS[quick]:
                steps = CHECKS * max(1, round(request.rate * request.time / length / CHECKS))
                if steps * method.stages * STAGE[label_of(precision)] <= longest:
                    yield method, steps


def batch(quick: bool, say: Say) -> Frontier:
    """A batch: digits of K and γ of some of its balls, the worst of them, and the time of a ball's simulated second."""
    one = replace(sample("state", END), accuracy=1e-30)
    random, n = np.random.default_rng(5), 32 if quick else BATCH
    turned = random.normal(scale=0.1, size=(n, 3))
    gamma = one.gamma + np.cross(turned, one.gamma)
    for _ in range(2):  # the second takes the rounding of the first away
        gamma /= np.sqrt((gamma * gamma).sum(axis=-1, keepdims=True))
    K = kernels.contact_momentum(np.array([3.0, -2.0, 1.0]) + turned, gamma, one.ball.mass_tensor, one.ball.D)
    some = [replace(one, angular_momentum=K[i], gamma=gamma[i]) for i in range(1 if quick else SHOWN)]
    say("batch: the references")
    exact = [truth(request, 20) for request in some]

    def error(method: Method, steps: int) -> float:
        return max(map(true_error, some, [take(request, method, steps, 1) for request in some], exact))

    choices = (
        _choice(one, method, steps, partial(error, method, steps), partial(_all, one.ball, K, gamma, method, steps))
        for method, steps in ways(one, quick, n)
    )
    question = f"correct digits of K/|K| and γ after {END:g} s"
    notes = [f"{n} balls, one core; error: the worst of {len(some)} of them"]
    return frontier(f"a batch of {n}", question, notes, choices, OF_BATCH, 1 if quick else 3, say, n)


def _all(ball: Ball, K: np.ndarray, gamma: np.ndarray, method: Method, steps: int) -> None:
    if method.order == EXTRAPOLATED:
        extrapolate(ball, K, gamma, END / steps, steps)
        return
    order, precision = method.order, method.precision
    trajectory(ball, END / steps * K, gamma, steps, order=order, every=steps, precision=precision, threads=1)
