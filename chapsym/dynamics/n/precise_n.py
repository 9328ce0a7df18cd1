"""Runs at N digits: `run_n.continued` on the midpoints of Arb's numbers, with guard bits.

A stage starts from the float64 rotation of the continuation, which selects the branch; Newton's iteration adds the
digits.
"""

import math
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from flint import arb, arb_mat, ctx

from chapsym.numbers import Digits
from chapsym.numbers.precisions import flint_bits

from ..ball import Floats
from ..errors import Status
from ..levels.balls import GUARD, exact, in_context
from ..levels.frames import Count, untaken
from ..loops.records import Ends, Steps
from . import so_n
from .branch_n import small_rotation

#: The largest number of Newton corrections from a float64 rotation; each doubles the digits.
MOST_ROUNDS = 100

_exactly, _middle, _root = (np.frompyfunc(f, 1, 1) for f in (exact, arb.mid, arb.sqrt))


def run(
    precision: Digits,
    state: dict[str, Floats],
    frames: dict[str, Any],
    stages: Sequence[Fraction],
    steps: Steps,
    count: Count,
    continued: Callable[..., Any],
) -> Ends:
    """`run_n.run` at N digits: writes the frames, of objects.

    continued: `run_n.continued`, which takes the steps.
    """
    balls, context = len(state["gamma"]), precision.context
    ends = untaken(balls)
    # The effect of roundings grows with the square of the number of steps, as the frequencies drift.
    bits = context.prec + 2 * math.ceil(math.log2(steps.last * len(stages) + 1)) + GUARD
    with flint_bits(bits):
        now: dict[str, Any] = {name: _exactly(x) for name, x in state.items()}
        now["gamma"] = now["gamma"] / _root((now["gamma"] ** 2).sum(axis=-1, keepdims=True))
        for _ in range(bits.bit_length() if "attitude" in now else 0):
            now["attitude"] = _middle(so_n.polar(now["attitude"]))
        for name, array in frames.items():
            array[:, 0] = now[name]
        continued(now, frames, [exact(c) for c in stages], steps, ends, np.arange(balls), count, _rotations)
    rounded = np.frompyfunc(lambda x: x if isinstance(x, float) else in_context(context, x, context.prec), 1, 1)
    for array in frames.values():
        array[...] = rounded(array)
    return ends


def _rotations(K: Any, gamma: Any, J: Any, D: Any) -> tuple[Any, np.ndarray, Floats]:
    """`branch_n.small_rotation` in Arb's numbers, whose radii are not used."""
    rough, status, reach = small_rotation(*(x.astype(float) for x in (K, gamma, J, D)))
    E = rough.astype(object)
    for i in np.flatnonzero(status == Status.TAKEN):
        one = slice(i, i + 1)
        if (found := _refined(_exactly(rough[one]), *(_middle(x[one]) for x in (K, gamma, J, D)))) is None:
            status[i] = Status.NOT_CONVERGED
        else:
            E[one] = found
    return E, status, reach


def _refined(E: Any, K: Any, gamma: Any, J: Any, D: Any) -> Any:
    """Newton's iteration for one ball from a nearby E; None if it does not converge."""
    n, tiny = E.shape[-1], arb(2) ** (-ctx.prec - GUARD)
    for _ in range(MOST_ROUNDS):
        E = _middle(so_n.orthogonal(E))
        slope = arb_mat(so_n.jacobian(E, gamma, J, D)[0].tolist())
        gap = so_n.coordinates(K - so_n.momentum(E, gamma, J, D))
        try:
            x = slope.solve(arb_mat(gap.size, 1, gap[0].tolist())).entries()
        except ZeroDivisionError:
            return None
        xi = so_n.from_coordinates(_middle(np.array([x])), n)
        turn = xi + xi @ xi / 2
        E = _middle(E + turn + E @ turn)
        # The error is now about the square of the correction.
        if (xi**2).sum() <= tiny * (E**2).sum():
            return so_n.orthogonal(E)
    return None
