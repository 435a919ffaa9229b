"""The whole config: its sections, and what they owe each other."""

from __future__ import annotations

from typing import Self

from pydantic import BaseModel, ConfigDict, model_validator
from pydantic_core import PydanticCustomError

from fabricate.config.curve_config import CurveConfig
from fabricate.config.field_config import AttributeConfig, DirectionConfig, FieldSection
from fabricate.config.optimise_config import OptimiseConfig
from fabricate.config.pattern_config import PatternConfig
from fabricate.config.prepare_config import PrepareConfig
from fabricate.config.process_config import ProcessConfig, with_process_defaults
from fabricate.config.section import wrong_value
from fabricate.config.solid_config import SolidConfig
from fabricate.config.source_config import FileConfig, Source
from fabricate.units import format_length


class Config(BaseModel):
    """One run: what to divide, the curve, the parts and how they are made. Lengths in mm."""

    model_config = ConfigDict(frozen=True, extra="forbid", use_attribute_docstrings=True)

    source: Source
    """What to divide: a built-in shape, or a mesh file."""
    prepare: PrepareConfig = PrepareConfig()
    """Repair, components, cells and sharp edges of the mesh."""
    pattern: PatternConfig = PatternConfig()
    """The curve."""
    curve: CurveConfig = CurveConfig()
    """What else is made of the curve."""
    field: FieldSection | None = None
    """What a tree = "field" follows, and the alignment that is optimised."""
    optimise: OptimiseConfig = OptimiseConfig()
    """What the curve is made better for."""
    solid: SolidConfig = SolidConfig()
    """The parts."""
    process: ProcessConfig = ProcessConfig()
    """How the parts are made: defaults and limits."""

    @model_validator(mode="before")
    @classmethod
    def _fill_from_process(cls, data: object) -> object:
        return with_process_defaults(data)

    @model_validator(mode="after")
    def _field_is_followed(self) -> Self:
        if self.pattern.tree == "field" and self.field is None:
            raise wrong_value("pattern.tree", 'expected a section [field] beside tree = "field", found none')
        if self.optimise.alignment and not isinstance(self.field, DirectionConfig):
            raise wrong_value("optimise.alignment", 'expected a section [field] of kind = "direction", found none')
        if self.field is not None and self.pattern.tree != "field" and not self.optimise.alignment:
            raise wrong_value("field", 'nothing follows this field: say tree = "field" in [pattern], or remove [field]')
        if isinstance(self.field, AttributeConfig) and not isinstance(self.source, FileConfig):
            raise wrong_value("field.kind", 'kind = "attribute" reads values of a PLY file, but [source] has no path')
        return self

    @model_validator(mode="after")
    def _fits_together(self) -> Self:
        size, solid, tile = self.source.size, self.solid, self.pattern.tile_size
        thinnest, thickest = solid.thickness_range
        if thickest >= size / 2:
            limit = f"less than half the size, {format_length(size / 2)}"
            raise _too_large("solid.thickness", thickest, limit)
        if solid.clearance >= 4 * thinnest:
            limit = f"less than four times the thickness, {format_length(4 * thinnest)}"
            raise _too_large("solid.clearance", solid.clearance, limit)
        if solid.openings is not None and solid.openings.diameter > size:
            raise _too_large(
                "solid.openings.diameter", solid.openings.diameter, f"at most the size, {format_length(size)}"
            )
        if solid.base is not None and solid.base.height > size:
            raise _too_large("solid.base.height", solid.base.height, f"at most the size, {format_length(size)}")
        rings = len(self.pattern.positions)
        if self.curve.wire is not None and rings > 1:
            raise wrong_value("curve.wire", f"a wire runs along one curve, found pattern.rings of {rings}: remove one")
        if isinstance(tile, float) and tile > size:
            limit = f"a tile that is not larger than the body, {format_length(size)}"
            raise _too_large("pattern.tile_size", tile, limit)
        return self


def _too_large(key: str, found: float, expected: str) -> PydanticCustomError:
    return wrong_value(key, f'expected {expected}, found "{format_length(found)}"')
