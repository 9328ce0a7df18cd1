"""Certificates of the register: what is written is what is decided, and what is committed is what is written now."""

import json
import shutil
from pathlib import Path

import pytest
import sympy as sp
from commands import chapsym, refused
from committed import register
from flint import Ordering, fmpq_mpoly_ctx

from chapsym import checker, proofs
from chapsym.checker import manifest
from chapsym.checker.__main__ import main as judge_files
from chapsym.checker.trees import names_in
from chapsym.derive.quotient import Quotient
from chapsym.derive.words import WordAlgebra, matrix_symbols
from chapsym.prove import Comparison, Equation, Examples, Fact, Proof, Verdict, equations, load, rational_point
from chapsym.prove.certificates import certificate
from chapsym.prove.cofactors import Ideal
from chapsym.prove.points import candidates
from chapsym.prove.polynomials import Identity, parameters
from chapsym.prove.runner import explain, judge
from chapsym.prove.trees import NotAlgebra, shared, tree

FOLDER = Path(proofs.__file__).parent / "certificates" / "register"
x, y, z = sp.symbols("x y z")
CIRCLE = Quotient((x, y), [x**2 + y**2 - 1])


def test_what_is_committed_is_what_is_written_now(judged):
    """Mend it by: chapsym prove --certificates proofs/certificates/register."""
    assert {path.name for path in FOLDER.iterdir()} == set(map(checker.file_name, judged))
    assert [id for id, (_, text) in judged.items() if text != (FOLDER / checker.file_name(id)).read_text("utf-8")] == []


def test_the_command_writes_what_is_committed(tmp_path):
    chapsym("prove", "5.11", "--jobs", "1", "--certificates", tmp_path, "--records", tmp_path / "v.jsonl")
    assert (tmp_path / "5.11.json").read_text("utf-8") == (FOLDER / "5.11.json").read_text("utf-8")


def test_a_letter_is_defined_once_in_the_register():
    """Any claims may be proved in one process, in any order."""
    found = {}
    for name, data in register().items():
        for one in data["derivation"]:
            step = {part: one[part] for part in ("text", "operation", "of", "by")}
            assert found.setdefault(one["name"], step) == step, f"{name}: {one['name']}"


def test_the_certificates_state_what_the_verdicts_rest_on(verdicts):
    """Every check of the record is a statement or a sentence of the file, under its role and its text, and once."""
    for id, record in verdicts.items():
        data = checker.read(FOLDER / checker.file_name(id))
        assert (data["claim"], data["printed"], data["corrected"]) == (id, record["printed"], record["corrected"])
        kept = [one["text"] for name in ("statements", "comparisons", "counts", "zeros") for one in data[name]]
        kept += [one["text"] for one in data["rests"] if " " in one["certificate"]]
        kept += [one["text"] for one in data["sentences"] if one["role"] in checker.register.ROLES]
        for check in record["evidence"]["checks"]:
            text = check["statement"]
            for role in ("printed", "corrected", "second route", f"under {record['evidence']['condition']}"):
                text = text.removeprefix(f"{role}: ")
            found = [known for known in kept if known.removeprefix("false: ").startswith(text)]
            assert found, (id, text)
            kept.remove(min(found, key=len))
        assert kept == [], id
        roles = [one["role"] for one in data["sentences"]]
        assert record["evidence"]["carried"] == {
            "statements": len(data["statements"]),
            "identical": sum(one["left"] == one["right"] for one in data["statements"]),
            "steps": len(data["derivation"]),
            "comparisons": len(data["comparisons"]),
            "counts": len(data["counts"]),
            "hypotheses": len(data["hypotheses"]),
            "zeros": len(data["zeros"]),
            "counterexamples": len(data["counterexamples"]),
            "rests": len(data["rests"]),
            "sentences": {role: n for role in checker.register.SENTENCES if (n := roles.count(role))},
            "text": record["evidence"]["carried"]["text"],
            "judged": record["evidence"]["carried"]["judged"],
        }


def test_the_argument_of_a_claim_says_what_carries_it(verdicts):
    carried = "statements that the checker accepted: 2; hypotheses: 1; counterexamples: 2; sentences: none"
    assert f"  carried by: {carried}" in explain(verdicts["5.11"]).splitlines()
    assert "accepted: 5 (1 of one expression on both sides)" in explain(verdicts["4.9"])


def test_the_share_of_the_register_that_is_checked():
    """A change here is progress, or a loss, and must be looked at."""
    files = [checker.read(path) for path in FOLDER.iterdir()]
    decided = sum(one["role"] in checker.register.ROLES for data in files for one in data["sentences"])
    prose = sum(len(data["sentences"]) for data in files) - decided
    assert (len(files), sum(len(data["statements"]) for data in files), decided, prose) == (161, 747, 0, 863)
    parts = {part: sum(len(data[part]) for data in files) for part in ("comparisons", "counts", "zeros", "hypotheses")}
    assert parts == {"comparisons": 62, "counts": 24, "zeros": 2, "hypotheses": 53}
    assert {one["role"] for data in files for one in data["sentences"]} == {"hypothesis", "said", "inference"}
    assert sum(one["left"] == one["right"] for data in files for one in data["statements"]) == 72
    assert sum(path.stat().st_size for path in FOLDER.iterdir()) < 3_320_000


def test_what_is_derived_is_in_the_chain():
    """From the Lagrangian, the constraint and its virtual displacements to (4.13) and (5.2), by the checker's steps."""
    derived = {}
    for path in FOLDER.iterdir():
        data = checker.read(path)
        names = {one["name"] for one in data["derivation"]}
        said = [one for one in data["statements"] if names & names_in([0, *one["left"], *one["right"]])]
        said += [one for one in data["counts"] if names & names_in([0, *one["equations"]])]
        derived |= {data["claim"]: (data, said)} if names else {}
    assert derived.keys() >= {
        "2.10", "2.11", "2.12", "2.14", "2.15", "4.1", "4.3", "4.4", "4.6", "4.7", "4.9-f", "4.10", "4.13-limit",
        "5.2", "5.3-at-most-4", "5.3-at-least-2", "5.9-circle", "prop-1", "remark-3", "remark-4", "self-adjoint",
    }  # fmt: skip
    assert all(said for _, said in derived.values())
    assert sum(len(said) for _, said in derived.values()) == 133
    for claim in ("prop-1", "remark-3", "5.2"):
        data, _ = derived[claim]
        names = {one["name"] for one in data["derivation"]}
        written = [one for one in data["derivation"] if one["operation"] == "written"]
        premises = [one["name"] for one in written if names_in(one["of"]).isdisjoint(names)]
        assert {"action", "rolling", "rolls_after", "rolls_before"} <= set(premises) <= {
            "action", "rolling", "rolls_after", "rolls_before", "m_k"
        }  # fmt: skip


def proof(*statements, point=None):
    made = Proof()
    made.printed(*statements)
    if point:
        made.counterexample(point)
    return made


def test_what_is_false_stands_with_its_counterexample_and_what_is_no_equation_is_a_sentence():
    wrong = Equation("wrong", x, y, CIRCLE)
    data = certificate("0", "x", proof(wrong, Fact("seven", True), point=rational_point({x: "3/5", y: "4/5"})))
    assert data["counterexamples"][0]["refutes"] == [0]
    assert data["sentences"] == [{"role": "printed", "text": "seven (exact arithmetic)"}]


def test_a_hypothesis_is_data_that_holds_at_the_points_and_where_it_does_not_there_is_none():
    made = Proof()
    made.assume("x is below 2", x < 2)
    made.assume("in words only")
    made.printed(Equation("one", x**4 - y**4, 2 * x**2 - 1, CIRCLE))
    data = certificate("0", "x", made)
    assert data["hypotheses"] == [{"text": "x is below 2", "relations": [["<", "x", 2]]}]
    assert data["sentences"] == [{"role": "hypothesis", "text": "in words only"}]
    assert checker.register.entries(data["points"][data["statements"][0]["point"]])["x"] < 2
    made.assume("x is large", x > 5)
    with pytest.raises(checker.Rejected, match=r"is tested at no point|which is not among its variables"):
        certificate("0", "x", made)


def test_a_comparison_is_data_and_a_false_one_that_is_printed_is_refuted():
    at = {x: sp.Rational(1, 2), y: sp.Integer(2)}
    right = Comparison("order", [x < y, y >= 2, sp.Eq(x * y, 1), sp.Ne(x, 1)], at)
    wrong = Comparison("other order", [y <= x], at)
    made = proof(right, wrong)
    made.lemma(wrong)
    data = certificate("0", "x", made)
    one, other = data["comparisons"]
    assert data["points"][one["point"]] == {"x": "1/2", "y": 2}
    assert one["relations"] == [["<", "x", "y"], ["<=", 2, "y"], ["=", ["*", "x", "y"], 1], ["!=", "x", 1]]
    assert (other["text"], other["refuted"]) == ("other order", True)
    assert data["sentences"] == [{"role": "lemma", "text": "false: other order (rational numbers at a point)"}]


def test_a_printed_comparison_that_is_false_is_its_own_counterexample():
    at = {x: sp.Integer(1), y: sp.Integer(2)}
    made = Proof()
    made.assume("x is not 1", sp.Ne(x, 1))
    made.printed(Comparison("right", [x < y], at), Comparison("order", [y <= x + z - z, sp.Ne(x - 1, 0)], at))
    sides = {"statement": "order", "left": ["2", "0"], "right": ["at most 1", "not 0"]}
    assert made.counterexamples == [{"point": {"x": "1", "y": "2"}, "printed": [sides], "corrected": []}]
    assert made.problems == ["the counterexample violates the hypothesis x is not 1"]


def test_a_counterexample_off_the_relations_is_not_accepted():
    """The prover tests only the hypotheses that are handed to it; the checker tests those of the algebra."""
    with pytest.raises(checker.Rejected, match="a relation fails"):
        certificate("0", "x", proof(Equation("wrong", x, y, CIRCLE), point=rational_point({x: 3, y: 4})))


def test_what_has_no_rational_point_or_is_no_algebra_is_a_sentence_that_says_so():
    cubic = Quotient((x,), [x**3 - 4])
    (a,) = matrix_symbols("zz")
    unknown = Equation("unknown", a, a, WordAlgebra({a: a}, {(a, a): -1}))
    data = certificate("0", "x", proof(Equation("cube", x**4, 4 * x, cubic), unknown))
    assert [one["text"] for one in data["sentences"]] == [
        "cube (not exported: no rational point was found where its relations hold)",
        "unknown (not exported: no matrices are known for which its rules hold)",
    ]
    assert data["statements"] == []


def test_letters_of_ones_own_have_the_matrices_that_their_algebra_gives():
    turn, turned, other = matrix_symbols("own own^T other")
    values = [[0, -1], [1, 0]], [[0, 1], [-1, 0]], [[1, 2], [3, 4]]
    matrices = dict(zip((turn, turned, other), map(sp.Matrix, values), strict=True))
    cancels = [other * turn * turned, other]
    for example, rows in ((matrices, 2), ({}, 3)):
        algebra = WordAlgebra({turn: turned, turned: turn}, {(turn, turned): 1, (turned, turn): 1}, example)
        data = certificate("0", "x", proof(Equation("cancels", *cancels, algebra)))
        assert [len(point["own"]) for point in data["points"]] == [rows]
    own = equations(WordAlgebra({turn: turned, turned: turn}, {(turn, turned): 1, (turned, turn): 1}, matrices))
    claim = Proof()
    claim.printed(own("cancels", *cancels))
    claim.control(own("does not", other * turn, other))
    assert claim.verdict() is Verdict.HOLDS


def test_a_claim_whose_certificate_is_not_accepted_is_open(monkeypatch):
    def rejects(data):
        raise checker.Rejected("no")

    monkeypatch.setattr("chapsym.checker.check", rejects)
    judgement = judge(load()["5.11"])
    assert str(judgement.verdict) == "open"
    assert judgement.proof.problems == ["the checker does not accept its certificate: no"]


@pytest.mark.parametrize("expr", [sp.sqrt(x), sp.sin(x), sp.I, x**y, sp.pi, sp.Float(0.5)])
def test_what_is_no_quotient_of_polynomials_has_no_tree(expr):
    with pytest.raises(NotAlgebra):
        tree(expr)


def test_what_was_made_of_parameters_is_a_tree_with_names_for_what_occurs_often_or_of_factors_in_lowest_terms():
    a, b = parameters("a b")
    whole = a + b
    both = 2 / whole + 0 * a
    assert shared([both * both, both**-1 - 1 * b, whole + a, 0 * a, 3]) == (
        [["_1", ["+", "a", "b"]], ["_2", ["*", ["^", "_1", -1], 2]]],
        [["*", "_2", "_2"], ["+", ["^", "_2", -1], ["*", "b", -1]], ["+", "_1", "a"], 0, 3],
    )
    data = certificate("0", "x", proof(Identity("square", [whole * whole], [a**2 + 2 * a * b + b**2])))
    assert [(s["text"], s["cofactors"]) for s in data["statements"]] == [("square", [[]])]
    assert data["statements"][0]["definitions"] == [["_1", ["+", "a", "b"]]]
    assert data["sentences"] == []
    made = (a**2 - b**2) / (2 * a * (a + b) ** 3)
    assert (made.made[0], made.lowest().made, made.lowest() == made) == ("*", None, True)
    lowest = ["*", "1/2", ["+", ["*", -1, "b"], "a"], ["^", ["+", "b", "a"], -2], ["^", "a", -1]]
    assert shared([made.lowest()]) == ([], [lowest])
    one = made.lowest()
    assert [name for name, _ in shared([one * one])[0]] == ["_1"]
    assert shared([(a - a + 1).lowest(), (a - a).lowest()])[1] == [1, 0]


def test_cofactors_make_a_polynomial_of_the_ideal_and_there_are_none_for_another():
    a, b, c = fmpq_mpoly_ctx.get(("x", "y", "z"), Ordering.degrevlex).gens()
    relations, wanted = (a * b - c, b * c - a), a**2 - c**2  # by the S-polynomial alone
    ideal = Ideal("xyz", [relation.to_dict() for relation in relations])
    cofactors = ideal.cofactors(wanted.to_dict())
    assert sum(x * y for x, y in zip(cofactors, relations, strict=True)) == wanted
    assert ideal.cofactors((a + 1).to_dict()) is None


def test_points_are_on_the_relations_and_keep_what_is_known():
    for relations in ([x**2 + y**2 - 1], [x * y - 6, z**3 - 8], [x**2], [x - y, y - z]):
        point = next(candidates((x, y, z), relations, Examples()))
        assert all(relation.xreplace(point) == 0 for relation in relations)
    assert next(candidates((x, y), [x + y - 1], Examples(), {x: sp.Integer(5)})) == {x: 5, y: -4}
    assert list(candidates((x,), [x**2 - 2], Examples())) == []


def test_a_folder_that_cannot_be_is_refused_in_one_sentence(tmp_path):
    (tmp_path / "file").write_text("")
    said = refused("prove", "5.11", "--certificates", tmp_path / "file", "--records", tmp_path / "v.jsonl")
    assert "file cannot be a folder of results: it is a file" in said


def test_the_manifest_lists_the_certificates():
    """Mend it by: chapsym certify manifest proofs."""
    folder = Path(proofs.__file__).parent
    others = (
        path for path in folder.rglob("*.json") if path.name != "manifest.json" and path.parent.name != "register"
    )
    names = {path: checker.read(path) for path in others}
    names |= {folder / "certificates" / "register" / name: data for name, data in register().items()}
    listed = manifest.listed(checker.read(folder / "manifest.json"), folder)
    claims = {path: f"{data['claim']} " if "claim" in data else "" for path, data in names.items()}
    page = Path(__file__).parents[2] / "docs" / "how-to" / "certificate.md"
    assert checker.read(folder / "manifest.json")["digest"] in page.read_text(encoding="utf-8")
    assert listed == {path: f"{claims[path]}{data['digest']}" for path, data in names.items()}


def test_no_two_files_have_names_that_differ_in_case_alone():
    names = [
        checker.file_name(id) for id in ("a", "A", "aB", "Ab", "AB", "a_", "A_", "_a", "_A", "a__", "4.9-f", "4.9-F")
    ]
    assert len({name.casefold() for name in names}) == len(names)
    assert checker.file_name("5.3-at-most-4") == "5.3-at-most-4.json"


def test_a_certificate_that_is_missing_is_seen(tmp_path, monkeypatch, capsys):
    """Of a folder with a manifest, and of what a claim uses."""
    for id in ("4.9-f", "4.9-F"):
        shutil.copy(FOLDER / checker.file_name(id), tmp_path)
    monkeypatch.chdir(tmp_path)
    assert judge_files(["4.9-F_.json"]) == 1  # 4.9-f uses others, which are not there
    data = checker.read(FOLDER / "4.9-f.json")
    alone = data | {"uses": []}
    alone["statement"] = checker.statement(alone)
    alone["digest"] = checker.digest(alone)
    (tmp_path / "4.9-f.json").write_text(json.dumps(alone))
    assert judge_files(["4.9-F_.json"]) == 0  # found in its folder
    chapsym("certify", "manifest", tmp_path)
    assert judge_files(["--manifest", "manifest.json"]) == 0
    capsys.readouterr()
    (tmp_path / "4.9-f.json").rename(tmp_path / "other.json")
    assert judge_files(["--manifest", "manifest.json"])
    assert "4.9-f.json is missing" in capsys.readouterr().err
    (tmp_path / "other.json").unlink()
    assert judge_files(["4.9-F_.json"])
    assert "rests on 4.9-f" in capsys.readouterr().err
    shutil.copy(FOLDER / "4.9-f.json", tmp_path)
    assert judge_files(["--manifest", "manifest.json"])
    assert "another certificate than the one" in capsys.readouterr().err


def test_a_file_too_many_and_one_with_another_name_are_seen(tmp_path):
    shutil.copy(FOLDER / "2.1.json", tmp_path)
    chapsym("certify", "manifest", tmp_path)
    data = checker.read(tmp_path / "manifest.json")
    assert list(manifest.listed(data, tmp_path)) == [tmp_path / "2.1.json"]
    shutil.copy(FOLDER / "2.3.json", tmp_path)
    with pytest.raises(checker.Rejected, match=r"2\.3\.json is there, and the manifest does not list it"):
        manifest.listed(data, tmp_path)
    (tmp_path / "2.3.json").rename(tmp_path / "2.4.json")
    named = {f"{name}.json": f"{claim} {'0' * 64}" for name, claim in (("2.1", "2.1"), ("2.4", "2.3"))}
    with pytest.raises(checker.Rejected, match=r"2\.4\.json has not the name of its claim, 2\.3"):
        manifest.listed(manifest.made(named), tmp_path)


def test_every_verdict_of_a_proof_has_a_certificate():
    """Also where a definition prints something, a condition has a correction."""
    true, false = Equation("true", x**2, 1 - y**2, CIRCLE), Equation("false", x, y, CIRCLE)
    point = rational_point({x: "3/5", y: "4/5"})

    def defined(p):
        p.define("a name")
        p.printed(true)

    def both(p):
        p.printed(false)
        p.corrected("x = x", Equation("right", x**2 + y**2, 1, CIRCLE))
        p.under("y = x", Equation("right, too", y**2, 1 - x**2, CIRCLE))
        p.counterexample(point)

    for prove, verdict in ((defined, "definition"), (both, "conditional")):
        made = Proof(uses=("2.1", "2.1"))
        prove(made)
        assert certificate("0", "x", made, verdict)["uses"] == ["2.1"]
    made = Proof()
    made.reads({"s": (sp.sin(x), "no algebra")})
    with pytest.raises(checker.Rejected, match="the value of s cannot be given to the checker"):
        certificate("0", "s = 1", made)
    for value in ("x", None, (x, y), 1.5, (x, "x", "y"), ("x + y", "a text is not evaluated")):
        with pytest.raises(TypeError, match=r"p\.reads takes for D its value"):
            made.reads({"D": value})
    made.reads(("D", x, "the letter"), {"E": (y, "another one")})
    assert list(made.glossary) == ["s", "D", "E"]
