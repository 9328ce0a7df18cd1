"""The functions of the loops as C text: the same operations on the same operands, in the same order.

A function is printed repeatedly until the kinds of its names and results are known.  A kind is "b", "i" or "r" for a
truth value, an integer or a number of the type of the compiled loops; "d" for a number that is float64 also in float32
loops; an `Array`; a `Record`; or a tuple of kinds, as of a vector.  In double-double it is "p" or "q" for a pair,
`Loose` or `Normal`, "e" for a float that counts as exact, "1" for the number 1.  A function is printed separately for
such kinds.
"""

import ast
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import groupby
from textwrap import wrap
from typing import Any

from .printer import FUNCTIONS
from .source import ANNOTATIONS, LOOSE, PAIRS, Array, Function, NotConstant, Program, Record, Varying, constant, meaning

#: Operators of C with their precedences; a larger one binds more tightly.
OPERATORS: dict[type, tuple[str, int]] = {
    ast.BitOr: ("|", 4), ast.BitAnd: ("&", 5), ast.Eq: ("==", 6), ast.NotEq: ("!=", 6), ast.Lt: ("<", 7),
    ast.LtE: ("<=", 7), ast.Gt: (">", 7), ast.GtE: (">=", 7), ast.Add: ("+", 9), ast.Sub: ("-", 9),
    ast.Mult: ("*", 10), ast.Div: ("/", 10), ast.FloorDiv: ("div_i", 12), ast.Mod: ("mod_i", 12),
}  # fmt: skip
TERNARY, OR, AND, LESS, BITS, UNARY, ATOM = 1, 2, 3, 6, 8, 11, 12
#: The kinds of numbers, by increasing range, and w for the elements of an array of 32-bit integers.
SCALARS = {"b": "int", "i": "int64_t", "r": "real", "d": "double", "w": "int32_t"}
#: The kinds of double-double.
LOOSE_SCALARS = {"1": "int64_t", "e": "real", "p": "t_r2", "q": "t_r2"}
#: Functions that add, subtract and multiply two floats, a pair and a float, and two pairs.
FORMS: dict[type, tuple[str, str, str]] = {
    ast.Add: ("two_sum", "loose_add_float", "loose_add"),
    ast.Sub: ("two_sum", "loose_add_float", "loose_subtract"),
    ast.Mult: ("two_product", "loose_multiply_float", "loose_multiply"),
}
#: Functions of Python and its libraries with a C function for float64, and those that are casts to a kind.
LIBRARY = {"math.sqrt": "sqrt", "math.exp": "exp", "math.log": "log", "abs": "fabs"}
CASTS = {"int": "i", "float": "r", "numpy.float32": "r", "numpy.float64": "d"}
#: The module of the float32 loops, and the functions that they use in float64.
NARROW, WIDE = "single_loop", "branch"
#: Calls that make a new array.
ALLOCATE = ("numpy.empty", "numpy.zeros", "numpy.eye", "copy")
WIDTH = 118


class NotTranslatable(ValueError):
    """The text of a loop has an untranslatable construct."""


def joined(a: Any, b: Any) -> Any:
    """The kind that holds both."""
    if a == b:
        return a
    return max(a, b, key=list(SCALARS).index)


def c_type(kind: Any) -> str:
    """The name of a kind in C; for a tuple, the runs of equal kinds, with each inner tuple between underscores."""
    if isinstance(kind, tuple):
        inner = (
            f"_{c_type(one)[2:]}_" if isinstance(one, tuple) else c_type(one) if isinstance(one, Record) else one
            for one in kind
        )
        runs = [(one, len(list(run))) for one, run in groupby(inner)]
        return "t_" + "".join(f"{one}{count if count > 1 else ''}" for one, count in runs)
    if isinstance(kind, Array | Record):
        return kind.name if isinstance(kind, Record) else str(kind)
    return "void" if kind is None else (SCALARS | LOOSE_SCALARS)[kind]


def is_loose(kind: Any) -> bool:
    """Whether a kind is one of double-double, or a tuple that contains one."""
    return any(map(is_loose, kind)) if isinstance(kind, tuple) else isinstance(kind, str) and kind in LOOSE_SCALARS


def widened(kind: tuple[Any, ...]) -> tuple[Any, ...]:
    """The kind of the result of a function of float64, called in float32."""
    return tuple(widened(x) if isinstance(x, tuple) else "d" if x == "r" else x for x in kind)


@dataclass(frozen=True)
class Text:
    """An expression in C, its kind, and the precedence of its outermost operator."""

    text: str
    kind: Any
    level: int = ATOM

    def at(self, level: int) -> str:
        """The text as an operand that must bind at this precedence."""
        return self.text if self.level >= level else f"({self.text})"

    @property
    def parts(self) -> list["Text"]:
        """The fields of a record, or of a returned structure."""
        if isinstance(self.kind, Record):
            return [Text(f"{self.text}.{name}", kind) for name, kind in self.kind.fields]
        if isinstance(self.kind, tuple):
            return [Text(f"{self.text}.a{i}", kind) for i, kind in enumerate(self.kind)]
        raise TypeError("one value is no tuple")


def number(value: float) -> Text:
    """A constant; floats, and integers beyond the range of C, have the type of the loops."""
    value = float(value) if isinstance(value, int) and abs(value) >= 2**63 else value
    if isinstance(value, bool | int):
        return Text(str(int(value)), "b" if isinstance(value, bool) else "i", UNARY if value < 0 else ATOM)
    text = {"inf": "INFINITY", "-inf": "-INFINITY", "nan": "NAN"}.get(repr(value), repr(value))
    return Text(f"R({text})", "r")


@dataclass
class Statement:
    """A statement: its text, with the type for a declaration; a compound statement has a block."""

    text: str
    declares: str = ""
    block: "list[Statement] | None" = None


#: Functions with hand-written C: the exact product is a fused multiply-add.
BY_HAND = {"pairs_two_product": [Statement("real p = a * b"), Statement("return (t_r2){p, fma(a, b, -p)}")]}


class Printer:
    """Prints one function, with the kinds known so far; `printers` has the printers of the others."""

    def __init__(self, printers: "Printers", function: Function) -> None:
        self.printers, self.function, self.module = printers, function, function.module
        #: The tuples and records named in its text, and the names of tuples that are indexed by a variable.
        self.tuples = set[Any](x for x in map(self.annotated, function.node.args.args) if isinstance(x, Record))
        self.listed = {
            n.value.id
            for n in ast.walk(function.node)
            if isinstance(n, ast.Subscript) and isinstance(n.value, ast.Name) and not is_whole(n.slice)
        }
        self.names: dict[str, Any] = {a.arg: self.annotated(a) for a in function.node.args.args if a.annotation}
        #: The returned type; the parameters whose elements it writes.
        self.returned: Any = None
        self.written: set[str] = set()
        #: What a name has parts of, or is another name for.
        self.made: dict[str, Sequence[ast.expr]] = {}
        #: The called functions, each with its replacement in float32, or itself.
        self.calls: dict[Function, Function] = {}
        self.stored = Counter(stored(function.node))
        self.own = {*self.stored, *function.parameters}
        #: The parameters of a function of pairs that are high halves; in C they are whole pairs.
        of_pairs = self.module.name == PAIRS.rpartition(".")[2]
        self.halved = {x for x in function.parameters if of_pairs and f"{x}_" in function.parameters}
        self.statements: list[Statement] | None = None

    def annotated(self, argument: ast.arg) -> Any:
        """The kind of an annotated parameter, which may be a record of its module."""
        name = ast.unparse(argument.annotation) if argument.annotation else ""
        return ANNOTATIONS.get(name) or self.module.names.get(name)

    def run(self) -> None:
        """Prints the function."""
        self.out: list[Statement] = []
        self.depth = self.temporaries = 0
        #: Declared names; those declared at the beginning, with their types; and names for parts of structures.
        self.declared, self.above = set(self.function.parameters), dict[str, str]()
        halves = (("", "a0"), ("_", "a1"))
        self.within = {f"{x}{end}": Text(f"{x}.{part}", "r") for end, part in halves for x in self.halved}
        #: The variables of the enclosing loops, and those of finished loops.
        self.loops, self.ended = list[str](), set[str]()
        self.statements = self.out
        for statement in self.function.node.body:
            self.statement(statement)

    def text(self) -> str:
        """The text of the function."""
        kinds = dict.fromkeys(self.above.values())
        above = [Statement(f"{kind} {', '.join(x for x in self.above if self.above[x] == kind)}") for kind in kinds]
        body = BY_HAND.get(self.function.name) or [*above, *(self.statements or [])]
        low = {f"{x}_" for x in self.halved}
        taken = [x for x in self.function.parameters if x not in low and self.names[x] != "1"]
        parameters = ", ".join(f"{c_type('p' if x in self.halved else self.names[x])} {x}" for x in taken)
        where = "OUT_OF_LINE" if self.function.is_out_of_line else "INLINE"
        return block(f"{where} {c_type(self.returned)} {self.function.name}({parameters})", *body)

    # -- expressions

    def outside(self, node: ast.expr) -> Any:
        """The meaning of a name, or of a name in a module, outside of the function."""
        inside = node.value if isinstance(node, ast.Attribute) else node
        return None if isinstance(inside, ast.Name) and inside.id in self.own else meaning(node, self.module.names)

    def value(self, node: ast.expr) -> Any:
        """The value of a constant expression; None for any other, or if it differs in float32."""
        for n in ast.walk(node):
            if isinstance(n, ast.Name) and n.id in self.own:
                return None
            if isinstance(n, ast.Name | ast.Attribute) and isinstance(self.outside(n), Varying):
                return None
        try:
            return constant(node, self.module.names)
        except NotConstant:
            return None

    def expression(self, node: ast.expr) -> Text:
        """An expression with one value."""
        value = self.value(node)
        if isinstance(value, bool | int | float):
            return number(value)
        match node:
            case ast.Name(id=name) if name in self.loops:
                return Text(name, "i")
            case ast.Name(id=name) if name in self.own and name not in self.ended:
                kind = self.names[name] if name not in self.within else None
                return self.within.get(name) or Text("1" if kind == "1" else name, kind)
            case ast.Attribute(value=value, attr="high" | "low" as half):
                if (of := self.expression(value)).kind == "e" and half == "high":
                    return Text(of.text, "r", of.level)
                if of.kind not in ("p", "q"):
                    raise TypeError(f"{ast.unparse(value)} is no pair")
                return Text(f"{self.named(of).text}.{'a0' if half == 'high' else 'a1'}", "r")
            case ast.Attribute(value=ast.Name(id=name), attr=attribute) if name in self.own:
                record = self.named(self.expression(node.value))
                return next(x for x in record.parts if x.text == f"{record.text}.{attribute}")
            case ast.Tuple(elts=elements):
                return self.together(list(self.several(elements)))
            case ast.Name() | ast.Attribute() if isinstance(varying := self.outside(node), Varying):
                return Text(varying.name, number(varying.double).kind)
            case ast.BinOp(left=left, op=op, right=right):
                return self.operation(self.expression(left), op, self.expression(right))
            case ast.UnaryOp(op=ast.Not() | ast.USub() as op, operand=operand):
                if (of := self.expression(operand)).kind in ("p", "q"):
                    return self.halves(of, "-{}")
                sign = "!" if isinstance(op, ast.Not) else "-"
                of = Text(of.text, "i") if of.kind == "1" else of
                text = of.at(ATOM if of.text[0] == "-" else UNARY)  # `--` is another operator
                return Text(sign + text, "b" if sign == "!" else of.kind, UNARY)
            case ast.Compare(left=left, ops=ops, comparators=comparators):
                operands = [self.one(x) for x in (left, *comparators)]
                signs = [OPERATORS[type(op)] for op in ops]
                pairs = [
                    Text(f"{a.at(level + 1)} {sign} {b.at(level + 1)}", "b", level)
                    for a, (sign, level), b in zip(operands, signs, operands[1:], strict=False)
                ]
                return pairs[0] if len(pairs) == 1 else Text(" && ".join(p.text for p in pairs), "b", AND)
            case ast.BoolOp(op=op, values=[first, *others]):
                sign, level = ("&&", AND) if isinstance(op, ast.And) else ("||", OR)
                parts = [self.one(first), *map(self.unhurried, others)]
                if any(part.kind != "b" for part in parts):
                    raise TypeError("what is joined is a number, which Python would return")
                return Text(f" {sign} ".join(part.at(AND + 1) for part in parts), "b", level)
            case ast.IfExp(test=test, body=body, orelse=orelse):
                given, before = self.one(test), self.temporaries
                yes, no = self.expression(body), self.expression(orelse)
                if isinstance(yes.kind, tuple):  # both are computed, for vector code
                    if self.changes(body) or self.changes(orelse):
                        raise TypeError("a call that writes would be made in any case")
                    given, yes, no = map(self.named, (given, yes, no))
                    both = zip(yes.parts, no.parts, strict=True)
                    return self.together([self.chosen(given, *one) for one in both])
                if self.temporaries > before:
                    raise TypeError(f"a call in {ast.unparse(node)} would come too early")
                return self.chosen(given, yes, no)
            case ast.Subscript(value=ast.Attribute(value=array, attr="shape"), slice=axis):
                return Text(f"{self.expression(array).text}.n{self.value(axis)}", "i")
            case ast.Subscript(value=array, slice=ast.Tuple(elts=indices)):
                return self.indexed(self.expression(array), indices)
            case ast.Subscript(value=array, slice=index):
                of = self.expression(array)
                if not isinstance(of.kind, tuple):
                    return self.indexed(of, [index])
                of = self.named(of)
                if isinstance(index, ast.Slice):
                    bounds = [self.value(x) for x in (index.lower, index.upper, index.step) if x]
                    if index.step or None in bounds:
                        raise TypeError("a slice of a tuple has a step, or a bound that is no constant")
                    low, high = (self.value(x) if x else None for x in (index.lower, index.upper))
                    return self.together(of.parts[low:high])
                return of.parts[self.value(index)]
            case ast.Call(func=func, args=arguments, keywords=[]):
                return self.call(func, arguments)
        raise TypeError(f"{ast.unparse(node)} has no form that is known")

    def one(self, node: ast.expr) -> Text:
        """An operand of a comparison or a condition; tuples and double-double numbers are refused."""
        of = self.expression(node)
        if isinstance(of.kind, tuple | Record) or is_loose(of.kind):
            raise TypeError(f"{ast.unparse(node)} has no order and no truth")
        return of

    def changes(self, node: ast.expr) -> bool:
        """Whether a call in an expression writes into an array."""
        callees = [self.callee(n.func) for n in ast.walk(node) if isinstance(n, ast.Call)]
        known = [f for c in callees for f in ((c.double, c.single) if isinstance(c, Varying) else (c,))]
        nodes = [f.node for f in known if isinstance(f, Function)]
        return any(of.written and f.node in nodes for f, of in self.printers.items())

    def together(self, parts: Sequence[Text]) -> Text:
        """A tuple expression."""
        kind = tuple(part.kind for part in parts)
        self.tuples.add(kind)
        return Text(f"({c_type(kind)}){{{', '.join(part.text for part in parts)}}}", kind)

    def chosen(self, given: Text, yes: Text, no: Text) -> Text:
        """A conditional expression."""
        text = f"{given.at(LESS)} ? {yes.at(LESS)} : {no.at(LESS)}"
        return Text(text, joined(yes.kind, no.kind), TERNARY)

    def unhurried(self, node: ast.expr) -> Text:
        """An expression that may be evaluated never or twice; raises TypeError if it needs statements before it."""
        before = self.temporaries
        text = self.expression(node)
        if self.temporaries > before:
            raise TypeError(f"a call in {ast.unparse(node)} would come too early")
        return text

    def operation(self, a: Text, op: ast.operator, b: Text) -> Text:
        """An operation with two operands; quotient and remainder are those of integers."""
        if not {a.kind, b.kind}.isdisjoint(("e", "p", "q")):
            return self.loose(a, type(op), b)
        if a.kind == b.kind == "1" and isinstance(op, ast.Mult):
            return a
        a, b = (Text("1", "i") if x.kind == "1" else x for x in (a, b))
        (sign, level), kind = OPERATORS[type(op)], joined(a.kind, b.kind)
        if isinstance(op, ast.FloorDiv | ast.Mod):
            if kind not in ("b", "i"):
                raise TypeError(f"{a.text} and {b.text} are no integers")
            return Text(f"{sign}({a.text}, {b.text})", "i")
        if isinstance(op, ast.BitAnd | ast.BitOr):
            return Text(f"{a.at(BITS)} {sign} {b.at(BITS)}", "b", level)
        if isinstance(op, ast.Div):
            first = f"R({a.text})" if a.kind in ("b", "i") else a.at(level)
            return Text(f"{first} {sign} {b.at(UNARY)}", "r" if kind in ("b", "i") else kind, level)
        return Text(f"{a.at(level)} {sign} {b.at(level + 1)}", "i" if kind == "b" else kind, level)

    def loose(self, a: Text, op: type, b: Text) -> Text:
        """An operation of double-double, as `Loose` and `Normal` do it."""
        for x in (a, b):
            if x.kind in ("b", "i") and not re.fullmatch(r"-?\d+", x.text) and op in (ast.Mult, ast.Div):
                raise TypeError(f"{x.text} may be 1 or 2, by which nothing is rounded")
        one, two = (x.kind == "1" or (x.kind == "i" and x.text in ("1", "2")) for x in (a, b))
        if op is ast.Mult and (one or two):
            whole, other = (a, b) if one else (b, a)
            return self.halves(other, "2 * {}") if whole.text == "2" else other
        if op is ast.Div:
            if b.text == "2":
                return self.halves(a, "{} / 2")
            return Text(self.on_halves("divide", a, self.normalised(b)).text, "q" if a.kind == "q" else "p")
        size = len(self.of(a)) + len(self.of(b))
        if op is ast.Sub and size < 4:
            b = self.halves(b, "-{}") if b.kind in ("p", "q") else Text(f"-{b.at(ATOM)}", "r", UNARY)
        first, second = (b, a) if len(self.of(a)) < len(self.of(b)) else (a, b)
        found = self.on_halves(FORMS[op][size - 2], first, second)
        if "q" not in (a.kind, b.kind):
            return found
        found = Text(found.text, "q")
        return found if op is ast.Mult else self.normalised(found)

    def of(self, value: Text) -> list[Text]:
        """The two halves of a pair, or a number itself."""
        if value.kind not in ("p", "q"):
            return [Text(value.text, "r", value.level)]
        return [Text(f"{value.text}.{x}", "r") for x in ("a0", "a1")]

    def halves(self, value: Text, form: str) -> Text:
        """An operation on both halves of pairs."""
        if value.kind not in ("p", "q"):
            return Text(form.format(value.at(UNARY)), value.kind, OPERATORS[ast.Mult][1])
        return Text(f"(t_r2){{{', '.join(form.format(x.text) for x in self.of(self.named(value)))}}}", value.kind)

    def normalised(self, value: Text) -> Text:
        """A normalised pair."""
        if value.kind not in ("p", "q"):
            return value
        return Text(self.on_halves("two_sum", *self.of(self.named(value))).text, value.kind)

    def on_halves(self, name: str, *numbers: Text) -> Text:
        """A call of a function of `chapsym.numbers.pairs`: it is a pair."""
        function = self.printers.program.module(PAIRS).functions[name]
        halved, given = self.printers[function].halved, list[Text]()
        for x, parameter in zip(numbers, (x for x in function.parameters if x[-1] != "_"), strict=True):
            given += [*self.of(x), Text("0", "r")][: 2 if parameter in halved else 1]
        return Text(self.called(function, [], given).text, "p")

    def indexed(self, array: Text, indices: Sequence[ast.expr]) -> Text:
        """An element, a row or some rows of an array."""
        bounds = [x for i in indices for x in ((i.lower, i.upper, i.step) if isinstance(i, ast.Slice) else (i,)) if x]
        if any(isinstance(i, ast.Slice) and i.step for i in indices) or any((self.value(x) or 0) < 0 for x in bounds):
            raise TypeError("an index is counted from the end, or a slice has a step")
        element, rank = array.kind.element, array.kind.rank
        if len(indices) == rank and not any(isinstance(i, ast.Slice) for i in indices):
            where = ", ".join(self.expression(i).text for i in indices)
            text = f"{array.at(ATOM)}.p[{where}]" if rank == 1 else f"AT{rank}({array.text}, {where})"
            return Text(text, "i" if element == "w" else element)
        for i in indices:
            if isinstance(i, ast.Slice) and (i.lower or i.upper):
                low = self.expression(i.lower).text if i.lower else "0"
                high = self.expression(i.upper).text if i.upper else f"{array.text}.n0"
                array = Text(f"{array.kind}_part({array.text}, {low}, {high})", array.kind)
            elif not isinstance(i, ast.Slice):
                text = f"{array.kind}_row({array.text}, {self.expression(i).text})"
                array = Text(text, Array(array.kind.element, array.kind.rank - 1))
        return array

    def callee(self, func: ast.expr) -> Any:
        """The callee: a function, a record, the path of a function of a library, or the name of a method."""
        known = self.outside(func)
        return known if known is not None else func.id if isinstance(func, ast.Name) else func.attr  # type: ignore[attr-defined]

    def call(self, func: ast.expr, arguments: Sequence[ast.expr]) -> Text:
        """A call expression."""
        if (callee := self.callee(func)) == "normalised":
            return self.normalised(self.expression(func.value))  # type: ignore[attr-defined]
        if callee == "reshape":
            array, shape = func.value, arguments[0].elts  # type: ignore[attr-defined]
            rows, columns = (self.expression(x).text for x in shape)
            return Text(f"(r2){{{self.expression(array).text}.p, {rows}, {columns}, {columns}}}", Array("r", 2))
        if isinstance(callee, str) and callee.startswith(f"{FUNCTIONS}."):
            return self.adjoined(callee.rpartition(".")[2], self.expression(arguments[0]))  # the others are for Python
        given = list(self.several(arguments))
        if isinstance(callee, str) and callee.startswith(f"{LOOSE}."):
            return self.of_loose(callee.rpartition(".")[2], given)
        if isinstance(callee, Function) and any(is_loose(x.kind) for x in given):
            given = [Text("1", "1") if (x.text, x.kind) == ("1", "i") else x for x in given]
            callee = self.printers.special(callee, given)
        if isinstance(callee, Function | Varying):
            return self.called(callee, arguments, given)
        if isinstance(callee, Record):
            return self.record(callee, given)
        if any(isinstance(x.kind, tuple) or is_loose(x.kind) for x in given):
            raise TypeError(f"{ast.unparse(func)} takes no such number")
        if callee in ("max", "min"):
            kind = "r" if any(x.kind == "r" for x in given) else "i"
            return Text(reduce(lambda a, b: f"{callee}_{kind}({a}, {b})", [x.text for x in given]), kind)
        if callee == "math.ldexp":
            return Text(f"R(ldexp({given[0].text}, (int){given[1].at(UNARY)}))", "r")
        (of,) = given
        if callee == "len":
            return Text(f"{of.text}.n0", "i")
        if callee == "math.frexp":
            return Text(f"real_frexp({of.text})", ("r", "i"))
        if callee in CASTS:
            return Text(f"({SCALARS[CASTS[callee]]}){of.at(UNARY)}", CASTS[callee], UNARY)
        if callee == "abs" and of.kind == "i":
            return Text(f"llabs({of.text})", "i")
        text = f"{LIBRARY[callee]}({of.text})"
        return Text(text, "d") if of.kind == "d" else Text(f"R({text})", "r")

    def record(self, callee: Record, given: Sequence[Text]) -> Text:
        """A named tuple: each field has its kind."""
        for x, (name, kind) in zip(given, callee.fields, strict=True):
            if joined(x.kind, kind) != kind:
                raise TypeError(f"the field {name} is of another kind")
        self.tuples.add(callee)
        return Text(f"({callee.name}){{{', '.join(x.text for x in given)}}}", callee)

    def of_loose(self, name: str, given: Sequence[Text]) -> Text:
        """A number of double-double from one or two floats, or the root of one."""
        if name == "square_root":
            return self.on_halves("root", self.normalised(given[0]))
        if len(given) == 1 and name == "Loose":
            text, kind, level = given[0].text, given[0].kind, given[0].level
            return Text(text, "e", level) if kind == "r" else Text(f"R({text})", "e")
        high, low = given
        return Text(f"(t_r2){{{high.text}, {low.text}}}", "q" if name == "Normal" else "p")

    def adjoined(self, name: str, of: Text) -> Text:
        """A letter of a kernel, as a call of the mathematics library."""
        return Text("R(3.141592653589793)" if name == "pi" else f"R({name}({of.text}))", "r")

    def called(self, callee: Function | Varying, arguments: Sequence[ast.expr], given: list[Text]) -> Text:
        """A call of a function of the loops; its parameters get the kinds of the arguments."""
        double, single = (callee.double, callee.single) if isinstance(callee, Varying) else (callee, callee)
        if single is self.function:
            single = double
        self.calls[double] = single
        for function in dict.fromkeys((double, single)):
            of = self.printers[function]
            defaults = [number(constant(x, function.module.names)) for x in function.node.args.defaults]
            missing = len(function.parameters) - len(given)
            full = [*given, *defaults[len(defaults) - missing :]] if missing else given
            for name, argument in zip(function.parameters, full, strict=True):
                of.note(name, "r" if argument.kind == "d" else argument.kind)
            if of.statements is None:
                of.run()
            for name, node in zip(function.parameters, arguments, strict=False):
                if name in of.written:
                    self.writes(node)
        taken = [x for x in full if x.kind != "1"]
        self.tuples |= {x.kind for x in taken if isinstance(x.kind, tuple)}
        if of.halved:
            halves = iter(taken)
            names = [x for x in function.parameters if x[-1] != "_"]
            taken = [whole(next(halves), next(halves)) if x in of.halved else next(halves) for x in names]
        text = ", ".join(x.text for x in taken)
        if is_external(self.function, double):
            if not isinstance(of.returned, tuple) or any(isinstance(x.kind, tuple) for x in taken):
                raise TypeError(f"{double.name} of float64 must take numbers and return several")
            return Text(f"{double.name}_double({text})", widened(of.returned))
        return Text(f"{callee.name if single is not double else double.name}({text})", of.returned)

    def several(self, nodes: Sequence[ast.expr]) -> Iterator[Text]:
        """The values of arguments or of the elements of a tuple; some may be starred."""
        for node in nodes:
            if isinstance(node, ast.Starred):
                yield from self.named(self.expression(node.value)).parts
            else:
                yield self.expression(node)

    # -- statements

    def note(self, name: str, kind: Any) -> None:
        """Records that a name may have this kind, too."""
        self.names[name] = joined(self.names.get(name, kind), kind)

    def writes(self, node: ast.expr, seen: frozenset[str] = frozenset()) -> None:
        """Records that the function writes to the array of an expression, or to the arrays of a record."""
        name = base_name(node)
        made = node.args if isinstance(node, ast.Call) else self.made.get(name, ())  # a record, there or before
        for part in made if name not in seen else ():
            self.writes(part, seen | {name})
        self.written |= {x for x in {name} & set(self.function.parameters) if isinstance(self.names[x], Array | Record)}

    def add(self, *texts: str) -> None:
        """Adds simple statements."""
        self.out += [Statement(text) for text in texts]

    def declare(self, kind: str, name: str, text: str) -> None:
        """Declares a name with a value, in the preceding declaration if that has the same type."""
        last = self.out[-1] if self.out else Statement("")
        if last.declares == kind and len(last.text) + len(name) + len(text) < WIDTH - 4 * self.depth - 10:
            last.text += f", {name} = {text}"
        else:
            self.out.append(Statement(f"{kind} {name} = {text}", kind))

    def assigned(self, name: str, kind: Any, text: str) -> None:
        """Assigns to a name; the first assignment, outside of blocks, declares the name."""
        if name in self.declared or self.depth:
            if name not in self.declared:
                self.above[name] = c_type(kind)
            self.add(f"{name} = {text}")
        else:
            self.declare(c_type(kind), name, text)
        self.declared.add(name)

    def named(self, value: Text) -> Text:
        """A value that may be used several times: it is stored in a variable unless it is a name."""
        return value if re.fullmatch(r"[\w.]+", value.text) else self.kept(value)

    def kept(self, value: Text) -> Text:
        """A variable for the result of a call."""
        self.temporaries += 1
        self.declare(c_type(value.kind), f"t_{self.temporaries}", value.text)
        return Text(f"t_{self.temporaries}", value.kind)

    def set(self, target: ast.expr, value: Text) -> None:
        """Assigns one value."""
        match target:
            case ast.Name(id="_"):
                pass
            case ast.Name(id=name) if name not in self.loops:
                self.note(name, value.kind)
                self.ended.discard(name)
                self.assigned(name, self.names[name], value.text)
            case ast.Subscript():
                self.writes(target)
                to = self.expression(target)
                is_part = isinstance(to.kind, Array)
                self.add(f"{to.kind}_fill({to.text}, {value.text})" if is_part else f"{to.text} = {value.text}")
            case _:
                raise TypeError(f"{ast.unparse(target)} is not assigned to")

    def statement(self, node: ast.stmt) -> None:
        """Adds the statements in C of one in Python."""
        try:
            self.translate(node)
        except (AttributeError, LookupError, TypeError, ValueError) as error:  # no known form
            if isinstance(error, NotTranslatable):
                raise
            raise NotTranslatable(f"{self.function.name}: {ast.unparse(node)}: {error}") from error

    def translate(self, node: ast.stmt) -> None:
        """Adds the statements in C of one in Python; an unknown form raises any error."""
        match node:
            case ast.Expr(value=ast.Constant()) | ast.Pass():
                pass
            case ast.Expr(value=ast.Call() as call):
                self.add(self.expression(call).text)
            case ast.Assign(targets=[target], value=value):
                self.assign(target, value)
            case ast.AugAssign(target=target, op=op, value=value):
                self.set(target, self.operation(self.expression(target), op, self.expression(value)))
            case ast.Return(value=ast.IfExp(test=test, body=ast.Tuple() as body, orelse=orelse)):
                self.statement(ast.If(test, [ast.Return(body)], [ast.Return(orelse)]))
            case ast.Return(value=value):
                self.add(self.result(value) if value else "return")
            case ast.If(test=test, body=body, orelse=orelse):
                given = self.one(test).text
                self.out.append(Statement(f"if ({given})", block=self.inner(body)))
                if orelse:
                    self.out.append(Statement("else", block=self.inner(orelse)))
            case ast.While(test=test, body=body, orelse=[]):
                given = self.unhurried(test).text
                self.out.append(Statement(f"while ({given})", block=self.inner(body)))
            case ast.For(target=target, iter=ast.Tuple(elts=rows), body=body, orelse=[]):  # C has no loop over rows
                if any(isinstance(n, ast.Break | ast.Continue) for n in ast.walk(node)):
                    raise TypeError("a loop over rows is left")
                read = {n.id for row in rows for n in ast.walk(row) if isinstance(n, ast.Name)}
                if read.intersection(stored(*body)):
                    raise TypeError("a row is read after what it names has changed")
                for row in rows:
                    self.assign(target, row)
                    for statement in body:
                        self.statement(statement)
            case ast.For(target=ast.Name(id=name), iter=ast.Call(func=func, args=bounds), body=body, orelse=[]):
                self.loop(name, ast.unparse(func), bounds, body)
            case ast.Break() | ast.Continue():
                self.add(ast.unparse(node))
            case _:
                raise TypeError("no such statement")

    def inner(self, block: Sequence[ast.stmt]) -> list[Statement]:
        """The statements of a block inside another."""
        before, self.out, self.depth = self.out, [], self.depth + 1
        for statement in block:
            self.statement(statement)
        done, self.out, self.depth = self.out, before, self.depth - 1
        return done

    def result(self, node: ast.expr) -> str:
        """A return of one value, of the result of a call, or of a tuple."""
        value = self.expression(node)
        if isinstance(value.kind, Array):
            raise TypeError("an array is returned")
        self.returned = joined(self.returned or value.kind, value.kind)
        return f"return {value.text}"

    def assign(self, target: ast.expr, value: ast.expr) -> None:
        """Adds an assignment."""
        match target, value:
            case ast.Tuple(elts=targets), ast.Tuple(elts=values) if any(map(self.is_allocation, values)):
                for one, of_one in zip(targets, values, strict=True):
                    self.assign(one, of_one)
            case ast.Tuple(elts=targets), ast.Tuple(elts=values):
                self.assign_each(targets, list(self.several(values)))
            case ast.Tuple(elts=targets), _:
                self.assign_parts(targets, self.expression(value))
            case ast.Name(id=name), ast.Call() if self.is_allocation(value):
                self.allocate(name, value)
            case ast.Name(id=name), _:
                of = self.expression(value)
                if isinstance(value, ast.Call) and isinstance(of.kind, Record):
                    self.made[name] = value.args
                elif isinstance(value, ast.Name | ast.Attribute | ast.Subscript):
                    self.made[name] = [value]
                if isinstance(of.kind, tuple) and name in self.listed:
                    if self.stored[name] > 1 or self.depth or set(of.kind) != {"r"}:
                        raise TypeError("a tuple with an element that a variable names is of floats, and assigned once")
                    parts = ", ".join(x.text for x in self.kept(of).parts)
                    self.array(name, Array("r", 1), [str(len(of.kind))], f"real {name}_[] = {{{parts}}}")
                else:
                    self.set(target, of)
            case _:
                self.set(target, self.expression(value))

    def assign_each(self, targets: Sequence[ast.expr], values: list[Text]) -> None:
        """Adds the assignments of several values; if one changes a value that is read later, all are computed first."""
        words = [set(re.findall(r"\w+", value.text)) for value in values]
        if any(base_name(target) in later for i, target in enumerate(targets) for later in words[i + 1 :]):
            values = [self.kept(value) for value in values]
        for target, value in zip(targets, values, strict=True):
            self.set(target, value)

    def assign_parts(self, targets: Sequence[ast.expr], value: Text) -> None:
        """Adds the assignments of the results of a call; names with no other assignment stay parts of the structure."""
        names = [t.id if isinstance(t, ast.Name) else "" for t in targets]
        if all(name == "_" or (self.stored[name] == 1 and name not in self.function.parameters) for name in names):
            first = next(name for name in names if name != "_")
            self.assigned(first, value.kind, value.text)
            for name, part in zip(names, Text(first, value.kind).parts, strict=True):
                self.within[name] = part
            return
        for target, part in zip(targets, self.kept(value).parts, strict=True):
            self.set(target, part)

    def is_allocation(self, node: ast.expr) -> bool:
        """Whether an expression is a new array."""
        return isinstance(node, ast.Call) and self.callee(node.func) in ALLOCATE

    def array(self, name: str, kind: Array, sizes: Sequence[str], *memory: str) -> None:
        """Declares a new array, on the stack."""
        self.note(name, kind)
        self.add(*memory)
        strides = [" * ".join(sizes[axis + 1 :]) for axis in range(kind.rank - 1)]
        self.declare(str(kind), name, f"{{{', '.join([f'{name}_', *sizes, *strides])}}}")

    def allocate(self, name: str, node: ast.Call) -> None:
        """A new array: empty, zero or the identity, or a copy of a column of a matrix."""
        if (callee := self.callee(node.func)) == "copy":
            column: Any = node.func.value  # type: ignore[attr-defined]
            rows, index = column.slice.elts
            matrix, at = self.expression(column.value).text, self.expression(index).text
            count = self.expression(rows.upper).at(UNARY) if rows.upper else f"{matrix}.n0"
            self.array(name, Array("r", 1), [count], f"real {name}_[{count}]")
            self.each(count, f"{name}_[i_] = AT2({matrix}, i_, {at})")
            return
        shape, *types = *node.args, *(k.value for k in node.keywords)
        element = {"np.int64": "i", "np.int32": "w"}.get(ast.unparse(types[0]), "r") if types else "r"
        sizes = [self.expression(x).at(UNARY) for x in (shape.elts if isinstance(shape, ast.Tuple) else [shape])]
        sizes = sizes * 2 if callee == "numpy.eye" else sizes
        clear = [f"memset({name}_, 0, sizeof {name}_)"] if callee != "numpy.empty" else []
        memory = f"ALIGNED {SCALARS[element]} {name}_[{' * '.join(sizes)}]"
        self.array(name, Array(element, len(sizes)), sizes, memory, *clear)
        if callee == "numpy.eye":
            self.each(sizes[0], f"{name}_[i_ * ({sizes[0]} + 1)] = 1")

    def each(self, count: str, text: str) -> None:
        """Adds a statement for each i_ below a number."""
        self.out.append(Statement(f"for (int64_t i_ = 0; i_ < {count}; i_++)", block=[Statement(text)]))

    def loop(self, name: str, over: str, nodes: Sequence[ast.expr], body: Sequence[ast.stmt]) -> None:
        """A loop over a range; its end is computed once, and its variable exists only inside."""
        inner = (n for x in nodes for n in ast.walk(x))
        if over not in ("range", "lanes") or any(isinstance(n, ast.Name) and n.id == name for n in inner):
            raise TypeError(f"a loop over {over}, or its variable is in its bounds")
        bounds = [self.expression(x).text for x in nodes]
        start, end, step = {1: ["0", *bounds, "1"], 2: [*bounds, "1"], 3: bounds}[len(bounds)]
        name = name if name != "_" else f"i_{len(self.loops)}"
        first, sign = f"int64_t {name} = {start}", ">" if step[0] == "-" else "<"
        if not end.isdigit():
            first, end = f"{first}, end_{name} = {end}", f"end_{name}"
        more = {"1": f"{name}++", "-1": f"{name}--"}.get(step, f"{name} += {step}")
        self.loops.append(name)
        head = f"{'INDEPENDENT ' if over == 'lanes' else ''}for ({first}; {name} {sign} {end}; {more})"
        self.out.append(Statement(head, block=self.inner(body)))
        self.ended.add(self.loops.pop())


def whole(high: Text, low: Text) -> Text:
    """The pair of two halves."""
    of = high.text.removesuffix(".a0")
    one = high.level == ATOM and low.text == f"{of}.a1"
    return Text(of if one else f"(t_r2){{{high.text}, {low.text}}}", "p")


def stored(*nodes: ast.AST) -> list[str]:
    """The names that are assigned to, each as often as it is."""
    return [n.id for x in nodes for n in ast.walk(x) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)]


def base_name(node: ast.expr) -> str:
    """The name of an expression, or of the array that contains it."""
    while isinstance(node, ast.Subscript | ast.Attribute | ast.Call):
        node = node.func if isinstance(node, ast.Call) else node.value
    return node.id if isinstance(node, ast.Name) else ""


def is_whole(node: ast.expr) -> bool:
    """Whether an index is a whole number, or a slice from one to another."""
    bounds = (node.lower, node.upper) if isinstance(node, ast.Slice) else (node,)
    return all(isinstance(n, ast.Constant) and isinstance(n.value, int) for n in bounds)


def is_external(caller: Function, callee: Function) -> bool:
    """Whether a function in float32 calls a function in float64."""
    return caller.module.name == NARROW and callee.module.name == WIDE


class Printers(dict[Function, Printer]):
    """A printer for each requested function, and one for each of its specialisations by kinds."""

    def __init__(self, program: Program) -> None:
        self.program, self.specialised = program, dict[tuple[Function, str], Function]()

    def special(self, function: Function, given: Sequence[Text]) -> Function:
        """The function for these kinds."""
        variant = "_" + c_type(tuple(x.kind for x in given))[2:]
        if (key := (function, variant)) not in self.specialised:
            self.specialised[key] = Function(function.module, function.node, variant)
        return self.specialised[key]

    def __missing__(self, function: Function) -> Printer:
        self[function] = Printer(self, function)
        return self[function]


def printed(program: Program, roots: Sequence[Function], kernels: Sequence[Function] = ()) -> Printers:
    """The printers of some functions and of all functions that these call; a kernel has numbers as parameters."""
    found = Printers(program)
    for function in (*roots, *kernels):
        found[function].names |= dict.fromkeys(function.parameters, "r") if function in kernels else {}
    before: object = None
    while before != (now := [(dict(p.names), p.returned, set(p.written)) for p in found.values()]):
        before = now
        for printer in list(found.values()):
            printer.run()
    return found


def broken(line: str) -> list[str]:
    """A long line, broken at spaces."""
    indent = " " * (len(line) - len(line.lstrip()))
    return wrap(line, WIDTH, subsequent_indent=f"{indent}    ", break_long_words=False) or [""]


def lines(statements: Sequence[Statement], indent: str = "    ") -> list[str]:
    """Statements as lines; successive short statements share a line."""
    done, shares = list[str](), False
    for statement in statements:
        text = f"{indent}{statement.text}"
        if statement.block is None:
            if shares and len(done[-1]) + len(statement.text) + 2 <= WIDTH:
                done[-1] += f" {statement.text};"
            else:
                done.append(f"{text};")
        else:
            one = f"{text} {{ {' '.join(f'{x.text};' for x in statement.block)} }}"
            if all(x.block is None for x in statement.block) and len(one) <= WIDTH:
                done.append(one)
            else:
                done += [f"{text} {{", *lines(statement.block, f"{indent}    "), f"{indent}}}"]
        shares = statement.block is None
    return [part for line in done for part in broken(line)]


def block(head: str, *statements: Statement | str) -> str:
    """A function, from its head and its statements; an empty line follows if it has several."""
    body = [Statement(x) if isinstance(x, str) else x for x in statements]
    found = lines([Statement(head, block=body)], "")
    return "\n".join(found) + ("\n\n" if len(found) > 1 else "\n")
