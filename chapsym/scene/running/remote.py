"""A unit of a run on a worker of a cluster, which computes and writes it; the process that began keeps the marks.

A worker is sent the text of the scene and the numbers of a unit, and makes the plan of it again.
"""

from functools import lru_cache
from pathlib import Path
from typing import Any

import chapsym

from ..plan.models import State
from ..read.errors import SceneError
from ..result.dataset import provenance
from .segments import NoAnswer, computed
from .source import plan_from
from .store import check_same, difference, write_region

_plan = lru_cache(maxsize=4)(plan_from)


def unit(text: str, about: dict[str, Any], path: str, chunk: int, segment: int, state: State | None) -> State:
    """Computes and writes one unit; the state after it.

    text, about: the scene and the provenance of its plan, which the worker's must equal.
    Raises NoAnswer, which is of these balls only; or SceneError, of the disk, the store or the worker.
    """
    try:
        return _unit(text, about, Path(path), chunk, segment, state)
    except (NoAnswer, SceneError) as error:
        raise type(error)(str(error)) from None
    except Exception as error:  # of any kind: not all can be sent
        raise NoAnswer(f"{type(error).__name__} on a worker: {error}") from None


def _unit(text: str, about: dict[str, Any], path: Path, chunk: int, segment: int, state: State | None) -> State:
    plan = _plan(text)
    told = difference(provenance(plan), about)
    if told is not None:
        version = f"chapsym {chapsym.__version__}, and {about['chapsym_version']} here"
        raise SceneError(f"what a worker of the cluster would compute {told} ({version}): give all the same chapsym")
    columns, after = computed(plan, chunk, segment, state)
    check_same(path, plan)  # this worker may be late, and the store by now another's
    write_region(path, plan, chunk, segment, columns)
    return after
