"""The fit of finished parts: common volume, smallest gap, and volumes that add up to the whole."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from manifold3d import Manifold

from fabricate.arrays import Floats
from fabricate.checks.check import MOST_PLACES, Check
from fabricate.checks.contacts import TOUCHING
from fabricate.checks.facts import Gap, Spaces
from fabricate.checks.wording import place
from fabricate.solid.part import Part

OVERLAP_SHARE = 1e-6
"""Largest common volume of two parts, as a share of the smaller one."""

GAP_SHARE = 0.95
"""Smallest gap that is accepted, as a share of the clearance that was asked for."""

WIDEST = 1.3
"""Largest gap along the joint's mid-line that is accepted, in clearances: beyond, parts rattle and seams show."""

CHORDS = 4.0
"""An excess of up to so many chord errors is explained by them: the worst edges are off by that much."""

QUERIED_SHARE = 1.02
"""Distance queries confirm a gap when they find places that are not farther apart by more than this factor."""

VOLUME_SHARE = 1e-3
"""Largest difference between the sum of all volumes and the whole, as a share of the whole."""


def overlap_check(code: str, first: Part, second: Part, common: Manifold, *, smaller_volume: float) -> Check:
    """Check that two parts have no volume in common; points at the pieces they share.

    Parameters
    ----------
    code : str
    first, second : Part
        For their names.
    common : Manifold
        Their intersection.
    smaller_volume : float
        Volume of the smaller part, mm3.
    """
    volume = common.volume()
    ok = volume <= OVERLAP_SHARE * smaller_volume
    return Check(
        code,
        ok=ok,
        message=f"{first.name} and {second.name} must not overlap, and they have {volume:.6g} mm3 in common",
        where=np.zeros((0, 3)) if ok else _piece_places(common),
    )


def gap_check(
    code: str, first: Part, second: Part, gap: Gap, *, clearance: float | None, shared: float = 0.0, common: float = 0.0
) -> Check:
    """Check that two parts keep at least 95 % of the clearance; points at the smallest gap.

    With a clearance of 0 they must touch and share faces. Skipped when no clearance is known.

    Parameters
    ----------
    code : str
    first, second : Part
        For their names.
    gap : Gap
    clearance : float or None
        As it was asked for, mm.
    shared : float
        Area of the faces that they share, mm2.
    common : float
        Volume that they have in common, mm3.
    """
    names = f"{first.name} and {second.name}"
    where = np.array([gap.at] if gap.at is not None else np.zeros((0, 3)))
    if clearance is None:
        message = f"the smallest gap between {names} is {gap.min:.4g} mm; no clearance was asked for"
        return Check(code, ok=False, skipped=True, message=message, where=where)
    if clearance == 0.0:
        return _touching_check(code, names, gap, where, shared=shared)
    if gap.min == 0.0 and common > 0.0:
        message = f"{names} must be {clearance:.4g} mm apart, and they overlap: {common:.6g} mm3 lie in both"
        return Check(code, ok=False, message=message, where=where)
    if gap.queried is not None and gap.queried > QUERIED_SHARE * gap.min:
        message = (
            f"Manifold finds a gap of {gap.min:.4g} mm between {names}, which distance queries could not confirm: "
            f"the nearest places they found are {gap.queried:.4g} mm apart"
        )
        return Check(code, ok=False, skipped=not gap.min < GAP_SHARE * clearance, message=message, where=where)
    ok = not gap.min < GAP_SHARE * clearance
    spot = "" if ok or gap.at is None else f", at {place(gap.at)}"
    return Check(
        code,
        ok=ok,
        message=f"the gap between {names} must be at least {GAP_SHARE * clearance:.4g} mm, {GAP_SHARE:.0%} "
        f"of the clearance of {clearance:.4g} mm, and the smallest is {gap.min:.4g} mm{spot}",
        where=where,
    )


def _touching_check(code: str, names: str, gap: Gap, where: Floats, *, shared: float) -> Check:
    """Check that parts that are to be one share faces, of an area in mm2."""
    wanted = f"{names} must share faces, as the clearance is 0"
    if gap.min > TOUCHING:
        spot = "" if gap.at is None else f", at {place(gap.at)}"
        message = f"{wanted}, and nowhere are they nearer to each other than {gap.min:.4g} mm{spot}"
        return Check(code, ok=False, message=message, where=where)
    if shared == 0.0:
        message = f"{wanted}, and they share none: they overlap, or touch at points or edges only"
        return Check(code, ok=False, message=message, where=where)
    return Check(code, ok=True, message=f"{wanted}, and they share {shared:.4g} mm2")


def widest_gap_check(
    code: str, first: Part, second: Part, gap: Gap, *, clearance: float | None, tolerance: float | None = None
) -> Check:
    """Check that the gap is nowhere far too wide along the joint's mid-line; points at the widest place.

    What to do about it depends on the surface's chord error, `tolerance`, mm, if it is known.
    """
    names = f"{first.name} and {second.name}"
    if not clearance or gap.max is None or gap.max_at is None:
        missing = "the joint's mid-line is" if clearance else "a clearance is"
        message = f"how wide the gap between {names} becomes was not judged, because {missing} not known"
        if clearance == 0.0:
            message = f"{names} are to touch: the clearance is 0, so there is no gap to become wide"
        return Check(code, ok=False, skipped=True, message=message)
    ok = not gap.max > WIDEST * clearance
    spot = "" if ok else f", at {place(gap.max_at)}; {_narrowing(gap.max - clearance, tolerance)}"
    return Check(
        code,
        ok=ok,
        message=f"the gap between {names} must be at most {WIDEST * clearance:.4g} mm along the joint's mid-line, "
        f"{WIDEST:g} times the clearance, and the widest is {gap.max:.4g} mm{spot}",
        where=np.array([gap.max_at]),
    )


def _narrowing(excess: float, tolerance: float | None) -> str:
    """Say how to make a gap narrower that is by `excess`, mm, too wide."""
    if tolerance is not None and excess <= CHORDS * tolerance:
        return (
            f"ask for a solid.tolerance smaller than {tolerance:.4g} mm, by which the triangles may be off, "
            "or for a larger pattern.tile_size"
        )
    return "the surface bends sharply there for its tiles: ask for a larger pattern.tile_size"


def whole_check(code: str, volumes: Mapping[str, float], spaces: Spaces | None) -> Check:
    """Check that the volumes of the parts and of the gap between them add up to that of the uncut shell.

    Parameters
    ----------
    code : str
    volumes : mapping of str to float
        Of each part, by its name, mm3.
    spaces : Spaces or None
        Volumes of the space between the parts, and of the whole, uncut. Skipped where they are not known.
    """
    if spaces is None:
        message = "volumes were not added up, because the uncut shell is not known"
        return Check(code, ok=False, skipped=True, message=message)
    total, whole = spaces.gap + sum(volumes.values()), spaces.shell
    return Check(
        code,
        ok=abs(total - whole) <= VOLUME_SHARE * abs(whole),
        message=f"{', '.join(volumes)} and the gap must add up to the shell's {whole:.6g} mm3 within "
        f"{VOLUME_SHARE:.1%}, and they have {total:.6g} mm3",
    )


def _piece_places(common: Manifold) -> Floats:
    """Return a place on the surface of each connected piece, (k, 3), mm, the largest piece first."""
    pieces = sorted(common.decompose(), key=lambda piece: -piece.volume())[:MOST_PLACES]
    return np.array([_central_place(piece) for piece in pieces]).reshape(-1, 3)


def _central_place(piece: Manifold) -> Floats:
    """Return the triangle's centroid nearest to the middle of the bounding box of a piece, (3,), mm.

    The middle itself is outside a bent piece.
    """
    mesh = piece.to_mesh64()
    centroids = np.asarray(mesh.vert_properties)[:, :3][np.asarray(mesh.tri_verts)].mean(axis=1)
    middle = np.reshape(piece.bounding_box(), (2, 3)).mean(axis=0)
    nearest: Floats = centroids[np.linalg.norm(centroids - middle, axis=1).argmin()]
    return nearest
