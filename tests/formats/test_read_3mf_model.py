"""Models: objects and items come back as written, and what does not fit is named with its line."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_bytes import FACES, POINTS, mesh_3mf, model

from fabricate.errors import ReadError
from fabricate.formats.limits import DEFAULT_LIMITS, ReadLimits
from fabricate.formats.read_3mf_model import ModelPart, read_model

MESH = mesh_3mf(POINTS, FACES)
PRODUCTION = 'xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06"'
LATTICE = 'xmlns:b="http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02"'
TWELVE = "1 2 3 4 5 6 7 8 9 10 11 12"


def read(text: str, *, limits: ReadLimits = DEFAULT_LIMITS) -> ModelPart:
    return read_model([text.encode()], limits=limits)


def test_objects_come_back_with_their_triangles() -> None:
    found = read(model(f'<object id="5" type="support">{MESH}</object><object id="6">{MESH}</object>'))
    assert list(found.objects) == ["5", "6"]
    assert [found.objects[number].kind for number in "56"] == ["support", "model"]
    assert found.objects["6"].triangles.tolist() == FACES
    assert found.objects["6"].points.tolist() == [[float(word) for word in point.split()] for point in POINTS]
    assert found.items is None


def test_components_and_items_have_their_places() -> None:
    components = f'<components><component objectid="1" transform="{TWELVE}"/><component objectid="1"/></components>'
    build = '<build><item objectid="2" p:path="/3D/x.model"/></build>'
    found = read(
        model(f'<object id="1">{MESH}</object><object id="2">{components}</object>', build, attributes=PRODUCTION)
    )
    placed, plain = found.objects["2"].components
    assert placed.transform.tolist() == [[1, 2, 3, 0], [4, 5, 6, 0], [7, 8, 9, 0], [10, 11, 12, 1]]
    np.testing.assert_array_equal(plain.transform, np.eye(4))
    assert found.items is not None
    assert [(item.part, item.number) for item in found.items] == [("/3D/x.model", "2")]


def test_an_empty_build_is_not_none() -> None:
    assert read(model("", "<build/>")).items == ()


def test_other_namespaces_are_passed_over() -> None:
    strange = '<s:vertex xmlns:s="urn:strange" x="no"/><s:object xmlns:s="urn:strange"/>'
    found = read(model(f'<object id="1">{strange}{MESH}</object>{strange}'))
    assert found.objects["1"].triangles.tolist() == FACES


def test_extensions_without_shape_may_be_required() -> None:
    attributes = f'requiredextensions="p" {PRODUCTION} recommendedextensions="b" {LATTICE}'
    assert read(model(f'<object id="1">{MESH}</object>', attributes=attributes)).objects


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<model/>", "element 'model' of the 3MF core namespace was expected, found 'model'"),
        ("<html><body/></html>", "found 'html'"),
        (model("", attributes=f'requiredextensions="b" {LATTICE}'), "needs the 3MF extension .*beamlattice"),
        (model("", attributes='requiredextensions="q"'), "needs the 3MF extension 'q'"),
        (model(f"<object>{MESH}</object>"), "an object with an 'id' of its own was expected, found 'None'"),
        (model(2 * f'<object id="1">{MESH}</object>'), "an 'id' of its own was expected, found '1'"),
        (model('<object id="1"><object id="2"/></object>'), "an 'id' of its own"),
        (
            model(f'<object id="1">{MESH}</object>').replace('x="1" ', ""),
            "a vertex with numbers x, y and z .* found y='0'",
        ),
        (
            model(f'<object id="1">{MESH}</object>').replace('x="1"', 'x="one"'),
            "a vertex with numbers .* found x='one'",
        ),
        (model(f'<object id="1">{MESH}</object>').replace('v1="1"', ""), "a triangle with point numbers"),
        (model(f'<object id="1">{MESH}</object>').replace('v1="1"', 'v1="1.5"'), "a triangle with point numbers"),
        (model(f'<object id="1">{MESH}</object>').replace('v1="1"', f'v1="{10**30}"'), "a triangle with point numbers"),
        (model(f'<object id="1">{MESH}</object>').replace('v1="1"', f'v1="{"9" * 9999}"'), "a triangle with point"),
        (
            model(f'<object id="1">{MESH}</object>').replace('v1="1"', 'v1="4"'),
            "object '1' has a triangle with point 4",
        ),
        (
            model(f'<object id="1">{MESH}</object>').replace('v1="1"', 'v1="-1"'),
            "object '1' has a triangle with point -1",
        ),
        (model("", "<build><item/></build>"), "an 'objectid' was expected, found nothing"),
        (model("", '<item objectid="1"/>'), "outside of 'build'"),
        (model("", '<build><item objectid="1" transform="1 2"/></build>'), "12 numbers was expected, found '1 2'"),
        (model("", f'<build><item objectid="1" transform="{TWELVE} 13"/></build>'), "12 numbers was expected"),
        (model("", f'<build><item objectid="1" transform="{TWELVE[:-2]}x"/></build>'), "12 numbers was expected"),
    ],
    ids=lambda value: value if isinstance(value, str) and len(value) < 80 else "",
)
def test_faults_are_given_with_their_line(text: str, words: str) -> None:
    with pytest.raises(ReadError, match=rf"^line 1: .*{words}") as caught:
        read(text)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "text",
    [
        model("".join(f'<object id="{k}"/>' for k in range(100_001))),
        model('<object id="1">' + 100_001 * '<component objectid="1"/>' + "</object>"),
        model("", "<build>" + 100_001 * '<item objectid="1"/>' + "</build>"),
    ],
    ids=["objects", "components", "items"],
)
def test_objects_without_end_are_refused(text: str) -> None:
    with pytest.raises(ReadError, match="at most 100000 objects, components and items"):
        read(text)


def test_triangles_and_points_are_counted_while_they_are_read() -> None:
    endless = model('<object id="1">').partition("</resources>")[0]
    for element in ('<vertex x="0" y="0" z="0"/>', '<triangle v1="0" v2="0" v3="0"/>'):
        with pytest.raises(ReadError, match=r"line 1: .*prepare\.max_faces"):
            read(endless + 100 * element, limits=ReadLimits(max_faces=20))
