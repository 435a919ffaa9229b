"""What a field needs from files: a picture, or the values of a mesh."""

from __future__ import annotations

from typing import TypeAlias

from fabricate.arrays import Floats
from fabricate.config.field_config import AttributeConfig, FieldConfig, ImageConfig
from fabricate.config.source_config import FileConfig, SourceConfig
from fabricate.formats.limits import DEFAULT_LIMITS, ReadLimits
from fabricate.formats.point_values import PointValues
from fabricate.formats.read_image import read_luminance
from fabricate.formats.reading import read_attribute

FieldSource: TypeAlias = Floats | PointValues | None
"""Luminance, (height, width), of a picture; or values at the points of a mesh, in the unit of its file; or nothing."""


def field_source(
    field: FieldConfig | None, source: SourceConfig, *, limits: ReadLimits = DEFAULT_LIMITS
) -> FieldSource:
    """Read what a field takes from files.

    Raises
    ------
    ReadError
        If a file is missing, damaged, or not what was expected; the message begins with its path.
    """
    if isinstance(field, ImageConfig):
        return read_luminance(field.file)
    if isinstance(field, AttributeConfig) and isinstance(source, FileConfig):
        return read_attribute(source.file, field.attribute, limits=limits)
    return None
