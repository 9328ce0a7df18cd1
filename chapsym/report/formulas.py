"""LaTeX to MathML, such as a browser draws without a library and without the network.

A formula is cut where a line may break: prose in \\text{...} becomes prose of the page, and a comma with
a space after it ends a piece.  So long formulas wrap on a phone, and only a single long equation scrolls.
"""

import re
import unicodedata
import xml.etree.ElementTree as ET
from contextlib import suppress
from functools import cache
from itertools import pairwise
from typing import NamedTuple

from latex2mathml.converter import convert
from markupsafe import Markup

NAMESPACE = "http://www.w3.org/1998/Math/MathML"

#: How many children an element must have: a fraction with one is a formula that lost a part.
_ARITY = {"mfrac": 2, "msup": 2, "msub": 2, "mover": 2, "munder": 2, "mroot": 2, "msubsup": 3, "munderover": 3}
_OTHER = {"math", "mrow", "mi", "mn", "mo", "mtext", "mspace", "mstyle", "msqrt", "mtable", "mtr", "mtd", "mpadded"}
_ACCENTS = set("^~¯˙¨→ˇ´`")
_SLANTED = set("FTVWY")
_SIGNS = set("+−±∓")
_OPERATORS = set("⟨⟩±∓")  # the library takes them for letters
_CLOSING = set(")]}⟩|…")
_BRACKETS = set("()[]{}⟨⟩|")

#: The mathematical alphabets by their names in Unicode; browsers know no other way to them.
_ALPHABETS = {
    "bold": "BOLD", "bold-italic": "BOLD ITALIC", "script": "SCRIPT", "fraktur": "FRAKTUR",
    "double-struck": "DOUBLE-STRUCK",
}  # fmt: skip


class NotConverted(ValueError):
    """A formula that has no MathML here, with the reason."""


class Piece(NamedTuple):
    """A part of a formula between two places where a line may break."""

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
    """Cuts a formula at its prose and behind its commas, outside braces, \\left ... \\right and matrices."""
    _check_braces(latex)
    found: list[Piece] = []
    start = depth = 0
    for token in re.finditer(
        r"\\left|\\right|\\begin|\\end|\\text\{([^{}]*)\}|[,;:](\\ |\\quad|\\qquad)|\\.|[{}]", latex
    ):
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


def _check_braces(latex: str) -> None:
    depth = 0
    for token in re.findall(r"\\.|[{}]", latex, re.DOTALL):
        depth += {"{": 1, "}": -1}.get(token, 0)
        if depth < 0:
            break
    if depth:
        raise NotConverted("the braces do not match")


@cache
def mathml(latex: str) -> str:
    """One formula as MathML; raises NotConverted if anything of it was not understood."""
    _check_braces(latex)
    try:
        tree = ET.fromstring(convert(latex.strip()))
    except Exception as error:  # the library raises its own classes, and the parser its own
        raise NotConverted(f"{type(error).__name__} {error}".strip()) from error
    for element in tree.iter():
        element.tag = element.tag.removeprefix(f"{{{NAMESPACE}}}")
    _check(tree)
    _mend(tree)
    return ET.tostring(tree, encoding="unicode")


def _check(tree: ET.Element) -> None:
    for element in tree.iter():
        if element.tag not in _ARITY and element.tag not in _OTHER:
            raise NotConverted(f"an element <{element.tag}>")
        if len(element) != _ARITY.get(element.tag, len(element)):
            raise NotConverted(f"<{element.tag}> with {len(element)} parts")
        if "\\" in (element.text or ""):
            raise NotConverted(f"the command {element.text} is not known")
        if (element.text or "") in ("&", "}", "{") and element.tag == "mi":
            raise NotConverted(f"a stray {element.text}")


def _mend(tree: ET.Element) -> None:
    """What browsers need: letters of the alphabets, whole names, flat brackets, close accents."""
    tree.attrib.clear()
    tree.set("xmlns", NAMESPACE)
    tree.set("displaystyle", "true")
    for element in list(tree.iter("mi")):
        if element.text in _OPERATORS:
            element.tag = "mo"
    for element in list(tree.iter()):
        _join_names(element)
        variant = element.attrib.pop("mathvariant", None)
        if variant in _ALPHABETS:
            element.text = "".join(_letter(variant, x) for x in element.text or "")
        elif variant == "normal" and len(element.text or "") == 1:
            element.set("mathvariant", "normal")
        if not any(child.tag == "mtable" for child in element):
            for child in element:  # brackets keep their size, as TeX's do without \left and \right
                if child.tag == "mo" and child.text in _BRACKETS and "fence" not in child.attrib:
                    child.set("stretchy", "false")
        if element.tag == "mi" and len(element.text or "") == 1 and "Α" <= (element.text or "") <= "Ω":
            element.set("mathvariant", "normal")  # TeX's Greek capitals are upright
        if element.tag == "msup" and element[0].text in _SLANTED:
            row = ET.Element("mrow")  # browsers let the superscript of a slanted capital run into it
            row.extend([ET.Element("mspace", width="0.15em"), element[1]])
            element[1] = row
        if element.tag == "mover" and (element[1].text or " ") in _ACCENTS:
            element.set("accent", "true")
            element[1].set("stretchy", "false")
            if element[1].text == "→":
                element[1].set("mathsize", "50%")
    for element in list(tree.iter()):
        _space_after_names(element)
        _bind_signs(element)


def _join_names(element: ET.Element) -> None:
    """<mi>s</mi><mi>n</mi>, upright, is the one name <mi>sn</mi>."""
    letters = list(element)
    upright = all(x.tag == "mi" and x.get("mathvariant") == "normal" for x in letters)
    if element.tag == "mrow" and len(letters) > 1 and upright:
        element.text = "".join(x.text or "" for x in letters)
        element.tag = "mi"
        for letter in letters:
            element.remove(letter)


def _letter(variant: str, letter: str) -> str:
    """A letter of an alphabet; some, like ℝ, Unicode had before it had the alphabets."""
    plain = re.sub(r"LATIN |GREEK | LETTER", "", unicodedata.name(letter, "")) if letter.isalpha() else ""
    styled = f"{_ALPHABETS[variant]} {plain}"
    for name in (f"MATHEMATICAL {styled}", styled.replace("FRAKTUR", "BLACK-LETTER")):
        with suppress(KeyError):
            return unicodedata.lookup(name)
    return letter


def _space_after_names(element: ET.Element) -> None:
    """A thin space between the name of a function and its argument, as in sn u."""
    if element.tag != "mrow":
        return
    for index in range(len(element) - 1, 0, -1):
        if _is_name(element[index - 1]) and element[index].tag not in ("mo", "mspace"):
            element.insert(index, ET.Element("mspace", width="0.17em"))


def _bind_signs(row: ET.Element) -> None:
    """A sign behind another operator belongs to what follows: = -2, not = - 2."""
    for before, sign in pairwise(row):
        if sign.tag == "mo" and sign.text in _SIGNS:
            after_operator = (before.tag == "mo" and before.text not in _CLOSING) or before.tag == "mspace"
            sign.set("form", "prefix" if after_operator else "infix")


def _is_name(element: ET.Element) -> bool:
    if element.tag in ("msup", "msub", "mrow") and len(element):
        return _is_name(element[0]) and (element.tag != "mrow" or len(element) == 1)
    return element.tag == "mi" and len(element.text or "") > 1 and (element.text or "").isalpha()
