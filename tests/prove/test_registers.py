"""A register of one's own: a folder of scripts, a script or a package, judged and reported as chapsym's is."""

import json
import re
import shutil
import sys
from pathlib import Path

import jsonschema
import pytest
from budget import slow
from commands import answer, chapsym, child, refused

import chapsym as package
from chapsym import checker
from chapsym.prove import PROOFS, NoRegister, Register, claims, load, records

DOCS = Path(__file__).parents[2] / "docs"
DISC = DOCS / "examples" / "rolling_disc"
RING = """
import sympy as sp
from chapsym.derive import Quotient
from chapsym.prove import equations
alpha, r = sp.symbols("alpha r")
equal = equations(Quotient((alpha, r)))
"""
SQUARES = '''"""On squares."""
from chapsym.prove import claim, rational_point
from .ring import alpha, equal, r

@claim("s-1", r"\\alpha^2 - r^2 = (\\alpha - r)(\\alpha + r)")
def difference(p):
    """A difference of squares."""
    p.printed(equal("α² - r² = (α - r)(α + r)", alpha**2 - r**2, (alpha - r) * (alpha + r)))
    p.control(equal("the same with α² + r²", alpha**2 + r**2, (alpha - r) * (alpha + r)))

@claim("s-2", r"(\\alpha + r)^2 = \\alpha^2 + r^2", uses=["s-1"])
def dream(p):
    """The square of a sum."""
    p.printed(equal("(α + r)² = α² + r²", (alpha + r) ** 2, alpha**2 + r**2))
    p.corrected(r"(\\alpha + r)^2 = \\alpha^2 + 2\\alpha r + r^2",
                equal("with 2αr", (alpha + r) ** 2, alpha**2 + 2 * alpha * r + r**2))
    p.counterexample(rational_point({alpha: 1, r: 2}))
    p.control(equal("with αr", (alpha + r) ** 2, alpha**2 + alpha * r + r**2))
'''
CUBES = '''"""On cubes."""
from chapsym.prove import claim, main
from ring import alpha, equal

@claim("c-1", r"\\alpha^3 = \\alpha\\alpha^2", uses=["5.2"])
def cube(p):
    """A cube."""
    print("a proof may print")
    p.printed(equal("α³ = α α²", alpha**3, alpha * alpha**2))
    p.control(equal("α³ = α²", alpha**3, alpha**2))

if __name__ == "__main__":
    main(__file__)
'''


@pytest.fixture
def folder(tmp_path, monkeypatch, forgotten):
    """A folder with two scripts, and what they share."""
    monkeypatch.setenv("CHAPSYM_RECORDS", str(tmp_path / "verdicts.jsonl"))
    monkeypatch.setattr("os.cpu_count", lambda: 1)  # processes of their own would load all proofs first
    monkeypatch.chdir(tmp_path)
    folder = tmp_path / "claims"
    folder.mkdir()
    for name, text in {"ring": RING, "squares": SQUARES, "cubes": CUBES}.items():
        (folder / f"{name}.py").write_text(text, encoding="utf-8")
    return folder


def test_a_folder_is_judged_and_its_verdicts_are_kept_beside_those_of_chapsym(folder, tmp_path):
    done = chapsym("prove", "--register", "claims", "--certificates", "kept", "--jobs", "1", "--json")
    found = {record["id"]: record for record in json.loads(done.stdout)["claims"]}
    assert {id: one["verdict"] for id, one in found.items()} == {"c-1": "holds", "s-1": "holds", "s-2": "corrected"}
    assert found["s-1"]["evidence"]["downstream"] == ["s-2"]
    assert done.stderr.startswith("a proof may print\n")
    for path in (tmp_path / "kept").glob("*.json"):
        assert checker.check(checker.read(path)).statement
    own = records.default_path(Register("claims"))
    assert own.parent == tmp_path
    assert set(records.read(own)) == {"s-1", "s-2", "c-1"}
    assert not (tmp_path / "verdicts.jsonl").exists()
    assert chapsym("prove", "c-1", "--register", "claims").stdout.splitlines()[-1] == "1 claim: 1 holds"


def test_worker_processes_find_the_folder(folder, capfd):
    (folder / "cubes.py").write_text(CUBES.replace(', uses=["5.2"]', ""), encoding="utf-8")
    done = chapsym("prove", "--register", "claims", "--jobs", "2")
    assert done.returncode == 0, done.stderr
    assert done.stdout.endswith("3 claims: 1 corrected, 2 holds\n")
    assert "a proof may print" not in done.stdout + capfd.readouterr().out  # of the processes


@pytest.mark.parametrize(("changed", "stale"), [("ring", {"s-1", "s-2", "c-1"}), ("squares", {"s-1", "s-2"})])
def test_a_verdict_is_stale_when_what_its_script_imports_has_changed(folder, changed, stale):
    """A helper counts however it is imported: as `.ring`, or as what lies beside the script."""
    assert chapsym("prove", "--register", "claims", "--jobs", "1").returncode == 0
    path = folder / f"{changed}.py"
    path.write_text(path.read_text("utf-8") + "\n# changed\n", encoding="utf-8")
    rows = answer("prove", "--list", "--register", "claims")["claims"]
    assert {row["id"] for row in rows if row["stale"]} == stale


def test_a_script_or_a_package_is_a_register_too(folder, monkeypatch):
    assert list(Register("claims/cubes.py").load()) == ["c-1"]
    (folder.parent / "elsewhere").mkdir()
    folder.rename(folder.parent / "elsewhere" / "mine")
    (folder.parent / "elsewhere" / "mine" / "__init__.py").write_text(
        'SCRIPTS = ("squares",)\nCLAIMS = ("s-2",)\nLEMMAS = ("s-1",)\n'
    )
    monkeypatch.setattr(claims, "_REGISTER", {})
    monkeypatch.syspath_prepend("elsewhere")
    assert list(Register("mine").load()) == ["s-2"]
    assert list(Register("mine").load(lemmas=True)) == ["s-2", "s-1"]
    del sys.modules["mine"].CLAIMS
    assert list(Register("mine").load()) == ["s-2"]
    for name in ("mine", "mine.squares", "mine.ring"):
        del sys.modules[name]


def test_the_register_of_chapsym_is_one_of_them(folder):
    (folder.parent / "chapsym.proofs").mkdir()
    assert PROOFS.load(lemmas=True) == load(lemmas=True)
    assert list(load())[:2] == ["2.1", "2.2"]
    with pytest.raises(NoRegister, match=r"there is no folder chapsym\.nothing, and no package of that name"):
        Register("chapsym.nothing").load()


UNSAID = "class E(BaseException):\n    __str__ = None\nraise E\n"
BROKEN = r"claims/cubes\.py cannot be loaded: "
#: What is wrong: the file, what is put in the place of what, and what is said.
WRONG = {
    "a syntax error": ("cubes", "def cube", "def cube(", BROKEN + "SyntaxError: .*line 6"),
    "a missing module": ("cubes", "from ring", "from rings", BROKEN + "ModuleNotFoundError: No module named 'rings'"),
    "an exception": ("cubes", "@claim", "1 / 0\n@claim", BROKEN + r"ZeroDivisionError: .* \(cubes\.py, line 5\)"),
    "an end of another kind": ("cubes", "@claim", f"{UNSAID}@claim", BROKEN + "E: an"),
    "one beside": ("ring", "equal =", "1 / 0\nequal =", BROKEN + r"ZeroDivisionError: .* \(ring\.py, line 6\)"),
    "an end": ("cubes", 'if __name__ == "__main__"', "if True", BROKEN + r"it leaves Python; .* main\(__file__\)"),
    "an id twice": ("cubes", "c-1", "s-1", r"squares\.py: two proofs judge the claim s-1; .*cubes\.py, line 5"),
    "an id that is no name of a file": ("cubes", "c-1", "c/1", BROKEN + r"ValueError: the id of a claim .*, not 'c/1'"),
    "an id of chapsym": ("cubes", "c-1", "4.1", r"cubes\.py: two proofs judge the claim 4\.1; give yours an id"),
    "a use in a circle": ("cubes", "5.2", "c-1", "claims: c-1 uses itself, directly or through others"),
    "a use of nothing": ("cubes", "5.2", "5.2000", r"cubes\.py: c-1 uses '5\.2000', which no proof judges"),
    "no proof": ("__init__", "", "CLAIMS = ('s-1', 's-2', 'c-1', 'c-2')", r"claims: the proofs and .* differ: c-2"),
    "no script": ("__init__", "", "SCRIPTS = ('cube',)", "claims has no script file 'cube'; SCRIPTS, where it is"),
    "scripts that are no list": ("__init__", "", "SCRIPTS = 5", r"claims/__init__\.py: SCRIPTS must be a list of"),
    "claims that are no list": ("__init__", "", "CLAIMS = 's-1'", r"CLAIMS must be a list of texts"),
    "lemmas that are no texts": ("__init__", "", "LEMMAS = (3,)", r"LEMMAS must be a list of texts"),
    "a broken head": ("__init__", "", "1 / 0", r"claims/__init__\.py cannot be loaded: ZeroDivisionError"),
    "a head without folders": ("__init__", "", "__path__ = None", "claims cannot be read as a register: TypeError: "),
    "a head that raises": ("__init__", "", "def __getattr__(name):\n    1 / 0", "as a register: ZeroDivisionError: "),
}


@pytest.mark.parametrize("wrong", WRONG)
def test_a_script_that_is_wrong_is_one_sentence_with_its_file(folder, wrong):
    name, old, new, said = WRONG[wrong]
    path = folder / f"{name}.py"
    path.write_text(path.read_text("utf-8").replace(old, new, 1) if old else new, encoding="utf-8")
    words = chapsym("prove", "--register", "claims")
    assert (words.returncode, words.stdout) == (1, "")
    assert words.stderr.splitlines()[-1].startswith("chapsym: ")
    assert re.search(said, words.stderr), words.stderr


@pytest.mark.parametrize(
    ("place", "said"),
    [
        ("nowhere", "there is no folder nowhere, and no package of that name; a register is a folder of Python"),
        ("empty", "empty has no claim: write @claim(id, formula) before a function of a Proof"),
        ("claims/ring.py", "claims/ring.py has no claim: write @claim(id, formula)"),
        ("empty/notes.txt", "empty/notes.txt is no Python script; a register is a folder of scripts, or one"),
        ("no\0where", "there is no folder"),
        ("empty/circle", "there is no folder"),
    ],
)
@pytest.mark.parametrize("command", ["prove", "report"])
def test_a_place_without_claims_is_one_sentence(folder, command, place, said):
    (folder.parent / "empty").mkdir()
    (folder.parent / "empty" / "notes.txt").write_text("")
    (folder.parent / "empty" / "circle").symlink_to("circle")
    assert said in refused(command, "--register", place)


@pytest.mark.parametrize(
    ("command", "name", "text"),
    [
        (["report"], "__init__", "class Odd:\n    __str__ = None\nPAPER = Odd()"),
        (["codegen", "--check"], "kernels", "def __getattr__(name):\n    1 / 0"),
    ],
)
def test_what_a_register_raises_where_it_is_read_is_one_sentence(folder, command, name, text):
    (folder / f"{name}.py").write_text(text)
    (folder / "cubes.py").unlink()
    (folder / "squares.py").write_text(SQUARES.partition('@claim("s-2"')[0], encoding="utf-8")
    said = refused(*command, "--register", "claims", status=1)
    assert said.startswith("claims cannot be read as a register: ")


def test_a_script_may_have_another_encoding(folder):
    for name, start, encoding in (("ring", "\ufeff", "utf-8"), ("cubes", "# coding: cp1253\n", "cp1253")):
        path = folder / f"{name}.py"
        path.write_bytes((start + path.read_text("utf-8").replace("³", "^3").replace("²", "^2")).encode(encoding))
    assert {one["id"] for one in answer("prove", "--list", "--register", "claims")["claims"]} == {"c-1", "s-1", "s-2"}


def test_what_a_proof_lacks_is_said_with_its_place(folder):
    path = folder / "cubes.py"
    path.write_text(
        path.read_text("utf-8").replace('    p.control(equal("α³ = α²", alpha**3, alpha**2))\n', ""), "utf-8"
    )
    done = chapsym("prove", "c-1", "--register", "claims")
    assert (done.returncode, done.stderr.splitlines()[-1]) == (1, "chapsym: not proved: c-1")
    assert "problem: the proof has no negative control: give p.control a false variant" in done.stdout
    assert f"its proof: {path}, line 5" in done.stdout


ODD = """
from chapsym.prove import claim, judged
from ring import alpha, equal

for n in (2, 3):
    @claim(f"n-{n}", f"\\\\alpha^{n}")
    def power(p, n=n):
        p.say(alpha)
        p.printed(equal("power", alpha**n, alpha * alpha ** (n - 1)))
        p.control(equal("one less", alpha**n, alpha ** (n - 1)))

@claim("lost", "x")
def lost(p):
    p.lemma(judged("n-4"))

@claim("else", "x")
def elsewhere(p):
    p.printed(equal("a symbol that the ring has not", alpha, alpha.subs(alpha, alpha + p.unknown)))

@claim("half", "x")
def half(p):
    "Half a letter, which Python 3.13 takes in no docstring."
    raise GeneratorExit("\\ud800")
"""


def test_proofs_of_odd_forms_are_judged_and_what_they_raise_is_said(folder):
    (folder / "odd-ones.py").write_text(ODD, "utf-8")
    done = chapsym("prove", "n-2", "n-3", "lost", "else", "half", "--register", "claims", "--jobs", "1")
    assert done.stderr == "chapsym: not proved: lost, else, half\n"
    assert "problem: the proof raised LookupError: no proof of 'n-4' is loaded" in done.stdout
    assert "has no attribute 'unknown' (odd-ones.py:18)" in done.stdout
    assert done.stdout.endswith("5 claims: 2 holds, 3 open\n")


def test_what_a_claim_is_given_is_of_its_type():
    for given in ((5, "x"), ("x", 5), ("x", "x", "5.2")):
        with pytest.raises(TypeError, match=r"takes an id and a formula, as text, and in uses a list of ids"):
            claims.claim(*given)


def test_an_unknown_claim_is_told_where_the_known_ones_are(folder):
    assert refused("prove", "c-9", "--register", "claims").endswith(
        "no proof judges the claim 'c-9'; chapsym prove --list --register claims names those that are judged"
    )
    assert refused("prove", "c-9").endswith("and --register FOLDER judges claims of your own")


def test_verdicts_on_other_claims_are_not_overwritten(folder, tmp_path):
    assert chapsym("prove", "prop-2").returncode == 0
    kept = (tmp_path / "verdicts.jsonl").read_text("utf-8")
    said = refused("prove", "c-1", "--register", "claims", "--records", "verdicts.jsonl")
    assert said == "verdicts.jsonl holds verdicts on other claims, such as prop-2; give --records another file"
    assert (tmp_path / "verdicts.jsonl").read_text("utf-8") == kept


def test_an_id_of_chapsym_is_taken_even_where_its_proofs_are_not_loaded(folder):
    (folder / "squares.py").write_text(SQUARES.replace("s-2", "prop-4"), "utf-8")
    done = child("prove", "--list", "--register", "claims")
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.startswith("chapsym: claims/squares.py: two proofs judge the claim prop-4; give yours an id")


def test_a_folder_that_is_not_named_is_not_run(folder, tmp_path):
    (folder / "cubes.py").write_text("raise SystemExit('it was run')")
    assert chapsym("prove", "--list", cwd=folder).returncode == 0


def test_the_page_and_the_errata_are_of_the_own_register(folder, tmp_path):
    (folder / "__init__.py").write_text('PAPER = "A. Author, On squares"\nNOTE = "Here r is a radius."\n', "utf-8")
    for suffix in ("html", "md", "tex", "json"):
        done = chapsym("report", "--register", "claims", "-o", f"x.{suffix}")
        assert done.stdout == f"wrote x.{suffix}: 3 claims: 1 corrected, 2 holds\n", done.stderr
        text = (tmp_path / f"x.{suffix}").read_text("utf-8")
        for there in ("On squares", "is a radius", "s-2"):
            assert there in text, suffix
        for not_there in ("Fedorov", "SIGMA", "r_k", "mass tensor"):
            assert not_there not in text, (suffix, not_there)
    document = json.loads((tmp_path / "x.json").read_text("utf-8"))
    jsonschema.validate(document, json.loads((DOCS / "errata.schema.json").read_text("utf-8")))
    (entry,) = document["errata"]
    assert (entry["section"], entry["section_title"]) == (3, "On squares")
    assert entry["counterexamples"][0]["point"] == {"alpha": "1", "r": "2"}
    assert entry["proof"] == "chapsym prove s-2 --explain --register claims"
    assert chapsym(*entry["proof"].split()[1:]).returncode == 0
    assert document["cite"] == f"Errata to A. Author, On squares, computed by chapsym {package.__version__}"


@pytest.fixture
def disc(folder):
    """The records of the worked example, and its certificates."""
    found = json.loads(chapsym("prove", "--register", DISC, "--jobs", "1", "--certificates", "kept", "--json").stdout)
    return found["claims"], [json.loads(path.read_text("utf-8")) for path in sorted(Path("kept").glob("*.json"))]


@pytest.mark.thorough  # that its verdicts are these, docs/how-to/own-claims.md shows
def test_the_worked_example_finds_what_is_false_in_the_documentation_of_sympy(disc):
    found, certificates = disc
    false = {"L-potential", "L-1", "L-2", "L-3", "L-a1", "L-a2", "L-a3"}
    assert {r["id"] for r in found if r["verdict"] == "corrected"} == false
    assert {r["verdict"] for r in found if r["id"] not in false} == {"holds"}
    assert len(found) == 22
    for record in found:
        evidence = record["evidence"]
        assert all(control["rejected"] for control in evidence["controls"])
        assert evidence["controls"]
        assert evidence["witnesses"]
        assert bool(evidence["counterexamples"]) == (record["id"] in false)
        assert {*evidence["carried"]["sentences"]} <= {"hypothesis", "said"}, "all that is decided is a certificate"
    assert len(certificates) == len(found)
    assert sum(len(one["counterexamples"]) for one in certificates) == len(false)


@pytest.mark.parametrize(
    ("script", "old", "new", "claim"),
    [
        ("rolling_disc/disc.py", "cross(-r * UP)", "cross(r * UP)", "K-u1"),
        ("rolling_disc/disc.py", "own + carried", "own - carried", "K-u1"),
        ("suslov/top.py", "sp.Matrix([1, *-x / 2, 0])", "sp.Matrix([1, *x / 2, 0])", "S-principle"),
        ("suslov/top.py", "2 * v * v.T + 2 * a * cross", "2 * v * v.T - 2 * a * cross", "S-outward"),
        *slow(
            ("rolling_disc/disc.py", "lagrangian(m * g", "lagrangian(-m * g", "K-u1"),
            ("suslov/top.py", "return -momentum(a, -b)", "return momentum(a, b)", "S-limit"),
            ("suslov/top.py", "[0, J2, J23]", "[0, J2 + J1, J23]", "S-energy"),
            ("suslov/top.py", "J13 * b[0] + J23 * b[1]", "J13 * b[0] - J23 * b[1]", "S-steady"),
        ),
    ],
)
def test_a_worked_example_sees_another_derivation(folder, script, old, new, claim):
    """The disc that rolls on a ceiling, that falls upwards, or for which the principle has another sign."""
    register, file = script.split("/")
    shutil.copytree(DISC.parent / register, register)
    text = (Path(register) / file).read_text("utf-8")
    assert text.count(old) == 1
    (Path(register) / file).write_text(text.replace(old, new), "utf-8")
    done = chapsym("prove", claim, "--register", register)
    assert (done.returncode, done.stderr) == (1, f"chapsym: not proved: {claim}\n")


def test_the_suslov_top_has_what_was_derived(folder):
    found = json.loads(chapsym("prove", "--register", DISC.parent / "suslov", "--jobs", "1", "--json").stdout)["claims"]
    assert [one["verdict"] for one in found] == ["holds"] * 9
    assert all(one["evidence"]["witnesses"] for one in found)


def test_a_script_of_a_folder_alone_tells_where_the_others_are(folder):
    assert chapsym("prove", "K-u2", "--register", DISC / "kane.py").returncode == 0
    done = chapsym("prove", "--register", DISC / "forces.py")
    assert f"which no proof judges; the register {DISC} would have its other scripts" in done.stderr
