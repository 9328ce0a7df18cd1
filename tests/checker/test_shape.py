"""A certificate of any kind that has something of another form in any place is refused with a sentence."""

import certificate_maker as maker
import pytest
from certificate_changes import at, committed, refused, replaced, resealed
from count_changes import counts
from derivation_changes import derivations
from register_changes import small

#: Those of the register have every part of its form between them.
REGISTER, MOTION = small()[0] | derivations()[0] | counts()[0], committed("motion-giant")
CERTIFICATES = {
    **{name: committed(name) for name in ("measure-even", "periodic-orbit-simplest", "heteroclinic-light")},
    "energy-drift-real-ball": committed("energy-drift-real-ball"),
    "motion-giant": MOTION | {"frames": MOTION["frames"][:2]},
    **{
        name: REGISTER[name]
        for name in (
            "x = 2 fails at 1", "AB = 1", "(x + 1)² by names", "0 < x ≤ 1, x = 1, x ≠ 2", "it rests on others",
            "x² = 2 near 17/12, x ≠ 1", "an entry", "a line and a circle in a chart",
        )
    },
}  # fmt: skip
OTHERS = (None, True, 1.5, [], {}, [[]], "", "a\nb")


def places(data, path=()):
    """Every place but those of the seal; of a list the first three items."""
    if path:
        yield path
    if isinstance(data, dict | list):
        items = [*(data.items() if isinstance(data, dict) else enumerate(data[:3]))]
        for name, part in items:
            if name not in ("statement", "digest"):
                yield from places(part, (*path, name))


@pytest.mark.parametrize("name", CERTIFICATES)
def test_what_has_another_form_is_refused_with_a_sentence(name):
    right = CERTIFICATES[name]
    for path in places(right):
        there = at(right, path)
        others = [x for x in OTHERS if type(x) is not type(there) or x in ("", "a\nb")]
        if path[0] != "points" and (path[0] != "counterexamples" or "point" not in path):  # where all names are free
            others += [-1, 10**9] if type(there) is int and isinstance(path[-1], str) else []
            others += [there | {"extra": 1}] if isinstance(there, dict) else []
        for other in others:
            assert refused(resealed(replaced(right, path, other))), (path, other)
    for other in OTHERS:
        assert refused(right | {"digest": other})
        assert refused(maker.sealed(right | {"statement": other}))
