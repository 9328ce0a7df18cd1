"""The JSON Schema: what it lets pass is what the tables read, as far as a schema can say it."""

import tomllib
from pathlib import Path

import jsonschema
import pytest

from chapsym.scene import SceneError, checked
from chapsym.scene.read.example import example, names
from chapsym.scene.read.schema import schema
from chapsym.scene.read.tables import KEYS

from .test_scene_fuzz import DATA

SCHEMA = schema()
DOCS = Path(__file__).parents[2] / "docs"
FIRST = (DOCS / "first.toml").read_text(encoding="utf-8")


def valid(data):
    return jsonschema.Draft202012Validator(SCHEMA).is_valid(data)


def test_it_is_a_schema():
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    assert "quantity" not in str(SCHEMA)
    assert "null" not in str(SCHEMA)


def test_the_examples_are_those_of_the_docs():
    assert names() == sorted(path.stem for path in (DOCS / "scenes").glob("*.toml"))


EXAMPLES = {"first": tomllib.loads(FIRST), **{name: tomllib.loads(example(name)) for name in names()}}


@pytest.mark.parametrize("data", [*EXAMPLES.values(), *DATA.values()], ids=[*EXAMPLES, *DATA])
def test_every_example_and_every_kind_of_key_fits(data):
    jsonschema.validate(data, SCHEMA, jsonschema.Draft202012Validator)


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


def test_every_key_has_a_description_and_every_quantity_its_unit():
    for table, kind in (("ball", "BallTable"), ("start", "StartTable"), ("run", "RunTable"), ("sweep", "SweepTable")):
        properties = SCHEMA["$defs"][kind]["properties"]
        assert set(properties) == set(KEYS[table])
        assert all(one.get("description") for one in properties.values())
    assert set(SCHEMA["properties"]) == set(KEYS[""])
    assert "m, or a range" not in SCHEMA["$defs"]["length"]["description"].replace("(m)", "")
    assert "(rad s-1)" in SCHEMA["$defs"]["angular_velocity"]["description"]
