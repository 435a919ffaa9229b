"""Reading PLY files: text and binary, any property types, any elements beside points and faces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.errors import ReadError
from fabricate.mesh.number_rows import whole
from fabricate.mesh.ply_body import PlyBody, PlyColumn, ply_body, ply_columns
from fabricate.mesh.ply_header import PlyElement, PlyHeader, read_ply_header
from fabricate.mesh.polygon_mesh import PolygonMesh


def read_ply(content: bytes) -> PolygonMesh:
    """Read the points and faces of a PLY file; all other elements and properties are passed over.

    Raises
    ------
    ReadError
        If the header cannot be understood, or the data do not have the size and form that it declares.
    """
    header = read_ply_header(content)
    body = ply_body(content, header)
    tables = _read_tables(body, header)
    points, faces = _table(tables, "vertex", header), _table(tables, "face", header)
    coordinates = [_scalars(body, points, axis) for axis in ("x", "y", "z")]
    corners, sizes = _lists(body, faces, ("vertex_indices", "vertex_index"))
    return PolygonMesh(np.column_stack(coordinates), corners, np.concatenate([[0], np.cumsum(sizes)]))


@dataclass(frozen=True, eq=False)
class _Table:
    """All rows of one element."""

    element: PlyElement
    columns: tuple[PlyColumn, ...]


def _read_tables(body: PlyBody, header: PlyHeader) -> list[_Table]:
    tables, at = [], body.begin
    for element in header.elements:
        if not element.properties:
            continue
        bounds = body.bounds(element, at)
        columns, ends = ply_columns(body, element, bounds[:-1])
        wrong = np.flatnonzero(ends != bounds[1:])
        if len(wrong):
            place, row = int(bounds[wrong[0]]), wrong[0]
            raise ReadError(
                f"{body.where(place)}: the header declares rows of '{element.name}' that would have "
                f"{ends[row] - bounds[row]} numbers here, found {bounds[row + 1] - bounds[row]}"
            )
        tables.append(_Table(element, tuple(columns)))
        at = int(bounds[-1])
    left = body.left_over(at)
    if left:
        raise ReadError(f"{left} follow after all rows that the header declares; its counts are wrong")
    return tables


def _table(tables: list[_Table], name: str, header: PlyHeader) -> _Table:
    for table in tables:
        if table.element.name == name and table.element.count:
            return table
    raise ReadError(f"elements 'vertex' and 'face' were expected, found only {header.summary}")


def _scalars(body: PlyBody, table: _Table, name: str) -> Floats:
    for column in table.columns:
        if column.declared.name == name and column.declared.length_kind is None:
            return body.read(column.firsts, column.declared.kind)
    raise ReadError(f"a property '{name}' of element '{table.element.name}' was expected, {_found(table)}")


def _lists(body: PlyBody, table: _Table, names: tuple[str, ...]) -> tuple[Indices, Indices]:
    """Return the integers in all lists of the property that has one of the names, and the lists' lengths."""
    for column in table.columns:
        if column.declared.name in names and column.declared.length_kind is not None:
            return _list_items(body, column), column.lengths
    raise ReadError(f"a list property '{names[0]}' of '{table.element.name}' was expected, {_found(table)}")


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
    return "found " + ", ".join(column.declared.name for column in table.columns)
