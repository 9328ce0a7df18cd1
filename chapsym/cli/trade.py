"""chapsym trade: what speed costs in accuracy, and the cheapest run for an accuracy."""

import math
import re
from collections.abc import Sequence
from decimal import Decimal, localcontext
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from chapsym.rationals import rationals

from .app import app
from .options import BALL, Json, argument, ball_from, contact_from, takes, tensor_from, with_options, writes
from .output import Data, apart, check_printed, fail, print_json, quiet, telling

if TYPE_CHECKING:
    from chapsym.accuracy.answer import Accurate, Choice
    from chapsym.scene import Scene
    from chapsym.scene.members.members import Members

#: The ball and its start, which a scene has, too.
BALL_AND_START = BALL | {
    "omega": Annotated[str | None, takes("W1,W2,W3", "Angular velocity in the body, rad/s.")],
    "gamma": Annotated[str | None, takes("G1,G2,G3", "The unit vertical, upwards, in the body.")],
}


@app.command()
@with_options(BALL_AND_START)
def trade(
    what: Annotated[
        list[str] | None,
        argument(
            "[SECTION]... | SCENE.toml",
            "rounding, proved, contact, state, batch, requests, kernels; with --accuracy a scene.",
        ),
    ] = None,
    accuracy: Annotated[float | None, takes("A", "Choose, run and verify: the error wanted.")] = None,
    time: Annotated[float | None, takes("T", "Seconds to roll, with --accuracy.")] = None,
    of: Annotated[str | None, takes("WHAT", "contact (metres; the default with a radius) or state (relative).")] = None,
    limit: Annotated[float, takes("S", "Seconds that a run may take.")] = 600.0,
    quick: Annotated[bool, typer.Option("--quick", help="Fewer and shorter runs.")] = False,
    fresh: Annotated[bool, typer.Option("--fresh", "--force", help="Replace any result that is there.")] = False,
    output: Annotated[Path | None, writes("FILE", "A figure or a page (.md); with --accuracy the run.")] = None,
    as_json: Json = False,
    **clause: str | None,
) -> None:
    """Measure speed against accuracy; or, with --accuracy, answer what is cheapest, run it, and verify it.

    Without a scene or a ball it rolls the ball of docs/first.toml.  A SECTION needs a checkout of chapsym.

    Example: chapsym trade --accuracy 1e-8 --time 1000
    """
    from chapsym.studies.checkout import in_checkout

    given = {name: value for name, value in clause.items() if value is not None}
    first = next((f"--{'D' if name == 'contact' else name.replace('_', '-')}" for name in given), None)
    if accuracy is None:
        if first or of or time is not None:
            fail(f"{first or ('--of' if of else '--time')} goes with --accuracy", 2)
        command, study = in_checkout("benchmarks", "command"), in_checkout("benchmarks", "trade")
        found = command.measure(what or [], quick, output, as_json, study, " (a scene goes with --accuracy)")
        if missed := study.missed(found):
            fail(missed, 1)
        return
    if len(what or []) > 1:
        fail("--accuracy takes one scene at most", 2)
    if what and first:
        fail(f"the scene has the ball and its start: leave out {first}", 2)
    _answer(Path(what[0]) if what else None, accuracy, time, of, given, limit, output, fresh, as_json)


def _answer(
    scene: Path | None, accuracy: float, time: float | None, of: str | None, given: dict[str, str], limit: float,
    output: Path | None, fresh: bool, as_json: bool,
) -> None:  # fmt: skip
    """Chooses, runs, verifies, and says what was chosen."""
    from chapsym import scene as scenes
    from chapsym.dynamics import BadInput
    from chapsym.scene.plan.plan import plan_of
    from chapsym.scene.result import formats
    from chapsym.scene.running import sweep
    from chapsym.scene.running.store import check_same, save

    for name, value in (("--accuracy", accuracy), ("--time", time), ("--limit", limit)):
        if value is not None and not 0 < value < math.inf:
            fail(f"{name} must be a positive number, not {value:g}", 2)
    if scene is None and time is None:
        fail("--accuracy needs --time, in seconds", 2)
    try:
        if output is not None:
            check_printed(output, as_json)
            formats.check_destination(output)
        wanted = scenes.load_for(scene, accuracy, time) if scene else _described(accuracy, time, given)
        changed: Data = {"limit": limit, "of": of or wanted.run.of}
        if of == "state":  # further outputs are followed, and not to an accuracy of their own
            kept = [name for name in wanted.run.names() if name != "contact"]
            changed |= {"contact": None, "attitude": None, "outputs": kept or ["momentum", "gamma"]}
        plan = plan_of(wanted.with_run(**changed))
        if len(plan.members) > 1:
            fail(f"{scene} has {len(plan.members)} balls: chapsym run takes them, with accuracy under [run]", 2)
        if output is not None and output.exists() and not fresh:
            check_same(output, plan)
        with telling() as about:
            plan, answers = sweep.answering(plan, about)
            if output is not None and output.suffix == ".zarr":  # anew, as the answer is not in it
                for why in sweep.run_to_store(plan, output, fresh=True).lost.values():
                    raise BadInput(why)
            else:
                data = sweep.run(plan)
                if output is not None:
                    save(data, output, plan, fresh)
        answer = answers[0]
    except BadInput as error:
        quiet()
        fail(_in_options(str(error), scene is None), 2)
    quiet()
    with apart(output):
        if as_json:
            print_json(described(answer, plan.members))
        else:
            print_answer(answer, plan.members)


def _in_options(sentence: str, all_of_it: bool) -> str:
    """A sentence about a scene in the words of the command; without a scene file all keys are options."""
    if not all_of_it:
        return sentence.replace("run.accuracy needs run.time", "--accuracy needs --time, or run.time")
    sentence = re.sub(r"\b(?:ball|start|run)\.(\w+)(?:\.\d)?", lambda key: "--" + key[1].replace("_", "-"), sentence)
    return sentence.removeprefix("the scene: ")


def _described(accuracy: float, time: float | None, given: dict[str, str]) -> "Scene":
    """A scene from the options of the command; it reads exact numbers, and refuses what float64 does not hold."""
    from chapsym import scene as scenes

    ball: Data = {"inertia": (0.006, 0.007, 0.009), "mass": 2.0, "radius": 0.1}
    if given.keys() & BALL.keys():  # the numbers as they are written: those of fractions may be too long to be read
        (ball_from if tensor_from(given) is None else contact_from)(given)
        ball = {"D" if name == "contact" else name: _numbers(given[name]) for name in BALL if name in given}
    start = {}
    for name, default in (("omega", "3,-2,1"), ("gamma", "2/7,3/7,6/7")):
        text = given.get(name, default)
        rationals(text, f"--{name}", 3)
        start[name] = _numbers(text)
    run = {"accuracy": accuracy, "time": time, "contact": "radius" in ball}
    return scenes.checked({"ball": ball, "start": start, "run": {k: v for k, v in run.items() if v is not None}})


def _numbers(text: str) -> str | list[str] | list[list[str]]:
    """The texts of one number, of a vector, or of the rows of a matrix."""
    flat = text.replace(";", ",").split(",")
    return flat[0] if len(flat) == 1 else flat if len(flat) == 3 else [flat[:3], flat[3:6], flat[6:]]


def _final(answer: "Accurate", members: "Members") -> dict[str, Sequence[float | str]]:
    """K, γ and the contact point at the end, turned from principal axes, from where the ball started."""
    found: dict[str, Sequence[float | str]] = {**answer.final()}
    axes = members.axes
    if members.place is not None and "contact" in found:
        found["contact"] = [_sum(x, start) for x, start in zip(found["contact"], members.place[0], strict=True)]
    if axes is not None:
        import numpy as np

        from chapsym.dynamics.principal_axes import from_principal

        for name in {"angular_momentum", "gamma"} & found.keys():
            found[name] = from_principal(axes[0], np.array(found[name], dtype=np.float64)).tolist()
    return found


def _sum(x: float | str, start: float) -> float | str:
    """A float, or a decimal string, and a float."""
    if isinstance(x, float):
        return x + float(start)
    with localcontext(prec=2 * len(x) + 40):
        return str(Decimal(x) + Decimal(float(start)))


def described(answer: "Accurate", members: "Members") -> Data:
    """The answer for one ball as plain data, in the axes in which it is given."""
    request, choice = answer.request, answer.choice
    return {
        "accuracy": request.accuracy, "time": request.time, "of": request.of, "choice": _choice(choice),
        "estimate": answer.estimate, "expected_seconds": choice.seconds, "seconds": answer.seconds,
        "attempts": [
            _choice(a.choice) | {"estimate": a.estimate if a.estimate < 1e300 else None, "seconds": a.seconds}
            for a in answer.attempts
        ],
        "final": _final(answer, members),
    }  # fmt: skip


def _choice(choice: "Choice") -> Data:
    return {
        "precision": choice.method.label, "order": choice.method.order, "steps": choice.steps,
        "time_step": choice.time_step,
    }  # fmt: skip


def print_answer(answer: "Accurate", members: "Members") -> None:
    """The answer for a reader, as of `described`."""
    request, choice = answer.request, answer.choice
    unit = "m" if request.of == "contact" else "relative"
    print(f"chosen    {choice.sentence()}")
    off = f"the {request.of} is off by {answer.estimate:.1e} ({unit})"
    print(f"compared  {off}, estimated by the run; wanted {request.accuracy:g}")
    taken = answer.attempts[-1].seconds
    print(f"cost      expected {choice.seconds:.2g} s; taken {taken:.2g} s, in all {answer.seconds:.2g} s")
    for one in answer.attempts[:-1]:
        print(f"          tried before: {one.choice.sentence()}, off by {one.estimate:.1e}")
    for name, values in _final(answer, members).items():
        print(f"{name:9} {_to_estimate(name, values, request.of, answer.estimate)}")


def _to_estimate(name: str, values: Sequence[float | str], of: str, estimate: float) -> str:
    """The components with the decimals that the estimate is about; six digits of what was not compared."""
    if (name == "contact") != (of == "contact"):
        return "  ".join(f"{float(x):.6g}" for x in values) + "  (not compared)"
    size = max(abs(Decimal(x)) for x in values) if name == "angular_momentum" else Decimal(1)
    error = Decimal(estimate) * size
    return "  ".join(f"{Decimal(x):.{max(0, -error.adjusted())}f}" if error else str(x) for x in values)
