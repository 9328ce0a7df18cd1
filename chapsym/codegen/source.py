"""The loops as a compiler reads them: their functions and constants, by the text of their modules.

The modules are read, not imported: they import kernels that codegen is about to write.
"""

import ast
import operator
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

#: Packages of which a module imports: what is imported from them is not read.
OUTSIDE = ("math", "numpy", "typing", "collections.abc")


class NotConstant(ValueError):
    """An expression is not one of constants."""


@dataclass(eq=False)
class Function:
    """A function of a module: its tree, and the module in which its names are looked up."""

    module: "Module"
    node: ast.FunctionDef

    @property
    def name(self) -> str:
        """Its name in C, which has one scope for all modules."""
        return f"{'kernel' if self.module.name == 'generated' else self.module.name}_{self.node.name}"

    @property
    def parameters(self) -> list[str]:
        """The names of its parameters."""
        return [argument.arg for argument in self.node.args.args]

    @property
    def defaults(self) -> dict[str, ast.expr]:
        """The values that the last parameters have by default."""
        values = self.node.args.defaults
        return dict(zip(self.parameters[len(self.parameters) - len(values) :], values, strict=True))

    @property
    def is_exported(self) -> bool:
        """Whether other languages may call it: the types of all its parameters are annotated."""
        return bool(self.node.args.args) and all(a.annotation is not None for a in self.node.args.args)

    @property
    def is_out_of_line(self) -> bool:
        """Whether it is decorated as one that is called seldom."""
        return any(isinstance(d, ast.Name) and d.id == "out_of_line" for d in self.node.decorator_list)


@dataclass(frozen=True)
class Record:
    """A named tuple of numbers: its name and those of its fields."""

    name: str
    fields: tuple[str, ...]


@dataclass(eq=False)
class Module:
    """What a module defines and imports, by name: functions, numbers, modules, or the path of something outside."""

    name: str
    functions: dict[str, Function] = field(default_factory=dict)
    names: dict[str, Any] = field(default_factory=dict)
    #: What has another value, or is another function, in float32.
    single: dict[str, Any] = field(default_factory=dict)
    #: What is imported by name: the module that has it, and its name there.
    origins: dict[str, "tuple[Module, str]"] = field(default_factory=dict)


class Program:
    """Modules that are read when another imports them, from the text that `load` has for their dotted name."""

    def __init__(self, load: Callable[[str], str]) -> None:
        self._load = load
        self.modules: dict[str, Module] = {}

    def module(self, path: str) -> Module:
        """A module by its dotted path."""
        if path not in self.modules:
            self.modules[path] = self._read(path)
        return self.modules[path]

    def _read(self, path: str) -> Module:
        module = Module(path.rpartition(".")[2])
        for node in ast.parse(self._load(path)).body:
            match node:
                case ast.FunctionDef():
                    module.names[node.name] = module.functions[node.name] = Function(module, node)
                case ast.ClassDef(bases=[ast.Name(id="NamedTuple")], body=body):
                    fields = (
                        n.target.id for n in body if isinstance(n, ast.AnnAssign) and isinstance(n.target, ast.Name)
                    )
                    module.names[node.name] = Record(node.name, tuple(fields))
                case ast.ImportFrom() | ast.Import():
                    module.names.update(self._imported(path, module, node))
                case ast.Assign(targets=[ast.Name(id="SINGLE")], value=ast.Dict() as table):
                    module.single = self._single(module, table)
                case ast.Assign(targets=[target], value=value):
                    module.names.update(_constants(target, value, module.names))
        return module

    def _imported(self, path: str, module: Module, node: ast.ImportFrom | ast.Import) -> dict[str, Any]:
        if isinstance(node, ast.Import):
            return {alias.asname or alias.name: alias.name for alias in node.names}
        base = path.rsplit(".", node.level)[0] if node.level else ""
        source = ".".join(filter(None, (base, node.module)))
        found: dict[str, Any] = {}
        for alias in node.names:
            if source in OUTSIDE:
                found[alias.asname or alias.name] = f"{source}.{alias.name}"
            elif node.module is None:  # from . import module
                found[alias.asname or alias.name] = self.module(f"{source}.{alias.name}")
            else:
                other, name = self.module(source), alias.asname or alias.name
                if alias.name in other.names:
                    found[name] = other.names[alias.name]
                    module.origins[name] = other.origins.get(alias.name, (other, alias.name))
        return found

    def _single(self, module: Module, table: ast.Dict) -> dict[str, Any]:
        """The table of what is otherwise in float32."""
        rows = zip(table.keys, table.values, strict=True)
        return {ast.literal_eval(key): constant(value, module.names) for key, value in rows if key is not None}


ARITHMETIC: dict[type, Callable[[Any, Any], Any]] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv, ast.Pow: operator.pow,
}  # fmt: skip


def constant(node: ast.expr, names: dict[str, Any]) -> Any:
    """The value of an expression of numbers, of names of numbers and of functions, and of tuples of these.

    Raises NotConstant for anything else.
    """
    match node:
        case ast.Constant(value=bool() | int() | float() as number):
            return number
        case ast.Name(id=name) if isinstance(names.get(name), int | float | Function):
            return names[name]
        case ast.Name(id=name) if names.get(name) in ("math.nan", "math.inf"):
            return float(names[name][5:])
        case ast.Attribute(value=ast.Name(id=name), attr=attribute):
            if isinstance(names.get(name), Module) and attribute in names[name].names:
                return names[name].names[attribute]
            if names.get(name) == "numpy" and attribute in ("inf", "nan"):
                return float(attribute)
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return -constant(operand, names)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in ARITHMETIC:
            return ARITHMETIC[type(op)](constant(left, names), constant(right, names))
        case ast.Tuple(elts=elements):
            return tuple(constant(x, names) for x in elements)
    raise NotConstant(ast.unparse(node))


def _constants(target: ast.expr, value: ast.expr, names: dict[str, Any]) -> dict[str, Any]:
    try:
        found = constant(value, names)
    except NotConstant:  # what only Python uses
        return {}
    if isinstance(target, ast.Name) and not isinstance(found, tuple):
        return {target.id: found}
    if isinstance(target, ast.Tuple):
        return {t.id: x for t, x in zip(target.elts, found, strict=True) if isinstance(t, ast.Name)}
    return {}
