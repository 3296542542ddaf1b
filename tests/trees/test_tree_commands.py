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


@pytest.mark.parametrize(
    "words",
    [
        ("modes",),
        ("frequency",),
        ("explain",),
        ("stability", "--cells", "0"),
        ("trade", "--integrators", "newmark,sdirk2", "--until", "0.2"),
    ],
)
def test_commands(words: tuple[str, ...], fork_file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    command, *options = words
    assert told(capsys, command, str(fork_file), *options)


def test_pictures_of_modes(fork_file: Path, tmp_path: Path) -> None:
    for gravity in ("0", "9.81"):
        path = fork_file.with_name(f"modes{gravity}.svg")
        loaded = fork_file.with_name(f"arm{gravity}.toml")
        loaded.write_text(fork_file.read_text().replace("gravity = 0.0", f"gravity = {gravity}"))
        assert main(["modes", str(loaded), "--count", "2", "--plot", str(path)]) == 0
        assert path.read_text().count("<svg") == 1
