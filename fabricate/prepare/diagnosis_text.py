"""A diagnosis in words, and as plain data for JSON."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np

from fabricate.mesh.naming import counted, place
from fabricate.prepare.diagnosis import Component, Diagnosis, Found, Loop

_SHOWN = 3
_KINDS = {3: "triangle", 4: "quad", 5: "pentagon", 6: "hexagon"}
_FACING = {1: "faces outward", 0: "encloses no volume", -1: "faces inward", None: "not closed"}


def diagnosis_data(diagnosis: Diagnosis) -> dict[str, Any]:
    """Return the diagnosis as dictionaries, lists or tuples, numbers and None only."""
    return asdict(diagnosis)


def diagnosis_text(diagnosis: Diagnosis) -> str:
    """Return lines for people: what the mesh is first, then one line per kind of fault that it has."""
    return "\n".join([*_what_it_is(diagnosis), *_faults(diagnosis)])


def _what_it_is(diagnosis: Diagnosis) -> list[str]:
    kinds = ", ".join(
        counted(kind.faces, _KINDS.get(kind.corners, f"polygon with {kind.corners} corners"), _plural(kind.corners))
        for kind in diagnosis.polygons
    )
    size = " x ".join(f"{length:.6g}" for length in diagnosis.size)
    lines = [
        f"{counted(diagnosis.vertices, 'vertex', 'vertices')}, {counted(diagnosis.faces, 'face')}: {kinds}",
        f"size {size}, diagonal {diagnosis.diagonal:.6g}",
        f"{counted(diagnosis.components, 'component')}",
        *[f"  {_component(component)}" for component in diagnosis.largest_components[:_SHOWN]],
    ]
    if diagnosis.components > _SHOWN:
        lines.append(f"  and {diagnosis.components - _SHOWN} more with no more faces each")
    if diagnosis.thinnest:
        thinnest = diagnosis.thinnest
        lines.append(f"thinnest place {thinnest.value:.6g} at {_at(thinnest.place)}")
    return lines


def _plural(corners: int) -> str:
    return "" if corners in _KINDS else f"polygons with {corners} corners"


def _component(component: Component) -> str:
    genus = "no genus" if component.genus is None else f"genus {component.genus}"
    return f"{counted(component.faces, 'face')}, {genus}, {_FACING[component.volume_sign]}"


def _faults(diagnosis: Diagnosis) -> list[str]:
    lines = [_loops(diagnosis)] if diagnosis.boundary_loops else []
    if diagnosis.non_orientable:
        lines.append("non-orientable: a part has one side only, like a Moebius strip")
    if diagnosis.unreferenced_points:
        lines.append(f"{counted(diagnosis.unreferenced_points, 'point')} without a face")
    for found, noun, plural in (
        (diagnosis.nonmanifold_edges, "non-manifold edge", ""),
        (diagnosis.nonmanifold_vertices, "non-manifold vertex", "non-manifold vertices"),
        (diagnosis.inconsistent_edges, "edge wound inconsistently", "edges wound inconsistently"),
        (diagnosis.degenerate_faces, "degenerate face", ""),
        (diagnosis.duplicate_faces, "duplicate face", ""),
        (diagnosis.coinciding_points, "point on the very spot of another", "points on the very spot of another"),
        (diagnosis.crossings, "pair of triangles that cross", "pairs of triangles that cross"),
    ):
        if found.count:
            least = "" if found is not diagnosis.crossings or diagnosis.crossings_complete else "at least "
            lines.append(f"{least}{counted(found.count, noun, plural)}, {_examples(found)}")
    return lines or ["no faults: closed, manifold, wound consistently, without crossings"]


def _loops(diagnosis: Diagnosis) -> str:
    shown = ", ".join(_loop(loop) for loop in diagnosis.longest_loops[:_SHOWN])
    more = ", ..." if diagnosis.boundary_loops > _SHOWN else ""
    return f"{counted(diagnosis.boundary_loops, 'boundary loop')}: {shown}{more}"


def _loop(loop: Loop) -> str:
    return f"{counted(loop.edges, 'edge')} of length {loop.length:.6g} at {_at(loop.place)}"


def _examples(found: Found) -> str:
    shown = ", ".join(_at(where) for where in found.places[:_SHOWN])
    return f"at {shown}{', ...' if found.count > _SHOWN else ''}"


def _at(where: tuple[float, float, float]) -> str:
    return place(np.array(where))
