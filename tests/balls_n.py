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


def invariant_scales(K):
    """How much each invariant may change for a relative change of 1 of 𝒦 and γ: 2j|𝒦|²ʲ⁻¹|𝒦|_F, 2j|𝒦|²ʲ, 2."""
    n, norm, frobenius = K.shape[-1], np.linalg.norm(K, 2, axis=(-2, -1)), np.linalg.norm(K, axis=(-2, -1))
    traces = [2 * j * norm ** (2 * j - 1) * frobenius for j in range(1, n // 2 + 1)]
    weights = [2 * j * norm ** (2 * j) for j in range(1, (n - 1) // 2 + 1)]
    return np.stack([*traces, *weights, 2 * np.ones(len(K))], axis=-1)


def proven_branch(K, gamma, J, D):
    """Ω - 1 at the end of the branch, by steps along t of which each is proven to stay on it; needs a small D/J.

    From a point P the map f(ξ) = 𝒦(P exp ξ) has |Df(ξ)η - Tη| ≤ l|ξ||η| with l = 2 max J + D and
    |ξ|² = Σ ξᵢⱼ², i > j: the derivative of exp ξ is off η by at most |ξ||η|, and 𝒦 is linear with the norm l.
    So for the least singular value σ of T, f is injective on |ξ| < σ/l, and a curve of momenta no longer than
    σ²/2l has its rotations there: it is enough to find one.
    """
    n, k, E, t = len(gamma), so_n.coordinates(K), np.zeros_like(K), 0.0
    bound = 2 * J.max() + D
    while t < 1:
        least = np.linalg.svd(so_n.jacobian(E, gamma, J, D), compute_uv=False)[-1]
        start, t = np.eye(n) + E, min(1.0, t + 0.99 * least**2 / (2 * bound * np.linalg.norm(k)))
        for _ in range(6):
            gap = t * k - so_n.coordinates(so_n.momentum(E, gamma, J, D))
            E = so_n.turned(E, so_n.from_coordinates(np.linalg.solve(so_n.jacobian(E, gamma, J, D), gap), n))
        assert np.abs(t * k - so_n.coordinates(so_n.momentum(E, gamma, J, D))).max() < 1e-12
        angles = np.angle(np.linalg.eigvals(start.T @ (np.eye(n) + E)))
        assert np.sqrt((angles**2).sum() / 2) < least / bound
    return E
