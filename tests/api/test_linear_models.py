"""Linear models against modes, frequency responses and finite motion, which are found in other ways."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

import tmm_gen as tg
from tmm_gen.control.arm.linear_model import LinearModel
from tmm_gen.inputs.signals import Constant
from tmm_gen.modal.response import frequency_response
from tmm_gen.modal.situation import resting_arm
from tmm_gen.modal.space.response import space_response
from tmm_gen.modal.space.situation import resting_in_space
from tmm_gen.reference.planar_arm import Arm
from tmm_gen.reference.spatial_afloat import AfloatArm
from tmm_gen.reference.spatial_turns import product
from tmm_gen.scene.signal import kernel_names

Complex = NDArray[np.complex128]

POINTS = 2j * np.pi * np.array([0.3, 2.0, 17.0])


def answers(model: LinearModel, arm: tg.Arm, output: str) -> Complex:
    """Return an output for a unit of each input, (f, inputs): a base that is told where to be is told how fast too."""
    found = np.zeros((len(POINTS), len(arm.scene.inputs)), complex)
    row = model.outputs.index(output)
    for k, s in enumerate(POINTS):
        whole = model.C[row] @ np.linalg.solve(s * np.eye(len(model.A)) - model.A, model.B) + model.D[row]
        for i, item in enumerate(arm.scene.inputs):
            found[k, i] = sum(
                s**order * whole[model.inputs.index(name)] for order, name in enumerate(kernel_names(item))
            )
    return found


def swept(arm: tg.Arm) -> Mapping[str, Complex]:
    if arm.kind == "spatial":
        return space_response(resting_in_space(arm.scene).still, POINTS)
    return frequency_response(resting_arm(arm.scene), POINTS)


@pytest.mark.parametrize("name", ["rod", "shafts", "probe"])
def test_a_model_about_rest_has_the_poles_of_the_modes_and_the_responses_of_the_sweep(
    name: str, request: pytest.FixtureRequest
) -> None:
    arm: tg.Arm = request.getfixturevalue(name)
    model = arm.linearise()
    for pole in arm.modes(20).poles.ravel():
        assert np.min(np.abs(model.poles - pole)) < 1e-9 * max(1.0, abs(pole))
    right = swept(arm)
    assert set(model.outputs) == set(right)  # energies are none of them
    for output in model.outputs:
        size = np.max(np.abs(right[output]))
        np.testing.assert_allclose(answers(model, arm, output), right[output], rtol=0, atol=1e-9 * size)
    assert np.max(np.abs(model.drift)) < 1e-9


def test_scipy_takes_it(rod: tg.Arm) -> None:
    model = rod.linearise()
    system = model.state_space()
    assert system.dt is None
    assert model.states[: len(model.states) // 2] == ("hub_angle", "angle_1", "angle_2")
    assert model.inputs == ("push", "hub_torque")
    np.testing.assert_allclose(system.to_discrete(0.01).A, expm(0.01 * model.A), rtol=1e-12)
    assert repr(model) == "<LinearModel of rod: 6 states, 2 inputs, 3 outputs>"


def test_where_it_is_taken(rod: tg.Arm) -> None:
    hanging, standing = rod.rest()
    assert hanging.stable
    assert not standing.stable
    np.testing.assert_allclose(rod.linearise(hanging).A, rod.linearise().A, atol=1e-7)
    assert np.max(rod.linearise(standing).poles.real) > 1.0
    level = rod.linearise({"hub": 0.0, "joint 1": 0.0}, push=2.0)
    assert level.y0[:2] == pytest.approx([1.0, 0.0])
    assert level.u0.tolist() == [2.0, 0.0]
    assert level.drift[-1] == pytest.approx(
        level.B[-1, 0] * 2.0 + rod.linearise({"hub": 0.0, "joint 1": 0.0}).drift[-1]
    )
    assert rod.linearise("start").x0[1] == pytest.approx(-1.5)


def test_small_turns_of_a_base_that_turns_already(probe: tg.Arm) -> None:
    model = probe.linearise("start")
    turns = [model.states.index(f"base_turn_{axis}") for axis in "xyz"]
    rates = [model.states.index(f"base_omega_{axis}") for axis in "xyz"]
    omega, small = model.x0[rates], 1e-3
    np.testing.assert_allclose(omega, [0.3, -0.2, 0.5])

    def way(turn: NDArray[np.float64]) -> NDArray[np.float64]:
        ends = [
            (Rotation.from_rotvec(turn) * Rotation.from_rotvec(sign * 1e-4 * omega)).as_rotvec()
            for sign in (1.0, -1.0)
        ]
        return np.asarray((ends[0] - ends[1]) / 2e-4)

    slopes = np.stack(
        [(way(small * unit) - way(-small * unit)) / (2.0 * small) for unit in np.eye(3)], axis=1
    )
    np.testing.assert_allclose(model.A[np.ix_(turns, turns)], slopes, atol=1e-6)
    np.testing.assert_array_equal(model.A[np.ix_(turns, rates)], np.eye(3))


def test_accelerations_are_those_of_independent_equations(probe: tg.Arm, rod: tg.Arm) -> None:
    """Of arms that move: gyroscopic and centrifugal forces, which no arm at rest has."""
    assert probe.scene.spatial is not None
    afloat = AfloatArm(probe.scene.spatial)
    model = probe.linearise("start", thrust=(1.0, -2.0, 0.5))
    found = dict(
        zip(model.states, np.split(model.drift, 2)[1], strict=False)
    )  # of coordinates, which come first
    thrust = {f"thrust_{axis}": force for axis, force in zip("xyz", (1.0, -2.0, 0.5), strict=True)}
    place = afloat.start()[0]
    curve = afloat.forward_dynamics(*afloat.start(), thrust)
    alpha = 2.0 * product(place[3:7] * [1.0, -1.0, -1.0, -1.0], curve[3:7])[1:]  # in the base's own axes
    right = np.concatenate([curve[:3], alpha, curve[7:]])
    ways = [f"base_place_{axis}" for axis in "xyz"] + [f"base_turn_{axis}" for axis in "xyz"]
    np.testing.assert_allclose([found[name] for name in (*ways, "angle_1")], right, rtol=1e-10)

    swinging = rod.with_(initial__rates=0.8)
    scene = swinging.scene
    still, rate = np.zeros((1, 3)), np.array([[0.0, 0.8, 0.8]])
    still[0, 1:] = -1.5
    right = Arm(scene, {"push": Constant(2.0)}).accelerations(np.zeros(1), still, rate)[0]
    np.testing.assert_allclose(swinging.linearise("start", push=2.0).drift[3:], right, rtol=1e-9)


@pytest.mark.parametrize("at", ["here", 3, np.zeros(2), None])
def test_places_that_are_none(rod: tg.Arm, at: object) -> None:
    with pytest.raises(tg.UserError, match="must be 'rest', 'start', angles of joints"):
        rod.linearise(at)  # type: ignore[arg-type]


def test_an_equilibrium_of_another_arm(rod: tg.Arm) -> None:
    with pytest.raises(tg.UserError, match="has 3 free angles and the arm 4"):
        rod.with_(beam__links=3).linearise(rod.rest()[0])
