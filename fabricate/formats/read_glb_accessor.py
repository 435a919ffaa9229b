"""The numbers that an accessor of a GLB file stands for."""

from __future__ import annotations

from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fabricate.arrays import Floats, Indices
from fabricate.errors import ReadError
from fabricate.formats.read_glb_document import Accessor, BufferView, Glb, entry

_KINDS = MappingProxyType({5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"})
_WIDTHS = MappingProxyType({"SCALAR": 1, "VEC3": 3})


def read_points(glb: Glb, index: int) -> Floats:
    """Return the (n, 3) points of an accessor; integers that stand for fractions are divided.

    Raises
    ------
    ReadError
        If it has no such numbers, or they are not within the file.
    """
    accessor = entry(glb.document.accessors, index, "accessor")
    numbers = _numbers(glb, accessor, index, "VEC3")
    with np.errstate(invalid="ignore"):  # signalling NaNs are judged later, like all others
        points: Floats = numbers.astype(np.float64)
    if not accessor.normalized or numbers.dtype.kind == "f":
        return points
    return np.maximum(points / np.iinfo(numbers.dtype).max, -1)


def read_indices(glb: Glb, index: int, *, points: int) -> Indices:
    """Return the (n,) point indices of an accessor.

    Raises
    ------
    ReadError
        If it has no such numbers, they are not within the file, or one is not below `points`.
    """
    accessor = entry(glb.document.accessors, index, "accessor")
    numbers = _numbers(glb, accessor, index, "SCALAR")[:, 0]
    if numbers.dtype.kind != "u":
        raise ReadError(f"accessor {index} was expected to have unsigned point indices, found others")
    if len(numbers) and numbers.max() >= points:
        raise ReadError(
            f"accessor {index} refers to point {numbers.max()}, but the {points} points are numbered from 0"
        )
    return numbers.astype(np.int64)


def _numbers(glb: Glb, accessor: Accessor, index: int, shape: str) -> NDArray[Any]:
    """Return the numbers as they are in the file, one row for each element."""
    if accessor.type != shape or accessor.component_type not in _KINDS:
        raise ReadError(
            f"accessor {index} was expected to hold {shape} numbers, found {accessor.type[:20]!r} of type "
            f"{accessor.component_type}"
        )
    if accessor.sparse is not None:
        raise ReadError(f"accessor {index} is sparse, which cannot be read; save the file without sparse accessors")
    if accessor.buffer_view is None:
        raise ReadError(f"accessor {index} has no data; save the file without compression")
    view = entry(glb.document.buffer_views, accessor.buffer_view, "buffer view")
    if view.buffer != 0 or entry(glb.document.buffers, 0, "buffer").uri is not None:
        raise ReadError(f"accessor {index} has its data in another file; save the scene as one GLB file")
    kind, width = np.dtype(_KINDS[accessor.component_type]), _WIDTHS[shape]
    if not accessor.count:
        return np.zeros((0, width), dtype=kind)
    stride = view.byte_stride or width * kind.itemsize
    _check_bounds(glb, accessor, view, index, element=width * kind.itemsize, stride=stride)
    return np.ndarray(
        (accessor.count, width), kind, glb.binary, view.byte_offset + accessor.byte_offset, (stride, kind.itemsize)
    )


def _check_bounds(glb: Glb, accessor: Accessor, view: BufferView, index: int, *, element: int, stride: int) -> None:
    end = accessor.byte_offset + stride * (accessor.count - 1) + element
    if stride < element or end > view.byte_length:
        raise ReadError(
            f"accessor {index} declares {accessor.count} elements of {element} bytes, {stride} bytes apart, which do "
            f"not fit the {view.byte_length} bytes of its buffer view"
        )
    if view.byte_offset + view.byte_length > len(glb.binary):
        raise ReadError(
            f"buffer view {accessor.buffer_view} ends at byte {view.byte_offset + view.byte_length}, but the file has "
            f"{len(glb.binary)} bytes of data; it is cut off"
        )
