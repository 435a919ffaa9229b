"""Conjugate gradients, written out, as sums of library kernels depend on the number of their threads."""

from __future__ import annotations

from collections.abc import Callable

from scipy.sparse import csr_array

from fabricate.arrays import Floats

SOLVED, MOST_ROUNDS = 1e-8, 1000
"""Residual to which is solved, as a share of the first squared one, and rounds at most."""


def solved(operator: csr_array, right: Floats, start: Floats, *, free: Callable[[Floats], Floats]) -> Floats:
    """Return the field, (n, k), for which `operator` times it is `right`, as far as it is free to change.

    Parameters
    ----------
    operator : (n, n) sparse
        Symmetric and positive definite.
    right, start : (n, k) float
        The right sides, and the field to begin with.
    free : callable
        Projects a change, (n, k), to those that are allowed.
    """
    inverse = 1.0 / operator.diagonal()[:, None]
    field = start
    residual = free(right - operator @ field)
    step = inverse * residual
    size = first = float((residual * step).sum())
    for _ in range(MOST_ROUNDS):
        if size <= SOLVED * first:
            break
        change = free(operator @ step)
        share = size / float((step * change).sum())
        field, residual = field + share * step, residual - share * change
        scaled = inverse * residual
        before, size = size, float((residual * scaled).sum())
        step = scaled + (size / before) * step
    return field
