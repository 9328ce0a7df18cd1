"""The plain text of the records: exact points and values, in groups for a reader, and as LaTeX."""

import ast
import re
import unicodedata
from collections.abc import Sequence
from itertools import takewhile

from chapsym import files

#: The notation of the paper for symbols in the points of the proofs.
_SYMBOLS = {
    "w": "ω", "g": "γ", "L": "Λ", "rho": "ρ", "gamma": "γ", "omega": "ω", "sigma": "σ", "epsilon": "ε", "k2": "k²",
    "Gamma": "Γ", "Omega": "Ω", "Lambda": "Λ", "delta": "δ", "theta": "θ",
    "sm": "sn ū", "cm": "cn ū", "dm": "dn ū", "sh": "sn δu", "ch": "cn δu", "dh": "dn δu",
    "R_-": "R_{k-1}", "R": "R_k", "R_+": "R_{k+1}", "r_-": "r_{k-1}", "r": "r_k", "r_+": "r_{k+1}",
    **{f"Omega{i}{i}": f"Ω_{{{i}{i}}}" for i in (1, 2, 3)},
}  # fmt: skip
#: Names with this meaning only next to the first one: the argument u, the parts of the relation for the increment, a
#: curve with rational amplitudes, and the root of the integral on the curve.
_BESIDE = {
    "sh": {"s": "sn u", "c": "cn u", "d": "dn u"},
    "Dscr": {"Dscr": "𝒟", "y": "sn²δu", "e": "cn²δu dn²δu", "w": "w(δu)", "lam": "l - μ sn²δu"},
    "lv": {
        "l": "Λ", "lv": "l", "kk": "k²", "size": "C", "sn1": "sn δu", "cn1": "cn δu", "dn1": "dn δu",
        "sn2": "sn ū", "cn2": "cn ū", "dn2": "dn ū",
    },
    "root": {"root": "r"},
}  # fmt: skip

Matrix = list[list[str]]


def point(values: dict[str, str], of_the_paper: bool = True) -> list[tuple[str, str]]:
    """The symbols of a point and their values, components gathered: J1, J2, J3 become J = (1, 2, 4)."""
    names = dict(_SYMBOLS) if of_the_paper else {}
    for sign, more in _BESIDE.items():
        if of_the_paper and sign in values:
            names |= more
    found: list[tuple[str, str]] = []
    done: set[str] = set()
    for symbol, value in values.items():
        if symbol in done or (symbol.removesuffix("^T") in values and symbol.endswith("^T")):
            continue
        stem = symbol.removesuffix("1")
        triple = [f"{stem}{i}" for i in (1, 2, 3)]
        if symbol != stem and all(x in values for x in triple):
            done.update(triple)
            found.append((names.get(stem, stem), f"({', '.join(str(values[x]) for x in triple)})"))
        else:
            found.append((names.get(symbol, symbol), str(value)))
    return found


def matrix(value: str) -> Matrix | None:
    """The rows of a value like [[0, -1], [1/2, 0]]; None for one that is no matrix."""
    text = value.strip()
    if not text.startswith("[["):
        return None
    try:
        rows = ast.literal_eval(re.sub(r"[^\[\],\s]+", lambda entry: repr(entry.group()), text))
    except (SyntaxError, ValueError):
        return None
    return rows if all(isinstance(row, list) and len(row) == len(rows[0]) for row in rows) else None


def value(text: str) -> str | Matrix:
    """A value as text, a column as a vector, a diagonal matrix by its diagonal, or the rows of a matrix."""
    if (rows := matrix(text)) is None:
        return text
    if len(rows[0]) == 1:
        return f"({', '.join(row[0] for row in rows)})"
    apart = {entry for i, row in enumerate(rows) for j, entry in enumerate(row) if i != j}
    if apart != {"0"} or len(rows) != len(rows[0]):
        return rows
    diagonal = [row[i] for i, row in enumerate(rows)]
    return "0" if set(diagonal) == {"0"} else f"diag({', '.join(diagonal)})"


def plain(text: str) -> str:
    """A value in one line: a matrix as [1 0; 0 1]."""
    return in_line(value(text))


def in_line(shown: str | Matrix) -> str:
    """The result of `value`, in one line."""
    return shown if isinstance(shown, str) else "[" + "; ".join(" ".join(row) for row in shown) + "]"


def sides(example: files.Data, compact: bool = False) -> tuple[list[str | Matrix], list[str | Matrix]]:
    """Both sides of a statement at a point; compact: of more than three entries only the different ones."""
    left, right = list(example["left"]), list(example["right"])
    if compact and len(left) > 3:
        apart = [(a, b) for a, b in zip(left, right, strict=True) if a != b]
        left, right = [a for a, _ in apart], [b for _, b in apart]
    return _vector(left), _vector(right)


def _vector(entries: Sequence[str]) -> list[str | Matrix]:
    values = [value(entry) for entry in entries]
    texts = [x for x in values if isinstance(x, str)]
    if len(values) > 1 and len(texts) == len(values):
        return [f"({', '.join(texts)})"]
    return values


def sign(example: files.Data) -> str:
    """The sign between the sides of a statement at a point; the right one may be words, as `at least 2`."""
    if example["left"] == example["right"]:
        return " ="
    words = r"(not|less than|at most|more than|at least) "
    return ", claimed:" if any(re.match(words, entry) for entry in example["right"]) else " ≠"


def differing(example: files.Data) -> bool:
    """Whether the compact form of the sides omits entries."""
    return len(example["left"]) > 3 and any(a == b for a, b in zip(example["left"], example["right"], strict=True))


# To Markdown.


def markdown(text: str) -> str:
    """Plain text in one line, in which nothing is a sign of Markdown."""
    signs = r"[\\`*\[$]|<(?=[A-Za-z/!?])|&(?=#?\w+;)|(?<![^\W_])_|~(?=~)|(?<=~)~|^[#>+=-]|#$|^\d+(?=[.)])"
    text = files.visible(" ".join(text.split()))
    return re.sub(signs, lambda sign: f"{sign[0]}\\" if sign[0].isdigit() else f"\\{sign[0]}", text)


def code(text: str) -> str:
    """Text as it is, in one line, between more of the signs that end it than it has."""
    text = files.visible(" ".join(text.split()))
    fence, apart = "`" * (1 + max(map(len, re.findall("`+", text)), default=0)), " " * ("`" in (text[:1], text[-1:]))
    return f"{fence}{apart}{text}{apart}{fence}"


# To LaTeX.  A word is prose if it has two letters or more and nothing specific to formulas.

_FUNCTIONS = ("sn", "cn", "dn", "tr", "Tr", "diag", "sign", "cos", "sin", "exp", "ln", "det", "div", "Ad")
_COMMANDS = {
    "×": r"\times", "·": r"\cdot", "⟨": r"\langle", "⟩": r"\rangle", "½": r"\tfrac12", "¼": r"\tfrac14",
    "∧": r"\wedge", "≠": r"\neq", "→": r"\to", "↦": r"\mapsto", "±": r"\pm", "∓": r"\mp", "≤": r"\le", "≥": r"\ge",
    "≡": r"\equiv", "∈": r"\in", "∂": r"\partial", "√": r"\surd", "∞": r"\infty", "…": r"\dots", "−": "-", "∫": r"\int",
    "≈": r"\approx", "∪": r"\cup", "⊂": r"\subset", "∇": r"\nabla", "∥": r"\parallel", "⊗": r"\otimes",
    "⇒": r"\Rightarrow", "⇔": r"\Leftrightarrow", "←": r"\leftarrow", "⊥": r"\perp", "∀": r"\forall", "∑": r"\sum",
    "∏": r"\prod",
    "⊢": r"\vdash", "∩": r"\cap", "∮": r"\oint", "∦": r"\nparallel", "ϱ": r"\varrho", "⌊": r"\lfloor", "⌋": r"\rfloor",
    "℘": r"\wp", "ϰ": r"\varkappa", "ε": r"\varepsilon", "ℝ": r"\mathbb R", "ℕ": r"\mathbb N", "ℂ": r"\mathbb C",
    "ℤ": r"\mathbb Z", "ℚ": r"\mathbb Q", "ℰ": r"\mathcal E", "ℱ": r"\mathcal F", "ℓ": r"\ell", "°": r"^{\circ}",
    "ϑ": r"\vartheta", "⅔": r"\tfrac23",
    "′": "'", "⅓": r"\tfrac13", "⅛": r"\tfrac18", "¾": r"\tfrac34", "∘": r"\circ", "∖": r"\setminus", "|": "|",
    "{": r"\{", "}": r"\}", "%": r"\%", "&": r"\&", "#": r"\#", "$": r"\$", "~": r"\sim", "\\": r"\backslash",
    "*": r"\ast", "^": r"\text{\textasciicircum}", "_": r"\_", "«": r"\text{``}", "»": r"\text{''}", "✓": r"\checkmark",
    "✗": r"\times",
}  # fmt: skip
_ACCENTS = {
    "\u0307": "dot", "\u0308": "ddot", "\u0304": "bar", "\u0303": "tilde", "\u0302": "widehat", "\u20d7": "vec",
    "~": "tilde",
}  # fmt: skip
_PROSE = {
    "\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "%": r"\%", "&": r"\&", "#": r"\#", "$": r"\$", "_": r"\_",
    "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "«": "``", "»": "''", "“": "``", "”": "''", "’": "'",
    "‘": "`", "–": "--", "—": "---", "ö": r'\"o', "é": r"\'e", "á": r"\'a", "ü": r'\"u', "ä": r'\"a', "è": r"\`e",
    "§": r"\S{}", "\u00a0": "~",
}  # fmt: skip
_SUPERSCRIPTS = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁽⁾ⁿᵀᵏˢˡ", "0123456789+-()nTksl", strict=True))
_SUBSCRIPTS = dict(zip("₀₁₂₃₄₅₆₇₈₉₊₋₍₎ₖᵢⱼₙ", "0123456789+-()kijn", strict=True))
#: The capitals that LaTeX has; the others look like Latin letters.
_CAPITALS = ("Gamma", "Delta", "Theta", "Lambda", "Xi", "Pi", "Sigma", "Upsilon", "Phi", "Psi", "Omega")


def latex(text: str) -> str:
    """Plain text with Unicode formulas as ASCII LaTeX, formulas in $...$; an unknown character is given by its code."""
    out: list[str] = []
    formula: list[str] = []

    def close() -> None:
        if formula:
            text = " ".join(formula)
            out.append(text if re.fullmatch(r"[\d.,() ]+", text) else f"${symbol_latex(text)}$")
            formula.clear()

    for word in text.split():
        if not _is_formula(word):
            close()
            out.append(_prose(word))
            continue
        formula.append(word.rstrip(".,;:") or word)
        ending = word[len(formula[-1]) :]
        opened = " ".join(formula)
        if ending == "," and any(opened.count(a) > opened.count(b) for a, b in ("()", "[]", "⟨⟩")):
            formula[-1] = word  # the comma between two arguments
        elif ending:
            close()
            out[-1] += ending
    close()
    return " ".join(out)


def _is_formula(word: str) -> bool:
    bare = word.strip(".,;:!?()[]«»\"'")
    if bare in ("", "A", "I", "sign"):
        return not bare and word not in (",", ".", ";", ":")
    if bare in _FUNCTIONS:
        return True
    if any(not x.isascii() and x not in _PROSE for x in bare) or re.search(r"[=+*/^_<>|⟨⟩\d]", bare):
        return not re.fullmatch(r"[\w.-]*[a-z]{3,}[\w.-]*", bare, re.ASCII)  # an id such as 2.5-inverse is prose
    return bool(re.fullmatch(r"-|-?[b-zA-Z]|[A-Z]{1,2}(\(.*)?|\W+", bare))


def _prose(word: str) -> str:
    return "".join(_PROSE.get(x, x if x.isascii() and x.isprintable() else _unknown(x)) for x in word)


def symbol_latex(text: str) -> str:
    """A symbol or a formula, without dollars; accents, super- and subscripts and fractions become commands."""
    text = "".join(unicodedata.normalize("NFD", x) if x.isalpha() else x for x in text).replace("...", "…")
    out, index, raised = "", 0, ""
    while index < len(text):
        taken, piece = _token(text, index)
        glue = " " if re.search(r"\\[a-zA-Z]+$", out) and piece[:1].isalpha() else ""
        if (mark := piece[0]) in "^_'":  # TeX takes one subscript, and one superscript, also a prime
            clash = "_" in raised if mark == "_" else "^" in raised or ("'" in raised and raised[-1] != "'")
            glue, raised = ("{}", mark) if clash else ("", raised + mark)
        else:
            raised = f"{raised} " if piece == " " else "_" if re.search(r"_\{\d+\}$", piece) else ""
        out += glue + piece
        index += taken
    return out


def _token(text: str, start: int) -> tuple[int, str]:
    """The length of the next piece, and the piece."""
    here = text[start:]
    for table, mark in ((_SUPERSCRIPTS, "^"), (_SUBSCRIPTS, "_")):
        if run := "".join(table[x] for x in takewhile(table.__contains__, here)):
            return len(run), f"{mark}{{{run}}}"
    name = re.match(r"[A-Za-z]+", here)
    if name and name.group() in _FUNCTIONS:
        return len(name.group()), f"\\operatorname{{{name.group()}}}"
    if name and len(name.group()) > 2:
        return len(name.group()), f"\\text{{{name.group()}}}"
    if index := re.match(r"([_^])(?:\{([^{}]*)\}|\(([^()]*)\)|([a-z]+|[^\W_]))", here):
        inner = next(x for x in index.groups()[1:] if x is not None)
        several = re.fullmatch(r"[a-z]{2,3}", inner)  # i, j, k, not a word
        return index.end(), f"{index.group(1)}{{{inner if several else symbol_latex(inner)}}}"
    base, taken = _character(here[0]), 1
    if here[0].isalpha() and here[1:2] in _ACCENTS:
        base, taken = f"\\{_ACCENTS[here[1]]}{{{base}}}", 2
    digits = re.match(r"\d+", here[taken:])
    if digits and here[0].isalpha():
        return taken + digits.end(), f"{base}_{{{digits.group()}}}"
    return taken, base


def _character(x: str) -> str:
    if x in _COMMANDS:
        return _COMMANDS[x]
    if x.isascii() and x.isprintable():
        return x
    name = unicodedata.name(x, "")
    greek = re.fullmatch(r"GREEK (SMALL|CAPITAL) LETTER ([A-Z]+)", name.replace("LAMDA", "LAMBDA"))
    if greek and greek.group(1) == "SMALL":
        return f"\\{greek.group(2).lower()}"
    if greek and greek.group(2).capitalize() in _CAPITALS:
        return f"\\{greek.group(2).capitalize()}"
    styled = re.fullmatch(r"MATHEMATICAL (SCRIPT|BOLD|DOUBLE-STRUCK) (CAPITAL|SMALL) ([A-Z])", name)
    if styled:
        command = {"SCRIPT": "mathcal", "BOLD": "mathbf", "DOUBLE-STRUCK": "mathbb"}[styled.group(1)]
        letter = styled.group(3) if styled.group(2) == "CAPITAL" else styled.group(3).lower()
        return f"\\{command}{{{letter}}}"
    return _unknown(x)


def _unknown(x: str) -> str:
    return f"\\text{{[U+{ord(x):04X}]}}"


def formula_latex(text: str) -> str:
    """A formula that is LaTeX already, in dollars and in ASCII."""
    return rf"$\displaystyle {''.join(x if x.isascii() else f'{{{_character(x)}}}' for x in text)}$"


def typed_latex(text: str) -> str:
    """A command, or a name, as typed."""
    return _prose(text).replace("--", "-{}-")


def code_latex(text: str) -> str:
    """The same, in the letters of a typewriter."""
    return rf"\texttt{{{typed_latex(text)}}}"


def value_latex(text: str) -> str:
    """A value of a point as a formula, without dollars."""
    return shown_latex(value(text))


def shown_latex(shown: str | Matrix) -> str:
    """The result of `value` as a formula: a matrix in small type, a rational unchanged, a break after each comma."""
    if isinstance(shown, str):
        return symbol_latex(shown).replace(", ", r",\allowbreak\ ")
    rows = r"\\".join("&".join(symbol_latex(x) for x in row) for row in shown)
    return rf"\left(\begin{{smallmatrix}}{rows}\end{{smallmatrix}}\right)"
