"""The script that runs QuadriFlow: from a file to a file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from fabricate.mesh.sphere import sphere
from fabricate.prepare.quadriflow import quadriflow_exists
from fabricate.prepare.quadriflow_child import quadrangulated

pytestmark = pytest.mark.skipif(not quadriflow_exists(), reason="QuadriFlow's wheels are for x86-64 only")


def test_quads_lie_on_the_ball(tmp_path: Path) -> None:
    ball = sphere(faces="triangles", frequency=10)
    np.savez(tmp_path / "in.npz", points=ball.points, triangles=ball.corners.reshape(-1, 3))
    quadrangulated(tmp_path / "in.npz", tmp_path / "out.npz", faces=150, seed=3)
    made = np.load(tmp_path / "out.npz")
    assert np.linalg.norm(made["points"], axis=1) == pytest.approx(1.0, abs=0.02)
    assert made["quads"].shape[1] == 4
    assert np.unique(made["quads"]).tolist() == list(range(len(made["points"])))
    assert made["points"].dtype == np.float64
