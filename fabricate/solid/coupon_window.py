"""A round window in the wall, through which a plane cuts off a piece with a flat back.

Seen from the side, the plane lies as deep under the place as the wall is thick, or less where the wall bends inwards;
so the back is flat all over, and the piece can be printed on it. Towards the rim the surface falls:

            _____            height: just above the highest point
        _--       --_
       |             |       rim: of the lowest point within the window
       |_____________|       z = 0, the back
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from fabricate.arrays import Floats, Indices, Mask, frozen
from fabricate.solid.coupon_places import CouponPlace
from fabricate.surface.cut import CutSurface

UPRIGHT = 0.7
"""Least cosine between the surface's normals and the middle one: walls that lean by 45 degrees print unsupported."""

CUT_OFF = 0.02
"""How much of the wall's inner side is cut off at least, mm, so that the plane never grazes it."""

ABOVE = 0.05
"""How far above the highest point the window ends, mm; up to there nothing else may come in."""

ALONG = np.linspace(0.0, 1.0, 17)
"""Where on each edge the height of a surface is looked at."""

STEPS = 8
"""So many sizes are tried, from the widest to the least."""


@dataclass(frozen=True, eq=False)
class CouponWindow:
    """A window at a place of the joint.

    Attributes
    ----------
    place : CouponPlace
    axes : (3, 3) float
        Unit rows: across the joint, along it, and up, out of the wall.
    radius : float
        mm.
    depth : float
        How deep the back lies under the place, mm.
    height : float
        How far the window's upper end lies above the back, mm: just above the highest point.
    """

    place: CouponPlace
    axes: Floats
    radius: float
    depth: float
    height: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "axes", frozen(self.axes, np.float64, (3, 3)))

    def seen(self, points: Floats) -> Floats:
        """Return where points, (n, 3), lie seen through the window: x across, y along, z above the back; mm."""
        seen: Floats = (points - self.place.at) @ self.axes.T + [0.0, 0.0, self.depth]
        return seen


def widest_window(
    surface: CutSurface,
    inner: Floats,
    place: CouponPlace,
    *,
    widest: float,
    least: float,
    border: float,
    rim: float,
) -> CouponWindow | None:
    """Return the widest window at a place whose piece has a flat back, all lengths in mm; None if there is none.

    Parameters
    ----------
    surface : CutSurface
    inner : (n, 3) float
        The inner side of the wall under each point of the surface.
    place : CouponPlace
    widest, least : float
        Radii between which the window's is.
    border : float
        So much more around the window is as sound as what is in it.
    rim : float
        So high is the piece at its lowest, at least.
    """
    for radius in np.linspace(widest, least, STEPS).tolist():
        found = _window(surface, inner, place, radius, radius + border, rim)
        if found is not None:
            return found
    return None


def _window(
    surface: CutSurface, inner: Floats, place: CouponPlace, radius: float, reach: float, rim: float
) -> CouponWindow | None:
    patch = _patch(surface, place.at, 1.5 * reach)
    axes = _axes(surface.normals[patch].sum(axis=0), place.along)
    if axes is None:
        return None
    triangles = surface.triangles[patch[surface.triangles].all(axis=1)]
    outer, below = ((points - place.at) @ axes.T for points in (surface.points, inner))
    faces, back = (_heights(each, triangles, reach) for each in (outer, below))
    if not len(faces) or not len(back):
        return None
    depth = -float(back.max()) - CUT_OFF
    height = depth + float(faces.max()) + ABOVE
    upright = surface.normals[patch & (np.hypot(outer[:, 0], outer[:, 1]) < reach)] @ axes[2]
    strangers = [
        ~patch & (np.hypot(each[:, 0], each[:, 1]) < reach) & (each[:, 2] > -depth) & (each[:, 2] < height - depth)
        for each in (outer, below)
    ]
    sound = depth + float(faces.min()) >= rim and upright.min() >= UPRIGHT
    if not sound or any(each.any() for each in strangers):
        return None
    return CouponWindow(place, axes, radius, depth, height)


def _patch(surface: CutSurface, at: Floats, reach: float) -> Mask:
    """Return the points of the surface, (n,), nearer than `reach` to a place and connected with the nearest."""
    distance = np.linalg.norm(surface.points - at, axis=1)
    near = distance < reach
    numbers = np.flatnonzero(near)
    triangles = np.cumsum(near)[surface.triangles[near[surface.triangles].all(axis=1)]] - 1
    ends = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]]])
    graph = coo_array((np.ones(len(ends)), (ends[:, 0], ends[:, 1])), shape=(len(numbers), len(numbers)))
    labels = connected_components(graph, directed=False)[1]
    patch: Mask = np.zeros(len(near), dtype=bool)
    patch[numbers[labels == labels[distance[numbers].argmin()]]] = True
    return patch


def _heights(points: Floats, triangles: Indices, reach: float) -> Floats:
    """Return how high a surface is, (k,) mm, along its edges nearer to the middle than `reach`, seen from above."""
    within = np.hypot(points[:, 0], points[:, 1]) < reach
    touched = points[triangles[within[triangles].any(axis=1)]]
    edges = np.roll(touched, -1, axis=1) - touched
    places = (touched[:, :, None] + ALONG[:, None] * edges[:, :, None]).reshape(-1, 3)
    heights: Floats = places[np.hypot(places[:, 0], places[:, 1]) < reach, 2]
    return heights


def _axes(up: Floats, along: Floats) -> Floats | None:
    """Return unit rows across, along and up; None where these directions are none."""
    if not np.linalg.norm(up) > 0.0:
        return None
    up = up / np.linalg.norm(up)
    across = np.cross(along, up)
    if not np.linalg.norm(across) > 0.0:
        return None
    across = across / np.linalg.norm(across)
    return np.stack([across, np.cross(up, across), up])
