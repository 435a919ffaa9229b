"""3MF: what is to be built is there, where it is to be built and as often, and riddles without end are refused."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mesh_bytes import FACES, POINTS, mesh_3mf, model, package

from fabricate.errors import ReadError
from fabricate.formats.limits import ReadLimits
from fabricate.formats.read_3mf import read_3mf
from fabricate.mesh.closed import signed_volume
from fabricate.mesh.polygon_mesh import PolygonMesh

MESH = mesh_3mf(POINTS, FACES)
BODY = f'<object id="1">{MESH}</object>'
PRODUCTION = 'xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06" requiredextensions="p"'
PLACES = np.array([[float(word) for word in point.split()] for point in POINTS])


def build(*items: str) -> str:
    return "<build>" + "".join(f"<item {item}/>" for item in items) + "</build>"


def made_of(number: int, *components: str) -> str:
    parts = "".join(f"<component {component}/>" for component in components)
    return f'<object id="{number}"><components>{parts}</components></object>'


def transform(matrix: np.ndarray) -> str:
    return f'transform="{" ".join(map(repr, matrix[:, :3].ravel().tolist()))}"'


def placed(mesh: PolygonMesh) -> list[list[list[float]]]:
    return [part.tolist() for part in np.split(mesh.points, len(mesh.points) // 4)]


def test_items_are_placed_and_only_they_are() -> None:
    shift = transform(np.vstack([np.eye(3), [5, 6, 7]]))
    other = f'<object id="2">{MESH}</object>'
    mesh = read_3mf(package(model(BODY + other, build('objectid="1"', f'objectid="1" {shift}'))))
    assert placed(mesh) == [PLACES.tolist(), (PLACES + np.array([5, 6, 7])).tolist()]
    assert mesh.corners.reshape(-1, 3).tolist() == [*FACES, *(np.array(FACES) + 4).tolist()]


def matrices() -> st.SearchStrategy[np.ndarray]:
    def matrix(seed: int) -> np.ndarray:
        return np.column_stack([np.random.default_rng(seed).normal(size=(4, 3)), [0, 0, 0, 1]])

    return st.integers(0, 2**32 - 1).map(matrix)


@given(matrices(), matrices(), matrices())
def test_transforms_of_components_come_before_those_of_what_they_are_in(
    low: np.ndarray, middle: np.ndarray, high: np.ndarray
) -> None:
    objects = BODY + made_of(2, f'objectid="1" {transform(low)}') + made_of(3, f'objectid="2" {transform(middle)}')
    mesh = read_3mf(package(model(objects, build(f'objectid="3" {transform(high)}'))))
    wanted = np.column_stack([PLACES, np.ones(4)]) @ low @ middle @ high
    np.testing.assert_allclose(mesh.points, wanted[:, :3], rtol=1e-9, atol=1e-9)
    assert signed_volume(mesh) >= 0


def test_objects_may_be_in_other_parts_and_only_those_referred_to_are_read() -> None:
    root = model(made_of(1, 'objectid="1" p:path="/3D/Parts.model"'), build('objectid="1"'), attributes=PRODUCTION)
    mesh = read_3mf(package(root, parts=model(BODY), unread="no model at all"))
    assert placed(mesh) == [PLACES.tolist()]
    built = model("", build('objectid="1" p:path="/3D/parts.model"'), attributes=PRODUCTION)
    assert placed(read_3mf(package(built, parts=model(BODY)))) == [PLACES.tolist()]


@pytest.mark.parametrize("kind", ["support", "solidsupport", "other"])
def test_what_is_no_shape_is_left_out(kind: str) -> None:
    helper = f'<object id="2" type="{kind}">{MESH}</object>'
    surface = f'<object id="3" type="surface">{MESH}</object>'
    objects = BODY + helper + surface + made_of(4, 'objectid="1"', 'objectid="2"')
    mesh = read_3mf(package(model(objects, build('objectid="2"', 'objectid="3"', 'objectid="4"'))))
    assert placed(mesh) == 2 * [PLACES.tolist()]


def test_points_are_shared_by_number_and_not_by_place() -> None:
    double = mesh_3mf(2 * POINTS, FACES)
    assert len(read_3mf(package(model(f'<object id="1">{double}</object>', build('objectid="1"')))).points) == 8


def chain(length: int) -> str:
    return "".join(made_of(number, f'objectid="{number - 1}"') for number in range(2, length + 1))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (model(BODY), "an element 'build' with items was expected in '3d/3dmodel.model', found none"),
        (model(BODY, "<build/>"), "found one without"),
        (model(BODY, build('objectid="2"')), "object '2' is to be built, but is not in '3d/3dmodel.model'"),
        (model(made_of(1, 'objectid="7"'), build('objectid="1"')), "object '7' is to be built, but is not in"),
        (model(made_of(1, 'objectid="1"'), build('objectid="1"')), "'1' is a component of itself"),
        (
            model(made_of(1, 'objectid="2"') + made_of(2, 'objectid="1"'), build('objectid="2"')),
            "'2' is a component of itself",
        ),
        (model(BODY + chain(65), build('objectid="65"')), "nested at most 64 deep"),
        (model(BODY + chain(5000), build('objectid="5000"')), "nested at most 64 deep"),
        (model(BODY + chain(5000), build(*(f'objectid="{k}"' for k in range(1, 5001)))), "nested at most 64 deep"),
        (
            model("", build('objectid="1" p:path="/gone.model"'), attributes=PRODUCTION),
            "a part 'gone.model' was expected",
        ),
    ],
    ids=lambda value: value if isinstance(value, str) and len(value) < 80 else "",
)
def test_faults_are_named(text: str, words: str) -> None:
    with pytest.raises(ReadError, match=words) as caught:
        read_3mf(package(text))
    assert "\n" not in str(caught.value)


def test_components_may_be_nested_as_deeply_as_is_said() -> None:
    assert placed(read_3mf(package(model(BODY + chain(64), build('objectid="64"'))))) == [PLACES.tolist()]


@pytest.mark.parametrize(
    ("body", "words"),
    [(MESH, r"prepare\.max_faces"), ("", "at most 100000 objects are read")],
    ids=["faces", "nothing"],
)
def test_objects_that_double_again_and_again_are_refused_before_they_are_made(body: str, words: str) -> None:
    doubled = "".join(made_of(k, *2 * [f'objectid="{k - 1}"']) for k in range(2, 60))
    with pytest.raises(ReadError, match=words):
        read_3mf(package(model(f'<object id="1">{body}</object>' + doubled, build('objectid="59"'))))


def test_copies_count_as_faces() -> None:
    content = package(model(BODY, build('objectid="1"', 'objectid="1"')))
    assert len(read_3mf(content, limits=ReadLimits(max_faces=8)).offsets) == 9
    with pytest.raises(ReadError, match=r"prepare\.max_faces"):
        read_3mf(content, limits=ReadLimits(max_faces=7))
