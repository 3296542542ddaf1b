"""Faults of arms in space: each is told with file, line, key and value, and its remedy is tried."""

from __future__ import annotations

from dataclasses import dataclass

import pytest

from tmm_gen.scene import SceneError, parse_scene

ARM = """\
name = "a"

[model]
kind = "spatial"
gravity = [0, 0, -9.81]

[integrator]
name = "newmark"
step = 1e-3

[base]
kind = "clamp"

[[motor]]
name = "yaw"
axis = "z"
rotor_inertia = 2e-5
gear = 100

[[link]]
name = "column"
on = "yaw"
end = [0, 0, 0.3]
mass = 1.0
inertia = [1e-2, 1e-2, 1e-3]

[[joint]]
name = "hinge"
on = "column"
axis = "y"
stiffness = 50.0

[[beam]]
name = "boom"
on = "hinge"
length = 0.5
bending_stiffness = [15.0, 10.0]
torsional_stiffness = 8.0
mass_per_length = 0.6
polar_inertia_per_length = 1e-4
links = 3

[[body]]
name = "tool"
on = "boom"
mass = 0.3
inertia = [1e-3, 1e-3, 5e-4, 1e-5, 0, 0]

[[input]]
name = "torque"
at = "yaw"
acts = "torque"

[[input]]
name = "push"
at = "tool"
acts = "force"

[[output]]
name = "tool"
at = "tool"
of = "position"

[[output]]
name = "yaw"
at = "yaw"
of = "angle"

[initial]
angles = { hinge = 0.2 }
"""

MOTOR = '[[motor]]\nname = "yaw"'
COLUMN = (
    '[[link]]\nname = "column"\non = "yaw"\nend = [0, 0, 0.3]\nmass = 1.0\ninertia = [1e-2, 1e-2, 1e-3]\n'
)


@dataclass(frozen=True)
class Case:
    """A change to a good scene, the complaint it must cause, and the remedy it names, which is tried."""

    old: str
    new: str
    key: str
    message: str
    remedy: str
    cure: tuple[str, str]
    others: int = 0
    """Further complaints that the change causes."""


CASES = {
    "unknown part": Case(
        'on = "hinge"',
        'on = "hing"',
        "beam[1].on",
        "is not the name of a part",
        "Did you mean 'hinge'?",
        ('"hing"', '"hinge"'),
    ),
    "same name": Case(
        'name = "tool"\non',
        'name = "boom"\non',
        "body[1].name",
        "is already the name of [[beam]] number 1",
        "'boom_2'",
        ('name = "boom"\non = "boom"', 'name = "tool"\non = "boom"'),
    ),
    "name of a beam's joint": Case(
        'name = "tool"\non',
        'name = "boom_3_bend_y"\non',
        "body[1].name",
        "is the name of a joint in [[beam]] 'boom'",
        "'boom_3_bend_y_2'",
        ('name = "boom_3_bend_y"', 'name = "tool"'),
    ),
    "name of a place": Case(
        'name = "tool"\non',
        'name = "base"\non',
        "body[1].name",
        "is the name of a place",
        "'base_1'",
        ('name = "base"', 'name = "tool"'),
    ),
    "loop": Case(
        'on = "column"',
        'on = "tool"',
        "joint[1].on",
        "closes a loop: 'hinge' on 'tool' on 'boom' on 'hinge'; arms in space are trees",
        "Let one of them hang on the base or on another part.",
        ('on = "tool"', 'on = "base"'),
        2,
    ),
    "closed loop by two hosts": Case(
        'on = "column"',
        'on = ["column", "tool"]',
        "joint[1].on",
        "must be the name of a part",
        "Write a name in quotes",
        ('["column", "tool"]', '"column"'),
    ),
    "two on the base without a word": Case(
        'name = "boom"\non = "hinge"',
        'name = "boom"',
        "beam[1].on",
        "is missing: the base already carries 'yaw'",
        'for example `on = "hinge"`',
        ('name = "boom"', 'name = "boom"\non = "hinge"'),
    ),
    "nothing moves": Case(
        ARM[ARM.index("[[motor]]") :],
        '[[body]]\nname = "rock"\non = "yaw"\n\n[[link]]\nname = "yaw"\nlength = 1.0\n'
        '[[output]]\nname = "y"\nat = "yaw"\nof = "velocity"\n',
        "motor",
        "is missing: nothing in this arm moves",
        'Add [[motor]] with `name = "yaw"`',
        (
            '[[link]]\nname = "yaw"',
            '[[motor]]\nname = "yaw"\naxis = "z"\nrotor_inertia = 1e-3\n[[link]]\nname = "stick"\non = "yaw"',
        ),
    ),
    "number for gravity": Case(
        "[0, 0, -9.81]",
        "9.81",
        "model.gravity",
        "must be a vector in space",
        "`gravity = [0, 0, -9.81]`",
        ("gravity = 9.81", "gravity = [0, 0, -9.81]"),
    ),
    "moon by a number": Case(
        "[0, 0, -9.81]",
        "1.62",
        "model.gravity",
        "must be a vector in space",
        "`gravity = [0, 0, -1.62]`",
        ("gravity = 1.62", "gravity = [0, 0, -1.62]"),
    ),
    "linearisation of the thesis": Case(
        "gravity",
        'linearisation = "taylor"\ngravity',
        "model.linearisation",
        "is not one of the choices",
        "inertial, newton",
        ('"taylor"', '"inertial"'),
    ),
    "iterations": Case(
        "gravity",
        "iterations = 0\ngravity",
        "model.iterations",
        'must be "auto" or a whole number from 1',
        '`iterations = "auto"`',
        ("iterations = 0", 'iterations = "auto"'),
    ),
    "product sweep": Case(
        "gravity",
        'sweep = "product"\ngravity',
        "model.sweep",
        "is not one of the choices",
        "riccati",
        ('"product"', '"riccati"'),
    ),
    "unknown": Case(
        "gravity",
        'unknown = "increment"\ngravity',
        "model.unknown",
        "is not one of the choices",
        "acceleration",
        ('"increment"', '"acceleration"'),
    ),
    "floating base": Case(
        'kind = "clamp"',
        'kind = "floating"',
        "base.kind",
        "is not there yet for arms in space",
        'Write `kind = "clamp"`',
        ('"floating"', '"clamp"'),
    ),
    "free base": Case(
        'kind = "clamp"',
        'kind = "free"',
        "base.kind",
        "is not there yet for arms in space",
        'Write `kind = "clamp"`',
        ('"free"', '"clamp"'),
    ),
    "prescribed base": Case(
        'kind = "clamp"',
        'kind = "prescribed"',
        "base.kind",
        "is not there yet for arms in space",
        "let a [[motor]] on it move the arm",
        ('"prescribed"', '"clamp"'),
    ),
    "motor as a base": Case(
        'kind = "clamp"',
        'kind = "motor"',
        "base.kind",
        "is a short form for arms in a plane",
        "hang a [[motor]] on it",
        ('"motor"', '"clamp"'),
    ),
    "hub": Case(
        'kind = "clamp"',
        'kind = "clamp"\ninertia = 0.1',
        "base.inertia",
        "is that of a hub",
        "Remove it.",
        ("\ninertia = 0.1", ""),
    ),
    "axis": Case(
        'axis = "z"',
        'axis = "w"',
        "motor[1].axis",
        'must be "x", "y", "z" or a vector other than zero',
        '`axis = "z"`',
        ('"w"', '"z"'),
    ),
    "no axis": Case(
        'axis = "z"\n',
        "",
        "motor[1].axis",
        "is missing",
        '`axis = "z"`',
        (MOTOR, MOTOR + '\naxis = "z"'),
    ),
    "axis of length zero": Case(
        'axis = "z"',
        "axis = [0, 0, 0]",
        "motor[1].axis",
        "a vector other than zero",
        "`axis = [0, 1, 1]`",
        ("[0, 0, 0]", "[0, 1, 1]"),
    ),
    "place": Case(
        MOTOR,
        MOTOR + "\nat = 0.2",
        "motor[1].at",
        "must be three finite numbers",
        "`[0.0, 0.0, 0.2]`",
        ("at = 0.2", "at = [0.0, 0.0, 0.2]"),
    ),
    "limits": Case(
        MOTOR,
        MOTOR + "\nlimits = [2.0, -2.0]",
        "motor[1].limits",
        "the lower first",
        "`limits = [-2.0, 2.0]`",
        ("[2.0, -2.0]", "[-2.0, 2.0]"),
    ),
    "elastic gear": Case(
        "gear = 100",
        "gear = 100\nstiffness = 900.0",
        "motor[1].stiffness",
        "is that of an elastic gear",
        'put a [[joint]] with `on = "yaw"`, the same axis and `stiffness = 900`',
        (
            'stiffness = 900.0\n\n[[link]]\nname = "column"\non = "yaw"',
            '[[joint]]\nname = "gear"\non = "yaw"\naxis = "z"\nstiffness = 900\n'
            '\n[[link]]\nname = "column"\non = "gear"',
        ),
    ),
    "rotor's damping": Case(
        "gear = 100",
        "gear = 100\nmotor_damping = 1e-4",
        "motor[1].motor_damping",
        "is that of an elastic gear",
        "`damping` at the output is gear^2 times that of the rotor",
        ("motor_damping = 1e-4", "damping = 1.0"),
    ),
    "damping time of a gear": Case(
        "gear = 100",
        "gear = 100\ndamping_time = 1e-4",
        "motor[1].damping_time",
        "is that of an elastic gear",
        "Remove it",
        ("\ndamping_time = 1e-4", ""),
    ),
    "friction": Case(
        "gear = 100",
        "gear = 100\nfriction = 1.0",
        "motor[1].friction",
        "damping is viscous",
        "Remove it",
        ("\nfriction = 1.0", ""),
    ),
    "three bending stiffnesses": Case(
        "[15.0, 10.0]",
        "[15.0, 10.0, 8.0]",
        "beam[1].bending_stiffness",
        "must be a number greater than 0, or two",
        "`bending_stiffness = [15.0, 15.0]`",
        ("[15.0, 10.0, 8.0]", "[15.0, 15.0]"),
    ),
    "twist without inertia": Case(
        "polar_inertia_per_length = 1e-4\n",
        "",
        "beam[1].polar_inertia_per_length",
        "is missing beside torsional_stiffness",
        "`polar_inertia_per_length = 1e-4`",
        ("mass_per_length", "polar_inertia_per_length = 1e-4\nmass_per_length"),
    ),
    "twist without inertia, left out": Case(
        "polar_inertia_per_length = 1e-4\n",
        "",
        "beam[1].polar_inertia_per_length",
        "is missing beside torsional_stiffness",
        "or remove torsional_stiffness",
        ("torsional_stiffness = 8.0\n", ""),
    ),
    "twist twice": Case(
        "bending_stiffness = [15.0, 10.0]\ntorsional_stiffness = 8.0\nmass_per_length = 0.6\n"
        "polar_inertia_per_length = 1e-4",
        "torsional_stiffness = 8.0\nmaterial = { young = 70e9, density = 2700, shear = 26e9 }\n"
        'section = { kind = "circle", diameter = 0.01 }',
        "beam[1].torsional_stiffness",
        "does not go with material",
        "Remove it.",
        ("torsional_stiffness = 8.0\n", ""),
    ),
    "mass and material": Case(
        "torsional_stiffness = 8.0\nmass_per_length = 0.6\npolar_inertia_per_length = 1e-4",
        'material = { young = 70e9, density = 2700 }\nsection = { kind = "circle", diameter = 0.01 }',
        "beam[1].bending_stiffness",
        "does not go with material",
        "alone",
        ("bending_stiffness = [15.0, 10.0]\n", ""),
    ),
    "one beam in single brackets": Case(
        "[[beam]]",
        "[beam]",
        "beam",
        "must be an array of tables",
        "Write [[beam]] with double brackets.",
        ("[beam]", "[[beam]]"),
    ),
    "spring rule": Case(
        "links = 3",
        'links = 3\nsprings = "uniform"',
        "beam[1].springs",
        "is not a key of [[beam]]",
        "Keys of [[beam]] are",
        ('\nsprings = "uniform"', ""),
    ),
    "link without an end": Case(
        "end = [0, 0, 0.3]\n",
        "",
        "link[1].length",
        "is missing",
        "`length = 0.4`",
        ("mass = 1.0", "length = 0.4\nmass = 1.0"),
    ),
    "link with two ends": Case(
        "end = [0, 0, 0.3]\n",
        "end = [0, 0, 0.3]\nlength = 0.3\n",
        "link[1].length",
        "say the same thing twice",
        "Remove one of them.",
        ("length = 0.3\n", ""),
    ),
    "centre by a fraction": Case(
        "mass = 1.0",
        "mass = 1.0\ncenter = 0.5",
        "link[1].center",
        "must be three finite numbers",
        "[0.0, 0.0, 0.2]",
        ("center = 0.5", "center = [0.0, 0.0, 0.2]"),
    ),
    "inertia by a number": Case(
        "[1e-2, 1e-2, 1e-3]",
        "1e-2",
        "link[1].inertia",
        "must be three finite numbers, or six",
        "`inertia = [1e-3, 1e-3, 5e-4]`",
        ("inertia = 1e-2", "inertia = [1e-3, 1e-3, 5e-4]"),
    ),
    "negative moment of inertia": Case(
        "[1e-2, 1e-2, 1e-3]",
        "[1e-2, -1e-2, 1e-3]",
        "link[1].inertia",
        "has a negative moment of inertia",
        "Write numbers that are not negative",
        ("-1e-2", "1e-2"),
    ),
    "inertia of no body": Case(
        "5e-4, 1e-5, 0, 0]",
        "5e-4, 1e-2, 0, 0]",
        "body[1].inertia",
        "is that of no body",
        "`[0.001, 0.001, 0.0005]`",
        ("[1e-3, 1e-3, 5e-4, 1e-2, 0, 0]", "[0.001, 0.001, 0.0005]"),
    ),
    "negative mass": Case(
        "mass = 0.3",
        "mass = -0.3",
        "body[1].mass",
        "must be at least 0",
        "`mass = 0.3`",
        ("-0.3", "0.3"),
    ),
    "out of range": Case(
        "rotor_inertia = 2e-5\ngear = 100",
        "rotor_inertia = 1e200\ngear = 1e100",
        "motor[1]",
        "leads to a rotor inertia of inf at 'yaw'",
        "Check the units",
        ("rotor_inertia = 1e200\ngear = 1e100", "rotor_inertia = 2e-5"),
    ),
    "out of range by sums": Case(
        "mass = 0.3",
        "mass = 1e308\ncenter = [1e200, 0, 0]",
        "beam[1]",
        "leads to a moment of inertia of inf",
        "Check the units",
        ("mass = 1e308\ncenter = [1e200, 0, 0]", "mass = 0.3"),
    ),
    "ends out of range": Case(
        "end = [0, 0, 0.3]",
        "end = [0, 0, 1e308]\nat = [0, 0, 1e308]",
        "link[1]",
        "ends beyond the range",
        "Check the units",
        ("end = [0, 0, 1e308]\nat = [0, 0, 1e308]", "end = [0, 0, 0.3]"),
        -1,
    ),
    "too many cells": Case(
        "links = 3",
        "links = 40000",
        "beam[1].links",
        "leads to 120002 joints",
        "Write fewer.",
        ("40000", "4"),
    ),
    "gear": Case(
        MOTOR,
        '[[gear]]\nname = "g"\nratio = 3.0\n\n' + MOTOR,
        "gear[1]",
        "gears of an arm are in its motors",
        "in a [[motor]]",
        ('[[gear]]\nname = "g"\nratio = 3.0\n', ""),
    ),
    "tip": Case(
        MOTOR,
        "[tip]\nmass = 0.1\n\n" + MOTOR,
        "tip",
        "does not go with parts by name",
        "Write a [[body]]",
        ("[tip]\nmass = 0.1\n", '[[body]]\nname = "more"\non = "tool"\nmass = 0.1\n'),
    ),
    "sensitivities": Case(
        MOTOR,
        "[emit]\nsensitivities = true\n\n" + MOTOR,
        "emit.sensitivities",
        "are not generated of arms in space yet",
        "Remove it",
        ("sensitivities = true\n", ""),
    ),
    "compensated": Case(
        MOTOR,
        '[emit]\nreal = "float32"\ncompensated = true\n\n' + MOTOR,
        "emit.compensated",
        "is not there yet for arms in space",
        'Remove it; `real = "float64"`',
        ('real = "float32"\ncompensated = true', 'real = "float64"'),
    ),
    "box": Case(
        MOTOR,
        "[emit.box]\nangles = [-1.0, 1.0]\n\n" + MOTOR,
        "emit.box",
        "is not there yet for arms in space",
        "Remove it.",
        ("[emit.box]\nangles = [-1.0, 1.0]\n", ""),
    ),
    "setting of a language that is not emitted": Case(
        MOTOR,
        '[emit]\nbackends = ["numpy"]\nreal = "float32"\n\n' + MOTOR,
        "emit.real",
        "is for the C code",
        'Add "c"',
        ('["numpy"]', '["numpy", "c"]'),
    ),
    "integrator": Case(
        'name = "newmark"',
        'name = "newmak"',
        "integrator.name",
        "is not a known integrator",
        "Did you mean 'newmark'?",
        ("newmak", "newmark"),
    ),
    "parameter of another integrator": Case(
        "step = 1e-3",
        "step = 1e-3\nrho_inf = 0.8",
        "integrator.rho_inf",
        "is not a parameter of newmark",
        "belongs to generalized_alpha",
        ('"newmark"', '"generalized_alpha"'),
    ),
    "input at an unknown place": Case(
        'at = "tool"\nacts',
        'at = "tol"\nacts',
        "input[2].at",
        "is not the name of a part",
        "Did you mean 'tool'?",
        ('"tol"', '"tool"'),
    ),
    "input at the base": Case(
        'at = "tool"\nacts',
        'at = "base"\nacts',
        "input[2].at",
        "cannot be the base, which never moves",
        "Name a part.",
        ('at = "base"', 'at = "boom"'),
    ),
    "input at the whole arm": Case(
        'at = "tool"\nacts',
        'at = "arm"\nacts',
        "input[2].at",
        "an input acts at one place",
        "Name a part.",
        ('at = "arm"', 'at = "boom"'),
    ),
    "torque of a frame": Case(
        'at = "tool"\nacts = "force"',
        'at = "tool"\nacts = "torque"',
        "input[2].acts",
        "a torque acts in a motor or a joint",
        '`acts = "moment"`',
        ('at = "tool"\nacts = "torque"', 'at = "tool"\nacts = "moment"'),
    ),
    "axes of a torque": Case(
        'acts = "torque"',
        'acts = "torque"\nin = "body"',
        "input[1].in",
        "is for forces and moments",
        "Remove it.",
        ('\nin = "body"', ""),
    ),
    "unknown axes": Case(
        'acts = "force"',
        'acts = "force"\nin = "word"',
        "input[2].in",
        "is not one of the choices",
        "Did you mean 'world'?",
        ('"word"', '"world"'),
    ),
    "force along x": Case(
        'acts = "force"',
        'acts = "force_x"',
        "input[2].acts",
        "is not one of the choices",
        "Did you mean 'force'?",
        ('"force_x"', '"force"'),
    ),
    "force on what is fixed": Case(
        'at = "tool"\nacts = "force"',
        'at = "post"\nacts = "force"\n\n[[link]]\nname = "post"\non = "base"\nlength = 1.0',
        "input[2].at",
        "never moves: [[link]] 'post' is fixed to the base",
        '`at = "yaw"`',
        ('at = "post"', 'at = "yaw"'),
    ),
    "no output": Case(
        ARM[ARM.index("[[output]]") : ARM.index("[initial]")],
        "",
        "output",
        "is missing",
        '`at = "tool"`, `of = "position"`',
        ("[initial]", '[[output]]\nname = "tip"\nat = "tool"\nof = "position"\n[initial]'),
    ),
    "angle of a body": Case(
        'of = "position"',
        'of = "angle"',
        "output[1].of",
        "cannot be angle at [[body]] 'tool'",
        "position, orientation, velocity",
        ('at = "tool"\nof = "angle"', 'at = "tool"\nof = "orientation"'),
    ),
    "energy of a part": Case(
        'of = "position"',
        'of = "kinetic_energy"',
        "output[1].at",
        'must be "arm" for kinetic_energy',
        "The arm as a whole has",
        ('at = "tool"\nof', 'at = "arm"\nof'),
    ),
    "position of the arm": Case(
        'at = "tool"\nof',
        'at = "arm"\nof',
        "output[1].at",
        'cannot be "arm" for position',
        "all else belongs to a part",
        ('at = "arm"\nof', 'at = "tool"\nof'),
    ),
    "output at the base": Case(
        'at = "tool"\nof',
        'at = "base"\nof',
        "output[1].at",
        "cannot be the base, which never moves",
        "Name a part.",
        ('at = "base"\nof', 'at = "boom"\nof'),
    ),
    "output at an unknown place": Case(
        'at = "tool"\nof',
        'at = "tolo"\nof',
        "output[1].at",
        "is not the name of a part",
        "Did you mean 'tool'?",
        ('"tolo"', '"tool"'),
    ),
    "output of what is fixed": Case(
        'at = "tool"\nof = "position"',
        'at = "post"\nof = "position"\n\n[[link]]\nname = "post"\non = "base"\nlength = 1.0',
        "output[1].at",
        "never moves",
        '`at = "yaw"`',
        ('at = "post"', 'at = "yaw"'),
    ),
    "input and output of one name": Case(
        'name = "yaw"\nat',
        'name = "torque"\nat',
        "output[2].name",
        "is already the name of [[input]] number 1",
        "'torque_2'",
        ('name = "torque"\nat = "yaw"\nof', 'name = "torque_2"\nat = "yaw"\nof'),
    ),
    "columns of one name": Case(
        'name = "yaw"\nat',
        'name = "tool_z"\nat',
        "output[2].name",
        "is already the name of [[output]] number 1",
        "'tool_z_2'",
        ('name = "tool_z"', 'name = "tool_z_2"'),
    ),
    "a column of the name of another": Case(
        'name = "torque"',
        'name = "push_x"',
        "input[2].name",
        "has a column 'push_x', which is one of [[input]] number 1",
        "'push_2'",
        ('name = "push"', 'name = "push_2"'),
    ),
    "initial in order": Case(
        "{ hinge = 0.2 }",
        "[0.2, 0.1]",
        "initial.angles",
        "is a list, and parts in space go by name",
        "`angles = { yaw = 0.1 }`",
        ("[0.2, 0.1]", "{ yaw = 0.1 }"),
    ),
    "initial of what does not turn": Case(
        "{ hinge = 0.2 }",
        "{ hinges = 0.2 }",
        "initial.angles.hinges",
        "is not the name of a motor or a joint",
        "Did you mean 'hinge'?",
        ("hinges", "hinge"),
    ),
    "motor with nothing to turn": Case(
        MOTOR,
        '[[motor]]\nname = "fan"\non = "tool"\naxis = "x"\n\n' + MOTOR,
        "motor[1]",
        "carries nothing that has inertia about the axis of 'fan', so that any torque would turn it without end",
        "or write `rotor_inertia = 1e-4` for the motor",
        ('name = "fan"', 'name = "fan"\nrotor_inertia = 1e-4'),
    ),
    "motor with nothing to turn, given a body": Case(
        MOTOR,
        '[[motor]]\nname = "fan"\non = "tool"\naxis = "x"\n\n' + MOTOR,
        "motor[1]",
        "carries nothing",
        'Add [[body]] with `on = "fan"`, `inertia = [1e-4, 1e-4, 1e-4]`',
        ("[[input]]", '[[body]]\nname = "blades"\non = "fan"\ninertia = [1e-4, 1e-4, 1e-4]\n\n[[input]]'),
    ),
    "spring with a point mass on its axis": Case(
        '[[body]]\nname = "tool"',
        '[[joint]]\nname = "swivel"\non = "boom"\naxis = [1, 0, 0]\nstiffness = 2.0\n\n'
        '[[body]]\nname = "point"\non = "swivel"\nmass = 1.0\ncenter = [0.2, 0, 0]\n\n[[body]]\nname = "tool"',
        "joint[2]",
        "carries nothing that has inertia about the axis of 'swivel'",
        'Add [[body]] with `on = "swivel"`, `inertia = [1e-4, 1e-4, 1e-4]`',
        ("center = [0.2, 0, 0]", "inertia = [1e-4, 1e-4, 1e-4]"),
    ),
    "motor without a rotor behind a spring about the same axis": Case(
        "rotor_inertia = 2e-5\ngear = 100\n",
        '\n[[joint]]\nname = "gear"\non = "yaw"\naxis = [0, 0, 1]\nstiffness = 900.0\n',
        "motor[1]",
        "carries nothing that has inertia about the axis of 'yaw', and all that does turns by itself",
        "for the motor",
        ('axis = "z"\n', 'axis = "z"\nrotor_inertia = 1e-4\n'),
    ),
}


def faulty(case: Case) -> str:
    text = ARM.replace(case.old, case.new, 1)
    assert text != ARM
    if case.new.endswith("stiffness = 900.0\n"):  # the column goes on the new spring
        text = text.replace('name = "column"\non = "yaw"', 'name = "column"\non = "gear"')
    return text


def test_the_arm_itself_is_a_scene() -> None:
    assert parse_scene(ARM).stations == 11


@pytest.mark.parametrize("name", CASES)
def test_faults(name: str) -> None:
    case = CASES[name]
    text = faulty(case)
    with pytest.raises(SceneError) as caught:
        parse_scene(text, "arm.toml")
    problems = caught.value.problems
    if case.others >= 0:
        assert len(problems) == 1 + case.others
    problem = next(problem for problem in problems if problem.key == case.key)
    assert case.message in problem.message
    assert case.remedy in problem.remedy
    assert problem.file == "arm.toml"
    assert problem.line > 0
    cured = text.replace(*case.cure, 1)
    assert cured != text
    parse_scene(cured)


def test_the_line_is_that_of_the_key() -> None:
    text = ARM.replace('on = "hinge"', 'on = "hing"')
    with pytest.raises(SceneError) as caught:
        parse_scene(text, "arm.toml")
    line = next(k for k, words in enumerate(text.splitlines(), start=1) if words == 'on = "hing"')
    assert str(caught.value) == (
        f"arm.toml:{line}: beam[1].on: is not the name of a part (got \"hing\"). Did you mean 'hinge'?"
    )


def test_a_table_of_control_is_refused() -> None:
    from tmm_gen.scene.template import template

    control = template("a", "planar", control=True).partition("[control]")[2].partition("[emit]")[0]
    with pytest.raises(SceneError) as caught:
        parse_scene(f"{ARM}\n[control]{control}")
    assert [problem.key for problem in caught.value.problems] == ["control"]


def test_a_point_mass_beside_the_axis_is_enough() -> None:
    text = ARM.replace(
        '[[body]]\nname = "tool"',
        '[[joint]]\nname = "swivel"\non = "boom"\naxis = "x"\n\n'
        '[[body]]\nname = "point"\non = "swivel"\nmass = 1.0\ncenter = [0.2, 0.01, 0]\n\n[[body]]\nname = "tool"',
    )
    assert parse_scene(text).stations == 12


def test_heavy_loads_on_thin_beams_are_not_taken_for_nothing_to_turn() -> None:
    """What cells have to turn is little beside what they carry, and still theirs."""
    text = ARM.replace("mass = 0.3\ninertia", "mass = 1e4\ncenter = [0, 5, 0]\ninertia").replace(
        "= 1e-4\nlinks = 3", "= 1e-12\nlinks = 50"
    )
    assert parse_scene(text).stations == 152


def test_kinds_are_not_mixed_up() -> None:
    with pytest.raises(SceneError) as caught:
        parse_scene(ARM.replace('kind = "spatial"', 'kind = "spacial"'))
    assert any("Did you mean 'spatial'?" in problem.remedy for problem in caught.value.problems)
    planar = ARM.replace('kind = "spatial"', 'kind = "planar"').replace("[0, 0, -9.81]", "9.81")
    with pytest.raises(SceneError) as caught:
        parse_scene(planar.replace("gravity", 'linearisation = "inertial"\ngravity'))
    problem = next(problem for problem in caught.value.problems if problem.key == "model.linearisation")
    assert problem.remedy == "Choose one of newton, taylor, frozen."
