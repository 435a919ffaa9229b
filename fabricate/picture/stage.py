"""A scene set up on a floor, what rays from a camera see of it, and how that is lit."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from fabricate.arrays import Floats, Indices, Mask
from fabricate.picture.blocks import in_blocks
from fabricate.picture.camera import Camera
from fabricate.picture.light import key_directions, key_light, sky_directions, sky_light
from fabricate.picture.palette import linear_light
from fabricate.picture.ray_caster import RayCaster
from fabricate.picture.scene import Scene, corner_normals, facet_normals
from fabricate.picture.vectors import Floats32, dots, unit

CREASE = 32.0  # degrees between a triangle's normal and the mean round a corner
FLOOR_REACH = 1.6  # radius of the floor that takes shadows, in radii of the scene
NOTHING, FLOOR = -2, -1  # owners that are no part
UP = np.array([0, 0, 1], dtype=np.float32)


@dataclass(frozen=True, eq=False)
class Stage:
    """A scene prepared for rays, standing on a floor.

    Attributes
    ----------
    rays : RayCaster
        Over all triangles.
    facets : (m, 3) float
        Unit normal of each triangle.
    corners : (m, 3, 3) float
        Unit normal at each triangle's corners, smooth except across creases.
    colours : (k, 3) float
        Linear light, 0..1.
    colour_of : (m,) int
        Index into `colours` of each triangle.
    foot : (3,) float
        On the floor, under the middle of the scene, mm.
    radius : float
        Half the diagonal of the bounding box, mm.
    """

    rays: RayCaster
    facets: Floats32
    corners: Floats32
    colours: Floats32
    colour_of: Indices
    foot: Floats
    radius: float


@dataclass(frozen=True, eq=False)
class Surfels:
    """What each of (n,) rays sees: a spot of a part, of the floor, or nothing.

    Attributes
    ----------
    owner : (n,) int
        Index of the part's colour, or FLOOR, or NOTHING.
    positions : (n, 3) float
        mm; the eye where there is nothing.
    normals : (n, 3) float
        Smoothed, towards the eye.
    facets : (n, 3) float
        Normal of the triangle, towards the eye.
    """

    owner: Indices
    positions: Floats32
    normals: Floats32
    facets: Floats32

    def __getitem__(self, chosen: slice | NDArray[np.int64]) -> Surfels:
        """Return some of them."""
        return Surfels(*(getattr(self, field.name)[chosen] for field in fields(self)))


def staged(scene: Scene) -> Stage:
    """Prepare a scene: ray tree, normals, floor under its lowest point."""
    low, high = scene.points.min(axis=0), scene.points.max(axis=0)
    facets = facet_normals(scene)
    return Stage(
        RayCaster(scene.points, scene.triangles),
        facets,
        corner_normals(scene, facets, crease=CREASE),
        linear_light(scene.colours).astype(np.float32),
        scene.colour_of,
        np.array([*(low + high)[:2] / 2, low[2]]),
        float(np.linalg.norm(high - low)) / 2,
    )


def seen(stage: Stage, camera: Camera, pixels: Floats) -> Surfels:
    """Return what is seen through (n, 2) pixel coordinates."""
    pieces = in_blocks(lambda block: _seen(stage, camera, pixels[block]), len(pixels))
    return Surfels(*(np.concatenate([getattr(piece, field.name) for piece in pieces]) for field in fields(Surfels)))


def lit(stage: Stage, camera: Camera, surfels: Surfels, *, pattern: Indices, rays: tuple[int, int]) -> Floats32:
    """(n, 2) float: light from the sky and from the key light on surfels that are not NOTHING.

    The (n,) `pattern` says which directions sample the light, `rays` how many to the sky and the key light.
    """
    return np.concatenate(
        in_blocks(lambda block: _lit(stage, camera, surfels[block], pattern[block], rays), len(surfels.owner))
    )


def _seen(stage: Stage, camera: Camera, pixels: Floats) -> Surfels:
    directions = camera.directions(pixels).astype(np.float32)
    eye = np.tile(camera.eye.astype(np.float32), (len(pixels), 1))
    hits = stage.rays.first_hits(eye, directions)
    floor, on_floor = _floor_distance(stage, camera, directions)
    owner = np.where(on_floor, FLOOR, NOTHING)
    distance: Floats32 = np.where(on_floor, floor, 0)
    normals, facets = np.tile(UP, (2, len(pixels), 1))
    met = np.flatnonzero(hits.triangle >= 0)
    triangle = hits.triangle[met]
    owner[met], distance[met] = stage.colour_of[triangle], hits.distance[met]
    # A triangle seen from behind (an open mesh) is shaded as if it had two sides.
    side = np.where(dots(stage.facets[triangle], directions[met]) > 0, -1, 1).astype(np.float32)[:, None]
    facets[met] = side * stage.facets[triangle]
    normals[met] = side * unit(np.einsum("nc,ncx->nx", hits.weights[met], stage.corners[triangle]))
    positions: Floats32 = eye + distance[:, None] * directions
    return Surfels(owner, positions, normals, facets)


def _floor_distance(stage: Stage, camera: Camera, directions: Floats32) -> tuple[Floats32, Mask]:
    """Distance to the floor along each ray, and whether it is met within reach."""
    drop: Floats32 = np.minimum(directions[:, 2], np.float32(-1e-6))
    distance = np.float32(stage.foot[2] - camera.eye[2]) / drop
    across = directions[:, :2] * distance[:, None] + (camera.eye - stage.foot)[:2].astype(np.float32)
    return distance, np.hypot(across[:, 0], across[:, 1]) < FLOOR_REACH * stage.radius


def _lit(stage: Stage, camera: Camera, surfels: Surfels, pattern: Indices, rays: tuple[int, int]) -> Floats32:
    # Rays start a little above the surface: by much more than float32 errors, by less than a pixel.
    lifted = surfels.positions + np.float32(2e-4 * stage.radius) * surfels.facets
    spots = stage.rays, lifted, surfels.normals, surfels.facets
    sky = sky_light(*spots, sky_directions(rays[0], pattern))
    key = key_light(*spots, key_directions(camera, rays[1], pattern))
    return np.stack([sky, key], axis=1)
