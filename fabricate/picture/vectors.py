"""Arithmetic on rows of vectors in single precision, which is what rays are traced in."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats32: TypeAlias = NDArray[np.float32]


def unit(vectors: NDArray[Any]) -> Floats32:
    """(n, 3) float: the vectors at length 1; zero vectors stay zero."""
    lengths = np.sqrt(np.einsum("nx,nx->n", vectors, vectors))[:, None]
    scaled: Floats32 = (vectors / np.where(lengths > 0, lengths, 1)).astype(np.float32)
    return scaled


def dots(left: Floats32, right: Floats32) -> Floats32:
    """(n,) float: scalar products of rows."""
    products: Floats32 = np.einsum("nx,nx->n", left, right)
    return products


def smooth_step(values: Floats32) -> Floats32:
    """(n,) float: from 0 at values below 0 to 1 at values above 1, without slope at either end."""
    t = np.clip(values, 0, 1)
    risen: Floats32 = t * t * (3 - 2 * t)
    return risen
