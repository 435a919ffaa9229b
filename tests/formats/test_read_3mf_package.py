"""Packages: parts come out whole whatever their name's case, and archives that are broken or bombs are refused."""

from __future__ import annotations

import io
import struct
import tracemalloc
import zipfile

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mesh_bytes import RELATIONS, package

from fabricate.errors import ReadError
from fabricate.formats.limits import DEFAULT_LIMITS, ReadLimits
from fabricate.formats.read_3mf_package import Package, part_name

TEXT = "<model>" + 1000 * "words " + "</model>"


def archive(parts: dict[str, str], *, compression: int = zipfile.ZIP_DEFLATED) -> bytes:
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", compression) as written:
        for name, text in parts.items():
            written.writestr(name, text)
    return content.getvalue()


def unpacked(content: bytes, name: str = "3D/3dmodel.model", *, limits: ReadLimits = DEFAULT_LIMITS) -> str:
    return b"".join(Package(content, limits=limits).chunks(name)).decode()


@pytest.mark.parametrize("compression", [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED])
@pytest.mark.parametrize("name", ["3D/3dmodel.model", "/3d/3DMODEL.model"])
def test_parts_are_unpacked(compression: int, name: str) -> None:
    assert unpacked(package(TEXT, compression=compression), name) == TEXT


@pytest.mark.parametrize(
    ("parts", "name"),
    [
        ({}, "3d/3dmodel.model"),
        ({"_rels/.rels": RELATIONS}, "3d/other.model"),
        ({"_rels/.rels": RELATIONS.replace("2013/01/3dmodel", "other")}, "3d/3dmodel.model"),
        ({"_rels/.rels": RELATIONS.replace("Target", "Target2")}, "3d/3dmodel.model"),
    ],
)
def test_the_relations_name_the_model(parts: dict[str, str], name: str) -> None:
    assert Package(archive(parts)).model_name() == name


def test_part_names_are_compared_from_the_root_and_in_any_case() -> None:
    assert part_name("/3D/A.model") == part_name("3d/a.MODEL") == "3d/a.model"


def test_bombs_are_refused_by_their_declared_size_before_they_are_unpacked() -> None:
    content = archive({"3D/3dmodel.model": "0" * 30_000_000, "other": "0" * 10_000_000})
    assert len(content) < 100_000
    tracemalloc.start()
    with pytest.raises(ReadError, match=r"what is packed into the file has .*prepare\.max_file_mb"):
        Package(content, limits=ReadLimits(max_bytes=39_999_999))
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 1_000_000
    Package(content, limits=ReadLimits(max_bytes=40_000_000))


def test_a_part_is_never_unpacked_past_its_declared_size() -> None:
    content = package("0" * 30_000_000).replace(struct.pack("<I", 30_000_000), struct.pack("<I", 1000))
    tracemalloc.start()
    with pytest.raises(ReadError, match="cannot be unpacked"):
        unpacked(content, limits=ReadLimits(max_bytes=2000))
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 10_000_000


def encrypted(content: bytes) -> bytes:
    """Set the flag that says so, in both of an entry's headers."""
    for mark, flags in ((b"PK\x03\x04", 6), (b"PK\x01\x02", 8)):
        place = content.index(mark) + flags
        content = content[:place] + b"\1" + content[place + 1 :]
    return content


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "no whole zip archive"),
        (package(TEXT)[:-10], "no whole zip archive"),
        (archive({"a.txt": "words"}), "a part '3D/3dmodel.model' was expected"),
        (encrypted(package(TEXT)), "is encrypted; save the file without a password"),
        (package(TEXT, compression=zipfile.ZIP_BZIP2), "packed in a way that 3MF does not allow"),
        (package(TEXT, compression=zipfile.ZIP_LZMA), "packed in a way that 3MF does not allow"),
        (
            package(TEXT, compression=zipfile.ZIP_STORED).replace(b"words", b"swords", 1),
            "no whole zip|cannot be unpacked",
        ),
        (package(TEXT, compression=zipfile.ZIP_STORED).replace(b"words", b"sword", 1), "cannot be unpacked"),
        (100_001 * b"PK\x01\x02", "at most 100000 entries"),
    ],
    ids=["empty", "cut", "other", "encrypted", "bzip2", "lzma", "longer", "changed", "entries"],
)
def test_archives_that_cannot_be_read_say_why(content: bytes, words: str) -> None:
    with pytest.raises(ReadError, match=words) as caught:
        unpacked(content)
    assert "\n" not in str(caught.value)


@given(st.data())
def test_damaged_archives_are_unpacked_or_refused(data: st.DataObject) -> None:
    content = bytearray(package("some words", extra="more words"))
    for _ in range(data.draw(st.integers(1, 3))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    try:
        opened = Package(bytes(content))
        list(opened.chunks(opened.model_name()))
    except ReadError as error:
        assert "\n" not in str(error)  # noqa: PT017
