"""Continuous integration and the Makefile say one thing, in one place each."""

from __future__ import annotations

import re
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest

TARGETS = ["help", "demo", "test", "lint", "format", "build", "check", "site", "bench", "clean"]


def _dry_run(repository: Path, target: str) -> str:
    """What `make target` would do, as if nothing had been made yet."""
    done = subprocess.run(
        ["make", "--always-make", "--dry-run", "--no-print-directory", target],
        cwd=repository,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_workflow_runs_what_anyone_can_run(repository: Path) -> None:
    (workflow,) = (repository / ".github" / "workflows").iterdir()
    text = workflow.read_text()
    assert re.findall(r"^\s*(?:- )?run:\s*(.*)$", text, flags=re.MULTILINE) == ["bash .ci/run"]
    assert re.findall(r'"(3\.\d+)"', text) == ["3.11", "3.13"]


def test_ci_tests_and_shows_then_looks_for_changes(repository: Path) -> None:
    script = repository / ".ci" / "run"
    lines = script.read_text().splitlines()
    assert lines[0] == "#!/usr/bin/env bash"
    assert "set -euo pipefail" in lines
    assert script.stat().st_mode & 0o111
    order = [
        lines.index("tools=$!"),
        next(k for k, line in enumerate(lines) if line.startswith("make lint")),
        next(k for k, line in enumerate(lines) if line.startswith("make .venv-newest/.installed-core ")),
        next(k for k, line in enumerate(lines) if line.startswith('wait "$tools" || {')),
        lines.index('hidden="$(.ci/hide "$scratch/bin")"'),
        next(k for k, line in enumerate(lines) if line.startswith('wait "$lint" || {')),
        next(k for k, line in enumerate(lines) if 'PATH="$hidden" make test' in line),
        next(k for k, line in enumerate(lines) if line.startswith('wait "$install" || {')),
        lines.index("    make demo"),
        next(k for k, line in enumerate(lines) if line.startswith("    make site ")),
        lines.index("make test"),
        next(k for k, line in enumerate(lines) if line.startswith('wait "$demo" || {')),
        lines.index('changes="$(git status --porcelain)"'),
    ]
    assert order == sorted(order)
    assert subprocess.run(["bash", "-n", script], check=False).returncode == 0


@pytest.mark.parametrize("target", TARGETS)
def test_the_makefile_has_the_target(repository: Path, target: str) -> None:
    _dry_run(repository, target)


def test_make_help_lists_every_target(repository: Path) -> None:
    done = subprocess.run(
        ["make", "--no-print-directory"], cwd=repository, capture_output=True, text=True, check=True
    )
    assert sorted(re.findall(r"^make (\w+)", done.stdout, flags=re.MULTILINE)) == sorted(TARGETS)


def test_make_test_wants_no_style_or_type_checker(repository: Path) -> None:
    steps = _dry_run(repository, "test")
    for step in ("-m pytest", "tmm-gen build --check"):
        assert step in steps, step
    for other in ("ruff", "mypy", "[lint]"):
        assert other not in steps, other


def test_make_lint_pins_its_tools(repository: Path) -> None:
    steps = _dry_run(repository, "lint")
    for step in ("ruff check", "ruff format --check", "bin/mypy", "[lint]"):
        assert step in steps, step
    extras = tomllib.loads((repository / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    pinned = {requirement.partition("==")[0] for requirement in extras["lint"] if "==" in requirement}
    assert {"mypy", "numpy", "ruff"} <= pinned


def test_hiding_leaves_python_make_and_gcc(
    repository: Path, optional_tools: dict[str, str], tmp_path: Path
) -> None:
    """What continuous integration takes for a stranger's machine has what the README asks for, and nothing optional."""
    hide = [str(repository / ".ci" / "hide"), str(tmp_path / "bin")]
    done = subprocess.run(hide, capture_output=True, text=True, check=True)
    path = done.stdout.strip()
    for program in ("python3", "make", "gcc", "git", "ld"):
        assert shutil.which(program, path=path) or not shutil.which(program), program
    for program in (*optional_tools, "clang++", "valgrind", "arm-none-eabi-size"):
        assert shutil.which(program, path=path) is None, program


def test_make_demo_needs_no_test_tools(repository: Path) -> None:
    steps = _dry_run(repository, "demo")
    assert "tmm-gen demo --out out/demo" in steps
    assert "[test]" not in steps
