"""Judging coupons from their files: all good where they are, and every fault found in the piece that has it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from coupons import CLEARANCE, subject, tried

from fabricate.checks.judged_coupon import JudgedCoupon, judged_coupon
from fabricate.errors import ReadError
from fabricate.output.stl import write_stl
from fabricate.solid.booleans import manifold_of
from fabricate.solid.part import Part, joined
from fabricate.surface.neck import tile_necks

Changed = Callable[[list[Part]], Sequence[Part]]


def judged(folder: Path, change: Changed = list) -> JudgedCoupon:
    """Judge the coupon of the ring after a change to its solids: the plate, and then the pieces in order."""
    made = tried("ring")
    solids = change([made.plate, *(piece.part for piece in made.pieces)])
    write_stl(folder / "coupon.stl", joined("coupon", solids))
    return judged_coupon(folder / "coupon.stl", made)


def moved(part: Part, *way: float) -> Part:
    return replace(part, points=part.points + np.array(way))


def failed(found: JudgedCoupon) -> set[str]:
    return {check.code for check in found.checks if check.failed}


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> JudgedCoupon:
    return judged(tmp_path_factory.mktemp("good"))


def test_every_check_of_a_coupon_passes(good: JudgedCoupon) -> None:
    assert [check.message for check in good.checks if not check.ok] == []
    labels, kinds = ("0.20", "0.25", "0.30", "0.35", "0.40"), ("neck", "bend")
    assert [check.code for check in good.checks][-10:] == [f"coupon.{x}.{y}.gap" for x in labels for y in kinds]
    assert {"coupon.closed", "coupon.pieces", "coupon.flat", "coupon.self_intersections"} < {
        check.code for check in good.checks
    }


def test_facts_are_those_of_the_solids(good: JudgedCoupon) -> None:
    made = tried("ring")
    plate = manifold_of(made.plate)
    for facts, piece in zip(good.pieces, made.pieces, strict=True):
        solid = manifold_of(piece.part)
        assert facts.gap_mm is not None
        assert facts.gap_mm.min == pytest.approx(solid.min_gap(plate, 1.0), abs=1e-6)
        assert facts.volume_mm3 == pytest.approx(solid.volume(), rel=1e-6)
    assert good.size_mm == pytest.approx(np.ptp(made.plate.points, axis=0).tolist(), abs=1.0)
    assert good.triangles == sum(len(part.triangles) for part in (made.plate, made.inserts))


def test_the_neck_that_is_measured_is_the_narrowest_less_the_clearance(good: JudgedCoupon) -> None:
    narrowest = tile_necks(subject("ring").surface)[0].min()
    assert good.neck.size_mm == good.neck.wanted_mm == narrowest
    necks = [facts.neck_mm for facts in good.pieces if facts.kind == "neck"]
    widths = [neck.min for neck in necks if neck is not None]
    assert len(widths) == 5
    assert np.diff(widths) == pytest.approx(-0.05, abs=0.02)
    assert all(0.6 * narrowest < width < narrowest for width in widths)


def test_a_piece_too_near_to_the_plate_is_found_in_its_place(tmp_path: Path) -> None:
    number = 1 + 2 * 2  # the neck at the sculpture's own clearance
    found = judged(tmp_path, lambda solids: [*solids[:number], moved(solids[number], 0.1, 0, 0), *solids[number + 1 :]])
    assert failed(found) == {"coupon.0.30.neck.gap"}
    (check,) = (check for check in found.checks if check.failed)
    middle = tried("ring").pieces[number - 1].middle
    assert np.hypot(*(check.where[0, :2] - middle)) < tried("ring").pieces[number - 1].window.radius
    (facts,) = (facts for facts in found.pieces if (facts.label, facts.kind) == ("0.30", "neck"))
    assert facts.gap_mm is not None
    assert facts.gap_mm.min < 0.95 * CLEARANCE


def test_a_piece_that_is_missing_is_missed_and_its_gap_is_not_measured(tmp_path: Path) -> None:
    found = judged(tmp_path, lambda solids: solids[:-1])
    assert failed(found) == {"coupon.pieces"}
    assert {check.code for check in found.checks if check.skipped} == {"coupon.0.40.bend.gap"}
    assert found.pieces[-1].gap_mm is None


def test_a_piece_that_floats_is_found(tmp_path: Path) -> None:
    found = judged(tmp_path, lambda solids: [*solids[:-1], moved(solids[-1], 0, 0, 0.25)])
    assert "coupon.flat" in failed(found)
    (check,) = (check for check in found.checks if check.code == "coupon.flat")
    assert check.where[:, 2] == pytest.approx([0.25])


def test_a_hole_is_found(tmp_path: Path) -> None:
    def holed(solids: list[Part]) -> list[Part]:
        return [replace(solids[0], triangles=solids[0].triangles[1:]), *solids[1:]]

    assert "coupon.closed" in failed(judged(tmp_path, holed))


def test_a_file_that_is_missing_is_said(tmp_path: Path) -> None:
    with pytest.raises(ReadError):
        judged_coupon(tmp_path / "none.stl", tried("ring"))
