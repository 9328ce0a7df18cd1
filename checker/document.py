"""The file: reading, the digest, and the forms of numbers: decimals and fractions with no spaces, no sign but -."""

import hashlib
import json
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

from .interval import Interval, Rejected

#: An object of JSON; the form of its kind says of what types its values are.
Data = Mapping[str, Any]
FORMAT = "chapsym-certificate/1"
#: The most digits and steps of a certificate, for an acceptable running time.
MOST_DIGITS, MOST_STEPS = 2_000, 1_000
DIGITS, STEPS = range(1, MOST_DIGITS + 1), range(1, MOST_STEPS + 1)
#: The most steps · (bits + LEAST_BITS)² of a certificate: some minutes; LEAST_BITS models the fixed cost of a step.
MOST_WORK, LEAST_BITS = 20_000_000_000, 1_000
#: The most bytes of a file.
MOST_BYTES = 8_000_000
_EXACT = re.compile(r"-?\d+(/\d+|(\.\d+)?(e-?\d{1,3})?)", re.ASCII)
_DECIMAL = re.compile(r"-?(0|[1-9]\d*)\.\d+", re.ASCII)


def file_name(claim: str) -> str:
    """The file name of a claim: _ after each capital and each _, so that no two names differ in case alone."""
    return re.sub("([A-Z_])", r"\1_", claim) + ".json"


class Unreadable(Exception):
    """The file has no JSON object; the message gives the reason in one sentence."""


def read(path: str | Path) -> Data:
    """The object of a JSON file; raises Unreadable, or Rejected if an object has a name twice."""
    try:
        if Path(os.path.realpath(path)).is_fifo():  # a read of a named pipe would block; `<(...)` has no name
            raise Unreadable(f"{path} is a pipe, not a file")
        with Path(path).open("rb") as file:
            content = file.read(MOST_BYTES + 1)
        if len(content) > MOST_BYTES:
            raise Unreadable(f"{path} has more than {MOST_BYTES} bytes")
        data = json.loads(content.decode("utf-8"), object_pairs_hook=_once)
    except OSError as error:
        raise Unreadable(f"{path} cannot be read: {error.strerror or error}") from None
    except (ValueError, RecursionError):  # not UTF-8, not JSON, a number with too many digits, or too deep
        raise Unreadable(f"{path} is not a JSON file") from None
    if not isinstance(data, dict):
        raise Unreadable(f"{path} does not contain a JSON object")
    return data


def _once(pairs: list[tuple[str, object]]) -> Data:
    data = dict(pairs)
    if len(data) < len(pairs):
        raise Rejected("a name stands twice in one object")
    return data


def digest(data: Data) -> str:
    """The SHA-256 of the object without "digest", as JSON with sorted names, without spaces, in ASCII."""
    rest = {name: value for name, value in data.items() if name != "digest"}
    return hashlib.sha256(json.dumps(rest, sort_keys=True, separators=(",", ":")).encode("ascii")).hexdigest()


def check_names(data: object, names: Iterable[str], where: str) -> None:
    """Raises Rejected unless `data` is an object with exactly these names."""
    if not isinstance(data, dict):
        raise Rejected(f"{where} must be an object with the names {', '.join(names)}")
    if other := sorted(set(data) ^ set(names)):
        raise Rejected(
            f"{where} {'has' if other[0] in data else 'lacks'} {other[0]!a:.60}, not exactly the names of its form"
        )


def count(value: object, least: int, most: int, where: str) -> int:
    """An integer from `least` to `most`."""
    if type(value) is not int or not least <= value <= most:
        raise Rejected(f"{where} must be an integer from {least} to {most}")
    return value


def exact(text: Any, where: str) -> Fraction:
    """A rational number such as 12/5, -3, 0.25 or 1e-90."""
    fits = isinstance(text, str) and len(text) <= MOST_DIGITS + 10 and _EXACT.fullmatch(text)
    if not fits or (text[0] == "-" and not re.split("[e/]", text)[0].strip("-0.")):
        raise Rejected(f"{where} must be a number in quotes such as 12/5, -3, 0.25 or 1e-90")
    try:
        return Fraction(text)
    except ZeroDivisionError:
        raise Rejected(f"{where} divides by 0") from None


def decimal(text: Any, digits: int, where: str) -> Fraction:
    """A decimal with exactly `digits` digits after the point, in unique form: no leading 0, no -0."""
    fits = isinstance(text, str) and len(text) <= digits + 12 and _DECIMAL.fullmatch(text)
    if not fits or len(text.partition(".")[2]) != digits or (text[0] == "-" and not text.strip("-0.")):
        raise Rejected(f"{where} must be a decimal in quotes with {digits} digits after the point")
    return Fraction(text)


def sized(data: object, size: int, where: str) -> None:
    """Raises Rejected unless this is a list of that length."""
    if not isinstance(data, list) or len(data) != size:
        raise Rejected(f"{where} must be a list of {size}")


def decimals(data: Any, digits: int, where: str) -> list[Fraction]:
    """Three decimals, each with exactly `digits` digits after the point."""
    sized(data, 3, where)
    return [decimal(x, digits, where) for x in data]


def check_rounded(true: Sequence[Interval], given: Sequence[Fraction], digits: int, where: str) -> None:
    """Raises Rejected unless each number of the file is the true number, correctly rounded, for all parameters.

    At most one decimal with this number of digits satisfies this: no digit can be changed.
    """
    for x, number in zip(true, given, strict=True):
        if not x.rounds_to(number, digits):
            raise Rejected(f"{where} is not proved to be rounded correctly to {digits} digits after the point")


def check_work(steps: int, bits: int) -> None:
    """Raises Rejected if this many steps with numbers of this many bits would take too long."""
    if steps * (bits + LEAST_BITS) ** 2 > MOST_WORK:
        raise Rejected("the certificate asks for more work than a reader can wait for: take fewer steps or digits")


def scale(digits: int, steps: int, parameters: Sequence[Fraction]) -> int:
    """The bits of the checker's intervals; too few bits can only lead to a rejection.

    The sum of: the digits in bits; 8 per step, for the widening of intervals; 4 for each power of 2 in the greatest or
    least parameter; 128 for nearly singular matrices and to decide the rounding.
    """
    size = max((abs(x.numerator.bit_length() - x.denominator.bit_length()) for x in parameters if x), default=0)
    return -(-10 * digits // 3) + 8 * steps + 4 * size + 128
