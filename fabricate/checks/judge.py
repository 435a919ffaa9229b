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
from fabricate.checks.fit import whole_check
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
from fabricate.checks.survey import Survey, surveyed, surveys_beside
from fabricate.checks.topology import Topology, topology
from fabricate.checks.walls import Walls
from fabricate.errors import ReadError
from fabricate.formats.limits import ReadLimits
from fabricate.formats.reading import read_mesh
from fabricate.solid.part import Part
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
class _Measured:
    """A part and what others are measured with, built once."""

    part: Part
    topology: Topology
    vectors: Floats
    manifold: Manifold
    tree: SearchTree

    @classmethod
    def of(cls, part: Part, expectations: Expectations) -> _Measured:
        return cls(
            part,
            topology(part, expected_genus=expectations.genus.get(part.name)),
            area_vectors(part.points, part.triangles),
            as_manifold(part),
            SearchTree.of(part.points, part.triangles),
        )

    def surveyed(self) -> Survey:
        return surveyed(self.part, self.tree, self.vectors)


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
    with surveys_beside(parts) as awaited:
        measured = [_Measured.of(part, expectations) for part in parts]
        together = _judged_together(measured, expectations) if len(measured) > 1 else None
        surveys = awaited() or [each.surveyed() for each in measured]
    walls = {part.name: survey.walls for part, survey in zip(parts, surveys, strict=True)}
    judged = [_judged_part(each, survey, expectations) for each, survey in zip(measured, surveys, strict=True)]
    checks = [check for each in judged for check in each.checks]
    necks = _necks(walls, together.joints) if together else {}
    checks += [part_neck_check(name, neck, process=expectations.process) for name, neck in necks.items()]
    if together:
        volumes = {part.name: each.facts.volume_mm3 for part, each in zip(parts, judged, strict=True)}
        checks += (*together.checks, whole_check("fit.whole", volumes, expectations.spaces))
    clearance, process = expectations.clearance, expectations.process
    checks.append(process_gap_check(clearance, process=process))
    checks.append(neck_check(expectations.neck, clearance=clearance, process=process))
    if expectations.band is not None:
        checks.append(band_check(expectations.band, clearance=clearance, process=process))
    facts = MappingProxyType(
        {part.name: replace(each.facts, neck_mm=necks.get(part.name)) for part, each in zip(parts, judged, strict=True)}
    )
    checks += shop_checks(parts, facts, walls, expectations.shop)
    return Judgement(facts, together.facts if together else None, tuple(checks))


def judged_alone(part: Part, expectations: Expectations) -> JudgedAlone:
    """Measure one part and check what can be said of it by itself: the codes that begin with PART above."""
    measured = _Measured.of(part, expectations)
    return _judged_part(measured, measured.surveyed(), expectations)


def _check_names(parts: Sequence[Part]) -> None:
    if not parts:
        raise ReadError("at least one part was expected, found none")
    name, count = Counter(part.name for part in parts).most_common(1)[0]
    if count > 1:
        raise ReadError(f"parts with different names were expected, found {count} named '{name}'; rename one")


def _judged_part(measured: _Measured, survey: Survey, expectations: Expectations) -> JudgedAlone:
    part, connected, walls = measured.part, measured.topology, survey.walls
    volume = enclosed_volume(part, measured.vectors)
    facts = PartFacts(
        file=f"{part.name}.stl",
        triangles=len(part.triangles),
        volume_mm3=volume,
        area_mm2=area(measured.vectors),
        genus=connected.genus,
        components=connected.components,
        watertight=connected.watertight,
        self_intersections=len(survey.crossing),
        wall_mm=walls.spread,
        neck_mm=None,
    )
    checks = (
        *connected.checks,
        volume_check(part, volume),
        self_intersection_check(part, survey.crossing),
        manifold_check(part, measured.manifold, volume=volume),
        wall_check(part, walls, process=expectations.process),
    )
    return JudgedAlone(facts, checks)


def _judged_together(measured: Sequence[_Measured], expectations: Expectations) -> Fit:
    solids = {
        each.part.name: Solid(each.part, each.manifold, each.tree) for each in measured if is_solid(each.manifold)
    }
    return fit([each.part for each in measured], solids, expectations)


def _necks(walls: Mapping[str, Walls], joints: Mapping[str, Sequence[Facing]]) -> dict[str, Narrowest | None]:
    """Return the narrowest neck of each part by its name; None where it has none or nothing is known of its joints."""
    return {name: narrowest_neck(measured, joints.get(name, ())) for name, measured in walls.items()}
