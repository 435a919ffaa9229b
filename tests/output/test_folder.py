"""A folder of results appears when it is complete; whatever fails, the old one stays and no rest is left."""

from __future__ import annotations

import errno
from pathlib import Path

import pytest

from fabricate.errors import OutputError
from fabricate.output.folder import MARKER, complete_folder


def make(destination: Path, **files: str) -> None:
    with complete_folder(destination) as folder:
        (folder / MARKER).touch()
        for name, text in files.items():
            (folder / name).write_text(text)


def found(folder: Path) -> dict[str, str]:
    return {path.name: path.read_text() for path in folder.iterdir() if path.name != MARKER}


def test_the_folder_appears_only_at_the_end(tmp_path: Path) -> None:
    destination = tmp_path / "outputs" / "first"
    with complete_folder(destination) as folder:
        (folder / "a").write_text("1")
        assert not destination.exists()
        assert folder.parent == destination.parent
    assert found(destination) == {"a": "1"}
    assert list(destination.parent.iterdir()) == [destination]


def test_an_existing_folder_is_replaced_with_everything_in_it(tmp_path: Path) -> None:
    destination = tmp_path / "first"
    make(destination, a="old", b="old")
    with complete_folder(destination) as folder:
        (folder / "a").write_text("new")
        assert found(destination) == {"a": "old", "b": "old"}
    assert found(destination) == {"a": "new"}
    assert list(tmp_path.iterdir()) == [destination]


@pytest.mark.parametrize("error", [RuntimeError, KeyboardInterrupt, OutputError])
def test_when_the_block_fails_the_old_folder_stays_and_nothing_else(tmp_path: Path, error: type[BaseException]) -> None:
    destination = tmp_path / "first"
    make(destination, a="old")

    def fail() -> None:
        with complete_folder(destination) as folder:
            (folder / "a").write_text("new")
            raise error("in the middle")

    with pytest.raises(error, match="in the middle"):
        fail()
    assert found(destination) == {"a": "old"}
    assert list(tmp_path.iterdir()) == [destination]


def test_when_the_block_fails_folders_made_on_the_way_are_gone_too(tmp_path: Path) -> None:
    kept = tmp_path / "kept"
    kept.mkdir()
    with pytest.raises(RuntimeError, match="in the middle"), complete_folder(kept / "a" / "b" / "first"):
        raise RuntimeError("in the middle")
    assert list(tmp_path.rglob("*")) == [kept]


def test_when_the_last_rename_fails_the_old_folder_is_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    destination = tmp_path / "first"
    make(destination, a="old")
    rename = Path.rename

    def fail(self: Path, target: Path) -> Path:
        if self.name.endswith(".new"):
            raise OSError(errno.ENOSPC, "No space left on device")
        return rename(self, target)

    monkeypatch.setattr(Path, "rename", fail)
    with pytest.raises(OutputError, match="no space left on device; free some space"):
        make(destination, a="new")
    assert found(destination) == {"a": "old"}
    assert list(tmp_path.iterdir()) == [destination]


def test_a_file_in_the_place_of_the_folder_is_refused_before_the_work(tmp_path: Path) -> None:
    (tmp_path / "first").write_text("mine")
    with (
        pytest.raises(OutputError, match="first: it is a file; choose another name"),
        complete_folder(tmp_path / "first"),
    ):
        pytest.fail("the block was entered")
    assert found(tmp_path) == {"first": "mine"}


@pytest.mark.parametrize("place", ["file/first", "x" * 300])
def test_a_place_that_cannot_be_made_is_refused_before_the_work(tmp_path: Path, place: str) -> None:
    (tmp_path / "file").write_text("mine")
    with pytest.raises(OutputError, match="cannot write") as caught, complete_folder(tmp_path / place):
        pytest.fail("the block was entered")
    assert "\n" not in str(caught.value)
    assert found(tmp_path) == {"file": "mine"}


def test_no_permission_is_a_readable_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(_self: Path, **_options: bool) -> None:
        raise PermissionError(errno.EACCES, "Permission denied")

    monkeypatch.setattr(Path, "mkdir", fail)
    with (
        pytest.raises(OutputError, match="permission denied; choose a place that you may write to"),
        complete_folder(tmp_path / "first"),
    ):
        pytest.fail("the block was entered")


def test_a_link_to_a_folder_stays_a_link(tmp_path: Path) -> None:
    real = tmp_path / "real"
    make(real, a="old")
    link = tmp_path / "link"
    link.symlink_to(real)
    make(link, a="new")
    assert link.is_symlink()
    assert found(real) == {"a": "new"}


def test_a_whole_disk_is_not_replaced() -> None:
    with pytest.raises(OutputError, match="it is a whole disk"), complete_folder(Path("/")):
        pytest.fail("the block was entered")


def test_a_ring_of_links_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a").symlink_to(tmp_path / "b")
    (tmp_path / "b").symlink_to(tmp_path / "a")
    with pytest.raises(OutputError, match="cannot write"):
        make(tmp_path / "a", x="1")


def test_if_the_old_folder_cannot_be_deleted_the_new_one_is_in_place_and_the_message_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    destination = tmp_path / "first"
    make(destination, a="old")

    def fail(_path: Path, **_options: bool) -> None:
        raise PermissionError(errno.EACCES, "Permission denied")

    monkeypatch.setattr("shutil.rmtree", fail)
    with pytest.raises(OutputError, match=r"first is complete, but .* delete .*\.old yourself"):
        make(destination, a="new")
    assert found(destination) == {"a": "new"}


def test_the_folder_may_be_used_by_others_as_any_new_folder(tmp_path: Path) -> None:
    (tmp_path / "plain").mkdir()
    make(tmp_path / "first", a="1")
    assert (tmp_path / "first").stat().st_mode == (tmp_path / "plain").stat().st_mode


@pytest.mark.parametrize("holding", ["thesis.tex", "a/b"])
def test_a_folder_of_other_things_is_not_replaced(tmp_path: Path, holding: str) -> None:
    precious = tmp_path / "first" / holding
    precious.parent.mkdir(parents=True)
    precious.write_text("years of work")
    with pytest.raises(OutputError, match=r"holds other things than results.*choose another name"):
        make(tmp_path / "first", a="new")
    assert precious.read_text() == "years of work"
    assert len(list(tmp_path.iterdir())) == 1


def test_an_empty_folder_is_free(tmp_path: Path) -> None:
    (tmp_path / "first").mkdir()
    make(tmp_path / "first", a="new")
    assert found(tmp_path / "first") == {"a": "new"}
