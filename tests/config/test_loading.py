"""Config files are read whole, or refused in one line that begins with their path."""

from collections.abc import Callable
from pathlib import Path

import pytest

from fabricate.config import Config, TorusConfig, load_config
from fabricate.errors import ConfigError

TORUS = '[source]\nshape = "torus"\n'


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[source", "not valid TOML: .*line 1"),
        ("[source]\nshape = torus", "not valid TOML: .*line 2"),
        ("a = " + "[" * 5000, "nested too deeply"),
        ("a = " + "9" * 5000, "not valid TOML"),
        (TORUS + "[pattern]\nsed = 1", "pattern.sed: unknown key; did you mean pattern.seed"),
    ],
    ids=["bracket", "bare-word", "nested", "digits", "key"],
)
def test_what_is_wrong_is_one_line_with_the_path(
    read: Callable[..., Config], tmp_path: Path, text: str, words: str
) -> None:
    with pytest.raises(ConfigError, match=words) as caught:
        read(text)
    assert str(caught.value).startswith(f"{tmp_path / 'some.toml'}: ")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("content", "words"),
    [(b"\xff\xfe[\x00", "expected UTF-8"), (b'[source]\nshape = "\xe9"', "expected UTF-8 text.*18")],
)
def test_what_is_not_utf_8_is_refused(tmp_path: Path, content: bytes, words: str) -> None:
    path = tmp_path / "some.toml"
    path.write_bytes(content)
    with pytest.raises(ConfigError, match=words):
        load_config(path)


def test_a_byte_order_mark_and_windows_line_ends_are_welcome(tmp_path: Path) -> None:
    path = tmp_path / "some.toml"
    path.write_bytes(b"\xef\xbb\xbf" + TORUS.replace("\n", "\r\n").encode())
    assert isinstance(load_config(path).source, TorusConfig)


def test_files_that_are_not_there(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match=r"none\.toml: no such file"):
        load_config(tmp_path / "none.toml")
    with pytest.raises(ConfigError, match="found a folder"):
        load_config(tmp_path)
    (tmp_path / "file").touch()
    with pytest.raises(ConfigError, match="cannot be read"):
        load_config(tmp_path / "file" / "a.toml")
