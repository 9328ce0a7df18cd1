"""The sources of a result: a module, all of chapsym that it imports, and the modules of its own folder."""

import ast
import hashlib
import importlib.util
from collections.abc import Collection, Iterator
from functools import cache
from pathlib import Path


def fingerprint(module: str, besides: Collection[str] = (), more: str = "") -> str:
    """A hash of the closure of a module, and of a text."""
    digest = hashlib.sha256(more.encode())
    for name in sorted(closure(module, besides)):
        digest.update(name.encode() + b"\n" + source(name).encode())
    return digest.hexdigest()[:16]


def whole(package: Path) -> str:
    """A hash of all Python files in the folder of a package; much faster than that of a closure."""
    digest = hashlib.sha256()
    for path in sorted(package.rglob("*.py")):
        digest.update(str(path.relative_to(package)).encode() + b"\n" + path.read_bytes())
    return digest.hexdigest()[:16]


def closure(module: str, besides: Collection[str] = (), own: bool = False) -> set[str]:
    """The module and all that it imports, directly or through others, of chapsym or of its own folder; but some.

    own: without chapsym, for a module that is not of it.
    """
    reached: set[str] = set()
    pending = [module]
    while pending:
        name = pending.pop()
        if name not in reached and name not in besides:
            reached.add(name)
            pending += [other for other in imports(name) if not own or _beside(other, module)]
    return reached


@cache
def imports(module: str) -> tuple[str, ...]:
    """The modules of chapsym, or of its own folder, that a module imports, at the top and inside functions."""
    package = module if Path(str(file(module))).name == "__init__.py" else module.rpartition(".")[0]
    found: set[str] = set()
    for node in _statements(ast.parse(source(module))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            base = importlib.util.resolve_name("." * node.level + (node.module or ""), package)
            found |= {base} | {f"{base}.{alias.name}" for alias in node.names}
    return tuple(name for name in found if (name.startswith("chapsym.") or _beside(name, module)) and file(name))


def _statements(tree: ast.AST) -> Iterator[ast.AST]:
    """All statements, also those inside of others; no expressions, which are most of a tree and import nothing."""
    pending = [tree]
    while pending:
        node = pending.pop()
        yield node
        for inside in ("body", "orelse", "finalbody", "handlers", "cases"):
            pending += getattr(node, inside, ())


def _beside(name: str, module: str) -> bool:
    """Whether a module is a user's own, of the folder or the package of another one."""
    ours, theirs = file(module), None if module.startswith("chapsym.") else file(name)
    if ours is None or theirs is None:
        return False
    same = name.partition(".")[0] == module.partition(".")[0]
    return same or (Path(theirs).is_relative_to(Path(ours).parent) and "site-packages" not in theirs)


@cache
def file(module: str) -> str | None:
    """The source file of a module; None if the name is not one of a module, or of one without."""
    try:
        spec = importlib.util.find_spec(module)
    except (ModuleNotFoundError, AttributeError):
        return None
    return spec.origin if spec and spec.has_location and str(spec.origin).endswith(".py") else None


def source(module: str) -> str:
    """The text of a module; empty without a file."""
    path = file(module)
    return "" if path is None else importlib.util.decode_source(Path(path).read_bytes())
