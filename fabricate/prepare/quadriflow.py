"""Quads on a closed surface, by QuadriFlow in a process of its own."""

from __future__ import annotations

import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare import quadriflow_child
from fabricate.prepare.triangle_mesh import TriangleMesh

PATIENCE = 60.0
"""Seconds after which QuadriFlow is taken to hang; it needs about one for 20 000 triangles."""

_SEEDS = 2**31
"""QuadriFlow's seed is a C int."""


def quadriflow_exists() -> bool:
    """Tell whether QuadriFlow is installed; its wheels are for Linux and Windows on x86-64 only."""
    return find_spec("pyQuadriFlow") is not None


def quadriflow(mesh: TriangleMesh, *, faces: int, seed: int) -> PolygonMesh | None:
    """Return about `faces` quads on a surface, or None if QuadriFlow crashes, hangs or makes nothing.

    The quads are what it makes, which need not be closed, of the same genus or free of crossings. The same
    triangles, number and seed give the same quads.

    Parameters
    ----------
    mesh : TriangleMesh
        Closed. The time grows with the number of triangles, and with how unequal they are.

    References
    ----------
    J. Huang, Y. Zhou, M. Niessner, J. R. Shewchuk, L. J. Guibas, "QuadriFlow: A scalable and robust method for
    quadrangulation", Computer Graphics Forum 37(5), 2018.
    """
    with TemporaryDirectory(prefix="fabricate-") as folder:
        given, wanted = Path(folder) / "triangles.npz", Path(folder) / "quads.npz"
        np.savez(given, points=mesh.points, triangles=mesh.triangles)
        # -P: the child's own folder holds modules of this package, and is no place to import from
        numbers = [str(faces), str(seed % _SEEDS)]
        command = [sys.executable, "-P", quadriflow_child.__file__, str(given), str(wanted), *numbers]
        try:
            # nothing but our own script and numbers is run
            subprocess.run(  # noqa: S603
                command,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                timeout=PATIENCE,
                check=True,
            )
            made = np.load(wanted)
            points, quads = made["points"], made["quads"]
        except (subprocess.SubprocessError, OSError):
            return None
    if not len(quads):
        return None
    return PolygonMesh(points, quads.ravel(), np.arange(0, quads.size + 1, 4))
