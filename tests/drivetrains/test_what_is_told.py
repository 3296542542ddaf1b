"""Faults of chains by parts, each with a remedy that is tried; and what the parts of a chain expand to."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pytest

from tmm_gen.scene import SceneError, load_scene, parse_scene
from tmm_gen.scene.template import template

TRAIN = """
name = "train"
[model]
kind = "chain"
[integrator]
name = "newmark"
step = 1e-4
[base]
kind = "clamp"

[[motor]]
name = "servo"
rotor_inertia = 6e-4
damping = 1e-3

[[joint]]
name = "coupling"
on = "servo"
stiffness = 150.0

[[link]]
name = "pinion"
on = "coupling"
inertia = 1e-4

[[gear]]
name = "first"
on = "pinion"
ratio = -4.0

[[link]]
name = "layshaft"
on = "first"
inertia = 2e-3

[[gear]]
name = "second"
on = "layshaft"
ratio = 5.0
stiffness = 6e4

[[link]]
name = "table"
on = "second"
inertia = 0.5

[[input]]
name = "torque"
at = "servo"
acts = "torque"

[[output]]
name = "table"
at = "table"
of = "angle"
"""


@dataclass(frozen=True)
class Case:
    """A change to a good scene, the complaint it must cause, and a remedy that is tried."""

    name: str
    old: str
    new: str
    key: str
    said: str
    cure: tuple[str, str]


LAST = '[[link]]\nname = "table"\non = "second"\ninertia = 0.5\n'
SERVO = '[[motor]]\nname = "servo"\nrotor_inertia = 6e-4\ndamping = 1e-3\n'
CASES = [
    Case(
        "no ratio",
        "ratio = 5.0",
        "ratio = 0.0",
        "gear[2].ratio",
        "turn without end",
        ("ratio = 0.0", "ratio = 5.0"),
    ),
    Case(
        "damping of a rigid gear",
        "ratio = -4.0",
        "ratio = -4.0\ndamping = 0.1",
        "gear[1].damping",
        "of teeth that give way",
        ("damping = 0.1", "stiffness = 2e4\ndamping = 0.1"),
    ),
    Case(
        "two springs",
        '[[link]]\nname = "pinion"\non = "coupling"\ninertia = 1e-4\n',
        '[[joint]]\nname = "pinion"\non = "coupling"\nstiffness = 10.0\n',
        "joint[2].on",
        "gives way straight behind [[joint]] 'coupling'",
        (
            '[[joint]]\nname = "pinion"\non = "coupling"\nstiffness = 10.0\n',
            '[[link]]\nname = "disc"\non = "coupling"\ninertia = 1e-4\n'
            '[[joint]]\nname = "pinion"\non = "disc"\nstiffness = 10.0\n',
        ),
    ),
    Case(
        "motor on a link",
        LAST,
        LAST + '[[motor]]\nname = "another"\non = "table"\nrotor_inertia = 1e-4\n'
        '[[link]]\nname = "end"\non = "another"\ninertia = 1e-3\n',
        "motor[2].on",
        "motors of a chain stand on the base",
        (
            '[[motor]]\nname = "another"\non = "table"\nrotor_inertia',
            '[[link]]\nname = "another"\non = "table"\ninertia',
        ),
    ),
    Case(
        "motor without inertia",
        "rotor_inertia = 6e-4\n",
        "",
        "motor[1].rotor_inertia",
        "nothing with inertia is fixed to this one",
        ('name = "servo"\n', 'name = "servo"\nrotor_inertia = 2e-5\n'),
    ),
    Case(
        "motor with an elastic gear",
        "rotor_inertia = 6e-4\n",
        "rotor_inertia = 6e-4\ngear = 3.0\nstiffness = 4e3\n",
        "motor[1].stiffness",
        "is a part of its own in a chain",
        ("gear = 3.0\nstiffness = 4e3\n", ""),
    ),
    Case(
        "motor on a motor",
        'kind = "clamp"',
        'kind = "motor"\ninertia = 0.1',
        "motor[1].on",
        "on a base that is a motor already",
        ('kind = "motor"\ninertia = 0.1', 'kind = "clamp"'),
    ),
    Case(
        "motor that nothing holds",
        'kind = "clamp"',
        'kind = "free"',
        "motor[1].on",
        "on a base that nothing holds",
        (
            '[[motor]]\nname = "servo"\nrotor_inertia = 6e-4\ndamping = 1e-3',
            '[[link]]\nname = "servo"\ninertia = 6e-4',
        ),
    ),
    Case(
        "free without inertia",
        f'kind = "clamp"\n\n{SERVO}',
        'kind = "free"\n\n[[gear]]\nname = "servo"\nratio = 2.0\n',
        "gear[1].on",
        "starts a chain that nothing holds with [[gear]] 'servo'",
        ('[[gear]]\nname = "servo"\nratio = 2.0', '[[link]]\nname = "servo"\ninertia = 1e-3'),
    ),
    Case(
        "hub of nothing",
        f'kind = "clamp"\n\n{SERVO}',
        'kind = "free"\ninertia = 0.1\n\n[[link]]\nname = "servo"\ninertia = 1e-3\n',
        "base.inertia",
        'contradicts kind = "free"',
        ("inertia = 0.1\n", ""),
    ),
    Case(
        "link on a clamp",
        SERVO,
        '[[link]]\nname = "servo"\ninertia = 1e-3\n',
        "link[1].on",
        "fixes 'servo' to the base",
        ('[[link]]\nname = "servo"\ninertia', '[[motor]]\nname = "servo"\nrotor_inertia'),
    ),
    Case(
        "carries nothing",
        LAST,
        "",
        "gear[2]",
        "'second' has no [[link]] on it",
        ("[[input]]", f"{LAST}[[input]]"),
    ),
    Case(
        "free joint",
        "stiffness = 150.0",
        "stiffness = 0.0",
        "joint[1].stiffness",
        "must be greater than 0",
        ("stiffness = 0.0", "stiffness = 300.0"),
    ),
    Case(
        "mass",
        "inertia = 0.5",
        "inertia = 0.5\nmass = 2.0",
        "link[3].mass",
        "a chain knows only the inertia",
        ("mass = 2.0", ""),
    ),
    Case(
        "body",
        LAST,
        LAST + '[[body]]\nname = "load"\non = "table"\ninertia = 0.1\n',
        "body[1]",
        "is for planar scenes",
        ("[[body]]", "[[link]]"),
    ),
    Case(
        "product",
        'kind = "chain"',
        'kind = "chain"\nsweep = "product"',
        "model.sweep",
        "is not derived over gears",
        ('"product"', '"riccati"'),
    ),
    Case(
        "torque at a joint",
        'at = "servo"',
        'at = "coupling"',
        "input[1].at",
        "no torque acts from outside",
        ('at = "coupling"\nacts', 'at = "pinion"\nacts'),
    ),
    Case(
        "torque on a clamp",
        'at = "servo"',
        'at = "base"',
        "input[1].at",
        "does not yield to it",
        ('at = "base"', 'at = "servo"'),
    ),
    Case(
        "unknown place",
        'at = "servo"',
        'at = "serv"',
        "input[1].at",
        "is not the name of a part",
        ('"serv"', '"servo"'),
    ),
    Case(
        "force",
        'acts = "torque"',
        'acts = "force_x"',
        "input[1].acts",
        "turns only",
        ('"force_x"', '"torque"'),
    ),
    Case(
        "angle of a motor",
        'acts = "torque"',
        'acts = "angle"',
        "input[1].acts",
        "has an angle that is given",
        ('acts = "angle"', 'acts = "torque"'),
    ),
    Case(
        "torque of a rigid gear",
        'at = "table"\nof = "angle"',
        'at = "first"\nof = "torque"',
        "output[1].at",
        "no law of its own",
        ("ratio = -4.0", "ratio = -4.0\nstiffness = 2e4"),
    ),
    Case(
        "angle of a gear",
        'at = "table"\nof = "angle"',
        'at = "second"\nof = "angle"',
        "output[1].of",
        "whose sides turn each for itself",
        ('of = "angle"', 'of = "torque"'),
    ),
    Case(
        "torque of a link",
        'at = "table"\nof = "angle"',
        'at = "table"\nof = "torque"',
        "output[1].of",
        "what has inertia in a chain has angle, rate, velocity, acceleration",
        ('of = "torque"', 'of = "rate"'),
    ),
    Case(
        "angle of a clamp",
        'at = "table"\nof',
        'at = "base"\nof',
        "output[1].at",
        "never moves",
        ('at = "base"', 'at = "servo"'),
    ),
    Case(
        "start against gears",
        "[[output]]",
        "[initial]\nangles = [0.4, 0.1, 0.0]\n\n[[output]]",
        "initial.angles",
        "does not fit rigid gears: per turn it is 1 of 'pinion', -0.25 of 'layshaft'",
        ("[0.4, 0.1, 0.0]", "[0.4, -0.1, 0.0]"),
    ),
    Case(
        "start of too few",
        "[[output]]",
        "[initial]\nrates = [0.4, 0.1]\n\n[[output]]",
        "initial.rates",
        "has 2 numbers for 3 links",
        ("[0.4, 0.1]", "[0.4, -0.1, 0.0]"),
    ),
    Case(
        "start of what is on the base",
        'name = "coupling"\non = "servo"\nstiffness = 150.0\n',
        'name = "coupling"\non = "flange"\nstiffness = 150.0\n[[link]]\nname = "flange"\non = "servo"\n'
        "inertia = 1e-4\n[initial]\nangles = [0.4, 0.4, -0.1, 0.0]\n",
        "initial.angles",
        "moves 'flange', which turns with the base",
        ("[0.4, 0.4, -0.1, 0.0]", "[0.0, 0.4, -0.1, 0.0]"),
    ),
    Case(
        "numbers out of range",
        "ratio = -4.0",
        "ratio = 1e-200",
        "gear",
        "out of the range of numbers",
        ("1e-200", "4.0"),
    ),
    Case(
        "backlash",
        "ratio = 5.0",
        "ratio = 5.0\nbacklash = 1e-3",
        "gear[2].backlash",
        "teeth are always in mesh",
        ("backlash = 1e-3", ""),
    ),
    Case(
        "friction",
        "damping = 1e-3",
        "coulomb-friction = 0.1",
        "motor[1].coulomb-friction",
        "damping is viscous",
        ("coulomb-friction", "damping"),
    ),
    Case(
        "cubic spring",
        "stiffness = 150.0",
        "stiffness = 150.0\ncubic_stiffness = 3.0",
        "joint[1].cubic_stiffness",
        "springs and dampers are linear",
        ("cubic_stiffness = 3.0", ""),
    ),
]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_faults_are_told_and_remedies_work(case: Case) -> None:
    assert TRAIN.count(case.old) >= 1
    text = TRAIN.replace(case.old, case.new, 1)
    with pytest.raises(SceneError) as raised:
        parse_scene(text, "train.toml")
    problems = [p for p in raised.value.problems if p.key == case.key]
    assert problems, str(raised.value)
    assert case.said in str(problems[0])
    assert problems[0].line > 0
    assert problems[0].remedy
    cured = text.replace(*case.cure, 1)
    assert cured != text
    parse_scene(cured)


@pytest.mark.parametrize("kind", ["chain", "planar"])
def test_nonlinear_joints_of_old_are_refused_in_the_same_words(kind: str) -> None:
    link = "inertia = 1.0" + ("\nmass = 1.0\nlength = 1.0" if kind == "planar" else "")
    text = (
        f'name = "a"\n[model]\nkind = "{kind}"\n[integrator]\nname = "newmark"\nstep = 1e-3\n[base]\nkind = "clamp"\n'
        f"[[joint]]\nstiffness = 1.0\nstiction = 0.1\n[[link]]\n{link}\n"
        '[[output]]\nname = "tip"\nat = "tip"\nof = "angle"\n'
    )
    with pytest.raises(SceneError, match=r"joint.*stiction.*damping is viscous.*let an"):
        parse_scene(text)
    parse_scene(text.replace("stiction", "damping"))


def test_a_chain_that_turns_as_one_is_refused() -> None:
    text = TRAIN.replace('[[joint]]\nname = "coupling"\non = "servo"\nstiffness = 150.0\n', "").replace(
        'on = "coupling"', 'on = "servo"'
    )
    with pytest.raises(SceneError, match=r"link\[3\]: makes a chain that turns as one"):
        parse_scene(text.replace("stiffness = 6e4\n", ""))
    assert parse_scene(text).stations == 1  # the remedy: teeth with stiffness


def test_what_a_train_expands_to(repository: Path) -> None:
    scene = load_scene(repository / "scenes" / "geartrain.toml")
    assert (scene.base.kind, scene.base.inertia, scene.base.damping) == ("motor", 6e-4, 1e-3)
    # pinion with layshaft, four times slower; the teeth carry the ratio of the second stage
    assert [link.inertia for link in scene.links] == [1.2e-4 + 2.4e-3 / 16, 8e-4, 1.1e-2, 0.65]
    assert [joint.stiffness for joint in scene.joints] == [150.0, 60.0, 6e4, 2.5e3]
    assert [joint.ratio for joint in scene.joints] == [1.0, -4.0, 20.0, 1.0]
    assert scene.turns == (1.0, -4.0, 20.0, 20.0)
    assert scene.hosts == (0, 1, 1, 3)
    assert [(p.name, p.joint, p.last) for p in scene.parts] == [
        ("servo", 0, 0),
        ("coupling", 1, 0),
        ("pinion", 0, 1),
        ("layshaft", 0, 1),
        ("belt", 2, 0),
        ("feeder", 0, 2),
        ("second", 3, 0),
        ("wheel", 0, 3),
        ("shaft", 4, 0),
        ("table", 0, 4),
    ]


def test_order_in_the_file_does_not_matter() -> None:
    head, *tables = TRAIN.split("\n[[")
    parts = [t for t in tables if not t.startswith(("input", "output"))]
    others = [t for t in tables if t not in parts]
    assert parse_scene("\n[[".join([head, *parts[::-1], *others])) == parse_scene(TRAIN)


def test_a_gear_behind_a_spring_refers_the_spring_to_what_it_turns() -> None:
    text = TRAIN.replace('name = "pinion"\non = "coupling"', 'name = "pinion"\non = "before"')
    text += '[[gear]]\nname = "before"\non = "coupling"\nratio = 3.0\n'
    text += '[[output]]\nname = "twist"\nat = "coupling"\nof = "torque"\n'
    scene = parse_scene(text)
    assert (scene.joints[0].stiffness, scene.joints[0].ratio) == (150.0 * 9.0, 3.0)
    # three times less on the coupling than on the pinion; the inner side exerts it on the outer one
    assert scene.outputs[1].factor == pytest.approx(-1.0 / 3.0)


def test_links_on_links_add_up() -> None:
    more = '[[link]]\nname = "disc"\non = "table"\ninertia = 0.25\n'
    assert parse_scene(TRAIN + more).links[-1].inertia == 0.75


def test_keys_change_by_the_names_of_parts() -> None:
    scene = parse_scene(TRAIN).replace(**{"gear.first.ratio": 8.0, "gear.second.stiffness": 100.0})
    assert scene.turns == (1.0, 40.0)
    assert scene.joints[1].stiffness == 100.0


@pytest.mark.parametrize(
    "text", [template("a", "planar", motors=1), template("a", "spatial")], ids=["plane", "space"]
)
@pytest.mark.parametrize(
    ("key", "said"), [("backlash", "teeth are always in mesh"), ("coulomb_friction", "damping is viscous")]
)
def test_motors_of_arms_are_refused_so_too(key: str, said: str, text: str) -> None:
    """In the words of drivetrains; without the key, as these say first, it is a scene."""
    line = next(line for line in text.splitlines() if line.startswith("gear = "))
    with pytest.raises(SceneError, match=rf"motor.*{key}: .*{said}.*Remove it"):
        parse_scene(text.replace(line, f"{line}\n{key} = 0.1", 1))
    parse_scene(text)
