"""How long each stage took."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter


class Stopwatch:
    """Tells of each stage as it begins, and how long each one took."""

    def __init__(self, progress: Callable[[str], None]) -> None:
        self._progress = progress
        self._began: list[tuple[str, float]] = []

    def begin(self, stage: str) -> None:
        """Tell of a stage that begins now."""
        self._began.append((stage, perf_counter()))
        self._progress(stage)

    def tell(self, step: str) -> None:
        """Tell of a step within a stage."""
        self._progress(step)

    def copy(self) -> Stopwatch:
        """Return another watch that has run as long."""
        other = Stopwatch(self._progress)
        other._began = list(self._began)
        return other

    def ended(self) -> dict[str, float]:
        """Return the seconds of every stage, the last one ending now."""
        ends = [time for _, time in self._began[1:]] + [perf_counter()]
        return {stage: end - start for (stage, start), end in zip(self._began, ends, strict=True)}
