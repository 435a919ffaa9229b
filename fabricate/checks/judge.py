"""Judging a set of finished parts: every fact, every check, never stopping at the first fault.

The codes of all checks, which other programs may rely on; PART stands for the name of each part:

    PART.closed              every edge has exactly two triangles
    PART.oriented            the two run along it in opposite directions
    PART.vertex_manifold     the triangles at each vertex are one fan
    PART.components          the part is one piece
    PART.nondegenerate       every triangle has an area
    PART.genus               it has the number of handles that its region asks for
    PART.volume              its volume is positive
    PART.self_intersections  no triangles cross (exact)
    PART.manifold            Manifold takes it as a solid of the same volume
    PART.wall                its thinnest wall is thick enough for the process
    PART.neck                its narrowest neck, between two walls that face other parts, is wide enough too
    FIT.overlap              two parts have no volume in common
    FIT.gap                  the smallest gap between them is at least 95 % of the clearance; with a clearance of 0
                             they share faces, if they face each other
    FIT.gap_max              along the joint's mid-line it is at most 1.3 times the clearance,
    FIT.mobility             and they are captive, separable or fused, as they should be: of more than two parts,
                             these two are judged of those that face each other
    fit.whole                volumes of the parts and the gap add up to the uncut shell
    fit.process_gap          the process keeps the clearance open
    pattern.neck             necks are wide enough for the process
    pattern.band             so are the bands of a multitone

    shop.polygons            the print shop accepts the number of triangles,
    shop.file                the size of the files,
    shop.box                 the bounding box
    shop.wall.PART           and the thinnest wall of each part

FIT is "fit" for two parts, and "fit.FIRST-SECOND" with their names for each pair of more, which add `fit.joined`: that
all are joined by neighbours. A single part has
no fit.* checks but `fit.process_gap`, only a pattern that is known to have bands has `pattern.band`, and there are
shop.* checks only of the limits that a shop has. What is not known or could not be measured is skipped, not left out.
A run that was asked for an area share adds `pattern.area_share` (see `checks.share`), one for openings
`finish.openings` where the process needs them (see `checks.draining`), and one with a wire the PART.* checks of "wire".
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from manifold3d import Manifold

from fabricate.arrays import Floats, Indices
from fabricate.checks.check import Check
from fabricate.checks.contacts import Facing
from fabricate.checks.expectations import Expectations
from fabricate.checks.facts import FitFacts, Narrowest, PartFacts
from fabricate.checks.geometry import (
    area,
    as_manifold,
    enclosed_volume,
    is_solid,
    manifold_check,
    self_intersection_check,
    volume_check,
)
from fabricate.checks.necks import narrowest_neck
from fabricate.checks.pairs import Fit, Solid, fit
from fabricate.checks.printability import band_check, neck_check, part_neck_check, process_gap_check, wall_check
from fabricate.checks.shop import shop_checks
from fabricate.checks.topology import topology
from fabricate.checks.walls import Walls, walls
from fabricate.errors import ReadError
from fabricate.formats.limits import ReadLimits
from fabricate.formats.reading import read_mesh
from fabricate.solid.part import Part
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.normals import area_vectors
from fabricate.triangles.search_tree import SearchTree

PART_LIMITS = ReadLimits(max_bytes=4 << 30, max_faces=20_000_000)
"""More than the finest tessellation that is made gives a part, in text as well."""


@dataclass(frozen=True, eq=False)
class Judgement:
    """Facts of each part by name, facts of their fit (None for a single part), and all checks."""

    parts: Mapping[str, PartFacts]
    fit: FitFacts | None
    checks: tuple[Check, ...]


class JudgedAlone(NamedTuple):
    """Facts and checks of a part that goes together with no others."""

    facts: PartFacts
    checks: tuple[Check, ...]


@dataclass(frozen=True, eq=False)
class _JudgedPart:
    part: Part
    manifold: Manifold
    tree: SearchTree
    walls: Walls
    facts: PartFacts
    checks: tuple[Check, ...]


def read_part(path: Path) -> Part:
    """Read a part from a binary or text STL file; corners with equal coordinates become one point.

    The part is named after the file, without its extension. Nothing is repaired. Numbers in text are rounded
    to float32, which all programs that print hold them in, before corners are compared.

    Raises
    ------
    ReadError
        If the file is missing, is no mesh of triangles, is damaged or holds unusable numbers.
    """
    mesh = read_mesh(path, limits=PART_LIMITS)
    if (mesh.face_sizes != 3).any():
        largest = mesh.face_sizes.max()
        raise ReadError(f"{path}: a mesh of triangles was expected, found a face with {largest} corners")
    points, numbers = _stored(mesh.points)
    return Part(path.stem, points, numbers[mesh.corners].reshape(-1, 3))


def _stored(points: Floats) -> tuple[Floats, Indices]:
    """Return points as float32 holds them, each once, and the number that each point has got."""
    stored = points.astype(np.float32).astype(np.float64)
    if np.array_equal(stored, points):
        return stored, np.arange(len(points))
    return np.unique(stored, axis=0, return_inverse=True)


def judged_parts(parts: Sequence[Part], expectations: Expectations) -> Judgement:
    """Measure parts and check them, each by itself and each pair; the codes are listed above.

    Parameters
    ----------
    parts : sequence of Part
        At least one, with different names and finite coordinates, as `read_part` returns them.
    expectations : Expectations
        What they should be.

    Raises
    ------
    ReadError
        If there are no parts, or two have the same name.
    """
    _check_names(parts)
    judged = [_judged_part(part, expectations) for part in parts]
    checks = [check for each in judged for check in each.checks]
    together = _judged_together(judged, expectations) if len(judged) > 1 else None
    necks = _necks(judged, together.joints) if together else {}
    checks += [part_neck_check(name, neck, process=expectations.process) for name, neck in necks.items()]
    checks += together.checks if together else ()
    clearance, process = expectations.clearance, expectations.process
    checks.append(process_gap_check(clearance, process=process))
    checks.append(neck_check(expectations.neck, clearance=clearance, process=process))
    if expectations.band is not None:
        checks.append(band_check(expectations.band, clearance=clearance, process=process))
    facts = MappingProxyType(
        {each.part.name: replace(each.facts, neck_mm=necks.get(each.part.name)) for each in judged}
    )
    checks += shop_checks(parts, facts, {each.part.name: each.walls for each in judged}, expectations.shop)
    return Judgement(facts, together.facts if together else None, tuple(checks))


def judged_alone(part: Part, expectations: Expectations) -> JudgedAlone:
    """Measure one part and check what can be said of it by itself: the codes that begin with PART above."""
    judged = _judged_part(part, expectations)
    return JudgedAlone(judged.facts, judged.checks)


def _check_names(parts: Sequence[Part]) -> None:
    if not parts:
        raise ReadError("at least one part was expected, found none")
    name, count = Counter(part.name for part in parts).most_common(1)[0]
    if count > 1:
        raise ReadError(f"parts with different names were expected, found {count} named '{name}'; rename one")


def _judged_part(part: Part, expectations: Expectations) -> _JudgedPart:
    connected = topology(part, expected_genus=expectations.genus.get(part.name))
    vectors = area_vectors(part.points, part.triangles)
    volume, manifold = enclosed_volume(part, vectors), as_manifold(part)
    tree = SearchTree.of(part.points, part.triangles)
    measured = walls(part, tree, vectors)
    crossing = crossing_triangles(part.points, part.triangles)
    facts = PartFacts(
        file=f"{part.name}.stl",
        triangles=len(part.triangles),
        volume_mm3=volume,
        area_mm2=area(vectors),
        genus=connected.genus,
        components=connected.components,
        watertight=connected.watertight,
        self_intersections=len(crossing),
        wall_mm=measured.spread,
        neck_mm=None,
    )
    checks = (
        *connected.checks,
        volume_check(part, volume),
        self_intersection_check(part, crossing),
        manifold_check(part, manifold, volume=volume),
        wall_check(part, measured, process=expectations.process),
    )
    return _JudgedPart(part, manifold, tree, measured, facts, checks)


def _judged_together(judged: Sequence[_JudgedPart], expectations: Expectations) -> Fit:
    solids = {each.part.name: Solid(each.part, each.manifold, each.tree) for each in judged if is_solid(each.manifold)}
    return fit([each.part for each in judged], solids, expectations)


def _necks(judged: Sequence[_JudgedPart], joints: Mapping[str, Sequence[Facing]]) -> dict[str, Narrowest | None]:
    """Return the narrowest neck of each part by its name; None where it has none or nothing is known of its joints."""
    return {each.part.name: narrowest_neck(each.walls, joints.get(each.part.name, ())) for each in judged}
