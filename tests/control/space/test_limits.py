"""Limits that joints of an arm in space have are bounds of their controllers."""

from __future__ import annotations

import pytest

from tmm_gen.control.task.problem import control_problem
from tmm_gen.scene import SceneError, parse_scene

LIFT = 'name = "lift"\non = "yaw"\n'


def test_limits_bound_hubs_within_what_is_told(words: str) -> None:
    limited = words.replace(LIFT, LIFT + "limits = [-0.9, 0.4]\n")
    assert control_problem(parse_scene(words)).hub == (None, None)
    assert control_problem(parse_scene(limited)).hub == (None, (-0.9, 0.4))
    for told, hub in (
        ("[-1.5, 1.0]", ((-1.5, 1.0), (-0.9, 0.4))),
        ("{ yaw = 2.0, lift = [-0.6, 0.8] }", ((-2.0, 2.0), (-0.6, 0.4))),
    ):
        bounded = limited.replace("[control.bounds]", f"[control.bounds]\nhub = {told}")
        problem = control_problem(parse_scene(bounded))
        assert problem.hub == hub
        assert problem.weights.hub_bound.tolist() == [1e4, 1e4]


def test_references_beyond_limits_are_refused(words: str) -> None:
    limited = words.replace(LIFT, LIFT + "limits = [-0.9, 0.1]\n")
    for told, key, got in (
        ("{ yaw = 0.8, lift = 0.2 }", "control.reference.lift", 0.2),
        ("0.2", "control.reference", 0.2),
    ):
        text = limited.replace("{ yaw = 0.8, lift = 0.2 }", told)
        with pytest.raises(SceneError) as caught:
            parse_scene(text)
        (problem,) = caught.value.problems
        assert (problem.key, problem.value) == (key, got)
        assert "is beyond the limits of 'lift', [-0.9, 0.1] rad" in str(problem)
    assert parse_scene(limited.replace("lift = 0.2", "lift = 0.1")).control is not None
