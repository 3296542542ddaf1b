"""`[control]`: what is refused, and where."""

from __future__ import annotations

import pytest

from tmm_gen.scene import SceneError, parse_scene

CONTROL = """\
[control]
reference = 1.0
delay = 0.01
[control.bounds]
torque = 3.0
hub = [-0.1, 1.02]
"""


def test_content_matters(planar: str) -> None:
    one = parse_scene(planar + CONTROL)
    assert one != parse_scene(planar + CONTROL.replace("0.01", "0.02"))
    assert one == parse_scene(planar + CONTROL.replace("torque = 3.0", "torque = [-3, 3]"))


@pytest.mark.parametrize(
    ("old", "new", "key", "words"),
    [
        ("reference = 1.0", "reference = 1.0\nhorizon = 1", "control.horizon", "at least 2"),
        ("reference = 1.0", "reference = 1.0\nsample_time = -1", "control.sample_time", "sample_time = 0.02"),
        ("reference = 1.0", "reference = nan", "control.reference", "finite"),
        ("reference = 1.0\n", "", "control.reference", "is missing"),
        ("reference = 1.0", "reference = 1.5", "control.bounds.hub", "excludes the reference"),
        ("torque = 3.0\n", "", "control.bounds.torque", "is missing"),
        ("torque = 3.0", "torque = [3, -3]", "control.bounds.torque", "increasing"),
        ("torque = 3.0", "torque = -3", "control.bounds.torque", "positive number"),
        ("torque = 3.0", "tork = 3.0", "control.bounds.tork", "torque"),
        ("delay = 0.01", "delay = 10", "control.delay", "at most 10 samples"),
        ("delay = 0.01", "wait = 0.01", "control.wait", "is not a key of [control]"),
        (
            "[control.bounds]",
            "[control.weights]\ntip = 0\n[control.bounds]",
            "control.weights.tip",
            "greater than 0",
        ),
        (
            "[control.bounds]",
            "[control.sensors]\nencoder = 1.5\n[control.bounds]",
            "control.sensors.encoder",
            "whole",
        ),
    ],
)
def test_faults_are_named(planar: str, old: str, new: str, key: str, words: str) -> None:
    assert old in CONTROL
    with pytest.raises(SceneError) as caught:
        parse_scene(planar + CONTROL.replace(old, new, 1))
    assert any(problem.key == key and words in str(problem) for problem in caught.value.problems), (
        caught.value
    )


def test_an_arm_without_a_motor_cannot_be_controlled(planar: str, chain: str) -> None:
    clamped = planar.replace('"motor"\ninertia = 0.05', '"clamp"').replace('at = "base"', 'at = "tip"')
    for text in (
        clamped,
        planar.replace("hub_torque", "push").replace('at = "base"', 'at = "tip"', 1),
        chain,
    ):
        with pytest.raises(SceneError, match=r"control"):
            parse_scene(text + CONTROL)
