"""Files are written whole or not at all, and a reason that can be read says why not."""

from __future__ import annotations

import errno
from pathlib import Path

import pytest

from fabricate.errors import OutputError
from fabricate.output.files import beside, check_writable, output_error, write_whole


def test_a_file_is_written_and_replaced_and_nothing_else_is_left(tmp_path: Path) -> None:
    path = tmp_path / "part.stl"
    for content in (b"first", b"", b"third"):
        write_whole(path, content)
        assert path.read_bytes() == content
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EACCES, errno.EIO])
def test_when_writing_fails_the_old_file_stays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int) -> None:
    path = tmp_path / "part.stl"
    path.write_bytes(b"old")

    def fail(self: Path, _content: bytes) -> int:
        self.touch()
        raise OSError(number, "No luck")

    monkeypatch.setattr(Path, "write_bytes", fail)
    with pytest.raises(OutputError, match=r"cannot write .*part\.stl: no luck; "):
        write_whole(path, b"new")
    monkeypatch.undo()
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(
    ("place", "advice"),
    [
        ("missing/part.stl", "choose another place"),
        ("file/part.stl", "a file is in the way"),
        ("x" * 300, "shorter"),
    ],
)
def test_places_that_cannot_be_written_to_are_errors_that_say_what_to_do(
    tmp_path: Path, place: str, advice: str
) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(OutputError, match=advice) as caught:
        write_whole(tmp_path / place, b"content")
    assert "\n" not in str(caught.value)
    assert isinstance(caught.value, OSError)


def test_a_folder_is_not_replaced_by_a_file(tmp_path: Path) -> None:
    (tmp_path / "name").mkdir()
    with pytest.raises(OutputError, match="a folder is in the way"):
        write_whole(tmp_path / "name", b"content")
    assert list(tmp_path.iterdir()) == [tmp_path / "name"]


def test_the_reason_of_the_system_is_part_of_the_message() -> None:
    error = output_error(Path("somewhere"), OSError(errno.ENOSPC, "No space left on device"))
    assert str(error) == "cannot write somewhere: no space left on device; free some space or choose another disk"


def test_temporary_names_are_hidden_in_the_same_folder_and_differ() -> None:
    names = {beside(Path("folder/part.stl"), "part") for _ in range(20)}
    assert len(names) == 20
    assert {name.parent for name in names} == {Path("folder")}
    assert all(name.name.startswith(".part.stl.") for name in names)


def test_whether_a_file_can_be_written_is_known_before(tmp_path: Path) -> None:
    check_writable(tmp_path / "report.json")
    assert list(tmp_path.iterdir()) == []
    for wrong in (tmp_path, tmp_path / "missing" / "report.json"):
        with pytest.raises(OutputError, match="cannot write"):
            check_writable(wrong)
