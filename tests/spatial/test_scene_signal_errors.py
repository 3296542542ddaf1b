"""Faults in inputs, outputs and initial motion of arms in space; each remedy is tried."""

from __future__ import annotations

import pytest
from support.faults_in_space import ARM, Case, try_fault

CASES = {
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
}


@pytest.mark.parametrize("name", CASES)
def test_faults(name: str) -> None:
    try_fault(CASES[name])
