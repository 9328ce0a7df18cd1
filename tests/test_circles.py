"""No file of a room imports, lazily or not, one that comes to import it."""

from pathlib import Path

import pytest
from imported import imported, modules

import chapsym

ROOT = Path(chapsym.__file__).parent
#: The rooms inside of chapsym.scene, each of which imports those before it only.
OF_SCENE = ("read", "members", "plan", "result", "running")
ROOMS = sorted({path.name for path in ROOT.iterdir() if (path / "__init__.py").is_file()})


def circle(known):
    """The modules that are left when those that import none of the others are taken away, again and again."""
    left = {name: set(imported(name, path, known)) - {name} for name, path in known.items()}
    while free := [name for name, needs in left.items() if not needs & left.keys()]:
        for name in free:
            del left[name]
    return sorted(left)


@pytest.mark.parametrize("room", ROOMS)
def test_no_circle_in_a_room(room):
    assert circle(modules(ROOT / room, f"chapsym.{room}")) == []


def test_the_rooms_of_scene_stand_on_each_other():
    known = modules(ROOT / "scene", "chapsym.scene")
    for name, path in known.items():
        inside = name.split(".")[2:3]
        if inside and inside[0] in OF_SCENE:
            for other in imported(name, path, known):
                below = other.removeprefix("chapsym.scene.").split(".")[0]
                if below in OF_SCENE:
                    assert OF_SCENE.index(below) <= OF_SCENE.index(inside[0]), f"{name} imports {other}"
