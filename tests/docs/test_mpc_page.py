"""The page on control is run: every command in turn, then its Python."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.compiler

PAGE = Path(__file__).resolve().parents[2] / "docs" / "mpc.md"


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", PAGE.read_text(), re.DOTALL)


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An empty folder, with `tmm-gen` on the path of what runs there."""
    folder = tmp_path_factory.mktemp("tutorial")
    script = folder / "bin" / "tmm-gen"
    script.parent.mkdir()
    script.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m tmm_gen "$@"\n')
    script.chmod(0o755)
    return folder


def run(place: Path, words: list[str]) -> str:
    environment = {**os.environ, "PATH": f"{place / 'bin'}{os.pathsep}{os.environ['PATH']}"}
    done = subprocess.run(words, cwd=place, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_the_tutorial_from_a_new_scene_to_a_controller_in_c(place: Path) -> None:
    commands = [
        line[2:] for block in blocks("console") for line in block.splitlines() if line.startswith("$ ")
    ]
    assert len(commands) >= 8
    shown = run(place, ["bash", "-euo", "pipefail", "-c", "\n".join(commands)])
    assert "beam.bending_stiffness" in shown
    assert (place / "controller.o").is_file()
    assert "time_s,tip_rad" in shown  # the example ran
    assert "measurement to torque" in shown  # and the loop
    assert (place / "swing.png").read_bytes().startswith(b"\x89PNG")
    fitted = (place / "scenes" / "fitted.toml").read_text()
    stiffness = re.search(r"bending_stiffness = ([0-9.e+-]+)", fitted)
    assert stiffness is not None
    assert float(stiffness[1]) == pytest.approx(10.5, rel=5e-3)
    (loop,) = (block for block in blocks("c") if "crane" in block)
    (place / "loop.c").write_text(
        '#include "crane_mpc_modes.h"\nvoid read_sensors(crane_mpc_modes_real *measured);\n'
        "void set_torque(crane_mpc_modes_real torque);\nint main(void)\n{\n"
        "static crane_mpc_modes_controller controller;\nstatic crane_mpc_modes_real measured[3], torque;\n"
        f"{loop}}}\n"
    )
    strict = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-fsyntax-only"]
    run(place, ["gcc", *strict, "-Icontroller", "loop.c"])
    shown = run(place, [sys.executable, "-W", "ignore", "-c", "\n".join(blocks("python"))])
    tip, hub, reference = (float(number) for number in re.findall(r"-?[\d.]+", shown.splitlines()[0]))
    assert reference > 0.1
    # the page's own loop, with half as much payload again: it arrived
    assert (tip, hub) == pytest.approx((reference, reference), rel=0.02)


def test_the_figures_stated_are_in_the_page() -> None:
    """The table of the page has every controller that is compared by default."""
    from tmm_gen.control.controllers import CONTROLLERS

    rows = [line for line in PAGE.read_text().splitlines() if line.startswith("| `")]
    for kind in CONTROLLERS:
        assert any(f"`{kind.name}`" in row for row in rows), kind.name
