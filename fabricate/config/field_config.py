"""The section [field]: values or directions on the surface that a tree follows."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Annotated, Literal, TypeAlias

from pydantic import Discriminator, Field, PrivateAttr, Tag

from fabricate.config.point import Direction, Point
from fabricate.config.section import ConfigFolder, Section

Jitter: TypeAlias = Annotated[
    float, Field(ge=0, le=1, description="Chance that is mixed in, as a share of the whole range of the field.")
]
Reverse: TypeAlias = Annotated[
    bool, Field(description="Whether corridors gather where the field is high, and not where it is low.")
]


class HeightConfig(Section):
    """Height along an axis."""

    kind: Literal["height"]
    """Height along an axis."""
    axis: Direction = (0.0, 0.0, 1.0)
    """Which way is up."""
    reverse: Reverse = False
    jitter: Jitter = 0.0


class DistanceConfig(Section):
    """Distance to a point or an axis."""

    kind: Literal["distance"]
    """Distance to a point, or to an axis if one is given."""
    point: Point | None = Field(default=None, examples=[["0 mm", "0 mm", "50 mm"]])
    """The point, or a point of the axis; the middle of the body unless given."""
    axis: Direction | None = Field(default=None, examples=[[0, 0, 1]])
    """Direction of the axis."""
    reverse: Reverse = False
    jitter: Jitter = 0.0


class CurvatureConfig(Section):
    """How sharply the surface curves."""

    kind: Literal["curvature"]
    """Magnitude of the larger principal curvature."""
    reverse: Reverse = False
    jitter: Jitter = 0.0


class DirectionConfig(Section):
    """Directions on the surface, which corridors follow or cross."""

    kind: Literal["direction"]
    """A direction at every place."""
    lines: Literal["vector", "circles", "most-curved", "least-curved"] = "vector"
    """Where the directions lie: along axis, on circles round it, or in those of the principal curvatures."""
    axis: Direction = (0.0, 0.0, 1.0)
    """The vector, or the axis of the circles."""
    point: Point | None = Field(default=None, examples=[["0 mm", "0 mm", "0 mm"]])
    """A point of the axis of the circles; the middle of the body unless given."""
    corridors: Literal["along", "across"] = "along"
    """How corridors run."""
    jitter: Jitter = 0.0


class ImageConfig(Section):
    """Brightness of a picture that is projected on the body."""

    kind: Literal["image"]
    """Brightness of a picture, projected through the body."""
    image: Annotated[str, Field(pattern=r"^[^\x00]+$", examples=["pictures/face.png"])]
    """Picture, found from the folder of this config; corridors gather in what is dark."""
    axis: Direction = (0.0, -1.0, 0.0)
    """Where the picture is seen from; z is up in it, or y if it is seen along z."""
    reverse: Reverse = False
    jitter: Jitter = 0.0
    _folder: Path = PrivateAttr(default=Path())

    def model_post_init(self, context: object, /) -> None:
        """Remember the folder that `image` is found from."""
        if isinstance(context, ConfigFolder):
            self._folder = context.path

    @property
    def file(self) -> Path:
        """The picture, as found from the working directory."""
        return self._folder / self.image


class AttributeConfig(Section):
    """Values that come with the points of a PLY mesh."""

    kind: Literal["attribute"]
    """A number that the mesh file, a PLY, has for every point."""
    attribute: Annotated[str, Field(pattern=r"^\S+$", examples=["quality"])]
    """Name of the property."""
    reverse: Reverse = False
    jitter: Jitter = 0.0


FieldConfig: TypeAlias = (
    HeightConfig | DistanceConfig | CurvatureConfig | DirectionConfig | ImageConfig | AttributeConfig
)

FIELDS: Mapping[str, type[FieldConfig]] = MappingProxyType(
    {
        "height": HeightConfig,
        "distance": DistanceConfig,
        "curvature": CurvatureConfig,
        "direction": DirectionConfig,
        "image": ImageConfig,
        "attribute": AttributeConfig,
    }
)
"""Every kind of field and the model of its keys."""


def _kind(value: object) -> str | None:
    """Return which member of the union the section asks for; None for a section that asks for none."""
    if isinstance(value, Section):
        return type(value).__name__
    kind = value.get("kind") if isinstance(value, dict) else None
    return FIELDS[kind].__name__ if isinstance(kind, str) and kind in FIELDS else None


FieldSection: TypeAlias = Annotated[
    Annotated[HeightConfig, Tag("HeightConfig")]
    | Annotated[DistanceConfig, Tag("DistanceConfig")]
    | Annotated[CurvatureConfig, Tag("CurvatureConfig")]
    | Annotated[DirectionConfig, Tag("DirectionConfig")]
    | Annotated[ImageConfig, Tag("ImageConfig")]
    | Annotated[AttributeConfig, Tag("AttributeConfig")],
    Discriminator(_kind),
]
"""A `FieldConfig`, told apart by `kind`, so that mistakes are those of one member alone."""
