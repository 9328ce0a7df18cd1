"""The modified equations: their lemmas, what a wrong term in them does, and the map itself at high precision."""

from itertools import pairwise

import mpmath
import pytest
import sympy as sp

from chapsym.derive import modified
from chapsym.derive.three import D
from chapsym.prove import load
from chapsym.prove.runner import judge

LEMMAS = ["modified-field", "modified-energy", "energy-without-rolling", "modified-measure", "map-symmetries"]


@pytest.mark.parametrize("id", LEMMAS)
def test_the_lemma_holds_with_its_evidence(lemmas, id):
    record = lemmas[id]
    evidence = record["evidence"]
    assert record["verdict"] == "holds", evidence["problems"]
    assert evidence["witnesses"]
    assert len(evidence["controls"]) >= 2
    assert all(control["rejected"] for control in evidence["controls"])


def verdict(id):
    return judge(load(lemmas=True)[id]).verdict.value


def test_a_wrong_load_is_seen(monkeypatch):
    right = modified.load()
    monkeypatch.setattr(modified, "load", lambda: right.subs(D, D / 2))
    assert verdict("modified-field") != "holds"


def test_a_wrong_correction_is_seen(monkeypatch):
    right = modified.correction()
    monkeypatch.setattr(modified, "correction", lambda: right + modified.omega)
    assert verdict("modified-field") != "holds"


def test_a_wrong_factor_of_the_energy_is_seen(monkeypatch):
    right = modified.energy_rate()
    monkeypatch.setattr(modified, "energy_rate", lambda: right * sp.Rational(4, 3))
    assert verdict("modified-energy") != "holds"


MP = mpmath.MPContext()
MP.dps = 50
INERTIA, CONTACT = MP.matrix([6, 5, 3]), MP.mpf(3)


def cross(a, b):
    return MP.matrix([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def matrix(g):
    return MP.diag([x + CONTACT for x in INERTIA]) - CONTACT * g * g.T


def weighted(x):
    return MP.matrix([a * b for a, b in zip(INERTIA, x, strict=True)])


def step(K, g, size):
    """The map on (K, γ), 𝒦 = εK, by Newton's method on the Gibbs vector."""
    B, k, u = matrix(g), size * K / 2, size * MP.lu_solve(matrix(g), K) / 2
    for _ in range(8):
        residual = B * u + cross(u, weighted(u)) - (1 + dot(u, u)) * k
        columns = [
            cross(e, weighted(u)) + cross(u, weighted(e)) - 2 * dot(u, e) * k
            for e in map(MP.matrix, MP.eye(3).tolist())
        ]
        u -= MP.lu_solve(B + MP.matrix([[c[i] for c in columns] for i in range(3)]), residual)
    return [x + 2 * (cross(u, cross(u, x)) - cross(u, x)) / (1 + dot(u, u)) for x in (K, g)]


def angular(K, g, size):
    """ω + ε²ω₃, from its terms."""
    solve = lambda x: MP.lu_solve(matrix(g), x)  # noqa: E731
    w = solve(K)
    a, moving = solve(cross(weighted(w), w)), cross(g, w)
    load = cross(w, weighted(a)) + cross(a, weighted(w)) + 2 * CONTACT * (dot(g, a) * moving + dot(moving, a) * g)
    return w + size**2 * (2 * dot(w, w) * w - cross(w, a) - solve(load)) / 12


def flow(K, g, size):
    """The modified field over the time ε: Runge and Kutta's steps of the order 4, 32 of them, extrapolated twice."""

    def run(count):
        k, v, h = K.copy(), g.copy(), size / count
        for _ in range(count):
            rates = []
            for part in (0, h / 2, h / 2, h):
                x, y = (k + part * rates[-1][0], v + part * rates[-1][1]) if rates else (k, v)
                w = angular(x, y, size)
                rates.append((cross(x, w), cross(y, w)))
            weights = (1, 2, 2, 1)
            k += h / 6 * sum((c * r[0] for c, r in zip(weights, rates, strict=True)), MP.zeros(3, 1))
            v += h / 6 * sum((c * r[1] for c, r in zip(weights, rates, strict=True)), MP.zeros(3, 1))
        return MP.matrix([*k, *v])

    coarse, middle, fine = run(4), run(8), run(16)
    return ((32 * (16 * fine - middle) / 15) - (16 * middle - coarse) / 15) / 31


def test_the_defect_of_the_step_is_of_order_5():
    """One step against the flow of the modified field: ε⁵, as there is no term in ε³ of Ω̃ (self-adjoint)."""
    K, g = MP.matrix([1, 2, MP.mpf(17) / 5]), MP.matrix([3, 6, 2]) / 7
    defects = []
    for power in (7, 8, 9):
        size = MP.mpf(2) ** -power
        defects.append(MP.norm(MP.matrix([x for v in step(K, g, size) for x in v]) - flow(K, g, size)))
    slopes = [float(MP.log(a / b, 2)) for a, b in pairwise(defects)]
    assert slopes == pytest.approx([5, 5], abs=0.02)
