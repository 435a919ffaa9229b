"""The process in which QuadriFlow runs: a script, so that neither a crash nor a hang of it is one of ours.

Called as `python quadriflow_child.py INPUT OUTPUT FACES SEED`. Input and output are .npz files: `points`, (n, 3)
float, with `triangles`, (m, 3) int, or `quads`, (k, 4) int. It is run by its path and imports nothing of this package,
which would take longer than the work.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np


def quadrangulated(given: Path, wanted: Path, *, faces: int, seed: int) -> None:
    """Read triangles from one file, and write about `faces` quads on the same surface into the other."""
    from pyQuadriFlow.pyQuadriFlow import pyquadriflow

    mesh = np.load(given)
    # minimum-cost flow, the last flag, is slow and fails more often; the others are for open and for sharp surfaces
    flags = {"flag_preserve_sharp": False, "flag_preserve_boundary": False, "flag_adaptive_scale": False}
    flags |= {"flag_aggresive_sat": False, "flag_minimum_cost_flow": False}
    made = pyquadriflow(faces, seed, mesh["points"].tolist(), mesh["triangles"].tolist(), **flags)
    points = np.asarray(made["vertices"], dtype=np.float64).reshape(-1, 3)
    np.savez(wanted, points=points, quads=np.asarray(made["faces"], dtype=np.int64).reshape(-1, 4))


if __name__ == "__main__":
    quadrangulated(Path(sys.argv[1]), Path(sys.argv[2]), faces=int(sys.argv[3]), seed=int(sys.argv[4]))
