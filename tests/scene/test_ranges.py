"""Ranges: products in order, draws that depend on the seed and their key alone, and a million balls in seconds."""

import re
import tracemalloc

import numpy as np
import pytest

from chapsym import scene
from chapsym.scene import SceneError
from chapsym.scene.members.members import expand
from chapsym.scene.read.tables import units_of


def checked(omega=(1, 2, 3), sweep=None, **ball):
    data = {
        "ball": {"inertia": [0.006, 0.007, 0.009], "mass": 2.0, "radius": 0.1} | ball,
        "start": {"omega": list(omega)},
        "run": {"time_step": 0.01, "steps": 10},
    }
    return scene.checked(data | ({"sweep": sweep} if sweep else {}))


def values(of):
    return {key: one.tolist() for key, one in expand(of).parameters.items()}


def test_ranges_make_their_product_the_last_the_fastest():
    found = expand(checked(({"linspace": [0, 1, 3]}, {"grid": ["30 rpm", 7]}, 3), radius={"grid": [0.1, "11 cm"]}))
    assert len(found) == 12
    assert found.names[0] == "ball 1"
    assert found.names[-1] == "ball 12"
    first, second = found.parameters["start.omega.1"], found.parameters["start.omega.2"]
    assert found.parameters["ball.radius"].tolist() == [0.1] * 6 + [0.11] * 6
    assert first.tolist() == [0.0, 0.0, 0.5, 0.5, 1.0, 1.0] * 2
    assert second.tolist() == [np.pi, 7.0] * 6
    assert (units_of("start.omega.1"), units_of("ball.radius")) == ("rad s-1", "m")
    assert found.ball.radius.tolist() == found.parameters["ball.radius"].tolist()


def test_each_ball_of_a_sweep_is_the_ball_alone():
    whole = expand(checked((1, {"linspace": [2, 5, 4]}, {"random": [0, 1]}), {"samples": 3}, mass={"grid": [2, 3]}))
    swept = whole.parameters
    for i in range(len(whole)):
        keys = ("start.omega.2", "start.omega.3")
        alone = expand(checked((1, *(float(swept[k][i]) for k in keys)), mass=float(swept["ball.mass"][i])))
        assert alone.momentum[0].tolist() == whole.momentum[i].tolist()
        assert alone.ball.D[0] == whole.ball.D[i]
    assert len(whole) == 24


def test_draws_are_told_by_the_seed_and_by_their_own_key():
    drawn = {"random": [0, 1]}
    some = values(checked((drawn, {"normal": [0, 1]}, 0), {"samples": 5, "seed": 3}))
    assert some == values(checked((drawn, {"normal": [0, 1]}, 0), {"samples": 5, "seed": 3}))
    assert some != values(checked((drawn, {"normal": [0, 1]}, 0), {"samples": 5, "seed": 4}))
    more = values(checked((drawn, {"normal": [0, 1]}, drawn), {"samples": 5, "seed": 3}))
    assert more["start.omega.1"] == some["start.omega.1"]
    assert more["start.omega.3"] != some["start.omega.1"]
    # NumPy keeps the bits of PCG64, but may change what a Generator makes of them: here it would show.
    found = values(checked((drawn, {"normal": [0, 1]}, 0), {"samples": 2, "seed": 3}))
    assert found["start.omega.1"] == [0.512666372902691, 0.5203620745241612]
    assert found["start.omega.2"] == [-1.6259734135820363, -0.11966005365509731]


def test_draws_have_the_distribution_that_was_asked_for():
    found = values(checked(({"random": [2, 3]}, {"normal": ["60 rpm", "6 rpm"]}, 0), {"samples": 100_000}))
    even, normal = np.array(found["start.omega.1"]), np.array(found["start.omega.2"])
    assert even.min() >= 2
    assert even.max() <= 3
    assert abs(even.mean() - 2.5) < 5 * 12**-0.5 / 100_000**0.5  # five deviations of the mean
    assert abs(normal.mean() - 2 * np.pi) < 5 * 0.2 * np.pi / 100_000**0.5
    assert abs(normal.std() / (0.2 * np.pi) - 1) < 5 / 200_000**0.5


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"linspace": [0, 1]}, "start.omega.1: linspace takes [a, b, n]"),
        ({"linspace": [0, 1, 2.0]}, "start.omega.1: linspace takes [a, b, n]"),
        ({"linspace": [0, 1, 0]}, "start.omega.1: linspace takes [a, b, n]"),
        ({"linspace": [0, "1 m", 2]}, "start.omega.1 is an angular velocity, but '1 m' is a length"),
        ({"linspace": [0, 1, 10**9]}, "linspace of 1000000000 values: a sweep has 10000000 balls at most"),
        ({"grid": []}, "start.omega.1: grid takes one value or more"),
        ({"grid": 3}, "start.omega.1: grid takes a list of numbers in brackets"),
        ({"random": [1, 0]}, "start.omega.1: random takes [a, b] with a at most b"),
        ({"random": [1]}, "start.omega.1: random takes [a, b]"),
        ({"normal": [1, -1]}, "start.omega.1: normal takes [mean, deviation] with a deviation that is not negative"),
        ({"normal": [1]}, "start.omega.1: normal takes [mean, deviation]"),
        ({"uniform": [0, 1]}, "but the table has uniform"),
        ({"grid": [1], "random": [0, 1]}, "but the table has grid, random"),
        ({}, "but the table has nothing"),
        ({"random": [0, 1]}, "start.omega.1 is drawn: say how often, as samples = 100 under [sweep]"),
    ],
)
def test_a_wrong_range_is_refused(given, sentence):
    with pytest.raises(SceneError, match=re.escape(sentence)):
        checked((given, 0, 0))


def test_ranges_that_do_not_fit_are_refused():
    many = {"linspace": [0, 1, 10**4]}
    for given, sentence in (
        ({"inertia": {"grid": [[1, 1, 1], [2, 2, 2]]}}, "a range replaces one number, not a list"),
        ({"omega": (many, many, 1)}, "the ranges make 100000000 balls; a sweep has 10000000 at most"),
        ({"omega": (1, many, 0), "sweep": {"samples": 3}}, "sweep.samples needs a range that is drawn"),
    ):
        with pytest.raises(SceneError, match=re.escape(sentence)):
            expand(checked(**given))


def test_a_million_balls_take_bounded_memory(thorough):
    """So much for each: of a tenth of them in a run that is not thorough."""
    count = 10**6 if thorough else 10**5
    tracemalloc.start()
    found = expand(checked(({"normal": [2, 0.1]}, {"normal": [3, 0.1]}, 1), {"samples": count}))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert len(found) == count
    assert peak < 1200 * count
