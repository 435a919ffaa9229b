"""All files of one sculpture but its report: parts, pair, curve and pictures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from fabricate.arrays import Floats
from fabricate.output.curve_ply import write_curves
from fabricate.output.glb import write_glb
from fabricate.output.png import write_png
from fabricate.output.stl import write_stl
from fabricate.output.three_mf import write_3mf
from fabricate.picture.preview import NO_MARKS, preview_image
from fabricate.solid.part import Part


def write_sculpture(folder: Path, parts: Sequence[Part], curves: Sequence[Floats], *, name: str) -> tuple[Path, ...]:
    """Write the parts and the pictures of them; return the paths of the STL files.

    See `write_parts` and `write_pictures`.

    Raises
    ------
    OutputError
        If a file cannot be written.
    """
    paths = write_parts(folder, parts, curves, name=name)
    write_pictures(folder, parts)
    return paths


def write_parts(
    folder: Path, parts: Sequence[Part], curves: Sequence[Floats], *, name: str, middles: Sequence[Floats] = ()
) -> tuple[Path, ...]:
    """Write the parts as NAME.stl each, pair.3mf and curve.ply; return the paths of the STL files.

    `curves` are the points of each closed curve, (c, 3) mm. `name` is the sculpture's, as programs show it. `middles`
    are places on the mid-line of the joint under each curve, (r, c, 3) mm.

    Raises
    ------
    OutputError
        If a file cannot be written.
    """
    paths = tuple(folder / f"{part.name}.stl" for part in parts)
    for path, part in zip(paths, parts, strict=True):
        write_stl(path, part)
    write_3mf(folder / "pair.3mf", parts, name=name)
    write_curves(folder / "curve.ply", curves, middles)
    return paths


def write_pictures(folder: Path, parts: Sequence[Part], *, marks: Mapping[str, Part] = NO_MARKS) -> None:
    """Write preview.glb and preview.png, with the marks on each part, by its name.

    Raises
    ------
    OutputError
        If a file cannot be written.
    """
    write_glb(folder / "preview.glb", [*parts, *marks.values()])
    write_png(folder / "preview.png", preview_image(parts, marks=marks))
