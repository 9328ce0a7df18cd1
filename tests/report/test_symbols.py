"""The table of symbols: one source, and every letter of the paper that means several things."""

import re
from inspect import signature
from pathlib import Path

import pytest

from chapsym.report import symbols

ROOT = Path(__file__).parents[2]

#: How many meanings of each letter must be told apart.
CLASHES = {
    "J": 2, "D": 1, "𝒟": 2, "d": 1, "k": 4, "l": 4, "n": 2, "F": 2, "F^k": 1, "Λ": 1, "Λ_k": 1, "μ": 2, "μ(u)": 1,
    "q": 3, "w": 1, "w(δu)": 1, "W(u)": 1, "σ": 1, "ϰ": 1, "h": 2, "γ": 1, "γ⃗": 1, "r": 1, "m": 1, "m_k": 1, "M": 1,
    "M_k": 1, "K": 1, "𝐊": 1, "𝒦": 1, "p": 1, "e1": 1, "G": 1, "𝒢_h": 1, "Γ": 1, "f": 1, "f^k": 1, "V": 1, "v": 1,
    "C": 1, "C1": 1, "𝒞": 1, "u": 1, "s": 3,
}  # fmt: skip


def test_every_row_of_the_document_is_read():
    text = (ROOT / "docs" / "symbols.md").read_text(encoding="utf-8")
    assert len(symbols.SYMBOLS) == len(re.findall(r"^\| ", text, re.MULTILINE)) - 1
    assert all(row.paper and row.where and row.meaning for row in symbols.SYMBOLS)
    assert "|Λω|" in [row.meaning for row in symbols.SYMBOLS]


@pytest.mark.parametrize("letter", CLASHES)
def test_the_meanings_of_a_letter_are_told_apart(letter):
    rows = [row for row in symbols.SYMBOLS if letter in row.paper.split(", ")]
    assert len(rows) >= CLASHES[letter]
    assert len({(row.where, row.meaning) for row in rows}) == len(rows)


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
