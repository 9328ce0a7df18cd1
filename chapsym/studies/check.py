"""`chapsym check`: the float64 map against the mpmath oracle, over generic and awkward states.

The error of a step is given in ulps, units of 2^-52 relative to |q|, |𝒦| and |γ| = 1.  The accuracy of float64 depends
on the state: a rounding of the residual of 𝒦(q, γ) = 𝒦 changes q by |T⁻¹| times the rounding, where T is the tangent
Jacobian.  Roundings of the term with D are normal to γ, where T is as large as D (lemma `stable-momentum`): they change
q like its own roundings.  So the promise is relative to the condition number

    κ = 1 + |T⁻¹| (|𝒦| + 2 I_max |q|) / |q|,

and the promise is: q within `BUDGET`·κ ulps, 𝒦 and γ after the step within `BUDGET`·(1 + |q| κ) ulps.  Norms of vectors
are their largest components.  The promise is checked by measurement; the bounds of `proved=True` are proved for each
state, and compared with the same errors.
"""

from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass

import mpmath
import numpy as np

from chapsym import jobs
from chapsym.dynamics import Ball, kernels, trajectory
from chapsym.dynamics.ball import Floats
from chapsym.dynamics.levels.frames import cores
from chapsym.dynamics.loops.branch import small_rotation
from chapsym.dynamics.map import step
from chapsym.dynamics.oracle import Oracle, OracleStep
from chapsym.files import Data

ULP = 2.0**-52
#: States in a call of a worker.
TOGETHER = 50
#: The errors of q, 𝒦 and γ and what was promised, in ulps; κ; the largest error as a fraction of its bound.
Compared = tuple[Floats, Floats, float, float]
Random = np.random.Generator
#: A term of the residual is rounded at most 8 times, by half an ulp: products of five factors and the sum.
BUDGET = 4.0


@dataclass(frozen=True)
class State:
    """One ball and its state, in float64."""

    J: Floats
    D: float
    K: Floats
    g: Floats


@dataclass(frozen=True)
class Row:
    """The worst errors of one stratum, in ulps, and as a fraction of the promise.

    proved: the states with proved bounds; of_proved: the worst error as a fraction of its bound.
    """

    stratum: str
    states: int
    rotation_ulps: float
    momentum_ulps: float
    gamma_ulps: float
    condition: float
    of_budget: float
    proved: int
    of_proved: float

    @property
    def kept(self) -> bool:
        """Whether the promise was kept, and no proved bound was broken."""
        return self.of_budget <= 1.0 and self.of_proved <= 1.0


def _unit(rng: Random) -> Floats:
    v = rng.normal(size=3)
    v /= np.sqrt(v @ v)
    return v / np.sqrt(v @ v)


def _ball(rng: Random) -> tuple[Floats, float]:
    return rng.uniform(0.1, 2.0, 3), float(rng.uniform(0.0, 2.0))


def _at_reach(rng: Random, J: Floats, D: float, g: Floats, fraction: float, along: Floats | None = None) -> State:
    """A momentum in a direction, random by default, at `fraction` of the fold of the branch."""
    K = (_unit(rng) if along is None else along) * 100 * (J.sum() + D)
    return State(J, D, K * float(small_rotation(*[*K, *g, *J, D])[1]) * fraction, g)


def _flat(rng: Random) -> State:
    J, D = _ball(rng)
    J[rng.integers(3)] = 0.0
    return _at_reach(rng, J, D, _unit(rng), rng.uniform(0.01, 0.7))


def _nearly_equal(rng: Random) -> State:
    J, D = _ball(rng)
    return _at_reach(rng, J[0] * (1 + 1e-12 * rng.normal(size=3)), D, _unit(rng), rng.uniform(0.01, 0.7))


def _vertical(rng: Random) -> State:
    J, D = _ball(rng)
    g = _unit(rng)
    return _at_reach(rng, J, D, g, rng.uniform(0.01, 0.7), along=g)


STRATA: dict[str, Callable[[Random], State]] = {
    "generic": lambda rng: _at_reach(rng, *_ball(rng), _unit(rng), rng.uniform(0.01, 0.7)),
    "tiny momentum, 1e-300 to 1e-8": lambda rng: State(
        *_ball(rng), _unit(rng) * 10 ** rng.uniform(-300, -8), _unit(rng)
    ),
    "rotation at 0.9 to 0.999 of the fold": lambda rng: _at_reach(
        rng, *_ball(rng), _unit(rng), rng.uniform(0.9, 0.999)
    ),
    "1e-9 to 1e-4 before the fold": lambda rng: _at_reach(rng, *_ball(rng), _unit(rng), 1 - 10 ** rng.uniform(-9, -4)),
    "D = 0": lambda rng: _at_reach(rng, _ball(rng)[0], 0.0, _unit(rng), rng.uniform(0.01, 0.7)),
    "D = 1e3 to 1e6": lambda rng: _at_reach(
        rng, _ball(rng)[0], float(10 ** rng.uniform(3, 6)), _unit(rng), rng.uniform(0.01, 0.7)
    ),
    "J equal to 1e-12": _nearly_equal,
    "flat body, one J = 0": _flat,
    "vertical momentum": _vertical,
}


def compare(state: State, digits: int = 34) -> Compared:
    """One float64 step against the oracle: errors of q, 𝒦, γ and what was promised, in ulps; κ; of what is proved.

    The last is the largest error as a fraction of its bound, NaN where nothing is proved.
    """
    found = step(Ball(state.J, state.D), state.K, state.g, proved=True)
    vertical = mpmath.matrix(state.g)  # exactly; the map has the unit vector
    with mpmath.workdps(digits + 10):
        vertical = list(vertical / mpmath.norm(vertical))
    truth: OracleStep = Oracle([*state.J], state.D, vertical, digits).step([*state.K])
    q = found.rotation[1:]
    size, extent = np.abs(state.K).max() or 1.0, np.abs(q).max() or 1.0

    def ulps(values: Floats, exact: list[mpmath.mpf], scale: float) -> float:
        return max(float(abs(e - float(v)) / scale) for v, e in zip(values, exact, strict=True)) / ULP

    jacobian = kernels.tangent_jacobian(found.rotation, state.g, state.J, state.D)
    top = (state.J.sum() - state.J).max()
    kappa = 1 + float(np.linalg.norm(np.linalg.inv(jacobian), 2) * (size / extent + 2 * top))
    errors = [ulps(q, truth.q, extent), ulps(found.momentum, truth.momentum, size), ulps(found.gamma, truth.gamma, 1.0)]
    promised = [BUDGET * kappa, BUDGET * (1 + extent * kappa), BUDGET * (1 + extent * kappa)]
    exact = [truth.q0, *truth.q], truth.momentum, truth.gamma
    pairs = zip((found.rotation, found.momentum, found.gamma), exact, strict=True)
    off = [float(mpmath.norm([e - float(v) for v, e in zip(*pair, strict=True)])) for pair in pairs]  # the errors
    assert found.proved is not None
    bounds = np.array([found.proved.rotation, found.proved.momentum, found.proved.gamma])
    share = float(np.max(off / bounds)) if np.isfinite(bounds).all() else np.nan
    return np.array(errors), np.array(promised), kappa, share


def compare_all(states: list[State]) -> list[Compared]:
    """`compare` of each state."""
    return list(map(compare, states))


def drawn(name: str, states: int, seed: int) -> Iterator[list[State]]:
    """The seeded states of a stratum, some at a time."""
    rng = np.random.default_rng([seed, list(STRATA).index(name)])
    for at in range(0, states, TOGETHER):
        yield [STRATA[name](rng) for _ in range(at, min(at + TOGETHER, states))]


def worst(name: str, found: list[Compared]) -> Row:
    """The worst of the states of one stratum."""
    errors, promised, conditions, shares = map(np.array, zip(*found, strict=True))
    rotation, momentum, gamma = map(float, errors.max(axis=0))
    proved = int(np.isfinite(shares).sum())
    return Row(
        name, len(found), rotation, momentum, gamma, float(conditions.max()), float((errors / promised).max()),
        proved, float(np.nanmax(shares)) if proved else 0.0,
    )  # fmt: skip


def check(states: int = 20, seed: int = 20071, progress: Callable[[int], None] = lambda done: None) -> list[Row]:
    """One row for each stratum, in parallel on the cores; progress: gets the states done."""
    found: dict[str, list[Compared]] = {name: [] for name in STRATA}

    def chain(name: str) -> jobs.Chain:
        for some in drawn(name, states, seed):
            found[name] += yield jobs.Call(compare_all, (some,))
            progress(sum(map(len, found.values())))

    with jobs.processes(cores()) as crew:
        jobs.run(map(chain, STRATA), crew)
    return [worst(name, of) for name, of in found.items()]


@dataclass(frozen=True)
class Drift:
    """The changes of the invariants over a trajectory, relative to their size."""

    steps: int
    height: float
    squared: float
    unit: float
    budget: float

    @property
    def kept(self) -> bool:
        """Whether the drift stayed below the budget."""
        return max(self.height, self.squared, self.unit) <= self.budget


def drift(steps: int = 100_000, progress: Callable[[int], None] = lambda done: None) -> Drift:
    """The drift of ⟨𝒦,γ⟩, ⟨𝒦,𝒦⟩ and ⟨γ,γ⟩ over a trajectory: the roundings of n steps add up like √n.

    progress: gets the steps done.
    """
    ball = Ball((0.1, 0.5, 1.6), 0.7)
    every = max(1, steps // 1000)
    run = trajectory(ball, (0.03, -0.02, 0.035), (2 / 7, 3 / 7, 6 / 7), steps, every=every, progress=progress)
    values = run.invariants()
    height, squared, unit = map(float, np.abs(values - values[0]).max(axis=0) / np.abs(values[0]))
    return Drift(steps, height, squared, unit, budget=8 * ULP * float(np.sqrt(steps)))


def as_json(rows: list[Row], moved: Drift) -> Data:
    """The whole check for --json."""
    return {
        "budget_ulps": BUDGET,
        "strata": [{**asdict(row), "kept": row.kept} for row in rows],
        "drift": {**asdict(moved), "kept": moved.kept},
        "kept": all(row.kept for row in rows) and moved.kept,
    }
