"""Many runs: each ends with its own outcome, in order, whatever becomes of the others."""

import multiprocessing
import os
import signal
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from fabricate.batch import workers
from fabricate.batch.workers import Outcome, run_all
from fabricate.config import Config
from fabricate.errors import MeshError
from fabricate.prepare.store import Store


@dataclass(frozen=True)
class FakeCheck:
    ok: bool
    message: str
    skipped: bool = False


@dataclass(frozen=True)
class FakeReport:
    ok: bool = True
    checks: tuple[FakeCheck, ...] = ()
    name: str = "a"
    notes: tuple[str, ...] = ()


@dataclass
class Log:
    """A listener that writes down what it hears."""

    stages: list[tuple[str, str]] = field(default_factory=list)
    outcomes: list[Outcome] = field(default_factory=list)

    def stage(self, name: str, stage: str) -> None:
        self.stages.append((name, stage))

    def finished(self, outcome: Outcome) -> None:
        self.outcomes.append(outcome)


class DeadlyPath(type(Path())):  # type: ignore[misc]
    """A path that kills the worker process which reads it."""

    def read_bytes(self) -> bytes:
        if multiprocessing.parent_process() is not None:
            os.kill(os.getpid(), signal.SIGKILL)
        return b""


class BrokenPath(type(Path())):  # type: ignore[misc]
    """A path that nobody foresaw."""

    def read_bytes(self) -> bytes:
        raise ZeroDivisionError("nobody foresaw this")


@pytest.fixture
def config(tmp_path: Path) -> Callable[..., Path]:
    def write(name: str, text: str = '[source]\nshape = "cube"\n') -> Path:
        path = tmp_path / f"{name}.toml"
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
        return path

    return write


def use(monkeypatch: pytest.MonkeyPatch, run: Callable[..., tuple[FakeReport, ...]]) -> None:
    monkeypatch.setattr(workers, "run", run)


def outcome_of(path: Path, monkeypatch: pytest.MonkeyPatch, report: FakeReport) -> Outcome:
    use(monkeypatch, lambda *_, **__: (report,))
    (outcome,) = run_all([path], out=Path("out"), overrides=(), jobs=1, listener=Log())
    return outcome


def test_a_run_gets_its_config_name_folder_and_listener(
    config: Callable[..., Path], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    seen = []

    def run(
        config: Config, *, name: str, out: Path, progress: Callable[[str], None], store: Store
    ) -> tuple[FakeReport, ...]:
        progress("read")
        progress("checks")
        seen.append((config.pattern.seed, name, out, store))
        return (FakeReport(),)

    use(monkeypatch, run)
    log = Log()
    outcomes = run_all(
        [config("a")], out=tmp_path, overrides=["pattern.seed=5"], jobs=1, listener=log, store=Store(tmp_path)
    )
    assert seen == [(5, "a", tmp_path, Store(tmp_path))]
    assert log.stages == [("a", "read"), ("a", "checks")]
    assert outcomes == (Outcome("a", 0, "ok", (("a", True),)),) == tuple(log.outcomes)


def test_notes_are_told_whatever_the_checks_say(config: Callable[..., Path], monkeypatch: pytest.MonkeyPatch) -> None:
    good = FakeReport(notes=("tiles are uneven", "the genus changed"))
    assert outcome_of(config("a"), monkeypatch, good).message == "ok; note: tiles are uneven; note: the genus changed"
    bad = FakeReport(False, (FakeCheck(False, message="overlap"),), notes=("tiles are uneven",))
    assert outcome_of(config("a"), monkeypatch, bad).message == "overlap; note: tiles are uneven"


def test_failed_checks_are_told_and_passed_ones_are_not(
    config: Callable[..., Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    checks = (FakeCheck(True, "closed"), FakeCheck(False, "overlap"), FakeCheck(False, "gap too small"))
    outcome = outcome_of(config("a"), monkeypatch, FakeReport(False, checks))
    assert outcome == Outcome("a", 1, "overlap; gap too small", (("a", False),))


def test_a_skipped_check_is_not_a_passed_one(config: Callable[..., Path], monkeypatch: pytest.MonkeyPatch) -> None:
    skipped = FakeCheck(False, "no slicer", skipped=True)
    passed = outcome_of(config("a"), monkeypatch, FakeReport(True, (skipped,)))
    assert passed == Outcome("a", 0, "ok, but skipped: no slicer", (("a", True),))
    assert outcome_of(config("a"), monkeypatch, FakeReport(False, (skipped,))) == Outcome(
        "a", 1, "no slicer", (("a", False),)
    )


@pytest.mark.parametrize("jobs", [1, 4])
def test_a_bad_config_does_not_stop_the_others(
    config: Callable[..., Path], monkeypatch: pytest.MonkeyPatch, jobs: int
) -> None:
    use(monkeypatch, lambda *_, **__: (FakeReport(),))
    good, missing = config("good"), Path("none.toml")
    paths = [missing, good] if jobs == 1 else [config("dup/good"), good]  # one that is left runs right here
    outcomes = run_all(paths, out=Path("out"), overrides=(), jobs=jobs, listener=Log())
    assert sorted(outcome.status for outcome in outcomes) == [0, 2]


def test_a_mesh_that_cannot_be_used_is_an_outcome(config: Callable[..., Path], monkeypatch: pytest.MonkeyPatch) -> None:
    def run(*_: object, **__: object) -> tuple[FakeReport, ...]:
        raise MeshError("open boundary of 4 edges")

    use(monkeypatch, run)
    outcomes = run_all([config("a"), config("b")], out=Path("out"), overrides=(), jobs=1, listener=Log())
    assert outcomes == tuple(Outcome(name, 2, "open boundary of 4 edges") for name in "ab")


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_mistake_in_the_program_is_not_hidden_and_names_its_config(
    config: Callable[..., Path], tmp_path: Path, jobs: int
) -> None:
    broken = BrokenPath(tmp_path / "broken.toml")
    with pytest.raises(ZeroDivisionError, match="nobody foresaw this") as caught:
        run_all([broken, config("a", "[")], out=Path("out"), overrides=(), jobs=jobs, listener=Log())
    assert caught.value.__notes__ == [f"while making {broken}"]


def test_parts_too_fine_for_the_memory_are_an_outcome(
    config: Callable[..., Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    def run(*_: object, **__: object) -> tuple[FakeReport, ...]:
        raise MemoryError

    use(monkeypatch, run)
    outcomes = run_all([config("a"), config("b")], out=Path("out"), overrides=(), jobs=1, listener=Log())
    assert [outcome.status for outcome in outcomes] == [2, 2]
    assert "raise pattern.tile_size" in outcomes[0].message


def test_two_configs_with_one_name_do_not_overwrite_each_other(
    config: Callable[..., Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    names = []
    use(monkeypatch, lambda *_, name, **__: names.append(name) or (FakeReport(),))
    paths = [config("one/a"), config("b"), config("two/a"), config("b")]
    outcomes = run_all(paths, out=Path("out"), overrides=(), jobs=1, listener=Log())
    assert names == ["a", "b"]
    assert [outcome.status for outcome in outcomes] == [0, 0, 2, 2]
    assert str(paths[0]) in outcomes[2].message
    assert str(paths[2]) in outcomes[2].message


def test_worker_processes_answer_in_the_order_asked(config: Callable[..., Path], tmp_path: Path) -> None:
    texts = {"a": "[source", "b": '[source]\nshape = "tors"', "c": "", "d": '[source]\nsize = "1 mm"'}
    paths = [config(name, text) for name, text in texts.items()]
    log = Log()
    side_by_side = run_all(paths, out=tmp_path / "out", overrides=(), jobs=2, listener=log)
    assert side_by_side == run_all(paths, out=tmp_path / "out", overrides=(), jobs=1, listener=Log())
    assert [outcome.name for outcome in side_by_side] == list("abcd")
    assert all(outcome.status == 2 for outcome in side_by_side)
    assert sorted(log.outcomes, key=lambda outcome: outcome.name) == list(side_by_side)
    assert not (tmp_path / "out").exists()


def test_a_run_that_is_killed_takes_no_other_with_it(config: Callable[..., Path], tmp_path: Path) -> None:
    paths = [config("a", "["), DeadlyPath(tmp_path / "deadly.toml"), config("b", "["), config("c", "[")]
    log = Log()
    outcomes = run_all(paths, out=tmp_path / "out", overrides=(), jobs=2, listener=log)
    assert [outcome.name for outcome in outcomes] == ["a", "deadly", "b", "c"]
    assert ["the run was killed" in outcome.message for outcome in outcomes] == [False, True, False, False]
    assert len(log.outcomes) == len(outcomes)


def test_several_bodies_are_told_by_name(config: Callable[..., Path], monkeypatch: pytest.MonkeyPatch) -> None:
    bad = FakeReport(False, (FakeCheck(ok=False, message="too thin"),), name="a-2")
    use(monkeypatch, lambda *_, **__: (FakeReport(name="a-1"), bad))
    (outcome,) = run_all([config("a")], out=Path("out"), overrides=(), jobs=1, listener=Log())
    assert outcome == Outcome("a", 1, "a-1: ok; a-2: too thin", (("a-1", True), ("a-2", False)))
