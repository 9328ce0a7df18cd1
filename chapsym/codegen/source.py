"""The source of the loops for the compiler: their functions and constants, from the text of their modules.

The modules are read and not imported, since they import kernels that codegen writes.
"""

import ast
import operator
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from .printer import FUNCTIONS

#: The modules of the double-double numbers of the loops, and of their operations.
LOOSE, PAIRS = "chapsym.numbers.loose", "chapsym.numbers.pairs"
#: Packages whose imports are not read.
OUTSIDE = ("math", "numpy", "typing", "collections.abc", FUNCTIONS, LOOSE)


@dataclass(frozen=True)
class Array:
    """An array: the kind of its elements, and its number of axes."""

    element: str
    rank: int

    def __str__(self) -> str:
        return f"{self.element}{self.rank}"


#: The kinds by annotation, of a parameter of an exported function or a field of a named tuple.
ANNOTATIONS: dict[str, Any] = {
    "bool": "b", "int": "i", "float": "r", "Vector": Array("r", 1), "Matrix": Array("r", 2), "Cube": Array("r", 3),
    "Tensor": Array("r", 4), "Integers": Array("i", 1), "Doubles": Array("d", 1),
    "Three": ("r",) * 3, "Four": ("r",) * 4, "Nine": ("r",) * 9,
}  # fmt: skip


class NotConstant(ValueError):
    """An expression is not constant."""


@dataclass(eq=False)
class Function:
    """A function of a module: its tree, the module of its names, and the kinds of its specialisation."""

    module: "Module"
    node: ast.FunctionDef
    variant: str = ""

    @property
    def name(self) -> str:
        """The name in C, which has one scope for all modules."""
        return f"{'kernel' if self.module.name == 'generated' else self.module.name}_{self.node.name}{self.variant}"

    @property
    def parameters(self) -> list[str]:
        """The names of the parameters."""
        return [argument.arg for argument in self.node.args.args]

    @property
    def is_exported(self) -> bool:
        """Whether other languages may call it: the types of all its parameters are annotated."""
        return bool(self.node.args.args) and all(a.annotation is not None for a in self.node.args.args)

    @property
    def is_out_of_line(self) -> bool:
        """Whether it is decorated as rarely called."""
        return any(isinstance(d, ast.Name) and d.id == "out_of_line" for d in self.node.decorator_list)


@dataclass(frozen=True)
class Record:
    """A named tuple: its name, and the name and the kind of each of its fields."""

    name: str
    fields: tuple[tuple[str, Any], ...]


@dataclass(frozen=True)
class Varying:
    """A name with another value, or another function, in float32; its name in C is that of both."""

    name: str
    double: Any
    single: Any


@dataclass(eq=False)
class Module:
    """The names that a module defines and imports: functions, numbers, modules, or paths of external objects."""

    name: str
    functions: dict[str, Function] = field(default_factory=dict)
    names: dict[str, Any] = field(default_factory=dict)


class Program:
    """Modules, read when another imports them, from the text that `load` gives for their dotted name."""

    def __init__(self, load: Callable[[str], str]) -> None:
        self._load = load
        self._modules: dict[str, Module] = {}
        self.varying: list[Varying] = []

    def module(self, path: str) -> Module:
        """A module by its dotted path."""
        if path not in self._modules:
            self._modules[path] = self._read(path)
        return self._modules[path]

    def _read(self, path: str) -> Module:
        module, varying = Module(path.rpartition(".")[2]), dict[str, Any]()
        names = module.names
        for node in ast.parse(self._load(path)).body:
            match node:
                case ast.FunctionDef(name=name):
                    names[name] = module.functions[name] = Function(module, node)
                case ast.ClassDef(name=name, bases=[ast.Name(id="NamedTuple")], body=body):
                    fields = ((ast.unparse(n.target), n.annotation) for n in body if isinstance(n, ast.AnnAssign))
                    names[name] = Record(name, tuple((field, ANNOTATIONS[ast.unparse(kind)]) for field, kind in fields))
                case ast.Import(names=aliases):
                    names.update((alias.asname or alias.name, alias.name) for alias in aliases)
                case ast.ImportFrom():
                    names.update(self._imported(path, node))
                case ast.Assign(targets=[ast.Name(id="SINGLE")], value=ast.Dict(keys=keys, values=values)):
                    varying = {ast.literal_eval(k): constant(v, names) for k, v in zip(keys, values, strict=True) if k}
                case ast.Assign(targets=[target], value=value):
                    with suppress(NotConstant):  # used only in Python
                        names.update(_bound(target, constant(value, names)))
        for name, other in varying.items():
            names[name] = Varying(f"{module.name}_{name}", names[name], other)
            self.varying.append(names[name])
        return module

    def _imported(self, path: str, node: ast.ImportFrom) -> dict[str, Any]:
        base = path.rsplit(".", node.level)[0] if node.level else ""
        source = ".".join(filter(None, (base, node.module)))
        names = {alias.asname or alias.name: alias.name for alias in node.names}
        if source in OUTSIDE:
            return {here: f"{source}.{name}" for here, name in names.items()}
        if node.module is None:  # from . import module
            return {here: self.module(f"{source}.{name}") for here, name in names.items()}
        known = self.module(source).names
        return {here: known[name] for here, name in names.items() if name in known}


ARITHMETIC: dict[type, Callable[[float, float], float]] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv, ast.Pow: operator.pow,
}  # fmt: skip


def meaning(node: ast.expr, names: dict[str, Any]) -> Any:
    """The meaning of a name, or of a name in a module; else None."""
    match node:
        case ast.Name(id=name):
            return names.get(name)
        case ast.Attribute(value=ast.Name(id=name), attr=attribute):
            module = names.get(name)
            return module.names.get(attribute) if isinstance(module, Module) else f"{module}.{attribute}"
    return None


def constant(node: ast.expr, names: dict[str, Any]) -> Any:
    """The value of an expression of numbers, names of numbers or functions, and tuples; raises NotConstant."""
    match node:
        case ast.Constant(value=bool() | int() | float() as number):
            return number
        case ast.Name() | ast.Attribute():
            value = meaning(node, names)
            value = value.double if isinstance(value, Varying) else value
            if isinstance(value, int | float | Function):
                return value
            if value in ("math.nan", "math.inf", "numpy.nan", "numpy.inf"):
                return float(value.rpartition(".")[2])
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return -constant(operand, names)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in ARITHMETIC:
            return ARITHMETIC[type(op)](constant(left, names), constant(right, names))
        case ast.Tuple(elts=elements):
            return tuple(constant(x, names) for x in elements)
    raise NotConstant(ast.unparse(node))


def _bound(target: ast.expr, value: Any) -> dict[str, Any]:
    """The names and values that an assignment of a constant defines."""
    pairs = zip(target.elts, value, strict=True) if isinstance(target, ast.Tuple) else [(target, value)]
    return {name.id: x for name, x in pairs if isinstance(name, ast.Name) and not isinstance(x, tuple)}
