"""The list of errata as data: its schema, what it says beside the Markdown, and the states of its entries."""

import copy
import json
from pathlib import Path

import jsonschema
import pytest

import chapsym
from chapsym.report import NotErrata, entries, errata, records

DOCS = Path(__file__).parents[2] / "docs"
SCHEMA = json.loads((DOCS / "errata.schema.json").read_text(encoding="utf-8"))


def written(found, version="1", before=None):
    """The document, valid by the schema."""
    text = errata.data(found, version, entries(before) if before else {})
    document = json.loads(text)
    jsonschema.validate(document, SCHEMA, jsonschema.Draft202012Validator)
    return document, text


def entry(document, id):
    return next(one for one in document["errata"] if one["id"] == id)


def states(one):
    return [(state["version"], state["since"], state["verdict"]) for state in one["states"]]


def test_the_schema_is_one_and_refuses_what_it_does_not_name(handmade):
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    document, _ = written(handmade)
    for change in ({"more": 1}, {"errata": [{}]}, {"format": "chapsym errata 2"}, {"claims": "many"}):
        assert not jsonschema.Draft202012Validator(SCHEMA).is_valid(document | change)


def test_an_entry_tells_its_place_what_rests_on_it_and_what_is_true(handmade):
    found = entry(written(handmade)[0], "5.4")
    assert (found["section"], found["section_title"]) == (5, records.SECTIONS[5])
    assert found["downstream"] == ["prop-3", "5.7"]
    assert (found["printed"], found["true"]) == (r"a = \tfrac12 b", r"a = \tfrac14 b")
    assert found["counterexamples"][0]["point"]["J"] == "(1, 2, 4)"
    assert found["proof"] == "chapsym prove 5.4 --explain"


def test_a_changed_entry_gets_a_state_more_and_keeps_the_earlier_ones(handmade):
    _, first = written(handmade, "1")
    again, second = written(handmade, "2", first)
    assert {state["since"] for one in again["errata"] for state in one["states"]} == {"1"}
    handmade[0]["corrected"] = "a = b"
    changed, third = written(handmade, "2", second)
    assert states(entry(changed, "5.4")) == [(1, "1", "corrected"), (2, "2", "corrected")]
    assert states(entry(changed, "5.7")) == [(1, "1", "refuted")]
    assert written(handmade, "2", third)[1] == third


def test_a_release_has_one_state_and_what_is_taken_back_before_it_leaves_none(handmade):
    _, text = written(handmade, "1")
    other = copy.deepcopy(handmade)
    for change in ("a = b", "a = 2b"):
        other[0]["corrected"] = change
        document, text = written(other, "2", text)
        assert states(entry(document, "5.4"))[1:] == [(2, "2", "corrected")]
    assert states(entry(written(handmade, "2", text)[0], "5.4")) == [(1, "1", "corrected")]


def test_an_entry_that_a_release_had_is_withdrawn_and_not_forgotten(handmade):
    _, first = written(handmade, "1")
    assert written(handmade[1:], "1", first)[0]["withdrawn"] == []
    gone, text = written(handmade[1:], "2", first)
    (one,) = gone["withdrawn"]
    assert (one["id"], states(one)) == ("5.4", [(1, "1", "corrected"), (2, "2", "withdrawn")])
    assert written(handmade[1:], "3", text)[0]["withdrawn"] == gone["withdrawn"]
    back, _ = written(handmade, "3", text)
    assert back["withdrawn"] == []
    assert states(entry(back, "5.4"))[2:] == [(3, "3", "corrected")]


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{}", '{"format": "chapsym errata 2"}', '{"format": "chapsym errata 1", "errata": [1], "withdrawn": []}',
     '{"format": "chapsym errata 1", "errata": [{"id": "5.4", "states": []}], "withdrawn": []}', "[" * 100_000],
)  # fmt: skip
def test_what_is_no_list_of_errata_is_refused(text):
    with pytest.raises(NotErrata):
        entries(text)


def test_the_published_list_is_what_the_records_give(register):
    """To mend: chapsym report -o docs/errata.json."""
    published = (DOCS / "errata.json").read_text(encoding="utf-8")
    assert written(register, chapsym.__version__, published)[1] == published
