"""Docstrings of the public names: the sections of numpydoc's, with every parameter, and examples that run."""

import doctest
import inspect
import re

import pytest

import chapsym

SECTION = re.compile(r"^(\w+)\n-{3,}\n", re.MULTILINE)
FUNCTIONS = [name for name in chapsym.__all__ if inspect.isfunction(getattr(chapsym, name))]
CLASSES = [
    name
    for name in chapsym.__all__
    if inspect.isclass(one := getattr(chapsym, name)) and not issubclass(one, Exception | int)
]


def sections(name):
    """The sections of a docstring, by their heads."""
    _, *parts = SECTION.split(inspect.getdoc(getattr(chapsym, name)))
    return dict(zip(parts[::2], parts[1::2], strict=True))


def entries(section):
    """The names of the entries of a section."""
    heads = re.findall(r"^(\S[^:\n]*?)(?: :.*)?$", section, re.MULTILINE)
    return [name.lstrip("*") for head in heads for name in head.split(", ")]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_function_has_its_parameters_what_it_returns_and_an_example(name):
    found = sections(name)
    assert entries(found["Parameters"]) == list(inspect.signature(getattr(chapsym, name)).parameters)
    assert {"Returns", "Examples"} <= found.keys()
    assert ">>>" in found["Examples"]


@pytest.mark.parametrize("name", CLASSES)
def test_a_class_has_its_parameters_or_attributes(name):
    found = sections(name)
    assert found.keys() & {"Parameters", "Attributes"}


@pytest.mark.parametrize("name", [*FUNCTIONS, *CLASSES])
def test_examples_run(name):
    one = getattr(chapsym, name)
    tests = doctest.DocTestFinder(exclude_empty=True).find(one, name, globs={})
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    for test in tests:
        runner.run(test)
    assert runner.summarize(verbose=False).failed == 0
