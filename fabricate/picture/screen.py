"""Neighbouring pixels: which of them see the same surface, averages over those, and edges between others."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import uniform_filter

from fabricate.arrays import Floats, Indices, Mask
from fabricate.picture.layout import Cell
from fabricate.picture.stage import Surfels
from fabricate.picture.vectors import Floats32, dots

SAME_DIRECTION = 0.9  # cosine between normals of neighbours on one surface
# Each block of 4 x 4 pixels has every number once, and near pixels have distant numbers
# (B. Bayer, "An optimum method for two-level rendition of continuous-tone pictures", 1973).
DITHER = np.array([[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]])


@dataclass(frozen=True, eq=False)
class Screen:
    """Surfels of a whole picture, row by row.

    Attributes
    ----------
    width, height : int
        In pixels.
    surfels : Surfels
        (height * width,) of them.
    footprint : float
        Side of a pixel at the subject, mm.
    """

    width: int
    height: int
    surfels: Surfels
    footprint: float

    def alike(self, *, down: int, right: int) -> Mask:
        """(height - down, width - right) bool: whether a pixel and the one so far away see one surface."""
        near = slice(None, max(self.height - down, 0)), slice(None, max(self.width - right, 0))
        far = slice(down, None), slice(right, None)
        owner = self.surfels.owner.reshape(self.height, self.width)
        normals = self.surfels.normals.reshape(self.height, self.width, 3)
        positions = self.surfels.positions.reshape(self.height, self.width, 3)
        turned = np.einsum("ijx,ijx->ij", normals[near], normals[far])
        stepped = np.einsum("ijx,ijx->ij", normals[near], positions[far] - positions[near])
        same: Mask = (
            (owner[near] == owner[far])
            & (turned > SAME_DIRECTION)
            & (np.abs(stepped) < (down + right) * self.footprint)
        )
        return same


def pixel_middles(window: Cell, *, origin: tuple[float, float]) -> Floats:
    """(height * width, 2) float: middles of a window's pixels, row by row, measured from `origin`."""
    rows, columns = np.indices((window.height, window.width)) + 0.5
    middles = np.stack([columns + window.left - origin[0], rows + window.top - origin[1]], axis=-1)
    return middles.reshape(-1, 2)


def dither(window: Cell) -> Indices:
    """(height * width,) int: a number from 0 to 255 for each pixel, every number once in 16 x 16 pixels.

    Each 4 x 4 pixels have sixteen successive numbers, near pixels distant ones.
    """
    tile = 16 * np.kron(DITHER, np.ones((4, 4), dtype=np.int64)) + np.tile(DITHER, (4, 4))
    return np.tile(tile, (window.height // 16 + 1, window.width // 16 + 1))[: window.height, : window.width].ravel()


def blurred(screen: Screen, values: Floats32) -> Floats32:
    """(height * width, k) float: means over 4 x 4 pixels, of those only that see the same surface."""
    grid = values.reshape(screen.height, screen.width, -1)
    for axis in range(2):
        grid = _blurred_along(screen, grid, axis=axis)
    return grid.reshape(len(values), -1)


def _blurred_along(screen: Screen, grid: Floats32, *, axis: int) -> Floats32:
    """Mean over four pixels in a row (axis 1) or column (axis 0): one before, the pixel, two after."""
    total, weight = grid.copy(), np.ones_like(grid[:, :, :1])
    for step in (1, 2):
        front, back = _shifted(step, axis)
        same = screen.alike(down=step * (1 - axis), right=step * axis)[:, :, None]
        total[front] += same * grid[back]
        weight[front] += same
        if step == 1:
            total[back] += same * grid[front]
            weight[back] += same
    return total / weight


def _shifted(step: int, axis: int) -> tuple[tuple[slice, ...], tuple[slice, ...]]:
    """Index of all pixels but the last `step`, and of all but the first, along one axis."""
    whole = (slice(None),) * axis
    return (*whole, slice(None, -step)), (*whole, slice(step, None))


def blurred_within(values: Floats32, mask: Mask, *, size: int) -> Floats32:
    """(height, width) float: means over `size` x `size` pixels, of those in the mask; 0 where none is."""
    total = uniform_filter(np.where(mask, values, 0), size, mode="constant")
    share = uniform_filter(mask.astype(np.float32), size, mode="constant")
    # The filter keeps running sums: a hundredth of a pixel is what rounding may leave of none.
    mean: Floats32 = np.where(share > 0.01 / size**2, total / np.maximum(share, 1e-9), 0).astype(np.float32)
    return mean


def edges(screen: Screen) -> Mask:
    """(height * width,) bool: pixels that see another surface than one of their four neighbours."""
    marked = np.zeros((screen.height, screen.width), dtype=bool)
    across = ~screen.alike(down=0, right=1)
    along = ~screen.alike(down=1, right=0)
    marked[:, :-1] |= across
    marked[:, 1:] |= across
    marked[:-1] |= along
    marked[1:] |= along
    return marked.ravel()


def kindred(screen: Screen, pixels: Indices, surfels: Surfels) -> Indices:
    """(n,) int: for each surfel the pixel that sees most nearly the same surface, or -1.

    It is looked for among the surfel's own pixel, `pixels` (n,), and the eight round it.
    """
    best = np.full(len(pixels), -1)
    least = np.full(len(pixels), np.inf, dtype=np.float32)
    row, column = np.divmod(pixels, screen.width)
    for down, right in np.ndindex(3, 3):
        below = np.clip(row + down - 1, 0, screen.height - 1)
        other = below * screen.width + np.clip(column + right - 1, 0, screen.width - 1)
        same = np.flatnonzero(screen.surfels.owner[other] == surfels.owner)
        apart = _difference(screen, surfels, same, other[same])
        closer = apart < least[same]
        best[same[closer]], least[same[closer]] = other[same[closer]], apart[closer]
    return best


def _difference(screen: Screen, surfels: Surfels, some: Indices, pixels: Indices) -> Floats32:
    """(n,) float: how far apart the surfaces of some surfels and of some pixels are, in pixels."""
    normals = surfels.normals[some]
    step = np.abs(dots(normals, screen.surfels.positions[pixels] - surfels.positions[some]))
    turn = 1 - dots(normals, screen.surfels.normals[pixels])
    return step / np.float32(screen.footprint) + np.float32(4) * turn
