"""What is said of an arm by parts, in the words of its file."""

from __future__ import annotations

import pytest

from tmm_gen.explain.explain import explain
from tmm_gen.explain.explanation import Explained
from tmm_gen.scene import parse_scene

TWO = """\
name = "two"
model = { kind = "planar", gravity = 9.81 }
integrator = { name = "newmark", step = 1e-3 }
base = { kind = "clamp" }
output = [{ name = "tip", at = "b", of = "position" }]
motor = [{ name = "m", gear = 20 }]
joint = [{ name = "h", on = "a" }]
link = [
  { name = "a", on = "m", length = 0.5, mass = 2.0, inertia = 0.05 },
  { name = "b", on = "h", length = 0.4, mass = 1.0, inertia = 0.02 },
]
body = [{ name = "tool", on = "b", mass = 0.5 }]
input = [{ name = "torque", at = "m", acts = "torque" }]
"""


@pytest.fixture(scope="module")
def terms() -> dict[str, Explained]:
    """Return the terms of two rigid links without springs and dampers, by name."""
    return {term.term: term for term in explain(parse_scene(TWO)).terms}


def test_a_body_at_the_tip_is_called_by_its_name(terms: dict[str, Explained]) -> None:
    assert terms["mass at the tip"].why == "mass of 'tool' = 0.5"
    assert terms["inertia at the tip"].why == "no inertia of 'tool'"


def test_a_motor_is_no_load_on_a_link(terms: dict[str, Explained]) -> None:
    assert "at 2 of 2 links" in terms["torques and forces on links without an input"].why


def test_dampers_of_joints_that_turn_freely_cost_something(terms: dict[str, Explained]) -> None:
    assert not terms["joint damping"].modelled
    assert terms["joint damping"].worth.step > 0


@pytest.mark.long
def test_heat_is_no_term_of_a_scene_with_derivatives() -> None:
    names = [term.term for term in explain(parse_scene(TWO).replace(**{"emit.sensitivities": True})).terms]
    assert "mass at the tip" in names
    assert "counting energy turned to heat" not in names
