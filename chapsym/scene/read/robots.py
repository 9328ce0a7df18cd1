"""The ball of a robot's file, URDF, SDF or MJCF, as the table of a scene: its numbers stay the texts that stand there.

In all three formats ixy, ixz, iyz are entries of the tensor of inertia: -∫xy dm, ....
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Any
from xml.parsers import expat

import numpy as np

from chapsym import generated
from chapsym.rationals import NotANumber, rational

from .bodies import unbalanced
from .errors import SceneError

SUFFIXES = (".urdf", ".sdf", ".xml", ".mjcf")
#: A longer file has no ball that anybody wrote.
MOST_BYTES = 10_000_000
#: An offset below this part of the radius is a rounding of who wrote the file.
NO_OFFSET = Fraction(1, 10**9)
#: Digits of what is turned by angles.
DIGITS = 40
ENTRIES = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
Vector = tuple[Fraction, ...]


@dataclass
class Element:
    """One of an XML text, with the line on which it begins."""

    tag: str
    attributes: dict[str, str]
    line: int
    children: list["Element"] = field(default_factory=list)
    text: str = ""

    def all(self, tag: str) -> Iterator["Element"]:
        """Those of that tag, at any depth."""
        for child in self.children:
            if child.tag == tag:
                yield child
            yield from child.all(tag)

    def child(self, tag: str) -> "Element | None":
        """The first child of that tag."""
        return next((child for child in self.children if child.tag == tag), None)


@dataclass
class Pose:
    """A place, and the quaternion of a turn, of any length, scalar first."""

    place: Vector = (Fraction(0),) * 3
    turn: Vector = (Fraction(1), Fraction(0), Fraction(0), Fraction(0))


def table(path: Path) -> dict[str, Any]:
    """[ball] of a scene: name, inertia (rows) or a preset, mass and radius, as texts.

    Raises SceneError, with the line, where the file has no ball, or several; where its centre of mass is not that of
    the sphere; and where a number is missing.
    """
    return _Reader(path).table()


class _Reader:
    def __init__(self, path: Path) -> None:
        self.path = path
        self.root = self._tree()
        self.kind = {"robot": "urdf", "sdf": "sdf", "mujoco": "mjcf"}.get(self.root.tag, "")
        if not self.kind:
            raise self._refused(self.root, f"<{self.root.tag}> is not <robot> (URDF), <sdf> or <mujoco> (MJCF)")

    def _refused(self, where: Element, sentence: str) -> SceneError:
        return SceneError(f"{self.path}, line {where.line}: {sentence}")

    def _tree(self) -> Element:
        """The root; entities, which may grow without bound or read other files, are refused with their declarations."""
        try:
            if self.path.is_fifo() or self.path.stat().st_size > MOST_BYTES:
                raise SceneError(f"{self.path} is a pipe, or has more than {MOST_BYTES} bytes: it is no robot's file")
            content = self.path.read_bytes()
        except OSError as error:
            raise SceneError(f"{self.path} cannot be read: {error.strerror or error}") from None
        open_: list[Element] = [Element("", {}, 0)]
        parser = expat.ParserCreate()

        def start(tag: str, attributes: dict[str, str]) -> None:
            if len(open_) > 100:
                raise self._refused(open_[-1], "its elements are nested too deeply")
            found = Element(tag, attributes, parser.CurrentLineNumber)
            open_[-1].children.append(found)
            open_.append(found)

        def data(text: str) -> None:
            open_[-1].text += text

        def doctype(*_: Any) -> None:
            raise SceneError(f"{self.path}, line {parser.CurrentLineNumber}: a DOCTYPE is not read: take it out")

        parser.StartElementHandler, parser.CharacterDataHandler = start, data
        parser.EndElementHandler = lambda tag: open_.pop()
        parser.StartDoctypeDeclHandler = doctype
        try:
            parser.Parse(content, True)
        except expat.ExpatError as error:
            where = f"{self.path}, line {error.lineno}"
            raise SceneError(f"{where}: this is not XML: {expat.ErrorString(error.code)}") from None
        return open_[0].children[0]

    def table(self) -> dict[str, Any]:
        """The one body that has a sphere."""
        tag = "body" if self.kind == "mjcf" else "link"
        found = [(body, sphere) for body in self.root.all(tag) if (sphere := self._sphere(body)) is not None]
        if len(found) != 1:
            names = ", ".join(body.attributes.get("name", "without a name") for body, _ in found)
            told = f"has {len(found)} with one ({names})" if found else "has none"
            raise SceneError(f"{self.path}: the ball is the <{tag}> with a sphere to roll on, and this file {told}")
        ((body, (radius, centre)),) = found
        name = {"name": body.attributes["name"]} if body.attributes.get("name") else {}
        inertial = body.child("inertial")
        if inertial is None:
            return name | self._of_one_material(body) | {"radius": radius}
        pose = self._pose(inertial)
        offset = [a - b for a, b in zip(pose.place, centre, strict=True)]
        rho = self._number(radius, inertial)
        if max(map(abs, offset)) > NO_OFFSET * rho:
            length = float(sum(x * x for x in offset)) ** 0.5
            what = unbalanced("the centre of mass of <inertial>", length, float(rho))
            raise self._refused(inertial, what)
        mass = self._value(inertial, "mass", "value")
        return name | {"inertia": self._tensor(inertial, pose), "mass": mass, "radius": radius}

    def _of_one_material(self, body: Element) -> dict[str, Any]:
        """MJCF makes the inertia of a geom of its mass; the other formats have none without <inertial>."""
        geoms = [one for one in body.children if one.tag == "geom"]
        if len(geoms) == 1 and "mass" in geoms[0].attributes:
            return {"preset": "homogeneous", "mass": geoms[0].attributes["mass"]}
        raise self._refused(body, "the ball has no <inertial> with its mass and inertia")

    def _sphere(self, body: Element) -> tuple[str, Vector] | None:
        """The radius of the sphere on which it rolls, and its centre."""
        if self.kind == "mjcf":
            geoms = [one for one in body.children if one.tag == "geom"]
            for one in geoms:
                size = one.attributes.get("size", "").split()
                if one.attributes.get("type", "sphere") == "sphere" and size:
                    return size[0], self._pose(one).place
            return None
        for tag in ("collision", "visual"):
            for shape in (one for one in body.children if one.tag == tag):
                sphere = next(shape.all("sphere"), None)
                if sphere is not None:
                    return self._value(sphere, "radius"), self._pose(shape).place
        return None

    def _value(self, parent: Element, name: str, attribute: str | None = None) -> str:
        """A number of an element: the text of a child, an attribute, or that of a child."""
        child = parent.child(name)
        found = parent.attributes.get(name)
        if child is not None:
            found = child.attributes.get(attribute or "", child.text).strip()
        if not found:
            raise self._refused(parent, f"<{parent.tag}> has no {name}")
        return found

    def _number(self, text: str, where: Element) -> Fraction:
        try:
            return rational(text, f"<{where.tag}>")
        except NotANumber as error:
            raise self._refused(where, str(error)) from None

    def _numbers(self, text: str, where: Element, count: int) -> Vector:
        parts = text.split()
        if len(parts) != count:
            raise self._refused(where, f"<{where.tag}> must have {count} numbers, not {text.strip()!r}")
        return tuple(self._number(part, where) for part in parts)

    def _pose(self, parent: Element) -> Pose:
        """Where an element says that it is, in its body."""
        if self.kind == "mjcf":
            if wrong := [name for name in ("euler", "axisangle", "xyaxes", "zaxis") if name in parent.attributes]:
                raise self._refused(parent, f"<{parent.tag}> is turned by {wrong[0]}: write quat, or leave it out")
            place, turn = parent.attributes.get("pos", "0 0 0"), parent.attributes.get("quat", "1 0 0 0")
            return Pose(self._numbers(place, parent, 3), self._numbers(turn, parent, 4))
        where = parent.child("origin" if self.kind == "urdf" else "pose")
        if where is None:
            return Pose()
        if self.kind == "urdf":
            place, turn = where.attributes.get("xyz", "0 0 0"), where.attributes.get("rpy", "0 0 0")
            return Pose(self._numbers(place, where, 3), _turned(self._numbers(turn, where, 3)))
        if {"relative_to", "rotation_format", "degrees"} & set(where.attributes):
            raise self._refused(where, "a <pose> with attributes is not read: write x y z roll pitch yaw, in radians")
        numbers = self._numbers(where.text, where, 6)
        return Pose(numbers[:3], _turned(numbers[3:]))

    def _tensor(self, inertial: Element, pose: Pose) -> list[list[str]]:
        """The rows in the axes of the body: R I Rᵀ of the one in the axes of <inertial>."""
        if self.kind == "mjcf":
            texts = self._of_mjcf(inertial)
        else:
            inertia = inertial.child("inertia")
            if inertia is None:
                raise self._refused(inertial, "<inertial> has no <inertia>")
            beside = {"ixy": "0", "ixz": "0", "iyz": "0"} if self.kind == "sdf" else {}
            absent = {name for name in beside if inertia.child(name) is None}
            texts = {name: beside[name] if name in absent else self._value(inertia, name) for name in ENTRIES}
            for name, text in texts.items():
                self._number(text, inertia.child(name) or inertia)
        rows = [[texts["".join(["i", *sorted((a, b))])] for b in "xyz"] for a in "xyz"]
        if not any(pose.turn[1:]):
            return rows
        tensor = [[self._number(text, inertial) for text in row] for row in rows]
        length = sum(x * x for x in pose.turn)
        if not length:
            raise self._refused(inertial, "the quaternion of <inertial> is 0")
        back = [x / length for x in (pose.turn[0], *(-x for x in pose.turn[1:]))]
        columns = []
        for axis in np.eye(4, dtype=int).tolist()[1:]:
            along = generated.compose(*[*pose.turn, *axis])
            columns.append(generated.compose(*[*along, *back])[1:])
        turn = np.array(columns, dtype=object).T
        return [[_text(x) for x in row] for row in turn @ np.array(tensor, dtype=object) @ turn.T]

    def _of_mjcf(self, inertial: Element) -> dict[str, str]:
        """xx yy zz xy xz yz, or xx yy zz."""
        names = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
        for key, count in (("fullinertia", 6), ("diaginertia", 3)):
            if key in inertial.attributes:
                self._numbers(inertial.attributes[key], inertial, count)
                return dict.fromkeys(names, "0") | dict(zip(names, inertial.attributes[key].split(), strict=False))
        raise self._refused(inertial, "<inertial> has no diaginertia or fullinertia")


def _text(x: Fraction) -> str:
    """Exactly, where that is short; else many digits."""
    import mpmath

    short = str(x)
    if len(short) <= DIGITS:
        return short
    with mpmath.workdps(2 * DIGITS):
        return str(mpmath.nstr(mpmath.mpf(x.numerator) / x.denominator, DIGITS))


def _turned(angles: Vector) -> Vector:
    """Rz(yaw) Ry(pitch) Rx(roll), in many digits."""
    if not any(angles):
        return Pose().turn
    import mpmath

    with mpmath.workdps(2 * DIGITS):
        halves = [mpmath.mpf(x.numerator) / x.denominator / 2 for x in angles]
        roll, pitch, yaw = ((mpmath.cos(x), mpmath.sin(x)) for x in halves)
        about_y = generated.compose(pitch[0], 0, pitch[1], 0, roll[0], roll[1], 0, 0)
        found = generated.compose(yaw[0], 0, 0, yaw[1], *about_y)
        return tuple(Fraction(mpmath.nstr(x, DIGITS + 10)) for x in found)
