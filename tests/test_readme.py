"""The README is true: its program runs, its commands exist, its links and its table of configs are complete."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest
from typer.testing import CliRunner

from fabricate.cli import app

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text()


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", README, flags=re.DOTALL)


def fabricate_commands() -> list[list[str]]:
    lines = [part for block in blocks("sh") for line in block.splitlines() for part in line.split("&&")]
    words = [shlex.split(line, comments=True) for line in lines]
    return [each[1:] for each in words if each and each[0].endswith("/fabricate")]


def test_program_makes_the_pair(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (program,) = blocks("python")
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    exec(compile(program, "README.md", "exec"), names)  # noqa: S102
    assert {"yellow.stl", "blue.stl", "pair.3mf", "preview.png"} <= {path.name for path in tmp_path.iterdir()}
    judged = names["judged"]
    assert not [check.code for check in judged.checks if check.failed]  # type: ignore[attr-defined]


def test_program_is_ten_lines() -> None:
    (program,) = blocks("python")
    statements = [line for line in program.splitlines() if line.strip() and not line.startswith(("import", "from"))]
    assert len(statements) <= 10


def test_commands_are_known() -> None:
    commands = fabricate_commands()
    assert {words[0] for words in commands} == {"run", "coupon", "check", "inspect", "new", "schema"}
    for words in commands:
        shown = CliRunner().invoke(app, [words[0], "--help"]).output
        assert all(option in shown for option in words if option.startswith("--"))


def test_first_command_names_a_config() -> None:
    words = fabricate_commands()[0]
    assert words[0] == "run"
    assert (ROOT / words[1]).is_file()


def test_test_command_is_what_ci_runs() -> None:
    ci = (ROOT / ".ci" / "run").read_text()
    assert ".[test]" in README
    assert "--editable '.[test]'" in ci
    command = re.search(r"^.*&& .venv/bin/(pytest.*)$", README, flags=re.MULTILINE)
    assert command is not None
    assert command[1] in ci.splitlines()


def test_links_lead_somewhere() -> None:
    targets = re.findall(r"\]\(([^)]+)\)", README)
    assert targets
    assert [target for target in targets if not (ROOT / target).exists()] == []


def test_every_config_is_listed_with_its_own_words() -> None:
    for path in sorted((ROOT / "configs").rglob("*.toml")):
        sentence = path.read_text().splitlines()[0].lstrip("# ").strip()
        assert f"[`{path.stem}`]({path.relative_to(ROOT)}) | {sentence} |" in README
