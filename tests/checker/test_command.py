"""python -m chapsym.checker and python checker: exit statuses, sentences, JSON."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import certificate_maker as maker
import pytest
from register_changes import resting

import chapsym.checker
from chapsym.checker.__main__ import main

FOLDER = Path(chapsym.checker.__file__).parent


@pytest.fixture(scope="module")
def right():
    return maker.measure(level="0.2430009529063826355053267220620552038", digits=37)


@pytest.fixture
def files(tmp_path, right):
    """A right certificate, a changed one, a text, and one that is not there."""
    (tmp_path / "right.json").write_text(json.dumps(right))
    (tmp_path / "changed.json").write_text(json.dumps(right | {"steps": 8}))
    (tmp_path / "text.json").write_text("nonsense")
    return {name: str(tmp_path / f"{name}.json") for name in ("right", "changed", "text", "missing")}


@pytest.mark.parametrize(
    ("names", "status"),
    [
        ("right", 0),
        ("right right", 0),
        ("changed", 1),
        ("right changed", 1),
        ("text", 2),
        ("missing", 2),
        ("text changed", 2),
    ],
)
def test_the_exit_status_is_that_of_the_worst_file(files, names, status, capsys):
    assert main([files[name] for name in names.split()]) == status
    out, err = capsys.readouterr()
    assert len(err.splitlines()) == sum(name != "right" for name in names.split())
    assert out.count("Proved: For every ball with J = (1, 2, 4)") == names.count("right")


def test_the_name_of_a_file_adds_no_line_and_hides_none(files, tmp_path, capsys):
    forged = "a.json: accepted (register-claim)\n\x1b[2K"
    Path(files["right"]).rename(tmp_path / forged)
    assert main([str(tmp_path / forged), forged]) == 2
    out, err = capsys.readouterr()
    assert "\x1b" not in out + err
    assert not any(line.endswith("a.json: accepted (register-claim)") for line in (out + err).splitlines())
    assert len(err.splitlines()) == 1


def test_what_rests_on_others_is_accepted_only_with_them(tmp_path, right, capsys):
    """A claim by its id and its digest, and a file of another kind by its digest."""
    c = resting(claim="c")
    b = resting(f"c {c['digest']}", claim="b")
    files = {
        "a": resting(f"b {b['digest']}", f"c {c['digest']}", claim="a"), "b": b, "c": c,
        "by digest": resting(right["digest"], claim="by-digest"), "digest": right,
        "other id": resting(f"b {c['digest']}", claim="other"), "no id": resting(c["digest"], claim="no"),
        "other c": resting(f"b {'0' * 64}", claim="c"),
    }  # fmt: skip
    for name, data in files.items():
        (tmp_path / name).write_text(json.dumps(data))
    for names, status in {
        "a b c": 0, "c b a": 0, "a c": 1, "a b": 1, "b c": 0, "by digest": 1, "by digest,digest": 0,
        "other id,b,c": 1, "no id,c": 1, "b,other c": 1,
    }.items():  # fmt: skip
        given = names.split(",") if "," in names or names in files else names.split()
        assert main([str(tmp_path / name) for name in given]) == status, names
        err = capsys.readouterr().err
        assert bool(err) is bool(status)
        assert all("rests on" in line for line in err.splitlines())


def test_two_files_that_differ_are_no_certificate_of_one_claim(tmp_path, capsys):
    """What says less would stand for the other; the same file may be given twice."""
    for name, data in {"1": resting(claim="c"), "2": resting(claim="c"), "3": resting(claim="c", more=True)}.items():
        (tmp_path / name).write_text(json.dumps(data))
    first, same, other = (str(tmp_path / name) for name in "123")
    assert main([first, same]) == 0
    assert main([first, other]) == 1
    assert capsys.readouterr().err.count("is of claim c, too") == 2
    on_it = tmp_path / "4"
    on_it.write_text(json.dumps(resting(f"c {resting(claim='c')['digest']}", claim="d")))
    assert main([first, same, str(on_it)]) == 0
    assert main([first, other, str(on_it)]) == 1
    assert "which is not accepted" in capsys.readouterr().err


def test_json_is_one_object_and_nothing_else_on_standard_output(files, capsys):
    assert main(["--json", *files.values()]) == 2
    right, changed, text, missing = json.loads(capsys.readouterr().out)["certificates"]
    assert right["accepted"]
    assert right["statement"].startswith("For every ball")
    assert not changed["accepted"]
    assert "statement" in changed["reason"]
    assert "JSON" in text["reason"]
    assert "No such file" in missing["reason"]


@pytest.mark.parametrize("content", [b"\xff\xfe", b"[1]", b"null", b"[" * 100_000, b'{"a":' + b"9" * 5000 + b"}", b""])
def test_what_is_no_json_object_is_unreadable_in_one_sentence(tmp_path, content, capsys):
    file = tmp_path / "x.json"
    file.write_bytes(content)
    assert main([str(file)]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


def test_a_name_that_stands_twice_and_another_kind_are_rejected(tmp_path, files, capsys):
    text = Path(files["right"]).read_text()
    (tmp_path / "twice.json").write_text(text.replace('"steps": 9,', '"steps": 9, "steps": 9,'))
    assert main([str(tmp_path / "twice.json")]) == 1
    assert "twice" in capsys.readouterr().err
    file = Path(files["text"])
    file.write_text(json.dumps({"format": "chapsym-certificate/1", "kind": "perpetual-motion"}))
    assert main([str(file)]) == 1
    assert capsys.readouterr().err.endswith("and none of kind 'perpetual-motion'\n")


@pytest.mark.parametrize("how", [["-m", "chapsym.checker"], ["-I", "-S", str(FOLDER)]])
def test_it_runs_as_a_module_and_as_a_folder_without_anything_installed(files, how):
    run = subprocess.run([sys.executable, *how, files["right"], files["changed"]], capture_output=True, text=True)
    assert run.returncode == 1
    assert run.stdout.startswith(f"{files['right']}: accepted (no-invariant-measure)\n  Proved: For every ball")
    assert run.stderr == f"{files['changed']}: rejected: the statement is not the one that the numbers make\n"


@pytest.mark.parametrize(
    ("outputs", "statuses"),
    [(">&-", (0, 1, 2)), ("2>&-", (0, 1, 2)), ("2>/dev/full", (0, 1, 2)), (">/dev/full", (2, 1, 2))],
)
def test_the_status_is_the_verdict_where_an_output_is_closed_or_full(files, outputs, statuses):
    for name, status in zip(("right", "changed", "missing"), statuses, strict=True):
        command = f"{sys.executable} -m chapsym.checker {files[name]} {outputs}"
        run = subprocess.run(command, shell=True, capture_output=True, text=True)
        assert run.returncode == status
        assert "Traceback" not in run.stderr


def test_it_runs_from_a_folder_beside_which_a_file_has_the_name_of_a_module(files, tmp_path):
    """As in an installed chapsym: beside the checker is chapsym/numbers, which is not Python's."""
    shutil.copytree(FOLDER, tmp_path / "checker")
    (tmp_path / "numbers.py").write_text("raise SystemExit(7)")
    for folder in (tmp_path / "checker", FOLDER):
        run = subprocess.run([sys.executable, str(folder), files["right"]], capture_output=True, text=True)
        assert (run.returncode, run.stderr) == (0, "")


def test_nobody_reading_the_output_is_no_traceback(files):
    read, write = os.pipe()
    os.close(read)
    command = [sys.executable, "-m", "chapsym.checker", files["right"]]
    run = subprocess.run(command, stdout=write, stderr=subprocess.PIPE, text=True)
    os.close(write)
    assert (run.returncode, run.stderr) == (141, "")


def test_lists_in_lists_of_any_depth_are_refused_in_one_sentence(files, capsys):
    """At one depth the file can be read, but not be written again for its digest."""
    right = json.loads(Path(files["right"]).read_text())
    right["orbits"][1]["displacement"] = "HERE"
    text, file = json.dumps(right), Path(files["text"])
    for n in range(900, 1001):
        file.write_text(text.replace('"HERE"', "[" * n + "]" * n))
        assert main([str(file)]) in (1, 2)
    assert len(capsys.readouterr().err.splitlines()) == 101
