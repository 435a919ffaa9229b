"""The duotone that a wish asks for, step by step."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from fabricate.arrays import Floats
from fabricate.config.field_config import DirectionConfig
from fabricate.config.optimise_config import OptimiseConfig
from fabricate.design.alignment import alignment, alignment_costs
from fabricate.design.curve_wish import CurveWish
from fabricate.design.field import field_directions, field_weights
from fabricate.design.locks import tile_locks
from fabricate.design.optimising import Change, Optimised, optimised
from fabricate.design.wide_tree import neck_reluctance, wide_duotone
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.handles import with_handles
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.duotone.spanning_tree import weighted_duotone
from fabricate.duotone.tile_locks import TileLocks
from fabricate.errors import PatternError
from fabricate.surface.limit import limit_vertices


@dataclass(frozen=True, eq=False)
class Design:
    """A duotone and what was found in choosing it.

    Attributes
    ----------
    duotone : Duotone
        The curve, as the tiles that are joined.
    locks : TileLocks or None
        Tiles that were held in one colour; None if none was to be.
    alignment : float or None
        Mean |cos| between the joined diagonals and the field; None unless that is one of directions.
    objectives : mapping of str to Change
        What was optimised, before and after; nothing if nothing was.
    notes : tuple of str
        What a user should know of the choice.
    """

    duotone: Duotone
    locks: TileLocks | None = None
    alignment: float | None = None
    objectives: Mapping[str, Change] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


def grown(quads: QuadMesh, wish: CurveWish) -> Duotone:
    """Return the duotone of the tree alone, without locks: quickly made, with necks as wide as in the whole design.

    Raises
    ------
    PatternError
        If the positions of the arcs are out of range or do not increase.
    """
    return _tree(quads, wish, None)


def designed(quads: QuadMesh, wish: CurveWish, *, progress: Callable[[str], None] = lambda _: None) -> Design:
    """Return the duotone that a wish asks for: a tree, then handles for yellow, then flips that make it better.

    Raises
    ------
    PatternError
        If the positions of the arcs are out of range or do not increase, locks contradict each other, or yellow cannot
        have as many handles.
    """
    locks = tile_locks(quads, wish.locks, seed=wish.seed) if wish.locks else None
    duotone = _with_handles(_tree(quads, wish, locks), wish, locks)
    directions = None if wish.field is None else field_directions(quads, wish.field)
    objectives: Mapping[str, Change] = {}
    notes: tuple[str, ...] = ()
    if wish.optimise is not None and wish.optimise.total:
        found = _optimised(duotone, wish, wish.optimise, locks, directions, progress)
        duotone, objectives, notes = found.duotone, found.objectives, found.notes
    followed = None if directions is None else alignment(duotone, directions)
    return Design(duotone, locks, followed, objectives, notes)


def _with_handles(duotone: Duotone, wish: CurveWish, locks: TileLocks | None) -> Duotone:
    if wish.handles == 0:
        return duotone
    reluctance = neck_reluctance(duotone.quads, rings=wish.rings, neck=wish.neck, depth=wish.depth)
    free = None if locks is None else locks.free
    return with_handles(duotone, yellow=wish.handles, seed=wish.seed, reluctance=reluctance, free=free)


def _optimised(
    duotone: Duotone,
    wish: CurveWish,
    asked: OptimiseConfig,
    locks: TileLocks | None,
    directions: Floats | None,
    progress: Callable[[str], None],
) -> Optimised:
    return optimised(
        duotone,
        asked,
        rings=wish.rings,
        neck=wish.neck,
        seed=wish.seed,
        alignments=None if directions is None else alignment_costs(duotone.quads, directions),
        across=_across(wish),
        free=None if locks is None else locks.free,
        progress=progress,
    )


def _across(wish: CurveWish) -> bool:
    followed = None if wish.field is None else wish.field.config
    return isinstance(followed, DirectionConfig) and followed.corridors == "across"


def _tree(quads: QuadMesh, wish: CurveWish, locks: TileLocks | None) -> Duotone:
    if wish.tree == "field":
        if wish.field is None:
            raise PatternError('tree = "field" needs a field to follow, found none')
        weights = field_weights(quads, wish.field, seed=wish.seed)
        return weighted_duotone(quads, weights, seed=wish.seed, locks=locks)
    root = None if wish.root is None else _nearest_yellow(quads, wish.root)
    return wide_duotone(
        quads,
        tree=wish.tree,
        seed=wish.seed,
        root=root,
        rings=wish.rings,
        neck=wish.neck,
        depth=wish.depth,
        locks=locks,
    )


def _nearest_yellow(quads: QuadMesh, place: tuple[float, float, float]) -> int:
    """Return the yellow point whose place on the smooth surface is nearest to another, mm."""
    away = np.linalg.norm(limit_vertices(quads) - np.asarray(place), axis=1)
    return int(np.where(quads.yellow, away, np.inf).argmin())
