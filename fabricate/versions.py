"""Versions of the programs that take part."""

from __future__ import annotations

import platform
from importlib.metadata import PackageNotFoundError, version


def installed_version(name: str) -> str:
    """Return the version of an installed distribution, or "none"."""
    try:
        return version(name)
    except PackageNotFoundError:
        return "none"


LIBRARIES = ("fabricate", "numpy", "scipy", "manifold3d", "libigl", "embreex", "lib3mf", "pymeshlab", "pyquadriflow")


def program_versions() -> dict[str, str]:
    """Return the version of each program that takes part."""
    return {"python": platform.python_version(), **{name: installed_version(name) for name in LIBRARIES}}
