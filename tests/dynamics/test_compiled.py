"""What is kept of compiled code: in a closed folder only, whatever lies there, once for all processes."""

import ast
import fcntl
import importlib.util
import inspect
import os
import tempfile
import threading

import pytest

from chapsym.dynamics.levels import code_cache, compiled


def twice(x):
    return 2.0 * x


def fresh(function=twice):
    """The compiled function as a new process would have it."""
    return compiled.compiled.__wrapped__(function)


def loads(function=twice):
    """Whether the code of a function is loaded, not compiled; it runs in either case."""
    ready = fresh(function)
    assert ready(1.5) == 3.0
    assert len(ready.stats.cache_hits) + len(ready.stats.cache_misses) == 1
    return bool(ready.stats.cache_hits)


def files(folder):
    return [path for path in folder.rglob("*") if path.is_file() and path.suffix != ".lock"]


@pytest.fixture
def cache(tmp_path, monkeypatch):
    """A user's cache of its own."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "cache" / "chapsym"


@pytest.fixture
def temporary(tmp_path, monkeypatch):
    """A temporary folder of its own, for a user whose cache cannot be written; returns the name that can be guessed."""
    (tmp_path / "no folder").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "no folder"))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    code_cache._passing.cache_clear()
    yield tmp_path / f"chapsym-{os.getuid()}"
    code_cache._passing.cache_clear()


def test_code_is_kept_for_its_user_only(cache):
    assert not loads()
    assert loads()
    assert {path.stat().st_mode & 0o777 for path in (cache, *cache.iterdir())} == {0o700}


def test_code_is_kept_in_the_temporary_folder(temporary):
    assert not loads()
    assert loads()
    assert files(temporary)


def others_may_write(folder):
    folder.mkdir()
    folder.chmod(0o777)


def its_group_may_write(folder):
    folder.mkdir()
    folder.chmod(0o770)


def is_a_link(folder):
    folder.with_name("elsewhere").mkdir(mode=0o700)
    folder.symlink_to(folder.with_name("elsewhere"))


def is_anothers(folder):
    if os.getuid():
        pytest.skip("only root can give a folder away")
    folder.mkdir(mode=0o755)
    os.chown(folder, 12345, -1)


@pytest.mark.parametrize("inner", [False, True])
@pytest.mark.parametrize("plant", [others_may_write, its_group_may_write, is_a_link, is_anothers])
def test_a_folder_that_others_can_fill_is_not_used(plant, inner, temporary):
    planted = temporary
    if inner:
        temporary.mkdir(mode=0o700)
        planted = temporary / compiled.source_hash()
    plant(planted)
    loads()
    assert not files(planted)
    assert not files(temporary)


def test_nor_is_such_a_cache(cache, tmp_path, monkeypatch, caplog):
    cache.parent.mkdir()
    others_may_write(cache)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    code_cache._say.cache_clear()
    with caplog.at_level("INFO", "chapsym"):
        loads()
    assert not files(cache)
    assert files(tmp_path / f"chapsym-{os.getuid()}")
    assert str(cache) in caplog.text


def test_a_folder_for_one_process_goes_with_it(temporary, monkeypatch):
    at_exit = []
    monkeypatch.setattr("atexit.register", lambda *call, **options: at_exit.append((call, options)))
    others_may_write(temporary)
    folder = code_cache.folder_for("x")
    assert folder.stat().st_mode & 0o777 == 0o700
    ((remove, *arguments), options), = at_exit  # fmt: skip
    remove(*arguments, **options)
    assert not folder.exists()


def empty(path):
    path.write_bytes(b"")


def halved(path):
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def one_bit_off(path):
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    path.write_bytes(data)


def a_link_to_itself(path):
    path.unlink()
    path.symlink_to(path)


def a_folder(path):
    path.unlink()
    path.mkdir()


@pytest.mark.parametrize("damage", [empty, halved, one_bit_off, a_link_to_itself, a_folder])
def test_damaged_code_is_compiled_again(damage, cache):
    loads()
    for path in files(cache):
        damage(path)
    assert not loads()
    assert loads() is (damage is not a_folder)  # a folder stays in the way


def test_code_that_cannot_be_kept_runs(cache):
    ready = fresh()
    (folder,) = cache.iterdir()
    folder.rmdir()
    folder.touch()
    assert ready(1.5) == 3.0


def module(path, text):
    path.parent.mkdir()
    path.write_text(text, encoding="utf-8")
    spec = importlib.util.spec_from_file_location("twofold", path)
    found = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(found)
    return found.twofold


def test_the_same_text_elsewhere_shares_its_code(cache, tmp_path):
    text = "def twofold(x):\n    return x + x\n"
    assert not loads(module(tmp_path / "one" / "twofold.py", text))
    assert loads(module(tmp_path / "two" / "twofold.py", text))
    assert not loads(module(tmp_path / "three" / "twofold.py", text.replace("x + x", "x * 2.0")))


def test_other_types_and_other_processors_have_their_own_code(cache, monkeypatch):
    loads()
    other = fresh()
    assert other(2) == 4.0
    assert other.stats.cache_misses
    assert len(files(cache)) == 2
    monkeypatch.setattr("numba.core.codegen.CPUCodegen.magic_tuple", lambda self: ("another", "processor", ""))
    assert not loads()


def test_one_process_waits_for_another_that_compiles_the_same(tmp_path, monkeypatch):
    told, waits = [], threading.Event()
    monkeypatch.setattr(code_cache.time, "sleep", lambda seconds: waits.set())
    monkeypatch.setattr(code_cache, "PAUSES", 10**9)

    def second():
        with code_cache.alone(tmp_path / "lock"):
            told.append("second")
            waits.set()

    thread = threading.Thread(target=second)
    with code_cache.alone(tmp_path / "lock"):
        thread.start()
        assert waits.wait(600)
        told.append("first")
    thread.join()
    assert told == ["first", "second"]


def test_what_another_process_has_compiled_meanwhile_is_loaded(cache, monkeypatch):
    loads()
    (code,) = files(cache)
    hidden = code.rename(cache / "hidden")
    (lock,) = code.parent.glob("*.lock")
    with open(lock, "ab") as other:
        fcntl.flock(other, fcntl.LOCK_EX)

        def meanwhile(seconds):
            hidden.rename(code)
            fcntl.flock(other, fcntl.LOCK_UN)

        monkeypatch.setattr(code_cache.time, "sleep", meanwhile)
        assert loads()


def test_nobody_waits_for_ever(tmp_path, monkeypatch):
    monkeypatch.setattr(code_cache, "PAUSE", 0.0)
    with code_cache.alone(tmp_path / "lock"), code_cache.alone(tmp_path / "lock"):
        pass


def test_nobody_waits_where_there_are_no_locks(tmp_path, monkeypatch):
    with code_cache.alone(tmp_path / "no folder" / "lock"):
        pass
    monkeypatch.setattr(code_cache, "fcntl", None)
    with code_cache.alone(tmp_path / "lock"), code_cache.alone(tmp_path / "lock"):
        pass


@pytest.mark.parametrize("module", compiled.SOURCES, ids=lambda module: module.__name__)
def test_no_loop_assigns_an_array_to_a_slice(module):
    """That takes a second and a half to compile, for the sentence about shapes that do not fit; a number is cheap."""
    for node in ast.walk(ast.parse(inspect.getsource(module))):
        if isinstance(node, ast.Assign) and not isinstance(node.value, ast.Constant):
            slices = [x for target in node.targets for x in ast.walk(target) if isinstance(x, ast.Slice)]
            assert not slices, f"line {node.lineno}"
