"""The files of a coupon: every solid in one STL, two colours in the 3MF, and a picture."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from coupons import tried
from PIL import Image

from fabricate.checks.judge import read_part
from fabricate.errors import OutputError
from fabricate.formats.reading import read_mesh
from fabricate.output.coupon_files import write_coupon
from fabricate.solid.booleans import manifold_of


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("coupon")
    assert write_coupon(folder, tried("ring"), name="ring-coupon") == folder / "coupon.stl"
    return folder


def test_these_files_are_written_and_no_others(folder: Path) -> None:
    assert {path.name for path in folder.iterdir()} == {"coupon.stl", "coupon.3mf", "preview.png"}


def test_the_stl_holds_the_plate_and_ten_loose_pieces_flat_on_the_bed(folder: Path) -> None:
    part, made = read_part(folder / "coupon.stl"), tried("ring")
    solids = manifold_of(part).decompose()
    assert len(solids) == 11
    assert [solid.bounding_box()[2] for solid in solids] == [0.0] * 11
    wanted = [manifold_of(made.plate).volume(), *(manifold_of(piece.part).volume() for piece in made.pieces)]
    assert sorted(solid.volume() for solid in solids) == pytest.approx(sorted(wanted), rel=1e-6)


def test_the_3mf_holds_the_same(folder: Path) -> None:
    made, mesh = tried("ring"), read_mesh(folder / "coupon.3mf")
    assert len(mesh.face_sizes) == len(made.plate.triangles) + len(made.inserts.triangles)
    assert np.ptp(mesh.points, axis=0) == pytest.approx(np.ptp(read_part(folder / "coupon.stl").points, axis=0))


def test_the_picture_shows_the_plate_and_what_is_loose_in_two_colours(folder: Path) -> None:
    pixels = np.asarray(Image.open(folder / "preview.png")).astype(int)
    blue = pixels[:, :, 2] > pixels[:, :, 0] + 40
    yellow = pixels[:, :, 0] > pixels[:, :, 2] + 60
    assert 0.3 < blue.mean() < 0.9
    assert 0.002 < yellow.mean() < 0.2


def test_a_place_that_is_none_is_said(tmp_path: Path) -> None:
    with pytest.raises(OutputError):
        write_coupon(tmp_path / "none", tried("ring"), name="ring-coupon")
