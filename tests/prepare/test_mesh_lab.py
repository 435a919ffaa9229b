from __future__ import annotations

import builtins
import os
import sys
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

from fabricate.errors import PrepareError
from fabricate.prepare.mesh_lab import mesh_lab, silenced

IMPORT = builtins.__import__


def importing(found: ModuleType | SimpleNamespace | ImportError) -> Any:
    def imported(name: str, *rest: Any, **named: Any) -> Any:
        if name != "pymeshlab":
            return IMPORT(name, *rest, **named)
        if isinstance(found, ImportError):
            raise found
        return found

    return imported


def test_nothing_is_printed_within_and_everything_after(capfd: pytest.CaptureFixture[str]) -> None:
    with silenced():
        os.write(1, b"compiled chatter")
        os.write(2, b"compiled chatter")
    os.write(1, b"out")
    os.write(2, b"err")
    assert capfd.readouterr() == ("out", "err")


def test_an_error_within_does_not_leave_the_process_silent(capfd: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(KeyError), silenced():
        raise KeyError
    os.write(1, b"out")
    assert capfd.readouterr().out == "out"


@pytest.mark.parametrize(
    ("found", "advice"),
    [
        (ModuleNotFoundError("pymeshlab"), "pip install pymeshlab"),
        (ImportError("libGL.so.1: cannot open shared object file"), "apt-get install libgl1 libopengl0"),
        (SimpleNamespace(MeshSet=object), "apt-get install libgl1 libopengl0"),  # plugins did not load
    ],
)
def test_what_is_missing_is_named(
    monkeypatch: pytest.MonkeyPatch, found: SimpleNamespace | ImportError, advice: str
) -> None:
    monkeypatch.delitem(sys.modules, "pymeshlab", raising=False)
    monkeypatch.setattr(builtins, "__import__", importing(found))
    with pytest.raises(PrepareError, match=advice):
        mesh_lab()
