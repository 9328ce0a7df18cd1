"""The table of symbols: one source, and every letter of the paper that means several things."""

import re
from inspect import signature
from pathlib import Path

from chapsym.report import symbols

ROOT = Path(__file__).parents[2]


def test_every_row_of_the_document_is_read():
    text = (ROOT / "docs" / "symbols.md").read_text(encoding="utf-8")
    assert len(symbols.SYMBOLS) == len(re.findall(r"^\| ", text, re.MULTILINE)) - 1
    assert all(row.paper and row.where and row.meaning for row in symbols.SYMBOLS)
    assert "|Λω|" in [row.meaning for row in symbols.SYMBOLS]


def test_the_names_of_chapsym_are_those_of_the_program():
    import chapsym

    names = {row.chapsym.strip("`()").split("`")[0] for row in symbols.SYMBOLS if row.chapsym}
    ball = chapsym.Ball(mass_tensor=(1, 2, 4), D=3)
    run = chapsym.roll(
        chapsym.Ball.from_inertia((0.03, 0.0312, 0.0318), mass=7.0, radius=0.1), omega=(2.0, 30.0, 5.0), time_step=1e-3,
        steps=1, contact=True,
    )  # fmt: skip
    step = chapsym.step(ball, momentum=(1, -0.5, 0.75), gamma=(2 / 7, 3 / 7, 6 / 7))
    parameters = {name for call in (chapsym.Ball.from_inertia, chapsym.roll) for name in signature(call).parameters}
    known = {name for thing in (ball, run, step, chapsym) for name in dir(thing)} | parameters | {"inertia"}
    assert names <= known, names - known
