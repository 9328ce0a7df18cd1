"""The scenes that ship as examples, with comments."""

from difflib import get_close_matches
from importlib.resources import files
from pathlib import Path

from .errors import SceneError
from .schema import FILE

#: Taplo, and with it Even Better TOML, read the schema that the first line names.
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
    """The text of an example, with a header for who changes it; raises SceneError if there is none of that name."""
    known = names()
    if name not in known:
        near = get_close_matches(name, known, 1)
        meant = f"did you mean {near[0]}?" if near else f"there are {', '.join(known)}"
        raise SceneError(f"there is no example {name!r}; {meant}")
    return HEADER + (files("chapsym.scene.examples") / f"{name}.toml").read_text(encoding="utf-8")
