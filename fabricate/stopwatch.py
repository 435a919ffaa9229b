"""How long each stage took."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter


class Stopwatch:
    """Tells of each stage as it begins, and how long each one took."""

    def __init__(self, progress: Callable[[str], None]) -> None:
        self._progress = progress
        self._seconds: dict[str, float] = {}
        self._running: tuple[str, float] | None = None

    def begin(self, stage: str) -> None:
        """Tell of a stage that begins now, as the one before ends."""
        self.stop()
        self._running = stage, perf_counter()
        self._progress(stage)

    def tell(self, step: str) -> None:
        """Tell of a step within a stage."""
        self._progress(step)

    def stop(self) -> None:
        """End the stage that runs, if any does."""
        if self._running is not None:
            stage, began = self._running
            self._seconds[stage] = perf_counter() - began
            self._running = None

    def copy(self) -> Stopwatch:
        """Return another watch that has seen the stages that have ended."""
        other = Stopwatch(self._progress)
        other._seconds = dict(self._seconds)
        return other

    def ended(self) -> dict[str, float]:
        """Return the seconds of every stage, the last one ending now."""
        self.stop()
        return dict(self._seconds)
