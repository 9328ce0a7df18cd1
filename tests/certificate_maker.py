"""Certificates for the tests, made with mpmath: nothing here is rigorous, and nothing is shared with the checker."""

import hashlib
import json

import mpmath as mp

LEVEL = "0.24300095290638263550532670"


def cross(a, b):
    return mp.matrix([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def gibbs(J, D, momentum, gamma, near=None):
    """The root of Bu + u × Iu = (1 + |u|²)k near 0, by Newton's iteration from u = 0 or from `near`."""
    inertia = mp.diag([J[1] + J[2], J[2] + J[0], J[0] + J[1]])
    B = inertia + D * (mp.eye(3) - gamma * gamma.T)
    k, u = momentum / 2, mp.zeros(3, 1) if near is None else near
    for _ in range(60):
        Iu = inertia * u
        F = B * u + cross(u, Iu) - (1 + (u.T * u)[0]) * k
        A = mp.zeros(3, 3)
        for j in range(3):
            e = mp.matrix([int(i == j) for i in range(3)])
            A[:, j] = B * e + cross(e, Iu) + cross(u, inertia * e) - 2 * u[j] * k
        correction = mp.lu_solve(A, F)
        u = u - correction
        if mp.norm(correction) < mp.mpf(2) ** (-0.6 * mp.mp.prec):  # the next one is its square
            return u
    raise AssertionError("Newton's iteration does not converge")


def turned(u, v):
    once = cross(u, v)
    return v + 2 / (1 + (u.T * u)[0]) * (cross(u, once) - once)


def travelled(J, D, state, steps):
    """The state after so many steps, and the Gibbs vectors on the way."""
    momentum, gamma = state
    path = []
    for _ in range(steps):
        u = gibbs(J, D, momentum, gamma)
        momentum, gamma = turned(u, momentum), turned(u, gamma)
        path.append(u)
    return (momentum, gamma), path


def number(text):
    top, _, bottom = text.partition("/")
    return mp.mpf(top) / mp.mpf(bottom or 1)


def rounded(x, digits):
    """The nearest decimal, written out."""
    n = int(mp.nint(x * mp.mpf(10) ** digits))
    text = f"{abs(n):0{digits + 1}d}"
    return "-" * (n < 0) + f"{text[:-digits]}.{text[-digits:]}"


def sealed(data):
    """The certificate with its digest."""
    rest = {k: v for k, v in data.items() if k != "digest"}
    return rest | {
        "digest": hashlib.sha256(json.dumps(rest, sort_keys=True, separators=(",", ":")).encode()).hexdigest()
    }


def measure(
    J=("1", "2", "4"), D="1", height="12/5", level=LEVEL, steps=9, turns=1, axes=(1, 2, 3), digits=60, radius="0"
):
    """A certificate of kind no-invariant-measure; the sentence is put together here once more."""
    with mp.workdps(2 * digits + 3 * steps):
        return sealed(_measure(J, D, height, level, steps, turns, axes, digits, radius))


def _measure(J, D, height, level, steps, turns, axes, digits, radius):
    Jn, Dn, h, l = [number(x) for x in J], number(D), number(height), number(level)
    weights = [1 / (sum(Jn) - x + Dn) for x in Jn]
    a, b, c = (i - 1 for i in axes)
    orbits, ends = [], []
    for other, name in ((b, "a"), (a, "b")):
        gamma = mp.zeros(3, 1)
        share = (l - weights[c]) / (weights[other] - weights[c])
        gamma[other], gamma[c] = mp.sqrt(share), mp.sqrt(1 - share)
        start, path = gamma, []
        for _ in range(steps):
            u = gibbs(Jn, Dn, h * gamma, gamma)
            before, gamma = gamma, turned(u, gamma)
            path.append({"u": [rounded(x, digits) for x in u], "gamma": [rounded(x, digits) for x in gamma]})
        direction = mp.sign(before[a] * gamma[b] - before[b] * gamma[a])
        ends.append(direction * (-1) ** turns * (start[a] * gamma[b] - start[b] * gamma[a]))
        orbits.append({"start": name, "steps": path, "displacement": rounded(ends[-1], digits)})
    return {
        "format": "chapsym-certificate/1",
        "kind": "no-invariant-measure",
        "statement": f"For every ball with J = ({', '.join(J)}), D = {D} and momentum {height} γ: on the circle "
        f"⟨γ, Λ⁻¹γ⟩ = {level}, γ_{axes[2]} > 0, every number within {radius}, some points are back after {steps} steps "
        f"and {turns} half turn{'s' * (turns != 1)}, others are not, and so the map leaves no finite measure invariant "
        "that is positive on every arc.",
        "ball": {"J": list(J), "D": D, "height": height, "level": level},
        "radius": radius,
        "axes": list(axes),
        "steps": steps,
        "half_turns": turns,
        "digits": digits,
        "orbits": orbits,
    }
