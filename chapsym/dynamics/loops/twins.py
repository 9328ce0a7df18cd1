"""A module of the loops for another number type: the same code, with converted constants."""

from collections.abc import Callable
from functools import cache
from importlib import import_module
from math import ldexp, sqrt
from types import FunctionType, ModuleType
from typing import Any

import numpy as np

#: The modules of the float32 loops, each after those that it imports from.
MODULES = ("chapsym.numbers.pairs", "vectors", "integrals", "gibbs", "path", "single_loop", "loop")


def twin(module: ModuleType, number: Callable[[float], Any], **instead: Any) -> dict[str, Any]:
    """The names of a module, with each float, also in its functions, converted by `number`; `instead`: substitutes."""
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
    found: Callable[..., Any] = _single()[function.__module__][function.__name__]
    return found


@cache
def _single() -> dict[str, dict[str, Any]]:
    """The names of each module in float32, by module name."""
    made: dict[str, dict[str, Any]] = {}
    numbers: dict[str, Any] = {}
    for path in MODULES:
        module = import_module(path if "." in path else f"{__package__}.{path}")
        other: dict[str, Any] = getattr(module, "SINGLE", {})
        numbers |= {name: np.float32(x) for name, x in other.items() if isinstance(x, float)}
        known = vars(module) | {name: x for name, x in other.items() if isinstance(x, FunctionType)}
        functions = {name: x for name, x in known.items() if isinstance(x, FunctionType) and x.__module__ in made}
        here = {name: made[x.__module__][x.__name__] for name, x in functions.items()}
        here |= {name: numbers[name] for name in numbers.keys() & vars(module).keys()}
        if path != "single_loop":  # single_loop uses float64 explicitly
            here |= {name: x for name, x in (("sqrt", _root), ("ldexp", _scaled)) if name in vars(module)}
        made[module.__name__] = twin(module, np.float32, **here)
    return made


def _root(x: Any) -> Any:
    return np.float32(sqrt(x))


def _scaled(x: Any, exponent: int) -> Any:
    return np.float32(ldexp(x, exponent))
