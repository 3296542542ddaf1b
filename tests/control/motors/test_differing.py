"""A condition that would change nothing of an arm is not tried, and refused where it is named."""

from __future__ import annotations

from pathlib import Path

import pytest

from tmm_gen.closed_loop.compare import compare
from tmm_gen.control.bench import Bench
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.plant.differing import conditions_of
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene, load_scene

REACH = Path(__file__).parents[3] / "examples" / "space" / "reach3.toml"
BARE = {"body": None, "output": [{"name": "tip", "at": "forearm", "of": "position"}]}
RIGID = {"motor.shoulder.gear": 1, "motor.elbow.gear": 1}


def missing(scene: Scene) -> set[str]:
    """Return the names of conditions that a scene does not have."""
    return {case.name for case in CONDITIONS} - {case.name for case in conditions_of(scene)}


def test_an_arm_has_the_conditions_that_it_differs_in(two: Bench) -> None:
    assert missing(two.scene) == set()
    assert missing(two.scene.replace(**RIGID)) == {"gears"}
    assert missing(two.scene.replace(**{"body.payload.mass": 0.0})) == {"payload"}
    assert missing(two.scene.replace(**BARE)) == {"payload"}


def test_in_space_too() -> None:
    reach = load_scene(REACH)
    assert missing(reach) == {"gears"}
    assert missing(reach.replace(**{"body.payload.mass": 0.0})) == {"gears", "payload"}


def test_a_condition_that_is_named_says_what_the_arm_lacks(two: Bench) -> None:
    bare = Bench.of(two.scene.replace(**BARE))
    payload = next(case for case in CONDITIONS if case.name == "payload")
    with pytest.raises(UserError) as refused:
        next(compare(bare, [BY_NAME["pd"]], [CONDITIONS[0], payload]))
    assert str(refused.value) == (
        f"{two.scene.source.origin.partition(' (with ')[0]}: the arm carries no mass at its end, so that condition "
        "'payload' would change nothing. Leave out the condition, or write `mass`, in kg, under a [[body]] at the end "
        "of the arm."
    )
