"""chapsym scene: a new scene file, what is in one, and its schema."""

from pathlib import Path
from typing import Annotated

import typer

from .app import app
from .options import Json, argument, takes, writes
from .output import fail, json_text, print_json, put

scenes = typer.Typer()
app.add_typer(scenes, name="scene")


@scenes.callback(invoke_without_command=True)
def scene(context: typer.Context) -> None:
    """Begin a scene file, say what one will run, help an editor with them.

    Example: chapsym scene new ball.toml
    """
    if context.invoked_subcommand is None:
        print(context.get_help())


@scenes.command()
def new(
    file: Annotated[Path, argument("FILE.toml", "What to write.")],
    example: Annotated[str, takes("NAME", "Which: bowling, four, robot, spread or vertical.")] = "bowling",
    from_: Annotated[
        Path | None, takes("ROBOT", "Its ball: a .urdf, a .sdf or MuJoCo's .xml, with one sphere.", "--from")
    ] = None,
    schema: Annotated[bool, typer.Option(help="Write the schema for editors next to it, and name it.")] = True,
    force: Annotated[bool, typer.Option("--force", help="Replace a file that is there.")] = False,
) -> None:
    """Write a scene with comments, to change.

    Example: chapsym scene new my-ball.toml --example robot
    """
    from chapsym.files import write_text
    from chapsym.scene.members.members import ball_of
    from chapsym.scene.read import schema as examples

    text = examples.example(example) if from_ is None else examples.of_robot(from_, ball_of(from_)[0])
    if file.suffix != ".toml":
        fail(f"{str(file)!r}: a scene must end in .toml", 2)
    if (file.exists() or file.is_symlink()) and not force:
        fail(f"{file} is there already: choose another name, or --force to replace it", 2)
    beside = file.parent / examples.FILE
    write_text(file, (examples.SCHEMA_LINE if schema else "") + text)
    if schema:
        write_text(beside, _schema_text())
    put(f"wrote {file}" + (f", and {beside} for editors" if schema else ""))


@scenes.command()
def schema(output: Annotated[Path | None, writes("FILE", "Write it there.")] = None) -> None:
    """Print the JSON Schema of scene files, with descriptions and units.

    Example: chapsym scene schema -o chapsym-scene.schema.json
    """
    from chapsym.files import write_text
    from chapsym.scene.read.schema import schema as described

    if output is None:
        print(json_text(described(), indent=1))
        return
    write_text(output, _schema_text())
    put(f"wrote {output}")


@scenes.command()
def check(file: Annotated[Path, argument("SCENE.toml", "What to read.")], as_json: Json = False) -> None:
    """Say what a scene will run, and what that costs.

    Example: chapsym scene check docs/first.toml
    """
    from chapsym.dynamics import BadInput
    from chapsym.scene import load
    from chapsym.scene.members.exactly import exact_motion
    from chapsym.scene.members.members import expand
    from chapsym.scene.plan.plan import explained, planned
    from chapsym.scene.result.proved import check_outputs
    from chapsym.scene.result.summary import refusals, summary

    try:
        scene = load(file)
        members = expand(scene)
        plan = planned(members, scene.task())
        if scene.run.proved and not scene.maps:
            check_outputs(scene.run.names())
            exact_motion(scene)
        warnings = refusals(scene, members)
        rows = [] if as_json else [*summary(scene, members), *explained(plan)]
    except BadInput as error:
        reason = str(error)
        fail(reason if reason.startswith(str(file)) else f"{file}: {reason}", 2)
    if as_json:
        print_json({"file": str(file), "title": scene.title, **plan.describe(), "warnings": warnings})
        return
    rows += [("warning", reason) for reason in warnings]
    width = min(max(len(key) for key, _ in rows), 24)
    for key, text in rows:
        put(f"{key:{width}}  {text}")


def _schema_text() -> str:
    import json

    from chapsym.scene.read.schema import schema

    return json.dumps(schema(), indent=1, ensure_ascii=False) + "\n"
