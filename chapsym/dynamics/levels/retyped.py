"""The text of the loops read once more, with every number that it writes in another type.

The text of a kernel or of a loop says `2 * k1` and `8.0 * w`.  NumPy takes such numbers for those of the array beside
them; numba makes float64 of both.  So the text is read from its file again, each literal is replaced by a name, and
the name is bound to the literal in the type that is wanted.  Nothing else changes, so there is one text still:
in the kernels every number counts, in the loops only those with a point, as the others count steps and rows.
"""

import ast
import inspect
from collections.abc import Callable
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any


class _Literals(ast.NodeTransformer):
    """Replaces literals of some types by names, and remembers which name stands for which number."""

    def __init__(self, types: tuple[type, ...]) -> None:
        self.types, self.values = types, dict[str, Any]()

    def visit_Constant(self, node: ast.Constant) -> ast.AST:
        if type(node.value) not in self.types:
            return node
        name = f"literal_{str(node.value).replace('.', '_').replace('-', 'minus_').replace('+', '')}"
        self.values[name] = node.value
        return ast.copy_location(ast.Name(name, ast.Load()), node)


class Family:
    """Modules read in another type, by `number`, which makes one from a float; each is read after those that it uses.

    Where a module of the family imports from another, its twin has what the other's twin has.
    """

    def __init__(self, name: str, number: Callable[[float], Any]) -> None:
        self.name, self.number = name, number
        self.twins: dict[str, ModuleType] = {}

    def kernels(self, package: ModuleType) -> None:
        """Reads all kernels of a package."""
        twin = ModuleType(package.__name__)
        for name, value in vars(package).items():
            if isinstance(value, FunctionType):
                module = self._read(value.__module__, Path(inspect.getfile(value)), (int, float))
                setattr(twin, name, getattr(module, name))
        self.twins[package.__name__] = twin

    def programs(self, module: ModuleType) -> None:
        """Reads a generated module of programs."""
        self._read(module.__name__, Path(str(module.__file__)), (int, float))

    def loops(self, module: ModuleType, **instead: Any) -> Any:
        """Reads a module of loops, and returns the twin; `instead` is what it has in place of the text's own."""
        twin = self._read(module.__name__, Path(str(module.__file__)), (float,))
        vars(twin).update(instead)
        return twin

    def _read(self, name: str, path: Path, types: tuple[type, ...]) -> ModuleType:
        tree = ast.parse(path.read_text(encoding="utf-8"))
        literals = _Literals(types)
        for node in tree.body:
            if isinstance(node, ast.FunctionDef) or int not in types:  # what a kernel has beside it counts rows
                literals.visit(node)
        twin = ModuleType(name)
        twin.__file__, twin.__package__ = str(path), name.rpartition(".")[0]
        names = vars(twin)
        names.update({literal: self.number(value) for literal, value in literals.values.items()}, family=self)
        self.twins[name] = twin
        for node in tree.body:
            # Our own text, never a user's; one statement after the other, so that each sees the twins' names.
            exec(compile(ast.Module([node], []), str(path), "exec"), names)
            if isinstance(node, ast.ImportFrom):
                self._rebind(node, twin)
        return twin

    def _rebind(self, node: ast.ImportFrom, twin: ModuleType) -> None:
        """Takes what was imported from a module of the family from its twin."""
        base = str(twin.__package__).rsplit(".", node.level - 1)[0] if node.level > 1 else twin.__package__
        source = f"{base}.{node.module}" if node.level else node.module
        if source in self.twins:
            for alias in node.names:
                setattr(twin, alias.asname or alias.name, getattr(self.twins[str(source)], alias.name))
