"""Names, comments and numbers in the syntax of Rocq."""

import re

#: The replacements of letters not allowed in identifiers; each begins with an underscore, and none is a prefix of
#: another.
ESCAPES = {"-": "__", ".": "_d", "_": "_u", "+": "_p", "^": "_h", "'": "_q"}
#: Words of Rocq, and names that the generated files use.
RESERVED = frozenset({
    "as", "at", "by", "cofix", "else", "end", "exists", "exists2", "fix", "for", "forall", "fun", "if", "in", "is",
    "let", "match", "mod", "of", "return", "then", "using", "where", "with", "IF", "Prop", "SProp", "Set", "Type",
    "Field", "R", "n", "field", "matrix", "Q", "identity", "some_point", "words", "traces", "trace", "square", "column",
    "row", "transposed", "unit_matrix", "zero_matrix", "integer", "rational", "zero", "one", "plus", "minus", "times",
    "opposite", "over", "inverse", "power", "Int", "Rat", "Var", "Sum", "Prod", "Pow", "Inv", "Equal", "Unequal",
    "Qmake", "Letter", "Unit", "Scaled", "Number", "Param", "SSum", "SProd", "Posz", "Negz", "true", "false",
    "eq_refl", "erefl", "conj", "I", "None", "Some", "mulrV", "mulr1",
})  # fmt: skip


def identifier(name: str) -> str:
    """A name as an identifier; different names have different identifiers."""
    plain = "".join(c if c.isascii() and c.isalnum() else ESCAPES.get(c, f"_x{ord(c):x}_") for c in name)
    return f"{plain}_r" if plain in RESERVED else plain


def apart(claim: str) -> str:
    """The id of a claim as a part of file names, with a mark after each capital, so that no two differ only in case."""
    return identifier(re.sub("([A-Z_])", r"\1_", claim))


def comment(text: str) -> str:
    """A text as a comment, without characters that would end it, open another comment or a string."""
    text = "".join(c if c.isprintable() else " " for c in text)
    while "(*" in text or "*)" in text:
        text = text.replace("(*", "( *").replace("*)", "* )")
    return f"(* {text.replace(chr(34), chr(39) * 2)} *)"


def integer(n: int) -> str:
    """An integer, in parentheses if negative."""
    return str(n) if n >= 0 else f"({n})"
