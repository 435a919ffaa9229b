"""Fit coupons: from a config to a folder with a small plate to print before the sculpture."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from fabricate.checks.coupon_report import CouponReport, coupon_report_json
from fabricate.checks.judged_coupon import judged_coupon
from fabricate.config import Config, config_sha256, moved_config, resolved_toml
from fabricate.dividing import Body, divided, read_bodies
from fabricate.making import made_solids
from fabricate.output.coupon_files import write_coupon
from fabricate.output.files import write_whole
from fabricate.output.folder import checked_place, complete_folder
from fabricate.prepare.store import NOTHING_KEPT, Store
from fabricate.process import PROCESSES
from fabricate.solid.coupon import coupon, coupon_clearances
from fabricate.versions import program_versions
from fabricate.wishes import joint_wish


def make_coupon(
    config: Config, *, name: str, out: Path, progress: Callable[[str], None], store: Store = NOTHING_KEPT
) -> tuple[CouponReport, ...]:
    """Make the fit coupon of a config's sculpture in the folder `out / name`, and return what was measured of it.

    With `prepare.components = "each"` every body has a coupon of its own, in `out / name-1` and so on. `progress` is
    called with each stage's name as it begins. The `store` is that of `pipeline.run`.

    Raises
    ------
    FabricateError
        If the config, the mesh or the place to write is wrong, or the clearance is 0; then nothing is written.
    """
    checked_place(out / name)
    coupon_clearances(config.solid.clearance)
    bodies = read_bodies(config, name=name, progress=progress, store=store)
    return tuple(_coupon(body, config, out=out, store=store) for body in bodies)


def _coupon(body: Body, config: Config, *, out: Path, store: Store) -> CouponReport:
    """Make the coupon of one body."""
    name, watch = body.name, body.watch
    found = divided(body, config, store=store)
    surface, clearance = found.fitting.surface, config.solid.clearance
    watch.begin("solids")
    made = coupon(
        surface,
        found.design.duotone.joined,
        lambda each: made_solids(surface, config, clearance=each),
        clearance=clearance,
        core=config.solid.core,
        joint=joint_wish(config),
        thickness=config.solid.thickness_range[0],
        wall=PROCESSES[config.process.name].wall_min,
    )
    with complete_folder(out / name) as folder:
        watch.begin("files")
        path = write_coupon(folder, made, name=name)
        write_whole(folder / "config.toml", resolved_toml(moved_config(config, out / name)).encode())
        watch.begin("checks")
        judged = judged_coupon(path, made)
        report = CouponReport(name, path.name, config_sha256(config), program_versions(), judged, watch.ended())
        write_whole(folder / "report.json", coupon_report_json(report).encode())
    return report
