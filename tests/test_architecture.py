"""The architecture: rows of the package import only rows above them, and the tests mirror the package."""

from __future__ import annotations

import ast
from collections import Counter
from pathlib import Path

import pytest

import fabricate

PACKAGE = Path(next(iter(fabricate.__path__)))
TESTS = Path(__file__).parent

ROWS = [
    {"errors", "units", "arrays", "versions", "stopwatch", "process", "region_names", "config"},
    {"triangles"},
    {"mesh"},
    {"formats"},
    {"prepare"},
    {"duotone"},
    {"surface"},
    {"design"},
    {"solid"},
    {"checks"},
    {"picture"},
    {"output"},
    {"wishes", "dividing"},
    {"making"},
    {"pipeline"},
    {"fit_coupon"},
    {"batch"},
    {"preview"},
    {"cli", "__main__"},
]
"""From the top down. A folder's modules may import each other; so may those of the first row."""

OWNERS = {
    "manifold3d": ("solid", "checks"),
    "pymeshlab": ("prepare",),
    "pyquadriflow": ("prepare",),
    "typer": ("cli",),
    "rich": ("cli",),
    "PIL": ("formats.read_image", "picture", "output.png"),
    "viser": ("preview",),
}
"""Libraries that stay in their corner, and where that is."""

UNTESTED = {"__init__", "__main__"}
"""Modules that hold nothing to test: a docstring and names of others, or one call."""


def module_name(path: Path) -> str:
    """Return a module's name within the package: `mesh.sphere`, `errors`, `mesh.__init__`."""
    return ".".join(path.relative_to(PACKAGE).with_suffix("").parts)


MODULES = {module_name(path): path for path in sorted(PACKAGE.rglob("*.py"))}
INNER = [name for name in MODULES if name != "__init__"]


def row_of(name: str) -> int:
    top = name.split(".")[0]
    found = [number for number, row in enumerate(ROWS) if top in row]
    assert found, f"fabricate.{name} has no row: say in ROWS where it stands"
    return found[0]


def imported(source: str) -> set[str]:
    """Return the full names of all modules that a source text imports, wherever it does so."""
    names: set[str] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        if isinstance(node, ast.ImportFrom):
            assert node.level == 0, "relative imports hide the row: write the full name"
            assert node.module is not None
            whole = node.module == "fabricate"
            names |= {f"fabricate.{alias.name}" for alias in node.names} if whole else {node.module}
    return names


def forbidden(name: str, source: str) -> list[str]:
    """Return what a module imports though it must not, one sentence each."""
    wrong = []
    for found in sorted(imported(source)):
        library, _, inner = found.partition(".")
        if library == "fabricate" and inner and row_of(inner) > row_of(name):
            wrong.append(f"fabricate.{name} imports {found}, which is a row below it")
        if found == "fabricate":
            wrong.append(f"fabricate.{name} imports the whole package: name the module")
        homes = OWNERS.get(library, (name,))
        if not any(f"{name}.".startswith(f"{home}.") for home in homes):
            wrong.append(f"fabricate.{name} imports {library}, which only {' and '.join(homes)} may")
    return wrong


@pytest.mark.parametrize("name", INNER)
def test_rows_import_only_rows_above(name: str) -> None:
    assert forbidden(name, MODULES[name].read_text(encoding="utf-8")) == []


@pytest.mark.parametrize(
    ("name", "source"),
    [
        ("mesh.sphere", "from fabricate.duotone.quad_mesh import QuadMesh"),
        ("errors", "import fabricate.mesh.sphere"),
        ("surface.cut", "def f():\n    from fabricate.solid import part"),
        ("output.stl", "from fabricate import pipeline"),
        ("batch.workers", "from fabricate.cli import main"),
        ("duotone.curve", "import manifold3d"),
        ("picture.scene", "from manifold3d import Manifold"),
        ("pipeline", "import rich.progress"),
        ("batch.workers", "from typer import echo"),
        ("output.stl", "from PIL import Image"),
        ("formats.reading", "from PIL import Image"),
        ("solid.part", "import viser"),
        ("mesh.cube", "import fabricate"),
        ("formats.reading", "from fabricate.prepare.repair import repaired"),
        ("surface.cut", "def f():\n    import pymeshlab"),
    ],
)
def test_an_import_from_below_is_found(name: str, source: str) -> None:
    assert len(forbidden(name, source)) == 1


@pytest.mark.parametrize(
    ("name", "source"),
    [
        ("cli", "import typer\nfrom rich.console import Console\nfrom fabricate.batch.workers import run"),
        ("output.png", "from PIL import Image"),
        ("formats.read_image", "from PIL import Image"),
        ("prepare.wrap", "import pymeshlab\nfrom fabricate.mesh.closed import genus"),
        ("picture.preview", "from PIL import Image\nfrom fabricate.picture.scene import Scene"),
        ("checks.fit", "import manifold3d\nfrom fabricate.solid.part import Part"),
        (
            "config.keys",
            "import fabricate.errors\nfrom fabricate.config.length import Length",
        ),
        ("surface.cut", "import numpy as np\nfrom fabricate.duotone.curve import traced_arcs"),
    ],
)
def test_an_import_from_above_or_beside_is_none(name: str, source: str) -> None:
    assert forbidden(name, source) == []


def test_every_module_has_a_row() -> None:
    for name in INNER:
        row_of(name)


def test_no_two_tests_have_one_name() -> None:
    # pytest imports them by their bare names
    names = Counter(path.name for path in TESTS.rglob("test_*.py"))
    assert [name for name, count in names.items() if count > 1] == []


def test_tests_mirror_the_package() -> None:
    missing = [
        f"fabricate/{path.relative_to(PACKAGE)} has no tests/{expected.relative_to(TESTS)}"
        for path in MODULES.values()
        if path.stem not in UNTESTED
        and not (expected := TESTS / path.relative_to(PACKAGE).with_name(f"test_{path.name}")).exists()
    ]
    assert not missing, "\n" + "\n".join(missing)
