"""The types of the loops: of each name, of what each function returns, and which arrays it writes.

A type is "b", "i" or "r" for a truth, an integer or a number of the type that the loops are compiled for; "d" for one
that is float64 in float32, too; an `Array`; a tuple of types; or None where it is not known yet.
"""

import ast
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from .source import Function, Module, NotConstant, Program, Record, constant

#: What a parameter of an exported function may be annotated with.
ANNOTATIONS: dict[str, Any] = {"bool": "b", "int": "i", "float": "r"}
ORDER = ("b", "i", "r", "d")
#: Functions of Python and its libraries, by the type of what they return; None for that of the arguments.
LIBRARY = {
    "math.sqrt": None, "math.exp": "r", "math.log": "r", "math.ldexp": "r", "math.frexp": ("r", "i"), "abs": None,
    "max": None, "min": None, "len": "i", "int": "i", "float": "r", "numpy.float64": "d", "numpy.float32": "r",
}  # fmt: skip
#: What float32 has of its own, and what that takes in float64.
NARROW, WIDE = "single_loop", ("branch",)
ALLOCATE = ("numpy.empty", "numpy.zeros", "numpy.eye")


@dataclass(frozen=True)
class Array:
    """An array: "r", "d", "i" or "w" for its elements, the last for integers of 32 bits, and its number of axes."""

    element: str
    rank: int

    def __str__(self) -> str:
        return f"{self.element}{self.rank}"


ANNOTATIONS |= {
    "Vector": Array("r", 1), "Matrix": Array("r", 2), "Cube": Array("r", 3), "Tensor": Array("r", 4),
    "Integers": Array("i", 1), "Doubles": Array("d", 1),
}  # fmt: skip


class NotTranslatable(ValueError):
    """The text of a loop has something that is not translated."""


def joined(a: Any, b: Any) -> Any:
    """The type that holds both."""
    if a is None or b is None or a == b:
        return a if b is None else b
    if isinstance(a, tuple) and isinstance(b, tuple) and len(a) == len(b):
        return tuple(map(joined, a, b))
    if a in ORDER and b in ORDER:
        return max(a, b, key=ORDER.index)
    raise NotTranslatable(f"one name is both {a} and {b}")


class Typed:
    """A function with what is known of its types so far."""

    def __init__(self, function: Function) -> None:
        self.function = function
        annotated = {
            a.arg: ANNOTATIONS[ast.unparse(a.annotation)] for a in function.node.args.args if a.annotation is not None
        }
        self.names: dict[str, Any] = {name: annotated.get(name) for name in function.parameters}
        #: Its parameters, and what it assigns.
        self.own = {n.id for n in ast.walk(function.node) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)}
        self.own |= set(self.names)
        self.returned: Any = None
        self.returns_nothing = not any(isinstance(n, ast.Return) and n.value for n in ast.walk(function.node))
        #: Parameters whose elements it, or what it calls, assigns.
        self.written: set[str] = set()
        #: The functions that it calls, each with the one that takes its place in float32, or itself.
        self.calls: dict[Function, Function] = {}


class Types:
    """The types of the exported functions of some modules, and of all that these call."""

    def __init__(self, program: Program, roots: Sequence[Function], kind: str | None = None) -> None:
        self.program = program
        self.of: dict[Function, Typed] = {}
        for function in roots:
            typed = self.typed(function)
            for name in function.parameters if kind else ():  # those of kernels are all numbers
                typed.names[name] = kind
        self._changed = True
        while self._changed:
            self._changed = False
            for typed in list(self.of.values()):
                Inference(self, typed).run()
        for typed in self.of.values():
            unknown = [name for name, found in typed.names.items() if found is None]
            if unknown:
                raise NotTranslatable(f"{typed.function.name}: the types of {', '.join(unknown)} are not known")

    def typed(self, function: Function) -> Typed:
        """What is known of a function."""
        if function not in self.of:
            self.of[function] = Typed(function)
            self._changed = True
        return self.of[function]

    def note(self, typed: Typed, name: str, found: Any) -> None:
        """A name has this type, too."""
        if name != "_" and found is not None:
            now = joined(typed.names.get(name), found)
            self._changed |= now != typed.names.get(name)
            typed.names[name] = now

    def note_returned(self, typed: Typed, found: Any) -> None:
        """A function returns this type, too."""
        now = joined(typed.returned, found)
        self._changed |= now != typed.returned
        typed.returned = now

    def note_written(self, typed: Typed, name: str) -> None:
        """A function writes into an array that it is given."""
        if name in typed.function.parameters and name not in typed.written:
            typed.written.add(name)
            self._changed = True


def base_name(node: ast.expr) -> str:
    """The name of the array of which an expression is an element, a row or a copy; "" where there is none."""
    while isinstance(node, ast.Subscript | ast.Attribute | ast.Call):
        node = node.func if isinstance(node, ast.Call) else node.value
    return node.id if isinstance(node, ast.Name) else ""


class Lookup:
    """What names mean in a function."""

    def __init__(self, types: Types, typed: Typed) -> None:
        self.types, self.typed = types, typed
        self.module: Module = typed.function.module

    def value(self, node: ast.expr) -> Any:
        """The value of a constant expression, or None."""
        if any(isinstance(n, ast.Name) and n.id in self.typed.names for n in ast.walk(node)):
            return None
        try:
            return constant(node, self.module.names)
        except NotConstant:
            return None

    def callee(self, node: ast.Call) -> Any:
        """The function that a call takes: a `Function`, the path of one of a library, or "copy" and "reshape"."""
        match node.func:
            case ast.Name(id=name):
                return self.module.names.get(name, name)
            case ast.Attribute(value=ast.Name(id=name), attr=attribute) if name not in self.typed.names:
                module = self.module.names[name]
                return module.names[attribute] if isinstance(module, Module) else f"{module}.{attribute}"
            case ast.Attribute(attr=("copy" | "reshape") as attribute):
                return attribute
        raise NotTranslatable(f"{self.typed.function.name}: {ast.unparse(node)}")

    def type(self, node: ast.expr) -> Any:
        """The type of an expression."""
        if isinstance(node, ast.Tuple):
            return tuple(self.elements(node.elts))
        value = self.value(node)
        if value is not None and not isinstance(value, Function | Module):
            return "b" if isinstance(value, bool) else "i" if isinstance(value, int) else "r"
        match node:
            case ast.Name(id=name) if name in self.typed.own:
                return self.typed.names.get(name)
            case ast.BinOp(left=left, op=op, right=right):
                if isinstance(op, ast.BitAnd | ast.BitOr):
                    return "b"
                found = joined(self.type(left), self.type(right))
                return "r" if isinstance(op, ast.Div) and found in ("b", "i") else "i" if found == "b" else found
            case ast.UnaryOp(op=op, operand=operand):
                return "b" if isinstance(op, ast.Not) else self.type(operand)
            case ast.Compare() | ast.BoolOp():
                return "b"
            case ast.IfExp(body=body, orelse=orelse):
                return joined(self.type(body), self.type(orelse))
            case ast.Attribute(value=ast.Name(id=name)) if name not in self.module.names:  # of a record
                return "r"
            case ast.Subscript(value=ast.Attribute(attr="shape")):
                return "i"
            case ast.Subscript():
                return self.indexed(node)
            case ast.Call():
                return self.called(node)
        raise NotTranslatable(f"{self.typed.function.name}: {ast.unparse(node)}")

    def elements(self, nodes: Sequence[ast.expr]) -> Iterator[Any]:
        """The types of arguments or of the elements of a tuple, of which some may be starred."""
        for node in nodes:
            if isinstance(node, ast.Starred):
                found = self.type(node.value)
                several = "r" * len(found.fields) if isinstance(found, Record) else found
                yield from several if several is not None else (None,)
            else:
                yield self.type(node)

    def indexed(self, node: ast.Subscript) -> Any:
        """The type of an element or of a part of an array, or of one of a tuple."""
        array = self.type(node.value)
        if array is None:
            return None
        if not isinstance(array, Array):
            raise NotTranslatable(f"{self.typed.function.name}: {ast.unparse(node)} is of a tuple")
        indices = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        rank = array.rank - sum(not isinstance(i, ast.Slice) for i in indices)
        if rank:
            return Array(array.element, rank)
        return "i" if array.element in "iw" else array.element

    def called(self, node: ast.Call) -> Any:
        """The type of what a call returns."""
        callee = self.callee(node)
        if isinstance(callee, Function):
            found = self.types.typed(alternative(self, node, callee)).returned
            if is_external(self.typed.function, callee) and isinstance(found, tuple):
                return tuple("d" if x == "r" else x for x in found)
            return found
        if isinstance(callee, Record):
            return callee
        if callee == "copy":
            return self.type(node.func.value)  # type: ignore[attr-defined]
        if callee == "reshape":
            return Array("r", len(node.args[0].elts))  # type: ignore[attr-defined]
        if callee in ALLOCATE:
            shape = node.args[0]
            rank = 2 if callee == "numpy.eye" else len(shape.elts) if isinstance(shape, ast.Tuple) else 1
            return Array(self.element(node), rank)
        if callee not in LIBRARY:
            raise NotTranslatable(f"{self.typed.function.name} calls {callee}")
        if LIBRARY[callee] is not None:
            return LIBRARY[callee]
        found = "r" if callee == "math.sqrt" else None
        for argument in node.args:
            found = joined(found, self.type(argument))
        return found

    def element(self, node: ast.Call) -> str:
        """The elements of a new array."""
        kinds = [*node.args[1:], *(k.value for k in node.keywords if k.arg == "dtype")]
        return {"int64": "i", "int32": "w"}.get(ast.unparse(kinds[0]).rpartition(".")[2], "r") if kinds else "r"


def alternative(lookup: Lookup, node: ast.Call, callee: Function) -> Function:
    """The function whose types a call has: the one that takes its place in float32 where there is such."""
    for module, name in ((lookup.module, ast.unparse(node.func)), (callee.module, callee.node.name)):
        other = module.single.get(name)
        if isinstance(other, Function) and other is not lookup.typed.function:
            return other
    return callee


def is_external(caller: Function, callee: Function) -> bool:
    """Whether what is in float32 calls a function in float64."""
    return caller.module.name == NARROW and callee.module.name in WIDE


class Inference(Lookup):
    """One look at all statements of a function."""

    def run(self) -> None:
        """Notes what the statements say."""
        name = self.typed.function.name
        for node in ast.walk(self.typed.function.node):
            try:
                self.note(node)
            except (AttributeError, KeyError, TypeError, ValueError) as error:  # no form that is known here
                raise NotTranslatable(str(error) if str(error).startswith(name) else f"{name}: {error}") from error

    def note(self, node: ast.AST) -> None:
        """Notes what a statement or a call says."""
        match node:
            case ast.Assign(targets=targets, value=value):
                for target in targets:
                    self.bind(target, self.type(value))
            case ast.AugAssign(target=target, op=op, value=value):
                self.bind(target, self.type(ast.BinOp(target, op, value)))
            case ast.For(target=target, iter=ast.Call()):
                self.bind(target, "i")
            case ast.For(target=target, iter=ast.Tuple(elts=rows)):
                for row in rows:
                    self.bind(target, self.type(row))
            case ast.Return(value=ast.expr() as value):
                found = self.type(value)
                if not isinstance(found, tuple) or None not in found:
                    self.types.note_returned(self.typed, found)
            case ast.Call():
                self.arguments(node)

    def bind(self, target: ast.expr, found: Any) -> None:
        """The types of what is assigned to."""
        match target:
            case ast.Name(id=name):  # a tuple that is kept whole is indexed
                self.types.note(self.typed, name, Array("r", 1) if isinstance(found, tuple) else found)
            case ast.Tuple(elts=targets):
                if isinstance(found, tuple) and (None not in found or len(found) == len(targets)):
                    for one, of_one in zip(targets, found, strict=True):
                        self.bind(one, of_one)
            case ast.Subscript():
                self.types.note_written(self.typed, base_name(target))

    def arguments(self, node: ast.Call) -> None:
        """The types of the parameters of a function that is called, and what it writes."""
        callee = self.callee(node)
        if not isinstance(callee, Function):
            return
        if node.keywords or len(node.args) > len(callee.parameters):
            raise NotTranslatable(f"{self.typed.function.name}: {ast.unparse(node)}")
        self.typed.calls[callee] = alternative(self, node, callee)
        for function in {callee: 0, alternative(self, node, callee): 0}:
            typed = self.types.typed(function)
            given = list(self.elements(node.args))
            if any(isinstance(a, ast.Starred) for a in node.args) and None in given:
                continue
            for name, found in zip(function.parameters, given, strict=False):
                self.types.note(typed, name, "r" if found == "d" else found)
            for name in function.parameters[len(given) :]:
                self.types.note(typed, name, self.default(function, name))
            for name, argument in zip(function.parameters, node.args, strict=False):
                if name in typed.written:
                    self.types.note_written(self.typed, base_name(argument))

    def default(self, function: Function, name: str) -> Any:
        """The type of a default."""
        value = constant(function.defaults[name], function.module.names)
        return "b" if isinstance(value, bool) else "i" if isinstance(value, int) else "r"
