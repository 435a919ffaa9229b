from __future__ import annotations

import numpy as np
import pytest

from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import two_coloured
from fabricate.mesh.cube import cube

QUADS = two_coloured(cube(divisions=1))


def test_states_are_a_frozen_copy() -> None:
    joined = np.array([True, False, True, False, False, True])
    duotone = Duotone(QUADS, joined)
    joined[:] = False
    assert duotone.joined.tolist() == [True, False, True, False, False, True]
    with pytest.raises(ValueError, match="read-only"):
        duotone.joined[0] = False


@pytest.mark.parametrize("count", [0, 5, 7])
def test_there_is_one_state_for_each_tile(count: int) -> None:
    with pytest.raises(ValueError, match=rf"shape \(6\), found \({count},\)"):
        Duotone(QUADS, np.zeros(count, dtype=bool))
