"""Facts about the surface and the pattern on it, for the report and for what the parts are expected to be."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import pairwise
from types import MappingProxyType

import numpy as np

from fabricate.arrays import Floats
from fabricate.checks.expectations import Band, Expectations, Neck
from fabricate.checks.facts import Chords, Distance, MeshFacts, PatternFacts, Spaces, Spread, Xyz
from fabricate.checks.geometry import signed_volume
from fabricate.config import ShopConfig
from fabricate.design.area_share import area_shares
from fabricate.design.designed import Design
from fabricate.duotone.certificate import Certificate, RegionFacts
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.tile_locks import TileLocks
from fabricate.mesh.closed import genus
from fabricate.prepare.prepared import Prepared
from fabricate.prepare.tile_quality import tile_quality
from fabricate.prepare.triangle_mesh import TriangleMesh
from fabricate.process import Process
from fabricate.region_names import region_names
from fabricate.solid.assembly import Assembly, Core
from fabricate.surface.cut import CutSurface
from fabricate.surface.deviation import deviation
from fabricate.surface.limit import LimitSurface
from fabricate.surface.neck import band_widths, tile_necks
from fabricate.surface.resolution import SHARE_WITHIN, chord_errors
from fabricate.surface.sizing import typical_side
from fabricate.surface.tiling import Tiling


def mesh_facts(body: Prepared, tiling: Tiling, surface: CutSurface, chords: Chords | None = None) -> MeshFacts:
    """Return what is known of the mesh that was divided, and of the finished outer surface with its chord error."""
    x, y, z = (float(side) for side in np.ptp(surface.points, axis=0))
    return MeshFacts(
        vertices=len(body.mesh.points),
        faces=len(body.mesh.offsets) - 1,
        genus=genus(body.mesh),
        size_mm=(x, y, z),
        repairs=MappingProxyType({action.name: action.count for action in body.actions}),
        notes=body.notes + tiling.notes,
        chord_mm=chords,
        distance_mm=None if tiling.surface is None else _distance(tiling.surface, surface),
    )


def chords(duotone: Duotone, surface: CutSurface, *, asked: float) -> Chords:
    """Measure the chord error of a surface that should have kept `asked`, mm."""
    resolution = surface.rays.shape[1] - 1
    limit = LimitSurface.of(duotone.quads)
    errors = chord_errors(duotone, limit, rings=surface.rings.tolist(), resolution=resolution)
    return Chords(asked, float(np.quantile(errors, SHARE_WITHIN)), float(errors.max()))


def _distance(whole: TriangleMesh, surface: CutSurface) -> Distance:
    found = deviation(surface.points, surface.triangles, whole.points, whole.triangles)
    x, y, z = (float(value) for value in found.at)
    return Distance(found.mean, found.p999, found.max, (x, y, z))


def pattern_facts(design: Design, certificate: Certificate, surface: CutSurface) -> PatternFacts:
    """Return what was counted and measured of the pattern on the cut surface."""
    duotone, locks = design.duotone, design.locks
    shares = area_shares(surface)
    curves = surface.points[surface.curves]
    length = float(np.linalg.norm(np.roll(curves, -1, axis=1) - curves, axis=2).sum())
    names = region_names(len(certificate.regions))
    bands = [_spread(widths) for widths, _ in band_widths(surface)]
    return PatternFacts(
        tiles=len(duotone.joined),
        tile_size_mm=typical_side(duotone.quads),
        tile_quality=tile_quality(duotone.quads.points[duotone.quads.tiles]),
        curves=certificate.curves,
        regions=sum(region.components for region in certificate.regions),
        curve_length_mm=length,
        arc=float(surface.rings[0]) if len(surface.rings) == 1 else None,
        area_share=MappingProxyType(dict(zip(names, shares.tolist(), strict=True))),
        handles=MappingProxyType({name: region.handles for name, region in _named(certificate)}),
        neck_mm=_spread(tile_necks(surface)[0]),
        band_mm=MappingProxyType(dict(zip(names[1:-1], bands, strict=True))),
        alignment=design.alignment,
        locked=None if locks is None else _locked(locks),
        objectives=MappingProxyType(dict(design.objectives)),
        notes=design.notes,
    )


def _named(certificate: Certificate) -> Iterable[tuple[str, RegionFacts]]:
    return zip(region_names(len(certificate.regions)), certificate.regions, strict=True)


def _spread(widths: Floats) -> Spread:
    return Spread(float(widths.min()), float(np.median(widths)))


def _locked(locks: TileLocks) -> Mapping[str, int]:
    return MappingProxyType({"yellow": int(locks.yellow.sum()), "blue": int(locks.blue.sum())})


def expectations(
    surface: CutSurface,
    solids: Assembly,
    certificate: Certificate,
    *,
    clearance: float,
    core: Core,
    tolerance: float | None = None,
    process: Process | None = None,
    shop: ShopConfig | None = None,
) -> Expectations:
    """Return what the parts of these solids should be, when they are read back from their files."""
    gap, shell = map(signed_volume, solids.spaces)
    return Expectations(
        clearance=clearance,
        genus=expected_genus({name: region.handles for name, region in _named(certificate)}, core=core),
        process=process,
        shop=shop,
        neck=Neck(*_narrowest(tile_necks(surface))),
        band=_narrowest_band(surface),
        spaces=Spaces(gap, shell),
        tolerance=tolerance,
        middles={
            f"{first}-{second}": solids.middles(curve, region)
            for region, (curve, (first, second)) in enumerate(
                zip(surface.curves, pairwise(region_names(len(surface.curves) + 1)), strict=True)
            )
        },
    )


def _narrowest_band(surface: CutSurface) -> Band | None:
    names = region_names(len(surface.rings) + 1)[1:-1]
    measured = zip(names, band_widths(surface), np.diff(surface.rings).tolist(), strict=True)
    bands = [Band(name, *_narrowest(widths), spacing) for name, widths, spacing in measured]
    return min(bands, key=lambda band: band.width, default=None)


def _narrowest(measured: tuple[Floats, Floats]) -> tuple[float, Xyz]:
    """Return the smallest of some widths, (t,), and where it is, of places (t, 3)."""
    widths, places = measured
    x, y, z = (float(value) for value in places[widths.argmin()])
    return float(widths.min()), (x, y, z)


def expected_genus(handles: Mapping[str, int], *, core: Core) -> dict[str, int]:
    """Return the handles of each solid, from those of its region, by name.

    A region thickened is bounded by two copies of itself, joined along each of its boundary circles: twice its handles,
    and one more for a band, which has two such circles. A part with a core is bounded by its own region and a copy of
    all the others: the genus of the whole.
    """
    ends = ("yellow", "blue")
    return {
        name: sum(handles.values()) if name == core else 2 * own + (0 if name in ends else 1)
        for name, own in handles.items()
    }
