"""Several runs, one after the other or side by side in worker processes; a bad config stops only itself."""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from functools import partial
from multiprocessing.context import SpawnContext
from pathlib import Path
from queue import Queue
from typing import Protocol, TypeAlias

from fabricate.checks.report import Report
from fabricate.config import load_config
from fabricate.errors import FabricateError
from fabricate.pipeline import run
from fabricate.prepare.store import NOTHING_KEPT, Store

_POLL_SECONDS = 0.1
_OUT_OF_MEMORY = "not enough memory for parts this fine: raise pattern.tile_size or solid.tolerance"
_Stages: TypeAlias = Queue[tuple[str, str]]


@dataclass(frozen=True)
class _Order:
    """What one run is asked; goes to a worker process as it is."""

    path: Path
    out: Path
    overrides: tuple[str, ...]
    store: Store

    @property
    def name(self) -> str:
        return self.path.stem or str(self.path)


@dataclass(frozen=True)
class Outcome:
    """How one run ended.

    Attributes
    ----------
    name : str
        The config's stem, which is also the folder's name.
    status : {0, 1, 2}
        0: made, and every check passed; 1: made, but a check failed; 2: not made.
    message : str
        "ok" and what was skipped, the sentences of the failed checks, or why nothing was made; one line.
    made : tuple of (str, bool)
        Names of the folders that it has made, and whether every check passed.
    """

    name: str
    status: int
    message: str
    made: tuple[tuple[str, bool], ...] = ()


class Listener(Protocol):
    """Hears how runs get on; called from the thread and process that called `run_all`."""

    def stage(self, name: str, stage: str) -> None:
        """Hear that a run begins a stage."""

    def finished(self, outcome: Outcome) -> None:
        """Hear that a run has ended."""


def run_all(
    paths: Sequence[Path],
    *,
    out: Path,
    overrides: Sequence[str],
    jobs: int,
    listener: Listener,
    store: Store = NOTHING_KEPT,
) -> tuple[Outcome, ...]:
    """Make the parts of every config and return the outcomes in the same order.

    Parameters
    ----------
    paths : sequence of Path
        Config files. Of two with the same stem the later one is refused: both would write one folder.
    out : Path
        Folder that gets one folder per config.
    overrides : sequence of str
        Settings such as "solid.thickness=2mm" for every config.
    jobs : int
        How many runs at the same time, each in a process of its own; 1 stays in this process.
    listener : Listener
        Hears of stages and outcomes as they happen.
    store : Store
        Keeps what takes long to prepare.

    Raises
    ------
    Exception
        Whatever a run raises that no user can cause, with a note that names its config; runs that have not
        begun by then are left out.
    """
    orders = [_Order(path, out, tuple(overrides), store) for path in paths]
    outcomes = _refused(orders)
    for outcome in outcomes.values():
        listener.finished(outcome)
    accepted = {index: order for index, order in enumerate(orders) if index not in outcomes}
    workers = min(jobs, len(accepted))
    outcomes |= _side_by_side(accepted, workers, listener) if workers > 1 else _one_by_one(accepted, listener)
    return tuple(outcomes[index] for index in range(len(orders)))


def _refused(orders: Sequence[_Order]) -> dict[int, Outcome]:
    """Return an outcome for each order that would overwrite the results of an earlier one."""
    earlier: dict[str, _Order] = {}
    refused = {}
    for index, order in enumerate(orders):
        first = earlier.setdefault(order.name, order)
        if first is not order:
            message = f"{order.path}: would overwrite the results of {first.path}: rename one of them"
            refused[index] = Outcome(order.name, 2, message)
    return refused


def _one_by_one(orders: Mapping[int, _Order], listener: Listener) -> dict[int, Outcome]:
    outcomes = {}
    for index, order in orders.items():
        outcomes[index] = _made(order, partial(listener.stage, order.name))
        listener.finished(outcomes[index])
    return outcomes


def _side_by_side(orders: Mapping[int, _Order], workers: int, listener: Listener) -> dict[int, Outcome]:
    context = multiprocessing.get_context("spawn")
    with context.Manager() as manager:
        stages = manager.Queue()
        outcomes = _pooled(orders, workers, context, stages, listener)
        # A worker that is killed takes the pool with it. Each run that is left gets a pool of its own, so
        # that only the one that brings its worker down is lost.
        for index in sorted(orders.keys() - outcomes.keys()):
            alone = _pooled({index: orders[index]}, 1, context, stages, listener)
            outcomes[index] = alone.get(index) or _lost(orders[index], listener)
    return outcomes


def _pooled(
    orders: Mapping[int, _Order], workers: int, context: SpawnContext, stages: _Stages, listener: Listener
) -> dict[int, Outcome]:
    """Return the outcomes of all runs that ended; those cut off by the death of a worker are missing."""
    outcomes: dict[int, Outcome] = {}
    # An idle worker should end silently on Ctrl-C.
    quiet = (signal.SIGINT, signal.SIG_DFL)
    pool = ProcessPoolExecutor(workers, mp_context=context, initializer=signal.signal, initargs=quiet)
    try:
        indices = {pool.submit(_made_in_worker, order, stages): index for index, order in orders.items()}
        for future in _as_ended(indices, stages, listener):
            if not isinstance(future.exception(), BrokenProcessPool):
                outcomes[indices[future]] = future.result()
                listener.finished(future.result())
    finally:
        pool.shutdown(cancel_futures=True)
    return outcomes


def _as_ended(futures: Iterable[Future[Outcome]], stages: _Stages, listener: Listener) -> Iterator[Future[Outcome]]:
    """Yield futures as they end, and meanwhile tell the listener of the stages that workers begin."""
    pending = set(futures)
    while pending:
        ended, pending = wait(pending, timeout=_POLL_SECONDS, return_when=FIRST_COMPLETED)
        while not stages.empty():
            listener.stage(*stages.get())
        yield from ended


def _made_in_worker(order: _Order, stages: _Stages) -> Outcome:
    signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        return _made(order, lambda stage: stages.put((order.name, stage)))
    except KeyboardInterrupt:
        os._exit(130)  # the run has tidied up; the pool would hand this worker the next one
    finally:
        signal.signal(signal.SIGINT, signal.SIG_DFL)


def _made(order: _Order, progress: Callable[[str], None]) -> Outcome:
    try:
        config = load_config(order.path, order.overrides)
        reports = run(config, name=order.name, out=order.out, progress=progress, store=order.store)
    except FabricateError as error:
        return Outcome(order.name, 2, str(error))
    except MemoryError:
        return Outcome(order.name, 2, _OUT_OF_MEMORY)
    except Exception as error:
        error.add_note(f"while making {order.path}")
        raise
    status = 0 if all(report.ok for report in reports) else 1
    return Outcome(order.name, status, _verdicts(reports), tuple((report.name, report.ok) for report in reports))


def _verdicts(reports: Sequence[Report]) -> str:
    if len(reports) == 1:
        return _verdict(reports[0])
    return "; ".join(f"{report.name}: {_verdict(report)}" for report in reports)


def _verdict(report: Report) -> str:
    failed = [check.message for check in report.checks if not check.ok and not check.skipped]
    skipped = [check.message for check in report.checks if check.skipped]
    if report.ok:
        failed = ["ok, but skipped: " + "; ".join(skipped) if skipped else "ok"]
    return "; ".join([*(failed or skipped), *(f"note: {note}" for note in report.notes)])


def _lost(order: _Order, listener: Listener) -> Outcome:
    outcome = Outcome(order.name, 2, "the run was killed before it ended: out of memory?")
    listener.finished(outcome)
    return outcome
