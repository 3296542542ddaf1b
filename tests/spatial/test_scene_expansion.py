"""What parts in space expand to, against homogeneous matrices and integrals along the beams."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from support import parts_in_space as apart

from tmm_gen.scene import Scene, load_scene, parse_scene
from tmm_gen.scene.section import Section
from tmm_gen.scene.spatial.arm import UPRIGHT, Revolute, RigidBody, SpatialArm
from tmm_gen.scene.spatial.beam import torsion_constant

SCENES = sorted((Path(__file__).parents[2] / "examples" / "space").glob("*.toml"))

HEAD = """
name = "a"
[model]
kind = "spatial"
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "clamp"
"""
BEAM = """
[[beam]]
name = "b"
length = 0.6
bending_stiffness = [3.0, 5.0]
torsional_stiffness = 2.0
mass_per_length = 0.5
polar_inertia_per_length = 1e-4
links = 3
damping_time = 0.01
"""
TIP = '\n[[output]]\nname = "tip"\nat = "{}"\nof = "position"\n'


def arm_of(scene: Scene) -> SpatialArm:
    assert scene.spatial is not None
    return scene.spatial


def arm(text: str) -> SpatialArm:
    return arm_of(parse_scene(text))


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_numbering(path: Path) -> None:
    scene = load_scene(path)
    joints = arm_of(scene).joints
    assert scene.stations == len(joints) > 0
    assert (scene.joints, scene.links, scene.parts) == ((), (), ())
    columns = [column for item in arm_of(scene).inputs for column in item.columns]
    assert [item.name for item in scene.inputs] == columns
    assert [item.name for item in scene.outputs] == [item.name for item in arm_of(scene).outputs]
    assert all(joint.host < number for number, joint in enumerate(joints, start=1))
    assert len({joint.name for joint in joints}) == len(joints)


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_frames_stand_where_the_parts_end(path: Path) -> None:
    """At zero angles, and at any others: joints turn about the axes that the parts have."""
    text, made = path.read_text(), arm_of(load_scene(path))
    parts = apart.parts_of(text)
    rng = np.random.default_rng(5)
    numbers = {joint.name: k for k, joint in enumerate(made.joints) if joint.name in parts}
    assert numbers.keys() == {name for name, part in parts.items() if part["kind"] in ("motor", "joint")}
    for scale in (0.0, 1.0):
        angles = np.zeros(len(made.joints))
        angles[list(numbers.values())] = scale * rng.uniform(-3, 3, len(numbers))
        ends = apart.placed(parts, {name: angles[k] for name, k in numbers.items()})
        frames = apart.joint_frames(made, angles)
        assert {frame.name for frame in made.frames} == set(parts)
        for frame in made.frames:
            own = np.eye(4)
            own[:3, :3], own[:3, 3] = frame.turn, frame.at
            assert frames[frame.joint] @ own == pytest.approx(ends[frame.name][1], abs=1e-14)


def numbered(text: str) -> str:
    """Return the text of a scene whose beams have numbers instead of material and section."""
    text = text.replace("material = { young = 70e9, density = 2700 }", "")
    text = text.replace("material = { young = 2e6, density = 1100, shear = 0.68e6 }", "")
    for section, outer, inner, density in (
        ('section = { kind = "tube", diameter = 0.03, thickness = 0.001 }', 0.03, 0.028, 2700),
        ('section = { kind = "circle", diameter = 0.012 }', 0.012, 0.0, 1100),
    ):
        area, second = np.pi / 4 * (outer**2 - inner**2), np.pi / 64 * (outer**4 - inner**4)
        polar = float(2 * density * second)
        numbers = f"mass_per_length = {density * area}\npolar_inertia_per_length = {polar}"
        text = text.replace(section, numbers)
    return text


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_mass_centre_and_inertia_of_the_whole_arm(path: Path) -> None:
    """Second moments of mass about the base, from the joints' bodies and by integration over the parts."""
    made = arm_of(load_scene(path))
    total = np.zeros((4, 4))
    for joint, frame in zip(
        made.joints, apart.joint_frames(made, np.zeros(len(made.joints)))[1:], strict=True
    ):
        total += frame @ apart.body_pseudo_inertia(joint.body) @ frame.T
    expected = apart.weighed(apart.parts_of(numbered(path.read_text())))
    assert expected[3, 3] > 0
    assert total == pytest.approx(expected, rel=1e-12, abs=1e-15)


def test_cells_of_a_beam() -> None:
    joints = arm(HEAD + BEAM + TIP.format("b")).joints
    piece = 0.2
    assert [joint.name for joint in joints] == [
        *("b_1_bend_y", "b_1_bend_z", "b_1_twist"),
        *("b_2_twist", "b_2_bend_z", "b_2_bend_y"),
        *("b_3_bend_y", "b_3_bend_z", "b_3_twist"),
    ]
    stiffness = {1: 3.0 / piece, 2: 5.0 / piece, 0: 2.0 / piece}
    for number, joint in enumerate(joints):
        assert joint.axis == {"y": 1, "z": 2, "t": 0}[joint.name.rpartition("_")[2][0]]
        assert joint.stiffness == pytest.approx(stiffness[joint.axis], rel=1e-15)
        assert joint.damping == pytest.approx(0.01 * joint.stiffness, rel=1e-15)
        assert joint.host == number
        assert joint.turn == UPRIGHT
        first = number % 3 == 0
        # from the clamp half a piece, between cells a whole one
        assert joint.at == ((0.1 if number == 0 else 0.2) if first else 0.0, 0.0, 0.0)
        if number % 3 < 2:
            assert joint.body == RigidBody()
    whole, half = joints[2].body, joints[-1].body
    mass = 0.5 * piece
    assert whole.mass == pytest.approx(mass)
    assert whole.center == pytest.approx((piece / 2, 0, 0))
    assert whole.inertia == pytest.approx((1e-4 * piece, *(mass * piece**2 / 12,) * 2, 0, 0, 0), rel=1e-14)
    assert half.mass == pytest.approx(mass / 2)
    assert half.center == pytest.approx((piece / 4, 0, 0))
    assert half.inertia == pytest.approx(
        (1e-4 * piece / 2, *(mass / 2 * (piece / 2) ** 2 / 12,) * 2, 0, 0, 0), rel=1e-14
    )


def test_without_twist_two_joints_alternate() -> None:
    text = BEAM.replace("torsional_stiffness = 2.0\n", "").replace("[3.0, 5.0]", "4")
    joints = arm(HEAD + text + TIP.format("b")).joints
    assert [joint.axis for joint in joints] == [1, 2, 2, 1, 1, 2]
    assert {joint.stiffness for joint in joints} == {20.0}


def test_cells_that_turn_alike_turn_as_one_rod_because_their_joints_alternate() -> None:
    """Turns do not commute; what that leaves cancels between neighbours, and adds up in a fixed order."""

    def direction(axes: list[int], angles: dict[int, float]) -> np.ndarray:
        made = np.eye(3)
        for axis in axes:
            made = made @ apart.moved((0, 0, 0), angles[axis] * np.eye(3)[axis])[:3, :3]
        return made

    joints = arm(HEAD + BEAM.replace("links = 3", "links = 40") + TIP.format("b")).joints
    angles = {0: 0.4 / 40, 1: 0.3 / 40, 2: 0.5 / 40}
    exact = apart.Rotation.from_rotvec((0.4, 0.3, 0.5)).as_matrix()
    alternating = direction([joint.axis for joint in joints], angles)
    fixed = direction([1, 2, 0] * 40, angles)
    assert np.abs(alternating - exact).max() < 0.05 * np.abs(fixed - exact).max()


def test_rectangles_bend_about_their_thin_side_and_twist_as_saint_venant_has_it() -> None:
    stuff = "material = { young = 70e9, density = 2700, shear = 26e9 }\n"
    section = 'section = { kind = "rectangle", width = 0.03, thickness = 0.004 }\n'
    text = BEAM.split("bending")[0] + stuff + section + "links = 1\n"
    joints = {joint.name: joint for joint in arm(HEAD + text + TIP.format("b")).joints}
    thin, wide = 0.03 * 0.004**3 / 12, 0.004 * 0.03**3 / 12
    assert joints["b_1_bend_y"].stiffness == pytest.approx(70e9 * thin / 0.6)
    assert joints["b_1_bend_z"].stiffness == pytest.approx(70e9 * wide / 0.6)
    assert joints["b_1_twist"].body.inertia[0] == pytest.approx(2700 * (thin + wide) * 0.3)
    assert joints["b_1_twist"].stiffness == pytest.approx(
        26e9 * torsion_by_differences(0.03, 0.004) / 0.6, rel=2e-3
    )
    untwisted = text.replace(", shear = 26e9", "")
    assert [joint.axis for joint in arm(HEAD + untwisted + TIP.format("b")).joints] == [1, 2]


def torsion_by_differences(width: float, thickness: float, points: int = 40) -> float:
    """Return the torsion constant by Prandtl's membrane: twice the volume under what solves ``laplace(phi) = -2``."""
    from scipy.sparse import diags_array as diags
    from scipy.sparse import identity, kron
    from scipy.sparse.linalg import spsolve

    n, m = points, 4 * points
    hy, hx = thickness / n, width / m

    def second(k: int, h: float) -> object:
        return (
            diags([np.full(k - 2, 1.0), np.full(k - 1, -2.0), np.full(k - 2, 1.0)], offsets=[-1, 0, 1]) / h**2
        )

    laplace = kron(second(n, hy), identity(m - 1)) + kron(identity(n - 1), second(m, hx))
    return float(2 * spsolve(laplace.tocsc(), np.full((n - 1) * (m - 1), -2.0)).sum() * hx * hy)


def test_torsion_of_slender_and_square_rectangles_and_of_tubes() -> None:
    def constant(**measures: float) -> float:
        return float(torsion_constant(Section.model_validate({"kind": "rectangle", **measures})))

    assert constant(width=1.0, thickness=1e-4) == pytest.approx(1e-12 / 3, rel=1e-4)
    assert constant(width=0.5, thickness=0.5) == pytest.approx(torsion_by_differences(0.5, 0.5), rel=2e-3)
    assert constant(width=0.2, thickness=0.7) == constant(width=0.7, thickness=0.2)
    tube = Section.model_validate({"kind": "tube", "diameter": 0.03, "thickness": 0.001})
    assert float(torsion_constant(tube)) == pytest.approx(np.pi / 32 * (0.03**4 - 0.028**4), rel=1e-12)


def test_motors_and_joints() -> None:
    text = """
[[motor]]
name = "m"
at = [0.1, 0.2, 0.3]
axis = "y"
rotor_inertia = 2e-5
gear = 50
damping = 0.3
limits = [-1.0, 2.0]
[[joint]]
name = "j"
on = "m"
at = [0, 0.4, 0]
axis = [0, 0, 2]
stiffness = 30.0
damping = 0.2
rest = 0.1
[[body]]
name = "t"
on = "j"
mass = 2.0
center = [0.3, 0, 0]
inertia = [0.1, 0.2, 0.3, 0.01, 0.02, 0.03]
[initial]
angles = { j = 0.4 }
rates = { m = -0.5 }
"""
    made = arm(HEAD + text + TIP.format("t"))
    assert made.joints == (
        Revolute(
            "m",
            0,
            (0.1, 0.2, 0.3),
            axis=1,
            armature=0.05,
            gear=50.0,
            damping=0.3,
            rate=-0.5,
            limits=(-1.0, 2.0),
        ),
        Revolute(
            "j",
            1,
            (0.0, 0.4, 0.0),
            axis=2,
            body=RigidBody(2.0, (0.3, 0.0, 0.0), (0.1, 0.2, 0.3, 0.01, 0.02, 0.03)),
            stiffness=30.0,
            damping=0.2,
            rest=0.1,
            angle=0.4,
        ),
    )
    both = arm(HEAD + text.replace("angles = { j = 0.4 }", "angles = 0.7") + TIP.format("t"))
    assert [joint.angle for joint in both.joints] == [0.7, 0.7]


def test_inputs_and_outputs() -> None:
    signals = """
[[motor]]
name = "m"
axis = "z"
rotor_inertia = 1e-3
[[link]]
name = "l"
on = "m"
length = 0.5
mass = 1.0
[[input]]
name = "t"
at = "m"
acts = "torque"
[[input]]
name = "f"
at = "l"
acts = "force"
[[input]]
name = "c"
at = "m"
acts = "moment"
in = "body"
[[output]]
name = "a"
at = "m"
of = "acceleration"
[[output]]
name = "q"
at = "l"
of = "orientation"
[[output]]
name = "e"
at = "arm"
of = "kinetic_energy"
"""
    made = arm(HEAD + signals)
    frames = {frame.name: frame for frame in made.frames}
    assert frames["l"].at == (0.5, 0.0, 0.0)
    assert made.joints[0].body.center == (0.25, 0.0, 0.0)
    told = [(item.acts, item.joint, item.frame, item.axes, item.columns) for item in made.inputs]
    assert told[0] == ("torque", 1, None, "body", ("t",))
    assert told[1] == ("force", 0, frames["l"], "world", ("f_x", "f_y", "f_z"))
    assert told[2] == ("moment", 0, frames["m"], "body", ("c_x", "c_y", "c_z"))
    read = [(item.of, item.joint, item.frame, item.columns) for item in made.outputs]
    assert read == [
        ("acceleration", 1, None, ("a",)),
        ("orientation", 0, frames["l"], ("q_w", "q_x", "q_y", "q_z")),
        ("kinetic_energy", 0, None, ("e",)),
    ]


@pytest.mark.parametrize(
    ("integrator", "model", "expected"),
    [
        ("newmark", "", ("inertial", 2)),
        ("sdirk4", "", ("inertial", 3)),
        ("sdirk4", 'linearisation = "newton"\n', ("newton", 1)),
        ("bathe", "iterations = 5\n", ("inertial", 5)),
        ("newmark", 'iterations = "auto"\n', ("inertial", 2)),
    ],
)
def test_how_it_is_solved(integrator: str, model: str, expected: tuple[str, int]) -> None:
    text = HEAD.replace('kind = "spatial"\n', f'kind = "spatial"\n{model}').replace("newmark", integrator)
    scene = parse_scene(text + BEAM + TIP.format("b"))
    assert (scene.model.linearisation, scene.model.sweeps) == expected
    assert scene.model.kind == "spatial"
    assert scene.model.auto == ("5" not in model)
    assert scene.model.gravity is None
    assert arm_of(scene).gravity == (0.0, 0.0, 0.0)


def test_what_is_fixed_to_the_base_does_not_move() -> None:
    post = '\n[[link]]\nname = "post"\nend = [0, 0, 1]\nmass = 50.0\n'
    text = BEAM.replace('name = "b"', 'name = "b"\non = "post"')
    made = arm(HEAD + post + text + TIP.format("b"))
    alone = arm(HEAD + BEAM + TIP.format("b"))
    assert made.joints[0].at == (0.1, 0.0, 1.0)
    assert sum(joint.body.mass for joint in made.joints) == sum(joint.body.mass for joint in alone.joints)
    assert {frame.name: frame.joint for frame in made.frames} == {"post": 0, "b": 9}
