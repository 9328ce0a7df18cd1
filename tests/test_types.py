"""What a user's editor and type checker see of chapsym: the names that there are, with their types."""

import inspect
import re
import sys

from mypy import api

import chapsym
from chapsym import dynamics

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
