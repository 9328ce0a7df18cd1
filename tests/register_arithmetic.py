"""The arithmetic of the register's checker, and its bounds: with the standard library only, as its mutants are run."""

from fractions import Fraction
from importlib import import_module


def arithmetic(package):
    """Raises AssertionError if the polynomials, words or bounds of a checker are not what they should be."""
    rejected = import_module(f"{package}.interval").Rejected

    def refused(function, *arguments):
        try:
            function(*arguments)
        except rejected:
            return True
        return False

    polynomials(import_module(f"{package}.polynomial"), refused)
    evaluations(import_module(f"{package}.register"))
    words(import_module(f"{package}.words"), import_module(f"{package}.polynomial").Work, refused)
    reading(import_module(f"{package}.formulas"))
    roots(import_module(f"{package}.roots"), import_module(f"{package}.polynomial").Work)
    trees(import_module(f"{package}.trees"), refused)


def bounded(p):
    """Whether the bound of the coefficients is one."""
    return all(c.bit_length() <= p.bits for c in p.terms.values())


def spent(Work, of):
    """The work of a square."""
    work = Work(1000)
    whole = of(work)
    whole * whole
    return 1000 - work.left


def polynomials(module, refused):
    work = module.Work(3)
    assert not refused(work.spend, 3)
    assert refused(work.spend, 1)
    ring = module.Ring(["x", "y"], module.Work())
    x, large, ones = ring.variable(0), ring.constant(1 << 100), ring.constant(255)
    assert bounded(large * large)
    eight = ring.constant(0)
    for i in range(8):
        eight = eight + x**i * ones
    assert bounded(eight * eight)
    tight = module.Polynomial(ring, dict(eight.terms), 7, 8)
    assert bounded(tight * tight)
    assert bounded(ones + ones)
    assert bounded(ones.times(255))
    assert (x**600).degree == 600
    assert refused(lambda: x**600 * x**600)
    made = module.Polynomial
    assert made(ring, {0: 1}, 0, 10**6).bits == 1
    assert refused(made, ring, {0: 1 << module.MOST_BITS}, 0, module.MOST_BITS + 1)
    assert refused(made, ring, dict.fromkeys(range(1, module.MOST_TERMS + 2), 1), 1, 1)
    assert refused(module.Quotient, x, 1 << module.MOST_BITS, {})
    assert refused(module.Quotient, x, 1, {0: module.MOST_DEGREE + 1})
    a, b = ring.names().values()
    difference = (a - b) ** -1 + (b - a) ** -1
    assert not difference.numerator.terms
    assert len(ring.factors) == 1
    assert spent(module.Work, lambda work: module.Ring(["x"], work).constant(1 << 5119)) == 2 + 10240 // 512
    assert spent(module.Work, lambda work: module.Ring([f"x{i}" for i in range(128)], work).constant(1)) == 4
    wide = module.Ring(["x"], module.Work(1000))
    seventeen = module.Polynomial(wide, dict.fromkeys(range(17), 1), 16, 1)
    assert bounded(seventeen + wide.constant(1))
    assert wide.work.left == 1000 - (1 + 17 // 4)
    long = module.Polynomial(wide, {0: 1 << 1023, 1: 1}, 1, 1024)
    assert bounded(long + wide.constant(1))
    assert wide.work.left == 995 - (1 + 2 * (1 + 1024 // 512) // 4)
    assert bounded(long.times(1 << 511))
    assert wide.work.left == 993 - 2 * (1 + 1024 // 512 + 512 // 512)
    broad = module.Ring([f"x{i}" for i in range(16)], module.Work(1000))
    (broad.variable(0) + broad.variable(1)).split()
    assert broad.work.left == 1000 - 1 - 2 * (1 + 16 // 8)
    few = module.Ring(["x"], module.Work(5))  # two sums of two terms, and half a product
    assert refused(lambda: (few.variable(0) + few.constant(1)) * (few.variable(0) + few.constant(2)))


def evaluations(module):
    """Parts of trees that are evaluated: 7, 3 and 3 of what is stated, 5 of what is compared; 4 of the value of x."""
    first = {"left": ["x"], "right": [["^", "x", 2]], "definitions": []}
    second = {"left": ["x"], "right": [1]}
    relations = {"relations": [["<", "x", 0]]}
    example = {"refutes": [0], "agrees": [1], "hypotheses": [{"left": ["x"], "right": [1]}]}
    sizes = module.size(["x", ["^", "x", 2]]), module.size(["x", 1]), module.size([["<", "x", 0]])
    found = module.evaluations({
        "statements": [first, second], "hypotheses": [relations], "comparisons": [relations, relations],
        "points": [{}, {}, {}], "counterexamples": [example, example],
        "derivation": [{"name": "x", "value": ["+", "y", 1]}, {"name": "z", "value": 1}],
    })  # fmt: skip
    assert (*sizes, module.size(["+", "y", 1])) == (7, 3, 5, 4)
    assert found == 11 + 7 + (3 + 2) * 5 + 2 * 5 + 2 * (11 + 7 + 7)
    assert module.size(["^", "x", -60]) == 60 + 3


def roots(module, Work):
    work = Work(1000)
    assert module._remainder([1, 0, 1 << 1024], [1, 3], work) == [1]
    assert work.left == 1000 - (3 + 2) * (1 + 1025 // 512) ** 2
    assert module._roots([-6, 11, -6, 1], work) == (3, 3, 3, 3)
    assert module._roots([1, 0, 2, 0, 1], work) == (0, 2, 0, 4)


def trees(module, refused):
    for tree in (["+", "x"], ["-", "x", "x"], ["+", *["x"] * module.MOST_OPERANDS]):
        assert refused(module.check_tree, tree, "it")
    large = 1 << module.MOST_BITS_OF_VALUES
    assert module.bounded(large - 1) == large - 1
    assert refused(module.bounded, large)
    assert refused(module.bounded, Fraction(1, large))


def words(module, Work, refused):
    def many(work):
        return module.Words({((0,) * 16, (letter,)): Fraction(1) for letter in "AB"}, work)

    assert spent(Work, many) == 1 + 4 * (1 + 16 // 8)
    work = Work(1000)
    one = {"AB": module.Words({((0, 0), ()): Fraction(1)}, work)}
    module.Words({((0, 0), tuple("AB" + "C" * 12)): Fraction(1)}, work).rewritten({("A", "B"): one["AB"]})
    assert work.left == 1000 - 4 * 2 * (1 + 16 // 8)

    def word(letters, work=None, exponents=(0, 0)):
        return module.Words({(exponents, tuple(letters)): Fraction(1)}, work or Work())

    assert not refused(word, "a" * module.MOST_LETTERS)
    assert refused(word, "a" * (module.MOST_LETTERS + 1))
    many = {((i, 0), ()): Fraction(1) for i in range(module.MOST_WORDS + 1)}
    assert refused(module.Words, many, Work())
    assert refused(lambda: word("a", Work(1)) + word("b", Work(1)))
    assert refused(lambda: word("ab", Work(8)).rewritten({("a", "b"): word("") + word("c") + word("d")}))
    assert not refused(lambda: word("ab", Work(8)).rewritten({("a", "b"): word("c")}))
    most = module.MOST_EXPONENT
    assert not refused(word, "a", None, (-most, most))
    assert refused(word, "a", None, (0, -most - 1))
    assert refused(word, "a", None, (most + 1, 0))
    assert refused(lambda: word("a") ** -1)
    assert refused(lambda: (word("", exponents=(1, 0)) + word("", exponents=(0, 1))) ** -1)
    assert (word("", exponents=(1, -2)) ** -2).terms == {((-2, 4), ()): 1}


NUMBERS = {"a": 2, "b": 3, "c": 5, "x1": 1, "x2": -2, "x3": 4, "y1": 3, "y2": 1, "y3": -1, "s": 7}
GLOSSARY = [
    *([name, name, name] for name in "abcs"),
    ["x", "a vector", ["x1", "x2", "x3"]],
    [r"\tilde x", "another", ["y1", "y2", "y3"]],
    [r"\Lambda", "diagonal", [["a", 0, 0], [0, "b", 0], [0, 0, "c"]]],
    ["A", "a matrix", [["a", "b", 1], [0, "c", 2], [1, 1, "s"]]],
    [r"f(\delta u)", "a function", "s"],
    ["a_{k+1}", "the next a", ["*", 10, "a"]],
    [r"\dot{b}", "a rate", ["*", 20, "b"]],
]


def numbers(of, value):
    rank, tree = of
    if rank:
        return [numbers((rank - 1, part), value) for part in tree]
    return value(tree, {name: Fraction(x) for name, x in NUMBERS.items()}, Fraction)


READ = {
    "1 + 2a - bc": 1 + 4 - 15,
    r"\frac ab": Fraction(2, 3),
    r"\tfrac12 a": 1,
    r"\frac\dot{b}2c": 150,
    "(a) + " * 40 + "a": 82,
    r"\frac{a+b}2c": Fraction(25, 2),
    "-a^2": -4,
    "a^{-1}b^2": Fraction(9, 2),
    "12a": 24,
    "a_{k+1} - a": 18,
    r"f(\delta u)\,a": 14,
    r"\langle x, \tilde x\rangle": 3 - 2 - 4,
    r"x\times\tilde x": [-2, 13, 7],
    r"a\,x\times\tilde x": [-4, 26, 14],
    r"\Lambda x": [2, -6, 20],
    r"\Lambda^{-2}x": [Fraction(1, 4), Fraction(-2, 9), Fraction(4, 25)],
    r"\Lambda x\times x": [-6 * 4 + 2 * 20, 20 - 8, -4 + 6],
    r"\langle x,\Lambda^{-1}\tilde x\rangle": Fraction(3, 2) - Fraction(2, 3) - Fraction(4, 5),
    "A x": [2 - 6 + 4, -10 + 8, 1 - 2 + 28],
    r"A^T x": [2 + 4, 3 - 10 + 4, 1 - 4 + 28],
    r"[A, \Lambda]": [[0, 3 * 3 - 2 * 3, 5 - 2], [0, 0, 4], [2 - 5, 3 - 5, 0]],
    r"\mathrm{diag}(a, b, c)x": [2, -6, 20],
    "2(a + b, bc, -s)^T": [10, 30, -14],
    r"[a + b]\,\bigl(a - b\bigr)": -5,
    r"\langle x,\tilde x\rangle^2 x": [9, -18, 36],
    r"\begin{pmatrix}a & -b\\ 2c & s\end{pmatrix}": [[2, -3], [10, 7]],
    r"\begin{pmatrix}a & b & c\end{pmatrix} x": [2 - 6 + 20],
}  # fmt: skip


#: What is not read.
UNREAD = [
    "z = a",
    "a",
    r"\frac a = b",
    "(a = b",
    r"\langle a, b\rangle = c",
    "x x = a",
    "x + a = b",
    "a^b = c",
    "A^{-1} = A",
    r"\sqrt a + \sqrt b = c",
    r"a \times b = c",
    "{a = b",
    r"\langle x, x, x\rangle = a",
    "= a",
    "a = ",
    r"\oint a = b",
    r"\mathrm{det}a = b",
    r"x\wedge x = a",
    f"{'(' * 31}a{')' * 31} = b",
    r"\begin{vmatrix}a\end{pmatrix} = A",
    r"(a, b)^T\times x = x",
    r"a\times x = x",
    r"(a, x, b)^T = x",
    r"\begin{pmatrix}a & b\\ c\end{pmatrix} = A",
    r"\begin{pmatrix}a & x\end{pmatrix} = A",
    r"\begin{pmatrix}a & b = A",
    r"\begin{matrix}a & b\end{matrix} = A",
    r"\begin{pmatrix}a + & b\end{pmatrix} = A",
    "a < b < c",
    r"a = b \ne c",
    r"2a \to b",
    r"\mathrm{tr}A = a",
    "t = a",
]

#: Relations, and their sides.
RELATED = {
    "a < b": ("<", "a", "b"), "a > b": ("<", "b", "a"), r"a \le b": ("<=", "a", "b"), r"a \ge b": ("<=", "b", "a"),
    r"a \ne b": ("!=", "a", "b"), r"a \to b": ("=", "a", "b"), r"a \mapsto b": ("=", "a", "b"),
}  # fmt: skip

#: Of what sums of traces are the trace, and what is none.
TRACES = {
    r"\mathrm{tr} A": "A",
    r"-m\,\mathrm{tr}(Av) + \mathrm{tr} B": ["+", ["*", -1, "m", ["*", "A", "v"]], ["*", "A", "B"]],
    r"\langle v, w\rangle": ["*", "w", "v^T"],
    r"2(t - \mathrm{tr} A)": ["*", 2, ["+", "w", ["*", -1, "A"]]],
    "0": 0,
}
NO_TRACES = [
    "A", "1", r"\mathrm{tr} A + 1", r"\mathrm{tr} A + A", r"\mathrm{tr} A\,\mathrm{tr} B", r"(\mathrm{tr} A)^2", "t^2",
    r"A\,\mathrm{tr} A", "tA", "tt", r"\mathrm{tr} t", r"\mathrm{tr}(A + \mathrm{tr} B)", r"\frac1{\mathrm{tr} A}",
    r"\langle v, t\rangle", r"\langle v, w, w\rangle", r"\mathrm{tr} A (m + B)", r"\mathrm{ab} A", r"\mathbf{tr} A",
]  # fmt: skip


def reading(module):
    """Formulas are read as they are meant, or not at all."""
    value = import_module(f"{module.__package__}.trees").value
    for formula, meant in READ.items():
        [part] = module.parts(f"{formula} = s")
        [(_, left, right)] = module.relations(part, module.Reader(GLOSSARY))
        assert (numbers(left, value), numbers(right, value)) == (meant, 7), formula
    for formula in UNREAD:
        [part] = module.parts(formula)
        said = ""
        try:
            module.relations(part, module.Reader(GLOSSARY))
        except module.NotRead as error:
            said = str(error)
        assert 5 < len(said) < 100, formula
    formula = r"a = b \equiv c,\ \langle x, x\rangle = s;\quad \text{for all } a: a = b"
    assert len(module.parts(formula)) == 4
    assert len(module.relations(module.parts(formula)[0], module.Reader(GLOSSARY))) == 2
    glossary = [["A", "", "A"], ["B", "", ["*", "A", "B"]], ["v", "", "v"], ["w", "", "w"], ["m", "", "m"]]
    transposes = {"A": "A^T", "A^T": "A", "B": ["*", -1, "B"], "v": "v^T", "v^T": "v", "w": "w^T", "w^T": "w", "m": "m"}
    wedge = ["+", ["*", "v", "w^T"], ["*", -1, ["*", "w", "v^T"]]]
    for formula, tree in {
        "B^T": ["*", ["*", -1, "B"], "A^T"],
        "(mA)^T": ["*", "A^T", "m"],
        r"v\wedge w": wedge,
        r"v\wedge w^T": wedge,
        r"v\wedge w + A^T": ["+", wedge, "A^T"],
    }.items():
        [part] = module.parts(f"{formula} = A")
        [(_, left, _)] = module.relations(part, module.Reader(glossary, transposes))
        assert left == (0, tree), formula
    for formula, sides in RELATED.items():
        [(kind, (_, left), (_, right))] = module.relations(module.parts(formula)[0], module.Reader(GLOSSARY))
        assert (kind, left, right) == sides
    assert [len(module.parts(f"a = b{between} b = c")) for between in (r"\quad", r"\qquad", r"\,", r"(\quad)")] == [
        2,
        2,
        1,
        1,
    ]
    glossary.append(["t", "", {"trace": "w"}])
    for formula in (*TRACES, *NO_TRACES):
        found = None
        try:
            [(_, (_, found), _)] = module.relations(
                module.parts(f"{formula} = t")[0], module.Reader(glossary, transposes, ["m"])
            )
        except module.NotRead:
            assert formula in NO_TRACES, formula
        assert flat(found) == flat(TRACES.get(formula)), formula


def flat(tree):
    """Products of products as one."""
    if not isinstance(tree, list):
        return tree
    parts = [flat(part) for part in tree[1:]]
    return [tree[0], *(y for x in parts for y in (x[1:] if isinstance(x, list) and x[0] == tree[0] == "*" else [x]))]
