"""The text in C of a function of the loops: the same operations on the same operands, in the same order."""

import ast
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from math import copysign
from textwrap import wrap
from typing import Any

from .infer import ALLOCATE, Array, Lookup, NotTranslatable, Types, alternative, base_name, is_external
from .source import Function, Module, Record, constant

#: What binds tighter has the larger number, as in C.
OPERATORS: dict[type, tuple[str, int]] = {
    ast.BitOr: ("|", 4), ast.BitAnd: ("&", 5), ast.Eq: ("==", 6), ast.NotEq: ("!=", 6), ast.Lt: ("<", 7),
    ast.LtE: ("<=", 7), ast.Gt: (">", 7), ast.GtE: (">=", 7), ast.Add: ("+", 9), ast.Sub: ("-", 9),
    ast.Mult: ("*", 10), ast.Div: ("/", 10), ast.FloorDiv: ("div_i", 12), ast.Mod: ("mod_i", 12),
}  # fmt: skip
TERNARY, OR, AND, LESS, UNARY, ATOM = 1, 2, 3, 6, 11, 12
SCALARS = {"b": "int", "i": "int64_t", "r": "real", "d": "double", "w": "int32_t"}
#: Integers up to this are numbers of every type.
EXACT = 2**24
LIBRARY = {
    "math.sqrt": "real_sqrt", "math.exp": "exp", "math.log": "log", "abs": "real_abs", "int": "(int64_t)",
    "float": "(real)", "numpy.float64": "(double)", "numpy.float32": "(real)",
}  # fmt: skip
WIDTH = 118


def c_type(found: Any) -> str:
    """The name of a type in C."""
    if isinstance(found, tuple):  # by the runs of equal types
        runs = [(kind, len(list(run))) for kind, run in groupby(found)]
        return "t_" + "".join(f"{kind}{count if count > 1 else ''}" for kind, count in runs)
    if isinstance(found, Record):
        return found.name
    return str(found) if isinstance(found, Array) else SCALARS[found]


@dataclass(frozen=True)
class Text:
    """An expression in C, and how tightly its outermost operator binds."""

    text: str
    level: int = ATOM

    def at(self, level: int) -> str:
        """The text where an operand has to bind so tightly."""
        return self.text if self.level >= level else f"({self.text})"


@dataclass
class Statement:
    """A statement: its text, with the type where it declares; the blocks of a compound one have their own."""

    text: str
    declares: str = ""
    block: "list[Statement] | None" = None


class Printer(Lookup):
    """Prints one function."""

    def __init__(self, types: Types, function: Function) -> None:
        super().__init__(types, types.of[function])
        self.node, self.name = function.node, function.name
        self.hoisted: list[Statement] = []
        self.temporaries = 0
        self.scope: dict[int, dict[str, str]] = {}
        self.fresh: dict[str, str] = {}
        #: The loops that declare their own variable.
        self.loops: set[tuple[int, str]] = set()
        #: Names that are a field of what a call returned, and how often each name is assigned.
        self.within: dict[str, str] = {}
        stored = (n.id for n in ast.walk(self.node) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store))
        self.stored = Counter(stored)
        self.read_after = loose_variables(self.node)

    # -- expressions

    def number(self, value: float) -> str:
        """A number, of the type of the loops where it is not an integer."""
        if isinstance(value, bool):
            return str(int(value))
        if value != value:
            return "NAN"
        if abs(value) == float("inf"):
            return "INFINITY" if value > 0 else "-INFINITY"
        if isinstance(value, int) or (
            abs(value) <= EXACT and value == int(value) and (value or copysign(1, value) > 0)
        ):
            return str(int(value))
        short = repr(value)
        return f"R({short if len(short) <= 8 else value.hex()})"

    def constant(self, node: ast.expr) -> Text | None:
        """A constant expression; by name where float32 has another."""
        value = self.value(node)
        if value is None or isinstance(value, Function | Module | tuple):
            return None
        if isinstance(node, ast.Name | ast.Attribute):
            module, name = self.named(node)
            if isinstance(module, Module) and name in module.single:
                return Text(f"{module.name}_{name}")
        elif any(
            x in module.single for module, x in (self.named(n) for n in ast.walk(node) if isinstance(n, ast.Name))
        ):
            return None
        text = self.number(value)
        return Text(text, UNARY if text.startswith("-") else ATOM)

    def named(self, node: ast.expr) -> tuple[Module, str]:
        """The module that a constant is defined in, and its name there."""
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            other = self.module.names[node.value.id]
            return other.origins.get(node.attr, (other, node.attr)) if isinstance(other, Module) else (other, node.attr)
        name = node.id if isinstance(node, ast.Name) else ""
        return self.module.origins.get(name, (self.module, name))

    def expression(self, node: ast.expr) -> Text:
        """An expression with one value."""
        found = self.constant(node)
        if found:
            return found
        match node:
            case ast.Name(id=name) if name in self.within:
                return Text(self.within[name])
            case ast.Name(id=name):
                return Text(name if name in self.typed.names else f"{self.module.name}_{name}")
            case ast.BinOp(left=left, op=op, right=right):
                sign, level = self.operator(node, op)
                if isinstance(op, ast.FloorDiv | ast.Mod):
                    return Text(f"{sign}({self.expression(left).text}, {self.expression(right).text})")
                apart = ATOM - 4 if level in (4, 5) else level  # comparisons among bits get parentheses
                first, second = self.expression(left).at(apart), self.expression(right).at(apart + (apart == level))
                if isinstance(op, ast.Div) and self.is_integer(left) and self.is_integer(right):
                    first = f"(real){self.expression(left).at(UNARY)}"
                return Text(f"{first} {sign} {second}", level)
            case ast.UnaryOp(op=ast.Not() | ast.USub() as op, operand=operand):
                text = self.expression(operand).at(UNARY)
                text = f"({text})" if text[0] == "-" else text  # -- is another operator
                return Text(("!" if isinstance(op, ast.Not) else "-") + text, UNARY)
            case ast.Compare():
                return self.compared(node)
            case ast.BoolOp(op=op, values=values):
                sign, level = ("&&", AND) if isinstance(op, ast.And) else ("||", OR)
                parts = [self.expression(values[0]), *map(self.unhoisted, values[1:])]
                return Text(f" {sign} ".join(part.at(AND + 1) for part in parts), level)
            case ast.IfExp(test=test, body=body, orelse=orelse):
                first = self.expression(test).at(LESS)
                yes, no = (self.unhoisted(x).at(TERNARY + 1) for x in (body, orelse))
                return Text(f"{first} ? {yes} : {no}", TERNARY)
            case ast.Attribute(value=ast.Name(id=name), attr=attribute):
                return Text(f"{name}.{attribute}")
            case ast.Subscript(value=ast.Attribute(value=array, attr="shape"), slice=axis):
                return Text(f"{self.expression(array).text}.n{self.value(axis)}")
            case ast.Subscript():
                return Text(self.indexed_text(node))
            case ast.Call():
                return self.call(node)
        raise NotTranslatable(f"{self.name}: {ast.unparse(node)}")

    def operator(self, node: ast.AST, op: ast.AST) -> tuple[str, int]:
        """The sign of an operator, and how tightly it binds; the remainder is of integers, as is the quotient."""
        of = [getattr(node, name) for name in ("left", "right", "target", "value") if hasattr(node, name)]
        is_whole = isinstance(op, ast.FloorDiv | ast.Mod)
        if type(op) not in OPERATORS or (is_whole and not {self.type(x) for x in of} <= {"b", "i"}):
            raise NotTranslatable(f"{self.name}: {ast.unparse(node)}")
        return OPERATORS[type(op)]

    def is_integer(self, node: ast.expr) -> bool:
        """Whether the text of an expression is of integers, also where Python has a float of the same value."""
        value = self.value(node)
        if value is not None:
            return self.number(value).lstrip("-").isdigit()
        match node:
            case ast.BinOp(left=left, right=right, op=op):
                return not isinstance(op, ast.Div) and self.is_integer(left) and self.is_integer(right)
            case ast.UnaryOp(operand=operand):
                return self.is_integer(operand)
            case ast.IfExp(body=body, orelse=orelse):
                return self.is_integer(body) and self.is_integer(orelse)
        return self.type(node) in ("b", "i")

    def unhoisted(self, node: ast.expr) -> Text:
        """An expression that is not always evaluated, or more than once: nothing of it may come before the others."""
        before = len(self.hoisted)
        found = self.expression(node)
        if len(self.hoisted) > before:
            raise NotTranslatable(f"{self.name}: a call in {ast.unparse(node)} would come too early")
        return found

    def compared(self, node: ast.Compare) -> Text:
        """A comparison, or a chain of them."""
        parts, left = [], node.left
        for op, right in zip(node.ops, node.comparators, strict=True):
            sign, level = self.operator(node, op)
            parts.append(
                Text(f"{self.expression(left).at(level + 1)} {sign} {self.expression(right).at(level + 1)}", level)
            )
            left = right
        return parts[0] if len(parts) == 1 else Text(" && ".join(p.at(AND + 1) for p in parts), AND)

    def indexed_text(self, node: ast.Subscript) -> str:
        """An element, a row or a slice of an array."""
        array, kind = self.expression(node.value).at(ATOM), self.type(node.value)
        indices = list(node.slice.elts) if isinstance(node.slice, ast.Tuple) else [node.slice]
        bounds = [x for i in indices for x in ((i.lower, i.upper) if isinstance(i, ast.Slice) else (i,)) if x]
        from_end = any(value < 0 for value in map(self.value, bounds) if value is not None)
        if from_end or any(isinstance(i, ast.Slice) and i.step for i in indices):
            raise NotTranslatable(f"{self.name}: {ast.unparse(node)}")
        if isinstance(indices[0], ast.Slice):
            return self.slice_text(array, kind, indices[0])
        where = " + ".join(
            self.expression(index).at(9)
            if axis == kind.rank - 1
            else f"{self.expression(index).at(10)} * {array}.s{axis}"
            for axis, index in enumerate(indices)
        )
        if len(indices) == kind.rank:
            return f"{array}.p[{where}]"
        left = kind.rank - len(indices)
        rest = [f"{array}.n{axis}" for axis in range(len(indices), kind.rank)]
        rest += [f"{array}.s{axis}" for axis in range(len(indices), kind.rank - 1)]
        return f"({Array(kind.element, left)}){{{array}.p + {where}, {', '.join(rest)}}}"

    def slice_text(self, array: str, kind: Array, node: ast.Slice) -> str:
        """Some of the first axis of an array."""
        low = self.expression(node.lower).at(10 if kind.rank > 1 else 9) if node.lower else "0"
        high = self.expression(node.upper).at(9) if node.upper else f"{array}.n0"
        count = high if low == "0" else f"{high} - {low if low.isalnum() else f'({low})'}"
        step = f" * {array}.s0" if kind.rank > 1 else ""
        rest = [f"{array}.n{axis}" for axis in range(1, kind.rank)] + [f"{array}.s{a}" for a in range(kind.rank - 1)]
        return f"({kind}){{{', '.join([f'{array}.p + {low}{step}' if low != '0' else f'{array}.p', count, *rest])}}}"

    def call(self, node: ast.Call) -> Text:
        """A call that has one value, or none."""
        callee = self.callee(node)
        if isinstance(callee, Function):
            return Text(f"{self.function_name(node, callee)}({', '.join(self.arguments(node, callee))})")
        if isinstance(callee, Record):
            return Text(f"({callee.name}){{{', '.join(self.several(ast.Tuple(node.args)))}}}")
        if callee in ("max", "min"):
            kind, (found, *others) = self.type(node), [self.expression(a).text for a in node.args]
            for other in others:
                found = f"{callee}_{kind}({found}, {other})"
            return Text(found)
        if callee == "len":
            return Text(f"{self.expression(node.args[0]).at(ATOM)}.n0")
        if callee == "math.ldexp":
            first, second = (self.expression(a) for a in node.args)
            return Text(f"(real)ldexp({first.text}, (int){second.at(UNARY)})", UNARY)
        if callee == "abs" and self.type(node) == "i":
            text = self.expression(node.args[0])
            return Text(f"max_i({text.text}, -{text.at(UNARY)})")
        if callee == "reshape":
            array = self.expression(node.func.value).at(ATOM)  # type: ignore[attr-defined]
            rows, columns = (self.expression(x).text for x in node.args[0].elts)  # type: ignore[attr-defined]
            return Text(f"(r2){{({array}).p, {rows}, {columns}, {columns}}}")
        if callee not in LIBRARY:
            raise NotTranslatable(f"{self.name} calls {callee}")
        name, argument = LIBRARY[callee], self.expression(node.args[0])
        if self.type(node) == "d":
            name = name.removeprefix("real_")
        return Text(f"{name}{argument.at(UNARY)}", UNARY) if name[0] == "(" else Text(f"{name}({argument.text})")

    def function_name(self, node: ast.Call, callee: Function) -> str:
        """The name of a function; that of its place where another takes it in float32."""
        other = alternative(self, node, callee)
        if is_external(self.typed.function, callee):
            return f"{callee.name}_double"
        return callee.name if other is callee else other_place(self, node, callee)

    def arguments(self, node: ast.Call, callee: Function) -> Iterator[str]:
        """The arguments of a call; those that a function returns come through a temporary."""
        given = 0
        for argument in node.args:
            if isinstance(argument, ast.Starred):
                several = self.several(argument.value)
                given += len(several)
                yield from several
            else:
                given += 1
                yield self.expression(argument).text
        for name in callee.parameters[given:]:
            yield self.number(constant(callee.defaults[name], callee.module.names))

    def several(self, node: ast.expr) -> list[str]:
        """The values of a tuple, or of a call that returns one."""
        if isinstance(node, ast.Tuple):
            found: list[str] = []
            for x in node.elts:
                found += self.several(x.value) if isinstance(x, ast.Starred) else [self.expression(x).text]
            return found
        if isinstance(node, ast.IfExp) and isinstance(node.body, ast.Tuple) and isinstance(node.orelse, ast.Tuple):
            test = self.expression(node.test).at(LESS)
            pairs = zip(self.several(node.body), self.several(node.orelse), strict=True)
            return [f"{test} ? {a} : {b}" for a, b in pairs]
        kind = self.type(node)
        if isinstance(node, ast.Name) and isinstance(kind, Record):
            return [f"{node.id}.{name}" for name in kind.fields]
        assert isinstance(node, ast.Call)
        temporary, value = self.temporary(), self.returned_by(node)
        self.hoisted.append(Statement(f"{temporary} = {value}", c_type(kind)))
        return [f"{temporary}.a{i}" for i in range(len(kind))]

    def returned_by(self, node: ast.Call) -> str:
        """A call that returns several values."""
        if self.callee(node) == "math.frexp":
            return f"real_frexp({self.expression(node.args[0]).text})"
        return self.call(node).text

    def temporary(self) -> str:
        """A new name."""
        self.temporaries += 1
        return f"t_{self.temporaries}"

    # -- statements

    def body(self) -> list[Statement]:
        """The statements of the function."""
        own = set(self.typed.names) - set(self.typed.function.parameters) - {"_"}
        self.place(self.node.body, own)
        return self.statements(self.node.body)

    def place(self, block: Sequence[ast.stmt], names: set[str]) -> None:
        """Decides in which block each name is declared: the innermost that has all of it."""
        mentions = {name: [s for s in block if name in mentioned(s)] for name in names}
        here: dict[str, str] = {}
        for statement in block:
            alone = {name for name, where in mentions.items() if where == [statement]}
            for inner in blocks(statement):
                inside = {
                    name for name in alone
                    if sum(name in mentioned(s) for b in blocks(statement) for s in b if b is inner)
                    and not any(name in mentioned(s) for b in blocks(statement) if b is not inner for s in b)
                    and name not in headed(statement)
                    and (isinstance(statement, ast.If) or assigned_first(inner, name) or only_loops(inner, name))
                }  # fmt: skip
                self.place(inner, inside)
                alone -= inside
                names = names - inside
        for name in sorted(names, key=lambda n: list(self.typed.names).index(n)):
            if mentions[name] and not only_loops(block, name):
                here[name] = c_type(self.typed.names[name])
            elif mentions[name]:
                self.loops.update((id(statement), name) for statement in mentions[name])
        self.scope[id(block)] = here

    def statements(self, block: Sequence[ast.stmt]) -> list[Statement]:
        """The statements of a block, with the declarations that it has."""
        undeclared, done = dict(self.scope[id(block)]), list[Statement]()
        for statement in block:
            used = [n for n in undeclared if n in mentioned(statement)]
            fresh = {n: undeclared.pop(n) for n in used}
            direct = {n for n in fresh if assigned_first([statement], n)}
            done += [Statement(n, fresh[n]) for n in fresh if n not in direct]
            self.fresh = {n: fresh[n] for n in direct}
            try:
                translated = list(self.statement(statement))
            except (AssertionError, AttributeError, KeyError, TypeError) as error:  # no form that is known here
                raise NotTranslatable(f"{self.name}: {ast.unparse(statement)}") from error
            done += self.hoisted
            self.hoisted = []
            done += translated
        return done

    def statement(self, node: ast.stmt) -> Iterator[Statement]:
        """The statements in C of one in Python; what has to come before it is `hoisted`."""
        match node:
            case ast.Expr(value=ast.Constant()) | ast.Pass():
                return
            case ast.Expr(value=ast.Call() as call):
                yield Statement(self.call(call).text)
            case ast.Assign(targets=[target], value=value):
                yield from self.assign(target, value)
            case ast.Assign(targets=[first, *others], value=value):
                yield self.set(first, self.expression(value).text)
                for target in others:
                    yield self.set(target, self.expression(first).text)
            case ast.AugAssign(target=target, op=ast.FloorDiv() | ast.Mod() as op, value=value):
                yield self.set(target, self.expression(ast.BinOp(target, op, value)).text)
            case ast.AugAssign(target=target, op=op, value=value):
                sign, _ = self.operator(node, op)
                yield Statement(f"{self.expression(target).text} {sign}= {self.expression(value).text}")
            case ast.Return():
                yield Statement(self.returned(node))
            case ast.If(test=test, body=body, orelse=orelse):
                fresh = self.expression(test).text
                yield Statement(f"if ({fresh})", block=self.inner(body))
                if orelse:
                    yield Statement("else", block=self.inner(orelse))
            case ast.While(test=test, body=body, orelse=[]):
                text = self.unhoisted(test).text
                yield Statement(f"while ({text})", block=self.inner(body))
            case ast.For(orelse=[]):
                yield from self.loop(node)
            case ast.Break():
                yield Statement("break")
            case ast.Continue():
                yield Statement("continue")
            case _:
                raise NotTranslatable(f"{self.name}: {ast.unparse(node)}")

    def inner(self, block: Sequence[ast.stmt]) -> list[Statement]:
        """The statements of a block inside another."""
        before, self.hoisted, fresh = self.hoisted, [], self.fresh
        found = self.statements(block)
        self.hoisted, self.fresh = before, fresh
        return found

    def assign(self, target: ast.expr, value: ast.expr) -> Iterator[Statement]:
        """An assignment."""
        if isinstance(value, ast.Call) and self.callee(value) in (*ALLOCATE, "copy") and isinstance(target, ast.Name):
            yield from self.allocated(target.id, value)
        elif isinstance(target, ast.Name) and isinstance(self.type(value), tuple):
            values = self.several(value)
            yield Statement(f"real {target.id}_[] = {{{', '.join(values)}}}")
            declares = self.fresh.pop(target.id, "")
            whole = f"{{{target.id}_, {len(values)}}}"
            yield Statement(f"{target.id} = {whole if declares else f'(r1){whole}'}", declares)
        elif isinstance(target, ast.Tuple):
            yield from self.assign_several(target.elts, value)
        elif isinstance(target, ast.Subscript) and isinstance(self.type(target), Array):
            yield self.filled(target, self.expression(value).text)
        else:
            yield self.set(target, self.expression(value).text)

    def filled(self, target: ast.Subscript, text: str) -> Statement:
        """An assignment of one number to a part of an array."""
        array, kind = self.expression(target.value).at(ATOM), self.type(target.value)
        given = list(target.slice.elts) if isinstance(target.slice, ast.Tuple) else [target.slice]
        given += [ast.Slice()] * (kind.rank - len(given))
        where, heads = [], []
        for axis, index in enumerate(given):
            at = f"i_{axis}" if isinstance(index, ast.Slice) else self.expression(index).at(10)
            where.append(at if axis == kind.rank - 1 else f"{at} * {array}.s{axis}")
            if isinstance(index, ast.Slice):
                low = self.expression(index.lower).text if index.lower else "0"
                high = self.expression(index.upper).text if index.upper else f"{array}.n{axis}"
                heads.append(f"for (int64_t {at} = {low}; {at} < {high}; {at}++)")
        found = Statement(f"{array}.p[{' + '.join(where)}] = {text}")
        for head in reversed(heads):
            found = Statement(head, block=[found])
        return found

    def assign_several(self, targets: Sequence[ast.expr], value: ast.expr) -> Iterator[Statement]:
        """An assignment of several values at once."""
        if isinstance(value, ast.Tuple) and any(
            isinstance(v, ast.Call) and self.callee(v) in ALLOCATE for v in value.elts
        ):
            for target, one in zip(targets, value.elts, strict=True):
                yield from self.assign(target, one)
            return
        names = [ast.unparse(t) for t in targets]
        if isinstance(value, ast.Call) and all(n == "_" or (n in self.fresh and self.stored[n] == 1) for n in names):
            kept = [n for n in names if n != "_"]
            self.hoisted.append(Statement(f"{kept[0]} = {self.returned_by(value)}", c_type(self.type(value))))
            for i, name in enumerate(names):
                if name != "_":
                    del self.fresh[name]
                    self.within[name] = f"{kept[0]}.a{i}"
            return
        values = self.several(value)
        each: list[ast.expr | None] = [value] * len(targets)
        if isinstance(value, ast.Tuple):  # what is starred comes through a temporary
            each = [
                x for v in value.elts for x in ([None] * len(self.type(v.value)) if isinstance(v, ast.Starred) else [v])
            ]
        apart = isinstance(value, ast.Call) or not any(
            later is not None and conflicts(target, later)
            for i, target in enumerate(targets)
            for later in (each[i + 1 :] if isinstance(value, ast.Tuple) else [value])
        )
        if not apart:
            kinds = list(self.elements(value.elts if isinstance(value, ast.Tuple) else value.body.elts))  # type: ignore[attr-defined]
            temporaries = [self.temporary() for _ in names]
            for temporary, kind, text in zip(temporaries, kinds, values, strict=True):
                yield Statement(f"{temporary} = {text}", c_type(kind))
            values = temporaries
        for target, name, text in zip(targets, names, values, strict=True):
            if name != "_":
                yield self.set(target, text)

    def set(self, target: ast.expr, text: str) -> Statement:
        """One assignment; it declares the name where that is fresh."""
        name = target.id if isinstance(target, ast.Name) else ""
        return Statement(f"{name or self.expression(target).text} = {text}", self.fresh.pop(name, ""))

    def allocated(self, name: str, value: ast.Call) -> Iterator[Statement]:
        """A new array, on the stack."""
        kind, memory = self.typed.names[name], f"{name}_"
        declares = self.fresh.pop(name, "")
        if self.callee(value) == "copy":
            yield from self.copied(name, value, declares)
            return
        shape = value.args[0]
        sizes = [self.expression(x).at(UNARY) for x in (shape.elts if isinstance(shape, ast.Tuple) else [shape])]
        sizes = sizes * 2 if self.callee(value) == "numpy.eye" else sizes
        yield Statement(f"ALIGNED {SCALARS[kind.element]} {memory}[{' * '.join(sizes)}]")
        if self.callee(value) != "numpy.empty":
            yield Statement(f"memset({memory}, 0, sizeof {memory})")
        parts = [memory, *sizes, *(" * ".join(sizes[axis + 1 :]) for axis in range(kind.rank - 1))]
        yield Statement(f"{name} = {'' if declares else f'({kind})'}{{{', '.join(parts)}}}", declares)
        if self.callee(value) == "numpy.eye":
            line = Statement(f"{memory}[i_ * ({sizes[0]} + 1)] = 1")
            yield Statement(f"for (int64_t i_ = 0; i_ < {sizes[0]}; i_++)", block=[line])

    def copied(self, name: str, value: ast.Call, declares: str) -> Iterator[Statement]:
        """A copy of a column of a matrix, or of its upper part."""
        column = value.func.value  # type: ignore[attr-defined]
        array, (rows, index) = self.expression(column.value).at(ATOM), column.slice.elts
        count = self.expression(rows.upper).at(10) if rows.upper else f"{array}.n0"
        at = self.expression(index).at(9)
        yield Statement(f"real {name}_[{count}]")
        line = Statement(f"{name}_[i_] = {array}.p[i_ * {array}.s0 + {at}]")
        yield Statement(f"for (int64_t i_ = 0; i_ < {count}; i_++)", block=[line])
        yield Statement(f"{name} = {'' if declares else '(r1)'}{{{name}_, {count}}}", declares)

    def returned(self, node: ast.Return) -> str:
        """A return."""
        if node.value is None:
            return "return"
        kind = self.typed.returned
        if not isinstance(kind, tuple):
            return f"return {self.expression(node.value).text}"
        if isinstance(node.value, ast.Call) and self.type(node.value) == kind:
            return f"return {self.call(node.value).text}"
        return f"return ({c_type(kind)}){{{', '.join(self.several(node.value))}}}"

    def loop(self, node: ast.For) -> Iterator[Statement]:
        """A loop over a range, or over rows that are written down."""
        if isinstance(node.iter, ast.Tuple):
            assert isinstance(node.target, ast.Tuple)
            for row in node.iter.elts:
                yield from self.assign(node.target, row)
                yield Statement("", block=self.inner(node.body))
            return
        assert isinstance(node.iter, ast.Call)
        assert isinstance(node.target, ast.Name)
        independent, bounds = ast.unparse(node.iter.func) == "lanes", [self.expression(a).text for a in node.iter.args]
        start, end, step = {1: ["0", *bounds, "1"], 2: [*bounds, "1"], 3: bounds}[len(bounds)]
        name = node.target.id if node.target.id != "_" else f"i_{self.temporaries}"
        stored = {
            n.id for s in node.body for n in ast.walk(s) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)
        }
        if name in stored or name in self.read_after:
            raise NotTranslatable(f"{self.name}: {name} is more than the variable of its loop")
        if node.target.id == "_":
            self.temporaries += 1
        own = node.target.id == "_" or (id(node), name) in self.loops
        declared = self.fresh.pop(name, "int64_t" if own else "")
        changes = {"1": f"{name}++", "-1": f"{name}--"}
        sign, more = ">" if step[0] == "-" else "<", changes.get(step, f"{name} += {step}")
        if end in stored or (not end.replace("_", "").replace(".", "").isalnum() and not end.isdigit()):
            self.temporaries += 1
            limit = f"end_{self.temporaries}"
            self.hoisted.append(Statement(f"{limit} = {end}", "int64_t"))
            end = limit
        if independent:
            yield Statement("INDEPENDENT", block=[])
        head = f"for ({declared + ' ' if declared else ''}{name} = {start}; {name} {sign} {end}; {more})"
        yield Statement(head, block=self.inner(node.body))


def other_place(lookup: Lookup, node: ast.Call, callee: Function) -> str:
    """The name under which a caller finds a function that float32 has another for."""
    name = ast.unparse(node.func)
    return f"{(lookup.module if name in lookup.module.single else callee.module).name}_{callee.node.name}"


def mentioned(node: ast.AST) -> set[str]:
    """The names in a statement."""
    return {n.id for n in ast.walk(node) if isinstance(n, ast.Name)}


def blocks(node: ast.stmt) -> list[list[ast.stmt]]:
    """The blocks of a compound statement."""
    return [b for b in (getattr(node, "body", None), getattr(node, "orelse", None)) if b]


def headed(node: ast.stmt) -> set[str]:
    """The names in the head of a compound statement."""
    parts = [getattr(node, name, None) for name in ("test", "iter", "target")]
    return set().union(*(mentioned(p) for p in parts if p is not None))


def assigned_first(block: Sequence[ast.stmt], name: str) -> bool:
    """Whether the first statement of a block that has a name assigns it, and does not read it."""
    first = next((s for s in block if name in mentioned(s)), None)
    match first:
        case ast.Assign(targets=[ast.Name(id=found)], value=value):
            return found == name and name not in mentioned(value)
        case ast.Assign(targets=[ast.Tuple(elts=targets)], value=value):
            return any(isinstance(t, ast.Name) and t.id == name for t in targets) and name not in mentioned(value)
    return False


def loose_variables(function: ast.FunctionDef) -> set[str]:
    """Variables of loops that nothing else assigns, and that are read outside of their loops."""
    loops = {n: n.target.id for n in ast.walk(function) if isinstance(n, ast.For) and isinstance(n.target, ast.Name)}
    inside = {
        id(n) for loop, name in loops.items() for s in [loop.target, *loop.body] for n in ast.walk(s)
        if isinstance(n, ast.Name) and n.id == name
    }  # fmt: skip
    outside = [n for n in ast.walk(function) if isinstance(n, ast.Name) and id(n) not in inside]
    assigned = {n.id for n in outside if isinstance(n.ctx, ast.Store)}
    return set(loops.values()) & {n.id for n in outside} - assigned - {"_"}


def only_loops(block: Sequence[ast.stmt], name: str) -> bool:
    """Whether a name is but the variable of loops of a block."""
    found = [s for s in block if name in mentioned(s)]
    return all(isinstance(s, ast.For) and isinstance(s.target, ast.Name) and s.target.id == name for s in found)


def conflicts(target: ast.expr, later: ast.expr) -> bool:
    """Whether an assignment to a target may change what is read later."""
    if isinstance(target, ast.Subscript):
        return base_name(target) in mentioned(later)
    return isinstance(target, ast.Name) and target.id in mentioned(later)


def broken(line: str) -> list[str]:
    """A long line, broken at spaces."""
    indent = " " * (len(line) - len(line.lstrip()))
    return [
        indent + part
        for part in wrap(line.strip(), WIDTH - len(indent), subsequent_indent="    ", break_long_words=False)
    ]


def lines(statements: Sequence[Statement], indent: str = "    ") -> list[str]:
    """Statements as lines: short ones that follow each other share a line."""
    done, line = list[str](), ""

    def flush() -> None:
        nonlocal line
        if line:
            done.extend(broken(indent + line))
        line = ""

    previous = ""
    for statement in statements:
        if statement.block is not None:
            flush()
            previous = ""
            inner = lines(statement.block, indent + "    ")
            if statement.text == "INDEPENDENT":
                done.append("    INDEPENDENT".replace("    ", indent, 1))
            elif statement.text and len(statement.block) == 1 and statement.block[0].block is None:
                whole = f"{indent}{statement.text} {' '.join(x.strip() for x in inner)}"
                done += [whole] if len(whole) <= WIDTH else [*broken(indent + statement.text), *inner]
            else:
                done += [*broken(f"{indent}{statement.text} {{".replace("  {", " {")), *inner, indent + "}"]
            continue
        merged = statement.declares and statement.declares == previous and line
        text = f"{statement.declares} {statement.text}".strip()
        longer = f"{line[:-1]}, {statement.text};" if merged else f"{line} {text};".strip()
        if line and len(indent + longer) > WIDTH and not (merged and len(indent + text) > WIDTH):
            flush()
            longer = f"{text};"
        line, previous = longer, statement.declares
        if not statement.declares and text.startswith(("return", "break", "continue")):
            flush()
    flush()
    return done
