"""The command line: exit statuses, where each line goes, and never a traceback for what a user can cause."""

import json
import re
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import pytest
from PIL import Image
from rich.console import Console

from fabricate import cli
from fabricate.batch import workers
from fabricate.cli import main
from fabricate.config import load_config
from fabricate.errors import MeshError, OutputError, ReadError


@dataclass(frozen=True)
class FakeCheck:
    code: str = "gap"
    ok: bool = True
    skipped: bool = False
    message: str = "gap is 0.31 mm"
    where: tuple[tuple[float, float, float], ...] = ()


@dataclass(frozen=True)
class FakeReport:
    ok: bool = True
    checks: tuple[FakeCheck, ...] = ()
    notes: tuple[str, ...] = ()
    name: str = "good"


FAILED = FakeReport(False, (FakeCheck(ok=False, message="gap is 0.1 mm", where=((1.0, 2.0, 3.5), (0.0, 0.0, 0.0))),))


@dataclass(frozen=True)
class Said:
    status: int
    out: str
    err: str


Call = Callable[..., Said]


@pytest.fixture
def call(capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Call:
    """Call the command line in an empty folder with a good config `good.toml`."""
    monkeypatch.chdir(tmp_path)
    Path("good.toml").write_text('[source]\nshape = "cube"\n')

    def _call(*arguments: str) -> Said:
        with pytest.raises(SystemExit) as caught:
            main(arguments)
        captured = capsys.readouterr()
        assert "Traceback" not in captured.out + captured.err
        return Said(int(caught.value.code or 0), captured.out, captured.err)

    return _call


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[dict[str, object]]:
    """Let every run pass without making anything; returns what the runs were asked."""
    asked: list[dict[str, object]] = []

    def run(config: object, **options: object) -> tuple[FakeReport, ...]:
        asked.append({"config": config, **options})
        return (FakeReport(),)

    monkeypatch.setattr(workers, "run", run)
    return asked


def fail(error: BaseException) -> Callable[..., FakeReport]:
    def run(*_: object, **__: object) -> tuple[FakeReport, ...]:
        raise error

    return run


def test_a_good_run_says_one_line_and_where_it_is(call: Call, made: list[dict[str, object]]) -> None:
    said = call("run", "good.toml")
    assert (said.status, said.out, said.err) == (0, f"good: ok -> {Path('outputs/good')}\n", "")
    assert made[0]["out"] == Path("outputs")


def test_options_reach_the_run(call: Call, made: list[dict[str, object]]) -> None:
    call("run", "good.toml", "--out", "there", "--set", "pattern.seed=4", "--set", "solid.thickness=1mm")
    config = made[0]["config"]
    assert (made[0]["out"], config.pattern.seed, config.solid.thickness) == (Path("there"), 4, 1.0)


def test_a_failed_check_is_status_1_and_says_which(call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(workers, "run", lambda *_, **__: (FAILED,))
    said = call("run", "good.toml")
    assert (said.status, said.err) == (1, "")
    assert said.out == f"good: FAILED: gap is 0.1 mm -> {Path('outputs/good')}\n"


@pytest.mark.parametrize(
    "arguments",
    [
        ("none.toml",),
        (".",),
        ("good.toml", "--set", "solid.thicknes=2mm"),
        ("good.toml", "--set", "solid.thickness"),
    ],
)
def test_a_wrong_config_is_status_2_and_one_line(
    call: Call, made: list[dict[str, object]], arguments: tuple[str, ...]
) -> None:
    said = call("run", *arguments)
    assert (said.status, said.out, made) == (2, "", [])
    assert said.err.count("\n") == 1
    assert not Path("outputs").exists()


@pytest.mark.parametrize("error", [MeshError("4 open edges"), ReadError("not a mesh"), OutputError("disk full")])
def test_whatever_a_run_raises_on_purpose_is_one_line(
    call: Call, monkeypatch: pytest.MonkeyPatch, error: Exception
) -> None:
    monkeypatch.setattr(workers, "run", fail(error))
    said = call("run", "good.toml")
    assert (said.status, said.out, said.err) == (2, "", f"good: {error}\n")


def test_several_configs_make_a_contact_sheet(call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    def run(_: object, *, name: str, out: Path, **__: object) -> tuple[FakeReport, ...]:
        (out / name).mkdir(parents=True)
        Image.new("RGB", (60, 30)).save(out / name / "preview.png")
        return (FakeReport(name=name),)

    monkeypatch.setattr(workers, "run", run)
    Path("better.toml").write_text('[source]\nshape = "torus"\n')
    said = call("run", "good.toml", "better.toml")
    sheet = Path("outputs/contact-sheet.png")
    assert (said.status, said.err) == (0, "")
    assert said.out.splitlines()[-1] == f"contact sheet -> {sheet}"
    assert sheet.is_file()


def test_one_config_makes_no_contact_sheet(call: Call, made: list[dict[str, object]]) -> None:
    assert "contact sheet" not in call("run", "good.toml").out
    assert len(made) == 1
    assert not Path("outputs/contact-sheet.png").exists()


def test_the_worst_of_several_counts_and_all_are_made(call: Call, made: list[dict[str, object]]) -> None:
    Path("better.toml").write_text('[source]\nshape = "torus"\n')
    said = call("run", "good.toml", "none.toml", "better.toml")
    assert said.status == 2
    assert [asked["name"] for asked in made] == ["good", "better"]
    assert said.out.count("\n") == 2
    assert said.err.count("\n") == 1


def test_stages_are_shown_on_a_terminal_only(call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    def run(*_: object, progress: Callable[[str], None], **__: object) -> tuple[FakeReport, ...]:
        progress("tessellate")
        progress("thicken")
        return (FakeReport(),)

    monkeypatch.setattr(workers, "run", run)
    assert "thicken" not in call("run", "good.toml").out
    monkeypatch.setattr(cli, "Console", partial(Console, force_terminal=True, force_interactive=True))
    shown = call("run", "good.toml").out
    assert "good: thicken" in shown
    assert f"good: ok -> {Path('outputs/good')}\n" in shown


@pytest.fixture
def broken(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let every command run into a mistake of the program, with a message of two lines."""
    monkeypatch.delenv("FABRICATE_DEBUG", raising=False)
    monkeypatch.setattr(workers, "run", fail(ZeroDivisionError("float division\nby zero")))
    monkeypatch.setattr(cli, "check_parts", fail(ZeroDivisionError("float division\nby zero")))


@pytest.mark.usefixtures("broken")
@pytest.mark.parametrize(("command", "where"), [("run", ", while making good.toml"), ("check", "")])
def test_a_mistake_of_the_program_is_one_line_that_asks_for_a_report(call: Call, command: str, where: str) -> None:
    said = call(command, "good.toml")
    assert (said.status, said.out, said.err.count("\n")) == (2, "", 1)
    start = f"fabricate: internal error: ZeroDivisionError: float division by zero{where}; please report it"
    assert said.err.startswith(start)


@pytest.mark.usefixtures("broken")
def test_a_mistake_of_the_program_stops_the_batch(call: Call) -> None:
    said = call("run", "good.toml", "none.toml")
    assert said.status == 2
    assert "none" not in said.err


@pytest.mark.usefixtures("broken")
def test_the_traceback_is_there_for_who_asks(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.setenv("FABRICATE_DEBUG", "1")
    with pytest.raises(SystemExit):
        main(["check", str(tmp_path)])
    said = capsys.readouterr().err
    assert said.startswith("Traceback")
    assert "check_parts(" in said
    assert said.splitlines()[-1].startswith("fabricate: internal error: ")


@pytest.mark.parametrize("command", ["run", "check"])
def test_an_interruption_is_status_130(call: Call, monkeypatch: pytest.MonkeyPatch, command: str) -> None:
    monkeypatch.setattr(workers, "run", fail(KeyboardInterrupt()))
    monkeypatch.setattr(cli, "check_parts", fail(KeyboardInterrupt()))
    assert call(command, "good.toml").status == 130


@pytest.mark.parametrize(
    "arguments",
    [("run",), ("coupon",), ("run", "good.toml", "--jobs", "0"), ("bogus",), ("check",), ("new",), ("--bogus",)],
)
def test_wrong_usage_is_status_2(call: Call, arguments: tuple[str, ...]) -> None:
    said = call(*arguments)
    assert (said.status, said.out) == (2, "")
    assert re.fullmatch(r"fabricate: .+; see `fabricate( \w+)? --help`\n", said.err)


def test_without_arguments_help_is_shown(call: Call) -> None:
    said = call()
    assert (said.status, said.err) == (2, "")
    assert "inspect" in said.out


@pytest.mark.parametrize(
    "arguments",
    [("run", "good.toml", "--cache", "good.toml/cache"), ("check", "good.toml", "--json", "nowhere/report.json")],
)
def test_a_place_that_cannot_be_written_is_said_first(
    call: Call, made: list[object], monkeypatch: pytest.MonkeyPatch, arguments: tuple[str, ...]
) -> None:
    monkeypatch.setattr(cli, "check_parts", fail(AssertionError("nothing should have been checked")))
    said = call(*arguments)
    assert (said.status, said.out, made) == (2, "", [])
    assert said.err.startswith("fabricate: cannot ")
    assert said.err.count("\n") == 1


@dataclass(frozen=True)
class FakeNeck:
    size_mm: float = 2.0
    wanted_mm: float = 2.0


@dataclass(frozen=True)
class FakeJudged:
    checks: tuple[FakeCheck, ...] = ()
    pieces: tuple[object, ...] = ()
    neck: FakeNeck = FakeNeck()


@dataclass(frozen=True)
class FakeCoupon:
    name: str
    judged: FakeJudged = FakeJudged()
    ok: bool = True


def test_a_coupon_says_one_line_and_where_it_is(call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[dict[str, object]] = []

    def make_coupon(config: object, **options: object) -> tuple[FakeCoupon, ...]:
        asked.append({"config": config, **options})
        return (FakeCoupon("good-coupon"),)

    monkeypatch.setattr(cli, "make_coupon", make_coupon)
    said = call("coupon", "good.toml", "--out", "there", "--set", "solid.clearance=0.4mm")
    assert (said.status, said.err) == (0, "")
    assert re.fullmatch(rf"good-coupon: ok.* -> {Path('there/good-coupon')}\n", said.out)
    assert (asked[0]["name"], asked[0]["out"]) == ("good-coupon", Path("there"))
    assert asked[0]["config"].solid.clearance == 0.4


def test_a_coupon_with_a_failed_check_is_status_1_and_says_which(call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    failed = FakeCoupon("good-coupon", FakeJudged(FAILED.checks), ok=False)
    monkeypatch.setattr(cli, "make_coupon", lambda *_, **__: (failed,))
    said = call("coupon", "good.toml")
    assert (said.status, said.err) == (1, "")
    assert said.out == f"good-coupon: FAILED: gap is 0.1 mm -> {Path('outputs/good-coupon')}\n"


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (("none.toml",), "no such file"),
        (("good.toml", "--set", "solid.clearanc=1mm"), "unknown key"),
        (("good.toml", "--set", "solid.clearance=0mm"), "solid.clearance is 0 mm"),
    ],
)
def test_a_coupon_that_cannot_be_made_is_status_2_and_one_line(
    call: Call, arguments: tuple[str, ...], reason: str
) -> None:
    said = call("coupon", *arguments)
    assert (said.status, said.out, said.err.count("\n")) == (2, "", 1)
    assert reason in said.err
    assert not Path("outputs").exists()


CHECKS = (
    FakeCheck("closed", message="every edge has two triangles"),
    FakeCheck("slicer", ok=False, skipped=True, message="no slicer"),
    *FAILED.checks,
)


@pytest.mark.parametrize(("ok", "status"), [(True, 0), (False, 1)])
def test_check_prints_a_line_per_check(call: Call, monkeypatch: pytest.MonkeyPatch, ok: bool, status: int) -> None:
    monkeypatch.setattr(cli, "check_parts", lambda *_, **__: FakeReport(ok, CHECKS))
    said = call("check", "a.stl", "b.stl")
    assert said.status == status
    assert said.out.splitlines() == [
        "passed  closed: every edge has two triangles",
        "skipped slicer: no slicer",
        "FAILED  gap: gap is 0.1 mm at (1.000, 2.000, 3.500) mm",
    ]


@pytest.mark.parametrize(("option", "mm"), [((), None), (("--clearance", "0.3 mm"), 0.3)])
def test_files_and_folders_are_passed_on_as_they_are(
    call: Call, monkeypatch: pytest.MonkeyPatch, option: tuple[str, ...], mm: float | None
) -> None:
    asked = []
    monkeypatch.setattr(cli, "check_parts", lambda *args, **options: asked.append((args, options)) or FakeReport())
    assert call("check", "a.stl", "outputs/first", *option).status == 0
    assert asked == [(([Path("a.stl"), Path("outputs/first")],), {"clearance": mm})]


@pytest.mark.parametrize("clearance", ["0.3", "wide", "-1 mm"])
def test_a_wrong_clearance_is_blamed_on_the_option(call: Call, clearance: str) -> None:
    said = call("check", "a.stl", "--clearance", clearance)
    assert said.status == 2
    assert said.err.startswith("fabricate: --clearance: ")
    assert said.err.count("\n") == 1


def test_check_writes_the_report_as_json(call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cli, "check_parts", lambda *_, **__: FakeReport())
    monkeypatch.setattr(cli, "report_json", lambda report: json.dumps({"ok": report.ok}))
    assert call("check", "a.stl", "--json", "report.json").status == 0
    assert json.loads(Path("report.json").read_text()) == {"ok": True}
    assert call("check", "a.stl", "--json", "none/report.json").status == 2
    assert call("check", "a.stl", "--json", ".").status == 2


def test_parts_that_cannot_be_read_are_one_line(call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cli, "check_parts", fail(ReadError("a.stl: no such file")))
    said = call("check", "a.stl")
    assert (said.status, said.out, said.err) == (2, "", "fabricate: a.stl: no such file\n")


def test_new_writes_a_config_that_runs_and_keeps_an_old_one(call: Call, made: list[dict[str, object]]) -> None:
    said = call("new", "first")
    assert (said.status, said.out) == (0, "first.toml: written\n")
    assert load_config(Path("first.toml"))
    assert call("run", "first.toml").status == 0
    again = call("new", "first")
    assert again.status == 2
    assert "exists already" in again.err
    assert len(made) == 1


@pytest.mark.parametrize("name", ["../first", "a/b", "first.toml", ""])
def test_new_refuses_bad_names(call: Call, name: str) -> None:
    said = call("new", name)
    assert said.status == 2
    assert said.err.count("\n") == 1


def test_schema_prints_json(call: Call) -> None:
    said = call("schema")
    assert said.status == 0
    assert set(json.loads(said.out)["properties"]) == {
        "source",
        "prepare",
        "pattern",
        "curve",
        "field",
        "optimise",
        "solid",
        "process",
    }


def test_version(call: Call) -> None:
    said = call("--version")
    assert said.status == 0
    assert said.out.startswith("fabricate ")


def test_help_names_every_command(call: Call) -> None:
    said = call("--help")
    assert said.status == 0
    assert all(word in said.out for word in ("run", "coupon", "check", "new", "schema", "FABRICATE_DEBUG=1"))


def test_the_module_is_the_command(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "fabricate", "run", "none.toml"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("none: none.toml: no such file")
    assert not list(tmp_path.iterdir())
