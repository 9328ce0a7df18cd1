"""Whatever is done to the data of a scene, they are a Scene or a SceneError of one line; and its JSON Schema.

What is done to its text, test_hostile_files.py sees.
"""

import datetime
import json
import tomllib
from copy import deepcopy

import jsonschema
import numpy as np
import pytest
from budget import examples
from first import FIRST
from hypothesis import given
from hypothesis import strategies as st

from chapsym.scene import Scene, SceneError, checked
from chapsym.scene.members.members import expand
from chapsym.scene.read.schema import example as scene_of
from chapsym.scene.read.schema import names, schema
from chapsym.scene.read.tables import KEYS

WHOLE = """title = "all keys"
[[ball]]
name = "a"
inertia = [[0.02, 0.001, 0], [0.001, 0.021, "20 g cm2"], [0, "20 g cm2", { grid = [0.025, 0.026] }]]
mass = "3 kg"
radius = 0.15
start = { velocity = [1, "2 km/h"], spin = { linspace = [0, 1, 3] }, attitude = [0.8, 0.6, 0, 0], position = [0, 1] }
[[ball]]
preset = "bowling"
mass = 7
radius = "108.5 mm"
block_mass = { random = [0.5, 0.6] }
block_size = [0.05, 0.06, 0.07]
block_offset = [0.01, 0.02, 0]
[start]
omega = [1, { normal = [2, 0.1] }, "30 rpm"]
axes = "space"
gamma = [0, 0.6, 0.8]
[run]
time = "2 s"
time_step = 0.001
frames = 10
outputs = ["omega", "contact"]
order = 4
[sweep]
samples = 2
seed = 1
"""
DATA = {
    "whole": tomllib.loads(WHOLE),
    "small": {"ball": {"mass_tensor": [1, 2, "4"], "D": 3}, "start": {"momentum": [0.1, 0, 0]}, "run": {"steps": 3}},
    "four": {
        "ball": {"mass_tensor": [1, 2, 4, 3], "D": 3},
        "start": {"momentum": np.zeros((4, 4)).tolist(), "gamma": [0, 0, 0, 1]},
        "run": {"steps": 3},
    },
    "accurate": {
        "ball": {"preset": "dumbbell", "mass": 1, "radius": 1, "point_mass": 0.1, "separation": 1},
        "start": {"omega": [1, 2, 3]},
        "run": {"accuracy": 1e-6, "time": 3, "of": "contact"},
    },
}

leaves = st.one_of(
    st.none(), st.booleans(), st.integers(-3, 3), st.sampled_from([10**18, -(10**400), 2**63]), st.floats(),
    st.sampled_from(["", "3 m", "1/3", "30 rpm", "nan", "space", "x" * 500, "bowling", "D", "contact", "\0", "1e5 kg"]),
    st.text(max_size=5), st.just(datetime.datetime(2026, 1, 1)), st.just(datetime.time(1)),
)  # fmt: skip
keys = st.sampled_from(["mass", "grid", "linspace", "random", "normal", "omega", "steps", "D", "", "ball", "(list)"])
values = st.recursive(leaves, lambda x: st.lists(x, max_size=4) | st.dictionaries(keys, x, max_size=3), max_leaves=8)


def paths(data, here=()):
    """Every place in nested tables and lists."""
    yield here
    if isinstance(data, dict | list):
        for key, part in data.items() if isinstance(data, dict) else enumerate(data):
            yield from paths(part, (*here, key))


def mutated(data, path, value, way):
    """The data with another value at a path, or without it, or with another key beside it."""
    data = deepcopy(data)
    if not path:
        return data
    table = data
    for part in path[:-1]:
        table = table[part]
    if way == "replace":
        table[path[-1]] = value
    elif way == "remove":
        del table[path[-1]]
    elif isinstance(table, list):
        table.insert(path[-1], value)
    else:
        table[str(value)[:20]] = value
    return data


def holds(make):
    """A scene with finite balls, or one sentence."""
    words = None
    try:
        scene = make()
        members = expand(scene)
    except SceneError as error:
        words = str(error)
    if words is not None:
        assert words.strip()
        assert "\n" not in words
        return
    assert isinstance(scene, Scene)
    for array in (members.momentum, members.gamma, members.ball.mass_tensor, members.ball.D):
        assert np.isfinite(array).all()
    assert len(set(members.names)) == len(members) == len(members.gamma)
    json.loads(scene.source) if scene.toml is None else None
    assert scene.task().outputs


@examples(15, 400)
@given(st.data(), st.sampled_from(sorted(DATA)))
def test_any_change_of_the_data_gives_a_scene_or_a_sentence(data, name):
    changed = DATA[name]
    for _ in range(data.draw(st.integers(1, 3))):
        path = data.draw(st.sampled_from(list(paths(changed))))
        way = data.draw(st.sampled_from(["replace", "replace", "remove", "add"]))
        changed = mutated(changed, path, data.draw(values), way)
    holds(lambda: checked(changed))


#: What it lets pass is what the tables read, as far as a schema can say it.
SCHEMA = schema()


def valid(data):
    return jsonschema.Draft202012Validator(SCHEMA).is_valid(data)


def test_it_is_a_schema_with_a_description_of_every_key_and_a_unit_of_every_quantity():
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    assert "quantity" not in str(SCHEMA)
    assert "null" not in str(SCHEMA)
    for table, kind in (("ball", "BallTable"), ("start", "StartTable"), ("run", "RunTable"), ("sweep", "SweepTable")):
        properties = SCHEMA["$defs"][kind]["properties"]
        assert set(properties) == set(KEYS[table])
        assert all(one.get("description") for one in properties.values())
    assert set(SCHEMA["properties"]) == set(KEYS[""])
    assert "m, or a range" not in SCHEMA["$defs"]["length"]["description"].replace("(m)", "")
    assert "(rad s-1)" in SCHEMA["$defs"]["angular_velocity"]["description"]


def test_the_examples_are_those_of_the_docs():
    assert names() == sorted(path.stem for path in (FIRST.parent / "scenes").glob("*.toml"))


EXAMPLES = map(tomllib.loads, [FIRST.read_text(encoding="utf-8"), *map(scene_of, names())])


@pytest.mark.parametrize("data", [*EXAMPLES, *DATA.values()], ids=["first", *names(), *DATA])
def test_every_example_and_every_kind_of_key_fits(data):
    """And is a scene, of one ball or of as many as its ranges make."""
    assert valid(data)
    assert len(expand(checked(data))) == (8 if data is DATA["whole"] else data.get("sweep", {}).get("samples", 1))


BALL, START, RUN = DATA["small"]["ball"], DATA["small"]["start"], DATA["small"]["run"]


@pytest.mark.parametrize(
    "change",
    [
        {"bal": BALL},
        {"ball": BALL | {"raduis": 1}},
        {"ball": [BALL, BALL | {"raduis": 1}]},
        {"ball": BALL | {"mass_tensor": [1, 2]}},
        {"ball": BALL | {"mass_tensor": [1, 2, "a lot"]}},
        {"ball": BALL | {"mass_tensor": [1, 2, {"grid": []}]}},
        {"ball": BALL | {"mass_tensor": [1, 2, {"linspace": [1, 2]}]}},
        {"ball": BALL | {"mass_tensor": [1, 2, {"linspace": [1, 2, 2.5]}]}},
        {"ball": BALL | {"mass_tensor": [1, 2, {"grid": [1], "random": [1, 2]}]}},
        {"ball": BALL | {"mass_tensor": [1, 2, {"uniform": [1, 2]}]}},
        {"ball": {"preset": "egg", "mass": 1, "radius": 1}},
        {"start": START | {"gamma": ["1 m", 0, 0]}},
        {"start": START | {"axes": "world"}},
        {"start": {"omega": {"grid": [1]}}},
        {"start": {"omega": [1, 2, 3, 4]}},
        {"start": {"velocity": [1, 2, 3]}},
        {"run": RUN | {"steps": "3"}},
        {"run": RUN | {"steps": -1}},
        {"run": RUN | {"time_step": 0}},
        {"run": RUN | {"time_step": {"grid": [1]}}},
        {"run": RUN | {"outputs": ["spin"]}},
        {"run": RUN | {"order": 3}},
        {"run": None},
        {"sweep": {"samples": 0}},
    ],
)
def test_what_is_wrong_fits_neither_the_schema_nor_the_tables(change):
    data = DATA["small"] | change
    assert not valid(data)
    with pytest.raises(SceneError):
        checked(data)
