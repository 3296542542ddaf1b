"""`[control]` of an arm whose motors are parts by name: what may be told of each, and what is refused where."""

from __future__ import annotations

import numpy as np
import pytest

from tmm_gen.control.task.problem import control_problem
from tmm_gen.scene import SceneError, parse_scene

ARM = """\
name = "pair"
[model]
kind = "planar"
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "clamp"
[[motor]]
name = "first"
rotor_inertia = 1e-5
gear = 50
[[link]]
name = "upper"
on = "first"
length = 0.5
mass = 1.0
inertia = 0.02
[[motor]]
name = "second"
on = "upper"
rotor_inertia = 1e-5
gear = 20
[[link]]
name = "fore"
on = "second"
length = 0.4
mass = 0.5
inertia = 0.01
[[input]]
name = "u1"
at = "first"
acts = "torque"
[[input]]
name = "u2"
at = "second"
acts = "torque"
[[output]]
name = "angle"
at = "second"
of = "angle"
"""
CONTROL = """\
[control]
reference = { first = 0.5, second = -1.0 }
[control.weights]
hub = 2.0
tip = { second = 3.0, first = 4.0 }
[control.bounds]
torque = { first = 0.3, second = [-0.1, 0.2] }
hub = [-1.5, 1.5]
"""


BEAM = ARM.replace('[[link]]\nname = "fore"', '[[beam]]\nname = "fore"').replace(
    "mass = 0.5\ninertia = 0.01", "bending_stiffness = 3.0\nmass_per_length = 0.2\nlinks = 2"
)
"""The same arm whose forearm bends."""


def test_what_is_told_is_told_of_each_motor_in_the_order_of_the_arm() -> None:
    problem = control_problem(parse_scene(ARM + CONTROL))
    assert problem.motors.names == ("first", "second")
    assert problem.reference.tolist() == [0.5, -1.0]
    assert problem.weights.hub.tolist() == [2.0, 2.0]
    assert problem.weights.tip.tolist() == [4.0, 3.0]
    assert [bound.tolist() for bound in problem.torque] == [[-0.3, -0.1], [0.3, 0.2]]
    assert problem.hub == ((-1.5, 1.5),) * 2
    assert np.all(np.isinf(problem.torque_rate))


def test_modes_are_no_fewer_than_motors() -> None:
    assert control_problem(parse_scene(ARM + CONTROL)).modes == 6
    written = CONTROL.replace("[control]", "[control]\nmodes = 2")
    assert control_problem(parse_scene(ARM + written)).modes == 2
    third = '[[motor]]\nname = "third"\non = "fore"\nrotor_inertia = 1e-5\n'
    third += '[[link]]\nname = "hand"\non = "third"\nlength = 0.1\nmass = 0.1\ninertia = 1e-3\n'
    third += '[[input]]\nname = "u3"\nat = "third"\nacts = "torque"\n'
    told = "[control]\nreference = 0.5\nmodes = 2\n[control.bounds]\ntorque = 0.3\n"
    with pytest.raises(SceneError, match="modes: must be at least 3, the number of motors"):
        parse_scene(ARM + third + told)


def test_one_number_is_for_all() -> None:
    one = CONTROL.replace("{ first = 0.5, second = -1.0 }", "0.25")
    assert control_problem(parse_scene(ARM + one)).reference.tolist() == [0.25, 0.25]
    assert parse_scene(ARM + CONTROL) != parse_scene(ARM + one)


@pytest.mark.parametrize(
    ("old", "new", "key", "words"),
    [
        ("second = -1.0", "secnd = -1.0", "control.reference.secnd", "Did you mean 'second'?"),
        (", second = -1.0", "", "control.reference", "leaves out second"),
        ("{ first = 0.5, second = -1.0 }", "{}", "control.reference", "names no motor"),
        ("second = -1.0", "second = -1.6", "control.bounds.hub", "excludes the reference, -1.6 rad"),
        ("second = 3.0", "second = 0", "control.weights.tip", "greater than 0"),
        ("second = [-0.1, 0.2]", "second = [0.2, -0.1]", "control.bounds.torque", "increasing"),
        (
            "hub = 2.0",
            "hub = [2.0, 1.0]",
            "control.weights.hub",
            "of several motors one by each name (got [2.0, 1.0])",
        ),
        (
            "{ first = 0.5, second = -1.0 }",
            "[0.5, -1.0]",
            "control.reference",
            "{ shoulder = 2.5, elbow = 1.5 }",
        ),
        ("hub = 2.0", 'hub = "two"', "control.weights.hub", "must be a number"),
        ("[control.bounds]", "delay = 1.0\n[control.bounds]", "control.weights.delay", "is not a key"),
        (
            "[control.bounds]",
            "[control.sensors]\nstrain = { hip = 0.1 }\n[control.bounds]",
            "control.sensors.strain.hip",
            "is not the name of a driven motor",
        ),
        (
            "[control.bounds]",
            "[control.sensors]\nstrain = 0.1\n[control.bounds]",
            "control.sensors.strain",
            "the motor 'first' carries no beam that bends, on which a gauge could be (got 0.1). Name others, "
            "such as `strain = { second = 0.1 }`, or remove it.",
        ),
        (
            "[control.bounds]",
            "[control.sensors]\nstrain = { first = 0.1 }\n[control.bounds]",
            "control.sensors.strain.first",
            "carries no beam",
        ),
    ],
)
def test_faults_are_named(old: str, new: str, key: str, words: str) -> None:
    assert old in CONTROL
    with pytest.raises(SceneError) as caught:
        parse_scene(BEAM + CONTROL.replace(old, new, 1))
    assert any(problem.key == key and words in str(problem) for problem in caught.value.problems), (
        caught.value
    )


TWIG = """\
[[joint]]
name = "hinge"
on = "upper"
stiffness = 5.0
damping = 0.1
[[link]]
name = "twig"
on = "hinge"
length = 0.1
mass = 0.1
inertia = 0.001
"""


def test_arms_that_cannot_be_controlled_are_refused() -> None:
    undriven = ARM.replace('acts = "torque"', 'acts = "force_y"').replace('"first"\nacts', '"upper"\nacts')
    undriven = undriven.replace('"second"\nacts', '"fore"\nacts')
    motor = '[[motor]]\nname = "first"\nrotor_inertia = 1e-5\ngear = 50'
    turned = ARM.replace('"clamp"', '"prescribed"').replace(motor, '[[joint]]\nname = "first"')
    turned += '[[input]]\nname = "base"\nat = "base"\nacts = "angle"\n'
    for text, words in (
        (undriven, "turns motors by their torques, and no input is one"),
        (ARM + TWIG, "does not control arms that branch yet"),
        (turned, "does not control arms by parts on base.kind"),
    ):
        with pytest.raises(SceneError, match=words):
            parse_scene(text + CONTROL)


def test_names_of_motors_mean_nothing_on_a_hub(planar: str) -> None:
    text = planar + "[control]\nreference = 1.0\n[control.bounds]\ntorque = { hub = 3.0 }\n"
    with pytest.raises(SceneError, match="is told by names of motors, and this arm has its hub alone"):
        parse_scene(text)


def test_what_is_not_said_counts_in_the_largest_torque_of_each_motor(planar: str) -> None:
    """The same arm with motors ten times as strong takes what makes the same loop; a hub has plain numbers."""
    plain = "[control]\nreference = 0.5\n[control.bounds]\ntorque = { first = 0.3, second = [-0.1, 0.2] }\n"
    strong = plain.replace("0.3", "3.0").replace("[-0.1, 0.2]", "[-1.0, 2.0]")
    weak, ten = (control_problem(parse_scene(ARM + text)) for text in (plain, strong))
    for name, power in (("torque", 1), ("disturbance", 1), ("rate", 0)):
        one, other = (getattr(problem.estimator, name) for problem in (weak, ten))
        assert other == pytest.approx(10.0**power * one)
        assert np.all(one > 0.0)
    assert weak.estimator.torque == pytest.approx([0.05 * 0.3, 0.05 * 0.2])
    for name in ("torque", "torque_step"):
        one, other = (getattr(problem.weights, name) for problem in (weak, ten))
        assert other == pytest.approx(0.01 * one)
        assert one[1] / one[0] == pytest.approx((0.3 / 0.2) ** 2)
    told = plain + "[control.weights]\ntorque = 7.0\n[control.estimator]\nrate = 0.0\n"
    said = control_problem(parse_scene(ARM + told))
    assert said.weights.torque.tolist() == [7.0, 7.0]
    assert said.estimator.rate.tolist() == [0.0, 0.0]
    hub = control_problem(
        parse_scene(planar + "[control]\nreference = 1.0\n[control.bounds]\ntorque = 30.0\n")
    )
    assert (hub.weights.torque.item(), hub.estimator.disturbance.item(), hub.estimator.rate.item()) == (
        1e-3,
        1e-2,
        0,
    )
