"""The page on URDF: its commands run, what it shows is what they write, its keys are all there are."""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import mujoco
import numpy as np
import pytest

from tmm_gen.cli import main
from tmm_gen.inputs.signals import Constant
from tmm_gen.reference.spatial_motion import motion
from tmm_gen.reference.spatial_reference import outputs
from tmm_gen.scene import load_scene
from tmm_gen.urdf import sidecar
from tmm_gen.urdf.cross_section import MEASURES

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "urdf.md").read_text()
COMMANDS = [
    line.removeprefix("$ tmm-gen ")
    for block in re.findall(r"```console\n(.*?)```", PAGE, re.DOTALL)
    for line in block.splitlines()
]
SNIPPETS = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
BLOCKS = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)


def run(text: str) -> str:
    """Return what a script prints, in a process of its own, as the package it imports is another each time."""
    where = {**os.environ, "PYTHONPATH": os.pathsep.join([".", *sys.path])}
    script = [sys.executable, "-c", text]
    return subprocess.run(script, env=where, capture_output=True, text=True, check=True).stdout


@pytest.fixture
def imported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    shutil.copytree(ROOT / "examples" / "urdf", tmp_path / "examples" / "urdf")
    monkeypatch.chdir(tmp_path)
    assert main(shlex.split(COMMANDS[0])) == 0
    return tmp_path / "picker.toml"


def test_the_way_there_and_back(imported: Path) -> None:
    exports = [command for command in COMMANDS if command.startswith("export")]
    assert len(exports) == 2
    for command in exports:
        assert main(shlex.split(command)) == 0
    assert (
        main(["import", "picker_again.urdf", "--out", "again.toml"]) == 2
    )  # the yaw motor's rotor is left out
    rotors = re.findall(
        r"for - -flex: (\[joint\.\w+\]) (rotor_inertia = \S+), (gear = \S+)",
        Path("picker_again.urdf").read_text(),
    )
    Path("again.flex.toml").write_text("\n".join(line for joint in rotors for line in joint))
    again = ["import", "picker_again.urdf", "--flex", "again.flex.toml", "--out", "again.toml", "--force"]
    assert main(again) == 0
    first, second = load_scene(imported).spatial, load_scene("again.toml").spatial
    assert first is not None
    assert second is not None
    assert len(first.joints) == len(second.joints) == 4 + 1 + 3 * (4 + 3)
    assert mujoco.MjModel.from_xml_path("picker.xml").nv == len(first.joints)


@pytest.mark.compiler
def test_the_kernel(imported: Path) -> None:
    command = next(command for command in COMMANDS if command.startswith("build"))
    assert main(shlex.split(command)) == 0
    assert list((imported.parent / "generated" / "picker" / "c").glob("*.c"))
    arm = load_scene(imported).spatial
    assert arm is not None
    signals = {"shoulder_torque": Constant(0.02)}
    q, v, a = motion(arm, signals, np.array([0.1]))
    exact = outputs(arm, q, v, a, {"shoulder_torque": np.array([0.02])})["tool0_z"][0]
    still = outputs(arm, 0 * q, 0 * v, 0 * a, {})["tool0_z"][0]
    shown = [float(run(text)) for text in SNIPPETS]
    assert len(shown) == 2
    assert shown[0] == pytest.approx(shown[1], abs=1e-12)
    assert shown[0] == pytest.approx(exact, abs=1e-3 * abs(exact - still))


def test_the_modes(imported: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The frequencies that the page tells are those of the table."""
    capsys.readouterr()
    command = next(command for command in COMMANDS if command.startswith("modes"))
    assert main([*shlex.split(command), "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["rows"]
    assert (imported.parent / "picker-modes.png").is_file()
    by_part = {row["shares"][0]["what"]: row for row in reversed(rows)}
    assert by_part["yaw turns"]["motion"] == "turns freely"
    assert by_part["wrist_roll turns"]["damping_ratio"] > 1.0
    shoulder, elbow, upper = (
        by_part[what]["frequency_hz"] for what in ("shoulder turns", "elbow turns", "upper_arm bends about z")
    )
    assert f"shoulder and elbow at {shoulder:.2f} and {elbow:.2f} Hz" in " ".join(PAGE.split())
    assert f"bends sideways at {upper:.1f} Hz" in " ".join(PAGE.split())
    for words in re.findall(r"`tmm-gen ((?:rest|frequency) picker[^`]*)`", PAGE):
        assert main(shlex.split(words)) == 0


def test_what_is_shown_is_in_the_files(imported: Path) -> None:
    shown, scene, lock = BLOCKS
    flex = tomllib.loads((ROOT / "examples" / "urdf" / "picker.flex.toml").read_text())
    for table, tables in tomllib.loads(shown).items():
        for name, keys in tables.items():
            assert flex[table][name] == keys
    assert scene in imported.read_text()
    assert tomllib.loads(lock) == {"joint": {"finger": {"lock": 0.02}}}


def test_every_key_is_told() -> None:
    known = {
        *sidecar.OF_JOINTS,
        *sidecar.OF_LINKS,
        *MEASURES,
        *(m for names in MEASURES.values() for m in names),
    }
    told = set(re.findall(r"`(\w+)`", PAGE)) | set(re.findall(r"^(\w+) = ", "\n".join(BLOCKS), re.M))
    assert known <= told
