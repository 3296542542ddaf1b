"""The reference itself: against SciPy on Lagrange's equations, and against laws it does not use."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tmm_gen.reference.collocation import ReferenceError, integrate
from tmm_gen.reference.energy import energy
from tmm_gen.reference.planar_arm import Arm
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.scene import Scene


def lagrange(scene: Scene, signals: Any, until: float) -> np.ndarray:
    """Return angles at the end by SciPy, from kinetic and potential energy differentiated numerically.

    Nothing of `Arm` is used: the mass matrix comes from the places of all masses, in complex steps.
    """
    n, hub = scene.stations, scene.base.kind == "motor"
    lengths = np.array([link.length for link in scene.links])
    centers = np.array([link.center * link.length for link in scene.links])
    masses = np.array([link.mass for link in scene.links])
    inertias = np.array([link.inertia for link in scene.links])
    tip_mass = scene.tip.mass if scene.tip else 0.0
    inertias[-1] += scene.tip.inertia if scene.tip else 0.0
    k = np.array([joint.stiffness for joint in scene.joints])
    c = np.array([joint.damping for joint in scene.joints])
    lever = np.tril(np.tile(lengths, (n, 1)), -1) + np.diag(centers)
    weight, arms = np.append(masses, tip_mass), np.vstack([lever, lengths])
    g = scene.model.gravity or 0.0

    def acting(t: float, q: np.ndarray) -> tuple[np.ndarray, float, float]:
        force = np.zeros(n)
        base_torque = base_angle = 0.0
        for item in scene.inputs:
            u = float(signals[item.name].at(t))
            if item.acts == "angle":
                base_angle = u
            elif item.at == "base":
                base_torque = u
            else:
                i = n if item.at == "tip" else int(item.at)
                if item.acts == "torque":
                    force[i - 1] += u
                elif item.acts == "force_x":
                    force[:i] -= lengths[:i] * np.sin(q[:i]) * u
                else:
                    force[:i] += lengths[:i] * np.cos(q[:i]) * u
        return force, base_torque, base_angle

    def rates(t: float, y: np.ndarray) -> np.ndarray:
        half = len(y) // 2
        q, w = y[:half][-n:], y[half:][-n:]
        jx, jy = -arms * np.sin(q), arms * np.cos(q)  # d place / d angle
        mass = jx.T @ (weight[:, None] * jx) + jy.T @ (weight[:, None] * jy) + np.diag(inertias)
        centripetal_x, centripetal_y = -(arms * np.cos(q)) @ w**2, -(arms * np.sin(q)) @ w**2
        force, base_torque, base_angle = acting(t, q)
        base_rate = (acting(t + 1e-6, q)[2] - acting(t - 1e-6, q)[2]) / 2e-6
        if hub:
            base_angle, base_rate = y[0], y[half]
        torque = k * np.diff(q, prepend=base_angle) + c * np.diff(w, prepend=base_rate)
        force -= jx.T @ (weight * centripetal_x) + jy.T @ (weight * (centripetal_y + g)) + torque
        force[:-1] += torque[1:]
        a = np.linalg.solve(mass, force)
        if hub:
            own = (base_torque + torque[0] - scene.base.damping * base_rate) / scene.base.inertia
            a = np.append(own, a)
        return np.concatenate([y[half:], a])

    start = np.concatenate([[0.0] * hub, scene.initial.angles, [0.0] * hub, scene.initial.rates])
    found = solve_ivp(rates, (0.0, until), start, method="DOP853", rtol=1e-12, atol=1e-12)
    return found.y[: len(start) // 2, -1]


@pytest.mark.parametrize("base", ["clamp", "motor", "prescribed"])
def test_it_agrees_with_scipy(base: str, unlike: Callable[..., Scene], swinging: Any) -> None:
    scene = unlike(base, links=4)
    signals = swinging(scene)
    angles = Arm(scene, signals).trajectory(0.5).at(np.array([0.5]))[0][0]
    assert angles == pytest.approx(lagrange(scene, signals, 0.5), abs=1e-9)


def test_it_agrees_with_scipy_on_the_falling_arm(falling: Callable[..., Scene]) -> None:
    scene = falling(5)
    angles = Arm(scene, {}).trajectory(1.0).at(np.array([1.0]))[0][0]
    assert angles == pytest.approx(lagrange(scene, {}, 1.0), abs=1e-9)


@pytest.mark.parametrize("base", ["clamp", "motor", "prescribed"])
def test_its_energies_balance(base: str, unlike: Callable[..., Scene], swinging: Any) -> None:
    scene = unlike(base)
    signals = swinging(scene)
    times = np.linspace(0.0, 0.5, 2001)
    angle, rate, _ = Arm(scene, signals).trajectory(0.5).at(times)
    found = energy(scene, signals, times, angle, rate)
    assert np.max(np.abs(found.unbalanced)) < 1e-6 * np.ptp(found.total)


def test_slopes_are_those_of_the_residual(unlike: Callable[..., Scene], swinging: Any) -> None:
    scene = unlike("motor")
    arm = Arm(scene, swinging(scene))
    random = np.random.default_rng(0)
    point = random.normal(size=(3, 1, 4))
    time = np.array([0.2])
    for which, slopes in enumerate(arm.slopes(time, *point)):
        for column in range(4):
            moved = np.zeros_like(point)
            moved[which, 0, column] = 1e-6
            change = arm.residual(time, *(point + moved)) - arm.residual(time, *(point - moved))
            assert slopes[0, :, column] == pytest.approx(change[0] / 2e-6, abs=1e-6)


def test_it_says_where_it_cannot_go_on() -> None:
    def residual(t: Any, q: Any, v: Any, a: Any) -> Any:
        return a - v**2 * np.exp(q)  # reaches infinity in finite time

    def slopes(t: Any, q: Any, v: Any, a: Any) -> Any:
        grown = np.exp(q)
        return tuple(x[:, :, None] for x in (-(v**2) * grown, -2.0 * v * grown, np.ones_like(a)))

    with pytest.raises(ReferenceError, match="cannot pass t ="):
        integrate(residual, slopes, np.zeros(1), np.ones(1), np.array([0.0, 3.0]))


def test_positions_are_read_off_angles(unlike: Callable[..., Scene]) -> None:
    scene = unlike("clamp", loads=False)
    found = planar_response(scene, {}, np.array([0.0]))
    lengths, angles = [link.length for link in scene.links], np.array(scene.initial.angles)
    assert found["position_of_tip_x"][0] == pytest.approx(lengths @ np.cos(angles))
    assert found["position_of_tip_y"][0] == pytest.approx(lengths @ np.sin(angles))


def test_what_acts_until_a_jump_is_all_that_a_step_to_it_sees() -> None:
    def residual(t: np.ndarray, _q: np.ndarray, _v: np.ndarray, a: np.ndarray) -> np.ndarray:
        return a - np.where(t < 0.3, 1.0, -1.0)[:, None]

    def slopes(t: np.ndarray, *_: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        none = np.zeros((len(t), 1, 1))
        return none, none, none + 1.0

    found = integrate(residual, slopes, np.zeros(1), np.zeros(1), np.array([0.0, 0.3, 1.0]))
    q, v, _ = found.at(np.array([0.3, 1.0]))
    np.testing.assert_allclose(q[:, 0], [0.3**2 / 2, 0.3**2 / 2 + 0.3 * 0.7 - 0.7**2 / 2], atol=1e-15)
    np.testing.assert_allclose(v[:, 0], [0.3, 0.3 - 0.7], atol=1e-15)
