"""Mass, damping and stiffness matrices against textbook assembly and against the generated kernel."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from support.kernel_rest import kernel_accelerations, kernel_unbalanced

from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.equilibrium import equilibrium
from tmm_gen.modal.matrices import matrices
from tmm_gen.modal.rest import rest_at
from tmm_gen.reference.assembly import assemble
from tmm_gen.scene import Scene


@pytest.mark.parametrize("name", ["thesis2", "thesis10", "drivetrain", "hundred"])
def test_chains_are_those_of_the_textbook(name: str, scene_named: Callable[[str], Scene]) -> None:
    scene = scene_named(name)
    found, expected = matrices(linear_arm(scene)), assemble(scene)
    for one, other in (
        (found.mass, expected.mass),
        (found.damping, expected.damping),
        (found.stiffness, expected.stiffness),
    ):
        np.testing.assert_allclose(one, other, rtol=1e-14, atol=0)


def test_a_drooping_arm_agrees_with_the_generated_kernel(beam_scene: Callable[..., Scene]) -> None:
    """Equilibrium found by the kernel itself; its accelerations around it are -M^-1 K."""
    scene = beam_scene(links=5, gravity=9.81, bending=1.0, tip="[tip]\nmass = 0.1\ninertia = 0.002")
    own = equilibrium(scene, {"push": -0.5})
    kernels = equilibrium(scene, {"push": -0.5}, kernel_unbalanced(scene, {"push": -0.5}))
    np.testing.assert_allclose(own.angles, kernels.angles, atol=1e-12)
    assert own.angles[-1] < -0.5
    accelerations = kernel_accelerations(scene, {"push": -0.5})
    assert np.max(np.abs(accelerations(own.angles))) < 1e-9
    linear = matrices(linear_arm(scene, own))
    step = 1e-5
    slopes = [
        (accelerations(own.angles + step * unit) - accelerations(own.angles - step * unit)) / (2 * step)
        for unit in np.eye(5)
    ]
    error = linear.mass @ np.array(slopes).T + linear.stiffness
    assert np.max(np.abs(error)) < 1e-8 * np.max(np.abs(linear.stiffness))


def test_stiffness_is_the_slope_of_the_torque_anywhere(beam_scene: Callable[..., Scene]) -> None:
    motor = 'kind = "motor"\ninertia = 0.03'
    scene = beam_scene(links=4, base=motor, gravity=9.81, tip="[tip]\nmass = 0.2")
    angles, step = np.array([0.3, 0.1, -0.2, -0.5, 0.4]), 1e-6
    linear = matrices(linear_arm(scene, rest_at(scene, angles)))
    for column, unit in enumerate(np.eye(5)):
        ahead, behind = (rest_at(scene, angles + sign * step * unit).unbalanced for sign in (1, -1))
        np.testing.assert_allclose(linear.stiffness[:, column], (behind - ahead) / (2 * step), atol=1e-8)
    assert np.all(np.linalg.eigvalsh(linear.mass) > 0)


def test_a_free_hub_lets_the_arm_hang(beam_scene: Callable[..., Scene]) -> None:
    scene = beam_scene(links=4, base='kind = "motor"\ninertia = 0.03', gravity=9.81)
    rest = equilibrium(scene)
    np.testing.assert_allclose([rest.hub, *rest.angles], -np.pi / 2, atol=1e-9)


@pytest.mark.parametrize("integrator", ["newmark", "houbolt", "sdirk4"])
def test_the_generated_kernel_finds_where_a_free_hub_rests(
    integrator: str, beam_scene: Callable[..., Scene]
) -> None:
    """Pushed at the tip, it hangs askew; the slope of the kernel's accelerations there is -M^-1 K."""
    scene = beam_scene(links=3, base='kind = "motor"\ninertia = 0.03', gravity=9.81, bending=1.0)
    scene = scene.replace(**{"integrator.name": integrator})
    own = equilibrium(scene, {"push": 0.5})
    kernels = equilibrium(scene, {"push": 0.5}, kernel_unbalanced(scene, {"push": 0.5}))
    np.testing.assert_allclose([own.hub, *own.angles], [kernels.hub, *kernels.angles], atol=1e-9)
    accelerations = kernel_accelerations(scene, {"push": 0.5})
    angles, step = np.array([own.hub, *own.angles]), 1e-5
    linear = matrices(linear_arm(scene, own))
    slopes = [
        (accelerations(angles + step * unit) - accelerations(angles - step * unit)) / (2 * step)
        for unit in np.eye(4)
    ]
    error = linear.mass @ np.array(slopes).T + linear.stiffness
    assert np.max(np.abs(error)) < 1e-6 * np.max(np.abs(linear.stiffness))


def test_a_torque_on_a_free_hub_has_no_equilibrium(beam_scene: Callable[..., Scene]) -> None:
    from tmm_gen.errors import UserError

    inputs = '[[input]]\nname = "motor"\nat = "base"\nacts = "torque"'
    scene = beam_scene(links=3, base='kind = "motor"\ninertia = 0.03', inputs=inputs)
    with pytest.raises(UserError, match="no static equilibrium"):
        equilibrium(scene, {"motor": 1.0})
