"""The studio: a soft sky, a white floor, one large key light; and how much of them reaches a point."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.picture.camera import Camera
from fabricate.picture.ray_caster import RayCaster
from fabricate.picture.vectors import Floats32, dots

PATTERNS = 256  # different sets of directions
KEY = (-0.46, 0.86, 0.55)  # towards the key light, in the camera's axes: right, up, backward
KEY_SPREAD = 0.16  # radius of the key light, seen from the subject, in units of its distance


def key_direction(camera: Camera) -> Floats32:
    """(3,) float: unit direction to the key light, which moves with the camera."""
    return (np.asarray(KEY) @ camera.axes / np.linalg.norm(KEY)).astype(np.float32)


def sky_light(
    rays: RayCaster, positions: Floats32, normals: Floats32, facets: Floats32, directions: Floats32
) -> Floats32:
    """(n,) float: light from sky and floor at (n, 3) points; about 1 at an open one that faces up.

    `facets` are the normals of the triangles themselves, `normals` the smoothed ones, `directions`
    (k, n, 3) are relative to the latter. `positions` lie a little above the surface.
    """
    total = np.zeros(len(positions), dtype=np.float32)
    for some in directions:
        world = _above(_to_world(some, normals), facets)
        total += np.where(rays.blocked(positions, world), 0, sky_radiance(world[:, 2]))
    return total / np.float32(len(directions))


def key_light(
    rays: RayCaster, positions: Floats32, normals: Floats32, facets: Floats32, directions: Floats32
) -> Floats32:
    """(n,) float: light from the key light at (n, 3) points, 0..1: the cosine of its angle where it is seen.

    As in `sky_light`, but `directions` (k, n, 3) are those towards the light.
    """
    total = np.zeros(len(positions), dtype=np.float32)
    for some in directions:
        cosine = dots(normals, some)
        facing = np.flatnonzero((cosine > 0) & (dots(facets, some) > 0))
        total[facing] += np.where(rays.blocked(positions[facing], some[facing]), 0, cosine[facing])
    return total / np.float32(len(directions))


def sky_radiance(height: Floats32) -> Floats32:
    """(n,) float: brightness of the surroundings in unit directions with this z; the floor is bright too."""
    slope = np.where(height > 0, np.float32(0.5), np.float32(0.15))
    return np.float32(0.66) + slope * height


def sky_directions(rays: int, pattern: Indices) -> Floats32:
    """(rays, n, 3) float: unit directions above z = 0, as dense as the cosine of the angle to z.

    Directions of one pattern, and of sixteen successive ones, are spread evenly.
    """
    disc = _disc_points(rays)
    height = np.sqrt(1.0 - (disc**2).sum(axis=-1, keepdims=True))
    return np.concatenate([disc, height], axis=-1).astype(np.float32)[:, pattern]


def key_directions(camera: Camera, rays: int, pattern: Indices) -> Floats32:
    """(rays, n, 3) float: unit directions to points all over the key light."""
    disc = np.pad(_disc_points(rays) * KEY_SPREAD, ((0, 0), (0, 0), (0, 1)), constant_values=1.0)
    local = (disc / np.linalg.norm(disc, axis=-1, keepdims=True)).astype(np.float32).reshape(-1, 3)
    world = _to_world(local, np.tile(key_direction(camera), (len(local), 1)))
    return world.reshape(disc.shape)[:, pattern]


def _disc_points(rays: int) -> Floats:
    """(rays, PATTERNS, 2) float: evenly spread points in the unit disc."""
    radius, angle = _spread_points(rays * PATTERNS).reshape(PATTERNS, rays, 2).transpose(2, 1, 0)
    radius, angle = np.sqrt(radius), 2 * np.pi * angle
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)


def _spread_points(count: int) -> Floats:
    """(count, 2) float: points that fill the unit square evenly, whatever the count.

    The additive recurrence on the plastic number, "R2" in M. Roberts, "The unreasonable
    effectiveness of quasirandom sequences", 2018: any run of successive points is well spread too.
    """
    plastic = 1.32471795724474602596
    return (0.5 + np.arange(1, count + 1)[:, None] / [plastic, plastic**2]) % 1.0


def _to_world(local: Floats32, normals: Floats32) -> Floats32:
    """Turn (n, 3) vectors so that their z axis becomes the (n, 3) normals.

    The basis is that of T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
    """
    x, y, z = normals.T
    sign = np.copysign(np.float32(1.0), z)
    a = -1 / (sign + z)
    b = x * y * a
    right = np.stack([1 + sign * x * x * a, sign * b, -sign * x], axis=1)
    ahead = np.stack([b, sign + y * y * a, -y], axis=1)
    turned: Floats32 = local[:, :1] * right + local[:, 1:2] * ahead + local[:, 2:] * normals
    return turned


def _above(directions: Floats32, facets: Floats32) -> Floats32:
    """Mirror directions that a smoothed normal put below the triangle's own plane to above it."""
    depth = np.minimum(dots(directions, facets), 0)
    return directions - np.float32(2) * depth[:, None] * facets
