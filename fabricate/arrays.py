"""Array types used everywhere, and the one way to make an array that nobody can edit."""

from __future__ import annotations

from typing import Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats: TypeAlias = NDArray[np.float64]
Indices: TypeAlias = NDArray[np.int64]
Mask: TypeAlias = NDArray[np.bool_]
Words: TypeAlias = NDArray[np.uint64]

_Scalar = TypeVar("_Scalar", bound=np.generic)


def frozen(values: ArrayLike, dtype: type[_Scalar], shape: tuple[int | None, ...]) -> NDArray[_Scalar]:
    """Return a read-only, C-contiguous copy of `values` with the dtype and shape asked for.

    `None` in `shape` stands for any length. The caller's array stays writable and untouched; an array
    that is read-only already and fits is returned as it is.

    Raises
    ------
    ValueError
        If the shape differs; the message says what was expected and what was found.
    """
    array: NDArray[Any] = np.ascontiguousarray(values, dtype=dtype)
    if array.ndim != len(shape) or any(
        want is not None and want != have for want, have in zip(shape, array.shape, strict=True)
    ):
        wanted = ", ".join("n" if length is None else str(length) for length in shape)
        raise ValueError(f"expected an array of shape ({wanted}), found {array.shape}")
    if array.flags.writeable:
        array = array.copy()
        array.flags.writeable = False
    return array
