"""The page of the extremes: what it shows is what the JSON says, in a real browser, on a desk and on a phone."""

import pytest
import shown
from contrast import low

from research.extremes import page as extremes

PRECISIONS = ["single", "double", "quad", "Digits(50)", "Ball(200)"]


def cell(condition, precision, verdict, group="fold", ulps=1.0, digits=15.5, reason=""):
    return {
        "condition": condition, "group": group, "rung": precision, "verdict": verdict, "ulps": ulps, "promised": 4.0,
        "digits": digits, "condition_number": 2.5, "reason": reason,
    }  # fmt: skip


FOLDED = "the branch folds before <it> reaches this momentum"
CELLS = [
    *(cell("1e-8 before it", precision, "within") for precision in PRECISIONS),
    cell("one ulp beyond it", "single", "refused", reason=FOLDED, ulps=None, digits=None),
    cell("one ulp beyond it", "double", "refused", reason=f"step 0: {FOLDED}", ulps=None, digits=None),
    cell("one ulp beyond it", "quad", "failed", ulps=1e9, digits=2.0, reason="gamma is wrong by 1e+09 ulps"),
    cell("a condition with a name that is quite long, as some are", "double", "within", "elliptic", 0.0, None),
]
MATRIX = {
    "quick": True, "budget_ulps": 4.0, "rungs": PRECISIONS,
    "groups": {"fold": "Beside the fold", "elliptic": "The curve"},
    "counts": {"within": 6, "refused": 2, "failed": 1}, "cells": CELLS,
}  # fmt: skip


@pytest.fixture(scope="module")
def page():
    return extremes.html(MATRIX, {"chapsym": "0.1.0"}, "a machine")


def test_the_same_matrix_gives_the_same_page_with_nothing_from_outside_and_indices_lowered(page):
    assert page == extremes.html(MATRIX, {"chapsym": "0.1.0"}, "a machine")
    assert "http" not in page.replace("http-equiv", "")
    assert "<it>" not in page
    assert "&lt;it&gt;" in page
    matrix = MATRIX | {"groups": MATRIX["groups"] | {"fold": "The map G_h"}}
    shown = extremes.html(matrix, {"chapsym": "0.1.0"}, "a machine")
    assert shown.count("The map G<sub>h</sub>") == 1
    assert "G_h" not in shown


def test_a_sentence_is_said_once_for_all_that_it_is_about():
    found = extremes.reasons(CELLS)
    assert found[0] == f"– one ulp beyond it (single, double): {FOLDED}"
    assert found[1].startswith("✗ one ulp beyond it (double-double): gamma is wrong")


def test_what_a_cell_shows():
    assert extremes.shown(CELLS[0]) == "✓ 7.2"  # float32 has no more
    assert extremes.shown(CELLS[1]) == "✓ 15.5"
    assert extremes.shown(CELLS[5]) == "–"
    assert extremes.shown(CELLS[7]) == "✗"
    assert extremes.shown(CELLS[8]) == "✓ exact"
    assert "1 ulps of 4 promised; condition number 2.5" in extremes.shown(CELLS[0]).details


@pytest.mark.parametrize("size", shown.SIZES)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_in_a_browser(page, tmp_path, opened, size, scheme):
    path = tmp_path / "page.html"
    path.write_text(page, encoding="utf-8")
    tab = opened(path, shown.SIZES[size], color_scheme=scheme).tab
    assert tab.evaluate("document.documentElement.scrollWidth <= innerWidth")
    found = tab.eval_on_selector_all("td[data-verdict]", "all => all.map(x => x.dataset.verdict)")
    assert found == [c["verdict"] for c in CELLS]
    assert tab.locator("td.none").count() == 2  # and no columns where a group has none
    outside = tab.evaluate(
        """[...document.querySelectorAll('td, th, li')].filter(x => {
            const box = x.getBoundingClientRect();
            return box.width && (box.right > innerWidth + 1 || x.scrollWidth > box.width + 1);
        }).map(x => x.outerHTML.slice(0, 99))"""
    )
    assert outside == []
    assert low(tab, "td[data-verdict]") == ([], len(CELLS))
    assert tab.locator(".why").first.is_visible()
