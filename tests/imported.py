"""What the files of a package import, lazily or not."""

import ast
from functools import cache


def modules(folder, name):
    """The files of a package by the names of their modules."""
    found = {}
    for path in folder.rglob("*.py"):
        parts = [name, *path.relative_to(folder).with_suffix("").parts]
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


@cache
def statements(text):
    """The imports of a file, wherever they stand."""
    return [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Import | ast.ImportFrom)]


def imported(name, path, known):
    """The modules that a file imports; `from . import x` imports x where that is one of them, else the package."""
    package = name.split(".") if path.name == "__init__.py" else name.split(".")[:-1]
    for node in statements(path.read_text(encoding="utf-8")):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        else:
            base = ".".join([*package[: len(package) - node.level + 1], *filter(None, [node.module])])
            module = base if node.level else node.module
            yield from (x if (x := f"{module}.{alias.name}") in known else module for alias in node.names)
