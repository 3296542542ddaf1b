"""Every command has its name in Python, and a test that holds what both say together; those that have none say why."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from pathlib import Path

import pytest

import tmm_gen as tg
from tmm_gen.cli import COMMANDS, main
from tmm_gen.scene import Scene

ROOT = Path(__file__).resolve().parents[2]

NAMES = {
    "build": ("Arm.build", "api/test_answers.py"),
    "check": ("Arm.check", "api/test_answers.py"),
    "run": ("Arm.simulate", "api/test_runs.py"),
    "rest": ("Arm.rest", "api/test_answers.py"),
    "modes": ("Arm.modes", "api/test_answers.py"),
    "frequency": ("Arm.frequency", "api/test_answers.py"),
    "integrators": ("integrators", "api/test_commands.py"),
    "stability": ("Arm.stability", "api/test_studies.py"),
    "trade": ("Arm.trade", "api/test_studies.py"),
    "tune": ("Arm.tune", "api/test_studies.py"),
    "explain": ("Arm.explain", "api/test_studies.py"),
    "playground": ("Arm.playground", "api/test_commands.py"),
    "export": ("Arm.export", "api/test_answers.py"),
    "calibrate": ("Arm.calibrate", "api/test_studies.py"),
    "mpc": ("Arm.mpc", "api/test_studies.py"),
}
"""By command: the name in ``tmm_gen``, and the test under ``tests`` in which both say the same."""

WITHOUT = {
    "new": "writes a commented file for people; a program makes an Arm",
    "import": "writes a file whose comments are decisions to be read; load() reads it then",
    "keys": "a list for people; editors and checkers know the annotated arguments of Arm",
    "schema": "for editors of scene files",
    "errata": "of the thesis, not of an arm",
    "demo": "shows a scene of its own",
}
"""Commands without a name in Python, and why."""


def test_every_command_has_a_name_or_a_reason() -> None:
    assert NAMES.keys() | WITHOUT.keys() == COMMANDS.keys()
    assert not NAMES.keys() & WITHOUT.keys()
    for command, (name, test) in NAMES.items():
        found: object = tg
        for word in name.split("."):
            found = getattr(found, word)
        assert inspect.isfunction(found), name
        text = (ROOT / "tests" / test).read_text()
        assert f'"{command}"' in text.partition("NAMES = {")[0] + text.partition("def test_every_command")[2]
        assert f".{name.rpartition('.')[2]}(" in text


def test_integrators(agree: Callable[..., None], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tmm_gen.derive.integrators.registry.names", lambda: ("newmark",))  # all take seconds
    agree(tg.integrators(zeta=0.1).rows, "integrators", "--zeta", 0.1)
    assert repr(tg.integrators("newmark")) == "<Integrators: newmark>"
    assert "Omega^2/12" in tg.integrators()._repr_html_()
    for call, words in (
        (lambda: tg.integrators("newmrak"), "'newmrak': choose from newmark"),
        (lambda: tg.integrators(zeta=1.0), "zeta: must be a number from 0 to less than 1, not 1.0"),
    ):
        with pytest.raises(tg.UserError, match=words):
            call()


def test_playground(shafts: tg.Arm, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Both ask for the same page; what is on it is held by tests of its own."""
    pages = []

    def page(scene: Scene, names: tuple[str, ...], until: float | None, *_: object) -> str:
        pages.append((scene.digest, tuple(names), until))
        return "<html></html>"

    monkeypatch.setattr("tmm_gen.playground.page.playground", page)
    monkeypatch.setattr("tmm_gen.playground.webassembly.require_compiler", lambda: None)
    made = shafts.playground(tmp_path / "ours.html", integrators="newmark", until=0.5)
    assert made.read_text() == "<html></html>"
    words = ["--integrators", "newmark", "--until", "0.5", "--out", str(tmp_path / "theirs.html")]
    assert main(["playground", str(shafts.save(tmp_path / "shafts.toml")), *words]) == 0
    assert pages[0] == pages[1]
