"""The fixture `rolling_case` of pytest: a test that takes it runs for each case, or for those that it names.

`@pytest.mark.parametrize("rolling_case", ["homogeneous", "robot"], indirect=True)` names two.
"""

import pytest

from . import Case, case, names


@pytest.fixture(params=names())
def rolling_case(request: pytest.FixtureRequest) -> Case:
    """A ball that rolls: name, mass, radius, inertia, and time, path, attitude, omega at the frames."""
    return case(request.param)
