"""The claims as theorems of Rocq: all that is proved is written, and where Rocq is, it accepts what is true only."""

import errno
import json
import os
import re
import shutil
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest
from commands import chapsym, refused
from committed import register

from chapsym import proofs
from chapsym.checker import file_name
from chapsym.prove.rocq import quotients, words, write
from chapsym.prove.rocq.claims import COUNT, SAME
from chapsym.prove.rocq.names import comment, identifier

ROOT = Path(__file__).resolve().parents[2]
REGISTER = Path(proofs.__path__[0]) / "certificates" / "register"
needs_rocq = pytest.mark.skipif(not shutil.which("coqc"), reason="coqc is not here: no theorem is judged")


def certificate(id):
    return json.loads((REGISTER / file_name(id)).read_text(encoding="utf-8"))


def rocq(folder, *targets):
    """What Rocq says of some files."""
    return subprocess.run(["make", "-C", folder, *targets], capture_output=True, text=True)


def test_every_statement_that_says_something_is_a_theorem(tmp_path):
    data = list(register().values())
    written = write(data, tmp_path)
    statements = [one for claim in data for one in claim["statements"] if "refuted" not in one]
    assert set(written.left_out) == {SAME, COUNT}
    assert written.left_out[COUNT] == sum(len(claim["counts"]) for claim in data)
    page = (ROOT / "docs" / "how-to" / "rocq.md").read_text(encoding="utf-8")
    numbers = re.search(r"(\d+) theorems of (\d+) claims: (\d+) statements, (\d+) points .*\n.* (\d+) counter", page)
    kinds = (written.theorems[name] for name in ("statements", "points", "counterexamples"))
    assert [*map(int, numbers.groups())] == [written.theorems.total(), written.claims, *kinds]
    assert written.left_out[SAME] >= sum(one["left"] == one["right"] for one in statements)
    assert written.theorems["statements"] == len(statements) + written.left_out[COUNT] - written.left_out.total()
    assert written.theorems["counterexamples"] == sum(len(claim["counterexamples"]) for claim in data)
    texts = [path.read_text(encoding="utf-8") for path in tmp_path.glob("claim_*.v")]
    names = [name for text in texts for name in re.findall(r"^Theorem (\w+)", text, re.MULTILINE)]
    assert len(names) == len(set(names)) == written.theorems.total()
    assert sum(text.count("Left out, because") for text in texts) == written.left_out.total()
    core = {"prop-1", "prop-2", "prop-3", "prop-4", "remark-3", *(f"5.{i}" for i in (1, 2, 3, 4, 6, 15))}
    assert all(any(f"claim_{identifier(id)}_statement" in name for name in names) for id in core)


def test_python_alone_writes_the_theorems_and_a_full_disk_leaves_no_part_of_one(tmp_path, monkeypatch):
    (tmp_path / "register").mkdir()
    shutil.copy(REGISTER / file_name("prop-2"), tmp_path / "register")
    command = [sys.executable, "-S", "-m", "rocq", tmp_path / "register", tmp_path / "whole"]
    alone = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    subprocess.run(command, cwd=ROOT / "chapsym" / "prove", env=alone, check=True)
    whole = {path.name: path.read_text(encoding="utf-8") for path in (tmp_path / "whole").iterdir()}

    def half(path, text, encoding):
        path.write_bytes(text[:9].encode(encoding))
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "write_text", half)
    with pytest.raises(OSError, match="No space left"):
        write([certificate("prop-2")], tmp_path / "whole")
    left = {path.name: path.read_text(encoding="utf-8") for path in (tmp_path / "whole").iterdir()}
    assert all(whole[name] == text for name, text in left.items() if not name.endswith(".part"))


def test_names_of_parts_are_what_they_stand_for(tmp_path):
    write([certificate("resonance")], tmp_path)
    text = (tmp_path / "claim_resonance.v").read_text(encoding="utf-8")
    assert "forall (Field : field) (X Y _u1 : Field),\n  _u1 = (X * Y) :> Field ->\n" in text
    assert "exists X Y _u1 : Field,\n  (_u1 = (X * Y) :> Field) /\\\n" in text  # and can be that


def test_a_trace_has_the_transposes_of_its_letters(tmp_path):
    write([certificate("prop-2"), certificate("2.15-measure")], tmp_path)
    texts = [(tmp_path / f"claim_{id}_words.v").read_text(encoding="utf-8") for id in ("prop__2", "2_d15__measure")]
    assert (
        "forall (R : comUnitRingType) (n : nat) (K : 'M[R]_n),\n  2%:R \\is a @GRing.unit R ->\n  K^T = - K ->\n"
        "  \\tr (K *m K *m K) = 0.\n"
    ) in texts[0]
    assert "= \\tr (v^T *m eta *m gamma)." in texts[1]


def test_a_refuted_statement_is_false_with_its_definitions_and_of_its_traces(tmp_path):
    traced, named = certificate("prop-2"), certificate("resonance")
    points = []
    for data, at in ((traced, 5), (named, 2)):
        one = data["statements"][at]
        points.append(data["points"][one.pop("point")])
        one["refuted"], one["role"] = 0, "printed"
        data["counterexamples"] = [{"point": points[-1], "hypotheses": [], "refutes": [at], "agrees": []}]
    write([traced, named], tmp_path)
    matrices, text = (
        (tmp_path / f"claim_{name}.v").read_text(encoding="utf-8").partition("_counterexample_0")[2]
        for name in ("prop__2_matrices", "resonance")
    )
    assert "~ (((trace (K * K * K)) == (0 # 1))%Q)" in matrices
    assert "(X * Y) + ((/ (X * Y)) * #(-1))" in text
    assert "_u1" not in text


def test_the_command_writes_the_theorems_of_a_claim(tmp_path):
    options = ("--jobs", "1", "--records", tmp_path / "v.jsonl", "--rocq", tmp_path / "made")
    assert "claims: 1, theorems: 4; make -C" in chapsym("prove", "5.11", *options).stderr
    write([certificate("5.11")], tmp_path / "kept")
    made, kept = (
        {path.name: path.read_bytes() for path in (tmp_path / folder).iterdir()} for folder in ("made", "kept")
    )
    assert made == kept


@pytest.mark.parametrize("name", ["Makefile", "claim_mine.v", "Points.v", "summary.txt"])
def test_a_folder_with_other_files_is_refused_and_keeps_them(tmp_path, name):
    write([certificate("5.11")], tmp_path)
    (tmp_path / "mine.v").write_text("mine", encoding="utf-8")
    write([certificate("4.7")], tmp_path)
    (tmp_path / name).write_text("mine", encoding="utf-8")
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert not any("5_d11" in name for name in before)
    assert f"{name}: it is not from chapsym prove --rocq" in refused("prove", "5.11", "--rocq", tmp_path)
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_without_rocq_one_sentence_says_what_to_install(tmp_path):
    for tool in ("bash", "make"):
        (tmp_path / tool).symlink_to(shutil.which(tool))
    found = subprocess.run(
        ["make", "-s", "rocq"], cwd=ROOT, env={"PATH": str(tmp_path)}, capture_output=True, text=True
    )
    assert found.returncode != 0
    assert found.stdout.startswith("Rocq is not installed, so nothing was judged; on Debian: apt install coq")


def test_a_text_cannot_end_its_comment():
    assert comment('f*) "g (**) \n h') == "(* f* ) ''g ( ** )   h *)"


def test_sums_and_powers_are_what_they_say():
    letters = {"A": (0, ("n", "n"), "A"), "B": (1, ("n", "n"), "B")}
    algebra = words.Algebra(letters, {}, 1)
    assert algebra.matrix(["+", "A", ["^", "B", 2]])[0] == "(A + (B *m B))"
    assert quotients.value(["^", ["+", "x", 1], 3], {"x": "1/2"}) == Fraction(27, 8)


def test_words_that_are_numbers_are_left_out():
    data = certificate("prop-2")
    one, algebra = data["statements"][0], data["algebras"][0]
    point = {name: [[1, 0], [0, 1]] for name in algebra["letters"]}
    with pytest.raises(words.LeftOut, match="of no size"):
        words.statement("numbers", one | {"left": [["^", 2, 2]], "right": [4]}, algebra, point)


def test_names_stay_apart():
    names = ["R", "R_", "R_r", "R_+", "R_-", "R^T", "R.", "R-", "R__", "R_u", "Rᵀ", "forall", "forall_r", "zero"]
    assert len({identifier(name) for name in names}) == len(names)
    assert all(re.fullmatch(r"[A-Za-z]\w*", identifier(name), re.ASCII) for name in names)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """In which Rocq judges each library once."""
    return tmp_path_factory.mktemp("rocq")


@needs_rocq
@pytest.mark.thorough  # `make rocq`, which CI runs where Rocq is, has all claims accepted
def test_rocq_accepts_a_quotient_words_traces_names_and_matrices_without_an_axiom(folder):
    claims = ("5.14", "4.9-F", "prop-2", "resonance")
    written = write([*map(certificate, claims)], folder)
    found = rocq(folder)
    assert found.returncode == 0, found.stdout + found.stderr
    assert f"{written}\n" in found.stdout
    assert (written.claims, min(written.theorems.values()), len(written.theorems)) == (4, 2, 3)
    assert re.search(r"^axioms      none$", found.stdout, re.MULTILINE)


def a_cofactor(data):
    data["statements"][1]["cofactors"][0][0] = ["+", 1, data["statements"][1]["cofactors"][0][0]]


def a_side(data):
    data["statements"][1]["right"][0] = ["*", 2, data["statements"][1]["right"][0]]


def a_relation(data):
    del data["algebras"][0]["relations"][0], data["statements"][1]["cofactors"][0][0]


def a_point(data):
    next(point for point in data["points"] if "w" in point)["w"] = "1/5"


def a_counterexample(data):
    data["counterexamples"][0]["refutes"] = [1]


@needs_rocq
@pytest.mark.parametrize("change", [a_cofactor, a_side, a_relation, a_point, a_counterexample])
def test_rocq_rejects_what_a_change_makes_false(folder, change):
    data = certificate("5.14")
    change(data)
    write([data], folder)
    found = rocq(folder)
    assert found.returncode != 0
    assert "claim_5_d14.v" in found.stderr


def a_definition(data):
    data["statements"][2]["definitions"] = [["_1", ["*", "X", "X"]]]


def a_trace(data):
    data["statements"][5]["left"] = [["^", "K", 2]]


def a_transpose(data):
    data["algebras"][data["statements"][5]["algebra"]]["transposes"].remove(["K", ["*", -1, "K"]])


@needs_rocq
@pytest.mark.parametrize(
    ("id", "change", "theorem"),
    [
        ("resonance", a_definition, "claim_resonance_statement_2"),
        ("prop-2", a_trace, "claim_prop__2_statement_5"),
        ("prop-2", a_transpose, "claim_prop__2_statement_5"),
    ],
)
def test_rocq_rejects_a_name_and_a_trace_that_a_change_makes_false(folder, id, change, theorem):
    data = certificate(id)
    change(data)
    write([data], folder)
    found = rocq(folder)
    assert found.returncode != 0
    [line] = re.findall(rf'"./(claim_{identifier(id)}\w*.v)", line (\d+)', found.stderr)
    before = (folder / line[0]).read_text(encoding="utf-8").splitlines()[: int(line[1])]
    assert re.findall(r"Theorem (\w+)", "\n".join(before))[-1] == theorem


@needs_rocq
def test_rocq_rejects_false_words_and_a_false_counterexample(folder):
    data = certificate("4.9-F")
    for one in data["statements"]:
        if "refuted" not in one:
            one["right"] = [["*", 2, one["right"][0]]]
    data["counterexamples"][0]["point"]["rho"] = 0
    write([data], folder)
    found = rocq(folder, "-k")
    assert {"claim_4_d9__F_u_words.v", "claim_4_d9__F_u_matrices.v"} <= set(re.findall(r"claim_\w+\.v", found.stderr))
