"""A motor on a base that moves as prescribed: its rotor turns against the base; a rate that jumps strikes it."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tmm_gen.errors import UserError
from tmm_gen.inputs.signals import Constant, Table
from tmm_gen.inputs.waveforms import Smooth
from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.equilibrium import nearest
from tmm_gen.modal.response import frequency_response
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.simulate.prescribed import prescribed
from tmm_gen.simulate.run import simulate

ROTOR, GEAR = 2e-5, 100.0
ARMATURE = GEAR**2 * ROTOR
BODY = 0.003 + 1.0 * 0.2**2  # about the joint, kg m^2
WEIGHT = 9.81 * 0.2
TORQUE, UNTIL = 0.01, 0.3
TURN = Smooth(0.0, 0.5, 0.3)

ARM = f"""
name = "rocking"
[model]
kind = "planar"
gravity = 9.81
[integrator]
name = "sdirk4"
step = 2e-3
[base]
kind = "prescribed"
[[motor]]
name = "shoulder"
rotor_inertia = {ROTOR}
gear = {GEAR}
[[link]]
name = "boom"
on = "shoulder"
mass = 1
length = 0.4
inertia = 0.003
[[input]]
name = "turn"
at = "base"
acts = "angle"
[[input]]
name = "torque"
at = "shoulder"
acts = "torque"
[[output]]
name = "angle"
at = "boom"
of = "angle"
[[output]]
name = "through"
at = "base"
of = "torque"
[[output]]
name = "kinetic"
at = "arm"
of = "kinetic_energy"
"""


@pytest.fixture(scope="module")
def rocking() -> Scene:
    """Return a link on a geared motor on a base that turns."""
    return parse_scene(ARM)


def test_it_moves_as_its_own_equation_says(rocking: Scene) -> None:
    """``(body + rotor) angle'' = rotor turn'' + gear torque - weight cos(angle)``; energies balance."""

    def rates(time: float, x: np.ndarray) -> list[float]:
        pulled = ARMATURE * float(TURN.curvature(time)) + GEAR * TORQUE - WEIGHT * np.cos(x[0])
        return [x[1], pulled / (BODY + ARMATURE)]

    found = simulate(rocking, {"turn": TURN, "torque": Constant(TORQUE)}, UNTIL, trace=True)
    right = solve_ivp(
        rates,
        (0.0, UNTIL),
        [0.0, 0.0],
        rtol=1e-11,
        atol=1e-13,
        t_eval=found.time,
        method="DOP853",
        max_step=0.01,
    ).y
    twist = right[1] - TURN.slope(found.time)
    acceleration = np.array([rates(t, x)[1] for t, x in zip(found.time, right.T, strict=True)])
    expected = {
        "angle": right[0],
        "through": GEAR * TORQUE - ARMATURE * (acceleration - TURN.curvature(found.time)),
        "kinetic": 0.5 * BODY * right[1] ** 2 + 0.5 * ARMATURE * twist**2,
    }
    for name, values in expected.items():
        np.testing.assert_allclose(found.outputs[name], values, atol=1e-6 * np.ptp(values), err_msg=name)
    assert found.imbalance is not None
    assert found.imbalance < 1e-6


def test_its_response_to_the_base_is_its_equations(rocking: Scene) -> None:
    s = 1j * 2.0 * np.pi * np.array([0.1, 0.4, 2.0, 30.0])
    arm = linear_arm(rocking, nearest(rocking, {}, np.array([-0.5 * np.pi])))
    found = frequency_response(arm, s)["angle"][:, 0]
    np.testing.assert_allclose(found, ARMATURE * s**2 / ((BODY + ARMATURE) * s**2 + WEIGHT), rtol=1e-9)


def test_a_rate_that_jumps_strikes_the_rotor(rocking: Scene) -> None:
    """It is refused, with a way that goes there; without a rotor nothing is struck, nor behind the end."""
    ramp = {"turn": Table(np.array([0.0, 0.2]), np.array([0.0, 0.1]))}
    with pytest.raises(UserError, match=r"jumps by -0.5 rad/s at t = 0.2 s, .*--input turn=smooth:0:0.1:"):
        prescribed(rocking, ramp, UNTIL)
    prescribed(rocking, ramp, 0.2)
    prescribed(rocking.replace(**{"motor.shoulder.rotor_inertia": 0.0}), ramp, UNTIL)
