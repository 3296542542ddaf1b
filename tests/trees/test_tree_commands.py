"""Commands that look at an arm as a whole, on one with branches."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from tmm_gen.cli import main
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.scene import Scene
from tmm_gen.stability.map import growth_map
from tmm_gen.stability.motion import small_motion


@pytest.mark.parametrize("name", ["newmark", "sdirk2", "houbolt"])
def test_the_kernel_grows_as_derived(name: str, hand: Callable[..., Scene]) -> None:
    scene = hand(0.1, 1e-4).replace(**{"model.gravity": 9.81})
    found = growth_map(small_motion(scene), integrator(name), 4)
    assert not found.differs.any(), found.worst


def told(capsys: pytest.CaptureFixture[str], *words: str) -> dict[str, object]:
    assert main([*words, "--json"]) == 0
    found: dict[str, object] = json.loads(capsys.readouterr().out)
    return found


@pytest.mark.parametrize("command", ["modes", "frequency"])
def test_small_motion(command: str, fork_file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert told(capsys, command, str(fork_file))


@pytest.mark.compiler
def test_studies(hand_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert told(capsys, "explain", str(hand_file))
    assert told(capsys, "stability", str(hand_file), "--cells", "0")
    assert told(capsys, "check", str(hand_file))["passed"]
    few = ("--integrators", "newmark", "--until", "0.5", "--reals", "float64", "--rounds", "1")
    assert told(capsys, "trade", str(hand_file), *few, "--steps", "2e-3,1e-3,5e-4")
    wanted = ("--max-error", "1e-2", "--max-time", "1", "--out", str(tmp_path / "tuned.toml"))
    assert told(capsys, "tune", str(hand_file), *few, *wanted)
    assert "newmark" in (tmp_path / "tuned.toml").read_text()


def test_pictures_of_modes(fork_file: Path, tmp_path: Path) -> None:
    for gravity in ("0", "9.81"):
        path = fork_file.with_name(f"modes{gravity}.svg")
        loaded = fork_file.with_name(f"arm{gravity}.toml")
        loaded.write_text(fork_file.read_text().replace("gravity = 0.0", f"gravity = {gravity}"))
        assert main(["modes", str(loaded), "--count", "2", "--plot", str(path)]) == 0
        assert path.read_text().count("<svg") == 1
