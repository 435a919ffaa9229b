"""The duotone that a wish asks for, step by step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.design.curve_wish import CurveWish
from fabricate.design.wide_tree import wide_duotone
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.surface.limit import limit_vertices


@dataclass(frozen=True, eq=False)
class Design:
    """A duotone and what was found in choosing it.

    Attributes
    ----------
    duotone : Duotone
        The curve, as the tiles that are joined.
    """

    duotone: Duotone


def grown(quads: QuadMesh, wish: CurveWish) -> Duotone:
    """Return the duotone of the tree alone: quickly made, with necks as wide as those of the whole design.

    Raises
    ------
    PatternError
        If the positions of the arcs are out of range or do not increase.
    """
    root = None if wish.root is None else _nearest_yellow(quads, wish.root)
    return wide_duotone(quads, tree=wish.tree, seed=wish.seed, root=root, rings=wish.rings, neck=wish.neck)


def designed(quads: QuadMesh, wish: CurveWish) -> Design:
    """Return the duotone that a wish asks for.

    Raises
    ------
    PatternError
        If the positions of the arcs are out of range or do not increase.
    """
    return Design(grown(quads, wish))


def _nearest_yellow(quads: QuadMesh, place: tuple[float, float, float]) -> int:
    """Return the yellow point whose place on the smooth surface is nearest to another, mm."""
    away = np.linalg.norm(limit_vertices(quads) - np.asarray(place), axis=1)
    return int(np.where(quads.yellow, away, np.inf).argmin())
