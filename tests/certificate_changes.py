"""Certificates with one number changed, for the tests of the checker."""

import copy
from contextlib import suppress
from pathlib import Path

import certificate_maker as maker

from chapsym import checker, proofs

FOLDER = Path(proofs.__path__[0]) / "certificates"


def committed(name):
    """A certificate of the package."""
    return checker.read(FOLDER / f"{name}.json")


def resealed(data):
    """The same with the sentence and the digest that its numbers make: only mathematics is left to refuse it."""
    with suppress(AttributeError, KeyError, TypeError, IndexError):
        data["statement"] = checker.statement(data)
    return maker.sealed(data)


def leaves(data, path=()):
    """The places of all numbers: of every string that contains a digit and of every integer, but for the digest."""
    if isinstance(data, dict | list):
        items = data.items() if isinstance(data, dict) else enumerate(data)
        for name, value in items:
            yield from leaves(value, (*path, name))
    elif path[0] not in ("digest", "statement", "format", "kind"):
        yield path


def replaced(data, path, value):
    data = copy.deepcopy(data)
    *folder, name = path
    place = data
    for part in folder:
        place = place[part]
    place[name] = value
    return data


def at(data, path):
    for part in path:
        data = data[part]
    return data


def changed(value, rng):
    """One number with one digit, its sign or its letter changed; an integer by 1 to 9."""
    if isinstance(value, int):
        return value + rng.choice([x for x in range(-9, 10) if x])
    if value in ("a", "b"):
        return "b" if value == "a" else "a"
    if rng.random() < 0.1:
        return value[1:] if value.startswith("-") else "-" + value
    i = rng.choice([i for i, c in enumerate(value) if c.isdigit()])
    return value[:i] + rng.choice([c for c in "0123456789" if c != value[i]]) + value[i + 1 :]


def refused(data):
    try:
        checker.check(data)
    except checker.Rejected as error:
        return len(str(error)) > 10  # a sentence
    return False
