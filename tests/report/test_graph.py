"""The arc diagram: every claim, every use, nothing outside the picture."""

import re
import xml.etree.ElementTree as ET

from chapsym.report import graph, records


def parts(register):
    tree = ET.fromstring(graph.svg(register))
    return tree, tree.findall("a"), tree.findall("path")


def test_every_claim_is_a_link_and_every_use_an_arc(register):
    _, nodes, arcs = parts(register)
    assert [node.get("data-id") for node in nodes] == [r["id"] for r in records.in_paper_order(register)]
    assert all(node.get("href") == f"#claim-{node.get('data-id')}" for node in nodes)
    used = {(source, target) for target, those in records.uses(register).items() for source in those}
    assert {(arc.get("data-from"), arc.get("data-to")) for arc in arcs} == used
    assert len(arcs) == len(used)
    assert "0 claims and 0 uses" in graph.svg([])


def test_an_arc_has_the_verdict_of_its_source_and_against_the_order_of_the_paper_a_mark(handmade, record):
    _, _, arcs = parts(handmade)
    classes = {(arc.get("data-from"), arc.get("data-to")): arc.get("class").split() for arc in arcs}
    assert classes["2.1", "5.4"] == ["arc", "holds"]
    assert classes["5.4", "5.7"] == ["arc", "corrected"]
    _, _, arcs = parts([record("2.3", "holds", uses=["2.12"]), record("2.12", "holds")])
    assert arcs[0].get("class").split() == ["arc", "holds", "upwards"]


def test_nothing_is_outside_the_picture(register):
    tree, _, arcs = parts(register)
    width, height = map(float, tree.get("viewBox").split()[2:])
    assert width == graph.WIDTH
    for arc in arcs:
        x0, y0, x1, _, _, _, x3, y3 = map(float, re.findall(r"[\d.]+", arc.get("d")))
        assert x0 == x3
        assert x0 + 0.75 * (x1 - x0) <= width
        assert max(y0, y3) < height
    for node in tree.findall("a/text"):
        assert float(node.get("x")) + 7.9 * len(node.text) < x0, node.text
