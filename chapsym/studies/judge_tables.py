"""The trajectory of an engine or a tracker: a table of text with a row for each time, in m, s and rad, z up."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np

from chapsym import files
from chapsym.dynamics.errors import BadInput

NEEDED = ("time", "x", "y", "z", "qw", "qx", "qy", "qz")
MORE = ("vx", "vy", "vz", "wx", "wy", "wz")
#: The columns that a judgement needs; an attitude is optional.
JUDGED = NEEDED[:4]
#: The columns of a table without names: the TUM format of trackers.
TUM = ("time", "x", "y", "z", "qx", "qy", "qz", "qw")
LARGEST = 1e100
#: Times are equal if they differ by less than this fraction of the last time.
SAME_TIME = 1e-9
#: The names of parts in engines, before the component, in lower case; "angular velocity" is before "velocity".
CALLED = {
    "w": r"w|omega|ang ?vel|angular|angular velocity",
    "": r"p|pos|position|translation|com|cent(?:er|re)",
    "q": r"q|quat|quaternion|ori|orientation|rot|rotation|attitude",
    "v": r"v|vel|velocity|lin ?vel|linear|linear velocity",
}
#: Parts with numbered components: the free joint of MuJoCo, Euler parameters, and the messages of PX4.
INDEXED = {
    "qpos": NEEDED[1:], "qvel": MORE, "e": NEEDED[4:],
    "q": NEEDED[4:], "position": NEEDED[1:4], "velocity": MORE[:3], "angular_velocity": MORE[3:],
}  # fmt: skip
_INDEX = re.compile(rf"(?:.*\W)?({'|'.join(INDEXED)})[\W_]?(\d)\W?")
_TIME = re.compile(
    r"t|time|(?:.* )?(?:time)?stamp|(?:sim|frame|elapsed|world) time|"
    r"(?:time(?:stamp)? |t )?(?:[mnuµμ]?s|n?sec(?:onds)?)"
)
#: A time whose name has a unit below a second.
_PART = re.compile(r".*(?:\b|_)(milli|micro|nano|[mnuµμ])s(?:ec(?:ond)?s?)?\W*")
#: A name that ends in the unit of a length, a speed, or an angular velocity, in words.
_UNIT = re.compile(r"(.*\S) (mm|cm|m|rad|deg|degrees|dps)(?: ?p?s(?: 1)?)?")
#: The decimal shift of a number in such a unit, and the units in degrees.
MOVED, DEGREES = {"mm": 3, "cm": 2}, ("deg", "degrees", "dps")
_ANGLES = re.compile(r"(?:.* )?(?:roll|pitch|yaw|rpy|euler)(?: .*)?")
_LONG = re.compile(r"[eE][+-]?\d{4}")
#: The decimal shift of such a time.  EuRoC and others have ns.
PARTS = {"milli": 3, "m": 3, "micro": 6, "u": 6, "µ": 6, "μ": 6, "nano": 9, "n": 9}
#: Separators of cells; spaces if a line has none of them.  With the first two, a comma is the decimal point.
MARKS = "\t;,"


@dataclass(frozen=True, eq=False)
class Trajectory:
    """The rows of a file at the frames of a case.

    centre in m, (frames, 3).  attitude: unit quaternions, (frames, 4), or None.  velocity of the centre in m/s and
    omega in rad/s, in space, (frames, 3), or None.  step: that of the engine in s, from a line "# time_step = 0.001",
    or None.  digit: a unit of the last digit of each of them in the first row, by name.
    """

    file: str
    centre: np.ndarray
    attitude: np.ndarray | None
    velocity: np.ndarray | None
    omega: np.ndarray | None
    step: float | None
    digit: Mapping[str, float] | None = None


@dataclass(frozen=True, eq=False)
class Table:
    """The columns of a file by the names of `NEEDED` and `MORE`, the texts of the times, and the digits as above."""

    file: Path
    columns: Mapping[str, np.ndarray]
    times: Sequence[str]
    step: float | None
    digit: Mapping[str, float]

    def from_zero(self) -> "Table":
        """The table with times since the first row, and these times exactly."""
        exact = self.exact_times()
        return replace(self, columns={**self.columns, "time": np.array([float(at) for at in exact])})

    def exact_times(self) -> list[Fraction]:
        """The times since the first row, as written."""
        found = [Fraction(text) for text in self.times]
        return [at - found[0] for at in found]

    def at(self, times: np.ndarray) -> Trajectory:
        """The rows at `times`; other rows are omitted.  Raises BadInput, one sentence, if a time has no row."""
        at = _places(self.file, self.columns["time"], times)
        part = replace(self, columns={name: column[at] for name, column in self.columns.items()})
        centre, velocity, omega = (part.vectors(names) for names in (NEEDED[1:4], MORE[:3], MORE[3:]))
        assert centre is not None
        attitude = None if part.vectors(NEEDED[4:]) is None else part.attitudes()
        return Trajectory(files.visible(str(self.file)), centre, attitude, velocity, omega, self.step, self.digit)

    def vectors(self, names: Sequence[str]) -> np.ndarray | None:
        """Several columns together, (rows, names); None if one is missing."""
        there = set(names) <= self.columns.keys()
        return np.stack([self.columns[name] for name in names], axis=-1) if there else None

    def attitudes(self) -> np.ndarray:
        """The quaternions, divided by their lengths; raises BadInput if one does not have the length 1."""
        attitude = self.vectors(NEEDED[4:])
        assert attitude is not None
        length = np.linalg.norm(attitude, axis=-1, keepdims=True)
        if not (abs(length - 1) < 1e-3).all():
            worst = np.abs(length - 1).argmax()
            clause = f"the quaternion at {self.columns['time'][worst]:g} s has the length {length[worst, 0]:.6g}, not 1"
            raise BadInput(f"{self.file}: {clause}")
        return np.asarray(attitude / length)


def read_trajectory(file: Path, times: np.ndarray) -> Trajectory:
    """The rows of a file at `times`, as `Table.at`."""
    return read_table(file).at(times)


def read_table(file: Path, needed: Sequence[str] = NEEDED) -> Table:
    """A file with commas, semicolons, tabs or spaces; raises BadInput, one sentence, if it is no trajectory.

    needed: the required columns.
    """
    try:
        lines = files.text_of(file).splitlines()
    except files.CannotRead as error:
        raise BadInput(str(error)) from None
    rows = [line for line in lines if line.strip() and not line.startswith("#")]
    if len(rows) > 1 and np.isnan([*map(_number, _cells(rows[1]))]).all():  # after a title
        rows = rows[1:]
    rows = [*_commented(lines, rows), *rows]
    head = _cells(rows[0]) if rows else []
    names = _names(head)
    if rows and len(names) == len(TUM) and not np.isnan([*map(_number, head)]).any():
        names, head, rows = list(TUM), list(TUM), ["", *rows]
    whole = {*needed, *NEEDED[4:]} if {*NEEDED[4:]} & {*names} else needed  # four numbers of a quaternion, or none
    missing = [name for name in NEEDED if name in whole and name not in names]
    angles = [cell for cell in head if _ANGLES.fullmatch(_words(cell)[0])]
    if angles and "qw" not in names and "z" in needed and missing[:1] in ([], ["qw"]):  # not needed by a drawing
        clause = f"has the columns {', '.join(angles[:3])}, angles whose order has many conventions"
        raise BadInput(f"{file} {clause}: write the attitude as a quaternion, qw,qx,qy,qz")
    if missing:
        raise BadInput(f"{file} has no column {missing[0]}: its first row must name {','.join((*NEEDED, *MORE))}")
    where = {name: i for i, name in enumerate(names) if name in (*NEEDED, *MORE)}
    if twice := [name for name in where if names.count(name) > 1]:
        raise BadInput(f"{file} has the column {twice[0]} twice")
    texts = [_texts(file, i, _cells(line, _mark(rows[0])), names, where) for i, line in enumerate(rows[1:], 1)]
    units = {name: _words(head[at])[1] for name, at in where.items()}
    for name, unit in units.items():
        if power := _power(head[where[name]]) if name == "time" else MOVED.get(unit, 0):
            for row in texts:
                row[name] = str(Decimal(row[name]).scaleb(-power))
    parts = {"centre": NEEDED[1:4], "attitude": NEEDED[4:], "velocity": MORE[:3], "omega": MORE[3:]}
    digit = {part: _digit([[row[x] for x in some if x in where] for row in texts]) for part, some in parts.items()}
    columns = {name: np.array([float(row[name]) for row in texts]) for name in where}
    if in_degrees := [name for name in MORE[3:] if units.get(name) in DEGREES]:
        columns |= {name: np.radians(columns[name]) for name in in_degrees}
        digit["omega"] = float(np.radians(digit["omega"]))
    return Table(file, columns, [row["time"] for row in texts], _step(file, lines), digit)


def _texts(file: Path, i: int, cells: Sequence[str], names: Sequence[str], where: Mapping[str, int]) -> dict[str, str]:
    """The numbers of row i in the known columns, as texts; other columns may have anything."""
    if len(cells) != len(names):
        raise BadInput(f"{file}: row {i} has {len(cells)} cells, and the row of names {len(names)}")
    for name, at in where.items():
        if not abs(_number(cells[at])) < LARGEST:
            raise BadInput(f"{file}: row {i}: {name} must be a number below {LARGEST:g}, not {cells[at]!r:.40}")
    return {name: cells[at] for name, at in where.items()}


def _commented(lines: Sequence[str], rows: Sequence[str]) -> list[str]:
    """The line of names in a comment above the numbers."""
    if not rows or np.isnan([*map(_number, _cells(rows[0]))]).any():
        return []
    above = [line.lstrip("# ") for line in lines[: lines.index(rows[0])] if line.startswith("#")]
    width = len(_cells(rows[0]))
    return [line for line in above[-1:] if len(_cells(line)) == width and "time" in map(_name, _cells(line))]


def _mark(line: str, first: str = "") -> str:
    return next((mark for mark in (first, *MARKS) if mark and mark in line), "")


def _cells(line: str, first: str = "") -> list[str]:
    """The cells, without their quotes; `first` is the separator, if the line has it."""
    mark = _mark(line, first)
    parts = line.split(mark) if mark else line.split()
    decimal = "," if mark == "," else "."
    return [part.strip().strip('"').strip().replace(",", decimal) for part in parts]


def _number(text: str) -> float:
    """The number; NaN for a text that is no number, or has an exponent beyond float64."""
    try:
        return np.nan if _LONG.search(text) else float(text)
    except ValueError:
        return np.nan


def _power(head: str) -> int:
    """The decimal shift of a time to seconds; `rostopic echo -p` writes %time in ns."""
    found = _PART.fullmatch(head.lower())
    return PARTS[found[1]] if found else 9 * (head.lower() == "%time")


def _names(cells: Sequence[str]) -> list[str]:
    """The names of columns: of several for one part, that with the exact name is taken, and the first time.

    tx, ty, tz are the position, as in TUM, if there is no other; otherwise they are a torque.
    """
    names = [_name(cell) for cell in cells]
    for name in (*NEEDED, *MORE):
        several = [i for i, found in enumerate(names) if found == name]
        meant = [i for i in several if cells[i].lower() == name] or several[: 1 if name == "time" else None]
        for i in set(several).difference(meant):
            names[i] = cells[i]
    place = {} if "x" in names else {"tx": "x", "ty": "y", "tz": "z"}
    return [place.get(name.lower(), name) for name in names]


def _name(own: str) -> str:
    """The name of a column here; its own name if no engine uses it."""
    if (indexed := _INDEX.fullmatch(own.lower())) and int(indexed[2]) < len(INDEXED[indexed[1]]):
        return INDEXED[indexed[1]][int(indexed[2])]
    words, _ = _words(own)
    words = re.sub(r" rs( r)?\b| w(?= [wxyz]$)", "", words)  # the frames of EuRoC, and the world of Isaac Lab
    if words in (*NEEDED, *MORE) or _TIME.fullmatch(words):
        return words if words in (*NEEDED, *MORE) else "time"
    if rate := re.fullmatch(r"([xyz]) (?:dt|dot)", words):
        return "v" + rate[1]
    for short, called in CALLED.items():
        if found := re.fullmatch(rf"(?:.* )?(?:{called}) ?([{'w' if short == 'q' else ''}xyz])", words):
            return short + found[1]
    return own


def _words(own: str) -> tuple[str, str]:
    """The words of the name of a column, in lower case, without brackets and unit, and its unit."""

    def plain(text: str) -> str:
        return re.sub(r"[\W_]+", " ", re.sub(r"(?<=[a-z])(?=[A-Z])", " ", text)).strip().lower()

    if found := _UNIT.fullmatch(plain(own)):
        return found[1], found[2]
    return plain(re.sub(r"\[[^\]]*\]|\([^)]*\)", "", own)), ""


def _digit(rows: Sequence[Sequence[str]]) -> float:
    """The possible rounding of the first row, by the decimal places or digits that all rows have.

    One number does not show it: tables with all digits, too, have a height of 0.1 or a column of 0.0.
    """
    if not (texts := [text.lower().partition("e") for row in rows for text in row]):
        return 0.0
    unit = min(10.0 ** (int(power or 0) - len(mantissa.partition(".")[2])) for mantissa, _, power in texts)
    digits = max(len(mantissa.lstrip("+-0.").replace(".", "")) for mantissa, _, _ in texts)
    return max(unit, 10.0 ** (1 - digits) * max(abs(_number(text)) for text in rows[0]))


def _places(file: Path, given: np.ndarray, times: np.ndarray) -> np.ndarray:
    """The row of each time, without interpolation."""
    if not given.size:
        raise BadInput(f"{file} has no rows")
    near = SAME_TIME * max(times[-1], 1.0)
    at = np.array([np.abs(given - time).argmin() for time in times])
    off = np.abs(given[at] - times) > near
    if off.all():
        begins = f"its times begin at {given[0]:.10g} s, and those of the case at {times[0]:g} s"
        raise BadInput(f"{file} has no row at {times[0]:g} s: {begins}")
    if off.any():
        every = f"every {times[1] - times[0]:g} s to {times[-1]:g} s"
        raise BadInput(f"{file} has no row at {times[off][0]:g} s: it must have one at each time of the case, {every}")
    several = np.array([(np.abs(given - time) <= near).sum() > 1 for time in times])
    if several.any():
        raise BadInput(f"{file} has two rows at {times[several][0]:g} s")
    return at


def _step(file: Path, lines: list[str]) -> float | None:
    for line in lines:
        if found := re.fullmatch(r"#\s*time_step\s*=\s*(\S+)\s*", line):
            step = _number(found[1])
            if not 0 < step < np.inf:
                raise BadInput(f"{file}: time_step must be a positive number of seconds, not {found[1]}")
            return step
    return None


def in_space(attitude: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """Vectors in body axes, (..., 3), converted to space by unit quaternions, (..., 4)."""
    from chapsym import generated

    rows = np.stack(np.broadcast_arrays(*generated.rotation(*np.moveaxis(attitude, -1, 0))), axis=-1)
    return np.einsum("...ij,...j->...i", rows.reshape(*attitude.shape[:-1], 3, 3), vector)
