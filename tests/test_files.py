"""Files are written whole, and nothing but a file is replaced."""

import os
import stat
import subprocess
from pathlib import Path

import pytest

from chapsym.files import CannotWrite, check_destination, check_folder, made, pasted, write_text, write_whole


def test_a_file_is_replaced_and_nothing_is_left_beside_it(tmp_path):
    path = tmp_path / "a.txt"
    path.write_text("old", encoding="utf-8")
    write_whole(path, lambda stream: stream.write(b"new"))
    assert path.read_bytes() == b"new"
    assert [p.name for p in tmp_path.iterdir()] == ["a.txt"]
    write_whole(tmp_path / ("ä" * 125 + ".json"), lambda stream: stream.write(b"255 bytes"))


def test_a_file_is_on_the_disk_before_it_has_its_name(tmp_path, monkeypatch):
    """What a power cut between two calls leaves: the old file, or the new one whole."""
    path, done = tmp_path / "one", []
    path.write_text("old")
    for name in ("fsync", "replace"):
        honest = getattr(os, name)

        def seen(*given, name=name, honest=honest):
            done.append((name, path.read_text(), [p.read_text() for p in tmp_path.iterdir() if p != path]))
            return honest(*given)

        monkeypatch.setattr(os, name, seen)
    write_whole(path, lambda stream: stream.write(b"new"))
    assert done == [("fsync", "old", ["new"]), ("replace", "old", ["new"])]


def test_a_failure_leaves_the_old_file(tmp_path):
    path = tmp_path / "a.txt"
    path.write_text("old", encoding="utf-8")

    def fails(stream):
        stream.write(b"half")
        raise OSError(28, "No space left on device")

    with pytest.raises(CannotWrite, match="No space left"):
        write_whole(path, fails)
    assert path.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["a.txt"]


def test_a_pipe_or_a_device_is_not_replaced_by_a_file(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with pytest.raises(CannotWrite, match="a device or a pipe"):
        write_whole(pipe, lambda stream: stream.write(b"x"))
    assert stat.S_ISFIFO(pipe.stat().st_mode)
    with pytest.raises(CannotWrite):
        check_destination(type(pipe)("/dev/null"))
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)


def test_a_folder_is_made_or_there_or_refused(tmp_path, monkeypatch):
    assert made(made(tmp_path / "new" / "deep")).is_dir()
    (tmp_path / "file").write_text("")
    monkeypatch.setattr(os, "access", lambda place, how: place.name != "deep")
    refused = {"file": "it is a file$", "file/x/y": "file is a file$", "x" * 300: "too long", "new/deep": "is writable"}
    for name, clause in refused.items():
        with pytest.raises(CannotWrite, match=f"cannot be .*{clause}"):
            made(tmp_path / name)
    check_folder(tmp_path / "other" / "deep")
    assert not (tmp_path / "other").exists()


@pytest.mark.parametrize("name", ["plain.json", "a b", "it's", "-dash", "line\nend's \\n", "\x1b[2K", "$HOME `x`", "é"])
def test_a_name_is_pasted_into_a_shell_as_it_is(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    path = Path(name)
    path.write_text("here")
    assert pasted(path).isprintable()
    assert subprocess.check_output(["bash", "-c", f"cat {pasted(path)}"], text=True) == "here"
    assert subprocess.check_output(["bash", "-c", f"printf %s {pasted(name)}"], text=True) == name  # a word is no file


def test_a_file_that_is_replaced_keeps_its_permissions(tmp_path):
    path = tmp_path / "mine"
    path.write_text("old", encoding="utf-8")
    path.chmod(0o600)
    write_text(path, "new")
    assert (path.read_text(encoding="utf-8"), stat.S_IMODE(path.stat().st_mode)) == ("new", 0o600)


def test_a_link_stays_a_link(tmp_path):
    target, link = tmp_path / "target", tmp_path / "link"
    target.write_text("old", encoding="utf-8")
    link.symlink_to(target)
    write_whole(link, lambda stream: stream.write(b"new"))
    assert link.is_symlink()
    assert target.read_bytes() == b"new"
