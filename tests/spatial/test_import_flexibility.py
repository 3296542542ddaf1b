"""Sidecars of URDF files: links that bend, gears that give way, joints that stay; and what is wrong with them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.random_urdf import random_urdf
from support.urdf_truth import UrdfTruth

from tmm_gen.errors import UserError
from tmm_gen.scene import load_scene
from tmm_gen.scene.spatial.arm import SpatialArm
from tmm_gen.urdf.scene_text import ImportedScene, imported_scene

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "urdf"


def imported(urdf: Path, sidecar: str, folder: Path) -> tuple[ImportedScene, SpatialArm]:
    (folder / "flex.toml").write_text(sidecar)
    scene = imported_scene(urdf, folder / "flex.toml")
    (folder / "scene.toml").write_text(scene.text)
    arm = load_scene(folder / "scene.toml").spatial
    assert arm is not None
    return scene, arm


def ends(arm: SpatialArm, angles: dict[str, float]) -> dict[str, np.ndarray]:
    """Places of all outputs of positions in world axes, joints that are not named at zero."""
    frames = [(np.zeros(3), np.eye(3))]
    for joint in arm.joints:
        at, turn = frames[joint.host]
        turned = Rotation.from_rotvec(np.eye(3)[joint.axis] * angles.get(joint.name, 0.0)).as_matrix()
        frames.append((at + turn @ joint.at, turn @ np.array(joint.turn) @ turned))
    outputs = [output for output in arm.outputs if output.of == "position"]
    return {o.name: frames[o.frame.joint][0] + frames[o.frame.joint][1] @ o.frame.at for o in outputs}


@pytest.mark.parametrize("seed", range(10))
def test_straight_beams_leave_everything_where_it_is(seed: int, tmp_path: Path) -> None:
    text = random_urdf(seed, massless=False)
    truth = UrdfTruth(text)
    (tmp_path / "robot.urdf").write_text(text, encoding="utf-8")
    rng = np.random.default_rng(seed)
    sidecar = [f'[joint."{name}"]\nstiffness = 10\nrotor_inertia = 1' for name in truth.turning[::3]]
    bent = []
    for link in truth.root.findall("link"):
        leaving = [n for n, j in truth.joints.items() if j.find("parent").get("link") == link.get("name")]
        moved = truth.behind(link.get("name")) & set(truth.turning)
        if leaving and moved and link.find("inertial") is not None and rng.random() < 0.5:
            bent.append(link.get("name"))
            stiffness = "bending_stiffness = 2\ntorsional_stiffness = 3"
            sidecar.append(f'[link."{bent[-1]}"]\n{stiffness}\nlinks = 2\nto = "{leaving[0]}"')
    assert bent
    scene, arm = imported(tmp_path / "robot.urdf", "\n".join(sidecar), tmp_path)
    assert len(scene.beams) == len(bent)
    assert len(arm.joints) == len(truth.turning) + len(scene.gears) + 6 * len(bent)
    moving = [
        float(link.find("inertial").find("mass").get("value"))
        for link in truth.root.findall("link")
        if link.find("inertial") is not None and truth.behind(link.get("name")) & set(truth.turning)
    ]
    # half a cell of a beam on the base would not be among the joints' bodies: none is
    assert sum(joint.body.mass for joint in arm.joints) == pytest.approx(sum(moving), rel=1e-14)
    angles = dict(zip(truth.turning, rng.uniform(-3, 3, len(truth.turning)), strict=True))
    places, found = truth.places(angles), ends(arm, {scene.motors[n]: a for n, a in angles.items()})
    assert found
    by_part = {link.replace(" ", "_"): place for link, (place, _) in places.items()}
    for part, place in found.items():
        np.testing.assert_allclose(place, by_part[part], rtol=0, atol=1e-12)


def test_the_example_is_what_its_files_say(tmp_path: Path) -> None:
    sidecar = (EXAMPLE / "picker.flex.toml").read_text()
    scene, arm = imported(EXAMPLE / "picker.urdf", sidecar, tmp_path)
    joints = {joint.name: joint for joint in arm.joints}
    assert scene.gears == ("yaw_gear",)
    assert (joints["yaw_gear"].stiffness, joints["yaw_gear"].damping) == (9000.0, 2.0)
    assert (joints["yaw"].damping, joints["yaw"].armature, joints["yaw"].gear) == (0.5, 0.3, 100.0)
    assert joints["shoulder"].limits == (-2.0, 2.0)
    assert joints["wrist_roll"].axis == 0
    # a tube's EI by what it is made of, per cell; GJ by twice the second moment
    second = np.pi / 64 * (0.025**4 - 0.021**4)
    assert joints["upper_arm_1_bend_y"].stiffness == pytest.approx(70e9 * second / (0.5 / 4), rel=1e-13)
    assert joints["upper_arm_1_twist"].stiffness == pytest.approx(26e9 * 2 * second / (0.5 / 4), rel=1e-13)
    # a rectangle's: thin about y, wide about z
    assert joints["forearm_1_bend_y"].stiffness == pytest.approx(70e9 * 0.02 * 0.015**3 / 12 / (0.4 / 3))
    assert joints["forearm_1_bend_z"].stiffness == pytest.approx(70e9 * 0.015 * 0.02**3 / 12 / (0.4 / 3))
    assert sum(joint.body.mass for joint in arm.joints) == pytest.approx(2.5 + 0.6 + 0.35 + 0.25 + 0.4)
    for decision in (
        "friction 0.2 N m left out: dampers here are linear",
        "joint 'wrist-roll' is called 'wrist_roll'",
        "fixed joint 'gripper_bolts' merged into 'wrist_roll'",
        "limits of effort 60 N m and velocity 4 rad/s are not simulated",
        "link 'pedestal' is part of the clamped base: its mass does nothing",
    ):
        assert decision in scene.decisions
        assert decision in " ".join(scene.text.replace("\n#   ", " ").split())


GOOD = {
    "joint": "[joint.elbow]\nstiffness = 10.0\nrotor_inertia = 1e-5\n",
    "link": "[link.forearm]\nbending_stiffness = 3.0\nlinks = 2\n",
    "tube": '[link.forearm]\nE = 1e9\nlinks = 2\nsection = {kind = "tube", outer = 0.02, inner = 0.01}\n',
}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[joint.elbow", "1: not valid TOML: Expected ']'"),
        ("[motor.elbow]\n", "1: motor: is no key of it (got {elbow = {}}). Choose one of joint, link."),
        ("[joint.elbo]\n", "1: joint.elbo: is no joint of the URDF (got {}). Did you mean 'elbow'?"),
        ("\n[link.fore]\n", "2: link.fore: is no link of the URDF"),
        ("joint = 3\n", "1: joint: must be a table (got 3). Write [joint] and its keys below."),
        ("[joint]\nelbow = 3\n", "2: joint.elbow: must be a table (got 3)."),
        (GOOD["joint"] + "gears = 3\n", "4: joint.elbow.gears: is no key of it (got 3). Did you mean 'gear'?"),
        (GOOD["joint"].replace("10.0", "0"), "2: joint.elbow.stiffness: must be greater than 0 (got 0)."),
        (GOOD["joint"].replace("10.0", "nan"), "2: joint.elbow.stiffness: must be a finite number (got nan)."),
        (GOOD["joint"].replace("10.0", "true"), "2: joint.elbow.stiffness: must be a finite number (got true)."),
        (GOOD["joint"].replace("1e-5", "0"), "1: joint.elbow: has a gear that gives way and no rotor_inertia"),
        (GOOD["joint"] + "lock = 0\n", "4: joint.elbow.lock: leaves nothing for stiffness, rotor_inertia to act"),
        ("[joint.mount]\nlock = 0\n", "2: joint.mount.lock: is for joints of one way to move; this one is fixed"),
        ("[joint.mount]\ngear = 2\n", "1: joint.mount: is a fixed joint, which does not turn."),
        (GOOD["link"].replace("2", "2.5"), "3: link.forearm.links: must be a whole number from 1"),
        ("[link.forearm]\nlinks = 2\n", "1: link.forearm: has no E and no section to bend by."),
        ("[link.forearm]\nlinks = 2\nE = 1e9\n", "1: link.forearm: has no section to bend by."),
        (GOOD["link"] + "E = 1e9\n", "4: link.forearm.E: says again what bending_stiffness says"),
        (GOOD["link"] + "G = 1e9\n", "4: link.forearm.G: needs a section"),
        (GOOD["link"].replace("3.0", "[1, -1]"), "2: link.forearm.bending_stiffness: must be greater than 0"),
        (GOOD["link"].replace("3.0", "[1]"), "2: link.forearm.bending_stiffness: must be a list of 2 finite numbers"),
        (GOOD["link"] + 'to = "elbow"\n', "4: link.forearm.to: is no joint that stands on this link"),
        (GOOD["link"] + "to = 3\n", "4: link.forearm.to: must be text (got 3)."),
        (GOOD["link"] + 'to = "wrist-roll"\nend = [1, 0, 0]\n', "5: link.forearm.end: says again what `to` says"),
        (GOOD["link"] + "end = [0, 0, 0]\n", "1: link.forearm: has no length"),
        (GOOD["link"].replace("forearm", "tool0"), "1: link.tool0: carries no joint that would say where"),
        (GOOD["link"].replace("forearm", "tool0") + "end = [1, 0, 0]\n", "link.tool0: has no mass in the URDF"),
        (GOOD["tube"].replace("0.01}", "0.03}"), "4: link.forearm.section.inner: must be less than outer"),
        (GOOD["tube"].replace(", inner = 0.01", ""), "4: link.forearm.section: has no inner"),
        (GOOD["tube"].replace("tube", "tub"), "section.kind: must be the shape of the section (got \"tub\"). Did"),
        (GOOD["tube"].replace("inner", "innner"), "section.innner: is no key of it (got 0.01). Did you mean 'inner'?"),
    ],
)  # fmt: skip
def test_a_fault_is_told_where_it_is(text: str, said: str, tmp_path: Path) -> None:
    (tmp_path / "flex.toml").write_text(text)
    with pytest.raises(UserError) as caught:
        imported_scene(EXAMPLE / "picker.urdf", tmp_path / "flex.toml")
    lines = str(caught.value).replace(f"{tmp_path / 'flex.toml'}:", "").splitlines()
    assert any(said in line for line in lines), lines


def test_a_branch_says_to_which_joint_its_beam_reaches(tmp_path: Path) -> None:
    more = (
        '<joint name="second" type="continuous"><parent link="forearm"/><child link="finger"/>'
        '<origin xyz="0.1 0 0"/></joint><link name="finger"><inertial><mass value="1"/>'
        '<inertia ixx="1" iyy="1" izz="1"/></inertial></link></robot>'
    )
    urdf = tmp_path / "robot.urdf"
    urdf.write_text((EXAMPLE / "picker.urdf").read_text().replace("</robot>", more))
    with pytest.raises(UserError, match=r'carries several joints: .*`to = "wrist-roll"`'):
        imported(urdf, GOOD["link"], tmp_path)
    scene, arm = imported(urdf, GOOD["link"] + 'to = "wrist-roll"\n', tmp_path)
    assert "joint 'second' stands on the root of beam 'elbow', rigidly" not in scene.text
    assert "joint 'second' stands on the root of beam 'forearm', rigidly" in scene.text
    joints = {joint.name: joint for joint in arm.joints}
    assert arm.joints[joints["second"].host - 1].name == "elbow"
    assert '\non = "elbow"\nat = [0.1, 0, 0]\n' in scene.text


def test_a_last_link_bends_to_the_end_that_is_given(tmp_path: Path) -> None:
    urdf = tmp_path / "robot.urdf"
    text = (EXAMPLE / "picker.urdf").read_text()
    urdf.write_text(text[: text.index('  <joint name="tool"')] + "</robot>\n")
    flex = GOOD["link"].replace("forearm", "gripper") + "end = [0.0, 0.0, 0.2]\n"
    scene, arm = imported(urdf, flex, tmp_path)
    assert scene.beams == ("gripper",)
    assert "link 'gripper' bends: a beam from its joint to the end given" in scene.decisions
    # along z of the gripper, which is x of the wrist: 0.06 m of bolts and 0.2 m of beam beyond it
    reach = ends(arm, {})["gripper"]
    elbow = np.array([0.5, 0.0, 0.52])
    np.testing.assert_allclose(reach, elbow + 0.66 * np.array([np.cos(0.5), 0.0, -np.sin(0.5)]), atol=1e-14)


def test_what_stands_on_the_base_may_bend(tmp_path: Path) -> None:
    _, arm = imported(EXAMPLE / "picker.urdf", GOOD["link"].replace("forearm", "pedestal"), tmp_path)
    assert [joint.name for joint in arm.joints[:4]] == [
        f"pedestal_{n}" for n in ("1_bend_y", "1_bend_z", "2_bend_z", "2_bend_y")
    ]
    # of its two cells' 12 kg a quarter is clamped
    assert sum(joint.body.mass for joint in arm.joints) == pytest.approx(
        0.75 * 12 + 2.5 + 0.6 + 0.35 + 0.25 + 0.4
    )
    np.testing.assert_allclose(ends(arm, {})["tool0"][1], 0.0, atol=1e-15)
