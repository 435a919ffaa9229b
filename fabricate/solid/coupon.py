"""A fit coupon: small pieces of a sculpture's own joint at five clearances, in one flat plate.

The plate has two rows of round windows, the narrowest neck above and a typical bend below it, a column for each
clearance, and under each column the clearance in raised digits:

     ( )   ( )   ( )   ( )   ( )     neck
     ( )   ( )   ( )   ( )   ( )     bend
     0.20  0.25  0.30  0.35  0.40    mm

In each window one piece is loose: the one joined by the neck, or that inside of the bend. All that faces it belongs
to the plate. Everything lies flat on z = 0.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from manifold3d import Manifold

from fabricate.arrays import Floats, Mask
from fabricate.errors import SolidError
from fabricate.solid.assembly import Assembly, Core, assembly
from fabricate.solid.booleans import Cylinder, bar, manifold_of, part_of, united
from fabricate.solid.coupon_places import CouponPlace, Kind, bend_places, neck_places
from fabricate.solid.coupon_window import CouponWindow, widest_window
from fabricate.solid.joint import STRAIGHT, Joint, fitted_joint
from fabricate.solid.lettering import raised_text, text_width
from fabricate.solid.part import Part, joined
from fabricate.solid.sound_turn import TURNS, is_sound
from fabricate.surface.cut import CutSurface

STEPS = (-2, -1, 0, 1, 2)
"""The clearances, in steps from that of the sculpture."""

STEP, COARSE, FINE = 0.2, 0.05, 0.01
"""A step is a fifth of the clearance, in whole twentieths of a millimetre, or hundredths where that would be none."""

WIDEST = 1.1
"""Radius of a window that has room, in sides of the tile."""

LEAST_RADIUS, MOST_RADIUS = 5.0, 12.0
"""Between these, mm, lies the radius of a window that has room."""

HOLD, LOOSE = 1.0, 1.5
"""How much of the wall beside a neck, and of what is loose, fits into the smallest window at least, mm."""

ROOM, ROOM_CLEARANCES = 0.8, 2.0
"""How far what is loose ends from the window's rim: so many mm or largest clearances, whichever is more."""

INTO_PLATE = 0.5
"""How far held pieces reach into the plate, mm."""

PLATE, BAR = 1.2, 3.0
"""Thickness of the plate, unless the process needs more, and least width of what is between windows, mm."""

DIGITS, STROKE, RAISED = 6.0, 1.0, 0.6
"""Height of digits, width of their strokes, and how high they stand above the plate, mm."""

TOLERANCE = 0.05
"""Chord error of round cuts, mm."""


class CouponPiece(NamedTuple):
    """What is loose in one window: at which clearance, through which window, and where its middle is, (2,) mm."""

    clearance: float
    window: CouponWindow
    middle: Floats
    part: Part


@dataclass(frozen=True, eq=False)
class Coupon:
    """The plate and what is loose in it.

    Attributes
    ----------
    plate : Part
        The plate with all that is held, and the labels.
    pieces : tuple of CouponPiece
        Clearance after clearance, of each the neck and then the bend.
    labels : tuple of str
        What is written under the columns: the clearances in mm.
    thickness : float
        Of the plate, mm.
    regions : int
        How many regions the sculpture has.
    wanted : mapping of str to float
        Width of the narrowest neck of all, and radius of the bend nearest to the median, mm, by the kind of place.
    """

    plate: Part
    pieces: tuple[CouponPiece, ...]
    labels: tuple[str, ...]
    thickness: float
    regions: int
    wanted: Mapping[Kind, float]

    def __post_init__(self) -> None:
        object.__setattr__(self, "wanted", MappingProxyType(dict(self.wanted)))

    @property
    def inserts(self) -> Part:
        """All that is loose, as one part."""
        return joined("inserts", [piece.part for piece in self.pieces])


def coupon_clearances(clearance: float) -> tuple[float, ...]:
    """Return five clearances, mm, evenly spaced about that of the sculpture.

    They are a fifth of it apart, in whole steps of 0.05 mm; of less than 0.15 mm in steps of 0.01 mm.

    Raises
    ------
    SolidError
        If it is 0, or so small that no hundredths of a millimetre lie between the steps.
    """
    if clearance == 0.0:
        raise SolidError(
            "a fit coupon needs a gap to try, and solid.clearance is 0 mm: parts that touch need none; "
            'ask for one of solid.clearance such as "0.3 mm"'
        )
    grain = COARSE if clearance >= 3.0 * COARSE else FINE
    step = max(round(STEP * clearance / grain), 1) * grain
    if clearance <= 2.0 * step:
        raise SolidError(f"a fit coupon needs a solid.clearance of more than {2 * FINE:g} mm, found {clearance:g} mm")
    return tuple(round(clearance + count * step, 6) for count in STEPS)


def label(clearance: float) -> str:
    """Return a clearance as it stands on the coupon: in mm, with two decimals or as many more as it has."""
    text = f"{clearance:.6f}".rstrip("0")
    return max(text, f"{clearance:.2f}", key=len)


def coupon(
    surface: CutSurface,
    joined_yellow: Mask,
    make: Callable[[float], Assembly],
    *,
    clearance: float,
    core: Core,
    joint: Joint = STRAIGHT,
    thickness: float = 0.0,
    wall: float,
) -> Coupon:
    """Make a fit coupon of a sculpture's surface; lengths in mm.

    The solids are made for the largest clearance; those for the others have the same inner side of the wall.

    Parameters
    ----------
    surface : CutSurface
    joined_yellow : (t,) bool
        Which tiles are yellow-joined.
    make : callable
        Makes the solids of the surface for a clearance.
    clearance : float
        That of the sculpture.
    core : {"hollow", "yellow", "blue"}
    joint : Joint
        As the sculpture is to have it; what it leaves open is fitted as for the sculpture's own clearance.
    thickness : float
        Of the thinnest walls; straight joints do not need it.
    wall : float
        Thinnest wall that comes out.

    Raises
    ------
    SolidError
        If the clearance is 0, the solids cannot be made with the largest one, the surface is nowhere flat enough for a
        piece with a flat back, or round cuts leave no sound piece.
    """
    clearances = coupon_clearances(clearance)
    inner = make(clearances[-1]).inner
    own = fitted_joint(surface, inner, joint, thickness=thickness, clearance=clearance)
    made = [assembly(surface, inner, clearance=each, core=core, joint=own) for each in clearances]
    wish = _WindowWish(inner, clearances[-1], wall)
    offered = neck_places(surface, joined_yellow), bend_places(surface, joined_yellow)
    windows = _first_window(surface, offered[0], wish), _first_window(surface, offered[1], wish)
    plan = _Plan(windows, tuple(map(label, clearances)), max(PLATE, wall), _room(clearances[-1]))
    crops = [
        [_cropped(solids, window, plan.middle(row, column)) for row, window in enumerate(windows)]
        for column, solids in enumerate(map(_solids, made))
    ]
    plate, inserts = _put_together_soundly(plan, crops)
    pieces = tuple(
        CouponPiece(clearances[k // 2], windows[k % 2], plan.middle(k % 2, k // 2), part)
        for k, part in enumerate(inserts)
    )
    wanted = {places[0].kind: places[0].size for places in offered}
    return Coupon(plate, pieces, plan.labels, plan.thickness, len(surface.rings) + 1, wanted)


class _WindowWish(NamedTuple):
    """What windows are chosen for: the inner side of the wall, the largest clearance and the thinnest wall, mm."""

    inner: Floats
    clearance: float
    wall: float


@dataclass(frozen=True, eq=False)
class _Plan:
    """Where everything lies on the plate: windows row by row from the top, a column for each label; mm."""

    windows: tuple[CouponWindow, ...]
    labels: tuple[str, ...]
    thickness: float
    room: float

    @property
    def pitch(self) -> float:
        """From one column to the next."""
        widths = [text_width(text, height=DIGITS, stroke=STROKE) for text in self.labels]
        return BAR + max(*(2.0 * window.radius for window in self.windows), BAR + max(widths))

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the plate."""
        above = sum(2.0 * window.radius + BAR for window in self.windows)
        return BAR + self.pitch * len(self.labels), 2.0 * BAR + DIGITS + above

    def middle(self, row: int, column: int) -> Floats:
        """Return the middle of a window, (2,)."""
        above = sum(2.0 * window.radius + BAR for window in self.windows[:row])
        return np.array([self._column(column), self.size[1] - BAR - above - self.windows[row].radius])

    def lower_left(self, column: int) -> tuple[float, float]:
        """Return where a label begins."""
        width = text_width(self.labels[column], height=DIGITS, stroke=STROKE)
        return self._column(column) - 0.5 * width, BAR

    def _column(self, column: int) -> float:
        return 0.5 * BAR + self.pitch * (column + 0.5)


def _room(clearance: float) -> float:
    return max(ROOM, ROOM_CLEARANCES * clearance)


def _first_window(surface: CutSurface, places: Sequence[CouponPlace], wish: _WindowWish) -> CouponWindow:
    """Return a window at the first place that has one."""
    for place in places:
        neck = place.kind == "neck"
        if neck and place.size < wish.clearance + 0.5 * wish.wall:
            continue
        inside = _room(wish.clearance) + max(LOOSE, wish.clearance)
        least = max(inside, 0.5 * place.size + wish.clearance + HOLD if neck else 0.0)
        window = widest_window(
            surface,
            wish.inner,
            place,
            widest=max(float(np.clip(WIDEST * place.side, LEAST_RADIUS, MOST_RADIUS)), least),
            least=least,
            border=INTO_PLATE + 2.0 * TOLERANCE,
            rim=wish.wall,
        )
        if window is not None:
            return window
    raise SolidError(
        f"a fit coupon needs a {places[0].kind} that a clearance of {wish.clearance:g} mm fits into, where the surface "
        f"is flat enough for a piece with a flat back, and none of the {len(places)} looked at is one; ask for a "
        "smaller solid.clearance, a larger solid.thickness or a larger source.size"
    )


def _solids(made: Assembly) -> list[Manifold]:
    return [manifold_of(part) for part in made.parts]


def _cropped(solids: Sequence[Manifold], window: CouponWindow, middle: Floats) -> list[Manifold]:
    """Return of each solid a little more than the window shows, moved to where it lies on the plate."""
    up, at = window.axes[2], window.place.at
    beyond = Cylinder(at - (window.depth + 1.0) * up, at + (window.height + 1.0) * up, window.radius + INTO_PLATE + 1.0)
    crop = bar(beyond, tolerance=TOLERANCE)
    move = np.column_stack([window.axes, window.seen(np.zeros((1, 3)))[0] + [*middle, 0.0]])
    return [(solid ^ crop).transform(move) for solid in solids]


def _put_together_soundly(plan: _Plan, crops: Sequence[Sequence[Sequence[Manifold]]]) -> tuple[Part, list[Part]]:
    """Return the plate and what is loose in it, with round cuts at the first turn that leaves everything sound."""
    for turn in TURNS:
        plate, inserts = _put_together(plan, crops, turn=turn)
        if all(map(is_sound, (plate, *inserts))):
            return plate, inserts
    raise SolidError(
        f"round cuts leave triangles of the coupon that cross or have no area once coordinates are rounded, at each of "
        f"{len(TURNS)} turns tried; ask for another solid.clearance or pattern.seed"
    )


def _put_together(
    plan: _Plan, crops: Sequence[Sequence[Sequence[Manifold]]], *, turn: float
) -> tuple[Part, list[Part]]:
    """Return the plate and what is loose in it, with round cuts turned by some degrees."""
    width, height = plan.size
    plate = Manifold.cube([width, height, plan.thickness])
    openings, held, loose = [], [_label(plan, column) for column in range(len(plan.labels))], []
    for column, row_crops in enumerate(crops):
        for row, (window, crop) in enumerate(zip(plan.windows, row_crops, strict=True)):
            middle = plan.middle(row, column)
            openings.append(_round(middle, window.radius, -1.0, plan.thickness + 1.0, turn))
            frame = _round(middle, window.radius + INTO_PLATE, 0.0, window.height, turn)
            held += [solid ^ frame for region, solid in enumerate(crop) if region != window.place.region]
            inside = _round(middle, window.radius - plan.room, 0.0, window.height, turn)
            loose.append(_nearest_piece(crop[window.place.region] ^ inside, np.array([*middle, window.depth])))
    whole = plate - united(openings) + united(held)
    largest = max(whole.decompose(), key=lambda piece: piece.volume())
    return part_of("plate", largest), [part_of("insert", each) for each in loose]


def _round(middle: Floats, radius: float, bottom: float, top: float, turn: float) -> Manifold:
    """Return an upright bar."""
    return bar(Cylinder(np.array([*middle, bottom]), np.array([*middle, top]), radius), tolerance=TOLERANCE, turn=turn)


def _label(plan: _Plan, column: int) -> Manifold:
    """Return a label in its place; it begins within the plate."""
    within = 0.5 * plan.thickness
    text = raised_text(plan.labels[column], height=DIGITS, stroke=STROKE, thickness=plan.thickness + RAISED - within)
    return text.translate([*plan.lower_left(column), within])


def _nearest_piece(solid: Manifold, at: Floats) -> Manifold:
    """Return the piece of a solid with the vertex nearest to a place, (3,)."""
    return min(
        solid.decompose(),
        key=lambda piece: float(np.linalg.norm(piece.to_mesh64().vert_properties[:, :3] - at, axis=1).min()),
    )
