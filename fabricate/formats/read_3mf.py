"""Reading 3MF files: everything that is to be built, where it is to be built, as one mesh."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, TypeAlias

import numpy as np

from fabricate.arrays import Floats
from fabricate.errors import ReadError
from fabricate.formats.limits import DEFAULT_LIMITS, ReadLimits
from fabricate.formats.pieces import Piece, joined
from fabricate.formats.read_3mf_model import MOST_OBJECTS, ModelObject, ModelPart, Placement, read_model
from fabricate.formats.read_3mf_package import Package, part_name
from fabricate.mesh.polygon_mesh import PolygonMesh

_Key: TypeAlias = tuple[str, str]
"""The part that an object is in, and its number there."""

_SHAPES = frozenset({"model", "surface"})
"""Kinds of objects that belong to the shape; the others support it or help to edit it."""

_DEEPEST = 64
"""Components of components: editors make two or three levels."""


def read_3mf(content: bytes, *, limits: ReadLimits = DEFAULT_LIMITS) -> PolygonMesh:
    """Read the triangles of all items that a 3MF file asks to be built.

    Objects that are placed several times are there several times. Supports are left out. Points are not
    welded, as triangles share them by number. The unit of the file is passed over.

    Raises
    ------
    ReadError
        If the file is no whole 3MF package, asks for nothing to be built or for objects that it does not hold,
        needs an extension that changes the shape, or unpacks to more than the limits.
    """
    package = Package(content, limits=limits)
    root = package.model_name()
    parts = _parts(package, root, limits)
    items = parts[root].items
    if not items:
        found = "none" if items is None else "one without"
        raise ReadError(f"an element 'build' with items was expected in {root[:120]!r}, found {found}")
    objects = {(part, number): found for part, model in parts.items() for number, found in model.objects.items()}
    tops = [(_key(item, root), item.transform) for item in items]
    _check_extent(objects, [key for key, _ in tops], limits)
    pieces: list[Piece] = []
    for key, transform in tops:
        _collect(objects, key, transform, pieces)
    return joined(pieces)


def _parts(package: Package, root: str, limits: ReadLimits) -> dict[str, ModelPart]:
    """Return the model part that says what is built, and all others that it refers to."""
    parts: dict[str, ModelPart] = {}
    wanted, count = [root], 0
    while wanted:
        name = wanted.pop()
        if name in parts:
            continue
        parts[name] = model = read_model(package.chunks(name), limits=limits)
        components = [component for found in model.objects.values() for component in found.components]
        wanted += [_key(placed, name)[0] for placed in [*(model.items or ()), *components]]
        count += len(model.objects)
        _check_count(count)
    return parts


class _Extent(NamedTuple):
    """What an object expands to, with everything it is made of."""

    faces: int
    pieces: int
    depth: int


def _check_extent(objects: Mapping[_Key, ModelObject], tops: list[_Key], limits: ReadLimits) -> None:
    """Count before anything is expanded: a few objects that name each other twice are billions in the end."""
    known: dict[_Key, _Extent] = {}
    extents = [_extent(objects, key, (), known) for key in tops]
    limits.check_faces(sum(extent.faces for extent in extents))
    _check_count(sum(extent.pieces for extent in extents))


def _check_count(objects: int) -> None:
    if objects > MOST_OBJECTS:
        raise ReadError(f"at most {MOST_OBJECTS} objects are read, each as often as it is placed; found {objects}")


def _extent(
    objects: Mapping[_Key, ModelObject], key: _Key, above: tuple[_Key, ...], known: dict[_Key, _Extent]
) -> _Extent:
    if key in above:
        raise ReadError(f"the object {key[1][:40]!r} is a component of itself")
    if len(above) >= _DEEPEST:
        raise _too_deep()
    if key not in known:
        found = _found(objects, key)
        below = [_extent(objects, _key(placed, key[0]), (*above, key), known) for placed in found.components]
        faces = len(found.triangles) + sum(extent.faces for extent in below)
        pieces = 1 + sum(extent.pieces for extent in below)
        known[key] = _Extent(faces, pieces, 1 + max((extent.depth for extent in below), default=0))
    if len(above) + known[key].depth > _DEEPEST:
        raise _too_deep()
    return known[key]


def _too_deep() -> ReadError:
    return ReadError(f"components were expected to be nested at most {_DEEPEST} deep, found more")


def _found(objects: Mapping[_Key, ModelObject], key: _Key) -> ModelObject:
    found = objects.get(key)
    if found is None:
        raise ReadError(f"the object {key[1][:40]!r} is to be built, but is not in {key[0][:120]!r}")
    return found


def _collect(objects: Mapping[_Key, ModelObject], key: _Key, transform: Floats, pieces: list[Piece]) -> None:
    found = objects[key]
    if found.kind not in _SHAPES:
        return
    if len(found.triangles):
        pieces.append(Piece(found.points, found.triangles, transform))
    for placed in found.components:
        with np.errstate(over="ignore", invalid="ignore"):  # infinities are judged later, like all others
            below = placed.transform @ transform
        _collect(objects, _key(placed, key[0]), below, pieces)


def _key(placed: Placement, part: str) -> _Key:
    return (part if placed.part is None else part_name(placed.part), placed.number)
