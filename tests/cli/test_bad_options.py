"""Every option of every command with a value it cannot have: one line, exit code 2."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import click
import pytest

from tmm_gen.cli import COMMANDS, main

SCENES = Path(__file__).resolve().parents[2] / "scenes"
ARGUMENTS = {"calibrate": ["record.csv"], "new": [], "build": [], "export": ["--to", "fmu"], "tune": []}
ANY_SIGN = {"--start"}
WITHOUT_SCENE = {
    "new": ["arm"],
    "keys": [],
    "integrators": [],
    "errata": [],
    "demo": [],
    "import": ["robot.urdf"],
}


def _cases() -> Iterator[tuple[str, str, str]]:
    for name in COMMANDS:
        for parameter in COMMANDS[name].load().params:
            if not isinstance(parameter, click.Option) or parameter.is_flag:
                continue
            for value in _refused(parameter.type):
                if not (value == "-1" and parameter.opts[0] in ANY_SIGN):
                    yield name, parameter.opts[0], value


def _refused(kind: click.ParamType) -> tuple[str, ...]:
    if isinstance(kind, click.IntRange):
        return ("", "x", "1.5", "nan", "-1000000000000", "1e3")
    if kind is click.INT:
        return ("", "x", "1.5", "nan")
    if isinstance(kind, click.types.FloatParamType | click.Choice):
        return ("", "x", "nan", "-1", "inf", "-inf")
    return ()


@pytest.mark.parametrize(("command", "option", "value"), list(_cases()))
def test_a_value_that_cannot_be_is_told_on_one_line(
    command: str,
    option: str,
    value: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    before = WITHOUT_SCENE.get(command, [str(SCENES / "thesis2.toml")])
    code = main([command, *before, *ARGUMENTS.get(command, []), option, value])
    said = capsys.readouterr().err
    assert code == 2
    assert said.startswith("error: ")
    assert said.count("\n") == 1
    assert option in said


@pytest.mark.parametrize("command", [name for name in COMMANDS if name not in WITHOUT_SCENE])
@pytest.mark.parametrize("scene", ["absent.toml", "", "\x00", "a" * 300 + ".toml", "absent/absent.toml"])
def test_scenes_that_are_not_there_are_told(
    command: str,
    scene: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    more = ["--max-error", "1e-3", "--max-time", "1ms"] if command == "tune" else ARGUMENTS.get(command, [])
    code = main([command, scene, *more])
    said = capsys.readouterr().err
    assert code == 2
    assert said.count("\n") == 1


@pytest.mark.parametrize("command", list(COMMANDS))
def test_options_that_are_none_are_told(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([command, "--no-such-option"]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "--no-such-option" in said
