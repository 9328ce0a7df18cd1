"""The time of a call: each text in a compiled loop over the columns of many states, all texts interleaved."""

import time
from collections.abc import Sequence
from typing import Any

import numba
import numpy as np

from chapsym.studies.harness import Contender, interleaved

from .states import DRAWN, arguments
from .texts import Text, outputs

#: So many states that the loop is what takes the time, and they stay in the cache.
STATES = 256


def _loop(text: Text) -> Any:
    """A compiled loop: X (inputs, states) to Y (outputs, states), `repeats` times."""
    inputs = text.source[text.source.index("(") + 1 : text.source.index(")")].split(", ")
    count = outputs(text.kernel)
    left = ", ".join(f"Y[{i}, n]" for i in range(count))
    lines = [
        text.source,
        "def loop(X, Y, repeats):",
        "    for _ in range(repeats):",
        f"        for n in range({STATES}):",
        f"            {left} = {text.kernel}({', '.join(f'X[{i}, n]' for i in range(len(inputs)))})",
    ]
    scope: dict[str, Any] = {}
    exec(compile("\n".join(lines), f"{text.kernel}_loop.py", "exec"), scope)  # our own text, never a user's
    scope[text.kernel] = numba.njit(error_model="numpy", inline="never")(scope[text.kernel])
    return numba.njit(error_model="numpy")(scope["loop"])


def nanoseconds(texts: Sequence[Text], rounds: int, repeats: int) -> list[float]:
    """The median time of a call of each text, in generic states, in nanoseconds."""
    rng = np.random.default_rng(20071)
    kernel = texts[0].kernel
    X = np.array([arguments(kernel, "generic", list(rng.uniform(size=DRAWN))) for _ in range(STATES)]).T.copy()
    Y = np.empty((outputs(kernel), STATES))

    def contender(text: Text) -> Contender:
        loop = _loop(text)
        return Contender(text.without, lambda: loop(X, Y, repeats), STATES * repeats, time.thread_time)

    timings = interleaved([contender(text) for text in texts], rounds)
    return [timings[text.without].median * 1e9 for text in texts]
