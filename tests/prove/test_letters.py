"""No letter has a meaning in the prover: a verdict does not depend on how symbols are called."""

import json
import random
import subprocess
import sys
from pathlib import Path

import sympy as sp

from chapsym.derive.words import WordAlgebra, matrix_symbols
from chapsym.proofs import CLAIMS, LEMMAS
from chapsym.prove import Equation, Proof, Verdict


def test_renaming_every_letter_changes_no_verdict(request, records, lemmas):
    """One claim of numbers, one of words, and all in `make thorough`; by other names where the seed is another."""
    seed = 52
    chosen = [*CLAIMS, *LEMMAS]
    if not request.config.getoption("--thorough"):
        chosen = random.Random(seed).sample(chosen, 2)
    command = [sys.executable, Path(__file__).with_name("renamed.py"), str(seed), *chosen]
    answer = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)
    known = {**records, **lemmas}
    assert answer["renamed"] > 30
    assert answer["found"] == {id: [known[id]["verdict"], []] for id in chosen}


def judged(algebra, left, right):
    proof = Proof()
    proof.printed(Equation("true", left, right, algebra))
    proof.control(Equation("false", left, 2 * right, algebra))
    return proof, proof.verdict()


def test_matrices_are_found_for_letters_by_what_is_said_of_them():
    P, PT, Z, S, A, B, AB = matrix_symbols("P P^T Z S A B AB")
    algebra = WordAlgebra({P: PT, PT: P, Z: -Z, S: S}, {(P, PT): 1, (PT, P): 1, (A, B): AB})
    proof, verdict = judged(algebra, algebra.transpose(PT * Z * P + S * Z), -PT * Z * P - Z * S)
    assert verdict is Verdict.HOLDS
    point = {name: sp.Matrix(sp.sympify(value)) for name, value in proof.witnesses[0]["point"].items()}
    assert point["P"] * point["P^T"] == sp.eye(3)
    assert point["Z"] == -point["Z"].T != sp.zeros(3, 3)


def test_an_example_says_how_large_its_letters_are():
    """A letter that chapsym's own derivations have, of another size."""
    (J,) = matrix_symbols("J")
    algebra = WordAlgebra({}, {(J, J): -1}, {J: sp.Matrix([[0, -1], [1, 0]])})
    assert judged(algebra, J**4, sp.S.One)[1] is Verdict.HOLDS


def test_rules_that_no_matrices_were_found_for_are_no_proof():
    A, B = matrix_symbols("A B")
    algebra = WordAlgebra({A: A, B: -B}, {(A, A): -1})  # a symmetric matrix of rational numbers has no such square
    proof, verdict = judged(algebra, A * A * B, -B)
    assert verdict is Verdict.OPEN
    assert "no witness" in proof.problems[0]
