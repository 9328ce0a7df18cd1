"""Points and statements: grouped for a reader, and as ASCII LaTeX."""

from xml.etree import ElementTree

import pytest

from chapsym import files
from chapsym.report import notation


@pytest.mark.parametrize(
    ("values", "shown"),
    [
        ({"J1": "1", "J2": "2", "J3": "4", "D": "3", "w1": "1", "w2": "0", "w3": "-1", "q0": "4/5", "g1": "2"},
         [("J", "(1, 2, 4)"), ("D", "3"), ("ω", "(1, 0, -1)"), ("q0", "4/5"), ("g1", "2")]),
        # A transpose beside its vector says nothing new; short names have their meaning by their neighbours.
        ({"gamma": "1", "gamma^T": "1", "Gamma": "1"}, [("γ", "1"), ("Γ", "1")]),
        ({"s": "1"}, [("s", "1")]),
        ({"s": "4/5", "sh": "3/5", "k2": "1/2"}, [("sn u", "4/5"), ("sn δu", "3/5"), ("k²", "1/2")]),
        ({"Dscr": "1", "y": "2"}, [("𝒟", "1"), ("sn²δu", "2")]),
        ({"l1": "3", "l2": "2", "l3": "1", "lv": "1/2", "size1": "1", "size2": "2", "size3": "3", "sn2": "0"},
         [("Λ", "(3, 2, 1)"), ("l", "1/2"), ("C", "(1, 2, 3)"), ("sn ū", "0")]),
        ({"root": "1", "Omega11": "1"}, [("r", "1"), ("Ω_{11}", "1")]),
    ],
)  # fmt: skip
def test_components_of_a_point_are_gathered(values, shown):
    assert notation.point(values) == shown


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("-3/5", "-3/5"),
        ("e3", "e3"),
        ("[[0], [-4/5], [1]]", "(0, -4/5, 1)"),
        ("[[1, 0], [0, 2]]", "diag(1, 2)"),
        ("[[0, 0], [0, 0]]", "0"),
        ("[[0, 1/2], [-1, 0]]", [["0", "1/2"], ["-1", "0"]]),
        ("[[1, 2], [3]]", "[[1, 2], [3]]"),
        ("[[1, 2", "[[1, 2"),
    ],
)
def test_values_are_text_vectors_or_matrices(text, shown):
    """A matrix is small in LaTeX."""
    assert notation.value(text) == shown
    if isinstance(shown, list):
        assert notation.value_latex(text) == r"\left(\begin{smallmatrix}0&1/2\\-1&0\end{smallmatrix}\right)"


def test_a_side_in_words_is_claimed_and_no_value():
    sides = [("1", "1"), ("1", "2"), ("0", "at least 2"), ("0", "not 0"), ("0", "sn δu")]
    signs = [" =", " ≠", ", claimed:", ", claimed:", " ≠"]
    assert [notation.sign({"left": [a], "right": [b]}) for a, b in sides] == signs


def test_compact_sides_keep_what_differs():
    example = {"left": ["1", "2", "3", "4"], "right": ["1", "2", "3", "5"]}
    assert notation.sides(example) == (["(1, 2, 3, 4)"], ["(1, 2, 3, 5)"])
    assert notation.sides(example, compact=True) == (["4"], ["5"])
    assert notation.differing(example)
    short = {"left": ["1", "2"], "right": ["1", "3"]}
    assert notation.sides(short, compact=True) == (["(1, 2)"], ["(1, 3)"])
    assert not notation.differing(short)


@pytest.mark.parametrize(
    ("text", "latex"),
    [
        ("Λω = K - (D/F)⟨γ, Λ⁻¹K⟩γ",
         r"$\Lambda\omega = K - (D/F)\langle\gamma, \Lambda^{-1}K\rangle\gamma$"),
        ("The sign of K(ω, γ) is wrong.", r"The sign of $K(\omega, \gamma)$ is wrong."),
        ("γ~1 - γ1 = (2C1/𝒟) sn ū",
         r"$\tilde{\gamma}_{1} - \gamma_{1} = (2C_{1}/\mathcal{D}) \operatorname{sn} \bar{u}$"),
        ("R_kᵀγ_(k+1), Ω_{k-1}", r"$R_{k}^{T}\gamma_{k+1}$, $\Omega_{k-1}$"),
        ("Ṙ R̈ ω̇ 𝒦⃗", r"$\dot{R} \ddot{R} \dot{\omega} \vec{\mathcal{K}}$"),
        ("h ≠ 0: then ½q₀² ≤ 1", r"$h \neq 0$: then $\tfrac12q_{0}^{2} \le 1$"),
        ("In Section 2 and (4.3), as 2.5-inverse says", "In Section 2 and (4.3), as 2.5-inverse says"),
        ("100% of «a_b» & «more»", r"$100\%$ of $\text{``}a_{b}\text{''} \&$ ``more''"),
        ("日", r"$\text{[U+65E5]}$"),
        ("r1_k²' ᵀ", "$r_{1}{}_{k}^{2}{}' {}^{T}$"),
        ("x^ and a bell\x07", r"$x\text{\textasciicircum}$ and a bell\text{[U+0007]}"),
    ],
)  # fmt: skip
def test_plain_text_becomes_latex(text, latex):
    assert notation.latex(text) == latex


def test_everything_that_the_register_says_has_ascii_latex(register):
    for record in register:
        evidence = record["evidence"]
        texts = [evidence["title"], *evidence["hypotheses"], *(check["statement"] for check in evidence["checks"])]
        for text in texts:
            latex = notation.latex(text)
            assert latex.isascii(), (record["id"], latex)
            assert "U+" not in latex, (record["id"], latex)
            assert latex.count("$") % 2 == 0
            assert latex.count("{") == latex.count("}"), (record["id"], latex)
        for example in evidence["counterexamples"]:
            for symbol, value in notation.point(example["point"]):
                for latex in (notation.symbol_latex(symbol), notation.value_latex(value)):
                    assert latex.isascii(), (record["id"], symbol, latex)
                    assert "U+" not in latex


MARKED = [
    "<b>",
    "&lt;",
    "`x` ``",
    "[l](j)",
    "a_b _c_",
    "*d*",
    "$e$",
    "~~f~~",
    "1. g",
    "# h #",
    "\\\\",
    "> i\n\n- j",
    "\x07",
]


@pytest.mark.parametrize("words", [*MARKED, "\x07", " ".join(MARKED)])
def test_nothing_in_words_is_markdown(words):
    reader = pytest.importorskip("markdown_it").MarkdownIt("commonmark").enable("strikethrough")
    shown = files.visible(" ".join(words.split()))
    for written, tags in (("{}", "p"), ("## {}", "h2"), ("- {}", "ul li"), ("- {}", "ul li code")):
        text = notation.code(words) if "code" in tags else notation.markdown(words)
        page = ElementTree.fromstring(f"<page>{reader.render(written.format(text))}</page>")
        assert [one.tag for one in page.iter()] == ["page", *tags.split()]
        assert "".join(page.itertext()).strip() == shown
