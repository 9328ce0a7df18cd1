"""Energy drift: the closed orbit that is found, what its certificate states, and what is refused."""

import json
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from modified_floats import Modified
from scipy.integrate import solve_ivp

import chapsym.proofs
from chapsym import checker
from chapsym.certificates import drift
from chapsym.checker.interval import Interval
from chapsym.dynamics import BadInput

FILES = sorted((Path(chapsym.proofs.__file__).parent / "certificates").glob("energy-drift-*.json"))


def certificate(path):
    return json.loads(path.read_text(encoding="utf-8"))


def near(data):
    """What the search is given: the start of a certificate to 5 decimals."""
    J, K, g = ([Fraction(x) for x in of] for of in (data["ball"]["J"], *data["start"].values()))
    varied = drift.STATE.index(data["varied"])
    K[varied] = round(K[varied], 5)
    given = {"J": J, "D": Fraction(data["ball"]["D"]), "momentum": K, "gamma": g, "signs": data["symmetry"]}
    return given | {"time": round(Fraction(data["time"]), 5), "varied": varied}


@pytest.mark.thorough
@pytest.mark.parametrize("path", FILES, ids=lambda p: p.stem)
def test_the_orbits_of_the_committed_files_are_found_anew(path):
    data = certificate(path)
    found = drift.energy_drift(**near(data), digits=12)
    assert checker.check(found)
    i = drift.STATE.index(data["varied"])
    for x, y in ((found["time"], data["time"]), (found["start"]["momentum"][i], data["start"]["momentum"][i])):
        assert abs(Fraction(x) - Fraction(y)) <= Fraction(1, 10**12)
    for name in ("energy", "density"):
        (x, off), (y, less) = (map(Fraction, of[name]) for of in (found, data))
        assert abs(x - y) < off + less
    assert found.keys() == data.keys()
    assert all(found[name] == data[name] for name in ("ball", "varied", "symmetry", "periods", "section", "along"))


@pytest.mark.parametrize("path", FILES, ids=lambda p: p.stem)
def test_the_stated_integrals_are_those_of_another_integrator(path):
    data = certificate(path)
    start = [float(Fraction(x)) for x in (*data["start"]["momentum"], *data["start"]["gamma"])]
    rates = Modified([Fraction(x) for x in data["ball"]["J"]], Fraction(data["ball"]["D"])).rates
    end = solve_ivp(rates, (0, float(data["time"])), [*start, 0, 0], method="DOP853", rtol=1e-9, atol=1e-10).y[:, -1]
    np.testing.assert_allclose(end[:6] * np.tile(data["symmetry"], 2), start, rtol=0, atol=1e-5)
    stated = [float(data["energy"][0]), float(data["density"][0])]
    np.testing.assert_allclose(end[6:], stated, rtol=0, atol=1e-6)
    assert min(map(abs, stated)) > 1e-4


def test_there_is_a_certificate_of_a_real_ball():
    """The mass of a ball of the radius ϱ is inside: J1 + J2 + J3 ≤ D."""
    assert any(sum(map(Fraction, x["ball"]["J"])) <= Fraction(x["ball"]["D"]) for x in map(certificate, FILES))


def test_what_is_stated_contains_an_interval():
    for lo, hi, bits in ((5, 9, 10), (-(10**40), 7 - 10**40, 130), (-1, 2, 200)):
        centre, radius = map(Fraction, drift.outward(Interval(lo, hi, bits)))
        assert Interval(lo, hi, bits).within(centre, radius)
        assert radius < Fraction(hi - lo, 2**bits)


def test_a_start_from_which_no_orbit_is_found_is_refused(monkeypatch):
    given = near(certificate(FILES[0]))
    with pytest.raises(BadInput, match=r"not proved with 12 digits: .* window"):
        drift.energy_drift(**given | {"time": given["time"] + 1}, digits=12)
    monkeypatch.setattr(drift, "ROUNDS", 1)
    with pytest.raises(BadInput, match="no closed orbit was found near the start"):
        drift.energy_drift(**given, digits=12)


@pytest.mark.parametrize(
    ("change", "words"),
    [({"gamma": (Fraction(1), Fraction(1), Fraction(0))}, "unit"), ({"signs": (1, 1, -1)}, "signs"),
     ({"J": (Fraction(-1), Fraction(1), Fraction(1))}, "no ball"), ({"time": Fraction(-1)}, "time"),
     ({"D": Fraction(10**400)}, "too large or too far apart"),
     ({"momentum": (Fraction(1), Fraction(3, 2), Fraction(10**300))}, "too large or too far apart")],
)  # fmt: skip
@pytest.mark.filterwarnings("error")
def test_what_is_no_orbit_is_refused(change, words):
    with pytest.raises(BadInput, match=words):
        drift.energy_drift(**near(certificate(FILES[0])) | change)
