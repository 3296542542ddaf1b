"""Every command that needs an optional package says so in one line, with a command that installs it."""

from __future__ import annotations

import re
import shlex
import sys
import tomllib
from importlib import metadata
from pathlib import Path

import pytest

from tmm_gen.cli import main
from tmm_gen.extras import packages

ROOT = Path(__file__).resolve().parents[1]
SCENES = ROOT / "scenes"
STUDY = ["trade", str(SCENES / "thesis2.toml"), "--integrators", "newmark", "--steps", "0.1", "--until", "1"]
SWING = str(SCENES / "swing.toml")

COMMANDS = [
    ("study", "distributed", [*STUDY, "--rounds", "0", "--workers", "2"]),
    ("study", "distributed", [*STUDY, "--rounds", "0", "--scheduler", "tcp://127.0.0.1:9"]),
    ("fmu", "fmpy", ["export", str(SCENES / "thesis2.toml"), "--to", "fmu"]),
    ("mpc", "daqp", ["mpc", SWING, "--controller", "mpc-modes"]),
    ("mpc", "cma", ["mpc", SWING, "--tune", "lqr", "--evaluations", "20", "--out", "tuned.toml"]),
]


@pytest.mark.parametrize(("extra", "module", "words"), COMMANDS, ids=lambda value: str(value)[:40])
def test_it_says_what_to_install(
    extra: str,
    module: str,
    words: list[str],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setitem(sys.modules, module, None)
    assert main(words) == 2
    said = capsys.readouterr()
    assert re.fullmatch(r"error: .* needs \S+, which is not installed: .* -m pip install .*\n", said.err)
    command = shlex.split(said.err.strip().rpartition("installed: ")[2])
    assert command[0] == sys.executable
    assert command[4:] == list(packages(extra))
    assert list(tmp_path.iterdir()) == []


def test_extras_are_those_of_the_project() -> None:
    listed = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    for extra in {extra for extra, _, _ in COMMANDS}:
        assert sorted(packages(extra)) == sorted(listed[extra])
    assert {extra for extra, _, _ in COMMANDS} == set(listed) - {"test", "dev"}


def test_without_metadata_names_are_enough(monkeypatch: pytest.MonkeyPatch) -> None:
    def unknown(name: str) -> list[str]:
        raise metadata.PackageNotFoundError(name)

    monkeypatch.setattr(metadata, "requires", unknown)
    assert packages("mpc") == ("cma", "daqp")
