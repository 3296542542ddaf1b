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
from tmm_gen.closed_loop.tunables import TUNABLE
from tmm_gen.emit.c import emit_kernel
from tmm_gen.export.fmu.headers import fmi_headers
from tmm_gen.extras import packages
from tmm_gen.modal.arm import linear_arm
from tmm_gen.onboard.emit import EMITTED
from tmm_gen.program.build import build_unchecked
from tmm_gen.row.scene import row_of
from tmm_gen.study.excitation import excitation

ROOT = Path(__file__).resolve().parents[1]
SCENES = ROOT / "scenes"
STUDY = ["trade", str(SCENES / "thesis2.toml"), "--integrators", "newmark", "--steps", "0.1", "--until", "1"]
SWING = str(SCENES / "swing.toml")

COMMANDS = [
    ("study", "distributed", [*STUDY, "--rounds", "0", "--workers", "2"]),
    ("study", "distributed", [*STUDY, "--rounds", "0", "--scheduler", "tcp://127.0.0.1:9"]),
    ("fmu", "fmpy", ["export", str(SCENES / "thesis2.toml"), "--to", "fmu"]),
    ("fmu", "fmpy", ["export", SWING, "--to", "fmu", "--fmi", "3"]),
    ("playground", "ziglang", ["playground", SWING]),
    ("mpc", "daqp", ["mpc", SWING]),
    ("mpc", "daqp", ["mpc", SWING, "--compiled", "--plot"]),
    *(("mpc", "daqp", ["mpc", SWING, "--controller", "pd", "--controller", name]) for name in EMITTED),
    *(("mpc", "daqp", ["mpc", SWING, "--emit", "c", "--controller", name]) for name in EMITTED),
    ("mpc", "daqp", ["mpc", SWING, "--emit", "c"]),
    ("mpc", "daqp", ["mpc", SWING, "--tune", "--workers", "2"]),
    ("mpc", "daqp", ["mpc", SWING, "--tune", "mpc", "--refine"]),
    *(("mpc", "cma", ["mpc", SWING, "--tune", item.name, "--out", "tuned.toml"]) for item in TUNABLE),
]

MODELS = (build_unchecked, row_of, linear_arm, excitation, fmi_headers, emit_kernel)
"""What takes time, and all that builds a model goes through."""


@pytest.fixture
def no_model(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let whatever begins to build a model fail, from wherever it is called."""

    def fails(*_arguments: object, **_options: object) -> None:
        raise AssertionError("a model is built before the extra is looked for")

    for function in MODELS:
        monkeypatch.setattr(function, "__code__", fails.__code__)


@pytest.mark.usefixtures("no_model")
@pytest.mark.parametrize(
    ("extra", "module", "words"),
    COMMANDS,
    ids=lambda value: " ".join(value) if isinstance(value, list) else value,
)
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


@pytest.mark.usefixtures("no_model")
@pytest.mark.parametrize(
    "words",
    [
        ["mpc", SWING, "--controller", "mpc-modes"],
        ["mpc", SWING, "--tune", "pd", "--evaluations", "20"],
        ["trade", *STUDY[1:], "--workers", "2"],
        ["export", SWING, "--to", "fmu"],
    ],
)
def test_where_nothing_is_missing_these_build_models(
    words: list[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(AssertionError, match="a model is built"):
        main(words)


def test_extras_are_those_of_the_project() -> None:
    listed = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    for extra in {extra for extra, _, _ in COMMANDS}:
        assert sorted(packages(extra)) == sorted(listed[extra])
    for_code = {"jax", "cuda"}  # what no command needs, but code that is generated
    for extra in for_code:
        assert sorted(packages(extra)) == sorted(listed[extra])
    assert {extra for extra, _, _ in COMMANDS} == set(listed) - {"test", "lint", "site", "dev"} - for_code


def test_without_metadata_names_are_enough(monkeypatch: pytest.MonkeyPatch) -> None:
    def unknown(name: str) -> list[str]:
        raise metadata.PackageNotFoundError(name)

    monkeypatch.setattr(metadata, "requires", unknown)
    assert packages("mpc") == ("cma", "daqp")
