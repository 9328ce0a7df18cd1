"""What the core alone is and does, run by the Python of an environment that has the wheel and no extra."""

import csv
import subprocess
import sys
import sysconfig
from importlib.metadata import distributions
from pathlib import Path

import numpy as np

import chapsym
from chapsym.dynamics import native
from chapsym.generated import momentum

PACKAGES, MEGABYTES = 21, 250
#: What a new environment has by itself.
OWN = {"pip", "setuptools"}
INPUT = ["--mass-tensor", "1,2,4", "--D", "3", "--momentum", "1,-1/2,3/4", "--gamma", "2/7,3/7,6/7"]
#: The extra that a command names where it is absent.
ABSENT = {"scenes": ["run", "ball.toml", "-o", "ball.nc"], "figures": ["show", "ball.toml"], "report": ["report"]}


def megabytes(*folders: Path) -> float:
    """On the disk."""
    files = (path for folder in folders for path in folder.rglob("*"))
    return sum(path.lstat().st_blocks * 512 for path in files) / 1e6


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    """The command chapsym of this environment."""
    command = [str(Path(sys.executable).with_name("chapsym")), *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False)


packages = {found.name for found in distributions()}
library = Path(sysconfig.get_path("purelib"))
rest = megabytes(*(library / name for name in OWN))
size = megabytes(library) - rest
clause = f"{len(packages - OWN)} packages, {size:.0f} MB; apart from these {', '.join(sorted(OWN))}, {rest:.0f} MB"
print(f"the core: {clause}")
assert len(packages - OWN) <= PACKAGES, packages
assert size <= MEGABYTES, size

for work in (
    ["step", *INPUT, "--digits", "50", "--json"], ["branches", *INPUT], ["prove", "prop-4"],
    ["codegen", "--check", "--register", sys.argv[1]],  # of five kernels; the tests check all
    ["scene", "new", "ball.toml"], ["run", "ball.toml", "-o", "ball.csv"], ["run", "ball.toml", "-o", "ball.npz"],
):  # fmt: skip
    done = run(*work)
    assert done.returncode == 0, done.stderr
    print(done.stdout.splitlines()[-1])
done = run("--help")  # the tests ask each command
assert (done.returncode, done.stderr) == (0, ""), done.stderr
for extra, arguments in ABSENT.items():
    done = run(*arguments)
    assert (done.returncode, done.stdout) == (2, ""), (arguments, done.stdout)
    assert done.stderr.endswith(f"not installed: pip install 'chapsym[{extra}]'\n"), done.stderr
    print(done.stderr, end="")

for work in (["study", "rotation"], ["bench"], ["extremes"], ["trade", "rounding"]):  # a checkout has what they measure
    done = run(*work)
    assert done.returncode == 2, done.stderr
    assert done.stderr.endswith("is not in the wheel; run this from a checkout\n"), done.stderr

assert native.is_compiled(), "the wheel has no compiled loops"
ball = chapsym.Ball(mass_tensor=(1, 2, 4), D=3, radius=0.1)
start = {"momentum": (0.1, -0.05, 0.075), "gamma": (2 / 7, 3 / 7, 6 / 7)}
one = chapsym.step(ball, **start)
path = chapsym.trajectory(ball, **start, steps=1000)
assert (path.momentum[1] == one.momentum).all()
assert abs((path.momentum * path.gamma).sum(axis=1) - path.momentum[0] @ path.gamma[0]).max() < 1e-14
rolled = chapsym.roll(ball, omega=(2.0, 30.0, 5.0), time_step=1e-3, steps=100, contact=True)
assert rolled.contact is not None
assert rolled.contact.shape == (101, 2)
assert chapsym.branches(ball, **start).complete

many = chapsym.step(ball, path.momentum, path.gamma)
found = momentum(*many.rotation.T, *path.gamma.T, 1, 2, 4, 3)  # the generated kernel, on arrays
assert abs(np.transpose(found) - path.momentum).max() < 1e-14
print(f"Python: {len(path.gamma)} frames; the contact goes to {rolled.contact[-1]}")

arrays = np.load("ball.npz")
rows = list(csv.DictReader(Path("ball.csv").read_text(encoding="utf-8").splitlines()))
for axis in range(3):
    assert [float(row[f"omega_{axis + 1}"]) for row in rows] == arrays["omega"][:, axis].tolist()
print(f"a scene: {len(rows)} rows of a CSV, the same bits as in the .npz")
