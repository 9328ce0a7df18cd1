"""Order, names and counts of the records."""

import pytest

from chapsym.report import records as reading


def ids(records):
    return [record["id"] for record in records]


def test_records_come_in_the_order_of_the_paper_and_what_names_no_equation_behind_the_one_before_it(handmade, record):
    assert ids(reading.in_paper_order(handmade)) == ["2.1", "3.1", "3.5", "5.4", "prop-3", "5.7", "5.9", "6.lr"]
    found = [record("5.4", "holds"), record("abstract", "holds"), record("2.1", "holds"), record("intro", "holds")]
    assert ids(reading.in_paper_order(found)) == ["2.1", "intro", "5.4", "abstract"]


def test_the_register_is_in_order_and_each_section_is_whole(register):
    found = reading.sections(register)
    assert [section.number for section in found] == sorted({section.number for section in found})
    assert all(section.title != "Elsewhere" for section in found)
    assert sorted(id for section in found for id in ids(section.records)) == sorted(ids(register))
    order = ids(reading.in_paper_order(register))
    assert order.index("4.11") < order.index("prop-1") < order.index("prop-2") < order.index("remark-3")
    assert order.index("5.4") < order.index("prop-3") < order.index("5.6") < order.index("prop-4") < order.index("5.11")
    assert order.index("2.9") < order.index("2.10"), "2.10 is not a decimal number"


@pytest.mark.parametrize(
    ("id", "name"),
    [
        ("5.12", "(5.12)"), ("5.12-q0", "(5.12), q0"), ("5.16-weierstrass-w", "(5.16), weierstrass-w"),
        ("prop-4", "Proposition 4"), ("remark-3", "Remark 3"), ("prop-1-proof", "Proposition 1, proof"),
        ("something", "something"),
    ],
)  # fmt: skip
def test_a_claim_has_a_name_for_readers(id, name):
    assert reading.label(id) == name


def test_counts_are_in_the_order_of_the_verdicts(handmade, record):
    assert list(reading.counts(handmade)) == list(reading.VERDICTS)
    assert reading.counts([record("1", "open"), record("2", "holds"), record("3", "holds")]) == {"holds": 2, "open": 1}
    assert reading.counts([record("1", "novel")]) == {"novel": 1}


def test_uses_and_users_are_each_others_inverse_without_claims_that_are_not_there(register, record):
    uses, users = reading.uses(register), reading.users(register)
    assert {(a, b) for a in uses for b in uses[a]} == {(a, b) for b in users for a in users[b]}
    assert "5.4" in uses["prop-3"]
    assert reading.uses([record("5.4", "holds", uses=["5.2"])]) == {"5.4": []}
