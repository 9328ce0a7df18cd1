"""Help for writing a scene: its JSON Schema, from the tables that check it, and the scenes that ship as examples."""

from difflib import get_close_matches
from importlib.resources import files
from pathlib import Path
from typing import Any

from .errors import Data, SceneError
from .scene import Scene, written
from .units import KNOWN, PURE, Dimension

#: The name of the schema in `chapsym scene new` and in the first line of its files.
FILE = "chapsym-scene.schema.json"

_DIMENSIONS = {dimension.units: dimension for dimension in (*KNOWN, PURE)}


def schema() -> Data:
    """The schema (draft 2020-12) of a scene, with descriptions, units and ranges.

    What goes with what, such as mass with radius, is no part of it: `chapsym scene check` says that.
    """
    definitions: Data = {}
    whole = _spelled(Scene.model_json_schema(), definitions)
    whole["$defs"] |= definitions
    about = "A scene of chapsym: balls that roll without slipping; numbers are SI, or texts with a unit."
    start = {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "chapsym scene", "description": about}
    return start | {key: value for key, value in whole.items() if key not in start}


def _spelled(node: Any, definitions: Data) -> Any:
    """A part of pydantic's schema without null, which TOML lacks, and with references to quantities."""
    if isinstance(node, list):
        return [_spelled(part, definitions) for part in node]
    if not isinstance(node, dict):
        return node
    if "quantity" in node:
        return {key: value for key, value in node.items() if key == "description"} | _reference(node, definitions)
    left = {key: value for key, value in node.items() if key != "title" or not isinstance(value, str)}
    if left.get("default", 0) is None:
        del left["default"]
    if "anyOf" in left:
        kinds = [kind for kind in left["anyOf"] if kind != {"type": "null"}]
        left = {**left, "anyOf": kinds} if len(kinds) > 1 else {**left, **kinds[0]}
        if len(kinds) == 1:
            del left["anyOf"]
            return _spelled(left, definitions)
    items = left.get("prefixItems")
    if items and all(part == items[0] for part in items):  # known to more editors
        del left["prefixItems"]
        left["items"] = items[0]
    return {key: _spelled(value, definitions) for key, value in left.items()}


def _reference(node: Data, definitions: Data) -> dict[str, str]:
    """A reference to a quantity, which is defined at its first use."""
    dimension = _DIMENSIONS[node["quantity"]]
    short = "number" if dimension is PURE else dimension.name.removeprefix("an ").removeprefix("a ")
    name = short if node["swept"] else f"{short} without ranges"
    name = f"positive {name}" if node["positive"] else name
    definitions.setdefault(name.replace(" ", "_"), _quantity(dimension, node["swept"], node["positive"]))
    return {"$ref": f"#/$defs/{name.replace(' ', '_')}"}


def _quantity(dimension: Dimension, swept: bool, positive: bool) -> Data:
    amount: Data = {"type": "number", "description": f"In {dimension.words}, such as {dimension.example[0]}."}
    if positive:
        amount["exclusiveMinimum"] = 0
    text = {
        "type": "string",
        "pattern": r"^\s*[+-]?[0-9.]" + ("[0-9./eE+-]*\\s*$" if dimension is PURE else ""),
        "description": f'A fraction{"" if dimension is PURE else " or with a unit"}, such as "{dimension.example[1]}".',
    }
    if not swept:
        return {"description": f"{dimension.name} ({dimension.units})", "anyOf": [amount, text]}
    one = {"anyOf": [amount, text]}
    ranges = {
        "linspace": _list("Values from a to b at n equal distances: [a, b, n].", [one, one, _WHOLE]),
        "grid": {"type": "array", "items": one, "minItems": 1, "description": "These values: [v1, v2, ...]."},
        "random": _list("Drawn between a and b for each ball: [a, b].", [one, one]),
        "normal": _list("Drawn for each ball with [mean, deviation].", [one, one]),
    }
    table: Data = {"type": "object", "description": "A range, which makes a sweep.", "properties": ranges}
    table |= {"additionalProperties": False, "minProperties": 1, "maxProperties": 1}
    return {"description": f"{dimension.name} ({dimension.units}), or a range", "anyOf": [amount, text, table]}


_WHOLE = {"type": "integer", "minimum": 1}


def _list(about: str, items: list[Data]) -> Data:
    return {"type": "array", "prefixItems": items, "minItems": len(items), "maxItems": len(items), "description": about}


# The examples, with comments.

#: Taplo, and thus Even Better TOML, reads the schema in the first line.
SCHEMA_LINE = f"#:schema ./{FILE}\n"
HEADER = (
    '# Numbers are SI; a text may have a unit, such as "30 rpm", "108.5 mm" or "16 lb", or be a fraction, "2/7".\n'
    "# In the place of a number may stand { linspace = [a, b, n] }, { grid = [v1, v2, ...] }, { random = [a, b] } or\n"
    "# { normal = [mean, deviation] }: a sweep.  `chapsym scene check FILE` says what will run.\n\n"
)
DEFAULT = "bowling"


def names() -> list[str]:
    """The names of the examples."""
    folder = files("chapsym.scene.examples")
    return sorted(Path(entry.name).stem for entry in folder.iterdir() if entry.name.endswith(".toml"))


def example(name: str = DEFAULT) -> str:
    """The text of an example, with a header for editing it; raises SceneError if there is none of that name."""
    known = names()
    if name not in known:
        near = get_close_matches(name, known, 1)
        meant = f"did you mean {near[0]}?" if near else f"there are {', '.join(known)}"
        raise SceneError(f"there is no example {name!r}; {meant}")
    return HEADER + (files("chapsym.scene.examples") / f"{name}.toml").read_text(encoding="utf-8")


def of_robot(path: Path, table: Data) -> str:
    """A scene with the table of the ball of a robot's file; its start and its run are to be changed."""
    ball = written("ball", table)
    start = 'omega = ["60 rpm", 0.0, 0.0]    # body axes, or: velocity = [1.0, 0.0]\ngamma = [0.0, 0.0, 1.0]'
    return f"# The ball of {path.name}.\n{ball}\n[start]\n{start}\n\n[run]\ntime = 10.0\nframes = 500\ncontact = true\n"
