"""The counts of claim 5.3 once more, with `fractions` alone: existence by Newton-Kantorovich, absence by a bound.

f(u) = 2(Bu + u×Λu) - 𝒦(1 + |u|²) with u = q/q₀ is quadratic, so that f(u + d) = f(u) + f'(u)d + ½f''(d, d)
exactly, and the contraction can be bounded without intervals.
"""

from fractions import Fraction as F

import numpy as np
from reference import rotation

J, STRONG = np.array([F(1), F(2), F(4)]), F(1000)
GAMMA, EIGHT = np.array([F(6, 7), F(2, 7), F(3, 7)]), np.array([F(-1, 4), F(-3, 2), F(1, 2)])
#: u = q/q₀ of the eight solutions, to a few digits; where they are is proved below.
NEAR = [
    (-899.1427437, 9.8970462, 3435.4737155),
    (-1356.7986747, -247.8322515, 392.5085716),
    (725.2823155, -1577.4230874, -349.8356954),
    (8034.9664632, -3000.6478256, -2263.1736556),
    (-65.4749929, -32.6998964, -29.7254701),
    (-34.1952937, -14.3983175, -16.3802283),
    (-0.0341593, -0.0121056, -0.0168185),
    (-401.0927103, -309.4890044, 3.7414174),
]
AXES = np.eye(3, dtype=int)


def momentum_vector(u, J, D, gamma):
    """½(1 + |u|²)𝒦, (5.2) divided by q₀²: Λu + u×Λu - D⟨γ,u⟩γ."""
    spin = (J.sum() - J + D) * u
    return spin + np.cross(u, spin) - D * (gamma @ u) * gamma


def residual(u):
    return 2 * momentum_vector(u, J, STRONG, GAMMA) - EIGHT * (1 + u @ u)


def inverse(a):
    """By cofactors."""
    rows = np.array([np.cross(a[1], a[2]), np.cross(a[2], a[0]), np.cross(a[0], a[1])])
    return rows.T / (a[0] @ rows[0])


def proved_radius(u):
    """A radius about u (in the maximum norm) in which f has exactly one zero; None if it is not proved."""
    slope = np.array([(residual(u + e) - residual(u - e)) / 2 for e in AXES]).T  # exact, as f is quadratic
    back, zero = inverse(slope), residual(0 * u)
    first = max(abs(back @ residual(u)))
    bends = [residual(a + b) - residual(a) - residual(b) + zero for a in AXES for b in AXES]  # f''(a, b)
    second = max(abs(back @ np.array(bends).T).sum(axis=1))
    radius = 2 * first
    # |d - Y f(u + d)| ≤ first + ½ second r² ≤ r, and the slope of that map, second·r, is below 1
    return radius if first + second * radius**2 / 2 <= radius and second * radius < 1 else None


def point(J, D, gamma, K):
    """A ball, a vertical and a momentum, as the register writes them."""
    vectors = [(f"{name}{i}", x) for name, v in (("J", J), ("g", gamma), ("K", K)) for i, x in enumerate(v, 1)]
    return {name: str(x) for name, x in [*vectors, ("D", D)]}


def test_eight_real_solutions_exist_and_none_is_found_where_there_is_none(records):
    example = records["5.3-at-most-4"]["evidence"]["counterexamples"][0]
    assert example["point"] == point(J, STRONG, GAMMA, EIGHT)
    assert example["printed"][0]["left"] == ["8"]
    places = [np.array([F(round(x * 10**7), 10**7) for x in point]) for point in NEAR]
    radii = [proved_radius(u) for u in places]
    assert all(radii)
    for i in range(8):
        for j in range(i):
            assert max(abs(places[i] - places[j])) > radii[i] + radii[j], "two enclosures meet: it may be one solution"
    assert proved_radius(J / J) is None


def test_a_momentum_that_no_rotation_has(records):
    """|𝒦₁| = 2|(J₂+J₃+D)q₀q₁ + ...| ≤ |𝒦| ≤ 2Λmax|q|(|q₀| + |q|) ≤ (1 + √2)Λmax < 5/2·13 < 40."""
    example = records["5.3-at-least-2"]["evidence"]["counterexamples"][0]
    assert example["printed"][0]["left"] == ["0"]
    assert example["point"] == point(J, F(7), GAMMA, (40, 0, 0))
    assert F(5, 2) * (J[1] + J[2] + 7) < 40
    assert F(3, 2) ** 2 > 2, "5/2 is above 1 + √2"


def test_the_orbit_that_stops(records):
    """One step after (4, 2, 4, -1)/√37, from J = (1,2,3), D = 7: 𝒦 and γ are those of the register."""
    gamma, u, square = np.array([F(1), F(2), F(2)]) / 3, np.array([F(1, 2), F(1), F(-1, 4)]), F(16, 37)
    before = 2 * square * momentum_vector(u, np.array([F(1), F(2), F(3)]), F(7), gamma)
    # Rodrigues for a turn given by u: with q₀² = square, q = q₀u, every entry is rational
    turn = square * _unnormalized(u)
    other = F(16, 25) * _unnormalized(np.array([F(1, 2), F(1, 4), F(1, 2)]))
    assert other.tolist() == rotation(F(4, 5), F(2, 5), F(1, 5), F(2, 5))
    example = records["5.3-at-least-2"]["evidence"]["counterexamples"][1]
    assert example["printed"][0]["statement"].endswith(
        "one step after γ = (1, 2, 2)/3 and Euler parameters ~ (4, 2, 4, -1)"
    )
    assert example["point"] == point((1, 2, 3), 7, turn.T @ gamma, turn.T @ before)
    lines = "\n".join(records["5.3-at-least-2"]["evidence"]["derivation"])
    assert f"𝒦 after the step = {list(map(str, turn.T @ before))}".replace("'", "") in lines
    assert f"γ after the step = {list(map(str, turn.T @ gamma))}".replace("'", "") in lines


def _unnormalized(u):
    """(1 + |u|²)Ω: (1 - |u|²) + 2u× + 2uuᵀ."""
    return (1 - u @ u) * AXES + 2 * np.cross(u, AXES).T + 2 * np.outer(u, u)
