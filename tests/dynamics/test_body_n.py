"""Attitude and contact point in n dimensions: they follow the steps, from the least rotation or a given one."""

import numpy as np
import pytest
from balls_n import SIZES, UNIT_ROUNDOFF, batch

from chapsym import BallN, step_n, trajectory_n


@pytest.mark.parametrize("n", SIZES)
def test_the_body_turns_and_rolls_with_the_steps(n):
    """R' = RΩ, R γ = eₙ, R𝒦Rᵀ constant, and Δr = ρ/2 (Ω̄ - Ω̄ᵀ)eₙ with Ω̄ = R'Rᵀ, in the plane (4.9)."""
    ball, K, gamma = batch(n, 3, 0.2)
    run = trajectory_n(ball, K, gamma, 40, contact=True)
    R, r = run.attitude, np.concatenate([run.contact, np.zeros((3, 41, 1))], axis=-1)
    space = R[:, 1:] @ R[:, :-1].mT
    # The entries of R are rounded, and so is the product that checks them.
    assert np.abs(R @ R.mT - np.eye(n)).max() <= 2 * (n + 1) * UNIT_ROUNDOFF
    assert np.abs((R @ run.gamma[..., None])[..., 0] - np.eye(n)[-1]).max() <= 64 * UNIT_ROUNDOFF
    fixed = R @ run.momentum @ R.mT
    assert np.abs(fixed - fixed[:, :1]).max() <= 64 * UNIT_ROUNDOFF
    stride = ball.radius[:, None, None] / 2 * (space - space.mT)[..., -1]
    assert np.abs(np.diff(r, axis=1) - stride).max() <= 64 * UNIT_ROUNDOFF
    assert np.abs(stride).max() > 0.01
    steps = step_n(ball, run.momentum[:, 7], run.gamma[:, 7])
    assert np.abs(R[:, 8] - R[:, 7] @ steps.rotation).max() <= 8 * UNIT_ROUNDOFF
    assert np.abs(run.momentum[:, 8] - steps.momentum).max() <= 8 * UNIT_ROUNDOFF * np.abs(run.momentum).max()


@pytest.mark.parametrize("n", SIZES)
@pytest.mark.parametrize(
    ("tilt", "last"),
    [(np.sqrt((1 - x) * (1 + x)), x) for x in (1.0, 0.5, 0.0, -0.5, -1 + 1e-10, -1 + 1e-15, -1.0)]
    + [(tilt, -1.0) for tilt in (1e-300, 1e-20, 1e-9)],
)
def test_the_first_attitude_makes_gamma_vertical(n, tilt, last):
    """Almost upside down 1 + γₙ is 0 or has no digits, but γ has them."""
    gamma = np.zeros(n)
    gamma[0], gamma[-1] = tilt, last
    R = trajectory_n(BallN(np.ones(n), 1), np.zeros((n, n)), gamma, 0, attitude=True).attitude[0]
    assert np.abs(R @ R.T - np.eye(n)).max() <= 16 * UNIT_ROUNDOFF
    assert np.linalg.det(R) == pytest.approx(1)
    assert np.abs(R @ gamma - np.eye(n)[-1]).max() <= 16 * UNIT_ROUNDOFF
    if last > -1:  # the least rotation leaves alone what is normal to both
        assert (R[1:-1, 1:-1] == np.eye(n)[1:-1, 1:-1]).all()


def test_a_given_attitude_is_followed():
    ball, K, gamma = batch(4, 3, 0.1)
    turn = np.eye(4)[[1, 2, 0, 3]]
    plain = trajectory_n(ball, K, gamma, 10, contact=True)
    turned = trajectory_n(ball, K, gamma, 10, contact=True, attitude=turn @ plain.attitude[:, 0])
    assert np.abs(turned.attitude - turn @ plain.attitude).max() <= 64 * UNIT_ROUNDOFF
    assert np.abs(turned.contact - plain.contact @ turn[:3, :3].T).max() <= 64 * UNIT_ROUNDOFF
