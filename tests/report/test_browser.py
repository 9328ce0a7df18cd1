"""The page in a real browser, from disk: what it shows is what the records say, on a desk and on a phone."""

import io
import re

import numpy as np
import pytest
import shown
from budget import slow
from contrast import contrast, low
from matplotlib import image

from chapsym.report import page, records


@pytest.fixture(scope="session")
def written(register, tmp_path_factory):
    path = tmp_path_factory.mktemp("report") / "page.html"
    path.write_text(page.html(register, {"chapsym": "0.1.0"}), encoding="utf-8")
    return path


@pytest.fixture(params=["desk", *slow("phone")])
def tab(request, written, opened):
    """The page, loaded afresh."""
    return opened(written, shown.SIZES[request.param], has_touch=request.param == "phone").tab


def claims(tab):
    return tab.eval_on_selector_all("#claims .claim:not([hidden])", "found => found.map(x => x.dataset.id)")


def test_the_verdicts_are_counted_and_formulas_and_letters_can_be_read(tab, register):
    counts = tab.eval_on_selector_all(
        ".segment", "found => found.map(x => [x.dataset.verdict, Number(x.querySelector('b').innerText)])"
    )
    assert dict(counts) == records.counts(register)
    sizes = tab.eval_on_selector_all(
        ".errata math", "found => found.map(x => x.getBoundingClientRect()).map(r => [r.width, r.height])"
    )
    assert len(sizes) >= 58
    assert [size for size in sizes if min(size) < 2] == []
    letters = tab.evaluate(
        "document.querySelector('.graph').getBoundingClientRect().width"
        " / document.querySelector('.graph').viewBox.baseVal.width"
        " * parseFloat(getComputedStyle(document.querySelector('.node text')).fontSize)"
    )
    assert letters >= 11


@pytest.mark.parametrize("tab", ["phone", *slow("desk")], indirect=True)
def test_the_page_is_not_wider_than_the_window_even_unfolded(tab):
    tab.evaluate("document.querySelectorAll('details').forEach(x => { x.open = true; })")
    assert tab.evaluate("document.documentElement.scrollWidth <= innerWidth")
    outside = tab.evaluate(
        """[...document.querySelectorAll('main *')].filter(x => {
            const box = x.getBoundingClientRect();
            return box.width && box.right > innerWidth + 1 && !x.closest('.scroll, .graph, .chips, thead');
        }).map(x => x.outerHTML.slice(0, 120))"""
    )
    assert outside == []


@pytest.mark.parametrize("scheme", ["light", *slow("dark")])
def test_a_wide_formula_on_a_phone_shows_at_which_end_there_is_more(written, opened, scheme):
    tab = opened(written, shown.PHONE, has_touch=True, color_scheme=scheme).tab
    wide = tab.locator(".errata .scroll, .claim .scroll").filter(visible=True)
    overflows = wide.evaluate_all("all => all.map(x => x.scrollWidth > x.clientWidth + 40)")
    assert sum(overflows) > 20
    for box, more in ((wide.nth(overflows.index(True)), True), (wide.nth(overflows.index(False)), False)):
        for start in (True, False):
            box.evaluate("(x, start) => { x.scrollLeft = start ? 0 : 1e6; }", start)
            picture = image.imread(io.BytesIO(box.screenshot()))[..., :3].mean(axis=2)
            # Between the letters, the ground; at an end with more to see, a shadow in every row.
            ends = [np.abs(np.median(picture[:, column]) - np.median(picture)) for column in (2, -3)]
            assert [bool(end > 0.1) for end in ends] == [more and not start, more and start]


@pytest.mark.parametrize("scheme", ["light", *slow("dark")])
def test_controls_and_letters_can_be_told_from_what_they_stand_on(written, opened, scheme):
    tab = opened(written, color_scheme=scheme).tab
    tab.evaluate("document.querySelectorAll('details').forEach(x => { x.open = true; })")
    found, count = low(tab, "a, button, input, summary, p, li, dt, dd, th, td, pre, .badge, .tag, .heading")
    assert found == []
    assert count > 1000
    tab.locator(".chips button").first.click()
    assert low(tab, ".tools *")[0] == []
    style = (page.FOLDER / "style.css").read_text(encoding="utf-8")
    lit = re.search(r"\.graph\.lit \.node \{ opacity: ([\d.]+)", style)
    ink, paper = (tab.evaluate(f"getComputedStyle(document.body).{name}") for name in ("color", "backgroundColor"))
    ink, paper = ([int(x) / 255 for x in re.findall(r"\d+", colour)] for colour in (ink, paper))
    faint = [float(lit[1]) * x + (1 - float(lit[1])) * y for x, y in zip(ink, paper, strict=True)]
    assert contrast(faint, paper) >= 4.5


def test_the_filter_the_search_and_a_folded_derivation_show_what_is_asked_for(tab, register):
    corrected = [r["id"] for r in records.in_paper_order(register) if r["verdict"] == "corrected"]
    tab.locator(".segment.corrected").click()
    assert claims(tab) == corrected
    assert tab.locator("output.shown").inner_text() == f"{len(corrected)} of {len(register)}"
    assert tab.locator(".chips [aria-pressed=true]").get_attribute("data-verdict") == "corrected"
    tab.locator(".chips button").first.click()
    assert len(claims(tab)) == len(register)
    field = tab.locator(".tools input")
    field.fill("5.12-kappa")
    assert "5.12-kappa" in claims(tab)
    field.fill("the power AND the sign")
    assert claims(tab) == ["5.16-weierstrass-w"]
    field.fill("Gröbner")
    assert 1 < len(claims(tab)) < len(register)
    field.fill("no such words")
    assert claims(tab) == []
    tab.evaluate("location.hash = '#claim-5.4'")
    tab.wait_for_function("!document.getElementById('claim-5.4').hidden")
    assert len(claims(tab)) == len(register)
    derivation = tab.locator('[id="claim-5.4"] details:has(> summary:text-is("Derivation")) pre')
    assert not derivation.is_visible()
    tab.locator('[id="claim-5.4"] summary', has_text="Derivation").click()
    assert derivation.is_visible()


def test_a_claim_of_the_graph_is_highlighted_and_its_neighbours_are_named_from_the_keyboard_too(tab, register):
    node = tab.locator('.node[data-id="5.12"]')
    node.scroll_into_view_if_needed()
    node.click()
    near = tab.eval_on_selector_all(".arc.near", "found => found.map(x => [x.dataset.from, x.dataset.to])")
    uses, users = records.uses(register), records.users(register)
    expected = [[id, "5.12"] for id in uses["5.12"]] + [["5.12", id] for id in users["5.12"]]
    assert sorted(near) == sorted(expected)
    assert tab.locator(".picked h3").inner_text() == "5.12"
    named = tab.eval_on_selector_all(".picked .down a", "found => found.map(x => x.innerText)")
    record = next(r for r in register if r["id"] == "5.12")
    assert sorted(named) == sorted(record["evidence"]["downstream"])
    assert tab.locator(".picked").is_visible()
    tab.locator('.node[data-id="5.4"]').focus()
    assert tab.locator(".picked h3").inner_text() == "5.4"
    tab.keyboard.press("Tab")
    assert tab.locator(".picked h3").inner_text() != "5.4"
