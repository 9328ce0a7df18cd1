"""Old names work, and warn."""

import pytest

import chapsym
import chapsym.numbers


def test_the_old_name_of_an_enclosure():
    with pytest.warns(DeprecationWarning, match=r"chapsym\.numbers\.Ball is now chapsym\.numbers\.Enclosure"):
        assert chapsym.numbers.Ball is chapsym.Enclosure
    with pytest.raises(AttributeError, match="no attribute 'Bell'"):
        _ = chapsym.numbers.Bell
