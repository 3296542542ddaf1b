"""Faults of arms in space in how parts hang together and what goes with them, each told and each remedy tried."""

from __future__ import annotations

import pytest
from support.faults_in_space import ARM, MOTOR, Case, try_fault

from tmm_gen.scene import SceneError, parse_scene

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
    "corrections": Case(
        "gravity",
        "corrections = 1\ngravity",
        "model.corrections",
        "is for arms in a plane: in space `iterations` counts the sweep and its corrections",
        "write `iterations = 2`",
        ("corrections = 1", "iterations = 2"),
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
        "is no kind of base",
        'Write `kind = "free"`',
        ('"floating"', '"clamp"'),
    ),
    "free base of nothing": Case(
        'kind = "clamp"',
        'kind = "free"',
        "base.kind",
        "lets the base float, and nothing fixed to it has mass",
        'Add [[body]] with `name = "hub"`, `on = "base"`, `mass = 1.0`, `inertia = [0.01, 0.01, 0.01]`',
        (
            MOTOR,
            '[[body]]\nname = "hub"\non = "base"\nmass = 1.0\ninertia = [0.01, 0.01, 0.01]\n\n'
            + MOTOR
            + '\non = "base"',
        ),
    ),
    "free base of a point": Case(
        'kind = "clamp"',
        'kind = "free"\n\n[[body]]\nname = "hub"\non = "base"\nmass = 1.0\n',
        "body[1].inertia",
        "leaves the base that floats without the inertia to turn about every axis",
        "Write `inertia = [0.01, 0.01, 0.01]`",
        ("mass = 1.0\n", "mass = 1.0\ninertia = [0.01, 0.01, 0.01]\n"),
    ),
    "free base with a hub's inertia": Case(
        'kind = "clamp"',
        'kind = "free"\ninertia = 0.1\n\n[[body]]\nname = "hub"\non = "base"\nmass = 1.0\ninertia = [1, 1, 1]\n',
        "base.inertia",
        "is that of a hub: a base that floats is made of the bodies on it",
        "Remove it; mass and inertia are those of a [[body]]",
        ('"free"\ninertia = 0.1\n', '"free"\n'),
    ),
    "clamp that moves": Case(
        'kind = "clamp"',
        'kind = "clamp"\nrate = [0, 0, 1]',
        "base.rate",
        "is of a base that floats, and a clamp never moves",
        'Remove it, or write `kind = "free"`',
        ("rate = [0, 0, 1]", ""),
    ),
    "prescribed base without an angle": Case(
        'kind = "clamp"',
        'kind = "prescribed"',
        "base.kind",
        "needs an input that prescribes the angle",
        'Add [[input]] with `name = "base_angle"`, `at = "base"`, `acts = "angle"`.',
        ("[initial]", '[[input]]\nname = "base_angle"\nat = "base"\nacts = "angle"\n\n[initial]'),
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
    "sensitivities of constants": Case(
        MOTOR,
        '[emit]\nparameters = "bound"\nsensitivities = true\n\n' + MOTOR,
        "emit.parameters",
        "and emit.sensitivities exclude each other",
        "remove sensitivities",
        ("sensitivities = true\n", ""),
    ),
    "sensitivities by other sines": Case(
        MOTOR,
        '[emit]\ntrigonometry = "own"\nsensitivities = true\n\n' + MOTOR,
        "emit.trigonometry",
        "by the C library's sines",
        "Remove it",
        ('trigonometry = "own"\n', ""),
    ),
    "sensitivities of many arms": Case(
        MOTOR,
        "[emit]\nbatch = 8\nsensitivities = true\n\n" + MOTOR,
        "emit.batch",
        "which several arms at once have not",
        "Remove one of them",
        ("batch = 8\n", ""),
    ),
    "compensated": Case(
        MOTOR,
        '[emit]\nreal = "float32"\ncompensated = true\n\n' + MOTOR,
        "emit.compensated",
        "needs sines that are as exact",
        'Write trigonometry = "own"',
        ("compensated = true", 'compensated = true\ntrigonometry = "own"'),
    ),
    "box of what is no input": Case(
        MOTOR,
        "[emit.box]\nangle = [-1.0, 1.0]\n\n" + MOTOR,
        "emit.box.angle",
        "is neither a state nor an input",
        "'angles'",
        ("angle = [-1.0", "angles = [-1.0"),
    ),
    "box of a step that is a constant": Case(
        MOTOR,
        '[emit]\nparameters = "bound"\n[emit.box]\nstep = [1e-3, 2e-3]\n\n' + MOTOR,
        "emit.box.step",
        "bounds a step that is a constant",
        'parameters = "free"',
        ('parameters = "bound"\n', 'parameters = "free"\n'),
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
}


@pytest.mark.parametrize("name", CASES)
def test_faults(name: str) -> None:
    try_fault(CASES[name])


def test_the_arm_itself_is_a_scene() -> None:
    assert parse_scene(ARM).stations == 11


def test_the_line_is_that_of_the_key() -> None:
    text = ARM.replace('on = "hinge"', 'on = "hing"')
    with pytest.raises(SceneError) as caught:
        parse_scene(text, "arm.toml")
    line = next(k for k, words in enumerate(text.splitlines(), start=1) if words == 'on = "hing"')
    assert str(caught.value) == (
        f"arm.toml:{line}: beam[1].on: is not the name of a part (got \"hing\"). Did you mean 'hinge'?"
    )


def test_a_table_of_control_of_one_hub_serves_one_motor() -> None:
    from tmm_gen.scene.template import template

    control = template("a", "planar", control=True).partition("[control]")[2].partition("[emit]")[0]
    assert parse_scene(f"{ARM}\n[control]{control}").control is not None


def test_kinds_are_not_mixed_up() -> None:
    with pytest.raises(SceneError) as caught:
        parse_scene(ARM.replace('kind = "spatial"', 'kind = "spacial"'))
    assert any("Did you mean 'spatial'?" in problem.remedy for problem in caught.value.problems)
    planar = ARM.replace('kind = "spatial"', 'kind = "planar"').replace("[0, 0, -9.81]", "9.81")
    with pytest.raises(SceneError) as caught:
        parse_scene(planar.replace("gravity", 'linearisation = "inertial"\ngravity'))
    problem = next(problem for problem in caught.value.problems if problem.key == "model.linearisation")
    assert problem.remedy == "Choose one of newton, taylor, frozen."
