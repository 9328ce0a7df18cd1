"""The loops, compiled by numba: the same functions that run in plain Python.

The compiled code is cached on disk (`code_cache`) in a folder named by a hash of every source that it is made of, so
that all clones and installations of the same text share it.
"""

import hashlib
import inspect
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

import numba
from numba.extending import register_jitable

import chapsym.generated as generated
import chapsym.generated.double_double as generated_double_double
from chapsym.numbers import fused, pairs

from ..loops import (
    block,
    branch,
    composed_block,
    composed_loop,
    double_double_block,
    double_double_loop,
    double_double_step,
    gibbs,
    integrals,
    lanes,
    long_run,
    long_step,
    loop,
    loop_n,
    path,
    rotation_n,
    single_loop,
    single_step,
    sums,
    vertical_loop,
)
from .code_cache import folder_for, keep
from .retyped import Family

#: What the compiled code is made of.
SOURCES = (
    *(
        generated,
        branch,
        gibbs,
        path,
        integrals,
        sums,
        loop,
        block,
        composed_loop,
        composed_block,
        vertical_loop,
        long_step,
        lanes,
        long_run,
    ),
    *(single_loop, single_step, rotation_n, loop_n),
    *(pairs, generated_double_double, double_double_step, double_double_loop, double_double_block),
)
#: The functions on the way of every step: a call would cost more than they do.
INLINED: set[Callable[..., Any]] = {
    *(generated.gibbs_newton, generated.gibbs_second, generated.turn),
    *(path.small_between, path.lowest, path.joined, path.improved, path.proved, generated.gibbs_symmetric),
    *(gibbs.newton_round, gibbs.second_round, gibbs.settle, loop.three, loop.put),
    *(sums.added, sums.turned, sums.filtered, composed_loop.guess, composed_loop.turn_at),
    *(block.rows, block.whole, block.predicted, block.corrected, block.unsettled),
    *(block.approached, block.nearer, block.on_path),
    *(block.moved, block.turn_at, block.extrapolated, block.rolled, loop.followed),
    *(generated.centre_step, generated.rotate),
    *(value for value in vars(pairs).values() if isinstance(value, FunctionType)),
    *(generated.gibbs_mixed, generated_double_double.gibbs_residual_pairs, generated_double_double.turn_pairs),
    *(double_double_step.correction, double_double_step.small, double_double_loop.extrapolated),
    *(
        double_double_block.approached,
        double_double_block.residuals,
        double_double_block.corrected,
        double_double_block.turned,
    ),
    *(generated.compose, generated.angular_velocity, long_step.moved_body, lanes.checked, lanes.moved),
    *(lanes.rates, lanes.start, lanes.begin, lanes.begin_second, lanes.finish, lanes.gather, lanes.side_by_side),
    *(lanes.lose, long_run.march_lanes),
}

#: The functions whose text is put in the place of a call: what the caller knows of its arrays, that no two overlap,
#: holds for their loops, too.
WRITTEN_IN: set[Callable[..., Any]] = {
    *(block.solved, composed_block.guess_block, composed_block.begin_stage, composed_block.end_stage),
}


def _functions(module: ModuleType) -> Iterator[FunctionType]:
    for value in vars(module).values():
        if isinstance(value, FunctionType):
            yield value


@cache
def source_hash() -> str:
    """A hash of the kernels, of the solver, of the loops, of how they are compiled, and of numba's version."""
    digest = hashlib.sha256(numba.__version__.encode())
    twins = (str(Path(__file__).with_name(name)) for name in ("retyped.py", "single.py"))
    sources = (f.__code__.co_filename for module in SOURCES for f in _functions(module))
    files = {__file__, fused.__file__, *twins, *sources}
    for text in sorted(hashlib.sha256(Path(name).read_bytes()).digest() for name in files):  # wherever they lie
        digest.update(text)
    return digest.hexdigest()[:16]


def _is_one_of(function: FunctionType, some: set[Callable[..., Any]]) -> bool:
    """Whether it is one of some functions, or the twin of one."""
    return (function.__code__.co_filename, function.__name__) in _names(frozenset(some))


@cache
def _names(some: frozenset[Callable[..., Any]]) -> set[tuple[str, str]]:
    return {(function.__code__.co_filename, function.__name__) for function in some}


@cache
def _registered(modules: tuple[ModuleType, ...]) -> None:
    fused.register()
    seen = {pairs.two_product}
    for module in modules:
        for function in _functions(module):
            if function.__module__.startswith("chapsym.") and function not in seen:
                seen.add(function)
                # Nobody calls it but compiled code: it needs no way in from C, which takes time to compile.
                register_jitable(
                    error_model="numpy", no_cfunc_wrapper=True, forceinline=_is_one_of(function, INLINED),
                    inline="always" if _is_one_of(function, WRITTEN_IN) else "never",
                )(function)  # fmt: skip


@cache
def compiled(function: Callable[..., Any]) -> Callable[..., Any]:
    """The compiled version of a function of one of the `SOURCES`, or of a twin of one (`retyped`).

    It is compiled when it is first called.
    """
    family: Family | None = function.__globals__.get("family")
    _registered(SOURCES)
    if family:
        _registered(tuple(family.twins.values()))
    ready = numba.njit(error_model="numpy", nogil=True)(function)
    keep(ready, folder_for(source_hash()), _name(function), Path(inspect.getfile(function)).read_bytes())
    return ready


@cache
def is_kept(function: Callable[..., Any]) -> bool:
    """Whether code of a function is on disk, for some processor: it need not be compiled then."""
    return any(folder_for(source_hash()).glob(f"{_name(function)}-*.code"))


def _name(function: Callable[..., Any]) -> str:
    family: Family | None = function.__globals__.get("family")
    return ".".join((*((family.name,) if family else ()), Path(inspect.getfile(function)).stem, function.__name__))
