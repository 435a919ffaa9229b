"""The XML of one model part in a 3MF package: its objects, and what it asks to be built of them."""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from fabricate.arrays import Floats, Indices, frozen
from fabricate.errors import ReadError
from fabricate.formats.limits import DEFAULT_LIMITS, ReadLimits
from fabricate.formats.read_3mf_xml import read_xml

_CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
_PRODUCTION = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06}"
_EXTENSIONS_WITHOUT_SHAPE = frozenset(
    {
        _PRODUCTION[:-1],
        "http://schemas.microsoft.com/3dmanufacturing/core/2015/02",
        "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
        "http://schemas.microsoft.com/3dmanufacturing/slice/2015/07",
        "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07",
    }
)
"""Extensions that a reader of triangles can do without, even where a file says that it needs them."""


MOST_OBJECTS = 100_000
"""Objects and places that they are put at; beyond that, describing them takes more memory than their triangles."""


@dataclass(frozen=True, eq=False)
class Placement:
    """An object of a model part and where it is placed; `part` is None within the same part."""

    part: str | None
    number: str
    transform: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "transform", frozen(self.transform, np.float64, (4, 4)))


@dataclass(frozen=True, eq=False)
class ModelObject:
    """One object: triangles, or other objects.

    Attributes
    ----------
    kind : str
        What it is for: `model`, `surface`, `support`, `solidsupport` or `other`.
    points : (n, 3) float
        Positions.
    triangles : (t, 3) int
        Points of each triangle, all within range.
    components : tuple of Placement
        The objects it is made of.
    """

    kind: str
    points: Floats
    triangles: Indices
    components: tuple[Placement, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", frozen(self.points, np.float64, (None, 3)))
        object.__setattr__(self, "triangles", frozen(self.triangles, np.int64, (None, 3)))


@dataclass(frozen=True, eq=False)
class ModelPart:
    """All objects of a model part by their number, and what is to be built; None without a `build` element."""

    objects: Mapping[str, ModelObject]
    items: tuple[Placement, ...] | None


def read_model(chunks: Iterable[bytes], *, limits: ReadLimits = DEFAULT_LIMITS) -> ModelPart:
    """Read a model part; the unit and everything that has no shape is passed over.

    Raises
    ------
    ReadError
        If it is no 3MF model, is damaged, too large, or needs an extension that changes the shape. The message
        gives the line.
    """
    reader = _ModelReader(limits)
    read_xml(chunks, reader)
    return ModelPart(MappingProxyType(reader.objects), None if reader.items is None else tuple(reader.items))


class _ModelReader:
    """Collects the objects and items of a model as its elements are read."""

    def __init__(self, limits: ReadLimits) -> None:
        self.objects: dict[str, ModelObject] = {}
        self.items: list[Placement] | None = None
        self._limits = limits
        self._namespaces: dict[str | None, str] = {}
        self._is_model = False
        self._count = 0
        self._object: dict[str, str] | None = None
        self._coordinates, self._indices = array("d"), array("q")
        self._components: list[Placement] = []
        self._takes = {
            f"{_CORE}vertex": self._take_vertex,
            f"{_CORE}triangle": self._take_triangle,
            f"{_CORE}model": self._take_model,
            f"{_CORE}object": self._take_object,
            f"{_CORE}component": self._take_component,
            f"{_CORE}build": self._take_build,
            f"{_CORE}item": self._take_item,
        }

    def declared(self, prefix: str | None, namespace: str) -> None:
        if not self._is_model:
            self._namespaces[prefix] = namespace

    def begun(self, name: str, attributes: dict[str, str]) -> None:
        take = self._takes.get(name)
        if not self._is_model and name != f"{_CORE}model":
            raise ReadError(f"an element 'model' of the 3MF core namespace was expected, found {name[-80:]!r}")
        if take is not None:
            take(attributes)

    def ended(self, name: str) -> None:
        if name == f"{_CORE}object" and self._object is not None:
            self.objects[self._object["id"]] = self._finished(self._object)
            self._object, self._components = None, []
            self._coordinates, self._indices = array("d"), array("q")

    def _take_model(self, attributes: dict[str, str]) -> None:
        self._is_model = True
        for prefix in attributes.get("requiredextensions", "").split():
            namespace = self._namespaces.get(prefix, prefix)
            if namespace not in _EXTENSIONS_WITHOUT_SHAPE:
                raise ReadError(f"the file needs the 3MF extension {namespace[:120]!r}, which cannot be read")

    def _take_object(self, attributes: dict[str, str]) -> None:
        number = attributes.get("id")
        if number is None or number in self.objects or self._object is not None:
            raise ReadError(f"an object with an 'id' of its own was expected, found {str(number)[:40]!r}")
        self._object = attributes
        self._count_one()

    def _take_vertex(self, attributes: dict[str, str]) -> None:
        try:
            place = float(attributes["x"]), float(attributes["y"]), float(attributes["z"])
        except (KeyError, ValueError):
            raise _unlike("a vertex with numbers x, y and z", attributes) from None
        self._coordinates.extend(place)
        if len(self._coordinates) > 3 * self._limits.max_points:
            self._limits.check_points(len(self._coordinates) // 3)

    def _take_triangle(self, attributes: dict[str, str]) -> None:
        try:
            self._indices.extend((int(attributes["v1"]), int(attributes["v2"]), int(attributes["v3"])))
        except (KeyError, ValueError, OverflowError):
            raise _unlike("a triangle with point numbers v1, v2 and v3", attributes) from None
        if len(self._indices) > 3 * self._limits.max_faces:
            self._limits.check_faces(len(self._indices) // 3)

    def _take_component(self, attributes: dict[str, str]) -> None:
        self._components.append(_placement(attributes))
        self._count_one()

    def _take_build(self, _: dict[str, str]) -> None:
        self.items = []

    def _take_item(self, attributes: dict[str, str]) -> None:
        if self.items is None:
            raise ReadError("an 'item' was found outside of 'build'")
        self.items.append(_placement(attributes))
        self._count_one()

    def _count_one(self) -> None:
        self._count += 1
        if self._count > MOST_OBJECTS:
            raise ReadError(f"at most {MOST_OBJECTS} objects, components and items are read, found more")

    def _finished(self, attributes: dict[str, str]) -> ModelObject:
        points = np.array(self._coordinates, dtype=np.float64).reshape(-1, 3)
        triangles = np.array(self._indices, dtype=np.int64).reshape(-1, 3)
        outside = (triangles < 0) | (triangles >= len(points))
        if outside.any():
            raise ReadError(
                f"the object {attributes['id'][:40]!r} has a triangle with point {triangles[outside][0]}, but its "
                f"{len(points)} points are numbered from 0"
            )
        return ModelObject(attributes.get("type", "model"), points, triangles, tuple(self._components))


def _placement(attributes: dict[str, str]) -> Placement:
    if "objectid" not in attributes:
        raise _unlike("an 'objectid'", attributes)
    part = attributes.get(f"{_PRODUCTION}path")
    return Placement(part, attributes["objectid"], _transform(attributes.get("transform")))


def _transform(text: str | None) -> Floats:
    matrix = np.eye(4)
    if text is None:
        return matrix
    try:
        matrix[:, :3] = np.array(list(map(float, text.split()))).reshape(4, 3)
    except ValueError:
        raise ReadError(f"a transform of 12 numbers was expected, found {text[:80]!r}") from None
    return matrix


def _unlike(wanted: str, attributes: dict[str, str]) -> ReadError:
    found = " ".join(f"{name}={value!r}" for name, value in attributes.items())
    return ReadError(f"{wanted} was expected, found {found[:120] or 'nothing'}")
