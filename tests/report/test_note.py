"""The LaTeX source of the note: every lemma and theorem is there, what begins also ends, what is cited exists."""

import importlib.util
import re
from pathlib import Path
from types import SimpleNamespace

import pytest

from chapsym import checker
from chapsym.proofs.open import certified, readings

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def make():
    spec = importlib.util.spec_from_file_location("note_make", ROOT / "docs" / "note" / "make.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def texts(make, verdicts, all_judged, made_once, tmp_path_factory):
    """The files by name, from the verdicts of this test run."""
    folder, known = tmp_path_factory.mktemp("note"), all_judged.checked

    def unchecked(data):
        """What the sentence of a certificate is; those that no claim has are checked by `.ci/run`."""
        return SimpleNamespace(statement=checker.statement(data))

    def made():
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(checker, "check", lambda data: known.get(data["digest"]) or unchecked(data))
            make.main(folder, [verdicts[id] for id in (*make.LEMMAS, *readings.READINGS)])
        return {path.name: path.read_text(encoding="ascii") for path in folder.glob("*.tex")} | {
            path.name: path.read_text(encoding="utf-8") for path in folder.glob("*.bib")
        }

    return made_once("note", made)


def faults(text):
    """What LaTeX would stop at: environments, braces and formulas that do not end, characters that are unknown."""
    found, opened = [], []
    text = re.sub(r"(?<!\\)%.*", "", text)
    for what, name in re.findall(r"\\(begin|end)\{(\w+\*?)\}", text):
        if what == "begin":
            opened.append(name)
        elif not opened or opened.pop() != name:
            found.append(f"\\end{{{name}}}")
    found += opened
    for block in re.split(r"\n\s*\n|\\item|\n", text):
        bare = re.sub(r"\\[\\{}$%&#_]", "", block)
        depth = [0]
        for x in re.findall(r"[{}]", bare):
            depth.append(depth[-1] + (1 if x == "{" else -1))
        if min(depth) < 0 or depth[-1]:
            found.append(block)
        if bare.count("$") % 2 or re.search(r"[_^]\\[{}]|\[U\+|[_^]{2}", block):
            found.append(block)
        outside = "".join(bare.split("$")[::2])
        formula = re.search(r"[_^&#]|\\(?:times|gamma|langle)\b", outside)
        if formula and not re.search(r"\\\[|label|ref|linewidth|newcommand| & ", block):
            found.append(outside)
    return found


def test_nothing_is_left_open(texts):
    for name in ("note.tex", "lemmas.tex", "theorems.tex", "numbers.tex"):
        assert not (wrong := faults(texts[name])), (name, wrong[:3])


def test_every_lemma_theorem_and_certificate_is_there_with_its_proof(make, texts):
    for id in make.LEMMAS:
        assert texts["lemmas.tex"].count(rf"\label{{lem:{id}}}") == 1
    for name in ("lemma", "proof"):
        assert texts["lemmas.tex"].count(rf"\begin{{{name}}}") == len(make.LEMMAS)
    answered = [one for rows in readings.READINGS.values() for one in rows if one.by]
    assert texts["theorems.tex"].count(r"\begin{theorem}") == len(answered)
    assert texts["theorems.tex"].count(r"\begin{proof}") == len(answered) + len(readings.READINGS)
    for file in certified.FOLDER.glob("*.json"):
        assert rf"\texttt{{{file.stem}}}" in texts["numbers.tex"]
    for name in re.findall(r"\\input\{(\w+)\}", texts["note.tex"]):
        assert f"{name}.tex" in texts


def test_what_is_cited_and_referred_to_exists(texts):
    whole = "".join(text for name, text in texts.items() if name.endswith(".tex"))
    cited = {key for keys in re.findall(r"\\cite\{([^}]*)\}", whole) for key in keys.split(",")}
    assert cited <= set(re.findall(r"^@\w+\{(\w+),", texts["references.bib"], re.MULTILINE))
    assert set(re.findall(r"\\ref\{([^}]*)\}", whole)) <= set(re.findall(r"\\label\{([^}]*)\}", whole))


def test_what_is_not_proved_is_not_written(make, verdicts, tmp_path):
    records = [verdicts[id] for id in (*make.LEMMAS, *readings.READINGS)]
    records[0] = records[0] | {"verdict": "open"}
    with pytest.raises(SystemExit, match=rf"not proved: {records[0]['id']}; the note has proved statements only"):
        make.main(tmp_path, records)
    assert not list(tmp_path.glob("*.tex"))
