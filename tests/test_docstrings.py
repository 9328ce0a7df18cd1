"""The public names: their docstrings, and what a user's editor and type checker see of them."""

import doctest
import inspect
import re
import sys

import pytest
from mypy import api

import chapsym
from chapsym import dynamics

SECTION = re.compile(r"^(\w+)\n-{3,}\n", re.MULTILINE)
FUNCTIONS = [name for name in chapsym.__all__ if inspect.isfunction(getattr(chapsym, name))]
PUBLIC = {name: getattr(chapsym, name) for name in chapsym.__all__}
CLASSES = [name for name, one in PUBLIC.items() if inspect.isclass(one) and not issubclass(one, Exception | int)]


def sections(name):
    """The sections of a docstring, by their heads."""
    _, *parts = SECTION.split(inspect.getdoc(getattr(chapsym, name)))
    return dict(zip(parts[::2], parts[1::2], strict=True))


def entries(section):
    """The names of the entries of a section."""
    heads = re.findall(r"^(\S[^:\n]*?)(?: :.*)?$", section, re.MULTILINE)
    return [name.lstrip("*") for head in heads for name in head.split(", ")]


@pytest.mark.parametrize("name", [*FUNCTIONS, *CLASSES])
def test_a_name_has_its_sections_and_examples_that_run(name):
    found, one = sections(name), getattr(chapsym, name)
    if name in FUNCTIONS:
        parameters = inspect.signature(one).parameters
        assert entries(found["Parameters"]) == list(parameters)
        for names, kind in re.findall(r"^(\S[^:\n]*?) : (.*)$", found["Parameters"], re.MULTILINE):
            for given in map(parameters.get, names.split(", ")):
                assert kind.endswith(", optional") is (given.default is not given.empty), given
        assert {"Returns", "Examples"} <= found.keys()
        assert ">>>" in found["Examples"]
    else:
        assert found.keys() & {"Parameters", "Attributes"}
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    for test in doctest.DocTestFinder(exclude_empty=True).find(one, name, globs={}):
        runner.run(test)
    assert runner.summarize(verbose=False).failed == 0


START = """\
import chapsym
ball = chapsym.Ball(mass_tensor=(1, 2, 4), D=3, radius=0.1)
run = chapsym.roll(ball, omega=(2.0, 30.0, 5.0), time_step=1e-3, steps=20, contact=True)
"""
RIGHT = "print(run.contact[-1], run.gamma[0])\n"
WRONG = ("chapsym.no_such", "run.no_such", "chapsym.Ball((1, 2, 4), D=None)", "import chapsym.no_such_room")
#: What these files show does not depend on them, and they would take half a minute.
HEAVY = "chapsym.scene.*,chapsym.show.*,flint.*,mpmath.*,numba.*,xarray.*"


def test_a_script_that_is_right_is_right_to_mypy_and_what_chapsym_does_not_have_is_an_error(tmp_path):
    """To mypy as it is without our settings; the scripts lie outside, and find chapsym as it is installed."""
    (tmp_path / "right.py").write_text(START + RIGHT, encoding="utf-8")
    (tmp_path / "wrong.py").write_text(START + "\n".join(WRONG) + "\n", encoding="utf-8")
    (tmp_path / "mypy.ini").write_text(f"[mypy]\nstrict = True\n[mypy-{HEAVY}]\nfollow_imports = skip\n", "utf-8")
    options = ["--config-file", tmp_path / "mypy.ini", "--cache-dir", tmp_path / "cache", "--python-executable"]
    scripts = [tmp_path / "right.py", tmp_path / "wrong.py"]
    deep = sys.getrecursionlimit()
    try:
        words, errors, _ = api.run([*map(str, [*options, sys.executable, *scripts])])
    finally:
        sys.setrecursionlimit(deep)  # mypy raises it for the whole process, and other tests are of what is too deep
    assert not errors, errors
    assert "right.py" not in words, words
    found = {int(number) for number in re.findall(r"wrong\.py:(\d+): error:", words)}
    assert found == {4, 5, 6, 7}, words


def test_the_names_of_chapsym_are_its_public_ones_with_signatures_that_can_be_read():
    """Not with ten lines of what NumPy can make an array of."""
    functions = [x for x in (getattr(chapsym, name) for name in dir(chapsym)) if inspect.isfunction(x)]
    assert len(functions) > 20
    assert not [f.__name__ for f in functions if "Supports" in str(inspect.signature(f))]
    assert dir(chapsym) == sorted(["__version__", *chapsym.__all__])
    assert set(dynamics.__all__) <= set(chapsym.__all__)  # as type checkers take all of these
