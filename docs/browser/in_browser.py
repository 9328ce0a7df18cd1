"""What the page calls: a ball rolled by the text of the map, and certificates judged; the standard library alone."""

import json
import math
from array import array
from base64 import b64encode
from collections.abc import Callable, Iterable
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any, NamedTuple

import chapsym
from chapsym.checker import file_name, read
from chapsym.checker.__main__ import main as check
from chapsym.checker.shown import lines
from chapsym.dynamics.loops.branch import TAKEN, small_rotation
from chapsym.generated import angular_velocity, centre_step, compose, contact_momentum, rotate, turn

#: What one click may ask for: half a minute.
MOST_STEPS = 20_000
Vector = tuple[float, ...]


class BadInput(Exception):
    """One sentence for the page."""


class Frame(NamedTuple):
    """After a step: 𝒦 and γ in body axes, the attitude as a unit quaternion, and where the ball touches the plane."""

    momentum: Vector
    gamma: Vector
    attitude: Vector
    contact: Vector


def numbers(given: dict[str, str], name: str, count: int = 1) -> Vector:
    """The numbers of a field, separated by commas."""
    try:
        found = tuple(map(float, given[name].split(",")))
    except ValueError:
        found = ()
    if len(found) != count or not all(map(math.isfinite, found)):
        raise BadInput(f"{name} must be {'a number' if count == 1 else f'{count} numbers with commas between'}")
    return found


def positive(given: dict[str, str], name: str, count: int = 1) -> Vector:
    """The same of what is measured from 0 on."""
    found = numbers(given, name, count)
    if min(found) <= 0:
        raise BadInput(f"{name} must be positive")
    return found


def steps(body: tuple[Vector, float, float], K: Vector, count: int) -> tuple[list[Frame], list[Vector]]:
    """The frames of `count` steps that begin with 𝒦 = K and γ = e₃, and the turns between; body: (J, D, radius)."""
    (J, D, radius), frames, turns = body, [Frame(K, (0.0, 0.0, 1.0), (1.0, 0.0, 0.0, 0.0), (0.0, 0.0))], []
    for n in range(count):
        k, g, a, (x, y) = frames[-1]
        status, _, *p = small_rotation(*k, *g, *J, D)
        if status != TAKEN:
            raise BadInput(f"step {n + 1} has no small rotation: 𝒦 is beyond the fold of the map; take a shorter step")
        dx, dy, _ = rotate(*a, *centre_step(*p, *g))
        sine = math.hypot(*p[1:])
        scale = 2 * math.atan2(sine, p[0]) / sine if sine else 2.0
        turns.append(rotate(*a, *(scale * part for part in p[1:])))
        a = compose(*a, *p)
        a = tuple(part / math.hypot(*a) for part in a)
        k, g = (tuple(old + new for old, new in zip(v, turn(*p, *v), strict=True)) for v in (k, g))
        frames.append(Frame(k, g, a, (x + radius * dx, y + radius * dy)))
    return frames, turns


def packed(kind: str, rows: Iterable[Iterable[float]]) -> str:
    """Numbers as the page of a motion reads them."""
    return b64encode(array(kind, (x for row in rows for x in row)).tobytes()).decode("ascii")


def roll(given: dict[str, str]) -> dict[str, Any]:
    """The motion for the page on which the ball rolls, and what to say of it."""
    inertia = positive(given, "inertia", 3)
    (mass,), (radius,), (step,), (time,) = (positive(given, name) for name in ("mass", "radius", "step", "time"))
    omega, count = numbers(given, "omega", 3), round(time / step)
    J = tuple(max(sum(inertia) / 2 - one, 0.0) for one in inertia)
    if max(inertia) > sum(inertia) / 2 * (1 + 1e-12):
        raise BadInput("no body has such moments of inertia: none may be larger than the sum of the two others")
    if not 1 <= count <= MOST_STEPS:
        raise BadInput(f"time / step must be from 1 to {MOST_STEPS} steps, not {count}")
    body = J, (D := mass * radius**2), radius
    K = contact_momentum(*omega, 0.0, 0.0, 1.0, *J, D)
    frames, turns = steps(body, tuple(step * one for one in K), count)
    finer, _ = steps(body, tuple(step / 2 * one for one in K), 2 * count)
    K_of = [tuple(one / step for one in frame.momentum) for frame in frames]
    vectors = {
        "gamma": [frame.gamma for frame in frames],
        "momentum": K_of,
        "omega": [angular_velocity(*K, *frame.gamma, *J, D) for K, frame in zip(K_of, frames, strict=True)],
    }
    ball = {
        "name": "your ball", "radius": radius, "inertia": inertia, "axes": None, "stops": False,
        "attitude": packed("f", [frame.attitude for frame in frames]), "turn": packed("f", turns),
        "contact": packed("d", [frame.contact for frame in frames]),
        "vectors": {name: packed("f", rows) for name, rows in vectors.items()},
    }  # fmt: skip
    end = frames[-1].contact
    kept = abs(math.hypot(*frames[-1].momentum) / math.hypot(*frames[0].momentum) - 1) if any(omega) else 0.0
    said = [
        f"D = {D:.6g} kg m²; it touches the plane at ({end[0]:.4f}, {end[1]:.4f}) m after {step * count:.6g} s.",
        f"With steps half as long it ends {math.dist(end, finer[-1].contact):.1e} m away. |𝒦| changes by {kept:.0e}.",
    ]
    data = {"clock": packed("d", [[step * n for n in range(count + 1)]]), "unit": "s", "balls": [ball]}
    return {"data": data, "plan": f"{count} steps of {step:g} s, the map of the paper", "said": said}


def judge(given: dict[str, str]) -> dict[str, Any]:
    """What the checker says of the certificate of a claim, with those that it rests on; and the formulas judged."""
    folder = Path(chapsym.__file__).parent / "proofs"
    names = {name: file for file, name in read(folder / "manifest.json")["files"].items()}
    files = [f"certificates/register/{file_name(given['claim'])}"]
    for file in files:  # grows while it is read
        rests = read(folder / file).get("rests", [])
        files += [found for one in rests if (found := names[one["certificate"]]) not in files]
    out, own = StringIO(), read(folder / files[0])
    with redirect_stdout(out), redirect_stderr(out):
        check([str(folder / file) for file in files])
    formulas = [f"{name}: {own[name]}" for name in ("printed", "corrected") if own[name]]
    formulas += sorted(lines(own), key=lambda line: line.startswith("algebra "))  # what is assumed at the end
    return {"said": out.getvalue().replace(f"{folder}/", "").splitlines(), "formulas": formulas}


def called(name: str, text: str) -> str:
    """A call of the page, and its answer, as JSON."""
    calls: dict[str, Callable[[Any], dict[str, Any]]] = {"roll": roll, "judge": judge}
    try:
        return json.dumps(calls[name](json.loads(text)))
    except BadInput as error:
        return json.dumps({"error": str(error)})
    except ArithmeticError:
        return json.dumps({"error": "these numbers are too large or too small for float64; take other units"})
