"""LaTeX to MathML that browsers draw without a library and without the network.

A formula is cut where a line may break: prose in \\text{...} becomes prose of the page, and a comma with
a space after it ends a piece.  So long formulas wrap on a phone, and only a single long equation scrolls.
"""

import re
from functools import cache
from typing import NamedTuple

from markupsafe import Markup
from math_core import LatexError, LatexToMathML

_CONVERTER = LatexToMathML(fancy_error=False)
#: The name of a function: it has a space before its argument, as in sn u.
_NAME = re.compile(r"\\mathrm(?=\{[A-Za-z]{2})")


class NotConverted(ValueError):
    """A formula that has no MathML here, with the reason."""


class Piece(NamedTuple):
    """A part of a formula between two possible line breaks."""

    kind: str  # "math" or "prose"
    text: str


def html(latex: str) -> Markup:
    """The formula for the page; one that cannot be converted shows its source, and says so."""
    try:
        parts = [_piece_html(piece) for piece in pieces(latex)]
    except NotConverted as error:
        note = Markup('<span class="unconverted">not converted: {}</span>').format(str(error))
        return Markup('<code class="latex">{}</code> {}').format(latex, note)
    return Markup('<span class="formula">{}</span>').format(Markup("").join(parts))


def _piece_html(piece: Piece) -> Markup:
    if piece.kind == "prose":
        return Markup('<span class="prose">{}</span>').format(piece.text)
    return Markup('<span class="piece">{}</span> ').format(Markup(mathml(piece.text)))


def pieces(latex: str) -> list[Piece]:
    """Splits a formula at its prose and after its commas, outside braces, \\left ... \\right and matrices."""
    found: list[Piece] = []
    start = depth = 0
    tokens = r"\\left|\\right|\\begin|\\end|\\text\{([^{}]*)\}|[,;:](\\ |\\quad|\\qquad)|\\.|[{}]"
    for token in re.finditer(tokens, latex):
        here = token.group()
        depth += {"{": 1, "\\left": 1, "\\begin": 1, "}": -1, "\\right": -1, "\\end": -1}.get(here, 0)
        if depth or token.start() < start:
            continue
        if here.startswith("\\text{"):
            found += [Piece("math", latex[start : token.start()]), Piece("prose", token.group(1))]
            start = token.end()
        elif here[0] in ",;:":
            found.append(Piece("math", latex[start : token.start() + 1]))
            start = token.end()
    found.append(Piece("math", latex[start:]))
    return [piece for piece in found if piece.text.strip(" ~") not in ("", "\\ ", "\\quad")]


def is_whole(latex: str) -> bool:
    """Whether a formula can be read, so that LaTeX ends it where it ends, and obeys nothing else in it."""
    odd = r"[%$#]|\\(?:\w*def|let|\w*command|input)(?![a-zA-Z])|\\text\{[^{}]*[_^&~\\]"
    try:
        return bool(mathml(latex)) and latex.isprintable() and not re.search(odd, re.sub(r"\\[^a-zA-Z]", "", latex))
    except NotConverted:
        return False


@cache
def mathml(latex: str) -> str:
    """One formula as inline MathML; raises NotConverted if a part of it is not understood."""
    try:
        named = _NAME.sub(r"\\operatorname", latex.removesuffix("\\ ").strip())
        found = _CONVERTER.convert_with_local_state(named, displaystyle=True)
    except LatexError as error:
        raise NotConverted(str(error)) from None
    inline = found.replace('display="block"', 'displaystyle="true"', 1)
    return inline.replace("&ApplyFunction;", "\N{FUNCTION APPLICATION}")
