"""Random balls to roll, what is true of them, and the ways to roll them: of chapsym, and heyoka.py's Taylor series."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property, partial
from typing import Any

import numpy as np

import chapsym
from chapsym import generated
from chapsym.dynamics import kernels
from chapsym.dynamics.attitudes import attitude_with
from chapsym.dynamics.loops.vectors import cross

from .continuous import LANES, adaptive, rates
from .harness import installed

#: heyoka.py's tolerances, from loose to tight.
TOLERANCES = tuple(10.0 ** (-k / 2) for k in range(8, 28))
ORDERS = (8, 6, 4, 2)
#: Seconds after which a search for the steps of a method ends.
PATIENCE = 5.0

#: The angular momentum, γ and, where they are followed, the contact points: (frames, 3), (frames, 3), (frames, 2).
States = tuple[np.ndarray, np.ndarray, np.ndarray | None]
Runs = dict[str, Callable[[], object]]


@dataclass(frozen=True, eq=False)
class Problem:
    """A ball and its start; it is to be known at `frames` equal times, the last of them `end` seconds."""

    ball: chapsym.Ball
    omega: np.ndarray
    gamma: np.ndarray
    end: float
    frames: int

    @cached_property
    def momentum(self) -> np.ndarray:
        """K at the start."""
        return kernels.contact_momentum(self.omega, self.gamma, self.ball.mass_tensor, self.ball.D)

    def error(self, found: States, truth: States) -> float:
        """The largest at any frame, relative to |K|, 1 and the radius; inf where a number is missing."""
        sizes = np.linalg.norm(self.momentum), 1.0, float(self.ball.radius)  # type: ignore[arg-type]
        pairs = zip(found, truth, sizes, strict=True)
        off = [float(np.linalg.norm(x - y, axis=-1).max() / size) for x, y, size in pairs if x is not None]
        return max(off) if np.isfinite(off).all() else np.inf


def drawn(count: int, seed: int, end: float | None = None) -> list[Problem]:
    """Problems of all kinds: moments, mass, radius, spin, time and number of frames over one to three decades."""
    draw = np.random.default_rng(seed)
    found = []
    for _ in range(count):
        ball, omega, gamma = rolling(draw)
        time_span = float(10.0 ** draw.uniform(0, 2.5))
        frames = int(draw.choice([1, 10, 100, 1000]))
        found.append(Problem(ball, omega, gamma, end or time_span, frames if end is None else 1))
    return found


def rolling(draw: np.random.Generator) -> tuple[chapsym.Ball, np.ndarray, np.ndarray]:
    """A ball, its ω and its γ."""
    J = 10.0 ** draw.uniform(-3, -1.5, 3)
    mass, radius = draw.uniform(0.2, 8), draw.uniform(0.03, 0.2)
    gamma, direction = (x / np.linalg.norm(x) for x in draw.normal(size=(2, 3)))
    ball = chapsym.Ball.from_mass_tensor(J, mass=mass, radius=radius)
    return ball, direction * 10.0 ** draw.uniform(-0.5, 0.8), gamma


def rolled(p: Problem, accuracy: float) -> States:
    """`roll`, with the contact point."""
    step = p.end / p.frames
    run = chapsym.roll(p.ball, p.omega, step, p.frames, gamma=p.gamma, contact=True, accuracy=accuracy)
    return run.momentum / step, run.gamma, run.contact


def accurate(p: Problem, accuracy: float) -> Any:
    """`accurate`, which promises K and γ."""
    return chapsym.accurate(p.ball, p.momentum, p.gamma, p.end, accuracy, frames=p.frames)


def extrapolated(p: Problem, steps: int, contact: bool = True) -> States:
    """`extrapolate` with this many steps a frame."""
    every = p.frames * steps
    run = chapsym.extrapolate(p.ball, p.momentum, p.gamma, p.end / every, every, every=steps, contact=contact)
    return run.angular_momentum, run.gamma, run.contact


def composed(p: Problem, steps: int, contact: bool = True, order: int = 2) -> States:
    """`trajectory` with this many steps of an order a frame."""
    count, epsilon = p.frames * steps, p.end / (p.frames * steps)
    run = chapsym.trajectory(p.ball, epsilon * p.momentum, p.gamma, count, order=order, every=steps, contact=contact)
    return run.momentum / epsilon, run.gamma, run.contact


def own_methods(p: Problem, truth: States, accuracy: float, contact: bool = True) -> Runs:
    """`extrapolate` and each order of `trajectory` with the fewest steps that meet the accuracy, the dear left out."""
    found: Runs = {}
    dearest = PATIENCE
    first = max(1, round(p.end / p.frames * float(np.linalg.norm(p.omega))))
    sides: dict[str, tuple[int, Callable[..., States]]] = {"extrapolate": (12, extrapolated)}
    for name, (order, side) in (sides | {f"order {o}": (o, partial(composed, order=o)) for o in ORDERS}).items():
        run = partial(side, p, contact=contact)
        steps, took = fewest(lambda n, run=run: p.error(run(n), truth), accuracy, order, first, 2 * dearest)  # type: ignore[misc]
        if steps:
            dearest = min(dearest, took)
            found[name] = partial(run, steps)
    return found


def fewest(error: Callable[[int], float], accuracy: float, order: int, first: int, limit: float) -> tuple[int, float]:
    """The fewest steps of a method that meet an accuracy, up to a tenth, and the seconds; 0 where they take longer."""

    def tried(steps: int) -> tuple[float, float]:
        start = time.thread_time()
        try:
            off = error(steps)
        except chapsym.StepNotTaken:
            return np.inf, 0.0
        return off, time.thread_time() - start

    few, steps = 0, first
    off, seconds = tried(steps)
    while off > accuracy:
        if seconds > limit:
            return 0, seconds
        few = steps
        steps = max(steps + 1, round(steps * min(8.0, max(1.1, 0.9 * (off / accuracy) ** (1 / order)))))
        off, seconds = tried(steps)
    while steps - few > max(1, 0.1 * steps):
        middle = (few + steps) // 2
        off, took = tried(middle)
        if off <= accuracy:
            steps, seconds = middle, took
        else:
            few = middle
    return steps, seconds


@cache
def _integrator(tolerance: float, kind: str) -> Any:
    """heyoka.py's, of K, γ, the attitude and the contact point; the parameters are J, D and the radius."""
    import heyoka

    v = heyoka.make_vars("K1", "K2", "K3", "g1", "g2", "g3", "a0", "a1", "a2", "a3", "x", "y")
    kinetic, radius = (*v[:6], *(heyoka.par[i] for i in range(4))), heyoka.par[4]
    omega, attitude = generated.angular_velocity(*kinetic), v[6:10]
    slip = generated.rotate(*attitude, *cross(omega, v[3:6]))
    turn = generated.compose(*attitude, 0.0, *(0.5 * w for w in omega))  # type: ignore[call-arg]
    sides = (*rates(*kinetic), *turn, slip[0] * radius, slip[1] * radius)
    return adaptive(list(zip(v, sides, strict=True)), tolerance, kind, parameters=5)


def _start(p: Problem) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The twelve numbers of the start, the five parameters, the times."""
    state = np.concatenate([p.momentum, p.gamma, attitude_with(p.gamma[np.newaxis])[0], [0.0, 0.0]])
    parameters = np.array([*p.ball.mass_tensor, p.ball.D, p.ball.radius], dtype=float)
    return state, parameters, np.linspace(0.0, p.end, p.frames + 1)


def seen(states: np.ndarray) -> States:
    """K, γ and the contact point of heyoka.py's twelve numbers."""
    return states[..., :3], states[..., 3:6], states[..., 10:]


def taylor(problem: Problem, tolerance: float, kind: str = "double") -> Callable[[], States]:
    """heyoka.py's states at the frames, as a function of nothing; the integrator is compiled once."""
    integrator, (state, parameters, times) = _integrator(tolerance, kind), _start(problem)
    times = times.astype(integrator.state.dtype)

    def run() -> States:
        integrator.pars[:] = parameters
        integrator.time = times[0]
        integrator.state[:] = state
        return seen(integrator.propagate_grid(times)[-1])

    return run


def taylor_batch(problems: list[Problem], tolerance: float) -> Callable[[], States]:
    """heyoka.py's states at the end, `LANES` balls at once, as a function of nothing."""
    integrator, count = _integrator(tolerance, "batch"), len(problems)
    whole = [problems[i % count] for i in range(-(-count // LANES) * LANES)]
    parts = (whole[i : i + LANES] for i in range(0, len(whole), LANES))
    starts = [[np.transpose(x) for x in zip(*map(_start, part), strict=True)] for part in parts]

    def run() -> States:
        ends = []
        for state, parameters, times in starts:
            integrator.set_time(0.0)
            integrator.state[:] = state
            integrator.pars[:] = parameters
            integrator.propagate_until(times[-1])
            ends.append(integrator.state.T.copy())
        return seen(np.concatenate(ends)[:count])

    return run


def loosest(problem: Problem, truth: States, accuracy: float) -> Callable[[], States] | None:
    """heyoka.py at its loosest tolerance that meets the accuracy."""
    runs = (taylor(problem, tolerance) for tolerance in TOLERANCES)
    return next((run for run in runs if problem.error(run(), truth) <= accuracy), None)


def truth_of(p: Problem) -> States:
    """The truth by heyoka.py in long double; where it is missing, by `extrapolate` in steps of a fifth of a radian."""
    if installed("heyoka") is None:
        return taylor(p, 1e-19, "long double")()
    return extrapolated(p, 1 + round(5 * p.end / p.frames * float(np.linalg.norm(p.omega))))
