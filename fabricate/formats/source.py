"""From the source that a config asks for to its mesh."""

from __future__ import annotations

from pathlib import Path
from types import MappingProxyType

from fabricate.config.source_config import (
    CubeConfig,
    FileConfig,
    FrameConfig,
    KnotConfig,
    SourceConfig,
    SphereConfig,
    TorusConfig,
)
from fabricate.errors import MeshError
from fabricate.formats.limits import DEFAULT_LIMITS, ReadLimits
from fabricate.formats.reading import read_mesh
from fabricate.mesh.closed import checked_closed
from fabricate.mesh.cube import cube
from fabricate.mesh.knot import trefoil
from fabricate.mesh.pierced import double_torus, genus_six, triple_torus
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import sphere
from fabricate.mesh.torus import torus

_FRAMES = MappingProxyType({"double-torus": double_torus, "triple-torus": triple_torus, "genus-6": genus_six})


def source_mesh(source: SourceConfig, *, limits: ReadLimits = DEFAULT_LIMITS) -> PolygonMesh:
    """Return the polygon mesh of a built-in shape or a file, in its own unit and not yet sized.

    A sphere is the polyhedron alone, whose limit surface is not round yet. A file's mesh comes as it was read.

    Raises
    ------
    ReadError
        If the file is missing, damaged or no mesh; the message begins with its path.
    MeshError
        If a shape cannot be made with these keys.
    """
    if isinstance(source, FileConfig):
        return read_mesh(source.file, limits=limits)
    return checked_closed(_shape(source))


def read_closed(path: Path) -> PolygonMesh:
    """Read an OBJ, OFF, PLY, STL, 3MF or GLB file, polygons kept, that holds one closed, orientable 2-manifold.

    Raises
    ------
    ReadError
        If the file is missing, damaged or no mesh.
    MeshError
        If it is not closed, not a manifold or not in one piece; the message says where.
    """
    mesh = read_mesh(path)
    try:
        return checked_closed(mesh)
    except MeshError as error:
        raise MeshError(f"{path}: {error}") from None


def _shape(source: SphereConfig | CubeConfig | TorusConfig | FrameConfig | KnotConfig) -> PolygonMesh:
    match source:
        case SphereConfig():
            return sphere(faces=source.faces, frequency=source.frequency)
        case CubeConfig():
            return cube(divisions=source.divisions)
        case TorusConfig():
            return torus(around=source.around, across=source.across, tube=source.tube)
        case FrameConfig():
            return _FRAMES[source.shape](hole=source.hole, depth=source.depth)
        case KnotConfig():
            return trefoil(around=source.around, across=source.across, tube=source.tube)
