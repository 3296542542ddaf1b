"""`tmm-gen import` as a command: what it writes, what it leaves alone, and xacro."""

from __future__ import annotations

import json
import sys
import xml.dom.minidom
from pathlib import Path
from types import ModuleType

import pytest

from tmm_gen.cli import main
from tmm_gen.scene import load_scene
from tmm_gen.urdf.scene_text import imported_scene

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "urdf"
URDF, FLEX = str(EXAMPLE / "picker.urdf"), str(EXAMPLE / "picker.flex.toml")


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_scene_is_named_as_the_robot_and_never_replaced(
    place: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["import", URDF]) == 0
    said = capsys.readouterr().out
    assert said.startswith("wrote picker.toml: 4 motors, 6 bodies, all rigid\n")
    written = (place / "picker.toml").read_text()
    assert load_scene(place / "picker.toml").name == "picker"
    assert main(["import", URDF]) == 0  # the same again changes nothing
    assert main(["import", URDF, "--flex", FLEX]) == 2
    assert "picker.toml: exists already" in capsys.readouterr().err
    assert (place / "picker.toml").read_text() == written
    assert main(["import", URDF, "--out", "my arm.toml"]) == 0
    assert "then `tmm-gen build 'my arm.toml'` and" in capsys.readouterr().out
    assert main(["import", URDF, "--flex", FLEX, "--force"]) == 0
    assert (place / "picker.toml").read_text() != written


def test_what_is_read_is_not_written(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (place / "picker.toml").write_text(Path(FLEX).read_text())
    assert main(["import", URDF, "--flex", "picker.toml", "--out", "picker.toml", "--force"]) == 2
    assert "picker.toml: is read by this command and would be lost" in capsys.readouterr().err
    assert main(["import", URDF, "--flex", "picker.toml", "--force"]) == 2
    assert (place / "picker.toml").read_text() == Path(FLEX).read_text()


def test_what_only_the_whole_can_tell_is_told_of_the_scene(
    place: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # two joints about one axis and no mass between them: one of them could turn without end
    joint = '<joint name="{}" type="continuous"><parent link="{}"/><child link="{}"/></joint><link name="{}">{}</link>'
    mass = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial>'
    first, second = joint.format("j", "a", "b", "b", ""), joint.format("k", "b", "c", "c", mass)
    (place / "r.urdf").write_text(f'<robot name="r"><link name="a"/>{first}{second}</robot>')
    assert main(["import", "r.urdf"]) == 2
    said = capsys.readouterr().err
    assert said.startswith("error: r.toml:")
    assert "motor[1]: carries nothing that has inertia about the axis of 'j'" in said
    (place / "flex.toml").write_text("[joint.j]\nrotor_inertia = 1e-3\n")
    assert main(["import", "r.urdf", "--flex", "flex.toml", "--force"]) == 0


def test_json(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", URDF, "--flex", FLEX, "--out", "a/b.toml", "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    scene = load_scene(place / "a" / "b.toml")
    assert said["file"] == "a/b.toml"
    assert said["motors"][3] == {"joint": "wrist-roll", "name": "wrist_roll"}
    assert said["gears"] == ["yaw_gear"]
    assert said["beams"] == ["upper_arm", "forearm"]
    assert scene.spatial is not None
    assert said["inputs"] == [item.name for item in scene.spatial.inputs]
    assert said["outputs"] == [item.name for item in scene.spatial.outputs]
    assert "no twist: neither G nor torsional_stiffness is given" not in said["decisions"]


def test_names_of_all_kinds_become_identifiers(place: Path) -> None:
    text = Path(URDF).read_text().replace('name="picker"', 'name="json"')
    for old, new in (
        ("yaw", "base"),
        ("shoulder", "class"),
        ("elbow", "7/elbow joint"),
        ("wrist-roll", "wrist"),
        ("tool0", "x" * 80),
        ("column", "7.elbow.joint"),
    ):
        text = text.replace(f'"{old}"', f'"{new}"')
    (place / "robot.urdf").write_text(text)
    scene = imported_scene(place / "robot.urdf")
    (place / "scene.toml").write_text(scene.text)
    assert load_scene(place / "scene.toml").name == scene.name == "json_arm"
    assert scene.motors == {
        "base": "base_joint",
        "class": "class_1",
        "7/elbow joint": "part_7_elbow_joint",
        "wrist": "wrist",
    }
    assert "part_7_elbow_joint_link" in scene.bodies
    assert "wrist_link" in scene.bodies
    assert "link 'wrist' is called 'wrist_link'" in scene.decisions
    assert max(map(len, scene.outputs)) <= 48


def test_comments_hold_any_name(place: Path) -> None:
    text = Path(URDF).read_text().replace("upper_arm", "a&#10;[[motor]]&#9;&#x202e; #")
    (place / "robot.urdf").write_text(text)
    scene = imported_scene(place / "robot.urdf")
    (place / "scene.toml").write_text(scene.text)
    assert len(load_scene(place / "scene.toml").spatial.joints) == 4  # type: ignore[union-attr]


def test_xacro_is_expanded_where_its_package_is(
    place: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (place / "picker.urdf.xacro").write_text("<robot/>")
    fake = ModuleType("xacro")
    fake.process_file = lambda name: xml.dom.minidom.parse(URDF) if name.endswith(".xacro") else None  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "xacro", fake)
    assert main(["import", "picker.urdf.xacro"]) == 0
    assert "Imported from picker.urdf.xacro (expanded)." in (place / "picker.toml").read_text()

    def fails(name: str) -> None:
        raise ValueError("undefined\nsubstitution argument")

    fake.process_file = fails  # type: ignore[attr-defined]
    capsys.readouterr()
    assert main(["import", "picker.urdf.xacro"]) == 2
    assert capsys.readouterr().err == (
        "error: picker.urdf.xacro: xacro cannot expand it: undefined substitution argument. See what "
        "`xacro picker.urdf.xacro > picker.urdf` says.\n"
    )


def test_xacro_without_its_package_is_told(
    place: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (place / "picker.urdf.xacro").write_text("<robot/>")
    monkeypatch.setitem(sys.modules, "xacro", None)
    assert main(["import", "picker.urdf.xacro"]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "pip install xacro" in said
    assert "`xacro picker.urdf.xacro > picker.urdf`, and import that" in said
