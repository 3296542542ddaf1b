"""Faults in the numbers of parts in space, and joints without anything to turn; each remedy is tried."""

from __future__ import annotations

import re

import pytest
from support.faults_in_space import ARM, MOTOR, Case, try_fault

from tmm_gen.scene import SceneError, parse_scene

CASES = {
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
    "elastic gear without a rotor": Case(
        "rotor_inertia = 2e-5\ngear = 100",
        "gear = 100\nstiffness = 900.0",
        "motor[1].rotor_inertia",
        "a rotor behind an elastic gear cannot turn without inertia",
        "`rotor_inertia = 1e-5`",
        ("stiffness = 900.0", "stiffness = 900.0\nrotor_inertia = 1e-5"),
    ),
    "damping time of a gear": Case(
        "gear = 100",
        "gear = 100\ndamping_time = 1e-4",
        "motor[1].damping_time",
        "without `stiffness` the gear is rigid",
        "Write `stiffness` too",
        ("damping_time = 1e-4", "damping_time = 1e-4\nstiffness = 900.0"),
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
        'rotor_inertia = 2e-5\ngear = 100\n\n[[link]]\nname = "column"\non = "yaw"\n',
        '\n[[joint]]\nname = "gear"\non = "yaw"\naxis = [0, 0, 1]\nstiffness = 900.0\n'
        '\n[[link]]\nname = "column"\non = "gear"\n',
        "motor[1]",
        "carries nothing that has inertia about the axis of 'yaw', and all that does turns by itself",
        "for the motor",
        ('axis = "z"\n', 'axis = "z"\nrotor_inertia = 1e-4\n'),
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_faults(name: str) -> None:
    try_fault(CASES[name])


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


@pytest.mark.parametrize(
    "joints",
    [
        '[[motor]]\nname = "a"\non = "tool"\naxis = "x"\n',
        '[[joint]]\nname = "a"\non = "tool"\naxis = [1, 2, 3]\n'
        '[[joint]]\nname = "b"\non = "a"\naxis = [1, 2, 3]\nstiffness = 2.0\n'
        '[[body]]\nname = "c"\non = "b"\nmass = 0.5\ninertia = [1e-3, 1e-3, 1e-3]\n',
        # a point mass on the axis of the second joint
        '[[joint]]\nname = "a"\non = "tool"\naxis = "y"\nstiffness = 1.0\n'
        '[[joint]]\nname = "b"\non = "a"\naxis = "x"\nstiffness = 1.0\n'
        '[[body]]\nname = "c"\non = "b"\nmass = 0.5\ncenter = [0.2, 0, 0]\n',
    ],
)
def test_the_body_that_the_remedy_names_will_do(joints: str) -> None:
    text = ARM.replace("[[input]]", joints + "\n[[input]]", 1)
    with pytest.raises(SceneError) as caught:
        parse_scene(text)
    for number, problem in enumerate(caught.value.problems):
        found = re.match(r"Add \[\[body\]\] with `(on = \"\w+\")`, `(inertia = \[.*?\])`", problem.remedy)
        assert found is not None
        body = f'[[body]]\nname = "more_{number}"\n{found[1]}\n{found[2]}\n\n'
        text = text.replace("[[input]]", body + "[[input]]", 1)
    assert caught.value.problems
    parse_scene(text)
