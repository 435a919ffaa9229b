"""PyMeshLab, loaded only when it is needed, and kept from printing."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType

from fabricate.errors import PrepareError

_LIBRARIES = "PyMeshLab needs Debian's libgl1 and libopengl0: apt-get install libgl1 libopengl0"


def mesh_lab() -> ModuleType:
    """Import PyMeshLab with its filters.

    Raises
    ------
    PrepareError
        If it is not installed, or lacks libraries of the system; the message says what to install.
    """
    try:
        with silenced():
            import pymeshlab  # type: ignore[import-untyped]
    except ModuleNotFoundError:
        raise PrepareError("this repair needs PyMeshLab: pip install pymeshlab") from None
    except ImportError:
        raise PrepareError(_LIBRARIES) from None
    if not hasattr(pymeshlab.MeshSet, "generate_alpha_wrap"):  # without libopengl0 it loads, but not its plugins
        raise PrepareError(_LIBRARIES)
    module: ModuleType = pymeshlab
    return module


@contextmanager
def silenced() -> Iterator[None]:
    """Throw away what compiled code writes to standard output and standard error within the block.

    The whole process is silent meanwhile, other threads included.
    """
    sys.stdout.flush()
    sys.stderr.flush()
    kept = [os.dup(number) for number in (1, 2)]
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        for number in (1, 2):
            os.dup2(nowhere, number)
        yield
    finally:
        for number, copy in enumerate(kept, start=1):
            os.dup2(copy, number)
            os.close(copy)
        os.close(nowhere)
