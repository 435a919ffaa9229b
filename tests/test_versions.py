from __future__ import annotations

import numpy as np

from fabricate.versions import installed_version


def test_what_is_installed_has_its_version() -> None:
    assert installed_version("numpy") == np.__version__


def test_what_is_not_has_none() -> None:
    assert installed_version("no-such-distribution") == "none"
