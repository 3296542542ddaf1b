"""Where arms come to rest that have nothing to hold them but gravity."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from tmm_gen.errors import UserError
from tmm_gen.modal.equilibrium import equilibrium
from tmm_gen.scene import Scene, parse_scene

LINKS = """\
name = "two"
model = { kind = "planar", gravity = 9.81 }
integrator = { name = "newmark", step = 1e-3 }
base = { kind = "clamp" }
output = [{ name = "tip", at = "b", of = "position" }]
motor = [{ name = "m", gear = 20 }]
joint = [{ name = "h", on = "a" }]
link = [
  { name = "a", on = "m", length = 0.5, mass = 2.0, inertia = 0.05 },
  { name = "b", on = "h", length = 0.4, mass = 1.0, inertia = 0.02, center = 0.25 },
]
input = [{ name = "torque", at = "m", acts = "torque" }]
"""


@pytest.fixture(scope="module")
def two() -> Callable[..., Scene]:
    """Return two rigid links on a motor and a free hinge, level: no stiffness at all there."""

    def make(**changes: object) -> Scene:
        return parse_scene(LINKS).replace(**changes)

    return make


@pytest.mark.parametrize("gravity", [9.81, 1e-9, 1e9])
def test_level_links_come_to_hang(gravity: float, two: Callable[..., Scene]) -> None:
    angles = equilibrium(two(**{"model.gravity": gravity})).free_angles
    assert np.sin(angles) == pytest.approx(-1.0, abs=1e-12)


def test_a_motor_holds_the_torque_of_the_weights(two: Callable[..., Scene]) -> None:
    upper = equilibrium(two(), {"torque": 0.4}).free_angles[0]
    weights = 9.81 * (2.0 * 0.25 + 1.0 * 0.5) * np.cos(upper)
    assert weights == pytest.approx(20 * 0.4, rel=1e-9)
    with pytest.raises(UserError, match="no static equilibrium"):
        equilibrium(two(), {"torque": 0.6})


def test_without_weight_links_stay(two: Callable[..., Scene]) -> None:
    start = two(**{"model.gravity": 0.0, "initial.angles": 0.3})
    assert equilibrium(start).free_angles == pytest.approx(0.3)
