"""Scenes: nodes multiply from the top down, each mesh is where its nodes put it, and only trees are followed."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from fabricate.errors import ReadError
from fabricate.formats.read_glb_document import Document
from fabricate.formats.read_glb_scene import placed_meshes

POINT = np.array([0.3, -0.7, 1.9])


def document(nodes: list[dict[str, Any]], **more: Any) -> Document:
    meshes = 3 * [{"primitives": []}]
    return Document.model_validate({"asset": {"version": "2.0"}, "nodes": nodes, "meshes": meshes, **more})


def meshes(found: Document) -> list[int]:
    return [placed.mesh for placed in placed_meshes(found)]


def place(found: Document) -> np.ndarray:
    [placed] = placed_meshes(found)
    return np.asarray((np.append(POINT, 1) @ placed.transform)[:3])


@given(st.integers(0, 2**32 - 1))
def test_parts_of_a_node_are_applied_in_order_and_like_its_matrix(seed: int) -> None:
    rng = np.random.default_rng(seed)
    turn, shift, scale = Rotation.random(rng=rng), rng.normal(size=3), rng.uniform(0.5, 2, size=3)
    wanted = turn.apply(scale * POINT) + shift
    parts = {"translation": shift.tolist(), "rotation": turn.as_quat().tolist(), "scale": scale.tolist()}
    np.testing.assert_allclose(place(document([{"mesh": 0, **parts}])), wanted, atol=1e-12)
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = turn.as_matrix() * scale, shift
    columns = matrix.T.ravel().tolist()
    np.testing.assert_allclose(place(document([{"mesh": 0, "matrix": columns}])), wanted, atol=1e-12)


def test_nodes_multiply_from_the_top_down() -> None:
    quarter = [0, 0, float(np.sqrt(0.5)), float(np.sqrt(0.5))]
    nodes = [{"children": [1], "rotation": quarter}, {"mesh": 0, "translation": [1, 0, 0]}]
    np.testing.assert_allclose(place(document(nodes)), [-POINT[1], POINT[0] + 1, POINT[2]], atol=1e-12)


@pytest.mark.parametrize("rotation", [[0, 0, 0, 0], [1e-300, 0, 0, 0]])
def test_rotations_that_are_none_or_tiny_give_numbers(rotation: list[float]) -> None:
    assert np.isfinite(place(document([{"mesh": 0, "rotation": rotation}]))).all()


def test_only_the_scene_that_is_shown_counts() -> None:
    nodes = [{"mesh": 0}, {"mesh": 1}, {"mesh": 2}]
    scenes = [{"nodes": [0]}, {"nodes": [2, 1]}]
    assert meshes(document(nodes, scenes=scenes, scene=1)) == [2, 1]
    assert meshes(document(nodes, scenes=scenes)) == [0]
    assert meshes(document(nodes)) == [0, 1, 2]
    assert meshes(document([])) == [0, 1, 2]


def test_the_same_mesh_may_be_in_several_places_in_order() -> None:
    assert meshes(document([{"mesh": 1, "children": [1, 2]}, {"mesh": 0}, {"mesh": 1}, {"mesh": 2}])) == [1, 0, 1, 2]


def test_skinned_meshes_stand_as_they_were_modelled() -> None:
    np.testing.assert_array_equal(place(document([{"mesh": 0, "skin": 0, "scale": [9, 9, 9]}])), POINT)


def test_a_deep_chain_is_followed_to_its_end() -> None:
    chain: list[dict[str, Any]] = [{"children": [k + 1], "translation": [1, 0, 0]} for k in range(20_000)]
    np.testing.assert_allclose(place(document([*chain, {"mesh": 0}])), POINT + np.array([20_000, 0, 0]))


@pytest.mark.parametrize(
    ("found", "words"),
    [
        (document([{"children": [1]}, {"children": [0]}], scenes=[{"nodes": [0]}]), "node 0 .* below itself"),
        (document([{"children": [0]}], scenes=[{"nodes": [0]}]), "node 0 .* below itself"),
        (document([{"children": [2]}, {"children": [2]}, {"mesh": 0}]), "node 2 .* in several"),
        (document([{"mesh": 0}], scenes=[{"nodes": [0, 0]}]), "node 0 .* in several"),
        (document([{"children": [5]}]), "refers to node 5, but its 1 are numbered"),
        (document([{"mesh": 0}], scenes=[{"nodes": [1]}]), "refers to node 1"),
        (document([{"mesh": 0}], scenes=[{}], scene=1), "refers to scene 1"),
        (document([{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {}}}]), "EXT_mesh_gpu_instancing"),
    ],
)
def test_scenes_that_are_no_trees_are_refused(found: Document, words: str) -> None:
    with pytest.raises(ReadError, match=words):
        placed_meshes(found)


@pytest.mark.filterwarnings("error")
def test_overflow_is_left_to_whoever_checks_numbers() -> None:
    nodes = [{"scale": [1e300, 1e300, 1e300], "children": [1]}, {"mesh": 0, "scale": [1e300, 1, 1]}]
    assert not np.isfinite(placed_meshes(document(nodes))[0].transform).all()
