"""An arm in space without a fault, and how a fault put into it is told and cured."""

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

    @property
    def text(self) -> str:
        """The arm with the fault."""
        return ARM.replace(self.old, self.new, 1)


def try_fault(case: Case) -> None:
    """Check that a fault is told with its place, and that the scene is good after the cure that its remedy names."""
    assert case.text != ARM
    with pytest.raises(SceneError) as caught:
        parse_scene(case.text, "arm.toml")
    problems = caught.value.problems
    if case.others >= 0:
        assert len(problems) == 1 + case.others
    problem = next(problem for problem in problems if problem.key == case.key)
    assert case.message in problem.message
    assert case.remedy in problem.remedy
    assert problem.file == "arm.toml"
    assert problem.line > 0
    cured = case.text.replace(*case.cure, 1)
    assert cured != case.text
    parse_scene(cured)
