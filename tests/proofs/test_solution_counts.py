"""The counts of claim 5.3 once more, with `fractions` alone: existence by Newton-Kantorovich, absence by a bound.

f(u) = 2(Bu + u×Λu) - 𝒦(1 + |u|²) with u = q/q₀ is quadratic, so that f(u + d) = f(u) + f'(u)d + ½f''(d, d)
exactly, and the contraction can be bounded without intervals.
"""

from fractions import Fraction as F

from reference import cross, dot, rotation, times, transposed

J, STRONG, GAMMA = [F(1), F(2), F(4)], F(1000), [F(6, 7), F(2, 7), F(3, 7)]
EIGHT = [F(-1, 4), F(-3, 2), F(1, 2)]
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


def momentum_vector(u, J, D, gamma):
    """½(1 + |u|²)𝒦, (5.2) divided by q₀²: Λu + u×Λu - D⟨γ,u⟩γ."""
    lam = [J[1] + J[2] + D, J[0] + J[2] + D, J[0] + J[1] + D]
    lifted = D * dot(gamma, u)
    turned = cross(u, [a * b for a, b in zip(lam, u, strict=True)])
    return [a * x + t - lifted * g for a, x, t, g in zip(lam, u, turned, gamma, strict=True)]


def residual(u):
    return [2 * m - k * (1 + dot(u, u)) for m, k in zip(momentum_vector(u, J, STRONG, GAMMA), EIGHT, strict=True)]


def slope(u):
    """f'(u), column by column; exact, as f is quadratic."""
    columns = []
    for i in range(3):
        e = [F(int(i == j)) for j in range(3)]
        ahead, behind = (residual([x + s * y for x, y in zip(u, e, strict=True)]) for s in (1, -1))
        columns.append([(a - b) / 2 for a, b in zip(ahead, behind, strict=True)])
    return transposed(columns)


def inverse(a):
    """By cofactors."""
    rows = [cross(a[1], a[2]), cross(a[2], a[0]), cross(a[0], a[1])]
    determinant = dot(a[0], rows[0])
    return transposed([[x / determinant for x in row] for row in rows])


def proved_radius(u):
    """A radius about u (in the maximum norm) in which f has exactly one zero; None if it is not proved."""
    back = inverse(slope(u))
    first = max(map(abs, times(back, residual(u))))
    columns = [[F(0)] * 3 for _ in range(9)]
    for i in range(3):
        for j in range(3):  # f''(e_i, e_j) by polarization
            ei, ej = ([F(int(k == n)) for k in range(3)] for n in (i, j))
            both = [x + y for x, y in zip(ei, ej, strict=True)]
            parts = [residual(v) for v in (both, ei, ej, [F(0)] * 3)]
            columns[3 * i + j] = times(back, [a - b - c + d for a, b, c, d in zip(*parts, strict=True)])
    second = max(sum(abs(column[row]) for column in columns) for row in range(3))
    radius = 2 * first
    # |d - Y f(u + d)| ≤ first + ½ second r² ≤ r, and the slope of that map, second·r, is below 1
    return radius if first + second * radius**2 / 2 <= radius and second * radius < 1 else None


def test_eight_real_solutions_exist(records):
    example = records["5.3-at-most-4"]["evidence"]["counterexamples"][0]
    assert example["point"] == {"J": "(1, 2, 4)", "D": "1000", "γ": "(6/7, 2/7, 3/7)", "𝒦": "(-1/4, -3/2, 1/2)"}
    assert example["printed"][0]["left"] == ["8"]
    places = [[F(round(x * 10**7), 10**7) for x in point] for point in NEAR]
    radii = [proved_radius(u) for u in places]
    assert all(radii)
    for i in range(8):
        for j in range(i):
            apart = max(abs(x - y) for x, y in zip(places[i], places[j], strict=True))
            assert apart > radii[i] + radii[j], "two enclosures meet: it may be one solution"


def test_the_radius_is_not_found_where_there_is_no_solution():
    assert proved_radius([F(1), F(1), F(1)]) is None


def test_a_momentum_that_no_rotation_has(records):
    """|𝒦₁| = 2|(J₂+J₃+D)q₀q₁ + ...| ≤ |𝒦| ≤ 2Λmax|q|(|q₀| + |q|) ≤ (1 + √2)Λmax < 5/2·13 < 40."""
    example = records["5.3-at-least-2"]["evidence"]["counterexamples"][0]
    assert example["printed"][0]["left"] == ["0"]
    assert example["point"] == {"J": "(1, 2, 4)", "D": "7", "γ": "(6/7, 2/7, 3/7)", "𝒦": "(40, 0, 0)"}
    assert F(5, 2) * (J[1] + J[2] + 7) < 40
    assert F(3, 2) ** 2 > 2, "5/2 is above 1 + √2"


def test_the_orbit_that_stops(records):
    """One step after (4, 2, 4, -1)/√37, from J = (1,2,3), D = 7: 𝒦 and γ are those of the register."""
    gamma = [F(1, 3), F(2, 3), F(2, 3)]
    u, square = [F(1, 2), F(1), F(-1, 4)], F(16, 37)
    before = [2 * square * m for m in momentum_vector(u, [F(1), F(2), F(3)], F(7), gamma)]
    # Rodrigues for a turn given by u: with q₀² = square, q = q₀u, every entry is rational
    turn = [[square * x for x in row] for row in _unnormalized(u)]
    after = times(transposed(turn), before)
    point = records["5.3-at-least-2"]["evidence"]["counterexamples"][1]["point"]
    assert point == {"J": "(1, 2, 3)", "D": "7", "γ": "(1/3, 2/3, 2/3)", "Ω": "Euler parameters ~ (4, 2, 4, -1)"}
    lines = "\n".join(records["5.3-at-least-2"]["evidence"]["derivation"])
    assert f"𝒦 after the step = {list(map(str, after))}".replace("'", "") in lines
    assert f"γ after the step = {list(map(str, times(transposed(turn), gamma)))}".replace("'", "") in lines


def _unnormalized(u):
    """(1 + |u|²)Ω: (1 - |u|²) + 2u× + 2uuᵀ."""
    columns = []
    for i in range(3):
        e = [F(int(i == j)) for j in range(3)]
        crossed = cross(u, e)
        columns.append([(1 - dot(u, u)) * e[k] + 2 * crossed[k] + 2 * u[k] * u[i] for k in range(3)])
    return transposed(columns)


def test_the_unnormalized_rotation_is_that_of_the_reference():
    assert [[F(16, 25) * x for x in row] for row in _unnormalized([F(1, 2), F(1, 4), F(1, 2)])] == rotation(
        F(4, 5), F(2, 5), F(1, 5), F(2, 5)
    )
