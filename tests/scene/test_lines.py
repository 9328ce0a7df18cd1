"""The line of a key, in texts with all that TOML has."""

import pytest

from chapsym.scene.read.errors import MOST_ENDS, MOST_LINES, line_of

TEXT = '''# a comment
title = """
[ball]
mass = 1
"""
[[ball]]   # line 6
name = "a"
inertia = [
  [1, 0, 0],  # not a key
  [0, 1, 0],
]
start = { omega = [1, 2, 3] }
[[ball]]
radius.x = 3
'quoted key' = 1

[run]
steps = 3
'''


@pytest.mark.parametrize(
    ("path", "line"),
    [
        (("title",), 2),
        (("ball",), 6),
        (("ball", 0), 6),
        (("ball", 0, "name"), 7),
        (("ball", 0, "inertia"), 8),
        (("ball", 0, "inertia", 2), None),
        (("ball", 0, "inertia", 1, 2), 8),
        (("ball", 0, "start", "omega", 2), 12),
        (("ball", 1), 13),
        (("ball", 1, "radius", "x"), 14),
        (("ball", 1, "quoted key"), 15),
        (("run",), 17),
        (("run", "steps"), 18),
        (("run", "time"), None),
        (("ball", 2), None),
        (("title", 0), None),
    ],
)
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_the_line_on_which_a_key_begins(path, line, end):
    assert line_of(TEXT.replace("\n", end), path) == line


def test_a_text_that_is_not_toml_or_long_has_no_lines():
    assert line_of("[ball", ("ball",)) is None
    assert line_of("\n" * MOST_LINES + "a = 1", ("a",)) is None
    assert line_of("a = [\n" + "[1],\n" * 3 * MOST_ENDS + "]\nb = 1", ("b",)) is None
    assert line_of("a = [\n" + "1,\n" * 3_000 + "]\nb = 1", ("b",)) == 3_003
    assert line_of("\n" * (MOST_LINES - 1) + "a = 1", ("a",)) == MOST_LINES
