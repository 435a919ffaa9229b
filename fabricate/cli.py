"""The command line: each command parses, calls one function and prints."""

from __future__ import annotations

import json
import os
import sys
import traceback
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from importlib.metadata import version
from pathlib import Path
from typing import Annotated, NoReturn

import typer
from platformdirs import user_cache_path
from rich.console import Console
from rich.progress import Progress, SpinnerColumn, TaskID, TextColumn, TimeElapsedColumn
from typer.exceptions import TyperException

from fabricate.batch.sheet import write_sheet
from fabricate.batch.workers import Listener, Outcome, run_all
from fabricate.checks.coupon_report import coupon_verdict
from fabricate.checks.report import Check, report_json
from fabricate.config import load_config
from fabricate.config.schema import json_schema
from fabricate.errors import ConfigError, FabricateError
from fabricate.fit_coupon import make_coupon
from fabricate.output.files import check_writable, write_whole
from fabricate.output.new_config import write_new_config
from fabricate.pipeline import check as check_parts
from fabricate.pipeline import inspect as inspect_mesh
from fabricate.prepare.diagnosis_text import diagnosis_data, diagnosis_text
from fabricate.prepare.store import Store, checked_store
from fabricate.units import parse_length

CACHE = user_cache_path("fabricate", appauthor=False)

app = typer.Typer(
    help="Divide a closed surface by one closed curve and make two interlocking printable solids of it.",
    epilog="Exit status: 0 all good, 1 a check failed, 2 nothing made. Set FABRICATE_DEBUG=1 to see the "
    "traceback of an internal error, and report it.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and leave with its exit status; whatever goes wrong becomes one line."""
    try:
        status = app(arguments, prog_name="fabricate", standalone_mode=False)
    except FabricateError as error:
        _leave(str(error))
    except TyperException as error:
        _leave_usage(error)
    except Exception as error:  # noqa: BLE001 - a mistake of ours; the traceback is there for who asks
        if os.environ.get("FABRICATE_DEBUG"):
            traceback.print_exception(error)
        _leave(_internal_error(error))
    sys.exit(status)


def _leave_usage(error: TyperException) -> NoReturn:
    """Say what is wrong with the way the command line was used; without any arguments, help was shown instead."""
    message, context = error.format_message().strip(), getattr(error, "ctx", None)
    if message:
        command = "fabricate" if context is None else context.command_path
        _leave(f"{message.rstrip('.')}; see `{command} --help`")
    sys.exit(2)


def _leave(message: str) -> NoReturn:
    typer.echo(f"fabricate: {message}", err=True)
    sys.exit(2)


def _internal_error(error: Exception) -> str:
    kind, text = type(error).__name__, " ".join(str(error).split())
    notes = "".join(f", {note}" for note in getattr(error, "__notes__", ()))
    return (
        f"internal error: {kind}: {text or 'no message'}{notes}; "
        "please report it with the config or files in use and with what FABRICATE_DEBUG=1 shows"
    )


def _print_version(asked: bool) -> None:
    if asked:
        typer.echo(f"fabricate {version('fabricate')}")
        raise typer.Exit


@app.callback()
def _options(
    _version: Annotated[
        bool,
        typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version and leave."),
    ] = False,
) -> None:
    pass


@app.command()
def run(
    configs: Annotated[list[Path], typer.Argument(metavar="CONFIG", help="TOML files; `fabricate new` writes one.")],
    out: Annotated[Path, typer.Option(help="Folder that gets one folder per config.")] = Path("outputs"),
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="Replace a key: solid.thickness=2mm."),
    ] = None,
    jobs: Annotated[int, typer.Option(min=1, help="How many configs at the same time.")] = 1,
    cache: Annotated[
        Path, typer.Option(envvar="FABRICATE_CACHE", help="Folder that keeps what takes long to prepare.")
    ] = CACHE,
) -> None:
    """Make the parts of each config: one folder with STL, 3MF, pictures and a report.

    Of several configs, contact-sheet.png shows all the pictures.
    """
    store = Store(cache) if cache == CACHE else checked_store(cache)
    with _listener(out) as listener:
        outcomes = run_all(configs, out=out, overrides=settings or (), jobs=jobs, listener=listener, store=store)
    sheet = write_sheet(outcomes, out) if len(outcomes) > 1 else None
    if sheet is not None:
        typer.echo(f"contact sheet -> {sheet}")
    raise typer.Exit(max(outcome.status for outcome in outcomes))


@app.command()
def coupon(
    config: Annotated[Path, typer.Argument(metavar="CONFIG", help="TOML file of the sculpture.")],
    out: Annotated[Path, typer.Option(help="Folder that gets the folder CONFIG-coupon.")] = Path("outputs"),
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="Replace a key: solid.thickness=2mm."),
    ] = None,
    cache: Annotated[
        Path, typer.Option(envvar="FABRICATE_CACHE", help="Folder that keeps what takes long to prepare.")
    ] = CACHE,
) -> None:
    """Make a small plate to print before the sculpture: pieces of its own joint at five clearances."""
    store = Store(cache) if cache == CACHE else checked_store(cache)
    name = f"{config.stem}-coupon"
    with _listener(out) as listener:
        reports = make_coupon(
            load_config(config, settings or ()),
            name=name,
            out=out,
            progress=partial(listener.stage, name),
            store=store,
        )
        outcomes = [Outcome(report.name, 0 if report.ok else 1, coupon_verdict(report)) for report in reports]
        for outcome in outcomes:
            listener.finished(outcome)
    raise typer.Exit(max(outcome.status for outcome in outcomes))


@app.command()
def check(
    paths: Annotated[list[Path], typer.Argument(metavar="DIR|STL", help="A folder that `run` made, or STL files.")],
    json_file: Annotated[
        Path | None,
        typer.Option("--json", metavar="FILE", dir_okay=False, help="Write the report here as well."),
    ] = None,
    clearance: Annotated[
        str | None, typer.Option(metavar="LENGTH", help='Gap that the parts should keep, such as "0.3 mm".')
    ] = None,
) -> None:
    """Read parts back from their files and judge them."""
    if json_file is not None:
        check_writable(json_file)
    report = check_parts(paths, clearance=None if clearance is None else _clearance(clearance))
    for each in report.checks:
        typer.echo(_check_line(each))
    if json_file is not None:
        write_whole(json_file, report_json(report).encode())
    raise typer.Exit(0 if report.ok else 1)


@app.command()
def inspect(
    path: Annotated[Path, typer.Argument(metavar="FILE", help="A mesh: OBJ, OFF, PLY, STL, 3MF or GLB.")],
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON instead of lines.")] = False,
) -> None:
    """Say what a mesh is, what is wrong with it, and what `run` would do about it."""
    found = inspect_mesh(path)
    if as_json:
        content = {**diagnosis_data(found.diagnosis), "usable": found.usable, "plan": found.plan}
        typer.echo(json.dumps(content, indent=2))
    else:
        typer.echo("\n".join([diagnosis_text(found.diagnosis), *found.plan]))
    raise typer.Exit(0 if found.usable else 1)


@app.command()
def new(
    name: Annotated[str, typer.Argument(help="Name of the sculpture; the file becomes NAME.toml.")],
) -> None:
    """Write a commented config to start from."""
    typer.echo(f"{write_new_config(name, Path())}: written")


@app.command()
def schema() -> None:
    """Print the JSON schema of configs, for editors."""
    typer.echo(json.dumps(json_schema(), indent=2))


class _SummaryLines:
    """Says one line per config when it has ended: for logs."""

    def __init__(self, out: Path) -> None:
        self._out = out

    def stage(self, name: str, stage: str) -> None:
        pass

    def finished(self, outcome: Outcome) -> None:
        if outcome.status == 2:
            typer.echo(f"{outcome.name}: {outcome.message}", err=True)
        else:
            verdict = "FAILED: " if outcome.status else ""
            typer.echo(f"{outcome.name}: {verdict}{outcome.message} -> {self._out / outcome.name}")


class _ProgressLines:
    """Shows a line per stage while a config is in the making, and its summary line afterwards."""

    def __init__(self, summary: _SummaryLines, progress: Progress) -> None:
        self._summary = summary
        self._progress = progress
        self._lines: dict[str, list[TaskID]] = {}

    def stage(self, name: str, stage: str) -> None:
        lines = self._lines.setdefault(name, [])
        for line in lines[-1:]:
            self._progress.update(line, total=1, completed=1)
        lines.append(self._progress.add_task(f"{name}: {stage}", total=None))

    def finished(self, outcome: Outcome) -> None:
        for line in self._lines.pop(outcome.name, []):
            self._progress.remove_task(line)
        self._progress.stop()
        self._summary.finished(outcome)
        self._progress.start()


@contextmanager
def _listener(out: Path) -> Iterator[Listener]:
    """Show progress on a terminal, and only summary lines where nobody watches."""
    console, summary = Console(), _SummaryLines(out)
    if not console.is_interactive:
        yield summary
        return
    columns = (SpinnerColumn("line"), TextColumn("{task.description}", markup=False), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True) as progress:
        yield _ProgressLines(summary, progress)


def _check_line(check: Check) -> str:
    verdict = "skipped" if check.skipped else "passed" if check.ok else "FAILED"
    first = "".join(f" at ({x:.3f}, {y:.3f}, {z:.3f}) mm" for x, y, z in check.where[:1])
    return f"{verdict:<7} {check.code}: {check.message}{'' if ' at (' in check.message else first}"


def _clearance(text: str) -> float:
    try:
        length = parse_length(text)
    except ConfigError as error:
        raise ConfigError(f"--clearance: {error}") from None
    if length < 0:
        raise ConfigError(f'--clearance: expected at least 0 mm, found "{text}"')
    return length
