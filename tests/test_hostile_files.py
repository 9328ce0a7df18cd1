"""Files that were changed at random: each reader ends in a result or in one sentence, and writes nothing."""

import ast
import pickle
import random
import re
import warnings
from pathlib import Path

import numpy as np
import pytest
from first import BALL

import chapsym
from chapsym import BadInput, checker
from chapsym.scene import load
from chapsym.scene.plan.plan import plan_of
from chapsym.scene.read.scene import ball_table
from chapsym.scene.result import formats
from chapsym.studies.judge_tables import read_table

ROOT = Path(__file__).parents[1]
SPREAD = f"""{BALL}steps = 4
time_step = 0.01
[sweep]
samples = 3
seed = 7
""".replace("[3.0, -2.0, 1.0]", "[{ random = [1, 2] }, { linspace = [0, 1, 3] }, { normal = [0, 1] }]")
MUJOCO = """<mujoco><compiler angle="degree"/><worldbody><body name="ball"><freejoint/>
<geom type="sphere" size="0.1"/><inertial pos="0 0 0" mass="2" diaginertia="0.006 0.007 0.009"/></body></worldbody>
</mujoco>
"""
SDF = """<sdf version="1.9"><model name="ball"><link name="ball"><inertial><mass>2</mass><inertia><ixx>0.006</ixx>
<iyy>0.007</iyy><izz>0.009</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial><collision name="c"><geometry>
<sphere><radius>0.1</radius></sphere></geometry></collision></link></model></sdf>
"""
NUMBERS = [
    b"nan", b"inf", b"-1", b"1e999", b"0", b"1e-999", b"99999999999999999999", b"1_0", b"0x10", b"[]", b'""', b"-0.0",
    b"1/0", b"9" * 5000, b"true", b"{}", b"null", "½".encode(), b"\x00", b"\xff\xfe", b"<!-- -->", b"&lt;",
]  # fmt: skip
NUMBER = re.compile(rb"\d+(\.\d+)?")


def changed(content, rng):
    """The same with one or two changes: a number, a line, bytes, an end that is missing."""
    for _ in range(rng.choice([1, 1, 2])):
        kind, i, j = rng.randrange(7), *sorted(rng.randrange(len(content) + 1) for _ in range(2))
        lines = content.split(b"\n")
        at = rng.randrange(len(lines))
        if kind <= 1 and (found := list(NUMBER.finditer(content[: 1 << 16]))):
            one = rng.choice(found)
            content = content[: one.start()] + rng.choice(NUMBERS) + content[one.end() :]
        elif kind == 2:
            content = b"\n".join(lines[:at] + lines[at + 1 :])
        elif kind == 3:
            content = b"\n".join([*lines[: at + 1], *lines[at:]])
        elif kind == 4:
            content = content[:i]
        elif kind == 5:
            content = content[:i] + bytes(rng.randrange(256) for _ in range(rng.randrange(1, 9))) + content[i:]
        else:
            j = min(j, i + 40)
            content = content[:i] + content[j:]
        content = content or b" "
    return content


def judged(path):
    return checker.check(checker.read(path))


def read(path):
    return formats.load(path).load()


def planned(path):
    return plan_of(load(path))


#: By name: the text, or what makes it; the reader; and what it may raise.
TEXTS = {
    "scene.toml": (BALL + "time = 1.0\nframes = 8\n", planned, (BadInput,)),
    "spread.toml": (SPREAD, planned, (BadInput,)),
    "ball.urdf": ((ROOT / "benchmarks/rolling/data/robot.urdf").read_bytes(), ball_table, (BadInput,)),
    "ball.xml": (MUJOCO, ball_table, (BadInput,)),
    "ball.sdf": (SDF, ball_table, (BadInput,)),
    "engine.csv": (
        b"".join((ROOT / "benchmarks/rolling/examples/mujoco-robot-1ms.csv").read_bytes().splitlines(True)[:40]),
        read_table, (BadInput,),
    ),
    "orbit.json": ((ROOT / "proofs/certificates/periodic-orbit-simplest.json").read_bytes(), judged,
                   (checker.Rejected, checker.Unreadable)),
    "claim.json": ((ROOT / "proofs/certificates/register/prop-4.json").read_bytes(), judged,
                   (checker.Rejected, checker.Unreadable)),
}  # fmt: skip


RESULTS = ["one.npz", "one.csv", "one.nc", "one.parquet"]


def saved(path):
    """A result in the format of the file's name."""
    ball = chapsym.Ball.from_inertia((0.006, 0.007, 0.009), mass=2.0, radius=0.1)
    formats.save(chapsym.roll(ball, (3, -2, 1), 0.01, 20, contact=True).to_xarray(), path)
    return path.read_bytes()


def wrong(path, content, reader, documented):
    """What is wrong with how a file is read, in words; None if nothing is."""
    path.write_bytes(content)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            reader(path)
        except documented as error:
            return None if 10 < len(str(error)) < 2000 and "\n" not in str(error) else f"says {error!s:.200}"
        except Exception as error:
            return f"{type(error).__name__}: {error!s:.200}"
    return None


@pytest.mark.parametrize("name", [*TEXTS, *RESULTS])
def test_files_that_were_changed(name, tmp_path, request):
    content, reader, documented = TEXTS[name] if name in TEXTS else (saved(tmp_path / name), read, (BadInput,))
    content = content.encode() if isinstance(content, str) else content
    rng, found = random.Random(name), {}
    assert wrong(tmp_path / name, content, reader, ()) is None
    for i in range(4000 if request.config.getoption("--thorough") else 40):
        one = changed(content, rng)
        if (said := wrong(tmp_path / name, one, reader, documented)) is not None:
            found[i] = said
    assert not found
    assert [path.name for path in tmp_path.iterdir()] == [name]


class Code:
    """What runs where it is unpickled."""

    def __reduce__(self):
        return Path.touch, (Path("executed"),)


def test_a_pickle_in_a_result_is_not_read(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    pickle.loads(pickle.dumps(Code()))
    assert Path("executed").exists()
    Path("executed").unlink()
    np.savez("one.npz", momentum=np.array([Code()], dtype=object), allow_pickle=True)
    with pytest.raises(BadInput):
        formats.load(Path("one.npz"))
    assert not Path("executed").exists()


def test_the_page_on_trust_names_tests_that_are_there():
    page = (ROOT / "docs" / "explanation" / "trust.md").read_text(encoding="utf-8")
    named = re.findall(r"\(\.\./\.\./(tests/\S+?\.py)\) `(\w+)`", page)
    assert len(named) >= 12
    for file, test in named:
        tree = ast.parse((ROOT / file).read_text(encoding="utf-8"))
        assert test in {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}, test
