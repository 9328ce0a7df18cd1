"""The open question of Section 5: the formulas of its lemmas against the map in mpmath, and what settles it."""

import json

import mpmath as mp
import pytest
from certificate_maker import gibbs, turned

from chapsym import checker
from chapsym.proofs.open import certified, measure
from chapsym.prove import Fact, Verdict, load
from chapsym.prove.records import fingerprint
from chapsym.prove.runner import judge

DIGITS = 110


class Circle:
    """A level of the ball with this Λ as in (5.7), (5.8), (5.14) as corrected, typed in once more, and G_h on it."""

    def __init__(self, inertia, level):
        L1, L2, L3 = self.inertia = [mp.mpf(x) for x in inertia]
        l = self.level = mp.mpf(level)
        self.k2 = (L1 - L2) * (1 - L3 * l) / ((L2 - L3) * (L1 * l - 1))
        squares = L1 * (1 - L3 * l) / (L1 - L3), L2 * (1 - L3 * l) / (L2 - L3), L3 * (L1 * l - 1) / (L1 - L3)
        first, second, third = map(mp.sqrt, squares)
        self.amplitudes = first, -second, third  # of negative product, so that u grows, with h > 0 and V > 0
        self.V = mp.sqrt((L2 - L3) * (L1 * l - 1) / (L1 * L2 * L3))
        self.alpha = (2 * L1 * L3 * l - (L1 + L3 - L2)) / ((L2 - L3) * (L1 * l - 1))
        self.beta = L1 * L3 / (L2 - L3) ** 2 * (1 - L3 * l) / (L1 * l - 1)
        self.mu = (1 - L3 * l) / (L2 - L3)
        self.K, self.other = mp.ellipk(self.k2), mp.ellipk(1 - self.k2)

    def jacobi(self, u):
        return [mp.ellipfun(name, u, m=self.k2) for name in ("sn", "cn", "dn")]

    def zeta(self, u):
        angle = self.angle(self.gamma(u)) + 2 * mp.pi * mp.nint(u / self.K / 4)
        return mp.ellipe(angle, self.k2) - mp.ellipe(self.k2) / self.K * u

    def M(self, a, h):
        s, c, d = self.jacobi(a)
        y = s**2
        return (2 * s * c * d - h * self.V * (1 + self.alpha * y - self.beta * y**2)) / (y * (self.level - self.mu * y))

    def height(self, a):
        """The h for which a is half the increment at D = 0."""
        s, c, d = self.jacobi(a)
        return 2 * s * c * d / (self.V * (1 + self.alpha * s**2 - self.beta * s**4))

    def second(self, a, h):
        """A''(0)."""
        return -mp.diff(lambda x: self.M(x, h), a, 2) / mp.diff(lambda x: self.M(x, h), a) ** 3

    def gamma(self, u):
        s, c, d = self.jacobi(u)
        return mp.matrix([self.amplitudes[0] * c, self.amplitudes[1] * s, self.amplitudes[2] * d])

    def angle(self, gamma):
        return mp.atan2(gamma[1] / self.amplitudes[1], gamma[0] / self.amplitudes[0])

    def step(self, gamma, D, h):
        """γ~, from the vector equation (5.2) in the Gibbs vector, by Newton's method from 0."""
        moments = [x - D for x in self.inertia]
        J = [sum(moments) / 2 - x for x in moments]
        return turned(gibbs(J, D, h * gamma, gamma), gamma)

    def displaced(self, u, D, h, steps):
        """(u after so many steps) - u, by the turns of each step."""
        gamma = self.gamma(u)
        start = angle = self.angle(gamma)
        for _ in range(steps):
            gamma = self.step(gamma, D, h)
            turn = self.angle(gamma) - angle
            angle += turn - 2 * mp.pi * mp.nint(turn / (2 * mp.pi))
        return mp.ellipf(angle, self.k2) - mp.ellipf(start, self.k2)

    def gap(self, q):
        """f(0) - f(K/q), f = Σ dn²(u + 2Kj/q), by its Fourier series."""
        eta = mp.pi * self.other / self.K
        return 2 * q * (mp.pi / self.K) ** 2 * sum(m * q / mp.sinh(m * q * eta) for m in range(1, 60, 2))


def root(f, x0, x1):
    """A zero by the secant method, to the last digits."""
    return mp.findroot(f, (x0, x1), solver="secant", tol=mp.mpf(10) ** (15 - DIGITS), maxsteps=60, verify=False)


@pytest.fixture(autouse=True)
def digits():
    with mp.workdps(DIGITS):
        yield


@pytest.mark.parametrize("u", ["0.3", "1.7", "-2.9"])
def test_the_chord_form_is_the_map_for_a_large_D(u):
    circle, D, h, u = Circle((9, 8, 6), mp.mpf(7) / 50), mp.mpf(3), mp.mpf(2), mp.mpf(u)
    moved = circle.displaced(u, D, h, 1)
    a = moved / 2
    s, c, d = circle.jacobi(a)
    right = D * (2 * circle.zeta(a) + 2 * c * d / s - circle.zeta(u + moved) + circle.zeta(u))
    assert abs(circle.M(a, h) - right) < mp.mpf(10) ** (10 - DIGITS)
    assert abs(right) > 1e-3


@pytest.mark.parametrize(("q", "p"), [(5, 1), (6, 1), (9, 2)])
def test_at_a_resonance_the_displacement_is_of_the_second_order_as_the_lemma_says(q, p):
    circle = Circle((6, 5, 3), mp.mpf(1) / 4)
    a = circle.K * p / q
    h = circle.height(a)
    expected = 2 * circle.second(a, h) * circle.gap(q)
    assert expected > 0, "least at γ_b = 0"

    def missed(D):
        at = root(lambda h: circle.displaced(0, D, h, q) - 2 * circle.K * p, h, h * (1 + D))
        return (circle.displaced(circle.K / q, D, at, q) - 2 * circle.K * p) / (expected * D**2) - 1

    off = [missed(D) for D in (mp.mpf("1e-4"), mp.mpf("1e-7"))]
    # What is left is of the third order: the ratio is 1 - (some tens) D, and that number does not depend on D.
    assert abs(off[0]) < 1e-2
    assert abs(off[1] / off[0] / mp.mpf("1e-3") - 1) < 1e-2


def test_the_sum_over_the_orbit_is_the_fourier_series():
    circle, q = Circle((6, 5, 3), mp.mpf(1) / 4), 5
    points = [sum(circle.jacobi(start + 2 * circle.K * j / q)[2] ** 2 for j in range(q)) for start in (0, circle.K / q)]
    assert abs(points[0] - points[1] - circle.gap(q)) < mp.mpf(10) ** (12 - DIGITS)


def test_the_plateau_is_as_wide_as_the_lemma_says():
    q, p, D, l = 5, 1, mp.mpf("1e-5"), mp.mpf(1) / 4
    circle = Circle((6, 5, 3), l)
    a = circle.K * p / q
    h = circle.height(a)

    def end(start):
        def displaced(level):
            near = Circle((6, 5, 3), level)
            return near.displaced(start * near.K / q, D, h, q) - 2 * near.K * p

        return root(displaced, l, l + D)

    def rotation(level):
        near = Circle((6, 5, 3), level)
        return mp.findroot(lambda x: near.M(x, h), a) / near.K

    with mp.workdps(40):
        slope = mp.diff(rotation, l, h=mp.mpf("1e-12"))
    width = circle.second(a, h) * D**2 * circle.gap(q) / (q * circle.K * abs(slope))
    assert abs(abs(end(1) - end(0)) / width - 1) < 100 * D


def test_for_small_heights_the_second_derivative_is_what_the_lemma_says():
    circle, h = Circle((6, 5, 3), mp.mpf(1) / 4), mp.mpf("1e-6")
    a = root(lambda x: circle.M(x, h), h * circle.V / 2, h * circle.V / 2 * (1 + h))
    assert abs(circle.second(a, h) / (h**3 * circle.level**2 * circle.V**3 / 8) - 1) < 1e-9


@pytest.mark.parametrize("D", ["0.5", "2.5"])
def test_for_small_heights_the_increment_is_that_of_the_flow_of_almost_every(D):
    circle, D, h = Circle((6, 5, 3), mp.mpf(1) / 4), mp.mpf(D), mp.mpf("1e-9")
    rate = h * circle.V / (1 - D * circle.level)
    assert all(abs(circle.displaced(mp.mpf(u), D, h, 1) / rate - 1) < 1e-15 for u in (0, 1, 2.5))


@pytest.mark.parametrize("start", [0, 1])
def test_without_rolling_the_displacement_vanishes_to_every_digit(start):
    circle, q, p = Circle((6, 5, 3), mp.mpf(1) / 4), 5, 1
    h = circle.height(circle.K * p / q)
    assert abs(circle.displaced(start * circle.K / q, mp.mpf(0), h, q) - 2 * circle.K * p) < mp.mpf(10) ** (8 - DIGITS)


def test_the_question_is_settled_by_lemmas_and_certificates(records):
    record = records["5.9-open"]
    evidence = record["evidence"]
    assert record["verdict"] == "settled", evidence["problems"]
    assert evidence["answer"].startswith("No, in general")
    assert evidence["measured"]
    assert evidence["conjectures"]
    assert evidence["certificates"]
    assert {seen["file"] for seen in evidence["certificates"]} == {file.name for file in measure.FILES}
    assert all(seen["accepted"] and len(seen["digest"]) == 64 for seen in evidence["certificates"])
    assert {f"{id} is proved" for id in measure.LEMMAS} <= {check["statement"] for check in evidence["checks"]}
    assert not evidence["tried"]


def test_without_certificates_or_with_a_rejected_one_it_is_open(tmp_path, monkeypatch):
    claim = load()["5.9-open"]
    monkeypatch.setattr(measure, "LEMMAS", {})
    monkeypatch.setattr(measure, "FILES", ())
    assert judge(claim).verdict is Verdict.OPEN
    file = certified.files(measure.KIND)[0]
    data = json.loads(file.read_text(encoding="utf-8"))
    data["half_turns"] += 1
    (tmp_path / file.name).write_text(json.dumps(data), encoding="utf-8")
    for path in (tmp_path / file.name, tmp_path / "missing.json"):
        monkeypatch.setattr(measure, "FILES", (path,))
        judgement = judge(claim)
        assert judgement.verdict is Verdict.OPEN
        assert judgement.proof.problems == [f"the checker does not accept {path.name}"]


def test_a_changed_certificate_is_sealed_so_that_arithmetic_judges_it():
    """A smaller box is proved as well as the box: it is accepted, and so no seal is what rejects the others."""
    data = checker.read(measure.FILES[0])
    assert certified.changed("a smaller box", data, ("radius",), "1e-300").holds()
    assert not certified.changed("one half turn more", data, ("half_turns",), data["half_turns"] + 1).holds()
    with pytest.raises(ValueError, match="nothing is changed"):
        certified.changed("the same", data, ("radius",), data["radius"])


def test_a_lemma_that_fails_leaves_it_open(monkeypatch):
    monkeypatch.setattr(measure, "FILES", measure.FILES[:1])
    monkeypatch.setattr(measure, "judged", lambda id: Fact(f"{id} is proved", id != "resonance"))
    judgement = judge(load()["5.9-open"])
    assert judgement.verdict is Verdict.OPEN
    assert judgement.proof.problems == ["lemma fails: resonance is proved"]


def test_the_record_depends_on_the_certificates(tmp_path):
    claim = load()["5.9-open"]
    assert claim.files == measure.FILES
    copy = tmp_path / claim.files[0].name
    copy.write_bytes(claim.files[0].read_bytes() + b"\n")
    changed = type(claim)(claim.id, claim.printed, claim.uses, claim.prove, (copy, *claim.files[1:]))
    gone = type(claim)(claim.id, claim.printed, claim.uses, claim.prove, (tmp_path / "gone", *claim.files[1:]))
    assert len({fingerprint(c) for c in (claim, changed, gone)}) == 3
