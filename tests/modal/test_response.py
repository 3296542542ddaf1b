"""Frequency responses against SciPy's state space, rational functions, and the continuous beam."""

from __future__ import annotations

from collections.abc import Callable

import mpmath
import numpy as np
import pytest
from scipy.linalg import solve
from thesis.product_frequency import product_tip_motion

from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.beam.response import beam_response
from tmm_gen.modal.equilibrium import equilibrium
from tmm_gen.modal.matrices import matrices
from tmm_gen.modal.modes import find_modes
from tmm_gen.modal.response import frequency_response
from tmm_gen.reference.assembly import Assembly, assemble
from tmm_gen.scene import Scene


def state_space_response(
    mass: np.ndarray, damping: np.ndarray, stiffness: np.ndarray, load: np.ndarray, omega: float
) -> np.ndarray:
    """Return the state ``[q, q'] = (j w E - A)^-1 B`` of the first-order system ``E z' = A z + B u``, by SciPy.

    The mass matrix stays in ``E``: to invert it would cost the digits of the lowest modes.
    """
    size = len(mass)
    zero, unit = np.zeros((size, size)), np.eye(size)
    left = np.block([[unit, zero], [zero, mass]])
    right = np.block([[zero, unit], [-stiffness, -damping]])
    return solve(1j * omega * left - right, np.concatenate([np.zeros(size), load]))


def exact_tip(scene: Scene, omega: float) -> complex:
    """Tip angle of a clamped chain for a torque at the tip, by a continued fraction at 60 digits."""
    with mpmath.workdps(60):
        s = mpmath.mpc(0, omega)
        angle, torque = mpmath.mpc(0), mpmath.mpc(1)
        for joint, link in zip(scene.joints, scene.links, strict=True):
            angle += torque / (mpmath.mpf(joint.stiffness) + mpmath.mpf(joint.damping) * s)
            torque += mpmath.mpf(link.inertia) * s**2 * angle
        return complex(angle / torque)


def test_hundred_links_up_to_the_50th_mode(scene_named: Callable[[str], Scene]) -> None:
    scene = scene_named("hundred")
    arm = linear_arm(scene)
    modes = find_modes(matrices(arm))
    at_modes = [mode.frequency for mode in modes[:50]]
    omega = np.sort(np.concatenate([np.geomspace(0.1 * at_modes[0], at_modes[49], 40), at_modes[::3]]))
    found = frequency_response(arm, 1j * omega)
    known = assemble(scene)
    read = np.hstack([known.from_angle, known.from_rate])
    assert not np.any(known.from_acceleration)
    for number, w in enumerate(omega):
        state = state_space_response(known.mass, known.damping, known.stiffness, known.load[:, 0], float(w))
        values = [found[name][number, 0] for name in known.outputs]
        np.testing.assert_allclose(values, read @ state, rtol=1e-8)
    exact = np.array([exact_tip(scene, float(w)) for w in omega])
    np.testing.assert_allclose(found["tip"][:, 0], exact, rtol=1e-8)


def many_digits(assembly: Assembly, given: int, omega: float) -> np.ndarray:
    """Solve (M s^2 + C s + K) q = F at 40 digits: at low frequencies a free drive is nearly singular."""
    with mpmath.workdps(40):
        s = mpmath.mpc(0, omega)
        mass, damping, stiffness = (
            mpmath.matrix(each.tolist()) for each in (assembly.mass, assembly.damping, assembly.stiffness)
        )
        load = mpmath.matrix(assembly.load[:, given].tolist())
        turned = mpmath.lu_solve(mass * s**2 + damping * s + stiffness, load)
        return np.array([complex(value) for value in turned])


def test_a_hundred_links_of_a_beam_where_the_plain_product_fails(beam_scene: Callable[..., Scene]) -> None:
    """Half of a beam's waves fade at any frequency: the product multiplies by exp(beta L) and subtracts."""
    scene = beam_scene(links=100, damping=1e-5)
    arm = linear_arm(scene)
    linear = matrices(arm)
    modes = find_modes(linear)
    omega = np.array([1.01 * modes[k].frequency for k in (0, 4, 9, 19, 34, 49)])
    to_y = np.full(100, 0.8 / 100)
    parts = (linear.mass, linear.damping, linear.stiffness, to_y)
    expected = np.array([to_y @ state_space_response(*parts, float(w))[:100] for w in omega])
    kept = frequency_response(arm, 1j * omega)["tip_y"][:, 0]
    np.testing.assert_allclose(kept, expected, rtol=1e-8)
    lossy = product_tip_motion(arm, 1j * omega, 0)[:, 1]
    lost = np.nan_to_num(np.abs(lossy / expected - 1.0), nan=np.inf)
    assert lost[0] < 1e-8
    assert np.all(lost[3:] > 0.1)  # no digit left from the 20th mode on


def test_the_product_keeps_digits_in_a_short_chain(scene_named: Callable[[str], Scene]) -> None:
    arm = linear_arm(scene_named("thesis2"))
    s = 1j * np.array([0.5, 2.0, 7.0])
    np.testing.assert_allclose(
        product_tip_motion(arm, s, 0)[:, 0], frequency_response(arm, s)["tip"][:, 0], rtol=1e-13
    )


@pytest.mark.parametrize("output", ["motor_speed", "shaft_torque", "encoder"])
@pytest.mark.parametrize("given", [0, 1])
def test_a_drive_against_its_matrices(output: str, given: int, scene_named: Callable[[str], Scene]) -> None:
    scene = scene_named("drivetrain")
    assembly = assemble(scene)
    omega = np.geomspace(1.0, 3e4, 30)
    found = frequency_response(linear_arm(scene), 1j * omega)[output][:, given]
    row = assembly.outputs.index(output)
    for value, w in zip(found, omega, strict=True):
        s = 1j * w
        turned = many_digits(assembly, given, float(w))
        read = assembly.from_angle[row] + s * assembly.from_rate[row]
        assert value == pytest.approx(read @ turned, rel=1e-10)


def test_a_drooping_arm_against_its_matrices(beam_scene: Callable[..., Scene]) -> None:
    """Planar sweep about a bent equilibrium; positions, forces and torques by kinematics of M, C, K."""
    scene = beam_scene(links=6, gravity=9.81, bending=1.0, damping=1e-3, tip="[tip]\nmass = 0.1")
    rest = equilibrium(scene)
    arm = linear_arm(scene, rest)
    linear = matrices(arm)
    length = 0.8 / 6
    to_x, to_y = -length * np.sin(rest.angles), length * np.cos(rest.angles)
    for omega in (2.0, 37.0, 410.0):
        s = 1j * omega
        turned = np.linalg.solve(linear.mass * s**2 + linear.damping * s + linear.stiffness, to_y)
        found = {name: value[0, 0] for name, value in frequency_response(arm, np.array([s])).items()}
        assert found["tip_x"] == pytest.approx(to_x @ turned, rel=1e-9)
        assert found["tip_y"] == pytest.approx(to_y @ turned, rel=1e-9)
        joint = scene.joints[0]
        assert found["base_torque"] == pytest.approx(
            (joint.stiffness + joint.damping * s) * turned[0], rel=1e-9
        )
        shares = np.tri(6, 6, -1) + 0.5 * np.eye(6)  # centre of each link
        masses = np.array([link.mass for link in scene.links])
        inertia = s**2 * (masses @ (shares @ (to_y * turned)) + 0.1 * (to_y @ turned))
        assert found["base_force_y"] == pytest.approx(inertia - 1.0, rel=1e-8)


def test_a_prescribed_base(beam_scene: Callable[..., Scene]) -> None:
    """At low frequencies the arm follows its base; at a clamped frequency it resonates."""
    inputs = '[[input]]\nname = "turn"\nat = "base"\nacts = "angle"'
    scene = beam_scene(links=10, base='kind = "prescribed"', inputs=inputs, damping=1e-4)
    arm = linear_arm(scene)
    clamped = find_modes(matrices(arm), 1)[0].frequency
    found = frequency_response(arm, 1j * np.array([1e-2 * clamped, clamped]))["tip_y"][:, 0]
    assert found[0] == pytest.approx(0.8, rel=1e-3)
    assert abs(found[1]) > 100


def test_two_hundred_links_answer_like_the_continuous_beam(beam_scene: Callable[..., Scene]) -> None:
    scene = beam_scene(links=200, damping=2e-3, tip="[tip]\nmass = 0.2\ninertia = 0.001")
    omega = np.geomspace(1.0, 300.0, 40)
    found = frequency_response(linear_arm(scene), 1j * omega)["tip_y"][:, 0]
    exact = beam_response(scene, 1j * omega, scene.inputs[0], scene.outputs[0])
    assert exact is not None
    assert np.max(np.abs(found - exact) / np.abs(exact)) < 6e-3
    assert beam_response(scene, 1j * omega, scene.inputs[0], scene.outputs[1]) is None
