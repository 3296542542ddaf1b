"""The page on arms by parts: its example builds, its commands draw what it shows, its figures are there."""

from __future__ import annotations

import re
import shlex
import shutil
from pathlib import Path

import pytest

from tmm_gen.cli import main
from tmm_gen.explain.hints import hints
from tmm_gen.program.build import build_program
from tmm_gen.scene import load_scene, parse_scene

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "arms.md").read_text()
COMMANDS = [
    line.removeprefix("$ tmm-gen ")
    for block in re.findall(r"```console\n(.*?)```", PAGE, re.DOTALL)
    for line in block.splitlines()
]
EXAMPLES = re.findall(r"```toml\n(name = .*?)```", PAGE, re.DOTALL)
PICTURES = [command for command in COMMANDS if "--plot" in command]


@pytest.mark.parametrize("command", PICTURES)
def test_commands(
    command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(ROOT)
    words = shlex.split(command)
    picture = words.index("--plot") + 1
    words[picture] = str(tmp_path / words[picture])
    assert main(words) == 0
    assert Path(words[picture]).is_file()
    assert "accurate to about" in capsys.readouterr().out


@pytest.mark.compiler
def test_calibration(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """What made the record is found, and what is written can be read."""
    (tmp_path / "scenes").mkdir()
    shutil.copy(ROOT / "scenes" / "elbow.toml", tmp_path / "scenes")
    monkeypatch.chdir(tmp_path)
    commands = [command for command in COMMANDS if "made.csv" in command]
    assert len(commands) == 3
    for command in commands:
        assert main(shlex.split(command)) == 0, command
    assert "body.payload.mass" in capsys.readouterr().out
    assert load_scene(tmp_path / "scenes" / "fitted.toml").joints[1].stiffness == pytest.approx(
        9.0 / 0.1, rel=1e-4
    )


def test_there_are_commands_and_figures() -> None:
    assert len(PICTURES) >= 2
    for figure in re.findall(r"\]\((figures/\S+)\)", PAGE):
        assert (ROOT / "docs" / figure).is_file()


def test_the_examples_build() -> None:
    for text in EXAMPLES:
        if 'kind = "spatial"' not in text:
            assert build_program(parse_scene(text)).stations > 1
    assert len(EXAMPLES) == 3


def test_the_arm_in_space_is_what_the_page_says() -> None:
    (text,) = (text for text in EXAMPLES if 'kind = "spatial"' in text)
    crane = parse_scene(text).spatial
    assert crane is not None
    joints = {joint.name: joint for joint in crane.joints}
    assert [joints[name].host for name in ("yaw", "bearing", "jib_1_bend_y", "counter_jib_1_bend_y")] == [
        0,
        1,
        2,
        2,
    ]
    assert len(joints) == 2 + 3 * 4 + 3 * 2
    # the counter-jib points the other way
    assert joints["counter_jib_1_bend_y"].at[0] < 0 < joints["jib_1_bend_y"].at[0]
    assert [joints[f"jib_2_{way}"].axis for way in ("twist", "bend_z", "bend_y")] == [0, 2, 1]
    columns = [column for item in (*crane.inputs, *crane.outputs) for column in item.columns]
    assert columns == [
        *("yaw_torque", "wind_x", "wind_y", "wind_z"),
        *("load_x", "load_y", "load_z", "facing_w", "facing_x", "facing_y", "facing_z"),
    ]
    for column in columns[1:]:
        assert column in PAGE
    assert hints(parse_scene(text)) == []
