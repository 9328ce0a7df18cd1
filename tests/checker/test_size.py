"""How much of the checker a reader of one claim has to read."""

import ast
import io
import sys
import tokenize
from pathlib import Path

import chapsym.proofs
from chapsym import checker

FOLDER = Path(chapsym.proofs.__file__).parent / "certificates" / "register"
#: The claims that the most of it judges; lines of code, without comments, docstrings and imports.
LONGEST, MOST = ("5.2", "4.9", "prop-1", "5.3-at-most-4", "remark-3"), 1600
LAYOUT = {tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.ENDMARKER}


def lines_of(file):
    """The lines of code of each function, by the line in which it begins; and those outside of functions, at 0."""
    text = Path(file).read_text("utf-8")
    tree, code, found = ast.parse(text), set(), {}
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        code |= set() if token.type in LAYOUT else set(range(token.start[0], token.end[0] + 1))
    for node in ast.walk(tree):
        is_text = isinstance(node, ast.Expr) and isinstance(getattr(node.value, "value", None), str)
        if is_text or isinstance(node, ast.Import | ast.ImportFrom):
            code -= set(range(node.lineno, node.end_lineno + 1))
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef):
            first = min([node.lineno, *(one.lineno for one in node.decorator_list)])
            found[first] = code & set(range(first, node.end_lineno + 1))
    return found | {0: code.difference(*found.values())}


def test_a_claim_is_judged_by_few_lines_of_code(thorough):
    """Those of the functions that are entered, and of their modules outside of functions."""
    known = {str(path): lines_of(path) for path in Path(checker.__file__).parent.glob("*.py")}
    for claim in LONGEST if thorough else LONGEST[:1]:
        data, entered = checker.read(FOLDER / checker.file_name(claim)), set()

        def enter(frame, event, _, entered=entered):
            if event == "call" and frame.f_code.co_filename in known:
                entered.add((frame.f_code.co_filename, frame.f_code.co_firstlineno))

        sys.setprofile(enter)
        try:
            checker.check(data)
        finally:
            sys.setprofile(None)
        functions = {(file, line) for file, first in entered for line in known[file].get(first, ())}
        whole = functions | {(file, line) for file, _ in entered for line in known[file][0]}
        assert MOST // 2 < len(whole) <= MOST, (claim, len(whole))
