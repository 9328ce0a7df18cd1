"""How many examples of a property are tried: the same in every run but a thorough one."""

import pytest
from hypothesis import settings

#: Of a property that says nothing else, and how many times that in a thorough run.
EXAMPLES, THOROUGH = 40, 15


def slow(*cases):
    """Cases of a table which `--thorough` alone takes: quicker ones see most of what they see."""
    return [pytest.param(*(case if isinstance(case, tuple) else (case,)), marks=pytest.mark.thorough) for case in cases]


def examples(count, thorough=None):
    """So many of this property, which is slower than others, or needs more; in a thorough run as if it were others."""
    times = settings.default.max_examples // EXAMPLES
    return settings(max_examples=count if times == 1 else (thorough or count) * times)
