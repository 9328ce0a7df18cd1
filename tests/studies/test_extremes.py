"""The extremes: each verdict is the one that is pinned, and what is wrong turns cells red."""

import json
import warnings
from dataclasses import replace
from pathlib import Path

import flint
import mpmath
import numpy as np
import pytest
from commands import chapsym, refused

from chapsym.dynamics import BadInput, Status, StepNotTaken, kernels
from chapsym.dynamics.oracle import Oracle, OracleFailed
from chapsym.studies import check
from chapsym.studies import extremes as study
from chapsym.studies.extremes import arrays, cells, derived, elliptic, matrix, n_dim, reduced, states, steps
from chapsym.studies.extremes.folds import fold_at
from chapsym.studies.extremes.levels import LEVELS, NAMES, level, mp, number
from chapsym.studies.extremes.truth import State, truth

PINS = json.loads((Path(__file__).parent / "extremes.json").read_text(encoding="utf-8"))
#: How verdicts are pinned, a letter for each precision.
LETTERS = {"within": "w", "refused": "r", "failed": "f"}
#: Of these one row in three, but for thorough runs; the rows of each group, by their numbers.
SLOW = {"runs", "fold search", "elliptic", "inertia", "fold", "order", "extrapolate", "rotation"}
NUMBERS = {group: [i for i, c in enumerate(matrix.CONDITIONS) if c.group == group] for group in matrix.GROUPS}
TOGETHER = [group for group in matrix.GROUPS if group not in matrix.SHARED]
GENERIC = State(states.J, states.D, states.K, states.G)
DOUBLE, HEAVIEST = level("double"), "D = 1e15, momentum horizontal"


def verdicts(found):
    """One letter for each precision, a dot where there is no cell."""
    by_precision = {cell.rung: LETTERS[cell.verdict] for cell in found}
    return "".join(by_precision.get(name, ".") for name in NAMES)


def test_every_row_is_pinned():
    rows = {group: [c.name for c in matrix.CONDITIONS if c.group == group] for group in matrix.GROUPS}
    assert {group: list(named) for group, named in PINS.items()} == rows
    assert len({(c.group, c.name) for c in matrix.CONDITIONS}) == len(matrix.CONDITIONS)


@pytest.mark.parametrize("groups", [*([group] for group in TOGETHER), [*matrix.SHARED]], ids="+".join)
def test_the_verdicts_are_those_that_are_pinned(groups, thorough):
    wrong, slow = [], not SLOW.isdisjoint(groups)
    for index, condition in enumerate(matrix.CONDITIONS):
        if condition.group in groups and (thorough or not slow or NUMBERS[condition.group].index(index) % 3 == 0):
            found = matrix.row(index, NAMES, quick=not thorough)
            if verdicts(found) != PINS[condition.group][condition.name]:
                wrong += [(condition.group, condition.name, verdicts(found), [c.reason for c in found])]
            for cell in found:
                assert cell.verdict == "within" or len(cell.reason.split()) >= 4, cell
    assert wrong == []


def judged(function):
    """The cell of a condition that is judged so."""
    return cells.cell(cells.Condition("name", "group", lambda level, quick: function(), NAMES), DOUBLE, True)


@pytest.mark.parametrize("part", [0, 1, 2])
def test_a_step_that_is_a_little_wrong_fails(monkeypatch, part):
    honest = steps.taken
    assert steps.judge(DOUBLE, GENERIC).verdict == "within"

    def wrong(level, state):
        found = list(honest(level, state))
        found[part] = [x + 1e-13 for x in found[part]]
        return found

    monkeypatch.setattr(steps, "taken", wrong)
    assert steps.judge(DOUBLE, GENERIC).verdict == "failed"


def test_a_ball_that_excludes_the_truth_fails_though_it_is_near(monkeypatch):
    honest, precision = steps.taken, level("Ball(200)")
    assert steps.judge(precision, GENERIC).verdict == "within"

    def wrong(level, state):
        q, momentum, gamma = honest(level, state)
        with precision.precision.working():
            return q, [x + flint.arb(2) ** -190 for x in momentum], gamma

    monkeypatch.setattr(steps, "taken", wrong)
    found = steps.judge(precision, GENERIC)
    assert found.verdict == "failed"
    assert "excludes the truth" in found.reason


@pytest.mark.parametrize(
    ("status", "reach", "state", "verdict"),
    [
        *((status, 0.5, lambda: GENERIC, "failed") for status in (Status.FOLDED, Status.UNREACHABLE)),
        *((status, 0.5, lambda: GENERIC, "failed") for status in (Status.NO_INERTIA, Status.NOT_CONVERGED)),
        (Status.NOT_CONVERGED, 1.0, lambda: states.CONDITIONS["D"][HEAVIEST](DOUBLE)[0], "refused"),
        (Status.UNREACHABLE, 0.5, lambda: states.beside_fold(-1e-8), "failed"),
    ],
)
def test_a_refusal_that_is_not_true_fails(monkeypatch, status, reach, state, verdict):
    """What float64 cannot resolve may be refused; a momentum that other rotations have is not out of reach."""

    def refuses(level, state):
        raise StepNotTaken(status, reach)

    monkeypatch.setattr(steps, "taken", refuses)
    assert steps.judge(DOUBLE, state()).verdict == verdict


def test_a_rotation_beyond_the_fold_fails(monkeypatch):
    before, beyond = states.beside_fold(1e-8), states.beside_fold(-1e-8)
    assert steps.judge(DOUBLE, beyond).verdict == "refused"
    found = steps.taken(DOUBLE, before)
    monkeypatch.setattr(steps, "taken", lambda level, state: found)
    assert steps.judge(DOUBLE, before).verdict == "within"
    assert steps.judge(DOUBLE, beyond).verdict == "failed"


def test_a_refusal_without_a_sentence_an_error_a_warning_and_a_nan_fail():
    assert judged(lambda: steps.refused("no", None)).verdict == "failed"
    assert judged(lambda: 1 / 0).reason == "ZeroDivisionError: division by zero"

    def warns():
        warnings.warn("overflow", stacklevel=1)
        return cells.Judged("within")

    assert judged(warns).reason == "it warns: overflow"
    exact = [mp.mpf(1), mp.mpf(2)]
    nothing = cells.compared(DOUBLE, [cells.Compared("x", [1.0, float("nan")], exact, 4)])
    assert "not finite" in nothing.reason
    assert judged(lambda: nothing).verdict == "failed"


def test_the_worst_counts():
    good, near, bad = cells.Judged("within", 1, 4), cells.Judged("within", 3, 4), cells.Judged("refused")
    assert cells.worst([good, near]) is near
    assert cells.worst([near, bad, good]) is bad


def test_ulps_are_those_of_the_precision_and_a_promise_of_no_digit_is_none():
    one = [mp.mpf(1)]
    for precision, step in zip(LEVELS[:3], (2.0**-23, 2.0**-52, 2.0**-104), strict=True):
        found = cells.compared(precision, [cells.Compared("x", [one[0] + 3 * mp.mpf(step)], one, 4)])
        assert found.ulps == 3
        assert found.verdict == "within"
    tiny = cells.compared(DOUBLE, [cells.Compared("x", [1e-320], [mp.mpf(float("1e-320")) * 1.0001], 4)])
    assert tiny.ulps < 1  # below the normal numbers an ulp is the least number
    for x, verdict in ((1.5, "failed"), (1.05, "within")):
        assert cells.compared(DOUBLE, [cells.Compared("x", [x], [mp.mpf(1)], 1e20)]).verdict == verdict


def test_kappa_is_that_of_check():
    state = check.State(np.array(states.J), states.D, np.array(states.K), np.array(states.G))
    assert truth(GENERIC).condition == pytest.approx(check.compare(state).condition, rel=1e-9)


def test_the_fold_is_where_the_oracle_stops():
    at = fold_at(states.J, states.D, states.DYADIC, states.AXIS)
    oracle = Oracle(states.J, states.D, states.AXIS, 40)
    near = oracle.step([x * at * (1 - mpmath.mpf(10) ** -12) for x in states.DYADIC])
    assert 0.685 < near.q0 < 0.686
    with pytest.raises(OracleFailed):
        oracle.step([x * at * (1 + mpmath.mpf(10) ** -9) for x in states.DYADIC])


@pytest.mark.parametrize("side", [-1, 1])
def test_next_to_the_fold_is_one_number_away(side):
    at = number(0.0) + fold_at(states.J, states.D, states.DYADIC, states.AXIS)
    for precision, spacing in (("single", 2.0**-21), ("double", 2.0**-50)):  # the fold is at 6.88
        gap = (number(states.next_to_fold(level(precision), side).K[0]) - at) * side
        assert 0 < gap <= spacing


def test_the_oracle_in_four_dimensions_solves_its_equation():
    E, after, gamma, _ = n_dim.truth(n_dim.K, n_dim.G, n_dim.J, n_dim.D)
    R, J = mp.eye(4) + mp.matrix([E[4 * i : 4 * i + 4] for i in range(4)]), mp.diag([*n_dim.J])
    Gamma = mp.matrix(n_dim.G) * mp.matrix(n_dim.G).T
    K = mp.matrix(Oracle(n_dim.J, n_dim.D, n_dim.G).skew(n_dim.K).tolist())
    found = R * J - J * R.T + n_dim.D / 2 * (R * Gamma - Gamma * R.T + Gamma * R - R.T * Gamma)
    assert mp.norm(found - K) < mp.mpf(10) ** -38
    assert mp.norm(R.T * R - mp.eye(4)) < mp.mpf(10) ** -38
    assert mp.norm(mp.matrix(after) - mp.matrix(list(R.T * K * R))) < mp.mpf(10) ** -38
    assert abs(mp.norm(gamma) - 1) < 1e-15


def unstable_velocity(K, g, J, D):
    """ω by Λ⁻¹K + (D⟨γ,Λ⁻¹K⟩/(1 - D⟨γ,Λ⁻¹γ⟩)) Λ⁻¹γ, as printed: 1 - D⟨γ,Λ⁻¹γ⟩ cancels for D ≫ J."""
    K, g, J = map(np.asarray, (K, g, J))
    moments = J.sum() - J + D
    return K / moments + D * (g @ (K / moments)) / (1 - D * (g @ (g / moments))) * g / moments


def test_the_printed_form_of_the_velocity_fails_where_it_cancels(monkeypatch):
    monkeypatch.setattr(kernels, "angular_velocity", unstable_velocity)
    assert derived.of("ω", "D = 3", DOUBLE, True).verdict == "within"
    for condition in ("D = 1e6", "D = 1e12"):
        assert derived.of("ω", condition, DOUBLE, True).verdict == "failed"


def test_a_step_by_the_printed_form_fails_where_it_cancels(monkeypatch):
    """𝒦(q, γ) with (Λ - Dγγᵀ)q, whose vertical part is the rest of two numbers as large as D."""
    honest = steps.taken

    def printed(level, state):
        q, momentum, gamma = honest(level, state)
        q, g = np.array(q), np.array(state.g)
        moments = np.array(state.J).sum() - np.array(state.J) + state.D
        back = 2 * (np.sqrt(1 - q @ q) * (moments * q - state.D * (g @ q) * g) + np.cross(q, moments * q))
        return q * (np.array(state.K) @ g) / (back @ g), momentum, gamma  # the scale of q from the vertical part

    monkeypatch.setattr(steps, "taken", printed)
    heavy = states.CONDITIONS["D"]["D = 1e12"](DOUBLE)[0]
    assert steps.judge(DOUBLE, heavy).verdict == "failed"


def test_an_amplitude_by_a_difference_that_cancels_fails(monkeypatch):
    state = elliptic.CONDITIONS["l at its upper end, 1e-8"][0]
    assert elliptic.the_curve(DOUBLE, state).verdict == "within"
    honest = elliptic.Curve.through

    def naive(ball, gamma):
        curve = honest(ball, gamma)
        middle, least = curve.inertia[1:]
        amplitude = np.sqrt(middle * abs(1 - least * curve.level) / abs(middle - least))
        object.__setattr__(curve, "amplitudes", (curve.amplitudes[0], float(amplitude), curve.amplitudes[2]))
        return curve

    monkeypatch.setattr(elliptic.Curve, "through", naive)
    assert elliptic.the_curve(DOUBLE, state).verdict == "failed"


def test_a_fold_that_is_a_little_off_fails(monkeypatch):
    honest = reduced.fold
    monkeypatch.setattr(reduced, "fold", lambda *given: replace((f := honest(*given)), reach=f.reach * (1 + 1e-13)))
    assert reduced.fold_search("generic", DOUBLE, True).verdict == "failed"


def test_a_refused_input_that_is_taken_fails():
    assert arrays.refusals([lambda level: None], DOUBLE, True).verdict == "failed"

    def refuses(level):
        raise BadInput("momentum must be finite, but it is nan")

    assert arrays.refusals([refuses], DOUBLE, True).verdict == "refused"
    assert arrays.refusals([refuses, lambda level: None], DOUBLE, True).verdict == "failed"


def test_other_bits_and_a_changed_array_fail():
    assert arrays.same(lambda x: x * (1 + 2.0**-51), DOUBLE, True).verdict == "failed"
    assert arrays.same(lambda x: x.copy(), DOUBLE, True).verdict == "within"


def test_json_says_what_the_cells_say():
    found = matrix.row(0, NAMES, quick=True)
    written = matrix.as_json(found, True)
    assert written["rungs"] == list(NAMES)
    assert written["counts"] == {"within": len(NAMES), "refused": 0, "failed": 0}
    first = written["cells"][0]
    assert set(first) >= {"condition", "rung", "verdict", "ulps", "digits", "condition_number", "reason"}
    json.dumps(written, allow_nan=False)


def test_a_group_as_json_and_as_a_page(tmp_path):
    page = tmp_path / "page.html"
    done = chapsym("extremes", "--quick", "vertical", "derived", "-o", str(page), "--json")
    found = json.loads(done.stdout)
    assert [*found["groups"]] == ["derived", "vertical"]
    assert {cell["rung"] for cell in found["cells"]} == {"double"}
    assert sum(found["counts"].values()) == len(found["cells"])
    assert done.returncode == (1 if found["counts"]["failed"] else 0)
    text = page.read_text(encoding="utf-8")
    assert text.count("data-verdict=") == len(found["cells"])


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [(["nonsense"], "there is no group 'nonsense'"), (["-o", "page.txt"], "must end in .html"),
     (["-o", "/nowhere/page.html"], "does not exist")],
)  # fmt: skip
def test_what_is_wrong_is_said_before_anything_is_computed(arguments, sentence):
    assert sentence in refused("extremes", *arguments)


@pytest.mark.parametrize(("verdict", "told"), [("within", "✓ 15.0"), ("failed", "✗ a condition (double)")])
def test_the_exit_status_is_1_if_a_cell_failed(monkeypatch, verdict, told):
    cell = study.Cell("a condition", "fold", "double", verdict, 3.0, 4.0, 15.0, 1.0, "off" * (verdict == "failed"))
    monkeypatch.setattr(study, "extremes", lambda *_, **__: [cell])
    done = chapsym("extremes", "--quick")
    assert bool(done.returncode) == (verdict == "failed")
    assert told in " ".join(done.stdout.split())
