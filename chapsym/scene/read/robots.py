"""The ball of a robot file, URDF, SDF or MJCF, as the table of a scene, with its numbers as the strings of the file.

In all three formats ixy, ixz, iyz are entries of the tensor of inertia: -∫xy dm, ....
"""

import logging
import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import product
from pathlib import Path
from xml.etree.ElementTree import Element, TreeBuilder
from xml.parsers import expat

import numpy as np

from chapsym import files, generated
from chapsym.dynamics.loops.vectors import cross
from chapsym.rationals import NotANumber, rational

from .bodies import unbalanced
from .errors import Data, SceneError

_log = logging.getLogger("chapsym")

SUFFIXES = (".urdf", ".xacro", ".sdf", ".world", ".xml", ".mjcf")
MOST_BYTES = 10_000_000
#: The largest offset, relative to the radius, that counts as a rounding in the file.
NO_OFFSET = Fraction(1, 10**9)
#: The largest accepted number, whose square is within float64.
MOST = 10**150
DEEPEST = 100
DIGITS = 40
#: The values of <compiler> of MJCF that change no number.
PLAIN = {
    "settotalmass": "-1", "boundmass": "0", "boundinertia": "0", "balanceinertia": "false", "coordinate": "local",
    "inertiagrouprange": "0 5",
}  # fmt: skip
#: The default density of a geom of MJCF in kg/m³.
DENSITY = "1000"
#: The children that make a <body> of MJCF more than a frame for its bodies.
MATTER = ("geom", "inertial", "joint", "freejoint")
#: The elements of MJCF and SDF with planes, which rotate with them.
AROUND = ("worldbody", "body", "frame", "world", "model", "link")
#: The effects of a free joint of MJCF on the ball.
OF_JOINTS = ("damping", "frictionloss", "stiffness")
#: Other actions on the ball, which do not change the ball itself.
LEFT_OUT = "which is left out: a ball of chapsym rolls on a level plane under gravity alone"
#: The largest tilt of a level plane: a right angle to 7 digits.
LEVEL = Fraction(1, 10**6)
#: The elements that may contain more shapes.
UNREAD = ("frame", "replicate", "composite", "flexcomp", "attach")
#: The elements that may have a key of a table; the first existing one is used.
SAID_BY = {
    "inertia": ("inertial/inertia", "inertial"), "mass": ("inertial/mass", "inertial", "geom"),
    "radius": ("sphere", "geom"), "preset": ("geom",),
}  # fmt: skip
ENTRIES = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
Vector = tuple[Fraction, ...]
#: A position, and the quaternion of a rotation, of any length, scalar first.
Pose = tuple[Vector, Vector]
NO_TURN = tuple(map(Fraction, (1, 0, 0, 0)))
UP = tuple(map(Fraction, (0, 0, 1)))


def table(path: Path) -> Data:
    """[ball] of a scene: name, inertia (rows) or a preset, mass and radius, as texts.

    Raises SceneError, with the line, if the file has no ball, or several; if its centre of mass is not the centre of
    the sphere; and if a number is missing.
    """
    reader = _Reader(path)
    try:
        return reader.table()
    except SceneError:
        reader.check_filled_in()
        raise


def place(path: Path, key: str) -> str:
    """The file, the line and the element of this key of `table`, if the table can be made."""
    reader = _Reader(path)
    body, _ = reader.ball()
    where = next(one for tag in SAID_BY[key] if (one := body.find(f".//{tag}")) is not None)
    return f"{path}, line {reader.lines[where]}: <{where.tag}>"


def centre(path: Path) -> Vector:
    """The centre of the sphere in the axes and from the origin of its body; raises SceneError as `table` does."""
    return _Reader(path).ball()[1][1]


class _Reader:
    def __init__(self, path: Path) -> None:
        self.path, self.lines = path, dict[Element, int]()
        self.root = self._tree()
        self.kind = {"robot": "urdf", "sdf": "sdf", "mujoco": "mjcf"}.get(self.root.tag, "")
        if not self.kind:
            raise self._refused(self.root, f"<{self.root.tag}> is not <robot> (URDF), <sdf> or <mujoco> (MJCF)")

    def _refused(self, where: Element, sentence: str) -> SceneError:
        return SceneError(f"{self.path}, line {self.lines[where]}: {sentence}")

    def _tree(self) -> Element:
        """The root; entities, which may grow without bound or read other files, are refused with their declarations."""
        try:
            content = files.content_of(self.path, MOST_BYTES)
        except files.CannotRead as error:
            raise SceneError(str(error)) from None
        builder, parser, inside = TreeBuilder(), expat.ParserCreate(), list[Element]()

        def start(tag: str, attributes: dict[str, str]) -> None:
            if len(inside) >= DEEPEST:
                raise self._refused(inside[-1], "its elements are nested too deeply")
            inside.append(builder.start(tag, attributes))
            self.lines[inside[-1]] = parser.CurrentLineNumber

        def end(tag: str) -> None:
            builder.end(tag)
            inside.pop()

        def doctype(*_: object) -> None:
            raise SceneError(f"{self.path}, line {parser.CurrentLineNumber}: a DOCTYPE is not read: take it out")

        parser.StartElementHandler, parser.CharacterDataHandler, parser.EndElementHandler = start, builder.data, end
        parser.StartDoctypeDeclHandler = doctype
        try:
            parser.Parse(content, True)
        except expat.ExpatError as error:
            where = f"{self.path}, line {error.lineno}"
            raise SceneError(f"{where}: this is not XML: {expat.ErrorString(error.code)}") from None
        return builder.close()

    def ball(self) -> tuple[Element, tuple[str, Vector]]:
        """The only body with a sphere, and the radius and the centre of the sphere."""
        if self.kind == "mjcf":
            self._take_defaults()
        tag = "body" if self.kind == "mjcf" else "link"
        found = [(body, sphere) for body in self.root.iter(tag) if (sphere := self._sphere(body)) is not None]
        if len(found) != 1:
            names = ", ".join([*(one.get("name", "without a name") for one, _ in found[:8]), *["…"] * (len(found) > 8)])
            clause = f"has {len(found)} with one ({names})" if found else "has none"
            raise SceneError(f"{self.path}: the ball is the <{tag}> with a sphere to roll on, and this file {clause}")
        return found[0]

    def table(self) -> Data:
        """The numbers of the ball."""
        body, (radius, centre) = self.ball()
        self._check_free(body)
        self._check_alone(body, radius, centre)
        for where, what in self._left_out(body):
            _log.warning("%s, line %s: <%s>: %s, %s", self.path, self.lines[where], where.tag, what, LEFT_OUT)
        name = {"name": body.attrib["name"]} if body.get("name") else {}
        inertial = self._only(body, "inertial")
        if self.kind == "mjcf":
            self._check_masses()
            inertial = None if self._said("compiler", "inertiafromgeom", "auto")[0] == "true" else inertial
        if inertial is None:
            return name | self._of_one_material(body) | {"radius": radius}
        if inertial.get("auto", "false") not in ("false", "0"):
            raise self._refused(inertial, "<inertial>: auto is not read: write the mass and the inertia themselves")
        place, turn = self._pose(inertial, body)
        offset = [a - b for a, b in zip(place, centre, strict=True)]
        rho = self._number(radius, inertial)
        if max(map(abs, offset)) > NO_OFFSET * abs(rho):
            length = float(sum(x * x for x in offset)) ** 0.5
            what = unbalanced("the centre of mass of <inertial>", length, float(rho))
            raise self._refused(inertial, what)
        mass = self._value(inertial, "mass", "value")
        own = inertial.find("mass")
        self._number(mass, inertial if own is None else own)
        return name | {"inertia": self._tensor(inertial, turn), "mass": mass, "radius": radius}

    def check_filled_in(self) -> None:
        """Raises SceneError for a xacro file that is not expanded."""
        if (macro := next((one for one in self.root.iter() if one.tag.startswith("xacro:")), None)) is not None:
            raise self._refused(macro, f"<{macro.tag}> is to be filled in: give the file that xacro makes of it")

    def _take_defaults(self) -> None:
        """Copies the <default> of their class, or of the enclosing class, to geoms and joints of MJCF."""
        if (other := next(self.root.iter("include"), None)) is not None:
            raise self._refused(other, "<include> is not read: put what that file says about the ball into this one")
        Said = dict[str, dict[str, str]]  # by the tag
        said = dict[str, Said](main={"geom": {}, "joint": {}})

        def gather(default: Element, name: str, inherited: Said) -> None:
            said[name] = {tag: known.copy() for tag, known in inherited.items()}
            for one in default:
                if one.tag in said[name]:
                    said[name][one.tag] |= one.attrib
            for nested in default.findall("default"):
                gather(nested, nested.get("class", ""), said[name])

        def fill_in(where: Element, around: str) -> None:
            around = where.get("childclass", around)
            for child in where:
                name = child.get("class", around)
                if child.tag in said["main"]:
                    if name not in said:
                        raise self._refused(child, f"<{child.tag}>: its class {name!r} has no <default>")
                    child.attrib = said[name][child.tag] | child.attrib
                fill_in(child, around)

        for default in self.root.findall("default"):
            gather(default, "main", said["main"])
        for world in self.root.findall("worldbody"):
            fill_in(world, "main")

    def _check_alone(self, body: Element, radius: str, centre: Vector) -> None:
        """Raises SceneError if the ball also touches the plane with other shapes, except spheres inside of it."""
        for tag in UNREAD:
            if (hidden := body.find(tag)) is not None:
                raise self._refused(hidden, f"<{tag}> is not read: move its statements about the ball into its <body>")
        shapes = [one for one in body.findall("geom") if self._touches(one)] or body.findall("collision")
        for shape in shapes:
            if (other := self._sphere_of(shape, body)) is not None:
                away = sum((a - b) ** 2 for a, b in zip(other[1], centre, strict=True))
                room = self._number(radius, shape) - self._number(other[0], shape)
                if room >= 0 and away <= room**2:
                    continue
            clause = "a ball that rolls touches with its sphere alone, and this is another shape"
            raise self._refused(shape, f"<{shape.tag}>: {clause}: take it out, if it touches nothing")

    def _touches(self, geom: Element) -> bool:
        """Whether a geom of MJCF takes part in contacts, or is only visual."""
        return any(geom.get(name, "1") != "0" for name in ("contype", "conaffinity"))

    def _check_free(self, body: Element) -> None:
        """Raises SceneError if a joint, or another body, holds the ball, except a link without mass."""
        if self.kind == "mjcf":
            held = [one for one in self.root.iter("body") if body in list(one) and any(map(one.findall, MATTER))]
            held += body.findall("body")
            held += [joint for joint in body.findall("joint") if joint.get("type", "hinge") != "free"]
            if held:
                what = f"<{held[0].tag}> {held[0].get('name', 'without a name')}"
                raise self._refused(held[0], f"{what} holds the ball, but chapsym's ball rolls alone")
            for joint in body.findall("joint"):
                if self._number(joint.get("armature", "0"), joint):
                    clause = f"armature = {joint.attrib['armature']!r} is added to the inertia of the ball"
                    raise self._refused(joint, f"<joint>: {clause}, and is not read: take it out")
            return
        massive = {link.get("name") for link in self.root.iter("link") if link.find("inertial") is not None}
        for joint in self.root.iter("joint"):
            ends = [self._value(joint, end, "link") for end in ("parent", "child") if joint.find(end) is not None]
            others = massive.union({"world"} if self.kind == "sdf" else ()).intersection(ends) - {body.get("name")}
            fixed = joint.get("type") == "fixed" and not others
            if body.get("name") in ends and not fixed and joint.get("type") != "floating":
                what = f"<joint> {joint.get('name', 'without a name')} of {' and '.join(ends)}"
                raise self._refused(joint, f"{what} holds the ball, but chapsym's ball rolls alone")

    def _left_out(self, body: Element) -> Iterator[tuple[Element, str]]:
        """The actions on the ball besides a level plane and gravity, with their lines.

        The size of gravity has no effect on a ball whose centre of mass is its centre.
        """
        numbers, gravity, where = (self._acts_in_mjcf if self.kind == "mjcf" else self._acts_in_sdf)(body)
        for one, name, text in numbers:
            if any(self._number(part, one) for part in text.split()):
                yield one, f"{name} = {text.strip()!r} acts on the ball"
        x, y, z = self._numbers(gravity, where, 3)
        if not _along(x, y, -z):
            yield where, f"gravity = {gravity.strip()!r} is not down, along -z"
        planes = list(self._planes(self.root))
        if planes and not any(_along(*normal) for _, normal in planes):
            (plane, (x, y, z)), *_ = planes
            tilt = math.degrees(math.atan2(math.hypot(x, y), z))
            yield plane, f"this plane is tilted by {tilt:.3g} degrees"

    def _acts_in_mjcf(self, body: Element) -> tuple[list[tuple[Element, str, str]], str, Element]:
        """Numbers that act on the ball unless they are 0, gravity, and its element."""
        numbers = [(one, name, one.get(name, "0")) for one, name in product(body.findall("joint"), OF_JOINTS)]
        numbers.append((body, "gravcomp", body.get("gravcomp", "0")))
        for name in ("density", "viscosity"):  # of a fluid, without which wind has no effect
            text, where = self._said("option", name, "0")
            numbers.append((where, name, text))
        switch, where = self._said("flag", "gravity", "enable")
        return numbers, *(("0 0 0", where) if switch == "disable" else self._said("option", "gravity", "0 0 -1"))

    def _acts_in_sdf(self, body: Element) -> tuple[list[tuple[Element, str, str]], str, Element]:
        """Numbers that act on the ball unless they are 0, gravity, and its element; a URDF has neither."""
        acts = [(one, "velocity_decay") for one in body.iterfind("velocity_decay/*")]
        models = [one for one in self.root.iter("model") if body in list(one)]
        if any(one.findtext("enable_wind", "").strip() in ("true", "1") for one in (body, *models)):
            acts += [(one, "wind") for one in self.root.iterfind(".//wind/linear_velocity")]
        numbers = [(one, name, one.text or "") for one, name in acts]
        if (switch := body.find("gravity")) is not None and (switch.text or "").strip() in ("false", "0"):
            return numbers, "0 0 0", switch
        found = [*self.root.iterfind(".//world/gravity"), *self.root.iterfind(".//physics/gravity")]
        return numbers, *((found[-1].text or "", found[-1]) if found else ("0 0 -1", self.root))

    def _planes(self, around: Element) -> Iterator[tuple[Element, Vector]]:
        """The planes to roll on, and their normals in the axes of the enclosing element."""
        for child in around:
            found = list(self._planes(child)) if child.tag in AROUND else []
            if child.tag == "geom" and child.get("type") == "plane" and self._touches(child):
                if "zaxis" in child.attrib:
                    yield child, self._numbers(child.attrib["zaxis"], child, 3)
                elif "xyaxes" in child.attrib:
                    both = self._numbers(child.attrib["xyaxes"], child, 6)
                    yield child, cross(both[:3], both[3:])
                else:
                    found = [(child, UP)]
            elif child.tag == "collision" and (plane := child.find("geometry/plane")) is not None:
                found = [(child, self._numbers(plane.findtext("normal", "0 0 1"), plane, 3))]
            if found and any(pose.get("relative_to") for pose in child.findall("pose")):
                yield from found  # assumed in the enclosing axes, which are not read
            elif found:
                rotation = np.array(generated.rotation(*self._pose(child, child)[1]), dtype=object).reshape(3, 3)
                yield from ((plane, tuple(rotation @ normal)) for plane, normal in found)

    def _of_one_material(self, body: Element) -> Data:
        """The mass and inertia of a body of MJCF without <inertial>, from its geom; other formats need <inertial>."""
        geoms = [one for one in body.findall("geom") if self._number(one.get("mass", "1"), one)]
        if len(geoms) != 1:
            clause = f"has {len(geoms)} geoms and " if geoms else "has "
            raise self._refused(body, f"the ball {clause}no <inertial> with its mass and inertia")
        (geom,) = geoms
        hollow = self._one_of(geom, "shellinertia", ("false", "true")) == "true"
        mass = geom.get("mass") or self._of_density(geom, hollow)
        return {"preset": "shell" if hollow else "homogeneous", "mass": mass}

    def _of_density(self, geom: Element, hollow: bool) -> str:
        """The mass of a sphere, to many digits; the density of a hollow sphere is per surface area."""
        import mpmath

        density = self._number(geom.get("density", DENSITY), geom)
        radius = self._number(geom.attrib["size"].split()[0], geom)
        size = density * (4 * radius**2 if hollow else radius**3 * Fraction(4, 3))
        with mpmath.workdps(2 * DIGITS):
            return str(mpmath.nstr(mpmath.pi * size.numerator / size.denominator, DIGITS))

    def _sphere(self, body: Element) -> tuple[str, Vector] | None:
        """The radius and the centre of the sphere on which it rolls: collision shapes before visual ones."""
        geoms = sorted(body.findall("geom"), key=self._touches, reverse=True)
        shapes = geoms if self.kind == "mjcf" else [*body.findall("collision"), *body.findall("visual")]
        return next((found for shape in shapes if (found := self._sphere_of(shape, body)) is not None), None)

    def _sphere_of(self, shape: Element, body: Element) -> tuple[str, Vector] | None:
        if self.kind == "mjcf":
            radius = (shape.get("size", "").split() or [""])[0] if shape.get("type", "sphere") == "sphere" else ""
        else:
            geometry = self._only(shape, "geometry")
            sphere = None if geometry is None else self._only(geometry, "sphere")
            radius = "" if sphere is None else self._value(sphere, "radius")
        return (radius, self._pose(shape, body)[0]) if radius else None

    def _only(self, parent: Element, tag: str) -> Element | None:
        """The child with a tag, if any; two are refused, since readers take the first, the last, or both."""
        found = parent.findall(tag)
        if len(found) > 1:
            clause = f"<{parent.tag}> has two <{tag}>, the first on line {self.lines[found[0]]}: take one out"
            raise self._refused(found[1], clause)
        return found[0] if found else None

    def _value(self, parent: Element, name: str, attribute: str | None = None) -> str:
        """A number of an element: the text of a child, or an attribute of the element or of a child."""
        child = self._only(parent, name)
        found = parent.get(name)
        if child is not None:
            found = child.get(attribute or "", child.text or "").strip()
        if not found:
            raise self._refused(parent, f"<{parent.tag}> has no {name}")
        return found

    def _number(self, text: str, where: Element) -> Fraction:
        if "${" in text or "$(" in text or "{{" in text:
            clause = "is to be filled in: give the file that xacro, or the template's own program, makes of it"
            raise self._refused(where, f"<{where.tag}>: {text.strip()!r:.60} {clause}")
        try:
            found = rational(text, f"<{where.tag}>")
        except NotANumber as error:
            raise self._refused(where, str(error)) from None
        if abs(found) > MOST:
            raise self._refused(where, f"<{where.tag}>: {text.strip()!r:.40} is beyond what a ball has")
        return found

    def _numbers(self, text: str, where: Element, count: int) -> Vector:
        parts = text.split()
        if len(parts) != count:
            raise self._refused(where, f"<{where.tag}> must have {count} numbers, not {text.strip()!r}")
        return tuple(self._number(part, where) for part in parts)

    def _pose(self, parent: Element, body: Element) -> Pose:
        """The pose of an element of a body, in the body."""
        if self.kind == "mjcf":
            return self._numbers(parent.get("pos", "0 0 0"), parent, 3), self._turn_of_mjcf(parent)
        where = self._only(parent, "origin" if self.kind == "urdf" else "pose")
        if where is None or (self.kind == "sdf" and not (where.text or "").strip()):
            return NO_TURN[1:], NO_TURN
        if self.kind == "urdf":
            if "quat_xyzw" in where.attrib:
                *axis, scalar = self._numbers(where.attrib["quat_xyzw"], where, 4)
                turn = (scalar, *axis)
            else:
                turn = _turned(self._numbers(where.get("rpy", "0 0 0"), where, 3))
            return self._numbers(where.get("xyz", "0 0 0"), where, 3), turn
        if (frame := where.get("relative_to", "")) not in ("", body.get("name")):
            clause = f"relative_to = {frame!r} is not read: give the pose in the frame of its link"
            raise self._refused(where, f"<pose>: {clause}")
        form = self._one_of(where, "rotation_format", ("euler_rpy", "quat_xyzw"))
        in_degrees = self._one_of(where, "degrees", ("false", "true", "0", "1")) in ("true", "1")
        numbers = self._numbers(where.text or "", where, 7 if form == "quat_xyzw" else 6)
        if form == "quat_xyzw":
            return numbers[:3], (numbers[6], *numbers[3:6])
        return numbers[:3], _turned(numbers[3:], degrees=in_degrees)

    def _one_of(self, where: Element, name: str, known: tuple[str, ...]) -> str:
        """An attribute with one of several values, by default the first."""
        if (found := where.get(name, known[0])) not in known:
            raise self._refused(where, f"<{where.tag}>: {name} must be {' or '.join(known[:2])}, not {found!r}")
        return found

    def _turn_of_mjcf(self, where: Element) -> Vector:
        """The rotation by quat, euler or axisangle, with the angles of <compiler>."""
        given = [name for name in ("quat", "euler", "axisangle", "xyaxes", "zaxis") if name in where.attrib]
        if len(given) > 1:
            raise self._refused(where, f"<{where.tag}> is turned twice: by {given[0]} and {given[1]}")
        name = given[0] if given else ""
        if name in ("xyaxes", "zaxis"):
            raise self._refused(where, f"<{where.tag}> is turned by {name}, which is not read: write quat or euler")
        if name == "quat":
            return self._numbers(where.attrib[name], where, 4)
        unit, compiler = self._said("compiler", "angle", "degree")
        if unit not in ("degree", "radian"):
            raise self._refused(compiler, f"<compiler>: angle must be degree or radian, not {unit!r}")
        sequence, compiler = self._said("compiler", "eulerseq", "xyz")
        if len(sequence) != 3 or not set(sequence.lower()) <= set("xyz"):
            raise self._refused(compiler, f"<compiler>: eulerseq must be three of x, y, z, X, Y, Z, not {sequence!r}")
        if name == "axisangle":
            *axis, angle = self._numbers(where.attrib[name], where, 4)
            return _about_axis(axis, angle, unit == "degree")
        angles = self._numbers(where.get("euler", "0 0 0"), where, 3)
        return _turned(angles, sequence, degrees=unit == "degree")

    def _said(self, tag: str, name: str, default: str) -> tuple[str, Element]:
        """The value of an attribute in the last element with this tag and attribute, for the whole file, and where."""
        clause = [one for one in self.root.iter(tag) if name in one.attrib]
        return (clause[-1].attrib[name], clause[-1]) if clause else (default, self.root)

    def _check_masses(self) -> None:
        """Raises SceneError if <compiler> of MJCF changes masses or positions."""
        for name, plain in PLAIN.items():
            value, where = self._said("compiler", name, plain)
            if value != plain:
                clause = (
                    f"{name} = {value!r} makes others of the numbers in the file, and is not read: write the ball's own"
                )
                raise self._refused(where, f"<compiler>: {clause}")

    def _tensor(self, inertial: Element, turn: Vector) -> list[list[str]]:
        """The rows of the tensor in the axes of the body: R I Rᵀ for I in the axes of <inertial>."""
        if self.kind == "mjcf":
            texts = self._of_mjcf(inertial)
        else:
            if (inertia := self._only(inertial, "inertia")) is None:
                raise self._refused(inertial, "<inertial> has no <inertia>")
            optional = ("ixy", "ixz", "iyz") if self.kind == "sdf" else ()
            absent = {name for name in optional if inertia.find(name) is None}
            texts = {name: "0" if name in absent else self._value(inertia, name) for name in ENTRIES}
            for name, text in texts.items():
                child = inertia.find(name)
                self._number(text, inertia if child is None else child)
        rows = [[texts["".join(["i", *sorted((a, b))])] for b in "xyz"] for a in "xyz"]
        if not any(turn[1:]):
            return rows
        tensor = [[self._number(text, inertial) for text in row] for row in rows]
        if not (length := sum(x * x for x in turn)):
            raise self._refused(inertial, "the quaternion of <inertial> is 0")
        rotation = np.array(generated.rotation(*turn), dtype=object).reshape(3, 3) / length
        return [[_text(x) for x in row] for row in rotation @ np.array(tensor, dtype=object) @ rotation.T]

    def _of_mjcf(self, inertial: Element) -> dict[str, str]:
        """xx yy zz xy xz yz, or xx yy zz."""
        names = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
        for key, count in (("fullinertia", 6), ("diaginertia", 3)):
            if key in inertial.attrib:
                self._numbers(inertial.attrib[key], inertial, count)
                return dict.fromkeys(names, "0") | dict(zip(names, inertial.attrib[key].split(), strict=False))
        raise self._refused(inertial, "<inertial> has no diaginertia or fullinertia")


def _along(x: Fraction, y: Fraction, z: Fraction) -> bool:
    """Whether a vector is vertical, up to the rounding of angles."""
    return z > 0 and max(abs(x), abs(y)) <= LEVEL * z


def _text(x: Fraction) -> str:
    """The exact number if that is short, else many digits."""
    import mpmath

    short = str(x)
    if len(short) <= DIGITS:
        return short
    with mpmath.workdps(2 * DIGITS):
        return str(mpmath.nstr(mpmath.mpf(x.numerator) / x.denominator, DIGITS))


def _turned(angles: Vector, sequence: str = "XYZ", degrees: bool = False) -> Vector:
    """Successive rotations about axes: fixed ones X, Y, Z, or x, y, z of the body, which rotate with it.

    Roll, pitch, yaw are about X, Y, Z: Rz(yaw) Ry(pitch) Rx(roll).
    """
    found = NO_TURN
    for angle, name in zip(angles, sequence, strict=True):
        one = _about_axis([Fraction(name.lower() == axis) for axis in "xyz"], angle, degrees)
        found = generated.compose(*found, *one) if name.islower() else generated.compose(*one, *found)
    return found


def _about_axis(axis: Sequence[Fraction], angle: Fraction, degrees: bool) -> Vector:
    """A rotation about an axis of any length, to many digits."""
    if not angle:
        return NO_TURN
    import mpmath

    with mpmath.workdps(2 * DIGITS):
        half, *along = (mpmath.mpf(x.numerator) / x.denominator for x in (angle / 2, *axis))
        half *= mpmath.pi / 180 if degrees else 1
        found = (mpmath.cos(half) * mpmath.norm(along), *(mpmath.sin(half) * x for x in along))
        return tuple(Fraction(mpmath.nstr(x, DIGITS + 10)) for x in found)
