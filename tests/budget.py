"""How many examples of a property are tried: the same in every run but a thorough one."""

from hypothesis import settings

#: Of a property that says nothing else, and how many times that in a thorough run.
EXAMPLES, THOROUGH = 40, 15


def examples(count):
    """So many of this property, which is slower than others, or needs more."""
    return settings(max_examples=count * settings.default.max_examples // EXAMPLES)
