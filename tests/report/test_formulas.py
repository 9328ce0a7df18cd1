"""LaTeX to MathML: everything of the register converts, and what does not is shown as it is."""

import re
import xml.etree.ElementTree as ET

import pytest

from chapsym.report import formulas


def shape(latex):
    """The MathML without its namespace and the outer row."""
    text = formulas.mathml(latex).replace(f' xmlns="{formulas.NAMESPACE}"', "")
    return re.fullmatch(r'<math displaystyle="true"><mrow>(.*)</mrow></math>', text).group(1)


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
        (r"\tfrac DF", '<mstyle displaystyle="false" scriptlevel="0"><mfrac><mi>D</mi><mi>F</mi></mfrac></mstyle>'),
        (r"\mathcal G_h", "<msub><mi>𝒢</mi><mi>h</mi></msub>"),
        (r"\mathcal{D}", "<mi>𝒟</mi>"),
        (r"\mathcal E\mathcal H", "<mi>ℰ</mi><mi>ℋ</mi>"),
        (r"\mathbf K", "<mi>𝐊</mi>"),
        (r"\boldsymbol\omega", "<mi>𝝎</mi>"),
        (r"\boldsymbol\Omega", "<mi>𝜴</mi>"),
        (r"\mathbb R\mathbb L", "<mi>ℝ</mi><mi>𝕃</mi>"),
        (r"\mathfrak g", "<mi>𝔤</mi>"),
        (r"\Lambda\gamma", '<mi mathvariant="normal">Λ</mi><mi>γ</mi>'),
        (r"\widehat J", '<mover accent="true"><mi>J</mi><mo stretchy="false">^</mo></mover>'),
        (r"\dots", "<mo>…</mo>"),
        (r"\langle x\rangle", '<mo stretchy="false">⟨</mo><mi>x</mi><mo stretchy="false">⟩</mo>'),
        (r"\mathrm{sn}^2\bar u", '<msup><mi>sn</mi><mn>2</mn></msup><mspace width="0.17em" />'
                                 '<mover accent="true"><mi>u</mi><mo stretchy="false">¯</mo></mover>'),
        (r"\mathrm{sn}(u)", '<mi>sn</mi><mo stretchy="false">(</mo><mi>u</mi><mo stretchy="false">)</mo>'),
        (r"x = -2", '<mi>x</mi><mo>=</mo><mo form="prefix">−</mo><mn>2</mn>'),
        (r"(x) - 2",
         '<mo stretchy="false">(</mo><mi>x</mi><mo stretchy="false">)</mo><mo form="infix">−</mo><mn>2</mn>'),
        (r"\begin{pmatrix}1&2\\3&4\end{pmatrix}",
         "<mo>(</mo><mtable><mtr><mtd><mn>1</mn></mtd><mtd><mn>2</mn></mtd></mtr>"
         "<mtr><mtd><mn>3</mn></mtd><mtd><mn>4</mn></mtd></mtr></mtable><mo>)</mo>"),
    ],
)  # fmt: skip
def test_what_the_paper_needs_is_rendered(latex, expected):
    assert shape(latex) == expected


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
        (r"\nonsense x", "the command \\nonsense is not known"),
        ("{a", "the braces do not match"),
        ("a}{b", "the braces do not match"),
        (r"\frac{1}", "mfrac"),
        ("x^", "Missing"),
        ("a & b", "not well-formed"),
        (r"{\text{<script>x</script>}}", "an element"),
    ],
)
def test_what_does_not_convert_shows_its_source_and_says_so(latex, reason):
    html = formulas.html(latex)
    assert html.startswith('<code class="latex">')
    assert "not converted" in html
    assert reason in html.unescape()
    assert latex in html.unescape()
    assert "<script" not in html
