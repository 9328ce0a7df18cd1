"""LaTeX to MathML: everything of the register converts, and what does not is shown as it is."""

import re
import xml.etree.ElementTree as ET

import pytest

from chapsym.report import formulas


def test_every_formula_of_the_register_converts_and_no_letter_is_lost(register):
    """The digits and brackets of a formula are those of its source: nothing is dropped on the way."""
    printed = [(r["id"], latex) for r in register for latex in (r["printed"], r["corrected"]) if latex]
    assert len(printed) >= 105
    for id, latex in printed:
        html = formulas.html(latex)
        assert "unconverted" not in html, (id, html)
        assert "\\" not in html, (id, html)
        assert not re.search(r"<m(i|o|n|text)\s*/>|mathvariant=\"(?!normal)|merror", html), (id, html)
        source = re.sub(r"\\(?!text|math|operator)[A-Za-z]+|\\(text|mathrm|mathbf|mathcal|mathbb)", " ", latex)
        shown = re.sub(r"<[^>]*>", "", html)
        kinds = r"[\d[\]]" if "pmatrix" in latex else r"[\d()[\]]"
        assert re.findall(kinds, shown) == re.findall(kinds, source), id


@pytest.mark.parametrize(
    ("latex", "expected"),
    [
        (r"\tfrac DF", '<mfrac displaystyle="false"><mi>D</mi><mi>F</mi></mfrac>'),
        (r"\mathcal G_h", "<msub><mrow><mspace/><mi>𝒢\ufe00</mi></mrow><mi>h</mi></msub>"),
        (r"\mathcal{D}", "<mrow><mspace/><mi>𝒟\ufe00</mi></mrow>"),
        (r"\mathbf K", "<mi>𝐊</mi>"),
        (r"\boldsymbol\omega", "<mi>𝝎</mi>"),
        (r"\mathbb R\mathbb L", "<mi>ℝ</mi><mi>𝕃</mi>"),
        (r"\mathfrak g", "<mi>𝔤</mi>"),
        (r"\Lambda\gamma", '<mrow><mspace/><mi mathvariant="normal">Λ</mi></mrow><mi>γ</mi>'),
        (r"\langle x\rangle", '<mo stretchy="false">⟨</mo><mi>x</mi><mo stretchy="false">⟩</mo>'),
        (r"\mathrm{sn} u", '<mrow><mrow><mspace/><mi>sn</mi></mrow><mo lspace="0.1667em">\u2061</mo><mi>u</mi></mrow>'),
        (r"x = -2", '<mi>x</mi><mo>=</mo><mo lspace="0" rspace="0">−</mo><mn>2</mn>'),
        (r"x \text{ and}\ ", "<mi>x</mi><mtext>\u00a0and</mtext>"),
    ],
)  # fmt: skip
def test_what_the_paper_needs_is_rendered(latex, expected):
    assert formulas.mathml(latex) == f'<math displaystyle="true">{expected}</math>'


def test_prose_inside_a_formula_is_prose_of_the_page_and_escaped():
    html = formulas.html(r"K = h\gamma \text{ with } h \text{ constant}")
    assert '<span class="prose"> with </span>' in html
    assert "mtext" not in html
    assert "<b>" not in formulas.html(r"\text{<b>bold</b>} x")
    ET.fromstring(formulas.mathml("x < y"))


def test_a_line_may_break_behind_a_comma_but_not_in_braces():
    found = formulas.pieces(r"a,\ b_{i,\ j},\quad \left(c,\ d\right)")
    assert [piece.text for piece in found] == ["a,", r"b_{i,\ j},", r" \left(c,\ d\right)"]
    matrix = r"\begin{pmatrix}a,\ b & \text{any}\end{pmatrix}"
    assert [piece.text for piece in formulas.pieces(matrix)] == [matrix]


@pytest.mark.parametrize(
    ("latex", "reason"),
    [
        (r"\nonsense x", 'Unknown command "\\nonsense"'),
        ("{a", 'Expected closing token "}"'),
        ("a}{b", "Unmatched closing token"),
        (r"\frac{1}", "Expected argument"),
        ("a & b", 'Found "&"'),
        (r"\text{<script>x</script>}^", "Expected argument"),
    ],
)
def test_what_does_not_convert_shows_its_source_and_says_so(latex, reason):
    html = formulas.html(latex)
    assert html.startswith('<code class="latex">')
    assert "not converted" in html
    assert reason in html.unescape()
    assert latex in html.unescape()
    assert "<script" not in html
