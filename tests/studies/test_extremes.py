"""The extremes: each verdict is the one that is pinned, and what is wrong turns cells red."""

import json
import warnings
from dataclasses import replace
from pathlib import Path

import flint
import mpmath
import numpy as np
import pytest
from commands import chapsym
from extremes_n import FOUR, truth_n

from chapsym.dynamics import Status, StepNotTaken
from chapsym.dynamics.oracle import Oracle, OracleFailed
from chapsym.studies import check
from research import extremes as study
from research.extremes import judging, states, steps
from research.extremes.judging import DOUBLE, ENCLOSURE, LEVELS, SINGLE, mp, number
from research.extremes.states import State, fold_at, truth

PINS = json.loads((Path(__file__).parent / "extremes.json").read_text(encoding="utf-8"))
#: How verdicts are pinned, a letter for each precision.
LETTERS = {"within": "w", "refused": "r", "failed": "f"}
#: The interval between the rows of a group that are run, 4 for other groups; thorough runs take all rows.
ONE_IN = dict.fromkeys(("inertia", "fold", "order", "rotation", "D", "momentum", "vertical", "directions"), 10)
ONE_IN |= dict.fromkeys(("fold search", *study.SHARED), 16)
TOGETHER = [group for group in study.GROUPS if group not in study.SHARED]
GENERIC = State(states.J, states.D, states.K, states.G)
HEAVIEST = "D = 1e15, momentum horizontal"


def verdicts(found):
    """One letter for each precision, a dot where there is no cell."""
    by_precision = {cell["rung"]: LETTERS[cell["verdict"]] for cell in found}
    return "".join(by_precision.get(level.key, ".") for level in LEVELS)


def test_every_row_is_pinned_and_long_runs_have_their_lengths_at_each_precision():
    rows = {name: list(group.rows) for name, group in study.GROUPS.items()}
    assert {group: list(named) for group, named in PINS.items()} == rows
    assert study.rows() == sum(map(len, PINS.values()))
    assert [level.long[1] for level in LEVELS] == [100_000_000, 100_000_000, 10_000_000, 10_000, 1000]


@pytest.mark.parametrize("groups", [*([group] for group in TOGETHER), [*study.SHARED]], ids="+".join)
def test_the_verdicts_are_those_that_are_pinned(groups, thorough):
    wrong = []
    for group in groups:
        for i, condition in enumerate(study.GROUPS[group].rows):
            if not thorough and i % ONE_IN.get(group, 4):
                continue
            found = study.row(group, condition, quick=not thorough)
            if verdicts(found) != PINS[group][condition]:
                wrong += [(group, condition, verdicts(found), [cell["reason"] for cell in found])]
            for cell in found:
                assert cell["verdict"] == "within" or len(cell["reason"].split()) >= 4, cell
    assert wrong == []


def judged(function):
    """The cell of a condition that is judged so."""
    return study.cell("group", "name", [lambda level, quick: function()], DOUBLE, True)


def verdict_of(state):
    """What is judged of a step in float64."""
    return steps.judge(state, DOUBLE, True).verdict


@pytest.mark.parametrize("part", [0, 1, 2])
def test_a_step_that_is_a_little_wrong_fails(monkeypatch, part):
    honest = steps.taken
    assert verdict_of(GENERIC) == "within"

    def wrong(level, state):
        found = list(honest(level, state))
        found[part] = [x + 1e-13 for x in found[part]]
        return found

    monkeypatch.setattr(steps, "taken", wrong)
    assert verdict_of(GENERIC) == "failed"


def test_a_ball_that_excludes_the_truth_fails_though_it_is_near(monkeypatch):
    honest = steps.taken
    assert steps.judge(GENERIC, ENCLOSURE, True).verdict == "within"

    def wrong(level, state):
        q, momentum, gamma = honest(level, state)
        with ENCLOSURE.precision.working():
            return q, [x + flint.arb(2) ** -190 for x in momentum], gamma

    monkeypatch.setattr(steps, "taken", wrong)
    found = steps.judge(GENERIC, ENCLOSURE, True)
    assert found.verdict == "failed"
    assert "excludes the truth" in found.reason


@pytest.mark.parametrize(
    ("status", "reach", "state", "verdict"),
    [
        *((status, 0.5, lambda: GENERIC, "failed") for status in (Status.FOLDED, Status.UNREACHABLE)),
        *((status, 0.5, lambda: GENERIC, "failed") for status in (Status.NO_INERTIA, Status.NOT_CONVERGED)),
        (Status.NOT_CONVERGED, 1.0, lambda: states.conditions()["D"][HEAVIEST][0], "refused"),
        (Status.UNREACHABLE, 0.5, lambda: states.beside_fold(-1e-8), "failed"),
    ],
)
def test_a_refusal_that_is_not_true_fails(monkeypatch, status, reach, state, verdict):
    """What float64 cannot resolve may be refused; a momentum that other rotations have is not out of reach."""

    def refuses(level, state):
        raise StepNotTaken(status, reach)

    monkeypatch.setattr(steps, "taken", refuses)
    assert verdict_of(state()) == verdict


def test_a_rotation_beyond_the_fold_fails(monkeypatch):
    before, beyond = states.beside_fold(1e-8), states.beside_fold(-1e-8)
    assert verdict_of(beyond) == "refused"
    found = steps.taken(DOUBLE, before)
    monkeypatch.setattr(steps, "taken", lambda level, state: found)
    assert verdict_of(before) == "within"
    assert verdict_of(beyond) == "failed"


def test_a_refusal_without_a_sentence_an_error_a_warning_and_a_nan_fail():
    assert judged(lambda: judging.refused("no"))["verdict"] == "failed"
    assert judged(lambda: 1 / 0)["reason"] == "ZeroDivisionError: division by zero"

    def warns():
        warnings.warn("overflow", stacklevel=1)
        return judging.Judged("within")

    assert judged(warns)["reason"] == "it warns: overflow"
    exact = [mp.mpf(1), mp.mpf(2)]
    nothing = judging.compared(DOUBLE, None, "x", [1.0, float("nan")], exact, 4)
    assert "not finite" in nothing.reason
    assert judged(lambda: nothing)["verdict"] == "failed"


def test_the_worst_counts():
    good, near, bad = judging.Judged("within", 1, 4), judging.Judged("within", 3, 4), judging.Judged("refused")
    assert judging.worst([good, near]) is near
    assert judging.worst([near, bad, good]) is bad


def test_ulps_are_those_of_the_precision_and_a_promise_of_no_digit_is_none():
    one = [mp.mpf(1)]
    for precision, step in zip(LEVELS[:3], (2.0**-23, 2.0**-52, 2.0**-104), strict=True):
        found = judging.compared(precision, None, "x", [one[0] + 3 * mp.mpf(step)], one, 4)
        assert found.ulps == 3
        assert found.verdict == "within"
    tiny = judging.compared(DOUBLE, None, "x", [1e-320], [mp.mpf(float("1e-320")) * 1.0001], 4)
    assert tiny.ulps < 1  # below the normal numbers an ulp is the least number
    for x, verdict in ((1.5, "failed"), (1.05, "within")):
        assert judging.compared(DOUBLE, None, "x", [x], [mp.mpf(1)], 1e20).verdict == verdict


def test_kappa_is_that_of_check():
    state = check.State(np.array(states.J), states.D, np.array(states.K), np.array(states.G))
    assert truth(GENERIC).condition == pytest.approx(check.compare(state)[2], rel=1e-9)


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
    for precision, spacing in ((SINGLE, 2.0**-21), (DOUBLE, 2.0**-50)):  # the fold is at 6.88
        gap = (number(states.next_to_fold(side, precision).K[0]) - at) * side
        assert 0 < gap <= spacing


def test_the_oracle_in_four_dimensions_solves_its_equation():
    state = FOUR["generic"][0]
    E, after, gamma, _ = truth_n(state)
    R, J = mp.eye(4) + mp.matrix([E[4 * i : 4 * i + 4] for i in range(4)]), mp.diag([*state.J])
    Gamma = mp.matrix(state.g) * mp.matrix(state.g).T
    K = mp.matrix(Oracle(state.J, state.D, state.g).skew(state.K).tolist())
    found = R * J - J * R.T + state.D / 2 * (R * Gamma - Gamma * R.T + Gamma * R - R.T * Gamma)
    assert mp.norm(found - K) < mp.mpf(10) ** -38
    assert mp.norm(R.T * R - mp.eye(4)) < mp.mpf(10) ** -38
    assert mp.norm(mp.matrix(after) - mp.matrix(list(R.T * K * R))) < mp.mpf(10) ** -38
    assert abs(mp.norm(gamma) - 1) < 1e-15


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
    heavy = states.conditions()["D"]["D = 1e12"][0]
    assert verdict_of(heavy) == "failed"


def test_a_fold_that_is_a_little_off_fails(monkeypatch):
    honest = steps.fold
    monkeypatch.setattr(steps, "fold", lambda *given: replace((f := honest(*given)), reach=f.reach * (1 + 1e-13)))
    assert steps.fold_search(states.folds()["generic"][0], DOUBLE, True).verdict == "failed"


def test_json_says_what_the_cells_say():
    found = study.row("momentum", "generic", quick=True)
    written = study.as_json(found, True)
    assert written["rungs"] == ["single", "double", "quad", "Digits(50)", "Ball(200)"]
    assert written["counts"] == {"within": 5, "refused": 0, "failed": 0}
    first = written["cells"][0]
    assert set(first) >= {"condition", "rung", "verdict", "ulps", "digits", "condition_number", "reason"}
    json.dumps(written, allow_nan=False)


def test_a_group_as_json_and_as_a_page(tmp_path, monkeypatch):
    """Of two of its rows."""
    group = study.GROUPS["vertical"]
    monkeypatch.setitem(study.GROUPS, "vertical", group._replace(items=lambda: dict([*group.items().items()][:2])))
    monkeypatch.setattr(study, "cores", lambda: 1)
    page = tmp_path / "page.html"
    done = chapsym("extremes", "--quick", "vertical", "-o", str(page), "--json")
    found = json.loads(done.stdout)
    assert [*found["groups"]] == ["vertical"]
    assert {cell["rung"] for cell in found["cells"]} == {"double"}
    assert sum(found["counts"].values()) == len(found["cells"]) == 2
    assert done.returncode == (1 if found["counts"]["failed"] else 0)
    text = page.read_text(encoding="utf-8")
    assert text.count("data-verdict=") == len(found["cells"])


@pytest.mark.parametrize(("verdict", "words"), [("within", "✓ 15.0"), ("failed", "✗ a condition (double)")])
def test_the_exit_status_is_1_if_a_cell_failed_and_the_page_has_its_row(monkeypatch, tmp_path, verdict, words):
    reason = "off" * (verdict == "failed")
    judge = [lambda level, quick: judging.Judged(verdict, 3.0, 4.0, 15.0, 1.0, reason)]
    cell = study.cell("fold", "a condition", judge, DOUBLE, True)
    monkeypatch.setattr(study, "extremes", lambda *_, **__: [cell])
    done = chapsym("extremes", "--quick", "-o", tmp_path / "page.md")
    assert bool(done.returncode) == (verdict == "failed")
    assert words in " ".join(done.stdout.split())
    assert "\n| a condition |" in (tmp_path / "page.md").read_text(encoding="utf-8")
