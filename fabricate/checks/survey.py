"""Surveys of parts: what is looked for all over one part, and takes longest; beside other work if it takes long.

All processes see the same numbers and run the same code, so it changes nothing which of them does it.
"""

from __future__ import annotations

import multiprocessing
import os
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple, TypeAlias

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.checks.walls import Walls, walls
from fabricate.solid.part import Part
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.normals import area_vectors
from fabricate.triangles.search_tree import SearchTree

WORTHWHILE = 300_000
"""Triangles of all parts from which on other processes are done sooner, although they take a second to begin."""

PACKAGE = Path(__file__).parents[1]

WORK = """
import sys
from pathlib import Path
from fabricate.checks.survey import write_surveys
write_surveys(Path(sys.argv[1]), map(int, sys.argv[2:]))
"""


class Survey(NamedTuple):
    """Pairs of a part's triangles that cross, (k, 2) int, and its walls."""

    crossing: Indices
    walls: Walls


Awaited: TypeAlias = Callable[[], "list[Survey] | None"]
"""Waits for the surveys of all parts; None where they have to be made here."""


def surveyed(part: Part, tree: SearchTree, vectors: Floats) -> Survey:
    """Return the survey of a part, with its tree and its area vectors, (m, 3) mm2."""
    return Survey(crossing_triangles(part.points, part.triangles), walls(part, tree, vectors))


@contextmanager
def surveys_beside(parts: Sequence[Part]) -> Iterator[Awaited]:
    """Begin to survey parts in processes beside this one, if that is worthwhile, and yield what waits for them."""
    spare = _idle_processors()
    if not spare or sum(len(part.triangles) for part in parts) < WORTHWHILE:
        yield lambda: None
        return
    with TemporaryDirectory(prefix="fabricate-") as name:
        folder = Path(name)
        children = _all_begun(folder, parts, spare)
        try:
            yield lambda: _ended(children, folder, len(parts))
        finally:
            _stop(children)


def _idle_processors() -> int:
    """Return how many processors nobody needs: on busy ones another process only makes more work.

    A worker of a batch counts none: its neighbours begin and end at other times.
    """
    if multiprocessing.parent_process() is not None or not hasattr(os, "getloadavg"):
        return 0
    busy = max(1.0, os.getloadavg()[0])
    return max(0, round((os.cpu_count() or 1) - busy))


def write_surveys(folder: Path, numbers: Iterable[int]) -> None:
    """Survey some of the parts in a folder, and write what was found beside them: another process's work."""
    for number in numbers:
        with np.load(_given(folder, number)) as given:
            part = Part(str(number), given["points"], given["triangles"])
        tree = SearchTree.of(part.points, part.triangles)
        crossing, found = surveyed(part, tree, area_vectors(part.points, part.triangles))
        np.savez(_found(folder, number), crossing=crossing, **vars(found))


def _all_begun(folder: Path, parts: Sequence[Part], spare: int) -> list[subprocess.Popen[bytes]]:
    """Start as many processes as there are spare processors or parts; none where there is no room for all of them."""
    children: list[subprocess.Popen[bytes]] = []
    try:
        for number, part in enumerate(parts):
            np.savez(_given(folder, number), points=part.points, triangles=part.triangles)
        children.extend(_begun(folder, range(first, len(parts), spare)) for first in range(min(spare, len(parts))))
    except OSError:
        _stop(children)
        return []
    return children


def _begun(folder: Path, numbers: Iterable[int]) -> subprocess.Popen[bytes]:
    """Start a process that surveys these parts.

    It begins afresh and knows nothing of the program that runs here, so that needs no guard against being run twice.
    """
    path = os.pathsep.join(filter(None, [str(PACKAGE.parent), os.environ.get("PYTHONPATH")]))
    return subprocess.Popen(  # noqa: S603 - nothing but our own function and numbers
        [sys.executable, "-P", "-c", WORK, str(folder), *map(str, numbers)],
        env={**os.environ, "PYTHONPATH": path},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )


def _ended(children: Sequence[subprocess.Popen[bytes]], folder: Path, count: int) -> list[Survey] | None:
    """Wait for the other processes, and return what they have found; None where one came to nothing."""
    if not children or any(child.wait() != 0 for child in children):
        return None
    surveys = []
    for number in range(count):
        with np.load(_found(folder, number)) as found:
            measured = Walls(*(found[name] for name in ("thickness", "places", "areas", "faces")))
            surveys.append(Survey(found["crossing"], measured))
    return surveys


def _stop(children: Sequence[subprocess.Popen[bytes]]) -> None:
    for child in children:
        child.kill()
        child.wait()


def _given(folder: Path, number: int) -> Path:
    return folder / f"part-{number}.npz"


def _found(folder: Path, number: int) -> Path:
    return folder / f"survey-{number}.npz"
