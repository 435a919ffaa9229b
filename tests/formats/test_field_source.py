"""What fields read: a picture, values of a mesh, or nothing."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from mesh_bytes import ply_with_values
from PIL import Image

from fabricate.config import AttributeConfig, FieldConfig, FileConfig, HeightConfig, ImageConfig, TorusConfig
from fabricate.errors import ReadError
from fabricate.formats.field_source import field_source
from fabricate.formats.point_values import PointValues


def test_a_picture_comes_as_its_luminance(tmp_path: Path) -> None:
    Image.new("L", (3, 2), 255).save(tmp_path / "white.png")
    found = field_source(ImageConfig(kind="image", image=str(tmp_path / "white.png")), TorusConfig())
    assert isinstance(found, np.ndarray)
    assert found.tolist() == [[1.0] * 3] * 2


def test_an_attribute_comes_with_its_mesh(tmp_path: Path) -> None:
    path = tmp_path / "some.ply"
    path.write_bytes(ply_with_values("heat", [1, 2, 3, 4]))
    found = field_source(AttributeConfig(kind="attribute", attribute="heat"), FileConfig(path=str(path)))
    assert isinstance(found, PointValues)
    assert found.values.tolist() == [1, 2, 3, 4]
    with pytest.raises(ReadError, match=r"some\.ply: an attribute 'cold' .* found heat"):
        field_source(AttributeConfig(kind="attribute", attribute="cold"), FileConfig(path=str(path)))


@pytest.mark.parametrize("field", [None, HeightConfig(kind="height")])
def test_other_fields_read_nothing(field: FieldConfig | None) -> None:
    assert field_source(field, TorusConfig()) is None
