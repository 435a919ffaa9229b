"""Bytes of any kind: every reader returns a mesh or raises ReadError, and takes no more memory than is fair."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tracemalloc
import zipfile
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mesh_bytes import (
    ALL,
    FACES,
    POINTS,
    RELATIONS,
    TEXTS,
    accessor,
    glb,
    glb_bytes,
    gltf,
    mesh_3mf,
    model,
    package,
    ply_header,
)

from fabricate.errors import FabricateError, ReadError
from fabricate.formats.limits import ReadLimits
from fabricate.formats.reading import read_mesh
from fabricate.mesh.closed import checked_closed

LIMITS = ReadLimits(max_bytes=1 << 20, max_faces=1000)
MOST_MEMORY = 24 << 20
"""Bytes that reading a file of some kilobytes may take: what the limits allow, and room for libraries."""

QUADS = [[0, 1, 2, 3], [3, 2, 1, 0], [0, 2, 1]]
TRANSFORM = 'transform="1 0 0 0 -1 0 0 0 1 5 5 5"'
COMPONENTS = f'<object id="2"><components><component objectid="1" {TRANSFORM}/></components></object>'
MODEL = model(f'<object id="1">{mesh_3mf(POINTS, FACES)}</object>{COMPONENTS}', '<build><item objectid="2"/></build>')
SCENE = gltf(
    [accessor(0, 4, 5126, "VEC3"), accessor(1, 12, 5123, "SCALAR", byteOffset=0)],
    [48, 24],
    [[{"attributes": {"POSITION": 0}, "indices": 1}, {"attributes": {"POSITION": 0}, "mode": 5}]],
    nodes=[{"children": [1], "scale": [1, 2, 3]}, {"mesh": 0, "rotation": [0, 0, 1, 0]}],
    scenes=[{"nodes": [0]}],
    scene=0,
)
DATA = glb(POINTS, FACES)[-72:]

FILES = [writer(POINTS, FACES) for writer in ALL]
FILES += [writer(POINTS, QUADS) for writer in ALL[:7]]
FILES += [writer(POINTS, FACES).decode().encode("utf-16") for writer in TEXTS]
FILES += [package(MODEL, compression=zipfile.ZIP_STORED, other=RELATIONS), glb_bytes(SCENE, DATA)]

RUBBISH = [
    b"-1",
    b"99999999999999999999",
    b"1e400",
    b"nan",
    b"\n",
    b" ",
    b"0",
    b"/",
    b"\\\n",
    b"#",
    b'"',
    b"<",
    b"[",
    b"{",
]
RUBBISH += [4 * b"\xff", 4 * b"\0", b"\x7f\xff\xff\xff", b"\xff\xff\xff\x7f", b"\0\0\0\x80", b"\x80\0\0\0"]

SOME = settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
MANY = settings(SOME, max_examples=600)


def mutated(content: bytes, others: list[bytes], data: st.DataObject) -> bytes:
    """Replace, insert, remove, repeat or cut some bytes, or go on with the rest of another file."""
    for _ in range(data.draw(st.integers(1, 3))):
        begin = data.draw(st.integers(0, len(content)))
        end = min(begin + data.draw(st.integers(0, 12)), len(content))
        match data.draw(st.sampled_from(["bytes", "rubbish", "rubbish", "repeat", "cut", "splice"])):
            case "bytes":
                content = content[:begin] + data.draw(st.binary(max_size=8)) + content[end:]
            case "rubbish":
                content = content[:begin] + data.draw(st.sampled_from(RUBBISH)) + content[end:]
            case "repeat":
                content = content[:end] + data.draw(st.integers(1, 50)) * content[begin:end] + content[end:]
            case "cut":
                content = content[:begin]
            case "splice":
                other = data.draw(st.sampled_from(others))
                content = content[:begin] + other[data.draw(st.integers(0, len(other))) :]
    return content


def check(folder: Path, content: bytes, suffix: str = "") -> None:
    """Read a file and hold what happens against what may happen."""
    path = folder / f"file{suffix}"
    path.write_bytes(content)
    mesh = None
    tracemalloc.start()
    try:
        mesh = read_mesh(path, limits=LIMITS)
    except ReadError as error:
        assert "\n" not in str(error)  # noqa: PT017
        assert len(str(error)) < 600  # noqa: PT017
    finally:
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
    assert peak < MOST_MEMORY
    if mesh is not None:
        assert len(mesh.offsets) - 1 <= LIMITS.max_faces
        try:
            checked_closed(mesh)
        except FabricateError as error:
            assert "\n" not in str(error)  # noqa: PT017


SUFFIXES = st.sampled_from(["", ".3mf", ".glb", ".obj", ".off", ".ply", ".stl"])
BEGINS = [
    b"",
    b"PK\x03\x04",
    b"glTF\2\0\0\0",
    b"ply\nformat ascii 1.0\n",
    b"OFF\n",
    b"OFF BINARY\n",
    b"solid\nfacet ",
    b"v 1",
]


@SOME
@given(begin=st.sampled_from(BEGINS), content=st.binary(max_size=400), suffix=SUFFIXES)
def test_random_bytes(tmp_path: Path, begin: bytes, content: bytes, suffix: str) -> None:
    check(tmp_path, begin + content, suffix)


@MANY
@given(st.data())
def test_damaged_and_spliced_files(tmp_path: Path, data: st.DataObject) -> None:
    content = mutated(data.draw(st.sampled_from(FILES)), FILES, data)
    check(tmp_path, content, data.draw(SUFFIXES))


@SOME
@given(st.data())
def test_whole_packages_with_damaged_models(tmp_path: Path, data: st.DataObject) -> None:
    text = mutated(MODEL.encode(), [MODEL.encode(), RELATIONS.encode()], data)
    check(tmp_path, package(text))


@SOME
@given(st.data())
def test_whole_containers_with_damaged_documents(tmp_path: Path, data: st.DataObject) -> None:
    whole = glb_bytes(SCENE, DATA)
    text = json.dumps(SCENE).encode()
    damaged = mutated(text, [text], data)
    size = len(damaged).to_bytes(4, "little")
    length = (len(whole) - len(text) + len(damaged)).to_bytes(4, "little")
    assert whole[20 : 20 + len(text)] == text
    check(tmp_path, whole[:8] + length + size + whole[16:20] + damaged + whole[20 + len(text) :])


def leaves(value: Any) -> list[tuple[Any, Any]]:
    """Return every place in nested lists and dicts: the container and the key or index in it."""
    keys = value.keys() if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else ()
    return [place for key in keys for place in [(value, key), *leaves(value[key])]]


WRONG = [-1, 0, 1, 2, 3, 7, 255, 2**31, 2**40, 1e300, 5120, 5125, 5126, None, True, "VEC3", [], {}, [0], [[0]]]


@MANY
@given(st.data())
def test_documents_with_other_values(tmp_path: Path, data: st.DataObject) -> None:
    document = json.loads(json.dumps(SCENE))
    for _ in range(data.draw(st.integers(1, 3))):
        container, key = data.draw(st.sampled_from(leaves(document)))
        container[key] = json.loads(json.dumps(data.draw(st.sampled_from(WRONG))))  # others may go into it
    check(tmp_path, glb_bytes(document, DATA))


def bombs() -> dict[str, bytes]:
    """Return small files that declare or unfold to sizes that no computer has."""
    doubled = "".join(
        f'<object id="{k}"><components>{2 * f"""<component objectid="{k - 1}"/>"""}</components></object>'
        for k in range(3, 60)
    )
    huge = {**SCENE, "accessors": [accessor(0, 2**31 - 2, 5126, "VEC3"), accessor(1, 3, 5123, "SCALAR")]}
    entities = "".join(f'<!ENTITY b{k} "{10 * f"&b{k - 1};"}">' for k in range(1, 12))
    size = 10_000_000
    claimed = package(" " * size).replace(size.to_bytes(4, "little"), (2**31).to_bytes(4, "little"))
    return {
        "counts.off": b"OFF\n999999999999 999999999999 0\n0 0 0\n",
        "counts.binary.off": b"OFF BINARY\n" + 3 * b"\x7f\xff\xff\xff" + bytes(64),
        "ascii.ply": ply_header("ascii", 10**17, 10**17).encode() + b"0 0 0\n",
        "binary.ply": ply_header("binary_little_endian", 10**17, 10**17).encode() + bytes(99),
        "lists.ply": ply_header("binary_big_endian", 1, 1, length="uint").encode() + bytes(12) + b"\xff\xff\xff\xff\0",
        "strips.ply": ply_header("binary_big_endian", 1, 2**40, kind="tristrips").encode() + bytes(99),
        "count.stl": bytes(80) + b"\xff\xff\xff\xff" + bytes(500),
        "text.off": b"OFF\n3 1 0\n" + 5_000_000 * b"1 ",
        "unpacked.3mf": claimed,
        "tag.3mf": package(b"<a" + b" " * 50_000_000),
        "deep.3mf": package(model(10_000_000 * "<a>")),
        "names.3mf": package(model("".join(f"<a{k}/>" for k in range(500_000)))),
        "doubled.3mf": package(
            MODEL.replace("</resources>", f"{doubled}</resources>").replace('item objectid="2"', 'item objectid="59"')
        ),
        "entities.3mf": package(f'<!DOCTYPE m [<!ENTITY b0 "ha">{entities}]><m>&b11;</m>'),
        "count.glb": glb_bytes(huge, DATA),
        "deep.glb": glb_bytes(json.loads(499 * "[" + 499 * "]"), b"").replace(b"[]", b"[[", 1),
        "nodes.glb": glb_bytes({"asset": {"version": "2.0"}, "nodes": 1_000_000 * [{}]}, b""),
    }


CHILD = """
import resource, sys
from pathlib import Path
from fabricate.errors import ReadError
from fabricate.formats.reading import read_mesh
pages = int(Path("/proc/self/statm").read_text().split()[0])
most = pages * resource.getpagesize() + (1 << 30)
resource.setrlimit(resource.RLIMIT_AS, (most, most))
for path in sorted(Path(sys.argv[1]).iterdir()):
    try:
        read_mesh(path)
        print(path.name, "was read")
    except ReadError as error:
        print(path.name, "was refused:", error)
"""


@pytest.mark.skipif(
    not Path("/proc/self/statm").exists(), reason="memory is only limited where /proc says how much there is"
)
def test_bombs_are_refused_within_a_gigabyte(tmp_path: Path) -> None:
    files = bombs()
    for name, content in files.items():
        (tmp_path / name).write_bytes(content)
    run = subprocess.run(
        [sys.executable, "-c", CHILD, str(tmp_path)],
        env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert run.stderr == ""
    lines = run.stdout.splitlines()
    assert [line.split(":")[0] for line in lines] == [f"{name} was refused" for name in sorted(files)]
