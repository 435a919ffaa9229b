"""Judging a fit coupon as its file holds it: one plate, the pieces loose in it, and the gap around each of them.

The codes of its checks, where LABEL is what stands on the plate and KIND "neck" or "bend":

    coupon.closed, coupon.oriented, coupon.vertex_manifold, coupon.nondegenerate, coupon.self_intersections
                      as of any part, of all solids together
    coupon.pieces     it is the plate and one piece in each window
    coupon.flat       each of them lies on the build plate
    coupon.LABEL.KIND.gap
                      the smallest gap around the piece is at least 95 % of the clearance it is labelled with
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from fabricate.arrays import Indices
from fabricate.checks.check import Check
from fabricate.checks.contacts import Facing
from fabricate.checks.facts import Gap, Narrowest, Xyz
from fabricate.checks.fit import gap_check
from fabricate.checks.gap import Spacing, smallest_gap
from fabricate.checks.geometry import as_manifold, is_solid, self_intersection_check, signed_volume
from fabricate.checks.judge import read_part
from fabricate.checks.necks import narrowest_neck
from fabricate.checks.topology import (
    Edges,
    closed_check,
    component_labels,
    nondegenerate_check,
    oriented_check,
    vertex_manifold_check,
)
from fabricate.checks.walls import walls
from fabricate.checks.wording import counted
from fabricate.region_names import region_names
from fabricate.solid.coupon import Coupon, CouponPiece, label
from fabricate.solid.coupon_window import CouponWindow
from fabricate.solid.part import Part
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.normals import area_vectors
from fabricate.triangles.search_tree import SearchTree


@dataclass(frozen=True)
class CouponPlaceFacts:
    """A place of the sculpture that the coupon shows.

    Attributes
    ----------
    region : str
        Name of the region of which a piece is loose.
    at : (x, y, z)
        Where it is on the sculpture, mm.
    size_mm : float
        Width of the neck before clearance is taken off, or radius of the bend.
    wanted_mm : float
        Width of the narrowest neck of all, or radius of the bend nearest to the median: the same, unless no piece
        with a flat back could be cut out there.
    window_mm : float
        Diameter of the window.
    depth_mm : float
        How much of the wall's thickness the coupon has at that place.
    """

    region: str
    at: Xyz
    size_mm: float
    wanted_mm: float
    window_mm: float
    depth_mm: float


@dataclass(frozen=True)
class CouponPieceFacts:
    """A piece that is loose in the plate.

    Attributes
    ----------
    label : str
        What stands on the plate.
    kind : {"neck", "bend"}
    clearance_mm : float
    volume_mm3 : float or None
    gap_mm : Gap or None
        The smallest distance to the plate; None where that could not be measured.
    neck_mm : Narrowest or None
        The narrowest place between two of its walls that face the plate; None where there is none.
    """

    label: str
    kind: str
    clearance_mm: float
    volume_mm3: float | None
    gap_mm: Gap | None
    neck_mm: Narrowest | None


@dataclass(frozen=True, eq=False)
class JudgedCoupon:
    """Facts and checks of a fit coupon.

    Attributes
    ----------
    triangles : int
    size_mm : (x, y, z)
    neck, bend : CouponPlaceFacts
    pieces : tuple of CouponPieceFacts
    checks : tuple of Check
    """

    triangles: int
    size_mm: Xyz
    neck: CouponPlaceFacts
    bend: CouponPlaceFacts
    pieces: tuple[CouponPieceFacts, ...]
    checks: tuple[Check, ...]


def judged_coupon(path: Path, coupon: Coupon) -> JudgedCoupon:
    """Read a coupon's STL file and judge what is in it.

    Raises
    ------
    ReadError
        If the file is missing or damaged.
    """
    part = read_part(path)
    edges = Edges.of(part)
    solids = _solids(part, component_labels(part, edges))
    plate, *loose = sorted(solids, key=lambda each: -float(np.prod(np.ptp(each.points, axis=0))))
    found = [_piece(piece, plate, loose) for piece in coupon.pieces]
    x, y, z = (float(value) for value in np.ptp(part.points, axis=0))
    neck, bend = (
        _place_facts(coupon, next(piece.window for piece in coupon.pieces if piece.window.place.kind == kind))
        for kind in ("neck", "bend")
    )
    return JudgedCoupon(
        triangles=len(part.triangles),
        size_mm=(x, y, z),
        neck=neck,
        bend=bend,
        pieces=tuple(facts for facts, _ in found),
        checks=(
            closed_check(part, edges),
            oriented_check(part, edges),
            vertex_manifold_check(part, edges),
            nondegenerate_check(part),
            self_intersection_check(part, crossing_triangles(part.points, part.triangles)),
            _pieces_check(part.name, solids, expected=1 + len(coupon.pieces)),
            _flat_check(part.name, solids),
            *(check for _, check in found),
        ),
    )


def _solids(part: Part, labels: Indices) -> list[Part]:
    """Return the connected pieces of a part, each as a part."""
    solids = []
    for number in range(int(labels.max(initial=-1)) + 1):
        used, triangles = np.unique(part.triangles[labels == number], return_inverse=True)
        solids.append(Part(part.name, part.points[used], triangles.reshape(-1, 3)))
    return solids


def _piece(piece: CouponPiece, plate: Part, loose: Sequence[Part]) -> tuple[CouponPieceFacts, Check]:
    """Return the facts of the solid in one window, and the check of the gap around it."""
    kind, text = piece.window.place.kind, label(piece.clearance)
    code, clearance = f"coupon.{text}.{kind}.gap", piece.clearance
    own = [each for each in loose if _within(each, piece)]
    solids = [as_manifold(each) for each in (plate, *own[:1])]
    if len(own) != 1 or not all(map(is_solid, solids)):
        message = (
            f"the gap around the {kind} at {text} mm was not measured, because there is not one solid in its window"
        )
        facts = CouponPieceFacts(text, kind, clearance, None, None, None)
        return facts, Check(code, ok=False, skipped=True, message=message)
    (part,) = own
    named = Part(f"the {kind} at {text} mm", part.points, part.triangles)
    around = Part("the plate", plate.points, plate.triangles)
    tree, plate_tree = (SearchTree.of(each.points, each.triangles) for each in (named, around))
    spacing = Spacing.between(tree, plate_tree, clearance=clearance)
    gap = smallest_gap(spacing, solids[1], solids[0], clearance=clearance)
    joint = Facing.between(tree, plate_tree, spacing.to_second, clearance=clearance)
    measured = walls(named, tree, area_vectors(named.points, named.triangles))
    neck = narrowest_neck(measured, [joint])
    facts = CouponPieceFacts(text, kind, clearance, signed_volume(named), gap, neck)
    return facts, gap_check(code, named, around, gap, clearance=clearance)


def _within(part: Part, piece: CouponPiece) -> bool:
    """Tell whether all of a part lies in the window of a piece."""
    away = np.hypot(*(part.points[:, :2] - piece.middle).T)
    return bool(away.max() < piece.window.radius)


def _pieces_check(name: str, solids: Sequence[Part], *, expected: int) -> Check:
    return Check(
        f"{name}.pieces",
        ok=len(solids) == expected,
        message=f"{name} must be a plate with {counted(expected - 1, 'loose piece')}, {expected} solids, "
        f"and it is {len(solids)}",
    )


def _flat_check(name: str, solids: Sequence[Part]) -> Check:
    lowest = [each.points[each.points[:, 2].argmin()] for each in solids]
    wrong = [point for point in lowest if point[2] != 0.0]
    return Check(
        f"{name}.flat",
        ok=not wrong,
        message=f"each solid of {name} must lie on the build plate, z = 0, and {len(wrong)} of {len(solids)} do not",
        where=np.reshape(wrong, (-1, 3)),
    )


def _place_facts(coupon: Coupon, window: CouponWindow) -> CouponPlaceFacts:
    place = window.place
    x, y, z = (float(value) for value in place.at)
    return CouponPlaceFacts(
        region=region_names(coupon.regions)[place.region],
        at=(x, y, z),
        size_mm=place.size,
        wanted_mm=coupon.wanted[place.kind],
        window_mm=2.0 * window.radius,
        depth_mm=window.depth,
    )
