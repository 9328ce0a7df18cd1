"""The motion of the continuous ball by another way: mpmath's Taylor series of K, γ, R and the contact point.

It shares nothing with what it judges: (2.3) as K' = K × ω, γ' = γ × ω, R' = Rω̂, with ω solved from the matrix
B(γ) = I + D(1 - γγᵀ), and r' = ρω × e₃ in space.
"""

import mpmath


def truth(mass_tensor, D, K, gamma, R, times, digits=35, radius=1):
    """(K, γ, ω, R, contact) at each time; R: rows of a matrix."""
    mp = mpmath.MPContext()
    mp.dps = digits
    J1, J2, J3 = map(mp.mpmathify, map(str_of, mass_tensor))
    D, radius = mp.mpf(str_of(D)), mp.mpf(str_of(radius))
    inertia = mp.diag([J2 + J3, J1 + J3, J1 + J2])

    def omega_of(K, g):
        g = mp.matrix(g)
        return list(mp.lu_solve(inertia + D * (mp.eye(3) - g * g.T), mp.matrix(K)))

    def cross(x, y):
        return [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]]

    def field(t, y):
        K, rows = y[:3], [y[3:6], y[6:9], y[9:12]]
        w = omega_of(K, rows[2])
        space = [sum(a * b for a, b in zip(row, w, strict=True)) for row in rows]
        turned = [x for row in rows for x in cross(row, w)]
        return [*cross(K, w), *turned, radius * space[1], -radius * space[0]]

    start = [*K, *R[0], *R[1], *gamma, 0, 0]
    solution = mp.odefun(field, 0, [mp.mpf(str_of(x)) if not isinstance(x, mp.mpf) else x for x in start])
    found = []
    for time in times:
        y = solution(mp.mpf(str_of(time)))
        found.append((y[:3], y[9:12], omega_of(y[:3], y[9:12]), [y[3:6], y[6:9], y[9:12]], y[12:]))
    return found


def str_of(x):
    """A number as mpmath reads it."""
    return str(x)
