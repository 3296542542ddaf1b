"""What is wrong with a URDF is told with its line, its element, its value and a remedy; never as a traceback."""

from __future__ import annotations

from pathlib import Path

import pytest

from tmm_gen.cli import main
from tmm_gen.scene import load_scene
from tmm_gen.urdf.faults import UrdfError
from tmm_gen.urdf.scene_text import imported_scene

MASS = '<inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1"/></inertial>'
JOINT = '<joint name="j" type="continuous"><parent link="a"/><child link="b"/>{}</joint>'
GOOD = f'<robot name="arm">\n<link name="a"/>\n{JOINT.format("")}\n<link name="b">{MASS}</link>\n</robot>'


def told(text: str | bytes, folder: Path, capsys: pytest.CaptureFixture[str]) -> list[str]:
    """Import through the command line; return the lines of the error."""
    path = folder / "robot.urdf"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    assert main(["import", str(path), "--out", str(folder / "scene.toml")]) == 2
    assert not (folder / "scene.toml").exists()
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.startswith("error: ")
    return [line.replace(str(path), "robot.urdf") for line in said.err.removeprefix("error: ").splitlines()]


def with_joint(inside: str, kind: str = "continuous", tail: str = "") -> str:
    return GOOD.replace(JOINT.format(""), JOINT.format(inside).replace("continuous", kind)).replace(
        "</robot>", f"{tail}\n</robot>"
    )


def with_link(inside: str) -> str:
    return GOOD.replace(MASS, inside)


def test_what_all_others_are_made_of_is_good(tmp_path: Path) -> None:
    (tmp_path / "robot.urdf").write_text(GOOD)
    assert imported_scene(tmp_path / "robot.urdf").motors == {"j": "j"}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        # the file
        ("", "robot.urdf:1: is no XML: no element found. Name a file that holds a <robot>."),
        ("<robot name='x'>\n<link>\n</robot>", "3: is no XML: mismatched tag, and <link> of line 2 is open."),
        ("<robot name='x' name='y'/>", "robot.urdf:1: is no XML: duplicate attribute. Write each attribute once."),
        ("<robot name='&who;'/>", "robot.urdf:1: is no XML: undefined entity. Write the character itself"),
        (
            b'<?xml version="1.0" encoding="klingon"?>\n<robot name="x"/>',
            "robot.urdf:1: is in an encoding that cannot be read",
        ),
        ("\n<!DOCTYPE robot [<!ENTITY a 'b'>]>\n<robot name='&a;'/>", "robot.urdf:2: <!DOCTYPE>: is not allowed"),
        ('<!DOCTYPE robot SYSTEM "file:///etc/passwd">\n<robot name="x"/>', "robot.urdf:1: <!DOCTYPE>: is not"),
        ("<sdf/>", "robot.urdf:1: <sdf>: is no <robot>. Name a URDF file"),
        ("<robot/>", "robot.urdf:1: robot 'robot': has no <link>. Name a file that holds the links."),
        ("<robot name='x'/>", "robot.urdf:1: robot 'x': has no <link>."),
        (
            "<robot name='x' xmlns:xacro='http://www.ros.org/wiki/xacro'>\n<xacro:arm/></robot>",
            "robot.urdf:2: <xacro:arm>: is xacro, not URDF. End the file's name in .xacro, or expand it",
        ),
        # names
        (GOOD.replace("</robot>", '<link name="b"/></robot>'), "5: link 'b': is there twice, first on line 4."),
        (with_joint("", tail=JOINT.format("")), "5: joint 'j': is there twice, first on line 3."),
        (GOOD.replace('<link name="a"/>', "<link/>"), "2: <link>: has no attribute name."),
        (
            GOOD.replace('<link name="a"/>', '<Link name="a"/>'),
            "2: robot 'arm' <Link>: is no element of URDF. Did you mean <link>?",
        ),
        # the tree
        (with_joint("", tail='<link name="c"/>'), "5: link 'c': is carried by no joint, nor is link 'a' on line 2."),
        (
            with_joint("", tail=JOINT.format("").replace('"j"', '"k"')),
            "5: joint 'k': carries link 'b', as joint 'j' on line 3 does: a loop.",
        ),
        (
            GOOD.replace("</robot>", JOINT.format("").replace('"j"', '"k"').replace('"a"', '"c"') + "</robot>"),
            "5: joint 'k': names a link 'c' that is not there. Add <link name=\"c\"/>",
        ),
        (
            GOOD.replace(
                "</robot>",
                '\n<joint name="k" type="fixed"><parent link="b"/><child link="a"/></joint></robot>',
            ),
            "6: joint 'k': closes a circle of links that carry each other: a -> b -> a. Remove it",
        ),
        (
            '<robot name="x"><link name="a"/></robot>',
            "1: robot 'x': has no joint that turns. Make one of its joints revolute or continuous.",
        ),
        # joints
        (with_joint("", "prismatic"), '3: joint \'j\' type: slides, and arms have joints that turn (got "prismatic").'),
        (with_joint("", "prismatic"), "`[joint.j]` with `lock = 0.0` in a file given by --flex."),
        (with_joint("", "floating"), '3: joint \'j\' type: moves in several ways'),
        (with_joint("", "planar"), 'To keep it in place, write type="fixed".'),
        (
            with_joint("", "revolut"),
            "3: joint 'j' type: is no type of URDF (got \"revolut\"). Did you mean 'revolute'?",
        ),
        (with_joint('<mimic joint="k"/>'), '3: joint \'j\' <mimic>: ties it to another joint'),
        (with_joint("").replace('<parent link="a"/>', ""), "3: joint 'j': has no <parent>. Add for example <parent"),
        (with_joint("").replace(' link="a"/>', "/>"), "3: joint 'j' <parent>: has no attribute link."),
        (with_joint('<parent link="a"/>'), "3: joint 'j' <parent>: is there twice, first on line 3. Keep one"),
        (with_joint('<axis xyz="0 0 0"/>'), '3: joint \'j\' <axis xyz>: has no direction (got "0 0 0").'),
        (with_joint('<axis xyz="0 0"/>'), "3: joint 'j' <axis xyz>: must be 3 finite numbers (got \"0 0\")."),
        (with_joint('<axis xyz="0 0 nan"/>'), "must be 3 finite numbers (got \"0 0 nan\")."),
        (with_joint('<axis xyz="0 0 1e999"/>'), "must be 3 finite numbers (got \"0 0 1e999\")."),
        (with_joint('<axis xyz="0 0 1_0"/>'), "must be 3 finite numbers (got \"0 0 1_0\")."),
        (with_joint('<axis xyz="0, 0, 1"/>'), "Write a point before decimals, and spaces between numbers"),
        (with_joint('\n\n<origin rpy="0 0 ${pi}"/>'), "5: joint 'j' <origin rpy>: must be 3 finite numbers"),
        (with_joint('<origin rpy="0 0 ${pi}"/>'), "The file is xacro: expand it first"),
        (
            with_joint('<origin xzy="0 0 1"/>'),
            "<origin xzy>: is no attribute of URDF (got \"0 0 1\"). Did you mean xyz?",
        ),
        (with_joint('<orign xyz="0 0 1"/>'), "3: joint 'j' <orign>: is no element of URDF. Did you mean <origin>?"),
        (with_joint('<dynamics damping="-1"/>'), "<dynamics damping>: must not be less than 0 (got \"-1\")."),
        (with_joint('<dynamics dampng="1"/>'), "is no attribute of URDF (got \"1\"). Did you mean damping?"),
        (
            with_joint('<limit lower="1" upper="-1"/>', "revolute"),
            "3: joint 'j' <limit>: has lower 1 above upper -1. Exchange them.",
        ),
        # links
        (with_link(""), "3: joint 'j': carries nothing that has inertia about its axis. Give a link behind it"),
        (
            with_link('<inertial><mass value="1"/><origin xyz="2 0 0"/><inertia ixx="0" iyy="1" izz="1"/></inertial>'),
            "3: joint 'j': carries nothing that has inertia about its axis.",
        ),
        (with_link("<inertial/>"), "4: link 'b' <inertial>: has no <mass>. Add for example <mass value=\"1.0\"/>."),
        (with_link("<inertial/>"), "4: link 'b' <inertial>: has no <inertia>."),
        (with_link(MASS + MASS), "4: link 'b' <inertial>: is there twice"),
        (with_link(MASS.replace('ixx="0.1"', "")), "4: link 'b' <inertia>: has no attribute ixx."),
        (with_link(MASS.replace('"1"', '"-1"')), "4: link 'b' <mass value>: must not be less than 0 (got \"-1\")."),
        (with_link(MASS.replace('"1"', '"heavy"')), "<mass value>: must be a finite number (got \"heavy\")."),
        (
            with_link(MASS.replace('izz="0.1"', 'izz="0.1" ixy="0.2"')),
            "4: link 'b' <inertia>: has the principal moment -0.1 kg m^2; no body has a negative one.",
        ),
    ],
)  # fmt: skip
def test_a_fault_is_told_where_it_is(
    text: str | bytes, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    lines = told(text, tmp_path, capsys)
    assert any(said in line for line in lines), lines
    assert all(line.startswith("robot.urdf:") for line in lines)


def test_attributes_that_exporters_add_are_left_out_in_words(tmp_path: Path) -> None:
    (tmp_path / "robot.urdf").write_text(with_joint('<dynamics D="1" K="7000" damping="2"/>'))
    scene = imported_scene(tmp_path / "robot.urdf")
    assert "joint 'j': left out of <dynamics>, being no attributes of URDF: D, K" in scene.decisions
    assert "damping = 2.0\n" in scene.text


@pytest.mark.parametrize(
    ("limit", "limits"),
    [
        ('lower="-2" upper="3"', "limits = [-2.0, 3.0]"),
        ('upper="3"', "limits = [0, 3.0]"),
        ('lower="-inf" upper="Infinity"', None),
        ('lower="-1" upper="inf"', None),
        ("", None),
    ],
)
def test_limits_that_are_none(limit: str, limits: str | None, tmp_path: Path) -> None:
    (tmp_path / "robot.urdf").write_text(
        with_joint(f'<limit {limit} effort="INF" velocity="2"/>', "revolute")
    )
    scene = imported_scene(tmp_path / "robot.urdf")
    assert "limits of velocity 2 rad/s are not simulated" in scene.decisions
    assert ("limits = " in scene.text) == (limits is not None)
    assert (limits or "") in scene.text
    assert any(words.startswith("no limits") for words in scene.decisions) == (limits is None)


def test_all_faults_are_told_by_line(tmp_path: Path) -> None:
    text = with_joint('\n<axis xyz="0 0"/>\n<origin xyz="a b c"/>', tail='<link name="b"><inertial/></link>')
    (tmp_path / "robot.urdf").write_text(text)
    with pytest.raises(UrdfError) as caught:
        imported_scene(tmp_path / "robot.urdf")
    assert [problem.line for problem in caught.value.problems] == [4, 5, 7, 7, 7]


def test_every_joint_that_cannot_be_is_refused_by_itself(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    more = "".join(
        f'<joint name="finger {k}" type="prismatic"><parent link="b"/><child link="f{k}"/></joint>\n'
        f'<link name="f{k}"/>\n'
        for k in (1, 2)
    )
    lines = told(with_joint("", tail=more), tmp_path, capsys)
    assert [line.split(":")[1] for line in lines] == ["5", "7"]
    assert '`[joint."finger 1"]` with `lock = 0.0`' in lines[0]


def test_the_remedy_for_joints_that_slide_works(tmp_path: Path) -> None:
    more = '<joint name="finger 1" type="prismatic"><parent link="b"/><child link="f"/><axis xyz="0 2 0"/></joint>'
    (tmp_path / "robot.urdf").write_text(with_joint("", tail=f'{more}<link name="f"/>'))
    (tmp_path / "lock.toml").write_text('[joint."finger 1"]\nlock = 0.25\n')
    scene = imported_scene(tmp_path / "robot.urdf", tmp_path / "lock.toml")
    assert 'name = "f"\non = "j"\nat = [0, 0.25, 0]\n' in scene.text
    assert "# prismatic joint 'finger 1' locked at 0.25 m merged into 'j'" in scene.text


def test_what_files_of_real_robots_hold_is_read(tmp_path: Path) -> None:
    """A robot without a name, an impossible inertia that is part of the clamp, and what rounding leaves of zero."""
    impossible = (
        '<inertial><mass value="1e-6"/><inertia ixx="2e-8" iyy="3e-8" izz="4e-8" ixy="6e-8"/></inertial>'
    )
    rounded = '<inertia ixx="0" iyy="4e-18" izz="0" ixy="1e-20"/>'
    link = f'<link name="c"><inertial><mass value="1"/>{rounded}</inertial></link>'
    joint = '<joint name="k" type="fixed"><parent link="b"/><child link="c"/></joint>'
    text = with_joint("", tail=f"{link}\n{joint}").replace(' name="arm"', "")
    (tmp_path / "robot.urdf").write_text(
        text.replace('<link name="a"/>', f'<link name="a">{impossible}</link>')
    )
    scene = imported_scene(tmp_path / "robot.urdf")
    (tmp_path / "scene.toml").write_text(scene.text)
    arm = load_scene(tmp_path / "scene.toml").spatial
    assert arm is not None
    assert [joint.body.mass for joint in arm.joints] == [2.0]
    assert "inertia left out: it is what rounding left of zero" in scene.text
    assert "link 'a' is part of the clamped base: its mass does nothing" in scene.decisions
    assert "the robot has no name: it is called after its file" in scene.decisions


@pytest.mark.parametrize("lock", ["lock", "rotor_inertia"])
def test_the_remedies_for_joints_that_carry_nothing_work(lock: str, tmp_path: Path) -> None:
    (tmp_path / "robot.urdf").write_text(
        with_joint("", tail=JOINT.format("").replace('"j"', '"k"').replace('"b"', '"c"') + '<link name="c"/>')
    )
    (tmp_path / "give.toml").write_text(f"[joint.k]\n{lock} = 0.01\n")
    assert "j" in imported_scene(tmp_path / "robot.urdf", tmp_path / "give.toml").motors


@pytest.mark.parametrize("name", ["nothing.urdf", "folder", "a/b"])
def test_files_that_cannot_be_read(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "folder").mkdir()
    (tmp_path / "a").write_text("")
    assert main(["import", str(tmp_path / name)]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert name in said


def test_deep_and_long_robots_are_no_problem(tmp_path: Path) -> None:
    deep = "<gazebo>" * 20_000 + "</gazebo>" * 20_000
    row = "".join(
        f'<link name="l{k}">{MASS}</link><joint name="k{k}" type="fixed"><parent link="{f"l{k - 1}" if k else "b"}"/>'
        f'<child link="l{k}"/></joint>'
        for k in range(3000)
    )
    (tmp_path / "robot.urdf").write_text(GOOD.replace("</robot>", f"{deep}{row}</robot>"))
    assert len(imported_scene(tmp_path / "robot.urdf").bodies) == 3001
