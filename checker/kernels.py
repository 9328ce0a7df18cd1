"""Kernels: a proof that the source text of a function computes a side of a certified statement.

A function is straight-line code of names, integers and + - * /.  It is evaluated in the field of rational functions of
its arguments.  Its results, in order, must be the entries that its carriers make.  A carrier names a certificate and a
statement in it, by its text.  The statement must be proved there, in a quotient ring, and have two different sides.
The carrier takes the entries of one side, and applies steps:

at       [name, tree]...: trees are substituted for variables
along    [[name, tree]...]...: for each entry, its derivatives in these directions, each given by the rates of the
         variables; the relations of the ring are invariant along each direction
solved   a carrier of n² entries: the solution x of (the matrix of these, row by row) x = (the n entries)
entries  numbers: a selection of the entries, in this order

The arguments have the names of the variables.  The results equal the entries as rational functions.  If the carrier has
cofactors for an entry, [its number, [a tree for each relation of the ring]], the numerator of the difference is instead
Σ cofactor · relation: then the two are equal wherever the relations hold.  The point of a carrier shows that this is
not vacuous: all relations hold there, and neither the entries nor the text divide by 0.

A text may have letters, [name, function, tree]: sin, cos or sqrt of a tree, or pi, which it imports.  They are
variables of the ring, with the relations of letters.py; a carrier's relations with a letter must follow from these.
"""

from __future__ import annotations

import ast
import hashlib
import re
from collections.abc import Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any, NamedTuple

from . import derivation, letters
from .derivation import check_pairs
from .document import Data, Unreadable, read
from .form import anything, check_shape, text
from .interval import Rejected
from .letters import Letter
from .matrices import Quotients
from .polynomial import Quotient, Ring, Work
from .rational import number_at, placed, rate, solved
from .trees import check_known, check_tree, names_in, rational, value

MANIFEST = "manifest.json"
#: The most letters of a text, and the most statements of its function.
MOST_LETTERS, MOST_LINES = 200_000, 5_000
LINE = range(MOST_LINES + 1)
#: Certificates by name: the id of the claim, and the digest.
Certificates = Mapping[str, Data]


def check(row: Any, written: str, certificates: Certificates, where: str) -> list[str]:
    """The statements that carry a function, with their steps; raises Rejected unless the function computes these.

    row: "inputs", "carriers", and "text_sha256", the hash of the text.  certificates: the accepted certificates.
    where: the name of the function.
    """
    if not isinstance(row, dict) or not {"inputs", "carriers", "text_sha256"} <= row.keys():
        raise Rejected(f"{where} has no inputs, carriers and hash of its text")
    if hashlib.sha256(written.encode()).hexdigest() != row["text_sha256"]:
        raise Rejected(f"{where} has a text with another hash")
    one = carried(row, written, certificates, where)
    for i, each in enumerate(differences(one, where)):
        carrier = row["carriers"][each.carrier]
        cofactors = dict(map(tuple, carrier.get("cofactors", []))).get(each.entry, [])
        check_known(cofactors, each.ring.names, where)
        proved = len(cofactors) == len(each.ring.relations) and each.ring.vanishes(
            each.value.numerator, cofactors, where
        )
        if each.value.numerator.terms and not proved:
            said = carrier["statement"]
            raise Rejected(f"{where} computes in its result {i} something else than «{said}» says")
    for i, carrier in enumerate(row["carriers"]):
        check_point(one, i, carrier.get("point", {}), where)
    return [": ".join([one["statement"], *(SAID[step] for step, _ in one["steps"])]) for one in row["carriers"]]


#: The steps of a carrier, in words.
SAID = {
    "at": "at values",
    "along": "its derivatives",
    "solved": "the solution of a linear system",
    "entries": "entries",
}


def _hides(entry: Path) -> bool:
    """Whether Python might import this entry of the folder instead of the .py file of the same name."""
    return entry.is_dir() or entry.suffix in (".so", ".pyd", ".pyc", ".pyw")


class Carried(NamedTuple):
    """A function and its carriers: inputs, results in a ring; for each carrier the entries, the ring with the
    relations, and the divisors of carrier and text; letters."""

    inputs: list[str]
    computed: list[Quotient]
    entries: list[list[Quotient]]
    rings: list[Quotients]
    divisors: list[list[Quotient]]
    letters: list[Letter]


class Difference(NamedTuple):
    """A result minus the entry of a carrier, in the ring with the relations of the carrier."""

    value: Quotient
    ring: Quotients
    carrier: int
    entry: int


def carried(row: Data, written: str, certificates: Certificates, where: str) -> Carried:
    """The results of a text and the entries of its carriers; raises Rejected if a form is invalid."""
    function = straight_line(written, where)
    check_shape(row["carriers"], [check_carrier_form], f"a carrier of {where}")
    inputs = [argument.arg for argument in function.args.args]
    if inputs != row["inputs"]:
        raise Rejected(f"{where} does not have the arguments {row['inputs']!a:.200}")
    own = letters.check_form(row.get("letters", []), inputs, where)
    names = {*inputs, *own}.union(*(_names(one, certificates, where) for one in row["carriers"]))
    ring = Ring(sorted(names), Work())
    adjoined = letters.read(row.get("letters", []), ring, where)
    computed = _run(function, ring, adjoined, where)
    divisors = _divisors(ring)
    made = [entries(one, certificates, ring, where, adjoined) for one in row["carriers"]]
    if len(computed) != (total := sum(len(found) for found, *_ in made)):
        raise Rejected(f"{where} has {len(computed)} results, and its carriers make {total}")
    _check_head(ast.get_docstring(ast.parse(written)) or "", row["carriers"], where)
    more = letters.relations(adjoined, ring)
    for carrier, (_, relations, _) in zip(row["carriers"], made, strict=True):
        if not all(letters.follows(relation, adjoined) for relation in relations):
            raise Rejected(f"{where} has a letter of which a relation of «{carrier['statement']}» does not follow")
    rings = [Quotients(ring, ring.names(), [*relations, *more]) for _, relations, _ in made]
    divided = [[*divisors, *own] for *_, own in made]
    return Carried(inputs, computed, [found for found, *_ in made], rings, divided, adjoined)


def differences(one: Carried, where: str) -> list[Difference]:
    """The differences of all results from their entries, in order."""
    places = [(i, j) for i, found in enumerate(one.entries) for j in range(len(found))]
    return [
        Difference(result - one.entries[i][j], one.rings[i], i, j)
        for result, (i, j) in zip(one.computed, places, strict=True)
    ]


def check_point(one: Carried, i: int, point: Data, where: str) -> None:
    """Raises Rejected unless the relations of a carrier hold at a point, without division by 0.

    Otherwise an equality by the relations might be vacuous: no point satisfies them, or all values are 0/0.
    """
    numbers = {name: rational(x, f"the point of {where}") for name, x in point.items()}
    if missing := [name for name in (*one.inputs, *(x.name for x in one.letters)) if name not in numbers]:
        raise Rejected(f"{where} has no point at which its relations hold: no value for {missing[0]}")
    letters.check_point(one.letters, numbers, where)
    for relation in one.rings[i].relations:
        if number_at(relation, numbers, where) != 0:
            raise Rejected(f"{where} has a point at which a relation fails")
    if any(number_at(divisor, numbers, where) == 0 for divisor in one.divisors[i]):
        raise Rejected(f"{where}, or what carries it, divides by 0 at its point")


def _check_head(head: str, carriers: Sequence[Data], where: str) -> None:
    """Raises Rejected if the docstring of a text names a certificate that does not carry it."""
    named = set(re.findall(r"[Cc]ertificate of (\S+): sha256 (\w+)", head))
    proved = re.search(r"Proved by: (.*?)\.  ", head)
    carrying = {pair for carrier in carriers for pair in _certificates(carrier)}
    claims = set(proved[1].split(", ")) if proved else set()
    if not named <= carrying or not claims <= {claim for claim, _ in carrying}:
        raise Rejected(f"{where} says that it is proved by what does not carry it")


def _certificates(carrier: Data) -> list[tuple[str, str]]:
    found = [(carrier["claim"], carrier["certificate"])]
    return found + [pair for step, by in carrier["steps"] if step == "solved" for pair in _certificates(by)]


def check_folder(folder: Path, certificates: Certificates) -> list[Data]:
    """The verdict on every kernel of a generated package: its file, and either its inputs and statements or the reason.

    Files that the manifest does not list as kernels are ignored; a kernel without a file is rejected.
    """
    try:
        rows = read(folder / MANIFEST)["kernels"]
        if not isinstance(rows, dict) or not rows:
            raise KeyError
    except (Unreadable, Rejected, KeyError):
        reason = f"{folder / MANIFEST} does not list kernels"
        return [{"file": str(folder), "accepted": False, "reason": reason}]
    found: list[Data] = []
    for name, row in rows.items():
        file = folder / f"{name}.py"
        try:
            if not name.isidentifier():
                raise Rejected(f"{name!a:.40} is no name of a kernel")
            if hidden := [one.name for one in folder.iterdir() if one.name.split(".")[0] == name and _hides(one)]:
                raise Rejected(f"{name} lies with {hidden[0]}, which Python would import in its place")
            written = file.read_bytes()[: MOST_LETTERS + 1].decode()
            said = check(row, written, certificates, name)
            found.append({"file": str(file), "accepted": True, "inputs": row["inputs"], "statements": said})
        except (OSError, ValueError):
            found.append({"file": str(file), "accepted": False, "reason": f"{file} cannot be read"})
        except Rejected as error:
            found.append({"file": str(file), "accepted": False, "reason": str(error)})
    return found


def check_step(data: Any, where: str) -> None:
    """Raises Rejected unless this is a step of a carrier: its name and its operand."""
    check_shape(data, (tuple(BY), anything), where)
    step, by = data
    check_shape(by, BY[step], where)


def check_carrier_form(data: Any, where: str) -> None:
    """Raises Rejected unless this is a carrier."""
    check_shape(data, CARRIER, where)


BY = {"at": check_pairs, "along": [check_pairs], "solved": check_carrier_form, "entries": [LINE]}
CARRIER = {
    "claim": text, "certificate": text, "statement": text, "side": ("left", "right"), "steps": [check_step],
    "cofactors?": [(LINE, [check_tree])], "point?": dict,
}  # fmt: skip


def moves(step: str, by: Any) -> Sequence[Any]:
    """The lists of [name, tree] pairs of a step."""
    return [by] if step == "at" else by if step == "along" else []


def _statement(carrier: Data, certificates: Certificates, where: str) -> tuple[Data, Data]:
    """The statement that a carrier names, and its certificate; it must be unique, proved and non-trivial."""
    claim, said = carrier["claim"], carrier["statement"]
    data = certificates.get(f"{claim} {carrier['certificate']}")
    if data is None:
        raise Rejected(f"{where} is carried by a certificate of claim {claim} that is not accepted among these files")
    found = [one for one in data["statements"] if one["text"] == said]
    if len(found) != 1:
        raise Rejected(f"{where} is carried by «{said}», which claim {claim} decides {len(found)} times")
    (statement,) = found
    if "refuted" in statement:
        raise Rejected(f"{where} is carried by «{said}», which claim {claim} refutes")
    if statement["left"] == statement["right"]:
        raise Rejected(f"{where} is carried by «{said}», which has one expression on both sides and decides nothing")
    if data["algebras"][statement["algebra"]]["kind"] != "quotient":
        raise Rejected(f"{where} is carried by «{said}», which is about words, and a kernel is about numbers")
    return statement, data


def _names(carrier: Data, certificates: Certificates, where: str) -> set[str]:
    """The variables that a carrier needs; raises Rejected if a step replaces or moves a name that is no variable.

    Such a step would have no effect.
    """
    statement, data = _statement(carrier, certificates, where)
    variables = set(data["algebras"][statement["algebra"]]["variables"])
    found = set(variables)
    for step, by in carrier["steps"]:
        if step == "solved":
            variables |= _names(by, certificates, where)
        found |= variables
        for pairs in moves(step, by):
            if strange := [name for name, _ in pairs if name not in variables]:
                raise Rejected(f"{where} moves {strange[0]!a:.40}, which is no variable of «{statement['text']}» there")
            found = found.union(*(names_in(tree) for _, tree in pairs))
        if step == "at":
            variables = (variables - {name for name, _ in by}).union(*(names_in(tree) for _, tree in by))
    return found


def entries(
    carrier: Data, certificates: Certificates, ring: Ring, where: str, adjoined: Sequence[Letter] = ()
) -> tuple[list[Quotient], list[Quotient], list[Quotient]]:
    """The entries of a carrier in the variables of the ring, the relations that hold for them, and its divisors."""
    statement, data = _statement(carrier, certificates, where)
    # An argument or a letter whose name the certificate derives, or does not have, is no variable of the statement.
    names = {name: ring.names()[name] for name in data["algebras"][statement["algebra"]]["variables"]}
    steps = list(carrier["steps"])
    kinds = [step for step, _ in steps]
    if adjoined and "along" in kinds and "at" in kinds[kinds.index("along") :]:
        raise Rejected(f"{where} puts in expressions after derivatives, which would change the meaning of its letters")
    if steps and steps[0][0] == "at":  # substituted while reading, which saves a second pass
        names |= {name: value(tree, ring.names(), ring.number) for name, tree in steps.pop(0)[1]}
    for name, tree in (*derivation.valued(data["derivation"]).items(), *statement.get("definitions", [])):
        if names_in(tree) <= names.keys():
            names[name] = value(tree, names, ring.number)
    if strange := names_in([0, *statement["left"], *statement["right"]]) - names.keys():
        raise Rejected(f"{where} is carried by «{statement['text']}», which has {min(strange)!a:.40} without a value")
    sides = {side: [value(tree, names, ring.number) for tree in statement[side]] for side in ("left", "right")}
    found, divisors = sides[carrier["side"]], _divisors(ring)
    relations = [value(r, names, ring.number) for r in data["algebras"][statement["algebra"]]["relations"]]
    for step, by in steps:
        images = [{name: value(tree, ring.names(), ring.number) for name, tree in pairs} for pairs in moves(step, by)]
        if step == "entries":
            if any(i >= len(found) for i in by):
                raise Rejected(f"{where} wants an entry that «{statement['text']}» does not have")
            found = [found[i] for i in by]
        elif step == "solved":
            matrix, others, divided = entries(by, certificates, ring, where, adjoined)
            found, relations, divisors = solved(matrix, found, where), [*relations, *others], [*divisors, *divided]
        elif step == "at":
            whole = found, relations, divisors
            found, relations, divisors = ([placed(x, images[0]) for x in group] for group in whole)
        else:
            if any(rate(relation, image).numerator.terms for relation in relations for image in images):
                raise Rejected(f"{where} is differentiated along rates that break a relation of «{statement['text']}»")
            letters.check_moves(adjoined, images, where)
            found = [rate(x, image) for x in found for image in images]
        divisors += _divisors(ring)
    return found, relations, divisors


def _divisors(ring: Ring) -> list[Quotient]:
    """The divisors used in a ring since the last call."""
    found = [Quotient(ring.factors[i], 1, {}) for i in sorted(ring.used)]
    ring.used.clear()
    return found


def straight_line(written: str, where: str) -> ast.FunctionDef:
    """The single function of a text; its statements are checked later, when they are evaluated."""
    if len(written) > MOST_LETTERS:
        raise Rejected(f"{where} has more than {MOST_LETTERS} letters")
    try:
        body = ast.parse(written).body
        compile(written, where, "exec", dont_inherit=True)  # finds more errors than the parser, and runs nothing
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise Rejected(f"{where} is not Python") from None
    # A text that begins with the docstring has no encoding declaration, which Python would obey.
    imported = letters.imported(body.pop(1), where) if len(body) == 3 else set()
    if len(body) != 2 or not _is_text(body[0]) or not isinstance(body[1], ast.FunctionDef) or written[:3] != '"""':
        raise Rejected(f"{where} is not a docstring and one function")
    function, arguments = body[1], body[1].args
    more = (arguments.defaults, arguments.vararg, arguments.kwonlyargs, arguments.kwarg, arguments.posonlyargs)
    if function.decorator_list or any(more):
        raise Rejected(f"{where} has a function with decorators, defaults or arguments beyond a list of names")
    if function.returns or any(one.annotation for one in arguments.args) or getattr(function, "type_params", []):
        raise Rejected(f"{where} has a function with annotations, which Python evaluates")
    if function.name != where:
        raise Rejected(f"{where} has a function of another name")
    letters.check_names(function, imported, where)
    if len(function.body) > MOST_LINES or not arguments.args:
        raise Rejected(f"{where} has a function without arguments, or of more than {MOST_LINES} lines")
    return function


def _is_text(node: ast.stmt) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)


def _run(function: ast.FunctionDef, ring: Ring, adjoined: Sequence[Letter], where: str) -> list[Quotient]:
    """The results of a function in a ring with its arguments and letters as variables."""
    inputs = {one.arg for one in function.args.args}
    known, number = {name: ring.names()[name] for name in inputs}, ring.number
    whole: set[str] = set()  # names of integers; Python computes with integers differently: 1 / 3 is a float

    def is_whole(node: ast.expr) -> bool:
        return all(one.id in whole for one in ast.walk(node) if isinstance(one, ast.Name))

    def of(node: ast.expr) -> Any:
        if isinstance(node, ast.BinOp) and is_whole(node):
            raise Rejected(f"{where} computes with whole numbers alone")
        match node:
            case ast.Name(id=name) if name in known:
                return known[name]
            case ast.Constant(value=int() as x) if not isinstance(x, bool):
                return number(rational(x, where))
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return number(Fraction(-1)) * of(operand)
            case ast.BinOp(left=left, op=ast.Add(), right=right):
                return of(left) + of(right)
            case ast.BinOp(left=left, op=ast.Sub(), right=right):
                return of(left) - of(right)
            case ast.BinOp(left=left, op=ast.Mult(), right=right):
                return of(left) * of(right)
            case ast.BinOp(left=left, op=ast.Div(), right=right):
                return of(left) * of(right) ** -1
        raise Rejected(f"{where} has a part that is neither a known name, an integer, nor + - * /")

    def argument(called: str, given: list[ast.expr]) -> Any:
        first = () if called == "pi" else given[:1]
        likes = [x.id for x in given[len(first) :] if isinstance(x, ast.Name) and x.id in inputs]
        if len(likes) + len(first) == len(given):  # these arguments fix the number type
            match first:
                case () if likes:
                    return number(Fraction(1))
                case [ast.Constant(value=int() as x)] if likes and not isinstance(x, bool):
                    return number(rational(x, where))
                case [one] if not is_whole(one):
                    return of(one)
        raise Rejected(f"{where} has a {called} of something that is none")

    def letter(name: str, called: str, of: Quotient) -> Quotient:
        for one in adjoined:
            if (one.name, one.function) == (name, called) and not (of - one.of).numerator.terms:
                return ring.names()[name]
        raise Rejected(f"{where} has no letter {name} that is this {called}")

    body = [node for node in function.body if not _is_text(node)]
    try:
        for node in body[:-1]:
            match node:
                case ast.Assign(targets=[ast.Name(id=name)], value=ast.Call(func=ast.Name(id=called), args=given)):
                    known[name], whole = letter(name, called, argument(called, given)), whole - {name}
                case ast.Assign(targets=[ast.Name(id=name)], value=assigned):
                    known[name] = of(assigned)
                    whole = whole | {name} if is_whole(assigned) else whole - {name}
                case _:
                    raise Rejected(f"{where} does something else than assign to a name")
        match body[-1:]:
            case [ast.Return(value=ast.Tuple(elts=parts))] if len(parts) > 1:
                return [of(part) for part in parts]
            case [ast.Return(value=ast.expr() as part)]:
                return [of(part)]
    except RecursionError:
        raise Rejected(f"{where} is too deep") from None
    raise Rejected(f"{where} returns nothing")
