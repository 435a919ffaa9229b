"""What is measured of a mesh, a pattern, a part and a fit; field names are the keys of report.json."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from fabricate.design.optimising import Change
from fabricate.prepare.tile_quality import TileQuality
from fabricate.solid.joint import JointKind

Xyz: TypeAlias = tuple[float, float, float]
"""A point, or three lengths along the axes, mm."""

Verdict: TypeAlias = Literal["captive", "separable", "fused"]
"""Whether two rigid parts are caught in each other, come apart, or share faces and are one."""


@dataclass(frozen=True)
class Spread:
    """The smallest and the median of many lengths, mm."""

    min: float
    median: float


@dataclass(frozen=True)
class Gap:
    """The distance between parts, mm.

    Attributes
    ----------
    min : float
        The smallest one.
    at : (x, y, z) or None
        Where it is; no place where parts touch on purpose.
    queried : float or None
        The smallest one that distance queries found on their own; None where parts touch or overlap.
    max : float or None
        The largest one along the joint's mid-line; None where that is not known.
    max_at : (x, y, z) or None
        Where that is.
    """

    min: float
    at: Xyz | None
    queried: float | None = None
    max: float | None = None
    max_at: Xyz | None = None


@dataclass(frozen=True)
class Narrowest:
    """The smallest of many widths, mm, and where it is."""

    min: float
    at: Xyz


@dataclass(frozen=True)
class Play:
    """How far one part can move from its seat, mm, to first order; inf where nothing stops it.

    Attributes
    ----------
    x, y, z : float
        Way from the seat, where it was modelled, to the farther of the two stops along each axis.
    rx, ry, rz : float
        The same for turning about each axis, as the way of a point as far from the pivot as the part's
        farthest one.
    """

    x: float
    y: float
    z: float
    rx: float
    ry: float
    rz: float


@dataclass(frozen=True)
class Witness:
    """A few contacts that between them stop every motion of the first part of a pair.

    Attributes
    ----------
    points : tuple of (x, y, z)
        On the first part, mm.
    normals : tuple of (x, y, z)
        Unit vectors from there towards the second part.
    """

    points: tuple[Xyz, ...]
    normals: tuple[Xyz, ...]


@dataclass(frozen=True)
class Distance:
    """How far places of one surface are from another, mm: mean, what 99.9 % keep, largest, and where that is."""

    mean: float
    p999: float
    max: float
    at: Xyz


@dataclass(frozen=True)
class Chords:
    """The chord error of triangles, mm: what was asked for, what 99 % of the edges keep, and the largest."""

    asked: float
    p99: float
    max: float


@dataclass(frozen=True)
class MeshFacts:
    """The closed surface that is divided.

    Attributes
    ----------
    vertices, faces, genus : int
        Of the mesh as it was read and repaired.
    size_mm : (x, y, z)
        Of the finished outside.
    repairs : mapping of str to int
        How often each repair was made.
    notes : tuple of str
        What a user should know of repair and cells.
    chord_mm : Chords or None
        How far the triangles are from the smooth surface, where they are coarser than was asked for.
    distance_mm : Distance or None
        From the input to the finished outside, where new cells were made for it.
    """

    vertices: int
    faces: int
    genus: int
    size_mm: Xyz
    repairs: Mapping[str, int]
    notes: tuple[str, ...]
    chord_mm: Chords | None
    distance_mm: Distance | None


@dataclass(frozen=True)
class PatternFacts:
    """The duotone, or multitone: its tiles, its curves and its regions.

    Attributes
    ----------
    tiles, curves, regions : int
        How many there are; a duotone has one curve and two regions, a multitone of k rings k and k + 1.
    tile_size_mm : float
        Median side of a tile.
    tile_quality : TileQuality
        How even the tiles are.
    curve_length_mm : float
        Length of the curve on the surface, of all curves together.
    arc : float or None
        Where the curve crosses tile sides, from their yellow ends: as asked for, or as the area share needs it. None
        where there are several curves.
    area_share : mapping of str to float
        Share of the surface, between 0 and 1, by the region's name, from yellow to blue.
    handles : mapping of str to int
        Handles of each region; they sum to the genus.
    neck_mm : Spread
        Widths of the joined tiles' necks, before clearance is taken off.
    band_mm : mapping of str to Spread
        Widths of each band, likewise; none in a duotone.
    alignment : float or None
        Mean |cos| between the joined diagonals of both colours and the field, between 0 and 1; None unless there is
        a field of directions.
    locked : mapping of str to int, or None
        Tiles that locks hold in either colour; None without locks.
    objectives : mapping of str to Change
        What the curve was optimised for, before and after; empty if it was not. See `fabricate.design.optimising`.
    notes : tuple of str
        What a user should know of how the curve was chosen.
    """

    tiles: int
    tile_size_mm: float
    tile_quality: TileQuality
    curves: int
    regions: int
    curve_length_mm: float
    arc: float | None
    area_share: Mapping[str, float]
    handles: Mapping[str, int]
    neck_mm: Spread
    band_mm: Mapping[str, Spread]
    alignment: float | None = None
    locked: Mapping[str, int] | None = None
    objectives: Mapping[str, Change] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class PartFacts:
    """One solid, as its file holds it.

    Attributes
    ----------
    file : str
        Name of its STL file.
    triangles : int
        How many there are.
    volume_mm3, area_mm2 : float
        Enclosed volume, negative if inside out, and surface area.
    genus : int or None
        Handles of its surface, or None where the surface is not a closed manifold.
    components : int
        Connected pieces of the surface.
    watertight : bool
        Whether every edge has two triangles, once in each direction.
    self_intersections : int
        Pairs of triangles that cross.
    wall_mm : Spread or None
        Wall thickness; the median is weighted by area. None where no two faces are opposite each other.
    neck_mm : Narrowest or None
        The narrowest place between two walls that face other parts. None where there is none, or no other part.
    """

    file: str
    triangles: int
    volume_mm3: float
    area_mm2: float
    genus: int | None
    components: int
    watertight: bool
    self_intersections: int
    wall_mm: Spread | None
    neck_mm: Narrowest | None


@dataclass(frozen=True)
class WireFacts(PartFacts):
    """The wire along the curve, as its file holds it.

    Attributes
    ----------
    diameter_mm : float
        As it was asked for.
    length_mm : float
        Of wire that it takes, along its middle.
    """

    diameter_mm: float
    length_mm: float


@dataclass(frozen=True)
class PairFacts:
    """How two parts go together; None where it could not be measured or is not known.

    Attributes
    ----------
    gap_mm : Gap or None
        The smallest distance between them.
    overlap_mm3 : float or None
        Volume that they have in common.
    verdict : {"captive", "separable", "fused"} or None
        See `fabricate.checks.holding`; None as well where other parts lie between them.
    play_mm : Play or None
        How far the first part moves in the second; None for fused parts too.
    witness : Witness or None
        What proves that captive parts are.
    """

    gap_mm: Gap | None
    overlap_mm3: float | None
    verdict: Verdict | None
    play_mm: Play | None
    witness: Witness | None


@dataclass(frozen=True)
class OpeningFacts:
    """A round hole through a part's wall: where its axis goes in, and which way; mm."""

    part: str
    diameter_mm: float
    at: Xyz
    way: Xyz


@dataclass(frozen=True)
class BaseFacts:
    """The stand: the part it belongs to, its height, the plate's diameter, mm, and how many feet are on it."""

    part: str
    height_mm: float
    diameter_mm: float
    feet: int


@dataclass(frozen=True)
class FinishFacts:
    """What the parts have beside their regions, and what a user should know of that, in sentences."""

    openings: tuple[OpeningFacts, ...]
    base: BaseFacts | None
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Spaces:
    """Volumes of the gap between the parts, 0 where they touch, and of the whole shell, uncut, mm3."""

    gap: float
    shell: float


@dataclass(frozen=True)
class JointFacts:
    """How the facing walls run from the outer surface to the inner one, measured on the finished walls.

    Attributes
    ----------
    kind : {"straight", "draft", "tongue"}
    lean_deg : float
        Median angle by which they lean, degrees, positive where the part on the left gets wider inside.
    ridge_mm : Spread or None
        How far the ridge stands out; None without one.
    width_mm : float or None
        Its median width down the wall.
    """

    kind: JointKind
    lean_deg: float
    ridge_mm: Spread | None = None
    width_mm: float | None = None


@dataclass(frozen=True)
class FitFacts:
    """How the parts go together; None where it could not be measured or is not known.

    Attributes
    ----------
    clearance_mm : float or None
        The gap that was asked for.
    gap_mm : Gap or None
        The smallest one found.
    overlap_mm3 : float or None
        Volume that parts have in common.
    verdict : {"captive", "separable", "fused"} or None
        See `fabricate.checks.holding`. Of several parts, "captive" where each pair of neighbours is, which is enough
        for all of them to be caught in each other.
    play_mm : Play or None
        How far the first of two parts moves in the second; None for fused parts, and for more than two.
    witness : Witness or None
        What proves that two parts are captive; of more than two, each pair has its own.
    pairs : mapping of str to PairFacts
        The same of each pair by the parts' names, such as "yellow-blue".
    spaces_mm3 : Spaces or None
        As they were designed: what the parts leave free, and what they add up to with it.
    """

    clearance_mm: float | None
    gap_mm: Gap | None
    overlap_mm3: float | None
    verdict: Verdict | None
    play_mm: Play | None
    witness: Witness | None
    pairs: Mapping[str, PairFacts]
    spaces_mm3: Spaces | None = None
