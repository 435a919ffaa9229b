"""The section [source]: what to divide, a built-in shape or a mesh file."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Annotated, Literal, Self, TypeAlias

from pydantic import Discriminator, Field, PrivateAttr, Tag, model_validator

from fabricate.config.length import Length
from fabricate.config.section import ConfigFolder, Section, wrong_value

Size: TypeAlias = Annotated[
    Length, Field(gt=0, le=10_000, description="Longest side of the sculpture; of each, where there are several.")
]


class SphereConfig(Section):
    """A polyhedron with all points at one distance from the centre."""

    shape: Literal["sphere"] = "sphere"
    """A sphere."""
    size: Size = 100.0
    faces: Literal["triangles", "pentagons", "hexagons", "octagons"] = "triangles"
    """Polygons it is made of; each kind gives another pattern."""
    frequency: Annotated[int, Field(ge=1, le=32)] = 2
    """How often each edge of the icosahedron is split; 1 unless faces are triangles."""

    @model_validator(mode="before")
    @classmethod
    def _other_faces_stay_whole(cls, data: object) -> object:
        if isinstance(data, dict) and data.get("faces", "triangles") != "triangles":
            return {"frequency": 1, **data}
        return data

    @model_validator(mode="after")
    def _only_triangles_are_split(self) -> Self:
        if self.faces != "triangles" and self.frequency != 1:
            raise wrong_value(
                "source.frequency", f'only faces = "triangles" can be split, found faces = "{self.faces}"'
            )
        return self


class CubeConfig(Section):
    """A cube of square quads."""

    shape: Literal["cube"] = "cube"
    """A cube."""
    size: Size = 100.0
    divisions: Annotated[int, Field(ge=1, le=64)] = 3
    """Quads along an edge of the cube."""


class TorusConfig(Section):
    """A ring of quads."""

    shape: Literal["torus"] = "torus"
    """A ring."""
    size: Size = 100.0
    around: Annotated[int, Field(ge=3, le=512)] = 16
    """Quads round the ring."""
    across: Annotated[int, Field(ge=3, le=256)] = 8
    """Quads round the tube."""
    tube: Annotated[float, Field(gt=0, lt=1)] = 0.45
    """Radius of the tube / radius of the ring; how thick it may be depends on across."""


class FrameConfig(Section):
    """A frame of quads with two, three or six handles."""

    shape: Literal["double-torus", "triple-torus", "genus-6"]
    """A frame with two, three or six handles."""
    size: Size = 100.0
    hole: Annotated[float, Field(ge=0.1, le=0.9)] = 0.55
    """Size of each opening as a fraction of the face it lies in."""
    depth: Annotated[float, Field(ge=0.1, le=2)] = 0.5
    """Thickness of the frame as a fraction of the cells it surrounds."""


class KnotConfig(Section):
    """A trefoil knot tied in a tube of quads."""

    shape: Literal["knot"] = "knot"
    """A trefoil knot."""
    size: Size = 100.0
    around: Annotated[int, Field(ge=24, le=2048)] = 60
    """Quads along the knot."""
    across: Annotated[int, Field(ge=3, le=64)] = 8
    """Quads round the tube."""
    tube: Annotated[float, Field(ge=0.05, le=0.76)] = 0.6
    """Radius of the tube / minor radius of the torus that the knot is wound on."""


class FileConfig(Section):
    """A closed mesh read from a file."""

    path: Annotated[str, Field(pattern=r"^[^\x00]+$", examples=["models/spot.obj"])]
    """Mesh file (OBJ, OFF, PLY, STL, 3MF, GLB), found from the folder of this config; instead of shape."""
    size: Size = 100.0
    _folder: Path = PrivateAttr(default=Path())

    def model_post_init(self, context: object, /) -> None:
        """Remember the folder that `path` is found from."""
        if isinstance(context, ConfigFolder):
            self._folder = context.path

    @property
    def file(self) -> Path:
        """The mesh file, as found from the working directory."""
        return self._folder / self.path


SourceConfig: TypeAlias = SphereConfig | CubeConfig | TorusConfig | FrameConfig | KnotConfig | FileConfig

SHAPES: Mapping[str, type[SourceConfig]] = MappingProxyType(
    {
        "sphere": SphereConfig,
        "cube": CubeConfig,
        "torus": TorusConfig,
        "double-torus": FrameConfig,
        "triple-torus": FrameConfig,
        "genus-6": FrameConfig,
        "knot": KnotConfig,
    }
)
"""Every built-in shape and the model of its keys."""


def _kind(value: object) -> str | None:
    """Return which member of the union the section asks for; None for a section that asks for none."""
    if isinstance(value, Section):
        return type(value).__name__
    if not isinstance(value, dict):
        return None
    if "path" in value:
        return FileConfig.__name__
    shape = value.get("shape")
    return SHAPES[shape].__name__ if isinstance(shape, str) and shape in SHAPES else None


Source: TypeAlias = Annotated[
    Annotated[SphereConfig, Tag("SphereConfig")]
    | Annotated[CubeConfig, Tag("CubeConfig")]
    | Annotated[TorusConfig, Tag("TorusConfig")]
    | Annotated[FrameConfig, Tag("FrameConfig")]
    | Annotated[KnotConfig, Tag("KnotConfig")]
    | Annotated[FileConfig, Tag("FileConfig")],
    Discriminator(_kind),
]
"""A `SourceConfig`, told apart by `shape` or `path`, so that mistakes are those of one member alone."""
