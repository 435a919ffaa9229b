"""PLY headers: what they declare comes back, however lines end, and every fault is given with its line."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.errors import ReadError
from fabricate.formats.ply_header import PlyElement, PlyProperty, read_ply_header

HEADER = """ply
format ascii 1.0
comment made by hand end_header
obj_info none
element vertex 5
property float x
property double y
element face 2
property list uchar int vertex_indices
end_header
"""
ELEMENTS = (
    PlyElement("vertex", 5, (PlyProperty("x", "f4", None), PlyProperty("y", "f8", None))),
    PlyElement("face", 2, (PlyProperty("vertex_indices", "i4", "u1"),)),
)
NAMES = st.text("abcdefghijklmnopqrstuvwxyz_0123456789", min_size=1, max_size=9)
KINDS = {"char": "i1", "ushort": "u2", "int32": "i4", "uint": "u4", "float64": "f8", "float32": "f4"}


@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r", " \n", "\t\r\n"])
def test_what_is_declared_comes_back_and_data_begin_behind_it(newline: str) -> None:
    content = HEADER.replace("\n", newline).encode() + b"\n1 2 3 end_header\n"
    header = read_ply_header(content)
    assert header.elements == ELEMENTS
    assert header.byte_order == ""
    assert content[header.begin :] == b"\n1 2 3 end_header\n"
    assert header.summary == "5 vertex, 2 face"


@pytest.mark.parametrize(("name", "byte_order"), [("binary_little_endian", "<"), ("binary_big_endian", ">")])
def test_the_byte_order_is_that_of_the_format(name: str, byte_order: str) -> None:
    assert read_ply_header(HEADER.replace("ascii", name).encode()).byte_order == byte_order


@given(
    st.lists(
        st.builds(
            PlyElement,
            NAMES,
            st.integers(0, 10**18 - 1),
            st.lists(
                st.builds(
                    PlyProperty,
                    NAMES,
                    st.sampled_from(sorted(KINDS.values())),
                    st.sampled_from([None, "i1", "u2", "u4"]),
                ),
                max_size=4,
            ).map(tuple),
        ),
        max_size=4,
    )
)
def test_any_elements_come_back(elements: list[PlyElement]) -> None:
    words = {code: name for name, code in KINDS.items()}
    lines = ["ply", "format ascii 1.0"]
    for element in elements:
        lines.append(f"element {element.name} {element.count}")
        for declared in element.properties:
            length = f"list {words[declared.length_kind]} " if declared.length_kind else ""
            lines.append(f"property {length}{words[declared.kind]} {declared.name}")
    assert read_ply_header("\n".join([*lines, "end_header"]).encode()).elements == tuple(elements)


def test_nothing_declared_is_said() -> None:
    assert read_ply_header(b"ply\nformat ascii 1.0\nend_header\n").summary == "nothing"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("ply\n", "plain\n", "begin with a line 'ply', found 'plain"),
        ("end_header\n", "end_of_header\n", "end with a line 'end_header'"),
        ("format ascii 1.0\n", "", "to have a line 'format'"),
        ("format ascii 1.0\n", "format\n", "line 2: the format was expected to be one of ascii"),
        ("format ascii", "format base64", "line 2: the format was expected to be one of ascii"),
        ("double y", "real y", "line 7: a property type was expected .* found 'real'"),
        ("double y", "", "line 7: 'property' cannot be understood"),
        ("list uchar int", "list float int", "line 9: 'property list float int"),
        ("element vertex 5", "element vertex -5", "line 5: 'element vertex -5' cannot be understood"),
        ("element vertex 5", f"element vertex {10**18}", "line 5: .* cannot be understood"),
        ("element vertex 5\n", "", "line 5: 'property float x' cannot be understood"),
    ],
)
def test_faults_are_given_with_their_line(old: str, new: str, message: str) -> None:
    assert old in HEADER
    with pytest.raises(ReadError, match=message):
        read_ply_header(HEADER.replace(old, new).encode())
