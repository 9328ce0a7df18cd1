"""Loops that run as where nothing is compiled."""

from contextlib import contextmanager

import pytest

from chapsym.dynamics import native


@contextmanager
def in_plain_python():
    """All loops are Python, and do not say so."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(native, "_tables", dict)
        patch.setattr(native, "_say_once", lambda: None)
        native.loop.cache_clear()
        yield
    native.loop.cache_clear()
