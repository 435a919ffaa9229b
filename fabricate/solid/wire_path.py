"""The path of a wire: a smooth closed line along the curve that bends no more sharply than the wire can."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.ndimage import maximum_filter1d, uniform_filter1d
from scipy.spatial import cKDTree

from fabricate.arrays import Floats, Indices, frozen
from fabricate.triangles.normals import unit

SHARPEST = 1.06
"""Smallest radius of a bend, in radii of the wire: below 1 a tube folds at the inside of the bend."""

STEPS_PER_RADIUS, MOST_STEPS = 4, 8
"""How many steps there are to a radius while bends are eased, but no more than so many to a step of the curve. What is
smaller than a step lies inside the wire."""

ROUNDS = 200
"""Rounds of easing before a bend is given up; in each, points move half way between others so far away as that a
radius has four such steps, and then half way between their neighbours."""

MOST_TURN = np.radians(30.0)
"""How far the path turns at most from one ring of the tube to the next, however coarse the tolerance."""

LONGEST = 4.0
"""Largest distance between two rings of the tube, in radii of the wire."""


@dataclass(frozen=True, eq=False)
class WirePath:
    """Places along a closed line, the last followed by the first again.

    Attributes
    ----------
    points, tangents : (n, 3) float
        mm, and unit vectors.
    """

    points: Floats
    tangents: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", frozen(self.points, np.float64, (None, 3)))
        object.__setattr__(self, "tangents", frozen(self.tangents, np.float64, (len(self.points), 3)))

    @property
    def steps(self) -> Floats:
        """(n,) float: distance from each place to the next, mm."""
        return _steps(self.points)

    @property
    def length(self) -> float:
        """Length, mm."""
        return float(self.steps.sum())


def wire_path(polyline: Floats, *, radius: float, tolerance: float) -> WirePath | None:
    """Return the path of a wire of this radius along a closed polyline, (c, 3), all in mm; None if it cannot bend so.

    A periodic cubic spline runs through the curve's points. Where it bends more sharply than the wire can, as over a
    crease, it is eased (diffusion of positions, there alone) until it does not; the curve has to stay inside the
    wire. Places are as close as the chord tolerance asks for on the outside of a bend.
    """
    curve = frozen(polyline, np.float64, (None, 3))
    spacing = float(_steps(curve).mean())
    step = max(radius / STEPS_PER_RADIUS, spacing / MOST_STEPS)
    start = _evenly(_spline(curve), step)
    eased = _eased(start, radius=radius)
    if eased is None or float(np.linalg.norm(eased - start, axis=1).max()) > radius:
        return None
    return _sampled(_spline(eased), step, radius=radius, tolerance=tolerance)


def meets_itself(path: WirePath, *, diameter: float) -> bool:
    """Tell whether a round wire of this diameter, mm, along the path would touch itself.

    Where no bend is sharper than the wire's radius r, places of the path that are more than pi r apart along it are
    those that can be too near each other by being parts of two strands (A. Schur's comparison theorem; R. Litherland,
    J. Simon, O. Durumeric, E. Rawdon, "Thickness of knots", Topology and its Applications 91, 1999).
    """
    places = _between(path, step=diameter / 8.0)
    along = np.concatenate([[0.0], np.cumsum(_steps(places))])
    pairs: Indices = cKDTree(places).query_pairs(diameter, output_type="ndarray")
    apart = np.abs(along[pairs[:, 1]] - along[pairs[:, 0]])
    return bool((np.minimum(apart, along[-1] - apart) > 0.5 * np.pi * diameter).any())


def _steps(points: Floats) -> Floats:
    steps: Floats = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
    return steps


def _spline(points: Floats) -> CubicSpline:
    """Return the periodic cubic spline through the points of a closed line, by chord length."""
    along = np.concatenate([[0.0], np.cumsum(_steps(points))])
    return CubicSpline(along, np.concatenate([points, points[:1]]), bc_type="periodic")


def _evenly(spline: CubicSpline, step: float) -> Floats:
    """Return places on a closed spline about a step apart."""
    end = float(spline.x[-1])
    places: Floats = spline(np.linspace(0.0, end, max(int(np.ceil(end / step)), 8), endpoint=False))
    return places


def _bends(points: Floats) -> Floats:
    """Return the curvature at each point of a closed line, (n,) float, 1 / mm: the angle turned over the way."""
    steps = _steps(points)
    ahead = unit(np.roll(points, -1, axis=0) - points)
    turned = np.arccos(np.clip(np.einsum("ij,ij->i", ahead, np.roll(ahead, 1, axis=0)), -1.0, 1.0))
    bends: Floats = 2.0 * turned / np.maximum(steps + np.roll(steps, 1), np.finfo(float).tiny)
    return bends


def _eased(points: Floats, *, radius: float) -> Floats | None:
    """Return the points of a closed line moved where it bends too sharply until it does not; None if it still does."""
    around = min(int(np.ceil(radius / float(_steps(points).mean()))), len(points) // 4)
    stride = max(around // STEPS_PER_RADIUS, 1)
    for _ in range(ROUNDS):
        sharp = _bends(points) > 1.0 / (SHARPEST * radius)
        if not sharp.any():
            return points
        wide = maximum_filter1d(sharp.astype(np.float64), 2 * around + 1, mode="wrap")
        weight = uniform_filter1d(wide, around, mode="wrap")  # no kink where easing ends
        near = np.flatnonzero(weight > 1e-6)
        for far in (stride, 1):
            means = 0.5 * (points[near - far] + points[(near + far) % len(points)])
            points = points.copy()
            points[near] += 0.5 * weight[near, None] * (means - points[near])
    return None


def _sampled(spline: CubicSpline, step: float, *, radius: float, tolerance: float) -> WirePath:
    """Return places on a closed spline so close that a tube round it keeps the chord tolerance, mm.

    Outside a bend of radius R a tube of radius r is a circle of radius R + r: a step s along the path leaves a chord
    error of (R + r) (s / R)^2 / 8 there.
    """
    end = float(spline.x[-1])
    fine = np.linspace(0.0, end, max(int(np.ceil(2.0 * end / step)), 16), endpoint=False)
    first, second = spline(fine, 1), spline(fine, 2)
    speed = np.linalg.norm(first, axis=1)
    bend = np.linalg.norm(np.cross(first, second), axis=1) / np.maximum(speed, np.finfo(float).tiny) ** 3
    bend = np.maximum(maximum_filter1d(bend, 5, mode="wrap"), 1e-9)
    longest = np.minimum(np.sqrt(8.0 * tolerance / (bend * (1.0 + bend * radius))), MOST_TURN / bend)
    density = speed / np.minimum(longest, LONGEST * radius)
    done = np.concatenate([[0.0], np.cumsum(0.5 * (density + np.roll(density, -1)))]) * (end / len(fine))
    wanted = np.linspace(0.0, done[-1], max(int(np.ceil(done[-1])), 8), endpoint=False)
    places = np.interp(wanted, done, np.append(fine, end))
    return WirePath(spline(places), unit(spline(places, 1)))


def _between(path: WirePath, *, step: float) -> Floats:
    """Return points on the straight pieces of the path, at most a step apart."""
    pieces = np.maximum(np.ceil(path.steps / step).astype(np.int64), 1)
    piece = np.repeat(np.arange(len(pieces)), pieces)
    part = (np.arange(len(piece)) - np.repeat(np.cumsum(pieces) - pieces, pieces)) / pieces[piece]
    ahead = np.roll(path.points, -1, axis=0) - path.points
    points: Floats = path.points[piece] + part[:, None] * ahead[piece]
    return points
