"""How even tiles are: their aspect ratios and the spread of their sizes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats

MOST_ASPECT = 3.0
"""Above this, at the 95th percentile, bands are visibly uneven: arcs become ellipses three times as long as wide."""

MOST_SPREAD = 3.0
"""Above this, bands in one place are three times as wide as in another. Cells of one size give about 1.6."""


@dataclass(frozen=True)
class TileQuality:
    """Aspect ratios and sizes of tiles.

    Attributes
    ----------
    aspect_median, aspect_p95, aspect_max : float
        Of the longer mean of two opposite sides over the shorter one; 1 for squares and rhombi, inf where it is 0.
    size_ratio : float
        Mean side of the tile at the 95th percentile over that at the 5th.
    warnings : tuple of str
        A sentence for each limit that is exceeded.
    """

    aspect_median: float
    aspect_p95: float
    aspect_max: float
    size_ratio: float
    warnings: tuple[str, ...]


def tile_quality(corners: Floats) -> TileQuality:
    """Return how even tiles are, from their corners, (t, 4, 3) float, in order round each of at least one tile.

    High aspect ratios give bands of uneven width (Garigipati 2013, 4.5).
    """
    sides = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    pairs = np.sort(sides[:, :2] + sides[:, 2:], axis=1)
    aspects = _ratio(pairs[:, 1], pairs[:, 0])
    median, high = (float(value) for value in np.quantile(aspects, [0.5, 0.95], method="inverted_cdf"))
    small, large = np.quantile(sides.mean(axis=1), [0.05, 0.95], method="inverted_cdf")
    spread = float(_ratio(large, small))
    return TileQuality(median, high, float(aspects.max()), spread, _warnings(high, spread))


def _ratio(larger: Floats, smaller: Floats) -> Floats:
    tiny = np.finfo(float).tiny
    ratio: Floats = np.where(smaller > 0.0, larger / np.maximum(smaller, tiny), np.where(larger > 0.0, np.inf, 1.0))
    return ratio


def _warnings(aspect: float, spread: float) -> tuple[str, ...]:
    warnings = []
    if aspect > MOST_ASPECT:
        warnings.append(
            f"1 tile in 20 is more than {aspect:.3g} times as long as wide (limit {MOST_ASPECT:g}), so bands will be "
            'uneven: prepare.cells = "quads" makes more even ones'
        )
    if spread > MOST_SPREAD:
        warnings.append(
            f"large tiles have {spread:.3g} times the side of small ones (limit {MOST_SPREAD:g}), so bands will be of "
            'uneven width: prepare.cells = "quads" makes more even ones, or ask for a smaller pattern.tile_size'
        )
    return tuple(warnings)
