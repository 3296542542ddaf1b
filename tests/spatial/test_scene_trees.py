"""Trees drawn at random: mass, places and axes are kept, frames are chosen as they should be."""

from __future__ import annotations

import json
import tomllib
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support import parts_in_space as apart

from tmm_gen.scene import Scene, SceneError, parse_scene
from tmm_gen.scene.check import check_data, document_of
from tmm_gen.scene.locate import locate
from tmm_gen.scene.source import Source
from tmm_gen.scene.spatial.arm import UPRIGHT, Turn
from tmm_gen.scene.spatial.articulated import pivots
from tmm_gen.scene.spatial.document import SpatialDocument
from tmm_gen.scene.spatial.geometry import applied, floats, joint_frame, turned, unit

QUARTER = 1.5707963267948966
ANGLES = st.one_of(
    st.sampled_from([0.0, QUARTER, -QUARTER, 2 * QUARTER, 3 * QUARTER]),
    st.floats(-3.0, 3.0).map(lambda x: round(x, 3)),  # none that is all but a quarter turn
)
LENGTHS = st.floats(-1.0, 1.0).map(lambda x: round(x, 3))
VECTORS = st.tuples(LENGTHS, LENGTHS, LENGTHS).map(list)
AXES = st.one_of(st.sampled_from(["x", "y", "z"]), VECTORS.filter(lambda v: float(np.abs(v).max()) > 0.05))
MASSES = st.floats(0.0, 5.0).map(lambda x: round(x, 3))

HEAD = 'name = "a"\n[model]\nkind = "spatial"\n[integrator]\nname = "newmark"\nstep = 1e-3\n[base]\nkind = "clamp"\n'


@st.composite
def trees(draw: st.DrawFn, turns: st.SearchStrategy[float] = ANGLES) -> str:
    """Return the text of an arm of 2 to 9 parts, each on one before it or on the base; the first one moves."""
    text, names = HEAD, ["base"]
    for number in range(draw(st.integers(2, 9))):
        kind = draw(st.sampled_from(["motor", "joint", "beam", "link", "body"])) if number else "motor"
        name = f"p{number}"
        part: dict[str, Any] = {"name": name, "on": draw(st.sampled_from(names)), "at": draw(VECTORS)}
        part["turn"] = [draw(turns) for _ in range(3)]
        if kind in ("motor", "joint"):
            part["axis"] = draw(AXES)
            part |= {"rotor_inertia": 1e-3, "gear": 10} if kind == "motor" else {"stiffness": 5.0}
        elif kind == "beam":
            part |= {"length": 0.5, "bending_stiffness": [2.0, 3.0], "mass_per_length": 0.4, "links": 2}
            part["polar_inertia_per_length"] = 1e-4
            if draw(st.booleans()):
                part["torsional_stiffness"] = 1.5
        else:
            part |= {"mass": draw(MASSES), "inertia": [2e-3, 3e-3, 4e-3, 1e-4, -2e-4, 3e-4]}
            part |= {"end": draw(VECTORS)} if kind == "link" else {"center": draw(VECTORS)}
        text += f"[[{kind}]]\n" + "".join(f"{key} = {json.dumps(value)}\n" for key, value in part.items())
        if kind == "joint":  # nothing that turns is without inertia
            text += f'[[body]]\nname = "b{number}"\non = "{name}"\ninertia = [1e-3, 1e-3, 1e-3]\n'
        names.append(name)
    return text + '[[output]]\nname = "y"\nat = "p0"\nof = "angle"\n'


def spatial(text: str) -> tuple[Scene, Any]:
    scene = parse_scene(text)
    assert scene.spatial is not None
    return scene, scene.spatial


@given(trees(), st.integers(0, 2**31))
@settings(max_examples=60, deadline=None)
def test_places_and_second_moments_are_those_of_the_parts(text: str, seed: int) -> None:
    _, made = spatial(text)
    parts = apart.parts_of(text)
    rng = np.random.default_rng(seed)
    angles = np.zeros(len(made.joints))
    for k, joint in enumerate(made.joints):
        if joint.name in parts:
            angles[k] = rng.uniform(-3, 3)
    by_name = {joint.name: angle for joint, angle in zip(made.joints, angles, strict=True)}
    for turned_by, given_angles in ((0 * angles, {}), (angles, by_name)):
        frames = apart.joint_frames(made, turned_by)
        ends = apart.placed(parts, given_angles)
        for frame in made.frames:
            own = np.eye(4)
            own[:3, :3], own[:3, 3] = frame.turn, frame.at
            assert frames[frame.joint] @ own == pytest.approx(ends[frame.name][1], abs=1e-11)
        total = sum(
            (
                f @ apart.body_pseudo_inertia(j.body) @ f.T
                for j, f in zip(made.joints, frames[1:], strict=True)
            ),
            np.zeros((4, 4)),
        )
        expected = apart.weighed(parts, given_angles)
        assert total == pytest.approx(expected, abs=1e-11 * max(1.0, float(np.abs(expected).max())))


@given(trees())
@settings(max_examples=60, deadline=None)
def test_numbers_follow_each_branch_to_its_end(text: str) -> None:
    _, made = spatial(text)
    hosts = [joint.host for joint in made.joints]
    assert all(host < number for number, host in enumerate(hosts, start=1))
    behind = [{number} for number in range(len(hosts) + 1)]
    for number in range(len(hosts), 0, -1):
        behind[hosts[number - 1]] |= behind[number]
    for subtree in behind[1:]:
        assert subtree == set(range(min(subtree), max(subtree) + 1))


@given(trees(st.sampled_from([0.0, QUARTER, -QUARTER, 2 * QUARTER])))
@settings(max_examples=60, deadline=None)
def test_quarter_turns_have_exact_entries(text: str) -> None:
    """Where all turns are quarter turns and axes are frame axes, every matrix has zeros and ones alone."""
    lines = [('axis = "y"' if line.startswith("axis = [") else line) for line in text.splitlines()]
    _, made = spatial("\n".join(lines) + "\n")
    turns: list[Turn] = [*(joint.turn for joint in made.joints), *(frame.turn for frame in made.frames)]
    for turn in turns:
        assert {abs(value) for row in turn for value in row} == {0.0, 1.0}
        assert np.linalg.det(turn) == 1.0


@given(trees(), st.integers(0, 2**31))
@settings(max_examples=40, deadline=None)
def test_what_joints_have_to_turn_is_in_the_mass_matrix(text: str, seed: int) -> None:
    """The pivots' product is the determinant; with all other joints locked they are on the diagonal."""
    rng = np.random.default_rng(seed)
    parts = apart.parts_of(text)
    turning = [name for name, part in parts.items() if part["kind"] in ("motor", "joint")]
    moved = ", ".join(f"{name} = {rng.uniform(-3, 3):.3f}" for name in turning)
    _, made = spatial(text.replace("[[output]]", f"[initial]\nangles = {{ {moved} }}\n[[output]]"))
    found = pivots(made.joints)
    matrix = apart.mass_matrix(made, np.array([joint.angle for joint in made.joints]))
    assert [pivot.locked for pivot in found] == pytest.approx(np.diag(matrix), rel=1e-9)
    # eliminated from the tips inward: each is what the ones behind it leave
    left = matrix.copy()
    for k in range(len(left) - 1, -1, -1):
        assert found[k].free == pytest.approx(left[k, k], rel=1e-6)
        left[:k, :k] -= np.outer(left[:k, k], left[k, :k]) / left[k, k]
    least = pivots(made.joints, nearest_only=True)
    assert all(low.free <= pivot.free * (1 + 1e-9) for low, pivot in zip(least, found, strict=True))


@given(st.tuples(ANGLES, ANGLES, ANGLES), VECTORS.filter(lambda v: float(np.abs(v).max()) > 0.05))
@settings(max_examples=200, deadline=None)
def test_a_joint_turns_about_the_axis_it_was_given(angles: tuple[float, ...], axis: list[float]) -> None:
    placed, direction = turned(angles), unit(axis)
    number, turn = joint_frame(placed, direction)
    matrix = np.array(floats(turn))
    assert matrix @ matrix.T == pytest.approx(np.eye(3), abs=1e-14)
    assert np.linalg.det(matrix) == pytest.approx(1.0)
    seen = np.array([float(value) for value in applied(placed, direction)])
    assert matrix[:, number] == pytest.approx(seen, abs=1e-11)


@pytest.mark.parametrize(
    ("angles", "axis", "expected"),
    [
        ((0, 0, 0), (0, 0, 1), (2, UPRIGHT)),
        # the other way round: by half a turn, about x where that can be
        ((0, 0, 0), (0, 0, -1), (2, ((1, 0, 0), (0, -1, 0), (0, 0, -1)))),
        ((0, 0, 0), (0, -2, 0), (1, ((1, 0, 0), (0, -1, 0), (0, 0, -1)))),
        ((0, 0, 0), (-1, 0, 0), (0, ((-1, 0, 0), (0, -1, 0), (0, 0, 1)))),
        # by a quarter turn the part keeps its own axes
        ((QUARTER, 0, 0), (0, 0, 1), (2, ((1, 0, 0), (0, 0, -1), (0, 1, 0)))),
        # turned about its own axis by any angle: the host's axes will do
        ((0, 0, 0.3), (0, 0, 1), (2, UPRIGHT)),
    ],
)
def test_frames_that_need_no_general_turn(
    angles: tuple[float, ...], axis: tuple[float, ...], expected: tuple[int, Turn]
) -> None:
    number, turn = joint_frame(turned(angles), unit(axis))
    assert (number, floats(turn)) == expected


def test_a_general_axis_takes_one_or_two_turns_about_frame_axes() -> None:
    for axis, zeros in (((1, 2, 0), 4), ((1, 0, 2), 4), ((0, 1, 2), 4), ((1, 2, 3), 1)):
        _, turn = joint_frame(turned((0, 0, 0)), unit(axis))
        assert sum(value == 0 for row in floats(turn) for value in row) == zeros


def test_one_general_axis_is_enough_for_joints_that_are_parallel() -> None:
    chain = "".join(
        f'[[motor]]\nname = "m{k}"\non = "{f"m{k - 1}" if k else "base"}"\nat = [0.1, 0, 0]\naxis = [1, 2, 3]\n'
        "rotor_inertia = 1e-3\n"
        for k in range(4)
    )
    _, made = spatial(HEAD + chain + '[[output]]\nname = "y"\nat = "m3"\nof = "angle"\n')
    assert [joint.turn == UPRIGHT for joint in made.joints] == [False, True, True, True]


def test_angles_written_with_twelve_digits_are_quarter_turns_and_those_with_five_are_not() -> None:
    for written, exact in (
        ("1.57079632679", False),
        ("1.570796326795", True),
        ("1.5708", False),
        ("3.14159265359", True),
    ):
        values = {abs(value) for row in floats(turned((float(written), 0, 0))) for value in row}
        assert (values == {0.0, 1.0}) == exact


@given(trees())
@settings(max_examples=30, deadline=None)
def test_a_joint_with_nothing_to_turn_is_refused_where_the_mass_matrix_is_singular(text: str) -> None:
    light = text.replace("rotor_inertia = 0.001", "rotor_inertia = 0.0")
    light = "\n".join(line for line in light.splitlines() if line != "inertia = [1e-3, 1e-3, 1e-3]") + "\n"
    document = document_of(Source("a.toml", tomllib.loads(light), locate(light), check_data))
    assert isinstance(document, SpatialDocument)
    matrix = apart.mass_matrix(document.arm, np.zeros(document.stations))
    scale = np.sqrt(np.maximum(np.diag(matrix), 1e-30))
    singular = bool(np.linalg.eigvalsh(matrix / np.outer(scale, scale)).min() < 1e-11)
    if not singular:
        parse_scene(light)
        return
    with pytest.raises(SceneError, match="carries nothing that has inertia about the axis of"):
        parse_scene(light)
