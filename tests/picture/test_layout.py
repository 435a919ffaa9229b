"""The layout: cells fill the picture, subjects fit, and the grid follows the subject's shape."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.picture.layout import Cell, layout


@given(st.integers(1, 7), st.floats(0.1, 10))
def test_cells_do_not_overlap_and_the_subject_fits_each(count: int, aspect: float) -> None:
    plan = layout(count, width=1600, height=800, subject=(aspect, 1.0), margin=0.1)
    taken = np.zeros((plan.picture.height, plan.picture.width), dtype=int)
    for cell in plan.cells:
        taken[cell.rows, cell.columns] += 1
        assert plan.scale * aspect <= 0.8 * cell.width + 1
        assert plan.scale <= 0.8 * cell.height + 1
    assert taken.max() == 1
    assert len(plan.cells) == count + 1
    assert plan.picture.width == 1600
    assert plan.picture.height <= 800


def test_tall_subjects_stand_in_a_row_wide_ones_above_each_other() -> None:
    tall = layout(2, width=1600, height=800, subject=(1, 2), margin=0.1)
    wide = layout(2, width=1600, height=800, subject=(2, 1), margin=0.1)
    assert tall.cells[1].top == tall.cells[2].top
    assert wide.cells[1].left == wide.cells[2].left
    assert wide.cells[1].top < wide.cells[2].top


def test_no_other_number_of_rows_shows_a_cube_larger() -> None:
    plan = layout(3, width=1600, height=800, subject=(1, 1), margin=0.1)
    # One row of four: 1600 / 4 = 400; two rows: three columns, 800 / 2 = 400; three rows: 800 / 3.
    assert plan.scale == pytest.approx(0.8 * 400)


def test_height_that_nobody_needs_is_left_out() -> None:
    plan = layout(2, width=1500, height=800, subject=(1, 1), margin=0.1)
    assert plan.picture.height == 500


def test_a_cell_grows_on_all_sides_up_to_the_picture() -> None:
    picture = Cell(0, 0, 100, 50)
    assert Cell(40, 20, 20, 10).grown(0.5, within=picture) == Cell(30, 15, 40, 20)
    assert Cell(40, 20, 20, 10).grown(9, within=picture) == picture


def test_the_middle_of_a_cell_is_in_its_middle() -> None:
    assert Cell(10, 20, 5, 4).middle == (12.5, 22.0)
