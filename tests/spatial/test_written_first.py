"""No routine of an arm in space reads what it has not set, whichever zeros axes and integrators leave in it."""

from __future__ import annotations

from itertools import product

import pytest

from tmm_gen.emit.c.lower import lower
from tmm_gen.program.build import build_program
from tmm_gen.scene import METHODS, parse_scene

TWO_JOINTS = """
name = "pair"
model = {{ kind = "spatial", gravity = [0, 0, -9.81] }}
integrator = {{ name = "newmark", step = 1e-3 }}
base = {{ kind = "clamp" }}

[[joint]]
name = "root"
axis = "{root}"
stiffness = 10.0

[[link]]
name = "rod"
on = "root"
length = 0.5
mass = 0.5
inertia = [1e-3, 2e-3, 3e-3]

[[joint]]
name = "wrist"
on = "rod"
axis = "{wrist}"
stiffness = 5.0

[[body]]
name = "hand"
on = "wrist"
mass = 0.2
center = [0.1, 0, 0]
inertia = [1e-3, 2e-3, 3e-3]

[[output]]
name = "hand"
at = "hand"
of = "position"
"""


UNLOADED = """
name = "idle"
model = {{ kind = "spatial", linearisation = "{linearisation}", iterations = {iterations} }}
integrator = {{ name = "{integrator}", step = 1e-3 }}
base = {{ kind = "clamp" }}

[[joint]]
name = "bearing"
axis = "z"

[[body]]
name = "flywheel"
on = "bearing"
inertia = [1e-3, 1e-3, 2e-3]

[[output]]
name = "turned"
at = "bearing"
of = "angle"
"""
"""Nothing acts on it: all that its sweep finds is known beforehand."""


def require_written_first(text: str) -> None:
    """Build the arm and lower it to C, which refuses what is read before it is written."""
    lower(build_program(parse_scene(text)))


@pytest.mark.parametrize(("root", "wrist"), list(product("xyz", repeat=2)))
def test_any_axes(root: str, wrist: str) -> None:
    """A zero that the wrist leaves in what it passes on is known to what the root prepares of it."""
    require_written_first(TWO_JOINTS.format(root=root, wrist=wrist))


@pytest.mark.parametrize("integrator", [method.name for method in METHODS if not method.coupled])
@pytest.mark.parametrize(("linearisation", "iterations"), [("inertial", 1), ("inertial", 2), ("newton", 1)])
def test_nothing_acts(integrator: str, linearisation: str, iterations: int) -> None:
    """What the end of a step reads does not leave it, even where it is the same in every step."""
    require_written_first(
        UNLOADED.format(integrator=integrator, linearisation=linearisation, iterations=iterations)
    )
