"""The group of commands: quick to start, clear in what it refuses, quiet when it is cut off."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import click
import pytest

from tmm_gen import __version__, cli
from tmm_gen.cli.lazy import LazyCommand
from tmm_gen.errors import CheckFailed, UserError
from tmm_gen.scene.problem import Problem, SceneError
from tmm_gen.study.outcome import Outcome, Result
from tmm_gen.study.store import Store

Call = Callable[..., subprocess.CompletedProcess[str]]
HEAVY = {"sympy", "numpy", "scipy", "casadi", "matplotlib", "mpmath", "pydantic", "rich", "jinja2"}


@pytest.fixture
def raising(monkeypatch: pytest.MonkeyPatch) -> Callable[[BaseException], None]:
    """Give the group a command ``fail`` that raises what it is told to."""

    def give(error: BaseException) -> None:
        def body() -> None:
            raise error

        command = click.Command("fail", callback=body)
        monkeypatch.setitem(cli.tmm_gen._table, "fail", LazyCommand("nowhere:fail", "Fail."))
        monkeypatch.setattr(LazyCommand, "load", lambda self: command)

    return give


@pytest.mark.parametrize("words", [["--help"], ["--version"], ["no-such-command"], []])
def test_nothing_heavy_is_imported_to_answer(words: list[str]) -> None:
    program = (
        "import sys\nfrom tmm_gen.cli import main\n"
        f"main({words!r})\n"
        f"print('imported:', *sorted({HEAVY!r} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "imported:"


@pytest.mark.parametrize("name", cli.COMMANDS)
def test_every_command_explains_itself_without_heavy_imports(name: str) -> None:
    program = (
        "import sys\nfrom tmm_gen.cli import main\n"
        f"code = main([{name!r}, '--help'])\n"
        f"print('code:', code, 'imported:', *sorted({HEAVY - {'pydantic'}!r} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == "code: 0 imported:"
    assert f"Usage: tmm-gen {name}" in done.stdout


def test_help_lists_every_command_in_order(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["--help"]) == 0
    shown = capsys.readouterr().out.partition("Commands:")[2].splitlines()
    assert [line.split()[0] for line in shown if line[:3].strip()] == list(cli.COMMANDS)


def test_version(tmm_gen: Call) -> None:
    done = tmm_gen("--version")
    assert (done.returncode, done.stdout) == (0, f"tmm-gen {__version__}\n")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["biuld"], "did you mean build? `tmm-gen --help` shows"),
        (["zzz"], "commands are new, "),
        (["--colour"], "No such option"),
    ],
)
def test_bad_usage_is_answered_with_a_remedy(
    words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(words) == 2
    shown = capsys.readouterr()
    assert said in shown.err
    assert shown.out == ""


@pytest.mark.parametrize(
    ("error", "code", "said"),
    [
        (UserError("arm.toml:3: links: 0 is too few"), 2, "error: arm.toml:3: links: 0 is too few\n"),
        (CheckFailed("2 files differ"), 1, "error: 2 files differ\n"),
        (
            SceneError([Problem("arm.toml", 3, "links", 0, "must be at least 1", "Give one link.")]),
            2,
            "error: arm.toml:3: links: must be at least 1 (got 0). Give one link.\n",
        ),
        (PermissionError(13, "Permission denied", "/a/b"), 2, "error: /a/b: Permission denied\n"),
        (click.FileError("x.toml", "no such file"), 2, "error: Could not open file 'x.toml': no such file\n"),
        (KeyboardInterrupt(), 130, "error: interrupted\n"),
        (BrokenPipeError(32, "Broken pipe"), 141, ""),
        (OSError(28, "No space left on device"), 2, "error: standard output: No space left on device\n"),
        (click.exceptions.Exit(1), 1, ""),
    ],
    ids=lambda value: type(value).__name__ if isinstance(value, BaseException) else "",
)
def test_errors_end_with_their_code(
    error: BaseException,
    code: int,
    said: str,
    raising: Callable[[BaseException], None],
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    raising(error)
    monkeypatch.setattr(os, "dup2", lambda *_: None)  # the test's own standard output stays open
    assert cli.main(["fail"]) == code
    assert capsys.readouterr().err == said


def test_an_interrupted_study_says_what_is_kept(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(cli, "_invoke", lambda _: (_ for _ in ()).throw(KeyboardInterrupt))

    def said(*words: str) -> str:
        assert cli.main(["trade", "arm.toml", *words]) == 130
        return capsys.readouterr().err

    assert (
        said("--store", "none.sqlite") == "error: interrupted. none.sqlite was not begun: nothing is kept.\n"
    )
    assert not Path("none.sqlite").exists()
    with Store(Path("study.sqlite")) as store:
        assert "study.sqlite keeps nothing yet" in said("--store=study.sqlite")
        store.keep_reference("a", b"motion")
        assert "keeps the reference motion, but no result yet" in said("--store", "study.sqlite")
        store.keep("b", Result(Outcome.DIVERGED))
        assert "keeps 1 result: the same command goes on" in said("--store", "study.sqlite")


@pytest.mark.parametrize("defect", [ZeroDivisionError("0/0"), OSError("no file named")])
def test_a_defect_keeps_its_traceback(defect: Exception, raising: Callable[[BaseException], None]) -> None:
    raising(defect)
    with pytest.raises(type(defect)) as caught:
        cli.main(["fail"])
    assert caught.value is defect


@pytest.mark.parametrize("body", ["click.echo('x' * 200_000)", "table([{'a': 1}] * 20_000, ['a'])"])
def test_a_reader_that_has_seen_enough_ends_it_quietly(body: str) -> None:
    program = (
        "import sys, click\nfrom tmm_gen import cli\nfrom tmm_gen.cli.console import table\n"
        "from tmm_gen.cli.lazy import LazyCommand\n"
        f"command = click.Command('fail', callback=lambda: {body})\n"
        "LazyCommand.load = lambda self: command\n"
        "sys.exit(cli.main(['build']))"
    )
    with subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.close()
        said = process.stderr.read()
    assert (process.returncode, said) == (141, "")


def test_a_target_that_is_no_command_is_a_defect() -> None:
    with pytest.raises(TypeError, match="no click command"):
        LazyCommand("os.path:join", "Join.").load()


def test_a_file_and_a_line_add_a_command(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """As docs/architecture.md says."""
    (tmp_path / "greeting.py").write_text(
        "import click\n\n@click.command()\n@click.argument('name')\ndef greet(name):\n    click.echo(f'hello {name}')\n"
    )
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setitem(cli.tmm_gen._table, "greet", LazyCommand("greeting:greet", "Say hello."))
    assert cli.main(["greet", "arm"]) == 0
    assert capsys.readouterr().out == "hello arm\n"
    assert cli.main(["--help"]) == 0
    assert "Say hello." in capsys.readouterr().out
    assert cli.main(["greets"]) == 2
    assert "did you mean greet?" in capsys.readouterr().err
