"""Reading PLY files: text and binary, any property types, any elements beside points and faces."""

from __future__ import annotations

from collections.abc import Set
from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.errors import ReadError
from fabricate.formats.limits import DEFAULT_LIMITS, ReadLimits
from fabricate.formats.number_rows import whole
from fabricate.formats.ply_body import PlyBody, PlyColumn, ply_body, ply_columns
from fabricate.formats.ply_header import PlyElement, PlyHeader, read_ply_header
from fabricate.formats.point_values import PointValues
from fabricate.formats.strips import strip_triangles
from fabricate.mesh.polygon_mesh import PolygonMesh

_INDEX_LISTS = ("vertex_indices", "vertex_index")
_READ = frozenset({"x", "y", "z", *_INDEX_LISTS})
_STRIPS = "tristrips"


def read_ply(content: bytes, *, limits: ReadLimits = DEFAULT_LIMITS) -> PolygonMesh:
    """Read the points, faces and triangle strips of a PLY file; all other elements and properties are passed over.

    Raises
    ------
    ReadError
        If the header cannot be understood, the data do not have the size and form that it declares, or there
        are too many of them.
    """
    header = read_ply_header(content)
    body = ply_body(content, header, limits=limits)
    return _mesh(body, header, _read_tables(body, header, _READ), limits)


def read_ply_attribute(content: bytes, name: str, *, limits: ReadLimits = DEFAULT_LIMITS) -> PointValues:
    """Read the points and faces of a PLY file, and one number for every point.

    Raises
    ------
    ReadError
        As `read_ply`, or if its points have no number of that name; names those that they have.
    """
    header = read_ply_header(content)
    body = ply_body(content, header, limits=limits)
    tables = _read_tables(body, header, _READ | {name})
    mesh = _mesh(body, header, tables, limits)
    numbers = _numbers(tables["vertex"])
    if name not in numbers:
        raise ReadError(
            f"an attribute '{name}' of the points was expected, found "
            + (", ".join(numbers) or "none beside their coordinates")
        )
    return PointValues(mesh, _scalars(body, tables["vertex"], name))


def read_ply_numbers(content: bytes, *, prefix: str, limits: ReadLimits = DEFAULT_LIMITS) -> Floats:
    """Read, for each of the n points of a PLY file, its k numbers whose names begin with a prefix: (n, k), as ordered.

    Raises
    ------
    ReadError
        If the header cannot be understood, or the data do not have the size and form that it declares.
    """
    header = read_ply_header(content)
    body = ply_body(content, header, limits=limits)
    declared = [each for element in header.elements if element.name == "vertex" for each in element.properties]
    names = [each.name for each in declared if each.name.startswith(prefix) and each.length_kind is None]
    table = _read_tables(body, header, frozenset(names)).get("vertex")
    return (
        np.zeros((0, 0))
        if table is None or not names
        else np.stack([_scalars(body, table, name) for name in names], axis=1)
    )


def _mesh(body: PlyBody, header: PlyHeader, tables: dict[str, _Table], limits: ReadLimits) -> PolygonMesh:
    if not {"vertex", "face"} <= tables.keys() and not {"vertex", _STRIPS} <= tables.keys():
        raise ReadError(f"elements 'vertex' and 'face' were expected, found only {header.summary}")
    coordinates = [_scalars(body, tables["vertex"], axis) for axis in ("x", "y", "z")]
    corners, sizes = _faces(body, tables)
    limits.check_faces(len(sizes))
    return PolygonMesh(np.column_stack(coordinates), corners, np.concatenate([[0], np.cumsum(sizes)]))


@dataclass(frozen=True, eq=False)
class _Table:
    """All rows of one element."""

    element: PlyElement
    columns: tuple[PlyColumn, ...]


def _read_tables(body: PlyBody, header: PlyHeader, wanted: Set[str]) -> dict[str, _Table]:
    """Return the first element of each name that has rows, with the columns of wanted properties."""
    tables: dict[str, _Table] = {}
    at = body.begin
    for element in header.elements:
        if not element.properties:
            continue
        bounds = body.bounds(element, at)
        columns, ends = ply_columns(body, element, bounds[:-1], wanted)
        wrong = np.flatnonzero(ends != bounds[1:])
        if len(wrong):
            place, row = int(bounds[wrong[0]]), wrong[0]
            raise ReadError(
                f"{body.where(place)}: the header declares rows of '{element.name}' that would have "
                f"{ends[row] - bounds[row]} numbers here, found {bounds[row + 1] - bounds[row]}"
            )
        if element.count:
            tables.setdefault(element.name, _Table(element, tuple(columns)))
        at = int(bounds[-1])
    left = body.left_over(at)
    if left:
        raise ReadError(f"{left} follow after all rows that the header declares; its counts are wrong")
    return tables


def _faces(body: PlyBody, tables: dict[str, _Table]) -> tuple[Indices, Indices]:
    """Return the corners of all polygons and then of all triangles in strips, and how many each face has."""
    none = np.zeros(0, dtype=np.int64)
    corners, sizes = _lists(body, tables["face"]) if "face" in tables else (none, none)
    if _STRIPS not in tables:
        return corners, sizes
    strips, lengths = _lists(body, tables[_STRIPS])
    triangles = strip_triangles(np.insert(strips, np.cumsum(lengths)[:-1], -1))
    return np.append(corners, triangles), np.append(sizes, np.full(len(triangles), 3))


def _scalars(body: PlyBody, table: _Table, name: str) -> Floats:
    for column in table.columns:
        if column.declared.name == name and column.declared.length_kind is None:
            return body.read(column.firsts, column.declared.kind)
    raise ReadError(f"a property '{name}' of element '{table.element.name}' was expected, {_found(table)}")


def _numbers(table: _Table) -> list[str]:
    """Return the names of properties that are one number, but for the coordinates."""
    declared = table.element.properties
    return [each.name for each in declared if each.length_kind is None and each.name not in {"x", "y", "z"}]


def _lists(body: PlyBody, table: _Table) -> tuple[Indices, Indices]:
    """Return the point indices in all lists of an element, and the lists' lengths."""
    for column in table.columns:
        if column.declared.name in _INDEX_LISTS and column.declared.length_kind is not None:
            return _list_items(body, column), column.lengths
    raise ReadError(f"a list property '{_INDEX_LISTS[0]}' of '{table.element.name}' was expected, {_found(table)}")


def _list_items(body: PlyBody, column: PlyColumn) -> Indices:
    size = body.size(column.declared.kind)
    begins = np.cumsum(column.lengths) - column.lengths
    places = np.repeat(column.firsts - size * begins, column.lengths) + size * np.arange(column.lengths.sum())
    items = body.read(places, column.declared.kind)
    if not whole(items).all():
        wrong = np.argmin(whole(items))
        raise ReadError(f"{body.where(int(places[wrong]))}: a point index was expected, found {items[wrong]:g}")
    return items.astype(np.int64)


def _found(table: _Table) -> str:
    return "found " + ", ".join(declared.name for declared in table.element.properties)
