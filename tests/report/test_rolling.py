"""What the page of a rolling ball is given: it rolls, its turns are whole, and what cannot be shown is words."""

import hashlib
import re
import tomllib
from pathlib import Path

import numpy as np
import pytest
from results import EVEN, rolled

import chapsym
from chapsym.dynamics import BadInput, Status, kernels
from chapsym.show.rolling import html, write_page
from chapsym.show.rolling import motion as motions
from chapsym.show.rolling.motion import TOO_FAR, TOO_MANY, motion, nearest_turns

FOLDER = Path(motions.__file__).parent
UP = np.array([0.0, 0.0, 1.0])
EPS = np.finfo(np.float64).eps


def one(dataset, **options):
    return motion(dataset, **options).balls[0]


def test_the_contact_point_goes_as_far_as_the_ball_turns_and_gamma_upwards():
    """(4.9): Δr = ρ sin φ n × e₃ for the turn φ n of a step, in space, right-handed, z up."""
    ball = one(rolled())
    angle = np.linalg.norm(ball.turn, axis=1, keepdims=True)
    way = ball.radius * np.sin(angle) / angle * np.cross(ball.turn, UP)[:, :]
    # Both are differences of numbers that carry the rounding of all the steps before.
    budget = 4 * EPS * len(angle) * max(np.abs(ball.contact).max(), 1.0)
    np.testing.assert_allclose(np.diff(ball.contact, axis=0), way[:, :2], rtol=0, atol=budget)
    assert np.abs(way[:, 2]).max() <= budget
    assert np.hypot(*ball.contact[-1]) > 10 * ball.radius
    up = kernels.rotate(ball.attitude, ball.vectors["gamma"])
    np.testing.assert_allclose(up, np.tile(UP, (601, 1)), atol=600 * EPS)


@pytest.mark.parametrize("every", [60, 130, 300])
def test_omega_tells_the_whole_turns_between_far_frames(every):
    """11 rad/s for 0.3 s, 0.65 s, 1.5 s is about a half, one and two and a half turns."""
    ball = one(rolled(3900, every=every, omega=(3.0, 4.0, 10.0), ball=EVEN))
    fine = one(rolled(3900, ball=EVEN)).turn
    np.testing.assert_allclose(ball.turn, np.add.reduceat(fine, np.arange(0, 3900, every)), rtol=1e-9)
    assert not ball.notes


@pytest.mark.parametrize("unit", [1e40, 1e-60])
def test_numbers_that_the_page_does_not_hold_are_refused(unit):
    with pytest.raises(BadInput, match="the page has the numbers of float32"):
        html(rolled().assign(omega=unit * rolled()["omega"]))


def test_frames_too_far_apart_are_told_where_nothing_tells_the_turns():
    without = rolled(3900, every=60).drop_vars("omega")
    assert one(without).turn is None
    assert one(without).notes == [TOO_FAR]
    assert TOO_FAR.replace('"', "&#34;") in html(without)
    near = one(rolled(every=5).drop_vars("omega"))
    assert near.turn is not None
    assert not near.notes
    # A step of the map turns by less than half a turn: nothing is hidden between next steps, however coarse.
    next_ones = without.assign_coords(step=without["step"] // 60)
    assert not one(next_ones).notes
    assert one(without.assign_coords(step=without["step"] // 30)).notes == [TOO_FAR]
    # A run to an accuracy has times but no steps: between two of its frames there may be any number of them.
    chosen = rolled(3900, every=60).drop_vars("step")
    assert one(chosen).turn is not None
    assert one(chosen.drop_vars("omega")).notes == [TOO_FAR]
    assert "model: full · 66 frames in 19.5 s" in html(chosen)


def test_a_whole_turn_that_the_attitude_hides_is_seen_in_the_way_and_a_wrong_omega_does_not_pass():
    seen, wrong = rolled(3900, every=5).drop_vars("omega"), rolled(3900, every=60)
    assert one(seen).turn is not None
    assert one(seen.assign(contact=seen["contact"] * 20)).notes == [TOO_FAR]
    assert one(wrong.assign(omega=wrong["omega"] * -0.31)).notes == [TOO_FAR]


def test_a_quaternion_and_its_negative_are_the_same_attitude():
    dataset = rolled(50, every=5).drop_vars("omega")
    flipped = dataset.assign(attitude=dataset["attitude"] * np.array([1, -1] * 5 + [1])[:, np.newaxis])
    np.testing.assert_allclose(one(flipped).turn, one(dataset).turn, rtol=0, atol=16 * EPS)


def test_thinned_frames_keep_their_whole_turns(monkeypatch):
    dataset = rolled(6000, ball=EVEN)
    fine = one(dataset)
    monkeypatch.setattr(motions, "FRAMES", 20)
    monkeypatch.setattr(motions, "LEAST", 20)
    found = motion(dataset)
    assert found.notes == [f"{len(found.clock)} of 6001 frames are shown"]
    assert len(found.clock) <= 22
    kept = np.round(found.clock / 0.005).astype(int)
    assert kept[[0, -1]].tolist() == [0, 6000]
    ball = found.balls[0]
    assert np.linalg.norm(ball.turn[:-1], axis=1).min() > 2 * np.pi
    sums = np.add.reduceat(fine.turn, kept[:-1])
    np.testing.assert_allclose(ball.turn, sums, rtol=1e-9)


def test_turning_that_no_sum_tells_is_not_shown(monkeypatch):
    monkeypatch.setattr(motions, "FRAMES", 10)
    monkeypatch.setattr(motions, "LEAST", 10)
    tumbling = one(rolled(4000, omega=(0.1, 12.0, 0.1)))
    assert tumbling.turn is None
    assert tumbling.notes == [TOO_MANY]


def test_the_nearest_turn_is_nearest_and_a_ball_at_rest_does_not_turn():
    with np.errstate(all="raise"):
        found, near = nearest_turns(np.zeros((1, 3)), np.zeros((1, 3)))
    assert (found.tolist(), near.tolist()) == ([[0.0] * 3], [True])
    rng = np.random.default_rng(6)
    expected = rng.normal(size=(200, 3)) * 8
    angle = np.linalg.norm(expected, axis=1, keepdims=True)
    least = expected * (1 - 2 * np.pi / angle * np.round(angle / (2 * np.pi)))
    found, near = nearest_turns(least, expected)
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12)
    assert near.all()
    still, near = nearest_turns(np.zeros((1, 3)), np.array([[0.0, 6.3, 0.0]]))
    np.testing.assert_allclose(still, [[0.0, 2 * np.pi, 0.0]])
    assert near.all()


def test_a_ball_that_stops_is_shown_up_to_there_and_told():
    dataset = rolled(50, omega=[(3.0, 4.0, 10.0), (3.0, 4.0, 9.0)])
    for name in ("momentum", "gamma", "omega", "attitude", "contact"):
        dataset[name][1, 31:] = np.nan
    dataset["taken"][1], dataset["status"][1] = 30, Status.FOLDED
    found = motion(dataset)
    assert [len(ball.attitude) for ball in found.balls] == [51, 31]
    assert all(np.isfinite(ball.contact).all() for ball in found.balls)
    assert found.balls[1].notes == [f"it stops after step 30: {Status.FOLDED.sentence}"]
    assert "ball 2: it stops after step 30" in html(dataset)
    dataset["attitude"][0] = np.nan
    found = motion(dataset)
    assert [ball.name for ball in found.balls] == ["ball 2"]
    assert found.notes[-1] == "ball 1 has no frame that can be drawn"
    dataset["attitude"][:] = np.nan
    with pytest.raises(BadInput, match="no frame that can be drawn"):
        motion(dataset)


def test_what_stands_behind_the_last_step_is_not_shown_and_the_clock_ends_where_the_last_ball_stops():
    dataset = rolled(50, every=5)
    dataset["taken"][0], dataset["status"][0] = 30, Status.FOLDED
    for name in ("gamma", "omega", "attitude", "contact"):  # finite, and of no run
        dataset[name][0, 7:] = 0.5
    found = motion(dataset)
    assert len(found.balls[0].attitude) == len(found.clock) == 7
    assert (found.balls[0].contact[-1] == dataset["contact"].values[0, 6]).all()
    assert found.notes == ["it ends at 0.15 of 0.25 s, where the ball stops"]
    assert "model: full · 50 steps of 0.005 s" in html(dataset)
    dataset["omega"][0, 4] = np.nan
    assert len(motion(dataset).balls[0].attitude) == 4


def test_frames_that_are_a_large_turn_apart_have_others_between_them():
    """11 rad/s in 0.1 s: too far for an even turn and a straight way, near enough for the motion between."""
    sparse, fine = motion(rolled(600, every=20)), motion(rolled(600))
    count = sparse.between
    assert len(sparse.clock) == 30 * count + 1
    assert "more are interpolated, to the order 6" in html(rolled(600, every=20))
    same = np.searchsorted(fine.clock, sparse.clock[::count] - 1e-9)
    np.testing.assert_array_equal(sparse.balls[0].contact[::count], fine.balls[0].contact[same])
    true = np.stack([np.interp(sparse.clock, fine.clock, x) for x in fine.balls[0].contact.T], axis=-1)
    assert np.abs(true - sparse.balls[0].contact).max() < 1e-3 * sparse.balls[0].radius
    assert motion(rolled(50)).between == 1


def test_a_ball_that_stops_between_the_frames_shown_is_shown_where_it_stops(monkeypatch):
    monkeypatch.setattr(motions, "FRAMES", 20)
    monkeypatch.setattr(motions, "LEAST", 10)
    dataset = rolled(100, omega=[(3.0, 4.0, 10.0), (3.0, 4.0, 9.0)])
    dataset["attitude"][1, 38:] = np.nan
    found = motion(dataset)
    assert found.balls[1].notes == ["it stops where its numbers end"]
    np.testing.assert_array_equal(found.balls[1].contact[-1], dataset["contact"][1, 37])


def test_balls_are_chosen_by_name_and_index():
    dataset = rolled(5, omega=np.full((25, 3), 2.0))
    assert [ball.name for ball in motion(dataset).balls] == [f"ball {i}" for i in range(1, 21)]
    assert motion(dataset).notes == ["the first 20 of 25 balls are shown"]
    assert [ball.name for ball in motion(dataset, ["ball 25", 0, -2]).balls] == ["ball 25", "ball 1", "ball 24"]
    for wrong in (["nobody"], [25], [-26], [True], [0, 0], [], range(21)):
        with pytest.raises(BadInput):
            motion(dataset, wrong)


def test_a_result_that_lacks_something_says_what_to_add(tmp_path):
    dataset = rolled(5)
    for lacking, said in [
        (dataset.drop_vars("attitude"), r'the result has no attitude: add "attitude" to run.outputs$'),
        (dataset.drop_vars(["attitude", "contact"]), 'add "attitude" to run.outputs, and "contact"'),
        (dataset.drop_vars("radius"), "ball 1 has no radius, .* give ball.radius"),
        (dataset.assign(radius=("ball", [np.nan])), "ball 1 has no radius"),
        (dataset.drop_vars("attitude").rename(frame="frame", axis="row"), "more than three dimensions"),
    ]:
        with pytest.raises(BadInput, match=said):
            write_page(lacking, tmp_path / "page.html")
    assert not list(tmp_path.iterdir())
    with pytest.raises(BadInput, match="does not exist"):
        write_page(dataset, tmp_path / "no" / "page.html")


def test_a_ball_without_contact_point_turns_on_the_spot():
    found = motion(rolled(5, omega=np.full((2, 3), 2.0)).drop_vars("contact"))
    assert 'turns on the spot: add "contact" to run.outputs' in found.notes[0]
    first, second = (ball.contact for ball in found.balls)
    assert (np.diff(first, axis=0) == 0).all()
    assert np.linalg.norm(second[0] - first[0]) > 0.22


def test_decimal_strings_and_steps_without_time_are_read():
    dataset = rolled(5)
    digits = dataset.assign({name: dataset[name].astype(str) for name in ("attitude", "contact", "omega")})
    found = motion(digits.drop_vars("time"))
    assert found.unit == "steps"
    np.testing.assert_array_equal(found.balls[0].contact, one(dataset).contact)


def test_the_page_is_whole_and_asks_for_nothing(tmp_path):
    dataset = rolled(20, title="<b>A & B</b> </script>", names=["</script><b>"])
    write_page(dataset, tmp_path / "page.html")
    text = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert text == html(dataset)
    assert "<title>&lt;b&gt;A &amp; B&lt;/b&gt; &lt;/script&gt;</title>" in text
    assert "model: full · 20 steps of 0.005 s" in text
    assert not re.search(r'(src|href)="(?!data:)', text)
    assert "Copyright © 2010-2026 three.js authors" in text
    assert text.count("</script>") == 3
    assert r"\u003c/script>\u003cb>" in text
    assert 0.7e6 < len(text) < 1.0e6


def test_three_js_is_unmodified_and_packaged():
    hashes = dict(re.findall(r"^ {4}([0-9a-f]{64})  (\S+)$", (FOLDER / "three/README.md").read_text(), re.M))
    assert {path.name for path in (FOLDER / "three").iterdir()} == {*hashes.values(), "README.md"}
    for digest, name in hashes.items():
        assert hashlib.sha256((FOLDER / "three" / name).read_bytes()).hexdigest() == digest, name
    project = Path(chapsym.__file__).parents[1] / "pyproject.toml"
    if not project.is_file():
        pytest.skip("an installed wheel has no pyproject.toml")
    words = tomllib.loads(project.read_text(encoding="utf-8"))["tool"]["setuptools"]
    packaged = {path for glob in words["package-data"]["chapsym.show.rolling"] for path in FOLDER.glob(glob)}
    assert "chapsym.*" in words["packages"]["find"]["include"]
    assert (FOLDER / "__init__.py").is_file()
    assert packaged == {path for path in FOLDER.rglob("*") if path.is_file() and not path.suffix.startswith(".py")}
