"""The parts of a divided body, with their stand and openings, within the polygons that a print shop accepts.

A surface that is divided more coarsely to keep that limit may make parts that are not good enough. Then nothing is
made, and it is said how many polygons would do.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from fabricate.checks.check import Check
from fabricate.checks.expectations import Expectations
from fabricate.checks.finished import with_finish
from fabricate.checks.judge import judged_parts
from fabricate.checks.measured import expectations
from fabricate.checks.shop import polygons_wording
from fabricate.config import Config
from fabricate.dividing import Divided, divided_again, polygon_budget
from fabricate.duotone.certificate import Certificate
from fabricate.errors import SolidError
from fabricate.process import PROCESSES
from fabricate.solid.assembly import Assembly
from fabricate.solid.finish import Finished, finished
from fabricate.solid.polygon_budget import largest_part
from fabricate.solid.solids import solids
from fabricate.surface.cut import CutSurface
from fabricate.surface.cut_certificate import cut_certificate
from fabricate.wishes import finish_wish, joint_wish, wall_thickness

ROUNDS = 4
"""How often a surface is divided anew because the finish has added more triangles than before."""

STEP = 1.4
"""By which factor the tolerance falls from one attempt to the next in the search for polygons that would do."""


class Made(NamedTuple):
    """A divided body, what is proved of its curve, its parts, and these with their stand and openings."""

    divided: Divided
    certificate: Certificate
    solids: Assembly
    ready: Finished

    @property
    def surface(self) -> CutSurface:
        """The surface that the parts are made of."""
        return self.divided.fitting.surface

    @property
    def largest(self) -> int:
        """How many triangles the largest part has."""
        return max(len(part.triangles) for part in self.ready.parts)


def made(found: Divided, config: Config) -> Made:
    """Make the parts of a body, divided more coarsely where stand and openings would take more than the shop accepts.

    Raises
    ------
    SolidError
        If parts can't be made, or have too many triangles however coarsely the surface is divided.
    """
    parts, shop, budget = _made(found, config), config.process.shop, polygon_budget(config)
    if shop is None or budget is None:
        return parts
    for _ in range(ROUNDS):
        if parts.largest <= budget:
            return parts
        added = parts.largest - largest_part(parts.surface, core=config.solid.core)
        tolerance = parts.divided.fitting.tolerance
        parts = _made(divided_again(found, config, tolerance=tolerance, budget=budget - added), config)
    if parts.largest <= budget:
        return parts
    raise SolidError(
        f"the largest part has {parts.largest} triangles with its stand and openings, and "
        f"{polygons_wording(shop)}; ask for no stand and openings, or for a larger limit"
    )


def made_solids(surface: CutSurface, config: Config, *, clearance: float) -> Assembly:
    """Make the parts of a config from its cut surface, with walls `clearance` mm apart."""
    return solids(
        surface,
        thickness=wall_thickness(surface, config),
        clearance=clearance,
        core=config.solid.core,
        joint=joint_wish(config),
    )


def wanted(parts: Made, config: Config) -> Expectations:
    """Return what the finished parts should be, when they are read back from their files."""
    surface, solid = parts.surface, config.solid
    expected = expectations(
        surface,
        parts.solids,
        parts.certificate,
        clearance=solid.clearance,
        core=solid.core,
        tolerance=parts.divided.fitting.tolerance,
        process=PROCESSES[config.process.name],
        shop=config.process.shop,
    )
    return with_finish(expected, parts.ready)


def check_fine_enough(parts: Made, config: Config, checks: tuple[Check, ...]) -> None:
    """Refuse parts that fail a check only because the shop's limit of polygons made them coarse.

    `checks` are those of the parts.

    Raises
    ------
    SolidError
        If parts of the same curve pass these checks when they are finer; says how many polygons that takes.
    """
    failed, shop = [check for check in checks if check.failed], config.process.shop
    if shop is None or not failed or parts.divided.fitting.tolerance <= config.solid.tolerance:
        return
    enough = next((count for count, bad in _finer(parts, config) if not bad & {check.code for check in failed}), None)
    if enough is None:
        return
    raise SolidError(
        f"{polygons_wording(shop)} triangles, and parts as coarse as that fail {failed[0].code}: "
        f"{failed[0].message.partition(';')[0]}; {enough} triangles would do: raise the limit to as many, or ask for a "
        "larger pattern.tile_size"
    )


def _finer(parts: Made, config: Config) -> Iterator[tuple[int, set[str]]]:
    """Yield the triangles of the largest part, and the checks that fail, of finer and finer parts."""
    tolerance, count = parts.divided.fitting.tolerance, parts.largest
    while tolerance > config.solid.tolerance:
        tolerance = max(tolerance / STEP, config.solid.tolerance)
        finer = _made(divided_again(parts.divided, config, tolerance=tolerance, budget=None), config)
        if finer.largest > count:
            count = finer.largest
            judged = judged_parts(finer.ready.parts, wanted(finer, config))
            yield count, {check.code for check in judged.checks if check.failed}


def _made(found: Divided, config: Config) -> Made:
    surface = found.fitting.surface
    own = made_solids(surface, config, clearance=config.solid.clearance)
    return Made(found, cut_certificate(surface), own, finished(surface, own, finish_wish(config)))
