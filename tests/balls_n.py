"""Random balls in n dimensions, for the tests of the map on SO(n)."""

import numpy as np
from hypothesis import strategies as st

from chapsym import BallN, Status, testing
from chapsym.dynamics.n import so_n
from chapsym.dynamics.n.branch_n import small_rotation

UNIT_ROUNDOFF = 2.0**-53
SIZES = [3, 4, 5, 8]


def batch(n, balls, size, seed=7):
    """(BallN, 𝒦, γ): random balls with |𝒦| = size."""
    rng = np.random.default_rng([seed, n])
    gamma, k = rng.normal(size=(balls, n)), rng.normal(size=(balls, n * (n - 1) // 2))
    gamma /= np.linalg.norm(gamma, axis=-1, keepdims=True)
    k *= size / np.linalg.norm(k, axis=-1, keepdims=True)
    ball = BallN(rng.uniform(0.1, 2, (balls, n)), rng.uniform(0, 2, balls), radius=rng.uniform(0.5, 2, balls))
    return ball, so_n.from_coordinates(k, n), gamma


@st.composite
def balls(draw, n):
    """(J, D) in general position, or degenerate: equal or vanishing moments, D = 0, D large."""
    J = np.array(draw(st.lists(st.floats(0.05, 4.0), min_size=n, max_size=n)))
    D = draw(st.floats(0.01, 4.0) | st.sampled_from([0.0, 1e2, 1e4]))
    kind = draw(st.sampled_from(["generic", "equal", "nearly equal", "two equal", "one zero", "two zeros"]))
    if kind == "equal":
        J[:] = J[0]
    elif kind == "nearly equal":
        J[:] = J[0] * (1 + 1e-14 * np.arange(n))
    elif kind == "two equal":
        J[-1] = J[0]
    elif kind == "one zero":
        J[draw(st.integers(0, n - 1))] = 0.0
    elif kind == "two zeros":
        J[:2], D = 0.0, max(D, 0.5)
    return J, np.float64(D)


@st.composite
def states(draw, n, fraction=(0.0, 0.9)):
    """(𝒦, γ, J, D) whose next step exists: a fraction of the momentum at which the branch folds."""
    (J, D), gamma = draw(balls(n)), draw(testing.unit_vectors(n))
    if (J[:2] == 0).all() and np.abs(gamma[:2]).max() < 0.1:
        gamma = np.eye(n)[0]
    direction = so_n.from_coordinates(draw(testing.unit_vectors(n * (n - 1) // 2)), n)
    far = direction * 100 * (J.sum() + D)
    _, _, reach = small_rotation(far[None], gamma[None], J[None], D[None])
    K = far * reach[0] * draw(st.floats(*fraction))
    return K * (np.abs(K).max() > 1e-290), gamma, J, D  # below, numbers are not normal and an ulp is not relative


def offset(state):
    """Ω - 1 of the step, with all its digits."""
    E, status, _ = small_rotation(*(np.array(x)[None] for x in state))
    assert status[0] == Status.TAKEN
    return E[0]


def condition(E, state):
    """|T⁻¹|·(the size of the terms of the residual), relative to Ω - 1, as in chapsym.studies.check; 1 at rest."""
    K, gamma, J, D = state
    if not E.any():
        return 1.0
    inverse = 1 / np.linalg.svd(so_n.jacobian(E, gamma, J, D), compute_uv=False)[-1]
    return inverse * (np.abs(K).max() + 2 * (J.sum() + D) * np.abs(E).max()) / np.abs(E).max()
