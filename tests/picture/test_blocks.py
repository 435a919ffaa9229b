"""Work in blocks: every row once, in order."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.picture.blocks import BLOCK, in_blocks


@pytest.mark.parametrize("count", [1, BLOCK - 1, BLOCK, BLOCK + 1, 5 * BLOCK + 7])
def test_blocks_cover_every_row_once_and_in_order(count: int) -> None:
    rows = np.arange(count)
    np.testing.assert_array_equal(np.concatenate(in_blocks(lambda block: rows[block], count)), rows)


def test_no_rows_give_one_empty_result() -> None:
    assert [len(piece) for piece in in_blocks(lambda block: np.zeros(0)[block], 0)] == [0]
