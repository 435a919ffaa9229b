"""New cells for a surface: quads, triangles or hexagons whose tiles have the size asked for."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal, TypeAlias

import numpy as np

from fabricate.errors import PrepareError
from fabricate.mesh.closed import checked_closed, genus
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.dual import dual
from fabricate.prepare.fitted import fitted
from fabricate.prepare.isotropic import isotropic
from fabricate.prepare.quadriflow import quadriflow, quadriflow_exists
from fabricate.prepare.sharp_edges import sharpened
from fabricate.prepare.sizing_field import SizingField
from fabricate.prepare.soundness import bridges, crossing_faces, fault, lost, topology_fault
from fabricate.prepare.tile_sides import tile_sides
from fabricate.prepare.triangle_mesh import TriangleMesh, decimated, fanned

Cells: TypeAlias = Literal["quads", "triangles", "hexagons"]

MOST_TILES = 250_000
"""More tiles than this take minutes to remesh."""

TILES_OF_HANDLE = 24
"""Fewest tiles, on average, for each handle. Of the tightest lattice of square bars, as long as they are wide, every
joint has two handles and 12 squares, which become 48 tiles; with fewer tiles a point is in more than six of the cells.
"""

TOLERANCE = 0.15
"""Share by which the median tile side may miss what was asked for."""

AIM, HOPELESS = 0.08, 0.3
"""Misses between these are worth another try with edges corrected by them. Larger ones come from thin parts."""

MOST_TRIES = 3
"""Times that triangles are made."""

EDGE_OF_TILE = 2.54
"""Edge of an equilateral triangle over the mean side of the three tiles that it, or its dual, is divided into."""

FINE = 0.7
"""Edge length, in tile sides, of the triangles on which everything is done instead of on the input's own."""

FEWEST_FINE = 16_000
"""There are at least about so many of these, so that the shape is known well where tiles are large."""

MOST_INPUT = 40_000
"""Inputs with more triangles than this, and than twice as many as the fine ones, are decimated first."""

REACH, QUADRIFLOW_REACH = 1.0, 2.0
"""How far from its cells a surface may be, in tile sides. QuadriFlow cuts off more, and has no finer cells there."""

ATTEMPTS = ((1.0, 0), (1.0, 1), (1.0, 2), (1.3, 0), (1.3, 1))
"""What QuadriFlow is asked for in turn: times the number of quads that gives the size, and seeds after the first."""

FINER_ATTEMPTS = ((1.7, 0), (2.5, 0))
"""The same where the size cannot be had anyway."""


@dataclass(frozen=True, eq=False)
class Remeshed:
    """New cells, and what a user should know about them: nothing where all is as asked for.

    Attributes
    ----------
    mesh : PolygonMesh
        One closed surface, faces outward, mm.
    notes : tuple of str
        Sentences.
    """

    mesh: PolygonMesh
    notes: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class _Task:
    """A surface as fine, even triangles, its genus, and what is asked for."""

    surface: TriangleMesh
    handles: int
    tile_size: float
    seed: int
    progress: Callable[[str], None]

    def miss(self, cells: PolygonMesh) -> float:
        """Return by which share the median tile side is too long, negative when it is too short."""
        return float(np.median(tile_sides(cells))) / self.tile_size - 1.0


def remeshed(
    mesh: PolygonMesh,
    *,
    cells: Cells,
    tile_size: float,
    seed: int,
    crease: float | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> Remeshed:
    """Return cells on a surface that become tiles of the size asked for in one Catmull-Clark step.

    The median over all tiles of their mean side is within 15 % of `tile_size`, unless that would lose parts of
    the body; where it is thin or bent, cells may be smaller. The genus stays, and the cells don't cross each other.
    What cannot be had is said in the notes. The same input and seed give the same cells.

    Parameters
    ----------
    mesh : PolygonMesh
        One closed, orientable surface, mm.
    cells : {"quads", "triangles", "hexagons"}
        Quads come from QuadriFlow; where it fails, triangles take their place. Hexagons are the dual of triangles,
        with pentagons and heptagons among them.
    tile_size : float
        Mean side of a tile, mm.
    seed : int
        Another seed, 0 or more, gives other cells.
    crease : float, optional
        Triangles keep edges at which the surface turns by so many degrees or more, and these are creases of theirs.
    progress : callable
        Told what begins.

    Raises
    ------
    MeshError
        If the mesh is not one closed surface.
    PrepareError
        If the tile size is not positive, larger than the body, so small that there would be too many tiles, or so
        large that there would be too few for the handles; or if a surface comes out that is not closed or has
        another genus.
    """
    mesh = checked_closed(mesh)
    triangles, handles = fanned(mesh), genus(mesh)
    _check_tile_size(triangles, tile_size)
    _check_handles(triangles, handles, tile_size)
    progress("sampling the surface")
    task = _Task(_fine(triangles, tile_size, seed), handles, tile_size, seed, progress)
    made = _quads(task) if cells == "quads" else Remeshed(_triangular(task, cells), ())
    found = _checked(task, made.mesh)
    if crease is not None and cells == "triangles":
        found = sharpened(fanned(found), triangles, angle=crease)
    return Remeshed(found, (*made.notes, *_shortcomings(task, found, mesh)))


def _check_tile_size(mesh: TriangleMesh, tile_size: float) -> None:
    extent = float(np.ptp(mesh.points, axis=0).max())
    if not 0.0 < tile_size <= extent:
        raise PrepareError(
            f"a tile size must be positive and no larger than the body, which is {extent:.4g} mm long; "
            f"found {tile_size:g} mm"
        )
    tiles = mesh.area / tile_size**2
    if tiles > MOST_TILES:
        raise PrepareError(
            f"tiles of {tile_size:g} mm would be about {tiles:.0f}, and at most {MOST_TILES} can be remeshed; "
            "ask for a larger pattern.tile_size"
        )


def _check_handles(mesh: TriangleMesh, handles: int, tile_size: float) -> None:
    fewest = TILES_OF_HANDLE * (handles - 1)
    if mesh.area < fewest * tile_size**2:
        extent = float(np.ptp(mesh.points, axis=0).max())
        largest = float(np.sqrt(mesh.area / fewest))
        raise PrepareError(
            f"a surface with {handles} handles needs at least {fewest} tiles, and with tiles of {tile_size:.3g} mm "
            f"there is room for {mesh.area / tile_size**2:.0f} on a body of {extent:.4g} mm: ask for a source.size of "
            f"at least {np.ceil(extent * tile_size / largest):.0f} mm, or a pattern.tile_size of at most "
            f"{0.995 * largest:.3g} mm"
        )


def _fine(mesh: TriangleMesh, tile_size: float, seed: int) -> TriangleMesh:
    """Return even triangles on the surface, well below the size of cells."""
    of_length_one = np.sqrt(3.0) / 4.0
    length = min(FINE * tile_size, float(np.sqrt(mesh.area / (of_length_one * FEWEST_FINE))))
    expected = mesh.area / (of_length_one * length**2)
    start = decimated(mesh, triangles=max(MOST_INPUT, int(2 * expected)))
    return isotropic(SizingField.even(start, length=length), start=start, seed=seed)


def _quads(task: _Task) -> Remeshed:
    """Return quads of the size asked for, or else triangles, or else smaller quads, or else smaller triangles."""
    quads = _first_quads(task, ATTEMPTS, tolerance=TOLERANCE) if quadriflow_exists() else None
    if quads is not None:
        return Remeshed(quads, ())
    triangles = _triangular(task, "triangles")
    if quadriflow_exists() and abs(task.miss(triangles)) > TOLERANCE:
        quads = _first_quads(task, FINER_ATTEMPTS, tolerance=np.inf)
    if quads is not None:
        return Remeshed(quads, ())
    reason = "found no sound quads of this size" if quadriflow_exists() else "is not installed"
    return Remeshed(triangles, (f"QuadriFlow {reason}: the cells are triangles instead of quads",))


def _first_quads(task: _Task, attempts: Sequence[tuple[float, int]], *, tolerance: float) -> PolygonMesh | None:
    """Return the first quads that are sound, near to the surface and of the right size, or None."""
    faces = task.surface.area / (2.0 * task.tile_size) ** 2
    for number, (times, seeds) in enumerate(attempts):
        task.progress(f"making quads, attempt {number + 1}")
        quads = quadriflow(task.surface, faces=max(int(times * faces), 6), seed=task.seed + seeds)
        if quads is None or fault(quads, handles=task.handles) is not None or abs(task.miss(quads)) > tolerance:
            continue
        if len(bridges(quads, task.surface, span=2.0 * task.tile_size)):
            continue
        if not lost(quads, task.surface, reach=QUADRIFLOW_REACH * task.tile_size).any():
            return quads
    return None


def _triangular(task: _Task, cells: Literal["triangles", "hexagons"]) -> PolygonMesh:
    """Return triangles or their dual, of all that are made those whose tiles are nearest to the size asked for."""
    length, made = EDGE_OF_TILE * task.tile_size, list[PolygonMesh]()
    for number in range(MOST_TRIES):
        task.progress(f"making {cells}, attempt {number + 1}")
        made.append(
            fitted(
                task.surface,
                length=length,
                reach=REACH * task.tile_size,
                cells_of=_CELLS_OF[cells],
                seed=task.seed,
            )
        )
        miss = task.miss(made[-1])
        if not AIM < abs(miss) < HOPELESS:
            break
        length /= 1.0 + miss
    return min(made, key=lambda found: (len(crossing_faces(found)), abs(task.miss(found))))


_CELLS_OF: Mapping[str, Callable[[TriangleMesh], PolygonMesh]] = MappingProxyType(
    {"triangles": lambda triangles: triangles.polygons, "hexagons": lambda triangles: dual(triangles.polygons)}
)


def _checked(task: _Task, cells: PolygonMesh) -> PolygonMesh:
    """Return the cells, faces outward, if they are one closed surface of the same genus."""
    wrong = topology_fault(cells, handles=task.handles)
    if wrong is not None:
        raise PrepareError(f'remeshing failed: {wrong}; ask for a smaller pattern.tile_size, or for cells = "as-is"')
    return checked_closed(cells)


def _shortcomings(task: _Task, cells: PolygonMesh, given: PolygonMesh) -> tuple[str, ...]:
    """Return a sentence for each thing about the cells that is not as asked for."""
    notes = []
    tile = (1.0 + task.miss(cells)) * task.tile_size
    if tile < (1.0 - TOLERANCE) * task.tile_size:
        notes.append(f"the median tile is {tile:.3g} mm, not {task.tile_size:g} mm: larger ones would lose thin parts")
    if tile > (1.0 + TOLERANCE) * task.tile_size:
        notes.append(f"the median tile is {tile:.3g} mm, not {task.tile_size:g} mm")
    reach = QUADRIFLOW_REACH * task.tile_size
    missing = lost(cells, task.surface, reach=reach)
    if missing.any():
        notes.append(f"{missing.mean():.2%} of the surface is more than {reach:g} mm away from its cells")
    crossing = len(crossing_faces(cells))
    if crossing:
        before = len(crossing_faces(given))
        notes.append(
            f"{crossing} triangles of the cells cross each other" + f", as do {before} of the input" * (before > 0)
        )
    return tuple(notes)
