"""Arms in space whose parts all stand at one point, as those of a gyroscope do: they reach nowhere, but they turn."""

from __future__ import annotations

import pytest

from tmm_gen.scene import parse_scene
from tmm_gen.simulate.run import simulate
from tmm_gen.simulate.tolerance import InaccurateError

GYROSCOPE = """
name = "gyroscope"
model = {{ kind = "spatial", gravity = [0, 0, {gravity}] }}
integrator = {{ name = "newmark", step = 1e-3 }}
base = {{ kind = "clamp" }}

[[joint]]
name = "outer"
axis = "x"
stiffness = 2.0

[[joint]]
name = "inner"
on = "outer"
axis = "y"

[[body]]
name = "wheel"
on = "inner"
mass = 1.0
center = [0, 0, -0.1]
inertia = [1e-3, 2e-3, 2e-3]

[[output]]
name = "turned"
at = "inner"
of = "angle"

[initial]
rates = {{ outer = {rate} }}
"""


def test_a_long_step_is_refused() -> None:
    """The error is seen in turns, as places tell nothing of it; with a hundredth of the step it is small."""
    scene = parse_scene(GYROSCOPE.format(gravity=-9.81, rate=5.0))
    with pytest.raises(InaccurateError, match="shorter steps"):
        simulate(scene.replace(**{"integrator.step": 0.1}), {}, 4.0)
    found = simulate(scene, {}, 4.0).accuracy
    assert found is not None
    assert 1e-7 < found.error < 0.05


def test_what_stands_still() -> None:
    """No motion is divided by."""
    found = simulate(parse_scene(GYROSCOPE.format(gravity=0.0, rate=0.0)), {}, 0.1).accuracy
    assert found is not None
    assert found.error == 0.0
