from __future__ import annotations

from dataclasses import FrozenInstanceError

import pytest
from breaking import box

from fabricate.prepare.repaired import Action, Repaired


def test_records_cannot_be_changed() -> None:
    found = Repaired(box(), (Action("points welded", 3),))
    with pytest.raises(FrozenInstanceError):
        found.actions = ()  # type: ignore[misc]
    with pytest.raises(FrozenInstanceError):
        found.actions[0].count = 4  # type: ignore[misc]
