"""Loaded by Dask workers and used by tests: small units, each of which takes its time (CHAPSYM_TEST_SLEEP)."""

import os
import time

from chapsym.scene.plan import plan
from chapsym.scene.plan.models import Rolling
from chapsym.scene.running import sweep

plan.CHUNK = 4
Rolling.unit_steps = 4 * 100  # ten frames


def _slower(real):
    def slow(*args, **kwargs):
        time.sleep(float(os.environ.get("CHAPSYM_TEST_SLEEP", "0")))
        return real(*args, **kwargs)

    return slow


if sweep.advance.__name__ != "slow":  # Dask loads it twice
    sweep.advance = _slower(sweep.advance)
if "CHAPSYM_TEST_VERSION" in os.environ:
    import chapsym

    chapsym.__version__ = os.environ["CHAPSYM_TEST_VERSION"]
