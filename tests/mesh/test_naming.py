from __future__ import annotations

import numpy as np

from fabricate.mesh.naming import counted, place


def test_places_are_short() -> None:
    assert place(np.array([1.0, -0.5, 1e-9])) == "(1, -0.5, 1e-09)"


def test_one_is_singular() -> None:
    assert [counted(1, "face"), counted(2, "face"), counted(0, "vertex", "vertices")] == [
        "1 face",
        "2 faces",
        "0 vertices",
    ]
