"""Programs for the tests of the generated code, and the functions of what is committed."""

import re

from chapsym.codegen import build
from chapsym.codegen.programs import Program
from chapsym.proofs.kernels import CONTACT, GAMMA

#: A kernel that a program may call.
TEXTS = {"twice": "def twice(a):\n    '''2a, and a²'''\n    t = a * a\n    return 2 * a, t\n"}


def program(text, outputs=("x",), floats=()):
    return Program("tried", "Tried.", (CONTACT, GAMMA), outputs, text, floats)


def text_of(target, name):
    """The head of a generated module and one of its functions."""
    head, *functions = re.split(r"\n\n\n(?=def )", (build.folder() / target.FILE).read_text(encoding="utf-8"))
    return head + "\n\n\n" + next(f for f in functions if f.startswith(f"def {name}("))
