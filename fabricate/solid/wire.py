"""The curve as a wire: one tube along it that does not touch itself.

A sculpture of one wire that covers a surface, as in E. Akleman, Q. Xing, P. Garigipati, G. Taubin, J. Chen, S. Hu,
"Hamiltonian cycle art: Surface covering wire sculptures and duotone surfaces", Computers & Graphics 37, 2013. Bends and
neighbouring strands bound how thick the wire can be.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats
from fabricate.errors import SolidError
from fabricate.solid.part import Part
from fabricate.solid.tube import tube
from fabricate.solid.wire_path import WirePath, meets_itself, wire_path
from fabricate.triangles.crossing import crossing_triangles

NAME = "wire"

HALVINGS = 8
"""How often the way between a diameter that fits and twice as much, which does not, is halved to find the largest."""

ROUNDING, SMALLER = 0.01, 0.98
"""The largest diameter is told in whole hundredths of a mm; so much of it is tried next when its triangles cross."""


@dataclass(frozen=True, eq=False)
class Wire:
    """A wire as a solid of genus 1, its diameter, and the length of its middle, mm."""

    part: Part
    diameter: float
    length: float


def wire(polyline: Floats, *, diameter: float, tolerance: float) -> Wire:
    """Return a wire of this diameter along a closed polyline, (c, 3), its triangles off by `tolerance`; all in mm.

    Raises
    ------
    SolidError
        If it would touch itself; the message says how thick it can be.
    """
    made = _sound(polyline, diameter, tolerance)
    if made is not None:
        return made
    largest = _largest(polyline, diameter, tolerance)
    remedy = f"ask for a curve.wire of at most {largest:g} mm or a larger pattern.tile_size"
    if not largest:
        remedy = "no wire of 0.01 mm or more fits; ask for a larger pattern.tile_size"
    raise SolidError(f"a wire of {diameter:g} mm along the curve would touch itself: {remedy}")


def _sound(polyline: Floats, diameter: float, tolerance: float) -> Wire | None:
    """Return the wire, unless it touches itself."""
    path = _free_path(polyline, diameter, tolerance)
    if path is None:
        return None
    made = tube(path, radius=0.5 * diameter, tolerance=tolerance, name=NAME)
    crossing = crossing_triangles(made.points, made.triangles)
    return None if len(crossing) else Wire(made, diameter, path.length)


def _free_path(polyline: Floats, diameter: float, tolerance: float) -> WirePath | None:
    """Return the wire's path, if it bends so and its strands are far enough from each other."""
    path = wire_path(polyline, radius=0.5 * diameter, tolerance=tolerance)
    return None if path is None or meets_itself(path, diameter=diameter) else path


def _largest(polyline: Floats, diameter: float, tolerance: float) -> float:
    """Return the largest diameter below a given one that does not touch itself, in whole hundredths of a mm."""
    good = 0.5 * min(diameter, float(np.ptp(polyline, axis=0).max()))
    while good > ROUNDING and _free_path(polyline, good, tolerance) is None:
        good *= 0.5
    bad = 2.0 * good
    for _ in range(HALVINGS):
        middle = 0.5 * (good + bad)
        fits = _free_path(polyline, middle, tolerance) is not None
        good, bad = (middle, bad) if fits else (good, middle)
    found = _hundredths(good)
    while found and _sound(polyline, found, tolerance) is None:
        found = _hundredths(SMALLER * found)
    return found


def _hundredths(length: float) -> float:
    """Return a length, mm, rounded down."""
    return round(int(length / ROUNDING) * ROUNDING, 2)
