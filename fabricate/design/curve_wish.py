"""What is asked of the curve."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from fabricate.config.lock_config import LockConfig
from fabricate.config.optimise_config import OptimiseConfig
from fabricate.design.field import FieldWish
from fabricate.duotone.spanning_tree import Tree


@dataclass(frozen=True, kw_only=True)
class CurveWish:
    """Which of all single curves is asked for.

    Attributes
    ----------
    tree : {"random", "uniform", "breadth-first", "depth-first", "field"}
        Spanning tree that the yellow region grows along.
    seed : int
        Draws whatever is drawn.
    depth : float
        How far under the surface necks have to be as wide, mm.
    root : (x, y, z) or None
        Where breadth-first and depth-first trees grow from, mm; drawn if None.
    rings : tuple of float
        Where the curve, or each of several curves side by side, crosses tile sides, from their yellow ends.
    neck : float
        Narrowest neck that will do, mm, before clearance is taken off.
    field : FieldWish or None
        What a tree of that name follows, and what alignment is measured with.
    locks : tuple of LockConfig
        Tiles that are joined in one colour.
    handles : int
        How many handles of the surface are yellow.
    optimise : OptimiseConfig or None
        What the curve is made better for, and for how long.
    """

    tree: Tree | Literal["field"]
    seed: int
    rings: tuple[float, ...]
    neck: float
    depth: float = 0.0
    root: tuple[float, float, float] | None = None
    field: FieldWish | None = None
    locks: tuple[LockConfig, ...] = ()
    handles: int = 0
    optimise: OptimiseConfig | None = None
