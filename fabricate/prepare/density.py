"""How dense tiles can be: the finest that a process prints, and whether a mesh's own cells are finer than asked."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from fabricate.errors import PrepareError
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.tile_sides import tile_sides
from fabricate.region_names import region_names

NARROWING = 1.3
"""How much wider the neck of a typical tile must be than the narrowest that prints, as tiles vary.

Of remeshed scans and machine parts the tile at the 5th percentile has 0.77 of the median's side where the body is
not thin: 19 of 20 necks are then wide enough.
"""

FEWEST_TILES = 8
"""A body is divided into at least so many tiles along its longest side: a ball then has about 200."""


MET_WITHIN = 1.4
"""Factor within which a tile size that is asked for is met."""

TOO_FINE = 2.5
"""A file's own cells are too fine when their tiles are smaller than those asked for by more than this factor."""

TRIANGLE, MOSTLY = 3, 0.9
"""Corners of a triangle, and the share of the faces that are triangles in scans and exports."""


@dataclass(frozen=True)
class Density:
    """A tile size, mm, and a sentence that names what bound it."""

    tile_size: float
    limit: str


def finest_tile(
    feature: float,
    clearance: float,
    *,
    extent: float,
    rings: Sequence[float] = (0.5,),
    margin: float = NARROWING,
) -> Density:
    """Return the finest tile whose necks a process can print.

    On a flat square tile of side s the narrower colour has a neck of (sqrt 2 - 2 max(r, 1 - r)) s where it is joined
    across the tile (Garigipati 2013, 3.3), 0.414 s at r = 1/2; bands between several rings are as wide as these are
    apart. The narrowest has to leave the smallest feature when the clearance is taken off.

    Parameters
    ----------
    feature : float
        Smallest feature that the process prints, mm.
    clearance : float
        Gap between facing walls, mm; half of it is taken off either side of a neck.
    extent : float
        Longest side of the body, mm: with tiles larger than 1/8 of it there would be no pattern.
    rings : sequence of float
        Positions r of the curves on tile edges, between 0.293 and 0.707.
    margin : float
        How much wider than the narrowest neck that prints the neck of a tile of this size shall be.

    Raises
    ------
    PrepareError
        If the rings leave one colour without a neck or one band without a width, or a length is not positive (a
        clearance may be 0).
    """
    if not (feature > 0.0 and clearance >= 0.0 and extent > 0.0 and margin > 0.0):
        raise PrepareError(
            "the finest tile needs a positive feature, extent and margin and a clearance of 0 or more, found "
            f"{feature:g} mm, {extent:g} mm, {margin:g} and {clearance:g} mm"
        )
    neck = neck_share(rings)
    largest = extent / FEWEST_TILES
    finest = margin * (feature + clearance) / neck
    if finest > largest:
        return Density(
            largest,
            f"tiles are {largest:.3g} mm, 1/{FEWEST_TILES} of the body's {extent:.4g} mm, though the process asks for "
            f"{finest:.3g} mm: necks will be too narrow, ask for a larger source.size",
        )
    what = "clearance" if clearance > feature else "process's smallest feature"
    return Density(
        finest,
        f"tiles are {finest:.3g} mm because of the {what}: a neck, {neck:.3g} of a tile, must leave {feature:g} mm "
        f"when the clearance of {clearance:g} mm is taken off, with a margin of {margin - 1.0:.0%} as tiles vary",
    )


def neck_share(rings: Sequence[float]) -> float:
    """Return the narrowest neck or band on a square tile of side 1, from the positions of its arcs.

    Raises
    ------
    PrepareError
        If opposite arcs meet, which is where a position is not between 0.293 and 0.707, or rings do not increase.
    """
    shares = _shares(rings)
    if not min(shares["yellow"], shares["blue"]) > 0.0:
        found = ", ".join(f"{ring:g}" for ring in rings)
        raise PrepareError(f"pattern.arc must be between 0.293 and 0.707 for both colours to have necks, found {found}")
    if not min(shares.values()) > 0.0:
        raise PrepareError("pattern.rings must increase for bands to have a width")
    return min(shares.values())


def check_room(rings: Sequence[float], *, tile_size: float, clearance: float) -> None:
    """Raise an error if tiles of about this size have necks or bands of which the clearance leaves nothing; mm.

    No choice of tiles helps then, and looking for one takes long.

    Raises
    ------
    PrepareError
    """
    for name, share in _shares(rings).items():
        width = share * MET_WITHIN * tile_size
        if width <= clearance:
            what = "the necks of " if name in ("yellow", "blue") else ""
            aim = "pattern.arc or rings nearer to 0.5" if what else "pattern.rings that are further apart there"
            least = clearance / (MET_WITHIN * tile_size)
            raise PrepareError(
                f"a clearance of {clearance:g} mm leaves nothing of {what}{name}, {share:.3g} of a tile of about "
                f"{tile_size:g} mm, where it has to be more than {least:.3g}; ask for a smaller solid.clearance, a "
                f"larger pattern.tile_size or {aim}"
            )


def _shares(rings: Sequence[float]) -> dict[str, float]:
    """Return how wide the necks of yellow and blue and the bands are on a square tile of side 1, by region."""
    diagonal = float(np.sqrt(2.0))
    widths = [
        diagonal - 2.0 * (1.0 - rings[0]),
        *(outer - inner for inner, outer in pairwise(rings)),
        diagonal - 2.0 * rings[-1],
    ]
    return dict(zip(region_names(len(widths)), widths, strict=True))


def too_fine(mesh: PolygonMesh, *, size: float, tile_size: float) -> bool:
    """Tell whether a mesh of triangles has far smaller tiles than those asked for; both lengths in mm.

    Other polygons were laid out by somebody, and are kept.
    """
    if not mostly_triangles(mesh):
        return False
    extent = float(np.ptp(mesh.points, axis=0).max())
    return float(np.median(tile_sides(mesh))) * size / extent * TOO_FINE < tile_size


def mostly_triangles(mesh: PolygonMesh) -> bool:
    """Tell whether a mesh is a triangulated surface, as scans and exports are, and no cage."""
    return float(np.mean(mesh.face_sizes == TRIANGLE)) >= MOSTLY
