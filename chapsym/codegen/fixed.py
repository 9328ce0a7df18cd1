"""Programs on fixed-point numbers: Python integers, of which 2^bits is one.

A sum of products is added up exactly and shifted once; a quotient and a sum
of products are rounded down.
"""

from collections import Counter
from collections.abc import Callable, Sequence
from fractions import Fraction

from .ir import Folded, Function, Texts, numbered
from .kernels import ANY_QUATERNION, CONTACT, FIRST, GAMMA, GIBBS, HALF, INERTIA
from .programs import Program

#: The module, its key in the manifest, and what it says of itself.
FILE, KEY = "fixed.py", "fixed"
ABOUT = "Parts of a step on fixed-point numbers: integers, of which 2^P is one."
#: The precision at which the text is compared with the program, far beyond the digits that are compared.
TRIED = 400

PROGRAMS: tuple[Program, ...] = (
    Program(
        "residual_fixed",
        "G(u), which the Gibbs vector of the step makes zero.",
        (GIBBS, HALF, GAMMA, INERTIA, CONTACT),
        ("r1", "r2", "r3"),
        "r1, r2, r3 = gibbs_residual(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D)",
    ),
    Program(
        "cofactors_fixed",
        "The determinant and the cofactors of ∂G/∂u, row by row.",
        (GIBBS, HALF, GAMMA, INERTIA, CONTACT),
        ("det", "c11", "c12", "c13", "c21", "c22", "c23", "c31", "c32", "c33"),
        "det, n1, n2, n3, c11, c12, c13, c21, c22, c23, c31, c32, c33 = gibbs_newton("
        "u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D)",
    ),
    Program(
        "turns_fixed",
        "Ωᵀk and Ωᵀγ for the Gibbs vector u.",
        (GIBBS, HALF, GAMMA),
        ("x1", "x2", "x3", "y1", "y2", "y3"),
        "x1, x2, x3 = turn(1, u1, u2, u3, k1, k2, k3)\n"
        "y1, y2, y3 = turn(1, u1, u2, u3, g1, g2, g3)\n"
        "x1, x2, x3, y1, y2, y3 = x1 + k1, x2 + k2, x3 + k3, y1 + g1, y2 + g2, y3 + g3",
    ),
    Program(
        "body_fixed",
        "The attitude a after the step with the unit quaternion p from the vertical γ, and Δr/ρ in space.",
        (FIRST, ANY_QUATERNION, GAMMA),
        ("c0", "c1", "c2", "c3", "x1", "x2", "x3"),
        "c0, c1, c2, c3 = compose(a0, a1, a2, a3, p0, p1, p2, p3)\n"
        "s1, s2, s3 = centre_step(p0, p1, p2, p3, g1, g2, g3)\n"
        "x1, x2, x3 = rotate(a0, a1, a2, a3, s1, s2, s3)",
    ),
)


class _Text:
    """The assignments of a program, one for each value that is used twice or is a factor, a divisor or an output."""

    def __init__(self, program: Program, texts: Texts) -> None:
        values = Folded(texts)
        outputs = numbered(program, values)
        self.nodes, self.uses = values.nodes, Counter(outputs)
        for number in values.needed(outputs):
            if not values.leaf(number):
                self.uses.update(map(int, self.nodes[number][1:]))
        self.names: dict[int, str] = {}
        self.lines: list[str] = []
        self.outputs = [self.name(number) for number in outputs]

    def constant(self, number: int) -> int | None:
        """The integer that a value is, if it is one."""
        operation, *operands = self.nodes[number]
        return int(operands[0]) if operation == "constant" else None

    def name(self, number: int) -> str:
        """The name of a value, which is assigned before."""
        if number not in self.names:
            operation, *operands = self.nodes[number]
            if operation == "input":
                return str(operands[0])
            narrow, wide = self.terms(number)
            total = _signed(wide)
            text = _signed([*narrow, ("+", f"({total} >> P)")]) if wide else _signed(narrow)
            self.names[number] = f"t{len(self.names)}"
            self.lines.append(f"{self.names[number]} = {text}")
        return self.names[number]

    def terms(self, number: int, inner: bool = False) -> tuple[list[tuple[str, str]], list[tuple[str, str]]]:
        """What is added up to a value: terms with their signs, and products that are still to be shifted."""
        operation, *operands = self.nodes[number]
        value = self.constant(number)
        if value is not None:
            return [("+", f"({value} << P)")], []
        if operation == "input" or (inner and self.uses[number] > 1):
            return [("+", self.name(number))], []
        left, right = int(operands[0]), int(operands[-1])
        if operation == "divide":
            above = self.constant(left)
            dividend = f"({self.name(left)} << P)" if above is None else f"({above} << 2 * P)"
            return [("+", f"{dividend} // {self.name(right)}")], []
        if operation == "multiply":
            for factor, other in ((left, right), (right, left)):
                times = self.constant(factor)
                if times is not None:
                    return [("+", f"{times} * {self.name(other)}")], []
            return [], [("+", f"{self.name(left)} * {self.name(right)}")]
        first = self.terms(left, True)
        if operation == "negative":
            return _negated(first[0]), _negated(first[1])
        second = self.terms(right, True)
        if operation == "subtract":
            second = _negated(second[0]), _negated(second[1])
        return first[0] + second[0], first[1] + second[1]


def _negated(terms: list[tuple[str, str]]) -> list[tuple[str, str]]:
    return [("-" if sign == "+" else "+", text) for sign, text in terms]


def _signed(terms: Sequence[tuple[str, str]]) -> str:
    """The terms in one line, the positive ones first."""
    positive = [text for sign, text in terms if sign == "+"]
    negative = [text for sign, text in terms if sign == "-"]
    return " + ".join(positive) + "".join(f" - {text}" for text in negative) if positive else "-" + " - ".join(negative)


def function(program: Program, texts: Texts) -> Function:
    """The function of a program: inputs, then the bits P after the binary point."""
    text = _Text(program, texts)
    body = [*text.lines, f"return {', '.join(text.outputs)}"]
    return Function(f"{', '.join(program.inputs)}, P", [f"Returns {', '.join(program.outputs)}."], body, {})


def preamble(functions: Sequence[Function]) -> list[str]:
    """What the module has before the functions: nothing."""
    return []


def text_values(program: Program, text: str, at: Callable[[str], Fraction]) -> list[Fraction]:
    """What the generated text makes of the point that `at` gives, with `TRIED` bits."""
    scope: dict = {}
    exec(compile(text, FILE, "exec"), scope)  # our own text, never a user's
    inputs = [int(at(name) * 2**TRIED) for name in program.inputs]
    return [Fraction(x, 2**TRIED) for x in scope[program.name](*inputs, TRIED)]
