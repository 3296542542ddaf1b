"""Energy of a planar arm along a motion: where it is, where it comes from, where it goes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Signal
from tmm_gen.reference.floating import base_place
from tmm_gen.reference.planar_arm import Arm
from tmm_gen.scene import Scene
from tmm_gen.scene.model import FloatingBase

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Energy:
    """Energies and powers over time, (k,) each.

    Parameters
    ----------
    time : array
        s.
    kinetic, elastic, gravitational : array
        J; gravitational from the height of the base.
    dissipation : array
        W; what dampers of joints and hub turn to heat.
    supply : array
        W; what loads, motor and prescribed base put in.
    borne : array
        J; what the supply lacks of the work that a prescribed base does on rotors at its joints: it goes by their
        acceleration, and was integrated by parts.
    """

    time: Array
    kinetic: Array
    elastic: Array
    gravitational: Array
    dissipation: Array
    supply: Array
    borne: Array

    @property
    def total(self) -> Array:
        """Kinetic, elastic and gravitational energy together, J."""
        return self.kinetic + self.elastic + self.gravitational

    @property
    def dissipated(self) -> Array:
        """Energy turned to heat so far, J."""
        return _integral(self.time, self.dissipation)

    @property
    def supplied(self) -> Array:
        """Work done on the arm so far, J."""
        done: Array = _integral(self.time, self.supply) + self.borne - self.borne[0]
        return done

    @property
    def imbalance(self) -> float:
        """Largest imbalance as a share of the energy that moves; zero where nothing does."""
        moved = float(np.max(self.kinetic) + np.ptp(self.elastic) + np.ptp(self.gravitational))
        return float(np.max(np.abs(self.unbalanced))) / moved if moved > 0.0 else 0.0

    @property
    def unbalanced(self) -> Array:
        """Work done less energy gained and dissipated, J: zero but for the errors of integration."""
        left: Array = self.supplied - self.dissipated - (self.total - self.total[0])
        return left


def energy(scene: Scene, signals: Mapping[str, Signal], time: Array, angle: Array, rate: Array) -> Energy:
    """Return the energies of a motion.

    Parameters
    ----------
    scene : Scene
        Of kind "planar".
    signals : mapping from str to Signal
        Inputs by name; those not given are zero.
    time : array, (k,)
        s.
    angle, rate : array, (k, m)
        Of the links, and of the hub first where the base is a motor (see :class:`tmm_gen.simulate.trace.Trace`).
    """
    arm = Arm(scene, signals)
    s, c = np.sin(angle), np.cos(angle)
    torque, force_x, force_y = arm.loads(time)
    beyond_x, beyond_y = arm.beyond(force_x), arm.beyond(force_y)
    supply = np.sum(rate * (torque + arm.lengths * (c * beyond_y - s * beyond_x)), axis=1)
    still = np.zeros_like(rate)  # accelerations: neither places nor velocities depend on them
    if scene.floats:
        base_x, base_y = base_place(arm, 1, time, angle, rate, still)
        supply += base_x * force_x.sum(axis=1) + base_y * force_y.sum(axis=1)
    borne = np.zeros(len(time))
    if scene.prescribed:
        base_angle, base_rate, _ = arm.base_motion(time)
        for place in np.flatnonzero(arm.inner < 0):
            joint, moved = scene.joints[place], rate[:, place]
            spring = joint.stiffness * (base_angle + joint.rest - angle[:, place]) + joint.damping * (
                base_rate - moved
            )
            # of the load as Lagrange's equations have it, only what the base itself does is work put in
            supply += base_rate * spring - moved * (joint.stiffness * base_angle + joint.damping * base_rate)
            borne += arm.rotors[place] * base_rate * (0.5 * base_rate - moved)
    return Energy(
        time,
        kinetic_energy(arm, time, angle, rate, base_place(arm, 1, time, angle, rate, still)),
        elastic_energy(arm, time, angle),
        gravitational_energy(arm, angle, base_place(arm, 0, time, angle, rate, still)),
        dissipation(arm, time, rate),
        supply,
        borne,
    )


def kinetic_energy(arm: Arm, time: Array, angle: Array, rate: Array, base: tuple[Array, Array]) -> Array:
    """Return the kinetic energy of base, links, tip and rotors, (k,), J; the base's velocity is given along x and y."""
    along_x = base[0][:, None] - arm.walked(np.sin(angle) * rate)
    along_y = base[1][:, None] + arm.walked(np.cos(angle) * rate)
    found: Array = 0.5 * (along_x**2 + along_y**2) @ arm.masses + 0.5 * rate**2 @ arm.inertias
    if isinstance(arm.scene.base, FloatingBase):
        found += 0.5 * arm.scene.base.mass * (base[0] ** 2 + base[1] ** 2)
    if arm.rotors.any():
        found += 0.5 * arm.wound(time, rate) ** 2 @ arm.rotors
    return found


def elastic_energy(arm: Arm, time: Array, angle: Array) -> Array:
    """Return the energy of the bent joints, (k,), J."""
    found: Array = 0.5 * arm.strained(time, angle) ** 2 @ arm.joints[0]
    return found


def gravitational_energy(arm: Arm, angle: Array, base: tuple[Array, Array]) -> Array:
    """Return the energy of height above where the base started, (k,), J."""
    found: Array = arm.gravity * (np.sin(angle) @ arm.moments)
    if arm.scene.floats:
        found += arm.gravity * arm.whole * base[1]
    return found


def dissipation(arm: Arm, time: Array, rate: Array) -> Array:
    """Return what dampers of joints and hub turn to heat, (k,), W."""
    found: Array = np.sum(rate * arm.damper_torques(rate), axis=1)
    if arm.scene.prescribed:
        _, base_rate, _ = arm.base_motion(time)
        for place in np.flatnonzero(arm.inner < 0):
            damping = arm.scene.joints[place].damping
            found += damping * (base_rate**2 - 2.0 * base_rate * rate[:, place])
    return found


def _integral(time: Array, power: Array) -> Array:
    """Integrate from the first instant, by a cubic spline: fourth order, so that kernels of that order show theirs."""
    from scipy.interpolate import CubicSpline

    found: Array = CubicSpline(time, power).antiderivative()(time)
    return found
