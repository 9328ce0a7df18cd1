"""Judges claims with every letter of the derivations and the proofs renamed at random; prints their verdicts.

python renamed.py SEED [ID ...]
"""

import json
import random
import sys

from sympy.core.symbol import Symbol

SEED, *IDS = sys.argv[1:]
NAMES, RANDOM, MADE = {}, random.Random(int(SEED)), Symbol.__new__


def of_the_register():
    """Whether a symbol is made by a derivation or a proof, through whatever of SymPy."""
    frame = sys._getframe(2)
    while frame and frame.f_globals.get("__name__", "").startswith("sympy"):
        frame = frame.f_back
    return bool(frame) and frame.f_globals.get("__name__", "").startswith(("chapsym.derive", "chapsym.proofs"))


def renamed(cls, name, **assumptions):
    if cls is Symbol and of_the_register():
        name = NAMES.setdefault(name, f"{RANDOM.choice('abcxyzPQRW')}{RANDOM.randrange(10**7, 10**8)}")
    return MADE(cls, name, **assumptions)


Symbol.__new__ = staticmethod(renamed)

from chapsym.prove import PROOFS  # noqa: E402

claims = PROOFS.load(lemmas=True)
found = {}
for id in IDS or claims:
    judgement = claims[id].judge().certified()
    found[id] = [judgement.verdict, judgement.proof.problems]
json.dump({"renamed": len(NAMES), "found": found}, sys.stdout)
