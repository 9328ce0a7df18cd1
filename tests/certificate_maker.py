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


#: A point that is back after 20 steps of the ball J = (1, 2, 4), D = 2 with |𝒦|² = 2.76²; no symmetry maps its orbit to
#: itself, so the determinant is not 1, if only by 3e-9.
RETURNING = [
    "0.487701236775191316458181119115327888196519128972657305941676387084414779685",
    "1.14547748716642554010619119367858253318223649874349520119205547823255795737",
    "2.46325573784835426476843249759081829462997858163531866939547599686672877927",
    "-0.443442835158003605940291181892453666967980990777690199628312840276357218409",
    "-0.0828293727576932878942842684005334842165024992174458152789207674193335350927",
    "-0.892467224583401011113216153634298381455522351849938124208086084000572677938",
]
RETURNING_HEIGHT = "-2.509521812712367691238991516060"


def periodic(digits=40):
    """A certificate of kind periodic-orbit; the derivative by central differences of h = 1e-30, good to h² = 1e-60."""
    with mp.workdps(110):
        return sealed(_periodic(digits))


def _periodic(digits):
    ball, x, h = ([mp.mpf(1), mp.mpf(2), mp.mpf(4)], mp.mpf(2)), mp.matrix(RETURNING), mp.mpf(10) ** -30

    def after(x):
        state, path = travelled(*ball, (x[:3, 0], x[3:, 0]), 20)
        return mp.matrix([*state[0], *state[1]]), path

    columns = []
    for e in (mp.matrix([int(i == j) for j in range(3)]) for i in range(3)):
        v = mp.matrix([*cross(e, x[:3, 0]), *cross(e, x[3:, 0])])
        columns.append((v, (after(x + h * v)[0] - after(x - h * v)[0]) / (2 * h)))
    V, DV = (mp.matrix([list(c) for c in column]).T for column in zip(*columns, strict=True))
    W = mp.inverse(V.T * V) * (V.T * DV)
    return {
        "format": "chapsym-certificate/1",
        "kind": "periodic-orbit",
        "statement": f"For the ball with J = (1, 2, 4), D = 2: with ⟨𝒦, 𝒦⟩ = 7.6176, ⟨𝒦, γ⟩ = {RETURNING_HEIGHT} a "
        "point is back after 20 steps, and the derivative of these steps on the level of the integrals there has a "
        "determinant other than 1 and no eigenvalue 1.",
        "ball": {"J": ["1", "2", "4"], "D": "2"},
        "integrals": {"momentum.momentum": "7.6176", "momentum.gamma": RETURNING_HEIGHT},
        "steps": 20,
        "digits": digits,
        "start": {"momentum": [rounded(a, digits) for a in x[:3]], "gamma": [rounded(a, digits) for a in x[3:]]},
        "orbit": [{"u": [rounded(a, digits) for a in u]} for u in after(x)[1]],
        "determinant": rounded(mp.det(W), digits),
        "unit_eigenvalue": rounded(mp.det(mp.eye(3) - W), digits),
    }
