"""The browser that opens the pages; without one their tests are skipped, and one line at the end of the run says so."""

import shutil

import pytest
from waiting import GUARD

PATH = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
MISSING = "no Chromium; apt install chromium"
#: For playwright, which counts in milliseconds.
PATIENCE = 1000 * GUARD


def path():
    """The browser; skips the test if there is none."""
    if PATH is None:
        pytest.skip(MISSING)
    return PATH


def left_out(skipped):
    """The line about the tests that were skipped for want of a browser, from the reports of all that were skipped."""
    count = sum(MISSING in str(report.longrepr) for report in skipped)
    return f"{count} page test{'s' * (count != 1)} not run: {MISSING}" if count else ""
