"""The section [prepare]: from a mesh as it was read to cells that carry the tiles."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from fabricate.config.angle import Angle
from fabricate.config.section import Section


class PrepareConfig(Section):
    """Repair, components, cells and sharp edges of the mesh."""

    repair: Literal["none", "gentle", "wrap"] = "gentle"
    """What is mended: nothing; connections and winding, no point moves; or a new skin around what is still broken."""
    components: Literal["only", "largest", "each"] = "only"
    """Bodies that are made: the mesh has to be a single one, the largest, or each as a pair of its own."""
    cells: Literal["auto", "as-is", "quads", "triangles", "hexagons"] = "auto"
    """Faces that carry the tiles: the mesh's own, or new ones; auto: its own unless they are finer than the tiles."""
    detail: Literal["input", "smooth"] = "input"
    """Surface of remeshed bodies: the input's, or the smooth one of the new cells."""
    crease: Annotated[Angle, Field(ge=0, le=180)] | None = Field(default=None, examples=["40 deg"])
    """Edges whose faces meet at a sharper angle than this stay sharp; none do unless it is given."""
    seed: Annotated[int, Field(ge=0)] = 0
    """Another seed gives other cells when the mesh is remeshed."""
    max_file_mb: Annotated[int, Field(ge=1, le=65_536)] = 1024
    """Larger mesh files are refused before they are read."""
    max_faces: Annotated[int, Field(ge=1, le=100_000_000)] = 5_000_000
    """Meshes with more faces are refused before memory is taken."""
