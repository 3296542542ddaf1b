"""Parts by name: what they expand to, in any order, and how faults are told."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest

from tmm_gen.scene import Scene, SceneError, parse_scene
from tmm_gen.scene.template import template


def blocks(text: str) -> tuple[str, list[str]]:
    head, *rest = text.split("\n[[")
    return head, ["\n[[" + block for block in rest]


def test_order_in_the_file_does_not_matter(elbow_text: str) -> None:
    head, tables = blocks(elbow_text)
    parts = [t for t in tables if "input" not in t and "output" not in t]
    others = [t for t in tables if t not in parts]
    turned = parse_scene(head + "".join([*parts[::-1], *others]))
    assert turned == parse_scene(elbow_text)


def test_what_an_arm_expands_to(elbow_text: str) -> None:
    scene = parse_scene(elbow_text)
    places = [(p.name, p.joint, p.first, p.last) for p in scene.parts]
    assert places == [
        ("shoulder", 1, 0, 0),
        ("upper", 0, 1, 3),
        ("housing", 0, 3, 3),
        ("elbow", 4, 0, 0),
        ("forearm", 0, 4, 4),
        ("hinge", 5, 0, 0),
        ("hand", 0, 5, 5),
        ("tool", 0, 5, 5),
    ]
    # half pieces at both ends, springs EI/l at the cuts, the motors' joints without springs
    assert [link.length for link in scene.links] == [0.125, 0.25, 0.125, 0.3, 0.1]
    assert [joint.stiffness for joint in scene.joints] == [0.0, 14.0 / 0.25, 14.0 / 0.25, 0.0, 3.0]
    assert [joint.armature for joint in scene.joints] == pytest.approx([0.2, 0.0, 0.0, 0.025, 0.0])
    assert scene.joints[-1].rest == 0.2
    assert scene.tip is not None
    assert (scene.tip.mass, scene.tip.inertia) == (0.1, 1e-4)
    # the housing is part of the last piece: total mass, first and second moment about the piece's inner end
    piece, mass = scene.links[2], 0.16 * 0.125
    assert piece.mass == pytest.approx(mass + 0.2)
    assert piece.mass * piece.center * 0.125 == pytest.approx(mass * 0.0625 + 0.2 * 0.125)
    about_end = piece.inertia + piece.mass * (piece.center * 0.125) ** 2
    assert about_end == pytest.approx(mass * 0.125**2 / 3 + 1e-4 + 0.2 * 0.125**2)
    assert [(i.at, i.acts) for i in scene.inputs] == [
        (1, "drive"),
        (4, "drive"),
        (5, "drive"),
        (4, "force_y"),
    ]


@pytest.mark.parametrize("rule", ["", "clamped-segment", "half-clamp", "uniform", "thesis"])
def test_a_beam_on_the_base_is_cut_like_the_beam_of_the_short_form(rule: str) -> None:
    text = 'name = "a"\n[model]\nkind = "planar"\n[integrator]\nname = "newmark"\nstep = 1e-3\n[base]\nkind = "clamp"\n'
    beam = "length = 1.0\nbending_stiffness = 3.0\nmass_per_length = 0.5\nlinks = 4\n"
    output = '[[output]]\nname = "tip"\nat = "tip"\nof = "position"\n'
    cut = f'springs = "{rule}"\n' if rule else ""
    old = parse_scene(f"{text}[beam]\n{beam}{cut}[tip]\nmass = 0.2\n{output}")
    new = parse_scene(f'{text}[[beam]]\nname = "b"\n{beam}{cut}[[body]]\nname = "t"\nmass = 0.2\n{output}')
    assert (new.joints, new.links, new.tip, new.outputs) == (old.joints, old.links, old.tip, old.outputs)


def test_links_fixed_to_each_other_are_one_rigid_body(elbow_text: str) -> None:
    text = elbow_text.replace('[[joint]]\nname = "hinge"\non = "forearm"\nstiffness = 3.0\nrest = 0.2\n', "")
    text = text.replace('on = "hinge"', 'on = "forearm"').replace('at = "hinge"', 'at = "elbow"')
    text = text.replace('at = "forearm"', 'at = "hand"')
    scene = parse_scene(text)
    assert scene.links[-1].length == pytest.approx(0.4)
    assert scene.links[-1].mass == pytest.approx(0.25)
    assert scene.links[-1].mass * scene.links[-1].center * 0.4 == pytest.approx(0.2 * 0.12 + 0.05 * 0.35)


@pytest.mark.parametrize("motors", [1, 2, 4])
def test_the_template_is_a_scene(motors: int) -> None:
    scene = parse_scene(template("picker", "planar", motors=motors))
    assert sum(part.kind == "motor" for part in scene.parts) == motors
    assert scene.stations == 4 * motors


def test_a_section_can_be_set_by_the_name_of_its_beam() -> None:
    scene = parse_scene(template("picker", "planar", motors=2))
    changed = scene.replace(**{"beam.arm2.section.thickness": 0.01})  # twice as thick: eight times as stiff
    assert changed.joints[5].stiffness == 8 * scene.joints[5].stiffness
    assert changed.joints[:5] == scene.joints[:5]


def test_initial_angles_are_by_part(elbow_text: str) -> None:
    scene = parse_scene(elbow_text + "\n[initial]\nangles = [0.1, 0.2, 0.3]\n")
    assert scene.initial.angles == (0.1, 0.1, 0.1, 0.2, 0.3)
    assert np.all(np.array(scene.initial.rates) == 0.0)


def test_initial_angles_by_name_do_not_depend_on_the_order_of_branches(elbow_text: str) -> None:
    # in a list the branch behind a motor comes before that behind a joint, wherever the file has them
    branch = '[[joint]]\nname = "pin"\non = "upper"\n[[link]]\nname = "flap"\non = "pin"\n'
    branch += "length = 0.1\nmass = 0.1\ninertia = 1e-4\n"
    angles = {"flap": 0.4, "hand": 0.3, "forearm": 0.2, "upper": 0.1}
    for text in (
        branch + elbow_text[elbow_text.index("[[") :],
        elbow_text[elbow_text.index("[[") :] + branch,
    ):
        said = ", ".join(f"{name} = {value}" for name, value in angles.items())
        scene = parse_scene(
            elbow_text[: elbow_text.index("[[")] + text + f"\n[initial]\nangles = {{ {said} }}\n"
        )
        for part in scene.parts:
            if part.kind in ("beam", "link"):
                assert set(scene.initial.angles[part.first - 1 : part.last]) == {angles[part.name]}


@dataclass(frozen=True)
class Case:
    """A change to a good scene, the complaint it must cause, and a remedy that is tried."""

    name: str
    old: str
    new: str
    key: str
    said: str
    cure: tuple[str, str]


CASES = [
    Case(
        "branch",
        'on = "hinge"',
        'on = "elbow"',
        "link[2].on",
        "puts a second part on [[motor]]",
        ('on = "elbow"\nlength = 0.1', 'on = "hinge"\nlength = 0.1'),
    ),
    Case(
        "two on the base",
        'name = "elbow"\non = "upper"',
        'name = "elbow"',
        "motor[2].on",
        "already carries 'shoulder'",
        ('name = "elbow"\n', 'name = "elbow"\non = "upper"\n'),
    ),
    Case(
        "loop",
        'name = "elbow"\non = "upper"',
        'name = "elbow"\non = "hand"',
        "motor[2].on",
        "closes a loop: 'elbow' on 'hand' on 'hinge' on 'forearm' on 'elbow'",
        ('on = "hand"\nrotor', 'on = "upper"\nrotor'),
    ),
    Case(
        "unknown part",
        'on = "hinge"',
        'on = "hing"',
        "link[2].on",
        "is not the name of a part",
        ('"hing"', '"hinge"'),
    ),
    Case(
        "same name",
        'name = "hand"',
        'name = "elbow"',
        "link[2].name",
        "is already the name of [[motor]] number 2",
        ('name = "elbow"\non = "hinge"', 'name = "hand"\non = "hinge"'),
    ),
    Case(
        "place's name",
        'name = "tool"',
        'name = "base"',
        "body[2].name",
        "is the name of a place",
        ('name = "base"', 'name = "tool"'),
    ),
    Case(
        "elastic gear without a rotor",
        "rotor_inertia = 1e-5\ngear = 50",
        "gear = 50\nstiffness = 4000.0",
        "motor[2].rotor_inertia",
        "cannot turn without inertia",
        ("\nstiffness = 4000.0", ""),
    ),
    Case(
        "joint on motor",
        'on = "elbow"\nlength',
        'on = "hinge"\nlength',
        "link[2].on",
        "puts a second part on [[joint]]",
        ('on = "hinge"\nlength = 0.3', 'on = "elbow"\nlength = 0.3'),
    ),
    Case(
        "joint on a motor",
        '[[link]]\nname = "forearm"\non = "elbow"',
        '[[joint]]\nname = "x"\non = "elbow"\n\n[[link]]\nname = "forearm"\non = "x"',
        "joint[1].on",
        "two that turn need a part between",
        (
            '[[joint]]\nname = "x"\non = "elbow"\n',
            '[[link]]\nname = "x"\non = "elbow"\nlength = 0.1\nmass = 0.1\ninertia = 1e-4\n',
        ),
    ),
    Case(
        "link on the base",
        'on = "elbow"\nlength = 0.3',
        'on = "base"\nlength = 0.3',
        "link[1].on",
        "where it could not move",
        ('on = "base"\nlength', 'on = "elbow"\nlength'),
    ),
    Case(
        "body on a motor",
        'on = "hand"',
        'on = "elbow"',
        "body[2].on",
        "sits on a beam's or a link's outer end",
        ('on = "elbow"\nmass', 'on = "hand"\nmass'),
    ),
    Case(
        "clamped beam on a motor",
        "links = 2",
        'links = 2\nsprings = "half-clamp"',
        "beam[1].springs",
        "where [[motor]] 'shoulder' turns it",
        ('"half-clamp"', '"finite-segment"'),
    ),
    Case(
        "force at a motor",
        'at = "elbow"\nacts = "torque"',
        'at = "elbow"\nacts = "force_x"',
        "input[2].acts",
        "torque between both sides",
        ('"force_x"', '"torque"'),
    ),
    Case(
        "unknown place",
        'at = "tool"',
        'at = "tol"',
        "output[1].at",
        "is not the name of a part",
        ('"tol"', '"tool"'),
    ),
    Case(
        "number for a place",
        'at = "tool"',
        "at = 3",
        "output[1].at",
        "must be the name of a part",
        ("at = 3", 'at = "tool"'),
    ),
    Case(
        "place of a joint",
        'at = "tool"',
        'at = "elbow"',
        "output[1].of",
        "cannot be position at motor 'elbow'",
        ('at = "elbow"\nof = "position"', 'at = "elbow"\nof = "angle"'),
    ),
    Case(
        "torque of a frame",
        'of = "position"',
        'of = "torque"',
        "output[1].of",
        "it is joints that pass on a torque",
        ('at = "tool"\nof', 'at = "hinge"\nof'),
    ),
    Case(
        "tip",
        '[[motor]]\nname = "shoulder"',
        '[tip]\nmass = 0.1\n\n[[motor]]\nname = "shoulder"',
        "tip",
        "does not go with parts",
        ("[tip]\nmass = 0.1\n", ""),
    ),
    Case(
        "chain",
        'kind = "planar"',
        'kind = "chain"',
        "joint[1].rest",
        "is not a key of [[joint]]",
        ('kind = "chain"', 'kind = "planar"'),
    ),
    Case(
        "gear",
        '[[motor]]\nname = "shoulder"',
        '[[gear]]\nname = "g"\non = "hand"\nratio = 3.0\n\n[[motor]]\nname = "shoulder"',
        "gear[1]",
        "gears of a planar arm are in its motors",
        ('[[gear]]\nname = "g"\non = "hand"\nratio = 3.0\n', ""),
    ),
    Case(
        "thesis",
        "gravity = 9.81",
        'gravity = 9.81\nlinearisation = "taylor"',
        "model.linearisation",
        "knows no parts",
        ('\nlinearisation = "taylor"', ""),
    ),
    Case(
        "torque on a clamp",
        'at = "shoulder"',
        'at = "base"',
        "input[1].at",
        "does not yield",
        ('at = "base"', 'at = "shoulder"'),
    ),
    Case(
        "free base",
        'kind = "clamp"',
        'kind = "free"',
        "base.kind",
        "nothing on it has the inertia to turn",
        ('"free"', '"clamp"'),
    ),
    Case(
        "initial",
        "[[output]]",
        "[initial]\nangles = [0.1, 0.2]\n\n[[output]]",
        "initial.angles",
        "has 2 numbers for 3 beams and links",
        ("[0.1, 0.2]", "[0.1, 0.2, 0.3]"),
    ),
    Case(
        "initial by a wrong name",
        "[[output]]",
        "[initial]\nangles = { uper = 0.1, forearm = 0.2, hand = 0.3 }\n\n[[output]]",
        "initial.angles.uper",
        "is not the name of a beam or link",
        ("uper", "upper"),
    ),
    Case(
        "initial leaves out",
        "[[output]]",
        "[initial]\nrates = { forearm = 0.2 }\n\n[[output]]",
        "initial.rates",
        "leaves out upper, hand",
        ("forearm = 0.2", "forearm = 0.2, upper = 0, hand = 0"),
    ),
    Case(
        "damping of a spring that is not there",
        "gear = 50",
        "gear = 50\ndamping_time = 1e-3",
        "motor[2].damping_time",
        "without `stiffness` the gear is rigid",
        ("gear = 50\n", "gear = 50\nstiffness = 100.0\n"),
    ),
    Case(
        "where to hang it",
        'on = "hinge"\nlength',
        "length",
        "link[2].on",
        'for example `on = "hinge"`',
        ('name = "hand"\n', 'name = "hand"\non = "hinge"\n'),
    ),
    Case(
        "two on a motor, one of which turns",
        'name = "hinge"\non = "forearm"',
        'name = "hinge"\non = "elbow"',
        "joint[1].on",
        "Hang it on 'forearm'",
        ('name = "hinge"\non = "elbow"', 'name = "hinge"\non = "forearm"'),
    ),
    Case(
        "no name",
        'name = "hinge"\n',
        "",
        "joint[1].name",
        "is missing",
        ("[[joint]]\n", '[[joint]]\nname = "hinge"\n'),
    ),
    Case(
        "heavy numbers",
        "rotor_inertia = 1e-5\ngear = 50",
        "rotor_inertia = 1e-5\ngear = 1e200",
        "motor[2].gear",
        "out of the range",
        ("1e200", "50"),
    ),
]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_faults_are_told_and_remedies_work(case: Case, elbow_text: str) -> None:
    assert elbow_text.count(case.old) >= 1
    text = elbow_text.replace(case.old, case.new, 1)
    with pytest.raises(SceneError) as raised:
        parse_scene(text, "arm.toml")
    problems = [p for p in raised.value.problems if p.key == case.key]
    assert problems, str(raised.value)
    assert case.said in str(problems[0])
    assert problems[0].line > 0
    assert problems[0].remedy
    cured = text.replace(*case.cure, 1)
    assert cured != text
    parse_scene(cured)


def test_a_part_on_itself_is_no_branch_besides(elbow_text: str) -> None:
    with pytest.raises(SceneError) as raised:
        parse_scene(elbow_text.replace('name = "shoulder"\n', 'name = "shoulder"\non = "shoulder"\n', 1))
    (problem,) = raised.value.problems
    assert "closes a loop: 'shoulder' on 'shoulder'" in str(problem)


def test_numbers_of_parts_change_by_name(elbow_text: str) -> None:
    changed = parse_scene(elbow_text).replace(**{"motor.elbow.gear": 7.0, "body.tool.mass": 0.25})
    assert [joint.gear for joint in changed.joints if joint.rotor_inertia] == [100.0, 7.0]
    assert changed.tip is not None
    assert changed.tip.mass == 0.25


def test_drawn_arms_are_scenes(drawn: Callable[..., Scene]) -> None:
    assert all(drawn(seed, 2 + seed % 7).stations >= 1 for seed in range(10))


def test_initial_angles_by_name_are_for_chains_by_parts_too() -> None:
    head = 'name = "d"\n[model]\nkind = "chain"\n[integrator]\nname = "newmark"\nstep = 1e-3\n[base]\nkind = "clamp"\n'
    links = '[[joint]]\nname = "s"\nstiffness = 9.0\n[[link]]\nname = "a"\non = "s"\ninertia = 1e-2\n'
    links += (
        '[[joint]]\nname = "t"\non = "a"\nstiffness = 9.0\n[[link]]\nname = "b"\non = "t"\ninertia = 1e-2\n'
    )
    output = '[[output]]\nname = "o"\nat = "b"\nof = "angle"\n[initial]\n'
    assert parse_scene(f"{head}{links}{output}angles = {{ b = 0.2, a = 0.1 }}\n").initial.angles == (0.1, 0.2)
    with pytest.raises(SceneError, match=r"initial\.rates: leaves out a"):
        parse_scene(f"{head}{links}{output}rates = {{ b = 0.2 }}\n")


@pytest.mark.parametrize("length", [5e-324, 1e-320, 1e-310, 1e160, 1.7e308])
def test_lengths_out_of_range_when_cut(length: float) -> None:
    """A piece's length or inertia is rounded to nothing, or infinite: a fault of the scene, whatever rule finds it."""
    text = f"""
name = "speck"
[model]
kind = "planar"
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "clamp"
[[beam]]
name = "speck"
length = {length}
bending_stiffness = 1.0
mass_per_length = 1.0
links = 4
"""
    with pytest.raises(SceneError):
        parse_scene(text)
