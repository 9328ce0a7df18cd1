"""Certificates of kind register-claim: those of the repository are accepted, and nothing that is changed in them."""

import copy
import json
import os
import random
import subprocess
import sys
from pathlib import Path

import pytest
from budget import slow
from certificate_changes import at, refused
from count_changes import counts
from derivation_changes import derivations
from register_arithmetic import arithmetic
from register_changes import CHANGES, SAMPLES, changed, leaves, slip, small

import chapsym.proofs
from chapsym import checker
from chapsym.checker import Rejected, check, read, shown
from chapsym.checker.__main__ import main
from chapsym.checker.trees import check_name

FOLDER = Path(chapsym.proofs.__file__).parent / "certificates" / "register"
CHECKER = Path(checker.__file__).parent


@pytest.fixture(scope="module")
def samples():
    return {id: read(FOLDER / checker.file_name(id)) for id in SAMPLES}


def test_the_register_is_accepted_where_there_is_only_python(tmp_path):
    """One of the files, and its counts; `make verify` judges all."""
    command = [sys.executable, "-I", "-S", str(CHECKER), "--json", str(FOLDER / checker.file_name("2.5"))]
    run = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    [verdict] = json.loads(run.stdout)["certificates"]
    assert verdict["accepted"]
    assert verdict["statement"].startswith(
        "Claim 2.5 (corrected).  parts of its formulas that are read: 2; identities of numbers: 3"
    )


@pytest.mark.thorough
def test_every_certificate_is_accepted():
    """`.ci/run` and `make verify` judge the same files; here their statements are counted."""
    claims = [*chapsym.proofs.CLAIMS, *chapsym.proofs.LEMMAS]
    assert {path.name for path in FOLDER.iterdir()} == set(map(checker.file_name, claims))
    numbers = [check(read(FOLDER / checker.file_name(id))).numbers for id in claims]
    assert sum(int(n.get("refuted", 0)) for n in numbers) == 45
    assert sum(int(n.get(role, 0)) for n in numbers for role in checker.register.ROLES) == 835


def test_changes_of_one_number_sign_operation_or_name_are_rejected(samples, thorough):
    """Nothing of an identity or of its proof can be changed alone; the digest and the counts fit the change.

    Twenty changes are some of each certificate, of each kind of number and in each part of a proof.
    """
    rng = random.Random(18)
    for _ in range(3000 if thorough else 20):
        data, path = slip(samples[rng.choice(SAMPLES)], rng)
        assert refused(data), (data["claim"], path)


#: Of each table one takes as long as all others.
LARGE, LONG = "a product with too many terms", "a long chain"


@pytest.mark.parametrize("name", [*(name for name in CHANGES if name != LARGE), *slow(LARGE)])
def test_what_is_false_or_out_of_form_is_rejected_in_one_sentence(samples, name):
    id, change = CHANGES[name]
    data = changed(samples[id], change)
    with pytest.raises(Rejected) as caught:
        check(data)
    assert 10 < len(str(caught.value)) < 220
    assert "\n" not in str(caught.value)


def test_a_name_has_at_most_forty_letters():
    check_name("a" * 40, "the register")
    with pytest.raises(Rejected, match="the register has an invalid name"):
        check_name("a" * 41, "the register")


SMALL, SMALL_AND_WRONG = (a | b | c for a, b, c in zip(small(), derivations(), counts(), strict=True))


@pytest.mark.parametrize("name", SMALL)
def test_small_certificates_that_are_right(name):
    check(SMALL[name])


@pytest.mark.parametrize("name", [*(name for name in SMALL_AND_WRONG if name != LONG), *slow(LONG)])
def test_small_certificates_that_are_wrong(name):
    assert refused(SMALL_AND_WRONG[name])


def test_the_arithmetic_and_its_bounds():
    arithmetic("chapsym.checker")


def test_the_id_of_another_claim_is_another_statement(samples):
    with pytest.raises(Rejected, match="the statement is not the one"):
        check(samples["5.4"] | {"claim": "5.11"})


def test_a_change_of_anything_is_seen_by_the_digest(samples):
    rng = random.Random(5)
    for data in samples.values():
        path = rng.choice(list(leaves(data)))
        other = copy.deepcopy(data)
        at(other, path[:-1])[path[-1]] = "another text"
        with pytest.raises(Rejected):
            check(other)


def test_a_pipe_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(checker.Unreadable, match="is a pipe"):
        checker.read(tmp_path / "pipe")


def test_a_file_that_is_too_large_is_not_read(tmp_path):
    (tmp_path / "large.json").write_bytes(b" " * 8_000_001)
    with pytest.raises(checker.Unreadable, match="more than 8000000 bytes"):
        read(tmp_path / "large.json")


def test_what_was_judged_is_shown_and_one_change_is_seen(samples):
    """The formulas that a reader sees are made from the trees that were judged, and no two of these look alike."""
    rng = random.Random(11)
    for _ in range(60):
        id = rng.choice([id for id in SAMPLES if samples[id]["statements"]])
        data, path = slip(samples[id], rng)
        if {"cofactors", "chart", "combinations"}.isdisjoint(path):
            assert [*shown.lines(data)] != [*shown.lines(samples[id])], (id, path)
    for data in (samples[id] for id in SAMPLES):
        heads = [line for line in shown.lines(data) if "[in algebra " in line]
        said = ["which only words of the formula say" in head for head in heads]
        assert said == [bool(one.get("words")) for one in data["statements"]]
    difference = ["+", "a", ["*", -1, ["+", "b", ["*", -2, "c"]]], ["^", ["+", "a", "1/2"], -1], -3]
    assert shown.formula(difference) == "a - (b + (-2)·c) + (a + 1/2)^(-1) - 3"
    assert shown.formula(["^", ["*", -1, "a"], 2]) == "(-a)^2"
    assert shown.formula(["*", "a", ["*", -1, "b"], ["^", ["^", "1/2", 2], 3]]) == "a·(-b)·((1/2)^2)^3"


def test_the_derivation_of_a_claim_is_shown(capsys):
    lines = [*shown.lines(read(FOLDER / "prop-1.json"))]
    rolling = "[(4.2) for virtual displacements, dr + ρ dR Rᵀ γ: it vanishes; in algebra 0]"
    assert f"rolling = dr + rho·dR·R^T·gamma    {rolling}" in lines
    dual = "[it vanishes when the variation does for every skew ξ; in algebra 1]"
    assert f"balance_c = dual of work by xi    {dual}" in lines
    assert "    before = -Omega^T·momentum·Omega" in lines
    assert main(["--show", str(FOLDER / "2.5.json")]) == 0
    printed = capsys.readouterr().out.splitlines()
    assert {f"  {line}" for line in shown.lines(read(FOLDER / "2.5.json"))} < {*printed}
