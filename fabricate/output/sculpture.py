"""All files of one sculpture but its report: parts, pair, curve and pictures."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from fabricate.arrays import Floats
from fabricate.output.curve_ply import write_curves
from fabricate.output.glb import write_glb
from fabricate.output.png import write_png
from fabricate.output.stl import write_stl
from fabricate.output.three_mf import write_3mf
from fabricate.picture.preview import preview_image
from fabricate.solid.part import Part


def write_sculpture(folder: Path, parts: Sequence[Part], curves: Sequence[Floats], *, name: str) -> tuple[Path, ...]:
    """Write the parts as NAME.stl each, pair.3mf, preview.glb, preview.png and curve.ply; return the STL paths.

    `curves` are the points of each closed curve, (c, 3) mm. `name` is the sculpture's, as programs show it.

    Raises
    ------
    OutputError
        If a file cannot be written.
    """
    paths = tuple(folder / f"{part.name}.stl" for part in parts)
    for path, part in zip(paths, parts, strict=True):
        write_stl(path, part)
    write_3mf(folder / "pair.3mf", parts, name=name)
    write_curves(folder / "curve.ply", curves)
    write_glb(folder / "preview.glb", parts)
    write_png(folder / "preview.png", preview_image(parts))
    return paths
