"""The pages of the lab and of the judge, in the colours that the reader's system has."""

import pytest
from contrast import low

from chapsym.show import rendered
from chapsym.show.drawing.style import new, styled


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_page_can_be_read_in_light_and_dark_and_its_figures_change_with_it(tmp_path, opened, scheme):
    with styled():
        figure, (axes,) = new("")
        axes.plot([0, 1], [0, 1])
    table = "<table><tr><th>file<td>1<br><small>from 1 s on</small></table>"
    path, template = tmp_path / "page.html", tmp_path / "template.html"
    body = f"<p>Said.</p>{table}{figure.svg()}"
    template.write_text(f'{{% extends "document.html" %}}{{% block body %}}{body}{{% endblock %}}', encoding="utf-8")
    path.write_text(rendered(template, title="<Two>"), encoding="utf-8")
    tab = opened(path, color_scheme=scheme).tab
    assert tab.title() == "<Two>"
    poor, seen = low(tab, "h1, p, th, td, small")
    assert (poor, seen) == ([], 5)
    ground = tab.evaluate("getComputedStyle(document.body).backgroundColor")
    assert ground == {"light": "rgb(252, 252, 250)", "dark": "rgb(20, 23, 26)"}[scheme]
    changed = tab.evaluate("getComputedStyle(document.querySelector('svg')).filter")
    assert changed == {"light": "none", "dark": "invert(0.92) hue-rotate(180deg)"}[scheme]
