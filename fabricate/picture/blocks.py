"""Long arrays worked through in blocks, on all cores."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

BLOCK = 1 << 14  # rows per task, so that a task's arrays stay in a core's cache

_Result = TypeVar("_Result")


def in_blocks(work: Callable[[slice], _Result], count: int) -> list[_Result]:
    """Call `work` for successive blocks of 0..count, at least once, and return its results in order.

    The blocks do not depend on the number of cores, so neither do the results. Threads are enough:
    Embree and numpy let go of the interpreter while they work.
    """
    blocks = [slice(start, min(start + BLOCK, count)) for start in range(0, max(count, 1), BLOCK)]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(work, blocks))
