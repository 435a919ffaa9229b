"""Thickness that varies over the surface: by height, or by how sharply the surface bends.

A wall that is flat needs more thickness than one that is bent, which is stiff by its shape; and a sharp bend has
less room for a thick one.
"""

from __future__ import annotations

from typing import Literal

import numpy as np

from fabricate.arrays import Floats
from fabricate.surface.cut import CutSurface
from fabricate.surface.smoothing import diffused
from fabricate.triangles.adjacency import undirected_edges
from fabricate.triangles.normals import point_areas

EXTREME = 0.05
"""Share of the surface that bends least, and most, and has the extreme thickness all over."""

LEAST_RANGE = 0.5
"""Range of bends over which the thickness goes from one extreme to the other, at least, as a share of a sharp bend's: a
sphere that bends alike everywhere is thick everywhere."""

EVENED = 2.5
"""Over how many thicknesses bends are evened out, so that the thickness changes gently."""


def varying_thickness(
    surface: CutSurface, *, thinnest: float, thickest: float, by: Literal["curvature", "height"]
) -> Floats:
    """Return the thickness under each point of the surface, (n,) float, mm, from the thinnest to the thickest.

    By height it is thickest at the bottom and falls evenly to the top. By curvature it is thickest where the surface
    is flattest and thinnest where it bends most, as far as 5 % of the surface do.
    """
    share = _lowness(surface) if by == "height" else _flatness(surface, length=EVENED * thickest)
    thickness: Floats = thinnest + (thickest - thinnest) * share
    return thickness


def _lowness(surface: CutSurface) -> Floats:
    """Return 1 at the bottom and 0 at the top, (n,) float."""
    height = surface.base[:, 2]
    low: Floats = (height.max() - height) / np.ptp(height)
    return low


def _flatness(surface: CutSurface, *, length: float) -> Floats:
    """Return 1 where the surface is flattest and 0 where it bends most, (n,) float."""
    bends = diffused(point_bends(surface)[:, None], surface.base, surface.triangles, length=length)[:, 0]
    areas = point_areas(surface.base, surface.triangles)
    order = np.argsort(bends, kind="stable")
    below = np.cumsum(areas[order])
    flat, sharp = bends[order][np.searchsorted(below, np.array([EXTREME, 1.0 - EXTREME]) * below[-1])]
    flatness: Floats = np.clip(1.0 - (bends - flat) / max(sharp - flat, LEAST_RANGE * sharp), 0.0, 1.0)
    return flatness


def point_bends(surface: CutSurface) -> Floats:
    """Return how sharply the surface bends at each point, (n,) float, 1 / mm.

    It is the root mean square over all directions, sqrt((k1^2 + k2^2) / 2) of the principal curvatures, measured by
    how much the normals turn along the edges at a point.
    """
    ends = undirected_edges(surface.triangles)
    turned, gone = (
        np.square(vectors[ends[:, 0]] - vectors[ends[:, 1]]).sum(axis=1) for vectors in (surface.normals, surface.base)
    )
    count = len(surface.base)
    turning, going = (sum(np.bincount(end, each, minlength=count) for end in ends.T) for each in (turned, gone))
    bends: Floats = np.sqrt(turning / np.maximum(going, np.finfo(float).tiny))
    return bends
