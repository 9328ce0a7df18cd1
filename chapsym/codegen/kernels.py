"""A kernel: a function to be generated, and its carriers; a register has its kernels in `kernels.py`."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from keyword import iskeyword

import sympy as sp

from chapsym.derive.quotient import in_sympy
from chapsym.prove.registers import raised

from .carriers import Carrier
from .printer import NotStraightLine, text

#: Words of C and C++, and names that generated files use otherwise.
RESERVED = {
    "asm", "auto", "bool", "case", "catch", "char", "const", "default", "delete", "do", "double", "enum",
    "explicit", "export", "extern", "false", "float", "friend", "goto", "inline", "int", "long", "namespace", "new",
    "operator", "private", "protected", "public", "register", "restrict", "short", "signed", "sizeof", "static",
    "struct", "switch", "template", "this", "throw", "true", "typedef", "typename", "union", "unsigned", "using",
    "virtual", "void", "volatile", "real", "memcpy", "R", "INLINE", "got", "result", "TABLE",
    "sin", "cos", "sqrt", "pi", "_", "unix", "linux", "NULL", "NAN", "INFINITY", "HUGE_VAL",
}  # fmt: skip
Group = tuple[str, tuple[sp.Symbol, ...]]
Steps = Sequence[tuple[Sequence[sp.Symbol], Sequence[sp.Expr]]]


@dataclass(frozen=True, eq=False)
class Kernel:
    """A function to be generated, from expressions that claims have decided.

    Parameters
    ----------
    name : str
        Its name in Python and in C.
    summary : str
        The computed quantity, in one line.
    carriers : tuple of Carrier
        The sides of decided statements that are its outputs, in order, made by `left` and `right`.
    groups : tuple of (str, tuple of sympy.Symbol)
        Its arguments; a group is an array, or a number if it has one symbol.
    outputs : tuple of str
        The names of its results: a number, a vector, or a matrix row by row.
    build : callable
        A function that returns the expressions.
    factored : callable, optional
        A function that returns the same values in steps: named intermediate expressions, and the outputs in these
        names.
    rows_of_three : bool, optional
        Whether the result is a matrix of three columns.
    letters : mapping of sympy.Symbol to sympy.Expr, optional
        Letters of the statements that are no arguments, with their meanings: the sine, cosine or square root of an
        expression in the arguments and earlier letters, or π.  The relations of the statements in these letters must
        follow from sin² + cos² = 1 of one expression, √x² = x.
    """

    name: str
    summary: str
    carriers: tuple[Carrier, ...]
    groups: tuple[Group, ...]
    outputs: tuple[str, ...]
    build: Callable[[], Sequence[sp.Expr]]
    factored: Callable[[], tuple[Steps, Sequence[sp.Expr]]] | None = None
    rows_of_three: bool = False
    letters: Mapping[sp.Symbol, sp.Expr] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if not isinstance(self.carriers, tuple | list) or not all(isinstance(one, Carrier) for one in self.carriers):
            raise TypeError(f"the carriers of {self.name} must be a tuple of carriers, which left and right make")
        if not isinstance(self.letters, Mapping):
            raise TypeError(f"the letters of {self.name} must be given as {{symbol: expression}}")
        if not all(isinstance(x, str) for x in (self.name, self.summary, *self.outputs, *(g for g, _ in self.groups))):
            raise TypeError(f"the name, summary, groups and outputs of {self.name} must be texts")
        if not callable(self.build):
            raise TypeError(f"what builds {self.name} must be a function without arguments, such as lambda: [x + y]")

    @property
    def claims(self) -> tuple[str, ...]:
        """The claims whose statements carry the kernel."""
        return tuple(dict.fromkeys(id for carrier in self.carriers for id in carrier.claims))

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the result; one output is a number."""
        if self.rows_of_three:
            return len(self.outputs) // 3, 3
        return (len(self.outputs),) if len(self.outputs) > 1 else ()

    def problem(self) -> str | None:
        """The reason why the kernel cannot be written, in one sentence, or None."""
        names, groups = [symbol.name for symbol in self.inputs], [group for group, _ in self.groups]
        for name in (self.name, *names, *self.outputs, *groups, *map(str, self.letters)):
            is_name = name.isidentifier() and name.isascii() and not name.startswith(("__", "M_"))
            if not is_name or iskeyword(name) or name in RESERVED:
                return f"{name!r} cannot be a name in Python and C: take letters, digits and _, and no word of these"
        if twice := sorted({group for group in groups if groups.count(group) > 1}):
            return f"two groups of arguments have the name {twice[0]}"
        if twice := sorted({name for name in names if names.count(name) > 1}):
            return f"two arguments have the name {twice[0]}"
        if not all(isinstance(one, sp.Symbol) for one in self.letters):  # each has a name
            return "its letters are given as {symbol: expression}"
        known = set(self.inputs)
        for letter, stands in self.letters.items():
            if letter in known:
                return f"{letter} is an argument or a letter already"
            if (parts := adjoined(stands)) is None:
                return f"its letter {letter} is {stands!s:.40}; a letter is sin, cos or sqrt of something, or pi"
            try:
                written = text(parts[1])
            except (NotStraightLine, TypeError) as error:
                return f"its letter {letter} is of {parts[1]!s:.40}, which is no straight line: {error}"
            if parts[0] != "pi" and not parts[1].free_symbols and not written.isdigit():
                return f"its letter {letter} is of {parts[1]!s:.40}: a number there is whole"
            if more := parts[1].free_symbols - known:
                return f"its letter {letter} has {', '.join(sorted(map(str, more)))}, which it does not know there"
            known.add(letter)
        if not self.summary.isprintable() or any(sign in self.summary for sign in ('"', "\\", "*/")):
            return "its summary must be one line without quotes, backslashes and */, which end a comment"
        try:
            self.expressions, self.steps  # noqa: B018, which are derived here
        except KeyboardInterrupt:
            raise
        except BaseException as error:
            return f"what builds it raised {raised(error)}"
        if len(self.expressions) != len(self.outputs):
            return f"it has {len(self.outputs)} outputs and {len(self.expressions)} expressions"
        if self.rows_of_three and len(self.outputs) % 3:
            return f"its {len(self.outputs)} outputs do not fill rows of three"
        if strange := [e for e in self.expressions if not isinstance(e, sp.Expr)]:
            return f"its expression {strange[0]!r:.40} is no expression of SymPy"
        if found := set().union(*(e.free_symbols for e in self.expressions)) - known:
            return f"its expressions have {', '.join(sorted(map(str, found)))}, which is no argument"
        return None

    @cached_property
    def expressions(self) -> tuple[sp.Expr, ...]:
        """The computed expressions, derived once."""
        return tuple(in_sympy(e) if e is not None else e for e in self.build())

    @cached_property
    def steps(self) -> tuple[Steps, Sequence[sp.Expr]]:
        """The expressions in the steps of the derivation, if it has steps; derived once."""
        return self.factored() if self.factored else ([], self.expressions)

    @property
    def inputs(self) -> tuple[sp.Symbol, ...]:
        """The flat arguments."""
        return tuple(symbol for _, symbols in self.groups for symbol in symbols)


def adjoined(stands: sp.Expr) -> tuple[str, sp.Expr] | None:
    """The meaning of a letter, as the name of a function and its argument, 1 for π; None for anything else."""
    if stands is sp.pi:
        return "pi", sp.S.One
    if isinstance(stands, sp.sin | sp.cos):
        return type(stands).__name__, stands.args[0]
    if isinstance(stands, sp.Pow) and stands.exp == sp.S.Half:
        return "sqrt", stands.base
    return None
