"""Every kernel a second time, in mpmath by another formulation: (4.13) in the oracle's matrices, solves, turns."""

import math

import mpmath

from chapsym.dynamics.oracle import Oracle

MP = mpmath.MPContext()
MP.dps = 60


def matrix(rows):
    return MP.matrix([list(row) for row in rows])


def column(values):
    return MP.matrix(list(values))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def hat(v):
    return matrix([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def turn(q):
    """Ω of a quaternion of any length, by 1 + 2(q₀ q̂ + q̂²)/|q|²."""
    s = hat(q[1:])
    return MP.eye(3) + 2 * (q[0] * s + s * s) / sum(x * x for x in q)


def moments(J):
    return [J[1] + J[2], J[0] + J[2], J[0] + J[1]]


def rolled(J, D, g):
    """B(γ) = I + D(|γ|² - γγᵀ), in matrices."""
    g = column(g)
    return MP.diag(moments(J)) + D * ((g.T * g)[0] * MP.eye(3) - g * g.T)


def oracle_momentum(q, g, J, D):
    """(4.13), the oracle's matrices: for a unit γ and any q, |q|² times the value at its direction."""
    if not any(q):
        return [MP.mpf(0)] * 3
    oracle = Oracle(J, D, g, 60)
    X = oracle.momentum(oracle.mp.matrix(turn(q).tolist()))
    return [MP.mpf(x) * sum(y * y for y in q) for x in (X[2, 1], X[0, 2], X[1, 0])]


def jacobian(q, g, J, D, directions):
    """Derivatives along directions of q by the oracle, exact for a quadratic map: (f(q+d) - f(q-d))/2."""

    def f(d, sign):
        return oracle_momentum([a + sign * b for a, b in zip(q, d, strict=True)], g, J, D)

    ends = [(f(d, 1), f(d, -1)) for d in directions]
    return [(ends[j][0][i] - ends[j][1][i]) / 2 for i in range(3) for j in range(3)]


def product(a, b):
    """Hamilton's product by 4×4 matrices."""
    left = matrix(
        [[a[0], -a[1], -a[2], -a[3]], [a[1], a[0], -a[3], a[2]], [a[2], a[3], a[0], -a[1]], [a[3], -a[2], a[1], a[0]]]
    )
    return list(left * column(b))


def body_directions(q):
    return [product(q, [0, *(1 if i == j else 0 for j in range(3))]) for i in range(3)]


def hessian(q, g, J, D):
    pairs = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
    directions = body_directions(q)

    def f(a, b, sign):
        return oracle_momentum([x + sign * y for x, y in zip(a, b, strict=True)], g, J, D)

    rows = []
    for i, j in pairs:
        plus, minus = (f(directions[i], directions[j], sign) for sign in (1, -1))
        rows += [(x - y) / 2 for x, y in zip(plus, minus, strict=True)]
    return rows


def gibbs_parts(u, k, g, I, D):
    """∂G/∂u and the right side of the next iterate, in matrices."""
    J = [(I[1] + I[2] - I[0]) / 2, (I[0] + I[2] - I[1]) / 2, (I[0] + I[1] - I[2]) / 2]
    u, k, inertia = column(u), column(k), MP.diag(I)
    A = rolled(J, D, g) + hat(u) * inertia - hat(inertia * u) - 2 * k * u.T
    return A, hat(u) * inertia * u + (1 - (u.T * u)[0]) * k


def cofactors(A):
    return list(MP.det(A) * (A**-1).T)


def newton(a):
    A, right = gibbs_parts(a["gibbs"], a["half_momentum"], a["gamma"], a["inertia"], a["D"][0])
    det = MP.det(A)
    return [det, *(det * MP.lu_solve(A, right)), *cofactors(A)]


def vertical_matrix(t, e, g, L):
    return MP.diag(list(L)) - e * MP.eye(3) - t * hat(g)


def level(a):
    (t, v), L = a["scalars"], a["Lambda"]

    def f(v):
        m = v * t * t
        p = [x - m for x in L]
        return v * (p[0] * p[1] * p[2]) + v * t * t * (sum(L) - 2 * m) - t * t - a["level"][0]

    return [f(v), MP.diff(f, v)]


def energy(a):
    K = column(a["momentum"])
    return [(K.T * MP.lu_solve(rolled(a["mass_tensor"], a["D"][0], normalised(a["gamma"])), K))[0] / 2]


def normalised(g):
    size = MP.sqrt(sum(x * x for x in g))
    return [x / size for x in g]


def quadratic(a, d):
    """d × Id - |d|²k."""
    return hat(d) * MP.diag(list(a["inertia"])) * d - (d.T * d)[0] * column(a["half_momentum"])


def mixed(a):
    d, e = column(a["correction"]), column(a["next_correction"])
    C = matrix([a["cofactors"][i : i + 3] for i in (0, 3, 6)])
    return list(C.T * (quadratic(a, d + e) - quadratic(a, d) - quadratic(a, e)))


def gibbs_residual(a):
    u, k, (D,) = column(a["gibbs"]), column(a["half_momentum"]), a["D"]
    I = a["inertia"]
    J = [sum(I) / 2 - x for x in I]
    return list(rolled(J, D, a["gamma"]) * u + hat(u) * MP.diag(list(I)) * u - (1 + (u.T * u)[0]) * k)


def symmetric(a):
    """The invariants of ½(∂G/∂u + its transpose) by powers of it; ∂(u × Iu) by the products of u and Iu."""
    u, k, (D,) = column(a["gibbs"]), column(a["half_momentum"]), a["D"]
    I = a["inertia"]
    whole = MP.diag(list(I))
    A = rolled([sum(I) / 2 - x for x in I], D, a["gamma"]) + hat(u) * whole - hat(whole * u) - 2 * k * u.T
    S = (A + A.T) / 2
    trace, square = (sum(M[i, i] for i in range(3)) for M in (S, S * S))
    return [trace, (trace**2 - square) / 2, MP.det(S)]


def second(a):
    d, C = column(a["correction"]), matrix([a["cofactors"][i : i + 3] for i in (0, 3, 6)])
    return list(C.T * quadratic(a, d))


def body(a):
    return a["rotation"], a["gamma"], a["mass_tensor"], a["D"][0]


def chart(a):
    """∂𝒦/∂q with ∂q₀/∂q = -q/q₀."""
    q = a["rotation"]
    directions = [[-q[i + 1] / q[0], *(MP.mpf(int(i == j)) for j in range(3))] for i in range(3)]
    return jacobian(*body(a), directions)


def closed(a):
    (t, e), g = a["sigma"], a["gamma"]
    M = vertical_matrix(t, e, g, a["Lambda"])
    return [MP.det(M), *(t * MP.det(M) * MP.lu_solve(M, column(g)))]


def on_curve(a):
    """k², G at three points of sn², and μ, from |γ|² = 1 and ⟨γ,Λ⁻¹γ⟩ = l solved at sn = 0 and 1."""
    L, right = a["ordered"], column([1, a["inverse_square"][0]])
    first, third = MP.lu_solve(matrix([[1, 1], [1 / L[0], 1 / L[2]]]), right)
    second, rest = MP.lu_solve(matrix([[1, 1], [1 / L[1], 1 / L[2]]]), right)
    k2 = 1 - rest / third

    def G(y):
        cn2, dn2 = 1 - y, 1 - k2 * y
        return (first / L[0] ** 2 - second / L[1] ** 2 * dn2) * cn2 / k2 + third / L[2] ** 2 * dn2

    points = [MP.mpf(x) for x in (0, 1, 2)]
    return [k2, *MP.lu_solve(matrix([[1, x, x * x] for x in points]), column([G(x) for x in points])), second / L[1]]


def precession(a):
    """The products b, b and b, Λ⁻¹b of vectors γ × Λ⁻¹γ at sn = 0 and 1, where γ has two components."""
    L, right = a["ordered"], column([1, a["inverse_square"][0]])
    found = []
    for i in (0, 1):
        other = MP.lu_solve(matrix([[1, 1], [1 / L[i], 1 / L[2]]]), right)
        # b² = γᵢ²γ₃²(1/Λᵢ - 1/Λ₃)² along the third axis.
        square = other[0] * other[1] * (1 / L[i] - 1 / L[2]) ** 2
        found.append((square, square / L[1 - i]))
    (first, weighted), (second, heavier) = found
    return [first, second - first, weighted, heavier - weighted]


def cross(a, b):
    return list(hat(a) * column(b))


def load(a):
    """-d²/dε² of B(γ)ω along the field, by its parts: the swing of Iω and what turns with γ."""
    w, r, g, D = a["omega"], a["rate"], a["gamma"], a["D"][0]
    I = moments(a["mass_tensor"])
    swing = hat(w) * MP.diag(I) * column(r) - hat([i * x for i, x in zip(I, w, strict=True)]) * column(r)
    moving = column(cross(g, w))
    outer = moving * column(g).T
    return list(swing + 2 * D * (outer + outer.T) * column(r))


#: Each kernel by another formulation: the oracle's matrices (4.13), linear solves, 3×3 determinants.
INDEPENDENT = {
    "momentum": lambda a: oracle_momentum(*body(a)),
    "residual": lambda a: [x - y for x, y in zip(oracle_momentum(*body(a)), a["momentum"], strict=True)],
    "momentum_jacobian": chart,
    "tangent_jacobian": lambda a: jacobian(*body(a), body_directions(a["rotation"])),
    "tangent_hessian": lambda a: hessian(*body(a)),
    "rotation": lambda a: list(turn(a["rotation"])),
    "rotate": lambda a: list(turn(a["rotation"]) * column(a["vector"])),
    "transport": lambda a: list(turn(a["rotation"]).T * column(a["vector"])),
    "compose": lambda a: product(a["first"], a["second"]),
    "centre_step": lambda a: list((turn(a["rotation"]) - turn(a["rotation"]).T) / 2 * column(a["gamma"])),
    "invariants": lambda a: [dot(a["momentum"], a["gamma"]), dot(*2 * [a["momentum"]]), dot(*2 * [a["gamma"]])],
    "energy": energy,
    "contact_momentum": lambda a: list(rolled(a["mass_tensor"], a["D"][0], a["gamma"]) * column(a["omega"])),
    "angular_velocity": lambda a: list(
        MP.lu_solve(rolled(a["mass_tensor"], a["D"][0], normalised(a["gamma"])), column(a["momentum"]))
    ),
    "gibbs_newton": newton,
    "gibbs_newton_heavy": newton,
    "gibbs_second": second,
    "gibbs_mixed": mixed,
    "gibbs_symmetric": symmetric,
    "gibbs_residual": gibbs_residual,
    "turn": lambda a: list((turn(a["quaternion"]).T - MP.eye(3)) * column(a["vector"])),
    "vertical_square": lambda a: [dot([x * x for x in a["gamma"]], [math.prod(a["Lambda"]) / m for m in a["Lambda"]])],
    "vertical_level": level,
    "vertical_rotation": closed,
    "curve_increment": on_curve,
    "precession_parts": precession,
    "isotropic_spin": lambda a: list(
        MP.lu_solve(rolled(3 * [a["moment"][0] / 2], a["D"][0], normalised(a["gamma"])), column(a["half_momentum"]))
    ),
    "torque": lambda a: list(
        hat([i * x for i, x in zip(moments(a["mass_tensor"]), a["omega"], strict=True)]) * column(a["omega"])
    ),
    "modified_load": load,
    "modified_rotation": lambda a: list(
        2 * dot(a["omega"], a["omega"]) * column(a["omega"]) + hat(a["rate"]) * column(a["omega"]) - column(a["share"])
    ),
    "energy_rate": lambda a: [
        a["D"][0] * dot(a["gamma"], a["rate"]) * MP.det(matrix([a["gamma"], a["omega"], a["rate"]]))
    ],
}  # fmt: skip
