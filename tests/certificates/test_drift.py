"""Energy drift: the validated integration, the densities, what the certificates state, and what is refused."""

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import mpmath
import numpy as np
import pytest
from flint import arb, ctx
from modified_floats import Modified

import chapsym.proofs
from chapsym import checker
from chapsym.certificates import drift, drift_search, duals, taylor
from chapsym.certificates.taylor import NotEnclosed, exact
from chapsym.dynamics import BadInput

FILES = sorted((Path(chapsym.proofs.__file__).parent / "certificates").glob("energy-drift-*.json"))
J, D = (Fraction(1), Fraction(2), Fraction(4)), Fraction(1)
START = [Fraction(x) for x in ("1", "2", "17/5", "3/7", "6/7", "2/7")]


@pytest.fixture(autouse=True)
def precision():
    with ctx.workprec(160):
        yield


def certificate(path):
    return json.loads(path.read_text(encoding="utf-8"))


def orbit_of(data):
    """The orbit of a certificate."""
    return drift.Orbit(
        tuple(map(Fraction, data["ball"]["J"])), Fraction(data["ball"]["D"]),
        tuple(map(Fraction, data["start"]["momentum"])), tuple(map(Fraction, data["start"]["gamma"])),
        drift.NAMES.index(data["varied"]), Fraction(data["radius"]), tuple(data["symmetry"]), Fraction(data["time"]),
        Fraction(data["window"]), drift.NAMES.index(data["section"]), drift.NAMES.index(data["along"]),
    )  # fmt: skip


def test_the_densities_are_those_of_the_modified_equations():
    found = drift.flow_of(J, D, 8, Fraction(3)).densities([exact(x) for x in START])
    state = np.array(START, float)
    wanted = Modified((1, 2, 4), 1.0).densities(state[:3], state[3:])  # differences with 1e-4: about 1e-8
    np.testing.assert_allclose([float(x) for x in found], wanted, rtol=0, atol=2e-8)


def test_the_flow_is_that_of_mpmath():
    """Both to 30 digits over a time of 1."""
    flow = drift.flow_of(J, D, 56, Fraction(3))._replace(densities=lambda state: [])
    found = flow.run([exact(x) for x in START], Fraction(1))
    with mpmath.workdps(34):
        moments = [mpmath.mpf(x) for x in (6, 5, 3)]

        def rates(_, y):
            K, g = y[:3], y[3:]
            B = mpmath.diag([x + 1 for x in moments]) - mpmath.matrix(g) * mpmath.matrix(g).T
            w = mpmath.lu_solve(B, mpmath.matrix(K))
            return [*drift.cross(K, w), *drift.cross(g, w)]

        end = mpmath.odefun(
            rates, 0, [mpmath.mpf(x.numerator) / x.denominator for x in START], tol=mpmath.mpf(10) ** -31
        )(1)
        for x, y in zip(found, end, strict=True):
            assert x.rad() < 1e-25
            assert abs(mpmath.mpf(x.mid().str(34, radius=False)) - y) < mpmath.mpf(10) ** -27


def test_a_ball_of_starts_contains_the_images_of_its_points_and_has_a_largest_radius():
    flow = drift.flow_of(J, D, 32, Fraction(3))._replace(densities=lambda state: [])
    whole = flow.run([exact(x) + arb(0, 1e-9) for x in START], Fraction(1, 2))
    for sign in (-1, 1):
        point = flow.run(
            [exact(x) + sign * exact(Fraction(1, 10**9)) * (k % 2) for k, x in enumerate(START)], Fraction(1, 2)
        )
        assert all(x.contains(y) for x, y in zip(whole, point, strict=True))
        assert any(abs(x.mid() - y.mid()) > 1e-10 for x, y in zip(whole, point, strict=True))
    with pytest.raises(NotEnclosed, match="too wide"):
        flow.run([exact(x) + arb(0, 1e-3) for x in START], Fraction(1, 2))


def test_duals_differentiate():
    def rational(x):
        return (1 - x[0] * x[1] / (2 + x[1])) / x[0] - x[1]

    a, b = Fraction(3, 2), Fraction(2, 5)
    wanted = -1 / a**2 * 5 + (-1 * (2 / (2 + b) ** 2) - 1) * 7  # (1/a - b/(2 + b) - b)
    assert duals.derivative(rational, [a, b], [5, 7]) == wanted


def test_there_is_a_certificate_of_a_real_ball():
    """The mass of a ball of the radius ϱ is inside: J1 + J2 + J3 ≤ D."""
    assert any(sum(map(Fraction, x["ball"]["J"])) <= Fraction(x["ball"]["D"]) for x in map(certificate, FILES))


def test_a_start_that_does_not_close_is_not_proved():
    """The starts moved by 10 radii: the two ends miss on the same side."""
    orbit = orbit_of(certificate(FILES[0]))
    varied = tuple(x + 10 * orbit.radius * (i == orbit.varied) for i, x in enumerate(orbit.momentum))
    with pytest.raises(NotEnclosed, match="between the two ends"):
        drift.enclose(replace(orbit, momentum=varied), 128, 36)


@pytest.mark.parametrize("path", FILES, ids=lambda p: p.stem)
def test_a_file_is_written_as_the_checker_reads_it(path):
    """The committed files, written anew from their orbit and their enclosures."""
    data, orbit = certificate(path), orbit_of(certificate(path))
    balls = [
        exact(Fraction(c)) + arb(0, exact(Fraction(r)) / 2)
        for c, r in (*data["misses"], data["energy"], data["density"])
    ]
    written = drift_search.document(
        orbit, drift.Enclosures((balls[0], balls[1]), *balls[2:]), data["bits"], data["order"]
    )
    checker.KINDS["energy-drift"].check_form(written)
    assert written["statement"] == checker.statement(written)
    assert written["digest"] == checker.digest(written)
    enclosures = ("misses", "energy", "density", "digest")
    assert {k: v for k, v in written.items() if k not in enclosures} == {
        k: v for k, v in data.items() if k not in enclosures
    }


def test_more_digits_are_sought_with_more_bits_and_more_terms(monkeypatch):
    """20 digits by default: 256 bits and 64 terms, for the orbit that the search refines and for what it encloses."""
    seen, found = [], orbit_of(certificate(FILES[0]))

    def enclose(orbit, bits, order):
        seen.append((orbit, bits, order))
        raise NotEnclosed("the balls are too wide")

    monkeypatch.setattr(drift_search, "refined", lambda near, digits, order, progress: found)
    monkeypatch.setattr(drift_search, "enclose", enclose)
    start = (found.J, found.D, found.momentum, found.gamma, found.signs, found.time, found.varied)
    for digits in (20, 30):
        with pytest.raises(BadInput, match=f"not proved with {digits} digits: the balls are too wide"):
            drift_search.energy_drift(*start, digits=digits)
    assert seen == [(found, 256, 64), (found, 336, 84)]


@pytest.mark.parametrize(
    ("change", "words"),
    [({"gamma": (Fraction(1), Fraction(1), Fraction(0))}, "unit"), ({"signs": (1, 1, -1)}, "signs"),
     ({"J": (Fraction(-1), Fraction(1), Fraction(1))}, "no ball")],
)  # fmt: skip
def test_what_is_no_orbit_is_refused(change, words):
    orbit = orbit_of(certificate(FILES[0]))
    with pytest.raises(BadInput, match=words):
        replace(orbit, **change)


def test_a_rest_of_the_series_that_is_left_out_is_seen(monkeypatch):
    """With the bound of the defect taken away the ball of a coarse series misses the point of a fine one."""
    start = [exact(x) for x in START]
    fine = drift.flow_of(J, D, 48, Fraction(3))._replace(densities=lambda state: [])
    coarse, end = fine._replace(order=16), Fraction(1, 4)
    truth = fine.run(start, end)
    assert all(x.overlaps(y) for x, y in zip(coarse.run(start, end), truth, strict=True))
    monkeypatch.setattr(taylor.Flow, "_defect", lambda self, *rest: arb(0))
    assert not all(x.overlaps(y) for x, y in zip(coarse.run(start, end), truth, strict=True))
