"""Commands and functions that do not serve arms in space yet say so on one line, whatever they are asked."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from tmm_gen.calibration.calibrate import calibrate
from tmm_gen.cli import COMMANDS, main
from tmm_gen.cli.kinds import SERVED
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.errors import UserError
from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.rest import rest_at, straight
from tmm_gen.row.scene import row_of
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.scene.template import template

WITHOUT_A_SCENE = {"new", "import", "keys", "schema", "integrators", "errata", "demo"}
"""Commands that take none; `demo` brings its own, `import` makes one."""

MORE = {
    "calibrate": ["record.csv"],
    "tune": ["--max-error", "1e-3", "--max-time", "1ms"],
}
"""What commands must be given beside a scene."""

FORMATS = ("fmu", "mjcf", "urdf")


@pytest.fixture
def scene(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "crane.toml"
    path.write_text(template("crane", "spatial"))
    Path("record.csv").write_text("time,yaw\n0,0\n1,0\n")
    return path


def asked(command: str) -> list[list[str]]:
    if command == "export":
        return [["--to", form] for form in FORMATS]
    return [MORE.get(command, [])]


REFUSED = [
    (command, words)
    for command in COMMANDS
    if command not in WITHOUT_A_SCENE and command not in SERVED["spatial"]
    for words in asked(command)
    if " ".join((command, *words)) not in SERVED["spatial"]
]


@pytest.mark.parametrize(
    ("command", "words"), REFUSED, ids=lambda given: given if isinstance(given, str) else "_"
)
def test_what_does_not_serve_arms_in_space_says_so(
    command: str, words: list[str], scene: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([command, str(scene), *words]) == 2
    told = " ".join((command, *words)) if command == "export" else command
    out = capsys.readouterr()
    *first, last = SERVED["spatial"]
    assert out.err == (
        f'error: tmm-gen {told} does not serve kind = "spatial" yet; {", ".join(first)} and {last} do\n'
    )
    assert out.out == ""
    assert {path.name for path in scene.parent.iterdir()} == {"crane.toml", "record.csv"}


def test_there_are_such_commands_and_every_command_is_one_or_the_other() -> None:
    assert REFUSED
    known = (
        WITHOUT_A_SCENE
        | {command for command, _ in REFUSED}
        | {each.split()[0] for each in SERVED["spatial"]}
    )
    assert known == set(COMMANDS)
    assert all(each.split()[0] in COMMANDS for each in SERVED["spatial"])


FUNCTIONS: dict[str, Callable[[Scene], object]] = {
    "row": lambda scene: row_of(scene, integrator("newmark")),
    "modes": linear_arm,
    "rest": lambda scene: rest_at(scene, straight(scene)),
    "calibrate": lambda scene: calibrate(scene, {}),
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_say_so_too(name: str) -> None:
    scene = parse_scene(template("crane", "spatial"), "crane.toml")
    with pytest.raises(UserError, match=r"^crane\.toml: .* do not serve arms in space yet"):
        FUNCTIONS[name](scene)


def test_new_writes_an_arm_in_space(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["new", "crane", "--kind", "spatial"]) == 0
    assert "wrote scenes/crane.toml" in capsys.readouterr().out
    made = parse_scene(Path("scenes/crane.toml").read_text())
    assert made.spatial is not None
    assert [item.name for item in made.spatial.inputs] == ["yaw_torque", "shoulder_torque", "push"]
    for option in (["--control"], ["--motors", "2"]):
        assert main(["new", "other", "--kind", "spatial", *option]) == 2
        assert "add --kind planar" in capsys.readouterr().err.lower()
