"""The curve that separates the colours, traced from tile to tile.

Every tile holds two arcs. Travelled with yellow on the left, both enter the tile through a side that
runs from yellow to blue (sides 0 and 2) and leave through one that runs back:

    yellow-joined: 0 -> 1 and 2 -> 3 (round the blue corners)
    blue-joined:   0 -> 3 and 2 -> 1 (round the yellow corners)

Arc 2 t + s enters tile t through side 2 s.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components, depth_first_order

from fabricate.arrays import Indices
from fabricate.duotone.duotone import Duotone
from fabricate.errors import PatternError


def next_arcs(duotone: Duotone) -> Indices:
    """Return the arc that follows each arc, (2 t,) int, a permutation of all arcs."""
    arcs = np.arange(2 * len(duotone.joined))
    step = np.where(duotone.joined[arcs // 2], 1, 3)
    entry = 2 * (arcs % 2)
    leaves = 4 * (arcs // 2) + (entry + step) % 4
    following: Indices = duotone.quads.twins[leaves] // 2
    return following


def count_curves(duotone: Duotone) -> int:
    """Return the number of closed curves: cycles of the permutation of arcs."""
    return int(connected_components(_successors(duotone), directed=False)[0])


def traced_arcs(duotone: Duotone) -> Indices:
    """Return all arcs in the order of the one closed curve, yellow on the left, from arc 0, (2 t,) int.

    Raises
    ------
    PatternError
        If the tiles form more than one closed curve.
    """
    order = depth_first_order(_successors(duotone), 0, return_predecessors=False)
    if len(order) != 2 * len(duotone.joined):
        raise PatternError(
            f"expected one closed curve, found {count_curves(duotone)}: "
            "the yellow-joined tiles are not a spanning tree or quasi-tree"
        )
    return order.astype(np.int64)


def _successors(duotone: Duotone) -> csr_array:
    following = next_arcs(duotone)
    count = len(following)
    return csr_array((np.ones(count), following, np.arange(count + 1)), shape=(count, count))
