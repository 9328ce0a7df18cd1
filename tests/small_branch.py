"""States within the bound of lemma small-branch, as the loops know it."""

import numpy as np
from hypothesis import strategies as st

from chapsym import testing
from chapsym.dynamics.loops import gibbs, loop


def prepared(state):
    """A ball under way, but for its integrals."""
    ball, momentum, gamma = state
    array = np.zeros(loop.ROWS)
    loop.entered(momentum, gamma, ball.mass_tensor, float(ball.D), array)
    return array


def heavy(ball):
    return gibbs.is_heavy(ball.inertia, float(ball.D))


@st.composite
def certified(draw, fraction):
    """A state of a ball that is not heavy, as `testing.states` draws it, with 𝒦 halved until it is within the bound."""
    ball, momentum, gamma = draw(testing.states(fraction=fraction).filter(lambda state: not heavy(state[0])))
    while prepared((ball, momentum, gamma))[loop.RADIUS] < 0:
        momentum = momentum / 2
    return ball, momentum, gamma
