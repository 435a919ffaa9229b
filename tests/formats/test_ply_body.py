"""PLY data: rows and properties are found where a slow walk finds them, and never past the end."""

from __future__ import annotations

import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.errors import ReadError
from fabricate.formats.limits import ReadLimits
from fabricate.formats.ply_body import PlyBody, ply_body, ply_columns
from fabricate.formats.ply_header import PlyElement, PlyHeader, PlyProperty

LINK = (PlyProperty("at", "i2", "u1"), PlyProperty("weight", "f8", None), PlyProperty("near", "u4", "i4"))
Link = tuple[list[int], float, list[int]]
LINKS = st.lists(
    st.tuples(
        st.lists(st.integers(-9, 9), max_size=3),
        st.floats(-1e6, 1e6),
        st.lists(st.integers(0, 9), max_size=2),
    ),
    min_size=1,
    max_size=6,
)
BYTE_ORDERS = ["", "<", ">"]


def link_bytes(link: Link, byte_order: str) -> bytes:
    at, weight, near = link
    if not byte_order:
        return " ".join(map(repr, [len(at), *at, weight, len(near), *near])).encode() + b"\n"
    return struct.pack(f"{byte_order}B{len(at)}hdi{len(near)}I", len(at), *at, weight, len(near), *near)


def body_of(content: bytes, byte_order: str, element: PlyElement) -> PlyBody:
    return ply_body(b"ply\n" + content, PlyHeader(byte_order, (element,), 4))


@pytest.mark.parametrize("byte_order", BYTE_ORDERS)
@given(links=LINKS)
def test_every_row_and_property_is_found(byte_order: str, links: list[Link]) -> None:
    element = PlyElement("link", len(links), LINK)
    body = body_of(b"".join(link_bytes(link, byte_order) for link in links), byte_order, element)
    bounds = body.bounds(element, body.begin)
    columns, ends = ply_columns(body, element, bounds[:-1], {declared.name for declared in LINK})
    assert ends.tolist() == bounds[1:].tolist()
    assert (bounds[0], bounds[-1], body.left_over(int(bounds[-1]))) == (body.begin, body.end, "")
    for place, column in enumerate(columns):
        wanted = [np.atleast_1d(link[place]).tolist() for link in links]
        assert column.lengths.tolist() == [len(items) for items in wanted]
        size = body.size(column.declared.kind)
        for first, items in zip(column.firsts, wanted, strict=True):
            places = first + size * np.arange(len(items))
            assert body.read(places, column.declared.kind).tolist() == items


@pytest.mark.parametrize("byte_order", BYTE_ORDERS)
@given(links=LINKS, missing=st.integers(1, 10**17))
def test_more_rows_than_there_are_data_for_are_refused(byte_order: str, links: list[Link], missing: int) -> None:
    element = PlyElement("link", len(links) + missing, LINK)
    body = body_of(b"".join(link_bytes(link, byte_order) for link in links), byte_order, element)
    with pytest.raises(ReadError, match=f"declares {element.count} rows of element 'link', but only"):
        body.bounds(element, body.begin)


@pytest.mark.parametrize("byte_order", BYTE_ORDERS)
@given(links=LINKS)
def test_only_the_columns_asked_for_come_back(byte_order: str, links: list[Link]) -> None:
    element = PlyElement("link", len(links), LINK)
    body = body_of(b"".join(link_bytes(link, byte_order) for link in links), byte_order, element)
    begins = body.bounds(element, body.begin)[:-1]
    every, _ = ply_columns(body, element, begins, {"at", "weight", "near"})
    [near], _ = ply_columns(body, element, begins, {"near"})
    assert near.firsts.tolist() == every[2].firsts.tolist()


@pytest.mark.parametrize("byte_order", BYTE_ORDERS)
@pytest.mark.parametrize(("name", "most"), [("face", 2), ("vertex", 6), ("tristrips", 6)])
def test_rows_are_counted_against_the_limits(byte_order: str, name: str, most: int) -> None:
    for count in (most, most + 1):
        element = PlyElement(name, count, (PlyProperty("v", "u1", "u1"),))
        row = b"1 0\n" if not byte_order else b"\x01\0"
        content = b"ply\n" + count * row
        body = ply_body(content, PlyHeader(byte_order, (element,), 4), limits=ReadLimits(max_faces=2))
        if count == most:
            assert len(body.bounds(element, body.begin)) == count + 1
            continue
        with pytest.raises(ReadError, match=r"prepare\.max_faces"):
            body.bounds(element, body.begin)


def test_a_row_that_ends_past_the_data_is_named() -> None:
    element = PlyElement("face", 1, (PlyProperty("corners", "i4", "u1"),))
    body = body_of(b"3 0 1\n", "", element)
    with pytest.raises(ReadError, match="line 2: the file ends inside a row of 'face'"):
        ply_columns(body, element, np.array([0]), {"corners"})


@pytest.mark.parametrize(("byte_order", "words"), [("", "2 numbers"), ("<", "3 bytes")])
def test_what_is_left_over_is_counted(byte_order: str, words: str) -> None:
    element = PlyElement("none", 0, ())
    body = body_of(b"8 9", byte_order, element)
    assert body.left_over(body.begin) == words
    assert body.left_over(body.end) == ""
    assert body_of(b" \n", byte_order, element).left_over(body.begin) == ""


def test_text_that_is_no_number_is_named_with_its_line_in_the_file() -> None:
    with pytest.raises(ReadError, match="line 3: a number was expected, found 'x'"):
        body_of(b"1 2\nx\n", "", PlyElement("none", 0, ()))
