"""Docstrings of the public names: the sections of numpydoc's, with every parameter, and examples that run."""

import doctest
import inspect
import re

import pytest

import chapsym

SECTION = re.compile(r"^(\w+)\n-{3,}\n", re.MULTILINE)
FUNCTIONS = [name for name in chapsym.__all__ if inspect.isfunction(getattr(chapsym, name))]
PUBLIC = {name: getattr(chapsym, name) for name in chapsym.__all__}
CLASSES = [name for name, one in PUBLIC.items() if inspect.isclass(one) and not issubclass(one, Exception | int)]


def sections(name):
    """The sections of a docstring, by their heads."""
    _, *parts = SECTION.split(inspect.getdoc(getattr(chapsym, name)))
    return dict(zip(parts[::2], parts[1::2], strict=True))


def entries(section):
    """The names of the entries of a section."""
    heads = re.findall(r"^(\S[^:\n]*?)(?: :.*)?$", section, re.MULTILINE)
    return [name.lstrip("*") for head in heads for name in head.split(", ")]


@pytest.mark.parametrize("name", [*FUNCTIONS, *CLASSES])
def test_a_name_has_its_sections_and_examples_that_run(name):
    found, one = sections(name), getattr(chapsym, name)
    if name in FUNCTIONS:
        parameters = inspect.signature(one).parameters
        assert entries(found["Parameters"]) == list(parameters)
        for names, kind in re.findall(r"^(\S[^:\n]*?) : (.*)$", found["Parameters"], re.MULTILINE):
            for given in map(parameters.get, names.split(", ")):
                assert kind.endswith(", optional") is (given.default is not given.empty), given
        assert {"Returns", "Examples"} <= found.keys()
        assert ">>>" in found["Examples"]
    else:
        assert found.keys() & {"Parameters", "Attributes"}
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    for test in doctest.DocTestFinder(exclude_empty=True).find(one, name, globs={}):
        runner.run(test)
    assert runner.summarize(verbose=False).failed == 0
