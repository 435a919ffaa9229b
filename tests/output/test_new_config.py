"""A new config appears whole, under a name that works everywhere, and never in place of another file."""

import errno
import os
from pathlib import Path

import pytest

from fabricate.config import TorusConfig, load_config
from fabricate.errors import ConfigError, OutputError
from fabricate.output.new_config import write_new_config


def test_a_new_config_is_written_and_never_overwritten(tmp_path: Path) -> None:
    path = write_new_config("first", tmp_path)
    assert path == tmp_path / "first.toml"
    assert isinstance(load_config(path).source, TorusConfig)
    path.write_text("mine")
    with pytest.raises(ConfigError, match="exists already"):
        write_new_config("first", tmp_path)
    assert path.read_text() == "mine"


@pytest.mark.parametrize("name", ["", ".", "..", "a/b", "../a", "-a", ".a", "a b", "a\n", "a\0", "first.toml", "a:b"])
def test_bad_names_are_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(ConfigError, match="expected a name"):
        write_new_config(name, tmp_path)
    assert not list(tmp_path.iterdir())


def test_a_folder_that_is_none_is_said(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="cannot write"):
        write_new_config("first", tmp_path / "none")


def full_disk(*_: object) -> None:
    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def test_a_full_disk_leaves_nothing_behind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    written = Path.write_bytes

    def half(path: Path, content: bytes) -> None:
        written(path, content[:40])
        full_disk()

    monkeypatch.setattr(Path, "write_bytes", half)
    with pytest.raises(OutputError, match=r"no space left.*free some space"):
        write_new_config("first", tmp_path)
    assert not list(tmp_path.iterdir())


def no_links(*_: object) -> None:
    raise PermissionError(errno.EPERM, os.strerror(errno.EPERM))


def test_a_disk_without_links_is_no_obstacle(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Path, "hardlink_to", no_links)
    path = write_new_config("first", tmp_path)
    assert isinstance(load_config(path).source, TorusConfig)
    assert list(tmp_path.iterdir()) == [path]
    path.write_text("mine")
    with pytest.raises(ConfigError, match="exists already"):
        write_new_config("first", tmp_path)
    assert path.read_text() == "mine"
    assert list(tmp_path.iterdir()) == [path]


def test_a_link_that_leads_nowhere_is_not_followed(tmp_path: Path) -> None:
    (tmp_path / "first.toml").symlink_to("elsewhere.toml")
    with pytest.raises(ConfigError, match="exists already"):
        write_new_config("first", tmp_path)
    assert not (tmp_path / "elsewhere.toml").exists()
