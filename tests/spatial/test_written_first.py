"""No routine of an arm in space reads what it has not set, whichever zeros axes and integrators leave in it."""

from __future__ import annotations

from itertools import product

import pytest

from tmm_gen.derive.integrators.registry import names
from tmm_gen.emit.c.lower import lower
from tmm_gen.program.build import build_program
from tmm_gen.scene import parse_scene

TWO_JOINTS = """
name = "pair"
model = {{ kind = "spatial", gravity = [0, 0, -9.81], {model} }}
integrator = {{ name = "{integrator}", step = 1e-3 }}
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


def require_written_first(
    root: str, wrist: str, integrator: str = "newmark", model: str = "iterations = 2", *, auto: bool = False
) -> None:
    """Build the arm and lower it to C, which refuses what is read before it is written."""
    text = TWO_JOINTS.format(root=root, wrist=wrist, integrator=integrator, model=model)
    lower(build_program(parse_scene(text), auto=auto))


@pytest.mark.parametrize(("root", "wrist"), list(product("xyz", repeat=2)))
def test_any_axes(root: str, wrist: str) -> None:
    """A zero that the wrist leaves in what it passes on is known to what the root prepares of it."""
    require_written_first(root, wrist)


@pytest.mark.parametrize("integrator", names())
@pytest.mark.parametrize("linearisation", ["inertial", "newton"])
@pytest.mark.parametrize("iterations", [1, 2, "auto"])
def test_any_integrator(integrator: str, linearisation: str, iterations: int | str) -> None:
    """Also where accelerations are not predicted although the linearisation would like it."""
    count = '"auto"' if iterations == "auto" else iterations
    model = f'linearisation = "{linearisation}", iterations = {count}'
    require_written_first("z", "y", integrator, model, auto=iterations == "auto")
