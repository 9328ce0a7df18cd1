"""Small certificates about numbers of solutions: those that are right, and those that are not."""

import copy
from functools import cache

from certificate_changes import resealed
from derivation_changes import in_coordinates
from register_changes import LETTERS, TURN, by_hand


def plus(*parts):
    return ["+", *parts]


def times(*parts):
    return ["*", *parts]


def less(a, b):
    return plus(a, times(-1, b))


def square(of, k=2):
    return ["^", of, k]


def unit(size):
    return [[int(i == j) for j in range(size)] for i in range(size)]


NUMBERS = ("real", "complex", "real_with_multiplicity", "complex_with_multiplicity")


def are(*found):
    """What the numbers are."""
    return [["=", name, n] for name, n in zip(NUMBERS, found, strict=True)]


NONE = {"kind": "quotient", "variables": [], "relations": []}


def count(equations, relations, unknowns="wx", combinations=None, **changes):
    """A count in the unknowns themselves; without combinations, these are the equations."""
    return {
        "role": "lemma", "text": "x", "algebra": 0, "point": 0, "unknowns": [*unknowns], "equations": [*equations],
        "nonzero": [], "chart": unit(len(unknowns)), "relations": relations, "holds": True,
        "combinations": combinations or unit(len(equations)),
    } | changes  # fmt: skip


def counted(*arguments, point=None, algebra=NONE, **changes):
    """A certificate with one count."""
    return by_hand([], [point or {}], [algebra], counts=[count(*arguments, **changes)])


#: x = -1, 0, 1; (x² + 1)(x - 1)²(2 - x); x = 0 three times; the golden section.
CUBIC = less(square("x", 3), times("x", square("w")))
MIXED = times(plus(square("x"), square("w")), square(less("x", "w")), less(times(2, "w"), "x"))
GOLDEN = less(less(square("x"), times("x", "w")), square("w"))
#: Two curves that touch at (1, 1) and (-1, -1).
TOUCH = [less(plus(square("x"), square("y")), times(2, square("w"))), less(times("x", "y"), square("w"))]
BY_TOUCH = [[0, 1], ["y2", times(-1, "y1")], [1, 0]]
#: A line and a circle, which meet where x = ±1; a chart with y0 = 2w and y2 = y - x.
LINE = [less("y", times(2, "x")), less(plus(square("x"), square("y")), times(5, square("w")))]
CHART = [["1/2", 0, 0], [0, 1, 0], [0, 1, 1]]
BY_LINE = [[1, 0], [times(2, plus("y1", times(2, "y2"))), 1]]
#: Three quadrics with eight points.
EIGHT = [
    plus(square("x"), times("y", "z"), times(-1, square("w"))),
    less(square("y"), times("x", "z")),
    less(square("z"), times("w", "x")),
]
BY_EIGHT = [
    ["y0", 0, "y1"],
    [times(square("y0"), "y2"), times(-1, square("y0"), "y3"),
     plus(times("y2", square("y3")), times("y0", "y1", "y2"))],
    [0, 0, 1], [0, 1, 0], [1, 0, 0],
]  # fmt: skip
#: c² + s² = 1, of numbers, and w = 1, of an unknown.
CIRCLE = {
    "kind": "quotient", "variables": ["c", "s", "w"],
    "relations": [plus(square("c"), square("s"), -1), plus("w", -1)],
}  # fmt: skip
ON_IT = {"c": "3/5", "s": "4/5", "k": 2}
OF_CIRCLE = [less(times("c", square("x")), times("s", "k", square("w")))]


def of_entry(valued=True):
    """A count about an entry of a matrix, s = 4/5: s x² = w²."""
    turn = {"A": [["c", times(-1, "s")], ["s", "c"]], "B": [["c", "s"], [times(-1, "s"), "c"]]}
    data = copy.deepcopy(in_coordinates(turn))
    if not valued:
        data["derivation"][-1].pop("value")
    data["algebras"].append(data["algebras"][2])
    data["statements"] = []
    data["counts"] = [count([less(times("q", square("x")), square("w"))], [["=", "real", 2]], algebra=2, point=1)]
    return resealed(data)


def other(data, **changes):
    """A certificate whose count is changed."""
    data = copy.deepcopy(data)
    data["counts"][0].update(changes)
    return resealed(data)


def changed_point(data, **values):
    """A certificate with other values at the point of its count."""
    data = copy.deepcopy(data)
    data["points"][data["counts"][0]["point"]].update(values)
    return resealed(data)


def dense(parts):
    """A form of the degree 40 for each part, whose chain has numbers that grow."""
    return times(1, *(
        plus(*(times(7919 * (k + i * i) % 1009 - 500, square("x", i), square("w", 41 - i)) for i in range(1, 41)),
             square("x", 41), square("w", 41)) for k in range(parts)
    ))  # fmt: skip


@cache
def counts():
    """Certificates by hand: those that are right, and those that are not, by name."""
    right = {
        "three real roots": counted([CUBIC], are(3, 3, 3, 3)),
        "roots of several sorts": counted([MIXED], are(2, 4, 3, 5)),
        "one root three times": counted([square("x", 3)], are(1, 1, 3, 3)),
        "no real root": counted([plus(square("x"), square("w"))], are(0, 2, 0, 2)),
        "with the other sign": counted([less(times(2, square("w")), square("x"))], are(2, 2, 2, 2)),
        "the golden section": counted([times("1/3", GOLDEN)], are(2, 2, 2, 2)),
        "four, two and two": counted([times(GOLDEN, plus(square("x"), times(-3, square("w"))))], are(4, 4, 4, 4)),
        "curves that touch": counted(TOUCH, are(2, 2, 4, 4), "wxy", BY_TOUCH),
        "a line and a circle in a chart": counted(LINE, are(2, 2, 2, 2), "wxy", BY_LINE, chart=CHART),
        "eight points": counted(EIGHT, are(2, 8, 2, 8), "wxyz", BY_EIGHT, nonzero=["x", less("y", times(3, "w"))]),
        "numbers for names": counted(OF_CIRCLE, are(2, 2, 2, 2), point=ON_IT, algebra=CIRCLE),
        "a matrix at the point": counted([CUBIC], are(3, 3, 3, 3), point={"A": [[1]]}),
        "inequalities": counted([CUBIC], [["<", 2, "real"], ["<=", "real", 3], ["!=", "complex", 2]]),
        "what is printed and false": counted([CUBIC], [["<", "real", 3]], role="printed", holds=False),
        "where something does not vanish": counted([MIXED], are(2, 4, 3, 5), nonzero=["x", plus("x", "w")]),
        "an entry": of_entry(),
        "five unknowns": counted(
            [less("a", "w"), less("b", "w"), "c", less(square("d"), square("w"))], are(2, 2, 2, 2), "wabcd"
        ),
        "no root at all": counted([times(3, square("x")), square("w")], are(0, 0, 0, 0), combinations=[[0, 1], [1, 0]]),
    }  # fmt: skip
    cubic, touch, line, circle, entry = (
        right[name] for name in ("three real roots", "curves that touch", "a line and a circle in a chart",
                                 "numbers for names", "an entry")
    )  # fmt: skip
    wrong = {
        **{f"{name} is another number": counted([MIXED], [["=", name, n]])
           for name, n in zip(NUMBERS, (3, 5, 4, 4), strict=True)},
        "what is true and said to fail": other(cubic, role="printed", holds=False),
        "a lemma that fails": other(cubic, relations=[["<", "real", 3]], holds=False),
        "1 for true": other(cubic, holds=1),
        "no relation": other(cubic, relations=[]),
        "a relation about something else": other(cubic, relations=[["=", "x", "x"]]),
        "algebra 1": other(cubic, algebra=1),
        "point 1": other(cubic, point=1),
        "an algebra of words": counted([CUBIC], are(3, 3, 3, 3), point=TURN, algebra=LETTERS),
        "a variable without a number": counted([CUBIC], are(3, 3, 3, 3), algebra=CIRCLE),
        "a number for an unknown": counted([CUBIC], are(3, 3, 3, 3), point={"x": 1}),
        "a number for what is derived": changed_point(entry, q=1),
        "an unknown for what is derived": other(entry, unknowns=["w", "q"]),
        "a name without a value": other(of_entry(valued=False)),
        "a name of another algebra": other(entry, algebra=3),
        "an unknown name": other(cubic, equations=[less(CUBIC, "y")]),
        "an unknown twice": other(cubic, unknowns=["x", "x"]),
        "one unknown": counted(["x"], are(1, 1, 1, 1), "x", [[1]]),
        "six unknowns": counted([*"abcde"], are(1, 1, 1, 1), "wabcde"),
        "a chart with a row too few": other(cubic, chart=[[1, 0]]),
        "a chart with a short row": other(cubic, chart=[[1, 0], [1]]),
        "a chart with a name": other(cubic, chart=[[1, 0], [0, "x"]]),
        "a chart that is not regular": counted([plus(square("x"), square("w"))], are(1, 1, 2, 2), chart=[[0, 1]] * 2),
        "a combination of fewer equations": other(touch, combinations=[*BY_TOUCH[:2], [1]]),
        "a combination in the unknowns": other(cubic, combinations=[["x"]]),
        "a root that is moved": other(cubic, combinations=[[less("y1", times(2, "y0"))]]),
        "another equation": other(touch, equations=[TOUCH[0], less(times("x", "y"), times(2, square("w")))]),
        "an equation more": other(touch, equations=[*TOUCH, less("x", "y")], combinations=[[*c, 0] for c in BY_TOUCH]),
        "a factor with another sign": other(touch, combinations=[[0, 1], ["y2", "y1"], [1, 0]]),
        "combinations in another order": other(touch, combinations=BY_TOUCH[::-1]),
        "one combination twice": other(touch, combinations=[BY_TOUCH[0], *BY_TOUCH]),
        "a combination that is 0": other(touch, combinations=[[0, 0], *BY_TOUCH]),
        "a numerator of a combination": other(cubic, combinations=[[square("y0", -1)]]),
        "an equation with a pole": other(cubic, equations=[times(CUBIC, square("w", -1))]),
        "1/(1/x), which has no value at its root": counted([square(square("x", -1), -1)], are(1, 1, 1, 1)),
        "an equation that is not homogeneous": other(cubic, equations=[less(square("x", 3), "x")]),
        "what must not vanish is not homogeneous": other(cubic, nonzero=[plus("x", 7)]),
        "a combination that is not homogeneous": other(cubic, combinations=[[1], [plus("y0", 1)]]),
        "a solution at infinity": counted([times(CUBIC, "w")], are(3, 3, 3, 3)),
        "a solution at infinity, where y1 is not 0": counted([times("x", "w"), less(square("y"), square("w"))],
                                                             are(2, 2, 2, 2), "wxy"),
        "a solution at infinity, where y2 is not 0": counted([times("y", less("y", "w")), "x"], are(2, 2, 2, 2), "wxy",
                                                             [["y0", 0], [0, 1]][::-1]),
        "two solutions for one root": counted([less(square("x"), square("w")), "y"], are(1, 1, 2, 2), "wxy",
                                              [[0, "y1"], [0, 1], [1, 0]]),
        "nothing but 0": counted([0], are(0, 0, 0, 0), combinations=[[0]]),
        "an x that vanishes": other(cubic, nonzero=["x"]),
        "a difference that vanishes at one": other(line, nonzero=["x", less("x", "w")]),
        "a point off the circle": changed_point(circle, c="4/5"),
        "a denominator that vanishes at the point": other(
            circle, equations=[times(*OF_CIRCLE, square(plus("k", -2), -1))]
        ),
        "a huge degree": counted([times(1, *[square(plus("x", "w"), 60)] * 17)], are(1, 1, 1020, 1020)),
        "a long chain": counted([dense(8)], are(1, 1, 1, 1)),
    }  # fmt: skip
    return right, wrong
