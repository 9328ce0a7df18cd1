"""A module of the loops in other numbers: the same code, with its constants made of them."""

from collections.abc import Callable
from functools import cache
from importlib import import_module
from math import ldexp, sqrt
from types import BuiltinFunctionType, FunctionType, ModuleType
from typing import Any

import numpy as np

#: What the loops of float32 consist of; each after those that it imports from.
MODULES = (
    "chapsym.numbers.pairs",
    "vectors",
    "integrals",
    "gibbs",
    "path",
    "single_loop",
    "loop",
)


def twin(module: ModuleType, number: Callable[[float], Any], **instead: Any) -> dict[str, Any]:
    """The names of a module, with each float, also in its functions, made by `number`; `instead` replaces some."""
    names: dict[str, Any] = {}
    for name, value in vars(module).items():
        if isinstance(value, FunctionType) and value.__module__ == module.__name__:
            code = value.__code__.replace(co_consts=_made(value.__code__.co_consts, number))
            value = FunctionType(code, names, name, value.__defaults__)
        names[name] = number(value) if type(value) is float else value
    names.update(instead)
    return names


def _made(constants: tuple[Any, ...], number: Callable[[float], Any]) -> tuple[Any, ...]:
    return tuple(_made(x, number) if type(x) is tuple else number(x) if type(x) is float else x for x in constants)


def single(function: Callable[..., Any]) -> Callable[..., Any]:
    """A function of the loops in float32."""
    found: Callable[..., Any] = _single()[function.__module__.rpartition(".")[2]][function.__name__]
    return found


@cache
def _single() -> dict[str, dict[str, Any]]:
    """The names of the modules in float32, by module."""
    made: dict[str, dict[str, Any]] = {}
    #: What has been replaced so far, by its name and what it was.
    instead: dict[tuple[str, Any], Any] = {}
    for path in MODULES:
        module = import_module(path if "." in path else f"{__package__}.{path}")
        if path != "single_loop":  # that takes float64 where it says so
            instead |= {("sqrt", sqrt): _root, ("ldexp", ldexp): _scaled}
        for name, other in getattr(module, "SINGLE", {}).items():
            value = np.float32(other) if isinstance(other, float) else instead[other.__name__, other]
            instead[name, vars(module)[name]] = value
        here = {name: instead[name, x] for name, x in vars(module).items() if _is_known(name, x, instead)}
        names = made[path.rpartition(".")[2]] = twin(module, np.float32, **here)
        instead |= {(name, x): names[name] for name, x in vars(module).items() if isinstance(x, FunctionType)}
        for key in (("sqrt", sqrt), ("ldexp", ldexp)):
            instead.pop(key, None)
    return made


def _is_known(name: str, value: Any, instead: dict[tuple[str, Any], Any]) -> bool:
    return isinstance(value, float | FunctionType | BuiltinFunctionType) and (name, value) in instead


def _root(x: Any) -> Any:
    return np.float32(sqrt(x))


def _scaled(x: Any, exponent: int) -> Any:
    return np.float32(ldexp(x, exponent))
