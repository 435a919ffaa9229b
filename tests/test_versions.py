from __future__ import annotations

import numpy as np

from fabricate.versions import LIBRARIES, installed_version, program_versions


def test_what_is_installed_has_its_version() -> None:
    assert installed_version("numpy") == np.__version__


def test_what_is_not_has_none() -> None:
    assert installed_version("no-such-distribution") == "none"


def test_every_program_that_takes_part_has_a_version() -> None:
    versions = program_versions()
    assert {"python", *LIBRARIES} == set(versions)
    assert "none" not in versions.values()
