from __future__ import annotations

from breaking import box, inside_out
from polyhedra import HANDLES, octahedron

from fabricate.prepare.nesting import containers


def test_shells_in_shells_lie_in_all_larger_ones() -> None:
    shells = [box(3.0), inside_out(box(1.0)), box(9.0), box(1.0, at=(20.0, 0.0, 0.0))]
    assert [found.tolist() for found in containers(shells)] == [[2], [0, 2], [], []]


def test_what_lies_in_the_hole_of_a_torus_is_not_inside() -> None:
    torus, _ = HANDLES["torus"]
    ball = octahedron().scaled(0.01)
    assert [found.tolist() for found in containers([torus, ball])] == [[], []]
    in_tube = ball.moved(ball.points + torus.points[torus.corners].mean(axis=0) + [1.0, 0.0, 0.0])
    assert [found.tolist() for found in containers([torus, in_tube])] == [[], [0]]


def test_one_component_lies_in_none() -> None:
    assert [found.tolist() for found in containers([box()])] == [[]]
    assert containers([]) == ()
