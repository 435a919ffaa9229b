"""Steps: harmless ones are taken whole, harmful ones as far as nothing goes wrong, and tangles come undone."""

from __future__ import annotations

import re

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from polyhedra import on_sphere, seeds

from fabricate.errors import SolidError
from fabricate.surface.embedding import OPEN, Embedding, stored
from fabricate.surface.stepping import stepped, untangled

BALL = trimesh.creation.icosphere(subdivisions=3)
POINTS, TRIANGLES = stored(np.array(BALL.vertices)), np.array(BALL.faces)
EMBEDDING = Embedding.of(TRIANGLES, count=len(POINTS))
ALL = np.ones(len(POINTS), dtype=bool)


def step_to(new: np.ndarray) -> np.ndarray:
    return np.asarray(stepped(POINTS, new, EMBEDDING.means, EMBEDDING.faults_since(POINTS)))


def is_embedded(points: np.ndarray) -> bool:
    return not EMBEDDING.crossed(points, ALL).any() and not (EMBEDDING.openness(points) < OPEN).any()


def test_a_harmless_step_is_taken_whole() -> None:
    new = POINTS * [1.5, 1.0, 0.7] + 0.1
    assert (step_to(new) == stored(new)).all()


@given(seed=seeds, strength=st.floats(0.05, 3.0))
@settings(max_examples=25)
def test_no_step_leads_to_a_crossing_or_a_fold(seed: int, strength: float) -> None:
    random = np.random.default_rng(seed)
    wild = random.random((len(POINTS), 1)) < 0.1
    new = POINTS + strength * wild * random.normal(size=POINTS.shape)
    found = step_to(new)
    assert is_embedded(found)
    assert (stored(found) == found).all()


def test_a_harmful_step_is_held_back_there_only() -> None:
    new = 1.2 * POINTS
    new[0] *= -2.0
    found = step_to(new)
    assert is_embedded(found)
    far = np.abs(POINTS @ POINTS[0]) < 0.3
    assert far.any()
    assert (found[far] == stored(new[far])).all()
    assert trimesh.Trimesh(found, TRIANGLES, process=False).volume > 4.0


def test_two_sheets_do_not_pass_through_each_other() -> None:
    """The upper half comes down below the lower one: it gets part of the way."""
    new = POINTS.copy()
    new[:, 2] = np.where(POINTS[:, 2] > 0, -POINTS[:, 2] - 0.1, POINTS[:, 2])
    found = step_to(new)
    assert is_embedded(found)
    assert trimesh.Trimesh(found, TRIANGLES, process=False).volume > 0


def test_what_cannot_be_made_right_is_not_done() -> None:
    found = step_to(np.zeros_like(POINTS))
    assert is_embedded(found)


@given(seed=seeds, count=st.integers(1, 4))
@settings(max_examples=20)
def test_a_tangle_comes_undone_and_the_rest_stays(seed: int, count: int) -> None:
    random = np.random.default_rng(seed)
    points = POINTS.copy()
    chosen = random.choice(len(points), count, replace=False)
    points[chosen] += 0.5 * on_sphere(random.normal(size=(count, 3)))
    found = untangled(points, EMBEDDING.means, EMBEDDING.crossed)
    assert not EMBEDDING.crossed(found, ALL).any()
    if not EMBEDDING.crossed(stored(points), ALL).any():
        assert (found == stored(points)).all()


def test_what_nothing_helps_is_named_with_its_place() -> None:
    collapsed = np.tile([[1.0, 2.0, 3.0]], (len(POINTS), 1))
    with pytest.raises(SolidError, match=re.escape("(1.00, 2.00, 3.00) mm")):
        untangled(collapsed, EMBEDDING.means, EMBEDDING.crossed)
