"""A few records by hand: one of each verdict, with everything that evidence may carry."""

import copy
from functools import cache, partial

import chromium
import pytest
import shown

CHECK = {"statement": "printed: a_k = -b", "holds": False, "method": "exact arithmetic"}
SIDES = {"statement": "a_k = -b", "left": ["1", "2/3"], "right": ["1", "-2/3"]}
EXAMPLE = {
    "point": {"J1": "1", "J2": "2", "J3": "4", "gamma": "[[0], [0], [1]]", "sh": "3/5", "s": "4/5"},
    "printed": [SIDES],
    "corrected": [{**SIDES, "right": ["1", "2/3"]}],
}


def make(id, verdict, printed="a = b", corrected=None, seconds=0.25, **evidence):
    base = {
        "title": f"The title of {id}.", "hypotheses": [], "condition": None, "derivation": [], "checks": [],
        "controls": [], "counterexamples": [], "uses": [], "downstream": [], "problems": [],
        "open_in_paper": False,
    }  # fmt: skip
    return {
        "id": id, "verdict": verdict, "printed": printed, "corrected": corrected, "evidence": base | evidence,
        "seconds": seconds,
    }  # fmt: skip


RECORDS = [
    make("5.4", "corrected", r"a = \tfrac12 b", r"a = \tfrac14 b", checks=[CHECK], counterexamples=[EXAMPLE],
         controls=[{"statement": "a = 3b", "rejected": True}], uses=["2.1"], downstream=["prop-3", "5.7"],
         derivation=["γ is <b>not</b> bold", "  ✗ printed: a = b"], hypotheses=["h ≠ 0"],
         witnesses=[{"name": "equal J", "point": {"J1": "1", "J2": "1", "J3": "1"}, "statements": 3}],
         routes=[{"name": "mpmath", "statements": ["a = b at 50 digits"], "holds": True}])
    | {"fingerprint": "0123456789abcdef"},
    make("2.1", "holds", r"v = \rho\,\omega\times\gamma"),
    make("prop-3", "conditional", r"\langle\gamma\rangle", r"\langle\gamma\rangle", condition="q is real",
         counterexamples=[EXAMPLE], uses=["5.4"]),
    make("5.7", "refuted", "a > b", true_statement="a is at most b", counterexamples=[EXAMPLE], uses=["5.4"]),
    make("6.lr", "settled", r"\mu", answer="There is no such measure.", measured=["a gap of 1e-28"],
         conjectures=["never"],
         certificates=[{"file": "c.json", "statement": "two signs", "digest": "0", "accepted": True}]),
    make("3.1", "definition", r"\mathcal D", reason="It names the principle."),
    make("3.5", "definition", "E", reason="It names the energy."),
    make("5.9", "open", "u = f(s)", tried=["a polynomial ansatz"], open_in_paper=True),
]  # fmt: skip


@pytest.fixture
def handmade():
    """Eight records, one for each verdict; a fresh copy for every test."""
    return copy.deepcopy(RECORDS)


@pytest.fixture
def record():
    """Makes one record."""
    return make


@pytest.fixture(scope="session")
def register(records):
    """The records of every claim, in the order in which they are proved."""
    return list(records.values())


@pytest.fixture(scope="session")
def launch():
    """Launches a browser with some flags."""
    executable = chromium.path()
    from playwright.sync_api import sync_playwright

    with sync_playwright() as driver:
        yield partial(driver.chromium.launch, executable_path=executable, headless=True, timeout=chromium.PATIENCE)


@pytest.fixture(scope="session")
def tabs(launch):
    """The tabs of the two browsers, with and without WebGL, by their options; made when they are first asked for."""
    browser = cache(lambda webgl: launch(args=shown.WEBGL if webgl else shown.PLAIN))
    return cache(lambda webgl, **options: shown.Shown(browser(webgl), **options))


@pytest.fixture
def opened(tabs):
    """Opens a page afresh in a window of some size; in the end it has said nothing and asked for nothing but itself."""
    used = {}

    def open_page(path, size=shown.DESK, webgl=False, **options):
        page = tabs(webgl, **options)
        used[id(page)] = page
        page.tab.set_viewport_size(size)
        page.load(path)
        return page

    yield open_page
    for page in used.values():
        assert page.leave() == []
