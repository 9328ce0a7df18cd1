"""What is declared is imported, and the reverse; the core works alone; what needs an extra names it in a sentence."""

import json
import re
import subprocess
import sys
import tomllib
from contextlib import suppress
from functools import cache
from importlib.metadata import PackageNotFoundError, packages_distributions, requires
from pathlib import Path

import pytest
import typer
from imported import imported, modules

from chapsym import jobs
from chapsym.cli.app import app
from chapsym.dynamics import BadInput
from chapsym.extras import EXTRAS, MissingExtra, need

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
#: What is there wherever it is imported: a notebook's shell.
HOSTS = {"ipython"}
#: Drake is imported by another name than it is installed.
RENAMED = {"pydrake"}
RUNTIME = ("scenes", "figures", "cluster", "report")
#: The packages of all extras, by the names under which they are imported.
BESIDE = {package for extra in RUNTIME for package in EXTRAS[extra][1]}
INPUT = ["--mass-tensor", "1,2,4", "--D", "3", "--momentum", "1,-1/2,3/4", "--gamma", "2/7,3/7,6/7"]


def normal(name):
    return re.sub(r"[-_.]+", "-", name).lower()


def named(requirements):
    """The distributions of requirements, without chapsym's own extras."""
    return {normal(re.match(r"[\w.-]+", one).group()) for one in requirements} - {"chapsym"}


def declared(*extras):
    """The distributions of the core and of these extras."""
    return named(PROJECT["dependencies"]).union(*(named(PROJECT["optional-dependencies"][extra]) for extra in extras))


#: Which distributions have a package: reads the lists of files of all that is installed.
owners = cache(packages_distributions)


@cache
def third_party(folder):
    """The distributions whose packages the files of a folder import, lazily or not."""
    known = modules(folder, folder.name)
    for link in filter(Path.is_symlink, folder.iterdir()):
        known |= modules(link, f"{folder.name}.{link.name}")
    inside = {"chapsym", "benchmarks", "research", *(path.stem for path in folder.glob("*.py"))}
    tops = {other.split(".")[0] for name, path in known.items() for other in imported(name, path, known)}
    outside = tops - set(sys.stdlib_module_names) - inside
    return {normal(owner) for top in outside for owner in owners().get(top, [top])}


def offered(distributions):
    """They, and what each that is installed requires itself: cycler of matplotlib, MarkupSafe of Jinja2."""
    found = set(distributions)
    for one in distributions:
        with suppress(PackageNotFoundError):  # a peer of the benchmarks
            found |= named(line for line in requires(one) or () if "extra ==" not in line)
    return found


@pytest.mark.parametrize(
    ("folder", "extras"),
    [
        ("chapsym", RUNTIME),
        ("benchmarks", (*RUNTIME, "bench", "engines", "test")),  # the fixture of chapsym-rolling
        ("research", RUNTIME),
        ("tests", (*RUNTIME, "test")),
    ],
)
def test_what_is_imported_is_declared(folder, extras):
    allowed = offered(declared(*extras)) | HOSTS | RENAMED | named(EXTRAS["test"][1])
    assert third_party(ROOT / folder) <= allowed


def test_what_is_declared_is_imported():
    formats = (ROOT / "chapsym" / "scene" / "result" / "formats.py").read_text(encoding="utf-8")
    by_xarray = set(re.findall(r'engine="(\w+)"', formats))
    by_h5netcdf = {"h5py"}  # which names no backend of its own from 1.8 on
    assert declared(*RUNTIME) <= third_party(ROOT / "chapsym") | by_xarray | by_h5netcdf
    assert declared("bench") <= third_party(ROOT / "benchmarks") | third_party(ROOT / "chapsym")


@pytest.mark.parametrize("extra", EXTRAS)
def test_the_sentence_of_an_extra_tells_of_what_it_installs(extra):
    words = {normal(owner) for package in EXTRAS[extra][1] for owner in owners()[package]}
    wanted = named(PROJECT["optional-dependencies"][extra])
    assert words == wanted or (extra == "test" and words < wanted)


def test_an_absent_package_is_told_with_its_extra_and_a_present_one_is_not(monkeypatch):
    need("scenes")
    results = "labelled results, and files other than .csv and .npz, need"
    for absent, words in (
        (["pandas"], f"{results} pandas, which is not installed: pip install 'chapsym[scenes]'"),
        (["pandas", "zarr"], f"{results} zarr and pandas, which are not installed: pip install "),
    ):
        for name in absent:
            monkeypatch.setitem(sys.modules, name, None)
        with pytest.raises(MissingExtra, match=re.escape(words)):
            need("scenes")


BITS = """
import chapsym
ball = chapsym.Ball((1, 2, 4), 3, radius=0.1)
path = chapsym.trajectory(ball, (.1, .2, -.1), (2/7, 3/7, 6/7), 3000, attitude=True, time_step=0.01)
rolled = chapsym.roll(ball, omega=(2.0, 30.0, 5.0), time_step=1e-3, steps=40, contact=True)
K4 = [[0, -.03, 0, .01], [.03, 0, .02, 0], [0, -.02, 0, -.05], [-.01, 0, .05, 0]]
four = chapsym.trajectory_n(chapsym.BallN((1, 2, .5, 3), 3, radius=1), K4, (.1, .1, .7, .7), 300, contact=True)
many = chapsym.step(ball, [(.1 * i, .2, 0) for i in range(100)], (2/7, 3/7, 6/7))
ends = path.momentum[-1], path.attitude[-1], rolled.contact[-1], many.momentum, four.momentum[-1], four.contact[-1]
bits = [x.tobytes().hex() for x in ends]
"""
CHILD = f"""
import json, sys
sys.modules.update(dict.fromkeys(json.loads(sys.argv[1])))
import commands
found = dict()
for one in json.loads(sys.argv[2]):
    done = commands.chapsym(*one)
    found[" ".join(one)] = done.returncode, done.stdout, done.stderr
{BITS}
found["bits"] = bits
try:
    chapsym.run_scene(dict())
except Exception as error:
    found["run_scene"] = type(error).__name__ + ": " + str(error)
print(json.dumps(found))
"""


def found_without(absent, *commands):
    """What the commands and the Python of `CHILD` do in a process that has not the packages `absent`.

    What the core itself requires as it is installed here, as typer from 0.29 on does pydantic, cannot be taken away.
    """
    absent = sorted(name for name in absent if normal(name) not in offered(declared()))
    arguments = [sys.executable, "-c", CHILD, json.dumps(absent), json.dumps(commands)]
    done = subprocess.run(arguments, capture_output=True, text=True, cwd=ROOT / "tests", check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_the_core_alone_does_its_work_and_what_needs_more_names_the_extra(tmp_path):
    scene, figure, new = str(ROOT / "docs" / "first.toml"), str(tmp_path / "x.svg"), str(tmp_path / "new.toml")
    runs = [
        ["run", new, "-o", str(tmp_path / f"x.{end}"), *more] for end in ("csv", "npz") for more in ([], ["--json"])
    ]
    work = [
        ["step", *INPUT, "--digits", "50", "--json"], ["branches", *INPUT, "--json"], ["prove", "prop-2"],
        ["scene", "new", new], ["scene", "check", scene], ["scene", "schema"], *runs,
        ["trade", "--accuracy", "1e-8", "--time", "10"],
    ]  # fmt: skip
    names = [[], *([name] for name in typer.main.get_command(app).commands)]
    helps = [[*name, "--help"] for name in names]
    refused = {
        "scenes": (
            ["run", scene, "-o", str(tmp_path / "x.nc")], ["run", scene, "-o", str(tmp_path / "x.zarr")],
        ),
        "figures": (
            ["show", scene, "-o", str(tmp_path)], ["trade", "rounding", "-o", figure],
            ["study", "rotation", "--quick", "-o", str(tmp_path)],
        ),
        "report": (["report", "-o", str(tmp_path / "x.html")], ["extremes", "--quick"]),
        "cluster": (["study", "rotation", "--quick", "--scheduler", "tcp://127.0.0.1:9"],),
    }  # fmt: skip
    everything = [*work, *helps, *(one for those in refused.values() for one in those)]
    alone = found_without(BESIDE, *everything)
    for one in (*work, *helps):
        status, _, words = alone[" ".join(one)]
        assert (status, words.strip()) == (0, ""), (one, words)
    for extra, those in refused.items():
        for one in those:
            status, said, words = alone[" ".join(one)]
            assert (status, said, words.count("\n")) == (2, "", 1), (one, status, said, words)
            assert re.match(rf"chapsym: .* not installed: pip install 'chapsym\[{extra}\]'\n", words), words
    assert {path.suffix for path in tmp_path.iterdir()} == {".toml", ".json", ".csv", ".npz"}
    assert re.match(r"MissingExtra: .*pip install 'chapsym\[figures\]'", alone["run_scene"])
    here = {}
    exec(BITS, here)
    assert alone["bits"] == here["bits"]


def test_a_scene_runs_and_is_stored_with_no_extra_but_its_own(tmp_path):
    """To every format, and a store is gone on with."""
    absent = {*BESIDE, "dask"} - set(EXTRAS["scenes"][1])
    scene = (ROOT / "docs" / "first.toml").read_text(encoding="utf-8")
    (tmp_path / "s.toml").write_text(re.sub(r"steps = \d+", "steps = 200", scene), encoding="utf-8")
    outputs = [str(tmp_path / f"x.{end}") for end in ("zarr", "nc", "csv", "parquet", "npz", "zarr")]
    runs = [["run", str(tmp_path / "s.toml"), "-o", output] for output in outputs]
    found = found_without(absent, *runs)
    assert all(found[" ".join(one)][0] == 0 for one in runs), found
    assert "was complete already" in found[" ".join(runs[0])][1]


def test_what_a_cluster_cannot_import_is_not_told_as_a_wrong_address(monkeypatch):
    def refuses(*arguments, **options):
        raise ImportError("no library of this kind of network")

    monkeypatch.setattr("distributed.Client", refuses)
    words = "what speaks to tcp://127.0.0.1:9 cannot be imported: no library of this kind of network"
    with pytest.raises(BadInput, match=re.escape(words)), jobs.workers("tcp://127.0.0.1:9"):
        pass


def test_the_lowest_versions_that_ci_runs_are_those_that_are_allowed():
    lines = (ROOT / "constraints-lowest.txt").read_text(encoding="utf-8").splitlines()
    pinned = {normal(name): version for name, _, version in (line.partition("==") for line in lines) if version}
    extras = PROJECT["optional-dependencies"]
    for one in (*PROJECT["dependencies"], *(line for extra in (*RUNTIME, "test") for line in extras[extra])):
        if not one.startswith("chapsym["):
            name, bound = re.match(r"([\w.-]+)>=([\d.]+)", one).groups()
            assert re.fullmatch(rf"{re.escape(bound)}(\.0)*", pinned[normal(name)]), one
    assert not [line for line in lines if "://" in line]


def test_a_source_tree_without_its_links_is_not_built(tmp_path):
    links = sorted(str(path.relative_to(ROOT)) for path in (ROOT / "chapsym").rglob("*") if path.is_symlink())
    (tmp_path / "setup.py").write_text((ROOT / "setup.py").read_text("utf-8"), encoding="utf-8")
    for link in links[1:]:
        (tmp_path / link).mkdir(parents=True)
    (tmp_path / links[0]).parent.mkdir(exist_ok=True)
    (tmp_path / links[0]).write_text("../generated", encoding="utf-8")  # as a checkout without links has it
    command = [sys.executable, "setup.py", "--version"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert f"{links[0]} is not what it should lead to: this source tree was" in done.stderr
