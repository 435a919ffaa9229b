"""Proof that a pattern is one curve between two connected regions, or k curves between k + 1, counted from tiles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from fabricate.arrays import Indices, Mask
from fabricate.duotone.curve import count_curves
from fabricate.duotone.duotone import Duotone


@dataclass(frozen=True)
class RegionFacts:
    """Topology of one region: connected components, Euler characteristic, handles in all."""

    components: int
    euler_characteristic: int
    handles: int


@dataclass(frozen=True)
class Certificate:
    """What was counted, and whether it is a duotone or a multitone.

    Attributes
    ----------
    curves : int
        Closed curves between the regions: one less than there are regions is right.
    regions : tuple of RegionFacts
        From yellow over the bands of a multitone to blue; each must be one component.
    genus : int
        Of the whole surface: chi adds up over the regions, so with one boundary circle for yellow and for blue and
        two for each band, (1 - 2 g_yellow) + (1 - 2 g_blue) = 2 - 2 g and the handles share the genus. Bands have none.
    """

    curves: int
    regions: tuple[RegionFacts, ...]
    genus: int

    @property
    def yellow(self) -> RegionFacts:
        """The first region."""
        return self.regions[0]

    @property
    def blue(self) -> RegionFacts:
        """The last region."""
        return self.regions[-1]

    @property
    def holds(self) -> bool:
        """One curve between neighbouring regions, each of them connected, and handles that add up to the genus."""
        return (
            self.curves == len(self.regions) - 1
            and all(region.components == 1 for region in self.regions)
            and sum(region.handles for region in self.regions) == self.genus
        )


def certified(duotone: Duotone) -> Certificate:
    """Count curves, components and Euler characteristics of both colours.

    Nothing is assumed of how the tiles were chosen. The part of a region round one of its points is connected; a tile
    connects two of these parts where it is joined. The classes are the regions' connected components.
    """
    curves = count_curves(duotone)
    labels, is_yellow = _point_components(duotone), duotone.quads.yellow
    yellow = _facts(duotone, labels[is_yellow], is_yellow, duotone.joined, curves)
    blue = _facts(duotone, labels[~is_yellow], ~is_yellow, ~duotone.joined, curves)
    return Certificate(curves, (yellow, blue), duotone.quads.genus)


def _point_components(duotone: Duotone) -> Indices:
    """Return a component label for each point: each tile joins two of its corners, of one colour."""
    tiles, joined = duotone.quads.tiles, duotone.joined
    begin, end = (np.where(joined, tiles[:, k], tiles[:, k + 1]) for k in (0, 2))
    shape = 2 * (len(duotone.quads.points),)
    glue = csr_array((np.ones(len(tiles), dtype=np.int8), (begin, end)), shape=shape)
    return connected_components(glue, directed=False)[1].astype(np.int64)


def _facts(duotone: Duotone, labels: Indices, own: Mask, joined: Mask, curves: int) -> RegionFacts:
    """Euler characteristic of one colour's cell complex, and the handles that follow from it.

    Cells: its own points and one crossing per tile side; its part of each tile side and two arcs per
    tile; one piece in a tile joined in its colour, two elsewhere.
    """
    tiles = len(duotone.joined)
    sides = len(duotone.quads.twins) // 2
    pieces = 2 * tiles - int(joined.sum())
    euler = (int(own.sum()) + sides) - (sides + 2 * tiles) + pieces
    components = int(np.count_nonzero(np.bincount(labels)))
    return RegionFacts(components, euler, (2 * components - curves - euler) // 2)
