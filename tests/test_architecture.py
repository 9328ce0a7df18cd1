"""The house: which room imports which, and what importing chapsym costs."""

import ast
import re
import runpy
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest
from imported import imported, modules

import chapsym

ROOT = Path(chapsym.__file__).parent

#: room: the rooms that it imports (design, "The house").
ROOMS = {
    "checker": set(),  # of certificates: the standard library only, see below
    "generated": set(),
    "rationals": set(),
    "extras": set(),
    "files": set(),
    "workers": set(),
    "numbers": set(),
    "derive": set(),
    "sources": set(),
    "prove": {"checker", "derive", "files", "sources", "workers"},
    "codegen": {"checker", "derive", "files", "prove"},
    "mechanics": {"codegen", "derive", "dynamics", "numbers", "prove", "rationals"},
    "dynamics": {"extras", "generated", "numbers", "rationals"},
    "certificates": {"checker", "dynamics", "files", "generated", "numbers", "workers"},
    "accuracy": {"dynamics", "generated", "numbers"},
    "jobs": {"dynamics", "extras", "workers"},
    "scene": {"accuracy", "dynamics", "rationals", "extras", "files", "generated", "jobs", "numbers"},
    "studies": {"dynamics", "files", "generated", "jobs", "scene", "show"},
    "proofs": {"checker", "codegen", "derive", "dynamics", "prove"},
    "report": {"extras", "files"},
    "show": {"dynamics", "extras", "files", "scene"},
    "testing": {"dynamics", "extras", "prove"},
}  # fmt: skip
SYMPY_ROOMS = {"derive", "prove", "codegen", "mechanics", "proofs"}


KNOWN = modules(ROOT, "chapsym")
for room in ROOMS:  # links, too
    KNOWN |= modules(ROOT / room, f"chapsym.{room}")


def files(room):
    """The files of a room by the names of their modules."""
    return {name: path for name, path in KNOWN.items() if name.split(".")[1:2] == [room]}


def imports(room):
    """(file, module that it imports), at the top and inside functions."""
    return [(path, other) for name, path in files(room).items() for other in imported(name, path, KNOWN)]


@pytest.mark.parametrize("room", ROOMS)
def test_no_room_imports_what_the_wheel_has_not_or_sympy_to_run_the_map(room):
    for path, name in imports(room):
        parts = name.split(".")
        assert parts[0] != "benchmarks", f"{path.name} imports {name}, which is not in the wheel"
        assert name != "matplotlib.pyplot", f"{path.name} imports {name}, which opens windows"
        assert room in SYMPY_ROOMS or parts[0] != "sympy", f"{path.name} imports {name}"


def circle(known):
    """The modules that are left when those that import none of the others are taken away, again and again."""
    left = {name: set(imported(name, path, known)) - {name} for name, path in known.items()}
    while free := [name for name, needs in left.items() if not needs & left.keys()]:
        for name in free:
            del left[name]
    return sorted(left)


@pytest.mark.parametrize("room", [*ROOMS, "cli"])
def test_no_file_of_a_room_imports_lazily_or_not_one_that_comes_to_import_it(room):
    assert circle(files(room)) == []


#: The rooms inside of chapsym.scene, each of which imports those before it only.
OF_SCENE = ("read", "members", "plan", "result", "running")


def test_the_rooms_of_scene_stand_on_each_other():
    for name, path in files("scene").items():
        inside = name.split(".")[2:3]
        for other in imported(name, path, KNOWN) if inside and inside[0] in OF_SCENE else ():
            below = other.removeprefix("chapsym.scene.").split(".")[0]
            if below in OF_SCENE:
                assert OF_SCENE.index(below) <= OF_SCENE.index(inside[0]), f"{name} imports {other}"


PAGE = (ROOT.parent / "docs/explanation/architecture.md").read_text(encoding="utf-8")


def test_the_picture_of_the_layers_is_of_the_imports_as_they_are():
    drawing = runpy.run_path(ROOT.parent / "docs/pictures/layers.py")
    imports = drawing["packages"]()
    assert {room: imports[room] for room in ROOMS} == ROOMS
    assert drawing["drawn"]() == drawing["PICTURE"].read_text(encoding="utf-8")


def names_in(file, function):
    """The names in the code of the functions or methods of this name."""
    nodes = ast.walk(ast.parse((ROOT.parent / file).read_text(encoding="utf-8")))
    bodies = [node for node in nodes if isinstance(node, ast.FunctionDef) and node.name == function]
    assert bodies, f"{file} has no function {function}"
    inside = [node for body in bodies for node in ast.walk(body) if isinstance(node, ast.Name | ast.Attribute)]
    return {node.id if isinstance(node, ast.Name) else node.attr for node in inside}


def test_each_function_of_a_walk_names_the_next():
    walks = re.search(r"```text\n(.*?)```", PAGE, re.DOTALL)[1].strip().split("\n\n")
    assert len(walks) == 5
    for walk in walks:
        steps = [
            (line.split()[0], name) for line in walk.split("\n")[1:] for name in line.split(maxsplit=1)[1].split(", ")
        ]
        for (file, function), (_, following) in pairwise(steps):
            assert following in names_in(file, function), f"{walk}: {file} {function}"
        names_in(*steps[-1])


def test_what_the_page_of_the_architecture_opens_is_there():
    for path in re.findall(r"`([\w/]+(?:/|\.py))`", PAGE.partition("## To change")[2]):
        assert (ROOT.parent / path).exists(), path


def test_every_room_is_listed():
    folders = {p.name for p in ROOT.iterdir() if p.is_dir() and not p.name.startswith("_")}
    assert folders - {"cli"} | {"checker", "generated", "proofs"} <= set(ROOMS)


def test_the_checker_of_certificates_uses_the_standard_library_and_itself():
    for path, name in imports("checker"):
        assert name.split(".")[0] in sys.stdlib_module_names or name.startswith("chapsym.checker"), f"{path}: {name}"


def loaded_by(program):
    code = f"import sys\n{program}\nprint(*sorted(m for m in sys.modules if '.' not in m or m == 'numpy.ma'))"
    return set(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split())


def test_import_chapsym_is_light_and_running_the_map_loads_no_sympy_and_no_high_precision():
    """The limit is 0.15 s; what could break it is a heavy import, so those are what is tested."""
    assert not {"numpy", "sympy", "numba", "mpmath", "flint", "typer", "rich", "pydantic"} & loaded_by("import chapsym")
    program = (
        "import chapsym; ball = chapsym.Ball((1, 2, 4), 3)\n"
        "chapsym.trajectory(ball, (.1, 0, 0), (0, 0, 1), 5)\nimport chapsym.scene"
    )
    assert not {"sympy", "numba", "mpmath", "flint", "numpy.ma"} & loaded_by(program)


def test_a_run_to_an_npz_loads_nothing_for_other_files_and_other_screens(tmp_path):
    """What takes longer to load than the run takes: xarray and what it brings, Rich without a terminal, pint."""
    start, run = {"omega": ["1/9", 0, 2]}, {"time": 1, "frames": 2}
    scene = {"ball": {"mass_tensor": [1, 2, 4], "D": 3}, "start": start, "run": run}
    text = "".join(f"[{table}]\n" + "".join(f"{k} = {v}\n" for k, v in keys.items()) for table, keys in scene.items())
    (tmp_path / "scene.toml").write_text(text, encoding="utf-8")
    arguments = ["chapsym", "run", str(tmp_path / "scene.toml"), "-o", str(tmp_path / "out.npz"), "--json"]
    program = (
        f"sys.argv = {arguments}\nfrom chapsym.cli import main\n"
        "import contextlib, io\nwith contextlib.redirect_stdout(io.StringIO()), contextlib.suppress(SystemExit):\n"
        "    main()"
    )
    heavy = {"xarray", "pandas", "dask", "zarr", "h5py", "pyarrow", "rich", "pint", "sympy", "mpmath", "scipy"}
    for _ in range(2):  # and onto the same result
        assert not heavy & loaded_by(program)
        assert (tmp_path / "out.npz").exists()


def test_a_name_that_is_not_there_is_said():
    with pytest.raises(AttributeError, match="no attribute 'nonsense'"):
        _ = chapsym.nonsense


def documented(body):
    """Public functions and classes of a module or class body, and the methods inside."""
    for node in body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and not node.name.startswith("_"):
            yield node
            if isinstance(node, ast.ClassDef):
                yield from documented(node.body)


def test_every_public_function_has_a_docstring():
    missing = []
    for room in sorted(set(ROOMS) - {"generated"}):
        for path in files(room).values():
            for node in documented(ast.parse(path.read_text(encoding="utf-8")).body):
                named = ("number", "sqrt", "write", "digits", "working")
                inherited = path.name == "precisions.py" and node.name in named
                if not (ast.get_docstring(node) or inherited):
                    missing.append(f"{path.name}:{node.lineno} {node.name}")
    assert not missing


def test_one_place_sets_the_bits_and_the_terms_of_flint():
    """They are of all threads: what sets them elsewhere changes what another thread counts with."""
    setting = {
        p for p in ROOT.rglob("*.py") if any(x in p.read_text() for x in (".workprec(", "ctx.cap =", "setattr(ctx, "))
    }
    assert setting == {ROOT / "numbers" / "precisions.py"}


#: What reads the clock on the wall, which may be set back; `time.monotonic` and `perf_counter` may not.
WALL = {"time.time", "time.time_ns", "datetime.date.today", "datetime.datetime.now", "os.stat", "st_mtime", "getmtime"}


def test_nothing_but_a_date_depends_on_the_clock_on_the_wall():
    """A clock that is set back changes no result, no resumption and no lock; a page of figures has its date."""
    reading = set()
    for file in (*ROOT.rglob("*.py"), *(ROOT.parent / "checker").glob("*.py")):
        text = file.read_text(encoding="utf-8")
        tree = ast.walk(ast.parse(text if any(name.rpartition(".")[2] in text for name in WALL) else ""))
        if WALL & {name for node in tree if isinstance(node, ast.Attribute) for name in (ast.unparse(node), node.attr)}:
            reading.add(file.relative_to(ROOT).as_posix())
    assert reading == {"cli/measured.py"}
