"""Where things go in a picture: one large cell, and a grid of cells beside it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Cell:
    """A rectangle of pixels.

    Attributes
    ----------
    left, top : int
        Its first column and row in the picture.
    width, height : int
        In pixels.
    """

    left: int
    top: int
    width: int
    height: int

    @property
    def rows(self) -> slice:
        """Its rows of the picture."""
        return slice(self.top, self.top + self.height)

    @property
    def columns(self) -> slice:
        """Its columns of the picture."""
        return slice(self.left, self.left + self.width)

    @property
    def middle(self) -> tuple[float, float]:
        """Its middle, in pixels from the picture's upper left corner."""
        return self.left + self.width / 2, self.top + self.height / 2

    def grown(self, share: float, *, within: Cell) -> Cell:
        """Return the cell with so much of its size added on each side, as far as `within` reaches."""
        x, y = round(share * self.width), round(share * self.height)
        left, top = max(self.left - x, within.left), max(self.top - y, within.top)
        right = min(self.left + self.width + x, within.left + within.width)
        bottom = min(self.top + self.height + y, within.top + within.height)
        return Cell(left, top, right - left, bottom - top)


@dataclass(frozen=True)
class Layout:
    """A picture of 1 + n cells: one of full height on the left, a grid of n beside it.

    Attributes
    ----------
    picture : Cell
        All of it.
    cells : tuple of Cell
        The large one, then the grid row by row.
    scale : float
        Pixels per unit of the subject: it fits each cell, margins included.
    """

    picture: Cell
    cells: tuple[Cell, ...]
    scale: float


def layout(count: int, *, width: int, height: int, subject: tuple[float, float], margin: float) -> Layout:
    """Return the layout of 1 + `count` cells that shows a subject of this width and height largest.

    The grid has one row for tall subjects, several for wide ones. The picture is `width` pixels wide
    and at most `height` high: what the subject and its margins (shares of the cell, on each side)
    don't need is left out.
    """
    inside = 1 - 2 * margin

    def scale(rows: int) -> float:
        return inside * min(width / _columns(count, rows) / subject[0], height / rows / subject[1])

    rows = max(range(1, count + 1), key=scale)
    columns = _columns(count, rows)
    height = min(height, round(rows * max(scale(rows) * subject[1] / inside, 1)))
    x = [round(width * k / columns) for k in range(columns + 1)]
    y = [round(height * k / rows) for k in range(rows + 1)]
    places = [(k // (columns - 1), k % (columns - 1) + 1) for k in range(count)]
    grid = [Cell(x[c], y[r], x[c + 1] - x[c], y[r + 1] - y[r]) for r, c in places]
    return Layout(Cell(0, 0, width, height), (Cell(0, 0, x[1], height), *grid), scale(rows))


def _columns(count: int, rows: int) -> int:
    """Columns of the whole picture when the grid has so many rows."""
    return 1 + -(-count // rows)
