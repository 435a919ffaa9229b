"""QuadriFlow in its own process: quads, the same ones each time, and nothing that goes wrong there comes out."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.mesh.closed import checked_closed, genus
from fabricate.mesh.sphere import sphere
from fabricate.mesh.torus import torus
from fabricate.prepare import quadriflow as module
from fabricate.prepare.quadriflow import quadriflow, quadriflow_exists
from fabricate.prepare.triangle_mesh import TriangleMesh, fanned

BALL = fanned(sphere(faces="triangles", frequency=12))
RING = fanned(torus(around=48, across=20, tube=0.4))

needs_quadriflow = pytest.mark.skipif(not quadriflow_exists(), reason="QuadriFlow's wheels are for x86-64 only")


@needs_quadriflow
@pytest.mark.parametrize(("mesh", "handles"), [(BALL, 0), (RING, 1)], ids=["ball", "ring"])
def test_about_as_many_quads_as_asked_for(mesh: TriangleMesh, handles: int) -> None:
    made = quadriflow(mesh, faces=200, seed=1)
    assert made is not None
    assert (made.face_sizes == 4).all()
    assert 100 < len(made.offsets) - 1 < 400
    assert genus(checked_closed(made)) == handles


@needs_quadriflow
def test_the_same_seed_gives_the_same_quads(capfd: pytest.CaptureFixture[str]) -> None:
    first, again = (quadriflow(BALL, faces=150, seed=2**40 + 7) for _ in range(2))
    assert first is not None
    assert again is not None
    assert first.points.tobytes() == again.points.tobytes()
    assert first.corners.tobytes() == again.corners.tobytes()
    assert capfd.readouterr() == ("", "")


@needs_quadriflow
def test_a_crash_is_no_quads(capfd: pytest.CaptureFixture[str]) -> None:
    out_of_range = TriangleMesh(BALL.points, BALL.triangles + 10**6)
    assert quadriflow(out_of_range, faces=100, seed=1) is None
    assert capfd.readouterr() == ("", "")


def test_a_hang_is_no_quads(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "PATIENCE", 1e-3)
    assert quadriflow(BALL, faces=100, seed=1) is None


def test_a_missing_library_is_no_quads(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module.sys, "executable", "/nowhere/python")
    assert quadriflow(BALL, faces=100, seed=1) is None


def test_the_input_is_not_changed() -> None:
    before = np.array(BALL.points)
    quadriflow(BALL, faces=60, seed=1)
    assert (BALL.points == before).all()
