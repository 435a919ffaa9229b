"""The pinhole camera: from pixels to rays, from points to pixels."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from fabricate.arrays import Floats, frozen

THREE_QUARTER_VIEW = (0.42, -0.80, 0.43)
DISTANCE = 6.0  # of the eye, in radii of the subject: a short telephoto lens, as for product photographs


@dataclass(frozen=True, eq=False)
class Camera:
    r"""A pinhole camera with a shifted lens; z is up.

    Pixel coordinates are measured from the middle of the picture, x to the right and y down, so that
    one camera serves pictures of any size: a larger one shows more, at the same scale.

    Attributes
    ----------
    eye : (3,) float
        Position, mm.
    axes : (3, 3) float
        Unit rows: right, up and backward (from the subject to the eye).
    centre : (2,) float
        What falls into the middle of the picture, on the plane one unit in front of the eye.
    focal : float
        Focal length in pixels.
    """

    eye: Floats
    axes: Floats
    centre: Floats
    focal: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "eye", frozen(self.eye, np.float64, (3,)))
        object.__setattr__(self, "axes", frozen(self.axes, np.float64, (3, 3)))
        object.__setattr__(self, "centre", frozen(self.centre, np.float64, (2,)))

    def directions(self, pixels: Floats) -> Floats:
        """(n, 3) float: unit vectors from the eye through (n, 2) pixel coordinates."""
        plane = pixels / self.focal * [1.0, -1.0] + self.centre
        rays = plane @ self.axes[:2] - self.axes[2]
        lengths = np.sqrt(1.0 + (plane**2).sum(axis=1, keepdims=True))
        unit: Floats = rays / lengths
        return unit

    def pixels(self, points: Floats) -> Floats:
        """(n, 2) float: pixel coordinates at which (n, 3) points are seen."""
        seen = (points - self.eye) @ self.axes.T
        return (seen[:, :2] / -seen[:, 2:] - self.centre) * self.focal * [1.0, -1.0]

    def extent(self, points: Floats) -> tuple[float, float]:
        """Width and height, in pixels, of what (n, 3) points cover in the picture."""
        width, height = np.ptp(self.pixels(points), axis=0)
        return float(width), float(height)

    def magnified(self, factor: float) -> Camera:
        """Return the same view with everything `factor` times as large in the picture."""
        return replace(self, focal=self.focal * factor)


def camera_towards(points: Floats, *, direction: ArrayLike = THREE_QUARTER_VIEW) -> Camera:
    """Return a camera that sees (n, 3) points from `direction`, centred, with a focal length of 1 pixel.

    `direction` points from the subject to the eye and must not be vertical; the eye is
    far enough away for the perspective to be calm.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    backward = np.asarray(direction, dtype=np.float64) / np.linalg.norm(direction)
    right = np.cross([0.0, 0.0, 1.0], backward)
    right /= np.linalg.norm(right)
    axes = np.stack([right, np.cross(backward, right), backward])
    eye = (low + high) / 2 + backward * DISTANCE * max(float(np.linalg.norm(high - low)) / 2, 1e-9)
    camera = Camera(eye, axes, np.zeros(2), 1.0)
    seen = camera.pixels(points)
    return replace(camera, centre=(seen.min(axis=0) + seen.max(axis=0)) / 2 * [1.0, -1.0])
