"""The page, as HTML: it says everything that the records say, needs nothing else, and survives what is broken."""

import re
from html.parser import HTMLParser
from itertools import pairwise

import pytest
from contrast import contrast

from chapsym.report import page, records

VERSIONS = {"chapsym": "0.1.0", "sympy": "1.14.0", "python-flint": "0.9.0"}
VOID = {"meta", "br", "hr", "input", "link", "img", "col"}


class Outline(HTMLParser):
    """Ids, links, texts, and whether every element is closed."""

    def __init__(self, text):
        super().__init__()
        self.open, self.ids, self.links, self.headings, self.attributes = [], [], [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.attributes.append((tag, attributes))
        self.ids += [attributes["id"]] if "id" in attributes else []
        self.links += [attributes["href"]] if "href" in attributes else []
        self.headings += [tag] if re.fullmatch("h[1-6]", tag) else []
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


@pytest.fixture(scope="module")
def whole(register):
    return page.html(register, VERSIONS)


def article(text, id):
    return re.search(rf'<article class="claim [^>]*id="claim-{re.escape(id)}".*?</article>', text, re.DOTALL).group()


def test_the_page_is_well_formed_its_links_lead_somewhere_and_it_needs_nothing_from_outside(whole):
    outline = Outline(whole)
    assert outline.open == []
    assert len(outline.ids) == len(set(outline.ids))
    assert all(link.startswith("#") for link in outline.links)
    assert {link[1:] for link in outline.links} <= set(outline.ids)
    assert outline.headings.count("h1") == 1
    levels = [int(heading[1]) for heading in outline.headings]
    assert all(b <= a + 1 for a, b in pairwise(levels)), "a level of heading is skipped"
    assert not any("src" in attributes or tag == "link" for tag, attributes in outline.attributes)
    addresses = set(re.findall(r"https?://[^\s\"'<]+", whole))
    assert addresses <= {"http://www.w3.org/1998/Math/MathML"}, "names of namespaces only"
    assert "@import" not in whole
    assert "url(" not in whole
    assert "default-src 'none'" in whole


#: What of the evidence is a list on the page.
LISTED = ("checks", "controls", "witnesses", "problems", "tried", "certificates", "measured", "conjectures")


def test_every_claim_is_there_with_its_verdict(whole, register):
    for record in register:
        text = article(whole, record["id"])
        assert f'<span class="badge {record["verdict"]}">{record["verdict"]}</span>' in text
        assert f"chapsym prove {record['id']} --explain" in text
        evidence = record["evidence"]
        lists = [evidence.get(name) or [] for name in LISTED]
        lists += [route["statements"] for route in evidence.get("routes") or []]
        assert text.count("<li") == sum(map(len, lists))
    assert "not converted" not in whole
    assert 'class="failure"' not in whole


def test_the_errata_are_in_the_order_of_the_paper(whole, register):
    assert re.findall(r'<tr id="erratum-([^"]+)"', whole) == [r["id"] for r in records.errors(register)]
    row = re.search(r'<tr id="erratum-2.5-inverse".*?</tr>', whole, re.DOTALL).group()
    assert "(14, −13, 22)" in row
    assert "(334/49, −1165/49, 22/49)" in row
    assert '<a class="id" href="#claim-2.5">2.5</a>' in row
    assert row.count('class="formula"') == 2
    row = re.search(r'<tr id="erratum-5.1".*?</tr>', whole, re.DOTALL).group()
    assert re.findall(r'<span class="side">([^<]*)</span>', row) == ["12/25", "4/5"], "of nine entries what differs"
    assert "(what differs)" in row


def test_the_page_is_the_same_for_the_same_records(whole, register):
    assert page.html(register, VERSIONS) == whole
    assert not re.search(r"\b20[12]\d-\d\d-\d\d\b", whole)


def test_everything_that_evidence_may_carry_is_shown(handmade):
    text = page.html(handmade, VERSIONS)
    assert "is &lt;b&gt;not&lt;/b&gt; bold" in article(text, "5.4")
    for said in (
        "Witnesses and degenerate cases: equal J", "3 statements evaluated at", "J = (1, 1, 1)",
        "Second routes: mpmath", "agrees",
        "1 statement decided, 1 control rejected", "a<sub>k</sub> = −b — fails", "By exact arithmetic", "0.25 s",
        "≠</span> 0", "a = 3b: rejected", "fingerprint 0123456789ab<",
    ):  # fmt: skip
        assert said in article(text, "5.4"), said
    assert '<span class="tag">if</span> <div>q is real</div>' in article(text, "prop-3")
    assert "a is at most b" in article(text, "5.7")
    settled = article(text, "6.lr")
    assert re.findall(r"no such measure|c\.json|two signs|not proved|1e-28|Conjectured|never", settled) == [
        "no such measure", "c.json", "two signs", "not proved", "1e-28", "Conjectured", "never",
    ]  # fmt: skip
    assert "It names the principle." in article(text, "3.1")
    opened = re.search(r'<section id="open".*?</section>', text, re.DOTALL).group()
    assert "The paper leaves this open." in opened
    assert "a polynomial ansatz" in opened
    assert "There is no such measure." in opened.partition("Open in the paper, settled here")[2]


def test_an_open_claim_is_told_at_the_top_and_a_control_that_was_accepted_is_not_called_rejected(handmade, record):
    text = page.html([*handmade, record("4.1", "open", problems=["the proof has no negative control"])], VERSIONS)
    assert re.search(r'class="failure">Not proved: <a href="#claim-4.1">4.1</a>', text)
    assert "the proof has no negative control" in article(text, "4.1")
    assert "The paper states this; it is not proved here." in text
    controls = [{"statement": "a", "rejected": False}]
    text = article(page.html([record("2.1", "open", controls=controls)], VERSIONS), "2.1")
    assert "ACCEPTED" in text
    assert "1 control rejected" not in text


def test_a_broken_section_tells_its_error_and_the_rest_stays(handmade, monkeypatch):
    whole = page.html(handmade, VERSIONS)
    for name, (title, _) in page.SECTIONS.items():
        with monkeypatch.context() as patched:
            patched.setitem(page.SECTIONS, name, (title, "no ink <left>"))
            text = page.html(handmade, VERSIONS)
        assert f"<strong>{title} could not be written.</strong> TemplateNotFound: " in text
        assert "no ink &lt;left&gt;" in text
        assert text.count('class="failure"') == 1
        for other in set(page.SECTIONS) - {name}:
            section = rf'<section id="{other}".*?(?=<section id=|</main>)'
            assert re.search(section, text, re.DOTALL).group() == re.search(section, whole, re.DOTALL).group()


def test_a_broken_claim_tells_its_error_and_absent_evidence_is_none(handmade):
    handmade[1]["evidence"]["checks"] = [{"text": "no such key"}]
    text = page.html(handmade, VERSIONS)
    assert '<div class="failure" id="claim-2.1" role="alert">' in text
    assert "Claim 2.1 could not be written." in text
    assert text.count('class="failure"') == 1
    assert "0.25 s" in article(text, "5.4")
    bare = {"id": "2.1", "verdict": "holds", "printed": "x", "evidence": {"title": "It holds."}}
    text = page.html([bare], VERSIONS)
    assert 'class="failure"' not in text
    assert "It holds." in article(text, "2.1")


def test_plain_text_has_indices_and_true_minus_signs_and_a_matrix_is_a_formula():
    assert page.prose("R_(k+1) = C1 - 2, m_{k-1}") == "R<sub>k+1</sub> = C<sub>1</sub> − 2, m<sub>k−1</sub>"
    assert page.prose("q₀²-1, (p-e3), 1-(D/2), k-1") == "q₀²−1, (p−e<sub>3</sub>), 1−(D/2), k−1"
    assert page.prose("n-dimensional <x> (5.12-q0), prop-1") == "n-dimensional &lt;x&gt; (5.12-q0), prop-1"
    assert page.prose("1.6e7 steps of float64, D1 and e3") == "1.6e7 steps of float64, D<sub>1</sub> and e<sub>3</sub>"
    assert page.prose("Φ_ε, ε_j H₁") == "Φ<sub>ε</sub>, ε<sub>j</sub> H₁"
    assert page.code("`a_b` is **not** a_b") == "<code>a_b</code> is <b>not</b> a<sub>b</sub>"
    shown = page.value("[[0, -1/2], [1, 0]]")
    assert "<mtable " in shown
    assert "<mn>1</mn><mn>2</mn></mfrac>" in shown


def test_each_verdict_has_colours_that_can_be_read_in_light_and_in_dark():
    style = (page.FOLDER / "style.css").read_text(encoding="utf-8")
    for verdict in records.VERDICTS:
        assert f".{verdict} {{ --v: var(--{verdict}); }}" in style
        assert style.count(f"--{verdict}: #") == 2, "one for light, one for dark"
    for root in re.findall(r":root \{(.*?)\}", style, re.DOTALL)[:2]:
        colours = dict(re.findall(r"--([a-z]+): (#[0-9a-f]{6});", root))
        for name in ("ink", "muted", "link", *records.VERDICTS):
            for background in ("paper", "raised"):
                assert contrast(colours[name], colours[background]) >= 4.5, (name, background)
